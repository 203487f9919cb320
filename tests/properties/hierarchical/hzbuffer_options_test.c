/* SPDX-License-Identifier: GPL-3.0-or-later */
/* With all options of hzbuffer its picture is the z-buffer's of the scene laid
 * out, sample for sample: thesis, 3.3, claim 1.
 *
 * Options     Every combination, on small scenes; coherence over views that
 *             repeat.
 * Windows     Of 1, 7 and 32 samples, also by several threads.
 * Instances   Random scenes of a few modules, flat or long, apart or not, close
 *             together or nearly so: cases in which the order of cubes
 *             suffices, and cases in which it does not. */
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include "bench/modules/variant.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { M = 48, N = 36, VIEWS = 2, FRAMES = 4, THREADS = 4, RANDOM_SCENES = 60 };

/* A scene and its right pictures. */
struct known {
  struct hsr_scene *scene;
  struct hsr_world world, outline;
  struct hsr_view view[VIEWS];
  uint32_t right[VIEWS][M * N];
};

static void know(struct known *k) {
  const struct hsr_algorithm *zbuffer =
      hsr_algorithm_find("zbuffer-fast")->plain;
  must_world(&k->world, k->scene);
  must_roster(&k->outline, k->scene);
  for (uint32_t v = 0; v < VIEWS; v++) {
    uint32_t of = v < k->scene->n_views ? v : 0;
    must_view(&k->view[v], &k->scene->views[of], M, N);
    draw_ids(zbuffer, &k->world, &k->view[v], k->right[v], NULL);
  }
}

static void forget(struct known *k) {
  hsr_world_free(&k->world);
  hsr_world_free(&k->outline);
  hsr_scene_delete(k->scene);
}

static struct known *open_known(const char *name) {
  static struct known k;
  k.scene = must_open(name);
  know(&k);
  return &k;
}

/* --- Options -------------------------------------------------------------- */

/* The next combination of words of all options; numbers stay as they are. False
 * after the last. */
static bool next_choice(const struct hsr_option *option, long *chosen) {
  for (int k = 0; option[k].name; k++) {
    if (!option[k].words)
      continue;
    if (option[k].words[++chosen[k]].name)
      return true;
    chosen[k] = 0;
  }
  return false;
}

/* The number of wrong samples in FRAMES frames of one prepared object. */
static long try_choice(const struct known *k, const struct hsr_algorithm *a,
                       const struct hsr_choice *choice) {
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  struct hsr_tally tally = {.out_of_memory = false};
  struct hsr_setup setup;
  uint32_t ids[M * N];
  long wrong = 0;
  must_setup(&setup, a, choice, &k->outline);
  for (int f = 0; f < (setup.flags & HSR_FRAME_STATE ? FRAMES : VIEWS); f++) {
    int v = f % VIEWS;
    struct hsr_answer answer = hsr_answer_of_ids(ids, M, N);
    struct hsr_job job = {.view = &k->view[v],
                          .scratch = &scratch,
                          .tally = &tally,
                          .answer = &answer};
    memset(ids, 0xfe, sizeof ids);
    hsr_arena_reset(&scratch);
    if (hsr_setup_render(&setup, &job, &err))
      bail("%s: %s", k->scene->name, err.text);
    wrong += count_differences(&k->view[v], ids, k->right[v]);
  }
  hsr_setup_free(&setup);
  hsr_arena_free(&scratch);
  return wrong;
}

/* Prints a choice that is wrong. */
static void report(const struct known *k, const struct hsr_option *option,
                   const struct hsr_choice *choice, long wrong) {
  printf("# %s: %ld samples differ:", k->scene->name, wrong);
  for (int o = 0; option[o].name; o++)
    if (option[o].words)
      printf(" %s=%s", option[o].name,
             option[o].words[choice->values.option[o]].name);
    else
      printf(" %s=%ld", option[o].name, choice->values.option[o]);
  putchar('\n');
}

