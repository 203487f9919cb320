// SPDX-License-Identifier: GPL-3.0-or-later
// Named lines and their crossings, over CGAL's exact numbers.
//
// Line        a sx + b sy + c. The coefficients are polynomials in the doubles
//             of the scene and the view. They are found once, in exact numbers,
//             and divided by their common divisor.
// Direction   one who walks along (b, -a) has the positive side on the right,
//             sy being down.
// Doubles     an integer becomes a double by mpz_get_d_2exp, which truncates:
//             relative error 2^-52. The coefficients of a line are scaled by
//             one power of two, so that the largest is between 1/2 and 1; one
//             that is 2^-1022 or less loses 2^-1074.
// Places      a coordinate of a point is the double nearest to it, a relative
//             error of 2^-53. So points with different places are different.
//             Points of one place are compared in integers.
// Crossings   are computed in sums of two doubles, u = 2^-53. A coefficient has
//             a relative error of 4 u^2 then. A product of two adds 5 u^2, a
//             difference 3 u^2, a quotient 15 u^2, and terms of third order
//             (Joldes, Muller, Popescu, "Tight and rigorous error bounds for
//             basic building blocks of double-word arithmetic", ACM TOMS 44,
//             2, 2017, algorithms 6, 12, 17). So p - q is off by at most
//             20 u^2 (|p| + |q|). If the nearest double is in doubt, integers
//             decide.
// Side        the terms a x, b y have a relative error of at most 2^-52 + 2^-53
//             + 2^-53, and each of the two additions adds 2^-53. So the error
//             of a x + b y + c is below 2^-48 (|a x| + |b y| + |c|), and 2^-900
//             for what is lost below the least double. If a coordinate is not
//             finite, no comparison holds, and integers decide.
// Depth       a coefficient of q has a relative error of at most 2^-50, so that
//             the same bound holds for the difference of two depths.
// Parity      row(v) of a point is det(F, R, U) times the difference of the two
//             images' y, if v is before the eye. An edge between two rows, with
//             both ends before the eye, crosses to the right of the point if
//             both images are there. Two coordinates in doubles tell that if
//             they differ by more than 2^-48 of their sizes.

#include "common/exact/named_lines.h"
#include "common/polygon/exact_numbers.h"

#include <CGAL/Gmpz.h>
#include <CGAL/Gmpzf.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <unordered_map>
#include <vector>

namespace {

using CGAL::Gmpz;

// Not hsr::Exact: that loses the sign of an integer from which it is made.
using Exact = CGAL::Gmpzf;

using Vector = hsr::Vector<Exact>;
using Triple = std::array<Gmpz, 3>;

constexpr double SIDE_ERROR = 0x1p-48, LOST = 0x1p-900;

// --- Integers without a common divisor ---------------------------------------

struct Hash {
  size_t operator()(const Triple &t) const {
    size_t hash = 0;
    for (const Gmpz &x : t)
      for (size_t k = 0; k < mpz_size(x.mpz()); k++)
        hash =
            (hash ^ mpz_getlimbn(x.mpz(), mp_size_t(k))) * 0x9e3779b97f4a7c15u +
            (hash >> 29);
    return hash;
  }
};

bool is_zero(const Triple &t) {
  return CGAL::is_zero(t[0]) && CGAL::is_zero(t[1]) && CGAL::is_zero(t[2]);
}

void reduce(Triple &t) {
  Gmpz common;
  mpz_gcd(common.mpz(), t[0].mpz(), t[1].mpz());
  mpz_gcd(common.mpz(), common.mpz(), t[2].mpz());
  if (CGAL::is_zero(common) || common == 1)
    return;
  for (Gmpz &x : t) {
    Gmpz quotient;
    mpz_divexact(quotient.mpz(), x.mpz(), common.mpz());
    x = quotient;
  }
}

// Multiplied by one power of two. A zero has no exponent to speak of.
Triple integers_of(const std::array<Exact, 3> &value) {
  bool any = false;
  long least = 0;
  for (const Exact &x : value)
    if (CGAL::sign(x) != 0 && (!any || x.exp() < least)) {
      least = x.exp();
      any = true;
    }
  Triple made;
  for (size_t k = 0; k < 3; k++)
    if (CGAL::sign(value[k]) != 0)
      mpz_mul_2exp(made[k].mpz(), value[k].man(),
                   mp_bitcnt_t(value[k].exp() - least));
    else
      made[k] = Gmpz(0);
  reduce(made);
  return made;
}

void negate(Triple &t) {
  for (Gmpz &x : t)
    x = -x;
}

// The sign of the first that is not zero, or of W in a point.
int leading_sign(const Triple &t) {
  for (const Gmpz &x : t)
    if (const int sign = CGAL::sign(x))
      return sign;
  return 0;
}

Triple cross(const Triple &a, const Triple &b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
          a[0] * b[1] - a[1] * b[0]};
}

