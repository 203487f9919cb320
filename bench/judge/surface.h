/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The faces that cover a sample, and their order: what the oracles of surfaces
 * share, in the words of docs/correct-picture.md.
 *
 * Source      docs/correct-picture.md, in whose words this file is written.
 * Input       the world's vertices, face lists and one_sided flags, or of a
 *             roster the scene's objects and instances; and the view's E, F,
 *             R, U, near, m, n, offsets and window; neither the world's
 *             approximate planes nor the view's matrices. The judge shares no
 *             code with whom it judges: neither common/exact/screen.h nor
 *             common/exact/predicates.h, nor the exact number type of the
 *             latter.
 * Notation    as there, but D is taken mn times as long, which keeps all in a
 *             ring; so the definition's t is mn times the depth here. In
 *             parallel projection P - E is taken mn times, and depths are those
 *             of the definition.
 * Method      a ray for each sample; a hierarchy of boxes says which faces it
 *             may meet, and these are put to the definition. A sign is sought
 *             in CGAL's interval arithmetic; where the interval holds zero, it
 *             is taken in exact arithmetic along D, then R, then -U. Of a
 *             roster there is a hierarchy over the instances, and one over
 *             each object's faces, whose boxes are moved into the world as the
 *             ray comes to them; only the faces that it may meet are laid out.
 * Invariants  a box is passed over only if no face in it covers the sample
 *             nearer than matters: passes_by() has the proof, and
 *             box_in_world() that of boxes that are moved.
 * Ties        equal planes: the lowest face id.
 * Departures  none: there is no paper.
 * Cost        some dozens of boxes and a dozen faces a sample, and more where
 *             faces are not exactly planar, for then depth prunes nothing.
 *             Exact only where a sample is within rounding of an edge or of a
 *             line where planes meet, or where they are equal. A roster takes
 *             memory for the faces of its objects and for its instances.
 *
 * Compile with -frounding-math; or, slower, but regardless of rounding modes
 * (valgrind ignores them), with -DCGAL_ALWAYS_ROUND_TO_NEAREST. */
#ifndef HSR_BENCH_JUDGE_SURFACE_H
#define HSR_BENCH_JUDGE_SURFACE_H

#include "algorithms/algorithm.h"
#include "bench/judge/rounding.h"
#include "bench/judge/vectors.h"

#include <CGAL/Gmpzf.h>
#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <new>
#include <vector>

namespace judge::surface {

using Exact = CGAL::Gmpzf;

constexpr double infinity = std::numeric_limits<double>::infinity();

/* The counters of all these oracles. */
enum { ORACLE_BOX, ORACLE_FACE, ORACLE_SIGN };
#define HSR_ORACLE_COUNTERS                                                    \
  {"boxes", "boxes of the hierarchy tested against a ray", HSR_COMPARE},       \
      {"faces", "faces tested for whether they cover a sample", HSR_COMPARE},  \
  {                                                                            \
    "signs", "signs of determinants, by intervals or exactly", HSR_COMPARE     \
  }

/* ---- Sample ---- */

/* Where a determinant is evaluated: at the ray's direction, in parallel at its
 * start, or at a derivative of it. A constant term of the determinant counts
 * `one` times, which is 1 at the ray and 0 at a derivative; in parallel, mn and
 * 0. */
template <class T> struct heading {
  vec<T> d;
  T one;
};

template <class T> struct ray {
  bool parallel;
  vec<T> E, F, R;
  T mn, near;
  heading<T> along_D, along_R, along_minus_U;
};

/* D = F + xR + yU, or P - E = xR + yU, with x = (2 (sx + l) - m)/m and y = (n -
 * 2 (sy + t))/n, times mn. Here m x n is the whole picture, of which the view
 * is the tile that begins at (l, t). */
template <class T> ray<T> make_ray(const hsr_view &view, double sx, double sy) {
  const vec<T> F = lift<T>(view.F[0], view.F[1], view.F[2]);
  const vec<T> R = lift<T>(view.R[0], view.R[1], view.R[2]);
  const vec<T> U = lift<T>(view.U[0], view.U[1], view.U[2]);
  const T m(view.whole_m), n(view.whole_n), zero(0), one(1), two(2);
  const T mn = m * n;
  const T x_mn = (two * (T(sx) + T(view.left)) - m) * n;
  const T y_mn = (n - two * (T(sy) + T(view.top))) * m;

  ray<T> r;
  r.parallel = view.parallel;
  r.E = lift<T>(view.E[0], view.E[1], view.E[2]);
  r.F = F;
  r.R = R;
  r.mn = mn;
  r.near = T(view.near);
  const vec<T> across = x_mn * R + y_mn * U;
  if (view.parallel)
    r.along_D = {across, mn};
  else
    r.along_D = {mn * F + across, one};
  r.along_R = {R, zero};
  r.along_minus_U = {lift<T>(0, 0, 0) - U, zero};
  return r;
}

/* Signs that samples share, once they are known; both empty where so few
 * samples are asked that it would not pay. */
struct memo {
  std::vector<signed char> row; /* a vertex: row(v), the same for all samples of
                                   a row of the picture; UNKNOWN: not yet */
  std::vector<signed char> c;   /* a face: the sign of c, the same for all
                                   samples; UNKNOWN: not yet */
  enum : signed char { UNKNOWN = 2 };
};

/* The sign kept at `index`, found if it is not known. */
template <class Find>
int remember(std::vector<signed char> &kept, uint32_t index, Find find) {
  if (kept.empty())
    return find();
  signed char &known = kept[index];
  if (known == memo::UNKNOWN)
    known = static_cast<signed char>(find());
  return known;
}

struct sample {
  const hsr_world *world; /* that holds the faces; of a roster, those that
                             are laid out for this sample */
  const hsr_view *view;
  hsr_tally *tally;
  double sx, sy;
  memo *known;
  ray<Interval> r; /* holds the ray */

