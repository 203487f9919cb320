/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The Z sort of yzx: see yzx_list.h. */
#include "algorithms/image_space/point/yzx_list.h"
#include "common/base/numbers.h"

#include <math.h>
#include <limits.h>
#include <string.h>

/* Not divided. */
static const uint32_t NONE = HSR_NO_ID;

/* How one piece is to stand to another. */
enum order { EITHER, BEFORE, BEHIND, UNSETTLED };

/* --- Pieces --------------------------------------------------------------- */

static struct yzx_piece *piece_in(const struct hsr_growing *array, size_t k) {
  return ((struct yzx_piece **)array->items)[k];
}

static void push(struct yzx_list *s, struct hsr_growing *array,
                 struct yzx_piece *piece) {
  if (hsr_arena_grow(s->job->scratch, array, sizeof piece))
    ((struct yzx_piece **)array->items)[array->n - 1] = piece;
  else
    s->out_of_memory = true;
}

static void remove_at(struct hsr_growing *array, size_t k) {
  struct yzx_piece **items = array->items;
  array->n--;
  memmove(items + k, items + k + 1, (array->n - k) * sizeof *items);
}

static void remove_piece(struct hsr_growing *array,
                         const struct yzx_piece *piece) {
  for (size_t k = 0; k < array->n; k++)
    if (piece_in(array, k) == piece)
      remove_at(array, k--);
}

static struct yzx_piece *new_piece(struct yzx_list *s, uint32_t face) {
  enum { AT_ONCE = 256 };
  if (!s->n_unused) {
    s->unused = HSR_NEW(s->job->scratch, struct yzx_piece, AT_ONCE);
    s->n_unused = s->unused ? AT_ONCE : 0;
  }
  if (!s->n_unused) {
    s->out_of_memory = true;
    return NULL;
  }
  struct yzx_piece *piece = &s->unused[--s->n_unused];
  *piece = (struct yzx_piece){.face = face,
                              .by = NONE,
                              .polygon = {.face = face},
                              .bounds = s->screen->bounds[face],
                              .later = NONE};
  return piece;
}

static struct yzx_relation *relation(const struct yzx_list *s, uint32_t r) {
  return (struct yzx_relation *)s->relations.items + r;
}

/* From now on a is to stand before b. */
static void relate(struct yzx_list *s, struct yzx_piece *a,
                   struct yzx_piece *b) {
  if (!hsr_arena_grow(s->job->scratch, &s->relations,
                      sizeof(struct yzx_relation))) {
    s->out_of_memory = true;
    return;
  }
  uint32_t r = (uint32_t)s->relations.n - 1;
  *relation(s, r) = (struct yzx_relation){b, a->later};
  a->later = r;
}

static inline struct hsr_window the_row(const struct yzx_list *s) {
  const struct hsr_window *w = &s->job->view->window;
  return HSR_ON(w->x0, w->x1, s->j);
}

/* Tells the pieces of order[], from this one on, their places. */
static void tell_places(struct yzx_list *s, size_t from) {
  struct yzx_piece **order = s->order.items;
  for (size_t k = from; k < s->order.n; k++)
    order[k]->place = (uint32_t)k;
}

/* Takes a piece out of order[]. */
static void take_out(struct yzx_list *s, struct yzx_piece *piece) {
  remove_at(&s->order, piece->place);
  tell_places(s, piece->place);
  piece->active = false;
}

/* --- Division ------------------------------------------------------------- */

