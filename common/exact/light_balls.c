/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finding faces that do not meet the plane of a light ray's row, by balls that
 * hold them.
 *
 * Notation    row(v) = W . (v - O), of struct hsr_lit_point: W is within e of
 *             the rounded w in each component, O within h of o; c and r are a
 *             ball's middle and radius, which are exact, and d = c - o. |x|1 is
 *             a sum of sizes.
 * Bound       For v in the ball, row(v) is off W . (c - O) by no more than
 *             |W|1 r, where |W|1 <= |w|1 + 3 e; and that is off the rounded
 *             w . d by no more than
 *                 h |w|1 + e |d|1 + 3 e h + 6 u sum |w_k d_k|, u = 2^-53.
 *             This is doubled for the rounding of the bound, and 2^-960 is
 *             added for underflow. If a value is NaN, the face is not
 *             "beside". */
#include "common/base/vector.h"
#include "common/exact/shadow.h"

#include <math.h>

/* The ball about the middle of a face's box. Its radius is rounded up. */
static void make_ball(const struct hsr_mesh *mesh, uint32_t f, float middle[3],
                      float *radius) {
  const double *xyz[3] = {mesh->x, mesh->y, mesh->z};
  double most = 0;
  for (int c = 0; c < 3; c++) {
    double low = INFINITY, high = -INFINITY;
    for (uint32_t k = mesh->start[f]; k < mesh->start[f + 1]; k++) {
      low = fmin(low, xyz[c][mesh->vertex[k]]);
      high = fmax(high, xyz[c][mesh->vertex[k]]);
    }
    middle[c] = (float)(low / 2 + high / 2);
  }
  for (uint32_t k = mesh->start[f]; k < mesh->start[f + 1]; k++) {
    double square = 0;
    for (int c = 0; c < 3; c++) {
      double off = xyz[c][mesh->vertex[k]] - middle[c];
      square += off * off;
    }
    most = fmax(most, square);
  }
  *radius = nextafterf((float)(sqrt(most) * (1 + 0x1p-40)), INFINITY);
}

enum hsr_status hsr_light_balls_make(struct hsr_light_balls *balls,
                                     const struct hsr_world *world,
                                     const uint32_t *face, uint32_t n,
                                     struct hsr_arena *arena) {
  *balls = (struct hsr_light_balls){
      HSR_NEW(arena, float, n), HSR_NEW(arena, float, n),
      HSR_NEW(arena, float, n), HSR_NEW(arena, float, n)};
  if (!balls->x || !balls->y || !balls->z || !balls->r)
    return HSR_E_NOMEM;
  for (uint32_t k = 0; k < n; k++) {
    float middle[3];
    make_ball(&world->mesh, face[k], middle, &balls->r[k]);
    balls->x[k] = middle[0];
    balls->y[k] = middle[1];
    balls->z[k] = middle[2];
  }
  return HSR_OK;
}

/* The parts of the bound that are the same for all balls. */
struct row {
  double w[3], o[3], e, size, constant;
};

HSR_VECTOR static void find_beside(const float *x, const float *y,
                                   const float *z, const float *r, uint32_t n,
                                   struct row row, uint8_t *beside) {
  for (uint32_t i = 0; i < n; i++) {
    double dx = x[i] - row.o[0], dy = y[i] - row.o[1], dz = z[i] - row.o[2];
    double tx = row.w[0] * dx, ty = row.w[1] * dy, tz = row.w[2] * dz;
    double terms = fabs(tx) + fabs(ty) + fabs(tz);
    double reach = fabs(dx) + fabs(dy) + fabs(dz);
    double bound = 2 * (row.size * r[i] + row.e * reach + row.constant +
                        6 * 0x1p-53 * terms) +
                   0x1p-960;
    beside[i] = fabs(tx + ty + tz) > bound;
  }
}

void hsr_light_balls_beside(const struct hsr_light_balls *balls,
                            const struct hsr_lit_point *point, uint32_t k,
                            uint32_t n, uint8_t *beside) {
  const double *w = point->row, *o = point->from;
  double e = point->row_error, h = point->from_error;
  double size = fabs(w[0]) + fabs(w[1]) + fabs(w[2]);
  const struct row row = {{w[0], w[1], w[2]},
                          {o[0], o[1], o[2]},
                          e,
                          size + 3 * e,
                          h * size + 3 * e * h};
  find_beside(balls->x + k, balls->y + k, balls->z + k, balls->r + k, n, row,
              beside);
}
