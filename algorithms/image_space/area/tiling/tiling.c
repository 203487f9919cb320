/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hierarchical polygon tiling with coverage masks.
 *
 * Source      N. Greene, "Hierarchical Polygon Tiling with Coverage Masks",
 *             SIGGRAPH 1996; N. Greene, PhD thesis, UC Santa Cruz, 1995, 4.4 to
 *             4.6.
 * Notation    coverage pyramid (1996), mask pyramid (thesis) -> masks
 *             (masks.h). Octree of BSP trees -> struct hsr_bsp
 *             (common/trees/bsp.h); replicated octrees -> grove (grove.h).
 *             Polygon of a BSP tree -> piece, of a face. tile_poly ->
 *             hsr_masks_tile and its kin.
 * Invariant   Pieces come from front to back: all that has been tiled may hide
 *             what is tiled next, and never the other way. So a sample is
 *             written once, and depths are never compared. The exceptions are
 *             loose faces, which come last (loose.h).
 * Ties        Pieces in one plane come by ascending face. A sample that is too
 *             close to an edge for the error bounds is decided exactly
 *             (polygon.h).
 * Departures  - The masks of samples are exact. Those of the paper's table can
 *             be chosen (masks=table).
 *             - Nothing is clipped to the near plane (polygon.h).
 *             - What is tested for an octree cube is the silhouette of the box
 *             of its contents. It is smaller than the cube, so more cubes are
 *             culled and fewer cells are visited. volumes=cubes tests the
 *             cube, as the paper has it (5.2).
 *             - Instances are ordered by a tree of planes that separate them,
 *             not by an octree above the octrees. Its nodes are tested as cubes
 *             are.
 *             - Departures of the mask pyramid are named in masks.h.
 * Cost        grows with the cells that visible edges cross, and with the
 *             visible cubes and their children */
#include "algorithms/algorithm.h"
#include "algorithms/engines/bsp/bsp_walk.h"
#include "algorithms/image_space/area/tiling/frame.h"
#include "algorithms/image_space/area/tiling/loose.h"
#include "algorithms/image_space/area/tiling/grove.h"
#include "common/answers/kinds/filtered.h"
#include "common/base/bits.h"
#include "common/base/numbers.h"

#include <stdlib.h>

enum { LEAF, INTERVALS, MASKS, START, OCTREE, COUNTS, VOLUMES };
enum { MASKS_EXACT, MASKS_TABLE };
enum { START_BOX, START_ROOT };
enum { OCTREE_OFF, OCTREE_ON };
enum { COUNTS_OFF, COUNTS_ON };
enum { VOLUMES_TIGHT, VOLUMES_CUBES };
enum { CORNERS = 4 };

enum { PIECES, PIECES_HIDDEN, PIECES_LEFT_OUT, CELLS_EXHAUSTED };

/* --- Once for all frames -------------------------------------------------- */

struct prepared {
  struct hsr_sampling sampling; /* must be first: hsr_tiling_prepare */
  struct hsr_grove grove;
  uint64_t *samples; /* masks=table: all tables, one after another; else NULL */
  const uint64_t *sample_tables[HSR_PATTERNS];
};

/* masks=table: the paper's table of masks for the finest level, one for each
 * pattern of jitter. */
static enum hsr_status make_sample_tables(struct prepared *p, int intervals) {
  size_t entries = 6 * (size_t)intervals * (size_t)intervals;
  p->samples = malloc(HSR_PATTERNS * entries * sizeof *p->samples);
  if (!p->samples)
    return HSR_E_NOMEM;
  for (int pattern = 0; pattern < HSR_PATTERNS; pattern++) {
    double x[64], y[64];
    for (int bit = 0; bit < 64; bit++) {
      x[bit] = p->sampling.places[pattern].x[bit] / 8;
      y[bit] = p->sampling.places[pattern].y[bit] / 8;
    }
    uint64_t *table = p->samples + (size_t)pattern * entries;
    hsr_sample_masks(intervals, x, y, table);
    p->sample_tables[pattern] = table;
  }
  return HSR_OK;
}

static void release(void *prepared) {
  struct prepared *p = prepared;
  hsr_grove_free(&p->grove);
  hsr_sampling_free(&p->sampling);
  free(p->samples);
  free(p);
}

