/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The exact area picture (docs/area-picture.md), and how much of each pixel
 * shows which face. */
#ifndef HSR_BENCH_JUDGE_AREAS_AREAS_H
#define HSR_BENCH_JUDGE_AREAS_AREAS_H

#include "common/answers/answer.h"
#include "common/answers/kinds/area.h"

#include <gmp.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The share that a face has of a pixel's value: the integral of the filter over
 * the points that show it, divided by that over the screen. */
struct area_part {
  uint32_t face; /* of the world; HSR_BACKGROUND */
  mpq_t share;   /* over 0, 1 at most; canonical */
};

/* Takes the parts of pixel (i, j), which are borrowed for the call: each face
 * once, ascending, the background last. The shares add up to 1. A status other
 * than HSR_OK ends the work. */
typedef enum hsr_status area_visitor(void *to, int i, int j,
                                     const struct area_part *part, size_t n);

/* Visits the pixels of the view's window, row by row. The world is laid out.
 * HSR_E_NOMEM, or what the visitor returns. */
enum hsr_status visit_areas(const struct hsr_world *world,
                            const struct hsr_view *view,
                            enum hsr_area_filter filter, area_visitor *visit,
                            void *to, struct hsr_error *err);

#ifdef __cplusplus
} /* extern "C" */

#include <memory>
#include <vector>

namespace areas {

struct box;

/* Where the images of all faces of a world are in a view. Kept from one window
 * to the next; threads may share it. */
std::shared_ptr<const std::vector<box>> find_boxes(const hsr_world &world,
                                                   const hsr_view &view);

/* Bounds of the pixels in the view's window: 3 a pixel, those of (i, j) at
 * bounds[3 * (j * m + i)]. They are the tightest ones, unless a shader varies
 * the colours: then they are enclosures (shaded.h). */
void find_bounds(const hsr_world &world, const hsr_view &view,
                 const hsr_area_form &form, const std::vector<box> &boxes,
                 hsr_area_bounds *bounds);

} // namespace areas
#endif
#endif
