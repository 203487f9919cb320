/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The environment: objects made of faces, placed by instances.
 *
 * Source      Sutherland, Sproull and Schumacker 1974, "Object Descriptions":
 *             a point-polygon description with a structure of references.
 * Frame       right-handed world, any unit.
 * Identity    faces are numbered from 0 in input order: object by object,
 *             within an object instance by instance, within an instance face
 *             by face. HSR_BACKGROUND is no face.
 *
 * A scene owns all its memory. It is built by the functions below, by a
 * generator (scenes/) or by an importer (common/files/mesh/exchange.h,
 * common/files/json/scene_json.h), and then only read. */
#ifndef HSR_COMMON_SCENE_H
#define HSR_COMMON_SCENE_H

#include "common/base/status.h"
#include "common/grids/grid.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define HSR_BACKGROUND UINT32_MAX

/* The subject of a scene: what it is made of. An algorithm says which it takes.
 */
enum hsr_scene_subject { HSR_FACES, HSR_GRID, HSR_N_SCENE_SUBJECTS };
extern const char *const hsr_scene_subject_name[HSR_N_SCENE_SUBJECTS];

/* Faces that share vertices, in the object's own frame. Vertex v is
 * xyz[3v .. 3v+2]; face f is the polygon vertex[start[f]], ...,
 * vertex[start[f+1] - 1], counter-clockwise when seen from its front. A face
 * has at least 3 vertices, all different, and its Newell normal is not zero. */
struct hsr_object {
  char *name;       /* never NULL */
  double *xyz;      /* 3 * n_vertices, finite */
  uint32_t *start;  /* n_faces + 1 offsets into vertex[], start[0] == 0 */
  uint32_t *vertex; /* start[n_faces] vertex numbers */
  float *rgb;       /* 3 * n_faces, linear, 0..1; NULL: all `colour` */
  float colour[3];  /* of every face without one of its own, linear, 0..1 */
  uint32_t n_vertices, n_faces;
  uint32_t cap_vertices, cap_faces, cap_corners; /* room, for the builder */
  float opacity;  /* 0..1; 1, the default, hides all that is behind. Only for
                     transparent pictures: the ids of a picture ignore it */
  bool one_sided; /* back faces do not exist */
  bool moves;     /* its instances may be moved between frames, so nothing that
                     is prepared for a scene may depend on where they are. All
                     its faces are triangles */
};

/* A placed copy of an object: world = M * (x, y, z, 1). */
struct hsr_instance {
  uint32_t object; /* index into objects[] */
  double m[12];    /* 3 rows of 4; identity: 1 0 0 0  0 1 0 0  0 0 1 0 */
};

/* A place to look from. Angles in degrees, lengths in world units. */
struct hsr_camera {
  double eye[3], at[3], up[3];
  double fov;      /* vertical angle, degrees, 0 < fov < 180 */
  double near;     /* points with t <= near do not exist; >= 0 */
  double parallel; /* over 0: the projection is parallel, the picture so high,
                      and fov means nothing. 0: perspective */
  double light[4]; /* x, y, z, 1: a light at this point; x, y, z, 0: a sun in
                      this direction; all 0: the sun of hsr_view_init */
};

/* Whether it names a light. */
static inline bool hsr_camera_has_light(const struct hsr_camera *camera) {
  const double *l = camera->light;
  return l[0] != 0 || l[1] != 0 || l[2] != 0 || l[3] != 0;
}

struct hsr_motions; /* common/scene/motion.h */

/* A grid scene has one object, the sides of its cells, and one instance of it.
 * The object stays empty until hsr_scene_make_faces fills it. */
struct hsr_scene {
  char *name; /* as the user named it; never NULL */
  enum hsr_scene_subject subject;
  struct hsr_grid *grid; /* of HSR_GRID; else NULL */
  struct hsr_object *objects;
  struct hsr_instance *instances; /* sorted by object */
  struct hsr_camera *views;       /* the scene's own; at least one */
  uint32_t n_objects, n_instances, n_views;
  uint32_t cap_objects, cap_instances, cap_views;
  int enlarged; /* it is 2^enlarged times as large as it was given */
  struct hsr_motions *motions; /* what is known of them; NULL: nothing */
  int threads; /* by so many it is checked, laid out, and prepared for
                  algorithms (common/base/share.h); 0 as 1 */
};

/* An empty scene, which hsr_scene_delete frees. `name` is copied. NULL: out of
 * memory. */
struct hsr_scene *hsr_scene_new(const char *name);
void hsr_scene_delete(struct hsr_scene *scene); /* NULL is allowed */

/* Appends an empty two-sided grey object. `name` is copied. NULL: out of
 * memory. The scene owns the object; the pointer is good until the next call of
 * this function. */
struct hsr_object *hsr_scene_object(struct hsr_scene *scene, const char *name);

/* Makes an empty scene one of a grid, which it owns from here on, also after a
 * failure; *grid becomes empty. HSR_E_NOMEM. */
enum hsr_status hsr_scene_set_grid(struct hsr_scene *scene,
                                   struct hsr_grid *grid);

/* Makes room for so many vertices and faces in all, each fewer than 2^32 - 1.
 * HSR_E_NOMEM. */
enum hsr_status hsr_object_reserve(struct hsr_object *object,
                                   uint32_t n_vertices, uint32_t n_faces);

