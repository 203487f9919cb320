/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scene files. docs/scene.schema.json says what they hold; beyond it:
 *
 * Numbers     are doubles, rounded to nearest, however they are written: 1, 1.0
 *             and 1e0 are the same, -0 has its sign, an integer above 2^53 is
 *             the double next to it. What overflows is refused.
 * Keys        unknown and repeated ones are refused.
 * Memory      the file's text, and the scene; jansson's tree is of one vertex,
 *             face, instance or view at a time (some 20 times its text). Files
 *             hold no counts to be believed. */
#include "common/files/scene_json.h"
#include "common/files/json_file.h"
#include "common/files/json_read.h"
#include "common/files/whole_file.h"
#include "common/polygon/polygon.h"
#include "common/scene/motion.h"

#include <jansson.h>

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char SCHEMA[] = "hsr-scene/1", CAMERA_SCHEMA[] = "hsr-camera/1";
static const long MOST_FRAME = 2147483647;

/* ---- Messages ---- */

/* A place in the file: a member, or an element, of the one above it. The
 * outermost value has no place, NULL. */
struct place {
  const struct place *up;
  const char *key; /* NULL: element `index` */
  size_t index;
};

/* Appends to a text in a buffer of `size` bytes what of a key has room, as a
 * JSON pointer (RFC 6901) has it. */
static void append_key(char *text, size_t size, const char *key) {
  size_t n = strlen(text);
  for (; *key && n + 3 < size; key++) {
    if (*key == '~' || *key == '/')
      text[n++] = '~';
    text[n++] = (char)(*key == '~' ? '0' : *key == '/' ? '1' : *key);
  }
  text[n] = '\0';
}

static void append_pointer(char *text, size_t size, const struct place *place) {
  if (!place)
    return;
  append_pointer(text, size, place->up);
  size_t n = strlen(text);
  if (place->key) {
    snprintf(text + n, size - n, "/");
    append_key(text, size, place->key);
  } else {
    snprintf(text + n, size - n, "/%zu", place->index);
  }
}

struct reader {
  struct hsr_scene *scene;
  const char *path;
  struct hsr_import import; /* n_dropped: so far */
  struct hsr_error *err;
  uint32_t *corners; /* of the face at hand */
  size_t cap_corners;
  struct mesh *mesh; /* the latest that was read */
  long frame;        /* the scene is this frame of the file */
  bool frame_given;  /* by who reads it; else the file says it, or it is 0 */
};

/* A mesh file that has been read, so that it is read once however many objects
 * are made of it. Kept are what a scene file may change in the object. */
struct mesh {
  struct mesh *before;
  char *path, *name;
  uint32_t object; /* of the scene */
  uint64_t n_dropped;
  float colour[3];
  bool one_sided;
};

/* HSR_E_INPUT: "FILE: POINTER: text". */
static enum hsr_status refuse(const struct reader *reader,
                              const struct place *place, const char *format,
                              ...) __attribute__((format(printf, 3, 4)));

static enum hsr_status refuse(const struct reader *reader,
                              const struct place *place, const char *format,
                              ...) {
  char pointer[128] = "", text[160];
  append_pointer(pointer, sizeof pointer, place);
  va_list args;
  va_start(args, format);
  vsnprintf(text, sizeof text, format, args);
  va_end(args);
  return hsr_fail(reader->err, HSR_E_INPUT, "%s: %s%s%s",
                  hsr_json_shown(reader->path), pointer, place ? ": " : "",
                  text);
}

/* ---- Values of one type ---- */

static enum hsr_status wrong_kind(const struct reader *reader,
                                  const struct place *place,
                                  const char *expected, const json_t *value) {
  return refuse(reader, place, "must be %s, not %s", expected,
                hsr_json_kind(value));
}

static enum hsr_status read_bool(const struct reader *reader,
                                 const struct place *place, const json_t *value,
                                 bool *to) {
  if (!json_is_boolean(value))
    return wrong_kind(reader, place, "true or false", value);
  *to = json_is_true(value);
  return HSR_OK;
}

/* *to lives as long as the value. */
static enum hsr_status read_string(const struct reader *reader,
                                   const struct place *place,
                                   const json_t *value, const char **to) {
  if (!json_is_string(value))
    return wrong_kind(reader, place, "a string", value);
  *to = json_string_value(value);
  return HSR_OK;
}

static enum hsr_status read_number(const struct reader *reader,
                                   const struct place *place,
                                   const json_t *value, double *to) {
  if (!json_is_number(value))
    return wrong_kind(reader, place, "a number", value);
  *to = json_number_value(value);
  return HSR_OK;
}

static enum hsr_status read_array(const struct reader *reader,
                                  const struct place *place,
                                  const json_t *value) {
  if (!json_is_array(value))
    return wrong_kind(reader, place, "an array", value);
  return HSR_OK;
}

/* An array of n numbers. */
static enum hsr_status read_numbers(const struct reader *reader,
                                    const struct place *place,
                                    const json_t *value, size_t n, double *to) {
  enum hsr_status status = read_array(reader, place, value);
  if (status)
    return status;
  if (json_array_size(value) != n)
    return refuse(reader, place, "must have %zu numbers, not %zu", n,
                  json_array_size(value));
  for (size_t i = 0; i < n && !status; i++)
    status = read_number(reader, &(struct place){place, NULL, i},
                         json_array_get(value, i), &to[i]);
  return status;
}

static enum hsr_status read_colour(const struct reader *reader,
                                   const struct place *place,
                                   const json_t *value, float to[3]) {
  double rgb[3];
  enum hsr_status status = read_numbers(reader, place, value, 3, rgb);
  for (size_t k = 0; k < 3 && !status; k++) {
    if (!(rgb[k] >= 0 && rgb[k] <= 1))
      return refuse(reader, &(struct place){place, NULL, k},
                    "%.9g is not between 0 and 1", rgb[k]);
    to[k] = (float)rgb[k];
  }
  return status;
}

/* A whole number below n, which counts things called `what`. */
static enum hsr_status read_index(const struct reader *reader,
                                  const struct place *place,
                                  const json_t *value, const char *what,
                                  uint32_t n, uint32_t *to) {
  double number = 0;
  enum hsr_status status = read_number(reader, place, value, &number);
  if (status)
    return status;
  if (!(number >= 0 && number < n))
    return refuse(reader, place, "%s %.15g of %u", what, number, n);
  *to = (uint32_t)number;
  if (*to != number)
    return refuse(reader, place, "%s %.15g, which is no whole number", what,
                  number);
  return HSR_OK;
}

/* ---- Members ---- */

/* Refuses what is no object, or has a key that is not among `known`, which
 * NULL ends. */
static enum hsr_status check_keys(const struct reader *reader,
                                  const struct place *place, json_t *value,
                                  const char *const *known) {
  if (!json_is_object(value))
    return wrong_kind(reader, place, "an object", value);
  for (void *i = json_object_iter(value); i;
       i = json_object_iter_next(value, i)) {
    const char *key = json_object_iter_key(i);
    const char *const *k = known;
    while (*k && strcmp(*k, key))
      k++;
    if (!*k)
      return refuse(reader, &(struct place){place, key, 0}, "unknown key");
  }
  return HSR_OK;
}

