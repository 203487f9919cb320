/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hierarchical polygon tiling of rigid bodies that move by themselves. Each has
 * an octree of BSP trees. The octrees are traversed together, from front to
 * back, and merged where bodies meet.
 *
 * Source      N. Greene, "Hierarchical Polygon Tiling with Coverage Masks",
 *             SIGGRAPH 1996, 6.2.
 * Notation    - body: an instance of an object that moves, laid out in the
 *             world anew in each frame. Its octree is made in the frame, and
 *             only if it is opened or tiled by itself. One more body is all
 *             that does not move; its octree is made once for all frames.
 *             - node: a cube of a body's octree; or a body whose octree is not
 *             made yet.
 *             - region: a part of space between planes across the axes
 *             (clip.h).
 * Method      A region has a list of nodes, of which it has to tile what lies
 *             in it. Nodes that are hidden are culled. Then, of what is left
 *             (tile_region):
 *             - one node: its octree is traversed, as by `tiling`;
 *             - several, and a plane across an axis separates them: the region
 *             is divided by it;
 *             - else, one of them has octants: the region is divided by the
 *             median planes of the largest such cube, whose octants take its
 *             place. A large body whose octree is not made yet counts as such
 *             a cube;
 *             - else all are leaves, or small bodies: they are merged. One BSP
 *             tree is made of all their faces in the region.
 *             The part on the eye's side of a plane is tiled first.
 * Invariants  All of a region is tiled before what it may hide. Polygons of a
 *             cube that a plane crosses are clipped to both sides; a merged
 *             tree takes faces whole, and clips them when it is traversed.
 * Ties        Faces in one plane are on one side of all other planes wherever
 *             they meet, whatever their bodies. So they come into one tree,
 *             where the lower one comes first.
 * Departures  - The paper takes the frontmost cube of all octrees, and clips to
 *             it what meets it. But a cube that meets the frontmost one may
 *             reach in front of it; so here space is divided by planes.
 *             - Cubes are across the axes of the world, not of the body.
 *             - Boxes of what is in a cube are tested, as by `tiling`.
 *             - Memory for trees is taken inside a frame.
 *             - A scene is one body if nothing moves in it, if it has been
 *             adapted, or if not all of its faces are flat.
 * Cost        that of tiling, and of making trees where bodies that move are
 *             visible, or meet others */
#include "algorithms/algorithm.h"
#include "algorithms/engines/bsp/bsp_walk.h"
#include "algorithms/image_space/area/tiling/clip.h"
#include "algorithms/image_space/area/tiling/frame.h"
#include "algorithms/image_space/area/tiling/loose.h"
#include "common/answers/kinds/filtered.h"
#include "common/adapt/adapt.h"
#include "common/trees/octree.h"
#include "common/base/numbers.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LEAF };
/* A body with no more faces than SMALL leaves may have is not opened: if it
 * meets others, it is merged as a whole. */
enum { SMALL = 8 };

enum { REGIONS, TREES, MERGES, MERGED_FACES, PIECES, PIECES_CLIPPED };

/* --- Once for all frames -------------------------------------------------- */

struct prepared {
  struct hsr_sampling sampling; /* must be first: hsr_tiling_prepare */
  bool is_whole;                /* the scene is one body */
  uint32_t *id, n_still;        /* unless whole: the faces that do not move, */
  struct hsr_world still;       /* and a world of these */
  struct hsr_bsp tree;          /* of these; or if whole, of all faces */
  uint32_t *mover, n_movers;    /* the instances that move */
  struct hsr_arena arena;
};

static bool moves(const struct hsr_world *world, uint32_t instance) {
  const struct hsr_scene *scene = world->roster.scene;
  return scene->objects[scene->instances[instance].object].moves;
}

/* Parts the instances that move from the faces that do not. */
static enum hsr_status part(struct prepared *p, const struct hsr_world *world) {
  uint32_t n = world->roster.scene->n_instances;
  p->mover = HSR_NEW(&p->arena, uint32_t, n);
  p->id = HSR_NEW(&p->arena, uint32_t, world->n_faces);
  if (!p->mover || !p->id)
    return HSR_E_NOMEM;
  for (uint32_t i = 0; i < n; i++)
    if (moves(world, i))
      p->mover[p->n_movers++] = i;
    else
      for (uint32_t f = world->roster.first[i]; f < world->roster.first[i + 1];
           f++)
        p->id[p->n_still++] = f;
  return HSR_OK;
}

