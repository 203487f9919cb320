/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Error-bounded antialiased rendering: pictures of a guaranteed error.
 *
 * Source      N. Greene and M. Kass, "Error-Bounded Antialiased Rendering of
 *             Complex Environments", SIGGRAPH 1994; N. Greene, "Hierarchical
 *             Rendering of Complex Environments", PhD thesis, UC Santa Cruz,
 *             1995, chapter 5 ("the thesis").
 * Notation    octree cube -> node; quadtree cell -> struct hsr_bounded_cell; z
 *             -> q; P -> struct hsr_shape
 * Invariants  when the tiling pass ends, the lists of the quadtree's leaves
 *             hold every face of which a point is visible in the cell. The
 *             interval of a pixel holds the exact integral
 *             (docs/area-picture.md) from the tiling pass on, and only becomes
 *             narrower.
 * Ties        faces on one plane: the exact comparison of two faces decides at
 *             the corners of a cell, where doubles cannot
 * Departures  the faults of the printed listings (quadtree.c); a node whose
 *             cube may reach to the near plane is not tested; cells of more
 *             than a pixel that are known to the tolerance are not divided, as
 *             in the author's program (p. 86); slivers, and more closed forms
 *             (leaf.c). Shaders: bumps are of a curtate cycloid, as a cycloid's
 *             slope has no bound at its cusps; Gouraud's colours are not
 *             integrated in closed form.
 *             Of 5.6: order=strict is the first of his two directions
 *             (strict.h). Motion blur is not built; reports/area/README.md
 *             tells why.
 * Cost        of what is visible; of each pixel, the more complex what it
 *             shows, the more */
#include "algorithms/hierarchical/bounded/bounded.h"
#include "algorithms/hierarchical/bounded/strict.h"
#include "algorithms/engines/cubes/cube_frame.h"
#include "common/answers/kinds/area.h"
#include "common/base/clock.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum option { REFINE, EXACT, LIMIT, DEPTH, CELLS, SECONDS, ORDER };
enum { ORDER_CUBES, ORDER_STRICT };

static const struct hsr_word orders[] = {
    [HSR_BOUNDED_QUEUE] = {"queue", "the most uncertain cell first", 0},
    [HSR_BOUNDED_LEVELS] = {"levels", "all cells of one size, then the next",
                            0},
    {NULL}};

static const struct hsr_word tilings[] = {
    [ORDER_CUBES] = {"cubes", "by cubes; those of a cube in any order", 0},
    [ORDER_STRICT] = {"strict",
                      "each before all that it may hide: octrees of BSP trees "
                      "(p. 89)",
                      0},
    {NULL}};

static const struct hsr_option options[] = {
    [REFINE] = {"refine", "which cell is divided next", orders, 0,
                HSR_BOUNDED_LEVELS, HSR_BOUNDED_QUEUE},
    [EXACT] = {"exact", "a cell of so many polygons is integrated exactly",
               NULL, 0, HSR_BOUNDED_CAPACITY, HSR_BOUNDED_CAPACITY},
    [LIMIT] = {"limit", "cells asked about a cube's face, for each face in it",
               NULL, 0, 1000, 4},
    [DEPTH] = {"depth", "a cell is at least 2^-N pixels wide", NULL, 0,
               HSR_BOUNDED_DEEPEST, 16},
    [CELLS] = {"cells", "millions of cells at a time", NULL, 1, 1000, 16},
    [SECONDS] = {"seconds", "a window takes no longer; 0: any time",
                 .real = true, .real_least = 0, .real_most = 1e6,
                 .real_standard = 0},
    [ORDER] = {"order", "in which polygons are tiled, front to back", tilings,
               0, ORDER_STRICT, ORDER_CUBES},
    {NULL}};

struct prepared {
  struct hsr_cubes cubes;
  struct hsr_strict strict; /* of order=strict only */
  bool is_strict;
  uint64_t **within;   /* an object: the faces of each node's subtree */
  uint64_t *instances; /* the same, of the octree of instances */
  struct hsr_arena arena;
};

