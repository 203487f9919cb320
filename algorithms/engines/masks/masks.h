/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The mask pyramid, and tiling convex polygons into it.
 *
 * Source      N. Greene, "Hierarchical Polygon Tiling with Coverage Masks",
 *             SIGGRAPH 1996, 3.1, 4.1 and listing 1; N. Greene, PhD thesis, UC
 *             Santa Cruz, 1995, 4.5.
 * Notation    (C_c, C_v) -> struct hsr_triage of a cell; the finest level has
 *             C_c alone, a bit a sample. (P_c, P_v), W and A as in listing 1.
 *             A cell is known by its level, number and corner; its 64 subcells
 *             have the numbers 64 number + bit.
 * Invariant   on every path of subcells that are active: C_c is set just where
 *             all samples are covered, C_v just where none is, except that
 *             samples outside of the window count as covered once a cell has
 *             been entered. What lies below a vacant subcell is cleared when it
 *             is entered (lazy clearing); below a covered one it is stale.
 * Ties        where rounding leaves open on which side of an edge a sample is,
 *             the exact predicates say.
 * Departures  the lines that cross a subcell are chosen by the masks of the
 *             lines; intercepts are found from a line's equation, and not from
 *             those in the cell above. Where at most four subcells of the
 *             finest level meet the polygon's box, they are put to all lines at
 *             once, and the polygon's masks of their cell are not built.
 *             Subcells of the finest level are tiled by one loop instead of a
 *             call each. Both are there to save time. */
#ifndef HSR_ALGORITHMS_TILING_MASKS_H
#define HSR_ALGORITHMS_TILING_MASKS_H

#include "algorithms/algorithm.h"
#include "common/exact/screen.h"
#include "common/voxels/triage.h"

