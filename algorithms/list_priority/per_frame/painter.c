/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The painter's algorithm, naive: faces painted over one another in the order
 * of their farthest vertices. Nothing is done where that is no priority order.
 *
 * Source      the Z sort of Newell, Newell and Sancha 1972 without their
 *             special sort; Sutherland et al. 1974, "List-Priority Algorithms"
 *             and figure 22, where it goes wrong.
 * Notation    farthest -> farthest[]; the frame buffer -> the picture of ids
 * Invariants  order[] is sorted by farthest vertex, farthest first
 * Ties        of equal depth, the lower id is painted last
 * Departures  None. It is wrong wherever faces overlap in depth and the one
 *             with the farther vertex is in front, and wherever they penetrate
 *             or overlap cyclically. It is here because it is taught and used.
 * Cost        Z sort F_r log2 F_r, painting H_f^2 F_r samples */
#include "algorithms/algorithm.h"
#include "common/exact/order.h"

enum { Z_SORT, SAMPLES };

struct painter {
  const struct hsr_job *job;
  struct hsr_screen screen;
  double *farthest; /* by face */
  uint32_t *order, *other;
  int *columns;
};

static bool goes_first(const struct painter *s, uint32_t f, uint32_t g) {
  bool first = s->farthest[f] != s->farthest[g]
                   ? s->farthest[f] > s->farthest[g]
                   : f > g;
  HSR_STEP(s->job->tally, Z_SORT, HSR_FACE(f), HSR_FACE(g), HSR_NOWHERE, first);
  return first;
}

/* Merges the runs [begin, middle) and [middle, end) of order[] into other[]. */
static void merge(struct painter *s, uint32_t begin, uint32_t middle,
                  uint32_t end) {
  uint32_t a = begin, b = middle;
  for (uint32_t to = begin; to < end; to++) {
    bool first =
        b == end || (a < middle && goes_first(s, s->order[a], s->order[b]));
    s->other[to] = s->order[first ? a++ : b++];
  }
}

static void sort_z(struct painter *s) {
  uint32_t n = s->screen.n_relevant;
  for (uint64_t run = 1; run < n; run *= 2) {
    for (uint64_t begin = 0; begin < n; begin += 2 * run) {
      uint64_t middle = begin + run < n ? begin + run : n;
      uint64_t end = middle + run < n ? middle + run : n;
      merge(s, (uint32_t)begin, (uint32_t)middle, (uint32_t)end);
    }
    uint32_t *swap = s->order;
    s->order = s->other;
    s->other = swap;
  }
}

static void paint(struct painter *s, uint32_t f) {
  const struct hsr_bounds *b = &s->screen.bounds[f];
  struct hsr_face_rows rows;
  hsr_face_rows_begin(&rows, &s->screen, f, s->job->tally);
  for (int j = b->y0; j < b->y1; j++) {
    uint32_t *row = hsr_job_row(s->job, j);
    int n = hsr_face_rows_spans(&rows, j, s->columns, s->job->tally);
    for (int k = 0; k < n; k += 2) {
      int x0 = s->columns[k] > b->x0 ? s->columns[k] : b->x0;
      int x1 = s->columns[k + 1] < b->x1 ? s->columns[k + 1] : b->x1;
      for (int i = x0; i < x1; i++) {
        HSR_STEP(s->job->tally, SAMPLES, HSR_FACE(f), HSR_THE_WINDOW,
                 HSR_AT(i, j), 0);
        HSR_TOUCH(s->job->tally, i, j);
        row[i] = f;
      }
    }
  }
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct painter painter = {.job = job}, *s = &painter;
  const struct hsr_world *world = job->world;
  if (hsr_screen_make(&s->screen, world, job->view, job->scratch, job->tally))
    return hsr_fail_nomem(err);
  uint32_t n = s->screen.n_relevant, corners = 0;
  s->farthest = HSR_NEW(job->scratch, double, world->n_faces);
  s->order = HSR_NEW(job->scratch, uint32_t, n);
  s->other = HSR_NEW(job->scratch, uint32_t, n);
  if (!s->farthest || !s->order || !s->other)
    return hsr_fail_nomem(err);
  for (uint32_t r = 0; r < n; r++) {
    uint32_t f = s->screen.relevant[r], size = hsr_face_size(world, f);
    double nearest;
    corners = size > corners ? size : corners;
    s->order[r] = f;
    hsr_depth_range(&s->screen, (struct hsr_polygon){.face = f}, &nearest,
                    &s->farthest[f]);
  }
  s->columns = HSR_NEW(job->scratch, int, (size_t)corners + 4);
  if (!s->columns)
    return hsr_fail_nomem(err);
  hsr_job_clear(job);
  sort_z(s);
  for (uint32_t r = 0; r < n; r++)
    paint(s, s->order[r]);
  return HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_counter counters[] = {
    [Z_SORT] = {"Z sort", "comparisons of two farthest vertices", HSR_COMPARE,
                HSR_OF_FACE, HSR_OF_FACE, "goes later|goes first",
                .key = "face-sort"},
    [SAMPLES] = {"samples", "samples painted", HSR_ACCEPT, HSR_OF_FACE,
                 HSR_OF_WINDOW},
    {NULL}};

static const struct hsr_line outline[] = {
    {"Z sort: put the faces in order of their farthest vertices",
     HSR_RAISES(Z_SORT)},
    {"for each face, the farthest first"},
    {"  for each scan line that it meets"},
    {"    for each sample between its edges"},
    {"      paint it, over what is there", HSR_RAISES(SAMPLES)},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {"faces", "Z", "merge sort of the farthest vertex", "once a frame"},
    {"samples", "XY", "frame buffer", "once a face"},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(painter) = {
    .name = "painter",
    .title = "The painter's algorithm, naive: known to be wrong",
    .authors = "",
    .year = 1972,
    .source = "the Z sort of Newell et al. 1972 alone; Sutherland et al., "
              "Computing Surveys 6(1), 1974, figure 22",
    .taxonomy = HSR_LIST_PRIORITY_PER_FRAME,
    .sort_order = "Z(XY)",
    .coherence = "depth",
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}},
    .flags = HSR_KNOWN_WRONG,
    .sorts = sorts,
    .counters = counters,
    .outline = outline,
    .render = render};
