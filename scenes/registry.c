/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of built-in scenes, and the way from a user's words to a scene. */
#ifndef _POSIX_C_SOURCE
#define _POSIX_C_SOURCE 200809L
#endif

#include "scenes/builders.h"
#include "scenes/cameras.h"
#include "scenes/meshes.h"

#include "common/files/json/scene_json.h"
#include "common/files/volume/volume.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#define PLAIN(scene, function, sentence)                                       \
  { .name = scene, .usage = scene, .about = sentence, .build = function }
#define FAILURE(scene, function, sentence)                                     \
  {                                                                            \
    .name = scene, .usage = scene, .about = sentence, .failure_case = true,    \
    .build = function                                                          \
  }
#define SIZED(scene, function, normal, low, high, sentence)                    \
  {                                                                            \
    .name = scene, .usage = scene ":N", .about = sentence, .n_parameters = 1,  \
    .standard = {normal}, .least = {low}, .most = {high}, .build = function    \
  }
#define SEEDED(scene, function, normal, low, high, sentence)                   \
  {                                                                            \
    .name = scene, .usage = scene ":N:SEED", .about = sentence,                \
    .n_parameters = 2, .standard = {normal, 1}, .least = {low, 0},             \
    .most = {high, INT64_MAX}, .build = function                               \
  }

#define TOWER(scene, function, sentence)                                       \
  {                                                                            \
    .name = scene, .usage = scene ":STOREYS", .about = sentence,               \
    .only_by_name = true, .n_parameters = 1, .standard = {408}, .least = {1},  \
    .most = {408}, .build = function                                           \
  }

#define PACKAGED(scene, words, n, function, of, path, sentence)                \
  {                                                                            \
    .name = scene, .usage = words, .about = sentence, .only_by_name = true,    \
    .package = of, .file = path, .n_parameters = n, .standard = {60},          \
    .least = {0}, .most = {255}, .build = function                             \
  }