static enum hsr_status prepare(const struct hsr_world *world,
                               const long *option, void **prepared,
                               struct hsr_error *err) {
  struct hsr_bsp_rule rule = {.most = (uint32_t)option[LEAF]};
  enum hsr_status status = hsr_tiling_prepare(sizeof(struct prepared),
                                              option[INTERVALS], prepared, err);
  struct prepared *p = *prepared;
  if (!status && option[MASKS] == MASKS_TABLE &&
      make_sample_tables(p, (int)option[INTERVALS]))
    status = hsr_fail_nomem(err);
  if (!status)
    status = hsr_grove_init(&p->grove, world, &rule, err);
  return status;
}

static void show(const void *prepared, struct hsr_shown *shown) {
  shown->grove = &((const struct prepared *)prepared)->grove;
}

/* --- A frame -------------------------------------------------------------- */

struct frame {
  const struct hsr_job *job;
  const struct prepared *prepared;
  struct hsr_tiling tiling;
  struct hsr_bsp_waiting *waiting; /* room for the traversal of a tree */
  struct hsr_loose loose;

  /* Of the tree that is being tiled: face f of its world has the id first_id +
   * f in the picture; the instance whose tree it is, HSR_NO_ID if it has all
   * faces of the scene. */
  uint32_t first_id, instance;

  struct hsr_mask_sink sink; /* the canvas; counts=on: by way of the counts */
};

/* --- counts=on: the visible samples of a cube ----------------------------- */

/* A sink between the masks and the canvas: it takes what is covered off the
 * counts (thesis, 4.6.3), and passes it on. */
static void cover_samples(void *context, int x, int y, uint64_t mask) {
  struct frame *f = context;
  const struct hsr_mask_sink *sink = &f->tiling.sink;
  hsr_masks_covered(&f->tiling.masks, x, y, 8, (uint32_t)hsr_count_bits(mask));
  sink->samples(sink->context, x, y, mask);
}

static void cover_square(void *context, int x, int y, int size) {
  struct frame *f = context;
  const struct hsr_mask_sink *sink = &f->tiling.sink;
  const struct hsr_window *w = &f->tiling.masks.window;
  int x1 = x + size < w->x1 ? x + size : w->x1;
  int y1 = y + size < w->y1 ? y + size : w->y1;
  hsr_masks_covered(&f->tiling.masks, x, y, size,
                    (uint32_t)((x1 - x) * (y1 - y)));
  sink->square(sink->context, x, y, size);
}

static enum hsr_status begin_counts(struct frame *f) {
  f->sink = f->tiling.sink;
  if (f->job->option[COUNTS] == COUNTS_OFF)
    return HSR_OK;
  f->sink = (struct hsr_mask_sink){cover_samples, cover_square, f};
  f->tiling.masks.count.exhausted = CELLS_EXHAUSTED;
  return hsr_masks_counts_init(&f->tiling.masks, f->job->scratch);
}

/* --- How a frame begins --------------------------------------------------- */

static enum hsr_status begin(struct frame *f, const struct hsr_job *job) {
  const struct prepared *p = job->prepared;
  const struct hsr_grove *grove = &p->grove;
  const struct hsr_pieces_room room = {grove->most_points, grove->most_corners,
                                       grove->most_face};
  *f = (struct frame){.job = job, .prepared = p};
  if (hsr_tiling_begin(&f->tiling, &p->sampling, job, room))
    return HSR_E_NOMEM;
  if (p->samples)
    f->tiling.masks.sample_tables = p->sample_tables + hsr_tiling_pattern(job);
  f->waiting = HSR_NEW(job->scratch, struct hsr_bsp_waiting,
                       hsr_bsp_most_waiting(grove->most_depth));
  if (!f->waiting || begin_counts(f))
    return HSR_E_NOMEM;
  return grove->is_whole
             ? hsr_loose_begin(&f->loose, &grove->whole, &f->tiling.view,
                               job->tally, job->scratch)
             : HSR_OK;
}

/* --- Is a cube visible? --------------------------------------------------- */

/* May anything in a moved box be seen? With octree=off only the window is
 * asked, not the masks. */
static bool is_visible(struct frame *f, const struct hsr_box *box,
                       const double shift[3], struct hsr_subject cube) {
  hsr_tiling_whom(&f->tiling, cube);
  return hsr_tiling_is_visible(&f->tiling, box, shift,
                               f->job->option[OCTREE] == OCTREE_ON);
}

/* counts=on: the same of a leaf of the octree; all its visible samples are
 * counted. A leaf that is not wholly before the eye has no counts. */
