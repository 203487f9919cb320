/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Octrees of BSP trees, which give an order of the faces' pieces for every eye.
 *
 * Source      H. Fuchs, Z. Kedem and B. Naylor, "On Visible Surface Generation
 *             by A Priori Tree Structures", SIGGRAPH 1980; N. Greene,
 *             "Hierarchical Polygon Tiling with Coverage Masks", SIGGRAPH 1996,
 *             5.1; N. Greene, PhD thesis, UC Santa Cruz, 1995, 4.6.1.
 * Cubes       a cube with many pieces is divided into its octants, and its
 *             pieces are divided at the three median planes. A cube that is not
 *             divided is a leaf. Its pieces are in a BSP tree.
 * Planes      the world's plane classes (common/scene/world.h) have the first
 *             numbers. The front of a class is that of the first face in it.
 *             The median planes have the next numbers. Their front is where the
 *             coordinate is greater.
 * Pieces      a piece is a face and the sides that bound it. To decide whether
 *             a sample is within a side that a cut made, the depths of two
 *             planes are compared. So the pieces of a face share no sample and
 *             leave none out (common/scene/pieces.h).
 * Exact       the side of a plane on which a piece lies is decided exactly. A
 *             piece with points on both sides is divided.
 * Order       pieces on the eye's side of a node's plane may hide pieces in the
 *             plane, and both may hide pieces on the other side. Pieces in one
 *             plane are in ascending order of their faces, so the first one
 *             that covers a sample is visible there.
 * Ties        a piece in a median plane goes to the lower octant.
 * Not flat    a face that is not flat is drawn on its plane, at a place that
 *             depends on the eye. That is within `reach` of the hull of its
 *             vertices, unless the eye grazes the face (hsr_grazes,
 *             common/exact/order.h). Then the trees cannot order the face. If
 *             the face is not certain to be on one side of a plane, it is cut
 *             and goes to both sides. A face that would have too many pieces is
 *             loose: it is in no tree. */
#ifndef HSR_COMMON_BSP_H
#define HSR_COMMON_BSP_H

#include "common/base/arena.h"
#include "common/trees/box.h"
#include "common/scene/world.h"

#ifdef __cplusplus
extern "C" {
#endif

#define HSR_NO_BSP UINT32_MAX

/* A corner, and the side from it to the next corner. The side lies on the edge
 * from vertex a to vertex b of the world. If b is HSR_BSP_FRONT or
 * HSR_BSP_BEHIND instead, it lies in plane a, and the piece is in front of that
 * plane or behind it. */
#define HSR_BSP_FRONT UINT32_MAX
#define HSR_BSP_BEHIND (UINT32_MAX - 1)
struct hsr_bsp_corner {
  uint32_t point; /* x[point], y[point], z[point] */
  uint32_t a, b;
};

/* A piece of a flat face is a convex polygon. A piece of a face that is not
 * flat keeps all corners of the face, however it is cut. Its cuts are listed
 * separately, each as the side of a corner is. */
struct hsr_bsp_piece {
  uint32_t face; /* of the world */
  uint32_t first_corner, n_corners;
  uint32_t first_cut, n_cuts; /* 0 cuts if the face is flat */
  int16_t turned;    /* +1 if the front of the face is that of its plane, else
                        -1 */
  int16_t one_sided; /* 1 if the face is one-sided, else 0 */
};

struct hsr_bsp_node {
  uint32_t plane;                 /* a plane class of the world */
  uint32_t front, behind;         /* nodes, or HSR_NO_BSP */
  uint32_t first_piece, n_pieces; /* the pieces in the plane */
  /* level +1 or -1: the plane lies across an axis, where coordinate `axis`
   * equals `at`, and its front is where the coordinate is greater (+1) or less
   * (-1). level 0: the plane does not lie across an axis. */
  int16_t axis, level;
  double at;
};

struct hsr_bsp_cube {
  double centre[3], half; /* half: half of its side; world units */
  struct hsr_box tight;   /* a box within the cube that holds all its pieces; lo
                             > hi if there are none */
  uint32_t child[8];      /* cubes; bit k of the octant's number is set above
                             centre[k]. HSR_NO_BSP: there is no octant, or it is
                             empty */
  uint32_t root;          /* of a leaf: the root node of its BSP tree;
                             HSR_NO_BSP: it has no piece */
  uint32_t first_point, n_points; /* of a leaf: the points of its pieces */
  uint32_t most_corners;          /* of a leaf: the most that a piece has */
};

/* A median plane, where coordinate `axis` equals `at`. Plane n_planes + k is
 * median[k]; n_planes is that of the world's mesh. */
struct hsr_bsp_median {
  int axis;
  double at;
};

/* The arrays are in the arena. */
struct hsr_bsp {
  const struct hsr_world *world; /* borrowed */
  struct hsr_bsp_cube *cube;     /* the first is the root; parents come before
                                    their octants */
  struct hsr_bsp_node *node;
  struct hsr_bsp_piece *piece;
  struct hsr_bsp_corner *corner;
  struct hsr_bsp_corner *cut; /* .point is unused */
  double *x, *y, *z;          /* points, world units */
  double *error;              /* by point: the error of its coordinates; 0: it
                                 is a vertex of the world */
  struct hsr_bsp_median *median;
  uint32_t *face_of; /* by plane class: the first face in it, whose front is the
                        class's front */
  double *reach;     /* by face: see "Not flat"; 0: the face is flat */
  uint32_t *loose;   /* faces that are in no tree, ascending */
  uint32_t n_cubes, n_nodes, n_pieces, n_corners, n_cuts, n_points, n_medians,
      n_loose;
  uint32_t most_depth; /* nodes on the longest path down a tree */
  bool is_octree; /* cubes of too many pieces were to be divided: see the rule.
                     There may be one cube even so */
  struct hsr_arena arena;
};

#define HSR_BSP_MOST_PIECES (UINT32_C(1) << 22)
struct hsr_bsp_rule {
  uint32_t most; /* a cube of more pieces is divided, unless that would make too
                    many pieces. 0: no cube is divided, and there is one BSP
                    tree */
  uint32_t most_pieces; /* the limit of all pieces; 0: HSR_BSP_MOST_PIECES */
};

/* Makes the trees of a world that is laid out and has convex faces. `world` is
 * borrowed and must outlive *bsp. *bsp is written in full, and is freed with
 * hsr_bsp_free also after a failure. HSR_E_NOMEM; HSR_E_REFUSED if there would
 * be more pieces than the rule allows, or the work would be too much;
 * HSR_E_INTERNAL if a library fails. */
enum hsr_status hsr_bsp_init(struct hsr_bsp *bsp, const struct hsr_world *world,
                             const struct hsr_bsp_rule *rule,
                             struct hsr_error *err);

/* Frees what *bsp owns. */
void hsr_bsp_free(struct hsr_bsp *bsp);

#ifdef __cplusplus
}
#endif
#endif
