/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A z-buffer behind hierarchical frustum culling.
 *
 * Source      J. H. Clark, "Hierarchical Geometric Models for Visible Surface
 *             Algorithms", Communications of the ACM 19(10), 1976; B. Garlick,
 *             D. Baum and J. Winget, SIGGRAPH course notes, 1990; as told by N.
 *             Greene, PhD thesis, UC Santa Cruz, 1995, 2.1.
 * Notation    node outside, inside, partially inside the frustum: HSR_BOX_OUT,
 *             HSR_BOX_IN, HSR_BOX_PARTIAL
 * Invariant   every face of which something is in the frustum is tiled once
 * Departures  the faces of a node that is partially inside are not tested
 *             against the frustum, but culled by their boxes on the screen, as
 *             those of any other node
 * Cost        proportional to what is in the frustum */
#include "algorithms/engines/cubes/cube_frame.h"

#include <stdlib.h>

enum { NODES, NODES_OUT, NODES_IN, FACES };

/* One frame: the octree of octrees is traversed. */
struct traversal {
  struct hsr_cube_frame frame;
  struct hsr_tally *tally;
};

static void tile_face(struct hsr_tiler *t, uint32_t f) {
  if (hsr_tiler_place(t, f))
    hsr_tiler_tile_generally(t, f);
}

static void tile_batch(struct hsr_tiler *t, uint32_t first, int n) {
  struct hsr_batch batch;
  hsr_tiler_look(t, &batch, first, n);
  if (t->list)
    hsr_cube_join_looked_at(t, &batch);
  hsr_tiler_set_up(t, &batch);
  if (t->list)
    hsr_cube_join_set_up(&batch);
  hsr_tiler_tile_batch(t, &batch);
  for (int k = 0; k < n && batch.general; k++)
    if (batch.fate[k] == HSR_GENERALLY)
      tile_face(t, hsr_tiler_face(t, &batch, k));
}

/* Convex faces from f up to `end`. */
static void tile_fans(struct hsr_cube_frame *frame, uint32_t f, uint32_t end) {
  struct hsr_cube_fans fans;
  for (int n; f < end;) {
    f = hsr_cube_fans(frame, &fans, f, end, &n);
    tile_batch(&frame->tiler, 0, n);
  }
  frame->tiler.list = NULL;
}

static void tile_cell(struct traversal *w, uint32_t place) {
  if (!w->frame.object->cell[place].n_faces)
    return;
  const struct hsr_cell *cell = hsr_cube_cell(&w->frame, place);
  struct hsr_tiler *t = &w->frame.tiler;
  uint32_t n = t->on_grid ? cell->n_triangles : 0;
  uint32_t fans = t->on_grid ? n + cell->n_convex : 0;
  struct hsr_subject cube = hsr_cube_subject(w->frame.instance, place);
  for (uint32_t f = 0; HSR_COUNTING && f < cell->n_faces; f++)
    HSR_STEP(w->tally, FACES, HSR_FACE(hsr_tiler_id(t, f)), cube, HSR_NOWHERE,
             0);
  for (uint32_t f = 0; f < n; f += HSR_BATCH)
    tile_batch(t, f, n - f < HSR_BATCH ? (int)(n - f) : HSR_BATCH);
  if (n < fans)
    tile_fans(&w->frame, n, fans);
  for (uint32_t f = fans; f < cell->n_faces; f++)
    tile_face(t, f);
}

/* Is the node not outside? *inside: it and its subtree are wholly inside. */
static bool classify(struct traversal *w, const struct hsr_placing *placing,
                     const struct hsr_octree_node *node,
                     struct hsr_subject subject, bool *inside) {
  HSR_STEP(w->tally, NODES, subject, HSR_NOTHING, HSR_NOWHERE, 0);
  if (!*inside) {
    struct hsr_octree_box cube = hsr_octree_cube(node);
    enum hsr_box_verdict verdict =
        hsr_cube_classify(&w->frame, placing, &cube, subject);
    if (verdict == HSR_BOX_OUT) {
      HSR_STEP(w->tally, NODES_OUT, subject, HSR_THE_WINDOW, HSR_NOWHERE, 0);
      return false;
    }
    *inside = verdict == HSR_BOX_IN;
  }
  if (*inside)
    HSR_STEP(w->tally, NODES_IN, subject, HSR_THE_WINDOW, HSR_NOWHERE, 0);
  return true;
}

static void cull_cube(struct traversal *w, uint32_t k, bool inside) {
  const struct hsr_octree_node *node = &w->frame.object->octree.node[k];
  if (!classify(w, &w->frame.placing, node,
                hsr_cube_subject(w->frame.instance, k), &inside))
    return;
  tile_cell(w, k);
  for (int o = 0; o < 8; o++)
    if (node->child[o] != HSR_NO_NODE)
      cull_cube(w, node->child[o], inside);
}

