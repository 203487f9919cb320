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
#include "common/files/json/scene_json.h"
#include "common/files/json/json_members.h"
#include "common/files/json/scene_json_shared.h"
#include "common/scene/flat.h"
#include "common/scene/motion.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

static const long MOST_FRAME = 2147483647;

/* What is read an element at a time: of the file, and of an object. */
enum { OBJECTS, INSTANCES, VIEWS, SCENE_LISTS };
static const char *const scene_lists[] = {"objects", "instances", "views",
                                          NULL};
enum { VERTICES, FACES, FACE_COLOURS, OBJECT_LISTS };
static const char *const object_lists[] = {"vertices", "faces", "face_colours",
                                           NULL};

enum { OF_FILE, OF_OBJECT, OF_LEAF };
static const hsr_json_levels levels[] = {scene_lists, object_lists, NULL};

struct reader {
  struct hsr_scene *scene;
  struct hsr_json_input input;
  struct hsr_import import; /* n_dropped: so far */
  struct hsr_json_part lists[SCENE_LISTS];
  struct hsr_json_part of_object[OBJECT_LISTS]; /* of the current one */
  json_t *colour;                               /* of the current face */
  uint32_t *corners;                            /* of the same */
  size_t cap_corners;
  struct mesh *mesh; /* the latest that was read */
  struct entry *entry; /* of "objects", in order */
  uint32_t n_entries, cap_entries;
  json_t *numbers; /* of entries, by their names */
  struct placed *placed; /* of "instances", in order */
  size_t n_placed;
  long frame;        /* the scene is this frame of the file */
  bool frame_given;  /* by who reads it; else the file says it, or it is 0 */
};

/* A mesh file that has been read, so that it is read once however many entries
 * are made of it. Kept are what a scene file may change in the objects. */
struct mesh {
  struct mesh *before;
  char *path;
  uint32_t first, n;             /* its objects in the scene */
  struct hsr_object *as_read;    /* of them, the names, colours and so on */
  struct hsr_instance *instance; /* of the file; `object` counts from 0 */
  uint32_t n_instances;
  uint64_t n_dropped;
};

/* An element of "objects": one object, or those of a mesh file. */
struct entry {
  char *name;
  uint32_t first, n;       /* its objects in the scene */
  const struct mesh *mesh; /* NULL: it has no file */
};

static struct reader *reader_of(const struct hsr_json_node *at) {
  return at->input->reader;
}

static struct entry *latest_entry(const struct hsr_json_node *at) {
  struct reader *reader = reader_of(at);
  return &reader->entry[reader->n_entries - 1];
}

/* The last object. */
static struct hsr_object *latest(const struct hsr_json_node *at) {
  struct hsr_scene *scene = reader_of(at)->scene;
  return &scene->objects[scene->n_objects - 1];
}

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
static enum hsr_status take_name(const struct hsr_json_node *at, void *to) {
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
static enum hsr_status read_index(const struct hsr_json_node *at,
                                  const char *what, uint32_t n, uint32_t *to) {
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
  return hsr_json_list(at, reader_of(at)->of_object[VERTICES], levels + OF_LEAF,
                       NULL, take_vertex, to);
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
                          levels + OF_LEAF, NULL, &reader->colour);
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
    status = read_index(&corner, "vertex", latest(at)->n_vertices,
                        &reader->corners[i]);
  }
  return status ? status : add_face(at, n, reader->colour ? rgba : NULL);
}

static enum hsr_status take_faces(const struct hsr_json_node *at, void *to) {
  struct reader *reader = reader_of(at);
  enum hsr_status status = hsr_json_list(at, reader->of_object[FACES],
                                         levels + OF_LEAF, NULL, take_face, to);
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

/* ---- Mesh files ---- */

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
    for (uint32_t k = 0; k < mesh->n; k++) {
      free(mesh->as_read[k].name);
      free(mesh->as_read[k].face_opacity);
    }
    free(mesh->as_read);
    free(mesh->instance);
    free(mesh->path);
    free(mesh);
  }
}

