/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Vertices that no face uses. They may be anything, as in files of scanners,
 * where a point that was not found is "nan". */
#ifndef HSR_COMMON_SCENE_UNUSED_H
#define HSR_COMMON_SCENE_UNUSED_H

#include "common/scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Moves vertices that no face uses, and that have a coordinate which is not
 * finite or too large, onto a vertex of a face. They keep their numbers. *n
 * becomes how many. HSR_E_INPUT if a face uses one: *vertex and *face say
 * which. */
enum hsr_status hsr_object_settle_unused(struct hsr_object *object, int threads,
                                         uint32_t *n, uint32_t *vertex,
                                         uint32_t *face);

#ifdef __cplusplus
}
#endif
#endif
