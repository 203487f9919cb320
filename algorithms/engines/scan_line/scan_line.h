/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the scan-line algorithms share: the Y bucket sort of edges and the X
 * sort list.
 *
 * Source      Sutherland et al. 1974, "Scan-line Algorithms": the first two of
 *             their four basic steps, as Bouknight and Watkins take them.
 * Notation    scan line -> row j. Y bucket of a row -> in_bucket[bucket[k]] to
 *             in_bucket[bucket[k + 1] - 1], k being the row counted from the
 *             window's first. X sort list -> list[]. X intercept -> column,
 *             that of the first sample to the right of the edge or on it.
 * Invariant   After hsr_scan_advance(scan, j), list[] holds the edges that
 *             cross row j, in ascending columns. The edges of one piece pair
 *             up, first with second, third with fourth: they are the ends of
 *             its segments.
 * Ties        Edges of one column are in any order: no sample is between them.
 * Departures  - The column of an edge is found from its line anew on every row,
 *             not by adding increments, since their roundings would add up.
 *             - X is kept as a column, since the picture is one of samples.
 *             - A face that is divided, or cut by the near plane, gives its
 *             columns row by row (hsr_piece_spans). The paper clips it.
 *             It stands in the list by as many edges as it has ends on any row
 *             of the window. On a row where it has fewer, the others are pairs
 *             that enclose nothing; they are sorted and counted like all.
 * Cost        Y sort E_r, X merge E_r S_l / 2, X sort n (S_l + 10 X_r / (n
 *             S_l)). Measured, the merge takes 3.4 times its formula on house,
 *             4.0 on harbor and 2.5 on big-harbor. For the formula takes half a
 *             list of S_l, but a list of edges holds two for each segment, and
 *             S_l leaves out segments between samples, which the list holds.
 *             Probably most edges also enter where the list is long. The sort,
 *             too, goes over all edges of the list. */
#ifndef HSR_ALGORITHMS_SCAN_LINE_H
#define HSR_ALGORITHMS_SCAN_LINE_H

#include "algorithms/algorithm.h"
#include "common/exact/screen.h"

#include <math.h>

