/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gouraud shading of a picture of face ids: each corner of a face has a colour,
 * and these are interpolated over the face.
 *
 * Source      H. Gouraud, "Continuous shading of curved surfaces", IEEE Trans.
 *             on Computers C-20(6), 1971, 623-629; Greene 1995, pp. 64 and 69,
 *             shades so.
 * Corners     The normal of a corner is the mean of the unit normals of those
 *             faces of its object that have the same vertex and turn from the
 *             corner's own face by at most HSR_SMOOTH degrees. Its light is
 *             that of hsr_picture_light with this normal, on the side of the
 *             face that the eye sees.
 * Over a face Along the edges, and then across the face between two edges: as
 *             Gouraud does on a scan line of the screen, but here on a line of
 *             the face itself, parallel to an axis. So the colours stay where
 *             they are when the view turns, and nothing has to be clipped where
 *             a face reaches behind the eye. On a triangle the interpolation is
 *             linear, in space.
 * Precision   that of doubles: it is for pictures, and nothing is compared */
#ifndef HSR_COMMON_GOURAUD_H
#define HSR_COMMON_GOURAUD_H

#include "common/view/picture.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { HSR_SMOOTH = 45 };

/* Fills rgb[3k .. 3k+2], linear, for every sample k of the picture. ids are
 * those of the scene; the world may be laid out or an outline. The scene must
 * have faces (hsr_scene_lacks_faces). HSR_E_NOMEM. */
enum hsr_status hsr_gouraud_shade(const struct hsr_world *world,
                                  const struct hsr_view *view,
                                  const uint32_t *ids, float *rgb,
                                  struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
