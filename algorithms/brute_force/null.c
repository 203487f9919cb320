/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Nothing at all: what the harness itself costs. */
#include "algorithms/algorithm.h"

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  (void)job;
  (void)err;
  return HSR_OK;
}

const struct hsr_algorithm HSR_ALGORITHM(null) = {
    .name = "null",
    .title = "Nothing",
    .authors = "hsr",
    .source = "draws nothing; measures the harness",
    .taxonomy = HSR_YARDSTICK,
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}},
    .flags = HSR_NO_PICTURE,
    .render = render};
