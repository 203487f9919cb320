/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/engines/cubes/cube_cells.h"
#include "common/base/share.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

static uint32_t cell_vertex(struct hsr_cell_maker *m, struct hsr_cell *cell,
                            uint32_t v) {
  if (m->mark[v] != m->stamp) {
    const double *p = m->object->xyz + 3 * (size_t)v;
    m->mark[v] = m->stamp;
    m->number[v] = cell->n_vertices++;
    if (m->writes) {
      m->c->x[m->n_vertices] = p[0];
      m->c->y[m->n_vertices] = p[1];
      m->c->z[m->n_vertices] = p[2];
    }
    m->n_vertices++;
  }
  return m->number[v];
}

static void add_face(struct hsr_cell_maker *m, struct hsr_cell *cell,
                     uint32_t f) {
  struct hsr_loop loop = hsr_object_loop(m->object, f);
  for (uint32_t k = 0; k < loop.n; k++) {
    uint32_t v = cell_vertex(m, cell, loop.vertex[k]);
    if (m->writes)
      m->c->vertex[m->n_corners] = v;
    m->n_corners++;
  }
  if (m->writes) {
    m->c->face[m->n_faces] = f;
    m->c->start[m->n_starts] = m->n_corners - cell->first_corner;
  }
  m->n_faces++;
  m->n_starts++;
}

/* The kinds of faces, in the order in which a cell has them. */
enum kind { TRIANGLE, CONVEX, OTHER };

static enum kind kind_of(const struct hsr_cell_maker *m, uint32_t f) {
  if (m->object->start[f + 1] - m->object->start[f] == 3)
    return TRIANGLE;
  return m->c->is_fan[f] ? CONVEX : OTHER;
}

/* The n faces number[item[k]]. */
static void make_cell(struct hsr_cell_maker *m, uint32_t place,
                      const uint32_t *number, const uint32_t *item,
                      uint32_t n) {
  struct hsr_cell *cell = &m->c->cell[place];
  *cell = (struct hsr_cell){.first_face = m->n_faces,
                            .n_faces = n,
                            .first_vertex = m->n_vertices,
                            .first_corner = m->n_corners,
                            .first_start = m->n_starts};
  m->stamp++;
  if (m->writes)
    m->c->start[m->n_starts] = 0;
  m->n_starts++;
  for (enum kind kind = TRIANGLE; kind <= OTHER; kind++)
    for (uint32_t k = 0; k < n; k++) {
      uint32_t f = number[item[k]];
      if (kind_of(m, f) != kind)
        continue;
      add_face(m, cell, f);
      cell->n_triangles += kind == TRIANGLE;
      cell->n_convex += kind == CONVEX;
    }
}

/* The cells of an object, whose cubes are cut into ranges. All are made twice:
 * to count what a range has, and to write it where it belongs then. */
enum { RANGE = 256 };
struct cells {
  const struct hsr_object *object;
  struct hsr_cubes_object *c;
  int threads;
  bool writes;
  struct hsr_cell_maker *maker; /* a thread */
  struct hsr_cell_maker *range; /* a range: how many of each it has; then, where
                                   they begin */
  atomic_bool failed;
};

static struct hsr_cell_maker *maker_of(struct cells *cells, int thread) {
  struct hsr_cell_maker *m = &cells->maker[thread];
  size_t n = cells->object->n_vertices;
  if (!m->object)
    *m = (struct hsr_cell_maker){.object = cells->object,
                                 .c = cells->c,
                                 .number = malloc(n * sizeof *m->number),
                                 .mark = calloc(n, sizeof *m->mark)};
  return m->number && m->mark ? m : NULL;
}

static void make_range(void *context, uint32_t k, int thread) {
  struct cells *cells = context;
  const struct hsr_octree *octree = &cells->c->octree;
  struct hsr_range range = hsr_range_of(octree->n_nodes, RANGE, k);
  struct hsr_cell_maker *m = maker_of(cells, thread), *at = &cells->range[k];
  if (!m) {
    atomic_store(&cells->failed, true);
    return;
  }
  m->writes = cells->writes;
  m->n_faces = at->n_faces;
  m->n_starts = at->n_starts;
  m->n_corners = at->n_corners;
  m->n_vertices = at->n_vertices;
  for (uint32_t j = range.from; j < range.to; j++) {
    const struct hsr_octree_node *node = &octree->node[j];
    make_cell(m, j, cells->c->number,
              node->n ? octree->item + node->first : NULL, node->n);
  }
  *at = *m;
}

/* The ranges begin where those before them end; past the last is all. */
static void place_ranges(struct hsr_cell_maker *range, uint32_t n) {
  struct hsr_cell_maker sum = {.n_faces = 0};
  for (uint32_t k = 0; k <= n; k++) {
    struct hsr_cell_maker own = range[k];
    range[k] = sum;
    sum.n_faces += own.n_faces;
    sum.n_starts += own.n_starts;
    sum.n_corners += own.n_corners;
    sum.n_vertices += own.n_vertices;
  }
}

