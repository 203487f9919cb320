/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every algorithm that draws transparent faces against the judge, to the last
 * bit, by both rules: on scenes of small integer coordinates and opacities from
 * 0 to 1, with cameras that are aligned with them, of which half are parallel;
 * and on the scenes that break naive programs, with opacities. And the judge
 * itself against what the test folds: stacks of sheets, and scenes that are all
 * opaque or all invisible.
 *
 * usage: glass_test [SCENES [SEED]]      standard: 2000 scenes, seed 1 */
#include "bench/modules/modules.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"
#include "common/answers/filter.h"
#include "common/answers/kinds/transparent.h"

#include <stdlib.h>
#include <string.h>

enum { LARGEST = 64, PARTS = 20 };

/* By one build of an algorithm. */
static long check_build(const struct hsr_algorithm *a, enum hsr_mix rule,
                        const char *name, const struct hsr_world *world,
                        const struct hsr_view *view,
                        const struct hsr_answer *wanted) {
  struct hsr_choice choice = choose_also(a, HSR_TRANSPARENT);
  choice.form.values.option[0] = rule;
  struct hsr_answer got;
  char first[200];
  long differing = 0;
  if (draw_chosen(a, &choice, world, view, &got, NULL))
    differing = compare_answers(view, &got, wanted, first, sizeof first);
  if (differing)
    printf("# %s, %d x %d, %s, rule %d: %ld differ, %s\n", name, view->m,
           view->n, a->name, (int)rule, differing, first);
  hsr_answer_free(&got);
  return differing;
}

static void choose_view(uint64_t *seed, const struct hsr_scene *scene,
                        struct hsr_view *view) {
  struct hsr_camera camera =
      scene->views[draw_integer(seed, 0, scene->n_views - 1)];
  int m = (int)draw_integer(seed, 16, LARGEST);
  int n = (int)draw_integer(seed, 16, LARGEST);
  draw_parallel(seed, &camera, n);
  must_view(view, &camera, m, n);
  draw_part(seed, view);
}

/* How many samples of a picture of the scene differ, by all who draw it. */
static long check_scene(struct hsr_scene *scene, const char *name,
                        uint64_t *seed, long *samples) {
  struct hsr_world world;
  struct hsr_view view;
  must_world(&world, scene);
  choose_view(seed, scene, &view);
  enum hsr_mix rule = (enum hsr_mix)draw_integer(seed, 0, 1);
  const struct hsr_algorithm *judge =
      hsr_algorithm_find("transparent-oracle")->plain;
  struct hsr_choice choice = hsr_choice_standard(judge);
  choice.form.values.option[0] = rule;
  struct hsr_answer wanted;
  draw_chosen(judge, &choice, &world, &view, &wanted, NULL);
  long differing = 0;
  for (const struct hsr_listed *l = hsr_algorithms(); l->plain; l++)
    if (hsr_makes_also(l->plain, HSR_TRANSPARENT)) {
      differing += check_build(l->plain, rule, name, &world, &view, &wanted);
      differing += check_build(l->counting, rule, name, &world, &view, &wanted);
    }
  *samples += (long)view.m * view.n;
  hsr_answer_free(&wanted);
  hsr_world_free(&world);
  return differing;
}

static long check_lattice(uint64_t *seed, long *samples) {
  char name[64];
  snprintf(name, sizeof name, "panes:%d:%d", (int)draw_integer(seed, 3, 40),
           (int)draw_integer(seed, 1, 1000000000));
  struct hsr_scene *scene = must_open(name);
  long differing = check_scene(scene, name, seed, samples);
  hsr_scene_delete(scene);
  return differing;
}

/* Each face gets an opacity of its own. */
static void draw_opacities(struct hsr_object *object, uint64_t *seed) {
  for (uint32_t f = 0; f < object->n_faces; f++)
    if (hsr_object_set_opacity(object, f, (float)draw_integer(seed, 0, 4) / 4))
      abort();
}

