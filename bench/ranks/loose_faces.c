/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/ranks/loose_faces.h"

#include <stdlib.h>
#include <string.h>

void loose_faces_free(struct loose_faces *faces) {
  free(faces->id);
  free(faces->size);
  free(faces->rgb);
  free(faces->xyz);
  *faces = (struct loose_faces){.n = 0};
}

/* Room for n faces with so many corners; none is there yet. */
static enum hsr_status make(struct loose_faces *out, size_t n, size_t corners) {
  *out = (struct loose_faces){.n = 0};
  out->id = malloc((n + 1) * sizeof *out->id);
  out->size = malloc((n + 1) * sizeof *out->size);
  out->rgb = malloc(3 * (n + 1) * sizeof *out->rgb);
  out->xyz = malloc(3 * (corners + 1) * sizeof *out->xyz);
  if (out->id && out->size && out->rgb && out->xyz)
    return HSR_OK;
  loose_faces_free(out);
  return HSR_E_NOMEM;
}

/* --- What is seen --------------------------------------------------------- */

static int compare_ids(const void *a, const void *b) {
  uint32_t f = *(const uint32_t *)a, g = *(const uint32_t *)b;
  return (f > g) - (f < g);
}

/* The different faces of a picture, ascending; the caller frees them. NULL for
 * lack of memory. */
static uint32_t *list_seen(const uint32_t *picture, size_t n, size_t *n_seen) {
  size_t runs = 1, found = 0;
  for (size_t k = 1; k < n; k++)
    runs += picture[k] != picture[k - 1];
  uint32_t *id = malloc(runs * sizeof *id);
  if (!id)
    return NULL;
  for (size_t k = 0; k < n; k++)
    if (picture[k] != HSR_BACKGROUND && (!k || picture[k] != picture[k - 1]))
      id[found++] = picture[k];
  qsort(id, found, sizeof *id, compare_ids);
  *n_seen = 0;
  for (size_t k = 0; k < found; k++)
    if (!k || id[k] != id[k - 1])
      id[(*n_seen)++] = id[k];
  return id;
}

static void add_placed(struct loose_faces *out, const struct hsr_world *world,
                       struct hsr_place at, uint32_t id) {
  const struct hsr_object *object = at.object;
  const double *m = world->roster.scene->instances[at.instance].m;
  const float *rgb = hsr_face_rgb(object, at.face);
  uint32_t start = object->start[at.face], end = object->start[at.face + 1];
  out->id[out->n] = id;
  out->size[out->n] = end - start;
  memcpy(out->rgb + 3 * (size_t)out->n, rgb, 3 * sizeof *rgb);
  for (uint32_t c = start; c < end; c++)
    hsr_instance_vertex(m, object->xyz + 3 * (size_t)object->vertex[c],
                        out->xyz + 3 * out->n_corners++);
  out->n++;
}

enum hsr_status loose_faces_seen(struct loose_faces *out,
                                 const struct hsr_world *world, uint32_t first,
                                 const uint32_t *picture, size_t n) {
  size_t n_seen, corners = 0;
  uint32_t *seen = list_seen(picture, n, &n_seen);
  if (!seen)
    return HSR_E_NOMEM;
  for (size_t k = 0; k < n_seen; k++) {
    struct hsr_place at = hsr_place_of(world, seen[k]);
    corners += at.object->start[at.face + 1] - at.object->start[at.face];
  }
  enum hsr_status status = make(out, n_seen, corners);
  for (size_t k = 0; k < n_seen && !status; k++)
    add_placed(out, world, hsr_place_of(world, seen[k]), first + seen[k]);
  free(seen);
  return status;
}

/* --- Choosing and uniting ------------------------------------------------- */

/* Appends face k, whose corners begin at `corner`. */
static void append(struct loose_faces *out, const struct loose_faces *from,
                   uint32_t k, size_t corner) {
  out->id[out->n] = from->id[k];
  out->size[out->n] = from->size[k];
  memcpy(out->rgb + 3 * (size_t)out->n, from->rgb + 3 * (size_t)k,
         3 * sizeof *out->rgb);
  memcpy(out->xyz + 3 * out->n_corners, from->xyz + 3 * corner,
         3 * from->size[k] * sizeof *out->xyz);
  out->n_corners += from->size[k];
  out->n++;
}

enum hsr_status loose_faces_select(struct loose_faces *out,
                                   const struct loose_faces *faces,
                                   const uint32_t *picture, size_t n) {
  size_t n_seen, corner = 0, next = 0;
  uint32_t *seen = list_seen(picture, n, &n_seen);
  if (!seen)
    return HSR_E_NOMEM;
  enum hsr_status status = make(out, n_seen, faces->n_corners);
  for (uint32_t k = 0; k < faces->n && next < n_seen && !status; k++) {
    if (faces->id[k] == seen[next]) {
      append(out, faces, k, corner);
      next++;
    }
    corner += faces->size[k];
  }
  free(seen);
  return status;
}

