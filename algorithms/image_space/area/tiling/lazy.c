/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hierarchical polygon tiling with lazy z-buffering, of polygons that come
 * nearly from front to back.
 *
 * Source      N. Greene, "Hierarchical Polygon Tiling with Coverage Masks",
 *             SIGGRAPH 1996, 6.1.
 * Notation    approximate front-to-back order -> order=tree, the standard: the
 *             cubes of an octree from front to back, the faces that a cube
 *             itself holds by their nearest corners. znear, zfar, fragment, pixel -> lazy_pyramid.h
 * Invariant   the picture is the same for any order (lazy_pyramid.h)
 * Ties        Of faces in one plane the lowest id is seen. A sample that is too
 *             close to an edge for the error bounds is decided exactly
 *             (polygon.h).
 * Departures  - The octree is made once, of the faces as they are laid out in
 *             the frame's world; faces that move need no care of their own.
 *             - Other orders can be chosen, to be compared with the standard.
 *             - A face that is not flat is seen on its plane, which may lie
 *             outside of its cubes. With order=tree these faces come first.
 *             - Boxes of what is in a cube are tested, as by `tiling`.
 *             - Departures of the pyramid are named in lazy_pyramid.h.
 * Cost        that of tiling, if polygons come from front to back and the
 *             depths in a cell span little
 */
#include "algorithms/algorithm.h"
#include "algorithms/engines/bsp/bsp_walk.h"
#include "algorithms/image_space/area/tiling/frame.h"
#include "algorithms/image_space/area/tiling/lazy_pyramid.h"
#include "algorithms/image_space/area/tiling/separate.h"
#include "common/answers/kinds/filtered.h"
#include "common/base/numbers.h"
#include "common/trees/octree.h"
#include "common/exact/order.h"
#include "common/exact/predicates.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ORDER, LEAF, DISORDER, OCTREE };
enum { ORDER_TREE, ORDER_FRONT, ORDER_BACK, ORDER_INPUT };
enum { OCTREE_OFF, OCTREE_ON };

enum { POLYGONS, POLYGONS_HIDDEN, NEAREST };

/* --- Once for all frames -------------------------------------------------- */

struct prepared {
  struct hsr_sampling sampling; /* must be first: hsr_tiling_prepare */
  struct hsr_bsp separate;      /* the faces, undivided (separate.h) */
  struct hsr_bsp tree;          /* order=front, back: their pieces in order */
  struct hsr_octree octree;     /* order=tree: the octree of the faces */
  struct hsr_arena arena;       /* holds the octree */
  struct hsr_pieces_room room;
};

static void make_room(struct hsr_pieces_room *room, const struct hsr_bsp *bsp) {
  room->points = hsr_max_u32(room->points, bsp->n_points);
  for (uint32_t k = 0; k < bsp->n_pieces; k++)
    room->corners = hsr_max_u32(room->corners, bsp->piece[k].n_corners);
}

static struct hsr_box bounds_of(const void *context, uint32_t f) {
  const struct hsr_world *world = context;
  const double *at[3] = {world->mesh.x, world->mesh.y, world->mesh.z};
  struct hsr_box box;
  for (int k = 0; k < 3; k++) {
    box.lo[k] = box.hi[k] = at[k][world->mesh.vertex[world->mesh.start[f]]];
    for (uint32_t c = world->mesh.start[f]; c < world->mesh.start[f + 1]; c++) {
      box.lo[k] = fmin(box.lo[k], at[k][world->mesh.vertex[c]]);
      box.hi[k] = fmax(box.hi[k], at[k][world->mesh.vertex[c]]);
    }
  }
  return box;
}

static double area_of(const void *context, uint32_t f) {
  const struct hsr_world *w = context;
  return 0.5 *
         sqrt(w->mesh.nx[f] * w->mesh.nx[f] + w->mesh.ny[f] * w->mesh.ny[f] +
              w->mesh.nz[f] * w->mesh.nz[f]);
}

/* Makes the octree. A face is in the smallest cube that holds it, but a small
 * one is in all octants that its box meets (common/trees/octree.h). */
