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

/* A corner (x/w, y/w), and powers. */
struct end {
  mpz_class x[MOST_PIECES], y[MOST_PIECES], w[2 * MOST_DEGREE + 1];

  end(const mpz_class &x1, const mpz_class &y1, const mpz_class &w1,
      int degree) {
    x[0] = y[0] = w[0] = 1;
    for (int e = 1; e <= degree; e++) {
      x[e] = x[e - 1] * x1;
      y[e] = y[e - 1] * y1;
    }
    for (int e = 1; e <= 2 * degree; e++)
      w[e] = w[e - 1] * w1;
  }
};

/* Of M(p, q): the integer that it is to be divided by. */
long divisor(int p, int q) {
  return (p + q + 2) * (p + q + 1) * binomial(p + q, p);
}

size_t place_of(int p, int q) {
  return size_t(p * MOST_PIECES + q);
}

/* What the side from a to b gives to M(p, q), but for xa yb - xb ya: times the
 * divisor and (wa wb)^(p + q). */
mpz_class side_sum(const end &a, const end &b, int p, int q) {
  mpz_class sum = 0;
  for (int k = 0; k <= p; k++)
    for (int l = 0; l <= q; l++) {
      const long many = binomial(k + l, l) * binomial(p + q - k - l, q - l);
      sum += many * (b.x[k] * b.y[l] * b.w[p + q - k - l]) *
             (a.x[p - k] * a.y[q - l] * a.w[k + l]);
    }
  return sum;
}

/* Calls take(p, q, a, b, numerator) for each side and moment of a polygon of
 * corners (x/w, y/w); the sum is numerator / (divisor (wa wb)^(p + q + 1)). */
struct corner {
  mpz_class x, y, w;
};
template <class Take>
void for_sides(const std::vector<corner> &around, int degree, Take take) {
  std::vector<end> ends;
  for (const corner &c : around)
    ends.emplace_back(c.x, c.y, c.w, degree);
  for (size_t i = 0; i < around.size(); i++) {
    const size_t j = i + 1 == around.size() ? 0 : i + 1;
    const mpz_class turn =
        around[i].x * around[j].y - around[j].x * around[i].y;
    for (int p = 0; p <= degree; p++)
      for (int q = 0; q <= degree; q++)
        take(p, q, i, j, turn * side_sum(ends[i], ends[j], p, q));
  }
}

/* Moments, each times the coefficients of the pieces. */
template <class T>
std::vector<T> all_pieces(const std::vector<T> &moment, int degree) {
  std::vector<T> sums;
  for (int k = 0; k <= degree; k++)
    for (int l = 0; l <= degree; l++) {
      T sum = 0;
      for (int p = 0; p <= degree; p++)
        for (int q = 0; q <= degree; q++)
          if (const long both = long(piece[degree][k][p]) * piece[degree][l][q])
            sum += both * moment[place_of(p, q)];
      sums.push_back(sum);
    }
  return sums;
}

/* The corners of a cell in the frame of an atom. */
std::vector<corner> corners_of(const cell &part, int degree, int atom_x,
                               int atom_y) {
  const long x0 = 2 * atom_x - degree % 2, y0 = 2 * atom_y - degree % 2;
  std::vector<corner> all;
  for (point *c : part.corner) {
    c->make_exact();
    all.push_back({2 * c->X - x0 * c->W, 2 * c->Y - y0 * c->W, 2 * c->W});
  }
  return all;
}

} // namespace

/* ---- Fixed ---- */

void fixed_sum::add(const cell &part, int degree, int atom_x, int atom_y) {
  std::vector<corner> around = corners_of(part, degree, atom_x, atom_y);
  for (corner &c : around) {
    c.x <<= FIXED;
    c.y <<= FIXED;
    mpz_fdiv_q(c.x.get_mpz_t(), c.x.get_mpz_t(), c.w.get_mpz_t());
    mpz_fdiv_q(c.y.get_mpz_t(), c.y.get_mpz_t(), c.w.get_mpz_t());
    c.w = 1;
  }
  for_sides(around, degree, [&](int p, int q, size_t, size_t, mpz_class term) {
    moment_[place_of(p, q)] += term;
  });
  corners_ += around.size();
}

std::vector<mpz_class> fixed_sum::integrals(int degree) const {
  std::vector<mpz_class> moment(moment_, moment_ + MOST_PIECES * MOST_PIECES);
  for (int p = 0; p <= degree; p++)
    for (int q = 0; q <= degree; q++) {
      mpz_class &m = moment[place_of(p, q)];
      const mpz_class den = mpz_class(divisor(p, q))
                            << mp_bitcnt_t(FIXED * (p + q + 1));
      mpz_fdiv_q(m.get_mpz_t(), m.get_mpz_t(), den.get_mpz_t());
    }
  return all_pieces(moment, degree);
}

/* The coefficients of a piece are at most 13 in sum. */
unsigned long fixed_sum::error() const {
  return 13 * 13 * (3 * corners_ + 1);
}

/* ---- Exact ---- */

void exact_sum::push(std::vector<mpq_class> moment) {
  int level = 0;
  while (!digits_.empty() && digits_.back().level == level) {
    for (size_t k = 0; k < moment.size(); k++)
      moment[k] += digits_.back().moment[k];
    digits_.pop_back();
    level++;
  }
  digits_.push_back({level, std::move(moment)});
}

void exact_sum::add(const cell &part, int degree, int atom_x, int atom_y) {
  const std::vector<corner> around = corners_of(part, degree, atom_x, atom_y);
  std::vector<mpq_class> moment(MOST_PIECES * MOST_PIECES);
  for_sides(around, degree,
            [&](int p, int q, size_t a, size_t b, const mpz_class &term) {
              mpz_class den = around[a].w * around[b].w;
              mpz_pow_ui(den.get_mpz_t(), den.get_mpz_t(),
                         (unsigned long)(p + q + 1));
              mpq_class side(term, divisor(p, q) * den);
              side.canonicalize();
              moment[place_of(p, q)] += side;
            });
  push(std::move(moment));
}

std::vector<mpq_class> exact_sum::integrals(int degree) const {
  std::vector<mpq_class> sum(MOST_PIECES * MOST_PIECES);
  for (size_t i = digits_.size(); i-- > 0;)
    for (size_t k = 0; k < sum.size(); k++)
      sum[k] += digits_[i].moment[k];
  return all_pieces(sum, degree);
}

} // namespace areas
