/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The taxonomy as a program: sorts in X, in Y and in Z, in any order, by any
 * method.
 *
 * Source      Sutherland et al. 1974, chapter IV, "Other Combinations of
 *             Sorting": the eight orders of sorting, of which one was untried and
 *             three were uninteresting for television; and chapter II, "Sorting",
 *             the methods. The stages are ours.
 * Notation    order -> a string of axes; A stands for (XY).
 *             stage -> what one axis of the order does with a list of items in a
 *             window, before it hands on shorter lists in smaller windows:
 *               X or Y first   the window is divided into lines along the other
 *                              axis. Faces become runs of samples on each
 *               X or Y second  a line is divided into spans, in each of which the
 *                              same runs are active
 *               (XY)           the window is divided into four until each face
 *                              surrounds it or is disjoint
 *               Z              items are put in the order of their nearest depths
 *             At the end, the nearest of a list is searched. The search ends early
 *             if Z was sorted: at the first item that is farther than the nearest
 *             face so far.
 * Invariant   a list that has been sorted in Z stays in that order in all later
 *             stages. The items at the end cover all of the window.
 * Ties        by hsr_nearer
 * Departures  A sort in Z that comes first is partial, Z_p: two faces whose depths
 *             overlap are told apart at the end, in the window where both are.
 *             Newell's special sort would do it before.
 * Cost        the sorts of the order, each by its method; a segment 10 for each
 *             run; the search at the end, 30 for each face in a span and 10 at a
 *             sample. */
#include "algorithms/engines/windows/area.h"
#include "algorithms/image_space/stages/items.h"
#include "common/base/numbers.h"

#include <math.h>
#include <string.h>

enum {
  SORT_X,
  SORT_Y,
  SORT_Z,
  PUT_X,
  PUT_Y,
  PUT_Z,
  ACTIVE,
  RUNS,
  WINDOWS,
  DIVISIONS,
  IN_SPAN,
  AT_SAMPLE,
  HALVES,
  SHOWN
};

enum { ORDER, LATERAL, DEPTH }; /* options */
static const struct hsr_word orders[] = {
    {"yxz", "as Romney, Bouknight and Watkins", 0},
    {"zyx", "as Schumacker, and Newell", 0},
    {"yzx", "untried in 1974", 0},
    {"xy-z", "(XY)Z, as Warnock", 0},
    {"z-xy", "Z(XY), as Newell with a frame buffer", 0},
    {"zxy", "uninteresting for television", 0},
    {"xyz", "uninteresting for television", 0},
    {"xzy", "uninteresting for television", 0},
    {NULL}};
static const char *const axes_of[] = {"YXZ", "ZYX", "YZX", "AZ",
                                      "ZA",  "ZXY", "XYZ", "XZY"};
enum { N_ORDERS = sizeof axes_of / sizeof *axes_of };
static const struct hsr_word methods[] = {
    [HSR_STAGE_BUCKET] = {"bucket", "buckets", 0},
    [HSR_STAGE_LIST] = {"list", "insertion into a list, from its end", 0},
    [HSR_STAGE_BUBBLE] = {"bubble", "a bubble sort", 0},
    [HSR_STAGE_BINARY] = {"binary", "a binary search for each place", 0},
    [HSR_STAGE_SEARCH] = {"search", "none: all are looked at each time", 0},
    {NULL}};
static const struct hsr_word z_methods[] = {
    [HSR_STAGE_BUCKET] = {"bucket", "buckets, each mended by a list", 0},
    [HSR_STAGE_LIST] = {"list", "insertion into a list, from its end", 0},
    [HSR_STAGE_BUBBLE] = {"bubble", "a bubble sort", 0},
    [HSR_STAGE_BINARY] = {"binary", "a binary search for each place", 0},
    {NULL}};
