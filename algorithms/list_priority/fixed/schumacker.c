/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Schumacker, Brand, Gilliland and Sharp's algorithm: priorities that hold for
 * every frame, and a search among counters at every raster element.
 *
 * Source      R. A. Schumacker, B. Brand, M. Gilliland, W. Sharp, "Study for
 *             applying computer-generated images to visual simulation",
 *             AFHRL-TR-69-14, 1969; as described by Sutherland et al. 1974,
 *             "List-Priority Algorithms", figures 18 to 20, and appendix B;
 *             figure 29 reconstructed from the text.
 * Notation    cluster, separating plane, face priority ->
 *             common/scene/clusters.h; list of faces -> list[], highest
 *             priority first; pair of down-counters -> struct pair; L and R ->
 *             its left and right
 * Invariants  Of two faces of list[] that share a sample, the nearer is first,
 *             except for the thick ones at its end. The pairs of a scan line
 *             are in the order of list[].
 * Ties        faces of one plane: the lower id has priority, in its cluster
 * Options     frames=kept: face priorities are kept when objects move. By the
 *             survey ("List-Priority Algorithms"), Schumacker "will tolerate
 *             motion of clusters in the environment provided they remain
 *             linearly separable"; and what is computed on objects may be kept
 *             ("Frame and Object Coherence"). frames=anew compares the faces
 *             of every cluster in every frame. Kept, a cluster is known by the
 *             faces of its object (common/adapt/kept_priorities.h). Separating
 *             planes and the order of clusters are found anew: no plane is
 *             moved. Measured in 24 frames of eight closed things
 *             (tests/properties/surfaces/moving_clusters_test.c), the pairs of
 *             faces compared in the first frame and in all later ones: by
 *             steps that no rounding touches 818 and 18,814 anew, 442 and 0
 *             kept; turning about a vertical axis the same, with 3,404 close
 *             pairs to confirm it. Tumbling, of solids without coplanar faces
 *             134 and 3,082 anew, 100 and 0 kept. Boxes that tumble gain
 *             little, 29,766 anew and 24,219 kept: as their coordinates are
 *             rounded, their sides come to penetrate, and a cluster that must
 *             be cut is not kept. In house, harbor and big-harbor nothing
 *             moves: the counts are the same with and without (house 889
 *             pairs, harbor 88,204), since an adapter makes the priorities
 *             once for all eyes
 * Departures  A program does what was built as hardware: it looks at every edge
 *             on every scan line, and at every pair of counters at every raster
 *             element, for 128 elements at once in vectors. So its counts are
 *             those of the hardware; its time is not. The search for the
 *             priorities of a cluster is made once, by an adapter; its
 *             comparisons are known here by their number only. Figure 20 takes
 *             the intercepts of infinite edges: here an edge has one only on
 *             the scan lines that it crosses, and max L < min R is asked of
 *             those. Faces that the near plane cuts, or that are not quite
 *             flat, give the ends of their segments by hsr_face_spans instead.
 *             A face that is not quite flat may have no place in the list,
 *             because it touches another or the eye grazes it. Such faces are
 *             called thick. They are compared in depth with what is visible
 *             without them; these comparisons are counted apart.
 * Glass       A departure: the hardware found one pair, the first. In a
 *             transparent picture the pairs behind it are found as well, up to
 *             the first opaque one. Thick faces are inserted by comparisons in
 *             depth. Then all are combined (docs/transparent-picture.md).
 * Cost        intra-cluster priority 100 F_c^2 C_t, by the adapter
 *             `priorities`, not per frame; inter-cluster priority 10 C_t, but
 *             of the clusters into which those of the scene had to be split;
 *             back-face cull F_r, Y cull n E_s, X sort and priority search
 *             n m S_l */
#include "algorithms/engines/light/glass.h"
#include "algorithms/list_priority/fixed/cluster_order.h"
#include "common/answers/kinds/transparent.h"
#include "common/base/bits.h"
#include "common/base/vector.h"

