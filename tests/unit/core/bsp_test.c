/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Octrees of BSP trees, sample by sample. A sample that a face covers is in one
 * of its pieces. From front to back, the first piece that a sample is in is of
 * the face that the oracle sees. The exact predicates decide both, and also the
 * eye's side of every plane. Then bsp_walk must go in that order, wherever the
 * trees are moved to. */
#include "bench/modules/modules.h"
#include "algorithms/engines/bsp/bsp_walk.h"
#include "common/exact/predicates.h"
#include "common/trees/bsp.h"
#include "common/trees/octree.h"
#include "common/exact/order.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { M = 61, N = 43, VIEWS = 4 };

/* A long quadrilateral whose corners are rounded, so that it is not flat, and 60
 * narrow ones that pierce it. A tree that begins with one of those cuts it too
 * often, so it is loose; one that begins with it does not. */
static const char PIERCED[] = "pierced-sheet";

struct fixture {
  const char *name;
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_algorithm convex; /* demands convex faces */
  struct hsr_setup setup;      /* for it */
  struct hsr_bsp bsp;
  bool out_of_memory;

  struct hsr_view view;
  double shift[3]; /* by which the trees are moved */
  struct hsr_screen screen;
  struct hsr_arena arena;
  struct hsr_tally tally;
  uint32_t seen[M * N]; /* by the oracle */
  uint32_t *order;      /* pieces front to back */
  uint32_t n_ordered;
  bool *is_loose;  /* of a face: it has no place in the trees */
  uint32_t *times; /* of a face: its pieces that a sample is in */
};

/* --- The form of the trees ------------------------------------------------ */

/* Three points on a median plane; their order says which side is its front. */
struct median_loop {
  double x[3], y[3], z[3];
};

static struct hsr_loop median_loop(const struct hsr_bsp_median *median,
                                   struct median_loop *room) {
  static const uint32_t vertex[] = {0, 1, 2};
  double *c[3] = {room->x, room->y, room->z};
  for (int k = 0; k < 3; k++) {
    c[median->axis][k] = median->at;
    c[(median->axis + 1) % 3][k] = k == 1;
    c[(median->axis + 2) % 3][k] = k == 2;
  }
  return (struct hsr_loop){room->x, room->y, room->z, 1, vertex, 3};
}

static struct hsr_loop plane_loop(const struct fixture *x, uint32_t plane,
                                  struct median_loop *room) {
  const struct hsr_world *world = x->setup.world;
  return plane < world->mesh.n_planes
             ? hsr_plane_loop(world, x->bsp.face_of[plane])
             : median_loop(&x->bsp.median[plane - world->mesh.n_planes], room);
}

static bool is_edge(const struct hsr_world *world, uint32_t f, uint32_t a,
                    uint32_t b) {
  uint32_t n = hsr_face_size(world, f);
  const uint32_t *vertex = world->mesh.vertex + world->mesh.start[f];
  for (uint32_t k = 0; k < n; k++)
    if (vertex[k] == a && vertex[(k + 1) % n] == b)
      return true;
  return false;
}

static bool good_side(const struct fixture *x, uint32_t f,
                      const struct hsr_bsp_corner *side) {
  if (side->b == HSR_BSP_FRONT || side->b == HSR_BSP_BEHIND)
    return side->a < x->setup.world->mesh.n_planes + x->bsp.n_medians;
  return is_edge(x->setup.world, f, side->a, side->b);
}

/* A piece of a leaf: the leaf holds its points, and its sides are those of the
 * face, or cuts. */
static bool good_piece(const struct fixture *x, const struct hsr_bsp_cube *leaf,
                       const struct hsr_bsp_piece *piece) {
  const struct hsr_bsp *bsp = &x->bsp;
  const struct hsr_bsp_corner *corner = bsp->corner + piece->first_corner;
  bool is_flat = x->setup.world->mesh.deviation[piece->face] == 0,
       is_cut = false;
  bool good = piece->n_corners >= 3 && piece->n_corners <= leaf->most_corners;
  for (uint32_t k = 0; k < piece->n_corners; k++) {
    good &= corner[k].point - leaf->first_point < leaf->n_points;
    good &= good_side(x, piece->face, &corner[k]);
    is_cut |= corner[k].b >= HSR_BSP_BEHIND;
  }
  for (uint32_t k = 0; k < piece->n_cuts; k++)
    good &= bsp->cut[piece->first_cut + k].b >= HSR_BSP_BEHIND &&
            good_side(x, piece->face, &bsp->cut[piece->first_cut + k]);
  return good && (is_flat ? !piece->n_cuts : !is_cut);
}

