/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Watkins' scan-line algorithm: floating sample spans and a logarithmic depth
 * search.
 *
 * Source      G. S. Watkins, "A real-time visible surface algorithm",
 * UTECH-CSC- 70-101, 1970; as described by Sutherland et al. 1974, "Scan-line
 *             Algorithms" and figures 27b and 28.
 * Notation    scan line -> row j; X sort list -> list[]; segment -> struct
 *             segment, the samples [x0, x1) of a face on the row; sample span
 * -> [left, right) Invariants  after sort_x, list[] holds the edges that cross
 * the row in ascending columns, so that each face's edges pair up, first with
 *             second, as the ends of its segments;
 *             in find_span, `visible` is nearest in [left, right) of the
 * segments looked at so far, and right only ever moves to the left Ties
 * columns: edges of one column have no sample between them, in any order;
 * depth: one plane, lower id; all else by hsr_nearer Departures  an edge's
 * crossing is found from its line anew on every row instead of by adding
 * increments, whose roundings add up; X is kept as the column of the first
 * sample to the right, which is all that a picture of samples can tell; a face
 * that is cut by the near plane gives its columns a row at a time
 * (hsr_face_spans) where the paper would have clipped it Cost        Y sort
 * E_r, X merge E_r S_l / 2, X sort n (S_l + 10 X_r / (n S_l)), span cull n S_l,
 * depth search 30 n D_c min(m, 2 S_v) */
#include "algorithms/algorithm.h"
#include "common/screen.h"

#include <limits.h>

enum { Y_SORT, X_MERGE, X_SORT, SPAN_CULL, DEPTH_SEARCH, DIVISIONS, SPANS };

static const struct hsr_counter counters[] = {
    [Y_SORT] = {"Y sort", "edges put into Y buckets"},
    [X_MERGE] = {"X merge",
                 "comparisons to merge entering edges into the list"},
    [X_SORT] = {"X sort", "comparisons, and ten more for each interchange"},
    [SPAN_CULL] = {"span cull", "segments tested against a sample span"},
    [DEPTH_SEARCH] = {"depth search", "comparisons of two segments in depth"},
    [DIVISIONS] = {"depth divisions", "segments divided at their midpoint"},
    [SPANS] = {"spans", "sample spans decided"},
    {NULL, NULL}};

static double predict_y_sort(const struct hsr_table1 *t) {
  return t->E_r;
}
static double predict_x_merge(const struct hsr_table1 *t) {
  return t->E_r * t->S_l / 2;
}
static double predict_x_sort(const struct hsr_table1 *t) {
  return t->n * t->S_l + (t->S_l > 0 ? 10 * t->X_r / t->S_l : 0);
}
static double predict_span_cull(const struct hsr_table1 *t) {
  return t->n * t->S_l;
}
static double predict_depth_search(const struct hsr_table1 *t) {
  return 30 * t->n * t->D_c * fmin(t->m, 2 * t->S_v);
}

static const struct hsr_step steps[] = {
    {"Y sort", Y_SORT, 1, "E_r", predict_y_sort},
    {"X merge", X_MERGE, 1, "E_r S_l / 2", predict_x_merge},
    {"X sort", X_SORT, 1, "n (S_l + 10 X_r / (n S_l))", predict_x_sort},
    {"span cull", SPAN_CULL, 1, "n S_l", predict_span_cull},
    {"depth search", DEPTH_SEARCH, 30, "30 n D_c min(m, 2 S_v)",
     predict_depth_search},
    {NULL, 0, 0, NULL, NULL}};

static const struct hsr_sort sorts[] = {
    {"edges", "Y", "bucket sort", "once a frame"},
    {"edges", "X", "merge", "as they enter"},
    {"edges", "X", "bubble sort", "once a scan line"},
    {"segments", "X", "cull", "once a sample span"},
    {"segments", "Z", "logarithmic search", "once a sample span"},
    {NULL, NULL, NULL, NULL}};

/* No more edges in a bucket; no face. */
static const uint32_t NONE = UINT32_MAX;

/* An edge that crosses the rows from its bucket's to end_row. The edges of a
 * cut face stand for whatever ends its segments have on a row. */
struct edge {
  struct hsr_edge line;
  uint32_t face, next; /* next in the Y bucket */
  int end_row;
  int column; /* on the current row; INT_MAX where there is no crossing */
  bool cut;
};

/* Samples [x0, x1) of a face on the current row; depths q at the first and the
 * last of them, as computed: within `error`. */