#include <math.h>
#include <string.h>

enum { FRAMES }; /* option */
static const struct hsr_word frames[] = {
    {"anew", "the face priorities are found anew in every frame", 0},
    {"kept", "they are kept, also of clusters that move", HSR_FOLLOWS},
    {NULL}};
static const struct hsr_option options[] = {
    [FRAMES] = {"frames", "what is done with priorities when objects move",
                frames, 0, 1, 0},
    {NULL}};

enum {
  INTRA_CLUSTER,
  CLOSE_PAIRS,
  KEPT,
  BACK_FACES,
  Y_CULL,
  PRIORITY,
  PAIRS,
  THICKNESS,
  COMBINED,
  SHOWN
};

/* A face of the list. Its edges are edge[first_edge] up to the next one's. */
struct listed {
  uint32_t face, first_edge;
  int side;      /* from which it is seen: +1 its front, -1 from behind */
  bool by_spans; /* its segments are those of hsr_face_spans */
};

enum { BLOCK = 128 };

/* The edges of all listed faces, face after face. An edge meets the scan lines
 * [y0, y1). Those of a face by spans stand for the scan lines of its box, and
 * have no line. */
struct edge {
  struct hsr_edge line;
  int y0, y1;
  uint32_t owner; /* its face, in the list */
  bool left;      /* the face is to its right */
};
struct edges {
  struct edge *edge;
  uint32_t n;

  /* The Y cull, in blocks of BLOCK edges. */
  uint32_t n_blocks;
  int16_t *begin, *end; /* y0 and y1 within the current band */
  uint8_t *meets;       /* the current scan line */
  uint8_t *some;        /* of a block: whether any edge of it does */
};

/* The edges that meet the current scan line, and their intercepts. */
struct intercepts {
  uint32_t n, *edge;
  struct hsr_edge *line;
  int *column;
};

/* The pairs of down-counters of the faces that intersect the scan line, by
 * priority. A face is at a raster element if L < 0 and R > 0. */
struct pairs {
  uint32_t n, *face;
  int *left, *right;
  int16_t *l, *r; /* left and right, as loaded for the current strip */
};

struct schumacker {
  const struct hsr_job *job;
  struct hsr_tally *tally;
  const struct hsr_clusters *clusters;
  const struct hsr_window *window;
  struct hsr_screen screen;

  struct listed *list; /* by priority; then the thick faces, in no order */
  uint32_t n_list, n_thick;
  struct edges edges;
  int band; /* the first scan line of the current band */

  struct intercepts intercepts;
  struct pairs pairs;
  uint32_t n_thick_pairs; /* the last ones */
  int *columns;
  struct hsr_glass *glass; /* if the picture is transparent; else NULL */
  uint32_t *over;          /* then: room for the faces at an element */
};

/* --- Cluster priority, and the list --------------------------------------- */

/* Lists a face, as seen from one of its sides, unless it is a back face or has
 * no sample. */
static void list_face(struct schumacker *s, uint32_t oriented, bool is_thick,
                      struct listed *thick) {
  uint32_t f = oriented / 2;
  int side = oriented % 2 ? -1 : 1;
  bool front = hsr_eye_side(&s->screen, f, s->tally) == side;
  HSR_STEP(s->tally, BACK_FACES, HSR_FACE(f), HSR_NOTHING, HSR_NOWHERE, front);
  if (!front || !hsr_screen_place(&s->screen, f, s->tally))
    return;
  struct listed listed = {.face = f,
                          .side = side,
                          .by_spans = !s->screen.whole[f] ||
                                      s->job->world->mesh.deviation[f] > 0};
  if (is_thick || hsr_grazes(&s->screen, f, s->clusters->reach[f]))
    thick[s->n_thick++] = listed;
  else
    s->list[s->n_list++] = listed;
  s->edges.n += hsr_face_size(s->job->world, f);
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
      hsr_cluster_order_init(&order, &s->screen, arena, s->tally))
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