/* What was found in the leaves. */
struct census {
  bool good;
  bool *found;                /* of each piece */
  uint32_t *last_in;          /* of each face: its last leaf, + 1 */
  uint32_t leaf;              /* the current one, + 1 */
  uint32_t n_pieces, n_faces; /* of the current leaf */
};

/* A node's pieces lie in its plane, ordered by faces. */
static void check_node(const struct fixture *x, const struct hsr_bsp_node *node,
                       struct census *c) {
  const struct hsr_world *world = x->setup.world;
  const struct hsr_bsp_cube *leaf = &x->bsp.cube[c->leaf - 1];
  const struct hsr_bsp_piece *piece = x->bsp.piece + node->first_piece;
  c->good &= node->n_pieces > 0;
  for (uint32_t k = 0; k < node->n_pieces; k++) {
    uint32_t f = piece[k].face;
    c->good &= world->mesh.plane[f] == node->plane;
    c->good &= !k || piece[k - 1].face <= f;
    c->good &= good_piece(x, leaf, &piece[k]);
    c->good &= !c->found[node->first_piece + k];
    c->found[node->first_piece + k] = true;
    c->n_pieces++;
    c->n_faces += c->last_in[f] != c->leaf;
    c->last_in[f] = c->leaf;
  }
}

static void check_tree(const struct fixture *x, uint32_t root, uint32_t depth,
                       struct census *c) {
  if (root == HSR_NO_BSP)
    return;
  const struct hsr_bsp_node *node = &x->bsp.node[root];
  check_node(x, node, c);
  c->good &= depth <= x->bsp.most_depth;
  check_tree(x, node->front, depth + 1, c);
  check_tree(x, node->behind, depth + 1, c);
}

static bool is_vertex(const struct hsr_world *world, const bool *used,
                      const double p[3]) {
  for (uint32_t v = 0; v < world->mesh.n_vertices; v++)
    if (used[v] && world->mesh.x[v] == p[0] && world->mesh.y[v] == p[1] &&
        world->mesh.z[v] == p[2])
      return true;
  return false;
}

/* A leaf's points lie in its box within their error, or outside its cube. No
 * two are equal. Those without error are vertices. */
static bool good_points(const struct fixture *x,
                        const struct hsr_bsp_cube *leaf, const bool *used) {
  const struct hsr_bsp *bsp = &x->bsp;
  bool good = true;
  for (uint32_t k = 0; k < leaf->n_points; k++) {
    uint32_t p = leaf->first_point + k;
    double at[3] = {bsp->x[p], bsp->y[p], bsp->z[p]}, error = bsp->error[p];
    for (int c = 0; c < 3; c++) {
      double lo = leaf->centre[c] - leaf->half,
             hi = leaf->centre[c] + leaf->half;
      good &= leaf->tight.lo[c] >= lo && leaf->tight.hi[c] <= hi;
      good &= leaf->tight.lo[c] <= fmax(lo, at[c] - error);
      good &= leaf->tight.hi[c] >= fmin(hi, at[c] + error);
    }
    good &= error >= 0 && (error > 0 || is_vertex(x->setup.world, used, at));
    good &= !k || at[0] != bsp->x[p - 1] || at[1] != bsp->y[p - 1] ||
            at[2] != bsp->z[p - 1] || error != bsp->error[p - 1];
  }
  return good;
}

static bool good_child(const struct hsr_bsp *bsp, uint32_t parent, int octant) {
  const struct hsr_bsp_cube *cube = &bsp->cube[parent];
  uint32_t number = cube->child[octant];
  const struct hsr_bsp_cube *child = &bsp->cube[number];
  bool good = number > parent && child->half == cube->half / 2;
  for (int c = 0; c < 3 && good; c++) {
    double off = child->centre[c] - cube->centre[c];
    good = off == (octant >> c & 1 ? child->half : -child->half) &&
           cube->tight.lo[c] <= child->tight.lo[c] &&
           child->tight.hi[c] <= cube->tight.hi[c];
  }
  return good;
}

