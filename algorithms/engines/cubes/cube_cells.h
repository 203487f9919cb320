/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How the cells of an object's cubes are made. Within cubes/ only; see
 * cubes.h. */
#ifndef HSR_CUBE_CELLS_H
#define HSR_CUBE_CELLS_H

#include "algorithms/engines/cubes/cubes.h"

/* The corners of face f of an object, in the object's coordinates. */
static inline struct hsr_loop hsr_object_loop(const struct hsr_object *object,
                                              uint32_t f) {
  return (struct hsr_loop){object->xyz,
                           object->xyz + 1,
                           object->xyz + 2,
                           3,
                           object->vertex + object->start[f],
                           object->start[f + 1] - object->start[f]};
}

/* What makes cells, one after another. */
struct hsr_cell_maker {
  const struct hsr_object *object;
  struct hsr_cubes_object *c;

  /* By vertex of the object: its number in the cell, if mark[] equals `stamp`,
   * which is another one for each cell. */
  uint32_t *number, *mark, stamp;

  /* Where the next cell begins in the arrays of *c. */
  uint32_t n_faces, n_starts, n_corners, n_vertices;
  bool writes; /* writes the arrays; otherwise only counts */

  /* For cells that are made one by one: how much the arrays have room for. */
  uint32_t cell_room, face_room, start_room, corner_room, vertex_room;
};

/* Makes a cell for each node of c->octree, on so many threads. The arrays are
 * the arena's. HSR_E_NOMEM. */
enum hsr_status hsr_cells_make(struct hsr_cubes_object *c,
                               const struct hsr_object *object, int threads,
                               struct hsr_arena *arena);

/* For cubes that are divided lazily. hsr_cells_make_empty: makes empty cells
 * for the nodes of c->octree from number `from` on. hsr_cells_make_one: makes
 * the cell of node k. False: out of memory. */
bool hsr_cells_make_empty(struct hsr_cell_maker *m, uint32_t from,
                          struct hsr_arena *arena);
bool hsr_cells_make_one(struct hsr_cell_maker *m, uint32_t k,
                        struct hsr_arena *arena);

#endif