/* Fills in the edges of face k of the list. Seen from its front, a face runs
 * down on its left side and up on its right. */
static void find_edges(struct schumacker *s, uint32_t k) {
  const struct hsr_world *world = s->job->world;
  const struct listed *listed = &s->list[k];
  const struct hsr_bounds *bounds = &s->screen.bounds[listed->face];
  const uint32_t *vertex = world->mesh.vertex + world->mesh.start[listed->face];
  uint32_t n = hsr_face_size(world, listed->face);
  uint32_t a = vertex[n - 1];
  int row_a = listed->by_spans ? 0 : hsr_vertex_row(&s->screen, a, s->tally);
  for (uint32_t c = 0; c < n; c++) {
    uint32_t b = vertex[c];
    struct edge *edge = &s->edges.edge[listed->first_edge + c];
    *edge = (struct edge){.line = {.a = a, .b = b, .tolerance = -1},
                          .y0 = bounds->y0,
                          .y1 = bounds->y1,
                          .owner = k};
    if (!listed->by_spans) {
      int row_b = hsr_vertex_row(&s->screen, b, s->tally);
      bool down = row_a < row_b;
      edge->y0 = down ? row_a : row_b;
      edge->y1 = down ? row_b : row_a;
      edge->left = down == (listed->side > 0);
      if (row_a != row_b)
        hsr_edge_init(&edge->line, &s->screen, down ? a : b, down ? b : a);
      row_a = row_b;
    }
    a = b;
  }
}

static enum hsr_status make_edges(struct schumacker *s) {
  struct hsr_arena *arena = s->job->scratch;
  struct edges *edges = &s->edges;
  edges->n_blocks = (edges->n + BLOCK - 1) / BLOCK;
  size_t n = (size_t)edges->n_blocks * BLOCK;
  edges->edge = HSR_NEW(arena, struct edge, edges->n);
  edges->begin = HSR_NEW(arena, int16_t, n);
  edges->end = HSR_NEW(arena, int16_t, n);
  edges->meets = HSR_NEW(arena, uint8_t, n);
  edges->some = HSR_NEW(arena, uint8_t, edges->n_blocks);
  if (!edges->edge || !edges->begin || !edges->end || !edges->meets ||
      !edges->some)
    return HSR_E_NOMEM;
  for (size_t e = edges->n; e < n; e++)
    edges->begin[e] = edges->end[e] = 0; /* meets no scan line */
  uint32_t first = 0;
  for (uint32_t k = 0; k < s->n_list; k++) {
    s->list[k].first_edge = first;
    first += hsr_face_size(s->job->world, s->list[k].face);
    find_edges(s, k);
  }
  s->list[s->n_list].first_edge = first;
  return HSR_OK;
}

/* --- The Y cull ----------------------------------------------------------- */

/* Scan lines are culled in bands, whose lines have numbers of 16 bits. */
enum { BAND = 4096 };

static int16_t in_band(const struct schumacker *s, int y) {
  int k = y - s->band;
  return (int16_t)(k < 0 ? 0 : k > BAND ? BAND : k);
}

static void begin_band(struct schumacker *s, int j) {
  struct edges *edges = &s->edges;
  s->band = j;
  for (uint32_t e = 0; e < edges->n; e++) {
    edges->begin[e] = in_band(s, edges->edge[e].y0);
    edges->end[e] = in_band(s, edges->edge[e].y1);
  }
}

/* Which edges of a block meet scan line j of the band, and whether any does. */
static inline uint8_t cull_block(const int16_t *begin, const int16_t *end,
                                 int16_t j, uint8_t *meets) {
  uint8_t some = 0;
  for (int e = 0; e < BLOCK; e++) {
    meets[e] = (j >= begin[e]) & (j < end[e]);
    some |= meets[e];
  }
  return some;
}

