/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Newell, Newell and Sancha's algorithm: the priority of faces computed anew
 * for every frame, and faces painted over one another in its order.
 *
 * Source      M. E. Newell, R. G. Newell, T. L. Sancha, "A solution to the
 *             hidden surface problem", Proc. ACM Annual Conference, 1972; as
 *             described by Sutherland et al. 1974, "List-Priority Algorithms",
 *             figures 21 to 23; figure 29 reconstructed from the text.
 * Notation    the list -> pieces linked by `next`, farthest first; P -> the
 *             candidate, at the head of the list; Q -> a piece that P may
 *             obscure; {Q} -> those after P up to the first that lies wholly
 *             before P in depth; bead -> the samples [x0, x1) of a row
 * Invariants  the pieces that bear no marker are in the list by the bucket of
 *             their farthest depth, farthest first;
 *             a piece is painted when no piece still in the list may be
 *             obscured by it; so at every sample the last one painted is the
 *             nearest of those painted so far
 * Ties        faces of one plane: the lower id obscures the higher
 * Departures  depth is that along the line of sight, which is the same for all
 *             pieces on a ray. A piece is its face and exact cuts; its outline
 *             serves the tests only (common/order.h). Where one face touches
 *             another within the thickness of faces that are not quite flat,
 *             their order is left to the samples where they meet, as a bead is
 *             merged; these are counted apart.
 * Cost        Z sort 2 F_r, Newell special F_r^2 (f + f^2 + 100 f^3), f = 2
 *             H_f / n, segments 10 F_r H_f, X merge F_r H_f S_v / 4 */
#include "algorithms/algorithm.h"
#include "common/order.h"

#include <stdlib.h>
#include <string.h>

enum {
  Z_SORT,
  SPECIAL,
  SEGMENTS,
  INTERCHANGES,
  DIVISIONS,
  OVERLAPS,
  THICKNESS,
  X_MERGE
};

#define COUNTERS                                                               \
  [Z_SORT] = {"Z sort",                                                        \
              "pieces put into buckets of depth; comparisons, where "          \
              "the last frame's order is the start"},                          \
  [SPECIAL] = {"Newell special",                                               \
               "minimax tests in Z, X and Y, and 100 for each pair that goes " \
               "on to the tests of planes and of overlap"},                    \
  [SEGMENTS] = {"segments", "segments generated"},                             \
  [INTERCHANGES] = {"interchanges", "pieces moved to the end of the list"},    \
  [DIVISIONS] = {"divisions", "pieces divided by the plane of another"},       \
  [OVERLAPS] = {"overlap tests", "pairs tested for overlap on the screen"},    \
  [THICKNESS] = {"thickness checks",                                           \
                 "comparisons in depth where faces that are not flat touch"}

static const struct hsr_counter counters[] = {
    COUNTERS,
    [X_MERGE] = {"X merge", "beads passed to find the place of a segment"},
    {NULL, NULL}};

static const struct hsr_counter counters_frame_buffer[] = {COUNTERS,
                                                           {NULL, NULL}};

static double predict_z_sort(const struct hsr_table1 *t) {
  return 2 * t->F_r;
}
static double predict_special(const struct hsr_table1 *t) {
  double f = 2 * t->H_f / t->n;
  return t->F_r * t->F_r * (f + f * f + 100 * f * f * f);
}
static double predict_segments(const struct hsr_table1 *t) {
  return 10 * t->F_r * t->H_f;
}
static double predict_x_merge(const struct hsr_table1 *t) {
  return t->F_r * t->H_f * t->S_v / 4;
}

#define STEPS                                                                  \
  {"Z sort", Z_SORT, 1, "2 F_r", predict_z_sort},                              \
      {"Newell special", SPECIAL, 1,                                           \
       "F_r^2 (f + f^2 + 100 f^3), f = 2 H_f / n", predict_special},           \
  {                                                                            \
    "segment generator, Y sort", SEGMENTS, 10, "10 F_r H_f", predict_segments  \
  }

static const struct hsr_step steps[] = {
    STEPS,
    {"X merge", X_MERGE, 1, "F_r H_f S_v / 4", predict_x_merge},
    {NULL, 0, 0, NULL, NULL}};

static const struct hsr_step steps_frame_buffer[] = {STEPS,
                                                     {NULL, 0, 0, NULL, NULL}};

static const struct hsr_sort sorts[] = {
    {"faces", "Z", "radix sort of the farthest vertex", "once a frame"},
    {"faces", "XYZ", "Newell special", "once a frame"},
    {"segments", "Y", "bucket sort", "once a frame"},
    {"beads", "X", "merge", "once a segment"},
    {NULL, NULL, NULL, NULL}};

static const struct hsr_sort sorts_frame_buffer[] = {
    {"faces", "Z", "radix sort of the farthest vertex", "once a frame"},
    {"faces", "XYZ", "Newell special", "once a frame"},
    {"samples", "XY", "frame buffer", "once a segment"},
    {NULL, NULL, NULL, NULL}};

