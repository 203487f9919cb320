/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Schumacker's order of clusters, and Watkins' scan lines for each: clusters
 * are painted on a frame buffer, one over the other. Or the order eases Watkins'
 * last step, and nothing is painted over.
 *
 * Source      Sutherland et al. 1974, "Other Combinations of Sorting": a
 *             sentence, and its sorting order Zp YXZ, p for a partial sort.
 * Notation    cluster, separating plane -> common/scene/clusters.h; scan line,
 *             segment, sample span -> watkins.c
 * Invariant   at every sample the last cluster painted is the nearest of those
 *             that cover it so far
 * Ties        those of watkins.c; faces of one plane that share a sample are in
 *             one cluster
 * Options     z=clusters: one pass of scan lines over all faces; of two segments
 *             of different clusters, the clusters' places in the order are
 *             compared, and only within a cluster depths are. "New Uses of
 *             Coherence": of the scan-line algorithms, "The use of
 *             Schumacker's clustering notions might ease the final Z depth
 *             computations, a notion that is considered in the section on
 *             sorting order". What is considered there is z=layers, which
 *             "depend[s] on having an overwritable output buffer"; this is the
 *             notion without one. Measured, the cost of the last step (30 for
 *             an element searched, 1 for two places), by watkins, z=layers and
 *             z=clusters: house 760K, 17K, 38K; harbor 3.66M, 1.16M, 686K;
 *             big-harbor 8.68M, 4.52M, 2.95M. So the step is eased, but in
 *             house layers ease it more. The other steps do not gain: they
 *             cost as much as Watkins' (layers have a tenth of his X merge in
 *             house, a fortieth in the harbors)
 * Departures  Those of scan_line.h. Watkins' scan lines and sample spans are
 *             those of the box of the cluster's faces, not of the picture. A
 *             loose face (cluster_faces.h) is painted after all clusters, where
 *             it is nearer than what is there; these comparisons are counted
 *             apart. Faces are convex, because separating planes may cut them.
 * Cost        inter-cluster priority 10 C_t; and Watkins' steps beside the
 *             predictions for it alone: here each X sort list and each depth
 *             search is that of one cluster, but a hidden cluster is painted,
 *             too */
#include "algorithms/list_priority/fixed/cluster_faces.h"
#include "algorithms/image_space/point/watkins.h"

#include <string.h>

enum { THICKNESS, LOOSE, PLACED, COMPARED };

enum { Z }; /* option */
enum { LAYERS, CLUSTERS };
static const struct hsr_word final_steps[] = {
    [LAYERS] = {"layers", "clusters are painted over one another", 0},
    [CLUSTERS] = {"clusters", "of two clusters, the places in the order tell",
                  0},
    {NULL}};
static const struct hsr_option options[] = {
    [Z] = {"z", "how clusters ease the search in depth", final_steps, 0,
           CLUSTERS, LAYERS},
    {NULL}};

struct schumacker_watkins {
  const struct hsr_job *job;
  struct hsr_screen screen;
  struct hsr_cluster_order order;
  struct hsr_cluster_faces cluster;
  struct hsr_watkins watkins;
  int *columns; /* room for the spans of the largest loose face */
};

/* --- Clusters ------------------------------------------------------------- */

/* The part of the window that the faces of the current cluster are in. */
static struct hsr_window box_of_cluster(const struct schumacker_watkins *s) {
  const struct hsr_window *w = &s->job->view->window;
  struct hsr_window box = {w->x1, w->y1, w->x0, w->y0};
  for (uint32_t k = 0; k < s->cluster.n_faces; k++) {
    const struct hsr_bounds *b = &s->screen.bounds[s->cluster.faces[k]];
    box.x0 = b->x0 < box.x0 ? b->x0 : box.x0;
    box.y0 = b->y0 < box.y0 ? b->y0 : box.y0;
    box.x1 = b->x1 > box.x1 ? b->x1 : box.x1;
    box.y1 = b->y1 > box.y1 ? b->y1 : box.y1;
  }
  return box;
}

static void paint_cluster(struct schumacker_watkins *s) {
  if (!s->cluster.n_faces)
    return;
  struct hsr_window box = box_of_cluster(s);
  hsr_watkins_solve(&s->watkins, &box, s->cluster.faces, s->cluster.n_faces);
}

