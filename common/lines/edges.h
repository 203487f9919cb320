/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The edges of a world, for hidden-line algorithms: what does not depend on the
 * view.
 *
 * Source      Sutherland et al. 1974, "Object Descriptions" (shared edges),
 *             "Object-Space Algorithms"; docs/correct-drawing.md.
 * Points      0 .. world->n_vertices - 1 are the world's vertices; the others
 *             are the ends of implied edges, which are no doubles: exact ones
 *             stand in exact_points.h, here are rounded ones.
 * Sides       the faces that an edge bounds, in any number.
 * Touched     faces that an edge may meet between its ends or there, its sides
 *             apart, and apart from faces of which it meets only a common
 *             vertex. So no other faces are pierced by it. */
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

/* Where face `face` has its corner k: at world->vertex[k]. */
struct hsr_corner {
  uint32_t face, k;
};

struct hsr_edges {
  const struct hsr_world *world; /* borrowed */

  /* Edges, in the order of drawings; [0, n_real) are sides of faces, the others
   * implied. From point a to point b. */
  uint32_t n, n_real;
  struct hsr_edge_name *name; /* n */
  uint32_t *a, *b;            /* n */
  uint32_t *side_start;       /* n + 1 */
  struct hsr_side *side;
  uint32_t *touch_start; /* n + 1 */
  struct hsr_touch *touch;

  /* Vertices: the real edges that end there, and the corners there. */
  uint32_t *end_start; /* n_vertices + 1 */
  uint32_t *end;
  uint32_t *corner_start; /* n_vertices + 1 */
  struct hsr_corner *corner;

  /* A face: it is flat, and its sides meet at its corners only. */
  bool *simple; /* n_faces */

  uint32_t n_points;
  double *x, *y, *z; /* n_points: exact for vertices, else rounded */

  struct hsr_exact_points *exact; /* of the points that are no vertices */
  struct hsr_arena arena;         /* holds the arrays */
};

/* Finds the edges of a world, which is borrowed and outlives them. Freed with
 * hsr_edges_free, also after a failure. HSR_E_NOMEM. */
enum hsr_status hsr_edges_init(struct hsr_edges *edges,
                               const struct hsr_world *world,
                               struct hsr_error *err);
void hsr_edges_free(struct hsr_edges *edges);

/* Point t of an edge, rounded. */
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
