/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What Sutherland et al. 1974 claim about Newell's algorithm: "List-Priority
 * Algorithms" and "New Uses of Coherence". */
#include "bench/modules/modules.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"
#include "common/answers/filter.h"
#include "common/answers/kinds/transparent.h"

#include <stdlib.h>
#include <string.h>

enum { M = 64, N = 48, SHEETS = 40, FRAMES = 24 };

static const struct hsr_algorithm *counting(const char *name) {
  return hsr_algorithm_find(name)->counting;
}

/* A square on z = depth with the centre (x, y) and half a side of `half`. */
static struct hsr_object *add_square(struct hsr_scene *scene, double x,
                                     double y, double depth, double half,
                                     const float rgb[3]) {
  struct hsr_object *object = hsr_scene_object(scene, "square");
  uint32_t v[4];
  for (int k = 0; k < 4; k++)
    hsr_object_vertex(object, x + (k == 1 || k == 2 ? half : -half),
                      y + (k > 1 ? half : -half), depth, &v[k]);
  hsr_object_face(object, v, 4, rgb);
  return object;
}

static void look_down_z(struct hsr_scene *scene, struct hsr_world *world,
                        struct hsr_view *view) {
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_camera camera = {
      .eye = {0, 0, 100}, .at = {0, 0, 0}, .up = {0, 1, 0}, .fov = 40};
  if (hsr_scene_view(scene, &camera))
    bail("%s", err.text);
  must_finish(scene);
  must_world(world, scene);
  must_view(view, &camera, M, N);
}

/* A list that is in order of priority after the Z sort. */
static void check_sorted(struct tap *tap) {
  static const float grey[3] = {0.5f, 0.5f, 0.5f};
  static uint32_t ids[M * N];
  struct hsr_scene *scene = hsr_scene_new("sheets");
  struct hsr_world world;
  struct hsr_view view;
  for (int k = 0; k < SHEETS; k++)
    add_square(scene, k % 5 - 2, k % 7 - 3, (k * 17 % SHEETS) - 20, 9, grey);
  look_down_z(scene, &world, &view);
  const struct hsr_algorithm *a = counting("newell");
  struct hsr_tally tally = {.out_of_memory = false};
  draw_ids(a, &world, &view, ids, &tally);
  ok(tap, counted(a, &tally, "interchanges") == 0,
     "a list that is in order is left as it is");
  ok(tap, counted(a, &tally, "divisions") == 0, "nothing is divided");
  ok(tap, counted(a, &tally, "Z sort") == 2 * SHEETS, "the Z sort costs 2 F_r");
  ok(tap, counted(a, &tally, "Newell special") == SHEETS - 1,
     "the special sort looks at each neighbour once (%llu)",
     (unsigned long long)counted(a, &tally, "Newell special"));
  hsr_world_free(&world);
  hsr_scene_delete(scene);
}

static void check_division(struct tap *tap) {
  static uint32_t ids[M * N];
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_import import = {.strict = true};
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_view view;
  if (hsr_scene_open("cyclic-overlap", &import, &scene, &err))
    bail("%s", err.text);
  must_world(&world, scene);
  must_view(&view, &scene->views[0], M, N);
  const struct hsr_algorithm *a = counting("newell");
  struct hsr_tally tally = {.out_of_memory = false};
  draw_ids(a, &world, &view, ids, &tally);
  ok(tap, counted(a, &tally, "divisions") > 0,
     "cyclic overlap is resolved by division (%llu)",
     (unsigned long long)counted(a, &tally, "divisions"));
  ok(tap, counted(a, &tally, "thickness checks") == 0,
     "and by nothing else, where faces are flat");
  hsr_world_free(&world);
  hsr_scene_delete(scene);
}

/* What frames of a walk cost, from the last frame's order. */
struct cost {
  uint64_t planes, overlaps, divisions;
};

static void add_cost(const struct hsr_algorithm *a,
                     const struct hsr_tally *tally, struct cost *cost) {
  cost->planes += counted(a, tally, "plane tests");
  cost->overlaps += counted(a, tally, "overlap tests");
  cost->divisions += counted(a, tally, "divisions");
}

/* One prepared object over frames of a slowly turning view, of which the last
 * is seen twice. */
