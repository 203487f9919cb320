/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kind of answer "ids": the visible face of every sample
 * (docs/correct-picture.md). */
#ifndef HSR_COMMON_ANSWERS_KINDS_IDS_H
#define HSR_COMMON_ANSWERS_KINDS_IDS_H

#include "common/answers/answer.h"

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(protected) /* for modules: hsr-module.h */

#define HSR_IDS (&hsr_answer_ids)

/* The m * n ids of an answer, by rows. They are the answer's own. NULL if it is of
 * another kind. */
uint32_t *hsr_answer_ids_of(const struct hsr_answer *answer);

/* An answer around m x n ids that the caller owns. It is not to be freed. */
struct hsr_answer hsr_answer_of_ids(uint32_t *ids, int m, int n);

/* Writes the ids of an answer of this kind as a .npy file: uint32, by rows from
 * the top, HSR_BACKGROUND where there is no face. Errors as hsr_npy_write. */
enum hsr_status hsr_answer_write_ids(const struct hsr_answer *answer,
                                     const char *path, struct hsr_error *err);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif
#endif