const struct hsr_builtin hsr_builtins[] = {
    PLAIN("house", hsr_build_house,
          "a house of convex solids that touch at most, after Roberts' house "
          "in Table II"),
    SIZED("harbor", hsr_build_harbor, 2500, 100, 60000,
          "a harbor and its town with about N faces in the picture, after "
          "Table II"),
    PLAIN("big-harbor", hsr_build_big_harbor,
          "the harbor in fine detail, 60,000 faces in the picture, after "
          "Table II"),
    SIZED("color-cube", hsr_build_color_cube, 6, 1, 40,
          "N x N x N small cubes, each in the colour of its place"),
    SIZED("color-sides", hsr_build_color_sides, 8, 1, 500,
          "a cube whose sides are N x N squares, after Greene"),
    SIZED("twist", hsr_build_twist, 40, 1, 20000,
          "a tower of N instances of one storey, each turned a little"),
    SIZED("sphere", hsr_build_sphere, 2048, 8, 20000000,
          "a sphere of about N triangles"),
    {.name = "terrain",
     .usage = "terrain:N:PLANTS",
     .about = "a landscape of 2 N x N triangles, with about PLANTS plants of "
              "5,288 triangles each: 512:10000 has 53 million, 128:1000 five",
     .n_parameters = 2,
     .standard = {64, 0},
     .least = {2, 0},
     .most = {2000, 250000},
     .build = hsr_build_terrain},
    {.name = "office",
     .usage = "office:NX:NY:NZ",
     .about = "a building of NX x NY x NZ modules (NY and NZ, if 0, as NX) of "
              "14,976 triangles, and a walk in it: 33 has 538 million",
     .only_by_name = true,
     .n_parameters = 3,
     .standard = {1, 0, 0},
     .least = {1, 0, 0},
     .most = {65, 65, 65},
     .build = hsr_build_office},
    {.name = "traffic",
     .usage = "traffic:PERCENT:FRAME:WAY",
     .about = "the office of 3 x 3 x 3 modules with carts on the move: PERCENT "
              "of all faces move, from frame to frame, back and forth on WAY "
              "metres each, or (0) through all of the building",
     .only_by_name = true,
     .n_parameters = 3,
     .standard = {1, 0, 0},
     .least = {1, 0, 0},
     .most = {90, 1000000, 48},
     .build = hsr_build_traffic},
    TOWER("tower", hsr_build_tower,
          "an office building of STOREYS storeys (rounded up to a multiple of "
          "4) in a shell with windows: 408 have 167 million quadrilaterals"),
    TOWER("tower-bare", hsr_build_bare_tower,
          "the tower of STOREYS storeys without its shell"),
    {.name = "rooms",
     .usage = "rooms:N:DOORS",
     .about = "N x N rooms with a few boards in each; DOORS of a hundred doors "
              "between them are open",
     .n_parameters = 2,
     .standard = {5, 100},
     .least = {1, 0},
     .most = {100, 100},
     .build = hsr_build_rooms},
    PLAIN("greenhouse", hsr_build_greenhouse,
          "panes between bars, plants, a vase and water: transparent faces"),
    {.name = "soup",
     .usage = "soup:N:SEED",
     .about = "N random triangles that penetrate one another",
     .n_parameters = 2,
     .standard = {1000, 1},
     .least = {1, 0},
     .most = {2000000000, INT64_MAX},
     .build = hsr_build_soup,
     .build_part = hsr_build_soup_part},
    SEEDED("lattice", hsr_build_lattice, 200, 1, 1000000,
           "N random polygons with small integer coordinates, seen so that "
           "vertices, edges and planes meet the samples"),
    SEEDED("panes", hsr_build_panes, 60, 1, 1000000,
           "the same, with opacities from 0 to 1"),
    SIZED("checker-cube", hsr_build_checker_cube, 12, 3, 256,
          "a hollow cube of N x N x N cells in red and white blocks, after "
          "Swan: 40 and 60 in his figures"),
    SEEDED(
        "grid", hsr_build_grid, 6, 2, 200,
        "a grid of N x N x N cells of random sizes, of which two of five are "
        "kept"),
    SEEDED("heights", hsr_build_heights, 64, 2, 1024,
           "terrain of N x N columns of cells, by diamonds and squares, after "
           "Swan: 256 and 512 in his figures"),
    {.name = "checker-plane",
     .usage = "checker-plane",
     .about = "a plane of 498 x 398 cells in squares of 10 x 10, after Swan",
     .only_by_name = true,
     .build = hsr_build_checker_plane},
    {.name = "tubules",
     .usage = "tubules",
     .about = "50 winding tubes in 420 x 468 x 62 samples, after the "
              "microtubules of Swan",
     .only_by_name = true,
     .build = hsr_build_tubules},
    PACKAGED("colorado", "colorado", 0, hsr_build_colorado, "dxsamples",
             HSR_COLORADO_FILE,
             "terrain of Colorado, 400 x 400 columns in the colours of a "
             "photograph"),
    PACKAGED("brain", "brain:LEAST", 1, hsr_build_brain, "libvolpack1-dev",
             HSR_BRAIN_FILE,
             "a head in 128 x 128 x 84 samples, of which those of a density "
             "of LEAST and more are kept"),
    PACKAGED("colin27", "colin27:LEAST", 1, hsr_build_colin27, "mricron-data",
             HSR_COLIN27_FILE,
             "a head in 181 x 217 x 181 samples, of which those of a density "
             "of LEAST and more are kept"),

    FAILURE("cyclic-overlap", hsr_build_cyclic_overlap,
            "faces and solids in rings, each over the next: no order of "
            "priority without dividing"),
    FAILURE("penetration", hsr_build_penetration,
            "faces through faces: breaks methods that let visibility change "
            "only at edges"),
    FAILURE("coplanar", hsr_build_coplanar,
            "overlapping, repeated and reversed faces on one plane: breaks "
            "depth comparisons without a rule for ties"),
    FAILURE("nested-solids", hsr_build_nested_solids,
            "solids in solids that share planes: breaks tests of containment "
            "and of solids against edges"),
    FAILURE("one-sided", hsr_build_one_sided,
            "open, inverted and back-to-back faces without back sides: breaks "
            "culling that takes closed solids for granted"),
    FAILURE("deep-stack", hsr_build_deep_stack,
            "300 faces over one another: breaks counts of invisibility kept "
            "in 8 bits, and depth ranges"),
    FAILURE("t-junction", hsr_build_t_junction,
            "vertices in the middle of edges, exactly and nearly: breaks "
            "methods that leave or fill cracks"),
    FAILURE("shared-edges", hsr_build_shared_edges,
            "edges and vertices shared exactly at samples: breaks fill rules "
            "that take a sample twice or never"),
    FAILURE("collinear-edges", hsr_build_collinear_edges,
            "edges upon edges of one line, in the world or in the picture: "
            "breaks edge lists sorted by intersection"),
    FAILURE("sliver", hsr_build_sliver,
            "triangles down to one unit in the last place wide: breaks planes "
            "and slopes computed in floating point"),
    FAILURE("sub-pixel-gap", hsr_build_sub_pixel_gap,
            "gaps far narrower than a sample, some of them at one: breaks "
            "spans with rounded ends and area sampling"),
    FAILURE("needle-fan", hsr_build_needle_fan,
            "many thin triangles about one vertex: breaks sorting of edges "
            "that meet, and subdivision that cannot end there"),
    FAILURE("non-convex", hsr_build_non_convex,
            "combs, stars and spirals: breaks span generators that expect two "
            "edges on a line"),
    FAILURE("keyholes", hsr_build_keyholes,
            "rings that pass a vertex twice or run along a bridge: breaks "
            "methods that take every ring for a simple polygon"),
    FAILURE("non-planar", hsr_build_non_planar,
            "quadrilaterals slightly and grossly out of plane: breaks methods "
            "that take a plane from three corners"),
    FAILURE("huge-and-tiny", hsr_build_huge_and_tiny,
            "sizes from 1e-6 to 1e6 in one picture: breaks fixed tolerances "
            "and fixed point"),
    FAILURE("behind-eye", hsr_build_behind_eye,
            "faces that reach behind the eye: breaks projection without "
            "clipping"),
    FAILURE("near-plane", hsr_build_near_plane,
            "faces cut by the near plane and exactly on it: breaks clipping "
            "that rounds, and its closed or open end"),
    FAILURE("eye-in-plane", hsr_build_eye_in_plane,
            "the eye in planes, on edges' lines and on vertices: breaks signs "
            "of facing that know no zero"),
    {.name = NULL}};

