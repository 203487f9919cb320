// SPDX-License-Identifier: GPL-3.0-or-later
// The pairs of faces that penetrate, for the core's own C++ files.
#ifndef HSR_COMMON_PENETRATION_H
#define HSR_COMMON_PENETRATION_H

#include "common/world.h"

#include <functional>

namespace hsr {

// Calls found(f, g) once for every pair of the n faces whose interiors meet,
// also for faces that share a vertex. Throws std::bad_alloc, and whatever
// `found` throws.
void for_each_penetration(
    const hsr_world *world, const uint32_t *faces, size_t n,
    const std::function<void(uint32_t f, uint32_t g)> &found);

} // namespace hsr

#endif
