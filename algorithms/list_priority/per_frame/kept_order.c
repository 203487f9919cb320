/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The order of priority, kept from frame to frame: see kept_order.h.
 *
 * Two arenas take turns: one has what the last frame kept, the other gets what
 * this frame keeps. While a list is under way, what is to be kept is in the
 * job's scratch memory. */
#include "algorithms/list_priority/per_frame/kept_order.h"
#include "algorithms/list_priority/per_frame/priority_pieces.h"

#include <stdlib.h>
#include <string.h>

/* The most pieces a face that are kept. */
enum { MOST_PIECES = 8 };

static const uint32_t NONE = HSR_NO_PIECE;

/* In piece_of[]: the piece has no sample in this frame. */
static const uint32_t UNSEEN = HSR_NO_PIECE - 1;

struct kept_piece {
  uint32_t face, n_cuts;
  const struct hsr_cut *cuts;
  struct hsr_polygon polygon;
};

/* The order of one list: piece[0] is the farthest; those without a sample come
 * last. Piece k does not obscure the pieces later[start[k]], ...,
 * later[start[k + 1] - 1], which come after it. */
struct kept_list {
  uint32_t n;
  struct kept_piece *piece;
  uint32_t *start, *later;
};

struct pair {
  uint32_t p, q;
};

struct hsr_keeper {
  struct hsr_arena arena[2];
  struct kept_list *list[2]; /* by number of the list */
  int last;                  /* which of both is of the last frame */
  bool valid;                /* there is a last frame */
  uint32_t n_lists, n_faces, n_vertices;
  signed char *side; /* by face: on which side of its plane the eye was; 0: the
                        face was not relevant */
  double *place;     /* by vertex: where it was; x of all, then y, then z */

  /* This frame. */
  const struct hsr_job *job;
  const struct hsr_screen *screen;
  bool any_moved;
  bool *same; /* by face: not moved, the eye on the same side */

  /* The list under way. */
  uint32_t number;
  uint32_t *piece_of; /* by place in the last order: its piece */
  bool *taken;        /* by face: pieces of it are in the last order */
  bool *wanted;       /* by face: it is in the list */
  struct hsr_growing order, pairs;
  uint32_t candidate, *mark, n_candidates; /* mark[k] == n_candidates: the
                     candidate does not obscure what has place k */
};

/* --- Frames --------------------------------------------------------------- */

void hsr_keeper_free(void *prepared) {
  struct hsr_keeper *k = prepared;
  if (!k)
    return;
  for (int a = 0; a < 2; a++)
    hsr_arena_free(&k->arena[a]);
  free(k->side);
  free(k->place);
  free(k);
}

struct hsr_keeper *hsr_keeper_new(const struct hsr_world *world,
                                  uint32_t n_lists) {
  struct hsr_keeper *k = calloc(1, sizeof *k);
  if (!k)
    return NULL;
  k->n_lists = n_lists;
  k->n_faces = world->n_faces;
  k->n_vertices = world->mesh.n_vertices;
  k->side = calloc((size_t)k->n_faces + 1, sizeof *k->side);
  k->place = calloc((size_t)k->n_vertices + 1, 3 * sizeof *k->place);
  if (k->side && k->place)
    return k;
  hsr_keeper_free(k);
  return NULL;
}

/* Whether a vertex of face f is not where it was. */
static bool has_moved(const struct hsr_keeper *k, uint32_t f) {
  const struct hsr_mesh *mesh = &k->job->world->mesh;
  size_t n = k->n_vertices;
  for (uint32_t c = mesh->start[f]; k->any_moved && c < mesh->start[f + 1];
       c++) {
    uint32_t v = mesh->vertex[c];
    if (mesh->x[v] != k->place[v] || mesh->y[v] != k->place[n + v] ||
        mesh->z[v] != k->place[2 * n + v])
      return true;
  }
  return false;
}

static bool any_has_moved(const struct hsr_keeper *k) {
  const struct hsr_mesh *mesh = &k->job->world->mesh;
  size_t n = k->n_vertices, size = n * sizeof *k->place;
  return memcmp(mesh->x, k->place, size) ||
         memcmp(mesh->y, k->place + n, size) ||
         memcmp(mesh->z, k->place + 2 * n, size);
}

