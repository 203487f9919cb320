/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bouknight's scan-line algorithm: a sample span from each edge crossing to the
 * next.
 *
 * Source      W. J. Bouknight, "An improved procedure for generation of
 *             half-tone computer graphics representations", R-432, Coordinated
 *             Science Laboratory, University of Illinois, 1969; Comm. ACM
 * 13(9), 1970; as described by Sutherland et al. 1974, "Segment Comparisons"
 * and figure 12a, "Scan-line Algorithms" and figure 27a. Notation    scan line
 * -> row j; Y buckets and X sort list -> scan_line.h; sample span -> [left,
 * right); the faces whose visible bit is on
 *             -> visible[]; a face's bit -> place[] is not NONE
 * Invariant   in scan_row, visible[] holds the faces that cover all samples of
 *             the span, and no other face covers any of them;
 *             in show_span, `first` and `last` are the nearest faces at the
 *             span's first and last sample
 * Penetration the depths are compared at the limits of the span, and a span
 *             with different faces there is divided where those two penetrate
 *             (the survey only says that the procedure "must be altered
 *             slightly", and refers to R-432). Along a row 1/t of a plane is
 *             linear, ties included, so a face that is nearest at both limits
 *             is nearest between them
 * Ties        by hsr_nearer
 * Departures  those of scan_line.h; spans without a sample are passed over; a
 *             span of one face or none needs no search
 * Cost        span cull n S_l, depth search 30 n D_c min(m, 2 S_v): Table III
 *             has one column for Watkins and Bouknight, whose spans are more,
 *             up to 2 S_l */
#include "algorithms/scan_line.h"

enum { SPAN_CULL = HSR_N_SCAN_COUNTERS, DEPTH_SEARCH, DIVISIONS, SPANS };

static const struct hsr_counter counters[] = {
    HSR_SCAN_COUNTERS,
    [SPAN_CULL] = {"span cull", "visible bits turned on or off"},
    [DEPTH_SEARCH] = {"depth search", "comparisons of two faces in depth"},
    [DIVISIONS] = {"span divisions", "spans divided where two faces penetrate"},
    [SPANS] = {"spans", "sample spans decided"},
    {NULL, NULL}};

static const struct hsr_step steps[] = {
    HSR_SCAN_STEPS,
    {"span cull", SPAN_CULL, 1, "n S_l", hsr_predict_span_cull},
    {"depth search", DEPTH_SEARCH, 30, "30 n D_c min(m, 2 S_v)",
     hsr_predict_depth_search},
    {NULL, 0, 0, NULL, NULL}};

static const struct hsr_sort sorts[] = {
    HSR_SCAN_SORTS,
    {"faces", "X", "cull by visible bits", "once an edge crossing"},
    {"faces", "Z", "exhaustive search", "at both limits of a sample span"},
    {NULL, NULL, NULL, NULL}};

/* No place: the visible bit is off. */
static const uint32_t NONE = UINT32_MAX;

struct row {
  struct hsr_scan scan; /* Y buckets and X sort list */
  int j;
  uint32_t *ids; /* of the row */

  uint32_t *visible, n_visible;
  uint32_t *place; /* a face: where it stands in visible[] */
};

/* --- Span cull --------------------------------------------------------------
 */

/* Turns the visible bit of a face on or off, as the span passes its edge. */
static void turn_bit(struct row *r, uint32_t f) {
  HSR_STEP(r->scan.tally, SPAN_CULL,
           r->place[f] == NONE ? HSR_ACTIVATE : HSR_RETIRE, f, HSR_NOTHING, 0,
           r->j, 0, r->j + 1);
  if (r->place[f] == NONE) {
    r->place[f] = r->n_visible;
    r->visible[r->n_visible++] = f;
  } else {
    uint32_t last = r->visible[--r->n_visible];
    r->visible[r->place[f]] = last;
    r->place[last] = r->place[f];
    r->place[f] = NONE;
  }
}

/* --- Depth search -----------------------------------------------------------
 */

/* The nearest of the visible faces at sample i; `nearest` is one of them. */
static uint32_t search_depth(struct row *r, uint32_t nearest, int i) {
  for (uint32_t k = 0; k < r->n_visible; k++) {
    uint32_t f = r->visible[k];
    if (f == nearest)
      continue;
    HSR_TOUCH(r->scan.tally, i, r->j);
    HSR_STEP(r->scan.tally, DEPTH_SEARCH, HSR_COMPARE, f, nearest, i, r->j,
             i + 1, r->j + 1);
    if (hsr_nearer(&r->scan.screen, f, nearest, i, r->j, r->scan.tally))
      nearest = f;
  }
  return nearest;
}

/* --- Sample spans -----------------------------------------------------------
 */

static void write_span(struct row *r, uint32_t id, int left, int right) {
  HSR_STEP(r->scan.tally, SPANS, HSR_SPAN, id, HSR_NOTHING, left, r->j, right,
           r->j + 1);
  HSR_TOUCH_SPAN(r->scan.tally, left, right, r->j);
  for (int i = left; i < right; i++)
    r->ids[i] = id;
}

/* Writes a span, divided where the nearest face changes. */
static void show_span(struct row *r, uint32_t first, uint32_t last, int left,
                      int right) {
  while (first != last) {
    HSR_STEP(r->scan.tally, DIVISIONS, HSR_SUBDIVIDE, first, last, left, r->j,
             right, r->j + 1);
    int middle = hsr_scan_crossing(&r->scan, first, last, true, left, right,
                                   r->j, DEPTH_SEARCH);
    uint32_t before = search_depth(r, first, middle - 1);
    show_span(r, first, before, left, middle);
    first = search_depth(r, last, middle);
    left = middle;
  }
  write_span(r, first, left, right);
}

static void decide_span(struct row *r, int left, int right) {
  uint32_t first = HSR_BACKGROUND, last = HSR_BACKGROUND;
  if (r->n_visible) {
    first = search_depth(r, r->visible[0], left);
    last = left + 1 < right ? search_depth(r, first, right - 1) : first;
  }
  show_span(r, first, last, left, right);
}

/* A span ends, and the next one begins, at every edge crossing. */
static void scan_row(struct row *r) {
  const struct hsr_window *w = r->scan.window;
  int left = w->x0;
  for (uint32_t k = 0; k < r->scan.n_list; k++) {
    const struct hsr_scan_edge *edge = &r->scan.edge[r->scan.list[k]];
    if (edge->column == HSR_NO_COLUMN)
      break;
    int right = edge->column < w->x1 ? edge->column : w->x1;
    if (left < right) {
      decide_span(r, left, right);
      left = right;
    }
    turn_bit(r, edge->face);
  }
  if (left < w->x1)
    decide_span(r, left, w->x1);
}

/* --- The algorithm ----------------------------------------------------------
 */

static enum hsr_status allocate(struct row *r) {
  const struct hsr_job *job = r->scan.job;
  size_t n_faces = job->world->n_faces;
  r->visible = HSR_NEW(job->scratch, uint32_t, r->scan.screen.n_relevant);
  r->place = HSR_NEW(job->scratch, uint32_t, n_faces);
  if (!r->visible || !r->place)
    return HSR_E_NOMEM;
  for (size_t f = 0; f < n_faces; f++)
    r->place[f] = NONE;
  return HSR_OK;
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct row row = {.n_visible = 0};
  if (hsr_scan_begin(&row.scan, job) || allocate(&row))
    return hsr_fail_nomem(err);

  const struct hsr_window *w = &job->view->window;
  for (row.j = w->y0; row.j < w->y1; row.j++) {
    hsr_scan_advance(&row.scan, row.j);
    row.ids = job->ids + (size_t)row.j * job->ids_stride;
    scan_row(&row);
  }
  return HSR_OK;
}

const struct hsr_algorithm HSR_ALGORITHM(bouknight) = {
    .name = "bouknight",
    .title = "Bouknight's scan-line algorithm",
    .authors = "W. J. Bouknight",
    .year = 1969,
    .source = "R-432, Coordinated Science Laboratory, University of Illinois, "
              "1969; Comm. ACM 13(9), 1970; Sutherland et al., Computing "
              "Surveys 6(1), 1974, \"Scan-line Algorithms\"",
    .taxonomy = HSR_IMAGE_SPACE_POINT,
    .sort_order = "YXZ",
    .coherence = "scan line; edge",
    .restrictions = 0,
    .kind = HSR_IDS,
    .sorts = sorts,
    .counters = counters,
    .steps = steps,
    .render = render};
