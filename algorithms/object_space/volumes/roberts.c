/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Roberts' hidden-line algorithm.
 *
 * Source      L. G. Roberts, "Machine Perception of Three-Dimensional Solids",
 *             MIT Lincoln Laboratory TR 315, 1963; Sutherland et al. 1974,
 *             "L. G. Roberts (1963)", eq. 7 and 8, and appendix B.
 * Notation    relevant edge E1 E2 -> e, from point a to point b; alpha -> t;
 *             beta -> eliminated, see below; object -> body and volume;
 *             F_ij -> planes of volume j; unobscured portions -> fragments
 * Programme   P = (1 - alpha) E1 + alpha E2 + beta (towards the eye), beta > 0,
 *             is to be inside of all planes of a convex volume. Fourier's
 *             elimination removes beta: a front plane, which has the eye
 *             outside, gives a lower bound of beta; any other plane gives an
 *             upper bound or none. Alpha is good if no lower bound is above an
 *             upper one. This means two things: E1 E2 at alpha is behind every
 *             front plane; and for every pair of a front plane and another, it
 *             is on the inner side of the plane through the eye and the line
 *             where the two meet. The pairs that meet in the volume's contour
 *             imply the other pairs. What remains are conditions linear in
 *             alpha. They narrow the fragment down to its hidden part.
 * Invariant   The fragments on the stack, those found visible and those found
 *             hidden are together the part of the edge that is in the picture.
 *             No volume before its `next` hides a fragment on the stack.
 * Ties        The edge is displaced (common/lines/sight/sight.h). A volume does
 *             not hide an edge in one of its front planes; so no edge is hidden
 *             by the front of its own volume.
 * Departures  The program divides concave solids (common/lines/volumes.h). Each
 *             face is a volume without thickness in open objects, and where the
 *             near plane or the eye is in an object. A face that is not flat,
 *             or that is cut, is compared with the edge by itself, by hsr_sight_face.
 *             Edges may pierce volumes, and implied edges are drawn; the
 *             paper's environments have neither.
 * Minimax     Three tests of boxes, each once. "Whole collections of objects" are
 *             eliminated "from comparison against other objects": a body, which
 *             is a collection of convex volumes, from all the edges of another.
 *             Then an edge is compared with the bodies that are left, and with
 *             their volumes. What the paper leaves open is what a collection is
 *             that is not convex; a body is what the scene has of the kind.
 *             Fragments are put to the volumes that the tests leave of the edge
 * Options     boxes=corner: volumes sorted by the upper left corners of their
 *             boxes, as Sutherland et al. propose of objects (corner_boxes.h).
 *             An edge is compared with those whose boxes overlap its own; whole bodies
 *             are not looked at
 * Cost        Table III: back-edge cull E_t, clipping cull 100 E_s, edge/volume
 *             test 100 E_s f C_t, f = 4; it grows as the square of the
 *             environment. Alone, a face that is not convex is as many volumes
 *             as it has convex parts: with n corners, up to n of them for each
 *             of its n edges */
#include "algorithms/engines/boxes/near_boxes.h"
#include "common/answers/kinds/segments.h"
#include "common/lines/sight/sight.h"
#include "common/lines/volumes.h"

#include <math.h>
#include <stdlib.h>

enum {
  BACK_CULL,
  CLIP_CULL,
  MINIMAX,
  COLLECTIONS,
  VOLUMES,
  OWN,
  TEST,
  WHOLE,
  UNTOUCHED,
  ONE_LEFT,
  TWO_LEFT,
  FRAGMENTS,
  CONDITIONS,
  APART,
  TAKEN_APART,
  DRAWN,
  BOX_SORT,
  BOX_SEARCH,
  PAIRS
};

enum { BOXES }; /* option */
static const struct hsr_option options[] = {
    [BOXES] = {"boxes", "how volumes are sorted", hsr_box_sortings, 0,
               HSR_BY_CORNER, HSR_NOT_SORTED},
    {NULL}};

/* The outcomes of a minimax test. */
enum { BODY_IN_THE_WAY, BODY_OUT, VOLUME_IN_THE_WAY, VOLUME_OUT };

/* A condition on alpha: the edge is on this side of a plane, or of a line. The
 * values of alpha that meet it are found once an edge. */
struct condition {
  uint32_t subject;
  int side;
  uint32_t edge; /* the last that was put to the condition; UINT32_MAX: none */
  struct hsr_sight_half half; /* of that edge */
};

/* A volume that an edge may be behind. Its conditions are contour[first_line],
 * ... and front[first_plane], ... up to the next one's. */
struct volume {
  struct hsr_extent extent; /* of a part of a face: that of the face */
  struct hsr_image_box box; /* the volume's own; no greater */
  uint32_t first_line, first_plane;
  uint32_t collection;
};

/* The volumes of one body: from `first` up to the next one's. */
struct collection {
  struct hsr_extent extent;
  uint32_t first;
};

struct fragment {
  struct hsr_sight_event from, to;
  uint32_t next; /* the place in `way` of the volume that it is put to next */
};

/* View-independent. */
struct environment {
  struct hsr_edges edges;
  struct hsr_volumes volumes;
};

struct frame {
  const struct hsr_job *job;
  const struct hsr_edges *edges;
  const struct hsr_volumes *volumes;
  struct hsr_tally *tally;
  struct hsr_sight sight;

  uint32_t *apart, n_apart; /* faces that are no volumes in this view */
  struct hsr_near_boxes apart_boxes; /* of these */
  bool *outside;              /* by plane of a volume: the eye is outside */
  struct hsr_growing volume;  /* struct volume; one more ends the last one */
  struct hsr_growing bodies;  /* struct collection; likewise */
  struct hsr_growing contour; /* struct condition */
  struct hsr_growing front;   /* struct condition */

  struct hsr_growing stack, visible; /* struct fragment, of the current edge */
  struct hsr_growing kept;           /* memory for the next `visible` */
  struct hsr_growing events;         /* of a face apart */

  /* Edges are taken body by body. */
  uint32_t *edge_of_body, *first_edge; /* the edges of body b are
                        edge_of_body[first_edge[b]] to before that of b + 1 */
  struct hsr_near_boxes body_boxes;    /* of all bodies */
  uint32_t *other, n_others; /* bodies that the current one is not apart from */
  uint32_t next_other;       /* the next that the current edge is put to */

