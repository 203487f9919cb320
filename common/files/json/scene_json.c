/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scene files. docs/schemas/scene.schema.json says what they hold; beyond it:
 *
 * Numbers     are doubles, rounded to nearest, however they are written: 1, 1.0
 *             and 1e0 are the same, -0 has its sign, an integer above 2^53 is
 *             the double next to it. What overflows is refused.
 * Keys        unknown and repeated ones are refused.
 * Memory      the file's text, and the scene; jansson's tree is of one vertex,
 *             face, instance or view at a time (some 20 times its text). Files
 *             hold no counts to be believed. */
#include "common/files/json/scene_json_reader.h"
#include "common/files/json/scene_json_shared.h"
#include "common/scene/flat.h"
#include "common/scene/motion.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

static const long MOST_FRAME = 2147483647;

static const char *const scene_lists[] = {"objects", "instances", "views",
                                          NULL};
static const char *const object_lists[] = {"vertices", "faces", "face_colours",
                                           NULL};

const hsr_json_levels hsr_scene_levels[] = {scene_lists, object_lists, NULL};

/* ---- Values ---- */

static enum hsr_status take_colour(const struct hsr_json_node *at, void *to) {
  float *colour = to;
  double rgb[3];
  enum hsr_status status = hsr_json_numbers(at, 3, hsr_json_share, rgb);
  for (int k = 0; k < 3 && !status; k++)
    colour[k] = (float)rgb[k];
  return status;
}

/* Into a malloc'ed text, which it replaces. */
enum hsr_status hsr_scene_take_name(const struct hsr_json_node *at, void *to) {
  char **name = to;
  const char *text = "";
  enum hsr_status status = hsr_json_string(at, &text);
  char *copy = status ? NULL : strdup(text);
  if (status || !copy)
    return status ? status : hsr_json_nomem(at);
  free(*name);
  *name = copy;
  return HSR_OK;
}

/* A whole number below n, which counts things called `what`. */
enum hsr_status hsr_scene_read_index(const struct hsr_json_node *at,
                                     const char *what, uint32_t n,
                                     uint32_t *to) {
  double number = 0;
  enum hsr_status status = hsr_json_number(at, &number);
  if (status)
    return status;
  if (!(number >= 0 && number < n))
    return hsr_json_refuse(at, "%s %.15g of %u", what, number, n);
  *to = (uint32_t)number;
  if (*to != number)
    return hsr_json_refuse(at, "%s %.15g, which is no whole number", what,
                           number);
  return HSR_OK;
}

/* ---- Vertices and faces ---- */

static enum hsr_status take_vertex(const struct hsr_json_node *at, void *to) {
  double p[3];
  (void)to;
  enum hsr_status status = hsr_json_point(at, p);
  if (status)
    return status;
  status = hsr_object_vertex(latest(at), p[0], p[1], p[2], NULL);
  if (status == HSR_E_NOMEM)
    return hsr_json_nomem(at);
  return status ? hsr_json_refuse(at, "one more vertex than an object can hold")
                : HSR_OK;
}

static enum hsr_status take_vertices(const struct hsr_json_node *at, void *to) {
  return hsr_json_list(at, reader_of(at)->of_object[VERTICES],
                       hsr_scene_levels + OF_LEAF, NULL, take_vertex, to);
}

static enum hsr_status reserve_corners(struct reader *reader, size_t n) {
  if (n <= reader->cap_corners)
    return HSR_OK;
  if (n > SIZE_MAX / 2 / sizeof *reader->corners)
    return hsr_fail_nomem(reader->input.err);
  uint32_t *corners = realloc(reader->corners, 2 * n * sizeof *corners);
  if (!corners)
    return hsr_fail_nomem(reader->input.err);
  reader->corners = corners;
  reader->cap_corners = 2 * n;
  return HSR_OK;
}

