/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the suite computes in rationals. */
#ifndef HSR_BENCH_SUITE_EXACT_H
#define HSR_BENCH_SUITE_EXACT_H

#include "common/scene/world.h"
#include "common/view/view.h"

/* Fills depth[j m + i] with the depth t of face ids[j m + i] at the sample,
 * rounded to the nearest double; +infinity where there is no face. HSR_E_NOMEM.
 */
enum hsr_status exact_depths(const struct hsr_world *world,
                             const struct hsr_view *view, const uint32_t *ids,
                             double *depth, struct hsr_error *err);

/* Whether a triangle has an area. */
bool exact_has_area(const double corner[3][3]);

#endif