static const struct hsr_option options[] = {
    [ORDER] = {"order", "the order of the sorts", orders, 0, N_ORDERS - 1, 0},
    [LATERAL] = {"lateral", "how X and Y are sorted", methods, 0,
                 HSR_STAGE_SEARCH, HSR_STAGE_BUCKET},
    [DEPTH] = {"depth", "how Z is sorted, where it is not the last", z_methods,
               0, HSR_STAGE_BINARY, HSR_STAGE_BUCKET},
    {NULL}};

static const uint32_t NONE = UINT32_MAX;

/* A run of rows in a column of a face. */
struct column_run {
  int lo, hi;
  uint32_t next;
};

struct frame {
  const struct hsr_job *job;
  struct hsr_tally *tally;
  struct hsr_screen screen;
  const char *order;
  enum hsr_stage_method lateral, depth;
  struct hsr_stage_stack stack;

  /* By slot: what tells the runs of a face. */
  struct hsr_face_rows *rows; /* of orders with Y before X */
  uint32_t **column; /* of the others: the last run of each column; the columns
                        begin with that of the face's bounds */
  struct hsr_growing column_runs; /* of struct column_run */
  int *columns;                   /* scratch: the ends of a face's spans */
};

static void take_stage(struct frame *s, const char *rest,
                       struct hsr_stage_list list, struct hsr_window w);

static struct hsr_stage_item *at(const struct frame *s, size_t k) {
  return hsr_stage_at(&s->stack, k);
}

/* The items from number `mark` on. */
static struct hsr_stage_list list_from(const struct frame *s, size_t mark) {
  return (struct hsr_stage_list){mark, s->stack.items.n - mark};
}

/* --- The end: the nearest in a window ------------------------------------- */

/* Whether Z is sorted before the end. */
static bool is_ranked(const struct frame *s) {
  return s->order[strlen(s->order) - 1] != 'Z';
}

/* The samples at the corners of a window, and the nearest face at each. */
struct corners {
  int n, x[4], y[4];
  uint32_t nearest[4];
};

static struct corners corners_of(struct hsr_window w, uint32_t face) {
  struct corners c = {.n = 0};
  for (int y = w.y0; y<w.y1; y += w.y1 - 1> y ? w.y1 - 1 - y : 1)
    for (int x = w.x0; x<w.x1; x += w.x1 - 1> x ? w.x1 - 1 - x : 1) {
      c.x[c.n] = x;
      c.y[c.n] = y;
      c.nearest[c.n++] = face;
    }
  return c;
}

/* Whether all that is not nearer than q is farther than what is nearest so far. */
static bool is_hidden(const struct frame *s, const struct corners *c,
                      double q) {
  for (int k = 0; k < c->n; k++) {
    const uint32_t f = c->nearest[k];
    if (!(q < hsr_depth(&s->screen, f, c->x[k], c->y[k]) -
                  s->screen.plane[f].error))
      return false;
  }
  return true;
}

/* Compares a face with the nearest ones so far, at the corners. */
static void compare(struct frame *s, struct corners *c, uint32_t f,
                    struct hsr_window w) {
  const uint32_t before = c->nearest[0];
  bool nearer = false;
  for (int k = 0; k < c->n; k++)
    if (hsr_nearer(&s->screen, f, c->nearest[k], c->x[k], c->y[k], s->tally)) {
      c->nearest[k] = f;
      nearer = true;
    }
  HSR_STEP(s->tally, c->n > 1 ? IN_SPAN : AT_SAMPLE, HSR_FACE(f),
           HSR_FACE(before), w, nearer);
}

static void paint(struct frame *s, uint32_t f, struct hsr_window w) {
  HSR_STEP(s->tally, SHOWN, HSR_FACE(f), HSR_THE_WINDOW, w, 0);
  for (int j = w.y0; j < w.y1; j++) {
    HSR_TOUCH_SPAN(s->tally, w.x0, w.x1, j);
    for (int i = w.x0; i < w.x1; i++)
      hsr_job_row(s->job, j)[i] = f;
  }
}

