// SPDX-License-Identifier: GPL-3.0-or-later
// The pairs of faces that penetrate, for the core's own C++ files.
#ifndef HSR_COMMON_PENETRATION_H
#define HSR_COMMON_PENETRATION_H

#include "common/exact/exact_plane.h"

#include <functional>

namespace hsr {

// Calls found(f, g) once for every pair of the n faces whose interiors meet;
// they may share a vertex. Throws std::bad_alloc, and whatever `found` throws.
void for_each_penetration(
    const hsr_world *world, const uint32_t *faces, size_t n,
    const std::function<void(uint32_t f, uint32_t g)> &found);

// A point whose coordinates need not be doubles: at / denominator, which is >
// 0.
struct Exact_point {
  Vector3<Exact> at;
  Exact denominator;
};

// Calls found(from, to) for each implied edge of two faces f < g that
// penetrate, in their order along the cross product of the normals of f and of
// g. There are none if one of the faces is not flat. Throws as above.
void for_each_implied_edge(
    const hsr_world *world, uint32_t f, uint32_t g,
    const std::function<void(const Exact_point &from, const Exact_point &to)>
        &found);

} // namespace hsr

#endif
