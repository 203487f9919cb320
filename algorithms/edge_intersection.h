/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the edge-intersection algorithms share: contour edges, the network of
 * edges along which visibility is promoted, the invisibility correction, and
 * the sort along an edge.
 *
 * Source      Sutherland et al. 1974, "Edge-Intersection Algorithms"; A. Appel,
 *             "The Notion of Quantitative Invisibility and the Machine
 *             Rendering of Solids", Proc. ACM National Conference, 1967.
 * Notation    relevant edge -> an edge with something in the picture;
 *             contour edge -> contour[]: more of its faces lie on one side of
 *             its image than on the other, by net[]; quantitative invisibility
 *             of a vertex -> known[] and invisibility[]; cluster -> the edges
 *             that one search of all faces was enough for
 * Invariant   the invisibility of a vertex counts the faces that hide it,
 *             displaced, those that have a corner there left out: it is the
 * same for all edges that end there. That of an edge's beginning adds those,
 * each as it hides this edge: the invisibility correction. Along the edge it
 * changes at contour edges, and at faces that the edge pierces, and nowhere
 * else. Ties        crossings that fall together happen at once Departures
 * edges may pierce faces, and implied edges are drawn: the papers' environments
 * have neither. A face in whose plane an edge lies is counted like any other
 * along the edge, displaced as this is, and taken away at the end. Faces that
 * are not flat, or cut by the near plane, are added at the end, each for
 * itself. Crossings are compared at once with all contour edges, none being
 * sorted out before but by minimax: what the papers do. Cost        Table III:
 * back and contour cull E_t, initial visibility 100 C_t F_r, edge intersection
 * 30 E_s E_c, invisibility correction 30 (2 E_s 3), sort along the edge E_s */
#ifndef HSR_ALGORITHMS_EDGE_INTERSECTION_H
#define HSR_ALGORITHMS_EDGE_INTERSECTION_H

#include "algorithms/algorithm.h"
#include "common/sight.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The image of an edge lies within; all of the plane, if that is not known. */
struct hsr_edge_box {
  double x0, y0, x1, y1;
};

/* What of an edge is in the picture: between two places. */
struct hsr_edge_part {
  bool relevant; /* anything at all */
  struct hsr_sight_event from, to;
};

struct hsr_network {
  const struct hsr_job *job;
  const struct hsr_edges *edges;
  struct hsr_tally *tally;
  struct hsr_sight sight;

  int *net; /* an edge: how many more faces hide what lies on
               its positive side (hsr_sight_side) than on its
               negative one */
  uint32_t *contour, n_contour;
  struct hsr_edge_box *box;   /* an edge */
  struct hsr_edge_part *part; /* an edge */
  bool *drawn;                /* an edge: done */

  bool *known;                  /* a point */
  int64_t *invisibility;        /* a point, where known */
  uint32_t *waiting, n_waiting; /* vertices to be promoted from */
  uint32_t n_clusters;          /* searches of all faces so far */

  struct hsr_growing events; /* along the current edge */
};

/* What one of the algorithms does its own way. */
struct hsr_intersector {
  /* Appends to network->events, by hsr_network_cross, the crossings of
   * A'B' with nearer contour edges that share no vertex with e. HSR_E_NOMEM. */
  enum hsr_status (*cross)(void *context, struct hsr_network *network,
                           uint32_t e);
  void *context;
  bool visible_only; /* where nothing can be visible along an edge, it is drawn
                        as hidden once, and nothing is sorted */
};

/* Compiled twice, as the algorithms are. */
#define hsr_network_prepare HSR_OF_BUILD(hsr_network_prepare)
#define hsr_network_release HSR_OF_BUILD(hsr_network_release)
#define hsr_network_init HSR_OF_BUILD(hsr_network_init)
#define hsr_network_cross HSR_OF_BUILD(hsr_network_cross)
#define hsr_network_draw HSR_OF_BUILD(hsr_network_draw)
#define hsr_network_render HSR_OF_BUILD(hsr_network_render)
#define hsr_network_expense HSR_OF_BUILD(hsr_network_expense)

/* `prepare` and `release` of these algorithms: the edges of the world. */
enum hsr_status hsr_network_prepare(const struct hsr_world *world,
                                    void **prepared, struct hsr_error *err);
