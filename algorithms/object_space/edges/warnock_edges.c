/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Warnock's sorted edges: Appel's algorithm, its crossings found by sorting.
 *
 * Source      Sutherland et al. 1974, "Other Combinations of Sorting", which
 *             reports in one paragraph what J. E. Warnock proposed; the
 *             promotion is that of edge_intersection.h.
 * Notation    active edge list -> list[], sorted by the left ends of the
 *             edges' covers; interchange -> two neighbours that a bubble sort
 *             exchanges
 * Cover       The cover of an edge is where it may be at the current Y. An
 *             image known in doubles is within HSR_DELTA of the true one. So
 *             the edge, displaced or not, is in
 *                 [left, right] = x0 + slope (Y - y0) -+ half,
 *             half = 2 HSR_DELTA (1 + |slope|), at any Y from HSR_DELTA above
 *             its true upper end to HSR_DELTA below its lower one. An image
 *             that is nearly level may be anywhere between its ends. Both
 *             bounds are linear in Y. An edge is active from 2 HSR_DELTA above
 *             its upper end to 2 HSR_DELTA below its lower one.
 * Invariants  Images that meet do so at a Y between two neighbouring entries
 *             (or exits) at both of which both are active. If their covers have
 *             no place in common at either, the edges have changed sides,
 *             because covers are linear; then the bubble sort exchanges them.
 *             So every pair of edges whose images cross or touch is noted: at
 *             an exchange, or where their covers first have a place in common.
 * Rounding    Coordinates are less than 2^15, widths less than 2^17. A cover is
 *             computed within 2^-33, and the Y of entries within 2^-37, which
 *             moves a cover by 2^-29 where the slope is less than 2^8. Half
 *             of the 2 HSR_DELTA = 2^-25 is kept for these errors.
 * Ties        A pair noted is put to the exact test, in which one edge is
 *             displaced: once with each of the two.
 * Departures  The list is sorted again where edges leave it, too, since an edge
 *             that begins and ends between two entries may cross others. Pairs
 *             whose order is uncertain are noted as interchanges are. Edges
 *             with an end that is behind the eye, before near, or known by
 *             exact numbers only (implied edges) are compared with all, as in
 *             Appel's algorithm.
 * Cost        The survey gives no formula. The list holds about as many edges
 *             as a scan line meets, which grows as (E_s D_c)^1/2, and is gone
 *             through at every entry and exit: E_s^1.5 comparisons of two
 *             numbers. The pairs left to the exact test grow as the crossings
 *             of the picture, X_r. Of Appel's steps the initial visibility,
 *             C_t F_r, is then the one that grows fastest. */
#include "algorithms/object_space/edges/active_edges.h"
#include "algorithms/object_space/edges/edge_intersection.h"
#include "common/answers/kinds/segments.h"

enum {
  BUCKET_SORT,
  X_MERGE,
  BUBBLE_SORT,
  INTERCHANGES,
  UNCERTAIN,
  NOTED,
  CONFIRMED,
  UNPLACED
};

struct note {
  uint32_t e, c; /* contour edge c may change what hides e */
};

struct sweep {
  struct hsr_network *network;

  /* The edges whose images are known: as they enter, and as they leave. */
  uint32_t *entering, *leaving, n;
  double *top, *bottom; /* by edge */

  struct hsr_active_edges list;
  double *enters_at; /* by edge: left when it enters */

  struct hsr_growing noted; /* of struct note */
  size_t *start;            /* by edge: where its own begin in */
  uint32_t *c;              /* the contour edges noted */
  uint32_t *tried;          /* by edge: the last e that it was tried with */

  uint32_t *unplaced, n_unplaced; /* contour edges whose images are not known */
};

static bool is_placed(const struct hsr_network *network, uint32_t e) {
  return network->box[e].x0 > -INFINITY;
}

/* --- The bucket sort by northmost Y --------------------------------------- */

/* Sifts item k of a heap of n, the greatest key on top; keys are the items'. */
static void sift(const double *key, uint32_t *item, uint32_t k, uint32_t n) {
  uint32_t sinking = item[k];
  for (uint32_t child; (child = 2 * k + 1) < n; k = child) {
    if (child + 1 < n && key[item[child]] < key[item[child + 1]])
      child++;
    if (key[sinking] >= key[item[child]])
      break;
    item[k] = item[child];
  }
  item[k] = sinking;
}

