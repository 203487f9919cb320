/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Registers a program's modules: puts the parts of each before its own, and assigns
 * the places of all counters. The memory is the program's own, so nothing can fail.
 */
#include "algorithms/algorithm.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
  MOST_MODULES = 160,
  MOST_COUNTERS = 24 * 2 * MOST_MODULES,
  MOST_STEPS = 6 * 2 * MOST_MODULES,
  MOST_SORTS = 6 * 2 * MOST_MODULES,
  MOST_LINES = 24 * 2 * MOST_MODULES,
  MOST_TEXT = 1 << 17
};

static struct hsr_listed listed[MOST_MODULES + 1];
static struct hsr_algorithm algorithms[2 * MOST_MODULES];
static struct hsr_counter counters[MOST_COUNTERS];
static struct hsr_step steps[MOST_STEPS];
static struct hsr_sort sorts[MOST_SORTS];
static struct hsr_line lines[MOST_LINES];
static char text[MOST_TEXT];
static size_t n_algorithms, n_counters, n_steps, n_sorts, n_lines, n_text;

/* Ends the program, for the fault is in its source. */
static _Noreturn void fail(const char *name, const char *format,
                           const char *what) {
  fprintf(stderr, "hsr: module %s: ", name);
  fprintf(stderr, format, what);
  fputc('\n', stderr);
  abort();
}

/* The next item of one of these arrays, which are large enough for any list of
 * modules that this program has: a programmer's error, if not. */
#define NEXT(array)                                                            \
  (n_##array < sizeof array / sizeof *array ? &array[n_##array++]              \
                                            : (abort(), array))

/* `first` and `second` in one; `second` itself if there is no `first`. */
static const char *join(const char *first, const char *second) {
  if (!first || !*first)
    return second;
  size_t size = strlen(first) + strlen(second) + 1;
  if (n_text + size > sizeof text)
    abort();
  char *joined = text + n_text;
  snprintf(joined, size, "%s%s", first, second);
  n_text += size;
  return joined;
}

/* Where a counter of any part is among all those of an algorithm. */
static int place(const struct hsr_algorithm *a, int counter) {
  return a->base[counter / HSR_PART_SIZE] + counter % HSR_PART_SIZE;
}

/* --- Counters ------------------------------------------------------------- */

static void add_counters(struct hsr_algorithm *a, enum hsr_part_number part,
                         const struct hsr_counter *from, const char *prefix) {
  a->base[part] = (uint8_t)(&counters[n_counters] - a->counters);
  for (; from && from->name; from++) {
    struct hsr_counter *to = NEXT(counters);
    *to = *from;
    to->name = join(prefix, from->name);
  }
}

static void put_counters(struct hsr_algorithm *a) {
  const struct hsr_counter *own = a->counters;
  a->counters = &counters[n_counters];
  for (const struct hsr_use *u = a->parts; u && u->part; u++)
    add_counters(a, u->part->number, u->part->counters, u->prefix);
  add_counters(a, HSR_PART_OWN, own, NULL);
  if (&counters[n_counters] - a->counters > HSR_MAX_COUNTERS)
    fail(a->name, "it has too many %s", "counters");
  *NEXT(counters) = (struct hsr_counter){NULL};
}

/* --- Steps ---------------------------------------------------------------- */

/* The step of an algorithm that has this label, or a new one. */
static struct hsr_step *step_of(const struct hsr_algorithm *a,
                                const char *label) {
  for (const struct hsr_step *s = a->steps; s < &steps[n_steps]; s++)
    if (!strcmp(s->label, label))
      return &steps[s - steps];
  return NEXT(steps);
}

static void add_term(struct hsr_step *step, struct hsr_term term) {
  int k = 0;
  while (k < HSR_MORE_TERMS && step->more[k].kind)
    k++;
  if (k == HSR_MORE_TERMS)
    abort();
  step->more[k] = term;
}

/* A term of a part, or of a module, as one of the algorithm. */
static struct hsr_term placed(const struct hsr_algorithm *a,
                              const struct hsr_step *step,
                              struct hsr_term term) {
  if (term.kind < HSR_FIRST_KIND || term.kind >= HSR_AFTER_KINDS)
    fail(a->name, "step %s has a term of no kind (algorithms/prices.def)",
         step->label);
  return (struct hsr_term){place(a, term.counter), term.kind, term.less};
}