/* Shows the nearest item of a list, all of which cover the window. Planes are
 * flat: what is nearest at all corners is nearest in between. If it is not the same
 * one, the window is halved along its longer side. */
static void show(struct frame *s, struct hsr_stage_list list,
                 struct hsr_window w) {
  if (!list.n)
    return;
  struct corners c = corners_of(w, at(s, list.first)->face);
  for (size_t k = list.first + 1; k < list.first + list.n; k++) {
    if (is_ranked(s) && is_hidden(s, &c, at(s, k)->q))
      break;
    compare(s, &c, at(s, k)->face, w);
  }
  bool same = true;
  for (int k = 1; k < c.n; k++)
    same = same && c.nearest[k] == c.nearest[0];
  if (same) {
    paint(s, c.nearest[0], w);
    return;
  }
  HSR_STEP(s->tally, HALVES, HSR_FACE(c.nearest[0]),
           HSR_FACE(c.nearest[c.n - 1]), w, 0);
  const bool wide = w.x1 - w.x0 >= w.y1 - w.y0;
  const int x = wide ? (w.x0 + w.x1) / 2 : w.x1;
  const int y = wide ? w.y1 : (w.y0 + w.y1) / 2;
  show(s, list, hsr_window_make(w.x0, w.y0, x, y));
  show(s, list,
       wide ? hsr_window_make(x, w.y0, w.x1, w.y1)
            : hsr_window_make(w.x0, y, w.x1, w.y1));
}

/* --- Z -------------------------------------------------------------------- */

static void sort_depths(struct frame *s, const char *rest,
                        struct hsr_stage_list list, struct hsr_window w) {
  hsr_stage_sort(&s->stack, list, HSR_STAGE_Z, s->depth, 0, 0);
  for (size_t k = 0; k < list.n; k++)
    at(s, list.first + k)->rank = (uint32_t)k;
  take_stage(s, rest + 1, list, w);
}

/* --- (XY) ----------------------------------------------------------------- */

/* Puts the faces that are not disjoint from the window on top of the stack.
 * Returns whether one of them does not surround it. A face that surrounds a window
 * surrounds its quarters. */
static bool relate(struct frame *s, struct hsr_stage_list list,
                   struct hsr_window w) {
  const struct hsr_area area = hsr_area_make(s->job->view, w);
  bool intersected = false;
  for (size_t k = list.first; k < list.first + list.n; k++) {
    struct hsr_stage_item item = *at(s, k);
    if (!item.surrounds) {
      bool by_box;
      enum hsr_relation relation =
          hsr_area_relate(&s->screen, item.face, s->screen.bounds[item.face],
                          &area, &by_box, s->tally);
      HSR_STEP(s->tally, WINDOWS, HSR_FACE(item.face), HSR_THE_WINDOW, w,
               relation);
      if (relation == HSR_DISJOINT)
        continue;
      item.surrounds = relation == HSR_SURROUNDER;
      intersected = intersected || !item.surrounds;
    }
    hsr_stage_push(&s->stack, item);
  }
  return intersected;
}

static void divide(struct frame *s, const char *rest,
                   struct hsr_stage_list list, struct hsr_window w) {
  const size_t mark = s->stack.items.n;
  if (w.x0 >= w.x1 || w.y0 >= w.y1)
    return;
  if (!relate(s, list, w))
    take_stage(s, rest + 1, list_from(s, mark), w);
  else {
    const int x = (w.x0 + w.x1 + 1) / 2, y = (w.y0 + w.y1 + 1) / 2;
    const struct hsr_stage_list left = list_from(s, mark);
    HSR_STEP(s->tally, DIVISIONS, HSR_THE_WINDOW, HSR_NOTHING, w, 0);
    divide(s, rest, left, hsr_window_make(w.x0, w.y0, x, y));
    divide(s, rest, left, hsr_window_make(x, w.y0, w.x1, y));
    divide(s, rest, left, hsr_window_make(w.x0, y, x, w.y1));
    divide(s, rest, left, hsr_window_make(x, y, w.x1, w.y1));
  }
  s->stack.items.n = mark;
}

