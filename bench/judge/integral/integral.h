/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The emission-absorption integral of a grid (docs/integral.md), pixel by pixel,
 * as intervals that hold it. */
#ifndef HSR_BENCH_JUDGE_INTEGRAL_INTEGRAL_H
#define HSR_BENCH_JUDGE_INTEGRAL_INTEGRAL_H

#include "common/grids/grid.h"
#include "common/view/view.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Which field is integrated. */
enum integral_field {
  INTEGRAL_PRE,  /* samples are classified, and then interpolated */
  INTEGRAL_POST, /* samples are interpolated, and then classified */
  INTEGRAL_SUMS  /* as PRE; nothing absorbs what is behind it */
};

/* The name and the meaning of each field, in the order above. */
struct integral_field_name {
  const char *name, *meaning;
};
enum { N_INTEGRAL_FIELDS = 3 };
extern const struct integral_field_name integral_fields[N_INTEGRAL_FIELDS];

struct integral_options {
  enum integral_field field;
  double width; /* of the intervals that are asked for, above 0 */
  int threads;  /* at least 1 */
  /* Is told now and then how many rows are done, by the caller's thread; it may
   * be NULL. If it returns false, the work ends with HSR_E_STOPPED. */
  bool (*tell)(void *whom, size_t rows, size_t all);
  void *whom;
};

/* What was reached. */
struct integral_reach {
  double widest;   /* the width of the widest interval */
  size_t n_wide;   /* pixels with an interval that is wider than asked */
  uint64_t pieces; /* of rays that were looked at */
};

/* Red, green, blue and opacity. */
enum { INTEGRAL_CHANNELS = 4 };

/* Fills bounds[4 m n][2] with lo and hi of the channels of each pixel in the
 * view's window, premultiplied, by rows from the top; 1 is the most, but for
 * sums. Narrower intervals for the same scene and view lie within wider ones.
 * HSR_E_NOMEM; HSR_E_STOPPED; HSR_E_INTERNAL if directed rounding has no effect
 * here. */
enum hsr_status integral_find(const struct hsr_grid *grid,
                              const struct hsr_view *view,
                              const struct integral_options *options,
                              double (*bounds)[2], struct integral_reach *reach,
                              struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