HSR_VECTOR_OF_WORDS(cull, (const struct edges *edges, int16_t j), (edges, j)) {
  for (size_t b = 0; b < edges->n_blocks; b++)
    edges->some[b] =
        cull_block(edges->begin + b * BLOCK, edges->end + b * BLOCK, j,
                   edges->meets + b * BLOCK);
}

/* The Y cull: which edges meet scan line j? */
static void cull_edges(struct schumacker *s, int j) {
  const struct edges *edges = &s->edges;
  const struct hsr_window *w = s->window;
  cull(edges, (int16_t)(j - s->band));
  for (uint32_t e = 0; HSR_COUNTING && e < edges->n; e++) {
    const struct edge *edge = &edges->edge[e];
    HSR_STEP(s->tally, Y_CULL,
             HSR_EDGE(edge->line.a, edge->line.b, s->list[edge->owner].face),
             HSR_THE_WINDOW, HSR_ON(w->x0, w->x1, j), edges->meets[e]);
  }
}

/* --- Intercepts, loaded into the counters --------------------------------- */

/* Takes the edges of a block that meet the current scan line, by eights. */
static void take_block(const struct edges *edges, uint32_t block,
                       struct intercepts *found) {
  for (uint32_t first = block * BLOCK; first < (block + 1) * BLOCK; first += 8)
    for (uint64_t meets = hsr_eight_bytes(edges->meets + first); meets;
         meets &= meets - 1) {
      uint32_t e = first + (uint32_t)hsr_first_bit(meets) / 8;
      found->line[found->n] = edges->edge[e].line;
      found->edge[found->n++] = e;
    }
}

static void find_intercepts(struct schumacker *s, int j) {
  const struct edges *edges = &s->edges;
  struct intercepts *found = &s->intercepts;
  found->n = 0;
  for (uint32_t block = 0; block < edges->n_blocks; block++)
    if (edges->some[block])
      take_block(edges, block, found);
  hsr_edge_columns(&s->screen, found->line, found->n, j, found->column,
                   s->tally);
}

static void load_pair(struct schumacker *s, uint32_t f, int left, int right,
                      int j) {
  const struct hsr_window *w = s->window;
  left = left > w->x0 ? left : w->x0;
  right = right < w->x1 ? right : w->x1;
  if (left >= right)
    return;
  HSR_STEP(s->tally, PAIRS, HSR_FACE(f), HSR_THE_WINDOW, HSR_ON(left, right, j),
           0);
  struct pairs *pairs = &s->pairs;
  pairs->face[pairs->n] = f;
  pairs->left[pairs->n] = left - w->x0;
  pairs->right[pairs->n++] = right - w->x0 + 1;
}

/* The segment of a face, whose intercepts are [begin, end): between its
 * greatest left intercept and its least right one. */
static void load_segment(struct schumacker *s, uint32_t f, uint32_t begin,
                         uint32_t end, int j) {
  int max_left = s->window->x0, min_right = s->window->x1;
  for (uint32_t k = begin; k < end; k++) {
    int column = s->intercepts.column[k];
    bool left = s->edges.edge[s->intercepts.edge[k]].left;
    if (left && column > max_left)
      max_left = column;
    if (!left && column < min_right)
      min_right = column;
  }
  load_pair(s, f, max_left, min_right, j);
}

static void load_spans(struct schumacker *s, uint32_t f, int j) {
  int n = hsr_face_spans(&s->screen, f, j, s->columns, s->tally);
  for (int c = 0; c < n; c += 2)
    load_pair(s, f, s->columns[c], s->columns[c + 1], j);
}

static void load_counters(struct schumacker *s, int j) {
  const struct intercepts *found = &s->intercepts;
  s->pairs.n = s->n_thick_pairs = 0;
  for (uint32_t begin = 0, end; begin < found->n; begin = end) {
    uint32_t k = s->edges.edge[found->edge[begin]].owner, before = s->pairs.n;
    const struct listed *listed = &s->list[k];
    end = begin;
    while (end < found->n && found->edge[end] < listed[1].first_edge)
      end++;
    if (listed->by_spans)
      load_spans(s, listed->face, j);
    else
      load_segment(s, listed->face, begin, end, j);
    if (k >= s->n_list - s->n_thick)
      s->n_thick_pairs += s->pairs.n - before;
  }
}

