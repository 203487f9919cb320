/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The Y bucket sort of edges and the X sort list: see scan_line.h. */
#include "algorithms/engines/scan_line/scan_line.h"

#include "common/base/vector.h"

#include <string.h>

/* --- Y sort --------------------------------------------------------------- */

static void put_into_bucket(struct hsr_scan *s, struct hsr_scan_edge edge,
                            int row) {
  const struct hsr_window *w = s->window;
  if (row < w->y0)
    row = w->y0;
  if (edge.end_row > w->y1)
    edge.end_row = w->y1;
  if (row >= edge.end_row)
    return;
  edge.row = row;
  s->edge[s->n_edges++] = edge;
  HSR_STEP(s->tally, HSR_Y_SORT, hsr_scan_subject(&edge), HSR_NOTHING,
           hsr_window_make(w->x0, row, w->x1, edge.end_row), 0);
}

static int row_of(const struct hsr_scan *s, uint32_t v) {
  int row = s->vertex_row[v];
  return row != HSR_ROW_UNKNOWN ? row : hsr_vertex_row(&s->screen, v, s->tally);
}

static void sort_edges(struct hsr_scan *s, const struct hsr_piece *piece,
                       uint32_t number) {
  const struct hsr_world *world = s->job->world;
  uint32_t f = piece->face, n = hsr_face_size(world, f);
  const uint32_t *vertex = world->mesh.vertex + world->mesh.start[f];
  uint32_t a = vertex[n - 1];
  int row_a = row_of(s, a);
  for (uint32_t k = 0; k < n; k++) {
    uint32_t b = vertex[k];
    int row_b = row_of(s, b);
    if (row_a != row_b) { /* else it lies between two scan lines */
      struct hsr_scan_edge edge = {
          .face = f, .piece = number, .cut = HSR_NOT_CUT};
      bool down = row_a < row_b;
      hsr_edge_init(&edge.line, &s->screen, down ? a : b, down ? b : a);
      edge.end_row = down ? row_b : row_a;
      put_into_bucket(s, edge, down ? row_a : row_b);
    }
    a = b;
    row_a = row_b;
  }
}

static bool is_cut(const struct hsr_screen *screen,
                   const struct hsr_piece *piece) {
  return piece->n_cuts || !screen->whole[piece->face];
}

/* The most ends that segments of a cut piece have on a row. */
static uint32_t most_ends(const struct hsr_screen *screen,
                          const struct hsr_piece *piece) {
  uint32_t size = hsr_face_size(screen->world, piece->face);
  return screen->whole[piece->face] ? size & ~1u : size + 4;
}

static int find_spans(struct hsr_scan *s, const struct hsr_piece *piece,
                      int j) {
  return hsr_piece_spans(&s->screen, piece->face, piece->cuts, piece->n_cuts, j,
                         s->columns, s->tally);
}

static void sort_ends(struct hsr_scan *s, const struct hsr_piece *piece,
                      uint32_t number) {
  struct hsr_scan_cut cut = {
      .piece = *piece, .first_edge = s->n_edges, .row = -1};
  struct hsr_scan_edge edge = {
      .face = piece->face, .piece = number, .cut = s->n_cut};
  int first_row = 0;
  const struct hsr_window *w = s->window;
  int begin = piece->bounds.y0 > w->y0 ? piece->bounds.y0 : w->y0,
      end = piece->bounds.y1 < w->y1 ? piece->bounds.y1 : w->y1;
  for (int row = begin; row < end; row++) {
    int n = find_spans(s, piece, row);
    if (!n)
      continue;
    first_row = cut.n_edges ? first_row : row;
    edge.end_row = row + 1;
    cut.n_edges = n > cut.n_edges ? n : cut.n_edges;
  }
  for (int k = 0; k < cut.n_edges; k++)
    put_into_bucket(s, edge, first_row);
  s->cut[s->n_cut++] = cut;
}

void hsr_scan_open(struct hsr_scan *s, const struct hsr_window *window) {
  s->window = window;
  s->n_edges = s->n_cut = s->n_list = 0;
}

