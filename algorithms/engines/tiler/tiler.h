/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The tiler: writes faces into a memory of depths and ids, sample by sample.
 * The z-buffer algorithms share it. To tile a face is to scan-convert it.
 *
 * Source      Sutherland, Sproull and Schumacker 1974, appendix B, "Brute-Force
 *             Image-Space"; E. Catmull, PhD thesis, University of Utah, 1974.
 * Notation    Raster element -> sample (i, j). Recorded depth -> z, as q = 1/t;
 *             in parallel projection as far - t, where `far` is farther than
 *             anything. Greater is nearer; 0 is the background.
 * Invariant   At every sample, ids[] holds the nearest of the faces tiled so
 *             far. z[] is within HSR_RHO z of that face's q there, or NaN,
 *             which says that it is unknown.
 * Ties        Depths that are closer than their bounds are compared exactly, by
 *             hsr_nearer. A sample that is closer to an edge than its bound is
 *             decided by hsr_covers.
 * Ways        Small triangles before the eye take the fast way, sixteen at a
 *             time: their vertices are snapped to a grid of 2^-15 pixel, and
 *             coverage and depth are computed in floats. All other faces take
 *             the general way, row by row. The bounds are proved in tiler.c.
 * Ids         A face has two numbers. One is its number f in the tiler's world,
 *             tiler->screen.world, which may be another one for each batch. The
 *             other is its id in the picture: hsr_tiler_id.
 *
 * How it is used: hsr_tiler_begin; in parallel projection hsr_tiler_set_range;
 * for each world hsr_tiler_snap or its kin; hsr_tiler_begin_part. Then
 * triangles, by batches: hsr_tiler_look, perhaps hsr_tiler_drop,
 * hsr_tiler_set_up, hsr_tiler_tile_batch. And all other faces: hsr_tiler_place,
 * hsr_tiler_tile_generally.
 *
 * Depths q are those of Notation; rows and columns are those of samples in the
 * picture. All that a function gets is borrowed for the call. */
#ifndef HSR_ALGORITHMS_TILER_H
#define HSR_ALGORITHMS_TILER_H

#include "algorithms/engines/light/glass.h"
#include "common/exact/alone.h"
#include "common/exact/pair.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The part and its counters. As subjects, faces have their ids in the picture;
 * HSR_BACKGROUND stands for a sample without a face. The lines of its outline
 * say what is done for each face that is tiled. */
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

/* A recorded depth z may be off by HSR_RHO z. So of two such depths, one that
 * is more than HSR_CLEAR times the other is certainly nearer. */
#define HSR_RHO 0x1p-16f
#define HSR_CLEAR (1 + 2.5f * 0x1p-16f)

enum { HSR_BATCH = 128 }; /* faces looked at together; whole vectors of them */

/* A vertex, snapped: x and y in grid units, INT_MIN if it is not safely before
 * the eye; and its depth. */
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

/* What becomes of a triangle: it has no sample, or is left out; it takes the
 * fast way; or the general way. */
enum hsr_fate { HSR_DROP = 0, HSR_TILE = 1, HSR_GENERALLY = 2 };

/* Triangles ready to be tiled. Of each: the three edge functions e at the first
 * sample of its box, and their steps to the right (ex) and down (ey), positive
 * inside; the bound of their errors; the depth there, and its steps. */
struct hsr_triangles {
  float e0[HSR_BATCH], e1[HSR_BATCH], e2[HSR_BATCH], ex0[HSR_BATCH],
      ex1[HSR_BATCH], ex2[HSR_BATCH], ey0[HSR_BATCH], ey1[HSR_BATCH],
      ey2[HSR_BATCH], bound[HSR_BATCH];
  float q[HSR_BATCH], qx[HSR_BATCH], qy[HSR_BATCH];
};

/* One of them, with its box. `face` is its number in the tiler's world, `id`
 * that in the picture. */
struct hsr_triangle {
  float e0, e1, e2, ex0, ex1, ex2, ey0, ey1, ey2, bound;
  float q, qx, qy;
  int x0, y0, x1, y1;
  uint32_t face, id;
  bool generally; /* it takes the general way: only its box and face count */
};

/* Triangles looked at together: numbers first to first + n - 1. fate[k] says
 * what becomes of number first + k. The n_fast ones that take the fast way are
 * in `corners` and `triangles`; the k-th of these is number first +
 * place[k]. */
