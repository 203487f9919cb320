/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sample spans that end at contour edges only.
 *
 * Source      Sutherland et al. 1974, chapter IV, "Edge Coherence": if
 *             penetration were disallowed or otherwise accounted for, edges
 *             that are no contour edges need not change the visibility of
 *             others.
 * Notation    Run: a sequence of segments on a row, each of which ends at a
 *             shared edge where the next one begins. On this row such an edge
 *             is no contour edge. segment[] holds the runs: the samples of a
 *             run, the face of its first segment, and as `piece` the run's
 *             number. part[] holds the segments.
 * Invariants  The surface of a run is continuous from each segment to the next.
 *             So if two runs are on surfaces that are apart, the one that is
 *             nearer at a sample of both is nearer at all samples of both: they
 *             are compared once. If their surfaces may meet, segments are
 *             compared, and a span ends where a segment does.
 * Departures  - The survey leaves open how to account for penetration. Here
 *             surfaces are compared beforehand, once for all views
 *             (common/adapt/surfaces.h).
 *             - Whether an edge is a contour edge is decided on each row: it is
 *             not, if one segment ends there and another begins.
 * Cost        one comparison more for each segment on a row */
#include "algorithms/image_space/point/watkins.h"

/* No segment. */
static const uint32_t NONE = UINT32_MAX;

/* The number in *surfaces of an edge of face f, given by its two vertices;
 * HSR_NOT_SHARED if it is not shared. */
static uint32_t find_shared(const struct hsr_surfaces *surfaces,
                            const struct hsr_world *world, uint32_t f,
                            const struct hsr_edge *line) {
  uint32_t start = world->mesh.start[f], end = world->mesh.start[f + 1];
  for (uint32_t k = start; k < end; k++) {
    uint32_t a = world->mesh.vertex[k];
    uint32_t b = world->mesh.vertex[k + 1 < end ? k + 1 : start];
    if ((a == line->a && b == line->b) || (a == line->b && b == line->a))
      return surfaces->shared[k];
  }
  return HSR_NOT_SHARED;
}

enum hsr_status hsr_watkins_use_runs(struct hsr_watkins *s,
                                     struct hsr_watkins_runs *runs,
                                     const struct hsr_surfaces *surfaces,
                                     int counter) {
  const struct hsr_job *job = s->edges.job;
  struct hsr_arena *arena = job->scratch;
  size_t most = s->edges.most_edges / 2 + 1;
  *runs = (struct hsr_watkins_runs){.surfaces = surfaces, .counter = counter};
  runs->shared = HSR_NEW(arena, uint32_t, s->edges.n_edges);
  runs->part = HSR_NEW(arena, struct hsr_watkins_segment, most);
  runs->next = HSR_NEW(arena, uint32_t, most);
  runs->run_of = HSR_NEW(arena, uint32_t, most);
  runs->first = HSR_NEW(arena, uint32_t, most);
  runs->last_seen = HSR_NEW(arena, uint32_t, most);
  runs->ends_there = HSR_NEW(arena, uint32_t, surfaces->n_shared);
  runs->row_of = HSR_NEW(arena, int, surfaces->n_shared);
  if (hsr_watkins_find_ends(s) || !runs->shared || !runs->part || !runs->next ||
      !runs->run_of || !runs->first || !runs->last_seen || !runs->ends_there ||
      !runs->row_of)
    return HSR_E_NOMEM;
  for (uint32_t e = 0; e < surfaces->n_shared; e++)
    runs->row_of[e] = -1;
  for (uint32_t e = 0; e < s->edges.n_edges; e++) {
    const struct hsr_scan_edge *edge = &s->edges.edge[e];
    runs->shared[e] =
        edge->cut == HSR_NOT_CUT
            ? find_shared(surfaces, job->world, edge->face, &edge->line)
            : HSR_NOT_SHARED;
  }
  s->runs = runs;
  return HSR_OK;
}

/* The segment that ends where segment k begins, at the same edge; or NONE. */
static uint32_t one_before(const struct hsr_watkins *s, uint32_t k, int j) {
  const struct hsr_watkins_runs *runs = s->runs;
  uint32_t edge = runs->shared[s->left[k]];
  return edge != HSR_NOT_SHARED && runs->row_of[edge] == j
             ? runs->ends_there[edge]
             : NONE;
}

/* The same, passing over segments that hold no sample. */
static uint32_t one_with_samples_before(const struct hsr_watkins *s, uint32_t k,
                                        int j) {
  const struct hsr_watkins_segment *part = s->runs->part;
  do
    k = one_before(s, k, j);
  while (k != NONE && part[k].x0 == part[k].x1);
  return k;
}

/* Notes for each shared edge which segment of row j ends there. */
static void note_ends(struct hsr_watkins *s, int j) {
  struct hsr_watkins_runs *runs = s->runs;
  for (uint32_t k = 0; k < runs->n_parts; k++) {
    uint32_t edge = runs->shared[s->right[k]];
    if (edge == HSR_NOT_SHARED)
      continue;
    runs->ends_there[edge] = k;
    runs->row_of[edge] = j;
  }
}

void hsr_watkins_join(struct hsr_watkins *s, int j) {
  struct hsr_watkins_runs *runs = s->runs;
  struct hsr_watkins_segment *part = s->segment;
  s->segment = runs->part;
  runs->part = part;
  runs->n_parts = s->n_segments;
  s->n_segments = 0;
  note_ends(s, j);
  for (uint32_t k = 0; k < runs->n_parts; k++) {
    runs->next[k] = NONE;
    if (part[k].x0 == part[k].x1)
      continue;
    uint32_t before = one_with_samples_before(s, k, j);
    HSR_STEP(s->tally, runs->counter, HSR_FACE(part[k].face), HSR_THE_WINDOW,
             HSR_ON(part[k].x0, part[k].x1, j), before != NONE);
    if (before == NONE) {
      uint32_t run = runs->run_of[k] = s->n_segments++;
      runs->first[run] = runs->last_seen[run] = k;
      s->segment[run] = part[k];
      s->segment[run].piece = run;
    } else {
      runs->run_of[k] = runs->run_of[before];
      runs->next[before] = k;
      s->segment[runs->run_of[k]].x1 = part[k].x1;
    }
  }
}

const struct hsr_watkins_segment *
hsr_watkins_part(const struct hsr_watkins *s,
                 const struct hsr_watkins_segment *run, int x) {
  const struct hsr_watkins_runs *runs = s->runs;
  uint32_t *seen = &runs->last_seen[run->piece];
  if (runs->part[*seen].x0 > x)
    *seen = runs->first[run->piece];
  while (runs->part[*seen].x1 <= x)
    *seen = runs->next[*seen];
  return &runs->part[*seen];
}