static enum hsr_status require(const struct reader *reader,
                               const struct place *place, const json_t *value,
                               const char *key, json_t **member) {
  *member = json_object_get(value, key);
  return *member ? HSR_OK : refuse(reader, place, "'%s' is missing", key);
}

/* Refuses members that mean nothing where there is one called `key`. */
static enum hsr_status exclude(const struct reader *reader,
                               const struct place *place, const json_t *value,
                               const char *key, const char *const *excluded) {
  for (; *excluded; excluded++)
    if (json_object_get(value, *excluded))
      return refuse(reader, &(struct place){place, *excluded, 0},
                    "cannot stand beside '%s'", key);
  return HSR_OK;
}

/* ---- The text, and jansson's parser ---- */

/* What is read an element at a time: of the file, and of an object. */
enum { OBJECTS, INSTANCES, VIEWS, SCENE_LISTS };
static const char *const scene_lists[] = {"objects", "instances", "views",
                                          NULL};
enum { VERTICES, FACES, FACE_COLOURS, OBJECT_LISTS };
static const char *const object_lists[] = {"vertices", "faces", "face_colours",
                                           NULL};

enum { OF_FILE, OF_OBJECT, OF_LEAF };
static const hsr_json_levels levels[] = {scene_lists, object_lists, NULL};

/* A value of some level, whose lists are in list[]: see hsr_json_read_part. */
static enum hsr_status parse(const struct reader *reader,
                             struct hsr_json_part part, int level,
                             struct hsr_json_part *list, json_t **value) {
  size_t flags = JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL;
  bool out_of_memory;
  json_error_t error;
  *value =
      hsr_json_read_part(part, flags | (level == OF_FILE ? 0 : JSON_DECODE_ANY),
                         levels + level, list, &out_of_memory, &error);
  if (out_of_memory)
    return hsr_fail_nomem(reader->err);
  return *value
             ? HSR_OK
             : hsr_fail(reader->err, HSR_E_INPUT, "%s:%d: %s",
                        hsr_json_shown(reader->path), error.line, error.text);
}

/* The next element of a list, which is released here: NULL after the last. */
static enum hsr_status next(const struct reader *reader,
                            struct hsr_json_part *list, json_t **value) {
  struct hsr_json_part element;
  json_decref(*value);
  *value = NULL;
  return hsr_json_next(list, &element)
             ? parse(reader, element, OF_LEAF, NULL, value)
             : HSR_OK;
}

/* ---- Objects ---- */

static enum hsr_status rename_to(const struct reader *reader, char **name,
                                 const char *text) {
  char *copy = strdup(text);
  if (!copy)
    return hsr_fail_nomem(reader->err);
  free(*name);
  *name = copy;
  return HSR_OK;
}

static enum hsr_status read_vertex(const struct reader *reader,
                                   const struct place *place,
                                   const json_t *vertex,
                                   struct hsr_object *object) {
  double p[3];
  enum hsr_status status = read_numbers(reader, place, vertex, 3, p);
  if (status)
    return status;
  status = hsr_object_vertex(object, p[0], p[1], p[2], NULL);
  if (status == HSR_E_NOMEM)
    return hsr_fail_nomem(reader->err);
  return status
             ? refuse(reader, place, "one more vertex than an object can hold")
             : HSR_OK;
}

static enum hsr_status read_vertices(const struct reader *reader,
                                     const struct place *place,
                                     struct hsr_json_part vertices,
                                     struct hsr_object *object) {
  json_t *vertex = NULL;
  enum hsr_status status = next(reader, &vertices, &vertex);
  for (size_t v = 0; vertex && !status; v++) {
    status =
        read_vertex(reader, &(struct place){place, NULL, v}, vertex, object);
    if (!status)
      status = next(reader, &vertices, &vertex);
  }
  json_decref(vertex);
  return status;
}

static enum hsr_status reserve_corners(struct reader *reader, size_t n) {
  if (n <= reader->cap_corners)
    return HSR_OK;
  if (n > SIZE_MAX / 2 / sizeof *reader->corners)
    return hsr_fail_nomem(reader->err);
  uint32_t *corners = realloc(reader->corners, 2 * n * sizeof *corners);
  if (!corners)
    return hsr_fail_nomem(reader->err);
  reader->corners = corners;
  reader->cap_corners = 2 * n;
  return HSR_OK;
}

static bool has_room(const struct hsr_object *object, size_t n) {
  return n <= UINT32_MAX - 2 - object->start[object->n_faces] &&
         object->n_faces < UINT32_MAX - 2;
}

static bool has_area(const struct hsr_object *object, const uint32_t *corners,
                     size_t n, bool *out_of_memory) {
  const double *xyz = object->xyz;
  struct hsr_loop loop = {xyz, xyz + 1, xyz + 2, 3, corners, (uint32_t)n};
  return n >= 3 && hsr_exact_has_normal(loop, out_of_memory);
}

/* Appends the face in reader->corners, or drops it. */
static enum hsr_status add_face(struct reader *reader,
                                const struct place *place,
                                struct hsr_object *object, size_t n,
                                const float *rgb) {
  bool drop = reader->import.drop_degenerate, out_of_memory = false;
  if (!has_room(object, n))
    return refuse(reader, place, "is one more face than an object can hold");
  bool wanted = !drop || has_area(object, reader->corners, n, &out_of_memory);
  enum hsr_status status =
      wanted ? hsr_object_face(object, reader->corners, n, rgb) : HSR_E_INPUT;
  if (out_of_memory || status == HSR_E_NOMEM)
    return hsr_fail_nomem(reader->err);
  if (status && !drop)
    return refuse(reader, place,
                  n < 3 ? "has fewer than 3 vertices"
                        : "has the same vertex twice; --drop-degenerate "
                          "leaves such faces out");
  reader->import.n_dropped += status != HSR_OK;
  return HSR_OK;
}

static enum hsr_status read_face(struct reader *reader,
                                 const struct place *place, const json_t *face,
                                 struct hsr_object *object, const float *rgb) {
  enum hsr_status status = read_array(reader, place, face);
  size_t n = json_array_size(face);
  if (!status)
    status = reserve_corners(reader, n);
  for (size_t i = 0; i < n && !status; i++)
    status = read_index(reader, &(struct place){place, NULL, i},
                        json_array_get(face, i), "vertex", object->n_vertices,
                        &reader->corners[i]);
  return status ? status : add_face(reader, place, object, n, rgb);
}

/* `colours` are none, or as many as the faces. */
static enum hsr_status read_faces(struct reader *reader,
                                  const struct place *place,
                                  struct hsr_json_part faces,
                                  struct hsr_json_part colours,
                                  struct hsr_object *object) {
  struct place at_faces = {place, "faces", 0};
  struct place at_colours = {place, "face_colours", 0};
  json_t *face = NULL, *colour = NULL;
  float rgb[3];
  enum hsr_status status = next(reader, &faces, &face);
  for (size_t f = 0; face && !status; f++) {
    status = next(reader, &colours, &colour);
    if (!status && colour)
      status = read_colour(reader, &(struct place){&at_colours, NULL, f},
                           colour, rgb);
    if (!status)
      status = read_face(reader, &(struct place){&at_faces, NULL, f}, face,
                         object, colour ? rgb : NULL);
    if (!status)
      status = next(reader, &faces, &face);
  }
  json_decref(face);
  json_decref(colour);
  return status;
}