static void cull_instances(struct traversal *w, uint32_t k, bool inside) {
  const struct hsr_octree *octree = &w->frame.cubes->octree;
  const struct hsr_octree_node *node = &octree->node[k];
  if (!classify(w, &w->frame.as_it_is, node, hsr_cube_subject(HSR_NO_ID, k),
                &inside))
    return;
  for (uint32_t p = 0; p < node->n; p++) {
    uint32_t i = octree->item[node->first + p];
    if (!hsr_cube_is_new(&w->frame, i))
      continue;
    hsr_cube_instance(&w->frame, i);
    /* The node may be inside and the instance not. */
    cull_cube(w, 0, false);
  }
  for (int o = 0; o < 8; o++)
    if (node->child[o] != HSR_NO_NODE)
      cull_instances(w, node->child[o], inside);
}

static enum hsr_status begin(struct traversal *w, const struct hsr_job *job) {
  struct hsr_tiler *t = &w->frame.tiler;
  const struct hsr_window *window = &job->view->window;
  size_t width = (size_t)(window->x1 - window->x0);
  w->tally = job->tally;
  if (hsr_cube_frame_begin(&w->frame, job, job->prepared))
    return HSR_E_NOMEM;
  t->z = HSR_NEW(job->scratch, float, width *(size_t)(window->y1 - window->y0));
  t->z_stride = width;
  t->ids_stride = (size_t)job->answer->m;
  t->ids = hsr_job_row(job, window->y0) + window->x0;
  if (!t->z)
    return HSR_E_NOMEM;
  hsr_tiler_begin_part(t, *window);
  return HSR_OK;
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct traversal w;
  struct hsr_tiler loose;
  if (begin(&w, job) || hsr_cube_loose(&w.frame, &loose))
    return hsr_fail_nomem(err);
  for (uint32_t k = 0; k < loose.screen.n_relevant; k++)
    hsr_tiler_tile_generally(&loose, loose.screen.relevant[k]);
  cull_instances(&w, 0, false);
  const struct hsr_cubes *cubes = w.frame.cubes;
  for (uint32_t k = 0; k < cubes->n_movers; k++) {
    hsr_cube_instance(&w.frame, cubes->mover[k]);
    cull_cube(&w, 0, false);
  }
  return HSR_OK;
}

/* Each face in one cube: what crosses a median plane stays. */
static enum hsr_status prepare(const struct hsr_world *world,
                               const long *option, void **prepared,
                               struct hsr_error *err) {
  static const struct hsr_octree_rule rule = {
      .small = 0, .most = 32, .least = 1};
  (void)option;
  struct hsr_cubes *cubes = malloc(sizeof *cubes);
  *prepared = cubes;
  return cubes ? hsr_cubes_init(cubes, world, &rule, err) : hsr_fail_nomem(err);
}

static void release(void *prepared) {
  hsr_cubes_free(prepared);
  free(prepared);
}

static void show(const void *prepared, struct hsr_shown *shown) {
  shown->cubes = prepared;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {
    {&hsr_tiler_part}, {&hsr_inequalities_part}, {NULL}};

static const struct hsr_counter counters[] = {
    [NODES] = {"nodes visited", "octree nodes come to", HSR_ACTIVATE,
               HSR_OF_CELL, HSR_OF_NOTHING, .key = "cube-visited"},
    [NODES_OUT] = {"nodes out", "outside of the frustum", HSR_REJECT,
                   HSR_OF_CELL, HSR_OF_WINDOW, .key = "cube-out"},
    [NODES_IN] = {"nodes inside", "wholly, as their subtrees are", HSR_ACTIVATE,
                  HSR_OF_CELL, HSR_OF_WINDOW},
    [FACES] = {"faces met", "in nodes that are not outside", HSR_ACTIVATE,
               HSR_OF_FACE, HSR_OF_CELL, .key = "face-met"},
    {NULL}};

static const struct hsr_line outline[] = {
    {"for each node of the octree", HSR_RAISES(NODES)},
    {"  unless its parent is inside the frustum: where is its cube?",
     HSR_RAISES(HSR_INEQUALITIES)},
    {"  outside: skip the node and its subtree", HSR_RAISES(NODES_OUT)},
    {"  inside: the whole subtree is, and is not tested", HSR_RAISES(NODES_IN)},
    {"  for each face of the node", HSR_RAISES(FACES)},
    {"    ", .part = &hsr_tiler_part},
    {"  the same for its eight children"},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(clark) = {
    .name = "clark",
    .title = "The z-buffer behind hierarchical frustum culling",
    .authors = "J. H. Clark; B. Garlick, D. Baum and J. Winget",
    .year = 1976,
    .source = "Clark, Communications of the ACM 19(10), 1976; Garlick, Baum "
              "and Winget, SIGGRAPH course notes, 1990",
    .taxonomy = HSR_HIERARCHICAL,
    .sort_order = "Z(XY)",
    .coherence = "of objects, in space",
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}},
    .flags = HSR_INSTANCED,
    .parts = uses,
    .counters = counters,
    .outline = outline,
    .prepare = prepare,
    .render = render,
    .show = show,
    .release = release};
