/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a step is about, over the picture: as looks/ of the page draws it. */
#include "bench/lesson/frames.h"

#include <math.h>

/* --- Colours and paths ---------------------------------------------------- */

/* Of each kind of step, as on the page. */
const unsigned frames_colour[HSR_N_STEP_KINDS] = {
    [HSR_SORT] = 0xa88600,     [HSR_COMPARE] = 0x0663f9,
    [HSR_SPLIT] = 0xe45cb0,    [HSR_SUBDIVIDE] = 0x5a0aa0,
    [HSR_ACTIVATE] = 0x0a3040, [HSR_RETIRE] = 0x7a7a7a,
    [HSR_SPAN] = 0x0a3040,     [HSR_SAMPLE] = 0xa88600,
    [HSR_REJECT] = 0xb01a00,   [HSR_ACCEPT] = 0x049f52};

void frames_set_colour(cairo_t *cairo, unsigned rgb, double alpha) {
  cairo_set_source_rgba(cairo, (rgb >> 16) / 255., (rgb >> 8 & 255) / 255.,
                        (rgb & 255) / 255., alpha);
}

static void add_point(cairo_t *cairo, const json_t *point, bool first) {
  double x = json_number_value(json_array_get(point, 0)),
         y = json_number_value(json_array_get(point, 1));
  if (first)
    cairo_move_to(cairo, x, y);
  else
    cairo_line_to(cairo, x, y);
}

void frames_add_polygon(struct frames *f, const json_t *polygon) {
  size_t k;
  const json_t *point;
  json_array_foreach(polygon, k, point) add_point(f->cairo, point, k == 0);
  if (json_array_size(polygon))
    cairo_close_path(f->cairo);
}

void frames_add_line(struct frames *f, const json_t *from, const json_t *to) {
  if (!json_is_array(from) || !json_is_array(to))
    return;
  add_point(f->cairo, from, true);
  add_point(f->cairo, to, false);
}

bool frames_has_key(const struct frames *f, const struct hsr_event *event,
                    const char *key) {
  return hsr_has_key(&f->run->setup.algorithm->counters[event->counter], key);
}

bool frames_has_outcome(const struct frames *f, const struct hsr_event *event,
                        const char *key) {
  return hsr_outcome_has_key(&f->run->setup.algorithm->counters[event->counter],
                             event->outcome, key);
}

const json_t *frames_image(const struct frames *f, uint32_t face) {
  return json_array_get(
      json_array_get(json_object_get(f->header, "faces"), face), 4);
}

void frames_add_face(struct frames *f, uint32_t face) {
  frames_add_polygon(f, frames_image(f, face));
}

void frames_stroke(struct frames *f, unsigned colour, double width,
                   enum frame_dash dash) {
  const double dashes[2] = {(dash == FRAME_DOTTED ? 2 : 6) / f->scale,
                            (dash == FRAME_DOTTED ? 4 : 6) / f->scale};
  cairo_set_line_width(f->cairo, (width + 2.5) / f->scale);
  frames_set_colour(f->cairo, 0xffffff, 0.75);
  cairo_stroke_preserve(f->cairo);
  cairo_set_dash(f->cairo, dashes, dash == FRAME_SOLID ? 0 : 2, 0);
  cairo_set_line_width(f->cairo, width / f->scale);
  frames_set_colour(f->cairo, colour, 1);
  cairo_stroke(f->cairo);
  cairo_set_dash(f->cairo, dashes, 0, 0);
}

static void stroke(struct frames *f, unsigned colour, double width,
                   bool dashed) {
  frames_stroke(f, colour, width, dashed ? FRAME_DASHED : FRAME_SOLID);
}

