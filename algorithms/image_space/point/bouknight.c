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
 * Options     What Sutherland et al. propose in chapter IV. In a transparent
 *             picture they are not used.
 *             - regions=carried: Romney's notion for any region that no edge
 *             crosses ("Existing Uses of Coherence", "Scan-Line Coherence").
 *             bouknight_regions.c.
 *             - implied=carried: "Implied-edge coherence" of the list of
 *             coherences (bouknight_implied.c).
 *             - depth=list: a list of the active faces by depth ("Depth
 *             Coherence", bouknight_list.c).
 * Cost        span cull n S_l, depth search 30 n D_c min(m, 2 S_v), and those
 *             of scan_line.h: Table III has one column for Watkins and
 *             Bouknight, though the latter's spans are up to 2 S_l a line. The
 *             formula tests a segment once a line; here its bit is turned on
 *             and off, so that it counts twice in the span cull. A face that is
 *             compared at both limits costs 30 twice; the formula charges it
 *             once a span */
#include "algorithms/image_space/point/bouknight.h"
#include "common/answers/kinds/shadowed.h"
#include "common/answers/kinds/transparent.h"

#include <string.h>

enum { REGIONS, IMPLIED, DEPTH }; /* options */
enum { DECIDE, CARRY };
static const struct hsr_word regions[] = {
    [DECIDE] = {"decided", "each sample span is decided anew", 0},
    [CARRY] = {"carried",
               "one whose edges are those of the line before is carried", 0},
    {NULL}};
enum { CALCULATE, EXTRAPOLATE };
static const struct hsr_word implied[] = {
    [CALCULATE] = {"calculated", "they are found anew on each line", 0},
    [EXTRAPOLATE] = {"carried", "from two lines on, they are extrapolated", 0},
    {NULL}};
enum { SEARCH, LIST };
static const struct hsr_word depths[] = {
    [SEARCH] = {"search", "for the nearest, at both limits of a span", 0},
    [LIST] = {"list", "kept in order of depth; the options above are not used",
              0},
    {NULL}};
static const struct hsr_option options[] = {
    [REGIONS] = {"regions", "where no edges cross", regions, 0, CARRY, DECIDE},
    [IMPLIED] = {"implied", "edges where faces penetrate", implied, 0,
                 EXTRAPOLATE, CALCULATE},
    [DEPTH] = {"depth", "the faces of a span in an opaque picture", depths, 0,
               LIST, SEARCH},
    {NULL}};

static const uint32_t NONE = BOUKNIGHT_NONE;

/* --- Span cull ------------------------------------------------------------ */

/* Turns the visible bit of an edge's face on or off. `left`: where the next
 * span begins. */
static void turn_bit(struct bouknight *s, const struct hsr_scan_edge *edge,
                     int left) {
  uint32_t f = edge->face;
  bouknight_count_bit(s, edge, s->place[f] == NONE, left);
  if (s->place[f] == NONE) {
    s->place[f] = s->n_visible;
    s->visible[s->n_visible++] = f;
  } else if (s->glass) {
    bouknight_take_out(s, f);
  } else {
    uint32_t last = s->visible[--s->n_visible];
    s->visible[s->place[f]] = last;
    s->place[last] = s->place[f];
    s->place[f] = NONE;
  }
}

/* --- Depth search --------------------------------------------------------- */

static uint32_t search_depth(struct bouknight *s, uint32_t nearest, int i) {
  return bouknight_search(s, nearest, NONE, i);
}

/* Sorts the visible faces by depth at sample i, from the order that they have.
 */
static void sort_by_depth(struct bouknight *s, int i) {
  for (uint32_t k = 1; k < s->n_visible; k++) {
    uint32_t f = s->visible[k], at = k;
    for (; at && bouknight_is_nearer(s, f, s->visible[at - 1], i); at--)
      bouknight_put_at(s, s->visible[at - 1], at);
    bouknight_put_at(s, f, at);
  }
}

/* Up to where in [left, right) the order of sample `left` holds. */
static int order_end(struct bouknight *s, int left, int right) {
  for (uint32_t k = 1; k < s->n_visible && left + 1 < right; k++) {
    uint32_t f = s->visible[k - 1], g = s->visible[k];
    if (bouknight_is_nearer(s, f, g, right - 1))
      continue;
    HSR_STEP(s->edges.tally, BOUKNIGHT_DIVISIONS, HSR_FACE(f), HSR_FACE(g),
             HSR_ON(left, right, s->j), 0);
    right = hsr_scan_crossing(&s->edges, f, g, true, left, right, s->j,
                              BOUKNIGHT_SEARCH);
  }
  return right;
}

/* --- Sample spans --------------------------------------------------------- */

static void write_span(struct bouknight *s, uint32_t id, int left, int right) {
  HSR_STEP(s->edges.tally, BOUKNIGHT_SPANS, HSR_FACE(id), HSR_THE_WINDOW,
           HSR_ON(left, right, s->j), 0);
  HSR_TOUCH_SPAN(s->edges.tally, left, right, s->j);
  for (int i = left; i < right; i++)
    s->ids[i] = id;
  if (s->pairs && hsr_shadow_pairs_show(s->pairs, id, left, right, s->j))
    s->edges.tally->out_of_memory = true;
}

/* Writes a span, divided where the nearest face changes. */
static void show_span(struct bouknight *s, uint32_t first, uint32_t last,
                      int left, int right) {
  while (first != last) {
    HSR_STEP(s->edges.tally, BOUKNIGHT_DIVISIONS, HSR_FACE(first),
             HSR_FACE(last), HSR_ON(left, right, s->j), 0);
    int middle = hsr_scan_crossing(&s->edges, first, last, true, left, right,
                                   s->j, BOUKNIGHT_SEARCH);
    uint32_t before = search_depth(s, first, middle - 1);
    show_span(s, first, before, left, middle);
    first = search_depth(s, last, middle);
    left = middle;
  }
  write_span(s, first, left, right);
}

/* The colour of the visible faces, from the first opaque one on. */
static void combine(struct bouknight *s, int left, int right, uint16_t rgb[3]) {
  uint32_t k = 0;
  while (k < s->n_visible && hsr_is_glass(s->glass, s->visible[k]))
    k++;
  if (k == s->n_visible)
    hsr_glass_clear(s->glass, rgb);
  else
    hsr_glass_over(s->glass, s->visible[k], rgb);
  (void)left, (void)right; /* for the trace */
  while (k--) {
    HSR_STEP(s->edges.tally, BOUKNIGHT_COMBINED, HSR_FACE(s->visible[k]),
             HSR_THE_WINDOW, HSR_ON(left, right, s->j), 0);
    hsr_glass_over(s->glass, s->visible[k], rgb);
  }
}

/* A span of a transparent picture, divided where the order in depth changes. */
static void decide_glass(struct bouknight *s, int left, int right) {
  for (int end; left < right; left = end) {
    uint16_t rgb[3] = {0};
    sort_by_depth(s, left);
    end = order_end(s, left, right);
    combine(s, left, end, rgb);
    HSR_ACCEPTED(s->edges.tally, BOUKNIGHT_SPANS,
                 HSR_FACE(s->n_visible ? s->visible[0] : HSR_BACKGROUND),
                 HSR_THE_WINDOW, HSR_ON(left, end, s->j), rgb);
    HSR_TOUCH_SPAN(s->edges.tally, left, end, s->j);
    hsr_glass_show(s->glass, rgb, left, end, s->j);
  }
}

void bouknight_write(struct bouknight *s, uint32_t id, int left, int right) {
  write_span(s, id, left, right);
}

static void search_span(struct bouknight *s, uint32_t k, int left, int right) {
  uint32_t edge = k ? s->edges.list[k - 1] : HSR_NO_ID;
  uint32_t first = HSR_BACKGROUND, last = HSR_BACKGROUND;
  if (s->implied && bouknight_extrapolate(s, edge, left, right))
    return;
  if (s->n_visible) {
    first = search_depth(s, s->visible[0], left);
    last = left + 1 < right ? search_depth(s, first, right - 1) : first;
  }
  show_span(s, first, last, left, right);
  if (s->implied && first != last)
    bouknight_note_implied(s, edge, first, last);
  if (s->regions && first == last && s->n_visible > 1)
    bouknight_note_region(s, first, k, left, right);
}

/* The span behind place k of the list. */
static void decide_span(struct bouknight *s, uint32_t k, int left, int right) {
  if (s->regions && bouknight_carry(s, k, left, right))
    return;
  if (left >= right)
    return;
  if (s->glass)
    decide_glass(s, left, right);
  else
    search_span(s, k, left, right);
}

/* A span ends, and the next one begins, at every edge crossing. */
static void scan_row(struct bouknight *s) {
  const struct hsr_window *w = s->edges.window;
  int left = w->x0;
  uint32_t k = 0;
  for (; k < s->edges.n_list; k++) {
    const struct hsr_scan_edge *edge = &s->edges.edge[s->edges.list[k]];
    int right = edge->column < w->x1 ? edge->column : w->x1;
    decide_span(s, k, left, right);
    if (left < right)
      left = right;
    turn_bit(s, edge, left);
  }
  decide_span(s, k, left, w->x1);
}

/* --- The algorithm -------------------------------------------------------- */

static enum hsr_status allocate(struct bouknight *s) {
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

/* Makes ready for the options. In a transparent picture there are none. */
static enum hsr_status choose_options(struct bouknight *s,
                                      const struct hsr_job *job,
                                      struct hsr_regions *carried) {
  if (s->glass)
    return HSR_OK;
  if (job->option[DEPTH] == LIST)
    return bouknight_begin_list(s);
  if (job->option[IMPLIED] == EXTRAPOLATE && bouknight_begin_implied(s))
    return HSR_E_NOMEM;
  if (job->option[REGIONS] != CARRY)
    return HSR_OK;
  return bouknight_begin_regions(s, carried);
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct bouknight scan = {.n_visible = 0};
  struct hsr_glass glass;
  struct hsr_shadow_pairs pairs;
  if (hsr_scan_begin(&scan.edges, job) || allocate(&scan) ||
      (hsr_answer_colours_of(job->answer) && hsr_glass_begin(&glass, job)) ||
      (hsr_answer_lit_of(job->answer) &&
       hsr_shadow_pairs_begin(&pairs, job, &scan.edges.screen)))
    return hsr_fail_nomem(err);
  scan.glass = hsr_answer_colours_of(job->answer) ? &glass : NULL;
  scan.pairs = hsr_answer_lit_of(job->answer) ? &pairs : NULL;
  struct hsr_regions carried;
  if (choose_options(&scan, job, &carried))
    return hsr_fail_nomem(err);

  const struct hsr_window *w = &job->view->window;
  for (scan.j = w->y0; scan.j < w->y1; scan.j++) {
    hsr_scan_advance(&scan.edges, scan.j);
    if (job->answer->ids)
      scan.ids = hsr_job_row(job, scan.j);
    if (scan.regions)
      hsr_regions_open(scan.regions, scan.j);
    if (scan.list)
      bouknight_scan_list(&scan);
    else
      scan_row(&scan);
    if (scan.regions)
      hsr_regions_close(scan.regions);
  }
  return HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {
    {&hsr_scan_part}, {&hsr_shadow_part}, {&hsr_shadow_pairs_part}, {NULL}};

static const struct hsr_counter counters[] = {
    [BOUKNIGHT_CULL] = {"span cull", "visible bits turned on or off",
                        HSR_ACTIVATE, HSR_OF_FACE, HSR_OF_EDGE,
                        "turned off|turned on"},
    [BOUKNIGHT_SEARCH] = {"depth search", "comparisons of two faces in depth",
                          HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE,
                          "farther|nearer", .key = "depth-search"},
    [BOUKNIGHT_DIVISIONS] = {"span divisions",
                             "spans divided where two faces penetrate",
                             HSR_SUBDIVIDE, HSR_OF_FACE, HSR_OF_FACE,
                             .key = "span-division"},
    [BOUKNIGHT_COMBINED] = {"combined",
                            "transparent faces put over what is behind",
                            HSR_SAMPLE, HSR_OF_FACE, HSR_OF_WINDOW},
    [BOUKNIGHT_SPANS] = {"spans", "sample spans shown", HSR_ACCEPT, HSR_OF_FACE,
                         HSR_OF_WINDOW, .key = "span"},
    [BOUKNIGHT_TESTS] = {"order tests",
                         "edges compared with those in their places on the "
                         "line before",
                         HSR_COMPARE, HSR_OF_EDGE, HSR_OF_NOTHING,
                         "another edge|the same edge"},
    [BOUKNIGHT_ENDINGS] = {"endings",
                           "edges of a decided span: do they end on the line?",
                           HSR_COMPARE, HSR_OF_EDGE, HSR_OF_NOTHING,
                           "ends|goes on"},
    [BOUKNIGHT_FORECASTS] =
        {"forecasts",
         "predictions of where, along an edge, one comes to "
         "be nearer than the visible face",
         HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, "on the next line|later"},
    [BOUKNIGHT_DECIDED] =
        {"spans decided",
         "sample spans of several faces, of which one is visible, decided anew",
         HSR_SPAN, HSR_OF_FACE, HSR_OF_WINDOW},
    [BOUKNIGHT_CARRIED] = {"spans carried",
                           "sample spans of several faces whose decision is "
                           "that of the line before",
                           HSR_SPAN, HSR_OF_FACE, HSR_OF_WINDOW},
    [BOUKNIGHT_POINTS] = {"penetrations",
                          "penetration points calculated of two planes",
                          HSR_SAMPLE, HSR_OF_FACE, HSR_OF_FACE},
    [BOUKNIGHT_PREDICTED] = {"extrapolations",
                             "penetration points extrapolated from two lines",
                             HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE,
                             "outside of the span|inside"},
    [BOUKNIGHT_VERIFIED] = {"verifications",
                            "of these, points that samples beside them were to "
                            "prove",
                            HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE},
    [BOUKNIGHT_FAILED] = {"failures", "of these, points that were not there",
                          HSR_REJECT, HSR_OF_FACE, HSR_OF_FACE},
    [BOUKNIGHT_MOVED] = {"moves",
                         "faces moved by one place in the list by "
                         "depth",
                         HSR_SORT, HSR_OF_FACE, HSR_OF_FACE},
    {NULL}};

static const struct hsr_line outline[] = {
    {"", .part = &hsr_scan_part},
    {"  for each sample span: from one edge of the list to the next"},
    {"    turn the visible bit of the edge's face on or off",
     HSR_RAISES(BOUKNIGHT_CULL)},
    {"    search the faces whose bit is on for the nearest at both limits",
     HSR_RAISES(BOUKNIGHT_SEARCH)},
    {"    if these are two faces, divide the span where they penetrate",
     HSR_RAISES(BOUKNIGHT_DIVISIONS)},
    {"    put the transparent ones over the nearest opaque one",
     HSR_RAISES(BOUKNIGHT_COMBINED)},
    {"    show the nearest face in the span", HSR_RAISES(BOUKNIGHT_SPANS)},
    {"    ", .part = &hsr_shadow_pairs_part},
    {"    where regions are carried: are the edges those of the line before?",
     HSR_RAISES(BOUKNIGHT_TESTS)},
    {"      then carry the visible face of the span over",
     HSR_RAISES(BOUKNIGHT_CARRIED)},
    {"      else decide, and predict up to which line that will hold",
     HSR_RAISES(BOUKNIGHT_DECIDED, BOUKNIGHT_ENDINGS, BOUKNIGHT_FORECASTS)},
    {"    where implied edges are carried: calculate two points of each",
     HSR_RAISES(BOUKNIGHT_POINTS)},
    {"      on further lines extrapolate, and look on both sides",
     HSR_RAISES(BOUKNIGHT_PREDICTED, BOUKNIGHT_VERIFIED, BOUKNIGHT_FAILED)},
    {"    where a list is kept by depth: move faces in it, by comparisons",
     HSR_RAISES(BOUKNIGHT_MOVED)},
    {NULL}};

static const struct hsr_step steps[] = {
    {"span cull",
     BOUKNIGHT_CULL,
     HSR_KIND_LINE,
     "n S_l",
     hsr_predict_span_cull,
     {{BOUKNIGHT_TESTS, HSR_KIND_NUMBERS},
      {BOUKNIGHT_ENDINGS, HSR_KIND_NUMBERS}}},
    {"depth search",
     BOUKNIGHT_SEARCH,
     HSR_KIND_SPAN,
     "30 n D_c min(m, 2 S_v)",
     hsr_predict_depth_search,
     {{BOUKNIGHT_FORECASTS, HSR_KIND_TWO_SEGMENTS},
      {BOUKNIGHT_PREDICTED, HSR_KIND_NUMBERS},
      {BOUKNIGHT_MOVED, HSR_KIND_LINK}}},
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
    .options = options,
    .render = render};
