/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Newell's priority computer, then Watkins' scan lines, whose last step
 * compares priority numbers instead of depths.
 *
 * Source      suggested by E. Catmull and M. E. Newell, as Sutherland et al.
 *             1974 report under "Other Combinations of Sorting": a few
 *             sentences.
 * Notation    the list -> priority_list.h; scan line, segment, sample span ->
 *             watkins.c; priority number -> the place at which a piece left the
 *             list, the farthest first
 * Invariant   of two pieces that cover a sample, the one with the greater
 *             number is the nearer one, unless both are of thick faces
 * Ties        those of priority_list.h; among thick faces, by hsr_nearer
 * Departures  Those of priority_list.h and scan_line.h. A divided face is its
 *             face and cuts, and gives its columns a row at a time
 *             (hsr_piece_spans). Two segments of thick faces are compared in
 *             depth at both ends of what they share; if the answers differ,
 *             the crossing is searched for, as depth is linear along the row.
 *             These comparisons are counted apart.
 * Cost        those of priority_list.h; of watkins.c all but the depth search:
 *             a priority search is one comparison, where Table III has 30 */
#include "algorithms/list_priority/per_frame/priority_list.h"
#include "algorithms/image_space/point/watkins.h"

/* The counters of the priority list come first, those of the scan from SCAN on,
 * to which two are added. */
enum { PRIORITY_SEARCH, THICKNESS };

struct newell_watkins {
  struct hsr_priority_list list;
  struct hsr_growing pieces; /* by priority number */
  struct hsr_watkins watkins;
};

/* --- Newell: priority ----------------------------------------------------- */

/* All pieces in the order of priority, and the room that Watkins needs. */
static enum hsr_status order_pieces(struct newell_watkins *s,
                                    const struct hsr_screen *screen,
                                    struct hsr_scan_room *room) {
  const struct hsr_job *job = s->list.job;
  hsr_list_sort(&s->list, &job->view->window, screen->relevant,
                screen->n_relevant);
  for (const struct hsr_piece *piece; (piece = hsr_list_next(&s->list));) {
    if (!hsr_arena_grow(job->scratch, &s->pieces, sizeof *piece))
      return HSR_E_NOMEM;
    ((struct hsr_piece *)s->pieces.items)[s->pieces.n - 1] = *piece;
    hsr_scan_make_room(room, screen, piece);
  }
  return s->list.out_of_memory ? HSR_E_NOMEM : HSR_OK;
}

/* --- Watkins: visibility -------------------------------------------------- */

/* Whether f is nearer than g at (i, j). */
static bool ask_sample(const struct newell_watkins *s, uint32_t f, uint32_t g,
                       int i, int j) {
  bool nearer = hsr_nearer(s->list.screen, f, g, i, j, s->list.tally);
  HSR_STEP(s->list.tally, THICKNESS, HSR_FACE(f), HSR_FACE(g), HSR_AT(i, j),
           nearer);
  return nearer;
}

/* The last step of Watkins' algorithm. */
static bool is_prior(void *context, const struct hsr_watkins_segment *f,
                     const struct hsr_watkins_segment *g, int l, int r, int j,
                     int *end) {
  const struct newell_watkins *s = context;
  const bool *thick = s->list.thick;
  *end = r;
  if (!thick[f->face] || !thick[g->face]) {
    bool prior = f->piece > g->piece;
    HSR_STEP(s->list.tally, PRIORITY_SEARCH, HSR_PIECE(f->face, f->piece),
             HSR_PIECE(g->face, g->piece), HSR_ON(l, r, j), prior);
    return prior;
  }
  bool nearer = ask_sample(s, f->face, g->face, l, j);
  if (l + 1 < r && ask_sample(s, f->face, g->face, r - 1, j) != nearer)
    *end = hsr_scan_crossing(&s->watkins.edges, f->face, g->face, nearer, l, r,
                             j, THICKNESS);
  return nearer;
}

/* --- The algorithm -------------------------------------------------------- */

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct hsr_screen screen;
  struct newell_watkins s = {.pieces = {.n = 0}};
  struct hsr_scan_room room = {0};
  if (hsr_screen_make(&screen, job->world, job->view, job->scratch,
                      job->tally) ||
      hsr_list_reserve(&s.list, job, &screen, NULL, screen.n_relevant) ||
      order_pieces(&s, &screen, &room) ||
      hsr_watkins_reserve(&s.watkins, job, &screen, room, s.pieces.n))
    return hsr_fail_nomem(err);

  s.watkins.is_nearer = is_prior;
  s.watkins.context = &s;
  hsr_scan_open(&s.watkins.edges, &job->view->window);
  const struct hsr_piece *piece = s.pieces.items;
  for (uint32_t p = 0; p < s.pieces.n; p++)
    hsr_scan_add(&s.watkins.edges, &piece[p], p);
  hsr_watkins_scan(&s.watkins);
  return HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {
    {&hsr_list_part}, {&hsr_scan_part}, {&hsr_spans_part}, {NULL}};

static const struct hsr_counter counters[] = {
    [PRIORITY_SEARCH] = {"priority search",
                         "comparisons of two segments' priority numbers",
                         HSR_COMPARE, HSR_OF_PIECE, HSR_OF_PIECE,
                         "less|greater", .key = "place-search"},
    [THICKNESS] = {"thickness checks",
                   "comparisons in depth where faces that are not flat touch",
                   HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, "farther|nearer"},
    {NULL}};

static const struct hsr_line outline[] = {
    {"", .part = &hsr_list_part},
    {"  give P the next priority number"},
    {"", .part = &hsr_scan_part},
    {"", .part = &hsr_spans_part},
    {"    search the segments inside for the greatest priority number",
     HSR_RAISES(PRIORITY_SEARCH)},
    {"      of thick faces: compare their depths", HSR_RAISES(THICKNESS)},
    {"", .part = &hsr_spans_part, .group = HSR_LINES_AFTER_SEARCH},
    {NULL}};

static const struct hsr_step steps[] = {
    {"priority search", PRIORITY_SEARCH, HSR_KIND_NUMBERS}, {NULL}};

static const struct hsr_sort sorts[] = {
    {.part = &hsr_list_part},
    {.part = &hsr_scan_part},
    {.part = &hsr_spans_part},
    {"segments", "Z", "search by priority number", "once a sample span"},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(newell_watkins) = {
    .name = "newell-watkins",
    .title = "Newell's priority list, then Watkins' scan lines",
    .authors = "E. Catmull, M. E. Newell",
    .year = 1974,
    .source = "suggested by both, as Sutherland et al., Computing Surveys "
              "6(1), 1974, report under \"Other Combinations of Sorting\"",
    .taxonomy = HSR_LIST_PRIORITY_PER_FRAME,
    .sort_order = "ZYXZ",
    .coherence = "depth; scan line; edge; floating right end of the sample "
                 "span",
    .restrictions = 0,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}},
    .sorts = sorts,
    .parts = uses,
    .counters = counters,
    .steps = steps,
    .outline = outline,
    .render = render};
