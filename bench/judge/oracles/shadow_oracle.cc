/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The shadow oracle: the visible face of each sample, and whether light reaches
 * it, from the definition alone.
 *
 * Source      docs/shadow-picture.md, in whose words this file is written;
 *             bench/judge/surface.h has the faces that cover a sample, and
 *             their order.
 * Method      the visible face as the oracle finds it. Then all faces that a
 *             hierarchy of boxes leaves are put to the definition of blocking,
 *             until one blocks. Determinants are of four rows, taken about a
 *             vertex of the face, which changes none of them; by intervals,
 *             and exactly where these leave a sign open.
 * Invariants  a box is passed over only if no face in it blocks the light:
 *             passes_by() proves that for the eye's ray, and the proof holds
 *             for any ray, from P towards the light. It asks for the part from
 *             0 to 1, or for a sun, for all from 0 on.
 * Cost        that of the oracle, twice or so. */
#include "bench/judge/surface.h"

#include "common/answers/answer.h"
#include "common/answers/kinds/shadowed.h"

namespace {

using namespace judge::surface;
using judge::Interval, judge::det, judge::dot, judge::lift, judge::Nearest,
    judge::Upward, judge::vec;

/* A point of projective space: v and w. */
template <class T> struct point4 {
  vec<T> v;
  T w;
};

template <class T> point4<T> lift4(const double v[3], double w) {
  return {lift<T>(v), T(w)};
}

/* The determinant of four rows, along their last column. */
template <class T>
T det4(const point4<T> &a, const point4<T> &b, const point4<T> &c,
       const point4<T> &d) {
  return d.w * det(a.v, b.v, c.v) - c.w * det(a.v, b.v, d.v) +
         b.w * det(a.v, c.v, d.v) - a.w * det(b.v, c.v, d.v);
}

/* The same point, seen from O. */
template <class T> point4<T> from(const vec<T> &O, const point4<T> &p) {
  return {p.v - p.w * O, p.w};
}

/* h(v, w) = N·(k v − w S), of face g. */
template <class T>
T height(const hsr_world &world, uint32_t g, const point4<T> &p) {
  const vec<T> O = vertex_from(lift<T>(0, 0, 0), world,
                               world.mesh.vertex[world.mesh.start[g]]);
  const point4<T> q = from(O, p);
  const T k(double(hsr_face_size(&world, g)));
  return dot(newell_normal<T>(world, g), k * q.v - q.w * sum_from(O, world, g));
}

/* P*, for a heading: its value, or a derivative. */
template <class T>
point4<T> visible_point(const ray<T> &r, const heading<T> &h,
                        const hsr_world &world, uint32_t f) {
  const plane<T> p = make_plane(r, world, f);
  const T s = p.s(r, h);
  if (!r.parallel)
    return {s * r.E + p.c * h.d, s};
  return {p.c * (h.one * r.E + h.d) - s * r.F, p.c * h.one};
}

/* The light ray of a sample. */
struct light_ray {
  const sample &s; /* of the eye */
  hit seen;        /* f, and the sign of its c, which P*'s w has */
  point4<Interval> at;
};

/* The sign of a determinant that is linear in P: value(L, P*), perturbed. */
template <class Value>
int sign_of(const light_ray &l, enum hsr_question question, Value value) {
  const sample &s = l.s;
  const double *L = s.view->light;
  HSR_STEP(s.tally, ORACLE_SIGN, HSR_NOTHING, HSR_NOTHING, HSR_NOWHERE, 0);
  const Interval guess = value(lift4<Interval>(L, L[3]), l.at);
  if (guess.inf() > 0)
    return l.seen.side;
  if (guess.sup() < 0)
    return -l.seen.side;
  s.tally->exact[question]++;
  const Nearest to_nearest;
  const ray<Exact> r = make_ray<Exact>(*s.view, s.sx, s.sy);
  for (const heading<Exact> *h : {&r.along_D, &r.along_R, &r.along_minus_U})
    if (const int sign =
            CGAL::sign(value(lift4<Exact>(L, L[3]),
                             visible_point(r, *h, *s.world, l.seen.face))))
      return sign * l.seen.side;
  return 0;
}

/* ---- The faces and the light ---- */

/* Signs of h at L, a face; found when they are asked for. */
class light_sides {
public:
  explicit light_sides(const hsr_job &job)
      : world(*job.world), L(job.view->light),
        known(job.world->n_faces, memo::UNKNOWN) {}
  int of(uint32_t g) {
    return remember(known, g, [&] {
      const Interval guess = height(world, g, lift4<Interval>(L, L[3]));
      if (guess.inf() > 0)
        return 1;
      if (guess.sup() < 0)
        return -1;
      const Nearest to_nearest;
      return int(CGAL::sign(height(world, g, lift4<Exact>(L, L[3]))));
    });
  }

private:
  const hsr_world &world;
  const double *L;
  std::vector<signed char> known;
};

/* X: the x-axis, or for a sun along it, the y-axis. */
bool takes_y_axis(const double L[4]) {
  return L[3] == 0 && L[1] == 0 && L[2] == 0;
}

template <class T>
point4<T> vertex_at(const vec<T> &O, const hsr_world &world, uint32_t v) {
  return {vertex_from(O, world, v), T(1)};
}

int row_from_light(const light_ray &l, uint32_t first, uint32_t v) {
  const bool y = takes_y_axis(l.s.view->light);
  const int sign = sign_of(l, HSR_ASK_ROW, [&](const auto &L, const auto &P) {
    using T = std::decay_t<decltype(P.w)>;
    const vec<T> O = vertex_from(lift<T>(0, 0, 0), *l.s.world, first);
    const point4<T> X = {lift<T>(y ? 0 : 1, y ? 1 : 0, 0), T(0)};
    return det4(from(O, L), from(O, P), X, vertex_at(O, *l.s.world, v));
  });
  return sign ? sign : 1;
}

int edge_from_light(const light_ray &l, uint32_t first, uint32_t a,
                    uint32_t b) {
  return sign_of(l, HSR_ASK_EDGE, [&](const auto &L, const auto &P) {
    using T = std::decay_t<decltype(P.w)>;
    const vec<T> O = vertex_from(lift<T>(0, 0, 0), *l.s.world, first);
    return det4(from(O, L), from(O, P), vertex_at(O, *l.s.world, a),
                vertex_at(O, *l.s.world, b));
  });
}

bool is_crossed_oddly(const light_ray &l, uint32_t g) {
  const hsr_world &world = *l.s.world;
  const uint32_t *v = world.mesh.vertex + world.mesh.start[g];
  const uint32_t k = hsr_face_size(&world, g);
  bool odd = false;
  int row_a = row_from_light(l, v[0], v[k - 1]);
  for (uint32_t i = 0, a = v[k - 1]; i < k; i++) {
    const int row_b = row_from_light(l, v[0], v[i]);
    if (row_a != row_b && edge_from_light(l, v[0], a, v[i]) == -row_a)
      odd = !odd;
    a = v[i];
    row_a = row_b;
  }
  return odd;
}

bool blocks(const light_ray &l, uint32_t g, light_sides *sides) {
  const int side = sides->of(g);
  HSR_STEP(l.s.tally, ORACLE_FACE, HSR_NOTHING, HSR_NOTHING, HSR_NOWHERE, 0);
  if (side == 0 || (l.s.world->mesh.one_sided[g] && side < 0))
    return false;
  const int at_P = sign_of(l, HSR_ASK_DEPTH, [&](const auto &, const auto &P) {
    return height(*l.s.world, g, P);
  });
  return at_P == -side && is_crossed_oddly(l, g);
}

/* The sample of a ray from P to the light, for passes_by(). */
sample towards_light(const light_ray &l) {
  sample s = l.s;
  const double *L = s.view->light;
  const vec<Interval> P = (Interval(1) / l.at.w) * l.at.v;
  const vec<Interval> U = lift<Interval>(L) - Interval(L[3]) * P;
  const Interval p[3] = {P.x, P.y, P.z}, u[3] = {U.x, U.y, U.z};
  for (int axis = 0; axis < 3; axis++) {
    s.E[axis] = p[axis];
    s.D[axis] = u[axis];
    s.reciprocal[axis] = Interval(1) / u[axis];
    s.slopes[axis] = CGAL::is_finite(s.reciprocal[axis]);
  }
  return s;
}

bool any_blocks(const light_ray &l, const tree &faces, light_sides *sides) {
  const sample way = towards_light(l);
  const double end = l.s.view->light[3] > 0 ? 1 : infinity;
  uint32_t stack[STACK_NODES];
  int n = 0;
  stack[n++] = 0;
  while (n > 0) {
    const uint32_t at = stack[--n];
    const node &here = faces.nodes[at];
    HSR_STEP(l.s.tally, ORACLE_BOX, HSR_NOTHING, HSR_NOTHING, HSR_NOWHERE, 0);
    if (passes_by(way, here.bounds, here.planar == ALWAYS, end))
      continue;
    for (uint32_t i = 0; i < here.n_items; i++)
      if (blocks(l, faces.items[here.at + i], sides))
        return true;
    if (here.n_items == 0) {
      stack[n++] = here.at;
      stack[n++] = at + 1;
    }
  }
  return false;
}

/* ---- The picture ---- */

struct nearest_face {
  hit nearest = {HSR_BACKGROUND, 0};
  double farthest = infinity; /* the depth of `nearest` is not greater */

