/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Clusters in space-time: instances that move, bounded by a box for an interval
 * of frames.
 *
 * Source      N. Greene, PhD thesis, UC Santa Cruz, 1995, the end of 3.4. If
 *             the box of a cluster is hidden in the present frame, its members
 *             are. Otherwise the cluster is divided in space or in time; the
 *             thesis leaves open which.
 * Notation    An instance's way is where it is in an interval of frames; it is
 *             known if hsr_scene_way can bound it (common/scene/motion.h).
 * Choice      A cluster is divided in time if its members' ways are longer, on
 *             the average, than half of its own longest side: dividing the
 *             members in space would not make the box much smaller. Otherwise
 *             it is divided in space, along its longest side, at the mean of
 *             its members' middles.
 * Kept        The first cluster, of all instances, is made anew when its
 *             interval is over. Others are made when they are first asked for,
 *             and last as long as the first. So a cluster that stays hidden
 *             costs one test in later frames, and nothing for its members.
 * Invariant   a cluster's box holds all its members in all of its frames */
#ifndef HSR_ALGORITHMS_SPACE_TIME_H
#define HSR_ALGORITHMS_SPACE_TIME_H

#include "algorithms/algorithm.h"
#include "algorithms/engines/cubes/cubes.h"

#ifdef __cplusplus
extern "C" {
#endif

/* An instance, and a box that holds it in all frames of a cluster. */
struct hsr_member {
  uint32_t instance;
  struct hsr_box box;
};

struct hsr_cluster {
  uint32_t first, n;  /* its members: `first` and so on, n of them */
  long from, to;      /* frames, both included */
  struct hsr_box box; /* in the world; around all members' boxes */
  double longest;     /* the sum of the members' boxes' longest sides */
  uint32_t child[2];  /* clusters; HSR_NO_NODE: not made yet, or none */
  enum { HSR_UNDIVIDED, HSR_IN_SPACE, HSR_IN_TIME } divided;
};

/* All zero before the first frame. Cluster 0 has all instances whose ways are
 * known; the others are loose. */
struct hsr_space_time {
  struct hsr_growing cluster, member; /* struct hsr_cluster, hsr_member */
  uint32_t *loose, n_loose;           /* instances */
  const struct hsr_scene *scene;
  struct hsr_tally *tally;
  struct hsr_arena *arena;
};

static inline struct hsr_cluster *hsr_cluster_at(const struct hsr_space_time *t,
                                                 uint32_t k) {
  return (struct hsr_cluster *)t->cluster.items + k;
}

static inline const struct hsr_member *
hsr_member_at(const struct hsr_space_time *t, uint32_t k) {
  return (const struct hsr_member *)t->member.items + k;
}

/* Makes the clusters ready for the scene's present frame. They begin anew if
 * that is not in the interval of cluster 0, which is of `frames` frames and
 * begins at a multiple of that. The arena is used by nothing else, and is reset
 * then. HSR_E_NOMEM: all is to be thrown away. */
enum hsr_status hsr_space_time_begin(struct hsr_space_time *t,
                                     const struct hsr_cubes *cubes, long frames,
                                     struct hsr_tally *tally,
                                     struct hsr_arena *arena);

/* Divides cluster k, of several members, if it is not divided yet. part[] gets
 * the clusters that matter in the present frame: both if it is divided in
 * space, one if it is divided in time. Returns how many; 0: out of memory. */
int hsr_space_time_divide(struct hsr_space_time *t, uint32_t k,
                          uint32_t part[2]);

#ifdef __cplusplus
}
#endif
#endif
