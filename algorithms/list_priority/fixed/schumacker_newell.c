/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Schumacker's order of clusters, and Newell's priority computer within each:
 * clusters are painted on a frame buffer, one over the other.
 *
 * Source      Sutherland et al. 1974, "Other Combinations of Sorting": a
 *             proposal in two sentences, and its sorting order Zp ZYX, p for a
 *             partial sort.
 * Notation    cluster, separating plane -> common/scene/clusters.h; the list ->
 *             priority_list.h; painting -> newell.c
 * Invariant   at every sample the last one painted is the nearest of those
 *             painted so far
 * Ties        those of priority_list.h; faces of one plane that share a sample
 *             are in one cluster
 * Options     output=beads: into Newell's beads instead of a frame buffer. The
 *             text has the frame buffer; the sorting order Zp ZYX is that of
 *             beads, as the survey writes Z(XY) where Newell's is on a frame
 *             buffer. So what is painted costs as with newell-frame-buffer, or,
 *             with beads, as with newell
 * Departures  Those of priority_list.h. A loose face (cluster_faces.h) is
 *             painted after all clusters, where it is nearer than what is
 *             there; these comparisons are among the thickness checks. Faces
 *             are convex, because separating planes may cut them.
 * Cost        inter-cluster priority 10 C_t; and Newell's steps beside the
 *             predictions for it alone: here each list is that of one cluster,
 *             and faces of different clusters are never compared */
#include "algorithms/list_priority/fixed/cluster_faces.h"
#include "algorithms/list_priority/per_frame/newell.h"

enum { OUTPUT }; /* option */
enum { FRAME_BUFFER, BEADS };
static const struct hsr_word outputs[] = {
    [FRAME_BUFFER] = {"frame-buffer", "on a frame buffer", 0},
    [BEADS] = {"beads", "into beads, as Newell's", 0},
    {NULL}};
static const struct hsr_option options[] = {
    [OUTPUT] = {"output", "what segments are painted on", outputs, 0, BEADS,
                FRAME_BUFFER},
    {NULL}};

struct schumacker_newell {
  struct hsr_screen screen;
  struct hsr_cluster_order order;
  struct hsr_cluster_faces cluster;
  struct hsr_newell newell;
};

static enum hsr_status reserve(struct schumacker_newell *s,
                               const struct hsr_job *job) {
  struct hsr_arena *arena = job->scratch;
  if (hsr_screen_make(&s->screen, job->world, job->view, arena, job->tally) ||
      hsr_cluster_faces_init(&s->cluster, &s->screen, arena) ||
      hsr_cluster_order_init(&s->order, &s->screen, arena, job->tally))
    return HSR_E_NOMEM;
  return hsr_newell_reserve(&s->newell, job, &s->screen, NULL,
                            s->screen.n_relevant);
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct schumacker_newell schumacker_newell, *s = &schumacker_newell;
  if (reserve(s, job))
    return hsr_fail_nomem(err);
  s->newell.frame_buffer = job->option[OUTPUT] == FRAME_BUFFER;
  hsr_newell_open(&s->newell, &job->view->window);
  for (uint32_t cluster; hsr_next_cluster(&s->order, false, &cluster);) {
    hsr_cluster_faces_take(&s->cluster, cluster);
    hsr_newell_paint(&s->newell, s->cluster.faces, s->cluster.n_faces);
  }
  hsr_cluster_faces_take_thick(&s->cluster);
  for (uint32_t k = 0; k < s->cluster.n_loose; k++)
    hsr_newell_paint_unordered(&s->newell, s->cluster.loose[k]);
  hsr_newell_show(&s->newell);
  return s->newell.list.out_of_memory ? hsr_fail_nomem(err) : HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {{&hsr_cluster_order_part},
                                      {&hsr_list_part},
                                      {&hsr_painting_part},
                                      {&hsr_beads_part},
                                      {NULL}};

static const struct hsr_line outline[] = {
    {"for each cluster, from the farthest, by the separating planes",
     HSR_RAISES(HSR_INTER_CLUSTER)},
    {"  ", .part = &hsr_list_part},
    {"  ", .part = &hsr_painting_part},
    {"      with beads: merge it among those of its scan line",
     HSR_RAISES(HSR_BEAD_MERGE)},
    {"      paint it on the frame buffer, or show the beads in the end",
     HSR_RAISES(HSR_NEWELL_WRITTEN)},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {.part = &hsr_cluster_order_part},
    {"faces", "Z", "radix sort of the farthest vertex", "once a cluster"},
    {"faces", "XYZ", "Newell special", "once a cluster"},
    {"samples", "XY", "frame buffer", "once a segment"},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(schumacker_newell) = {
    .name = "schumacker-newell",
    .title = "Schumacker's order of clusters, then Newell's priority list",
    .authors = "I. E. Sutherland, R. F. Sproull, R. A. Schumacker",
    .year = 1974,
    .source = "proposed in Computing Surveys 6(1), 1974, \"Other Combinations "
              "of Sorting\"",
    .taxonomy = HSR_LIST_PRIORITY_FIXED,
    .sort_order = "Zp ZYX",
    .coherence = "frame; cluster; depth",
    .restrictions = HSR_CF | HSR_LS,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}},
    .sorts = sorts,
    .parts = uses,
    .outline = outline,
    .options = options,
    .render = render};