enum hsr_status loose_faces_unite(struct loose_faces *out,
                                  const struct loose_faces *a,
                                  const struct loose_faces *b) {
  size_t corner_a = 0, corner_b = 0;
  enum hsr_status status =
      make(out, (size_t)a->n + b->n, a->n_corners + b->n_corners);
  for (uint32_t i = 0, j = 0; (i < a->n || j < b->n) && !status;) {
    bool has_a = i < a->n && (j == b->n || a->id[i] <= b->id[j]);
    bool has_b = j < b->n && (i == a->n || b->id[j] <= a->id[i]);
    if (has_a)
      append(out, a, i, corner_a);
    else
      append(out, b, j, corner_b);
    corner_a += has_a ? a->size[i++] : 0;
    corner_b += has_b ? b->size[j++] : 0;
  }
  return status;
}

uint32_t loose_faces_find(const struct loose_faces *faces, uint32_t id) {
  uint32_t low = 0, high = faces->n;
  while (high - low > 1) {
    uint32_t middle = low + (high - low) / 2;
    if (faces->id[middle] <= id)
      low = middle;
    else
      high = middle;
  }
  return low;
}

/* --- As bytes ------------------------------------------------------------- */

/* First the numbers of faces and corners, then the arrays: corners before what
 * is smaller. */
enum { HEAD = 2 * sizeof(uint64_t) };

static size_t bytes_of(size_t n, size_t corners) {
  return HEAD + 3 * corners * sizeof(double) +
         n * (2 * sizeof(uint32_t) + 3 * sizeof(float));
}

size_t loose_faces_bytes(const struct loose_faces *faces) {
  return bytes_of(faces->n, faces->n_corners);
}

static char *put(char *to, const void *from, size_t size) {
  if (size)
    memcpy(to, from, size);
  return to + size;
}

void loose_faces_pack(const struct loose_faces *faces, void *bytes) {
  const uint64_t head[2] = {faces->n, faces->n_corners};
  char *to = put(bytes, head, sizeof head);
  to = put(to, faces->xyz, 3 * faces->n_corners * sizeof *faces->xyz);
  to = put(to, faces->id, faces->n * sizeof *faces->id);
  to = put(to, faces->size, faces->n * sizeof *faces->size);
  put(to, faces->rgb, 3 * (size_t)faces->n * sizeof *faces->rgb);
}

static const char *get(const char *from, void *to, size_t size) {
  memcpy(to, from, size);
  return from + size;
}

enum hsr_status loose_faces_unpack(struct loose_faces *out, const void *bytes) {
  uint64_t head[2];
  const char *from = get(bytes, head, sizeof head);
  if (make(out, head[0], head[1]))
    return HSR_E_NOMEM;
  out->n = (uint32_t)head[0];
  out->n_corners = head[1];
  from = get(from, out->xyz, 3 * out->n_corners * sizeof *out->xyz);
  from = get(from, out->id, out->n * sizeof *out->id);
  from = get(from, out->size, out->n * sizeof *out->size);
  get(from, out->rgb, 3 * (size_t)out->n * sizeof *out->rgb);
  return HSR_OK;
}

/* --- As a world ----------------------------------------------------------- */

static enum hsr_status add_face(struct hsr_object *object, const double *xyz,
                                uint32_t n, const float *rgb,
                                uint32_t *corner) {
  enum hsr_status status = HSR_OK;
  for (uint32_t k = 0; k < n && !status; k++, xyz += 3)
    status = hsr_object_vertex(object, xyz[0], xyz[1], xyz[2], &corner[k]);
  return status ? status : hsr_object_face(object, corner, n, rgb);
}

static enum hsr_status fill(struct hsr_object *object,
                            const struct loose_faces *faces) {
  uint32_t *corner = malloc((faces->n_corners + 1) * sizeof *corner);
  enum hsr_status status = corner ? HSR_OK : HSR_E_NOMEM;
  size_t at = 0;
  for (uint32_t k = 0; k < faces->n && !status; at += faces->size[k++])
    status = add_face(object, faces->xyz + 3 * at, faces->size[k],
                      faces->rgb + 3 * (size_t)k, corner);
  free(corner);
  return status;
}

enum hsr_status loose_faces_lay_out(const struct loose_faces *faces,
                                    const char *name, struct hsr_scene **scene,
                                    struct hsr_world *world,
                                    struct hsr_error *err) {
  *world = (struct hsr_world){.n_faces = 0};
  *scene = hsr_scene_new(name);
  struct hsr_object *object = *scene ? hsr_scene_object(*scene, "seen") : NULL;
  if (!object || fill(object, faces) || hsr_scene_instance(*scene, 0, NULL))
    return hsr_fail_nomem(err);
  return hsr_world_init(world, *scene, err);
}