static bool is_flat(const struct hsr_world *world) {
  for (uint32_t f = 0; f < world->n_faces; f++)
    if (world->mesh.deviation[f] > 0)
      return false;
  return true;
}

/* Makes the octree of what does not move, or of the whole scene. */
static enum hsr_status make_still_tree(struct prepared *p,
                                       const struct hsr_world *world,
                                       const struct hsr_bsp_rule *rule,
                                       struct hsr_error *err) {
  bool roster = hsr_is_roster(world);
  p->is_whole = !roster && (world->pieces || !is_flat(world));
  if (!p->is_whole && part(p, world))
    return hsr_fail_nomem(err);
  if (!roster && !p->n_movers)
    p->is_whole = true;
  if (p->is_whole)
    return hsr_bsp_init(&p->tree, world, rule, err);
  if (p->n_still > HSR_MOST_LAID_OUT)
    return hsr_fail(err, HSR_E_REFUSED,
                    "%u faces that do not move are too many for one octree, "
                    "as it needs",
                    p->n_still);
  enum hsr_status status =
      hsr_world_extract(&p->still, world, p->id, p->n_still, err);
  if (!status && roster)
    status = hsr_check_unadapted(&p->still, "the scene", err);
  return status ? status : hsr_bsp_init(&p->tree, &p->still, rule, err);
}

static void release(void *prepared) {
  struct prepared *p = prepared;
  hsr_sampling_free(&p->sampling);
  hsr_bsp_free(&p->tree);
  hsr_world_free(&p->still);
  hsr_arena_free(&p->arena);
  free(p);
}

static enum hsr_status prepare(const struct hsr_world *world,
                               const long *option, void **prepared,
                               struct hsr_error *err) {
  struct hsr_bsp_rule rule = {.most = (uint32_t)option[LEAF]};
  enum hsr_status status = hsr_tiling_prepare(
      sizeof(struct prepared), HSR_TILING_INTERVALS, prepared, err);
  return status ? status : make_still_tree(*prepared, world, &rule, err);
}

static void show(const void *prepared, struct hsr_shown *shown) {
  const struct prepared *p = prepared;
  shown->bsp = p->is_whole ? &p->tree : NULL;
}

/* --- A frame -------------------------------------------------------------- */

/* A body; or what is merged of several, for as long as it is tiled. */
struct body {
  uint32_t instance; /* HSR_NO_ID: all that does not move, or what is merged */
  uint32_t first, n; /* of an instance: its faces in the scene */
  const struct hsr_bsp *tree; /* NULL: not made yet */
  struct hsr_screen screen; /* of the tree's world, once it is needed to clip */
  bool has_screen;

  /* Of a body that moves, and of what is merged: its tree, and the tree's
   * world. They are made in the frame. */
  struct hsr_world own_world;
  struct hsr_bsp own_tree;
};

/* A cube of a body's octree; or if `cube` is HSR_NO_BSP, a body whose tree is
 * not made yet. */
struct node {
  struct body *body;
  uint32_t cube;
  struct hsr_box box; /* of what is in it; in a region, clipped to that */
};

/* The lower and the upper end of a node's box along an axis. */
struct key {
  double lo, hi;
};

struct frame {
  const struct hsr_job *job;
  const struct prepared *prepared;
  struct hsr_tiling tiling;
  struct hsr_pieces_room room;
  uint32_t most_depth; /* of a tree; room in `waiting` */
  struct hsr_bsp_waiting *waiting;
  struct hsr_loose loose;
  struct hsr_clip clip;

  struct body still, *mover, merged;
  struct hsr_growing stack;    /* struct node: those of a region, upon those of
                                  the regions around it */
  struct hsr_growing gathered; /* uint32_t: faces to be merged */
  struct key *key;             /* room for `most_keys` */
  size_t most_keys;

  /* What is being tiled: the tree of this body in this region. */
  struct body *body;
  const struct hsr_region *region;

  enum hsr_status status; /* the first failure; it ends the frame */
  struct hsr_error *err;
};

static void fail(struct frame *f, enum hsr_status status) {
  if (!f->status)
    f->status = status == HSR_E_NOMEM ? hsr_fail_nomem(f->err) : status;
}