/* --- X or Y first: lines -------------------------------------------------- */

/* Adds row j to the runs of a face's column, of which the last is *last. */
static bool extend_column(struct frame *s, uint32_t *last, int j) {
  struct column_run *run = s->column_runs.items;
  if (*last != NONE && run[*last].hi == j) {
    run[*last].hi = j + 1;
    return true;
  }
  if (!hsr_arena_grow(s->job->scratch, &s->column_runs, sizeof *run))
    return false;
  run = s->column_runs.items;
  run[s->column_runs.n - 1] = (struct column_run){j, j + 1, *last};
  *last = (uint32_t)s->column_runs.n - 1;
  return true;
}

/* Finds the runs of all columns of a face, row by row. */
static void find_columns(struct frame *s, const struct hsr_stage_item *item,
                         struct hsr_window w) {
  const struct hsr_bounds *b = &s->screen.bounds[item->face];
  const int first = hsr_max_int(b->x0, w.x0), end = hsr_min_int(b->x1, w.x1);
  struct hsr_face_rows rows;
  uint32_t *last = HSR_NEW(s->job->scratch, uint32_t, (size_t)(end - first));
  s->column[item->slot] = last;
  s->stack.failed = s->stack.failed || !last;
  for (int i = first; last && i < end; i++)
    last[i - first] = NONE;
  hsr_face_rows_begin(&rows, &s->screen, item->face, s->tally);
  for (int j = hsr_max_int(b->y0, w.y0); last && j < hsr_min_int(b->y1, w.y1);
       j++) {
    const int n = hsr_face_rows_spans(&rows, j, s->columns, s->tally);
    for (int k = 0; k < n; k += 2)
      for (int i = hsr_max_int(s->columns[k], first);
           i < hsr_min_int(s->columns[k + 1], end); i++)
        s->stack.failed =
            s->stack.failed || !extend_column(s, &last[i - first], j);
  }
}

/* Makes a face ready to tell its runs. */
static void enter(struct frame *s, const struct hsr_stage_item *item,
                  bool is_row, struct hsr_window w) {
  if (is_row)
    hsr_face_rows_begin(&s->rows[item->slot], &s->screen, item->face, s->tally);
  else
    find_columns(s, item, w);
}

/* Puts a run of a face on top of the stack. `w` is its line. If Z is still to be
 * sorted, by the depths of the run. */
static void push_run(struct frame *s, const char *rest,
                     const struct hsr_stage_item *face, int lo, int hi,
                     bool is_row, struct hsr_window w) {
  struct hsr_stage_item run = *face;
  run.lo = lo;
  run.hi = hi;
  const struct hsr_window part = is_row ? hsr_window_make(lo, w.y0, hi, w.y1)
                                        : hsr_window_make(w.x0, lo, w.x1, hi);
  HSR_STEP(s->tally, RUNS, HSR_FACE(face->face), HSR_THE_WINDOW, part, 0);
  if (strchr(rest, 'Z') && is_ranked(s))
    run.q = fmax(hsr_depth(&s->screen, face->face, part.x0, part.y0),
                 hsr_depth(&s->screen, face->face, part.x1 - 1, part.y1 - 1)) +
            s->screen.plane[face->face].error;
  hsr_stage_push(&s->stack, run);
}

