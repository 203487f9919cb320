/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Newell's priority computer: see priority_list.h. */
#include "algorithms/list_priority/per_frame/kept_order.h"
#include "algorithms/list_priority/per_frame/priority_pieces.h"

#include <string.h>

static const uint32_t NONE = HSR_NO_PIECE;

enum { RADIX_BITS = 9, RADIX = 1 << RADIX_BITS, DIGITS = 2 };

/* --- Z sort --------------------------------------------------------------- */

/* The part of the bounds that is in the window. */
static struct hsr_bounds clip_bounds(struct hsr_bounds b,
                                     const struct hsr_window *w) {
  return (struct hsr_bounds){
      b.x0 > w->x0 ? b.x0 : w->x0, b.y0 > w->y0 ? b.y0 : w->y0,
      b.x1 < w->x1 ? b.x1 : w->x1, b.y1 < w->y1 ? b.y1 : w->y1};
}

uint32_t hsr_list_add(struct hsr_priority_list *s,
                      struct hsr_list_piece piece) {
  hsr_depth_range(s->screen, piece.polygon, &piece.nearest, &piece.farthest);
  piece.part.bounds = clip_bounds(
      piece.polygon.outline ? hsr_outline_bounds(s->screen, piece.polygon)
                            : s->screen->bounds[piece.part.face],
      s->window);
  const struct hsr_bounds *bounds = &piece.part.bounds;
  if (bounds->x0 >= bounds->x1 || bounds->y0 >= bounds->y1 ||
      !(piece.farthest > 0))
    return NONE;
  if (s->parts)
    hsr_narrow_depth_range(s->screen, piece.part.face, bounds, &piece.nearest,
                           &piece.farthest);
  if (!hsr_arena_grow(s->job->scratch, &s->pieces, sizeof piece)) {
    s->out_of_memory = true;
    return NONE;
  }
  uint32_t p = (uint32_t)s->pieces.n - 1;
  piece.left = NONE;
  *piece_at(s, p) = piece;
  return p;
}

/* The bucket of a depth. It never decreases as the depth decreases: a greater
 * bucket is nearer. */
static uint32_t bucket_of(const struct hsr_priority_list *s, double depth) {
  double q = depth > 0 ? 1 / depth : INFINITY;
  double bucket = q * s->buckets_per_q;
  double most = (1 << RADIX_BITS * DIGITS) - 1;
  return (uint32_t)(bucket < most ? bucket : most);
}

/* Divides 1/depth evenly into buckets, up to the greatest 1/depth of a farthest
 * vertex. */
static void choose_buckets(struct hsr_priority_list *s) {
  double q_max = 0;
  for (uint32_t p = 0; p < s->pieces.n; p++)
    q_max = fmax(q_max, 1 / piece_at(s, p)->farthest);
  s->buckets_per_q = q_max > 0 ? ((1 << RADIX_BITS * DIGITS) - 1) / q_max : 0;
  for (uint32_t p = 0; p < s->pieces.n; p++) {
    struct hsr_list_piece *piece = piece_at(s, p);
    piece->bucket = bucket_of(s, piece->farthest);
  }
}

/* One pass of the radix sort, from `from` to `to`. */
static void sort_digit(struct hsr_priority_list *s, int digit,
                       const uint32_t *from, uint32_t *to) {
  uint32_t begin[RADIX + 1] = {0};
  int shift = RADIX_BITS * digit;
  for (uint32_t k = 0; k < s->pieces.n; k++)
    begin[(piece_at(s, from[k])->bucket >> shift) % RADIX + 1]++;
  for (int b = 0; b < RADIX; b++)
    begin[b + 1] += begin[b];
  for (uint32_t k = 0; k < s->pieces.n; k++) {
    uint32_t p = from[k];
    to[begin[(piece_at(s, p)->bucket >> shift) % RADIX]++] = p;
    HSR_STEP(s->tally, HSR_LIST_Z_SORT, subject(s, p), HSR_NOTHING, *s->window,
             digit);
  }
}

/* Makes `after` follow `before`, which is NONE at the head of the list. */
static void link_pieces(struct hsr_priority_list *s, uint32_t before,
                        uint32_t after) {
  if (before == NONE)
    s->head = after;
  else
    piece_at(s, before)->next = after;
  if (after != NONE)
    piece_at(s, after)->previous = before;
}

