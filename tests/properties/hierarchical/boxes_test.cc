// SPDX-License-Identifier: GPL-3.0-or-later
// Boxes against convex polyhedra and polygons, judged by clipping in exact
// arithmetic. A polygon meets a box if the box's six half spaces leave some of
// it. A solid meets a box if one of its faces does, or if the box lies inside.
// The clipping uses intervals; if these leave a comparison open, it uses
// rational numbers.
//
// There are two kinds of error. Wrong: OUT but meeting, IN but not inside, on a
// plane's inner side but cut. That may never happen. Doubtful: PARTIAL or cut
// without need. The proved bounds allow that only within rounding of a tie. So
// there should be none, neither on random input nor among small integers, where
// everything is exact and there are many ties.
#include "common/trees/box.h"
#include "tests/properties/splitmix64.h"
#include "tests/tap.h"

#include <CGAL/Exact_rational.h>
#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace {

using Interval = CGAL::Interval_nt<false>;
using Rational = CGAL::Exact_rational;
template <class T> using Point = std::array<T, 3>;
template <class T> using Polygon = std::vector<Point<T>>;

// A coordinate in [-size, size]: an integer on the lattice, otherwise a
// multiple of 2^-12. So a few sums and products of coordinates are exact.
double coordinate(int size, bool lattice) {
  return lattice ? integer(-size, size)
                 : integer(-size << 12, size << 12) / 4096.;
}

hsr_box random_box(const Point<double> &about, double spread, bool lattice) {
  hsr_box box;
  const double half = std::exp(real(std::log(.02), std::log(4.)));
  for (int k = 0; k < 3; k++) {
    const double middle = about[size_t(k)] + real(-spread, spread);
    const double h = half * real(.3, 1);
    box.lo[k] = lattice ? std::floor(middle - h) : middle - h;
    box.hi[k] = lattice ? std::floor(middle + h) : middle + h;
  }
  return box;
}

// ---- The oracle ----