static enum hsr_status check_colours(const struct reader *reader,
                                     const struct place *place,
                                     const json_t *colours,
                                     struct hsr_json_part faces,
                                     struct hsr_json_part list) {
  struct place here = {place, "face_colours", 0};
  enum hsr_status status = read_array(reader, &here, colours);
  size_t n_faces = hsr_json_count(faces), n_colours = hsr_json_count(list);
  return status || n_faces == n_colours
             ? status
             : refuse(reader, &here,
                      "must have one colour for each of %zu faces, not %zu",
                      n_faces, n_colours);
}

/* The colour comes before the faces, as hsr_object_face wants it. */
static enum hsr_status read_geometry(
    struct reader *reader, const struct place *place, const json_t *value,
    const struct hsr_json_part list[OBJECT_LISTS], struct hsr_object **object) {
  json_t *vertices, *faces, *colour = json_object_get(value, "colour");
  json_t *colours = json_object_get(value, "face_colours");
  enum hsr_status status = require(reader, place, value, "vertices", &vertices);
  if (!status)
    status = require(reader, place, value, "faces", &faces);
  if (status)
    return status;
  *object = hsr_scene_object(reader->scene, "");
  if (!*object)
    return hsr_fail_nomem(reader->err);
  if (colour)
    status = read_colour(reader, &(struct place){place, "colour", 0}, colour,
                         (*object)->colour);
  if (!status)
    status =
        read_array(reader, &(struct place){place, "vertices", 0}, vertices);
  if (!status)
    status = read_vertices(reader, &(struct place){place, "vertices", 0},
                           list[VERTICES], *object);
  if (!status)
    status = read_array(reader, &(struct place){place, "faces", 0}, faces);
  if (!status && colours)
    status =
        check_colours(reader, place, colours, list[FACES], list[FACE_COLOURS]);
  return status ? status
                : read_faces(reader, place, list[FACES], list[FACE_COLOURS],
                             *object);
}

/* The path of a file that the scene file names. NULL: out of memory. */
static char *resolve(const char *path, const char *file) {
  const char *slash = strrchr(path, '/');
  size_t n = slash && *file != '/' ? (size_t)(slash + 1 - path) : 0;
  char *resolved = malloc(n + strlen(file) + 1);
  if (!resolved)
    return NULL;
  memcpy(resolved, path, n);
  memcpy(resolved + n, file, strlen(file) + 1);
  return resolved;
}

static void forget_meshes(struct reader *reader) {
  while (reader->mesh) {
    struct mesh *mesh = reader->mesh;
    reader->mesh = mesh->before;
    free(mesh->path);
    free(mesh->name);
    free(mesh);
  }
}

/* Reads a mesh file, and keeps note of it. Takes `path`. */
static enum hsr_status read_new_mesh(struct reader *reader, char *path) {
  struct mesh *mesh = calloc(1, sizeof *mesh);
  if (!mesh) {
    free(path);
    return hsr_fail_nomem(reader->err);
  }
  *mesh = (struct mesh){.before = reader->mesh, .path = path};
  reader->mesh = mesh;
  struct hsr_import import = reader->import;
  enum hsr_status status =
      hsr_mesh_read(reader->scene, path, &import, reader->err);
  if (status)
    return status;
  mesh->object = reader->scene->n_objects - 1;
  mesh->n_dropped = import.n_dropped;
  memcpy(reader->import.notes, import.notes, sizeof import.notes);
  const struct hsr_object *object = &reader->scene->objects[mesh->object];
  mesh->name = strdup(object->name);
  mesh->one_sided = object->one_sided;
  memcpy(mesh->colour, object->colour, sizeof mesh->colour);
  return mesh->name ? HSR_OK : hsr_fail_nomem(reader->err);
}

/* Appends another object that is as the mesh was when it was read. */
static enum hsr_status copy_mesh(struct reader *reader,
                                 const struct mesh *mesh) {
  struct hsr_object *to = hsr_scene_object(reader->scene, mesh->name);
  if (!to)
    return hsr_fail_nomem(reader->err);
  const struct hsr_object *from = &reader->scene->objects[mesh->object];
  enum hsr_status status = HSR_OK;
  to->one_sided = mesh->one_sided;
  memcpy(to->colour, mesh->colour, sizeof to->colour);
  for (uint32_t v = 0; v < from->n_vertices && !status; v++) {
    const double *p = from->xyz + 3 * (size_t)v;
    status = hsr_object_vertex(to, p[0], p[1], p[2], NULL);
  }
  for (uint32_t f = 0; f < from->n_faces && !status; f++)
    status = hsr_object_face(to, from->vertex + from->start[f],
                             from->start[f + 1] - from->start[f],
                             from->rgb ? from->rgb + 3 * (size_t)f : NULL);
  return status ? hsr_fail_nomem(reader->err) : HSR_OK;
}

static enum hsr_status read_mesh(struct reader *reader,
                                 const struct place *place, const json_t *value,
                                 struct hsr_object **object) {
  static const char *const excluded[] = {"vertices", "faces", "face_colours",
                                         NULL};
  const char *file = "";
  enum hsr_status status = exclude(reader, place, value, "file", excluded);
  if (!status)
    status = read_string(reader, &(struct place){place, "file", 0},
                         json_object_get(value, "file"), &file);
  if (status)
    return status;
  char *path = resolve(reader->path, file);
  if (!path)
    return hsr_fail_nomem(reader->err);
  const struct mesh *mesh = reader->mesh;
  while (mesh && strcmp(mesh->path, path))
    mesh = mesh->before;
  if (mesh) {
    free(path);
    status = copy_mesh(reader, mesh);
  } else {
    status = read_new_mesh(reader, path);
    mesh = reader->mesh;
  }
  if (status)
    return status;
  reader->import.n_dropped += mesh->n_dropped;
  *object = &reader->scene->objects[reader->scene->n_objects - 1];
  json_t *colour = json_object_get(value, "colour");
  return colour ? read_colour(reader, &(struct place){place, "colour", 0},
                              colour, (*object)->colour)
                : HSR_OK;
}

static enum hsr_status read_opacity(const struct reader *reader,
                                    const struct place *place,
                                    const json_t *value, float *to) {
  double opacity = 1;
  enum hsr_status status = read_number(reader, place, value, &opacity);
  if (!status && !(opacity >= 0 && opacity <= 1))
    return refuse(reader, place, "%.9g is not between 0 and 1", opacity);
  *to = (float)opacity;
  return status;
}

/* What moves is of triangles. */
static enum hsr_status read_moves(struct reader *reader,
                                  const struct place *place,
                                  const json_t *value,
                                  struct hsr_object *object) {
  enum hsr_status status = read_bool(reader, place, value, &object->moves);
  for (uint32_t f = 0; !status && object->moves && f < object->n_faces; f++)
    if (object->start[f + 1] - object->start[f] != 3)
      return refuse(reader, place, "face %u is not a triangle", f);
  return status;
}