static const struct hsr_sort sorts_previous[] = {
    {"faces", "Z", "insertion sort of the last frame's order", "once a frame"},
    {"faces", "XYZ", "Newell special", "once a frame"},
    {"segments", "Y", "bucket sort", "once a frame"},
    {"beads", "X", "merge", "once a segment"},
    {NULL, NULL, NULL, NULL}};

/* No piece, no bead. */
static const uint32_t NONE = UINT32_MAX;

enum { RADIX_BITS = 9, RADIX = 1 << RADIX_BITS, DIGITS = 2 };

/* What is left of a face after some cuts. */
struct piece {
  struct hsr_polygon polygon;
  const struct hsr_cut *cuts;
  uint32_t n_cuts, next;
  double nearest, farthest; /* depths along the line of sight */
  uint32_t bucket;          /* of the farthest; greater is nearer */
  struct hsr_bounds bounds;
  uint32_t marker; /* the last attempt in which it was moved to the end of the
                      list; 0: never, and it is still where it was sorted */
  bool forced;     /* could not be ordered: asks the samples */
};

struct bead {
  int x0, x1;
  uint32_t face, next;
  float rgb[3]; /* where colours are asked for */
};

/* An array that grows in the scratch arena, by doubling. */
struct growing {
  void *items;
  uint32_t n, room;
};

/* Faces in the order in which the last frame painted them. */
struct previous {
  uint32_t n, n_faces, order[];
};

struct newell {
  const struct hsr_job *job;
  struct hsr_tally *tally;
  struct hsr_screen screen;
  const struct hsr_window *window;
  struct previous *previous; /* NULL: every frame starts anew */
  bool frame_buffer;         /* paint on the picture, without beads */

  struct growing pieces;
  uint32_t head;
  uint32_t attempt; /* begins anew when what the markers say has changed */
  double buckets_per_q;
  uint32_t *order, n_order; /* the Z sort's; then the faces as painted */

  bool *thick; /* a face: touches another within their thickness */
  struct growing beads;
  uint32_t free_bead;
  uint32_t *row; /* a row of the window: its first bead */

  int *columns; /* room for the spans of the largest face, twice */
  uint32_t most_corners;
  double (*scratch)[3];
  uint32_t scratch_room;
  bool out_of_memory;
};

/* --- Growing arrays ------------------------------------------------------- */

/* The number of a new item, or NONE when memory ran out. */
static uint32_t grow(struct newell *s, struct growing *array, size_t size) {
  if (array->n == array->room) {
    uint32_t room = array->room ? 2 * array->room : 1024;
    void *items = hsr_arena_array(s->job->scratch, room, size);
    if (!items) {
      s->out_of_memory = true;
      return NONE;
    }
    if (array->n)
      memcpy(items, array->items, array->n * size);
    array->items = items;
    array->room = room;
  }
  return array->n++;
}

static struct piece *piece_at(const struct newell *s, uint32_t p) {
  return (struct piece *)s->pieces.items + p;
}

static struct bead *bead_at(const struct newell *s, uint32_t b) {
  return (struct bead *)s->beads.items + b;
}

/* --- Z sort ----------------------------------------------------------------
 */

/* Adds a piece, whose polygon and cuts are given, if it has samples. */
static void add_piece(struct newell *s, struct piece piece) {
  hsr_depth_range(&s->screen, piece.polygon, &piece.nearest, &piece.farthest);
  piece.bounds = piece.polygon.outline
                     ? hsr_outline_bounds(&s->screen, piece.polygon)
                     : s->screen.bounds[piece.polygon.face];
  piece.next = NONE;
  if (piece.bounds.x0 >= piece.bounds.x1 ||
      piece.bounds.y0 >= piece.bounds.y1 || !(piece.farthest > 0))
    return;
  uint32_t p = grow(s, &s->pieces, sizeof piece);
  if (p != NONE)
    *piece_at(s, p) = piece;
}

/* The bucket of a depth: greater, nearer; it never decreases as depth does. */
static uint32_t bucket_of(const struct newell *s, double depth) {
  double q = depth > 0 ? 1 / depth : INFINITY;
  double bucket = q * s->buckets_per_q;
  double most = (1 << RADIX_BITS * DIGITS) - 1;
  return (uint32_t)(bucket < most ? bucket : most);
}

/* Buckets evenly over 1/depth, up to that of the nearest farthest vertex. */
static void choose_buckets(struct newell *s) {
  double q_max = 0;
  for (uint32_t p = 0; p < s->pieces.n; p++)
    q_max = fmax(q_max, 1 / piece_at(s, p)->farthest);
  s->buckets_per_q = q_max > 0 ? ((1 << RADIX_BITS * DIGITS) - 1) / q_max : 0;
  for (uint32_t p = 0; p < s->pieces.n; p++) {
    struct piece *piece = piece_at(s, p);
    piece->bucket = bucket_of(s, piece->farthest);
  }
}

