/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kind of answer "voxels": the solid that each voxel is in
 * (docs/solid-voxels.md). */
#ifndef HSR_COMMON_ANSWERS_KINDS_VOXELS_H
#define HSR_COMMON_ANSWERS_KINDS_VOXELS_H

#include "common/answers/answer.h"
#include "common/voxels/voxels.h"

#ifdef __cplusplus
extern "C" {
#endif

#define HSR_VOXELS (&hsr_answer_voxels)

/* The voxels of an answer. They are the answer's own. NULL if it is of another
 * kind. */
struct hsr_solid_voxels *hsr_answer_voxels_of(const struct hsr_answer *answer);

/* For a form of this kind: how many voxels lie along the longest side of the
 * scene's box. */
int hsr_form_voxels(const struct hsr_form *form);

#ifdef __cplusplus
}
#endif
#endif
