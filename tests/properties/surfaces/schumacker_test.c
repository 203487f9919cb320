/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What Sutherland et al. 1974 say about Schumacker's algorithm: within a
 * cluster, priorities hold from every viewpoint once back faces are removed.
 * One object is prepared for a scene. Then it is seen from everywhere: from
 * inside and outside, from planes of faces, from vertices and along axes. It
 * must show what the oracle shows, and clusters and separators must not change.
 */
#include "bench/modules/modules.h"
#include "common/exact/screen.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Odd, so that some samples lie exactly on axes. */
enum { M = 25, N = 17, EYES = 1000 };

static const char *const scenes[] = {
    "house",      "color-cube:3", "harbor:100",  "nested-solids",
    "sphere:200", "non-planar",   "lattice:25:3"};
enum { SCENES = sizeof scenes / sizeof *scenes };

struct fixture {
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_setup oracle, schumacker;
  double lo[3], hi[3]; /* the scene's box */
  struct hsr_arena scratch;
};

static void prepare(struct fixture *x, struct hsr_scene *scene) {
  *x = (struct fixture){.scene = scene, .scratch = HSR_ARENA_EMPTY};
  must_world(&x->world, x->scene);
  must_setup(&x->oracle, hsr_algorithm_find("oracle")->plain, NULL, &x->world);
  must_setup(&x->schumacker, hsr_algorithm_find("schumacker")->plain, NULL,
             &x->world);
  const double *axis[3] = {x->world.mesh.x, x->world.mesh.y, x->world.mesh.z};
  for (int k = 0; k < 3; k++) {
    x->lo[k] = x->hi[k] = axis[k][0];
    for (uint32_t v = 1; v < x->world.mesh.n_vertices; v++) {
      x->lo[k] = fmin(x->lo[k], axis[k][v]);
      x->hi[k] = fmax(x->hi[k], axis[k][v]);
    }
  }
}

static void open_scene(struct fixture *x, const char *name) {
  struct hsr_scene *scene = must_open(name);
  prepare(x, scene);
}

static void close_scene(struct fixture *x) {
  hsr_setup_free(&x->schumacker);
  hsr_setup_free(&x->oracle);
  hsr_world_free(&x->world);
  hsr_scene_delete(x->scene);
  hsr_arena_free(&x->scratch);
}

/* --- Viewpoints ----------------------------------------------------------- */

static double draw_between(uint64_t *seed, double lo, double hi) {
  return lo + (hi - lo) * (double)draw_integer(seed, 0, 1 << 20) / (1 << 20);
}

static uint32_t draw_vertex(uint64_t *seed, const struct fixture *x,
                            uint32_t f) {
  const struct hsr_world *w = &x->world;
  return w->mesh
      .vertex[w->mesh.start[f] +
              (uint32_t)draw_integer(seed, 0, hsr_face_size(w, f) - 1)];
}

/* A vertex; or a point on the plane of a face, rounded to doubles. */
static void draw_on_face(uint64_t *seed, const struct fixture *x, bool vertex,
                         double eye[3]) {
  const struct hsr_world *w = &x->world;
  uint32_t f = (uint32_t)draw_integer(seed, 0, w->n_faces - 1);
  uint32_t a = draw_vertex(seed, x, f), b = draw_vertex(seed, x, f),
           c = draw_vertex(seed, x, f);
  double s = vertex ? 0 : (double)draw_integer(seed, -8, 8) / 4;
  double t = vertex ? 0 : (double)draw_integer(seed, -8, 8) / 4;
  const double *axis[3] = {w->mesh.x, w->mesh.y, w->mesh.z};
  for (int k = 0; k < 3; k++)
    eye[k] = axis[k][a] + s * (axis[k][b] - axis[k][a]) +
             t * (axis[k][c] - axis[k][a]);
}

static struct hsr_camera draw_camera(uint64_t *seed, const struct fixture *x) {
  struct hsr_camera camera = {.up = {0, 1, 0}};
  int kind = (int)draw_integer(seed, 0, 4);
  double reach = kind == 0 ? 1.5 : 0; /* outside too */
  for (int k = 0; k < 3; k++) {
    double size = x->hi[k] - x->lo[k];
    camera.eye[k] =
        draw_between(seed, x->lo[k] - reach * size, x->hi[k] + reach * size);
    camera.at[k] = draw_between(seed, x->lo[k], x->hi[k]);
    if (kind == 2)
      camera.eye[k] = rint(camera.eye[k]);
  }
  if (kind >= 3)
    draw_on_face(seed, x, kind == 4, camera.eye);
  if (draw_integer(seed, 0, 1)) { /* along an axis */
    int axis = (int)draw_integer(seed, 0, 2);
    memcpy(camera.at, camera.eye, sizeof camera.at);
    camera.at[axis] += draw_integer(seed, 0, 1) ? 1 : -1;
    camera.up[0] = axis == 1;
    camera.up[1] = axis != 1;
  }
  camera.fov = draw_integer(seed, 0, 1) ? 90 : 60;
  camera.near = draw_integer(seed, 0, 3) ? 0 : 0.25;
  return camera;
}

