/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The quadtree of error-bounded rendering: polygons in squares of the screen,
 * with the depths between which all that is visible in a square lies.
 *
 * Source      N. Greene and M. Kass, "Error-Bounded Antialiased Rendering of
 *             Complex Environments", SIGGRAPH 1994; N. Greene, PhD thesis, UC
 *             Santa Cruz, 1995, 5.4 ("the thesis").
 * Notation    cell -> node of the quadtree; polygon -> struct hsr_shape; z -> q
 *             = 1/t or -t, greater is nearer; znear, zfar -> near, far
 * Order       polygons come by cubes, from front to back, or in strict order:
 *             each before all that it may hide (strict.h)
 * Invariants  the lists of a cell's leaves hold every polygon of which anything
 *             is visible in the cell, of those inserted. Nothing visible in a
 *             cell is farther than its `far`. `far` grows only. The interval of
 *             a pixel holds its value, and never becomes wider. */
#ifndef HSR_ALGORITHMS_BOUNDED_H
#define HSR_ALGORITHMS_BOUNDED_H

#include "algorithms/algorithm.h"
#include "algorithms/hierarchical/bounded/queue.h"
#include "algorithms/hierarchical/bounded/shape.h"
#include "algorithms/hierarchical/bounded/surface.h"
#include "common/exact/pair.h"

#ifdef __cplusplus
extern "C" {
#endif

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
  HSR_BOUNDED_CAPACITY =
      10,                /* polygons on a leaf's list, unless it is too small to
                           be divided by the tiling pass */
  HSR_BOUNDED_TILING = 3 /* the tiling pass divides to 2^-3 pixels */
};

#define HSR_BOUNDED_NONE UINT32_MAX

struct hsr_bounded_entry {
  uint32_t shape, next; /* HSR_BOUNDED_NONE: the last */
  bool covers;          /* the polygon covers the cell */
};

/* How a cell lies on the window. What straddles its border is divided. */
enum hsr_bounded_place {
  HSR_BOUNDED_OUTSIDE,
  HSR_BOUNDED_STRADDLES,
  HSR_BOUNDED_INSIDE
};

struct hsr_bounded_cell {
  uint32_t parent, child; /* the first of four; 0: a leaf. The root is its own
                             parent */
  uint32_t first, n;      /* of a leaf: its list */
  int level;              /* the side is 2^level pixels */
  enum hsr_bounded_place place;
  bool done;    /* of a pixel: its interval is narrow enough */
  bool untiled; /* what the tiling pass did not come to may be seen here */
  double x, y;  /* the middle of the square */
  double near, far;
  double lo[3], hi[3]; /* of the integral over the square, a channel each; of a
                          square of more than a pixel, of a pixel of it */
};

/* Whether two polygons lie on one plane, which is found once for most pairs. */
enum { HSR_BOUNDED_PLANES = 1 << 12 };
struct hsr_bounded_planes {
  uint32_t p, r; /* HSR_BOUNDED_NONE: nothing is known */
  bool same;
};