/* Takes the faces' colours away; they have the object's from then on. */
void hsr_object_uncolour(struct hsr_object *object);

/* Appends a vertex and stores its number in *number (unless NULL).
 * HSR_E_NOMEM; HSR_E_INPUT if a coordinate is not finite or the object would
 * have more than 2^32 - 2 vertices. */
enum hsr_status hsr_object_vertex(struct hsr_object *object, double x, double y,
                                  double z, uint32_t *number);

/* Appends a face of n vertices, by their numbers. Its colour is rgb (3 floats),
 * or the object's if that is NULL. HSR_E_NOMEM; HSR_E_INPUT if n < 3, a number
 * is out of range or occurs twice, or the object would have more than 2^32 - 2
 * faces or corners. Does not look at the geometry: hsr_scene_finish does. */
enum hsr_status hsr_object_face(struct hsr_object *object,
                                const uint32_t *vertices, size_t n,
                                const float *rgb);

/* Appends n triangles of the object's colour, where no face has one of its own.
 * Returns their 3 n vertex numbers, for the caller to write at once: valid ones,
 * three different ones each. They are the object's, and are moved by the next
 * face. NULL: memory ran out, or the object would have more than 2^32 - 2 faces
 * or corners. */
uint32_t *hsr_object_triangles(struct hsr_object *object, uint32_t n);

/* Appends an instance of object number `object`; m is as in hsr_instance, NULL
 * for the identity. Instances must be added in ascending order of their
 * objects. HSR_E_NOMEM; HSR_E_INPUT if they are not, there is no such object,
 * or an entry of m is not finite. */
enum hsr_status hsr_scene_instance(struct hsr_scene *scene, uint32_t object,
                                   const double m[12]);

/* Appends a view. HSR_E_NOMEM; HSR_E_INPUT if hsr_camera_check refuses it. */
enum hsr_status hsr_scene_view(struct hsr_scene *scene,
                               const struct hsr_camera *camera);

/* Completes a scene: an object without instance gets one identity instance,
 * unless it is known how others move; a
 * scene without view gets eight around it (hsr_scene_add_orbit). Also checks
 * what the algorithms assume of the objects. HSR_E_NOMEM; HSR_E_INPUT, with
 * *err naming the object and the face or vertex where there is one, if
 * - the scene has no face, or more than 2^32 - 2;
 * - a face's Newell normal is exactly zero (for a triangle: all vertices on one
 *   line);
 * - a coordinate is above 1e30 in size, so that products of them may overflow;
 * - there is no view, and hsr_scene_add_orbit refuses to add one.
 * The faces of instances are checked by hsr_world_init. */
enum hsr_status hsr_scene_finish(struct hsr_scene *scene,
                                 struct hsr_error *err);

/* The faces of a scene. Those of a grid count whether they are made or not. */
uint64_t hsr_scene_faces(const struct hsr_scene *scene);

/* Fills the object of a finished grid scene with the faces of its cells, if it
 * is empty; any other scene is as it should be. HSR_E_NOMEM. */
enum hsr_status hsr_scene_make_faces(struct hsr_scene *scene,
                                     struct hsr_error *err);

/* Whether the faces of a finished grid scene are not made. */
static inline bool hsr_scene_lacks_faces(const struct hsr_scene *scene) {
  return scene->grid && !scene->objects[0].n_faces;
}

/* Whether an object of the scene is not opaque. */
static inline bool hsr_scene_is_transparent(const struct hsr_scene *scene) {
  for (uint32_t o = 0; o < scene->n_objects; o++)
    if (scene->objects[o].opacity < 1)
      return true;
  return false;
}

/* Enlarges a finished scene, views and all, by a power of two if all of it is
 * within 2^-100 of the origin, so that its size is about 1. The picture stays
 * the same. In a scene of 1e-99 the products of four coordinates are below the
 * least double: intervals tell nothing then, and every comparison would be made
 * in exact numbers. scene->enlarged becomes the exponent. */
void hsr_scene_enlarge(struct hsr_scene *scene);

/* Appends n views from a circle around the scene's bounding box, raised by 20
 * degrees and irregularly spaced. Each holds the whole scene. HSR_E_NOMEM;
 * HSR_E_INPUT if all vertices are in one point, or so far out that
 * hsr_camera_check refuses a view. */
enum hsr_status hsr_scene_add_orbit(struct hsr_scene *scene, unsigned n);

/* HSR_E_INPUT, with *err saying why, unless the camera can see: values finite
 * and at most 1e30 in size, eye != at, up not along the view, 0 < fov < 180
 * unless the projection is parallel, near >= 0, parallel >= 0. */
enum hsr_status hsr_camera_check(const struct hsr_camera *camera,
                                 struct hsr_error *err);

/* The one canonical function that computes an instanced vertex: the doubles
 *   x' = ((m0 x + m1 y) + m2 z) + m3, and so on by rows,
 * each operation rounded to nearest, none contracted. in and out may be the
 * same array. */
static inline void hsr_instance_vertex(const double m[12], const double in[3],
                                       double out[3]) {
  double x = in[0], y = in[1], z = in[2];
  for (int row = 0; row < 3; row++, m += 4)
    out[row] = ((m[0] * x + m[1] * y) + m[2] * z) + m[3];
}

#ifdef __cplusplus
}
#endif
#endif
