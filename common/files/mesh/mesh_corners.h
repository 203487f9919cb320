// SPDX-License-Identifier: GPL-3.0-or-later
// The corners of triangles that have no vertex numbers, as in .stl files.
#ifndef HSR_COMMON_MESH_CORNERS_H
#define HSR_COMMON_MESH_CORNERS_H

#include "common/files/mesh/mesh_colours.h"

namespace hsr {

/* n triangles in memory. Triangle k has nine finite numbers from first + k
 * stride on, corner by corner. Floats have the lowest byte first, as in files.
 * Doubles are the machine's. */
struct Loose_triangles {
  const char *first;
  size_t stride, n;
};

/* Gives the builder all vertices and triangles. Corners with equal coordinates
 * are one vertex. Vertices are numbered in the order in which they first occur.
 * 0 and -0 are equal. Real, float or double, is the type of the numbers. `looks`
 * are the colours of the triangles; or NULL, if none has one. Throws Refused if
 * the builder is strict and a triangle has two equal corners; std::bad_alloc. */
template <class Real>
void give_loose_triangles(const Loose_triangles &triangles,
                          const std::vector<Rgba> *looks,
                          Mesh_builder &builder);

} // namespace hsr

#endif
