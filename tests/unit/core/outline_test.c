/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Outlines: the oracle makes the same picture from a scene's outline as from
 * its faces laid out, however the instances place the objects. Of a hundred
 * million faces it asks for a few, in little memory. */
#include "bench/modules/modules.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

enum {
  M = 32,
  N = 24,
  RANDOM_SCENES = 100,
  MOST_FACES = 30000,  /* of built-in scenes, to save time */
  MODULES = 20,        /* along a side of the large scene */
  MODULE_FACES = 15000 /* of each module, roughly */
};

/* --- A hundred million faces ---------------------------------------------- */

/* The one object of a built-in scene. */
static void copy_object(struct hsr_scene *to, const char *name) {
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_scene *from = must_open(name);
  const struct hsr_object *a = &from->objects[0];
  struct hsr_object *b = hsr_scene_object(to, name);
  enum hsr_status status = b ? HSR_OK : HSR_E_NOMEM;
  for (uint32_t v = 0; v < a->n_vertices && !status; v++)
    status =
        hsr_object_vertex(b, a->xyz[3 * (size_t)v], a->xyz[3 * (size_t)v + 1],
                          a->xyz[3 * (size_t)v + 2], NULL);
  for (uint32_t f = 0; f < a->n_faces && !status; f++)
    status = hsr_object_face(b, a->vertex + a->start[f],
                             a->start[f + 1] - a->start[f], NULL);
  if (status)
    bail("%s: %s", name, err.text);
  hsr_scene_delete(from);
}

/* A turn about the y axis, a size and a place. */
static void place(double m[12], double angle, double size, double x, double y,
                  double z) {
  double c = size * cos(angle), s = size * sin(angle);
  const double rows[12] = {c, 0, s, x, 0, size, 0, y, -s, 0, c, z};
  memcpy(m, rows, sizeof rows);
}

static struct hsr_scene *make_modules(void) {
  struct hsr_scene *scene = hsr_scene_new("modules");
  char name[32];
  snprintf(name, sizeof name, "sphere:%d", MODULE_FACES);
  copy_object(scene, name);
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < MODULES * MODULES * MODULES && !status; k++) {
    double m[12];
    place(m, k, 0.35, k % MODULES, k / MODULES % MODULES,
          k / (MODULES * MODULES));
    status = hsr_scene_instance(scene, 0, m);
  }
  struct hsr_camera within = {{9.5, 9.5, 30}, {8, 9, 0}, {0, 1, 0}, 60, 0};
  if (status || hsr_scene_view(scene, &within))
    bail("out of memory");
  must_finish(scene);
  return scene;
}

/* Asks for one sample. */
static uint32_t ask(const struct hsr_setup *oracle, struct hsr_view *view,
                    uint32_t *ids, int i, int j) {
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  struct hsr_tally tally = {.out_of_memory = false};
  struct hsr_answer answer = hsr_answer_of_ids(ids, view->m, view->n);
  struct hsr_job job = {
      .view = view, .scratch = &scratch, .tally = &tally, .answer = &answer};
  view->window = (struct hsr_window){i, j, i + 1, j + 1};
  if (hsr_setup_render(oracle, &job, NULL))
    bail("modules: %s", (struct hsr_error){.text = "the oracle failed"}.text);
  hsr_arena_free(&scratch);
  return ids[(size_t)j * (size_t)view->m + (size_t)i];
}