/* Counts the leaves, and those with more faces than `most`. */
static void check_cube(const struct fixture *x, uint32_t number, uint32_t most,
                       uint32_t *n_leaves, uint32_t *n_large,
                       struct census *c) {
  const struct hsr_bsp_cube *cube = &x->bsp.cube[number];
  bool is_leaf = true;
  for (int o = 0; o < 8; o++)
    if (cube->child[o] != HSR_NO_BSP) {
      is_leaf = false;
      c->good &= good_child(&x->bsp, number, o);
    }
  c->good &= is_leaf || cube->root == HSR_NO_BSP;
  c->leaf = number + 1;
  c->n_faces = 0;
  check_tree(x, cube->root, 1, c);
  *n_leaves += is_leaf;
  *n_large += most && c->n_faces > most;
}

/* Whether all leaves of a scene can be divided down to `most` faces. */
static bool divides(const char *name, uint32_t most) {
  return strcmp(name, "color-cube:3") == 0 || strcmp(name, "t-junction") == 0 ||
         (strcmp(name, "house") == 0 && most == 30) ||
         (strcmp(name, "shared-edges") == 0 && most == 30);
}

static void check_form(struct tap *tap, struct fixture *x, uint32_t most) {
  const struct hsr_world *world = x->setup.world;
  const struct hsr_bsp *bsp = &x->bsp;
  struct census c = {true,
                     calloc(bsp->n_pieces + (size_t)1, sizeof *c.found),
                     calloc(world->n_faces + (size_t)1, sizeof *c.last_in),
                     0,
                     0,
                     0};
  bool *used = calloc(world->mesh.n_vertices + (size_t)1, sizeof *used);
  uint32_t n_leaves = 0, n_large = 0;
  for (uint32_t k = 0; k < world->mesh.n_corners; k++)
    used[world->mesh.vertex[k]] = true;
  for (uint32_t k = 0; k < bsp->n_cubes; k++) {
    check_cube(x, k, most, &n_leaves, &n_large, &c);
    c.good &= good_points(x, &bsp->cube[k], used);
  }
  c.good &= c.n_pieces == bsp->n_pieces;
  c.good &= c.n_pieces >= world->n_faces - bsp->n_loose;
  c.good &= most || (n_leaves == 1 && bsp->n_medians == 0);
  c.good &= !n_large || !divides(x->name, most);
  if (strcmp(x->name, PIERCED) == 0)
    c.good &= most ? bsp->n_loose == 1 && bsp->loose[0] == 0 : !bsp->n_loose;
  ok(tap, c.good,
     "%s, %u: %u pieces of %u faces, %u leaves (%u large), depth %u, %u loose",
     x->name, most, bsp->n_pieces, world->n_faces, n_leaves, n_large,
     bsp->most_depth, bsp->n_loose);
  free(c.found);
  free(c.last_in);
  free(used);
}

/* --- What a sample is in -------------------------------------------------- */

static bool within(struct fixture *x, uint32_t f,
                   const struct hsr_bsp_corner *side, int i, int j) {
  struct median_loop room;
  if (side->b < HSR_BSP_BEHIND)
    return true; /* the face covers the sample */
  return hsr_exact_cut_side(&x->view, hsr_plane_loop(x->setup.world, f),
                            plane_loop(x, side->a, &room),
                            hsr_sample_x(&x->view, i),
                            hsr_sample_y(&x->view, j), &x->out_of_memory) ==
         (side->b == HSR_BSP_FRONT ? 1 : -1);
}

static bool holds(struct fixture *x, const struct hsr_bsp_piece *piece, int i,
                  int j) {
  const struct hsr_bsp_corner *corner = x->bsp.corner + piece->first_corner;
  const struct hsr_bsp_corner *cut = x->bsp.cut + piece->first_cut;
  for (uint32_t k = 0; k < piece->n_corners; k++)
    if (!within(x, piece->face, &corner[k], i, j))
      return false;
  for (uint32_t k = 0; k < piece->n_cuts; k++)
    if (!within(x, piece->face, &cut[k], i, j))
      return false;
  return true;
}