struct segment {
  uint32_t face;
  int x0, x1;
  double q0, q1, error;
};

/* A cut face and the edges that stand for its ends. */
struct cut_face {
  uint32_t face, first_edge;
  int n_edges;
};

struct scan {
  const struct hsr_job *job;
  struct hsr_tally *tally;
  struct hsr_screen screen;
  const struct hsr_window *window;

  struct edge *edge;
  uint32_t n_edges;
  uint32_t *bucket; /* a row of the window: its entering edges */
  struct cut_face *cut;
  uint32_t n_cut;
  int *columns; /* room for the spans of the largest cut face */

  uint32_t *list, n_list;         /* X sort list: edges */
  uint32_t *entering, n_entering; /* edges of the row's bucket, sorted */
  uint32_t *open;                 /* a face: its segment without right end */
  struct segment *segment;        /* of the row, by ascending x0 */
  uint32_t n_segments;
  uint32_t *under, n_under; /* segments that reach over the span's left end */
};

/* --- Y sort ----------------------------------------------------------------
 */

static void put_into_bucket(struct scan *s, struct edge edge, int row) {
  const struct hsr_window *w = s->window;
  if (row < w->y0)
    row = w->y0;
  if (edge.end_row > w->y1)
    edge.end_row = w->y1;
  if (row >= edge.end_row)
    return;
  uint32_t *bucket = &s->bucket[row - w->y0];
  edge.next = *bucket;
  *bucket = s->n_edges;
  s->edge[s->n_edges++] = edge;
  HSR_STEP(s->tally, Y_SORT, HSR_SORT, edge.face, *bucket, w->x0, row, w->x1,
           edge.end_row);
}

static void sort_whole_face(struct scan *s, uint32_t f) {
  const struct hsr_world *world = s->job->world;
  const uint32_t *vertex = world->vertex + world->start[f];
  uint32_t n = hsr_face_size(world, f), a = vertex[n - 1];
  int row_a = hsr_vertex_row(&s->screen, a, s->tally);
  for (uint32_t k = 0; k < n; k++) {
    uint32_t b = vertex[k];
    int row_b = hsr_vertex_row(&s->screen, b, s->tally);
    if (row_a != row_b) { /* else it lies between two scan lines */
      struct edge edge = {.face = f};
      bool down = row_a < row_b;
      hsr_edge_init(&edge.line, &s->screen, down ? a : b, down ? b : a);
      edge.end_row = down ? row_b : row_a;
      put_into_bucket(s, edge, down ? row_a : row_b);
    }
    a = b;
    row_a = row_b;
  }
}

static void sort_cut_face(struct scan *s, uint32_t f) {
  const struct hsr_bounds *bounds = &s->screen.bounds[f];
  struct cut_face cut = {f, s->n_edges,
                         (int)hsr_face_size(s->job->world, f) + 4};
  struct edge edge = {.face = f, .end_row = bounds->y1, .cut = true};
  for (int k = 0; k < cut.n_edges; k++)
    put_into_bucket(s, edge, bounds->y0);
  s->cut[s->n_cut++] = cut;
}

static void sort_y(struct scan *s) {
  for (int row = s->window->y0; row < s->window->y1; row++)
    s->bucket[row - s->window->y0] = NONE;
  for (uint32_t r = 0; r < s->screen.n_relevant; r++) {
    uint32_t f = s->screen.relevant[r];
    if (s->screen.whole[f])
      sort_whole_face(s, f);
    else
      sort_cut_face(s, f);
  }
}

/* --- X sort ----------------------------------------------------------------
 */

static void find_cut_columns(struct scan *s, int j) {
  for (uint32_t c = 0; c < s->n_cut; c++) {
    const struct cut_face *cut = &s->cut[c];
    const struct hsr_bounds *bounds = &s->screen.bounds[cut->face];
    if (j < bounds->y0 || j >= bounds->y1)
      continue;
    int n = hsr_face_spans(&s->screen, cut->face, j, s->columns, s->tally);
    for (int k = 0; k < cut->n_edges; k++)
      s->edge[cut->first_edge + (uint32_t)k].column =
          k < n ? s->columns[k] : INT_MAX;
  }
}

static void find_column(struct scan *s, struct edge *edge, int j) {
  if (!edge->cut)
    edge->column = hsr_edge_column(&s->screen, &edge->line, j, s->tally);
}

