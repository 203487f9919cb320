/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Meagher's octree of opaque cubes, tiled from front to back into a quadtree.
 *
 * Source      D. Meagher, "Geometric Modeling Using Octree Encoding", Computer
 *             Graphics and Image Processing 19, 1982, and "Efficient Synthetic
 *             Image Generation of Arbitrary 3-D Objects", IEEE Conference on
 *             Pattern Recognition and Image Processing, 1982; as told by N.
 *             Greene, PhD thesis, UC Santa Cruz, 1995, 2.1.6.
 * Notation    cube -> a box of cells of a rectilinear grid; a leaf is one kept
 *             cell. Quadtree cells are covered, active or vacant (quadtree.h).
 * Input       the grid itself. No list of faces is made.
 * Invariants  All that comes later is behind what has been tiled, or beside it.
 *             A node that is passed over has no sample that is not covered.
 * Ties        the sides of a cell that face the eye do not hide one another
 * Departures  A leaf is drawn by its sides that face the eye, instead of as one
 *             polygon, since they are different faces of the scene. A cell
 *             inside of a solid, none of whose sides exist, is in no octree. A
 *             block of cells is not one large cube, since its cells are
 *             different faces.
 * Cost        The nodes that may be seen and their children, and the quadtree
 *             cells that their outlines cross. No depths are compared.
 *
 * Filter. A corner of a box that is safe is within HSR_DELTA of its place on
 * the screen (cell_box.c). So the sign of an edge function at a sample is
 * certain beyond the bound of hsr_edge_side (common/exact/screen.h), and the
 * sides of a convex polygon are those of its edges. Coordinates are at most
 * 2^15, so products round by less than 2^-35 of a difference, which is below
 * HSR_DELTA of it, and underflow takes less than HSR_DELTA squared. Where the
 * filter leaves a sample open, the side is laid out alone, and the services
 * decide. */
#include "algorithms/engines/windows/quadtree.h"
#include "algorithms/engines/cells/cells.h"
#include "common/base/bits.h"
#include "common/trees/octree.h"

#include <stdlib.h>
#include <string.h>

enum {
  NODES,
  OUT,
  SILHOUETTES,
  HIDDEN,
  CUBES,
  SIDES,
  CELLS,
  SUBDIVISIONS,
  ASKED,
  SAMPLES
};

/* --- The octree ----------------------------------------------------------- */

enum { DEPTHS = 22 }; /* a grid has at most 2^20 cells along an axis */

/* Nodes of one size, by their Morton codes: three bits for each division, those
 * of x lowest. Node k has the children first[k] to first[k + 1] - 1, which are
 * nodes of the next smaller size. */
struct layer {
  uint32_t n;
  uint64_t *code;
  uint32_t *first; /* NULL: they are leaves */
};

struct octree {
  int n_layers;
  struct layer layer[DEPTHS]; /* 0: the leaves */
  uint32_t *cell;             /* a leaf: its kept cell, */
  uint32_t *face;             /* and the first face of that */
  struct hsr_arena arena;
};

struct leaf {
  uint64_t code;
  uint32_t cell, face;
};

static uint64_t spread(uint32_t v) {
  uint64_t code = 0;
  for (int k = 0; k < 21; k++)
    code |= (uint64_t)(v >> k & 1) << 3 * k;
  return code;
}

static uint32_t gather(uint64_t code, int axis) {
  uint32_t v = 0;
  for (int k = 0; k < 21; k++)
    v |= (uint32_t)(code >> (3 * k + axis) & 1) << k;
  return v;
}

static int by_code(const void *p, const void *q) {
  const struct leaf *a = p, *b = q;
  return (a->code > b->code) - (a->code < b->code);
}

/* The kept cells that have a side, in the order of their codes. To be freed;
 * NULL: HSR_E_NOMEM. */