static enum hsr_status make_octree(struct prepared *p,
                                   const struct hsr_world *world, long leaf) {
  struct hsr_primitives faces = {world->n_faces, world, bounds_of, area_of,
                                 NULL};
  struct hsr_octree_rule rule = {0.1, (uint32_t)leaf, 1};
  struct hsr_box box = hsr_all_points(&p->separate).tight;
  double side = 0;
  for (int k = 0; k < 3; k++)
    side = fmax(side, box.hi[k] - box.lo[k]);
  /* A little larger, for what is rounded. */
  side = 1.0009765625 * side + 0x1p-900;
  return hsr_octree_init(&p->octree, &faces, &rule, box.lo, side,
                         world->roster.scene->threads, &p->arena);
}

static void release(void *prepared) {
  struct prepared *p = prepared;
  hsr_sampling_free(&p->sampling);
  hsr_bsp_free(&p->separate);
  hsr_bsp_free(&p->tree);
  hsr_arena_free(&p->arena);
  free(p);
}

/* It is empty unless order=tree. */
static void show(const void *prepared, struct hsr_shown *shown) {
  shown->octree = &((const struct prepared *)prepared)->octree;
}

static enum hsr_status prepare(const struct hsr_world *world,
                               const long *option, void **prepared,
                               struct hsr_error *err) {
  struct hsr_bsp_rule rule = {.most = (uint32_t)option[LEAF]};
  enum hsr_status status = hsr_tiling_prepare(
      sizeof(struct prepared), HSR_TILING_INTERVALS, prepared, err);
  struct prepared *p = *prepared;
  if (!status && hsr_separate_init(&p->separate, world))
    status = hsr_fail_nomem(err);
  if (!status && option[ORDER] == ORDER_TREE && world->n_faces &&
      make_octree(p, world, option[LEAF]))
    status = hsr_fail_nomem(err);
  if (!status && (option[ORDER] == ORDER_FRONT || option[ORDER] == ORDER_BACK))
    status = hsr_bsp_init(&p->tree, world, &rule, err);
  if (status)
    return status;
  make_room(&p->room, &p->separate);
  make_room(&p->room, &p->tree);
  for (uint32_t f = 0; f < world->n_faces; f++)
    p->room.face =
        hsr_max_u32(p->room.face, hsr_max_u32(hsr_face_size(world, f),
                                              hsr_plane_loop(world, f).n));
  return HSR_OK;
}

/* --- A frame -------------------------------------------------------------- */

/* A polygon that waits for its turn to be tiled: orders other than tree. */
struct turn {
  const struct hsr_bsp_piece *piece;
  int facing;
};

/* A face of a cube, and how far away its nearest corner is. */
struct near_face {
  double t;
  uint32_t face;
};

struct frame {
  const struct hsr_job *job;
  const struct prepared *prepared;
  struct hsr_tiling tiling;
  struct near_face *near; /* order=tree: those of a cube, from front to back */
  struct hsr_lazy_pyramid pyramid;
  struct hsr_growing turn; /* struct turn */
  bool *met; /* by face. order=tree: it has been tiled. order=front, back: it is
                loose, and gets no turn */
  uint16_t (
      *rgb)[3];     /* of a filtered picture: the colours of faces, and last of
                         the background, */
  bool *has_colour; /* where they have been found */
};

/* The most faces that one cube itself holds. */
static uint32_t most_of_a_cube(const struct hsr_octree *octree) {
  uint32_t most = 0;
  for (uint32_t k = 0; k < octree->n_nodes; k++)
    most = hsr_max_u32(most, octree->node[k].n);
  return most;
}

static enum hsr_status begin(struct frame *f, const struct hsr_job *job) {
  const struct prepared *p = job->prepared;
  struct hsr_arena *arena = job->scratch;
  size_t colours =
      hsr_answer_sums_of(job->answer) ? (size_t)job->world->n_faces + 1 : 0;
  *f = (struct frame){
      .job = job,
      .prepared = p,
      .rgb = hsr_arena_array(arena, colours, sizeof *f->rgb),
      .has_colour = HSR_NEW_ZEROED(arena, bool, colours),
      .near = HSR_NEW(arena, struct near_face, most_of_a_cube(&p->octree)),
      .met = HSR_NEW_ZEROED(arena, bool, job->world->n_faces)};
  if (!f->rgb || !f->has_colour || !f->near || !f->met ||
      hsr_tiling_begin(&f->tiling, &p->sampling, job, p->room))
    return HSR_E_NOMEM;
  return hsr_lazy_begin(&f->pyramid, &f->tiling.masks, job->world,
                        &f->tiling.view, job->tally, arena);
}

