/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Watkins' scan lines by priority numbers: see priority_scan.h. */
#include "algorithms/list_priority/per_frame/priority_scan.h"

#include <string.h>

/* --- Priority ------------------------------------------------------------- */

enum hsr_status hsr_priority_scan_reserve(struct hsr_priority_scan *s,
                                          const struct hsr_job *job,
                                          const struct hsr_screen *screen,
                                          struct hsr_keeper *keeper) {
  *s = (struct hsr_priority_scan){.pieces = {.n = 0}};
  s->loose = HSR_NEW_ZEROED(job->scratch, bool, job->world->n_faces);
  return s->loose ? hsr_list_reserve(&s->list, job, screen, keeper,
                                     screen->n_relevant)
                  : HSR_E_NOMEM;
}

/* Gives a piece the next number. Its cuts are copied: those of the list last as
 * long as that does. */
static enum hsr_status add(struct hsr_priority_scan *s,
                           const struct hsr_piece *piece) {
  struct hsr_arena *arena = s->list.job->scratch;
  struct hsr_cut *cuts = NULL;
  if (piece->n_cuts && !(cuts = HSR_NEW(arena, struct hsr_cut, piece->n_cuts)))
    return HSR_E_NOMEM;
  if (cuts)
    memcpy(cuts, piece->cuts, piece->n_cuts * sizeof *cuts);
  if (!hsr_arena_grow(arena, &s->pieces, sizeof *piece))
    return HSR_E_NOMEM;
  struct hsr_piece *copy =
      (struct hsr_piece *)s->pieces.items + s->pieces.n - 1;
  *copy = *piece;
  copy->cuts = cuts;
  hsr_scan_make_room(&s->room, s->list.screen, copy);
  return HSR_OK;
}

enum hsr_status hsr_priority_scan_add(struct hsr_priority_scan *s,
                                      const uint32_t *faces, uint32_t n) {
  hsr_list_sort(&s->list, &s->list.job->view->window, faces, n);
  for (const struct hsr_piece *piece; (piece = hsr_list_next(&s->list));)
    if (add(s, piece))
      return HSR_E_NOMEM;
  return s->list.out_of_memory ? HSR_E_NOMEM : HSR_OK;
}

enum hsr_status hsr_priority_scan_add_loose(struct hsr_priority_scan *s,
                                            uint32_t f) {
  struct hsr_piece whole = hsr_uncut_face(s->list.screen, f);
  s->loose[f] = true;
  return add(s, &whole);
}

/* --- Visibility ----------------------------------------------------------- */

/* Whether f is nearer than g at (i, j). */
static bool ask_sample(const struct hsr_priority_scan *s, uint32_t f,
                       uint32_t g, int i, int j) {
  bool nearer = hsr_nearer(s->list.screen, f, g, i, j, s->list.tally);
  HSR_STEP(s->list.tally, HSR_PRIORITY_THICKNESS, HSR_FACE(f), HSR_FACE(g),
           HSR_AT(i, j), nearer);
  return nearer;
}

static bool have_order(const struct hsr_priority_scan *s, uint32_t f,
                       uint32_t g) {
  const bool *thick = s->list.thick;
  return !s->loose[f] && !s->loose[g] && (!thick[f] || !thick[g]);
}

/* The last step of Watkins' algorithm. */
static bool is_prior(void *context, const struct hsr_watkins_segment *f,
                     const struct hsr_watkins_segment *g, int l, int r, int j,
                     int *end) {
  const struct hsr_priority_scan *s = context;
  *end = r;
  if (have_order(s, f->face, g->face)) {
    bool prior = f->piece > g->piece;
    HSR_STEP(s->list.tally, HSR_PRIORITY_SEARCH, HSR_FACE(f->face),
             HSR_FACE(g->face), HSR_ON(l, r, j), prior);
    return prior;
  }
  bool nearer = ask_sample(s, f->face, g->face, l, j);
  if (l + 1 < r && ask_sample(s, f->face, g->face, r - 1, j) != nearer)
    *end = hsr_scan_crossing(&s->watkins.edges, f->face, g->face, nearer, l, r,
                             j, HSR_PRIORITY_THICKNESS);
  return nearer;
}

enum hsr_status hsr_priority_scan_solve(struct hsr_priority_scan *s) {
  const struct hsr_job *job = s->list.job;
  if (hsr_watkins_reserve(&s->watkins, job, s->list.screen, s->room,
                          s->pieces.n))
    return HSR_E_NOMEM;
  s->watkins.is_nearer = is_prior;
  s->watkins.context = s;
  hsr_scan_open(&s->watkins.edges, &job->view->window);
  const struct hsr_piece *piece = s->pieces.items;
  for (uint32_t p = 0; p < s->pieces.n; p++)
    hsr_scan_add(&s->watkins.edges, &piece[p], p);
  hsr_watkins_scan(&s->watkins);
  return HSR_OK;
}

/* --- What it counts ------------------------------------------------------- */

static const struct hsr_counter counters[] = {
    {"priority search", "comparisons of two segments' priority numbers",
     HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, "less|greater",
     .key = "place-search"},
    {"thickness checks",
     "comparisons in depth where faces that are not flat touch", HSR_COMPARE,
     HSR_OF_FACE, HSR_OF_FACE, "farther|nearer"},
    {NULL}};

static const struct hsr_line lines[] = {
    {"    search the segments inside for the greatest priority number",
     HSR_RAISES(HSR_PRIORITY_SEARCH)},
    {"      of thick faces: compare their depths",
     HSR_RAISES(HSR_PRIORITY_THICKNESS)},
    {NULL}};

static const struct hsr_step steps[] = {
    {"priority search", HSR_PRIORITY_SEARCH, HSR_KIND_NUMBERS}, {NULL}};

static const struct hsr_sort sorts[] = {
    {"segments", "Z", "search by priority number", "once a sample span"},
    {NULL}};

const struct hsr_part hsr_priority_search_part = {
    HSR_PART_PRIORITY_SEARCH, counters, steps, sorts, {lines}};