/* Deletes the edges that end above row j, and moves the others on to it. */
static void retire_and_advance(struct scan *s, int j) {
  uint32_t kept = 0;
  for (uint32_t k = 0; k < s->n_list; k++) {
    struct edge *edge = &s->edge[s->list[k]];
    if (edge->end_row <= j)
      continue;
    find_column(s, edge, j);
    s->list[kept++] = s->list[k];
  }
  s->n_list = kept;
}

/* The row's bucket, sorted by column, into entering[]. */
static void take_bucket(struct scan *s, int j) {
  s->n_entering = 0;
  for (uint32_t e = s->bucket[j - s->window->y0]; e != NONE;
       e = s->edge[e].next) {
    find_column(s, &s->edge[e], j);
    uint32_t k = s->n_entering++;
    for (; k; k--) {
      HSR_STEP(s->tally, X_MERGE, HSR_COMPARE, e, s->entering[k - 1], 0, j, 0,
               j + 1);
      if (s->edge[s->entering[k - 1]].column <= s->edge[e].column)
        break;
      s->entering[k] = s->entering[k - 1];
    }
    s->entering[k] = e;
  }
}

/* Merges entering[] into list[], from the right end of both. */
static void merge_x(struct scan *s, int j) {
  uint32_t from = s->n_list, entering = s->n_entering;
  uint32_t to = s->n_list += s->n_entering;
  while (entering) {
    uint32_t e = s->entering[entering - 1];
    bool stays = false;
    if (from) {
      HSR_STEP(s->tally, X_MERGE, HSR_COMPARE, e, s->list[from - 1], 0, j, 0,
               j + 1);
      stays = s->edge[s->list[from - 1]].column > s->edge[e].column;
    }
    s->list[--to] = stays ? s->list[--from] : e;
    entering -= !stays;
  }
}

/* Bubble sort, each edge sinking to its place among those before it. */
static void sort_x(struct scan *s, int j) {
  for (uint32_t n = 1; n < s->n_list; n++) {
    uint32_t e = s->list[n], k = n;
    int column = s->edge[e].column;
    for (; k; k--) {
      HSR_STEP(s->tally, X_SORT, HSR_COMPARE, e, s->list[k - 1], 0, j, 0,
               j + 1);
      if (s->edge[s->list[k - 1]].column <= column)
        break;
      HSR_COUNT(s->tally, X_SORT, 10);
      s->list[k] = s->list[k - 1];
    }
    s->list[k] = e;
  }
}

/* --- Segments ---------------------------------------------------------------
 */

static void close_segment(struct scan *s, uint32_t number, int x1, int j) {
  struct segment *segment = &s->segment[number];
  const struct hsr_window *w = s->window;
  if (segment->x0 < w->x0)
    segment->x0 = w->x0;
  segment->x1 = x1 > w->x1 ? w->x1 : x1;
  if (segment->x0 >= segment->x1) {
    segment->x1 = segment->x0; /* holds no sample */
    return;
  }
  uint32_t f = segment->face;
  segment->q0 = hsr_depth(&s->screen, f, segment->x0, j);
  segment->q1 = hsr_depth(&s->screen, f, segment->x1 - 1, j);
  segment->error = 2 * s->screen.plane[f].error;
}

/* Pairs the edges of list[]: the first of a face opens a segment, the second
 * closes it. */
static void find_segments(struct scan *s, int j) {
  s->n_segments = 0;
  for (uint32_t k = 0; k < s->n_list; k++) {
    const struct edge *edge = &s->edge[s->list[k]];
    if (edge->column == INT_MAX)
      break;
    uint32_t *open = &s->open[edge->face];
    if (*open == NONE) {
      *open = s->n_segments;
      s->segment[s->n_segments++] =
          (struct segment){.face = edge->face, .x0 = edge->column};
    } else {
      close_segment(s, *open, edge->column, j);
      *open = NONE;
    }
  }
}

/* --- Depth search ------------------------------------------------------------
 */

/* A part of a segment between two points of the row, in columns, with its
 * depths there. */
struct part {
  double x0, x1, q0, q1;
};

static struct part whole_part(const struct segment *segment) {
  return (struct part){segment->x0, segment->x1 - 1, segment->q0, segment->q1};
}

static struct part left_half(struct part p) {
  return (struct part){p.x0, (p.x0 + p.x1) / 2, p.q0, (p.q0 + p.q1) / 2};
}

static struct part right_half(struct part p) {
  return (struct part){(p.x0 + p.x1) / 2, p.x1, (p.q0 + p.q1) / 2, p.q1};
}

