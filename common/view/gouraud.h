/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gouraud shading of a picture of face ids: each corner of a face has a colour,
 * and these are interpolated over the face.
 *
 * Source      H. Gouraud, "Continuous shading of curved surfaces", IEEE Trans.
 *             on Computers C-20(6), 1971, 623-629; Greene 1995, pp. 64 and 69,
 *             shades so.
 * Corners     the normal of a corner is the mean of the unit normals of some
 *             faces of its object: those that have the same vertex and whose
 *             normals differ from that of the corner's own face by at most
 *             HSR_SMOOTH degrees. The light is that of hsr_picture_light_of
 *             with this normal, on the side of the face that the eye sees.
 * Over a face the colours are interpolated along the edges, and then across the
 *             face between two edges. Gouraud's line across is a scan line of
 *             the screen. Here it is a line in the face, parallel to an axis.
 *             So colours stay where they are when the view turns, and no face
 *             that reaches behind the eye has to be clipped. On a triangle the
 *             interpolation is linear in space.
 * Precision   that of doubles. It is for pictures only; no answer depends on
 *             it.
 */
#ifndef HSR_COMMON_GOURAUD_H
#define HSR_COMMON_GOURAUD_H

#include "common/view/picture.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { HSR_SMOOTH = 45 }; /* degrees */

/* Fills rgb[3k .. 3k+2], linear, 0..1, for every sample k of the picture, with
 * view->m * view->n samples by rows. `ids` are the scene's ids, one a sample.
 * The world may be laid out or a roster. The scene's faces must be made
 * (hsr_scene_lacks_faces). HSR_E_NOMEM. */
enum hsr_status hsr_gouraud_shade(const struct hsr_world *world,
                                  const struct hsr_view *view,
                                  const uint32_t *ids, float *rgb,
                                  struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
