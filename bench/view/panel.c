/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/run/table1.h"
#include "bench/view/view.h"

#include "bench/terminal/terminal.h"
#include "common/statistics/statistics.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

__attribute__((format(printf, 2, 3))) static void add(char text[MOST_PANEL],
                                                      const char *format, ...) {
  size_t n = strlen(text);
  va_list args;
  va_start(args, format);
  vsnprintf(text + n, MOST_PANEL - n, format, args);
  va_end(args);
}

static const char *const overlays[] = {"", ", its work", ", depth complexity",
                                       ", edges of faces"};

static void add_state(const struct viewer *v, char *text) {
  char name[60];
  const struct player *p = v->player[0];
  const int coarse = v->moving ? v->moving : v->coarse;
  add(text, "%s, %u faces, view %u of %u%s\n",
      terminal_plain(v->scene_name, name, sizeof name), p->render.world.n_faces,
      v->view + 1, v->scene->n_views, v->frozen ? ", frozen" : "");
  static const char *const between[] = {"", " | ", " / ", " - "};
  add(text, "%s%s%s%s%s\n", p->variant.name, between[v->comparison],
      v->comparison ? v->second : "", overlays[v->overlay],
      v->has_lines ? ", lines" : "");
  if (v->comparison == COMPARE_BLINK)
    add(text, "this is %s\n", v->blink ? v->second : p->variant.name);
  add(text, "%d x %d", v->m / coarse, v->n / coarse);
  if (coarse > 1)
    add(text, ", %d x %d pixels a sample", coarse, coarse);
  add(text, ", %ld thread%s%s\n", v->threads, v->threads == 1 ? "" : "s",
      v->camera.parallel > 0 ? ", parallel" : "");
  char lines[400];
  lines_say(v, lines, sizeof lines);
  add(text, "%s", lines);
}

static void add_times(const struct viewer *v, char *text) {
  const struct player *p =
      v->player[v->comparison == COMPARE_BLINK && v->blink];
  const struct render *r = &p->render;
  add(text, "ms: draw %.2f, shade %.2f, the rest %.2f\n", p->draw_ms,
      p->shade_ms, v->outside_ms);
  add(text, "once: build %.1f, adapt %.1f, prepare %.1f\n", 1e3 * r->build,
      1e3 * r->setup.adapt_seconds, 1e3 * r->setup.prepare_seconds);
}

/* --- Steps ---------------------------------------------------------------- */

static double cost(const struct hsr_step *step, const struct hsr_tally *tally) {
  struct hsr_term term;
  double sum = 0;
  for (int k = 0; hsr_step_term(step, k, &term); k++)
    sum += hsr_term_price(&term, &hsr_prices_standard) *
           (double)tally->count[term.counter];
  return sum;
}

static void add_steps(const struct hsr_algorithm *a,
                      const struct hsr_tally *tally,
                      const struct hsr_table1 *table, char *text) {
  if (a->steps)
    add(text, "%-20s %12s %12s\n", "Table III", "counted", "predicted");
  for (int k = 0; a->steps && a->steps[k].label; k++) {
    const struct hsr_step *step = &a->steps[k];
    add(text, "%-20.20s %12.4g", step->label, cost(step, tally));
    if (step->predict && table)
      add(text, " %12.4g", step->predict(table));
    add(text, "\n");
  }
  add(text, "%-20s %12s\n", "steps", "count");
  for (int k = 0; a->counters && a->counters[k].name; k++)
    if (tally->count[k])
      add(text, "%-20.20s %12llu\n", a->counters[k].name,
          (unsigned long long)tally->count[k]);
}

static void add_table(const struct hsr_table1 *table, char *text) {
  struct hsr_table1 rules;
  hsr_statistics_rules(table, &rules);
  add(text, "%-5s %12s %12s\n", "", "Table I", "rule");
#define X(field, symbol, meaning)                                              \
  add(text, "%-5s %12.6g", symbol, table->field);                              \
  if (!isnan(rules.field))                                                     \
    add(text, " %12.6g", rules.field);                                         \
  add(text, "\n");
  HSR_TABLE1(X)
#undef X
}

/* Runs the counting build on the view at rest, and measures Table I. */
static void add_counts(struct viewer *v, char *text) {
  struct hsr_error err = {HSR_OK, ""};
  struct hsr_view view;
  struct hsr_table1 table;
  struct player *counter = &v->counter;
  enum hsr_status status = viewer_view(v, v->m, v->coarse, &view, &err);
  const struct hsr_world *world = &v->player[0]->render.world;
  bool has_table = !status && !hsr_is_roster(world) &&
                   !measure_table1(world, &view, &table, &err);
  if (v->page == PAGE_TABLE) {
    if (has_table)
      add_table(&table, text);
    else
      add(text, "Table I is not measured of so many faces\n");
    return;
  }
  if (!status)
    status = player_open(counter, v->player[0]->variant.name, PLAYER_COUNTS, v,
                         &err);
  if (!status)
    status = player_draw(counter, &view, v->other, &err);
  if (status)
    add(text, "%s\n", err.text);
  else
    add_steps(counter->render.setup.algorithm, &counter->render.tally,
              has_table ? &table : NULL, text);
}

void panel_write(struct viewer *v, char text[MOST_PANEL]) {
  *text = '\0';
  if (v->page == PAGE_NONE && !*v->message)
    return;
  if (v->page != PAGE_NONE)
    add_state(v, text);
  if (v->page == PAGE_TIMES)
    add_times(v, text);
  if ((v->page == PAGE_STEPS || v->page == PAGE_TABLE) && !v->moving)
    add_counts(v, text);
  if (v->page == PAGE_HELP)
    keys_help(text + strlen(text), MOST_PANEL - strlen(text));
  else if (v->page != PAGE_NONE)
    add(text, "h: help\n");
  if (*v->picked)
    add(text, "%s", v->picked);
  if (*v->message)
    add(text, "%s\n", v->message);
}