void hsr_scan_add(struct hsr_scan *s, const struct hsr_piece *piece,
                  uint32_t number) {
  if (is_cut(&s->screen, piece))
    sort_ends(s, piece, number);
  else
    sort_edges(s, piece, number);
}

/* Makes the buckets of edges in a given order, or of all edges, the last one
 * first. Places are counted first, so that the edges of a bucket are neighbours.
 */
void hsr_scan_fill_buckets(struct hsr_scan *s, const uint32_t *order) {
  uint32_t n = s->n_edges, *bucket = s->bucket;
  int y0 = s->window->y0, rows = s->window->y1 - y0;
  memset(bucket, 0, ((size_t)rows + 2) * sizeof *bucket);
  for (uint32_t e = 0; e < n; e++)
    bucket[s->edge[e].row - y0 + 2]++;
  for (int row = 2; row <= rows; row++)
    bucket[row] += bucket[row - 1];
  for (uint32_t k = 0; k < n; k++) {
    uint32_t e = order ? order[k] : n - 1 - k;
    s->in_bucket[bucket[s->edge[e].row - y0 + 1]++] = e;
  }
}

void hsr_scan_close(struct hsr_scan *s) {
  hsr_scan_fill_buckets(s, NULL);
  if (s->ways.presort)
    hsr_scan_presort(s);
}

void hsr_scan_sort(struct hsr_scan *s, const struct hsr_window *window,
                   const uint32_t *faces, uint32_t n) {
  hsr_scan_open(s, window);
  for (uint32_t k = 0; k < n; k++) {
    struct hsr_piece face = hsr_uncut_face(&s->screen, faces[k]);
    hsr_scan_add(s, &face, faces[k]);
  }
}

/* --- X sort --------------------------------------------------------------- */

/* Finds the columns of all ends of a piece, when the first of them is asked for
 * on the row. Those that it does not have there lie in pairs at its last end;
 * if it has none, where its first one was. */
static void find_cut_columns(struct hsr_scan *s, struct hsr_scan_cut *cut,
                             int j) {
  if (cut->row == j)
    return;
  cut->row = j;
  struct hsr_scan_edge *end = &s->edge[cut->first_edge];
  int n = find_spans(s, &cut->piece, j);
  int last = n ? s->columns[n - 1] : end[0].column;
  for (int k = 0; k < cut->n_edges; k++)
    end[k].column = k < n ? s->columns[k] : last;
}

/* Finds the column of an edge on row j, which is at `at` in the picture. */
static inline void find_column(struct hsr_scan *s, struct hsr_scan_edge *edge,
                               int j, const struct hsr_row *at) {
  if (edge->cut == HSR_NOT_CUT)
    edge->column = hsr_edge_column_on(&s->screen, &edge->line, j, at, s->tally);
  else
    find_cut_columns(s, &s->cut[edge->cut], j);
}

void hsr_scan_column(struct hsr_scan *s, struct hsr_scan_edge *edge, int j) {
  struct hsr_row at = hsr_row_of(s->screen.view, j);
  find_column(s, edge, j, &at);
}

/* Deletes the edges that end above row j, and finds the columns of the others
 * on it. */
static void retire_and_advance(struct hsr_scan *s, int j) {
  const struct hsr_row at = hsr_row_of(s->screen.view, j);
  uint32_t *list = s->list, n = s->n_list, kept = 0;
  for (uint32_t k = 0; k < n; k++) {
    struct hsr_scan_edge *edge = &s->edge[list[k]];
    if (edge->end_row <= j)
      continue;
    find_column(s, edge, j, &at);
    s->list_column[kept] = edge->column;
    list[kept++] = list[k];
  }
  s->n_list = kept;
}

/* How many of n columns lie to the right of `column`. */
static inline __attribute__((always_inline)) uint32_t
count_right(const int *columns, uint32_t n, int column) {
  int right = 0;
  for (uint32_t k = 0; k < n; k++)
    right += columns[k] > column;
  return (uint32_t)right;
}

