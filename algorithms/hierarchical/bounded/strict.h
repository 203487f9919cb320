/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The tiling pass in strict order: every polygon comes before all that it may
 * hide.
 *
 * Source      N. Greene, PhD thesis, UC Santa Cruz, 1995, 5.6 (p. 89): "Tile"
 *             with an octree of BSP trees (4.6.1) in place of an octree.
 * Gained      Neither two polygons nor a polygon and a cell are compared in
 *             depth: a cell that is covered hides all that comes later. Where
 *             polygons penetrate, they are cut into pieces.
 * Lost        There are more pieces than faces, with more lines. The scene is
 *             laid out, with one octree for all instances.
 * Loose       Faces that are in no tree, or that the eye grazes
 *             (common/trees/bsp.h), come first. They are compared in depth. */
#ifndef HSR_ALGORITHMS_BOUNDED_STRICT_H
#define HSR_ALGORITHMS_BOUNDED_STRICT_H

#include "algorithms/hierarchical/bounded/bounded.h"
#include "common/trees/bsp.h"
#include "common/trees/octree.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What is made once for all views. */
struct hsr_strict {
  struct hsr_scene scene;
  struct hsr_world own; /* the scene laid out, if the given world is not */
  const struct hsr_world *world; /* the one that is laid out */
  struct hsr_bsp bsp;
  uint64_t *within; /* by cube: how many pieces are in it and its octants */
  struct hsr_arena arena;
};

/* Makes the octree of BSP trees of a world, which is borrowed as long as
 * *strict. *strict is freed with hsr_strict_free, also after a failure.
 * HSR_E_NOMEM; HSR_E_REFUSED if a face is not convex, or there are too many. */
enum hsr_status hsr_strict_init(struct hsr_strict *strict,
                                const struct hsr_world *world,
                                struct hsr_error *err);
void hsr_strict_free(struct hsr_strict *strict);

/* The tiling pass of one view: what the caller sets, and its state. */
struct hsr_strict_walk {
  const struct hsr_strict *strict;
  struct hsr_bounded_tree *tree;
  /* CouldCubeBeVisible of the thesis; n pieces are in the cube. */
  bool (*could_be_visible)(void *context, const struct hsr_octree_box *cube,
                           uint64_t n, struct hsr_subject subject);
  /* Called for a cube that is left out since the time has ended. False: out
   * of memory. */
  bool (*leave)(void *context, const struct hsr_octree_box *cube);
  void *context;

  /* Set by hsr_strict_tile. */
  struct hsr_screen screen;
  bool *is_loose;          /* by face */
  struct hsr_subject cube; /* the one that was tested last */
  bool failed;
};

/* Puts all pieces that may be seen into the quadtree. HSR_E_NOMEM. */
enum hsr_status hsr_strict_tile(struct hsr_strict_walk *walk);

#ifdef __cplusplus
}
#endif
#endif
