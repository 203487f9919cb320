/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kind of answer "polygons": the visible polygons
 * (docs/visible-polygons.md). */
#ifndef HSR_COMMON_ANSWERS_KINDS_POLYGONS_H
#define HSR_COMMON_ANSWERS_KINDS_POLYGONS_H

#include "common/answers/answer.h"
#include "common/lines/polygons.h"

#ifdef __cplusplus
extern "C" {
#endif

#define HSR_POLYGONS (&hsr_answer_polygons)

/* The polygons of an answer. They are the answer's own. NULL if it is of another
 * kind. */
struct hsr_polygons *hsr_answer_polygons_of(const struct hsr_answer *answer);

#ifdef __cplusplus
}
#endif
#endif