// The sign of a value that is off by at most `bound`; 0: it is in doubt.
int certain_sign(double value, double bound) {
  return value > bound ? 1 : value < -bound ? -1 : 0;
}

double rounded(const Gmpz &x, long exponent) {
  long own;
  const double digits = mpz_get_d_2exp(&own, x.mpz());
  const long by = std::max(-4000L, std::min(4000L, own - exponent));
  return std::ldexp(digits, int(by));
}

// The same, but what is not 0 does not become 0.
double rounded_with_sign(const Gmpz &x, long exponent) {
  const double y = rounded(x, exponent);
  return y == 0 ? int(CGAL::sign(x)) * std::numeric_limits<double>::denorm_min()
                : y;
}

long exponent_of(const Gmpz &x) {
  return CGAL::is_zero(x) ? 0 : long(mpz_sizeinbase(x.mpz(), 2));
}

// --- What is kept ------------------------------------------------------------

// hi + lo, where hi is the double nearest to the sum.
struct Sum {
  double hi, lo;
};

struct Line {
  hsr_line_name name;
  Triple exact; // the function of its name
  double d[3], direction[2];
  Sum sum[3]; // the same as d[], but finer
  bool fine;  // sum[] holds no number too small for products
};

// The sign of a line's function, as far as doubles make it certain; else 0.
int rough_sign(const Line &l, double sx, double sy) {
  const double x = l.d[0] * sx, y = l.d[1] * sy, c = l.d[2];
  return certain_sign(
      x + y + c,
      SIDE_ERROR * (std::fabs(x) + std::fabs(y) + std::fabs(c)) + LOST);
}

struct Point {
  double at[2];
  uint32_t line[2]; // two that cross in it
  uint32_t exact;   // its integers, if they are known
  uint32_t next;    // another point with the same coordinates in doubles
};

constexpr uint32_t NOTHING = UINT32_MAX;

// --- Sums of two doubles -----------------------------------------------------

constexpr double U2 = 0x1p-106, LEAST_OF_SUM = 0x1p-300;

// If |hi| >= |lo|.
Sum sum_of(double hi, double lo) {
  const double both = hi + lo;
  return {both, lo - (both - hi)};
}

Sum exact_sum(double a, double b) {
  const double both = a + b, of_b = both - a, of_a = both - of_b;
  return {both, (a - of_a) + (b - of_b)};
}

Sum operator*(Sum a, Sum b) {
  const double product = a.hi * b.hi, rest = std::fma(a.hi, b.hi, -product),
               crosswise =
                   std::fma(a.lo, b.hi, std::fma(a.hi, b.lo, a.lo * b.lo));
  return sum_of(product, rest + crosswise);
}

Sum operator-(Sum a, Sum b) {
  const Sum high = exact_sum(a.hi, -b.hi), low = exact_sum(a.lo, -b.lo);
  const Sum first = sum_of(high.hi, high.lo + low.hi);
  return sum_of(first.hi, low.lo + first.lo);
}

Sum operator/(Sum a, Sum b) {
  const double guess = a.hi / b.hi, product = b.hi * guess,
               rest = std::fma(b.lo, guess, std::fma(b.hi, guess, -product));
  const Sum back = sum_of(product, rest);
  return sum_of(guess, ((a.hi - back.hi) + (a.lo - back.lo)) / b.hi);
}

// An integer times 2^-exponent.
Sum rounded_to_sum(const Gmpz &x, long exponent) {
  if (CGAL::is_zero(x))
    return {0, 0};
  long own;
  const double digits = mpz_get_d_2exp(&own, x.mpz());
  Gmpz high, rest;
  mpz_set_d(high.mpz(), std::ldexp(digits, 53));
  if (own > 53)
    mpz_mul_2exp(high.mpz(), high.mpz(), mp_bitcnt_t(own - 53));
  else
    mpz_tdiv_q_2exp(high.mpz(), high.mpz(), mp_bitcnt_t(53 - own));
  mpz_sub(rest.mpz(), x.mpz(), high.mpz());
  return sum_of(rounded(x, exponent), rounded(rest, exponent));
}

// a d - b c, and a bound of its error.
struct Minor {
  Sum value;
  double error;
};

Minor minor(Sum a, Sum b, Sum c, Sum d) {
  const Sum p = a * d, q = b * c;
  return {p - q, 20 * U2 * (std::fabs(p.hi) + std::fabs(q.hi))};
}