/* From now on the pieces that are tiled are those of this tree. All of its
 * points are taken to the screen. */
static void take_tree(struct frame *f, const struct hsr_bsp *bsp) {
  static const double still[3] = {0, 0, 0};
  struct hsr_bsp_cube all = hsr_all_points(bsp);
  hsr_pieces_tree(&f->tiling.pieces, bsp, still);
  hsr_pieces_leaf(&f->tiling.pieces, &all);
}

static void tile_piece(struct frame *f, const struct hsr_bsp_piece *piece,
                       int facing) {
  struct hsr_pieces_view *pieces = &f->tiling.pieces;
  if (!hsr_pieces_take(pieces, piece, facing))
    return;
  hsr_pieces_outline(pieces);
  struct hsr_subject subject =
      HSR_PIECE(piece->face, (uint32_t)(piece - pieces->bsp->piece));
  struct hsr_window window = hsr_window_make(pieces->box.x0, pieces->box.y0,
                                             pieces->box.x1, pieces->box.y1);
  HSR_STEP(f->job->tally, POLYGONS, subject, HSR_THE_WINDOW, window, 0);
  hsr_tiling_whom(&f->tiling, HSR_FACE(piece->face));
  if (!hsr_lazy_tile(&f->pyramid, piece->face, &pieces->polygon, pieces->box))
    HSR_STEP(f->job->tally, POLYGONS_HIDDEN, subject, HSR_THE_WINDOW, window,
             0);
}

/* The side of a face on which the eye is, +1 or -1; 0: the face does not exist
 * in this view. */
static int facing_of(struct frame *f, uint32_t face) {
  struct hsr_screen *screen = &f->pyramid.screen;
  hsr_lazy_face(&f->pyramid, face);
  return hsr_face_exists(screen, face, f->job->tally)
             ? hsr_eye_side(screen, face, f->job->tally)
             : 0;
}

static void tile_face(struct frame *f, uint32_t face) {
  int facing = facing_of(f, face);
  if (facing)
    tile_piece(f, &f->prepared->separate.piece[face], facing);
}

/* --- An octree, from front to back ---------------------------------------- */

/* The corners of a cube's box, and a little more for the rounding: the boxes of
 * an octree are within 2^-50 of the coordinates (common/trees/octree.c). */
static struct hsr_box corners_of(const struct hsr_octree_box *box) {
  struct hsr_box corners;
  for (int k = 0; k < 3; k++) {
    double more = 0x1p-48 * (fabs(box->centre[k]) + box->half[k]);
    corners.lo[k] = box->centre[k] - box->half[k] - more;
    corners.hi[k] = box->centre[k] + box->half[k] + more;
  }
  return corners;
}

/* No point of a box has a greater q than this. t is a sum of three products,
 * and within 8 u of their sizes, as in polygon.c. */
static double nearest_of(const struct frame *f, const struct hsr_box *box) {
  const struct hsr_view *view = &f->tiling.view;
  const double *row = view->depth, *E = view->E;
  double t = -0x1p-900;
  for (int k = 0; k < 3; k++) {
    double lo = row[k] * (box->lo[k] - E[k]);
    double hi = row[k] * (box->hi[k] - E[k]);
    t += fmin(lo, hi) - 0x1p-48 * fmax(fabs(lo), fabs(hi));
  }
  if (view->parallel)
    return -t;
  return t > 0 ? (1 + 0x1p-50) / t : INFINITY;
}

/* May anything be seen of what is in a cube? Its silhouette is tiled at the
 * depth of its nearest point. Visits are counted for the cube that
 * hsr_tiling_whom has named. */
static bool is_visible(struct frame *f, const struct hsr_octree_box *cube) {
  static const double still[3] = {0, 0, 0};
  struct hsr_box box = corners_of(cube);
  struct hsr_pieces_view *pieces = &f->tiling.pieces;
  enum hsr_box_place place = hsr_pieces_box(pieces, &box, still);
  if (place != HSR_BOX_INSIDE || f->job->option[OCTREE] == OCTREE_OFF)
    return place != HSR_BOX_OUTSIDE;
  bool visible = hsr_lazy_shows(&f->pyramid, hsr_pieces_silhouette(pieces),
                                pieces->box, nearest_of(f, &box));
  hsr_tiling_count_test(&f->tiling, visible);
  return visible;
}

