/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kind of answer "composited": the splats of a grid, composited
 * (docs/composited-picture.md). */
#ifndef HSR_COMMON_ANSWERS_KINDS_COMPOSITED_H
#define HSR_COMMON_ANSWERS_KINDS_COMPOSITED_H

#include "common/answers/answer.h"
#include "common/grids/splatting.h"

#ifdef __cplusplus
extern "C" {
#endif

#define HSR_COMPOSITED (&hsr_answer_composited)

/* The 4 m n channels of an answer: premultiplied red, green and blue, and opacity,
 * of each pixel, by rows; 65535 is 1. They are the answer's own. NULL if it is of
 * another kind. */
uint16_t *hsr_answer_rgba_of(const struct hsr_answer *answer);

/* The 5 m n sums of an answer that is to be added up from parts: red, green, blue,
 * opacity and the weight, which is counted with `normalise` alone. NULL: it has
 * none. */
enum { HSR_SPLAT_SUMS = 5 };
uint64_t *hsr_answer_splat_sums_of(const struct hsr_answer *answer);

/* For a form of this kind: how the picture is splatted. */
struct hsr_splatting hsr_form_splatting(const struct hsr_form *form);

/* Chooses another exposure, from 0 to 1000. */
void hsr_form_expose(struct hsr_form *form, double exposure);

#ifdef __cplusplus
}
#endif
#endif