bool is_certain(const Minor &m) {
  return std::fabs(m.value.hi) >= 4 * m.error;
}

// The double nearest to x / w. False: it is in doubt.
bool nearest_quotient(const Minor &x, const Minor &w, double *quotient) {
  *quotient = 0;
  if (x.value.hi == 0 && x.error == 0)
    return true;
  if (!is_certain(x))
    return false;
  const Sum q = x.value / w.value;
  const double error = 2 * std::fabs(q.hi) *
                       (x.error / std::fabs(x.value.hi) +
                        w.error / std::fabs(w.value.hi) + 16 * U2);
  *quotient = q.hi;
  return q.hi + (q.lo + error) == q.hi && q.hi + (q.lo - error) == q.hi;
}

// Where two lines cross. False: integers are needed.
bool nearest_crossing(const Line &k, const Line &l, double at[2]) {
  if (!k.fine || !l.fine)
    return false;
  const Sum *a = k.sum, *b = l.sum;
  const Minor w = minor(a[0], a[1], b[0], b[1]);
  return w.value.hi != 0 && is_certain(w) &&
         nearest_quotient(minor(a[1], a[2], b[1], b[2]), w, &at[0]) &&
         nearest_quotient(minor(a[2], a[0], b[2], b[0]), w, &at[1]);
}

// The double nearest to x / w, w > 0: 62 binary digits of the quotient, the last
// of which is 1 if there are more.
double nearest_quotient(const Gmpz &x, const Gmpz &w) {
  if (CGAL::is_zero(x))
    return 0;
  const long shift = 62 - (exponent_of(x) - exponent_of(w));
  Gmpz numerator, denominator, quotient, rest; // numbers of their own
  mpz_mul_2exp(numerator.mpz(), x.mpz(), mp_bitcnt_t(std::max(0L, shift)));
  mpz_abs(numerator.mpz(), numerator.mpz());
  mpz_mul_2exp(denominator.mpz(), w.mpz(), mp_bitcnt_t(std::max(0L, -shift)));
  mpz_tdiv_qr(quotient.mpz(), rest.mpz(), numerator.mpz(), denominator.mpz());
  uint64_t digits = 0;
  mpz_export(&digits, nullptr, -1, sizeof digits, 0, 0, quotient.mpz());
  digits |= !CGAL::is_zero(rest);
  const double size = std::ldexp(
      double(digits), int(std::max(-4000L, std::min(4000L, -shift))));
  return CGAL::sign(x) < 0 ? -size : size;
}

// With an exponent of its own: beside d[2] both components may be lost.
void find_direction(Line *line) {
  const Triple &of = line->exact;
  const long exponent = std::max(exponent_of(of[0]), exponent_of(of[1]));
  line->direction[0] = rounded_with_sign(of[1], exponent);
  line->direction[1] = -rounded_with_sign(of[0], exponent);
}

// A face's q: numerator . (sx, sy, 1) / denominator, denominator > 0.
struct Depth {
  bool known = false;
  int sign = 0; // of c; 0: the plane holds the eye
  std::array<Exact, 3> numerator;
  Exact denominator;
  double rough[3]; // the quotients
};

// The image of a vertex.
struct Image {
  bool known = false;
  uint32_t point;
  int w, toward[2];
};

struct Named {
  uint32_t line;
  int sign;
};

uint64_t key_of(hsr_line_name name) {
  return uint64_t(name.kind) << 60 ^ uint64_t(name.a) << 28 ^
         uint64_t(name.b) * 0x9e3779b97f4a7c15u;
}

struct Place {
  double at[2];
  bool operator==(const Place &other) const {
    return at[0] == other.at[0] && at[1] == other.at[1];
  }
};
struct Hash_place {
  size_t operator()(const Place &place) const {
    uint64_t bits[2];
    memcpy(bits, place.at, sizeof bits);
    const uint64_t hash =
        (bits[0] ^ bits[0] >> 32) * 0x9e3779b97f4a7c15u + bits[1];
    return size_t((hash ^ hash >> 29) * 0xbf58476d1ce4e5b9u);
  }
};

struct Same_name {
  bool operator()(const hsr_line_name &p, const hsr_line_name &q) const {
    return p.kind == q.kind && p.a == q.a && p.b == q.b;
  }
};
struct Hash_name {
  size_t operator()(const hsr_line_name &name) const { return key_of(name); }
};

} // namespace

// The coordinates of a point, W > 0, in doubles.
static void find_place(const Triple &exact, double at[2]) {
  for (size_t c = 0; c < 2; c++)
    at[c] = nearest_quotient(exact[c], exact[2]);
}

