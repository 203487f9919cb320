/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Newell, Newell and Sancha's priority computer. It puts faces, divided where
 * they must be, in an order in which none obscures a later one. An algorithm
 * may paint in that order, as Newell's does, or compare the places in it
 * instead of depths.
 *
 * Source      M. E. Newell, R. G. Newell, T. L. Sancha, "A solution to the
 *             hidden surface problem", Proc. ACM Annual Conference, 1972; as
 *             described by Sutherland et al. 1974, "List-Priority Algorithms",
 *             figures 21 and 22.
 * Notation    the list -> pieces linked by `next`, farthest first; P -> the
 *             candidate, at the head of the list; Q -> a piece that P may
 *             obscure; {Q} -> those after P up to the first that lies wholly
 *             before P in depth; marker -> the last attempt in which the piece
 *             was moved
 * Invariants  The pieces without a marker are in the list by the bucket of
 *             their farthest depth, farthest first. A piece leaves the list
 *             when it may obscure no piece that is still there.
 * Ties        faces of one plane: the lower id obscures the higher
 * Departures  Depth is that along the line of sight, which is the same for all
 *             pieces on a ray. A piece is its face and exact cuts; its outline
 *             serves the tests only (common/exact/order.h). Where one face
 *             touches another within the thickness of faces that are not quite
 *             flat, the samples where they meet decide; such faces are called
 *             thick. P or Q is divided by the plane of the other only if that
 *             passes through it. If neither plane does, the pieces with the
 *             attempt's marker form a circle: all pairs of them are searched
 *             for a piece and a plane that passes through it. The paper has no
 *             such search; it is counted as a step of its own. A divided
 *             piece's halves are put back where they belong by a walk along the
 *             list, which is counted too.
 * Cost        Z sort 2 F_r, Newell special F_r^2 (f + f^2 + 100 f^3), f = 2
 *             H_f / n: its terms are the pairs that come to the tests in Z, in
 *             X and Y, and of planes */
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

/* Other ways of finding the pieces that P may obscure: priority_index.c. */
struct hsr_list_group {
  struct hsr_bounds bounds;
  double farthest;
  uint32_t bucket; /* of that */
};
struct hsr_list_index {
  bool by_groups;          /* or by cells */
  int sort, groups, again; /* counters */

  struct hsr_growing links;
  uint32_t *chain, n_chains; /* by group, or by cell: its first link */
  uint32_t candidate;        /* number of the attempt to find a piece */

  struct hsr_list_group *group;
  uint32_t *order, n_groups, first_group; /* groups, farthest first */

  int width, height, columns; /* of cells: their size in samples, how many */
};

/* The spans of P on the rows where test 6 asked for them: they serve all of {Q}. */
struct hsr_list_spans {
  uint32_t piece;  /* P, or HSR_NO_PIECE */
  uint32_t number; /* of this P among all */
  struct hsr_face_rows rows;
  struct hsr_list_row {
    uint32_t number; /* of the P of which this is */
    int n;
    size_t first; /* of its columns */
  } * row;        /* by row of the window */
  struct hsr_growing columns;
};

/* The faces of a window. */
struct hsr_priority_list {
  const struct hsr_job *job;
  struct hsr_tally *tally;
  const struct hsr_screen *screen;
  const struct hsr_window *window;
  bool parts; /* faces reach beyond the window: depths are those of their
                 samples in the window */
  bool out_of_memory;

  bool *thick;  /* by face: between two of these, the samples decide */
  int *columns; /* room for the spans of the largest face */
  uint32_t most_corners;
  struct hsr_list_spans spans;

  struct hsr_growing pieces;
  uint32_t head;
  uint32_t attempt; /* a new one begins when a piece is divided or leaves */
  double buckets_per_q;
  uint32_t *order, *other; /* of the Z sort */

  struct hsr_list_index *index; /* NULL: the list itself is searched */

  struct hsr_previous *previous; /* NULL: every frame starts anew */
  uint32_t *piece_of;            /* by face, for `previous`: its piece */

  unsigned char *halves; /* outlines and cuts of the list's divided pieces */
  size_t halves_used, halves_room;
  double (*scratch)[3];
  uint32_t scratch_room;
};

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

/* What the list counts. */
extern const struct hsr_part hsr_list_part;
enum {
  HSR_LIST_Z_SORT = HSR_FIRST_OF(HSR_PART_PRIORITY_LIST),
  HSR_LIST_SPECIAL,
  HSR_LIST_MINIMAX,
  HSR_LIST_PLANES,
  HSR_LIST_OVERLAPS,
  HSR_LIST_INTERCHANGES,
  HSR_LIST_DIVISIONS,
  HSR_LIST_INSERTIONS,
  HSR_LIST_CIRCLES
};

/* The outcomes of the special sort: which of the six tests decided that P does
 * not obscure Q, or that none did. */
enum hsr_special {
  HSR_BEYOND_Q_ENDS, /* Q and all later pieces are wholly before P: {Q} ends */
  HSR_APART_IN_Z,
  HSR_APART_IN_X,
  HSR_APART_IN_Y,
  HSR_P_BEYOND_Q,   /* of the plane of Q */
  HSR_Q_BEFORE_P,   /* of the plane of P */
  HSR_NO_OVERLAP,   /* on the screen */
  HSR_TO_SAMPLES,   /* of thick faces: the samples decide */
  HSR_P_MAY_OBSCURE /* no test decided */
};

#ifdef __cplusplus
}
#endif
#endif
