/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Schumacker, Brand, Gilliland and Sharp's algorithm: priorities that hold for
 * every frame, and a search among counters at every raster element.
 *
 * Source      R. A. Schumacker, B. Brand, M. Gilliland, W. Sharp, "Study for
 *             applying computer-generated images to visual simulation",
 *             AFHRL-TR-69-14, 1969; as described by Sutherland et al. 1974,
 *             "List-Priority Algorithms", figures 18 to 20, and appendix B;
 *             figure 29 reconstructed from the text.
 * Notation    cluster, separating plane, face priority -> common/scene/clusters.h;
 *             list of faces -> list[], highest priority first; pair of counters
 *             -> struct pair; those with L < 0 < R -> the bits of running[]
 * Invariants  of two faces of list[] that share a sample, the nearer is first,
 *             but for the thick ones at its end; the pairs of a scan line are
 *             in the order of list[]
 * Ties        faces of one plane: the lower id has priority, in its cluster
 * Departures  the hardware is emulated, raster element by raster element. Where
 *             it looks at every edge and decrements every counter, edges that
 *             begin are taken from buckets, and counters are set where they
 *             come to zero; counted is what it does. Edges that a scan line
 *             does not cross have no intercept. A face that is not quite flat
 *             may have no place in the list, because it touches another or the
 *             eye grazes it: it is thick, and compared in depth with what is
 *             visible without it; these comparisons are counted apart.
 * Cost        intra-cluster priority 100 F_c^2 C_t, by the adapter
 *             `priorities`, not per frame; inter-cluster priority 10 C_t, but
 *             of the clusters into which those of the scene had to be split;
 *             back-face cull F_r, Y cull n E_s, X sort and priority search
 *             n m S_l */
#include "algorithms/list_priority/fixed/cluster_order.h"

#include <string.h>

enum {
  INTRA_CLUSTER,
  INTER_CLUSTER,
  BACK_FACES,
  Y_CULL,
  PRIORITY,
  PAIRS,
  THICKNESS
};

static const struct hsr_counter counters[] = {
    [INTRA_CLUSTER] = {"intra-cluster priority",
                       "pairs of faces compared to make the clusters; not of "
                       "this frame, but once, before the first"},
    [INTER_CLUSTER] = {"inter-cluster priority",
                       "separating planes that the eye is compared with"},
    [BACK_FACES] = {"back-face cull", "faces, as seen from either side, that "
                                      "are tested for being back faces"},
    [Y_CULL] = {"Y cull", "edges of listed faces, each face counting its own, "
                          "on every scan line"},
    [PRIORITY] = {"priority search",
                  "pairs of counters looked at, on every raster element all of "
                  "the scan line's"},
    [PAIRS] = {"counter pairs", "pairs of counters loaded with intercepts"},
    [THICKNESS] = {"thickness checks",
                   "comparisons in depth with faces that are not flat and have "
                   "no place in the list"},
    {NULL, NULL}};

static double predict_intra_cluster(const struct hsr_table1 *t) {
  return 100 * t->F_c * t->F_c * t->C_t;
}
static double predict_inter_cluster(const struct hsr_table1 *t) {
  return 10 * t->C_t;
}
static double predict_back_faces(const struct hsr_table1 *t) {
  return t->F_r;
}
static double predict_y_cull(const struct hsr_table1 *t) {
  return t->n * t->E_s;
}
static double predict_priority(const struct hsr_table1 *t) {
  return t->n * t->m * t->S_l;
}

static const struct hsr_step steps[] = {
    {"intra-cluster priority", INTRA_CLUSTER, 100,
     "100 F_c^2 C_t, not per frame", predict_intra_cluster},
    {"inter-cluster priority", INTER_CLUSTER, 10, "10 C_t",
     predict_inter_cluster},
    {"back-face cull", BACK_FACES, 1, "F_r", predict_back_faces},
    {"Y cull", Y_CULL, 1, "n E_s", predict_y_cull},
    {"X sort and priority search", PRIORITY, 1, "n m S_l", predict_priority},
    {NULL, 0, 0, NULL, NULL}};