static struct leaf *list_leaves(const struct hsr_grid *grid, uint32_t *n) {
  struct leaf *leaf = malloc(((size_t)grid->n_cells + 1) * sizeof *leaf);
  uint32_t face = 0;
  *n = 0;
  for (uint32_t k = 0; leaf && k < grid->n[2]; k++)
    for (uint32_t j = 0; j < grid->n[1]; j++) {
      size_t row = (size_t)k * grid->n[1] + j;
      for (uint32_t c = grid->row[row]; c < grid->row[row + 1]; c++) {
        if (!grid->sides[c])
          continue;
        uint64_t code = spread(grid->x[c]) | spread(j) << 1 | spread(k) << 2;
        leaf[(*n)++] = (struct leaf){code, c, face};
        face += hsr_count_bits(grid->sides[c]);
      }
    }
  if (leaf)
    qsort(leaf, *n, sizeof *leaf, by_code);
  return leaf;
}

/* The parents of a layer's nodes. */
static enum hsr_status add_layer(struct octree *o) {
  const struct layer *below = &o->layer[o->n_layers - 1];
  struct layer *layer = &o->layer[o->n_layers++];
  for (uint32_t k = 0; k < below->n; k++)
    layer->n += !k || below->code[k] >> 3 != below->code[k - 1] >> 3;
  layer->code = HSR_NEW(&o->arena, uint64_t, layer->n);
  layer->first = HSR_NEW(&o->arena, uint32_t, (size_t)layer->n + 1);
  if (!layer->code || !layer->first)
    return HSR_E_NOMEM;
  uint32_t n = 0;
  for (uint32_t k = 0; k < below->n; k++)
    if (!k || below->code[k] >> 3 != below->code[k - 1] >> 3) {
      layer->code[n] = below->code[k] >> 3;
      layer->first[n++] = k;
    }
  layer->first[n] = below->n;
  return HSR_OK;
}

static enum hsr_status build(struct octree *o, const struct leaf *leaf,
                             uint32_t n) {
  struct layer *leaves = &o->layer[0];
  leaves->n = n;
  leaves->code = HSR_NEW(&o->arena, uint64_t, n);
  o->cell = HSR_NEW(&o->arena, uint32_t, n);
  o->face = HSR_NEW(&o->arena, uint32_t, n);
  if (!leaves->code || !o->cell || !o->face)
    return HSR_E_NOMEM;
  for (uint32_t k = 0; k < n; k++) {
    leaves->code[k] = leaf[k].code;
    o->cell[k] = leaf[k].cell;
    o->face[k] = leaf[k].face;
  }
  o->n_layers = 1;
  while (o->layer[o->n_layers - 1].n > 1)
    if (add_layer(o))
      return HSR_E_NOMEM;
  return HSR_OK;
}

static enum hsr_status prepare(const struct hsr_world *world,
                               const long *option, void **prepared,
                               struct hsr_error *err) {
  (void)option;
  struct octree *o = calloc(1, sizeof *o);
  uint32_t n;
  struct leaf *leaf = list_leaves(world->roster.scene->grid, &n);
  *prepared = o;
  enum hsr_status status = o && leaf ? build(o, leaf, n) : HSR_E_NOMEM;
  free(leaf);
  return status ? hsr_fail_nomem(err) : HSR_OK;
}

static void release(void *prepared) {
  struct octree *o = prepared;
  hsr_arena_free(&o->arena);
  free(o);
}

/* --- A frame -------------------------------------------------------------- */

enum { MOST_EDGES = 6 }; /* of a cube's silhouette */

/* A convex polygon on the screen, clockwise. */
struct outline {
  int n;
  double x[MOST_EDGES], y[MOST_EDGES], dx[MOST_EDGES], dy[MOST_EDGES];
  struct hsr_bounds bounds; /* no sample outside of it is within the polygon */
};

struct frame {
  struct hsr_cells cells;
  const struct octree *octree;
  struct hsr_quadtree quadtree;
  struct hsr_tally *tally;
  unsigned char beyond[6][4]; /* the side beyond corner k to k + 1 of a side */

  /* The current side. */
  struct outline side;
  uint32_t face;
  uint32_t at[3]; /* its cell */
  int number;     /* of the side, 0 to 5 */
  bool laid_out, is_placed;
};

static void add_edge(struct outline *o, const struct hsr_cell_box *box, int a,
                     int b) {
  o->x[o->n] = box->sx[a];
  o->y[o->n] = box->sy[a];
  o->dx[o->n] = box->sx[b] - box->sx[a];
  o->dy[o->n++] = box->sy[b] - box->sy[a];
}

