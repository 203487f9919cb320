/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mesh files that a scene file names: all that is in one is one element of
 * "objects". */
#include "common/files/json/scene_json_reader.h"

#include <stdlib.h>
#include <string.h>

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

void hsr_scene_forget_meshes(struct reader *reader) {
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
  *mesh = (struct mesh){
      .before = reader->mesh, .path = path, .first = reader->scene->n_objects};
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

/* Groups of a mesh that is taken again share vertices among themselves. */
static enum hsr_status copy_group(struct hsr_object *to,
                                  const struct hsr_object *from) {
  const size_t size = (size_t)from->n_vertices * sizeof *from->group.vertex;
  if (!from->group.vertex)
    return HSR_OK;
  uint32_t *vertex = malloc(size);
  if (!vertex)
    return HSR_E_NOMEM;
  memcpy(vertex, from->group.vertex, size);
  to->group = from->group;
  to->group.vertex = vertex;
  return HSR_OK;
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
  if (!status)
    status = copy_group(to, from);
  return status ? hsr_fail_nomem(reader->input.err) : HSR_OK;
}

/* The file's name without its suffix. */
static char *stem_of(const char *path) {
  const char *slash = strrchr(path, '/');
  const char *name = slash ? slash + 1 : path, *dot = strrchr(name, '.');
  return strndup(name, dot ? (size_t)(dot - name) : strlen(name));
}

enum hsr_status hsr_scene_take_mesh(const struct hsr_json_node *at, void *to) {
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
  if (status)
    return status;
  entry->mesh = mesh;
  entry->n = mesh->n;
  reader->import.n_dropped += mesh->n_dropped;
  return HSR_OK;
}