  struct hsr_near_boxes near;    /* the boxes of the volumes */
  struct hsr_corner_boxes boxes; /* of the volumes, if they are sorted */
  bool sorted;
  uint32_t n_near; /* how many of the sorted ones are near the current edge */
  uint32_t *way, n_way; /* of the current edge: the volumes that may be in the
                           way, as far as they are found */
};

static bool push(const struct frame *frame, struct hsr_growing *list,
                 struct fragment fragment) {
  if (!hsr_arena_grow(frame->job->scratch, list, sizeof fragment))
    return false;
  ((struct fragment *)list->items)[list->n - 1] = fragment;
  return true;
}

/* --- Preparation ---------------------------------------------------------- */

static void release(void *prepared) {
  struct environment *environment = prepared;
  hsr_volumes_free(&environment->volumes);
  hsr_edges_free(&environment->edges);
  free(environment);
}

static enum hsr_status prepare(const struct hsr_world *world,
                               const long *option, void **prepared,
                               struct hsr_error *err) {
  (void)option;
  struct environment *environment = calloc(1, sizeof *environment);
  if (!environment)
    return hsr_fail_nomem(err);
  enum hsr_status status = hsr_edges_init(&environment->edges, world, err);
  if (!status)
    status = hsr_volumes_init(&environment->volumes, &environment->edges, err);
  if (status)
    release(environment);
  else
    *prepared = environment;
  return status;
}

/* --- Minimax tests -------------------------------------------------------- */

static const struct hsr_extent nowhere = {INFINITY,  INFINITY, -INFINITY,
                                          -INFINITY, INFINITY, -INFINITY};

static void enclose(struct hsr_extent *extent, const struct hsr_sight *sight,
                    uint32_t p) {
  double x = sight->sx[p], y = sight->sy[p], q = sight->q[p];
  double error = 0x1p-41 * fabs(q) + sight->q_error;
  bool is_known = sight->ahead[p] && x == x;
  extent->x0 = is_known ? fmin(extent->x0, x - HSR_DELTA) : -INFINITY;
  extent->y0 = is_known ? fmin(extent->y0, y - HSR_DELTA) : -INFINITY;
  extent->x1 = is_known ? fmax(extent->x1, x + HSR_DELTA) : INFINITY;
  extent->y1 = is_known ? fmax(extent->y1, y + HSR_DELTA) : INFINITY;
  extent->farthest = is_known ? fmin(extent->farthest, q - error) : -INFINITY;
  extent->nearest = is_known ? fmax(extent->nearest, q + error) : INFINITY;
}

static struct hsr_extent extent_of(const struct hsr_sight *sight,
                                   const uint32_t *point, uint32_t n) {
  struct hsr_extent extent = nowhere;
  for (uint32_t k = 0; k < n && extent.x1 < INFINITY; k++)
    enclose(&extent, sight, point[k]);
  return extent;
}

/* Of volume v, a part of a solid. */
static struct hsr_extent extent_of_part(const struct frame *frame, uint32_t v) {
  const struct hsr_volumes *volumes = frame->volumes;
  const struct hsr_space *space =
      &volumes->space[v - volumes->flat[frame->edges->world->n_faces]];
  return hsr_sight_enclose(&frame->sight, space->lo, space->hi);
}

static bool is_out_of_the_way(const struct hsr_extent *edge,
                              const struct hsr_extent *object) {
  return object->x1 < edge->x0 || edge->x1 < object->x0 ||
         object->y1 < edge->y0 || edge->y1 < object->y0 ||
         object->nearest < edge->farthest;
}

static struct hsr_image_box image_box(const struct hsr_extent *extent) {
  return (struct hsr_image_box){extent->x0, extent->y0, extent->x1, extent->y1};
}

/* Of volume v, a convex part of a face: its rims are the sides of that part. */
static struct hsr_image_box box_of_flat(const struct frame *frame, uint32_t v) {
  const struct hsr_volumes *volumes = frame->volumes;
  struct hsr_extent extent = nowhere;
  for (uint32_t r = volumes->rim_start[v]; r < volumes->rim_start[v + 1]; r++)
    enclose(&extent, &frame->sight, volumes->line[r].a);
  return image_box(&extent);
}

/* --- What is in the way --------------------------------------------------- */

static bool add_condition(struct frame *frame, struct hsr_growing *list,
                          uint32_t subject, int side) {
  if (!hsr_arena_grow(frame->job->scratch, list, sizeof(struct condition)))
    return false;
  ((struct condition *)list->items)[list->n - 1] =
      (struct condition){.subject = subject, .side = side, .edge = UINT32_MAX};
  return true;
}

static bool begin_volume(struct frame *frame, const struct hsr_extent *extent,
                         struct hsr_image_box box) {
  if (!hsr_arena_grow(frame->job->scratch, &frame->volume,
                      sizeof(struct volume)))
    return false;
  ((struct volume *)frame->volume.items)[frame->volume.n - 1] =
      (struct volume){*extent, box, (uint32_t)frame->contour.n,
                      (uint32_t)frame->front.n, (uint32_t)frame->bodies.n - 1};
  return true;
}

/* Adds volume v: its front planes, and its contour. */
static bool add_volume(struct frame *frame, uint32_t v,
                       const struct hsr_extent *extent,
                       struct hsr_image_box box) {
  const struct hsr_volumes *volumes = frame->volumes;
  if (!begin_volume(frame, extent, box))
    return false;
  for (uint32_t i = volumes->plane_start[v]; i < volumes->plane_start[v + 1];
       i++) {
    const struct hsr_cut *plane = &volumes->plane[i];
    int eye = hsr_sight_eye_side(&frame->sight, plane->face);
    frame->outside[i] = eye == -plane->side;
    if (frame->outside[i] &&
        !add_condition(frame, &frame->front, plane->face, plane->side))
      return false;
  }
  for (uint32_t r = volumes->rim_start[v]; r < volumes->rim_start[v + 1]; r++) {
    const struct hsr_rim *rim = &volumes->rim[r];
    bool outside = frame->outside[rim->plane];
    if (outside != frame->outside[rim->other] &&
        !add_condition(frame, &frame->contour, r, outside ? -1 : 1))
      return false;
  }
  return true;
}

