/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command's list with algorithms/EXAMPLE.c on it. */
#include "bench/modules/modules.h"

extern const struct hsr_algorithm hsr_counting_oracle,
    hsr_algorithm_zbuffer_fast, hsr_counting_zbuffer_fast,
    hsr_algorithm_example, hsr_counting_example;

const struct hsr_listed hsr_modules[] = {
    {&hsr_counting_oracle, &hsr_counting_oracle},
    {&hsr_algorithm_zbuffer_fast, &hsr_counting_zbuffer_fast},
    {&hsr_algorithm_example, &hsr_counting_example},
    {NULL, NULL}};
