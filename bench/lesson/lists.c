/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pieces of a priority list that is made during a frame.
 *
 * Source    the events of algorithms/list_priority/per_frame/priority_list.c.
 * List      begins with its Z sort, which names all pieces that are whole
 *           faces. A radix sort names them twice: first in the order of their
 *           numbers, from 0. An insertion sort names pairs that it compares.
 * Numbers   a division takes the next numbers: for what is behind the plane,
 *           and then for what is in front of it. A half without samples gets
 *           none.
 * Outlines  of pieces that are not whole, by the services of
 *           common/exact/order.h, which the algorithm uses. */
#include "bench/lesson/lesson.h"
#include "common/exact/order.h"
#include "common/files/json/json.h"
#include "common/scene/pieces.h"

#include <math.h>
#include <stdlib.h>

/* --- What is noted of the events ------------------------------------------ */

struct note {
  uint64_t event;       /* its number */
  uint32_t face, piece; /* the face is of the world that the algorithm got */
  uint32_t by;   /* of a division: the face whose plane it is; else HSR_NO_ID */
  bool by_pairs; /* of a sort */
  struct hsr_window window;
};

bool lesson_has_counter(const struct hsr_algorithm *a, const char *key) {
  for (int k = 0; k < trace_n_counters(a); k++)
    if (hsr_has_key(&a->counters[k], key))
      return true;
  return false;
}

bool lesson_has_list(const struct hsr_setup *setup) {
  return lesson_has_counter(setup->algorithm, "list-sort") &&
         lesson_has_counter(setup->algorithm, "list-division");
}

void lesson_note_list(struct lesson_bytes *notes, const struct hsr_counter *c,
                      const struct hsr_event *event) {
  bool divides = hsr_has_key(c, "list-division");
  const struct hsr_subject *both[2] = {&event->a, &event->b};
  if (!divides && !hsr_has_key(c, "list-sort"))
    return;
  for (int k = 0; k < 2; k++)
    if (both[k]->kind == HSR_OF_PIECE)
      lesson_add(notes,
                 &(struct note){.event = event->number,
                                .face = event->own[k],
                                .piece = both[k]->id[1],
                                .by = divides ? event->own[1] : HSR_NO_ID,
                                .by_pairs = event->b.kind == HSR_OF_PIECE,
                                .window = event->window},
                 sizeof(struct note));
}

/* --- The pieces of a list ------------------------------------------------- */

enum { WHOLE = -1, MOST_BUCKET = (1 << 18) - 1 };

struct piece {
  int64_t parent; /* the number of the piece that was divided; WHOLE: a face */
  struct hsr_polygon polygon;
};

struct lists {
  struct hsr_screen screen;
  const struct hsr_view *view;
  struct hsr_arena arena;
  struct hsr_tally tally;    /* of no interest */
  struct hsr_growing pieces; /* of the current list: struct piece */
  double (*in)[3], (*out)[3];
  size_t room;              /* points of in[] */
  json_t *lists;            /* NULL: memory ran out */
  struct hsr_window window; /* of the current list */
  bool of_parts; /* the lists are made within another algorithm, for parts of
                    the picture */

  /* The current sort: its second pass has named n_again pieces, and its events
   * follow one another up to `next`. */
  uint32_t n_again;
  uint64_t next;
};

static struct piece *piece_at(const struct lists *l, uint32_t k) {
  return (struct piece *)l->pieces.items + k;
}

static bool make_room(struct lists *l, size_t n) {
  if (n <= l->room)
    return true;
  l->in = hsr_arena_array(&l->arena, 2 * n, sizeof *l->in);
  l->out = hsr_arena_array(&l->arena, 4 * n, sizeof *l->out);
  l->room = l->in && l->out ? 2 * n : 0;
  return l->room > 0;
}

/* A polygon of n points has been put into in[]. */
static json_t *projected_json(struct lists *l, uint32_t n) {
  return trace_polygon_json(l->view, (const double(*)[3])l->in, (int)n, l->out);
}

/* Of a face of the world that the algorithm got: null if it is all of a face of
 * the scene. */
