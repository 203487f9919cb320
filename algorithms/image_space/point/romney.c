/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The scan-line algorithm of Wylie, Romney, Evans and Erdahl: spans from edge
 * crossing to edge crossing, and lines that repeat what the last one showed.
 *
 * Source      C. Wylie, G. W. Romney, D. C. Evans, A. C. Erdahl, "Halftone
 *             Perspective Drawings by Computer", AFIPS FJCC 1967; G. W. Romney,
 *             TR-4-20, University of Utah, 1970; as described by Sutherland et
 *             al. 1974, "Scan-line Algorithms", "Scan-Line Coherence" and
 *             appendix B.
 * Notation    scan line -> row j; raster element -> column; Y occupied table ->
 *             y_occupied[]; X intercept -> struct intercept; X occupied table
 *             -> x_occupied[]
 * Restricted  to triangles that do not penetrate (TR NP). The core makes them
 *             so; a piece of a face, on that face's plane, is a triangle, less
 *             what cuts take from it, and so convex.
 * Invariants  order[] holds the intercepts of y_occupied[] in ascending
 *             columns; of one column, in the order they had on the last line;
 *             x_occupied[] holds the faces of which an odd number of pieces
 *             hold the raster element, as parity would have it.
 * Reuse       The paper reuses a line with the same faces as the last one, whose
 *             edge crossings are in the same order ("Scan-line Algorithms"),
 *             and also "a correspondingly unchanged left part" of a line
 *             ("Existing Uses of Coherence"). So does this module. Why it is right: of two
 *             convex faces that do not penetrate, one is nearer at all samples
 *             that both hold. (Otherwise they would meet between two such
 *             samples.) So the visible face depends only on the set of faces
 *             that hold the sample. That set depends only on the intercepts to
 *             the left. They are the same as on the last line up to the first
 *             place where a face has entered or left, or edges have crossed. Up
 *             to there the visible face is taken over, whatever the columns. A
 *             span that had no sample on the last line was not searched there.
 *             It is searched on the first line on which it has one.
 * Thick       A face whose vertices are a little out of its plane may penetrate
 *             others by as much, and is not divided for it. A span that holds
 *             such a face and others is searched on every line, at its first
 *             and at its last sample. Depth is linear along a row, so a face
 *             that is nearest at both is nearest in between. If two faces are
 *             found, the span is divided where the visible face changes.
 * Ties        columns: intercepts of one column have no sample between them, in
 *             any order; depth: one plane, lower id; all else by hsr_nearer
 * Departures  one bucket sort by Y, which puts a face into one bucket; the
 *             survey counts two ("actually, two bucket sorts", appendix B) and
 *             does not say by what, so the Y sort here costs half; an
 *             intercept is found from its line anew on every row instead of by
 *             adding increments, whose roundings add up; X is kept as the
 *             column of the first sample to the right; a face that is cut gives
 *             its columns a row at a time (hsr_face_spans). Where left parts
 *             are reused and not only lines, the depth search may take less
 *             than the f = 1/2 of the cost formula.
 * Cost        Y sort 2 F_r, X sort n S_l, X priority search n m, depth search
 *             20 n (2 S_l) D_c / 2. The tests whether intercepts are in the last
 *             line's order are charged too, 1 each; the formula leaves them out */
#include "algorithms/algorithm.h"
#include "common/exact/screen.h"

enum {
  Y_SORT,
  X_SORT,
  X_PRIORITY_SEARCH,
  DEPTH_SEARCH,
  SPANS,
  SPANS_REUSED,
  LINES_REUSED,
  THICKNESS_CHECKS,
  THICKNESS_DIVISIONS,
  ORDER_TESTS
};

/* No more in a bucket; not in the table. */
static const uint32_t NONE = UINT32_MAX;

/* The visible face is not known. No face has this id, nor has the background.
 */
static const uint32_t UNKNOWN = UINT32_MAX - 1;

/* A face that meets the rows from its bucket's to end_row; most of them whole
 * triangles, which have two intercepts on each. Any other has room for what
 * hsr_face_spans may give. */
struct face {
  uint32_t id, next; /* next in the Y bucket */
  int end_row;
  uint32_t first_intercept, n_intercepts;

  bool whole_triangle;
  int middle_row;          /* the first below its middle corner */
  uint32_t corner[3];      /* from above */
  struct hsr_edge edge[2]; /* the two that cross the row */
};

