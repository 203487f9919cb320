/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A grove: a scene as one octree of BSP trees for each object
 * (common/trees/bsp.h), made once however many instances the object has; and a
 * tree of planes that orders the instances for every eye. Below, a "tree" is
 * such an octree of BSP trees.
 *
 * Source      N. Greene, "Hierarchical Polygon Tiling with Coverage Masks",
 *             SIGGRAPH 1996, 9: an octree of BSP trees, replicated. The
 *             separating planes are Schumacker's, as described in Sutherland et
 *             al. 1974.
 * Invariants  - Planes across the axes (x, y or z = const) separate the boxes
 *             of all instances.
 *             - Two boxes may touch only if each face that lies in a side of an
 *             object's box looks outward. Then no eye sees two faces of
 *             different instances in one plane, whose order would be open.
 *             - An instance is its object moved, not turned or scaled, by sums
 *             that are exact. So what is true of the object's planes is true of
 *             the instance's.
 * Departures  A scene that does not fulfil this is one tree of all its faces
 *             (`whole`), if it can be laid out. */
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

/* Either a single instance; or several, which a plane across an axis divides:
 * those of `below` have no point where the coordinate is greater than `at`, and
 * those of `above` none where it is less. */
struct hsr_grove_node {
  struct hsr_box box;    /* in the world; holds all these instances */
  int axis;              /* of the plane; -1: a single instance */
  double at;             /* coordinate of the plane */
  uint32_t below, above; /* nodes on both sides; unless a single instance */
  uint32_t instance;     /* the single instance */
};

struct hsr_grove {
  const struct hsr_world *world; /* borrowed */

  bool is_whole;        /* one tree of all faces: */
  struct hsr_bsp whole; /* this one */

  struct hsr_grove_tree *tree; /* otherwise: one by object, */
  struct hsr_grove_node *node; /* and the instances; the first is the root */
  uint32_t n_nodes, n_trees;

  /* The most that any tree has: points of a leaf, corners of a piece in a leaf,
   * corners of a face, nodes on a path down. */
  uint32_t most_points, most_corners, most_face, most_depth;
  struct hsr_arena arena;
};

/* Makes the trees of a world, by `rule`, and the order of its instances.
 * `world` is borrowed as long as *grove; if it is laid out, its faces are
 * convex. *grove is freed with hsr_grove_free, also after a failure.
 * HSR_E_NOMEM; HSR_E_REFUSED if the world is a roster whose instances cannot be
 * put in order, or one of whose objects has a face that is not convex or not
 * flat; or as hsr_bsp_init. */
enum hsr_status hsr_grove_init(struct hsr_grove *grove,
                               const struct hsr_world *world,
                               const struct hsr_bsp_rule *rule,
                               struct hsr_error *err);
void hsr_grove_free(struct hsr_grove *grove);

#ifdef __cplusplus
}
#endif
#endif