/* Keeps what a scene file may change in an object. */
static enum hsr_status keep_object(struct hsr_object *kept,
                                   const struct hsr_object *object) {
  const size_t size = object->n_faces * sizeof *object->face_opacity;
  *kept = (struct hsr_object){.name = strdup(object->name),
                              .one_sided = object->one_sided,
                              .opacity = object->opacity};
  memcpy(kept->colour, object->colour, sizeof kept->colour);
  if (object->face_opacity && (kept->face_opacity = malloc(size)))
    memcpy(kept->face_opacity, object->face_opacity, size);
  return kept->name && !kept->face_opacity == !object->face_opacity
             ? HSR_OK
             : HSR_E_NOMEM;
}

/* Keeps the objects' changeable parts, and the places of the file. `read` is a
 * scene of the file alone. */
static enum hsr_status keep_mesh(struct mesh *mesh,
                                 const struct hsr_scene *read) {
  mesh->as_read = calloc(read->n_objects + 1u, sizeof *mesh->as_read);
  mesh->instance = calloc(read->n_instances + 1u, sizeof *mesh->instance);
  if (!mesh->as_read || !mesh->instance)
    return HSR_E_NOMEM;
  while (mesh->n < read->n_objects) {
    const uint32_t k = mesh->n++;
    if (keep_object(&mesh->as_read[k], &read->objects[k]))
      return HSR_E_NOMEM;
  }
  mesh->n_instances = read->n_instances;
  for (uint32_t i = 0; i < read->n_instances; i++)
    mesh->instance[i] = read->instances[i];
  return HSR_OK;
}

/* A scene file has its own views. */
static void note_views(struct hsr_import *import, const char *path,
                       uint32_t n_views) {
  const size_t used = strlen(import->notes);
  if (n_views)
    snprintf(import->notes + used, sizeof import->notes - used,
             "%s: %u camera%s left out: a scene file has its own views\n", path,
             n_views, n_views == 1 ? "" : "s");
}

/* Reads a mesh file, and keeps note of it. Takes `path`. */
static enum hsr_status read_new_mesh(struct reader *reader, char *path) {
  struct mesh *mesh = calloc(1, sizeof *mesh);
  if (!mesh) {
    free(path);
    return hsr_fail_nomem(reader->input.err);
  }
  *mesh = (struct mesh){.before = reader->mesh,
                        .path = path,
                        .first = reader->scene->n_objects};
  reader->mesh = mesh;
  struct hsr_import import = reader->import;
  struct hsr_scene *read = hsr_scene_new("");
  enum hsr_status status =
      read ? hsr_mesh_read(read, path, &import, reader->input.err)
           : hsr_fail_nomem(reader->input.err);
  if (!status) {
    note_views(&import, path, read->n_views);
    read->n_views = 0;
    status = keep_mesh(mesh, read);
    read->n_instances = 0;
    if (!status)
      status = hsr_scene_take(reader->scene, read);
    if (status)
      hsr_fail_nomem(reader->input.err);
  }
  hsr_scene_delete(read);
  mesh->n_dropped = import.n_dropped;
  memcpy(reader->import.notes, import.notes, sizeof import.notes);
  return status;
}

/* Appends another object that is as `from` was when it was read. */
static enum hsr_status copy_object(struct reader *reader, uint32_t number,
                                   const struct hsr_object *as_read) {
  struct hsr_object *to = hsr_scene_object(reader->scene, as_read->name);
  if (!to)
    return hsr_fail_nomem(reader->input.err);
  const struct hsr_object *from = &reader->scene->objects[number];
  enum hsr_status status = HSR_OK;
  to->one_sided = as_read->one_sided;
  to->opacity = as_read->opacity;
  memcpy(to->colour, as_read->colour, sizeof to->colour);
  for (uint32_t v = 0; v < from->n_vertices && !status; v++) {
    const double *p = from->xyz + 3 * (size_t)v;
    status = hsr_object_vertex(to, p[0], p[1], p[2], NULL);
  }
  for (uint32_t f = 0; f < from->n_faces && !status; f++) {
    status = hsr_object_face(to, from->vertex + from->start[f],
                             from->start[f + 1] - from->start[f],
                             from->rgb ? from->rgb + 3 * (size_t)f : NULL);
    if (!status)
      status = hsr_object_set_opacity(to, f, hsr_face_opacity(as_read, f));
  }
  return status ? hsr_fail_nomem(reader->input.err) : HSR_OK;
}