/* Whether samples of a rectangle may be within the polygon, and which edges
 * they may be on both sides of: bits of *crossing, which names the edges to
 * look at. */
static bool may_meet(const struct frame *f, const struct outline *o,
                     const struct hsr_bounds *b, unsigned *crossing) {
  if (b->x0 >= o->bounds.x1 || o->bounds.x0 >= b->x1 || b->y0 >= o->bounds.y1 ||
      o->bounds.y0 >= b->y1)
    return false;
  const struct hsr_view *view = f->cells.job->view;
  double x0 = hsr_sample_x(view, b->x0), x1 = hsr_sample_x(view, b->x1 - 1);
  double y0 = hsr_sample_y(view, b->y0), y1 = hsr_sample_y(view, b->y1 - 1);
  unsigned looked_at = *crossing;
  for (int k = 0; k < o->n; k++) {
    if (!(looked_at >> k & 1))
      continue;
    double dx = o->dx[k], dy = o->dy[k];
    double left = dy * (x0 - o->x[k]), right = dy * (x1 - o->x[k]);
    double top = dx * (y0 - o->y[k]), below = dx * (y1 - o->y[k]);
    double most = (top > below ? top : below) - (left < right ? left : right);
    double least = (top < below ? top : below) - (left > right ? left : right);
    double reach = fabs(x0 - o->x[k]) + fabs(x1 - o->x[k]) +
                   fabs(y0 - o->y[k]) + fabs(y1 - o->y[k]);
    double bound = 4 * HSR_DELTA * (fabs(dx) + fabs(dy) + reach) +
                   8 * HSR_DELTA * HSR_DELTA;
    if (most < -bound)
      return false;
    if (least > bound)
      *crossing &= ~(1u << k);
  }
  return true;
}

static inline struct hsr_window window_of(const struct hsr_bounds *b) {
  return hsr_window_make(b->x0, b->y0, b->x1, b->y1);
}

/* --- Is a node hidden? ---------------------------------------------------- */

enum { IS_OUTSIDE, IS_COVERED, IS_DIVIDED, IS_VISIBLE };

/* Whether something of the outline is in a quadtree cell and not covered. */
static bool is_visible(const struct frame *f, const struct outline *o,
                       struct hsr_subject node, int level, int x, int y,
                       unsigned crossing) {
  int state = *hsr_quad_state(&f->quadtree, level, x, y);
  struct hsr_bounds b = hsr_quad_samples(&f->quadtree, level, x, y);
  int outcome = state == HSR_QUAD_COVERED        ? IS_COVERED
                : !may_meet(f, o, &b, &crossing) ? IS_OUTSIDE
                : !crossing || !level            ? IS_VISIBLE
                                                 : IS_DIVIDED;
  HSR_STEP(f->tally, SILHOUETTES, node, HSR_CELL(level, x, y), window_of(&b),
           outcome);
  for (int q = 0; q < 4 && outcome == IS_DIVIDED; q++)
    if (is_visible(f, o, node, level - 1, 2 * x + q % 2, 2 * y + q / 2,
                   crossing))
      return true;
  return outcome == IS_VISIBLE;
}

/* The silhouette of a box that is safe: the edges between its sides that face
 * the eye and those that do not. */
static struct outline silhouette(const struct frame *f,
                                 const struct hsr_cell_box *box,
                                 unsigned facing) {
  struct outline o = {.n = 0, .bounds = box->bounds};
  for (int side = 0; side < 6; side++)
    for (int k = 0; k < 4 && facing >> side & 1; k++)
      if (!(facing >> f->beyond[side][k] & 1) && o.n < MOST_EDGES)
        add_edge(&o, box, f->cells.corner[side][k],
                 f->cells.corner[side][(k + 1) % 4]);
  return o;
}

static bool is_node_visible(const struct frame *f,
                            const struct hsr_cell_box *box, unsigned facing,
                            struct hsr_subject node) {
  if (!box->is_safe)
    return true;
  struct outline o = silhouette(f, box, facing);
  return is_visible(f, &o, node, f->quadtree.n_levels - 1, 0, 0,
                    (1u << o.n) - 1);
}

/* --- Tiling a side -------------------------------------------------------- */