/* The tiling pass: the octree of octrees from front to back. */
struct traversal {
  struct hsr_cube_frame frame;
  const struct prepared *prepared;
  struct hsr_bounded_tree tree;
  uint64_t limit;
  struct hsr_tally *tally;
  uint32_t *met; /* by face of the current object: the visit that met it last */
  uint32_t visit; /* another one for each instance */
};

/* --- CouldCubeBeVisible --------------------------------------------------- */

static struct hsr_bounded_side side_of(const struct traversal *w,
                                       const struct hsr_placing *placing,
                                       const struct hsr_octree_box *cube,
                                       const struct hsr_cube_image *image,
                                       int side) {
  struct hsr_side_depth depth =
      hsr_cube_side_depth(&w->frame, placing, cube, image, side);
  /* In parallel, the frame's depths are far - t, and here -t. */
  double far = w->frame.job->view->parallel ? w->frame.tiler.far : 0;
  double off = 0x1p-44 * (fabs(far) + fabs(depth.c));
  struct hsr_bounded_side out = {.margin = HSR_CUBE_MARGIN,
                                 .a = depth.a,
                                 .b = depth.b,
                                 .c = depth.c - far + off,
                                 .nearest = -INFINITY};
  for (int k = 0; k < 4; k++) {
    int corner = hsr_cube_side[side][k];
    out.x[k] = image->x[corner];
    out.y[k] = image->y[corner];
    out.nearest = fmax(out.nearest, image->q[corner] - far + off);
  }
  return out;
}

/* `n` faces are in the cube. */
static bool could_box_be_visible(struct traversal *w,
                                 const struct hsr_placing *placing,
                                 const struct hsr_octree_box *cube, uint64_t n,
                                 struct hsr_subject subject) {
  struct hsr_cube_image image;
  HSR_STEP(w->tally, HSR_BOUNDED_NODES, subject, HSR_NOTHING, HSR_NOWHERE, 0);
  if (hsr_cube_classify(&w->frame, placing, cube, subject) == HSR_BOX_OUT) {
    HSR_STEP(w->tally, HSR_BOUNDED_OUT, subject, HSR_THE_WINDOW, HSR_NOWHERE,
             0);
    return false;
  }
  if (!hsr_cube_project(&w->frame, placing, cube, &image))
    return true; /* the eye may be inside, or the near plane meet it */
  bool visible = false;
  for (int side = 0; side < 6 && !visible; side++)
    if (image.front >> side & 1) {
      struct hsr_bounded_side face = side_of(w, placing, cube, &image, side);
      visible =
          hsr_bounded_could_be_seen(&w->tree, &face, w->limit * n, subject);
    }
  HSR_STEP(w->tally, HSR_BOUNDED_CUBES_TESTED, subject, HSR_NOTHING,
           HSR_NOWHERE, visible);
  if (!visible)
    HSR_STEP(w->tally, HSR_BOUNDED_CUBES_CULLED, subject, HSR_NOTHING,
             HSR_NOWHERE, 0);
  return visible;
}

static bool could_be_visible(struct traversal *w,
                             const struct hsr_placing *placing,
                             const struct hsr_octree_node *node, uint64_t n,
                             struct hsr_subject subject) {
  struct hsr_octree_box cube = hsr_octree_cube(node);
  return could_box_be_visible(w, placing, &cube, n, subject);
}

/* The time has ended: what is in the cube is not tiled. */
static bool leave(struct traversal *w, const struct hsr_placing *placing,
                  const struct hsr_octree_box *cube,
                  struct hsr_subject subject) {
  struct hsr_cube_image image;
  if (hsr_cube_classify(&w->frame, placing, cube, subject) == HSR_BOX_OUT)
    return true;
  if (!hsr_cube_project(&w->frame, placing, cube, &image)) {
    hsr_bounded_leave_all(&w->tree);
    return true;
  }
  for (int side = 0; side < 6; side++)
    if (image.front >> side & 1) {
      struct hsr_bounded_side face = side_of(w, placing, cube, &image, side);
      if (!hsr_bounded_leave(&w->tree, &face))
        return false;
    }
  return true;
}