/* --- Front to back -------------------------------------------------------- */

static int eye_side(struct fixture *x, struct hsr_loop plane) {
  return hsr_exact_moved_plane_side(plane, x->shift, x->view.E,
                                    &x->out_of_memory);
}

static void order_tree(struct fixture *x, uint32_t root) {
  if (root == HSR_NO_BSP)
    return;
  const struct hsr_bsp_node *node = &x->bsp.node[root];
  struct median_loop room;
  int side = eye_side(x, plane_loop(x, node->plane, &room));
  order_tree(x, side > 0 ? node->front : node->behind);
  for (uint32_t k = 0; k < node->n_pieces; k++)
    x->order[x->n_ordered++] = node->first_piece + k;
  order_tree(x, side > 0 ? node->behind : node->front);
}

static void order_cube(struct fixture *x, uint32_t number) {
  const struct hsr_bsp_cube *cube = &x->bsp.cube[number];
  int nearest = 0;
  for (int c = 0; c < 3; c++) {
    struct median_loop room;
    const struct hsr_bsp_median median = {c, cube->centre[c]};
    nearest |= (eye_side(x, median_loop(&median, &room)) > 0) << c;
  }
  order_tree(x, cube->root);
  for (int k = 0; k < 8; k++) {
    uint32_t child = cube->child[nearest ^ hsr_octant_order[k]];
    if (child != HSR_NO_BSP)
      order_cube(x, child);
  }
}

/* --- The samples of a view ------------------------------------------------ */

/* Sets times[] to 1 for the faces that cover the sample. Returns how many. */
static long cover(struct fixture *x, int i, int j) {
  long n = 0;
  memset(x->times, 0, x->setup.world->n_faces * sizeof *x->times);
  for (uint32_t r = 0; r < x->screen.n_relevant; r++) {
    uint32_t f = x->screen.relevant[r];
    const struct hsr_bounds *b = &x->screen.bounds[f];
    if (i >= b->x0 && i < b->x1 && j >= b->y0 && j < b->y1 &&
        hsr_covers(&x->screen, f, i, j, &x->tally)) {
      x->times[f] = 1;
      n++;
    }
  }
  return n;
}

/* The visible one of two faces that cover the sample. */
static uint32_t nearer(struct fixture *x, uint32_t f, uint32_t g, int i,
                       int j) {
  if (f == HSR_NO_FACE || g == HSR_NO_FACE)
    return f == HSR_NO_FACE ? g : f;
  return f != g && hsr_nearer(&x->screen, g, f, i, j, &x->tally) ? g : f;
}

/* Counts in *twice the faces in whose pieces a sample is not exactly once, and
 * in *wrong the samples whose first piece is not of the visible face. Faces
 * that have no place in the trees are compared with that face in depth. */
static void check_sample(struct fixture *x, int i, int j, long *covered,
                         long *twice, long *wrong) {
  uint32_t first = HSR_NO_FACE, n = x->setup.world->n_faces;
  *covered += cover(x, i, j);
  for (uint32_t k = 0; k < x->n_ordered; k++) {
    const struct hsr_bsp_piece *piece = &x->bsp.piece[x->order[k]];
    uint32_t f = piece->face;
    if (!x->times[f] || !holds(x, piece, i, j))
      continue;
    if (first == HSR_NO_FACE && !x->is_loose[f])
      first = f;
    x->times[f]++;
  }
  for (uint32_t k = 0; k < x->bsp.n_loose; k++)
    x->times[x->bsp.loose[k]] *= 2;
  for (uint32_t f = 0; f < n; f++) {
    *twice += x->times[f] == 1 || x->times[f] > 2;
    if (x->times[f] && x->is_loose[f])
      first = nearer(x, first, f, i, j);
  }
  if (first != HSR_NO_FACE)
    first = hsr_world_parent(x->setup.world, first);
  *wrong += first != x->seen[j * M + i];
}

/* Finds the faces that have no place in the trees; counts those that have one
 * in other views. */