/* Makes room for a tree to be tiled, if there is too little. */
static void make_room(struct frame *f, const struct hsr_bsp *tree) {
  struct hsr_pieces_room room = f->room;
  for (uint32_t k = 0; k < tree->n_cubes; k++) {
    room.points = hsr_max_u32(room.points, tree->cube[k].n_points);
    room.corners = hsr_max_u32(room.corners, tree->cube[k].most_corners);
  }
  for (uint32_t k = 0; k < tree->world->n_faces; k++)
    room.face =
        hsr_max_u32(room.face, hsr_max_u32(hsr_face_size(tree->world, k),
                                           hsr_plane_loop(tree->world, k).n));
  if (!f->waiting || tree->most_depth > f->most_depth) {
    f->most_depth = 2 * tree->most_depth;
    f->waiting = HSR_NEW(f->job->scratch, struct hsr_bsp_waiting,
                         hsr_bsp_most_waiting(f->most_depth));
  }
  if (!f->waiting)
    fail(f, HSR_E_NOMEM);
  if (!memcmp(&room, &f->room, sizeof room))
    return;
  f->room = (struct hsr_pieces_room){2 * room.points, 2 * room.corners,
                                     2 * room.face};
  if (hsr_tiling_room(&f->tiling, f->room))
    fail(f, HSR_E_NOMEM);
}

static enum hsr_status begin(struct frame *f, const struct hsr_job *job,
                             struct hsr_error *err) {
  const struct prepared *p = job->prepared;
  *f = (struct frame){.job = job,
                      .prepared = p,
                      .room = {8, 8, 8},
                      .still = {.instance = HSR_NO_ID, .tree = &p->tree},
                      .err = err};
  if (hsr_tiling_begin(&f->tiling, &p->sampling, job, f->room))
    return hsr_fail_nomem(err);
  make_room(f, &p->tree);
  if (!f->status && p->is_whole &&
      hsr_loose_begin(&f->loose, &p->tree, &f->tiling.view, job->tally,
                      job->scratch))
    fail(f, HSR_E_NOMEM);
  return f->status;
}

/* --- Trees ---------------------------------------------------------------- */

static void free_own(struct body *body) {
  hsr_bsp_free(&body->own_tree);
  hsr_world_free(&body->own_world);
}

/* Makes a body's tree of n faces of the scene. The array of ids is borrowed as
 * long as the tree. leaf == 0: one BSP tree, without an octree. */
static void make_tree(struct frame *f, struct body *body, const uint32_t *id,
                      uint32_t n, long leaf) {
  struct hsr_bsp_rule rule = {.most = (uint32_t)leaf};
  enum hsr_status status =
      hsr_world_extract(&body->own_world, f->job->world, id, n, f->err);
  if (!status)
    status = hsr_bsp_init(&body->own_tree, &body->own_world, &rule, f->err);
  if (status)
    fail(f, status);
  else
    make_room(f, &body->own_tree);
  body->tree = &body->own_tree;
}

/* Makes the octree of a body that moves. */
static void make_body(struct frame *f, struct body *body) {
  uint32_t *id = HSR_NEW(f->job->scratch, uint32_t, body->n);
  HSR_STEP(f->job->tally, TREES, HSR_VOLUME(body->instance), HSR_NOTHING,
           HSR_NOWHERE, 0);
  if (!id) {
    fail(f, HSR_E_NOMEM);
    return;
  }
  for (uint32_t k = 0; k < body->n; k++)
    id[k] = body->first + k;
  make_tree(f, body, id, body->n, f->job->option[LEAF]);
}

/* The id in the scene of a face of a body's world. */
static uint32_t id_of(const struct hsr_world *world, uint32_t face) {
  return world->id ? world->id[face] : face;
}

/* From now on visits of cells are counted for a cube of a body; HSR_NO_BSP: for
 * the whole body. */
static void count_for_cube(struct frame *f, const struct body *body,
                           uint32_t cube) {
  hsr_tiling_whom(&f->tiling, HSR_CELL(cube, body->instance, 0));
}

/* --- Tiling one tree ------------------------------------------------------ */

/* May anything be seen of what is in the box and in the region? */
static bool is_visible(struct frame *f, const struct hsr_region *region,
                       struct hsr_box box) {
  static const double still[3] = {0, 0, 0};
  return hsr_region_clip(region, &box) &&
         hsr_tiling_is_visible(&f->tiling, &box, still, true);
}

