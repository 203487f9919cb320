/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every algorithm that draws shadows against the judge: on scenes of small
 * integer coordinates, with cameras that are aligned with them and lights that
 * lie in planes, on edges and on vertices; and on the scenes that break naive
 * programs. And the judge itself: a light at the eye leaves nothing dark, and
 * the shadow of a sheet lies where similar triangles put it.
 *
 * usage: shadow_test [SCENES [SEED]]      standard: 2000 scenes, seed 1; each of
 *        the latter is drawn once, and once more for each 250 of the others */
#include "bench/modules/modules.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"
#include "common/answers/kinds/shadowed.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LARGEST = 48, PARTS = 20 };

static const struct hsr_algorithm *judge(void) {
  return hsr_algorithm_find("shadow-oracle")->plain;
}

/* --- The algorithms ------------------------------------------------------- */

/* By one build of an algorithm. */
static long check_build(const struct hsr_algorithm *a, const char *name,
                        const struct hsr_world *world,
                        const struct hsr_view *view,
                        const struct hsr_answer *wanted) {
  struct hsr_choice choice = choose_also(a, HSR_SHADOWED);
  struct hsr_answer got;
  char first[200];
  long differing = 0;
  if (draw_chosen(a, &choice, world, view, &got, NULL))
    differing = compare_answers(view, &got, wanted, first, sizeof first);
  if (differing)
    printf("# %s, light %g %g %g %g, %d x %d, %s: %ld differ, %s\n", name,
           view->light[0], view->light[1], view->light[2], view->light[3],
           view->m, view->n, a->name, differing, first);
  hsr_answer_free(&got);
  return differing;
}

/* The camera's own light; a point of the lattice or of its halves; a vertex of
 * the scene; the eye; or a sun, which may shine along an axis. */
static void choose_light(uint64_t *seed, const struct hsr_world *world,
                         struct hsr_camera *camera) {
  uint32_t v = (uint32_t)draw_integer(seed, 0, world->mesh.n_vertices - 1);
  const double vertex[3] = {world->mesh.x[v], world->mesh.y[v],
                            world->mesh.z[v]};
  int64_t kind = draw_integer(seed, 0, 7);
  bool sun = kind >= 5;
  if (kind == 0)
    return;
  for (int k = 0; k < 3; k++)
    camera->light[k] = kind == 1   ? vertex[k]
                       : kind == 2 ? camera->eye[k]
                       : kind == 3 ? (double)draw_integer(seed, -13, 13) / 2
                       : sun       ? (double)draw_integer(seed, -2, 2)
                                   : (double)draw_integer(seed, -8, 8);
  camera->light[3] = sun ? 0 : 1;
}

static void choose_view(uint64_t *seed, const struct hsr_world *world,
                        struct hsr_view *view) {
  const struct hsr_scene *scene = world->roster.scene;
  struct hsr_camera camera =
      scene->views[draw_integer(seed, 0, scene->n_views - 1)];
  int m = (int)draw_integer(seed, 12, LARGEST);
  int n = (int)draw_integer(seed, 12, LARGEST);
  draw_parallel(seed, &camera, n);
  choose_light(seed, world, &camera);
  must_view(view, &camera, m, n);
  draw_part(seed, view);
}

/* How many samples there were, and what the judge said of them. */
struct sums {
  long samples, lit, dark;
};

static void add_up(struct sums *sums, const struct hsr_view *view,
                   const struct hsr_answer *answer) {
  const struct hsr_shadowed *body = hsr_answer_shadowed_of(answer);
  const struct hsr_window *w = &view->window;
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++) {
      size_t k = (size_t)j * (size_t)view->m + (size_t)i;
      sums->samples++;
      sums->lit += body->lit[k];
      sums->dark += body->ids[k] != HSR_BACKGROUND && !body->lit[k];
    }
}

