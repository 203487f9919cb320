// SPDX-License-Identifier: GPL-3.0-or-later
// Pairs of faces that penetrate, for the core's own C++ files. Two faces
// penetrate if their interiors meet.
#ifndef HSR_COMMON_PENETRATION_H
#define HSR_COMMON_PENETRATION_H

#include "common/exact/exact_plane.h"

#include <functional>

namespace hsr {

// Calls found(f, g) once for every pair that penetrates among the faces faces[0
// .. n-1], which are all different. A pair may share a vertex. Throws
// std::bad_alloc, and whatever `found` throws.
void for_each_penetration(
    const hsr_world *world, const uint32_t *faces, size_t n,
    const std::function<void(uint32_t f, uint32_t g)> &found);

// The point at / denominator, whose coordinates need not be doubles.
struct Exact_point {
  Vector3<Exact> at;
  Exact denominator; // > 0
};

// Calls found(from, to) for each implied edge of two faces f < g that
// penetrate, from end to end. The order of edges and of ends is that along the
// cross product of the normals of f and g. There are no edges if one of the
// faces is not flat. Throws as above.
void for_each_implied_edge(
    const hsr_world *world, uint32_t f, uint32_t g,
    const std::function<void(const Exact_point &from, const Exact_point &to)>
        &found);

} // namespace hsr

#endif
