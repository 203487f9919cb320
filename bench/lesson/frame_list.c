/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The list of an algorithm that makes one, as it is after each step: a strip of cells
 * beneath the picture, and markers. As data/lists.js of the page finds it, and
 * beside/list.js draws it. */
#include "bench/lesson/frames.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- What is noted of the events ------------------------------------------ */

enum role {
  SORTED,
  TESTED,
  MOVED,
  DIVIDED,
  INSERTED,
  FILLED,
  PUT,
  FACE_SORTED,
  ACCEPTED
};

struct note {
  uint64_t event;
  enum role role;
  uint32_t face, a, b; /* the first subject's; the numbers of both pieces */
};

/* What becomes of the list at an event. */
enum what { SORT, BEGIN, PAINT, MOVE, TAKE_OUT, PUT_IN, APPEND };

struct op {
  uint64_t event;
  enum what what;
  uint32_t face, piece;
  size_t at; /* of a sort: which list; else the place in the order */
};

static const uint32_t NO_PIECE = HSR_NO_ID;

static bool find_role(const struct frames *f, const struct hsr_event *event,
                      enum role *role) {
  const struct hsr_algorithm *a = f->run->setup.algorithm;
  const struct hsr_counter *c = &a->counters[event->counter];
  if (c->kind == HSR_ACCEPT && (lesson_has_counter(a, "face-sort") ||
                                lesson_has_counter(a, "list-segment")))
    *role = ACCEPTED;
  else if (hsr_has_key(c, "list-sort"))
    *role = SORTED;
  else if (hsr_has_key(c, "list-test") || hsr_has_key(c, "list-minimax"))
    *role = TESTED;
  else if (hsr_has_key(c, "list-move"))
    *role = MOVED;
  else if (hsr_has_key(c, "list-division"))
    *role = DIVIDED;
  else if (hsr_has_key(c, "list-insertion"))
    *role = INSERTED;
  else if (hsr_has_key(c, "list-segment"))
    *role = FILLED;
  else if (hsr_has_key(c, "piece") || (hsr_has_key(c, "back-face-cull") &&
                                       frames_has_outcome(f, event, "front")))
    *role = PUT;
  else if (hsr_has_key(c, "face-sort"))
    *role = FACE_SORTED;
  else
    return false;
  return true;
}

bool frames_note_list(struct frames *f, const struct hsr_event *event) {
  struct frame_list *list = &f->list;
  struct note note = {.event = event->number,
                      .face = event->a.id[0],
                      .a = event->a.kind == HSR_OF_PIECE ? event->a.id[1]
                                                         : NO_PIECE,
                      .b = event->b.id[1]};
  const struct note *last = list->notes.items;
  if (!find_role(f, event, &note.role))
    return true;
  bool goes_on = note.role == ACCEPTED && list->notes.n &&
                 last[list->notes.n - 1].role == ACCEPTED &&
                 last[list->notes.n - 1].face == note.face;
  if (goes_on)
    return true;
  if (!hsr_arena_grow(&f->arena, &list->notes, sizeof note))
    return false;
  ((struct note *)list->notes.items)[list->notes.n - 1] = note;
  return true;
}

/* --- The list at a step --------------------------------------------------- */

static bool append(struct frames *f, struct hsr_growing *to,
                   struct frame_item item) {
  if (!hsr_arena_grow(&f->arena, to, sizeof item))
    return false;
  ((struct frame_item *)to->items)[to->n - 1] = item;
  return true;
}

static struct frame_item take_out(struct hsr_growing *from, size_t at) {
  struct frame_item *items = from->items, item = items[at];
  memmove(&items[at], &items[at + 1], (--from->n - at) * sizeof item);
  return item;
}

static bool put_in(struct frames *f, struct hsr_growing *to, size_t at,
                   struct frame_item item) {
  if (!append(f, to, item))
    return false;
  struct frame_item *items = to->items;
  memmove(&items[at + 1], &items[at], (to->n - 1 - at) * sizeof item);
  items[at] = item;
  return true;
}

/* The place of a piece in the order; its length: it is not there. */
static size_t place_of(const struct frame_list *list, uint32_t piece) {
  const struct frame_item *items = list->order.items;
  size_t at = 0;
  while (at < list->order.n && items[at].piece != piece)
    at++;
  return at;
}

static void forget_markers(struct frame_list *list) {
  struct frame_item *items = list->order.items;
  for (size_t k = 0; k < list->order.n; k++)
    items[k].is_marked = false;
}

/* Of the pieces of a list: the face, and the piece that was divided, -1 of a face. */
static json_int_t field_of(const struct frame_list *list, size_t piece,
                           size_t field) {
  return json_integer_value(
      json_array_get(json_array_get(list->pieces, piece), field));
}