static bool is_visible_by_count(struct frame *f, const struct hsr_box *box,
                                const double shift[3],
                                struct hsr_subject cube) {
  struct hsr_tiling *t = &f->tiling;
  hsr_tiling_whom(t, cube);
  enum hsr_box_place place = hsr_pieces_box(&t->pieces, box, shift);
  t->masks.counts->cube = 0;
  if (place != HSR_BOX_INSIDE)
    return place == HSR_BOX_UNKNOWN;
  bool visible = hsr_masks_count(&t->masks, hsr_pieces_silhouette(&t->pieces),
                                 t->pieces.box) > 0;
  hsr_tiling_count_test(t, visible);
  return visible;
}

/* --- Prefetching ---------------------------------------------------------- */

/* Asks memory for what is used soon. It may reach beyond an array, since
 * nothing is read. */
static void prefetch(const void *from, size_t size) {
  const size_t line = 64;
  for (size_t k = 0; k < size; k += line)
    __builtin_prefetch((const char *)from + k);
}

/* Before a cube is tested: its octants; or of a leaf its points, and the first
 * nodes of its BSP tree. */
static void prefetch_cube(const struct hsr_bsp *bsp,
                          const struct hsr_bsp_cube *cube) {
  if (cube->root == HSR_NO_BSP) {
    for (int k = 0; k < 8; k++)
      if (cube->child[k] != HSR_NO_BSP)
        prefetch(&bsp->cube[cube->child[k]], sizeof *cube);
    return;
  }
  prefetch(&bsp->node[cube->root], 8 * sizeof *bsp->node);
  size_t first = cube->first_point, size = cube->n_points * sizeof(double);
  prefetch(bsp->x + first, size);
  prefetch(bsp->y + first, size);
  prefetch(bsp->z + first, size);
  prefetch(bsp->error + first, size);
}

/* Before the pieces of a leaf are tiled: the first of them, and their corners.
 * As a rule there are no more than CORNERS corners for each point. */
static void prefetch_pieces(const struct hsr_bsp *bsp,
                            const struct hsr_bsp_cube *cube) {
  const struct hsr_bsp_piece *piece =
      &bsp->piece[bsp->node[cube->root].first_piece];
  prefetch(piece, 10 * sizeof *piece);
  prefetch(&bsp->corner[piece->first_corner],
           CORNERS * cube->n_points * sizeof *bsp->corner);
}

/* --- Cubes and pieces ----------------------------------------------------- */

/* The box whose silhouette is tiled for a cube: the cube, but not less than what
 * holds its pieces, as the cube's sides are rounded; or what holds its pieces. */
static struct hsr_box volume_of(const struct frame *f,
                                const struct hsr_bsp_cube *cube) {
  struct hsr_box box = cube->tight;
  if (f->job->option[VOLUMES] == VOLUMES_TIGHT)
    return box;
  for (int k = 0; k < 3; k++) {
    box.lo[k] = hsr_min(box.lo[k], cube->centre[k] - cube->half);
    box.hi[k] = hsr_max(box.hi[k], cube->centre[k] + cube->half);
  }
  return box;
}

/* The traversal asks whether to enter a cube: if it may be visible. The points
 * of a leaf are taken to the screen. */
static bool enter_cube(void *context, const struct hsr_bsp_cube *cube) {
  struct frame *f = context;
  struct hsr_pieces_view *pieces = &f->tiling.pieces;
  prefetch_cube(pieces->bsp, cube);
  uint32_t number = (uint32_t)(cube - pieces->bsp->cube);
  bool counts = f->tiling.masks.counts && cube->root != HSR_NO_BSP &&
                f->job->option[OCTREE] == OCTREE_ON;
  const struct hsr_box volume = volume_of(f, cube);
  if (!(counts ? is_visible_by_count : is_visible)(
          f, &volume, pieces->shift, HSR_CELL(number, f->instance, 0)))
    return false;
  if (cube->root != HSR_NO_BSP) {
    prefetch_pieces(pieces->bsp, cube);
    hsr_pieces_leaf(pieces, cube);
  }
  return true;
}

/* The traversal gives a piece: tiles it. Loose faces are left for the end.
 * counts=on: a piece is left out if no visible sample of its cube is left. */
