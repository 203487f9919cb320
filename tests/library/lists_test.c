/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the library says that there is, and scenes and cameras. Through hsr.h
 * alone. */
#include "tests/library/public.h"

#include <math.h>

/* Whether info about item `end` is refused and the struct left alone. */
#define ENDS(call, info) ((call) == HSR_E_USAGE && !(info).name)

static size_t count_builtins(void) {
  struct hsr_builtin_info info = {.size = sizeof info};
  size_t n = 0;
  while (!hsr_get_builtin(n, &info, NULL) && info.name && info.usage &&
         info.about)
    n++;
  return n;
}

static size_t count_kinds(void) {
  struct hsr_kind_info info = {.size = sizeof info};
  size_t n = 0;
  while (!hsr_get_kind(n, &info, NULL) && info.name && info.meaning &&
         info.places)
    n++;
  return n;
}

/* Whether a request may have such a text: it is read before the view, which is
 * not there. */
static bool is_read(const struct hsr_scene *scene, const char *text) {
  struct hsr_request request = request_of(text, 4, 3);
  struct hsr_answer *answer = NULL;
  struct hsr_error err = {.text = ""};
  request.view = 1000000;
  bool read = hsr_draw(scene, &request, &answer, &err) == HSR_E_USAGE &&
              strstr(err.text, "there is no view");
  if (!read)
    printf("# %s\n", err.text);
  return read;
}

/* Whether all words of an option can be chosen and have a meaning, and there
 * are no more. */
static bool words_are_said(const struct hsr_scene *scene, size_t a, size_t o,
                           const char *algorithm,
                           const struct hsr_option_info *option) {
  struct hsr_word_info word = {.size = sizeof word};
  for (size_t w = 0; w < option->n_words; w++) {
    char text[300];
    if (hsr_get_word(a, o, w, &word, NULL) || !word.meaning)
      return false;
    snprintf(text, sizeof text, "%s:%s=%s", algorithm, option->name, word.name);
    if (!is_read(scene, text))
      return false;
  }
  return hsr_get_word(a, o, option->n_words, &word, NULL) == HSR_E_USAGE;
}

static bool options_are_said(const struct hsr_scene *scene, size_t a,
                             const struct hsr_algorithm_info *algorithm) {
  struct hsr_option_info option = {.size = sizeof option};
  for (size_t o = 0; o < algorithm->n_options; o++) {
    if (hsr_get_option(a, o, &option, NULL) || !option.name || !option.meaning)
      return false;
    bool in_range =
        option.standard >= option.least && option.standard <= option.most;
    if (!option.n_words && !in_range)
      return false;
    if (option.n_words && option.standard >= (double)option.n_words)
      return false;
    if (!words_are_said(scene, a, o, algorithm->name, &option))
      return false;
  }
  return hsr_get_option(a, algorithm->n_options, &option, NULL) == HSR_E_USAGE;
}

static bool counters_are_said(size_t a,
                              const struct hsr_algorithm_info *algorithm) {
  struct hsr_counter_info c = {.size = sizeof c};
  for (size_t k = 0; k < algorithm->n_counters; k++)
    if (hsr_get_counter(a, k, &c, NULL) || !c.name || !c.meaning || !c.step ||
        !c.a || !c.b || (c.line > 0) != (c.line_text != NULL))
      return false;
  return hsr_get_counter(a, algorithm->n_counters, &c, NULL) == HSR_E_USAGE;
}

