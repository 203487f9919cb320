/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/modules/modules.h"

#include <pthread.h>
#include <string.h>

static pthread_once_t once = PTHREAD_ONCE_INIT;
static const struct hsr_listed *all;

static void register_all(void) {
  all = hsr_register(hsr_modules);
}

const struct hsr_listed *hsr_algorithms(void) {
  pthread_once(&once, register_all);
  return all;
}

const struct hsr_listed *hsr_algorithm_find(const char *name) {
  for (const struct hsr_listed *a = hsr_algorithms(); a->plain; a++)
    if (!strcmp(a->plain->name, name))
      return a;
  return NULL;
}