/* Of the strict order, whose cubes are of the world. */
static bool could_strict_cube_be_visible(void *context,
                                         const struct hsr_octree_box *cube,
                                         uint64_t n,
                                         struct hsr_subject subject) {
  struct traversal *w = context;
  return could_box_be_visible(w, &w->frame.as_it_is, cube, n, subject);
}

static bool leave_strict(void *context, const struct hsr_octree_box *cube) {
  struct traversal *w = context;
  return leave(w, &w->frame.as_it_is, cube, HSR_CELL(0, HSR_NO_ID, 0));
}

/* --- The tiling pass ------------------------------------------------------ */

static bool insert_face(struct traversal *w, struct hsr_tiler *t, uint32_t f) {
  if (t->few)
    hsr_world_find_plane(t->few, f, &t->tally->out_of_memory);
  hsr_screen_plane(&t->screen, f);
  return !hsr_face_exists(&t->screen, f, t->tally) ||
         hsr_bounded_add(&w->tree, &t->screen, f, hsr_tiler_id(t, f));
}

static bool is_repeated(struct traversal *w, uint32_t f) {
  uint32_t *met = &w->met[w->frame.tiler.id[f]];
  if (*met != w->visit) {
    *met = w->visit;
    return false;
  }
  HSR_STEP(w->tally, HSR_BOUNDED_REPEATED,
           HSR_FACE(hsr_tiler_id(&w->frame.tiler, f)), HSR_NOTHING, HSR_NOWHERE,
           0);
  return true;
}

static bool tile_cell(struct traversal *w, uint32_t place) {
  if (!w->frame.object->cell[place].n_faces)
    return true;
  const struct hsr_cell *cell = hsr_cube_cell(&w->frame, place);
  struct hsr_tiler *t = &w->frame.tiler;
  struct hsr_subject cube = hsr_cube_subject(w->frame.instance, place);
  hsr_tiler_need_screen(t);
  for (uint32_t f = 0; f < cell->n_faces; f++) {
    HSR_STEP(w->tally, HSR_BOUNDED_FACES, HSR_FACE(hsr_tiler_id(t, f)), cube,
             HSR_NOWHERE, 0);
    if (!is_repeated(w, f) && !insert_face(w, t, f))
      return false;
  }
  return true;
}

static bool tile(struct traversal *w, uint32_t k) {
  const struct hsr_octree_node *node = &w->frame.object->octree.node[k];
  struct hsr_octree_box cube = hsr_octree_cube(node);
  if (hsr_bounded_is_late(&w->tree))
    return leave(w, &w->frame.placing, &cube,
                 hsr_cube_subject(w->frame.instance, k));
  uint64_t n = w->prepared->within[w->frame.object - w->frame.cubes->object][k];
  if (!could_be_visible(w, &w->frame.placing, node, n,
                        hsr_cube_subject(w->frame.instance, k)))
    return true;
  if (!tile_cell(w, k))
    return false;
  int nearest = hsr_cube_nearest(&w->frame.placing, node);
  for (int o = 0; o < 8; o++) {
    uint32_t child = node->child[nearest ^ hsr_octant_order[o]];
    if (child != HSR_NO_NODE && !tile(w, child))
      return false;
  }
  return true;
}

static bool tile_instance(struct traversal *w, uint32_t i) {
  hsr_cube_instance(&w->frame, i);
  w->visit++;
  return tile(w, 0);
}

