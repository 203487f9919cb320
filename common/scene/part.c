/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/scene/part.h"

#include <stdlib.h>
#include <string.h>

void hsr_scene_part_set(struct hsr_scene_part *part, uint32_t all) {
  part->all = all;
  part->first = (uint32_t)((uint64_t)all * part->number / part->of);
  part->n_faces =
      (uint32_t)((uint64_t)all * (part->number + 1) / part->of) - part->first;
}

/* A scene while it is cut. */
struct cut {
  struct hsr_scene *from, *to;
  uint32_t *number;       /* a vertex of the object that is divided: its new
                             number; NONE: it has none yet */
  uint32_t object, moved; /* the object of `from` that is moved to `to`, and
                             its number there; NONE */
};
static const uint32_t NONE = UINT32_MAX;

static const struct hsr_object *object_of(const struct cut *cut, uint32_t o) {
  return cut->object == o ? &cut->to->objects[cut->moved]
                          : &cut->from->objects[o];
}

static struct hsr_object *begin_object(struct cut *cut, const char *name) {
  return hsr_scene_object(cut->to, name);
}

static enum hsr_status copy_face(struct cut *cut, const struct hsr_object *from,
                                 struct hsr_object *to, uint32_t f,
                                 uint32_t *corner) {
  const uint32_t *vertex = from->vertex + from->start[f];
  uint32_t n = from->start[f + 1] - from->start[f];
  enum hsr_status status = HSR_OK;
  for (uint32_t k = 0; k < n && !status; k++) {
    uint32_t *number = &cut->number[vertex[k]];
    const double *p = from->xyz + 3 * (size_t)vertex[k];
    if (*number == NONE)
      status = hsr_object_vertex(to, p[0], p[1], p[2], number);
    corner[k] = *number;
  }
  if (!status)
    status = hsr_object_face(to, corner, n,
                             from->rgb ? from->rgb + 3 * (size_t)f : NULL);
  return status ? status
                : hsr_object_set_opacity(to, to->n_faces - 1,
                                         hsr_face_opacity(from, f));
}

static uint32_t most_corners(const struct hsr_object *object) {
  uint32_t most = 0;
  for (uint32_t f = 0; f < object->n_faces; f++) {
    uint32_t n = object->start[f + 1] - object->start[f];
    most = n > most ? n : most;
  }
  return most;
}

/* Makes an object of the faces from `first` to `end` of object o. */
static enum hsr_status copy_faces(struct cut *cut, uint32_t o, uint32_t first,
                                  uint32_t end) {
  struct hsr_object *to = begin_object(cut, object_of(cut, o)->name);
  if (!to)
    return HSR_E_NOMEM;
  const struct hsr_object *from = object_of(cut, o);
  memcpy(to->colour, from->colour, sizeof to->colour);
  to->opacity = from->opacity;
  to->one_sided = from->one_sided;
  to->moves = from->moves;
  uint32_t *corner = malloc((size_t)most_corners(from) * sizeof *corner);
  cut->number = malloc((size_t)from->n_vertices * sizeof *cut->number);
  enum hsr_status status = corner && cut->number ? HSR_OK : HSR_E_NOMEM;
  for (uint32_t v = 0; v < from->n_vertices && !status; v++)
    cut->number[v] = NONE;
  for (uint32_t f = first; f < end && !status; f++)
    status = copy_face(cut, from, to, f, corner);
  free(corner);
  free(cut->number);
  return status;
}

/* Moves object o, unless it is there already. */
static enum hsr_status move_object(struct cut *cut, uint32_t o) {
  if (cut->object == o)
    return HSR_OK;
  struct hsr_object *to = begin_object(cut, ""), empty = {.name = NULL};
  if (!to)
    return HSR_E_NOMEM;
  free(to->name);
  free(to->start);
  *to = cut->from->objects[o];
  free(to->group.vertex); /* of a part, no object is a group */
  to->group = empty.group;
  cut->from->objects[o] = empty;
  cut->object = o;
  cut->moved = cut->to->n_objects - 1;
  return HSR_OK;
}

/* Keeps the faces from `first` to `end` of an instance. */
static enum hsr_status keep(struct cut *cut,
                            const struct hsr_instance *instance, uint32_t first,
                            uint32_t end) {
  uint32_t o = instance->object;
  bool whole = end - first == object_of(cut, o)->n_faces;
  enum hsr_status status =
      whole ? move_object(cut, o) : copy_faces(cut, o, first, end);
  if (status)
    return status;
  return hsr_scene_instance(
      cut->to, whole ? cut->moved : cut->to->n_objects - 1, instance->m);
}

static enum hsr_status keep_all(struct cut *cut,
                                const struct hsr_scene_part *part) {
  uint64_t at = 0, first = part->first, end = first + part->n_faces;
  enum hsr_status status = HSR_OK;
  for (uint32_t i = 0; i < cut->from->n_instances && !status; i++) {
    const struct hsr_instance *instance = &cut->from->instances[i];
    uint64_t n = object_of(cut, instance->object)->n_faces;
    uint64_t a = first > at ? first - at : 0, b = end > at ? end - at : 0;
    b = b < n ? b : n;
    if (a < b)
      status = keep(cut, instance, (uint32_t)a, (uint32_t)b);
    at += n;
  }
  return status;
}

/* Gives `from` the contents of `to`, and `to` what is left of `from`, to be
 * deleted. */
static void swap_contents(struct hsr_scene *from, struct hsr_scene *to) {
  struct hsr_scene kept = *from;
  from->subject = HSR_FACES;
  from->grid = NULL;
  from->objects = to->objects;
  from->instances = to->instances;
  from->n_objects = to->n_objects;
  from->n_instances = to->n_instances;
  from->cap_objects = to->cap_objects;
  from->cap_instances = to->cap_instances;
  from->motions = NULL; /* of a part nothing is known */
  to->motions = kept.motions;
  to->grid = kept.grid;
  to->objects = kept.objects;
  to->instances = kept.instances;
  to->n_objects = kept.n_objects;
  to->n_instances = kept.n_instances;
}

static void cut_grid(struct hsr_grid *grid, struct hsr_scene_part *part) {
  uint32_t all = grid->n_faces;
  hsr_scene_part_set(part, grid->n_cells);
  part->all = all;
  hsr_grid_cut(grid, part->first, part->first + part->n_faces);
}

enum hsr_status hsr_scene_cut(struct hsr_scene *scene,
                              struct hsr_scene_part *part,
                              struct hsr_error *err) {
  struct cut cut = {.from = scene, .object = NONE};
  if (part->keeps_grid && scene->grid) {
    cut_grid(scene->grid, part);
    return HSR_OK;
  }
  enum hsr_status status = hsr_scene_make_faces(scene, err);
  if (status)
    return status;
  hsr_scene_part_set(part, (uint32_t)hsr_scene_faces(scene));
  cut.to = hsr_scene_new("");
  status = cut.to ? keep_all(&cut, part) : HSR_E_NOMEM;
  if (!status)
    swap_contents(scene, cut.to);
  hsr_scene_delete(cut.to);
  return status ? hsr_fail_nomem(err) : HSR_OK;
}