static void sort_bucket(const double *key, uint32_t *item, uint32_t n) {
  for (uint32_t k = n / 2; k-- > 0;)
    sift(key, item, k, n);
  for (uint32_t last = n; last-- > 1;) {
    uint32_t greatest = item[0];
    item[0] = item[last];
    item[last] = greatest;
    sift(key, item, 0, last);
  }
}

/* The bucket of y. There is one for each row, one for all above the picture and
 * one for all below. */
static uint32_t bucket_of(const struct hsr_view *view, double y) {
  return y < 0 ? 0 : y >= view->n ? (uint32_t)view->n + 1 : (uint32_t)y + 1;
}

/* Sorts the n edges by their keys. HSR_E_NOMEM. */
static enum hsr_status sort_by_y(const struct sweep *s, const double *key,
                                 uint32_t *item) {
  const struct hsr_job *job = s->network->job;
  uint32_t n_buckets = (uint32_t)job->view->n + 2;
  uint32_t *end = HSR_NEW_ZEROED(job->scratch, uint32_t, n_buckets + 1);
  uint32_t *sorted = HSR_NEW(job->scratch, uint32_t, s->n);
  if (!end || !sorted)
    return HSR_E_NOMEM;
  for (uint32_t k = 0; k < s->n; k++)
    end[bucket_of(job->view, key[item[k]]) + 1]++;
  for (uint32_t b = 0; b < n_buckets; b++)
    end[b + 1] += end[b];
  for (uint32_t k = 0; k < s->n; k++) {
    HSR_STEP(job->tally, BUCKET_SORT,
             hsr_edge_subject(s->network->edges, item[k]), HSR_NOTHING,
             HSR_NOWHERE, key == s->bottom);
    sorted[end[bucket_of(job->view, key[item[k]])]++] = item[k];
  }
  for (uint32_t b = 0, begin = 0; b < n_buckets; begin = end[b++])
    sort_bucket(key, sorted + begin, end[b] - begin);
  for (uint32_t k = 0; k < s->n; k++)
    item[k] = sorted[k];
  return HSR_OK;
}

/* --- Covers --------------------------------------------------------------- */

static struct hsr_active activate(const struct sweep *s, uint32_t e) {
  const struct hsr_sight *sight = &s->network->sight;
  uint32_t a = sight->edges->a[e], b = sight->edges->b[e];
  double x0 = sight->sx[a], y0 = sight->sy[a];
  double dx = sight->sx[b] - x0, dy = sight->sy[b] - y0;
  struct hsr_active edge = {.e = e, .x0 = x0, .y0 = y0, .end_y = s->bottom[e]};
  if (fabs(dx) < 256 * fabs(dy)) {
    edge.slope = dx / dy;
    edge.half = 2 * HSR_DELTA * (1 + fabs(edge.slope));
  } else { /* nearly level, or a point */
    edge.x0 += dx / 2;
    edge.half = fabs(dx) / 2 + 2 * HSR_DELTA;
  }
  return edge;
}

/* --- Notes ---------------------------------------------------------------- */

static bool note_one(struct sweep *s, uint32_t e, uint32_t c) {
  const struct hsr_network *network = s->network;
  if (!network->part[e].relevant || !network->net[c])
    return true;
  if (!hsr_arena_grow(network->job->scratch, &s->noted, sizeof(struct note)))
    return false;
  HSR_STEP(network->tally, NOTED, hsr_edge_subject(network->edges, e),
           hsr_edge_subject(network->edges, c), HSR_NOWHERE, 0);
  ((struct note *)s->noted.items)[s->noted.n - 1] = (struct note){e, c};
  return true;
}

/* The images of two edges may cross: either may hide the other. */
static bool note(struct sweep *s, uint32_t e, uint32_t c) {
  return hsr_edges_meet(s->network->edges, e, c) ||
         (note_one(s, e, c) && note_one(s, c, e));
}