/* How far along the view the nearest corner of a face is, but for rounding: only
 * the order depends on it. */
static double nearest_corner(const struct frame *f, uint32_t face) {
  const struct hsr_mesh *mesh = &f->job->world->mesh;
  const double *row = f->tiling.view.depth;
  double least = INFINITY;
  for (uint32_t c = mesh->start[face]; c < mesh->start[face + 1]; c++) {
    uint32_t v = mesh->vertex[c];
    least = fmin(least, row[0] * mesh->x[v] + row[1] * mesh->y[v] +
                            row[2] * mesh->z[v]);
  }
  return least;
}

/* Puts a face into its place among the n of a cube that are there. */
static void put_by_depth(struct frame *f, uint32_t n, uint32_t face) {
  double t = nearest_corner(f, face);
  uint32_t from = 0, to = n;
  while (from < to) {
    uint32_t middle = from + (to - from) / 2;
    bool nearer = t < f->near[middle].t;
    HSR_STEP(f->job->tally, NEAREST, HSR_FACE(face),
             HSR_FACE(f->near[middle].face), HSR_NOWHERE, nearer);
    if (nearer)
      to = middle;
    else
      from = middle + 1;
  }
  memmove(f->near + from + 1, f->near + from, (n - from) * sizeof *f->near);
  f->near[from] = (struct near_face){t, face};
}

/* Tiles the faces that a node itself holds. */
static void tile_faces_of(struct frame *f, const struct hsr_octree_node *node) {
  const uint32_t *item = f->prepared->octree.item;
  uint32_t n = 0;
  for (uint32_t k = 0; k < node->n; k++) {
    uint32_t face = item[node->first + k];
    if (!f->met[face])
      put_by_depth(f, n++, face);
    f->met[face] = true;
  }
  for (uint32_t k = 0; k < n; k++)
    tile_face(f, f->near[k].face);
}

/* ProcessOctreeNode of the thesis (chapter 3), with masks for a z-buffer. */
static void tile_cube(struct frame *f, uint32_t number) {
  const struct hsr_octree *octree = &f->prepared->octree;
  const struct hsr_octree_node *node = &octree->node[number];
  unsigned nearest = 0;
  hsr_tiling_whom(&f->tiling, HSR_CELL(number, HSR_NO_ID, 0));
  if (!is_visible(f, &node->tight))
    return;
  tile_faces_of(f, node);
  for (int k = 0; k < 3; k++)
    nearest |= (unsigned)(f->tiling.view.eye[k] > node->centre[k]) << k;
  for (int k = 0; k < 8; k++) {
    uint32_t child = node->child[nearest ^ hsr_octant_order[k]];
    if (child != HSR_NO_NODE)
      tile_cube(f, child);
  }
}

static void tile_octree(struct frame *f) {
  const struct hsr_world *world = f->job->world;
  take_tree(f, &f->prepared->separate);
  for (uint32_t face = 0; face < world->n_faces; face++)
    if (world->mesh.deviation[face] > 0) {
      tile_face(f, face);
      f->met[face] = true;
    }
  if (f->prepared->octree.n_nodes)
    tile_cube(f, 0);
}

/* --- Other orders --------------------------------------------------------- */

/* The traversal of a tree gives a piece: it gets the next turn, unless its face
 * is loose. */
static void wait_for_turn(void *context, const struct hsr_bsp_piece *piece,
                          int facing) {
  struct frame *f = context;
  if (f->met[piece->face])
    return;
  if (!hsr_arena_grow(f->job->scratch, &f->turn, sizeof(struct turn))) {
    f->pyramid.out_of_memory = true;
    return;
  }
  ((struct turn *)f->turn.items)[f->turn.n - 1] = (struct turn){piece, facing};
}

/* A number below n, by D. Lehmer's multiplicative generator modulo 2^31 - 1. */
static size_t draw_number(uint64_t *seed, size_t n) {
  *seed = *seed * 48271 % 2147483647;
  return (size_t)(*seed * n / 2147483647);
}

