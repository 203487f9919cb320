/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Faces without area: all corners lie on one line. They cover no sample, so a
 * picture is the same without them. A face whose Newell normal is zero for
 * another reason has area: it crosses itself, and its parts cancel. */
#ifndef HSR_COMMON_SCENE_FLAT_H
#define HSR_COMMON_SCENE_FLAT_H

#include "common/scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Removes from a ring of n vertices each one that is the same as the one before
 * it, all around. Returns how many are left. */
size_t hsr_ring_tidy(uint32_t *ring, size_t n);

/* Whether a ring of vertices of an object, which are in range, has no area. If
 * memory runs out, *out_of_memory is set and the result means nothing. */
bool hsr_ring_is_flat(const struct hsr_object *object, const uint32_t *ring,
                      size_t n, bool *out_of_memory);

/* Numbers of faces of an object, ascending, that something begins at. When faces
 * are left out, each becomes the new number of the first face from it on that
 * is kept. Borrowed. */
struct hsr_face_marks {
  uint32_t *face;
  size_t n;
};

/* Leaves out the faces of an object that have no area. The others keep their
 * order. *n becomes how many were left out. HSR_E_NOMEM. */
enum hsr_status hsr_object_leave_out_flat(struct hsr_object *object,
                                          int threads,
                                          struct hsr_face_marks marks,
                                          uint64_t *n);

/* Replaces vertex v by vertex to[v] in all faces of an object. A vertex that then
 * follows itself is taken once. A face of which fewer than 3
 * corners are left is left out; *n becomes how many are. The others keep their
 * order, colours and opacities. */
void hsr_object_change_vertices(struct hsr_object *object, const uint32_t *to,
                                struct hsr_face_marks marks, uint64_t *n);

#ifdef __cplusplus
}
#endif
#endif