static void tile_piece(void *context, const struct hsr_bsp_piece *piece,
                       int facing) {
  struct frame *f = context;
  struct hsr_tiling *t = &f->tiling;
  struct hsr_pieces_view *pieces = &t->pieces;
  uint32_t id = f->first_id + piece->face;
  const struct hsr_mask_counts *counts = t->masks.counts;
  if (f->loose.is_loose && f->loose.is_loose[piece->face])
    return;
  if (counts && counts->cube && !counts->all) {
    HSR_STEP(f->job->tally, PIECES_LEFT_OUT,
             HSR_PIECE(id, (uint32_t)(piece - pieces->bsp->piece)), HSR_NOTHING,
             HSR_NOWHERE, 0);
    return;
  }
  if (!hsr_pieces_take(pieces, piece, facing))
    return;
  struct hsr_subject subject =
      HSR_PIECE(id, (uint32_t)(piece - pieces->bsp->piece));
  struct hsr_window window = hsr_window_make(pieces->box.x0, pieces->box.y0,
                                             pieces->box.x1, pieces->box.y1);
  HSR_STEP(f->job->tally, PIECES, subject, HSR_THE_WINDOW, window, 0);
  hsr_tiling_whom(t, HSR_FACE(id));
  hsr_canvas_face(&t->canvas, id);
  if (f->job->option[START] == START_ROOT) {
    hsr_pieces_outline(pieces);
    hsr_masks_tile_root(&t->masks, &pieces->polygon, &f->sink);
  } else if (hsr_masks_find(&t->masks, pieces->box)) {
    hsr_pieces_outline(pieces);
    hsr_masks_tile_found(&t->masks, &pieces->polygon, &f->sink);
  } else {
    HSR_STEP(f->job->tally, PIECES_HIDDEN, subject, HSR_THE_WINDOW, window, 0);
  }
}

/* Tiles an octree of BSP trees, moved by `shift`. */
static void tile_tree(struct frame *f, const struct hsr_bsp *bsp,
                      const double shift[3], uint32_t first_id,
                      uint32_t instance) {
  struct hsr_bsp_walk walk = {.bsp = bsp,
                              .view = &f->tiling.view,
                              .shift = shift,
                              .tally = f->job->tally,
                              .waiting = f->waiting,
                              .context = f,
                              .enter = enter_cube,
                              .piece = tile_piece};
  f->first_id = first_id;
  f->instance = instance;
  hsr_pieces_tree(&f->tiling.pieces, bsp, shift);
  hsr_bsp_walk_tree(&walk);
}

/* Tiles the instances of a node of the grove from front to back: of each plane
 * that separates them, the eye's side comes first. */
static void tile_instances(struct frame *f, uint32_t number) {
  static const double still[3] = {0, 0, 0};
  const struct hsr_grove *grove = &f->prepared->grove;
  const struct hsr_grove_node *node = &grove->node[number];
  if (node->axis >= 0) {
    prefetch(&grove->node[node->below], sizeof *node);
    prefetch(&grove->node[node->above], sizeof *node);
    if (!is_visible(f, &node->box, still, HSR_CELL(number, HSR_NO_ID, 0)))
      return;
    bool above = f->tiling.view.eye[node->axis] > node->at;
    tile_instances(f, above ? node->above : node->below);
    tile_instances(f, above ? node->below : node->above);
    return;
  }
  const struct hsr_instance *instance =
      &grove->world->roster.scene->instances[node->instance];
  const double shift[3] = {instance->m[3], instance->m[7], instance->m[11]};
  tile_tree(f, &grove->tree[instance->object].bsp, shift,
            grove->world->roster.first[node->instance], node->instance);
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  static const double still[3] = {0, 0, 0};
  struct frame f;
  const struct prepared *p = job->prepared;
  if (begin(&f, job))
    return hsr_fail_nomem(err);
  if (f.loose.n && f.tiling.filtering.filter)
    return hsr_loose_refuse(&f.loose, job->world, err);
  if (p->grove.is_whole)
    tile_tree(&f, &p->grove.whole, still, 0, HSR_NO_ID);
  else
    tile_instances(&f, 0);
  if (f.tiling.masks.counts)
    f.tiling.masks.counts->cube = 0;
  hsr_tiling_background(&f.tiling);
  hsr_loose_draw(&f.loose, job->answer->ids, (size_t)job->answer->m);
  return HSR_OK;
}

/* --- The descriptor ------------------------------------------------------- */