static void find_loose(struct fixture *x, long *grazed) {
  for (uint32_t r = 0; r < x->screen.n_relevant; r++) {
    uint32_t f = x->screen.relevant[r];
    x->is_loose[f] = hsr_grazes(&x->screen, f, x->bsp.reach[f]);
    *grazed += x->is_loose[f];
  }
  for (uint32_t k = 0; k < x->bsp.n_loose; k++)
    x->is_loose[x->bsp.loose[k]] = true;
}

static void check_view(struct fixture *x, uint32_t v, long *grazed,
                       long *covered, long *twice, long *wrong) {
  struct hsr_error err = {.text = "out of memory"};
  must_view(&x->view, &x->scene->views[v], M, N);
  hsr_arena_reset(&x->arena);
  x->order = HSR_NEW(&x->arena, uint32_t, x->bsp.n_pieces);
  x->times = HSR_NEW(&x->arena, uint32_t, x->setup.world->n_faces);
  x->is_loose = HSR_NEW_ZEROED(&x->arena, bool, x->setup.world->n_faces);
  if (!x->order || !x->times || !x->is_loose ||
      hsr_screen_make(&x->screen, x->setup.world, &x->view, &x->arena,
                      &x->tally))
    bail("%s", err.text);
  find_loose(x, grazed);
  draw_plain("oracle", &x->world, &x->view, x->seen);
  x->n_ordered = 0;
  order_cube(x, 0);
  for (int j = 0; j < N; j++)
    for (int i = 0; i < M; i++)
      check_sample(x, i, j, covered, twice, wrong);
}

static void check_samples(struct tap *tap, struct fixture *x, uint32_t most) {
  long grazed = 0, covered = 0, twice = 0, wrong = 0;
  uint32_t n = x->scene->n_views;
  memset(x->shift, 0, sizeof x->shift);
  for (uint32_t k = 0; k < VIEWS && k < n; k++)
    check_view(x, n > VIEWS ? k * (n - 1) / (VIEWS - 1) : k, &grazed, &covered,
               &twice, &wrong);
  ok(tap, covered && !twice && !x->out_of_memory,
     "%s, %u: a sample of a face is in one piece (%ld of %ld not)", x->name,
     most, twice, covered);
  ok(tap, covered && !wrong,
     "%s, %u: the first piece, front to back, is seen (%ld not, %ld grazed)",
     x->name, most, wrong, grazed);
}

/* --- The walk ------------------------------------------------------------- */

enum { EYES = 24 };

/* The pieces that a walk visits. */
struct told {
  const struct hsr_bsp *bsp;
  uint32_t *piece, n;
  int *facing;
};

static void tell(void *context, const struct hsr_bsp_piece *piece, int facing) {
  struct told *told = context;
  told->facing[told->n] = facing;
  told->piece[told->n++] = (uint32_t)(piece - told->bsp->piece);
}

/* Keeps in the order only the pieces that are visible, with their facings. */
static void leave_seen(struct fixture *x, int *facing) {
  const struct hsr_world *world = x->setup.world;
  uint32_t n = 0;
  for (uint32_t k = 0; k < x->n_ordered; k++) {
    const struct hsr_bsp_piece *piece = &x->bsp.piece[x->order[k]];
    uint32_t f = piece->face;
    struct median_loop room;
    struct hsr_loop plane = plane_loop(x, world->mesh.plane[f], &room);
    int side = eye_side(x, plane) * piece->turned;
    if (side == 0 || (side < 0 && world->mesh.one_sided[f]))
      continue;
    facing[n] = side;
    x->order[n++] = x->order[k];
  }
  x->n_ordered = n;
}

/* Chooses the eye in the moved trees: near a vertex, or also in a median plane,
 * so that it is in planes, or nearly. The shift is added to vertices without
 * rounding if `exact`. */