static void test_algorithms(struct tap *tap) {
  struct hsr_algorithm_info info = {.size = sizeof info};
  struct hsr_scene *scene = open_scene("coplanar");
  size_t n = 0, found = 0, oracles = 0;
  bool said = true, options = true, counters = true;
  for (; !hsr_get_algorithm(n, &info, NULL); n++) {
    said = said && info.name && info.title && info.class_name &&
           info.kinds >> info.kind & 1;
    options = options && options_are_said(scene, n, &info);
    counters = counters && counters_are_said(n, &info);
    oracles += info.is_oracle > 0;
    size_t k = 0;
    found += !hsr_find_algorithm(info.name, &k, NULL) && k == n;
  }
  hsr_close(scene);
  struct hsr_error err = {.text = ""};
  size_t k = 7;
  ok(tap, n > 50 && found == n, "%zu algorithms are listed and found by name",
     n);
  ok(tap, said && oracles > 5, "they have names and kinds; %zu are oracles",
     oracles);
  ok(tap, options, "their options and words have meanings");
  ok(tap, counters, "their counters have meanings");
  ok(tap,
     hsr_find_algorithm("watkin", &k, &err) == HSR_E_USAGE && k == 7 &&
         strstr(err.text, "watkins"),
     "one that is misspelt is refused: %s", err.text);
  ok(tap,
     hsr_find_algorithm("watkins:x-list=tree", &k, NULL) == HSR_E_USAGE &&
         hsr_find_algorithm(NULL, &k, NULL) == HSR_E_USAGE &&
         hsr_find_algorithm("watkins", NULL, NULL) == HSR_E_USAGE,
     "a name is without options, and nothing is NULL");
}

static void test_lists(struct tap *tap) {
  struct hsr_builtin_info builtin = {.size = sizeof builtin};
  struct hsr_kind_info kind = {.size = sizeof kind};
  struct hsr_algorithm_info small = {.size = 8};
  size_t big = SIZE_MAX;
  ok(tap, strlen(hsr_version()) > 2, "the version is %s", hsr_version());
  ok(tap, count_builtins() > 30, "%zu scenes are listed", count_builtins());
  ok(tap, count_kinds() == 9, "%zu kinds of answers are listed", count_kinds());
  ok(tap,
     ENDS(hsr_get_builtin(big, &builtin, NULL), builtin) &&
         ENDS(hsr_get_kind(big, &kind, NULL), kind) &&
         hsr_get_algorithm(big, &small, NULL) == HSR_E_USAGE &&
         hsr_get_option(big, 0, NULL, NULL) == HSR_E_USAGE &&
         hsr_get_word(big, 0, 0, NULL, NULL) == HSR_E_USAGE &&
         hsr_get_word(0, big, 0, NULL, NULL) == HSR_E_USAGE &&
         hsr_get_counter(big, 0, NULL, NULL) == HSR_E_USAGE,
     "what is beyond an end is refused");
  ok(tap,
     hsr_get_builtin(0, NULL, NULL) == HSR_E_USAGE &&
         hsr_get_kind(0, NULL, NULL) == HSR_E_USAGE &&
         hsr_get_algorithm(0, NULL, NULL) == HSR_E_USAGE,
     "NULL is refused");
  ok(tap, hsr_get_algorithm(0, &small, NULL) == HSR_E_USAGE,
     "a struct that is too small is refused");
}

/* A struct of a later version. */
struct later {
  struct hsr_kind_info info;
  char more[16];
};

static void test_sizes(struct tap *tap) {
  struct later later = {.info = {.size = sizeof later}, .more = "xyz"};
  struct {
    struct hsr_open_options options;
    char more[16];
  } options = {.options = {.size = sizeof options}};
  struct hsr_scene *scene = NULL;
  ok(tap,
     !hsr_get_kind(0, &later.info, NULL) && later.info.name && !later.more[0] &&
         !later.more[2],
     "what a later version has is filled with 0");
  ok(tap, !hsr_open("house", &options.options, &scene, NULL),
     "what a later version may ask for is 0");
  hsr_close(scene);
  options.more[3] = 1;
  ok(tap, hsr_open("house", &options.options, &scene, NULL) == HSR_E_USAGE,
     "or is refused");
}

/* --- Scenes --------------------------------------------------------------- */

