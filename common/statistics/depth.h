/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Statistics beside Table I: the depth complexity of each sample, and the
 * probability that two faces overlap in one direction.
 *
 * Source      Sutherland et al. 1974. Appendix A, "Definition of Environments":
 *             D_c is a mean; in the harbor, the number varies from one to quite
 *             high. Appendix B: two faces overlap in a direction with the
 *             probability f = 2 H_f / n, which is the same in X, Y and Z if the
 *             environment is isotropic. */
#ifndef HSR_COMMON_DEPTH_H
#define HSR_COMMON_DEPTH_H

#include "common/view/view.h"
#include "common/scene/world.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The parts, 0..1, of the pairs of relevant faces that overlap: that share a
 * column (f_x), a row (f_y), a depth (f_z). NAN if there are fewer than two
 * relevant faces. */
struct hsr_overlaps {
  double f_x, f_y, f_z;
};

/* Counts the relevant faces that cover each sample of the whole picture,
 * whatever the view's window. The number for sample (i, j) is depth[j * m + i],
 * in an array of the caller with m * n elements. HSR_E_NOMEM. */
enum hsr_status hsr_depth_complexity(const struct hsr_world *world,
                                     const struct hsr_view *view,
                                     uint32_t *depth, struct hsr_error *err);

/* Measures the overlaps in the whole picture. In X and Y, the extent of a face
 * is the columns and rows of its bounds. In Z, it is the range of all its
 * depths. HSR_E_NOMEM. */
enum hsr_status hsr_overlaps_measure(const struct hsr_world *world,
                                     const struct hsr_view *view,
                                     struct hsr_overlaps *overlaps,
                                     struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
