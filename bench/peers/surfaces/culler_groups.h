// SPDX-License-Identifier: GPL-3.0-or-later
// Groups of faces that lie together, for a culler: what a program would cull at
// once.
#ifndef HSR_BENCH_PEERS_SURFACES_CULLER_GROUPS_H
#define HSR_BENCH_PEERS_SURFACES_CULLER_GROUPS_H

#include "bench/peers/shared/projection.h"
#include "common/scene/world.h"

#include <vector>

namespace culler {

struct Group {
  uint32_t first, n; // triangle[first], ... triangle[first + n - 1]
  box bounds;        // of all corners, in floats and a little wider
  bool one_sided;    // all of them; else none is
};

struct Groups {
  std::vector<uint32_t> triangle; // of the world, group by group
  std::vector<Group> group;
};

// Groups the faces of a world of triangles, those of one side apart from those of
// two. They are divided at the median of their first corners, across the longest
// side of the box of these, until no group holds more than `most` faces. All
// triangles of a face come into one group. Throws std::bad_alloc.
Groups make_groups(const hsr_world *world, uint32_t most);

} // namespace culler
#endif
