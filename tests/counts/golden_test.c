/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The counts of every module on small scenes, against those that a person last
 * looked at: golden/NAME.txt, a line for each scene, view and counter; of
 * a variant NAME.OPTION=VALUE.txt.
 * What takes grids only is counted on grids. What makes further kinds of answers
 * is counted when it makes those as well: SCENE:mix=linear, SCENE:shadows=cast.
 *
 *   golden_test [NAME...]            compares: all, or those modules
 *   golden_test --write [NAME...]    writes the files anew; see `rewrite`
 *
 * A change that alters a count fails here, until its commit has the new figure
 * and says why. */
#include "tests/draw.h"
#include "tests/tap.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

static const char *const scenes[] = {
    "house",        "cyclic-overlap", "penetration", "coplanar",
    "shared-edges", "lattice:40:3",   "near-plane",  "non-convex",
    "deep-stack",   "color-cube:2"};
static const char *const grids[] = {"checker-cube:5", "checker-cube:20",
                                    "grid",           "grid:9:7",
                                    "heights:4",      "checker-plane"};
enum {
  N_SCENES = sizeof scenes / sizeof *scenes,
  N_GRIDS = sizeof grids / sizeof *grids,
  M = 41,
  N = 29,
  VIEWS = 2
};

/* The counts of one view, a line each; or one line if the scene is refused.
 * `choice` is NULL for the standard one. */
static void count_view(const struct hsr_algorithm *a,
                       const struct hsr_choice *choice,
                       const struct both_worlds *worlds, const char *scene,
                       uint32_t number, FILE *out) {
  struct hsr_view view;
  struct hsr_answer answer;
  struct hsr_tally tally = {.trace = NULL};
  if (hsr_view_init(&view, &worlds->scene->views[number], M, N, NULL))
    abort();
  bool drawn = draw_chosen(a, choice, &worlds->world, &view, &answer, &tally);
  hsr_answer_free(&answer);
  if (!drawn)
    fprintf(out, "%s\tview %u\trefused\n", scene, number + 1);
  for (int k = 0; drawn && a->counters && a->counters[k].name; k++)
    fprintf(out, "%s\tview %u\t%s\t%llu\n", scene, number + 1,
            a->counters[k].name, (unsigned long long)tally.count[k]);
}

/* The counts of the first view, for each further kind. */
static void count_also(const struct hsr_algorithm *a,
                       const struct both_worlds *worlds, const char *scene,
                       FILE *out) {
  for (int k = 0; a->also[k]; k++) {
    char name[200];
    struct hsr_choice choice = choose_also(a, a->also[k]);
    const struct hsr_option *first = a->also[k]->options;
    snprintf(name, sizeof name, "%s:%s=%s", scene, first->name,
             first->words[choice.form.values.option[0]].name);
    count_view(a, &choice, worlds, name, 0, out);
  }
}

/* The counts of all scenes, as the file should have them. Owned by the caller.
 */
static char *count_all(const struct hsr_algorithm *a) {
  char *text = NULL;
  size_t size = 0;
  FILE *out = open_memstream(&text, &size);
  bool takes_faces = a->subjects & 1 << HSR_FACES;
  for (int s = 0; out && s < (takes_faces ? N_SCENES : N_GRIDS); s++) {
    struct both_worlds worlds;
    const char *name = takes_faces ? scenes[s] : grids[s];
    open_worlds(&worlds, name);
    for (uint32_t v = 0; v < VIEWS && v < worlds.scene->n_views; v++)
      count_view(a, NULL, &worlds, name, v, out);
    count_also(a, &worlds, name, out);
    close_worlds(&worlds);
  }
  if (!out || fclose(out))
    abort();
  return text;
}

static FILE *open_golden(const struct hsr_algorithm *a, const char *mode) {
  char path[4096];
  const char *source = getenv("HSR_SOURCE");
  snprintf(path, sizeof path, "%s/tests/counts/golden/%s.txt",
           source ? source : ".", a->name);
  for (char *at = path; (at = strchr(at, ':'));)
    *at = '.';
  FILE *file = fopen(path, mode);
  if (!file)
    printf("# %s: %s\n", path, strerror(errno));
  return file;
}

/* The next line of a text, without its newline; NULL after the last one. */
static const char *next_line(char **at) {
  char *line = *at, *end = strchr(line, '\n');
  if (!end)
    return NULL;
  *end = '\0';
  *at = end + 1;
  return line;
}

/* How many lines differ. Prints the first ones. */
static long compare(const struct hsr_algorithm *a, char *counted) {
  FILE *file = open_golden(a, "r");
  if (!file)
    return 1;
  char *line = NULL;
  size_t room = 0;
  long differ = 0;
  ssize_t length;
  do {
    length = getline(&line, &room, file);
    if (length > 0 && line[length - 1] == '\n')
      line[length - 1] = '\0';
    const char *wanted = length < 0 ? "no such line" : line;
    const char *got = next_line(&counted);
    if (!got && length < 0)
      break;
    if ((!got || strcmp(got, wanted)) && ++differ <= 5)
      printf("# %s: counted: %s; golden: %s\n", a->name, got ? got : "nothing",
             wanted);
    if (!got)
      break;
  } while (true);
  free(line);
  fclose(file);
  return differ;
}

static void write_golden(const struct hsr_algorithm *a, const char *counted) {
  FILE *file = open_golden(a, "w");
  if (!file || fputs(counted, file) < 0 || fclose(file))
    exit(99);
}

static bool is_player(const struct hsr_algorithm *a) {
  return !(a->flags & (HSR_JUDGE | HSR_NO_PICTURE));
}

static bool is_asked(const struct hsr_algorithm *a, int argc, char **argv) {
  bool asked = argc == 0;
  for (int k = 0; k < argc; k++)
    asked |= !strcmp(argv[k], a->name);
  return is_player(a) && asked;
}

int main(int argc, char **argv) {
  bool write = argc > 1 && !strcmp(argv[1], "--write");
  argc -= 1 + write;
  argv += 1 + write;
  int n = 0;
  for (const struct hsr_listed *l = all_listed(); l->plain; l++)
    n += is_asked(l->counting, argc, argv);
  struct tap tap = plan(n);
  for (const struct hsr_listed *l = all_listed(); l->plain; l++) {
    const struct hsr_algorithm *a = l->counting;
    if (!is_asked(a, argc, argv))
      continue;
    char *counted = count_all(a);
    if (write)
      write_golden(a, counted);
    long differ = compare(a, counted);
    ok(&tap, !differ, "%s: counts as they were (%ld differ)", a->name, differ);
    free(counted);
  }
  return finish(&tap);
}
