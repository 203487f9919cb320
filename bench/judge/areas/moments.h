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
 *             TU München 1996).
 * Fixed       a first answer takes corners that are rounded down to multiples of
 *             u = 2^-FIXED. A side of length √2 at most, whose ends move by √2 u
 *             at most, sweeps less than 3u. As |x^p y^q| <= 1, the moment of a
 *             cell of n corners changes by less than 3nu; it is rounded down to
 *             a multiple of u itself. */
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

/* What a cell adds to the integrals of piece k across and piece l down, times
 * (d!)^2: at [k * (d + 1) + l]. */
using fixed_integrals = std::vector<mpz_class>; /* in u */
using exact_integrals = std::vector<mpq_class>;
void add_fixed(const cell &part, int degree, int atom_x, int atom_y,
               fixed_integrals *sums, unsigned long *error);
void add_exact(const cell &part, int degree, int atom_x, int atom_y,
               exact_integrals *sums);

} // namespace areas

#endif
