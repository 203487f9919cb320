// SPDX-License-Identifier: GPL-3.0-or-later
// The corners of triangles that have no vertex numbers, as in .stl files.
#ifndef HSR_COMMON_MESH_CORNERS_H
#define HSR_COMMON_MESH_CORNERS_H

#include "common/files/mesh/mesh_file.h"

namespace hsr {

/* n triangles. Nine finite numbers of each, corner by corner, begin at first,
 * first + stride, ... Floats begin with the lowest byte, as in files; doubles are
 * the machine's. */
struct Loose_triangles {
  const char *first;
  size_t stride, n;
};

/* Gives the builder all vertices and triangles. Corners with the same coordinates
 * are one vertex, which gets its number where it is met first. 0 and -0 are the
 * same. Real is float or double, as the numbers are. Throws Refused for the first
 * triangle that has a corner twice, unless such are dropped; std::bad_alloc. */
template <class Real>
void give_loose_triangles(const Loose_triangles &triangles,
                          Mesh_builder &builder);

} // namespace hsr

#endif
