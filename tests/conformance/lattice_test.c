/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every algorithm against the oracle, sample for sample, on scenes of small
 * integer coordinates. The cameras are aligned with them, so there are many
 * ties. Half of them are parallel: along an axis, isometric, dimetric.
 *
 * usage: lattice_test [SCENES [SEED [NAME...]]]
 *        standard: 600 scenes, seed 1, all algorithms and their variants */
#include "bench/modules/modules.h"
#include "common/exact/predicates.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <stdlib.h>
#include <string.h>

enum { LARGEST = 64 };

/* The names of the algorithms that are asked for. */
static char **asked;
static int n_asked;

static void count(const struct hsr_algorithm *algorithm, void *n_judged) {
  *(int *)n_judged += is_asked(algorithm, n_asked, asked);
}

struct comparison {
  const struct hsr_world *world;
  const struct hsr_view *view;
  const char *name;
  const uint32_t *wanted;
  uint32_t *got;
  long differences;
};

static void compare(const struct hsr_algorithm *algorithm, void *context) {
  struct comparison *c = context;
  if (!is_asked(algorithm, n_asked, asked))
    return;
  draw_ids(algorithm, c->world, c->view, c->got, NULL);
  long differences = count_differences(c->view, c->got, c->wanted);
  if (differences)
    printf("# %s, %d x %d, eye %g,%g,%g, forward %g,%g,%g, parallel %g: %s "
           "differs in %ld samples\n",
           c->name, c->view->m, c->view->n, c->view->E[0], c->view->E[1],
           c->view->E[2], c->view->F[0], c->view->F[1], c->view->F[2],
           c->view->camera.parallel, algorithm->name, differences);
  c->differences += differences;
}

/* The scene with every face cut into triangles from its first corner. Triangles
 * of no area are left out. Modules draw such scenes in other ways. NULL if
 * nothing is left. */
static struct hsr_scene *triangulated(const struct hsr_scene *scene) {
  struct hsr_scene *copy = hsr_scene_new(scene->name);
  struct hsr_error err;
  for (uint32_t o = 0; o < scene->n_objects; o++) {
    const struct hsr_object *from = &scene->objects[o];
    struct hsr_object *to = hsr_scene_object(copy, from->name);
    to->one_sided = from->one_sided;
    for (uint32_t v = 0; v < from->n_vertices; v++)
      hsr_object_vertex(to, from->xyz[3 * v], from->xyz[3 * v + 1],
                        from->xyz[3 * v + 2], NULL);
    for (uint32_t f = 0; f < from->n_faces; f++)
      for (uint32_t k = from->start[f] + 2; k < from->start[f + 1]; k++) {
        uint32_t corner[3] = {from->vertex[from->start[f]], from->vertex[k - 1],
                              from->vertex[k]};
        struct hsr_loop loop = {to->xyz, to->xyz + 1, to->xyz + 2,
                                3,       corner,      3};
        bool out_of_memory = false;
        if (hsr_exact_has_normal(loop, &out_of_memory))
          hsr_object_face(to, corner, 3, NULL);
      }
  }
  for (uint32_t i = 0; i < scene->n_instances; i++)
    hsr_scene_instance(copy, scene->instances[i].object, scene->instances[i].m);
  for (uint32_t v = 0; v < scene->n_views; v++)
    hsr_scene_view(copy, &scene->views[v]);
  if (hsr_scene_finish(copy, &err)) {
    hsr_scene_delete(copy);
    return NULL;
  }
  return copy;
}

/* One scene of 3 to 40 faces, all its views, at sizes drawn from the seed. */
static long check_scene(uint64_t *seed, long *samples) {
  static uint32_t wanted[LARGEST * LARGEST], got[LARGEST * LARGEST];
  char name[64];
  snprintf(name, sizeof name, "lattice:%d:%d", (int)draw_integer(seed, 3, 40),
           (int)draw_integer(seed, 1, 1000000000));
  struct hsr_error err;
  struct hsr_scene *scene;
  struct hsr_world world;
  bool opened = !hsr_scene_open(name, NULL, &scene, &err);
  if (opened && draw_integer(seed, 0, 1)) {
    struct hsr_scene *triangles = triangulated(scene);
    if (triangles) {
      hsr_scene_delete(scene);
      scene = triangles;
    }
  }
  if (!opened)
    bail("%s: %s", name, err.text);
  must_world(&world, scene);
  const struct hsr_algorithm *oracle = hsr_algorithm_find("oracle")->plain;
  long differences = 0;
  uint32_t v = (uint32_t)draw_integer(seed, 0, scene->n_views - 1);
  struct hsr_view view;
  struct hsr_camera camera = scene->views[v];
  int m = (int)draw_integer(seed, 16, LARGEST);
  int n = (int)draw_integer(seed, 16, LARGEST);
  draw_parallel(seed, &camera, n);
  must_view(&view, &camera, m, n);
  draw_part(seed, &view);
  draw_ids(oracle, &world, &view, wanted, NULL);
  struct comparison c = {&world, &view, name, wanted, got, 0};
  for_each_judged(compare, &c);
  differences += c.differences;
  *samples += (long)view.m * view.n;
  hsr_world_free(&world);
  hsr_scene_delete(scene);
  return differences;
}

int main(int argc, char **argv) {
  long n = argc > 1 ? atol(argv[1]) : 600, samples = 0;
  uint64_t seed = argc > 2 ? strtoull(argv[2], NULL, 10) : 1;
  n_asked = argc < 3 ? 0 : argc - 3;
  asked = argv + argc - n_asked;
  enum { PARTS = 20 };
  int n_judged = 0;
  for_each_judged(count, &n_judged);
  if (!n_judged) {
    printf("1..0 # SKIP none of these draws faces and must be right\n");
    return 0;
  }
  struct tap tap = plan(PARTS);
  for (long part = 0; part < PARTS; part++) {
    long differences = 0, first = n * part / PARTS,
         end = n * (part + 1) / PARTS;
    for (long k = first; k < end; k++)
      differences += check_scene(&seed, &samples);
    ok(&tap, differences == 0, "scenes %ld to %ld: %ld differences", first + 1,
       end, differences);
  }
  printf("# %ld samples of %ld scenes\n", samples, n);
  return finish(&tap);
}
