/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One view: a camera, a raster of samples, and the ray of a sample.
 *
 * World       right-handed; eye E; F = (at - E)/|at - E|, right = F x up /
 *             |F x up|, U = h (right x F), R = (m/n) h right, with h =
 *             tan(fov/2), or in parallel projection half the picture's height;
 *             computed once in doubles by hsr_view_init and then exact.
 * Screen      sx to the right and sy down, in pixels, the picture being
 *             [0, m] x [0, n]. Sample (i, j), i from the left, j from the top,
 *             lies at (i + 1/2 + offset_x, j + 1/2 + offset_y): exact doubles.
 * Ray         the ray of screen point (sx, sy) starts at E and runs along D = F
 *             + x R + y U, x = (2 sx - m)/m, y = (n - 2 sy)/n, as exact
 *             numbers. In parallel projection it starts at P = E + x R + y U
 *             and runs along F. The parameter of a point on the ray is its
 *             depth t. Only points with t > near exist.
 * Tile        a view may show only a part, a tile, of a picture of W x H
 *             samples. Sample (0, 0) of the tile is sample (l, t) of the
 *             picture. Then R = (W/H) h right, x = (2 (sx + l) - W)/W and y =
 *             (H - 2 (sy + t))/H. All else is said in the tile's own
 *             coordinates, which are at most HSR_MAX_SIZE. So error bounds that
 *             hold in a picture hold in a tile. Lines, polygons and exact areas
 *             have no tiles.
 * Perturbed   every sample is displaced by (e, -e^2) along (R, U), with e
 *             infinitesimal and positive. On the screen that is a little to the
 *             right and much less down. So a determinant that is zero takes the
 *             sign of its derivative along R or, if that is zero too, of its
 *             derivative along -U.
 *
 * The perspective transform is Sutherland et al. 1974, eq. 1 to 3, in two
 * steps: world to eye, and the division by w, where w is the depth t. In these
 * coordinates V - E = w (F + x R + y U).
 *
 * In projective space both projections are the same. All rays pass through one
 * point, the eye C. It is C = (E, 1) in perspective and C = (-F, 0) in
 * parallel, which is infinitely far behind the picture. The ray of a sample
 * joins C with a point S, which is (D, 0) in perspective and (P, 1) in
 * parallel. It meets the plane (N, -d), of the points X with N . X = d, where q
 * = -(N, -d).S / (N, -d).C. This q is linear on the screen. It is 1/t in
 * perspective and -t in parallel. So in both projections the face with the
 * greater q is nearer. The eye is in front of the plane if (N, -d).C is
 * positive. Code that compares by q and by the side of C serves both
 * projections. */
#ifndef HSR_COMMON_VIEW_H
#define HSR_COMMON_VIEW_H

#include "common/base/window.h"
#include "common/scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(protected) /* for modules: hsr-module.h */

#define HSR_MAX_SIZE 16384      /* most samples along a side of a view */
#define HSR_MAX_WHOLE (1 << 20) /* the same of a picture made of tiles */

/* The view of the previous picture of a sequence, of the same shape. */
struct hsr_view_before {
  bool exists, parallel;
  double E[3], F[3], R[3], U[3], near;      /* as in struct hsr_view */
  double screen[3][3], origin[3], depth[3]; /* likewise */
};

struct hsr_view {
  struct hsr_camera camera;
  int m, n;                  /* samples a row, rows; 1 .. HSR_MAX_SIZE */
  int whole_m, whole_n;      /* W, H of the picture that has this tile; m, n if
                                the view is of a whole picture */
  int left, top;             /* l, t: samples left of the tile and above it */
  double offset_x, offset_y; /* of every sample, in pixels; a binary fraction
                                below 1/2 in size */
  struct hsr_window window;  /* the samples to render, within m x n */

  bool parallel;
  double E[3], F[3], R[3], U[3]; /* exact by definition */
  double near;
  /* The direction to the default sun, above the eye's left shoulder. It has any
   * length. It turns with the eye, and it depends neither on the picture's
   * shape nor on the angle of view. */
  double lamp[3];
  /* The camera's light or, if it has none, the lamp (docs/shadow-picture.md).
   * Exact by definition. */
  double light[4];

  /* The coordinates of C, to be compared with planes across the axes. In
   * parallel a coordinate is -infinity where F is positive and +infinity where
   * F is negative. It is NaN where F is 0: no ray crosses such a plane, so the
   * side of the eye does not matter. */
  double eye[3];

