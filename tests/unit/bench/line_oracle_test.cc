/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The line oracle against answers derived by hand, and against the definition
 * written a second time: the invisibility of one point of an edge, from all
 * faces, without boxes, intervals or changes along the edge.
 *
 * By hand the eye is the origin, with F = (0, 0, -1), R = (1, 0, 0) and
 * U = (0, 1, 0), so that x = X/w, y = Y/w and w = -Z.
 *
 * usage: line_oracle_test [TIMES]      standard: 1, of random scenes */
#include "tests/unit/bench/checks.h"
#include "tests/unit/bench/little_world.h"
#include "common/answers/kinds/segments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

extern "C" const struct hsr_algorithm hsr_counting_line_oracle;

namespace {

const struct hsr_algorithm &oracle = hsr_counting_line_oracle;

struct hsr_view plain_view(double near = 0) {
  return square_view(1, near);
}

using drawing = std::vector<hsr_segment>;

drawing draw(little_world &little, const struct hsr_view &view) {
  const struct hsr_world world = little.world();
  struct hsr_tally tally = {};
  struct hsr_drawing made = {};
  struct hsr_job job = {};
  job.world = &world;
  job.view = &view;
  job.tally = &tally;
  struct hsr_answer answer = hsr_answer_of_drawing(&made, view.m, view.n);
  job.answer = &answer;
  struct hsr_error err = {};
  if (oracle.prepare(&world, nullptr, &job.prepared, &err) ||
      oracle.render(&job, &err)) {
    std::printf("Bail out! %s\n", err.text);
    std::exit(99);
  }
  oracle.release(job.prepared);
  const drawing out(made.segment, made.segment + made.n);
  hsr_drawing_free(&made);
  return out;
}

bool is_same(const hsr_edge_name &a, const hsr_edge_name &b) {
  return hsr_edge_name_compare(&a, &b) == 0;
}

/* The intervals of an edge, as text: "0..0.5=1 0.5..1=0". */
std::string text(const drawing &all, const hsr_edge_name &edge) {
  std::string out;
  for (const hsr_segment &s : all)
    if (is_same(s.edge, edge)) {
      char part[96];
      std::snprintf(part, sizeof part, "%.17g..%.17g=%u", s.t0, s.t1,
                    s.invisibility);
      out += out.empty() ? part : std::string(" ") + part;
    }
  return out;
}

void ok_edge(little_world little, const struct hsr_view &view,
             const hsr_edge_name &edge, const std::string &expected,
             const std::string &what) {
  const std::string got = text(draw(little, view), edge);
  ok(got == expected, what);
  if (got != expected)
    std::printf("# expected %s\n# got      %s\n", expected.c_str(),
                got.c_str());
}

hsr_edge_name side(uint32_t a, uint32_t b) {
  return {false, a, b, 0};
}

/* A triangle whose side from vertex 0 to 1 is tested. Its third vertex is above
 * all pictures, w apart. */
std::vector<point> bearer(const point &a, const point &b) {
  return {a, b, {(a.x + b.x) / 2, 99, (a.z + b.z) / 2 - 1}};
}

std::vector<point> rectangle(double left, double low, double right, double high,
                             double z) {
  return {{left, low, z}, {right, low, z}, {right, high, z}, {left, high, z}};
}

/* ---- By hand ---- */

/* The eye sees the sides x = 1, y = 1 and z = -6 of the cube. */
little_world cube(bool one_sided) {
  little_world w;
  for (int k = 0; k < 8; k++)
    w.add({k & 1 ? 3. : 1., k & 2 ? 3. : 1., k & 4 ? -8. : -6.});
  const bool o = one_sided;
  w.join({0, 1, 3, 2}, o).join({5, 4, 6, 7}, o).join({4, 0, 2, 6}, o);
  w.join({1, 5, 7, 3}, o).join({4, 5, 1, 0}, o).join({2, 3, 7, 6}, o);
  return w;
}

/* Vertex 7 is the hidden one. Each of its edges passes behind two of the three
 * visible sides. The point where it goes from one to the other is no change. */
void test_cube() {
  little_world w = cube(true);
  const drawing seen = draw(w, plain_view());
  bool all_visible = true;
  for (const hsr_segment &s : seen)
    all_visible = all_visible && s.t0 == 0 && s.t1 == 1 && s.invisibility == 0;
  ok(seen.size() == 9 && all_visible, "a one-sided cube: nine whole edges");
  ok(text(seen, side(3, 7)).empty(), "an edge of faces that do not exist");
  ok(text(seen, side(0, 1)) == "0..1=0", "an edge of two that do");

  w = cube(false);
  const drawing all = draw(w, plain_view());
  int n_hidden = 0, n_visible = 0;
  for (const hsr_segment &s : all) {
    const bool whole = s.t0 == 0 && s.t1 == 1;
    n_hidden += whole && s.invisibility == 1 && s.edge.b == 7;
    n_visible += whole && s.invisibility == 0 && s.edge.b != 7;
  }
  ok(all.size() == 12 && n_hidden == 3 && n_visible == 9,
     "a two-sided cube: three hidden edges more");
}

/* The image of the square is |x|, |y| <= 1/2; that of the edge is on y = 0,
 * from x = -3/4 to 5/4. */
void test_before() {
  little_world w;
  w.face(bearer({-6, 0, -8}, {10, 0, -8})).face(rectangle(-2, -2, 2, 2, -4));
  ok_edge(w, plain_view(), side(0, 1),
          "0..0.125=0 0.125..0.625=1 0.625..0.875=0",
          "a square before an edge that leaves the picture");
  little_world behind;
  behind.face(bearer({-6, 0, -8}, {10, 0, -8}));
  behind.face(rectangle(-2, -2, 2, 2, -12));
  ok_edge(behind, plain_view(), side(0, 1), "0..0.875=0", "a square behind it");
}

void test_piercing() {
  little_world w;
  w.face(rectangle(-4, -4, 4, 4, -4));
  w.face({{-1, 0, -2}, {3, 0, -10}, {3, -2, -10}});
  ok_edge(w, plain_view(), side(4, 5), "0..0.25=0 0.25..1=1",
          "an edge pierces a face");
  ok_edge(w, plain_view(), {true, 0, 1, 0}, "0..1=0", "their implied edge");
  bool placed = false;
  for (const hsr_segment &s : draw(w, plain_view()))
    if (s.edge.implied)
      placed = s.from[0] == 0 && s.from[1] == 0 && s.from[2] == -4 &&
               s.to[0] == 0 && s.to[1] == -0.5 && s.to[2] == -4;
  ok(placed, "which runs along the product of the normals");

  /* A comb with two teeth through a plane. */
  little_world comb;
  comb.face(rectangle(-4, -4, 4, 4, -4));
  comb.face({{-2, 1, -6},
             {-2, 1, -3},
             {-1, 1, -3},
             {-1, 1, -5},
             {1, 1, -5},
             {1, 1, -3},
             {2, 1, -3},
             {2, 1, -6}});
  ok_edge(comb, plain_view(), {true, 0, 1, 0}, "0..1=0", "a first stretch");
  ok_edge(comb, plain_view(), {true, 0, 1, 1}, "0..1=0", "and a second one");
  ok_edge(comb, plain_view(), {true, 0, 1, 2}, "", "and no third");

  little_world step; /* a side from X = -1 to 1 lies in the plane */
  step.face(rectangle(-4, -4, 4, 4, -4));
  step.face({{-2, 1, -6},
             {-2, 1, -3},
             {-1, 1, -3},
             {-1, 1, -4},
             {1, 1, -4},
             {1, 1, -6}});
  ok_edge(step, plain_view(), {true, 0, 1, 0}, "0..1=0", "up to a border");
  ok_edge(step, plain_view(), {true, 0, 1, 1}, "", "and not along it");

  little_world notch; /* whose tip is in the plane */
  notch.face(rectangle(-4, -4, 4, 4, -4));
  notch.face({{-2, 1, -6}, {-2, 1, -3}, {0, 1, -4}, {2, 1, -3}, {2, 1, -6}});
  ok_edge(notch, plain_view(), {true, 0, 1, 1}, "0..1=0",
          "divided where a border touches");
}

void test_coplanar() {
  little_world w;
  w.face(rectangle(-2, -2, 2, 2, -4))
      .face({{-1, -1, -4}, {1, -1, -4}, {0, 1, -4}});
  ok_edge(w, plain_view(), side(4, 5), "0..1=0",
          "a face does not hide an edge of its plane");
}

/* The displacement is to the right and, less, down. */
void test_collinear() {
  const auto upright = bearer({0, -1, -8}, {0, 1, -8});
  const auto level = bearer({-1, 0, -8}, {1, 0, -8});
  const struct {
    std::vector<point> edge, square;
    const char *expected, *what;
  } cases[] = {
      {upright, rectangle(0, -2, 2, 2, -4), "0..1=1", "on a left side"},
      {upright, rectangle(-2, -2, 0, 2, -4), "0..1=0", "on a right side"},
      {level, rectangle(-2, -2, 2, 0, -4), "0..1=1", "on an upper side"},
      {level, rectangle(-2, 0, 2, 2, -4), "0..1=0", "on a lower side"}};
  for (const auto &c : cases) {
    little_world w;
    w.face(c.edge).face(c.square);
    ok_edge(w, plain_view(), side(0, 1), c.expected,
            std::string("an edge seen ") + c.what + " of a face before it");
  }
}

void test_picture() {
  const struct {
    point a, b;
    const char *expected, *what;
  } cases[] = {
      {{-4, -1, -4}, {-4, 1, -4}, "0..1=0", "x = -1 is in the picture"},
      {{4, -1, -4}, {4, 1, -4}, "", "x = 1 is not"},
      {{-1, 4, -4}, {1, 4, -4}, "0..1=0", "y = 1 is"},
      {{-1, -4, -4}, {1, -4, -4}, "", "y = -1 is not"},
      {{-8, 0, -4}, {8, 0, -4}, "0.25..0.75=0", "both ends are outside"},
      {{5, 0, -4}, {8, 0, -4}, "", "all is outside"},
      {{1, 0, -2}, {2, 0, -4}, "", "an edge on a line through the eye"},
      {{1, 0, -2}, {1, 0, -2}, "", "no two places"}};
  for (const auto &c : cases) {
    little_world w;
    w.face({c.a, c.b, {0, 50, -1}}); /* does not own the edge it may hide */
    ok_edge(w, plain_view(), side(0, 1), c.expected, c.what);
  }
}

void test_behind() {
  little_world w;
  w.face(bearer({1, 1, -4}, {1, 1, 4}));
  ok_edge(w, plain_view(), side(0, 1), "0..0.375=0",
          "an edge that leads behind the eye");
  ok_edge(w, plain_view(2), side(0, 1), "0..0.25=0", "a nearer end: near");

  /* Each ray hits a floor at y = -1 half-way to the edge. */
  little_world floor;
  floor.face({{-2, -2, -4}, {2, -2, -4}, {0, -3, -4}});
  floor.face({{-10, -1, -10}, {10, -1, -10}, {10, -1, 10}, {-10, -1, 10}});
  ok_edge(floor, plain_view(), side(0, 1), "0..1=1",
          "a face that reaches behind the eye");
  ok_edge(floor, plain_view(3), side(0, 1), "0..1=0",
          "but nothing before near");
  little_world slope;
  slope.face({{-1, -1, -4}, {1, -3, -4}, {-2, -4, -4}});
  slope.face({{-10, -1, -10}, {10, -1, -10}, {10, -1, 10}, {-10, -1, 10}});
  ok_edge(slope, plain_view(2), side(0, 1), "0..0.5=1 0.5..1=0",
          "a change where it is hit at near");
}

/* Normal along z, mean at z = -4, although no vertex is. */
void test_warped() {
  const std::vector<point> saddle = {
      {2, 2, -5}, {-2, 2, -3}, {-2, -2, -5}, {2, -2, -3}};
  for (const auto &[z, expected] :
       {std::pair(-4.5, "0..1=1"), std::pair(-3.5, "0..1=0")}) {
    little_world w;
    w.face(bearer({-0.5, 0, z}, {0.5, 0, z})).face(saddle);
    ok_edge(w, plain_view(), side(0, 1), expected,
            z < -4 ? "an edge behind a warped face's plane"
                   : "an edge before it");
  }
}

void test_t_junction() {
  little_world w;
  w.face({{-3, 1, -8}, {3, 1, -8}, {0, -3, -8}});
  w.face({{0, -3, -8}, {0, 3, -8}, {1, 0, -8}});
  w.face(rectangle(-2, -2, 0, 2, -4));
  w.face(rectangle(0, -2, 2, 0, -4)).face(rectangle(0, 0, 2, 2, -4));
  ok_edge(w, plain_view(), side(0, 1), "0..1=1", "an edge across a T-junction");
  ok_edge(w, plain_view(), side(3, 4), "0..1=1", "an edge along it");
}

void test_stack() {
  little_world w;
  w.face({{0, 0, -800}, {512, 0, -800}, {256, 5, -800}});
  for (int k = 1; k <= 300; k++) {
    const double z = 400 + k, half = z / 2;
    w.face(rectangle(-half, -half, half, half, -z));
  }
  ok_edge(w, plain_view(), side(0, 1), "0..0.78125=300 0.78125..1=0",
          "invisibility 300");
}

/* ---- The definition, a second time ---- */

struct naive_face {
  std::vector<vec> V; /* from the eye */
  std::vector<uint32_t> number;
  vec N, S;
  Q k, c;
  bool exists, flat;

