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

/* The id of a sample that shows no face. */
#define HSR_BACKGROUND UINT32_MAX

/* The subject of a scene: faces, or a grid. An algorithm says which it
 * takes. */
enum hsr_scene_subject { HSR_FACES, HSR_GRID, HSR_N_SCENE_SUBJECTS };
extern const char *const hsr_scene_subject_name[HSR_N_SCENE_SUBJECTS];

/* Of an object that is a group of a mesh: how it shares vertices with the other
 * groups. The groups of a mesh are objects that follow one another. They are in
 * one frame. While they are placed alike and none moves, a vertex of the mesh is
 * one vertex of the world. So an edge between two groups is one edge, with a
 * face on either side. */
struct hsr_group {
  uint32_t
      *vertex;    /* by vertex of the object: its number in the mesh; NULL: the
                       object is no group. The object owns it */
  uint32_t n_own; /* the first n_own vertices are in no group before this one */
  uint32_t number, of; /* group `number` of `of`, from 0 */
  uint32_t n_vertices; /* of the mesh. Each is in a group */
};

/* Faces that share vertices, in the object's own frame. Vertex v is
 * xyz[3v .. 3v+2]. Face f is the polygon vertex[start[f]], ...,
 * vertex[start[f+1] - 1], counter-clockwise when seen from its front. A face
 * has at least 3 vertices, none of which follows itself, and its Newell normal
 * is not zero. Its ring may pass a vertex twice, or an edge in both directions.
 * So a face has holes: a bridge runs to each of them and back. What is inside
 * is decided by parity (docs/correct-picture.md), for which a bridge is nothing.
 * The object owns its arrays. They are malloc'ed, or NULL while they are empty.
 */
struct hsr_object {
  char *name;       /* never NULL */
  double *xyz;      /* 3 * n_vertices, finite */
  uint32_t *start;  /* n_faces + 1 offsets into vertex[], start[0] == 0 */
  uint32_t *vertex; /* start[n_faces] vertex numbers */
  float *rgb;       /* 3 * n_faces, linear, 0..1; NULL: all have `colour` */
  float colour[3];  /* of faces without a colour of their own, linear, 0..1 */
  float *face_opacity; /* n_faces, 0..1; NULL: all have `opacity` */
  struct hsr_group group;
  uint32_t n_vertices, n_faces;
  uint32_t cap_vertices, cap_faces, cap_corners; /* room, for the builder */
  float opacity;  /* 0..1. The default, 1, hides everything behind the face.
                     Only transparent pictures use it; pictures of ids do not */
  bool one_sided; /* a face exists only when it is seen from its front */
  bool moves;     /* instances may be moved between frames. So nothing that is
                     prepared for the scene may depend on their places. All
                     faces of the object are triangles */
};

/* A placed copy of an object: world = M * (x, y, z, 1). */
struct hsr_instance {
  uint32_t object; /* index into objects[] */
  double m[12];    /* M by rows, 3 of 4; identity: 1 0 0 0  0 1 0 0  0 0 1 0 */
};

/* A camera. Angles in degrees, lengths in world units. */
struct hsr_camera {
  double eye[3], at[3]; /* where it is, and a point that it looks at */
  double up[3];         /* a direction that is upwards in the picture */
  double fov;      /* vertical angle of view, 0 < fov < 180; of no effect in
                      parallel projection */
  double near;     /* points with depth t <= near do not exist; >= 0 */
  double parallel; /* above 0: parallel projection, and this is the height of
                      the picture. 0: perspective */
  double light[4]; /* x, y, z, 1: a light at this point. x, y, z, 0: a sun in
                      this direction. All 0: the default sun, `lamp` of the view
                      (common/view/view.h) */
};

/* Whether the camera has a light of its own. */
static inline bool hsr_camera_has_light(const struct hsr_camera *camera) {
  const double *l = camera->light;
  return l[0] != 0 || l[1] != 0 || l[2] != 0 || l[3] != 0;
}

struct hsr_motions; /* common/scene/motion.h */

/* A scene of faces has objects and instances. A grid scene has one object and
 * one instance of it. That object is for the sides of the cells, and it is
 * empty until hsr_scene_make_faces fills it. */
struct hsr_scene {
  char *name; /* as the user named it; never NULL */
  enum hsr_scene_subject subject;
  struct hsr_grid *grid; /* NULL unless the subject is HSR_GRID */
  struct hsr_object *objects;
  struct hsr_instance *instances; /* sorted by object */
  struct hsr_camera *views; /* the scene's own views; at least one in a finished
                               scene */
  uint32_t n_objects, n_instances, n_views;
  uint32_t cap_objects, cap_instances, cap_views; /* room, for the builder */
  double window[2]; /* the densities that are to be level 0 and level 255 of its
                       grid; both 0: as the grid's builder likes */
  double stand[3][3]; /* of views that the scene is given: what is right,
                         upwards and towards the viewer. Standard: x, y, z */
  int enlarged;       /* all lengths have been multiplied by 2^enlarged
                                  (hsr_scene_enlarge) */
  struct hsr_motions *motions; /* what is known of motions; NULL: nothing */
  int threads; /* the number of threads that check the scene, lay it out and
                  prepare it for algorithms (common/base/share.h); 0 means 1 */
};

