/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command's list with algorithms/EXAMPLE.c on it. */
#include "algorithms/algorithm.h"

#define HSR_LISTED(id)                                                         \
  extern const struct hsr_algorithm hsr_algorithm_##id, hsr_counting_##id;
HSR_LISTED(oracle)
HSR_LISTED(zbuffer)
HSR_LISTED(example)
#undef HSR_LISTED

#define HSR_LISTED(id) {&hsr_algorithm_##id, &hsr_counting_##id},
const struct hsr_listed hsr_algorithms[] = {
    HSR_LISTED(oracle) HSR_LISTED(zbuffer) HSR_LISTED(example){NULL, NULL}};
