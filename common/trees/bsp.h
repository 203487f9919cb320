/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Octrees of BSP trees: the pieces of faces in an order for every eye.
 *
 * Source      H. Fuchs, Z. Kedem and B. Naylor, "On Visible Surface Generation
 *             by A Priori Tree Structures", SIGGRAPH 1980; N. Greene,
 *             "Hierarchical Polygon Tiling with Coverage Masks", SIGGRAPH 1996,
 *             5.1; N. Greene, PhD thesis, UC Santa Cruz, 1995, 4.6.1.
 * Cubes       a cube of more than a few pieces is divided into its octants, and
 *             its pieces at the three median planes. The pieces of a cube that
 *             is not divided, a leaf, are in a BSP tree.
 * Planes      are numbered. First come the world's plane classes
 *             (common/scene/world.h): each faces the way of the first face that
 *             lies in it. Then come the median planes: their front is where the
 *             coordinate is greater.
 * Pieces      a piece is a face and the sides that bound what is left of it.
 *             Two planes are compared at a sample to tell whether it is within
 *             a side that a cut made. So the pieces of a face share no sample
 *             and leave none out (common/scene/pieces.h).
 * Exact       the side of a plane that a piece lies on is decided exactly. A
 *             piece with points on both sides is divided.
 * Order       what is on the eye's side of a node's plane may hide what is in
 *             the plane, and both may hide what is on the other side. Pieces in
 *             one plane are in ascending order of their faces: the first one
 *             that covers a sample is seen.
 * Ties        a piece in a median plane goes to the lower octant.
 * Not flat    a face that is not flat is seen on its plane, at a place that
 *             depends on the eye: within `reach` of the hull of its vertices,
 *             unless the eye grazes it (hsr_grazes, common/exact/order.h). If
 *             the eye does, the trees cannot order the face. If the face is not
 *             certain to be on one side of a plane, it is cut and goes to both.
 *             If that makes too many pieces of a face, it is loose: in no tree.
 */
#ifndef HSR_COMMON_BSP_H
#define HSR_COMMON_BSP_H

#include "common/base/arena.h"
#include "common/trees/box.h"
#include "common/scene/world.h"

#ifdef __cplusplus
extern "C" {
#endif

#define HSR_NO_BSP UINT32_MAX

/* A corner, and the side from it to the next. The side lies on the edge from
 * vertex a to b of the world; or, if b is one of these two, in plane a, and the
 * piece is in front of that plane, or behind it. */
#define HSR_BSP_FRONT UINT32_MAX
#define HSR_BSP_BEHIND (UINT32_MAX - 1)
struct hsr_bsp_corner {
  uint32_t point; /* x[point], y[point], z[point] */
  uint32_t a, b;
};

/* A piece of a flat face is a convex polygon. A piece of a face that is not
 * flat keeps all corners of the face, however it is cut, and has n_cuts cuts
 * beside them, written as sides are. */
struct hsr_bsp_piece {
  uint32_t face; /* of the world */
  uint32_t first_corner, n_corners;
  uint32_t first_cut, n_cuts; /* 0 cuts if the face is flat: they are sides */
  int16_t turned;    /* the face: +1 as its plane is, -1 the other way */
  int16_t one_sided; /* the face: 1 or 0 */
};

struct hsr_bsp_node {
  uint32_t plane;                 /* a plane class of the world */
  uint32_t front, behind;         /* nodes, or HSR_NO_BSP */
  uint32_t first_piece, n_pieces; /* in the plane */
  /* A plane that lies across an axis: coordinate `axis` = at. Its front is where
   * the coordinate is greater (level +1) or less (-1). level 0: it does not lie
   * across an axis. */
  int16_t axis, level;
  double at;
};

struct hsr_bsp_cube {
  double centre[3], half;
  struct hsr_box tight; /* within it, holds all that is in it; empty: lo > hi */
  uint32_t child[8];    /* bit k of the octant's number: above centre[k];
                           HSR_NO_BSP: none, or nothing in it */
  uint32_t root;        /* of a leaf: its BSP tree; HSR_NO_BSP: no piece */
  uint32_t first_point, n_points; /* of a leaf: those of its pieces */
  uint32_t most_corners;          /* of a leaf: the most that a piece has */
};

/* A median plane: plane n_planes + k of a world is median[k]. */
struct hsr_bsp_median {
  int axis;
  double at;
};

struct hsr_bsp {
  const struct hsr_world *world;
  struct hsr_bsp_cube *cube; /* at least one: the root; parents first */
  struct hsr_bsp_node *node;
  struct hsr_bsp_piece *piece;
  struct hsr_bsp_corner *corner;
  struct hsr_bsp_corner *cut; /* .point is unused */
  double *x, *y, *z;          /* points */
  double *error;              /* of each of a point's coordinates; 0: it is
                                 a vertex of the world */
  struct hsr_bsp_median *median;
  uint32_t *face_of; /* a plane class: the first face in it, which turns it */
  double *reach;     /* a face; 0: it is flat */
  uint32_t *loose;   /* faces that are in no tree, ascending */
  uint32_t n_cubes, n_nodes, n_pieces, n_corners, n_cuts, n_points, n_medians,
      n_loose;
  uint32_t most_depth; /* nodes on the longest path down a tree */
  struct hsr_arena arena;
};

#define HSR_BSP_MOST_PIECES (UINT32_C(1) << 22)
struct hsr_bsp_rule {
  uint32_t most; /* a cube of more pieces is divided, unless that would make too
                    many; 0: no cube is, and there is one BSP tree */
  uint32_t most_pieces; /* in all, at most HSR_BSP_MOST_PIECES; 0: that many */
};

/* `world` is laid out, its faces are convex, and it must outlive *bsp. *bsp is
 * freed with hsr_bsp_free, also after a failure. HSR_E_NOMEM; HSR_E_REFUSED if
 * there would be more pieces than the rule allows, or they would take too long. */
enum hsr_status hsr_bsp_init(struct hsr_bsp *bsp, const struct hsr_world *world,
                             const struct hsr_bsp_rule *rule,
                             struct hsr_error *err);
void hsr_bsp_free(struct hsr_bsp *bsp);

#ifdef __cplusplus
}
#endif
#endif
