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
 *             is to be inside of all planes of a convex volume. Beta drops out
 *             by Fourier's elimination: a front plane (the eye is outside of
 *             it) gives a lower bound of beta, and any other an upper one or
 *             none. Alpha is good if no lower bound is above an upper one:
 *             E1 E2 at alpha is behind every front plane; and for every pair of
 *             a front plane and another, it is on the inner side of the plane
 *             through the eye and the line where those two meet. Of these, the
 *             pairs that meet in the volume's contour imply the others. What is
 *             left are conditions linear in alpha, which narrow the fragment
 *             down to its hidden part.
 * Invariant   what is on the stack, what was found visible, and what was found
 *             hidden, is together what of the edge is in the picture; a
 *             fragment on the stack is hidden by no volume before its `next`
 * Ties        the edge is displaced (common/lines/sight/sight.h). One in a front plane of a
 *             volume is not hidden by it, so that none is by its own volume's
 *             front
 * Departures  concave solids are divided by the program (common/lines/volumes.h). Of
 *             open objects, and where the near plane or the eye is in an
 *             object, every face is a volume without thickness; one that is not
 *             flat, or that is cut, is put to the edge by itself, by
 *             hsr_sight_face. Edges may pierce volumes, and implied edges are
 *             drawn: the paper's environments have neither
 * Cost        Table III: back-edge cull E_t, clipping cull 100 E_s, edge/volume
 *             test 100 E_s f C_t, f = 4; it grows as the square of the
 *             environment */
#include "algorithms/algorithm.h"
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
  TAKEN_APART
};

/* A condition on alpha: the edge is on this side of a plane, or of a line
 * (hsr_sight_narrow). */
struct condition {
  uint32_t subject;
  int side;
};

/* What is in the way: a volume that an edge may be behind. Its conditions are
 * contour[first_line], ... and front[first_plane], ... up to the next one's. */
struct volume {
  struct hsr_extent extent;
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
  uint32_t next; /* volume that it is tested against next */
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

  uint32_t *apart, n_apart;  /* faces that are no volumes in this view */
  bool *outside;             /* a plane of a volume: the eye is outside of it */
  struct hsr_growing volume; /* struct volume; one more, which ends the last */
  struct hsr_growing bodies; /* struct collection; likewise */
  struct hsr_growing contour; /* struct condition */
  struct hsr_growing front;   /* struct condition */

  struct hsr_growing stack, visible; /* struct fragment, of the current edge */
  struct hsr_growing kept;           /* memory for the next `visible` */
  struct hsr_growing events;         /* of a face apart */
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
                                          -INFINITY, INFINITY, 0};

static void enclose(struct hsr_extent *extent, const struct hsr_sight *sight,
                    uint32_t p) {
  double x = sight->sx[p], y = sight->sy[p], q = sight->q[p];
  bool is_known = sight->ahead[p] && x == x;
  extent->x0 = is_known ? fmin(extent->x0, x - HSR_DELTA) : -INFINITY;
  extent->y0 = is_known ? fmin(extent->y0, y - HSR_DELTA) : -INFINITY;
  extent->x1 = is_known ? fmax(extent->x1, x + HSR_DELTA) : INFINITY;
  extent->y1 = is_known ? fmax(extent->y1, y + HSR_DELTA) : INFINITY;
  extent->farthest =
      is_known ? fmin(extent->farthest, q * (1 - 0x1p-41)) : -INFINITY;
  extent->nearest =
      is_known ? fmax(extent->nearest, q * (1 + 0x1p-41)) : INFINITY;
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

/* --- What is in the way --------------------------------------------------- */

static bool add_condition(struct frame *frame, struct hsr_growing *list,
                          uint32_t subject, int side) {
  if (!hsr_arena_grow(frame->job->scratch, list, sizeof(struct condition)))
    return false;
  ((struct condition *)list->items)[list->n - 1] =
      (struct condition){subject, side};
  return true;
}

static bool begin_volume(struct frame *frame, const struct hsr_extent *extent) {
  if (!hsr_arena_grow(frame->job->scratch, &frame->volume,
                      sizeof(struct volume)))
    return false;
  ((struct volume *)frame->volume.items)[frame->volume.n - 1] =
      (struct volume){*extent, (uint32_t)frame->contour.n,
                      (uint32_t)frame->front.n, (uint32_t)frame->bodies.n - 1};
  return true;
}

/* The front planes of volume v, and its contour. */
static bool add_volume(struct frame *frame, uint32_t v,
                       const struct hsr_extent *extent) {
  const struct hsr_volumes *volumes = frame->volumes;
  if (!begin_volume(frame, extent))
    return false;
  for (uint32_t i = volumes->plane_start[v]; i < volumes->plane_start[v + 1];
       i++) {
    const struct hsr_half_space *plane = &volumes->plane[i];
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

/* A face as it stands, if that can be. */
static bool add_face(struct frame *frame, uint32_t f) {
  const struct hsr_volumes *volumes = frame->volumes;
  const struct hsr_world *world = frame->edges->world;
  if (!frame->sight.regular[f])
    return true;
  struct hsr_extent extent = extent_of(
      &frame->sight, world->vertex + world->start[f], hsr_face_size(world, f));
  for (uint32_t v = volumes->flat[f]; v < volumes->flat[f + 1]; v++)
    if (!add_volume(frame, v, &extent))
      return false;
  return true;
}

/* A solid that is seen from outside as the volumes that it is made of; any
 * other body face by face. */
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
      if (!add_volume(frame, v, &extent))
        return false;
    }
    return true;
  }
  HSR_COUNT(frame->tally, TAKEN_APART, 1);
  for (uint32_t k = volumes->face_start[b]; k < volumes->face_start[b + 1]; k++)
    if (!add_face(frame, volumes->face[k]))
      return false;
  return true;
}