static bool enter_cube(void *context, const struct hsr_bsp_cube *cube) {
  struct frame *f = context;
  count_for_cube(f, f->body, (uint32_t)(cube - f->body->tree->cube));
  if (f->status || !is_visible(f, f->region, cube->tight))
    return false;
  if (cube->root != HSR_NO_BSP)
    hsr_pieces_leaf(&f->tiling.pieces, cube);
  return true;
}

/* The planes of a body's faces, for what is clipped. */
static struct hsr_screen *screen_of(struct frame *f) {
  struct body *body = f->body;
  if (!body->has_screen && hsr_screen_init(&body->screen, body->tree->world,
                                           &f->tiling.view, f->job->scratch)) {
    fail(f, HSR_E_NOMEM);
    return NULL;
  }
  body->has_screen = true;
  return &body->screen;
}

static void tile_piece(void *context, const struct hsr_bsp_piece *piece,
                       int facing) {
  struct frame *f = context;
  struct hsr_tiling *t = &f->tiling;
  struct hsr_pieces_view *pieces = &t->pieces;
  if (f->status || (f->loose.is_loose && f->loose.is_loose[piece->face]))
    return;
  if (!hsr_pieces_take(pieces, piece, facing))
    return;
  hsr_pieces_outline(pieces);
  struct hsr_screen *screen = screen_of(f);
  const struct hsr_mask_polygon *polygon =
      screen ? hsr_clip_piece(&f->clip, pieces, screen, f->region) : NULL;
  if (!polygon)
    return;
  uint32_t id = id_of(f->body->tree->world, piece->face);
  struct hsr_subject subject =
      HSR_PIECE(id, (uint32_t)(piece - pieces->bsp->piece));
  struct hsr_window window = hsr_window_make(pieces->box.x0, pieces->box.y0,
                                             pieces->box.x1, pieces->box.y1);
  HSR_STEP(f->job->tally, PIECES, subject, HSR_THE_WINDOW, window, 0);
  if (polygon != &pieces->polygon)
    HSR_STEP(f->job->tally, PIECES_CLIPPED, subject, HSR_THE_WINDOW, window, 0);
  hsr_tiling_whom(t, HSR_FACE(id));
  hsr_canvas_face(&t->canvas, id);
  hsr_masks_tile(&t->masks, polygon, pieces->box, &t->sink);
}

/* Tiles what is in a region of a body's tree, from a cube on. */
static void tile_tree(struct frame *f, struct body *body, uint32_t cube,
                      const struct hsr_region *region) {
  static const double still[3] = {0, 0, 0};
  struct hsr_bsp_walk walk = {.bsp = body->tree,
                              .view = &f->tiling.view,
                              .shift = still,
                              .tally = f->job->tally,
                              .waiting = f->waiting,
                              .context = f,
                              .enter = enter_cube,
                              .piece = tile_piece};
  if (f->status)
    return;
  f->body = body;
  f->region = region;
  hsr_pieces_tree(&f->tiling.pieces, body->tree, still);
  hsr_bsp_walk_cube(&walk, cube);
}

/* --- Merging -------------------------------------------------------------- */

struct gathering {
  struct frame *frame;
  const struct hsr_region *region;
};

static void add_vertex(struct hsr_box *box, const struct hsr_object *object,
                       uint32_t vertex, const double m[12]) {
  double at[3];
  hsr_instance_vertex(m, object->xyz + 3 * (size_t)vertex, at);
  for (int k = 0; k < 3; k++) {
    box->lo[k] = fmin(box->lo[k], at[k]);
    box->hi[k] = fmax(box->hi[k], at[k]);
  }
}

/* The box around face `id` of the scene, without rounding. */
static struct hsr_box box_of_face(const struct hsr_world *world, uint32_t id) {
  struct hsr_place place = hsr_place_of(world, id);
  const struct hsr_object *object = place.object;
  struct hsr_box box = {{INFINITY, INFINITY, INFINITY},
                        {-INFINITY, -INFINITY, -INFINITY}};
  for (uint32_t c = object->start[place.face];
       c < object->start[place.face + 1]; c++)
    add_vertex(&box, object, object->vertex[c],
               world->roster.scene->instances[place.instance].m);
  return box;
}

