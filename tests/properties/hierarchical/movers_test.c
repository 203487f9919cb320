/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Objects that move between frames: hzbuffer and clark are prepared once, and
 * must draw the same as the z-buffer, for which the scene is laid out anew in
 * every frame. Carts drive through the office; some frames move them out of the
 * building, or back in time. Greene's thesis, 3.4. */
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include "algorithms/variant.h"

#include <stdlib.h>
#include <string.h>

enum { M = 120, N = 90, FRAMES = 6 };

/* The time in each frame: it goes forth, far ahead, and back. */
static const int moment[FRAMES] = {0, 1, 2, 500, 501, 1};

static const char *const variants[] = {"clark",
                                       "hzbuffer",
                                       "hzbuffer:movers=lazy",
                                       "hzbuffer:movers=behind",
                                       "hzbuffer:cubes=sides:completed=on",
                                       "hzbuffer:volumes=tight:cubes=whole",
                                       "hzbuffer:coherence=list",
                                       "hzbuffer:coherence=passes:movers=lazy",
                                       "hzbuffer:octree=off"};
enum { VARIANTS = sizeof variants / sizeof *variants };

static void stop(const char *text) {
  printf("Bail out! %s\n", text);
  exit(99);
}

static struct hsr_scene *open_scene(int per_cent, int frame) {
  char name[40];
  struct hsr_scene *scene;
  struct hsr_error err = {.text = "out of memory"};
  snprintf(name, sizeof name, "traffic:%d:%d", per_cent, frame);
  if (hsr_scene_open(name, NULL, &scene, &err))
    stop(err.text);
  return scene;
}

/* Moves the instances to their places in a frame; in some frames the first cart
 * is far off. */
static void move_to(struct hsr_scene *scene, int per_cent, int frame) {
  struct hsr_scene *then = open_scene(per_cent, moment[frame]);
  memcpy(scene->instances, then->instances,
         scene->n_instances * sizeof *scene->instances);
  hsr_scene_delete(then);
  for (uint32_t i = 0; i < scene->n_instances && frame % 3 == 1; i++)
    if (scene->objects[scene->instances[i].object].moves) {
      scene->instances[i].m[3] = -40;
      break;
    }
}

struct ready {
  struct hsr_variant variant;
  struct hsr_setup setup;
  struct hsr_arena scratch;
  struct hsr_tally tally;
  long wrong;
};

static void draw(struct ready *r, const struct hsr_view *view,
                 const uint32_t *right) {
  static uint32_t ids[M * N];
  struct hsr_error err = {.text = "out of memory"};
  hsr_arena_reset(&r->scratch);
  struct hsr_job job = {.view = view,
                        .scratch = &r->scratch,
                        .tally = &r->tally,
                        .ids = ids,
                        .ids_stride = M};
  memset(ids, 0xfe, sizeof ids);
  if (hsr_setup_render(&r->setup, &job, &err))
    stop(err.text);
  r->wrong += count_differences(view, ids, right);
}

static long carts_in(const struct hsr_world *world, const uint32_t *ids) {
  long n = 0;
  for (int k = 0; k < M * N; k++)
    n += ids[k] != HSR_BACKGROUND &&
         world->outline.scene->objects[world->mesh.object[ids[k]]].moves;
  return n;
}

static void check(struct tap *tap, int per_cent, uint32_t of) {
  static struct ready ready[VARIANTS];
  static uint32_t right[M * N];
  const struct hsr_algorithm *zbuffer = hsr_algorithm_find("zbuffer")->plain;
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_scene *scene = open_scene(per_cent, moment[0]);
  struct hsr_world outline;
  struct hsr_view view;
  long carts = 0;
  if (hsr_world_outline(&outline, scene, &err) ||
      hsr_view_init(&view, &scene->views[of], M, N, &err))
    stop(err.text);
  for (int k = 0; k < VARIANTS; k++) {
    struct ready *r = &ready[k];
    *r = (struct ready){.wrong = 0};
    if (hsr_variant_parse(variants[k], &r->variant, &err) ||
        hsr_setup_init(&r->setup, r->variant.listed->counting,
                       &r->variant.choice, &outline, &err))
      stop(err.text);
  }
  for (int frame = 0; frame < FRAMES; frame++) {
    struct hsr_world world;
    move_to(scene, per_cent, frame);
    if (hsr_world_init(&world, scene, &err))
      stop(err.text);
    draw_ids(zbuffer, &world, &view, right, NULL);
    carts += carts_in(&world, right);
    for (int k = 0; k < VARIANTS; k++)
      draw(&ready[k], &view, right);
    hsr_world_free(&world);
  }
  ok(tap, carts > 0, "traffic:%d, view %u: carts cover %ld samples", per_cent,
     of + 1, carts);
  for (int k = 0; k < VARIANTS; k++) {
    ok(tap, !ready[k].wrong, "%s: %ld samples differ in %d frames", variants[k],
       ready[k].wrong, FRAMES);
    hsr_setup_free(&ready[k].setup);
    hsr_arena_free(&ready[k].scratch);
  }
  hsr_world_free(&outline);
  hsr_scene_delete(scene);
}

int main(void) {
  struct tap tap = plan(2 * (1 + VARIANTS));
  check(&tap, 1, 0);
  check(&tap, 20, 60);
  return finish(&tap);
}