static bool has_room(const struct hsr_object *object, size_t n) {
  return n <= UINT32_MAX - 2 - object->start[object->n_faces] &&
         object->n_faces < UINT32_MAX - 2;
}

/* Appends the face in reader->corners, or leaves it out. rgba: NULL, if it has
 * the object's colour and opacity. */
static enum hsr_status add_face(const struct hsr_json_node *at, size_t n,
                                const float *rgba) {
  struct reader *reader = reader_of(at);
  struct hsr_object *object = latest(at);
  bool strict = reader->import.strict, out_of_memory = false;
  if (!has_room(object, n))
    return hsr_json_refuse(at, "is one more face than an object can hold");
  if (!strict)
    n = hsr_ring_tidy(reader->corners, n);
  bool flat =
      !strict && hsr_ring_is_flat(object, reader->corners, n, &out_of_memory);
  enum hsr_status status =
      flat ? HSR_OK : hsr_object_face(object, reader->corners, n, rgba);
  if (!flat && !status && rgba)
    status = hsr_object_set_opacity(object, object->n_faces - 1, rgba[3]);
  if (out_of_memory || status == HSR_E_NOMEM)
    return hsr_json_nomem(at);
  reader->import.n_dropped += flat;
  if (!status)
    return HSR_OK;
  return hsr_json_refuse(at, n < 3 ? "has fewer than 3 vertices"
                                   : "has the same vertex twice");
}

/* The colour of a face: three numbers, or four, of which the last is its
 * opacity. */
static enum hsr_status take_face_colour(const struct hsr_json_node *at,
                                        float rgba[4]) {
  double v[4];
  enum hsr_status status = hsr_json_array(at, NULL);
  bool has_opacity = !status && json_array_size(at->value) == 4;
  if (!status)
    status = hsr_json_numbers(at, has_opacity ? 4 : 3, hsr_json_share, v);
  if (!has_opacity)
    v[3] = (double)latest(at)->opacity;
  for (int k = 0; k < 4 && !status; k++)
    rgba[k] = (float)v[k];
  return status;
}

/* The next element of "face_colours", if there are such. */
static enum hsr_status read_face_colour(const struct hsr_json_node *at,
                                        float rgba[4]) {
  struct reader *reader = reader_of(at);
  struct hsr_json_node list = hsr_json_member(at->up->up, "face_colours");
  struct hsr_json_node colour = {at->input, NULL, &list, NULL, at->index};
  enum hsr_status status =
      hsr_json_next_value(at->input, &reader->of_object[FACE_COLOURS],
                          hsr_scene_levels + OF_LEAF, NULL, &reader->colour);
  colour.value = reader->colour;
  return !status && colour.value ? take_face_colour(&colour, rgba) : status;
}

/* Its colour comes first, as hsr_object_face wants it. */
static enum hsr_status take_face(const struct hsr_json_node *at, void *to) {
  struct reader *reader = reader_of(at);
  float rgba[4];
  (void)to;
  enum hsr_status status = read_face_colour(at, rgba);
  if (!status)
    status = hsr_json_array(at, NULL);
  size_t n = json_array_size(at->value);
  if (!status)
    status = reserve_corners(reader, n);
  for (size_t i = 0; i < n && !status; i++) {
    struct hsr_json_node corner = hsr_json_element(at, i);
    status = hsr_scene_read_index(&corner, "vertex", latest(at)->n_vertices,
                                  &reader->corners[i]);
  }
  return status ? status : add_face(at, n, reader->colour ? rgba : NULL);
}

static enum hsr_status take_faces(const struct hsr_json_node *at, void *to) {
  struct reader *reader = reader_of(at);
  enum hsr_status status =
      hsr_json_list(at, reader->of_object[FACES], hsr_scene_levels + OF_LEAF,
                    NULL, take_face, to);
  json_decref(reader->colour);
  reader->colour = NULL;
  return status;
}