/* --- The active edge list ------------------------------------------------- */

/* The first place from k on that is to be looked at, of n; so are those up to
 * *end. At place i nothing is found if a[i] < b[i]: the timed build passes over
 * many such places at once, and the counting build counts each. */
static uint32_t next_block(const double *a, const double *b, uint32_t k,
                           uint32_t n, uint32_t *end) {
  if (!HSR_COUNTING)
    k += hsr_active_edges_pass(a + k, b + k, n - k);
  *end = HSR_COUNTING || n - k < HSR_ACTIVE_BLOCK ? n : k + HSR_ACTIVE_BLOCK;
  return k;
}

static bool have_met(const struct hsr_active_edges *list, uint32_t k,
                     double was_left, double was_right) {
  return list->was_left[k] <= was_right && was_left <= list->was_right[k];
}

/* Whether the entry before place k of the list is right of edge e, whose cover
 * begins at `left`. */
static bool is_out_of_order(const struct sweep *s, uint32_t k, uint32_t e,
                            double left) {
  bool exchange = s->list.left[k - 1] > left;
  HSR_STEP(s->network->tally, BUBBLE_SORT,
           hsr_edge_subject(s->network->edges, e),
           hsr_edge_subject(s->network->edges, s->list.e[k - 1]), HSR_NOWHERE,
           exchange);
  return exchange;
}

/* Exchanges entry k, which is out of order, with its neighbours to the left
 * until it is in order. False if memory ran out. */
static bool exchange(struct sweep *s, uint32_t k) {
  struct hsr_active_edges *list = &s->list;
  struct hsr_active edge = hsr_active_edges_take(list, k);
  uint32_t place = k;
  do {
    place--;
    HSR_STEP(s->network->tally, INTERCHANGES,
             hsr_edge_subject(s->network->edges, edge.e),
             hsr_edge_subject(s->network->edges, list->e[place]), HSR_NOWHERE,
             0);
    /* Places that both cover, now or before, are found elsewhere. */
    if (list->left[place] > edge.right &&
        !have_met(list, place, edge.was_left, edge.was_right) &&
        !note(s, list->e[place], edge.e))
      return false;
  } while (place && is_out_of_order(s, place, edge.e, edge.left));
  hsr_active_edges_shift(list, place + 1, place, k - place);
  hsr_active_edges_put(list, place, &edge);
  return true;
}

/* Moves the list to another Y, and sorts it again. False if memory ran out. */
static bool bubble_sort(struct sweep *s, double y) {
  struct hsr_active_edges *list = &s->list;
  hsr_active_edges_move(list, y);
  for (uint32_t k = 1, end; k < list->n;) {
    k = 1 + next_block(list->left, list->left + 1, k - 1, list->n - 1, &end);
    for (; k <= end; k++)
      if (is_out_of_order(s, k, list->e[k], list->left[k]) && !exchange(s, k))
        return false;
  }
  return true;
}

/* Merges the n edges that enter at y. */
static void merge(struct sweep *s, uint32_t *edge, uint32_t n, double y) {
  struct hsr_active_edges *list = &s->list;
  for (uint32_t k = 0; k < n; k++) {
    struct hsr_active entry = activate(s, edge[k]);
    hsr_active_cover(&entry, y);
    s->enters_at[edge[k]] = entry.left;
  }
  sort_bucket(s->enters_at, edge, n);
  uint32_t beyond = list->n;
  list->n += n;
  while (n) {
    uint32_t place = beyond;
    for (bool right = true; place && right; place -= right) {
      right = list->left[place - 1] > s->enters_at[edge[n - 1]];
      HSR_STEP(s->network->tally, X_MERGE,
               hsr_edge_subject(s->network->edges, edge[n - 1]),
               hsr_edge_subject(s->network->edges, list->e[place - 1]),
               HSR_NOWHERE, right);
    }
    hsr_active_edges_shift(list, place + n, place, beyond - place);
    beyond = place;
    struct hsr_active entry = activate(s, edge[--n]);
    hsr_active_cover(&entry, y);
    entry.was_left = INFINITY;
    entry.was_right = -INFINITY;
    hsr_active_edges_put(list, place + n, &entry);
  }
}