/* Adds a face of the scene to those gathered, if its box meets the region. */
static void gather_face(struct gathering *g, uint32_t id) {
  struct hsr_box box = box_of_face(g->frame->job->world, id);
  if (!hsr_region_clip(g->region, &box))
    return;
  struct hsr_growing *ids = &g->frame->gathered;
  if (hsr_arena_grow(g->frame->job->scratch, ids, sizeof id))
    ((uint32_t *)ids->items)[ids->n - 1] = id;
  else
    fail(g->frame, HSR_E_NOMEM);
}

static void gather_tree(struct gathering *g, const struct hsr_bsp *tree,
                        uint32_t number) {
  if (number == HSR_NO_BSP || g->frame->status)
    return;
  const struct hsr_bsp_node *node = &tree->node[number];
  for (uint32_t k = 0; k < node->n_pieces; k++)
    gather_face(g, tree->world->id[tree->piece[node->first_piece + k].face]);
  gather_tree(g, tree, node->front);
  gather_tree(g, tree, node->behind);
}

static int compare_ids(const void *a, const void *b) {
  uint32_t f = *(const uint32_t *)a, g = *(const uint32_t *)b;
  return (f > g) - (f < g);
}

static void gather_node(struct gathering *g, const struct node *node) {
  const struct body *body = node->body;
  if (node->cube != HSR_NO_BSP) {
    gather_tree(g, body->tree, body->tree->cube[node->cube].root);
    return;
  }
  for (uint32_t k = 0; k < body->n; k++)
    gather_face(g, body->first + k);
}

/* Sorts ids, leaves out repeated ones, and returns how many are left. */
static uint32_t sort_ids(uint32_t *id, size_t n) {
  uint32_t different = 0;
  qsort(id, n, sizeof *id, compare_ids);
  for (size_t k = 0; k < n; k++)
    if (!k || id[k] != id[k - 1])
      id[different++] = id[k];
  return different;
}

static void tile_alone(struct frame *f, const struct hsr_region *region,
                       const struct node *node);

/* Tiles one BSP tree of all faces in the region that are in these leaves and
 * bodies. If only one of them has any, that is tiled alone. */
static void merge(struct frame *f, const struct hsr_region *region,
                  const struct node *node, size_t n) {
  struct gathering g = {f, region};
  size_t some = 0, last = 0;
  f->gathered.n = 0;
  for (size_t k = 0; k < n; k++) {
    size_t before = f->gathered.n;
    gather_node(&g, &node[k]);
    if (f->gathered.n > before) {
      some++;
      last = k;
    }
  }
  if (f->status || !some)
    return;
  if (some == 1) {
    tile_alone(f, region, &node[last]);
    return;
  }
  uint32_t *id = f->gathered.items;
  uint32_t faces = sort_ids(id, f->gathered.n);
  HSR_STEP(f->job->tally, MERGES, HSR_NOTHING, HSR_NOTHING, HSR_NOWHERE, 0);
  for (uint32_t k = 0; HSR_COUNTING && k < faces; k++)
    HSR_STEP(f->job->tally, MERGED_FACES, HSR_FACE(id[k]), HSR_NOTHING,
             HSR_NOWHERE, 0);
  f->merged = (struct body){.instance = HSR_NO_ID};
  make_tree(f, &f->merged, id, faces, 0);
  tile_tree(f, &f->merged, 0, region);
  free_own(&f->merged);
}

/* --- Regions, from front to back ------------------------------------------ */

static int compare_keys(const void *a, const void *b) {
  double k = ((const struct key *)a)->lo, l = ((const struct key *)b)->lo;
  return (k > l) - (k < l);
}

/* Of the planes across an axis that cross no node's box, finds the one that
 * divides the nodes most evenly: its coordinate *at. Returns how many nodes are
 * on its lesser side. If that is not more than `least`, *at is left alone, and
 * `least` is returned. */
static size_t find_plane_across(const struct node *node, size_t n, int axis,
                                size_t least, struct key *key, double *at) {
  double reach = -INFINITY;
  for (size_t k = 0; k < n; k++)
    key[k] = (struct key){node[k].box.lo[axis], node[k].box.hi[axis]};
  qsort(key, n, sizeof *key, compare_keys);
  for (size_t k = 0; k + 1 < n; k++) {
    size_t lesser = k + 1 < n - k - 1 ? k + 1 : n - k - 1;
    reach = fmax(reach, key[k].hi);
    if (reach < key[k + 1].lo && lesser > least) {
      least = lesser;
      *at = reach;
    }
  }
  return least;
}

