/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Standard views of a scene, and a picture that its image fits.
 *
 * Source      ISO 5456-2 (orthographic views), ISO 5456-3 (isometric and
 *             dimetric)
 * Frame       the scene says what is right, upwards and towards the viewer
 *             (scene->stand): x, y and z, unless its file says otherwise. The
 *             front is what is seen from z. */
#ifndef HSR_COMMON_STANDARD_H
#define HSR_COMMON_STANDARD_H

#include "common/scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The names of the standard views, and NULL. In third-angle reading, each is
 * what one sees of the part from that side:
 *   front, back, left, right   upwards is up; left is seen from the left;
 *   top, bottom                the front is at the bottom edge of the top view,
 *                              and at the top edge of the bottom view;
 *   iso                        isometric, from the front, the right and above:
 *                              the axes are at 30 degrees, and equally
 *                              foreshortened;
 *   dimetric                   of ISO 5456-3, from the front, the right and
 *                              above: width at 7 degrees and height are
 *                              equally foreshortened, depth at 42 degrees half
 *                              as much. */
#define HSR_STANDARD_VIEWS 8
extern const char *const hsr_standard_views[HSR_STANDARD_VIEWS + 1];

/* Replaces eye, at, up and near of a camera by a standard view of a finished
 * scene, in parallel projection. All of the scene is in front of the eye, and it
 * fits a square picture (hsr_camera_fit). `up_axis` is the axis, 0 to 2, that is
 * up in place of the scene's; -1: the scene's. HSR_E_USAGE if there is no view
 * of this name, or hsr_camera_fit refuses it. */
enum hsr_status hsr_standard_view(const struct hsr_scene *scene,
                                  const char *name, int up_axis,
                                  struct hsr_camera *camera,
                                  struct hsr_error *err);

/* The part of the picture's width or height that stays empty on either side of
 * an image that fits. */
#define HSR_FIT_MARGIN 0.02

/* Makes a camera's projection parallel, and moves and sizes its picture of m x n
 * samples so that the image of the scene's faces, as far as they are in front of
 * the eye, is in the middle. Across or up and down, whichever is tighter, it
 * leaves HSR_FIT_MARGIN on either side. The direction of the view stays. `m` and
 * `n` may be any positive numbers of this ratio. HSR_E_USAGE if nothing is in
 * front of the eye, or its image is a point, or hsr_camera_check refuses the camera. */
enum hsr_status hsr_camera_fit(const struct hsr_scene *scene, double m,
                               double n, struct hsr_camera *camera,
                               struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