/* disorder=: chooses so many per cent of the polygons at random, and permutes
 * these at random. */
static void disturb(struct frame *f, long per_cent) {
  struct turn *turn = f->turn.items;
  size_t n = f->turn.n, moved = n * (size_t)per_cent / 100;
  uint64_t seed = 1996;
  size_t *place = HSR_NEW(f->job->scratch, size_t, n);
  if (!place) {
    f->pyramid.out_of_memory = true;
    return;
  }
  for (size_t k = 0; k < n; k++)
    place[k] = k;
  for (size_t k = 0; k < moved; k++) {
    size_t other = k + draw_number(&seed, n - k), kept = place[k];
    place[k] = place[other];
    place[other] = kept;
  }
  for (size_t k = moved; k > 1; k--) {
    size_t a = place[k - 1], b = place[draw_number(&seed, k)];
    struct turn kept = turn[a];
    turn[a] = turn[b];
    turn[b] = kept;
  }
}

static void tile_turns(struct frame *f) {
  disturb(f, f->job->option[DISORDER]);
  if (f->pyramid.out_of_memory)
    return;
  for (size_t k = 0; k < f->turn.n; k++) {
    const struct turn *turn = (struct turn *)f->turn.items + k;
    tile_piece(f, turn->piece, turn->facing);
  }
}

/* order=input: the faces by their numbers. */
static void tile_input(struct frame *f) {
  const struct hsr_bsp *separate = &f->prepared->separate;
  for (uint32_t face = 0; face < f->job->world->n_faces; face++) {
    int facing = facing_of(f, face);
    if (facing)
      wait_for_turn(f, &separate->piece[face], facing);
  }
  take_tree(f, separate);
  tile_turns(f);
}

/* order=front, back: the pieces of the tree in its order, and then the loose
 * faces, which the tree cannot order, or not for this eye (common/trees/bsp.h,
 * Not flat). */
static void tile_tree(struct frame *f) {
  static const double still[3] = {0, 0, 0};
  const struct hsr_bsp *bsp = &f->prepared->tree;
  struct hsr_bsp_walk walk = {
      .bsp = bsp,
      .view = &f->tiling.view,
      .shift = still,
      .backwards = f->job->option[ORDER] == ORDER_BACK,
      .tally = f->job->tally,
      .waiting = HSR_NEW(f->job->scratch, struct hsr_bsp_waiting,
                         hsr_bsp_most_waiting(bsp->most_depth)),
      .context = f,
      .piece = wait_for_turn};
  if (!walk.waiting) {
    f->pyramid.out_of_memory = true;
    return;
  }
  for (uint32_t face = 0; face < bsp->world->n_faces; face++)
    f->met[face] = bsp->reach[face] > 0 &&
                   hsr_grazes(&f->pyramid.screen, face, bsp->reach[face]);
  for (uint32_t k = 0; k < bsp->n_loose; k++)
    f->met[bsp->loose[k]] = true;
  hsr_bsp_walk_tree(&walk);
  take_tree(f, bsp);
  tile_turns(f);
  take_tree(f, &f->prepared->separate);
  for (uint32_t face = 0; face < bsp->world->n_faces; face++)
    if (f->met[face])
      tile_face(f, face);
}

/* --- The picture ---------------------------------------------------------- */

/* What is told next is of this face; finds its colour, if that is needed. */
static void take_face(void *context, uint32_t face) {
  struct frame *f = context;
  f->tiling.canvas.id = face;
  if (!f->tiling.filtering.filter)
    return;
  uint32_t n = f->job->world->n_faces, k = face < n ? face : n;
  if (!f->has_colour[k])
    hsr_filter_colour(f->job->world, f->job->view,
                      face < n ? hsr_world_parent(f->job->world, face) : face,
                      f->rgb[k]);
  f->has_colour[k] = true;
  hsr_canvas_colour(&f->tiling.canvas, f->rgb[k]);
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct frame f;
  if (begin(&f, job))
    return hsr_fail_nomem(err);
  if (job->option[ORDER] == ORDER_TREE)
    tile_octree(&f);
  else if (job->option[ORDER] == ORDER_INPUT)
    tile_input(&f);
  else
    tile_tree(&f);
  if (f.pyramid.out_of_memory)
    return hsr_fail_nomem(err);
  hsr_lazy_resolve(&f.pyramid, &f.tiling.sink, &f, take_face);
  return HSR_OK;
}

