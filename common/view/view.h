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
 * Ray         the ray of screen point (sx, sy) starts at E and runs along
 *             D = F + x R + y U, x = (2 sx - m)/m, y = (n - 2 sy)/n, as exact
 *             numbers. In parallel projection it starts at P = E + x R + y U
 *             and runs along F. A point exists that lies at t > near on it.
 * Tile        a view may be of a part of a picture, W x H samples, whose sample
 *             (l, t) is its own sample (0, 0). Then R = (W/H) h right, and x =
 *             (2 (sx + l) - W)/W, y = (H - 2 (sy + t))/H. All else is said in
 *             the tile's own coordinates, which are below HSR_MAX_SIZE in every
 *             tile. So bounds of errors that hold in a picture hold in a tile.
 *             Lines, polygons and exact areas are of whole pictures only.
 * Perturbed   every sample is understood as displaced by (e, -e^2) along
 *             (R, U), with e infinitesimal and positive: on the screen, a
 *             little to the right and much less down. A zero determinant takes
 *             the sign of its derivative along R; if that is zero too, along
 *             -U.
 *
 * The perspective transform is Sutherland et al. 1974, eq. 1 to 3, in two
 * steps: world to eye, and the division by w, where w is the depth t. In these
 * coordinates V - E = w (F + x R + y U).
 *
 * Both projections are one in projective space. There the rays are the lines
 * through the eye, a point C: C = (E, 1), or in parallel (-F, 0), which is
 * infinitely far behind. The ray of a sample joins C with a point S: S = (D,
 * 0), or (P, 1). A plane (N, -d) is met where q = -(N, -d).S / (N, -d).C, which
 * is linear on the screen. This is 1/t in perspective and -t in parallel, so
 * the greater q is nearer in both. The eye is in front of the plane if (N,
 * -d).C is positive. What compares by q and by the side of C is the same in
 * both. */
#ifndef HSR_COMMON_VIEW_H
#define HSR_COMMON_VIEW_H

#include "common/base/window.h"
#include "common/scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

#define HSR_MAX_SIZE 16384      /* samples a side of what is drawn at once */
#define HSR_MAX_WHOLE (1 << 20) /* samples a side of a picture in tiles */

/* What a picture was seen by before it was seen by its view. */
struct hsr_view_before {
  bool exists, parallel;
  double E[3], F[3], R[3], U[3], near;      /* of a picture of the same shape */
  double screen[3][3], origin[3], depth[3]; /* as below */
};

struct hsr_view {
  struct hsr_camera camera;
  int m, n;                  /* samples a row, rows; 1 .. HSR_MAX_SIZE */
  int whole_m, whole_n;      /* of the picture of which this is a tile, W x H;
                                m, n if it is no tile */
  int left, top;             /* l, t: samples left of the tile and above it */
  double offset_x, offset_y; /* of every sample, pixels; dyadic, |.| < 1/2 */
  struct hsr_window window;  /* the samples to render, inside the picture */

  bool parallel;
  double E[3], F[3], R[3], U[3]; /* exact by definition */
  double near;
  /* Towards a sun above the eye's left shoulder, of any length. It turns with
   * the eye, and depends neither on the picture's shape nor on the angle of
   * view. */
  double lamp[3];
  /* The camera's light, or the lamp (docs/shadow-picture.md). Exact by
   * definition. */
  double light[4];

  /* C by its coordinates, to be compared with planes across the axes. In
   * parallel a coordinate is -infinity where F is positive and +infinity where
   * F is negative. Where F is 0 it is NaN: no ray crosses such a plane, so it
   * does not matter on which side the eye is. */
  double eye[3];

  /* Exact values rounded, each entry with a relative error of at most 2^-52.
   * Only for approximate arithmetic.
   * ray:    D, or in parallel P - E, is ray[0] + sx ray[1] + sy ray[2];
   * screen: w sx, w sy, w = rows 0, 1, 2 times (V - E), plus origin;
   * origin: 0, 0, 0; in parallel W/2 - l, H/2 - t, 1, and row 2 is 0;
   * depth:  t = depth . (V - E). In perspective this is row 2. */
  double ray[3][3], screen[3][3], origin[3], depth[3];

  struct hsr_view_before before; /* only for motion blur */
};

/* Sets up the view of a whole picture of m x n samples, with no offset.
 * HSR_E_INPUT if hsr_camera_check refuses the camera, or it is so skewed that
 * F, R, U are linearly dependent; HSR_E_USAGE if m or n is out of range. */
enum hsr_status hsr_view_init(struct hsr_view *view,
                              const struct hsr_camera *camera, int m, int n,
                              struct hsr_error *err);

/* The same for a tile of a picture of m x n samples: the samples of `tile`,
 * with (tile->x0, tile->y0) as its sample (0, 0). HSR_E_USAGE if a side of the
 * tile is above HSR_MAX_SIZE, one of the picture above HSR_MAX_WHOLE, or the
 * tile is not in the picture. */
enum hsr_status hsr_view_init_tile(struct hsr_view *view,
                                   const struct hsr_camera *camera, int m,
                                   int n, const struct hsr_window *tile,
                                   struct hsr_error *err);

/* Makes a view of the same shape the one before this one. */
void hsr_view_follow(struct hsr_view *view, const struct hsr_view *before);

/* hsr_view_init for a view of a scene, 0 being the first, which moved there from the
 * view before it. */
enum hsr_status hsr_view_init_of(struct hsr_view *view,
                                 const struct hsr_scene *scene, uint32_t number,
                                 int m, int n, struct hsr_error *err);

/* Fills ray, screen, origin and depth of *view from its E, F, R, U, W, H, l, t.
 * False if F, R, U are linearly dependent, or if memory ran out: then
 * *out_of_memory is set. */
bool hsr_exact_view_matrices(struct hsr_view *view, bool *out_of_memory);

/* The view of the same picture of across m x down n samples, without an offset
 * and with the whole of it as its window. `across` and `down` are powers of two,
 * so that its matrices are as exact. It is that of hsr_view_init, if both are
 * equal. */
struct hsr_view hsr_view_finer(const struct hsr_view *view, int across,
                               int down);

/* -(N, -d).C of a plane with this normal through this point, rounded: how far,
 * along the normal, the plane lies from the eye; in parallel, N.F. Negative if
 * the eye is in front of the plane. */
static inline double hsr_view_height(const struct hsr_view *view,
                                     const double normal[3],
                                     const double point[3]) {
  double h[3];
  for (int k = 0; k < 3; k++)
    h[k] = normal[k] * (view->parallel ? view->F[k] : point[k] - view->E[k]);
  return h[0] + h[1] + h[2];
}

/* A point's image as (w sx, w sy, t), which is linear in the point, and where
 * it is on the screen: the first two over w, which is t or, in parallel, 1. */
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

/* The depth t of a ray's point where it meets a plane with this q. */
static inline double hsr_view_depth(const struct hsr_view *view, double q) {
  return view->parallel ? -q : 1 / q;
}

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