/* Returns an empty scene, which the caller frees with hsr_scene_delete. `name`
 * is copied. NULL: out of memory. */
struct hsr_scene *hsr_scene_new(const char *name);

/* Frees a scene and all that it owns. NULL is allowed. */
void hsr_scene_delete(struct hsr_scene *scene);

/* Appends an empty object, two-sided, opaque and grey. `name` is copied. NULL:
 * out of memory. The scene owns the object. The pointer is valid until the next
 * call of this function. */
struct hsr_object *hsr_scene_object(struct hsr_scene *scene, const char *name);

/* Makes an empty scene a grid scene. The scene takes over the contents of
 * *grid, which becomes empty, also after a failure. HSR_E_NOMEM. */
enum hsr_status hsr_scene_set_grid(struct hsr_scene *scene,
                                   struct hsr_grid *grid);

/* Makes room for n_vertices vertices and n_faces faces in all, each fewer than
 * 2^32 - 1. It only saves time later. HSR_E_NOMEM. */
enum hsr_status hsr_object_reserve(struct hsr_object *object,
                                   uint32_t n_vertices, uint32_t n_faces);

/* Whether n coordinates are finite, and not above 1e30 in size: all that are used
 * must be. */
bool hsr_coordinates_fit(const double *coordinate, int n);

/* Appends a vertex and stores its number in *number (unless NULL).
 * HSR_E_NOMEM; HSR_E_INPUT if a coordinate is not finite or the object would
 * have more than 2^32 - 2 vertices. */
enum hsr_status hsr_object_vertex(struct hsr_object *object, double x, double y,
                                  double z, uint32_t *number);

/* Appends a face of n vertices, given by their numbers. Its colour is rgb[0 ..
 * 2], linear, 0..1; or the object's if rgb is NULL. Both arrays are copied.
 * HSR_E_NOMEM; HSR_E_INPUT if n < 3, a number is out of range or follows
 * itself, or the object would have more than 2^32 - 2 faces or corners. The geometry is
 * checked later, by hsr_scene_finish. */
enum hsr_status hsr_object_face(struct hsr_object *object,
                                const uint32_t *vertices, size_t n,
                                const float *rgb);

/* Gives a face an opacity of its own, 0..1. A value that the face has already
 * takes no memory. HSR_E_NOMEM: the object is as before. */
enum hsr_status hsr_object_set_opacity(struct hsr_object *object, uint32_t face,
                                       float opacity);

/* Appends n triangles of the object's colour. Returns an array of 3 n vertex
 * numbers, which the caller must fill at once, with three different valid
 * numbers for each triangle. The object owns the array. The pointer is valid
 * until the next face is added. NULL: memory ran out, a face of the object has
 * a colour or an opacity of its own, or the object would have more than 2^32 - 2 faces or
 * corners. */
uint32_t *hsr_object_triangles(struct hsr_object *object, uint32_t n);

/* Returns the colour of a face of an object: 3 numbers, linear, 0..1, which the
 * object owns. */
static inline const float *hsr_face_rgb(const struct hsr_object *object,
                                        uint32_t face) {
  return object->rgb ? object->rgb + 3 * (size_t)face : object->colour;
}

/* Returns the opacity of a face of an object. */
static inline float hsr_face_opacity(const struct hsr_object *object,
                                     uint32_t face) {
  return object->face_opacity ? object->face_opacity[face] : object->opacity;
}

/* Returns the number of vertex v of an object in its mesh: v, unless the object
 * is a group. */
static inline uint32_t hsr_mesh_vertex(const struct hsr_object *object,
                                       uint32_t v) {
  return object->group.vertex ? object->group.vertex[v] : v;
}

/* Appends an instance of object number `object`. m is as in hsr_instance; NULL
 * is the identity. Instances must be added in ascending order of their objects.
 * HSR_E_NOMEM; HSR_E_INPUT if the order is wrong, there is no such object, or
 * an entry of m is not finite. */
enum hsr_status hsr_scene_instance(struct hsr_scene *scene, uint32_t object,
                                   const double m[12]);

/* Moves all objects, instances and views of *from, which is no grid scene, to
 * the end of those of a scene. *from is then empty. HSR_E_NOMEM: nothing has
 * been moved. */
