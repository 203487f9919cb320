/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What an algorithm's descriptor says, as hsr list and hsr tables show it. */
#ifndef HSR_BENCH_RESULTS_DESCRIPTOR_H
#define HSR_BENCH_RESULTS_DESCRIPTOR_H

#include "algorithms/algorithm.h"

#include <jansson.h>

/* A place in figure 13: "image space", "area sampling". branch is NULL if the
 * class has no branches. */
struct taxonomy {
  const char *class, *branch;
};
struct taxonomy taxonomy(enum hsr_branch branch);

/* New references, or NULL for lack of memory. */
json_t *restrictions_json(const struct hsr_algorithm *algorithm);
json_t *lifted_json(const struct hsr_algorithm *algorithm);
json_t *algorithms_json(void); /* of all algorithms */
json_t *sorts_json(const struct hsr_algorithm *algorithm);
json_t *terms_json(const struct hsr_algorithm *algorithm,
                   const struct hsr_step *step,
                   const struct hsr_prices *prices);

#endif