/* Makes the half of a piece on one side of the plane by which it is divided. */
static struct yzx_piece *make_half(struct yzx_list *s, struct yzx_piece *whole,
                                   int side) {
  struct hsr_arena *arena = s->job->scratch;
  uint32_t n = whole->polygon.outline
                   ? whole->polygon.n
                   : hsr_face_size(s->job->world, whole->face);
  struct hsr_cut *cuts = HSR_NEW(arena, struct hsr_cut, whole->n_cuts + 1);
  double(*points)[3] = hsr_arena_array(arena, n + n / 2 + 1, sizeof *points);
  struct yzx_piece *half = new_piece(s, whole->face);
  if (n > s->scratch_room) {
    s->scratch = hsr_arena_array(arena, 2 * (size_t)n, sizeof *s->scratch);
    s->scratch_room = s->scratch ? 2 * n : 0;
  }
  if (!cuts || !points || !half || !s->scratch) {
    s->out_of_memory = true;
    return NULL;
  }
  if (whole->n_cuts)
    memcpy(cuts, whole->cuts, whole->n_cuts * sizeof *cuts);
  cuts[whole->n_cuts] = (struct hsr_cut){whole->by, side};
  half->whole = whole;
  half->n_cuts = whole->n_cuts + 1;
  half->cuts = cuts;
  half->polygon = hsr_divide_outline(s->screen, whole->polygon,
                                     cuts[whole->n_cuts], points, s->scratch);
  half->bounds = hsr_outline_bounds(s->screen, half->polygon);
  return half;
}

/* Divides a piece, which is not in order[], by the plane of g. Its halves are to
 * enter. */
static void divide(struct yzx_list *s, struct yzx_piece *piece, uint32_t g) {
  int eye = hsr_eye_side(s->screen, g, s->tally);
  HSR_STEP(s->tally, YZX_DIVISIONS, HSR_FACE(piece->face), HSR_FACE(g),
           the_row(s), 0);
  piece->by = g;
  for (int k = 0; k < 2 && !s->out_of_memory; k++) {
    piece->half[k] = make_half(s, piece, k ? -eye : eye);
    if (piece->half[k])
      push(s, &s->entering, piece->half[k]);
  }
}

/* Has `a` been divided by the plane of g? +1 if it belongs to the half in front
 * of that plane, -1 if to that behind, 0 if it was not. */
static int side_by_division(const struct yzx_list *s, const struct yzx_piece *a,
                            uint32_t g) {
  const uint32_t *plane = s->job->world->mesh.plane;
  for (const struct yzx_piece *part = a; part->whole; part = part->whole)
    if (plane[part->whole->by] == plane[g])
      return part->whole->half[0] == part ? 1 : -1;
  return 0;
}

/* --- The order of two ----------------------------------------------------- */

static void include_depth(struct yzx_extent *extent, double q) {
  if (extent->nearest < q)
    extent->nearest = q;
  if (extent->farthest > q)
    extent->farthest = q;
}

/* The samples of a whole face lie between its vertices, those of a cut face
 * within its bounds. */
static struct yzx_extent find_extent(const struct yzx_list *s, uint32_t f) {
  const struct hsr_world *world = s->job->world;
  const struct hsr_bounds *b = &s->screen->bounds[f];
  struct yzx_extent extent = {-INFINITY, INFINITY};
  if (s->screen->whole[f])
    for (uint32_t k = world->mesh.start[f]; k < world->mesh.start[f + 1]; k++)
      include_depth(&extent,
                    hsr_vertex_depth(s->screen, f, world->mesh.vertex[k]));
  else
    for (int corner = 0; corner < 4; corner++)
      include_depth(&extent,
                    hsr_depth(s->screen, f, corner & 1 ? b->x1 - 1 : b->x0,
                              corner & 2 ? b->y1 - 1 : b->y0));
  double error = hsr_vertex_error(s->screen, f);
  return (struct yzx_extent){extent.nearest + error, extent.farthest - error};
}

/* The outcomes overlap, nearer, farther; and through, in front, behind. */
static inline int outcome_of(int side) {
  return side < 0 ? 2 : side;
}

/* Tests 2 and 3. */
static bool boxes_overlap(const struct yzx_list *s, const struct yzx_piece *a,
                          const struct yzx_piece *b) {
  bool x = a->bounds.x0 < b->bounds.x1 && b->bounds.x0 < a->bounds.x1;
  HSR_STEP(s->tally, YZX_MINIMAX, HSR_FACE(a->face), HSR_FACE(b->face),
           the_row(s), x);
  if (!x)
    return false;
  bool y = a->bounds.y0 < b->bounds.y1 && b->bounds.y0 < a->bounds.y1;
  HSR_STEP(s->tally, YZX_MINIMAX, HSR_FACE(a->face), HSR_FACE(b->face),
           the_row(s), 2 + y);
  return y;
}