static void mark_vertices(struct frames *f, const struct hsr_subject *subject,
                          unsigned colour, bool dashed) {
  const json_t *vertices = json_object_get(f->header, "vertices");
  const json_t *p = json_array_get(vertices, subject->id[0]),
               *q = json_array_get(vertices, subject->id[1]);
  if (subject->kind == HSR_OF_EDGE && json_is_array(p) && json_is_array(q)) {
    frames_add_line(f, p, q);
    stroke(f, colour, 3.5, dashed);
  }
  if (subject->kind == HSR_OF_VERTEX && json_is_array(p)) {
    cairo_arc(f->cairo, json_number_value(json_array_get(p, 0)),
              json_number_value(json_array_get(p, 1)), 5 / f->scale, 0,
              2 * 3.141592653589793);
    stroke(f, colour, 2.5, false);
  }
}

json_int_t frames_place_of_piece(const struct frames *f,
                                 const struct hsr_subject *piece) {
  json_int_t base = 0;
  size_t k;
  const json_t *from;
  json_array_foreach(json_object_get(f->structure, "bases"), k, from) {
    if (json_integer_value(json_array_get(from, 0)) <= piece->id[0])
      base = json_integer_value(json_array_get(from, 1));
  }
  return base + piece->id[1];
}

const json_t *frames_list_at(const struct frames *f,
                             const struct hsr_event *event) {
  const json_t *list, *found = NULL;
  size_t k;
  json_array_foreach(f->lists, k, list) {
    if (json_integer_value(json_object_get(list, "from")) <=
        (json_int_t)event->number)
      found = json_object_get(list, "pieces");
  }
  return found;
}

const json_t *frames_outline(const struct frames *f,
                             const struct hsr_event *event,
                             const struct hsr_subject *subject) {
  const json_t *of_trees = json_object_get(f->structure, "pieces"),
               *list = frames_list_at(f, event);
  if (subject->kind != HSR_OF_PIECE)
    return NULL;
  const json_t *piece =
      of_trees
          ? json_array_get(of_trees, (size_t)frames_place_of_piece(f, subject))
          : json_array_get(list, subject->id[1]);
  const json_t *outline = json_array_get(piece, of_trees ? 1 : 3);
  return json_array_size(outline) &&
                 json_integer_value(json_array_get(piece, 0)) == subject->id[0]
             ? outline
             : NULL;
}

/* The faces of a subject, and its edge or vertex. */
static void mark(struct frames *f, const struct hsr_event *event,
                 const struct hsr_subject *subject, unsigned colour,
                 bool dashed) {
  bool is_edge = subject->kind == HSR_OF_EDGE;
  uint32_t face = subject->kind == HSR_OF_FACE || subject->kind == HSR_OF_PIECE
                      ? subject->id[0]
                  : is_edge ? subject->id[2]
                            : HSR_NO_ID;
  if (face != HSR_NO_ID && face < f->run->laid_out.n_faces) {
    const json_t *left = frames_outline(f, event, subject);
    if (left)
      frames_add_polygon(f, left);
    else
      frames_add_face(f, face);
    bool is_line = is_edge || colour == frames_colour[HSR_ACCEPT];
    frames_set_colour(f->cairo, colour, is_line ? 0 : dashed ? 0.13 : 0.22);
    cairo_fill_preserve(f->cairo);
    stroke(f, colour, is_edge ? 1 : 2, dashed);
  }
  mark_vertices(f, subject, colour, dashed);
}

bool frames_is_of_body(const struct frames *f, const struct hsr_event *event) {
  return frames_has_outcome(f, event, "body");
}

const json_t *frames_faces_of_volume(const struct frames *f,
                                     const struct hsr_event *event,
                                     const struct hsr_subject *volume) {
  const char *list = frames_is_of_body(f, event) ? "bodies" : "volumes";
  return json_array_get(json_object_get(f->structure, list), volume->id[0]);
}

/* Borrowed: the sides of a part of a concave solid; NULL: it is none. */
static const json_t *sides_of(const struct frames *f,
                              const struct hsr_event *event,
                              const struct hsr_subject *volume) {
  size_t k;
  const json_t *part;
  json_array_foreach(json_object_get(f->structure, "parts"), k, part) {
    if (json_integer_value(json_array_get(part, 0)) == volume->id[0] &&
        !frames_is_of_body(f, event))
      return json_array_get(part, 1);
  }
  return NULL;
}

