/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/engines/masks/outline.h"
#include "common/base/vector.h"

/* --- Lines ---------------------------------------------------------------- */

/* Lines by their fields. */
struct columns {
  double a[HSR_RING], b[HSR_RING], c[HSR_RING], error[HSR_RING], span[HSR_RING],
      per_a[HSR_RING], per_b[HSR_RING];
};

/* All eight at once, in lanes. */
HSR_VECTOR static void find_lines(double reach, double side,
                                  const struct hsr_ring *restrict p,
                                  struct columns *restrict line) {
  for (int k = 0; k < HSR_RING; k++) {
    double x = p->x[k], y = p->y[k], w = p->w[k];
    double to_x = p->x[k + 1], to_y = p->y[k + 1], to_w = p->w[k + 1];
    double ax = fabs(x), ay = fabs(y), aw = fabs(w);
    double bx = fabs(to_x), by = fabs(to_y), bw = fabs(to_w);
    double ex = hsr_max(p->ex[k], p->ex[k + 1]);
    double ey = hsr_max(p->ey[k], p->ey[k + 1]);
    double ew = hsr_max(p->ew[k], p->ew[k + 1]);
    double error_a =
        ey * (aw + bw) + ew * (ay + by) + 2 * HSR_U * (ay * bw + aw * by);
    double error_b =
        ex * (aw + bw) + ew * (ax + bx) + 2 * HSR_U * (ax * bw + aw * bx);
    double error_c =
        ex * (ay + by) + ey * (ax + bx) + 2 * HSR_U * (ax * by + ay * bx);
    double a = side * (y * to_w - w * to_y);
    double b = side * (w * to_x - x * to_w);
    double c = side * (x * to_y - y * to_x);
    double span = fabs(a) + fabs(b);
    line->a[k] = a;
    line->b[k] = b;
    line->c[k] = c;
    line->error[k] = 2 * (reach * (error_a + error_b) + error_c +
                          5 * HSR_U * (reach * span + fabs(c))) +
                     0x1p-1000;
    line->span[k] = span;
    line->per_a[k] = 1 / a;
    line->per_b[k] = 1 / b;
  }
}

void hsr_outline_lines(double reach, double side, const struct hsr_ring *ring,
                       uint32_t n, struct hsr_mask_line *line) {
  struct columns found;
  find_lines(reach, side, ring, &found);
  for (uint32_t k = 0; k < n; k++)
    line[k] = (struct hsr_mask_line){
        found.a[k],    found.b[k],     found.c[k],    found.error[k],
        found.span[k], found.per_a[k], found.per_b[k]};
}

/* --- The box of samples --------------------------------------------------- */

void hsr_hull_add(struct hsr_hull *hull, const struct hsr_outline_point *a,
                  const struct hsr_window *window) {
  double x0 = window->x0, y0 = window->y0, x1 = window->x1, y1 = window->y1;
  double wide = a->ex + hsr_max(fabs(x0), fabs(x1)) * a->ew;
  double high = a->ey + hsr_max(fabs(y0), fabs(y1)) * a->ew;
  hull->beyond &= (unsigned)(a->x - x0 * a->w < -2 * wide) |
                  (unsigned)(a->x - x1 * a->w > 2 * wide) << 1 |
                  (unsigned)(a->y - y0 * a->w < -2 * high) << 2 |
                  (unsigned)(a->y - y1 * a->w > 2 * high) << 3 |
                  (unsigned)(a->w < -2 * a->ew) << 4;
  if (!(a->w > 4 * a->ew)) {
    hull->ahead = false;
    return;
  }
  double sx = a->x / a->w, sy = a->y / a->w;
  double mx = 2 * (a->ex + fabs(sx) * a->ew) / a->w + 4 * HSR_U * fabs(sx);
  double my = 2 * (a->ey + fabs(sy) * a->ew) / a->w + 4 * HSR_U * fabs(sy);
  hull->x0 = hsr_min(hull->x0, sx - mx);
  hull->x1 = hsr_max(hull->x1, sx + mx);
  hull->y0 = hsr_min(hull->y0, sy - my);
  hull->y1 = hsr_max(hull->y1, sy + my);
}
