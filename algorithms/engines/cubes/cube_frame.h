/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One view of a scene in cubes: what every algorithm needs that goes through
 * the octree of octrees.
 *
 * Source      N. Greene, PhD thesis, UC Santa Cruz, 1995, 3.3.1, 3.5 and
 *             appendix A.
 * Notation    a placing is how an instance takes its object to the world and to
 *             the screen. The cubes of the octree of instances are placed as
 *             they are. One cell at a time is laid out, of the instance at
 *             hand.
 * Invariant   if a cube is outside of the frustum, then so are all faces that
 *             it holds; if it has an image, they lie within it. That is true of
 *             the faces as they are rounded, but not of loose ones; the proof
 *             is in cube_frame.c. */
#ifndef HSR_ALGORITHMS_CUBE_FRAME_H
#define HSR_ALGORITHMS_CUBE_FRAME_H

#include "algorithms/engines/tiler/tiler.h"
#include "algorithms/engines/cubes/cubes.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_placing {
  double m[12];   /* as in hsr_instance */
  double grow[3]; /* in the world, for what is rounded */
  struct hsr_way_to_screen way;
  double least; /* w of what is safely before the eye; in parallel t, if the
                   cube's corners are certain on the screen */
  double eye[3], slack; /* C in the object's coordinates, within slack; NaN: the
                           instance is flat, and has no such. In parallel it is
                           infinite or NaN: NaN where F is uncertain */
  double across[3]
               [3]; /* what a ray D, from the eye, gains in coordinate k while
                       its t grows by 1: across[k] (1, sx, sy), within */
  double across_error[3];

  /* In parallel: coordinate k of the point at t on the ray P + t F is from[k] +
   * across[k] (1, sx, sy) + along[k] t, with errors of slack, across_error[k]
   * and along_error[k] t. */
  double from[3], along[3], along_error[3];
};

/* The corners of a cube on the screen: corner o as octant o. */
struct hsr_cube_image {
  double x[8], y[8]; /* within HSR_CUBE_MARGIN, or far outside any picture */
  float q[8];        /* none is less than the truth */
  float nearest;     /* the largest */
  unsigned front;    /* sides that may face the eye: bit k the one below in
                        coordinate k, bit k + 3 the one above */
};
#define HSR_CUBE_MARGIN 0.125 /* pixels */

struct hsr_cube_frame {
  const struct hsr_job *job;
  const struct hsr_cubes *cubes;
  struct hsr_polyhedron frustum;
  struct hsr_placing as_it_is; /* of the cubes of instances */
  struct hsr_tiler tiler;
  double range;           /* of the depths, in parallel: as in tiler.c */
  struct hsr_world world; /* of the cell at hand */
  struct hsr_pair pair;
  bool *two_sided, *one_sided; /* of all faces of a cell */
  uint32_t *met;               /* instances, a bit each */

  /* The instance at hand. */
  uint32_t instance;
  struct hsr_placing placing;
  const struct hsr_cubes_object *object;
  const struct hsr_cell *cell; /* of it, the one at hand */
};

/* Makes a frame ready for job->view's window. The tiler's memory of depths is
 * left to the caller. HSR_E_NOMEM. */
enum hsr_status hsr_cube_frame_begin(struct hsr_cube_frame *frame,
                                     const struct hsr_job *job,
                                     const struct hsr_cubes *cubes);

/* Makes a tiler of the scene's loose faces, when the frame's tiler has its
 * memory. The relevant faces of its screen are to be tiled the general way,
 * before any cell. HSR_E_NOMEM. */
enum hsr_status hsr_cube_loose(const struct hsr_cube_frame *frame,
                               struct hsr_tiler *tiler);

/* Is an instance met for the first time? It may be in several cubes. */
bool hsr_cube_is_new(struct hsr_cube_frame *frame, uint32_t instance);

/* Makes an instance the one at hand. */
void hsr_cube_instance(struct hsr_cube_frame *frame, uint32_t instance);

/* Where a cube lies, as of hsr_box_classify. Each of the inequalities of appendix
 * A that decide it is a step: the last one decides that the cube is outside, if it
 * is. */
extern const struct hsr_part hsr_inequalities_part;
enum { HSR_INEQUALITIES = HSR_FIRST_OF(HSR_PART_INEQUALITIES) };
enum hsr_box_verdict hsr_cube_classify(const struct hsr_cube_frame *frame,
                                       const struct hsr_placing *placing,
                                       const struct hsr_octree_box *box,
                                       struct hsr_subject cube);

/* A cube as a subject: node number, of an octree of faces the instance, which
 * is HSR_NO_ID in the octree of instances. */
static inline struct hsr_subject hsr_cube_subject(uint32_t instance,
                                                  uint32_t node) {
  return HSR_CELL(node, instance, 0);
}

/* The image of a cube. False if it has none: it is not safely before the eye
 * and past near. */
bool hsr_cube_project(const struct hsr_cube_frame *frame,
                      const struct hsr_placing *placing,
                      const struct hsr_octree_box *box,
                      struct hsr_cube_image *image);

/* The corners of side k of a cube, in order around it. */
extern const unsigned char hsr_cube_side[6][4];

/* The samples of the window that a side, or a cube, may cover: false if there
 * are none. */
bool hsr_cube_bounds(const struct hsr_cube_frame *frame,
                     const struct hsr_cube_image *image,
                     const unsigned char *corner, int n_corners,
                     struct hsr_bounds *bounds);

/* The tiler's q on side k of a cube, linear on the screen: q = c + a sx + b sy,
 * and nowhere in the picture less than the truth. Where too little is known of
 * it, it is the same all over: the image's nearest. */
struct hsr_side_depth {
  double a, b, c;
};
struct hsr_side_depth hsr_cube_side_depth(const struct hsr_cube_frame *frame,
                                          const struct hsr_placing *placing,
                                          const struct hsr_octree_box *box,
                                          const struct hsr_cube_image *image,
                                          int side);

/* The octant of a cube that is nearest to the eye. */
int hsr_cube_nearest(const struct hsr_placing *placing,
                     const struct hsr_octree_node *node);

/* Lays out cell `place` of the object at hand. Then faces 0 .. n-1 of
 * frame->world are those of the cell, and the tiler is ready for them. */
const struct hsr_cell *hsr_cube_cell(struct hsr_cube_frame *frame,
                                     uint32_t place);

#ifdef __cplusplus
}
#endif
#endif
