/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A part of a scene: the faces whose ids lie in one interval. A scene that is
 * too large for one process is drawn part by part. */
#ifndef HSR_COMMON_PART_H
#define HSR_COMMON_PART_H

#include "common/scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The box around points, then the sphere around its centre. All points are
 * added once, then after hsr_scene_extent_centre once more. */
struct hsr_scene_extent {
  double lo[3], hi[3], centre[3], radius;
};
void hsr_scene_extent_begin(struct hsr_scene_extent *extent);
void hsr_scene_extent_add(struct hsr_scene_extent *extent, const double p[3]);
void hsr_scene_extent_centre(struct hsr_scene_extent *extent);
void hsr_scene_extent_reach(struct hsr_scene_extent *extent, const double p[3]);

/* Finds the centre of the bounding box of all instances' vertices, or of a
 * grid's cells, and returns the greatest distance of one from it. */
double hsr_scene_sphere(const struct hsr_scene *scene, double centre[3]);

/* Which part is wanted, and what is known of it once it is made. */
struct hsr_scene_part {
  uint32_t number, of;     /* from 0 */
  bool keeps_grid;         /* a grid stays one, and has an interval of its kept
                              cells: `first` and `n_faces` are those of cells */
  uint32_t least_views;    /* the scene is to have so many views at least */
  uint32_t first, n_faces; /* the ids of the part are first, first + 1, ... */
  uint32_t all;            /* faces of the scene */
  bool is_measured;        /* `extent` is that of the whole scene */
  struct hsr_scene_extent extent;
};

/* Sets first, n_faces and all, for a scene of so many faces. */
void hsr_scene_part_set(struct hsr_scene_part *part, uint32_t all);

/* Leaves the wanted part of a finished scene, with the views of the whole, and
 * frees the rest. Id first + k becomes k. A grid becomes faces, unless it is
 * kept. A part may have no face. HSR_E_NOMEM. */
enum hsr_status hsr_scene_cut(struct hsr_scene *scene,
                              struct hsr_scene_part *part,
                              struct hsr_error *err);

/* As hsr_scene_add_orbit, around a sphere that is given. */
enum hsr_status hsr_scene_add_orbit_around(struct hsr_scene *scene,
                                           const double centre[3],
                                           double radius, unsigned n);

#ifdef __cplusplus
}
#endif
#endif