static const struct hsr_sort sorts[] = {
    {"faces of a cluster", "Z", "priority graph", "once for all frames"},
    {"clusters", "Z", "tree of separating planes", "once a frame"},
    {"faces", "facing", "cull", "once a frame"},
    {"edges", "Y", "cull", "once a scan line"},
    {"segments", "X", "counters", "once a raster element"},
    {"segments", "Z", "priority search", "once a raster element"},
    {NULL, NULL, NULL, NULL}};

/* No face, no pair. */
static const uint32_t NONE = UINT32_MAX;

/* A face of the list: the scan lines [y0, y1) that it may meet, and its edges,
 * if they are followed: from edge[first_edge] to the next one's. */
struct listed {
  uint32_t face, first_edge;
  int y0, y1;
};

/* An edge that crosses the scan lines [y0, y1). */
struct edge {
  struct hsr_edge line;
  int y0, y1;
};

/* The counters of a face that meets the scan line. */
struct pair {
  uint32_t face;
  uint32_t next_begin, next_end; /* another whose L, or R, is the same */
};

struct schumacker {
  const struct hsr_job *job;
  struct hsr_tally *tally;
  const struct hsr_clusters *clusters;
  const struct hsr_window *window;
  struct hsr_screen screen;

  struct listed *list; /* by priority; then the thick faces, by nothing */
  uint32_t n_list, n_thick;
  struct edge *edge;
  uint32_t n_edges;  /* of edge[] */
  uint64_t n_looked; /* edges of all listed faces */

  uint32_t *bucket, *bucket_end; /* listed faces by their first scan line */
  uint32_t *active, *other, n_active; /* those on the scan line, by priority */

  struct pair *pair; /* by priority */
  uint32_t n_pairs, n_thick_pairs;
  uint32_t *begins, *ends; /* a raster element of the window, or one beyond: a
                              pair whose L, or R, it is */
  uint64_t *running;       /* a bit for each pair: L has come to zero, R not */
  uint64_t *words;         /* a bit for each word of running[] that is not 0 */
  int *columns;
};

/* --- Cluster priority, and the list --------------------------------------- */

/* Lists a face, as seen from one of its sides, unless it is a back face or has
 * no sample. */
static void list_face(struct schumacker *s, uint32_t oriented, bool is_thick,
                      struct listed *thick) {
  uint32_t f = oriented / 2;
  int side = oriented % 2 ? -1 : 1;
  HSR_STEP9(s->tally, BACK_FACES, HSR_COMPARE, f, HSR_NO_ID, 0, 0, 0, 0);
  if (hsr_eye_side(&s->screen, f, s->tally) != side ||
      !hsr_screen_place(&s->screen, f, s->tally))
    return;
  const struct hsr_bounds *b = &s->screen.bounds[f];
  struct listed listed = {.face = f, .y0 = b->y0, .y1 = b->y1};
  if (is_thick || hsr_grazes(&s->screen, f, s->clusters->reach[f]))
    thick[s->n_thick++] = listed;
  else
    s->list[s->n_list++] = listed;
  s->n_looked += hsr_face_size(s->job->world, f);
}

/* All clusters, the nearest first. */
static enum hsr_status make_list(struct schumacker *s) {
  const struct hsr_clusters *clusters = s->clusters;
  struct hsr_arena *arena = s->job->scratch;
  uint32_t n_faces = s->job->world->n_faces;
  struct hsr_cluster_order order;
  struct listed *thick = HSR_NEW(arena, struct listed, n_faces);
  s->list = HSR_NEW(arena, struct listed, (size_t)n_faces + 1);
  if (!thick || !s->list ||
      hsr_cluster_order_init(&order, &s->screen, arena, s->tally,
                             INTER_CLUSTER))
    return HSR_E_NOMEM;
  for (uint32_t c; hsr_next_cluster(&order, true, &c);)
    for (uint32_t k = clusters->start[c]; k < clusters->start[c + 1]; k++)
      list_face(s, clusters->order[k], false, thick);
  for (uint32_t k = 0; k < clusters->n_thick; k++)
    list_face(s, clusters->thick[k], true, thick);
  memcpy(s->list + s->n_list, thick, s->n_thick * sizeof *thick);
  s->n_list += s->n_thick;
  return HSR_OK;
}