static const struct hsr_option options[] = {
    [LEAF] = {.name = "leaf",
              .meaning = "the most faces that an octree's leaf has; 0: one BSP "
                         "tree and no octree",
              .least = 0,
              .most = 1000,
              .standard = 30},
    [INTERVALS] = {.name = "intervals",
                   .meaning =
                       "into which a side is divided for the tables of masks",
                   .least = 1,
                   .most = HSR_TRIAGE_MOST,
                   .standard = HSR_TILING_INTERVALS},
    [MASKS] = {.name = "masks",
               .meaning = "how the masks of samples are found",
               .words =
                   (const struct hsr_word[]){
                       {"exact", "by the edges, exactly", 0},
                       {"table",
                        "by tables, as in the paper, and sometimes wrong",
                        HSR_KNOWN_WRONG},
                       {NULL, NULL, 0}}},
    [START] = {.name = "start",
               .meaning = "where a polygon is tiled from",
               .words =
                   (const struct hsr_word[]){
                       {"box",
                        "the smallest cell that encloses its box, unless "
                        "that is hidden",
                        0},
                       {"root", "the root, as in the thesis", 0},
                       {NULL, NULL, 0}}},
    [OCTREE] = {.name = "octree",
                .meaning = "cull by cubes: their silhouettes are tiled",
                .words =
                    (const struct hsr_word[]){
                        {"off", "without it: all are gone through", 0},
                        {"on", "with it", 0},
                        {NULL, NULL, 0}},
                .standard = OCTREE_ON},
    [COUNTS] = {.name = "counts",
                .meaning = "whether the visible samples of a cube with "
                           "polygons are counted (thesis, 4.6.3)",
                .words =
                    (const struct hsr_word[]){
                        {"off", "the first one ends the test of the cube", 0},
                        {"on",
                         "all are, in each mask, and masks where none is left "
                         "are passed over",
                         0},
                        {NULL, NULL, 0}}},
    [VOLUMES] = {.name = "volumes",
                 .meaning = "whose silhouettes are tiled to cull",
                 .words =
                     (const struct hsr_word[]){
                         {"tight",
                          "the boxes, within the cubes, of what they hold", 0},
                         {"cubes", "the octree's, as in the paper", 0},
                         {NULL, NULL, 0}}},
    {.name = NULL}};

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {
    {&hsr_tiling_part}, {&hsr_loose_part}, {NULL}};

static const struct hsr_counter counters[] = {
    [PIECES] = {"pieces",
                "pieces of faces in visible cubes, with a sample in their box",
                HSR_ACTIVATE, HSR_OF_PIECE, HSR_OF_WINDOW, .key = "piece"},
    [PIECES_HIDDEN] = {"pieces hidden", "of these, those whose box is hidden",
                       HSR_REJECT, HSR_OF_PIECE, HSR_OF_WINDOW},
    [PIECES_LEFT_OUT] = {"pieces left out",
                         "in cubes of which no counted sample is left",
                         HSR_REJECT, HSR_OF_PIECE, HSR_OF_NOTHING},
    [CELLS_EXHAUSTED] = {"cells exhausted",
                         "not entered: none of their counted samples is left",
                         HSR_REJECT, HSR_OF_CELL, HSR_OF_FACE},
    {NULL}};

static const struct hsr_line outline[] = {
    {"for each octree cube, from front to back"},
    {"", .part = &hsr_tiling_part},
    {"  for each polygon of its BSP tree, from front to back",
     HSR_RAISES(PIECES)},
    {"    skip it if no visible sample of the cube is left",
     HSR_RAISES(PIECES_LEFT_OUT)},
    {"    if the box is hidden in the cell that encloses it: skip the polygon",
     HSR_RAISES(PIECES_HIDDEN)},
    {"", .part = &hsr_tiling_part, .group = HSR_CELL_LINES},
    {"        but for those where none of the cube's visible samples is left",
     HSR_RAISES(CELLS_EXHAUSTED)},
    {"", .part = &hsr_tiling_part, .group = HSR_SAMPLE_LINES},
    {"display the background in what is vacant"},
    {"", .part = &hsr_loose_part},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {"faces", "priority", "BSP trees", "once for all frames"},
    {"cubes", "distance", "octree, from front to back", "once a frame"},
    {"faces", "X and Y", "mask pyramid", "a polygon"},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(tiling) = {
    .name = "tiling",
    .title = "Hierarchical polygon tiling with coverage masks",
    .authors = "N. Greene",
    .year = 1996,
    .source = "N. Greene, Hierarchical Polygon Tiling with Coverage Masks, "
              "SIGGRAPH 1996",
    .taxonomy = HSR_IMAGE_SPACE_AREA,
    .sort_order = "Z(XY)",
    .coherence = "area coherence; hidden cubes hide all that is in them",
    .restrictions = HSR_CF,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS},
              {HSR_FILTERED,
               HSR_WORDS_OF_64 | HSR_WORD_OF(HSR_FILTER_BOX_64X64)}},
    .flags = HSR_INSTANCED | HSR_RATHER_LAID_OUT,
    .sorts = sorts,
    .parts = uses,
    .counters = counters,
    .outline = outline,
    .options = options,
    .prepare = prepare,
    .render = render,
    .show = show,
    .release = release};