/* The objects of scenes that break naive programs become transparent. */
static void check_failures(struct tap *tap, uint64_t *seed, long *samples) {
  enum { TIMES = 12 };
  for (const struct hsr_builtin *b = hsr_builtins; b->name; b++) {
    long differing = 0;
    if (!b->failure_case)
      continue;
    struct hsr_scene *scene = must_open(b->name);
    for (int k = 0; k < TIMES; k++) {
      for (uint32_t o = 0; o < scene->n_objects; o++)
        if (k < TIMES / 2)
          scene->objects[o].opacity = (float)draw_integer(seed, 0, 4) / 4;
        else
          draw_opacities(&scene->objects[o], seed);
      differing += check_scene(scene, b->name, seed, samples);
    }
    ok(tap, differing == 0, "%s, of glass: %ld differences", b->name,
       differing);
    hsr_scene_delete(scene);
  }
}

/* Triangles alone, of which the z-buffer tiles the opaque ones in floats. */
static struct hsr_scene *draw_triangles(uint64_t *seed) {
  struct hsr_scene *scene = hsr_scene_new("triangles");
  for (int o = 0; o < 3; o++) {
    struct hsr_object *object = hsr_scene_object(scene, "some");
    object->opacity = 1 - 0.25f * (float)o;
    for (uint32_t f = 0; f < 12; f++) {
      int64_t x = draw_integer(seed, -40, 30), y = draw_integer(seed, -40, 30),
              z = draw_integer(seed, -40, 40);
      const int64_t at[3][3] = {
          {x, y, z},
          {x + draw_integer(seed, 5, 20), y, z + draw_integer(seed, -9, 9)},
          {x, y + draw_integer(seed, 5, 20), z + draw_integer(seed, -9, 9)}};
      for (int k = 0; k < 3; k++)
        hsr_object_vertex(object, (double)at[k][0], (double)at[k][1],
                          (double)at[k][2], NULL);
      hsr_object_face(object, (const uint32_t[]){3 * f, 3 * f + 1, 3 * f + 2},
                      3, NULL);
    }
  }
  must_finish(scene);
  return scene;
}

static void check_triangles(struct tap *tap, uint64_t *seed, long *samples) {
  enum { TIMES = 30 };
  long differing = 0;
  for (int k = 0; k < TIMES; k++) {
    struct hsr_scene *scene = draw_triangles(seed);
    differing += check_scene(scene, "triangles", seed, samples);
    hsr_scene_delete(scene);
  }
  ok(tap, differing == 0, "%d scenes of triangles: %ld differences", (int)TIMES,
     differing);
}

/* --- The judge ------------------------------------------------------------ */

static void set_opacity(struct hsr_scene *scene, float opacity) {
  for (uint32_t o = 0; o < scene->n_objects; o++)
    scene->objects[o].opacity = opacity;
}

/* What the judge says of a scene. */
static const uint16_t *judge(const struct hsr_world *world,
                             const struct hsr_view *view,
                             struct hsr_answer *answer) {
  const struct hsr_algorithm *a =
      hsr_algorithm_find("transparent-oracle")->plain;
  draw_answer(a, world, view, answer, NULL);
  return hsr_answer_colours_of(answer);
}

/* Where all faces are opaque, a sample has the colour of the visible face;
 * where all are of opacity 0, that of the background. */
static void check_extremes(struct tap *tap, const char *name) {
  struct both_worlds worlds;
  struct hsr_view view;
  static uint32_t ids[LARGEST * LARGEST];
  struct hsr_answer opaque, invisible, instanced;
  open_worlds(&worlds, name);
  must_view(&view, &worlds.scene->views[0], LARGEST, LARGEST);
  set_opacity(worlds.scene, 1);
  draw_plain("oracle", &worlds.world, &view, ids);
  const uint16_t *solid = judge(&worlds.world, &view, &opaque);
  const uint16_t *same = judge(&worlds.roster, &view, &instanced);
  set_opacity(worlds.scene, 0);
  const uint16_t *empty = judge(&worlds.world, &view, &invisible);
  uint16_t background[3];
  hsr_filter_colour(&worlds.world, &view, HSR_BACKGROUND, background);
  long wrong = 0, seen = 0, other = 0, unlike = 0;
  for (int k = 0; k < LARGEST * LARGEST; k++) {
    uint16_t own[3];
    hsr_filter_colour(&worlds.world, &view, ids[k], own);
    wrong += memcmp(solid + 3 * k, own, sizeof own) != 0;
    unlike += memcmp(solid + 3 * k, same + 3 * k, sizeof own) != 0;
    other += memcmp(empty + 3 * k, background, sizeof own) != 0;
    seen += ids[k] != HSR_BACKGROUND;
  }
  ok(tap, seen && !wrong, "%s: opaque faces have their own colours", name);
  ok(tap, !unlike, "%s: and so have they by instances", name);
  ok(tap, !other, "%s: faces of opacity 0 leave the background", name);
  hsr_answer_free(&opaque);
  hsr_answer_free(&instanced);
  hsr_answer_free(&invisible);
  close_worlds(&worlds);
}

