/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The right filtered picture: the plain loop of docs/filtered-picture.md over
 * sub-samples that the oracle draws. It takes from the core only what the
 * definition fixes: weights, places and colours. */
#ifndef HSR_BENCH_JUDGE_FILTERED_H
#define HSR_BENCH_JUDGE_FILTERED_H

#include "algorithms/setup.h"
#include "common/answers/filter.h"

/* Finds the sums of the pixels k for which wanted[k] is set, of m * n; of all
 * pixels if `wanted` is NULL. The sums of other pixels are not defined. `oracle`
 * draws ids. HSR_E_NOMEM, or whatever the oracle fails with. */
enum hsr_status judge_sums(const struct hsr_setup *oracle,
                           const struct hsr_filtering *filtering,
                           const struct hsr_view *view, const bool *wanted,
                           uint32_t *sums, struct hsr_error *err);

/* The same into an answer, whose form says how it is filtered. */
enum hsr_status judge_filtered(const struct hsr_setup *oracle,
                               const struct hsr_view *view, const bool *wanted,
                               struct hsr_answer *answer,
                               struct hsr_error *err);

#endif
