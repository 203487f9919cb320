/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What hsr check prints: a line for each scene and size, and below it what is
 * wrong, was refused, crashed or came too late. */
#include "bench/check/check.h"
#include "bench/modules/outside.h"
#include "bench/results/json.h"
#include "bench/terminal/terminal.h"
#include "common/files/json/json.h"

#include <signal.h>
#include <string.h>

struct outcome outcome_of(const struct scene_run *run, int size, int a) {
  struct outcome outcome = {.worst = RIGHT};
  for (int view = 0; view < run->options->n_views; view++) {
    const struct cell *cell = cell_at(run, size, view, a);
    enum verdict verdict = cell->verdict == PENDING ? CRASH : cell->verdict;
    outcome.mismatches += cell->mismatches;
    if (verdict > outcome.worst)
      outcome.worst = verdict;
  }
  return outcome;
}

/* --- A line for a scene --------------------------------------------------- */

/* "31 of 32 right, 4 refused". Those that are known to be wrong are counted
 * apart. */
static void say_outcomes(const struct scene_run *run, int size, char *text,
                         size_t n) {
  const struct check_options *o = run->options;
  int all = 0, right = 0, refused = 0, known = 0;
  for (int a = 0; a < o->n_algorithms; a++) {
    if (is_left_out(run, a))
      continue;
    all++;
    enum verdict worst = outcome_of(run, size, a).worst;
    right += worst == RIGHT;
    refused += worst == REFUSED;
    known += worst == WRONG && is_known_wrong(o, a);
  }
  int length =
      snprintf(text, n, "%d of %d right", right, all - refused - known);
  if (known)
    length +=
        snprintf(text + length, n - (size_t)length, ", %d known wrong", known);
  if (refused)
    snprintf(text + length, n - (size_t)length, ", %d refused", refused);
}

static void print_scene(const struct scene_run *run, int size) {
  const struct check_options *o = run->options;
  char name[TERMINAL_NAME], samples[24], outcomes[80];
  snprintf(samples, sizeof samples, "%dx%d", o->m[size], o->n[size]);
  say_outcomes(run, size, outcomes, sizeof outcomes);
  int used = printf("%-20s %8u faces %9s  ",
                    terminal_plain(run->name, name, sizeof name),
                    run->world.n_faces, samples);
  terminal_wrap(stdout, used, 4, outcomes);
}

/* --- What is not right ---------------------------------------------------- */

/* "watkins, view 3, 97x61" */
static int say_cell(const struct scene_run *run, int size, int view, int a,
                    char *text, size_t n) {
  const struct check_options *o = run->options;
  return snprintf(text, n, "%s, %s %d, %dx%d", o->algorithm[a].name,
                  view_word(o), o->view[view] + 1, o->m[size], o->n[size]);
}

enum { LINE = 12000 };

static void print_wrong(const struct scene_run *run, int size, int view,
                        int a) {
  const struct cell *c = cell_at(run, size, view, a);
  if (c->verdict != WRONG || is_known_wrong(run->options, a))
    return;
  char text[LINE], number[TERMINAL_NUMBER];
  bool counting = !c->mismatches;
  uint64_t n = counting ? c->counting_mismatches : c->mismatches;
  int length = say_cell(run, size, view, a, text, sizeof text);
  length +=
      snprintf(text + length, sizeof text - (size_t)length, "%s: %s, %s%s",
               counting ? ", only the build that counts" : "",
               terminal_number(n, kind_of(run->options, a)->places, number),
               n == 1 ? "" : "the first ", c->first);
  if (!counting && c->counting_mismatches != c->mismatches)
    snprintf(text + length, sizeof text - (size_t)length,
             "; of the build that counts, %llu",
             (unsigned long long)c->counting_mismatches);
  terminal_wrap(stdout, printf("  wrong: "), 4, text);
}

/* The option that loads the modules outside of the tree: " -m PATH". */
static void say_modules(char *text, size_t n) {
  char path[TERMINAL_NAME], word[TERMINAL_NAME];
  size_t length = 0;
  *text = '\0';
  for (const char *at = outside_loaded(); *at && length < n;) {
    int size = (int)strcspn(at, "\n");
    snprintf(path, sizeof path, "%.*s", size, at);
    length += (size_t)snprintf(text + length, n - length, " -m %s",
                               terminal_word(path, word, sizeof word));
    at += size + (at[size] == '\n');
  }
}