struct hsr_batch {
  uint32_t first;
  int n, n_fast;
  int general; /* not 0: some take the general way */
  struct hsr_corners corners;
  struct hsr_triangles triangles;
  int one_sided[HSR_BATCH], fate[HSR_BATCH], place[HSR_BATCH];

  /* After hsr_tiler_set_up: the k-th fast one is still to be tiled. 0: floats
   * do not hold its depth, and its fate is HSR_GENERALLY; or the caller has
   * dealt with it. */
  int good[HSR_BATCH];
};

/* Triangles in another order than their world's. Of the k-th: its corners,
 * vertex[3 k] to vertex[3 k + 2], as indices of tiler->corner[]; its face in
 * the tiler's world; and whether that is one-sided. */
struct hsr_triangle_list {
  uint32_t *vertex, *face;
  bool *one_sided;
};

struct hsr_tiler {
  const struct hsr_view *view;
  struct hsr_tally *tally;
  struct hsr_screen screen;  /* of the tiler's world */
  struct hsr_corner *corner; /* by vertex of that world */
  int *columns;              /* room for the spans of the largest face */

  /* The triangles that are looked at, if not by the order of their faces; else
   * NULL. With a list, corner[] has the vertices of the list, and the screen's
   * own vertices are transformed only for a face that is asked about
   * exactly. */
  const struct hsr_triangle_list *list;

  /* The ids in the picture of the world's faces: first_id + id[f], or first_id
   * + f if id is NULL. */
  const uint32_t *id;
  uint32_t first_id;

  /* If the tiler's world is not that of the picture, but has some faces of it
   * that are laid out for a while: that world, whose planes are found when they
   * are needed; and `pair`, which compares two faces by their ids. Otherwise
   * both are NULL. */
  struct hsr_world *few;
  struct hsr_pair *pair;

  /* Transforms the vertices of the screen's world. It is called at the latest
   * when the exact place of one is needed. NULL: that has been done. */
  void (*lay_out)(void *context);
  void *context;

  /* If the screen has no arrays, since the world has only the corner numbers
   * and sides of its faces: lays out one face that is asked about exactly.
   * Otherwise NULL. */
  struct hsr_alone *alone;

  /* If the opaque faces of a transparent picture are tiled: their colours.
   * Otherwise NULL. */
  struct hsr_glass *glass;

  struct hsr_window window; /* of the view */

  /* The part of the window that is being tiled. Sample (i, j) has its depth at
   * z[(j - part.y0) * z_stride + i - part.x0], and its id in ids[] likewise. */
  struct hsr_window part;
  float *z;
  uint32_t *ids;
  size_t z_stride, ids_stride;

  double far;    /* in parallel projection: q = far - t */
  float nearest; /* a q that is less is certainly past near */

  int first_x, first_y; /* the place of sample (0, 0), in grid units */
  bool on_grid;         /* the samples lie on the grid: triangles may be fast */
  const struct hsr_twin *twin; /* the loops for this machine: tiler.c */
};

/* The id of face f of the tiler's world, as it is in the picture. */
static inline uint32_t hsr_tiler_id(const struct hsr_tiler *tiler, uint32_t f) {
  return tiler->first_id + (tiler->id ? tiler->id[f] : f);
}

/* Sets all that depends on the job's view and on the machine; the rest is 0.
 * `job` and its view are borrowed as long as *tiler. */
void hsr_tiler_begin(struct hsr_tiler *tiler, const struct hsr_job *job);

/* In parallel projection, before anything is snapped: what is tiled has depths
 * t, along F, from about `nearest` to about `farthest`. What lies outside of
 * that is tiled as well, but the general way. `size`: nothing is farther from
 * the eye. */
void hsr_tiler_set_range(struct hsr_tiler *tiler, double nearest,
                         double farthest, double size);

/* Snaps the vertices of the screen's world, once they are transformed. */
void hsr_tiler_snap(struct hsr_tiler *tiler);

/* Transforms n points of the world and snaps them, for corner[first] and so
 * on. */
void hsr_tiler_snap_points(struct hsr_tiler *tiler, size_t first, size_t n,
                           const double *x, const double *y, const double *z);