static void choose_eye(struct fixture *x, bool exact, uint64_t *seed) {
  static const double shifts[2][3] = {{1024.0 / 3, -4096.0 / 3, 12288.0 / 7},
                                      {3072, -4096.5, 12288.25}};
  const struct hsr_world *world = x->setup.world;
  uint32_t v = (uint32_t)draw_integer(seed, 0, world->mesh.n_vertices - 1);
  const double at[3] = {world->mesh.x[v], world->mesh.y[v], world->mesh.z[v]};
  for (int k = 0; k < 3; k++) {
    double off = (double)draw_integer(seed, -2, 2) *
                 ldexp(1, (int)draw_integer(seed, -20, 2));
    x->shift[k] = shifts[exact][k];
    x->view.E[k] = nearbyint(at[k] * 0x1p20) * 0x1p-20 + off + x->shift[k];
  }
  if (x->bsp.n_medians && draw_integer(seed, 0, 1)) {
    const struct hsr_bsp_median *median =
        &x->bsp.median[draw_integer(seed, 0, x->bsp.n_medians - 1)];
    x->view.E[median->axis] = median->at + x->shift[median->axis];
  }
  memcpy(x->view.eye, x->view.E, sizeof x->view.eye);
}

/* Whether the walk follows the exact order. */
static bool check_walk(struct fixture *x, bool backwards, struct told *told,
                       const int *facing) {
  struct hsr_bsp_waiting *waiting =
      HSR_NEW(&x->arena, struct hsr_bsp_waiting,
              hsr_bsp_most_waiting(x->bsp.most_depth));
  struct hsr_bsp_walk walk = {.bsp = &x->bsp,
                              .view = &x->view,
                              .shift = x->shift,
                              .backwards = backwards,
                              .tally = &x->tally,
                              .waiting = waiting,
                              .context = told,
                              .piece = tell};
  told->n = 0;
  hsr_bsp_walk_tree(&walk);
  bool good = told->n == x->n_ordered;
  for (uint32_t k = 0; k < told->n && good; k++) {
    uint32_t l = backwards ? told->n - 1 - k : k;
    good = told->piece[k] == x->order[l] && told->facing[k] == facing[l];
  }
  return good;
}

static void check_walks(struct tap *tap, struct fixture *x, uint32_t most) {
  uint64_t seed = 1;
  long told_of = 0;
  bool good = true;
  for (int k = 0; k < EYES; k++) {
    hsr_arena_reset(&x->arena);
    uint32_t n = x->bsp.n_pieces;
    x->order = HSR_NEW(&x->arena, uint32_t, n);
    int *facing = HSR_NEW(&x->arena, int, n);
    struct told told = {&x->bsp, HSR_NEW(&x->arena, uint32_t, n), 0,
                        HSR_NEW(&x->arena, int, n)};
    choose_eye(x, k % 2 == 0, &seed);
    x->n_ordered = 0;
    order_cube(x, 0);
    leave_seen(x, facing);
    good &= check_walk(x, false, &told, facing);
    good &= check_walk(x, true, &told, facing);
    told_of += told.n;
  }
  ok(tap, good && told_of && !x->tally.out_of_memory,
     "%s, %u: the walk goes that way, and back (%ld pieces)", x->name, most,
     told_of);
}

/* --- Scenes --------------------------------------------------------------- */

static void add_quad(struct hsr_object *object, const double corner[4][3]) {
  uint32_t vertex[4];
  for (int k = 0; k < 4; k++) {
    double x = corner[k][0], y = corner[k][1], z = corner[k][2];
    double turned = x * sin(.3) + y * cos(.3);
    if (hsr_object_vertex(object, x * cos(.3) - y * sin(.3),
                          turned * cos(.7) - z * sin(.7),
                          turned * sin(.7) + z * cos(.7), &vertex[k]))
      exit(99);
  }
  if (hsr_object_face(object, vertex, 4, NULL))
    exit(99);
}

static void add_triangle(struct hsr_object *object, const double corner[3][3]) {
  uint32_t vertex[3];
  for (int k = 0; k < 3; k++)
    if (hsr_object_vertex(object, corner[k][0], corner[k][1], corner[k][2],
                          &vertex[k]))
      exit(99);
  if (hsr_object_face(object, vertex, 3, NULL))
    exit(99);
}

static struct hsr_scene *pierced_sheet(void) {
  enum { N_NARROW = 60 };
  struct hsr_scene *scene = hsr_scene_new(PIERCED);
  struct hsr_object *object = scene ? hsr_scene_object(scene, PIERCED) : NULL;
  if (!object)
    exit(99);
  add_quad(object, (const double[4][3]){{-1, -1, 0},
                                        {N_NARROW + 1, -1, 0},
                                        {N_NARROW + 1, 1, 0},
                                        {-1, 1, 0}});
  for (int k = 0; k < N_NARROW; k++)
    add_quad(object,
             (const double[4][3]){
                 {k, -.5, -.5}, {k, .5, -.5}, {k, .5, .5}, {k, -.5, .5}});
  if (hsr_scene_instance(scene, 0, NULL))
    exit(99);
  return scene;
}