/* --- Edges ---------------------------------------------------------------- */

/* The edges of a face that can be followed. */
static void find_edges(struct schumacker *s, struct listed *listed) {
  const struct hsr_world *world = s->job->world;
  const uint32_t *vertex = world->vertex + world->start[listed->face];
  uint32_t n = hsr_face_size(world, listed->face), a = vertex[n - 1];
  int row_a = hsr_vertex_row(&s->screen, a, s->tally);
  for (uint32_t k = 0; k < n; k++) {
    uint32_t b = vertex[k];
    int row_b = hsr_vertex_row(&s->screen, b, s->tally);
    if (row_a != row_b) {
      struct edge *edge = &s->edge[s->n_edges++];
      bool down = row_a < row_b;
      hsr_edge_init(&edge->line, &s->screen, down ? a : b, down ? b : a);
      edge->y0 = down ? row_a : row_b;
      edge->y1 = down ? row_b : row_a;
    }
    a = b;
    row_a = row_b;
  }
}

/* Finds all edges, and puts the listed faces into the buckets of the scan lines
 * on which they begin. */
static enum hsr_status make_edges(struct schumacker *s) {
  const struct hsr_window *w = s->window;
  struct hsr_arena *arena = s->job->scratch;
  size_t rows = (size_t)(w->y1 - w->y0);
  s->edge = HSR_NEW(arena, struct edge, s->n_looked);
  s->bucket = HSR_NEW(arena, uint32_t, s->n_list);
  s->bucket_end = HSR_NEW_ZEROED(arena, uint32_t, rows + 1);
  s->active = HSR_NEW(arena, uint32_t, s->n_list);
  s->other = HSR_NEW(arena, uint32_t, s->n_list);
  if (!s->edge || !s->bucket || !s->bucket_end || !s->active || !s->other)
    return HSR_E_NOMEM;
  for (uint32_t k = 0; k < s->n_list; k++) {
    struct listed *listed = &s->list[k];
    listed->first_edge = s->n_edges;
    if (s->screen.whole[listed->face])
      find_edges(s, listed);
    s->bucket_end[listed->y0 - w->y0 + 1]++;
  }
  s->list[s->n_list].first_edge = s->n_edges;
  for (size_t j = 0; j < rows; j++)
    s->bucket_end[j + 1] += s->bucket_end[j];
  for (uint32_t k = 0; k < s->n_list; k++)
    s->bucket[s->bucket_end[s->list[k].y0 - w->y0]++] = k;
  return HSR_OK;
}

/* --- Y cull --------------------------------------------------------------- */

/* Brings the active faces up to date for scan line j: those that begin are
 * merged with those that have not ended. */
static void cull_y(struct schumacker *s, int j) {
  uint32_t row = (uint32_t)(j - s->window->y0);
  uint32_t next = row ? s->bucket_end[row - 1] : 0, end = s->bucket_end[row];
  uint32_t n = 0;
  HSR_COUNT(s->tally, Y_CULL, s->n_looked);
  for (uint32_t k = 0; k < s->n_active; k++) {
    uint32_t old = s->active[k];
    while (next < end && s->bucket[next] < old)
      s->other[n++] = s->bucket[next++];
    if (s->list[old].y1 > j)
      s->other[n++] = old;
  }
  while (next < end)
    s->other[n++] = s->bucket[next++];
  uint32_t *active = s->active;
  s->active = s->other;
  s->other = active;
  s->n_active = n;
}

/* --- Intercepts, loaded into the counters --------------------------------- */

static void load_pair(struct schumacker *s, uint32_t f, int left, int right,
                      int j) {
  const struct hsr_window *w = s->window;
  left = left > w->x0 ? left : w->x0;
  right = right < w->x1 ? right : w->x1;
  if (left >= right)
    return;
  HSR_STEP9(s->tally, PAIRS, HSR_ACTIVATE, f, HSR_NO_ID, left, j, right, j + 1);
  uint32_t *begins = &s->begins[left - w->x0], *ends = &s->ends[right - w->x0];
  s->pair[s->n_pairs] = (struct pair){f, *begins, *ends};
  *begins = *ends = s->n_pairs++;
}