  /* For the boxes, by axis: where the ray starts, its direction D, or F, and
   * 1/D where D is certainly not 0. */
  Interval E[3], D[3], reciprocal[3];
  bool slopes[3];
};

inline sample make_sample(const hsr_job &job, const hsr_world *world,
                          memo *known, double sx, double sy) {
  sample s = {world, job.view, job.tally, sx, sy, known, {}, {}, {}, {}, {}};
  s.r = make_ray<Interval>(*job.view, sx, sy);
  const vec<Interval> &at = s.r.along_D.d;
  const vec<Interval> P = s.r.E + (Interval(1) / s.r.mn) * at;
  const vec<Interval> &E = job.view->parallel ? P : s.r.E;
  const vec<Interval> &D = job.view->parallel ? s.r.F : at;
  const Interval e[3] = {E.x, E.y, E.z}, d[3] = {D.x, D.y, D.z};
  for (int axis = 0; axis < 3; axis++) {
    s.E[axis] = e[axis];
    s.D[axis] = d[axis];
    s.reciprocal[axis] = Interval(1) / d[axis]; /* [-inf, inf] if d holds 0 */
    s.slopes[axis] = CGAL::is_finite(s.reciprocal[axis]);
  }
  return s;
}

/* The perturbed sign of a determinant: value(r, h) is to be linear in h. 0 if
 * it is zero along D, along R and along -U. */
template <class Value>
int perturbed_sign(const sample &s, enum hsr_question question, Value value) {
  HSR_STEP(s.tally, ORACLE_SIGN, HSR_NOTHING, HSR_NOTHING, HSR_NOWHERE, 0);
  const Interval guess = value(s.r, s.r.along_D);
  if (guess.inf() > 0)
    return 1;
  if (guess.sup() < 0)
    return -1;

  s.tally->exact[question]++;
  const Nearest to_nearest;
  const ray<Exact> r = make_ray<Exact>(*s.view, s.sx, s.sy);
  for (const heading<Exact> *h : {&r.along_D, &r.along_R, &r.along_minus_U})
    if (const int sign = CGAL::sign(value(r, *h)))
      return sign;
  return 0;
}

/* ---- Scene ---- */

/* v = V - P: a vertex as it lies from a point. */
template <class T>
vec<T> vertex_from(const vec<T> &P, const hsr_world &world, uint32_t v) {
  return lift<T>(world.mesh.x[v], world.mesh.y[v], world.mesh.z[v]) - P;
}

/* S - kP: the sum of a face's vertices as they lie from a point. */
template <class T>
vec<T> sum_from(const vec<T> &P, const hsr_world &world, uint32_t f) {
  vec<T> sum = lift<T>(0, 0, 0);
  for (uint32_t c = world.mesh.start[f]; c < world.mesh.start[f + 1]; c++)
    sum = sum + vertex_from(P, world, world.mesh.vertex[c]);
  return sum;
}

/* N, the sum of Vi x Vi+1 around the face. The sum is the same from any
 * origin, the polygon being closed; from V0 two of its terms are zero. */
template <class T> vec<T> newell_normal(const hsr_world &world, uint32_t f) {
  const uint32_t *v = world.mesh.vertex + world.mesh.start[f];
  const uint32_t k = hsr_face_size(&world, f);
  const vec<T> V0 = vertex_from(lift<T>(0, 0, 0), world, v[0]);
  vec<T> N = lift<T>(0, 0, 0), b = vertex_from(V0, world, v[1]);
  for (uint32_t i = 2; i < k; i++) {
    const vec<T> a = b;
    b = vertex_from(V0, world, v[i]);
    N = N + cross(a, b);
  }
  return N;
}

/* The plane of a face, as the eye has it. t = c / s with s = kN·D; or in
 * parallel t = -s / c with s = N·(kP - S). Either way, less t is greater s/c,
 * times the length of what the ray is taken at. */
template <class T> struct plane {
  vec<T> kN;
  T e; /* N·(S - kE) */
  T c; /* the same, or kN·F */

  T s(const ray<T> &r, const heading<T> &h) const {
    return r.parallel ? dot(kN, h.d) - h.one * e : dot(kN, h.d);
  }
};

template <class T>
plane<T> make_plane(const ray<T> &r, const hsr_world &world, uint32_t f) {
  const vec<T> N = newell_normal<T>(world, f);
  const vec<T> kN = T(double(hsr_face_size(&world, f))) * N;
  const T e = dot(N, sum_from(r.E, world, f));
  return {kN, e, r.parallel ? dot(kN, r.F) : e};
}

/* Whether all vertices lie in the face's plane: N·(k Vi - S) = 0. */
template <class T>
CGAL::Uncertain<bool> is_planar(const hsr_world &world, uint32_t f) {
  const vec<T> N = newell_normal<T>(world, f);
  bool all_certain = true;
  for (uint32_t c = world.mesh.start[f]; c < world.mesh.start[f + 1]; c++) {
    const vec<T> V = vertex_from(lift<T>(0, 0, 0), world, world.mesh.vertex[c]);
    const CGAL::Uncertain<bool> on =
        CGAL::is_zero(dot(N, sum_from(V, world, f)));
    if (CGAL::certainly_not(on))
      return false;
    all_certain = all_certain && CGAL::is_certain(on);
  }
  return all_certain ? CGAL::Uncertain<bool>(true)
                     : CGAL::Uncertain<bool>::indeterminate();
}

inline bool decide_planar(const hsr_world &world, uint32_t f) {
  if (hsr_face_size(&world, f) == 3)
    return true;
  const CGAL::Uncertain<bool> guess = is_planar<Interval>(world, f);
  if (guess.is_certain())
    return guess.make_certain();
  const Nearest to_nearest;
  return is_planar<Exact>(world, f).make_certain();
}

/* ---- Covering ---- */

/* row(v) = det(D, R, v), or det(F, R, V - P). A vertex in the direction of R
 * counts as positive. */
inline int row(const sample &s, uint32_t v) {
  return remember(s.known->row, v, [&] {
    const int sign =
        perturbed_sign(s, HSR_ASK_ROW, [&](const auto &r, const auto &h) {
          const auto u = vertex_from(r.E, *s.world, v);
          return r.parallel ? det(r.F, r.R, h.one * u - h.d) : det(h.d, r.R, u);
        });
    return sign ? sign : 1;
  });
}

/* edge(a, b) = det(a, b, D), or det(A - P, B - P, F), which is linear in P. 0:
 * the edge's line passes through the eye, or runs along F. */
inline int edge(const sample &s, uint32_t a, uint32_t b) {
  return perturbed_sign(s, HSR_ASK_EDGE, [&](const auto &r, const auto &h) {
    const auto u = vertex_from(r.E, *s.world, a),
               v = vertex_from(r.E, *s.world, b);
    return r.parallel ? h.one * det(u, v, r.F) - det(u - v, h.d, r.F)
                      : det(u, v, h.d);
  });
}

/* Whether an odd number of the face's edges crosses to the right. */
inline bool is_parity_odd(const sample &s, uint32_t f) {
  const hsr_world &world = *s.world;
  bool odd = false;
  uint32_t a = world.mesh.vertex[world.mesh.start[f + 1] - 1];
  int row_a = row(s, a);
  for (uint32_t c = world.mesh.start[f]; c < world.mesh.start[f + 1]; c++) {
    const uint32_t b = world.mesh.vertex[c];
    const int row_b = row(s, b);
    if (row_a != row_b && edge(s, a, b) == -row_a)
      odd = !odd;
    a = b;
    row_a = row_b;
  }
  return odd;
}

/* The sign of c: -1 if the eye is in front of the face's plane, 1 if behind, 0
 * if in it. */
inline int sign_of_c(const sample &s, uint32_t f) {
  return remember(s.known->c, f, [&] {
    return perturbed_sign(s, HSR_ASK_FACING, [&](const auto &r, const auto &h) {
      return make_plane(r, *s.world, f).c * h.one;
    });
  });
}

/* Whether t is positive: N·D has the sign of c. In parallel, near tells that.
 */
inline bool is_ahead(const sample &s, uint32_t f, int side) {
  if (s.r.parallel)
    return true;
  return side ==
         perturbed_sign(s, HSR_ASK_FACING, [&](const auto &r, const auto &h) {
           return make_plane(r, *s.world, f).s(r, h);
         });
}

/* The sign of c - near · kN·D, or of -s - near · c. */
inline int sign_beyond_near(const sample &s, uint32_t f) {
  return perturbed_sign(s, HSR_ASK_NEAR, [&](const auto &r, const auto &h) {
    const auto p = make_plane(r, *s.world, f);
    return r.parallel ? -p.s(r, h) - r.near * h.one * p.c
                      : r.mn * p.c * h.one - r.near * p.s(r, h);
  });
}

/* A face that covers the sample. */
struct hit {
  uint32_t face; /* HSR_BACKGROUND: none */
  int side;      /* the sign of its c */
};

/* Whether face f exists and covers the sample, as *found then tells. */
inline bool covers(const sample &s, uint32_t f, hit *found) {
  const int side = sign_of_c(s, f);
  if (side == 0 || (s.world->mesh.one_sided[f] && side > 0))
    return false;
  if (!is_parity_odd(s, f))
    return false;
  if (!is_ahead(s, f, side) || sign_beyond_near(s, f) != side)
    return false;
  *found = {f, side};
  return true;
}

/* ---- Nearest ---- */

/* By which ties are decided. */
inline uint32_t id_of(const sample &s, uint32_t f) {
  return s.world->id ? s.world->id[f] : f;
}

/* Whether f is to be seen rather than g. The difference of both s/c is taken
 * times both c, whose signs are known. */
inline bool is_nearer(const sample &s, const hit &f, const hit &g) {
  if (g.face == HSR_BACKGROUND)
    return true;
  HSR_COUNT_DEPTHS(s.tally, 1);
  const int sign =
      perturbed_sign(s, HSR_ASK_DEPTH, [&](const auto &r, const auto &h) {
        const auto p = make_plane(r, *s.world, f.face);
        const auto q = make_plane(r, *s.world, g.face);
        return p.s(r, h) * q.c - q.s(r, h) * p.c;
      });
  return sign ? sign == f.side * g.side : id_of(s, f.face) < id_of(s, g.face);
}

/* No hit on the plane of face f is farther than this; infinite if the ray may
 * be parallel to it. */
inline double farthest_depth(const sample &s, uint32_t f) {
  const plane<Interval> p = make_plane(s.r, *s.world, f);
  const Interval at = p.s(s.r, s.r.along_D);
  return (s.r.parallel ? -at / (s.r.mn * p.c) : p.c / at).sup();
}

/* ---- Hierarchy of boxes ---- */

struct box {
  double low[3], high[3];
};

/* What is known of a face's vertices, whatever instance places it: that they
 * are exactly on a plane in every one, or in one along the axes
 * (is_along_axes), or nothing. */
enum planarity : char { UNSURE, ALONG_AXES, ALWAYS };

/* Nodes stand in depth-first order: the first child of an inner node follows
 * it. A leaf has n_items > 0 items, from tree::items[at]. */
struct node {
  box bounds;       /* closed; holds the vertices below */
  uint32_t at;      /* leaf: its first item; inner: its second child */
  uint32_t n_items; /* inner: 0 */
  char axis;        /* inner: the first child lies lower on this axis */
  planarity planar; /* the least of the faces below */
};

/* Halving 2^32 items makes leaves after 30 steps at most. The stack holds one
 * node for each step through the instances, those of a leaf, and one node for
 * each step through an object. */
constexpr uint32_t ITEMS_A_LEAF = 4;
constexpr int STACK_NODES = 30 + ITEMS_A_LEAF + 30;

/* Of faces, or of instances. */
struct tree {
  std::vector<node> nodes; /* the root first; none if there are no items */
  std::vector<uint32_t> items;
};

inline void extend(box *all, const box &part) {
  for (int axis = 0; axis < 3; axis++) {
    all->low[axis] = std::min(all->low[axis], part.low[axis]);
    all->high[axis] = std::max(all->high[axis], part.high[axis]);
  }
}

inline void extend(box *all, double x, double y, double z) {
  extend(all, {{x, y, z}, {x, y, z}});
}

constexpr box empty_box = {{infinity, infinity, infinity},
                           {-infinity, -infinity, -infinity}};

/* Of vertices beyond all range there is none; any number will do. */
inline double finite_middle(double low, double high) {
  const double middle = low / 2 + high / 2;
  return std::isfinite(middle) ? middle : 0;
}

/* Items have bounds(k) and planar(k), k < n. */
template <class Items> struct builder {
  const Items &items;
  tree &made;
  std::vector<std::array<double, 3>> centre; /* of every item's box */

  /* Makes the subtree of items[first .. last) and returns its root's index. */
  uint32_t grow(uint32_t first, uint32_t last);
  void make_leaf(node *leaf, uint32_t first, uint32_t last) const;
  int widest_axis(uint32_t first, uint32_t last) const;
};

template <class Items>
void builder<Items>::make_leaf(node *leaf, uint32_t first,
                               uint32_t last) const {
  *leaf = {empty_box, first, last - first, 0, ALWAYS};
  for (uint32_t i = first; i < last; i++) {
    extend(&leaf->bounds, items.bounds(made.items[i]));
    leaf->planar = std::min(leaf->planar, items.planar(made.items[i]));
  }
}

template <class Items>
int builder<Items>::widest_axis(uint32_t first, uint32_t last) const {
  box all = empty_box;
  for (uint32_t i = first; i < last; i++) {
    const std::array<double, 3> &c = centre[made.items[i]];
    extend(&all, c[0], c[1], c[2]);
  }
  int widest = 0;
  for (int axis = 1; axis < 3; axis++)
    if (all.high[axis] - all.low[axis] > all.high[widest] - all.low[widest])
      widest = axis;
  return widest;
}

template <class Items>
uint32_t builder<Items>::grow(uint32_t first, uint32_t last) {
  const uint32_t self = uint32_t(made.nodes.size());
  made.nodes.emplace_back();
  if (last - first <= ITEMS_A_LEAF) {
    std::sort(&made.items[first], made.items.data() + last);
    make_leaf(&made.nodes[self], first, last);
    return self;
  }

  /* Half the items to either child, by their centres on the widest axis, and by
   * their numbers where these are equal: so every library makes the same tree. */
  const int axis = widest_axis(first, last);
  const uint32_t middle = first + (last - first) / 2;
  uint32_t *all = made.items.data();
  std::nth_element(all + first, all + middle, all + last,
                   [&](uint32_t f, uint32_t g) {
                     const double a = centre[f][size_t(axis)];
                     const double b = centre[g][size_t(axis)];
                     return a != b ? a < b : f < g;
                   });
  const uint32_t one = grow(first, middle);
  const uint32_t two = grow(middle, last);

  node inner = made.nodes[one];
  extend(&inner.bounds, made.nodes[two].bounds);
  inner.at = two;
  inner.n_items = 0;
  inner.axis = char(axis);
  inner.planar = std::min(inner.planar, made.nodes[two].planar);
  made.nodes[self] = inner;
  return self;
}

/* Builds the tree of made->items, out of n. */
template <class Items> void build(const Items &items, uint32_t n, tree *made) {
  builder<Items> b = {items, *made, {}};
  b.centre.resize(n);
  for (uint32_t k : made->items) {
    const box bounds = items.bounds(k);
    for (size_t axis = 0; axis < 3; axis++)
      b.centre[k][axis] = finite_middle(bounds.low[axis], bounds.high[axis]);
  }
  if (!made->items.empty())
    b.grow(0, uint32_t(made->items.size()));
}

/* The faces of a world that is laid out. */
struct world_faces {
  const hsr_world &world;