static bool make_cells(struct cells *cells, struct hsr_arena *arena) {
  struct hsr_cubes_object *c = cells->c;
  uint32_t n = hsr_n_ranges(c->octree.n_nodes, RANGE);
  const struct hsr_cell_maker *all = &cells->range[n];
  hsr_share(cells->threads, n, make_range, cells);
  place_ranges(cells->range, n);
  c->face = HSR_NEW(arena, uint32_t, all->n_faces);
  c->start = HSR_NEW(arena, uint32_t, all->n_starts);
  c->vertex = HSR_NEW(arena, uint32_t, all->n_corners);
  c->x = HSR_NEW(arena, double, all->n_vertices);
  c->y = HSR_NEW(arena, double, all->n_vertices);
  c->z = HSR_NEW(arena, double, all->n_vertices);
  if (atomic_load(&cells->failed) || !c->face || !c->start || !c->vertex ||
      !c->x || !c->y || !c->z)
    return false;
  cells->writes = true;
  hsr_share(cells->threads, n, make_range, cells);
  return !atomic_load(&cells->failed);
}

enum hsr_status hsr_cells_make(struct hsr_cubes_object *c,
                               const struct hsr_object *object, int threads,
                               struct hsr_arena *arena) {
  struct cells cells = {
      .object = object, .c = c, .threads = hsr_threads(threads)};
  size_t n_ranges = hsr_n_ranges(c->octree.n_nodes, RANGE) + (size_t)1;
  cells.maker = calloc((size_t)cells.threads, sizeof *cells.maker);
  cells.range = calloc(n_ranges, sizeof *cells.range);
  c->cell = HSR_NEW(arena, struct hsr_cell, c->octree.n_nodes);
  bool good =
      cells.maker && cells.range && c->cell && make_cells(&cells, arena);
  for (int k = 0; cells.maker && k < cells.threads; k++) {
    free(cells.maker[k].number);
    free(cells.maker[k].mark);
  }
  free(cells.maker);
  free(cells.range);
  return good ? HSR_OK : HSR_E_NOMEM;
}

/* --- Cells one by one ----------------------------------------------------- */

/* Makes room for `more` items behind those of an array. */
static void *widen(struct hsr_arena *arena, const void *array, uint32_t used,
                   uint32_t more, uint32_t room, size_t size) {
  if (array && used + more <= room)
    return (void *)(uintptr_t)array;
  void *made = hsr_arena_array(arena, 2 * (size_t)(used + more), size);
  if (made && used)
    memcpy(made, array, used * size);
  return made;
}

static void grow_room(uint32_t *room, uint32_t used, uint32_t more) {
  if (used + more > *room)
    *room = 2 * (used + more);
}

/* Makes room for the cell that `counted` has counted after *m. */
static bool make_room(struct hsr_cell_maker *m,
                      const struct hsr_cell_maker *counted,
                      struct hsr_arena *arena) {
  struct hsr_cubes_object *c = m->c;
  uint32_t faces = counted->n_faces - m->n_faces;
  uint32_t starts = counted->n_starts - m->n_starts;
  uint32_t corners = counted->n_corners - m->n_corners;
  uint32_t vertices = counted->n_vertices - m->n_vertices;
  c->face =
      widen(arena, c->face, m->n_faces, faces, m->face_room, sizeof *c->face);
  c->start = widen(arena, c->start, m->n_starts, starts, m->start_room,
                   sizeof *c->start);
  c->vertex = widen(arena, c->vertex, m->n_corners, corners, m->corner_room,
                    sizeof *c->vertex);
  double **xyz[3] = {&c->x, &c->y, &c->z};
  for (int k = 0; k < 3; k++)
    *xyz[k] = widen(arena, *xyz[k], m->n_vertices, vertices, m->vertex_room,
                    sizeof **xyz[k]);
  grow_room(&m->face_room, m->n_faces, faces);
  grow_room(&m->start_room, m->n_starts, starts);
  grow_room(&m->corner_room, m->n_corners, corners);
  grow_room(&m->vertex_room, m->n_vertices, vertices);
  return c->face && c->start && c->vertex && c->x && c->y && c->z;
}

/* Cells for new cubes, which are empty. */
bool hsr_cells_make_empty(struct hsr_cell_maker *m, uint32_t from,
                          struct hsr_arena *arena) {
  struct hsr_cubes_object *c = m->c;
  uint32_t more = c->octree.n_nodes - from;
  c->cell = widen(arena, c->cell, from, more, m->cell_room, sizeof *c->cell);
  grow_room(&m->cell_room, from, more);
  if (c->cell)
    memset(c->cell + from, 0, more * sizeof *c->cell);
  return c->cell;
}

bool hsr_cells_make_one(struct hsr_cell_maker *m, uint32_t k,
                        struct hsr_arena *arena) {
  struct hsr_cubes_object *c = m->c;
  const struct hsr_octree_node *node = &c->octree.node[k];
  const uint32_t *item = node->n ? c->octree.item + node->first : NULL;
  struct hsr_cell_maker counting = *m;
  make_cell(&counting, k, c->number, item, node->n);
  m->stamp = counting.stamp;
  if (!make_room(m, &counting, arena))
    return false;
  m->writes = true;
  make_cell(m, k, c->number, item, node->n);
  m->writes = false;
  return true;
}
