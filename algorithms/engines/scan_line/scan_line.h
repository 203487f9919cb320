/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the scan-line algorithms share: the Y bucket sort of edges and the X
 * sort list.
 *
 * Source      Sutherland et al. 1974, "Scan-line Algorithms": the first two of
 *             their four basic steps, as Bouknight and Watkins take them.
 * Notation    scan line -> row j; Y bucket -> in_bucket[bucket[j] .. bucket[j +
 *             1]), j from the window's first row; X sort list -> list[];
 *             X intercept -> column, that of the first sample to the right
 * Invariant   after hsr_scan_advance(scan, j), list[] holds the edges that
 *             cross row j, in ascending columns. The edges of each face pair
 *             up, first with second: they are the ends of its segments
 * Ties        edges of one column are in any order: no sample is between them
 * Departures  the crossing of an edge is found from its line anew on every row,
 *             not by adding increments, whose roundings add up; X is kept as a
 *             column, since the picture is one of samples; a face that is
 *             divided, or cut by the near plane, gives its columns row by row
 *             (hsr_piece_spans), where the paper clips it
 * Cost        Y sort E_r, X merge E_r S_l / 2, X sort n (S_l + 10 X_r / (n
 *             S_l)) */
#ifndef HSR_ALGORITHMS_SCAN_LINE_H
#define HSR_ALGORITHMS_SCAN_LINE_H

#include "algorithms/algorithm.h"
#include "common/exact/screen.h"

#include <limits.h>
#include <math.h>

