/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The instances of a scene file: where they are, and what is promised of
 * them. */
#include "common/files/json/scene_json_reader.h"
#include "common/files/json/scene_json_shared.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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
  struct hsr_instance
      instance; /* `object` is the number of the entry, until the
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
    return hsr_scene_read_index(at, "object", reader->n_entries, object);
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

/* Whether an element of "objects" that nothing places is placed here. Others are
 * placed by hsr_scene_finish, which leaves scenes alone where motion is
 * known. */
static bool is_to_place(const struct entry *entry, bool motion_known) {
  return motion_known || (entry->mesh && entry->mesh->n_instances);
}

/* Places what nothing places, as it is. Appends it to `list`, which is sorted
 * and has room, and returns the new length. */
static size_t place_rest(const struct reader *reader, struct placed *list,
                         size_t n) {
  static const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  const size_t n_listed = n;
  bool motion_known = false;
  for (size_t i = 0; i < n_listed; i++)
    motion_known |= list[i].has_motion;
  for (uint32_t e = 0, i = 0; e < reader->n_entries; e++) {
    const bool is_placed = i < n_listed && list[i].instance.object == e;
    while (i < n_listed && list[i].instance.object == e)
      i++;
    if (!is_placed && is_to_place(&reader->entry[e], motion_known)) {
      list[n] = (struct placed){.instance.object = e, .order = n};
      memcpy(list[n++].instance.m, identity, sizeof identity);
    }
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
        status = append_one(reader->scene, p, entry->first + o, p->instance.m);
      for (uint32_t k = from; k < to && !status; k++) {
        hsr_instance_compose(p->instance.m, mesh->instance[k].m, m);
        status = append_one(reader->scene, p, entry->first + o, m);
      }
    }
  }
  return status;
}

/* Appends all instances to the scene. */
enum hsr_status hsr_scene_append_instances(const struct hsr_json_node *root) {
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

enum hsr_status hsr_scene_take_instances(const struct hsr_json_node *at,
                                         void *to) {
  struct reader *reader = to;
  size_t n = hsr_json_count(reader->lists[INSTANCES]);
  if (!n)
    return hsr_json_array(at, NULL);
  reader->placed = calloc(n, sizeof *reader->placed);
  reader->n_placed = reader->placed ? n : 0;
  reader->numbers = number_entries(reader);
  enum hsr_status status = reader->placed && reader->numbers
                               ? hsr_json_list(at, reader->lists[INSTANCES],
                                               hsr_scene_levels + OF_LEAF, NULL,
                                               take_instance, reader->placed)
                               : hsr_json_nomem(at);
  json_decref(reader->numbers);
  return status;
}

void hsr_scene_forget_instances(struct reader *reader) {
  for (size_t i = 0; i < reader->n_placed; i++)
    free(reader->placed[i].key);
  free(reader->placed);
}