/* --- Faces in no cluster -------------------------------------------------- */

/* Whether f is nearer than g, or the background, at (i, j). */
static bool is_nearer(struct schumacker_watkins *s, uint32_t f, uint32_t g,
                      int i, int j) {
  if (g == HSR_BACKGROUND)
    return true;
  bool nearer = hsr_nearer(&s->screen, f, g, i, j, s->job->tally);
  HSR_STEP(s->job->tally, THICKNESS, HSR_FACE(f), HSR_FACE(g), HSR_AT(i, j),
           nearer);
  return nearer;
}

static void paint_loose(struct schumacker_watkins *s, uint32_t f) {
  const struct hsr_window *w = &s->job->view->window;
  const struct hsr_bounds *b = &s->screen.bounds[f];
  struct hsr_tally *tally = s->job->tally;
  for (int j = b->y0; j < b->y1; j++) {
    uint32_t *row = hsr_job_row(s->job, j);
    int n = hsr_face_spans(&s->screen, f, j, s->columns, tally);
    for (int k = 0; k < n; k += 2) {
      int x0 = s->columns[k] > w->x0 ? s->columns[k] : w->x0;
      int x1 = s->columns[k + 1] < w->x1 ? s->columns[k + 1] : w->x1;
      for (int i = x0; i < x1; i++) {
        HSR_TOUCH(tally, i, j);
        if (is_nearer(s, f, row[i], i, j)) {
          HSR_STEP(tally, LOOSE, HSR_FACE(f), HSR_THE_WINDOW, HSR_AT(i, j), 0);
          row[i] = f;
        }
      }
    }
  }
}

/* --- Places in the order -------------------------------------------------- */

/* A place has 16 bits. If there are more clusters, neighbours share a place, and
 * are compared in depth. */
static uint16_t place_of(const struct schumacker_watkins *s, uint32_t k) {
  uint32_t n = s->cluster.clusters->n_clusters;
  return (uint16_t)(n <= UINT16_MAX ? k : (uint64_t)k * UINT16_MAX / n);
}

/* Gives each face of a cluster its place: 0 is the nearest cluster's. They take
 * the place of Z buckets. A loose face is in all of them. */
static enum hsr_status place_faces(struct schumacker_watkins *s) {
  const struct hsr_job *job = s->job;
  struct hsr_watkins *w = &s->watkins;
  size_t n_faces = job->world->n_faces;
  w->z_nearest = HSR_NEW_ZEROED(job->scratch, uint16_t, n_faces);
  w->z_farthest = HSR_NEW(job->scratch, uint16_t, n_faces);
  w->z_counter = COMPARED;
  if (!w->z_nearest || !w->z_farthest)
    return HSR_E_NOMEM;
  memset(w->z_farthest, 0xff, n_faces * sizeof *w->z_farthest);
  uint32_t place = 0;
  for (uint32_t cluster; hsr_next_cluster(&s->order, true, &cluster); place++) {
    hsr_cluster_faces_take(&s->cluster, cluster);
    for (uint32_t k = 0; k < s->cluster.n_faces; k++) {
      uint32_t f = s->cluster.faces[k];
      w->z_nearest[f] = w->z_farthest[f] = place_of(s, place);
      HSR_STEP(job->tally, PLACED, HSR_FACE(f), HSR_NOTHING, HSR_NOWHERE, 0);
    }
  }
  return HSR_OK;
}

static void solve_at_once(struct schumacker_watkins *s) {
  hsr_watkins_solve(&s->watkins, &s->job->view->window, s->screen.relevant,
                    s->screen.n_relevant);
}

static void paint_layers(struct schumacker_watkins *s) {
  s->watkins.layer = true;
  hsr_watkins_clear(&s->watkins, &s->job->view->window);
  for (uint32_t cluster; hsr_next_cluster(&s->order, false, &cluster);) {
    hsr_cluster_faces_take(&s->cluster, cluster);
    paint_cluster(s);
  }
  hsr_cluster_faces_take_thick(&s->cluster);
  for (uint32_t k = 0; k < s->cluster.n_loose; k++)
    paint_loose(s, s->cluster.loose[k]);
}

/* --- The algorithm -------------------------------------------------------- */