static enum hsr_status open_by_name(struct fixture *x, const char *name,
                                    struct hsr_import *import,
                                    struct hsr_error *err) {
  if (strcmp(name, PIERCED) != 0)
    return hsr_scene_open(name, import, &x->scene, err);
  x->scene = pierced_sheet();
  return hsr_scene_finish(x->scene, err);
}

/* Makes a scene ready that is open. */
static void lay_out(struct fixture *x) {
  struct hsr_error err = {.text = "out of memory"};
  x->convex = *hsr_algorithm_find("null")->plain;
  x->convex.restrictions = HSR_CF;
  if (hsr_scene_add_orbit(x->scene, VIEWS))
    bail("%s", err.text);
  must_world(&x->world, x->scene);
  must_setup(&x->setup, &x->convex, NULL, &x->world);
}

static bool open_scene(struct fixture *x, const char *name) {
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_import import = {.n_dropped = 0};
  *x = (struct fixture){.name = name};
  if (open_by_name(x, name, &import, &err)) {
    if (strncmp(name, "mesh:", 5) == 0)
      return false;
    bail("%s", err.text);
  }
  lay_out(x);
  return true;
}

static void close_scene(struct fixture *x) {
  hsr_arena_free(&x->arena);
  hsr_setup_free(&x->setup);
  hsr_world_free(&x->world);
  hsr_scene_delete(x->scene);
}

/* --- Refused trees -------------------------------------------------------- */

/* As many threads as are set make the trees, of `most_pieces` in all. */
static bool is_made(struct fixture *x, uint32_t most, uint32_t most_pieces,
                    struct hsr_error *err) {
  struct hsr_bsp_rule rule = {.most = most, .most_pieces = most_pieces};
  *err = (struct hsr_error){.text = ""};
  enum hsr_status status = hsr_bsp_init(&x->bsp, x->setup.world, &rule, err);
  bool is_line = strncmp(err->text, "the BSP trees of ", 17) == 0 &&
                 !strchr(err->text, '\n');
  if (status && (status != HSR_E_REFUSED || !is_line))
    bail("%s", err->text);
  return !status;
}

/* Trees of a scene without loose faces, in which all that is made is kept. With
 * exactly their pieces they are made; with one less, or with the faces or fewer,
 * they are refused: at the beginning, among cubes, among large groups, or by a
 * thread. */
static void check_refused(struct tap *tap, struct fixture *x,
                          const char *name) {
  static const int threads[] = {1, 3};
  struct hsr_error err;
  if (!open_scene(x, name))
    exit(99);
  for (int k = 0; k < 4; k++) {
    uint32_t most = k / 2 ? 30 : 0, n_faces = x->setup.world->n_faces;
    x->scene->threads = threads[k % 2];
    bool good = is_made(x, most, 0, &err) && !x->bsp.n_loose;
    uint32_t n = x->bsp.n_pieces, less[] = {n - 1, n - n / 8, n_faces, 1};
    hsr_bsp_free(&x->bsp);
    good &=
        n > n_faces + 1 && is_made(x, most, n, &err) && x->bsp.n_pieces == n;
    hsr_bsp_free(&x->bsp);
    for (int l = 0; l < 4; l++) {
      good &= !is_made(x, most, less[l], &err);
      hsr_bsp_free(&x->bsp);
    }
    ok(tap, good, "%s, %u, by %d: refused below %u pieces of %u faces: %s",
       name, most, threads[k % 2], n, n_faces, err.text);
  }
  close_scene(x);
}

/* --- A corner close to a plane -------------------------------------------- */

/* A triangle, and one that stands upon it. The tip of that is so many steps of a
 * double above the plane of the first or below it, about. */