static enum hsr_status
read_object(struct reader *reader, const struct place *place, json_t *value,
            const struct hsr_json_part list[OBJECT_LISTS]) {
  static const char *const keys[] = {
      "name",  "file",         "one_sided", "colour", "vertices",
      "faces", "face_colours", "opacity",   "moves",  NULL};
  enum hsr_status status = check_keys(reader, place, value, keys);
  if (status)
    return status;
  bool is_mesh = json_object_get(value, "file");
  json_t *name = json_object_get(value, "name");
  json_t *one_sided = json_object_get(value, "one_sided");
  json_t *opacity = json_object_get(value, "opacity");
  json_t *moves = json_object_get(value, "moves");
  const char *text = NULL;
  if (!is_mesh)
    status = require(reader, place, value, "name", &name);
  if (!status && name)
    status =
        read_string(reader, &(struct place){place, "name", 0}, name, &text);
  struct hsr_object *object = NULL;
  if (!status)
    status = is_mesh ? read_mesh(reader, place, value, &object)
                     : read_geometry(reader, place, value, list, &object);
  if (!status && opacity)
    status = read_opacity(reader, &(struct place){place, "opacity", 0}, opacity,
                          &object->opacity);
  if (!status && moves)
    status =
        read_moves(reader, &(struct place){place, "moves", 0}, moves, object);
  if (!status && text)
    status = rename_to(reader, &object->name, text);
  if (!status && one_sided)
    return read_bool(reader, &(struct place){place, "one_sided", 0}, one_sided,
                     &object->one_sided);
  if (!status && !is_mesh &&
      hsr_object_is_solid(object, reader->import.threads, &object->one_sided))
    return hsr_fail_nomem(reader->err);
  return status;
}

/* ---- Instances ---- */

/* The objects' numbers by name, AMBIGUOUS where several share one. NULL: out
 * of memory. */
static const json_int_t AMBIGUOUS = -1;

static json_t *number_by_name(const struct hsr_scene *scene) {
  json_t *numbers = json_object();
  for (uint32_t o = 0; numbers && o < scene->n_objects; o++) {
    const char *name = scene->objects[o].name;
    json_int_t number = json_object_get(numbers, name) ? AMBIGUOUS : o;
    if (json_object_set_new_nocheck(numbers, name, json_integer(number))) {
      json_decref(numbers);
      return NULL;
    }
  }
  return numbers;
}

/* An object by its name or by its number. */
static enum hsr_status read_reference(const struct reader *reader,
                                      const struct place *place,
                                      const json_t *value,
                                      const json_t *numbers, uint32_t *object) {
  if (json_is_number(value))
    return read_index(reader, place, value, "object", reader->scene->n_objects,
                      object);
  if (!json_is_string(value))
    return wrong_kind(reader, place, "a name or a number", value);
  const char *name = json_string_value(value);
  const json_t *number = json_object_get(numbers, name);
  if (!number)
    return refuse(reader, place, "there is no object '%.60s'", name);
  if (json_integer_value(number) == AMBIGUOUS)
    return refuse(reader, place,
                  "several objects are called '%.60s'; give its number", name);
  *object = (uint32_t)json_integer_value(number);
  return HSR_OK;
}

/* One number for all axes, or one for each. */
static enum hsr_status read_scale(const struct reader *reader,
                                  const struct place *place,
                                  const json_t *value, double scale[3]) {
  if (json_is_array(value))
    return read_numbers(reader, place, value, 3, scale);
  if (!json_is_number(value))
    return wrong_kind(reader, place, "a number or three", value);
  scale[0] = scale[1] = scale[2] = json_number_value(value);
  return HSR_OK;
}

static enum hsr_status read_matrix(const struct reader *reader,
                                   const struct place *place,
                                   const json_t *value, double m[12]) {
  static const char *const excluded[] = {"translate", "scale", NULL};
  json_t *matrix = json_object_get(value, "matrix");
  json_t *translate = json_object_get(value, "translate");
  json_t *scale = json_object_get(value, "scale");
  enum hsr_status status = HSR_OK;
  if (matrix) {
    status = exclude(reader, place, value, "matrix", excluded);
    return status ? status
                  : read_numbers(reader, &(struct place){place, "matrix", 0},
                                 matrix, 12, m);
  }
  double t[3] = {0, 0, 0}, s[3] = {1, 1, 1};
  if (translate)
    status = read_numbers(reader, &(struct place){place, "translate", 0},
                          translate, 3, t);
  if (!status && scale)
    status = read_scale(reader, &(struct place){place, "scale", 0}, scale, s);
  memset(m, 0, 12 * sizeof *m);
  for (int k = 0; k < 3; k++) {
    m[5 * k] = s[k];
    m[4 * k + 3] = t[k];
  }
  return status;
}

/* ---- Motion ---- */

/* An instance, its place in the file, so that sorting is stable, and what is
 * known of its motion. */
struct placed {
  struct hsr_instance instance;
  size_t order;
  bool has_motion;
  struct hsr_motion motion;
  struct hsr_key *key; /* malloc'ed; NULL: none */
  size_t n_keys;
};

/* Refuses what is said of the motion of an instance that does not move. */
static enum hsr_status check_moves(const struct reader *reader,
                                   const struct place *place, uint32_t o) {
  const struct hsr_object *object = &reader->scene->objects[o];
  return object->moves ? HSR_OK
                       : refuse(reader, place, "object '%.60s' does not move",
                                object->name);
}

/* The time of an element of a list, which is after the one before it. */
static enum hsr_status read_time(const struct reader *reader,
                                 const struct place *place, json_t *value,
                                 double before, double *time) {
  json_t *frame;
  struct place here = {place, "frame", 0};
  enum hsr_status status = require(reader, place, value, "frame", &frame);
  if (!status)
    status = read_number(reader, &here, frame, time);
  if (!status && !(*time > before))
    return refuse(reader, &here, "%.15g is not after %.15g", *time, before);
  return status;
}

/* "lo" and "hi" of a value. */
static enum hsr_status read_box(const struct reader *reader,
                                const struct place *place, const json_t *value,
                                double lo[3], double hi[3]) {
  json_t *least, *most;
  enum hsr_status status = require(reader, place, value, "lo", &least);
  if (!status)
    status = require(reader, place, value, "hi", &most);
  if (!status)
    status =
        read_numbers(reader, &(struct place){place, "lo", 0}, least, 3, lo);
  if (!status)
    status = read_numbers(reader, &(struct place){place, "hi", 0}, most, 3, hi);
  for (size_t a = 0; a < 3 && !status; a++)
    if (lo[a] > hi[a]) {
      struct place list = {place, "hi", 0};
      return refuse(reader, &(struct place){&list, NULL, a},
                    "%.15g is below 'lo', %.15g", hi[a], lo[a]);
    }
  return status;
}

