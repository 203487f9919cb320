/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The built-in scenes: they have not changed, and they are what they claim to
 * be; and the words by which a user names a scene.
 *
 * If a hash differs, the test prints the one that it found. A change on purpose
 * is entered in the table below. Any other change is a defect, since every
 * reference picture changes with it. */
#ifndef _POSIX_C_SOURCE
#define _POSIX_C_SOURCE 200809L
#endif

#include "common/exact/predicates.h"
#include "scenes/cameras.h"
#include "scenes/meshes.h"
#include "scenes/scenes.h"
#include "tests/tap.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define COUNT(array) ((int)(sizeof(array) / sizeof *(array)))

/* Hashes of the geometry with its colours, and of the views. */
static const struct {
  const char *name;
  uint64_t geometry, views;
} known[] = {{"house", 0x37d4434093d26b3b, 0x9a6b35b594233bce},
             {"harbor", 0xb49783f8a69db04f, 0x99b35b35f26735a5},
             {"harbor:100", 0xb10c58b409c9126f, 0x758b3f0c9fad0bdc},
             {"harbor:12000", 0xe703e12cd705b137, 0xed73929cefa136a5},
             {"big-harbor", 0x6b26f93c7dfc7dfb, 0x1004e17d0b20c38b},
             {"color-cube", 0xfcd9e4d92b4383b5, 0x8356deeea864066a},
             {"color-sides", 0xc8ad25980fc4950f, 0xefb47b05a05b3101},
             {"twist", 0xbc91c984b8e016ac, 0xc2909bebeafc32c6},
             {"sphere", 0x207a114635096eb5, 0x86ef54c087208bae},
             {"terrain", 0xb0269d9521dfd0b9, 0x64bf0ca9e27f50d0},
             {"terrain:16:9", 0x533db8daf334d39e, 0xa9bd750879ba1341},
             {"office", 0x32385bec4991caa6, 0x79a88eb9fed8d2d5},
             {"office:3:1:2", 0xa75f0ed79c736967, 0x353812346d442d00},
             {"traffic", 0x52c4e5bdff73e8b8, 0xc33f9d6d5f81e462},
             {"traffic:20:7", 0xae2a6c853e85c7b4, 0xc33f9d6d5f81e462},
             {"tower", 0xb3bb39213ddefcd9, 0x8980ce04974aab03},
             {"tower-bare", 0xb0c8a65c4732bfbe, 0x8980ce04974aab03},
             {"tower:40", 0xaf9c59cbb6aab7e4, 0xa198a97b12450d32},
             {"rooms", 0x2635d7c2df9667b0, 0x19b1c5b9c8495174},
             {"rooms:3:50", 0x60a76b03871b0e54, 0xa6e2b2a1e611faff},
             {"greenhouse", 0x63caa5a27b9405cf, 0x801fc53e54c4497b},
             {"panes", 0xc72b8ac4e354ed49, 0xc8f2d73fffb3ab76},
             {"panes:40:7", 0x8c7142731c8f7413, 0xde5b114c4974da77},
             {"soup", 0x09cd6f8287df6eec, 0xe2f28953fa2319f1},
             {"soup:100:7", 0x258c9a8fbb04398c, 0xa91990140ef9c1f1},
             {"lattice", 0x3177b0ca5e6c6b16, 0xad865c6288d8bd3e},
             {"lattice:40:7", 0xa0429647d8f2faef, 0x42a4ee8855f24723},
             {"checker-cube", 0x048dfaef060894fa, 0xa2460a99869e48eb},
             {"checker-cube:40", 0x338bf07128da0a17, 0x16dce8a92f509781},
             {"grid", 0x7c0653f3408a4b9d, 0x806716fdf435209e},
             {"grid:9:7", 0x92370f55ee8d89b2, 0x9bc5c9e885091f39},
             {"heights", 0x4e9d9f0fce3aa45a, 0x6473bdd16a47fd6e},
             {"heights:256:7", 0x35b3a0d116185358, 0x59a5de0d0df9ef4e},
             {"checker-plane", 0x82df09a7ac467432, 0x6f1f9e22bcbafa23},
             {"tubules", 0xce0cbd321eae5970, 0x0c54c6df4825d33e},
             {"cyclic-overlap", 0x21769e1614807276, 0xd936af14550fd029},
             {"penetration", 0xf52c450824a57ce6, 0x910ad37b16c545b5},
             {"coplanar", 0x3fd4c3eff437a466, 0xa0bab23422d6a9cc},
             {"nested-solids", 0x7ee76032479c5766, 0xa16aa1a684d2ef19},
             {"one-sided", 0x7aaf594e5537f135, 0x0e1d60f74c6f11f4},
             {"deep-stack", 0x8235081f4fea237b, 0xffc9baca7afe8eb3},
             {"t-junction", 0x8772e15e64e5e78b, 0xada3922033bd5dae},
             {"shared-edges", 0x705b21703e152e5b, 0xe218700bc9715c6b},
             {"collinear-edges", 0x55738a8a47a35b12, 0xfa955f0f1931017e},
             {"sliver", 0xceae074ea36348b0, 0xf3ce6765f174cb1d},
             {"sub-pixel-gap", 0x8da9b62cd99dacc7, 0x9e2f0dbb76e52b5d},
             {"needle-fan", 0x68abbf67836c9900, 0x8bd3f52aeeb28698},
             {"non-convex", 0x741285e08ece5942, 0xbebe6f2a8673696a},
             {"keyholes", 0x0eb0ee109b943430, 0x33bf8a005d0fb0f7},
             {"non-planar", 0x65e26050ee3f2280, 0x5d95e760d5de7455},
             {"huge-and-tiny", 0xe9aede247d1da8f5, 0x1444cc1d3018e2fe},
             {"behind-eye", 0xf91e59c56181f291, 0x96b40c17c78d50a4},
             {"near-plane", 0x46bcc12ab1522ccd, 0x5816f31cc46edfb2},
             {"eye-in-plane", 0xb7064a671d6c4acf, 0x3ea929c27baa5ffd}};

/* FNV-1a over 64-bit words. */
static void mix(uint64_t *hash, uint64_t word) {
  for (int i = 0; i < 8; i++) {
    *hash = (*hash ^ (word & 0xff)) * UINT64_C(1099511628211);
    word >>= 8;
  }
}

static void mix_doubles(uint64_t *hash, const double *v, size_t n) {
  for (size_t i = 0; i < n; i++) {
    double value = v[i] + 0.0; /* -0 and 0 count as equal */
    uint64_t word;
    memcpy(&word, &value, sizeof word);
    mix(hash, word);
  }
}

static void mix_numbers(uint64_t *hash, const uint32_t *v, size_t n) {
  for (size_t i = 0; i < n; i++)
    mix(hash, v[i]);
}

static uint64_t hash_geometry(const struct hsr_scene *scene) {
  uint64_t hash = UINT64_C(14695981039346656037);
  for (uint32_t o = 0; o < scene->n_objects; o++) {
    const struct hsr_object *object = &scene->objects[o];
    mix(&hash, object->one_sided);
    if (object->opacity < 1)
      mix(&hash, (uint64_t)(65536 * (double)object->opacity));
    mix_doubles(&hash, object->xyz, 3 * (size_t)object->n_vertices);
    mix_numbers(&hash, object->start, (size_t)object->n_faces + 1);
    mix_numbers(&hash, object->vertex, object->start[object->n_faces]);
    for (size_t i = 0; object->rgb && i < 3 * (size_t)object->n_faces; i++) {
      double channel = object->rgb[i];
      mix_doubles(&hash, &channel, 1);
    }
  }
  for (uint32_t i = 0; i < scene->n_instances; i++) {
    mix(&hash, scene->instances[i].object);
    mix_doubles(&hash, scene->instances[i].m, 12);
  }
  return hash;
}