  box bounds(uint32_t f) const {
    box all = empty_box;
    for (uint32_t c = world.mesh.start[f]; c < world.mesh.start[f + 1]; c++) {
      const uint32_t v = world.mesh.vertex[c];
      extend(&all, world.mesh.x[v], world.mesh.y[v], world.mesh.z[v]);
    }
    return all;
  }
  planarity planar(uint32_t f) const {
    return decide_planar(world, f) ? ALWAYS : UNSURE;
  }
};

/* Whether no face in the box can matter, given that those do not which cover
 * the sample beyond `farthest`; planar: all are exactly so.
 *
 * If the line of the ray, taken in both directions, misses the convex hull of a
 * face's vertices, the polygon does not wind about it: the parity is even, and
 * the face does not cover the sample. If the face is exactly planar and covers
 * it, the hit is, moreover, a point of the hull; it is not behind the eye, and
 * if it is beyond `farthest` the face does not matter. Of a face that is not
 * planar nothing of the kind can be said, its plane may be hit far away from
 * it. So the depths at which the line is in the box are found, and where all
 * faces are planar only those from 0 to `farthest` count.
 *
 * That is so with the displaced ray. But if its line meets the box for all
 * small displacements, their limit, the ray's, meets it, boxes being closed;
 * and the limit of the hits is a point of the ray in the box, at 0 or more, so
 * that if the box begins beyond `farthest` it is certainly farther.
 *
 * Along an axis the line E + t D is in the box for t in ([low, high] - E) / D.
 * Where D may be 0 that has no bounds, and [low, high] - E is compared instead
 * with what the t left by the other axes make of D. All in intervals; a
 * comparison with a NaN is false and passes nothing by. */
inline bool passes_by(const sample &s, const box &bounds, bool planar,
                      double farthest) {
  double enter = planar ? 0 : -infinity;
  double leave = planar ? farthest : infinity;
  Interval slab[3];
  for (int axis = 0; axis < 3; axis++) {
    slab[axis] = Interval(bounds.low[axis], bounds.high[axis]) - s.E[axis];
    if (!s.slopes[axis])
      continue;
    const Interval inside = slab[axis] * s.reciprocal[axis];
    if (inside.inf() > enter)
      enter = inside.inf();
    if (inside.sup() < leave)
      leave = inside.sup();
  }
  if (enter > leave)
    return true;
  if (!CGAL::is_finite(enter) || !CGAL::is_finite(leave))
    return false;
  for (int axis = 0; axis < 3; axis++) {
    if (s.slopes[axis])
      continue;
    const Interval reach = Interval(enter, leave) * s.D[axis];
    if (reach.inf() > slab[axis].sup() || reach.sup() < slab[axis].inf())
      return true;
  }
  return false;
}

/* ---- Instances ---- */

/* Whether each of an instance's coordinates depends on one of the object's at
 * most, and no two on the same. */
inline bool is_along_axes(const hsr_instance &instance) {
  const double *m = instance.m;
  for (int k = 0; k < 3; k++)
    if ((m[4 * k] != 0) + (m[4 * k + 1] != 0) + (m[4 * k + 2] != 0) > 1 ||
        (m[k] != 0) + (m[4 + k] != 0) + (m[8 + k] != 0) > 1)
      return false;
  return true;
}

/* What is to be known of a face for it to be planar in the instance. */
inline planarity needed_in(const hsr_instance &instance) {
  return is_along_axes(instance) ? ALONG_AXES : ALWAYS;
}

/* A box that holds every vertex of the instance that the object has in `part`.
 *
 * It is what hsr_instance_vertex computes, operation by operation, in
 * intervals. If these hold the operands of an addition or a multiplication they
 * hold its result also where that is rounded to nearest: the interval's ends
 * are rounded down and up, and rounding to nearest is not outside of these.
 * (That the sum begins with 0 changes no value.) Nothing is asked of the
 * matrix. */
inline box box_in_world(const double *m, const box &part) {
  box moved;
  for (int row = 0; row < 3; row++, m += 4) {
    Interval sum(0);
    for (int axis = 0; axis < 3; axis++) {
      const Interval range(part.low[axis], part.high[axis]);
      sum = sum + Interval(m[axis]) * range;
    }
    sum = sum + Interval(m[3]);
    moved.low[row] = sum.inf();
    moved.high[row] = sum.sup();
  }
  return moved;
}

/* The faces of an object, in its own coordinates. */
struct object_faces {
  const hsr_object &object;