static double rough_quotient(const Exact &x, const Exact &y) {
  long of_x, of_y;
  const double p = mpz_get_d_2exp(&of_x, x.man()),
               q = mpz_get_d_2exp(&of_y, y.man());
  const long by = of_x + x.exp() - of_y - y.exp();
  return by < -900 && p != 0 ? std::nan("")
                             : std::ldexp(p / q, int(std::min(4000L, by)));
}

struct hsr_named_lines {
  const hsr_world *world;
  const hsr_view *view;
  Vector E, F, R, U;
  Exact m, n;
  int orientation; // the sign of det(F, R, U)
  bool failed = false;
  uint64_t exact = 0;

  std::vector<Line> line;
  std::vector<Point> point;
  Line no_line{};
  Point no_point{};
  Triple no_integers{};
  std::vector<Depth> depth;  // a face
  std::vector<Image> images; // a vertex
  std::unordered_map<hsr_line_name, Named, Hash_name, Same_name> by_name;
  std::unordered_map<Triple, uint32_t, Hash> line_by_value;
  std::unordered_map<Place, uint32_t, Hash_place> point_by_place;
  std::vector<Triple> integers; // of points, W > 0
  std::unordered_map<uint64_t, uint32_t> by_lines;

  hsr_named_lines(const hsr_world *w, const hsr_view *v)
      : world(w), view(v), E(hsr::vector<Exact>(v->E)),
        F(hsr::vector<Exact>(v->F)), R(hsr::vector<Exact>(v->R)),
        U(hsr::vector<Exact>(v->U)), m(double(v->m)), n(double(v->n)),
        orientation(CGAL::sign(det(F, R, U))), depth(w ? w->n_faces : 0),
        images(w ? w->mesh.n_vertices : 0) {}

  // --- Functions -------------------------------------------------------------

  // m n g . (x R + y U), x = (2 sx - m)/m and y = (n - 2 sy)/n, as coefficients
  // of sx, sy, 1.
  std::array<Exact, 3> on_screen(const Vector &g) const {
    const Exact along = dot(g, R), up = dot(g, U);
    return {Exact(2.0) * n * along, Exact(-2.0) * m * up, m * n * (up - along)};
  }

  std::array<Exact, 3> edge(uint32_t f, uint32_t k) const {
    const hsr_loop loop = hsr_face_loop(world, f);
    const Vector a = hsr::corner<Exact>(loop, k) - E,
                 b = hsr::corner<Exact>(loop, (k + 1) % loop.n) - E;
    if (!view->parallel) {
      const Vector g = cross(a, b);
      std::array<Exact, 3> value = on_screen(g);
      value[2] = value[2] + m * n * dot(g, F);
      return value;
    }
    std::array<Exact, 3> value = on_screen(cross(F, b - a));
    value[2] = value[2] + m * n * det(a, b, F);
    return value;
  }

  // In perspective q is k N.D / c; in parallel, -N.(S - k P) / c.
  void find_depth(uint32_t f) {
    Depth &d = depth[f];
    const hsr::Plane<Exact> plane =
        hsr::newell_plane<Exact>(hsr_face_loop(world, f));
    const Exact height = plane.offset - plane.k * dot(plane.normal, E),
                down = plane.k * dot(plane.normal, F);
    d.numerator = on_screen(plane.normal);
    for (Exact &x : d.numerator)
      x = plane.k * x;
    const Exact c = view->parallel ? down : height;
    d.numerator[2] = d.numerator[2] + m * n * (view->parallel ? -height : down);
    d.sign = CGAL::sign(c);
    d.denominator = m * n * c;
    if (d.sign < 0) {
      d.denominator = -d.denominator;
      for (Exact &x : d.numerator)
        x = -x;
    }
    for (size_t k = 0; k < 3 && d.sign; k++)
      d.rough[k] = rough_quotient(d.numerator[k], d.denominator);
    d.known = true;
  }

  const Depth &depth_of(uint32_t f) {
    if (!depth[f].known)
      find_depth(f);
    return depth[f];
  }

  std::array<Exact, 3> meeting(uint32_t f, uint32_t g) {
    if (!depth_of(f).sign || !depth_of(g).sign)
      return {Exact(0.0), Exact(0.0), Exact(0.0)};
    const Depth &p = depth[f], &q = depth[g];
    std::array<Exact, 3> value;
    for (size_t k = 0; k < 3; k++)
      value[k] =
          p.numerator[k] * q.denominator - q.numerator[k] * p.denominator;
    return value;
  }