/* Links the list in the order of order[], and finds `rest`. */
static void link_list(struct hsr_priority_list *s) {
  uint32_t after = NONE, rest = UINT32_MAX;
  for (size_t k = s->pieces.n; k-- > 0;) {
    uint32_t p = s->order[k], bucket = piece_at(s, p)->bucket;
    rest = bucket < rest ? bucket : rest;
    piece_at(s, p)->rest = rest;
    link_pieces(s, p, after);
    after = p;
  }
  link_pieces(s, NONE, after);
}

/* Makes room to sort all pieces: of the last frame there may be more than faces.
 */
static bool make_room(struct hsr_priority_list *s) {
  uint32_t n = (uint32_t)s->pieces.n;
  if (n > s->room) {
    s->order = HSR_NEW(s->job->scratch, uint32_t, 2 * (size_t)n);
    s->other = HSR_NEW(s->job->scratch, uint32_t, 2 * (size_t)n);
    s->room = 2 * n;
  }
  s->out_of_memory |= !s->order || !s->other;
  return !s->out_of_memory;
}

void hsr_list_sort(struct hsr_priority_list *s, const struct hsr_window *window,
                   const uint32_t *faces, uint32_t n) {
  s->window = window;
  s->pieces.n = 0;
  s->halves_used = 0;
  s->spans.piece = NONE;
  s->attempt = 1;
  s->n_faces = n;
  s->head = NONE;
  s->under_way = true;
  for (uint32_t k = 0; k < n; k++)
    s->thick[faces[k]] = false;
  if (s->keeper)
    hsr_kept_take(s, faces, n);
  for (uint32_t k = 0; k < n && !s->keeper; k++)
    hsr_list_add(s, (struct hsr_list_piece){.part = {.face = faces[k]},
                                            .polygon = {.face = faces[k]}});
  if (!make_room(s))
    return;
  choose_buckets(s);
  for (uint32_t p = 0; p < s->pieces.n; p++)
    s->order[p] = p;
  sort_digit(s, 0, s->order, s->other);
  sort_digit(s, 1, s->other, s->order);
  if (s->keeper)
    hsr_kept_arrange(s);
  link_list(s);
  if (s->index)
    hsr_index_sort(s);
}

/* --- The tests: may P obscure Q? ------------------------------------------ */

static bool same_plane(const struct hsr_priority_list *s, uint32_t f,
                       uint32_t g) {
  return s->job->world->mesh.plane[f] == s->job->world->mesh.plane[g];
}

/* The side of the plane of g that the piece was cut to, or 0. */
static int cut_side(const struct hsr_priority_list *s,
                    const struct hsr_list_piece *piece, uint32_t g) {
  for (uint32_t c = 0; c < piece->part.n_cuts; c++)
    if (same_plane(s, piece->part.cuts[c].face, g)) {
      /* Faces of one plane may face opposite ways. */
      int eye = hsr_eye_side(s->screen, piece->part.cuts[c].face, s->tally);
      return piece->part.cuts[c].side == eye ? 1 : -1;
    }
  return 0;
}

/* Test 4: P is deeper than the plane of Q. */
static enum hsr_certainty is_deeper(const struct hsr_priority_list *s,
                                    const struct hsr_list_piece *p,
                                    const struct hsr_list_piece *q) {
  uint32_t f = p->part.face, g = q->part.face;
  if (same_plane(s, f, g))
    return f >= g ? HSR_YES : HSR_NO;
  int side = cut_side(s, p, g);
  if (side)
    return side < 0 ? HSR_YES : HSR_NO;
  return hsr_beyond(s->screen, p->polygon, g, s->tally);
}

/* Test 5: Q is closer than the plane of P. */
static enum hsr_certainty is_closer(const struct hsr_priority_list *s,
                                    const struct hsr_list_piece *q,
                                    const struct hsr_list_piece *p) {
  uint32_t f = p->part.face, g = q->part.face;
  if (same_plane(s, f, g))
    return f >= g ? HSR_YES : HSR_NO;
  int side = cut_side(s, q, f);
  if (side)
    return side > 0 ? HSR_YES : HSR_NO;
  return hsr_before(s->screen, q->polygon, f, s->tally);
}