static bool find_plane(struct frame *f, const struct node *node, size_t n,
                       int *axis, double *at) {
  size_t most = 0;
  if (n > f->most_keys) {
    f->most_keys = 2 * n;
    f->key = HSR_NEW(f->job->scratch, struct key, f->most_keys);
  }
  if (!f->key) {
    fail(f, HSR_E_NOMEM);
    return false;
  }
  for (int k = 0; k < 3; k++) {
    size_t lesser = find_plane_across(node, n, k, most, f->key, at);
    if (lesser > most) {
      most = lesser;
      *axis = k;
    }
  }
  return most;
}

/* What is done with a region, as the head says: its one node is tiled, or a
 * plane divides it, or the octants of a cube do, or all its nodes are
 * merged. */
enum choice { ALONE, SEPARATED, OPENED, MERGED };

static void tile_region(struct frame *f, const struct hsr_region *region,
                        const struct node *node, size_t n);

/* Tiles the parts of a region on both sides of a plane, the eye's side
 * first. */
static void tile_sides(struct frame *f, const struct hsr_region *region,
                       const struct node *node, size_t n, int axis, double at) {
  bool eye_above = f->tiling.view.eye[axis] > at;
  for (int side = 0; side < 2; side++) {
    struct hsr_region part = *region;
    if (eye_above == (side == 0))
      part.above[axis] = at;
    else
      part.below[axis] = at;
    tile_region(f, &part, node, n);
  }
}

/* Has a node octants, or may it have them when its tree is made? */
static bool is_openable(const struct frame *f, const struct node *node) {
  if (node->cube == HSR_NO_BSP)
    return (long)node->body->n > SMALL * f->job->option[LEAF];
  return node->body->tree->cube[node->cube].root == HSR_NO_BSP;
}

/* The largest node that can be opened; n: there is none. */
static size_t find_openable(const struct frame *f, const struct node *node,
                            size_t n) {
  size_t best = n;
  double largest = -1;
  for (size_t k = 0; k < n; k++) {
    const struct hsr_box *box = &node[k].box;
    double size = box->hi[0] - box->lo[0] + box->hi[1] - box->lo[1] +
                  box->hi[2] - box->lo[2];
    if (size > largest && is_openable(f, &node[k])) {
      largest = size;
      best = k;
    }
  }
  return best;
}

static struct node root_of(struct body *body) {
  struct node node = {body, 0, body->tree->cube[0].tight};
  return node;
}

/* Divides a region by the median planes of the last node's cube, and tiles the
 * eight parts from front to back. In each the octant takes the cube's place. */
static void open_cube(struct frame *f, const struct hsr_region *region,
                      struct node *node, size_t n) {
  struct body *body = node[n - 1].body;
  const struct hsr_bsp_cube *cube = &body->tree->cube[node[n - 1].cube];
  unsigned nearest = 0;
  for (int k = 0; k < 3; k++)
    nearest |= (unsigned)(f->tiling.view.eye[k] > cube->centre[k]) << k;
  for (int o = 0; o < 8; o++) {
    unsigned octant = nearest ^ hsr_octant_order[o];
    uint32_t child = cube->child[octant];
    struct hsr_region part = *region;
    size_t others = n - 1;
    for (int k = 0; k < 3; k++)
      if (octant >> k & 1)
        part.above[k] = hsr_max(part.above[k], cube->centre[k]);
      else
        part.below[k] = hsr_min(part.below[k], cube->centre[k]);
    if (child != HSR_NO_BSP)
      node[others++] =
          (struct node){body, child, body->tree->cube[child].tight};
    tile_region(f, &part, node, others);
  }
}

/* Opens node k: a cube, or a body whose tree is made now. */
static void open_node(struct frame *f, const struct hsr_region *region,
                      struct node *node, size_t n, size_t k) {
  struct node opened = node[k];
  node[k] = node[n - 1];
  node[n - 1] = opened;
  if (opened.cube != HSR_NO_BSP) {
    open_cube(f, region, node, n);
    return;
  }
  if (!opened.body->tree)
    make_body(f, opened.body);
  if (!f->status) {
    node[n - 1] = root_of(opened.body);
    tile_region(f, region, node, n);
  }
}