/* Notes the pairs of entry k whose covers have a place in common for the first
 * time. False if memory ran out. */
static bool compare_cover(struct sweep *s, uint32_t k) {
  const struct hsr_active_edges *list = &s->list;
  for (uint32_t l = k + 1; l < list->n && list->left[l] <= list->right[k];
       l++) {
    bool met = have_met(list, k, list->was_left[l], list->was_right[l]);
    HSR_STEP(s->network->tally, UNCERTAIN,
             hsr_edge_subject(s->network->edges, list->e[k]),
             hsr_edge_subject(s->network->edges, list->e[l]), HSR_NOWHERE, met);
    if (!met && !note(s, list->e[k], list->e[l]))
      return false;
  }
  return true;
}

static bool compare_covers(struct sweep *s) {
  const struct hsr_active_edges *list = &s->list;
  for (uint32_t k = 0, end; k + 1 < list->n;) {
    k = next_block(list->right, list->left + 1, k, list->n - 1, &end);
    for (; k < end; k++)
      if (!compare_cover(s, k))
        return false;
  }
  return true;
}

/* Moves down the screen, from one Y where edges enter or leave to the next.
 * False if memory ran out. */
static bool sweep_down(struct sweep *s) {
  uint32_t in = 0, out = 0;
  while (out < s->n) {
    double y = s->bottom[s->leaving[out]];
    if (in < s->n && s->top[s->entering[in]] < y)
      y = s->top[s->entering[in]];
    uint32_t first = in;
    while (in < s->n && s->top[s->entering[in]] == y)
      in++;
    if (!bubble_sort(s, y))
      return false;
    merge(s, s->entering + first, in - first, y);
    if (!compare_covers(s))
      return false;
    if (s->bottom[s->leaving[out]] == y)
      hsr_active_edges_retire(&s->list, y);
    while (out < s->n && s->bottom[s->leaving[out]] == y)
      out++;
  }
  return true;
}

/* --- Noted crossings ------------------------------------------------------ */

/* Collects the notes of every edge. HSR_E_NOMEM. */
static enum hsr_status collect_notes(struct sweep *s) {
  struct hsr_arena *arena = s->network->job->scratch;
  const struct note *noted = s->noted.items;
  uint32_t n = s->network->edges->n;
  s->start = HSR_NEW_ZEROED(arena, size_t, (size_t)n + 2);
  s->c = HSR_NEW(arena, uint32_t, s->noted.n);
  if (!s->start || !s->c)
    return HSR_E_NOMEM;
  size_t *end = s->start + 1; /* moves on to the beginning of the next edge */
  for (size_t k = 0; k < s->noted.n; k++)
    end[noted[k].e + 1]++;
  for (uint32_t e = 0; e < n; e++)
    end[e + 1] += end[e];
  for (size_t k = 0; k < s->noted.n; k++)
    s->c[end[noted[k].e]++] = noted[k].c;
  return HSR_OK;
}

/* The exact test of e, displaced, against contour edge c. HSR_E_NOMEM. */
static enum hsr_status try_pair(struct sweep *s, uint32_t e, uint32_t c) {
  struct hsr_network *network = s->network;
  if (s->tried[c] == e) /* noted twice */
    return HSR_OK;
  s->tried[c] = e;
  enum hsr_crossing found = HSR_DO_NOT_CROSS;
  if (hsr_edges_meet(network->edges, e, c))
    found = HSR_SHARE_A_VERTEX;
  else if (hsr_images_cross(&network->sight, e, c))
    found = hsr_sight_nearer(&network->sight, e, c) ? HSR_CROSSES_NEARER
                                                    : HSR_CROSSES_FARTHER;
  hsr_network_compared(network, e, c, found);
  if (found < HSR_CROSSES_FARTHER)
    return HSR_OK;
  HSR_STEP(network->tally, CONFIRMED, hsr_edge_subject(network->edges, e),
           hsr_edge_subject(network->edges, c), HSR_NOWHERE,
           found == HSR_CROSSES_NEARER);
  if (found != HSR_CROSSES_NEARER)
    return HSR_OK;
  return hsr_network_cross(network, e, c, network->net[c]);
}