/* Adds a face as a volume without thickness, if it is regular. */
static bool add_face(struct frame *frame, uint32_t f) {
  const struct hsr_volumes *volumes = frame->volumes;
  const struct hsr_world *world = frame->edges->world;
  if (!frame->sight.regular[f])
    return true;
  struct hsr_extent extent =
      extent_of(&frame->sight, world->mesh.vertex + world->mesh.start[f],
                hsr_face_size(world, f));
  for (uint32_t v = volumes->flat[f]; v < volumes->flat[f + 1]; v++)
    if (!add_volume(frame, v, &extent, box_of_flat(frame, v)))
      return false;
  return true;
}

/* Adds a body: a solid that is seen from outside as the volumes that it is made
 * of, any other body face by face. */
static bool add_body(struct frame *frame, uint32_t b) {
  const struct hsr_volumes *volumes = frame->volumes;
  const uint32_t *corner = volumes->corner + volumes->corner_start[b];
  uint32_t n = volumes->corner_start[b + 1] - volumes->corner_start[b];
  struct hsr_extent extent = extent_of(&frame->sight, corner, n);
  bool is_ahead = true;
  for (uint32_t k = 0; k < n && is_ahead; k++)
    is_ahead = frame->sight.ahead[corner[k]];
  if (!hsr_arena_grow(frame->job->scratch, &frame->bodies,
                      sizeof(struct collection)))
    return false;
  ((struct collection *)frame->bodies.items)[frame->bodies.n - 1] =
      (struct collection){extent, (uint32_t)frame->volume.n};
  uint32_t first = volumes->solid_start[b], end = volumes->solid_start[b + 1];
  if (first < end && is_ahead) {
    for (uint32_t v = first; v < end; v++) {
      if (end - first > 1)
        extent = extent_of_part(frame, v);
      if (!add_volume(frame, v, &extent, image_box(&extent)))
        return false;
    }
    return true;
  }
  HSR_STEP(frame->tally, TAKEN_APART, HSR_VOLUME(b), HSR_NOTHING, HSR_NOWHERE,
           0);
  for (uint32_t k = volumes->face_start[b]; k < volumes->face_start[b + 1]; k++)
    if (!add_face(frame, volumes->face[k]))
      return false;
  return true;
}

/* Whether face f is not ahead: it is flat, and none of its corners is ahead. */
static bool is_behind(const struct frame *frame, uint32_t f) {
  const struct hsr_world *world = frame->edges->world;
  bool is_ahead = world->mesh.deviation[f] > 0;
  for (uint32_t k = world->mesh.start[f];
       k < world->mesh.start[f + 1] && !is_ahead; k++)
    is_ahead = frame->sight.ahead[world->mesh.vertex[k]];
  return !is_ahead;
}

static struct hsr_subject volume_subject(const void *context, uint32_t v) {
  (void)context;
  return HSR_VOLUME(v);
}

/* Makes the boxes of the volumes, and sorts them if that is asked for. */
static enum hsr_status make_boxes(struct frame *frame) {
  struct hsr_arena *arena = frame->job->scratch;
  uint32_t n = (uint32_t)frame->volume.n - 1;
  struct hsr_image_box *box = HSR_NEW(arena, struct hsr_image_box, n);
  uint32_t *item = HSR_NEW(arena, uint32_t, n);
  frame->way = HSR_NEW(arena, uint32_t, n);
  if (!box || !item || !frame->way)
    return HSR_E_NOMEM;
  for (uint32_t v = 0; v < n; v++) {
    const struct volume *volume = (struct volume *)frame->volume.items + v;
    box[v] = frame->sorted ? image_box(&volume->extent) : volume->box;
    item[v] = v;
  }
  if (!frame->sorted)
    return hsr_near_boxes_make(&frame->near, box, item, n, false, arena);
  frame->boxes = (struct hsr_corner_boxes){.box = box,
                                           .item = item,
                                           .n = n,
                                           .tally = frame->tally,
                                           .sort = BOX_SORT,
                                           .search = BOX_SEARCH,
                                           .subject = volume_subject};
  return hsr_corner_boxes_sort(&frame->boxes, arena);
}

/* Where the volumes of body c end. */
static uint32_t end_of_body(const struct frame *frame, uint32_t c) {
  const struct collection *body = frame->bodies.items;
  return c + 1 < frame->bodies.n ? body[c + 1].first
                                 : (uint32_t)frame->volume.n - 1;
}

static enum hsr_status make_body_boxes(struct frame *frame) {
  struct hsr_arena *arena = frame->job->scratch;
  const struct collection *body = frame->bodies.items;
  uint32_t n = (uint32_t)frame->bodies.n;
  struct hsr_image_box *box = HSR_NEW(arena, struct hsr_image_box, n);
  uint32_t *item = HSR_NEW(arena, uint32_t, n);
  frame->other = HSR_NEW(arena, uint32_t, n);
  if (!box || !item || !frame->other)
    return HSR_E_NOMEM;
  for (uint32_t b = 0; b < n; b++) {
    box[b] = image_box(&body[b].extent);
    item[b] = b;
  }
  return hsr_near_boxes_make(&frame->body_boxes, box, item, n, false, arena);
}

/* The edges of each body, in their order. An edge belongs to the body of its
 * first face, which holds it. */
static enum hsr_status collect_edges(struct frame *frame) {
  struct hsr_arena *arena = frame->job->scratch;
  const struct hsr_edges *edges = frame->edges;
  const struct hsr_volumes *volumes = frame->volumes;
  uint32_t n = volumes->n_bodies;
  uint32_t *body_of = HSR_NEW_ZEROED(arena, uint32_t, edges->world->n_faces);
  uint32_t *first = HSR_NEW_ZEROED(arena, uint32_t, n + 2);
  frame->edge_of_body = HSR_NEW(arena, uint32_t, edges->n);
  if (!body_of || !first || !frame->edge_of_body)
    return HSR_E_NOMEM;
  for (uint32_t b = 0; b < n; b++)
    for (uint32_t k = volumes->face_start[b]; k < volumes->face_start[b + 1];
         k++)
      body_of[volumes->face[k]] = b;
  for (uint32_t e = 0; e < edges->n; e++)
    first[body_of[edges->side[edges->side_start[e]].face] + 2]++;
  for (uint32_t b = 0; b < n; b++)
    first[b + 2] += first[b + 1];
  for (uint32_t e = 0; e < edges->n; e++)
    frame->edge_of_body[first[body_of[edges->side[edges->side_start[e]].face] +
                              1]++] = e;
  frame->first_edge = first;
  return HSR_OK;
}