/* They are read along with the faces. */
static enum hsr_status take_face_colours(const struct hsr_json_node *at,
                                         void *to) {
  const struct hsr_json_part *list = reader_of(at)->of_object;
  enum hsr_status status = hsr_json_array(at, to);
  size_t n_faces = hsr_json_count(list[FACES]);
  size_t n_colours = hsr_json_count(list[FACE_COLOURS]);
  return status || n_faces == n_colours
             ? status
             : hsr_json_refuse(
                   at, "must have one colour for each of %zu faces, not %zu",
                   n_faces, n_colours);
}

/* ---- Objects ---- */

/* A name of one object becomes its own; several keep theirs. */
static enum hsr_status take_own_name(const struct hsr_json_node *at, void *to) {
  struct entry *entry = latest_entry(at);
  (void)to;
  enum hsr_status status = hsr_scene_take_name(at, &entry->name);
  return status || entry->n > 1 ? status
                                : hsr_scene_take_name(at, &latest(at)->name);
}

static enum hsr_status take_own_colour(const struct hsr_json_node *at,
                                       void *to) {
  float colour[3];
  (void)to;
  enum hsr_status status = take_colour(at, colour);
  for (uint32_t k = 0; k < latest_entry(at)->n && !status; k++)
    memcpy((latest(at) - k)->colour, colour, sizeof colour);
  return status;
}

/* It replaces what a mesh file says. */
static enum hsr_status take_opacity(const struct hsr_json_node *at, void *to) {
  double opacity = 1;
  (void)to;
  enum hsr_status status = hsr_json_share(at, &opacity);
  for (uint32_t k = 0; k < latest_entry(at)->n; k++) {
    struct hsr_object *object = latest(at) - k;
    object->opacity = (float)opacity;
    free(object->face_opacity);
    object->face_opacity = NULL;
  }
  return status;
}

static enum hsr_status take_one_sided(const struct hsr_json_node *at,
                                      void *to) {
  bool one_sided = false;
  (void)to;
  enum hsr_status status = hsr_json_bool(at, &one_sided);
  for (uint32_t k = 0; k < latest_entry(at)->n; k++)
    (latest(at) - k)->one_sided = one_sided;
  return status;
}

/* What moves is of triangles. */
static enum hsr_status take_moves(const struct hsr_json_node *at, void *to) {
  bool moves = false;
  (void)to;
  enum hsr_status status = hsr_json_bool(at, &moves);
  for (uint32_t k = 0; k < latest_entry(at)->n && !status; k++) {
    struct hsr_object *object = latest(at) - k;
    object->moves = moves;
    for (uint32_t f = 0; moves && f < object->n_faces; f++)
      if (object->start[f + 1] - object->start[f] != 3)
        return hsr_json_refuse(at, "face %u is not a triangle", f);
  }
  return status;
}

/* Begins an entry, and its object if it is of no file. */
static enum hsr_status begin_entry(const struct hsr_json_node *at,
                                   bool is_mesh) {
  struct reader *reader = reader_of(at);
  if (reader->n_entries == reader->cap_entries) {
    const size_t n = 2 * (size_t)reader->cap_entries + 1;
    struct entry *entry = realloc(reader->entry, n * sizeof *entry);
    if (!entry)
      return hsr_json_nomem(at);
    reader->entry = entry;
    reader->cap_entries = (uint32_t)n;
  }
  reader->entry[reader->n_entries++] =
      (struct entry){.first = reader->scene->n_objects, .n = !is_mesh};
  return is_mesh || hsr_scene_object(reader->scene, "") ? HSR_OK
                                                        : hsr_json_nomem(at);
}

