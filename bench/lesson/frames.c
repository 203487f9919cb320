/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steps of a run as pictures for slides: what is painted so far, and over it
 * what the step is about; beside it the outline, the step in words and the
 * counters.
 *
 * The run is made twice: once to count its steps, and once to draw those that
 * are wanted. */
#include "bench/lesson/lesson.h"
#include "common/files/json/json.h"
#include "common/files/whole_file.h"

#include <cairo-svg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A slide, in points: the picture's square at the left, words at the right. */
enum {
  WIDTH = 960,
  HEIGHT = 540,
  MARGIN = 20,
  SIDE = 500,
  LEFT = 545,
  LINE = 15
};

struct frames {
  struct trace_run *run;
  const char *folder;
  bool png;
  long n, done;         /* frames, and how many are drawn */
  const uint64_t *step; /* the steps that they show, from 1; NULL: evenly */
  uint64_t steps;       /* of the whole run */
  uint64_t total[HSR_MAX_COUNTERS]; /* in the whole run */
  uint64_t count[HSR_MAX_COUNTERS];
  json_t *header;    /* as of hsr trace: where the faces are */
  json_t *volumes;   /* as of lesson_add_volumes; NULL: there are none */
  uint32_t *colour;  /* of the samples, as cairo has them; 0: not painted yet */
  uint32_t *touches; /* of the samples: how often a step looked at them */
  struct hsr_arena arena;
  struct hsr_growing lines;   /* so far: double[4], from and to */
  struct hsr_growing squares; /* so far: struct square */
  cairo_t *cairo;
  double scale; /* of the picture */
  enum hsr_status status;
  struct hsr_error *err;
};

struct square {
  double x, y, half; /* samples */
  double depth;
  uint32_t rgb;
};

/* --- Colours and paths ---------------------------------------------------- */

/* Of each kind of step, as on the page. */
static const unsigned kind_colour[HSR_N_STEP_KINDS] = {
    [HSR_SORT] = 0xa88600,     [HSR_COMPARE] = 0x0663f9,
    [HSR_SPLIT] = 0xe45cb0,    [HSR_SUBDIVIDE] = 0x5a0aa0,
    [HSR_ACTIVATE] = 0x0a3040, [HSR_RETIRE] = 0x7a7a7a,
    [HSR_SPAN] = 0x0a3040,     [HSR_SAMPLE] = 0xa88600,
    [HSR_REJECT] = 0xb01a00,   [HSR_ACCEPT] = 0x049f52};

static void set_colour(cairo_t *cairo, unsigned rgb, double alpha) {
  cairo_set_source_rgba(cairo, (rgb >> 16) / 255., (rgb >> 8 & 255) / 255.,
                        (rgb & 255) / 255., alpha);
}

static unsigned parse_colour(const json_t *text) {
  const char *word = json_string_value(text);
  return word ? (unsigned)strtoul(word + 1, NULL, 16) : 0;
}

static unsigned face_colour(const struct frames *f, uint32_t face) {
  const json_t *faces = json_object_get(f->header, "faces");
  return parse_colour(face == HSR_BACKGROUND
                          ? json_object_get(f->header, "background")
                          : json_array_get(json_array_get(faces, face), 2));
}

static void add_point(cairo_t *cairo, const json_t *point, bool first) {
  double x = json_number_value(json_array_get(point, 0)),
         y = json_number_value(json_array_get(point, 1));
  if (first)
    cairo_move_to(cairo, x, y);
  else
    cairo_line_to(cairo, x, y);
}

static void add_face(struct frames *f, uint32_t face) {
  const json_t *polygon = json_array_get(
      json_array_get(json_object_get(f->header, "faces"), face), 4);
  size_t k;
  const json_t *point;
  json_array_foreach(polygon, k, point) add_point(f->cairo, point, k == 0);
  if (json_array_size(polygon))
    cairo_close_path(f->cairo);
}

/* Strokes the path, on a pale seam. */
static void stroke(struct frames *f, unsigned colour, double width,
                   bool dashed) {
  double dash = 6 / f->scale;
  cairo_set_line_width(f->cairo, (width + 2.5) / f->scale);
  set_colour(f->cairo, 0xffffff, 0.75);
  cairo_stroke_preserve(f->cairo);
  cairo_set_dash(f->cairo, &dash, dashed, 0);
  cairo_set_line_width(f->cairo, width / f->scale);
  set_colour(f->cairo, colour, 1);
  cairo_stroke(f->cairo);
  cairo_set_dash(f->cairo, &dash, 0, 0);
}

