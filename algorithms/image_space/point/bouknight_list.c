/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bouknight with depth=list: the active faces of a row are kept in order of
 * depth, and the first of them is visible.
 *
 * Source      Sutherland et al. 1974, chapter IV, "Depth Coherence": the
 *             scan-line algorithms might keep a list of the active polygons,
 *             sorted by depth. One that begins is put where it stood on the scan
 *             line before, third or whatever it was; comparisons with its
 *             neighbors confirm the place, or it is bubbled to the right one.
 * Notation    list -> visible[], the nearest first. Pair: two neighbors in it;
 *             the nearer one stands first. Segment: what an edge of the list
 *             opens; it ends at the next edge of the same face.
 * Pairs       1/t of two planes is linear on a row. So two faces that are in
 *             order at two samples are so in between. When they become
 *             neighbors, they are in order at the sample before, or at the one
 *             where the second of them begins. They are compared once more, at
 *             the last sample of the one that ends first. If that has the
 *             opposite order, the sample where they change places is searched,
 *             and noted: the span that holds it ends there.
 * Invariants  in the span that begins at `left`, visible[] holds the faces that
 *             cover it, in order; and of each pair whose order changes before
 *             one of the two ends, a change is noted
 * Glass       A transparent picture has a list too, in bouknight.c. That one is
 *             sorted at the left limit of every span, and all its pairs are
 *             compared at the right limit, since ends of segments are not known
 *             beforehand. Both lists move faces by the same two functions.
 * Departures  the survey does not say how penetration is found
 * Cost        for a segment up to two comparisons to confirm its place, and two
 *             with its new neighbors; where one ends, one for those that become
 *             neighbors. No span is searched
 * Measured    Comparisons in depth on 500 lines of 500 samples, without the
 *             option and with it:
 *               house        54,938   21,351
 *               harbor      266,692  114,505
 *               big-harbor  421,669  334,707
 *             With span cull and at the survey's prices, harbor costs less than
 *             with watkins: 3.5 million, and there 3.9. The picture needs no
 *             more than the first of the list. But the survey is right that
 *             the others tell a new arrival its place. */
#include "algorithms/image_space/point/bouknight.h"

#include <string.h>

enum { NO_END = -1, NO_SAMPLE = -2 };

/* Two neighbors change places at a column. */
struct change {
  int column;
  uint32_t first, second; /* faces, as they stand up to there */
};

struct bouknight_list {
  uint32_t *opened_by; /* a face: the place in the X list where its segment
                          began, while edges are paired */
  int *end;    /* by place there: NO_END, if it ends a segment; NO_SAMPLE,
                          if it begins one without a sample; else the column
                          where the segment that it begins ends */
  int *end_of; /* an active face: where its segment ends */
  uint32_t *position;    /* a face: in the list, where it entered last */
  struct change *change; /* by descending columns, so that the next is last */
  uint32_t n_changes, room;
};

enum hsr_status bouknight_begin_list(struct bouknight *s) {
  const struct hsr_job *job = s->edges.job;
  struct hsr_arena *arena = job->scratch;
  size_t n_faces = job->world->n_faces;
  struct bouknight_list *list = HSR_NEW_ZEROED(arena, struct bouknight_list, 1);
  if (!list)
    return HSR_E_NOMEM;
  list->room = 64;
  list->opened_by = HSR_NEW(arena, uint32_t, n_faces);
  list->end = HSR_NEW(arena, int, s->edges.most_edges);
  list->end_of = HSR_NEW(arena, int, n_faces);
  list->position = HSR_NEW_ZEROED(arena, uint32_t, n_faces);
  list->change = HSR_NEW(arena, struct change, list->room);
  if (!list->opened_by || !list->end || !list->end_of || !list->position ||
      !list->change)
    return HSR_E_NOMEM;
  for (size_t f = 0; f < n_faces; f++)
    list->opened_by[f] = BOUKNIGHT_NONE;
  s->list = list;
  return HSR_OK;
}

/* --- Segments ------------------------------------------------------------- */

/* The column of edge k of the list, within the window. */
static int column_of(const struct bouknight *s, uint32_t k) {
  const struct hsr_window *w = s->edges.window;
  int column = s->edges.edge[s->edges.list[k]].column;
  return column < w->x0 ? w->x0 : column > w->x1 ? w->x1 : column;
}

static const struct hsr_scan_edge *edge_of(const struct bouknight *s,
                                           uint32_t k) {
  return &s->edges.edge[s->edges.list[k]];
}

/* Pairs the edges of each face. */
static void find_segments(struct bouknight *s) {
  struct bouknight_list *list = s->list;
  for (uint32_t k = 0; k < s->edges.n_list; k++) {
    const struct hsr_scan_edge *edge = edge_of(s, k);
    uint32_t *opened_by = &list->opened_by[edge->face];
    list->end[k] = NO_END;
    if (*opened_by == BOUKNIGHT_NONE) {
      *opened_by = k;
    } else {
      int begin = column_of(s, *opened_by), end = column_of(s, k);
      list->end[*opened_by] = begin < end ? end : NO_SAMPLE;
      *opened_by = BOUKNIGHT_NONE;
    }
  }
}

/* --- Changes -------------------------------------------------------------- */