static enum hsr_status take_object(const struct hsr_json_node *at, void *to) {
  struct reader *reader = to;
  bool is_mesh = json_object_get(at->value, "file");
  bool has_sides = json_object_get(at->value, "one_sided");
  const struct hsr_json_rule rules[] = {
      {"file", hsr_scene_take_mesh, NULL},
      {"name", take_own_name, NULL, .required = !is_mesh},
      {"colour", take_own_colour, NULL},
      {"opacity", take_opacity, NULL},
      {"vertices", take_vertices, NULL, .required = !is_mesh,
       .beside = {"file"}},
      {"face_colours", take_face_colours, NULL, .beside = {"file"}},
      {"faces", take_faces, NULL, .required = !is_mesh, .beside = {"file"}},
      {"moves", take_moves, NULL},
      {"one_sided", take_one_sided, NULL},
      {0}};
  enum hsr_status status = begin_entry(at, is_mesh);
  if (!status)
    status = hsr_json_object(at, rules);
  if (status || is_mesh || has_sides)
    return status;
  struct hsr_object *object = latest(at);
  return hsr_object_is_solid(object, reader->import.threads, &object->one_sided)
             ? hsr_json_nomem(at)
             : HSR_OK;
}

static enum hsr_status take_objects(const struct hsr_json_node *at, void *to) {
  struct reader *reader = to;
  return hsr_json_list(at, reader->lists[OBJECTS], hsr_scene_levels + OF_OBJECT,
                       reader->of_object, take_object, reader);
}

/* ---- Views ---- */

static enum hsr_status take_view(const struct hsr_json_node *at, void *to) {
  struct hsr_camera camera = {.up = {0, 1, 0}, .fov = 45};
  const struct hsr_json_rule rules[] = {
      {"eye", hsr_json_point, camera.eye, .required = true},
      {"at", hsr_json_point, camera.at, .required = true},
      {"up", hsr_json_point, camera.up},
      {"fov", hsr_json_number, &camera.fov},
      {"near", hsr_json_number, &camera.near},
      {"parallel", hsr_json_number, &camera.parallel},
      {"light", hsr_json_point, camera.light},
      {"sun", hsr_json_point, camera.light},
      {0}};
  (void)to;
  enum hsr_status status = hsr_json_object(at, rules);
  if (status)
    return status;
  bool is_point = json_object_get(at->value, "light");
  if (is_point && json_object_get(at->value, "sun"))
    return hsr_json_refuse(at, "has a light and a sun; there is one light");
  camera.light[3] = is_point ? 1 : 0;
  struct hsr_error why;
  if (hsr_camera_check(&camera, &why))
    return hsr_json_refuse(at, "%s", why.text);
  return hsr_scene_view(reader_of(at)->scene, &camera) ? hsr_json_nomem(at)
                                                       : HSR_OK;
}

static enum hsr_status take_views(const struct hsr_json_node *at, void *to) {
  struct reader *reader = to;
  return hsr_json_list(at, reader->lists[VIEWS], hsr_scene_levels + OF_LEAF,
                       NULL, take_view, NULL);
}

/* ---- The whole file ---- */

/* A file without it is frame 0. Who reads it may ask for another. */
static enum hsr_status take_frame(const struct hsr_json_node *at, void *to) {
  struct reader *reader = to;
  double number = 0;
  enum hsr_status status = hsr_json_number(at, &number);
  if (!status && !(fabs(number) <= MOST_FRAME && number == rint(number)))
    return hsr_json_refuse(at, "%.15g is no whole number up to %ld", number,
                           MOST_FRAME);
  if (!status && !reader->frame_given)
    reader->frame = (long)number;
  return status;
}

/* What is known of the motion holds in this frame. */
static enum hsr_status check_motion(const struct hsr_json_node *root) {
  const struct reader *reader = reader_of(root);
  struct hsr_error why;
  if (reader->frame && hsr_scene_set_frame(reader->scene, reader->frame))
    return hsr_json_nomem(root);
  return hsr_scene_check_motion(reader->scene, &why)
             ? hsr_json_refuse(root, "%s", why.text)
             : HSR_OK;
}

