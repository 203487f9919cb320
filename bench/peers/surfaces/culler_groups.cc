// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/peers/surfaces/culler_groups.h"

#include "common/scene/pieces.h"

#include <algorithm>
#include <cmath>

namespace culler {
namespace {

// The triangles of one face, which follow one another.
struct Face {
  uint32_t first, n;
  double corner[3]; // the first one
};

struct Box {
  double low[3] = {INFINITY, INFINITY, INFINITY};
  double high[3] = {-INFINITY, -INFINITY, -INFINITY};

  void include(const double point[3]) {
    for (int k = 0; k < 3; k++) {
      low[k] = std::min(low[k], point[k]);
      high[k] = std::max(high[k], point[k]);
    }
  }

  int longest() const {
    const auto length = [&](int k) { return high[k] - low[k]; };
    const int k = length(1) > length(0) ? 1 : 0;
    return length(2) > length(k) ? 2 : k;
  }
};

using Faces = std::vector<Face>::iterator;

struct Divider {
  const hsr_mesh &mesh;
  ptrdiff_t most;
  Groups groups;

  void find_corner(uint32_t v, double at[3]) const {
    at[0] = mesh.x[v];
    at[1] = mesh.y[v];
    at[2] = mesh.z[v];
  }

  void add(Faces begin, Faces end) {
    Group g{};
    Box box;
    g.first = static_cast<uint32_t>(groups.triangle.size());
    g.one_sided = mesh.one_sided[begin->first];
    for (; begin < end; ++begin)
      for (uint32_t f = begin->first; f < begin->first + begin->n; f++) {
        groups.triangle.push_back(f);
        for (uint32_t k = mesh.start[f]; k < mesh.start[f + 1]; k++) {
          double at[3];
          find_corner(mesh.vertex[k], at);
          box.include(at);
        }
      }
    g.n = static_cast<uint32_t>(groups.triangle.size()) - g.first;
    for (int k = 0; k < 3; k++) {
      g.bounds.low[k] =
          std::nextafter(static_cast<float>(box.low[k]), -INFINITY);
      g.bounds.high[k] =
          std::nextafter(static_cast<float>(box.high[k]), INFINITY);
    }
    groups.group.push_back(g);
  }

  void divide(Faces begin, Faces end) {
    if (end - begin <= most) {
      if (begin < end)
        add(begin, end);
      return;
    }
    Box box;
    for (Faces f = begin; f < end; ++f)
      box.include(f->corner);
    const int k = box.longest();
    const Faces middle = begin + (end - begin) / 2;
    std::nth_element(begin, middle, end, [k](const Face &a, const Face &b) {
      return a.corner[k] < b.corner[k] ||
             (a.corner[k] == b.corner[k] && a.first < b.first);
    });
    divide(begin, middle);
    divide(middle, end);
  }
};

std::vector<Face> find_faces(const hsr_world *world, const Divider &d) {
  std::vector<Face> faces;
  for (uint32_t f = 0; f < world->n_faces; f++) {
    if (f && hsr_world_parent(world, f) == hsr_world_parent(world, f - 1)) {
      faces.back().n++;
      continue;
    }
    Face face{f, 1, {}};
    d.find_corner(world->mesh.vertex[world->mesh.start[f]], face.corner);
    faces.push_back(face);
  }
  return faces;
}

} // namespace

Groups make_groups(const hsr_world *world, uint32_t most) {
  Divider d{world->mesh, most, {}};
  std::vector<Face> faces = find_faces(world, d);
  const Faces apart =
      std::stable_partition(faces.begin(), faces.end(), [&](const Face &f) {
        return world->mesh.one_sided[f.first];
      });
  d.divide(faces.begin(), apart);
  d.divide(apart, faces.end());
  return std::move(d.groups);
}

} // namespace culler
