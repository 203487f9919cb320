/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the edge-intersection algorithms share: contour edges, the network of
 * edges along which visibility is promoted, the invisibility correction, and
 * the sort along an edge.
 *
 * Source      Sutherland et al. 1974, "Edge-Intersection Algorithms"; A. Appel,
 *             "The Notion of Quantitative Invisibility and the Machine
 *             Rendering of Solids", Proc. ACM National Conference, 1967.
 * Notation    Relevant edge: one with something in the picture. Contour edge ->
 *             contour[]: more of its faces lie on one side of its image than on
 *             the other, by net[]. Quantitative invisibility of a vertex ->
 *             known[] and invisibility[]. Cluster: the edges that one search of
 *             all faces serves. Regular face -> sight.faces: it is flat, and
 *             the near plane does not cut it. Point: a vertex, or an end of an
 *             implied edge. Displaced: moved as the samples of a picture are,
 *             so that no ties are left; A'B' is a displaced edge
 *             (docs/correct-drawing.md).
 * Invariant   The invisibility of a vertex is the number of faces that hide the
 *             displaced vertex. Faces that have a corner at the vertex are left
 *             out; so the number is the same for all edges that end there.
 *             Where an edge begins, its invisibility is that number and the
 *             number of those left out faces that hide this edge: the
 *             invisibility correction. Along the edge it changes at contour
 *             edges, at faces that the edge pierces, and nowhere else.
 * Ties        All crossings at one place along an edge happen together.
 * Departures  - Edges may pierce faces, and implied edges are drawn; the
 *             papers' environments have neither.
 *             - A face in whose plane an edge lies is counted like any other
 *             along the displaced edge, and is taken off at the end.
 *             - Faces that are not regular are added one by one at the end.
 *             - As in the papers, each edge is compared with all contour edges,
 *             and each vertex of a search with all faces. A minimax test comes
 *             first, of every pair, many at once; the survey speaks of none.
 * Options     boxes=corner: contour edges sorted by the upper left corners of
 *             their boxes, as Sutherland et al. propose (corner_boxes.h).
 *             boxes=groups: what they call the elimination of whole groups of
 *             edges (IV, Existing Uses of Coherence; near_boxes.h)
 * Cost        Table III: back and contour cull E_t, initial visibility
 *             100 C_t F_r, edge intersection 30 E_s E_c, invisibility
 *             correction 30 (2 E_s 3), sort along the edge E_s (X_r / E_s)
 *             log2(X_r / E_s). Every pair of edges, and of a vertex and a face,
 *             costs a test of boxes; only those that it leaves cost 30, or 100 */
#ifndef HSR_ALGORITHMS_EDGE_INTERSECTION_H
#define HSR_ALGORITHMS_EDGE_INTERSECTION_H

#include "algorithms/engines/boxes/near_boxes.h"
#include "common/lines/sight/sight.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The part of an edge that is in the picture: between two places along it. */
struct hsr_edge_part {
  bool relevant; /* there is one */
  struct hsr_sight_event from, to;
};

/* One frame: the edges, and how far visibility has been promoted along them. */
struct hsr_network {
  const struct hsr_job *job;     /* borrowed */
  const struct hsr_edges *edges; /* what hsr_network_prepare made */
  struct hsr_tally *tally;
  struct hsr_sight sight;

  int *net; /* by edge: how many more of its faces lie on its positive side
               (hsr_sight_side) than on its negative one */
  uint32_t *contour, n_contour;
  struct hsr_image_box *box;      /* by edge: of its image */
  struct hsr_corner_boxes boxes;  /* the edges' boxes, if they are sorted */
  struct hsr_image_box *face_box; /* by face: of those that exist */
  struct hsr_near_boxes faces;    /* the boxes of sight.faces */
  struct hsr_near_boxes loose;    /* the boxes of sight.loose */
  struct hsr_near_boxes contours; /* the boxes of contour[] */
  struct hsr_edge_part *part;     /* by edge */
  bool *drawn;                    /* by edge: it has been drawn */

  bool *known;                  /* by point: its invisibility is known */
  int64_t *invisibility;        /* by point, if known */
  uint32_t *waiting, n_waiting; /* a stack: points to promote from */

