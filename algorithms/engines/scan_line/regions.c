/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Decisions that are carried from row to row: see regions.h. */
#include "algorithms/engines/scan_line/regions.h"

#include <limits.h>
#include <string.h>

/* No edge: a side of the window. */
static const uint32_t NONE = HSR_NO_ID;

enum hsr_status hsr_regions_begin(struct hsr_regions *r, struct hsr_scan *scan,
                                  size_t n_pieces,
                                  struct hsr_regions_counters counters) {
  struct hsr_arena *arena = scan->job->scratch;
  size_t n = scan->n_edges;
  *r = (struct hsr_regions){.scan = scan, .counters = counters};
  r->old = HSR_NEW(arena, uint32_t, n + 1);
  r->place = HSR_NEW_ZEROED(arena, uint32_t, n + 1);
  r->region = HSR_NEW(arena, struct hsr_region, n + 1);
  r->differs = HSR_NEW_ZEROED(arena, bool, n_pieces);
  if (!r->old || !r->place || !r->region || !r->differs)
    return HSR_E_NOMEM;
  for (size_t e = 0; e <= n; e++)
    r->region[e].row = INT_MIN;
  return HSR_OK;
}

void hsr_regions_open(struct hsr_regions *r, int j) {
  const struct hsr_scan *s = r->scan;
  r->j = j;
  r->here = r->there = r->agreed = 0;
  r->n_list = s->n_list;
}

/* --- The two lists -------------------------------------------------------- */

/* An edge is passed, in one direction or the other, in just one of the lists.
 */
static void pass_alone(struct hsr_regions *r, uint32_t e) {
  bool *differs = &r->differs[r->scan->edge[e].piece];
  *differs = !*differs;
  r->n_differ += *differs ? 1 : UINT32_MAX;
}

/* Compares an edge with one of the row before; `same`: they are one. */
static bool test(struct hsr_regions *r, uint32_t e, bool same) {
  (void)e; /* for the trace */
  HSR_STEP(r->scan->tally, r->counters.tests,
           hsr_scan_subject(&r->scan->edge[e]), HSR_NOTHING,
           HSR_ON(r->scan->window->x0, r->scan->window->x1, r->j), same);
  return same;
}

/* Is the edge behind place k of the row's list also behind place `old` of the
 * one before? */
static bool is_same(struct hsr_regions *r, uint32_t k, uint32_t old) {
  if (k < r->agreed && k - r->here == old - r->there)
    return true;
  uint32_t e = r->scan->list[k];
  return test(r, e, old < r->n_old && r->old[old] == e);
}

static void move_there(struct hsr_regions *r, uint32_t k) {
  if (r->there != k)
    r->agreed = r->here;
  while (r->there < k) {
    uint32_t e = r->old[r->there++];
    test(r, e, false);
    pass_alone(r, e);
  }
  while (r->there > k) {
    uint32_t e = r->old[--r->there];
    test(r, e, false);
    pass_alone(r, e);
  }
}

static void move_here(struct hsr_regions *r, uint32_t k) {
  while (r->here < k) {
    bool same = is_same(r, r->here, r->there);
    uint32_t e = r->scan->list[r->here++];
    if (same)
      r->there++;
    else
      pass_alone(r, e);
    if (r->agreed < r->here)
      r->agreed = r->here;
  }
}

/* Whether edge e is in the list of the row before. */
static bool was_there(const struct hsr_regions *r, uint32_t e) {
  return r->place[e] < r->n_old && r->old[r->place[e]] == e;
}

static struct hsr_region *region_at(const struct hsr_regions *r, uint32_t k) {
  return &r->region[k ? r->scan->list[k - 1] : r->scan->n_edges];
}

/* Goes along both lists as long as they agree, from places k = here and `there`
 * on: up to the edge `last`, or if there is none, to the end of both. */
static bool find_end(struct hsr_regions *r, uint32_t last, uint32_t k,
                     uint32_t *end) {
  uint32_t old = r->there;
  bool same = true, found = false;
  for (; k < r->n_list && (same = is_same(r, k, old)); k++, old++)
    if ((found = r->scan->list[k] == last))
      break;
  if (r->agreed < k + found)
    r->agreed = k + found;
  *end = k;
  return found || (same && last == NONE && old == r->n_old);
}

const struct hsr_region *hsr_regions_carried(struct hsr_regions *r, uint32_t k,
                                             uint32_t *end) {
  struct hsr_region *region = region_at(r, k);
  if (region->row != r->j - 1 || region->until <= r->j)
    return NULL;
  move_here(r, k);
  if (k && !was_there(r, r->scan->list[k - 1]))
    return NULL;
  move_there(r, k ? r->place[r->scan->list[k - 1]] + 1 : 0);
  if (r->n_differ)
    return NULL;
  if (!find_end(r, region->last, k, end))
    return NULL;
  region->row = r->j;
  return region;
}

void hsr_regions_note(struct hsr_regions *r, uint32_t k, uint32_t end,
                      uint32_t face, int until) {
  *region_at(r, k) = (struct hsr_region){.last = hsr_regions_after(r, end),
                                         .face = face,
                                         .until = until,
                                         .row = r->j};
}

/* Undoes what is left in differs[]; the row's list becomes the old one. */
void hsr_regions_close(struct hsr_regions *r) {
  while (r->here)
    pass_alone(r, r->scan->list[--r->here]);
  while (r->there)
    pass_alone(r, r->old[--r->there]);
  r->n_old = r->n_list;
  memcpy(r->old, r->scan->list, r->n_list * sizeof *r->old);
  for (uint32_t k = 0; k < r->n_list; k++)
    r->place[r->old[k]] = k;
}

/* --- Forecasts ------------------------------------------------------------ */

