/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bouknight's scan-line algorithm: a sample span from each edge crossing to the
 * next.
 *
 * Source      W. J. Bouknight, "An improved procedure for generation of
 *             half-tone computer graphics representations", R-432, Coordinated
 *             Science Laboratory, University of Illinois, 1969, and Comm. ACM
 *             13(9), 1970; as described by Sutherland et al. 1974, "Segment
 *             Comparisons", "Scan-line Algorithms", figures 12a and 27a.
 * Notation    scan line -> row j; Y buckets and X sort list -> scan_line.h;
 *             sample span -> [left, right); the faces whose visible bit is on
 *             -> visible[]; a face's bit is on -> place[] is not NONE
 * Invariants  in decide_span, the faces in visible[] cover all samples of the
 *             span, and no other face covers any of them; in show_span, `first`
 *             and `last` are the nearest faces at its first and last sample
 * Penetration The depths are compared at both limits of a span; where they tell
 *             different faces, it is divided at the first sample behind the
 *             crossing of those two. (All the survey says is that penetrating
 *             faces take a slight change, which R-432 describes.) On a row 1/t
 *             of a plane is linear, ties included: a face that is nearest at
 *             both limits is so in between.
 * Glass       A departure, after "Depth Coherence" and the last paragraph of
 *             "An Untried Sorting Order" in the survey: in a transparent
 *             picture visible[] is sorted by depth. The order of the last span
 *             is where the sort begins, so it is an insertion sort. The span
 *             ends where two neighbours change places. From the first opaque
 *             face on the faces are combined (docs/transparent-picture.md). At
 *             a limit all pairs are in order if all neighbours are, and in
 *             between 1/t of two planes crosses once at most: so the order
 *             holds in the span.
 * Shadows     after J. Bouknight and K. Kelley 1970, by pairs: shadow_pairs.h.
 *             A segment that is visible is divided where its shadows begin and
 *             end; here that is asked at each sample
 * Ties        by hsr_nearer
 * Departures  those of scan_line.h; a span without a sample is passed over; one
 *             with a single face or none is not searched; at the second limit
 *             the search begins with the face found at the first
 * Cost        span cull n S_l, depth search 30 n D_c min(m, 2 S_v), and those
 *             of scan_line.h: Table III has one column for Watkins and
 *             Bouknight, though the latter's spans are up to 2 S_l a line */
#include "algorithms/engines/light/glass.h"
#include "algorithms/engines/scan_line/scan_line.h"
#include "algorithms/image_space/point/shadow_pairs.h"
#include "common/answers/kinds/shadowed.h"
#include "common/answers/kinds/transparent.h"

#include <string.h>

enum { SPAN_CULL, DEPTH_SEARCH, DIVISIONS, COMBINED, SPANS };

/* No place: the visible bit is off. */
static const uint32_t NONE = UINT32_MAX;

struct scan {
  struct hsr_scan edges; /* Y buckets and X sort list */
  int j;
  uint32_t *ids;                  /* of the row */
  struct hsr_glass *glass;        /* if the picture is transparent; else NULL */
  struct hsr_shadow_pairs *pairs; /* if it has shadows; else NULL */

  uint32_t *visible, n_visible; /* in a transparent picture by depth, except
                                   for the last ones, which are new */
  uint32_t *place;              /* a face: where it stands in visible[] */
};

/* --- Span cull ------------------------------------------------------------ */

static void put_at(struct scan *s, uint32_t f, uint32_t place) {
  s->visible[place] = f;
  s->place[f] = place;
}

/* Takes a face out; the others keep their order. */
static void take_out(struct scan *s, uint32_t f) {
  for (uint32_t k = s->place[f] + 1; k < s->n_visible; k++)
    put_at(s, s->visible[k], k - 1);
  s->n_visible--;
  s->place[f] = NONE;
}

/* Turns the visible bit of an edge's face on or off. `left`: where the next
 * span begins. */
static void turn_bit(struct scan *s, const struct hsr_scan_edge *edge,
                     int left) {
  uint32_t f = edge->face;
  (void)left; /* for the trace */
  HSR_STEP(s->edges.tally, SPAN_CULL, HSR_FACE(f), hsr_scan_subject(edge),
           HSR_ON(left, s->edges.window->x1, s->j), s->place[f] == NONE);
  if (s->place[f] == NONE) {
    s->place[f] = s->n_visible;
    s->visible[s->n_visible++] = f;
  } else if (s->glass) {
    take_out(s, f);
  } else {
    uint32_t last = s->visible[--s->n_visible];
    s->visible[s->place[f]] = last;
    s->place[last] = s->place[f];
    s->place[f] = NONE;
  }
}

/* --- Depth search --------------------------------------------------------- */

