/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Galimberti and Montanari's hidden-line algorithm: the set of hiding faces is
 * carried along the edges.
 *
 * Source      R. Galimberti, U. Montanari, "An Algorithm for Hidden Line
 *             Elimination", Comm. ACM 12(4), 1969; Sutherland et al. 1974,
 *             "Edge-Intersection Algorithms".
 * Notation    nature of a point -> the faces that hide it. It is nature[] for
 *             the vertex whose turn it is, and natures for the vertices that
 *             wait; along the edge it is the faces whose member[].times is more
 *             than 0.
 * Invariants  The nature of a vertex holds the regular faces that hide the
 *             displaced vertex, without those that have a corner there. So it
 *             is the same for all edges that end there. An edge c between faces
 *             alpha and beta that is nearer where the images cross takes away
 *             the face on the side that is left, and adds the other one. The
 *             last natures[] are those of network->waiting[], one after
 *             another, each from its from[] on.
 * Ties        Events at one place of an edge happen at once. Between them a
 *             face may be entered twice, or left before it is entered. So
 *             membership is counted, and is looked at after all of them.
 * Departures  Those of edge_intersection.h, with sets for numbers: a face in
 *             whose plane the edge lies is carried but does not count; loose
 *             faces are put to each edge, and are not carried. The nature at
 *             the end of an edge is not corrected by tests: the faces with a
 *             corner there are left out.
 * Options     those of edge_intersection.h, of all edges
 * Cost        That of edge_intersection.h, except that all edges are compared
 *             with all, not only with contour edges, that the sort is never
 *             saved, and that a set takes more to change than a number. Only
 *             the natures of vertices that wait are kept. */
#include "algorithms/object_space/edges/edge_intersection.h"
#include "common/answers/kinds/segments.h"

#include <string.h>

enum { OF_CONTOUR, CHANGED };
static const struct hsr_option options[] = {
    [HSR_NETWORK_BOXES] = {"boxes", "how edges are sorted", hsr_edge_sortings,
                           0, HSR_IN_GROUPS, HSR_NOT_SORTED},
    {NULL}};

/* How a face stands to the current edge. */
struct member {
  int times;   /* how often entered, less how often left: 0 or 1, except
                between events at one place */
  bool listed; /* in touched[] */
  bool apart;  /* one whose plane holds the edge: does not hide it */
};

struct state {
  uint32_t *with_faces, n_with_faces; /* edges of regular faces */
  struct hsr_near_boxes all;          /* of these, if they are not sorted */

  struct member *member;        /* by face */
  uint32_t *touched, n_touched; /* faces whose member[] is not all zero */
  uint32_t n_hiding;            /* the size of the nature along the edge */

  uint32_t *nature, n_nature; /* where the edge has come to */
  struct hsr_growing natures; /* of uint32_t: those of the vertices that wait */
  size_t *from;               /* where that of network->waiting[k] begins */
};

/* --- The nature along an edge --------------------------------------------- */

static struct member *touch(struct state *s, uint32_t f) {
  struct member *member = &s->member[f];
  if (!member->listed) {
    member->listed = true;
    s->touched[s->n_touched++] = f;
  }
  return member;
}

/* Face f is entered once more, or left (-1). */
static void enter(struct state *s, uint32_t f, int times) {
  struct member *member = touch(s, f);
  s->n_hiding -= !member->apart && member->times > 0;
  member->times += times;
  s->n_hiding += !member->apart && member->times > 0;
}

static void forget(struct state *s) {
  for (uint32_t k = 0; k < s->n_touched; k++)
    s->member[s->touched[k]] = (struct member){.times = 0};
  s->n_touched = 0;
  s->n_hiding = 0;
}

/* Passes an event forwards, or backwards (times = -1). */
static void pass(struct state *s, const struct hsr_network *network,
                 const struct hsr_sight_event *event, int times) {
  const struct hsr_edges *edges = network->edges;
  const struct hsr_sight *sight = &network->sight;
  uint32_t c = event->subject;
  HSR_STEP(network->tally, CHANGED, hsr_event_subject(network, event),
           HSR_NOTHING, HSR_NOWHERE, times < 0);
  if (event->at == HSR_AT_EDGE) {
    for (uint32_t k = edges->side_start[c]; k < edges->side_start[c + 1]; k++)
      if (sight->regular[edges->side[k].face])
        enter(s, edges->side[k].face,
              times * event->change * hsr_inside(sight, &edges->side[k]));
  } else {
    enter(s, event->face, times * event->change);
  }
}