  Q height(const vec &P) const { return dot(N, k * P - S); }
};

struct naive_edge {
  hsr_edge_name name;
  vec A, B; /* from the eye */
};

struct naive {
  vec F, R, U;
  Q near;
  std::vector<naive_face> faces;
  std::vector<naive_edge> edges;

  naive(const little_world &w, const struct hsr_view &v);
  void find_implied(uint32_t f, uint32_t g);
  bool is_own(const naive_face &f, uint32_t number, const hsr_edge_name &e);
  bool covers(const naive_face &f, const displaced &D);
  int invisibility(const naive_edge &e,
                   const Q &t); /* -1: not in the picture */
};

naive::naive(const little_world &w, const struct hsr_view &v)
    : F{v.F[0], v.F[1], v.F[2]}, R{v.R[0], v.R[1], v.R[2]}, U{v.U[0], v.U[1],
                                                              v.U[2]},
      near(v.near) {
  const vec E = {v.E[0], v.E[1], v.E[2]};
  const auto place = [&](uint32_t n) {
    return vec{w.x[n], w.y[n], w.z[n]} - E;
  };
  std::set<std::pair<uint32_t, uint32_t>> pairs;
  for (uint32_t f = 0; f < w.n_faces(); f++) {
    naive_face made = {};
    for (uint32_t c = w.start[f]; c < w.start[f + 1]; c++) {
      made.number.push_back(w.vertex[c]);
      made.V.push_back(place(w.vertex[c]));
    }
    const size_t n = made.V.size();
    for (size_t i = 0; i < n; i++) {
      made.N = made.N + cross(made.V[i], made.V[(i + 1) % n]);
      made.S = made.S + made.V[i];
    }
    made.k = Q(int(n));
    made.c = dot(made.N, made.S);
    made.exists = !w.one_sided[f] || made.c < 0;
    made.flat = true;
    for (const vec &V : made.V)
      made.flat = made.flat && made.height(V) == 0;
    for (size_t i = 0; made.exists && i < n; i++)
      pairs.insert(std::minmax(made.number[i], made.number[(i + 1) % n]));
    faces.push_back(made);
  }
  for (const auto &[a, b] : pairs)
    edges.push_back({side(a, b), place(a), place(b)});
  for (uint32_t f = 0; f < faces.size(); f++)
    for (uint32_t g = f + 1; g < faces.size(); g++)
      if (faces[f].exists && faces[g].exists && faces[f].flat && faces[g].flat)
        find_implied(f, g);
}

/* Whether P is on a side of the face. */
bool is_on_border(const naive_face &f, const vec &P) {
  for (size_t i = 0; i < f.V.size(); i++) {
    const vec &a = f.V[i], &b = f.V[(i + 1) % f.V.size()];
    if (is_null(cross(b - a, P - a)) && dot(P - a, P - b) <= 0)
      return true;
  }
  return false;
}

/* Whether P is inside the face; it is in the face's plane and not on a side.
 * Counts the sides to its right, in two of the coordinates. */
bool is_inside(const naive_face &f, const vec &P) {
  const auto two = [&](const vec &a) {
    return f.N.z != 0   ? std::pair(a.x, a.y)
           : f.N.y != 0 ? std::pair(a.x, a.z)
                        : std::pair(a.y, a.z);
  };
  const auto [x, y] = two(P);
  bool odd = false;
  for (size_t i = 0; i < f.V.size(); i++) {
    const auto [ax, ay] = two(f.V[i]);
    const auto [bx, by] = two(f.V[(i + 1) % f.V.size()]);
    if ((ay > y) != (by > y) && ax + (y - ay) / (by - ay) * (bx - ax) > x)
      odd = !odd;
  }
  return odd;
}

/* Follows the line that both planes share. Something may end wherever it meets
 * the plane that goes through a side and across the side's face. */
void naive::find_implied(uint32_t f, uint32_t g) {
  const naive_face *pair[2] = {&faces[f], &faces[g]};
  const vec direction = cross(pair[0]->N, pair[1]->N);
  if (is_null(direction))
    return;

  /* N·P = N·S / k for both planes, direction·P = 0. */
  const Q p = pair[0]->c / pair[0]->k, q = pair[1]->c / pair[1]->k;
  const vec O =
      Q(1) / dot(direction, direction) *
      (p * cross(pair[1]->N, direction) + q * cross(direction, pair[0]->N));
  std::vector<Q> marks;
  for (const naive_face *face : pair)
    for (size_t i = 0; i < face->V.size(); i++) {
      const vec &a = face->V[i], &b = face->V[(i + 1) % face->V.size()];
      for (const vec &end : {a, b}) /* of a side along the line */
        marks.push_back(dot(direction, end - O) / dot(direction, direction));
      const vec across = cross(face->N, b - a);
      if (dot(across, direction) != 0)
        marks.push_back(dot(across, a - O) / dot(across, direction));
    }
  std::sort(marks.begin(), marks.end());
  marks.erase(std::unique(marks.begin(), marks.end()), marks.end());

  const auto at = [&](const Q &s) { return O + s * direction; };
  const auto is_within = [&](const Q &s) {
    bool inside = true;
    for (const naive_face *face : pair)
      inside = inside && !is_on_border(*face, at(s)) && is_inside(*face, at(s));
    return inside;
  };
  std::optional<Q> begin;
  uint32_t part = 0;
  for (size_t i = 0; i < marks.size(); i++) {
    const bool before = i > 0 && is_within((marks[i - 1] + marks[i]) / 2);
    const bool after =
        i + 1 < marks.size() && is_within((marks[i] + marks[i + 1]) / 2);
    if (before && after && is_within(marks[i]))
      continue;
    if (before)
      edges.push_back({{true, f, g, part++}, at(*begin), at(marks[i])});
    if (after)
      begin = marks[i];
  }
}

bool naive::is_own(const naive_face &f, uint32_t number,
                   const hsr_edge_name &e) {
  if (e.implied)
    return number == e.a || number == e.b;
  for (size_t i = 0; i < f.number.size(); i++) {
    const uint32_t a = f.number[i], b = f.number[(i + 1) % f.number.size()];
    if (std::min(a, b) == e.a && std::max(a, b) == e.b)
      return true;
  }
  return false;
}

bool naive::covers(const naive_face &f, const displaced &D) {
  bool odd = false;
  for (size_t i = 0; i < f.V.size(); i++) {
    const vec &a = f.V[i], &b = f.V[(i + 1) % f.V.size()];
    const int row_a = sign(dot(cross(R, a), D)) < 0 ? -1 : 1;
    const int row_b = sign(dot(cross(R, b), D)) < 0 ? -1 : 1;
    const int edge = sign(dot(cross(a, b), D));
    if (row_a != row_b && edge == -row_a)
      odd = !odd;
  }
  return odd;
}

int naive::invisibility(const naive_edge &e, const Q &t) {
  const vec P = e.A + t * (e.B - e.A);
  if (is_null(cross(e.A, e.B)))
    return -1;
  const Q all = det(F, R, U), w = det(P, R, U) / all;
  if (w <= near)
    return -1;
  const Q x = det(F, P, U) / all / w, y = det(F, R, P) / all / w;
  if (!(-1 <= x && x < 1 && -1 < y && y <= 1))
    return -1;
  const displaced D = {{F + x * R + y * U, R, Q(-1) * U}};
  int n = 0;
  for (uint32_t k = 0; k < faces.size(); k++) {
    const naive_face &f = faces[k];
    if (!f.exists || f.c == 0 || is_own(f, k, e.name) ||
        (f.height(e.A) == 0 && f.height(e.B) == 0) || !covers(f, D))
      continue;
    /* near < t = c / kN·D < w */
    const poly kND = dot(f.k * f.N, D);
    const auto beyond = [&](const Q &depth) {
      return sign(poly{{f.c, 0, 0}} - depth * kND) * sign(kND);
    };
    n += sign(kND) * sign(f.c) > 0 && beyond(near) > 0 && beyond(w) < 0;
  }
  return n;
}

/* ---- Random scenes ---- */

/* A polygon without a Newell normal is no face. */
bool has_normal(const little_world &w, const std::vector<uint32_t> &corners) {
  vec N = {0, 0, 0};
  for (size_t i = 0; i < corners.size(); i++) {
    const uint32_t a = corners[i], b = corners[(i + 1) % corners.size()];
    N = N + cross({w.x[a], w.y[a], w.z[a]}, {w.x[b], w.y[b], w.z[b]});
  }
  return !is_null(N);
}

/* A world with vertices that faces share by number, and others at the same
 * places. */
little_world random_world(dice &d, int n_faces, int size) {
  little_world w;
  while (int(w.n_faces()) < n_faces) {
    std::vector<uint32_t> corners;
    if (d.once_in(3)) {
      for (const point &p : planar_polygon(d, size))
        corners.push_back(w.add(p));
    } else {
      for (int k = d.once_in(4) ? d.from_to(4, 6) : 3; k > 0; k--)
        corners.push_back(w.x.empty() || d.once_in(2)
                              ? w.add(d.lattice(size))
                              : uint32_t(d.below(int(w.x.size()))));
    }
    std::set<uint32_t> distinct(corners.begin(), corners.end());
    if (distinct.size() == corners.size() && has_normal(w, corners))
      w.join(corners, d.once_in(3));
  }
  return w;
}

/* A view towards the middle with any independent F, R, U. Some views are from
 * the middle or an end of a side. */
struct hsr_view random_view(const little_world &w, dice &d, int size) {
  struct hsr_view v = plain_view(d.once_in(2) ? 0 : d.from_to(1, 6) / 8.0);
  point E = d.lattice(size);
  if (d.once_in(4)) {
    const uint32_t f = uint32_t(d.below(int(w.n_faces())));
    const uint32_t *corner = &w.vertex[w.start[f]];
    const uint32_t a = corner[w.start[f + 1] - w.start[f] - 1];
    const uint32_t b =
        corner[d.once_in(4) ? w.start[f + 1] - w.start[f] - 1 : 0];
    E = {(w.x[a] + w.x[b]) / 2, (w.y[a] + w.y[b]) / 2, (w.z[a] + w.z[b]) / 2};
  }
  point F, R, U;
  random_directions(d, E, size, &F, &R, &U);
  const double e[] = {E.x, E.y, E.z}, f[] = {F.x, F.y, F.z};
  const double r[] = {R.x, R.y, R.z}, u[] = {U.x, U.y, U.z};
  for (int axis = 0; axis < 3; axis++) {
    v.E[axis] = e[axis];
    v.F[axis] = f[axis];
    v.R[axis] = d.once_in(3) ? 2 * r[axis] : r[axis];
    v.U[axis] = u[axis];
  }
  if (det(exact(F), {v.R[0], v.R[1], v.R[2]}, exact(U)) == 0)
    for (int axis = 0; axis < 3; axis++)
      v.R[axis] = r[axis];
  return v;
}

/* ---- The comparison ---- */

struct tally {
  long points, wrong, intervals, implied, most;
};

/* The intervals of one edge against single points: anywhere in each interval,
 * within about 1e-12 of its ends, and outside all intervals. Not if an interval
 * is too short for that. */
void compare_edge(naive &slow, const naive_edge &e, const drawing &part,
                  dice &d, tally *count) {
  const auto check = [&](const Q &t, int expected) {
    if (!(0 < t && t < 1))
      return;
    count->points++;
    count->most = std::max(count->most, long(expected));
    const int is = slow.invisibility(e, t);
    if (is == expected)
      return;
    if (!count->wrong++)
      std::printf("# edge %d %u %u %u, t = %g: %d, not %d\n", e.name.implied,
                  e.name.a, e.name.b, e.name.part, CGAL::to_double(t), expected,
                  is);
  };
  const Q tiny(1e-12);
  Q done = 0;
  for (size_t i = 0; i < part.size(); i++) {
    const hsr_segment &s = part[i];
    const Q t0(s.t0), t1(s.t1), length = t1 - t0;
    const int n = int(s.invisibility);
    count->intervals++;
    if (i == 0) {
      check(d.part() * t0, -1);
      check(t0 - tiny * t0 * (1 + d.part()), -1);
    } else {
      count->wrong += t0 != done || part[i - 1].invisibility == s.invisibility;
    }
    if (length > 100 * tiny) {
      for (int k = 0; k < 3; k++)
        check(t0 + d.part() * length, n);
      check(t0 + tiny * (1 + d.part()), n);
      check(t1 - tiny * (1 + d.part()), n);
    }
    done = t1;
    const vec ends[2] = {e.A + t0 * (e.B - e.A), e.A + t1 * (e.B - e.A)};
    for (int k = 0; k < 2; k++) {
      const double *given = k ? s.to : s.from;
      const vec P = ends[k] - vec{given[0], given[1], given[2]};
      if (!(CGAL::abs(P.x) < 1e-6) || !(CGAL::abs(P.y) < 1e-6) ||
          !(CGAL::abs(P.z) < 1e-6))
        count->wrong++;
    }
  }
  if (part.empty()) {
    for (int k = 0; k < 5; k++)
      check(d.part(), -1);
  } else if (1 - done > 100 * tiny) {
    check(done + tiny * (1 + d.part()), -1);
    check(done + (1 + d.part()) / 2 * (1 - done), -1);
  }
}

void compare(little_world &w, const struct hsr_view &v, dice &d, tally *count) {
  naive slow(w, v);
  const drawing got = draw(w, v);
  size_t k = 0;
  for (naive_edge &e : slow.edges) {
    drawing part;
    for (; k < got.size() && is_same(got[k].edge, e.name); k++) {
      part.push_back(got[k]);
      for (int axis = 0; axis < 3; axis++) { /* from the eye */
        part.back().from[axis] -= v.E[axis];
        part.back().to[axis] -= v.E[axis];
      }
    }
    count->implied += e.name.implied && !part.empty();
    compare_edge(slow, e, part, d, count);
  }
  if (k < got.size()) { /* not in order, or of no edge */
    std::printf("# interval %zu is of another edge\n", k);
    count->wrong++;
  }
}

bool agree(drawing got, drawing wanted) {
  const struct hsr_drawing a = {got.data(), got.size(), got.size()};
  const struct hsr_drawing b = {wanted.data(), wanted.size(), wanted.size()};
  struct hsr_drawing_difference difference;
  hsr_drawing_compare(&a, &b, false, &difference);
  return difference.differing == 0;
}

void ok_naive(const std::string &what, unsigned seed, int n_scenes, int n_faces,
              int size, bool rough) {
  tally count = {};
  bool scale_holds = true;
  for (int scene = 0; scene < n_scenes; scene++) {
    dice d = {std::mt19937(seed + unsigned(scene))};
    little_world w = random_world(d, n_faces, size);
    struct hsr_view v = random_view(w, d, size);
    if (rough)
      roughen(w, v);
    const long wrong = count.wrong;
    compare(w, v, d, &count);
    if (count.wrong != wrong)
      std::printf("# seed %u\n", seed + unsigned(scene));

    /* A power of two as a factor changes nothing, even if products leave the
     * range of doubles. */
    if (scene % 4 < 2) {
      const drawing expected = draw(w, v);
      scale(w, v, scene % 4 == 0 ? -300 : 300);
      scale_holds = scale_holds && agree(draw(w, v), expected);
    }
  }
  ok(count.wrong == 0 && count.intervals > 0, what);
  std::printf("# %ld points of %ld intervals, %ld implied edges, invisibility "
              "up to %ld\n",
              count.points, count.intervals, count.implied, count.most);
  ok(scale_holds, "the same 2^300 times as large and as small");
}

/* A polygon, mostly not flat, with a side through the eye. If it is flat, the
 * parity changes with a row. */
void ok_through_eye(unsigned seed, int n_scenes) {
  tally count = {};
  for (int scene = 0; scene < n_scenes; scene++) {
    dice d = {std::mt19937(seed + unsigned(scene))};
    little_world w;
    do
      w = random_world(d, 3, 3);
    while (w.start[1] == 3);
    struct hsr_view v = random_view(w, d, 3);
    const uint32_t a = w.vertex[0], b = w.vertex[1];
    v.E[0] = (w.x[a] + w.x[b]) / 2;
    v.E[1] = (w.y[a] + w.y[b]) / 2;
    v.E[2] = (w.z[a] + w.z[b]) / 2;
    compare(w, v, d, &count);
  }
  ok(count.wrong == 0 && count.intervals > 0, "a side through the eye");
}

/* Quadrilaterals out of plane at depths from w to w + 4, and edges at a depth
 * of about `far`. A ray may hit a face's plane in front of all its vertices,
 * and even if these are behind the eye. */
void ok_warped(unsigned seed, int n_scenes, int w, int far,
               const std::string &what) {
  tally count = {};
  for (int scene = 0; scene < n_scenes; scene++) {
    dice d = {std::mt19937(seed + unsigned(scene))};
    little_world little;
    while (little.n_faces() < 5) {
      std::vector<uint32_t> corners;
      const bool quad = little.n_faces() < 2;
      const int size = quad ? 4 : far / 2;
      for (int k = quad ? 4 : 3; k > 0; k--) {
        const double x = d.from_to(-size, size), y = d.from_to(-size, size);
        const int depth = quad ? w + d.below(5) : far + d.below(2);
        corners.push_back(little.add({x, y, double(-depth)}));
      }
      if (has_normal(little, corners))
        little.join(corners);
    }
    compare(little, plain_view(), d, &count);
  }
  ok(count.wrong == 0 && count.most > 0, what);
}

void test_naive(int times) {
  ok_warped(600, 60 * times, -5, 40, "warped faces behind the eye");
  ok_warped(700, 60 * times, 4, 3, "warped faces behind an edge");
  ok_through_eye(500, 150 * times);
  ok_naive("two faces on a lattice", 1000, 300 * times, 2, 3, false);
  ok_naive("few faces on a lattice", 2000, 60 * times, 6, 3, false);
  ok_naive("many faces on a lattice", 3000, 3 * times, 30, 4, false);
  ok_naive("faces on a wide lattice", 4000, 2 * times, 40, 20, false);
  ok_naive("rounded faces", 5000, 10 * times, 12, 4, true);
}

/* ---- The interface ---- */

/* Faces that penetrate, with the k-th allocation failing, for many k. */
void test_no_memory() {
  little_world w;
  w.face(rectangle(-4, -4, 4, 4, -4));
  w.face({{-1, 0, -2}, {3, 0, -10}, {3, -2, -10}});
  w.face({{-3, -3, -3}, {3, -3, -3}, {1, 1, -7}});
  const struct hsr_world world = w.world();
  const struct hsr_view view = plain_view();
  struct hsr_tally tally = {};
  struct hsr_drawing made = {};
  struct hsr_answer answer = hsr_answer_of_drawing(&made, view.m, view.n);
  struct hsr_job job = {};
  job.world = &world;
  job.view = &view;
  job.tally = &tally;
  job.answer = &answer;
  ok_without_memory(oracle, job, false, [&made] { hsr_drawing_free(&made); });
  hsr_drawing_free(&made);
}

void test_descriptor() {
  ok(!std::strcmp(oracle.name, "line-oracle") &&
         oracle.taxonomy == HSR_YARDSTICK && oracle.flags == HSR_JUDGE &&
         oracle.makes[0].kind == HSR_SEGMENTS,
     "the descriptor");
}

} /* namespace */

int main(int argc, char **argv) {
  test_descriptor();
  test_cube();
  test_before();
  test_piercing();
  test_coplanar();
  test_collinear();
  test_picture();
  test_behind();
  test_warped();
  test_t_junction();
  test_stack();
  test_no_memory();
  test_naive(argc > 1 ? std::atoi(argv[1]) : 1);
  return finish();
}
