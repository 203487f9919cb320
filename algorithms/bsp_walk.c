/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/bsp_walk.h"
#include "common/octree.h"
#include "common/predicates.h"

#include <math.h>
#include <stdlib.h>

static int exact_side(const struct hsr_bsp_walk *w, uint32_t f) {
  struct hsr_loop loop = hsr_plane_loop(w->bsp->world, f);
  double at[3 * 64];
  uint32_t number[64];
  for (uint32_t c = 0; c < loop.n && c < 64; c++) {
    size_t v = loop.stride * loop.vertex[c];
    at[3 * c] = loop.x[v] + w->shift[0];
    at[3 * c + 1] = loop.y[v] + w->shift[1];
    at[3 * c + 2] = loop.z[v] + w->shift[2];
    number[c] = c;
  }
  if (loop.n > 64)
    abort();
  struct hsr_loop moved = {at, at + 1, at + 2, 3, number, loop.n};
  w->tally->exact[HSR_ASK_FACING]++;
  return hsr_exact_plane_side(moved, w->eye, &w->tally->out_of_memory);
}

static int eye_side(const struct hsr_bsp_walk *w, uint32_t plane) {
  const struct hsr_world *world = w->bsp->world;
  uint32_t f = w->bsp->face_of[plane];
  const double n[3] = {world->nx[f], world->ny[f], world->nz[f]};
  const double p[3] = {world->px[f], world->py[f], world->pz[f]};
  double h = 0, n1 = 0, r1 = 0;
  for (int k = 0; k < 3; k++) {
    double r = w->eye[k] - (p[k] + w->shift[k]);
    h += n[k] * r;
    n1 += fabs(n[k]);
    r1 += fabs(r) + fabs(p[k]) + fabs(w->shift[k]);
  }
  double bound = 2 * (world->n_error[f] * r1 + world->anchor_error[f] * n1) +
                 0x1p-49 * n1 * r1 + 0x1p-960;
  return h > bound ? 1 : h < -bound ? -1 : exact_side(w, f);
}

static void walk_node(const struct hsr_bsp_walk *w, uint32_t number) {
  while (number != HSR_NO_BSP) {
    const struct hsr_bsp_node *node = &w->bsp->node[number];
    int side = eye_side(w, node->plane);
    walk_node(w, side >= 0 ? node->front : node->behind);
    for (uint32_t k = 0; side && k < node->n_pieces; k++) {
      const struct hsr_bsp_piece *piece = &w->bsp->piece[node->first_piece + k];
      int facing = side * w->bsp->turned[piece->face];
      if (facing > 0 || !w->bsp->world->one_sided[piece->face])
        w->piece(w->context, piece, facing);
    }
    number = side >= 0 ? node->behind : node->front;
  }
}

static void walk_cube(const struct hsr_bsp_walk *w, uint32_t number) {
  const struct hsr_bsp_cube *cube = &w->bsp->cube[number];
  if (!w->enter(w->context, cube))
    return;
  if (cube->root != HSR_NO_BSP) {
    walk_node(w, cube->root);
    return;
  }
  int nearest = 0;
  for (int k = 0; k < 3; k++)
    nearest |= (w->eye[k] > cube->centre[k] + w->shift[k]) << k;
  for (int k = 0; k < 8; k++) {
    uint32_t child = cube->child[nearest ^ hsr_octant_order[k]];
    if (child != HSR_NO_BSP)
      walk_cube(w, child);
  }
}

void HSR_OF_BUILD(hsr_bsp_walk)(const struct hsr_bsp_walk *w) {
  walk_cube(w, 0);
}
