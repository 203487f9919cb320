/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The depths of a picture as doubles; struct hsr_picture has floats. */
#ifndef HSR_COMMON_VIEW_DEPTHS_H
#define HSR_COMMON_VIEW_DEPTHS_H

#include "common/view/picture.h"

#ifdef __cplusplus
extern "C" {
#endif

/* As hsr_picture_depth, which rounds these. */
void hsr_picture_depths(const struct hsr_world *world,
                        const struct hsr_view *view, const uint32_t *ids,
                        double *depth);

#ifdef __cplusplus
}
#endif
#endif