static void check_coherence(struct tap *tap, const char *name) {
  static uint32_t ids[M * N], wanted[M * N];
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_import import = {.strict = true};
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_setup setup;
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  const struct hsr_algorithm *a = counting("newell-previous");
  if (hsr_scene_open(name, &import, &scene, &err))
    bail("%s", err.text);
  must_world(&world, scene);
  must_setup(&setup, a, NULL, &world);
  long wrong = 0;
  struct cost first = {0}, later = {0}, again = {0};
  for (int k = 0; k <= FRAMES; k++) {
    struct hsr_camera camera = scene->views[0];
    camera.eye[0] += 0.01 * (k < FRAMES ? k : k - 1);
    struct hsr_view view;
    struct hsr_tally tally = {.out_of_memory = false};
    must_view(&view, &camera, M, N);
    struct hsr_answer answer = hsr_answer_of_ids(ids, M, N);
    struct hsr_job job = {
        .view = &view, .scratch = &scratch, .tally = &tally, .answer = &answer};
    hsr_arena_reset(&scratch);
    if (hsr_setup_render(&setup, &job, &err))
      bail("%s", err.text);
    draw_plain("oracle", &world, &view, wanted);
    wrong += count_differences(&view, ids, wanted);
    add_cost(a, &tally, k == 0 ? &first : k < FRAMES ? &later : &again);
  }
  ok(tap, !wrong, "%s from the previous frame's order: the same pictures",
     name);
  ok(tap, 4 * later.planes < first.planes * (FRAMES - 1),
     "what the last frame's planes told is not asked again (%.0f, first %llu)",
     (double)later.planes / (FRAMES - 1), (unsigned long long)first.planes);
  ok(tap, again.divisions == 0,
     "pieces are kept: nothing is divided again (first %llu)",
     (unsigned long long)first.divisions);
  ok(tap, again.planes == again.overlaps,
     "the same view again: only pairs that no plane tells (%llu)",
     (unsigned long long)again.planes);
  hsr_setup_free(&setup);
  hsr_arena_free(&scratch);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
}

/* The colour of face 0 with the given opacity over that of face 1, by the
 * definition's words. */
static void mix(const uint16_t *over, const uint16_t *under, uint64_t opacity,
                uint16_t rgb[3]) {
  for (int c = 0; c < 3; c++)
    rgb[c] =
        (uint16_t)((opacity * over[c] + (65535 - opacity) * under[c] + 32767) /
                   65535);
}

/* Partial overwriting: a dark pane in front of a bright wall is combined with
 * it. A bright pane in front of a dark one replaces it by Newell's rule, and is
 * combined with it by the linear one. */
static void check_transparency(struct tap *tap, const char *name,
                               enum hsr_mix rule) {
  static const float bright[3] = {0.75f, 0.5f, 1}, dark[3] = {0.25f, 0, 0.125f};
  static uint32_t opaque[M * N];
  struct hsr_scene *scene = hsr_scene_new("panes");
  struct hsr_world world;
  struct hsr_view view;
  add_square(scene, -15, 0, 0, 10, bright);
  add_square(scene, 15, 0, 0, 10, dark);
  add_square(scene, -15, 0, 10, 5, dark)->opacity = 0.25f;
  add_square(scene, 15, 0, 10, 5, bright)->opacity = 0.25f;
  look_down_z(scene, &world, &view);
  const struct hsr_algorithm *a = hsr_algorithm_find(name)->plain;
  struct hsr_choice choice = choose_also(a, HSR_TRANSPARENT);
  choice.form.values.option[0] = rule;
  struct hsr_answer answer;
  uint16_t wanted[5][3], own[4][3];
  for (uint32_t f = 0; f < 4; f++) {
    hsr_filter_colour(&world, &view, f, own[f]);
    memcpy(wanted[f], own[f], sizeof own[f]);
  }
  hsr_filter_colour(&world, &view, HSR_BACKGROUND, wanted[4]);
  mix(own[2], own[0], 16384, wanted[2]);
  if (rule == HSR_MIX_LINEAR)
    mix(own[3], own[1], 16384, wanted[3]);
  draw_chosen(a, &choice, &world, &view, &answer, NULL);
  draw_plain("oracle", &world, &view, opaque);
  long wrong = 0, n[5] = {0};
  const uint16_t *rgb = hsr_answer_colours_of(&answer);
  for (int k = 0; k < M * N; k++) {
    int face = opaque[k] == HSR_BACKGROUND ? 4 : (int)opaque[k];
    wrong += memcmp(rgb + 3 * k, wanted[face], sizeof wanted[face]) != 0;
    n[face]++;
  }
  ok(tap, !wrong && n[0] && n[1] && n[2] && n[3] && n[4],
     "%s: transparent faces overwrite in part, by rule %d (%ld wrong)", name,
     (int)rule, wrong);
  hsr_answer_free(&answer);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
}

int main(void) {
  struct tap tap = plan(26);
  check_sorted(&tap);
  check_division(&tap);
  check_coherence(&tap, "harbor:500");
  check_coherence(&tap, "cyclic-overlap");
  check_coherence(&tap, "penetration");
  check_coherence(&tap, "house");
  check_transparency(&tap, "newell", HSR_MIX_NEWELL);
  check_transparency(&tap, "newell", HSR_MIX_LINEAR);
  check_transparency(&tap, "newell-frame-buffer", HSR_MIX_NEWELL);
  check_transparency(&tap, "newell-frame-buffer", HSR_MIX_LINEAR);
  return finish(&tap);
}
