/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The survey's first proposal, of three algorithms: Schumacker's clusters,
 * Newell's priority computer within each, and Watkins' scan lines, which compare
 * priority indices.
 *
 * Source      Sutherland et al. 1974. The abstract names "a combination of three
 *             existing algorithms", which would use both frame and scan-line
 *             coherence. "Other Combinations of Sorting" says what each pair is
 *             to do; how the three go together is in no sentence.
 * Notation    cluster, separating plane -> common/scene/clusters.h; the list ->
 *             priority_list.h; scan line, segment, sample span -> watkins.c;
 *             priority number -> priority_scan.h: one index of all clusters
 * Coherence   Frame: the tree of separating planes is made once; in a frame the
 *             eye is compared with each plane. The order within a cluster is kept
 *             from frame to frame (kept_order.h). Scan line: the X sort list and
 *             the sample spans are Watkins'.
 * Invariant   of two pieces that cover a sample, the one with the greater number
 *             is the nearer one: if they are of two clusters, since the plane
 *             that separates these has the eye on the side of the nearer one;
 *             else by the list of the cluster
 * Ties        those of priority_list.h; faces of one plane that share a sample
 *             are in one cluster
 * Departures  Those of priority_list.h, kept_order.h, priority_scan.h and
 *             scan_line.h. Schumacker's priority within a cluster holds for all
 *             eyes; here it is Newell's, "which would no longer need to be
 *             fixed". A loose face (cluster_faces.h) has no place in the order:
 *             its segments are compared in depth. Faces are convex, because
 *             separating planes may cut them.
 * Cost        inter-cluster priority 10 C_t; Newell's steps, of each cluster
 *             alone; those of watkins.c but the depth search: a priority search
 *             is one comparison, where Table III has 30. Nothing is painted
 *             over, so no frame buffer is needed and a hidden cluster is not
 *             painted */
#include "algorithms/list_priority/fixed/cluster_faces.h"
#include "algorithms/list_priority/per_frame/kept_order.h"
#include "algorithms/list_priority/per_frame/priority_scan.h"

struct schumacker_newell_watkins {
  struct hsr_screen screen;
  struct hsr_cluster_order order;
  struct hsr_cluster_faces cluster;
  struct hsr_priority_scan scan;
};

static enum hsr_status prepare(const struct hsr_world *world,
                               const long *option, void **prepared,
                               struct hsr_error *err) {
  (void)option;
  *prepared = hsr_keeper_new(world, world->clusters->n_clusters);
  return *prepared ? HSR_OK : hsr_fail_nomem(err);
}

static enum hsr_status reserve(struct schumacker_newell_watkins *s,
                               const struct hsr_job *job) {
  struct hsr_arena *arena = job->scratch;
  if (hsr_screen_make(&s->screen, job->world, job->view, arena, job->tally) ||
      hsr_cluster_faces_init(&s->cluster, &s->screen, arena) ||
      hsr_cluster_order_init(&s->order, &s->screen, arena, job->tally) ||
      hsr_keeper_begin(job->prepared, job, &s->screen))
    return HSR_E_NOMEM;
  return hsr_priority_scan_reserve(&s->scan, job, &s->screen, job->prepared);
}

/* One index of all faces: cluster after cluster, and in each by its list. */
static enum hsr_status order_faces(struct schumacker_newell_watkins *s,
                                   struct hsr_keeper *keeper) {
  struct hsr_cluster_faces *c = &s->cluster;
  for (uint32_t cluster; hsr_next_cluster(&s->order, false, &cluster);) {
    hsr_cluster_faces_take(c, cluster);
    hsr_keeper_choose(keeper, cluster);
    if (c->n_faces && hsr_priority_scan_add(&s->scan, c->faces, c->n_faces))
      return HSR_E_NOMEM;
  }
  hsr_cluster_faces_take_thick(c);
  for (uint32_t k = 0; k < c->n_loose; k++)
    if (hsr_priority_scan_add_loose(&s->scan, c->loose[k]))
      return HSR_E_NOMEM;
  return HSR_OK;
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct schumacker_newell_watkins s;
  if (reserve(&s, job) || order_faces(&s, job->prepared) ||
      hsr_priority_scan_solve(&s.scan))
    return hsr_fail_nomem(err);
  hsr_keeper_end(job->prepared);
  return HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {{&hsr_cluster_order_part},
                                      {&hsr_list_part},
                                      {&hsr_scan_part},
                                      {&hsr_spans_part},
                                      {&hsr_priority_search_part},
                                      {&hsr_kept_order_part},
                                      {NULL}};

static const struct hsr_line outline[] = {
    {"", .part = &hsr_kept_order_part},
    {"for each cluster, from the farthest, by the separating planes",
     HSR_RAISES(HSR_INTER_CLUSTER)},
    {"  ", .part = &hsr_kept_order_part, .group = HSR_KEPT_LIST_LINES},
    {"  ", .part = &hsr_list_part},
    {"    give P the next priority number"},
    {"", .part = &hsr_scan_part},
    {"", .part = &hsr_spans_part},
    {"", .part = &hsr_priority_search_part},
    {"", .part = &hsr_spans_part, .group = HSR_LINES_AFTER_SEARCH},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {.part = &hsr_cluster_order_part},
    {"faces", "Z", "radix sort of the farthest vertex", "once a cluster"},
    {.part = &hsr_kept_order_part},
    {"faces", "XYZ", "Newell special", "once a cluster"},
    {.part = &hsr_scan_part},
    {.part = &hsr_spans_part},
    {.part = &hsr_priority_search_part},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(schumacker_newell_watkins) = {
    .name = "schumacker-newell-watkins",
    .title = "Schumacker's clusters, Newell's list, then Watkins' scan lines",
    .authors = "I. E. Sutherland, R. F. Sproull, R. A. Schumacker",
    .year = 1974,
    .source = "proposed in Computing Surveys 6(1), 1974, Abstract and \"Other "
              "Combinations of Sorting\"",
    .taxonomy = HSR_LIST_PRIORITY_FIXED,
    .sort_order = "Zp ZYXZ",
    .coherence = "frame; cluster; depth; scan line; edge",
    .restrictions = HSR_CF | HSR_LS,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}},
    .flags = HSR_FRAME_STATE,
    .sorts = sorts,
    .parts = uses,
    .outline = outline,
    .prepare = prepare,
    .render = render,
    .release = hsr_keeper_free};
