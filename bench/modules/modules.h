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

/* The same, registered, in the same order. May be called by several threads. */
const struct hsr_listed *hsr_algorithms(void);

/* The one of that name, or NULL. */
const struct hsr_listed *hsr_algorithm_find(const char *name);

#ifdef __cplusplus
}
#endif
#endif
