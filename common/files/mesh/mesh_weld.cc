// SPDX-License-Identifier: GPL-3.0-or-later
// Joining vertices that nearly meet.
//
// Rule        in the order of their numbers, each vertex becomes the first one
//             that stays and is no farther away than the distance; if there is
//             none, it stays.
// Method      space is cut into cubes as wide as the distance. The vertices that
//             stay are listed by cube, so 27 cubes are searched for each.
// Cost        proportional to the number of vertices, unless many lie together
#include "common/files/mesh/mesh_file.h"
#include "common/scene/flat.h"

#include <cmath>
#include <unordered_map>

namespace hsr {
namespace {

using Cube = std::array<double, 3>; /* whole numbers */

struct Hash {
  size_t operator()(const Cube &cube) const {
    const std::hash<double> hash;
    size_t sum = 0;
    for (const double x : cube)
      sum = 0x9e3779b97f4a7c15 * (sum ^ hash(x));
    return sum;
  }
};

class Welder {
public:
  Welder(const struct hsr_object &object, double distance)
      : object_(object), distance_(distance) {}
  /* The vertex that each becomes. */
  std::vector<uint32_t> join();
  uint32_t n_joined() const { return n_joined_; }

private:
  const double *place(uint32_t v) const { return object_.xyz + 3 * size_t{v}; }
  uint32_t find(uint32_t v, const Cube &cube) const;

  const struct hsr_object &object_;
  const double distance_;
  std::unordered_map<Cube, std::vector<uint32_t>, Hash> staying_;
  uint32_t n_joined_ = 0;
};

/* The first vertex near v that stays, or v. */
uint32_t Welder::find(uint32_t v, const Cube &cube) const {
  uint32_t first = v;
  for (int k = 0; k < 27; k++) {
    const auto list = staying_.find(
        {cube[0] + k % 3 - 1, cube[1] + k / 3 % 3 - 1, cube[2] + k / 9 - 1});
    if (list == staying_.end())
      continue;
    for (const uint32_t w : list->second) {
      const double *a = place(v), *b = place(w);
      if (w < first &&
          std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) <= distance_)
        first = w;
    }
  }
  return first;
}

std::vector<uint32_t> Welder::join() {
  std::vector<uint32_t> to(object_.n_vertices);
  for (uint32_t v = 0; v < object_.n_vertices; v++) {
    Cube cube;
    for (size_t k = 0; k < 3; k++)
      cube[k] = std::floor(place(v)[k] / distance_);
    to[v] = find(v, cube);
    if (to[v] == v)
      staying_[cube].push_back(v);
    else
      n_joined_++;
  }
  return to;
}

} // namespace

void Mesh_builder::weld(double distance) {
  Welder welder(*object_, distance);
  const std::vector<uint32_t> to = welder.join();
  uint64_t n = 0;
  hsr_object_change_vertices(object_, to.data(), marks(), &n);
  n_dropped_ += n;
  const uint32_t joined = welder.n_joined();
  note(std::to_string(joined) + (joined == 1 ? " vertex" : " vertices") +
       " joined with others that are no farther away than the welding "
       "distance");
}

} // namespace hsr
