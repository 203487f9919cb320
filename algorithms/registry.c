/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/algorithm.h"

#include <string.h>

#define HSR_LISTED(id)                                                         \
  extern const struct hsr_algorithm hsr_algorithm_##id, hsr_counting_##id;
#include "algorithms/list.def"
#undef HSR_LISTED

const struct hsr_listed hsr_algorithms[] = {
#define HSR_LISTED(id) {&hsr_algorithm_##id, &hsr_counting_##id},
#include "algorithms/list.def"
#undef HSR_LISTED
    {NULL, NULL}};

const struct hsr_listed *hsr_algorithm_find(const char *name) {
  for (const struct hsr_listed *a = hsr_algorithms; a->plain; a++)
    if (!strcmp(a->plain->name, name))
      return a;
  return NULL;
}