/* Where a face begins or ends on the row; of one face, in ascending columns. */
struct intercept {
  uint32_t face; /* index of face[] */
  uint32_t next; /* next in the X bucket */
  int column;    /* the window's x1 where it does not show */
};

/* An intercept in X order, and what is visible from it to the next. */
struct crossing {
  uint32_t intercept, visible;
};

struct scan {
  const struct hsr_job *job;
  struct hsr_tally *tally;
  struct hsr_screen screen;
  const struct hsr_window *window;

  struct face *face;
  uint32_t n_faces;
  struct intercept *intercept;
  uint32_t n_intercepts;
  int *columns; /* room for the spans of the largest face */

  uint32_t *y_bucket; /* a row of the window: its entering faces */
  uint32_t *y_occupied, n_y_occupied;
  uint32_t n_stayed; /* the first of them, which were there on the last line */

  uint32_t *x_bucket; /* a column of the window and one more: intercepts */
  struct crossing *order;
  uint32_t n_order;
  uint32_t n_passed; /* crossings at the raster element or left of it */
  bool unchanged;    /* these are the ones of the last line, in its order */

  uint32_t *x_occupied, n_x_occupied; /* faces, by one of their pieces */
  uint32_t *place;  /* a face of the scene: its place there, or NONE */
  uint32_t n_thick; /* of them, not flat */
};

/* --- Y sort --------------------------------------------------------------- */

static void put_into_y_bucket(struct scan *s, struct face face, int row) {
  const struct hsr_window *w = s->window;
  if (row < w->y0)
    row = w->y0;
  if (row >= w->y1 || row >= face.end_row)
    return;
  uint32_t *bucket = &s->y_bucket[row - w->y0];
  face.next = *bucket;
  face.first_intercept = s->n_intercepts;
  for (uint32_t k = 0; k < face.n_intercepts; k++)
    s->intercept[s->n_intercepts++] = (struct intercept){.face = s->n_faces};
  *bucket = s->n_faces;
  s->face[s->n_faces++] = face;
  HSR_STEP(s->tally, Y_SORT, HSR_FACE(face.id), HSR_NOTHING,
           hsr_window_make(w->x0, row, w->x1,
                           face.end_row < w->y1 ? face.end_row : w->y1),
           0);
}

/* A triangle meets the rows from its uppermost corner's to its lowest's. */
static void sort_triangle(struct scan *s, uint32_t f) {
  const struct hsr_world *world = s->job->world;
  struct face face = {.id = f, .whole_triangle = true, .n_intercepts = 2};
  int row[3];
  for (int k = 0; k < 3; k++) {
    uint32_t v = world->mesh.vertex[world->mesh.start[f] + (uint32_t)k];
    int row_v = hsr_vertex_row(&s->screen, v, s->tally), place = k;
    for (; place && row[place - 1] > row_v; place--) {
      row[place] = row[place - 1];
      face.corner[place] = face.corner[place - 1];
    }
    row[place] = row_v;
    face.corner[place] = v;
  }
  face.middle_row = row[1];
  face.end_row = row[2];
  put_into_y_bucket(s, face, row[0]);
}

static bool is_whole_triangle(const struct scan *s, uint32_t f) {
  return s->screen.whole[f] && hsr_face_size(s->job->world, f) == 3;
}

static uint32_t most_intercepts(const struct scan *s, uint32_t f) {
  return is_whole_triangle(s, f) ? 2 : hsr_face_size(s->job->world, f) + 4;
}

static void sort_y(struct scan *s) {
  for (int row = s->window->y0; row < s->window->y1; row++)
    s->y_bucket[row - s->window->y0] = NONE;
  for (uint32_t r = 0; r < s->screen.n_relevant; r++) {
    uint32_t f = s->screen.relevant[r];
    const struct hsr_bounds *bounds = &s->screen.bounds[f];
    if (is_whole_triangle(s, f))
      sort_triangle(s, f);
    else
      put_into_y_bucket(s,
                        (struct face){.id = f,
                                      .end_row = bounds->y1,
                                      .n_intercepts = most_intercepts(s, f)},
                        bounds->y0);
  }
}

/* The Y occupied table of row j: the faces that were in it and reach down to
 * the row, and those of the row's bucket. */
static void update_y_occupied(struct scan *s, int j) {
  uint32_t kept = 0;
  for (uint32_t k = 0; k < s->n_y_occupied; k++)
    if (s->face[s->y_occupied[k]].end_row > j)
      s->y_occupied[kept++] = s->y_occupied[k];
  s->n_stayed = kept;
  for (uint32_t n = s->y_bucket[j - s->window->y0]; n != NONE;
       n = s->face[n].next)
    s->y_occupied[kept++] = n;
  s->n_y_occupied = kept;
}

