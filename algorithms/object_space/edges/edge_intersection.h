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
 *             same for all edges that end there. That of an edge's beginning
 *             adds those, each as it hides this edge: the invisibility
 *             correction. Along the edge it changes at contour edges, and at
 *             faces that the edge pierces, and nowhere else.
 * Ties        crossings that fall together happen at once
 * Departures  edges may pierce faces, and implied edges are drawn: the papers'
 *             environments have neither. A face in whose plane an edge lies is
 *             counted like any other along the edge, displaced as this is, and
 *             taken away at the end. Faces that are not flat, or cut by the
 *             near plane, are added at the end, each for itself. Crossings are
 *             compared at once with all contour edges, none being sorted out
 *             before but by minimax: what the papers do.
 * Cost        Table III: back and contour cull E_t, initial visibility
 *             100 C_t F_r, edge intersection 30 E_s E_c, invisibility
 *             correction 30 (2 E_s 3), sort along the edge E_s */
#ifndef HSR_ALGORITHMS_EDGE_INTERSECTION_H
#define HSR_ALGORITHMS_EDGE_INTERSECTION_H

#include "algorithms/algorithm.h"
#include "common/lines/sight/sight.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The image of an edge or face lies within; all of the plane, if that is not
 * known. */
struct hsr_image_box {
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
  struct hsr_image_box *box;      /* an edge */
  struct hsr_image_box *face_box; /* a regular face */
  struct hsr_edge_part *part;     /* an edge */
  bool *drawn;                    /* an edge: done */

  bool *known;                  /* a point */
  int64_t *invisibility;        /* a point, where known */
  uint32_t *waiting, n_waiting; /* vertices to be promoted from */

  struct hsr_growing events; /* along the current edge */
};

/* How visibility is promoted from vertex to vertex: in the one way of those
 * that count hiding faces, or in an algorithm's own. What hides the vertex
 * whose turn it is is at hand, where the algorithm keeps it. */
struct hsr_promotion {
  /* The search of all faces: brings what hides point p to hand. HSR_E_NOMEM. */
  enum hsr_status (*search)(void *context, struct hsr_network *network,
                            uint32_t p);
  /* Brings to hand what was left with p: of all that wait, the last to begin.
   */
  void (*resume)(void *context, struct hsr_network *network, uint32_t p);
  /* Draws relevant edge e from its end p, whose turn it is; where
   * hsr_network_wants the other end, leaves what hides that with
   * hsr_network_wait. network->events are empty. HSR_E_NOMEM. */
  enum hsr_status (*follow)(void *context, struct hsr_network *network,
                            uint32_t e, uint32_t p);
  void *context;
};

/* What an algorithm that counts hiding faces does its own way. */
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
#define hsr_network_pierce HSR_OF_BUILD(hsr_network_pierce)
#define hsr_network_sort_along HSR_OF_BUILD(hsr_network_sort_along)
#define hsr_network_interval HSR_OF_BUILD(hsr_network_interval)
#define hsr_network_hides HSR_OF_BUILD(hsr_network_hides)
#define hsr_network_wait HSR_OF_BUILD(hsr_network_wait)
#define hsr_network_promote HSR_OF_BUILD(hsr_network_promote)
#define hsr_network_draw HSR_OF_BUILD(hsr_network_draw)
#define hsr_network_render HSR_OF_BUILD(hsr_network_render)
#define hsr_network_expense HSR_OF_BUILD(hsr_network_expense)

/* `expense` of those that compare every edge with every other: the comparisons
 * of their boxes. About one side of three is that of an edge in the picture. */
double hsr_network_expense(const struct hsr_world *world,
                           const struct hsr_view *view);

/* `prepare` and `release` of these algorithms: the edges of the world. */
enum hsr_status hsr_network_prepare(const struct hsr_world *world,
                                    const long *option, void **prepared,
                                    struct hsr_error *err);
void hsr_network_release(void *prepared);

/* A sight, the cull of edges, and memory from job->scratch. network->sight is
 * freed with hsr_sight_free, also after a failure. HSR_E_NOMEM. */
enum hsr_status hsr_network_init(struct hsr_network *network,
                                 const struct hsr_job *job);

/* A'B' crosses edge c, which is nearer, where `gained` more faces lie on the
 * positive side than on the negative one: an event. HSR_E_NOMEM. */