static bool tile_instances(struct traversal *w, uint32_t k) {
  const struct hsr_octree *octree = &w->frame.cubes->octree;
  const struct hsr_octree_node *node = &octree->node[k];
  struct hsr_octree_box cube = hsr_octree_cube(node);
  if (hsr_bounded_is_late(&w->tree))
    return leave(w, &w->frame.as_it_is, &cube, hsr_cube_subject(HSR_NO_ID, k));
  if (!could_be_visible(w, &w->frame.as_it_is, node, w->prepared->instances[k],
                        hsr_cube_subject(HSR_NO_ID, k)))
    return true;
  for (uint32_t p = 0; p < node->n; p++) {
    uint32_t i = octree->item[node->first + p];
    if (hsr_cube_is_new(&w->frame, i) && !tile_instance(w, i))
      return false;
  }
  int nearest = hsr_cube_nearest(&w->frame.as_it_is, node);
  for (int o = 0; o < 8; o++) {
    uint32_t child = node->child[nearest ^ hsr_octant_order[o]];
    if (child != HSR_NO_NODE && !tile_instances(w, child))
      return false;
  }
  return true;
}

/* Tile, of all that is in the scene. Loose faces come first, and what moves
 * last. */
static bool tile_all(struct traversal *w, struct hsr_tiler *loose) {
  const struct hsr_cubes *cubes = w->frame.cubes;
  for (uint32_t f = 0; f < cubes->loose.n_faces; f++) {
    if (hsr_bounded_is_late(&w->tree)) {
      hsr_bounded_leave_all(&w->tree);
      return true;
    }
    if (!insert_face(w, loose, f))
      return false;
  }
  if (!tile_instances(w, 0))
    return false;
  for (uint32_t k = 0; k < cubes->n_movers; k++)
    if (!tile_instance(w, cubes->mover[k]))
      return false;
  return true;
}

/* Tile, of all, in the order that was chosen. */
static bool tile_in_order(struct traversal *w) {
  struct hsr_strict_walk strict = {.strict = &w->prepared->strict,
                                   .tree = &w->tree,
                                   .could_be_visible =
                                       could_strict_cube_be_visible,
                                   .leave = leave_strict,
                                   .context = w};
  struct hsr_tiler loose;
  if (w->prepared->is_strict)
    return !hsr_strict_tile(&strict);
  return !hsr_cube_loose(&w->frame, &loose) && tile_all(w, &loose);
}

/* A wider filter sees beyond the window. */
static void widen(struct hsr_view *view, enum hsr_area_filter filter) {
  struct hsr_window *w = &view->window;
  int by = hsr_bounded_reach(filter);
  w->x0 = w->x0 > by ? w->x0 - by : 0;
  w->y0 = w->y0 > by ? w->y0 - by : 0;
  w->x1 = w->x1 + by < view->m ? w->x1 + by : view->m;
  w->y1 = w->y1 + by < view->n ? w->y1 + by : view->n;
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct hsr_view view = *job->view;
  struct hsr_job wide = *job;
  struct traversal w = {.prepared = job->prepared,
                        .limit = (uint64_t)job->option[LIMIT],
                        .tally = job->tally};
  const struct hsr_bounded_limits limits = {
      .order = (enum hsr_bounded_order)job->option[REFINE],
      .form = hsr_form_area(&job->answer->form),
      .window = job->view->window,
      .deepest = (int)job->option[DEPTH],
      .exact = (uint32_t)job->option[EXACT],
      .cells = (uint32_t)job->option[CELLS] << 20};
  double seconds = job->real[SECONDS];
  double until = seconds > 0 ? hsr_seconds_now() + seconds : INFINITY;
  widen(&view, limits.form.filter);
  wide.view = &view;
  w.met = HSR_NEW_ZEROED(job->scratch, uint32_t,
                         w.prepared->cubes.most_object_faces);
  if (!w.met || hsr_cube_frame_begin(&w.frame, &wide, &w.prepared->cubes) ||
      hsr_bounded_begin(&w.tree, &wide, &limits.form, until, &w.frame.pair) ||
      !tile_in_order(&w))
    return hsr_fail_nomem(err);
  return hsr_bounded_refine(&w.tree, &limits, err);
}

/* --- Preparation ---------------------------------------------------------- */