/* Test 1: +1 if all of f is nearer than all of g, -1 if all of g than all of f,
 * else 0. */
static int compare_extents(const struct yzx_list *s, uint32_t f, uint32_t g) {
  int side = (s->extent[f].farthest > s->extent[g].nearest) -
             (s->extent[g].farthest > s->extent[f].nearest);
  HSR_STEP(s->tally, YZX_Z_MINIMAX, HSR_FACE(f), HSR_FACE(g), the_row(s),
           outcome_of(side));
  return side;
}

/* Tests 4 and 5, of a face: +1 if all of f lies in front of g's plane, -1 if all
 * of it behind, else 0; also if f is cut by the near plane. */
static int side_of_face(const struct yzx_list *s, uint32_t f, uint32_t g) {
  if (!s->screen->whole[f])
    return 0;
  const struct hsr_world *world = s->job->world;
  bool in_front = true, behind = true;
  for (uint32_t k = world->mesh.start[f];
       k < world->mesh.start[f + 1] && (in_front || behind); k++) {
    int nearer =
        hsr_vertex_nearer(s->screen, f, g, world->mesh.vertex[k], s->tally);
    HSR_STEP(s->tally, YZX_Z_SORT, HSR_VERTEX(world->mesh.vertex[k]),
             HSR_FACE(g), the_row(s), outcome_of(nearer));
    in_front &= nearer >= 0;
    behind &= nearer <= 0;
  }
  return in_front - behind;
}

/* The same of a piece. What is left of a flat face is tested by its outline;
 * else the whole face is. */
static int side_of_plane(const struct yzx_list *s, const struct yzx_piece *a,
                         uint32_t g) {
  const struct hsr_mesh *mesh = &s->job->world->mesh;
  if (a->n_cuts && mesh->deviation[a->face] == 0 && mesh->deviation[g] == 0) {
    bool in_front = hsr_before(s->screen, a->polygon, g, s->tally) == HSR_YES;
    bool behind =
        !in_front && hsr_beyond(s->screen, a->polygon, g, s->tally) == HSR_YES;
    HSR_STEP(s->tally, YZX_PIECES, HSR_FACE(a->face), HSR_FACE(g), the_row(s),
             outcome_of(in_front - behind));
    if (in_front || behind)
      return in_front - behind;
  }
  return side_of_face(s, a->face, g);
}

/* Test 6: have they a sample in common on the row or on one to come? */
static bool overlap(struct yzx_list *s, const struct yzx_piece *a,
                    const struct yzx_piece *b) {
  int row = hsr_max_int(s->j, hsr_max_int(a->bounds.y0, b->bounds.y0));
  int end = hsr_min_int(a->bounds.y1, b->bounds.y1);
  bool meet = false;
  for (; row < end && !meet; row++) {
    int n = hsr_piece_spans(s->screen, a->face, a->cuts, a->n_cuts, row,
                            s->columns, s->tally);
    int m = n ? hsr_piece_spans(s->screen, b->face, b->cuts, b->n_cuts, row,
                                s->other_columns, s->tally)
              : 0;
    meet = hsr_spans_meet(s->columns, n, s->other_columns, m, INT_MIN, INT_MAX);
    HSR_STEP(s->tally, YZX_ROWS, HSR_FACE(a->face), HSR_FACE(b->face),
             HSR_ON(s->job->view->window.x0, s->job->view->window.x1, row),
             meet);
  }
  return meet;
}