static void write_samples(const struct frame *f, const struct hsr_bounds *b) {
  const struct hsr_job *job = f->cells.job;
  for (int j = b->y0; j < b->y1; j++)
    for (int i = b->x0; i < b->x1; i++) {
      HSR_TOUCH(f->tally, i, j);
      HSR_STEP(f->tally, SAMPLES, HSR_FACE(f->face), HSR_THE_WINDOW,
               HSR_AT(i, j), 0);
      hsr_job_row(job, j)[i] = f->face;
    }
}

/* What the filter leaves open. */
static bool covers(struct frame *f, int i, int j) {
  if (!f->laid_out)
    f->is_placed = hsr_cells_lay_out(&f->cells, f->at, f->number);
  f->laid_out = true;
  bool covered =
      f->is_placed && hsr_covers(&f->cells.lone.screen, 0, i, j, f->tally);
  HSR_STEP(f->tally, ASKED, HSR_FACE(f->face), HSR_THE_WINDOW, HSR_AT(i, j),
           covered);
  return covered;
}

enum { OUTSIDE, COVERED, CROSSED, INSIDE };

/* `crossing`: the edges that the cell may be on both sides of. A side that is
 * not safe has no outline: its bits stay, and all of its samples are asked. */
static void tile(struct frame *f, int level, int x, int y, unsigned crossing) {
  unsigned char *state = hsr_quad_state(&f->quadtree, level, x, y);
  struct hsr_bounds b = hsr_quad_samples(&f->quadtree, level, x, y);
  int outcome = *state == HSR_QUAD_COVERED              ? COVERED
                : !may_meet(f, &f->side, &b, &crossing) ? OUTSIDE
                : crossing                              ? CROSSED
                                                        : INSIDE;
  HSR_STEP(f->tally, CELLS, HSR_FACE(f->face), HSR_CELL(level, x, y),
           window_of(&b), outcome);
  if (outcome == COVERED || outcome == OUTSIDE ||
      (!level && outcome == CROSSED && !covers(f, b.x0, b.y0)))
    return;
  if (!level || (outcome == INSIDE && *state == HSR_QUAD_VACANT)) {
    write_samples(f, &b);
    *state = HSR_QUAD_COVERED;
    return;
  }
  HSR_STEP(f->tally, SUBDIVISIONS, HSR_FACE(f->face), HSR_CELL(level, x, y),
           window_of(&b), 0);
  for (int q = 0; q < 4; q++)
    tile(f, level - 1, 2 * x + q % 2, 2 * y + q / 2, crossing);
  *state = (unsigned char)hsr_quad_gather(&f->quadtree, level, x, y);
}

static void tile_side(struct frame *f, const struct hsr_cell_box *box) {
  HSR_STEP(f->tally, SIDES, HSR_FACE(f->face), HSR_NOTHING, HSR_NOWHERE, 0);
  f->side = (struct outline){.n = 0, .bounds = box->bounds};
  f->laid_out = false;
  for (int k = 0; k < 4 && box->is_safe; k++)
    add_edge(&f->side, box, f->cells.corner[f->number][k],
             f->cells.corner[f->number][(k + 1) % 4]);
  tile(f, f->quadtree.n_levels - 1, 0, 0, 15);
}

static void draw_cube(struct frame *f, uint32_t leaf,
                      const struct hsr_cell_box *box, unsigned facing) {
  uint8_t sides = f->cells.grid->sides[f->octree->cell[leaf]];
  f->face = f->octree->face[leaf];
  for (f->number = 0; f->number < 6; f->number++) {
    if ((sides & facing) >> f->number & 1)
      tile_side(f, box);
    f->face += sides >> f->number & 1;
  }
}

/* --- From front to back --------------------------------------------------- */

/* The box of a node in cells, from lo to hi, both included. */
static void cells_of(const struct hsr_grid *grid, int layer, uint64_t code,
                     uint32_t lo[3], uint32_t hi[3]) {
  for (int a = 0; a < 3; a++) {
    uint32_t end = grid->n[a] - 1;
    lo[a] = gather(code, a) << layer;
    hi[a] = lo[a] + (1u << layer) - 1;
    hi[a] = hi[a] < end ? hi[a] : end;
  }
}