bool hsr_builtin_is_there(const struct hsr_builtin *builtin) {
  return !builtin->file || !access(builtin->file, R_OK);
}

static bool has_suffix(const char *name, const char *suffix) {
  size_t n = strlen(name), k = strlen(suffix);
  return n > k && !strcasecmp(name + n - k, suffix);
}

static enum hsr_status open_mesh(struct hsr_scene *scene, const char *name,
                                 struct hsr_import *import,
                                 struct hsr_error *err) {
  char *path;
  enum hsr_status status = hsr_mesh_find(name, &path, err);
  if (!status)
    status = hsr_mesh_read(scene, path, import, err);
  free(path);
  return status;
}

static const struct hsr_builtin *find_builtin(const char *name, size_t n) {
  for (const struct hsr_builtin *b = hsr_builtins; b->name; b++)
    if (strlen(b->name) == n && !memcmp(b->name, name, n))
      return b;
  return NULL;
}

bool hsr_is_made_by_name(const char *name) {
  const struct hsr_builtin *builtin = find_builtin(name, strcspn(name, ":@"));
  return builtin && !builtin->file;
}

/* What hsr export writes, but nothing reads. */
static bool is_only_written(const char *name) {
  return has_suffix(name, ".vtu");
}

/* Curved solids, of which some other program has to make polygons. */
static bool is_curved(const char *name) {
  static const char *const ending[] = {".step", ".stp",  ".iges",
                                       ".igs",  ".brep", ".3dm"};
  bool found = false;
  for (int k = 0; k < (int)(sizeof ending / sizeof *ending); k++)
    found |= has_suffix(name, ending[k]);
  return found;
}

