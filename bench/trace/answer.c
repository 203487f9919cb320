/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/trace/trace.h"

#include <stdio.h>

/* --- Ids ------------------------------------------------------------------ */

/* What of a window is in the picture. */
static struct hsr_window clip(struct hsr_window w,
                              const struct hsr_view *view) {
  return (struct hsr_window){w.x0 > 0 ? w.x0 : 0, w.y0 > 0 ? w.y0 : 0,
                             w.x1 < view->m ? w.x1 : view->m,
                             w.y1 < view->n ? w.y1 : view->n};
}

static enum hsr_status paint_ids(const struct hsr_view *view,
                                 struct hsr_answer *answer,
                                 const struct hsr_event *event) {
  uint32_t *ids = hsr_answer_ids_of(answer);
  struct hsr_window w = clip(event->window, view);
  for (int j = w.y0; j < w.y1; j++)
    for (int i = w.x0; i < w.x1; i++)
      ids[(size_t)j * (size_t)view->m + (size_t)i] = event->a.id[0];
  return HSR_OK;
}

/* Runs of one id, row after row: id, how often, id, how often ... */
static json_t *ids_json(const struct hsr_view *view,
                        const struct hsr_answer *answer) {
  const uint32_t *ids = hsr_answer_ids_of(answer);
  size_t n = (size_t)view->m * (size_t)view->n;
  json_t *runs = json_array();
  for (size_t k = 0, next; k < n; k = next) {
    for (next = k + 1; next < n && ids[next] == ids[k];)
      next++;
    json_append(&runs,
                ids[k] == HSR_BACKGROUND ? json_null() : json_integer(ids[k]));
    json_append(&runs, json_integer((json_int_t)(next - k)));
  }
  return runs;
}

/* --- Line drawings -------------------------------------------------------- */

static enum hsr_status paint_segment(const struct hsr_view *view,
                                     struct hsr_answer *answer,
                                     const struct hsr_event *event) {
  (void)view;
  return event->part
             ? hsr_drawing_add(hsr_answer_drawing_of(answer), event->part)
             : HSR_OK;
}

static enum hsr_status sort(struct hsr_answer *answer) {
  return hsr_drawing_sort(hsr_answer_drawing_of(answer));
}

/* The edge is coded like the subject of an event; its own face, of which there
 * may be several, is left open. */
static json_t *edge_json(const struct hsr_edge_name *edge) {
  return trace_subject_json(edge->implied
                                ? HSR_IMPLIED(edge->a, edge->b, edge->part)
                                : HSR_EDGE(edge->a, edge->b, HSR_NO_ID));
}

static json_t *segment_json(const struct hsr_view *view, const void *part) {
  const struct hsr_segment *s = part;
  return json_pack("[o I f f [fff] [fff] o o]", edge_json(&s->edge),
                   (json_int_t)s->invisibility, s->t0, s->t1, s->from[0],
                   s->from[1], s->from[2], s->to[0], s->to[1], s->to[2],
                   trace_point_json(view, s->from),
                   trace_point_json(view, s->to));
}

static json_t *drawing_json(const struct hsr_view *view,
                            const struct hsr_answer *answer) {
  const struct hsr_drawing *drawing = hsr_answer_drawing_of(answer);
  json_t *segments = json_array();
  for (size_t k = 0; k < drawing->n; k++)
    json_append(&segments, segment_json(view, &drawing->segment[k]));
  return segments;
}

/* --- The kinds ------------------------------------------------------------ */

struct kind {
  const struct hsr_answer_type *type;
  /* Adds what an accepted event tells. HSR_E_NOMEM. */
  enum hsr_status (*paint)(const struct hsr_view *view,
                           struct hsr_answer *answer,
                           const struct hsr_event *event);
  /* Brings what was painted into the order of an answer. NULL: it has none.
   * HSR_E_NOMEM. */
  enum hsr_status (*sort)(struct hsr_answer *answer);
  json_t *(*json)(const struct hsr_view *view, const struct hsr_answer *answer);
  json_t *(*part_json)(const struct hsr_view *view, const void *part);
};
static const struct kind kinds[] = {
    {HSR_IDS, paint_ids, NULL, ids_json, NULL},
    {HSR_SEGMENTS, paint_segment, sort, drawing_json, segment_json}};
enum { N_KINDS = sizeof kinds / sizeof *kinds };

static const struct kind *kind_of(const struct hsr_answer_type *type) {
  for (int k = 0; k < N_KINDS; k++)
    if (kinds[k].type == type)
      return &kinds[k];
  return NULL;
}

bool trace_answer_is_known(const struct hsr_answer_type *type) {
  return kind_of(type) != NULL;
}

/* --- Any ------------------------------------------------------------------ */

enum hsr_status trace_answer_init(struct trace_answer *answer,
                                  const struct hsr_setup *setup,
                                  const struct hsr_view *view,
                                  struct hsr_error *err) {
  *answer = (struct trace_answer){.view = view};
  enum hsr_status status = answer_init(&answer->drawn, setup, view, err);
  return status ? status : answer_init(&answer->painted, setup, view, err);
}

void trace_answer_free(struct trace_answer *answer) {
  hsr_answer_free(&answer->drawn);
  hsr_answer_free(&answer->painted);
}

enum hsr_status trace_answer_draw(struct trace_answer *answer,
                                  const struct hsr_setup *setup,
                                  struct hsr_tally *tally,
                                  struct hsr_error *err) {
  return render_view(setup, answer->view, 1, &answer->drawn, tally, NULL, err);
}

void trace_answer_paint(struct trace_answer *answer,
                        const struct hsr_event *event) {
  const struct kind *kind = kind_of(answer->painted.form.type);
  if (kind->paint(answer->view, &answer->painted, event))
    answer->out_of_memory = true;
}

enum hsr_status trace_answer_compare(struct trace_answer *answer, char *text,
                                     size_t size) {
  const struct hsr_answer_type *type = answer->drawn.form.type;
  const struct kind *kind = kind_of(type);
  if (answer->out_of_memory || (kind->sort && kind->sort(&answer->painted)))
    return HSR_E_NOMEM;
  const struct hsr_view *view = answer->view;
  struct hsr_comparison comparison = {.view = view,
                                      .got = &answer->painted,
                                      .wanted = &answer->drawn,
                                      .n = (size_t)view->m * (size_t)view->n};
  struct hsr_difference found = {.differing = 0};
  type->compare(&comparison, &found);
  snprintf(text, size, "%llu of %llu %s", (unsigned long long)found.differing,
           (unsigned long long)found.compared, found.first);
  return found.differing ? HSR_E_DIFFERENCE : HSR_OK;
}

json_t *trace_answer_painted_json(const struct trace_answer *answer) {
  return kind_of(answer->painted.form.type)
      ->json(answer->view, &answer->painted);
}

json_t *trace_answer_drawn_json(const struct trace_answer *answer) {
  return kind_of(answer->drawn.form.type)->json(answer->view, &answer->drawn);
}

json_t *trace_answer_part_json(const struct trace_answer *answer,
                               const void *part) {
  const struct kind *kind = kind_of(answer->drawn.form.type);
  return part ? kind->part_json(answer->view, part) : json_null();
}

const char *trace_answer_field(const struct trace_answer *answer) {
  return answer->drawn.form.type->name;
}
