/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr list: the algorithms and their taxonomy entries; the palettes. list_one.c
 * tells of one. */
#include "bench/list.h"
#include "bench/modules/modules.h"
#include "bench/options/command.h"
#include "bench/options/parser.h"
#include "bench/results/descriptor.h"
#include "bench/results/json.h"
#include "bench/terminal/terminal.h"
#include "common/files/json/json.h"
#include "common/grids/palette.h"

#include <string.h>

static const char about[] =
    "Lists the algorithms: name, year, place in the taxonomy of Sutherland, "
    "Sproull and Schumacker, sorting order, environment restrictions, "
    "options; and the palettes of splats. With a NAME it tells all of that "
    "algorithm: also its source, sorts, counters, steps and pseudocode.\v"
    "  hsr list watkins";

static json_t *palettes_json(void) {
  json_t *all = json_array();
  for (const struct hsr_palette_name *p = hsr_palette_names; p->name; p++)
    hsr_json_append(
        &all, json_pack("{ss ss}", "name", p->name, "meaning", p->meaning));
  return all;
}

static enum hsr_status print_json(struct hsr_error *err) {
  return json_print(json_pack("{ss so so}", "schema", "hsr-list/1",
                              "algorithms", algorithms_json(), "palettes",
                              palettes_json()),
                    err);
}

/* "; CC TP": the codes of what the algorithm does not take. */
static void say_restrictions(const struct hsr_algorithm *a, char *text,
                             size_t n) {
  int length = 0;
  for (int k = 0; k < HSR_N_RESTRICTIONS && length < (int)n; k++)
    if (a->restrictions & 1u << k)
      length += snprintf(text + length, n - (size_t)length, "%s%s",
                         length ? " " : "; ", hsr_restriction_code(1u << k));
}

/* The width of the column of sorting orders. */
static int sorts_width(void) {
  int width = 5;
  for (const struct hsr_listed *a = hsr_algorithms(); a->plain; a++) {
    const char *order = a->plain->sort_order;
    if (order && (int)strlen(order) > width)
      width = (int)strlen(order);
  }
  return width;
}

static void print_algorithm(const struct hsr_algorithm *a, int sorts) {
  struct taxonomy place = taxonomy(a->taxonomy);
  char year[12] = "-", restrictions[60] = "", text[200];
  if (a->year)
    snprintf(year, sizeof year, "%d", a->year);
  say_restrictions(a, restrictions, sizeof restrictions);
  snprintf(text, sizeof text, "%s%s%s%s%s%s", place.class,
           place.branch ? ", " : "", place.branch ? place.branch : "",
           restrictions, a->subjects & 1u << HSR_FACES ? "" : "; of grids only",
           a->flags & HSR_KNOWN_WRONG ? "; known to be wrong" : "");
  int used = printf("%-19s %4s  %-*s %-8s  ", a->name, year, sorts,
                    a->sort_order ? a->sort_order : "-", hsr_own_kind(a)->name);
  terminal_wrap(stdout, used, used, text);
}

/* What the codes of the last column mean. */
static void print_demands(void) {
  char text[600] = "";
  size_t n = 0;
  for (int k = 0; k < HSR_N_RESTRICTIONS && n < sizeof text; k++)
    n += (size_t)snprintf(text + n, sizeof text - n, "%s%s %s", k ? "; " : "",
                          hsr_restriction_code(1u << k), list_demand(k));
  putchar('\n');
  terminal_wrap(stdout, printf("demands: "), 9, text);
}

/* So many as hsr check counts are algorithms that draw and are no judges. */
static void print_how_many(void) {
  int n = 0, judges = 0, empty = 0;
  for (const struct hsr_listed *a = hsr_algorithms(); a->plain; a++, n++) {
    judges += (a->plain->flags & HSR_JUDGE) != 0;
    empty += !(a->plain->flags & HSR_JUDGE) && a->plain->flags & HSR_NO_PICTURE;
  }
  char text[160];
  snprintf(text, sizeof text,
           "%d names: %d algorithms, %d oracles that judge them, and %d that "
           "draws nothing",
           n, n - judges - empty, judges, empty);
  putchar('\n');
  terminal_wrap(stdout, 0, 2, text);
}

/* One word of an option, or an option of numbers. */
void list_print_meaning(const char *what, const char *meaning) {
  int used = printf("    %-22s  ", what);
  terminal_wrap(stdout, used, 28, meaning);
}

void list_print_option(const struct hsr_option *o) {
  char what[60], meaning[300];
  snprintf(what, sizeof what, "%s=%s", o->name, o->real ? "X" : "N");
  if (o->real) {
    snprintf(meaning, sizeof meaning, "%s, %g to %g (standard: %g)", o->meaning,
             o->real_least, o->real_most, o->real_standard);
    list_print_meaning(what, meaning);
    return;
  }
  if (!o->words) {
    snprintf(meaning, sizeof meaning, "%s, %ld to %ld (standard: %ld)",
             o->meaning, o->least, o->most, o->standard);
    list_print_meaning(what, meaning);
    return;
  }
  list_print_meaning(o->name, o->meaning);
  for (const struct hsr_word *w = o->words; w->name; w++) {
    snprintf(what, sizeof what, "  %s=%s", o->name, w->name);
    snprintf(meaning, sizeof meaning, "%s%s", w->meaning,
             w == &o->words[o->standard] ? " (standard)" : "");
    list_print_meaning(what, meaning);
  }
}

