/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steps of a run as pictures for slides: what is painted so far, and over it
 * what the step is about; beside it the outline, the step in words and the
 * counters.
 *
 * The run is made twice: once to count its steps, and once to draw those that
 * are wanted. */
#include "bench/lesson/frames.h"
#include "common/files/whole_file.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct square {
  double x, y, half; /* samples */
  double depth;
  uint32_t rgb;
};

static unsigned parse_colour(const json_t *text) {
  const char *word = json_string_value(text);
  return word ? (unsigned)strtoul(word + 1, NULL, 16) : 0;
}

unsigned frames_face_colour(const struct frames *f, uint32_t face) {
  const json_t *faces = json_object_get(f->header, "faces");
  return parse_colour(face == HSR_BACKGROUND
                          ? json_object_get(f->header, "background")
                          : json_array_get(json_array_get(faces, face), 2));
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
  frames_set_colour(f->cairo, 0x1d1f22, 1);
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
    frames_set_colour(f->cairo, square[k].rgb, 1);
    cairo_fill(f->cairo);
  }
}

static void draw_outlines(struct frames *f) {
  for (uint32_t k = 0; k < f->run->laid_out.n_faces; k++)
    frames_add_face(f, k);
  cairo_set_line_width(f->cairo, 0.7 / f->scale);
  frames_set_colour(f->cairo, 0x1d1f22, 0.25);
  cairo_stroke(f->cairo);
}

static void draw_picture(struct frames *f, const struct hsr_event *event,
                         enum hsr_step_kind kind) {
  const struct hsr_view *view = &f->run->view;
  f->scale = (double)FRAME_SIDE / (view->m > view->n ? view->m : view->n);
  cairo_save(f->cairo);
  cairo_translate(f->cairo, FRAME_MARGIN, FRAME_MARGIN);
  cairo_scale(f->cairo, f->scale, f->scale);
  cairo_rectangle(f->cairo, 0, 0, view->m, view->n);
  cairo_clip(f->cairo);
  if (event->number + 1 < f->steps)
    frames_draw_kept(f, event);
  draw_samples(f);
  draw_lines(f);
  draw_squares(f);
  draw_outlines(f);
  if (event->number + 1 < f->steps) /* at the end, nothing lies over it */
    frames_mark(f, event, kind);
  cairo_rectangle(f->cairo, 0, 0, view->m, view->n);
  cairo_set_line_width(f->cairo, 2 / f->scale);
  frames_set_colour(f->cairo, 0xd4d5d2, 1);
  cairo_stroke(f->cairo);
  cairo_restore(f->cairo);
}

/* --- Files ---------------------------------------------------------------- */

static cairo_status_t append(void *stream, const unsigned char *data,
                             unsigned length) {
  return fwrite(data, 1, length, stream) == length ? CAIRO_STATUS_SUCCESS
                                                   : CAIRO_STATUS_WRITE_ERROR;
}

static void draw_sheet(struct frames *f, const struct hsr_event *event) {
  frames_set_colour(f->cairo, 0xffffff, 1);
  cairo_paint(f->cairo);
  draw_picture(f, event,
               f->run->setup.algorithm->counters[event->counter].kind);
  frames_draw_words(f, event);
  frames_draw_list(f, event);
}

/* What cairo says of the file. */
static enum hsr_status judge(cairo_status_t said, const char *path,
                             struct hsr_error *err) {
  return said == CAIRO_STATUS_NO_MEMORY ? hsr_fail_nomem(err)
         : said ? hsr_fail(err, HSR_E_INPUT, "%.400s: %s", path,
                           cairo_status_to_string(said))
                : HSR_OK;
}

static cairo_status_t draw_slide(struct frames *f,
                                 const struct hsr_event *event, FILE *stream) {
  enum { SHARP = 2 }; /* pixels a point */
  cairo_surface_t *surface =
      f->png
          ? cairo_image_surface_create(CAIRO_FORMAT_RGB24, SHARP * FRAME_WIDTH,
                                       SHARP * FRAME_HEIGHT)
          : cairo_svg_surface_create_for_stream(append, stream, FRAME_WIDTH,
                                                FRAME_HEIGHT);
  f->cairo = cairo_create(surface);
  if (f->png)
    cairo_scale(f->cairo, SHARP, SHARP);
  draw_sheet(f, event);
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

/* The next page of the PDF. */
static void write_page(struct frames *f, const struct hsr_event *event) {
  f->cairo = cairo_create(f->pdf);
  draw_sheet(f, event);
  cairo_show_page(f->cairo);
  f->status = judge(cairo_status(f->cairo), f->folder, f->err);
  cairo_destroy(f->cairo);
}

static void write_frame(struct frames *f, const struct hsr_event *event) {
  char path[4400];
  struct hsr_whole_file file;
  name_frame(f, path);
  f->status = hsr_whole_file_open(&file, path, f->err);
  if (f->status)
    return;
  cairo_status_t said = draw_slide(f, event, file.stream);
  f->status = judge(said, path, f->err);
  f->status = hsr_whole_file_close(&file, f->status, f->err);
}

/* --- The run -------------------------------------------------------------- */

static void count_step(void *context, const struct hsr_event *event) {
  struct frames *f = context;
  f->steps++;
  if (event->counter < HSR_MAX_COUNTERS)
    f->total[event->counter]++;
  frames_note_cells(f, event);
  if (!f->status &&
      event->counter < trace_n_counters(f->run->setup.algorithm) &&
      !(frames_note_texel(f, event) && frames_note_region(f, event) &&
        frames_note_rows(f, event) && frames_note_shapes(f, event) &&
        frames_note_list(f, event)))
    f->status = hsr_fail_nomem(f->err);
  if (f->has_list && event->counter < trace_n_counters(f->run->setup.algorithm))
    lesson_note_list(&f->notes,
                     &f->run->setup.algorithm->counters[event->counter], event);
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
                 frames_face_colour(f, event->a.id[0]), &slide);
  else if (step == HSR_ACCEPT && !event->part)
    fill(f, &event->window, frames_face_colour(f, event->a.id[0]));
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
  frames_follow_fragments(f, event);
  frames_follow_search(f, event);
  frames_follow_segments(f, event);
  frames_follow_clip(f, event);
  if (!frames_follow_list(f, event) || !frames_follow_texels(f, event) ||
      !frames_follow_visits(f, event)) {
    f->status = hsr_fail_nomem(f->err);
    return;
  }
  sketch(f, event, a->counters[event->counter].kind);
  bool wanted = false;
  for (; f->done < f->n && event->number + 1 >= step_of(f, f->done);
       wanted = true) {
    if (!wanted)
      (f->pdf ? write_page : write_frame)(f, event);
    f->done++;
  }
}