static uint64_t hash_views(const struct hsr_scene *scene) {
  uint64_t hash = UINT64_C(14695981039346656037);
  for (uint32_t v = 0; v < scene->n_views; v++) {
    const struct hsr_camera *camera = &scene->views[v];
    mix_doubles(&hash, camera->eye, 3);
    mix_doubles(&hash, camera->at, 3);
    mix_doubles(&hash, camera->up, 3);
    mix_doubles(&hash, &camera->fov, 1);
    mix_doubles(&hash, &camera->near, 1);
  }
  return hash;
}

static struct hsr_scene *open_scene(const char *name) {
  struct hsr_scene *scene;
  struct hsr_error err;
  if (hsr_scene_open(name, NULL, &scene, &err) ||
      hsr_scene_make_faces(scene, &err))
    bail("%s: %s", name, err.text);
  return scene;
}

static void check_known(struct tap *tap, int i) {
  struct hsr_scene *scene = open_scene(known[i].name);
  uint64_t geometry = hash_geometry(scene), views = hash_views(scene);
  ok(tap, !strcmp(scene->name, known[i].name) && scene->n_views >= 8,
     "%s: bears its name and has 8 views or more", known[i].name);
  if (!ok(tap, geometry == known[i].geometry && views == known[i].views,
          "%s: bit for bit as it was", known[i].name))
    printf("# {\"%s\", 0x%016" PRIx64 ", 0x%016" PRIx64 "},\n", known[i].name,
           geometry, views);
  hsr_scene_delete(scene);
}

/* Whether the scene is in the table. */
static bool is_known(const char *name) {
  for (int i = 0; i < COUNT(known); i++)
    if (!strcmp(known[i].name, name))
      return true;
  return false;
}

static bool entry_is_sound(const struct hsr_builtin *b) {
  int colons = 0;
  for (const char *c = b->usage; *c; c++)
    colons += *c == ':';
  bool good = b->n_parameters <= HSR_MAX_PARAMETERS &&
              colons == b->n_parameters && b->build && *b->about &&
              !strncmp(b->usage, b->name, strlen(b->name));
  for (int i = 0; i < b->n_parameters; i++)
    good =
        good && b->least[i] <= b->standard[i] && b->standard[i] <= b->most[i];
  return good && (b->package || is_known(b->name));
}

static bool refused_as(enum hsr_status as, const char *name,
                       const char *because) {
  struct hsr_scene *scene;
  struct hsr_error err = {HSR_OK, ""};
  enum hsr_status status = hsr_scene_open(name, NULL, &scene, &err);
  bool good = status == as && err.status == status && !scene &&
              strstr(err.text, because);
  if (!good)
    printf("# \"%s\": status %d, \"%s\"\n", name, (int)status, err.text);
  hsr_scene_delete(scene);
  return good;
}

static bool refused(const char *name, const char *because) {
  return refused_as(HSR_E_INPUT, name, because);
}

/* A value one beyond each bound is refused, and the least value is not. */
static bool bounds_hold(const struct hsr_builtin *b) {
  char name[128];
  snprintf(name, sizeof name, "%s:%lld", b->name, b->least[0] - 1);
  bool good = refused(name, b->usage);
  snprintf(name, sizeof name, "%s:%lld", b->name, b->most[0] + 1);
  good = refused(name, b->usage) && good;
  snprintf(name, sizeof name, "%s:%lld", b->name, b->least[0]);
  struct hsr_scene *scene = open_scene(name);
  good = good && scene->n_views >= 8;
  hsr_scene_delete(scene);
  return good;
}

/* --- Cameras in the name -------------------------------------------------- */

static bool is_near(const struct hsr_camera *camera, double eye, double at,
                    double fov) {
  return camera->eye[0] == eye && camera->at[0] == at && camera->fov == fov;
}

static void write_cameras(const char *path) {
  FILE *file = fopen(path, "w");
  if (!file)
    exit(99);
  fputs("{\"schema\": \"hsr-camera/1\", \"views\": [\n"
        " {\"eye\": [1, 2, 3], \"at\": [4, 5, 6]},\n"
        " {\"eye\": [7, 8, 9], \"at\": [0, 0, 0], \"fov\": 30}]}\n",
        file);
  fclose(file);
}

/* The only view of the scene of this name. */
static struct hsr_camera view_of(const char *name) {
  struct hsr_scene *scene = open_scene(name);
  struct hsr_camera camera = scene->views[0];
  if (scene->n_views != 1 || strcmp(scene->name, name))
    camera.fov = -1;
  hsr_scene_delete(scene);
  return camera;
}

static void check_cameras(struct tap *tap) {
  static const char path[] = "cameras_of_a@test.json";
  struct hsr_scene *house = open_scene("house");
  struct hsr_camera first = house->views[0], third = house->views[2];
  uint32_t n_views = house->n_views;
  hsr_scene_delete(house);
  struct hsr_camera camera = view_of("house@eye=9,5,-1e1:fov=20.5");
  ok(tap,
     is_near(&camera, 9, first.at[0], 20.5) && camera.eye[2] == -10 &&
         camera.near == first.near,
     "words change the scene's first view");
  camera = view_of("house@view=3:near=0.5");
  ok(tap,
     is_near(&camera, third.eye[0], third.at[0], third.fov) &&
         camera.near == .5,
     "or the view that they name");
  camera = view_of("house@eye=1,2,3:eye=4,5,6@at=7,8,9");
  ok(tap, is_near(&camera, 4, 7, first.fov), "the last word counts");
  house = open_scene("house@near=0.5:parallel=12@view=2:fov=30");
  ok(tap,
     house->n_views == 1 && house->views[0].parallel == 0 &&
         house->views[0].near == 0.5,
     "an angle makes a view perspective again");
  hsr_scene_delete(house);
  house = open_scene("house@parallel=same");
  camera = house->views[2];
  ok(tap,
     house->n_views == n_views &&
         fabs(camera.parallel -
              2 * tan(camera.fov * acos(-1) / 360) *
                  sqrt(pow(camera.at[0] - camera.eye[0], 2) +
                       pow(camera.at[1] - camera.eye[1], 2) +
                       pow(camera.at[2] - camera.eye[2], 2))) < 1e-12,
     "words without a place change all views; a height that fits");
  hsr_scene_delete(house);
  ok(tap,
     refused_as(HSR_E_USAGE, "house@view=99", "no view 99") &&
         refused_as(HSR_E_USAGE, "house@view=0:fov=3", "from 1") &&
         refused_as(HSR_E_USAGE, "house@fov=3:view=2", "says nothing") &&
         refused_as(HSR_E_USAGE, "house@eye=1,2", "X,Y,Z") &&
         refused_as(HSR_E_USAGE, "house@eye=1,2,3,4", "X,Y,Z") &&
         refused_as(HSR_E_USAGE, "house@eye=1,2,nan", "X,Y,Z") &&
         refused_as(HSR_E_USAGE, "house@fov=40:", "says nothing") &&
         refused_as(HSR_E_USAGE, "house@fov=181", "180") &&
         refused_as(HSR_E_INPUT, "house@", "cannot be read") &&
         refused_as(HSR_E_INPUT, "house@none.json", "none.json") &&
         refused_as(HSR_E_INPUT, "@fov=30", "no scene") &&
         refused_as(HSR_E_INPUT, "horse@fov=30", "did you mean house"),
     "bad cameras are refused");
  write_cameras("cameras.json");
  house = open_scene("house@cameras.json");
  ok(tap, house->n_views == 2 && is_near(&house->views[1], 7, 0, 30),
     "a file replaces all views");
  hsr_scene_delete(house);
  camera = view_of("house@cameras.json@view=2:fov=15");
  ok(tap, is_near(&camera, 7, 0, 15), "and words change the file's");
  write_cameras(path);
  ok(tap,
     hsr_name_before_cameras(path) == strlen(path) &&
         hsr_name_before_cameras("a@b@c") == 1,
     "a file may have an @ in its name");
  remove("cameras.json");
  remove(path);
}

