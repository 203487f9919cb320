/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pieces of the priority list. For priority_list.c and priority_index.c
 * only; see priority_list.h. */
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
  uint32_t rest; /* the least bucket of its own and of those that follow it
                    without a marker */
  /* The last attempt in which it was moved; 0: it never was, and is where the
   * Z sort put it. */
  uint32_t marker;
  bool forced;   /* no order was found for it: the samples decide */
  bool gone;     /* it has left the list */
  uint32_t seen; /* the last search that has met it: priority_index.c */
  /* With a keeper: its place in the last frame's order, and in this one's;
   * HSR_NO_PIECE: it has none. */
  uint32_t kept, left;
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

/* hsr_index_sort: indexes the pieces of a new list. hsr_index_add: adds a half
 * of a divided piece. hsr_index_find: a piece that p, the candidate, may
 * obscure, or HSR_NO_PIECE; `bucket` is that of the nearest depth of p.
 * Of priority_list.c, hsr_list_may_obscure: the six tests; hsr_list_add: adds a
 * piece, whose polygon and cuts are given, if it has samples, and returns its
 * number or HSR_NO_PIECE. They set list->out_of_memory if memory runs out. */
void hsr_index_sort(struct hsr_priority_list *list);
void hsr_index_add(struct hsr_priority_list *list, uint32_t p);
uint32_t hsr_index_find(struct hsr_priority_list *list, uint32_t p,
                        uint32_t bucket);
uint32_t hsr_list_add(struct hsr_priority_list *list,
                      struct hsr_list_piece piece);
bool hsr_list_may_obscure(struct hsr_priority_list *list, uint32_t p,
                          uint32_t q);

#endif