static void test_scenes(struct tap *tap) {
  struct hsr_scene_info info = {.size = sizeof info};
  struct hsr_scene *scene = open_scene("soup:100:7");
  ok(tap,
     !hsr_get_scene(scene, &info, NULL) && info.n_faces == 100 &&
         info.n_vertices == 300 && info.n_views > 0 && info.n_objects == 1 &&
         !info.is_grid && !strcmp(info.name, "soup:100:7") && !*info.notes,
     "a soup has as many faces as its name says");
  ok(tap,
     hsr_get_scene(NULL, &info, NULL) == HSR_E_USAGE &&
         hsr_get_scene(scene, NULL, NULL) == HSR_E_USAGE,
     "NULL is refused");
  hsr_close(scene);
  struct hsr_error err = {.text = ""};
  scene = (struct hsr_scene *)&info;
  ok(tap,
     hsr_open("no-such-scene", NULL, &scene, &err) == HSR_E_INPUT && !scene &&
         err.status == HSR_E_INPUT,
     "a scene that is not there: %s", err.text);
  ok(tap, hsr_open("house@eye=1,2", NULL, &scene, &err) == HSR_E_USAGE,
     "a camera that is wrong: %s", err.text);
  ok(tap, hsr_open("no-such-file.off", NULL, &scene, &err) == HSR_E_INPUT,
     "a file that is not there: %s", err.text);
  ok(tap,
     hsr_open(NULL, NULL, &scene, NULL) == HSR_E_USAGE &&
         hsr_open("house", NULL, NULL, NULL) == HSR_E_USAGE,
     "NULL is refused");
  struct hsr_open_options options = {.size = sizeof options, .threads = 65};
  ok(tap, hsr_open("house", &options, &scene, NULL) == HSR_E_USAGE,
     "too many threads are refused");
  hsr_close(NULL);
}

static void test_files(struct tap *tap) {
  static const char text[] = "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n2 0 0\n"
                             "3 0 1 2\n3 0 1 3\n";
  struct hsr_open_options options = {.size = sizeof options};
  struct hsr_scene_info info = {.size = sizeof info};
  struct hsr_error err = {.text = ""};
  struct hsr_scene *scene = NULL;
  FILE *file = fopen("library-lists.off", "w");
  if (file) {
    fputs(text, file);
    fclose(file);
  }
  ok(tap,
     !hsr_open("library-lists.off", NULL, &scene, NULL) &&
         !hsr_get_scene(scene, &info, NULL) && info.n_faces == 1 &&
         info.n_dropped == 1,
     "a face without area is left out and counted");
  hsr_close(scene);
  options.strict = 1;
  ok(tap, hsr_open("library-lists.off", &options, &scene, &err) == HSR_E_INPUT,
     "or refused: %s", err.text);
  hsr_close(scene);
  options = (struct hsr_open_options){.size = sizeof options,
                                      .path = "library-lists.off"};
  ok(tap,
     !hsr_open("-.off", &options, &scene, NULL) &&
         !hsr_get_scene(scene, &info, NULL) && info.n_faces == 1 &&
         !strcmp(info.name, "-.off"),
     "a scene may have another name than its file");
  hsr_close(scene);
  options.weld = 1.5;
  ok(tap, hsr_open("-.off", &options, &scene, &err) == HSR_E_INPUT,
     "all vertices are joined, so no face is left: %s", err.text);
  hsr_close(scene);
  options.weld = -1;
  ok(tap, hsr_open("-.off", &options, &scene, &err) == HSR_E_USAGE,
     "no distance: %s", err.text);
  hsr_close(scene);
  remove("library-lists.off");
}

static void test_cameras(struct tap *tap) {
  struct hsr_scene *scene = open_scene("house");
  struct hsr_camera camera = {.size = sizeof camera};
  ok(tap,
     !hsr_get_camera(scene, 0, &camera, NULL) && camera.fov > 0 &&
         fabs(camera.eye[0]) + fabs(camera.eye[1]) + fabs(camera.eye[2]) > 0,
     "the house has a camera");
  ok(tap,
     hsr_get_camera(scene, 1000, &camera, NULL) == HSR_E_USAGE &&
         hsr_get_camera(NULL, 0, &camera, NULL) == HSR_E_USAGE &&
         hsr_get_camera(scene, 0, NULL, NULL) == HSR_E_USAGE,
     "another is refused, and NULL");
  hsr_close(scene);
}

/* --- Arrays --------------------------------------------------------------- */

static const double corners[] = {0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4,
                                 0, 1, 1, 1, 3, 1, 1, 2, 3, 1};