/* On which side of the line from a to b vertex v is seen: 0 if that is not
 * certain; the ends themselves are on either. */
static int line_side(const struct hsr_screen *screen, uint32_t a, uint32_t b,
                     uint32_t v) {
  double dx = screen->sx[b] - screen->sx[a], dy = screen->sy[b] - screen->sy[a];
  double hx = screen->sx[v] - screen->sx[a], hy = screen->sy[v] - screen->sy[a];
  double e = dx * hy - dy * hx;
  double bound = 8 * HSR_DELTA * (fabs(dx) + fabs(dy) + fabs(hx) + fabs(hy)) +
                 16 * HSR_DELTA * HSR_DELTA;
  return e > bound ? 1 : e < -bound ? -1 : 0;
}

/* Whether all vertices of face f but a and b are on one side of their line:
 * that side, or 0. */
static int face_side(const struct hsr_priority_list *s, uint32_t a, uint32_t b,
                     uint32_t f) {
  const struct hsr_world *world = s->job->world;
  int side = 0;
  for (uint32_t k = world->mesh.start[f]; k < world->mesh.start[f + 1]; k++) {
    uint32_t v = world->mesh.vertex[k];
    if (v == a || v == b)
      continue;
    int here = line_side(s->screen, a, b, v);
    if (!here || (side && here != side))
      return 0;
    side = here;
  }
  return side;
}

/* Whether the line of an edge of f has f to one side and g to the other. If f
 * has many corners, this is not tried: it takes the square of their number. */
static bool edge_separates(const struct hsr_priority_list *s, uint32_t f,
                           uint32_t g) {
  enum { MANY = 64 };
  const struct hsr_world *world = s->job->world;
  const uint32_t *vertex = world->mesh.vertex + world->mesh.start[f];
  uint32_t n = hsr_face_size(world, f);
  for (uint32_t k = 0, l = n - 1; k < n && n < MANY; l = k++) {
    int side = face_side(s, vertex[l], vertex[k], f);
    if (side && face_side(s, vertex[l], vertex[k], g) == -side)
      return true;
  }
  return false;
}

/* From now on the spans are those of P. */
static void take_spans(struct hsr_priority_list *s, uint32_t p) {
  struct hsr_list_spans *spans = &s->spans;
  if (spans->piece == p)
    return;
  spans->piece = p;
  spans->number++;
  spans->columns.n = 0;
  hsr_face_rows_begin(&spans->rows, s->screen, piece_at(s, p)->part.face,
                      s->tally);
}

/* The spans of P on row j: *n columns, valid until the next ones; NULL: none. */
static const int *spans_on(struct hsr_priority_list *s, int j, int *n) {
  struct hsr_list_spans *spans = &s->spans;
  struct hsr_list_row *row = &spans->row[j - s->job->view->window.y0];
  const struct hsr_piece *part = &piece_at(s, spans->piece)->part;
  if (row->number != spans->number) {
    int n_columns = hsr_piece_rows_spans(&spans->rows, part->cuts, part->n_cuts,
                                         j, s->columns, s->tally);
    *row = (struct hsr_list_row){spans->number, n_columns, spans->columns.n};
    for (int k = 0; k < n_columns; k++) {
      if (!hsr_arena_grow(s->job->scratch, &spans->columns, sizeof(int))) {
        s->out_of_memory = true;
        spans->piece = NONE;
        *n = 0;
        return NULL;
      }
      ((int *)spans->columns.items)[spans->columns.n - 1] = s->columns[k];
    }
  }
  *n = row->n;
  return row->n ? (const int *)spans->columns.items + row->first : NULL;
}

/* What test 6 finds, as the outcomes of its counter. */
enum overlap { OVERLAP, EDGE_BETWEEN, NO_ROW_HAS_BOTH };

/* Test 6: no sample is in both. It looks for an edge of whole faces that
 * separates them, and then at the spans of every row that both may reach. */
