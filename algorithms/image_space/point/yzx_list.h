/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The Z sort of yzx: the priority list of the faces that are active on a scan
 * line. It is kept from line to line. A face that enters finds its place in it
 * before anything is sorted by X. See yzx.c for the source and the whole.
 *
 * Notation    order[] -> the list, the farthest first; piece -> a face, or what
 *             planes have left of it; relation -> of two active pieces, that one
 *             is to stand before the other: later
 * Tests       Newell's 2 and 3, whether the bounds overlap in X and in Y; then
 *             his 1, by the extents in depth; then 4 and 5, the vertices of one
 *             against the plane of the other; at last 6, whether they have a
 *             sample in common on the rows to come. If both orders would do
 *             there is no relation.
 * Place       Let lo be the last of the pieces that are to stand before the new
 *             one, and hi the first of those that are to stand behind it. If lo
 *             is before hi, it is put behind lo. Else hi, and whatever relations
 *             put behind hi, is moved behind lo: Newell's interchange. If lo is
 *             among these, the order is cyclic.
 * Division    If no test tells the order of two, the one that ends sooner is
 *             divided by the plane of the other. A cyclic overlap is resolved
 *             by a plane of one of its pieces that passes through another. The
 *             halves enter like faces.
 * Invariant   a piece stands before another in order[] if a relation says so.
 *             Of two that have a sample in common on the row or on one to come,
 *             the later one is the nearer one there
 * Departures  those of Newell's tests: in test 6 samples decide, and each row is
 *             counted. Only the rows to come matter, so a pair that overlaps
 *             above alone needs no order */
#ifndef HSR_ALGORITHMS_YZX_LIST_H
#define HSR_ALGORITHMS_YZX_LIST_H

#include "algorithms/engines/scan_line/implied.h"
#include "common/exact/order.h"

/* The counters of yzx. */
enum {
  YZX_FACES,
  YZX_MINIMAX,
  YZX_Z_MINIMAX,
  YZX_Z_SORT,
  YZX_PIECES,
  YZX_ROWS,
  YZX_MOVED,
  YZX_DIVISIONS,
  YZX_CIRCLES,
  YZX_IMPLIED,
  YZX_POINTS,
  YZX_PREDICTED,
  YZX_VERIFIED,
  YZX_FAILED,
  YZX_SEGMENTS,
  YZX_KEPT,
  YZX_PRIORITY,
  YZX_COMBINED,
  YZX_SPANS
};

struct yzx_piece {
  uint32_t face, n_cuts;
  const struct hsr_cut *cuts;
  struct hsr_polygon polygon;
  struct hsr_bounds bounds;

  uint32_t by;                /* divided by this face's plane; HSR_NO_ID: not */
  struct yzx_piece *whole;    /* of which it is a half; NULL: of none */
  struct yzx_piece *half[2];  /* in front of the plane, and behind it */
  struct hsr_implied implied; /* implied=carried: where it meets that plane */

  bool active;     /* it is in order[] */
  uint32_t place;  /* there */
  uint32_t number; /* its priority on this row: less is nearer */
  uint32_t later;  /* the first of its relations; HSR_NO_ID: it has none */

  uint32_t earlier_than, reached; /* marks of the place that is sought */
  struct yzx_piece *from;         /* then: by whose relation it was reached */
};

/* A piece that is to stand behind another; and the next that is. */
struct yzx_relation {
  struct yzx_piece *piece;
  uint32_t next;
};

/* The extent in depth of a face, as q = 1/t: no sample of it is nearer than
 * `nearest` or farther than `farthest`. */
struct yzx_extent {
  double nearest, farthest;
};

struct yzx_list {
  const struct hsr_job *job;
  const struct hsr_screen *screen;
  struct hsr_tally *tally;
  int j;
  bool out_of_memory;

  uint32_t *bucket, *in_bucket; /* Y buckets of faces, as of struct hsr_scan */
  struct yzx_piece **root;   /* by face: all of it; NULL: it has not entered */
  struct yzx_extent *extent; /* by face */

  struct hsr_growing order;                           /* struct yzx_piece * */
  struct hsr_growing entering;                        /* likewise: a stack */
  struct hsr_growing earlier, later, reached, circle; /* of one that enters */
  struct hsr_growing relations;                       /* struct yzx_relation */
  struct yzx_piece *unused;                           /* pieces to be made */
  uint32_t n_unused;
  uint32_t mark;
  int *columns, *other_columns;
  double (*scratch)[3];
  uint32_t scratch_room;
};

/* Begins a frame; puts the relevant faces into Y buckets. All is borrowed;
 * memory is taken from job->scratch. HSR_E_NOMEM. */
enum hsr_status yzx_list_begin(struct yzx_list *list, const struct hsr_job *job,
                               const struct hsr_screen *screen);

/* Brings the list to row j, for each row in turn: deletes the pieces that have
 * ended, and enters the faces that begin. Sets list->out_of_memory if memory
 * runs out. */
void yzx_list_advance(struct yzx_list *list, int j);

#endif