static void add_step(const struct hsr_algorithm *a, const struct hsr_step *from,
                     const char *prefix) {
  const char *label = join(prefix, from->label);
  struct hsr_term term = {.counter = from->counter, .kind = from->kind};
  struct hsr_term first = placed(a, from, term);
  struct hsr_step *to = step_of(a, label);
  if (to->label)
    add_term(to, first);
  else
    *to = (struct hsr_step){label, first.counter, first.kind, from->formula,
                            from->predict};
  for (int k = 1; hsr_step_term(from, k, &term); k++)
    add_term(to, placed(a, from, term));
}

static void add_steps_of(const struct hsr_algorithm *a,
                         const struct hsr_use *use) {
  for (const struct hsr_step *s = use->part->steps; s && s->label; s++)
    add_step(a, s, use->prefix);
}

static bool is_step(const struct hsr_step *step) {
  return step && (step->label || step->part);
}

static bool has_place(const struct hsr_step *own, const struct hsr_part *part) {
  while (is_step(own) && own->part != part)
    own++;
  return is_step(own);
}

static void put_steps(struct hsr_algorithm *a) {
  const struct hsr_step *own = a->steps;
  a->steps = &steps[n_steps];
  for (const struct hsr_use *u = a->parts; u && u->part; u++)
    if (!has_place(own, u->part))
      add_steps_of(a, u);
  for (const struct hsr_step *s = own; is_step(s); s++)
    if (s->part)
      add_steps_of(a, &(struct hsr_use){s->part, NULL});
    else
      add_step(a, s, NULL);
  if (a->steps == &steps[n_steps])
    a->steps = NULL;
  else
    *NEXT(steps) = (struct hsr_step){NULL};
}

/* --- Sorts ---------------------------------------------------------------- */

static void add_sorts(const struct hsr_sort *from) {
  for (; from && (from->what || from->part); from++)
    if (from->part)
      add_sorts(from->part->sorts);
    else
      *NEXT(sorts) = *from;
}

static void put_sorts(struct hsr_algorithm *a) {
  if (!a->sorts)
    return;
  const struct hsr_sort *own = a->sorts;
  a->sorts = &sorts[n_sorts];
  add_sorts(own);
  *NEXT(sorts) = (struct hsr_sort){NULL};
}

/* --- The outline ---------------------------------------------------------- */

static void add_lines(const struct hsr_algorithm *a,
                      const struct hsr_line *from, const char *in) {
  for (; from->text || from->part; from++) {
    if (from->part) {
      add_lines(a, from->part->lines[from->group],
                join(in, from->text ? from->text : ""));
      continue;
    }
    struct hsr_line *to = NEXT(lines);
    *to = *from;
    to->text = join(in, from->text);
    for (int k = 0; k < to->n_raises; k++)
      to->raises[k] = place(a, from->raises[k]);
  }
}

static void put_outline(struct hsr_algorithm *a) {
  if (!a->outline)
    return;
  const struct hsr_line *own = a->outline;
  a->outline = &lines[n_lines];
  add_lines(a, own, NULL);
  *NEXT(lines) = (struct hsr_line){NULL};
}

/* --- The list ------------------------------------------------------------- */

/* A programmer's errors in a descriptor. */
static void check(const struct hsr_algorithm *a) {
  const char *lacks = !a->name            ? "a name"
                      : !a->title         ? "a title"
                      : !a->subjects      ? "subjects"
                      : !a->makes[0].kind ? "what it makes"
                      : !a->render        ? "render"
                                          : NULL;
  const char *name = a->name ? a->name : "?";
  if (lacks)
    fail(name, "its descriptor lacks %s", lacks);
  if (name[strspn(name, "abcdefghijklmnopqrstuvwxyz0123456789-")])
    fail(name, "its name has other characters than %s", "a to z, 0 to 9 and -");
}

static const struct hsr_algorithm *
register_one(const struct hsr_algorithm *module) {
  struct hsr_algorithm *a = NEXT(algorithms);
  check(module);
  *a = *module;
  memset(a->base, HSR_MAX_COUNTERS, sizeof a->base);
  if (a->counters || a->parts)
    put_counters(a);
  put_steps(a);
  put_sorts(a);
  put_outline(a);
  return a;
}

const struct hsr_listed *hsr_register(const struct hsr_listed *modules) {
  static_assert((int)HSR_N_PARTS <= (int)HSR_MOST_PARTS,
                "a tally has room for all parts");
  for (int k = 0; modules[k].plain; k++) {
    if (k == MOST_MODULES)
      abort();
    const struct hsr_listed *module = &modules[k];
    listed[k].plain = register_one(module->plain);
    listed[k].counting = module->counting == module->plain
                             ? listed[k].plain
                             : register_one(module->counting);
  }
  return listed;
}
