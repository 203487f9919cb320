/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cameras and a palette as a part of a scene's name. "house@eye=9,5,9:fov=30" is the house,
 * and its only view is its first one with this eye and angle. "house@desk.json"
 * is the house as seen by the cameras of a file. "house@parallel=12" is the
 * house in all its views, in parallel projection. Several may follow one
 * another: "house@desk.json@view=2:near=1". "brain@palette=bone" is the brain
 * whose samples look as this palette says, as splats. A record that holds such
 * a name tells all that is needed to draw its picture again. */
#ifndef HSR_SCENES_CAMERAS_H
#define HSR_SCENES_CAMERAS_H

#include "common/scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The length of a name without its cameras and palettes. A name of a file that exists has
 * none. */
size_t hsr_name_before_cameras(const char *name);

/* Replaces the views of a finished scene by those that the name's cameras
 * describe, and the palette of its grid. `cameras` is "", or starts with '@'.
 * After the '@' stands a file (common/files/json/scene_json.h), or words
 * KEY=VALUE with colons between them: view (a number from 1; standard: 1),
 * up-axis (x, y or z: a view that stands on the y axis is turned about the point
 * that it looks at, so that it stands on this one), look (a standard view of
 * common/view/standard.h), eye, at, up (X,Y,Z), fov
 * (degrees), near, parallel (a height;
 * `same`: as high as what was in perspective around the point `at`; `fit-MxN`:
 * moved and sized so that the scene fits a picture of M x N, hsr_camera_fit;
 * `fit`: a square picture; fov makes it perspective again), light
 * (X,Y,Z, a point), sun
 * (X,Y,Z, a direction). Words without a place to
 * look from, to or up, and without view and look, change all views of the scene; others
 * leave one. Or palette=NAME, NAME being what hsr_palette_open takes, up to the
 * next '@'. HSR_E_USAGE for a word that is not understood, a view that the
 * scene has not, a camera that hsr_camera_check refuses, a palette that there
 * is not, or one of a scene that is no grid; HSR_E_INPUT for a file that cannot
 * be read; HSR_E_NOMEM. */
enum hsr_status hsr_scene_aim(struct hsr_scene *scene, const char *cameras,
                              struct hsr_error *err);

/* Whether a name's cameras follow from where the faces of the whole scene are. */
bool hsr_cameras_need_scene(const char *cameras);

/* Sets what a palette of the name's cameras needs before the scene is filled:
 * scene->window. Errors of palettes as of hsr_scene_aim. */
enum hsr_status hsr_scene_expect(struct hsr_scene *scene, const char *cameras,
                                 struct hsr_error *err);

/* Replaces the views of a finished scene by n >= 1 of a full turn: view number
 * `view`, from 0, turned about the line through its point `at` along its `up`,
 * counter-clockwise seen from above. The first is that view itself. HSR_E_NOMEM;
 * HSR_E_INPUT if hsr_camera_check refuses one. */
enum hsr_status hsr_scene_turn(struct hsr_scene *scene, uint32_t view,
                               uint32_t n, struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
