/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tiling: writing faces into a memory of depths and ids, sample by sample. What
 * the z-buffer algorithms share.
 *
 * Source      Sutherland, Sproull and Schumacker 1974, appendix B, "Brute-Force
 *             Image-Space"; E. Catmull, PhD thesis, University of Utah, 1974.
 * Notation    raster element -> sample (i, j); recorded depth -> z, as q = 1/t,
 *             or in parallel projection as far - t, where nothing is as far as
 *             `far`; greater is nearer, 0 for the background
 * Invariant   at every sample, ids holds the nearest of the faces tiled so far,
 *             and z is NaN (unknown) or within HSR_RHO z of that face's q there
 * Ties        depths that are closer than their bounds are compared by
 *             hsr_nearer; a sample that is closer to an edge than its bound is
 *             decided by hsr_covers
 *
 * Small triangles before the eye take the fast way, sixteen at a time: their
 * vertices are snapped to a grid of 2^-15 pixel, and coverage and depth are
 * computed in floats. All other faces take the general way, row by row. The
 * bounds are proved in tiler.c.
 *
 * The faces are those of the world of tiler->screen. That world may be another
 * one for each batch. id[] tells what its faces are called in the picture. */
#ifndef HSR_ALGORITHMS_TILER_H
#define HSR_ALGORITHMS_TILER_H

#include "algorithms/engines/light/glass.h"
#include "common/exact/alone.h"
#include "common/exact/pair.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What it counts. The subjects are called as in the picture; HSR_BACKGROUND is a
 * sample without a face. Its lines are for each face that is tiled. */
extern const struct hsr_part hsr_tiler_part;
enum {
  HSR_DEPTH_TESTS = HSR_FIRST_OF(HSR_PART_TILER),
  HSR_WRITES,
  HSR_OVERWRITES,
  HSR_FAST,
  HSR_GENERAL,
  HSR_UNSURE_COVER,
  HSR_UNSURE_DEPTH
};

/* How far a recorded depth may be from the truth, of itself; and a depth q that
 * is more than HSR_CLEAR times another is nearer, both being that exact. */
#define HSR_RHO 0x1p-16f
#define HSR_CLEAR (1 + 2.5f * 0x1p-16f)

enum { HSR_BATCH = 128 }; /* faces looked at together; whole vectors of them */

/* A vertex, snapped: grid units, or INT_MIN where it is not safe; its depth. */
struct hsr_corner {
  int x, y;
  float q;
  int unused; /* to 16 bytes */
};

/* Triangles by their corners a, b, c, and the samples in their boxes: columns
 * [x0, x1), rows [y0, y1). */
struct hsr_corners {
  int ax[HSR_BATCH], ay[HSR_BATCH], bx[HSR_BATCH], by[HSR_BATCH], cx[HSR_BATCH],
      cy[HSR_BATCH];
  float qa[HSR_BATCH], qb[HSR_BATCH], qc[HSR_BATCH];
  int x0[HSR_BATCH], y0[HSR_BATCH], x1[HSR_BATCH], y1[HSR_BATCH];
  uint32_t id[HSR_BATCH]; /* in the picture */
};

static inline float hsr_nearest_corner(const struct hsr_corners *r, int k) {
  float q = r->qa[k] > r->qb[k] ? r->qa[k] : r->qb[k];
  return r->qc[k] > q ? r->qc[k] : q;
}

/* What becomes of a triangle. */
enum hsr_fate { HSR_DROP = 0, HSR_TILE = 1, HSR_GENERALLY = 2 };

/* Triangles ready to be tiled: edge functions and depth at the first sample of
 * the box, and their steps to the right and down. */
struct hsr_triangles {
  float e0[HSR_BATCH], e1[HSR_BATCH], e2[HSR_BATCH], ex0[HSR_BATCH],
      ex1[HSR_BATCH], ex2[HSR_BATCH], ey0[HSR_BATCH], ey1[HSR_BATCH],
      ey2[HSR_BATCH], bound[HSR_BATCH];
  float q[HSR_BATCH], qx[HSR_BATCH], qy[HSR_BATCH];
};

/* One of them. */
struct hsr_triangle {
  float e0, e1, e2, ex0, ex1, ex2, ey0, ey1, ey2, bound;
  float q, qx, qy;
  int x0, y0, x1, y1;
  uint32_t face, id;
  bool generally; /* only its box and face count: it takes the general way */
};

/* Faces looked at together: what becomes of each, and the n_fast ones in
 * `corners` and `triangles`, of which the k-th is face first + place[k]. */
struct hsr_batch {
  uint32_t first;
  int n, n_fast;
  int general; /* not 0: some are to go the general way */
  struct hsr_corners corners;
  struct hsr_triangles triangles;
  int one_sided[HSR_BATCH], fate[HSR_BATCH], place[HSR_BATCH];
  int good[HSR_BATCH]; /* floats hold the depth of the k-th fast one */
};

/* Triangles in another order than their world's: of the k-th, corners vertex[3 k]
 * to vertex[3 k + 2], in `corner`, and the face that it is. */
struct hsr_triangle_list {
  uint32_t *vertex, *face;
  bool *one_sided;
};

struct hsr_tiler {
  const struct hsr_view *view;
  struct hsr_tally *tally;
  struct hsr_screen screen;
  struct hsr_corner *corner; /* a vertex */
  int *columns;              /* room for the spans of the largest face */

