/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which edges of a drawing show a shape: creases, borders and contours. The
 * others are seams of a smooth surface that is cut into faces. */
#ifndef HSR_COMMON_CREASE_H
#define HSR_COMMON_CREASE_H

#include "common/lines/drawing.h"
#include "common/view/view.h"
#include "common/scene/world.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Removes the seams from a drawing, which is in the order of the definition. A
 * seam is an edge of exactly two existing faces that are seen from the same
 * side, and whose planes differ by at most `degrees`, 0 to 180. Contours (the
 * faces are seen from different sides, or one does not exist), borders, edges
 * of more than two faces and implied edges stay. HSR_E_NOMEM. */
enum hsr_status hsr_drawing_crease(struct hsr_drawing *drawing,
                                   const struct hsr_world *world,
                                   const struct hsr_view *view, double degrees,
                                   struct hsr_error *err);

/* How many edges of a drawing are such seams, of how many. HSR_E_NOMEM. */
enum hsr_status hsr_drawing_count_seams(const struct hsr_drawing *drawing,
                                        const struct hsr_world *world,
                                        const struct hsr_view *view,
                                        double degrees, size_t *seams,
                                        size_t *edges, struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
