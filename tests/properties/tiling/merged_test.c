/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Merged octrees (N. Greene, "Hierarchical Polygon Tiling with Coverage Masks",
 * SIGGRAPH 1996, 6.2). Rigid bodies that move through one another and through
 * standing ones give the oracle's picture. Bodies that are apart are not
 * merged. Carts drive through the office, which is prepared once. */
#include "bench/modules/variant.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { M = 96, N = 72, FRAMES = 20, SCENES = 12, LATTICES = 300 };

static uint32_t right[M * N], ids[M * N];

static void must(enum hsr_status status, const struct hsr_error *err) {
  if (status)
    bail("%s", err->text);
}

/* --- An algorithm made ready ---------------------------------------------- */

struct ready {
  struct hsr_variant variant;
  struct hsr_setup setup;
  struct hsr_arena scratch;
  struct hsr_tally tally;
};

static void make_ready(struct ready *r, const char *name, bool counting,
                       const struct hsr_world *world) {
  struct hsr_error err = {.text = "out of memory"};
  *r = (struct ready){.scratch = HSR_ARENA_EMPTY};
  must(hsr_variant_parse(name, &r->variant, &err), &err);
  must(hsr_setup_init(&r->setup,
                      counting ? r->variant.listed->counting
                               : r->variant.listed->plain,
                      &r->variant.choice, world, &err),
       &err);
}

static void draw(struct ready *r, const struct hsr_view *view, uint32_t *to) {
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_answer answer = hsr_answer_of_ids(to, view->m, view->n);
  struct hsr_job job = {.view = view,
                        .scratch = &r->scratch,
                        .tally = &r->tally,
                        .answer = &answer};
  hsr_arena_reset(&r->scratch);
  memset(to, 0xfe, (size_t)view->m * (size_t)view->n * sizeof *to);
  must(hsr_setup_render(&r->setup, &job, &err), &err);
}

static void finish_ready(struct ready *r) {
  hsr_setup_free(&r->setup);
  hsr_arena_free(&r->scratch);
}

static uint64_t count_of(const struct ready *r, const char *name) {
  return counted(r->setup.algorithm, &r->tally, name);
}

/* --- Bodies --------------------------------------------------------------- */

static double unit(uint64_t *seed) {
  return (double)draw_integer(seed, 0, 1 << 20) / (1 << 20);
}

