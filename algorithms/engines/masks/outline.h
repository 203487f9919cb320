/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The outlines of pieces and of boxes: their corners on the screen, the lines
 * between these, and the samples that they span. Within masks/ only. The bounds
 * of errors are proved in polygon.c. */
#ifndef HSR_ALGORITHMS_TILING_OUTLINE_H
#define HSR_ALGORITHMS_TILING_OUTLINE_H

#include "algorithms/engines/masks/polygon.h"
#include "common/base/numbers.h"

#include <float.h>
#include <math.h>

#ifdef __cplusplus
extern "C" {
#endif

#define HSR_U (DBL_EPSILON / 2)

/* --- Points --------------------------------------------------------------- */

struct hsr_outline_point {
  double x, y, w;
  double ex, ey, ew; /* bounds of their errors */
  double t, et;      /* its depth, and the bound of its error */
};

/* May a product of points with such errors overflow? See polygon.c, Range. */
static inline bool hsr_outline_is_wild(const double error[3]) {
  return !(error[0] <= 0x1p400 && error[1] <= 0x1p400 && error[2] <= 0x1p400);
}

/* The bound of the error of row . (V - E), if coordinate k of V - E is at most
 * far[k] in size. */
static inline double hsr_outline_error(const double row[3],
                                       const double far[3]) {
  double sum = 0;
  for (int k = 0; k < 3; k++)
    sum += fabs(row[k]) * far[k];
  return 8 * HSR_U * sum + 0x1p-960;
}

/* --- Lines ---------------------------------------------------------------- */

enum { HSR_RING = 8 };

/* Up to 8 corners in order around an outline, and the bounds of their errors.
 * After the last one the first is repeated, or whichever the last line goes
 * to. */
struct hsr_ring {
  double x[HSR_RING + 1], y[HSR_RING + 1], w[HSR_RING + 1];
  double ex[HSR_RING + 1], ey[HSR_RING + 1], ew[HSR_RING + 1];
};

/* Fills line[] with the lines from each of the first n corners to the next.
 * Inside is where `side` times the determinant is positive. Unused places of
 * the ring must hold numbers, of whatever value. */
void hsr_outline_lines(double reach, double side, const struct hsr_ring *ring,
                       uint32_t n, struct hsr_mask_line *line);

/* --- The box of samples --------------------------------------------------- */

/* A rectangle that holds some points on the screen; and in `beyond` a bit for
 * each border of the window that all of them are beyond, by their homogeneous
 * coordinates, before the eye or behind it. */
struct hsr_hull {
  double x0, y0, x1, y1;
  bool ahead; /* all points are surely before the eye */
  unsigned beyond;
};

static inline struct hsr_hull hsr_hull_none(void) {
  struct hsr_hull hull = {INFINITY, INFINITY, -INFINITY, -INFINITY, true, 31};
  return hull;
}

/* Adds a point to a hull. */
void hsr_hull_add(struct hsr_hull *hull, const struct hsr_outline_point *a,
                  const struct hsr_window *window);

/* Finds the samples of the window within the hull; false if there are none.
 * `anywhere`: a sample may be anywhere in its square. A bound is rounded up to
 * a whole number within the window, without a branch. */
static inline __attribute__((always_inline)) bool
hsr_hull_box(const struct hsr_hull *hull, const struct hsr_window *w,
             bool anywhere, struct hsr_bounds *box) {
  *box = (struct hsr_bounds){w->x0, w->y0, w->x1, w->y1};
  if (hull->beyond)
    return false;
  if (!hull->ahead)
    return true;
  double before = anywhere ? 1 : 0.5, after = anywhere ? 0 : 0.5;
  const double least[4] = {w->x0, w->y0, w->x0, w->y0},
               most[4] = {w->x1, w->y1, w->x1, w->y1};
  double at[4] = {hull->x0 - before, hull->y0 - before, hull->x1 - after,
                  hull->y1 - after};
  int whole[4];
  for (int k = 0; k < 4; k++)
    at[k] = hsr_min(hsr_max(at[k], least[k]), most[k]);
  for (int k = 0; k < 4; k++)
    whole[k] = (int)at[k];
  for (int k = 0; k < 4; k++)
    whole[k] += whole[k] < at[k];
  *box = (struct hsr_bounds){whole[0], whole[1], whole[2], whole[3]};
  return box->x0 < box->x1 && box->y0 < box->y1;
}

#ifdef __cplusplus
}
#endif
#endif