  // 1 - near q, or in parallel -near - q, times the denominator.
  std::array<Exact, 3> near(uint32_t f) {
    const Depth &d = depth_of(f);
    const Exact by = view->parallel ? Exact(1.0) : Exact(view->near);
    std::array<Exact, 3> value = {
        -(by * d.numerator[0]), -(by * d.numerator[1]), -(by * d.numerator[2])};
    value[2] = value[2] + (view->parallel ? -(Exact(view->near) * d.denominator)
                                          : d.denominator);
    return value;
  }

  // sy less that of a corner's image, times |w|.
  std::array<Exact, 3> row(uint32_t f, uint32_t k) const {
    const std::array<Exact, 3> at =
        image(world->mesh.vertex[world->mesh.start[f] + k]);
    const int sign = CGAL::sign(at[2]);
    if (!sign)
      return {Exact(0.0), Exact(0.0), Exact(0.0)};
    return {Exact(0.0), sign > 0 ? at[2] : -at[2], sign > 0 ? -at[1] : at[1]};
  }

  // A vertex as (w sx, w sy, w), times a positive number: with V - E = w (F + x
  // R + y U), by Cramer's rule.
  std::array<Exact, 3> image(uint32_t vertex) const {
    const double place[3] = {world->mesh.x[vertex], world->mesh.y[vertex],
                             world->mesh.z[vertex]};
    const Vector v = hsr::vector<Exact>(place) - E;
    const Exact volume = det(F, R, U);
    Exact w = view->parallel ? volume : det(v, R, U), x = det(F, v, U),
          y = det(F, R, v);
    std::array<Exact, 3> value = {m * (w + x), n * (w - y), Exact(2.0) * w};
    if (CGAL::sign(volume) < 0)
      for (Exact &c : value)
        c = -c;
    return value;
  }

  // The first sign that is not 0: of a value, or of its change along R or -U.
  static int displaced(const Exact &value, const Exact &along_r,
                       const Exact &along_u) {
    if (const int sign = CGAL::sign(value))
      return sign;
    if (const int sign = CGAL::sign(along_r))
      return sign;
    return -CGAL::sign(along_u);
  }

  // A point of the picture as a ray: m n W (F + x R + y U), or in parallel m n
  // W (P - E); and m n W.
  struct Ray {
    Vector d;
    Exact scale;
  };
  Ray ray_of(const Triple &at) const {
    const Exact X(at[0]), Y(at[1]), W(at[2]);
    const Exact along = Exact(2.0) * n * X - m * n * W,
                up = m * n * W - Exact(2.0) * m * Y;
    Vector d = along * R + up * U;
    const Exact scale = m * n * W;
    if (!view->parallel)
      d = d + scale * F;
    return {d, scale};
  }

  // row(v), displaced. Along R it does not change; if along U it does not
  // either, v is parallel to R and counts as below.
  int row_sign(const Ray &ray, const Vector &v) const {
    const Vector from = view->parallel ? ray.scale * v - ray.d : v;
    const Exact value = view->parallel ? det(F, R, from) : det(ray.d, R, from);
    const Exact along_u = view->parallel ? -det(F, R, U) : det(U, R, v);
    const int sign = displaced(value, Exact(0.0), along_u);
    return sign ? sign : 1;
  }

  int edge_sign(const Ray &ray, const Vector &a, const Vector &b) const {
    if (!view->parallel) {
      const Vector g = cross(a, b);
      return displaced(dot(g, ray.d), dot(g, R), dot(g, U));
    }
    const Vector g = cross(F, b - a);
    return displaced(ray.scale * det(a, b, F) + dot(g, ray.d), dot(g, R),
                     dot(g, U));
  }

  bool surrounds(uint32_t f, const Triple &at) {
    const hsr_loop loop = hsr_face_loop(world, f);
    const Ray ray = ray_of(at);
    double place[2];
    find_place(at, place);
    const auto corner = [&](uint32_t k) {
      return hsr::corner<Exact>(loop, k) - E;
    };
    const auto row = [&](uint32_t k) {
      if (const int below = rough_order(place, loop.vertex[k], 1))
        return -orientation * below;
      exact++;
      return row_sign(ray, corner(k));
    };
    bool odd = false;
    int row_a = row(loop.n - 1);
    for (uint32_t k = 0, l = loop.n - 1; k < loop.n; l = k++) {
      const int row_b = row(k);
      if (row_a != row_b) {
        const int right_l = rough_order(place, loop.vertex[l], 0),
                  right_k = rough_order(place, loop.vertex[k], 0);
        if (right_l && right_l == right_k) {
          odd ^= right_l > 0;
        } else {
          exact++;
          odd ^= edge_sign(ray, corner(l), corner(k)) == -row_a;
        }
      }
      row_a = row_b;
    }
    return odd;
  }