/* The views or frames that lead to a cell: " --order 3". Frames are judged
 * together, and so are the views of whoever keeps a state from one to the next:
 * the process ended in one of them, and all are repeated. */
static void say_views(const struct check_options *o, int view, int a,
                      char *text, size_t n) {
  size_t length = 0;
  bool all = keeps_state(&o->algorithm[a]);
  if (o->frames) {
    length += (size_t)snprintf(text, n, " --frames %ld-%ld", o->first_frame,
                               o->last_frame);
    if (o->first_views)
      snprintf(text + length, n - length, " --views %ld", o->first_views);
    return;
  }
  for (int k = all ? 0 : view; k < (all ? o->n_views : view + 1) && length < n;
       k++)
    length += (size_t)snprintf(text + length, n - length, "%s%d",
                               length ? "," : " --order ", o->view[k] + 1);
}

/* The command that judges one cell again. */
static void say_again(const struct scene_run *run, int size, int view, int a,
                      char *text, size_t n) {
  const struct check_options *o = run->options;
  char scene[TERMINAL_NAME], algorithm[TERMINAL_NAME], modules[TERMINAL_NAME],
      views[6 * MOST_VIEWS], samples[32] = "";
  say_modules(modules, sizeof modules);
  say_views(o, view, a, views, sizeof views);
  if (o->samples)
    snprintf(samples, sizeof samples, " --samples %ld", o->samples);
  snprintf(text, n,
           "again: hsr%s check %s -a %s%s --size %dx%d%s --timeout %ld%s%s",
           modules, terminal_word(run->name, scene, sizeof scene),
           terminal_word(o->algorithm[a].name, algorithm, sizeof algorithm),
           views, o->m[size], o->n[size], samples, o->timeout,
           o->import.strict ? " --strict" : "",
           o->import.two_sided ? " --two-sided" : "");
}

static void print_crash(const struct scene_run *run, int size, int view,
                        int a) {
  const struct cell *c = cell_at(run, size, view, a);
  char text[LINE];
  int length = say_cell(run, size, view, a, text, sizeof text);
  if (c->why[0])
    snprintf(text + length, sizeof text - (size_t)length, ": %s", c->why);
  else if (c->signal)
    snprintf(text + length, sizeof text - (size_t)length, ": signal %d, %s",
             c->signal, strsignal(c->signal));
  else
    snprintf(text + length, sizeof text - (size_t)length,
             ": ended with status %d", (int)c->failure);
  terminal_wrap(stdout, printf("  crashed: "), 4, text);
}

/* A crash, or a picture that came too late. Later views of the algorithm have
 * the same verdict, and are not told. */
static void print_failure(const struct scene_run *run, int size, int a) {
  const struct check_options *o = run->options;
  for (int view = 0; view < o->n_views; view++) {
    enum verdict verdict = cell_at(run, size, view, a)->verdict;
    char text[LINE];
    if (verdict == RIGHT || verdict == WRONG || verdict == REFUSED)
      continue;
    if (verdict == TIMEOUT) {
      int length = say_cell(run, size, view, a, text, sizeof text);
      const char *why = cell_at(run, size, view, a)->why;
      if (*why)
        snprintf(text + length, sizeof text - (size_t)length, ": %s", why);
      else
        snprintf(text + length, sizeof text - (size_t)length,
                 ": took longer than %ld s", o->timeout);
      terminal_wrap(stdout, printf("  late: "), 4, text);
    } else {
      print_crash(run, size, view, a);
    }
    say_again(run, size, view, a, text, sizeof text);
    terminal_wrap(stdout, printf("    "), 6, text);
    return;
  }
}

/* The reason that a refusal gives: what follows the name in "refused by NAME:
 * why", "refused, NAME cannot be judged". */
static const char *reason_in(const char *refusal, const char *name) {
  const char *at = strstr(refusal, name);
  if (!at)
    return refusal;
  at += strlen(name);
  return at + strspn(at, ": ");
}

/* The first reason for which an algorithm refused a picture, which is often the
 * same for all views; or NULL. */