enum hsr_status hsr_keeper_begin(struct hsr_keeper *k,
                                 const struct hsr_job *job,
                                 const struct hsr_screen *screen) {
  const struct hsr_world *world = job->world;
  k->job = job;
  k->screen = screen;
  k->number = 0;
  k->valid &= k->n_vertices == world->mesh.n_vertices;
  k->any_moved = k->valid && any_has_moved(k);
  hsr_arena_reset(&k->arena[!k->last]);
  k->list[!k->last] =
      HSR_NEW_ZEROED(&k->arena[!k->last], struct kept_list, k->n_lists);
  k->same = HSR_NEW_ZEROED(job->scratch, bool, k->n_faces);
  k->taken = HSR_NEW(job->scratch, bool, k->n_faces);
  k->wanted = HSR_NEW_ZEROED(job->scratch, bool, k->n_faces);
  if (!k->list[!k->last] || !k->same || !k->taken || !k->wanted)
    return HSR_E_NOMEM;
  for (uint32_t r = 0; r < screen->n_relevant; r++) {
    uint32_t f = screen->relevant[r];
    if (!k->valid)
      break;
    k->same[f] =
        k->side[f] == hsr_eye_side(screen, f, job->tally) && !has_moved(k, f);
    HSR_STEP(job->tally, HSR_KEPT_FACES, HSR_FACE(f), HSR_NOTHING,
             job->view->window, k->same[f]);
  }
  k->order = k->pairs = (struct hsr_growing){.n = 0};
  return HSR_OK;
}

void hsr_keeper_choose(struct hsr_keeper *k, uint32_t n) {
  k->number = n;
}

void hsr_keeper_end(struct hsr_keeper *k) {
  const struct hsr_mesh *mesh = &k->job->world->mesh;
  size_t n = k->n_vertices, size = n * sizeof *k->place;
  memset(k->side, 0, k->n_faces);
  for (uint32_t r = 0; r < k->screen->n_relevant; r++) {
    uint32_t f = k->screen->relevant[r];
    k->side[f] = (signed char)hsr_eye_side(k->screen, f, k->job->tally);
  }
  if (n == mesh->n_vertices && (!k->valid || k->any_moved)) {
    memcpy(k->place, mesh->x, size);
    memcpy(k->place + n, mesh->y, size);
    memcpy(k->place + 2 * n, mesh->z, size);
  }
  k->last = !k->last;
  k->valid = n == mesh->n_vertices;
}

/* --- The last order ------------------------------------------------------- */

static const struct kept_list *last_order(const struct hsr_keeper *k) {
  static const struct kept_list none;
  return k->valid ? &k->list[k->last][k->number] : &none;
}

/* Whether the pieces of a face are still parts of it: a cut is made by a plane
 * in space. */
static bool is_whole_again(const struct hsr_keeper *k,
                           const struct kept_piece *piece) {
  if (!piece->n_cuts || !k->any_moved)
    return false;
  bool moved = has_moved(k, piece->face);
  for (uint32_t c = 0; c < piece->n_cuts && !moved; c++)
    moved = has_moved(k, piece->cuts[c].face);
  return moved;
}

