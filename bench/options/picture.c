/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/options/picture.h"
#include "common/answers/kinds/area.h"

#include <string.h>

error_t parse_area_filter(enum hsr_area_filter *filter, const char *arg,
                          struct option_base *base) {
  for (int k = 0; hsr_area_filters[k].name; k++)
    if (!strcmp(hsr_area_filters[k].name, arg)) {
      *filter = (enum hsr_area_filter)k;
      return 0;
    }
  return option_fail(base, "--filter %s: must be box, tent, quadratic or cubic",
                     arg);
}
