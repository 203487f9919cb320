/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scene files: a scene is read back bit for bit as it was written; members left
 * out have their defaults; faults are refused at the right place. */
#include "common/files/json/scene_json.h"
#include "common/scene/motion.h"
#include "tests/tap.h"

#include <jansson.h>

#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#define COUNT(array) ((int)(sizeof(array) / sizeof *(array)))

/* Ends the program if a step that a test needs, but does not test, fails. */
static void must(bool done) {
  if (!done)
    bail("the test cannot be set up: %s", strerror(errno));
}

static void write_bytes(const char *path, const char *bytes, size_t n) {
  FILE *file = fopen(path, "w");
  must(file && fwrite(bytes, 1, n, file) == n);
  must(!fclose(file));
}

static void write_text(const char *path, const char *text) {
  write_bytes(path, text, strlen(text));
}

static enum hsr_status read_file(struct hsr_scene **scene, const char *path,
                                 struct hsr_import *import,
                                 struct hsr_error *err) {
  *scene = hsr_scene_new("as opened");
  must(*scene);
  *err = (struct hsr_error){HSR_OK, ""};
  return hsr_scene_json_read(*scene, path, import, err);
}

static const char *const TETRAHEDRON =
    "\"vertices\": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]],"
    "\"faces\": [[0,2,1],[0,1,3],[1,2,3],[2,0,3]]";

/* ---- Round trip ---- */

static bool same(const void *a, const void *b, size_t n) {
  return n == 0 || !memcmp(a, b, n);
}

static bool same_object(const struct hsr_object *a,
                        const struct hsr_object *b) {
  return !strcmp(a->name, b->name) && a->n_vertices == b->n_vertices &&
         a->n_faces == b->n_faces && a->one_sided == b->one_sided &&
         a->moves == b->moves && !a->rgb == !b->rgb &&
         same(a->colour, b->colour, sizeof a->colour) &&
         same(a->xyz, b->xyz, 3 * sizeof(double) * a->n_vertices) &&
         same(a->start, b->start, sizeof(uint32_t) * (a->n_faces + 1)) &&
         same(a->vertex, b->vertex, sizeof(uint32_t) * a->start[a->n_faces]) &&
         (!a->rgb || same(a->rgb, b->rgb, 3 * sizeof(float) * a->n_faces)) &&
         a->opacity == b->opacity && !a->face_opacity == !b->face_opacity &&
         (!a->face_opacity ||
          same(a->face_opacity, b->face_opacity, sizeof(float) * a->n_faces));
}

/* Compares bits, so that -0 is not 0. */
static bool same_scene(const struct hsr_scene *a, const struct hsr_scene *b) {
  if (strcmp(a->name, b->name) != 0 || a->n_objects != b->n_objects ||
      a->n_instances != b->n_instances || a->n_views != b->n_views)
    return false;
  for (uint32_t o = 0; o < a->n_objects; o++)
    if (!same_object(&a->objects[o], &b->objects[o]))
      return false;
  for (uint32_t i = 0; i < a->n_instances; i++)
    if (a->instances[i].object != b->instances[i].object ||
        !same(a->instances[i].m, b->instances[i].m, sizeof a->instances[i].m))
      return false;
  return same(a->views, b->views, a->n_views * sizeof *a->views);
}

