// SPDX-License-Identifier: GPL-3.0-or-later
// The edges of a world, over CGAL.
//
// Sides       are sorted by their two vertices; equal ones are one edge. A face
//             that runs along them twice has no side there: it is a bridge.
// Implied     edges come from the pairs of faces that penetrate
//             (penetration.cc), exactly.
// Touched     Pairs of an edge and a face with overlapping boxes, by CGAL's
//             box_intersection_d. A pair is dropped if in interval arithmetic
//             it is certain that both ends are on one side of the face's plane,
//             or that the point where the edge meets it is not in the face.
// Simple      By CGAL's is_simple_2, whose predicates are exact, on the
//             coordinate plane that the face faces most.

#include "common/exact/exact_plane.h"
#include "common/lines/edges.h"
#include "common/lines/exact_points.h"

#include <CGAL/Box_intersection_d/Box_with_handle_d.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <numeric>
#include <vector>

namespace {

using namespace hsr;

// --- Arrays in the arena -----------------------------------------------------

template <class T> T *store(hsr_edges *edges, const std::vector<T> &items) {
  T *array =
      static_cast<T *>(hsr_arena_array(&edges->arena, items.size(), sizeof(T)));
  if (!array)
    throw std::bad_alloc();
  std::copy(items.begin(), items.end(), array);
  return array;
}

// Lists of items by a key below n, one after another.
template <class T> class Lists {
public:
  explicit Lists(uint32_t n) : n_(n) {}
  void add(uint32_t key, const T &item) { items_.push_back({key, item}); }
  void store_in(hsr_edges *edges, uint32_t **start, T **flat) {
    std::stable_sort(
        items_.begin(), items_.end(),
        [](const auto &a, const auto &b) { return a.first < b.first; });
    std::vector<uint32_t> starts(size_t(n_) + 1, 0);
    std::vector<T> list;
    for (const auto &item : items_) {
      starts[item.first + 1]++;
      list.push_back(item.second);
    }
    for (uint32_t k = 0; k < n_; k++)
      starts[k + 1] += starts[k];
    *start = store(edges, starts);
    *flat = store(edges, list);
  }

private:
  uint32_t n_;
  std::vector<std::pair<uint32_t, T>> items_;
};

// --- Edges of faces ----------------------------------------------------------

struct Found_side {
  uint32_t a, b;
  hsr_side side;
};

bool at_one_place(const hsr_world *w, uint32_t a, uint32_t b) {
  return w->mesh.x[a] == w->mesh.x[b] && w->mesh.y[a] == w->mesh.y[b] &&
         w->mesh.z[a] == w->mesh.z[b];
}

std::vector<Found_side> find_sides(const hsr_world *world) {
  std::vector<Found_side> sides;
  for (uint32_t f = 0; f < world->n_faces; f++) {
    uint32_t p = world->mesh.vertex[world->mesh.start[f + 1] - 1];
    for (uint32_t k = world->mesh.start[f]; k < world->mesh.start[f + 1]; k++) {
      const uint32_t q = world->mesh.vertex[k];
      if (!at_one_place(world, p, q))
        sides.push_back({std::min(p, q), std::max(p, q), {f, p < q ? 1 : -1}});
      p = q;
    }
  }
  std::stable_sort(sides.begin(), sides.end(),
                   [](const Found_side &s, const Found_side &t) {
                     return s.a != t.a ? s.a < t.a : s.b < t.b;
                   });
  return sides;
}

// The edges in the making.
struct Edges {
  std::vector<hsr_edge_name> name;
  std::vector<uint32_t> a, b, side_start{0};
  std::vector<hsr_side> side;
  std::vector<double> x, y, z; // of the points