static void note_change(struct bouknight *s, struct change change) {
  struct bouknight_list *list = s->list;
  if (list->n_changes == list->room) {
    struct change *more =
        HSR_NEW(s->edges.job->scratch, struct change, 2 * list->room);
    if (!more) {
      s->edges.tally->out_of_memory = true;
      return;
    }
    memcpy(more, list->change, list->n_changes * sizeof *more);
    list->change = more;
    list->room *= 2;
  }
  uint32_t k = list->n_changes++;
  for (; k && list->change[k - 1].column < change.column; k--)
    list->change[k] = list->change[k - 1];
  list->change[k] = change;
}

/* The pair at place k and the one behind it, if there are two. They are in order
 * at sample `from`. Finds where they change places, if they do. */
static void compare_pair(struct bouknight *s, uint32_t k, int from) {
  if (k + 1 >= s->n_visible)
    return;
  uint32_t f = s->visible[k], g = s->visible[k + 1];
  int *end_of = s->list->end_of;
  int end = end_of[f] < end_of[g] ? end_of[f] : end_of[g];
  if (end - 1 == from || bouknight_is_nearer(s, f, g, end - 1))
    return;
  HSR_STEP(s->edges.tally, BOUKNIGHT_DIVISIONS, HSR_FACE(f), HSR_FACE(g),
           HSR_ON(from, end, s->j), 0);
  int column = hsr_scan_crossing(&s->edges, f, g, true, from, end, s->j,
                                 BOUKNIGHT_SEARCH);
  note_change(s, (struct change){column, f, g});
}

/* The faces at places k and k + 1 change places. */
static void interchange(struct bouknight *s, uint32_t k, int at) {
  uint32_t f = s->visible[k], g = s->visible[k + 1];
  (void)at; /* for the trace */
  HSR_STEP(s->edges.tally, BOUKNIGHT_MOVED, HSR_FACE(g), HSR_FACE(f),
           HSR_AT(at, s->j), 0);
  bouknight_put_at(s, g, k);
  bouknight_put_at(s, f, k + 1);
}

/* Makes the changes at column `left`. New neighbors are in order at the sample
 * before. */
static void change_places(struct bouknight *s, int left) {
  struct bouknight_list *list = s->list;
  while (list->n_changes && list->change[list->n_changes - 1].column <= left) {
    struct change change = list->change[--list->n_changes];
    uint32_t k = s->place[change.first];
    if (k == BOUKNIGHT_NONE || k + 1 >= s->n_visible ||
        s->visible[k + 1] != change.second)
      continue; /* others have come between */
    interchange(s, k, left);
    if (k)
      compare_pair(s, k - 1, left - 1);
    compare_pair(s, k + 1, left - 1);
  }
}

/* --- Edges ---------------------------------------------------------------- */

/* A segment ends at column `left`. */
static void leave(struct bouknight *s, uint32_t f, int left) {
  uint32_t k = s->place[f];
  bouknight_take_out(s, f);
  if (k)
    compare_pair(s, k - 1, left - 1);
}

/* A segment begins at column `left`: from its last position it moves to the
 * front, or else to the back. */
static void enter(struct bouknight *s, uint32_t f, int end, int left) {
  uint32_t *position = &s->list->position[f], n = s->n_visible++;
  uint32_t start = *position < n ? *position : n, k = start;
  for (uint32_t last = n; last > k; last--)
    bouknight_put_at(s, s->visible[last - 1], last);
  bouknight_put_at(s, f, k);
  s->list->end_of[f] = end;
  for (; k && bouknight_is_nearer(s, f, s->visible[k - 1], left); k--)
    interchange(s, k - 1, left);
  if (k == start)
    for (; k < n && !bouknight_is_nearer(s, f, s->visible[k + 1], left); k++)
      interchange(s, k, left);
  *position = k;
  if (k)
    compare_pair(s, k - 1, left);
  compare_pair(s, k, left);
}

/* Passes the edges from place k on that are at column `left`: first those where
 * segments end. Returns the place behind them. */
static uint32_t pass_edges(struct bouknight *s, uint32_t k, uint32_t n,
                           int left) {
  const int *end = s->list->end;
  uint32_t next = k;
  for (; next < n && column_of(s, next) <= left; next++) {
    uint32_t f = edge_of(s, next)->face;
    bouknight_count_bit(s, edge_of(s, next), end[next] != NO_END, left);
    if (s->place[f] != BOUKNIGHT_NONE && s->list->end_of[f] == left)
      leave(s, f, left);
  }
  change_places(s, left);
  for (; k < next; k++)
    if (end[k] >= 0)
      enter(s, edge_of(s, k)->face, end[k], left);
  return next;
}

/* --- The row -------------------------------------------------------------- */

void bouknight_scan_list(struct bouknight *s) {
  const struct hsr_window *w = s->edges.window;
  struct bouknight_list *list = s->list;
  uint32_t n = s->edges.n_list, k = 0;
  find_segments(s);
  list->n_changes = 0;
  for (int left = w->x0, right; left < w->x1; left = right) {
    k = pass_edges(s, k, n, left);
    right = k < n ? column_of(s, k) : w->x1;
    if (list->n_changes && list->change[list->n_changes - 1].column < right)
      right = list->change[list->n_changes - 1].column;
    bouknight_write(s, s->n_visible ? s->visible[0] : HSR_BACKGROUND, left,
                    right);
  }
  while (s->n_visible)
    bouknight_take_out(s, s->visible[s->n_visible - 1]);
}