static enum overlap find_overlap(struct hsr_priority_list *s, uint32_t p,
                                 uint32_t q) {
  const struct hsr_piece *a = &piece_at(s, p)->part, *b = &piece_at(s, q)->part;
  uint32_t f = a->face, g = b->face;
  if (s->screen->whole[f] && s->screen->whole[g] &&
      (edge_separates(s, f, g) || edge_separates(s, g, f)))
    return EDGE_BETWEEN;
  int y0 = a->bounds.y0 > b->bounds.y0 ? a->bounds.y0 : b->bounds.y0;
  int y1 = a->bounds.y1 < b->bounds.y1 ? a->bounds.y1 : b->bounds.y1;
  struct hsr_face_rows rows;
  take_spans(s, p);
  hsr_face_rows_begin(&rows, s->screen, g, s->tally);
  for (int j = y0; j < y1 && !s->out_of_memory; j++) {
    int n_a, *columns = s->columns;
    const int *of_p = spans_on(s, j, &n_a);
    int n_b = n_a ? hsr_piece_rows_spans(&rows, b->cuts, b->n_cuts, j, columns,
                                         s->tally)
                  : 0;
    bool meet =
        hsr_spans_meet(of_p, n_a, columns, n_b, s->window->x0, s->window->x1);
    HSR_STEP(s->tally, HSR_LIST_OVERLAP_ROWS, subject(s, p), subject(s, q),
             HSR_ON(s->window->x0, s->window->x1, j), meet);
    if (meet)
      return OVERLAP;
  }
  return NO_ROW_HAS_BOTH;
}

static bool minimax(int a0, int a1, int b0, int b1) {
  return a0 < b1 && b0 < a1;
}

/* Tests 1 to 3: P and Q are apart in Z, X or Y. HSR_P_MAY_OBSCURE: they are
 * not. */
static enum hsr_special test_minimax(const struct hsr_priority_list *s,
                                     uint32_t p, uint32_t q) {
  const struct hsr_list_piece *P = piece_at(s, p), *Q = piece_at(s, q);
  const struct hsr_bounds *pb = &P->part.bounds, *qb = &Q->part.bounds;
  if (P->nearest > Q->farthest)
    return HSR_APART_IN_Z;
  bool x = minimax(pb->x0, pb->x1, qb->x0, qb->x1);
  HSR_STEP(s->tally, HSR_LIST_MINIMAX, subject(s, p), subject(s, q), *s->window,
           x);
  if (!x)
    return HSR_APART_IN_X;
  bool y = minimax(pb->y0, pb->y1, qb->y0, qb->y1);
  HSR_STEP(s->tally, HSR_LIST_MINIMAX, subject(s, p), subject(s, q), *s->window,
           2 + y);
  return y ? HSR_P_MAY_OBSCURE : HSR_APART_IN_Y;
}

/* Tests 4 and 5, in order. *is_certain: whether both planes told. */
static enum hsr_special test_sides(const struct hsr_priority_list *s,
                                   uint32_t p, uint32_t q, bool *is_certain) {
  const struct hsr_list_piece *P = piece_at(s, p), *Q = piece_at(s, q);
  enum hsr_certainty deeper = is_deeper(s, P, Q);
  if (deeper == HSR_YES)
    return HSR_P_BEYOND_Q;
  enum hsr_certainty closer = is_closer(s, Q, P);
  *is_certain = deeper == HSR_NO && closer == HSR_NO;
  return closer == HSR_YES ? HSR_Q_BEFORE_P : HSR_P_MAY_OBSCURE;
}

/* Tests 4 to 6. */
static enum hsr_special test_planes(struct hsr_priority_list *s, uint32_t p,
                                    uint32_t q) {
  bool is_certain = true;
  enum hsr_special sides = test_sides(s, p, q, &is_certain);
  HSR_STEP(s->tally, HSR_LIST_PLANES, subject(s, p), subject(s, q), *s->window,
           sides == HSR_P_BEYOND_Q   ? 0
           : sides == HSR_Q_BEFORE_P ? 1
           : is_certain              ? 2
                                     : 3);
  if (sides != HSR_P_MAY_OBSCURE)
    return sides;
  enum overlap overlap = find_overlap(s, p, q);
  HSR_STEP(s->tally, HSR_LIST_OVERLAPS, subject(s, p), subject(s, q),
           *s->window, overlap);
  if (overlap != OVERLAP)
    return HSR_NO_OVERLAP;
  return is_certain && !piece_at(s, p)->forced ? HSR_P_MAY_OBSCURE
                                               : HSR_TO_SAMPLES;
}

