/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Other prices of comparisons than the standard ones: hsr tables --prices. */
#ifndef HSR_BENCH_TABLES_PRICES_H
#define HSR_BENCH_TABLES_PRICES_H

#include "algorithms/prices.h"
#include "common/base/status.h"

#include <stdbool.h>

/* Reads a file: an object of JSON with a price for each kind that it names,
 * {"box": 100}. The other kinds keep their standard prices. HSR_E_INPUT if the
 * file is not there, is no such object, names a kind that there is not, or has a
 * price that is no number from 0 on; HSR_E_NOMEM. */
enum hsr_status prices_read(struct hsr_prices *prices, const char *path,
                            struct hsr_error *err);

bool prices_are_standard(const struct hsr_prices *prices);

#endif
