// SPDX-License-Identifier: GPL-3.0-or-later
// Which faces hang together, and which of them meet: see surfaces.h.
//
// Method      CGAL's box_self_intersection_d finds the pairs of faces whose
//             boxes meet. A pair is let go if one of the following holds, and
//             what they share is a vertex of both, an edge of both, or nothing:
//             no corner of f but the shared ones is elsewhere than strictly on
//             one side of the plane of g, or the same with f and g exchanged;
//             or they are in one plane, and the line of an edge of f has all of
//             f on one side or on it, and all of g strictly on the other but
//             for shared corners, which are on it, or the same exchanged. What
//             f and g have in common is then in the hull of the shared corners,
//             which is that vertex or edge.

#include "common/adapt/surfaces.h"
#include "common/exact/exact_plane.h"

#include <CGAL/Box_intersection_d/Box_with_handle_d.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cstdlib>
#include <new>
#include <numeric>
#include <vector>

namespace {

using namespace hsr;

// --- Shared edges, and what hangs together ---------------------------------

struct Edge {
  uint32_t a, b, face, corner; // a < b
};

bool before(const Edge &p, const Edge &q) {
  return p.a != q.a ? p.a < q.a : p.b != q.b ? p.b < q.b : p.corner < q.corner;
}

std::vector<Edge> edges_of(const hsr_world *world) {
  std::vector<Edge> edges;
  edges.reserve(world->mesh.n_corners);
  for (uint32_t f = 0; f < world->n_faces; f++) {
    uint32_t start = world->mesh.start[f], end = world->mesh.start[f + 1];
    for (uint32_t k = start; k < end; k++) {
      uint32_t a = world->mesh.vertex[k];
      uint32_t b = world->mesh.vertex[k + 1 < end ? k + 1 : start];
      edges.push_back({std::min(a, b), std::max(a, b), f, k});
    }
  }
  std::sort(edges.begin(), edges.end(), before);
  return edges;
}

uint32_t find_root(std::vector<uint32_t> &root, uint32_t f) {
  while (root[f] != f)
    f = root[f] = root[root[f]];
  return f;
}

void join_faces(hsr_surfaces *s, const hsr_world *world) {
  std::vector<uint32_t> root(world->n_faces);
  std::iota(root.begin(), root.end(), 0);
  std::fill(s->shared, s->shared + world->mesh.n_corners, HSR_NOT_SHARED);
  const std::vector<Edge> edges = edges_of(world);
  for (size_t k = 0, end; k < edges.size(); k = end) {
    for (end = k + 1; end < edges.size() && edges[end].a == edges[k].a &&
                      edges[end].b == edges[k].b;
         end++)
      ;
    if (end - k != 2 || edges[k].face == edges[k + 1].face ||
        edges[k].a == edges[k].b)
      continue;
    s->shared[edges[k].corner] = s->shared[edges[k + 1].corner] = s->n_shared++;
    root[find_root(root, edges[k].face)] = find_root(root, edges[k + 1].face);
  }
  std::vector<uint32_t> number(world->n_faces, UINT32_MAX);
  for (uint32_t f = 0; f < world->n_faces; f++) {
    uint32_t &of_root = number[find_root(root, f)];
    if (of_root == UINT32_MAX)
      of_root = s->n++;
    s->surface[f] = of_root;
    s->meets_all[of_root] |= world->mesh.deviation[f] > 0;
  }
}

// --- Two faces whose boxes meet ----------------------------------------------

struct Face {
  const hsr_world *world;
  uint32_t id;

