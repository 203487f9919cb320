/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A picture on a terminal. */
#ifndef HSR_BENCH_TERMINAL_PIXELS_H
#define HSR_BENCH_TERMINAL_PIXELS_H

#include <stdbool.h>
#include <stdio.h>

/* How standard output can show one. */
enum pixels {
  PIXELS_NONE,  /* it is no terminal, TERM=dumb, NO_COLOR is set */
  PIXELS_256,   /* by blocks of 256 colours */
  PIXELS_TRUE,  /* by blocks of 24-bit colours */
  PIXELS_SIXEL, /* as a picture */
};
enum pixels pixels_known(void);

/* Shows m x n linear colours by rows on standard output, as large as the screen
 * has room above `spare` lines. False: there is no memory, and nothing is shown. */
bool pixels_show(enum pixels how, int m, int n, const float *rgb, int spare);

#endif