/* --- Palettes in the name ------------------------------------------------- */

static bool has_palette(const char *name, const struct hsr_palette *wanted) {
  struct hsr_scene *scene = open_scene(name);
  const struct hsr_palette *p = &scene->grid->palette;
  bool good = !strcmp(scene->name, name) && p->specular == wanted->specular &&
              p->own_colours == wanted->own_colours &&
              !memcmp(p->opacity, wanted->opacity, sizeof p->opacity) &&
              !memcmp(p->rgb, wanted->rgb, sizeof p->rgb);
  hsr_scene_delete(scene);
  return good;
}

static void check_palettes(struct tap *tap) {
  static const char path[] = "palette:of_a_test.json";
  struct hsr_palette flat, bone, mine;
  hsr_palette_find("flat", &flat);
  hsr_palette_find("bone", &bone);
  ok(tap,
     has_palette("checker-cube", &flat) &&
         has_palette("checker-cube@palette=bone", &bone) &&
         has_palette("checker-cube@eye=9,9,30@palette=bone@fov=30", &bone) &&
         has_palette("checker-cube@palette=bone@palette=flat", &flat),
     "a name may hold a palette, and the last counts");
  FILE *file = fopen(path, "w");
  if (!file)
    exit(99);
  fputs("{\"schema\": \"hsr-palette/1\", \"opacity\": [[0, 0]],"
        " \"specular\": 1}",
        file);
  fclose(file);
  mine = flat;
  memset(mine.opacity, 0, sizeof mine.opacity);
  mine.specular = 65535;
  ok(tap, has_palette("checker-cube@palette=palette:of_a_test.json", &mine),
     "also that of a file");
  remove(path);
  ok(tap,
     refused_as(HSR_E_USAGE, "house@palette=bone", "is no grid") &&
         refused_as(HSR_E_USAGE, "checker-cube@palette=bons", "mean bone?") &&
         refused_as(HSR_E_USAGE, "checker-cube@palette=", "no palette ''") &&
         refused_as(HSR_E_USAGE, "checker-cube@fov=30:palette=bone",
                    "says nothing of a camera") &&
         refused_as(HSR_E_INPUT, "checker-cube@palette=none.json",
                    "none.json: cannot be read"),
     "bad palettes are refused");
}

/* --- Tiny scenes ---------------------------------------------------------- */

/* Two instances of a triangle as seen from one place, all 2^exponent as large
 * as the first. */
static struct hsr_scene *sized_scene(int exponent) {
  static const double corner[3][3] = {{0, 0.1, 3}, {1, 0, 3}, {0, 1, 0x1p-20}};
  static const uint32_t face[3] = {0, 1, 2};
  struct hsr_scene *scene = hsr_scene_new("sized");
  struct hsr_object *object = hsr_scene_object(scene, "triangle");
  for (int k = 0; k < 3; k++)
    hsr_object_vertex(object, ldexp(corner[k][0], exponent),
                      ldexp(corner[k][1], exponent),
                      ldexp(corner[k][2], exponent), NULL);
  hsr_object_face(object, face, 3, NULL);
  double m[12] = {1, 2, 0, 0, 0, 1, 0, 0, 0, 0, 1, ldexp(7, exponent)};
  hsr_scene_instance(scene, 0, NULL);
  hsr_scene_instance(scene, 0, m);
  struct hsr_camera camera = {.eye = {0, 0, ldexp(9, exponent)},
                              .at = {ldexp(0.3, exponent), 0, 0},
                              .up = {0, 1, 0},
                              .fov = 40,
                              .near = ldexp(0.2, exponent)};
  hsr_scene_view(scene, &camera);
  struct hsr_error err;
  if (hsr_scene_finish(scene, &err))
    exit(99);
  return scene;
}

/* Whether a is 2^exponent as large as b, bit for bit. */
static bool is_larger(const struct hsr_scene *a, const struct hsr_scene *b,
                      int exponent) {
  const struct hsr_camera *v = a->views, *w = b->views;
  bool same = v->fov == w->fov && v->up[1] == w->up[1] &&
              v->near == ldexp(w->near, exponent);
  for (int k = 0; k < 9; k++)
    same &= a->objects[0].xyz[k] == ldexp(b->objects[0].xyz[k], exponent);
  for (int k = 0; k < 3; k++)
    same &= v->eye[k] == ldexp(w->eye[k], exponent) &&
            v->at[k] == ldexp(w->at[k], exponent);
  for (int k = 0; k < 12; k++)
    same &= a->instances[1].m[k] == (k % 4 == 3
                                         ? ldexp(b->instances[1].m[k], exponent)
                                         : b->instances[1].m[k]);
  return same;
}

static void check_tiny(struct tap *tap) {
  struct hsr_scene *one = sized_scene(0), *tiny = sized_scene(-900),
                   *small = sized_scene(-80);
  hsr_scene_enlarge(one);
  hsr_scene_enlarge(small);
  ok(tap, !one->enlarged && !small->enlarged && is_larger(one, small, 80),
     "a scene of some size is not enlarged");
  hsr_scene_enlarge(tiny);
  ok(tap,
     tiny->enlarged > 890 && tiny->enlarged < 900 &&
         is_larger(one, tiny, 900 - tiny->enlarged),
     "a tiny one is, by 2^%d", tiny->enlarged);
  hsr_scene_delete(one);
  hsr_scene_delete(tiny);
  hsr_scene_delete(small);
}

static void check_table(struct tap *tap) {
  bool sound = true, bounded = true;
  for (const struct hsr_builtin *b = hsr_builtins; b->name; b++) {
    if (!entry_is_sound(b)) {
      sound = false;
      printf("# the entry of %s\n", b->name);
    }
    if (b->n_parameters && hsr_builtin_is_there(b) && !bounds_hold(b))
      bounded = false;
  }
  ok(tap, sound, "every entry of the table is sound and has its hash here");
  ok(tap, bounded, "parameters out of range are refused, the least are not");
}

/* Bad names, each with a part of its error message. */
static const char *const bad_names[][2] = {
    {"", "no scene"},
    {"habor", "did you mean harbor"},
    {"colour-cube", "color-cube"},
    {"overlap", "cyclic-overlap"},
    {"zzzz", "no scene"},
    {"harbor:", "whole number from 100 to 60000, not \"\""},
    {"harbor:x", "usage: harbor:N"},
    {"harbor:-5", "usage: harbor:N"},
    {"harbor:+500", "usage: harbor:N"},
    {"harbor: 500", "usage: harbor:N"},
    {"harbor:500.0", "usage: harbor:N"},
    {"harbor:0x200", "usage: harbor:N"},
    {"harbor:99999999999999999999999", "usage: harbor:N"},
    {"harbor:500:1", "too many parameters"},
    {"house:1", "too many parameters"},
    {"soup::1", "N must be"},
    {"soup:10:", "SEED must be"},
    {"soup:10:1:", "too many parameters"},
    {"soup:10:9223372036854775808", "SEED must be"},
    {"harbor\n", "no scene"},
    {"dir/thing.xyz", "not a scene"},
    {"mesh:", "not the name of a mesh"},
    {"mesh:../cube", "not the name of a mesh"},
    {"mesh:/etc/passwd", "not the name of a mesh"},
    {"mesh:-rf", "not the name of a mesh"},
    {"mesh:a b", "not the name of a mesh"},
    {"mesh:.hidden", "not the name of a mesh"}};