enum hsr_status hsr_network_cross(struct hsr_network *network, uint32_t e,
                                  uint32_t c, int gained);

/* The events of the regular faces that A'B' pierces. HSR_E_NOMEM. */
enum hsr_status hsr_network_pierce(struct hsr_network *network, uint32_t e);

/* Sorts network->events by their places along edge e, counting the
 * comparisons. */
void hsr_network_sort_along(const struct hsr_network *network, uint32_t e);

/* Draws edge e from t0 to t1. HSR_E_NOMEM. */
enum hsr_status hsr_network_interval(struct hsr_network *network, uint32_t e,
                                     double t0, double t1,
                                     uint32_t invisibility);

/* Does regular face f, if it has no corner there, hide point p, displaced? */
bool hsr_network_hides(const struct hsr_network *network, uint32_t f,
                       uint32_t p);

/* Whether point p is a vertex from which visibility is still to be promoted. */
static inline bool hsr_network_wants(const struct hsr_network *network,
                                     uint32_t p) {
  return network->sight.ahead[p] && !network->known[p];
}

/* Point p, which `hiding` faces hide, is known from now on, and waits for its
 * turn: the last to wait is the first. */
void hsr_network_wait(struct hsr_network *network, uint32_t p, int64_t hiding);

/* Draws all relevant edges into job->drawing. HSR_E_NOMEM. */
enum hsr_status hsr_network_promote(struct hsr_network *network,
                                    const struct hsr_promotion *promotion);

/* The same, promoting the number of hiding faces. HSR_E_NOMEM. */
enum hsr_status hsr_network_draw(struct hsr_network *network,
                                 const struct hsr_intersector *intersector);

/* `render` of an algorithm that needs no more than the above. */
enum hsr_status hsr_network_render(const struct hsr_job *job,
                                   const struct hsr_intersector *intersector,
                                   struct hsr_error *err);

/* The side of face f's edge on which the face is, as its image: a face seen
 * from its front runs around it so that the inside has sign -1. */
static inline int hsr_inside(const struct hsr_sight *sight,
                             const struct hsr_side *side) {
  return -sight->facing[side->face] * side->turn;
}

/* Whether point p is a corner of face f. */
static inline bool hsr_is_corner(const struct hsr_edges *edges, uint32_t p,
                                 uint32_t f) {
  if (p >= edges->world->n_vertices)
    return false;
  for (uint32_t k = edges->corner_start[p]; k < edges->corner_start[p + 1]; k++)
    if (edges->corner[k].face == f)
      return true;
  return false;
}

/* Whether f is one of the own faces of edge e. */
static inline bool hsr_is_own(const struct hsr_edges *edges, uint32_t e,
                              uint32_t f) {
  for (uint32_t k = edges->side_start[e]; k < edges->side_start[e + 1]; k++)
    if (edges->side[k].face == f)
      return true;
  return false;
}

/* Do the images of A'B' and of edge c cross? The ends of each are on both sides
 * of the other. */
static inline bool hsr_images_cross(const struct hsr_sight *sight, uint32_t e,
                                    uint32_t c) {
  uint32_t A = sight->edges->a[e], B = sight->edges->b[e];
  uint32_t C = sight->edges->a[c], D = sight->edges->b[c];
  return hsr_sight_side(sight, C, D, A) != hsr_sight_side(sight, C, D, B) &&
         hsr_sight_line_side(sight, A, B, C) !=
             hsr_sight_line_side(sight, A, B, D);
}

/* Whether edges e and c share a vertex. */
static inline bool hsr_edges_meet(const struct hsr_edges *edges, uint32_t e,
                                  uint32_t c) {
  uint32_t a = edges->a[e], b = edges->b[e];
  return a == edges->a[c] || a == edges->b[c] || b == edges->a[c] ||
         b == edges->b[c];
}

static inline bool hsr_boxes_overlap(const struct hsr_image_box *a,
                                     const struct hsr_image_box *b) {
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
  HSR_PROMOTED,
  HSR_HIDING,
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
      {"sorts to save", "edges that cannot be visible anywhere"},              \
      {"faces apart", "faces in whose plane an edge lies, and loose ones"},    \
      {"promoted", "vertices to which visibility is promoted"}, {              \
    "hiding", "faces that hide those vertices, in all"                         \
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