/* --- The descriptor ------------------------------------------------------- */

static const struct hsr_option options[] = {
    [ORDER] = {.name = "order",
               .meaning = "in which polygons come",
               .words =
                   (const struct hsr_word[]){
                       {"tree",
                        "cubes of an octree from front to back, faces of a "
                        "cube by their nearest corners",
                        0},
                       {"front", "pieces in BSP trees, from front to back", 0},
                       {"back", "the same from back to front", 0},
                       {"input", "by their numbers", 0},
                       {NULL, NULL, 0}}},
    [LEAF] = {.name = "leaf",
              .meaning = "the most faces that an octree's leaf has",
              .least = 1,
              .most = 1000,
              .standard = 30},
    [DISORDER] = {.name = "disorder",
                  .meaning = "per cent of the polygons that change places at "
                             "random; not with order=tree",
                  .least = 0,
                  .most = 100},
    [OCTREE] = {.name = "octree",
                .meaning = "cull by cubes: their silhouettes are tiled",
                .words =
                    (const struct hsr_word[]){
                        {"off", "without it: all are gone through", 0},
                        {"on", "with it", 0},
                        {NULL, NULL, 0}},
                .standard = OCTREE_ON},
    {.name = NULL}};

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {
    {&hsr_tiling_part}, {&hsr_lazy_part}, {NULL}};

static const struct hsr_counter counters[] = {
    [POLYGONS] = {"polygons",
                  "faces, or pieces of them, in visible cubes, with a sample "
                  "in their box",
                  HSR_ACTIVATE, HSR_OF_PIECE, HSR_OF_WINDOW},
    [POLYGONS_HIDDEN] = {"polygons hidden",
                         "of these, those whose box is hidden", HSR_REJECT,
                         HSR_OF_PIECE, HSR_OF_WINDOW},
    [NEAREST] = {"nearest corners compared",
                 "of two faces of a cube, to put them in order", HSR_COMPARE,
                 HSR_OF_FACE, HSR_OF_FACE, "farther|nearer"},
    {NULL}};

static const struct hsr_line outline[] = {
    {"for each octree cube, from front to back"},
    {"", .part = &hsr_tiling_part},
    {"  put the polygons in it in order, by their nearest corners",
     HSR_RAISES(NEAREST)},
    {"  for each polygon in it", HSR_RAISES(POLYGONS)},
    {"    if it is behind zfar of the cell that encloses its box: skip it",
     HSR_RAISES(POLYGONS_HIDDEN)},
    {"", .part = &hsr_tiling_part, .group = HSR_CELL_LINES},
    {"", .part = &hsr_lazy_part},
    {"    update znear and zfar of the coarser cells"},
    {"", .part = &hsr_lazy_part, .group = HSR_END_LINES},
    {"", .part = &hsr_tiling_part, .group = HSR_SAMPLE_LINES},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {"cubes", "distance", "octree, from front to back", "once a frame"},
    {"faces", "nearest corner", "binary insertion", "a cube"},
    {"faces", "X and Y", "mask pyramid", "a polygon"},
    {"faces", "Z", "exhaustive search", "a sample of a z-buffered pixel"},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(tiling_lazy) = {
    .name = "tiling-lazy",
    .title = "Hierarchical polygon tiling with lazy z-buffering",
    .authors = "N. Greene",
    .year = 1996,
    .source = "N. Greene, Hierarchical Polygon Tiling with Coverage Masks, "
              "SIGGRAPH 1996, 6.1",
    .taxonomy = HSR_IMAGE_SPACE_AREA,
    .sort_order = "Z(XY)Z",
    .coherence = "area coherence; hidden cubes hide all that is in them; faces "
                 "come nearly from front to back",
    .restrictions = HSR_CF,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}, {HSR_FILTERED, HSR_WORDS_OF_64}},
    .sorts = sorts,
    .parts = uses,
    .counters = counters,
    .outline = outline,
    .options = options,
    .prepare = prepare,
    .render = render,
    .release = release,
    .show = show};