  const double *corner(uint32_t c) const {
    return object.xyz + 3 * size_t(object.vertex[c]);
  }
  box bounds(uint32_t f) const {
    box all = empty_box;
    for (uint32_t c = object.start[f]; c < object.start[f + 1]; c++)
      extend(&all, corner(c)[0], corner(c)[1], corner(c)[2]);
    return all;
  }
  bool is_upright(uint32_t f, int axis) const;
  planarity planar(uint32_t f) const;
};

/* Whether the corners, seen along the axis, are two points at most. */
inline bool object_faces::is_upright(uint32_t f, int axis) const {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto meet = [&](const double *p, const double *q) {
    return p[u] == q[u] && p[v] == q[v];
  };
  const uint32_t first = object.start[f], last = object.start[f + 1];
  uint32_t other = first;
  for (uint32_t c = first; c < last; c++) {
    if (meet(corner(c), corner(first)))
      continue;
    if (other != first && !meet(corner(c), corner(other)))
      return false;
    other = c;
  }
  return true;
}

/* Along the axes, corners that share a coordinate share again what depends on
 * it. So those of a face across an axis stay on a plane across one; and those
 * that are two points, seen along an axis, stay so, on the plane along it
 * through both. Where nothing depends on one of the object's coordinates, one
 * of the instance's depends on none and is the same for all corners. */
inline planarity object_faces::planar(uint32_t f) const {
  if (object.start[f + 1] - object.start[f] == 3)
    return ALWAYS;
  const box all = bounds(f);
  for (int axis = 0; axis < 3; axis++)
    if (all.low[axis] == all.high[axis] || is_upright(f, axis))
      return ALONG_AXES;
  return UNSURE;
}

/* The instances of a scene, each as a whole. */
struct scene_instances {
  const hsr_scene &scene;
  const std::vector<tree> &objects;