void hsr_network_release(void *prepared);

/* A sight, the cull of edges, and memory from job->scratch. network->sight is
 * freed with hsr_sight_free, also after a failure. HSR_E_NOMEM. */
enum hsr_status hsr_network_init(struct hsr_network *network,
                                 const struct hsr_job *job);

/* A'B' crosses contour edge c, which is nearer: an event. HSR_E_NOMEM. */
enum hsr_status hsr_network_cross(struct hsr_network *network, uint32_t e,
                                  uint32_t c);

/* Draws all relevant edges, promoting invisibility from vertex to vertex, into
 * job->drawing. HSR_E_NOMEM. */
enum hsr_status hsr_network_draw(struct hsr_network *network,
                                 const struct hsr_intersector *intersector);

/* `render` of an algorithm that needs no more than the above. */
enum hsr_status hsr_network_render(const struct hsr_job *job,
                                   const struct hsr_intersector *intersector,
                                   struct hsr_error *err);

/* Whether edges e and c share a vertex. */
static inline bool hsr_edges_meet(const struct hsr_edges *edges, uint32_t e,
                                  uint32_t c) {
  uint32_t a = edges->a[e], b = edges->b[e];
  return a == edges->a[c] || a == edges->b[c] || b == edges->a[c] ||
         b == edges->b[c];
}

static inline bool hsr_boxes_overlap(const struct hsr_edge_box *a,
                                     const struct hsr_edge_box *b) {
  return a->x0 <= b->x1 && b->x0 <= a->x1 && a->y0 <= b->y1 && b->y0 <= a->y1;
}

/* The counters that these keep, in their order; an algorithm's own begin at
 * HSR_N_NETWORK_COUNTERS. */
enum {
  HSR_EDGE_CULL,
  HSR_INITIAL,
  HSR_INTERSECT,
  HSR_CORRECT,
  HSR_SORT_ALONG,
  HSR_SEARCHES,
  HSR_CROSSINGS,
  HSR_PIERCED,
  HSR_SAVED,
  HSR_APART,
  HSR_N_NETWORK_COUNTERS
};
#define HSR_NETWORK_COUNTERS                                                   \
  {"edge cull", "sides of faces looked at for relevant and contour edges"},    \
      {"initial visibility", "faces put to a vertex in the searches"},         \
      {"edge intersection", "pairs of edges that were compared"},              \
      {"correction", "faces with a corner at an edge's end put to the edge"},  \
      {"sort along edge", "comparisons of places along an edge"},              \
      {"searches", "searches of all faces: clusters"},                         \
      {"crossings", "nearer contour edges that an edge crosses"},              \
      {"pierced faces", "faces put to an edge that touches them"},             \
      {"sorts to save", "edges that cannot be visible anywhere"}, {            \
    "faces apart", "faces in whose plane an edge lies, and loose ones"         \
  }

#define HSR_NETWORK_STEPS                                                      \
  {"back and contour cull", HSR_EDGE_CULL, 1, "E_t", hsr_predict_edge_cull},   \
      {"initial visibility", HSR_INITIAL, 100, "100 C_t F_r",                  \
       hsr_predict_initial},                                                   \
      {"edge intersection", HSR_INTERSECT, 30, "30 E_s E_c",                   \
       hsr_predict_intersection},                                              \
      {"invisibility correction", HSR_CORRECT, 30, "30 (2 E_s 3)",             \
       hsr_predict_correction},                                                \
  {                                                                            \
    "sort along edge", HSR_SORT_ALONG, 1, "E_s", hsr_predict_sort_along        \
  }

static inline double hsr_predict_edge_cull(const struct hsr_table1 *t) {
  return t->E_t;
}
static inline double hsr_predict_initial(const struct hsr_table1 *t) {
  return 100 * t->C_t * t->F_r;
}
static inline double hsr_predict_intersection(const struct hsr_table1 *t) {
  return 30 * t->E_s * t->E_c;
}
static inline double hsr_predict_correction(const struct hsr_table1 *t) {
  return 30 * 2 * t->E_s * 3;
}
static inline double hsr_predict_sort_along(const struct hsr_table1 *t) {
  return t->E_s;
}

#ifdef __cplusplus
}
#endif
#endif
