/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the edge-intersection algorithms share: contour edges, the network of
 * edges along which visibility is promoted, the invisibility correction, and
 * the sort along an edge.
 *
 * Source      Sutherland et al. 1974, "Edge-Intersection Algorithms"; A. Appel,
 *             "The Notion of Quantitative Invisibility and the Machine
 *             Rendering of Solids", Proc. ACM National Conference, 1967.
 * Notation    relevant edge -> an edge with something in the picture;
 *             contour edge -> contour[]: by net[], more of its faces lie on one
 *             side of its image than on the other; quantitative invisibility of
 *             a vertex -> known[] and invisibility[]; cluster -> the edges that
 *             one search of all faces serves
 * Invariant   the invisibility of a vertex is the number of faces that hide the
 *             displaced vertex. Faces that have a corner there do not count.
 *             So the number is the same for all edges that end there. The
 *             invisibility of an edge where it begins adds those of the left
 *             out faces that hide this edge: the invisibility correction. Along
 *             the edge it changes at contour edges and at faces that the edge
 *             pierces, and nowhere else.
 * Ties        crossings at one place happen at once
 * Departures  Edges may pierce faces, and implied edges are drawn; the papers'
 *             environments have neither. A face in whose plane an edge lies is
 *             counted like any other along the displaced edge, and is taken
 *             away at the end. Faces that are not flat, or that the near plane
 *             cuts, are each added at the end. Each edge is put to all contour
 *             edges; only a minimax test comes before, as in the papers.
 * Cost        Table III: back and contour cull E_t, initial visibility
 *             100 C_t F_r, edge intersection 30 E_s E_c, invisibility
 *             correction 30 (2 E_s 3), sort along the edge E_s */
#ifndef HSR_ALGORITHMS_EDGE_INTERSECTION_H
#define HSR_ALGORITHMS_EDGE_INTERSECTION_H

#include "algorithms/object_space/edges/near_boxes.h"
#include "common/lines/sight/sight.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The part of an edge that is in the picture lies between two places. */
struct hsr_edge_part {
  bool relevant; /* there is such a part */
  struct hsr_sight_event from, to;
};

struct hsr_network {
  const struct hsr_job *job;
  const struct hsr_edges *edges;
  struct hsr_tally *tally;
  struct hsr_sight sight;

  int *net; /* by edge: how many more of its faces lie on its positive side
               (hsr_sight_side) than on its negative one */
  uint32_t *contour, n_contour;
  struct hsr_image_box *box;      /* by edge */
  struct hsr_corner_boxes boxes;  /* of edges; if they are sorted */
  struct hsr_image_box *face_box; /* by face, of the regular ones */
  struct hsr_near_boxes faces;    /* of sight.faces */
  struct hsr_near_boxes contours; /* of contour[] */
  struct hsr_edge_part *part;     /* by edge */
  bool *drawn;                    /* by edge: it is done */

  bool *known;                  /* by point */
  int64_t *invisibility;        /* by point, where known */
  uint32_t *waiting, n_waiting; /* vertices from which to promote */

  struct hsr_growing events; /* along the current edge */
};

/* How an algorithm promotes visibility from vertex to vertex. It keeps at hand
 * what hides the vertex whose turn it is. */
struct hsr_promotion {
  /* The search of all faces: brings to hand what hides point p. HSR_E_NOMEM. */
  enum hsr_status (*search)(void *context, struct hsr_network *network,
                            uint32_t p);
  /* Brings to hand what was left with p, the last of all that wait. */
  void (*resume)(void *context, struct hsr_network *network, uint32_t p);
  /* Draws relevant edge e from its end p, whose turn it is. If
   * hsr_network_wants the other end, leaves what hides that with
   * hsr_network_wait. network->events are empty. HSR_E_NOMEM. */
  enum hsr_status (*follow)(void *context, struct hsr_network *network,
                            uint32_t e, uint32_t p);
  void *context;
};