  /* Not NULL: the triangles that are looked at. `corner` has their vertices,
   * and the screen's own are only transformed for a face that is asked about. */
  const struct hsr_triangle_list *list;
  /* The ids of the world's faces: that of face f is first_id + id[f], or first_id +
   * f if id is NULL. */
  const uint32_t *id;
  uint32_t first_id;
  /* If the screen's world is not the scene's, but a few faces that are laid out
   * for the moment: that world, whose planes are found when they are asked for,
   * and `pair`, which compares the scene's faces. Otherwise both are NULL. */
  struct hsr_world *few;
  /* Transforms the vertices of the screen's world. It may be called as late as
   * their exact place is asked for. NULL: it has been. */
  void (*lay_out)(void *context);
  void *context;
  struct hsr_pair *pair;
  /* If the screen has no arrays, since its world has but the corner numbers and
   * sides of some faces: what lays out a face that is asked about. Otherwise
   * NULL. */
  struct hsr_alone *alone;
  /* If the picture is transparent, and the opaque faces are tiled: their
   * colours. Otherwise NULL. */
  struct hsr_glass *glass;

  struct hsr_window window;
  struct hsr_window part; /* the part being tiled: its samples (i, j) have */
  float *z;               /* z[(j - part.y0) * z_stride + i - part.x0], and */
  uint32_t *ids;          /* likewise */
  size_t z_stride, ids_stride;

  double far;    /* in parallel, of all recorded depths */
  float nearest; /* a q that is less is certainly past near */

  int first_x, first_y; /* of sample (0, 0), grid units */
  bool on_grid;         /* the samples lie on the grid: triangles may be fast */
  const struct hsr_twin *twin;
};

/* The id of face f of the tiler's world, as it is in the picture. */
static inline uint32_t hsr_tiler_id(const struct hsr_tiler *tiler, uint32_t f) {
  return tiler->first_id + (tiler->id ? tiler->id[f] : f);
}

/* Sets all that depends on the job's view and machine; the rest is 0. */
void hsr_tiler_begin(struct hsr_tiler *tiler, const struct hsr_job *job);

/* In parallel, before anything is snapped: the depths t along F of what is
 * tiled are about nearest to farthest. What lies outside of that is tiled as
 * well, but the general way. `size` is how far from the eye it may be. */
void hsr_tiler_set_range(struct hsr_tiler *tiler, double nearest,
                         double farthest, double size);

/* Snaps the vertices of the screen's world, once they are transformed. */
void hsr_tiler_snap(struct hsr_tiler *tiler);

/* Transforms n points and snaps them, for corner[first] and so on. */
void hsr_tiler_snap_points(struct hsr_tiler *tiler, size_t first, size_t n,
                           const double *x, const double *y, const double *z);

/* How vertices are taken to the screen: rows X + origin = (w sx, w sy, w),
 * within 2^-24 pixel where w > sure. In parallel w is 1, row 2 and its origin
 * make t instead, within 2^-26 of the range of depths, and `sure` is below 1 if
 * that is so. */
struct hsr_way_to_screen {
  double rows[3][3], origin[3], sure;
};

/* Transforms the vertices of the screen's world, if that is still to be
 * done. */
void hsr_tiler_need_screen(struct hsr_tiler *tiler);

/* Snaps n vertices right away. False if one of them is not sure, or not on the
 * screen: then they are to be snapped by the other way. */
bool hsr_tiler_snap_far(struct hsr_tiler *tiler, size_t n, const double *x,
                        const double *y, const double *z,
                        const struct hsr_way_to_screen *way);

/* Clears the samples of a part, which is the next to be tiled. */
void hsr_tiler_begin_part(struct hsr_tiler *tiler, struct hsr_window part);

/* Looks at n triangles of the world, or of the list, from number `first` on: finds
 * their boxes within the window, turns them so that their area is positive and
 * says what becomes of them. The n_fast ones are those to be tiled. */
void hsr_tiler_look(const struct hsr_tiler *tiler, struct hsr_batch *batch,
                    uint32_t first, int n);

/* The face that the k-th of those looked at is. */
static inline uint32_t hsr_tiler_face(const struct hsr_tiler *tiler,
                                      const struct hsr_batch *batch, int k) {
  uint32_t place = batch->first + (uint32_t)k;
  return tiler->list ? tiler->list->face[place] : place;
}

/* Leaves the k-th of the fast ones out where drop[k] is not 0. */
void hsr_tiler_drop(struct hsr_batch *batch, const int *drop);

/* Sets up the fast ones; what floats do not hold is to go the general way. */
void hsr_tiler_set_up(const struct hsr_tiler *tiler, struct hsr_batch *batch);

/* Tiles the fast ones. The window is the only part. */
void hsr_tiler_tile_batch(struct hsr_tiler *tiler,
                          const struct hsr_batch *batch);

/* The k-th of the fast ones; and what of it lies in the part, tiled. */
struct hsr_triangle hsr_tiler_take(const struct hsr_tiler *tiler,
                                   const struct hsr_batch *batch, int k);
void hsr_tiler_tile(struct hsr_tiler *tiler,
                    const struct hsr_triangle *triangle);

/* Would the triangle be written to sample (i, j), if it were tiled? */
bool hsr_tiler_shows(struct hsr_tiler *tiler,
                     const struct hsr_triangle *triangle, int i, int j);

/* The same as hsr_tiler_tile for one that is known to be nearer than what is
 * there: no depths are compared. */
void hsr_tiler_tile_before(struct hsr_tiler *tiler,
                           const struct hsr_triangle *triangle);

/* The general way: is there anything of a face to be tiled; and what of it lies
 * in the part, tiled. */
bool hsr_tiler_place(struct hsr_tiler *tiler, uint32_t f);
void hsr_tiler_tile_generally(struct hsr_tiler *tiler, uint32_t f);

/* Copies the part's ids to the picture's. */
void hsr_tiler_write_back(const struct hsr_tiler *tiler,
                          const struct hsr_job *job);

#ifdef __cplusplus
}
#endif
#endif