/* One pass of the radix sort, from `from` to `to`. */
static void sort_digit(struct newell *s, int digit, const uint32_t *from,
                       uint32_t *to) {
  uint32_t begin[RADIX + 1] = {0};
  int shift = RADIX_BITS * digit;
  for (uint32_t k = 0; k < s->pieces.n; k++)
    begin[(piece_at(s, from[k])->bucket >> shift) % RADIX + 1]++;
  for (int b = 0; b < RADIX; b++)
    begin[b + 1] += begin[b];
  for (uint32_t k = 0; k < s->pieces.n; k++) {
    uint32_t p = from[k];
    to[begin[(piece_at(s, p)->bucket >> shift) % RADIX]++] = p;
    HSR_STEP(s->tally, Z_SORT, HSR_SORT, piece_at(s, p)->polygon.face,
             HSR_NOTHING, 0, 0, 0, 0);
  }
}

/* The order of the last frame, those in front that it did not paint, put right
 * by an insertion sort. */
static void sort_previous(struct newell *s, const uint32_t *piece_of) {
  const struct previous *previous = s->previous;
  uint32_t n = 0;
  for (uint32_t k = 0; k < previous->n; k++) {
    uint32_t p = piece_of[previous->order[k]];
    if (p != NONE && !piece_at(s, p)->marker) {
      piece_at(s, p)->marker = 1; /* taken */
      s->order[n++] = p;
    }
  }
  for (uint32_t p = 0; p < s->pieces.n; p++)
    if (!piece_at(s, p)->marker)
      s->order[n++] = p;
  for (uint32_t k = 0; k < n; k++) {
    uint32_t p = s->order[k], to = k;
    piece_at(s, p)->marker = 0;
    for (; to; to--) {
      HSR_STEP(s->tally, Z_SORT, HSR_COMPARE, piece_at(s, p)->polygon.face,
               piece_at(s, s->order[to - 1])->polygon.face, 0, 0, 0, 0);
      if (piece_at(s, s->order[to - 1])->bucket <= piece_at(s, p)->bucket)
        break;
      s->order[to] = s->order[to - 1];
    }
    s->order[to] = p;
  }
}

static void link_list(struct newell *s) {
  s->head = NONE;
  for (uint32_t k = s->pieces.n; k-- > 0;) {
    piece_at(s, s->order[k])->next = s->head;
    s->head = s->order[k];
  }
}

/* All relevant faces by their farthest vertex. */
static enum hsr_status sort_z(struct newell *s) {
  struct hsr_arena *arena = s->job->scratch;
  for (uint32_t r = 0; r < s->screen.n_relevant; r++)
    add_piece(s, (struct piece){.polygon = {.face = s->screen.relevant[r]}});
  choose_buckets(s);
  uint32_t n = s->pieces.n, n_faces = s->job->world->n_faces;
  uint32_t *other = HSR_NEW(arena, uint32_t, n);
  s->order = HSR_NEW(arena, uint32_t, n);
  if (s->out_of_memory || !s->order || !other)
    return HSR_E_NOMEM;
  if (s->previous && s->previous->n) {
    uint32_t *piece_of = HSR_NEW(arena, uint32_t, n_faces);
    if (!piece_of)
      return HSR_E_NOMEM;
    memset(piece_of, 0xff, n_faces * sizeof *piece_of);
    for (uint32_t p = 0; p < n; p++)
      piece_of[piece_at(s, p)->polygon.face] = p;
    sort_previous(s, piece_of);
  } else {
    for (uint32_t p = 0; p < n; p++)
      other[p] = p;
    sort_digit(s, 0, other, s->order);
    sort_digit(s, 1, s->order, other);
    memcpy(s->order, other, n * sizeof *other);
  }
  link_list(s);
  return HSR_OK;
}

/* --- The tests: may P obscure Q? --------------------------------------------
 */

static bool same_plane(const struct newell *s, uint32_t f, uint32_t g) {
  return s->job->world->plane[f] == s->job->world->plane[g];
}

/* The side of the plane of g that the piece was cut to, or 0. */
static int cut_side(const struct newell *s, const struct piece *piece,
                    uint32_t g) {
  for (uint32_t c = 0; c < piece->n_cuts; c++)
    if (same_plane(s, piece->cuts[c].face, g)) {
      /* Two faces of one plane may face two ways. */
      int eye = hsr_eye_side(&s->screen, piece->cuts[c].face, s->tally);
      return piece->cuts[c].side == eye ? 1 : -1;
    }
  return 0;
}

/* Test 4: P is deeper than the plane of Q. */
static enum hsr_certainty is_deeper(const struct newell *s,
                                    const struct piece *p,
                                    const struct piece *q) {
  uint32_t f = p->polygon.face, g = q->polygon.face;
  if (same_plane(s, f, g))
    return f >= g ? HSR_YES : HSR_NO;
  int side = cut_side(s, p, g);
  if (side)
    return side < 0 ? HSR_YES : HSR_NO;
  return hsr_beyond(&s->screen, p->polygon, g, s->tally);
}