  void begin(const hsr_edge_name &edge, uint32_t p, uint32_t q) {
    name.push_back(edge);
    a.push_back(p);
    b.push_back(q);
    side_start.push_back(uint32_t(side.size()));
  }
  void add_side(const hsr_side &one) {
    side.push_back(one);
    side_start.back() = uint32_t(side.size());
  }
};

bool is_again(const Found_side &s, const Found_side &t) {
  return s.a == t.a && s.b == t.b && s.side.face == t.side.face;
}

// The last of an odd number of equal sides of a face is one; of an even number,
// none is.
void add_real(const hsr_world *world, Edges &made) {
  const std::vector<Found_side> sides = find_sides(world);
  for (size_t k = 0, n = 0; k < sides.size(); k++) {
    const Found_side &s = sides[k];
    n++;
    if (k + 1 < sides.size() && is_again(s, sides[k + 1]))
      continue;
    if (n % 2) {
      if (made.name.empty() || made.a.back() != s.a || made.b.back() != s.b)
        made.begin({false, s.a, s.b, 0}, s.a, s.b);
      made.add_side(s.side);
    }
    n = 0;
  }
}

// --- Implied edges ----------------------------------------------------------

uint32_t add_point(Edges &made, hsr_exact_points &exact,
                   const Exact_point &point) {
  const uint32_t number = uint32_t(made.x.size());
  made.x.push_back(exact.rounded(point, 0));
  made.y.push_back(exact.rounded(point, 1));
  made.z.push_back(exact.rounded(point, 2));
  exact.add(point);
  return number;
}

void add_implied(const hsr_world *world, Edges &made, hsr_exact_points &exact) {
  std::vector<uint32_t> all(world->n_faces);
  std::iota(all.begin(), all.end(), 0);
  std::vector<std::pair<uint32_t, uint32_t>> pairs;
  for_each_penetration(
      world, all.data(), all.size(),
      [&](uint32_t f, uint32_t g) { pairs.push_back(std::minmax(f, g)); });
  std::sort(pairs.begin(), pairs.end());
  for (const auto &pair : pairs) {
    uint32_t part = 0;
    for_each_implied_edge(
        world, pair.first, pair.second,
        [&](const Exact_point &from, const Exact_point &to) {
          const uint32_t p = add_point(made, exact, from);
          const uint32_t q = add_point(made, exact, to);
          made.begin({true, pair.first, pair.second, part++}, p, q);
          made.add_side({pair.first, 0});
          made.add_side({pair.second, 0});
        });
  }
}

// --- Faces that an edge touches ---------------------------------------------

// The sign of a number that is known as an interval; 0 if uncertain.
int certain_sign(const Interval &number) {
  return number.inf() > 0 ? 1 : number.sup() < 0 ? -1 : 0;
}

struct Touching {
  const hsr_edges *edges;
  const hsr_world *world;

  // A point, homogeneous.
  Vector3<Interval> at(uint32_t p, Interval &scale) const {
    scale = Interval(1);
    if (p < world->mesh.n_vertices)
      return point<Interval>(world, p);
    const hsr_exact_points::Rough &rough =
        edges->exact->rough[p - world->mesh.n_vertices];
    scale = rough.denominator;
    return {rough.at[0], rough.at[1], rough.at[2]};
  }

  bool is_corner(uint32_t p, uint32_t f) const {
    const uint32_t *first = world->mesh.vertex + world->mesh.start[f];
    const uint32_t *last = world->mesh.vertex + world->mesh.start[f + 1];
    return p < world->mesh.n_vertices && std::find(first, last, p) != last;
  }

  // Whether X is certainly not in the face, seen along an axis.
  bool is_outside(uint32_t f, const Vector3<Interval> &X,
                  const Interval &scale) const {
    // Any axis will do: where the face has no width along it, no turn below is
    // certain.
    const double n[3] = {std::fabs(world->mesh.nx[f]),
                         std::fabs(world->mesh.ny[f]),
                         std::fabs(world->mesh.nz[f])};
    const int drop = n[0] >= n[1] && n[0] >= n[2] ? 0 : n[1] >= n[2] ? 1 : 2;
    const int u = (drop + 1) % 3, v = (drop + 2) % 3;
    const double *c[3] = {world->mesh.x, world->mesh.y, world->mesh.z};
    bool inside = false;
    uint32_t p = world->mesh.vertex[world->mesh.start[f + 1] - 1];
    for (uint32_t k = world->mesh.start[f]; k < world->mesh.start[f + 1]; k++) {
      const uint32_t q = world->mesh.vertex[k];
      const Interval pu = Interval(c[u][p]) * scale - X[u];
      const Interval pv = Interval(c[v][p]) * scale - X[v];
      const Interval qu = Interval(c[u][q]) * scale - X[u];
      const Interval qv = Interval(c[v][q]) * scale - X[v];
      const int above_p = certain_sign(pv), above_q = certain_sign(qv);
      p = q;
      if (above_p && above_p == above_q)
        continue;
      const int turn = certain_sign(pu * qv - pv * qu);
      if (!above_p || !above_q || !turn)
        return false;
      inside ^= turn == above_q;
    }
    return !inside;
  }