static enum hsr_status read_way(const struct reader *reader,
                                const struct place *place, const json_t *value,
                                struct placed *to) {
  static const char *const keys[] = {"frame", "lo", "hi", NULL};
  enum hsr_status status = read_array(reader, place, value);
  size_t n = status ? 0 : json_array_size(value);
  if (!status && !n)
    return refuse(reader, place, "is empty");
  to->key = status ? NULL : calloc(n, sizeof *to->key);
  if (!status && !to->key)
    return hsr_fail_nomem(reader->err);
  for (size_t k = 0; k < n && !status; k++) {
    struct place here = {place, NULL, k};
    json_t *element = json_array_get(value, k);
    struct hsr_key *key = &to->key[k];
    status = check_keys(reader, &here, element, keys);
    if (!status)
      status = read_time(reader, &here, element,
                         k ? to->key[k - 1].frame : -INFINITY, &key->frame);
    if (!status)
      status = read_box(reader, &here, element, key->lo, key->hi);
  }
  to->n_keys = n;
  return status;
}

static enum hsr_status read_speed(const struct reader *reader,
                                  const struct place *place,
                                  const json_t *value, double *to) {
  enum hsr_status status = read_number(reader, place, value, to);
  return !status && *to < 0 ? refuse(reader, place, "%.15g is negative", *to)
                            : status;
}

/* What is promised of an instance. */
static enum hsr_status read_motion(const struct reader *reader,
                                   const struct place *place, json_t *value,
                                   struct placed *to) {
  static const char *const keys[] = {"speed", "within", "way", NULL};
  static const char *const box[] = {"lo", "hi", NULL};
  enum hsr_status status = check_keys(reader, place, value, keys);
  if (!status)
    status = check_moves(reader, place, to->instance.object);
  json_t *speed = json_object_get(value, "speed");
  json_t *within = json_object_get(value, "within");
  json_t *way = json_object_get(value, "way");
  to->has_motion = true;
  to->motion = hsr_motion_unknown();
  if (!status && speed)
    status = read_speed(reader, &(struct place){place, "speed", 0}, speed,
                        &to->motion.speed);
  if (!status && within) {
    struct place here = {place, "within", 0};
    status = check_keys(reader, &here, within, box);
    if (!status)
      status = read_box(reader, &here, within, to->motion.lo, to->motion.hi);
  }
  if (!status && way)
    status = read_way(reader, &(struct place){place, "way", 0}, way, to);
  return status;
}

/* Where an instance is, of which places are given: at the time of one, there;
 * between two, each number of the matrix changes steadily; before the first and
 * after the last, at that one. */
static enum hsr_status read_places(const struct reader *reader,
                                   const struct place *place,
                                   const json_t *value, double m[12]) {
  static const char *const keys[] = {"frame", "matrix", "translate", "scale",
                                     NULL};
  const double frame = (double)reader->frame;
  double before = -INFINITY, next[12];
  enum hsr_status status = read_array(reader, place, value);
  if (!status && !json_array_size(value))
    return refuse(reader, place, "is empty");
  for (size_t k = 0; !status && k < json_array_size(value); k++) {
    struct place here = {place, NULL, k};
    json_t *element = json_array_get(value, k);
    double time = 0;
    status = check_keys(reader, &here, element, keys);
    if (!status)
      status = read_time(reader, &here, element, before, &time);
    if (!status)
      status = read_matrix(reader, &here, element, next);
    if (status)
      return status;
    if (!k || time <= frame)
      memcpy(m, next, sizeof next);
    else if (before < frame)
      for (int i = 0; i < 12; i++)
        m[i] += (frame - before) / (time - before) * (next[i] - m[i]);
    before = time;
  }
  return status;
}

/* ---- Instances, placed ---- */

static enum hsr_status read_instance(const struct reader *reader,
                                     const struct place *place, json_t *value,
                                     const json_t *numbers, struct placed *to) {
  static const char *const keys[] = {"object", "matrix", "translate", "scale",
                                     "places", "motion", NULL};
  static const char *const excluded[] = {"matrix", "translate", "scale", NULL};
  struct hsr_instance *instance = &to->instance;
  json_t *object;
  enum hsr_status status = check_keys(reader, place, value, keys);
  if (!status)
    status = require(reader, place, value, "object", &object);
  if (!status)
    status = read_reference(reader, &(struct place){place, "object", 0}, object,
                            numbers, &instance->object);
  json_t *places = json_object_get(value, "places");
  json_t *motion = json_object_get(value, "motion");
  struct place of_places = {place, "places", 0};
  if (!status && places)
    status = exclude(reader, place, value, "places", excluded);
  if (!status && places)
    status = check_moves(reader, &of_places, instance->object);
  if (!status)
    status = places ? read_places(reader, &of_places, places, instance->m)
                    : read_matrix(reader, place, value, instance->m);
  return !status && motion
             ? read_motion(reader, &(struct place){place, "motion", 0}, motion,
                           to)
             : status;
}

static int compare_placed(const void *a, const void *b) {
  const struct placed *p = a, *q = b;
  if (p->instance.object != q->instance.object)
    return p->instance.object < q->instance.object ? -1 : 1;
  return (p->order > q->order) - (p->order < q->order);
}

/* Objects from the last instance's up to object `end` that have no instance get
 * one: hsr_scene_finish leaves them out where motion is known. */
static enum hsr_status place_before(struct hsr_scene *scene, uint32_t end) {
  uint32_t n = scene->n_instances;
  uint32_t o = n ? scene->instances[n - 1].object + 1 : 0;
  enum hsr_status status = HSR_OK;
  for (; o < end && !status; o++)
    status = hsr_scene_instance(scene, o, NULL);
  return status;
}

static enum hsr_status append_instances(const struct reader *reader,
                                        struct placed *list, size_t n) {
  struct hsr_scene *scene = reader->scene;
  enum hsr_status status = HSR_OK;
  bool any = false; /* is known of motion */
  qsort(list, n, sizeof *list, compare_placed);
  for (size_t i = 0; i < n; i++)
    any |= list[i].has_motion;
  for (size_t i = 0; i < n && !status; i++) {
    const struct placed *p = &list[i];
    if (any)
      status = place_before(scene, p->instance.object);
    if (!status)
      status = hsr_scene_instance(scene, p->instance.object, p->instance.m);
    if (!status && p->has_motion)
      status =
          hsr_scene_set_motion(scene, &p->motion, p->key, (uint32_t)p->n_keys);
  }
  if (!status && any)
    status = place_before(scene, scene->n_objects);
  return status ? hsr_fail_nomem(reader->err) : HSR_OK;
}

/* Into list[], which has room for all. */
static enum hsr_status list_instances(const struct reader *reader,
                                      struct hsr_json_part instances,
                                      const json_t *numbers,
                                      struct placed *list) {
  struct place place = {NULL, "instances", 0};
  json_t *value = NULL;
  enum hsr_status status = next(reader, &instances, &value);
  for (size_t i = 0; value && !status; i++) {
    list[i].order = i;
    status = read_instance(reader, &(struct place){&place, NULL, i}, value,
                           numbers, &list[i]);
    if (!status)
      status = next(reader, &instances, &value);
  }
  json_decref(value);
  return status;
}

