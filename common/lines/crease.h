/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which edges of a drawing show a shape: creases, borders and contours, rather
 * than the seams of a smooth surface cut into faces. */
#ifndef HSR_COMMON_CREASE_H
#define HSR_COMMON_CREASE_H

#include "common/lines/drawing.h"
#include "common/view/view.h"
#include "common/scene/world.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Takes out of a drawing, which is in the order of the definition, the edges of
 * exactly two existing faces that are seen from the same side and whose planes
 * turn by at most `degrees`, 0 to 180, from one to the other. Contours (seen
 * from different sides, or the other face does not exist), borders, edges of
 * more than two faces and implied edges stay. HSR_E_NOMEM. */
enum hsr_status hsr_drawing_crease(struct hsr_drawing *drawing,
                                   const struct hsr_world *world,
                                   const struct hsr_view *view, double degrees,
                                   struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