static bool is_nearer(struct scan *s, uint32_t f, uint32_t g, int i) {
  HSR_TOUCH(s->edges.tally, i, s->j);
  bool nearer = hsr_nearer(&s->edges.screen, f, g, i, s->j, s->edges.tally);
  HSR_STEP(s->edges.tally, DEPTH_SEARCH, HSR_FACE(f), HSR_FACE(g),
           HSR_AT(i, s->j), nearer);
  return nearer;
}

/* The nearest of the visible faces at sample i; `nearest` is one of them. */
static uint32_t search_depth(struct scan *s, uint32_t nearest, int i) {
  for (uint32_t k = 0; k < s->n_visible; k++) {
    uint32_t f = s->visible[k];
    if (f != nearest && is_nearer(s, f, nearest, i))
      nearest = f;
  }
  return nearest;
}

/* Sorts the visible faces by depth at sample i, from the order that they have.
 */
static void sort_by_depth(struct scan *s, int i) {
  for (uint32_t k = 1; k < s->n_visible; k++) {
    uint32_t f = s->visible[k], at = k;
    for (; at && is_nearer(s, f, s->visible[at - 1], i); at--)
      put_at(s, s->visible[at - 1], at);
    put_at(s, f, at);
  }
}

/* Up to where in [left, right) the order of sample `left` holds. */
static int order_end(struct scan *s, int left, int right) {
  for (uint32_t k = 1; k < s->n_visible && left + 1 < right; k++) {
    uint32_t f = s->visible[k - 1], g = s->visible[k];
    if (is_nearer(s, f, g, right - 1))
      continue;
    HSR_STEP(s->edges.tally, DIVISIONS, HSR_FACE(f), HSR_FACE(g),
             HSR_ON(left, right, s->j), 0);
    right = hsr_scan_crossing(&s->edges, f, g, true, left, right, s->j,
                              DEPTH_SEARCH);
  }
  return right;
}

/* --- Sample spans --------------------------------------------------------- */

static void write_span(struct scan *s, uint32_t id, int left, int right) {
  HSR_STEP(s->edges.tally, SPANS, HSR_FACE(id), HSR_THE_WINDOW,
           HSR_ON(left, right, s->j), 0);
  HSR_TOUCH_SPAN(s->edges.tally, left, right, s->j);
  for (int i = left; i < right; i++)
    s->ids[i] = id;
  if (s->pairs && hsr_shadow_pairs_show(s->pairs, id, left, right, s->j))
    s->edges.tally->out_of_memory = true;
}

/* Writes a span, divided where the nearest face changes. */
static void show_span(struct scan *s, uint32_t first, uint32_t last, int left,
                      int right) {
  while (first != last) {
    HSR_STEP(s->edges.tally, DIVISIONS, HSR_FACE(first), HSR_FACE(last),
             HSR_ON(left, right, s->j), 0);
    int middle = hsr_scan_crossing(&s->edges, first, last, true, left, right,
                                   s->j, DEPTH_SEARCH);
    uint32_t before = search_depth(s, first, middle - 1);
    show_span(s, first, before, left, middle);
    first = search_depth(s, last, middle);
    left = middle;
  }
  write_span(s, first, left, right);
}

/* The colour of the visible faces, from the first opaque one on. */
static void combine(struct scan *s, int left, int right, uint16_t rgb[3]) {
  uint32_t k = 0;
  while (k < s->n_visible && hsr_is_glass(s->glass, s->visible[k]))
    k++;
  if (k == s->n_visible)
    hsr_glass_clear(s->glass, rgb);
  else
    hsr_glass_over(s->glass, s->visible[k], rgb);
  (void)left, (void)right; /* for the trace */
  while (k--) {
    HSR_STEP(s->edges.tally, COMBINED, HSR_FACE(s->visible[k]), HSR_THE_WINDOW,
             HSR_ON(left, right, s->j), 0);
    hsr_glass_over(s->glass, s->visible[k], rgb);
  }
}

/* A span of a transparent picture, divided where the order in depth changes. */
static void decide_glass(struct scan *s, int left, int right) {
  for (int end; left < right; left = end) {
    uint16_t rgb[3] = {0};
    sort_by_depth(s, left);
    end = order_end(s, left, right);
    combine(s, left, end, rgb);
    HSR_ACCEPTED(s->edges.tally, SPANS,
                 HSR_FACE(s->n_visible ? s->visible[0] : HSR_BACKGROUND),
                 HSR_THE_WINDOW, HSR_ON(left, end, s->j), rgb);
    HSR_TOUCH_SPAN(s->edges.tally, left, end, s->j);
    hsr_glass_show(s->glass, rgb, left, end, s->j);
  }
}

static void decide_span(struct scan *s, int left, int right) {
  if (s->glass) {
    decide_glass(s, left, right);
    return;
  }
  uint32_t first = HSR_BACKGROUND, last = HSR_BACKGROUND;
  if (s->n_visible) {
    first = search_depth(s, s->visible[0], left);
    last = left + 1 < right ? search_depth(s, first, right - 1) : first;
  }
  show_span(s, first, last, left, right);
}