/* The faces of a volume, or of a body; the sides of a part. */
static void mark_volume(struct frames *f, const struct hsr_event *event,
                        const struct hsr_subject *s, unsigned colour,
                        bool dashed) {
  size_t k;
  const json_t *face;
  if (s->kind != HSR_OF_VOLUME)
    return;
  const json_t *sides = sides_of(f, event, s);
  json_array_foreach(sides ? sides : frames_faces_of_volume(f, event, s), k,
                     face) {
    if (sides)
      frames_add_polygon(f, face);
    else
      frames_add_face(f, (uint32_t)json_integer_value(face));
    frames_set_colour(f->cairo, colour, .1);
    cairo_fill_preserve(f->cairo);
    stroke(f, colour, 1.4, dashed);
  }
}

bool frames_is_part(const struct frames *f, const struct hsr_window *w) {
  return w->x0 < w->x1 && w->y0 < w->y1 &&
         (w->x0 > 0 || w->y0 > 0 || w->x1 < f->run->view.m ||
          w->y1 < f->run->view.n);
}

/* A cross for four quarters, a stroke for what is rejected. */
static void add_sign(struct frames *f, const struct hsr_window *w,
                     enum hsr_step_kind kind) {
  double x = (w->x0 + w->x1) / 2., y = (w->y0 + w->y1) / 2.;
  if (kind == HSR_SUBDIVIDE && w->y1 - w->y0 > 1) {
    cairo_move_to(f->cairo, x, w->y0);
    cairo_line_to(f->cairo, x, w->y1);
    cairo_move_to(f->cairo, w->x0, y);
    cairo_line_to(f->cairo, w->x1, y);
  } else if (kind == HSR_REJECT) {
    cairo_move_to(f->cairo, w->x0, w->y0);
    cairo_line_to(f->cairo, w->x1, w->y1);
  }
}

/* The row where an edge or a face begins, by its image; n: it has none. */
static double first_row(const struct frames *f, const struct hsr_subject *s) {
  const json_t *vertices = json_object_get(f->header, "vertices");
  const json_t *image =
      s->kind == HSR_OF_EDGE ? NULL : frames_image(f, s->id[0]);
  size_t n = image ? json_array_size(image) : 2;
  double top = INFINITY;
  for (size_t k = 0; k < n; k++) {
    const json_t *p =
        image ? json_array_get(image, k) : json_array_get(vertices, s->id[k]);
    if (json_is_array(p))
      top = fmin(top, json_number_value(json_array_get(p, 1)));
  }
  return ceil(top - .5);
}

/* The bucket that a thing is put into: the scan line where it begins. */
static void mark_bucket(struct frames *f, const struct hsr_event *event,
                        unsigned colour) {
  const struct hsr_window *w = &event->window;
  const struct hsr_view *view = &f->run->view;
  double row = w->y0 < w->y1 ? w->y0 : first_row(f, &event->a);
  if (!isfinite(row))
    return;
  cairo_rectangle(f->cairo, 0, fmax(0, fmin(view->n - 1, row)), view->m, 1);
  frames_set_colour(f->cairo, colour, .4);
  cairo_fill_preserve(f->cairo);
  stroke(f, colour, 1, false);
}

/* The window; of a part of a row, all of the row, pale. */
static void mark_window(struct frames *f, const struct hsr_event *event,
                        enum hsr_step_kind kind) {
  unsigned colour = frames_colour[kind];
  const struct hsr_window *w = &event->window;
  int m = f->run->view.m;
  bool is_row = w->y1 - w->y0 == 1 && w->x1 - w->x0 < m;
  if (is_row) {
    cairo_rectangle(f->cairo, 0, w->y0, m, 1);
    frames_set_colour(f->cairo, colour, .13);
    cairo_fill(f->cairo);
  }
  bool is_sample = is_row && w->x1 - w->x0 == 1;
  double more = is_sample ? 2 / f->scale : 0;
  cairo_rectangle(f->cairo, w->x0 - more, w->y0 - more,
                  w->x1 - w->x0 + 2 * more, w->y1 - w->y0 + 2 * more);
  add_sign(f, w, kind);
  stroke(f, colour, kind == HSR_ACCEPT ? 3 : 2, kind == HSR_RETIRE);
}