/* How many samples of a picture of the scene differ, by all who draw it. */
static long check_scene(struct hsr_scene *scene, const char *name,
                        uint64_t *seed, struct sums *sums) {
  struct hsr_world world;
  struct hsr_view view;
  struct hsr_answer wanted;
  long differing = 0;
  must_world(&world, scene);
  choose_view(seed, &world, &view);
  draw_answer(judge(), &world, &view, &wanted, NULL);
  for (const struct hsr_listed *l = hsr_algorithms(); l->plain; l++)
    if (hsr_makes_also(l->plain, HSR_SHADOWED)) {
      differing += check_build(l->plain, name, &world, &view, &wanted);
      differing += check_build(l->counting, name, &world, &view, &wanted);
    }
  add_up(sums, &view, &wanted);
  hsr_answer_free(&wanted);
  hsr_world_free(&world);
  return differing;
}

/* One scene of eight is of triangles. */
static long check_random(uint64_t *seed, struct sums *sums) {
  char name[64];
  snprintf(name, sizeof name, "%s:%d:%d",
           draw_integer(seed, 0, 7) ? "lattice" : "soup",
           (int)draw_integer(seed, 3, 30),
           (int)draw_integer(seed, 1, 1000000000));
  struct hsr_scene *scene = must_open(name);
  long differing = check_scene(scene, name, seed, sums);
  hsr_scene_delete(scene);
  return differing;
}

static void check_failures(struct tap *tap, uint64_t *seed, long times) {
  for (const struct hsr_builtin *b = hsr_builtins; b->name; b++) {
    struct sums sums = {0};
    long differing = 0;
    if (!b->failure_case)
      continue;
    struct hsr_scene *scene = must_open(b->name);
    for (int k = 0; k < times; k++)
      differing += check_scene(scene, b->name, seed, &sums);
    ok(tap, differing == 0, "%s: %ld differences, %ld lit, %ld dark", b->name,
       differing, sums.lit, sums.dark);
    hsr_scene_delete(scene);
  }
}

/* --- The judge ------------------------------------------------------------ */

/* A sample whose light is wrong is a difference, and so is one whose face is. */
static void check_compare(struct tap *tap, const struct hsr_world *world,
                          const struct hsr_view *view,
                          const struct hsr_answer *answer) {
  char first[200];
  struct hsr_answer other;
  draw_answer(judge(), world, view, &other, NULL);
  struct hsr_shadowed *body = hsr_answer_shadowed_of(&other);
  bool good = !compare_answers(view, &other, answer, first, sizeof first);
  body->lit[7] ^= true;
  good &= compare_answers(view, &other, answer, first, sizeof first) == 1;
  body->ids[9] ^= 1;
  good &= compare_answers(view, &other, answer, first, sizeof first) == 2;
  ok(tap, good, "the light and the face of a sample are compared: %s", first);
  hsr_answer_free(&other);
}

/* Nothing lies between the eye and what it sees. So if the light is there, all
 * that is visible is lit. */
static void check_light_at_eye(struct tap *tap, const char *name) {
  struct both_worlds worlds;
  struct hsr_view view;
  struct hsr_answer answer;
  struct sums sums = {0};
  open_worlds(&worlds, name);
  struct hsr_camera camera = worlds.scene->views[0];
  memcpy(camera.light, camera.eye, sizeof camera.eye);
  camera.light[3] = 1;
  camera.near = 0;
  must_view(&view, &camera, LARGEST, LARGEST);
  draw_answer(judge(), &worlds.world, &view, &answer, NULL);
  add_up(&sums, &view, &answer);
  ok(tap, sums.lit && !sums.dark,
     "%s: all is lit by a light at the eye (%ld dark)", name, sums.dark);
  check_compare(tap, &worlds.world, &view, &answer);
  hsr_answer_free(&answer);
  close_worlds(&worlds);
}

static void add_square(struct hsr_object *object, double low, double high,
                       double y) {
  uint32_t v[4];
  for (int k = 0; k < 4; k++)
    hsr_object_vertex(object, k == 1 || k == 2 ? high : low, y,
                      k > 1 ? low : high, &v[k]);
  hsr_object_face(object, v, 4, NULL);
}

/* Where the eye's ray of a sample meets the plane y = 0: x and z. */
static void floor_point(const struct hsr_view *view, int i, int j,
                        double point[2]) {
  double d[3];
  for (int k = 0; k < 3; k++)
    d[k] = view->ray[0][k] + hsr_sample_x(view, i) * view->ray[1][k] +
           hsr_sample_y(view, j) * view->ray[2][k];
  double t = -view->E[1] / d[1];
  point[0] = view->E[0] + t * d[0];
  point[1] = view->E[2] + t * d[2];
}