/* How a vertex X is taken to the screen: rows X + origin = (w sx, w sy, w). sx
 * and sy are within 2^-24 pixel if w > sure. In parallel projection w is 1, and
 * the third row makes t instead; if `sure` is below 1, t is within 2^-26 of the
 * range of depths. */
struct hsr_way_to_screen {
  double rows[3][3], origin[3], sure;
};

/* Transforms the vertices of the screen's world, if tiler->lay_out has not done
 * so yet. */
void hsr_tiler_need_screen(struct hsr_tiler *tiler);

/* Snaps n vertices by `way`, without transforming the screen's, for corner[0]
 * and so on. False if for one of them w is not above way->sure, or it is not on
 * the screen: then all are to be snapped by hsr_tiler_snap or
 * hsr_tiler_snap_points. */
bool hsr_tiler_snap_far(struct hsr_tiler *tiler, size_t n, const double *x,
                        const double *y, const double *z,
                        const struct hsr_way_to_screen *way);

/* Makes `part` of the window the one to be tiled, and clears its samples.
 * tiler->z and ->ids, with their strides, have been set by the caller. */
void hsr_tiler_begin_part(struct hsr_tiler *tiler, struct hsr_window part);

/* Looks at n triangles of the world, or of the list, from number `first` on.
 * Finds their boxes within the window, turns them so that their area is
 * positive, and decides what becomes of them: batch->fate[]. The fast ones are
 * put into batch->corners. n is at most HSR_BATCH. */
void hsr_tiler_look(const struct hsr_tiler *tiler, struct hsr_batch *batch,
                    uint32_t first, int n);

/* The face, in the tiler's world, of the k-th triangle that was looked at. */
static inline uint32_t hsr_tiler_face(const struct hsr_tiler *tiler,
                                      const struct hsr_batch *batch, int k) {
  uint32_t place = batch->first + (uint32_t)k;
  return tiler->list ? tiler->list->face[place] : place;
}

/* Leaves out each fast triangle k with drop[k] not 0. */
void hsr_tiler_drop(struct hsr_batch *batch, const int *drop);

/* Sets up the fast triangles: fills batch->triangles and ->good[]. Those whose
 * depths floats do not hold are sent the general way. */
void hsr_tiler_set_up(const struct hsr_tiler *tiler, struct hsr_batch *batch);

/* Tiles the fast triangles that are good. The window is the only part. The
 * caller tiles those of fate HSR_GENERALLY. */
void hsr_tiler_tile_batch(struct hsr_tiler *tiler,
                          const struct hsr_batch *batch);

/* hsr_tiler_take: the k-th fast triangle, which has been set up.
 * hsr_tiler_tile: tiles what of a triangle lies in the part. */
struct hsr_triangle hsr_tiler_take(const struct hsr_tiler *tiler,
                                   const struct hsr_batch *batch, int k);
void hsr_tiler_tile(struct hsr_tiler *tiler,
                    const struct hsr_triangle *triangle);

/* Would the triangle be written to sample (i, j), if it were tiled? */
bool hsr_tiler_shows(struct hsr_tiler *tiler,
                     const struct hsr_triangle *triangle, int i, int j);

/* As hsr_tiler_tile, for a triangle that is known to be nearer than all that is
 * there: its depths are not compared. */
void hsr_tiler_tile_before(struct hsr_tiler *tiler,
                           const struct hsr_triangle *triangle);

/* The box of the samples that face f of the tiler's world may cover, which may be
 * empty, and its nearest and its farthest depth, from its snapped corners. False if
 * they do not tell. corner[] must be that of the world. */
bool hsr_tiler_bound(const struct hsr_tiler *tiler, uint32_t f,
                     struct hsr_bounds *box, float *nearest, float *farthest);

/* The general way, for face f of the tiler's world. hsr_tiler_place: finds its
 * plane and its box; false if it does not exist in this view or has no sample
 * in the window. hsr_tiler_tile_generally: tiles what of it lies in the
 * part. */
bool hsr_tiler_place(struct hsr_tiler *tiler, uint32_t f);
void hsr_tiler_tile_generally(struct hsr_tiler *tiler, uint32_t f);

/* Copies the part's ids to the job's answer. */
void hsr_tiler_write_back(const struct hsr_tiler *tiler,
                          const struct hsr_job *job);

#ifdef __cplusplus
}
#endif
#endif
