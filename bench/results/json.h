/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Printing JSON with jansson. */
#ifndef HSR_BENCH_JSON_H
#define HSR_BENCH_JSON_H

#include "common/base/status.h"
#include "common/files/json.h"

/* A number; or null if x is not finite, which means not measured. */
json_t *number_or_null(double x);

/* Prints a value and a newline on stdout, and takes the caller's reference.
 * NULL means that the value could not be built, and gives HSR_E_NOMEM. */
enum hsr_status json_print(json_t *value, struct hsr_error *err);

#endif