/* --- X sort --------------------------------------------------------------- */

static void set_column(struct scan *s, uint32_t intercept, int column) {
  const struct hsr_window *w = s->window;
  s->intercept[intercept].column = column < w->x0   ? w->x0
                                   : column > w->x1 ? w->x1
                                                    : column;
}

/* The edges of a triangle that cross row j: the long one, and the one above or
 * below its middle corner. */
static void follow_edges(struct scan *s, struct face *face, int j) {
  const uint32_t *v = face->corner;
  bool above = j < face->middle_row;
  hsr_edge_init(&face->edge[0], &s->screen, v[0], v[2]);
  hsr_edge_init(&face->edge[1], &s->screen, v[above ? 0 : 1], v[above ? 1 : 2]);
}

static void find_triangle_intercepts(struct scan *s, struct face *face,
                                     bool enters, int j) {
  if (enters || j == face->middle_row)
    follow_edges(s, face, j);
  int a = hsr_edge_column(&s->screen, &face->edge[0], j, s->tally);
  int b = hsr_edge_column(&s->screen, &face->edge[1], j, s->tally);
  set_column(s, face->first_intercept, a < b ? a : b);
  set_column(s, face->first_intercept + 1, a < b ? b : a);
}

static void find_intercepts(struct scan *s, int j) {
  for (uint32_t k = 0; k < s->n_y_occupied; k++) {
    struct face *face = &s->face[s->y_occupied[k]];
    HSR_STEP(s->tally, X_SORT, HSR_FACE(face->id), HSR_NOTHING,
             HSR_ON(s->window->x0, s->window->x1, j), 0);
    if (face->whole_triangle) {
      find_triangle_intercepts(s, face, k >= s->n_stayed, j);
      continue;
    }
    uint32_t n =
        (uint32_t)hsr_face_spans(&s->screen, face->id, j, s->columns, s->tally);
    for (uint32_t c = 0; c < face->n_intercepts; c++)
      set_column(s, face->first_intercept + c,
                 c < n ? s->columns[c] : s->window->x1);
  }
}

/* Puts an intercept before those that are in its bucket already. */
static void put_into_x_bucket(struct scan *s, uint32_t intercept) {
  struct intercept *i = &s->intercept[intercept];
  uint32_t *bucket = &s->x_bucket[i->column - s->window->x0];
  i->next = *bucket;
  *bucket = intercept;
}

/* The bucket sort of row j. It goes through the last line's order from the
 * right, so that intercepts of one column keep their order. Those of entering
 * faces come behind them. */
static void sort_x(struct scan *s, int j) {
  for (int column = s->window->x0; column <= s->window->x1; column++)
    s->x_bucket[column - s->window->x0] = NONE;
  for (uint32_t k = s->n_y_occupied; k-- > s->n_stayed;) {
    const struct face *face = &s->face[s->y_occupied[k]];
    for (uint32_t c = face->n_intercepts; c--;)
      put_into_x_bucket(s, face->first_intercept + c);
  }
  for (uint32_t k = s->n_order; k--;) {
    uint32_t intercept = s->order[k].intercept;
    if (s->face[s->intercept[intercept].face].end_row > j)
      put_into_x_bucket(s, intercept);
  }
}

/* --- X priority search ---------------------------------------------------- */

/* A piece of a face begins or ends here. The face is in the table if an odd
 * number of its pieces hold the raster element. */
static void update_x_occupied(struct scan *s, uint32_t piece) {
  const struct hsr_world *world = s->job->world;
  uint32_t *place = &s->place[hsr_world_parent(world, piece)];
  bool thick = world->mesh.deviation[piece] > 0;
  if (*place == NONE) {
    *place = s->n_x_occupied;
    s->x_occupied[s->n_x_occupied++] = piece;
    s->n_thick += thick;
  } else {
    uint32_t last = s->x_occupied[--s->n_x_occupied];
    s->x_occupied[*place] = last;
    s->place[hsr_world_parent(world, last)] = *place;
    *place = NONE;
    s->n_thick -= thick;
  }
}