  // The sign of the difference of a coordinate between a vertex's image and a
  // point, if the vertex is before the eye and doubles make it certain; else 0.
  int rough_order(const double place[2], uint32_t vertex, int axis) {
    const Image &of = image_of(vertex);
    if (of.w <= 0)
      return 0;
    const double own = point_at(of.point).at[axis], at = place[axis];
    const double bound = SIDE_ERROR * (std::fabs(own) + std::fabs(at)) + LOST;
    return certain_sign(own - at, bound);
  }

  std::array<Exact, 3> border(uint32_t side) const {
    const Exact one(1.0), none(0.0);
    switch (side) {
    case HSR_LEFT:
      return {one, none, none};
    case HSR_TOP:
      return {none, one, none};
    case HSR_RIGHT:
      return {-one, none, m};
    default:
      return {none, -one, n};
    }
  }

  std::array<Exact, 3> function_of(hsr_line_name name) {
    switch (name.kind) {
    case HSR_LINE_EDGE:
      return edge(name.a, name.b);
    case HSR_LINE_MEETING:
      return meeting(name.a, name.b);
    case HSR_LINE_NEAR:
      return near(name.a);
    case HSR_LINE_HORIZON:
      return depth_of(name.a).numerator;
    case HSR_LINE_ROW:
      return row(name.a, name.b);
    default:
      return border(name.a);
    }
  }

  // --- Numbers ---------------------------------------------------------------

  Named add_line(hsr_line_name name) {
    Triple value = integers_of(function_of(name));
    if (is_zero(value))
      return {HSR_NO_LINE, 0};
    Triple key = value;
    const int sign = leading_sign(key);
    if (sign < 0)
      negate(key);
    const auto found = line_by_value.find(key);
    if (found != line_by_value.end()) {
      const int first = leading_sign(line[found->second].exact);
      return {found->second, first * sign};
    }
    Line made = {name, value, {0, 0, 0}, {0, 0}, {{0, 0}}, true};
    const long exponent =
        std::max(exponent_of(value[0]),
                 std::max(exponent_of(value[1]), exponent_of(value[2])));
    for (size_t k = 0; k < 3; k++) {
      made.d[k] = rounded(value[k], exponent);
      made.sum[k] = rounded_to_sum(value[k], exponent);
      made.fine &=
          CGAL::is_zero(value[k]) || std::fabs(made.sum[k].hi) >= LEAST_OF_SUM;
    }
    find_direction(&made);
    const uint32_t number = uint32_t(line.size());
    line.push_back(made);
    line_by_value.emplace(key, number);
    return {number, 1};
  }

  // After a failure a number may be that of no line or point.
  const Line &line_at(uint32_t l) const {
    return l < line.size() ? line[l] : no_line;
  }
  const Point &point_at(uint32_t p) const {
    return p < point.size() ? point[p] : no_point;
  }

  // A sign in integers; 0 if memory runs out.
  template <class Sign> int exactly(const Sign &sign) {
    exact++;
    try {
      return sign();
    } catch (...) {
      failed = true;
      return 0;
    }
  }

  const Image &image_of(uint32_t vertex) {
    Image &made = images[vertex];
    if (made.known)
      return made;
    const std::array<Exact, 3> value = image(vertex);
    made.w = CGAL::sign(value[2]);
    made.toward[0] = CGAL::sign(value[0]);
    made.toward[1] = CGAL::sign(value[1]);
    made.point = add_image(integers_of(value));
    made.known = true;
    return made;
  }

  // --- Points ----------------------------------------------------------------

  // Turns (X, Y, W) so that W > 0. False: the point is at infinity.
  static bool is_finite(Triple &value) {
    const int sign = CGAL::sign(value[2]);
    if (sign < 0)
      negate(value);
    return sign != 0;
  }

  void keep(Point *of, const Triple &value) {
    of->exact = uint32_t(integers.size());
    integers.push_back(value);
  }

  // The integers of a point. Those of a crossing are found when they are asked
  // for.
  const Triple &integers_at(uint32_t p) {
    if (p >= point.size())
      return no_integers;
    if (point[p].exact == NOTHING) {
      Triple value = cross(line_at(point[p].line[0]).exact,
                           line_at(point[p].line[1]).exact);
      is_finite(value);
      keep(&point[p], value);
    }
    return integers[point[p].exact];
  }

