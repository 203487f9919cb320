/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every edge in intervals of one quantitative invisibility:
 * docs/correct-drawing.md. Two answers are equal if all edges agree. */
#include "common/answers/kinds/segments.h"
#include "common/answers/coded.h"
#include "common/answers/on_paper.h"
#include "common/files/json/drawing_json.h"
#include "common/files/mesh/exchange.h"
#include "common/files/suffix.h"
#include "common/paper/lines/lines.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct hsr_drawing *hsr_answer_drawing_of(const struct hsr_answer *answer) {
  return answer->form.type == &hsr_answer_segments ? answer->body : NULL;
}

struct hsr_answer hsr_answer_of_drawing(struct hsr_drawing *drawing, int m,
                                        int n) {
  return (struct hsr_answer){.form = hsr_form_standard(&hsr_answer_segments),
                             .m = m,
                             .n = n,
                             .body = drawing};
}

static const struct hsr_drawing *lines(const struct hsr_answer *answer) {
  return answer->body;
}

static enum hsr_status make(struct hsr_answer *answer, struct hsr_error *err) {
  answer->body = calloc(1, sizeof(struct hsr_drawing));
  return answer->body ? HSR_OK : hsr_fail_nomem(err);
}

static void clear(struct hsr_answer *answer) {
  hsr_drawing_clear(answer->body);
}

static void free_body(struct hsr_answer *answer) {
  hsr_drawing_free(answer->body);
  free(answer->body);
}

/* --- Comparing ------------------------------------------------------------ */

static void compare(const struct hsr_comparison *c,
                    struct hsr_difference *difference) {
  struct hsr_drawing_difference found;
  hsr_drawing_compare(c->got->body, c->wanted->body, c->coarse, &found);
  difference->compared = found.edges;
  difference->differing = found.differing;
  const struct hsr_edge_name *e = &found.first;
  if (found.differing && e->implied)
    snprintf(difference->first, sizeof difference->first,
             "the implied one of faces %u and %u, number %u", e->a, e->b,
             e->part);
  else if (found.differing)
    snprintf(difference->first, sizeof difference->first,
             "from vertex %u to %u", e->a, e->b);
}

/* --- Showing -------------------------------------------------------------- */

/* A .vtp file holds all intervals, in world space, and a .json file holds them
 * along their edges. Both hold what is known of their edges. */
static enum hsr_status write_facts(const struct hsr_answer *answer,
                                   const struct hsr_drawing_facts *facts,
                                   const char *path, struct hsr_error *err) {
  return hsr_ends_in(path, ".vtp")
             ? hsr_drawing_write_vtp(answer->body, facts, path, err)
             : hsr_drawing_json_write(path, answer->body, facts, answer->m,
                                      answer->n, err);
}

/* Finds what is known, and writes it. */
static enum hsr_status write_intervals(const struct hsr_answer *answer,
                                       const struct hsr_showing *showing,
                                       const char *path,
                                       struct hsr_error *err) {
  const struct hsr_drawing *drawing = answer->body;
  const struct hsr_scene *scene = showing->world->roster.scene;
  const double crease = showing->style ? showing->style->crease : -1;
  const char *class_name[HSR_N_LINE_CLASSES];
  unsigned char *line_class = malloc(drawing->n + 1);
  uint32_t *object = malloc((drawing->n + 1) * sizeof *object);
  const char **object_name =
      malloc(((size_t)scene->n_objects + 1) * sizeof *object_name);
  const struct hsr_drawing_facts facts = {line_class,         object,
                                          class_name,         object_name,
                                          HSR_N_LINE_CLASSES, scene->n_objects};
  enum hsr_status status =
      line_class && object && object_name ? HSR_OK : hsr_fail_nomem(err);
  if (!status)
    status = hsr_lines_classify(drawing, showing->world, showing->view, crease,
                                line_class, object, err);
  for (int k = 0; k < HSR_N_LINE_CLASSES; k++)
    class_name[k] = hsr_line_class_name((enum hsr_line_class)k);
  for (uint32_t o = 0; o < scene->n_objects && !status; o++)
    object_name[o] = scene->objects[o].name;
  if (!status)
    status = write_facts(answer, &facts, path, err);
  free(line_class);
  free(object);
  free(object_name);
  return status;
}

static enum hsr_status write(const struct hsr_answer *answer,
                             const struct hsr_showing *showing,
                             struct hsr_shaded *shaded, const char *path,
                             struct hsr_error *err) {
  (void)shaded;
  return hsr_ends_in(path, ".vtp") || hsr_ends_in(path, ".json")
             ? write_intervals(answer, showing, path, err)
             : hsr_show_on_paper(showing, answer->body, showing->fill, path,
                                 err);
}

static bool fits(const char *path) {
  return !hsr_is_array_file(path) && !hsr_is_depth_file(path);
}