static void check_bad_names(struct tap *tap) {
  bool good = true;
  for (int i = 0; i < COUNT(bad_names); i++)
    good = refused(bad_names[i][0], bad_names[i][1]) && good;
  ok(tap, good, "what is no name is refused, and said to be");
}

/* Geometry, by exact predicates. */
static bool no_memory;

static struct hsr_loop face_of(const struct hsr_object *object, uint32_t f) {
  return (struct hsr_loop){object->xyz,
                           object->xyz + 1,
                           object->xyz + 2,
                           3,
                           object->vertex + object->start[f],
                           object->start[f + 1] - object->start[f]};
}

static const double *corner(const struct hsr_object *object, uint32_t f,
                            uint32_t k) {
  return object->xyz + 3 * (size_t)object->vertex[object->start[f] + k];
}

static int side_of(const struct hsr_object *object, uint32_t f,
                   const double point[3]) {
  return hsr_exact_plane_side(face_of(object, f), point, &no_memory);
}

static bool same_plane(const struct hsr_object *a, uint32_t f,
                       const struct hsr_object *b, uint32_t g) {
  return hsr_exact_same_plane(face_of(a, f), face_of(b, g), &no_memory) == 1;
}

static bool is_plane(const struct hsr_object *object, uint32_t f) {
  for (uint32_t k = 0; k < face_of(object, f).n; k++)
    if (side_of(object, f, corner(object, f, k)))
      return false;
  return true;
}

static const struct hsr_object *find(const struct hsr_scene *scene,
                                     const char *name) {
  for (uint32_t o = 0; o < scene->n_objects; o++)
    if (!strcmp(scene->objects[o].name, name))
      return &scene->objects[o];
  bail("%s has no object %s", scene->name, name);
}

/* Whether faces f and g each have corners on both sides of the other. */
static bool straddle(const struct hsr_object *a, uint32_t f,
                     const struct hsr_object *b, uint32_t g) {
  bool front = false, back = false;
  for (uint32_t k = 0; k < face_of(b, g).n; k++) {
    int side = side_of(a, f, corner(b, g, k));
    front = front || side > 0;
    back = back || side < 0;
  }
  return front && back;
}

static int compare_edges(const void *a, const void *b) {
  return memcmp(a, b, 2 * sizeof(uint32_t));
}

/* Whether every edge is run once in each direction. */
static bool is_closed(const struct hsr_object *object) {
  uint32_t n = object->start[object->n_faces];
  uint32_t(*there)[2] = malloc(n * sizeof *there), (*back)[2];
  back = malloc(n * sizeof *back);
  uint32_t e = 0;
  for (uint32_t f = 0; f < object->n_faces; f++)
    for (uint32_t k = object->start[f]; k < object->start[f + 1]; k++, e++) {
      uint32_t next = k + 1 < object->start[f + 1] ? k + 1 : object->start[f];
      there[e][0] = back[e][1] = object->vertex[k];
      there[e][1] = back[e][0] = object->vertex[next];
    }
  qsort(there, n, sizeof *there, compare_edges);
  qsort(back, n, sizeof *back, compare_edges);
  bool closed = !memcmp(there, back, n * sizeof *there);
  for (uint32_t i = 1; i < n; i++)
    closed = closed && compare_edges(there[i - 1], there[i]);
  free(there);
  free(back);
  return closed;
}