/* The runs of a face on a line. */
static void push_runs(struct frame *s, const char *rest,
                      const struct hsr_stage_item *face, bool is_row,
                      struct hsr_window w) {
  if (is_row) {
    const int n =
        hsr_face_rows_spans(&s->rows[face->slot], w.y0, s->columns, s->tally);
    for (int k = 0; k < n; k += 2) {
      const int lo = hsr_max_int(s->columns[k], w.x0);
      const int hi = hsr_min_int(s->columns[k + 1], w.x1);
      if (lo < hi)
        push_run(s, rest, face, lo, hi, true, w);
    }
    return;
  }
  const int first =
      hsr_max_int(s->screen.bounds[face->face].x0, s->job->view->window.x0);
  uint32_t k = s->column[face->slot][w.x0 - first];
  while (k != NONE) {
    const struct column_run run =
        ((const struct column_run *)s->column_runs.items)[k];
    push_run(s, rest, face, run.lo, run.hi, false, w);
    k = run.next;
  }
}

/* Puts an item on top, into the active list that begins at `mark`: at its end, or
 * at the place of its rank if Z is sorted already. */
static void activate(struct frame *s, size_t mark, struct hsr_stage_item item,
                     bool by_rank) {
  hsr_stage_push(&s->stack, item);
  size_t place = s->stack.items.n - 1;
  for (; by_rank && !s->stack.failed && place > mark; place--) {
    const bool behind = at(s, place - 1)->rank > item.rank;
    HSR_STEP(s->tally, ACTIVE, HSR_FACE(at(s, place - 1)->face),
             HSR_FACE(item.face), HSR_NOWHERE, behind);
    if (!behind)
      break;
    *at(s, place) = *at(s, place - 1);
  }
  *at(s, place) = item;
}

/* Takes those that end before `place` out of the active list. */
static void retire(struct frame *s, size_t mark, int place) {
  size_t kept = mark;
  for (size_t k = mark; k < s->stack.items.n; k++) {
    const bool ends = at(s, k)->hi <= place;
    HSR_STEP(s->tally, ACTIVE, HSR_FACE(at(s, k)->face), HSR_NOTHING,
             HSR_NOWHERE, ends);
    if (!ends)
      *at(s, kept++) = *at(s, k);
  }
  s->stack.items.n = kept;
}

/* Without a sort: looks at all items for those that are active. *end becomes the
 * next place where that changes, if it is nearer. */
static void search_active(struct frame *s, enum hsr_stage_axis axis,
                          struct hsr_stage_list list, int place, int *end) {
  for (size_t k = list.first; k < list.first + list.n; k++) {
    const struct hsr_stage_item item = *at(s, k);
    const bool active = item.lo <= place && place < item.hi;
    HSR_STEP(s->tally, SORT_X + (int)axis, HSR_FACE(item.face), HSR_NOTHING,
             HSR_NOWHERE, active);
    if (active)
      hsr_stage_push(&s->stack, item);
    if (item.lo > place)
      *end = hsr_min_int(*end, item.lo);
    else if (active)
      *end = hsr_min_int(*end, item.hi);
  }
}

/* A sweep along an axis: which of the items of a sorted list are active. */
struct sweep {
  enum hsr_stage_axis axis;
  struct hsr_stage_list list;
  size_t next, mark; /* the next item to enter; where the active list begins */
  bool by_rank;
};

/* Brings the active list to a place, and returns up to where it holds. */
static int advance(struct frame *s, struct sweep *sweep, int place, int end) {
  if (s->lateral == HSR_STAGE_SEARCH) {
    s->stack.items.n = sweep->mark;
    search_active(s, sweep->axis, sweep->list, place, &end);
    return end;
  }
  const size_t last = sweep->list.first + sweep->list.n;
  retire(s, sweep->mark, place);
  for (; sweep->next < last && at(s, sweep->next)->lo <= place; sweep->next++)
    activate(s, sweep->mark, *at(s, sweep->next), sweep->by_rank);
  if (sweep->next < last)
    end = hsr_min_int(end, at(s, sweep->next)->lo);
  for (size_t k = sweep->mark; k < s->stack.items.n; k++)
    end = hsr_min_int(end, at(s, k)->hi);
  return end;
}