/* The six tests, in order: may P obscure Q? */
bool hsr_list_may_obscure(struct hsr_priority_list *s, uint32_t p, uint32_t q) {
  enum hsr_special decided = test_minimax(s, p, q);
  if (decided == HSR_P_MAY_OBSCURE && s->keeper && hsr_kept_holds(s, p, q)) {
    decided = HSR_HELD;
  } else if (decided == HSR_P_MAY_OBSCURE) {
    decided = test_planes(s, p, q);
    if (s->keeper && (decided == HSR_P_BEYOND_Q || decided == HSR_Q_BEFORE_P))
      hsr_kept_note(s, p, q);
  }
  HSR_STEP(s->tally, HSR_LIST_SPECIAL, subject(s, p), subject(s, q), *s->window,
           decided);
  if (decided == HSR_TO_SAMPLES)
    s->thick[piece_at(s, p)->part.face] = s->thick[piece_at(s, q)->part.face] =
        true;
  return decided == HSR_P_MAY_OBSCURE;
}

/* The first of {Q} that P may obscure, or NONE. */
static uint32_t find_obscured(struct hsr_priority_list *s, uint32_t p) {
  uint32_t bucket = bucket_of(s, piece_at(s, p)->nearest);
  if (s->index)
    return hsr_index_find(s, p, bucket);
  for (uint32_t q = piece_at(s, p)->next; q != NONE; q = piece_at(s, q)->next) {
    const struct hsr_list_piece *piece = piece_at(s, q);
    if (piece->rest > bucket && !piece->marker) {
      HSR_STEP(s->tally, HSR_LIST_SPECIAL, subject(s, p), subject(s, q),
               *s->window, HSR_BEYOND_Q_ENDS);
      return NONE;
    }
    if (hsr_list_may_obscure(s, p, q))
      return q;
  }
  return NONE;
}

/* --- Dividing ------------------------------------------------------------- */

/* Puts a piece where its farthest vertex belongs, after those with markers. */
static void insert(struct hsr_priority_list *s, uint32_t p) {
  uint32_t bucket = piece_at(s, p)->bucket, at = s->head, before = NONE;
  while (at != NONE &&
         (piece_at(s, at)->marker || piece_at(s, at)->bucket < bucket)) {
    HSR_STEP(s->tally, HSR_LIST_INSERTIONS, subject(s, p), subject(s, at),
             *s->window, 0);
    before = at;
    at = piece_at(s, at)->next;
  }
  uint32_t rest = at == NONE ? bucket : piece_at(s, at)->rest;
  piece_at(s, p)->rest = rest < bucket ? rest : bucket;
  link_pieces(s, before, p);
  link_pieces(s, p, at);
}

/* Memory until the next list; NULL if there is none. */
static void *take_half(struct hsr_priority_list *s, size_t n, size_t size) {
  size_t bytes = n * size;
  if (bytes > s->halves_room - s->halves_used) {
    size_t room = 2 * s->halves_room + bytes + 4096;
    s->halves = hsr_arena_array(s->job->scratch, room, 1);
    s->halves_used = 0;
    s->halves_room = s->halves ? room : 0;
    if (!s->halves)
      return NULL;
  }
  void *taken = s->halves + s->halves_used;
  s->halves_used += bytes;
  return taken;
}