/* Collects the faces that are no volumes, and their boxes. */
static enum hsr_status collect_apart(struct frame *frame) {
  const struct hsr_sight *sight = &frame->sight;
  const struct hsr_world *world = frame->edges->world;
  struct hsr_image_box *box =
      HSR_NEW(frame->job->scratch, struct hsr_image_box, world->n_faces);
  if (!box)
    return HSR_E_NOMEM;
  for (uint32_t k = 0; k < sight->n_loose; k++) {
    uint32_t f = sight->loose[k];
    if (is_behind(frame, f))
      continue;
    struct hsr_extent extent =
        extent_of(sight, world->mesh.vertex + world->mesh.start[f],
                  hsr_face_size(world, f));
    box[f] = image_box(&extent);
    frame->apart[frame->n_apart++] = f;
  }
  return hsr_near_boxes_make(&frame->apart_boxes, box, frame->apart,
                             frame->n_apart, false, frame->job->scratch);
}

static enum hsr_status begin(struct frame *frame, const struct hsr_job *job) {
  const struct environment *environment = job->prepared;
  const struct hsr_volumes *volumes = &environment->volumes;
  *frame = (struct frame){.job = job,
                          .edges = &environment->edges,
                          .volumes = volumes,
                          .tally = job->tally};
  enum hsr_status status = hsr_sight_init(&frame->sight, frame->edges,
                                          job->view, job->scratch, job->tally);
  frame->sight.line = volumes->line;
  frame->outside =
      HSR_NEW(job->scratch, bool, volumes->plane_start[volumes->n]);
  frame->apart = HSR_NEW(job->scratch, uint32_t, frame->sight.n_loose);
  if (status || !frame->outside || !frame->apart)
    return HSR_E_NOMEM;
  if (collect_apart(frame))
    return HSR_E_NOMEM;
  for (uint32_t b = 0; b < volumes->n_bodies; b++)
    if (!add_body(frame, b))
      return HSR_E_NOMEM;
  frame->sorted = job->option[BOXES] == HSR_BY_CORNER;
  if (!begin_volume(frame, &nowhere, image_box(&nowhere)))
    return HSR_E_NOMEM;
  return make_boxes(frame) || make_body_boxes(frame) || collect_edges(frame)
             ? HSR_E_NOMEM
             : HSR_OK;
}

/* --- The edge/volume test ------------------------------------------------- */

/* Whether one of the edge's own faces lies in a front plane of the volume. */
static bool is_own(const struct frame *frame, uint32_t e,
                   const struct condition *front, uint32_t n) {
  const struct hsr_edges *edges = frame->edges;
  const struct hsr_world *world = edges->world;
  for (uint32_t s = edges->side_start[e]; s < edges->side_start[e + 1]; s++) {
    uint32_t f = edges->side[s].face;
    if (world->mesh.deviation[f] > 0)
      continue;
    for (uint32_t k = 0; k < n; k++)
      if (world->mesh.plane[f] == world->mesh.plane[front[k].subject])
        return true;
  }
  return false;
}

static bool is_same(const struct hsr_sight_event *a,
                    const struct hsr_sight_event *b) {
  return a->at == b->at && a->subject == b->subject;
}

/* Takes the hidden part out of a fragment. Returns which of the four outcomes
 * it is; left[0] and left[1] are what is left. */
static int take_out(const struct fragment *fragment,
                    const struct fragment *hidden, struct fragment left[2]) {
  bool before = !is_same(&hidden->from, &fragment->from);
  bool after = !is_same(&hidden->to, &fragment->to);
  if (before)
    left[0] = (struct fragment){fragment->from, hidden->from, fragment->next};
  if (after)
    left[before] = (struct fragment){hidden->to, fragment->to, fragment->next};
  return before && after ? TWO_LEFT : before || after ? ONE_LEFT : WHOLE;
}

/* Takes what is between two events out of a fragment. Returns the outcome. */
static int cut(const struct frame *frame, uint32_t e,
               const struct fragment *fragment,
               const struct hsr_sight_event *from,
               const struct hsr_sight_event *to, struct fragment left[2]) {
  struct fragment hidden = *fragment;
  if (hsr_sight_compare(&frame->sight, e, &hidden.from, from) < 0)
    hidden.from = *from;
  if (hsr_sight_compare(&frame->sight, e, to, &hidden.to) < 0)
    hidden.to = *to;
  return hsr_sight_compare(&frame->sight, e, &hidden.from, &hidden.to) < 0
             ? take_out(fragment, &hidden, left)
             : UNTOUCHED;
}

/* Counts a condition, after which some of the fragment is left, or nothing. */
static void count_condition(const struct frame *frame, uint32_t e,
                            enum hsr_event_at at,
                            const struct condition *condition, bool some) {
  uint32_t f = condition->subject;
  if (at == HSR_AT_LINE) { /* the front plane of the two that meet there */
    const struct hsr_rim *rim = &frame->volumes->rim[f];
    uint32_t plane = condition->side < 0 ? rim->plane : rim->other;
    f = frame->volumes->plane[plane].face;
  }
  HSR_STEP(frame->tally, CONDITIONS, hsr_edge_subject(frame->edges, e),
           HSR_FACE(f), HSR_NOWHERE, 2 * (at == HSR_AT_PLANE) + some);
}

/* Narrows the fragment to where a condition holds. False: nowhere. */
static bool narrow(const struct frame *frame, uint32_t e, enum hsr_event_at at,
                   struct condition *condition, struct fragment *fragment) {
  const struct hsr_sight *sight = &frame->sight;
  if (condition->edge != e)
    condition->half =
        hsr_sight_find_half(sight, e, at, condition->subject, condition->side);
  condition->edge = e;
  bool some = hsr_sight_narrow(sight, e, &condition->half, &fragment->from,
                               &fragment->to);
  if (HSR_COUNTING)
    count_condition(frame, e, at, condition, some);
  return some;
}