/* Whether there is more than faces without area. */
static enum hsr_status check_faces(const struct hsr_json_node *root) {
  const struct reader *reader = reader_of(root);
  uint64_t left_out = reader->import.n_dropped;
  for (uint32_t k = 0; left_out && k < reader->scene->n_objects; k++)
    if (reader->scene->objects[k].n_faces)
      left_out = 0;
  return left_out ? hsr_json_refuse(root, "none of its %llu faces has an area",
                                    (unsigned long long)left_out)
                  : HSR_OK;
}

static enum hsr_status read_scene(const struct hsr_json_node *root) {
  struct reader *reader = reader_of(root);
  const struct hsr_json_rule rules[] = {
      {"schema"},
      {"name", hsr_scene_take_name, &reader->scene->name},
      {"frame", take_frame, reader},
      {"objects", take_objects, reader, .required = true},
      {"instances", hsr_scene_take_instances, reader},
      {"views", take_views, reader},
      {0}};
  enum hsr_status status = hsr_json_check_schema(root, HSR_SCENE_SCHEMA);
  if (!status)
    status = hsr_json_object(root, rules);
  if (!status)
    status = check_faces(root);
  if (!status)
    status = hsr_scene_append_instances(root);
  return status ? status : check_motion(root);
}

static enum hsr_status read_cameras(const struct hsr_json_node *root) {
  struct reader *reader = reader_of(root);
  const struct hsr_json_rule rules[] = {
      {"schema"}, {"views", take_views, reader, .required = true}, {0}};
  uint32_t before = reader->scene->n_views;
  enum hsr_status status = hsr_json_check_schema(root, HSR_CAMERA_SCHEMA);
  if (!status)
    status = hsr_json_object(root, rules);
  const struct hsr_json_node views = hsr_json_member(root, "views");
  return !status && reader->scene->n_views == before
             ? hsr_json_refuse(&views, "is empty")
             : status;
}

/* Parses the file and has it read. */
static enum hsr_status
read_file(struct reader *reader,
          enum hsr_status (*read)(const struct hsr_json_node *root)) {
  char *text = NULL;
  struct hsr_json_node root = {.input = &reader->input};
  reader->input.reader = reader;
  enum hsr_status status = hsr_json_open(root.input, hsr_scene_levels + OF_FILE,
                                         reader->lists, &text, &root.value);
  if (!status)
    status = read(&root);
  json_decref(root.value);
  free(text);
  return status;
}

static void forget(struct reader *reader) {
  hsr_scene_forget_meshes(reader);
  hsr_scene_forget_instances(reader);
  for (uint32_t e = 0; e < reader->n_entries; e++)
    free(reader->entry[e].name);
  free(reader->entry);
}

/* Reads a scene; `reader` says how, and has nothing of it yet. */
static enum hsr_status read_with(struct reader *reader,
                                 struct hsr_import *import) {
  if (import)
    reader->import = (struct hsr_import){.strict = import->strict,
                                         .two_sided = import->two_sided,
                                         .threads = import->threads};
  enum hsr_status status = read_file(reader, read_scene);
  free(reader->corners);
  forget(reader);
  if (import)
    *import = reader->import;
  return status;
}

enum hsr_status hsr_scene_json_read(struct hsr_scene *scene, const char *path,
                                    struct hsr_import *import,
                                    struct hsr_error *err) {
  struct reader reader = {.scene = scene, .input = {path, NULL, err}};
  return read_with(&reader, import);
}

enum hsr_status hsr_scene_json_read_frame(struct hsr_scene *scene,
                                          const char *path, long frame,
                                          struct hsr_import *import,
                                          struct hsr_error *err) {
  struct reader reader = {.scene = scene,
                          .input = {path, NULL, err},
                          .frame = frame,
                          .frame_given = true};
  return read_with(&reader, import);
}

enum hsr_status hsr_cameras_json_read(struct hsr_scene *scene, const char *path,
                                      struct hsr_error *err) {
  struct reader reader = {.scene = scene, .input = {path, NULL, err}};
  return read_file(&reader, read_cameras);
}
