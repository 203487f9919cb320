// SPDX-License-Identifier: GPL-3.0-or-later
// Splats in rational numbers.
#include "common/exact/footprint.h"

#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>

using Number = CGAL::Gmpq;
using Vector = CGAL::Simple_cartesian<Number>::Vector_3;

const int hsr_kernel_reach[] = {1556228, 2000000};
const int hsr_blur_factor[][2] = {{0, 0}, {409079, 318310}, {850918, 666911}};

namespace {

Vector vector(const double v[3]) {
  return {Number(v[0]), Number(v[1]), Number(v[2])};
}

Number det(const Vector &a, const Vector &b, const Vector &c) {
  return CGAL::cross_product(a, b) * c;
}

// The greatest integer that is at most x, which is not far from 0.
long floor_of(const Number &x) {
  mpz_t whole;
  mpz_init(whole);
  mpz_fdiv_q(whole, mpq_numref(x.mpq()), mpq_denref(x.mpq()));
  const long floor = mpz_fits_slong_p(whole) ? mpz_get_si(whole)
                     : mpz_sgn(whole) < 0    ? LONG_MIN
                                             : LONG_MAX;
  mpz_clear(whole);
  return floor;
}

// The greatest integer whose square is at most x.
int root_of(long x) {
  int root = 0;
  while (long(root + 1) * (root + 1) <= x)
    root++;
  return root;
}

struct Camera {
  const hsr_view &view;
  Vector E, F, R, U;

  explicit Camera(const hsr_view &v)
      : view(v), E(vector(v.E)), F(vector(v.F)), R(vector(v.R)),
        U(vector(v.U)) {}

  // The depth t of a point.
  Number depth(const Vector &point) const {
    return det(point - E, R, U) / det(F, R, U);
  }
};

// The depths that buckets divide.
struct Depths {
  Number least, most;

  Depths(const Camera &camera, const double lo[3], const double hi[3]) {
    for (int corner = 0; corner < 8; corner++) {
      const double at[3] = {corner & 1 ? hi[0] : lo[0],
                            corner & 2 ? hi[1] : lo[1],
                            corner & 4 ? hi[2] : lo[2]};
      const Number t = camera.depth(vector(at));
      least = corner ? std::min(least, t) : t;
      most = corner ? std::max(most, t) : t;
    }
    least = std::max(least, Number(camera.view.near));
  }

  // Where bucket `bucket` of n ends.
  Number end_of(int bucket, int n) const {
    return least + (most - least) * Number(bucket + 1) / Number(n);
  }
};

struct Splat : Camera {
  const hsr_splat &splat;
  Vector P;

  explicit Splat(const hsr_splat &s)
      : Camera(*s.view), splat(s), P(vector(s.at)) {}

  Vector by_cell(const Vector &v) const {
    return {v.x() / Number(splat.size[0]), v.y() / Number(splat.size[1]),
            v.z() / Number(splat.size[2])};
  }

  // g^2.
  Number widening() const {
    const Number width(splat.width);
    if (!splat.antialias)
      return width * width;
    const Vector u = by_cell(U), r = by_cell(R);
    const Number m(view.whole_m), n(view.whole_n);
    Number apart = Number(2) * (u * u / (n * n) + r * r / (m * m));
    if (!view.parallel) {
      const Number t = depth(P);
      apart = apart * t * t;
    }
    return width * width * std::max(Number(1), apart);
  }

  // (g r)^2.
  Number reach() const {
    const Number r(hsr_kernel_reach[splat.kernel], 1000000);
    return widening() * r * r;
  }

  // xR + yU of a pixel.
  Vector across(int i, int j) const {
    const Number m(view.whole_m), n(view.whole_n);
    const Number sx(hsr_sample_x(&view, i)), sy(hsr_sample_y(&view, j));
    const Number x = Number(2) * (sx + Number(view.left)) / m - Number(1);
    const Number y = Number(1) - Number(2) * (sy + Number(view.top)) / n;
    return x * R + y * U;
  }

  // V' and D' of a point of the screen, given by xR + yU.
  void ray(const Vector &screen, Vector &v, Vector &d) const {
    v = by_cell(view.parallel ? P - E - screen : P - E);
    d = by_cell(view.parallel ? F : F + screen);
  }

  // The point of a ray that gives rho, from P and in cells. False: in
  // perspective the ray goes away from the splat.
  bool meet(const Vector &v, const Vector &d, Vector &point) const {
    const Number vd = v * d;
    if (!view.parallel && vd <= Number(0))
      return false;
    point = (view.parallel ? vd / (d * d) : v * v / vd) * d - v;
    return true;
  }