/* A sheet from -1 to 1 at height 1 above a floor, which is face 0. Its shadow
 * on the floor is a square, from low to high in x and in z. */
static void check_sheet(struct tap *tap, const double light[4], double low,
                        double high) {
  struct hsr_scene *scene = hsr_scene_new("sheet");
  struct hsr_camera camera = {
      .eye = {7, 6, 4}, .at = {0, 0, 0}, .up = {0, 1, 0}, .fov = 40};
  struct hsr_world world;
  struct hsr_view view;
  struct hsr_answer answer;
  struct hsr_error err;
  add_square(hsr_scene_object(scene, "floor"), -9, 9, 0);
  add_square(hsr_scene_object(scene, "sheet"), -1, 1, 1);
  memcpy(camera.light, light, sizeof camera.light);
  if (hsr_scene_view(scene, &camera))
    bail("sheet: %s", err.text);
  must_finish(scene);
  must_world(&world, scene);
  must_view(&view, &camera, LARGEST, LARGEST);
  draw_answer(judge(), &world, &view, &answer, NULL);
  const struct hsr_shadowed *body = hsr_answer_shadowed_of(&answer);
  long wrong = 0, dark = 0, other = 0;
  for (int j = 0; j < view.n; j++)
    for (int i = 0; i < view.m; i++) {
      size_t k = (size_t)j * (size_t)view.m + (size_t)i;
      double p[2];
      if (body->ids[k] == 1) {
        other += body->lit[k];
        continue;
      }
      floor_point(&view, i, j, p);
      bool shaded = p[0] > low && p[0] < high && p[1] > low && p[1] < high;
      wrong += body->ids[k] == 0 && body->lit[k] == shaded;
      dark += body->ids[k] == 0 && shaded;
    }
  ok(tap, !wrong && dark > 20 && other > 20,
     "the shadow of a sheet: %ld wrong, %ld dark, %ld of the sheet lit", wrong,
     dark, other);
  hsr_answer_free(&answer);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
}

/* A light and a sun in the name of a scene. */
static void check_names(struct tap *tap) {
  struct both_worlds light, sun;
  open_worlds(&light, "house@light=3,9,4");
  open_worlds(&sun, "house@sun=3,9,4");
  const double *l = light.scene->views[1].light, *s = sun.scene->views[1].light;
  ok(tap, !memcmp(l, s, 3 * sizeof *l) && l[1] == 9 && l[3] == 1 && s[3] == 0,
     "a name places a light, or a sun");
  close_worlds(&light);
  close_worlds(&sun);
}

int main(int argc, char **argv) {
  long n = argc > 1 ? atol(argv[1]) : 2000;
  uint64_t seed = argc > 2 ? strtoull(argv[2], NULL, 10) : 1;
  int n_failures = 0;
  struct sums sums = {0};
  for (const struct hsr_builtin *b = hsr_builtins; b->name; b++)
    n_failures += b->failure_case;
  struct tap tap = plan(PARTS + 11 + n_failures);
  check_light_at_eye(&tap, "house");
  check_light_at_eye(&tap, "lattice:60:2");
  check_light_at_eye(&tap, "one-sided");
  check_sheet(&tap, (const double[]){0, 1, 0, 0}, -1, 1);
  check_sheet(&tap, (const double[]){1, 2, 1, 0}, -1.5, 0.5);
  check_sheet(&tap, (const double[]){0, 5, 0, 1}, -1.25, 1.25);
  check_names(&tap);
  check_failures(&tap, &seed, n / 250 + 1);
  for (long part = 0; part < PARTS; part++) {
    long differences = 0, first = n * part / PARTS,
         end = n * (part + 1) / PARTS;
    for (long k = first; k < end; k++)
      differences += check_random(&seed, &sums);
    ok(&tap, differences == 0, "scenes %ld to %ld: %ld differences", first + 1,
       end, differences);
  }
  ok(&tap, sums.lit > sums.samples / 20 && sums.dark > sums.samples / 20,
     "%ld samples of %ld scenes, %ld lit, %ld dark", sums.samples, n, sums.lit,
     sums.dark);
  return finish(&tap);
}
