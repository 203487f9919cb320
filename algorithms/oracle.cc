/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The oracle: the right answer for each sample, from the definition alone.
 *
 * Source      docs/correct-picture.md, in whose words this file is written.
 * Input       the world's vertices, face lists and one_sided flags, and the
 *             view's E, F, R, U, near, m, n, offsets and window; neither the
 *             world's approximate planes nor the view's matrices. The judge
 *             shares no code with whom it judges: neither common/screen.h nor
 *             common/predicates.h, nor the exact number type of the latter.
 * Notation    as there, but D is taken mn times as long, which keeps all in a
 *             ring; so the definition's t is mn times the depth here.
 * Method      a ray for each sample; a hierarchy of boxes says which faces it
 *             may meet, and these are put to the definition. A sign is sought
 *             in CGAL's interval arithmetic; where the interval holds zero, it
 *             is taken in exact arithmetic along D, then R, then -U.
 * Invariants  a box is passed over only if no face in it can be the visible
 *             one: passes_by() has the proof.
 * Ties        equal planes: the lowest face id.
 * Departures  none: there is no paper.
 * Cost        some dozens of boxes and a dozen faces a sample, and more where
 *             faces are not exactly planar, for then depth prunes nothing.
 *             Exact only where a sample is within rounding of an edge or of a
 *             line where planes meet, or where they are equal.
 *
 * Compile with -frounding-math; or, slower, but regardless of rounding modes
 * (valgrind ignores them), with -DCGAL_ALWAYS_ROUND_TO_NEAREST. */
#include "algorithms/algorithm.h"

#include <CGAL/Gmpzf.h>
#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <array>
#include <exception>
#include <limits>
#include <memory>
#include <new>
#include <vector>