/* A box about the origin, of triangles. */
static struct hsr_object *add_box(struct hsr_scene *scene, double x, double y,
                                  double z) {
  static const uint32_t side[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                      {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  static const float red[3] = {0.8f, 0.3f, 0.2f};
  struct hsr_object *object = hsr_scene_object(scene, "box");
  for (int k = 0; k < 8; k++)
    hsr_object_vertex(object, k & 1 ? x : -x, k & 2 ? y : -y, k & 4 ? z : -z,
                      NULL);
  for (int s = 0; s < 6; s++) {
    const uint32_t one[3] = {side[s][0], side[s][1], side[s][2]};
    const uint32_t two[3] = {side[s][0], side[s][2], side[s][3]};
    hsr_object_face(object, one, 3, red);
    hsr_object_face(object, two, 3, red);
  }
  return object;
}

/* A ball about the origin: rows of triangles between two poles. */
static struct hsr_object *add_ball(struct hsr_scene *scene, double radius) {
  enum { AROUND = 14, ROWS = 9 };
  static const float blue[3] = {0.2f, 0.4f, 0.8f};
  struct hsr_object *object = hsr_scene_object(scene, "ball");
  for (int row = 0; row <= ROWS; row++)
    for (int k = 0; k < AROUND; k++) {
      double a = 3.14159265 * row / ROWS, b = 6.2831853 * k / AROUND;
      double r = row % ROWS ? radius * sin(a) : 0;
      hsr_object_vertex(object, r * cos(b), radius * cos(a), r * sin(b), NULL);
    }
  for (int row = 0; row < ROWS; row++)
    for (int k = 0; k < AROUND; k++) {
      uint32_t a = (uint32_t)(row * AROUND + k);
      uint32_t b = (uint32_t)(row * AROUND + (k + 1) % AROUND);
      const uint32_t one[3] = {a, b, b + AROUND};
      const uint32_t two[3] = {a, b + AROUND, a + AROUND};
      if (row)
        hsr_object_face(object, one, 3, blue);
      if (row < ROWS - 1)
        hsr_object_face(object, two, 3, blue);
    }
  return object;
}

/* A random rotation, by a quaternion, rounded. */
static void turn(uint64_t *seed, double m[12]) {
  double q[4], size = 0;
  for (int k = 0; k < 4; k++) {
    q[k] = unit(seed) - 0.5;
    size += q[k] * q[k];
  }
  for (int k = 0; k < 4; k++)
    q[k] /= sqrt(size);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      int other = 3 - i - j;
      double w = (j - i + 3) % 3 == 1 ? -q[3] : q[3];
      m[4 * i + j] = i == j ? 1 - 2 * (1 - q[i] * q[i] - q[3] * q[3])
                            : 2 * (q[i] * q[j] + w * q[other]);
    }
}

struct bodies {
  int boxes, balls;
  double spread; /* the farthest that one is from the origin */
  bool still;    /* there is also a standing one */
  bool lattice;  /* whole numbers, no rotation */
};

static void place(struct hsr_scene *scene, uint32_t object, uint64_t *seed,
                  const struct bodies *bodies, int number) {
  double m[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  if (!bodies->lattice)
    turn(seed, m);
  for (int k = 0; k < 3; k++)
    m[4 * k + 3] = bodies->lattice      ? (double)draw_integer(seed, -4, 4)
                   : bodies->spread > 0 ? bodies->spread * (2 * unit(seed) - 1)
                                        : (k == 0   ? 5.0 * (number % 4)
                                           : k == 1 ? 5.0 * (number / 4)
                                                    : 0);
  hsr_scene_instance(scene, object, m);
}

static struct hsr_scene *make_scene(uint64_t *seed,
                                    const struct bodies *bodies) {
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_scene *scene = hsr_scene_new("bodies");
  int number = 0;
  if (bodies->still) {
    add_box(scene, 4, 1, 4)->one_sided = true;
    add_box(scene, 1, 3, 2)->one_sided = draw_integer(seed, 0, 1);
  }
  for (int kind = 0; kind < 2; kind++) {
    uint32_t object = scene->n_objects;
    int n = kind ? bodies->balls : bodies->boxes;
    if (!n)
      continue;
    struct hsr_object *made =
        kind              ? add_ball(scene, 1.25)
        : bodies->lattice ? add_box(scene, 1, 1, 2)
                          : add_box(scene, 0.5 + unit(seed), 1.25, 0.75);
    made->moves = true;
    made->one_sided = draw_integer(seed, 0, 1);
    for (uint32_t k = 0; k < object; k++)
      if (bodies->still && !number && scene->n_instances <= k)
        hsr_scene_instance(scene, k, NULL);
    for (int k = 0; k < n; k++)
      place(scene, object, seed, bodies, number++);
  }
  struct hsr_camera camera = {.eye = {(double)draw_integer(seed, -9, 9),
                                      (double)draw_integer(seed, 2, 9),
                                      (double)draw_integer(seed, 8, 12)},
                              .at = {0, 0, 0},
                              .up = {0, 1, 0},
                              .fov = 60,
                              .near = draw_integer(seed, 0, 3) ? 0 : 7,
                              .parallel = draw_integer(seed, 0, 2) ? 0 : 9};
  must(hsr_scene_view(scene, &camera), &err);
  must(hsr_scene_finish(scene, &err), &err);
  return scene;
}

/* One scene in `part` is drawn. */
static int part = 1;

/* Draws some scenes; returns how many samples are wrong. */
static long check_scenes(int n, uint64_t seed, const struct bodies *bodies,
                         uint64_t *merges) {
  long wrong = 0;
  *merges = 0;
  for (int k = 0; k < n / part; k++) {
    struct hsr_error err = {.text = "out of memory"};
    struct hsr_scene *scene = make_scene(&seed, bodies);
    struct hsr_world world;
    struct hsr_view view;
    must(hsr_world_init(&world, scene, &err), &err);
    must(hsr_view_init(&view, &scene->views[0], M - k % 5, N - k % 7, &err),
         &err);
    if (k % 3 == 1)
      view.offset_x = 0.25;
    draw_plain("oracle", &world, &view, right);
    for (int counting = 0; counting < 2; counting++) {
      struct ready merged;
      make_ready(&merged, k % 4 == 3 ? "tiling-merged:leaf=3" : "tiling-merged",
                 counting, &world);
      draw(&merged, &view, ids);
      long differ = count_differences(&view, ids, right);
      if (differ)
        printf("# scene %d of %d bodies: %ld samples differ\n", k,
               bodies->boxes + bodies->balls, differ);
      wrong += differ;
      if (counting)
        *merges += count_of(&merged, "merges");
      finish_ready(&merged);
    }
    hsr_world_free(&world);
    hsr_scene_delete(scene);
  }
  return wrong;
}

static void check_bodies(struct tap *tap) {
  static const struct {
    int scenes;
    struct bodies bodies;
    bool merge; /* whether any are merged */
    const char *what;
  } kinds[] = {
      {SCENES, {6, 5, 0, false, false}, false, "scenes of bodies apart"},
      {SCENES, {6, 5, 3, false, false}, true, "scenes of bodies in a crowd"},
      {SCENES,
       {4, 4, 4, true, false},
       true,
       "scenes of bodies among what stands"},
      {LATTICES, {7, 0, 0, true, true}, true, "lattices of boxes"}};
  for (uint64_t k = 0; k < 4; k++) {
    uint64_t merges;
    long wrong =
        check_scenes(kinds[k].scenes, k + 1, &kinds[k].bodies, &merges);
    ok(tap, !wrong && kinds[k].merge == (merges > 0),
       "%d %s: %ld samples differ, %llu merges", kinds[k].scenes / part,
       kinds[k].what, wrong, (unsigned long long)merges);
  }
}

/* --- Traffic -------------------------------------------------------------- */

static struct hsr_scene *open_traffic(int per_cent, int frame) {
  char name[40];
  struct hsr_scene *scene;
  struct hsr_error err = {.text = "out of memory"};
  snprintf(name, sizeof name, "traffic:%d:%d", per_cent, frame);
  must(hsr_scene_open(name, NULL, &scene, &err), &err);
  return scene;
}

/* Draws this frame by the oracle. */
static void draw_oracle(struct hsr_scene *scene, const struct hsr_view *view) {
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_world world;
  must(hsr_world_init(&world, scene, &err), &err);
  draw_plain("oracle", &world, view, right);
  hsr_world_free(&world);
}

/* A camera beside a cart, or one of the scene's own. */
static struct hsr_camera look(const struct hsr_scene *scene, int frame) {
  struct hsr_camera camera = scene->views[frame];
  uint32_t carts = 0;
  while (!scene->objects[scene->instances[carts].object].moves)
    carts++;
  uint32_t n = scene->n_instances - carts;
  const double *m = scene->instances[carts + (uint32_t)frame % n].m;
  for (int k = 0; k < 3 && frame % 4; k++) {
    camera.at[k] = m[4 * k + 3];
    camera.eye[k] = camera.at[k] + 1.5;
  }
  return camera;
}

static void check_traffic(struct tap *tap, int per_cent) {
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_scene *scene = open_traffic(per_cent, 0);
  struct hsr_world outline;
  struct ready merged, hzbuffer;
  long wrong = 0, carts = 0;
  must(hsr_world_roster(&outline, scene, &err), &err);
  make_ready(&merged, "tiling-merged", true, &outline);
  make_ready(&hzbuffer, "hzbuffer", false, &outline);
  for (int frame = 0; frame < FRAMES; frame++) {
    struct hsr_scene *then = open_traffic(per_cent, frame);
    struct hsr_view view;
    memcpy(scene->instances, then->instances,
           scene->n_instances * sizeof *scene->instances);
    hsr_scene_delete(then);
    struct hsr_camera camera = look(scene, frame);
    must(hsr_view_init(&view, &camera, M, N, &err), &err);
    draw(&merged, &view, ids);
    draw(&hzbuffer, &view, right);
    wrong += count_differences(&view, ids, right);
    if (frame % 10 == 3) {
      draw_oracle(scene, &view);
      wrong += count_differences(&view, ids, right);
    }
    for (int k = 0; k < M * N; k++)
      carts +=
          ids[k] != HSR_BACKGROUND &&
          scene->objects[hsr_place_of(&outline, ids[k]).object - scene->objects]
              .moves;
  }
  ok(tap, !wrong && carts,
     "traffic:%d, %d frames: %ld samples differ; carts cover %ld, %llu trees, "
     "%llu merges of %llu faces",
     per_cent, FRAMES, wrong, carts,
     (unsigned long long)count_of(&merged, "trees"),
     (unsigned long long)count_of(&merged, "merges"),
     (unsigned long long)count_of(&merged, "merged faces"));
  finish_ready(&merged);
  finish_ready(&hzbuffer);
  hsr_world_free(&outline);
  hsr_scene_delete(scene);
}

/* usage: merged_test [WORD]      with a word: only some bodies, no traffic */
int main(int argc, char **argv) {
  (void)argv;
  if (argc > 1) {
    struct tap some = plan(4);
    part = 12;
    check_bodies(&some);
    return finish(&some);
  }
  struct tap tap = plan(6);
  check_bodies(&tap);
  check_traffic(&tap, 1);
  check_traffic(&tap, 20);
  return finish(&tap);
}