/* Whether a kind is that of some algorithm which is no judge. */
static bool is_played(const struct hsr_answer_type *kind) {
  bool any = false;
  for (const struct hsr_listed *a = hsr_algorithms(); a->plain; a++)
    any |= hsr_own_kind(a->plain) == kind && !(a->plain->flags & HSR_JUDGE);
  return any;
}

/* Prints the options of the answers that all algorithms of a kind can give. */
static void print_kind_options(const struct hsr_answer_type *kind) {
  bool any = kind->by_windows;
  for (int k = 0; hsr_answer_types[k]; k++)
    any |= hsr_answer_types[k]->options &&
           hsr_is_asked_of(hsr_answer_types[k], kind);
  if (!any || kind->fold || !is_played(kind))
    return;
  printf("  all that draw %s\n", kind->name);
  if (kind->by_windows)
    list_print_meaning("window=N",
                       "in squares of N x N samples, each a separate job");
  for (int k = 0; hsr_answer_types[k]; k++) {
    const struct hsr_answer_type *type = hsr_answer_types[k];
    if (!hsr_is_asked_of(type, kind))
      continue;
    for (const struct hsr_option *o = type->options; o && o->name; o++)
      list_print_option(o);
  }
}

/* Prints the options of a kind that some algorithms make besides their own, and
 * who they are. */
static void print_further_kind(const struct hsr_answer_type *type) {
  char names[500] = "";
  size_t n = 0;
  for (const struct hsr_listed *a = hsr_algorithms(); a->plain; a++)
    if (hsr_makes_also(a->plain, type) && n < sizeof names)
      n += (size_t)snprintf(names + n, sizeof names - n, "%s%s", n ? ", " : "",
                            a->plain->name);
  if (!n)
    return;
  printf("  ");
  terminal_wrap(stdout, 2, 4, names);
  for (const struct hsr_option *o = type->options; o && o->name; o++)
    list_print_option(o);
}

/* Prints, below the table, the options that NAME:OPTION=VALUE can choose. */
static void print_options(void) {
  puts("\nOptions, as in zbuffer-fast:window=64:");
  for (int k = 0; hsr_answer_types[k]; k++)
    print_kind_options(hsr_answer_types[k]);
  for (int k = 0; hsr_answer_types[k]; k++)
    print_further_kind(hsr_answer_types[k]);
  for (const struct hsr_listed *a = hsr_algorithms(); a->plain; a++) {
    if (a->plain->options)
      printf("  %s\n", a->plain->name);
    for (const struct hsr_option *o = a->plain->options; o && o->name; o++)
      list_print_option(o);
  }
}

/* Prints, below the options, what --palette can choose. */
static void print_palettes(void) {
  puts(
      "\nPalettes, as in --palette bone: how samples of a grid look as splats");
  for (const struct hsr_palette_name *p = hsr_palette_names; p->name; p++) {
    int used = printf("  %-10s  ", p->name);
    terminal_wrap(stdout, used, used, p->meaning);
  }
}

struct options {
  struct option_base base;
  const char *name; /* the one that is told of, or NULL */
  bool json;
};

static error_t parse(int key, char *arg, struct argp_state *state) {
  struct options *o = state->input;
  switch (key) {
  case 'j':
    o->json = true;
    return 0;
  case ARGP_KEY_ARG:
    if (o->name)
      return option_fail(&o->base, "list: one name at a time, not '%s' too",
                         arg);
    o->name = arg;
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp argp = {
    (const struct argp_option[]){JSON_ARGP_OPTION, {0}},
    parse,
    "[ALGORITHM]",
    about,
    NULL,
    NULL,
    NULL};

enum hsr_status command_list(int argc, char **argv, struct hsr_error *err) {
  struct options o = {.base = {.err = err}};
  enum hsr_status status = parse_options(&argp, argc, argv, &o, err);
  if (status)
    return status;
  if (o.json && o.name)
    return hsr_fail(err, HSR_E_USAGE, "list: --json tells of all, not of '%s'",
                    o.name);
  if (o.name)
    return list_one(o.name, err);
  if (o.json)
    return print_json(err);
  int sorts = sorts_width();
  printf("%-19s %4s  %-*s %-8s  %s\n", "name", "year", sorts, "sorts", "kind",
         "taxonomy; restrictions");
  for (const struct hsr_listed *a = hsr_algorithms(); a->plain; a++)
    print_algorithm(a->plain, sorts);
  print_how_many();
  print_demands();
  print_options();
  print_palettes();
  return HSR_OK;
}