void hsr_kept_take(struct hsr_priority_list *s, const uint32_t *faces,
                   uint32_t n) {
  struct hsr_keeper *k = s->keeper;
  const struct kept_list *last = last_order(k);
  k->order.n = k->pairs.n = 0;
  k->candidate = NONE;
  k->n_candidates = 0;
  k->piece_of = HSR_NEW(s->job->scratch, uint32_t, last->n);
  k->mark = HSR_NEW_ZEROED(s->job->scratch, uint32_t, last->n);
  if (!k->piece_of || !k->mark) {
    s->out_of_memory = true;
    return;
  }
  for (uint32_t i = 0; i < n; i++) {
    k->wanted[faces[i]] = true;
    k->taken[faces[i]] = false;
  }
  for (uint32_t i = 0; i < last->n; i++)
    if (is_whole_again(k, &last->piece[i]))
      k->wanted[last->piece[i].face] = false;
  for (uint32_t i = 0; i < last->n; i++) {
    const struct kept_piece *old = &last->piece[i];
    k->piece_of[i] = NONE;
    if (!k->wanted[old->face])
      continue;
    k->taken[old->face] = true;
    uint32_t p =
        hsr_list_add(s, (struct hsr_list_piece){.part = {.face = old->face,
                                                         .n_cuts = old->n_cuts,
                                                         .cuts = old->cuts},
                                                .polygon = old->polygon,
                                                .kept = i});
    k->piece_of[i] = p == NONE ? UNSEEN : p;
  }
  for (uint32_t i = 0; i < n; i++) {
    k->wanted[faces[i]] = false;
    if (!k->taken[faces[i]])
      hsr_list_add(s, (struct hsr_list_piece){.part = {.face = faces[i]},
                                              .polygon = {.face = faces[i]},
                                              .kept = NONE});
  }
}

/* --- Relations ------------------------------------------------------------ */

/* Marks what the candidate does not obscure. */
static void mark_later(struct hsr_keeper *k, uint32_t place) {
  const struct kept_list *last = last_order(k);
  k->n_candidates++;
  for (uint32_t i = last->start[place]; i < last->start[place + 1]; i++)
    k->mark[last->later[i]] = k->n_candidates;
}

bool hsr_kept_holds(struct hsr_priority_list *s, uint32_t p, uint32_t q) {
  struct hsr_keeper *k = s->keeper;
  const struct hsr_list_piece *P = piece_at(s, p), *Q = piece_at(s, q);
  if (P->kept == NONE || Q->kept == NONE || !k->same[P->part.face] ||
      !k->same[Q->part.face])
    return false;
  if (k->candidate != p)
    mark_later(k, P->kept);
  k->candidate = p;
  if (k->mark[Q->kept] != k->n_candidates)
    return false;
  HSR_STEP(s->tally, HSR_KEPT_HELD, subject(s, p), subject(s, q), *s->window,
           0);
  hsr_kept_note(s, p, q);
  return true;
}

void hsr_kept_note(struct hsr_priority_list *s, uint32_t p, uint32_t q) {
  const struct hsr_mesh *mesh = &s->job->world->mesh;
  struct hsr_growing *pairs = &s->keeper->pairs;
  if (mesh->deviation[piece_at(s, p)->part.face] > 0 ||
      mesh->deviation[piece_at(s, q)->part.face] > 0)
    return; /* such a face is thick, and how thick depends on the eye */
  if (hsr_arena_grow(s->job->scratch, pairs, sizeof(struct pair)))
    ((struct pair *)pairs->items)[pairs->n - 1] = (struct pair){p, q};
  else
    s->out_of_memory = true;
}

/* --- Arranging the list --------------------------------------------------- */

/* By piece, those that go before it: before[start[q]], ..., before[start[q + 1]
 * - 1]. */
struct earlier {
  uint32_t *start, *before;
};

/* The pieces, if a relation of the last order is one of pieces of this list, and
 * holds. */
static bool find_pair(const struct hsr_priority_list *s, uint32_t from,
                      uint32_t to, struct pair *pair) {
  const struct hsr_keeper *k = s->keeper;
  *pair = (struct pair){k->piece_of[from], k->piece_of[to]};
  return pair->p < UNSEEN && pair->q < UNSEEN &&
         k->same[piece_at(s, pair->p)->part.face] &&
         k->same[piece_at(s, pair->q)->part.face];
}

static bool find_earlier(const struct hsr_priority_list *s,
                         struct earlier *earlier) {
  const struct kept_list *last = last_order(s->keeper);
  struct hsr_arena *arena = s->job->scratch;
  size_t n = s->pieces.n;
  struct pair pair;
  earlier->start = HSR_NEW_ZEROED(arena, uint32_t, n + 2);
  earlier->before = HSR_NEW(arena, uint32_t, last->start[last->n]);
  if (!earlier->start || !earlier->before)
    return false;
  for (uint32_t i = 0; i < last->n; i++)
    for (uint32_t r = last->start[i]; r < last->start[i + 1]; r++)
      if (find_pair(s, i, last->later[r], &pair))
        earlier->start[pair.q + 2]++;
  for (size_t q = 2; q < n + 2; q++)
    earlier->start[q] += earlier->start[q - 1];
  for (uint32_t i = 0; i < last->n; i++)
    for (uint32_t r = last->start[i]; r < last->start[i + 1]; r++)
      if (find_pair(s, i, last->later[r], &pair))
        earlier->before[earlier->start[pair.q + 1]++] = pair.p;
  return true;
}