static const uint32_t rings[] = {4, 3}, vertices[] = {0, 1, 2, 3, 4, 5, 6};
static const float colours[] = {1, 0, 0, 0, 0.5f, 1};

static struct hsr_arrays two_faces(void) {
  struct hsr_arrays arrays = {.size = sizeof arrays,
                              .name = "two",
                              .xyz = corners,
                              .n_vertices = 7,
                              .ring = rings,
                              .n_faces = 2,
                              .vertex = vertices,
                              .n_corners = 7,
                              .rgb = colours};
  return arrays;
}

/* The status of making a scene of arrays. */
static enum hsr_status status_of(const struct hsr_arrays *arrays,
                                 struct hsr_error *err) {
  struct hsr_scene *scene = NULL;
  enum hsr_status status = hsr_open_arrays(arrays, NULL, &scene, err);
  if (!status != !!scene)
    status = HSR_E_INTERNAL;
  hsr_close(scene);
  return status;
}

/* The triangle is in front of the square. */
static bool is_seen(struct hsr_scene *scene) {
  struct hsr_camera camera = {.size = sizeof camera,
                              .eye = {2, 2, 10},
                              .at = {2, 2, 0},
                              .up = {0, 1, 0},
                              .parallel = 6};
  struct hsr_request request = request_of("zbuffer", 30, 30);
  struct hsr_answer *answer = NULL;
  const uint32_t *ids = NULL;
  float rgb[2700];
  request.camera = &camera;
  bool good = !hsr_draw(scene, &request, &answer, NULL) &&
              !hsr_get_ids(answer, &ids, NULL) &&
              !hsr_get_colours(answer, HSR_COLOUR_FLAT, rgb, 2700, NULL);
  good = good && ids[0] == HSR_NO_FACE && ids[15 * 30 + 15] == 1 &&
         ids[15 * 30 + 6] == 0 && rgb[3 * (15 * 30 + 6)] == 1 &&
         rgb[3 * (15 * 30 + 15) + 1] == 0.5f;
  hsr_free(answer);
  return good;
}

static void test_arrays(struct tap *tap) {
  struct hsr_arrays arrays = two_faces();
  struct hsr_scene_info info = {.size = sizeof info};
  struct hsr_scene *scene = NULL;
  ok(tap,
     !hsr_open_arrays(&arrays, NULL, &scene, NULL) &&
         !hsr_get_scene(scene, &info, NULL) && info.n_faces == 2 &&
         info.n_vertices == 7 && !strcmp(info.name, "two"),
     "a square and a triangle are a scene");
  ok(tap, is_seen(scene), "and are seen, in their colours");
  hsr_close(scene);
  arrays.name = NULL;
  arrays.rgb = NULL;
  arrays.ring = NULL;
  arrays.vertex += 4;
  arrays.n_faces = 1;
  arrays.n_corners = 3;
  ok(tap, !status_of(&arrays, NULL), "without a name, colours and rings too");
}

/* The face in the middle of a picture of 4 x 4 world units around (x, 2). */
static uint32_t face_at(struct hsr_scene *scene, double x) {
  struct hsr_camera camera = {.size = sizeof camera,
                              .eye = {x, 2, 10},
                              .at = {x, 2, 0},
                              .up = {0, 1, 0},
                              .parallel = 4};
  struct hsr_request request = request_of("zbuffer", 9, 9);
  struct hsr_answer *answer = NULL;
  const uint32_t *ids = NULL;
  uint32_t face = HSR_NO_FACE - 1;
  request.camera = &camera;
  if (!hsr_draw(scene, &request, &answer, NULL) &&
      !hsr_get_ids(answer, &ids, NULL))
    face = ids[4 * 9 + 4];
  hsr_free(answer);
  return face;
}

/* --- Geometry ------------------------------------------------------------- */

