/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The quadtree of error-bounded rendering: polygons in squares of the screen,
 * with the depths between which all that is visible in a square lies.
 *
 * Source      N. Greene and M. Kass, "Error-Bounded Antialiased Rendering of
 *             Complex Environments", SIGGRAPH 1994; N. Greene, PhD thesis, UC
 *             Santa Cruz, 1995, 5.4 ("the thesis").
 * Notation    Quadtree cell -> struct hsr_bounded_cell; polygon -> struct
 *             hsr_shape. z -> q = 1/t, or -t in parallel projection: greater is
 *             nearer. znear, zfar -> near, far.
 * Passes      The tiling pass puts polygons into the quadtree, which it divides
 *             down to 2^-HSR_BOUNDED_TILING pixels. The refinement pass divides
 *             it further, until the interval of each pixel is narrow enough.
 * Order       In the tiling pass polygons come by cubes, from front to back; or
 *             in strict order, each before all that it may hide (strict.h).
 * Invariants  - Of the polygons that have been put in, each of which anything
 *             is visible in a cell is in the list of a leaf of that cell.
 *             - Nothing that is visible in a cell is farther than its `far`,
 *             which only grows.
 *             - The interval of a pixel holds its exact value, and never
 *             becomes wider. */
#ifndef HSR_ALGORITHMS_BOUNDED_H
#define HSR_ALGORITHMS_BOUNDED_H

#include "algorithms/algorithm.h"
#include "algorithms/hierarchical/bounded/queue.h"
#include "algorithms/hierarchical/bounded/shape.h"
#include "algorithms/hierarchical/bounded/surface.h"
#include "common/answers/kinds/area.h"
#include "common/exact/pair.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What it counts; error_bounded.c has the meanings. */
enum {
  /* Of the tiling pass */
  HSR_BOUNDED_NODES,
  HSR_BOUNDED_OUT,
  HSR_BOUNDED_CUBES_TESTED,
  HSR_BOUNDED_CUBES_CULLED,
  HSR_BOUNDED_SIDE_CELLS,
  HSR_BOUNDED_FACES,
  HSR_BOUNDED_REPEATED,
  /* Of the quadtree */
  HSR_BOUNDED_PLACED,
  HSR_BOUNDED_MISSED,
  HSR_BOUNDED_FARTHER,
  HSR_BOUNDED_STRUCTURES,
  HSR_BOUNDED_REMOVED,
  HSR_BOUNDED_PRUNED,
  HSR_BOUNDED_STORED,
  HSR_BOUNDED_SPLITS,
  HSR_BOUNDED_ORDERED,
  /* Of the refinement pass */
  HSR_BOUNDED_BOUNDED,
  HSR_BOUNDED_SHADED,
  HSR_BOUNDED_EXACT_ONE,
  HSR_BOUNDED_EXACT_TWO,
  HSR_BOUNDED_EXACT_MORE,
  HSR_BOUNDED_REFINED,
  HSR_BOUNDED_PIXELS,
  HSR_BOUNDED_N_COUNTERS
};

enum {
  /* The most polygons of a leaf's list. A leaf that is too small to be divided
   * by the tiling pass may have more. */
  HSR_BOUNDED_CAPACITY = 10,
  HSR_BOUNDED_TILING = 3 /* the tiling pass divides to 2^-3 pixels */
};

#define HSR_BOUNDED_NONE UINT32_MAX

/* An entry of a leaf's list. */
struct hsr_bounded_entry {
  uint32_t shape; /* the polygon: an index of tree->shapes */
  uint32_t next;  /* HSR_BOUNDED_NONE: this is the last */
  bool covers;    /* the polygon covers the cell */
};

/* How a cell lies to the window. One that straddles its border is divided. */
enum hsr_bounded_place {
  HSR_BOUNDED_OUTSIDE,
  HSR_BOUNDED_STRADDLES,
  HSR_BOUNDED_INSIDE
};

struct hsr_bounded_cell {
  uint32_t parent; /* the root is its own parent */
  uint32_t child;  /* the first of four, which follow one another; 0: a leaf */
  uint32_t first, n; /* of a leaf: its list, and how long that is */
  int level;         /* the side is 2^level pixels */
  enum hsr_bounded_place place;
  bool done; /* of a pixel: its interval is narrow enough */
  /* Time ended in the tiling pass: polygons that were not put in may be seen
   * here. */
  bool untiled;
  double x, y; /* the middle of the square, in pixels */
  double near, far;
  /* By channel: bounds of the integral over the square; if it has more than a
   * pixel, over each of its pixels. */
  double lo[3], hi[3];
};

/* Do polygons p and r lie on one plane? The answers given last are kept, since
 * the same pairs are asked about again. */