/* Where the samples between two edges begin, or end, on each row: within
 * `tolerance` of x + slope sy. */
struct side {
  double x, slope, tolerance;
};

/* The window's first sample, or its last. */
static struct side window_side(const struct hsr_scan *s, bool left) {
  const struct hsr_window *w = s->window;
  return (struct side){
      .x = hsr_sample_x(s->job->view, left ? w->x0 : w->x1 - 1)};
}

/* That of an edge; or the window's, if the edge leaves the window up to row
 * `last`. False if the edge stands for an end of a cut face. */
static bool find_side(const struct hsr_scan *s, uint32_t e, bool left, int j,
                      int last, struct side *side) {
  *side = window_side(s, left);
  if (e == NONE)
    return true;
  const struct hsr_scan_edge *edge = &s->edge[e];
  if (edge->cut != HSR_NOT_CUT)
    return false;
  double least = hsr_sample_x(s->job->view, s->window->x0);
  double most = hsr_sample_x(s->job->view, s->window->x1 - 1);
  double a = edge->line.x + edge->line.slope * hsr_sample_y(s->job->view, j);
  double b = edge->line.x + edge->line.slope * hsr_sample_y(s->job->view, last);
  if (a >= least && b >= least && a <= most && b <= most)
    *side = (struct side){edge->line.x, edge->line.slope, edge->line.tolerance};
  return true;
}

/* By how much the plane of f is nearer than that of g where a side crosses row
 * j, less what may be wrong with it. */
static double lead(const struct hsr_screen *screen, uint32_t f, uint32_t g,
                   struct side side, int j) {
  const struct hsr_depth_plane *p = &screen->plane[f], *q = &screen->plane[g];
  double y = hsr_sample_y(screen->view, j), x = side.x + side.slope * y;
  double error = p->error + q->error + fabs(p->a - q->a) * side.tolerance;
  return hsr_depth_at(screen, f, x, y) - hsr_depth_at(screen, g, x, y) -
         2 * error;
}

/* The first row from j to `last` + 1 up to which the lead is positive. */
static int foresee_side(const struct hsr_screen *screen, uint32_t f, uint32_t g,
                        struct side side, int j, int last) {
  double now = lead(screen, f, g, side, j);
  if (!(now > 0))
    return j;
  double then = lead(screen, f, g, side, last);
  if (then > 0)
    return last + 1;
  double share = now / (now - then); /* NaN, if a plane is of no use */
  int row = share > 0 ? j + (int)((last - j) * share) - 1 : j;
  return row > j && lead(screen, f, g, side, row) > 0 ? row + 1 : j + 1;
}

/* Whether at neither end of an edge the plane of g is nearer than that of f. */
static bool is_first_at_ends(const struct hsr_scan *s, uint32_t f, uint32_t g,
                             uint32_t e) {
  const struct hsr_edge *line = &s->edge[e].line;
  return hsr_vertex_nearer(&s->screen, f, g, line->a, s->tally) >= 0 &&
         hsr_vertex_nearer(&s->screen, f, g, line->b, s->tally) >= 0;
}

static void count_forecast(const struct hsr_regions *r, uint32_t f, uint32_t g,
                           int until) {
  (void)f, (void)g, (void)until; /* for the trace */
  const struct hsr_window *w = r->scan->window;
  HSR_STEP(r->scan->tally, r->counters.forecasts, HSR_FACE(f), HSR_FACE(g),
           HSR_ON(w->x0, w->x1, r->j), until > r->j + 1);
}

/* The same for an edge, or a side of the window. *touches: along another edge
 * the two planes may have met; set if they may along this one. */
static int foresee(const struct hsr_regions *r, uint32_t f, uint32_t g,
                   uint32_t e, bool left, bool *touches, int until) {
  const struct hsr_scan *s = r->scan;
  struct side side;
  int proved = r->j;
  if (find_side(s, e, left, r->j, until - 1, &side))
    proved = foresee_side(&s->screen, f, g, side, r->j, until - 1);
  count_forecast(r, f, g, proved);
  if (proved == until || *touches || e == NONE || s->edge[e].cut != HSR_NOT_CUT)
    return proved;
  *touches = is_first_at_ends(s, f, g, e);
  count_forecast(r, f, g, *touches ? until : proved);
  return *touches ? until : proved;
}

int hsr_regions_foresee(struct hsr_regions *r, uint32_t f, uint32_t g,
                        uint32_t left, uint32_t right, int until) {
  struct hsr_scan *s = r->scan;
  const uint32_t *plane = s->job->world->mesh.plane;
  bool touches = false;
  if (left != NONE && until > s->edge[left].end_row)
    until = s->edge[left].end_row;
  if (right != NONE && until > s->edge[right].end_row)
    until = s->edge[right].end_row;
  if (until > s->window->y1)
    until = s->window->y1;
  if (plane[f] == plane[g])
    return f < g ? until : r->j;
  until = foresee(r, f, g, left, true, &touches, until);
  return until > r->j + 1 ? foresee(r, f, g, right, false, &touches, until)
                          : until;
}

bool hsr_regions_go_on(struct hsr_regions *r, uint32_t k, uint32_t end) {
  const struct hsr_scan *s = r->scan;
  for (; k <= end && k <= r->n_list; k++) {
    uint32_t e = hsr_regions_before(r, k);
    bool goes_on = e == NONE || s->edge[e].end_row > r->j + 1;
    if (e != NONE)
      HSR_STEP(s->tally, r->counters.ends, hsr_scan_subject(&s->edge[e]),
               HSR_NOTHING, HSR_ON(s->window->x0, s->window->x1, r->j),
               goes_on);
    if (!goes_on)
      return false;
  }
  return true;
}
