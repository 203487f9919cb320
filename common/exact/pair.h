/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Comparing two faces of a scene that is not laid out, by laying out just those
 * two. This is rare: an approximate comparison usually decides. */
#ifndef HSR_COMMON_PAIR_H
#define HSR_COMMON_PAIR_H

#include "common/exact/screen.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_pair {
  struct hsr_world world; /* of two faces, the lower id first */
  uint32_t id[2];
  struct hsr_screen screen;
};

/* The largest number of vertices that a face of the scene has. */
uint32_t hsr_largest_face(const struct hsr_scene *scene);

/* `scene` is the world that the ids belong to, laid out or an outline. All
 * arguments are borrowed. *pair must not be moved, and lasts as long as the
 * arena's arrays. HSR_E_NOMEM. */
enum hsr_status hsr_pair_init(struct hsr_pair *pair,
                              const struct hsr_world *scene,
                              const struct hsr_view *view,
                              struct hsr_arena *arena);

/* hsr_nearer and hsr_nearer_at for two faces given by their ids in the scene, f
 * != g. */
bool hsr_pair_nearer(struct hsr_pair *pair, uint32_t f, uint32_t g, int i,
                     int j, struct hsr_tally *tally);
bool hsr_pair_nearer_at(struct hsr_pair *pair, uint32_t f, uint32_t g,
                        double sx, double sy, struct hsr_tally *tally);

/* Are the planes of two faces the same? */
bool hsr_pair_same_plane(struct hsr_pair *pair, uint32_t f, uint32_t g,
                         struct hsr_tally *tally);

#ifdef __cplusplus
}
#endif
#endif
