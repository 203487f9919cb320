/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/view/clip.h"

#include <string.h>

static double height(const double p[3], const double plane[3], double margin) {
  return plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2] + margin;
}

int hsr_clip(const double (*in)[3], int n, const double plane[3], double margin,
             double (*out)[3]) {
  int kept = 0;
  for (int k = 0; k < n; k++) {
    const double *a = in[k], *b = in[k + 1 < n ? k + 1 : 0];
    double ha = height(a, plane, margin), hb = height(b, plane, margin);
    if (ha >= 0)
      memcpy(out[kept++], a, sizeof out[0]);
    if ((ha < 0) != (hb < 0)) {
      double t = ha / (ha - hb);
      for (int c = 0; c < 3; c++)
        out[kept][c] = a[c] + t * (b[c] - a[c]);
      kept++;
    }
  }
  return kept;
}