/* --- Natures of vertices -------------------------------------------------- */

static void add_to_nature(void *context, uint32_t f) {
  struct state *s = context;
  s->nature[s->n_nature++] = f;
}

static enum hsr_status search(void *context, struct hsr_network *network,
                              uint32_t p) {
  ((struct state *)context)->n_nature = 0;
  hsr_network_search(network, p, add_to_nature, context);
  return HSR_OK;
}

static void resume(void *context, struct hsr_network *network, uint32_t p) {
  (void)p;
  struct state *s = context;
  const uint32_t *natures = s->natures.items;
  size_t from = s->from[network->n_waiting];
  s->n_nature = (uint32_t)(s->natures.n - from);
  if (s->n_nature)
    memcpy(s->nature, natures + from, s->n_nature * sizeof *s->nature);
  s->natures.n = from;
}

/* Leaves the nature of edge e at its end p with that vertex. */
static enum hsr_status leave(struct state *s, struct hsr_network *network,
                             uint32_t e, uint32_t p) {
  if (!hsr_network_wants(network, p))
    return HSR_OK;
  size_t from = s->natures.n;
  for (uint32_t k = 0; k < s->n_touched; k++) {
    uint32_t f = s->touched[k];
    if (s->member[f].times <= 0 || !network->sight.regular[f] ||
        hsr_is_corner(network->edges, p, f))
      continue;
    if (!hsr_arena_grow(network->job->scratch, &s->natures, sizeof f))
      return HSR_E_NOMEM;
    ((uint32_t *)s->natures.items)[s->natures.n - 1] = f;
    HSR_STEP(network->tally, HSR_HIDING, hsr_point_subject(network->edges, p),
             HSR_FACE(f), HSR_NOWHERE, 0);
  }
  s->from[network->n_waiting] = from;
  hsr_network_wait(network, p, e);
  return HSR_OK;
}

/* --- Along an edge -------------------------------------------------------- */

static enum hsr_crossing compare(const struct hsr_network *network, uint32_t e,
                                 uint32_t c) {
  const struct hsr_sight *sight = &network->sight;
  if (!hsr_boxes_overlap(&network->box[e], &network->box[c]))
    return HSR_BOXES_APART;
  if (hsr_edges_meet(network->edges, e, c))
    return HSR_SHARE_A_VERTEX;
  if (!hsr_images_cross(sight, e, c))
    return HSR_DO_NOT_CROSS;
  return hsr_sight_nearer(sight, e, c) ? HSR_CROSSES_NEARER
                                       : HSR_CROSSES_FARTHER;
}

/* Puts e to edge c. */
static enum hsr_status cross_one(struct hsr_network *network, uint32_t e,
                                 uint32_t c) {
  enum hsr_crossing found = compare(network, e, c);
  hsr_network_compared(network, e, c, found);
  return found == HSR_CROSSES_NEARER ? hsr_network_cross(network, e, c, 1)
                                     : HSR_OK;
}

/* Finds the crossings with all nearer edges. */
static enum hsr_status cross(struct state *s, struct hsr_network *network,
                             uint32_t e) {
  bool sorted = network->job->option[HSR_NETWORK_BOXES] == HSR_BY_CORNER;
  HSR_COMPUTED(network->tally, OF_CONTOUR, network->n_contour);
  return hsr_network_cross_edges(network, e, sorted ? NULL : &s->all,
                                 s->with_faces, cross_one);
}

/* The faces in whose planes the edge lies do not hide it. */
static void set_apart(struct state *s, const struct hsr_network *network,
                      uint32_t e) {
  const struct hsr_edges *edges = network->edges;
  for (uint32_t k = edges->side_start[e]; k < edges->side_start[e + 1]; k++)
    touch(s, edges->side[k].face)->apart = true;
  for (uint32_t k = edges->touch_start[e]; k < edges->touch_start[e + 1]; k++)
    if (edges->touch[k].in_plane) {
      HSR_STEP(network->tally, HSR_APART, hsr_edge_subject(edges, e),
               HSR_FACE(edges->touch[k].face), HSR_NOWHERE, 0);
      touch(s, edges->touch[k].face)->apart = true;
    }
}