enum { FACE, PARENT, BUCKET };

struct placed {
  json_int_t bucket;
  uint32_t piece;
};

static int by_bucket(const void *a, const void *b) {
  const struct placed *p = a, *q = b;
  if (p->bucket != q->bucket)
    return p->bucket < q->bucket ? -1 : 1;
  return (p->piece > q->piece) - (p->piece < q->piece);
}

/* Puts the whole faces into the order: bucket by bucket, as they are numbered. */
static bool begin(struct frames *f) {
  struct frame_list *list = &f->list;
  size_t n = json_array_size(list->pieces), n_whole = 0;
  struct placed *whole = HSR_NEW(&f->arena, struct placed, n + 1);
  bool good = whole != NULL;
  for (size_t p = 0; good && p < n; p++)
    if (field_of(list, p, PARENT) < 0)
      whole[n_whole++] =
          (struct placed){field_of(list, p, BUCKET), (uint32_t)p};
  if (n_whole)
    qsort(whole, n_whole, sizeof *whole, by_bucket);
  for (size_t k = 0; good && k < n_whole; k++)
    good = append(
        f, &list->order,
        (struct frame_item){(uint32_t)field_of(list, whole[k].piece, FACE),
                            whole[k].piece, false});
  return good;
}

static bool apply(struct frames *f, const struct op *op) {
  struct frame_list *list = &f->list;
  struct frame_item item = {op->face, op->piece, false};
  size_t at;
  switch (op->what) {
  case SORT:
    list->pieces = json_object_get(json_array_get(f->lists, op->at), "pieces");
    list->painted.n = list->order.n = 0;
    list->is_sorting = true;
    return true;
  case BEGIN:
    list->is_sorting = false;
    return begin(f);
  case PAINT:
    if (!list->order.n)
      return true;
    item = take_out(&list->order, 0);
    item.is_marked = false;
    forget_markers(list);
    return append(f, &list->painted, item);
  case MOVE:
    at = place_of(list, op->piece);
    if (at == list->order.n)
      return true;
    item = take_out(&list->order, at);
    item.is_marked = true;
    return put_in(f, &list->order, 0, item);
  case TAKE_OUT:
    at = place_of(list, op->piece);
    if (at < list->order.n)
      take_out(&list->order, at);
    forget_markers(list);
    return true;
  case PUT_IN:
    at = op->at < list->order.n ? op->at : list->order.n;
    return put_in(f, &list->order, at, item);
  case APPEND:
    return append(f, &list->order, item);
  }
  return true;
}

/* --- From the notes to the operations ------------------------------------- */

/* Does it, so that what follows is found, and notes it. */
static bool add_op(struct frames *f, struct op op) {
  if (!hsr_arena_grow(&f->arena, &f->list.ops, sizeof op))
    return false;
  ((struct op *)f->list.ops.items)[f->list.ops.n - 1] = op;
  return apply(f, &op);
}

/* What is first in the order, as a piece or its face; HSR_NO_ID: nothing. */
static uint32_t head_of(const struct frame_list *list, bool as_face) {
  const struct frame_item *items = list->order.items;
  return !list->order.n ? HSR_NO_ID : as_face ? items->face : items->piece;
}

/* All before the piece, or the face, have been painted. */
static bool paint_up_to(struct frames *f, uint64_t event, uint32_t wanted,
                        bool is_face) {
  while (f->list.order.n && head_of(&f->list, is_face) != wanted)
    if (!add_op(f, (struct op){.event = event, .what = PAINT}))
      return false;
  return true;
}

/* Puts the halves of a piece into the order: each goes past so many others. */
static bool divide(struct frames *f, const struct note *note,
                   const struct note *end) {
  const struct frame_list *list = &f->list;
  const struct note *next = note + 1;
  uint64_t event = note->event;
  if (!add_op(f,
              (struct op){.event = event, .what = TAKE_OUT, .piece = note->a}))
    return false;
  for (uint32_t p = 0; p < json_array_size(list->pieces); p++) {
    size_t at = 0;
    if (field_of(list, p, PARENT) != (json_int_t)note->a)
      continue;
    for (; next < end && next->role == INSERTED && next->a == p &&
           next->event == event + 1;
         next++, event++)
      at++;
    if (!add_op(f, (struct op){event, PUT_IN, (uint32_t)field_of(list, p, FACE),
                               p, at}))
      return false;
  }
  return true;
}

