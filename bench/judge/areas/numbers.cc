/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/judge/areas/numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace areas {

/* ---- Functions ---- */

namespace {

long exponent_of(const Exact &a) {
  return CGAL::is_zero(a) ? std::numeric_limits<long>::max() : a.exp();
}

mpz_class scaled(const Exact &a, long exponent) {
  mpz_class n(a.man());
  if (n != 0)
    n <<= mp_bitcnt_t(a.exp() - exponent);
  return n;
}

/* An interval that holds num / den. */
Interval quotient(const mpz_class &num, const mpz_class &den) {
  double low;
  if (num < 0) {
    const Interval minus = quotient(-num, den);
    return -minus;
  }
  const bool equal = down_to_double(num, den, &low);
  return {low,
          equal ? low
                : std::nextafter(low, std::numeric_limits<double>::infinity())};
}

} // namespace

whole_affine whole(const affine<Exact> &f) {
  const long least =
      std::min({exponent_of(f.a), exponent_of(f.b), exponent_of(f.c)});
  whole_affine n = {scaled(f.a, least), scaled(f.b, least), scaled(f.c, least)};
  const mpz_class divisor = gcd(gcd(n.a, n.b), n.c);
  if (divisor > 1) {
    n.a /= divisor;
    n.b /= divisor;
    n.c /= divisor;
  }
  return n;
}

const whole_affine &line::exactly() {
  if (find) {
    exact = whole(find(*this));
    find = nullptr;
  }
  return exact;
}

/* ---- Points ---- */

namespace {

void place_roughly(point *at) {
  at->x = quotient(at->X, at->W);
  at->y = quotient(at->Y, at->W);
}

} // namespace

void point::make_exact() {
  if (!p)
    return;
  const whole_affine &f = p->exactly(), &g = q->exactly();
  X = f.b * g.c - f.c * g.b;
  Y = f.c * g.a - f.a * g.c;
  W = f.a * g.b - f.b * g.a;
  if (W < 0) {
    X = -X;
    Y = -Y;
    W = -W;
  }
  p = q = nullptr;
}

/* Where lines are nearly parallel the intervals are wide, and of little use. */
void meet(point *made, line *p, line *q) {
  made->p = p;
  made->q = q;
  const affine<Interval> &f = p->rough, &g = q->rough;
  const Interval w = f.a * g.b - f.b * g.a;
  made->x = (f.b * g.c - f.c * g.b) / w;
  made->y = (f.c * g.a - f.a * g.c) / w;
  const double wide = 0x1p-30;
  if (made->x.sup() - made->x.inf() < wide &&
      made->y.sup() - made->y.inf() < wide)
    return;
  made->make_exact();
  place_roughly(made);
}

void place(point *made, double x, double y, double w) {
  made->p = made->q = nullptr;
  made->X = x;
  made->Y = y;
  made->W = w;
  made->x = Interval(x / w);
  made->y = Interval(y / w);
}

int sign_at(line &f, point &at) {
  const int guess = rough_sign(f, at);
  if (guess != UNSURE)
    return guess;
  const whole_affine &e = f.exactly();
  at.make_exact();
  return sgn(mpz_class(e.a * at.X + e.b * at.Y + e.c * at.W));
}

/* ---- Doubles ---- */

bool down_to_double(const mpz_class &num, const mpz_class &den, double *low) {
  *low = 0;
  if (num == 0)
    return true;
  /* The quotient times 2^shift has 53 or 54 bits before the point. */
  long shift = 54 - long(mpz_sizeinbase(num.get_mpz_t(), 2)) +
               long(mpz_sizeinbase(den.get_mpz_t(), 2));
  shift = std::min(shift, 1074L); /* no double has more bits after the point */
  mpz_class n = num, d = den, quotient, rest;
  if (shift >= 0)
    n <<= mp_bitcnt_t(shift);
  else
    d <<= mp_bitcnt_t(-shift);
  mpz_fdiv_qr(quotient.get_mpz_t(), rest.get_mpz_t(), n.get_mpz_t(),
              d.get_mpz_t());
  bool equal = rest == 0;
  const size_t bits = mpz_sizeinbase(quotient.get_mpz_t(), 2);
  if (quotient != 0 && bits > 53) {
    const mp_bitcnt_t more = mp_bitcnt_t(bits - 53);
    equal = equal && mpz_divisible_2exp_p(quotient.get_mpz_t(), more);
    quotient >>= more;
    shift -= long(more);
  }
  *low = std::ldexp(quotient.get_d(), int(-shift));
  return equal;
}

} // namespace areas
