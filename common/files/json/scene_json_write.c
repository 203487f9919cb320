/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/files/json/json_file.h"
#include "common/files/json/scene_json.h"
#include "common/files/json/scene_json_shared.h"
#include "common/files/whole_file.h"
#include "common/files/whole_input.h"
#include "common/scene/motion.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>

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
        hsr_path_fail(writer->path, "cannot be written", writer->err);
}

/* Writes a text and then a value, which it releases. NULL: there was no memory
 * for the value. */
static void put(struct writer *writer, const char *before, json_t *value,
                size_t digits) {
  put_text(writer, before);
  size_t flags = JSON_ENCODE_ANY | JSON_COMPACT | JSON_REAL_PRECISION(digits);
  if (!writer->status && (!value || json_dumpf(value, writer->out, flags)))
    writer->status =
        ferror(writer->out)
            ? hsr_path_fail(writer->path, "cannot be written", writer->err)
            : hsr_fail_nomem(writer->err);
  json_decref(value);
}

static void put_string(struct writer *writer, const char *before,
                       const char *text) {
  errno = 0;
  json_t *value = json_string(text);
  if (!value && errno != ENOMEM && !writer->status)
    writer->status =
        hsr_fail(writer->err, HSR_E_INPUT,
                 "%s: cannot be written: the name '%.60s' is not UTF-8",
                 hsr_path_shown(writer->path), text);
  put(writer, before, value, DOUBLE_DIGITS);
}

static void put_array(struct writer *writer, const char *before,
                      const double *v, size_t n, size_t digits) {
  json_t *array = json_array();
  for (size_t i = 0; i < n && !writer->status; i++)
    if (!isfinite(v[i]))
      writer->status = hsr_fail(writer->err, HSR_E_INPUT,
                                "%s: cannot be written: a number is not finite",
                                hsr_path_shown(writer->path));
  for (size_t i = 0; array && i < n; i++)
    if (json_array_append_new(array, json_real(v[i]))) {
      json_decref(array);
      array = NULL;
    }
  put(writer, before, array, digits);
}

static void put_colour(struct writer *writer, const char *before,
                       const float rgb[3]) {
  double v[3] = {rgb[0], rgb[1], rgb[2]};
  put_array(writer, before, v, 3, FLOAT_DIGITS);
}

/* The colour of a face, with its opacity if the object's faces differ. */
static void put_face_colour(struct writer *writer,
                            const struct hsr_object *object, uint32_t f) {
  const float *rgb = hsr_face_rgb(object, f);
  double v[4] = {rgb[0], rgb[1], rgb[2], hsr_face_opacity(object, f)};
  put_array(writer, "", v, object->face_opacity ? 4 : 3, FLOAT_DIGITS);
}

static void put_face(struct writer *writer, const uint32_t *vertices,
                     size_t n) {
  json_t *array = json_array();
  for (size_t i = 0; array && i < n; i++)
    if (json_array_append_new(array, json_integer(vertices[i]))) {
      json_decref(array);
      array = NULL;
    }
  put(writer, "", array, DOUBLE_DIGITS);
}

/* The start of line i of a list; its end is "]" on the line of the last. */
static void put_line(struct writer *writer, uint32_t i, const char *indent) {
  put_text(writer, i ? ",\n" : "\n");
  put_text(writer, indent);
}

static void put_object(struct writer *writer, const struct hsr_object *object) {
  put_string(writer, "{\"name\": ", object->name);
  put_text(writer, object->one_sided ? ",\n   \"one_sided\": true"
                                     : ",\n   \"one_sided\": false");
  put_colour(writer, ",\n   \"colour\": ", object->colour);
  if (object->opacity < 1) {
    put(writer, ",\n   \"opacity\": ", json_real((double)object->opacity),
        FLOAT_DIGITS);
  }
  if (object->moves)
    put_text(writer, ",\n   \"moves\": true");
  put_text(writer, ",\n   \"vertices\": [");
  for (uint32_t v = 0; v < object->n_vertices && !writer->status; v++) {
    put_line(writer, v, "    ");
    put_array(writer, "", object->xyz + 3 * (size_t)v, 3, DOUBLE_DIGITS);
  }
  put_text(writer, "],\n   \"faces\": [");
  for (uint32_t f = 0; f < object->n_faces && !writer->status; f++) {
    put_line(writer, f, "    ");
    put_face(writer, object->vertex + object->start[f],
             object->start[f + 1] - object->start[f]);
  }
  bool differ = object->rgb || object->face_opacity;
  if (differ)
    put_text(writer, "],\n   \"face_colours\": [");
  for (uint32_t f = 0; differ && f < object->n_faces && !writer->status; f++) {
    put_line(writer, f, "    ");
    put_face_colour(writer, object, f);
  }
  put_text(writer, "]}");
}

