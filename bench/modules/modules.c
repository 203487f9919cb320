/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/modules/modules.h"

#include <pthread.h>
#include <string.h>

static pthread_once_t once = PTHREAD_ONCE_INIT;
static const struct hsr_listed *all;

/* The program's, and then those that are added. */
enum { MOST = 160 };
static struct hsr_listed together[MOST + 1];
static int n_together;

static void put_together(void) {
  if (!n_together)
    while (n_together < MOST && hsr_modules[n_together].plain) {
      together[n_together] = hsr_modules[n_together];
      n_together++;
    }
}

static void register_all(void) {
  put_together();
  all = hsr_register(together);
}

enum hsr_adding hsr_modules_add(const struct hsr_listed *module) {
  static int added;
  put_together();
  for (int k = 0; k < n_together; k++)
    if (!strcmp(together[k].plain->name, module->plain->name))
      return HSR_MODULE_TAKEN;
  if (added == HSR_MOST_OUTSIDE || n_together == MOST)
    return HSR_MODULE_FULL;
  added++;
  together[n_together++] = *module;
  return HSR_MODULE_ADDED;
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