/* Cells and list entries, in blocks that do not move. */
enum { HSR_BOUNDED_BLOCK = 1 << 12 };
struct hsr_bounded_tree {
  const struct hsr_job *job;
  struct hsr_tally *tally;
  struct hsr_pair *pair;
  struct hsr_growing cells, entries, shapes; /* the first two: of blocks */
  uint32_t n_cells, n_entries, free_cells, free_entries;
  struct hsr_growing queue;
  struct hsr_bounded_planes
      *planes;       /* HSR_BOUNDED_PLANES: what was asked last */
  uint32_t in_order; /* polygons from this one on came in strict order, from
                        front to back; HSR_BOUNDED_NONE: none did */
  double until;      /* by hsr_seconds_now; INFINITY: any time */
  bool late;         /* it is past that */
  unsigned asked;
  double background[3];
  struct hsr_shades shades;
  struct hsr_growing surfaces; /* a shape: its own, unless a face has one colour
                                  everywhere */
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

/* Did polygon s come in strict order? Such a polygon hides those that came
 * later, wherever it covers them. A cell that such polygons cover has a `far` of
 * infinity: nothing that comes later is seen in it. */
static inline bool hsr_bounded_in_order(const struct hsr_bounded_tree *t,
                                        uint32_t s) {
  return t->in_order != HSR_BOUNDED_NONE && s >= t->in_order;
}

/* A polygon as a subject, by its face. */
static inline struct hsr_subject
hsr_bounded_face(const struct hsr_bounded_tree *t, uint32_t s) {
  return HSR_FACE(hsr_bounded_shape(t, s)->id);
}

/* All of polygon s in a square has a q between these. */
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

/* A cell as a subject, and the pixels that it lies on. */
struct hsr_subject hsr_bounded_subject(const struct hsr_bounded_cell *cell);
struct hsr_window hsr_bounded_window(const struct hsr_bounded_tree *t,
                                     const struct hsr_bounded_cell *cell);

/* Makes the root, which holds the window. The time ends at `until`. `pair`
 * compares faces of the job's scene; `form` has the shader. HSR_E_NOMEM. */
enum hsr_status hsr_bounded_begin(struct hsr_bounded_tree *tree,
                                  const struct hsr_job *job,
                                  const struct hsr_area_form *form,
                                  double until, struct hsr_pair *pair);

/* Puts a face of the screen's world into the quadtree, from the smallest cell
 * that encloses it on. The plane is filled in. False if memory ran out. */
bool hsr_bounded_add(struct hsr_bounded_tree *tree,
                     const struct hsr_screen *screen, uint32_t f, uint32_t id);

/* The same, of a piece of a face on the plane `own`; `cut` is borrowed. */
bool hsr_bounded_add_piece(struct hsr_bounded_tree *tree,
                           const struct hsr_screen *screen, uint32_t f,
                           uint32_t id, const struct hsr_shape_cut *own,
                           const struct hsr_shape_cut *cut, uint32_t n_cuts);

/* SubdivideQCell: makes four leaves of a leaf. False if memory ran out. */
bool hsr_bounded_split(struct hsr_bounded_tree *tree, uint32_t cell);

/* Finds the covering structures of a leaf's polygons, and removes what is
 * hidden by them. */
void hsr_bounded_settle(struct hsr_bounded_tree *tree, uint32_t cell);

/* What covers a leaf together with polygon s of its list, if anything does:
 * updates `far`, and removes what is hidden. `covers`: s does so alone. */
void hsr_bounded_cover(struct hsr_bounded_tree *tree,
                       struct hsr_bounded_cell *cell,
                       const struct hsr_square *square, uint32_t s,
                       bool covers);

/* Gives back all cells below one, which becomes a leaf without polygons. */
void hsr_bounded_free_below(struct hsr_bounded_tree *tree, uint32_t cell);

/* Is polygon p in front of polygon r all over a square, or at least nowhere
 * behind? Their planes are compared. */
bool hsr_bounded_before(const struct hsr_bounded_tree *tree, uint32_t p,
                        uint32_t r, const struct hsr_square *square);

/* A side of a cube on the screen: its corners, within `margin` pixels, and its
 * depth, which is nowhere less than the truth. */
struct hsr_bounded_side {
  double x[4], y[4], margin;
  double a, b, c, nearest; /* the lesser of a sx + b sy + c and nearest */
};

/* CouldCubeFaceBeVisible: false if it is hidden all over. No more than `most`
 * cells are visited. True if memory or time ran out, too. */
bool hsr_bounded_could_be_seen(struct hsr_bounded_tree *tree,
                               const struct hsr_bounded_side *side,
                               uint64_t most, struct hsr_subject cube);

/* Has the time ended? Then what follows is told of what is not tiled any more,
 * and cells are bounded with little work. */
bool hsr_bounded_is_late(struct hsr_bounded_tree *tree);

/* Behind the front faces of a cube, or anywhere, there may be polygons that are
 * not tiled. False if memory ran out. */
bool hsr_bounded_leave(struct hsr_bounded_tree *tree,
                       const struct hsr_bounded_side *side);
void hsr_bounded_leave_all(struct hsr_bounded_tree *tree);

/* The least and the greatest colours of polygon s over a cell. */
void hsr_bounded_shade(const struct hsr_bounded_tree *tree,
                       const struct hsr_bounded_cell *cell, uint32_t s,
                       double low[3], double high[3]);

/* All that may be seen in a leaf: the least and the greatest of its polygons'
 * colours, a channel each; any colour, where it is not known. */
void hsr_bounded_hull(const struct hsr_bounded_tree *tree,
                      const struct hsr_bounded_cell *cell, double low[3],
                      double high[3]);

/* Bounds on the mean of the colours over a leaf, or if it is of more than a
 * pixel, over each of its pixels. Up to `most` polygons are integrated in
 * closed form. */
void hsr_bounded_mean(const struct hsr_bounded_tree *tree,
                      const struct hsr_bounded_cell *cell, uint32_t most,
                      double lo[3], double hi[3]);

/* The refinement pass. Writes the intervals of all pixels of the tree's window,
 * or for a wider filter of limits->window. HSR_E_NOMEM. */
struct hsr_bounded_limits {
  enum hsr_bounded_order order;
  struct hsr_area_form
      form; /* a pixel's interval need not be narrower than eps */
  struct hsr_window window; /* the pixels that are asked for */
  int deepest;    /* cells have a side of at least 2^-deepest pixels, at most
                     HSR_BOUNDED_DEEPEST */
  uint32_t cells; /* no more cells at a time */
  uint32_t exact; /* polygons of a cell that are integrated in closed form */
};
enum hsr_status hsr_bounded_refine(struct hsr_bounded_tree *tree,
                                   const struct hsr_bounded_limits *limits,
                                   struct hsr_error *err);

/* How many pixels to either side of a point's own the filter reaches. */
int hsr_bounded_reach(enum hsr_area_filter filter);

#ifdef __cplusplus
}
#endif
#endif
