/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The octree of a whole scene, divided when its cubes are found to be visible
 * (Greene's thesis, 3.4).
 *
 * Right       The picture is the same, and so is every count but those of
 *             dividing.
 * Visible     Cubes that are divided are visible ones; each is divided once, so
 *             the second frame of a view divides none.
 * Less        In scenes where much is hidden, faces are handed down far less
 *             often than to make the whole octree.
 * Linear      But all that is in a cube is handed down, or kept, when the cube
 *             is divided: all of an object that is seen at all.
 *
 * usage: lazy_octree_test [SCENE...]    prints the figures of other scenes */
#include "algorithms/engines/cubes/cubes.h"
#include "bench/modules/variant.h"
#include "tests/properties/hierarchical/claims.h"
#include "tests/tap.h"

#include <stdlib.h>
#include <string.h>

enum { M = 160, N = 120 };

static bool is_of_dividing(const char *name) {
  return !strcmp(name, "cubes divided") || !strcmp(name, "faces down") ||
         !strcmp(name, "instances down");
}

/* Whether all counts but those of dividing are the same. */
static bool are_alike(const struct claim_counts *a,
                      const struct claim_counts *b) {
  bool alike = true;
  for (int k = 0; a->algorithm->counters[k].name; k++)
    alike &= is_of_dividing(a->algorithm->counters[k].name) ||
             a->tally.count[k] == b->tally.count[k];
  return alike;
}

struct down {
  uint64_t cubes, faces, instances;
};

/* What it takes to divide all cubes. */
static struct down divide_all(const struct hsr_world *world) {
  const struct hsr_octree_rule rule = {.small = 0.1, .most = 20, .least = 20};
  struct hsr_error err = {.text = "out of memory"};
  enum hsr_status status = HSR_OK;
  struct hsr_cubes cubes;
  struct down down = {0};
  if (hsr_cubes_init_lazily(&cubes, world, &rule, &err))
    abort();
  for (uint32_t o = 0; o < world->roster.scene->n_objects; o++) {
    const struct hsr_cubes_object *object = &cubes.object[o];
    for (uint32_t k = 0; k < object->octree.n_nodes; k++)
      down.cubes += hsr_cubes_divide(&cubes, o, k, &status);
    for (uint32_t k = 1; k < object->octree.n_nodes; k++)
      down.faces += hsr_lazy_node(object->lazy, k)->n;
  }
  for (uint32_t k = 0; k < cubes.octree.n_nodes; k++)
    down.cubes += hsr_cubes_divide_instances(&cubes, k, &status);
  for (uint32_t k = 1; k < cubes.octree.n_nodes; k++)
    down.instances += hsr_lazy_node(cubes.lazy, k)->n;
  if (status)
    abort();
  hsr_cubes_free(&cubes);
  return down;
}

static struct down down_in(const struct claim_counts *counts) {
  return (struct down){claim_value(counts, "cubes divided"),
                       claim_value(counts, "faces down"),
                       claim_value(counts, "instances down")};
}

/* Draws a view twice with one prepared object: what was divided the second
 * time. */
static uint64_t divided_again(const struct claim_scene *scene,
                              const uint32_t *right, long *wrong) {
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  struct hsr_variant variant;
  struct hsr_setup setup;
  struct hsr_tally tally;
  static uint32_t ids[M * N];
  if (hsr_variant_parse("hzbuffer:octree=lazy", &variant, &err))
    abort();
  must_setup(&setup, variant.listed->counting, &variant.choice,
             &scene->worlds.roster);
  for (int k = 0; k < 2; k++) {
    struct hsr_answer answer = hsr_answer_of_ids(ids, M, N);
    struct hsr_job job = {.view = &scene->view,
                          .scratch = &scratch,
                          .tally = &tally,
                          .answer = &answer};
    tally = (struct hsr_tally){.work = NULL};
    memset(ids, 0xfe, sizeof ids);
    hsr_arena_reset(&scratch);
    if (hsr_setup_render(&setup, &job, &err))
      abort();
    *wrong += count_differences(&scene->view, ids, right);
  }
  int divided = counter_of(setup.algorithm, "cubes divided");
  uint64_t again = tally.count[divided];
  hsr_setup_free(&setup);
  hsr_arena_free(&scratch);
  return again;
}

/* The office of 3 x 3 x 3 modules as one object, whose faces share nothing. */
static void open_flat(struct claim_scene *scene) {
  struct both_worlds office;
  open_worlds(&office, "office:3");
  const struct hsr_world *world = &office.world;
  struct hsr_scene *flat = hsr_scene_new("flat office");
  struct hsr_object *object = flat ? hsr_scene_object(flat, "office") : NULL;
  bool good = object;
  for (size_t v = 0; v < world->mesh.n_vertices && good; v++)
    good = !hsr_object_vertex(object, world->mesh.x[v], world->mesh.y[v],
                              world->mesh.z[v], NULL);
  for (uint32_t f = 0; f < world->n_faces && good; f++)
    good =
        !hsr_object_face(object, world->mesh.vertex + world->mesh.start[f],
                         world->mesh.start[f + 1] - world->mesh.start[f], NULL);
  if (!good || hsr_scene_view(flat, &office.scene->views[0]))
    abort();
  must_finish(flat);
  must_world(&scene->worlds.world, flat);
  must_roster(&scene->worlds.roster, flat);
  must_view(&scene->view, &flat->views[0], M, N);
  scene->worlds.scene = flat;
  close_worlds(&office);
}

/* `part` of the handing down of faces is enough. NULL: the flat office. */
static void check(struct tap *tap, const char *name, double part) {
  struct claim_scene scene;
  struct claim_counts whole, lazy;
  if (name)
    claim_open(&scene, name, 0, M, N);
  else
    open_flat(&scene);
  name = scene.worlds.scene->name;
  claim_draw(&whole, &scene, "hzbuffer", NULL, NULL);
  claim_draw(&lazy, &scene, "hzbuffer:octree=lazy", NULL, NULL);
  long wrong = count_differences(&scene.view, lazy.ids, whole.ids);
  struct down all = divide_all(&scene.worlds.roster), some = down_in(&lazy);
  uint64_t again = divided_again(&scene, whole.ids, &wrong);
  ok(tap, !wrong && are_alike(&whole, &lazy),
     "%s: the same picture (%ld) and the same counts", name, wrong);
  ok(tap,
     some.cubes && some.cubes <= claim_value(&lazy, "cubes visible") && !again,
     "%s: divides %lu cubes of %lu visible ones, and %lu in the next frame",
     name, (unsigned long)some.cubes,
     (unsigned long)claim_value(&lazy, "cubes visible"), (unsigned long)again);
  ok(tap,
     some.cubes < all.cubes && some.faces > 0 &&
         (double)some.faces <= part * (double)all.faces,
     "%s: %lu cubes of %lu, faces handed down %lu times of %lu, instances %lu "
     "of %lu",
     name, (unsigned long)some.cubes, (unsigned long)all.cubes,
     (unsigned long)some.faces, (unsigned long)all.faces,
     (unsigned long)some.instances, (unsigned long)all.instances);
  free(whole.ids);
  free(lazy.ids);
  claim_close(&scene);
}

/* With lists of visible cubes, which are made of a tree that grows. */
static void check_walk(struct tap *tap, const char *way) {
  static uint32_t right[M * N], ids[M * N];
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  struct hsr_variant variant;
  struct hsr_setup setup;
  struct both_worlds worlds;
  long wrong = 0, views = 0;
  open_worlds(&worlds, "office:2");
  if (hsr_variant_parse(way, &variant, &err))
    abort();
  must_setup(&setup, variant.listed->plain, &variant.choice, &worlds.roster);
  for (uint32_t v = 0; v < 40; v += 2, views++) {
    struct hsr_view view;
    struct hsr_tally tally = {.work = NULL};
    struct hsr_answer answer = hsr_answer_of_ids(ids, M, N);
    struct hsr_job job = {
        .view = &view, .scratch = &scratch, .tally = &tally, .answer = &answer};
    must_view(&view, &worlds.scene->views[v], M, N);
    draw_plain("clark", &worlds.roster, &view, right);
    memset(ids, 0xfe, sizeof ids);
    hsr_arena_reset(&scratch);
    if (hsr_setup_render(&setup, &job, &err))
      abort();
    wrong += count_differences(&view, ids, right);
  }
  ok(tap, !wrong, "%s: %ld views of a walk, %ld samples differ", way, views,
     wrong);
  hsr_setup_free(&setup);
  hsr_arena_free(&scratch);
  close_worlds(&worlds);
}

int main(int argc, char **argv) {
  struct tap tap = plan(argc > 1 ? 3 * (argc - 1) : 14);
  for (int k = 1; k < argc; k++)
    check(&tap, argv[k], 1);
  if (argc == 1) {
    check(&tap, "office:1", 0.75);
    check(&tap, "office:5", 1);
    check(&tap, "terrain:128:100", 0.7);
    check(&tap, NULL, 0.45);
    check_walk(&tap, "hzbuffer:octree=lazy:coherence=list:least=4");
    check_walk(&tap, "hzbuffer:octree=lazy:coherence=passes");
  }
  return finish(&tap);
}