/* A span ends, and the next one begins, at every edge crossing. */
static void scan_row(struct scan *s) {
  const struct hsr_window *w = s->edges.window;
  int left = w->x0;
  for (uint32_t k = 0; k < s->edges.n_list; k++) {
    const struct hsr_scan_edge *edge = &s->edges.edge[s->edges.list[k]];
    if (edge->column == HSR_NO_COLUMN)
      break;
    int right = edge->column < w->x1 ? edge->column : w->x1;
    if (left < right) {
      decide_span(s, left, right);
      left = right;
    }
    turn_bit(s, edge, left);
  }
  if (left < w->x1)
    decide_span(s, left, w->x1);
}

/* --- The algorithm -------------------------------------------------------- */

static enum hsr_status allocate(struct scan *s) {
  const struct hsr_job *job = s->edges.job;
  size_t n_faces = job->world->n_faces;
  s->visible = HSR_NEW(job->scratch, uint32_t, s->edges.screen.n_relevant);
  s->place = HSR_NEW(job->scratch, uint32_t, n_faces);
  if (!s->visible || !s->place)
    return HSR_E_NOMEM;
  for (size_t f = 0; f < n_faces; f++)
    s->place[f] = NONE;
  return HSR_OK;
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct scan scan = {.n_visible = 0};
  struct hsr_glass glass;
  struct hsr_shadow_pairs pairs;
  if (hsr_scan_begin(&scan.edges, job) || allocate(&scan) ||
      (hsr_answer_colours_of(job->answer) && hsr_glass_begin(&glass, job)) ||
      (hsr_answer_lit_of(job->answer) &&
       hsr_shadow_pairs_begin(&pairs, job, &scan.edges.screen)))
    return hsr_fail_nomem(err);
  scan.glass = hsr_answer_colours_of(job->answer) ? &glass : NULL;
  scan.pairs = hsr_answer_lit_of(job->answer) ? &pairs : NULL;

  const struct hsr_window *w = &job->view->window;
  for (scan.j = w->y0; scan.j < w->y1; scan.j++) {
    hsr_scan_advance(&scan.edges, scan.j);
    if (job->answer->ids)
      scan.ids = hsr_job_row(job, scan.j);
    scan_row(&scan);
  }
  return HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {
    {&hsr_scan_part}, {&hsr_shadow_part}, {&hsr_shadow_pairs_part}, {NULL}};

static const struct hsr_counter counters[] = {
    [SPAN_CULL] = {"span cull", "visible bits turned on or off", HSR_ACTIVATE,
                   HSR_OF_FACE, HSR_OF_EDGE, "turned off|turned on"},
    [DEPTH_SEARCH] = {"depth search", "comparisons of two faces in depth",
                      HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, "farther|nearer",
                      .key = "depth-search"},
    [DIVISIONS] = {"span divisions", "spans divided where two faces penetrate",
                   HSR_SUBDIVIDE, HSR_OF_FACE, HSR_OF_FACE,
                   .key = "span-division"},
    [COMBINED] = {"combined", "transparent faces put over what is behind",
                  HSR_SAMPLE, HSR_OF_FACE, HSR_OF_WINDOW},
    [SPANS] = {"spans", "sample spans shown", HSR_ACCEPT, HSR_OF_FACE,
               HSR_OF_WINDOW, .key = "span"},
    {NULL}};

static const struct hsr_line outline[] = {
    {"", .part = &hsr_scan_part},
    {"  for each sample span: from one edge of the list to the next"},
    {"    turn the visible bit of the edge's face on or off",
     HSR_RAISES(SPAN_CULL)},
    {"    search the faces whose bit is on for the nearest at both limits",
     HSR_RAISES(DEPTH_SEARCH)},
    {"    if these are two faces, divide the span where they penetrate",
     HSR_RAISES(DIVISIONS)},
    {"    put the transparent ones over the nearest opaque one",
     HSR_RAISES(COMBINED)},
    {"    show the nearest face in the span", HSR_RAISES(SPANS)},
    {"    ", .part = &hsr_shadow_pairs_part},
    {NULL}};

static const struct hsr_step steps[] = {
    {"span cull", SPAN_CULL, HSR_KIND_LINE, "n S_l", hsr_predict_span_cull},
    {"depth search", DEPTH_SEARCH, HSR_KIND_SPAN, "30 n D_c min(m, 2 S_v)",
     hsr_predict_depth_search},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {.part = &hsr_scan_part},
    {"faces", "X", "cull by visible bits", "once an edge crossing"},
    {"faces", "Z", "exhaustive search", "at both limits of a sample span"},
    {NULL}};

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
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}, {HSR_TRANSPARENT}, {HSR_SHADOWED}},
    .sorts = sorts,
    .parts = uses,
    .counters = counters,
    .steps = steps,
    .outline = outline,
    .render = render};