/* Takes up the nature of the edge at its end p: that of vertex p, and those of
 * the faces with a corner there that hide the edge. */
static void begin(struct state *s, const struct hsr_network *network,
                  uint32_t e, uint32_t p) {
  const struct hsr_edges *edges = network->edges;
  for (uint32_t k = 0; k < s->n_nature; k++)
    enter(s, s->nature[k], 1);
  if (p >= edges->world->mesh.n_vertices)
    return;
  for (uint32_t k = edges->corner_start[p]; k < edges->corner_start[p + 1];
       k++) {
    struct hsr_corner corner = edges->corner[k];
    if (!network->sight.regular[corner.face] ||
        hsr_is_own(edges, e, corner.face))
      continue;
    bool hides = hsr_sight_corner_hides(&network->sight, e, p, corner);
    HSR_STEP(network->tally, HSR_CORRECT, hsr_edge_subject(edges, e),
             HSR_FACE(corner.face), HSR_NOWHERE, hides);
    if (hides)
      enter(s, corner.face, 1);
  }
}

static void enter_loose(void *context, uint32_t f) {
  enter(context, f, 1);
}

/* Moves along the sorted events, and draws what is in the picture. */
static enum hsr_status move_along(struct state *s, struct hsr_network *network,
                                  uint32_t e) {
  const struct hsr_sight *sight = &network->sight;
  const struct hsr_edge_part *part = &network->part[e];
  const struct hsr_sight_event *event = network->events.items;
  size_t n = network->events.n, k = 0;
  for (; k < n && hsr_sight_compare(sight, e, &event[k], &part->from) <= 0; k++)
    pass(s, network, &event[k], 1);
  double t = part->from.t;
  while (k < n && hsr_sight_compare(sight, e, &event[k], &part->to) < 0) {
    size_t first = k;
    uint32_t n_hiding = s->n_hiding;
    do
      pass(s, network, &event[k++], 1);
    while (k < n && hsr_sight_compare(sight, e, &event[first], &event[k]) == 0);
    if (s->n_hiding == n_hiding)
      continue; /* other faces hide it, but as many */
    if (hsr_network_interval(network, e, t, event[first].t, n_hiding))
      return HSR_E_NOMEM;
    t = event[first].t > t ? event[first].t : t;
  }
  if (hsr_network_interval(network, e, t, part->to.t, s->n_hiding))
    return HSR_E_NOMEM;
  for (; k < n; k++)
    pass(s, network, &event[k], 1);
  return HSR_OK;
}

static enum hsr_status follow(void *context, struct hsr_network *network,
                              uint32_t e, uint32_t p) {
  struct state *s = context;
  uint32_t a = network->edges->a[e], b = network->edges->b[e];
  if (cross(s, network, e) || hsr_network_pierce(network, e))
    return HSR_E_NOMEM;
  set_apart(s, network, e);
  begin(s, network, e, p);
  if (p == b) { /* go backwards to a, since the edge is drawn from there */
    const struct hsr_sight_event *event = network->events.items;
    for (size_t k = 0; k < network->events.n; k++)
      pass(s, network, &event[k], -1);
    if (leave(s, network, e, a))
      return HSR_E_NOMEM;
  }
  /* Loose faces are put to each edge, since they are not carried. */
  if (hsr_network_put_loose(network, e, enter_loose, s))
    return HSR_E_NOMEM;
  hsr_network_sort_along(network, e);
  if (move_along(s, network, e) || (p == a && leave(s, network, e, b)))
    return HSR_E_NOMEM;
  forget(s);
  return HSR_OK;
}

/* --- The frame ------------------------------------------------------------ */

/* Collects all edges where a face can be entered or left. */
static void collect_edges(struct state *s, const struct hsr_network *network) {
  const struct hsr_edges *edges = network->edges;
  for (uint32_t e = 0; e < edges->n; e++) {
    bool any = false;
    for (uint32_t k = edges->side_start[e]; k < edges->side_start[e + 1]; k++)
      any |= network->sight.regular[edges->side[k].face] &&
             hsr_inside(&network->sight, &edges->side[k]) != 0;
    if (any)
      s->with_faces[s->n_with_faces++] = e;
  }
}

