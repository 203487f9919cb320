/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The mask pyramid, and tiling convex polygons into it.
 *
 * Source      N. Greene, "Hierarchical Polygon Tiling with Coverage Masks",
 *             SIGGRAPH 1996, 3.1, 4.1 and listing 1; N. Greene, PhD thesis, UC
 *             Santa Cruz, 1995, 4.5.
 * Notation    Pyramid mask (C_c, C_v) -> struct hsr_triage of a cell; the
 *             finest level has C_c alone, a bit a sample. (P_c, P_v), W and A
 *             as in listing 1. Mask, cell -> the same thing, a square of 8 x 8
 *             subcells or samples. A cell has a level, a number in that level
 *             and a first sample; its 64 subcells have the numbers 64 number +
 *             bit in the next level. Level 0 is the root (the paper's level 1).
 * Invariant   In a cell that can be reached from the root by active subcells:
 *             C_c is set if and only if all samples of the subcell are covered,
 *             C_v if and only if none is. Samples outside of the window count
 *             as covered once the cell has been entered. What is kept below a
 *             vacant subcell is stale until it is cleared, on entry (lazy
 *             clearing); below a covered subcell it is stale for good.
 * Ties        If rounding leaves open on which side of an edge a sample is, the
 *             exact predicates decide.
 * Departures  - The lines that cross a subcell are chosen by the lines' masks,
 *             not by intercepts.
 *             - Intercepts are computed from a line's equation, not
 *             incrementally from those in the cell above.
 *             - To save time: if at most four subcells of the finest level meet
 *             the polygon's box, these are tested against all lines at once,
 *             and the polygon's mask of their cell is not built. Subcells of
 *             the finest level are tiled by one loop, not by a call each. */
#ifndef HSR_ALGORITHMS_TILING_MASKS_H
#define HSR_ALGORITHMS_TILING_MASKS_H

#include "algorithms/algorithm.h"
#include "common/answers/filter.h"
#include "common/exact/screen.h"
#include "common/voxels/triage.h"

#ifdef __cplusplus
extern "C" {
#endif

/* An edge, as a line of the screen: f = a sx + b sy + c, sx and sy in samples;
 * inside it is positive. As computed anywhere in the picture it is off by less
 * than `error`. An error that is not finite says that nothing is known. */
struct hsr_mask_line {
  double a, b, c, error;
  double span;         /* |a| + |b| */
  double per_a, per_b; /* 1/a, 1/b; used only where they are accurate enough */
};

/* A convex polygon to be tiled: what is inside all n lines. All is borrowed. */
struct hsr_mask_polygon {
  const struct hsr_mask_line *line;
  uint32_t n;
  /* Is sample (sx, sy) inside line k? Decided exactly. NULL: nobody needs to
   * know; samples within the error count as inside. */
  bool (*inside)(void *context, uint32_t k, double sx, double sy);
  /* Not NULL: the lines do not suffice. Is a sample that is inside all of them
   * covered? */
  bool (*covers)(void *context, double sx, double sy);
  void *context;
};

/* Receives what becomes covered. samples: of the 8 x 8 samples from (x, y) on,
 * those of the mask. square: all samples of a square, from (x, y) on, that are
 * in the window. Each sample is given once. */
struct hsr_mask_sink {
  void (*samples)(void *context, int x, int y, uint64_t mask);
  void (*square)(void *context, int x, int y, int size);
  void *context;
};

struct hsr_mask_cell {
  int level;
  uint32_t number; /* in the level */
  int x, y;        /* its first sample */
  int size;        /* samples a side */
};

/* Visits the cells of a polygon, and keeps their masks itself: for a module
 * that tiles by other rules than listing 1. */
struct hsr_mask_visitor {
  /* Comes to a cell. The polygon certainly covers all of the subcells polygon.c
   * and nothing of the subcells polygon.v. Returns the subcells to enter. For a
   * cell of the finest level nothing is known of the polygon: returns the
   * samples to ask about. */
  uint64_t (*enter)(void *context, const struct hsr_mask_cell *cell,
                    struct hsr_triage polygon);
  /* Gets the samples, of those asked about, that the polygon covers; not
   * called if there are none. If polygon->inside is NULL, those that it may
   * cover. */
  void (*samples)(void *context, const struct hsr_mask_cell *cell,
                  uint64_t mask);
  /* Leaves a cell above the finest level, when the subcells `entered` have been
   * visited. */
  void (*leave)(void *context, const struct hsr_mask_cell *cell,
                uint64_t entered);
  void *context;
};

/* Where the samples of a cell of the finest level are: sample `bit` at (x[bit],
 * y[bit]) from the cell's corner, in widths of a sample. */
struct hsr_mask_places {
  double x[64], y[64];
};

/* The counters of the steps taken here, in the counting build. `whom` is the
 * face that is tiled, or the cube that is tested: the second subject of the
 * steps. */
struct hsr_mask_count {
  struct hsr_tally *tally;
  int cells;     /* a cell is visited */
  int finest;    /* besides, if the cell is of the finest level */
  int pixels;    /* besides, if the cell has one or more pixels */
  int unsure;    /* a sample is put to the exact predicates */
  int exhausted; /* a subcell is not entered: none of its counted samples is
                    left; raised only where samples are counted */
  struct hsr_subject whom;
};

/* The outcomes of a visit. Active: something in the cell is left to be done.
 * The event has the cell as HSR_CELL(level, column, row), `whom`, and the
 * cell's samples in the window. */
#define HSR_MASK_VISIT_OUTCOMES "done|active"

enum { HSR_MASK_LEVELS = 6 };

/* Counts of visible samples (thesis, 4.6.3). left[] of a cell is the number of
 * its samples that lie within the silhouette of the current cube and are not
 * covered. It counts only if stamp[] of the cell is the cube's stamp. */
struct hsr_mask_counts {
  /* By level and cell. */
  uint32_t *stamp[HSR_MASK_LEVELS], *left[HSR_MASK_LEVELS];
  uint32_t cube;  /* the current cube's stamp; 0: there is none */
  uint32_t cubes; /* how many stamps have been given */
  uint32_t all;   /* such samples of the whole silhouette */
};

struct hsr_masks {
  struct hsr_window window; /* the root begins at (x0, y0) */
  int n_levels;             /* the root has 8^n_levels samples a side */
  /* By level and cell: (C_c, C_v). */
  struct hsr_triage *coarse[HSR_MASK_LEVELS];
  uint64_t *finest; /* of the last level: C_c */
  const struct hsr_triage_tables *tables;

  const struct hsr_mask_places *places;  /* by pattern of jitter */
  const struct hsr_filtering *filtering; /* if it has patterns; or NULL */
  /* By pattern: the table of masks for the finest level. NULL: masks are found
   * exactly. */
  const uint64_t *const *sample_tables;

  /* Of the cell of each level that is being visited: the lines that cross it;
   * for each, the subcells that are surely inside; and room for the lines of
   * one subcell. */
  struct hsr_mask_lines {
    uint32_t n, *number;
    uint64_t *inside;
    uint32_t *list;
  } lines[HSR_MASK_LEVELS];
  uint32_t *all; /* 0, 1, ...: all lines of a polygon */

  /* hsr_masks_find: the box, and the cells from the root to the one found. */
  struct hsr_bounds box;
  struct hsr_mask_cell way[HSR_MASK_LEVELS + 1];
  int n_way;
  bool anywhere; /* a sample may be anywhere in its square, by jitter */
  const struct hsr_mask_twin *twin;
  struct hsr_mask_count count;
  struct hsr_mask_counts *counts; /* of visible samples; NULL: none are kept */
  int pixel; /* samples a side of a pixel of the work picture */
};

/* Makes a pyramid for a window, all of it vacant, and polygons of up to `most`
 * lines. The caller has zeroed *masks and set tables, places, filtering,
 * anywhere, sample_tables, count and pixel, as far as they are needed; these
 * are borrowed. The arrays are the arena's. HSR_E_NOMEM. */
enum hsr_status hsr_masks_init(struct hsr_masks *masks,
                               const struct hsr_window *window, uint32_t most,
                               struct hsr_arena *arena);

/* The numbers of those cells of a level that are in the window are less than
 * this. */
size_t hsr_masks_cells(const struct hsr_masks *masks, int level);

/* Makes room for polygons of up to `most` lines. HSR_E_NOMEM. */
enum hsr_status hsr_masks_room(struct hsr_masks *masks, uint32_t most,
                               struct hsr_arena *arena);

/* Samples a side of the root, which may be larger than the window. The errors
 * of lines must hold in all of it. */
int hsr_masks_extent(const struct hsr_masks *masks);

/* Finds the smallest cell that encloses a box of samples. The box is in the
 * window and not empty. False if all of the box is found to be covered on the
 * way. */
bool hsr_masks_find(struct hsr_masks *masks, struct hsr_bounds box);

/* tile_poly (listing 1) of a polygon that lies within the box, from the cell
 * that hsr_masks_find has found. */
void hsr_masks_tile_found(struct hsr_masks *masks,
                          const struct hsr_mask_polygon *polygon,
                          const struct hsr_mask_sink *sink);

/* hsr_masks_tile: both of these; false if the box is found to be covered.
 * hsr_masks_tile_root: tiles from the root, without a box. */
bool hsr_masks_tile(struct hsr_masks *masks,
                    const struct hsr_mask_polygon *polygon,
                    struct hsr_bounds box, const struct hsr_mask_sink *sink);
void hsr_masks_tile_root(struct hsr_masks *masks,
                         const struct hsr_mask_polygon *polygon,
                         const struct hsr_mask_sink *sink);

/* Tiles all samples that are not covered yet: the background. */
void hsr_masks_tile_rest(struct hsr_masks *masks,
                         const struct hsr_mask_sink *sink);

/* tile_poly as a test (1996, 5.2): may the polygon, which lies within the box,
 * cover a sample that is not covered yet? Nothing is written. Samples within
 * the error of a line count as inside it. hsr_masks_show_found: the same from
 * the cell that hsr_masks_find has found. */
bool hsr_masks_show(struct hsr_masks *masks,
                    const struct hsr_mask_polygon *polygon,
                    struct hsr_bounds box);
bool hsr_masks_show_found(struct hsr_masks *masks,
                          const struct hsr_mask_polygon *polygon);

/* Makes masks->counts, with no current cube. HSR_E_NOMEM. */
enum hsr_status hsr_masks_counts_init(struct hsr_masks *masks,
                                      struct hsr_arena *arena);

/* As hsr_masks_show for the silhouette of a cube, which becomes the current
 * one; but all of its samples that are not covered are counted, cell by cell.
 * Returns how many there are. Until the next such call, or until the caller
 * sets masks->counts->cube to 0, only polygons that lie within the silhouette
 * may be tiled, and cells with a count of 0 are not entered. */
uint32_t hsr_masks_count(struct hsr_masks *masks,
                         const struct hsr_mask_polygon *polygon,
                         struct hsr_bounds box);

/* Takes n samples off the counts. They have become covered, and lie in the
 * square of `size` samples a side from (x, y) on, which is a cell or a subcell.
 * A sink calls it. */
void hsr_masks_covered(struct hsr_masks *masks, int x, int y, int size,
                       uint32_t n);

/* Has a visitor visit the cells of a polygon that lies within the box, from the
 * root down. Above the smallest cell that encloses the box, polygon.v is all
 * but the one subcell with the box. Returns false if the visitor did not enter
 * that subcell of one of these cells: so the box is hidden. */
bool hsr_masks_visit(struct hsr_masks *masks,
                     const struct hsr_mask_polygon *polygon,
                     struct hsr_bounds box,
                     const struct hsr_mask_visitor *visitor);

/* hsr_masks_root: the root. hsr_masks_subcell: a subcell. hsr_masks_in_window:
 * the subcells of a cell, or its samples, that are in the window.
 * hsr_masks_pattern: the pattern of jitter of a cell of the finest level, as an
 * index of places[]. */
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
