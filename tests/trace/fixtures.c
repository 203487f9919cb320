/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The list of a separate command, hsr-fixtures: one algorithm that draws lines
 * and has events of every kind of subject; and some that fail, or whose events
 * are not what they did. */
#define HSR_COUNTING 1
#include "bench/modules/modules.h"
#include "common/answers/kinds/segments.h"

#include <string.h>

extern const struct hsr_algorithm hsr_counting_oracle, hsr_counting_null,
    hsr_counting_zbuffer_fast, hsr_counting_raycast, hsr_counting_tiling_solids,
    hsr_counting_splat;

/* --- Lines ---------------------------------------------------------------- */

enum { LOOKS, SIDES, CELLS, VOLUMES, SKIPS, BITS, DRAWN };

static const struct hsr_counter plotter_counters[] = {
    [LOOKS] = {"looks", "vertices looked at", HSR_SAMPLE, HSR_OF_VERTEX,
               HSR_OF_IMPLIED},
    [SIDES] = {"sides", "edges compared with pieces", HSR_COMPARE, HSR_OF_EDGE,
               HSR_OF_PIECE, "left|right|on it"},
    [CELLS] = {"cells", "cells divided", HSR_SUBDIVIDE, HSR_OF_CELL,
               HSR_OF_FACE},
    [VOLUMES] = {"volumes", "volumes sorted", HSR_SORT, HSR_OF_VOLUME,
                 HSR_OF_VOLUME},
    [SKIPS] = {"skips", "nothing at all", HSR_REJECT, HSR_OF_NOTHING,
               HSR_OF_NOTHING},
    [BITS] = {"bits", "what a circuit would move", HSR_SORT, HSR_OF_NOTHING,
              HSR_OF_NOTHING, .computed = true},
    [DRAWN] = {"drawn", "intervals drawn", HSR_ACCEPT, HSR_OF_EDGE,
               HSR_OF_NOTHING},
    {NULL}};

static const struct hsr_line plotter_outline[] = {
    {"for each edge, the last first"},
    {"  look about", HSR_RAISES(LOOKS, SIDES, CELLS, VOLUMES, SKIPS, BITS)},
    {"  draw it in three parts", HSR_RAISES(DRAWN)},
    {NULL}};

static void look_about(struct hsr_tally *tally, uint32_t f, uint32_t v,
                       uint32_t w) {
  HSR_STEP(tally, LOOKS, HSR_VERTEX(v), HSR_IMPLIED(f, f + 1, 2), HSR_NOWHERE,
           0);
  HSR_STEP(tally, SIDES, HSR_EDGE(v, w, HSR_NO_ID), HSR_PIECE(f, 3),
           hsr_window_make(-2, 3, 5, 70), (int)(v % 3));
  HSR_STEP(tally, CELLS, HSR_CELL(4, 5, v), HSR_FACE(HSR_BACKGROUND),
           HSR_ON(0, 9, 2), 0);
  HSR_STEP(tally, VOLUMES, HSR_VOLUME(f), HSR_NOTHING, HSR_AT(1, (int)f % 10),
           0);
  HSR_STEP(tally, SKIPS, HSR_NOTHING, HSR_NOTHING, HSR_NOWHERE, 0);
  HSR_COMPUTED(tally, BITS, 17);
}

static void place(const struct hsr_world *world, uint32_t a, uint32_t b,
                  double t, double at[3]) {
  const double *const x[3] = {world->mesh.x, world->mesh.y, world->mesh.z};
  for (int c = 0; c < 3; c++)
    at[c] = x[c][a] + t * (x[c][b] - x[c][a]);
}

/* Faces that share an edge go along it in different directions, so no other
 * face gives this name. */
static struct hsr_edge_name name_edge(uint32_t f, uint32_t a, uint32_t b) {
  return a < b ? (struct hsr_edge_name){false, a, b, 0}
               : (struct hsr_edge_name){true, f, f + 1, 2};
}

/* Two parts that are one interval, and one that is hidden. */
static enum hsr_status draw_edge(const struct hsr_job *job, uint32_t f,
                                 uint32_t a, uint32_t b) {
  static const double end[] = {0, 1.0 / 3, 0.7, 1};
  struct hsr_segment s = {.edge = name_edge(f, a, b)};
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < 3 && !status; k++) {
    s.invisibility = k < 2 ? 0 : 3;
    s.t0 = end[k];
    s.t1 = end[k + 1];
    place(job->world, a, b, s.t0, s.from);
    place(job->world, a, b, s.t1, s.to);
    HSR_ACCEPTED(job->tally, DRAWN, HSR_EDGE(a, b, f), HSR_NOTHING,
                 HSR_AT(k, 40), &s);
    status = hsr_drawing_add(hsr_answer_drawing_of(job->answer), &s);
  }
  return status;
}

static enum hsr_status plot(const struct hsr_job *job, struct hsr_error *err) {
  const struct hsr_world *world = job->world;
  enum hsr_status status = HSR_OK;
  for (uint32_t f = world->n_faces; f-- && !status;) {
    const uint32_t *vertex = world->mesh.vertex + world->mesh.start[f];
    look_about(job->tally, f, vertex[0], vertex[1]);
    status = draw_edge(job, f, vertex[0], vertex[1]);
  }
  if (!status)
    status = hsr_drawing_sort(hsr_answer_drawing_of(job->answer));
  return status ? hsr_fail_nomem(err) : HSR_OK;
}

