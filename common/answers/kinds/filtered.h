/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The kind of answer "filtered": weighted sums of samples
 * (docs/filtered-picture.md). */
#ifndef HSR_COMMON_ANSWERS_KINDS_FILTERED_H
#define HSR_COMMON_ANSWERS_KINDS_FILTERED_H

#include "common/answers/answer.h"
#include "common/answers/filter.h"

#ifdef __cplusplus
extern "C" {
#endif

#define HSR_FILTERED (&hsr_answer_filtered)

/* The 3 m n sums of an answer: red, green and blue of each pixel, by rows. They
 * are the answer's own. NULL if it is of another kind. */
uint32_t *hsr_answer_sums_of(const struct hsr_answer *answer);

/* For an algorithm that makes this kind itself: the words of a filter; and those of
 * the filters whose pixels are one mask of 64 sub-samples. */
#define HSR_WORD_OF(filter) (1u << ((filter)-1))
#define HSR_WORDS_OF_64                                                        \
  (HSR_WORD_OF(HSR_FILTER_BOX) | HSR_WORD_OF(HSR_FILTER_COSINE) |              \
   HSR_WORD_OF(HSR_FILTER_FIELD))

/* How a picture of this form is filtered; the filter is HSR_FILTER_NONE if the
 * form is of another kind. */
struct hsr_filtering hsr_form_filtering(const struct hsr_form *form);

#ifdef __cplusplus
}
#endif
#endif
