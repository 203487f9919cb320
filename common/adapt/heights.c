/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/adapt/heights.h"
#include "common/base/vector.h"

HSR_VECTOR void hsr_look_at_heights(const struct hsr_rounded_plane *plane,
                                    const int64_t on[3],
                                    const struct hsr_corner_columns *corners,
                                    int64_t *restrict known) {
  const int64_t u = on[0], v = on[1], w = on[2];
  const struct hsr_rounded_plane over = *plane;
  const struct hsr_corner_columns c = *corners;
  for (size_t k = 0; k < c.n; k++) {
    double error,
        h = hsr_height_over(&over, c.x[k], c.y[k], c.z[k], c.error[k], &error);
    int64_t vertex = c.vertex[k];
    int64_t near =
        vertex == u || vertex == v || vertex == w ? HSR_IS_ON : HSR_IS_CLOSE;
    known[k] = h > error ? HSR_IS_ABOVE : -h > error ? HSR_IS_BELOW : near;
  }
}

HSR_VECTOR void hsr_look_at_levels(double at, int front, const double *x,
                                   const double *error, size_t n,
                                   int64_t *restrict known) {
  const double up = front;
  for (size_t k = 0; k < n; k++) {
    double h = up * (x[k] - at);
    known[k] = h > error[k]    ? HSR_IS_ABOVE
               : -h > error[k] ? HSR_IS_BELOW
               : error[k] == 0 ? HSR_IS_ON
                               : HSR_IS_CLOSE;
  }
}
