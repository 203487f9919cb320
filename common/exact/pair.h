/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Comparing two faces of a scene that is not laid out: only those two are laid
 * out. This is rare, since an approximate comparison usually decides. */
#ifndef HSR_COMMON_PAIR_H
#define HSR_COMMON_PAIR_H

#include "common/exact/screen.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What is known of the planes of two faces, f < g; f == g: of none. */
struct hsr_pair_planes {
  uint32_t f, g;
  bool same;
};
enum { HSR_PAIRS_KEPT = 256 };

struct hsr_pair {
  struct hsr_world world; /* of two faces, the lower id first */
  uint32_t id[2];         /* of those laid out; equal: none are yet */
  bool has_planes;        /* `world` and `screen` have their planes */
  struct hsr_screen screen;

  /* Of pairs that only exact numbers could compare: in one plane every sample of
   * both is a tie, and is settled without them from then on. */
  struct hsr_pair_planes planes[HSR_PAIRS_KEPT];
};

/* Returns the greatest number of vertices of a face of the scene; 3 if there is
 * no larger face. The faces of a grid must be made (hsr_scene_make_faces). */
uint32_t hsr_largest_face(const struct hsr_scene *scene);

/* Makes room for two faces. `scene` is the world that the ids belong to, laid
 * out or a roster. The faces of a grid must be made. All arguments are borrowed
 * and must outlive *pair, whose arrays are in the arena. *pair must not be
 * copied or moved. HSR_E_NOMEM. */
enum hsr_status hsr_pair_init(struct hsr_pair *pair,
                              const struct hsr_world *scene,
                              const struct hsr_view *view,
                              struct hsr_arena *arena);

/* hsr_nearer and hsr_nearer_at (common/exact/screen.h) for two faces given by
 * their ids in the scene, f != g. */
bool hsr_pair_nearer(struct hsr_pair *pair, uint32_t f, uint32_t g, int i,
                     int j, struct hsr_tally *tally);
bool hsr_pair_nearer_at(struct hsr_pair *pair, uint32_t f, uint32_t g,
                        double sx, double sy, struct hsr_tally *tally);

/* Whether the planes of two faces, given by their ids, are exactly the same. */
bool hsr_pair_same_plane(struct hsr_pair *pair, uint32_t f, uint32_t g,
                         struct hsr_tally *tally);

#ifdef __cplusplus
}
#endif
#endif
