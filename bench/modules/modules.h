/* SPDX-License-Identifier: GPL-3.0-or-later */
/* All algorithms that can be named. */
#ifndef HSR_BENCH_MODULES_H
#define HSR_BENCH_MODULES_H

#include "algorithms/algorithm.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Their descriptors, ended by .plain == NULL: the program's own list, or that of
 * list.c, the oracles before the algorithms of list.def. */
extern const struct hsr_listed hsr_modules[];

/* Adds one that is not in this program, to be called before hsr_algorithms. */
enum { HSR_MOST_OUTSIDE = 16 };
enum hsr_adding { HSR_MODULE_ADDED, HSR_MODULE_TAKEN, HSR_MODULE_FULL };
enum hsr_adding hsr_modules_add(const struct hsr_listed *module);

/* The same, registered, in the same order. May be called by several threads. */
const struct hsr_listed *hsr_algorithms(void);

/* The one of that name, or NULL. */
const struct hsr_listed *hsr_algorithm_find(const char *name);

#ifdef __cplusplus
}
#endif
#endif
