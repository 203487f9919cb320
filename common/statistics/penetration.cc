// SPDX-License-Identifier: GPL-3.0-or-later
// The pairs of faces that penetrate; X_f of Table I.
//
// Source      Sutherland, Sproull and Schumacker 1974, "Environment Complexity
//             Definitions": an environment includes penetration if any of the
//             faces intersect; the implied edge is where they do.
// Definition  Two faces on different planes penetrate if their interiors meet.
//             The planes then meet in a line; a stretch of it is inside f, a
//             stretch of it inside g, and these overlap. Commonly an edge of
//             one of them pierces the interior of the other. It does not if
//             both stretches end in the same points, as with two equal
//             rectangles that cross like the blades of a paddle wheel. So the
//             stretches are compared, not the edges.
// Left out    Faces that only touch, even along an edge; faces of one plane.
//             X_f also leaves out faces that share a vertex: they are
//             neighbours, and meet in what they share.
// Method      CGAL's box_self_intersection_d finds the pairs with overlapping
//             boxes. The pairs are kept whose faces reach through each other's
//             planes. Then the ends of the stretches are compared, in intervals
//             and, if these do not tell, in exact numbers.
// Thickness   The plane of a polygon that is not flat passes through the mean
//             of its vertices, which are a little off it. A vertex of another
//             face counts as lying on the plane if it is no farther off than
//             they are. Flat faces have no thickness.

#include "common/statistics/penetration.h"
#include "common/exact/exact_plane.h"
#include "common/exact/predicates.h"
#include "common/statistics/statistics.h"

#include <CGAL/Box_intersection_d/Box_with_handle_d.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <new>
#include <vector>

namespace {

using namespace hsr;

const double U = DBL_EPSILON / 2;
const double TINY = 0x1p-960;

struct Face {
  const hsr_world *world;
  uint32_t id;