/* Is intercept i the one that has its place in the last line's order? */
static bool has_its_place(struct scan *s, uint32_t i, int column, int j) {
  if (s->n_passed >= s->n_order)
    return false;
  bool same = s->order[s->n_passed].intercept == i;
  (void)column, (void)j; /* for the trace */
  HSR_STEP(s->tally, ORDER_TESTS, HSR_FACE(s->face[s->intercept[i].face].id),
           HSR_NOTHING, HSR_AT(column, j), same);
  return same;
}

/* Passes the intercepts of a bucket of row j. As long as they are those of the
 * last line, it is still known what is visible to the right of them. */
static void pass_bucket(struct scan *s, int column, int j) {
  for (uint32_t i = s->x_bucket[column - s->window->x0]; i != NONE;
       i = s->intercept[i].next) {
    struct crossing *crossing = &s->order[s->n_passed];
    s->unchanged = s->unchanged && has_its_place(s, i, column, j);
    if (!s->unchanged)
      *crossing = (struct crossing){i, UNKNOWN};
    s->n_passed++;
    update_x_occupied(s, s->face[s->intercept[i].face].id);
  }
}

static void clear_x_occupied(struct scan *s) {
  for (uint32_t k = 0; k < s->n_x_occupied; k++)
    s->place[hsr_world_parent(s->job->world, s->x_occupied[k])] = NONE;
  s->n_x_occupied = s->n_thick = 0;
}

/* --- Depth search --------------------------------------------------------- */

/* The nearest face of the X occupied table, which is not empty, at a sample. */
static uint32_t search_depth(struct scan *s, int i, int j) {
  uint32_t visible = s->x_occupied[0];
  HSR_TOUCH(s->tally, i, j);
  HSR_STEP(s->tally, DEPTH_SEARCH, HSR_FACE(visible), HSR_NOTHING, HSR_AT(i, j),
           1);
  for (uint32_t k = 1; k < s->n_x_occupied; k++) {
    uint32_t f = s->x_occupied[k];
    HSR_TOUCH(s->tally, i, j);
    bool nearer = hsr_nearer(&s->screen, f, visible, i, j, s->tally);
    HSR_STEP(s->tally, DEPTH_SEARCH, HSR_FACE(f), HSR_FACE(visible),
             HSR_AT(i, j), nearer);
    if (nearer)
      visible = f;
  }
  return visible;
}

/* Returns up to which sample the face that is nearest at `left` is so, where
 * faces are thick. */
static int check_thickness(struct scan *s, uint32_t visible, int left,
                           int right, int j) {
  uint32_t at_end = search_depth(s, right - 1, j);
  HSR_STEP(s->tally, THICKNESS_CHECKS, HSR_FACE(visible), HSR_FACE(at_end),
           HSR_ON(left, right, j), at_end == visible);
  if (at_end == visible)
    return right;
  HSR_STEP(s->tally, THICKNESS_DIVISIONS, HSR_FACE(visible), HSR_FACE(at_end),
           HSR_ON(left, right, j), 0);
  int lo = left, hi = right - 1; /* visible at lo, not at hi nor after it */
  while (hi - lo > 1) {
    int middle = lo + (hi - lo) / 2;
    if (search_depth(s, middle, j) == visible)
      lo = middle;
    else
      hi = middle;
  }
  return hi;
}

static void show(struct scan *s, uint32_t id, int left, int right, int j) {
  uint32_t *row = hsr_job_row(s->job, j);
  HSR_STEP(s->tally, SPANS, HSR_FACE(id), HSR_THE_WINDOW,
           HSR_ON(left, right, j), 0);
  HSR_TOUCH_SPAN(s->tally, left, right, j);
  for (int i = left; i < right; i++)
    row[i] = id;
}

/* Searches the sample span [left, right). Returns the face that is visible in
 * all of it, on this line and as long as the same faces are there; or UNKNOWN.
 */
static uint32_t search_span(struct scan *s, int left, int right, int j) {
  bool thick = s->n_thick && s->n_x_occupied > 1;
  uint32_t visible = UNKNOWN;
  for (int end; left < right; left = end) {
    visible = search_depth(s, left, j);
    end = right;
    if (thick && right - left > 1)
      end = check_thickness(s, visible, left, right, j);
    show(s, visible, left, end, j);
  }
  return thick ? UNKNOWN : visible;
}

/* --- A scan line ---------------------------------------------------------- */

/* Scans the X buckets of row j. A bucket with intercepts begins a sample span.
 */
