/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kind of answer "shadowed": the visible face of every sample, and whether
 * light reaches it (docs/shadow-picture.md). */
#ifndef HSR_COMMON_ANSWERS_KINDS_SHADOWED_H
#define HSR_COMMON_ANSWERS_KINDS_SHADOWED_H

#include "common/answers/answer.h"

#ifdef __cplusplus
extern "C" {
#endif

#define HSR_SHADOWED (&hsr_answer_shadowed)

/* m * n ids by rows, and whether light reaches each; false where there is no
 * face. */
struct hsr_shadowed {
  uint32_t *ids;
  bool *lit;
};

/* The body of an answer, and its lit[]. They are the answer's own. NULL if it is
 * of another kind. */
struct hsr_shadowed *hsr_answer_shadowed_of(const struct hsr_answer *answer);
bool *hsr_answer_lit_of(const struct hsr_answer *answer);

#ifdef __cplusplus
}
#endif
#endif