#ifdef __cplusplus
extern "C" {
#endif

/* An edge that crosses the rows from `row`, that of its bucket, to end_row. An
 * edge of a cut face, or of a piece of a face, stands for an end of one of its
 * segments, a different one on each row if need be. */
struct hsr_scan_edge {
  struct hsr_edge line;
  uint32_t face;
  uint32_t piece; /* edges of one number pair up; without pieces: the face */
  uint32_t cut;   /* the hsr_scan_cut that it stands for; HSR_NOT_CUT */
  int row, end_row;
  int column; /* on the current row */
};

/* What predicting knows of an edge: on the rows before `until` it is to the left
 * of `neighbour`. */
struct hsr_scan_known {
  uint32_t neighbour;
  int until;
};

#define HSR_NOT_CUT UINT32_MAX

/* The column of an edge that stands for an end of a cut face, on a row on which
 * the face has fewer ends. */
#define HSR_NO_COLUMN INT_MAX

/* A cut face, or a piece of a face, and the edges that stand for its ends. */
struct hsr_scan_cut {
  struct hsr_piece piece;
  uint32_t first_edge;
  int n_edges;
  int row; /* for which its columns have been found */
};

/* Ways of keeping the X sort list that the survey proposes; x_list.c. None is
 * standard. */
struct hsr_scan_ways {
  bool tree;    /* as a tree, into which edges are merged */
  bool presort; /* edges are presorted by X */
  bool
      crossings; /* neighbours are compared only from the row on on which they may
                     have crossed */
};

/* What these count besides. */
extern const struct hsr_part hsr_x_list_part;
enum { HSR_X_PRESORT = HSR_FIRST_OF(HSR_PART_X_LIST), HSR_X_CROSSINGS };

struct hsr_x_node {
  uint32_t edge, left, right;
};

/* How much memory is needed, in the window that needs most. */
struct hsr_scan_room {
  size_t edges, cut, columns;
};

/* One window: the view's, or one of several windows of a frame in turn. */
struct hsr_scan {
  const struct hsr_job *job;
  struct hsr_tally *tally;
  const struct hsr_window *window;
  struct hsr_screen screen;

  int *vertex_row; /* hsr_vertex_rows of the screen */
  struct hsr_scan_edge *edge;
  uint32_t n_edges, most_edges; /* there is room for most_edges */
  uint32_t *bucket;    /* a row of the window: its first place in in_bucket[] */
  uint32_t *in_bucket; /* the edges, one bucket behind the other */
  struct hsr_scan_cut *cut;
  uint32_t n_cut;
  int *columns; /* room for the spans of the largest cut face */

  uint32_t *list, n_list;         /* X sort list */
  uint32_t *entering, n_entering; /* edges of the row's bucket, sorted */
  int *entering_column;           /* their columns */

  struct hsr_scan_ways ways;
  struct hsr_x_node *node; /* the tree */
  uint32_t root, *in_order;
  uint32_t *x_bucket, *by_x;    /* if edges are presorted */
  struct hsr_scan_known *known; /* of an edge; if crossings are predicted */
};

/* Screen coordinates, memory from job->scratch, and the Y sort of all relevant
 * faces. HSR_E_NOMEM. */
enum hsr_status hsr_scan_begin(struct hsr_scan *scan,
                               const struct hsr_job *job);

/* The same in parts, for one window after another, and for pieces of faces.
 * The screen's arrays are shared. HSR_E_NOMEM. */
enum hsr_status hsr_scan_reserve(struct hsr_scan *scan,
                                 const struct hsr_job *job,
                                 const struct hsr_screen *screen,
                                 struct hsr_scan_room room);

/* Room for all relevant faces. */
struct hsr_scan_room hsr_scan_whole_room(const struct hsr_screen *screen);

/* Makes room for one more piece. */
void hsr_scan_make_room(struct hsr_scan_room *room,
                        const struct hsr_screen *screen,
                        const struct hsr_piece *piece);

/* The Y sort of n faces in a window, which lies within the view's. It is to be
 * closed. */
void hsr_scan_sort(struct hsr_scan *scan, const struct hsr_window *window,
                   const uint32_t *faces, uint32_t n);

/* The same in parts: a window without edges, to which pieces are added one
 * after another, scan->edge[].piece being `number`. */
void hsr_scan_open(struct hsr_scan *scan, const struct hsr_window *window);
void hsr_scan_add(struct hsr_scan *scan, const struct hsr_piece *piece,
                  uint32_t number);

/* Ends the Y sort, all edges being added: makes the buckets. */
void hsr_scan_close(struct hsr_scan *scan);

/* Brings the X sort list to row j. Called for each row of the window, from the
 * first. */
void hsr_scan_advance(struct hsr_scan *scan, int j);

/* Where two faces penetrate on row j: the first of the samples [left, right)
 * at which the order of their planes is not that of the sample `left`. At the
 * last one it is not. f_first: f is nearer at `left`. 1/t is linear along the
 * row, so there is one such place. Each comparison of depths is a step of
 * `counter`, with f and g as subjects; outcome 1: f is nearer. */
int hsr_scan_crossing(const struct hsr_scan *scan, uint32_t f, uint32_t g,
                      bool f_first, int left, int right, int j, int counter);

/* --- Ways of keeping the X sort list -------------------------------------- */

/* Chooses ways, after hsr_scan_reserve. Memory from job->scratch. HSR_E_NOMEM.
 */
enum hsr_status hsr_scan_choose(struct hsr_scan *scan,
                                struct hsr_scan_ways ways);

/* What scan_line.c takes from x_list.c, and that from it.
 * hsr_scan_fill_buckets: makes the Y buckets of all edges, in a given order;
 * NULL: the last edge first. hsr_scan_presort: sorts the edges of every Y bucket
 * by their columns on its row. hsr_scan_column: finds an edge's column on row j.
 * hsr_x_tree_retire: deletes edges that end above row j. hsr_x_tree_merge: merges
 * entering[] into the tree and makes list[] of it. hsr_x_tree_store: brings a
 * sorted list[] back into the tree. hsr_scan_predict: finds up to which row edge
 * a stays to the left of b. */
void hsr_scan_fill_buckets(struct hsr_scan *scan, const uint32_t *order);
void hsr_scan_presort(struct hsr_scan *scan);
void hsr_scan_column(struct hsr_scan *scan, struct hsr_scan_edge *edge, int j);
void hsr_x_tree_retire(struct hsr_scan *scan, int j);
void hsr_x_tree_merge(struct hsr_scan *scan, int j);
void hsr_x_tree_store(struct hsr_scan *scan);
void hsr_scan_predict(struct hsr_scan *scan, uint32_t a, uint32_t b, int j);

/* --- Counters ------------------------------------------------------------- */

/* An edge as the subject of a step. An edge that stands for an end of a cut
 * face, or of a piece of a face, has no vertices. */
static inline struct hsr_subject
hsr_scan_subject(const struct hsr_scan_edge *edge) {
  return edge->cut == HSR_NOT_CUT
             ? HSR_EDGE(edge->line.a, edge->line.b, edge->face)
             : HSR_EDGE(HSR_NO_ID, HSR_NO_ID, edge->face);
}

/* A step on row j with two edges. */
static inline void hsr_scan_step(const struct hsr_scan *s, int counter,
                                 const struct hsr_scan_edge *a,
                                 const struct hsr_scan_edge *b, int outcome,
                                 int j) {
  HSR_STEP(s->tally, counter, hsr_scan_subject(a), hsr_scan_subject(b),
           HSR_ON(s->window->x0, s->window->x1, j), outcome);
}

/* What these count. What follows their lines in an outline is done on each scan
 * line. An interchange costs as much as ten comparisons. */
extern const struct hsr_part hsr_scan_part;
enum {
  HSR_Y_SORT = HSR_FIRST_OF(HSR_PART_SCAN_LINE),
  HSR_X_MERGE,
  HSR_X_SORT,
  HSR_X_INTERCHANGES
};

/* --- Predictions ---------------------------------------------------------- */

/* Steps for which Table III has one formula, "Watkins, Bouknight". */
static inline double hsr_predict_span_cull(const struct hsr_table1 *t) {
  return t->n * t->S_l;
}
static inline double hsr_predict_depth_search(const struct hsr_table1 *t) {
  return 30 * t->n * t->D_c * fmin(t->m, 2 * t->S_v);
}

#ifdef __cplusplus
}
#endif
#endif
