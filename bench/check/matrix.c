/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What hsr check --matrix prints: a column for each algorithm; or, where a
 * terminal is too narrow for these, each number behind its algorithm's name. */
#include "bench/check/check.h"
#include "bench/terminal/terminal.h"

#include <string.h>

/* Columns of what is told of a scene; of an algorithm, at least. */
enum { SCENE = 48, LEAST = 9 };

static int width_of(const struct check_options *o, int algorithm) {
  int length = (int)strlen(o->algorithm[algorithm].name);
  return length > LEAST ? length : LEAST;
}

static bool fits(const struct check_options *o) {
  int columns = terminal_columns(stdout), width = SCENE;
  for (int a = 0; a < o->n_algorithms; a++)
    width += 1 + width_of(o, a);
  return !columns || width <= columns;
}

void matrix_begin(const struct check_options *o) {
  puts("mismatches; in brackets, of an algorithm that is known to be wrong");
  printf("%-22s %8s %9s %5s ", "scene", "faces", "samples", "views");
  for (int a = 0; a < o->n_algorithms && fits(o); a++)
    printf(" %*s", width_of(o, a), o->algorithm[a].name);
  putchar('\n');
}

/* "0", "(42)", "refused" */
static void say_outcome(const struct scene_run *run, int size, int a,
                        char text[32]) {
  struct outcome outcome = outcome_of(run, size, a);
  bool known = is_known_wrong(run->options, a) && outcome.mismatches;
  if (outcome.worst == RIGHT || outcome.worst == WRONG)
    snprintf(text, 32, known ? "(%llu)" : "%llu",
             (unsigned long long)outcome.mismatches);
  else
    snprintf(text, 32, "%s", verdict_name(outcome.worst));
}

static void print_columns(const struct scene_run *run, int size) {
  const struct check_options *o = run->options;
  for (int a = 0; a < o->n_algorithms; a++) {
    char text[32];
    say_outcome(run, size, a, text);
    printf(" %*s", width_of(o, a), text);
  }
  putchar('\n');
}

static void print_names(const struct scene_run *run, int size) {
  const struct check_options *o = run->options;
  putchar('\n');
  int used = 0;
  for (int a = 0; a < o->n_algorithms; a++) {
    char text[32];
    say_outcome(run, size, a, text);
    int width = (int)(strlen(o->algorithm[a].name) + strlen(text)) + 3;
    if (used && used + width > terminal_columns(stdout)) {
      putchar('\n');
      used = 0;
    }
    used += printf("  %s %s", o->algorithm[a].name, text);
  }
  putchar('\n');
}

void matrix_scene(const struct scene_run *run) {
  const struct check_options *o = run->options;
  for (int size = 0; size < o->n_sizes; size++) {
    char samples[24], name[TERMINAL_NAME];
    snprintf(samples, sizeof samples, "%dx%d", o->m[size], o->n[size]);
    printf("%-22s %8u %9s %5d ", terminal_plain(run->name, name, sizeof name),
           run->world.n_faces, samples, o->n_views);
    if (fits(o))
      print_columns(run, size);
    else
      print_names(run, size);
  }
}