/* The faces in the cubes of a subtree; children come after their parents. */
static uint64_t *count_within(const struct hsr_octree *octree,
                              const uint64_t *own, struct hsr_arena *arena) {
  uint64_t *n = HSR_NEW(arena, uint64_t, octree->n_nodes);
  for (uint32_t k = octree->n_nodes; n && k-- > 0;) {
    n[k] = own[k];
    for (int o = 0; o < 8; o++)
      if (octree->node[k].child[o] != HSR_NO_NODE)
        n[k] += n[octree->node[k].child[o]];
  }
  return n;
}

static bool count_object(struct prepared *p, uint32_t o) {
  const struct hsr_cubes_object *object = &p->cubes.object[o];
  uint64_t *own = HSR_NEW(&p->arena, uint64_t, object->octree.n_nodes);
  for (uint32_t k = 0; own && k < object->octree.n_nodes; k++)
    own[k] = object->cell[k].n_faces;
  p->within[o] = own ? count_within(&object->octree, own, &p->arena) : NULL;
  return p->within[o] != NULL;
}

static bool count_instances(struct prepared *p) {
  const struct hsr_octree *octree = &p->cubes.octree;
  const struct hsr_scene *scene = p->cubes.scene;
  uint64_t *own = HSR_NEW_ZEROED(&p->arena, uint64_t, octree->n_nodes);
  for (uint32_t k = 0; own && k < octree->n_nodes; k++)
    for (uint32_t i = 0; i < octree->node[k].n; i++)
      own[k] +=
          scene
              ->objects[scene
                            ->instances[octree->item[octree->node[k].first + i]]
                            .object]
              .n_faces;
  p->instances = own ? count_within(octree, own, &p->arena) : NULL;
  return p->instances != NULL;
}

static enum hsr_status prepare(const struct hsr_world *world,
                               const long *option, void **prepared,
                               struct hsr_error *err) {
  /* The choice of hzbuffer: Greene's octree is the same. */
  static const struct hsr_octree_rule rule = {
      .small = .1, .most = 20, .least = 20};
  struct prepared *p = calloc(1, sizeof *p);
  *prepared = p;
  if (!p)
    return hsr_fail_nomem(err);
  enum hsr_status status = hsr_cubes_init(&p->cubes, world, &rule, err);
  if (status)
    return status;
  uint32_t n = p->cubes.scene->n_objects;
  p->within = HSR_NEW(&p->arena, uint64_t *, n);
  if (!p->within || !count_instances(p))
    return hsr_fail_nomem(err);
  for (uint32_t o = 0; o < n; o++)
    if (!count_object(p, o))
      return hsr_fail_nomem(err);
  p->is_strict = option[ORDER] == ORDER_STRICT;
  return p->is_strict ? hsr_strict_init(&p->strict, world, err) : HSR_OK;
}

static void release(void *prepared) {
  struct prepared *p = prepared;
  if (!p)
    return;
  if (p->is_strict)
    hsr_strict_free(&p->strict);
  hsr_cubes_free(&p->cubes);
  hsr_arena_free(&p->arena);
  free(p);
}

