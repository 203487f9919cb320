/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Newell, Newell and Sancha's priority computer: faces, divided where they must
 * be, in an order in which none obscures a later one. What it is used for is
 * the affair of others: to paint in that order, as Newell does, or to compare
 * numbers instead of depths.
 *
 * Source      M. E. Newell, R. G. Newell, T. L. Sancha, "A solution to the
 *             hidden surface problem", Proc. ACM Annual Conference, 1972; as
 *             described by Sutherland et al. 1974, "List-Priority Algorithms",
 *             figures 21 and 22.
 * Notation    the list -> pieces linked by `next`, farthest first; P -> the
 *             candidate, at the head of the list; Q -> a piece that P may
 *             obscure; {Q} -> those after P up to the first that lies wholly
 *             before P in depth
 * Invariants  the pieces that bear no marker are in the list by the bucket of
 *             their farthest depth, farthest first;
 *             a piece leaves the list when no piece still in it may be obscured
 *             by it
 * Ties        faces of one plane: the lower id obscures the higher
 * Departures  depth is that along the line of sight, which is the same for all
 *             pieces on a ray. A piece is its face and exact cuts; its outline
 *             serves the tests only (common/exact/order.h). Where one face touches
 *             another within the thickness of faces that are not quite flat,
 *             their order is left to the samples where they meet: such faces
 *             are said to be thick.
 * Cost        Z sort 2 F_r, Newell special F_r^2 (f + f^2 + 100 f^3), f = 2
 *             H_f / n */
#ifndef HSR_ALGORITHMS_PRIORITY_LIST_H
#define HSR_ALGORITHMS_PRIORITY_LIST_H

#include "algorithms/algorithm.h"
#include "common/exact/order.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Faces in the order in which they left the last frame's list. */
struct hsr_previous {
  uint32_t n, n_faces, order[];
};

/* The faces of a window. */
struct hsr_priority_list {
  const struct hsr_job *job;
  struct hsr_tally *tally;
  const struct hsr_screen *screen;
  const struct hsr_window *window;
  bool parts; /* faces reach beyond the window: the depths of their samples in
                 it are asked for */
  bool out_of_memory;

  bool *thick;  /* a face: among two of these, the samples decide */
  int *columns; /* room for the spans of the largest face, twice */
  uint32_t most_corners;

  struct hsr_growing pieces;
  uint32_t head;
  uint32_t attempt; /* begins anew when what the markers say has changed */
  double buckets_per_q;
  uint32_t *order, *other; /* the Z sort's */

  struct hsr_previous *previous; /* NULL: every frame starts anew */
  uint32_t *piece_of;            /* for it: a face's piece */

  unsigned char *halves; /* outlines and cuts of the list's divided pieces */
  size_t halves_used, halves_room;
  double (*scratch)[3];
  uint32_t scratch_room;
};

/* Compiled twice, as the algorithms are. */
#define hsr_list_reserve HSR_OF_BUILD(hsr_list_reserve)
#define hsr_list_sort HSR_OF_BUILD(hsr_list_sort)
#define hsr_list_next HSR_OF_BUILD(hsr_list_next)

/* Memory from job->scratch, for lists of no more than most_faces faces; it
 * grows where faces are divided, and then serves the next list. With a previous
 * order, which may be NULL, there is one list a frame. HSR_E_NOMEM. */
enum hsr_status hsr_list_reserve(struct hsr_priority_list *list,
                                 const struct hsr_job *job,
                                 const struct hsr_screen *screen,
                                 struct hsr_previous *previous,
                                 size_t most_faces);

/* The Z sort of n faces in a window, which lies within the view's: a new list.
 */
void hsr_list_sort(struct hsr_priority_list *list,
                   const struct hsr_window *window, const uint32_t *faces,
                   uint32_t n);

/* Takes the next piece out of the list: it obscures none of those that are
 * left, unless both faces are thick. Its samples are those of hsr_piece_spans
 * in its bounds. It is valid until the next call, its cuts until the next list.
 * NULL: that was all, or memory ran out. */
const struct hsr_piece *hsr_list_next(struct hsr_priority_list *list);

/* The counters that it keeps, in their order; an algorithm's own begin at
 * HSR_N_LIST_COUNTERS. Inside another algorithm they begin at `first`, and bear
 * the prefix `of`. */
enum {
  HSR_LIST_Z_SORT,
  HSR_LIST_SPECIAL,
  HSR_LIST_INTERCHANGES,
  HSR_LIST_DIVISIONS,
  HSR_LIST_OVERLAPS,
  HSR_N_LIST_COUNTERS
};
#define HSR_LIST_COUNTERS(of)                                                  \
  {of "Z sort", "pieces put into buckets of depth; comparisons, where the "    \
                "last frame's order is the start"},                            \
      {of "Newell special",                                                    \
       "minimax tests in Z, X and Y, and 100 for each pair that goes on to "   \
       "the tests of planes and of overlap"},                                  \
      {of "interchanges", "pieces moved to the end of the list"},              \
      {of "divisions", "pieces divided by the plane of another"}, {            \
    of "overlap tests", "pairs tested for overlap on the screen"               \
  }

/* The same for the arrays of steps and sorts. */
#define HSR_LIST_STEPS(first, of)                                              \
  {of "Z sort", first + HSR_LIST_Z_SORT, 1, "2 F_r", hsr_predict_list_z_sort}, \
  {                                                                            \
    of "Newell special", first + HSR_LIST_SPECIAL, 1,                          \
        "F_r^2 (f + f^2 + 100 f^3), f = 2 H_f / n", hsr_predict_list_special   \
  }
#define HSR_LIST_SORTS                                                         \
  {"faces", "Z", "radix sort of the farthest vertex", "once a frame"}, {       \
    "faces", "XYZ", "Newell special", "once a frame"                           \
  }

static inline double hsr_predict_list_z_sort(const struct hsr_table1 *t) {
  return 2 * t->F_r;
}
static inline double hsr_predict_list_special(const struct hsr_table1 *t) {
  double f = 2 * t->H_f / t->n;
  return t->F_r * t->F_r * (f + f * f + 100 * f * f * f);
}

#ifdef __cplusplus
}
#endif
#endif