/* So that the second run is as the first one: what the algorithm has kept of that
 * is gone. */
static enum hsr_status begin_again(struct trace_run *run,
                                   struct hsr_error *err) {
  if (hsr_choice_flags(run->setup.algorithm, &run->setup.choice) &
      HSR_FRAME_STATE) {
    trace_run_end(run);
    run->setup = (struct hsr_setup){.algorithm = NULL};
    return trace_run_begin(run, err);
  }
  trace_answer_free(&run->answer);
  return trace_answer_init(&run->answer, &run->setup, &run->view, err);
}

static enum hsr_status draw_run(struct frames *f, struct hsr_error *err) {
  struct trace_run *run = f->run;
  struct hsr_trace counts = {.listen = count_step, .context = f};
  struct hsr_trace draws = {.listen = listen, .context = f};
  struct hsr_tally tally = {.trace = &counts};
  static const struct trace_filter all = {.every = 1, .keyframe = 1};
  struct trace_header header = {.run = run, .filter = &all};
  f->has_list = lesson_has_list(&run->setup);
  enum hsr_status status =
      trace_answer_draw(&run->answer, &run->setup, &tally, err);
  status = status ? status : f->status;
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
  f->structure = lesson_structure_json(run);
  f->lists = lesson_lists_json(run, &f->notes);
  if (!f->header || !f->structure || !f->lists || !f->colour || !f->touches ||
      !frames_make_list(f))
    return hsr_fail_nomem(err);
  const struct hsr_answer *drawn = &run->answer.drawn;
  if (drawn->form.type == &hsr_answer_voxels)
    f->voxels = drawn->form.type->json(drawn, &run->view);
  status = begin_again(run, err);
  tally = (struct hsr_tally){.trace = &draws};
  if (!status)
    status = trace_answer_draw(&run->answer, &run->setup, &tally, err);
  return status ? status : f->status;
}

/* Draws steps of one run: as files, or as pages of `pdf`. */
static enum hsr_status draw_frames(const struct lesson_subject *subject,
                                   const struct lesson_slides *slides,
                                   cairo_surface_t *pdf,
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
                     .pdf = pdf,
                     .segment = HSR_NO_ID,
                     .err = err};
  enum hsr_status status = trace_run_open(&run, err);
  if (!status)
    status = draw_run(&f, err);
  json_decref(f.header);
  json_decref(f.structure);
  json_decref(f.lists);
  json_decref(f.voxels);
  json_decref(f.clip);
  json_decref(f.later);
  lesson_bytes_free(&f.notes);
  free(f.colour);
  free(f.touches);
  hsr_arena_free(&f.arena);
  trace_run_close(&run);
  return status;
}

enum hsr_status lesson_frames(const struct lesson_subject *subject,
                              const struct lesson_slides *slides,
                              struct hsr_error *err) {
  return draw_frames(subject, slides, NULL, err);
}

enum hsr_status lesson_pdf(const struct lesson_subject *subject, int n,
                           const struct lesson_slides *slides,
                           struct hsr_error *err) {
  struct hsr_whole_file file;
  enum hsr_status status = hsr_whole_file_open(&file, slides->folder, err);
  if (status)
    return status;
  cairo_surface_t *pdf = cairo_pdf_surface_create_for_stream(
      append, file.stream, FRAME_WIDTH, FRAME_HEIGHT);
  cairo_pdf_surface_set_metadata(pdf, CAIRO_PDF_METADATA_CREATE_DATE, "");
  for (int k = 0; k < n && !status; k++)
    status = draw_frames(&subject[k], slides, pdf, err);
  cairo_surface_finish(pdf);
  if (!status)
    status = judge(cairo_surface_status(pdf), slides->folder, err);
  cairo_surface_destroy(pdf);
  return hsr_whole_file_close(&file, status, err);
}
