/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pieces of Newell's list, for priority_list.c and priority_index.c. */
#ifndef HSR_ALGORITHMS_PRIORITY_PIECES_H
#define HSR_ALGORITHMS_PRIORITY_PIECES_H

#include "algorithms/list_priority/per_frame/priority_list.h"

/* No piece. */
#define HSR_NO_PIECE UINT32_MAX

/* What is left of a face after some cuts. */
struct hsr_list_piece {
  struct hsr_piece part;
  struct hsr_polygon polygon;
  uint32_t next, previous;
  double nearest, farthest; /* depths along the line of sight */
  uint32_t bucket;          /* of the farthest; greater is nearer */
  uint32_t marker; /* the last attempt in which it was moved to the end of the
                      list; 0: never, and it is still where it was sorted */
  bool forced;     /* no order was found: the samples decide */
  bool gone;       /* it has left the list */
  uint32_t seen;   /* by the last candidate that met it: see priority_index.c */
};

static inline struct hsr_list_piece *piece_at(const struct hsr_priority_list *s,
                                              uint32_t p) {
  return (struct hsr_list_piece *)s->pieces.items + p;
}

/* A piece as the subject of a step. */
static inline struct hsr_subject subject(const struct hsr_priority_list *s,
                                         uint32_t p) {
  return HSR_PIECE(piece_at(s, p)->part.face, p);
}

/* What priority_list.c takes from priority_index.c, and that from it.
 * hsr_index_sort: sorts a new list's pieces. hsr_index_add: adds a divided
 * piece. hsr_index_find: a piece that P may obscure, or HSR_NO_PIECE; `bucket`
 * is that of P's nearest depth. hsr_list_may_obscure: the six tests. If memory
 * runs out, list->out_of_memory is set. */
void hsr_index_sort(struct hsr_priority_list *list);
void hsr_index_add(struct hsr_priority_list *list, uint32_t p);
uint32_t hsr_index_find(struct hsr_priority_list *list, uint32_t p,
                        uint32_t bucket);
bool hsr_list_may_obscure(struct hsr_priority_list *list, uint32_t p,
                          uint32_t q);

#endif