/* What differs among the algorithms that count hiding faces. */
struct hsr_intersector {
  /* Finds the crossings of A'B' with nearer contour edges that share no vertex
   * with e, and appends them to network->events by hsr_network_cross.
   * HSR_E_NOMEM. */
  enum hsr_status (*cross)(void *context, struct hsr_network *network,
                           uint32_t e);
  void *context;
  int box_sort; /* its counter, if boxes are sorted by their corners; or 0 */
  bool visible_only; /* an edge of which nothing can be visible is drawn as one
                        hidden interval, and its crossings are not sorted */
};

/* `expense` of those that compare every edge with every other: the minimax
 * tests. About one of three sides is that of an edge in the picture. */
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

/* Adds the event that A'B' crosses edge c, which is nearer, and of which
 * `gained` more faces lie on the positive side than on the negative one.
 * HSR_E_NOMEM. */
enum hsr_status hsr_network_cross(struct hsr_network *network, uint32_t e,
                                  uint32_t c, int gained);

/* Adds the events of the regular faces that A'B' pierces. HSR_E_NOMEM. */
enum hsr_status hsr_network_pierce(struct hsr_network *network, uint32_t e);

/* Sorts network->events by their places along edge e. */
void hsr_network_sort_along(const struct hsr_network *network, uint32_t e);

/* Draws edge e from t0 to t1. HSR_E_NOMEM. */
enum hsr_status hsr_network_interval(struct hsr_network *network, uint32_t e,
                                     double t0, double t1,
                                     uint32_t invisibility);

/* Finds which of network->faces are near point p. */
void hsr_network_find_faces(struct hsr_network *network, uint32_t p);

/* Does regular face f hide point p, displaced? Never, if it has a corner there.
 */
bool hsr_network_hides(const struct hsr_network *network, uint32_t f,
                       uint32_t p);

/* Whether visibility is still to be promoted to point p. */
static inline bool hsr_network_wants(const struct hsr_network *network,
                                     uint32_t p) {
  return network->sight.ahead[p] && !network->known[p];
}

/* Point p, an end of edge e, is known from now on. It waits for its turn; the
 * last to wait is the first to be taken. */
void hsr_network_wait(struct hsr_network *network, uint32_t p, uint32_t e);

/* Draws all relevant edges into the job's drawing. HSR_E_NOMEM. */
enum hsr_status hsr_network_promote(struct hsr_network *network,
                                    const struct hsr_promotion *promotion);

/* The same, promoting the number of hiding faces. HSR_E_NOMEM. */
enum hsr_status hsr_network_draw(struct hsr_network *network,
                                 const struct hsr_intersector *intersector);

/* `render` of an algorithm that is its intersector and no more. */
enum hsr_status hsr_network_render(const struct hsr_job *job,
                                   const struct hsr_intersector *intersector,
                                   struct hsr_error *err);

/* On which side of the image of its edge a face lies. Seen from its front, a
 * face runs around its inside so that the inside has sign -1. */
static inline int hsr_inside(const struct hsr_sight *sight,
                             const struct hsr_side *side) {
  return -sight->facing[side->face] * side->turn;
}

