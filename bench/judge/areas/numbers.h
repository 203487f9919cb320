/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers of the area picture: affine functions of the picture plane, and
 * points of it, each in intervals and, where these leave a sign open, exactly.
 *
 * Notation    a point is (X/W, Y/W) with integers X, Y, W > 0; a function is
 *             a sx + b sy + c, known up to a positive factor. So the sign of a
 *             function at a point is that of the integer a X + b Y + c W.
 * Rounding    all of this is used only while an Upward lives. */
#ifndef HSR_BENCH_JUDGE_AREAS_NUMBERS_H
#define HSR_BENCH_JUDGE_AREAS_NUMBERS_H

#include "bench/judge/rounding.h"

#include <CGAL/Gmpzf.h>
#include <gmpxx.h>

namespace areas {

using Exact = CGAL::Gmpzf;
using judge::Interval, judge::Nearest, judge::Upward;

enum : int { UNSURE = 2 };

inline int sign_of(const Interval &a) {
  return a.inf() > 0                    ? 1
         : a.sup() < 0                  ? -1
         : a.inf() == 0 && a.sup() == 0 ? 0
                                        : int(UNSURE);
}

template <class T> struct affine { T a, b, c; };

using whole_affine = affine<mpz_class>;

/* The same function up to a positive factor, in integers without a common
 * divisor. */
whole_affine whole(const affine<Exact> &f);

struct shape;

/* What a function is zero on. */
enum line_of : char {
  EDGE_LINE,
  ROW_LINE,
  COLUMN_LINE,
  HORIZON_LINE,
  NEAR_LINE,
  MEETING_LINE,
  GRID_LINE
};

/* A function; the exact form is found when it is first asked for. */
struct line {
  line_of of;
  affine<Interval> rough;
  affine<Exact> (*find)(const line &); /* NULL: `exact` is known */
  const shape *f, *g;                  /* of which faces; */
  int k; /* and which corner, or side of the rectangle that is cut */
  whole_affine exact;

  const whole_affine &exactly();
};

struct point {
  Interval x, y;
  line *p, *q; /* it is where these meet; NULL: X, Y, W are known */
  mpz_class X, Y, W;

  void make_exact();
};

/* The point where two lines meet that are not parallel. */
void meet(point *made, line *p, line *q);
/* (x/w, y/w), which are doubles. x, y and w are whole. */
void place(point *made, double x, double y, double w);

/* The sign of the function at the point as far as intervals tell; and for
 * certain. */
inline int rough_sign(const line &f, const point &at) {
  return sign_of(f.rough.a * at.x + f.rough.b * at.y + f.rough.c);
}
int sign_at(line &f, point &at);

/* num/den, 0 <= num, 0 < den: the greatest double that is not above it. Whether
 * they are equal. */
bool down_to_double(const mpz_class &num, const mpz_class &den, double *low);

} // namespace areas

#endif