/* How a is to stand to b, two pieces of different faces. */
static enum order find_order(struct yzx_list *s, const struct yzx_piece *a,
                             const struct yzx_piece *b) {
  uint32_t f = a->face, g = b->face;
  const uint32_t *plane = s->job->world->mesh.plane;
  if (!boxes_overlap(s, a, b))
    return EITHER;
  if (plane[f] == plane[g])
    return f < g ? BEHIND : BEFORE; /* the lower one is seen */
  int side = side_by_division(s, a, g);
  if (!side)
    side = -side_by_division(s, b, f);
  if (!side)
    side = compare_extents(s, f, g);
  if (side)
    return side > 0 ? BEHIND : BEFORE;
  int of_a = side_of_plane(s, a, g), of_b = side_of_plane(s, b, f);
  bool before = of_a < 0 || of_b > 0, behind = of_a > 0 || of_b < 0;
  if (before && behind)
    return EITHER;
  if (before || behind)
    return before ? BEFORE : BEHIND;
  return overlap(s, a, b) ? UNSETTLED : EITHER;
}

/* --- Circles -------------------------------------------------------------- */

/* Forgets that a is to stand before b, where x is the one that enters. */
static void forget(struct yzx_list *s, const struct yzx_piece *x,
                   struct yzx_piece *a, struct yzx_piece *b) {
  if (a == x)
    remove_piece(&s->later, b);
  else if (b == x)
    remove_piece(&s->earlier, a);
  for (uint32_t *r = &a->later; a != x && *r != NONE;)
    if (relation(s, *r)->piece == b)
      *r = relation(s, *r)->next;
    else
      r = &relation(s, *r)->next;
}

/* Whether the plane of b's face passes through a, as far as can be told. */
static bool passes_through(const struct yzx_list *s, const struct yzx_piece *a,
                           const struct yzx_piece *b) {
  const uint32_t *plane = s->job->world->mesh.plane;
  bool passes = plane[a->face] != plane[b->face] &&
                !side_by_division(s, a, b->face) &&
                !side_of_plane(s, a, b->face);
  HSR_STEP(s->tally, YZX_CIRCLES, HSR_FACE(a->face), HSR_FACE(b->face),
           the_row(s), passes);
  return passes;
}

/* Breaks the circle of x, which enters, and the pieces from `last` back to it:
 * each is to stand before the next. Either two of them have no sample in common,
 * and then they need no order; or one is divided. */
static void break_circle(struct yzx_list *s, struct yzx_piece *x,
                         struct yzx_piece *last) {
  s->circle.n = 0;
  for (struct yzx_piece *a = last; a; a = a->from)
    push(s, &s->circle, a);
  push(s, &s->circle, x);
  size_t n = s->circle.n;
  for (size_t k = 0; k < n && !s->out_of_memory; k++) {
    struct yzx_piece *b = piece_in(&s->circle, k);
    struct yzx_piece *a = piece_in(&s->circle, (k + 1) % n);
    if (!overlap(s, a, b)) {
      forget(s, x, a, b);
      return;
    }
  }
  for (size_t k = 0; k < n && !s->out_of_memory; k++)
    for (size_t l = 0; l < n; l++) {
      struct yzx_piece *a = piece_in(&s->circle, k);
      if (l == k || !passes_through(s, a, piece_in(&s->circle, l)))
        continue;
      if (a != x)
        take_out(s, a);
      divide(s, a, piece_in(&s->circle, l)->face);
      return;
    }
  forget(s, x, last,
         x); /* never: planes that pass through none give an order */
}

/* --- Places --------------------------------------------------------------- */

/* Marks what relations put behind x, up to place lo. Returns one that is to
 * stand before x, or NULL. */
static struct yzx_piece *reach(struct yzx_list *s, uint32_t lo) {
  s->reached.n = 0;
  for (size_t k = 0; k < s->later.n; k++) {
    struct yzx_piece *a = piece_in(&s->later, k);
    if (a->active && a->place <= lo) {
      a->reached = s->mark;
      a->from = NULL;
      push(s, &s->reached, a);
    }
  }
  for (size_t k = 0; k < s->reached.n; k++) {
    struct yzx_piece *a = piece_in(&s->reached, k);
    if (a->earlier_than == s->mark)
      return a;
    for (uint32_t *r = &a->later; *r != NONE;) {
      struct yzx_piece *b = relation(s, *r)->piece;
      if (!b->active) { /* it has ended, or was divided */
        *r = relation(s, *r)->next;
        continue;
      }
      r = &relation(s, *r)->next;
      if (b->place > lo || b->reached == s->mark)
        continue;
      b->reached = s->mark;
      b->from = a;
      push(s, &s->reached, b);
    }
  }
  return NULL;
}