/* Six times the signed volume. */
static double volume(const struct hsr_object *object) {
  double sum = 0;
  for (uint32_t f = 0; f < object->n_faces; f++)
    for (uint32_t k = 2; k < face_of(object, f).n; k++) {
      const double *a = corner(object, f, 0), *b = corner(object, f, k - 1),
                   *c = corner(object, f, k);
      sum += a[0] * (b[1] * c[2] - b[2] * c[1]) +
             a[1] * (b[2] * c[0] - b[0] * c[2]) +
             a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
  return sum;
}

/* Whether all faces of an instance are exactly planar where it is placed. */
static bool stands_plane(const struct hsr_scene *scene,
                         const struct hsr_instance *instance) {
  struct hsr_object placed = scene->objects[instance->object];
  size_t n = placed.n_vertices;
  double *xyz = malloc(3 * n * sizeof *xyz);
  for (size_t v = 0; v < n; v++)
    hsr_instance_vertex(instance->m, placed.xyz + 3 * v, xyz + 3 * v);
  placed.xyz = xyz;
  bool good = true;
  for (uint32_t f = 0; f < placed.n_faces; f++)
    good = good && is_plane(&placed, f);
  free(xyz);
  return good;
}

/* Solids: one-sided, closed, facing outward, and of exactly planar faces. */
static bool is_of_solids(const struct hsr_scene *scene) {
  bool good = true;
  for (uint32_t o = 0; o < scene->n_objects; o++) {
    const struct hsr_object *object = &scene->objects[o];
    good = good && object->one_sided && is_closed(object) && volume(object) > 0;
  }
  for (uint32_t i = 0; i < scene->n_instances; i++)
    good = good && stands_plane(scene, &scene->instances[i]);
  return good;
}

/* Where a bar of the ring crosses the next one, its corner lies on that one. */
static bool is_cyclic(const struct hsr_scene *scene) {
  static const double crossing[3][3] = {{6, -4, -3}, {0, 8, -3}, {-6, -4, -3}};
  const struct hsr_object *ring = find(scene, "ring of three");
  for (uint32_t f = 0; f < 3; f++) {
    const double *p = crossing[f], far[3] = {p[0], p[1], 1000};
    if (side_of(ring, (f + 1) % 3, p) ||
        side_of(ring, f, p) * side_of(ring, f, far) != -1)
      return false;
  }
  return true;
}

static bool penetrates(const struct hsr_scene *scene) {
  const struct hsr_object *crossed = find(scene, "crossed");
  for (uint32_t f = 0; f < 3; f++)
    for (uint32_t g = 0; g < 3; g++)
      if (f != g && !straddle(crossed, f, crossed, g))
        return false;
  const struct hsr_object *poked = find(scene, "poked");
  return straddle(poked, 0, poked, 1) && straddle(poked, 1, poked, 0);
}

static bool is_coplanar(const struct hsr_scene *scene) {
  const struct hsr_object *wall = find(scene, "wall"),
                          *slant = find(scene, "slant");
  for (uint32_t f = 1; f < wall->n_faces; f++)
    if (!same_plane(wall, 0, wall, f) || !same_plane(slant, 0, slant, f))
      return false;
  return !same_plane(wall, 0, slant, 0) &&
         !memcmp(corner(wall, 0, 0), corner(wall, 1, 0), 12 * sizeof(double)) &&
         is_closed(find(scene, "box"));
}

/* Each cube of the first row shares three planes with the first cube. */
static bool is_nested(const struct hsr_scene *scene) {
  for (uint32_t o = 1; o < 4; o++) {
    int shared = 0;
    for (uint32_t f = 0; f < 6; f++)
      shared += same_plane(&scene->objects[0], f, &scene->objects[o], f);
    if (shared != 3)
      return false;
  }
  return true;
}

static bool is_one_sided(const struct hsr_scene *scene) {
  const struct hsr_object *box = find(scene, "open box"),
                          *inverted = find(scene, "inverted box"),
                          *plates = find(scene, "back to back");
  return box->one_sided && !is_closed(box) && inverted->one_sided &&
         plates->one_sided && same_plane(plates, 0, plates, 1) &&
         !find(scene, "two-sided ribbon")->one_sided;
}

static bool is_deep(const struct hsr_scene *scene) {
  const struct hsr_object *stack = find(scene, "stack");
  int hit = 0;
  for (uint32_t f = 0; f < stack->n_faces; f++) {
    const double *a = corner(stack, f, 0), *c = corner(stack, f, 2);
    hit += a[0] < 0 && a[1] < 0 && c[0] > 0 && c[1] > 0 && a[2] == -(double)f;
  }
  return hit > 256;
}

/* The corner (19, 4) of one face is inside the edge (16, 0) - (28, 16) of
 * another. */
static bool has_t_junction(const struct hsr_scene *scene) {
  const struct hsr_object *exact = find(scene, "exact");
  const double *a = corner(exact, 5, 0), *b = corner(exact, 5, 1),
               *t = corner(exact, 6, 3);
  return a[0] == 16 && b[0] == 28 && t[0] == 19 && t[1] == 4 &&
         (b[0] - a[0]) * (t[1] - a[1]) == (b[1] - a[1]) * (t[0] - a[0]);
}

static bool all_on(const struct hsr_object *object, double z, int parity,
                   int axes) {
  for (uint32_t v = 0; v < object->n_vertices; v++)
    for (int k = 2 - axes; k < 2; k++)
      if (fabs(fmod(object->xyz[3 * (size_t)v + (size_t)k], 2)) != parity ||
          object->xyz[3 * (size_t)v + 2] != z)
        return false;
  return true;
}

/* Offsets that are odd multiples of depth / side meet samples if their number a
 * side is even; even multiples do so if it is odd. */
static bool meets_samples(const struct hsr_scene *scene) {
  return all_on(find(scene, "for 64 x 64"), -64, 1, 2) &&
         all_on(find(scene, "for 512 x 512"), -512, 1, 2) &&
         all_on(find(scene, "for 97 x 61"), -61, 0, 1);
}

static bool is_collinear(const struct hsr_scene *scene) {
  const struct hsr_object *hinge = find(scene, "hinge");
  for (uint32_t f = 0; f < hinge->n_faces; f++)
    for (uint32_t k = 0; k < 2; k++)
      if (corner(hinge, f, k)[1] != 4 || corner(hinge, f, k)[2] != 0)
        return false;
  return true;
}

static bool is_sliver(const struct hsr_scene *scene) {
  const struct hsr_object *wedges = find(scene, "wedges");
  double finest = 1;
  for (uint32_t f = 0; f < wedges->n_faces; f++) {
    double y = corner(wedges, f, 1)[1], wide = corner(wedges, f, 2)[1] - y;
    finest = fmin(finest, wide / (nextafter(fabs(y), 100) - fabs(y)));
  }
  return finest == 1;
}

/* The gaps of the first row have an odd x, which is a sample, between them. */
static bool has_gaps(const struct hsr_scene *scene) {
  const struct hsr_object *fence = find(scene, "fence");
  double least = 1;
  for (uint32_t f = 0; f + 1 < 32; f++) {
    double left = corner(fence, f, 1)[0], right = corner(fence, f + 1, 0)[0];
    if (!(left < -61 + 4.0 * f && -61 + 4.0 * f < right))
      return false;
    least = fmin(least, right - left);
  }
  return least < 0x1p-40;
}

static bool is_fan(const struct hsr_scene *scene) {
  const struct hsr_object *pleats = find(scene, "pleats");
  uint32_t about = 0;
  for (uint32_t f = 0; f < pleats->n_faces; f++)
    about += pleats->vertex[pleats->start[f]] == 0;
  return about == 720 && pleats->xyz[0] == 1 && pleats->xyz[2] == -64;
}

static bool has_reflex_corner(const struct hsr_object *object, uint32_t f) {
  uint32_t n = face_of(object, f).n;
  for (uint32_t k = 0; k < n; k++) {
    const double *a = corner(object, f, k), *b = corner(object, f, (k + 1) % n),
                 *c = corner(object, f, (k + 2) % n);
    if ((b[0] - a[0]) * (c[1] - b[1]) < (b[1] - a[1]) * (c[0] - b[0]))
      return true;
  }
  return false;
}

static bool is_non_convex(const struct hsr_scene *scene) {
  const struct hsr_object *object = find(scene, "flat");
  for (uint32_t f = 0; f < object->n_faces; f++)
    if (!has_reflex_corner(object, f))
      return false;
  return is_closed(find(scene, "comb")) && is_closed(find(scene, "spiral"));
}

static bool passes_twice(const struct hsr_object *object, uint32_t f) {
  const uint32_t *ring = object->vertex + object->start[f];
  uint32_t n = face_of(object, f).n;
  for (uint32_t k = 1; k < n; k++)
    for (uint32_t l = 0; l < k; l++)
      if (ring[k] == ring[l])
        return true;
  return false;
}

static bool has_keyholes(const struct hsr_scene *scene) {
  const struct hsr_object *made = find(scene, "plate"),
                          *sheets = find(scene, "sheets");
  return passes_twice(made, 0) && passes_twice(made, 1) && is_closed(made) &&
         passes_twice(sheets, 0) && passes_twice(sheets, 1) &&
         passes_twice(sheets, 2) && !passes_twice(sheets, 3);
}

static bool is_non_planar(const struct hsr_scene *scene) {
  const struct hsr_object *lifted = find(scene, "lifted");
  for (uint32_t f = 0; f < lifted->n_faces; f++)
    if (is_plane(lifted, f))
      return false;
  return true;
}

static bool is_huge_and_tiny(const struct hsr_scene *scene) {
  double least = 1, most = 1;
  for (uint32_t o = 0; o < scene->n_objects; o++)
    for (size_t i = 0; i < 3 * (size_t)scene->objects[o].n_vertices; i++) {
      double size = fabs(scene->objects[o].xyz[i]);
      most = fmax(most, size);
      least = size > 0 ? fmin(least, size) : least;
    }
  return least <= 1e-6 && most >= 1e6;
}

/* All faces but one have corners in front of and behind the first view's eye.
 */
static bool is_behind(const struct hsr_scene *scene) {
  const struct hsr_object *triangles = find(scene, "triangles");
  int across = 0;
  for (uint32_t f = 0; f < triangles->n_faces; f++) {
    bool before = false, behind = false;
    for (uint32_t k = 0; k < face_of(triangles, f).n; k++) {
      before = before || corner(triangles, f, k)[2] < 0;
      behind = behind || corner(triangles, f, k)[2] > 0;
    }
    across += before && behind;
  }
  return across == (int)triangles->n_faces - 1;
}

/* There are plates on the near plane of the first view, and next to it. */
static bool is_at_near(const struct hsr_scene *scene) {
  const struct hsr_object *plates = find(scene, "plates");
  return scene->views[0].near == 4 && corner(plates, 0, 0)[2] == -4 &&
         corner(plates, 2, 0)[2] == nextafter(-4, -5) &&
         corner(plates, 3, 0)[2] == nextafter(-4, 0);
}

static bool eye_is_in_planes(const struct hsr_scene *scene) {
  for (uint32_t v = 1; v < 10; v++) {
    int planes = 0;
    for (uint32_t o = 0; o < scene->n_objects; o++)
      for (uint32_t f = 0; f < scene->objects[o].n_faces; f++)
        planes += !side_of(&scene->objects[o], f, scene->views[v].eye);
    if (!planes)
      return false;
  }
  return true;
}

/* Small integers, planar faces, and eyes in the first face's plane. */
static bool is_on_lattice(const struct hsr_scene *scene) {
  for (uint32_t o = 0; o < scene->n_objects; o++) {
    const struct hsr_object *object = &scene->objects[o];
    for (size_t i = 0; i < 3 * (size_t)object->n_vertices; i++)
      if (object->xyz[i] != rint(object->xyz[i]) || fabs(object->xyz[i]) > 4)
        return false;
    for (uint32_t f = 0; f < object->n_faces; f++)
      if (!is_plane(object, f))
        return false;
  }
  const struct hsr_object *first = &scene->objects[0];
  return !side_of(first, 0, scene->views[scene->n_views - 1].eye) &&
         !side_of(first, 0, scene->views[scene->n_views - 2].eye);
}

/* Within a tolerance of Table II's figures; within twice that for clusters. */
static bool has_faces(const struct hsr_scene *scene, double wanted,
                      double clusters, double tolerance) {
  double n = 0;
  for (uint32_t i = 0; i < scene->n_instances; i++)
    n += scene->objects[scene->instances[i].object].n_faces;
  return fabs(n - wanted) < tolerance * wanted &&
         fabs(scene->n_instances - clusters) < 2 * tolerance * clusters;
}

static bool is_house(const struct hsr_scene *scene) {
  return has_faces(scene, 200, 20, 0.25) && is_of_solids(scene);
}

static bool is_harbor(const struct hsr_scene *scene) {
  return has_faces(scene, 5000, 200, 0.01) && is_of_solids(scene);
}

static bool is_big_harbor(const struct hsr_scene *scene) {
  return has_faces(scene, 120000, 600, 0.01) && is_of_solids(scene);
}

static bool is_sphere(const struct hsr_scene *scene) {
  const struct hsr_object *sphere = &scene->objects[0];
  return sphere->n_faces == 2048 && is_closed(sphere) && volume(sphere) > 24;
}

/* --- Cells --- */

static bool is_hollow_cube(const struct hsr_scene *scene) {
  uint32_t n = (uint32_t)strtoul(strchr(scene->name, ':') + 1, NULL, 10);
  const struct hsr_object *cells = &scene->objects[0];
  uint32_t outside = 6 * n * n, inside = 6 * (n - 2) * (n - 2);
  return is_closed(cells) && cells->n_faces == outside + inside &&
         volume(cells) == 6 * (n * n * n - (n - 2.0) * (n - 2) * (n - 2));
}

/* Whether a face is a rectangle across an axis. */
static bool is_side(const struct hsr_object *object, uint32_t f) {
  const uint32_t *v = object->vertex + object->start[f];
  int across = 0;
  for (int a = 0; a < 3; a++) {
    double x[4];
    for (int k = 0; k < 4; k++)
      x[k] = object->xyz[3 * (size_t)v[k] + (size_t)a];
    if (x[0] == x[1] && x[1] == x[2] && x[2] == x[3])
      across++;
    else if (!((x[0] == x[1] && x[2] == x[3]) ||
               (x[1] == x[2] && x[3] == x[0])))
      return false;
  }
  return across == 1 && object->start[f + 1] - object->start[f] == 4;
}

static bool is_of_cells(const struct hsr_scene *scene) {
  const struct hsr_object *cells = &scene->objects[0];
  for (uint32_t f = 0; f < cells->n_faces; f++)
    if (!is_side(cells, f))
      return false;
  return cells->one_sided && volume(cells) > 0;
}

static bool is_terrain(const struct hsr_scene *scene) {
  const struct hsr_grid *grid = scene->grid;
  double ratio = grid->n_cells / ((double)grid->n[0] * grid->n[2]);
  printf("# %s: %.2f cells a column, %u levels\n", scene->name, ratio,
         grid->n[1]);
  return ratio > 1.4 && ratio < 2.1;
}

static bool is_checker_plane(const struct hsr_scene *scene) {
  return scene->grid->n_cells == 198204;
}

static bool is_of_tubes(const struct hsr_scene *scene) {
  printf("# tubules: %u cells\n", scene->grid->n_cells);
  return fabs(scene->grid->n_cells / 344e3 - 1) < 0.1;
}

/* The least and greatest a x + b y + c z over the 8 vertices of solid i. */
static void extent(const struct hsr_object *module, uint32_t i,
                   const double n[3], double *low, double *high) {
  *low = INFINITY;
  *high = -INFINITY;
  for (uint32_t v = 8 * i; v < 8 * i + 8; v++) {
    const double *p = module->xyz + 3 * (size_t)v;
    double d = n[0] * p[0] + n[1] * p[1] + n[2] * p[2];
    *low = fmin(*low, d);
    *high = fmax(*high, d);
  }
}

/* All solids are boxes, or bars along the stairs, which rise by 2 in 3. Two of
 * them are apart, or touch, if they are so along one of four directions. On the
 * lattice of 64ths all is exact. */
static bool are_apart(const struct hsr_object *module, uint32_t i, uint32_t k) {
  static const double normal[4][3] = {
      {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-2, 3, 0}};
  for (int a = 0; a < 4; a++) {
    double low_i, high_i, low_k, high_k;
    extent(module, i, normal[a], &low_i, &high_i);
    extent(module, k, normal[a], &low_k, &high_k);
    if (high_i <= low_k || high_k <= low_i)
      return true;
  }
  return false;
}

/* Whether solids of 8 vertices are apart and on the lattice. If solids face
 * outward and do not overlap, no two coplanar faces that overlap are visible
 * from the same side. */
static bool touch_at_most(const struct hsr_object *object) {
  uint32_t n = object->n_vertices / 8;
  bool good = object->n_vertices == 8 * n && object->one_sided &&
              is_closed(object) && volume(object) > 0;
  for (size_t i = 0; i < 3 * (size_t)object->n_vertices; i++)
    good = good && 64 * object->xyz[i] == rint(64 * object->xyz[i]);
  for (uint32_t i = 0; i < n && good; i++)
    for (uint32_t k = 0; k < i && good; k++)
      if (!(good = are_apart(object, i, k)))
        printf("# solids %u and %u of %s overlap\n", k, i, object->name);
  return good;
}

static bool is_office(const struct hsr_scene *scene) {
  const struct hsr_object *module = &scene->objects[0];
  uint32_t n = module->n_vertices / 8;
  bool good = scene->n_objects == 1 && n == 1248 && module->n_faces == 12 * n &&
              module->start[module->n_faces] == 3 * module->n_faces;
  for (size_t i = 0; i < 3 * (size_t)module->n_vertices; i++)
    good = good && module->xyz[i] >= 0 && module->xyz[i] <= 16;
  return good && touch_at_most(module);
}

/* The number of the solid that the eye is in, or n. */
static uint32_t solid_about(const struct hsr_object *module,
                            const double eye[3]) {
  uint32_t n = module->n_vertices / 8;
  for (uint32_t i = 0; i < n; i++) {
    bool outside = false;
    for (uint32_t f = 12 * i; f < 12 * i + 12; f++)
      outside = outside || side_of(module, f, eye) > 0;
    if (!outside)
      return i;
  }
  return n;
}

static double distance(const double a[3], const double b[3]) {
  return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
              (a[2] - b[2]) * (a[2] - b[2]));
}

