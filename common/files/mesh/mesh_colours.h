// SPDX-License-Identifier: GPL-3.0-or-later
// Colours of mesh files; only for common/files/mesh and
// common/files/formats.
#ifndef HSR_COMMON_MESH_COLOURS_H
#define HSR_COMMON_MESH_COLOURS_H

#include "common/files/mesh/mesh_file.h"

#include <vector>

namespace hsr {

/* Decodes a colour of a file, which is sRGB-encoded, and an opacity, which is
 * linear. Values outside of 0..1 are clamped. NO_OPACITY becomes 1. */
Rgba rgba_of_file(const Rgba &encoded);

/* Decodes the colours of all vertices of a file. Files do not say their range.
 * So it is 0..1, or 0..255 if any value is above 1. */
void decode_all(std::vector<Rgba> &colours);

/* Whether all vertices of a file have a colour, if n of n_vertices have one. If
 * only some have, that is noted. */
bool have_colours(size_t n, size_t n_vertices, Mesh_builder &builder);

/* Sets *mean to the mean colour of n corners, and returns `mean`. NULL: there
 * are no colours, or no corners. */
const Rgba *mean_colour(const std::vector<Rgba> &of_vertices,
                        const uint32_t *corners, size_t n, Rgba *mean);

} // namespace hsr

#endif
