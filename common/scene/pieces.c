/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/scene/pieces.h"

#include <math.h>
#include <string.h>

static enum hsr_status allocate(struct hsr_world *world,
                                struct hsr_pieces *pieces,
                                const struct hsr_piece_list *list) {
  struct hsr_arena *arena = &world->arena;
  size_t n = list->n;
  pieces->parent = HSR_NEW(arena, uint32_t, n);
  pieces->first = HSR_NEW(arena, uint32_t, (size_t)pieces->whole->n_faces + 1);
  pieces->cut_start = HSR_NEW(arena, uint32_t, n + 1);
  pieces->cut = HSR_NEW(arena, struct hsr_cut, list->cut_start[n]);
  pieces->outline_start = HSR_NEW(arena, uint32_t, n + 1);
  pieces->outline = HSR_NEW(arena, uint32_t, list->outline_start[n]);
  return pieces->parent && pieces->first && pieces->cut_start && pieces->cut &&
                 pieces->outline_start && pieces->outline
             ? hsr_world_allocate(world, arena)
             : HSR_E_NOMEM;
}

/* The parent's vertices, then the outlines' points. */
static void copy_vertices(struct hsr_world *world, struct hsr_pieces *pieces,
                          const struct hsr_piece_list *list) {
  const struct hsr_world *whole = pieces->whole;
  uint32_t n = whole->mesh.n_vertices;
  memcpy(world->mesh.x, whole->mesh.x, n * sizeof *world->mesh.x);
  memcpy(world->mesh.y, whole->mesh.y, n * sizeof *world->mesh.y);
  memcpy(world->mesh.z, whole->mesh.z, n * sizeof *world->mesh.z);
  double largest = 0;
  for (uint32_t k = 0; k < list->outline_start[list->n]; k++) {
    const double *p = list->outline + 3 * (size_t)k;
    world->mesh.x[n + k] = p[0];
    world->mesh.y[n + k] = p[1];
    world->mesh.z[n + k] = p[2];
    largest = fmax(largest, fmax(fabs(p[0]), fmax(fabs(p[1]), fabs(p[2]))));
    pieces->outline[k] = n + k;
  }
  /* An outline is clipped by a few planes, one after the other. Each time, the
   * point where an edge is divided is off by a few roundings. */
  pieces->outline_error = 0x1p-44 * largest;
}

static void copy_face(struct hsr_world *world, uint32_t f,
                      const struct hsr_world *whole, uint32_t parent) {
  struct hsr_mesh *to = &world->mesh;
  const struct hsr_mesh *from = &whole->mesh;
  to->object[f] = from->object[parent];
  to->instance[f] = from->instance[parent];
  to->one_sided[f] = from->one_sided[parent];
  to->nx[f] = from->nx[parent];
  to->ny[f] = from->ny[parent];
  to->nz[f] = from->nz[parent];
  to->n_error[f] = from->n_error[parent];
  to->px[f] = from->px[parent];
  to->py[f] = from->py[parent];
  to->pz[f] = from->pz[parent];
  to->anchor_error[f] = from->anchor_error[parent];
  to->deviation[f] = from->deviation[parent];
  to->plane[f] = from->plane[parent];
}

enum hsr_status hsr_world_of_pieces(struct hsr_world *world,
                                    const struct hsr_world *whole,
                                    const struct hsr_piece_list *list,
                                    struct hsr_error *err) {
  *world = (struct hsr_world){.roster.scene = whole->roster.scene,
                              .mesh.n_vertices = whole->mesh.n_vertices +
                                                 list->outline_start[list->n],
                              .n_faces = list->n,
                              .mesh.n_corners = list->start[list->n],
                              .mesh.n_planes = whole->mesh.n_planes};
  struct hsr_pieces *pieces =
      HSR_NEW_ZEROED(&world->arena, struct hsr_pieces, 1);
  if (!pieces)
    return hsr_fail_nomem(err);
  world->pieces = pieces;
  pieces->whole = whole;
  if (allocate(world, pieces, list))
    return hsr_fail_nomem(err);

  copy_vertices(world, pieces, list);
  memcpy(world->mesh.start, list->start, (list->n + 1) * sizeof *list->start);
  memcpy(world->mesh.vertex, list->vertex,
         world->mesh.n_corners * sizeof *list->vertex);
  memcpy(pieces->parent, list->parent, list->n * sizeof *list->parent);
  memcpy(pieces->cut_start, list->cut_start,
         (list->n + 1) * sizeof *list->cut_start);
  memcpy(pieces->outline_start, list->outline_start,
         (list->n + 1) * sizeof *list->outline_start);
  world->roster.all_triangles = world->mesh.n_corners == 3 * (uint64_t)list->n;

  uint32_t parent = 0;
  for (uint32_t f = 0; f < list->n; f++) {
    copy_face(world, f, whole, list->parent[f]);
    while (parent <= list->parent[f])
      pieces->first[parent++] = f;
  }
  pieces->first[whole->n_faces] = list->n;
  for (uint32_t i = 0; i <= whole->roster.scene->n_instances; i++)
    world->roster.first[i] = pieces->first[whole->roster.first[i]];
  for (uint32_t c = 0; c < list->cut_start[list->n]; c++)
    pieces->cut[c] =
        (struct hsr_cut){pieces->first[list->cut[c].face], list->cut[c].side};
  return HSR_OK;
}
