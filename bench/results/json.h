/* SPDX-License-Identifier: GPL-3.0-or-later */
/* JSON with jansson: what several commands print. */
#ifndef HSR_BENCH_JSON_H
#define HSR_BENCH_JSON_H

#include "common/base/status.h"
#include "common/files/json/json.h"

struct cell;

/* A number; or null if x is not finite, which means not measured. */
json_t *number_or_null(double x);

/* The names of the adapters that changed the scene for a cell's algorithm. */
json_t *adapted_json(const struct cell *cell);

/* Prints a value and a newline on stdout, and takes the caller's reference.
 * NULL means that the value could not be built, and gives HSR_E_NOMEM. */
enum hsr_status json_print(json_t *value, struct hsr_error *err);

#endif
