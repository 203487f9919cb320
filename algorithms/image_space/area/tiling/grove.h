/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A scene as a grove of trees: for each object a tree of its faces
 * (common/trees/bsp.h), kept once however many instances it has, and the
 * instances in an order for every eye.
 *
 * Source      N. Greene, "Hierarchical Polygon Tiling with Coverage Masks",
 *             SIGGRAPH 1996, 9: an octree of BSP trees, replicated. The
 *             separating planes are Schumacker's, as described in Sutherland et
 *             al. 1974.
 * Invariants  planes across the axes separate each instance from all others.
 *             Boxes of instances may touch if no face in a side of an object's
 *             box can be seen from within the box: then no eye sees two faces
 *             in one plane that are of two instances. Instances are only moved,
 *             and by sums that are exact, so that what is true of an object's
 *             planes is true of the instance's.
 * Departures  a scene that does not fulfil this is one tree of all its faces,
 *             if it can be laid out */
#ifndef HSR_COMMON_GROVE_H
#define HSR_COMMON_GROVE_H

#include "common/trees/bsp.h"

#ifdef __cplusplus
extern "C" {
#endif

/* An object by itself. */
struct hsr_grove_tree {
  struct hsr_scene scene; /* of this object and one instance, not moved */
  struct hsr_instance instance;
  struct hsr_world world;
  struct hsr_bsp bsp;
};

/* Either a single instance; or instances that a plane across an axis separates.
 * Those of `below` have no point where the coordinate is greater than `at`, and
 * those of `above` none where it is less. */
struct hsr_grove_node {
  struct hsr_box box; /* holds them all */
  int axis;           /* -1: a single instance */
  double at;
  uint32_t below, above; /* nodes */
  uint32_t instance;
};

struct hsr_grove {
  const struct hsr_world *world;
  struct hsr_bsp whole; /* of all faces, if is_whole */
  bool is_whole;
  struct hsr_grove_tree *tree; /* an object; else */
  struct hsr_grove_node *node; /* the first is the root */
  uint32_t n_nodes, n_trees;

  /* The most that a tree has: points and corners of a leaf, corners of a face,
   * nodes on a path. */
  uint32_t most_points, most_corners, most_face, most_depth;
  struct hsr_arena arena;
};

/* `world` is borrowed; if it is laid out, its faces are convex. *grove is freed
 * with hsr_grove_free also after a failure: HSR_E_NOMEM; HSR_E_REFUSED if the
 * world is an outline whose instances cannot be put in order, or a face of an
 * object is not convex. */
enum hsr_status hsr_grove_init(struct hsr_grove *grove,
                               const struct hsr_world *world,
                               const struct hsr_bsp_rule *rule,
                               struct hsr_error *err);
void hsr_grove_free(struct hsr_grove *grove);

#ifdef __cplusplus
}
#endif
#endif
