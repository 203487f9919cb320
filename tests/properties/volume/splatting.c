/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tests/properties/volume/splatting.h"
#include "tests/tap.h"
#include "bench/modules/variant.h"
#include "scenes/scenes.h"
#include "common/answers/kinds/composited.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- Grids ---------------------------------------------------------------- */

static enum hsr_status give_slice(void *data, uint32_t k, float *density,
                                  struct hsr_error *err) {
  (void)err;
  const struct field *f = data;
  size_t n = (size_t)f->n[0] * f->n[1];
  for (size_t c = 0; c < n; c++)
    density[c] = f->density ? f->density[n * k + c] : 1;
  return HSR_OK;
}

static void give_colour(void *data, const uint32_t at[3], float density,
                        float rgb[3]) {
  (void)density;
  const struct field *f = data;
  size_t row = (size_t)at[2] * f->n[1] + at[1];
  memcpy(rgb, f->rgb[row * f->n[0] + at[0]], 3 * sizeof *rgb);
}

static void finish_stage(struct stage *s) {
  must_finish(s->scene);
  must_roster(&s->world, s->scene);
}

void open_stage(struct stage *s, const struct field *field) {
  struct field own = *field;
  struct hsr_error err = {.text = "out of memory"};
  const struct hsr_grid_samples samples = {{own.n[0], own.n[1], own.n[2]},
                                           {own.at[0], own.at[1], own.at[2]},
                                           give_slice,
                                           own.rgb ? give_colour : NULL,
                                           &own,
                                           own.low,
                                           own.high};
  struct hsr_grid grid;
  s->scene = hsr_scene_new("splats");
  if (!s->scene || hsr_grid_init(&grid, &samples, &own.keep, &err))
    bail("%s", err.text);
  grid.palette = *own.palette;
  if (hsr_scene_set_grid(s->scene, &grid))
    bail("out of memory");
  finish_stage(s);
}

void open_named_stage(struct stage *s, const char *name) {
  s->scene = must_open(name);
  must_roster(&s->world, s->scene);
}

void close_stage(struct stage *s) {
  hsr_world_free(&s->world);
  hsr_scene_delete(s->scene);
}

struct hsr_palette plain_palette(int opacity, int grey) {
  struct hsr_palette p = {.ambient = UINT16_MAX, .exponent = 1};
  for (int k = 0; k < HSR_LEVELS; k++) {
    p.opacity[k] = (uint16_t)opacity;
    p.gradient[k] = UINT16_MAX;
    for (int c = 0; c < 3; c++)
      p.rgb[k][c] = (uint16_t)grey;
  }
  return p;
}

/* --- Pictures ------------------------------------------------------------- */

struct hsr_variant splat_variant(const char *format, ...) {
  char text[300];
  struct hsr_variant made;
  struct hsr_error err;
  va_list args;
  va_start(args, format);
  vsnprintf(text, sizeof text, format, args);
  va_end(args);
  if (hsr_variant_parse(text, &made, &err))
    bail("%s", err.text);
  return made;
}

struct hsr_view splat_view(const struct hsr_camera *camera, int m, int n) {
  struct hsr_view view;
  must_view(&view, camera, m, n);
  return view;
}

static void draw(const struct stage *s, const struct hsr_algorithm *algorithm,
                 const struct hsr_choice *choice, const struct hsr_view *view,
                 const struct hsr_window *windows, int n_windows,
                 uint16_t *rgba, struct hsr_tally *tally) {
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_setup setup;
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  struct hsr_answer answer;
  struct hsr_tally own = {.out_of_memory = false};
  if (hsr_answer_make(&answer, &choice->form, view, false, &err))
    bail("%s", err.text);
  must_setup(&setup, algorithm, choice, &s->world);
  answer.form.type->unset(&answer);
  for (int k = 0; k < n_windows; k++) {
    struct hsr_view part = *view;
    part.window = windows[k];
    struct hsr_job job = {.view = &part,
                          .scratch = &scratch,
                          .tally = tally ? tally : &own,
                          .answer = &answer};
    if (hsr_setup_render(&setup, &job, &err))
      bail("%s", err.text);
    hsr_arena_reset(&scratch);
  }
  memcpy(rgba, hsr_answer_rgba_of(&answer),
         4 * (size_t)view->m * (size_t)view->n * sizeof *rgba);
  hsr_setup_free(&setup);
  hsr_arena_free(&scratch);
  hsr_answer_free(&answer);
}

void draw_splats(const struct stage *s, const struct hsr_view *view,
                 const struct hsr_variant *v, enum build build,
                 const struct hsr_window *windows, int n_windows,
                 uint16_t *rgba, struct hsr_tally *tally) {
  draw(s, build == COUNTING ? v->listed->counting : v->listed->plain,
       &v->choice, view, n_windows ? windows : &view->window,
       n_windows ? n_windows : 1, rgba, tally);
}

void judge_splats(const struct stage *s, const struct hsr_view *view,
                  const struct hsr_variant *v, uint16_t *rgba,
                  struct hsr_tally *tally) {
  const struct hsr_algorithm *oracle =
      hsr_algorithm_find("splat-oracle")->plain;
  struct hsr_choice choice = hsr_choice_standard(oracle);
  choice.form = v->choice.form;
  draw(s, oracle, &choice, view, &view->window, 1, rgba, tally);
}

uint64_t count_of(const struct hsr_variant *v, const struct hsr_tally *tally,
                  const char *counter) {
  const struct hsr_counter *c = v->listed->counting->counters;
  for (int k = 0; c[k].name; k++)
    if (!strcmp(c[k].name, counter))
      return tally->count[k];
  bail("%s", counter);
  return 0;
}