namespace {

using Exact = CGAL::Gmpzf;
using Interval = CGAL::Interval_nt<false>; /* only while an Upward lives */

struct Upward : CGAL::Protect_FPU_rounding<true> {};
struct Nearest : CGAL::Protect_FPU_rounding<true> {
  Nearest() : CGAL::Protect_FPU_rounding<true>(CGAL_FE_TONEAREST) {}
};

constexpr double infinity = std::numeric_limits<double>::infinity();

enum { ORACLE_BOX, ORACLE_FACE, ORACLE_SIGN };

/* ---- Vectors, of intervals or of exact numbers ---- */

template <class T> struct vec { T x, y, z; };

template <class T> vec<T> lift(double x, double y, double z) {
  return {T(x), T(y), T(z)};
}

template <class T> vec<T> operator+(const vec<T> &a, const vec<T> &b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <class T> vec<T> operator-(const vec<T> &a, const vec<T> &b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

template <class T> vec<T> operator*(const T &s, const vec<T> &a) {
  return {s * a.x, s * a.y, s * a.z};
}

template <class T> T dot(const vec<T> &a, const vec<T> &b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class T> vec<T> cross(const vec<T> &a, const vec<T> &b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class T> T det(const vec<T> &a, const vec<T> &b, const vec<T> &c) {
  return dot(cross(a, b), c);
}

/* ---- Sample ---- */

/* Where a determinant is evaluated: at the ray's direction, or at a derivative
 * of it. A constant term of the determinant counts `one` times, which is 1 at
 * the direction and 0 at a derivative. */
template <class T> struct heading {
  vec<T> d;
  T one;
};

template <class T> struct ray {
  vec<T> E, R;
  T mn, near;
  heading<T> along_D, along_R, along_minus_U;
};

/* D = F + xR + yU with x = (2 sx - m)/m and y = (n - 2 sy)/n, times mn. */
template <class T> ray<T> make_ray(const hsr_view &view, double sx, double sy) {
  const vec<T> F = lift<T>(view.F[0], view.F[1], view.F[2]);
  const vec<T> R = lift<T>(view.R[0], view.R[1], view.R[2]);
  const vec<T> U = lift<T>(view.U[0], view.U[1], view.U[2]);
  const T m(view.m), n(view.n), zero(0), one(1), two(2);
  const T mn = m * n;
  const T x_mn = (two * T(sx) - m) * n;
  const T y_mn = (n - two * T(sy)) * m;

  ray<T> r;
  r.E = lift<T>(view.E[0], view.E[1], view.E[2]);
  r.R = R;
  r.mn = mn;
  r.near = T(view.near);
  r.along_D = {mn * F + x_mn * R + y_mn * U, one};
  r.along_R = {R, zero};
  r.along_minus_U = {lift<T>(0, 0, 0) - U, zero};
  return r;
}

/* Signs that samples share, once they are known. */
struct memo {
  std::vector<signed char> row; /* a vertex: row(v), the same for all samples of
                                   a row of the picture; 0: not yet known */
  std::vector<signed char> c;   /* a face: the sign of c, the same for all
                                   samples; UNKNOWN: not yet known */
  enum : signed char { UNKNOWN = 2 };
};

struct sample {
  const hsr_world *world;
  const hsr_view *view;
  hsr_tally *tally;
  double sx, sy;
  memo *known;
  ray<Interval> r; /* holds the ray */

  /* For the boxes, by axis: E, D, and 1/D where D is certainly not 0. */
  Interval E[3], D[3], reciprocal[3];
  bool slopes[3];
};

sample make_sample(const hsr_job &job, memo *known, double sx, double sy) {
  sample s = {job.world, job.view, job.tally, sx, sy, known,
              {},        {},       {},        {}, {}};
  s.r = make_ray<Interval>(*job.view, sx, sy);
  const vec<Interval> &E = s.r.E, &D = s.r.along_D.d;
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
  HSR_COUNT(s.tally, ORACLE_SIGN, 1);
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
  return lift<T>(world.x[v], world.y[v], world.z[v]) - P;
}

/* S - kP: the sum of a face's vertices as they lie from a point. */
template <class T>
vec<T> sum_from(const vec<T> &P, const hsr_world &world, uint32_t f) {
  vec<T> sum = lift<T>(0, 0, 0);
  for (uint32_t c = world.start[f]; c < world.start[f + 1]; c++)
    sum = sum + vertex_from(P, world, world.vertex[c]);
  return sum;
}

/* N, the sum of Vi x Vi+1 around the face. The sum is the same from any
 * origin, the polygon being closed; from V0 two of its terms are zero. */
template <class T> vec<T> newell_normal(const hsr_world &world, uint32_t f) {
  const uint32_t *v = world.vertex + world.start[f];
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

/* The plane of a face, as the eye has it: t = c / kN·D. */
template <class T> struct plane {
  vec<T> kN;
  T c; /* N·(S - kE) */
};

template <class T>
plane<T> make_plane(const ray<T> &r, const hsr_world &world, uint32_t f) {
  const vec<T> N = newell_normal<T>(world, f);
  const T k(double(hsr_face_size(&world, f)));
  return {k * N, dot(N, sum_from(r.E, world, f))};
}

/* Whether all vertices lie in the face's plane: N·(k Vi - S) = 0. */
template <class T>
CGAL::Uncertain<bool> is_planar(const hsr_world &world, uint32_t f) {
  const vec<T> N = newell_normal<T>(world, f);
  bool all_certain = true;
  for (uint32_t c = world.start[f]; c < world.start[f + 1]; c++) {
    const vec<T> V = vertex_from(lift<T>(0, 0, 0), world, world.vertex[c]);
    const CGAL::Uncertain<bool> on =
        CGAL::is_zero(dot(N, sum_from(V, world, f)));
    if (CGAL::certainly_not(on))
      return false;
    all_certain = all_certain && CGAL::is_certain(on);
  }
  return all_certain ? CGAL::Uncertain<bool>(true)
                     : CGAL::Uncertain<bool>::indeterminate();
}

bool decide_planar(const hsr_world &world, uint32_t f) {
  if (hsr_face_size(&world, f) == 3)
    return true;
  const CGAL::Uncertain<bool> guess = is_planar<Interval>(world, f);
  if (guess.is_certain())
    return guess.make_certain();
  const Nearest to_nearest;
  return is_planar<Exact>(world, f).make_certain();
}

/* ---- Covering ---- */

/* row(v) = det(D, R, v). A vertex in the direction of R counts as positive. */
int row(const sample &s, uint32_t v) {
  signed char &known = s.known->row[v];
  if (known)
    return known;
  const int sign =
      perturbed_sign(s, HSR_ASK_ROW, [&](const auto &r, const auto &h) {
        return det(h.d, r.R, vertex_from(r.E, *s.world, v));
      });
  return known = sign ? static_cast<signed char>(sign) : 1;
}

/* edge(a, b) = det(a, b, D). 0: the edge's line passes through the eye. */
int edge(const sample &s, uint32_t a, uint32_t b) {
  return perturbed_sign(s, HSR_ASK_EDGE, [&](const auto &r, const auto &h) {
    return det(vertex_from(r.E, *s.world, a), vertex_from(r.E, *s.world, b),
               h.d);
  });
}

/* Whether an odd number of the face's edges crosses to the right. */
bool is_parity_odd(const sample &s, uint32_t f) {
  const hsr_world &world = *s.world;
  bool odd = false;
  uint32_t a = world.vertex[world.start[f + 1] - 1];
  int row_a = row(s, a);
  for (uint32_t c = world.start[f]; c < world.start[f + 1]; c++) {
    const uint32_t b = world.vertex[c];
    const int row_b = row(s, b);
    if (row_a != row_b && edge(s, a, b) == -row_a)
      odd = !odd;
    a = b;
    row_a = row_b;
  }
  return odd;
}

/* The sign of c = N·(S - kE): -1 if the eye is in front of the face's plane,
 * 1 if behind, 0 if in it. */
int sign_of_c(const sample &s, uint32_t f) {
  signed char &known = s.known->c[f];
  if (known == memo::UNKNOWN)
    known = static_cast<signed char>(
        perturbed_sign(s, HSR_ASK_FACING, [&](const auto &r, const auto &h) {
          return make_plane(r, *s.world, f).c * h.one;
        }));
  return known;
}

/* The sign of N·D. */
int sign_of_slope(const sample &s, uint32_t f) {
  return perturbed_sign(s, HSR_ASK_FACING, [&](const auto &r, const auto &h) {
    return dot(make_plane(r, *s.world, f).kN, h.d);
  });
}

/* The sign of c - near · kN·D. */
int sign_beyond_near(const sample &s, uint32_t f) {
  return perturbed_sign(s, HSR_ASK_NEAR, [&](const auto &r, const auto &h) {
    const auto p = make_plane(r, *s.world, f);
    return r.mn * p.c * h.one - r.near * dot(p.kN, h.d);
  });
}

/* A face that covers the sample. */
struct hit {
  uint32_t face; /* HSR_BACKGROUND: none */
  int side;      /* the sign of its c */
};

/* Whether face f exists and covers the sample, as *found then tells. */
bool covers(const sample &s, uint32_t f, hit *found) {
  const int side = sign_of_c(s, f);
  if (side == 0 || (s.world->one_sided[f] && side > 0))
    return false;
  if (!is_parity_odd(s, f))
    return false;
  if (sign_of_slope(s, f) != side || sign_beyond_near(s, f) != side)
    return false;
  *found = {f, side};
  return true;
}

/* ---- Nearest ---- */

/* Whether f is to be seen rather than g. With 1/t = kN·D / c on either side,
 * the difference is taken times both c, whose signs are known. */
bool is_nearer(const sample &s, const hit &f, const hit &g) {
  if (g.face == HSR_BACKGROUND)
    return true;
  HSR_COUNT_DEPTHS(s.tally, 1);
  const int sign =
      perturbed_sign(s, HSR_ASK_DEPTH, [&](const auto &r, const auto &h) {
        const auto p = make_plane(r, *s.world, f.face);
        const auto q = make_plane(r, *s.world, g.face);
        return dot(p.kN, h.d) * q.c - dot(q.kN, h.d) * p.c;
      });
  return sign ? sign == f.side * g.side : f.face < g.face;
}

/* No hit on the plane of face f is farther than this; infinite if the ray may
 * be parallel to it. */
double farthest_depth(const sample &s, uint32_t f) {
  const plane<Interval> p = make_plane(s.r, *s.world, f);
  return (p.c / dot(p.kN, s.r.along_D.d)).sup();
}

/* ---- Hierarchy of boxes ---- */

struct box {
  double low[3], high[3];
};

/* Nodes stand in depth-first order: the first child of an inner node follows
 * it. A leaf has n_faces > 0 faces, from tree::faces[at]. */
struct node {
  box bounds;       /* closed; exactly of the vertices below */
  uint32_t at;      /* leaf: its first face; inner: its second child */
  uint32_t n_faces; /* inner: 0 */
  int axis;         /* inner: the first child lies lower on this axis */
  bool planar;      /* all faces below are exactly planar */
};

/* Halving 2^32 faces makes leaves after 30 steps at most. The stack holds one
 * node for each step, and one more. */
constexpr uint32_t FACES_A_LEAF = 4;
constexpr int STACK_NODES = 40;

struct tree {
  std::vector<node> nodes; /* the root first; none if there are no faces */
  std::vector<uint32_t> faces;
};

void extend(box *all, const box &part) {
  for (int axis = 0; axis < 3; axis++) {
    all->low[axis] = std::min(all->low[axis], part.low[axis]);
    all->high[axis] = std::max(all->high[axis], part.high[axis]);
  }
}

constexpr box empty_box = {{infinity, infinity, infinity},
                           {-infinity, -infinity, -infinity}};

box face_box(const hsr_world &world, uint32_t f) {
  box all = empty_box;
  for (uint32_t c = world.start[f]; c < world.start[f + 1]; c++) {
    const uint32_t v = world.vertex[c];
    const double x = world.x[v], y = world.y[v], z = world.z[v];
    extend(&all, {{x, y, z}, {x, y, z}});
  }
  return all;
}

struct builder {
  const hsr_world &world;
  tree &made;
  std::vector<std::array<double, 3>> centre; /* of every face's box */

  /* Makes the subtree of faces[first .. last) and returns its root's index. */
  uint32_t grow(uint32_t first, uint32_t last);
  void make_leaf(node *leaf, uint32_t first, uint32_t last) const;
  int widest_axis(uint32_t first, uint32_t last) const;
};

void builder::make_leaf(node *leaf, uint32_t first, uint32_t last) const {
  *leaf = {empty_box, first, last - first, 0, true};
  for (uint32_t i = first; i < last; i++) {
    extend(&leaf->bounds, face_box(world, made.faces[i]));
    leaf->planar = leaf->planar && decide_planar(world, made.faces[i]);
  }
}

int builder::widest_axis(uint32_t first, uint32_t last) const {
  box all = empty_box;
  for (uint32_t i = first; i < last; i++) {
    const std::array<double, 3> &c = centre[made.faces[i]];
    extend(&all, {{c[0], c[1], c[2]}, {c[0], c[1], c[2]}});
  }
  int widest = 0;
  for (int axis = 1; axis < 3; axis++)
    if (all.high[axis] - all.low[axis] > all.high[widest] - all.low[widest])
      widest = axis;
  return widest;
}

uint32_t builder::grow(uint32_t first, uint32_t last) {
  const uint32_t self = uint32_t(made.nodes.size());
  made.nodes.emplace_back();
  if (last - first <= FACES_A_LEAF) {
    make_leaf(&made.nodes[self], first, last);
    return self;
  }

  /* Half the faces to either child, by their centres on the widest axis. */
  const int axis = widest_axis(first, last);
  const uint32_t middle = first + (last - first) / 2;
  uint32_t *faces = made.faces.data();
  std::nth_element(faces + first, faces + middle, faces + last,
                   [&](uint32_t f, uint32_t g) {
                     return centre[f][size_t(axis)] < centre[g][size_t(axis)];
                   });
  const uint32_t one = grow(first, middle);
  const uint32_t two = grow(middle, last);

  node inner = made.nodes[one];
  extend(&inner.bounds, made.nodes[two].bounds);
  inner.at = two;
  inner.n_faces = 0;
  inner.axis = axis;
  inner.planar = inner.planar && made.nodes[two].planar;
  made.nodes[self] = inner;
  return self;
}

void build(const hsr_world &world, tree *made) {
  const Upward upward;
  builder b = {world, *made, {}};
  made->faces.resize(world.n_faces);
  b.centre.resize(world.n_faces);
  for (uint32_t f = 0; f < world.n_faces; f++) {
    made->faces[f] = f;
    const box bounds = face_box(world, f);
    for (size_t axis = 0; axis < 3; axis++)
      b.centre[f][axis] = bounds.low[axis] / 2 + bounds.high[axis] / 2;
  }
  if (world.n_faces > 0)
    b.grow(0, world.n_faces);
}

/* Whether no face below the node can be the visible one, given that a covering
 * face has been found whose depth is `farthest` at most.
 *
 * If the line of the ray, taken in both directions, misses the convex hull of a
 * face's vertices, the polygon does not wind about it: the parity is even, and
 * the face does not cover the sample. If the face is exactly planar and covers
 * it, the hit is, moreover, a point of the hull; it is not behind the eye, and
 * if it is beyond `farthest` the face is not the nearest. Of a face that is not
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
bool passes_by(const sample &s, const node &a, double farthest) {
  double enter = a.planar ? 0 : -infinity;
  double leave = a.planar ? farthest : infinity;
  Interval slab[3];
  for (int axis = 0; axis < 3; axis++) {
    slab[axis] = Interval(a.bounds.low[axis], a.bounds.high[axis]) - s.E[axis];
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

/* ---- Visible face ---- */

/* The visible face of the sample at (sx, sy), or HSR_BACKGROUND. Not inlined,
 * so that sx and sy are computed before the rounding mode is changed. */
[[gnu::noinline]] uint32_t visible_face(const hsr_job &job, const tree &t,
                                        memo *known, double sx, double sy) {
  const Upward upward;
  const sample s = make_sample(job, known, sx, sy);
  hit nearest = {HSR_BACKGROUND, 0};
  double farthest = infinity; /* the depth of `nearest` is not greater */

  uint32_t stack[STACK_NODES];
  int n_stack = 0;
  if (!t.nodes.empty())
    stack[n_stack++] = 0;
  while (n_stack > 0) {
    const uint32_t at = stack[--n_stack];
    const node &a = t.nodes[at];
    HSR_COUNT(s.tally, ORACLE_BOX, 1);
    if (passes_by(s, a, farthest))
      continue;

    for (uint32_t i = 0; i < a.n_faces; i++) {
      const uint32_t f = t.faces[a.at + i];
      HSR_COUNT(s.tally, ORACLE_FACE, 1);
      hit found;
      if (covers(s, f, &found) && is_nearer(s, found, nearest)) {
        nearest = found;
        farthest = farthest_depth(s, f);
      }
    }

    /* The child that the ray is likely to meet first is taken first. */
    if (a.n_faces == 0) {
      const bool upwards = s.D[a.axis].sup() > 0;
      stack[n_stack++] = upwards ? a.at : at + 1;
      stack[n_stack++] = upwards ? at + 1 : a.at;
    }
  }
  return nearest.face;
}

/* ---- The algorithm ---- */

/* Whether intervals hold what they should, which they do not where directed
 * rounding is ignored. */
bool is_rounding_honoured() {
  const Upward upward;
  const Interval third = Interval(1) / Interval(3);
  const Interval tenth = Interval(1.1) * Interval(10.1);
  return third.inf() < third.sup() && tenth.inf() < tenth.sup();
}

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

extern "C" {

static enum hsr_status prepare(const struct hsr_world *world, const long *,
                               void **prepared, struct hsr_error *err) {
  return guarded(err, [&] {
    if (!is_rounding_honoured())
      return hsr_fail(err, HSR_E_INTERNAL,
                      "oracle: directed rounding has no effect here");
    auto made = std::make_unique<tree>();
    build(*world, made.get());
    *prepared = made.release();
    return HSR_OK;
  });
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  return guarded(err, [&] {
    const struct hsr_view *view = job->view;
    const struct hsr_window w = view->window;
    const tree &t = *static_cast<const tree *>(job->prepared);
    memo known = {std::vector<signed char>(job->world->n_vertices),
                  std::vector<signed char>(job->world->n_faces, memo::UNKNOWN)};
    for (int j = w.y0; j < w.y1; j++) {
      std::fill(known.row.begin(), known.row.end(), 0);
      for (int i = w.x0; i < w.x1; i++) {
        HSR_TOUCH(job->tally, i, j);
        job->ids[size_t(j) * job->ids_stride + size_t(i)] = visible_face(
            *job, t, &known, hsr_sample_x(view, i), hsr_sample_y(view, j));
      }
    }
    return HSR_OK;
  });
}

static void release(void *prepared) {
  delete static_cast<tree *>(prepared);
}

} /* extern "C" */

constexpr struct hsr_counter counters[] = {
    {"boxes", "boxes of the hierarchy tested against a ray"},
    {"faces", "faces tested for whether they cover a sample"},
    {"signs", "signs of determinants, by intervals or exactly"},
    {nullptr, nullptr}};

constexpr struct hsr_algorithm describe() {
  struct hsr_algorithm a = {};
  a.name = "oracle";
  a.title = "Oracle: exact ray casting from the definition";
  a.authors = "hsr";
  a.source = "docs/correct-picture.md";
  a.taxonomy = HSR_YARDSTICK;
  a.kind = HSR_IDS;
  a.flags = HSR_JUDGE;
  a.counters = counters;
  a.prepare = prepare;
  a.render = render;
  a.release = release;
  return a;
}

} /* namespace */

/* Constant-initialised. Declared first: a const is otherwise private to its
 * file in C++. */
extern "C" const struct hsr_algorithm HSR_ALGORITHM(oracle);
constexpr struct hsr_algorithm description = describe();
const struct hsr_algorithm HSR_ALGORITHM(oracle) = description;
