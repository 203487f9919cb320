/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cells and portals: space divided along the large walls of a scene, and the
 * openings between.
 *
 * Source      J. Airey, J. Rohlf and F. Brooks, "Towards image realism with
 *             interactive update rates in complex virtual building
 *             environments", I3D 1990; S. Teller and C. Sequin, "Visibility
 *             preprocessing for interactive walkthroughs", SIGGRAPH 1991; as
 *             told by N. Greene, PhD thesis, UC Santa Cruz, 1995, 2.1.6.
 * Wall        a face that is exactly a rectangle along two axes, and is seen
 *             from both sides; or two triangles, one after the other, that are
 *             such a rectangle together
 * Cell        a leaf of a k-d tree, whose planes are those of walls. The cells
 *             hold all of space: the outer ones are infinite.
 * Portal      a rectangle on the plane between two cells, of which no wall
 *             covers the inside. Rectangles are closed, and their bounds are
 *             coordinates of vertices: so all is exact.
 * Invariant   a ray that goes from one cell to another, and meets no wall on
 *             the plane between them, goes through a portal of theirs.
 * Limits      a plane is taken if walls cover a certain part of it; if there
 *             are too many walls on one, the last are not cut out, and the
 *             portals are larger. */
#ifndef HSR_ALGORITHMS_PORTALS_H
#define HSR_ALGORITHMS_PORTALS_H

#include "common/base/arena.h"
#include "common/scene/world.h"
#include "common/trees/box.h"

/* A rectangle across an axis; lo[axis] and hi[axis] are where. */
struct hsr_portal {
  struct hsr_box box;
  int axis;
  uint32_t cell[2]; /* below it, and above it along the axis */
};

/* A node of the k-d tree. */
struct hsr_portal_node {
  int axis; /* -1: it is a cell */
  double at;
  uint32_t child[2]; /* below and above */
  uint32_t cell;
};

struct hsr_portals {
  struct hsr_portal_node *node; /* the first is the root */
  struct hsr_box *cell;         /* infinite at the outside */
  struct hsr_portal *portal;
  uint32_t n_nodes, n_cells, n_portals;
  uint32_t
      *first_portal;    /* a cell: of_cell[first_portal[c]] and so on; n + 1 */
  uint32_t *of_cell;    /* portals */
  uint32_t *first_face; /* a cell: face[first_face[c]] and so on; n + 1 */
  uint32_t *face;       /* those whose boxes meet the cell */
  uint32_t *loose;      /* faces that are not flat: in no cell */
  uint32_t n_loose;
  struct hsr_arena arena;
};

/* `world` is laid out. *portals is freed with hsr_portals_free also after a
 * failure: HSR_E_NOMEM. */
enum hsr_status hsr_portals_init(struct hsr_portals *portals,
                                 const struct hsr_world *world);
void hsr_portals_free(struct hsr_portals *portals);

/* Calls `visit` for each cell that the closed box meets. */
void hsr_portals_find(const struct hsr_portals *portals,
                      const struct hsr_box *box,
                      void (*visit)(void *context, uint32_t cell),
                      void *context);

#endif
