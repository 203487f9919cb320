/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which algorithm is cheapest, by faces and by depth complexity; and how costs grow
 * with each of the two alone, beside the survey's formulas. It takes views of any
 * scenes, such as hsr generate makes. */
#ifndef HSR_BENCH_TABLES_MAP_H
#define HSR_BENCH_TABLES_MAP_H

#include "algorithms/prices.h"
#include "bench/results/results.h"

/* Prints the map. Both are borrowed. HSR_E_INPUT: no view of the results has
 * Table I; HSR_E_NOMEM. */
enum hsr_status map_print(const struct results *results,
                          const struct hsr_prices *prices,
                          struct hsr_error *err);

#endif