  int side(uint32_t p, uint32_t of) {
    const Point &at = point_at(p);
    if (at.line[0] == of || at.line[1] == of)
      return 0;
    const Line &l = line_at(of);
    if (const int sign = rough_sign(l, at.at[0], at.at[1]))
      return sign;
    return exactly([&] {
      const Triple &whole = integers_at(p);
      return int(CGAL::sign(l.exact[0] * whole[0] + l.exact[1] * whole[1] +
                            l.exact[2] * whole[2]));
    });
  }

  uint32_t add_crossing(uint32_t k, uint32_t l) {
    Point made = {{0, 0}, {k, l}, NOTHING, NOTHING};
    if (!nearest_crossing(line_at(k), line_at(l), made.at)) {
      Triple value = cross(line_at(k).exact, line_at(l).exact);
      if (!is_finite(value))
        return HSR_NO_POINT;
      find_place(value, made.at);
    }
    return number_of(
        made, [&](uint32_t p) { return side(p, k) == 0 && side(p, l) == 0; });
  }

  uint32_t add_image(Triple value) {
    if (!is_finite(value))
      return HSR_NO_POINT;
    Point made = {{0, 0}, {HSR_NO_LINE, HSR_NO_LINE}, NOTHING, NOTHING};
    find_place(value, made.at);
    const uint32_t number = number_of(made, [&](uint32_t p) {
      const Triple &other = integers_at(p);
      return value[0] * other[2] == other[0] * value[2] &&
             value[1] * other[2] == other[1] * value[2];
    });
    if (point[number].exact == NOTHING)
      keep(&point[number], value);
    return number;
  }

  // The number of a point, which is new unless it is the same as one of those
  // with the same coordinates in doubles.
  template <class Same> uint32_t number_of(Point made, const Same &is_same) {
    uint32_t &first =
        point_by_place.try_emplace({{made.at[0], made.at[1]}}, NOTHING)
            .first->second;
    for (uint32_t p = first; p != NOTHING; p = point[p].next)
      if (is_same(p))
        return p;
    made.next = first;
    point.push_back(made);
    first = uint32_t(point.size() - 1);
    return first;
  }
};

// --- The interface -----------------------------------------------------------

struct hsr_named_lines *hsr_named_lines_new(const struct hsr_world *world,
                                            const struct hsr_view *view) {
  try {
    return new hsr_named_lines(world, view);
  } catch (...) {
    return nullptr;
  }
}

void hsr_named_lines_free(struct hsr_named_lines *lines) {
  delete lines;
}

bool hsr_named_lines_failed(const struct hsr_named_lines *lines) {
  return lines->failed;
}

uint64_t hsr_named_lines_exact(const struct hsr_named_lines *lines) {
  return lines->exact;
}

uint32_t hsr_line_number(struct hsr_named_lines *lines,
                         struct hsr_line_name name, int *sign) {
  try {
    const auto found = lines->by_name.find(name);
    if (found != lines->by_name.end()) {
      *sign = found->second.sign;
      return found->second.line;
    }
    const Named made = lines->add_line(name);
    lines->by_name.emplace(name, made);
    *sign = made.sign;
    return made.line;
  } catch (...) {
    lines->failed = true;
    *sign = 0;
    return HSR_NO_LINE;
  }
}

struct hsr_line_name hsr_line_name_of(const struct hsr_named_lines *lines,
                                      uint32_t line) {
  return lines->line_at(line).name;
}

int hsr_plane_sign(struct hsr_named_lines *lines, uint32_t face) {
  try {
    return lines->depth_of(face).sign;
  } catch (...) {
    lines->failed = true;
    return 0;
  }
}

/* The directions are (b, -a); their determinant is a b' - a' b. */
int hsr_line_turn(struct hsr_named_lines *lines, uint32_t from, uint32_t to) {
  const Line &k = lines->line_at(from), &l = lines->line_at(to);
  const double p = k.d[0] * l.d[1], q = l.d[0] * k.d[1];
  const double bound = SIDE_ERROR * (std::fabs(p) + std::fabs(q)) + LOST;
  if (p - q > bound)
    return 1;
  if (p - q < -bound)
    return -1;
  return lines->exactly([&] {
    return CGAL::sign(k.exact[0] * l.exact[1] - l.exact[0] * k.exact[1]);
  });
}

void hsr_line_direction(const struct hsr_named_lines *lines, uint32_t line,
                        double direction[2]) {
  direction[0] = lines->line_at(line).direction[0];
  direction[1] = lines->line_at(line).direction[1];
}

int hsr_line_sign_at(struct hsr_named_lines *lines, uint32_t line, double sx,
                     double sy) {
  const Line &l = lines->line_at(line);
  if (const int sign = rough_sign(l, sx, sy))
    return sign;
  const auto exact = [](const Gmpz &x) { return Exact(x); };
  return lines->exactly([&] {
    return CGAL::sign(exact(l.exact[0]) * Exact(sx) +
                      exact(l.exact[1]) * Exact(sy) + exact(l.exact[2]));
  });
}

