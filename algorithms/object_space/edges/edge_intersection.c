/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The edge-intersection algorithms' common part: see edge_intersection.h. */
#include "algorithms/object_space/edges/edge_intersection.h"
#include "common/answers/kinds/segments.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

double hsr_network_expense(const struct hsr_world *world,
                           const struct hsr_view *view) {
  (void)view;
  double edges = world->mesh.n_corners / 3.0;
  return 4 * edges * edges;
}

/* --- Preparation ---------------------------------------------------------- */

enum hsr_status hsr_network_prepare(const struct hsr_world *world,
                                    const long *option, void **prepared,
                                    struct hsr_error *err) {
  (void)option;
  struct hsr_edges *edges = malloc(sizeof *edges);
  if (!edges)
    return hsr_fail_nomem(err);
  enum hsr_status status = hsr_edges_init(edges, world, err);
  if (status) {
    hsr_edges_free(edges);
    free(edges);
    return status;
  }
  *prepared = edges;
  return HSR_OK;
}

void hsr_network_release(void *prepared) {
  hsr_edges_free(prepared);
  free(prepared);
}

/* --- Relevant and contour edges ------------------------------------------- */

/* Widens the box by a point's image, as far as that is known. */
static void enclose(struct hsr_image_box *box, const struct hsr_sight *sight,
                    uint32_t p) {
  double x = sight->sx[p], y = sight->sy[p];
  bool is_known = sight->ahead[p] && x == x;
  box->x0 = is_known ? fmin(box->x0, x - HSR_DELTA) : -INFINITY;
  box->y0 = is_known ? fmin(box->y0, y - HSR_DELTA) : -INFINITY;
  box->x1 = is_known ? fmax(box->x1, x + HSR_DELTA) : INFINITY;
  box->y1 = is_known ? fmax(box->y1, y + HSR_DELTA) : INFINITY;
}

static struct hsr_image_box box_of(const struct hsr_sight *sight,
                                   const uint32_t *point, uint32_t n) {
  struct hsr_image_box box = {INFINITY, INFINITY, -INFINITY, -INFINITY};
  for (uint32_t k = 0; k < n && box.x0 > -INFINITY; k++)
    enclose(&box, sight, point[k]);
  return box;
}

static void cull_edge(struct hsr_network *network, uint32_t e) {
  const struct hsr_edges *edges = network->edges;
  const struct hsr_sight *sight = &network->sight;
  uint32_t existing = 0;
  network->net[e] = 0;
  for (uint32_t k = edges->side_start[e]; k < edges->side_start[e + 1]; k++) {
    const struct hsr_side *side = &edges->side[k];
    HSR_STEP(network->tally, HSR_EDGE_CULL, hsr_edge_subject(edges, e),
             HSR_FACE(side->face), HSR_NOWHERE, sight->exists[side->face]);
    existing += sight->exists[side->face];
    if (sight->regular[side->face])
      network->net[e] += hsr_inside(sight, side);
  }
  struct hsr_edge_part *part = &network->part[e];
  uint32_t wanted = edges->name[e].implied ? 2 : 1;
  part->relevant =
      existing >= wanted && hsr_sight_picture(sight, e, &part->from, &part->to);
  network->drawn[e] = !part->relevant;
  const uint32_t ends[2] = {edges->a[e], edges->b[e]};
  network->box[e] = box_of(sight, ends, 2);
  if (network->net[e])
    network->contour[network->n_contour++] = e;
}

enum hsr_status hsr_network_init(struct hsr_network *network,
                                 const struct hsr_job *job, long boxes) {
  const struct hsr_edges *edges = job->prepared;
  struct hsr_arena *arena = job->scratch;
  uint32_t n = edges->n, n_points = edges->n_points;
  *network =
      (struct hsr_network){.job = job, .edges = edges, .tally = job->tally};
  enum hsr_status status =
      hsr_sight_init(&network->sight, edges, job->view, arena, job->tally);
  network->net = HSR_NEW(arena, int, n);
  network->contour = HSR_NEW(arena, uint32_t, n);
  network->box = HSR_NEW(arena, struct hsr_image_box, n);
  network->face_box = HSR_NEW(arena, struct hsr_image_box, job->world->n_faces);
  network->part = HSR_NEW(arena, struct hsr_edge_part, n);
  network->drawn = HSR_NEW(arena, bool, n);
  network->known = HSR_NEW_ZEROED(arena, bool, n_points);
  network->invisibility = HSR_NEW(arena, int64_t, n_points);
  network->waiting = HSR_NEW(arena, uint32_t, n_points);
  if (status || !network->net || !network->contour || !network->box ||
      !network->face_box || !network->part || !network->drawn ||
      !network->known || !network->invisibility || !network->waiting)
    return HSR_E_NOMEM;
  for (uint32_t f = 0; f < job->world->n_faces; f++)
    network->face_box[f] = box_of(
        &network->sight, job->world->mesh.vertex + job->world->mesh.start[f],
        hsr_face_size(job->world, f));
  for (uint32_t e = 0; e < n; e++)
    cull_edge(network, e);
  if (hsr_near_boxes_make(&network->faces, network->face_box,
                          network->sight.faces, network->sight.n_faces, false,
                          arena) ||
      hsr_near_boxes_make(&network->loose, network->face_box,
                          network->sight.loose, network->sight.n_loose, false,
                          arena))
    return HSR_E_NOMEM;
  return hsr_near_boxes_make(&network->contours, network->box, network->contour,
                             network->n_contour, boxes == HSR_IN_GROUPS, arena);
}