  /* Of struct hsr_sight_event: along the current edge. */
  struct hsr_growing events;
};

/* How an algorithm promotes visibility from point to point. It keeps, for the
 * point whose turn it is (the current one), what hides it: a number or a set of
 * faces. */
struct hsr_promotion {
  /* The search of all faces: makes p the current point, and finds what hides
   * it. HSR_E_NOMEM. */
  enum hsr_status (*search)(void *context, struct hsr_network *network,
                            uint32_t p);
  /* Makes p the current point: the last of those that wait, for which
   * `follow` has left what hides it. */
  void (*resume)(void *context, struct hsr_network *network, uint32_t p);
  /* Draws relevant edge e from its end p, the current point. If
   * hsr_network_wants the other end, keeps what hides that, and calls
   * hsr_network_wait. network->events is empty at the call. HSR_E_NOMEM. */
  enum hsr_status (*follow)(void *context, struct hsr_network *network,
                            uint32_t e, uint32_t p);
  void *context;
};

/* What differs among the algorithms that count hiding faces. */
struct hsr_intersector {
  /* Finds where edge e is crossed by nearer contour edges that share no
   * vertex with it, and adds these events by hsr_network_cross. HSR_E_NOMEM. */
  enum hsr_status (*cross)(void *context, struct hsr_network *network,
                           uint32_t e);
  void *context;
  bool visible_only; /* an edge of which nothing can be visible is drawn as one
                        hidden interval, and its crossings are not sorted */
};

/* `expense` of algorithms that compare every edge with every other: the minimax
 * tests, if about one side of a face in three belongs to an edge in the
 * picture. */
double hsr_network_expense(const struct hsr_world *world,
                           const struct hsr_view *view);

/* The option of these algorithms that says how boxes are sorted: the first of
 * theirs, HSR_NOT_SORTED ... Algorithms without options have it not. */
enum { HSR_NETWORK_BOXES };

/* `prepare` and `release` of these algorithms: *prepared is the edges of the
 * world. */
enum hsr_status hsr_network_prepare(const struct hsr_world *world,
                                    const long *option, void **prepared,
                                    struct hsr_error *err);
void hsr_network_release(void *prepared);

/* Begins a frame: makes network->sight and culls the edges. `boxes`: how contour
 * edges are sorted (HSR_NOT_SORTED, ...). The job is borrowed; memory is taken from job->scratch. network->sight is freed by the
 * caller with hsr_sight_free, also after a failure. HSR_E_NOMEM. */
enum hsr_status hsr_network_init(struct hsr_network *network,
                                 const struct hsr_job *job, long boxes);

/* Adds the event that edge e, displaced, passes behind contour edge c.
 * `gained`: how many more faces of c lie on its positive side than on its
 * negative one. HSR_E_NOMEM. */
enum hsr_status hsr_network_cross(struct hsr_network *network, uint32_t e,
                                  uint32_t c, int gained);

/* Adds the events of the regular faces that edge e, displaced, pierces.
 * HSR_E_NOMEM. */
enum hsr_status hsr_network_pierce(struct hsr_network *network, uint32_t e);

/* Sorts network->events by their places along edge e. */
void hsr_network_sort_along(const struct hsr_network *network, uint32_t e);

/* Draws edge e from t0 to t1, parameters along it, as an interval of that
 * invisibility. HSR_E_NOMEM. */
enum hsr_status hsr_network_interval(struct hsr_network *network, uint32_t e,
                                     double t0, double t1,
                                     uint32_t invisibility);

/* Compares the boxes of all loose faces with that of edge e. Then puts those
 * that are near to the edge, and adds the events that hsr_sight_face finds. Calls
 * hides(context, f) for each that hides the beginning of the edge; not for one
 * that is a side of e, or whose plane holds e. HSR_E_NOMEM. */
enum hsr_status hsr_network_put_loose(struct hsr_network *network, uint32_t e,
                                      void (*hides)(void *context, uint32_t f),
                                      void *context);

/* The search of all regular faces: compares the box of each with the image of
 * point p, and then asks of those near whether they hide p, displaced. A face
 * that has a corner there does not. Calls found(context, f) for each that does. */
