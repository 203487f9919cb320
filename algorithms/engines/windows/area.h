/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How a face lies to a rectangle of samples: what every subdivision of the
 * picture asks.
 *
 * Source      J. E. Warnock, "A hidden-surface algorithm for computer-generated
 *             halftone pictures", University of Utah, TR 4-15, 1969;
 *             Sutherland et al. 1974, figure 26, "Surrounding Polygons".
 * Notation    window -> area, a rectangle whose corners are samples;
 *             surrounder, intersecter, disjoint -> enum hsr_relation
 * Certain     A disjoint face certainly covers no sample of the area, and a
 *             surrounder certainly covers all. A face for which neither is
 *             proved is an intersecter. An area of one sample has no
 *             intersecter. */
#ifndef HSR_ALGORITHMS_AREA_H
#define HSR_ALGORITHMS_AREA_H

#include "algorithms/algorithm.h"
#include "common/exact/screen.h"

struct hsr_area {
  int x0, y0, x1, y1; /* columns [x0, x1), rows [y0, y1) */
  int level;          /* of subdivision, set by the caller; 0: the picture */

  /* On the screen, in pixels: sx of the first and the last column, sy of the
   * first and the last row; the centre, and half the sides. */
  double sx[2], sy[2], centre_x, centre_y, half_width, half_height;
};

/* The area of these samples, of which there is at least one. Its level is 0. */
struct hsr_area hsr_area_make(const struct hsr_view *view,
                              struct hsr_window samples);

static inline bool hsr_area_is_sample(const struct hsr_area *area) {
  return area->x1 - area->x0 == 1 && area->y1 - area->y0 == 1;
}

static inline struct hsr_window hsr_area_samples(const struct hsr_area *area) {
  return hsr_window_make(area->x0, area->y0, area->x1, area->y1);
}

/* Figure 26. */
enum hsr_relation { HSR_DISJOINT, HSR_INTERSECTER, HSR_SURROUNDER };

/* The relation of a face for which its bounds do not decide. `reaches_over`:
 * the bounds hold the whole area. For hsr_area_relate. */
enum hsr_relation hsr_area_relate_edges(const struct hsr_screen *screen,
                                        uint32_t f, const struct hsr_area *area,
                                        bool reaches_over,
                                        struct hsr_tally *tally);

/* The same, but the surround test is left to the caller: whether the face
 * surrounds the first sample. *asks is set if all depends on that: the face is
 * whole, and no edge of it meets the area. Otherwise it is left alone. */
enum hsr_relation hsr_area_relate_but_surround(const struct hsr_screen *screen,
                                               uint32_t f,
                                               const struct hsr_area *area,
                                               bool reaches_over, bool *asks,
                                               struct hsr_tally *tally);

/* Whether the bounds b of a face decide how it lies to an area: *relation. If
 * not, *reaches_over is as above. */
static inline bool hsr_area_box_decides(struct hsr_bounds b,
                                        const struct hsr_area *w,
                                        enum hsr_relation *relation,
                                        bool *reaches_over) {
  bool apart = b.x1 <= w->x0 || b.x0 >= w->x1 || b.y1 <= w->y0 || b.y0 >= w->y1;
  bool contained =
      b.x0 >= w->x0 && b.x1 <= w->x1 && b.y0 >= w->y0 && b.y1 <= w->y1;
  *reaches_over =
      b.x0 <= w->x0 && b.x1 >= w->x1 && b.y0 <= w->y0 && b.y1 >= w->y1;
  *relation = apart ? HSR_DISJOINT : HSR_INTERSECTER;
  return apart || (contained && !*reaches_over);
}

/* How a relevant face, whose bounds are b, lies to an area. *by_box: the bounds
 * alone have decided. */
static inline enum hsr_relation hsr_area_relate(const struct hsr_screen *screen,
                                                uint32_t f, struct hsr_bounds b,
                                                const struct hsr_area *w,
                                                bool *by_box,
                                                struct hsr_tally *tally) {
  enum hsr_relation relation;
  bool reaches_over;
  *by_box = hsr_area_box_decides(b, w, &relation, &reaches_over);
  return *by_box ? relation
                 : hsr_area_relate_edges(screen, f, w, reaches_over, tally);
}

/* The depths of a face's plane at the corners of an area, as by hsr_depth:
 * corner k is at sx[k & 1], sy[k / 2]. */
struct hsr_area_depths {
  uint32_t id;
  double q[4], error;
};
static inline struct hsr_area_depths
hsr_area_depths(const struct hsr_screen *screen, uint32_t f,
                const struct hsr_area *w) {
  const struct hsr_depth_plane *p = &screen->plane[f];
  struct hsr_area_depths depths = {.id = f, .error = p->error};
  for (int corner = 0; corner < 4; corner++)
    depths.q[corner] =
        p->a * w->sx[corner & 1] + p->b * w->sy[corner / 2] + p->c;
  return depths;
}

/* +1: the plane of f is nearer than that of g at all corners of an area, and so
 * all over it. -1: that of g is. 0: neither, or it is not certain. */
static inline int hsr_area_order(const struct hsr_screen *screen,
                                 const struct hsr_area_depths *f,
                                 const struct hsr_area_depths *g) {
  const uint32_t *plane = screen->world->mesh.plane;
  if (plane[f->id] == plane[g->id])
    return f->id < g->id ? 1 : -1;
  double bound = f->error + g->error;
  int n_nearer = 0, n_farther = 0;
  for (int corner = 0; corner < 4; corner++) {
    double by = f->q[corner] - g->q[corner];
    n_nearer += by > bound;
    n_farther += by < -bound;
  }
  return n_nearer == 4 ? 1 : n_farther == 4 ? -1 : 0;
}

#endif