/* Whether point p is a corner of face f. */
static inline bool hsr_is_corner(const struct hsr_edges *edges, uint32_t p,
                                 uint32_t f) {
  if (p >= edges->world->mesh.n_vertices)
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

/* Do the images of A'B' and of edge c cross? They do if the ends of each are on
 * different sides of the other. */
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

/* Sorts n edges, contour[] or others, by the upper left corners of their boxes.
 * A comparison is a step of `counter`. Memory from job->scratch. HSR_E_NOMEM.
 */
enum hsr_status hsr_network_sort_boxes(struct hsr_network *network,
                                       uint32_t *edges, uint32_t n,
                                       int counter);

/* Puts those of them whose boxes may overlap that of e into boxes.near[].
 * Returns how many. */
uint32_t hsr_network_find_near(const struct hsr_network *network, uint32_t e);

/* Puts e to other edges by cross_one, which adds their crossing; `apart` says
 * that c is known to be apart from e. The other edges are edge[k], with box k of
 * `all`. If `all` is NULL, they are those edges near e whose boxes are sorted.
 * HSR_E_NOMEM. */
static inline enum hsr_status hsr_network_cross_edges(
    struct hsr_network *network, uint32_t e, struct hsr_near_boxes *all,
    const uint32_t *edge,
    enum hsr_status (*cross_one)(struct hsr_network *, uint32_t e, uint32_t c,
                                 bool apart)) {
  uint32_t n = all ? 0 : hsr_network_find_near(network, e);
  for (uint32_t k = 0; k < n; k++)
    if (cross_one(network, e, network->boxes.near[k], false))
      return HSR_E_NOMEM;
  if (!all)
    return HSR_OK;
  hsr_near_boxes_find(all, &network->box[e]);
  for (uint32_t k = hsr_near_boxes_next(all, 0); k < all->n;
       k = hsr_near_boxes_next(all, k + 1))
    if (cross_one(network, e, edge[k], !all->near[k]))
      return HSR_E_NOMEM;
  return HSR_OK;
}

/* What the edge intersection may find of an edge and a contour edge. */
enum hsr_crossing {
  HSR_BOXES_APART,
  HSR_SHARE_A_VERTEX,
  HSR_DO_NOT_CROSS,
  HSR_CROSSES_FARTHER, /* the contour edge is the farther one */
  HSR_CROSSES_NEARER
};
#define HSR_CROSSING_OUTCOMES                                                  \
  "boxes apart|share a vertex|do not cross|farther|nearer"

/* The face that has corner k of world->vertex[]. */
static inline uint32_t hsr_face_of_corner(const struct hsr_world *world,
                                          uint32_t k) {
  uint32_t f = 0, beyond = world->n_faces;
  while (beyond - f > 1) {
    uint32_t middle = f + (beyond - f) / 2;
    if (world->mesh.start[middle] <= k)
      f = middle;
    else
      beyond = middle;
  }
  return f;
}

/* What is at an event along an edge, as a subject: an edge; a side of a face;
 * or only a face, as an edge without vertices. */
static inline struct hsr_subject
hsr_event_subject(const struct hsr_network *network,
                  const struct hsr_sight_event *event) {
  const struct hsr_edges *edges = network->edges;
  const struct hsr_world *world = edges->world;
  uint32_t k = event->subject;
  switch (event->at) {
  case HSR_AT_EDGE:
    return hsr_edge_subject(edges, k);
  case HSR_AT_SIDE: {
    uint32_t f = hsr_face_of_corner(world, k);
    uint32_t before = k > world->mesh.start[f] ? k : world->mesh.start[f + 1];
    return HSR_EDGE(world->mesh.vertex[before - 1], world->mesh.vertex[k], f);
  }
  case HSR_AT_PLANE:
  case HSR_AT_NEAR:
    return HSR_EDGE(HSR_NO_ID, HSR_NO_ID, k);
  default:
    return HSR_NOTHING;
  }
}

/* What these count. Where visibility is promoted as a number, `hiding` is the sum
 * of those numbers, and computed; where it is promoted as a set, it has the steps
 * that keep its members: a module uses one of the two parts. The groups of lines
 * stand before and after those that find an edge's crossings, which are at the
 * third level and raise HSR_INTERSECT. */
extern const struct hsr_part hsr_network_part, hsr_hiding_number_part,
    hsr_hiding_set_part;
enum {
  HSR_EDGE_CULL = HSR_FIRST_OF(HSR_PART_NETWORK),
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
  HSR_DRAWN
};
enum { HSR_HIDING = HSR_FIRST_OF(HSR_PART_HIDING) };
enum { HSR_LINES_BEFORE_CROSSINGS, HSR_LINES_AFTER_CROSSINGS };

#ifdef __cplusplus
}
#endif
#endif
