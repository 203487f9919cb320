// SPDX-License-Identifier: GPL-3.0-or-later
// Shadows, in intervals and in exact numbers.
//
// Notation    docs/shadow-picture.md, reduced to determinants of three rows.
//             Let u point to the light and o be a point of the light ray: for a
//             light, u = L - P and o = L; for a sun, u = L and o = P. Then
//                 row(v)     = det(u, X, v - o),
//                 edge(a, b) = det(u, a - o, b - o).
//             P* is (p, s), and u* is s u. The sign of s is that of c, since
//             t > 0 where f is visible; in parallel it is that of N.F. The eye
//             is in front of f if c, or N.F, is negative.
// Intervals   P lies in a box: E + t D, with t from the exact vertices of f.
//             Every interval below holds the number that it stands for, so a
//             sign is certain if its interval does not hold 0. What is not a
//             number, after an overflow, compares false and decides nothing.
// Rows        most faces are to one side of the row. Doubles tell that of a
//             corner before the intervals: with W and O within e and h of the
//             rounded w and o, W . (v - O) is off by no more than
//                 h |w| + e |v - o| + 3 e h + 6 u sum |w_k (v_k - o_k)|,
//             in sums of sizes, u = 2^-53. This is doubled for the rounding of
//             the bound, and 2^-960 is added for what is below all doubles.
// Exact       as predicates_cgal.cc: a function that is linear in the heading
//             is evaluated at the sample, then along R, then along -U. There is
//             no division.
#include "common/exact/exact_plane.h"
#include "common/exact/order.h"
#include "common/exact/sample_ray.h"
#include "common/exact/shadow.h"
#include "common/polygon/exact_numbers.h"

using namespace hsr;