/* Tiles a node that is the only one in a region. */
static void tile_alone(struct frame *f, const struct hsr_region *region,
                       const struct node *node) {
  if (!node->body->tree)
    make_body(f, node->body);
  tile_tree(f, node->body, node->cube == HSR_NO_BSP ? 0 : node->cube, region);
}

static bool is_visible_in(struct frame *f, const struct hsr_region *region,
                          const struct node *node) {
  count_for_cube(f, node->body, node->cube);
  return is_visible(f, region, node->box);
}

/* Puts those nodes on the stack that may be seen in a region, with their boxes
 * clipped to it. Returns how many; *node is the first. *node stays valid when
 * the stack grows and moves, since the arena keeps the old copy. */
static size_t look_at(struct frame *f, const struct hsr_region *region,
                      const struct node *all, size_t n_all,
                      struct node **node) {
  size_t first = f->stack.n;
  for (size_t k = 0; k < n_all && !f->status; k++) {
    if (!is_visible_in(f, region, &all[k]))
      continue;
    if (!hsr_arena_grow(f->job->scratch, &f->stack, sizeof **node)) {
      fail(f, HSR_E_NOMEM);
      break;
    }
    struct node *put = (struct node *)f->stack.items + f->stack.n - 1;
    *put = all[k];
    hsr_region_clip(region, &put->box);
  }
  if (f->status || f->stack.n == first)
    return 0;
  *node = (struct node *)f->stack.items + first;
  return f->stack.n - first;
}

/* Tiles all that the nodes have in a region: see Method, in the head. */
static void tile_region(struct frame *f, const struct hsr_region *region,
                        const struct node *all, size_t n_all) {
  struct node *node = NULL;
  size_t first = f->stack.n;
  size_t n = look_at(f, region, all, n_all, &node), openable = n;
  int axis = 0;
  double at = 0;
  if (!n)
    return;
  enum choice choice = n == 1                                       ? ALONE
                       : find_plane(f, node, n, &axis, &at)         ? SEPARATED
                       : (openable = find_openable(f, node, n)) < n ? OPENED
                                                                    : MERGED;
  HSR_STEP(f->job->tally, REGIONS,
           HSR_CELL(node[0].cube, node[0].body->instance, 0), HSR_NOTHING,
           HSR_NOWHERE, choice);
  if (choice == ALONE)
    tile_alone(f, region, node);
  else if (choice == SEPARATED)
    tile_sides(f, region, node, n, axis, at);
  else if (choice == OPENED)
    open_node(f, region, node, n, openable);
  else
    merge(f, region, node, n);
  f->stack.n = first;
}

/* --- The picture ---------------------------------------------------------- */

/* The box around an instance, without rounding. */
static struct hsr_box box_of_instance(const struct hsr_scene *scene,
                                      uint32_t instance) {
  const struct hsr_instance *of = &scene->instances[instance];
  const struct hsr_object *object = &scene->objects[of->object];
  struct hsr_box box = {{INFINITY, INFINITY, INFINITY},
                        {-INFINITY, -INFINITY, -INFINITY}};
  for (uint32_t v = 0; v < object->n_vertices; v++)
    add_vertex(&box, object, v, of->m);
  return box;
}

/* Tiles all bodies, in a region that is all of space. */
static void tile_bodies(struct frame *f) {
  const struct prepared *p = f->prepared;
  const struct hsr_world *world = f->job->world;
  struct hsr_region all = {{-INFINITY, -INFINITY, -INFINITY},
                           {INFINITY, INFINITY, INFINITY}};
  struct node *node =
      HSR_NEW(f->job->scratch, struct node, (size_t)p->n_movers + 1);
  f->mover = HSR_NEW_ZEROED(f->job->scratch, struct body, p->n_movers);
  size_t n = 0;
  if (!node || !f->mover) {
    fail(f, HSR_E_NOMEM);
    return;
  }
  if (p->tree.n_pieces)
    node[n++] = root_of(&f->still);
  for (uint32_t k = 0; k < p->n_movers; k++) {
    uint32_t i = p->mover[k];
    f->mover[k].instance = i;
    f->mover[k].first = world->roster.first[i];
    f->mover[k].n = world->roster.first[i + 1] - world->roster.first[i];
    node[n++] = (struct node){&f->mover[k], HSR_NO_BSP,
                              box_of_instance(world->roster.scene, i)};
  }
  tile_region(f, &all, node, n);
  for (uint32_t k = 0; k < p->n_movers; k++)
    free_own(&f->mover[k]);
}

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct frame f;
  if (begin(&f, job, err))
    return f.status ? f.status : HSR_E_NOMEM;
  if (f.loose.n && f.tiling.filtering.filter)
    return hsr_loose_refuse(&f.loose, job->world, err);
  tile_bodies(&f);
  if (f.status)
    return f.status;
  hsr_tiling_background(&f.tiling);
  hsr_loose_draw(&f.loose, job->answer->ids, (size_t)job->answer->m);
  return HSR_OK;
}