/* --- Events --------------------------------------------------------------- */

static struct hsr_sight_event *events_of(const struct hsr_network *network) {
  return network->events.items;
}

static enum hsr_status add_event(struct hsr_network *network,
                                 const struct hsr_sight_event *event) {
  if (!hsr_arena_grow(network->job->scratch, &network->events, sizeof *event))
    return HSR_E_NOMEM;
  events_of(network)[network->events.n - 1] = *event;
  return HSR_OK;
}

/* Whether the edge, cut off by the near plane, is ahead where it crosses. */
static bool crosses_ahead(const struct hsr_network *network, uint32_t e,
                          const struct hsr_sight_event *event) {
  const struct hsr_sight *sight = &network->sight;
  const struct hsr_edge_part *part = &network->part[e];
  bool a = sight->ahead[network->edges->a[e]];
  bool b = sight->ahead[network->edges->b[e]];
  if (a && b)
    return true;
  return a ? hsr_sight_compare(sight, e, event, &part->to) < 0
           : hsr_sight_compare(sight, e, event, &part->from) > 0;
}

enum hsr_status hsr_network_cross(struct hsr_network *network, uint32_t e,
                                  uint32_t c, int gained) {
  const struct hsr_edges *edges = network->edges;
  const struct hsr_sight *sight = &network->sight;
  struct hsr_sight_event event = {.at = HSR_AT_EDGE, .subject = c};
  /* On which side of c does e end? */
  event.change =
      gained * hsr_sight_side(sight, edges->a[c], edges->b[c], edges->b[e]);
  hsr_sight_locate(sight, e, &event);
  if (!crosses_ahead(network, e, &event))
    return HSR_OK;
  HSR_STEP(network->tally, HSR_CROSSINGS, hsr_edge_subject(edges, e),
           hsr_edge_subject(edges, c), HSR_NOWHERE, 0);
  return add_event(network, &event);
}

enum hsr_status hsr_network_pierce(struct hsr_network *network, uint32_t e) {
  const struct hsr_edges *edges = network->edges;
  for (uint32_t k = edges->touch_start[e]; k < edges->touch_start[e + 1]; k++) {
    uint32_t f = edges->touch[k].face;
    struct hsr_sight_event event;
    if (!network->sight.regular[f] || hsr_is_corner(edges, edges->a[e], f) ||
        hsr_is_corner(edges, edges->b[e], f))
      continue;
    bool pierces = hsr_sight_pierces(&network->sight, e, f, &event);
    HSR_STEP(network->tally, HSR_PIERCED, hsr_edge_subject(edges, e),
             HSR_FACE(f), HSR_NOWHERE, pierces);
    if (pierces && add_event(network, &event))
      return HSR_E_NOMEM;
  }
  return HSR_OK;
}

/* --- Sorted boxes --------------------------------------------------------- */

static struct hsr_subject subject_of(const void *edges, uint32_t e) {
  return hsr_edge_subject(edges, e);
}

enum hsr_status hsr_network_sort_boxes(struct hsr_network *network,
                                       uint32_t *edges, uint32_t n,
                                       int counter) {
  network->boxes = (struct hsr_corner_boxes){.box = network->box,
                                             .item = edges,
                                             .n = n,
                                             .tally = network->tally,
                                             .sort = counter,
                                             .search = counter,
                                             .subject = subject_of,
                                             .context = network->edges};
  return hsr_corner_boxes_sort(&network->boxes, network->job->scratch);
}