/* --- The picture ---------------------------------------------------------- */

static void draw_samples(struct frames *f) {
  const struct hsr_view *view = &f->run->view;
  cairo_surface_t *samples = cairo_image_surface_create_for_data(
      (unsigned char *)f->colour, CAIRO_FORMAT_ARGB32, view->m, view->n,
      4 * view->m);
  cairo_set_source_surface(f->cairo, samples, 0, 0);
  cairo_pattern_set_filter(cairo_get_source(f->cairo), CAIRO_FILTER_NEAREST);
  cairo_paint(f->cairo);
  cairo_surface_destroy(samples);
}

static void draw_lines(struct frames *f) {
  const double(*line)[4] = (const double(*)[4])f->lines.items;
  for (size_t k = 0; k < f->lines.n; k++) {
    cairo_move_to(f->cairo, line[k][0], line[k][1]);
    cairo_line_to(f->cairo, line[k][2], line[k][3]);
  }
  cairo_set_line_width(f->cairo, 1.8 / f->scale);
  set_colour(f->cairo, 0x1d1f22, 1);
  cairo_stroke(f->cairo);
}

static int farthest_first(const void *a, const void *b) {
  const struct square *p = a, *q = b;
  return (p->depth < q->depth) - (p->depth > q->depth);
}

static void draw_squares(struct frames *f) {
  const struct square *square = f->squares.items;
  if (f->squares.n)
    qsort(f->squares.items, f->squares.n, sizeof *square, farthest_first);
  for (size_t k = 0; k < f->squares.n; k++) {
    cairo_rectangle(f->cairo, square[k].x - square[k].half,
                    square[k].y - square[k].half, 2 * square[k].half,
                    2 * square[k].half);
    set_colour(f->cairo, square[k].rgb, 1);
    cairo_fill(f->cairo);
  }
}

static void draw_outlines(struct frames *f) {
  for (uint32_t k = 0; k < f->run->laid_out.n_faces; k++)
    add_face(f, k);
  cairo_set_line_width(f->cairo, 0.7 / f->scale);
  set_colour(f->cairo, 0x1d1f22, 0.25);
  cairo_stroke(f->cairo);
}

static void mark_vertices(struct frames *f, const struct hsr_subject *subject,
                          unsigned colour, bool dashed) {
  const json_t *vertices = json_object_get(f->header, "vertices");
  const json_t *p = json_array_get(vertices, subject->id[0]),
               *q = json_array_get(vertices, subject->id[1]);
  if (subject->kind == HSR_OF_EDGE && json_is_array(p) && json_is_array(q)) {
    add_point(f->cairo, p, true);
    add_point(f->cairo, q, false);
    stroke(f, colour, 3.5, dashed);
  }
  if (subject->kind == HSR_OF_VERTEX && json_is_array(p)) {
    cairo_arc(f->cairo, json_number_value(json_array_get(p, 0)),
              json_number_value(json_array_get(p, 1)), 5 / f->scale, 0,
              2 * 3.141592653589793);
    stroke(f, colour, 2.5, false);
  }
}

/* The faces of a subject, and its edge or vertex. */
static void mark(struct frames *f, const struct hsr_subject *subject,
                 unsigned colour, bool dashed) {
  bool is_edge = subject->kind == HSR_OF_EDGE;
  uint32_t face = subject->kind == HSR_OF_FACE || subject->kind == HSR_OF_PIECE
                      ? subject->id[0]
                  : is_edge ? subject->id[2]
                            : HSR_NO_ID;
  if (face != HSR_NO_ID && face < f->run->laid_out.n_faces) {
    add_face(f, face);
    set_colour(f->cairo, colour, is_edge ? 0 : dashed ? 0.16 : 0.28);
    cairo_fill_preserve(f->cairo);
    stroke(f, colour, is_edge ? 1 : 2, dashed);
  }
  mark_vertices(f, subject, colour, dashed);
}

/* Whether a step of an algorithm with volumes is about a whole body. */
static bool is_of_body(const struct hsr_counter *c, int outcome) {
  return hsr_has_key(c, "body-rejected") || hsr_has_key(c, "body-apart") ||
         (hsr_has_key(c, "minimax") && outcome < 2);
}