static enum hsr_status cross(void *context, struct hsr_network *network,
                             uint32_t e) {
  struct sweep *s = context;
  bool placed = is_placed(network, e);
  const uint32_t *others = placed ? s->unplaced : network->contour;
  uint32_t n_others = placed ? s->n_unplaced : network->n_contour;
  for (size_t k = s->start[e]; k < s->start[e + 1]; k++)
    if (try_pair(s, e, s->c[k]))
      return HSR_E_NOMEM;
  for (uint32_t k = 0; k < n_others; k++) {
    HSR_STEP(network->tally, UNPLACED, hsr_edge_subject(network->edges, e),
             hsr_edge_subject(network->edges, others[k]), HSR_NOWHERE, 0);
    if (try_pair(s, e, others[k]))
      return HSR_E_NOMEM;
  }
  return HSR_OK;
}

/* --- The frame ------------------------------------------------------------ */

static enum hsr_status allocate(struct sweep *s) {
  struct hsr_arena *arena = s->network->job->scratch;
  uint32_t n = s->network->edges->n;
  s->entering = HSR_NEW(arena, uint32_t, n);
  s->leaving = HSR_NEW(arena, uint32_t, n);
  s->top = HSR_NEW(arena, double, n);
  s->bottom = HSR_NEW(arena, double, n);
  s->enters_at = HSR_NEW(arena, double, n);
  s->tried = HSR_NEW(arena, uint32_t, n);
  s->unplaced = HSR_NEW(arena, uint32_t, s->network->n_contour);
  if (!s->entering || !s->leaving || !s->top || !s->bottom || !s->enters_at ||
      !s->tried || !s->unplaced)
    return HSR_E_NOMEM;
  return hsr_active_edges_make(&s->list, n, arena);
}

/* Chooses the relevant and contour edges: those to sort, and those whose images
 * are not known. */
static void choose_edges(struct sweep *s) {
  const struct hsr_network *network = s->network;
  for (uint32_t e = 0; e < network->edges->n; e++) {
    s->tried[e] = HSR_NO_ID;
    if (!network->part[e].relevant && !network->net[e])
      continue;
    if (is_placed(network, e)) { /* a box is HSR_DELTA wider than the image */
      s->top[e] = network->box[e].y0 - HSR_DELTA;
      s->bottom[e] = network->box[e].y1 + HSR_DELTA;
      s->entering[s->n] = s->leaving[s->n] = e;
      s->n++;
    } else if (network->net[e]) {
      s->unplaced[s->n_unplaced++] = e;
    }
  }
}