void hsr_network_count_groups(const struct hsr_network *network, uint32_t e,
                              const struct hsr_near_boxes *all,
                              const uint32_t *edge) {
  for (uint32_t g = 0; g < hsr_near_boxes_n_groups(all); g++)
    HSR_STEP(network->tally, HSR_BOX_GROUPS,
             hsr_edge_subject(network->edges, e),
             hsr_edge_subject(network->edges, edge[g * HSR_BOX_GROUP]),
             HSR_NOWHERE, all->group_near[g]);
}

void hsr_network_count_apart(const struct hsr_network *network, uint32_t e,
                             const struct hsr_near_boxes *all,
                             const uint32_t *edge, uint32_t from, uint32_t to) {
  if (!HSR_LISTENED(network->tally) && !all->in_groups) {
    HSR_STEPS(network->tally, HSR_INTERSECT, to - from);
    return;
  }
  for (uint32_t k = from; k < to; k++)
    if (hsr_near_boxes_is_compared(all, k))
      hsr_network_compared(network, e, edge[k], HSR_BOXES_APART);
}

uint32_t hsr_network_find_near(const struct hsr_network *network, uint32_t e) {
  return hsr_corner_boxes_find(&network->boxes, &network->box[e],
                               hsr_edge_subject(network->edges, e));
}

/* --- The sort along an edge ----------------------------------------------- */

static bool is_before(const struct hsr_network *network, uint32_t e,
                      const struct hsr_sight_event *a,
                      const struct hsr_sight_event *b) {
  bool before = hsr_sight_compare(&network->sight, e, a, b) < 0;
  HSR_STEP(network->tally, HSR_SORT_ALONG, hsr_event_subject(network, a),
           hsr_event_subject(network, b), HSR_NOWHERE, before);
  return before;
}

/* For few events, which is the usual case. */
static void sort_by_insertion(const struct hsr_network *network, uint32_t e,
                              struct hsr_sight_event *event, size_t n) {
  for (size_t k = 1; k < n; k++) {
    struct hsr_sight_event entering = event[k];
    size_t place = k;
    for (; place > 0 && is_before(network, e, &entering, &event[place - 1]);
         place--)
      event[place] = event[place - 1];
    event[place] = entering;
  }
}

static void sift(const struct hsr_network *network, uint32_t e,
                 struct hsr_sight_event *heap, size_t k, size_t n) {
  struct hsr_sight_event sinking = heap[k];
  for (size_t child; (child = 2 * k + 1) < n; k = child) {
    if (child + 1 < n && is_before(network, e, &heap[child], &heap[child + 1]))
      child++;
    if (!is_before(network, e, &sinking, &heap[child]))
      break;
    heap[k] = heap[child];
  }
  heap[k] = sinking;
}

static void sort_by_heap(const struct hsr_network *network, uint32_t e,
                         struct hsr_sight_event *event, size_t n) {
  for (size_t k = n / 2; k-- > 0;)
    sift(network, e, event, k, n);
  for (size_t last = n; last-- > 1;) {
    struct hsr_sight_event greatest = event[0];
    event[0] = event[last];
    event[last] = greatest;
    sift(network, e, event, 0, last);
  }
}

void hsr_network_sort_along(const struct hsr_network *network, uint32_t e) {
  enum { FEW = 24 };
  size_t n = network->events.n;
  if (n <= FEW)
    sort_by_insertion(network, e, events_of(network), n);
  else
    sort_by_heap(network, e, events_of(network), n);
}

/* --- Drawing an edge ------------------------------------------------------ */

enum hsr_status hsr_network_interval(struct hsr_network *network, uint32_t e,
                                     double t0, double t1,
                                     uint32_t invisibility) {
  struct hsr_segment segment = {.edge = network->edges->name[e],
                                .invisibility = invisibility,
                                .t0 = t0,
                                .t1 = fmax(t0, t1)};
  hsr_edge_point(network->edges, e, segment.t0, segment.from);
  hsr_edge_point(network->edges, e, segment.t1, segment.to);
  HSR_ACCEPTED(network->tally, HSR_DRAWN, hsr_edge_subject(network->edges, e),
               HSR_NOTHING, HSR_NOWHERE, &segment);
  return hsr_drawing_add(hsr_answer_drawing_of(network->job->answer), &segment);
}

static enum hsr_status add_interval(struct hsr_network *network, uint32_t e,
                                    double t0, double t1, int64_t count,
                                    bool visible_only) {
  return hsr_network_interval(network, e, t0, t1,
                              visible_only ? count > 0 : (uint32_t)count);
}

/* Draws the part of the edge that is in the picture. `count` is its
 * invisibility before the first event. */