  // Whether the edge may touch the face; false is certain. in_plane is certain,
  // too.
  bool touch(uint32_t e, uint32_t f, bool &in_plane) const {
    in_plane = false;
    const uint32_t a = edges->a[e], b = edges->b[e];
    {
      CGAL::Protect_FPU_rounding<true> upwards;
      const FacePlane<Interval> plane(world, f);
      Interval scale_a, scale_b;
      const Vector3<Interval> A = at(a, scale_a), B = at(b, scale_b);
      const Interval ha = height(plane, A, scale_a);
      const Interval hb = height(plane, B, scale_b);
      const int sa = certain_sign(ha), sb = certain_sign(hb);
      if (sa && sa == sb)
        return false;
      if ((sa || sb) && (is_corner(a, f) || is_corner(b, f)))
        return false;
      if (sa && sb) {
        const Interval from = sa > 0 ? ha : -ha, to = sb > 0 ? hb : -hb;
        return !is_outside(f, to * A + from * B, to * scale_a + from * scale_b);
      }
    }
    in_plane = height_sign(a, f) == 0 && height_sign(b, f) == 0;
    return in_plane || !(is_corner(a, f) || is_corner(b, f));
  }

  template <class T>
  static T height(const FacePlane<T> &plane, const Vector3<T> &P,
                  const T &scale) {
    return plane.k * (plane.normal * P) - plane.offset * scale;
  }

  int height_sign(uint32_t p, uint32_t f) const {
    const FacePlane<Exact> plane(world, f);
    if (p < world->mesh.n_vertices)
      return CGAL::sign(height(plane, point<Exact>(world, p), Exact(1)));
    const Exact_point &exact = edges->exact->points[p - world->mesh.n_vertices];
    return CGAL::sign(height(plane, exact.at, exact.denominator));
  }
};

using Box = CGAL::Box_intersection_d::Box_with_handle_d<
    double, 3, const uint32_t *, CGAL::Box_intersection_d::ID_FROM_HANDLE>;

void extend(Box &box, double x, double y, double z) {
  double p[3] = {x, y, z};
  box.extend(p);
}

// The box of a point that may be rounded: by a part of it, or by less than
// 2^-1000 where it has fewer digits.
void extend_around(Box &box, const hsr_edges *edges, uint32_t p) {
  double x[3] = {edges->x[p], edges->y[p], edges->z[p]};
  if (p < edges->world->mesh.n_vertices) {
    extend(box, x[0], x[1], x[2]);
    return;
  }
  for (double by : {-1, 1})
    extend(box, x[0] + by * (0x1p-48 * std::fabs(x[0]) + 0x1p-1000),
           x[1] + by * (0x1p-48 * std::fabs(x[1]) + 0x1p-1000),
           x[2] + by * (0x1p-48 * std::fabs(x[2]) + 0x1p-1000));
}

void find_touched(hsr_edges *edges) {
  const hsr_world *world = edges->world;
  // Each box has a handle of its own: CGAL takes boxes of one handle for one
  // box.
  std::vector<uint32_t> edge(edges->n), face(world->n_faces);
  std::iota(edge.begin(), edge.end(), 0);
  std::iota(face.begin(), face.end(), 0);
  std::vector<Box> of_edges, of_faces;
  for (uint32_t e = 0; e < edges->n; e++) {
    Box box(&edge[e]);
    extend_around(box, edges, edges->a[e]);
    extend_around(box, edges, edges->b[e]);
    of_edges.push_back(box);
  }
  for (uint32_t f = 0; f < world->n_faces; f++) {
    if (!edges->simple[f])
      continue;
    Box box(&face[f]);
    for (uint32_t k = world->mesh.start[f]; k < world->mesh.start[f + 1]; k++)
      extend_around(box, edges, world->mesh.vertex[k]);
    of_faces.push_back(box);
  }
  const Touching touching = {edges, world};
  std::vector<std::pair<uint32_t, hsr_touch>> found;
  CGAL::box_intersection_d(
      of_edges.begin(), of_edges.end(), of_faces.begin(), of_faces.end(),
      [&](const Box &e_box, const Box &f_box) {
        const uint32_t e = *e_box.handle(), f = *f_box.handle();
        for (uint32_t s = edges->side_start[e]; s < edges->side_start[e + 1];
             s++)
          if (edges->side[s].face == f)
            return;
        bool in_plane;
        if (touching.touch(e, f, in_plane))
          found.push_back({e, {f, in_plane}});
      });
  // The order in which CGAL reports them is random.
  std::sort(found.begin(), found.end(), [](const auto &a, const auto &b) {
    return std::make_pair(a.first, a.second.face) <
           std::make_pair(b.first, b.second.face);
  });
  Lists<hsr_touch> touched(edges->n);
  for (const auto &pair : found)
    touched.add(pair.first, pair.second);
  touched.store_in(edges, &edges->touch_start, &edges->touch);
}

// --- Vertices, faces --------------------------------------------------------

void find_ends_and_corners(hsr_edges *edges) {
  const hsr_world *world = edges->world;
  Lists<uint32_t> ends(world->mesh.n_vertices);
  for (uint32_t e = 0; e < edges->n_real; e++) {
    ends.add(edges->a[e], e);
    ends.add(edges->b[e], e);
  }
  ends.store_in(edges, &edges->end_start, &edges->end);
  Lists<hsr_corner> corners(world->mesh.n_vertices);
  for (uint32_t f = 0; f < world->n_faces; f++)
    for (uint32_t k = world->mesh.start[f]; k < world->mesh.start[f + 1]; k++)
      corners.add(world->mesh.vertex[k], {f, k});
  corners.store_in(edges, &edges->corner_start, &edges->corner);
}

bool is_simple(const hsr_world *world, uint32_t f) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  if (world->mesh.deviation[f] > 0)
    return false;
  if (hsr_face_size(world, f) == 3)
    return true;
  const int drop = projection_of(world, f).axis;
  const double *c[3] = {world->mesh.x, world->mesh.y, world->mesh.z};
  std::vector<Kernel::Point_2> polygon;
  for (uint32_t k = world->mesh.start[f]; k < world->mesh.start[f + 1]; k++)
    polygon.emplace_back(c[(drop + 1) % 3][world->mesh.vertex[k]],
                         c[(drop + 2) % 3][world->mesh.vertex[k]]);
  return CGAL::is_simple_2(polygon.begin(), polygon.end(), Kernel());
}

