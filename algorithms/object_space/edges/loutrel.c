/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Loutrel's hidden-line algorithm: edges are crossed in the picture plane, and
 * then compared in depth.
 *
 * Source      P. P. Loutrel, "A Solution to the Hidden-Line Problem for
 *             Computer-Drawn Polyhedra", New York University TR 400-167, 1967,
 *             and IEEE Trans. Computers C-19(3), 1970; Sutherland et al. 1974,
 *             "Edge-Intersection Algorithms", "Minimax Tests".
 * Notation    order of invisibility -> invisibility; boundary edge -> contour
 *             edge c from C to D; edge e from A to B
 * Invariants  those of edge_intersection.h. A boundary edge changes the order
 *             of invisibility of an edge just where their images cross and it
 *             is the nearer one.
 * Ties        the edge e is displaced (common/lines/sight/sight.h), so that
 *             no end of one image lies on the other, and images do not overlap
 * Departures  Whether images cross is told by the sides of the ends of each
 *             about the other: these are the signs of the determinants whose
 *             quotients are the intersection's coordinates. The place along the
 *             edge is computed only for boundary edges that are nearer.
 * Options     those of edge_intersection.h
 * Cost        that of edge_intersection.h; the edge intersection grows as the
 *             square of the edges. Most pairs end at the minimax test. Loutrel
 *             asks for the intersection in the picture plane first, and then
 *             compares two depths there; Appel asks whether the plane of the
 *             eye and the edge is pierced, and then for the vorticity. They
 *             differ in that, not in what they find. */
#include "algorithms/object_space/edges/edge_intersection.h"
#include "common/answers/kinds/segments.h"

enum { PLANE, DEPTH };
static const struct hsr_option options[] = {
    [HSR_NETWORK_BOXES] = {"boxes", "how boundary edges are sorted",
                           hsr_edge_sortings, 0, HSR_IN_GROUPS, HSR_NOT_SORTED},
    {NULL}};

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

/* Puts e to boundary edge c. */
static enum hsr_status cross_one(struct hsr_network *network, uint32_t e,
                                 uint32_t c) {
  struct hsr_tally *tally = network->tally;
  enum hsr_crossing found = compare(network, e, c);
  if (HSR_COUNTING) {
    struct hsr_subject of_e = hsr_edge_subject(network->edges, e);
    struct hsr_subject of_c = hsr_edge_subject(network->edges, c);
    hsr_network_compared(network, e, c, found);
    if (found >= HSR_CROSSES_FARTHER)
      HSR_STEP(tally, PLANE, of_e, of_c, HSR_NOWHERE,
               found == HSR_CROSSES_NEARER);
    if (found == HSR_CROSSES_NEARER)
      HSR_STEP(tally, DEPTH, of_e, of_c, HSR_NOWHERE, 0);
  }
  return found == HSR_CROSSES_NEARER
             ? hsr_network_cross(network, e, c, network->net[c])
             : HSR_OK;
}

/* Finds the boundary edges that change the order of invisibility along e. */
static enum hsr_status cross(void *context, struct hsr_network *network,
                             uint32_t e) {
  (void)context;
  bool sorted = network->job->option[HSR_NETWORK_BOXES] == HSR_BY_CORNER;
  return hsr_network_cross_edges(network, e, sorted ? NULL : &network->contours,
                                 network->contour, cross_one);
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  return hsr_network_render(job, &(struct hsr_intersector){.cross = cross},
                            err);
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {{&hsr_network_part},
                                      {&hsr_hiding_number_part},
                                      {&hsr_box_sort_part},
                                      {NULL}};

static const struct hsr_counter counters[] = {
    [PLANE] = {"plane intersections",
               "pairs whose images cross, compared in depth", HSR_COMPARE,
               HSR_OF_EDGE, HSR_OF_EDGE, "farther|nearer",
               .key = "plane-intersection"},
    [DEPTH] = {"nearer boundary edges",
               "of those, where the boundary edge is nearer", HSR_ACTIVATE,
               HSR_OF_EDGE, HSR_OF_EDGE},
    {NULL}};

static const struct hsr_line outline[] = {
    {"", .part = &hsr_box_sort_part},
    {"", .part = &hsr_network_part},
    {"", .part = &hsr_box_sort_part, .group = HSR_LINES_OF_GROUPS},
    {"    for each boundary edge", HSR_RAISES(HSR_INTERSECT)},
    {"      minimax test: do the boxes of the images overlap?",
     HSR_RAISES(HSR_OVERLAPS)},
    {"      do the images intersect in the picture plane?", HSR_RAISES(PLANE)},
    {"      is the boundary edge the nearer one there?", HSR_RAISES(DEPTH)},
    {"", .part = &hsr_network_part, .group = HSR_LINES_AFTER_CROSSINGS},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {"edges", "back-facing, boundary", "cull", "once a frame"},
    {"faces", "before a vertex", "exhaustive search", "once a cluster"},
    {"boundary edges", "X, Y", "minimax", "once an edge"},
    {"boundary edges", "crossing in the picture plane", "exhaustive search",
     "once an edge"},
    {"boundary edges", "Z", "comparison", "once an intersection"},
    {"faces", "before an edge's end", "cull", "twice an edge"},
    {"crossings", "along the edge", "sort", "once an edge"},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(loutrel) = {
    .name = "loutrel",
    .title = "Loutrel's order of invisibility",
    .authors = "P. P. Loutrel",
    .year = 1967,
    .source = "New York University TR 400-167, 1967; IEEE Trans. Computers "
              "C-19(3), 1970, 205-213; Sutherland et al., Computing Surveys "
              "6(1), 1974, \"Edge-Intersection Algorithms\"",
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
    .render = render,
    .expense = hsr_network_expense,
    .release = hsr_network_release};