static enum hsr_status draw_part(struct hsr_network *network, uint32_t e,
                                 int64_t count, bool visible_only) {
  const struct hsr_edge_part *part = &network->part[e];
  const struct hsr_sight_event *event = events_of(network);
  size_t n = network->events.n, k = 0;
  hsr_network_sort_along(network, e);
  for (; k < n &&
         hsr_sight_compare(&network->sight, e, &event[k], &part->from) <= 0;
       k++)
    count += event[k].change;
  double t = part->from.t;
  while (k < n &&
         hsr_sight_compare(&network->sight, e, &event[k], &part->to) < 0) {
    /* Events at one place happen at once. */
    size_t first = k;
    int change = event[k++].change;
    for (; k < n &&
           hsr_sight_compare(&network->sight, e, &event[first], &event[k]) == 0;
         k++)
      change += event[k].change;
    if (!change)
      continue;
    if (add_interval(network, e, t, event[first].t, count, visible_only))
      return HSR_E_NOMEM;
    t = fmax(t, event[first].t);
    count += change;
  }
  return add_interval(network, e, t, part->to.t, count, visible_only);
}

/* The outcomes of HSR_APART. */
enum { IN_PLANE, LOOSE_NEAR, LOOSE_APART };

/* Takes face f, in whose plane the edge lies, away where it was counted. */
static enum hsr_status take_away(struct hsr_network *network, uint32_t e,
                                 uint32_t f, int64_t *count) {
  bool hidden;
  size_t first = network->events.n;
  HSR_STEP(network->tally, HSR_APART, hsr_edge_subject(network->edges, e),
           HSR_FACE(f), HSR_NOWHERE, IN_PLANE);
  if (hsr_sight_face(&network->sight, e, f, network->job->scratch,
                     &network->events, &hidden))
    return HSR_E_NOMEM;
  *count -= hidden;
  for (size_t k = first; k < network->events.n; k++)
    events_of(network)[k].change *= -1;
  return HSR_OK;
}

/* Puts loose face f, whose box is near, to edge e. */
static enum hsr_status put_near(struct hsr_network *network, uint32_t e,
                                uint32_t f, bool *hidden) {
  const struct hsr_sight *sight = &network->sight;
  *hidden = false;
  HSR_STEP(network->tally, HSR_APART, hsr_edge_subject(network->edges, e),
           HSR_FACE(f), HSR_NOWHERE, LOOSE_NEAR);
  if (hsr_is_own(network->edges, e, f) || hsr_sight_in_plane(sight, e, f))
    return HSR_OK;
  return hsr_sight_face(sight, e, f, network->job->scratch, &network->events,
                        hidden);
}

/* Counts the comparison of e's box with those of loose faces that are apart. */
static void count_loose(const struct hsr_network *network, uint32_t e,
                        uint32_t from, uint32_t to) {
  if (!HSR_LISTENED(network->tally)) {
    HSR_STEPS(network->tally, HSR_APART, to - from);
    return;
  }
  for (uint32_t k = from; k < to; k++)
    HSR_STEP(network->tally, HSR_APART, hsr_edge_subject(network->edges, e),
             HSR_FACE(network->sight.loose[k]), HSR_NOWHERE, LOOSE_APART);
}

enum hsr_status hsr_network_put_loose(struct hsr_network *network, uint32_t e,
                                      void (*hides)(void *context, uint32_t f),
                                      void *context) {
  struct hsr_near_boxes *loose = &network->loose;
  hsr_near_boxes_find(loose, &network->box[e]);
  for (uint32_t k, from = 0; from < loose->n; from = k + 1) {
    bool hidden;
    k = hsr_near_boxes_next(loose, from, loose->n);
    if (HSR_COUNTING)
      count_loose(network, e, from, k);
    if (k == loose->n)
      break;
    if (put_near(network, e, network->sight.loose[k], &hidden))
      return HSR_E_NOMEM;
    if (hidden)
      hides(context, network->sight.loose[k]);
  }
  return HSR_OK;
}

static void count_one(void *count, uint32_t f) {
  (void)f;
  ++*(int64_t *)count;
}

/* Takes away the faces in whose plane the edge lies, and adds the loose ones.
 */
static enum hsr_status count_faces_apart(struct hsr_network *network,
                                         uint32_t e, int64_t *count) {
  const struct hsr_edges *edges = network->edges;
  const struct hsr_sight *sight = &network->sight;
  for (uint32_t k = edges->touch_start[e]; k < edges->touch_start[e + 1]; k++) {
    const struct hsr_touch *touch = &edges->touch[k];
    if (touch->in_plane && sight->regular[touch->face] &&
        take_away(network, e, touch->face, count))
      return HSR_E_NOMEM;
  }
  for (uint32_t k = edges->side_start[e];
       edges->name[e].implied && k < edges->side_start[e + 1]; k++)
    if (sight->regular[edges->side[k].face] &&
        take_away(network, e, edges->side[k].face, count))
      return HSR_E_NOMEM;
  return hsr_network_put_loose(network, e, count_one, count);
}