/* Narrows the fragment to where all conditions hold. False: nowhere. */
static bool solve(const struct frame *frame, uint32_t e,
                  const struct volume *volume, struct fragment *fragment) {
  struct condition *contour = frame->contour.items;
  struct condition *front = frame->front.items;
  for (uint32_t k = volume->first_line; k < volume[1].first_line; k++)
    if (!narrow(frame, e, HSR_AT_LINE, &contour[k], fragment))
      return false;
  for (uint32_t k = volume->first_plane; k < volume[1].first_plane; k++)
    if (!narrow(frame, e, HSR_AT_PLANE, &front[k], fragment))
      return false;
  return true;
}

/* Tests a fragment against a volume, and returns the outcome. */
static int test(const struct frame *frame, uint32_t e, uint32_t v,
                const struct fragment *fragment, struct fragment left[2]) {
  const struct volume *volume = (const struct volume *)frame->volume.items + v;
  struct fragment hidden = *fragment;
  int outcome = solve(frame, e, volume, &hidden)
                    ? take_out(fragment, &hidden, left)
                    : UNTOUCHED;
  HSR_STEP(frame->tally, TEST, hsr_edge_subject(frame->edges, e), HSR_VOLUME(v),
           HSR_NOWHERE, outcome - WHOLE);
  HSR_STEP(frame->tally, outcome, hsr_edge_subject(frame->edges, e),
           HSR_VOLUME(v), HSR_NOWHERE, 0);
  return outcome;
}

/* --- An edge -------------------------------------------------------------- */

static void count_out(const struct frame *frame, uint32_t e, uint32_t v) {
  HSR_STEP(frame->tally, MINIMAX, hsr_edge_subject(frame->edges, e),
           HSR_VOLUME(v), HSR_NOWHERE, VOLUME_OUT);
  HSR_STEP(frame->tally, VOLUMES, hsr_edge_subject(frame->edges, e),
           HSR_VOLUME(v), HSR_NOWHERE, 0);
}

/* Counts the minimax tests of volumes [v, end), whose boxes are apart from e's. */
static void count_volumes_out(const struct frame *frame, uint32_t e, uint32_t v,
                              uint32_t end) {
  if (!HSR_LISTENED(frame->tally)) {
    HSR_STEPS(frame->tally, MINIMAX, end - v);
    HSR_STEPS(frame->tally, VOLUMES, end - v);
    return;
  }
  for (; v < end; v++)
    count_out(frame, e, v);
}

/* Puts volume v, which no minimax test has rejected, among those in the way, if
 * it is not the edge's own. */
static void add_unless_own(struct frame *frame, uint32_t e, uint32_t v) {
  const struct volume *volume = (const struct volume *)frame->volume.items + v;
  const struct condition *front = frame->front.items;
  if (is_own(frame, e, front + volume->first_plane,
             volume[1].first_plane - volume->first_plane))
    HSR_STEP(frame->tally, OWN, hsr_edge_subject(frame->edges, e),
             HSR_VOLUME(v), HSR_NOWHERE, 0);
  else
    frame->way[frame->n_way++] = v;
}

/* The minimax test of volume v, whose box is near that of the edge. */
static void add_near(struct frame *frame, uint32_t e,
                     const struct hsr_extent *extent, uint32_t v) {
  const struct volume *volume = (const struct volume *)frame->volume.items + v;
  if (is_out_of_the_way(extent, &volume->extent)) {
    count_out(frame, e, v);
    return;
  }
  HSR_STEP(frame->tally, MINIMAX, hsr_edge_subject(frame->edges, e),
           HSR_VOLUME(v), HSR_NOWHERE, VOLUME_IN_THE_WAY);
  add_unless_own(frame, e, v);
}

/* Whether body c is out of the way of an edge, by the minimax test. */
static bool is_body_out(const struct frame *frame, uint32_t e,
                        const struct hsr_extent *extent, uint32_t c) {
  const struct collection *body = frame->bodies.items;
  bool out = is_out_of_the_way(extent, &body[c].extent);
  HSR_STEP(frame->tally, MINIMAX, hsr_edge_subject(frame->edges, e),
           HSR_VOLUME(c), HSR_NOWHERE, out ? BODY_OUT : BODY_IN_THE_WAY);
  if (out)
    HSR_STEP(frame->tally, COLLECTIONS, hsr_edge_subject(frame->edges, e),
             HSR_VOLUME(c), HSR_NOWHERE, 0);
  return out;
}

/* Finds the volumes of body c that may be in the way. A body that
 * is one volume is not tested twice. */
static void find_in_body(struct frame *frame, uint32_t e,
                         const struct hsr_extent *extent, uint32_t c) {
  const struct hsr_image_box image = image_box(extent);
  struct hsr_near_boxes *near = &frame->near;
  uint32_t from = ((struct collection *)frame->bodies.items)[c].first;
  uint32_t end = end_of_body(frame, c);
  if (from == end || is_body_out(frame, e, extent, c))
    return;
  if (end - from == 1) {
    add_unless_own(frame, e, from);
    return;
  }
  hsr_near_boxes_find_among(near, from, end, &image);
  for (uint32_t v; from < end; from = v + 1) {
    v = hsr_near_boxes_next(near, from, end);
    if (HSR_COUNTING)
      count_volumes_out(frame, e, from, v);
    if (v < end)
      add_near(frame, e, extent, v);
  }
}

/* Finds the first volumes that may be in the way of the edge, and that it has not
 * found before: of one body, or one of those that are sorted. Returns false if
 * there are no more. */
static bool find_more(struct frame *frame, uint32_t e,
                      const struct hsr_extent *extent) {
  uint32_t before = frame->n_way;
  uint32_t n = frame->sorted ? frame->n_near : frame->n_others;
  while (frame->n_way == before && frame->next_other < n)
    if (frame->sorted)
      add_near(frame, e, extent, frame->boxes.near[frame->next_other++]);
    else
      find_in_body(frame, e, extent, frame->other[frame->next_other++]);
  return frame->n_way > before;
}