/* Takes the pieces as they are in order[], but before each those that go before
 * it. stack[]: pieces whose turn it is as soon as those above them have had
 * theirs; next[]: of each piece, which of the earlier ones is looked at next. */
static void arrange(struct hsr_priority_list *s, const struct earlier *earlier,
                    uint32_t *stack, uint32_t *next) {
  uint32_t n = (uint32_t)s->pieces.n, n_out = 0;
  for (uint32_t p = 0; p < n; p++)
    next[p] = earlier->start[p];
  for (uint32_t i = 0, n_stack = 0; i < n || n_stack;) {
    if (!n_stack)
      stack[n_stack++] = s->order[i++];
    uint32_t q = stack[n_stack - 1];
    if (next[q] == NONE) { /* it has had its turn */
      n_stack--;
    } else if (next[q] < earlier->start[q + 1]) {
      uint32_t p = earlier->before[next[q]++];
      bool waits = next[p] != NONE;
      HSR_STEP(s->tally, HSR_KEPT_ARRANGED, subject(s, q), subject(s, p),
               *s->window, waits);
      if (waits)
        stack[n_stack++] = p;
    } else {
      next[q] = NONE;
      s->other[n_out++] = q;
      n_stack--;
    }
  }
  uint32_t *order = s->order;
  s->order = s->other;
  s->other = order;
}

void hsr_kept_arrange(struct hsr_priority_list *s) {
  struct earlier earlier;
  if (!last_order(s->keeper)->n)
    return;
  uint32_t *stack = HSR_NEW(s->job->scratch, uint32_t, s->pieces.n + 1);
  uint32_t *next = HSR_NEW(s->job->scratch, uint32_t, s->pieces.n);
  if (stack && next && find_earlier(s, &earlier))
    arrange(s, &earlier, stack, next);
  else
    s->out_of_memory = true;
}

/* --- This order ----------------------------------------------------------- */

static void put(struct hsr_priority_list *s, struct kept_piece piece) {
  struct hsr_growing *order = &s->keeper->order;
  if (hsr_arena_grow(s->job->scratch, order, sizeof piece))
    ((struct kept_piece *)order->items)[order->n - 1] = piece;
  else
    s->out_of_memory = true;
}

void hsr_kept_unseen(struct hsr_priority_list *s, const struct hsr_piece *part,
                     struct hsr_polygon polygon) {
  put(s, (struct kept_piece){part->face, part->n_cuts, part->cuts, polygon});
}

void hsr_kept_leave(struct hsr_priority_list *s, uint32_t p) {
  struct hsr_list_piece *piece = piece_at(s, p);
  piece->left = (uint32_t)s->keeper->order.n;
  hsr_kept_unseen(s, &piece->part, piece->polygon);
}

/* Copies a piece into the arena. */
static bool copy_piece(struct hsr_arena *arena, struct kept_piece *to,
                       const struct kept_piece *from) {
  *to = *from;
  struct hsr_cut *cuts = HSR_NEW(arena, struct hsr_cut, from->n_cuts);
  if (!cuts)
    return false;
  if (from->n_cuts)
    memcpy(cuts, from->cuts, from->n_cuts * sizeof *cuts);
  to->cuts = cuts;
  if (!from->polygon.outline)
    return true;
  double(*outline)[3] =
      hsr_arena_array(arena, from->polygon.n, sizeof *outline);
  if (!outline)
    return false;
  memcpy(outline, from->polygon.outline, from->polygon.n * sizeof *outline);
  to->polygon.outline = (const double(*)[3])outline;
  return true;
}

/* Whether what was found of a pair is to be kept: both are in the order still,
 * p before q. */
