/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A part of a scene: the faces whose ids lie in one interval. A scene that is
 * too large for one process is drawn by several, each of which has a part. */
#ifndef HSR_COMMON_PART_H
#define HSR_COMMON_PART_H

#include "common/scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The bounding box of points, and the smallest sphere about the box's centre
 * that holds them. World units. To find them, call in this order: _begin; _add
 * for every point; _centre; _reach for every point again. */
struct hsr_scene_extent {
  double lo[3], hi[3], centre[3], radius;
};
void hsr_scene_extent_begin(struct hsr_scene_extent *extent);
void hsr_scene_extent_add(struct hsr_scene_extent *extent, const double p[3]);
void hsr_scene_extent_centre(struct hsr_scene_extent *extent);
void hsr_scene_extent_reach(struct hsr_scene_extent *extent, const double p[3]);

/* Finds a sphere that holds a scene: writes its centre and returns its radius,
 * in world units. The centre is that of the bounding box of all instances'
 * vertices, and the radius is the greatest distance of a vertex from it. Of a
 * grid, the vertices are the corners of the cells that are kept. */
double hsr_scene_sphere(const struct hsr_scene *scene, double centre[3]);

/* A part of a scene. The caller sets `number`, `of`, keeps_grid and
 * least_views. The maker of the scene sets the rest. */
struct hsr_scene_part {
  uint32_t number, of;  /* part `number` of `of`, from 0 */
  bool keeps_grid;      /* a grid stays a grid and gets an interval of its kept
                           cells; `first` and `n_faces` then count cells */
  uint32_t least_views; /* views that the scene must have at least */
  uint32_t first, n_faces; /* the part has ids first .. first + n_faces - 1 */
  uint32_t all;            /* faces of the whole scene */
  bool is_measured;        /* `extent` is that of the whole scene */
  struct hsr_scene_extent extent;
};

/* Sets first, n_faces and all of a part of a scene of `all` faces. Parts differ
 * by at most one face in size. */
void hsr_scene_part_set(struct hsr_scene_part *part, uint32_t all);

/* Reduces a finished scene to a part of it: keeps the part's faces and all
 * views, and frees the other faces. Sets first, n_faces and all of *part. The
 * face with id first + k gets id k. A grid becomes faces, unless
 * part->keeps_grid. A part may have no face. What is known of motions is
 * dropped, and no object is a group of a mesh any more. HSR_E_NOMEM. */
enum hsr_status hsr_scene_cut(struct hsr_scene *scene,
                              struct hsr_scene_part *part,
                              struct hsr_error *err);

/* As hsr_scene_add_orbit, around the sphere with this centre and radius.
 * HSR_E_NOMEM; HSR_E_INPUT if the radius is not above 0 or not finite, or
 * hsr_camera_check refuses a view. */
enum hsr_status hsr_scene_add_orbit_around(struct hsr_scene *scene,
                                           const double centre[3],
                                           double radius, unsigned n);

#ifdef __cplusplus
}
#endif
#endif