/* Puts the fragment to the volumes that remain, as long as one piece of it is
 * left. Returns the last outcome. */
static enum hsr_status put_to_volumes(struct frame *frame, uint32_t e,
                                      const struct hsr_extent *extent,
                                      struct fragment *fragment, int *outcome) {
  *outcome = UNTOUCHED;
  while (*outcome != WHOLE &&
         (fragment->next < frame->n_way || find_more(frame, e, extent))) {
    struct fragment left[2];
    uint32_t v = frame->way[fragment->next++];
    *outcome = test(frame, e, v, fragment, left);
    if (*outcome == TWO_LEFT && !push(frame, &frame->stack, left[1]))
      return HSR_E_NOMEM;
    if (*outcome == ONE_LEFT || *outcome == TWO_LEFT)
      *fragment = left[0];
  }
  return HSR_OK;
}

/* Puts the fragments on the stack, and what is left of them, to the volumes that
 * remain. */
static enum hsr_status test_fragments(struct frame *frame, uint32_t e,
                                      const struct hsr_extent *extent) {
  frame->n_way = frame->next_other = 0;
  while (frame->stack.n) {
    struct fragment fragment =
        ((struct fragment *)frame->stack.items)[--frame->stack.n];
    HSR_STEP(frame->tally, FRAGMENTS, hsr_edge_subject(frame->edges, e),
             HSR_NOTHING, HSR_NOWHERE, 0);
    int outcome;
    if (put_to_volumes(frame, e, extent, &fragment, &outcome) ||
        (outcome != WHOLE && !push(frame, &frame->visible, fragment)))
      return HSR_E_NOMEM;
  }
  return HSR_OK;
}

/* Takes a part of the edge out of all that is visible. */
static bool hide(struct frame *frame, uint32_t e, struct hsr_sight_event from,
                 struct hsr_sight_event to) {
  struct hsr_growing kept = frame->kept;
  kept.n = 0;
  const struct fragment *visible = frame->visible.items;
  for (size_t k = 0; k < frame->visible.n; k++) {
    struct fragment left[2];
    int outcome = cut(frame, e, &visible[k], &from, &to, left);
    if (outcome == UNTOUCHED)
      left[0] = visible[k];
    if ((outcome != WHOLE && !push(frame, &kept, left[0])) ||
        (outcome == TWO_LEFT && !push(frame, &kept, left[1])))
      return false;
  }
  frame->kept = frame->visible;
  frame->visible = kept;
  return true;
}

/* Takes out of what is visible the parts that faces hide which are no volumes.
 * The definition of the drawing tells where each of them hides the edge. */
static bool hide_apart(struct frame *frame, uint32_t e,
                       const struct hsr_image_box *box,
                       const struct fragment *all) {
  const struct hsr_edges *edges = frame->edges;
  const struct hsr_sight *sight = &frame->sight;
  struct hsr_near_boxes *boxes = &frame->apart_boxes;
  hsr_near_boxes_find(boxes, box);
  for (uint32_t k = hsr_near_boxes_next(boxes, 0, boxes->n);
       k < boxes->n && frame->visible.n;
       k = hsr_near_boxes_next(boxes, k + 1, boxes->n)) {
    uint32_t f = frame->apart[k];
    bool own = false, hidden = false;
    for (uint32_t s = edges->side_start[e]; s < edges->side_start[e + 1]; s++)
      own |= edges->side[s].face == f;
    if (own || hsr_sight_in_plane(sight, e, f))
      continue;
    frame->events.n = 0;
    if (hsr_sight_face(sight, e, f, frame->job->scratch, &frame->events,
                       &hidden))
      return false;
    HSR_STEP(frame->tally, APART, hsr_edge_subject(edges, e), HSR_FACE(f),
             HSR_NOWHERE, hidden);
    const struct hsr_sight_event *event = frame->events.items;
    struct hsr_sight_event from = all->from;
    for (size_t i = 0; i < frame->events.n; i++) {
      if (hidden && !hide(frame, e, from, event[i]))
        return false;
      from = event[i];
      hidden = !hidden;
    }
    if (hidden && !hide(frame, e, from, all->to))
      return false;
  }
  return true;
}

static enum hsr_status add_interval(const struct frame *frame, uint32_t e,
                                    struct hsr_sight_event from,
                                    struct hsr_sight_event to, bool is_hidden) {
  hsr_sight_locate(&frame->sight, e, &from);
  hsr_sight_locate(&frame->sight, e, &to);
  struct hsr_segment segment = {.edge = frame->edges->name[e],
                                .invisibility = is_hidden,
                                .t0 = from.t,
                                .t1 = fmax(from.t, to.t)};
  hsr_edge_point(frame->edges, e, segment.t0, segment.from);
  hsr_edge_point(frame->edges, e, segment.t1, segment.to);
  HSR_ACCEPTED(frame->tally, DRAWN, hsr_edge_subject(frame->edges, e),
               HSR_NOTHING, HSR_NOWHERE, &segment);
  return hsr_drawing_add(hsr_answer_drawing_of(frame->job->answer), &segment);
}

/* Draws the visible parts, and the hidden parts between them. */
static enum hsr_status draw(const struct frame *frame, uint32_t e,
                            const struct fragment *all) {
  const struct fragment *visible = frame->visible.items;
  const struct hsr_sight_event *at = &all->from;
  for (size_t k = 0; k < frame->visible.n; k++) {
    if ((!is_same(at, &visible[k].from) &&
         add_interval(frame, e, *at, visible[k].from, true)) ||
        add_interval(frame, e, visible[k].from, visible[k].to, false))
      return HSR_E_NOMEM;
    at = &visible[k].to;
  }
  return is_same(at, &all->to) ? HSR_OK
                               : add_interval(frame, e, *at, all->to, true);
}