/* The length in the picture, in pixels. */
static double length(const struct hsr_segment *segment,
                     const struct hsr_view *view) {
  double image[2][3], at[2][2];
  const double *const end[2] = {segment->from, segment->to};
  for (int k = 0; k < 2; k++) {
    hsr_view_project(view, end[k], image[k]);
    const double w = hsr_view_w(view, image[k]);
    if (!(w > 0))
      return 0;
    at[k][0] = fmin(fmax(image[k][0] / w, 0), view->m);
    at[k][1] = fmin(fmax(image[k][1] / w, 0), view->n);
  }
  return hypot(at[1][0] - at[0][0], at[1][1] - at[0][1]);
}

static void print(const struct hsr_answer *answer,
                  const struct hsr_showing *showing, FILE *out) {
  const struct hsr_drawing *drawing = answer->body;
  size_t edges = 0;
  double visible = 0, all = 0;
  for (size_t k = 0; k < drawing->n; k++) {
    const struct hsr_segment *segment = &drawing->segment[k];
    double part = length(segment, showing->view);
    all += part;
    visible += segment->invisibility ? 0 : part;
    edges += !k || hsr_edge_name_compare(&segment->edge, &segment[-1].edge);
  }
  fprintf(out, "%zu edges, %zu intervals, %.1f %% of their length visible\n",
          edges, drawing->n, all > 0 ? 100 * visible / all : 0);
  if (showing->drawn && showing->drawn->strokes)
    fprintf(out, "%zu strokes, %.1f mm of line, %.1f mm with the pen up\n",
            showing->drawn->strokes, showing->drawn->ink,
            showing->drawn->pen_up);
}

/* --- Tracing -------------------------------------------------------------- */

/* The part of an accepted event is a struct hsr_segment. */
static enum hsr_status paint(struct hsr_answer *answer,
                             const struct hsr_event *event) {
  return event->part ? hsr_drawing_add(answer->body, event->part) : HSR_OK;
}

static enum hsr_status settle(struct hsr_answer *answer) {
  return hsr_drawing_sort(answer->body);
}

/* The edge, coded like the subject of an event. Its own face is left open: the
 * edge may belong to several faces. */
/* Whether a point is beyond the view's `near`; and its place in samples. */
static bool is_seen(const struct hsr_view *view, const double point[3],
                    double at[2]) {
  double image[3];
  hsr_view_project(view, point, image);
  for (int k = 0; k < 2; k++)
    at[k] = image[k] / hsr_view_w(view, image);
  return image[2] > view->near && isfinite(at[0]) && isfinite(at[1]);
}

/* The visible intervals. */
static void sketch(const struct hsr_answer *painted,
                   const struct hsr_event *event, enum hsr_step_kind step,
                   const struct hsr_view *view, uint32_t face,
                   const struct hsr_slide *slide) {
  const struct hsr_segment *s = event->part;
  double from[2], to[2];
  (void)painted, (void)face;
  if (step == HSR_ACCEPT && s && !s->invisibility &&
      is_seen(view, s->from, from) && is_seen(view, s->to, to))
    slide->line(slide->on, from, to);
}

static json_t *edge_json(const struct hsr_edge_name *edge) {
  return hsr_subject_json(edge->implied
                              ? HSR_IMPLIED(edge->a, edge->b, edge->part)
                              : HSR_EDGE(edge->a, edge->b, HSR_NO_ID));
}

static json_t *segment_json(const void *part, const struct hsr_view *view) {
  const struct hsr_segment *s = part;
  return json_pack("[o I f f [fff] [fff] o o]", edge_json(&s->edge),
                   (json_int_t)s->invisibility, s->t0, s->t1, s->from[0],
                   s->from[1], s->from[2], s->to[0], s->to[1], s->to[2],
                   hsr_point_json(view, s->from), hsr_point_json(view, s->to));
}

static json_t *drawing_json(const struct hsr_answer *answer,
                            const struct hsr_view *view) {
  const struct hsr_drawing *drawing = answer->body;
  json_t *segments = json_array();
  for (size_t k = 0; k < drawing->n; k++)
    hsr_json_append(&segments, segment_json(&drawing->segment[k], view));
  return segments;
}

#pragma GCC visibility push(protected) /* for modules: hsr-module.h */
const struct hsr_answer_type hsr_answer_segments = {
    .name = "segments",
    .meaning = "every edge in intervals of one quantitative invisibility",
    .draws = "lines",
    .places = "edges",
    .grains = "samples",
    .takes = 1 << HSR_LINES | 1 << HSR_HATCH | 1 << HSR_BACKDROP,
    .make = make,
    .clear = clear,
    .free = free_body,
    .compare = compare,
    .fits = fits,
    .write = write,
    .lines = lines,
    .print = print,
    .paint = paint,
    .sketch = sketch,
    .settle = settle,
    .json = drawing_json,
    .part_json = segment_json};
#pragma GCC visibility pop