/* --- Priority search ------------------------------------------------------ */

/* Counters and the numbers of pairs have 16 bits. So a scan line is searched in
 * strips of elements, and its pairs in runs. */
enum { ELEMENTS = 128, STRIP = 32 * ELEMENTS, RUN = 4096 };

static int16_t in_strip(int count) {
  return (int16_t)(count < 0 ? 0 : count > STRIP + 1 ? STRIP + 1 : count);
}

/* Loads the counters of n pairs for the strip that begins at element `at`. */
static void load_strip(struct pairs *pairs, uint32_t n, int at) {
  for (uint32_t k = 0; k < n; k++) {
    pairs->l[k] = in_strip(pairs->left[k] - at);
    pairs->r[k] = in_strip(pairs->right[k] - at);
  }
}

/* Decrements n pairs for each of the elements from number `at` of the strip on:
 * a counter that was loaded with L is L - 1 at element 0. Gives the number,
 * from 1, of the first pair that is there, or 0: what the logic network finds.
 * The last pair is looked at first, so that one of higher priority replaces
 * it. */
HSR_VECTOR_OF_WORDS(decrement,
                    (const int16_t *left, const int16_t *right, int n, int at,
                     int16_t pair[ELEMENTS]),
                    (left, right, n, at, pair)) {
  int16_t first[ELEMENTS] = {0};
  for (int k = n; k > 0; k--) {
    int16_t l = (int16_t)(left[k - 1] - at - 1);
    int16_t r = (int16_t)(right[k - 1] - at - 1), number = (int16_t)k;
    for (int16_t e = 0; e < ELEMENTS; e++)
      first[e] = ((l < e) & (r > e)) ? number : first[e];
  }
  memcpy(pair, first, sizeof first);
}

/* The faces that are visible at the elements from number `at` of the strip on,
 * by the first n pairs. */
static void find_visible(const struct pairs *pairs, uint32_t n, int at,
                         uint32_t visible[ELEMENTS]) {
  int16_t pair[ELEMENTS];
  for (int e = 0; e < ELEMENTS; e++)
    visible[e] = HSR_BACKGROUND;
  for (uint32_t end = n, size; end > 0; end -= size) {
    size = end < RUN ? end : RUN;
    const uint32_t *face = pairs->face + (end - size);
    decrement(pairs->l + (end - size), pairs->r + (end - size), (int)size, at,
              pair);
    for (int e = 0; e < ELEMENTS; e++)
      if (pair[e])
        visible[e] = face[pair[e] - 1];
  }
}

static bool is_there(const struct pairs *pairs, uint32_t k, int at) {
  return pairs->left[k] - at - 1 < 0 && pairs->right[k] - at - 1 > 0;
}

/* The pairs [begin, end) were decremented for an element. */
static void count_search(const struct schumacker *s, uint32_t begin,
                         uint32_t end, int i, int j) {
  bool found = false;
  for (uint32_t k = begin; HSR_COUNTING && k < end; k++) {
    bool there = is_there(&s->pairs, k, i - s->window->x0);
    HSR_STEP(s->tally, PRIORITY, HSR_FACE(s->pairs.face[k]), HSR_THE_WINDOW,
             HSR_AT(i, j), there + (there && !found));
    found |= there;
  }
}

static bool is_thick_nearer(struct schumacker *s, uint32_t f, uint32_t g, int i,
                            int j) {
  bool nearer = hsr_nearer(&s->screen, f, g, i, j, s->tally);
  HSR_STEP(s->tally, THICKNESS, HSR_FACE(f), HSR_FACE(g), HSR_AT(i, j), nearer);
  return nearer;
}