/* The culls: whether any part of the edge may be drawn, and which. */
static bool is_relevant(const struct frame *frame, uint32_t e,
                        struct fragment *all) {
  const struct hsr_edges *edges = frame->edges;
  uint32_t existing = 0, wanted = edges->name[e].implied ? 2 : 1;
  for (uint32_t s = edges->side_start[e]; s < edges->side_start[e + 1]; s++) {
    uint32_t f = edges->side[s].face;
    HSR_STEP(frame->tally, BACK_CULL, hsr_edge_subject(edges, e), HSR_FACE(f),
             HSR_NOWHERE, frame->sight.exists[f]);
    existing += frame->sight.exists[f];
  }
  if (existing < wanted)
    return false;
  all->next = 0;
  bool inside = hsr_sight_picture(&frame->sight, e, &all->from, &all->to);
  HSR_STEP(frame->tally, CLIP_CULL, hsr_edge_subject(edges, e), HSR_THE_WINDOW,
           HSR_NOWHERE, inside);
  return inside;
}

/* Finds the bodies that may be in the way of edges of body b: `other`. A body may
 * be in the way of its own. */
static void find_others(struct frame *frame, uint32_t b) {
  const struct collection *body = frame->bodies.items;
  const struct hsr_image_box image = image_box(&body[b].extent);
  struct hsr_near_boxes *boxes = &frame->body_boxes;
  frame->n_others = 0;
  hsr_near_boxes_find(boxes, &image);
  for (uint32_t c = 0; c < boxes->n; c++) {
    bool out =
        !boxes->near[c] || is_out_of_the_way(&body[b].extent, &body[c].extent);
    HSR_STEP(frame->tally, PAIRS, HSR_VOLUME(b), HSR_VOLUME(c), HSR_NOWHERE,
             out);
    if (!out)
      frame->other[frame->n_others++] = c;
  }
}

/* Draws the part `all` of an edge. */
static enum hsr_status draw_edge(struct frame *frame, uint32_t e,
                                 const struct fragment *all) {
  const uint32_t ends[2] = {frame->edges->a[e], frame->edges->b[e]};
  struct hsr_extent extent = extent_of(&frame->sight, ends, 2);
  struct hsr_image_box image = image_box(&extent);
  frame->stack.n = frame->visible.n = 0;
  if (frame->sorted)
    frame->n_near = hsr_corner_boxes_find(&frame->boxes, &image,
                                          hsr_edge_subject(frame->edges, e));
  if (!push(frame, &frame->stack, *all) || test_fragments(frame, e, &extent) ||
      !hide_apart(frame, e, &image, all))
    return HSR_E_NOMEM;
  return draw(frame, e, all);
}

static enum hsr_status draw_body(struct frame *frame, uint32_t b) {
  bool met = frame->sorted; /* its box has met those of the others */
  for (uint32_t k = frame->first_edge[b]; k < frame->first_edge[b + 1]; k++) {
    struct fragment all;
    uint32_t e = frame->edge_of_body[k];
    if (!is_relevant(frame, e, &all))
      continue;
    if (!met)
      find_others(frame, b);
    met = true;
    if (draw_edge(frame, e, &all))
      return HSR_E_NOMEM;
  }
  return HSR_OK;
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct frame frame;
  enum hsr_status status = begin(&frame, job);
  for (uint32_t b = 0; !status && b < frame.volumes->n_bodies; b++)
    status = draw_body(&frame, b);
  if (!status)
    status = hsr_drawing_sort(hsr_answer_drawing_of(job->answer));
  hsr_sight_free(&frame.sight);
  return status || job->tally->out_of_memory ? hsr_fail_nomem(err) : HSR_OK;
}

/* --- The descriptor ------------------------------------------------------- */

/* Every edge against every volume; there are not many more volumes than faces.
 */
static double expense(const struct hsr_world *world,
                      const struct hsr_view *view) {
  (void)view;
  return (double)world->mesh.n_corners / 2 * world->n_faces;
}

/* --- What it is and counts ------------------------------------------------ */

static double predict_back_cull(const struct hsr_table1 *t) {
  return t->E_t;
}

static double predict_clip_cull(const struct hsr_table1 *t) {
  return 100 * t->E_s;
}

static double predict_test(const struct hsr_table1 *t) {
  const double f = 4;
  return 100 * t->E_s * f * t->C_t;
}