static enum hsr_status read_instances(const struct reader *reader,
                                      struct hsr_json_part instances) {
  size_t n = hsr_json_count(instances);
  if (!n)
    return HSR_OK;
  struct placed *list = calloc(n, sizeof *list);
  json_t *numbers = number_by_name(reader->scene);
  enum hsr_status status =
      list && numbers ? list_instances(reader, instances, numbers, list)
                      : hsr_fail_nomem(reader->err);
  if (!status)
    status = append_instances(reader, list, n);
  for (size_t i = 0; i < n && list; i++)
    free(list[i].key);
  json_decref(numbers);
  free(list);
  return status;
}

/* ---- Views ---- */

static enum hsr_status read_view(const struct reader *reader,
                                 const struct place *place, json_t *value) {
  static const char *const keys[] = {"eye",      "at",    "up",  "fov", "near",
                                     "parallel", "light", "sun", NULL};
  struct hsr_camera camera = {.up = {0, 1, 0}, .fov = 45};
  const struct {
    const char *key;
    double *to;
    size_t n; /* of an array; 0: one number */
    bool required;
  } members[] = {{"eye", camera.eye, 3, true},
                 {"at", camera.at, 3, true},
                 {"up", camera.up, 3, false},
                 {"fov", &camera.fov, 0, false},
                 {"near", &camera.near, 0, false},
                 {"parallel", &camera.parallel, 0, false},
                 {"light", camera.light, 3, false},
                 {"sun", camera.light, 3, false}};
  enum hsr_status status = check_keys(reader, place, value, keys);
  for (size_t i = 0; i < sizeof members / sizeof *members && !status; i++) {
    struct place here = {place, members[i].key, 0};
    json_t *member = json_object_get(value, members[i].key);
    if (!member && members[i].required)
      return require(reader, place, value, members[i].key, &member);
    if (member)
      status = members[i].n ? read_numbers(reader, &here, member, members[i].n,
                                           members[i].to)
                            : read_number(reader, &here, member, members[i].to);
  }
  if (status)
    return status;
  bool is_point = json_object_get(value, "light");
  if (is_point && json_object_get(value, "sun"))
    return refuse(reader, place, "has a light and a sun; there is one light");
  camera.light[3] = is_point ? 1 : 0;
  struct hsr_error why;
  if (hsr_camera_check(&camera, &why))
    return refuse(reader, place, "%s", why.text);
  return hsr_scene_view(reader->scene, &camera) ? hsr_fail_nomem(reader->err)
                                                : HSR_OK;
}

/* ---- The whole file ---- */

static enum hsr_status check_schema(const struct reader *reader,
                                    const json_t *root, const char *known) {
  struct place place = {NULL, "schema", 0};
  json_t *schema;
  const char *text = "";
  if (!json_is_object(root))
    return wrong_kind(reader, NULL, "an object", root);
  enum hsr_status status = require(reader, NULL, root, "schema", &schema);
  if (!status)
    status = read_string(reader, &place, schema, &text);
  if (!status && strcmp(text, known))
    return refuse(reader, &place, "must be '%s', not '%.60s'", known, text);
  return status;
}

static enum hsr_status read_objects(struct reader *reader,
                                    struct hsr_json_part objects) {
  struct place place = {NULL, "objects", 0};
  struct hsr_json_part part, list[OBJECT_LISTS];
  enum hsr_status status = HSR_OK;
  for (size_t o = 0; !status && hsr_json_next(&objects, &part); o++) {
    json_t *value;
    status = parse(reader, part, OF_OBJECT, list, &value);
    if (!status)
      status =
          read_object(reader, &(struct place){&place, NULL, o}, value, list);
    json_decref(value);
  }
  return status;
}

static enum hsr_status read_views(const struct reader *reader,
                                  struct hsr_json_part views) {
  struct place place = {NULL, "views", 0};
  json_t *view = NULL;
  enum hsr_status status = next(reader, &views, &view);
  for (size_t i = 0; view && !status; i++) {
    status = read_view(reader, &(struct place){&place, NULL, i}, view);
    if (!status)
      status = next(reader, &views, &view);
  }
  json_decref(view);
  return status;
}

static enum hsr_status read_name(const struct reader *reader,
                                 const json_t *name) {
  struct place place = {NULL, "name", 0};
  const char *text = "";
  enum hsr_status status = read_string(reader, &place, name, &text);
  return status ? status : rename_to(reader, &reader->scene->name, text);
}

/* A file without it is frame 0. Who reads it may ask for another. */
static enum hsr_status read_frame(struct reader *reader, const json_t *frame) {
  struct place place = {NULL, "frame", 0};
  double number = 0;
  enum hsr_status status = read_number(reader, &place, frame, &number);
  if (!status && !(fabs(number) <= MOST_FRAME && number == rint(number)))
    return refuse(reader, &place, "%.15g is no whole number up to %ld", number,
                  MOST_FRAME);
  if (!status && !reader->frame_given)
    reader->frame = (long)number;
  return status;
}

/* What is known of the motion holds in this frame. */
static enum hsr_status check_motion(const struct reader *reader) {
  struct hsr_error why;
  if (reader->frame && hsr_scene_set_frame(reader->scene, reader->frame))
    return hsr_fail_nomem(reader->err);
  return hsr_scene_check_motion(reader->scene, &why)
             ? refuse(reader, NULL, "%s", why.text)
             : HSR_OK;
}

/* Refuses members that should be lists and are not. */
static enum hsr_status check_lists(const struct reader *reader,
                                   const json_t *root) {
  json_t *list;
  enum hsr_status status = require(reader, NULL, root, "objects", &list);
  for (int k = 0; k < SCENE_LISTS && !status; k++)
    if ((list = json_object_get(root, scene_lists[k])))
      status =
          read_array(reader, &(struct place){NULL, scene_lists[k], 0}, list);
  return status;
}

static enum hsr_status
read_scene(struct reader *reader, json_t *root,
           const struct hsr_json_part list[SCENE_LISTS]) {
  static const char *const keys[] = {"schema",    "name",  "frame", "objects",
                                     "instances", "views", NULL};
  json_t *name = json_object_get(root, "name");
  json_t *frame = json_object_get(root, "frame");
  enum hsr_status status = check_schema(reader, root, SCHEMA);
  if (!status)
    status = check_keys(reader, NULL, root, keys);
  if (!status && name)
    status = read_name(reader, name);
  if (!status && frame)
    status = read_frame(reader, frame);
  if (!status)
    status = check_lists(reader, root);
  if (!status)
    status = read_objects(reader, list[OBJECTS]);
  if (!status)
    status = read_instances(reader, list[INSTANCES]);
  if (!status)
    status = check_motion(reader);
  return status ? status : read_views(reader, list[VIEWS]);
}

/* Parses the file and has it read. */
static enum hsr_status
read_file(struct reader *reader,
          enum hsr_status (*read)(struct reader *reader, json_t *root,
                                  const struct hsr_json_part *list)) {
  struct hsr_json_part file = {.line = 1}, list[SCENE_LISTS];
  char *text = NULL;
  json_t *root = NULL;
  enum hsr_status status =
      hsr_json_load(reader->path, &text, &file.length, reader->err);
  file.text = text;
  if (!status)
    status = parse(reader, file, OF_FILE, list, &root);
  if (!status)
    status = read(reader, root, list);
  json_decref(root);
  free(text);
  return status;
}