/* The face that is visible at (i, j): the given one, or the background, or a
 * thick face. */
static uint32_t search_thick(struct schumacker *s, uint32_t visible, int i,
                             int j) {
  for (uint32_t k = s->pairs.n - s->n_thick_pairs; k < s->pairs.n; k++) {
    uint32_t f = s->pairs.face[k];
    if (!is_there(&s->pairs, k, i - s->window->x0))
      continue;
    if (visible == HSR_BACKGROUND || is_thick_nearer(s, f, visible, i, j))
      visible = f;
  }
  return visible;
}

/* The elements [i, end), at most ELEMENTS of them, of scan line j. */
static void search(struct schumacker *s, int i, int end, int j) {
  uint32_t *row = hsr_job_row(s->job, j);
  uint32_t n_ordered = s->pairs.n - s->n_thick_pairs, visible[ELEMENTS];
  int at = (i - s->window->x0) % STRIP;
  if (at == 0)
    load_strip(&s->pairs, n_ordered, i - s->window->x0);
  find_visible(&s->pairs, n_ordered, at, visible);
  memcpy(row + i, visible, (size_t)(end - i) * sizeof *row);
  for (; (HSR_COUNTING || s->n_thick_pairs) && i < end; i++) {
    count_search(s, 0, n_ordered, i, j);
    count_search(s, n_ordered, s->pairs.n, i, j);
    row[i] = search_thick(s, row[i], i, j);
    if (row[i] != HSR_BACKGROUND)
      HSR_STEP(s->tally, SHOWN, HSR_FACE(row[i]), HSR_THE_WINDOW, HSR_AT(i, j),
               0);
    HSR_TOUCH(s->tally, i, j);
  }
}

/* Lists the faces at (i, j) in over[], by priority. Returns how many. */
static uint32_t list_over(struct schumacker *s, int i, int j) {
  uint32_t n = 0;
  for (uint32_t k = 0; k < s->pairs.n; k++) {
    if (!is_there(&s->pairs, k, i - s->window->x0))
      continue;
    uint32_t f = s->pairs.face[k], at = n++;
    bool thick = k >= s->pairs.n - s->n_thick_pairs;
    for (; thick && at && is_thick_nearer(s, f, s->over[at - 1], i, j); at--)
      s->over[at] = s->over[at - 1];
    s->over[at] = f;
  }
  return n;
}

/* Combines the faces at (i, j), from the first opaque one on. */
static void search_glass(struct schumacker *s, int i, int j) {
  uint16_t *rgb = hsr_glass_at(s->glass, i, j);
  uint32_t n = list_over(s, i, j), k = 0;
  HSR_TOUCH(s->tally, i, j);
  if (!n)
    return;
  while (k < n && hsr_is_glass(s->glass, s->over[k]))
    k++;
  if (k < n)
    hsr_glass_over(s->glass, s->over[k], rgb);
  while (k--) {
    HSR_STEP(s->tally, COMBINED, HSR_FACE(s->over[k]), HSR_THE_WINDOW,
             HSR_AT(i, j), 0);
    hsr_glass_over(s->glass, s->over[k], rgb);
  }
  HSR_ACCEPTED(s->tally, SHOWN, HSR_FACE(s->over[0]), HSR_THE_WINDOW,
               HSR_AT(i, j), rgb);
}

static void search_row_of_glass(struct schumacker *s, int j) {
  uint32_t n_ordered = s->pairs.n - s->n_thick_pairs;
  for (int i = s->window->x0; i < s->window->x1; i++) {
    count_search(s, 0, n_ordered, i, j);
    count_search(s, n_ordered, s->pairs.n, i, j);
    search_glass(s, i, j);
  }
}

static void search_row(struct schumacker *s, int j) {
  const struct hsr_window *w = s->window;
  if (s->glass) {
    search_row_of_glass(s, j);
    return;
  }
  for (int i = w->x0; i < w->x1; i += ELEMENTS)
    search(s, i, i + ELEMENTS < w->x1 ? i + ELEMENTS : w->x1, j);
}

