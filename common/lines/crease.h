/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Removing seams from a drawing. Seams are edges between the faces that
 * approximate a smooth surface. The other edges show a shape: creases, borders
 * and contours. */
#ifndef HSR_COMMON_CREASE_H
#define HSR_COMMON_CREASE_H

#include "common/lines/drawing.h"
#include "common/view/view.h"
#include "common/scene/world.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Removes the seams from a drawing, which is in the order of the definition
 * (hsr_drawing_sort). A seam is an edge of exactly two faces. Both exist in the
 * view and are seen from the same side, and their planes differ by at most
 * `degrees`, 0 to 180. So contours stay, where the faces are seen from
 * different sides or one does not exist. Borders, edges of more than two faces
 * and implied edges stay too. HSR_E_NOMEM. */
enum hsr_status hsr_drawing_crease(struct hsr_drawing *drawing,
                                   const struct hsr_world *world,
                                   const struct hsr_view *view, double degrees,
                                   struct hsr_error *err);

/* The edges of a drawing: all, the seams, and the borders, which one face has. */
struct hsr_edge_counts {
  size_t edges, seams, borders;
};

/* Counts them. *counts is written in full. HSR_E_NOMEM. */
enum hsr_status hsr_drawing_count_edges(const struct hsr_drawing *drawing,
                                        const struct hsr_world *world,
                                        const struct hsr_view *view,
                                        double degrees,
                                        struct hsr_edge_counts *counts,
                                        struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
