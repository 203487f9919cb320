/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The samples at which a box, or what is in it, may show.
 *
 * Filter. An entry of the screen matrix has a relative error of 2u, u = 2^-53,
 * and a difference with E one of u. A coordinate of a corner's image is a sum
 * of four terms: it is within 8u of `size`, which is not less than the sizes of
 * all terms of all three rows. Where w is above 2^-20 of `size`, a quotient is
 * at most 2^20, and within 2^20 times 2 x 2^20 x 8u = 2^-9 of the true one. A
 * sample more on each side is far above that. A product may lose 2^-1075 more
 * to underflow, which is below 2^-60 of a size above 2^-900. What overflows
 * makes `size` infinite, and then w is not above it. So this holds in every
 * scene: if it cannot be shown for a corner, the box may show anywhere in the
 * window. */
#ifndef HSR_ALGORITHMS_BOX_SAMPLES_H
#define HSR_ALGORITHMS_BOX_SAMPLES_H

#include "common/exact/screen.h"
#include "common/trees/box.h"

#include <math.h>

/* Narrows *b, which are samples of the view's window, to those within the
 * rectangle around the image of a box in the world. *b stays as it is if a
 * corner is not safely before the eye. The box may be infinite. */
static inline void hsr_box_samples(const struct hsr_view *view,
                                   const struct hsr_box *box,
                                   struct hsr_bounds *b) {
  double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY};
  for (int corner = 0; corner < 8; corner++) {
    double image[3], size = 0;
    for (int r = 0; r < 3; r++) {
      image[r] = view->origin[r];
      size += fabs(view->origin[r]);
      for (int k = 0; k < 3; k++) {
        double at = corner >> k & 1 ? box->hi[k] : box->lo[k];
        image[r] += view->screen[r][k] * (at - view->E[k]);
        size += fabs(view->screen[r][k]) * (fabs(at) + fabs(view->E[k]));
      }
    }
    if (!(size > 0x1p-900 && image[2] > 0x1p-20 * size))
      return;
    for (int k = 0; k < 2; k++) {
      lo[k] = fmin(lo[k], image[k] / image[2]);
      hi[k] = fmax(hi[k], image[k] / image[2]);
    }
  }
  b->x0 = (int)fmax(b->x0, fmin(b->x1, floor(lo[0]) - 1));
  b->y0 = (int)fmax(b->y0, fmin(b->y1, floor(lo[1]) - 1));
  b->x1 = (int)fmin(b->x1, fmax(b->x0, ceil(hi[0]) + 1));
  b->y1 = (int)fmin(b->y1, fmax(b->y0, ceil(hi[1]) + 1));
}

#endif
