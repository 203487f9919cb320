/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The edges of a world, for hidden-line algorithms. Nothing here depends on the
 * view.
 *
 * Source      Sutherland et al. 1974, "Object Descriptions" (shared edges),
 *             "Object-Space Algorithms"; docs/correct-drawing.md.
 * Points      0 .. mesh.n_vertices - 1 are the world's vertices. The others are
 *             the ends of implied edges. Their coordinates need not be doubles:
 *             the exact ones are in exact_points.h, rounded ones here.
 * Sides       the faces that an edge bounds, in any number.
 * Touched     the faces that an edge may meet, between its ends or at them. Its
 *             sides are left out, and so are faces that it meets only in a
 *             common vertex. So it pierces no face that is not listed. */
#ifndef HSR_COMMON_EDGES_H
#define HSR_COMMON_EDGES_H

#include "common/lines/drawing.h"
#include "common/scene/world.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_side {
  uint32_t face;
  int turn; /* +1: the face runs from a to b; -1: from b to a; 0: the edge is
               implied, and runs through the face */
};

struct hsr_touch {
  uint32_t face;
  bool in_plane; /* the edge lies in the plane of the face, which is flat */
};

/* A corner of face `face`: it is at vertex world->mesh.vertex[k]. */
struct hsr_corner {
  uint32_t face, k;
};

struct hsr_edges {
  const struct hsr_world *world; /* borrowed */

  /* Edges, in the order of drawings. Edges [0, n_real) are sides of faces, the
   * others are implied. Edge e runs from point a[e] to point b[e]; its sides
   * are side[side_start[e]], ..., side[side_start[e+1] - 1]; likewise `touch`.
    */
  uint32_t n, n_real;
  struct hsr_edge_name *name; /* n */
  uint32_t *a, *b;            /* n */
  uint32_t *side_start;       /* n + 1 */
  struct hsr_side *side;
  uint32_t *touch_start; /* n + 1 */
  struct hsr_touch *touch;

  /* For each vertex: the edges of faces that end there, and the corners there.
   */
  uint32_t *end_start; /* n_vertices + 1 */
  uint32_t *end;
  uint32_t *corner_start; /* n_vertices + 1 */
  struct hsr_corner *corner;

  /* Whether a face is flat, and its sides meet at its corners only. */
  bool *simple; /* n_faces */

  uint32_t n_points;
  double *x, *y, *z; /* n_points: exact for vertices, else rounded */

  struct hsr_exact_points *exact; /* the points that are no vertices; owned */
  struct hsr_arena arena;         /* holds the arrays */
};

/* Finds the edges of a world, which is borrowed and outlives them. Freed with
 * hsr_edges_free, also after a failure. HSR_E_NOMEM. */
enum hsr_status hsr_edges_init(struct hsr_edges *edges,
                               const struct hsr_world *world,
                               struct hsr_error *err);
void hsr_edges_free(struct hsr_edges *edges);

/* The point at t, 0 to 1, of an edge; rounded, in world units. */
static inline void hsr_edge_point(const struct hsr_edges *edges, uint32_t e,
                                  double t, double point[3]) {
  uint32_t a = edges->a[e], b = edges->b[e];
  point[0] = edges->x[a] + t * (edges->x[b] - edges->x[a]);
  point[1] = edges->y[a] + t * (edges->y[b] - edges->y[a]);
  point[2] = edges->z[a] + t * (edges->z[b] - edges->z[a]);
}

#ifdef __cplusplus
}
#endif
#endif
