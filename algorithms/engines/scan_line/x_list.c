/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Other ways of keeping the X sort list, as Sutherland et al. 1974 propose: a
 * tree, edges presorted by X, and a sort that waits for the next crossing. See
 * scan_line.h.
 *
 * Tree        A binary tree in which an edge stands to the right of those in
 *             its left subtree. It is kept flat by giving each node a random
 *             rank: no node's is below its children's. `root` and `next` of
 *             node[] are numbers of nodes. A node has the number of the edge
 *             for which it was made, but when the bubble sort interchanges two
 *             edges they change their nodes.
 * Crossings   Both edges are straight. If one is to the left of the other on
 *             two scan lines, by a column or more, it is so in between, and no
 *             sort is needed there. So what is predicted is proved. */
#include "algorithms/engines/scan_line/scan_line.h"

#include <string.h>

static const uint32_t NONE = UINT32_MAX;

enum hsr_status hsr_scan_choose(struct hsr_scan *s, struct hsr_scan_ways ways) {
  const struct hsr_window *w = &s->job->view->window;
  struct hsr_arena *arena = s->job->scratch;
  s->ways = ways;
  s->root = NONE;
  if (ways.tree) {
    s->node = HSR_NEW(arena, struct hsr_x_node, s->most_edges);
    s->in_order = HSR_NEW(arena, uint32_t, s->most_edges);
    if (!s->node || !s->in_order)
      return HSR_E_NOMEM;
  }
  if (ways.presort) {
    s->x_bucket = HSR_NEW(arena, uint32_t, (size_t)(w->x1 - w->x0) + 2);
    s->by_x = HSR_NEW(arena, uint32_t, s->most_edges);
    if (!s->x_bucket || !s->by_x)
      return HSR_E_NOMEM;
  }
  if (ways.crossings) {
    s->known = HSR_NEW_ZEROED(arena, struct hsr_scan_known, s->most_edges);
    if (!s->known)
      return HSR_E_NOMEM;
  }
  return HSR_OK;
}

/* --- Presorting ----------------------------------------------------------- */

/* The X bucket of an edge: its column on its first scan line. */
static int x_bucket_of(const struct hsr_scan *s, uint32_t e) {
  const struct hsr_window *w = s->window;
  int x = s->edge[e].column;
  return (x < w->x0 ? w->x0 : x > w->x1 ? w->x1 : x) - w->x0;
}

/* Finds the columns of all edges on their first scan lines, and how many edges
 * there are in each X bucket. */
static void count_x_buckets(struct hsr_scan *s) {
  const struct hsr_window *w = s->window;
  size_t n = (size_t)(w->x1 - w->x0) + 2;
  memset(s->x_bucket, 0, n * sizeof *s->x_bucket);
  for (uint32_t k = 0; k < s->n_edges; k++) {
    uint32_t e = s->in_bucket[k];
    struct hsr_scan_edge *edge = &s->edge[e];
    hsr_scan_column(s, edge, edge->row);
    int x = x_bucket_of(s, e);
    HSR_STEP(s->tally, HSR_X_PRESORT, hsr_scan_subject(edge), HSR_NOTHING,
             hsr_window_make(w->x0 + x, edge->row, w->x0 + x, edge->row + 1),
             0);
    s->x_bucket[x + 1]++;
  }
}

/* Sorts all edges by X, and then into the Y buckets in this order. */
void hsr_scan_presort(struct hsr_scan *s) {
  count_x_buckets(s);
  for (int x = 1; x <= s->window->x1 - s->window->x0; x++)
    s->x_bucket[x] += s->x_bucket[x - 1];
  for (uint32_t e = s->n_edges; e-- > 0;)
    s->by_x[s->x_bucket[x_bucket_of(s, e)]++] = e;
  hsr_scan_fill_buckets(s, s->by_x);
}

/* --- Tree ----------------------------------------------------------------- */

/* The rank of a node: a random number, the same in every run. */
static uint32_t rank(uint32_t node) {
  uint32_t x = node * 0x9e3779b1u;
  x = (x ^ x >> 15) * 0x85ebca77u;
  return x ^ x >> 13;
}

/* Both subtrees as one, `left` in front. */
static uint32_t join(struct hsr_scan *s, uint32_t left, uint32_t right) {
  if (left == NONE || right == NONE)
    return left == NONE ? right : left;
  if (rank(left) >= rank(right)) {
    s->node[left].right = join(s, s->node[left].right, right);
    return left;
  }
  s->node[right].left = join(s, left, s->node[right].left);
  return right;
}

/* A subtree without the edges that end above row j. */
static uint32_t retire(struct hsr_scan *s, uint32_t root, int j) {
  if (root == NONE)
    return NONE;
  struct hsr_x_node *node = &s->node[root];
  node->left = retire(s, node->left, j);
  node->right = retire(s, node->right, j);
  return s->edge[node->edge].end_row > j ? root
                                         : join(s, node->left, node->right);
}

