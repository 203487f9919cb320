/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The proofs of the filters of sight.h, and a service made of them.
 *
 * Turns. With delta = HSR_DELTA, coordinates are within delta of the true ones.
 * So each of dx, dy, hx, hy is within 2 delta, but for rounding, and the
 * products dx hy and dy hx together within 2 delta (|dx| + |dy| + |hx| + |hy|)
 * + 8 delta^2. All four are at most 2^17 in size, so rounding anywhere adds at
 * most 2^-35 of a coordinate to the factor of the other: far less than delta.
 * The bound takes twice all that. The points are ahead, so a sign that is
 * certain is that of the true determinant. It is not zero, so no displacement
 * changes it.
 *
 * Rows. The difference of the sy of two points is within 2 delta of the true
 * one. */
#include "common/lines/sight/sight.h"

bool hsr_sight_covers(const struct hsr_sight *sight, uint32_t f, uint32_t p) {
  const struct hsr_world *w = sight->world;
  bool inside = false;
  uint32_t a = w->mesh.vertex[w->mesh.start[f + 1] - 1];
  int row_a = hsr_sight_row_side(sight, p, a);
  for (uint32_t k = w->mesh.start[f]; k < w->mesh.start[f + 1]; k++) {
    uint32_t b = w->mesh.vertex[k];
    int row_b = hsr_sight_row_side(sight, p, b);
    if (row_a != row_b && hsr_sight_side(sight, a, b, p) == -row_a)
      inside = !inside;
    a = b;
    row_a = row_b;
  }
  return inside;
}