static json_t *face_outline_json(struct lists *l, uint32_t face) {
  const struct hsr_world *world = l->screen.world;
  const struct hsr_pieces *pieces = world->pieces;
  uint32_t parent = hsr_world_parent(world, face);
  if (!pieces || pieces->first[parent + 1] - pieces->first[parent] == 1)
    return json_null();
  const uint32_t *vertex = world->mesh.vertex + world->mesh.start[face];
  uint32_t n = hsr_face_size(world, face);
  if (pieces->outline_start[face] < pieces->outline_start[face + 1]) {
    vertex = pieces->outline + pieces->outline_start[face];
    n = pieces->outline_start[face + 1] - pieces->outline_start[face];
  }
  if (!make_room(l, n))
    return NULL;
  for (uint32_t k = 0; k < n; k++)
    hsr_view_project(l->view,
                     (const double[3]){world->mesh.x[vertex[k]],
                                       world->mesh.y[vertex[k]],
                                       world->mesh.z[vertex[k]]},
                     l->in[k]);
  return projected_json(l, n);
}

static json_t *outline_json(struct lists *l, const struct hsr_polygon *p) {
  if (!p->outline)
    return face_outline_json(l, p->face);
  if (!make_room(l, p->n))
    return NULL;
  for (uint32_t k = 0; k < p->n; k++)
    hsr_view_project(l->view, p->outline[k], l->in[k]);
  return projected_json(l, p->n);
}

/* What is in the window of the bounds of a piece. */
static struct hsr_bounds bounds_in(const struct lists *l,
                                   struct hsr_polygon polygon,
                                   const struct hsr_window *w) {
  struct hsr_bounds b = polygon.outline
                            ? hsr_outline_bounds(&l->screen, polygon)
                            : l->screen.bounds[polygon.face];
  return (struct hsr_bounds){
      b.x0 > w->x0 ? b.x0 : w->x0, b.y0 > w->y0 ? b.y0 : w->y0,
      b.x1 < w->x1 ? b.x1 : w->x1, b.y1 < w->y1 ? b.y1 : w->y1};
}

/* The depth by which a piece is sorted. In a list for a part of the picture,
 * only that part counts. */
static double farthest_of(const struct lists *l, struct hsr_polygon polygon) {
  double nearest, farthest;
  hsr_depth_range(&l->screen, polygon, &nearest, &farthest);
  struct hsr_bounds bounds = bounds_in(l, polygon, &l->window);
  if (l->of_parts)
    hsr_narrow_depth_range(&l->screen, polygon.face, &bounds, &nearest,
                           &farthest);
  return farthest;
}

/* Buckets for each 1/depth, as in priority_list.c, of pieces that are whole. */
static double buckets_per_q(const struct lists *l) {
  double q_max = 0;
  for (uint32_t k = 0; k < l->pieces.n; k++)
    if (piece_at(l, k)->parent == WHOLE)
      q_max = fmax(q_max, 1 / farthest_of(l, piece_at(l, k)->polygon));
  return q_max > 0 ? MOST_BUCKET / q_max : 0;
}

static json_int_t bucket_of(double depth, double per_q) {
  double bucket = (depth > 0 ? 1 / depth : INFINITY) * per_q;
  return (json_int_t)(bucket < MOST_BUCKET ? bucket : MOST_BUCKET);
}

/* [face, parent, bucket, outline], of each piece. */
static json_t *pieces_json(struct lists *l) {
  double per_q = buckets_per_q(l);
  json_t *pieces = json_array();
  for (uint32_t k = 0; k < l->pieces.n; k++) {
    const struct piece *p = piece_at(l, k);
    hsr_json_append(
        &pieces,
        json_pack(
            "[I I o o]",
            (json_int_t)hsr_world_parent(l->screen.world, p->polygon.face),
            (json_int_t)p->parent,
            json_integer(bucket_of(farthest_of(l, p->polygon), per_q)),
            outline_json(l, &p->polygon)));
  }
  return pieces;
}

static void end_list(struct lists *l, uint64_t from) {
  if (l->pieces.n)
    hsr_json_append(&l->lists, json_pack("{sI so}", "from", (json_int_t)from,
                                         "pieces", pieces_json(l)));
  l->pieces.n = 0;
  l->n_again = 0;
}