#ifdef __cplusplus
extern "C" {
#endif

/* An edge in the Y buckets and the X sort list. It crosses the rows [row,
 * end_row); `row` is that of its bucket. If the face is cut, or the edge is of
 * a piece of a face, it is no edge of the scene: it stands for the k-th end of
 * the piece's segments on each row, whatever side makes that. */
struct hsr_scan_edge {
  struct hsr_edge line;
  uint32_t face;
  uint32_t piece; /* edges of one number pair up; without pieces the face */
  uint32_t cut;   /* the index of its hsr_scan_cut; HSR_NOT_CUT: an edge of the
                     scene, in `line` */
  int row, end_row;
  int column; /* on the current row */
};

/* What has been predicted of an edge: on the rows before `until` it is to the
 * left of edge `neighbour`. */
struct hsr_scan_known {
  uint32_t neighbour;
  int until;
};

#define HSR_NOT_CUT UINT32_MAX

/* A cut face, or a piece of a face, and the edges that stand for its ends. */
struct hsr_scan_cut {
  struct hsr_piece piece;
  uint32_t first_edge;
  int n_edges;
  int row; /* for which its columns have been found */
};

/* Other ways of keeping the X sort list, which the survey proposes (x_list.c).
 * By default none is used. */
struct hsr_scan_ways {
  bool tree;    /* as a tree, into which edges are merged */
  bool presort; /* edges are presorted by X */
  /* Two neighbours are compared again only on the first row on which they may
   * have crossed. */
  bool crossings;
};

/* The part of these ways, and its counters. */
extern const struct hsr_part hsr_x_list_part;
enum { HSR_X_PRESORT = HSR_FIRST_OF(HSR_PART_X_LIST), HSR_X_CROSSINGS };

struct hsr_x_node {
  uint32_t edge, left, right;
};

/* How much room is needed, in the window that needs most: for edges; for cut
 * faces and pieces; for the columns of one of these on a row. */
struct hsr_scan_room {
  size_t edges, cut, columns;
};

/* The scan of one window: the view's, or one window of a frame after
 * another. */
struct hsr_scan {
  const struct hsr_job *job;
  struct hsr_tally *tally;
  const struct hsr_window *window;
  struct hsr_screen screen;

  int *vertex_row; /* by vertex: as of hsr_vertex_rows */
  struct hsr_scan_edge *edge;
  uint32_t n_edges, most_edges; /* there is room for most_edges */
  uint32_t *bucket; /* by row of the window: its first place in in_bucket[] */
  uint32_t *in_bucket; /* the edges, one bucket behind the other */
  struct hsr_scan_cut *cut;
  uint32_t n_cut;
  int *columns; /* room for the spans of the largest cut face */

  uint32_t *list, n_list;         /* X sort list */
  int *list_column;               /* its columns, until it is sorted */
  uint32_t *entering, n_entering; /* edges of the row's bucket, for a tree, or
                                     sorted */

  struct hsr_scan_ways ways;
  struct hsr_x_node *node; /* the tree */
  uint32_t root, *in_order;
  uint32_t *x_bucket, *by_x;    /* if edges are presorted */
  struct hsr_scan_known *known; /* by edge; if crossings are predicted */
};

/* Begins a frame of one window, the view's: transforms and culls the faces, and
 * sorts the edges of the relevant ones by Y. The job is borrowed; memory is
 * taken from job->scratch. HSR_E_NOMEM. */
enum hsr_status hsr_scan_begin(struct hsr_scan *scan,
                               const struct hsr_job *job);

/* The same in steps, for one window after another, or for pieces of faces.
 * First hsr_scan_reserve, once a frame: the arrays of *screen are borrowed;
 * memory is taken from job->scratch. HSR_E_NOMEM. */
enum hsr_status hsr_scan_reserve(struct hsr_scan *scan,
                                 const struct hsr_job *job,
                                 const struct hsr_screen *screen,
                                 struct hsr_scan_room room);

/* The room that all relevant faces need together. */
struct hsr_scan_room hsr_scan_whole_room(const struct hsr_screen *screen);

/* Adds to *room what one more piece needs. */
void hsr_scan_make_room(struct hsr_scan_room *room,
                        const struct hsr_screen *screen,
                        const struct hsr_piece *piece);

/* Then for each window: hsr_scan_sort sorts the edges of n faces by Y, in a
 * window that lies within the view's. hsr_scan_close must follow. */
void hsr_scan_sort(struct hsr_scan *scan, const struct hsr_window *window,
                   const uint32_t *faces, uint32_t n);

/* Or for pieces: hsr_scan_open begins a window without edges; hsr_scan_add adds
 * those of one piece, which get the number `number`. hsr_scan_close must
 * follow. */
void hsr_scan_open(struct hsr_scan *scan, const struct hsr_window *window);
void hsr_scan_add(struct hsr_scan *scan, const struct hsr_piece *piece,
                  uint32_t number);

/* Ends the Y sort, when all edges have been added: makes the buckets. */
void hsr_scan_close(struct hsr_scan *scan);

/* Brings the X sort list to row j. To be called for each row of the window in
 * turn, from the first on. */
void hsr_scan_advance(struct hsr_scan *scan, int j);

/* Where faces f and g penetrate on row j. Their planes have one order at sample
 * `left`, and the opposite one at sample right - 1. Returns the first of the
 * samples [left, right) that has the opposite order; since depth is linear
 * along the row, all after it have it, too. f_first: f is nearer at `left`.
 * Each comparison of depths is a step of `counter`, with subjects f and g;
 * outcome 1: f is nearer. */
int hsr_scan_crossing(const struct hsr_scan *scan, uint32_t f, uint32_t g,
                      bool f_first, int left, int right, int j, int counter);

/* --- Ways of keeping the X sort list -------------------------------------- */

/* Chooses the ways, after hsr_scan_reserve and before any sort. Memory from
 * job->scratch. HSR_E_NOMEM. */
enum hsr_status hsr_scan_choose(struct hsr_scan *scan,
                                struct hsr_scan_ways ways);

/* For scan_line.c and x_list.c alone. hsr_scan_fill_buckets: makes the Y
 * buckets of all edges, in a given order; NULL: the last edge first.
 * hsr_scan_presort: sorts the edges of every Y bucket by their columns on its
 * row. hsr_scan_column: finds an edge's column on row j. hsr_x_tree_retire:
 * deletes edges that end above row j. hsr_x_tree_merge: merges entering[] into
 * the tree and makes list[] of it. hsr_x_tree_store: brings a sorted list[]
 * back into the tree. hsr_scan_predict: finds up to which row edge a stays to
 * the left of b. */
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

/* The part and its counters; scan_line.c has their meanings. Lines that follow
 * its own in an outline are done on each scan line. An interchange costs as
 * much as ten comparisons. */
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
