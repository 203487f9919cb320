/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A scene as a grove of trees: for each object a tree of its faces
 * (common/trees/bsp.h), kept once however many instances it has, and the
 * instances in an order for every eye.
 *
 * Source      N. Greene, "Hierarchical Polygon Tiling with Coverage Masks",
 *             SIGGRAPH 1996, 9: an octree of BSP trees, replicated; the
 *             separating planes are those of Schumacker, as Sutherland et al.
 *             1974 tell.
 * Apart       instances can be put in order if planes across the axes separate
 *             them, each from all others. Boxes may touch if no face in a side
 *             of its object's box is to be seen from within: then no two faces
 *             in one plane, of two instances, exist for one eye.
 * Exact       they must be moved only, by what rounds nothing: then what is
 *             true of the object's planes is true of the instance's
 * Whole       what does not fulfil this is one tree of all faces, if these can
 *             be laid out */
#ifndef HSR_COMMON_GROVE_H
#define HSR_COMMON_GROVE_H

#include "common/trees/bsp.h"

#ifdef __cplusplus
extern "C" {
#endif

/* An object by itself. */
struct hsr_grove_tree {
  struct hsr_scene scene; /* of it and one instance, that is not moved */
  struct hsr_instance instance;
  struct hsr_world world;
  struct hsr_bsp bsp;
};

/* Instances, separated by a plane across an axis: those of one child have no
 * point where the coordinate is greater than `at`, the others none where it is
 * less. Or a single one. */
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

/* `world` is borrowed; its faces are convex, if it is laid out. *grove is freed
 * with hsr_grove_free also after a failure: HSR_E_NOMEM; HSR_E_REFUSED where it
 * is an outline and the instances cannot be put in order, or a face of an
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
