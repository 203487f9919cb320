/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A scene in cubes: an octree of its instances, and for each object an octree
 * of its faces; the octree of octrees of Greene's thesis, 3.5. What is known of
 * an object is kept once, however many instances it has.
 *
 * Notation    the faces of one cube are a cell: a small mesh with vertices of
 *             its own, in plain arrays, triangles first, so that all of it can
 *             be transformed at once. A loose face is one whose vertices are
 *             not exactly on one plane, in the object or in some instance. It
 *             is visible where its plane is, which may be outside of the cubes
 *             of its vertices; so it is in no cube, but laid out in the world.
 *             Triangles are never loose.
 * Invariant   a face that is not loose lies in the cubes that hold it, when the
 *             instance's transformation is exact; as it is rounded, it lies
 *             within `slack` of there. */
#ifndef HSR_COMMON_CUBES_H
#define HSR_COMMON_CUBES_H

#include "common/trees/octree.h"
#include "common/scene/world.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The faces of a cube: face[first_face ..], corners vertex[start[first_start +
 * k]] and so on, which are numbers of the cell's own vertices, x[first_vertex
 * ..]. */
struct hsr_cell {
  uint32_t first_face, n_faces, n_triangles; /* the triangles come first */
  uint32_t first_vertex, n_vertices;
  uint32_t first_corner; /* start[] counts from here */
  uint32_t first_start;  /* n_faces + 1 numbers */
};

struct hsr_cell_maker;

struct hsr_cubes_object {
  struct hsr_octree octree;
  struct hsr_lazy_octree *lazy; /* it is divided bit by bit; else NULL */
  struct hsr_cell_maker *maker; /* of the cells, then */
  const uint32_t *number;       /* the octree's primitives: face numbers */
  struct hsr_cell *cell;        /* a node */
  bool *is_loose;               /* a face */
  uint32_t n_loose;
  uint32_t *face; /* numbers of the object's faces, cell by cell */
  uint32_t *start, *vertex;
  double *x, *y, *z; /* the object's own coordinates */
  double reach;      /* none is larger in size */
  int grain;         /* all are multiples of 2 to this */
  struct hsr_box bounds;
};

struct hsr_cubes {
  const struct hsr_scene *scene;
  struct hsr_cubes_object *object; /* an object of the scene */
  struct hsr_octree octree;        /* of the instances that do not move */
  struct hsr_lazy_octree *lazy;    /* it is divided bit by bit; else NULL */
  uint32_t *still;                 /* its primitives then: instances */
  uint32_t *mover;                 /* the others */
  uint32_t n_movers;
  struct hsr_world loose; /* the loose faces of all instances, laid out */
  uint32_t *loose_id;     /* what they are called in the scene */
  uint32_t most_vertices, most_faces, most_corners; /* of a cell */
  uint32_t most_object_faces;                       /* of an object */
  struct hsr_arena arena;
  struct hsr_arena *crew; /* of each thread: what it made of objects */
  int n_crew;
};

/* `world` is borrowed, with its scene. *cubes is freed with hsr_cubes_free also
 * after a failure: HSR_E_NOMEM; HSR_E_REFUSED where something that moves is not
 * of triangles. */
enum hsr_status hsr_cubes_init(struct hsr_cubes *cubes,
                               const struct hsr_world *world,
                               const struct hsr_octree_rule *rule,
                               struct hsr_error *err);
void hsr_cubes_free(struct hsr_cubes *cubes);

/* The same, but no cube is divided; cells are empty until their cubes are
 * divided. */
enum hsr_status hsr_cubes_init_lazily(struct hsr_cubes *cubes,
                                      const struct hsr_world *world,
                                      const struct hsr_octree_rule *rule,
                                      struct hsr_error *err);

/* Divides cube k of object o, or of the octree of instances, if it is not
 * divided yet: whether it was. The object's arrays and those of the octree may
 * move. *status becomes HSR_E_NOMEM if memory ran out. */
bool hsr_cubes_divide(struct hsr_cubes *cubes, uint32_t o, uint32_t k,
                      enum hsr_status *status);
bool hsr_cubes_divide_instances(struct hsr_cubes *cubes, uint32_t k,
                                enum hsr_status *status);

/* Holds what an instance places in the world, but for what is loose. */
struct hsr_box hsr_cubes_bounds(const struct hsr_cubes *cubes,
                                uint32_t instance);

#ifdef __cplusplus
}
#endif
#endif