/* A sort ends with its last event in a row. */
static bool sort(struct frames *f, const struct note *note,
                 const struct note *end, size_t *next) {
  const json_t *list = json_array_get(f->lists, *next);
  bool is_first = list && json_integer_value(json_object_get(list, "from")) ==
                              (json_int_t)note->event;
  if (is_first &&
      !add_op(f, (struct op){note->event, SORT, HSR_NO_ID, NO_PIECE, *next}))
    return false;
  *next += is_first;
  bool goes_on = note + 1 < end && note[1].role == SORTED &&
                 note[1].event == note->event + 1;
  return !f->list.is_sorting || goes_on ||
         add_op(f, (struct op){.event = note->event, .what = BEGIN});
}

/* The last note of a role; NULL: there is none. */
static const struct note *last_note(const struct frames *f, enum role role) {
  const struct note *notes = f->list.notes.items;
  size_t k = f->list.notes.n;
  while (k && notes[k - 1].role != role)
    k--;
  return k ? &notes[k - 1] : NULL;
}

/* What is shown after the last piece was cut into segments is shown when all are
 * painted. */
static bool follow_pieces(struct frames *f) {
  const struct note *note = f->list.notes.items, *end = note + f->list.notes.n;
  const struct note *filled = last_note(f, FILLED);
  size_t next = 0;
  bool good = true;
  for (; note < end && good; note++)
    switch (note->role) {
    case SORTED:
      good = sort(f, note, end, &next);
      break;
    case TESTED:
      good = paint_up_to(f, note->event, note->a, false);
      break;
    case FILLED:
      good = paint_up_to(f, note->event, note->face, true);
      break;
    case MOVED:
      good = add_op(
          f, (struct op){.event = note->event, .what = MOVE, .piece = note->b});
      break;
    case DIVIDED:
      good = divide(f, note, end);
      break;
    case ACCEPTED:
      good = !filled || note < filled ||
             paint_up_to(f, note->event, HSR_NO_ID, false);
      break;
    default:
      break;
    }
  return good;
}

/* A list that only grows: what is put into it is done. */
static bool follow_growth(struct frames *f) {
  const struct note *note = f->list.notes.items, *end = note + f->list.notes.n;
  bool good = true;
  for (; note < end && good; note++)
    good =
        note->role != PUT ||
        (add_op(f, (struct op){note->event, APPEND, note->face, note->a, 0}) &&
         add_op(f, (struct op){.event = note->event, .what = PAINT}));
  return good;
}

/* All faces are sorted, and then painted one by one. */
static bool follow_faces(struct frames *f) {
  const struct note *note = f->list.notes.items, *end = note + f->list.notes.n;
  const struct note *sorted = last_note(f, FACE_SORTED);
  bool good = true, is_first = true;
  uint64_t begin = sorted ? sorted->event : 0;
  f->list.is_sorting = true;
  for (const struct note *n = note; n < end && good; n++)
    good = n->role != ACCEPTED ||
           add_op(f, (struct op){begin, APPEND, n->face, NO_PIECE, 0});
  for (; note < end && good; note++)
    if (note->role == ACCEPTED) {
      good = is_first ||
             add_op(f, (struct op){.event = note->event, .what = PAINT});
      is_first = false;
    }
  return good;
}

bool frames_make_list(struct frames *f) {
  const struct hsr_algorithm *a = f->run->setup.algorithm;
  struct frame_list *list = &f->list;
  bool good = true;
  list->is_there = true;
  if (json_array_size(f->lists))
    good = follow_pieces(f);
  else if ((lesson_has_counter(a, "piece") &&
            json_object_get(f->structure, "nodes")) ||
           (lesson_has_counter(a, "back-face-cull") &&
            json_object_get(f->structure, "separators")))
    good = follow_growth(f);
  else if (lesson_has_counter(a, "face-sort"))
    good = follow_faces(f);
  else
    list->is_there = false;
  list->painted.n = list->order.n = 0;
  list->pieces = NULL;
  return good;
}

bool frames_follow_list(struct frames *f, const struct hsr_event *event) {
  struct frame_list *list = &f->list;
  const struct op *op = list->ops.items;
  bool good = true;
  for (; good && list->done < list->ops.n &&
         op[list->done].event <= event->number;
       list->done++)
    good = apply(f, &op[list->done]);
  while (good && event->number + 1 == f->steps && list->order.n)
    good = apply(f, &(struct op){.what = PAINT});
  return good;
}

/* --- What is drawn -------------------------------------------------------- */

bool frames_is_marked(const struct frames *f, const struct hsr_subject *s) {
  const struct frame_list *list = &f->list;
  const struct frame_item *items = list->order.items;
  size_t at = place_of(list, s->id[1]);
  return s->kind == HSR_OF_PIECE && at < list->order.n && items[at].is_marked;
}

