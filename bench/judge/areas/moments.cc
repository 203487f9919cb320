/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/judge/areas/moments.h"

#include <algorithm>

namespace areas {

const int factorial[MOST_PIECES + 1] = {1, 1, 2, 6, 24};

const int piece[MOST_PIECES][MOST_PIECES][MOST_PIECES] = {
    {{1}},
    {{0, 1}, {1, -1}},
    {{0, 0, 1}, {1, 2, -2}, {1, -2, 1}},
    {{0, 0, 0, 1}, {1, 3, 3, -3}, {4, 0, -6, 3}, {1, -3, 3, -1}}};

span atom_span(int degree, int n, int atom) {
  const int from = 2 * atom - degree % 2;
  return {std::max(from, 0), std::min(from + 2, 2 * n)};
}

long whole_scale(int degree) {
  return long(factorial[degree] * factorial[degree + 1]) << (degree + 1);
}

namespace {

/* x = half/2, to a power, 2^power times. */
long power_of(int half, int power) {
  long p = 1;
  while (power-- > 0)
    p *= half;
  return p;
}

long binomial(int n, int k) {
  long b = 1;
  for (int i = 1; i <= k; i++)
    b = b * (n - k + i) / i;
  return b;
}

} // namespace

/* The integral of x^e is (to^(e+1) - from^(e+1)) / (e + 1). */
long whole_piece(int degree, int n, int atom, int k) {
  const int begin = 2 * atom - degree % 2;
  const span s = atom_span(degree, n, atom);
  long sum = 0;
  for (int e = 0; e <= degree; e++) {
    const long from = power_of(s.from - begin, e + 1),
               to = power_of(s.to - begin, e + 1);
    sum += piece[degree][k][e] * (to - from) * (1L << (degree - e)) *
           (factorial[degree + 1] / (e + 1));
  }
  return sum;
}

/* ---- Moments ---- */

namespace {

/* x and y of a polygon's corners. */
template <class T> struct polygon { std::vector<T> x, y; };

/* The powers of a number up to the degree. */
template <class T> struct powers {
  T of[MOST_PIECES];

  powers(const T &x, int degree) {
    of[0] = 1;
    for (int e = 1; e <= degree; e++)
      of[e] = of[e - 1] * x;
  }
};

/* Of M(p, q): the integer that it is to be divided by. */
long divisor(int p, int q) {
  return (p + q + 2) * (p + q + 1) * binomial(p + q, p);
}

/* Adds to M(p, q), divisor times, what the side from a to b gives. */
template <class T>
void add_side(const powers<T> &xa, const powers<T> &ya, const powers<T> &xb,
              const powers<T> &yb, const T &turn, int degree, T *moment) {
  for (int p = 0; p <= degree; p++)
    for (int q = 0; q <= degree; q++) {
      T sum = 0;
      for (int k = 0; k <= p; k++)
        for (int l = 0; l <= q; l++) {
          const long many = binomial(k + l, l) * binomial(p + q - k - l, q - l);
          sum += T(many * xb.of[k] * xa.of[p - k]) * T(yb.of[l] * ya.of[q - l]);
        }
      moment[p * MOST_PIECES + q] += turn * sum;
    }
}

/* M(p, q), divisor times, at [p * MOST_PIECES + q]. */
template <class T>
void find_moments(const polygon<T> &around, int degree, T *moment) {
  const size_t n = around.x.size();
  powers<T> xa(around.x[n - 1], degree), ya(around.y[n - 1], degree);
  for (size_t i = 0; i < n; i++) {
    const powers<T> xb(around.x[i], degree), yb(around.y[i], degree);
    const size_t before = i ? i - 1 : n - 1;
    const T turn =
        around.x[before] * around.y[i] - around.x[i] * around.y[before];
    add_side(xa, ya, xb, yb, turn, degree, moment);
    xa = xb;
    ya = yb;
  }
}

/* Adds the moments, each times the coefficients of the pieces. */
template <class T>
void add_pieces(const T *moment, int degree, std::vector<T> *sums) {
  for (int k = 0; k <= degree; k++)
    for (int l = 0; l <= degree; l++) {
      T &sum = (*sums)[size_t(k * (degree + 1) + l)];
      for (int p = 0; p <= degree; p++)
        for (int q = 0; q <= degree; q++)
          if (const long both = long(piece[degree][k][p]) * piece[degree][l][q])
            sum += both * moment[p * MOST_PIECES + q];
    }
}

} // namespace

void add_fixed(const cell &part, int degree, int atom_x, int atom_y,
               fixed_integrals *sums, unsigned long *error) {
  polygon<mpz_class> around;
  const auto round = [](const mpz_class &num, const mpz_class &den) {
    mpz_class down;
    const mpz_class n = num << (FIXED - 1);
    mpz_fdiv_q(down.get_mpz_t(), n.get_mpz_t(), den.get_mpz_t());
    return down;
  };
  const long x0 = 2 * atom_x - degree % 2, y0 = 2 * atom_y - degree % 2;
  for (point *c : part.corner) {
    c->make_exact();
    around.x.push_back(round(2 * c->X - x0 * c->W, c->W));
    around.y.push_back(round(2 * c->Y - y0 * c->W, c->W));
  }
  mpz_class moment[MOST_PIECES * MOST_PIECES];
  find_moments(around, degree, moment);
  for (int p = 0; p <= degree; p++)
    for (int q = 0; q <= degree; q++) {
      mpz_class &m = moment[p * MOST_PIECES + q];
      const mpz_class den = mpz_class(divisor(p, q))
                            << mp_bitcnt_t(FIXED * (p + q + 1));
      mpz_fdiv_q(m.get_mpz_t(), m.get_mpz_t(), den.get_mpz_t());
    }
  add_pieces(moment, degree, sums);

  /* The coefficients of two pieces are at most 13 in sum, each. */
  *error += 13 * 13 * (3 * part.corner.size() + 1);
}

void add_exact(const cell &part, int degree, int atom_x, int atom_y,
               exact_integrals *sums) {
  polygon<mpq_class> around;
  const long x0 = 2 * atom_x - degree % 2, y0 = 2 * atom_y - degree % 2;
  const auto ratio = [](const mpz_class &num, const mpz_class &den) {
    mpq_class q(num, den);
    q.canonicalize();
    return q;
  };
  for (point *c : part.corner) {
    c->make_exact();
    around.x.push_back(ratio(2 * c->X - x0 * c->W, 2 * c->W));
    around.y.push_back(ratio(2 * c->Y - y0 * c->W, 2 * c->W));
  }
  mpq_class moment[MOST_PIECES * MOST_PIECES];
  find_moments(around, degree, moment);
  for (int p = 0; p <= degree; p++)
    for (int q = 0; q <= degree; q++)
      moment[p * MOST_PIECES + q] /= divisor(p, q);
  add_pieces(moment, degree, sums);
}

} // namespace areas