/* Draws one interval more than its events say. */
static enum hsr_status plot_more(const struct hsr_job *job,
                                 struct hsr_error *err) {
  const struct hsr_segment one = {.edge = {true, 0, 1, 0}, .t1 = 1};
  enum hsr_status status = plot(job, err);
  return status ? status
         : hsr_drawing_add(hsr_answer_drawing_of(job->answer), &one)
             ? hsr_fail_nomem(err)
             : HSR_OK;
}

/* --- Faces ---------------------------------------------------------------- */

enum { SHOWN, MORE };
static const struct hsr_counter painter_counters[] = {
    [SHOWN] = {"shown", "samples painted", HSR_ACCEPT, HSR_OF_FACE,
               HSR_OF_WINDOW},
    [MORE] = {"more", "more of them", HSR_SPAN, HSR_OF_WINDOW, HSR_OF_NOTHING},
    {NULL}};

static const struct hsr_line painter_outline[] = {
    {"paint all", HSR_RAISES(SHOWN, MORE)}, {NULL}};

/* One face everywhere. */
static enum hsr_status paint(const struct hsr_job *job, struct hsr_error *err) {
  (void)err;
  const struct hsr_window *w = &job->view->window;
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++)
      job->answer->ids[(size_t)j * (size_t)job->answer->m + (size_t)i] = 3;
  HSR_STEP(job->tally, SHOWN, HSR_FACE(3), HSR_THE_WINDOW, *w, 0);
  return HSR_OK;
}

/* Paints a sample without an event. */
static enum hsr_status liar(const struct hsr_job *job, struct hsr_error *err) {
  enum hsr_status status = paint(job, err);
  job->answer->ids[(size_t)job->answer->m + 1] = 4;
  return status;
}

/* Counts without an event. */
static enum hsr_status bulk(const struct hsr_job *job, struct hsr_error *err) {
  HSR_STEP(job->tally, MORE, HSR_THE_WINDOW, HSR_NOTHING, HSR_NOWHERE, 0);
  HSR_COMPUTED(job->tally, MORE, 6);
  return paint(job, err);
}

/* Has an event of a counter that it does not describe. */
static enum hsr_status unknown(const struct hsr_job *job,
                               struct hsr_error *err) {
  HSR_STEP(job->tally, 7, HSR_THE_WINDOW, HSR_NOTHING, HSR_NOWHERE, 0);
  return paint(job, err);
}

static enum hsr_status failing(const struct hsr_job *job,
                               struct hsr_error *err) {
  for (int k = 0; k < 100000; k++)
    HSR_STEP(job->tally, MORE, HSR_THE_WINDOW, HSR_NOTHING, HSR_NOWHERE, 0);
  return hsr_fail_nomem(err);
}

static enum hsr_status endless(const struct hsr_job *job,
                               struct hsr_error *err) {
  while (job->tally)
    HSR_STEP(job->tally, MORE, HSR_THE_WINDOW, HSR_NOTHING, HSR_NOWHERE, 0);
  return paint(job, err);
}

/* --- The list ------------------------------------------------------------- */

#define FIXTURE(id, ...)                                                       \
  static const struct hsr_algorithm fixture_##id = {.name = #id,               \
                                                    .title = #id,              \
                                                    .authors = "hsr",          \
                                                    .source = "tests",         \
                                                    .taxonomy = HSR_YARDSTICK, \
                                                    __VA_ARGS__};
#define PLOTTER(id, function)                                                  \
  FIXTURE(id, .subjects = 1 << HSR_FACES, .makes = {{HSR_SEGMENTS}},           \
          .counters = plotter_counters, .outline = plotter_outline,            \
          .render = function)
#define PAINTER(id, function)                                                  \
  FIXTURE(id, .subjects = 1 << HSR_FACES, .makes = {{HSR_IDS}},                \
          .counters = painter_counters, .outline = painter_outline,            \
          .render = function)
PLOTTER(plotter, plot)
PLOTTER(plotter2, plot_more)
PAINTER(paints, paint)
PAINTER(liar, liar)
PAINTER(bulk, bulk)
PAINTER(unknown, unknown)
PAINTER(failing, failing)
PAINTER(endless, endless)
FIXTURE(mute, .subjects = 1 << HSR_FACES, .makes = {{HSR_IDS}},
        .counters = painter_counters, .render = paint)

#define BOTH(id)                                                               \
  { &id, &id }
const struct hsr_listed hsr_modules[] = {BOTH(hsr_counting_oracle),
                                         BOTH(hsr_counting_null),
                                         BOTH(hsr_counting_zbuffer_fast),
                                         BOTH(hsr_counting_raycast),
                                         BOTH(hsr_counting_tiling_solids),
                                         BOTH(hsr_counting_splat),
                                         BOTH(fixture_plotter),
                                         BOTH(fixture_plotter2),
                                         BOTH(fixture_paints),
                                         BOTH(fixture_liar),
                                         BOTH(fixture_bulk),
                                         BOTH(fixture_unknown),
                                         BOTH(fixture_failing),
                                         BOTH(fixture_endless),
                                         BOTH(fixture_mute),
                                         {NULL, NULL}};