/* Whether the exact picture of the glass is the same. */
static bool is_seen_alike(struct hsr_scene *a, struct hsr_scene *b) {
  struct hsr_camera camera = {.size = sizeof camera};
  struct hsr_request request = request_of("transparent-oracle", 30, 20);
  struct hsr_answer *answer[2] = {NULL, NULL};
  const uint16_t *rgba[2];
  int channels = 0;
  request.camera = &camera;
  bool good = !hsr_get_camera(a, 0, &camera, NULL) &&
              !hsr_draw(a, &request, &answer[0], NULL) &&
              !hsr_draw(b, &request, &answer[1], NULL);
  for (int k = 0; k < 2 && good; k++)
    good = !hsr_get_rgba(answer[k], &rgba[k], &channels, NULL);
  good = good && !memcmp(rgba[0], rgba[1], 2 * 3 * 600);
  hsr_free(answer[0]);
  hsr_free(answer[1]);
  return good;
}

/* A scene of the geometry of another. */
static struct hsr_scene *scene_of(const struct hsr_geometry *g) {
  struct hsr_scene *scene = NULL;
  hsr_open_arrays(&(struct hsr_arrays){.size = sizeof(struct hsr_arrays),
                                       .xyz = g->xyz,
                                       .n_vertices = g->n_vertices,
                                       .ring = g->ring,
                                       .n_faces = g->n_faces,
                                       .vertex = g->vertex,
                                       .n_corners = g->n_corners,
                                       .rgb = g->rgb,
                                       .opacity = g->opacity},
                  &(struct hsr_open_options){
                      .size = sizeof(struct hsr_open_options), .two_sided = 1},
                  &scene, NULL);
  return scene;
}

static void test_geometry(struct tap *tap) {
  struct hsr_geometry g = {.size = sizeof g}, again = {.size = sizeof again};
  struct hsr_open_options options = {.size = sizeof options, .two_sided = 1};
  struct hsr_scene *scene = NULL, *made = NULL;
  ok(tap,
     !hsr_open("greenhouse", &options, &scene, NULL) &&
         !hsr_get_geometry(scene, &g, NULL) && g.n_faces > 10 && g.n_objects &&
         g.object[g.n_faces - 1] < g.n_objects && *g.object_name[0],
     "the faces of a scene are arrays");
  size_t n = 0;
  for (size_t f = 0; f < g.n_faces; f++)
    n += g.ring[f];
  ok(tap, n == g.n_corners, "as many corners as the rings have");
  made = scene_of(&g);
  ok(tap, made && is_seen_alike(scene, made),
     "and make the same scene, with its opacity");
  ok(tap,
     !hsr_get_geometry(scene, &again, NULL) && again.xyz == g.xyz &&
         again.opacity == g.opacity,
     "asked again, they are the same arrays");
  ok(tap,
     hsr_get_geometry(NULL, &g, NULL) == HSR_E_USAGE &&
         hsr_get_geometry(scene, NULL, NULL) == HSR_E_USAGE,
     "NULL is refused");
  hsr_close(made);
  hsr_close(scene);
}

/* How many faces of a built-in scene are one-sided: none, some or all. */
static const char *sides_of(const char *name, int two_sided) {
  const struct hsr_open_options options = {.size = sizeof options,
                                           .two_sided = two_sided};
  struct hsr_geometry g = {.size = sizeof g};
  struct hsr_scene *scene = NULL;
  size_t n = 0;
  if (hsr_open(name, &options, &scene, NULL) ||
      hsr_get_geometry(scene, &g, NULL))
    return "not opened";
  for (size_t f = 0; f < g.n_faces; f++)
    n += g.one_sided[f] != 0;
  const char *found = !n ? "none" : n < g.n_faces ? "some" : "all";
  hsr_close(scene);
  return found;
}

static void test_sides(struct tap *tap, const char *name, int two_sided,
                       const char *expected) {
  const char *found = sides_of(name, two_sided);
  ok(tap, !strcmp(found, expected), "%s%s: %s of its faces are one-sided", name,
     two_sided ? ", made two-sided" : "", found);
}

