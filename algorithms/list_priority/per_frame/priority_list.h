/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The priority computer of Newell, Newell and Sancha. It puts faces, divided
 * where they must be, into an order in which none obscures a later one. An
 * algorithm may paint in that order, as Newell's does. Or it may compare places
 * in the order instead of depths.
 *
 * Source      M. E. Newell, R. G. Newell, T. L. Sancha, "A solution to the
 *             hidden surface problem", Proc. ACM Annual Conference, 1972; as
 *             described by Sutherland et al. 1974, "List-Priority Algorithms",
 *             figures 21 and 22.
 * Notation    The list: pieces linked by `next`, farthest first. P: the
 *             candidate, which is at the head of the list. Q: a piece that P
 *             may obscure. {Q}: the pieces after P, up to the first that lies
 *             wholly before P in depth. Marker: the last attempt in which the
 *             piece was moved.
 * Invariants  The pieces without a marker are in the list by the bucket of
 *             their farthest depth, farthest first, unless the last frame says
 *             otherwise (kept_order.h). Of each, `rest` is the farthest bucket
 *             from it on. A piece leaves the list when it may obscure no piece that
 *             is still there.
 * Ties        faces of one plane: the lower id obscures the higher
 * Departures  - Depth is that along the line of sight, which is the same
 *             measure for all pieces on a ray.
 *             - A piece is its face and exact cuts; its approximate outline
 *             serves the tests only (common/exact/order.h).
 *             - A face that is not flat is thick. Where two thick faces touch
 *             each other within their thickness, the samples where they meet
 *             decide.
 *             - Test 6 is one of samples. An edge that separates both faces
 *             tells that they are apart. Where there is none, their samples are
 *             compared row by row, and each row is counted. So two faces that
 *             overlap between samples are apart, and which faces are divided
 *             depends on the size of the picture. The paper calls the test
 *             "particularly troublesome", and gives none.
 *             - P or Q is divided by the plane of the other only if that passes
 *             through it. If neither plane does, the pieces with the attempt's
 *             marker form a circle: all pairs of them are searched for a piece
 *             and a plane that passes through it. The paper has no such search;
 *             it is counted as a step of its own.
 *             - The halves of a divided piece are inserted where they belong.
 *             To find that place, the list is searched; that is counted, too.
 * Cost        Z sort 2 F_r, Newell special F_r^2 (f + f^2 + 100 f^3), f = 2
 *             H_f / n: its terms are the pairs that come to test 2, to test 3,
 *             and to tests 4 to 6. Test 1, in Z, is for the paper implied in
 *             the selection of Q; here it is made, and costs 1 as well */
#ifndef HSR_ALGORITHMS_PRIORITY_LIST_H
#define HSR_ALGORITHMS_PRIORITY_LIST_H

#include "algorithms/algorithm.h"
#include "common/exact/order.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_keeper; /* kept_order.h */

/* Other ways of finding the pieces that P may obscure (priority_index.c): by
 * groups of pieces in depth, or by cells of the screen. */
struct hsr_list_group {
  struct hsr_bounds bounds;
  double farthest; /* depth of its farthest piece */
  uint32_t bucket; /* of that depth */
};
struct hsr_list_index {
  bool by_groups;          /* else by cells */
  int sort, groups, again; /* counters */

  struct hsr_growing links;  /* a link for each piece in a group or cell */
  uint32_t *chain, n_chains; /* by group or cell: its first link */
  uint32_t candidate;        /* the number of the present search for a Q */

  struct hsr_list_group *group;
  uint32_t *order, n_groups, first_group; /* the groups, farthest first */

  /* Cells: their size in samples; how many there are in a row. */
  int width, height, columns;
};

/* The spans of P on those rows for which test 6 has asked. They are kept for
 * all of {Q}. */
struct hsr_list_spans {
  uint32_t piece;  /* P, or HSR_NO_PIECE */
  uint32_t number; /* how many P there have been */
  struct hsr_face_rows rows;
  struct hsr_list_row {
    uint32_t number;          /* of the P to which this belongs */
    int n;                    /* columns, */
    size_t first;             /* from here on in columns[] */
  } * row;                    /* by row of the window */
  struct hsr_growing columns; /* int */
};

/* The list of the faces of one window. */
struct hsr_priority_list {
  const struct hsr_job *job;       /* borrowed */
  struct hsr_tally *tally;         /* the job's */
  const struct hsr_screen *screen; /* borrowed */
  const struct hsr_window *window; /* borrowed */
  /* Faces reach beyond the window; then the depths of a face are those at its
   * samples in the window. */
  bool parts;
  bool out_of_memory;
  bool under_way; /* the list has not been found to be empty */

  bool *thick;  /* by face: between two thick faces the samples may decide */
  int *columns; /* room for the spans of the largest face */
  uint32_t most_corners;
  struct hsr_list_spans spans;

  struct hsr_growing pieces; /* struct hsr_list_piece */
  uint32_t head;             /* P, or HSR_NO_PIECE */
  /* The number of the attempt. A new one begins when a piece is divided or
   * leaves. */
  uint32_t attempt;
  double buckets_per_q;
  uint32_t *order, *other, room; /* room for the Z sort */

  struct hsr_list_index *index; /* NULL: the list itself is searched */

  struct hsr_keeper *keeper; /* NULL: every frame starts anew */
  uint32_t n_faces;          /* of this list */

  unsigned char *halves; /* memory for outlines and cuts of divided pieces */
  size_t halves_used, halves_room;
  double (*scratch)[3];
  uint32_t scratch_room;
};

/* Begins a frame whose lists have no more than most_faces faces. Memory from
 * job->scratch; it grows if faces are divided, and serves the next list, too.
 * `keeper` has the last frame's orders, and gets this frame's; its frame has
 * begun (kept_order.h). NULL: every frame starts anew. HSR_E_NOMEM. */
enum hsr_status hsr_list_reserve(struct hsr_priority_list *list,
                                 const struct hsr_job *job,
                                 const struct hsr_screen *screen,
                                 struct hsr_keeper *keeper, size_t most_faces);

/* Makes a new list: the Z sort of n faces in a window, which lies within the
 * view's and is borrowed as long as the list. */
void hsr_list_sort(struct hsr_priority_list *list,
                   const struct hsr_window *window, const uint32_t *faces,
                   uint32_t n);

/* Takes the next piece out of the list. It obscures none of those that are
 * left, unless both faces are thick. Its samples are those of hsr_piece_spans
 * within its bounds. It is valid until the next call, its cuts until the next
 * list. NULL: the list is empty, or list->out_of_memory. */
const struct hsr_piece *hsr_list_next(struct hsr_priority_list *list);

/* The part and its counters; priority_list.c has their meanings. */
extern const struct hsr_part hsr_list_part;
enum {
  HSR_LIST_Z_SORT = HSR_FIRST_OF(HSR_PART_PRIORITY_LIST),
  HSR_LIST_SPECIAL,
  HSR_LIST_MINIMAX,
  HSR_LIST_PLANES,
  HSR_LIST_OVERLAPS,
  HSR_LIST_OVERLAP_ROWS,
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
  HSR_P_BEYOND_Q,    /* of the plane of Q */
  HSR_Q_BEFORE_P,    /* of the plane of P */
  HSR_NO_OVERLAP,    /* on the screen */
  HSR_TO_SAMPLES,    /* of thick faces: the samples decide */
  HSR_P_MAY_OBSCURE, /* no test decided */
  HSR_HELD           /* known from the last frame: kept_order.h */
};

#ifdef __cplusplus
}
#endif
#endif