/* The sides of a box that face the eye. */
static unsigned facing_sides(const struct frame *f, const uint32_t lo[3],
                             const uint32_t hi[3]) {
  unsigned facing = 0;
  for (int a = 0; a < 3; a++) {
    facing |= f->cells.facing[a][lo[a]] & 1u << 2 * a;
    facing |= f->cells.facing[a][hi[a]] & 2u << 2 * a;
  }
  return facing;
}

/* The octant on the eye's side of the planes that divide a node. Where such a
 * plane is beyond the grid, the node has no octants there. */
static unsigned nearest_octant(const struct frame *f, int layer,
                               const uint32_t lo[3]) {
  const struct hsr_grid *grid = f->cells.grid;
  unsigned nearest = 0;
  for (int a = 0; a < 3; a++) {
    uint32_t middle = lo[a] + (1u << (layer - 1));
    nearest |= (unsigned)(middle < grid->n[a] &&
                          f->cells.job->view->eye[a] > grid->bound[a][middle])
               << a;
  }
  return nearest;
}

static void visit(struct frame *f, int layer, uint32_t k) {
  const struct layer *nodes = &f->octree->layer[layer];
  struct hsr_subject node = HSR_CELL(k, layer, 0);
  struct hsr_cell_box box;
  uint32_t lo[3], hi[3];
  HSR_STEP(f->tally, NODES, node, HSR_NOTHING, HSR_NOWHERE, 0);
  cells_of(f->cells.grid, layer, nodes->code[k], lo, hi);
  if (!hsr_cells_box(&f->cells, lo, hi, &box)) {
    HSR_STEP(f->tally, OUT, node, HSR_THE_WINDOW, HSR_NOWHERE, 0);
    return;
  }
  unsigned facing = facing_sides(f, lo, hi);
  if (!is_node_visible(f, &box, facing, node)) {
    HSR_STEP(f->tally, HIDDEN, node, HSR_NOTHING, HSR_NOWHERE, 0);
    return;
  }
  if (!layer) {
    HSR_STEP(f->tally, CUBES, node, HSR_NOTHING, HSR_NOWHERE, 0);
    memcpy(f->at, lo, sizeof f->at);
    draw_cube(f, k, &box, facing);
    return;
  }
  uint32_t child[8];
  memset(child, 0xff, sizeof child);
  const struct layer *below = &f->octree->layer[layer - 1];
  for (uint32_t c = nodes->first[k]; c < nodes->first[k + 1]; c++)
    child[below->code[c] & 7] = c;
  unsigned nearest = nearest_octant(f, layer, lo);
  for (int o = 0; o < 8; o++) {
    uint32_t c = child[nearest ^ hsr_octant_order[o]];
    if (c != HSR_NO_NODE)
      visit(f, layer - 1, c);
  }
}

/* Which side of a box lies beyond each edge of a side: the other one that has
 * both corners. */