static bool is_to_be_kept(const struct hsr_priority_list *s, struct pair pair) {
  uint32_t p = piece_at(s, pair.p)->left, q = piece_at(s, pair.q)->left;
  return p != NONE && q != NONE && p < q;
}

static bool copy_relations(const struct hsr_priority_list *s,
                           struct kept_list *now) {
  struct hsr_keeper *k = s->keeper;
  struct hsr_arena *arena = &k->arena[!k->last];
  const struct pair *pair = k->pairs.items;
  now->start = HSR_NEW_ZEROED(arena, uint32_t, (size_t)now->n + 2);
  now->later = HSR_NEW(arena, uint32_t, k->pairs.n);
  if (!now->start || !now->later)
    return false;
  for (size_t i = 0; i < k->pairs.n; i++)
    if (is_to_be_kept(s, pair[i]))
      now->start[piece_at(s, pair[i].p)->left + 2]++;
  for (uint32_t i = 2; i < now->n + 2; i++)
    now->start[i] += now->start[i - 1];
  for (size_t i = 0; i < k->pairs.n; i++)
    if (is_to_be_kept(s, pair[i]))
      now->later[now->start[piece_at(s, pair[i].p)->left + 1]++] =
          piece_at(s, pair[i].q)->left;
  return true;
}

void hsr_kept_close(struct hsr_priority_list *s) {
  struct hsr_keeper *k = s->keeper;
  struct hsr_arena *arena = &k->arena[!k->last];
  struct kept_list *now = &k->list[!k->last][k->number];
  const struct kept_list *last = last_order(k);
  for (uint32_t i = 0; i < last->n; i++)
    if (k->piece_of[i] == UNSEEN)
      put(s, last->piece[i]);
  const struct kept_piece *piece = k->order.items;
  if (s->out_of_memory || k->order.n > MOST_PIECES * (size_t)s->n_faces)
    return;
  now->n = (uint32_t)k->order.n;
  now->piece = HSR_NEW(arena, struct kept_piece, now->n);
  bool good = now->piece != NULL;
  for (uint32_t i = 0; i < now->n && good; i++)
    good = copy_piece(arena, &now->piece[i], &piece[i]);
  if (!good || !copy_relations(s, now))
    s->out_of_memory = true;
}

/* --- What it counts ------------------------------------------------------- */

static const struct hsr_counter counters[] = {
    {"faces confirmed",
     "faces asked whether they are where they were, and the eye on the same "
     "side of their planes",
     HSR_COMPARE, HSR_OF_FACE, HSR_OF_NOTHING,
     "new, moved or turned|as it was"},
    {"relations kept",
     "relations of the last frame, by which a piece follows another", HSR_SORT,
     HSR_OF_PIECE, HSR_OF_PIECE,
     "the other has its place|the other is put first"},
    {"relations held",
     "pairs that tests 1 to 3 left, whose order is known from the last frame",
     HSR_COMPARE, HSR_OF_PIECE, HSR_OF_PIECE},
    {NULL}};

static const struct hsr_step steps[] = {
    {"Newell special",
     HSR_KEPT_FACES,
     HSR_KIND_PLANE,
     NULL,
     NULL,
     {{HSR_KEPT_ARRANGED, HSR_KIND_LIST}, {HSR_KEPT_HELD, HSR_KIND_NUMBERS}}},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {"faces", "XYZ", "by relations of the last frame", "once a list"}, {NULL}};

static const struct hsr_line frame_lines[] = {
    {"for each face: is it where it was, and the eye on the same side of it?",
     HSR_RAISES(HSR_KEPT_FACES)},
    {NULL}};

static const struct hsr_line list_lines[] = {
    {"take the pieces of the last frame; put each after those that it followed",
     HSR_RAISES(HSR_KEPT_ARRANGED)},
    {"of two pieces whose order a plane told there: it holds",
     HSR_RAISES(HSR_KEPT_HELD)},
    {NULL}};

const struct hsr_part hsr_kept_order_part = {
    HSR_PART_KEPT_ORDER, counters, steps, sorts, {frame_lines, list_lines}};
