/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/check/check.h"
#include "bench/terminal/terminal.h"

#include <string.h>

static int width_of(const struct check_options *o, int algorithm) {
  int length = (int)strlen(o->algorithm[algorithm].name);
  return length > 9 ? length : 9;
}

void matrix_begin(const struct check_options *o) {
  printf("%-22s %8s %9s %5s ", "scene", "faces", "samples", "views");
  for (int a = 0; a < o->n_algorithms; a++)
    printf(" %9s", o->algorithm[a].name);
  puts("   mismatches");
}

void matrix_scene(const struct scene_run *run) {
  const struct check_options *o = run->options;
  for (int size = 0; size < o->n_sizes; size++) {
    char samples[24], name[TERMINAL_NAME];
    snprintf(samples, sizeof samples, "%dx%d", o->m[size], o->n[size]);
    printf("%-22s %8u %9s %5d ", terminal_plain(run->name, name, sizeof name),
           run->world.n_faces, samples, o->n_views);
    for (int a = 0; a < o->n_algorithms; a++) {
      struct outcome outcome = outcome_of(run, size, a);
      bool known = is_known_wrong(o, a) && outcome.mismatches;
      char cell[32];
      snprintf(cell, sizeof cell, known ? "(%llu)" : "%llu",
               (unsigned long long)outcome.mismatches);
      if (outcome.worst == RIGHT || outcome.worst == WRONG)
        printf(" %*s", width_of(o, a), cell);
      else
        printf(" %*s", width_of(o, a), verdict_name(outcome.worst));
    }
    putchar('\n');
  }
}
