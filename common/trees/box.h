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
 * Certain     the answers OUT, IN, "on the inner side of a plane" and "does not
 *             meet the polygon" are true in exact arithmetic. If rounding
 *             leaves a doubt, the answer is PARTIAL, "cut" or "meets". The
 *             proofs are in box.c.
 *
 * All coordinates are finite, in world units and at most 1e30 in size, like
 * those of a scene. No box has lo above hi, unless a comment says so. Nothing
 * here allocates or fails. */
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

/* Returns the length of the longest side of a box. */
static inline double hsr_longest_side(const struct hsr_box *box) {
  return fmax(box->hi[0] - box->lo[0],
              fmax(box->hi[1] - box->lo[1], box->hi[2] - box->lo[2]));
}

/* Whether two boxes have a point in common. */
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
#define HSR_POLYHEDRON_VERTICES 12 /* 2 F - 4, the most that F faces can have */
#define HSR_POLYHEDRON_LINES 36    /* so many in each of the three views */

/* A half space that holds all of the polyhedron: normal . X <= outer. `doubt`
 * times the size of the coordinates bounds the rounding error. The n-vertex of
 * a box has the coordinate lo[k] if n[k] is 0 and hi[k] if n[k] is 1. The
 * p-vertex is the opposite corner. */
struct hsr_half_space {
  double normal[3], outer, doubt;
  unsigned char n[3];
};

/* A convex polyhedron, prepared for tests against boxes. */
struct hsr_polyhedron {
  struct hsr_box bounds;
  double size; /* the largest size of a coordinate of its bounds */

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

/* Prepares the convex polyhedron with n_vertices vertices xyz[3v .. 3v+2] and
 * n_faces faces, at most HSR_POLYHEDRON_VERTICES and HSR_POLYHEDRON_FACES. Face
 * f is the convex polygon vertex[start[f]], ..., vertex[start[f+1] - 1], in
 * either orientation. Together the faces form a closed surface. The arrays are
 * not kept. radius[v] bounds the rounding error of each coordinate of vertex v;
 * NULL: there are no errors. Answers are about the polyhedron of the exact
 * vertices. If radii are not small beside the polyhedron, boxes are seldom
 * IN. */
void hsr_polyhedron_init(struct hsr_polyhedron *poly, int n_vertices,
                         const double *xyz, const double *radius, int n_faces,
                         const int *start, const int *vertex);

/* The indices of a frustum's planes in hsr_polyhedron.plane. */
enum hsr_frustum_plane {
  HSR_FRUSTUM_TOP,
  HSR_FRUSTUM_RIGHT,
  HSR_FRUSTUM_BOTTOM,
  HSR_FRUSTUM_LEFT,
  HSR_FRUSTUM_FAR,
  HSR_FRUSTUM_NEAR /* absent in perspective if near is 0 */
};

/* Prepares the frustum of the view's window. It has the points with near <= t
 * <= far on the rays of all screen points within half a pixel of the window's
 * samples. So something that is OUT cannot be seen in the window up to depth
 * far, however the samples are displaced. If something is IN, all samples that
 * see it are in the window. In perspective with near 0, the frustum is a
 * pyramid with the eye as its apex, and has five planes. Else it has six. `far`
 * is above near, in world units. The window must not be empty. */
void hsr_frustum_init(struct hsr_polyhedron *poly, const struct hsr_view *view,
                      double far);

enum hsr_box_verdict { HSR_BOX_OUT, HSR_BOX_PARTIAL, HSR_BOX_IN };

/* Numbers of inequalities that were evaluated.
 * deciding: those that decide whether R and P meet, 1 to 6 + F + E for a box.
 *           This is Greene's measure.
 * refining: those that tell whether R holds the bounds of P, and those of the
 *           p-vertices, at most 6 + F more. */
struct hsr_box_work {
  unsigned deciding, refining;
};

/* Tests a box against a polyhedron, by listing A.1 of the thesis. Returns
 * whether the box is outside, partly inside or inside. Sets bit f of *cut for
 * every plane f that the box may cut; the box is on the inner side of the other
 * planes. *cut is 0 if the box is IN, and is meaningless if it is OUT. The
 * inequalities are added to *work. `cut` and `work` may be NULL. */
enum hsr_box_verdict hsr_box_classify(const struct hsr_polyhedron *poly,
                                      const struct hsr_box *box, unsigned *cut,
                                      struct hsr_box_work *work);

/* Eight boxes, in columns: box o is lo[a][o] .. hi[a][o] along axis a. size[o]
 * is the largest size of its coordinates. */
struct hsr_eight_boxes {
  double lo[3][8], hi[3][8], size[8];
};

/* Makes *box box o, 0 to 7, of the eight. */
void hsr_put_box(struct hsr_eight_boxes *boxes, int o,
                 const struct hsr_box *box);

/* Returns which of eight boxes meet a planar convex polygon, bit o for box o,
 * by the last paragraph of section A.4 of the thesis. `normal` may have any
 * length and may be rounded. Seen from its side, the corners go
 * counterclockwise. If the polygon is not convex, or has more than 64
 * corners, the result has every box that meets its convex hull, and perhaps
 * others. `slack` is for a polygon with
 * points outside the hull of its corners, because these were rounded or the
 * plane does not pass through all of them. No point may be farther than
 * `slack`, in world units, from the hull in any coordinate. */
unsigned hsr_boxes_that_meet_polygon(const struct hsr_eight_boxes *boxes,
                                     struct hsr_loop polygon,
                                     const double normal[3], double slack);

#ifdef __cplusplus
}
#endif
#endif
