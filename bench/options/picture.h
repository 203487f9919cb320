/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Options of how pictures and drawings are made. */
#ifndef HSR_BENCH_OPTIONS_PICTURE_H
#define HSR_BENCH_OPTIONS_PICTURE_H

#include "bench/options/parser.h"
#include "common/answers/kinds/area.h"

/* --filter of area pictures: a name of hsr_area_filters. */
error_t parse_area_filter(enum hsr_area_filter *filter, const char *arg,
                          struct option_base *base);

#endif