static bool add_piece(struct lists *l, int64_t parent,
                      struct hsr_polygon polygon) {
  if (!hsr_arena_grow(&l->arena, &l->pieces, sizeof(struct piece)))
    return false;
  *piece_at(l, (uint32_t)l->pieces.n - 1) = (struct piece){parent, polygon};
  return true;
}

/* Whether the algorithm puts it into its list. */
static bool has_samples(const struct lists *l, struct hsr_polygon polygon) {
  double nearest, farthest;
  struct hsr_bounds b = bounds_in(l, polygon, &l->window);
  hsr_depth_range(&l->screen, polygon, &nearest, &farthest);
  return b.x0 < b.x1 && b.y0 < b.y1 && farthest > 0;
}

/* The number of points that a polygon has. */
static uint32_t n_points(const struct lists *l, struct hsr_polygon polygon) {
  return polygon.outline ? polygon.n
                         : hsr_face_size(l->screen.world, polygon.face);
}

/* Both halves of a piece. */
static bool divide(struct lists *l, const struct note *note) {
  struct hsr_polygon whole = piece_at(l, note->piece)->polygon;
  uint32_t n = n_points(l, whole), room = n + n / 2 + 1;
  for (int side = -1; side <= 1; side += 2) {
    double(*outline)[3] = hsr_arena_array(&l->arena, room, sizeof *outline);
    double(*scratch)[3] = hsr_arena_array(&l->arena, 2 * room, sizeof *scratch);
    if (!outline || !scratch)
      return false;
    struct hsr_polygon half = hsr_divide_outline(
        &l->screen, whole, (struct hsr_cut){note->by, side}, outline, scratch);
    if (has_samples(l, half) && !add_piece(l, note->piece, half))
      return false;
  }
  return true;
}

/* A piece that a sort names. A new list begins if no sort is going on, or if
 * the one that was has named every piece twice. */
static bool sort(struct lists *l, const struct note *note, uint64_t *from) {
  bool done = !note->by_pairs && l->pieces.n && l->n_again == l->pieces.n;
  if (!l->pieces.n || note->event > l->next || done) {
    end_list(l, *from);
    *from = note->event;
    l->window = note->window;
  }
  l->next = note->event + 1;
  if (note->piece < l->pieces.n) {
    l->n_again++;
    return true;
  }
  return add_piece(l, WHOLE, (struct hsr_polygon){.face = note->face});
}

/* In an insertion sort piece 1 is named before piece 0. */
static int by_event_and_piece(const void *a, const void *b) {
  const struct note *x = a, *y = b;
  if (x->event != y->event)
    return x->event < y->event ? -1 : 1;
  return (x->piece > y->piece) - (x->piece < y->piece);
}

static bool make_lists(struct lists *l, struct note *note, size_t n) {
  uint64_t from = 0;
  qsort(note, n, sizeof *note, by_event_and_piece);
  for (size_t k = 0; k < n; k++) {
    bool is_division = note[k].by != HSR_NO_ID;
    if (is_division && note[k].piece >= l->pieces.n)
      return false; /* events are missing */
    if (!(is_division ? divide(l, &note[k]) : sort(l, &note[k], &from)))
      return false;
  }
  end_list(l, from);
  return l->lists != NULL;
}

/* Whether the lists are made within another algorithm, whose counters are told
 * from the list's by a prefix. */
static bool is_of_parts(const struct hsr_algorithm *a) {
  for (const struct hsr_use *u = a->parts; u && u->part; u++)
    if (u->part->number == HSR_PART_PRIORITY_LIST)
      return u->prefix != NULL;
  return false;
}

json_t *lesson_lists_json(const struct trace_run *run,
                          const struct lesson_bytes *notes) {
  struct lists l = {.view = &run->view,
                    .lists = json_array(),
                    .of_parts = is_of_parts(run->setup.algorithm)};
  if (!notes->n && !notes->failed)
    return l.lists;
  bool good = !notes->failed &&
              !hsr_screen_make(&l.screen, run->setup.world, &run->view,
                               &l.arena, &l.tally) &&
              make_lists(&l, (struct note *)(void *)notes->at,
                         notes->n / sizeof(struct note));
  hsr_arena_free(&l.arena);
  if (!good)
    json_decref(l.lists);
  return good ? l.lists : NULL;
}