static void scan_line(struct scan *s, int j) {
  const int x1 = s->window->x1;
  bool searched = false, reused = false;
  s->unchanged = true;
  s->n_passed = 0;
  for (int left = s->window->x0, right; left < x1; left = right) {
    HSR_STEP(s->tally, X_PRIORITY_SEARCH, HSR_THE_WINDOW, HSR_NOTHING,
             HSR_AT(left, j), s->x_bucket[left - s->window->x0] != NONE);
    pass_bucket(s, left, j);
    for (right = left + 1;
         right < x1 && s->x_bucket[right - s->window->x0] == NONE; right++)
      HSR_STEP(s->tally, X_PRIORITY_SEARCH, HSR_THE_WINDOW, HSR_NOTHING,
               HSR_AT(right, j), 0);
    if (!s->n_x_occupied) {
      show(s, HSR_BACKGROUND, left, right, j);
      continue;
    }
    struct crossing *last = &s->order[s->n_passed - 1];
    if (last->visible == UNKNOWN) {
      last->visible = search_span(s, left, right, j);
      searched = true;
    } else {
      HSR_STEP(s->tally, SPANS_REUSED, HSR_FACE(last->visible), HSR_THE_WINDOW,
               HSR_ON(left, right, j), 0);
      show(s, last->visible, left, right, j);
      reused = true;
    }
  }
  pass_bucket(s, x1, j); /* beyond the window, but in order */
  s->n_order = s->n_passed;
  clear_x_occupied(s);
  if (reused && !searched)
    HSR_STEP(s->tally, LINES_REUSED, HSR_THE_WINDOW, HSR_NOTHING,
             HSR_ON(s->window->x0, x1, j), 0);
}

/* --- The algorithm -------------------------------------------------------- */

static enum hsr_status allocate(struct scan *s) {
  const struct hsr_world *world = s->job->world;
  struct hsr_arena *arena = s->job->scratch;
  size_t n_relevant = s->screen.n_relevant, n_intercepts = 0, most = 0;
  for (size_t r = 0; r < n_relevant; r++) {
    size_t n = most_intercepts(s, s->screen.relevant[r]);
    n_intercepts += n;
    most = n > most ? n : most;
  }
  size_t n_scene =
      world->pieces ? world->pieces->whole->n_faces : world->n_faces;
  s->face = HSR_NEW(arena, struct face, n_relevant);
  s->intercept = HSR_NEW(arena, struct intercept, n_intercepts);
  s->columns = HSR_NEW(arena, int, most);
  s->y_bucket =
      HSR_NEW(arena, uint32_t, (size_t)(s->window->y1 - s->window->y0));
  s->y_occupied = HSR_NEW(arena, uint32_t, n_relevant);
  s->x_bucket =
      HSR_NEW(arena, uint32_t, (size_t)(s->window->x1 - s->window->x0) + 1);
  s->order = HSR_NEW(arena, struct crossing, n_intercepts);
  s->x_occupied = HSR_NEW(arena, uint32_t, n_relevant);
  s->place = HSR_NEW(arena, uint32_t, n_scene);
  if (!s->face || !s->intercept || !s->columns || !s->y_bucket ||
      !s->y_occupied || !s->x_bucket || !s->order || !s->x_occupied ||
      !s->place)
    return HSR_E_NOMEM;
  for (size_t f = 0; f < n_scene; f++)
    s->place[f] = NONE;
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
    update_y_occupied(&scan, j);
    find_intercepts(&scan, j);
    sort_x(&scan, j);
    scan_line(&scan, j);
  }
  return HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_counter counters[] = {
    [Y_SORT] = {"Y sort", "faces put into Y buckets", HSR_SORT, HSR_OF_FACE,
                .outcome_keys = "first-row"},
    [X_SORT] = {"X sort", "faces whose intercepts are put into X buckets",
                HSR_SORT, HSR_OF_FACE},
    [X_PRIORITY_SEARCH] = {"X priority search", "X buckets scanned", HSR_SAMPLE,
                           HSR_OF_WINDOW, HSR_OF_NOTHING,
                           "empty|holds intercepts", .key = "x-bucket"},
    [DEPTH_SEARCH] = {"depth search",
                      "faces of the X occupied table looked at for the "
                      "nearest",
                      HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, "farther|nearer",
                      .key = "depth-search"},
    [SPANS] = {"spans", "sample spans shown", HSR_ACCEPT, HSR_OF_FACE,
               HSR_OF_WINDOW, .key = "span"},
    [SPANS_REUSED] = {"spans reused",
                      "of these, shown as on the last line, unsearched",
                      HSR_SPAN, HSR_OF_FACE, HSR_OF_WINDOW,
                      .key = "span-reused"},
    [LINES_REUSED] = {"lines reused", "lines with faces, but no depth search",
                      HSR_SPAN, HSR_OF_WINDOW, .key = "line-reused"},
    [THICKNESS_CHECKS] = {"thickness checks",
                          "spans searched at their last sample too, as a face "
                          "of theirs is not flat",
                          HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE,
                          "another face|the same face"},
    [THICKNESS_DIVISIONS] = {"thickness divisions",
                             "of these, spans that had to be divided",
                             HSR_SUBDIVIDE, HSR_OF_FACE, HSR_OF_FACE},
    [ORDER_TESTS] = {"order tests",
                     "intercepts compared with those in their places on the "
                     "last line",
                     HSR_COMPARE, HSR_OF_FACE, HSR_OF_NOTHING,
                     "another intercept|the same intercept"},
    {NULL}};