/* The file's name without its suffix. */
static char *stem_of(const char *path) {
  const char *slash = strrchr(path, '/');
  const char *name = slash ? slash + 1 : path, *dot = strrchr(name, '.');
  return strndup(name, dot ? (size_t)(dot - name) : strlen(name));
}

static enum hsr_status take_mesh(const struct hsr_json_node *at, void *to) {
  struct reader *reader = reader_of(at);
  struct entry *entry = latest_entry(at);
  const char *file = "";
  (void)to;
  enum hsr_status status = hsr_json_string(at, &file);
  if (status)
    return status;
  char *path = resolve(at->input->path, file);
  entry->name = path ? stem_of(path) : NULL;
  if (!entry->name) {
    free(path);
    return hsr_json_nomem(at);
  }
  const struct mesh *mesh = reader->mesh;
  while (mesh && strcmp(mesh->path, path))
    mesh = mesh->before;
  if (mesh) {
    free(path);
    for (uint32_t k = 0; k < mesh->n && !status; k++)
      status = copy_object(reader, mesh->first + k, &mesh->as_read[k]);
  } else {
    status = read_new_mesh(reader, path);
    mesh = reader->mesh;
  }
  entry->mesh = mesh;
  entry->n = mesh->n;
  if (!status)
    reader->import.n_dropped += mesh->n_dropped;
  return status;
}

/* ---- Objects ---- */

/* A name of one object becomes its own; several keep theirs. */
static enum hsr_status take_own_name(const struct hsr_json_node *at, void *to) {
  struct entry *entry = latest_entry(at);
  (void)to;
  enum hsr_status status = take_name(at, &entry->name);
  return status || entry->n > 1 ? status : take_name(at, &latest(at)->name);
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
      {"file", take_mesh, NULL},
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
  return hsr_json_list(at, reader->lists[OBJECTS], levels + OF_OBJECT,
                       reader->of_object, take_object, reader);
}

/* ---- Where an instance is ---- */

/* A matrix, or else a translation and a scale. */
struct pose {
  double m[12], translate[3], scale[3];
};

static const struct pose at_rest = {.scale = {1, 1, 1}};

/* The rules of a pose, and what excludes it: NULL, nothing. */
/* clang-format off */
#define POSE(pose, excluder)                                                   \
  {"matrix", hsr_json_matrix, (pose).m, .beside = {excluder}},                 \
  {"translate", hsr_json_point, (pose).translate,                              \
   .beside = {"matrix", excluder}},                                            \
  {"scale", take_scale, (pose).scale, .beside = {"matrix", excluder}}
/* clang-format on */

/* One number for all axes, or one for each. */
static enum hsr_status take_scale(const struct hsr_json_node *at, void *to) {
  double *scale = to;
  if (json_is_array(at->value))
    return hsr_json_point(at, scale);
  if (!json_is_number(at->value))
    return hsr_json_wrong_kind(at, "a number or three");
  scale[0] = scale[1] = scale[2] = json_number_value(at->value);
  return HSR_OK;
}

/* The matrix of a pose that was read from a value. */
static void get_matrix(const struct hsr_json_node *at, const struct pose *pose,
                       double m[12]) {
  memcpy(m, pose->m, sizeof pose->m);
  for (int k = 0; k < 3 && !json_object_get(at->value, "matrix"); k++) {
    m[5 * k] = pose->scale[k];
    m[4 * k + 3] = pose->translate[k];
  }
}

/* A time after *to, where it goes. */
static enum hsr_status take_time(const struct hsr_json_node *at, void *to) {
  double *time = to, before = *time;
  enum hsr_status status = hsr_json_number(at, time);
  return status || *time > before
             ? status
             : hsr_json_refuse(at, "%.15g is not after %.15g", *time, before);
}

/* Refuses what is said of the motion of an instance that does not move. */
static enum hsr_status check_moves(const struct hsr_json_node *at, uint32_t e) {
  const struct reader *reader = reader_of(at);
  const struct entry *entry = &reader->entry[e];
  return reader->scene->objects[entry->first].moves
             ? HSR_OK
             : hsr_json_refuse(at, "object '%.60s' does not move", entry->name);
}