/* Whether no place of the edge can be visible, because its crossings are too
 * few to bring the invisibility down to zero. */
static bool is_hidden_throughout(const struct hsr_network *network,
                                 int64_t count) {
  for (size_t k = 0; k < network->events.n; k++)
    if (events_of(network)[k].change < 0)
      count += events_of(network)[k].change;
  return count > 0;
}

static enum hsr_status draw_edge(struct hsr_network *network, uint32_t e,
                                 int64_t count, bool visible_only) {
  if (count_faces_apart(network, e, &count))
    return HSR_E_NOMEM;
  if (is_hidden_throughout(network, count)) {
    HSR_STEP(network->tally, HSR_SAVED, hsr_edge_subject(network->edges, e),
             HSR_NOTHING, HSR_NOWHERE, 0);
    if (visible_only)
      return add_interval(network, e, network->part[e].from.t,
                          network->part[e].to.t, 1, true);
  }
  return draw_part(network, e, count, visible_only);
}

/* --- Promotion ------------------------------------------------------------ */

/* How many of the faces with a corner at the end p of edge e hide it there. */
static int64_t correction(const struct hsr_network *network, uint32_t e,
                          uint32_t p) {
  const struct hsr_edges *edges = network->edges;
  int64_t hiding = 0;
  if (p >= edges->world->mesh.n_vertices)
    return 0;
  for (uint32_t k = edges->corner_start[p]; k < edges->corner_start[p + 1];
       k++) {
    struct hsr_corner corner = edges->corner[k];
    if (!network->sight.regular[corner.face] ||
        hsr_is_own(edges, e, corner.face))
      continue;
    bool hides = hsr_sight_corner_hides(&network->sight, e, p, corner);
    HSR_STEP(network->tally, HSR_CORRECT, hsr_edge_subject(edges, e),
             HSR_FACE(corner.face), HSR_NOWHERE, hides);
    hiding += hides;
  }
  return hiding;
}

/* Counts the comparison of p with the boxes of faces that do not hold it. */
static void count_out(const struct hsr_network *network, uint32_t p,
                      uint32_t from, uint32_t to) {
  if (!HSR_LISTENED(network->tally)) {
    HSR_STEPS(network->tally, HSR_INITIAL, to - from);
    return;
  }
  for (uint32_t k = from; k < to; k++)
    HSR_STEP(network->tally, HSR_INITIAL, hsr_point_subject(network->edges, p),
             HSR_FACE(network->sight.faces[k]), HSR_NOWHERE, 0);
}

/* Whether regular face f, whose box holds point p, hides it. */
static bool is_hider(const struct hsr_network *network, uint32_t f,
                     uint32_t p) {
  const struct hsr_sight *sight = &network->sight;
  bool hides = !hsr_is_corner(network->edges, p, f) &&
               hsr_sight_covers(sight, f, p) && hsr_sight_behind(sight, f, p);
  HSR_STEP(network->tally, HSR_INITIAL, hsr_point_subject(network->edges, p),
           HSR_FACE(f), HSR_NOWHERE, hides);
  HSR_STEP(network->tally, HSR_SEARCHED, hsr_point_subject(network->edges, p),
           HSR_FACE(f), HSR_NOWHERE, hides);
  return hides;
}

void hsr_network_search(struct hsr_network *network, uint32_t p,
                        void (*found)(void *context, uint32_t f),
                        void *context) {
  struct hsr_near_boxes *faces = &network->faces;
  double x = network->sight.sx[p], y = network->sight.sy[p];
  struct hsr_image_box box = {x - HSR_DELTA, y - HSR_DELTA, x + HSR_DELTA,
                              y + HSR_DELTA};
  hsr_near_boxes_find(faces, &box);
  for (uint32_t k, from = 0; from < faces->n; from = k + 1) {
    k = hsr_near_boxes_next(faces, from, faces->n);
    if (HSR_COUNTING)
      count_out(network, p, from, k);
    if (k < faces->n && is_hider(network, network->sight.faces[k], p))
      found(context, network->sight.faces[k]);
  }
}