static const struct hsr_line outline[] = {
    {"put each face into the Y bucket of its uppermost vertex",
     HSR_RAISES(Y_SORT)},
    {"for each scan line"},
    {"  update the Y occupied table by the line's bucket"},
    {"  put the intercepts of its faces into X buckets", HSR_RAISES(X_SORT)},
    {"  for each X bucket, from the left", HSR_RAISES(X_PRIORITY_SEARCH)},
    {"    enter faces that begin there into the X occupied table, delete those "
     "that end"},
    {"    if all intercepts so far are in the order of the last line",
     HSR_RAISES(ORDER_TESTS)},
    {"      show what was visible there", HSR_RAISES(SPANS_REUSED)},
    {"    else search the X occupied table for the nearest face",
     HSR_RAISES(DEPTH_SEARCH)},
    {"      not flat: is it the nearest at the span's end, too?",
     HSR_RAISES(THICKNESS_CHECKS)},
    {"      if not, divide the span", HSR_RAISES(THICKNESS_DIVISIONS)},
    {"    show the visible face up to the next change", HSR_RAISES(SPANS)},
    {"  if nothing was searched, the line was reused",
     HSR_RAISES(LINES_REUSED)},
    {NULL}};

static double predict_y_sort(const struct hsr_table1 *t) {
  return 2 * t->F_r;
}

static double predict_x_sort(const struct hsr_table1 *t) {
  return t->n * t->S_l;
}

static double predict_x_priority_search(const struct hsr_table1 *t) {
  return t->n * t->m;
}

static double predict_depth_search(const struct hsr_table1 *t) {
  return 20 * t->n * (2 * t->S_l) * t->D_c / 2;
}

static const struct hsr_step steps[] = {
    {"Y sort", Y_SORT, HSR_KIND_BUCKET, "2 F_r", predict_y_sort},
    {"X sort", X_SORT, HSR_KIND_BUCKET, "n S_l", predict_x_sort},
    {"X priority search",
     X_PRIORITY_SEARCH,
     HSR_KIND_ELEMENT,
     "n m",
     predict_x_priority_search,
     {{ORDER_TESTS, HSR_KIND_NUMBERS}}},
    {"depth search", DEPTH_SEARCH, HSR_KIND_CROSSING,
     "20 n (2 S_l) D_c f, f = 1/2", predict_depth_search},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {"faces", "Y", "bucket sort", "once a frame"},
    {"intercepts", "X", "bucket sort", "once a scan line"},
    {"faces", "X", "priority search", "once a raster element"},
    {"faces", "Z", "exhaustive search",
     "at every edge crossing, unless as on the last line"},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(romney) = {
    .name = "romney",
    .title = "Romney's scan-line algorithm",
    .authors = "C. Wylie, G. W. Romney, D. C. Evans, A. C. Erdahl",
    .year = 1967,
    .source = "AFIPS FJCC 31, 1967; G. W. Romney, TR 4-20, Univ. of Utah, "
              "1970; Sutherland et al., Computing Surveys 6(1), 1974, "
              "\"Scan-line Algorithms\"",
    .taxonomy = HSR_IMAGE_SPACE_POINT,
    .sort_order = "YXZ",
    .coherence = "scan line: one that is crossed as the last one was, or its "
                 "left part, shows the same faces",
    .restrictions = HSR_TR | HSR_NP,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}},
    .sorts = sorts,
    .counters = counters,
    .steps = steps,
    .outline = outline,
    .render = render};