static void test_opacity(struct tap *tap) {
  static const float opacity[] = {1, 0.25f}, wrong[] = {1, 1.5f};
  struct hsr_arrays arrays = two_faces();
  struct hsr_scene_info info = {.size = sizeof info};
  struct hsr_geometry g = {.size = sizeof g};
  struct hsr_error err = {.text = ""};
  struct hsr_scene *scene = NULL;
  arrays.opacity = opacity;
  ok(tap,
     !hsr_open_arrays(&arrays, NULL, &scene, NULL) &&
         !hsr_get_scene(scene, &info, NULL) && info.is_transparent &&
         !hsr_get_geometry(scene, &g, NULL) && g.opacity[0] == 1 &&
         g.opacity[1] == 0.25f,
     "faces of arrays have an opacity");
  hsr_close(scene);
  arrays.opacity = wrong;
  ok(tap, status_of(&arrays, &err) == HSR_E_INPUT && strstr(err.text, "face 1"),
     "%s", err.text);
}

/* Two places: as they are, and 10 to the right, twice as wide. */
static void test_instances(struct tap *tap) {
  static const double places[] = {1, 0, 0, 0,  0, 1, 0, 0, 0, 0, 1, 0,
                                  2, 0, 0, 10, 0, 1, 0, 0, 0, 0, 1, 0};
  struct hsr_arrays arrays = two_faces();
  struct hsr_scene_info info = {.size = sizeof info};
  struct hsr_error err = {.text = ""};
  struct hsr_scene *scene = NULL;
  arrays.instance = places;
  arrays.n_instances = 2;
  ok(tap,
     !hsr_open_arrays(&arrays, NULL, &scene, NULL) &&
         !hsr_get_scene(scene, &info, NULL) && info.n_faces == 4 &&
         info.n_objects == 1 && info.n_instances == 2,
     "two instances are a scene");
  ok(tap,
     face_at(scene, 0.5) == 0 && face_at(scene, 2) == 1 &&
         face_at(scene, 11) == 2 && face_at(scene, 14) == 3 &&
         face_at(scene, 17) == 2 && face_at(scene, 8) == HSR_NO_FACE,
     "face f of instance k is f + k n_faces, where M puts it");
  hsr_close(scene);
  double wrong[24];
  memcpy(wrong, places, sizeof wrong);
  wrong[17] = NAN;
  arrays.instance = wrong;
  ok(tap,
     status_of(&arrays, &err) == HSR_E_INPUT && strstr(err.text, "instance 1"),
     "%s", err.text);
  arrays.instance = NULL;
  bool refused = status_of(&arrays, NULL) == HSR_E_USAGE;
  arrays.instance = places;
  arrays.n_instances = SIZE_MAX;
  ok(tap, refused && status_of(&arrays, &err) == HSR_E_USAGE, "%s", err.text);
}

/* --- Grids ---------------------------------------------------------------- */

/* Samples at x = 0, 1, 4 and y = z = 0, 1. Those of 5 and more are kept: two
 * that touch, and one behind the first. */
static const double grid_x[] = {0, 1, 4};
static const float densities[] = {5, 6, 0, 0, 0, 0, 7, NAN, 0, 0, 0, 1};

static struct hsr_grid_arrays three_boxes(void) {
  struct hsr_grid_arrays grid = {.size = sizeof grid,
                                 .n = {3, 2, 2},
                                 .at = {grid_x, NULL, NULL},
                                 .density = densities,
                                 .least = 5,
                                 .most = INFINITY};
  return grid;
}

static enum hsr_status status_of_grid(const struct hsr_grid_arrays *grid,
                                      struct hsr_error *err) {
  struct hsr_scene *scene = NULL;
  enum hsr_status status = hsr_open_grid(grid, NULL, &scene, err);
  if (!status != !!scene)
    status = HSR_E_INTERNAL;
  hsr_close(scene);
  return status;
}

/* The face that is seen along an axis from outside at a point, and its depth
 * from 10 away. */