/* Intercepts of a face whose edges are followed: of a convex one, one on the
 * left and one on the right. */
static int find_intercepts(struct schumacker *s, const struct listed *listed,
                           int j) {
  int n = 0;
  for (uint32_t e = listed->first_edge; e < listed[1].first_edge; e++) {
    const struct edge *edge = &s->edge[e];
    if (j < edge->y0 || j >= edge->y1)
      continue;
    int column = hsr_edge_column(&s->screen, &edge->line, j, s->tally), k = n++;
    for (; k && s->columns[k - 1] > column; k--)
      s->columns[k] = s->columns[k - 1];
    s->columns[k] = column;
  }
  return n;
}

static void load_counters(struct schumacker *s, int j) {
  size_t width = (size_t)(s->window->x1 - s->window->x0) + 1;
  memset(s->begins, 0xff, width * sizeof *s->begins);
  memset(s->ends, 0xff, width * sizeof *s->ends);
  s->n_pairs = s->n_thick_pairs = 0;
  for (uint32_t k = 0; k < s->n_active; k++) {
    const struct listed *listed = &s->list[s->active[k]];
    uint32_t f = listed->face;
    int n = s->screen.whole[f]
                ? find_intercepts(s, listed, j)
                : hsr_face_spans(&s->screen, f, j, s->columns, s->tally);
    uint32_t before = s->n_pairs;
    for (int c = 0; c < n; c += 2)
      load_pair(s, f, s->columns[c], s->columns[c + 1], j);
    if (s->active[k] >= s->n_list - s->n_thick)
      s->n_thick_pairs += s->n_pairs - before;
  }
}

/* --- Priority search ------------------------------------------------------ */

static void start_pair(struct schumacker *s, uint32_t k) {
  s->running[k / 64] |= UINT64_C(1) << k % 64;
  s->words[k / 4096] |= UINT64_C(1) << k / 64 % 64;
}

static void stop_pair(struct schumacker *s, uint32_t k) {
  s->running[k / 64] &= ~(UINT64_C(1) << k % 64);
  if (!s->running[k / 64])
    s->words[k / 4096] &= ~(UINT64_C(1) << k / 64 % 64);
}

/* The lowest bit that is set. */
static uint32_t lowest(uint64_t bits) {
#if defined __GNUC__
  return (uint32_t)__builtin_ctzll(bits);
#else
  uint32_t n = 0;
  while (!(bits >> n & 1))
    n++;
  return n;
#endif
}

/* The first running pair from k on: what the logic network does at once. */
static uint32_t first_running(const struct schumacker *s, uint32_t k) {
  if (k >= s->n_pairs)
    return NONE;
  uint64_t rest = s->running[k / 64] >> k % 64;
  if (rest)
    return k + lowest(rest);
  uint32_t word = k / 64 + 1, n_words = (s->n_pairs + 63) / 64;
  while (word < n_words) {
    rest = s->words[word / 64] >> word % 64;
    if (rest) {
      word += lowest(rest);
      return 64 * word + lowest(s->running[word]);
    }
    word = (word / 64 + 1) * 64;
  }
  return NONE;
}

/* The visible one of a face and the thick ones that run at (i, j), whose first
 * is pair k. */
static uint32_t search_thick(struct schumacker *s, uint32_t visible, uint32_t k,
                             int i, int j) {
  for (; k != NONE; k = first_running(s, k + 1)) {
    uint32_t f = s->pair[k].face;
    if (visible == HSR_BACKGROUND) {
      visible = f;
      continue;
    }
    HSR_STEP9(s->tally, THICKNESS, HSR_COMPARE, f, visible, i, j, i + 1, j + 1);
    if (hsr_nearer(&s->screen, f, visible, i, j, s->tally))
      visible = f;
  }
  return visible;
}

