/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One view: a camera, a raster of samples, and the ray of a sample.
 *
 * World       right-handed; eye E; F = (at - E)/|at - E|, right = F x up /
 *             |F x up|, U = tan(fov/2) (right x F), R = (m/n) tan(fov/2) right,
 *             computed once in doubles by hsr_view_init and then exact.
 * Screen      sx to the right and sy down, in pixels, the picture being
 *             [0, m] x [0, n]. Sample (i, j), i from the left, j from the top,
 *             lies at (i + 1/2 + offset_x, j + 1/2 + offset_y): exact doubles.
 * Ray         the ray of screen point (sx, sy) starts at E and runs along
 *             D = F + x R + y U, x = (2 sx - m)/m, y = (n - 2 sy)/n, as exact
 *             numbers. A point E + t D exists if t > near.
 * Perturbed   every sample is understood as displaced by (e, -e^2) along
 *             (R, U), with e infinitesimal and positive: on the screen, a
 *             little to the right and much less down. A zero determinant takes
 *             the sign of its derivative along R; if that is zero too, along
 *             -U.
 *
 * The perspective transform is Sutherland et al. 1974, eq. 1 to 3, in two
 * steps: world to eye, and the division by w, where w is the depth t. In these
 * coordinates V - E = w (F + x R + y U). */
#ifndef HSR_COMMON_VIEW_H
#define HSR_COMMON_VIEW_H

#include "common/base/window.h"
#include "common/scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

#define HSR_MAX_SIZE 16384 /* samples a side */

struct hsr_view {
  struct hsr_camera camera;
  int m, n;                  /* samples a row, rows; 1 .. HSR_MAX_SIZE */
  double offset_x, offset_y; /* of every sample, pixels; dyadic, |.| < 1/2 */
  struct hsr_window window;  /* the samples to render, inside the picture */

  double E[3], F[3], R[3], U[3]; /* exact by definition */
  double near;

  /* Exact values rounded, each entry with a relative error of at most 2^-52.
   * Only for approximate arithmetic.
   * ray:    D(sx, sy) = ray[0] + sx ray[1] + sy ray[2];
   * screen: w sx, w sy, w = rows 0, 1, 2 times (V - E). */
  double ray[3][3], screen[3][3];
};

/* Sets up the view of a whole picture of m x n samples, with no offset.
 * HSR_E_INPUT if hsr_camera_check refuses the camera, or it is so skewed that
 * F, R, U are linearly dependent; HSR_E_USAGE if m or n is out of range. */
enum hsr_status hsr_view_init(struct hsr_view *view,
                              const struct hsr_camera *camera, int m, int n,
                              struct hsr_error *err);

/* The matrices `ray` and `screen` of hsr_view, from its E, F, R, U, m, n. Each
 * entry has a relative error of at most 2^-52. False if F, R, U are linearly
 * dependent, or if memory ran out: then *out_of_memory is set. */
bool hsr_exact_view_matrices(const struct hsr_view *view, double ray[3][3],
                             double screen[3][3], bool *out_of_memory);

/* Screen coordinates of a sample, in pixels. They are computed only here. */
static inline double hsr_sample_x(const struct hsr_view *view, int i) {
  return i + (0.5 + view->offset_x);
}
static inline double hsr_sample_y(const struct hsr_view *view, int j) {
  return j + (0.5 + view->offset_y);
}

#ifdef __cplusplus
}
#endif
#endif