static enum hsr_status draw(const struct hsr_job *job,
                            struct hsr_network *network) {
  struct hsr_arena *arena = job->scratch;
  uint32_t n_faces = network->edges->world->n_faces;
  struct state s = {.with_faces = HSR_NEW(arena, uint32_t, network->edges->n),
                    .member = HSR_NEW_ZEROED(arena, struct member, n_faces),
                    .touched = HSR_NEW(arena, uint32_t, n_faces),
                    .nature = HSR_NEW(arena, uint32_t, n_faces),
                    .from = HSR_NEW(arena, size_t, network->edges->n_points)};
  if (!s.with_faces || !s.member || !s.touched || !s.nature || !s.from)
    return HSR_E_NOMEM;
  collect_edges(&s, network);
  long boxes = job->option[HSR_NETWORK_BOXES];
  if (boxes == HSR_BY_CORNER
          ? hsr_network_sort_boxes(network, s.with_faces, s.n_with_faces,
                                   HSR_BOX_SORT)
          : hsr_near_boxes_make(&s.all, network->box, s.with_faces,
                                s.n_with_faces, boxes == HSR_IN_GROUPS, arena))
    return HSR_E_NOMEM;
  return hsr_network_promote(network, &(struct hsr_promotion){.search = search,
                                                              .resume = resume,
                                                              .follow = follow,
                                                              .context = &s});
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct hsr_network network;
  enum hsr_status status = hsr_network_init(&network, job, HSR_NOT_SORTED);
  if (!status)
    status = draw(job, &network);
  hsr_sight_free(&network.sight);
  return status ? hsr_fail_nomem(err) : HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {
    {&hsr_network_part}, {&hsr_hiding_set_part}, {&hsr_box_sort_part}, {NULL}};

static const struct hsr_counter counters[] = {
    [OF_CONTOUR] = {"contour pairs",
                    "pairs there would be with contour edges only", HSR_COMPARE,
                    HSR_OF_EDGE, HSR_OF_EDGE, .computed = true,
                    .key = "contour-pair"},
    [CHANGED] = {"nature changes", "events at which faces are entered and left",
                 HSR_ACTIVATE, HSR_OF_EDGE, HSR_OF_NOTHING,
                 "forwards|backwards", .key = "nature-change"},
    {NULL}};

static const struct hsr_line outline[] = {
    {"", .part = &hsr_box_sort_part},
    {"", .part = &hsr_network_part},
    {"", .part = &hsr_box_sort_part, .group = HSR_LINES_OF_GROUPS},
    {"    for each edge: does it cross the image of this one, and is it "
     "nearer?",
     HSR_RAISES(HSR_INTERSECT, OF_CONTOUR)},
    {"      minimax test: do the boxes of the images overlap?",
     HSR_RAISES(HSR_OVERLAPS)},
    {"", .part = &hsr_network_part, .group = HSR_LINES_AFTER_CROSSINGS},
    {"    change the nature at each crossing", HSR_RAISES(CHANGED)},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {"edges", "back-facing", "cull", "once a frame"},
    {"faces", "before a vertex", "exhaustive search", "once a cluster"},
    {"edges", "crossing in the picture plane, nearer", "exhaustive search",
     "once an edge"},
    {"faces", "before an edge's end", "cull", "once an edge"},
    {"crossings", "along the edge", "sort", "once an edge"},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(galimberti) = {
    .name = "galimberti",
    .title = "Galimberti and Montanari's natures",
    .authors = "R. Galimberti, U. Montanari",
    .year = 1969,
    .source = "Communications of the ACM 12(4), 1969, 206-211; Sutherland et "
              "al., Computing Surveys 6(1), 1974, \"Edge-Intersection "
              "Algorithms\"",
    .taxonomy = HSR_OBJECT_SPACE_EDGES,
    .coherence = "edge: natures are promoted along edges that share a vertex",
    .restrictions = HSR_TP,
    .lifted = HSR_NP,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_SEGMENTS}},
    .sorts = sorts,
    .parts = uses,
    .counters = counters,
    .outline = outline,
    .options = options,
    .prepare = hsr_network_prepare,
    .render = render,
    .expense = hsr_network_expense,
    .release = hsr_network_release};