static uint64_t random_word(uint64_t *state) {
  uint64_t x = (*state += UINT64_C(0x9e3779b97f4a7c15));
  x = (x ^ x >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
  x = (x ^ x >> 27) * UINT64_C(0x94d049bb133111eb);
  return x ^ x >> 31;
}

/* Any finite double; all exponents are equally likely. */
static double random_double(uint64_t *state) {
  uint64_t word = random_word(state);
  if ((word >> 52 & 0x7ff) == 0x7ff)
    word ^= UINT64_C(1) << 62;
  double value;
  memcpy(&value, &word, sizeof value);
  return value;
}

static float random_channel(uint64_t *state) {
  return (float)(random_word(state) >> 40) / 16777216.0f;
}

static const double notable[] = {0.0,
                                 -0.0,
                                 0.1,
                                 1.0 / 3,
                                 1e30,
                                 -1e30,
                                 4.9406564584124654e-324,
                                 -2.2250738585072009e-308,
                                 2.2250738585072014e-308,
                                 1.7976931348623157e308,
                                 9007199254740993.0,
                                 123456789012345678.0,
                                 5e-324,
                                 12345678901.2345,
                                 1e22};

static void add_notable(struct hsr_scene *scene) {
  struct hsr_object *object =
      hsr_scene_object(scene, "\"q\\ \xc3\xa9 /~\n\x01 {}");
  must(object);
  for (int i = 0; i < COUNT(notable); i++)
    must(!hsr_object_vertex(object, notable[i], -notable[i], i, NULL));
  static const float colour[3] = {-0.0f, 1e-45f, 0.1f};
  memcpy(object->colour, colour, sizeof colour);
  for (uint32_t f = 0; f + 3 < object->n_vertices; f++)
    must(!hsr_object_face(object, (uint32_t[]){f, f + 1, f + 2, f + 3},
                          3 + f % 2, NULL));
}

static void add_random(struct hsr_scene *scene, const char *name,
                       bool one_sided) {
  uint64_t state = 7;
  struct hsr_object *object = hsr_scene_object(scene, name);
  must(object);
  object->one_sided = one_sided;
  object->moves = one_sided;
  for (int v = 0; v < 500; v++)
    must(!hsr_object_vertex(object, random_double(&state),
                            random_double(&state), random_double(&state),
                            NULL));
  for (uint32_t f = 0; f < 400; f++) {
    float rgb[3];
    for (int k = 0; k < 3; k++)
      rgb[k] = random_channel(&state);
    must(!hsr_object_face(object, (uint32_t[]){f, 499 - f / 8, f + 1}, 3, rgb));
    if (one_sided && f >= 20)
      must(!hsr_object_set_opacity(object, f, random_channel(&state)));
  }
}

static struct hsr_scene *complete_scene(void) {
  struct hsr_scene *scene = hsr_scene_new("complete: \xe2\x88\x9e");
  must(scene);
  add_notable(scene);
  add_random(scene, "twin", true);
  add_random(scene, "twin", false);
  must(hsr_scene_object(scene, "")); /* nothing in it */
  uint64_t state = 3;
  for (uint32_t i = 0; i < 40; i++) {
    double m[12];
    for (int k = 0; k < 12; k++)
      m[k] = i < 4 ? notable[k] : random_double(&state);
    must(!hsr_scene_instance(scene, i / 10, m));
  }
  must(!hsr_scene_view(
      scene, &(struct hsr_camera){
                 {-0.0, 0.1, 5}, {0, 0, -1e-320}, {0, -1, 0}, 44.9, 0.3}));
  must(!hsr_scene_view(
      scene, &(struct hsr_camera){{1e30, 2, 3}, {1, 2, 3}, {1, 1, 1}, 179, 0}));
  return scene;
}

static void test_round_trip(struct tap *tap) {
  struct hsr_scene *scene = complete_scene(), *back;
  struct hsr_error err = {HSR_OK, ""};
  ok(tap, !hsr_scene_json_write(scene, "whole.scene.json", &err),
     "a complete scene is written");
  ok(tap, access("whole.scene.json.part", F_OK) != 0,
     "no temporary file is left");
  ok(tap, !read_file(&back, "whole.scene.json", NULL, &err),
     "and read again%s%s", *err.text ? ": " : "", err.text);
  ok(tap, same_scene(scene, back), "every field is the same bit for bit");
  hsr_scene_delete(back);
  hsr_scene_delete(scene);

  scene = hsr_scene_new("nothing");
  must(scene);
  ok(tap,
     !hsr_scene_json_write(scene, "whole.scene.json", &err) &&
         !read_file(&back, "whole.scene.json", NULL, &err) &&
         same_scene(scene, back),
     "an empty scene comes back, over an older file");
  hsr_scene_delete(back);
  hsr_scene_delete(scene);
}

/* ---- Failures of writing ---- */

static void test_bad_writes(struct tap *tap) {
  struct hsr_scene *scene = complete_scene();
  struct hsr_error err = {HSR_OK, ""};
  ok(tap,
     hsr_scene_json_write(scene, "nowhere/a.scene.json", &err) == HSR_E_INPUT &&
         !strncmp(err.text, "nowhere/a.scene.json: cannot be written: ", 41),
     "no such directory: %s", err.text);

  write_text("old.scene.json", "old");
  struct rlimit limit, small = {4096, 4096};
  must(!getrlimit(RLIMIT_FSIZE, &limit));
  small.rlim_max = limit.rlim_max;
  signal(SIGXFSZ, SIG_IGN);
  must(!setrlimit(RLIMIT_FSIZE, &small));
  enum hsr_status status = hsr_scene_json_write(scene, "old.scene.json", &err);
  must(!setrlimit(RLIMIT_FSIZE, &limit));
  struct stat about;
  ok(tap, status == HSR_E_INPUT && strstr(err.text, "cannot be written: File"),
     "a full disk: %s", err.text);
  ok(tap,
     !stat("old.scene.json", &about) && about.st_size == 3 &&
         access("old.scene.json.part", F_OK) != 0,
     "the older file is as it was");

  scene->objects[0].name[0] = '\xff';
  ok(tap,
     hsr_scene_json_write(scene, "a.scene.json", &err) == HSR_E_INPUT &&
         strstr(err.text, "is not UTF-8") && access("a.scene.json", F_OK) != 0,
     "a name that is not UTF-8: %s", err.text);
  hsr_scene_delete(scene);
}

/* ---- Defaults ---- */

static const char *const DEFAULTS =
    "{\"schema\": \"hsr-scene/1\", \"objects\": ["
    "{\"name\": \"solid\", %s},"
    "{\"name\": \"sheet\", \"one_sided\": false, %s},"
    "{\"name\": \"open\", \"vertices\": [[0,0,0],[1,0,0],[0,1e0,0],[-0,0,"
    "18446744073709551616]],\"faces\": [[0,1.0,2],[0,2,3]]}],"
    "\"instances\": ["
    "{\"object\": \"open\", \"translate\": [1,2,3]},"
    "{\"object\": 0},"
    "{\"object\": \"open\", \"scale\": [2,3,4], \"translate\": [5,6,7]},"
    "{\"object\": \"solid\", \"scale\": 2}],"
    "\"views\": [{\"eye\": [0,0,5], \"at\": [0,0,0]}]}";

static void test_defaults(struct tap *tap) {
  char text[2000];
  snprintf(text, sizeof text, DEFAULTS, TETRAHEDRON, TETRAHEDRON);
  write_text("defaults.scene.json", text);
  struct hsr_scene *scene;
  struct hsr_error err;
  if (!ok(tap, !read_file(&scene, "defaults.scene.json", NULL, &err),
          "a short scene is read: %s", err.text)) {
    hsr_scene_delete(scene);
    return;
  }
  const struct hsr_object *o = scene->objects;
  ok(tap, !strcmp(scene->name, "as opened"), "the scene keeps its name");
  ok(tap, o[0].one_sided, "a solid is one-sided");
  ok(tap, !o[1].one_sided, "unless the file says otherwise");
  ok(tap, !o[2].one_sided, "an open object is two-sided");
  ok(tap, o[0].colour[1] == 0.6f && !o[0].rgb, "the colour is grey");
  ok(tap, o[2].vertex[1] == 1 && o[2].xyz[7] == 1,
     "numbers are the same however written");
  ok(tap, o[2].xyz[11] == 0x1p64 && signbit(o[2].xyz[9]),
     "integers of 64 bits and -0 are doubles");

  const double expected[4][12] = {{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0},
                                  {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0},
                                  {1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3},
                                  {2, 0, 0, 5, 0, 3, 0, 6, 0, 0, 4, 7}};
  bool good = scene->n_instances == 4;
  for (uint32_t i = 0; good && i < 4; i++)
    good = scene->instances[i].object == (i < 2 ? 0 : 2) &&
           same(scene->instances[i].m, expected[i], sizeof expected[i]);
  ok(tap, good, "instances are sorted by object, those of one as they stand");

  const struct hsr_camera camera = {{0, 0, 5}, {0}, {0, 1, 0}, 45, 0};
  ok(tap, scene->n_views == 1 && same(scene->views, &camera, sizeof camera),
     "a view looks up, through 45 degrees, from the eye on");
  ok(tap, !hsr_scene_finish(scene, &err), "the scene can be finished: %s",
     err.text);
  hsr_scene_delete(scene);
}

/* ---- Mesh files ---- */

static const char *const MESH_SCENE =
    "{\"schema\": \"hsr-scene/1\", \"name\": \"own\", \"objects\": ["
    "{\"file\": \"meshes/tetra.off\"},"
    "{\"name\": \"b\", \"file\": \"meshes/tetra.off\", \"one_sided\": false,"
    " \"colour\": [0, 0.5, 1]},"
    "{\"name\": \"c\", \"file\": \"meshes/tetra.off\"}],"
    "\"instances\": [{\"object\": \"b\"}, {\"object\": \"tetra\"}]}";

static void test_meshes(struct tap *tap) {
  must(!mkdir("sub", 0777) && !mkdir("sub/meshes", 0777));
  write_text("sub/meshes/tetra.off", "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
                                     "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
  write_text("sub/m.scene.json", MESH_SCENE);
  struct hsr_scene *scene;
  struct hsr_error err;
  ok(tap,
     !read_file(&scene, "sub/m.scene.json", NULL, &err) &&
         scene->n_objects == 3,
     "mesh files are found beside the scene file: %s", err.text);
  must(scene->n_objects == 3);
  const struct hsr_object *o = scene->objects;
  ok(tap, !strcmp(scene->name, "own"), "the scene has its own name");
  ok(tap,
     !strcmp(o[0].name, "tetra") && o[0].n_faces == 4 && o[0].one_sided &&
         o[0].colour[0] == 0.6f,
     "a mesh brings name and sides");
  ok(tap,
     !strcmp(o[1].name, "b") && o[1].n_faces == 4 && !o[1].one_sided &&
         o[1].colour[1] == 0.5f,
     "the scene file overrides them");
  ok(tap,
     !strcmp(o[2].name, "c") && o[2].n_faces == 4 && o[2].one_sided &&
         o[2].colour[0] == 0.6f && o[2].n_vertices == 4 &&
         same(o[2].xyz, o[0].xyz, 12 * sizeof(double)) &&
         same(o[2].vertex, o[0].vertex, 12 * sizeof(uint32_t)),
     "a file that is named again gives the mesh as it was");
  ok(tap, scene->n_instances == 2 && scene->instances[1].object == 1,
     "instances name meshes");
  hsr_scene_delete(scene);

  write_text("sub/bad.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 9\n");
  write_text("sub/m.scene.json", "{\"schema\": \"hsr-scene/1\", \"objects\": "
                                 "[{\"file\": \"bad.off\"}]}");
  ok(tap,
     read_file(&scene, "sub/m.scene.json", NULL, &err) == HSR_E_INPUT &&
         !strncmp(err.text, "sub/bad.off:6: ", 15),
     "a fault in a mesh file is placed there: %s", err.text);
  hsr_scene_delete(scene);
}

/* ---- Degenerate faces ---- */

static void test_drop(struct tap *tap) {
  write_text("sub/flat.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n"
                             "3 0 1 2\n3 0 1 1\n");
  write_text("sub/drop.scene.json",
             "{\"schema\": \"hsr-scene/1\", \"objects\": ["
             "{\"file\": \"flat.off\"}, {\"name\": \"a\","
             "\"vertices\": [[0,0,0],[1,0,0],[2,0,0],[0,1,0]],"
             "\"faces\": [[0,1],[0,1,3],[0,1,2],[1,1,3],[],[1,2,3]],"
             "\"face_colours\": [[0,0,0],[1,0,0],[0,0,0],[0,0,0],[0,0,0],"
             "[0,1,0,0.5]]}]}");
  struct hsr_import import = {.n_dropped = 9};
  struct hsr_scene *scene;
  struct hsr_error err;
  enum hsr_status status =
      read_file(&scene, "sub/drop.scene.json", &import, &err);
  ok(tap, !status && import.n_dropped == 5,
     "degenerate faces are dropped and counted, %d in all: %s",
     (int)import.n_dropped, err.text);
  ok(tap,
     !status && scene->objects[1].n_faces == 2 &&
         scene->objects[1].rgb[0] == 1 && scene->objects[1].rgb[4] == 1,
     "the colours stay with their faces");
  ok(tap,
     !status && hsr_face_opacity(&scene->objects[1], 0) == 1 &&
         hsr_face_opacity(&scene->objects[1], 1) == 0.5f &&
         !scene->objects[0].face_opacity && hsr_scene_is_transparent(scene),
     "a fourth number is the opacity of its face");
  hsr_scene_delete(scene);
}

/* ---- Motion ---- */

static const char MOTION[] =
    "{\"schema\": \"hsr-scene/1\", \"frame\": 2, \"objects\": ["
    "{\"name\": \"still\", \"vertices\": [[0,0,0],[1,0,0],[0,1,0]],"
    "\"faces\": [[0,1,2]]},"
    "{\"name\": \"cart\", \"moves\": true, \"vertices\":"
    "[[0,0,0],[1,0,0],[0,1,0]], \"faces\": [[0,1,2]]}],"
    "\"instances\": [{\"object\": \"cart\", \"places\": ["
    "{\"frame\": 1, \"translate\": [1,0,0]},"
    "{\"frame\": 5, \"translate\": [9,4,0], \"scale\": 3},"
    "{\"frame\": 6, \"matrix\": [0,1,0,0, 1,0,0,0, 0,0,1,0]}],"
    "\"motion\": {\"speed\": 20, \"within\": {\"lo\": [0,0,-1], \"hi\":"
    "[12,7,1]}, \"way\": [{\"frame\": 0.5, \"lo\": [0,0,-1], \"hi\":"
    "[12,7,1]}, {\"frame\": 6, \"lo\": [0,0,0], \"hi\": [12,7,0]}]}},"
    "{\"object\": \"cart\", \"motion\": {}},"
    "{\"object\": \"cart\", \"translate\": [0,0,5],"
    "\"motion\": {\"speed\": 0}}]}";

/* The first cart, whose matrix is a scale and a translation. */
static bool is_placed(long frame, double scale, double x, double y) {
  struct hsr_scene *scene;
  struct hsr_error err;
  must((scene = hsr_scene_new("walk")));
  must(!hsr_scene_json_read_frame(scene, "motion.scene.json", frame, NULL,
                                  &err));
  const double m[12] = {scale, 0, 0, x, 0, scale, 0, y, 0, 0, scale, 0};
  bool there = same(scene->instances[1].m, m, sizeof m) &&
               hsr_scene_frame(scene) == frame;
  hsr_scene_delete(scene);
  return there;
}

static bool same_motion(const struct hsr_scene *a, const struct hsr_scene *b) {
  bool all = hsr_scene_frame(a) == hsr_scene_frame(b);
  for (uint32_t i = 0; i < a->n_instances; i++) {
    struct hsr_motion p = hsr_scene_motion(a, i), q = hsr_scene_motion(b, i);
    all &= p.speed == q.speed && same(p.lo, q.lo, sizeof p.lo) &&
           same(p.hi, q.hi, sizeof p.hi) && p.n_keys == q.n_keys &&
           (!p.n_keys ||
            same(a->motions->key + p.first_key, b->motions->key + q.first_key,
                 p.n_keys * sizeof(struct hsr_key)));
  }
  return all;
}

static void test_motion(struct tap *tap) {
  struct hsr_scene *scene, *again;
  struct hsr_error err;
  write_text("motion.scene.json", MOTION);
  enum hsr_status status = read_file(&scene, "motion.scene.json", NULL, &err);
  ok(tap,
     !status && scene->n_instances == 4 && scene->instances[0].object == 0 &&
         hsr_scene_frame(scene) == 2 && scene->instances[1].m[3] == 3,
     "a file says its frame; an object without instance is placed: %s",
     err.text);
  struct hsr_motion first = hsr_scene_motion(scene, 1);
  struct hsr_motion last = hsr_scene_motion(scene, 3);
  double lo[3], hi[3];
  ok(tap,
     first.speed == 20 && first.hi[0] == 12 && first.lo[2] == -1 &&
         first.n_keys == 2 && hsr_scene_way(scene, 1, 6, 6, lo, hi) &&
         lo[2] == 0 && hi[0] == 12 && !hsr_scene_way(scene, 1, 0, 1, lo, hi) &&
         last.speed == 0 && isinf(last.hi[0]) && !last.n_keys &&
         isinf(hsr_scene_motion(scene, 2).speed) &&
         isinf(hsr_scene_motion(scene, 0).speed),
     "what is known is each instance's own");
  ok(tap, is_placed(1, 1, 1, 0) && is_placed(5, 3, 9, 4),
     "at its frame a place holds exactly");
  ok(tap, is_placed(3, 2, 5, 2) && is_placed(4, 2.5, 7, 3),
     "between two places the matrix changes steadily");
  ok(tap, is_placed(-7, 1, 1, 0), "before the first place it is there");
  must(!hsr_scene_json_write(scene, "again.scene.json", &err));
  status = read_file(&again, "again.scene.json", NULL, &err);
  ok(tap, !status && same_scene(scene, again) && same_motion(scene, again),
     "the frame and the motion are written: %s", err.text);
  hsr_scene_delete(scene);
  hsr_scene_delete(again);
}

/* ---- Bad input ---- */

/* The parts around the texts below. */
#define HEAD "{\"schema\": \"hsr-scene/1\",\n\"objects\": ["
#define TRIANGLE "\"vertices\": [[0,0,0],[1,0,0],[0,1,0]], \"faces\": [[0,1,2]]"
#define OBJECT "{\"name\": \"a\", " TRIANGLE "}"
#define INSTANCE(text) HEAD OBJECT "], \"instances\": [" text "]}"
#define MOVING "{\"name\": \"a\", \"moves\": true, " TRIANGLE "}"
#define MOVED(text)                                                            \
  HEAD MOVING "], \"instances\": [{\"object\": \"a\", " text "}]}"
#define KEY(frame) "{\"frame\": " frame ", \"lo\": [0,0,0], \"hi\": [1,1,1]}"
#define VIEW(text) HEAD OBJECT "], \"views\": [" text "]}"

static const struct {
  const char *text, *message; /* the message begins so after the path */
} bad[] = {
    /* No JSON */
    {"", ":1: '[' or '{' expected near end of file"},
    {"\n\n", ":"},
    {HEAD "\n", ":3: ']' expected near end of file"},
    {HEAD OBJECT ",]}", ":2: unexpected token near ']'"},
    {HEAD OBJECT "]}\n\n{}", ":4: end of file expected near '{'"},
    {HEAD OBJECT "]}\n\\", ":3: end of file expected near '\\'"},
    {HEAD "\n\n{\"name\": \"a\", \"name\": \"b\"}]}",
     ":4: duplicate object key near '\"name\"'"},
    {HEAD "{\"name\": \"\\u0000\"}]}", ":2: \\u0000 is not allowed"},
    {HEAD "{\"\\u0000\": 1}]}", ":2: "},
    {HEAD "{\"name\": \"\xff\"}]}", ":2: unable to decode byte 0xff"},
    {"\xef\xbb\xbf{}", ":1: '[' or '{' expected"},
    {HEAD "{\"name\": \"a\n\"}]}", ":2: unexpected newline"},
    {HEAD "NaN]}", ":2: invalid token near 'NaN'"},
    {HEAD "Infinity]}", ":2: invalid token near 'Infinity'"},
    {HEAD "01]}", ":2: invalid token near '0'"},
    {HEAD "1e999]}", ":2: real number overflow near '1e999'"},
    {"{\"schema\": \"hsr-scene/1\",\n\n\"objects\": [-1e400]}",
     ":3: real number overflow near '-1e400'"},
    {"hsr", ":1: '[' or '{' expected near 'hsr'"},

    /* Lists that are read an element at a time */
    {HEAD OBJECT ",\n,\n" OBJECT "]}", ":3: unexpected token near ','"},
    {HEAD OBJECT "\n}]}", ":3: "},
    {HEAD OBJECT "}", ":2: "},
    {HEAD
     "{\"name\": \"\", \"vertices\": [\n[0,0,0],\n[1,0 0]], \"faces\": []}]}",
     ":4: ']' expected near '0'"},
    {HEAD "{\"vertices\": [\n[0,0,0],\n[1,0 0],\n[0,1", ":4: "},
    {HEAD "{\"vertices\": [\n[0,0,0],\n[1,0,0],\n[0,1", ":5: "},
    {HEAD "{\"name\": \"a\", \"vert\\u0069ces\": [[0,0]], \"faces\": []}]}",
     ": /objects/0/vertices/0: must have 3 numbers, not 2"},
    {HEAD "{\"name\": \"]\\\"\", \"vertices\": [\n\n], \"faces\": [\n[0]]}]}",
     ": /objects/0/faces/0/0: vertex 0 of 0"},
    {HEAD "{\"vertices\": [],\n\"vertices\": [[0,0,0]]}]}",
     ":3: duplicate object key near '\"vertices\"'"},
    {HEAD "{\"vertices\": [[0,0,0], [0,[1],0]]}]}", ": /objects/0"},
    {INSTANCE("{\"object\": 0},\n{\"object\"}"), ":3: ':' expected"},
    {VIEW("{\"eye\": [0,0,1], \"at\": [0,0,0]},\n{]"), ":3: "},

    /* The whole */
    {"[]", ": must be an object, not an array"},
    {"{}", ": 'schema' is missing: it must be 'hsr-scene/1'"},
    {"{\"schema\": 1}", ": /schema: must be a string, not a number"},
    {"{\"schema\": \"hsr-scene/2\", \"new\": 1}",
     ": /schema: must be 'hsr-scene/1', not 'hsr-scene/2'"},
    {"{\"schema\": \"hsr-scene/1\"}", ": 'objects' is missing"},
    {"{\"schema\": \"hsr-scene/1\", \"objects\": {}}",
     ": /objects: must be an array, not an object"},
    {"{\"schema\": \"hsr-scene/1\", \"objects\": [], \"name\": null}",
     ": /name: must be a string, not null"},
    {"{\"schema\": \"hsr-scene/1\", \"objects\": [], \"camera\": 1}",
     ": /camera: unknown key"},
    {HEAD "], \"a/b~c\\n\": 1}", ": /a~1b~0c?: unknown key"},

    /* Objects */
    {HEAD "[]]}", ": /objects/0: must be an object, not an array"},
    {HEAD OBJECT ", {\"name\": \"b\", \"vertexes\": []}]}",
     ": /objects/1/vertexes: unknown key"},
    {HEAD "{" TRIANGLE "}]}", ": /objects/0: 'name' is missing"},
    {HEAD "{\"name\": \"a\"}]}", ": /objects/0: 'vertices' is missing"},
    {HEAD "{\"name\": \"a\", \"vertices\": []}]}",
     ": /objects/0: 'faces' is missing"},
    {HEAD "{\"name\": [], " TRIANGLE "}]}",
     ": /objects/0/name: must be a string, not an array"},
    {HEAD "{\"name\": \"a\", \"one_sided\": 1, " TRIANGLE "}]}",
     ": /objects/0/one_sided: must be true or false, not a number"},
    {HEAD "{\"name\": \"a\", \"moves\": 1, " TRIANGLE "}]}",
     ": /objects/0/moves: must be true or false, not a number"},
    {HEAD "{\"name\": \"a\", \"moves\": true, \"vertices\": [[0,0,0],"
          "[1,0,0],[1,1,0],[0,1,0]], \"faces\": [[0,1,2,3]]}]}",
     ": /objects/0/moves: face 0 is not a triangle"},
    {HEAD "{\"name\": \"a\", \"colour\": \"red\", " TRIANGLE "}]}",
     ": /objects/0/colour: must be an array, not a string"},
    {HEAD "{\"name\": \"a\", \"colour\": [0,0], " TRIANGLE "}]}",
     ": /objects/0/colour: must have 3 numbers, not 2"},
    {HEAD "{\"name\": \"a\", \"colour\": [0,1.5,0], " TRIANGLE "}]}",
     ": /objects/0/colour/1: 1.5 is not between 0 and 1"},
    {HEAD "{\"name\": \"a\", \"colour\": [0,0,-1], " TRIANGLE "}]}",
     ": /objects/0/colour/2: -1 is not between 0 and 1"},
    {HEAD "{\"name\": \"a\", \"vertices\": 3, \"faces\": []}]}",
     ": /objects/0/vertices: must be an array, not a number"},
    {HEAD "{\"name\": \"a\", \"vertices\": [[0,0,0],[0,0]], \"faces\": []}]}",
     ": /objects/0/vertices/1: must have 3 numbers, not 2"},
    {HEAD "{\"name\": \"a\", \"vertices\": [[0,0,0,1]], \"faces\": []}]}",
     ": /objects/0/vertices/0: must have 3 numbers, not 4"},
    {HEAD "{\"name\": \"a\", \"vertices\": [[0,true,0]], \"faces\": []}]}",
     ": /objects/0/vertices/0/1: must be a number, not a truth value"},
    {HEAD "{\"name\": \"a\", \"vertices\": [], \"faces\": {}}]}",
     ": /objects/0/faces: must be an array, not an object"},

/* Faces */
#define FACES(text)                                                            \
  HEAD "{\"name\": \"a\", \"vertices\": [[0,0,0],[1,0,0],[0,1,0],[1,1,0]], "   \
       "\"faces\": [[0,1,2], " text "]}]}"
    {FACES("3"), ": /objects/0/faces/1: must be an array, not a number"},
    {FACES("[0,1,2,99]"), ": /objects/0/faces/1/3: vertex 99 of 4"},
    {FACES("[0,-1,2]"), ": /objects/0/faces/1/1: vertex -1 of 4"},
    {FACES("[0,1,4294967296]"),
     ": /objects/0/faces/1/2: vertex 4294967296 of 4"},
    {FACES("[0,1,18446744073709551617]"),
     ": /objects/0/faces/1/2: vertex 1.84467440737096e+19 of 4"},
    {FACES("[0,1.5,2]"),
     ": /objects/0/faces/1/1: vertex 1.5, which is no whole number"},
    {FACES("[0,\"1\",2]"),
     ": /objects/0/faces/1/1: must be a number, not a string"},
    {FACES("[0,1]"), ": /objects/0/faces/1: has fewer than 3 vertices"},
    {FACES("[]"), ": /objects/0/faces/1: has fewer than 3 vertices"},
    {FACES("[0,1,0]"), ": /objects/0/faces/1: has the same vertex twice"},
    {HEAD "{\"name\": \"a\", \"face_colours\": [], " TRIANGLE "}]}",
     ": /objects/0/face_colours: must have one colour for each of 1 faces, "
     "not 0"},
    {HEAD "{\"name\": \"a\", \"face_colours\": {}, " TRIANGLE "}]}",
     ": /objects/0/face_colours: must be an array, not an object"},
    {HEAD "{\"name\": \"a\", \"face_colours\": [[0,0,2]], " TRIANGLE "}]}",
     ": /objects/0/face_colours/0/2: 2 is not between 0 and 1"},

    /* Mesh files */
    {HEAD "{\"file\": 1}]}",
     ": /objects/0/file: must be a string, not a number"},
    {HEAD "{\"file\": \"a.off\", \"faces\": []}]}",
     ": /objects/0/faces: cannot stand beside 'file'"},

    /* Instances */
    {HEAD OBJECT "], \"instances\": {}}",
     ": /instances: must be an array, not an object"},
    {INSTANCE("1"), ": /instances/0: must be an object, not a number"},
    {INSTANCE("{}"), ": /instances/0: 'object' is missing"},
    {INSTANCE("{\"object\": \"b\"}"),
     ": /instances/0/object: there is no object 'b'"},
    {INSTANCE("{\"object\": 1}"), ": /instances/0/object: object 1 of 1"},
    {INSTANCE("{\"object\": null}"),
     ": /instances/0/object: must be a name or a number, not null"},
    {HEAD OBJECT "," OBJECT "], \"instances\": [{\"object\": \"a\"}]}",
     ": /instances/0/object: several objects are called 'a'"},
    {INSTANCE("{\"object\": \"a\", \"rotate\": 1}"),
     ": /instances/0/rotate: unknown key"},
    {INSTANCE("{\"object\": \"a\", \"matrix\": [1]}"),
     ": /instances/0/matrix: must have 12 numbers, not 1"},
    {INSTANCE("{\"object\": \"a\", \"matrix\": [], \"scale\": 1}"),
     ": /instances/0/scale: cannot stand beside 'matrix'"},
    {INSTANCE("{\"object\": \"a\", \"scale\": \"1\"}"),
     ": /instances/0/scale: must be a number or three, not a string"},
    {INSTANCE("{\"object\": \"a\", \"scale\": [1,2]}"),
     ": /instances/0/scale: must have 3 numbers, not 2"},
    {INSTANCE("{\"object\": \"a\", \"translate\": 1}"),
     ": /instances/0/translate: must be an array, not a number"},

    /* Motion */
    {"{\"schema\": \"hsr-scene/1\", \"frame\": 1.5, \"objects\": []}",
     ": /frame: 1.5 is no whole number up to 2147483647"},
    {"{\"schema\": \"hsr-scene/1\", \"frame\": 1e10, \"objects\": []}",
     ": /frame: 10000000000 is no whole number up to 2147483647"},
    {INSTANCE("{\"object\": \"a\", \"motion\": {\"speed\": 1}}"),
     ": /instances/0/motion: object 'a' does not move"},
    {INSTANCE("{\"object\": \"a\", \"places\": [{\"frame\": 0}]}"),
     ": /instances/0/places: object 'a' does not move"},
    {MOVED("\"places\": {}"),
     ": /instances/0/places: must be an array, not an object"},
    {MOVED("\"places\": []"), ": /instances/0/places: is empty"},
    {MOVED("\"places\": [{\"frame\": 0}], \"scale\": 2"),
     ": /instances/0/scale: cannot stand beside 'places'"},
    {MOVED("\"places\": [{\"scale\": 2}]"),
     ": /instances/0/places/0: 'frame' is missing"},
    {MOVED("\"places\": [{\"frame\": 0, \"rotate\": 2}]"),
     ": /instances/0/places/0/rotate: unknown key"},
    {MOVED("\"places\": [{\"frame\": 0}, {\"frame\": 0}]"),
     ": /instances/0/places/1/frame: 0 is not after 0"},
    {MOVED("\"motion\": []"),
     ": /instances/0/motion: must be an object, not an array"},
    {MOVED("\"motion\": {\"spede\": 1}"),
     ": /instances/0/motion/spede: unknown key"},
    {MOVED("\"motion\": {\"speed\": -1}"),
     ": /instances/0/motion/speed: -1 is negative"},
    {MOVED("\"motion\": {\"within\": {\"lo\": [0,0,0]}}"),
     ": /instances/0/motion/within: 'hi' is missing"},
    {MOVED("\"motion\": {\"within\": {\"lo\": [0,2,0], \"hi\": [1,1,1]}}"),
     ": /instances/0/motion/within/hi/1: 1 is below 'lo', 2"},
    {MOVED("\"motion\": {\"way\": []}"), ": /instances/0/motion/way: is empty"},
    {MOVED("\"motion\": {\"way\": [" KEY("2") ", " KEY("1") "]}"),
     ": /instances/0/motion/way/1/frame: 1 is not after 2"},
    {MOVED("\"motion\": {\"way\": [{\"frame\": 0, \"lo\": [0,0,0]}]}"),
     ": /instances/0/motion/way/0: 'hi' is missing"},
    {MOVED("\"translate\": [2,0,0], \"motion\": {\"way\": [" KEY("0") "]}"),
     ": instance 0 of object a leaves its way"},
    {MOVED("\"translate\": [2,0,0], \"motion\": {\"within\": {\"lo\": "
           "[0,0,0], \"hi\": [1,1,1]}}"),
     ": instance 0 of object a leaves its volume"},

    /* Views */
    {HEAD OBJECT "], \"views\": 1}",
     ": /views: must be an array, not a number"},
    {VIEW("{\"eye\": [0,0,1]}"), ": /views/0: 'at' is missing"},
    {VIEW("{\"eye\": [0,0,1], \"at\": [0,0,1]}"),
     ": /views/0: camera: eye and at are the same point"},
    {VIEW("{\"eye\": [0,0,1], \"at\": [0,0,0], \"fov\": 180}"),
     ": /views/0: camera: fov must lie"},
    {VIEW("{\"eye\": [0,0,1], \"at\": [0,0,0], \"fov\": []}"),
     ": /views/0/fov: must be a number, not an array"},
    {VIEW("{\"eye\": [0,0,1], \"at\": [0,0,0], \"up\": [0,0,2]}"),
     ": /views/0: camera: up runs along the view"},
    {VIEW("{\"eye\": [0,0,1], \"at\": [0,0,0], \"name\": \"\"}"),
     ": /views/0/name: unknown key"}};

static void expect_refusal(struct tap *tap, const char *path,
                           const char *message, const char *what) {
  struct hsr_scene *scene;
  struct hsr_error err;
  char expected[300];
  snprintf(expected, sizeof expected, "%s%s", path, message);
  struct hsr_import strict = {.strict = true};
  enum hsr_status status = read_file(&scene, path, &strict, &err);
  ok(tap,
     status == HSR_E_INPUT && err.status == status &&
         !strncmp(err.text, expected, strlen(expected)) &&
         !strchr(err.text, '\n'),
     "%s: %s", what, err.text);
  hsr_scene_delete(scene);
}

static void test_bad_texts(struct tap *tap) {
  for (int i = 0; i < COUNT(bad); i++) {
    write_text("bad.scene.json", bad[i].text);
    expect_refusal(tap, "bad.scene.json", bad[i].message, "refused");
  }
}

static void test_bad_files(struct tap *tap) {
  expect_refusal(tap, "none.scene.json", ": cannot be read: No such file",
                 "no file");
  expect_refusal(tap, "sub", ": is a directory", "a directory");
  must(!mkfifo("pipe", 0666));
  expect_refusal(tap, "pipe", ": is not a regular file", "a pipe");

  static const char after_number[] = HEAD "\n1\0 ]}";
  write_bytes("bad.scene.json", after_number, sizeof after_number - 1);
  expect_refusal(tap, "bad.scene.json", ":3: a NUL byte", "NUL in the middle");
  static const char at_end[] = HEAD OBJECT "]}\n";
  write_bytes("bad.scene.json", at_end, sizeof at_end);
  expect_refusal(tap, "bad.scene.json", ":3: a NUL byte", "NUL at the end");

  static char deep[200000];
  memset(deep, '[', sizeof deep);
  write_bytes("bad.scene.json", deep, sizeof deep);
  expect_refusal(tap, "bad.scene.json", ":1: maximum parsing depth reached",
                 "deep nesting");

  static char key[3000] = "{\"schema\": \"hsr-scene/1\", \"";
  memset(key + strlen(key), '~', 2900);
  strcat(key, "\": 1}");
  write_text("bad.scene.json", key);
  expect_refusal(tap, "bad.scene.json", ": /~0~0~0~0", "a long key");
}

/* ---- */

static void clean_up(const char *directory) {
  static const char *const files[] = {
      "whole.scene.json",     "old.scene.json",
      "motion.scene.json",    "again.scene.json",
      "bad.scene.json",       "defaults.scene.json",
      "sub/meshes/tetra.off", "sub/m.scene.json",
      "sub/bad.off",          "sub/flat.off",
      "sub/drop.scene.json",  "pipe",
      "sub/meshes",           "sub"};
  for (int i = 0; i < COUNT(files); i++)
    remove(files[i]);
  must(!chdir("/"));
  remove(directory);
}

/* ---- Memory ---- */

/* The memory that jansson holds now, and the most that it held. */
static size_t held, most_held;

static void *hold(size_t size) {
  size_t *p = malloc(sizeof(max_align_t) + size);
  if (!p)
    return NULL;
  *p = size;
  held += size;
  most_held = held > most_held ? held : most_held;
  return (char *)p + sizeof(max_align_t);
}

static void let_go(void *p) {
  if (!p)
    return;
  size_t *size = (size_t *)(void *)((char *)p - sizeof(max_align_t));
  held -= *size;
  free(size);
}

/* A list is never held as a whole tree, however long it is: neither in a good
 * file nor in one that ends too early. */
static void test_memory(struct tap *tap) {
  enum { N = 100000 };
  struct hsr_scene *scene;
  struct hsr_error err;
  for (int cut = 0; cut < 2; cut++) {
    FILE *file = fopen("long.scene.json", "w");
    must(file);
    fputs(HEAD "{\"name\": \"a\", \"vertices\": [", file);
    for (int v = 0; v < N; v++)
      fprintf(file, "%s[%d,%d,0.5]", v ? ",\n" : "", v, v % 7);
    if (!cut)
      fputs("], \"faces\": [[0,1,7]]}]}", file);
    must(!fclose(file));
    most_held = 0;
    enum hsr_status status = read_file(&scene, "long.scene.json", NULL, &err);
    ok(tap,
       status == (cut ? HSR_E_INPUT : HSR_OK) && most_held < 8192 && !held &&
           (cut || scene->objects[0].n_vertices == N),
       "%d vertices%s: jansson holds %zu bytes at the most", (int)N,
       cut ? ", and no end" : "", most_held);
    hsr_scene_delete(scene);
  }
}

int main(void) {
  json_set_alloc_funcs(hold, let_go);
  char directory[] = "/tmp/hsr-scene-json-XXXXXX";
  must(mkdtemp(directory) && !chdir(directory));
  struct tap tap = plan(5 + 4 + 11 + 7 + 2 + 6 + COUNT(bad) + 8 + 2);
  test_round_trip(&tap);
  test_bad_writes(&tap);
  test_defaults(&tap);
  test_meshes(&tap);
  test_drop(&tap);
  test_motion(&tap);
  test_bad_texts(&tap);
  test_bad_files(&tap);
  test_memory(&tap);
  clean_up(directory);
  return finish(&tap);
}
