/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Boxes against convex polyhedra and polygons.
 *
 * Source      N. Greene, "Detecting Intersection of a Rectangular Solid and a
 *             Convex Polyhedron", Graphics Gems IV, 1994; appendix A of his
 *             thesis, "Hierarchical Rendering of Complex Environments", UC
 *             Santa Cruz, 1995.
 * Notation    box R -> struct hsr_box; polyhedron P -> struct hsr_polyhedron;
 *             n-vertex -> the corner of R that lies farthest against a normal,
 *             p-vertex -> the corner farthest along it; edge-lines -> line[].
 * Touching    counts as meeting, and as being cut.
 * Certain     if the answer is that a box is OUT, or IN, or on the inner side
 *             of a plane, or does not meet a polygon, that is so in exact
 *             arithmetic. Where rounding leaves a doubt, the answer is PARTIAL,
 *             or that the box is cut, or meets. The proofs are in box.c.
 *
 * All coordinates are finite and at most 1e30 in size, like those of a scene,
 * and no box has a lo above its hi. Nothing here allocates or fails. */
#ifndef HSR_COMMON_BOX_H
#define HSR_COMMON_BOX_H

#include "common/scene/world.h"
#include "common/view/view.h"

#include <math.h>

#ifdef __cplusplus
extern "C" {
#endif

/* An axis-aligned box, closed. */
struct hsr_box {
  double lo[3], hi[3];
};

static inline double hsr_longest_side(const struct hsr_box *box) {
  return fmax(box->hi[0] - box->lo[0],
              fmax(box->hi[1] - box->lo[1], box->hi[2] - box->lo[2]));
}

static inline bool hsr_boxes_meet(const struct hsr_box *a,
                                  const struct hsr_box *b) {
  return a->lo[0] <= b->hi[0] && b->lo[0] <= a->hi[0] && a->lo[1] <= b->hi[1] &&
         b->lo[1] <= a->hi[1] && a->lo[2] <= b->hi[2] && b->lo[2] <= a->hi[2];
}

/* Whether box `a` holds all of `b`. */
static inline bool hsr_box_holds(const struct hsr_box *a,
                                 const struct hsr_box *b) {
  return a->lo[0] <= b->lo[0] && b->hi[0] <= a->hi[0] && a->lo[1] <= b->lo[1] &&
         b->hi[1] <= a->hi[1] && a->lo[2] <= b->lo[2] && b->hi[2] <= a->hi[2];
}

#define HSR_POLYHEDRON_FACES 8
#define HSR_POLYHEDRON_VERTICES 12 /* 2 F - 4, all that F faces can have */
#define HSR_POLYHEDRON_LINES 36    /* as many in each of the three views */

/* A half space that holds all of the polyhedron: normal . X <= outer. `doubt`
 * times the size of the coordinates bounds the rounding. The n-vertex of a box
 * has the coordinate lo[k] where n[k] is 0 and hi[k] where it is 1; the
 * p-vertex is the opposite one. */
struct hsr_half_space {
  double normal[3], outer, doubt;
  unsigned char n[3];
};

/* A convex polyhedron, prepared for tests against boxes. */
struct hsr_polyhedron {
  struct hsr_box bounds;
  double size; /* the largest coordinate of its bounds */

  /* The face-planes, with outward normals. X is on the inner side if
   * normal . X < inner by more than inner_doubt times the size of the
   * coordinates. */
  int n_planes;
  struct hsr_half_space plane[HSR_POLYHEDRON_FACES];
  double inner[HSR_POLYHEDRON_FACES], inner_doubt[HSR_POLYHEDRON_FACES];

  /* The edge-lines of the silhouettes in the three axis views, as planes
   * parallel to the axis of the view. */
  int n_lines;
  struct hsr_half_space line[HSR_POLYHEDRON_LINES];
};

/* Prepares the convex hull of n_vertices points, xyz[3 v], ... Its faces are
 * vertex[start[f]], ..., vertex[start[f+1] - 1]: they are convex, may go round
 * either way, and form a closed surface. All arrays are copied. radius[v]
 * bounds the error of each coordinate of vertex v (NULL: no errors); the
 * polyhedron is then that of the true vertices. Radii are for rounding: if they
 * are not small beside the polyhedron, boxes are seldom IN. */
void hsr_polyhedron_init(struct hsr_polyhedron *poly, int n_vertices,
                         const double *xyz, const double *radius, int n_faces,
                         const int *start, const int *vertex);

/* The numbers of a frustum's planes. */
enum hsr_frustum_plane {
  HSR_FRUSTUM_TOP,
  HSR_FRUSTUM_RIGHT,
  HSR_FRUSTUM_BOTTOM,
  HSR_FRUSTUM_LEFT,
  HSR_FRUSTUM_FAR,
  HSR_FRUSTUM_NEAR /* there is none if near is 0, but in parallel */
};

/* The frustum of the view's window: all points of rays, near <= t <= far, for
 * screen points within half a pixel of the window's samples. So what is OUT of
 * it cannot be seen in the window up to depth far, wherever the samples are
 * displaced to. All samples that see something that is IN it are in the window.
 * If near is 0, it is a pyramid with the eye as its apex, and has five planes;
 * in parallel it is a box with six. far > near, in world units; the window is
 * not empty. */
void hsr_frustum_init(struct hsr_polyhedron *poly, const struct hsr_view *view,
                      double far);

enum hsr_box_verdict { HSR_BOX_OUT, HSR_BOX_PARTIAL, HSR_BOX_IN };

/* How many inequalities were evaluated. deciding: those that decide whether R
 * and P meet, which is Greene's measure: 1 to 6 + F + E for a box. refining:
 * those that tell whether R holds the bounds of P, and those of the p-vertices:
 * at most 6 + F more. */
struct hsr_box_work {
  unsigned deciding, refining;
};

/* Listing A.1. Sets bit f of *cut for every plane f that the box may cut; it is
 * on the inner side of all others. *cut is 0 if IN, and meaningless if OUT.
 * Adds to *work. `cut` and `work` may be NULL. */
enum hsr_box_verdict hsr_box_classify(const struct hsr_polyhedron *poly,
                                      const struct hsr_box *box, unsigned *cut,
                                      struct hsr_box_work *work);

/* Eight boxes, by columns. size[o] is the largest coordinate of box o. */
struct hsr_eight_boxes {
  double lo[3][8], hi[3][8], size[8];
};
void hsr_put_box(struct hsr_eight_boxes *boxes, int o,
                 const struct hsr_box *box);

/* Which of eight boxes meet a planar convex polygon, bit o for box o: section
 * A.4, last paragraph. `normal` may have any length and may be rounded; seen
 * from its side, the corners go counterclockwise. If the polygon is not convex,
 * each box that meets its convex hull is said to meet it, and perhaps more. The
 * polygon may leave that hull, because its corners were rounded or its plane
 * does not pass through all of them: but no point of it may be farther than
 * `slack` (world units) from the hull in any coordinate. */
unsigned hsr_boxes_that_meet_polygon(const struct hsr_eight_boxes *boxes,
                                     struct hsr_loop polygon,
                                     const double normal[3], double slack);

#ifdef __cplusplus
}
#endif
#endif