uint32_t hsr_crossing(struct hsr_named_lines *lines, uint32_t k, uint32_t l) {
  try {
    const uint64_t key =
        uint64_t(std::min(k, l)) << 32 | uint64_t(std::max(k, l));
    const auto found = lines->by_lines.find(key);
    if (found != lines->by_lines.end())
      return found->second;
    const uint32_t made = lines->add_crossing(k, l);
    lines->by_lines.emplace(key, made);
    return made;
  } catch (...) {
    lines->failed = true;
    return HSR_NO_POINT;
  }
}

uint32_t hsr_corner_point(struct hsr_named_lines *lines, uint32_t face,
                          uint32_t k, int *w, int toward[2]) {
  try {
    const hsr_mesh &mesh = lines->world->mesh;
    const Image &image = lines->image_of(mesh.vertex[mesh.start[face] + k]);
    *w = image.w;
    toward[0] = image.toward[0];
    toward[1] = image.toward[1];
    return image.point;
  } catch (...) {
    lines->failed = true;
    *w = 0;
    toward[0] = toward[1] = 0;
    return HSR_NO_POINT;
  }
}

bool hsr_parity_between(struct hsr_named_lines *lines, uint32_t face,
                        uint32_t p, uint32_t q) {
  try {
    const Triple a = lines->integers_at(p), b = lines->integers_at(q);
    return lines->surrounds(face,
                            {a[0] * b[2] + b[0] * a[2],
                             a[1] * b[2] + b[1] * a[2], Gmpz(2) * a[2] * b[2]});
  } catch (...) {
    lines->failed = true;
    return false;
  }
}

int hsr_crossing_side(struct hsr_named_lines *lines, uint32_t point,
                      uint32_t line) {
  return lines->side(point, line);
}

/* The difference of two depths, each a sum of three terms. */
int hsr_nearer_at(struct hsr_named_lines *lines, uint32_t f, uint32_t g,
                  uint32_t point) {
  try {
    const Depth &p = lines->depth_of(f), &q = lines->depth_of(g);
    const double *at = lines->point_at(point).at;
    if (!p.sign || !q.sign)
      return 0;
    const double of_p[2] = {p.rough[0] * at[0], p.rough[1] * at[1]},
                 of_q[2] = {q.rough[0] * at[0], q.rough[1] * at[1]};
    const double by =
        (of_p[0] + of_p[1] + p.rough[2]) - (of_q[0] + of_q[1] + q.rough[2]);
    double size = std::fabs(p.rough[2]) + std::fabs(q.rough[2]);
    for (int k = 0; k < 2; k++)
      size += std::fabs(of_p[k]) + std::fabs(of_q[k]);
    return certain_sign(by, SIDE_ERROR * size + LOST);
  } catch (...) {
    lines->failed = true;
    return 0;
  }
}

int hsr_crossing_compare(struct hsr_named_lines *lines, uint32_t p, uint32_t q,
                         int axis) {
  if (p == q)
    return 0;
  const Point &a = lines->point_at(p), &b = lines->point_at(q);
  const double by = a.at[axis] - b.at[axis];
  const double bound =
      SIDE_ERROR * (std::fabs(a.at[axis]) + std::fabs(b.at[axis])) + LOST;
  if (by > bound)
    return 1;
  if (by < -bound)
    return -1;
  return lines->exactly([&] {
    const Triple of_p = lines->integers_at(p), &of_q = lines->integers_at(q);
    return CGAL::compare(of_p[size_t(axis)] * of_q[2],
                         of_q[size_t(axis)] * of_p[2]);
  });
}

int hsr_crossing_compare_to(struct hsr_named_lines *lines, uint32_t p, int axis,
                            double at) {
  const Point &a = lines->point_at(p);
  const double by = a.at[axis] - at;
  const double bound =
      SIDE_ERROR * (std::fabs(a.at[axis]) + std::fabs(at)) + LOST;
  if (by > bound)
    return 1;
  if (by < -bound)
    return -1;
  return lines->exactly([&] {
    const Triple &exact = lines->integers_at(p);
    return CGAL::sign(Exact(exact[size_t(axis)]) - Exact(at) * Exact(exact[2]));
  });
}

void hsr_crossing_at(const struct hsr_named_lines *lines, uint32_t point,
                     double at[2]) {
  at[0] = lines->point_at(point).at[0];
  at[1] = lines->point_at(point).at[1];
}