/* Halves the part if one half holds all of the samples [l, r). */
static bool narrow(struct part *p, int l, int r) {
  double middle = (p->x0 + p->x1) / 2;
  if (r - 1 <= middle && middle < p->x1)
    *p = left_half(*p);
  else if (l >= middle && middle > p->x0)
    *p = right_half(*p);
  else
    return false;
  return true;
}

/* Which of two segments is nearer at the first sample of [l, r), and how far
 * that holds: the answer is true for [l, *end). Where the farthest end of one
 * part is nearer than the nearest end of the other, no more need be known; else
 * the longer part is divided at its midpoint, and the samples with them once
 * they straddle both midpoints. A single sample is left to the exact
 * comparison. */
static bool first_is_nearer(struct scan *s, const struct segment *f,
                            struct part pf, const struct segment *g,
                            struct part pg, int l, int r, int j, int *end) {
  double margin = f->error + g->error;
  for (;;) {
    HSR_TOUCH_SPAN(s->tally, l, r, j);
    HSR_STEP(s->tally, DEPTH_SEARCH, HSR_COMPARE, f->face, g->face, l, j, r,
             j + 1);
    *end = r;
    if (fmin(pf.q0, pf.q1) - fmax(pg.q0, pg.q1) > margin)
      return true;
    if (fmin(pg.q0, pg.q1) - fmax(pf.q0, pf.q1) > margin)
      return false;
    if (r - l == 1)
      return hsr_nearer(&s->screen, f->face, g->face, l, j, s->tally);
    HSR_STEP(s->tally, DIVISIONS, HSR_SUBDIVIDE, f->face, g->face, l, j, r,
             j + 1);
    bool f_is_longer = pf.x1 - pf.x0 >= pg.x1 - pg.x0;
    if (!narrow(f_is_longer ? &pf : &pg, l, r) &&
        !narrow(f_is_longer ? &pg : &pf, l, r))
      break;
  }

  /* Divide the samples where the longer part is divided. */
  struct part longer = pf.x1 - pf.x0 >= pg.x1 - pg.x0 ? pf : pg;
  int middle = (int)floor((longer.x0 + longer.x1) / 2) + 1;
  bool nearer = first_is_nearer(s, f, pf, g, pg, l, middle, j, end);
  if (*end < middle)
    return nearer;
  int further;
  if (first_is_nearer(s, f, pf, g, pg, middle, r, j, &further) == nearer)
    *end = further;
  return nearer;
}

/* The same for whole segments; faces of one plane need no search. */
static bool is_nearer(struct scan *s, const struct segment *f,
                      const struct segment *g, int l, int r, int j, int *end) {
  const uint32_t *plane = s->job->world->plane;
  if (plane[f->face] == plane[g->face]) {
    *end = r;
    return f->face < g->face;
  }
  return first_is_nearer(s, f, whole_part(f), g, whole_part(g), l, r, j, end);
}

/* --- Sample spans ------------------------------------------------------------
 */

static int least(int a, int b) {
  return a < b ? a : b;
}

/* The visible one of the segments that reach over `left`; none, if there is
 * none. *right is moved to where that, or its segment, ends. */
static const struct segment *search_depth(struct scan *s, int left, int *right,
                                          int j) {
  const struct segment *visible = NULL;
  for (uint32_t k = 0; k < s->n_under; k++) {
    const struct segment *segment = &s->segment[s->under[k]];
    if (!visible) {
      visible = segment;
      *right = least(*right, segment->x1);
      continue;
    }
    int both = least(*right, segment->x1), end;
    if (is_nearer(s, segment, visible, left, both, j, &end))
      visible = segment;
    /* Beyond the segment's own end the old one is visible still. */
    if (visible == segment || end < both)
      *right = end;
  }
  return visible;
}

/* Moves *right to the left end of the first segment that begins within the span
 * and does not lie behind the visible one. *next is the first segment not yet
 * under the span. */
static void float_right(struct scan *s, const struct segment *visible,
                        uint32_t next, int *right, int j) {
  for (uint32_t k = next; k < s->n_segments; k++) {
    const struct segment *segment = &s->segment[k];
    HSR_STEP(s->tally, SPAN_CULL, HSR_COMPARE, segment->face, HSR_NOTHING,
             segment->x0, j, *right, j + 1);
    if (segment->x0 >= *right)
      return;
    if (segment->x0 == segment->x1)
      continue;
    int both = least(*right, segment->x1), end;
    if (!visible || is_nearer(s, segment, visible, segment->x0, both, j, &end))
      *right = segment->x0;
    else if (end < both)
      *right = end;
  }
}

