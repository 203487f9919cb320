/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Watkins' scan-line algorithm: floating sample spans and a logarithmic depth
 * search.
 *
 * Source      G. S. Watkins, "A real-time visible surface algorithm",
 *             UTECH-CSC-70-101, 1970; as described by Sutherland et al. 1974,
 *             "Scan-line Algorithms" and figures 27b and 28.
 * Notation    scan line -> row j; Y buckets, X sort list -> scan_line.h;
 *             segment -> struct hsr_watkins_segment, the samples [x0, x1) of a
 *             face on the row; sample span -> [left, right). The left end is
 *             fixed, and the right end floats to the left.
 * Invariant   in search_depth and float_right, `visible` is the nearest in
 *             [left, right) of the segments looked at so far; right never moves
 *             to the right
 * Ties        of two faces in one plane the lower id is nearer, and no search
 *             is made; otherwise hsr_nearer decides
 * Departures  - Those of scan_line.h.
 *             - The depths at a segment's ends are compared with their error
 *             bounds. What is left undecided at a single sample is compared
 *             exactly, by the planes.
 *             - Faces may penetrate: if the order of two segments changes
 *             within a span, the search finds the sample where it does, and the
 *             span ends there.
 * Options     What Sutherland et al. propose in chapter IV:
 *             - x-list=tree: the X sort list is a tree ("Other Combinations of
 *             Sorting").
 *             - presort=x: edges are sorted by X before the Y sort ("Area
 *             Coherence"). The survey sorts by the X of the upper vertex; here
 *             it is the column on the edge's first row, which puts two edges of
 *             one vertex in order, too.
 *             - sort=crossing: no sort until an edge crosses its neighbor
 *             ("Scan-Line Coherence"). The sort is saved, but not the
 *             intercepts of hidden edges. These three are in x_list.c.
 *             - z=buckets: Z buckets (watkins_z.c).
 *             - ends=contour: sample spans end at contour edges only ("Edge
 *             Coherence", watkins_runs.c).
 *             - regions=carried: what is visible in a region that no edge
 *             crosses is carried to the next line ("Existing Uses of
 *             Coherence", "Scan-Line Coherence", watkins_regions.c).
 *             - spans=seen: a search begins with what was visible above
 *             ("Frame and Object Coherence", watkins_seen.c).
 * Cost        span cull n S_l, depth search 30 n D_c min(m, 2 S_v), and those
 *             of scan_line.h. The paper charges each element of a span; here a
 *             search is a pair, so that the first element, or a lone one, is
 *             free, as in bouknight.c. A crossing that is predicted costs 10,
 *             as other relations of two segments in the plane do. */
#include "algorithms/image_space/point/watkins.h"
#include "common/base/numbers.h"

#include <stdlib.h>

enum {
  Z_SORT,
  Z_COMPARE,
  JOINTS,
  ORDER_TESTS,
  ENDINGS,
  FORECASTS,
  DECIDED,
  CARRIED,
  PASSED,
  GUESSES
};

enum { X_LIST, PRESORT, SORT, Z, ENDS, REGIONS, SPANS }; /* options */
enum { LIST, TREE };
enum { NO_PRESORT, BY_X };
enum { EACH_LINE, CROSSING };
static const struct hsr_word lists[] = {
    [LIST] = {"list", "a list, into which edges are merged", 0},
    [TREE] = {"tree", "a binary tree, into which edges are inserted", 0},
    {NULL}};
static const struct hsr_word presorts[] = {
    [NO_PRESORT] = {"none", "each Y bucket is sorted as it is merged", 0},
    [BY_X] = {"x", "by X, so that each Y bucket is in order", 0},
    {NULL}};
static const struct hsr_word waits[] = {
    [EACH_LINE] = {"each-line", "on each scan line", 0},
    [CROSSING] = {"crossing",
                  "where a new edge enters, or a crossing was predicted", 0},
    {NULL}};
enum { SEARCH, Z_BUCKETS };
static const struct hsr_word depths[] = {
    [SEARCH] = {"search", "by the search in depth alone", 0},
    [Z_BUCKETS] = {"buckets", "by their faces' Z buckets, if these tell", 0},
    {NULL}};
enum { ANY_EDGE, CONTOUR };
static const struct hsr_word ends[] = {
    [ANY_EDGE] = {"edge", "at any edge", 0},
    [CONTOUR] = {"contour", "at contour edges, where surfaces do not meet", 0},
    {NULL}};
enum { DECIDE, CARRY };
static const struct hsr_word regions[] = {
    [DECIDE] = {"decided", "each sample span is decided anew", 0},
    [CARRY] = {"carried",
               "one whose edges are those of the line before is carried; not "
               "with ends=contour",
               0},
    {NULL}};
enum { IN_ORDER, SEEN };
static const struct hsr_word first_ones[] = {
    [IN_ORDER] = {"in-order", "the leftmost segment", 0},
    [SEEN] = {"seen", "the face that was visible there on the line before", 0},
    {NULL}};
static const struct hsr_option options[] = {
    [X_LIST] = {"x-list", "what the X sort list is", lists, 0, TREE, LIST},
    [PRESORT] = {"presort", "how edges are sorted before the Y sort", presorts,
                 0, BY_X, NO_PRESORT},
    [SORT] = {"sort", "when neighbors in the X sort list are compared", waits,
              0, CROSSING, EACH_LINE},
    [Z] = {"z", "how segments are compared in depth", depths, 0, Z_BUCKETS,
           SEARCH},
    [ENDS] = {"ends", "where sample spans may end", ends, 0, CONTOUR, ANY_EDGE},
    [REGIONS] = {"regions", "where no edges cross", regions, 0, CARRY, DECIDE},
    [SPANS] = {"spans", "what is searched first in a sample span", first_ones,
               0, SEEN, IN_ORDER},
    {NULL}};

/* No segment. */
static const uint32_t NONE = UINT32_MAX;

/* --- Segments ------------------------------------------------------------- */

/* Sets the right end of a segment, and clips it to the window. */
static void close_segment(struct hsr_watkins *s, uint32_t number, int x1) {
  struct hsr_watkins_segment *segment = &s->segment[number];
  const struct hsr_window *w = s->edges.window;
  if (segment->x0 < w->x0)
    segment->x0 = w->x0;
  segment->x1 = x1 > w->x1 ? w->x1 : x1;
  if (segment->x0 > segment->x1)
    segment->x1 = segment->x0; /* holds no sample */
}

/* Pairs the edges of the X sort list: the first of a piece opens a segment, the
 * second closes it. */
static void find_segments(struct hsr_watkins *s) {
  uint32_t *left = s->left, *right = s->right, n = 0;
  for (uint32_t k = 0; k < s->edges.n_list; k++) {
    uint32_t e = s->edges.list[k];
    const struct hsr_scan_edge *edge = &s->edges.edge[e];
    uint32_t number = s->open[edge->piece];
    bool opens = number == NONE;
    if (opens) {
      number = n++;
      s->open[edge->piece] = number;
      struct hsr_watkins_segment *segment = &s->segment[number];
      segment->face = edge->face;
      segment->piece = edge->piece;
      segment->x0 = edge->column;
    } else {
      s->open[edge->piece] = NONE;
      close_segment(s, number, edge->column);
    }
    if (left)
      (opens ? left : right)[number] = e;
  }
  s->n_segments = n;
}

/* --- Depth search --------------------------------------------------------- */

/* A stretch of a segment between two points x0 and x1 of the row, in columns,
 * and its depths q0 and q1 there. */
struct stretch {
  double x0, x1, q0, q1;
};

static struct stretch whole_segment(const struct hsr_watkins *s,
                                    const struct hsr_watkins_segment *segment,
                                    int j) {
  const struct hsr_screen *screen = &s->edges.screen;
  int first = segment->x0, last = segment->x1 - 1;
  return (struct stretch){first, last,
                          hsr_depth(screen, segment->face, first, j),
                          hsr_depth(screen, segment->face, last, j)};
}

static struct stretch left_half(struct stretch p) {
  return (struct stretch){p.x0, (p.x0 + p.x1) / 2, p.q0, (p.q0 + p.q1) / 2};
}

static struct stretch right_half(struct stretch p) {
  return (struct stretch){(p.x0 + p.x1) / 2, p.x1, (p.q0 + p.q1) / 2, p.q1};
}

static double nearest_end(struct stretch p) {
  return p.q0 > p.q1 ? p.q0 : p.q1;
}

static double farthest_end(struct stretch p) {
  return p.q0 < p.q1 ? p.q0 : p.q1;
}

/* Replaces a stretch by that half of it which holds all of the samples [l, r).
 * False if neither half does. */
static bool narrow(struct stretch *p, int l, int r) {
  double middle = (p->x0 + p->x1) / 2;
  if (r - 1 <= middle && middle < p->x1)
    *p = left_half(*p);
  else if (l >= middle && middle > p->x0)
    *p = right_half(*p);
  else
    return false;
  return true;
}

/* Outcomes of a comparison of two segments, in the order of the words of
 * HSR_DEPTH_SEARCH. */
enum order { UNDECIDED, FARTHER, NEARER };

/* The logarithmic search (figure 28). Is f nearer than g at the first sample of
 * [l, r)? The answer holds for [l, *end). pf and pg are stretches of f and g
 * that hold all these samples; `is_whole`: they are the segments.
 *
 * If the farthest end of one stretch is nearer than the nearest end of the
 * other, that decides. Otherwise the longer stretch is divided at its midpoint,
 * and its half with the samples takes its place. If the samples lie on both
 * sides of both midpoints, they are divided too: [l, r) is searched in two
 * parts. A single sample that is undecided is compared exactly. */
static bool is_first_nearer(struct hsr_watkins *s,
                            const struct hsr_watkins_segment *f,
                            struct stretch pf,
                            const struct hsr_watkins_segment *g,
                            struct stretch pg, bool is_whole, int l, int r,
                            int j, int *end) {
  const struct hsr_depth_plane *plane = s->edges.screen.plane;
  double margin = 2 * (plane[f->face].error + plane[g->face].error);
  for (;;) {
    HSR_TOUCH_SPAN(s->tally, l, r, j);
    *end = r;
    enum order order =
        farthest_end(pf) - nearest_end(pg) > margin   ? NEARER
        : farthest_end(pg) - nearest_end(pf) > margin ? FARTHER
        : r - l > 1                                   ? UNDECIDED
        : hsr_nearer(&s->edges.screen, f->face, g->face, l, j, s->tally)
            ? NEARER
            : FARTHER;
    HSR_STEP(s->tally, HSR_DEPTH_SEARCH, HSR_FACE(f->face), HSR_FACE(g->face),
             HSR_ON(l, r, j), (int)order);
    if (order != UNDECIDED)
      return order == NEARER;
    if (is_whole)
      HSR_STEP(s->tally, HSR_DEPTH_DIVIDED, HSR_FACE(f->face),
               HSR_FACE(g->face), HSR_ON(l, r, j), 0);
    is_whole = false;
    bool f_is_longer = pf.x1 - pf.x0 >= pg.x1 - pg.x0;
    HSR_STEP(s->tally, HSR_DEPTH_DIVISIONS,
             HSR_FACE((f_is_longer ? f : g)->face),
             HSR_FACE((f_is_longer ? g : f)->face), HSR_ON(l, r, j), 0);
    if (!narrow(f_is_longer ? &pf : &pg, l, r) &&
        !narrow(f_is_longer ? &pg : &pf, l, r))
      break;
  }

  /* Divide the samples where the longer stretch is divided. */
  struct stretch longer = pf.x1 - pf.x0 >= pg.x1 - pg.x0 ? pf : pg;
  int middle = (int)floor((longer.x0 + longer.x1) / 2) + 1;
  bool nearer = is_first_nearer(s, f, pf, g, pg, false, l, middle, j, end);
  if (*end < middle)
    return nearer;
  int further;
  HSR_STEP(s->tally, HSR_DEPTH_HALVES, HSR_FACE(f->face), HSR_FACE(g->face),
           HSR_ON(middle, r, j), 0);
  if (is_first_nearer(s, f, pf, g, pg, false, middle, r, j, &further) == nearer)
    *end = further;
  return nearer;
}

/* For code that only options need. It is not inlined: if it is, watkins without
 * options takes 4 % longer. */
#define OF_OPTION __attribute__((noinline))
#define IS_OPTION(x) __builtin_expect((x), 0)

/* z=buckets: which of two segments' faces is nearer by their Z buckets?
 * UNDECIDED if they share one. */
OF_OPTION static enum order order_by_bucket(struct hsr_watkins *s, uint32_t f,
                                            uint32_t g, int l, int r, int j) {
  enum order order = s->z_farthest[f] < s->z_nearest[g]   ? NEARER
                     : s->z_farthest[g] < s->z_nearest[f] ? FARTHER
                                                          : UNDECIDED;
  (void)l, (void)r, (void)j; /* for the trace */
  HSR_STEP(s->tally, s->z_counter, HSR_FACE(f), HSR_FACE(g), HSR_ON(l, r, j),
           (int)order);
  return order;
}

/* The last step, for two segments: is f nearer than g at the first sample of
 * [l, r)? The answer holds for [l, *end). */
static inline bool segment_is_nearer(struct hsr_watkins *s,
                                     const struct hsr_watkins_segment *f,
                                     const struct hsr_watkins_segment *g, int l,
                                     int r, int j, int *end) {
  if (s->is_nearer)
    return s->is_nearer(s->context, f, g, l, r, j, end);
  const uint32_t *plane = s->edges.job->world->mesh.plane;
  if (plane[f->face] == plane[g->face]) {
    *end = r;
    return f->face < g->face;
  }
  if (IS_OPTION(s->z_nearest != NULL)) {
    enum order order = order_by_bucket(s, f->face, g->face, l, r, j);
    *end = r;
    if (order != UNDECIDED)
      return order == NEARER;
  }
  return is_first_nearer(s, f, whole_segment(s, f, j), g,
                         whole_segment(s, g, j), true, l, r, j, end);
}

/* The same for two runs, by the segments that they have at sample l. If the
 * surfaces of the two are apart, their order is the same in all of [l, r), and
 * one sample is compared. Otherwise the answer ends where a segment does. */
OF_OPTION static bool run_is_nearer(struct hsr_watkins *s,
                                    const struct hsr_watkins_segment *f,
                                    const struct hsr_watkins_segment *g, int l,
                                    int r, int j, int *end) {
  const struct hsr_watkins_segment *p = hsr_watkins_part(s, f, l);
  const struct hsr_watkins_segment *q = hsr_watkins_part(s, g, l);
  bool apart = hsr_surfaces_apart(s->runs->surfaces, p->face, q->face);
  int both = apart ? l + 1 : hsr_min_int(r, hsr_min_int(p->x1, q->x1));
  bool nearer = segment_is_nearer(s, p, q, l, both, j, end);
  if (apart)
    *end = r;
  return nearer;
}

/* The same for what segment[] holds, runs or segments. */
static inline bool is_nearer(struct hsr_watkins *s,
                             const struct hsr_watkins_segment *f,
                             const struct hsr_watkins_segment *g, int l, int r,
                             int j, int *end) {
  if (IS_OPTION(s->runs != NULL))
    return run_is_nearer(s, f, g, l, r, j, end);
  return segment_is_nearer(s, f, g, l, r, j, end);
}

/* --- Sample spans --------------------------------------------------------- */

/* Searches the segments under[] for the one that is visible at `left`; NULL if
 * there are none. *right moves to the left, to where that one is no longer
 * known to be visible. */
static const struct hsr_watkins_segment *
search_depth(struct hsr_watkins *s, int left, int *right, int j) {
  const struct hsr_watkins_segment *visible = NULL;
  for (uint32_t k = 0; k < s->n_under; k++) {
    const struct hsr_watkins_segment *segment = &s->segment[s->under[k]];
    if (!visible) {
      visible = segment;
      *right = hsr_min_int(*right, segment->x1);
      continue;
    }
    int both = hsr_min_int(*right, segment->x1), end;
    if (is_nearer(s, segment, visible, left, both, j, &end))
      visible = segment;
    /* If the one visible before is nearer as long as the segment lasts, it is
     * visible beyond that, too. */
    if (visible == segment || end < both)
      *right = end;
  }
  return visible;
}

/* Floats the right end: moves *right to the left end of the first segment that
 * begins within the span and is nearer there than the visible one, if there is
 * one; or to where one that begins behind it comes to be nearer. `next` is the
 * first segment that is not yet in under[]. */
static void float_right(struct hsr_watkins *s,
                        const struct hsr_watkins_segment *visible,
                        uint32_t next, int left, int *right, int j) {
  (void)left; /* where the span begins: for the trace */
  for (uint32_t k = next; k < s->n_segments; k++) {
    const struct hsr_watkins_segment *segment = &s->segment[k];
    bool begins_inside = segment->x0 < *right;
    HSR_STEP(s->tally, HSR_SPAN_CULL, HSR_FACE(segment->face), HSR_THE_WINDOW,
             HSR_ON(left, *right, j), begins_inside);
    if (!begins_inside)
      return;
    if (segment->x0 == segment->x1)
      continue;
    int both = hsr_min_int(*right, segment->x1), end;
    if (!visible || is_nearer(s, segment, visible, segment->x0, both, j, &end))
      *right = segment->x0;
    else if (end < both)
      *right = end;
  }
}

/* The span cull, at a span's left end: leaves in under[] the segments that
 * cover sample `left`, and adds those that have begun since. Segments before
 * `next` have been in it. Returns the first that begins to the right of
 * `left`. */
static uint32_t enter_span(struct hsr_watkins *s, int left, uint32_t next,
                           int j) {
  uint32_t kept = 0;
  for (uint32_t k = 0; k < s->n_under; k++) {
    const struct hsr_watkins_segment *segment = &s->segment[s->under[k]];
    bool inside = segment->x1 > left;
    HSR_STEP(s->tally, HSR_SPAN_CULL, HSR_FACE(segment->face), HSR_THE_WINDOW,
             HSR_AT(left, j), inside);
    if (inside)
      s->under[kept++] = s->under[k];
  }
  s->n_under = kept;
  for (; next < s->n_segments && s->segment[next].x0 <= left; next++) {
    bool inside = s->segment[next].x1 > left;
    HSR_STEP(s->tally, HSR_SPAN_CULL, HSR_FACE(s->segment[next].face),
             HSR_THE_WINDOW, HSR_AT(left, j), inside);
    if (inside)
      s->under[s->n_under++] = next;
  }
  return next;
}

/* Finds the visible segment of the sample span that begins at `left`, or NULL,
 * and the span's end. */
static inline const struct hsr_watkins_segment *
decide(struct hsr_watkins *s, int left, int *right, uint32_t *next, int j) {
  *right = s->edges.window->x1;
  *next = enter_span(s, left, *next, j);
  if (IS_OPTION(s->seen != NULL))
    hsr_watkins_guess(s, left, j);
  const struct hsr_watkins_segment *visible = search_depth(s, left, right, j);
  float_right(s, visible, *next, left, right, j);
  return visible;
}

/* Writes face `id`, or the background, to the samples of a span. */
static inline void show_span(struct hsr_watkins *s, uint32_t id, int left,
                             int right, int j) {
  uint32_t *row = hsr_job_row(s->edges.job, j);
  HSR_STEP(s->tally, HSR_SPANS, HSR_FACE(id), HSR_THE_WINDOW,
           HSR_ON(left, right, j), 0);
  HSR_TOUCH_SPAN(s->tally, left, right, j);
  for (int i = left; i < right; i++)
    row[i] = id;
  if (IS_OPTION(s->seen != NULL))
    hsr_watkins_remember(s, id, right);
}

OF_OPTION const struct hsr_watkins_segment *
hsr_watkins_decide(struct hsr_watkins *s, int left, int *right, uint32_t *next,
                   int j) {
  return decide(s, left, right, next, j);
}

OF_OPTION void hsr_watkins_show(struct hsr_watkins *s, uint32_t id, int left,
                                int right, int j) {
  show_span(s, id, left, right, j);
}

/* ends=contour: shows a run in a span, segment by segment. */
OF_OPTION static void show_run(struct hsr_watkins *s,
                               const struct hsr_watkins_segment *run, int left,
                               int right, int j) {
  for (int x = left; x < right;) {
    const struct hsr_watkins_segment *part = hsr_watkins_part(s, run, x);
    int end = hsr_min_int(part->x1, right);
    show_span(s, part->face, x, end, j);
    x = end;
  }
}

/* Solves row j, sample span by sample span from the left. */
static void scan_row(struct hsr_watkins *s, int j) {
  uint32_t next = 0;
  s->n_under = 0;
  for (int left = s->edges.window->x0, right; left < s->edges.window->x1;
       left = right) {
    const struct hsr_watkins_segment *visible =
        decide(s, left, &right, &next, j);
    if (visible && s->runs)
      show_run(s, visible, left, right, j);
    else if (visible || !s->layer)
      show_span(s, visible ? visible->face : HSR_BACKGROUND, left, right, j);
  }
}

/* --- The algorithm -------------------------------------------------------- */

enum hsr_status hsr_watkins_reserve(struct hsr_watkins *s,
                                    const struct hsr_job *job,
                                    const struct hsr_screen *screen,
                                    struct hsr_scan_room room,
                                    size_t n_pieces) {
  struct hsr_arena *arena = job->scratch;
  *s = (struct hsr_watkins){.tally = job->tally};
  enum hsr_status status = hsr_scan_reserve(&s->edges, job, screen, room);
  s->open = HSR_NEW(arena, uint32_t, n_pieces);
  s->segment = HSR_NEW(arena, struct hsr_watkins_segment, room.edges / 2 + 1);
  s->under = HSR_NEW(arena, uint32_t, room.edges / 2 + 1);
  if (status || !s->open || !s->segment || !s->under)
    return HSR_E_NOMEM;
  for (size_t p = 0; p < n_pieces; p++)
    s->open[p] = NONE;
  return HSR_OK;
}

enum hsr_status hsr_watkins_find_ends(struct hsr_watkins *s) {
  size_t most = s->edges.most_edges / 2 + 1;
  s->left = HSR_NEW(s->edges.job->scratch, uint32_t, most);
  s->right = HSR_NEW(s->edges.job->scratch, uint32_t, most);
  return s->left && s->right ? HSR_OK : HSR_E_NOMEM;
}

void hsr_watkins_scan(struct hsr_watkins *s) {
  const struct hsr_window *w = s->edges.window;
  hsr_scan_close(&s->edges);
  for (int j = w->y0; j < w->y1; j++) {
    hsr_scan_advance(&s->edges, j);
    find_segments(s);
    if (s->runs)
      hsr_watkins_join(s, j);
    if (IS_OPTION(s->seen != NULL))
      hsr_watkins_next_row(s);
    if (IS_OPTION(s->regions != NULL))
      hsr_watkins_carry(s, j);
    else
      scan_row(s, j);
  }
}

void hsr_watkins_solve(struct hsr_watkins *s, const struct hsr_window *window,
                       const uint32_t *faces, uint32_t n) {
  hsr_scan_sort(&s->edges, window, faces, n);
  hsr_watkins_scan(s);
}

void hsr_watkins_clear(struct hsr_watkins *s, const struct hsr_window *window) {
  for (int j = window->y0; j < window->y1; j++)
    show_span(s, HSR_BACKGROUND, window->x0, window->x1, j);
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct hsr_screen screen;
  struct hsr_watkins watkins;
  struct hsr_scan_ways ways = {.tree = job->option[X_LIST] == TREE,
                               .presort = job->option[PRESORT] == BY_X,
                               .crossings = job->option[SORT] == CROSSING};
  if (hsr_screen_make(&screen, job->world, job->view, job->scratch,
                      job->tally) ||
      hsr_watkins_reserve(&watkins, job, &screen, hsr_scan_whole_room(&screen),
                          job->world->n_faces) ||
      hsr_scan_choose(&watkins.edges, ways) ||
      (job->option[Z] == Z_BUCKETS &&
       hsr_watkins_sort_z(&watkins, Z_SORT, Z_COMPARE)))
    return hsr_fail_nomem(err);
  hsr_scan_sort(&watkins.edges, &job->view->window, screen.relevant,
                screen.n_relevant);
  struct hsr_watkins_runs runs;
  if (job->option[ENDS] == CONTOUR &&
      hsr_watkins_use_runs(&watkins, &runs, job->prepared, JOINTS))
    return hsr_fail_nomem(err);
  struct hsr_watkins_regions carried = {.carried = CARRIED, .decided = DECIDED};
  if (job->option[REGIONS] == CARRY && job->option[ENDS] != CONTOUR &&
      hsr_watkins_use_regions(
          &watkins, &carried, job->world->n_faces,
          (struct hsr_regions_counters){ORDER_TESTS, ENDINGS, FORECASTS}))
    return hsr_fail_nomem(err);
  struct hsr_watkins_seen seen = {.passed = PASSED, .guesses = GUESSES};
  if (job->option[SPANS] == SEEN && hsr_watkins_use_seen(&watkins, &seen))
    return hsr_fail_nomem(err);
  hsr_watkins_scan(&watkins);
  return HSR_OK;
}

/* ends=contour: finds which faces are one surface, and which surfaces are
 * apart.
 */
static enum hsr_status prepare(const struct hsr_world *world,
                               const long *option, void **prepared,
                               struct hsr_error *err) {
  if (option[ENDS] != CONTOUR)
    return HSR_OK;
  struct hsr_surfaces *surfaces = calloc(1, sizeof *surfaces);
  if (!surfaces)
    return hsr_fail_nomem(err);
  *prepared = surfaces;
  return hsr_surfaces_init(surfaces, world, err);
}

static void release(void *prepared) {
  if (prepared)
    hsr_surfaces_free(prepared);
  free(prepared);
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {{&hsr_scan_part},
                                      {&hsr_spans_part},
                                      {&hsr_depth_search_part},
                                      {&hsr_x_list_part},
                                      {NULL}};

static const struct hsr_counter counters[] = {
    [Z_SORT] = {"Z sort", "faces put into Z buckets", HSR_SORT, HSR_OF_FACE,
                HSR_OF_NOTHING},
    [Z_COMPARE] = {"Z buckets", "comparisons of two segments' Z buckets",
                   HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE,
                   "undecided|farther|nearer", .outcome_keys = "undecided"},
    [JOINTS] = {"joints", "segments looked at for a contour edge at their left",
                HSR_COMPARE, HSR_OF_FACE, HSR_OF_WINDOW,
                "a contour edge|joined to the one before"},
    [ORDER_TESTS] = {"order tests",
                     "edges compared with those in their places on the line "
                     "before",
                     HSR_COMPARE, HSR_OF_EDGE, HSR_OF_NOTHING,
                     "another edge|the same edge"},
    [ENDINGS] = {"endings", "edges of a decided span: do they end on the line?",
                 HSR_COMPARE, HSR_OF_EDGE, HSR_OF_NOTHING, "ends|goes on"},
    [FORECASTS] =
        {"forecasts",
         "predictions of where, along an edge, one comes to be nearer "
         "than the visible face",
         HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, "on the next line|later"},
    [DECIDED] = {"spans decided", "sample spans decided anew", HSR_SPAN,
                 HSR_OF_FACE, HSR_OF_WINDOW},
    [CARRIED] = {"spans carried",
                 "sample spans whose decision is that of the line before",
                 HSR_SPAN, HSR_OF_FACE, HSR_OF_WINDOW},
    [PASSED] = {"spans passed",
                "spans of the line before passed, to find the one above",
                HSR_COMPARE, HSR_OF_FACE, HSR_OF_WINDOW, "passed|above"},
    [GUESSES] =
        {"guesses",
         "segments in a sample span: are they of the face visible above?",
         HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, "another|the same"},
    {NULL}};

static const struct hsr_step steps[] = {
    {"span cull",
     JOINTS,
     HSR_KIND_CULL,
     NULL,
     NULL,
     {{ORDER_TESTS, HSR_KIND_NUMBERS},
      {ENDINGS, HSR_KIND_NUMBERS},
      {PASSED, HSR_KIND_LIST},
      {GUESSES, HSR_KIND_NUMBERS}}},
    {"depth search",
     Z_SORT,
     HSR_KIND_BUCKET,
     NULL,
     NULL,
     {{Z_COMPARE, HSR_KIND_NUMBERS}, {FORECASTS, HSR_KIND_TWO_SEGMENTS}}},
    {NULL}};

static const struct hsr_sort sorts[] = {{.part = &hsr_scan_part},
                                        {.part = &hsr_spans_part},
                                        {.part = &hsr_depth_search_part},
                                        {NULL}};

static const struct hsr_line outline[] = {
    {"with a presort: put each edge into the X bucket of its first column",
     HSR_RAISES(HSR_X_PRESORT)},
    {"with Z buckets: put each face into those of its depths",
     HSR_RAISES(Z_SORT)},
    {"", .part = &hsr_scan_part},
    {"", .part = &hsr_spans_part},
    {"", .part = &hsr_depth_search_part},
    {"", .part = &hsr_spans_part, .group = HSR_LINES_AFTER_SEARCH},
    {"    with Z buckets: search only if those of two segments do not tell",
     HSR_RAISES(Z_COMPARE)},
    {"  where the sort waits: predict where new neighbors in the list cross",
     HSR_RAISES(HSR_X_CROSSINGS)},
    {"  where only contour edges end spans: join segments that share an edge",
     HSR_RAISES(JOINTS)},
    {"  where regions are carried: are the edges those of the line before?",
     HSR_RAISES(ORDER_TESTS)},
    {"    then carry the visible face of a region over", HSR_RAISES(CARRIED)},
    {"    else decide, and predict up to which line that will hold",
     HSR_RAISES(DECIDED, ENDINGS, FORECASTS)},
    {"  where the search begins with what was seen: find it in the line before",
     HSR_RAISES(PASSED)},
    {"    find its segment among those inside", HSR_RAISES(GUESSES)},
    {NULL}};

static const struct hsr_counter span_counters[] = {
    {"span cull", "segments tested against a sample span", HSR_COMPARE,
     HSR_OF_FACE, HSR_OF_WINDOW, "outside|inside", .key = "span-cull"},
    {"spans", "sample spans shown", HSR_ACCEPT, HSR_OF_FACE, HSR_OF_WINDOW,
     .key = "span"},
    {NULL}};

static const struct hsr_step span_steps[] = {
    {"span cull", HSR_SPAN_CULL, HSR_KIND_LINE, "n S_l", hsr_predict_span_cull},
    {NULL}};

static const struct hsr_sort span_sorts[] = {
    {"segments", "X", "cull", "once a sample span"}, {NULL}};

static const struct hsr_line lines_before[] = {
    {"  pair the edges of each face: they bound its segment"},
    {"  for each sample span, from the left: it begins where the last one "
     "ended"},
    {"    cull: which segments are inside the span?",
     HSR_RAISES(HSR_SPAN_CULL)},
    {NULL}};

static const struct hsr_line lines_after[] = {
    {"    move the span's right end to the left, to where another segment "
     "comes "
     "into view"},
    {"    show the visible segment in the span", HSR_RAISES(HSR_SPANS)},
    {NULL}};

const struct hsr_part hsr_spans_part = {HSR_PART_SPANS,
                                        span_counters,
                                        span_steps,
                                        span_sorts,
                                        {lines_before, lines_after}};

static const struct hsr_counter search_counters[] = {
    {"depth search", "comparisons of two segments in depth", HSR_COMPARE,
     HSR_OF_FACE, HSR_OF_FACE, "undecided|farther|nearer",
     .key = "depth-search", .outcome_keys = "undecided"},
    {"depth divisions", "segments divided at their midpoint", HSR_SUBDIVIDE,
     HSR_OF_FACE, HSR_OF_FACE, .key = "depth-division"},
    {"pairs divided", "pairs of segments that were divided, once or more",
     HSR_SUBDIVIDE, HSR_OF_FACE, HSR_OF_FACE, .key = "pair-divided"},
    {"second halves", "searches of the right part of samples that were divided",
     HSR_SUBDIVIDE, HSR_OF_FACE, HSR_OF_FACE, .key = "second-half"},
    {NULL}};

static const struct hsr_step search_steps[] = {
    /* A division leads to another comparison of the same two segments, and if
     * their samples are divided, to one more. */
    {"depth search",
     HSR_DEPTH_SEARCH,
     HSR_KIND_SPAN,
     "30 n D_c min(m, 2 S_v)",
     hsr_predict_depth_search,
     {{HSR_DEPTH_DIVISIONS, HSR_KIND_SPAN, .less = true},
      {HSR_DEPTH_HALVES, HSR_KIND_SPAN, .less = true}}},
    {NULL}};

static const struct hsr_sort search_sorts[] = {
    {"segments", "Z", "logarithmic search", "once a sample span"}, {NULL}};

static const struct hsr_line search_lines[] = {
    {"    search the segments inside for the nearest one: compare two",
     HSR_RAISES(HSR_DEPTH_SEARCH)},
    {"      if their ends do not tell, divide one at its midpoint",
     HSR_RAISES(HSR_DEPTH_DIVIDED, HSR_DEPTH_DIVISIONS)},
    {"        if both parts have samples of the span, search both",
     HSR_RAISES(HSR_DEPTH_HALVES)},
    {NULL}};

const struct hsr_part hsr_depth_search_part = {HSR_PART_DEPTH_SEARCH,
                                               search_counters,
                                               search_steps,
                                               search_sorts,
                                               {search_lines}};

const struct hsr_algorithm HSR_ALGORITHM(watkins) = {
    .name = "watkins",
    .title = "Watkins' scan-line algorithm",
    .authors = "G. S. Watkins",
    .year = 1970,
    .source = "UTECH-CSC-70-101, 1970; Sutherland et al., Computing Surveys "
              "6(1), 1974, \"Scan-line Algorithms\"",
    .taxonomy = HSR_IMAGE_SPACE_POINT,
    .sort_order = "YXZ",
    .coherence = "scan line; edge; floating right end of the sample span",
    .restrictions = 0,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}},
    .sorts = sorts,
    .parts = uses,
    .counters = counters,
    .steps = steps,
    .outline = outline,
    .options = options,
    .prepare = prepare,
    .render = render,
    .release = release};
