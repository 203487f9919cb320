/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Analytic antialiasing: the mean colour of each pixel, by the areas of the visible
 * polygons in it.
 *
 * Source      E. Catmull, "A Hidden-Surface Algorithm with Anti-Aliasing",
 *             SIGGRAPH 1978, 6-11: the polygons that are visible in a pixel are
 *             weighted by their areas there.
 * Notation    w is the colour of a region less the background's. A piece is what
 *             of a side lies in one pixel, with the height dy, which is negative
 *             if the side runs upward, and the mean mx of its sx.
 * Integral    the area of a region within pixel i of a row is the sum, over the
 *             region's pieces in the row, of dy if the piece is in a pixel to the
 *             right of i, and of dy (mx - i) if it is in pixel i: the integral of
 *             sx dsy along the border, with sx cut off at the sides of the pixel.
 * Bound       a corner is known within d0 = 2^-50 max(m, n) (polygons.h), which
 *             moves the area of a region in a pixel by at most 4 d0 a side that
 *             is in the pixel or beside it. Where a side passes from
 *             row to row is computed within 2^-50 max(m, n), too. Both together
 *             are less than 2 d a side, with d = 2^-46 max(m, n). A sum of a row has as many terms
 *             as there are pieces and pixels in the row, each rounded, and each
 *             no larger than the sum E of the weights of the sides in the row.
 *             With n terms the sum is within E (2 d + (n + 8) 2^-51).
 * Departures  Catmull clips polygons to the pixels, and sorts them there. Here
 *             they have been sorted, and their borders are integrated. */
#ifndef HSR_ALGORITHMS_SORTING_INTEGRATE_H
#define HSR_ALGORITHMS_SORTING_INTEGRATE_H

#include "algorithms/algorithm.h"
#include "common/answers/kinds/area.h"
#include "common/lines/polygons.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The module's counters: pieces of sides, and pixels that are written. */
struct hsr_integral_counters {
  int pieces, pixels;
};

/* Writes the intervals of all pixels of the job's window into its answer, which is
 * of the kind area with filter=box and shader=flat. `polygons` are all visible
 * regions of the job's view. Memory is taken from job->scratch.
 *
 * HSR_E_NOMEM. HSR_E_REFUSED: an interval is wider than eps; the intervals are in
 * the answer all the same. */
enum hsr_status hsr_integrate(const struct hsr_job *job,
                              const struct hsr_polygons *polygons,
                              struct hsr_integral_counters counters,
                              struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
