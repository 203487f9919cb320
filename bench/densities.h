/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The densities of a volume, for hsr stats. */
#ifndef HSR_BENCH_DENSITIES_H
#define HSR_BENCH_DENSITIES_H

#include "common/grids/densities.h"

#include <jansson.h>

/* Prints the range, percentiles, the standard threshold and a histogram. */
void print_densities(const struct hsr_densities *densities);

/* The same as a new reference. NULL for lack of memory. */
json_t *densities_json(const struct hsr_densities *densities);

#endif
