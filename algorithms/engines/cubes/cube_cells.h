/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cells of an object's cubes (cubes.h): how they are laid out. */
#ifndef HSR_CUBE_CELLS_H
#define HSR_CUBE_CELLS_H

#include "algorithms/engines/cubes/cubes.h"

static inline struct hsr_loop hsr_object_loop(const struct hsr_object *object,
                                              uint32_t f) {
  return (struct hsr_loop){object->xyz,
                           object->xyz + 1,
                           object->xyz + 2,
                           3,
                           object->vertex + object->start[f],
                           object->start[f + 1] - object->start[f]};
}

/* Where the next cell begins, and the cell's number of an object's vertex, good
 * where mark[] is the stamp. */
struct hsr_cell_maker {
  const struct hsr_object *object;
  struct hsr_cubes_object *c;
  uint32_t *number, *mark, stamp;
  uint32_t n_faces, n_starts, n_corners, n_vertices;
  bool writes; /* otherwise it only counts */

  /* Of cells that are made one by one: how much has room. */
  uint32_t cell_room, face_room, start_room, corner_room, vertex_room;
};

/* Makes a cell for each node of c->octree, by so many threads, in the arena.
 * HSR_E_NOMEM. */
enum hsr_status hsr_cells_make(struct hsr_cubes_object *c,
                               const struct hsr_object *object, int threads,
                               struct hsr_arena *arena);

/* One by one: cells for nodes from .. of c->octree, which are empty; and the
 * cell of node k. False: no memory. */
bool hsr_cells_make_empty(struct hsr_cell_maker *m, uint32_t from,
                          struct hsr_arena *arena);
bool hsr_cells_make_one(struct hsr_cell_maker *m, uint32_t k,
                        struct hsr_arena *arena);

#endif
