/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Clusters of instances whose ways are known, in regions of space for intervals
 * of frames.
 *
 * Source      N. Greene, PhD thesis, UC Santa Cruz, 1995, the end of 3.4. A
 *             volume bounds a cluster for a sequence of frames. If it is hidden
 *             in one of them, so is the cluster. If not, the cluster is divided
 *             in space or in time; he leaves open which.
 * Choice      in time where an instance, on the average, passes over more than
 *             half of the cluster's length in the interval: dividing its members
 *             in space would not make the volume much smaller. Otherwise in
 *             space, at the middle of its members, along its longest side.
 * Kept        a cluster is made when it is first asked for, and stays until its
 *             interval, and the whole one that it is a part of, are over. So
 *             what is hidden costs nothing in later frames.
 * Invariant   a cluster's box holds all its members in all of its frames. */
#ifndef HSR_ALGORITHMS_SPACE_TIME_H
#define HSR_ALGORITHMS_SPACE_TIME_H

#include "algorithms/algorithm.h"
#include "algorithms/engines/cubes/cubes.h"

#ifdef __cplusplus
extern "C" {
#endif

/* An instance, where it is in the interval of a cluster. */
struct hsr_member {
  uint32_t instance;
  struct hsr_box box;
};

struct hsr_cluster {
  uint32_t first, n;  /* members */
  long from, to;      /* frames, both included */
  struct hsr_box box; /* of all members */
  double longest;     /* the sum of their boxes' longest sides */
  uint32_t child[2];  /* HSR_NO_NODE: not made yet, or none */
  enum { HSR_UNDIVIDED, HSR_IN_SPACE, HSR_IN_TIME } divided;
};

/* All zero before the first frame. Cluster 0 is of all instances of which
 * enough is known; the others are loose. */
struct hsr_space_time {
  struct hsr_growing cluster, member;
  uint32_t *loose, n_loose;
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

/* Makes ready for the scene's frame: begins anew if that is not within the
 * interval at hand; intervals have `frames` frames. The arena is its own.
 * HSR_E_NOMEM: all is to be thrown away. */
enum hsr_status hsr_space_time_begin(struct hsr_space_time *t,
                                     const struct hsr_cubes *cubes, long frames,
                                     struct hsr_tally *tally,
                                     struct hsr_arena *arena);

/* Divides a cluster of several members, if it is not yet: the parts, one or
 * two, that are to be looked at in the scene's frame. 0: out of memory. */
int hsr_space_time_divide(struct hsr_space_time *t, uint32_t k,
                          uint32_t part[2]);

#ifdef __cplusplus
}
#endif
#endif