namespace {

/* The height of a plane at L. */
template <class T> T height_at(const Plane<T> &plane, const double L[4]) {
  const T along = plane.k * dot(plane.normal, vector<T>(L));
  return L[3] > 0 ? along - plane.offset : along;
}

bool is_sun(const double L[4]) {
  return L[3] == 0;
}

/* The number, 0 or 1, of the axis X of docs/shadow-picture.md. */
int across(const double L[4]) {
  return is_sun(L) && L[1] == 0 && L[2] == 0 ? 1 : 0;
}

/* u x X, so that row(v) is its product with v - o. */
template <class T> Vector<T> times_axis(const Vector<T> &u, int axis) {
  return axis == 0 ? Vector<T>{T(0), u.z, -u.y} : Vector<T>{-u.z, T(0), u.x};
}

/* ---- The visible point ---- */

template <class T> struct Point {
  Vector<T> p;
  T s;
};

template <class T>
Point<T> visible_point(const hsr_view &view, const Plane<T> &f,
                       const Heading<T> &at) {
  const Vector<T> kN = f.k * f.normal, E = vector<T>(view.E);
  const T c = f.offset - dot(kN, E);
  if (!view.parallel) {
    const T s = dot(kN, at.s);
    return {s * E + c * at.s, s};
  }
  const Vector<T> F = vector<T>(view.F);
  const T along = dot(kN, F);
  return {along * (at.one * E + at.s) + (at.one * c - dot(kN, at.s)) * F,
          at.one * along};
}

/* ---- By intervals ---- */

Interval around(double x, double error) {
  return Interval(x) + Interval(-error, error);
}

/* 1, -1, or 0 if it cannot be told. */
int certain_sign(const Interval &x) {
  return x.inf() > 0 ? 1 : x.sup() < 0 ? -1 : 0;
}

Vector<Interval> place_of(const hsr_lit_point &point) {
  return {Interval(point.low[0], point.high[0]),
          Interval(point.low[1], point.high[1]),
          Interval(point.low[2], point.high[2])};
}

/* Numbers within the intervals, and how far others are from them. */
void round_vector(const Vector<Interval> &v, double rounded[3], double *error) {
  const Interval part[3] = {v.x, v.y, v.z};
  *error = 0;
  for (int k = 0; k < 3; k++) {
    /* In intervals: a sum of doubles would depend on the mode of rounding. */
    const Interval low = part[k].inf(), high = part[k].sup();
    const double width = (high - low).sup();
    rounded[k] = (low + Interval(width / 2)).sup();
    *error = std::fmax(*error, 2 * width);
  }
}

/* By doubles: 1 or -1, on which side of the row a corner is; 0: it cannot be
 * told. */
int row_side(const hsr_lit_point &point, const hsr_loop &loop, uint32_t k) {
  const size_t v = loop.stride * loop.vertex[k];
  const double *w = point.row, *o = point.from;
  const double d[3] = {loop.x[v] - o[0], loop.y[v] - o[1], loop.z[v] - o[2]};
  const double t[3] = {w[0] * d[0], w[1] * d[1], w[2] * d[2]};
  const double row = t[0] + t[1] + t[2];
  const double terms = std::fabs(t[0]) + std::fabs(t[1]) + std::fabs(t[2]);
  const double size = std::fabs(w[0]) + std::fabs(w[1]) + std::fabs(w[2]);
  const double reach = std::fabs(d[0]) + std::fabs(d[1]) + std::fabs(d[2]);
  const double e = point.row_error, h = point.from_error;
  const double bound =
      2 * (h * size + e * reach + 3 * e * h + 6 * 0x1p-53 * terms) + 0x1p-960;
  return row > bound ? 1 : row < -bound ? -1 : 0;
}

/* Whether the face is certainly to one side of the row: no edge crosses it. */
bool is_beside_row(const hsr_lit_point &point, const hsr_loop &loop) {
  const int side = row_side(point, loop, 0);
  for (uint32_t k = 1; k < loop.n; k++)
    if (row_side(point, loop, k) != side)
      return false;
  return side != 0;
}

/* The sign of the height of P over the rounded plane of g. */
int rough_height(const hsr_mesh &mesh, uint32_t g, const Vector<Interval> &P) {
  const double e = mesh.n_error[g], a = mesh.anchor_error[g];
  const Vector<Interval> N = {around(mesh.nx[g], e), around(mesh.ny[g], e),
                              around(mesh.nz[g], e)};
  const Vector<Interval> A = {around(mesh.px[g], a), around(mesh.py[g], a),
                              around(mesh.pz[g], a)};
  return certain_sign(dot(N, P - A));
}

/* 1: the light ray crosses an odd number of edges to the right; 0: an even
 * number; -1: it cannot be told. */
int rough_parity(const hsr_world &world, uint32_t g, const double L[4],
                 const Vector<Interval> &P) {
  const hsr_loop loop = hsr_face_loop(&world, g);
  const Vector<Interval> l = vector<Interval>(L);
  const Vector<Interval> u = is_sun(L) ? l : l - P, o = is_sun(L) ? P : l;
  const Vector<Interval> w = times_axis(u, across(L));
  Vector<Interval> a = corner<Interval>(loop, loop.n - 1) - o;
  int row_a = certain_sign(dot(w, a)), odd = 0;
  for (uint32_t k = 0; k < loop.n; k++) {
    const Vector<Interval> b = corner<Interval>(loop, k) - o;
    const int row_b = certain_sign(dot(w, b));
    if (!row_a || !row_b)
      return -1;
    if (row_a != row_b) {
      const int edge = certain_sign(det(u, a, b));
      if (!edge)
        return -1;
      odd ^= edge == -row_a;
    }
    a = b;
    row_a = row_b;
  }
  return odd;
}

/* As rough_parity: whether g blocks. */
int roughly_blocks(const hsr_lighting &light, const hsr_lit_point &point,
                   uint32_t g) {
  const hsr_world &world = *light.screen->world;
  if (is_beside_row(point, hsr_face_loop(&world, g)))
    return 0;
  const CGAL::Protect_FPU_rounding<true> upwards;
  const Vector<Interval> P = place_of(point);
  const int height = rough_height(world.mesh, g, P);
  if (height == light.side[g])
    return 0;
  const int odd = rough_parity(world, g, light.light, P);
  return height || !odd ? odd : -1;
}

/* ---- Exactly ---- */

/* One question about a point. */
struct Asked {
  const hsr_view *view;
  hsr_loop f;
  double sx, sy;
  int s; /* the sign of it */
  hsr_tally *tally;
};

/* The perturbed sign of a function that is linear in P*, over s. */
template <class Linear>
int perturbed_sign(const Asked &asked, enum hsr_question question,
                   const Linear &linear) {
  asked.tally->exact[question]++;
  try {
    using T = Exact;
    const hsr_view &view = *asked.view;
    const Plane<T> f = newell_plane<T>(asked.f);
    const Heading<T> headings[] = {at_sample<T>(view, asked.sx, asked.sy),
                                   {vector<T>(view.R), T(0)},
                                   {T(-1) * vector<T>(view.U), T(0)}};
    for (const Heading<T> &h : headings)
      if (const int sign = CGAL::sign(linear(visible_point(view, f, h))))
        return sign * asked.s;
    return 0;
  } catch (...) {
    asked.tally->out_of_memory = true;
    return 1;
  }
}

int row_sign(const Asked &asked, const hsr_loop &g, uint32_t corner_of) {
  const double *L = asked.view->light;
  const int sign =
      perturbed_sign(asked, HSR_ASK_ROW, [&](const Point<Exact> &P) {
        using T = Exact;
        const Vector<T> l = vector<T>(L), v = corner<T>(g, corner_of);
        if (is_sun(L))
          return dot(times_axis(l, across(L)), P.s * v - P.p);
        return dot(times_axis(P.s * l - P.p, across(L)), v - l);
      });
  return sign ? sign : 1;
}

int edge_sign(const Asked &asked, const hsr_loop &g, uint32_t from,
              uint32_t to) {
  const double *L = asked.view->light;
  return perturbed_sign(asked, HSR_ASK_EDGE, [&](const Point<Exact> &P) {
    using T = Exact;
    const Vector<T> l = vector<T>(L);
    const Vector<T> a = corner<T>(g, from), b = corner<T>(g, to);
    if (is_sun(L))
      return P.s * det(l, a, b) - det(l, P.p, b - a);
    return det(P.s * l - P.p, a - l, b - l);
  });
}

int height_sign(const Asked &asked, const hsr_loop &g) {
  return perturbed_sign(asked, HSR_ASK_DEPTH, [&](const Point<Exact> &P) {
    const Plane<Exact> plane = newell_plane<Exact>(g);
    return plane.k * dot(plane.normal, P.p) - P.s * plane.offset;
  });
}

bool exactly_blocks(const Asked &asked, const hsr_loop &g, int side) {
  if (height_sign(asked, g) != -side)
    return false;
  bool odd = false;
  uint32_t a = g.n - 1;
  int row_a = row_sign(asked, g, a);
  for (uint32_t b = 0; b < g.n; b++) {
    const int row_b = row_sign(asked, g, b);
    if (row_a != row_b)
      odd ^= edge_sign(asked, g, a, b) == -row_a;
    a = b;
    row_a = row_b;
  }
  return odd;
}

/* ---- The light's picture ---- */

/* A direction from the light just outside a side of the cube is taken to be on
 * it; what the side shows reaches a little farther. */
constexpr double OUTSIDE = 1 + 0x1p-20, FARTHER = 1 + 0x1p-10;

/* Coordinates of a side: along its axis, and the two across. */
struct Along {
  Interval w, across[2];
};

const Interval &part(const Vector<Interval> &v, int axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

Along along_side(const Vector<Interval> &from_light, int side) {
  const int axis = side / 2;
  const Interval &w = part(from_light, axis);
  return {side % 2 ? -w : w,
          {part(from_light, (axis + 1) % 3), part(from_light, (axis + 2) % 3)}};
}

/* The axis along which a sun shines most. */
int main_axis(const double L[4]) {
  const double x = std::fabs(L[0]), y = std::fabs(L[1]), z = std::fabs(L[2]);
  return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}

/* A point moved along the sun's rays to where its coordinate on the main axis
 * is 0. */
void slide(const double L[4], const Vector<Interval> &p, Interval image[2]) {
  const int axis = main_axis(L);
  const Interval t = part(p, axis) / Interval(L[axis]);
  for (int k = 0; k < 2; k++) {
    const int c = (axis + 1 + k) % 3;
    image[k] = part(p, c) - t * Interval(L[c]);
  }
}

/* Makes a box hold an image, too. A coordinate that is not a number may be
 * anywhere. */
void extend(hsr_light_box *box, const Interval image[2]) {
  for (int k = 0; k < 2; k++) {
    if (!(image[k].inf() <= image[k].sup())) {
      box->low[k] = -INFINITY;
      box->high[k] = INFINITY;
    }
    box->low[k] = std::fmin(box->low[k], image[k].inf());
    box->high[k] = std::fmax(box->high[k], image[k].sup());
  }
}

constexpr hsr_light_box everywhere = {{-INFINITY, -INFINITY},
                                      {INFINITY, INFINITY}};
constexpr hsr_light_box nowhere = {{INFINITY, INFINITY},
                                   {-INFINITY, -INFINITY}};

Vector<Interval> widened(const hsr_loop &loop, uint32_t k,
                         const Interval &reach) {
  const Vector<Interval> v = corner<Interval>(loop, k);
  return {v.x + reach, v.y + reach, v.z + reach};
}

/* Where a ray from the light meets the plane of a face, it meets the face's
 * hull on the same side of the light: the plane is farther from the light than
 * any vertex is from the plane ("Facing" in screen.c). */
bool hull_goes_with_plane(const hsr_lighting &light, uint32_t f) {
  const hsr_mesh &mesh = light.screen->world->mesh;
  if (mesh.deviation[f] == 0)
    return true;
  const double e = mesh.n_error[f], a = mesh.anchor_error[f];
  const Vector<Interval> N = {around(mesh.nx[f], e), around(mesh.ny[f], e),
                              around(mesh.nz[f], e)};
  const Vector<Interval> A = {around(mesh.px[f], a), around(mesh.py[f], a),
                              around(mesh.pz[f], a)};
  const Interval height = dot(N, vector<Interval>(light.light) - A);
  return height.inf() > mesh.deviation[f] || height.sup() < -mesh.deviation[f];
}

/* What is known of all vertices of a face on a side: it is wholly behind the
 * light, or wholly outside of the side by one of its edges. */
struct Seen {
  bool behind = true, before = true, outside[4] = {true, true, true, true};

  void look(const Along &at) {
    behind &= at.w.sup() < 0;
    before &= at.w.inf() > 0;
    for (int k = 0; k < 4; k++) {
      const Interval c = k % 2 ? -at.across[k / 2] : at.across[k / 2];
      outside[k] &= (c - Interval(FARTHER) * at.w).inf() > 0;
    }
  }
  bool not_at_all() const {
    return behind || outside[0] || outside[1] || outside[2] || outside[3];
  }
};

bool box_on_side(const hsr_lighting &light, const hsr_loop &loop, int side,
                 const Interval &reach, hsr_light_box *box) {
  const Vector<Interval> l = vector<Interval>(light.light);
  Seen seen;
  *box = nowhere;
  for (uint32_t k = 0; k < loop.n; k++) {
    const Along at = along_side(widened(loop, k, reach) - l, side);
    seen.look(at);
    if (!seen.before)
      continue;
    const Interval image[] = {at.across[0] / at.w, at.across[1] / at.w};
    extend(box, image);
  }
  if (!seen.before)
    *box = everywhere;
  return !seen.not_at_all();
}

/* Whether any vertex of `of` is on this side of the plane of f. */
bool any_on_side(const hsr_world *world, uint32_t of, uint32_t f, int side) {
  for (uint32_t k = world->mesh.start[of]; k < world->mesh.start[of + 1]; k++)
    if (side_of_plane(world, f, world->mesh.vertex[k]) == side)
      return true;
  return false;
}

} // namespace

/* ---- What modules ask ---- */

enum hsr_status hsr_lighting_init(struct hsr_lighting *lighting,
                                  const struct hsr_screen *screen,
                                  struct hsr_arena *arena,
                                  struct hsr_tally *tally) {
  const hsr_world *world = screen->world;
  const double *L = screen->view->light;
  *lighting = {screen, L, HSR_NEW(arena, signed char, world->n_faces)};
  if (!lighting->side)
    return HSR_E_NOMEM;
  for (uint32_t f = 0; f < world->n_faces; f++) {
    const hsr_loop loop = hsr_plane_loop(world, f);
    lighting->side[f] = static_cast<signed char>(sign_of(
        [&](auto t) { return height_at(newell_plane<decltype(t)>(loop), L); },
        &tally->out_of_memory));
  }
  return HSR_OK;
}

bool hsr_faces_light(const struct hsr_lighting *lighting, uint32_t f,
                     struct hsr_tally *tally) {
  return lighting->side[f] == hsr_eye_side(lighting->screen, f, tally);
}

void hsr_lit_point_find(const struct hsr_lighting *lighting, uint32_t f, int i,
                        int j, struct hsr_lit_point *point) {
  const hsr_view &view = *lighting->screen->view;
  *point = {};
  point->face = f;
  point->sx = hsr_sample_x(&view, i);
  point->sy = hsr_sample_y(&view, j);
  const CGAL::Protect_FPU_rounding<true> upwards;
  const Point<Interval> P = visible_point(
      view, newell_plane<Interval>(hsr_plane_loop(lighting->screen->world, f)),
      at_sample<Interval>(view, point->sx, point->sy));
  const Interval p[3] = {P.p.x / P.s, P.p.y / P.s, P.p.z / P.s};
  for (int k = 0; k < 3; k++) {
    point->low[k] = p[k].inf();
    point->high[k] = p[k].sup();
  }
  const double *L = lighting->light;
  const Vector<Interval> l = vector<Interval>(L), seen = place_of(*point);
  round_vector(times_axis(is_sun(L) ? l : l - seen, across(L)), point->row,
               &point->row_error);
  round_vector(is_sun(L) ? seen : l, point->from, &point->from_error);
}

bool hsr_blocks(const struct hsr_lighting *lighting,
                const struct hsr_lit_point *point, uint32_t g,
                struct hsr_tally *tally) {
  const hsr_screen *screen = lighting->screen;
  const hsr_world *world = screen->world;
  const uint32_t f = point->face;
  if (world->mesh.plane[f] == world->mesh.plane[g])
    return false;
  const int roughly = roughly_blocks(*lighting, *point, g);
  if (roughly >= 0)
    return roughly;
  const Asked asked = {screen->view, hsr_plane_loop(world, f),        point->sx,
                       point->sy,    -hsr_eye_side(screen, f, tally), tally};
  return exactly_blocks(asked, hsr_face_loop(world, g), lighting->side[g]);
}

bool hsr_may_shade(const struct hsr_lighting *lighting, uint32_t g, uint32_t f,
                   struct hsr_tally *tally) {
  const hsr_world *world = lighting->screen->world;
  const hsr_mesh &mesh = world->mesh;
  if (mesh.plane[f] == mesh.plane[g])
    return false;
  try {
    return (mesh.deviation[g] > 0 ||
            any_on_side(world, g, f, lighting->side[f])) &&
           (mesh.deviation[f] > 0 ||
            any_on_side(world, f, g, -lighting->side[g]));
  } catch (...) {
    tally->out_of_memory = true;
    return true;
  }
}

int hsr_light_sides(const struct hsr_lighting *lighting) {
  return is_sun(lighting->light) ? 1 : HSR_LIGHT_SIDES;
}

double hsr_off_hull(const struct hsr_lighting *lighting, uint32_t f) {
  const hsr_world *world = lighting->screen->world;
  if (world->mesh.deviation[f] == 0)
    return 0;
  double low[3] = {INFINITY, INFINITY, INFINITY},
         high[3] = {-INFINITY, -INFINITY, -INFINITY}, size = 0;
  for (uint32_t k = world->mesh.start[f]; k < world->mesh.start[f + 1]; k++) {
    const uint32_t v = world->mesh.vertex[k];
    const double p[3] = {world->mesh.x[v], world->mesh.y[v], world->mesh.z[v]};
    for (int c = 0; c < 3; c++) {
      low[c] = std::fmin(low[c], p[c]);
      high[c] = std::fmax(high[c], p[c]);
    }
  }
  for (int c = 0; c < 3; c++)
    size = std::fmax(size, high[c] - low[c]);
  const double reach = size * 0x1p-8;
  return hsr_grazes(lighting->screen, f, reach) ? INFINITY : reach;
}

bool hsr_light_sees(const struct hsr_lighting *lighting, uint32_t f, int side,
                    double reach, struct hsr_light_box *box) {
  const hsr_world *world = lighting->screen->world;
  const double *L = lighting->light;
  const hsr_loop loop = hsr_face_loop(world, f);
  *box = everywhere;
  if (!std::isfinite(reach))
    return true;
  const CGAL::Protect_FPU_rounding<true> upwards;
  const Interval around_it(-reach, reach);
  if (!is_sun(L))
    return !hull_goes_with_plane(*lighting, f) ||
           box_on_side(*lighting, loop, side, around_it, box);
  *box = nowhere;
  for (uint32_t k = 0; k < loop.n; k++) {
    Interval image[2];
    slide(L, widened(loop, k, around_it), image);
    extend(box, image);
  }
  return true;
}

int hsr_light_image(const struct hsr_lighting *lighting,
                    const struct hsr_lit_point *point,
                    struct hsr_light_box *box) {
  const double *L = lighting->light;
  const CGAL::Protect_FPU_rounding<true> upwards;
  const Vector<Interval> P = place_of(*point);
  Interval image[2];
  int side = 0;
  if (is_sun(L)) {
    slide(L, P, image);
  } else {
    const Vector<Interval> d = P - vector<Interval>(L);
    const double middle[4] = {d.x.inf() + d.x.sup(), d.y.inf() + d.y.sup(),
                              d.z.inf() + d.z.sup(), 1};
    const int axis = main_axis(middle);
    side = 2 * axis + (middle[axis] < 0);
    const Along at = along_side(d, side);
    for (int k = 0; k < 2; k++) {
      image[k] = at.across[k] / at.w;
      if (!(at.w.inf() > 0 && image[k].sup() < OUTSIDE &&
            image[k].inf() > -OUTSIDE))
        return -1;
    }
  }
  for (int k = 0; k < 2; k++) {
    box->low[k] = image[k].inf();
    box->high[k] = image[k].sup();
    if (!std::isfinite(box->low[k]) || !std::isfinite(box->high[k]))
      return -1;
  }
  return side;
}