static void find_beyond(struct frame *f) {
  for (int side = 0; side < 6; side++)
    for (int k = 0; k < 4; k++) {
      const uint8_t *corner = f->cells.corner[side];
      int a = corner[k], b = corner[(k + 1) % 4];
      for (int axis = 0; axis < 3; axis++)
        if (axis != side / 2 && !((a ^ b) >> axis & 1))
          f->beyond[side][k] = (unsigned char)(2 * axis + (a >> axis & 1));
    }
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct frame f = {.octree = job->prepared, .tally = job->tally};
  if (hsr_cells_begin(&f.cells, job) ||
      hsr_quadtree_init(&f.quadtree, &job->view->window, job->scratch))
    return hsr_fail_nomem(err);
  find_beyond(&f);
  if (f.octree->layer[0].n)
    visit(&f, f.octree->n_layers - 1, 0);
  return HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_counter counters[] = {
    [NODES] = {"nodes visited", "octree nodes come to", HSR_ACTIVATE,
               HSR_OF_CELL, HSR_OF_NOTHING, .key = "cube-visited"},
    [OUT] = {"nodes out", "outside of the picture", HSR_REJECT, HSR_OF_CELL,
             HSR_OF_WINDOW, .key = "cube-out"},
    [SILHOUETTES] = {"silhouette tests",
                     "quadtree cells compared with outlines of nodes",
                     HSR_COMPARE, HSR_OF_CELL, HSR_OF_CELL,
                     "outside|covered|divided|visible"},
    [HIDDEN] = {"nodes hidden", "covered: they and all below them are hidden",
                HSR_REJECT, HSR_OF_CELL, HSR_OF_NOTHING},
    [CUBES] = {"cubes drawn", "leaves that are not hidden", HSR_ACTIVATE,
               HSR_OF_CELL, HSR_OF_NOTHING},
    [SIDES] = {"sides tiled", "sides of these that face the eye", HSR_ACTIVATE,
               HSR_OF_FACE, HSR_OF_NOTHING},
    [CELLS] = {"cells", "quadtree cells visited to tile a side", HSR_COMPARE,
               HSR_OF_FACE, HSR_OF_CELL, "outside|covered|crossed|inside"},
    [SUBDIVISIONS] = {"subdivisions", "of these, those that were subdivided",
                      HSR_SUBDIVIDE, HSR_OF_FACE, HSR_OF_CELL},
    [ASKED] = {"samples asked", "samples that are decided exactly", HSR_SAMPLE,
               HSR_OF_FACE, HSR_OF_WINDOW, "not covered|covered"},
    [SAMPLES] = {"samples", "samples written", HSR_ACCEPT, HSR_OF_FACE,
                 HSR_OF_WINDOW},
    {NULL}};

static const struct hsr_line outline[] = {
    {"for each node of the octree, from front to back", HSR_RAISES(NODES)},
    {"  return if its cube is outside of the picture", HSR_RAISES(OUT)},
    {"  look for a part of its silhouette in the quadtree that is not covered",
     HSR_RAISES(SILHOUETTES)},
    {"  return if there is none", HSR_RAISES(HIDDEN)},
    {"  if it is a leaf: draw the cube", HSR_RAISES(CUBES)},
    {"    for each of its sides that face the eye", HSR_RAISES(SIDES)},
    {"      tile it into a quadtree cell that is not covered, from the root",
     HSR_RAISES(CELLS)},
    {"        inside of the side and vacant: write its samples",
     HSR_RAISES(SAMPLES, ASKED)},
    {"        else the same with its four quadrants", HSR_RAISES(SUBDIVISIONS)},
    {"  else the same with its eight octants"},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {"cubes", "XYZ", "octree", "once for all frames"},
    {"cubes", "Z", "fixed order of octants", "once a frame"},
    {"samples", "XY", "quadtree", "once a cube"},
    {NULL}};

static void put_boxes(const void *prepared, const struct hsr_scene *scene,
                      hsr_take_box *put, void *to) {
  const struct octree *o = prepared;
  const struct hsr_grid *grid = scene->grid;
  for (int layer = 0; layer < o->n_layers; layer++)
    for (uint32_t k = 0; k < o->layer[layer].n; k++) {
      uint32_t lo[3], hi[3];
      struct hsr_box box;
      cells_of(grid, layer, o->layer[layer].code[k], lo, hi);
      for (int a = 0; a < 3; a++) {
        box.lo[a] = grid->bound[a][lo[a]];
        box.hi[a] = grid->bound[a][hi[a] + 1];
      }
      put(to, k, (uint32_t)layer, &box);
    }
}

static void show(const void *prepared, struct hsr_shown *shown) {
  (void)prepared;
  shown->boxes = put_boxes;
}

const struct hsr_algorithm HSR_ALGORITHM(meagher) = {
    .name = "meagher",
    .title = "Meagher's octree of cubes, tiled into a quadtree",
    .authors = "D. Meagher",
    .year = 1982,
    .source = "Meagher, Computer Graphics and Image Processing 19, 1982; "
              "Greene, PhD thesis, UC Santa Cruz, 1995, 2.1.6",
    .taxonomy = HSR_HIERARCHICAL,
    .sort_order = "Z(XY)",
    .coherence = "of objects, in space; area",
    .subjects = 1 << HSR_GRID,
    .makes = {{HSR_IDS}},
    .flags = HSR_INSTANCED,
    .sorts = sorts,
    .counters = counters,
    .outline = outline,
    .prepare = prepare,
    .render = render,
    .release = release,
    .show = show};
