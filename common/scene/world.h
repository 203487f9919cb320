/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The environment laid out for the algorithms: every instance expanded, every
 * face numbered by its id, one plain array for each thing.
 *
 * Plane       the plane of a face has Newell's normal N (Sutherland et al.
 *             1974, eq. 6) and passes through the mean of the vertices, in
 *             exact arithmetic. It is stored rounded to doubles, with a bound
 *             of the error.
 * Equal       faces on exactly the same plane share a plane class. So a tie is
 *             found by comparing two integers.
 * Vertices    those of an instance, in their order, follow those of the instance
 *             before it; but the groups of a mesh share its vertices
 *             (hsr_group), which have the order of the mesh.
 * Pieces      the faces of one world may be divided into those of another: see
 *             common/scene/pieces.h. A piece lies on its parent's plane.
 * Roster      a scene with too many faces to be laid out has only a roster:
 *             which ids belong to which instance.
 * Grids       laying out a grid scene makes its faces first
 *             (hsr_scene_make_faces). A roster leaves them as they are. */
#ifndef HSR_COMMON_WORLD_H
#define HSR_COMMON_WORLD_H

#include "common/base/arena.h"
#include "common/polygon/polygon.h"
#include "common/scene/clusters.h"
#include "common/scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(protected) /* for modules: hsr-module.h */

/* Which ids belong to which instance. Every world has a roster. */
struct hsr_roster {
  const struct hsr_scene *scene; /* borrowed; outlives the world */
  uint32_t *first;    /* n_instances + 1: the first face of each instance, then
                         the number of faces */
  bool all_triangles; /* every face of this world is a triangle */
};

/* Three corners of a flat face that define its plane: their normal points to
 * the side that the face's does. */
struct hsr_span {
  uint32_t face, vertex[3];
};

/* Faces laid out: vertices, corners and planes. All 0 and NULL in a world that
 * is only a roster. */
struct hsr_mesh {
  uint32_t n_vertices, n_corners;

  /* Vertices in world units. These doubles are exact by definition. */
  double *x, *y, *z; /* n_vertices */

  /* Face f is vertex[start[f]], ..., vertex[start[f+1] - 1]. */
  uint32_t *start;    /* n_faces + 1 */
  uint32_t *vertex;   /* n_corners */
  uint32_t *object;   /* n_faces: index into scene->objects */
  uint32_t *instance; /* n_faces: index into scene->instances */
  bool *one_sided;    /* n_faces: exists only when seen from its front */

  /* Approximate planes: N = (nx, ny, nz) +- n_error in every component, not
   * normalised. The plane passes within anchor_error (in every component) of
   * the point (px, py, pz). For a triangle that point is its first vertex, and
   * the error is 0. `deviation` bounds |N . (V - P)| over the face's vertices
   * V, where P is their exact mean. It is 0 if and only if all vertices are
   * exactly on the plane, as those of a triangle are. The proof is in
   * planes.c. */
  double *nx, *ny, *nz, *n_error;      /* n_faces */
  double *px, *py, *pz, *anchor_error; /* n_faces */
  double *deviation;                   /* n_faces */
  uint32_t *plane;                     /* n_faces: plane class */
  uint32_t n_planes;

  /* Of flat faces with more than HSR_SMALL_FACE corners, by ascending face.
   * None where faces are laid out anew one by one. */
  struct hsr_span *span;
  uint32_t n_spans;
};

struct hsr_world {
  uint32_t n_faces; /* laid out; in a roster, all faces of the scene */
  struct hsr_roster roster;
  struct hsr_mesh mesh;

  /* In an extract (hsr_world_extract), the scene's id of each face; borrowed.
   * NULL in any other world. There the id is the face's number or, of a piece,
   * its parent's. */
  const uint32_t *id;

  /* In a world of pieces, what the pieces are; else NULL. */
  const struct hsr_pieces *pieces;

  /* In a world of pieces that are put into clusters, the clusters; else
   * NULL. */
  const struct hsr_clusters *clusters;

  struct hsr_arena arena; /* holds all of the above that is not borrowed */
};

/* Lays out a finished scene, which must outlive *world. The faces of a grid are
 * made first. *world is written in full, and is freed with hsr_world_free also
 * after a failure. HSR_E_NOMEM, also for 2^32 - 1 or more vertices or corners;
 * HSR_E_INPUT if in an instance the normal of a face is zero or a coordinate is
 * above 1e30 in size. */
enum hsr_status hsr_world_init(struct hsr_world *world, struct hsr_scene *scene,
                               struct hsr_error *err);

/* Frees what a world owns, but not the scene. */
void hsr_world_free(struct hsr_world *world);

/* Makes the roster of a finished scene, which must outlive *world. The mesh
 * stays empty. *world is written in full, and is freed with hsr_world_free also
 * after a failure. HSR_E_NOMEM. */