void hsr_network_wait(struct hsr_network *network, uint32_t p, uint32_t e) {
  HSR_STEP(network->tally, HSR_PROMOTED, hsr_point_subject(network->edges, p),
           hsr_edge_subject(network->edges, e), HSR_NOWHERE, 0);
  network->known[p] = true;
  network->waiting[network->n_waiting++] = p;
}

/* Follows all edges that end in vertex p, whose turn it is. */
static enum hsr_status follow_edges(struct hsr_network *network,
                                    const struct hsr_promotion *promotion,
                                    uint32_t p) {
  const struct hsr_edges *edges = network->edges;
  if (p >= edges->world->mesh.n_vertices)
    return HSR_OK;
  for (uint32_t k = edges->end_start[p]; k < edges->end_start[p + 1]; k++) {
    uint32_t e = edges->end[k];
    if (network->drawn[e])
      continue;
    network->drawn[e] = true;
    network->events.n = 0;
    if (promotion->follow(promotion->context, network, e, p))
      return HSR_E_NOMEM;
  }
  return HSR_OK;
}

/* One cluster: all edges that can be reached from edge e. */
static enum hsr_status draw_cluster(struct hsr_network *network,
                                    const struct hsr_promotion *promotion,
                                    uint32_t e) {
  const struct hsr_edges *edges = network->edges;
  uint32_t p = network->sight.ahead[edges->a[e]] ? edges->a[e] : edges->b[e];
  HSR_STEP(network->tally, HSR_SEARCHES, hsr_edge_subject(edges, e),
           hsr_point_subject(edges, p), HSR_NOWHERE, 0);
  network->known[p] = true;
  if (promotion->search(promotion->context, network, p))
    return HSR_E_NOMEM;
  if (edges->name[e].implied) { /* alone: no other edge ends there */
    network->drawn[e] = true;
    network->events.n = 0;
    if (promotion->follow(promotion->context, network, e, p))
      return HSR_E_NOMEM;
  } else if (follow_edges(network, promotion, p)) {
    return HSR_E_NOMEM;
  }
  while (network->n_waiting) {
    p = network->waiting[--network->n_waiting];
    promotion->resume(promotion->context, network, p);
    if (follow_edges(network, promotion, p))
      return HSR_E_NOMEM;
  }
  return HSR_OK;
}

enum hsr_status hsr_network_promote(struct hsr_network *network,
                                    const struct hsr_promotion *promotion) {
  for (uint32_t e = 0; e < network->edges->n; e++)
    if (!network->drawn[e] && draw_cluster(network, promotion, e))
      return HSR_E_NOMEM;
  return hsr_drawing_sort(hsr_answer_drawing_of(network->job->answer)) ||
                 network->tally->out_of_memory
             ? HSR_E_NOMEM
             : HSR_OK;
}

/* --- Promotion of a number ------------------------------------------------ */

/* What hides a vertex is a number, which network->invisibility keeps. */
static enum hsr_status search_faces(void *context, struct hsr_network *network,
                                    uint32_t p) {
  (void)context;
  network->invisibility[p] = 0;
  hsr_network_search(network, p, count_one, &network->invisibility[p]);
  return HSR_OK;
}

static void resume(void *context, struct hsr_network *network, uint32_t p) {
  (void)context;
  (void)network;
  (void)p;
}

static enum hsr_status follow(void *context, struct hsr_network *network,
                              uint32_t e, uint32_t p) {
  const struct hsr_intersector *intersector = context;
  const struct hsr_edges *edges = network->edges;
  uint32_t other = edges->a[e] == p ? edges->b[e] : edges->a[e];
  if (intersector->cross(intersector->context, network, e) ||
      hsr_network_pierce(network, e))
    return HSR_E_NOMEM;
  int64_t change = 0;
  for (size_t k = 0; k < network->events.n; k++)
    change += events_of(network)[k].change;
  int64_t here = network->invisibility[p] + correction(network, e, p);
  int64_t there = p == edges->a[e] ? here + change : here - change;
  if (hsr_network_wants(network, other)) {
    network->invisibility[other] = there - correction(network, e, other);
    HSR_COMPUTED(network->tally, HSR_HIDING, network->invisibility[other]);
    hsr_network_wait(network, other, e);
  }
  return draw_edge(network, e, p == edges->a[e] ? here : there,
                   intersector->visible_only);
}

enum hsr_status hsr_network_draw(struct hsr_network *network,
                                 const struct hsr_intersector *intersector) {
  struct hsr_intersector own = *intersector;
  return hsr_network_promote(network,
                             &(struct hsr_promotion){.search = search_faces,
                                                     .resume = resume,
                                                     .follow = follow,
                                                     .context = &own});
}