static struct hsr_scene *standing(int steps) {
  static const double flat[3][3] = {
      {-.7, -1.3, .4}, {1.9, -.3, .9}, {.3, 1.7, -.6}};
  struct hsr_scene *scene = hsr_scene_new("standing");
  struct hsr_object *object =
      scene ? hsr_scene_object(scene, "standing") : NULL;
  double tip[3], z = steps > 0 ? INFINITY : -INFINITY;
  for (int c = 0; c < 3; c++)
    tip[c] = (flat[0][c] + flat[1][c] + flat[2][c]) / 3;
  for (int k = 0; k < abs(steps); k++)
    tip[2] = nextafter(tip[2], z);
  if (!object)
    exit(99);
  add_triangle(object, flat);
  add_triangle(object, (const double[3][3]){{tip[0], tip[1], tip[2]},
                                            {tip[0] + .2, tip[1], tip[2] + 2},
                                            {tip[0] - .2, tip[1], tip[2] + 2}});
  if (hsr_scene_instance(scene, 0, NULL))
    exit(99);
  return scene;
}

/* If the tip is not below the plane, that divides nothing, and there are two
 * pieces. If it is, each of the two planes divides the other triangle. */
static void check_tips(struct tap *tap) {
  static struct fixture fixture, *x = &fixture;
  int of[3] = {0}; /* below, on, above */
  bool good = true;
  for (int steps = -6; steps <= 6; steps++) {
    struct hsr_error err = {.text = "out of memory"};
    *x = (struct fixture){.name = "standing", .scene = standing(steps)};
    must_finish(x->scene);
    lay_out(x);
    const struct hsr_mesh *mesh = &x->setup.world->mesh;
    uint32_t v = mesh->vertex[mesh->start[1]];
    const double tip[3] = {mesh->x[v], mesh->y[v], mesh->z[v]};
    static const double still[3] = {0, 0, 0};
    int side = hsr_exact_moved_plane_side(hsr_plane_loop(x->setup.world, 0),
                                          still, tip, &x->out_of_memory);
    of[side + 1]++;
    good &= is_made(x, 0, 0, &err) && x->bsp.n_pieces == (side < 0 ? 3 : 2);
    hsr_bsp_free(&x->bsp);
    close_scene(x);
  }
  ok(tap, good && of[0] && of[2] && !x->out_of_memory,
     "a tip close to a plane: below %d, on %d, above %d times", of[0], of[1],
     of[2]);
}

int main(int argc, char **argv) {
  static const char *const built_in[] = {
      "house",         "color-cube:3", "soup:150:3",    "cyclic-overlap",
      "penetration",   "coplanar",     "t-junction",    "non-convex",
      "lattice:60:5",  "lattice:60:6", "nested-solids", "one-sided",
      "shared-edges",  "sliver",       "needle-fan",    "non-planar",
      "huge-and-tiny", "behind-eye",   "near-plane",    "eye-in-plane",
      "sphere:300",    "mesh:cross",   "mesh:anchor",   "tower:2",
      "terrain:100",   PIERCED};
  static const uint32_t most[] = {0, 4, 30};
  enum { MOST = sizeof most / sizeof *most };
  static struct fixture fixture, *x = &fixture;
  const char *const *scenes =
      argc > 1 ? (const char *const *)argv + 1 : built_in;
  int n = argc > 1 ? argc - 1 : (int)(sizeof built_in / sizeof *built_in);
  struct tap tap = plan(4 * n * MOST + 5);
  for (int s = 0; s < n; s++) {
    bool is_here = open_scene(x, scenes[s]);
    for (int k = 0; k < MOST; k++) {
      struct hsr_error err = {.text = "out of memory"};
      struct hsr_bsp_rule rule = {.most = most[k]};
      if (!is_here) {
        for (int t = 0; t < 4; t++)
          ok(&tap, true, "%s # SKIP it is not installed", scenes[s]);
        continue;
      }
      if (hsr_bsp_init(&x->bsp, x->setup.world, &rule, &err))
        bail("%s", err.text);
      check_form(&tap, x, most[k]);
      check_samples(&tap, x, most[k]);
      check_walks(&tap, x, most[k]);
      hsr_bsp_free(&x->bsp);
    }
    if (is_here)
      close_scene(x);
  }
  check_refused(&tap, x, "soup:1000:3");
  check_tips(&tap);
  return finish(&tap);
}