/* Test 5: Q is closer than the plane of P. */
static enum hsr_certainty is_closer(const struct newell *s,
                                    const struct piece *q,
                                    const struct piece *p) {
  uint32_t f = p->polygon.face, g = q->polygon.face;
  if (same_plane(s, f, g))
    return f >= g ? HSR_YES : HSR_NO;
  int side = cut_side(s, q, f);
  if (side)
    return side > 0 ? HSR_YES : HSR_NO;
  return hsr_before(&s->screen, q->polygon, f, s->tally);
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
static int face_side(const struct newell *s, uint32_t a, uint32_t b,
                     uint32_t f) {
  const struct hsr_world *world = s->job->world;
  int side = 0;
  for (uint32_t k = world->start[f]; k < world->start[f + 1]; k++) {
    uint32_t v = world->vertex[k];
    if (v == a || v == b)
      continue;
    int here = line_side(&s->screen, a, b, v);
    if (!here || (side && here != side))
      return 0;
    side = here;
  }
  return side;
}

/* Whether the line of an edge of f has f to one side and g to the other. */
static bool edge_separates(const struct newell *s, uint32_t f, uint32_t g) {
  const struct hsr_world *world = s->job->world;
  const uint32_t *vertex = world->vertex + world->start[f];
  uint32_t n = hsr_face_size(world, f);
  for (uint32_t k = 0, l = n - 1; k < n; l = k++) {
    int side = face_side(s, vertex[l], vertex[k], f);
    if (side && face_side(s, vertex[l], vertex[k], g) == -side)
      return true;
  }
  return false;
}

static bool spans_meet(const int *a, int n_a, const int *b, int n_b) {
  for (int k = 0, l = 0; k < n_a && l < n_b;) {
    if (a[k] < b[l + 1] && b[l] < a[k + 1] && a[k] < a[k + 1] &&
        b[l] < b[l + 1])
      return true;
    if (a[k + 1] < b[l + 1])
      k += 2;
    else
      l += 2;
  }
  return false;
}

/* Test 6: no sample is in both. By a line between whole faces if there is one,
 * else by the spans of every row that both may reach. */
static bool are_apart(struct newell *s, const struct piece *p,
                      const struct piece *q) {
  uint32_t f = p->polygon.face, g = q->polygon.face;
  HSR_COUNT(s->tally, OVERLAPS, 1);
  if (s->screen.whole[f] && s->screen.whole[g] &&
      (edge_separates(s, f, g) || edge_separates(s, g, f)))
    return true;
  int y0 = p->bounds.y0 > q->bounds.y0 ? p->bounds.y0 : q->bounds.y0;
  int y1 = p->bounds.y1 < q->bounds.y1 ? p->bounds.y1 : q->bounds.y1;
  int *a = s->columns, *b = s->columns + s->most_corners + 4;
  for (int j = y0; j < y1; j++) {
    int n_a =
        hsr_piece_spans(&s->screen, f, p->cuts, p->n_cuts, j, a, s->tally);
    int n_b =
        n_a ? hsr_piece_spans(&s->screen, g, q->cuts, q->n_cuts, j, b, s->tally)
            : 0;
    if (spans_meet(a, n_a, b, n_b))
      return false;
  }
  return true;
}

static bool minimax(int a0, int a1, int b0, int b1) {
  return a0 < b1 && b0 < a1;
}

/* The six tests, in order. */
static bool may_obscure(struct newell *s, struct piece *p, struct piece *q) {
  uint32_t f = p->polygon.face, g = q->polygon.face;
  HSR_STEP(s->tally, SPECIAL, HSR_COMPARE, f, g, 0, 0, 0, 0);
  if (p->nearest > q->farthest)
    return false;
  HSR_COUNT(s->tally, SPECIAL, 1);
  if (!minimax(p->bounds.x0, p->bounds.x1, q->bounds.x0, q->bounds.x1))
    return false;
  HSR_COUNT(s->tally, SPECIAL, 1);
  if (!minimax(p->bounds.y0, p->bounds.y1, q->bounds.y0, q->bounds.y1))
    return false;
  HSR_COUNT(s->tally, SPECIAL, 100);
  enum hsr_certainty certainty = is_deeper(s, p, q);
  if (certainty != HSR_YES) {
    enum hsr_certainty closer = is_closer(s, q, p);
    certainty = closer > certainty ? closer : certainty;
  }
  if (certainty == HSR_YES || are_apart(s, p, q))
    return false;
  if (certainty == HSR_NO && !p->forced)
    return true;
  s->thick[f] = s->thick[g] = true;
  return false;
}

/* The first of {Q} that P may obscure, or NONE; *before is the one before it in
 * the list. */
static uint32_t find_obscured(struct newell *s, uint32_t p, uint32_t *before) {
  uint32_t bucket = bucket_of(s, piece_at(s, p)->nearest);
  *before = p;
  for (uint32_t q = piece_at(s, p)->next; q != NONE;
       *before = q, q = piece_at(s, q)->next) {
    struct piece *piece = piece_at(s, q);
    if (piece->bucket > bucket && !piece->marker) {
      HSR_COUNT(s->tally, SPECIAL, 1);
      return NONE;
    }
    if (may_obscure(s, piece_at(s, p), piece))
      return q;
  }
  return NONE;
}

/* --- Dividing ---------------------------------------------------------------
 */

/* Puts a piece where its farthest vertex belongs, after those with markers. */
static void insert(struct newell *s, uint32_t p) {
  uint32_t bucket = piece_at(s, p)->bucket, at = s->head, before = NONE;
  while (at != NONE &&
         (piece_at(s, at)->marker || piece_at(s, at)->bucket < bucket)) {
    HSR_COUNT(s->tally, SPECIAL, 1);
    before = at;
    at = piece_at(s, at)->next;
  }
  piece_at(s, p)->next = at;
  if (before == NONE)
    s->head = p;
  else
    piece_at(s, before)->next = p;
}

/* The part of a piece on one side of a plane, into the list. */
static void add_half(struct newell *s, const struct piece *whole,
                     struct hsr_cut cut) {
  struct hsr_arena *arena = s->job->scratch;
  uint32_t n = whole->polygon.outline
                   ? whole->polygon.n
                   : hsr_face_size(s->job->world, whole->polygon.face);
  uint32_t room = n + n / 2 + 1;
  if (room > s->scratch_room) {
    s->scratch = hsr_arena_array(arena, 2 * room, sizeof *s->scratch);
    s->scratch_room = s->scratch ? 2 * room : 0;
  }
  double(*outline)[3] = hsr_arena_array(arena, room, sizeof *outline);
  struct hsr_cut *cuts = HSR_NEW(arena, struct hsr_cut, whole->n_cuts + 1);
  if (!s->scratch || !outline || !cuts) {
    s->out_of_memory = true;
    return;
  }
  if (whole->n_cuts)
    memcpy(cuts, whole->cuts, whole->n_cuts * sizeof *cuts);
  cuts[whole->n_cuts] = cut;
  struct piece half = {
      .polygon = {whole->polygon.face, (const double(*)[3])outline, 0},
      .cuts = cuts,
      .n_cuts = whole->n_cuts + 1};
  half.polygon.n =
      hsr_divide_outline(&s->screen, whole->polygon, cut, outline, s->scratch);
  uint32_t before = s->pieces.n;
  add_piece(s, half);
  if (s->pieces.n > before) {
    piece_at(s, before)->bucket = bucket_of(s, piece_at(s, before)->farthest);
    insert(s, before);
  }
}

/* Takes a piece with a marker, or the head, out of the list. */
static void take_out(struct newell *s, uint32_t p) {
  uint32_t *link = &s->head;
  while (*link != p)
    link = &piece_at(s, *link)->next;
  *link = piece_at(s, p)->next;
}

/* Divides a piece with a marker, or the head, by the plane of face g. */
static void divide(struct newell *s, uint32_t p, uint32_t g) {
  take_out(s, p);
  struct piece whole = *piece_at(s, p);
  HSR_STEP(s->tally, DIVISIONS, HSR_SPLIT, whole.polygon.face, g, 0, 0, 0, 0);
  HSR_COUNT(s->tally, SPECIAL, 100);
  s->attempt++;
  add_half(s, &whole, (struct hsr_cut){g, -1});
  add_half(s, &whole, (struct hsr_cut){g, +1});
}

/* Divides a piece by the plane of another, if that passes through it. */
static bool try_to_divide(struct newell *s, uint32_t p, uint32_t by) {
  const struct piece *piece = piece_at(s, p);
  uint32_t f = piece->polygon.face, g = piece_at(s, by)->polygon.face;
  if (same_plane(s, f, g) || cut_side(s, piece, g) ||
      hsr_beyond(&s->screen, piece->polygon, g, s->tally) != HSR_NO ||
      hsr_before(&s->screen, piece->polygon, g, s->tally) != HSR_NO)
    return false;
  divide(s, p, g);
  return true;
}

/* Q is moved to the end of the list, in P's place. */
static void interchange(struct newell *s, uint32_t before, uint32_t q) {
  struct piece *offending = piece_at(s, q);
  HSR_STEP(s->tally, INTERCHANGES, HSR_SORT, piece_at(s, s->head)->polygon.face,
           offending->polygon.face, 0, 0, 0, 0);
  piece_at(s, before)->next = offending->next;
  offending->next = s->head;
  offending->marker = s->attempt;
  s->head = q;
}

/* P and Q obscure one another, or stand in a circle of such pieces, all of
 * which bear the marker of this attempt: one is divided by the plane of
 * another. There is such a one: were every piece on one side of the plane of
 * every other, those planes would put them in order. */
static bool break_circle(struct newell *s, uint32_t q) {
  uint32_t p = s->head;
  if (try_to_divide(s, q, p) || try_to_divide(s, p, q))
    return true;
  for (uint32_t a = p; a != NONE && (a == p || piece_at(s, a)->marker);
       a = piece_at(s, a)->next)
    for (uint32_t b = p; b != NONE && (b == p || piece_at(s, b)->marker);
         b = piece_at(s, b)->next)
      if (a != b && try_to_divide(s, a, b))
        return true;
  return false;
}

/* P may obscure Q, which follows `before`: Q is tried in P's place, unless it
 * has been. */
static void resolve(struct newell *s, uint32_t before, uint32_t q) {
  if (piece_at(s, q)->marker != s->attempt)
    interchange(s, before, q);
  else if (!break_circle(s, q))
    piece_at(s, s->head)->forced = true;
}

/* --- Beads ------------------------------------------------------------------
 */

static uint32_t new_bead(struct newell *s, struct bead bead) {
  uint32_t b = s->free_bead;
  if (b != NONE)
    s->free_bead = bead_at(s, b)->next;
  else
    b = grow(s, &s->beads, sizeof bead);
  if (b != NONE)
    *bead_at(s, b) = bead;
  return b;
}

static void drop_bead(struct newell *s, uint32_t b) {
  bead_at(s, b)->next = s->free_bead;
  s->free_bead = b;
}

static void set_next(struct newell *s, int j, uint32_t bead, uint32_t next) {
  if (bead == NONE)
    s->row[j - s->window->y0] = next;
  else
    bead_at(s, bead)->next = next;
}

/* The beads of row j around column x: the first that ends after it, and the one
 * before that. */
static uint32_t find_bead(struct newell *s, int j, int x, uint32_t *before) {
  uint32_t b = s->row[j - s->window->y0];
  *before = NONE;
  while (b != NONE && bead_at(s, b)->x1 <= x) {
    HSR_COUNT(s->tally, X_MERGE, 1);
    *before = b;
    b = bead_at(s, b)->next;
  }
  return b;
}

/* The samples [x0, x1) of row j become a bead; what was there is overwritten.
 */
static void merge_bead(struct newell *s, struct bead new, int j) {
  int x0 = new.x0, x1 = new.x1;
  uint32_t before, b = find_bead(s, j, x0, &before);
  uint32_t bead = new_bead(s, new);
  if (bead == NONE)
    return;
  if (b != NONE && bead_at(s, b)->x0 < x0) {
    struct bead left = *bead_at(s, b);
    left.x1 = x0;
    uint32_t l = new_bead(s, left);
    if (l == NONE)
      return;
    set_next(s, j, before, l);
    before = l;
    bead_at(s, b)->x0 = x0;
  }
  while (b != NONE && bead_at(s, b)->x1 <= x1) {
    uint32_t next = bead_at(s, b)->next;
    HSR_COUNT(s->tally, X_MERGE, 1);
    drop_bead(s, b);
    b = next;
  }
  if (b != NONE && bead_at(s, b)->x0 < x1)
    bead_at(s, b)->x0 = x1;
  bead_at(s, bead)->next = b;
  set_next(s, j, before, bead);
}

static void write_samples(struct newell *s, struct bead new, int j) {
  size_t row = (size_t)j * s->job->ids_stride;
  for (int i = new.x0; i < new.x1; i++)
    s->job->ids[row + (size_t)i] = new.face;
  float *rgb = s->job->paint ? s->job->paint->rgb + 3 * row : NULL;
  for (int i = 3 * new.x0; rgb &&i < 3 * new.x1; i++)
    rgb[i] = new.rgb[(i - 3 * new.x0) % 3];
}

static void overwrite_opaque(struct newell *s, struct bead new, int j) {
  if (s->frame_buffer)
    write_samples(s, new, j);
  else
    merge_bead(s, new, j);
}

/* What is painted at (i, j), as a bead that ends at `most` or before; its
 * face is the background where there is nothing. */
static struct bead painted(struct newell *s, int i, int j, int most) {
  struct bead there = {i, most, HSR_BACKGROUND, NONE, {0}};
  const struct hsr_paint *paint = s->job->paint;
  if (paint)
    memcpy(there.rgb, paint->background, sizeof there.rgb);
  if (s->frame_buffer) {
    size_t row = (size_t)j * s->job->ids_stride;
    const uint32_t *ids = s->job->ids + row;
    const float *rgb = paint ? paint->rgb + 3 * row : NULL;
    there.face = ids[i];
    if (rgb)
      memcpy(there.rgb, rgb + 3 * i, sizeof there.rgb);
    for (there.x1 = i + 1;
         there.x1 < most && ids[there.x1] == ids[i] &&
         (!rgb || !memcmp(rgb + 3 * there.x1, there.rgb, sizeof there.rgb));)
      there.x1++;
    return there;
  }
  uint32_t before, b = find_bead(s, j, i, &before);
  if (b == NONE)
    return there;
  const struct bead *bead = bead_at(s, b);
  int end = bead->x0 > i ? bead->x0 : bead->x1;
  if (bead->x0 <= i) {
    there.face = bead->face;
    memcpy(there.rgb, bead->rgb, sizeof there.rgb);
  }
  there.x1 = end < most ? end : most;
  return there;
}

/* Partial overwriting: a transparent face that is brighter than what lies
 * under it takes its place; else the two are combined. */
static void overwrite_partly(struct newell *s, struct bead new, float opacity,
                             int j) {
  float brightness = new.rgb[0] + new.rgb[1] + new.rgb[2];
  for (int i = new.x0, end = new.x1; i < end;) {
    struct bead under = painted(s, i, j, end), mixed = new;
    mixed.x0 = i;
    mixed.x1 = i = under.x1;
    if (brightness <= under.rgb[0] + under.rgb[1] + under.rgb[2])
      for (int c = 0; c < 3; c++)
        mixed.rgb[c] = opacity * new.rgb[c] + (1 - opacity) * under.rgb[c];
    overwrite_opaque(s, mixed, j);
  }
}

static void overwrite(struct newell *s, uint32_t f, int x0, int x1, int j) {
  const struct hsr_world *world = s->job->world;
  struct bead new = {x0, x1, f, NONE, {0}};
  if (!s->job->paint) {
    overwrite_opaque(s, new, j);
    return;
  }
  memcpy(new.rgb, s->job->paint->face + 3 * (size_t)f, sizeof new.rgb);
  float opacity = world->scene->objects[world->object[f]].opacity;
  if (opacity < 1)
    overwrite_partly(s, new, opacity, j);
  else
    overwrite_opaque(s, new, j);
}

/* Whether f is nearer than g at (i, j). */
static bool ask_sample(struct newell *s, uint32_t f, uint32_t g, int i, int j) {
  HSR_STEP(s->tally, THICKNESS, HSR_COMPARE, f, g, i, j, i + 1, j + 1);
  return f == g || hsr_nearer(&s->screen, f, g, i, j, s->tally);
}

/* Overwrites those of the samples where f is not behind what is there, which is
 * asked where both touch others within their thickness. */
static void overwrite_thick(struct newell *s, uint32_t f, int x0, int x1,
                            int j) {
  for (int i = x0, end; i < x1; i = end) {
    struct bead there = painted(s, i, j, x1);
    uint32_t g = there.face;
    end = there.x1;
    if (g == HSR_BACKGROUND || !s->thick[g]) {
      overwrite(s, f, i, end, j);
      continue;
    }
    bool first = ask_sample(s, f, g, i, j);
    int lo = i, hi = end - 1; /* the order of two planes changes once */
    if (ask_sample(s, f, g, hi, j) == first)
      lo = end;
    else
      for (lo++; lo < hi;) {
        int middle = lo + (hi - lo) / 2;
        if (ask_sample(s, f, g, middle, j) == first)
          lo = middle + 1;
        else
          hi = middle;
      }
    if (first)
      overwrite(s, f, i, lo, j);
    else if (lo < end)
      overwrite(s, f, lo, end, j);
  }
}

static void paint(struct newell *s, const struct piece *piece) {
  uint32_t f = piece->polygon.face;
  const struct hsr_bounds *b = &piece->bounds;
  for (int j = b->y0; j < b->y1; j++) {
    int n = hsr_piece_spans(&s->screen, f, piece->cuts, piece->n_cuts, j,
                            s->columns, s->tally);
    for (int k = 0; k < n; k += 2) {
      const struct hsr_window *w = s->window;
      int x0 = s->columns[k] > w->x0 ? s->columns[k] : w->x0;
      int x1 = s->columns[k + 1] < w->x1 ? s->columns[k + 1] : w->x1;
      if (x0 >= x1)
        continue;
      HSR_STEP(s->tally, SEGMENTS, HSR_SPAN, f, HSR_NOTHING, x0, j, x1, j + 1);
      HSR_TOUCH_SPAN(s->tally, x0, x1, j);
      if (s->thick[f])
        overwrite_thick(s, f, x0, x1, j);
      else
        overwrite(s, f, x0, x1, j);
    }
  }
}

static void show_beads(struct newell *s) {
  const struct hsr_window *w = s->window;
  for (int j = w->y0; j < w->y1; j++) {
    struct bead gap = {w->x0, w->x0, HSR_BACKGROUND, NONE, {0}};
    if (s->job->paint)
      memcpy(gap.rgb, s->job->paint->background, sizeof gap.rgb);
    for (uint32_t b = s->row[j - w->y0]; b != NONE; b = bead_at(s, b)->next) {
      const struct bead *bead = bead_at(s, b);
      gap.x1 = bead->x0;
      write_samples(s, gap, j);
      write_samples(s, *bead, j);
      gap.x0 = bead->x1;
    }
    gap.x1 = w->x1;
    write_samples(s, gap, j);
  }
}

/* --- The algorithm ----------------------------------------------------------
 */

static enum hsr_status allocate(struct newell *s) {
  const struct hsr_world *world = s->job->world;
  const struct hsr_window *w = s->window;
  struct hsr_arena *arena = s->job->scratch;
  size_t rows = (size_t)(w->y1 - w->y0);
  for (uint32_t r = 0; r < s->screen.n_relevant; r++) {
    uint32_t n = hsr_face_size(world, s->screen.relevant[r]);
    s->most_corners = n > s->most_corners ? n : s->most_corners;
  }
  s->thick = HSR_NEW_ZEROED(arena, bool, world->n_faces);
  s->row = HSR_NEW(arena, uint32_t, rows);
  s->columns = HSR_NEW(arena, int, 2 * ((size_t)s->most_corners + 4));
  s->free_bead = NONE;
  if (!s->thick || !s->row || !s->columns)
    return HSR_E_NOMEM;
  memset(s->row, 0xff, rows * sizeof *s->row);
  if (s->frame_buffer)
    show_beads(s); /* there are none: the background */
  return HSR_OK;
}

/* Notes a face as painted, for the next frame. */
static void remember(struct newell *s, uint32_t f) {
  if (s->previous && s->previous->n < s->previous->n_faces)
    s->previous->order[s->previous->n++] = f;
}

static enum hsr_status run(const struct hsr_job *job, bool frame_buffer,
                           struct previous *previous, struct hsr_error *err) {
  struct newell newell = {.job = job,
                          .tally = job->tally,
                          .window = &job->view->window,
                          .previous = previous,
                          .frame_buffer = frame_buffer,
                          .attempt = 1};
  struct newell *s = &newell;
  if (hsr_screen_make(&s->screen, job->world, job->view, job->scratch,
                      job->tally) ||
      allocate(s) || sort_z(s))
    return hsr_fail_nomem(err);
  if (previous)
    previous->n = 0;
  while (s->head != NONE && !s->out_of_memory) {
    uint32_t before, q = find_obscured(s, s->head, &before);
    if (q != NONE) {
      resolve(s, before, q);
      continue;
    }
    const struct piece *piece = piece_at(s, s->head);
    paint(s, piece);
    s->attempt++;
    remember(s, piece->polygon.face);
    s->head = piece_at(s, s->head)->next;
  }
  if (s->out_of_memory)
    return hsr_fail_nomem(err);
  if (!frame_buffer)
    show_beads(s);
  return HSR_OK;
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  return run(job, false, NULL, err);
}

static enum hsr_status render_frame_buffer(const struct hsr_job *job,
                                           struct hsr_error *err) {
  return run(job, true, NULL, err);
}

/* --- From the previous frame's order ---------------------------------------
 */

static enum hsr_status prepare_previous(const struct hsr_world *world,
                                        void **prepared,
                                        struct hsr_error *err) {
  struct previous *previous =
      malloc(sizeof *previous + world->n_faces * sizeof *previous->order);
  if (!previous)
    return hsr_fail_nomem(err);
  *previous = (struct previous){.n_faces = world->n_faces};
  *prepared = previous;
  return HSR_OK;
}

static enum hsr_status render_previous(const struct hsr_job *job,
                                       struct hsr_error *err) {
  return run(job, false, job->prepared, err);
}

#define NEWELL                                                                 \
  .authors = "M. E. Newell, R. G. Newell, T. L. Sancha",                       \
  .source = "Proc. ACM Annual Conference, 1972, 443-450; Sutherland et al., "  \
            "Computing Surveys 6(1), 1974, \"List-Priority Algorithms\"",      \
  .taxonomy = HSR_LIST_PRIORITY, .restrictions = 0, .kind = HSR_IDS

const struct hsr_algorithm HSR_ALGORITHM(newell) = {
    NEWELL,
    .name = "newell",
    .title = "Newell, Newell and Sancha's priority list, with beads",
    .year = 1972,
    .sort_order = "ZYX",
    .coherence = "depth",
    .flags = HSR_TRANSPARENCY,
    .sorts = sorts,
    .counters = counters,
    .steps = steps,
    .render = render};

const struct hsr_algorithm HSR_ALGORITHM(newell_frame_buffer) = {
    NEWELL,
    .name = "newell-frame-buffer",
    .title = "Newell, Newell and Sancha's priority list on a frame buffer",
    .year = 1974,
    .sort_order = "Z(XY)",
    .coherence = "depth",
    .flags = HSR_TRANSPARENCY,
    .sorts = sorts_frame_buffer,
    .counters = counters_frame_buffer,
    .steps = steps_frame_buffer,
    .render = render_frame_buffer};

const struct hsr_algorithm HSR_ALGORITHM(newell_previous) = {
    NEWELL,
    .name = "newell-previous",
    .title = "Newell, Newell and Sancha's, from the previous frame's order",
    .year = 1974,
    .sort_order = "ZYX",
    .coherence = "depth, frame",
    .flags = HSR_TRANSPARENCY | HSR_FRAME_STATE,
    .sorts = sorts_previous,
    .counters = counters,
    .steps = steps,
    .prepare = prepare_previous,
    .render = render_previous,
    .release = free};
