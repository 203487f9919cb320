/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/scene/flat.h"
#include "common/base/share.h"
#include "common/polygon/polygon.h"
#include "common/scene/planes.h"

#include <stdatomic.h>
#include <string.h>

size_t hsr_ring_tidy(uint32_t *ring, size_t n) {
  size_t kept = 0;
  for (size_t k = 0; k < n; k++)
    if (!kept || ring[k] != ring[kept - 1])
      ring[kept++] = ring[k];
  while (kept > 1 && ring[kept - 1] == ring[0])
    kept--;
  return kept;
}

bool hsr_ring_is_flat(const struct hsr_object *object, const uint32_t *ring,
                      size_t n, bool *out_of_memory) {
  const double *xyz = object->xyz;
  const struct hsr_loop loop = {xyz, xyz + 1, xyz + 2, 3, ring, (uint32_t)n};
  return n < 3 || (!hsr_has_normal_for_certain(&loop) &&
                   hsr_exact_is_on_line(loop, out_of_memory));
}

struct search {
  const struct hsr_object *object;
  atomic_bool out_of_memory;
};

static bool is_flat(struct search *search, uint32_t f) {
  const struct hsr_object *object = search->object;
  const uint32_t *start = object->start + f;
  bool out_of_memory = false;
  bool flat = hsr_ring_is_flat(object, object->vertex + start[0],
                               start[1] - start[0], &out_of_memory);
  if (out_of_memory)
    atomic_store(&search->out_of_memory, true);
  return flat;
}

static uint32_t find_flat(void *context, uint32_t from, uint32_t to) {
  uint32_t f = from;
  while (f < to && !is_flat(context, f))
    f++;
  return f;
}

/* Moves face `from`, of which n corners begin at `corners`, to the place of face
 * `to`, which is not after it. */
static void move_face(struct hsr_object *object, uint32_t from,
                      uint32_t corners, uint32_t n, uint32_t to) {
  memmove(object->vertex + object->start[to], object->vertex + corners,
          n * sizeof *object->vertex);
  object->start[to + 1] = object->start[to] + n;
  if (object->rgb)
    memmove(object->rgb + 3 * (size_t)to, object->rgb + 3 * (size_t)from,
            3 * sizeof *object->rgb);
  if (object->face_opacity)
    object->face_opacity[to] = object->face_opacity[from];
}

/* Moves the marks up to face f: the next face that is kept will be number
 * `kept`. */
static void move_marks(struct hsr_face_marks *left, uint32_t f, uint32_t kept) {
  for (; left->n && *left->face <= f; left->n--)
    *left->face++ = kept;
}

enum hsr_status hsr_object_leave_out_flat(struct hsr_object *object,
                                          int threads,
                                          struct hsr_face_marks marks,
                                          uint64_t *n) {
  enum { RANGE = 4096 }; /* faces that a thread takes at a time */
  struct search search = {.object = object};
  const uint32_t n_faces = object->n_faces;
  uint32_t kept = hsr_share_search(threads, n_faces, RANGE, find_flat, &search);
  for (; marks.n && *marks.face < kept; marks.n--)
    marks.face++; /* those before the first flat face stay */
  for (uint32_t f = kept; f < n_faces; f++) {
    move_marks(&marks, f, kept);
    if (!is_flat(&search, f))
      move_face(object, f, object->start[f],
                object->start[f + 1] - object->start[f], kept++);
  }
  move_marks(&marks, n_faces, kept);
  object->n_faces = kept;
  *n = n_faces - kept;
  return atomic_load(&search.out_of_memory) ? HSR_E_NOMEM : HSR_OK;
}

void hsr_object_change_vertices(struct hsr_object *object, const uint32_t *to,
                                struct hsr_face_marks marks, uint64_t *n) {
  const uint32_t n_faces = object->n_faces;
  uint32_t kept = 0, first = 0;
  for (uint32_t f = 0; f < n_faces; f++) {
    const uint32_t end = object->start[f + 1];
    move_marks(&marks, f, kept);
    for (uint32_t k = first; k < end; k++)
      object->vertex[k] = to[object->vertex[k]];
    const size_t left = hsr_ring_tidy(object->vertex + first, end - first);
    if (left >= 3)
      move_face(object, f, first, (uint32_t)left, kept++);
    first = end;
  }
  move_marks(&marks, n_faces, kept);
  object->n_faces = kept;
  *n = n_faces - kept;
}