/* How many of the last ones of n columns lie to the right of `column`, up to
 * one that does not. They are compared from the last one on, many at once. */
HSR_VECTOR static uint32_t count_last_right(const int *columns, uint32_t n,
                                            int column) {
  enum { MANY = 256, SOME = 32 };
  uint32_t first = n;
  while (first >= MANY &&
         count_right(columns + first - MANY, MANY, column) == MANY)
    first -= MANY;
  while (first >= SOME &&
         count_right(columns + first - SOME, SOME, column) == SOME)
    first -= SOME;
  while (first && columns[first - 1] > column)
    first--;
  return n - first;
}

/* Linear merge of one edge: compares e with those in list[] from the right, and
 * puts it before those that lie to the right of it. */
static void merge_edge(struct hsr_scan *s, uint32_t e, int j) {
  int column = s->edge[e].column;
  uint32_t n = s->n_list++;
  uint32_t right = count_last_right(s->list_column, n, column);
  uint32_t compared = right < n ? right + 1 : n;
  for (uint32_t k = 1; HSR_COUNTING && k <= compared; k++)
    hsr_scan_step(s, HSR_X_MERGE, &s->edge[e], &s->edge[s->list[n - k]],
                  k <= right, j);
  uint32_t *to = s->list + n - right;
  int *to_column = s->list_column + n - right;
  memmove(to + 1, to, right * sizeof *to);
  memmove(to_column + 1, to_column, right * sizeof *to_column);
  *to = e;
  *to_column = column;
}

/* Merges the edges of the row's bucket into list[], one after the other. If the
 * bucket is sorted, or a tree is, they are put into entering[] instead. */
static void take_bucket(struct hsr_scan *s, bool sorted, int j) {
  enum { AHEAD = 8 }; /* edges of a bucket are spread over memory */
  const struct hsr_row at = hsr_row_of(s->screen.view, j);
  uint32_t begin = s->bucket[j - s->window->y0];
  uint32_t end = s->bucket[j - s->window->y0 + 1];
  s->n_entering = 0;
  for (uint32_t k = begin; k < end; k++) {
    uint32_t e = s->in_bucket[k];
    if (k + AHEAD < s->n_edges)
      __builtin_prefetch(&s->edge[s->in_bucket[k + AHEAD]]);
    find_column(s, &s->edge[e], j, &at);
    if (sorted)
      s->entering[s->n_entering++] = e;
    else
      merge_edge(s, e, j);
  }
}

/* Merges entering[], which is sorted, into list[], from the right end of both.
 */
static void merge_x(struct hsr_scan *s, int j) {
  uint32_t from = s->n_list, entering = s->n_entering;
  uint32_t to = s->n_list += s->n_entering;
  while (entering) {
    uint32_t e = s->entering[entering - 1];
    bool left = false;
    if (from) {
      const struct hsr_scan_edge *other = &s->edge[s->list[from - 1]];
      left = other->column > s->edge[e].column;
      hsr_scan_step(s, HSR_X_MERGE, &s->edge[e], other, left, j);
    }
    s->list[--to] = left ? s->list[--from] : e;
    entering -= !left;
  }
}

/* Whether a is known to be to the left of b, its neighbour, without a look. */
static inline bool is_known(const struct hsr_scan_known *known, uint32_t a,
                            uint32_t b, int j) {
  return known && known[a].neighbour == b && j < known[a].until;
}

/* Bubble sort: each edge moves to the left, past the edges right of it. Inlined
 * once with `known`, and once without. */
static inline __attribute__((always_inline)) void
sort_x(struct hsr_scan *s, const struct hsr_scan_known *known, int j) {
  const struct hsr_scan_edge *edge = s->edge;
  uint32_t *list = s->list, n_list = s->n_list;
  for (uint32_t n = 1; n < n_list; n++) {
    uint32_t e = list[n], k = n;
    int column = edge[e].column;
    for (; k && !is_known(known, list[k - 1], e, j); k--) {
      const struct hsr_scan_edge *other = &edge[list[k - 1]];
      bool left = other->column > column;
      hsr_scan_step(s, HSR_X_SORT, &edge[e], other, left, j);
      if (!left) {
        if (known)
          hsr_scan_predict(s, list[k - 1], e, j);
        break;
      }
      hsr_scan_step(s, HSR_X_INTERCHANGES, &edge[e], other, 0, j);
      list[k] = list[k - 1];
    }
    list[k] = e;
  }
}