/* The walk goes in small steps, stays in the module, and passes through nothing
 * solid, at four points between each two views. */
static bool is_walked(const struct hsr_scene *scene) {
  const struct hsr_object *module = &scene->objects[0];
  uint32_t n = module->n_vertices / 8;
  bool good = scene->n_views >= 64;
  for (uint32_t v = 0; v + 1 < scene->n_views && good; v++) {
    const struct hsr_camera *a = &scene->views[v], *b = a + 1;
    double ahead[2][3], step = distance(a->eye, b->eye);
    for (int k = 0; k < 3; k++) {
      ahead[0][k] = a->at[k] - a->eye[k];
      ahead[1][k] = b->at[k] - b->eye[k];
      good = good && a->eye[k] > 0 && a->eye[k] < 16;
    }
    good = good && step < 0.27 && distance(ahead[0], ahead[1]) < 0.08;
    for (int i = 0; i < 4 && good; i++) {
      double p[3];
      for (int k = 0; k < 3; k++)
        p[k] = a->eye[k] + 0.25 * i * (b->eye[k] - a->eye[k]);
      good = solid_about(module, p) == n;
    }
  }
  return good;
}

/* The modules are placed at multiples of 16 m, and have 538 million faces. */
static bool is_half_a_billion(const struct hsr_scene *scene) {
  static const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  bool good =
      scene->n_instances == 35937 &&
      (uint64_t)scene->n_instances * scene->objects[0].n_faces == 538192512;
  for (uint32_t i = 0; i < scene->n_instances && good; i++)
    for (int k = 0; k < 12; k++) {
      double moved = scene->instances[i].m[k] - identity[k];
      good = good &&
             (k % 4 == 3 ? fmod(moved, 16) == 0 && moved < 528 : moved == 0);
    }
  return good && scene->views[0].eye[0] > 256 && scene->views[0].eye[0] < 272;
}