static enum hsr_status unknown(const char *name, struct hsr_error *err) {
  char word[64], hint[256] = "";
  snprintf(word, sizeof word, "%.*s", (int)strcspn(name, ":"), name);
  hsr_names_like_of(hsr_builtins, sizeof *hsr_builtins, word, hint,
                    sizeof hint);
  if (is_only_written(name))
    return hsr_fail(err, HSR_E_INPUT,
                    "%.200s: hsr writes such files, but does not read them; "
                    "export the model as .obj, .ply, .glb, .stl, .off or .vtp",
                    name);
  if (strpbrk(name, "./"))
    return hsr_fail(
        err, HSR_E_INPUT,
        "%.200s: not a scene: %sfiles end in .scene.json, .off, "
        ".obj, .ply, .stl, .vtp, .gltf or .glb; volumes in .nii, .nii.gz, "
        ".mhd, .mha, .nrrd, .nhdr, .vtk, .vti or .vtr",
        name,
        is_curved(name) ? "such a file holds curved surfaces, and hsr draws "
                          "polygons: export a mesh of it, as .obj, from the "
                          "program that made it; "
                        : "");
  return hsr_fail(err, HSR_E_INPUT, "there is no scene \"%.100s\"%s", name,
                  hint);
}

/* Reads a whole number of digits alone. False if it is none, or too large. */
static bool parse_number(const char *text, size_t n, long long *value) {
  *value = 0;
  for (size_t i = 0; i < n; i++) {
    int digit = text[i] - '0';
    if (digit < 0 || digit > 9 || *value > (INT64_MAX - digit) / 10)
      return false;
    *value = 10 * *value + digit;
  }
  return n > 0;
}

/* The word for a parameter in a usage, from the colon before it. */
static const char *parameter_word(const struct hsr_builtin *builtin, int i) {
  const char *word = builtin->usage;
  for (int k = 0; k <= i; k++)
    word = strchr(word, ':') + 1;
  return word;
}

static enum hsr_status bad_parameter(const struct hsr_builtin *builtin, int i,
                                     const char *text, size_t n,
                                     struct hsr_error *err) {
  const char *word = parameter_word(builtin, i);
  return hsr_fail(err, HSR_E_INPUT,
                  "%s: %.*s must be a whole number from %lld to %lld, not "
                  "\"%.*s\" (usage: %s)",
                  builtin->name, (int)strcspn(word, ":"), word,
                  builtin->least[i], builtin->most[i], (int)(n < 40 ? n : 40),
                  text, builtin->usage);
}

/* Parameters after the name, each with its colon before it; those left out at
 * the end have their standard values. */
static enum hsr_status parse_parameters(const struct hsr_builtin *builtin,
                                        const char *text, long long *parameter,
                                        struct hsr_error *err) {
  memcpy(parameter, builtin->standard, sizeof builtin->standard);
  for (int i = 0; *text; i++) {
    size_t n = strcspn(++text, ":");
    if (i == builtin->n_parameters)
      return hsr_fail(err, HSR_E_INPUT, "%s: too many parameters (usage: %s)",
                      builtin->name, builtin->usage);
    if (!parse_number(text, n, &parameter[i]) ||
        parameter[i] < builtin->least[i] || parameter[i] > builtin->most[i])
      return bad_parameter(builtin, i, text, n, err);
    text += n;
  }
  return HSR_OK;
}