  /* Exact values rounded, each entry with a relative error of at most 2^-52.
   * Only for approximate arithmetic.
   * ray:    ray[0] + sx ray[1] + sy ray[2] is D, or P - E in parallel;
   * screen: rows 0, 1, 2 times (V - E), plus origin, are w sx, w sy, w of a
   *         point V. In parallel row 2 is 0;
   * origin: 0, 0, 0, or W/2 - l, H/2 - t, 1 in parallel;
   * depth:  depth . (V - E) is t of V. In perspective this is row 2 of
   *         `screen`. */
  double ray[3][3], screen[3][3], origin[3], depth[3];

  struct hsr_view_before before; /* only for motion blur */
};

/* Sets up the view of a whole picture of m x n samples, with no offset. *view
 * owns no memory. HSR_E_INPUT if hsr_camera_check refuses the camera, or if F,
 * R, U are linearly dependent; HSR_E_USAGE if m or n is out of range;
 * HSR_E_NOMEM. */
enum hsr_status hsr_view_init(struct hsr_view *view,
                              const struct hsr_camera *camera, int m, int n,
                              struct hsr_error *err);

/* The same for a tile of a picture of m x n samples. The tile has the samples
 * of `tile`, and its sample (0, 0) is (tile->x0, tile->y0). HSR_E_USAGE if a
 * side of the tile is above HSR_MAX_SIZE, a side of the picture is above
 * HSR_MAX_WHOLE, or the tile is empty or not in the picture. Other errors as
 * hsr_view_init. */
enum hsr_status hsr_view_init_tile(struct hsr_view *view,
                                   const struct hsr_camera *camera, int m,
                                   int n, const struct hsr_window *tile,
                                   struct hsr_error *err);

/* Makes `before`, a view of the same shape, the previous view of *view. It is
 * copied. */
void hsr_view_follow(struct hsr_view *view, const struct hsr_view *before);

/* Calls hsr_view_init for view `number` of a scene, from 0, with view number -
 * 1 as its previous view if there is one. */
enum hsr_status hsr_view_init_of(struct hsr_view *view,
                                 const struct hsr_scene *scene, uint32_t number,
                                 int m, int n, struct hsr_error *err);

/* For hsr_view_init. Fills ray, screen, origin and depth of *view from its E,
 * F, R, U, W, H, l, t. False if F, R, U are linearly dependent or memory ran
 * out. In the latter case *out_of_memory is set. */
bool hsr_exact_view_matrices(struct hsr_view *view, bool *out_of_memory);

/* Returns a view of the same picture with across * m by down * n samples,
 * without an offset. Its window is all of it. `across` and `down` are powers of
 * two, so that the matrices are as exact as those of *view. If across ==
 * down, the result is that of hsr_view_init for this number of samples. */
struct hsr_view hsr_view_finer(const struct hsr_view *view, int across,
                               int down);

/* Returns -(N, -d).C, rounded, of the plane with the normal N through `point`.
 * In perspective it is N . (point - E), the distance of the plane from the eye
 * along N, times |N|. In parallel it is N . F. It is negative if the eye is in
 * front of the plane. */
static inline double hsr_view_height(const struct hsr_view *view,
                                     const double normal[3],
                                     const double point[3]) {
  double h[3];
  for (int k = 0; k < 3; k++)
    h[k] = normal[k] * (view->parallel ? view->F[k] : point[k] - view->E[k]);
  return h[0] + h[1] + h[2];
}

/* Projects a point: sets image to (w sx, w sy, t), rounded. Its screen
 * coordinates are the first two divided by hsr_view_w, which is t in
 * perspective and 1 in parallel. */
static inline void hsr_view_project(const struct hsr_view *view,
                                    const double point[3], double image[3]) {
  const double *const row[3] = {view->screen[0], view->screen[1], view->depth};
  for (int k = 0; k < 3; k++) {
    double sum = 0;
    for (int c = 0; c < 3; c++)
      sum += row[k][c] * (point[c] - view->E[c]);
    image[k] = k < 2 ? sum + view->origin[k] : sum;
  }
}
static inline double hsr_view_w(const struct hsr_view *view,
                                const double image[3]) {
  return view->parallel ? 1 : image[2];
}

/* Returns the depth t at which a ray meets a plane, from its q. */
static inline double hsr_view_depth(const struct hsr_view *view, double q) {
  return view->parallel ? -q : 1 / q;
}

/* Return the screen coordinates of sample (i, j), in pixels. These doubles
 * define the sample, so all code must call these functions. */
static inline double hsr_sample_x(const struct hsr_view *view, int i) {
  return i + (0.5 + view->offset_x);
}
static inline double hsr_sample_y(const struct hsr_view *view, int j) {
  return j + (0.5 + view->offset_y);
}

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif
#endif