void hsr_network_search(struct hsr_network *network, uint32_t p,
                        void (*found)(void *context, uint32_t f),
                        void *context);

/* Is visibility still to be promoted to point p? */
static inline bool hsr_network_wants(const struct hsr_network *network,
                                     uint32_t p) {
  return network->sight.ahead[p] && !network->known[p];
}

/* Makes point p, an end of edge e, known, and has it wait for its turn. The
 * last to wait is the first to be taken. */
void hsr_network_wait(struct hsr_network *network, uint32_t p, uint32_t e);

/* Draws all relevant edges into the job's drawing, by an algorithm's own
 * promotion. HSR_E_NOMEM. */
enum hsr_status hsr_network_promote(struct hsr_network *network,
                                    const struct hsr_promotion *promotion);

/* The same, promoting the number of hiding faces. `intersector` has the rest.
 * HSR_E_NOMEM. */
enum hsr_status hsr_network_draw(struct hsr_network *network,
                                 const struct hsr_intersector *intersector);

/* `render` of an algorithm that consists of its intersector alone. */
enum hsr_status hsr_network_render(const struct hsr_job *job,
                                   const struct hsr_intersector *intersector,
                                   struct hsr_error *err);

/* The parts and their counters; edge_intersection.c has the meanings. A module
 * uses hsr_network_part and one of the other two. If it promotes visibility as
 * a number, the counter HSR_HIDING is the sum of these numbers, and computed;
 * if as a set, it counts the steps that keep the set. Groups of lines of the
 * outline: before and after the module's own lines, which find an edge's
 * crossings, are indented by four blanks, and raise HSR_INTERSECT and
 * HSR_OVERLAPS. hsr_box_sort_part is for modules that compare boxes of edges. */
extern const struct hsr_part hsr_network_part, hsr_hiding_number_part,
    hsr_hiding_set_part, hsr_box_sort_part;
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
  HSR_DRAWN,
  HSR_OVERLAPS,
  HSR_SEARCHED
};
enum { HSR_HIDING = HSR_FIRST_OF(HSR_PART_HIDING) };
enum { HSR_LINES_BEFORE_CROSSINGS, HSR_LINES_AFTER_CROSSINGS };
enum { HSR_LINES_OF_SORT, HSR_LINES_OF_GROUPS }; /* of hsr_box_sort_part */

/* On which side of the image of an edge one of its faces lies: +1 or -1, as of
 * hsr_sight_side. Seen from its front, the corners of a face run around its
 * inside so that the inside has the sign -1. */
static inline int hsr_inside(const struct hsr_sight *sight,
                             const struct hsr_side *side) {
  return -sight->facing[side->face] * side->turn;
}

/* Is point p a corner of face f? */
static inline bool hsr_is_corner(const struct hsr_edges *edges, uint32_t p,
                                 uint32_t f) {
  if (p >= edges->world->mesh.n_vertices)
    return false;
  for (uint32_t k = edges->corner_start[p]; k < edges->corner_start[p + 1]; k++)
    if (edges->corner[k].face == f)
      return true;
  return false;
}

/* Is f one of the faces that have edge e as a side? */
static inline bool hsr_is_own(const struct hsr_edges *edges, uint32_t e,
                              uint32_t f) {
  for (uint32_t k = edges->side_start[e]; k < edges->side_start[e + 1]; k++)
    if (edges->side[k].face == f)
      return true;
  return false;
}

/* Do the images of edge e, displaced, and of edge c cross? They do if the ends
 * of each are on different sides of the other. */
static inline bool hsr_images_cross(const struct hsr_sight *sight, uint32_t e,
                                    uint32_t c) {
  uint32_t A = sight->edges->a[e], B = sight->edges->b[e];
  uint32_t C = sight->edges->a[c], D = sight->edges->b[c];
  return hsr_sight_side(sight, C, D, A) != hsr_sight_side(sight, C, D, B) &&
         hsr_sight_line_side(sight, A, B, C) !=
             hsr_sight_line_side(sight, A, B, D);
}