enum hsr_status hsr_network_render(const struct hsr_job *job,
                                   const struct hsr_intersector *intersector,
                                   struct hsr_error *err) {
  struct hsr_network network;
  long boxes = job->option[HSR_NETWORK_BOXES];
  enum hsr_status status = hsr_network_init(&network, job, boxes);
  if (!status && boxes == HSR_BY_CORNER)
    status = hsr_network_sort_boxes(&network, network.contour,
                                    network.n_contour, HSR_BOX_SORT);
  if (!status)
    status = hsr_network_draw(&network, intersector);
  hsr_sight_free(&network.sight);
  return status ? hsr_fail_nomem(err) : HSR_OK;
}

/* --- What it counts ------------------------------------------------------- */

static const struct hsr_counter counters[] = {
    {"edge cull",
     "sides of faces looked at for relevant and contour "
     "edges",
     HSR_COMPARE, HSR_OF_EDGE, HSR_OF_FACE, "a back, or edge on|may be seen",
     .key = "edge-cull", .outcome_keys = "|exists"},
    {"initial visibility", "faces compared with a vertex in the searches",
     HSR_COMPARE, HSR_OF_VERTEX, HSR_OF_FACE, "does not hide|hides",
     .key = "initial-visibility"},
    {"edge intersection", "pairs of edges that were compared", HSR_COMPARE,
     HSR_OF_EDGE, HSR_OF_EDGE, HSR_CROSSING_OUTCOMES,
     .key = "edge-intersection", .outcome_keys = "boxes"},
    {"correction", "faces with a corner at an edge's end compared with it",
     HSR_COMPARE, HSR_OF_EDGE, HSR_OF_FACE, "does not hide|hides"},
    {"sort along edge", "comparisons of places along an edge", HSR_COMPARE,
     HSR_OF_EDGE, HSR_OF_EDGE, "not before|before"},
    {"searches", "searches of all faces: clusters", HSR_ACTIVATE, HSR_OF_EDGE,
     HSR_OF_VERTEX, .key = "search"},
    {"crossings", "nearer contour edges that an edge crosses", HSR_ACTIVATE,
     HSR_OF_EDGE, HSR_OF_EDGE},
    {"pierced faces", "faces compared with an edge that touches them",
     HSR_COMPARE, HSR_OF_EDGE, HSR_OF_FACE, "does not pierce|pierces"},
    {"sorts to save", "edges that cannot be visible anywhere", HSR_REJECT,
     HSR_OF_EDGE, HSR_OF_NOTHING},
    {"faces apart", "faces in whose plane an edge lies, and loose ones",
     HSR_COMPARE, HSR_OF_EDGE, HSR_OF_FACE, "taken away|near|boxes apart",
     .outcome_keys = "||boxes"},
    {"promoted", "vertices to which visibility is promoted", HSR_ACTIVATE,
     HSR_OF_VERTEX, HSR_OF_EDGE, .key = "promoted"},

    {"intervals drawn", "intervals of edges added to the drawing", HSR_ACCEPT,
     HSR_OF_EDGE, HSR_OF_NOTHING, .key = "interval-drawn"},
    {"boxes overlap", "pairs of edges that the minimax test leaves",
     HSR_COMPARE, HSR_OF_EDGE, HSR_OF_EDGE, .key = "boxes-overlap",
     .outcome_keys = "boxes"},
    {"faces in line", "faces whose boxes hold the vertex of a search",
     HSR_COMPARE, HSR_OF_VERTEX, HSR_OF_FACE, "does not hide|hides"},
    {NULL}};

/* Of modules that compare boxes of edges. */
static const struct hsr_counter box_counters[] = {
    {"box sort",
     "comparisons to sort boxes of edges, and to find among them those near an "
     "edge",
     HSR_COMPARE, HSR_OF_EDGE, HSR_OF_EDGE, "not there|there"},
    {"box groups", "groups of boxes of edges compared with the box of an edge",
     HSR_COMPARE, HSR_OF_EDGE, HSR_OF_EDGE, "apart|near"},
    {NULL}};

static double predict_edge_cull(const struct hsr_table1 *t) {
  return t->E_t;
}
static double predict_initial(const struct hsr_table1 *t) {
  return 100 * t->C_t * t->F_r;
}
static double predict_intersection(const struct hsr_table1 *t) {
  return 30 * t->E_s * t->E_c;
}
static double predict_correction(const struct hsr_table1 *t) {
  return 30 * 2 * t->E_s * 3;
}
/* The survey prints E_s in its tables: there X_r / E_s is less than 1, and the
 * logarithm less than 0. */