/* Reads a scene; *with says how, and has nothing of it yet. */
static enum hsr_status read_with(const struct reader *with,
                                 struct hsr_import *import) {
  struct reader reader = *with;
  if (import)
    reader.import =
        (struct hsr_import){.drop_degenerate = import->drop_degenerate,
                            .two_sided = import->two_sided,
                            .threads = import->threads};
  enum hsr_status status = read_file(&reader, read_scene);
  free(reader.corners);
  forget_meshes(&reader);
  if (import)
    *import = reader.import;
  return status;
}

enum hsr_status hsr_scene_json_read(struct hsr_scene *scene, const char *path,
                                    struct hsr_import *import,
                                    struct hsr_error *err) {
  struct reader reader = {.scene = scene, .path = path, .err = err};
  return read_with(&reader, import);
}

enum hsr_status hsr_scene_json_read_frame(struct hsr_scene *scene,
                                          const char *path, long frame,
                                          struct hsr_import *import,
                                          struct hsr_error *err) {
  struct reader reader = {.scene = scene,
                          .path = path,
                          .err = err,
                          .frame = frame,
                          .frame_given = true};
  return read_with(&reader, import);
}

/* ---- Cameras ---- */

static enum hsr_status
read_cameras(struct reader *reader, json_t *root,
             const struct hsr_json_part list[SCENE_LISTS]) {
  static const char *const keys[] = {"schema", "views", NULL};
  json_t *views;
  enum hsr_status status = check_schema(reader, root, CAMERA_SCHEMA);
  if (!status)
    status = check_keys(reader, NULL, root, keys);
  if (!status)
    status = require(reader, NULL, root, "views", &views);
  if (!status)
    status = read_array(reader, &(struct place){NULL, "views", 0}, views);
  uint32_t before = reader->scene->n_views;
  if (!status)
    status = read_views(reader, list[VIEWS]);
  if (!status && reader->scene->n_views == before)
    return refuse(reader, &(struct place){NULL, "views", 0}, "is empty");
  return status;
}

enum hsr_status hsr_cameras_json_read(struct hsr_scene *scene, const char *path,
                                      struct hsr_error *err) {
  struct reader reader = {.scene = scene, .path = path, .err = err};
  return read_file(&reader, read_cameras);
}

/* ---- Writing ---- */

/* Values go through jansson one by one, a vertex or a name at a time, and so
 * take no memory to speak of; the lines around them are laid out here. After a
 * failure nothing more is written. */
struct writer {
  FILE *out;
  const char *path;
  enum hsr_status status;
  struct hsr_error *err;
};

/* 17 digits tell all doubles apart, 9 all floats. */
enum { DOUBLE_DIGITS = 17, FLOAT_DIGITS = 9 };

static void put_text(struct writer *writer, const char *text) {
  if (!writer->status && fputs(text, writer->out) == EOF)
    writer->status =
        hsr_json_fail_errno(writer->path, "cannot be written", writer->err);
}

/* Writes and releases a value; NULL: there was no memory for it. */
static void put(struct writer *writer, json_t *value, size_t digits) {
  size_t flags = JSON_ENCODE_ANY | JSON_COMPACT | JSON_REAL_PRECISION(digits);
  if (!writer->status && (!value || json_dumpf(value, writer->out, flags)))
    writer->status = ferror(writer->out)
                         ? hsr_json_fail_errno(writer->path,
                                               "cannot be written", writer->err)
                         : hsr_fail_nomem(writer->err);
  json_decref(value);
}

static void put_string(struct writer *writer, const char *text) {
  errno = 0;
  json_t *value = json_string(text);
  if (!value && errno != ENOMEM && !writer->status)
    writer->status =
        hsr_fail(writer->err, HSR_E_INPUT,
                 "%s: cannot be written: the name '%.60s' is not UTF-8",
                 hsr_json_shown(writer->path), text);
  put(writer, value, DOUBLE_DIGITS);
}

static void put_array(struct writer *writer, const double *v, size_t n,
                      size_t digits) {
  json_t *array = json_array();
  for (size_t i = 0; i < n && !writer->status; i++)
    if (!isfinite(v[i]))
      writer->status = hsr_fail(writer->err, HSR_E_INPUT,
                                "%s: cannot be written: a number is not finite",
                                hsr_json_shown(writer->path));
  for (size_t i = 0; array && i < n; i++)
    if (json_array_append_new(array, json_real(v[i]))) {
      json_decref(array);
      array = NULL;
    }
  put(writer, array, digits);
}

static void put_colour(struct writer *writer, const float rgb[3]) {
  double v[3] = {rgb[0], rgb[1], rgb[2]};
  put_array(writer, v, 3, FLOAT_DIGITS);
}

static void put_face(struct writer *writer, const uint32_t *vertices,
                     size_t n) {
  json_t *array = json_array();
  for (size_t i = 0; array && i < n; i++)
    if (json_array_append_new(array, json_integer(vertices[i]))) {
      json_decref(array);
      array = NULL;
    }
  put(writer, array, DOUBLE_DIGITS);
}

/* The start of line i of a list; its end is "]" on the line of the last. */
static void put_line(struct writer *writer, uint32_t i, const char *indent) {
  put_text(writer, i ? ",\n" : "\n");
  put_text(writer, indent);
}

static void put_object(struct writer *writer, const struct hsr_object *object) {
  put_text(writer, "{\"name\": ");
  put_string(writer, object->name);
  put_text(writer, object->one_sided ? ",\n   \"one_sided\": true"
                                     : ",\n   \"one_sided\": false");
  put_text(writer, ",\n   \"colour\": ");
  put_colour(writer, object->colour);
  if (object->opacity < 1) {
    put_text(writer, ",\n   \"opacity\": ");
    put(writer, json_real((double)object->opacity), FLOAT_DIGITS);
  }
  if (object->moves)
    put_text(writer, ",\n   \"moves\": true");
  put_text(writer, ",\n   \"vertices\": [");
  for (uint32_t v = 0; v < object->n_vertices && !writer->status; v++) {
    put_line(writer, v, "    ");
    put_array(writer, object->xyz + 3 * (size_t)v, 3, DOUBLE_DIGITS);
  }
  put_text(writer, "],\n   \"faces\": [");
  for (uint32_t f = 0; f < object->n_faces && !writer->status; f++) {
    put_line(writer, f, "    ");
    put_face(writer, object->vertex + object->start[f],
             object->start[f + 1] - object->start[f]);
  }
  if (object->rgb)
    put_text(writer, "],\n   \"face_colours\": [");
  for (uint32_t f = 0; object->rgb && f < object->n_faces && !writer->status;
       f++) {
    put_line(writer, f, "    ");
    put_colour(writer, object->rgb + 3 * (size_t)f);
  }
  put_text(writer, "]}");
}