enum { HSR_BOUNDED_PLANES = 1 << 12 };
struct hsr_bounded_planes {
  uint32_t p, r; /* HSR_BOUNDED_NONE: nothing is known */
  bool same;
};

/* The quadtree. Cells and list entries are in blocks that do not move; they are
 * known by their numbers. */
enum { HSR_BOUNDED_BLOCK = 1 << 12 };
struct hsr_bounded_tree {
  const struct hsr_job *job;
  struct hsr_tally *tally;
  struct hsr_pair *pair;
  struct hsr_growing cells, entries; /* pointers to blocks */
  struct hsr_growing shapes;         /* struct hsr_shape */
  uint32_t n_cells, n_entries, free_cells, free_entries;
  struct hsr_growing queue;
  /* HSR_BOUNDED_PLANES answers, those given last: see hsr_bounded_before. */
  struct hsr_bounded_planes *planes;
  uint32_t in_order; /* polygons from this number on came in strict order, from
                        front to back; HSR_BOUNDED_NONE: none did */
  double until; /* when the time ends, by hsr_seconds_now; INFINITY: never */
  bool late;    /* it has ended */
  unsigned asked;
  double background[3];
  struct hsr_shades shades;
  /* Of struct hsr_surface, by shape. Empty if each face has one colour. */
  struct hsr_growing surfaces;
};

static inline struct hsr_bounded_cell *
hsr_bounded_cell(const struct hsr_bounded_tree *t, uint32_t c) {
  return ((struct hsr_bounded_cell **)t->cells.items)[c / HSR_BOUNDED_BLOCK] +
         c % HSR_BOUNDED_BLOCK;
}
static inline struct hsr_bounded_entry *
hsr_bounded_entry(const struct hsr_bounded_tree *t, uint32_t e) {
  return ((struct hsr_bounded_entry **)
              t->entries.items)[e / HSR_BOUNDED_BLOCK] +
         e % HSR_BOUNDED_BLOCK;
}
static inline const struct hsr_shape *
hsr_bounded_shape(const struct hsr_bounded_tree *t, uint32_t s) {
  return (const struct hsr_shape *)t->shapes.items + s;
}
static inline struct hsr_square
hsr_bounded_square(const struct hsr_bounded_cell *cell) {
  return (struct hsr_square){cell->x, cell->y, ldexp(.5, cell->level)};
}

/* Did polygon s come in strict order? If so, it hides those that came later,
 * wherever it covers them. A cell that such polygons cover has a `far` of
 * infinity: nothing that comes later is seen in it. */
static inline bool hsr_bounded_in_order(const struct hsr_bounded_tree *t,
                                        uint32_t s) {
  return t->in_order != HSR_BOUNDED_NONE && s >= t->in_order;
}

/* A polygon as the subject of a step: its face. */
static inline struct hsr_subject
hsr_bounded_face(const struct hsr_bounded_tree *t, uint32_t s) {
  return HSR_FACE(hsr_bounded_shape(t, s)->id);
}

/* No point of polygon s in a square has a q above hsr_bounded_nearest, or below
 * hsr_bounded_farthest. */
static inline double hsr_bounded_nearest(const struct hsr_bounded_tree *t,
                                         uint32_t s,
                                         const struct hsr_square *square) {
  double lo, hi;
  hsr_line_range(&hsr_bounded_shape(t, s)->q, square, &lo, &hi);
  return hi;
}
static inline double hsr_bounded_farthest(const struct hsr_bounded_tree *t,
                                          uint32_t s,
                                          const struct hsr_square *square) {
  double lo, hi;
  hsr_line_range(&hsr_bounded_shape(t, s)->q, square, &lo, &hi);
  return lo;
}

/* A cell as the subject of a step, and the pixels that it meets, as its
 * window. */
struct hsr_subject hsr_bounded_subject(const struct hsr_bounded_cell *cell);
struct hsr_window hsr_bounded_window(const struct hsr_bounded_tree *t,
                                     const struct hsr_bounded_cell *cell);

/* Makes a tree of one leaf, the root, which holds the window. The time ends at
 * `until`. `pair` compares faces of the job's scene; `form` has the shader. All
 * is borrowed as long as *tree; memory from job->scratch. HSR_E_NOMEM. */
enum hsr_status hsr_bounded_begin(struct hsr_bounded_tree *tree,
                                  const struct hsr_job *job,
                                  const struct hsr_area_form *form,
                                  double until, struct hsr_pair *pair);

/* Puts face f of the screen's world, whose id in the scene is `id`, into the
 * quadtree, from the smallest cell that encloses it downwards. Its plane has
 * been filled in. False: out of memory. */
bool hsr_bounded_add(struct hsr_bounded_tree *tree,
                     const struct hsr_screen *screen, uint32_t f, uint32_t id);

