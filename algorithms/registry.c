/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/algorithm.h"

#include <string.h>

const struct hsr_listed *hsr_algorithm_find(const char *name) {
  for (const struct hsr_listed *a = hsr_algorithms; a->plain; a++)
    if (!strcmp(a->plain->name, name))
      return a;
  return NULL;
}