  const node &root(uint32_t i) const {
    return objects[scene.instances[i].object].nodes[0];
  }
  box bounds(uint32_t i) const {
    return box_in_world(scene.instances[i].m, root(i).bounds);
  }
  planarity planar(uint32_t i) const {
    return root(i).planar >= needed_in(scene.instances[i]) ? ALWAYS : UNSURE;
  }
};

/* ---- Faces at hand ---- */

/* Not inlined, so that it is computed after the rounding mode is changed. */
[[gnu::noinline]] inline void place_vertex(const hsr_instance &instance,
                                           const double *in, double out[3]) {
  hsr_instance_vertex(instance.m, in, out);
}

/* The faces that are laid out: all of the world; or of a roster those that
 * the sample may meet, no two sharing a vertex. */
class faces_at_hand {
public:
  faces_at_hand(const hsr_world &all, const hsr_window &asked);
  faces_at_hand(const faces_at_hand &) = delete;
  faces_at_hand &operator=(const faces_at_hand &) = delete;

  void begin_row();
  void begin_sample();
  uint32_t add(uint32_t i, uint32_t k); /* of instance i, face k; its number */

  hsr_world world; /* of a roster: what the definition asks for, no more */
  memo known;

private:
  const hsr_world &whole;
  std::vector<double> x, y, z;
  std::vector<uint32_t> start, vertex, id;
  std::vector<std::array<bool, 1>> one_sided;