/* --- The algorithm -------------------------------------------------------- */

static enum hsr_status allocate_counters(struct schumacker *s) {
  const struct hsr_world *world = s->job->world;
  struct hsr_arena *arena = s->job->scratch;
  size_t n_pairs = 0, most_corners = 0;
  for (uint32_t k = 0; k < s->n_list; k++) {
    size_t n = hsr_face_size(world, s->list[k].face);
    n_pairs += n / 2 + 2;
    most_corners = n > most_corners ? n : most_corners;
  }
  struct pairs *pairs = &s->pairs;
  pairs->face = HSR_NEW(arena, uint32_t, n_pairs);
  pairs->left = HSR_NEW(arena, int, n_pairs);
  pairs->right = HSR_NEW(arena, int, n_pairs);
  pairs->l = HSR_NEW(arena, int16_t, n_pairs);
  pairs->r = HSR_NEW(arena, int16_t, n_pairs);
  s->columns = HSR_NEW(arena, int, most_corners + 4);
  s->over = HSR_NEW(arena, uint32_t, n_pairs);
  struct intercepts *found = &s->intercepts;
  found->edge = HSR_NEW(arena, uint32_t, s->edges.n);
  found->line = HSR_NEW(arena, struct hsr_edge, s->edges.n);
  found->column = HSR_NEW(arena, int, s->edges.n);
  return pairs->face && pairs->left && pairs->right && pairs->l && pairs->r &&
                 s->columns && s->over && found->edge && found->line &&
                 found->column
             ? HSR_OK
             : HSR_E_NOMEM;
}

/* The Y cull of all edges; and n m S_l by the rule of thumb for S_l, with D_c =
 * 3. */
