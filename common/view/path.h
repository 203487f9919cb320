/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The way of the camera from the view before to a view, and the views on it.
 *
 * Motion      every rigid motion is a screw: a turn about an axis and a shift
 *             along it (M. Chasles, 1830). Here both have a constant speed. So
 *             an eye that goes around a point stays on its circle, a camera that
 *             turns on the spot stays there, and one that does not turn goes
 *             straight.
 * Objects     a grid does not move in the world. If it turns before a camera,
 *             the camera turns around it, the other way about.
 * Exact       E, F, R, U and near of a view on the way are doubles, computed
 *             once. They are exact by definition, as those of view.h are. */
#ifndef HSR_COMMON_VIEW_PATH_H
#define HSR_COMMON_VIEW_PATH_H

#include "common/view/view.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(protected) /* for modules: hsr-module.h */

/* Whether there is a way: *view has a view before it, of the same
 * projection. */
bool hsr_view_has_path(const struct hsr_view *view);

/* Sets *between to the view after the share part / parts of the way, 0 <= part
 * <= parts, parts > 0. hsr_view_has_path must hold. `between` must not be
 * `view`. At the share 0 its E, F, R, U and near are those of the view before,
 * at the share 1 those of *view. In between
 *   F, right, up   are turned about the screw's axis by this share of its angle,
 *                  which is at most half a turn;
 *   E              is on the screw;
 *   |R|, |U|, near change evenly.
 * Its picture, tile, window and offsets are those of *view. Its camera has the
 * same place, directions, angle and height, rounded. It has no view before.
 * HSR_E_NOMEM; HSR_E_INPUT if F, R, U are linearly dependent. */
enum hsr_status hsr_view_between(const struct hsr_view *view, int part,
                                 int parts, struct hsr_view *between,
                                 struct hsr_error *err);

/* For hsr_view_init and hsr_view_between. Fills eye, lamp, light, ray, screen,
 * origin and depth of *view from all else that it has. `right` and `up` are the
 * directions of R and U, of length 1. HSR_E_INPUT if F, R, U are linearly
 * dependent; HSR_E_NOMEM. */
enum hsr_status hsr_view_complete(struct hsr_view *view, const double right[3],
                                  const double up[3], struct hsr_error *err);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif
#endif