/* Puts x behind place lo, and behind x those of the places [hi, lo] that have
 * been reached. */
static void insert(struct yzx_list *s, struct yzx_piece *x, size_t hi,
                   size_t lo) {
  push(s, &s->order, x);
  if (s->out_of_memory)
    return;
  struct yzx_piece **order = s->order.items;
  size_t n = s->order.n, to = hi;
  s->circle.n = 0;
  memmove(order + lo + 2, order + lo + 1, (n - 2 - lo) * sizeof *order);
  for (size_t k = hi; k <= lo; k++)
    if (order[k]->reached != s->mark) {
      order[to++] = order[k];
    } else {
      HSR_STEP(s->tally, YZX_MOVED, HSR_FACE(order[k]->face), HSR_FACE(x->face),
               the_row(s), 0);
      push(s, &s->circle, order[k]);
    }
  order[to++] = x;
  for (size_t k = 0; k < s->circle.n; k++)
    order[to++] = piece_in(&s->circle, k);
}

/* The places of which the header speaks, as numbers of pieces: x is to stand
 * behind the first *behind, and before the piece *before. */
static void find_places(struct yzx_list *s, size_t *behind, size_t *before) {
  *behind = 0;
  *before = s->order.n;
  s->mark++;
  for (size_t k = 0; k < s->earlier.n; k++) {
    struct yzx_piece *a = piece_in(&s->earlier, k);
    a->earlier_than = s->mark;
    if (a->active && a->place + 1 > *behind)
      *behind = a->place + 1;
  }
  for (size_t k = 0; k < s->later.n; k++) {
    struct yzx_piece *a = piece_in(&s->later, k);
    if (a->active && a->place < *before)
      *before = a->place;
  }
}

/* Puts x into order[], unless it is divided. */
static void place(struct yzx_list *s, struct yzx_piece *x) {
  size_t behind = 0, before = 0;
  while (!s->out_of_memory) {
    find_places(s, &behind, &before);
    struct yzx_piece *last =
        behind > before ? reach(s, (uint32_t)behind - 1) : NULL;
    if (!last)
      break;
    break_circle(s, x, last);
    if (x->by != NONE)
      return;
  }
  for (size_t k = 0; k < s->later.n; k++)
    relate(s, x, piece_in(&s->later, k));
  for (size_t k = 0; k < s->earlier.n; k++)
    relate(s, piece_in(&s->earlier, k), x);
  if (s->out_of_memory)
    return;
  x->active = true;
  if (behind > before) {
    insert(s, x, before, behind - 1);
    tell_places(s, before);
    return;
  }
  push(s, &s->order, x);
  if (s->out_of_memory)
    return;
  struct yzx_piece **order = s->order.items;
  memmove(order + behind + 1, order + behind,
          (s->order.n - 1 - behind) * sizeof *order);
  order[behind] = x;
  tell_places(s, behind);
}

static bool ends_sooner(const struct yzx_piece *a, const struct yzx_piece *b) {
  return a->bounds.y1 < b->bounds.y1;
}

/* Enters a piece: finds its order to each that is active, and its place. */
static void enter(struct yzx_list *s, struct yzx_piece *x) {
  s->earlier.n = s->later.n = 0;
  for (size_t k = 0; k < s->order.n && !s->out_of_memory; k++) {
    struct yzx_piece *a = piece_in(&s->order, k);
    enum order order = a->face == x->face ? EITHER : find_order(s, x, a);
    if (order == BEFORE)
      push(s, &s->later, a);
    else if (order == BEHIND)
      push(s, &s->earlier, a);
    if (order != UNSETTLED)
      continue;
    if (!ends_sooner(a, x)) {
      divide(s, x, a->face);
      return;
    }
    take_out(s, a);
    divide(s, a, x->face);
    k--;
  }
  if (!s->out_of_memory)
    place(s, x);
}

