/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kept samples of a grid as a block of voxels, which is what renderers of
 * volumes take. */
#ifndef HSR_BENCH_PEERS_SHARED_SAMPLES_H
#define HSR_BENCH_PEERS_SHARED_SAMPLES_H

#include "algorithms/setup.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The mean distance of cells along an axis, and whether, but for rounding, all
 * cells and samples are equally far apart. */
double grid_spacing(const struct hsr_grid *grid, int axis);
bool grid_is_even(const struct hsr_grid *grid);

enum { SAMPLES_AROUND = 2 }; /* clear voxels on each side of the grid */

/* What each sample looks like as a splat, in one view: docs/
 * composited-picture.md. Voxel (i, j, k) is at i + n[0] (j + n[1] k). */
struct samples {
  int n[3];
  size_t count;                /* of voxels */
  double first[3], spacing[3]; /* where voxel (0, 0, 0) is; from one to the
                                  next */
  float *opacity;              /* 0 to 1; 0 of what is not kept */
  uint8_t (*rgba)[4]; /* the same in bytes, and the lit colour, linear, not
                          multiplied by it. A voxel that is not kept has the
                          mean colour of those around it, so that colours
                          between two voxels are right */
};

/* HSR_E_REFUSED for a grid that is not even; HSR_E_NOMEM. *samples is freed
 * also after a failure. `answer` is of the composited kind, of this setup. */
enum hsr_status samples_init(struct samples *samples,
                             const struct hsr_setup *setup,
                             const struct hsr_view *view,
                             struct hsr_answer *answer, struct hsr_error *err);
void samples_free(struct samples *samples);

/* How many cells a ray passes per unit of length, along the view's middle. */
double samples_cells_per_length(const struct samples *samples,
                                const struct hsr_view *view);

#ifdef __cplusplus
}
#endif
#endif
