/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command's lists with one more line: the kind of answer of layers.c. */
#include "bench/modules/modules.h"

extern const struct hsr_answer_type hsr_answer_layers;
extern const struct hsr_algorithm hsr_algorithm_layer_oracle,
    hsr_algorithm_layer_count, hsr_algorithm_layer_half;
extern const struct hsr_algorithm hsr_counting_oracle,
    hsr_algorithm_zbuffer_fast, hsr_counting_zbuffer_fast;

const struct hsr_answer_type *const hsr_answer_types[] = {
#define HSR_ANSWER(id) &hsr_answer_##id,
#include "common/answers/list.def"
    HSR_ANSWER(layers)
#undef HSR_ANSWER
        NULL};

#define BOTH(id)                                                               \
  { &hsr_algorithm_layer_##id, &hsr_algorithm_layer_##id }
const struct hsr_listed hsr_modules[] = {
    {&hsr_counting_oracle, &hsr_counting_oracle},
    {&hsr_algorithm_zbuffer_fast, &hsr_counting_zbuffer_fast},
    BOTH(oracle),
    BOTH(count),
    BOTH(half),
    {NULL, NULL}};
