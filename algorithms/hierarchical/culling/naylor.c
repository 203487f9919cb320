/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Naylor's visibility by two BSP trees: one of the scene, and one of the
 * picture.
 *
 * Source      B. Naylor, "Partitioning Tree Image Representation and Generation
 *             from 3D Geometric Models", Graphics Interface 1992; as told by N.
 *             Greene, PhD thesis, UC Santa Cruz, 1995, 2.1.6.
 * Notation    scene tree -> hsr_bsp; visibility map -> hsr_map; bounding volume
 *             -> the box around a subtree, and the rectangle of samples around
 *             its image
 * Invariants  All that comes later is behind what the map shows, or beside it.
 *             A subtree that is passed over shows at no sample.
 * Ties        pieces in one plane: the lowest face comes first
 * Departures  A bounding volume is a box around the pieces of a subtree, and
 *             not what the partitioning planes leave. Faces for which the tree
 *             has no place are compared in depth (bsp_frame.h).
 * Cost        The map's size. A subtree behind one face of the map is culled;
 *             one behind several faces is not, unless `cull=several`. */
#include "algorithms/hierarchical/culling/box_samples.h"
#include "algorithms/hierarchical/culling/visibility_map.h"
#include "common/trees/box.h"

#include <float.h>

enum { NODES, OUT, CULLED };

enum option { CULL };
enum { NOTHING, ONE, SEVERAL };
static const struct hsr_word cullings[] = {
    {"nothing", "no subtree is compared with the map", 0},
    {"one", "a subtree is culled if one region of the map hides it", 0},
    {"several", "also if several regions together hide it", 0},
    {NULL}};
static const struct hsr_option options[] = {
    [CULL] = {"cull", "which subtrees are culled", cullings, 0, 2, ONE},
    {NULL}};

struct naylor {
  struct hsr_bsp_frame frame;
  struct hsr_map map;
  struct hsr_polyhedron frustum;
  long cull;
};

/* --- Bounding volumes ----------------------------------------------------- */

static bool enter_node(void *context, uint32_t k) {
  struct naylor *n = context;
  struct hsr_tally *tally = n->frame.job->tally;
  const struct hsr_box *box = &n->frame.box[k];
  struct hsr_subject node = HSR_CELL(k, HSR_NO_ID, 0);
  HSR_STEP(tally, NODES, node, HSR_NOTHING, HSR_NOWHERE, 0);
  const struct hsr_window *w = &n->frame.job->view->window;
  struct hsr_bounds b = {w->x0, w->y0, w->x1, w->y1};
  hsr_box_samples(n->frame.job->view, box, &b);
  if (b.x0 >= b.x1 || b.y0 >= b.y1 ||
      hsr_box_classify(&n->frustum, box, NULL, NULL) == HSR_BOX_OUT) {
    HSR_STEP(tally, OUT, node, HSR_THE_WINDOW, HSR_NOWHERE, 0);
    return false;
  }
  if (n->cull == NOTHING ||
      !hsr_map_hides(&n->map, &b, n->cull == SEVERAL, node))
    return true;
  HSR_STEP(tally, CULLED, node, HSR_THE_WINDOW,
           hsr_window_make(b.x0, b.y0, b.x1, b.y1), 0);
  return false;
}

/* --- The algorithm -------------------------------------------------------- */

static void insert_piece(void *context, const struct hsr_bsp_piece *given,
                         int facing) {
  struct naylor *n = context;
  struct hsr_piece piece;
  if (hsr_bsp_frame_piece(&n->frame, given, &piece))
    hsr_map_insert(&n->map, given, &piece, facing);
}

/* How far the frustum reaches: beyond all boxes. t is within 8u of `size`,
 * which is less than 2^-40 of it, and 2^-1070 that underflow takes; doubling
 * it, from 1 on, is above both. */