/* Whether nothing of face f is ahead: it is flat, and no corner of it is. */
static bool is_behind(const struct frame *frame, uint32_t f) {
  const struct hsr_world *world = frame->edges->world;
  bool is_ahead = world->deviation[f] > 0;
  for (uint32_t k = world->start[f]; k < world->start[f + 1] && !is_ahead; k++)
    is_ahead = frame->sight.ahead[world->vertex[k]];
  return !is_ahead;
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
  for (uint32_t k = 0; k < frame->sight.n_loose; k++)
    if (!is_behind(frame, frame->sight.loose[k]))
      frame->apart[frame->n_apart++] = frame->sight.loose[k];
  for (uint32_t b = 0; b < volumes->n_bodies; b++)
    if (!add_body(frame, b))
      return HSR_E_NOMEM;
  return begin_volume(frame, &nowhere) ? HSR_OK : HSR_E_NOMEM;
}

/* --- The edge/volume test ------------------------------------------------- */

/* Whether one of the edge's own faces lies in a front plane of the volume. */
static bool is_own(const struct frame *frame, uint32_t e,
                   const struct condition *front, uint32_t n) {
  const struct hsr_edges *edges = frame->edges;
  const struct hsr_world *world = edges->world;
  for (uint32_t s = edges->side_start[e]; s < edges->side_start[e + 1]; s++) {
    uint32_t f = edges->side[s].face;
    if (world->deviation[f] > 0)
      continue;
    for (uint32_t k = 0; k < n; k++)
      if (world->plane[f] == world->plane[front[k].subject])
        return true;
  }
  return false;
}

static bool is_same(const struct hsr_sight_event *a,
                    const struct hsr_sight_event *b) {
  return a->at == b->at && a->subject == b->subject;
}

/* Takes the hidden part out of a fragment; returns which of the four outcomes
 * it is. What is left is left[0], and left[1]. */
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

/* Narrows the fragment to where all conditions hold. False: nowhere. */
static bool solve(const struct frame *frame, uint32_t e,
                  const struct volume *volume, struct fragment *fragment) {
  const struct hsr_sight *sight = &frame->sight;
  const struct condition *contour = frame->contour.items;
  const struct condition *front = frame->front.items;
  for (uint32_t k = volume->first_line; k < volume[1].first_line; k++) {
    HSR_COUNT(frame->tally, CONDITIONS, 1);
    if (!hsr_sight_narrow(sight, e, HSR_AT_LINE, contour[k].subject,
                          contour[k].side, &fragment->from, &fragment->to))
      return false;
  }
  for (uint32_t k = volume->first_plane; k < volume[1].first_plane; k++) {
    HSR_COUNT(frame->tally, CONDITIONS, 1);
    if (!hsr_sight_narrow(sight, e, HSR_AT_PLANE, front[k].subject,
                          front[k].side, &fragment->from, &fragment->to))
      return false;
  }
  return true;
}

static int test(const struct frame *frame, uint32_t e,
                const struct volume *volume, const struct fragment *fragment,
                struct fragment left[2]) {
  HSR_STEP9(frame->tally, TEST, HSR_COMPARE, e, volume->collection, 0, 0, 0, 0);
  struct fragment hidden = *fragment;
  int outcome = solve(frame, e, volume, &hidden)
                    ? take_out(fragment, &hidden, left)
                    : UNTOUCHED;
  HSR_COUNT(frame->tally, outcome, 1);
  return outcome;
}

/* --- An edge -------------------------------------------------------------- */

/* The first volume from v on that the edge may be behind, by minimax tests, and
 * that is not its own. */