/* Where rows are kept until all pieces are in them: those that are, pale. */
void frames_draw_kept(struct frames *f, const struct hsr_event *event) {
  const struct frame_item *items = f->list.painted.items;
  if (!f->list.is_there || !f->list.painted.n || items->piece == NO_PIECE ||
      !lesson_has_counter(f->run->setup.algorithm, "list-segment"))
    return;
  for (size_t k = 0; k < f->list.painted.n; k++) {
    struct hsr_subject piece = {HSR_OF_PIECE,
                                {items[k].face, items[k].piece, 0}};
    const json_t *left = frames_outline(f, event, &piece);
    frames_add_polygon(f, left ? left : frames_image(f, items[k].face));
    frames_set_colour(f->cairo, frames_face_colour(f, items[k].face), .4);
    cairo_fill(f->cairo);
  }
}

/* The strip: its top and its height; what is done is as high as `DONE`. */
enum { TOP = FRAME_MARGIN + FRAME_SIDE + 3, HIGH = 12, DONE = 3, WIDEST = 26 };

static bool is_subject(const struct frame_item *item,
                       const struct hsr_subject *s) {
  return item->face == s->id[0] &&
         (item->piece == NO_PIECE
              ? s->kind == HSR_OF_FACE
              : s->kind == HSR_OF_PIECE && s->id[1] == item->piece);
}

/* The number, on its colour. */
static void put_number(struct frames *f, const struct frame_item *item,
                       double x, double width, bool is_done) {
  unsigned rgb = frames_face_colour(f, item->face);
  double light = .3 * (rgb >> 16) + .59 * (rgb >> 8 & 255) + .11 * (rgb & 255);
  char text[16];
  cairo_text_extents_t extents;
  snprintf(text, sizeof text, "%u",
           item->piece == NO_PIECE ? item->face : item->piece);
  cairo_select_font_face(f->cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(f->cairo, 8);
  cairo_text_extents(f->cairo, text, &extents);
  frames_set_colour(f->cairo,
                    is_done       ? FRAME_INK
                    : light > 140 ? 0
                                  : 0xffffff,
                    1);
  cairo_move_to(f->cairo, x + (width - extents.x_advance) / 2,
                TOP + HIGH - (is_done ? DONE + 1 : 3));
  cairo_show_text(f->cairo, text);
}

/* An item `width` wide, with a frame if the step is about it. */
static void draw_item(struct frames *f, const struct hsr_event *event,
                      const struct frame_item *item, double x, double width,
                      bool is_done) {
  enum { LEAST = 16 }; /* with a number */
  double gap = width > 4 ? 1 : 0, high = is_done ? DONE : HIGH;
  enum hsr_step_kind kind =
      f->run->setup.algorithm->counters[event->counter].kind;
  bool is_a = is_subject(item, &event->a), is_b = is_subject(item, &event->b);
  cairo_rectangle(f->cairo, x, TOP + HIGH - high, width - gap, high);
  frames_set_colour(f->cairo, frames_face_colour(f, item->face), 1);
  cairo_fill(f->cairo);
  if (width >= LEAST)
    put_number(f, item, x, width - gap, is_done);
  if (is_a || is_b) {
    cairo_rectangle(f->cairo, x + 1, TOP + 1, width - gap - 2, HIGH - 2);
    frames_stroke(f, frames_colour[kind], 2, is_a ? FRAME_SOLID : FRAME_DASHED);
  }
  if (item->is_marked) {
    cairo_move_to(f->cairo, x + width - gap - 6, TOP);
    cairo_line_to(f->cairo, x + width - gap, TOP);
    cairo_line_to(f->cairo, x + width - gap, TOP + 6);
    cairo_close_path(f->cairo);
    frames_set_colour(f->cairo, FRAME_INK, 1);
    cairo_fill(f->cairo);
  }
}

void frames_draw_list(struct frames *f, const struct hsr_event *event) {
  const struct frame_list *list = &f->list;
  const struct frame_item *painted = list->painted.items,
                          *order = list->order.items;
  size_t n = list->painted.n + list->order.n;
  bool goes_on = list->order.n && list->painted.n;
  double width =
      n ? fmin(WIDEST, (FRAME_WIDTH - 2. * FRAME_MARGIN) / (double)n) : 0;
  if (!list->is_there)
    return;
  f->scale = 1;
  for (size_t k = 0; k < n; k++) {
    bool is_done = k < list->painted.n;
    draw_item(f, event, is_done ? &painted[k] : &order[k - list->painted.n],
              FRAME_MARGIN + width * (double)k, width,
              is_done && list->order.n);
  }
  if (goes_on) { /* where painting is */
    cairo_rectangle(f->cairo,
                    FRAME_MARGIN + width * (double)list->painted.n - 1.5, TOP,
                    1.5, HIGH);
    frames_set_colour(f->cairo, FRAME_INK, 1);
    cairo_fill(f->cairo);
  }
}