/* Finds a built-in scene and its parameters. */
static enum hsr_status read_builtin(const char *name,
                                    const struct hsr_builtin **builtin,
                                    long long *parameter,
                                    struct hsr_error *err) {
  size_t n = strcspn(name, ":");
  *builtin = find_builtin(name, n);
  if (!*builtin)
    return unknown(name, err);
  enum hsr_status status = parse_parameters(*builtin, name + n, parameter, err);
  if (!status && !hsr_builtin_is_there(*builtin))
    return hsr_fail(err, HSR_E_INPUT,
                    "%s: %s is missing; on Debian: apt-get install %s",
                    (*builtin)->name, (*builtin)->file, (*builtin)->package);
  return status;
}

static enum hsr_status tell_building(const char *name, enum hsr_status status,
                                     struct hsr_error *err) {
  if (status == HSR_E_NOMEM)
    return hsr_fail_nomem(err);
  return status ? hsr_fail(err, status, "%.100s: cannot be built", name)
                : HSR_OK;
}

static enum hsr_status open_builtin(struct hsr_scene *scene, const char *name,
                                    struct hsr_error *err) {
  const struct hsr_builtin *builtin;
  long long parameter[HSR_MAX_PARAMETERS];
  enum hsr_status status = read_builtin(name, &builtin, parameter, err);
  return status ? status
                : tell_building(name, builtin->build(scene, parameter), err);
}

/* FILE.scene.json:FRAME: the length of FILE.scene.json, and the frame. 0 if the
 * name is none of this kind. */
static size_t file_before_frame(const char *name, long *frame) {
  const char *colon = strrchr(name, ':');
  size_t n = colon ? (size_t)(colon - name) : 0;
  static const char suffix[] = ".scene.json";
  const size_t length = sizeof suffix - 1;
  if (n <= length || strncmp(colon - length, suffix, length))
    return 0;
  char *end;
  errno = 0;
  *frame = strtol(colon + 1, &end, 10);
  return end == colon + 1 || *end || errno || labs(*frame) > INT32_MAX ? 0 : n;
}

static enum hsr_status open_frame(struct hsr_scene *scene, const char *name,
                                  size_t n, long frame,
                                  struct hsr_import *import,
                                  struct hsr_error *err) {
  char *file = strndup(name, n);
  enum hsr_status status =
      file ? hsr_scene_json_read_frame(scene, file, frame, import, err)
           : hsr_fail_nomem(err);
  free(file);
  return status;
}

static enum hsr_status fill(struct hsr_scene *scene, const char *name,
                            struct hsr_import *import, struct hsr_error *err) {
  if (!strncmp(name, "mesh:", 5))
    return open_mesh(scene, name + 5, import, err);
  const char *path = import && import->path ? import->path : name;
  if (has_suffix(name, ".scene.json"))
    return hsr_scene_json_read(scene, path, import, err);
  long frame;
  size_t file = file_before_frame(name, &frame);
  if (file)
    return open_frame(scene, name, file, frame, import, err);
  if (hsr_is_mesh_name(name))
    return hsr_mesh_read(scene, path, import, err);
  if (hsr_is_volume_name(name))
    return hsr_volume_read(scene, path, import, err);
  return open_builtin(scene, name, err);
}

/* Opens a scene without cameras in its name. */
static enum hsr_status open_plain(struct hsr_scene *scene, const char *name,
                                  struct hsr_import *import,
                                  struct hsr_error *err) {
  enum hsr_status status = fill(scene, name, import, err);
  if (status)
    return status;
  struct hsr_error unfit;
  status = hsr_scene_finish(scene, &unfit);
  if (status == HSR_E_INPUT)
    return hsr_fail(err, status, "%.150s: %.300s", name, unfit.text);
  if (status && err)
    *err = unfit;
  return status;
}

/* --- Parts ---------------------------------------------------------------- */