template <class T> Point<T> cross(const Point<T> &a, const Point<T> &b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
          a[0] * b[1] - a[1] * b[0]};
}
template <class T> T dot(const Point<T> &a, const Point<T> &b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class T> Point<T> minus(const Point<T> &a, const Point<T> &b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

// The part of the polygon where sign * x[axis] >= sign * at.
template <class T>
void clip(Polygon<T> &polygon, size_t axis, const T &at, int sign) {
  Polygon<T> kept;
  for (size_t i = 0; i < polygon.size(); i++) {
    const Point<T> &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const T ha = T(sign) * (a[axis] - at), hb = T(sign) * (b[axis] - at);
    const bool a_in = ha >= T(0), b_in = hb >= T(0);
    if (a_in)
      kept.push_back(a);
    if (a_in != b_in) {
      const T t = ha / (ha - hb);
      Point<T> p;
      for (size_t k = 0; k < 3; k++)
        p[k] = a[k] + t * (b[k] - a[k]);
      p[axis] = at;
      kept.push_back(p);
    }
  }
  polygon.swap(kept);
}

template <class T> bool meets(Polygon<T> polygon, const hsr_box &box) {
  for (size_t k = 0; k < 3 && !polygon.empty(); k++) {
    clip(polygon, k, T(box.lo[k]), 1);
    clip(polygon, k, T(box.hi[k]), -1);
  }
  return !polygon.empty();
}

template <class T> struct Solid {
  std::vector<Point<T>> vertices;
  std::vector<std::vector<int>> faces;

  Polygon<T> face(size_t f) const {
    Polygon<T> polygon;
    for (const int v : faces[f])
      polygon.push_back(vertices[size_t(v)]);
    return polygon;
  }
  // The outward normal.
  Point<T> normal(size_t f) const {
    const Polygon<T> p = face(f);
    Point<T> n = cross(minus(p[1], p[0]), minus(p[2], p[0]));
    for (size_t v = 0; v < vertices.size(); v++)
      if (std::find(faces[f].begin(), faces[f].end(), int(v)) ==
          faces[f].end()) {
        if (dot(n, minus(vertices[v], p[0])) > T(0))
          n = {-n[0], -n[1], -n[2]};
        return n;
      }
    std::abort(); // a solid of one face
  }
};

template <class T> Point<T> box_corner(const hsr_box &box, unsigned c) {
  return {T(c & 1 ? box.hi[0] : box.lo[0]), T(c & 2 ? box.hi[1] : box.lo[1]),
          T(c & 4 ? box.hi[2] : box.lo[2])};
}

struct Truth {
  bool meets;
  unsigned cut; // planes that do not have the whole box on their inner side
};

template <class T> Truth judge(const Solid<T> &solid, const hsr_box &box) {
  Truth truth = {false, 0};
  bool corner_inside = true;
  for (size_t f = 0; f < solid.faces.size(); f++) {
    const Point<T> n = solid.normal(f), p = solid.face(f)[0];
    for (unsigned c = 0; c < 8 && !(truth.cut >> f & 1); c++)
      if (dot(n, minus(box_corner<T>(box, c), p)) >= T(0)) {
        truth.cut |= 1u << f;
        corner_inside &= c > 0;
      }
  }
  // A box that no face meets has all its corners inside, or none.
  truth.meets = corner_inside;
  for (size_t f = 0; f < solid.faces.size() && !truth.meets; f++)
    truth.meets = meets(solid.face(f), box);
  return truth;
}

// Calls `question` with Intervals; if these do not settle it, with Rationals.
template <class Question> auto exactly(const Question &question) {
  try {
    const Interval::Protector rounding;
    return question(Interval(0));
  } catch (const CGAL::Uncertain_conversion_exception &) {
    return question(Rational(0));
  }
}

template <class T> Point<T> convert(const Point<double> &p) {
  return {T(p[0]), T(p[1]), T(p[2])};
}
template <class T> Solid<T> convert(const Solid<double> &solid) {
  Solid<T> result;
  for (const Point<double> &p : solid.vertices)
    result.vertices.push_back(convert<T>(p));
  result.faces = solid.faces;
  return result;
}

// ---- The tally ----

struct Score {
  long cases = 0, out = 0, partial = 0, in = 0, wrong = 0, doubtful = 0;
  long needs_lines = 0, deciding = 0, refining = 0;
  unsigned least = ~0u, most = 0;

  void print(const char *what) const {
    std::printf("# %s: %ld cases: %ld out, %ld partial, %ld in; %ld wrong, %ld "
                "doubtful; without the edge-lines %ld more would be taken to "
                "meet\n",
                what, cases, out, partial, in, wrong, doubtful, needs_lines);
    std::printf("# inequalities: %u to %u, mean %.2f; to refine, %.2f more\n",
                least, most, double(deciding) / double(cases),
                double(refining) / double(cases));
  }
};

void try_box(Score &score, const hsr_polyhedron &poly, const hsr_box &box,
             const Truth &truth) {
  hsr_box_work work = {0, 0};
  unsigned cut = 0;
  const hsr_box_verdict verdict = hsr_box_classify(&poly, &box, &cut, &work);
  score.cases++;
  score.deciding += work.deciding;
  score.refining += work.refining;
  score.least = std::min(score.least, work.deciding);
  score.most = std::max(score.most, work.deciding);
  if (verdict == HSR_BOX_OUT) {
    score.out++;
    score.wrong += truth.meets;
    hsr_polyhedron no_lines = poly;
    no_lines.n_lines = 0;
    score.needs_lines +=
        hsr_box_classify(&no_lines, &box, nullptr, nullptr) != HSR_BOX_OUT;
    return;
  }
  score.in += verdict == HSR_BOX_IN;
  score.partial += verdict == HSR_BOX_PARTIAL;
  score.wrong += (truth.cut & ~cut) != 0 || (verdict == HSR_BOX_IN) != !cut;
  // If a box holds the whole polyhedron, listing A.1 takes all planes as cut.
  score.doubtful += !truth.meets || (!hsr_box_holds(&box, &poly.bounds) &&
                                     (cut & ~truth.cut) != 0);
}

// ---- Solids ----

hsr_polyhedron ready(const Solid<double> &solid,
                     const double *radius = nullptr) {
  std::vector<int> start = {0}, loops;
  for (const auto &face : solid.faces) {
    loops.insert(loops.end(), face.begin(), face.end());
    start.push_back(int(loops.size()));
  }
  hsr_polyhedron poly;
  hsr_polyhedron_init(&poly, int(solid.vertices.size()),
                      solid.vertices[0].data(), radius, int(solid.faces.size()),
                      start.data(), loops.data());
  return poly;
}

Point<double> random_point(int size, bool lattice) {
  return {coordinate(size, lattice), coordinate(size, lattice),
          coordinate(size, lattice)};
}

double volume(const Point<double> &a, const Point<double> &b,
              const Point<double> &c) {
  return dot(a, cross(b, c));
}

Solid<double> random_tetrahedron(bool lattice) {
  Solid<double> s;
  s.faces = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  do {
    s.vertices.clear();
    for (int v = 0; v < 4; v++)
      s.vertices.push_back(random_point(4, lattice));
  } while (volume(minus(s.vertices[1], s.vertices[0]),
                  minus(s.vertices[2], s.vertices[0]),
                  minus(s.vertices[3], s.vertices[0])) == 0);
  return s;
}

const std::vector<std::vector<int>> frustum_faces = {
    {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6},
    {3, 0, 4, 7}, {0, 1, 2, 3}, {4, 5, 6, 7}};
const std::vector<std::vector<int>> pyramid_faces = {
    {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {0, 1, 2, 3}};

// Four rays from an eye, cut at two depths. Its faces are planar to the last
// bit, since nothing is rounded.
Solid<double> random_frustum(bool lattice) {
  Point<double> eye = random_point(4, lattice), ray, right, up;
  do {
    ray = random_point(3, lattice);
    right = random_point(lattice ? 2 : 1, lattice);
    up = random_point(lattice ? 2 : 1, lattice);
  } while (volume(ray, right, up) == 0);
  const double near = lattice ? 1 : integer(1, 64) / 64.;
  const double far = near + (lattice ? integer(1, 2) : integer(1, 192) / 64.);
  Solid<double> s;
  s.faces = frustum_faces;
  for (const double t : {far, near})
    for (const auto &[x, y] : {std::pair{-1, 1}, {1, 1}, {1, -1}, {-1, -1}}) {
      Point<double> p;
      for (size_t k = 0; k < 3; k++)
        p[k] = eye[k] + t * (ray[k] + x * right[k] + y * up[k]);
      s.vertices.push_back(p);
    }
  return s;
}

Point<double> somewhere_in(const std::vector<Point<double>> &vertices) {
  Point<double> sum = {0, 0, 0};
  double weights = 0;
  for (const Point<double> &p : vertices) {
    const double weight = std::pow(real(0, 1), 4);
    weights += weight;
    for (size_t k = 0; k < 3; k++)
      sum[k] += weight * p[k];
  }
  return {sum[0] / weights, sum[1] / weights, sum[2] / weights};
}

void try_solids(Score &score, Solid<double> (*random)(bool), int n,
                bool lattice) {
  for (int i = 0; i < n; i++) {
    const Solid<double> solid = random(lattice);
    const hsr_polyhedron poly = ready(solid);
    for (int k = 0; k < 10; k++) {
      const hsr_box box =
          random_box(somewhere_in(solid.vertices), lattice ? 3 : 2, lattice);
      try_box(score, poly, box, exactly([&](const auto zero) {
                return judge(convert<std::decay_t<decltype(zero)>>(solid), box);
              }));
    }
  }
}

void test_solids(struct tap *tap) {
  for (const bool lattice : {false, true}) {
    const char *numbers = lattice ? "small integers" : "random numbers";
    const int n = lattice ? 10000 : 50000;
    Score frusta, tetrahedra;
    try_solids(frusta, random_frustum, n, lattice);
    frusta.print("frusta");
    try_solids(tetrahedra, random_tetrahedron, n, lattice);
    tetrahedra.print("tetrahedra");
    ok(tap, frusta.wrong + tetrahedra.wrong == 0,
       "%s: every box that is out, in, or not cut, is that", numbers);
    ok(tap, frusta.doubtful + tetrahedra.doubtful == 0,
       "%s: none is left in doubt", numbers);
    ok(tap,
       std::min({frusta.out, frusta.partial, frusta.in, tetrahedra.out,
                 tetrahedra.partial, tetrahedra.in}) > 100,
       "%s: all three verdicts are common", numbers);
    ok(tap,
       frusta.least == 1 && frusta.most <= 30 && tetrahedra.least == 1 &&
           tetrahedra.most <= 6 + 4 + 12,
       "%s: 1 to 30 inequalities decide on a frustum, 1 to 22 on a tetrahedron",
       numbers);
    ok(tap, frusta.needs_lines > 0 && tetrahedra.needs_lines > 0,
       "%s: without edge-lines some would be taken to meet", numbers);
  }
}

// A little box on the surface.
hsr_box box_on(const Solid<double> &solid) {
  const Polygon<double> face =
      solid.face(size_t(integer(0, int(solid.faces.size()) - 1)));
  const Point<double> p = somewhere_in(face);
  hsr_box box;
  for (int k = 0; k < 3; k++) {
    const double middle = p[size_t(k)] + real(-0x1p-10, 0x1p-10);
    const double half = real(0, 0x1p-11);
    box.lo[k] = middle - half;
    box.hi[k] = middle + half;
  }
  return box;
}

// Vertices that are out of place, each by up to its own radius.
void test_radii(struct tap *tap) {
  Score with, without;
  for (int i = 0; i < 10000; i++) {
    const Solid<double> solid = random_frustum(false);
    Solid<double> moved = solid;
    double radius[8];
    for (size_t v = 0; v < 8; v++) {
      radius[v] = std::ldexp(1., integer(-20, -9));
      for (double &x : moved.vertices[v])
        x += radius[v] * integer(-1, 1);
    }
    const hsr_polyhedron wide = ready(moved, radius), narrow = ready(moved);
    for (int k = 0; k < 10; k++) {
      const hsr_box box =
          k % 2 ? box_on(solid)
                : random_box(somewhere_in(solid.vertices), 2, false);
      const Truth truth = exactly([&](const auto zero) {
        return judge(convert<std::decay_t<decltype(zero)>>(solid), box);
      });
      try_box(with, wide, box, truth);
      try_box(without, narrow, box, truth);
    }
  }
  with.print("vertices out of place, by known radii");
  without.print("the same, the radii not told");
  ok(tap, with.wrong == 0 && with.out > 100 && with.in > 100,
     "vertices out of place by their radii: no verdict is wrong");
  ok(tap, without.wrong > 0, "but if the radii are not told, some are");
}

// Boxes with a corner on a face, as far as rounding lets it be, of tetrahedra
// far from the origin, whose normals are rounded.
void test_touching(struct tap *tap) {
  Score score;
  for (int i = 0; i < 2000; i++) {
    Solid<double> solid = random_tetrahedron(false);
    for (Point<double> &p : solid.vertices)
      for (double &x : p)
        x = x / 3 + 1000 / 7.;
    const hsr_polyhedron poly = ready(solid);
    for (int k = 0; k < 10; k++) {
      const Point<double> p = somewhere_in(
          solid.face(size_t(integer(0, int(solid.faces.size()) - 1))));
      hsr_box box;
      for (size_t c = 0; c < 3; c++) {
        const double width = real(0, .5);
        const bool below = integer(0, 1);
        box.lo[c] = below ? p[c] - width : p[c];
        box.hi[c] = below ? p[c] : p[c] + width;
      }
      try_box(score, poly, box, exactly([&](const auto zero) {
                return judge(convert<std::decay_t<decltype(zero)>>(solid), box);
              }));
    }
  }
  score.print("boxes with a corner on a face");
  ok(tap, score.wrong == 0 && score.doubtful > 100,
     "a corner about on a face: no verdict is wrong");
}

// ---- The frusta of views ----

// The corners as common/view/view.h defines them.
template <class T>
Solid<T> frustum_of(const hsr_view &view, double far, T margin) {
  const hsr_window &w = view.window;
  const T x0 = T(hsr_sample_x(&view, w.x0)) - margin,
          x1 = T(hsr_sample_x(&view, w.x1 - 1)) + margin,
          y0 = T(hsr_sample_y(&view, w.y0)) - margin,
          y1 = T(hsr_sample_y(&view, w.y1 - 1)) + margin, m(view.m), n(view.n);
  Solid<T> s;
  s.faces = view.near > 0 ? frustum_faces : pyramid_faces;
  for (const double t : {far, view.near})
    for (const auto &[sx, sy] :
         {std::pair{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}) {
      Point<T> p;
      for (size_t k = 0; k < 3; k++)
        p[k] = T(view.E[k]) +
               T(t) * (T(view.F[k]) + (T(2) * sx - m) / m * T(view.R[k]) +
                       (n - T(2) * sy) / n * T(view.U[k]));
      if (s.vertices.size() < (view.near > 0 ? 8u : 5u))
        s.vertices.push_back(p);
    }
  return s;
}

hsr_view random_view() {
  hsr_camera camera = {};
  hsr_view view;
  hsr_error err;
  camera.fov = real(5, 150);
  camera.near = integer(0, 1) ? real(.01, .5) : 0;
  for (int k = 0; k < 3; k++) {
    camera.eye[k] = real(-5, 5);
    camera.at[k] = real(-5, 5);
    camera.up[k] = real(-1, 1);
  }
  if (hsr_view_init(&view, &camera, integer(1, 600), integer(1, 600), &err))
    std::abort();
  view.offset_x = integer(-31, 31) / 64.;
  view.offset_y = integer(-31, 31) / 64.;
  view.window.x0 = integer(0, view.m - 1);
  view.window.x1 = integer(view.window.x0 + 1, view.m);
  view.window.y0 = integer(0, view.n - 1);
  view.window.y1 = integer(view.window.y0 + 1, view.n);
  return view;
}

// A small box about a point that a sample of the window sees.
hsr_box seen_box(const hsr_view &view, double far) {
  const double sx =
      hsr_sample_x(&view, integer(view.window.x0, view.window.x1 - 1));
  const double sy =
      hsr_sample_y(&view, integer(view.window.y0, view.window.y1 - 1));
  const double t = real(view.near, far);
  hsr_box box;
  for (int k = 0; k < 3; k++) {
    const double p = view.E[k] + t * (view.ray[0][k] + sx * view.ray[1][k] +
                                      sy * view.ray[2][k]);
    box.lo[k] = p - 1e-13;
    box.hi[k] = p + 1e-13;
  }
  return box;
}

void test_views(struct tap *tap) {
  Score score;
  long unseen = 0;
  for (int i = 0; i < 10000; i++) {
    const hsr_view view = random_view();
    const double far = real(1, 10);
    hsr_polyhedron poly;
    hsr_frustum_init(&poly, &view, far);
    const Solid<double> rough = frustum_of<double>(view, far, .5);
    for (int k = 0; k < 10; k++) {
      const hsr_box box = random_box(somewhere_in(rough.vertices), 2, false);
      try_box(score, poly, box, exactly([&](const auto zero) {
                using T = std::decay_t<decltype(zero)>;
                return judge(frustum_of<T>(view, far, T(.5)), box);
              }));
      const hsr_box seen = seen_box(view, far);
      unseen += hsr_box_classify(&poly, &seen, nullptr, nullptr) == HSR_BOX_OUT;
    }
  }
  score.print("frusta of views");
  ok(tap, score.wrong == 0, "frusta of views: no verdict is wrong");
  ok(tap, score.doubtful == 0, "frusta of views: none is left in doubt");
  ok(tap, unseen == 0, "frusta of views: what a sample sees is not out");
  ok(tap, score.least == 1 && score.most <= 30 && score.in > 100,
     "frusta of views: 1 to 30 inequalities");
}

// ---- Polygons ----

// Convex, in units of a plane's two directions.
const std::vector<std::vector<std::array<int, 2>>> shapes = {
    {{0, 0}, {2, 0}, {0, 2}},
    {{-3, -1}, {3, 0}, {1, 1}},
    {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}},
    {{-2, 0}, {0, -2}, {3, 0}, {0, 1}},
    {{-2, -1}, {0, -2}, {2, 0}, {1, 2}, {-1, 2}},
    {{-2, -1}, {-1, -2}, {1, -2}, {2, -1}, {2, 1}, {1, 2}, {-1, 2}, {-2, 1}},
    {{0, 0}, {-2, -1}, {0, 3}, {2, -1}} /* a dart: not convex */};

// On a random plane, exactly, and its normal, rounded.
Polygon<double> random_polygon(size_t shape, bool lattice,
                               Point<double> &normal) {
  Point<double> a, b;
  do {
    a = random_point(2, lattice);
    b = random_point(2, lattice);
    normal = cross(a, b);
  } while (dot(normal, normal) == 0);
  if (shape == 6) // clockwise
    normal = {-normal[0], -normal[1], -normal[2]};
  const Point<double> o = random_point(4, lattice);
  Polygon<double> polygon;
  for (const auto &[x, y] : shapes[shape])
    polygon.push_back({o[0] + x * a[0] + y * b[0], o[1] + x * a[1] + y * b[1],
                       o[2] + x * a[2] + y * b[2]});
  return polygon;
}

bool says_meets(const Polygon<double> &polygon, const Point<double> &normal,
                const hsr_box &box, double slack) {
  static const uint32_t vertex[] = {0, 1, 2, 3, 4, 5, 6, 7};
  const double *xyz = polygon[0].data();
  const hsr_loop loop = {xyz, xyz + 1, xyz + 2,
                         3,   vertex,  uint32_t(polygon.size())};
  hsr_eight_boxes boxes;
  for (int o = 0; o < 8; o++)
    hsr_put_box(&boxes, o, &box);
  const unsigned met =
      hsr_boxes_that_meet_polygon(&boxes, loop, normal.data(), slack);
  assert(met == 0 || met == 0xff);
  return met != 0;
}

bool truly_meets(const Polygon<double> &polygon, const hsr_box &box) {
  return exactly([&](const auto zero) {
    using T = std::decay_t<decltype(zero)>;
    Polygon<T> exact;
    for (const Point<double> &p : polygon)
      exact.push_back(convert<T>(p));
    return meets(exact, box);
  });
}

void test_convex_polygons(struct tap *tap) {
  for (const bool lattice : {false, true}) {
    long wrong = 0, doubtful = 0, n_meet = 0, n = lattice ? 20000 : 100000;
    for (long i = 0; i < n; i++) {
      Point<double> normal;
      const Polygon<double> p = random_polygon(size_t(i % 6), lattice, normal);
      for (int k = 0; k < 10; k++) {
        const hsr_box box =
            random_box(somewhere_in(p), lattice ? 2 : 1.5, lattice);
        const bool truth = truly_meets(p, box);
        const bool answer = says_meets(p, normal, box, 0);
        n_meet += truth;
        wrong += truth && !answer;
        doubtful += !truth && answer;
      }
    }
    std::printf("# polygons: %ld cases: %ld meet; %ld wrong, %ld doubtful\n",
                10 * n, n_meet, wrong, doubtful);
    ok(tap, wrong == 0 && doubtful == 0 && n_meet > n && n_meet < 9 * n,
       "%s: a box meets a polygon if something is left of it by clipping",
       lattice ? "small integers" : "random numbers");
  }
}

// The test may report more boxes to meet a dart than do. The two triangles at
// the dart's reflex corner give the right answer.
void test_darts(struct tap *tap) {
  long wrong = 0, more = 0, apart = 0;
  for (int i = 0; i < 50000; i++) {
    Point<double> normal;
    const Polygon<double> p = random_polygon(6, i % 2, normal);
    const hsr_box box = random_box(somewhere_in(p), 1, i % 2);
    const bool truth = truly_meets({p[0], p[1], p[2]}, box) ||
                       truly_meets({p[0], p[2], p[3]}, box);
    const bool answer = says_meets(p, normal, box, 0);
    wrong += truth && !answer;
    more += answer && !truth;
    apart += !answer;
  }
  ok(tap, wrong == 0 && more > 0 && apart > 0,
     "of a polygon that is not convex no part is missed");
}

// Corners that are out of place by up to the slack, and arbitrary normals.
void test_slack(struct tap *tap) {
  long wrong = 0, apart = 0, without = 0;
  const double slack = .125;
  for (int i = 0; i < 100000; i++) {
    Point<double> normal;
    const Polygon<double> p = random_polygon(size_t(i % 6), false, normal);
    Polygon<double> moved = p;
    for (Point<double> &v : moved)
      for (double &x : v)
        x += slack * integer(-1, 1);
    const hsr_box box = random_box(somewhere_in(p), 1.5, false);
    const bool truth = truly_meets(p, box);
    for (double &x : normal)
      x *= real(-1, 2);
    const bool answer = says_meets(moved, normal, box, slack);
    wrong += truth && !answer;
    without += truth && !says_meets(moved, normal, box, 0);
    apart += !answer;
  }
  ok(tap, wrong == 0 && apart > 0 && without > 0,
     "corners out of place by the slack, and a wrong normal, hide nothing");
}

} // namespace

int main() {
  struct tap tap = plan(20 + 1);
  state = 6;
  test_solids(&tap);
  test_radii(&tap);
  test_touching(&tap);
  test_views(&tap);
  test_convex_polygons(&tap);
  test_darts(&tap);
  test_slack(&tap);
  return finish(&tap);
}
