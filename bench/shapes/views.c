/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shapes of a view: its frustum, and the spans of a run. */
#include "bench/run/crew.h"
#include "bench/shapes/shapes.h"

#include <math.h>
#include <string.h>

enum hsr_status hear_run(const struct shape_source *source,
                         struct hsr_answer *answer, struct hsr_tally *tally,
                         void (*listen)(void *, const struct hsr_event *),
                         void *context, struct hsr_error *err) {
  struct hsr_trace trace = {.listen = listen, .context = context};
  tally->trace = &trace;
  enum hsr_status status =
      answer_init(answer, source->setup, source->view, err);
  if (!status)
    status =
        render_view(source->setup, source->view, 1, answer, tally, NULL, err);
  tally->trace = NULL;
  return status;
}

/* The point of the ray of a screen point, at depth t. */
static void point_at(const struct hsr_view *view, double sx, double sy,
                     double t, double point[3]) {
  double x = (2 * sx - view->m) / view->m, y = (view->n - 2 * sy) / view->n;
  for (int k = 0; k < 3; k++) {
    double across = x * view->R[k] + y * view->U[k];
    point[k] = view->E[k] + (view->parallel ? across + t * view->F[k]
                                            : t * (view->F[k] + across));
  }
}

/* --- The frustum ---------------------------------------------------------- */

static double farthest(const struct shape_source *source) {
  const struct hsr_mesh *mesh = &source->world->mesh;
  const struct hsr_view *view = source->view;
  double far = 0;
  for (uint32_t v = 0; v < mesh->n_vertices; v++)
    far = fmax(far, view->F[0] * (mesh->x[v] - view->E[0]) +
                        view->F[1] * (mesh->y[v] - view->E[1]) +
                        view->F[2] * (mesh->z[v] - view->E[2]));
  return far > view->near ? far : view->near + 1;
}

/* Corners by bits: right, up, far. Of a pyramid, the near ones are the eye. */
enum hsr_status shape_frustum(const struct shape_source *source,
                              struct cell_list *list, struct hsr_error *err) {
  static const unsigned char side[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5},
                                           {0, 1, 5, 4}, {2, 6, 7, 3},
                                           {4, 5, 7, 6}, {0, 2, 3, 1}};
  const struct hsr_view *view = source->view;
  bool pyramid = !view->parallel && view->near <= 0;
  double far = farthest(source), p[3];
  (void)err;
  for (int k = 0; k < 8; k++) {
    point_at(view, k & 1 ? view->m : 0, k & 2 ? 0 : view->n,
             k & 4 ? far : view->near, p);
    cell_list_point(list, p);
  }
  bool polyhedron = list->kind == HSR_CELL_POLYHEDRON;
  int sides = pyramid ? 5 : 6;
  if (polyhedron)
    cell_list_number(list, (uint32_t)sides);
  for (int s = 0; s < sides; s++) {
    uint32_t corner[4];
    int n = 0;
    for (int k = 0; k < 4; k++) {
      uint32_t at = pyramid && side[s][k] < 4 ? 0 : side[s][k];
      if (!n || corner[n - 1] != at)
        corner[n++] = at;
    }
    n -= corner[n - 1] == corner[0];
    if (polyhedron)
      cell_list_number(list, (uint32_t)n);
    for (int k = 0; k < n; k++)
      cell_list_number(list, corner[k]);
    if (!polyhedron)
      cell_list_end(list);
  }
  if (polyhedron)
    cell_list_end(list);
  return HSR_OK;
}

/* --- Spans ---------------------------------------------------------------- */

enum { EVENT, COUNTER, OUTCOME, FACE, ROW, FIRST, LAST, N_DATA };

struct spans {
  const struct shape_source *source;
  struct cell_list *list;
  double depth;
  bool too_many;
};

static uint32_t face_of(const struct hsr_event *event) {
  const struct hsr_subject *both[] = {&event->a, &event->b};
  for (int k = 0; k < 2; k++)
    if (both[k]->kind == HSR_OF_FACE || both[k]->kind == HSR_OF_PIECE)
      return both[k]->id[0];
  return HSR_NO_ID;
}

static void hear_span(void *context, const struct hsr_event *event) {
  struct spans *s = context;
  const struct hsr_window *w = &event->window;
  enum hsr_step_kind kind =
      s->source->setup->algorithm->counters[event->counter].kind;
  if ((kind != HSR_SPAN && kind != HSR_ACCEPT) || w->y1 != w->y0 + 1 ||
      w->x0 >= w->x1)
    return;
  s->too_many |= s->list->start.n > MOST_SHAPE_CELLS;
  if (s->too_many)
    return;
  const int corner[4][2] = {
      {w->x0, w->y1}, {w->x1, w->y1}, {w->x1, w->y0}, {w->x0, w->y0}};
  for (int k = 0; k < 4; k++) {
    double p[3];
    point_at(s->source->view, corner[k][0], corner[k][1], s->depth, p);
    cell_list_number(s->list, cell_list_point(s->list, p));
  }
  cell_list_end(s->list);
  const uint32_t value[N_DATA] = {
      (uint32_t)event->number,  (uint32_t)event->counter,
      (uint32_t)event->outcome, face_of(event),
      (uint32_t)w->y0,          (uint32_t)w->x0,
      (uint32_t)w->x1 - 1};
  for (int k = 0; k < N_DATA; k++)
    cell_list_value(s->list, k, value[k]);
}

enum hsr_status shape_spans(const struct shape_source *source,
                            struct cell_list *list, struct hsr_error *err) {
  static const char *const names[N_DATA] = {
      "event", "counter", "outcome", "face", "row", "first", "last"};
  const struct hsr_camera *camera = &source->view->camera;
  struct spans spans = {.source = source, .list = list};
  struct hsr_tally tally = {.out_of_memory = false};
  struct hsr_answer answer = {.body = NULL};
  for (int k = 0; k < N_DATA; k++)
    cell_list_data(list, names[k], HSR_CELL_NUMBERS);
  for (int k = 0; k < 3; k++)
    spans.depth += (camera->at[k] - camera->eye[k]) * source->view->F[k] / 2;
  enum hsr_status status =
      hear_run(source, &answer, &tally, hear_span, &spans, err);
  if (!status && spans.too_many)
    status =
        hsr_fail(err, HSR_E_NOMEM, "more than %d spans", (int)MOST_SHAPE_CELLS);
  if (!status && !list->start.n)
    status = hsr_fail(err, HSR_E_USAGE, "%s works without spans of a row",
                      source->setup->algorithm->name);
  hsr_answer_free(&answer);
  return status;
}