/* Brings under[] up to date for a span that begins at `left`. */
static uint32_t enter_span(struct scan *s, int left, uint32_t next, int j) {
  uint32_t kept = 0;
  for (uint32_t k = 0; k < s->n_under; k++) {
    HSR_STEP(s->tally, SPAN_CULL, HSR_COMPARE, s->segment[s->under[k]].face,
             HSR_NOTHING, left, j, left + 1, j + 1);
    if (s->segment[s->under[k]].x1 > left)
      s->under[kept++] = s->under[k];
  }
  s->n_under = kept;
  for (; next < s->n_segments && s->segment[next].x0 <= left; next++) {
    HSR_STEP(s->tally, SPAN_CULL, HSR_ACTIVATE, s->segment[next].face,
             HSR_NOTHING, left, j, left + 1, j + 1);
    if (s->segment[next].x1 > left)
      s->under[s->n_under++] = next;
  }
  return next;
}

static void scan_row(struct scan *s, int j) {
  uint32_t *row = s->job->ids + (size_t)j * s->job->ids_stride;
  uint32_t next = 0;
  s->n_under = 0;
  for (int left = s->window->x0, right; left < s->window->x1; left = right) {
    right = s->window->x1;
    next = enter_span(s, left, next, j);
    const struct segment *visible = search_depth(s, left, &right, j);
    float_right(s, visible, next, &right, j);
    uint32_t id = visible ? visible->face : HSR_BACKGROUND;
    HSR_STEP(s->tally, SPANS, HSR_SPAN, id, HSR_NOTHING, left, j, right, j + 1);
    HSR_TOUCH_SPAN(s->tally, left, right, j);
    for (int i = left; i < right; i++)
      row[i] = id;
  }
}

/* --- The algorithm -----------------------------------------------------------
 */

static enum hsr_status allocate(struct scan *s) {
  const struct hsr_world *world = s->job->world;
  struct hsr_arena *arena = s->job->scratch;
  size_t n_edges = 0, n_cut = 0, n_columns = 0;
  for (uint32_t r = 0; r < s->screen.n_relevant; r++) {
    uint32_t f = s->screen.relevant[r], size = hsr_face_size(world, f);
    bool cut = !s->screen.whole[f];
    n_edges += size + (cut ? 4 : 0);
    n_cut += cut;
    if (cut && n_columns < size + 4)
      n_columns = size + 4;
  }
  size_t n_segments = n_edges / 2 + 1;
  s->edge = HSR_NEW(arena, struct edge, n_edges);
  s->bucket = HSR_NEW(arena, uint32_t, (size_t)(s->window->y1 - s->window->y0));
  s->cut = HSR_NEW(arena, struct cut_face, n_cut);
  s->columns = HSR_NEW(arena, int, n_columns);
  s->list = HSR_NEW(arena, uint32_t, n_edges);
  s->entering = HSR_NEW(arena, uint32_t, n_edges);
  s->open = HSR_NEW(arena, uint32_t, world->n_faces);
  s->segment = HSR_NEW(arena, struct segment, n_segments);
  s->under = HSR_NEW(arena, uint32_t, n_segments);
  if (!s->edge || !s->bucket || !s->cut || !s->columns || !s->list ||
      !s->entering || !s->open || !s->segment || !s->under)
    return HSR_E_NOMEM;
  for (uint32_t f = 0; f < world->n_faces; f++)
    s->open[f] = NONE;
  return HSR_OK;
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct scan scan = {
      .job = job, .tally = job->tally, .window = &job->view->window};
  if (hsr_screen_make(&scan.screen, job->world, job->view, job->scratch,
                      job->tally) ||
      allocate(&scan))
    return hsr_fail_nomem(err);

  sort_y(&scan);
  for (int j = scan.window->y0; j < scan.window->y1; j++) {
    find_cut_columns(&scan, j);
    retire_and_advance(&scan, j);
    take_bucket(&scan, j);
    merge_x(&scan, j);
    sort_x(&scan, j);
    find_segments(&scan, j);
    scan_row(&scan, j);
  }
  return HSR_OK;
}

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
    .kind = HSR_IDS,
    .sorts = sorts,
    .counters = counters,
    .steps = steps,
    .render = render};