/* --- Penetration ---------------------------------------------------------- */

/* The first two looks are on both sides of the place where the planes meet, as
 * their coefficients say; the further ones halve what is left. */
int hsr_scan_crossing(const struct hsr_scan *scan, uint32_t f, uint32_t g,
                      bool f_first, int left, int right, int j, int counter) {
  const struct hsr_view *view = scan->job->view;
  const struct hsr_depth_plane *p = &scan->screen.plane[f];
  const struct hsr_depth_plane *q = &scan->screen.plane[g];
  double x =
      ((q->b - p->b) * hsr_sample_y(view, j) + q->c - p->c) / (p->a - q->a);
  double column = ceil(x - hsr_sample_x(view, 0));
  int lo = left, hi = right - 1; /* the order of `left` at lo, not at hi */
  int look = column > lo && column < hi ? (int)column : hi;
  for (int n = 0; hi - lo > 1; n++) {
    if (n > 1 || look <= lo || look >= hi)
      look = lo + (hi - lo) / 2;
    HSR_TOUCH(scan->tally, look, j);
    bool nearer = hsr_nearer(&scan->screen, f, g, look, j, scan->tally);
    HSR_STEP(scan->tally, counter, HSR_FACE(f), HSR_FACE(g), HSR_AT(look, j),
             nearer);
    if (nearer == f_first)
      lo = look++;
    else
      hi = look--;
  }
  return hi;
}

/* --- The row -------------------------------------------------------------- */

void hsr_scan_make_room(struct hsr_scan_room *room,
                        const struct hsr_screen *screen,
                        const struct hsr_piece *piece) {
  size_t size = hsr_face_size(screen->world, piece->face);
  if (!is_cut(screen, piece)) {
    room->edges += size;
    return;
  }
  room->edges += most_ends(screen, piece);
  room->cut++;
  if (room->columns < size + 4)
    room->columns = size + 4;
}

struct hsr_scan_room hsr_scan_whole_room(const struct hsr_screen *screen) {
  struct hsr_scan_room room = {0};
  for (uint32_t r = 0; r < screen->n_relevant; r++) {
    struct hsr_piece face = hsr_uncut_face(screen, screen->relevant[r]);
    hsr_scan_make_room(&room, screen, &face);
  }
  return room;
}

enum hsr_status hsr_scan_reserve(struct hsr_scan *s, const struct hsr_job *job,
                                 const struct hsr_screen *screen,
                                 struct hsr_scan_room room) {
  const struct hsr_window *w = &job->view->window;
  struct hsr_arena *arena = job->scratch;
  *s = (struct hsr_scan){.job = job,
                         .tally = job->tally,
                         .screen = *screen,
                         .most_edges = (uint32_t)room.edges};
  s->vertex_row = HSR_NEW(arena, int, screen->world->mesh.n_vertices);
  s->edge = HSR_NEW(arena, struct hsr_scan_edge, room.edges);
  s->bucket = HSR_NEW(arena, uint32_t, (size_t)(w->y1 - w->y0) + 2);
  s->in_bucket = HSR_NEW(arena, uint32_t, room.edges);
  s->cut = HSR_NEW(arena, struct hsr_scan_cut, room.cut);
  s->columns = HSR_NEW(arena, int, room.columns);
  s->list = HSR_NEW(arena, uint32_t, room.edges);
  s->entering = HSR_NEW(arena, uint32_t, room.edges);
  s->list_column = HSR_NEW(arena, int, room.edges);
  if (!s->vertex_row || !s->edge || !s->bucket || !s->in_bucket || !s->cut ||
      !s->columns || !s->list || !s->entering || !s->list_column)
    return HSR_E_NOMEM;
  hsr_vertex_rows(screen, s->vertex_row);
  return HSR_OK;
}