  uint32_t size() const { return hsr_face_size(world, id); }
  uint32_t vertex(uint32_t k) const {
    return world->mesh.vertex[world->mesh.start[id] + k % size()];
  }
  bool has(uint32_t v) const {
    const uint32_t *first = world->mesh.vertex + world->mesh.start[id];
    return std::find(first, first + size(), v) != first + size();
  }
  bool has_edge(uint32_t a, uint32_t b) const {
    for (uint32_t k = 0; k < size(); k++)
      if ((vertex(k) == a && vertex(k + 1) == b) ||
          (vertex(k) == b && vertex(k + 1) == a))
        return true;
    return false;
  }
};

// Whether they share nothing, a vertex, or an edge of both.
bool share_little(const Face &f, const Face &g) {
  std::vector<uint32_t> both;
  for (uint32_t k = 0; k < f.size(); k++)
    if (g.has(f.vertex(k)))
      both.push_back(f.vertex(k));
  return both.size() < 2 || (both.size() == 2 && f.has_edge(both[0], both[1]) &&
                             g.has_edge(both[0], both[1]));
}

// Whether all corners of f but shared ones are strictly on one side of the
// plane of g.
bool is_on_one_side(const Face &f, const Face &g) {
  int all = 0;
  for (uint32_t k = 0; k < f.size(); k++) {
    if (g.has(f.vertex(k)))
      continue;
    int side = side_of_plane(g.world, g.id, f.vertex(k));
    if (side == 0 || side == -all)
      return false;
    all = side;
  }
  return all != 0;
}

// The side of the line from a to b that c is on, all seen along an axis.
template <class T>
T turn(const double *u, const double *v, uint32_t a, uint32_t b, uint32_t c) {
  return (T(u[b]) - T(u[a])) * (T(v[c]) - T(v[a])) -
         (T(v[b]) - T(v[a])) * (T(u[c]) - T(u[a]));
}

int side_of_line(const double *u, const double *v, uint32_t a, uint32_t b,
                 uint32_t c) {
  if (c == a || c == b)
    return 0;
  {
    CGAL::Protect_FPU_rounding<true> upwards;
    CGAL::Uncertain<CGAL::Sign> sign =
        CGAL::sign(turn<Interval>(u, v, a, b, c));
    if (CGAL::is_certain(sign))
      return CGAL::get_certain(sign);
  }
  return CGAL::sign(turn<Exact>(u, v, a, b, c));
}

// Whether the line of an edge of f has f and g on its two sides.
bool edge_separates(const Face &f, const Face &g, const double *u,
                    const double *v) {
  for (uint32_t k = 0; k < f.size(); k++) {
    uint32_t a = f.vertex(k), b = f.vertex(k + 1);
    int own = 0;
    bool apart = true;
    for (uint32_t l = 0; l < f.size() && apart; l++) {
      int side = side_of_line(u, v, a, b, f.vertex(l));
      apart = !side || side != -own;
      own = side ? side : own;
    }
    for (uint32_t l = 0; l < g.size() && apart; l++) {
      int side = side_of_line(u, v, a, b, g.vertex(l));
      apart = side ? side == -own : f.has(g.vertex(l));
    }
    if (apart && own)
      return true;
  }
  return false;
}

// In one plane, which is looked at along the axis that it faces most.
bool are_apart_in_plane(const Face &f, const Face &g) {
  const hsr_mesh &mesh = f.world->mesh;
  if (mesh.plane[f.id] != mesh.plane[g.id])
    return false;
  const double n[3] = {std::fabs(mesh.nx[f.id]), std::fabs(mesh.ny[f.id]),
                       std::fabs(mesh.nz[f.id])};
  const double *axes[3] = {mesh.x, mesh.y, mesh.z};
  int k = int(std::max_element(n, n + 3) - n);
  const double *u = axes[(k + 1) % 3], *v = axes[(k + 2) % 3];
  return edge_separates(f, g, u, v) || edge_separates(g, f, u, v);
}

bool may_meet(const Face &f, const Face &g) {
  return !share_little(f, g) ||
         !(is_on_one_side(f, g) || is_on_one_side(g, f) ||
           are_apart_in_plane(f, g));
}

// --- The pairs ---------------------------------------------------------------

using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, uint32_t>;

Box box_of(const hsr_world *world, uint32_t f) {
  Box box(f);
  for (uint32_t k = world->mesh.start[f]; k < world->mesh.start[f + 1]; k++) {
    uint32_t v = world->mesh.vertex[k];
    double p[3] = {world->mesh.x[v], world->mesh.y[v], world->mesh.z[v]};
    box.extend(p);
  }
  return box;
}

uint64_t pair_of(uint32_t s, uint32_t t) {
  return uint64_t(std::min(s, t)) << 32 | std::max(s, t);
}

std::vector<uint64_t> find_meeting(const hsr_surfaces *s,
                                   const hsr_world *world) {
  std::vector<Box> boxes;
  std::vector<uint64_t> meeting;
  for (uint32_t f = 0; f < world->n_faces; f++)
    if (!s->meets_all[s->surface[f]])
      boxes.push_back(box_of(world, f));
  CGAL::box_self_intersection_d(
      boxes.begin(), boxes.end(), [&](const Box &f, const Box &g) {
        uint64_t pair = pair_of(s->surface[f.info()], s->surface[g.info()]);
        if ((meeting.empty() || meeting.back() != pair) &&
            may_meet({world, f.info()}, {world, g.info()}))
          meeting.push_back(pair);
      });
  std::sort(meeting.begin(), meeting.end());
  meeting.erase(std::unique(meeting.begin(), meeting.end()), meeting.end());
  return meeting;
}

template <class T> T *allocate(size_t n) {
  T *array = static_cast<T *>(std::calloc(n + 1, sizeof(T)));
  return array ? array : throw std::bad_alloc();
}

} // namespace

enum hsr_status hsr_surfaces_init(struct hsr_surfaces *s,
                                  const struct hsr_world *world,
                                  struct hsr_error *err) {
  *s = {};
  try {
    s->surface = allocate<uint32_t>(world->n_faces);
    s->meets_all = allocate<bool>(world->n_faces);
    s->shared = allocate<uint32_t>(world->mesh.n_corners);
    join_faces(s, world);
    const std::vector<uint64_t> meeting = find_meeting(s, world);
    s->n_meeting = meeting.size();
    s->meeting = allocate<uint64_t>(s->n_meeting);
    std::copy(meeting.begin(), meeting.end(), s->meeting);
    return HSR_OK;
  } catch (...) {
    return hsr_fail_nomem(err);
  }
}

void hsr_surfaces_free(struct hsr_surfaces *s) {
  std::free(s->surface);
  std::free(s->meets_all);
  std::free(s->shared);
  std::free(s->meeting);
}

bool hsr_surfaces_apart(const struct hsr_surfaces *s, uint32_t f, uint32_t g) {
  uint32_t a = s->surface[f], b = s->surface[g];
  return !s->meets_all[a] && !s->meets_all[b] &&
         !std::binary_search(s->meeting, s->meeting + s->n_meeting,
                             pair_of(a, b));
}