static double farthest(const struct naylor *n) {
  const struct hsr_view *view = n->frame.job->view;
  double most = view->near + 1;
  if (!n->frame.bsp->n_nodes)
    return most;
  const struct hsr_box *all = &n->frame.box[0];
  for (int corner = 0; corner < 8; corner++) {
    double t = 0, size = 0;
    for (int k = 0; k < 3; k++) {
      double at = corner >> k & 1 ? all->hi[k] : all->lo[k];
      t += view->depth[k] * (at - view->E[k]);
      size += fabs(view->depth[k]) * (fabs(at) + fabs(view->E[k]));
    }
    most = fmax(most, t + 0x1p-40 * size);
  }
  return 2 * most;
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct naylor n = {.cull = job->option[CULL]};
  if (hsr_bsp_frame_begin(&n.frame, job) || hsr_map_begin(&n.map, &n.frame))
    return hsr_fail_nomem(err);
  hsr_frustum_init(&n.frustum, job->view, farthest(&n));
  n.frame.enter_node = enter_node;
  hsr_bsp_frame_walk(&n.frame, false, &n, insert_piece);
  hsr_map_show(&n.map);
  if (n.map.out_of_memory)
    return hsr_fail_nomem(err);
  hsr_bsp_frame_finish(&n.frame);
  return HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {{&hsr_bsp_part}, {&hsr_map_part}, {NULL}};

static const struct hsr_counter counters[] = {
    [NODES] = {"nodes visited", "nodes of the scene tree come to", HSR_ACTIVATE,
               HSR_OF_CELL, HSR_OF_NOTHING},
    [OUT] = {"nodes out", "whose subtrees are outside of the frustum",
             HSR_REJECT, HSR_OF_CELL, HSR_OF_WINDOW},
    [CULLED] = {"nodes culled", "whose subtrees the map hides", HSR_REJECT,
                HSR_OF_CELL, HSR_OF_WINDOW},
    {NULL}};

static const struct hsr_line outline[] = {
    {"for each node of the scene tree, from front to back", HSR_RAISES(NODES)},
    {"  leave its subtree if that is outside of the frustum", HSR_RAISES(OUT)},
    {"  compare its bounding volume with the visibility map",
     HSR_RAISES(HSR_MAP_BOXES)},
    {"  leave its subtree if that is hidden", HSR_RAISES(CULLED)},
    {"  for each piece in its plane", HSR_RAISES(HSR_BSP_PIECES)},
    {"    insert it into the map: compare it with a line, or divide it",
     HSR_RAISES(HSR_MAP_LINES)},
    {"    at a region that shows a face: it is hidden there",
     HSR_RAISES(HSR_MAP_HIDDEN)},
    {"    at a vacant region: divide that by the sides of the piece",
     HSR_RAISES(HSR_MAP_DIVISIONS)},
    {"      what is inside of all shows the piece", HSR_RAISES(HSR_MAP_FILLED)},
    {"show the map: for each rectangle of samples, go to one side of a line, "
     "or halve it",
     HSR_RAISES(HSR_MAP_REGIONS)},
    {"  ask for the samples of pieces that no lines bound",
     HSR_RAISES(HSR_MAP_ASKED)},
    {"  write the face of the region", HSR_RAISES(HSR_BSP_SAMPLES)},
    {"for each face without a place in the tree: compare it in depth at its "
     "samples",
     HSR_RAISES(HSR_BSP_THICKNESS)},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {"faces", "Z", "BSP tree", "once for all frames"},
    {"pieces", "Z", "walk of the tree, from front to back", "once a frame"},
    {"sides", "XY", "BSP tree of the picture", "once a piece"},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(naylor) = {
    .name = "naylor",
    .title = "Naylor's BSP tree of the scene and BSP tree of the picture",
    .authors = "B. Naylor",
    .year = 1992,
    .source = "Naylor, Graphics Interface 1992; Greene, PhD thesis, UC Santa "
              "Cruz, 1995, 2.1.6",
    .taxonomy = HSR_HIERARCHICAL,
    .sort_order = "Z(XY)",
    .coherence = "frame; area",
    .restrictions = HSR_CF,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}},
    .sorts = sorts,
    .parts = uses,
    .counters = counters,
    .outline = outline,
    .options = options,
    .prepare = hsr_bsp_prepare_bounded,
    .render = render,
    .show = hsr_bsp_show,
    .release = hsr_bsp_release};