enum hsr_status hsr_scene_take(struct hsr_scene *scene, struct hsr_scene *from);

/* Appends a view. HSR_E_NOMEM; HSR_E_INPUT if hsr_camera_check refuses it. */
enum hsr_status hsr_scene_view(struct hsr_scene *scene,
                               const struct hsr_camera *camera);

/* Completes a scene and checks what the algorithms assume of its objects. An
 * object without an instance gets one, the identity, unless the scene has
 * motions (hsr_scene_set_motion). A scene without a view gets eight around it
 * (hsr_scene_add_orbit). HSR_E_NOMEM; HSR_E_INPUT, with *err naming the object
 * and the face or vertex where there is one, if
 * - the scene has no face, or more than 2^32 - 2;
 * - a face's Newell normal is exactly zero (for a triangle: all vertices on one
 *   line);
 * - a coordinate is above 1e30 in size, so that products of them may overflow;
 * - there is no view, and hsr_scene_add_orbit refuses to add one.
 * The faces of instances are checked by hsr_world_init. */
enum hsr_status hsr_scene_finish(struct hsr_scene *scene,
                                 struct hsr_error *err);

/* Returns the number of faces of a scene. Those of a grid count whether they
 * are made or not. */
uint64_t hsr_scene_faces(const struct hsr_scene *scene);

/* Fills the object of a finished grid scene with the faces of its cells. Does
 * nothing if the object is filled already, or if the scene has no grid.
 * HSR_E_NOMEM. */
enum hsr_status hsr_scene_make_faces(struct hsr_scene *scene,
                                     struct hsr_error *err);

/* Whether the scene is a finished grid scene whose faces are not made yet. */
static inline bool hsr_scene_lacks_faces(const struct hsr_scene *scene) {
  return scene->grid && !scene->objects[0].n_faces;
}

/* Whether a face of the scene is not opaque, or may be so: faces of its object
 * have opacities of their own. */
static inline bool hsr_scene_is_transparent(const struct hsr_scene *scene) {
  for (uint32_t o = 0; o < scene->n_objects; o++)
    if (scene->objects[o].opacity < 1 || scene->objects[o].face_opacity)
      return true;
  return false;
}

/* Enlarges a finished scene whose coordinates are all below 2^-100 in size, the
 * views included. All lengths are multiplied by a power of two, so that the
 * scene's size becomes about 1. The picture stays the same. The exponent is
 * added to scene->enlarged. Any other scene is left alone. The reason: in a
 * scene of size 1e-99, products of four coordinates are below the least double.
 * Intervals would decide nothing, and every comparison would need exact
 * numbers. */
void hsr_scene_enlarge(struct hsr_scene *scene);

/* Appends n views of the whole scene. The eyes are irregularly spaced on a
 * circle around the scene's bounding box, 20 degrees above its centre.
 * HSR_E_NOMEM; HSR_E_INPUT if all vertices are at one point, or so far from the
 * origin that hsr_camera_check refuses a view. */
enum hsr_status hsr_scene_add_orbit(struct hsr_scene *scene, unsigned n);

/* Checks a camera. HSR_E_INPUT, with the reason in *err, unless all of this
 * holds: values are finite and at most 1e30 in size, eye != at, up is not
 * parallel to the view direction, near >= 0, parallel >= 0, and 0 < fov < 180
 * in perspective. */
enum hsr_status hsr_camera_check(const struct hsr_camera *camera,
                                 struct hsr_error *err);

/* Computes the world coordinates of a vertex of an instance, by rows:
 *   x' = ((m0 x + m1 y) + m2 z) + m3.
 * Each operation is rounded to nearest, and none is contracted. These doubles
 * define the vertex, so all code must call this function. `in` and `out` may be
 * the same array. */
static inline void hsr_instance_vertex(const double m[12], const double in[3],
                                       double out[3]) {
  double x = in[0], y = in[1], z = in[2];
  for (int row = 0; row < 3; row++, m += 4)
    out[row] = ((m[0] * x + m[1] * y) + m[2] * z) + m[3];
}

/* Computes the placement `out` = A B, which places what B places once more, by
 * A. Each entry is rounded like a coordinate above. Where A or B is the
 * identity, nothing is rounded. `out` is another array. */
static inline void hsr_instance_compose(const double a[12], const double b[12],
                                        double out[12]) {
  for (int row = 0; row < 12; row += 4)
    for (int c = 0; c < 4; c++) {
      const double sum =
          (a[row] * b[c] + a[row + 1] * b[4 + c]) + a[row + 2] * b[8 + c];
      out[row + c] = c < 3 ? sum : sum + a[row + 3];
    }
}

#ifdef __cplusplus
}
#endif
#endif