static enum hsr_status draw(struct hsr_network *network) {
  struct sweep s = {.network = network};
  if (allocate(&s))
    return HSR_E_NOMEM;
  choose_edges(&s);
  if (sort_by_y(&s, s.top, s.entering) || sort_by_y(&s, s.bottom, s.leaving) ||
      !sweep_down(&s) || collect_notes(&s))
    return HSR_E_NOMEM;
  return hsr_network_draw(
      network, &(struct hsr_intersector){.cross = cross, .context = &s});
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct hsr_network network;
  enum hsr_status status = hsr_network_init(&network, job, HSR_NOT_SORTED);
  if (!status)
    status = draw(&network);
  hsr_sight_free(&network.sight);
  return status ? hsr_fail_nomem(err) : HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {
    {&hsr_network_part}, {&hsr_hiding_number_part}, {NULL}};

static const struct hsr_counter counters[] = {
    [BUCKET_SORT] = {"bucket sort",
                     "edges put into buckets, to enter and to leave", HSR_SORT,
                     HSR_OF_EDGE, HSR_OF_NOTHING, "to enter|to leave"},
    [X_MERGE] = {"X merge", "comparisons to merge entering edges into the list",
                 HSR_COMPARE, HSR_OF_EDGE, HSR_OF_EDGE, "goes right|goes left"},
    [BUBBLE_SORT] = {"bubble sort",
                     "comparisons of neighbors to sort the list again",
                     HSR_COMPARE, HSR_OF_EDGE, HSR_OF_EDGE,
                     "in order|out of order"},
    [INTERCHANGES] = {"interchanges", "exchanges of neighbors in the list",
                      HSR_SORT, HSR_OF_EDGE, HSR_OF_EDGE, .key = "interchange"},
    [UNCERTAIN] = {"uncertain order",
                   "pairs of edges that cover places in "
                   "common, of which neither is the left "
                   "one for certain",
                   HSR_COMPARE, HSR_OF_EDGE, HSR_OF_EDGE,
                   "new|already at the Y before"},
    [NOTED] = {"crossings noted", "pairs tested exactly: relevant, contour",
               HSR_ACTIVATE, HSR_OF_EDGE, HSR_OF_EDGE},
    [CONFIRMED] = {"crossings confirmed", "pairs whose images cross",
                   HSR_COMPARE, HSR_OF_EDGE, HSR_OF_EDGE, "farther|nearer"},
    [UNPLACED] = {"unplaced pairs",
                  "pairs tested because the image of one is not known",
                  HSR_COMPARE, HSR_OF_EDGE, HSR_OF_EDGE},
    {NULL}};

static const struct hsr_line outline[] = {
    {"sort edges by their northmost Y into buckets", HSR_RAISES(BUCKET_SORT)},
    {"for each Y where edges enter or leave"},
    {"  bubble sort: compare neighbors of the active edge list in X",
     HSR_RAISES(BUBBLE_SORT)},
    {"    interchange them, which notes a crossing", HSR_RAISES(INTERCHANGES)},
    {"  merge entering edges into the list", HSR_RAISES(X_MERGE)},
    {"  for each pair whose order is uncertain: note a crossing",
     HSR_RAISES(UNCERTAIN)},
    {"  note a crossing if one is relevant and the other is a contour edge",
     HSR_RAISES(NOTED)},
    {"", .part = &hsr_network_part},
    {"    for each crossing noted: does the contour edge cross it?",
     HSR_RAISES(HSR_INTERSECT, HSR_OVERLAPS)},
    {"    the same for each edge whose image is not known",
     HSR_RAISES(UNPLACED)},
    {"      is the contour edge the nearer one?", HSR_RAISES(CONFIRMED)},
    {"", .part = &hsr_network_part, .group = HSR_LINES_AFTER_CROSSINGS},
    {NULL}};

static const struct hsr_step steps[] = {
    {"bucket sort", BUCKET_SORT, HSR_KIND_BUCKET},
    {"X merge", X_MERGE, HSR_KIND_LIST},
    {"bubble sort",
     BUBBLE_SORT,
     HSR_KIND_NUMBERS,
     NULL,
     NULL,
     {{INTERCHANGES, HSR_KIND_INTERCHANGE}}},
    {"uncertain order", UNCERTAIN, HSR_KIND_NUMBERS},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {"edges", "back-facing, contour", "cull", "once a frame"},
    {"edges", "northmost Y", "bucket sort", "once a frame"},
    {"entering edges", "X", "merge", "once an entry"},
    {"active edges", "X", "bubble sort", "once an entry or exit"},
    {"faces", "before a vertex", "exhaustive search", "once a cluster"},
    {"contour edges", "crossing in the picture plane, nearer",
     "exhaustive search among those noted", "once an edge"},
    {"faces", "before an edge's end", "cull", "twice an edge"},
    {"crossings", "along the edge", "sort", "once an edge"},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(warnock_edges) = {
    .name = "warnock-edges",
    .title = "Warnock's sorted edges, for Appel's crossings",
    .authors = "J. E. Warnock",
    .year = 1974,
    .source = "reported in Sutherland et al., Computing Surveys 6(1), 1974, "
              "at what lateral sorting would do for Appel's algorithm",
    .taxonomy = HSR_OBJECT_SPACE_EDGES,
    .coherence = "edge: visibility is promoted along edges that share a "
                 "vertex, and the order in X is kept from Y to Y",
    .restrictions = HSR_TP,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_SEGMENTS}},
    .sorts = sorts,
    .parts = uses,
    .counters = counters,
    .steps = steps,
    .outline = outline,
    .prepare = hsr_network_prepare,
    .render = render,
    .release = hsr_network_release};