/* Puts the part of a piece on one side of a plane into the list. */
static void add_half(struct hsr_priority_list *s,
                     const struct hsr_list_piece *whole, struct hsr_cut cut) {
  uint32_t f = whole->part.face, n_cuts = whole->part.n_cuts;
  uint32_t n = whole->polygon.outline ? whole->polygon.n
                                      : hsr_face_size(s->job->world, f);
  uint32_t room = n + n / 2 + 1;
  if (room > s->scratch_room) {
    s->scratch = hsr_arena_array(s->job->scratch, 2 * room, sizeof *s->scratch);
    s->scratch_room = s->scratch ? 2 * room : 0;
  }
  struct hsr_cut *cuts = take_half(s, n_cuts + 1, sizeof *cuts);
  double(*outline)[3] = cuts ? take_half(s, room, sizeof *outline) : NULL;
  if (!s->scratch || !outline) {
    s->out_of_memory = true;
    return;
  }
  if (n_cuts)
    memcpy(cuts, whole->part.cuts, n_cuts * sizeof *cuts);
  cuts[n_cuts] = cut;
  struct hsr_polygon left =
      hsr_divide_outline(s->screen, whole->polygon, cut, outline, s->scratch);
  s->halves_used -= (room - left.n) * sizeof *outline;
  struct hsr_piece part = {.face = f, .n_cuts = n_cuts + 1, .cuts = cuts};
  uint32_t p = hsr_list_add(
      s, (struct hsr_list_piece){.part = part, .polygon = left, .kept = NONE});
  if (p == NONE && s->keeper)
    hsr_kept_unseen(s, &part, left);
  if (p == NONE)
    return;
  piece_at(s, p)->bucket = bucket_of(s, piece_at(s, p)->farthest);
  insert(s, p);
  if (s->index)
    hsr_index_add(s, p);
}

static void take_out(struct hsr_priority_list *s, uint32_t p) {
  link_pieces(s, piece_at(s, p)->previous, piece_at(s, p)->next);
}

/* Divides a piece with a marker, or the head, by the plane of face g. */
static void divide(struct hsr_priority_list *s, uint32_t p, uint32_t g) {
  take_out(s, p);
  piece_at(s, p)->gone = true;
  struct hsr_list_piece whole = *piece_at(s, p);
  HSR_STEP(s->tally, HSR_LIST_DIVISIONS, subject(s, p), HSR_FACE(g), *s->window,
           0);
  s->attempt++;
  add_half(s, &whole, (struct hsr_cut){g, -1});
  add_half(s, &whole, (struct hsr_cut){g, +1});
}

/* Whether the plane of face g passes through a piece. */
static bool passes_through(const struct hsr_priority_list *s,
                           const struct hsr_list_piece *piece, uint32_t g) {
  return !same_plane(s, piece->part.face, g) && !cut_side(s, piece, g) &&
         hsr_beyond(s->screen, piece->polygon, g, s->tally) == HSR_NO &&
         hsr_before(s->screen, piece->polygon, g, s->tally) == HSR_NO;
}

/* Divides a piece by the plane of another, if that passes through it. */
static bool try_to_divide(struct hsr_priority_list *s, uint32_t p,
                          uint32_t by) {
  uint32_t g = piece_at(s, by)->part.face;
  bool passes = passes_through(s, piece_at(s, p), g);
  HSR_STEP(s->tally, HSR_LIST_CIRCLES, subject(s, p), subject(s, by),
           *s->window, passes);
  if (passes)
    divide(s, p, g);
  return passes;
}

/* Q is moved to the far end of the list, in P's place. */
static void interchange(struct hsr_priority_list *s, uint32_t q) {
  HSR_STEP(s->tally, HSR_LIST_INTERCHANGES, subject(s, s->head), subject(s, q),
           *s->window, 0);
  take_out(s, q);
  link_pieces(s, q, s->head);
  link_pieces(s, NONE, q);
  piece_at(s, q)->marker = s->attempt;
}

/* Whether piece a bears the marker of this attempt. */
static bool is_in_circle(const struct hsr_priority_list *s, uint32_t a) {
  return a != NONE && piece_at(s, a)->marker == s->attempt;
}

/* P and Q obscure one another, or are in a circle of pieces that do, all of
 * which bear the marker of this attempt. Divides one by the plane of another.
 * There is such a pair: if every piece were on one side of the plane of every
 * other, the planes would put them in order. */
static bool break_circle(struct hsr_priority_list *s, uint32_t q) {
  uint32_t p = s->head;
  if (try_to_divide(s, q, p) || try_to_divide(s, p, q))
    return true;
  for (uint32_t a = p; is_in_circle(s, a); a = piece_at(s, a)->next)
    for (uint32_t b = p; is_in_circle(s, b); b = piece_at(s, b)->next) {
      bool tried = (a == p && b == q) || (a == q && b == p);
      if (a != b && !tried && try_to_divide(s, a, b))
        return true;
    }
  return false;
}

