/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The edges of a world, for hidden-line algorithms. Nothing here depends on the
 * view.
 *
 * Source      Sutherland et al. 1974, "Object Descriptions" (shared edges),
 *             "Object-Space Algorithms"; docs/correct-drawing.md.
 * Points      0 .. mesh.n_vertices - 1 are the world's vertices. The others are
 *             the ends of implied edges. Their exact coordinates need not be
 *             doubles and are in exact_points.h. Rounded ones are here.
 * Sides       the sides of an edge are the faces that it bounds, any number of
 *             them. (A side of a face is an edge of it.)
 * Touched     the faces that an edge may meet, between its ends or at them. The
 *             sides of the edge are not listed, nor are faces that it meets
 *             only in a common vertex. An edge pierces no other face. */
#ifndef HSR_COMMON_EDGES_H
#define HSR_COMMON_EDGES_H

#include "common/lines/drawing.h"
#include "common/scene/world.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A face on a side of an edge. */
struct hsr_side {
  uint32_t face;
  int turn; /* the direction of the edge among the face's corners: +1 from a to
               b, -1 from b to a; 0 of an implied edge, which runs through the
               face */
};

struct hsr_touch {
  uint32_t face;
  bool in_plane; /* the edge lies in the plane of the face, which is flat */
};

/* A corner of a face: k is an index into world->mesh.vertex. */
struct hsr_corner {
  uint32_t face, k;
};

struct hsr_edges {
  const struct hsr_world *world; /* borrowed */

  /* Edges, in the order of drawings (hsr_edge_name_compare). Edges [0, n_real)
   * are edges of faces, the others are implied. Edge e runs from point a[e] to
   * point b[e]. Its sides are side[side_start[e]], ...,
   * side[side_start[e+1] - 1]. The faces that it touches are in `touch`,
   * likewise. */
  uint32_t n, n_real;
  struct hsr_edge_name *name; /* n */
  uint32_t *a, *b;            /* n */
  uint32_t *side_start;       /* n + 1 */
  struct hsr_side *side;
  uint32_t *touch_start; /* n + 1 */
  struct hsr_touch *touch;

  /* By vertex: the edges of faces that have it as an end, and the corners at
   * it. */
  uint32_t *end_start; /* n_vertices + 1 */
  uint32_t *end;
  uint32_t *corner_start; /* n_vertices + 1 */
  struct hsr_corner *corner;

  /* By face: whether it is flat and its edges meet at its corners only. */
  bool *simple; /* n_faces */

  uint32_t n_points;
  double *x, *y, *z; /* n_points, world units; exact only if vertices */

  struct hsr_exact_points *exact; /* the points that are not vertices; owned */
  struct hsr_arena arena;         /* holds the arrays */
};

/* Finds the edges of a world that is laid out. `world` is borrowed and must
 * outlive *edges. *edges is written in full, and is freed with hsr_edges_free
 * also after a failure. HSR_E_NOMEM. */
enum hsr_status hsr_edges_init(struct hsr_edges *edges,
                               const struct hsr_world *world,
                               struct hsr_error *err);

/* Frees what the edges own. */
void hsr_edges_free(struct hsr_edges *edges);

/* Computes the point at t, 0 to 1, of edge e, in world units, rounded. */
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
