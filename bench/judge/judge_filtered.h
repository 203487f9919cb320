/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a filtered picture should be: the plain loop of
 * docs/filtered-picture.md over sub-samples that the oracle draws. Only the
 * weights, places and colours, which are the definition, are the core's. */
#ifndef HSR_BENCH_JUDGE_FILTERED_H
#define HSR_BENCH_JUDGE_FILTERED_H

#include "bench/command.h"

/* The sums of pixels k, those that `wanted` has, m * n, or NULL: of all; those
 * of others are anything. `oracle` draws ids. HSR_E_NOMEM, or whatever the
 * oracle fails with. */
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
