/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/grids/normal.h"

#include <math.h>
#include <stdlib.h>

enum { SIDE = 64, MOST = SIDE - 1 };

/* A coordinate from -1 to 1 as a number from 0 to 63. */
static int step_of(double x) {
  return (int)lrint((x + 1) * MOST / 2);
}

uint16_t hsr_normal_code(const double d[3]) {
  double length = fabs(d[0]) + fabs(d[1]) + fabs(d[2]);
  if (!(length > 0 && isfinite(length)))
    return HSR_NO_NORMAL;
  double x = d[0] / length, y = d[1] / length;
  if (d[2] < 0) { /* the lower half is folded outwards */
    double folded = copysign(1 - fabs(y), x);
    y = copysign(1 - fabs(x), y);
    x = folded;
  }
  return (uint16_t)(step_of(y) * SIDE + step_of(x));
}

void hsr_normal_of(uint16_t code, int d[3]) {
  int x = 2 * (code % SIDE) - MOST, y = 2 * (code / SIDE) - MOST;
  d[2] = MOST - abs(x) - abs(y);
  d[0] = d[2] >= 0 ? x : (MOST - abs(y)) * (x < 0 ? -1 : 1);
  d[1] = d[2] >= 0 ? y : (MOST - abs(x)) * (y < 0 ? -1 : 1);
}