/* P may obscure Q. Tries Q in P's place, unless that has been done. */
static void resolve(struct hsr_priority_list *s, uint32_t q) {
  if (piece_at(s, q)->marker != s->attempt)
    interchange(s, q);
  else if (!break_circle(s, q))
    piece_at(s, s->head)->forced = true;
}

/* --- The list ------------------------------------------------------------- */

enum hsr_status hsr_list_reserve(struct hsr_priority_list *s,
                                 const struct hsr_job *job,
                                 const struct hsr_screen *screen,
                                 struct hsr_keeper *keeper, size_t most_faces) {
  struct hsr_arena *arena = job->scratch;
  size_t n_faces = job->world->n_faces;
  *s = (struct hsr_priority_list){.job = job,
                                  .tally = job->tally,
                                  .screen = screen,
                                  .keeper = keeper,
                                  .room = (uint32_t)most_faces,
                                  .head = NONE};
  for (uint32_t r = 0; r < screen->n_relevant; r++) {
    uint32_t n = hsr_face_size(job->world, screen->relevant[r]);
    s->most_corners = n > s->most_corners ? n : s->most_corners;
  }
  s->thick = HSR_NEW(arena, bool, n_faces);
  s->columns = HSR_NEW(arena, int, (size_t)s->most_corners + 4);
  s->spans.row =
      HSR_NEW_ZEROED(arena, struct hsr_list_row,
                     (size_t)(job->view->window.y1 - job->view->window.y0));
  s->order = HSR_NEW(arena, uint32_t, most_faces);
  s->other = HSR_NEW(arena, uint32_t, most_faces);
  return s->thick && s->columns && s->spans.row && s->order && s->other
             ? HSR_OK
             : HSR_E_NOMEM;
}

const struct hsr_piece *hsr_list_next(struct hsr_priority_list *s) {
  while (s->head != NONE && !s->out_of_memory) {
    uint32_t p = s->head, q = find_obscured(s, p);
    if (q != NONE) {
      resolve(s, q);
      continue;
    }
    take_out(s, p);
    piece_at(s, p)->gone = true;
    s->attempt++;
    if (s->keeper)
      hsr_kept_leave(s, p);
    return &piece_at(s, p)->part;
  }
  if (s->keeper && s->under_way)
    hsr_kept_close(s);
  s->under_way = false;
  return NULL;
}

/* --- What it counts ------------------------------------------------------- */

static const struct hsr_counter counters[] = {
    {"Z sort", "pieces put into buckets of depth", HSR_SORT, HSR_OF_PIECE,
     HSR_OF_NOTHING,
     "put into a bucket by the low digit|put into a "
     "bucket by the high digit",
     .key = "list-sort"},
    {"Newell special",
     "pieces that may come before P in depth, asked about by the six tests",
     HSR_COMPARE, HSR_OF_PIECE, HSR_OF_PIECE,
     "end of {Q}|test 1: apart in Z|test 2: apart in X|test 3: apart in Y|"
     "test 4: P beyond Q's plane|test 5: Q before P's plane|test 6: no "
     "overlap|each sample decides|P may obscure Q|known from the last frame",
     .key = "list-test",
     .outcome_keys =
         "end-of-q|extents|boxes|boxes|plane-of-q|plane-of-p|no-overlap||"
         "may-obscure"},
    {"minimax tests",
     "tests 2 and 3: pairs whose boxes were compared in X, or in Y",
     HSR_COMPARE, HSR_OF_PIECE, HSR_OF_PIECE,
     "test 2: apart in X|test 2: overlap in X|test 3: apart in Y|test 3: "
     "overlap in Y",
     .key = "list-minimax", .outcome_keys = "boxes|boxes|boxes|boxes"},
    {"plane tests", "tests 4 to 6: pairs that the minimax tests left",
     HSR_COMPARE, HSR_OF_PIECE, HSR_OF_PIECE,
     "test 4: P beyond Q's plane|test 5: Q before P's plane|tests 4 and 5: "
     "neither|tests 4 and 5: not certain",
     .key = "list-planes",
     .outcome_keys = "plane-of-q|plane-of-p|both-planes|"},
    {"overlap tests", "test 6: pairs tested for overlap on the screen",
     HSR_COMPARE, HSR_OF_PIECE, HSR_OF_PIECE,
     "test 6: overlap|test 6: an edge is between them|test 6: on no row do "
     "their samples meet",
     .key = "list-overlap", .outcome_keys = "|edge-between|"},
    {"overlap rows", "test 6: rows on which the samples of both are compared",
     HSR_COMPARE, HSR_OF_PIECE, HSR_OF_PIECE, "apart|meet", .key = "list-row"},
    {"interchanges", "pieces moved to the far end of the list", HSR_SORT,
     HSR_OF_PIECE, HSR_OF_PIECE, .key = "list-move"},
    {"divisions", "pieces divided by the plane of another", HSR_SPLIT,
     HSR_OF_PIECE, HSR_OF_FACE, .key = "list-division"},
    {"insertions", "pieces passed to put a divided one back into the list",
     HSR_SORT, HSR_OF_PIECE, HSR_OF_PIECE, .key = "list-insertion"},
    {"circle search", "planes of other pieces tried to divide a piece",
     HSR_COMPARE, HSR_OF_PIECE, HSR_OF_PIECE,
     "does not pass through|passes through",
     .outcome_keys = "plane-of-divider|plane-of-divider"},
    {NULL}};

