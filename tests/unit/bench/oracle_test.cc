/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The oracle against answers derived by hand, and against the definition
 * written a second time, without boxes, intervals or cleverness.
 *
 * Pictures by hand are n x n samples of a world whose eye is the origin, with
 * F = (0, 0, -1), R = (1, 0, 0) and U = (0, 1, 0). Sample (i, j) then looks
 * through the point (2i + 1 - n, n - 1 - 2j) of the plane z = -n, so that for
 * n = 8 the columns are at X = -7, -5, ..., 7 and the rows at Y = 7, 5, ...,
 * -7. So the samples that a face of that plane covers can be read off: a sample
 * on an edge counts as a little to its right and, much less, below it. */
#include "tests/unit/bench/checks.h"
#include "tests/unit/bench/little_world.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <random>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

extern "C" const struct hsr_algorithm hsr_counting_oracle;

namespace {

const struct hsr_algorithm &oracle = hsr_counting_oracle;

struct hsr_view plain_view(int n, double near = 0) {
  return square_view(n, near);
}

using picture = std::vector<uint32_t>;

/* An id that no picture holds, for samples that must not be written. */
constexpr uint32_t UNTOUCHED = 0xDEADBEEF;

/* Renders the view's window on a prepared object. */
picture render(const struct hsr_world &world, const struct hsr_view &view,
               void *prepared) {
  struct hsr_tally tally = {};
  picture ids(size_t(view.m) * size_t(view.n), UNTOUCHED);
  struct hsr_job job = {};
  job.world = &world;
  job.view = &view;
  job.prepared = prepared;
  job.tally = &tally;
  struct hsr_answer answer = hsr_answer_of_ids(ids.data(), view.m, view.n);
  job.answer = &answer;
  struct hsr_error err = {};
  if (oracle.render(&job, &err) != HSR_OK)
    std::printf("# render: %s\n", err.text);
  return ids;
}

picture see(little_world &little, const struct hsr_view &view) {
  const struct hsr_world world = little.world();
  void *prepared = nullptr;
  struct hsr_error err = {};
  if (oracle.prepare(&world, nullptr, &prepared, &err) != HSR_OK) {
    std::printf("# prepare: %s\n", err.text);
    return {};
  }
  const picture ids = render(world, view, prepared);
  oracle.release(prepared);
  return ids;
}

/* A picture as text: a digit for each of the faces 0 to 9, '.' for the
 * background, '?' for anything else. */
std::string text(const picture &ids, int m) {
  std::string out;
  for (size_t k = 0; k < ids.size(); k++) {
    out += ids[k] < 10                ? char('0' + ids[k])
           : ids[k] == HSR_BACKGROUND ? '.'
                                      : '?';
    if ((k + 1) % size_t(m) == 0)
      out += '\n';
  }
  return out;
}

void ok_text(const std::string &got, const std::string &expected,
             const std::string &what) {
  ok(got == expected, what);
  if (got != expected)
    std::printf("# expected\n%s# got\n%s", expected.c_str(), got.c_str());
}

void ok_picture(little_world little, const struct hsr_view &view,
                const std::string &expected, const std::string &what) {
  ok_text(text(see(little, view), view.m), expected, what);
}

std::string rows(int n, const std::string &row) {
  std::string all;
  while (n-- > 0)
    all += row + "\n";
  return all;
}

/* ---- By hand ---- */

/* The two halves of a square whose corners and diagonal are on samples, in the
 * plane z = -8. */
const point NW = {-5, 5, -8}, SW = {-5, -5, -8}, SE = {5, -5, -8},
            NE = {5, 5, -8};

/* The left edge is X = -5, the top edge Y = 5: samples on them are displaced
 * inwards. The diagonal is X = Y, with the face above it: samples on it are
 * displaced outwards. So the face covers -5 <= X < Y <= 5. */
const char *const upper_half = "........\n"
                               ".00000..\n"
                               ".0000...\n"
                               ".000....\n"
                               ".00.....\n"
                               ".0......\n"
                               "........\n"
                               "........\n";

void test_triangle() {
  const auto less = [](const point &a, const point &b) {
    return std::tie(a.x, a.y) < std::tie(b.x, b.y);
  };
  std::vector<point> corners = {SW, NW, NE}; /* the first order by `less` */
  std::string got;
  bool same = true;
  do {
    little_world w;
    got = text(see(w.face(corners), plain_view(8)), 8);
    same = same && got == upper_half;
  } while (std::next_permutation(corners.begin(), corners.end(), less));
  ok_text(got, upper_half, "triangle with samples on edges and vertices");
  ok(same, "the same in all six orders of its vertices");

  /* Vertices moved along their rays: another plane, the same picture. */
  ok_picture(
      little_world().face({NW, {2 * SW.x, 2 * SW.y, 2 * SW.z}, {15, 15, -24}}),
      plain_view(8), upper_half, "the same triangle in an oblique plane");

  /* F, R, U may have any length that a double can be, even if D's length is not
   * a double. */
  for (int exponent : {-1040, 1020}) {
    struct hsr_view view = plain_view(8);
    view.F[2] = std::ldexp(view.F[2], exponent);
    view.R[0] = std::ldexp(view.R[0], exponent);
    view.U[1] = std::ldexp(view.U[1], exponent);
    ok_picture(little_world().face(corners), view, upper_half,
               "the same in a view of 2^" + std::to_string(exponent));
  }
}

/* Below the diagonal: -5 < Y <= X < 5, without right and bottom edges. Together
 * the halves have each sample of the square, -5 <= X < 5 and -5 < Y <= 5,
 * exactly once. */
void test_shared_edge() {
  const std::string both = "........\n"
                           ".00000..\n"
                           ".00001..\n"
                           ".00011..\n"
                           ".00111..\n"
                           ".01111..\n"
                           "........\n"
                           "........\n";
  ok_picture(little_world().face({NW, SW, NE}).face({SW, SE, NE}),
             plain_view(8), both, "a shared edge through samples");
  ok_picture(little_world().face({NE, NW, SW}).face({NE, SE, SW}),
             plain_view(8), both, "a shared edge, both faces in its direction");

  const std::string lower_half = "........\n"
                                 "........\n"
                                 ".....0..\n"
                                 "....00..\n"
                                 "...000..\n"
                                 "..0000..\n"
                                 "........\n"
                                 "........\n";
  ok_picture(little_world().face({SW, SE, NE}), plain_view(8), lower_half,
             "the other half alone has the diagonal");
}

/* Four faces around a vertex on the sample (1, 1), which goes to the face on
 * its right. */
void test_fan() {
  const point centre = {1, 1, -8};
  const point rim[4] = {NE, NW, SW, SE};
  little_world all, single[4];
  for (size_t f = 0; f < 4; f++) {
    all.face({centre, rim[f], rim[(f + 1) % 4]});
    single[f].face({centre, rim[f], rim[(f + 1) % 4]});
  }
  const std::string got = text(see(all, plain_view(8)), 8);

  /* Face 0 is above the centre, 1 left, 2 below, 3 right. The line to NW is at
   * X = -2 for Y = 3; NW itself is displaced by (e, -e^2), while the line falls
   * by 2/3 e, so it goes above the line. The lines to NE and SW are X = Y;
   * samples on them go to the face on their right. The line to SE is at X = 7/3
   * for Y = -1 and at 11/3 for Y = -3. */
  ok_text(got,
          "........\n"
          ".00000..\n"
          ".11003..\n"
          ".11133..\n"
          ".11223..\n"
          ".12222..\n"
          "........\n"
          "........\n",
          "four faces about a vertex on a sample");

  int times[64] = {};
  for (little_world &w : single) {
    const picture p = see(w, plain_view(8));
    for (size_t k = 0; k < 64; k++)
      times[k] += p[k] == 0;
  }
  bool once = true;
  for (size_t k = 0; k < 64; k++)
    once = once && times[k] == (got[k / 8 * 9 + k % 8] != '.');
  ok(once, "each sample of them belongs to exactly one");
}

/* In the oblique plane of NW, 2 SW and 3 NE, a second face with the corners NW
 * and the midpoints of the two edges from there, (-7.5, -2.5, -12) and (5, 10,
 * -16). It appears with the corners (-5, 5), (-5, -5/3) and (2.5, 5), that is,
 * above Y = -5/3 + 8/9 (X + 5), which for X = -5, -3, -1, 1, 3 is -1.67, 0.11,
 * 1.89, 3.67, 5.44. */
void test_coplanar() {
  const std::vector<point> whole = {NW, {-10, -10, -16}, {15, 15, -24}};
  const std::vector<point> part = {NW, {5, 10, -16}, {-7.5, -2.5, -12}};
  ok_picture(little_world().face(part).face(whole), plain_view(8),
             "........\n"
             ".00001..\n"
             ".0001...\n"
             ".001....\n"
             ".01.....\n"
             ".1......\n"
             "........\n"
             "........\n",
             "of coplanar faces the lower id is seen");
  ok_picture(little_world().face(whole).face(part), plain_view(8), upper_half,
             "and so in the other order");
  ok_picture(little_world()
                 .face(whole)
                 .face({whole[2], whole[0], whole[1]})
                 .face({whole[2], whole[1], whole[0]}),
             plain_view(8), upper_half, "duplicates, turned and reversed");

  /* A polygon's plane does not depend on the number of its vertices: here one
   * more is on an edge. */
  ok_picture(little_world()
                 .face({NW, {-7.5, -2.5, -12}, {-10, -10, -16}, {15, 15, -24}})
                 .face(whole),
             plain_view(8), upper_half, "a duplicate with a vertex more");
}

void test_one_sided() {
  const std::string none = rows(8, "........");
  ok_picture(little_world().face({NW, SW, NE}, true), plain_view(8), upper_half,
             "one-sided, seen from its front");
  ok_picture(little_world().face({NW, NE, SW}, true), plain_view(8), none,
             "one-sided, seen from its back");
  ok_picture(little_world()
                 .face({NW, NE, SW}, true)
                 .face({{-10, 10, -16}, {-10, -10, -16}, {10, 10, -16}}),
             plain_view(8),
             "........\n"
             ".11111..\n"
             ".1111...\n"
             ".111....\n"
             ".11.....\n"
             ".1......\n"
             "........\n"
             "........\n",
             "a back face that does not exist hides nothing");
}

/* For n = 7 the samples are at even X and Y, and the middle column is at X = 0.
 * The eye lies in the plane x = 0, with a triangle across all rows of that
 * column. */
void test_eye_in_plane() {
  const point far_square[4] = {
      {-20, 20, -14}, {-20, -20, -14}, {20, -20, -14}, {20, 20, -14}};
  for (bool one : {false, true})
    ok_picture(little_world()
                   .face({{0, 9, -7}, {0, -9, -7}, {0, 0, -12}}, one)
                   .face({far_square, far_square + 4}),
               plain_view(7), rows(7, "1111111"),
               one ? "a one-sided face with the eye in its plane"
                   : "a face with the eye in its plane");

  /* With the eye on the face, on its edge, and at its vertex. */
  ok_picture(little_world()
                 .face({{0, 9, -7}, {0, -9, -7}, {0, 0, 12}})
                 .face({{0, 9, -7}, {0, -9, 7}, {0, 5, 12}})
                 .face({{0, 9, -7}, {0, 0, 0}, {0, 5, 12}})
                 .face({far_square, far_square + 4}),
             plain_view(7), rows(7, "3333333"), "and on the face itself");
}

/* A U of edges along samples. A sample counts with what is to its right and
 * below it, so the arms are -5 <= X < -1 and 1 <= X < 5 for -5 < Y <= 5, and
 * between them, -1 <= X < 1, the base is -5 < Y <= -1. */
void test_non_convex() {
  const std::vector<point> u = {{-5, 5, -8},  {-5, -5, -8}, {5, -5, -8},
                                {5, 5, -8},   {1, 5, -8},   {1, -1, -8},
                                {-1, -1, -8}, {-1, 5, -8}};
  const std::string expected = "........\n"
                               ".00.00..\n"
                               ".00.00..\n"
                               ".00.00..\n"
                               ".00000..\n"
                               ".00000..\n"
                               "........\n"
                               "........\n";
  ok_picture(little_world().face(u), plain_view(8), expected,
             "a non-convex polygon");
  ok_picture(little_world().face({u.rbegin(), u.rend()}), plain_view(8),
             expected, "a non-convex polygon, reversed");
}

/* A floor y = -2 and a ceiling y = 2 around the eye. They end so far away that
 * they reach the middle line: at the lowest slope, 1/8, the ray meets them at
 * z = -16 and |x| <= 14. The other half of the rays hits each plane behind the
 * eye. */
void test_behind() {
  const std::vector<point> floor = {
      {-20, -2, 20}, {20, -2, 20}, {20, -2, -20}, {-20, -2, -20}};
  const std::vector<point> ceiling = {
      {-20, 2, -20}, {20, 2, -20}, {20, 2, 20}, {-20, 2, 20}};
  ok_picture(little_world().face(floor), plain_view(8),
             rows(4, "........") + rows(4, "00000000"),
             "a polygon that reaches behind the eye");
  ok_picture(little_world().face(floor, true).face(ceiling, true),
             plain_view(8), rows(4, "11111111") + rows(4, "00000000"),
             "two of them, one-sided, seen from their fronts");

  /* One vertex behind: the triangle (-1, -2, -1), (1, -2, -1), (0, -2, 9) of
   * the floor ends at z = -1, that is, at the slope y = -2. */
  ok_picture(little_world().face({{-1, -2, -1}, {1, -2, -1}, {0, -2, 9}}),
             plain_view(8), rows(8, "........"),
             "a triangle with a vertex behind, below the picture");
  ok_picture(little_world().face({{-99, -2, -20}, {99, -2, -20}, {0, -2, 9}}),
             plain_view(8), rows(4, "........") + rows(4, "00000000"),
             "a triangle with a vertex behind, across the picture");
  ok_picture(little_world().face({{9, 9, 8}, {-9, 9, 8}, {0, -9, 8}}),
             plain_view(8), rows(8, "........"), "a triangle all behind");

  /* One sample, looking along -z. The quadrilateral is warped and wholly behind
   * the eye, and the ray's line goes through it, at x = y = 0. Its plane goes
   * through the mean of its vertices, (4, 4, 103/4), parallel to its diagonals,
   * (10, 10, 99) and (-10, 10, 0). At x = y = 0 the plane is at
   * z = 103/4 - 4/10 99 < 0, in front of the eye. So by the definition the face
   * is seen. */
  ok_picture(
      little_world().face({{-1, -1, 1}, {9, -1, 1}, {9, 9, 100}, {-1, 9, 1}}),
      plain_view(1), "0\n",
      "a warped polygon behind, whose plane is hit before the eye");
}

/* Squares across the picture in planes that depend on one coordinate. Depth t
 * is -z, and there x = X/t, y = Y/t:
 *   right: Z = -7 - X, so t = 7/(1 - x), greater to the right;
 *   left:  Z = -9 + X, so t = 9/(1 + x), greater to the left;
 *   up, down: the same with Y and y.
 * In both, t = 8 at x = 1/8, that is in column 4; at y = 1/8, in row 3. */
const std::vector<point> deeper_right = {
    {-5, -200, -2}, {100, -200, -107}, {100, 200, -107}, {-5, 200, -2}};
const std::vector<point> deeper_left = {
    {-100, -200, -109}, {5, -200, -4}, {5, 200, -4}, {-100, 200, -109}};
const std::vector<point> deeper_up = {
    {-200, -5, -2}, {200, -5, -2}, {200, 100, -107}, {-200, 100, -107}};
const std::vector<point> deeper_down = {
    {-200, -100, -109}, {200, -100, -109}, {200, 5, -4}, {-200, 5, -4}};

void test_near() {
  const std::vector<point> facing = {
      {-20, -20, -8}, {20, -20, -8}, {20, 20, -8}, {-20, 20, -8}};
  const std::string none = rows(8, "........"), all = rows(8, "00000000");
  ok_picture(little_world().face(facing), plain_view(8, 8), none,
             "a plane all at t == near does not exist");
  ok_picture(little_world().face(facing), plain_view(8, std::nextafter(8., 0.)),
             all, "a plane just beyond it does");
  ok_picture(little_world().face(facing), plain_view(8, std::nextafter(8., 9.)),
             none, "a plane just before it does not");

  ok_picture(little_world().face(deeper_right), plain_view(8, 8),
             rows(8, "....0000"), "t == near in a column, deeper to the right");
  ok_picture(little_world().face(deeper_left), plain_view(8, 8),
             rows(8, "0000...."), "t == near in a column, deeper to the left");
  ok_picture(little_world().face(deeper_up), plain_view(8, 8),
             rows(3, "00000000") + rows(5, "........"),
             "t == near in a row, deeper upwards");
  ok_picture(little_world().face(deeper_down), plain_view(8, 8),
             rows(3, "........") + rows(5, "00000000"),
             "t == near in a row, deeper downwards");
}

void test_penetrating() {
  ok_picture(little_world().face(deeper_right).face(deeper_left), plain_view(8),
             rows(8, "00001111"), "planes that meet in a column of samples");
  ok_picture(little_world().face(deeper_left).face(deeper_right), plain_view(8),
             rows(8, "11110000"), "and in the other order");
  ok_picture(little_world().face(deeper_up).face(deeper_down), plain_view(8),
             rows(3, "11111111") + rows(5, "00000000"),
             "planes that meet in a row of samples");
  ok_picture(little_world().face(deeper_down).face(deeper_up), plain_view(8),
             rows(3, "00000000") + rows(5, "11111111"),
             "and in the other order");
}

/* ---- The definition once more, literally ---- */

/* What the definition says about one face, before any sample. For vertex i and
 * the edge to the next one: row(v) = (R x v)·D, edge(a, b) = (a x b)·D. */
struct naive_face {
  std::vector<vec> row, edge;
  vec N;
  Q k, c;
  bool exists;
};

struct naive {
  vec R;
  Q near;
  std::vector<naive_face> faces;
  const struct hsr_view &view;
  bool triangles_agree = true; /* see covers() */

