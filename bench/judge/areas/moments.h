/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Integrals of the pieces of a filter over cells.
 *
 * Filters     the B-spline of degree d has d + 1 pieces, polynomials of degree d
 *             on intervals of length 1. Those of even degree begin at integers,
 *             those of odd degree half way between. An atom is a square between
 *             such places, cut off at the picture's border. Piece k of pixel i
 *             lies on atom i + k + first_piece(d).
 * Frame       x and y run from 0 to 1 through an atom.
 * Integrals   the polynomials are taken d! times, to be of integers. Over a
 *             cell, the moments M(p, q) = ∫∫ x^p y^q are sums over its sides
 *             (C. Steger, "On the calculation of arbitrary moments of polygons",
 *             TU München 1996), here in the homogeneous coordinates of corners:
 *             the sums are integers over powers of the W of both ends.
 * Fixed       a first answer takes corners that are rounded down to multiples of
 *             u = 2^-FIXED. A side of length √2 at most, whose ends move by √2 u
 *             at most, sweeps less than 3u. As |x^p y^q| <= 1, the moment of a
 *             cell of n corners changes by less than 3nu; the sum over cells is
 *             rounded down to a multiple of u. */
#ifndef HSR_BENCH_JUDGE_AREAS_MOMENTS_H
#define HSR_BENCH_JUDGE_AREAS_MOMENTS_H

#include "bench/judge/areas/cells.h"

namespace areas {

enum { MOST_DEGREE = 3, MOST_PIECES = MOST_DEGREE + 1, FIXED = 256 };

/* Coefficients by powers of x, d! times. */
extern const int piece[MOST_PIECES][MOST_PIECES][MOST_PIECES];
extern const int factorial[MOST_PIECES + 1];
constexpr int first_piece(int degree) {
  return degree < 2 ? 0 : -1;
}

/* Atoms along an axis that is n pixels long; and the ends of one, in halves. */
constexpr int n_atoms(int degree, int n) {
  return n + degree % 2;
}
struct span {
  int from, to;
};
span atom_span(int degree, int n, int atom);

/* The integral of piece k over an atom, whole_scale() times: d! (d + 1)! 2^(d+1)
 * times. */
long whole_piece(int degree, int n, int atom, int k);
long whole_scale(int degree);

/* The integrals of all pieces over the cells of one face in an atom, times
 * (d!)^2: that of piece k across and l down at [k * (d + 1) + l]. */
class fixed_sum {
public:
  void add(const cell &part, int degree, int atom_x, int atom_y);
  std::vector<mpz_class> integrals(int degree) const; /* in u */
  /* How far any of these is from the truth, at most. */
  unsigned long error() const;

private:
  mpz_class moment_[MOST_PIECES * MOST_PIECES];
  unsigned long corners_ = 0;
};

/* Sums of 2^k terms are kept apart, as the digits of a binary counter. So numbers
 * of like length are added. */
class exact_sum {
public:
  void add(const cell &part, int degree, int atom_x, int atom_y);
  std::vector<mpq_class> integrals(int degree) const;

private:
  struct digit {
    int level;
    std::vector<mpq_class> moment;
  };
  std::vector<digit> digits_;

  void push(std::vector<mpq_class> moment);
};

} // namespace areas

#endif