/* A subtree with one more node, whose rank moves it up. */
static uint32_t insert(struct hsr_scan *s, uint32_t root, uint32_t e, int j) {
  if (root == NONE)
    return e;
  struct hsr_x_node *node = &s->node[root];
  const struct hsr_scan_edge *other = &s->edge[node->edge];
  bool left = other->column > s->edge[e].column;
  hsr_scan_step(s, HSR_X_MERGE, &s->edge[e], other, left, j);
  uint32_t below = insert(s, left ? node->left : node->right, e, j);
  struct hsr_x_node *child = &s->node[below];
  if (rank(below) <= rank(root)) {
    *(left ? &node->left : &node->right) = below;
    return root;
  }
  if (left) {
    node->left = child->right;
    child->right = root;
  } else {
    node->right = child->left;
    child->left = root;
  }
  return below;
}

/* Puts the edges of a subtree into list[], and its nodes into in_order[]. */
static void list_in_order(struct hsr_scan *s, uint32_t root) {
  if (root == NONE)
    return;
  list_in_order(s, s->node[root].left);
  s->in_order[s->n_list] = root;
  s->list[s->n_list++] = s->node[root].edge;
  list_in_order(s, s->node[root].right);
}

void hsr_x_tree_retire(struct hsr_scan *s, int j) {
  s->root = retire(s, s->root, j);
}

void hsr_x_tree_merge(struct hsr_scan *s, int j) {
  for (uint32_t k = 0; k < s->n_entering; k++) {
    uint32_t e = s->entering[k];
    s->node[e] = (struct hsr_x_node){.edge = e, .left = NONE, .right = NONE};
    s->root = insert(s, s->root, e, j);
  }
  s->n_list = 0;
  list_in_order(s, s->root);
}

void hsr_x_tree_store(struct hsr_scan *s) {
  for (uint32_t k = 0; k < s->n_list; k++)
    s->node[s->in_order[k]].edge = s->list[k];
}

/* --- Crossings ------------------------------------------------------------ */

static int column_on(struct hsr_scan *s, const struct hsr_scan_edge *edge,
                     int j) {
  return hsr_edge_column(&s->screen, &edge->line, j, s->tally);
}

static bool is_same_line(const struct hsr_scan_edge *a,
                         const struct hsr_scan_edge *b) {
  return a->line.a == b->line.a && a->line.b == b->line.b;
}

/* The scan line up to which `a`, which is to the left of `b` on row j, is known
 * to stay so. */
static int crossing_row(struct hsr_scan *s, const struct hsr_scan_edge *a,
                        const struct hsr_scan_edge *b, int j) {
  int gap = b->column - a->column;
  int last = (a->end_row < b->end_row ? a->end_row : b->end_row) - 1;
  if (is_same_line(a, b) || last <= j)
    return last + 1;
  int gap_there = column_on(s, b, last) - column_on(s, a, last);
  if (gap_there > 0)
    return last + 1;
  /* The gap grows evenly; one scan line less, since columns are rounded. */
  int row = j + (int)((double)(last - j) * gap / (gap - gap_there)) - 1;
  return row > j && column_on(s, a, row) < column_on(s, b, row) ? row + 1
                                                                : j + 1;
}

/* Nothing is predicted of cut faces, nor of two edges in one column, whose
 * order may be either. */
void hsr_scan_predict(struct hsr_scan *s, uint32_t left, uint32_t right,
                      int j) {
  struct hsr_scan_edge *a = &s->edge[left], *b = &s->edge[right];
  if (a->cut != HSR_NOT_CUT || b->cut != HSR_NOT_CUT ||
      (a->column == b->column && !is_same_line(a, b)))
    return;
  int until = crossing_row(s, a, b, j);
  s->known[left] = (struct hsr_scan_known){right, until};
  hsr_scan_step(s, HSR_X_CROSSINGS, a, b, until > j + 1, j);
}

/* --- What it counts ------------------------------------------------------- */

static const struct hsr_counter counters[] = {
    {"X presort", "edges put into X buckets", HSR_SORT, HSR_OF_EDGE,
     HSR_OF_NOTHING},
    {"X crossings", "predictions of where an edge crosses its neighbor",
     HSR_COMPARE, HSR_OF_EDGE, HSR_OF_EDGE, "next line|later"},
    {NULL}};

static const struct hsr_step steps[] = {
    {"X merge", HSR_X_PRESORT, HSR_KIND_BUCKET},
    {"X sort", HSR_X_CROSSINGS, HSR_KIND_TWO_SEGMENTS},
    {NULL}};

const struct hsr_part hsr_x_list_part = {
    HSR_PART_X_LIST, counters, steps, NULL, {NULL}};