static const char *refusal_of(const struct scene_run *run, int a) {
  const struct check_options *o = run->options;
  for (int size = 0; size < o->n_sizes; size++)
    for (int view = 0; view < o->n_views; view++) {
      const char *refusal = cell_at(run, size, view, a)->refusal;
      if (refusal[0])
        return reason_in(refusal, o->algorithm[a].listed->plain->name);
    }
  return NULL;
}

/* Whether an algorithm before a refused for the same reason. */
static bool is_told(const struct scene_run *run, int a) {
  for (int b = 0; b < a; b++) {
    const char *other = refusal_of(run, b);
    if (other && !strcmp(other, refusal_of(run, a)))
      return true;
  }
  return false;
}

/* A reason once, with all who give it. */
static void print_refusal(const struct scene_run *run, int a) {
  const struct check_options *o = run->options;
  const char *why = refusal_of(run, a);
  if (!why || is_left_out(run, a) || is_told(run, a))
    return;
  char text[LINE];
  int length = 0;
  for (int b = a; b < o->n_algorithms && length < LINE / 2; b++) {
    const char *other = refusal_of(run, b);
    if (other && !strcmp(other, why))
      length += snprintf(text + length, sizeof text - (size_t)length, "%s%s",
                         length ? ", " : "", o->algorithm[b].name);
  }
  snprintf(text + length, sizeof text - (size_t)length, ": %s", why);
  terminal_wrap(stdout, printf("  refused: "), 4, text);
}

/* Says how much was compared, if pictures of a kind were not compared whole. */
static void print_compared(const struct scene_run *run,
                           const struct hsr_answer_type *kind) {
  const struct check_options *o = run->options;
  struct hsr_form form = hsr_form_standard(kind);
  long n = samples_to_compare(&run->world, &form, o->samples);
  bool any = false;
  for (int a = 0; a < o->n_algorithms; a++)
    any |= kind_of(o, a) == kind;
  if (n && any && kind->by_places)
    printf("  compared: %ld random %s of each picture\n", n, kind->places);
}

static void print_details(const struct scene_run *run) {
  const struct check_options *o = run->options;
  for (int k = 0; hsr_answer_types[k]; k++)
    print_compared(run, hsr_answer_types[k]);
  for (int size = 0; size < o->n_sizes; size++)
    for (int a = 0; a < o->n_algorithms; a++) {
      for (int view = 0; view < o->n_views; view++)
        print_wrong(run, size, view, a);
      print_failure(run, size, a);
    }
  for (int a = 0; a < o->n_algorithms; a++)
    print_refusal(run, a);
}

/* --- Totals --------------------------------------------------------------- */

/* The number of the first kind whose places are called so. */
static int number_of_places(const struct hsr_answer_type *kind) {
  int k = 0;
  while (strcmp(hsr_answer_types[k]->places, kind->places))
    k++;
  return k;
}

static void add_cell(const struct check_options *o, int a, const struct cell *c,
                     struct totals *totals) {
  enum verdict verdict = c->verdict == PENDING ? CRASH : c->verdict;
  if (verdict == RIGHT || verdict == WRONG)
    totals->compared[number_of_places(kind_of(o, a))] += c->compared;
  totals->depths += c->depths_compared;
  totals->depths_exact += c->depths_exact;
  totals->crashed += verdict == CRASH;
  totals->late += verdict == TIMEOUT;
  if (verdict == WRONG && is_known_wrong(o, a)) {
    totals->expected += c->mismatches;
    return;
  }
  totals->mismatches += c->mismatches;
  if (verdict == WRONG && c->counting_mismatches != c->mismatches)
    totals->counting += c->counting_mismatches;
  totals->failures += verdict != RIGHT && verdict != REFUSED;
}

static enum hsr_status add_up(const struct scene_run *run,
                              struct totals *totals) {
  const struct check_options *o = run->options;
  for (int size = 0; size < o->n_sizes; size++)
    for (int view = 0; view < o->n_views; view++)
      for (int a = 0; a < o->n_algorithms; a++) {
        const struct cell *c = cell_at(run, size, view, a);
        if (c->failure == HSR_E_NOMEM)
          return HSR_E_NOMEM;
        add_cell(o, a, c, totals);
        if (o->json)
          hsr_json_append(&totals->cells, cell_json(run, size, view, a));
      }
  return HSR_OK;
}