static enum hsr_status check_some(const struct hsr_json_node *at) {
  return json_is_array(at->value) && !json_array_size(at->value)
             ? hsr_json_refuse(at, "is empty")
             : HSR_OK;
}

/* The latest place of an instance, and what its matrix is up to there. */
struct places {
  double time;
  struct hsr_instance *instance;
};

/* At the time of a place, the instance is there; between two, each number of
 * the matrix changes steadily; before the first and after the last, it is at
 * that one. */
static enum hsr_status take_place(const struct hsr_json_node *at, void *to) {
  struct places *places = to;
  struct pose pose = at_rest;
  const double before = places->time, frame = (double)reader_of(at)->frame;
  const struct hsr_json_rule rules[] = {
      {"frame", take_time, &places->time, .required = true},
      POSE(pose, NULL),
      {0}};
  double *m = places->instance->m, next[12];
  enum hsr_status status = hsr_json_object(at, rules);
  if (status)
    return status;
  get_matrix(at, &pose, next);
  const double time = places->time;
  if (!at->index || time <= frame)
    memcpy(m, next, sizeof next);
  else if (before < frame)
    for (int i = 0; i < 12; i++)
      m[i] += (frame - before) / (time - before) * (next[i] - m[i]);
  return status;
}

static enum hsr_status take_places(const struct hsr_json_node *at, void *to) {
  struct places places = {-INFINITY, to};
  enum hsr_status status = check_moves(at, places.instance->object);
  if (!status)
    status = check_some(at);
  return status ? status : hsr_json_elements(at, take_place, &places);
}

/* ---- What is promised of an instance ---- */

/* An instance of an entry, or of an object; its place in the file, so that
 * sorting is stable; and what is known of its motion. */
struct placed {
  struct hsr_instance instance; /* `object` is the number of the entry, until the
                                   instances are appended */
  size_t order;
  bool has_motion;
  struct hsr_motion motion;
  struct hsr_key *key; /* malloc'ed; NULL: none */
  size_t n_keys;
  double time; /* of the latest key */
};

static enum hsr_status check_box(const struct hsr_json_node *at,
                                 const double lo[3], const double hi[3]) {
  const struct hsr_json_node most = hsr_json_member(at, "hi");
  for (size_t a = 0; a < 3; a++)
    if (lo[a] > hi[a]) {
      const struct hsr_json_node here = hsr_json_element(&most, a);
      return hsr_json_refuse(&here, "%.15g is below 'lo', %.15g", hi[a], lo[a]);
    }
  return HSR_OK;
}

static enum hsr_status take_within(const struct hsr_json_node *at, void *to) {
  struct hsr_motion *motion = to;
  const struct hsr_json_rule rules[] = {
      {"lo", hsr_json_point, motion->lo, .required = true},
      {"hi", hsr_json_point, motion->hi, .required = true},
      {0}};
  enum hsr_status status = hsr_json_object(at, rules);
  return status ? status : check_box(at, motion->lo, motion->hi);
}

static enum hsr_status take_key(const struct hsr_json_node *at, void *to) {
  struct placed *placed = to;
  struct hsr_key *key = &placed->key[at->index];
  const struct hsr_json_rule rules[] = {
      {"frame", take_time, &placed->time, .required = true},
      {"lo", hsr_json_point, key->lo, .required = true},
      {"hi", hsr_json_point, key->hi, .required = true},
      {0}};
  enum hsr_status status = hsr_json_object(at, rules);
  key->frame = placed->time;
  return status ? status : check_box(at, key->lo, key->hi);
}

static enum hsr_status take_way(const struct hsr_json_node *at, void *to) {
  struct placed *placed = to;
  enum hsr_status status = check_some(at);
  if (status)
    return status;
  placed->n_keys = json_array_size(at->value);
  placed->key = calloc(placed->n_keys + 1, sizeof *placed->key);
  placed->time = -INFINITY;
  return placed->key ? hsr_json_elements(at, take_key, placed)
                     : hsr_json_nomem(at);
}

