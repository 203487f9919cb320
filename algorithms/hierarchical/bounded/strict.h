/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The tiling pass in strict order: every polygon before all that it may hide.
 *
 * Source      N. Greene, PhD thesis, UC Santa Cruz, 1995, 5.6 (p. 89): "Tile"
 *             with an octree of BSP trees (4.6.1) in place of an octree.
 * Gained      in depth, no two polygons are compared, nor a polygon with a cell:
 *             a cell that is covered hides all that comes later. Pieces keep the
 *             order in which they came, and where polygons penetrate they are
 *             cut.
 * Lost        pieces are more than faces, and have more lines. The scene is laid
 *             out, with one octree: instances are not shared.
 * Loose       faces that are in no tree, or that the eye grazes
 *             (common/trees/bsp.h), come first. They are compared in depth. */
#ifndef HSR_ALGORITHMS_BOUNDED_STRICT_H
#define HSR_ALGORITHMS_BOUNDED_STRICT_H

#include "algorithms/hierarchical/bounded/bounded.h"
#include "common/trees/bsp.h"
#include "common/trees/octree.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Once for all views. */
struct hsr_strict {
  struct hsr_scene scene;
  struct hsr_world own; /* the scene laid out, if the world was not */
  const struct hsr_world *world;
  struct hsr_bsp bsp;
  uint64_t *within; /* a cube: the pieces in it and its octants */
  struct hsr_arena arena;
};

/* `world` is borrowed. *strict is freed with hsr_strict_free also after a
 * failure: HSR_E_NOMEM; HSR_E_REFUSED where faces are not convex, or too many.
 */
enum hsr_status hsr_strict_init(struct hsr_strict *strict,
                                const struct hsr_world *world,
                                struct hsr_error *err);
void hsr_strict_free(struct hsr_strict *strict);

struct hsr_strict_walk {
  const struct hsr_strict *strict;
  struct hsr_bounded_tree *tree;
  /* CouldCubeBeVisible; n pieces are in the cube. */
  bool (*could_be_visible)(void *context, const struct hsr_octree_box *cube,
                           uint64_t n, struct hsr_subject subject);
  /* The time has ended before the cube. False if memory ran out. */
  bool (*leave)(void *context, const struct hsr_octree_box *cube);
  void *context;

  /* Of hsr_strict_tile. */
  struct hsr_screen screen;
  bool *is_loose;          /* a face */
  struct hsr_subject cube; /* at hand */
  bool failed;
};

/* Puts all that may be seen into the tree. HSR_E_NOMEM. */
enum hsr_status hsr_strict_tile(struct hsr_strict_walk *walk);

#ifdef __cplusplus
}
#endif
#endif