static void show(const void *prepared, struct hsr_shown *shown) {
  shown->cubes = &((const struct prepared *)prepared)->cubes;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {{&hsr_inequalities_part}, {NULL}};

static const struct hsr_counter counters[] = {
    [HSR_BOUNDED_NODES] = {"nodes visited", "octree nodes come to",
                           HSR_ACTIVATE, HSR_OF_CELL, HSR_OF_NOTHING,
                           .key = "cube-visited"},
    [HSR_BOUNDED_OUT] = {"nodes out", "outside of the frustum", HSR_REJECT,
                         HSR_OF_CELL, HSR_OF_WINDOW, .key = "cube-out"},
    [HSR_BOUNDED_CUBES_TESTED] = {"cubes tested", "whether they are hidden",
                                  HSR_COMPARE, HSR_OF_CELL, HSR_OF_NOTHING,
                                  "hidden|visible", .key = "cube-tested"},
    [HSR_BOUNDED_CUBES_CULLED] = {"cubes culled", "found to be hidden",
                                  HSR_REJECT, HSR_OF_CELL, HSR_OF_NOTHING,
                                  .key = "cube-culled"},
    [HSR_BOUNDED_SIDE_CELLS] = {"cells asked", "about a front face of a cube",
                                HSR_COMPARE, HSR_OF_CELL, HSR_OF_CELL},
    [HSR_BOUNDED_FACES] = {"faces met",
                           "in cubes that are not known to be hidden",
                           HSR_ACTIVATE, HSR_OF_FACE, HSR_OF_CELL},
    [HSR_BOUNDED_REPEATED] = {"faces repeated", "met again in the frame",
                              HSR_REJECT, HSR_OF_FACE, HSR_OF_NOTHING},
    [HSR_BOUNDED_PLACED] = {"polygons against cells", "how they lie on them",
                            HSR_COMPARE, HSR_OF_FACE, HSR_OF_CELL,
                            "misses|meets|covers"},
    [HSR_BOUNDED_MISSED] = {"polygons beside", "that do not meet the cell",
                            HSR_REJECT, HSR_OF_FACE, HSR_OF_CELL},
    [HSR_BOUNDED_FARTHER] = {"polygons farther",
                             "than all that is visible there", HSR_REJECT,
                             HSR_OF_FACE, HSR_OF_CELL},
    [HSR_BOUNDED_STRUCTURES] = {"covering structures", "that cover a cell",
                                HSR_RETIRE, HSR_OF_FACE, HSR_OF_CELL,
                                "a polygon|two at an edge|a fan"},
    [HSR_BOUNDED_REMOVED] = {"polygons removed",
                             "from lists, behind a structure", HSR_REJECT,
                             HSR_OF_FACE, HSR_OF_CELL},
    [HSR_BOUNDED_PRUNED] = {"subtrees removed",
                            "behind a polygon that covers them", HSR_REJECT,
                            HSR_OF_CELL, HSR_OF_NOTHING},
    [HSR_BOUNDED_STORED] = {"polygons stored", "on the lists of leaves",
                            HSR_SORT, HSR_OF_FACE, HSR_OF_CELL},
    [HSR_BOUNDED_SPLITS] = {"cells divided", "in either pass", HSR_SUBDIVIDE,
                            HSR_OF_CELL, HSR_OF_NOTHING},
    [HSR_BOUNDED_ORDERED] = {"polygons compared", "in depth, over a cell",
                             HSR_COMPARE, HSR_OF_FACE, HSR_OF_FACE,
                             "not before|before"},
    [HSR_BOUNDED_BOUNDED] = {"cells bounded", "leaves, in the refinement pass",
                             HSR_SAMPLE, HSR_OF_CELL, HSR_OF_NOTHING,
                             "between|exact"},
    [HSR_BOUNDED_SHADED] = {"colours bounded",
                            "of a polygon in a cell, by a shader", HSR_SAMPLE,
                            HSR_OF_FACE, HSR_OF_CELL},
    [HSR_BOUNDED_EXACT_ONE] = {"exact cells of one", "polygon, or none",
                               HSR_RETIRE, HSR_OF_CELL, HSR_OF_NOTHING},
    [HSR_BOUNDED_EXACT_TWO] = {"exact cells of two", "polygons", HSR_RETIRE,
                               HSR_OF_CELL, HSR_OF_NOTHING},
    [HSR_BOUNDED_EXACT_MORE] = {"exact cells of more",
                                "polygons, up to `exact`", HSR_RETIRE,
                                HSR_OF_CELL, HSR_OF_NOTHING},
    [HSR_BOUNDED_REFINED] = {"cells refined", "divided in the refinement pass",
                             HSR_ACTIVATE, HSR_OF_CELL, HSR_OF_NOTHING},
    [HSR_BOUNDED_PIXELS] = {"pixels", "written", HSR_ACCEPT, HSR_OF_CELL,
                            HSR_OF_NOTHING},
    {NULL}};

static const struct hsr_line outline[] = {
    {"Tile: for each node of the octree, from front to back",
     HSR_RAISES(HSR_BOUNDED_NODES)},
    {"  return if the cube is outside of the frustum",
     HSR_RAISES(HSR_INEQUALITIES, HSR_BOUNDED_OUT)},
    {"  return unless CouldCubeBeVisible",
     HSR_RAISES(HSR_BOUNDED_CUBES_TESTED, HSR_BOUNDED_CUBES_CULLED)},
    {"    for each front face: cells from the root on, breadth first",
     HSR_RAISES(HSR_BOUNDED_SIDE_CELLS)},
    {"      farther than zfar: hidden; nearer than znear: visible"},
    {"      else the same for its four children"},
    {"  for each polygon P of the node", HSR_RAISES(HSR_BOUNDED_FACES)},
    {"    skip it if it was met before", HSR_RAISES(HSR_BOUNDED_REPEATED)},
    {"    InsertPolyIntoQuadtree: how does P lie on the cell?",
     HSR_RAISES(HSR_BOUNDED_PLACED)},
    {"      return if P does not meet the cell",
     HSR_RAISES(HSR_BOUNDED_MISSED)},
    {"      return if P is farther than zfar", HSR_RAISES(HSR_BOUNDED_FARTHER)},
    {"      if P covers the cell, remove the subtrees that it hides",
     HSR_RAISES(HSR_BOUNDED_PRUNED)},
    {"      a leaf with room: InsertPoly", HSR_RAISES(HSR_BOUNDED_STORED)},
    {"        if P completes a covering structure, update zfar",
     HSR_RAISES(HSR_BOUNDED_STRUCTURES)},
    {"          is a polygon behind all of the structure's?",
     HSR_RAISES(HSR_BOUNDED_ORDERED)},
    {"          RemoveHiddenPolys", HSR_RAISES(HSR_BOUNDED_REMOVED)},
    {"      a full leaf: SubdivideQCell", HSR_RAISES(HSR_BOUNDED_SPLITS)},
    {"      insert P into the four children"},
    {"Refine: take the most uncertain cell, or all of the next size",
     HSR_RAISES(HSR_BOUNDED_REFINED)},
    {"  divide it; bound the integral over each child",
     HSR_RAISES(HSR_BOUNDED_BOUNDED)},
    {"    an interval shader bounds a polygon's colours",
     HSR_RAISES(HSR_BOUNDED_SHADED)},
    {"    in closed form: one polygon", HSR_RAISES(HSR_BOUNDED_EXACT_ONE)},
    {"    in closed form: two polygons", HSR_RAISES(HSR_BOUNDED_EXACT_TWO)},
    {"    in closed form: more", HSR_RAISES(HSR_BOUNDED_EXACT_MORE)},
    {"    else between the least and the greatest colour of its polygons"},
    {"  add up, to the pixel; within the tolerance: write it",
     HSR_RAISES(HSR_BOUNDED_PIXELS)},
    {NULL}};

_Static_assert((int)HSR_BOUNDED_DEEPEST == (int)HSR_SQUARES_OF_PIXELS,
               "the smallest cells are of level 0");

const struct hsr_algorithm HSR_ALGORITHM(error_bounded) = {
    .name = "error-bounded",
    .numbered = HSR_NUMBERED_SQUARES,
    .title = "Error-bounded antialiased rendering",
    .authors = "N. Greene and M. Kass",
    .year = 1994,
    .source = "Greene and Kass, SIGGRAPH 1994; Greene, PhD thesis, UC Santa "
              "Cruz, 1995, chapter 5",
    .taxonomy = HSR_HIERARCHICAL,
    .sort_order = "Z(XY)",
    .coherence = "of hidden regions in space, of areas on the screen",
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_AREAS}},
    .flags = HSR_INSTANCED,
    .parts = uses,
    .counters = counters,
    .outline = outline,
    .options = options,
    .prepare = prepare,
    .render = render,
    .show = show,
    .release = release};
