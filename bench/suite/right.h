/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The right answers of a scene file, through hsr.h. */
#ifndef HSR_BENCH_SUITE_RIGHT_H
#define HSR_BENCH_SUITE_RIGHT_H

#include "common/base/status.h"

#include <stddef.h>
#include <stdint.h>

struct right; /* a scene that is open */

/* Opens a file. *right is the caller's to close. Errors as hsr_open. */
enum hsr_status right_open(const char *path, struct right **right,
                           struct hsr_error *err);
void right_close(struct right *right); /* NULL is allowed */

/* Fills the caller's array of m n ids with those of the oracle, for view number
 * `view` of the file, from 0. HSR_E_STOPPED after Ctrl-C. */
enum hsr_status right_ids(const struct right *right, uint32_t view, int m,
                          int n, uint32_t *ids, struct hsr_error *err);

/* The intervals of the oracle's line drawing, SEGMENT_COLUMNS numbers each: 1
 * if the edge is implied, else 0; a, b, part; the invisibility; t0, t1; the
 * ends. *row is the caller's to free. */
enum { SEGMENT_COLUMNS = 13 };
enum hsr_status right_segments(const struct right *right, uint32_t view, int m,
                               int n, double **row, size_t *n_rows,
                               struct hsr_error *err);

#endif