/* 60 sheets over one another, of which number 20 is opaque: the fold goes
 * through 40 of them, each rounded. `nearest`: the last is the nearest. */
static void check_stack(struct tap *tap, bool nearest) {
  enum { SHEETS = 60, OPAQUE = 20 };
  struct hsr_scene *scene = hsr_scene_new("stack");
  struct hsr_camera camera = {
      .eye = {0, 0, 100}, .at = {0, 0, 0}, .up = {0, 1, 0}, .fov = 10};
  struct hsr_world world;
  struct hsr_view view;
  struct hsr_error err;
  for (int s = 0; s < SHEETS; s++) {
    struct hsr_object *sheet = hsr_scene_object(scene, "sheet");
    float rgb[3] = {(float)(s % 7) / 7, (float)(s % 5) / 5, (float)(s % 3) / 3};
    uint32_t v[3];
    double z = nearest ? s : -s;
    hsr_object_vertex(sheet, -99, -99, z, &v[0]);
    hsr_object_vertex(sheet, 99, -99, z, &v[1]);
    hsr_object_vertex(sheet, 0, 99, z, &v[2]);
    hsr_object_face(sheet, v, 3, rgb);
    sheet->opacity = s == OPAQUE ? 1 : (float)(s % 11) / 13;
  }
  if (hsr_scene_view(scene, &camera))
    bail("stack: %s", err.text);
  must_finish(scene);
  must_world(&world, scene);
  must_view(&view, &camera, 16, 16);
  struct hsr_answer answer;
  const uint16_t *got = judge(&world, &view, &answer);
  uint16_t colour[3];
  hsr_filter_colour(&world, &view, OPAQUE, colour);
  uint64_t B[3] = {colour[0], colour[1], colour[2]};
  for (int s = OPAQUE; nearest ? ++s < SHEETS : --s >= 0;) {
    uint64_t A = 0;
    while ((double)A + 0.5 <= 65535 * (double)scene->objects[s].opacity)
      A++;
    hsr_filter_colour(&world, &view, (uint32_t)s, colour);
    for (int c = 0; c < 3; c++)
      B[c] = (A * colour[c] + (65535 - A) * B[c] + 32767) / 65535;
  }
  long wrong = 0;
  for (int k = 0; k < 16 * 16; k++)
    for (int c = 0; c < 3; c++)
      wrong += got[3 * k + c] != B[c];
  ok(tap, !wrong, "the judge folds a stack, %s first (%ld wrong)",
     nearest ? "the last" : "the first", wrong);
  hsr_answer_free(&answer);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
}

int main(int argc, char **argv) {
  long n = argc > 1 ? atol(argv[1]) : 2000, samples = 0;
  uint64_t seed = argc > 2 ? strtoull(argv[2], NULL, 10) : 1;
  int n_failures = 0;
  for (const struct hsr_builtin *b = hsr_builtins; b->name; b++)
    n_failures += b->failure_case;
  struct tap tap = plan(PARTS + 9 + n_failures);
  check_stack(&tap, true);
  check_stack(&tap, false);
  check_extremes(&tap, "house");
  check_extremes(&tap, "lattice:60:2");
  check_failures(&tap, &seed, &samples);
  uint64_t other = 1;
  check_triangles(&tap, &other, &samples);
  for (long part = 0; part < PARTS; part++) {
    long differences = 0, first = n * part / PARTS,
         end = n * (part + 1) / PARTS;
    for (long k = first; k < end; k++)
      differences += check_lattice(&seed, &samples);
    ok(&tap, differences == 0, "scenes %ld to %ld: %ld differences", first + 1,
       end, differences);
  }
  printf("# %ld samples of %ld scenes\n", samples, n);
  return finish(&tap);
}