static uint32_t next_in_the_way(const struct frame *frame, uint32_t e,
                                const struct hsr_extent *extent, uint32_t v) {
  const struct volume *volume = frame->volume.items;
  const struct collection *collection = frame->bodies.items;
  const struct condition *front = frame->front.items;
  uint32_t n = (uint32_t)frame->volume.n - 1,
           n_bodies = (uint32_t)frame->bodies.n;
  while (v < n) {
    uint32_t c = volume[v].collection;
    HSR_COUNT(frame->tally, MINIMAX, 1);
    if (v == collection[c].first &&
        is_out_of_the_way(extent, &collection[c].extent)) {
      HSR_COUNT(frame->tally, COLLECTIONS, 1);
      v = c + 1 < n_bodies ? collection[c + 1].first : n;
    } else if (is_out_of_the_way(extent, &volume[v].extent)) {
      HSR_COUNT(frame->tally, VOLUMES, 1);
      v++;
    } else if (is_own(frame, e, front + volume[v].first_plane,
                      volume[v + 1].first_plane - volume[v].first_plane)) {
      HSR_COUNT(frame->tally, OWN, 1);
      v++;
    } else {
      break;
    }
  }
  return v;
}

/* Tests all fragments on the stack against the remaining volumes, and what is
 * left of them. */
static bool test_fragments(struct frame *frame, uint32_t e,
                           const struct hsr_extent *extent) {
  const struct volume *volume = frame->volume.items;
  uint32_t n = (uint32_t)frame->volume.n - 1;
  while (frame->stack.n) {
    struct fragment fragment =
        ((struct fragment *)frame->stack.items)[--frame->stack.n];
    HSR_COUNT(frame->tally, FRAGMENTS, 1);
    int outcome = UNTOUCHED;
    for (;;) {
      struct fragment left[2];
      fragment.next = next_in_the_way(frame, e, extent, fragment.next);
      if (fragment.next == n)
        break;
      uint32_t v = fragment.next++;
      outcome = test(frame, e, &volume[v], &fragment, left);
      if (outcome == WHOLE)
        break;
      if (outcome == TWO_LEFT && !push(frame, &frame->stack, left[1]))
        return false;
      if (outcome != UNTOUCHED)
        fragment = left[0];
    }
    if (outcome != WHOLE && !push(frame, &frame->visible, fragment))
      return false;
  }
  return true;
}