  void add_vertex(const hsr_instance &instance, const double *corner);
};

/* A sample asks for a few dozen signs. */
inline faces_at_hand::faces_at_hand(const hsr_world &all,
                                    const hsr_window &asked)
    : world(all), whole(all) {
  const double signs = 32.0 * (asked.x1 - asked.x0) * (asked.y1 - asked.y0);
  if (hsr_is_roster(&whole)) {
    world = {};
  } else if (signs > world.mesh.n_vertices && signs > world.n_faces) {
    known.row.resize(world.mesh.n_vertices);
    known.c.resize(world.n_faces, memo::UNKNOWN);
  }
}

inline void faces_at_hand::begin_row() {
  std::fill(known.row.begin(), known.row.end(), memo::UNKNOWN);
}

inline void faces_at_hand::begin_sample() {
  if (!hsr_is_roster(&whole))
    return;
  world.n_faces = 0;
  for (std::vector<double> *axis : {&x, &y, &z})
    axis->clear();
  start.assign(1, 0);
  vertex.clear();
  id.clear();
  one_sided.clear();
  known.row.clear();
  known.c.clear();
}

inline void faces_at_hand::add_vertex(const hsr_instance &instance,
                                      const double *corner) {
  double placed[3];
  place_vertex(instance, corner, placed);
  vertex.push_back(uint32_t(x.size()));
  x.push_back(placed[0]);
  y.push_back(placed[1]);
  z.push_back(placed[2]);
  known.row.push_back(memo::UNKNOWN);
}

inline uint32_t faces_at_hand::add(uint32_t i, uint32_t k) {
  const hsr_instance &instance = whole.roster.scene->instances[i];
  const hsr_object &object = whole.roster.scene->objects[instance.object];
  const object_faces faces = {object};
  const Nearest to_nearest;
  for (uint32_t c = object.start[k]; c < object.start[k + 1]; c++)
    add_vertex(instance, faces.corner(c));
  start.push_back(uint32_t(vertex.size()));
  id.push_back(whole.roster.first[i] + k);
  one_sided.push_back({object.one_sided});
  known.c.push_back(memo::UNKNOWN);

  world.mesh.x = x.data();
  world.mesh.y = y.data();
  world.mesh.z = z.data();
  world.mesh.start = start.data();
  world.mesh.vertex = vertex.data();
  world.id = id.data();
  world.mesh.one_sided = one_sided.data()->data();
  return world.n_faces++;
}

/* ---- The way of a ray ---- */

/* Over the faces of a world that is laid out; else over the instances, and over
 * the faces of each object. */
struct trees {
  tree world;
  std::vector<tree> objects;
};

inline void build_trees(const hsr_world &world, trees *made) {
  const Upward upward;
  if (!hsr_is_roster(&world)) {
    for (uint32_t f = 0; f < world.n_faces; f++)
      made->world.items.push_back(f);
    build(world_faces{world}, world.n_faces, &made->world);
    return;
  }
  const hsr_scene &scene = *world.roster.scene;
  made->objects.resize(scene.n_objects);
  for (uint32_t o = 0; o < scene.n_objects; o++) {
    const uint32_t n = scene.objects[o].n_faces;
    for (uint32_t k = 0; k < n; k++)
      made->objects[o].items.push_back(k);
    build(object_faces{scene.objects[o]}, n, &made->objects[o]);
  }
  for (uint32_t i = 0; i < scene.n_instances; i++)
    if (!made->objects[scene.instances[i].object].nodes.empty())
      made->world.items.push_back(i);
  build(scene_instances{scene, made->objects}, scene.n_instances, &made->world);
}

/* A node of the world's tree, or of the object's that an instance places. */
struct stop {
  uint32_t at;
  const hsr_instance *instance; /* or NULL */
};

/* The way through the trees of a sample's ray. A Meeting takes each face that
 * covers the sample, by take(s, hit), and knows how far away faces can still
 * matter: `farthest`. */
template <class Meeting> struct way {
  way(const sample &asked, const trees &all, const hsr_scene *scene,
      faces_at_hand *laid_out, Meeting *who)
      : s(asked), t(all), instanced(scene), faces(laid_out), meeting(who) {}

  const sample &s;
  const trees &t;
  const hsr_scene *instanced; /* NULL if the world is laid out */
  faces_at_hand *faces;
  Meeting *meeting;
  stop stack[STACK_NODES];
  int n_stack = 0;

  void go();
  void visit(const stop &here);
  void take(const stop &here, uint32_t item);
  bool upwards(const stop &here, int axis) const;
};

/* A face is put to the definition; of an instance, the object's tree is next.
 */
template <class Meeting>
void way<Meeting>::take(const stop &here, uint32_t item) {
  uint32_t f = item;
  if (instanced && !here.instance) {
    stack[n_stack++] = {0, instanced->instances + item};
    return;
  }
  if (here.instance)
    f = faces->add(uint32_t(here.instance - instanced->instances), item);
  HSR_STEP(s.tally, ORACLE_FACE, HSR_NOTHING, HSR_NOTHING, HSR_NOWHERE, 0);
  hit found;
  if (covers(s, f, &found))
    meeting->take(s, found);
}

/* Whether the ray is likely to meet the first child first. Where an instance is
 * more than turned the guess may be bad, and cost time. */
template <class Meeting>
bool way<Meeting>::upwards(const stop &here, int axis) const {
  if (!here.instance)
    return s.D[axis].sup() > 0;
  double along = 0;
  for (int row = 0; row < 3; row++)
    along += here.instance->m[4 * row + axis] * s.D[row].sup();
  return along > 0;
}

template <class Meeting> void way<Meeting>::visit(const stop &here) {
  const tree &of = here.instance ? t.objects[here.instance->object] : t.world;
  const node &a = of.nodes[here.at];
  const box *bounds = &a.bounds;
  planarity needed = ALWAYS;
  box moved;
  if (here.instance) {
    moved = box_in_world(here.instance->m, a.bounds);
    bounds = &moved;
    needed = needed_in(*here.instance);
  }
  HSR_STEP(s.tally, ORACLE_BOX, HSR_NOTHING, HSR_NOTHING, HSR_NOWHERE, 0);
  if (passes_by(s, *bounds, a.planar >= needed, meeting->farthest))
    return;

  for (uint32_t i = 0; i < a.n_items; i++)
    take(here, of.items[a.at + i]);
  if (a.n_items == 0) {
    const bool first = upwards(here, a.axis);
    stack[n_stack++] = {first ? a.at : here.at + 1, here.instance};
    stack[n_stack++] = {first ? here.at + 1 : a.at, here.instance};
  }
}

template <class Meeting> void way<Meeting>::go() {
  if (!t.world.nodes.empty())
    stack[n_stack++] = {0, nullptr};
  while (n_stack > 0)
    visit(stop(stack[--n_stack]));
}

/* ---- What the oracles do as algorithms ---- */

/* Does the work; nothing is thrown out of here. */
template <class Work>
enum hsr_status guarded(struct hsr_error *err, Work work) noexcept {
  try {
    return work();
  } catch (const std::bad_alloc &) {
    return hsr_fail_nomem(err);
  } catch (const std::exception &e) {
    return hsr_fail(err, HSR_E_INTERNAL, "oracle: %s", e.what());
  } catch (...) {
    return hsr_fail(err, HSR_E_INTERNAL, "oracle: an unknown exception");
  }
}

/* Their `prepare` and `release`. */
inline enum hsr_status prepare(const struct hsr_world *world, const long *,
                               void **prepared, struct hsr_error *err) {
  return guarded(err, [&] {
    if (!judge::is_rounding_honoured())
      return hsr_fail(err, HSR_E_INTERNAL,
                      "oracle: directed rounding has no effect here");
    auto made = std::make_unique<trees>();
    build_trees(*world, made.get());
    *prepared = made.release();
    return HSR_OK;
  });
}

inline void release(void *prepared) {
  delete static_cast<trees *>(prepared);
}

} // namespace judge::surface

#endif
