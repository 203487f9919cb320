/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr list NAME: all that an algorithm's descriptor says. */
#include "bench/list.h"
#include "bench/modules/variant.h"
#include "bench/results/descriptor.h"
#include "bench/terminal/terminal.h"
#include "common/grids/palette.h"

#include <string.h>

/* "WHO    text", wrapped. */
static void say(const char *what, const char *text) {
  int used = printf("  %-12s", what);
  terminal_wrap(stdout, used, 14, text);
}

static void say_place(const struct hsr_algorithm *a) {
  struct taxonomy place = taxonomy(a->taxonomy);
  char text[200];
  snprintf(text, sizeof text, "%s%s%s", place.class, place.branch ? ", " : "",
           place.branch ? place.branch : "");
  say("place", text);
  if (a->sort_order)
    say("sorts", a->sort_order);
  if (a->coherence)
    say("bets on", a->coherence);
}

/* What a restriction demands, by its bit. */
const char *list_demand(int k) {
  static const char *const demands[HSR_N_RESTRICTIONS] = {
      "clusters that are closed convex polyhedra",
      "convex faces",
      "triangles",
      "clusters that planes separate",
      "faces that do not penetrate",
      "to know which faces are adjacent",
      "planar faces",
      "no face outside of the field of view",
      "no face behind the observer"};
  return demands[k];
}

static void say_demands(const struct hsr_algorithm *a) {
  for (int k = 0; k < HSR_N_RESTRICTIONS; k++) {
    char text[120];
    const char *code = hsr_restriction_code(1u << k);
    if (!((a->restrictions | a->lifted) & 1u << k))
      continue;
    snprintf(text, sizeof text, "%s (%s)%s", list_demand(k), code,
             a->restrictions & 1u << k
                 ? "; what is not so is divided or refused"
                 : "; only in its paper");
    say("demands", text);
  }
}

static void say_makes(const struct hsr_algorithm *a) {
  char text[400];
  const struct hsr_answer_type *own = hsr_own_kind(a);
  snprintf(text, sizeof text, "%s: %s", own->name, own->meaning);
  say("makes", text);
  for (int k = 0; hsr_answer_types[k]; k++) {
    const struct hsr_answer_type *type = hsr_answer_types[k];
    if (type == own || !hsr_can_draw(a, type) || !type->options)
      continue;
    snprintf(text, sizeof text, "%s: %s (%s:%s=...)", type->name, type->meaning,
             a->name, type->options->name);
    say("also", text);
  }
  if (a->flags & HSR_KNOWN_WRONG)
    say("", "known to be wrong: its differences are reported, and do not fail");
  if (!(a->subjects & 1u << HSR_FACES))
    say("takes", "grids only");
}

static void say_options(const struct hsr_algorithm *a) {
  printf("\noptions, as in %s:OPTION=VALUE:\n", a->name);
  for (const struct hsr_option *o = a->options; o && o->name; o++)
    list_print_option(o);
  if (hsr_own_kind(a)->by_windows)
    list_print_meaning("window=N",
                       "in squares of N x N samples, each a separate job");
  for (int k = 0; hsr_answer_types[k]; k++)
    if (hsr_can_draw(a, hsr_answer_types[k]))
      for (const struct hsr_option *o = hsr_answer_types[k]->options;
           o && o->name; o++)
        list_print_option(o);
}

static void say_sorts(const struct hsr_algorithm *a) {
  if (!a->sorts || !a->sorts->what)
    return;
  puts("\nsorts and searches:");
  for (const struct hsr_sort *s = a->sorts; s->what; s++) {
    char text[300];
    snprintf(text, sizeof text, "by %s: %s, %s", s->key, s->method, s->often);
    list_print_meaning(s->what, text);
  }
}

static void say_counters(const struct hsr_algorithm *a) {
  if (!a->counters || !a->counters->name)
    return;
  puts("\ncounters:");
  for (const struct hsr_counter *c = a->counters; c->name; c++)
    list_print_meaning(c->name, c->meaning);
}

static void say_steps(const struct hsr_algorithm *a) {
  if (!a->steps || !a->steps->label)
    return;
  puts("\nsteps, and what the survey's Table III predicts:");
  for (const struct hsr_step *s = a->steps; s->label; s++)
    list_print_meaning(s->label, s->formula ? s->formula : "-");
}

static void say_outline(const struct hsr_algorithm *a) {
  if (!a->outline || !a->outline->text)
    return;
  puts("\nin the paper's steps:");
  for (const struct hsr_line *l = a->outline; l->text; l++) {
    int blanks = 4 + (int)strspn(l->text, " ");
    printf("%*s", blanks, "");
    terminal_wrap(stdout, blanks, blanks + 4, l->text);
  }
}

static void tell_algorithm(const struct hsr_algorithm *a) {
  char year[20] = "";
  int used = printf("%s: ", a->name);
  terminal_wrap(stdout, used, 2, a->title);
  if (a->year)
    snprintf(year, sizeof year, "%d", a->year);
  if (a->authors)
    say("by", a->authors);
  if (a->year)
    say("year", year);
  if (a->source)
    say("source", a->source);
  say_place(a);
  say_makes(a);
  say_demands(a);
  say_options(a);
  say_sorts(a);
  say_counters(a);
  say_steps(a);
  say_outline(a);
}

enum hsr_status list_one(const char *name, struct hsr_error *err) {
  struct hsr_variant variant;
  for (const struct hsr_palette_name *p = hsr_palette_names; p->name; p++)
    if (!strcmp(p->name, name)) {
      int used = printf("--palette %s: ", name);
      terminal_wrap(stdout, used, 2, p->meaning);
      return HSR_OK;
    }
  enum hsr_status status = hsr_variant_parse(name, &variant, err);
  if (!status)
    tell_algorithm(variant.listed->plain);
  return status;
}