static enum hsr_status take_speed(const struct hsr_json_node *at, void *to) {
  double *speed = to;
  enum hsr_status status = hsr_json_number(at, speed);
  return !status && *speed < 0
             ? hsr_json_refuse(at, "%.15g is negative", *speed)
             : status;
}

static enum hsr_status take_motion(const struct hsr_json_node *at, void *to) {
  struct placed *placed = to;
  const struct hsr_json_rule rules[] = {
      {"speed", take_speed, &placed->motion.speed},
      {"within", take_within, &placed->motion},
      {"way", take_way, placed},
      {0}};
  placed->has_motion = true;
  placed->motion = hsr_motion_unknown();
  enum hsr_status status = hsr_json_object(at, rules);
  return status ? status : check_moves(at, placed->instance.object);
}

/* ---- Instances ---- */

bool hsr_json_add_number(json_t *numbers, const char *name, uint32_t number) {
  const bool is_taken = json_object_get(numbers, name);
  return !json_object_set_new_nocheck(
      numbers, name,
      json_integer(is_taken ? HSR_JSON_AMBIGUOUS : (json_int_t)number));
}

/* The numbers of entries, by their names. NULL: out of memory. */
static json_t *number_entries(const struct reader *reader) {
  json_t *numbers = json_object();
  for (uint32_t e = 0; numbers && e < reader->n_entries; e++)
    if (!hsr_json_add_number(numbers, reader->entry[e].name, e)) {
      json_decref(numbers);
      return NULL;
    }
  return numbers;
}

/* An element of "objects" by its name or by its number. */
static enum hsr_status take_reference(const struct hsr_json_node *at,
                                      void *to) {
  const struct reader *reader = reader_of(at);
  uint32_t *object = to;
  if (json_is_number(at->value))
    return read_index(at, "object", reader->n_entries, object);
  if (!json_is_string(at->value))
    return hsr_json_wrong_kind(at, "a name or a number");
  const char *name = json_string_value(at->value);
  const json_t *number = json_object_get(reader->numbers, name);
  if (!number)
    return hsr_json_refuse(at, "there is no object '%.60s'", name);
  if (json_integer_value(number) == HSR_JSON_AMBIGUOUS)
    return hsr_json_refuse(
        at, "several objects are called '%.60s'; give its number", name);
  *object = (uint32_t)json_integer_value(number);
  return HSR_OK;
}

/* Into its element of a list. */
static enum hsr_status take_instance(const struct hsr_json_node *at, void *to) {
  struct placed *placed = (struct placed *)to + at->index;
  struct hsr_instance *instance = &placed->instance;
  struct pose pose = at_rest;
  const struct hsr_json_rule rules[] = {
      {"object", take_reference, &instance->object, .required = true},
      POSE(pose, "places"),
      {"places", take_places, instance},
      {"motion", take_motion, placed},
      {0}};
  placed->order = at->index;
  enum hsr_status status = hsr_json_object(at, rules);
  if (!json_object_get(at->value, "places"))
    get_matrix(at, &pose, instance->m);
  return status;
}

static int compare_placed(const void *a, const void *b) {
  const struct placed *p = a, *q = b;
  if (p->instance.object != q->instance.object)
    return p->instance.object < q->instance.object ? -1 : 1;
  return (p->order > q->order) - (p->order < q->order);
}

/* Elements of "objects" that nothing places are placed as they are. Appends
 * them to `list`, which has room, and returns its new length. */
static size_t place_rest(const struct reader *reader, struct placed *list,
                         size_t n) {
  static const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  const size_t n_listed = n;
  uint32_t e = 0;
  for (size_t i = 0; i <= n_listed; i++) {
    const uint32_t end =
        i < n_listed ? list[i].instance.object : reader->n_entries;
    for (; e < end; e++, n++) {
      list[n] = (struct placed){.instance.object = e, .order = n};
      memcpy(list[n].instance.m, identity, sizeof identity);
    }
    e += e == end;
  }
  return n;
}