/* The faces of a volume, or of a body. */
static void mark_volume(struct frames *f, const struct hsr_event *event,
                        unsigned colour) {
  const struct hsr_counter *c =
      &f->run->setup.algorithm->counters[event->counter];
  const struct hsr_subject *s =
      event->a.kind == HSR_OF_VOLUME ? &event->a : &event->b;
  if (!f->volumes || s->kind != HSR_OF_VOLUME)
    return;
  const char *list = is_of_body(c, event->outcome) ? "bodies" : "volumes";
  size_t k;
  const json_t *face;
  json_array_foreach(
      json_array_get(json_object_get(f->volumes, list), s->id[0]), k, face) {
    add_face(f, (uint32_t)json_integer_value(face));
    set_colour(f->cairo, colour, .1);
    cairo_fill_preserve(f->cairo);
    stroke(f, colour, 1.4, true);
  }
}

static bool is_part_of_picture(const struct frames *f,
                               const struct hsr_window *w) {
  return w->x0 < w->x1 && w->y0 < w->y1 &&
         (w->x0 > 0 || w->y0 > 0 || w->x1 < f->run->view.m ||
          w->y1 < f->run->view.n);
}

static void mark_event(struct frames *f, const struct hsr_event *event,
                       enum hsr_step_kind kind) {
  unsigned colour = kind_colour[kind];
  const struct hsr_window *w = &event->window;
  mark_volume(f, event, colour);
  mark(f, &event->b, colour, true);
  mark(f, &event->a, colour, false);
  if (!is_part_of_picture(f, w))
    return;
  cairo_rectangle(f->cairo, w->x0, w->y0, w->x1 - w->x0, w->y1 - w->y0);
  stroke(f, colour, 2, false);
}

static void draw_picture(struct frames *f, const struct hsr_event *event,
                         enum hsr_step_kind kind) {
  const struct hsr_view *view = &f->run->view;
  f->scale = (double)SIDE / (view->m > view->n ? view->m : view->n);
  cairo_save(f->cairo);
  cairo_translate(f->cairo, MARGIN, MARGIN);
  cairo_scale(f->cairo, f->scale, f->scale);
  cairo_rectangle(f->cairo, 0, 0, view->m, view->n);
  cairo_clip(f->cairo);
  draw_samples(f);
  draw_lines(f);
  draw_squares(f);
  draw_outlines(f);
  mark_event(f, event, kind);
  cairo_rectangle(f->cairo, 0, 0, view->m, view->n);
  cairo_set_line_width(f->cairo, 2 / f->scale);
  set_colour(f->cairo, 0xd4d5d2, 1);
  cairo_stroke(f->cairo);
  cairo_restore(f->cairo);
}

/* --- The words ------------------------------------------------------------ */

