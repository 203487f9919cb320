/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Everything that -a can name: the oracles, then the algorithms. */
#include "bench/modules/modules.h"

#define HSR_LISTED(id)                                                         \
  extern const struct hsr_algorithm hsr_algorithm_##id, hsr_counting_##id;
#include "bench/modules/oracles.def"
#include "algorithms/list.def"
#undef HSR_LISTED

const struct hsr_listed hsr_modules[] = {
#define HSR_LISTED(id) {&hsr_counting_##id, &hsr_counting_##id},
#include "bench/modules/oracles.def"
#undef HSR_LISTED
#define HSR_LISTED(id) {&hsr_algorithm_##id, &hsr_counting_##id},
#include "algorithms/list.def"
#undef HSR_LISTED
    {NULL, NULL}};