/* --- The list ------------------------------------------------------------- */

static int first_row(const struct yzx_list *s, uint32_t f) {
  return hsr_max_int(s->screen->bounds[f].y0, s->job->view->window.y0);
}

static void fill_buckets(struct yzx_list *s) {
  const struct hsr_window *w = &s->job->view->window;
  const struct hsr_screen *screen = s->screen;
  for (uint32_t r = 0; r < screen->n_relevant; r++) {
    uint32_t f = screen->relevant[r];
    int row = first_row(s, f);
    HSR_STEP(s->tally, YZX_FACES, HSR_FACE(f), HSR_NOTHING,
             HSR_ON(w->x0, w->x1, row), 0);
    s->bucket[row - w->y0 + 2]++;
  }
  for (int k = 2; k < w->y1 - w->y0 + 2; k++)
    s->bucket[k] += s->bucket[k - 1];
  for (uint32_t r = 0; r < screen->n_relevant; r++) {
    uint32_t f = screen->relevant[r];
    s->in_bucket[s->bucket[first_row(s, f) - w->y0 + 1]++] = f;
  }
}

enum hsr_status yzx_list_begin(struct yzx_list *s, const struct hsr_job *job,
                               const struct hsr_screen *screen) {
  const struct hsr_world *world = job->world;
  const struct hsr_window *w = &job->view->window;
  struct hsr_arena *arena = job->scratch;
  size_t columns = hsr_most_corners(world) + 4;
  *s = (struct yzx_list){.job = job, .screen = screen, .tally = job->tally};
  s->bucket = HSR_NEW_ZEROED(arena, uint32_t, (size_t)(w->y1 - w->y0) + 2);
  s->in_bucket = HSR_NEW(arena, uint32_t, screen->n_relevant);
  s->root = HSR_NEW_ZEROED(arena, struct yzx_piece *, world->n_faces);
  s->extent = HSR_NEW(arena, struct yzx_extent, world->n_faces);
  s->columns = HSR_NEW(arena, int, columns);
  s->other_columns = HSR_NEW(arena, int, columns);
  if (!s->bucket || !s->in_bucket || !s->root || !s->extent || !s->columns ||
      !s->other_columns)
    return HSR_E_NOMEM;
  for (uint32_t r = 0; r < screen->n_relevant; r++)
    s->extent[screen->relevant[r]] = find_extent(s, screen->relevant[r]);
  fill_buckets(s);
  return HSR_OK;
}

/* Deletes the pieces that have ended. */
static void delete_ended(struct yzx_list *s) {
  struct yzx_piece **order = s->order.items;
  size_t kept = 0;
  for (size_t k = 0; k < s->order.n; k++) {
    order[k]->active = order[k]->bounds.y1 > s->j;
    if (order[k]->active)
      order[kept++] = order[k];
  }
  s->order.n = kept;
  tell_places(s, 0);
}

void yzx_list_advance(struct yzx_list *s, int j) {
  int k = j - s->job->view->window.y0;
  s->j = j;
  delete_ended(s);
  for (uint32_t b = s->bucket[k]; b < s->bucket[k + 1]; b++) {
    uint32_t f = s->in_bucket[b];
    s->root[f] = new_piece(s, f);
    if (s->root[f])
      push(s, &s->entering, s->root[f]);
    while (s->entering.n && !s->out_of_memory) {
      struct yzx_piece *x = piece_in(&s->entering, --s->entering.n);
      if (x->bounds.y1 > j && x->bounds.x0 < x->bounds.x1)
        enter(s, x);
    }
  }
  for (size_t n = s->order.n, p = 0; p < n; p++)
    piece_in(&s->order, p)->number = (uint32_t)(n - 1 - p);
}