/* Takes a part of the edge out of all that is visible. */
static bool hide(struct frame *frame, uint32_t e, struct hsr_sight_event from,
                 struct hsr_sight_event to) {
  struct hsr_growing kept = frame->kept;
  kept.n = 0;
  const struct fragment *visible = frame->visible.items;
  for (size_t k = 0; k < frame->visible.n; k++) {
    struct fragment hidden = visible[k], left[2];
    if (hsr_sight_compare(&frame->sight, e, &hidden.from, &from) < 0)
      hidden.from = from;
    if (hsr_sight_compare(&frame->sight, e, &to, &hidden.to) < 0)
      hidden.to = to;
    int outcome =
        hsr_sight_compare(&frame->sight, e, &hidden.from, &hidden.to) < 0
            ? take_out(&visible[k], &hidden, left)
            : UNTOUCHED;
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

/* The same for faces that are no volumes: the definition of the drawing tells
 * where each of them hides the edge. */
static bool hide_apart(struct frame *frame, uint32_t e,
                       const struct fragment *all) {
  const struct hsr_edges *edges = frame->edges;
  const struct hsr_sight *sight = &frame->sight;
  for (uint32_t k = 0; k < frame->n_apart && frame->visible.n; k++) {
    uint32_t f = frame->apart[k];
    bool own = false, hidden;
    for (uint32_t s = edges->side_start[e]; s < edges->side_start[e + 1]; s++)
      own |= edges->side[s].face == f;
    if (own || hsr_sight_in_plane(sight, e, f))
      continue;
    HSR_COUNT(frame->tally, APART, 1);
    frame->events.n = 0;
    if (hsr_sight_face(sight, e, f, frame->job->scratch, &frame->events,
                       &hidden))
      return false;
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
                                    const struct hsr_sight_event *from,
                                    const struct hsr_sight_event *to,
                                    bool is_hidden) {
  struct hsr_segment segment = {.edge = frame->edges->name[e],
                                .invisibility = is_hidden,
                                .t0 = from->t,
                                .t1 = fmax(from->t, to->t)};
  hsr_edge_point(frame->edges, e, segment.t0, segment.from);
  hsr_edge_point(frame->edges, e, segment.t1, segment.to);
  return hsr_drawing_add(frame->job->drawing, &segment);
}

/* Draws what is visible, and what is between. */
static enum hsr_status draw(const struct frame *frame, uint32_t e,
                            const struct fragment *all) {
  const struct fragment *visible = frame->visible.items;
  const struct hsr_sight_event *at = &all->from;
  for (size_t k = 0; k < frame->visible.n; k++) {
    if ((!is_same(at, &visible[k].from) &&
         add_interval(frame, e, at, &visible[k].from, true)) ||
        add_interval(frame, e, &visible[k].from, &visible[k].to, false))
      return HSR_E_NOMEM;
    at = &visible[k].to;
  }
  return is_same(at, &all->to) ? HSR_OK
                               : add_interval(frame, e, at, &all->to, true);
}

/* The culls: whether anything of the edge may be drawn, and what. */
static bool is_relevant(const struct frame *frame, uint32_t e,
                        struct fragment *all) {
  const struct hsr_edges *edges = frame->edges;
  uint32_t existing = 0, wanted = edges->name[e].implied ? 2 : 1;
  for (uint32_t s = edges->side_start[e]; s < edges->side_start[e + 1]; s++) {
    HSR_COUNT(frame->tally, BACK_CULL, 1);
    existing += frame->sight.exists[edges->side[s].face];
  }
  if (existing < wanted)
    return false;
  HSR_COUNT(frame->tally, CLIP_CULL, 1);
  all->next = 0;
  return hsr_sight_picture(&frame->sight, e, &all->from, &all->to);
}

static enum hsr_status draw_edge(struct frame *frame, uint32_t e) {
  struct fragment all;
  if (!is_relevant(frame, e, &all))
    return HSR_OK;
  const uint32_t ends[2] = {frame->edges->a[e], frame->edges->b[e]};
  struct hsr_extent extent = extent_of(&frame->sight, ends, 2);
  frame->stack.n = frame->visible.n = 0;
  if (!push(frame, &frame->stack, all) || !test_fragments(frame, e, &extent) ||
      !hide_apart(frame, e, &all))
    return HSR_E_NOMEM;
  return draw(frame, e, &all);
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct frame frame;
  enum hsr_status status = begin(&frame, job);
  for (uint32_t e = 0; !status && e < frame.edges->n; e++)
    status = draw_edge(&frame, e);
  hsr_sight_free(&frame.sight);
  return status || job->tally->out_of_memory ? hsr_fail_nomem(err) : HSR_OK;
}

/* --- The descriptor ------------------------------------------------------- */

/* Every edge against every volume, of which there are not many more than
 * faces. */
static double expense(const struct hsr_world *world,
                      const struct hsr_view *view) {
  (void)view;
  return (double)world->n_corners / 2 * world->n_faces;
}

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
    {"back-edge cull", "sides of faces looked at for relevant edges"},
    {"clipping cull", "edges clipped to the picture"},
    {"minimax", "minimax tests of edges with collections and volumes"},
    {"collections rejected", "bodies that an edge is not behind, by minimax"},
    {"volumes rejected", "volumes that an edge is not behind, by minimax"},
    {"own volumes", "volumes that have an edge in a front plane"},
    {"edge/volume test", "fragments put to a convex volume"},
    {"hidden whole", "tests that left nothing"},
    {"untouched", "tests that left all"},
    {"one piece left", "tests that left one piece"},
    {"two pieces left", "tests that left two pieces"},
    {"fragments", "edges and what was split off them"},
    {"conditions", "planes and contour edges put to a fragment"},
    {"faces apart", "faces that are no volumes put to an edge"},
    {"bodies apart", "bodies that are taken face by face"},
    {0}};

static const struct hsr_step steps[] = {
    {"back-edge cull", BACK_CULL, 1, "E_t", predict_back_cull},
    {"clipping cull", CLIP_CULL, 100, "100 E_s", predict_clip_cull},
    {"minimax", MINIMAX, 1, NULL, NULL},
    {"edge/volume test", TEST, 100, "100 E_s f C_t, f = 4", predict_test},
    {0}};

static const struct hsr_sort sorts[] = {
    {"edges", "back-facing", "cull", "once a frame"},
    {"edges", "clipping", "cull", "once a frame"},
    {"volumes", "before an edge",
     "exhaustive search: minimax, linear programme", "once an edge"},
    {0}};

const struct hsr_algorithm HSR_ALGORITHM(roberts) = {
    .name = "roberts",
    .title = "Roberts' edges against volumes",
    .authors = "L. G. Roberts",
    .year = 1963,
    .source = "MIT Lincoln Laboratory TR 315, 1963; Sutherland et al., "
              "Computing Surveys 6(1), 1974, \"L. G. Roberts (1963)\"",
    .taxonomy = HSR_OBJECT_SPACE_VOLUMES,
    .coherence = "object: a volume leaves at most two pieces of an edge",
    .restrictions = HSR_CC | HSR_TP,
    .kind = HSR_SEGMENTS,
    .flags = HSR_VISIBLE_ONLY,
    .sorts = sorts,
    .counters = counters,
    .steps = steps,
    .expense = expense,
    .prepare = prepare,
    .render = render,
    .release = release};