/* The most memory that the process ever held. */
static long peak_kb(void) {
  struct rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

static void test_large(struct tap *tap) {
  enum { SIDE = 512, SAMPLES = 20000 };
  struct hsr_scene *scene = make_modules();
  struct hsr_world world;
  struct hsr_setup oracle;
  struct hsr_view view;
  uint32_t *ids = malloc(SIDE * SIDE * sizeof *ids);
  long before_kb = peak_kb(); /* libraries, and an earlier test's */
  clock_t begin = clock();
  if (!ids)
    bail("out of memory");
  must_roster(&world, scene);
  must_view(&view, &scene->views[0], SIDE, SIDE);
  must_setup(&oracle, hsr_algorithm_find("oracle")->plain, NULL, &world);
  double ready = (double)(clock() - begin) / CLOCKS_PER_SEC;

  uint64_t seed = 1;
  int n_faces = 0, n_instances = 0;
  uint32_t last = UINT32_MAX;
  for (int k = 0; k < SAMPLES; k++) {
    uint32_t id =
        ask(&oracle, &view, ids, (int)draw_integer(&seed, 0, SIDE - 1),
            (int)draw_integer(&seed, 0, SIDE - 1));
    if (id == HSR_BACKGROUND)
      continue;
    n_faces++;
    n_instances += hsr_instance_of(&world.roster, id) != last;
    last = hsr_instance_of(&world.roster, id);
  }
  double all = (double)(clock() - begin) / CLOCKS_PER_SEC;
  ok(tap, n_faces > SAMPLES / 2 && n_instances > SAMPLES / 4 && all < 40,
     "%d samples of %u faces: %d with a face, in %.2f s and %.2f s before",
     SAMPLES, world.n_faces, n_faces, all - ready, ready);

  long more_kb = peak_kb() - before_kb;
#ifdef __SANITIZE_ADDRESS__
  more_kb = 0;
#endif
  ok(tap, more_kb < 10000, "in %ld MB", more_kb / 1000);
  hsr_setup_free(&oracle);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
  free(ids);
}

/* --- The same picture ----------------------------------------------------- */

struct found {
  long samples, faces, different;
};

/* Adds the findings on the scene's views. False if its faces cannot be laid
 * out, since an instance takes the area of one to zero. */
static bool compare(struct hsr_scene *scene, struct found *found) {
  const struct hsr_listed *oracle = hsr_algorithm_find("oracle");
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_world laid_out, outline;
  enum hsr_status status = hsr_world_init(&laid_out, scene, &err);
  if (status == HSR_E_INPUT) {
    hsr_world_free(&laid_out);
    return false;
  }
  if (status)
    bail("%s: %s", scene->name, err.text);
  must_roster(&outline, scene);
  for (uint32_t v = 0; v < scene->n_views; v++) {
    uint32_t wanted[M * N], got[M * N];
    struct hsr_view view;
    must_view(&view, &scene->views[v], M, N);
    draw_ids(oracle->plain, &laid_out, &view, wanted, NULL);
    draw_ids(v % 2 ? oracle->counting : oracle->plain, &outline, &view, got,
             NULL);
    found->different += count_differences(&view, wanted, got);
    found->samples += M * N;
    for (int k = 0; k < M * N; k++)
      found->faces += wanted[k] != HSR_BACKGROUND;
  }
  hsr_world_free(&outline);
  hsr_world_free(&laid_out);
  return true;
}

static void test_builtins(struct tap *tap) {
  for (const struct hsr_builtin *b = hsr_builtins; b->name; b++) {
    struct hsr_world outline;
    struct found found = {.samples = 0};
    if (b->package)
      continue;
    struct hsr_scene *scene = must_open(b->name);
    must_roster(&outline, scene);
    if (outline.n_faces <= MOST_FACES) {
      bool compared = compare(scene, &found);
      ok(tap, compared && !found.different && found.faces,
         "%s: %ld of %ld samples differ", b->name, found.different,
         found.samples);
    }
    hsr_world_free(&outline);
    hsr_scene_delete(scene);
  }
}

/* --- Random instances ----------------------------------------------------- */

/* A random number in [-1, 1]; every other time one of a few. */
static double draw_number(uint64_t *seed) {
  if (draw_integer(seed, 0, 1))
    return (double)draw_integer(seed, -2, 2) / 2;
  return (double)draw_integer(seed, -1000000, 1000000) / 1e6;
}

/* Boxes, upright and flat polygons, polygons in no plane, and triangles. */
static void draw_object(struct hsr_object *object, uint64_t *seed) {
  for (int f = 0; f < 7; f++) {
    uint32_t n = (uint32_t)draw_integer(seed, 3, 5), vertex[5];
    int across = (int)draw_integer(seed, -1, 2);
    int shared = (int)draw_integer(seed, 0, 3);
    double corner[5][3];
    for (uint32_t k = 0; k < n; k++) {
      for (int axis = 0; axis < 3; axis++)
        corner[k][axis] = axis == across && k ? corner[0][axis]
                          : axis == shared && k % 2
                              ? corner[k - 1][axis]
                              : draw_number(seed) + (axis == 2 ? f / 4.0 : 0);
      hsr_object_vertex(object, corner[k][0], corner[k][1], corner[k][2],
                        &vertex[k]);
    }
    hsr_object_face(object, vertex, n, NULL);
  }
  object->one_sided = !draw_integer(seed, 0, 3);
}

enum matrix { MOVED, TURNED, ALONG_AXES, ANY, FLAT, FOLDED, THIN, N_MATRICES };

static void draw_matrix(double m[12], enum matrix kind, uint64_t *seed) {
  int turn = (int)draw_integer(seed, 0, 2);
  double size[3];
  for (int k = 0; k < 3; k++)
    size[k] = (double)draw_integer(seed, 1, 15) / 10;
  place(m, kind == TURNED ? draw_number(seed) * 3 : 0,
        kind == TURNED ? size[0] : 1, draw_number(seed), draw_number(seed),
        draw_number(seed));
  for (int k = 0; k < 12; k++) {
    int row = k / 4, column = k % 4;
    if (column == 3)
      continue;
    if (kind == ALONG_AXES)
      m[k] = (row + turn) % 3 == column ? size[row] : 0;
    else if (kind == FLAT || kind == ANY)
      m[k] = kind == FLAT && row == turn ? 0.1 * m[(k + 4) % 12]
                                         : draw_number(seed);
    else if (kind == FOLDED) /* two coordinates from one */
      m[k] = column == row / 2 ? size[row] : 0;
    else if (kind == THIN)
      m[k] *= row == turn ? 1e-13 : 1;
  }
}

/* The object as the instance places it. */
static void add_echo(struct hsr_scene *scene, const struct hsr_object *object,
                     const double m[12]) {
  struct hsr_object *echo = hsr_scene_object(scene, "echo");
  for (uint32_t v = 0; v < object->n_vertices; v++) {
    double p[3];
    hsr_instance_vertex(m, object->xyz + 3 * (size_t)v, p);
    hsr_object_vertex(echo, p[0], p[1], p[2], NULL);
  }
  for (uint32_t f = 0; f < object->n_faces; f++)
    hsr_object_face(echo, object->vertex + object->start[f],
                    object->start[f + 1] - object->start[f], NULL);
}

/* An object in several different instances. Some of these are also added as
 * objects of their own, before or after. They lie on the same planes if, and
 * only if, every vertex is rounded as it should be. NULL if a face then has no
 * area. */
static struct hsr_scene *draw_scene(enum matrix kind, uint64_t *seed) {
  struct hsr_scene *scene = hsr_scene_new("random");
  struct hsr_scene *shelf = hsr_scene_new("shelf");
  struct hsr_object *object = hsr_scene_object(shelf, "object");
  double m[5][12];
  int n = (int)draw_integer(seed, 1, 5);
  draw_object(object, seed);
  for (int k = 0; k < n; k++)
    draw_matrix(m[k], kind, seed);
  if (draw_integer(seed, 0, 1))
    add_echo(scene, object, m[n - 1]);
  add_echo(scene, object, (double[]){1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
  uint32_t number = scene->n_objects - 1;
  scene->objects[number].one_sided = object->one_sided;
  if (number)
    hsr_scene_instance(scene, 0, NULL);
  for (int k = 0; k < n; k++)
    hsr_scene_instance(scene, number, m[k]);
  add_echo(scene, object, m[0]);
  hsr_scene_delete(shelf);
  hsr_scene_add_orbit(scene, 2);
  struct hsr_camera within = {{draw_number(seed), draw_number(seed), 3.1},
                              {draw_number(seed), draw_number(seed), 0},
                              {0, 1, 0},
                              70,
                              draw_integer(seed, 0, 1) ? 0.5 : 0};
  hsr_scene_view(scene, &within);
  within.eye[2] = draw_number(seed) / 3;
  within.at[2] = 1;
  hsr_scene_view(scene, &within);
  if (!hsr_scene_finish(scene, NULL))
    return scene;
  hsr_scene_delete(scene);
  return NULL;
}

static void test_random(struct tap *tap, enum matrix kind, const char *what) {
  struct found found = {.samples = 0};
  int n_scenes = 0;
  for (int k = 0; k < RANDOM_SCENES; k++) {
    uint64_t seed = (uint64_t)kind * 1000000 + (uint64_t)k;
    long before = found.different;
    struct hsr_scene *scene = draw_scene(kind, &seed);
    if (scene)
      n_scenes += compare(scene, &found);
    if (found.different > before)
      printf("# matrices %d, scene %d\n", (int)kind, k);
    hsr_scene_delete(scene);
  }
  ok(tap, !found.different && n_scenes > RANDOM_SCENES / 25 && found.faces,
     "%s: %ld of %ld samples differ, %ld with a face, in %d scenes", what,
     found.different, found.samples, found.faces, n_scenes);
}

int main(void) {
  static const char *const kind[] = {[MOVED] = "instances moved",
                                     [TURNED] = "turned",
                                     [ALONG_AXES] = "stretched along the axes",
                                     [ANY] = "by any matrix",
                                     [FLAT] = "by one of rank two",
                                     [FOLDED] = "folded into a plane",
                                     [THIN] = "made very thin"};
  struct tap tap = {.planned = 0};
  test_large(&tap);
  test_builtins(&tap);
  for (int k = 0; k < N_MATRICES; k++)
    test_random(&tap, (enum matrix)k, kind[k]);
  tap.planned = tap.run;
  printf("1..%d\n", tap.planned);
  return finish(&tap);
}
