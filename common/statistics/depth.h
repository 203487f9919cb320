/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Beside Table I: the depth complexity sample by sample, and how many pairs of
 * faces overlap in one direction.
 *
 * Source      Sutherland et al. 1974, appendix A, "Definition of
 *             Environments": D_c is a mean, and in the harbor the number varies
 *             from one to quite high; appendix B: two faces overlap in a
 *             direction with the probability f = 2 H_f / n, the same in X, Y
 *             and Z if the environment is isotropic. */
#ifndef HSR_COMMON_DEPTH_H
#define HSR_COMMON_DEPTH_H

#include "common/view/view.h"
#include "common/scene/world.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Probabilities that two relevant faces overlap: share a column, a row, a
 * depth. NAN if there are fewer than two. */
struct hsr_overlaps {
  double f_x, f_y, f_z;
};

/* The relevant faces that cover each sample of the whole picture, whatever the
 * view's window: at depth[j * m + i]. HSR_E_NOMEM. */
enum hsr_status hsr_depth_complexity(const struct hsr_world *world,
                                     const struct hsr_view *view,
                                     uint32_t *depth, struct hsr_error *err);

/* X and Y by the samples that a face's box holds, Z by all depths of the face.
 * HSR_E_NOMEM. */
enum hsr_status hsr_overlaps_measure(const struct hsr_world *world,
                                     const struct hsr_view *view,
                                     struct hsr_overlaps *overlaps,
                                     struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
