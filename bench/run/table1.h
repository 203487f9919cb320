/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Table I of the survey, for all commands that show it. */
#ifndef HSR_BENCH_RUN_TABLE1_H
#define HSR_BENCH_RUN_TABLE1_H

#include "common/statistics/statistics.h"
#include "common/view/view.h"

/* Measures Table I of a view. It draws the picture to learn what is visible. */
enum hsr_status measure_table1(const struct hsr_world *world,
                               const struct hsr_view *view,
                               struct hsr_table1 *table, struct hsr_error *err);

#endif