static void search_row(struct schumacker *s, int j) {
  const struct hsr_window *w = s->window;
  uint32_t *row = s->job->ids + (size_t)j * s->job->ids_stride;
  uint32_t visible = HSR_BACKGROUND, thick = NONE;
  for (int i = w->x0; i < w->x1; i++) {
    uint32_t begin = s->begins[i - w->x0], end = s->ends[i - w->x0];
    for (uint32_t k = begin; k != NONE; k = s->pair[k].next_begin)
      start_pair(s, k);
    for (uint32_t k = end; k != NONE; k = s->pair[k].next_end)
      stop_pair(s, k);
    if (begin != NONE || end != NONE) {
      uint32_t n_ordered = s->n_pairs - s->n_thick_pairs;
      uint32_t k = first_running(s, 0);
      visible = k < n_ordered ? s->pair[k].face : HSR_BACKGROUND;
      thick = s->n_thick_pairs ? first_running(s, n_ordered) : NONE;
    }
    row[i] = search_thick(s, visible, thick, i, j);
    if (s->n_pairs) {
      HSR_COUNT(s->tally, PRIORITY, s->n_pairs - 1);
      HSR_STEP9(s->tally, PRIORITY, HSR_SAMPLE, row[i], HSR_NO_ID, i, j, i + 1,
                j + 1);
    }
    HSR_TOUCH(s->tally, i, j);
  }
  for (uint32_t k = s->ends[w->x1 - w->x0]; k != NONE; k = s->pair[k].next_end)
    stop_pair(s, k);
}

/* --- The algorithm -------------------------------------------------------- */

static enum hsr_status allocate_counters(struct schumacker *s) {
  const struct hsr_world *world = s->job->world;
  struct hsr_arena *arena = s->job->scratch;
  size_t width = (size_t)(s->window->x1 - s->window->x0) + 1;
  size_t n_pairs = 0, most_corners = 0;
  for (uint32_t k = 0; k < s->n_list; k++) {
    size_t n = hsr_face_size(world, s->list[k].face);
    n_pairs += n / 2 + 2;
    most_corners = n > most_corners ? n : most_corners;
  }
  s->pair = HSR_NEW(arena, struct pair, n_pairs);
  s->begins = HSR_NEW(arena, uint32_t, width);
  s->ends = HSR_NEW(arena, uint32_t, width);
  s->running = HSR_NEW_ZEROED(arena, uint64_t, n_pairs / 64 + 1);
  s->words = HSR_NEW_ZEROED(arena, uint64_t, n_pairs / 4096 + 1);
  s->columns = HSR_NEW(arena, int, most_corners + 4);
  return s->pair && s->begins && s->ends && s->running && s->words && s->columns
             ? HSR_OK
             : HSR_E_NOMEM;
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct schumacker schumacker = {.job = job,
                                  .tally = job->tally,
                                  .clusters = job->world->clusters,
                                  .window = &job->view->window};
  struct schumacker *s = &schumacker;
  if (hsr_screen_init(&s->screen, job->world, job->view, job->scratch))
    return hsr_fail_nomem(err);
  hsr_screen_vertices(&s->screen);
  hsr_screen_planes(&s->screen);
  HSR_COUNT(s->tally, INTRA_CLUSTER, s->clusters->pair_tests);
  if (make_list(s) || make_edges(s) || allocate_counters(s))
    return hsr_fail_nomem(err);
  for (int j = s->window->y0; j < s->window->y1; j++) {
    cull_y(s, j);
    load_counters(s, j);
    search_row(s, j);
  }
  return HSR_OK;
}

const struct hsr_algorithm HSR_ALGORITHM(schumacker) = {
    .name = "schumacker",
    .title = "Schumacker, Brand, Gilliland and Sharp's priority list",
    .authors = "R. A. Schumacker, B. Brand, M. Gilliland, W. Sharp",
    .year = 1969,
    .source = "AFHRL-TR-69-14, 1969; Sutherland et al., Computing Surveys "
              "6(1), 1974, \"List-Priority Algorithms\"",
    .taxonomy = HSR_LIST_PRIORITY_FIXED,
    .sort_order = "ZYX",
    .coherence = "frame; cluster",
    .restrictions = HSR_CF | HSR_LS | HSR_NP | HSR_TP,
    .kind = HSR_IDS,
    .sorts = sorts,
    .counters = counters,
    .steps = steps,
    .render = render};