#ifdef __cplusplus
extern "C" {
#endif

/* An edge, as a line of the screen: f = a sx + b sy + c, computed anywhere in
 * the picture, is off by less than `error`; inside it is positive. An error
 * that is not finite says that nothing is known. */
struct hsr_mask_line {
  double a, b, c, error;
  double span;         /* |a| + |b| */
  double per_a, per_b; /* 1/a, 1/b; they count only where a line is steep
                          enough for them */
};

struct hsr_mask_polygon {
  const struct hsr_mask_line *line;
  uint32_t n;
  /* Whether sample (sx, sy) is inside line k, exactly. */
  bool (*inside)(void *context, uint32_t k, double sx, double sy);
  /* Of a polygon whose lines do not say all: whether the sample is covered; it
   * is only asked where the lines say yes. NULL: they say all. */
  bool (*covers)(void *context, double sx, double sy);
  void *context;
};

/* Who is told what has become covered: of the 8 x 8 samples from (x, y) on,
 * those of a mask; and all samples of a square that are in the window. */
struct hsr_mask_sink {
  void (*samples)(void *context, int x, int y, uint64_t mask);
  void (*square)(void *context, int x, int y, int size);
  void *context;
};

/* A cell: its first sample, and samples a side. */
struct hsr_mask_cell {
  int level;
  uint32_t number;
  int x, y, size;
};

/* Whoever goes through the pyramid in his own way. */
struct hsr_mask_visitor {
  /* A cell: the polygon surely covers all of the subcells polygon.c and none of
   * the subcells polygon.v. Returns the subcells to enter. Of a finest cell
   * nothing is known: returns the samples to ask about. */
  uint64_t (*enter)(void *context, const struct hsr_mask_cell *cell,
                    struct hsr_triage polygon);
  /* The samples asked about that the polygon covers, if there are any; and
   * those that it may cover, if the polygon has no function `inside`. */
  void (*samples)(void *context, const struct hsr_mask_cell *cell,
                  uint64_t mask);
  /* A cell that is not of the finest level, after all that was entered. */
  void (*leave)(void *context, const struct hsr_mask_cell *cell,
                uint64_t entered);
  void *context;
};

/* Where the samples of a finest cell are in it, in samples: sample `bit` at
 * (x[bit], y[bit]). */
struct hsr_mask_places {
  double x[64], y[64];
};

/* What the steps taken here raise, in the counting build: counters of the
 * tally. `whom` is the face or the cube for which cells are visited. */
struct hsr_mask_count {
  struct hsr_tally *tally;
  int cells;     /* a cell is visited */
  int finest;    /* a cell of the finest level is, too */
  int pixels;    /* a cell of one or more pixels is, too */
  int unsure;    /* a sample is put to the exact predicates */
  int exhausted; /* a subcell is not entered: none of its counted samples is
                    left; raised only where samples are counted */
  struct hsr_subject whom;
};

/* The events of a visit: the cell (level, column, row), for whom, the samples
 * of it that are in the window. Active: something there is left to be done. */
#define HSR_MASK_VISIT_OUTCOMES "done|active"

enum { HSR_MASK_LEVELS = 6 };

/* Counts of visible samples (thesis, 4.6.3): how many samples of a cell are
 * within the silhouette of the cube at hand and not covered. A cell without the
 * cube's stamp has no count. */
struct hsr_mask_counts {
  uint32_t *stamp[HSR_MASK_LEVELS], *left[HSR_MASK_LEVELS]; /* a cell */
  uint32_t cube;  /* its stamp; 0: no cube is at hand */
  uint32_t cubes; /* stamps that have been given */
  uint32_t all;   /* left of the whole silhouette */
};

struct hsr_masks {
  struct hsr_window window;                   /* cells begin at (x0, y0) */
  int n_levels;                               /* of 8^n_levels samples a side */
  struct hsr_triage *coarse[HSR_MASK_LEVELS]; /* [0] is the root */
  uint64_t *finest;
  const struct hsr_triage_tables *tables;

  const struct hsr_mask_places *places;  /* a pattern */
  const struct hsr_filtering *filtering; /* if it has patterns; or NULL */
  const uint64_t *const *sample_tables; /* a pattern: masks of the finest level;
                                           NULL: they are found exactly */

  struct hsr_mask_lines {
    uint32_t n, *number; /* lines that cross the cell of a level, */
    uint64_t *inside;    /* the subcells that each leaves surely inside, */
    uint32_t *list;      /* and the lines of the subcell at hand */
  } lines[HSR_MASK_LEVELS];
  uint32_t *all;         /* 0, 1, ...: all lines of a polygon */
  struct hsr_bounds box; /* the box that was looked for, */
  struct hsr_mask_cell way[HSR_MASK_LEVELS + 1]; /* from the root to it */
  int n_way;
  bool anywhere; /* a sample may be anywhere in its square, by jitter */
  const struct hsr_mask_twin *twin;
  struct hsr_mask_count count;
  struct hsr_mask_counts *counts; /* of visible samples; NULL: none are kept */
  int pixel; /* samples a side of a pixel of the work picture */
};

/* For the window of a view, all of it vacant; `most` lines a polygon. Tables,
 * places, count and pixel are set by the caller, who has zeroed all.
 * HSR_E_NOMEM. */
enum hsr_status hsr_masks_init(struct hsr_masks *masks,
                               const struct hsr_window *window, uint32_t most,
                               struct hsr_arena *arena);

/* The numbers of the cells of a level that are in the window are less. */
size_t hsr_masks_cells(const struct hsr_masks *masks, int level);

/* Makes room for other than `most` lines a polygon. HSR_E_NOMEM. */
enum hsr_status hsr_masks_room(struct hsr_masks *masks, uint32_t most,
                               struct hsr_arena *arena);

/* Samples a side of the root cell: lines hold in it and not only in the window.
 */
int hsr_masks_extent(const struct hsr_masks *masks);

/* Finds the smallest cell that encloses a box of samples of the window, which
 * is not empty: false if the box is seen to be hidden. */
bool hsr_masks_find(struct hsr_masks *masks, struct hsr_bounds box);

/* Tiles a polygon that is within the box, from the cell found. */
void hsr_masks_tile_found(struct hsr_masks *masks,
                          const struct hsr_mask_polygon *polygon,
                          const struct hsr_mask_sink *sink);

/* Both: false if the box is hidden. Or from the root, whatever the box. */
bool hsr_masks_tile(struct hsr_masks *masks,
                    const struct hsr_mask_polygon *polygon,
                    struct hsr_bounds box, const struct hsr_mask_sink *sink);
void hsr_masks_tile_root(struct hsr_masks *masks,
                         const struct hsr_mask_polygon *polygon,
                         const struct hsr_mask_sink *sink);

/* Tiles whatever is vacant still: the background. */
void hsr_masks_tile_rest(struct hsr_masks *masks,
                         const struct hsr_mask_sink *sink);

/* Whether any sample within the box that the polygon may cover is not covered;
 * what the lines leave open counts as inside. */
bool hsr_masks_show(struct hsr_masks *masks,
                    const struct hsr_mask_polygon *polygon,
                    struct hsr_bounds box);
bool hsr_masks_show_found(struct hsr_masks *masks,
                          const struct hsr_mask_polygon *polygon);

/* Makes masks->counts. HSR_E_NOMEM. */
enum hsr_status hsr_masks_counts_init(struct hsr_masks *masks,
                                      struct hsr_arena *arena);

/* As hsr_masks_show of a cube's silhouette, but goes to all of its samples that
 * are not covered, and keeps their counts: how many there are. Until the next
 * such call, or masks->counts->cube is set to 0, only polygons that lie within
 * the silhouette may be tiled, and cells are passed over of which nothing is
 * left. */
uint32_t hsr_masks_count(struct hsr_masks *masks,
                         const struct hsr_mask_polygon *polygon,
                         struct hsr_bounds box);

/* n samples have been covered, all of them in the square of `size` from (x, y)
 * on, which is a cell or a subcell. The sink says so. */
void hsr_masks_covered(struct hsr_masks *masks, int x, int y, int size,
                       uint32_t n);

/* Takes a visitor to the cells of a polygon that lies within the box, from the
 * root down. Above the smallest cell that encloses the box he is told the box's
 * subcells only. Returns false if he entered none of them before he came to
 * that cell. The visitor keeps the masks of the cells. */
bool hsr_masks_visit(struct hsr_masks *masks,
                     const struct hsr_mask_polygon *polygon,
                     struct hsr_bounds box,
                     const struct hsr_mask_visitor *visitor);

/* The root; a subcell; the subcells, or samples, that are in the window; the
 * pattern of a finest cell, its number in places[]. */
struct hsr_mask_cell hsr_masks_root(const struct hsr_masks *masks);
struct hsr_mask_cell hsr_masks_subcell(const struct hsr_mask_cell *cell,
                                       int bit);
uint64_t hsr_masks_in_window(const struct hsr_masks *masks,
                             const struct hsr_mask_cell *cell);
int hsr_masks_pattern(const struct hsr_masks *masks,
                      const struct hsr_mask_cell *cell);

#ifdef __cplusplus
}
#endif
#endif