  uint32_t size() const { return hsr_face_size(world, id); }
  uint32_t vertex(uint32_t k) const {
    return world->mesh.vertex[world->mesh.start[id] + k];
  }
  bool has(uint32_t v) const {
    const uint32_t *first = world->mesh.vertex + world->mesh.start[id];
    return std::find(first, first + size(), v) != first + size();
  }
};

// --- The faces reach through each other's planes --------------------------

// -1, 0 or +1: vertex v behind the plane of f, on it, or in front. The bound is
// that of `deviation` in planes.c.
int side(const Face &f, uint32_t v) {
  const hsr_world *w = f.world;
  if (f.has(v) && w->mesh.deviation[f.id] == 0)
    return 0;
  double n[3] = {w->mesh.nx[f.id], w->mesh.ny[f.id], w->mesh.nz[f.id]};
  double p[3] = {w->mesh.x[v], w->mesh.y[v], w->mesh.z[v]};
  double r[3] = {p[0] - w->mesh.px[f.id], p[1] - w->mesh.py[f.id],
                 p[2] - w->mesh.pz[f.id]};
  double n1 = std::fabs(n[0]) + std::fabs(n[1]) + std::fabs(n[2]);
  double r1 = std::fabs(r[0]) + std::fabs(r[1]) + std::fabs(r[2]);
  double off = n[0] * r[0] + n[1] * r[1] + n[2] * r[2];
  double error =
      2 * (w->mesh.n_error[f.id] * r1 + w->mesh.anchor_error[f.id] * n1) +
      16 * U * n1 * r1 + TINY;
  if (std::fabs(off) > w->mesh.deviation[f.id] + error)
    return off > 0 ? 1 : -1;
  if (w->mesh.deviation[f.id] > 0)
    return 0;
  bool out_of_memory = false;
  hsr_loop loop = {
      w->mesh.x, w->mesh.y, w->mesh.z, 1, w->mesh.vertex + w->mesh.start[f.id],
      f.size()};
  int exact = hsr_exact_plane_side(loop, p, &out_of_memory);
  if (out_of_memory)
    throw std::bad_alloc();
  return exact;
}

// The sides of the vertices of f against the plane of g; false unless there are
// vertices on both.
bool reaches_through(const Face &f, const Face &g, std::vector<int> &sides) {
  bool in_front = false, behind = false;
  sides.clear();
  for (uint32_t k = 0; k < f.size(); k++) {
    sides.push_back(side(g, f.vertex(k)));
    in_front |= sides.back() > 0;
    behind |= sides.back() < 0;
  }
  return in_front && behind;
}

bool share_vertex(const Face &f, const Face &g) {
  for (uint32_t k = 0; k < f.size(); k++)
    if (g.has(f.vertex(k)))
      return true;
  return false;
}

// --- The stretches of the line where the planes meet ----------------------

// Where an edge meets the line: the point at / denominator, and to which sets
// of stretches it is an end.
template <class T> struct End {
  Vector3<T> at;
  T denominator; // > 0
  unsigned sets;
};

// Whether an end comes before another along an axis.
template <class T> bool before(const End<T> &a, const End<T> &b, int axis) {
  return bool(a.at[axis] * b.denominator < b.at[axis] * a.denominator);
}

// The sets. A point of the line is inside a face if the face goes on to both
// sides of it, in front of the other's plane and behind. F_FRONT are the
// stretches along which f lies directly in front of the plane of g, and so on.
enum { F_FRONT = 1, F_BEHIND = 2, G_FRONT = 4, G_BEHIND = 8, ALL = 15 };

// The ends that f has on the plane of g: of the stretches in front, where an
// edge goes from strictly in front to elsewhere; of those behind, likewise.
template <class T>
void find_ends(const Face &f, const FacePlane<T> &g,
               const std::vector<int> &sides, unsigned front, unsigned behind,
               std::vector<End<T>> &ends) {
  for (uint32_t l = 0, k = f.size() - 1; l < f.size(); k = l++) {
    unsigned sets = ((sides[k] > 0) != (sides[l] > 0) ? front : 0) |
                    ((sides[k] < 0) != (sides[l] < 0) ? behind : 0);
    if (!sets)
      continue;
    Vector3<T> a = point<T>(f.world, f.vertex(k));
    Vector3<T> b = point<T>(f.world, f.vertex(l));
    if (sides[k] == 0) {
      ends.push_back({a, T(1), sets});
    } else if (sides[l] == 0) {
      ends.push_back({b, T(1), sets});
    } else { // (h_a B - h_b A) / (h_a - h_b), h_a > 0
      if (sides[k] < 0)
        std::swap(a, b);
      T ha = g.height(a), hb = g.height(b);
      ends.push_back({ha * b - hb * a, ha - hb, sets});
    }
  }
}

// Calls along() for the stretches of the line, more than a point each, that are
// in all of the sets: pairs of ends in the order of the line. It returns
// whether to go on.
template <class T, class Along>
void for_each_stretch(const Face &f, const Face &g,
                      const std::vector<int> &of_f,
                      const std::vector<int> &of_g, const Along &along) {
  const FacePlane<T> plane_f(f.world, f.id), plane_g(g.world, g.id);
  const Vector3<T> line = CGAL::cross_product(plane_f.normal, plane_g.normal);
  int axis = 0;
  while (axis < 3 && bool(line[axis] == T(0)))
    axis++;
  if (axis == 3)
    return;
  std::vector<End<T>> ends;
  find_ends(f, plane_g, of_f, F_FRONT, F_BEHIND, ends);
  find_ends(g, plane_f, of_g, G_FRONT, G_BEHIND, ends);
  const bool ascending = bool(line[axis] > T(0));
  std::sort(ends.begin(), ends.end(), [&](const End<T> &a, const End<T> &b) {
    return ascending ? before(a, b, axis) : before(b, a, axis);
  });
  unsigned inside = 0;
  for (size_t k = 0; k + 1 < ends.size(); k++) {
    inside ^= ends[k].sets;
    if (inside == ALL &&
        (before(ends[k], ends[k + 1], axis) ||
         before(ends[k + 1], ends[k], axis)) &&
        !along(ends[k], ends[k + 1]))
      return;
  }
}

template <class T>
bool interiors_meet(const Face &f, const Face &g, const std::vector<int> &of_f,
                    const std::vector<int> &of_g) {
  bool meet = false;
  for_each_stretch<T>(f, g, of_f, of_g, [&](const End<T> &, const End<T> &) {
    meet = true;
    return false;
  });
  return meet;
}

bool penetrate(const Face &f, const Face &g) {
  std::vector<int> of_f, of_g;
  if (f.world->mesh.plane[f.id] == f.world->mesh.plane[g.id] ||
      !reaches_through(f, g, of_f) || !reaches_through(g, f, of_g))
    return false;
  try {
    CGAL::Protect_FPU_rounding<true> upwards;
    return interiors_meet<Interval>(f, g, of_f, of_g);
  } catch (const CGAL::Uncertain_conversion_exception &) {
    // Below, with the rounding mode restored.
  }
  return interiors_meet<Exact>(f, g, of_f, of_g);
}

// --- The pairs ---------------------------------------------------------------

using Box = CGAL::Box_intersection_d::Box_with_handle_d<
    double, 3, const uint32_t *, CGAL::Box_intersection_d::ID_FROM_HANDLE>;

Box box_of(const hsr_world *world, const uint32_t *id) {
  Box box(id);
  for (uint32_t k = world->mesh.start[*id]; k < world->mesh.start[*id + 1];
       k++) {
    uint32_t v = world->mesh.vertex[k];
    double p[3] = {world->mesh.x[v], world->mesh.y[v], world->mesh.z[v]};
    box.extend(p);
  }
  return box;
}

} // namespace