static double predict_sort_along(const struct hsr_table1 *t) {
  double crossings = t->X_r / t->E_s;
  return t->E_s * fmax(1, crossings * log2(crossings));
}

static const struct hsr_step steps[] = {
    {"back and contour cull", HSR_EDGE_CULL, HSR_KIND_CULL, "E_t",
     predict_edge_cull},
    {"initial visibility",
     HSR_SEARCHED,
     HSR_KIND_VERTEX_FACE,
     "100 C_t F_r",
     predict_initial,
     {{HSR_INITIAL, HSR_KIND_BOX}}},
    {"edge intersection", HSR_OVERLAPS, HSR_KIND_EDGES, "30 E_s E_c",
     predict_intersection},
    {"invisibility correction", HSR_CORRECT, HSR_KIND_CORNER, "30 (2 E_s 3)",
     predict_correction},
    {"sort along edge", HSR_SORT_ALONG, HSR_KIND_NUMBERS,
     "E_s (X_r/E_s) log2 (X_r/E_s), or E_s where that is less",
     predict_sort_along},
    {NULL}};

/* Every pair of edges has its boxes compared, unless these are sorted. */
static const struct hsr_step box_steps[] = {
    {"edge intersection",
     HSR_INTERSECT,
     HSR_KIND_BOX,
     NULL,
     NULL,
     {{HSR_BOX_SORT, HSR_KIND_BOX}, {HSR_BOX_GROUPS, HSR_KIND_BOX}}},
    {NULL}};

static const struct hsr_line lines_before[] = {
    {"for each side of a face: cull back edges, mark contour edges",
     HSR_RAISES(HSR_EDGE_CULL)},
    {"for each cluster of edges that can be reached from one another"},
    {"  take a vertex of one of its edges", HSR_RAISES(HSR_SEARCHES)},
    {"  initial visibility: for each face, does it hide the vertex?",
     HSR_RAISES(HSR_INITIAL, HSR_SEARCHED)},
    {"  for each relevant edge that ends at a vertex whose visibility is "
     "known"},
    {NULL}};

static const struct hsr_line lines_after[] = {
    {"      note the crossing", HSR_RAISES(HSR_CROSSINGS)},
    {"    for each face that it touches: does it pierce the face?",
     HSR_RAISES(HSR_PIERCED)},
    {"    invisibility correction: for each face with a corner at its end, "
     "does it hide the edge?",
     HSR_RAISES(HSR_CORRECT)},
    {"    promote visibility to the vertex at its other end",
     HSR_RAISES(HSR_PROMOTED)},
    {"      with what hides it there", HSR_RAISES(HSR_HIDING)},
    {"    compare it with loose faces, and with those whose plane holds it",
     HSR_RAISES(HSR_APART)},
    {"    can it be visible anywhere?", HSR_RAISES(HSR_SAVED)},
    {"    sort the crossings along the edge", HSR_RAISES(HSR_SORT_ALONG)},
    {"    draw an interval up to each change of invisibility",
     HSR_RAISES(HSR_DRAWN)},
    {NULL}};

const struct hsr_part hsr_network_part = {
    HSR_PART_NETWORK, counters, steps, NULL, {lines_before, lines_after}};

static const struct hsr_line box_lines[] = {
    {"with sorted boxes: sort edges by the upper left corners of their boxes, "
     "and "
     "find those near an edge",
     HSR_RAISES(HSR_BOX_SORT)},
    {NULL}};

static const struct hsr_line group_lines[] = {
    {"    with groups: which groups of them have boxes near that of the edge?",
     HSR_RAISES(HSR_BOX_GROUPS)},
    {NULL}};

const struct hsr_part hsr_box_sort_part = {
    HSR_PART_BOX_SORT, box_counters, box_steps, NULL, {box_lines, group_lines}};

static const struct hsr_counter hiding_numbers[] = {
    {"hiding", "faces that hide those vertices, in all", HSR_ACTIVATE,
     HSR_OF_VERTEX, HSR_OF_FACE, .computed = true},
    {NULL}};
static const struct hsr_counter hiding_sets[] = {
    {"hiding", "faces that hide those vertices, in all", HSR_ACTIVATE,
     HSR_OF_VERTEX, HSR_OF_FACE},
    {NULL}};
const struct hsr_part hsr_hiding_number_part = {
    HSR_PART_HIDING, hiding_numbers, NULL, NULL, {NULL}};
const struct hsr_part hsr_hiding_set_part = {
    HSR_PART_HIDING, hiding_sets, NULL, NULL, {NULL}};