/* A box about an object or an instance. */
struct box {
  double low[3], high[3];
};

static struct box box_about(const struct hsr_object *object) {
  struct box box = {{INFINITY, INFINITY, INFINITY},
                    {-INFINITY, -INFINITY, -INFINITY}};
  for (uint32_t v = 0; v < object->n_vertices; v++) {
    const double *p = object->xyz + 3 * (size_t)v;
    for (int k = 0; k < 3; k++) {
      box.low[k] = fmin(box.low[k], p[k]);
      box.high[k] = fmax(box.high[k], p[k]);
    }
  }
  return box;
}

static int compare_low(const void *a, const void *b) {
  double p = ((const struct box *)a)->low[1],
         q = ((const struct box *)b)->low[1];
  return (p > q) - (p < q);
}

/* Whether the boxes touch at most; sorts them by height. */
static bool boxes_are_apart(struct box *box, uint32_t n) {
  qsort(box, n, sizeof *box, compare_low);
  for (uint32_t i = 0; i < n; i++)
    for (uint32_t k = i + 1; k < n && box[k].low[1] < box[i].high[1]; k++)
      if (box[k].low[0] < box[i].high[0] && box[i].low[0] < box[k].high[0] &&
          box[k].low[2] < box[i].high[2] && box[i].low[2] < box[k].high[2])
        return false;
  return true;
}

/* Whether an instance is only moved, by multiples of 1/64. */
static bool is_moved(const struct hsr_instance *instance) {
  static const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  bool good = true;
  for (int k = 0; k < 12; k++) {
    double m = 64 * (instance->m[k] - identity[k]);
    good = good && (k % 4 == 3 ? m == rint(m) : m == 0);
  }
  return good;
}

/* Quadrilaterals of solids on the lattice, in boxes that touch at most. */
static bool is_stacked(const struct hsr_scene *scene) {
  struct box *of_object = malloc(scene->n_objects * sizeof *of_object);
  struct box *box = malloc(scene->n_instances * sizeof *box);
  bool good = true;
  for (uint32_t o = 0; o < scene->n_objects; o++) {
    const struct hsr_object *object = &scene->objects[o];
    good = good && touch_at_most(object) &&
           4 * object->n_faces == 3 * object->n_vertices &&
           object->start[object->n_faces] == 4 * object->n_faces;
    for (uint32_t f = 0; f < object->n_faces; f++)
      good = good && is_plane(object, f);
    of_object[o] = box_about(object);
  }
  for (uint32_t i = 0; i < scene->n_instances; i++) {
    const struct hsr_instance *instance = &scene->instances[i];
    good = good && is_moved(instance);
    for (int k = 0; k < 3; k++) {
      double by = instance->m[4 * k + 3];
      box[i].low[k] = of_object[instance->object].low[k] + by;
      box[i].high[k] = of_object[instance->object].high[k] + by;
    }
  }
  good = good && boxes_are_apart(box, scene->n_instances);
  free(of_object);
  free(box);
  return good;
}

/* 21,836 modules in 102 layers, and what is around them. */
static bool is_tower(const struct hsr_scene *scene) {
  uint32_t n_modules = 0;
  for (uint32_t i = 0; i < scene->n_instances; i++)
    n_modules += scene->instances[i].object == 0;
  return has_faces(scene, 167e6, 29000, 0.01) && n_modules == 21836 &&
         scene->objects[0].n_faces == 7488 && is_stacked(scene);
}

/* Three models: closed wood, and leaves that are two-sided. */
static bool has_plants(const struct hsr_scene *scene) {
  uint32_t n_wood = 0, n_leaves = 0;
  bool good = scene->n_objects == 7 && scene->n_views == 10;
  for (uint32_t i = 0; i < scene->n_instances; i++) {
    n_wood += scene->instances[i].object % 2 == 1;
    n_leaves +=
        scene->instances[i].object > 0 && scene->instances[i].object % 2 == 0;
  }
  for (uint32_t o = 1; o < 7 && good; o += 2) {
    const struct hsr_object *wood = &scene->objects[o], *leaves = wood + 1;
    good = wood->one_sided && is_closed(wood) && volume(wood) > 0 &&
           !leaves->one_sided && wood->n_faces + leaves->n_faces == 5288;
  }
  return good && n_wood == 10000 && n_leaves == 10000;
}