  naive(const little_world &w, const struct hsr_view &view);
  displaced ray(int i, int j) const;
  bool covers(const naive_face &f, const displaced &D);
  picture see();
};

naive::naive(const little_world &w, const struct hsr_view &a_view)
    : R{a_view.R[0], a_view.R[1], a_view.R[2]}, near(a_view.near),
      view(a_view) {
  const vec E = {view.E[0], view.E[1], view.E[2]};
  for (uint32_t f = 0; f < w.n_faces(); f++) {
    std::vector<vec> V;
    for (uint32_t c = w.start[f]; c < w.start[f + 1]; c++) {
      const uint32_t v = w.vertex[c];
      V.push_back({w.x[v], w.y[v], w.z[v]});
    }
    naive_face made = {};
    vec N = {0, 0, 0}, S = {0, 0, 0};
    for (size_t i = 0; i < V.size(); i++) {
      const vec &A = V[i], &B = V[(i + 1) % V.size()];
      N = N + cross(A, B);
      S = S + A;
      made.row.push_back(cross(R, A - E));
      made.edge.push_back(cross(A - E, B - E));
    }
    made.N = N;
    made.k = Q(int(V.size()));
    made.c = dot(N, S - made.k * E);
    made.exists = !w.one_sided[f] || dot(N, made.k * E - S) > 0;
    faces.push_back(made);
  }
}

displaced naive::ray(int i, int j) const {
  const Q m(view.whole_m), n(view.whole_n);
  const Q sx(view.left + i + 0.5 + view.offset_x),
      sy(view.top + j + 0.5 + view.offset_y);
  const vec F = {view.F[0], view.F[1], view.F[2]};
  const vec U = {view.U[0], view.U[1], view.U[2]};
  const Q x = (2 * sx - m) / m, y = (n - 2 * sy) / n;
  return {{F + x * R + y * U, R, Q(-1) * U}};
}

bool naive::covers(const naive_face &f, const displaced &D) {
  const size_t n = f.row.size();
  std::vector<int> row, edge;
  for (size_t i = 0; i < n; i++) {
    row.push_back(sign(dot(f.row[i], D)) < 0 ? -1 : 1);
    edge.push_back(sign(dot(f.edge[i], D)));
  }
  bool odd = false;
  for (size_t i = 0; i < n; i++)
    if (row[i] != row[(i + 1) % n] && edge[i] != 0 && edge[i] == -row[i])
      odd = !odd;

  /* A line goes through a triangle if all edges are on the same side of it. */
  if (n == 3 && f.c != 0) {
    const bool through = edge[0] == edge[1] && edge[1] == edge[2];
    triangles_agree = triangles_agree && odd == through;
  }

  /* t = c / (k N·D) > near. */
  const poly kND = f.k * dot(f.N, D);
  const poly c = {{f.c, 0, 0}};
  if (!odd || sign(kND) == 0 || f.c == 0)
    return false;
  return sign(c) * sign(kND) > 0 && sign(c - near * kND) * sign(kND) > 0;
}

picture naive::see() {
  picture ids;
  for (int j = 0; j < view.n; j++)
    for (int i = 0; i < view.m; i++) {
      const displaced D = ray(i, j);
      uint32_t nearest = HSR_BACKGROUND;
      poly nearness = {};
      for (uint32_t f = 0; f < faces.size(); f++) {
        if (!faces[f].exists || !covers(faces[f], D))
          continue;
        const poly one_over_t = faces[f].k / faces[f].c * dot(faces[f].N, D);
        if (nearest == HSR_BACKGROUND || sign(one_over_t - nearness) > 0) {
          nearest = f;
          nearness = one_over_t;
        }
      }
      ids.push_back(nearest);
    }
  return ids;
}

/* ---- Random scenes ---- */

/* A polygon without a Newell normal is no face. */
bool has_normal(const std::vector<point> &corners) {
  vec N = {0, 0, 0};
  for (size_t i = 0; i < corners.size(); i++) {
    const point &a = corners[i], &b = corners[(i + 1) % corners.size()];
    N = N + cross(exact(a), exact(b));
  }
  return !is_null(N);
}

/* A rectangle along two axes: its box is flat, and it is coplanar with many
 * others. */
std::vector<point> flat_rectangle(dice &d, int size) {
  const point a = d.lattice(size), b = d.lattice(size);
  const int axis = d.below(3);
  if (axis == 0)
    return {a, {a.x, b.y, a.z}, {a.x, b.y, b.z}, {a.x, a.y, b.z}};
  if (axis == 1)
    return {a, {b.x, a.y, a.z}, {b.x, a.y, b.z}, {a.x, a.y, b.z}};
  return {a, {b.x, a.y, a.z}, {b.x, b.y, a.z}, {a.x, b.y, a.z}};
}

std::vector<point> any_polygon(dice &d, int size) {
  if (d.once_in(4))
    return planar_polygon(d, size);
  if (d.once_in(4))
    return flat_rectangle(d, size);
  std::vector<point> corners;
  const int k = d.once_in(3) ? d.from_to(4, 6) : 3;
  for (int i = 0; i < k; i++)
    corners.push_back(d.lattice(size));
  return corners;
}

little_world random_world(dice &d, int n_faces, int size) {
  std::vector<std::vector<point>> faces;
  while (int(faces.size()) < n_faces) {
    std::vector<point> corners = any_polygon(d, size);
    if (!faces.empty() && d.once_in(5)) {
      corners = faces[size_t(d.below(int(faces.size())))];
      std::rotate(corners.begin(), corners.begin() + 1, corners.end());
      if (d.once_in(2))
        std::reverse(corners.begin(), corners.end());
    }
    if (has_normal(corners))
      faces.push_back(corners);
  }
  little_world w;
  for (const std::vector<point> &corners : faces)
    w.face(corners, d.once_in(3));
  return w;
}

/* A view towards the middle with any independent F, R, U, or a tile of one.
 * Every other one has rays through lattice points: with R = W/2 r the term xR
 * is a multiple of r, or of r/2 where W is even. */
struct hsr_view random_view(dice &d, int size) {
  struct hsr_view v = {};
  v.whole_m = d.from_to(2, 9);
  v.whole_n = d.from_to(2, 9);
  const bool is_tile = d.once_in(3);
  v.m = is_tile ? d.from_to(1, v.whole_m) : v.whole_m;
  v.n = is_tile ? d.from_to(1, v.whole_n) : v.whole_n;
  v.left = d.from_to(0, v.whole_m - v.m);
  v.top = d.from_to(0, v.whole_n - v.n);
  v.window = {0, 0, v.m, v.n};
  v.near = d.once_in(2) ? 0 : d.from_to(1, 6) / 8.0;
  const bool on_lattice = d.once_in(2);
  if (!on_lattice && d.once_in(2)) {
    v.offset_x = d.from_to(-3, 3) / 8.0;
    v.offset_y = d.from_to(-3, 3) / 8.0;
  }
  const point E = d.lattice(size);
  point F, R, U;
  random_directions(d, E, size, &F, &R, &U);
  const double wide = on_lattice ? v.whole_m / 2.0 : 1.0;
  const double high = on_lattice ? v.whole_n / 2.0 : 1.0;
  const double e[] = {E.x, E.y, E.z}, f[] = {F.x, F.y, F.z};
  const double r[] = {R.x, R.y, R.z}, u[] = {U.x, U.y, U.z};
  for (int axis = 0; axis < 3; axis++) {
    v.E[axis] = e[axis];
    v.F[axis] = f[axis];
    v.R[axis] = wide * r[axis];
    v.U[axis] = high * u[axis];
  }
  return v;
}

/* Compares n_scenes random scenes, seeded with `seed`. */
void ok_naive(const std::string &what, unsigned seed, int n_scenes, int n_faces,
              int size, bool rough) {
  int n_wrong = 0, n_seen = 0;
  bool triangles_agree = true, scale_holds = true;
  for (int scene = 0; scene < n_scenes; scene++) {
    dice d = {std::mt19937(seed + unsigned(scene))};
    little_world w = random_world(d, n_faces, size);
    struct hsr_view v = random_view(d, size);
    if (rough)
      roughen(w, v);
    naive slow(w, v);
    const picture expected = slow.see(), got = see(w, v);
    triangles_agree = triangles_agree && slow.triangles_agree;
    for (uint32_t id : expected)
      n_seen += id != HSR_BACKGROUND;
    if (got != expected) {
      n_wrong++;
      std::printf("# seed %u\n", seed + unsigned(scene));
    }

    /* A power of two as a factor changes nothing, even if products leave the
     * range of doubles. */
    if (scene % 4 < 2) {
      scale(w, v, scene % 4 == 0 ? -300 : 300);
      scale_holds = scale_holds && see(w, v) == expected;
    }
  }
  ok(n_wrong == 0 && n_seen > 0,
     what + ", " + std::to_string(n_seen) + " samples with a face");
  ok(triangles_agree, "parity of triangles is that of their edges' sides");
  ok(scale_holds, "the same 2^300 times as large and as small");
}

void test_naive() {
  ok_naive("single faces on a lattice", 1000, 600, 1, 3, false);
  ok_naive("few faces on a lattice", 2000, 150, 6, 3, false);
  ok_naive("many faces on a lattice", 3000, 36, 40, 4, false);
  ok_naive("faces on a wide lattice", 4000, 24, 60, 20, false);
  ok_naive("rounded faces", 5000, 60, 24, 4, true);
  ok_naive("scenes of 500 faces", 6000, 3, 500, 40, false);
}

/* ---- The interface ---- */

struct hsr_view inner_window(struct hsr_view v) {
  v.window = {2, 1, 6, 5};
  return v;
}

void test_window() {
  little_world w;
  w.face({NW, SW, NE}).face({SW, SE, NE});
  ok_text(text(see(w, inner_window(plain_view(8))), 8),
          "????????\n"
          "??0000??\n"
          "??0001??\n"
          "??0011??\n"
          "??0111??\n"
          "????????\n"
          "????????\n"
          "????????\n",
          "only the window is written");
}

void test_threads() {
  dice d = {std::mt19937(7)};
  little_world w = random_world(d, 200, 10);
  struct hsr_view view = random_view(d, 10);
  view.m = view.n = view.whole_m = view.whole_n = 64;
  view.left = view.top = 0;
  const struct hsr_world world = w.world();
  void *prepared = nullptr;
  oracle.prepare(&world, nullptr, &prepared, nullptr);
  view.window = {0, 0, 64, 64};
  const picture alone = render(world, view, prepared);

  picture part[2];
  std::thread threads[2];
  for (int k = 0; k < 2; k++)
    threads[k] = std::thread([&, k] {
      struct hsr_view half = view;
      half.window.y0 = 32 * k;
      half.window.y1 = 32 * (k + 1);
      part[k] = render(world, half, prepared);
    });
  for (std::thread &t : threads)
    t.join();
  oracle.release(prepared);
  std::copy(part[1].begin() + 32 * 64, part[1].end(),
            part[0].begin() + 32 * 64);
  ok(part[0] == alone, "two threads on one prepared object");
}

/* A scene that needs exact arithmetic in prepare and render, with the k-th
 * allocation failing, for all k. */
void test_no_memory() {
  const std::vector<point> whole = {
      {-5, 5, -8}, {-10, -10, -16}, {0, 0, -16}, {15, 15, -24}};
  little_world w;
  for (int i = 0; i < 9; i++)
    w.face(whole);
  const struct hsr_world world = w.world();
  const struct hsr_view view = plain_view(2);
  uint32_t ids[4];
  struct hsr_tally tally = {};
  struct hsr_job job = {};
  job.world = &world;
  job.view = &view;
  job.tally = &tally;
  struct hsr_answer answer = hsr_answer_of_ids(ids, 2, 2);
  job.answer = &answer;
  ok_without_memory(oracle, job, true, [] {});
}

void test_descriptor() {
  ok(!std::strcmp(oracle.name, "oracle") && oracle.taxonomy == HSR_YARDSTICK &&
         oracle.flags & HSR_JUDGE && oracle.makes[0].kind == HSR_IDS,
     "the descriptor");
}

} /* namespace */

int main() {
  test_descriptor();
  test_triangle();
  test_shared_edge();
  test_fan();
  test_coplanar();
  test_one_sided();
  test_eye_in_plane();
  test_non_convex();
  test_behind();
  test_near();
  test_penetrating();
  test_window();
  test_threads();
  test_no_memory();
  test_naive();
  return finish();
}