/* Whether Z is sorted before this stage. */
static bool is_after_z(const struct frame *s, const char *rest) {
  const char *z = strchr(s->order, 'Z');
  return z && z < rest;
}

/* Sorts a list, and begins a sweep over it with an empty active list. */
static struct sweep begin_sweep(struct frame *s, const char *rest,
                                struct hsr_stage_list list, int from, int to) {
  const enum hsr_stage_axis axis = *rest == 'X' ? HSR_STAGE_X : HSR_STAGE_Y;
  hsr_stage_sort(&s->stack, list, axis, s->lateral, from, to);
  return (struct sweep){axis, list, list.first, s->stack.items.n,
                        is_after_z(s, rest)};
}

static void take_lines(struct frame *s, const char *rest,
                       struct hsr_stage_list list, struct hsr_window w) {
  const bool is_row = *rest == 'Y';
  const int from = is_row ? w.y0 : w.x0, to = is_row ? w.y1 : w.x1;
  for (size_t k = list.first; k < list.first + list.n; k++) {
    const struct hsr_bounds *b = &s->screen.bounds[at(s, k)->face];
    at(s, k)->lo = hsr_max_int(is_row ? b->y0 : b->x0, from);
    at(s, k)->hi = hsr_min_int(is_row ? b->y1 : b->x1, to);
    at(s, k)->slot = (uint32_t)(k - list.first);
  }
  struct sweep sweep = begin_sweep(s, rest, list, from, to);
  for (int line = from; line < to && !s->stack.failed; line++) {
    const struct hsr_window on =
        is_row ? hsr_window_make(w.x0, line, w.x1, line + 1)
               : hsr_window_make(line, w.y0, line + 1, w.y1);
    advance(s, &sweep, line, to);
    const size_t end = s->stack.items.n;
    for (size_t k = sweep.mark; k < end && !s->stack.failed; k++) {
      const struct hsr_stage_item face = *at(s, k);
      if (face.lo == line)
        enter(s, &face, is_row, w);
      if (!s->stack.failed)
        push_runs(s, rest + 1, &face, is_row, on);
    }
    if (!s->stack.failed)
      take_stage(s, rest + 1, list_from(s, end), on);
    s->stack.items.n = end;
  }
  s->stack.items.n = sweep.mark;
}

/* --- X or Y second: spans ------------------------------------------------- */

static void take_spans(struct frame *s, const char *rest,
                       struct hsr_stage_list list, struct hsr_window w) {
  const bool along_x = *rest == 'X';
  const int from = along_x ? w.x0 : w.y0, to = along_x ? w.x1 : w.y1;
  struct sweep sweep = begin_sweep(s, rest, list, from, to);
  for (int place = from, end; place < to && !s->stack.failed; place = end) {
    end = advance(s, &sweep, place, to);
    take_stage(s, rest + 1, list_from(s, sweep.mark),
               along_x ? hsr_window_make(place, w.y0, end, w.y1)
                       : hsr_window_make(w.x0, place, w.x1, end));
  }
  s->stack.items.n = sweep.mark;
}

/* --- The order ------------------------------------------------------------ */

static bool is_on_line(const struct frame *s, const char *rest) {
  const char *lateral = strpbrk(s->order, "XY");
  return lateral && lateral < rest;
}

/* Takes the stage of the first axis of `rest`, which takes the others. */
static void take_stage(struct frame *s, const char *rest,
                       struct hsr_stage_list list, struct hsr_window w) {
  if (s->stack.failed || !list.n)
    return;
  if (!*rest || !strcmp(rest, "Z"))
    show(s, list, w);
  else if (*rest == 'Z')
    sort_depths(s, rest, list, w);
  else if (*rest == 'A')
    divide(s, rest, list, w);
  else if (is_on_line(s, rest))
    take_spans(s, rest, list, w);
  else
    take_lines(s, rest, list, w);
}