namespace hsr {

void for_each_penetration(
    const hsr_world *world, const uint32_t *faces, size_t n,
    const std::function<void(uint32_t f, uint32_t g)> &found) {
  std::vector<Box> boxes;
  boxes.reserve(n);
  for (size_t k = 0; k < n; k++)
    boxes.push_back(box_of(world, faces + k));
  CGAL::box_self_intersection_d(
      boxes.begin(), boxes.end(), [&](const Box &f, const Box &g) {
        if (penetrate({world, *f.handle()}, {world, *g.handle()}))
          found(*f.handle(), *g.handle());
      });
}

void for_each_implied_edge(
    const hsr_world *world, uint32_t f, uint32_t g,
    const std::function<void(const Exact_point &, const Exact_point &)>
        &found) {
  if (world->mesh.deviation[f] > 0 || world->mesh.deviation[g] > 0)
    return;
  const Face a = {world, f}, b = {world, g};
  std::vector<int> of_f, of_g;
  reaches_through(a, b, of_f);
  reaches_through(b, a, of_g);
  const auto point = [](const End<Exact> &end) {
    return Exact_point{end.at, end.denominator};
  };
  for_each_stretch<Exact>(a, b, of_f, of_g,
                          [&](const End<Exact> &from, const End<Exact> &to) {
                            found(point(from), point(to));
                            return true;
                          });
}

} // namespace hsr

enum hsr_status hsr_count_penetrations(const struct hsr_world *world,
                                       const uint32_t *faces, size_t n,
                                       uint64_t *n_pairs,
                                       struct hsr_error *err) {
  try {
    uint64_t count = 0;
    hsr::for_each_penetration(world, faces, n, [&](uint32_t f, uint32_t g) {
      count += !share_vertex({world, f}, {world, g});
    });
    *n_pairs = count;
    return HSR_OK;
  } catch (const std::bad_alloc &) {
    return hsr_fail_nomem(err);
  } catch (...) {
    return hsr_fail(err, HSR_E_INTERNAL, "counting penetrating faces failed");
  }
}
