/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Printing JSON with jansson. */
#ifndef HSR_BENCH_JSON_H
#define HSR_BENCH_JSON_H

#include "common/base/status.h"

#include <jansson.h>

/* A number, or null for one that is not finite: not measured. */
json_t *number_or_null(double x);

/* Appends a value, giving up the caller's reference to it. Where that fails, or
 * the value is NULL, *array is freed and becomes NULL, so that the failure
 * reaches json_print. */
void json_append(json_t **array, json_t *value);

/* Prints a value and a newline on stdout, and gives up the caller's reference.
 * NULL, the sign that it could not be built, is HSR_E_NOMEM. */
enum hsr_status json_print(json_t *value, struct hsr_error *err);

#endif
