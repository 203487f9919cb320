/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of whole numbers in text files: lines of numbers, divided by spaces,
 * tabs or commas. What follows a # is left out. */
#ifndef HSR_BENCH_STRANGER_TABLE_H
#define HSR_BENCH_STRANGER_TABLE_H

#include "common/base/status.h"

#include <stddef.h>
#include <stdint.h>

struct table {
  uint32_t *number; /* `columns` a row; the caller's to free */
  size_t rows;
};

/* Reads rows of so many numbers. The word none, in the last column, is
 * UINT32_MAX. table->number is to be freed also after a failure. HSR_E_INPUT,
 * with the line; HSR_E_NOMEM. */
enum hsr_status table_read(const char *path, size_t columns,
                           struct table *table, struct hsr_error *err);

#endif
