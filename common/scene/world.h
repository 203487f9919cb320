/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The environment laid out for the algorithms: every instance expanded, every
 * face numbered by its id, one plain array for each thing.
 *
 * Plane       of face f: Newell's normal N (Sutherland et al. 1974, eq. 6)
 *             through the mean of the vertices, in exact arithmetic; what is
 *             stored is that plane in doubles, with a bound of the error.
 * Equal       faces on exactly the same plane share a plane class, so their
 *             ties are decided by comparing two integers.
 * Pieces      the faces of one world may be divided into those of another: see
 *             common/scene/pieces.h. A piece lies on its parent's plane.
 * Outline     of a scene with too many instances to be laid out there is only
 *             an outline: which ids belong to which instance. */
#ifndef HSR_COMMON_WORLD_H
#define HSR_COMMON_WORLD_H

#include "common/base/arena.h"
#include "common/polygon/polygon.h"
#include "common/scene/clusters.h"
#include "common/scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Which ids belong to which instance: of any world. */
struct hsr_outline {
  const struct hsr_scene *scene; /* borrowed; outlives the world */
  uint32_t *first;    /* n_instances + 1: the first face of each instance */
  bool all_triangles; /* every face of this world */
};

/* Faces laid out: vertices, corners and planes. Empty, all 0 and NULL, in a
 * world that is only an outline. */
struct hsr_mesh {
  uint32_t n_vertices, n_corners;

  /* Vertices, world units, exact as they stand. */
  double *x, *y, *z; /* n_vertices */

  /* Face f is vertex[start[f]], ..., vertex[start[f+1] - 1]. */
  uint32_t *start;    /* n_faces + 1 */
  uint32_t *vertex;   /* n_corners */
  uint32_t *object;   /* n_faces: index into scene->objects */
  uint32_t *instance; /* n_faces: index into scene->instances */
  bool *one_sided;    /* n_faces: exists only when seen from its front */

  /* Approximate planes: N = (nx, ny, nz) +- n_error in every component;
   * the plane passes within anchor_error (in every component) of the point
   * (px, py, pz). Of a triangle that point is its first vertex and the error
   * 0. Not normalised. `deviation` bounds |N . (V - P)| over the face's
   * vertices V, P the exact mean: 0 if and only if they are all exactly on the
   * plane, as those of a triangle are. See planes.c for the proof. */
  double *nx, *ny, *nz, *n_error;      /* n_faces */
  double *px, *py, *pz, *anchor_error; /* n_faces */
  double *deviation;                   /* n_faces */
  uint32_t *plane;                     /* n_faces: plane class */
  uint32_t n_planes;
};

struct hsr_world {
  uint32_t n_faces; /* laid out; of an outline, all of the scene */
  struct hsr_outline outline;
  struct hsr_mesh mesh;

  /* Of an extract, the scene's id of each face; else NULL: its number. */
  const uint32_t *id;

  /* Of a world of pieces; else NULL, and every face is itself. */
  const struct hsr_pieces *pieces;

  /* Of a world of pieces put into clusters; else NULL. */
  const struct hsr_clusters *clusters;

  struct hsr_arena arena; /* holds all of the above */
};

/* Expands a finished scene. *world is written in full, and freed with
 * hsr_world_free also after a failure. HSR_E_NOMEM; HSR_E_INPUT when an
 * instance takes a face's normal to zero or a vertex out of range. */
enum hsr_status hsr_world_init(struct hsr_world *world,
                               const struct hsr_scene *scene,
                               struct hsr_error *err);
void hsr_world_free(struct hsr_world *world);

/* The outline of a finished scene; n_vertices and n_corners are 0. *world is
 * written in full, and freed with hsr_world_free also after a failure.
 * HSR_E_NOMEM. */
enum hsr_status hsr_world_outline(struct hsr_world *world,
                                  const struct hsr_scene *scene,
                                  struct hsr_error *err);

/* hsr_world_init, or hsr_world_outline where the faces are more than `most`. */
#define HSR_MOST_LAID_OUT (1u << 25)
enum hsr_status hsr_world_open(struct hsr_world *world,
                               const struct hsr_scene *scene, uint32_t most,
                               struct hsr_error *err);

/* Lays out n faces of a scene: face k of *out is face id[k] of `world`, an
 * outline or not, and no two share a vertex. `id` and `world` are borrowed and
 * outlive *out. HSR_E_NOMEM; HSR_E_INPUT as hsr_world_init. */
enum hsr_status hsr_world_extract(struct hsr_world *out,
                                  const struct hsr_world *world,
                                  const uint32_t *id, uint32_t n,
                                  struct hsr_error *err);

static inline bool hsr_is_outline(const struct hsr_world *world) {
  return !world->mesh.start;
}

/* The instance that face f belongs to. */
uint32_t hsr_instance_of(const struct hsr_outline *outline, uint32_t f);

/* Where a face of the scene stands there, by its id, whatever world it is
 * looked up in: laid out, an outline, an extract, or of pieces. */
struct hsr_place {
  const struct hsr_object *object;
  uint32_t instance;
  uint32_t face; /* of the object */
};
struct hsr_place hsr_place_of(const struct hsr_world *world, uint32_t id);

/* Its normal and the point that its plane passes through: the doubles that the
 * world has for it where it is laid out. */
void hsr_place_plane(const struct hsr_world *world, struct hsr_place place,
                     double normal[3], double anchor[3]);

/* For those who make worlds: allocates every array, the sizes being set;
 * `first` only if it is NULL. HSR_E_NOMEM. */
enum hsr_status hsr_world_allocate(struct hsr_world *world,
                                   struct hsr_arena *arena);

/* Lays out face id[f] of the scene as face f, with vertices of its own, from
 * start[f] on, and sets start[f + 1]. */
void hsr_world_lay_out(struct hsr_world *world, uint32_t f);

/* Finds the plane of face f, which is laid out, and its deviation. */
void hsr_world_find_plane(struct hsr_world *world, uint32_t f,
                          bool *out_of_memory);

/* Number of vertices of face f. */
static inline uint32_t hsr_face_size(const struct hsr_world *world,
                                     uint32_t f) {
  return world->mesh.start[f + 1] - world->mesh.start[f];
}

/* The corners of face f. */
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

/* Whether vertex v is one of face f and exactly on its plane. */
static inline bool hsr_on_plane(const struct hsr_world *world, uint32_t f,
                                uint32_t v) {
  if (world->mesh.deviation[f] > 0)
    return false;
  for (uint32_t k = world->mesh.start[f]; k < world->mesh.start[f + 1]; k++)
    if (world->mesh.vertex[k] == v)
      return true;
  return false;
}

#ifdef __cplusplus
}
#endif
#endif