/* Do edges e and c share a vertex? */
static inline bool hsr_edges_meet(const struct hsr_edges *edges, uint32_t e,
                                  uint32_t c) {
  uint32_t a = edges->a[e], b = edges->b[e];
  return a == edges->a[c] || a == edges->b[c] || b == edges->a[c] ||
         b == edges->b[c];
}

/* Sorts n edges, those of contour[] or others, by the upper left corners of
 * their boxes, into network->boxes. A comparison is a step of `counter`. Memory
 * from job->scratch. HSR_E_NOMEM. */
enum hsr_status hsr_network_sort_boxes(struct hsr_network *network,
                                       uint32_t *edges, uint32_t n,
                                       int counter);

/* Puts the sorted edges whose boxes may overlap that of e into
 * network->boxes.near[]. Returns how many. */
uint32_t hsr_network_find_near(const struct hsr_network *network, uint32_t e);

/* What the comparison of an edge with a contour edge finds. */
enum hsr_crossing {
  HSR_BOXES_APART,
  HSR_SHARE_A_VERTEX,
  HSR_DO_NOT_CROSS,
  HSR_CROSSES_FARTHER, /* the contour edge is the farther one */
  HSR_CROSSES_NEARER
};
#define HSR_CROSSING_OUTCOMES                                                  \
  "boxes apart|share a vertex|do not cross|farther|nearer"

/* Counts the comparison of e with edge c, and what it found. */
static inline void hsr_network_compared(const struct hsr_network *network,
                                        uint32_t e, uint32_t c,
                                        enum hsr_crossing found) {
  HSR_STEP(network->tally, HSR_INTERSECT, hsr_edge_subject(network->edges, e),
           hsr_edge_subject(network->edges, c), HSR_NOWHERE, found);
  if (found != HSR_BOXES_APART)
    HSR_STEP(network->tally, HSR_OVERLAPS, hsr_edge_subject(network->edges, e),
             hsr_edge_subject(network->edges, c), HSR_NOWHERE, 0);
}

/* Counts the comparison of the box of e with those of other edges, edge[k] with
 * box k, for k from `from` to before `to`, which are apart. */
void hsr_network_count_apart(const struct hsr_network *network, uint32_t e,
                             const struct hsr_near_boxes *all,
                             const uint32_t *edge, uint32_t from, uint32_t to);

/* The same of the groups of other edges, if there are groups; of near ones too. */
void hsr_network_count_groups(const struct hsr_network *network, uint32_t e,
                              const struct hsr_near_boxes *all,
                              const uint32_t *edge);

/* Compares e with other edges: calls cross_one for each that its box does not
 * part from e. It adds the crossing, if there is one. The other edges are
 * edge[k], with box k of *all; or if `all` is NULL, the sorted edges near e.
 * HSR_E_NOMEM. */
static inline enum hsr_status
hsr_network_cross_edges(struct hsr_network *network, uint32_t e,
                        struct hsr_near_boxes *all, const uint32_t *edge,
                        enum hsr_status (*cross_one)(struct hsr_network *,
                                                     uint32_t e, uint32_t c)) {
  uint32_t n = all ? 0 : hsr_network_find_near(network, e);
  for (uint32_t k = 0; k < n; k++)
    if (cross_one(network, e, network->boxes.near[k]))
      return HSR_E_NOMEM;
  if (!all)
    return HSR_OK;
  hsr_near_boxes_find(all, &network->box[e]);
  if (HSR_COUNTING)
    hsr_network_count_groups(network, e, all, edge);
  for (uint32_t k, from = 0; from < all->n; from = k + 1) {
    k = hsr_near_boxes_next(all, from, all->n);
    if (HSR_COUNTING)
      hsr_network_count_apart(network, e, all, edge, from, k);
    if (k < all->n && cross_one(network, e, edge[k]))
      return HSR_E_NOMEM;
  }
  return HSR_OK;
}

/* The face whose corner is world->mesh.vertex[k]. */
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

/* What happens at an event along an edge, as the subject of a step: an edge; a
 * side of a face; or a face alone, as an edge without vertices. */
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

#ifdef __cplusplus
}
#endif
#endif