static double expense(const struct hsr_world *world,
                      const struct hsr_view *view) {
  double m = view->m, n = view->n;
  return n * world->mesh.n_corners + n * m * sqrt(1.5 * world->n_faces * m / n);
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
  HSR_COMPUTED(s->tally, INTRA_CLUSTER, s->clusters->pair_tests);
  HSR_COMPUTED(s->tally, CLOSE_PAIRS, s->clusters->close_tests);
  HSR_COMPUTED(s->tally, KEPT, s->clusters->n_kept);
  struct hsr_glass glass;
  if (make_list(s) || make_edges(s) || allocate_counters(s) ||
      (hsr_answer_colours_of(job->answer) && hsr_glass_begin(&glass, job)))
    return hsr_fail_nomem(err);
  s->glass = hsr_answer_colours_of(job->answer) ? &glass : NULL;
  for (int j = s->window->y0; j < s->window->y1; j++) {
    if ((j - s->window->y0) % BAND == 0)
      begin_band(s, j);
    cull_edges(s, j);
    find_intercepts(s, j);
    load_counters(s, j);
    search_row(s, j);
  }
  return HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {{&hsr_cluster_order_part}, {NULL}};

static const struct hsr_counter counters[] = {
    [INTRA_CLUSTER] = {"intra-cluster priority",
                       "pairs of faces compared to make the clusters; not of "
                       "this frame, but once, before the first",
                       HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, .computed = true},
    [CLOSE_PAIRS] = {"close pairs",
                     "pairs of faces that touch, in clusters that moved, "
                     "compared anew to confirm the priorities that are kept",
                     HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, .computed = true},
    [KEPT] = {"priorities kept",
              "faces, as seen from either side, whose priorities are those of "
              "another frame",
              HSR_SORT, HSR_OF_FACE, HSR_OF_NOTHING, .computed = true},
    [BACK_FACES] = {"back-face cull",
                    "faces, as seen from either side, that are tested for "
                    "being back faces",
                    HSR_COMPARE, HSR_OF_FACE, HSR_OF_NOTHING, "back|front",
                    .key = "back-face-cull", .outcome_keys = "|front"},
    [Y_CULL] = {"Y cull",
                "edges of listed faces, each face counting its own, on every "
                "scan line",
                HSR_COMPARE, HSR_OF_EDGE, HSR_OF_WINDOW,
                "does not meet it|meets it"},
    [PRIORITY] = {"priority search",
                  "pairs of counters looked at, on every raster element all of "
                  "the scan line's",
                  HSR_SAMPLE, HSR_OF_FACE, HSR_OF_WINDOW,
                  "not there|there|there, with the highest priority",
                  .key = "priority-search"},
    [PAIRS] = {"counter pairs", "pairs of counters loaded with intercepts",
               HSR_ACTIVATE, HSR_OF_FACE, HSR_OF_WINDOW, .key = "counter-pair"},
    [THICKNESS] = {"thickness checks",
                   "comparisons in depth with faces that are not flat and have "
                   "no place in the list",
                   HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE, "farther|nearer"},
    [COMBINED] = {"combined", "transparent faces put over what is behind",
                  HSR_SAMPLE, HSR_OF_FACE, HSR_OF_WINDOW},
    [SHOWN] = {"samples shown", "samples at which a face is visible",
               HSR_ACCEPT, HSR_OF_FACE, HSR_OF_WINDOW},
    {NULL}};

static const struct hsr_line outline[] = {
    {"once: for each cluster, compare each face with each other for a face "
     "priority",
     HSR_RAISES(INTRA_CLUSTER)},
    {"  if it has moved since: compare again those that touch",
     HSR_RAISES(CLOSE_PAIRS)},
    {"    else they keep the priorities that they have", HSR_RAISES(KEPT)},
    {"for each cluster, the nearest first, by the tree of separating planes",
     HSR_RAISES(HSR_INTER_CLUSTER)},
    {"  for each of its faces, the highest priority first"},
    {"    list it, unless it is a back face", HSR_RAISES(BACK_FACES)},
    {"for each scan line"},
    {"  for each edge of each listed face: does the scan line meet it?",
     HSR_RAISES(Y_CULL)},
    {"  where max L < min R, load a pair of down-counters", HSR_RAISES(PAIRS)},
    {"  for each raster element"},
    {"    decrement all counters; which is the first pair with L < 0 < R?",
     HSR_RAISES(PRIORITY)},
    {"    compare it in depth with thick faces that are there",
     HSR_RAISES(THICKNESS)},
    {"    put the transparent ones over the first opaque one",
     HSR_RAISES(COMBINED)},
    {"    show its face", HSR_RAISES(SHOWN)},
    {NULL}};

static double predict_intra_cluster(const struct hsr_table1 *t) {
  return 100 * t->F_c * t->F_c * t->C_t;
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
    {"intra-cluster priority", INTRA_CLUSTER, HSR_KIND_CLUSTER,
     "100 F_c^2 C_t, not per frame", predict_intra_cluster},
    {"moving clusters", CLOSE_PAIRS, HSR_KIND_CLUSTER},
    {.part = &hsr_cluster_order_part},
    {"back-face cull", BACK_FACES, HSR_KIND_CULL, "F_r", predict_back_faces},
    {"Y cull", Y_CULL, HSR_KIND_LINE, "n E_s", predict_y_cull},
    {"X sort and priority search", PRIORITY, HSR_KIND_ELEMENT, "n m S_l",
     predict_priority},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {"faces of a cluster", "Z", "priority graph", "once for all frames"},
    {.part = &hsr_cluster_order_part},
    {"faces", "facing", "cull", "once a frame"},
    {"edges", "Y", "cull", "once a scan line"},
    {"segments", "X", "counters", "once a raster element"},
    {"segments", "Z", "priority search", "once a raster element"},
    {NULL}};

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
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}, {HSR_TRANSPARENT}},
    .sorts = sorts,
    .parts = uses,
    .counters = counters,
    .steps = steps,
    .outline = outline,
    .options = options,
    .expense = expense,
    .render = render};