static const struct {
  const char *name, *claim;
  bool (*holds)(const struct hsr_scene *scene);
} claims[] = {
    {"house", "200 faces of some 20 solids", is_house},
    {"harbor", "5,000 faces of 200 clusters, solids all", is_harbor},
    {"big-harbor", "120,000 faces of 600 clusters", is_big_harbor},
    {"color-cube", "solids all", is_of_solids},
    {"twist:3", "solids all", is_of_solids},
    {"sphere", "closed, outward, 2,048 faces", is_sphere},
    {"office", "1,248 closed solids on a lattice, which touch at most",
     is_office},
    {"office", "a walk in small steps through nothing solid", is_walked},
    {"office:33", "538,192,512 faces of modules on a lattice",
     is_half_a_billion},
    {"tower", "167 million quadrilaterals of solids that touch at most",
     is_tower},
    {"tower-bare", "solids that touch at most", is_stacked},
    {"tower:4", "solids that touch at most", is_stacked},
    {"tower:60", "solids that touch at most", is_stacked},
    {"tower:333", "solids that touch at most", is_stacked},
    {"terrain:8:10000", "10,000 plants of closed wood and open leaves",
     has_plants},
    {"lattice", "small integers, plane faces", is_on_lattice},
    {"lattice:50:99", "small integers, plane faces", is_on_lattice},
    {"checker-cube:3", "a hollow cube of cells", is_hollow_cube},
    {"checker-cube:40", "a hollow cube of cells", is_hollow_cube},
    {"grid", "sides of cells, outwards", is_of_cells},
    {"grid:30:2", "sides of cells, outwards", is_of_cells},
    {"heights", "sides of cells, outwards", is_of_cells},
    {"heights:256:1", "1.4 to 2.1 cells a column", is_terrain},
    {"heights:512:1", "1.4 to 2.1 cells a column", is_terrain},
    {"checker-plane", "198,204 cells", is_checker_plane},
    {"tubules", "344,000 cells, to a tenth", is_of_tubes},
    {"cyclic-overlap", "each bar lies over the next", is_cyclic},
    {"penetration", "faces are on both sides of others", penetrates},
    {"coplanar", "all faces of a sheet have one plane", is_coplanar},
    {"nested-solids", "cubes share three planes", is_nested},
    {"one-sided", "open and one-sided", is_one_sided},
    {"deep-stack", "one ray hits more than 256 faces", is_deep},
    {"t-junction", "a corner is inside an edge", has_t_junction},
    {"shared-edges", "vertices lie at samples", meets_samples},
    {"collinear-edges", "edges lie on one line", is_collinear},
    {"sliver", "the finest is one unit in the last place wide", is_sliver},
    {"sub-pixel-gap", "samples lie in gaps of 2^-40", has_gaps},
    {"needle-fan", "720 faces have one vertex in common", is_fan},
    {"non-convex", "every face has a reflex corner", is_non_convex},
    {"keyholes", "faces pass vertices twice; closed", has_keyholes},
    {"non-planar", "no corner-lifted face is plane", is_non_planar},
    {"huge-and-tiny", "from 1e-6 to 1e6", is_huge_and_tiny},
    {"behind-eye", "faces reach from before to behind the eye", is_behind},
    {"near-plane", "faces lie on the near plane and next to it", is_at_near},
    {"eye-in-plane", "the eye is in a plane", eye_is_in_planes}};

static void check_claims(struct tap *tap) {
  for (int i = 0; i < COUNT(claims); i++) {
    struct hsr_scene *scene = open_scene(claims[i].name);
    ok(tap, claims[i].holds(scene), "%s: %s", claims[i].name, claims[i].claim);
    hsr_scene_delete(scene);
  }
}

/* Meshes: the user's own folder, and the archive. */
static void write_file(const char *folder, const char *name) {
  char path[512];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  FILE *file = fopen(path, "w");
  if (file) {
    fputs("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", file);
    fclose(file);
  }
}

static void remove_file(const char *folder, const char *name) {
  char path[512];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  remove(path);
}

static bool names_are(const char *const *wanted, size_t n_wanted) {
  struct hsr_names list = {0};
  bool good = !hsr_mesh_names(&list.names, &list.n, NULL) && list.n == n_wanted;
  for (size_t i = 0; good && i < n_wanted; i++)
    good = !strcmp(list.names[i], wanted[i]);
  hsr_names_free(&list);
  return good;
}

static bool finds(const char *name, const char *file) {
  char *path = NULL;
  struct hsr_error err = {HSR_OK, ""};
  bool good = !hsr_mesh_find(name, &path, &err) &&
              !strcmp(strrchr(path, '/') + 1, file);
  if (!good)
    printf("# %s: %s%s\n", name, path ? path : "", err.text);
  free(path);
  return good;
}

static void check_own_folder(struct tap *tap, const char *folder) {
  static const char *const files[] = {"wedge.off", "wedge.stl", "ball.ply",
                                      "a+b^2.off", "notes.txt"};
  static const char *const names[] = {"a+b^2", "ball", "wedge"};
  for (int i = 0; i < COUNT(files); i++)
    write_file(folder, files[i]);
  setenv("HSR_MESH_DIR", folder, 1);
  ok(tap, names_are(names, 3), "the names of one's own meshes, each once");
  ok(tap,
     finds("wedge", "wedge.off") && finds("ball", "ball.ply") &&
         finds("wedge.stl", "wedge.stl") && finds("a+b^2", "a+b^2.off"),
     "meshes are found with and without a suffix");
  ok(tap,
     refused("mesh:wege", "did you mean wedge") &&
         refused("mesh:notes", "no mesh notes in HSR_MESH_DIR"),
     "a mesh that is not there is not found");
  for (int i = 0; i < COUNT(files); i++)
    remove_file(folder, files[i]);
  ok(tap, names_are(NULL, 0), "no mesh, no name");
  unsetenv("HSR_MESH_DIR");
}

static bool is_empty_of_temporaries(const char *folder) {
  char path[512];
  snprintf(path, sizeof path, "%s/hsr/meshes", folder);
  setenv("HSR_MESH_DIR", path, 1);
  static const char *const one[] = {"cube_quad"};
  bool good = names_are(one, 1);
  unsetenv("HSR_MESH_DIR");
  return good;
}

static void check_archive(struct tap *tap, const char *folder) {
  static const char *const made[] = {"hsr/meshes/cube_quad.off", "hsr/meshes",
                                     "hsr"};
  struct hsr_names list = {0};
  setenv("XDG_CACHE_HOME", folder, 1);
  bool listed = !hsr_mesh_names(&list.names, &list.n, NULL);
  if (listed && !list.n) {
    ok(tap, true, "the archive's names # SKIP libcgal-demo is not there");
    ok(tap, true, "a mesh of the archive # SKIP libcgal-demo is not there");
    ok(tap, true, "a mesh it lacks # SKIP libcgal-demo is not there");
  } else {
    ok(tap, listed && list.n > 100, "the archive has %zu meshes", list.n);
    ok(tap,
       finds("cube_quad", "cube_quad.off") &&
           finds("cube_quad", "cube_quad.off") &&
           is_empty_of_temporaries(folder),
       "a mesh is taken from the archive, whole, and kept");
    ok(tap, refused("mesh:elefant", "did you mean elephant"),
       "a mesh that the archive lacks is not found");
  }
  hsr_names_free(&list);
  for (int i = 0; i < COUNT(made); i++)
    remove_file(folder, made[i]);
}

static void check_meshes(struct tap *tap) {
  char folder[] = "/tmp/scenes_test.XXXXXX";
  if (!mkdtemp(folder))
    bail("no temporary folder");
  unsetenv("HSR_MESH_DIR");
  check_own_folder(tap, folder);
  check_archive(tap, folder);
  setenv("XDG_CACHE_HOME", "/dev/null", 1);
  ok(tap, refused("mesh:cube_quad", "/dev/null/hsr"),
     "a cache that cannot be made is said to be so");
  unsetenv("XDG_CACHE_HOME");
  unsetenv("HOME");
  ok(tap, refused("mesh:cube_quad", "nowhere to keep"),
     "without a home there is no cache");
  rmdir(folder);
}

int main(void) {
  struct tap tap = plan(2 * COUNT(known) + 3 + 7 + 2 + COUNT(claims) + 14);
  for (int i = 0; i < COUNT(known); i++)
    check_known(&tap, i);
  check_table(&tap);
  check_cameras(&tap);
  check_palettes(&tap);
  check_tiny(&tap);
  check_bad_names(&tap);
  check_claims(&tap);
  check_meshes(&tap);
  return finish(&tap);
}
