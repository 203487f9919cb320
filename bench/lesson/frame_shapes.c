/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pieces that are cut by clip polygons, as steps tell them: over the picture, as
 * looks/clipped.js of the page draws them. A shape is [face, cycles of sides]. */
#include "bench/lesson/frames.h"

#include <math.h>
#include <string.h>

/* The shape that a step is about: a new reference. NULL: it tells none. */
static json_t *shape_json(const struct frames *f,
                          const struct hsr_event *event) {
  enum hsr_step_kind kind =
      f->run->setup.algorithm->counters[event->counter].kind;
  bool is_shape = kind != HSR_ACCEPT || frames_has_key(f, event, "piece-shown");
  return event->part && is_shape ? f->run->answer.painted.form.type->part_json(
                                       event->part, &f->run->view)
                                 : NULL;
}

/* --- What comes after a step ---------------------------------------------- */

/* A step that tells what came of one before it. */
enum { EVENT, WORD, SHAPE };

static const char *word_of(const struct frames *f,
                           const struct hsr_event *event) {
  static const char *const words[] = {"piece-culled", "clip-polygon",
                                      "examination", "inside-list",
                                      "piece-shown"};
  for (size_t k = 0; k < sizeof words / sizeof *words; k++)
    if (frames_has_key(f, event, words[k]))
      return words[k];
  return NULL;
}

bool frames_note_shapes(struct frames *f, const struct hsr_event *event) {
  const char *word = word_of(f, event);
  if (!word)
    return true;
  f->later = f->later ? f->later : json_array();
  hsr_json_append(&f->later, json_pack("[I s o*]", (json_int_t)event->number,
                                       word, shape_json(f, event)));
  return f->later != NULL;
}

/* The place among those of the first one after a step. */
static size_t first_after(const struct frames *f,
                          const struct hsr_event *event) {
  size_t low = 0, high = json_array_size(f->later);
  while (low < high) {
    size_t middle = low + (high - low) / 2;
    const json_t *later = json_array_get(f->later, middle);
    if (json_integer_value(json_array_get(later, EVENT)) <=
        (json_int_t)event->number)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

static bool is_word(const json_t *later, const char *word) {
  const char *own = json_string_value(json_array_get(later, WORD));
  return own && !strcmp(own, word);
}

/* --- The drawing ---------------------------------------------------------- */

/* Its holes stay empty: they run the other way round. */
static void mark_shape(struct frames *f, const json_t *shape,
                       const struct frame_look *look) {
  enum { X = 3, Y = 4 };
  size_t c, k;
  const json_t *cycle, *side;
  json_array_foreach(json_array_get(shape, 1), c, cycle) {
    json_array_foreach(cycle, k, side) {
      double x = json_number_value(json_array_get(side, X)),
             y = json_number_value(json_array_get(side, Y));
      if (k)
        cairo_line_to(f->cairo, x, y);
      else
        cairo_move_to(f->cairo, x, y);
    }
    cairo_close_path(f->cairo);
  }
  frames_set_colour(f->cairo, look->colour, look->fill);
  cairo_fill_preserve(f->cairo);
  frames_stroke(f, look->colour, look->width, look->dash);
}

/* The box around the outer cycle. */
static void mark_box(struct frames *f, const json_t *shape,
                     enum frame_dash dash) {
  enum { X = 3, Y = 4 };
  double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
  size_t k;
  const json_t *side;
  json_array_foreach(json_array_get(json_array_get(shape, 1), 0), k, side) {
    for (size_t c = 0; c < 2; c++) {
      double x = json_number_value(json_array_get(side, c ? Y : X));
      low[c] = fmin(low[c], x);
      high[c] = fmax(high[c], x);
    }
  }
  if (low[0] > high[0])
    return;
  cairo_rectangle(f->cairo, low[0], low[1], high[0] - low[0], high[1] - low[1]);
  frames_stroke(f, FRAME_INK, 1.2, dash);
}

/* What is thrown away of a piece that is divided where two planes meet. */
static void mark_parts_behind(struct frames *f, const struct hsr_event *event,
                              const struct frame_look *look) {
  json_int_t next = (json_int_t)event->number + 1;
  for (size_t k = first_after(f, event);; k++, next++) {
    const json_t *later = json_array_get(f->later, k);
    if (json_integer_value(json_array_get(later, EVENT)) != next ||
        !is_word(later, "piece-culled"))
      return;
    mark_shape(f, json_array_get(later, SHAPE), look);
  }
}

/* The polygons of a list that is begun, but for its last one: the first of them is the
 * next clip polygon, against which the others are examined. */
static void mark_inside_list(struct frames *f, const struct hsr_event *event,
                             const struct frame_look *look) {
  const json_t *later, *last = NULL;
  size_t n = 0;
  for (size_t k = first_after(f, event); (later = json_array_get(f->later, k));
       k++) {
    bool is_clip = is_word(later, "clip-polygon");
    if (!is_clip && !is_word(later, "examination") &&
        !is_word(later, "piece-culled"))
      return;
    if (is_word(later, "piece-culled"))
      continue;
    const json_t *shape = json_array_get(later, SHAPE);
    if (last && shape)
      mark_shape(f, last, look);
    last = shape ? shape : last;
    if (is_clip && ++n > 1)
      return;
    n += !is_clip;
  }
}

static void mark_where(struct frames *f, const struct hsr_event *event,
                       const json_t *shape, unsigned colour) {
  const struct frame_look look = {colour, .55, 1.2, FRAME_SOLID};
  if (frames_has_outcome(f, event, "boxes")) {
    mark_box(f, shape, FRAME_SOLID);
    mark_box(f, f->clip, FRAME_DASHED);
  } else if (frames_has_key(f, event, "plane-division"))
    mark_parts_behind(f, event, &look);
  else if (frames_has_key(f, event, "inside-list"))
    mark_inside_list(f, event, &look);
}

void frames_follow_clip(struct frames *f, const struct hsr_event *event) {
  if (!frames_has_key(f, event, "clip-polygon"))
    return;
  json_decref(f->clip);
  f->clip = shape_json(f, event);
}

bool frames_mark_shapes(struct frames *f, const struct hsr_event *event,
                        unsigned colour) {
  json_t *shape = shape_json(f, event);
  if (!shape)
    return false;
  if (event->b.kind == HSR_OF_FACE && f->clip)
    mark_shape(f, f->clip, &(struct frame_look){colour, .12, 2, FRAME_DASHED});
  bool is_shown = frames_has_key(f, event, "piece-shown");
  bool is_piece = frames_has_outcome(f, event, "cut-piece");
  mark_shape(f, shape,
             &(struct frame_look){colour,
                                  is_shown   ? 0
                                  : is_piece ? .55
                                             : .22,
                                  is_shown ? 2.5 : 2, FRAME_SOLID});
  mark_where(f, event, shape, colour);
  json_decref(shape);
  return true;
}
