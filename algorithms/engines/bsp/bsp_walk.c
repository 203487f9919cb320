/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Going through an octree of BSP trees: see bsp_walk.h. Here are the proofs of
 * the eye's side.
 *
 * Notation    u = 2^-53; N, P the stored plane and a point on it
 *             (common/scene/world.h); E the eye; S the shift
 * Plane       d = fl(E - S) is wrong by u |d|, and r = fl(d - P) by that and
 *             u |r|. So r is as if P were wrong by u |d| more, and the bound is
 *             that of order.c, with 2 u |d| added to the anchor's error.
 * Median      Of median planes, and others across an axis, x = at + S is
 *             rounded to X. Rounding keeps order: if E < X then E < x, since x
 *             <= E would make X <= E; likewise for E > X. If E = X, the sign of
 *             E - x is the opposite of that of the rounding error x - X, which
 *             Knuth's two-sum gives exactly. */
#include "algorithms/engines/bsp/bsp_walk.h"
#include "common/exact/predicates.h"
#include "common/trees/octree.h"

#include <float.h>
#include <math.h>

static const double U = DBL_EPSILON / 2;
static const double TINY = 0x1p-960;

static double sum_of_sizes(const double v[3]) {
  return fabs(v[0]) + fabs(v[1]) + fabs(v[2]);
}

/* --- The eye's side ------------------------------------------------------- */

static int side_of_median(const struct hsr_bsp_walk *walk, int axis,
                          double at) {
  double shift = walk->shift[axis], eye = walk->view->eye[axis];
  double moved = at + shift;
  if (eye != moved)
    return eye > moved ? 1 : -1;
  double part = moved - at;
  double off = (at - (moved - part)) + (shift - part);
  return (off < 0) - (off > 0);
}

/* The side of -F, which no shift changes. */
static int side_in_parallel(const struct hsr_bsp_walk *walk, uint32_t f) {
  const struct hsr_mesh *mesh = &walk->bsp->world->mesh;
  const double *F = walk->view->F;
  const double n[3] = {mesh->nx[f], mesh->ny[f], mesh->nz[f]};
  double f1 = sum_of_sizes(F);
  double error =
      2 * mesh->n_error[f] * f1 + 16 * U * sum_of_sizes(n) * f1 + TINY;
  double along = n[0] * F[0] + n[1] * F[1] + n[2] * F[2];
  if (fabs(along) > error)
    return along < 0 ? 1 : -1;
  walk->tally->exact[HSR_ASK_FACING]++;
  return hsr_exact_eye_side(walk->view, hsr_plane_loop(walk->bsp->world, f),
                            &walk->tally->out_of_memory);
}

static int side_of_plane(const struct hsr_bsp_walk *walk,
                         const struct hsr_bsp_node *node) {
  const struct hsr_world *world = walk->bsp->world;
  const struct hsr_view *view = walk->view;
  const double *E = view->E, *S = walk->shift;
  if (node->level)
    return node->level * side_of_median(walk, node->axis, node->at);
  uint32_t f = walk->bsp->face_of[node->plane];
  const double n[3] = {world->mesh.nx[f], world->mesh.ny[f], world->mesh.nz[f]};
  if (view->parallel)
    return side_in_parallel(walk, f);
  const double d[3] = {E[0] - S[0], E[1] - S[1], E[2] - S[2]};
  const double r[3] = {d[0] - world->mesh.px[f], d[1] - world->mesh.py[f],
                       d[2] - world->mesh.pz[f]};
  double n1 = sum_of_sizes(n), r1 = sum_of_sizes(r);
  double anchor_error = world->mesh.anchor_error[f] + 2 * U * sum_of_sizes(d);
  double error = 2 * (world->mesh.n_error[f] * r1 + anchor_error * n1) +
                 16 * U * n1 * r1 + TINY;
  double height = n[0] * r[0] + n[1] * r[1] + n[2] * r[2];
  if (fabs(height) > error)
    return height > 0 ? 1 : -1;
  walk->tally->exact[HSR_ASK_FACING]++;
  return hsr_exact_moved_plane_side(hsr_plane_loop(world, f), S, E,
                                    &walk->tally->out_of_memory);
}

/* --- Trees ---------------------------------------------------------------- */

static void tell_pieces(const struct hsr_bsp_walk *walk,
                        const struct hsr_bsp_node *node, int eye_side) {
  const struct hsr_bsp *bsp = walk->bsp;
  uint32_t n = node->n_pieces;
  for (uint32_t k = 0; k < n && eye_side; k++) {
    const struct hsr_bsp_piece *piece =
        &bsp->piece[node->first_piece + (walk->backwards ? n - 1 - k : k)];
    int facing = eye_side * piece->turned;
    if (facing > 0 || !piece->one_sided)
      walk->piece(walk->context, piece, facing);
  }
}

/* Asks memory for what comes after the next subtree. */
static void fetch_next(const struct hsr_bsp *bsp,
                       const struct hsr_bsp_node *node) {
  __builtin_prefetch(&bsp->piece[node->first_piece]);
  if (node->behind != HSR_NO_BSP)
    __builtin_prefetch(&bsp->node[node->behind]);
}

static void walk_tree(const struct hsr_bsp_walk *walk, uint32_t root) {
  const struct hsr_bsp *bsp = walk->bsp;
  struct hsr_bsp_waiting *waiting = walk->waiting;
  uint32_t n = 0;
  waiting[n++] = (struct hsr_bsp_waiting){root, 0, false};
  while (n) {
    struct hsr_bsp_waiting next = waiting[--n];
    const struct hsr_bsp_node *node = &bsp->node[next.node];
    if (next.gone_into) {
      tell_pieces(walk, node, next.eye_side);
      continue;
    }
    if (walk->enter_node && !walk->enter_node(walk->context, next.node))
      continue;
    fetch_next(bsp, node);
    next.eye_side = side_of_plane(walk, node);
    next.gone_into = true;
    bool front_first = (next.eye_side > 0) != walk->backwards;
    uint32_t first = front_first ? node->front : node->behind;
    uint32_t last = front_first ? node->behind : node->front;
    if (last != HSR_NO_BSP)
      waiting[n++] = (struct hsr_bsp_waiting){last, 0, false};
    waiting[n++] = next;
    if (first != HSR_NO_BSP)
      waiting[n++] = (struct hsr_bsp_waiting){first, 0, false};
  }
}

/* --- Cubes ---------------------------------------------------------------- */

/* Recurses as deep as the octree: at most 20 levels (common/trees/bsp.cc). */
static void walk_cube(const struct hsr_bsp_walk *walk,
                      const struct hsr_bsp_cube *cube) {
  unsigned nearest = 0;
  if (walk->enter && !walk->enter(walk->context, cube))
    return;
  if (cube->root != HSR_NO_BSP) {
    walk_tree(walk, cube->root);
    return;
  }
  for (int k = 0; k < 3; k++)
    if (side_of_median(walk, k, cube->centre[k]) > 0)
      nearest |= 1u << k;
  for (int k = 0; k < 8; k++) {
    int place = walk->backwards ? 7 - k : k;
    uint32_t child = cube->child[nearest ^ hsr_octant_order[place]];
    if (child != HSR_NO_BSP)
      walk_cube(walk, &walk->bsp->cube[child]);
  }
}

void hsr_bsp_walk_cube(const struct hsr_bsp_walk *walk, uint32_t cube) {
  if (walk->bsp->n_pieces)
    walk_cube(walk, &walk->bsp->cube[cube]);
}

void hsr_bsp_walk_tree(const struct hsr_bsp_walk *walk) {
  hsr_bsp_walk_cube(walk, 0);
}