/* No part of a face is nearer than this q. */
static double nearest_q(const struct hsr_screen *screen, uint32_t f) {
  const struct hsr_mesh *mesh = &screen->world->mesh;
  double q = -INFINITY;
  if (!screen->whole[f])
    return INFINITY;
  for (uint32_t k = mesh->start[f]; k < mesh->start[f + 1]; k++)
    q = fmax(q, hsr_vertex_depth(screen, f, mesh->vertex[k]));
  return q + hsr_vertex_error(screen, f);
}

static enum hsr_status make_room(struct frame *s) {
  struct hsr_arena *scratch = s->job->scratch;
  const struct hsr_window *w = &s->job->view->window;
  const size_t n = s->screen.n_relevant;
  const size_t lines = (size_t)hsr_max_int(w->x1 - w->x0, w->y1 - w->y0);
  s->stack.n_room = (lines > n ? lines : n) + 2;
  s->stack.room = HSR_NEW(scratch, uint32_t, s->stack.n_room);
  s->columns = HSR_NEW(scratch, int, hsr_most_corners(s->job->world) + 4);
  const char *lateral = strpbrk(s->order, "XY");
  if (lateral && *lateral == 'Y')
    s->rows = HSR_NEW(scratch, struct hsr_face_rows, n);
  else if (lateral)
    s->column = HSR_NEW(scratch, uint32_t *, n);
  return s->stack.room && s->columns && (!lateral || s->rows || s->column)
             ? HSR_OK
             : HSR_E_NOMEM;
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct frame s = {.job = job,
                    .tally = job->tally,
                    .order = axes_of[job->option[ORDER]],
                    .lateral = (enum hsr_stage_method)job->option[LATERAL],
                    .depth = (enum hsr_stage_method)job->option[DEPTH],
                    .stack = {.arena = job->scratch,
                              .tally = job->tally,
                              .sorts = SORT_X,
                              .buckets = PUT_X}};
  if (hsr_screen_make(&s.screen, job->world, job->view, job->scratch,
                      job->tally) ||
      make_room(&s))
    return hsr_fail_nomem(err);
  hsr_job_clear(job);
  for (uint32_t r = 0; r < s.screen.n_relevant && !s.stack.failed; r++) {
    const uint32_t f = s.screen.relevant[r];
    hsr_stage_push(&s.stack, (struct hsr_stage_item){
                                 .face = f, .q = nearest_q(&s.screen, f)});
  }
  take_stage(&s, s.order, list_from(&s, 0), job->view->window);
  return s.stack.failed ? hsr_fail_nomem(err) : HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_counter counters[] = {
    [SORT_X] = {"X sort", "items compared in X", HSR_SORT, HSR_OF_FACE,
                HSR_OF_FACE, "in order|out of order"},
    [SORT_Y] = {"Y sort", "items compared in Y", HSR_SORT, HSR_OF_FACE,
                HSR_OF_FACE, "in order|out of order",
                .outcome_keys = "first-row|first-row"},
    [SORT_Z] = {"Z sort", "items compared in Z", HSR_SORT, HSR_OF_FACE,
                HSR_OF_FACE, "in order|out of order"},
    [PUT_X] = {"X buckets", "items put into buckets in X", HSR_SORT,
               HSR_OF_FACE, HSR_OF_NOTHING},
    [PUT_Y] = {"Y buckets", "items put into buckets in Y", HSR_SORT,
               HSR_OF_FACE, HSR_OF_NOTHING},
    [PUT_Z] = {"Z buckets", "items put into buckets in Z", HSR_SORT,
               HSR_OF_FACE, HSR_OF_NOTHING},
    [ACTIVE] = {"active list", "items of an active list looked at",
                HSR_ACTIVATE, HSR_OF_FACE, HSR_OF_FACE, "stays|goes"},
    [RUNS] = {"runs", "stretches of a line that a face covers", HSR_SPAN,
              HSR_OF_FACE, HSR_OF_WINDOW},
    [WINDOWS] = {"window tests", "faces compared with a window", HSR_COMPARE,
                 HSR_OF_FACE, HSR_OF_WINDOW, "disjoint|intersecter|surrounder"},
    [DIVISIONS] = {"subdivisions", "windows divided into four", HSR_SUBDIVIDE,
                   HSR_OF_WINDOW, HSR_OF_NOTHING},
    [IN_SPAN] = {"depths in spans", "faces searched for depth in a span",
                 HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, "farther|nearer"},
    [AT_SAMPLE] = {"depths at samples", "faces searched for depth at a sample",
                   HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, "farther|nearer"},
    [HALVES] = {"halved spans", "spans whose nearest face changes",
                HSR_SUBDIVIDE, HSR_OF_FACE, HSR_OF_FACE},
    [SHOWN] = {"shown", "spans and windows given to a face", HSR_ACCEPT,
               HSR_OF_FACE, HSR_OF_WINDOW},
    {NULL}};

static const struct hsr_line outline[] = {
    {"for each axis of the order, in each window that the last one left"},
    {"  Z: compare the items by their nearest depths",
     HSR_RAISES(SORT_Z, PUT_Z)},
    {"  Y: compare the items by their first rows", HSR_RAISES(SORT_Y, PUT_Y)},
    {"  X: compare the items by their first columns",
     HSR_RAISES(SORT_X, PUT_X)},
    {"    for each line or span: which items are active?", HSR_RAISES(ACTIVE)},
    {"    the first of X and Y: find the runs of each face on the line",
     HSR_RAISES(RUNS)},
    {"  (XY): disjoint, an intersecter, a surrounder?", HSR_RAISES(WINDOWS)},
    {"    divide the window if there is an intersecter", HSR_RAISES(DIVISIONS)},
    {"at the end: is this item nearer than the nearest so far?",
     HSR_RAISES(IN_SPAN, AT_SAMPLE)},
    {"  halve the span if its ends have different ones", HSR_RAISES(HALVES)},
    {"  show the nearest", HSR_RAISES(SHOWN)},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {"faces", "the first axis", "as chosen", "once a frame"},
    {"faces or runs", "the second axis", "as chosen", "once a line"},
    {"faces or runs", "the last axis", "as chosen, or search", "once a span"},
    {NULL}};

static const struct hsr_step steps[] = {
    {"Y sort", SORT_Y, HSR_KIND_NUMBERS, .more = {{PUT_Y, HSR_KIND_BUCKET}}},
    {"X sort", SORT_X, HSR_KIND_NUMBERS, .more = {{PUT_X, HSR_KIND_BUCKET}}},
    {"Z sort", SORT_Z, HSR_KIND_NUMBERS, .more = {{PUT_Z, HSR_KIND_BUCKET}}},
    {"active lists", ACTIVE, HSR_KIND_LIST},
    {"segments", RUNS, HSR_KIND_SEGMENT},
    {"window tests", WINDOWS, HSR_KIND_FACE_WINDOW},
    {"depth search", IN_SPAN, HSR_KIND_SPAN,
     .more = {{AT_SAMPLE, HSR_KIND_SAMPLE}}},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(sort_stages) = {
    .name = "sort-stages",
    .title = "Sorts in X, Y and Z, in any order",
    .authors = "hsr, after I. E. Sutherland, R. F. Sproull, R. A. Schumacker",
    .source = "the orders: Sutherland et al., Computing Surveys 6(1), 1974, "
              "chapter IV",
    .taxonomy = HSR_IMAGE_SPACE_POINT,
    .sort_order = "any",
    .coherence = NULL,
    .restrictions = 0,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}},
    .options = options,
    .sorts = sorts,
    .counters = counters,
    .steps = steps,
    .outline = outline,
    .render = render};