/* "3 samples and 2 edges compared, 0 mismatches": only the kinds of which
 * anything was compared. */
static void print_compared_totals(const struct totals *totals) {
  char number[TERMINAL_NUMBER], text[1024];
  int n = 0, said = 0;
  size_t at = 0;
  for (int k = 0; hsr_answer_types[k]; k++)
    n += totals->compared[k] > 0;
  for (int k = 0; hsr_answer_types[k] && at < sizeof text; k++)
    if (totals->compared[k] && ++said)
      at += (size_t)snprintf(text + at, sizeof text - at, "%s%s",
                             said == 1   ? ""
                             : said == n ? " and "
                                         : ", ",
                             terminal_number(totals->compared[k],
                                             hsr_answer_types[k]->places,
                                             number));
  if (at < sizeof text)
    snprintf(text + at, sizeof text - at, "%s compared, %s", n ? "" : "nothing",
             terminal_number(totals->mismatches, "mismatches", number));
  terminal_wrap(stdout, 0, 0, text);
}

static void print_totals(const struct totals *totals) {
  char number[TERMINAL_NUMBER];
  putchar('\n');
  print_compared_totals(totals);
  if (totals->counting)
    printf("%s in builds that count\n",
           terminal_number(totals->counting, "mismatches", number));
  if (totals->expected)
    printf("%llu more of algorithms that are known to be wrong\n",
           (unsigned long long)totals->expected);
  if (totals->crashed || totals->late)
    printf("NOT all was compared: %d crashed, %d late\n", totals->crashed,
           totals->late);
  if (!totals->depths)
    return;
  printf("%llu depth comparisons, %llu by the exact path",
         (unsigned long long)totals->depths,
         (unsigned long long)totals->depths_exact);
  if (totals->depths_exact)
    printf(" (1 in %.0f)",
           (double)totals->depths / (double)totals->depths_exact);
  putchar('\n');
}

/* --- The report ----------------------------------------------------------- */

/* "watkins, zbuffer; 8 views of each scene" */
static void print_what(const struct check_options *o) {
  enum { MOST_NAMES = 5 };
  char text[LINE], number[TERMINAL_NUMBER];
  int length = 0;
  for (int a = 0; a < o->n_algorithms && o->n_algorithms <= MOST_NAMES; a++)
    length += snprintf(text + length, sizeof text - (size_t)length, "%s%.500s",
                       a ? ", " : "", o->algorithm[a].name);
  int variants = 0;
  for (int a = 0; a < o->n_algorithms && o->all_algorithms; a++)
    variants += strchr(o->algorithm[a].name, ':') != NULL;
  if (!length)
    length = snprintf(text, sizeof text, "%d algorithms",
                      o->n_algorithms - variants);
  if (variants)
    length += snprintf(text + length, sizeof text - (size_t)length,
                       " and %d variants", variants);
  snprintf(text + length, sizeof text - (size_t)length, "; %s of each scene",
           terminal_number((uint64_t)o->n_views, o->frames ? "frames" : "views",
                           number));
  terminal_wrap(stdout, 0, 2, text);
}

void report_begin(const struct check_options *o, struct totals *totals) {
  if (o->json) {
    totals->cells = json_array();
    return;
  }
  print_what(o);
  if (o->matrix)
    matrix_begin(o);
  fflush(stdout);
}

enum hsr_status report_scene(const struct scene_run *run, struct totals *totals,
                             struct hsr_error *err) {
  const struct check_options *o = run->options;
  if (o->matrix && !o->json)
    matrix_scene(run);
  for (int size = 0; size < o->n_sizes && !o->matrix && !o->json; size++)
    print_scene(run, size);
  if (!o->json) {
    print_details(run);
    fflush(stdout);
  }
  return add_up(run, totals) ? hsr_fail_nomem(err) : HSR_OK;
}

enum hsr_status report_end(const struct check_options *o, struct totals *totals,
                           struct hsr_error *err) {
  if (!o->json) {
    print_totals(totals);
    return HSR_OK;
  }
  enum hsr_status status = json_print(totals_json(totals), err);
  report_abandon(totals);
  return status;
}

void report_abandon(struct totals *totals) {
  json_decref(totals->cells);
  totals->cells = NULL;
}