static uint32_t side_at(struct hsr_scene *scene, const double at[3], int axis,
                        double sign, double *depth) {
  struct hsr_camera camera = {.size = sizeof camera, .parallel = 0.01};
  struct hsr_request request = request_of("zbuffer", 3, 3);
  struct hsr_answer *answer = NULL;
  const uint32_t *ids = NULL;
  float depths[9] = {0};
  uint32_t face = HSR_NO_FACE - 1;
  memcpy(camera.eye, at, sizeof camera.eye);
  memcpy(camera.at, at, sizeof camera.at);
  camera.eye[axis] = sign * 10;
  camera.up[(axis + 1) % 3] = 1;
  request.camera = &camera;
  if (!hsr_draw(scene, &request, &answer, NULL) &&
      !hsr_get_ids(answer, &ids, NULL) &&
      !hsr_get_depths(answer, depths, 9, NULL))
    face = ids[4];
  hsr_free(answer);
  *depth = depths[4];
  return face;
}

/* Box 0 is x -0.5 to 0.5; box 1 is 0.5 to 2.5 and touches it; box 6 is behind
 * box 0, and touches it too. So box 0 has sides 0 to 3, box 1 has 4 to 8, box 6
 * has 9 to 13. */
static bool sides_are_right(struct hsr_scene *scene) {
  static const struct {
    double at[3];
    int axis, sign;
    uint32_t face;
    double depth;
  } seen[] = {{{0, 0, 0}, 0, -1, 0, 9.5},  {{0, 0, 0}, 1, -1, 1, 9.5},
              {{0, 0, 0}, 1, 1, 2, 9.5},   {{0, 0, 0}, 2, -1, 3, 9.5},
              {{1.5, 0, 0}, 0, 1, 4, 7.5}, {{1.5, 0, 0}, 1, -1, 5, 9.5},
              {{1.5, 0, 0}, 1, 1, 6, 9.5}, {{1.5, 0, 0}, 2, -1, 7, 9.5},
              {{1.5, 0, 0}, 2, 1, 8, 9.5}, {{0, 0, 1}, 0, -1, 9, 9.5},
              {{0, 0, 1}, 0, 1, 10, 9.5},  {{0, 0, 1}, 1, -1, 11, 9.5},
              {{0, 0, 1}, 1, 1, 12, 9.5},  {{0, 0, 1}, 2, 1, 13, 8.5}};
  bool good = true;
  for (size_t k = 0; k < sizeof seen / sizeof *seen; k++) {
    double depth;
    uint32_t face =
        side_at(scene, seen[k].at, seen[k].axis, seen[k].sign, &depth);
    if (face == seen[k].face && depth == seen[k].depth)
      continue;
    printf("# %zu: face %u at depth %g\n", k, face, depth);
    good = false;
  }
  return good;
}

static void test_grids(struct tap *tap) {
  struct hsr_grid_arrays grid = three_boxes();
  struct hsr_scene_info info = {.size = sizeof info};
  struct hsr_scene *scene = NULL;
  ok(tap,
     !hsr_open_grid(&grid, NULL, &scene, NULL) &&
         !hsr_get_scene(scene, &info, NULL) && info.is_grid &&
         info.n_faces == 14 && !strcmp(info.name, "grid"),
     "three boxes have 14 sides that nothing covers");
  ok(tap, sides_are_right(scene), "they are numbered and placed as hsr.h says");
  hsr_close(scene);
}

static void test_wrong_grids(struct tap *tap) {
  static const double back[] = {0, 2, 1};
  static const float red[36] = {[35] = 2};
  struct hsr_error err = {.text = ""};
  struct hsr_grid_arrays wrong = three_boxes();
  wrong.at[0] = back;
  ok(tap, status_of_grid(&wrong, &err) == HSR_E_INPUT, "%s", err.text);
  wrong = three_boxes();
  wrong.rgb = red;
  ok(tap, status_of_grid(&wrong, &err) == HSR_E_INPUT, "%s", err.text);
  wrong = three_boxes();
  wrong.least = 100;
  ok(tap, status_of_grid(&wrong, &err) == HSR_E_INPUT, "%s", err.text);
  wrong.most = 99;
  ok(tap, status_of_grid(&wrong, &err) == HSR_E_USAGE, "%s", err.text);
  wrong.least = NAN;
  bool refused = status_of_grid(&wrong, NULL) == HSR_E_USAGE;
  wrong = three_boxes();
  wrong.n[1] = 0;
  refused = refused && status_of_grid(&wrong, NULL) == HSR_E_USAGE;
  wrong.n[1] = UINT32_MAX;
  ok(tap, refused && status_of_grid(&wrong, &err) == HSR_E_USAGE, "%s",
     err.text);
  wrong = three_boxes();
  wrong.density = NULL;
  ok(tap,
     status_of_grid(&wrong, NULL) == HSR_E_USAGE &&
         status_of_grid(NULL, NULL) == HSR_E_USAGE &&
         hsr_open_grid(&wrong, NULL, NULL, NULL) == HSR_E_USAGE,
     "NULL is refused");
  wrong = three_boxes();
}

