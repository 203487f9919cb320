/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A scene in cubes: an octree of its instances, and for each object an octree
 * of its faces; the octree of octrees of Greene's thesis, 3.5. What is known of
 * an object is kept once, however many instances it has.
 *
 * Notation    Cell: the faces that one cube itself holds, as a small mesh
 *             with vertices of its own in plain arrays, triangles first, then
 *             convex faces; all of it can be transformed at once. Still, mover: an instance that
 *             does not move from frame to frame, or does. Loose face: one whose
 *             vertices are not exactly on one plane, in the object or in some
 *             instance. It is seen on its plane, which may lie outside of the
 *             cubes of its vertices. So it is in no cube; all loose faces are
 *             laid out in a world of their own. Triangles are never loose.
 * Invariant   A face that is not loose lies in the cubes that hold it, if the
 *             instance's transformation is exact. As that is rounded, the face
 *             lies within hsr_placing.slack of there (cube_frame.h). */
#ifndef HSR_COMMON_CUBES_H
#define HSR_COMMON_CUBES_H

#include "common/trees/octree.h"
#include "common/scene/world.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A cell, as ranges of the arrays of its struct hsr_cubes_object. Its faces are
 * face[first_face] and so on. The corners of its k-th face begin at
 * vertex[first_corner + start[first_start + k]]; they are numbers of the cell's
 * own vertices, of which number 0 is x[first_vertex]. */
struct hsr_cell {
  /* The triangles come first, then the convex faces of 4 to HSR_FAN_CORNERS
   * corners. */
  uint32_t first_face, n_faces, n_triangles, n_convex;
  uint32_t first_vertex, n_vertices;
  uint32_t first_corner; /* start[] counts from here in vertex[] */
  uint32_t first_start;  /* n_faces + 1 numbers */
};

/* A convex face of so many corners, at most, is a fan of triangles around its
 * first corner to whoever tiles it (cube_frame.h). */
enum { HSR_FAN_CORNERS = 34 };

struct hsr_cell_maker;

struct hsr_cubes_object {
  struct hsr_octree octree;
  struct hsr_lazy_octree *lazy; /* if cubes are divided lazily; else NULL */
  struct hsr_cell_maker *maker; /* makes the cells then; else NULL */
  const uint32_t *number;       /* by primitive of the octree: its face */
  struct hsr_cell *cell;        /* by node */
  bool *is_loose;               /* by face */
  bool *is_fan; /* by face: convex, of 4 to HSR_FAN_CORNERS corners */
  uint32_t n_loose;
  uint32_t *face; /* faces of the object, cell by cell */
  uint32_t *start, *vertex;
  double *x, *y, *z; /* in the object's own coordinates */
  double reach;      /* no coordinate is larger in size */
  int grain;         /* all coordinates are multiples of 2^grain */
  struct hsr_box bounds;
};

struct hsr_cubes {
  const struct hsr_scene *scene;   /* borrowed */
  struct hsr_cubes_object *object; /* by object of the scene */
  struct hsr_octree octree;        /* of the instances that do not move */
  struct hsr_lazy_octree *lazy;    /* if cubes are divided lazily; else NULL */
  uint32_t *still;                 /* by primitive of the octree: its instance;
                                      NULL: they have the same numbers */
  uint32_t *mover;                 /* the instances that move */
  uint32_t n_movers;
  struct hsr_world loose; /* the loose faces of all instances, laid out */
  uint32_t *loose_id;     /* by face of that world: its id in the scene */
  uint32_t most_vertices, most_faces, most_corners; /* of a cell */
  uint32_t most_object_faces;                       /* of an object */
  struct hsr_arena arena;
  struct hsr_arena *crew; /* by thread: what it made of objects */
  int n_crew;
};

/* Makes the octrees of a world's scene by `rule`, and the cells. `world` is
 * borrowed, with its scene, as long as *cubes. *cubes is freed with
 * hsr_cubes_free, also after a failure. HSR_E_NOMEM; HSR_E_REFUSED if an object
 * that moves is not of triangles only. */
enum hsr_status hsr_cubes_init(struct hsr_cubes *cubes,
                               const struct hsr_world *world,
                               const struct hsr_octree_rule *rule,
                               struct hsr_error *err);
void hsr_cubes_free(struct hsr_cubes *cubes);

/* The same, but each octree is a root cube; a cell is empty until its cube is
 * divided. */
enum hsr_status hsr_cubes_init_lazily(struct hsr_cubes *cubes,
                                      const struct hsr_world *world,
                                      const struct hsr_octree_rule *rule,
                                      struct hsr_error *err);

/* Divides cube k of object o, or of the octree of instances, and returns true.
 * If it has been divided before, or cubes are not divided lazily, they do
 * nothing and return false. The object's arrays and the octree's may move.
 * *status becomes HSR_E_NOMEM if memory runs out. */
bool hsr_cubes_divide(struct hsr_cubes *cubes, uint32_t o, uint32_t k,
                      enum hsr_status *status);
bool hsr_cubes_divide_instances(struct hsr_cubes *cubes, uint32_t k,
                                enum hsr_status *status);

/* A box in the world that holds all faces of an instance, but for loose
 * ones. */
struct hsr_box hsr_cubes_bounds(const struct hsr_cubes *cubes,
                                uint32_t instance);

#ifdef __cplusplus
}
#endif
#endif