/* Smaller if it would not fit. */
static void put(struct frames *f, double x, double y, double size, bool bold,
                const char *text) {
  cairo_select_font_face(f->cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD
                              : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(f->cairo, size);
  cairo_text_extents_t extents;
  cairo_text_extents(f->cairo, text, &extents);
  if (extents.x_advance > WIDTH - 8 - x)
    cairo_set_font_size(f->cairo, size * (WIDTH - 8 - x) / extents.x_advance);
  cairo_move_to(f->cairo, x, y);
  cairo_show_text(f->cairo, text);
}

/* A subject in words: at most `size` bytes. */
static void say(const struct frames *f, const struct hsr_subject *subject,
                char *text, size_t size) {
  uint32_t p = subject->id[0], q = subject->id[1];
  *text = '\0';
  if (subject->kind == HSR_OF_NOTHING)
    return;
  if (subject->kind == HSR_OF_FACE || subject->kind == HSR_OF_PIECE) {
    const json_t *face = json_array_get(json_object_get(f->header, "faces"), p);
    const char *name = json_string_value(
        json_array_get(json_object_get(f->header, "objects"),
                       (size_t)json_integer_value(json_array_get(face, 1))));
    if (p == HSR_BACKGROUND)
      snprintf(text, size, "the background");
    else
      snprintf(text, size, "face %u (%.30s)", p, name ? name : "");
  } else if (subject->kind == HSR_OF_EDGE && p != HSR_NO_ID)
    snprintf(text, size, "edge %u-%u", p, q);
  else if (subject->kind == HSR_OF_WINDOW || p == HSR_NO_ID)
    snprintf(text, size, "the %s", hsr_subject_kind_name[subject->kind]);
  else
    snprintf(text, size, "%s %u", hsr_subject_kind_name[subject->kind], p);
}

/* The outcome's word. */
static void say_outcome(const struct hsr_counter *counter, int outcome,
                        char *text, size_t size) {
  const char *at = counter->outcomes;
  for (int k = 0; at && k < outcome; k++) {
    at = strchr(at, '|');
    at = at ? at + 1 : NULL;
  }
  snprintf(text, size, "%.*s", at ? (int)strcspn(at, "|") : 0, at ? at : "");
}

/* Whether the run comes to line `at` of the outline, or to one within it. */
static bool is_used(const struct frames *f, const struct hsr_line *at) {
  size_t depth = strspn(at->text, " ");
  const struct hsr_line *l = at;
  do {
    for (int r = 0; r < l->n_raises; r++)
      for (int k = 0; k < trace_n_counters(f->run->setup.algorithm); k++)
        if (f->total[k] && hsr_line_of(f->run->setup.algorithm, k) ==
                               (int)(l - f->run->setup.algorithm->outline) + 1)
          return true;
    l++;
  } while (l->text && strspn(l->text, " ") > depth);
  return l == at + 1 && !at->n_raises && strncmp(at->text, "with ", 5) != 0;
}

/* The lines that the run comes to. */
static double put_outline(struct frames *f, int current) {
  double y = 70;
  int number = 0;
  for (const struct hsr_line *l = f->run->setup.algorithm->outline; l->text;
       l++) {
    number++;
    if (!is_used(f, l))
      continue;
    if (number == current) {
      cairo_rectangle(f->cairo, LEFT - 6, y - 11, WIDTH - LEFT, LINE);
      set_colour(f->cairo, 0xd0dcef, 1);
      cairo_fill(f->cairo);
    }
    set_colour(f->cairo, 0x1d1f22, 1);
    int indent = (int)strspn(l->text, " ");
    put(f, LEFT + 6 * indent, y, 11, number == current, l->text + indent);
    y += LINE;
  }
  return y + 8;
}

static double put_step(struct frames *f, const struct hsr_event *event,
                       const struct hsr_counter *counter, double y) {
  char a[96], b[96], outcome[96], text[400];
  say(f, &event->a, a, sizeof a);
  say(f, &event->b, b, sizeof b);
  say_outcome(counter, event->outcome, outcome, sizeof outcome);
  snprintf(text, sizeof text, "%s, %s%s%s%s%s",
           hsr_step_kind_name[counter->kind], a, *a && *b ? " with " : "", b,
           *outcome ? ": " : "", outcome);
  set_colour(f->cairo, kind_colour[counter->kind], 1);
  put(f, LEFT, y + 4, 13, true, text);
  set_colour(f->cairo, 0x5d6269, 1);
  put(f, LEFT, y + 20, 10, false, counter->meaning);
  return y + 42;
}

static void put_counters(struct frames *f, int raised, double y) {
  const struct hsr_algorithm *a = f->run->setup.algorithm;
  for (int k = 0; k < trace_n_counters(a) && y < HEIGHT - 12; k++) {
    if (a->counters[k].computed)
      continue;
    char text[24];
    snprintf(text, sizeof text, "%llu", (unsigned long long)f->count[k]);
    set_colour(f->cairo,
               k == raised ? kind_colour[a->counters[k].kind] : 0x1d1f22, 1);
    put(f, LEFT, y, 11, k == raised, a->counters[k].name);
    put(f, LEFT + 200, y, 11, k == raised, text);
    y += LINE;
  }
}

static void draw_words(struct frames *f, const struct hsr_event *event) {
  const struct hsr_algorithm *a = f->run->setup.algorithm;
  char text[80];
  set_colour(f->cairo, 0x1d1f22, 1);
  put(f, LEFT, 34, 16, true, a->title);
  snprintf(text, sizeof text, "step %llu of %llu",
           (unsigned long long)event->number + 1, (unsigned long long)f->steps);
  set_colour(f->cairo, 0x5d6269, 1);
  put(f, LEFT, 50, 10, false, text);
  double y = put_outline(f, hsr_line_of(a, event->counter));
  y = put_step(f, event, &a->counters[event->counter], y);
  put_counters(f, event->counter, y);
}

/* --- Files ---------------------------------------------------------------- */

static cairo_status_t append(void *stream, const unsigned char *data,
                             unsigned length) {
  return fwrite(data, 1, length, stream) == length ? CAIRO_STATUS_SUCCESS
                                                   : CAIRO_STATUS_WRITE_ERROR;
}

static cairo_status_t draw_slide(struct frames *f,
                                 const struct hsr_event *event, FILE *stream) {
  enum { SHARP = 2 }; /* pixels a point */
  cairo_surface_t *surface =
      f->png
          ? cairo_image_surface_create(CAIRO_FORMAT_RGB24, SHARP * WIDTH,
                                       SHARP * HEIGHT)
          : cairo_svg_surface_create_for_stream(append, stream, WIDTH, HEIGHT);
  f->cairo = cairo_create(surface);
  if (f->png)
    cairo_scale(f->cairo, SHARP, SHARP);
  set_colour(f->cairo, 0xffffff, 1);
  cairo_paint(f->cairo);
  draw_picture(f, event,
               f->run->setup.algorithm->counters[event->counter].kind);
  draw_words(f, event);
  cairo_status_t said = cairo_status(f->cairo);
  cairo_destroy(f->cairo);
  if (!said && f->png)
    said = cairo_surface_write_to_png_stream(surface, append, stream);
  cairo_surface_finish(surface);
  if (!said)
    said = cairo_surface_status(surface);
  cairo_surface_destroy(surface);
  return said;
}

/* DIR/watkins-0001.svg, numbered through, or by its step if the steps are chosen;
 * letters that are not for names of files become -. */
static void name_frame(const struct frames *f, char path[4400]) {
  unsigned long long number =
      f->step ? f->step[f->done] : (unsigned long long)f->done + 1;
  char name[64];
  snprintf(name, sizeof name, "%.60s", f->run->variant->name);
  for (char *c = name; *c; c++)
    if (!strchr("abcdefghijklmnopqrstuvwxyz0123456789-.", *c))
      *c = '-';
  snprintf(path, 4400, "%.4096s/%s-%04llu.%s", f->folder, name, number,
           f->png ? "png" : "svg");
}

static void write_frame(struct frames *f, const struct hsr_event *event) {
  char path[4400];
  struct hsr_whole_file file;
  name_frame(f, path);
  f->status = hsr_whole_file_open(&file, path, f->err);
  if (f->status)
    return;
  cairo_status_t said = draw_slide(f, event, file.stream);
  f->status = said == CAIRO_STATUS_NO_MEMORY ? hsr_fail_nomem(f->err)
              : said ? hsr_fail(f->err, HSR_E_INPUT, "%.400s: %s", path,
                                cairo_status_to_string(said))
                     : HSR_OK;
  f->status = hsr_whole_file_close(&file, f->status, f->err);
}

/* --- The run -------------------------------------------------------------- */

static void count_step(void *context, const struct hsr_event *event) {
  struct frames *f = context;
  f->steps++;
  if (event->counter < HSR_MAX_COUNTERS)
    f->total[event->counter]++;
}

static void fill(void *on, const struct hsr_window *w, uint32_t rgb) {
  struct frames *f = on;
  const struct hsr_view *view = &f->run->view;
  for (int j = w->y0 > 0 ? w->y0 : 0; j < w->y1 && j < view->n; j++)
    for (int i = w->x0 > 0 ? w->x0 : 0; i < w->x1 && i < view->m; i++)
      f->colour[(size_t)j * (size_t)view->m + (size_t)i] = 0xff000000u | rgb;
}

/* Makes room for one more item; NULL if memory ran out. */
static void *add(struct frames *f, struct hsr_growing *items, size_t size) {
  if (hsr_arena_grow(&f->arena, items, size))
    return (char *)items->items + (items->n - 1) * size;
  f->status = hsr_fail_nomem(f->err);
  return NULL;
}

static void add_line(void *on, const double from[2], const double to[2]) {
  struct frames *f = on;
  double *line = add(f, &f->lines, 4 * sizeof *line);
  for (int k = 0; line && k < 4; k++)
    line[k] = k < 2 ? from[k] : to[k - 2];
}

static void add_square(void *on, const double middle[2], double half,
                       double depth, uint32_t rgb) {
  struct frames *f = on;
  struct square *square = add(f, &f->squares, sizeof *square);
  if (square)
    *square = (struct square){middle[0], middle[1], half, depth, rgb};
}

/* A sample that is not written yet is the darker the more often it was looked
 * at. */
static void touch(void *on, const struct hsr_window *w) {
  struct frames *f = on;
  size_t k = (size_t)w->y0 * (size_t)f->run->view.m + (size_t)w->x0;
  if (w->x1 - w->x0 != 1 || w->y1 - w->y0 != 1 || f->colour[k] >> 24 == 255)
    return;
  uint32_t alpha = (uint32_t)fmin(200, 26 * log2(1. + ++f->touches[k]));
  uint32_t rgb = 0;
  for (int c = 16; c >= 0; c -= 8)
    rgb |= (0x5d6269u >> c & 255) * alpha / 255 << c;
  f->colour[k] = alpha << 24 | rgb;
}

/* What a step adds to the picture. */
static void sketch(struct frames *f, const struct hsr_event *event,
                   enum hsr_step_kind step) {
  const struct hsr_answer *painted = &f->run->answer.painted;
  const struct hsr_answer_type *type = painted->form.type;
  const struct hsr_slide slide = {f, fill, add_line, add_square, touch};
  if (step != HSR_ACCEPT && step != HSR_SAMPLE)
    return;
  if (step == HSR_ACCEPT)
    trace_answer_paint(&f->run->answer, event);
  if (type->sketch)
    type->sketch(painted, event, step, &f->run->view,
                 face_colour(f, event->a.id[0]), &slide);
  else if (step == HSR_ACCEPT && !event->part)
    fill(f, &event->window, face_colour(f, event->a.id[0]));
}

/* The step that frame number `frame` shows, from 1. */
static uint64_t step_of(const struct frames *f, long frame) {
  if (f->step)
    return f->step[frame];
  return (uint64_t)ceil((double)f->steps * (double)(frame + 1) / (double)f->n);
}

static void listen(void *context, const struct hsr_event *event) {
  struct frames *f = context;
  const struct hsr_algorithm *a = f->run->setup.algorithm;
  if (f->status || event->counter >= trace_n_counters(a))
    return;
  f->count[event->counter]++;
  sketch(f, event, a->counters[event->counter].kind);
  bool wanted = false;
  for (; f->done < f->n && event->number + 1 >= step_of(f, f->done);
       wanted = true) {
    if (!wanted)
      write_frame(f, event);
    f->done++;
  }
}

static enum hsr_status draw_run(struct frames *f, struct hsr_error *err) {
  struct trace_run *run = f->run;
  struct hsr_trace counts = {.listen = count_step, .context = f};
  struct hsr_trace draws = {.listen = listen, .context = f};
  struct hsr_tally tally = {.trace = &counts};
  static const struct trace_filter all = {.every = 1, .keyframe = 1};
  struct trace_header header = {.run = run, .filter = &all};
  enum hsr_status status =
      trace_answer_draw(&run->answer, &run->setup, &tally, err);
  if (!status && f->step && f->step[f->n - 1] > f->steps)
    status = hsr_fail(err, HSR_E_USAGE, "lesson: --steps: %s has %llu steps",
                      run->variant->name, (unsigned long long)f->steps);
  if (status)
    return status;
  f->header = trace_header_json(&header);
  f->colour =
      calloc((size_t)run->view.m * (size_t)run->view.n, sizeof *f->colour);
  f->touches =
      calloc((size_t)run->view.m * (size_t)run->view.n, sizeof *f->touches);
  if (lesson_has_volumes(&run->setup)) {
    f->volumes = json_object();
    if (!f->volumes || !lesson_add_volumes(f->volumes, run))
      return hsr_fail_nomem(err);
  }
  if (!f->header || !f->colour || !f->touches)
    return hsr_fail_nomem(err);
  trace_answer_free(&run->answer);
  status = trace_answer_init(&run->answer, &run->setup, &run->view, err);
  tally = (struct hsr_tally){.trace = &draws};
  if (!status)
    status = trace_answer_draw(&run->answer, &run->setup, &tally, err);
  return status ? status : f->status;
}

enum hsr_status lesson_frames(const struct lesson_subject *subject,
                              const struct lesson_slides *slides,
                              struct hsr_error *err) {
  struct trace_run run = {.command = "lesson",
                          .scene_options = subject->scene,
                          .view_options = subject->view,
                          .variant = subject->variant,
                          .most_faces = LESSON_MOST_FACES};
  struct frames f = {.run = &run,
                     .folder = slides->folder,
                     .n = slides->n,
                     .step = slides->step,
                     .png = slides->png,
                     .err = err};
  enum hsr_status status = trace_run_open(&run, err);
  if (!status)
    status = draw_run(&f, err);
  json_decref(f.header);
  json_decref(f.volumes);
  free(f.colour);
  free(f.touches);
  hsr_arena_free(&f.arena);
  trace_run_close(&run);
  return status;
}