/* Whether the name is of a scene whose parts are made alone. */
static bool is_made_by_parts(const char *name) {
  const struct hsr_builtin *builtin = find_builtin(name, strcspn(name, ":"));
  return builtin && builtin->build_part;
}

/* A part of a scene that is made by parts. It is not so small that it would have
 * to be enlarged. */
static enum hsr_status make_part(struct hsr_scene *scene, const char *name,
                                 struct hsr_scene_part *part,
                                 struct hsr_error *err) {
  const struct hsr_builtin *builtin;
  long long parameter[HSR_MAX_PARAMETERS];
  enum hsr_status status = read_builtin(name, &builtin, parameter, err);
  if (!status)
    status =
        tell_building(name, builtin->build_part(scene, parameter, part), err);
  return status || !part->n_faces ? status : hsr_scene_finish(scene, err);
}

/* Views for a part, as the whole scene gets them if it has too few. */
static enum hsr_status add_views(struct hsr_scene *scene,
                                 const struct hsr_scene_part *part,
                                 struct hsr_error *err) {
  const struct hsr_scene_extent *extent = &part->extent;
  if (scene->n_views >= part->least_views)
    return HSR_OK;
  unsigned n = part->least_views - scene->n_views;
  enum hsr_status status =
      part->is_measured
          ? hsr_scene_add_orbit_around(scene, extent->centre, extent->radius, n)
          : hsr_scene_add_orbit(scene, n);
  return status ? hsr_fail_nomem(err) : HSR_OK;
}

/* Makes a whole scene, with its cameras, a part. */
static enum hsr_status cut_part(struct hsr_scene *scene,
                                struct hsr_scene_part *part,
                                struct hsr_error *err) {
  hsr_scene_enlarge(scene);
  enum hsr_status status = add_views(scene, part, err);
  return status ? status : hsr_scene_cut(scene, part, err);
}

/* All faces are seen from both sides, whatever the scene says of them. */
static void show_backs(struct hsr_scene *scene) {
  for (uint32_t o = 0; o < scene->n_objects; o++)
    scene->objects[o].one_sided = false;
}

/* With `part`, that part; NULL: the whole scene. */
static enum hsr_status open_scene(const char *name, struct hsr_import *import,
                                  struct hsr_scene_part *part,
                                  struct hsr_scene **scene,
                                  struct hsr_error *err) {
  if (import) {
    import->n_dropped = 0;
    *import->notes = '\0';
  }
  size_t n = hsr_name_before_cameras(name);
  char *plain = strndup(name, n);
  *scene = hsr_scene_new(name);
  enum hsr_status status = plain && *scene ? HSR_OK : hsr_fail_nomem(err);
  bool alone = !status && part && is_made_by_parts(plain) &&
               !hsr_cameras_need_scene(name + n);
  if (!status && import)
    (*scene)->threads = import->threads;
  if (!status)
    status = hsr_scene_expect(*scene, name + n, err);
  if (!status)
    status = alone ? make_part(*scene, plain, part, err)
                   : open_plain(*scene, plain, import, err);
  if (!status && import && import->two_sided)
    show_backs(*scene);
  if (!status)
    status = hsr_scene_aim(*scene, name + n, err);
  if (!status && part)
    status = alone ? add_views(*scene, part, err) : cut_part(*scene, part, err);
  else if (!status && !part)
    hsr_scene_enlarge(*scene);
  free(plain);
  if (status) {
    hsr_scene_delete(*scene);
    *scene = NULL;
  }
  return status;
}

enum hsr_status hsr_scene_open(const char *name, struct hsr_import *import,
                               struct hsr_scene **scene,
                               struct hsr_error *err) {
  return open_scene(name, import, NULL, scene, err);
}

enum hsr_status hsr_scene_open_part(const char *name, struct hsr_import *import,
                                    struct hsr_scene_part *part,
                                    struct hsr_scene **scene,
                                    struct hsr_error *err) {
  return open_scene(name, import, part, scene, err);
}
