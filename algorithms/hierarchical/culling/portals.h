/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cells and portals: space is divided into cells along the large walls of a
 * scene; portals are the openings between them.
 *
 * Source      J. Airey, J. Rohlf and F. Brooks, "Towards image realism with
 *             interactive update rates in complex virtual building
 *             environments", I3D 1990; S. Teller and C. Sequin, "Visibility
 *             preprocessing for interactive walkthroughs", SIGGRAPH 1991; as
 *             told by N. Greene, PhD thesis, UC Santa Cruz, 1995, 2.1.6.
 * Wall        A face that is exactly a rectangle along two axes, and is seen
 *             from both sides. Or two triangles, with consecutive numbers, that
 *             are such a rectangle together.
 * Cell        A leaf of a k-d tree whose planes are those of walls. The cells
 *             fill all of space; the outer ones are infinite.
 * Portal      A rectangle on the plane between two cells; no wall covers any of
 *             its inside. Rectangles are closed, and their bounds are
 *             coordinates of vertices, so all is exact.
 * Invariant   A ray that goes from one cell to a neighbouring one, and meets no
 *             wall on the plane between them, goes through a portal of the two.
 * Limits      A plane divides space only if walls cover a certain part of it.
 *             If a plane has too many walls, the last ones are left out, and
 *             portals are larger. */
#ifndef HSR_ALGORITHMS_PORTALS_H
#define HSR_ALGORITHMS_PORTALS_H

#include "common/base/arena.h"
#include "common/scene/world.h"
#include "common/trees/box.h"

/* A rectangle across an axis, in the world; box.lo[axis] equals
 * box.hi[axis]. */
struct hsr_portal {
  struct hsr_box box;
  int axis;
  uint32_t cell[2]; /* the cells below it and above it along the axis */
};

/* A node of the k-d tree. */
struct hsr_portal_node {
  int axis;          /* across which its plane lies; -1: it is a cell */
  double at;         /* the coordinate of the plane */
  uint32_t child[2]; /* nodes below the plane and above it */
  uint32_t cell;     /* if it is a cell: the cell's number */
};

struct hsr_portals {
  struct hsr_portal_node *node; /* the first is the root */
  struct hsr_box *cell;         /* the cells' boxes, perhaps infinite */
  struct hsr_portal *portal;
  uint32_t n_nodes, n_cells, n_portals;
  /* Of cell c: of_cell[first_portal[c]] and so on; n_cells + 1 of them. */
  uint32_t *first_portal;
  uint32_t *of_cell; /* portals of a cell */
  /* Of cell c: face[first_face[c]] and so on; n_cells + 1 of them. */
  uint32_t *first_face;
  uint32_t *face;  /* faces whose boxes meet a cell */
  uint32_t *loose; /* faces that are not flat: they are in no cell */
  uint32_t n_loose;
  struct hsr_arena arena;
};

/* Finds the cells and portals of a world that is laid out; it is not kept.
 * *portals is freed with hsr_portals_free, also after a failure.
 * HSR_E_NOMEM. */
enum hsr_status hsr_portals_init(struct hsr_portals *portals,
                                 const struct hsr_world *world);
void hsr_portals_free(struct hsr_portals *portals);

/* Calls `visit` for each cell that a closed box in the world meets. */
void hsr_portals_find(const struct hsr_portals *portals,
                      const struct hsr_box *box,
                      void (*visit)(void *context, uint32_t cell),
                      void *context);

#endif