static void put_box(struct writer *writer, const double lo[3],
                    const double hi[3]) {
  put_text(writer, "\"lo\": ");
  put_array(writer, lo, 3, DOUBLE_DIGITS);
  put_text(writer, ", \"hi\": ");
  put_array(writer, hi, 3, DOUBLE_DIGITS);
  put_text(writer, "}");
}

/* A box that is infinite in some directions says nothing in a file. */
static bool is_bounded(const struct hsr_motion *motion) {
  bool bounded = true;
  for (int a = 0; a < 3; a++)
    bounded &= isfinite(motion->lo[a]) && isfinite(motion->hi[a]);
  return bounded;
}

/* The key of a member; *n of them were put before. */
static void put_key(struct writer *writer, int *n, const char *key) {
  put_text(writer, (*n)++ ? ", " : "");
  put_text(writer, key);
}

static void put_motion(struct writer *writer, const struct hsr_scene *scene,
                       uint32_t i) {
  const struct hsr_motion motion = hsr_scene_motion(scene, i);
  int n = 0;
  put_text(writer, ",\n    \"motion\": {");
  if (isfinite(motion.speed)) {
    put_key(writer, &n, "\"speed\": ");
    put(writer, json_real(motion.speed), DOUBLE_DIGITS);
  }
  if (is_bounded(&motion)) {
    put_key(writer, &n, "\"within\": {");
    put_box(writer, motion.lo, motion.hi);
  }
  if (motion.n_keys)
    put_key(writer, &n, "\"way\": [");
  for (uint32_t k = 0; k < motion.n_keys && !writer->status; k++) {
    const struct hsr_key *key = &scene->motions->key[motion.first_key + k];
    put_line(writer, k, "      {\"frame\": ");
    put(writer, json_real(key->frame), DOUBLE_DIGITS);
    put_text(writer, ", ");
    put_box(writer, key->lo, key->hi);
  }
  put_text(writer, motion.n_keys ? "]}" : "}");
}

static bool is_known(const struct hsr_motion *motion) {
  return isfinite(motion->speed) || is_bounded(motion) || motion->n_keys;
}

/* An object by its name, or by its number where the name is not its alone. */
static void put_instance(struct writer *writer, const struct hsr_scene *scene,
                         uint32_t i, const json_t *numbers) {
  const struct hsr_instance *instance = &scene->instances[i];
  const char *name = scene->objects[instance->object].name;
  put_text(writer, "{\"object\": ");
  if (json_integer_value(json_object_get(numbers, name)) == AMBIGUOUS)
    put(writer, json_integer(instance->object), DOUBLE_DIGITS);
  else
    put_string(writer, name);
  put_text(writer, ", \"matrix\": ");
  put_array(writer, instance->m, 12, DOUBLE_DIGITS);
  const struct hsr_motion motion = hsr_scene_motion(scene, i);
  if (is_known(&motion))
    put_motion(writer, scene, i);
  put_text(writer, "}");
}

static void put_instances(struct writer *writer,
                          const struct hsr_scene *scene) {
  json_t *numbers = number_by_name(scene);
  if (!numbers && !writer->status)
    writer->status = hsr_fail_nomem(writer->err);
  put_text(writer, ",\n \"instances\": [");
  for (uint32_t i = 0; i < scene->n_instances && !writer->status; i++) {
    put_line(writer, i, "  ");
    put_instance(writer, scene, i, numbers);
  }
  put_text(writer, "]");
  json_decref(numbers);
}

static void put_view(struct writer *writer, const struct hsr_camera *camera) {
  put_text(writer, "{\"eye\": ");
  put_array(writer, camera->eye, 3, DOUBLE_DIGITS);
  put_text(writer, ", \"at\": ");
  put_array(writer, camera->at, 3, DOUBLE_DIGITS);
  put_text(writer, ", \"up\": ");
  put_array(writer, camera->up, 3, DOUBLE_DIGITS);
  put_text(writer, ", \"fov\": ");
  put(writer, json_real(camera->fov), DOUBLE_DIGITS);
  put_text(writer, ", \"near\": ");
  put(writer, json_real(camera->near), DOUBLE_DIGITS);
  if (camera->parallel > 0) {
    put_text(writer, ", \"parallel\": ");
    put(writer, json_real(camera->parallel), DOUBLE_DIGITS);
  }
  if (hsr_camera_has_light(camera)) {
    put_text(writer, camera->light[3] > 0 ? ", \"light\": " : ", \"sun\": ");
    put_array(writer, camera->light, 3, DOUBLE_DIGITS);
  }
  put_text(writer, "}");
}

static void put_scene(struct writer *writer, const struct hsr_scene *scene) {
  put_text(writer, "{\"schema\": ");
  put_string(writer, SCHEMA);
  put_text(writer, ",\n \"name\": ");
  put_string(writer, scene->name);
  if (hsr_scene_frame(scene)) {
    put_text(writer, ",\n \"frame\": ");
    put(writer, json_integer(hsr_scene_frame(scene)), DOUBLE_DIGITS);
  }
  put_text(writer, ",\n \"objects\": [");
  for (uint32_t o = 0; o < scene->n_objects && !writer->status; o++) {
    put_line(writer, o, "  ");
    put_object(writer, &scene->objects[o]);
  }
  put_text(writer, "]");
  if (scene->n_instances)
    put_instances(writer, scene);
  if (scene->n_views)
    put_text(writer, ",\n \"views\": [");
  for (uint32_t i = 0; i < scene->n_views && !writer->status; i++) {
    put_line(writer, i, "  ");
    put_view(writer, &scene->views[i]);
  }
  put_text(writer, scene->n_views ? "]}\n" : "}\n");
}

static void put_cameras(struct writer *writer, const struct hsr_camera *views,
                        uint32_t n) {
  put_text(writer, "{\"schema\": ");
  put_string(writer, CAMERA_SCHEMA);
  put_text(writer, ",\n \"views\": [");
  for (uint32_t i = 0; i < n && !writer->status; i++) {
    put_line(writer, i, "  ");
    put_view(writer, &views[i]);
  }
  put_text(writer, "]}\n");
}

/* A file that is written by put_scene, or else by put_cameras: whole, or not at
 * all. */
struct content {
  const struct hsr_scene *scene; /* NULL: cameras */
  const struct hsr_camera *views;
  uint32_t n_views;
};

static enum hsr_status write_content(const struct content *content,
                                     const char *path, struct hsr_error *err) {
  struct hsr_whole_file file;
  enum hsr_status status = hsr_whole_file_open(&file, path, err);
  if (status)
    return status;
  struct writer writer = {.out = file.stream, .path = path, .err = err};
  if (content->scene)
    put_scene(&writer, content->scene);
  else
    put_cameras(&writer, content->views, content->n_views);
  return hsr_whole_file_close(&file, writer.status, err);
}

enum hsr_status hsr_scene_json_write(const struct hsr_scene *scene,
                                     const char *path, struct hsr_error *err) {
  return write_content(&(struct content){.scene = scene}, path, err);
}

enum hsr_status hsr_cameras_json_write(const struct hsr_camera *views,
                                       uint32_t n, const char *path,
                                       struct hsr_error *err) {
  return write_content(&(struct content){.views = views, .n_views = n}, path,
                       err);
}