  // Q. False: it is not blurred.
  bool find_way(Vector &way) const {
    const hsr_view_before &b = view.before;
    if (!splat.blur || !b.exists)
      return false;
    const Vector V0 = P - vector(b.E), F0 = vector(b.F), R0 = vector(b.R),
                 U0 = vector(b.U);
    const Number by = Number(1) / det(F0, R0, U0), t = det(V0, R0, U0) * by;
    if (t <= Number(b.near))
      return false;
    const Number per_w = b.parallel ? by : by / t;
    Vector v, d;
    ray(per_w * det(F0, V0, U0) * R + per_w * det(F0, R0, V0) * U, v, d);
    const Number threshold(splat.threshold);
    return meet(v, d, way) && way * way > threshold * threshold;
  }

  // e.
  long energy() const {
    const Number g2 = widening();
    Vector way;
    if (!find_way(way))
      return floor_of(Number(65536) / g2);
    // c g l is the root of this. e is the last integer for which g^2 + c g l <=
    // 65536 / e.
    const Number c(hsr_blur_factor[splat.blur][splat.kernel], 1000000);
    const Number longer = c * c * g2 * (way * way);
    long least = 0, beyond = floor_of(Number(65536) / g2) + 1;
    while (least + 1 < beyond) {
      const long e = least + (beyond - least) / 2;
      const Number left = Number(65536) / Number(e) - g2;
      (left >= Number(0) && left * left >= longer ? least : beyond) = e;
    }
    return least;
  }

  // Finds V' + sQ, D' and the square of the distance for the ray of a pixel.
  // False: the ray does not pass the splat.
  bool pass(int i, int j, Vector &v, Vector &d, Number &square) const {
    Vector point, way;
    ray(across(i, j), v, d);
    if (!meet(v, d, point))
      return false;
    if (find_way(way)) {
      const Number along = point * way / (way * way);
      const Number s = std::min(std::max(along, Number(0)), Number(1));
      point = point - s * way;
      v = v + s * way;
    }
    square = point * point;
    return true;
  }

  int footprint(int i, int j) const {
    Vector v, d;
    Number square;
    if (!pass(i, j, v, d, square))
      return HSR_FOOTPRINT;
    return int(std::min(floor_of(Number(HSR_FOOTPRINT) * square / reach()),
                        long(HSR_FOOTPRINT)));
  }

  int part(int i, int j, const Number &end) const {
    Vector v, d;
    Number square;
    pass(i, j, v, d, square);
    const Number dd = d * d, past = end - v * d / dd;
    square =
        Number(HSR_FOOTPRINT_PARTS * HSR_FOOTPRINT_PARTS) * past * past * dd;
    const long most = HSR_FOOTPRINT_PARTS * HSR_FOOTPRINT_PARTS;
    const int root = root_of(std::min(floor_of(square / reach()), most));
    return past < Number(0) ? -root : root;
  }
};

template <class Answer, class Find>
Answer guarded(bool *out_of_memory, Answer otherwise,
               const Find &find) noexcept {
  try {
    return find();
  } catch (...) {
    *out_of_memory = true;
    return otherwise;
  }
}

} // namespace

bool hsr_exact_is_beyond_near(const struct hsr_splat *splat,
                              bool *out_of_memory) {
  return guarded(out_of_memory, false, [&] {
    const Splat s(*splat);
    return s.depth(s.P) > Number(splat->view->near);
  });
}

bool hsr_exact_is_blurred(const struct hsr_splat *splat, bool *out_of_memory) {
  return guarded(out_of_memory, false, [&] {
    Vector way;
    return Splat(*splat).find_way(way);
  });
}

uint32_t hsr_exact_energy(const struct hsr_splat *splat, bool *out_of_memory) {
  return guarded(out_of_memory, uint32_t(0),
                 [&] { return uint32_t(Splat(*splat).energy()); });
}

int hsr_exact_footprint(const struct hsr_splat *splat, int i, int j,
                        bool *out_of_memory) {
  return guarded(out_of_memory, int(HSR_FOOTPRINT),
                 [&] { return Splat(*splat).footprint(i, j); });
}

bool hsr_exact_is_deep(const struct hsr_view *view, const double lo[3],
                       const double hi[3], bool *out_of_memory) {
  return guarded(out_of_memory, false, [&] {
    const Depths depths(Camera(*view), lo, hi);
    return depths.least < depths.most;
  });
}

int hsr_exact_footprint_part(const struct hsr_splat *splat, int i, int j,
                             const double lo[3], const double hi[3], int bucket,
                             int n, bool *out_of_memory) {
  return guarded(out_of_memory, 0, [&] {
    const Splat s(*splat);
    return s.part(i, j, Depths(s, lo, hi).end_of(bucket, n));
  });
}