enum hsr_status hsr_world_roster(struct hsr_world *world,
                                 const struct hsr_scene *scene,
                                 struct hsr_error *err);

/* Calls hsr_world_init, or hsr_world_roster if the scene has more than `most`
 * faces. The faces of a grid are made in either case, unless there are more
 * than HSR_MOST_LAID_OUT. Errors are as of these two. */
#define HSR_MOST_LAID_OUT (1u << 25)
enum hsr_status hsr_world_open(struct hsr_world *world, struct hsr_scene *scene,
                               uint32_t most, struct hsr_error *err);

/* Makes an extract: lays out n faces of a scene. Face k of *out is the face
 * with the id id[k]. `world` may be laid out or a roster, but not of pieces. No
 * two faces of *out share a vertex. `id` and `world` are borrowed and must
 * outlive *out. *out is written in full, and is freed with hsr_world_free also
 * after a failure. HSR_E_NOMEM; HSR_E_INPUT as hsr_world_init. */
enum hsr_status hsr_world_extract(struct hsr_world *out,
                                  const struct hsr_world *world,
                                  const uint32_t *id, uint32_t n,
                                  struct hsr_error *err);

/* Whether the world is only a roster: its faces are not laid out. */
static inline bool hsr_is_roster(const struct hsr_world *world) {
  return !world->mesh.start;
}

/* Returns the index of the instance that face f belongs to. */
uint32_t hsr_instance_of(const struct hsr_roster *roster, uint32_t f);

/* The place of a face in its scene. */
struct hsr_place {
  const struct hsr_object *object; /* the scene's */
  uint32_t instance;               /* index into scene->instances */
  uint32_t face;                   /* of the object */
};

/* Returns the place of the face with this id. The world may be of any sort:
 * laid out, a roster, an extract, or of pieces. The object of a grid may be
 * empty (hsr_scene_lacks_faces). */
struct hsr_place hsr_place_of(const struct hsr_world *world, uint32_t id);

/* Computes the normal of a face in world units, and a point of its plane. They
 * are the same doubles as nx, ny, nz and px, py, pz of a world in which the
 * face is laid out. The faces of a grid must be made. */
void hsr_place_plane(const struct hsr_world *world, struct hsr_place place,
                     double normal[3], double anchor[3]);

/* For code that makes worlds. Allocates every array of the mesh, for the
 * n_faces, n_vertices and n_corners that are set; and roster.first, if it is
 * NULL. HSR_E_NOMEM. */
enum hsr_status hsr_world_allocate(struct hsr_world *world,
                                   struct hsr_arena *arena);

/* For code that makes worlds. Lays out face id[f] of the scene as face f of an
 * extract. Its corners and vertices get the numbers from start[f] on. Sets
 * start[f + 1]. */
void hsr_world_lay_out(struct hsr_world *world, uint32_t f);

/* For code that makes worlds. Finds the plane of face f, which is laid out, and
 * its deviation. *out_of_memory is set if memory runs out, and is left alone
 * otherwise. */
void hsr_world_find_plane(struct hsr_world *world, uint32_t f,
                          bool *out_of_memory);

/* Returns the number of corners of face f. */
static inline uint32_t hsr_face_size(const struct hsr_world *world,
                                     uint32_t f) {
  return world->mesh.start[f + 1] - world->mesh.start[f];
}

/* Returns the greatest number of corners of a face; 0 if there is no face. The
 * world must be laid out. */
uint32_t hsr_most_corners(const struct hsr_world *world);

/* Returns the polygon of face f. It borrows the arrays of the mesh. */
static inline struct hsr_loop hsr_face_loop(const struct hsr_world *world,
                                            uint32_t f) {
  struct hsr_loop loop = {world->mesh.x,
                          world->mesh.y,
                          world->mesh.z,
                          1,
                          world->mesh.vertex + world->mesh.start[f],
                          hsr_face_size(world, f)};
  return loop;
}

/* Returns a polygon with exactly the plane of face f: three of its corners if
 * the mesh has a span of it, else the face. It borrows the arrays of the
 * mesh. */
#define HSR_SMALL_FACE 16
struct hsr_loop hsr_spanning_loop(const struct hsr_world *world, uint32_t f);

/* Whether face f is exactly flat and v is one of its vertices. If true, v is
 * exactly on the plane of f. If false, v may be on it or not. */
static inline bool hsr_on_plane(const struct hsr_world *world, uint32_t f,
                                uint32_t v) {
  if (world->mesh.deviation[f] > 0)
    return false;
  for (uint32_t k = world->mesh.start[f]; k < world->mesh.start[f + 1]; k++)
    if (world->mesh.vertex[k] == v)
      return true;
  return false;
}

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif
#endif
