// SPDX-License-Identifier: GPL-3.0-or-later
// Splats in rational numbers.
#include "common/exact/footprint.h"

#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>

using Number = CGAL::Gmpq;
using Vector = CGAL::Simple_cartesian<Number>::Vector_3;

const int hsr_kernel_reach[] = {1556228, 2000000};

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
    const Number m(view.m), n(view.n);
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
    const Number m(view.m), n(view.n);
    const Number x = Number(2) * Number(hsr_sample_x(&view, i)) / m - Number(1);
    const Number y = Number(1) - Number(2) * Number(hsr_sample_y(&view, j)) / n;
    return x * R + y * U;
  }

  // V' and D' of a pixel.
  void ray(int i, int j, Vector &v, Vector &d) const {
    const Vector screen = across(i, j);
    v = by_cell(view.parallel ? P - E - screen : P - E);
    d = by_cell(view.parallel ? F : F + screen);
  }

  int footprint(int i, int j) const {
    Vector v, d;
    ray(i, j, v, d);
    const Number vd = v * d, vv = v * v, dd = d * d;
    Number square;
    if (view.parallel)
      square = vv - vd * vd / dd;
    else if (vd <= Number(0))
      return HSR_FOOTPRINT;
    else
      square = vv * (vv * dd - vd * vd) / (vd * vd);
    return int(std::min(floor_of(Number(HSR_FOOTPRINT) * square / reach()),
                        long(HSR_FOOTPRINT)));
  }

  int part(int i, int j, const Number &end) const {
    Vector v, d;
    ray(i, j, v, d);
    const Number dd = d * d, past = end - v * d / dd;
    const Number square =
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

uint32_t hsr_exact_energy(const struct hsr_splat *splat, bool *out_of_memory) {
  return guarded(out_of_memory, uint32_t(0), [&] {
    return uint32_t(floor_of(Number(65536) / Splat(*splat).widening()));
  });
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
