/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kind of answer "segments": every edge in intervals of one quantitative
 * invisibility (docs/correct-drawing.md). */
#ifndef HSR_COMMON_ANSWERS_KINDS_SEGMENTS_H
#define HSR_COMMON_ANSWERS_KINDS_SEGMENTS_H

#include "common/answers/answer.h"
#include "common/lines/drawing.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(protected) /* for modules: hsr-module.h */

#define HSR_SEGMENTS (&hsr_answer_segments)

/* The drawing of an answer. It is the answer's own. NULL if it is of another
 * kind. */
struct hsr_drawing *hsr_answer_drawing_of(const struct hsr_answer *answer);

/* An answer around a drawing that the caller owns. It is not to be freed. */
struct hsr_answer hsr_answer_of_drawing(struct hsr_drawing *drawing, int m,
                                        int n);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif
#endif
