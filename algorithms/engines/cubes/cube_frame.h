/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One view of a scene in cubes (cubes.h): what every algorithm needs that
 * traverses the octree of octrees.
 *
 * Source      N. Greene, PhD thesis, UC Santa Cruz, 1995, 3.3.1, 3.5 and
 *             appendix A.
 * Notation    Placing: how an instance takes its object to the world and to the
 *             screen. The octree of instances is in the world already: its
 *             cubes have the placing as_it_is. One instance at a time is the
 *             current one, and of it one cell at a time is laid out in the
 *             world.
 * Invariant   If a cube is outside of the frustum, so are all faces that it
 *             holds. If it has an image, they lie within that. This is true of
 *             the faces as they are rounded, but not of loose ones. The proof
 *             is in cube_frame.c. */
#ifndef HSR_ALGORITHMS_CUBE_FRAME_H
#define HSR_ALGORITHMS_CUBE_FRAME_H

#include "algorithms/engines/tiler/tiler.h"
#include "algorithms/engines/cubes/cubes.h"

#ifdef __cplusplus
extern "C" {
#endif

/* "Parallel" below is parallel projection. */
struct hsr_placing {
  double m[12];   /* as in hsr_instance */
  double grow[3]; /* by how much a box in the world is enlarged along each axis,
                     for what is rounded */
  struct hsr_way_to_screen way;

  /* The w from which on a point is safely before the eye. Parallel: the t, if
   * the cube's corners are certain on the screen. */
  double least;

  /* The eye E in the object's coordinates, within slack; NaN: the instance is
   * flat, and there is no such point. Parallel: infinite, or NaN where the
   * direction F is uncertain. */
  double eye[3], slack;

  /* What the ray D of a point of the screen gains in the object's coordinate k
   * while its t grows by 1: across[k] . (1, sx, sy), within across_error[k]. */
  double across[3][3];
  double across_error[3];

  /* Parallel: coordinate k of the point at t on the ray P + t F is from[k] +
   * across[k] . (1, sx, sy) + along[k] t, with errors of slack, across_error[k]
   * and along_error[k] t. */
  double from[3], along[3], along_error[3];
};

/* The image of a cube. Corner o is that of octant o. */
struct hsr_cube_image {
  double x[8], y[8]; /* pixels, within HSR_CUBE_MARGIN; or far outside any
                        picture */
  float q[8];        /* the tiler's depths, never less than the truth */
  float nearest;     /* the largest */
  unsigned front;    /* sides that may face the eye: bit k the one below in
                        coordinate k, bit k + 3 the one above */
};
#define HSR_CUBE_MARGIN 0.125 /* pixels */

/* Convex faces of a cell as triangles, all of a face one after another: the
 * tiler's list for one batch. */
struct hsr_cube_fans {
  uint32_t vertex[3 * HSR_BATCH], face[HSR_BATCH];
  struct hsr_triangle_list list;
};

struct hsr_cube_frame {
  const struct hsr_job *job;     /* borrowed */
  const struct hsr_cubes *cubes; /* borrowed */
  struct hsr_polyhedron frustum;
  struct hsr_placing as_it_is; /* of the cubes of the octree of instances */
  struct hsr_tiler tiler;
  double range;           /* in parallel projection, of the depths: tiler.c */
  struct hsr_world world; /* of the cell that is laid out */
  struct hsr_pair pair;
  /* By face of a cell: all false; all true. */
  bool *two_sided, *one_sided;
  uint32_t *met; /* a bit for each instance that has been met */

  /* The current instance, its object, and the cell of it that is laid out. */
  uint32_t instance;
  struct hsr_placing placing;
  const struct hsr_cubes_object *object;
  const struct hsr_cell *cell;
};

/* Makes a frame ready for the window of job->view. The caller provides the
 * tiler's z, ids and part afterwards. Memory from job->scratch. HSR_E_NOMEM. */
enum hsr_status hsr_cube_frame_begin(struct hsr_cube_frame *frame,
                                     const struct hsr_job *job,
                                     const struct hsr_cubes *cubes);

/* Makes a tiler of the scene's loose faces, which writes to the memory of the
 * frame's tiler. The caller tiles the relevant faces of its screen the general
 * way, before any cell. HSR_E_NOMEM. */
enum hsr_status hsr_cube_loose(const struct hsr_cube_frame *frame,
                               struct hsr_tiler *tiler);

/* Is an instance met for the first time in the frame? From now on it is not. An
 * instance may be in several cubes. */
bool hsr_cube_is_new(struct hsr_cube_frame *frame, uint32_t instance);

/* Makes an instance the current one. */
void hsr_cube_instance(struct hsr_cube_frame *frame, uint32_t instance);

/* Where a cube lies to the frustum, as by hsr_box_classify. Each inequality of
 * appendix A that is evaluated is a step of HSR_INEQUALITIES. If the cube is
 * outside, the last of them has decided it. `cube` is the subject of the
 * steps. */
extern const struct hsr_part hsr_inequalities_part;
enum { HSR_INEQUALITIES = HSR_FIRST_OF(HSR_PART_INEQUALITIES) };
enum hsr_box_verdict hsr_cube_classify(const struct hsr_cube_frame *frame,
                                       const struct hsr_placing *placing,
                                       const struct hsr_octree_box *box,
                                       struct hsr_subject cube);

/* A cube as a subject: the number of its node, and the instance whose octree it
 * is in; HSR_NO_ID: it is in the octree of instances. */
static inline struct hsr_subject hsr_cube_subject(uint32_t instance,
                                                  uint32_t node) {
  return HSR_CELL(node, instance, 0);
}

/* Fills *image with the image of a cube. False if it has none: a part of it may
 * be behind the eye, or before the near plane. */
bool hsr_cube_project(const struct hsr_cube_frame *frame,
                      const struct hsr_placing *placing,
                      const struct hsr_octree_box *box,
                      struct hsr_cube_image *image);

/* The corners of side k of a cube, in order around it. */
extern const unsigned char hsr_cube_side[6][4];

/* The samples of the window that some corners of a cube may span: those of a
 * side, or of the whole cube. False if there are none. */
bool hsr_cube_bounds(const struct hsr_cube_frame *frame,
                     const struct hsr_cube_image *image,
                     const unsigned char *corner, int n_corners,
                     struct hsr_bounds *bounds);

/* The tiler's q on side `side` of a cube, linear on the screen: c + a sx + b
 * sy. It is nowhere in the picture less than the truth. If too little is known
 * of it, it is constant: the image's nearest. */
struct hsr_side_depth {
  double a, b, c;
};
struct hsr_side_depth hsr_cube_side_depth(const struct hsr_cube_frame *frame,
                                          const struct hsr_placing *placing,
                                          const struct hsr_octree_box *box,
                                          const struct hsr_cube_image *image,
                                          int side);

/* The octant of a cube that is nearest to the eye: 0 to 7. */
int hsr_cube_nearest(const struct hsr_placing *placing,
                     const struct hsr_octree_node *node);

/* Lays out the cell of node `place` of the current object, and returns it. Then
 * faces 0 to n_faces - 1 of frame->world are those of the cell, and the tiler
 * is ready for them. */
const struct hsr_cell *hsr_cube_cell(struct hsr_cube_frame *frame,
                                     uint32_t place);

/* Makes triangles of the convex faces of that cell from face f on, up to `end`
 * or as many as a batch holds. They become the tiler's list, which the caller
 * takes off again when they are tiled. Returns the first face left out; *n
 * becomes how many triangles there are. */
uint32_t hsr_cube_fans(struct hsr_cube_frame *frame, struct hsr_cube_fans *fans,
                       uint32_t f, uint32_t end, int *n);

/* If one triangle of a face takes the general way, the whole face does: no other
 * triangle of it is tiled, and only one is HSR_GENERALLY. To be called after
 * hsr_tiler_look, and again after hsr_tiler_set_up. */
void hsr_cube_join_looked_at(const struct hsr_tiler *tiler,
                             struct hsr_batch *batch);
void hsr_cube_join_set_up(struct hsr_batch *batch);

/* The end of the fast triangles of one face, from the k-th on. */
static inline int hsr_cube_fan_end(const struct hsr_batch *b, int k) {
  uint32_t id = b->corners.id[k++];
  while (k < b->n_fast && b->corners.id[k] == id)
    k++;
  return k;
}

#ifdef __cplusplus
}
#endif
#endif