enum hsr_status hsr_scan_begin(struct hsr_scan *scan,
                               const struct hsr_job *job) {
  struct hsr_screen screen;
  if (hsr_screen_make(&screen, job->world, job->view, job->scratch,
                      job->tally) ||
      hsr_scan_reserve(scan, job, &screen, hsr_scan_whole_room(&screen)))
    return HSR_E_NOMEM;
  hsr_scan_sort(scan, &job->view->window, screen.relevant, screen.n_relevant);
  hsr_scan_close(scan);
  return HSR_OK;
}

void hsr_scan_advance(struct hsr_scan *scan, int j) {
  bool tree = scan->ways.tree;
  if (tree)
    hsr_x_tree_retire(scan, j);
  retire_and_advance(scan, j);
  take_bucket(scan, tree || scan->ways.presort, j);
  if (tree)
    hsr_x_tree_merge(scan, j);
  else if (scan->ways.presort)
    merge_x(scan, j);
  if (scan->known)
    sort_x(scan, scan->known, j);
  else
    sort_x(scan, NULL, j);
  if (tree)
    hsr_x_tree_store(scan);
}

/* --- What it counts ------------------------------------------------------- */

static const struct hsr_counter counters[] = {
    {"Y sort", "edges put into Y buckets", HSR_SORT, HSR_OF_EDGE,
     HSR_OF_NOTHING, .outcome_keys = "first-row"},
    {"X merge", "comparisons to merge entering edges into the list",
     HSR_COMPARE, HSR_OF_EDGE, HSR_OF_EDGE, "to the right|to the left"},
    {"X sort", "comparisons of an edge with the one before it", HSR_COMPARE,
     HSR_OF_EDGE, HSR_OF_EDGE, "to the right|to the left", .key = "x-sort"},
    {"X interchanges", "interchanges of two neighbors in the list", HSR_SORT,
     HSR_OF_EDGE, HSR_OF_EDGE, .key = "interchange"},
    {NULL}};

static double predict_y_sort(const struct hsr_table1 *t) {
  return t->E_r;
}
static double predict_x_merge(const struct hsr_table1 *t) {
  return t->E_r * t->S_l / 2;
}
static double predict_x_sort(const struct hsr_table1 *t) {
  return t->n * t->S_l + (t->S_l > 0 ? 10 * t->X_r / t->S_l : 0);
}

static const struct hsr_step steps[] = {
    {"Y sort", HSR_Y_SORT, HSR_KIND_BUCKET, "E_r", predict_y_sort},
    {"X merge", HSR_X_MERGE, HSR_KIND_LIST, "E_r S_l / 2", predict_x_merge},
    {"X sort",
     HSR_X_SORT,
     HSR_KIND_NUMBERS,
     "n (S_l + 10 X_r / (n S_l))",
     predict_x_sort,
     {{HSR_X_INTERCHANGES, HSR_KIND_INTERCHANGE}}},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {"edges", "Y", "bucket sort", "once a frame"},
    {"edges", "X", "merge", "as they enter"},
    {"edges", "X", "bubble sort", "once a scan line"},
    {NULL}};

static const struct hsr_line lines[] = {
    {"put each edge into the Y bucket of its first scan line",
     HSR_RAISES(HSR_Y_SORT)},
    {"for each scan line"},
    {"  delete the edges that exit from the X sort list"},
    {"  merge the edges of the Y bucket into the X sort list",
     HSR_RAISES(HSR_X_MERGE)},
    {"  bubble sort: compare each edge with the one before it",
     HSR_RAISES(HSR_X_SORT)},
    {"    interchange them if they are out of order",
     HSR_RAISES(HSR_X_INTERCHANGES)},
    {NULL}};

const struct hsr_part hsr_scan_part = {
    HSR_PART_SCAN_LINE, counters, steps, sorts, {lines}};
