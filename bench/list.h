/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Between the files of hsr list. */
#ifndef HSR_BENCH_LIST_H
#define HSR_BENCH_LIST_H

#include "common/base/option.h"
#include "common/base/status.h"

/* Prints what an option is, and its words or its range with the standard one. */
void list_print_option(const struct hsr_option *option);

/* What restriction number k of common/adapt/adapt.h demands of a scene, in words.
 * Static. */
const char *list_demand(int k);

/* Prints "what" in a column of its own, and what that means. */
void list_print_meaning(const char *what, const char *meaning);

/* Tells all of one algorithm, or of one palette (bench/list_one.c). HSR_E_USAGE:
 * there is none of that name. */
enum hsr_status list_one(const char *name, struct hsr_error *err);

#endif