/* The same for a piece of face f, which lies on the plane `own` and is cut by
 * n_cuts planes. `cut` is borrowed as long as *tree. */
bool hsr_bounded_add_piece(struct hsr_bounded_tree *tree,
                           const struct hsr_screen *screen, uint32_t f,
                           uint32_t id, const struct hsr_shape_cut *own,
                           const struct hsr_shape_cut *cut, uint32_t n_cuts);

/* SubdivideQCell of the thesis: divides a leaf into four. False: out of
 * memory. */
bool hsr_bounded_split(struct hsr_bounded_tree *tree, uint32_t cell);

/* Finds the covering structures of a leaf (polygons that together cover it),
 * and removes polygons that they hide. */
void hsr_bounded_settle(struct hsr_bounded_tree *tree, uint32_t cell);

/* Does polygon s of a leaf's list cover the leaf, alone (`covers`) or with
 * others? If so, updates `far`, and removes polygons that are hidden. */
void hsr_bounded_cover(struct hsr_bounded_tree *tree,
                       struct hsr_bounded_cell *cell,
                       const struct hsr_square *square, uint32_t s,
                       bool covers);

/* Frees all cells below a cell, which becomes a leaf with an empty list. */
void hsr_bounded_free_below(struct hsr_bounded_tree *tree, uint32_t cell);

/* Is polygon p nowhere in a square behind polygon r? Their planes are compared.
 * False also if that is not certain. */
bool hsr_bounded_before(const struct hsr_bounded_tree *tree, uint32_t p,
                        uint32_t r, const struct hsr_square *square);

/* A side of a cube (in the thesis a cube face) on the screen: its corners,
 * within `margin` pixels; and its q at (sx, sy), the lesser of a sx + b sy + c
 * and `nearest`, which is nowhere less than the truth. */
struct hsr_bounded_side {
  double x[4], y[4], margin;
  double a, b, c, nearest;
};

/* CouldCubeFaceBeVisible of the thesis: false if the side is hidden all over.
 * No more than `most` cells are visited; then, or if memory or time ran out, it
 * returns true. `cube` is the subject of the steps. */
bool hsr_bounded_could_be_seen(struct hsr_bounded_tree *tree,
                               const struct hsr_bounded_side *side,
                               uint64_t most, struct hsr_subject cube);

/* Has the time ended? From then on the caller tiles nothing, but calls
 * hsr_bounded_leave; and cells are bounded with little work. */
bool hsr_bounded_is_late(struct hsr_bounded_tree *tree);

/* Marks cells as untiled: polygons that will not be put in may be seen behind a
 * front side of their cube (false: out of memory); or with
 * hsr_bounded_leave_all anywhere. */
bool hsr_bounded_leave(struct hsr_bounded_tree *tree,
                       const struct hsr_bounded_side *side);
void hsr_bounded_leave_all(struct hsr_bounded_tree *tree);

/* The least and the greatest value of each channel that polygon s may show in a
 * cell. */
void hsr_bounded_shade(const struct hsr_bounded_tree *tree,
                       const struct hsr_bounded_cell *cell, uint32_t s,
                       double low[3], double high[3]);

/* The same of all that may be seen in a leaf. If that is not known, any
 * colour. */
void hsr_bounded_hull(const struct hsr_bounded_tree *tree,
                      const struct hsr_bounded_cell *cell, double low[3],
                      double high[3]);

/* Bounds, by channel, of the mean colour over a leaf; if it has more than a
 * pixel, over each of its pixels. Up to `most` polygons are integrated in
 * closed form. */
void hsr_bounded_mean(const struct hsr_bounded_tree *tree,
                      const struct hsr_bounded_cell *cell, uint32_t most,
                      double lo[3], double hi[3]);

/* What the refinement pass is to do. */
struct hsr_bounded_limits {
  enum hsr_bounded_order order;
  /* A pixel's interval need not be narrower than eps. */
  struct hsr_area_form form;
  struct hsr_window window; /* the pixels that are asked for */
  int deepest;    /* cells are not divided below a side of 2^-deepest pixels; at
                     most HSR_BOUNDED_DEEPEST */
  uint32_t cells; /* no more cells exist at a time */
  uint32_t exact; /* up to so many polygons of a cell are integrated in closed
                     form */
};

/* The refinement pass. Writes the intervals of all pixels of the tree's window,
 * or if the filter is wider than a pixel, of limits->window. HSR_E_NOMEM. */
enum hsr_status hsr_bounded_refine(struct hsr_bounded_tree *tree,
                                   const struct hsr_bounded_limits *limits,
                                   struct hsr_error *err);

/* How many pixels to either side of a point's own pixel the filter reaches. */
int hsr_bounded_reach(enum hsr_area_filter filter);

#ifdef __cplusplus
}
#endif
#endif
