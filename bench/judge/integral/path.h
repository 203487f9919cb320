/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The ray of a pixel, cut where it goes from one box of samples into another. */
#ifndef HSR_BENCH_JUDGE_INTEGRAL_PATH_H
#define HSR_BENCH_JUDGE_INTEGRAL_PATH_H

#include "bench/judge/integral/field.h"
#include "bench/judge/integral/pieces.h"

#include <CGAL/Gmpq.h>

#include <vector>

namespace integral {

/* A ray is at O + t D at the depth t. */
struct ray {
  std::array<CGAL::Gmpq, 3> exact_O, exact_D;
  std::array<Interval, 3> O, D; /* hold these */

  /* Of pixel (i, j). Doubles are rounded upwards. */
  ray(const hsr_view &view, int i, int j);
};

/* A part of a ray in one box: it enters and leaves it through planes of samples, or
 * begins at the view's `near`. Where exactly it does so is between doubles. */
struct stretch {
  Interval from, to; /* depths */
  std::array<int, 3> at;
  unsigned entered, left; /* bits of the axes whose planes it passes there */
};

/* The stretches of a ray that are in boxes, from front to back. */
void cut_ray(const field &f, const hsr_view &view, const ray &r,
             std::vector<stretch> *out);

/* Where a stretch begins and ends in its box. */
point first_point(const field &f, const ray &r, const stretch &s);
point last_point(const field &f, const ray &r, const stretch &s);

/* How long it is, in cells. */
Interval length_in_box(const field &f, const ray &r, const stretch &s);

} // namespace integral

#endif