/* Appends one instance of an object. */
static enum hsr_status append_one(struct hsr_scene *scene,
                                  const struct placed *p, uint32_t object,
                                  const double m[12]) {
  enum hsr_status status = hsr_scene_instance(scene, object, m);
  return status || !p->has_motion
             ? status
             : hsr_scene_set_motion(scene, &p->motion, p->key,
                                    (uint32_t)p->n_keys);
}

/* Appends the instances of one entry, object by object: n placements of it, and
 * in each the instances that its file has. */
static enum hsr_status append_entry(const struct reader *reader,
                                    const struct placed *list, size_t n) {
  const struct entry *entry = &reader->entry[list[0].instance.object];
  const struct mesh *mesh = entry->mesh;
  enum hsr_status status = HSR_OK;
  double m[12];
  for (uint32_t o = 0, from = 0, to = 0; o < entry->n && !status; o++) {
    for (from = to; mesh && to < mesh->n_instances; to++)
      if (mesh->instance[to].object != o)
        break;
    for (size_t i = 0; i < n && !status; i++) {
      const struct placed *p = &list[i];
      if (from == to)
        status =
            append_one(reader->scene, p, entry->first + o, p->instance.m);
      for (uint32_t k = from; k < to && !status; k++) {
        hsr_instance_compose(p->instance.m, mesh->instance[k].m, m);
        status = append_one(reader->scene, p, entry->first + o, m);
      }
    }
  }
  return status;
}

/* Appends all instances to the scene. */
static enum hsr_status append_instances(const struct hsr_json_node *root) {
  const struct reader *reader = reader_of(root);
  size_t n = reader->n_placed;
  struct placed *list = calloc(n + reader->n_entries + 1, sizeof *list);
  if (!list)
    return hsr_json_nomem(root);
  enum hsr_status status = HSR_OK;
  if (n)
    memcpy(list, reader->placed, n * sizeof *list);
  qsort(list, n, sizeof *list, compare_placed);
  n = place_rest(reader, list, n);
  qsort(list, n, sizeof *list, compare_placed);
  for (size_t from = 0, to = 0; from < n && !status; from = to) {
    while (to < n && list[to].instance.object == list[from].instance.object)
      to++;
    status = append_entry(reader, list + from, to - from);
  }
  free(list);
  if (status == HSR_E_INPUT)
    return hsr_json_refuse(root, "the place of an object is not finite");
  return status ? hsr_json_nomem(root) : HSR_OK;
}

static enum hsr_status take_instances(const struct hsr_json_node *at,
                                      void *to) {
  struct reader *reader = to;
  size_t n = hsr_json_count(reader->lists[INSTANCES]);
  if (!n)
    return hsr_json_array(at, NULL);
  reader->placed = calloc(n, sizeof *reader->placed);
  reader->n_placed = reader->placed ? n : 0;
  reader->numbers = number_entries(reader);
  enum hsr_status status =
      reader->placed && reader->numbers
          ? hsr_json_list(at, reader->lists[INSTANCES], levels + OF_LEAF, NULL,
                          take_instance, reader->placed)
          : hsr_json_nomem(at);
  json_decref(reader->numbers);
  return status;
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
  return hsr_json_list(at, reader->lists[VIEWS], levels + OF_LEAF, NULL,
                       take_view, NULL);
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
      {"name", take_name, &reader->scene->name},
      {"frame", take_frame, reader},
      {"objects", take_objects, reader, .required = true},
      {"instances", take_instances, reader},
      {"views", take_views, reader},
      {0}};
  enum hsr_status status = hsr_json_check_schema(root, HSR_SCENE_SCHEMA);
  if (!status)
    status = hsr_json_object(root, rules);
  if (!status)
    status = check_faces(root);
  if (!status)
    status = append_instances(root);
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
  enum hsr_status status = hsr_json_open(root.input, levels + OF_FILE,
                                         reader->lists, &text, &root.value);
  if (!status)
    status = read(&root);
  json_decref(root.value);
  free(text);
  return status;
}

static void forget(struct reader *reader) {
  forget_meshes(reader);
  for (size_t i = 0; i < reader->n_placed; i++)
    free(reader->placed[i].key);
  for (uint32_t e = 0; e < reader->n_entries; e++)
    free(reader->entry[e].name);
  free(reader->placed);
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