/* --- The comparison ------------------------------------------------------- */

static void draw(struct fixture *x, const struct hsr_setup *setup,
                 const struct hsr_view *view, uint32_t *ids) {
  struct hsr_error err = {.text = ""};
  struct hsr_tally tally = {.out_of_memory = false};
  struct hsr_answer answer = hsr_answer_of_ids(ids, view->m, view->n);
  struct hsr_job job = {
      .view = view, .scratch = &x->scratch, .tally = &tally, .answer = &answer};
  hsr_arena_reset(&x->scratch);
  memset(ids, 0xfe, (size_t)view->m * (size_t)view->n * sizeof *ids);
  if (hsr_setup_render(setup, &job, &err))
    bail("%s", err.text);
}

static uint64_t mixed(uint64_t sum, const void *bytes, size_t n) {
  const unsigned char *byte = bytes;
  for (size_t k = 0; k < n; k++)
    sum = (sum ^ byte[k]) * 0x100000001b3u;
  return sum;
}

/* Priorities, clusters and separators in one number. */
static uint64_t sum_of_clusters(const struct hsr_world *world) {
  const struct hsr_clusters *c = world->clusters;
  uint64_t sum = mixed(0, c->start, (c->n_clusters + 1) * sizeof *c->start);
  sum = mixed(sum, c->order, c->start[c->n_clusters] * sizeof *c->order);
  for (uint32_t s = 0; s < c->n_separators; s++) {
    const struct hsr_separator *separator = &c->separator[s];
    sum = mixed(sum, &separator->face, sizeof separator->face);
    sum = mixed(sum, &separator->axis, sizeof separator->axis);
    sum = mixed(sum, &separator->at, sizeof separator->at);
    sum = mixed(sum, &separator->front, sizeof separator->front);
    sum = mixed(sum, &separator->behind, sizeof separator->behind);
  }
  return sum;
}

static void check_scene(struct tap *tap, const char *name, uint64_t *seed) {
  static uint32_t wanted[M * N], got[M * N];
  struct fixture x;
  open_scene(&x, name);
  const struct hsr_world *world = x.schumacker.world;
  uint64_t sum = sum_of_clusters(world);
  long differences = 0, visible = 0;
  for (int eyes = 0; eyes < EYES;) {
    struct hsr_camera camera = draw_camera(seed, &x);
    struct hsr_view view;
    if (hsr_view_init(&view, &camera, M, N, NULL))
      continue;
    eyes++;
    draw(&x, &x.oracle, &view, wanted);
    draw(&x, &x.schumacker, &view, got);
    long here = count_differences(&view, wanted, got);
    if (here)
      printf("# %s, eye %.17g,%.17g,%.17g at %.17g,%.17g,%.17g: %ld\n", name,
             camera.eye[0], camera.eye[1], camera.eye[2], camera.at[0],
             camera.at[1], camera.at[2], here);
    differences += here;
    for (int k = 0; k < M * N; k++)
      visible += wanted[k] != HSR_BACKGROUND;
  }
  ok(tap, !differences && visible > EYES * M * N / 10,
     "%s: %ld differences from %d viewpoints, %ld samples show a face", name,
     differences, EYES, visible);
  ok(tap, sum_of_clusters(world) == sum,
     "%s: %u clusters and their priorities are as they were", name,
     world->clusters->n_clusters);
  close_scene(&x);
}

/* --- A grazed face -------------------------------------------------------- */

static void add_quad(struct hsr_object *object, const double corner[4][3]) {
  uint32_t vertex[4];
  for (int k = 0; k < 4; k++)
    hsr_object_vertex(object, corner[k][0], corner[k][1], corner[k][2],
                      &vertex[k]);
  hsr_object_face(object, vertex, 4, NULL);
}

/* A floor with one corner lifted very little, in front of a wall. The eye is as
 * little above the floor and looks along it. A sample lies between the lifted
 * corner and the others, so the floor covers it. But the sample's ray meets the
 * floor's plane beyond the wall. */