static void put_box(struct writer *writer, const double lo[3],
                    const double hi[3]) {
  put_array(writer, "\"lo\": ", lo, 3, DOUBLE_DIGITS);
  put_array(writer, ", \"hi\": ", hi, 3, DOUBLE_DIGITS);
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
    put(writer, "", json_real(motion.speed), DOUBLE_DIGITS);
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
    put(writer, "", json_real(key->frame), DOUBLE_DIGITS);
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
  if (json_integer_value(json_object_get(numbers, name)) == HSR_JSON_AMBIGUOUS)
    put(writer, "", json_integer(instance->object), DOUBLE_DIGITS);
  else
    put_string(writer, "", name);
  put_array(writer, ", \"matrix\": ", instance->m, 12, DOUBLE_DIGITS);
  const struct hsr_motion motion = hsr_scene_motion(scene, i);
  if (is_known(&motion))
    put_motion(writer, scene, i);
  put_text(writer, "}");
}

/* The numbers of objects, by their names. NULL: out of memory. */
static json_t *number_objects(const struct hsr_scene *scene) {
  json_t *numbers = json_object();
  for (uint32_t o = 0; numbers && o < scene->n_objects; o++)
    if (!hsr_json_add_number(numbers, scene->objects[o].name, o)) {
      json_decref(numbers);
      return NULL;
    }
  return numbers;
}

static void put_instances(struct writer *writer,
                          const struct hsr_scene *scene) {
  json_t *numbers = number_objects(scene);
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
  put_array(writer, "{\"eye\": ", camera->eye, 3, DOUBLE_DIGITS);
  put_array(writer, ", \"at\": ", camera->at, 3, DOUBLE_DIGITS);
  put_array(writer, ", \"up\": ", camera->up, 3, DOUBLE_DIGITS);
  put(writer, ", \"fov\": ", json_real(camera->fov), DOUBLE_DIGITS);
  put(writer, ", \"near\": ", json_real(camera->near), DOUBLE_DIGITS);
  if (camera->parallel > 0) {
    put(writer, ", \"parallel\": ", json_real(camera->parallel), DOUBLE_DIGITS);
  }
  if (hsr_camera_has_light(camera)) {
    put_array(writer, camera->light[3] > 0 ? ", \"light\": " : ", \"sun\": ",
              camera->light, 3, DOUBLE_DIGITS);
  }
  put_text(writer, "}");
}

static void put_scene(struct writer *writer, const struct hsr_scene *scene) {
  put_string(writer, "{\"schema\": ", HSR_SCENE_SCHEMA);
  put_string(writer, ",\n \"name\": ", scene->name);
  if (hsr_scene_frame(scene)) {
    put(writer, ",\n \"frame\": ", json_integer(hsr_scene_frame(scene)),
        DOUBLE_DIGITS);
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
  put_string(writer, "{\"schema\": ", HSR_CAMERA_SCHEMA);
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

enum hsr_status hsr_cameras_json_print(const struct hsr_camera *views,
                                       uint32_t n, FILE *out,
                                       struct hsr_error *err) {
  struct writer writer = {.out = out, .path = "standard output", .err = err};
  put_cameras(&writer, views, n);
  return writer.status;
}

enum hsr_status hsr_scene_json_print(const struct hsr_scene *scene, FILE *out,
                                     struct hsr_error *err) {
  struct writer writer = {.out = out, .path = scene->name, .err = err};
  put_scene(&writer, scene);
  return writer.status;
}