static const struct hsr_counter counters[] = {
    [BACK_CULL] = {"back-edge cull",
                   "sides of faces looked at for relevant edges", HSR_COMPARE,
                   HSR_OF_EDGE, HSR_OF_FACE, "a back, or edge on|may be seen",
                   .key = "back-edge-cull"},
    [CLIP_CULL] = {"clipping cull", "edges clipped to the picture", HSR_COMPARE,
                   HSR_OF_EDGE, HSR_OF_WINDOW, "outside|inside"},
    [MINIMAX] = {"minimax",
                 "minimax tests of edges with collections and volumes",
                 HSR_COMPARE, HSR_OF_EDGE, HSR_OF_VOLUME,
                 "body in the way|body out of the way|volume in the "
                 "way|volume out of the way",
                 .key = "minimax",
                 .outcome_keys = "boxes body|boxes body|boxes|boxes"},
    [COLLECTIONS] = {"collections rejected",
                     "bodies that an edge is not behind, by minimax",
                     HSR_REJECT, HSR_OF_EDGE, HSR_OF_VOLUME,
                     .outcome_keys = "body"},
    [VOLUMES] = {"volumes rejected",
                 "volumes that an edge is not behind, by minimax", HSR_REJECT,
                 HSR_OF_EDGE, HSR_OF_VOLUME},
    [OWN] = {"own volumes", "volumes that have an edge in a front plane",
             HSR_REJECT, HSR_OF_EDGE, HSR_OF_VOLUME},
    [TEST] = {"edge/volume test", "fragments compared with a convex volume",
              HSR_COMPARE, HSR_OF_EDGE, HSR_OF_VOLUME,
              "hidden whole|untouched|one piece left|two pieces left",
              .key = "edge-volume",
              .outcome_keys = "all-hidden|none-hidden||middle-hidden"},
    [WHOLE] = {"hidden whole", "tests that left nothing", HSR_REJECT,
               HSR_OF_EDGE, HSR_OF_VOLUME},
    [UNTOUCHED] = {"untouched", "tests that left all", HSR_COMPARE, HSR_OF_EDGE,
                   HSR_OF_VOLUME},
    [ONE_LEFT] = {"one piece left", "tests that left one piece", HSR_SPLIT,
                  HSR_OF_EDGE, HSR_OF_VOLUME, .key = "one-left"},
    [TWO_LEFT] = {"two pieces left", "tests that left two pieces", HSR_SPLIT,
                  HSR_OF_EDGE, HSR_OF_VOLUME},
    [FRAGMENTS] = {"fragments", "edges and what was split off them",
                   HSR_ACTIVATE, HSR_OF_EDGE, HSR_OF_NOTHING,
                   .key = "fragment"},
    [CONDITIONS] = {"conditions",
                    "planes and contour edges that narrow a fragment",
                    HSR_COMPARE, HSR_OF_EDGE, HSR_OF_FACE,
                    "contour: no part hidden|contour: a part may be "
                    "hidden|plane: no part hidden|plane: a part may be hidden",
                    .key = "fragment-condition"},
    [APART] = {"faces apart", "edges compared with faces that are no volumes",
               HSR_COMPARE, HSR_OF_EDGE, HSR_OF_FACE,
               "does not hide its beginning|hides its beginning"},
    [TAKEN_APART] = {"bodies apart", "bodies that are taken face by face",
                     HSR_SPLIT, HSR_OF_VOLUME, HSR_OF_NOTHING,
                     .outcome_keys = "body"},
    [DRAWN] = {"intervals drawn", "intervals of edges added to the drawing",
               HSR_ACCEPT, HSR_OF_EDGE, HSR_OF_NOTHING,
               .key = "interval-drawn"},
    [BOX_SORT] = {"box sort", "comparisons to sort boxes of volumes",
                  HSR_COMPARE, HSR_OF_VOLUME, HSR_OF_VOLUME,
                  "not before|before"},
    [BOX_SEARCH] = {"box search",
                    "boxes of volumes looked at to find those near an edge",
                    HSR_COMPARE, HSR_OF_EDGE, HSR_OF_VOLUME, "not there|there"},
    [PAIRS] =
        {"collection pairs",
         "minimax tests of bodies, which are collections of volumes, with "
         "bodies whose edges are to be drawn",
         HSR_COMPARE, HSR_OF_VOLUME, HSR_OF_VOLUME,
         "body in the way|body out of the way",
         .outcome_keys = "extents body|extents body"},
    {NULL}};

static const struct hsr_line outline[] = {
    {"with sorted boxes: sort volumes by the upper left corners of their "
     "boxes, and "
     "find those near an edge",
     HSR_RAISES(BOX_SORT, BOX_SEARCH)},
    {"for each body that is no closed solid before the eye: take it face by "
     "face",
     HSR_RAISES(TAKEN_APART)},
    {"for each body: which bodies may be before it, by a minimax test?",
     HSR_RAISES(PAIRS)},
    {"for each of its edges"},
    {"  back-edge cull: does a front face have it?", HSR_RAISES(BACK_CULL)},
    {"  clipping cull: is it in the picture?", HSR_RAISES(CLIP_CULL)},
    {"  for each volume of these bodies"},
    {"    minimax test: may the volume, or its whole body, be before it?",
     HSR_RAISES(MINIMAX)},
    {"      no: leave the body out", HSR_RAISES(COLLECTIONS)},
    {"      no: leave the volume out", HSR_RAISES(VOLUMES)},
    {"    is the edge in a front plane of the volume?", HSR_RAISES(OWN)},
    {"  for the edge, and for each fragment that is split off",
     HSR_RAISES(FRAGMENTS)},
    {"    for each volume that is left"},
    {"      edge/volume test: where does the linear programme hold?",
     HSR_RAISES(TEST)},
    {"        narrow the fragment by a plane or by a contour edge",
     HSR_RAISES(CONDITIONS)},
    {"        it is hidden whole", HSR_RAISES(WHOLE)},
    {"        it is untouched", HSR_RAISES(UNTOUCHED)},
    {"        one piece of it is left", HSR_RAISES(ONE_LEFT)},
    {"        two pieces are left: keep one for later", HSR_RAISES(TWO_LEFT)},
    {"  compare what is left with the faces that are no volumes",
     HSR_RAISES(APART)},
    {"  draw the unobscured portions, and the hidden ones", HSR_RAISES(DRAWN)},
    {NULL}};

static const struct hsr_step steps[] = {
    {"back-edge cull", BACK_CULL, HSR_KIND_CULL, "E_t", predict_back_cull},
    {"clipping cull", CLIP_CULL, HSR_KIND_EDGE_WINDOW, "100 E_s",
     predict_clip_cull},
    {"minimax",
     PAIRS,
     HSR_KIND_BOX,
     NULL,
     NULL,
     {{MINIMAX, HSR_KIND_BOX},
      {BOX_SORT, HSR_KIND_BOX},
      {BOX_SEARCH, HSR_KIND_BOX}}},
    {"edge/volume test", TEST, HSR_KIND_EDGE_VOLUME, "100 E_s f C_t, f = 4",
     predict_test},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {"edges", "back-facing", "cull", "once a frame"},
    {"edges", "clipping", "cull", "once a frame"},
    {"objects", "X, Y, Z", "minimax, exhaustive search", "once a frame"},
    {"volumes", "before an edge",
     "exhaustive search: minimax, linear programme", "once an edge"},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(roberts) = {
    .name = "roberts",
    .numbered = HSR_NUMBERED_VOLUMES,
    .title = "Roberts' edges against volumes",
    .authors = "L. G. Roberts",
    .year = 1963,
    .source = "MIT Lincoln Laboratory TR 315, 1963; Sutherland et al., "
              "Computing Surveys 6(1), 1974, \"L. G. Roberts (1963)\"",
    .taxonomy = HSR_OBJECT_SPACE_VOLUMES,
    .coherence = "object: a volume leaves at most two pieces of an edge",
    .restrictions = HSR_CC | HSR_TP,
    .lifted = HSR_NP,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_SEGMENTS, .how = HSR_VISIBLE_ONLY}},
    .sorts = sorts,
    .counters = counters,
    .steps = steps,
    .outline = outline,
    .options = options,
    .expense = expense,
    .prepare = prepare,
    .render = render,
    .release = release};