static void set_number(const struct hsr_option *option, long *chosen,
                       const char *name, long number) {
  for (int k = 0; option[k].name; k++)
    if (!strcmp(option[k].name, name))
      chosen[k] = number;
}

/* Tries all combinations, in the two builds by turns. Returns how many. */
static int try_all(const struct known *k, long *wrong) {
  const struct hsr_listed *hz = hsr_algorithm_find("hzbuffer");
  const struct hsr_option *option = hz->plain->options;
  struct hsr_choice choice = hsr_choice_standard(hz->plain);
  int n = 0, reported = 0;
  for (int o = 0; option[o].name; o++)
    choice.values.option[o] = option[o].words ? 0 : choice.values.option[o];
  set_number(option, choice.values.option, "least", 4);
  set_number(option, choice.values.option, "occluders", 20);
  set_number(option, choice.values.option, "assumed", 3);
  do {
    const struct hsr_algorithm *a = n++ % 2 ? hz->plain : hz->counting;
    long bad = try_choice(k, a, &choice);
    if (bad && reported++ < 5)
      report(k, option, &choice, bad);
    *wrong += bad;
  } while (next_choice(option, choice.values.option));
  return n;
}

static void test_options(struct tap *tap, const char *name) {
  struct known *k = open_known(name);
  long wrong = 0;
  int n = try_all(k, &wrong);
  ok(tap, !wrong && n >= 700,
     "%s: %d combinations of options: %ld samples differ", name, n, wrong);
  forget(k);
}

/* --- Random instances ----------------------------------------------------- */

/* Boxes and triangles in a box of the given size; sometimes a leaning
 * quadrilateral, which only the first instance leaves flat. */
static void fill_module(struct hsr_object *object, const double *size,
                        int n_faces, uint64_t *seed) {
  for (int f = 0; f < n_faces; f++) {
    uint32_t vertex[4];
    double a[3], d[2][3];
    int flat = (int)draw_integer(seed, 0, 4);
    for (int k = 0; k < 3; k++) {
      double step = size[k] / 16;
      a[k] = step * (double)draw_integer(seed, 0, 8);
      for (int e = 0; e < 2; e++)
        d[e][k] = k == flat ? 0 : step * (double)draw_integer(seed, 0, 4);
    }
    for (int k = 0; k < 3; k++) /* their normals are not zero */
      d[k == (flat + 1) % 3][k] += k == flat ? 0 : size[k] / 16 + size[k] / 4;
    int corners = f % 5 ? 3 : 4;
    for (int c = 0; c < corners; c++) {
      double s = c == 1 || c == 2, t = c >= 2;
      hsr_object_vertex(object, a[0] + s * d[0][0] + t * d[1][0],
                        a[1] + s * d[0][1] + t * d[1][1],
                        a[2] + s * d[0][2] + t * d[1][2], &vertex[c]);
    }
    hsr_object_face(object, vertex, (size_t)corners, NULL);
  }
}

/* Modules on a grid of a few cells in each direction, perhaps shifted a little;
 * and a view from inside or from nearby. */