static void check_grazed(struct tap *tap) {
  static uint32_t wanted[M * N], got[M * N];
  const double lift = 0x1p-40;
  const double floor[4][3] = {{0, 0, -2}, {4, 0, -2}, {4, lift, 2}, {0, 0, 2}};
  const double wall[4][3] = {
      {4.0625, -4, -4}, {4.0625, -4, 4}, {4.0625, 4, 4}, {4.0625, 4, -4}};
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_scene *scene = hsr_scene_new("grazed");
  struct hsr_object *object = hsr_scene_object(scene, "floor and wall");
  add_quad(object, floor);
  add_quad(object, wall);
  must_finish(scene);
  struct hsr_camera camera = {.eye = {-4, 0.75 * lift, 0},
                              .at = {-3, 0.75 * lift, 0},
                              .up = {0, 1, 0},
                              .fov = 90};
  struct hsr_view view;
  struct fixture x;
  prepare(&x, scene);
  must_view(&view, &camera, M, N);
  draw(&x, &x.oracle, &view, wanted);
  draw(&x, &x.schumacker, &view, got);
  struct hsr_arena arena = HSR_ARENA_EMPTY;
  struct hsr_screen screen;
  struct hsr_tally tally = {.out_of_memory = false};
  if (hsr_screen_make(&screen, &x.world, &view, &arena, &tally))
    bail("%s", err.text);
  bool covers = hsr_covers(&screen, 0, 14, N / 2, &tally);
  ok(tap,
     covers && wanted[N / 2 * M + 14] == 1 &&
         !count_differences(&view, wanted, got),
     "a floor covers a sample and is met beyond the wall: the wall is seen");
  draw_plain("schumacker-watkins", &x.world, &view, got);
  ok(tap, !count_differences(&view, wanted, got),
     "the same, where the floor is painted after the clusters");
  hsr_arena_free(&arena);
  close_scene(&x);
}

/* --- Two instances in one plane ------------------------------------------- */

/* No plane between them tells which one is seen: the lower id, from both sides.
 */
static void check_coplanar(struct tap *tap) {
  static uint32_t wanted[M * N], got[M * N];
  struct hsr_scene *scene = hsr_scene_new("coplanar");
  for (int k = 0; k < 4; k++) {
    double x = k % 2, y = k / 2;
    const double corner[4][3] = {
        {x, y, 0}, {x + 3, y, 0}, {x + 3, y + 3, 0}, {x, y + 3, 0}};
    add_quad(hsr_scene_object(scene, "quad"), corner);
  }
  must_finish(scene);
  struct fixture x;
  prepare(&x, scene);
  long differences = 0, seen = 0;
  for (int side = -1; side <= 1; side += 2) {
    struct hsr_camera camera = {
        .eye = {2, 2, 4 * side}, .at = {2, 2, 0}, .up = {0, 1, 0}, .fov = 60};
    struct hsr_view view;
    must_view(&view, &camera, M, N);
    draw(&x, &x.oracle, &view, wanted);
    draw(&x, &x.schumacker, &view, got);
    differences += count_differences(&view, wanted, got);
    for (int k = 0; k < M * N; k++)
      seen += wanted[k] == 0;
  }
  ok(tap, !differences && seen > M * N / 10,
     "instances in one plane: %ld samples differ", differences);
  close_scene(&x);
}

/* --- More than is searched or culled at once
 * ------------------------------- */

static void check_size(struct tap *tap, struct fixture *x,
                       const struct hsr_camera *camera, int m, int n) {
  uint32_t *wanted = malloc((size_t)m * (size_t)n * sizeof *wanted);
  uint32_t *got = malloc((size_t)m * (size_t)n * sizeof *got);
  struct hsr_error err = {.text = "no memory"};
  struct hsr_view view;
  if (!wanted || !got)
    bail("%s", err.text);
  must_view(&view, camera, m, n);
  draw(x, &x->oracle, &view, wanted);
  draw(x, &x->schumacker, &view, got);
  long differences = count_differences(&view, wanted, got);
  ok(tap, !differences, "%u faces, %d x %d samples: %ld differ",
     x->world.n_faces, m, n, differences);
  free(wanted);
  free(got);
}

/* Raster elements of a scan line, and scan lines. */
static void check_large(struct tap *tap) {
  struct fixture x;
  open_scene(&x, "house");
  check_size(tap, &x, &x.scene->views[0], 70, 4200);
  struct hsr_camera close = x.scene->views[0];
  close.fov = 0.05;
  check_size(tap, &x, &close, 4200, 7);
  close_scene(&x);
}

/* Pairs of counters: a pile of squares, which the eye sees from above. They
 * become smaller with the height, so that faces of both runs are seen. */
static void check_pile(struct tap *tap) {
  enum { SQUARES = 4500 };
  struct hsr_scene *scene = hsr_scene_new("pile");
  struct hsr_object *object = hsr_scene_object(scene, "squares");
  for (int k = 0; k < SQUARES; k++) {
    double r = 1 - (double)k / SQUARES, z = 1e-3 * k;
    const double corner[4][3] = {
        {-r, -r, z}, {r, -r, z}, {r, r, z}, {-r, r, z}};
    add_quad(object, corner);
  }
  must_finish(scene);
  struct hsr_camera camera = {
      .eye = {.01, .02, 9}, .at = {0, 0, 0}, .up = {0, 1, 0}, .fov = 20};
  struct fixture x;
  prepare(&x, scene);
  check_size(tap, &x, &camera, 41, 5);
  close_scene(&x);
}

int main(void) {
  struct tap tap = plan(2 * SCENES + 6);
  uint64_t seed = 1969;
  for (int s = 0; s < SCENES; s++)
    check_scene(&tap, scenes[s], &seed);
  check_grazed(&tap);
  check_coplanar(&tap);
  check_large(&tap);
  check_pile(&tap);
  return finish(&tap);
}