/* --- What is wrong with arrays -------------------------------------------- */

static void test_wrong_lengths(struct tap *tap) {
  struct hsr_error err = {.text = ""};
  struct hsr_arrays wrong = two_faces();
  wrong.n_corners = 8;
  ok(tap, status_of(&wrong, &err) == HSR_E_USAGE, "%s", err.text);
  wrong = two_faces();
  wrong.n_faces = 0;
  ok(tap, status_of(&wrong, &err) == HSR_E_USAGE, "%s", err.text);
  wrong = two_faces();
  wrong.n_vertices = SIZE_MAX;
  ok(tap, status_of(&wrong, &err) == HSR_E_USAGE, "%s", err.text);
  wrong = two_faces();
  wrong.xyz = NULL;
  bool refused = status_of(&wrong, NULL) == HSR_E_USAGE;
  wrong = two_faces();
  wrong.vertex = NULL;
  ok(tap,
     refused && status_of(&wrong, NULL) == HSR_E_USAGE &&
         status_of(NULL, NULL) == HSR_E_USAGE &&
         hsr_open_arrays(&wrong, NULL, NULL, NULL) == HSR_E_USAGE,
     "NULL is refused");
  wrong = two_faces();
}

static void test_wrong_contents(struct tap *tap) {
  struct hsr_error err = {.text = ""};
  double xyz[21];
  uint32_t vertex[7] = {0, 1, 2, 3, 4, 5, 7}, ring[2] = {5, 2};
  float rgb[6] = {0, 0, 0, 2, 0, 0};
  struct hsr_arrays wrong = two_faces();
  wrong.vertex = vertex;
  ok(tap, status_of(&wrong, &err) == HSR_E_INPUT, "%s", err.text);
  vertex[6] = 5;
  ok(tap, status_of(&wrong, &err) == HSR_E_INPUT, "%s", err.text);
  wrong = two_faces();
  wrong.ring = ring;
  ok(tap, status_of(&wrong, &err) == HSR_E_INPUT, "%s", err.text);
  wrong = two_faces();
  wrong.rgb = rgb;
  ok(tap, status_of(&wrong, &err) == HSR_E_INPUT, "%s", err.text);
  wrong = two_faces();
  wrong.xyz = xyz;
  memcpy(xyz, corners, sizeof xyz);
  xyz[4] = NAN;
  ok(tap, status_of(&wrong, &err) == HSR_E_INPUT, "%s", err.text);
  xyz[4] = 1e31;
  ok(tap, status_of(&wrong, &err) == HSR_E_INPUT, "%s", err.text);
  memcpy(xyz, corners, sizeof xyz);
  memcpy(xyz + 18, (const double[]){2, 1, 1}, 3 * sizeof *xyz);
  ok(tap, status_of(&wrong, &err) == HSR_E_INPUT, "%s", err.text);
}

int main(void) {
  struct tap tap = plan(66);
  test_lists(&tap);
  test_algorithms(&tap);
  test_sizes(&tap);
  test_scenes(&tap);
  test_files(&tap);
  test_cameras(&tap);
  test_arrays(&tap);
  test_geometry(&tap);
  test_sides(&tap, "house", 0, "all");
  test_sides(&tap, "house", 1, "none");
  test_sides(&tap, "one-sided", 0, "some");
  test_sides(&tap, "soup:9", 0, "none");
  test_opacity(&tap);
  test_instances(&tap);
  test_grids(&tap);
  test_wrong_grids(&tap);
  test_wrong_lengths(&tap);
  test_wrong_contents(&tap);
  return finish(&tap);
}