void make(hsr_edges *edges) {
  const hsr_world *world = edges->world;
  edges->simple = static_cast<bool *>(
      hsr_arena_array(&edges->arena, world->n_faces, sizeof(bool)));
  if (!edges->simple)
    throw std::bad_alloc();
  for (uint32_t f = 0; f < world->n_faces; f++)
    edges->simple[f] = is_simple(world, f);

  Edges made;
  made.x.assign(world->mesh.x, world->mesh.x + world->mesh.n_vertices);
  made.y.assign(world->mesh.y, world->mesh.y + world->mesh.n_vertices);
  made.z.assign(world->mesh.z, world->mesh.z + world->mesh.n_vertices);
  edges->exact = new hsr_exact_points;
  add_real(world, made);
  edges->n_real = uint32_t(made.name.size());
  add_implied(world, made, *edges->exact);
  edges->n = uint32_t(made.name.size());
  edges->n_points = uint32_t(made.x.size());
  edges->name = store(edges, made.name);
  edges->a = store(edges, made.a);
  edges->b = store(edges, made.b);
  edges->side_start = store(edges, made.side_start);
  edges->side = store(edges, made.side);
  edges->x = store(edges, made.x);
  edges->y = store(edges, made.y);
  edges->z = store(edges, made.z);
  find_ends_and_corners(edges);
  find_touched(edges);
}

} // namespace

double hsr_exact_points::rounded(const Exact_point &point, int axis) {
  const auto x = quotient(point.at[axis], point.denominator);
  return x.inf() + (x.sup() - x.inf()) / 2;
}

enum hsr_status hsr_edges_init(struct hsr_edges *edges,
                               const struct hsr_world *world,
                               struct hsr_error *err) {
  *edges = hsr_edges();
  edges->world = world;
  try {
    make(edges);
    return HSR_OK;
  } catch (const std::bad_alloc &) {
    return hsr_fail_nomem(err);
  } catch (...) {
    return hsr_fail(err, HSR_E_INTERNAL, "finding the edges failed");
  }
}

void hsr_edges_free(struct hsr_edges *edges) {
  delete edges->exact;
  edges->exact = nullptr;
  hsr_arena_free(&edges->arena);
}