static struct hsr_scene *random_modules(uint64_t *seed) {
  struct hsr_scene *scene = hsr_scene_new("modules");
  int n_objects = (int)draw_integer(seed, 1, 3);
  for (int o = 0; o < n_objects; o++) {
    struct hsr_object *object = hsr_scene_object(scene, "module");
    double size[3];
    for (int k = 0; k < 3; k++)
      size[k] = draw_integer(seed, 0, 2) ? 16 : 2;
    fill_module(object, size, (int)draw_integer(seed, 4, 40), seed);
    int n = (int)draw_integer(seed, 1, 8),
        shifts = (int)draw_integer(seed, 0, 2);
    for (int i = 0; i < n; i++) {
      double m[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
      for (int k = 0; k < 3; k++)
        m[4 * k + 3] = (double)(16 * draw_integer(seed, 0, 3)) +
                       (shifts ? (double)draw_integer(seed, 0, 14) : 0);
      hsr_scene_instance(scene, (uint32_t)o, m);
    }
  }
  for (int v = 0; v < VIEWS; v++) {
    struct hsr_camera camera = {.up = {0, 1, 0.01}, .fov = 70};
    for (int k = 0; k < 3; k++) {
      camera.eye[k] = (double)draw_integer(seed, -300, 900) / 10 + 0.03;
      camera.at[k] = (double)draw_integer(seed, 100, 500) / 10;
    }
    if (hsr_scene_view(scene, &camera))
      bail("modules: no view");
  }
  must_finish(scene);
  return scene;
}

static const char *const choices[] = {
    "hzbuffer:least=2",
    "hzbuffer:least=2:cubes=sides",
    "hzbuffer:least=1:cubes=sides:pyramid=off",
    "hzbuffer:least=1:cubes=sides:placement=enclosing",
    "hzbuffer:least=1:cubes=sides:pyramid=dual:polygons=definitive",
    "hzbuffer:least=2:cubes=sides:coherence=passes",
    "hzbuffer:least=2:cubes=sides:coherence=list",
    "hzbuffer:least=2:cubes=sides:coherence=chc",
    "hzbuffer:least=2:coherence=chc++:assumed=3",
    "hzbuffer:least=1:pyramid=dual",
    "hzbuffer:least=2:pyramid=masked",
    "hzbuffer:least=2:pyramid=maps:occluders=20",
    "hzbuffer:least=1:pyramid=maps:occluders=3:coherence=list",
    "hzbuffer:least=1:cubes=sides:pyramid=masked:polygons=definitive",
    "hzbuffer:least=2:pyramid=masked:coherence=passes",
    "clark"};

/* The number of wrong samples with all of these choices. */
static long try_choices(const struct known *k) {
  long wrong = 0;
  for (size_t c = 0; c < sizeof choices / sizeof *choices; c++) {
    struct hsr_variant variant;
    struct hsr_error err;
    if (hsr_variant_parse(choices[c], &variant, &err))
      bail("%s: %s", choices[c], err.text);
    long bad = try_choice(k, variant.listed->counting, &variant.choice);
    if (bad)
      printf("# %s: %s: %ld samples differ\n", k->scene->name, choices[c], bad);
    wrong += bad;
  }
  return wrong;
}

/* The number of samples that show a face. */
static long count_faces(const struct known *k) {
  long faces = 0;
  for (int v = 0; v < VIEWS; v++)
    for (int i = 0; i < M * N; i++)
      faces += k->right[v][i] != HSR_BACKGROUND;
  return faces;
}

static void test_instances(struct tap *tap, uint64_t *seed) {
  static struct known k;
  long wrong = 0, faces = 0;
  for (int s = 0; s < RANDOM_SCENES; s++) {
    k.scene = random_modules(seed);
    know(&k);
    faces += count_faces(&k);
    wrong += try_choices(&k);
    forget(&k);
  }
  ok(tap, !wrong && faces > RANDOM_SCENES * 40,
     "%d scenes of instances: %ld samples differ", (int)RANDOM_SCENES, wrong);
}

/* --- Completed samples ---------------------------------------------------- */

/* A sample that is beside a side of a cube, by less than the error of the
 * side's place, is not behind it: there its plane may even be behind the eye.
 */
static void test_beside(struct tap *tap) {
  static struct known k;
  uint64_t seed = 0x94ab092bf31e31b4u;
  k.scene = random_modules(&seed);
  know(&k);
  long wrong = try_choices(&k);
  ok(tap, !wrong && count_faces(&k) > 0,
     "samples beside a side that is seen edge-on: %ld samples differ", wrong);
  forget(&k);
}

static void add_triangle(struct hsr_scene *scene, const double xyz[3][3]) {
  struct hsr_object *object = hsr_scene_object(scene, "triangle");
  uint32_t vertex[3];
  for (int c = 0; c < 3; c++)
    hsr_object_vertex(object, xyz[c][0], xyz[c][1], xyz[c][2], &vertex[c]);
  hsr_object_face(object, vertex, 3, NULL);
}

/* A screen across x: flat, of two triangles; or bent, and so loose. */
static void add_screen(struct hsr_scene *scene, double x, const double y[2],
                       const double z[2], double bent) {
  struct hsr_object *object = hsr_scene_object(scene, "screen");
  uint32_t v[4];
  for (int c = 0; c < 4; c++)
    hsr_object_vertex(object, c == 2 ? x + bent : x, y[c == 1 || c == 2],
                      z[c >= 2], &v[c]);
  const uint32_t half[3] = {v[0], v[2], v[3]};
  hsr_object_face(object, v, bent > 0 ? 4 : 3, NULL);
  if (bent == 0)
    hsr_object_face(object, half, 3, NULL);
}

/* A beam lies along the upper edge of its cell, and its own cube reaches into
 * the cell above. There a screen is in front of that cube, although its cell
 * comes later. A bent screen, which is drawn first, is between the two:
 *
 *       z  +-----------+-----------+
 *          |           |           |
 *          |           +-----------+ the beam's cube
 *          |   .screen | bent      |
 *       16 +-----------+-----------+
 *     eye              |   beam    |
 *          +-----------+-----------+
 *          0           16          32 x */
static struct hsr_scene *overhang(void) {
  static const double cell[3][3] = {{0, 16, 0}, {16, 32, 16}, {0, 32, 0}};
  static const double beam[3][3] = {{16, 0, 14}, {32, 0, 14}, {32, 16, 15.5}};
  static const double corner[3][3] = {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  static const double y[2] = {1, 3.875}, z[2] = {17, 18};
  static const double bent_y[2] = {0.5, 7.5}, bent_z[2] = {16.5, 23.5};
  struct hsr_scene *scene = hsr_scene_new("overhang");
  add_triangle(scene, cell);
  add_triangle(scene, beam);
  add_screen(scene, 4, y, z, 0);
  add_screen(scene, 13, bent_y, bent_z, 0.25);
  add_triangle(scene, corner);
  for (int v = 0; v < VIEWS; v++) {
    struct hsr_camera camera = {.eye = {-20, 4.01, 10.02},
                                .at = {13, 4 + 0.5 * v, 21},
                                .up = {0, 1, 0.01},
                                .fov = 4};
    if (hsr_scene_view(scene, &camera))
      bail("overhang: no view");
  }
  must_finish(scene);
  return scene;
}

static void test_overhang(struct tap *tap) {
  static struct known k;
  k.scene = overhang();
  know(&k);
  long wrong = try_choices(&k);
  ok(tap, !wrong && count_faces(&k) == (long)VIEWS * M * N,
     "a cube that reaches into another's place: %ld samples differ", wrong);
  forget(&k);
}

/* --- Ties ----------------------------------------------------------------- */

/* Rooms in a row. Their two walls are on the sides of their cubes, and so on
 * those of the next cubes. Where two walls coincide, the first one is seen from
 * both ends, although its cube may come last. */
static struct hsr_scene *rooms(int axis, double aside) {
  struct hsr_scene *scene = hsr_scene_new("rooms");
  struct hsr_object *room = hsr_scene_object(scene, "room");
  int b = (axis + 1) % 3, c = (axis + 2) % 3;
  for (int wall = 0; wall < 2; wall++) {
    uint32_t vertex[4];
    for (int k = 0; k < 4; k++) {
      double p[3];
      p[axis] = 16 * wall;
      p[b] = k == 1 || k == 2 ? 16 : 0;
      p[c] = k >= 2 ? 16 : 0;
      hsr_object_vertex(room, p[0], p[1], p[2], &vertex[k]);
    }
    const uint32_t half[3] = {vertex[0], vertex[2], vertex[3]};
    hsr_object_face(room, vertex, 3, NULL);
    hsr_object_face(room, half, 3, NULL);
  }
  for (int k = 0; k < 4; k++) {
    double m[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    m[4 * axis + 3] = 16 * k;
    hsr_scene_instance(scene, 0, m);
  }
  for (int v = 0; v < VIEWS; v++) { /* from the second room and the third */
    struct hsr_camera camera = {.fov = 90};
    camera.eye[axis] = v ? 40 : 24;
    camera.eye[b] = camera.at[b] = 8.25 + aside;
    camera.eye[c] = 8.125;
    camera.at[c] = 8.125 - 2 * aside;
    camera.at[axis] = v ? 0 : 64;
    camera.up[c] = 1;
    if (hsr_scene_view(scene, &camera))
      bail("rooms: no view");
  }
  must_finish(scene);
  return scene;
}

static void test_ties(struct tap *tap) {
  static struct known k;
  long wrong = 0, faces = 0;
  for (int axis = 0; axis < 3; axis++)
    for (int aside = 0; aside < 3; aside++) {
      k.scene = rooms(axis, 1.5 * aside);
      know(&k);
      faces += count_faces(&k);
      wrong += try_choices(&k);
      forget(&k);
    }
  ok(tap, !wrong && faces > 9 * M * N,
     "walls on the sides of cubes: %ld samples differ", wrong);
}

/* --- Windows -------------------------------------------------------------- */

static void test_windows(struct tap *tap, const char *name) {
  static const int sizes[] = {1, 7, 32, 64};
  static const char *const in_windows[] = {
      "hzbuffer",
      "hzbuffer:cubes=sides:pyramid=dual:polygons=definitive",
      "hzbuffer:pyramid=off:placement=enclosing",
      "hzbuffer:pyramid=masked",
      "hzbuffer:pyramid=maps:occluders=30",
      "clark"};
  struct known *k = open_known(name);
  long wrong = 0;
  for (int c = 0; c < 6; c++) {
    struct hsr_variant variant;
    struct hsr_setup setup;
    struct hsr_error err = {.text = "out of memory"};
    uint32_t ids[M * N];
    if (hsr_variant_parse(in_windows[c], &variant, &err))
      bail("%s: %s", name, err.text);
    must_setup(&setup, variant.listed->plain, &variant.choice, &k->outline);
    for (int s = 0; s < 4; s++) {
      int threads = s % 2 ? THREADS : 1;
      draw_in_windows(&setup, &k->view[1], sizes[s], threads, ids);
      long bad = count_differences(&k->view[1], ids, k->right[1]);
      if (bad)
        printf("# %s, %s: %ld samples differ in windows of %d\n", name,
               in_windows[c], bad, sizes[s]);
      wrong += bad;
    }
    hsr_setup_free(&setup);
  }
  ok(tap, !wrong, "%s in windows of 1, 7, 32 and all: %ld samples differ", name,
     wrong);
  forget(k);
}

int main(void) {
  static const char *const small[] = {"soup:120:4", "house", "lattice:60:2",
                                      "non-planar"};
  static const char *const windowed[] = {"house", "office:2", "soup:400:2"};
  enum {
    SMALL = sizeof small / sizeof *small,
    WINDOWED = sizeof windowed / sizeof *windowed
  };
  struct tap tap = plan(SMALL + 4 + WINDOWED);
  uint64_t seed = 33;
  for (int k = 0; k < SMALL; k++)
    test_options(&tap, small[k]);
  test_instances(&tap, &seed);
  test_beside(&tap);
  test_overhang(&tap);
  test_ties(&tap);
  for (int k = 0; k < WINDOWED; k++)
    test_windows(&tap, windowed[k]);
  return finish(&tap);
}