static enum hsr_status reserve(struct schumacker_watkins *s) {
  const struct hsr_job *job = s->job;
  struct hsr_arena *arena = job->scratch;
  if (hsr_screen_make(&s->screen, job->world, job->view, arena, job->tally) ||
      hsr_cluster_faces_init(&s->cluster, &s->screen, arena) ||
      hsr_cluster_order_init(&s->order, &s->screen, arena, job->tally))
    return HSR_E_NOMEM;
  s->columns = HSR_NEW(arena, int, hsr_most_corners(job->world) + 4);
  return !s->columns ? HSR_E_NOMEM
                     : hsr_watkins_reserve(&s->watkins, job, &s->screen,
                                           hsr_scan_whole_room(&s->screen),
                                           job->world->n_faces);
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct schumacker_watkins schumacker_watkins = {.job = job};
  struct schumacker_watkins *s = &schumacker_watkins;
  bool layers = job->option[Z] == LAYERS;
  if (reserve(s) || (!layers && place_faces(s)))
    return hsr_fail_nomem(err);
  if (layers)
    paint_layers(s);
  else
    solve_at_once(s);
  return HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {{&hsr_cluster_order_part},
                                      {&hsr_scan_part},
                                      {&hsr_spans_part},
                                      {&hsr_depth_search_part},
                                      {NULL}};

static const struct hsr_counter counters[] = {
    [THICKNESS] = {"thickness checks",
                   "comparisons in depth with faces that are not flat and in "
                   "no cluster",
                   HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, "farther|nearer"},
    [LOOSE] = {"loose samples", "samples painted of faces in no cluster",
               HSR_ACCEPT, HSR_OF_FACE, HSR_OF_WINDOW},
    [PLACED] = {"faces placed", "faces given the place of their cluster",
                HSR_SORT, HSR_OF_FACE, HSR_OF_NOTHING},
    [COMPARED] = {"cluster comparisons",
                  "comparisons of the places of two segments' clusters",
                  HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE,
                  "the same cluster|farther|nearer"},
    {NULL}};

static const struct hsr_step steps[] = {{"depth search",
                                         COMPARED,
                                         HSR_KIND_NUMBERS,
                                         NULL,
                                         NULL,
                                         {{PLACED, HSR_KIND_LINK}}},
                                        {NULL}};

static const struct hsr_line outline[] = {
    {"for each cluster, in the order of the separating planes",
     HSR_RAISES(HSR_INTER_CLUSTER)},
    {"  z=clusters: give its faces its place; then scan all clusters at once",
     HSR_RAISES(PLACED)},
    {"  ", .part = &hsr_scan_part},
    {"  ", .part = &hsr_spans_part},
    {"      z=clusters: which of two segments is of the nearer cluster?",
     HSR_RAISES(COMPARED)},
    {"  ", .part = &hsr_depth_search_part},
    {"  ", .part = &hsr_spans_part, .group = HSR_LINES_AFTER_SEARCH},
    {"for each face that is in no cluster, at each of its samples"},
    {"  is it nearer than what is there?", HSR_RAISES(THICKNESS)},
    {"    paint it", HSR_RAISES(LOOSE)},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {.part = &hsr_cluster_order_part},
    {"edges", "Y", "bucket sort", "once a cluster"},
    {"edges", "X", "merge", "as they enter"},
    {"edges", "X", "bubble sort", "once a scan line of a cluster"},
    {"segments", "X", "cull", "once a sample span"},
    {"segments", "Z", "logarithmic search", "once a sample span"},
    {"samples", "XY", "frame buffer", "once a sample span"},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(schumacker_watkins) = {
    .name = "schumacker-watkins",
    .title = "Schumacker's order of clusters, then Watkins' scan lines",
    .authors = "I. E. Sutherland, R. F. Sproull, R. A. Schumacker",
    .year = 1974,
    .source = "proposed in Computing Surveys 6(1), 1974, \"Other Combinations "
              "of Sorting\"",
    .taxonomy = HSR_LIST_PRIORITY_FIXED,
    .sort_order = "Zp YXZ",
    .coherence = "frame; cluster; scan line; edge; floating right end of the "
                 "sample span",
    .restrictions = HSR_CF | HSR_LS,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}},
    .sorts = sorts,
    .parts = uses,
    .counters = counters,
    .steps = steps,
    .outline = outline,
    .options = options,
    .render = render};