static double predict_z_sort(const struct hsr_table1 *t) {
  return 2 * t->F_r;
}
static double predict_special(const struct hsr_table1 *t) {
  double f = 2 * t->H_f / t->n;
  return t->F_r * t->F_r * (f + f * f + 100 * f * f * f);
}

static const struct hsr_step steps[] = {
    {"Z sort", HSR_LIST_Z_SORT, HSR_KIND_BUCKET, "2 F_r", predict_z_sort},
    {"Newell special",
     HSR_LIST_SPECIAL,
     HSR_KIND_BOX,
     "F_r^2 (f + f^2 + 100 f^3), f = 2 H_f / n",
     predict_special,
     {{HSR_LIST_MINIMAX, HSR_KIND_BOX},
      {HSR_LIST_PLANES, HSR_KIND_FACES},
      {HSR_LIST_DIVISIONS, HSR_KIND_FACES},
      {HSR_LIST_INSERTIONS, HSR_KIND_LIST}}},
    {"overlap on rows", HSR_LIST_OVERLAP_ROWS, HSR_KIND_LINE},
    {"circle search", HSR_LIST_CIRCLES, HSR_KIND_PIECE},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {"faces", "Z", "radix sort of the farthest vertex", "once a frame"},
    {"faces", "XYZ", "Newell special", "once a frame"},
    {NULL}};

static const struct hsr_line lines[] = {
    {"Z sort: put the pieces in order of their farthest vertices",
     HSR_RAISES(HSR_LIST_Z_SORT)},
    {"for each piece P, the farthest first"},
    {"  for each Q after P, up to one wholly before P: six tests (1: in Z)",
     HSR_RAISES(HSR_LIST_SPECIAL)},
    {"    do they overlap in X (test 2), and in Y (test 3)?",
     HSR_RAISES(HSR_LIST_MINIMAX)},
    {"    is P beyond Q's plane (test 4), or Q before P's plane (test 5)?",
     HSR_RAISES(HSR_LIST_PLANES)},
    {"    do they overlap on the screen (test 6)?",
     HSR_RAISES(HSR_LIST_OVERLAPS)},
    {"      if no edge separates them: do their samples meet on a row?",
     HSR_RAISES(HSR_LIST_OVERLAP_ROWS)},
    {"  if P may obscure Q, which bears no marker"},
    {"    move Q to the far end, before P, with a marker: it is the new P",
     HSR_RAISES(HSR_LIST_INTERCHANGES)},
    {"  if Q bears one: find a plane that passes through the other",
     HSR_RAISES(HSR_LIST_CIRCLES)},
    {"    divide that piece by it", HSR_RAISES(HSR_LIST_DIVISIONS)},
    {"    put the halves where they belong in the list",
     HSR_RAISES(HSR_LIST_INSERTIONS)},
    {NULL}};

const struct hsr_part hsr_list_part = {
    HSR_PART_PRIORITY_LIST, counters, steps, sorts, {lines}};