  void take(const sample &s, const hit &found) {
    if (!is_nearer(s, found, nearest))
      return;
    nearest = found;
    farthest = farthest_depth(s, found.face);
  }
};

/* The visible face, and whether it is lit. Not inlined, so that sx and sy are
 * computed before the rounding mode is changed. The eye is in front of a plane
 * if its c is negative. */
[[gnu::noinline]] uint32_t look(const hsr_job &job, const trees &t,
                                faces_at_hand *faces, light_sides *sides,
                                double sx, double sy, bool *lit) {
  const Upward upward;
  faces->begin_sample();
  const sample s = make_sample(job, &faces->world, &faces->known, sx, sy);
  nearest_face seen;
  way w(s, t, nullptr, faces, &seen);
  w.go();
  const hit &f = seen.nearest;
  *lit = false;
  if (f.face == HSR_BACKGROUND)
    return f.face;
  const light_ray l = {s, f, visible_point(s.r, s.r.along_D, *s.world, f.face)};
  *lit = sides->of(f.face) == -f.side && !any_blocks(l, t.world, sides);
  return f.face;
}

/* ---- The algorithm ---- */

extern "C" {

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  return guarded(err, [&] {
    const struct hsr_view *view = job->view;
    const struct hsr_window w = view->window;
    const trees &t = *static_cast<const trees *>(job->prepared);
    faces_at_hand faces(*job->world, w);
    light_sides sides(*job);
    const struct hsr_shadowed *shadowed = hsr_answer_shadowed_of(job->answer);
    for (int j = w.y0; j < w.y1; j++) {
      faces.begin_row();
      for (int i = w.x0; i < w.x1; i++) {
        HSR_TOUCH(job->tally, i, j);
        const size_t at = size_t(j) * size_t(job->answer->m) + size_t(i);
        shadowed->ids[at] = look(*job, t, &faces, &sides, hsr_sample_x(view, i),
                                 hsr_sample_y(view, j), &shadowed->lit[at]);
      }
    }
    return HSR_OK;
  });
}

} /* extern "C" */

constexpr struct hsr_counter counters[] = {HSR_ORACLE_COUNTERS, {nullptr}};

constexpr struct hsr_algorithm describe() {
  struct hsr_algorithm a = {};
  a.name = "shadow-oracle";
  a.title = "Shadow oracle: an exact light ray a sample";
  a.authors = "hsr";
  a.source = "docs/shadow-picture.md";
  a.taxonomy = HSR_YARDSTICK;
  a.subjects = 1 << HSR_FACES;
  a.makes[0].kind = HSR_SHADOWED;
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
extern "C" const struct hsr_algorithm HSR_ALGORITHM(shadow_oracle);
constexpr struct hsr_algorithm description = describe();
const struct hsr_algorithm HSR_ALGORITHM(shadow_oracle) = description;
