/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The faces of one cluster after another, for algorithms that find the order
 * within a cluster by themselves.
 *
 * A face that is not flat may have no place in the order of clusters: if it is
 * within its thickness of a separating plane (it is thick, and in no cluster),
 * or if the eye grazes its own plane. Such faces are loose: they belong to no
 * cluster in this frame. */
#ifndef HSR_ALGORITHMS_CLUSTER_FACES_H
#define HSR_ALGORITHMS_CLUSTER_FACES_H

#include "algorithms/list_priority/fixed/cluster_order.h"

struct hsr_cluster_faces {
  const struct hsr_screen *screen;
  const struct hsr_clusters *clusters;
  bool *relevant;           /* by face: it is in screen->relevant[] */
  uint32_t *faces, n_faces; /* of the cluster taken last */
  uint32_t *loose, n_loose; /* the loose faces found so far */
};

/* Begins a frame. The screen's faces have been culled; it is borrowed as long
 * as *c. Memory from `arena`. HSR_E_NOMEM. */
static inline enum hsr_status
hsr_cluster_faces_init(struct hsr_cluster_faces *c,
                       const struct hsr_screen *screen,
                       struct hsr_arena *arena) {
  uint32_t n = screen->n_relevant;
  *c = (struct hsr_cluster_faces){.screen = screen,
                                  .clusters = screen->world->clusters};
  c->relevant = HSR_NEW_ZEROED(arena, bool, screen->world->n_faces);
  c->faces = HSR_NEW(arena, uint32_t, n);
  c->loose = HSR_NEW(arena, uint32_t, n);
  if (!c->relevant || !c->faces || !c->loose)
    return HSR_E_NOMEM;
  for (uint32_t r = 0; r < n; r++)
    c->relevant[screen->relevant[r]] = true;
  return HSR_OK;
}

/* Takes a cluster: puts its relevant faces into faces[], and appends the loose
 * ones among them to loose[]. A two-sided face is in a cluster twice, once for
 * each side; it is taken once. */
static inline void hsr_cluster_faces_take(struct hsr_cluster_faces *c,
                                          uint32_t cluster) {
  const struct hsr_clusters *all = c->clusters;
  c->n_faces = 0;
  for (uint32_t k = all->start[cluster]; k < all->start[cluster + 1]; k++) {
    uint32_t f = all->order[k] / 2;
    if (all->order[k] % 2 || !c->relevant[f])
      continue;
    if (hsr_grazes(c->screen, f, all->reach[f]))
      c->loose[c->n_loose++] = f;
    else
      c->faces[c->n_faces++] = f;
  }
}

/* Appends the relevant faces that are in no cluster to loose[]. */
static inline void hsr_cluster_faces_take_thick(struct hsr_cluster_faces *c) {
  const struct hsr_clusters *all = c->clusters;
  for (uint32_t k = 0; k < all->n_thick; k++)
    if (all->thick[k] % 2 == 0 && c->relevant[all->thick[k] / 2])
      c->loose[c->n_loose++] = all->thick[k] / 2;
}

#endif
