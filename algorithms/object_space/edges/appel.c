/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Appel's hidden-line algorithm.
 *
 * Source      A. Appel, "The Notion of Quantitative Invisibility and the
 *             Machine Rendering of Solids", Proc. ACM National Conference,
 *             1967; Sutherland et al. 1974, "Edge-Intersection Algorithms",
 *             figures 14 to 16.
 * Notation    material edge -> relevant edge e from A to B; contour edge c from
 *             C to D; vorticity -> the sides of A and B about c, and which of
 *             the edges is nearer
 * Invariants  those of edge_intersection.h. A contour edge changes the
 *             invisibility of a material edge just where it pierces the
 *             triangle of the eye and that edge.
 * Ties        the material edge is displaced (common/lines/sight/sight.h), so
 *             that no contour edge meets a side of its triangle
 * Departures  a minimax test of the images comes before; Appel's computes in
 *             object coordinates, and has none. The change is the number of faces that the contour edge gains or
 *             loses, which is 2 at a fold of a two-sided surface
 * Options     those of edge_intersection.h
 * Cost        that of edge_intersection.h; the edge intersection grows as the
 *             square of the edges */
#include "algorithms/object_space/edges/edge_intersection.h"
#include "common/answers/kinds/segments.h"

enum { VORTICITY };
static const struct hsr_option options[] = {
    [HSR_NETWORK_BOXES] = {"boxes", "how contour edges are sorted",
                           hsr_edge_sortings, 0, HSR_IN_GROUPS, HSR_NOT_SORTED},
    {NULL}};

/* Does contour edge c pierce the triangle E A' B'? */
static enum hsr_crossing pierce_triangle(const struct hsr_network *network,
                                         uint32_t e, uint32_t c) {
  const struct hsr_edges *edges = network->edges;
  const struct hsr_sight *sight = &network->sight;
  uint32_t A = edges->a[e], B = edges->b[e];
  uint32_t C = edges->a[c], D = edges->b[c];
  if (!hsr_boxes_overlap(&network->box[e], &network->box[c]))
    return HSR_BOXES_APART;
  if (hsr_edges_meet(edges, e, c))
    return HSR_SHARE_A_VERTEX;
  /* It must pierce the triangle's plane: its ends are on different sides. */
  if (hsr_sight_line_side(sight, A, B, C) ==
      hsr_sight_line_side(sight, A, B, D))
    return HSR_DO_NOT_CROSS;
  /* The three directed edges of the triangle must have one vorticity about it:
   * first E A and B E, then A B, which c must pass on the side of the eye. */
  enum hsr_crossing found =
      hsr_sight_side(sight, C, D, A) == hsr_sight_side(sight, C, D, B)
          ? HSR_DO_NOT_CROSS
      : hsr_sight_nearer(sight, e, c) ? HSR_CROSSES_NEARER
                                      : HSR_CROSSES_FARTHER;
  HSR_STEP(network->tally, VORTICITY, hsr_edge_subject(edges, e),
           hsr_edge_subject(edges, c), HSR_NOWHERE,
           found == HSR_CROSSES_NEARER);
  return found;
}

/* Puts e to contour edge c. */
static enum hsr_status cross_one(struct hsr_network *network, uint32_t e,
                                 uint32_t c) {
  enum hsr_crossing found = pierce_triangle(network, e, c);
  hsr_network_compared(network, e, c, found);
  return found == HSR_CROSSES_NEARER
             ? hsr_network_cross(network, e, c, network->net[c])
             : HSR_OK;
}

/* Puts e to all contour edges; or, if their boxes are sorted, to those near it.
 */
static enum hsr_status cross(void *context, struct hsr_network *network,
                             uint32_t e) {
  (void)context;
  bool sorted = network->job->option[HSR_NETWORK_BOXES] == HSR_BY_CORNER;
  return hsr_network_cross_edges(network, e, sorted ? NULL : &network->contours,
                                 network->contour, cross_one);
}

static enum hsr_status run(const struct hsr_job *job, bool visible_only,
                           struct hsr_error *err) {
  struct hsr_intersector intersector = {.cross = cross,
                                        .visible_only = visible_only};
  return hsr_network_render(job, &intersector, err);
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  return run(job, false, err);
}

static enum hsr_status render_visible(const struct hsr_job *job,
                                      struct hsr_error *err) {
  return run(job, true, err);
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {{&hsr_network_part},
                                      {&hsr_hiding_number_part},
                                      {&hsr_box_sort_part},
                                      {NULL}};

static const struct hsr_counter counters[] = {
    [VORTICITY] = {"vorticities",
                   "contour edges that pierce the plane of the eye and an edge",
                   HSR_COMPARE, HSR_OF_EDGE, HSR_OF_EDGE,
                   "outside the triangle|inside"},
    {NULL}};

static const struct hsr_line outline[] = {
    {"", .part = &hsr_box_sort_part},
    {"", .part = &hsr_network_part},
    {"", .part = &hsr_box_sort_part, .group = HSR_LINES_OF_GROUPS},
    {"    for each contour edge: does it pierce the triangle of the eye and "
     "the edge?",
     HSR_RAISES(HSR_INTERSECT)},
    {"      minimax test: do the boxes of the images overlap?",
     HSR_RAISES(HSR_OVERLAPS)},
    {"      if it pierces the plane: is the vorticity of the three sides one?",
     HSR_RAISES(VORTICITY)},
    {"", .part = &hsr_network_part, .group = HSR_LINES_AFTER_CROSSINGS},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {"edges", "back-facing, contour", "cull", "once a frame"},
    {"faces", "before a vertex", "exhaustive search", "once a cluster"},
    {"contour edges", "piercing an edge's triangle", "exhaustive search",
     "once an edge"},
    {"faces", "before an edge's end", "cull", "twice an edge"},
    {"crossings", "along the edge", "sort", "once an edge"},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(appel) = {
    .name = "appel",
    .title = "Appel's quantitative invisibility",
    .authors = "A. Appel",
    .year = 1967,
    .source = "Proc. ACM National Conference, 1967, 387-393; Sutherland et "
              "al., Computing Surveys 6(1), 1974, \"Edge-Intersection "
              "Algorithms\"",
    .taxonomy = HSR_OBJECT_SPACE_EDGES,
    .coherence = "edge: visibility is promoted along edges that share a vertex",
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
    .release = hsr_network_release,
    .expense = hsr_network_expense,
    .render = render};

const struct hsr_algorithm HSR_ALGORITHM(appel_visible) = {
    .name = "appel-visible",
    .title = "Appel's, sorting only edges that may be visible",
    .authors = "A. Appel",
    .year = 1967,
    .source = "Proc. ACM National Conference, 1967, 387-393; Sutherland et "
              "al., Computing Surveys 6(1), 1974, \"Edge-Intersection "
              "Algorithms\"",
    .taxonomy = HSR_OBJECT_SPACE_EDGES,
    .coherence = "edge: visibility is promoted along edges that share a vertex",
    .restrictions = HSR_TP,
    .lifted = HSR_NP,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_SEGMENTS, .how = HSR_VISIBLE_ONLY}},
    .sorts = sorts,
    .parts = uses,
    .counters = counters,
    .outline = outline,
    .options = options,
    .prepare = hsr_network_prepare,
    .release = hsr_network_release,
    .expense = hsr_network_expense,
    .render = render_visible};