/* --- The descriptor ------------------------------------------------------- */

static const struct hsr_option options[] = {
    [LEAF] = {.name = "leaf",
              .meaning = "the most faces that an octree's leaf has",
              .least = 1,
              .most = 1000,
              .standard = 30},
    {.name = NULL}};

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {
    {&hsr_tiling_part}, {&hsr_loose_part}, {NULL}};

static const struct hsr_counter counters[] = {
    [REGIONS] = {"regions",
                 "of space, with cubes that may be visible; the first of them",
                 HSR_SUBDIVIDE, HSR_OF_CELL, HSR_OF_NOTHING,
                 "of one cube|separated by a plane|a cube opened|merged"},
    [TREES] = {"trees", "made of bodies that move", HSR_SORT, HSR_OF_VOLUME,
               HSR_OF_NOTHING},
    [MERGES] = {"merges", "trees made of leaves of several bodies", HSR_SORT,
                HSR_OF_NOTHING, HSR_OF_NOTHING},
    [MERGED_FACES] = {"merged faces", "in these", HSR_SORT, HSR_OF_FACE,
                      HSR_OF_NOTHING},
    [PIECES] = {"pieces",
                "pieces of faces in visible cubes, with a sample in their box",
                HSR_ACTIVATE, HSR_OF_PIECE, HSR_OF_WINDOW, .key = "piece"},
    [PIECES_CLIPPED] = {"pieces clipped", "of these, to a region", HSR_SPLIT,
                        HSR_OF_PIECE, HSR_OF_WINDOW},
    {NULL}};

static const struct hsr_line outline[] = {
    {"for each region of space, from front to back: merge all octrees in it",
     HSR_RAISES(REGIONS)},
    {"  if a body that moves is to be opened: make its octree of BSP trees",
     HSR_RAISES(TREES)},
    {"  if leaves of several bodies meet: merge them into one BSP tree",
     HSR_RAISES(MERGES)},
    {"    insert a face of theirs", HSR_RAISES(MERGED_FACES)},
    {"", .part = &hsr_tiling_part},
    {"  for each polygon of a leaf's BSP tree, from front to back",
     HSR_RAISES(PIECES)},
    {"    clip it to the region", HSR_RAISES(PIECES_CLIPPED)},
    {"", .part = &hsr_tiling_part, .group = HSR_CELL_LINES},
    {"", .part = &hsr_tiling_part, .group = HSR_SAMPLE_LINES},
    {"display the background in what is vacant"},
    {"", .part = &hsr_loose_part},
    {NULL}};

static const struct hsr_sort sorts[] = {
    {"faces", "priority", "BSP trees", "once for all frames"},
    {"faces that move", "priority", "BSP trees", "once a frame"},
    {"cubes", "distance", "octrees together, from front to back",
     "once a frame"},
    {"faces", "X and Y", "mask pyramid", "a polygon"},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(tiling_merged) = {
    .name = "tiling-merged",
    .title = "Hierarchical polygon tiling of merged octrees",
    .authors = "N. Greene",
    .year = 1996,
    .source = "N. Greene, Hierarchical Polygon Tiling with Coverage Masks, "
              "SIGGRAPH 1996, 6.2",
    .taxonomy = HSR_IMAGE_SPACE_AREA,
    .sort_order = "Z(XY)",
    .coherence = "area coherence; hidden cubes hide all that is in them; few "
                 "bodies move, and fewer meet",
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