/* What an accepted step adds to a line drawing, also if it is hidden. */
static void mark_part(struct frames *f, const struct hsr_event *event,
                      unsigned colour) {
  const struct hsr_answer_type *type = f->run->answer.painted.form.type;
  if (!event->part || !type->lines || !type->part_json)
    return;
  enum { INVISIBILITY = 1, FROM = 6, TO = 7 };
  json_t *part = type->part_json(event->part, &f->run->view);
  frames_add_line(f, json_array_get(part, FROM), json_array_get(part, TO));
  stroke(f, colour, 3.5,
         json_integer_value(json_array_get(part, INVISIBILITY)) > 0);
  json_decref(part);
}

/* --- The face that is painted ---------------------------------------------- */

void frames_follow_segments(struct frames *f, const struct hsr_event *event) {
  if (frames_has_key(f, event, "list-segment") && event->a.kind == HSR_OF_FACE)
    f->segment = event->a.id[0];
}

/* The face that is painted, at a bead of its row. */
static void mark_painted(struct frames *f, const struct hsr_event *event,
                         unsigned colour) {
  if (!frames_has_key(f, event, "bead-merge") || event->a.kind != HSR_OF_FACE ||
      event->b.kind != HSR_OF_WINDOW || f->segment == HSR_NO_ID ||
      f->segment == event->a.id[0])
    return;
  frames_add_face(f, f->segment);
  frames_set_colour(f->cairo, colour, .06);
  cairo_fill_preserve(f->cairo);
  stroke(f, colour, 2, true);
}

/* The two faces that penetrate. */
static void mark_implied(struct frames *f, const struct hsr_subject *subject,
                         unsigned colour) {
  for (int k = 0; subject->kind == HSR_OF_IMPLIED && k < 2; k++)
    if (subject->id[k] < f->run->laid_out.n_faces) {
      frames_add_face(f, subject->id[k]);
      stroke(f, colour, 1, false);
    }
}

void frames_mark(struct frames *f, const struct hsr_event *event,
                 enum hsr_step_kind kind) {
  unsigned colour = frames_colour[kind];
  const struct hsr_window *w = &event->window;
  const struct hsr_subject *both[] = {&event->b, &event->a};
  if (frames_mark_shapes(f, event, colour))
    return;
  for (int k = 0; k < 2; k++) {
    mark_volume(f, event, both[k], colour, k == 0);
    if (!k || !frames_mark_fragment(f, event, colour))
      mark(f, event, both[k], colour, k == 0);
    frames_mark_cell(f, event, both[k], colour,
                     k == 0 ? FRAME_DASHED : FRAME_SOLID);
    mark_implied(f, both[k], colour);
  }
  bool is_of_window =
      event->a.kind == HSR_OF_WINDOW || event->b.kind == HSR_OF_WINDOW;
  if (frames_has_outcome(f, event, "first-row"))
    mark_bucket(f, event, colour);
  else if (frames_is_part(f, w) || (is_of_window && w->x0 < w->x1))
    mark_window(f, event, kind);
  mark_painted(f, event, colour);
  frames_mark_rows(f, event, colour);
  frames_mark_read(f, event, colour);
  frames_mark_planes(f, event, colour);
  frames_mark_boxes(f, event);
  frames_mark_test(f, event);
  if (kind == HSR_SPLIT)
    frames_mark_halves(f, event, colour);
  else
    frames_mark_markers(f, event);
  frames_mark_midpoint(f);
  mark_part(f, event, colour);
}
