/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What all that tile with masks begin with: the tables, and where the samples
 * of a picture are, filtered or not. */
#ifndef HSR_ALGORITHMS_TILING_SAMPLING_H
#define HSR_ALGORITHMS_TILING_SAMPLING_H

#include "algorithms/tiling/canvas.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { HSR_PATTERNS = HSR_MOST_PATTERNS + 1 }; /* the last one is no jitter */

struct hsr_sampling {
  struct hsr_triage_tables tables;
  struct hsr_mask_places places[HSR_PATTERNS];
  struct hsr_kernel cosine;
};

/* HSR_E_NOMEM; freed with hsr_sampling_free also then. */
enum hsr_status HSR_OF_BUILD(hsr_sampling_init)(struct hsr_sampling *sampling,
                                                int intervals,
                                                struct hsr_error *err);
void HSR_OF_BUILD(hsr_sampling_free)(struct hsr_sampling *sampling);

/* The view of the samples of a job: the sub-samples, if it is filtered. */
struct hsr_view HSR_OF_BUILD(hsr_sampling_view)(const struct hsr_job *job);

/* The first of the patterns that a job needs. */
int HSR_OF_BUILD(hsr_sampling_first)(const struct hsr_job *job);

/* Makes ready the masks for that view, with `most` lines a polygon, and the
 * canvas. HSR_E_NOMEM. */
enum hsr_status HSR_OF_BUILD(hsr_sampling_begin)(
    const struct hsr_sampling *sampling, const struct hsr_job *job,
    const struct hsr_view *view, uint32_t most, struct hsr_masks *masks,
    struct hsr_mask_work *work, struct hsr_canvas *canvas);

#ifdef __cplusplus
}
#endif
#endif
