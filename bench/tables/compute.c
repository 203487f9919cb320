/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables I to VII of Sutherland et al. 1974, computed from results. */
#include "bench/modules/modules.h"
#include "bench/tables/prices.h"
#include "bench/tables/tables.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const tables_scenes[] = {
    "house",       "harbor",       "big-harbor",   "harbor:100",   "harbor:500",
    "harbor:2500", "harbor:10000", "harbor:30000", "harbor:60000", NULL};

const char *const tables_variants[] = {
#define HSR_PROPOSED(variant) variant,
#include "algorithms/proposals.def"
#undef HSR_PROPOSED
    NULL};

const char *const tables_walkers[] = {"newell",
                                      "newell-previous",
                                      "warnock",
                                      "warnock:regions=64",
                                      "warnock:regions=256",
                                      NULL};

/* --- Scenes --------------------------------------------------------------- */

/* X(field, symbol, meaning) */
struct hsr_table1 tables_table1(const json_t *view) {
  const json_t *table = json_object_get(view, "table1");
  struct hsr_table1 t;
#define X(field, symbol, meaning)                                              \
  const json_t *field = json_object_get(table, symbol);                        \
  t.field = json_is_number(field) ? json_number_value(field) : NAN;
  HSR_TABLE1(X)
#undef X
  return t;
}

/* `view` is NULL if the results do not have it. */
static struct table_scene make_scene(const char *name, const json_t *view) {
  static const char *const axis[3] = {"x", "y", "z"};
  struct table_scene scene = {.name = name, .measured = tables_table1(view)};
  const json_t *overlaps = json_object_get(view, "overlaps");
  for (int k = 0; k < 3; k++) {
    const json_t *f = json_object_get(overlaps, axis[k]);
    scene.overlap[k] = json_is_number(f) ? json_number_value(f) : NAN;
  }
  hsr_statistics_rules(&scene.measured, &scene.rules);
  return scene;
}

static const json_t *view_of(const struct results *results, const char *scene) {
  char key[RESULTS_KEY];
  snprintf(key, sizeof key, "%.300s %d %dx%d", scene, TABLES_VIEW, TABLES_SIZE,
           TABLES_SIZE);
  return results_view(results, key);
}

/* The name of the view's scene if that is on the ladder, or NULL. */
static const char *rung(const struct results *results, const json_t *view) {
  const char *scene = json_string_value(json_object_get(view, "scene"));
  return scene && !strncmp(scene, "harbor:", 7) &&
                 view_of(results, scene) == view
             ? scene
             : NULL;
}

static int by_faces(const void *a, const void *b) {
  double x = ((const struct table_scene *)a)->measured.F_r;
  double y = ((const struct table_scene *)b)->measured.F_r;
  return (x > y) - (x < y);
}

static enum hsr_status find_scenes(struct tables *t, struct hsr_error *err) {
  bool any = false;
  for (int e = 0; e < ENVIRONMENTS; e++) {
    const char *name = paper_environments[e].scene;
    const json_t *view = view_of(t->results, name);
    any = any || view;
    t->scene[t->n_scenes++] = make_scene(name, view);
  }
  size_t k;
  json_t *view;
  json_array_foreach(t->results->views, k, view) {
    const char *name = rung(t->results, view);
    if (name && t->n_scenes == MOST_SCENES)
      return hsr_fail(err, HSR_E_INPUT,
                      "tables: the results have more than %d sizes of harbor",
                      MOST_SCENES - ENVIRONMENTS);
    if (name)
      t->scene[t->n_scenes++] = make_scene(name, view);
  }
  qsort(t->scene + ENVIRONMENTS, (size_t)(t->n_scenes - ENVIRONMENTS),
        sizeof *t->scene, by_faces);
  if (!any && t->n_scenes == ENVIRONMENTS)
    return hsr_fail(err, HSR_E_INPUT,
                    "tables: the results have none of house, harbor, "
                    "big-harbor and harbor:N, seen from view %d at %dx%d",
                    TABLES_VIEW, TABLES_SIZE, TABLES_SIZE);
  return HSR_OK;
}

/* --- Costs ---------------------------------------------------------------- */

struct growth tables_growth(const struct tables *t, const double *values) {
  double faces[MOST_SCENES];
  for (int s = ENVIRONMENTS; s < t->n_scenes; s++)
    faces[s] = t->scene[s].measured.F_r;
  return growth_fit(faces + ENVIRONMENTS, values + ENVIRONMENTS,
                    t->n_scenes - ENVIRONMENTS);
}

static void fit(const struct tables *t, struct series *series) {
  series->growth = tables_growth(t, series->measured);
  series->predicted_growth = tables_growth(t, series->predicted);
}

/* A counter of a picture that is right; NAN if there is none. */
static double count_in(const json_t *cell, const char *counter) {
  const char *status = json_string_value(json_object_get(cell, "status"));
  const json_t *count =
      json_object_get(json_object_get(cell, "counts"), counter);
  return status && !strcmp(status, "ok") && json_is_integer(count)
             ? (double)json_integer_value(count)
             : NAN;
}

static void find_cells(const struct tables *t, struct table_algorithm *a) {
  for (int s = 0; s < t->n_scenes; s++) {
    char key[RESULTS_KEY];
    snprintf(key, sizeof key, "%.300s %d %dx%d %.100s 1", t->scene[s].name,
             TABLES_VIEW, TABLES_SIZE, TABLES_SIZE, a->name);
    a->cell[s] = results_cell(t->results, key);
  }
}

/* The cost of all terms of a step, in a cell. */
static double cost_of(const struct hsr_algorithm *a,
                      const struct hsr_step *step, const json_t *cell,
                      const struct hsr_prices *prices) {
  struct hsr_term term;
  double cost = 0;
  for (int k = 0; hsr_step_term(step, k, &term); k++)
    cost += hsr_term_price(&term, prices) *
            count_in(cell, a->counters[term.counter].name);
  return cost;
}

double tables_frame_cost(const json_t *cell, const struct hsr_prices *prices) {
  const struct hsr_listed *listed =
      results_listed(results_text(cell, "algorithm"));
  if (!listed || !listed->plain->steps)
    return NAN;
  const struct paper_group *group = paper_group(listed->plain->name);
  double cost = 0;
  for (const struct hsr_step *s = listed->plain->steps; s->label; s++) {
    const struct paper_step *paper = paper_step(group, s->label);
    if (!paper || !paper->once)
      cost += cost_of(listed->plain, s, cell, prices);
  }
  return cost;
}

double tables_walk_cost(const struct tables *t, const char *algorithm) {
  char key[RESULTS_KEY];
  int length = results_picture_key(TABLES_WALK_SCENE, TABLES_VIEW, TABLES_WALK,
                                   TABLES_WALK_SIZE, TABLES_WALK_SIZE, key);
  snprintf(key + length, (size_t)(RESULTS_KEY - length), " %.100s 1",
           algorithm);
  return tables_frame_cost(results_cell(t->results, key), &t->prices);
}

static void fill_step(const struct tables *t, const struct table_algorithm *a,
                      struct table_step *row, const struct hsr_step *step) {
  row->step = step;
  row->paper = paper_step(a->paper, step->label);
  for (int s = 0; s < t->n_scenes; s++) {
    row->cost.measured[s] = cost_of(a->algorithm, step, a->cell[s], &t->prices);
    row->cost.predicted[s] =
        step->predict ? step->predict(&t->scene[s].measured) : NAN;
  }
  fit(t, &row->cost);
}

/* Steps without a prediction are only in the measured total. */
static void fill_total(const struct tables *t, struct table_algorithm *a) {
  for (int s = 0; s < t->n_scenes; s++) {
    double measured = 0, predicted = 0;
    for (int k = 0; k < a->n_steps; k++) {
      const struct table_step *row = &a->step[k];
      if (row->paper && row->paper->once)
        continue;
      measured += row->cost.measured[s];
      predicted += row->step->predict ? row->cost.predicted[s] : 0;
    }
    a->total.measured[s] = measured;
    a->total.predicted[s] = predicted;
  }
  fit(t, &a->total);
}

/* Is a step of an option that was not chosen: it has no prediction, and was
 * never taken? */
static bool is_idle(const struct tables *t, const struct table_step *row) {
  bool taken = row->step->predict != NULL;
  bool counted = false;
  for (int s = 0; s < t->n_scenes; s++) {
    taken |= row->cost.measured[s] > 0;
    counted |= !isnan(row->cost.measured[s]);
  }
  return counted && !taken;
}

static void fill_algorithm(const struct tables *t, struct table_algorithm *a,
                           const char *name,
                           const struct hsr_algorithm *algorithm) {
  a->name = name;
  a->algorithm = algorithm;
  a->paper = paper_group(algorithm->name);
  find_cells(t, a);
  for (const struct hsr_step *step = algorithm->steps;
       step->label && a->n_steps < MOST_STEPS; step++) {
    fill_step(t, a, &a->step[a->n_steps], step);
    a->n_steps += !is_idle(t, &a->step[a->n_steps]);
  }
  fill_total(t, a);
}

static enum hsr_status fill(struct tables *t, struct hsr_error *err) {
  int n = 0;
  for (const struct hsr_listed *l = hsr_algorithms(); l->plain; l++)
    n += l->plain->steps != NULL;
  t->algorithm = calloc((size_t)n + 1, sizeof *t->algorithm);
  t->variant = calloc(sizeof tables_variants / sizeof *tables_variants,
                      sizeof *t->variant);
  if (!t->algorithm || !t->variant)
    return hsr_fail_nomem(err);
  for (const struct hsr_listed *l = hsr_algorithms(); l->plain; l++)
    if (l->plain->steps)
      fill_algorithm(t, &t->algorithm[t->n_algorithms++], l->plain->name,
                     l->plain);
  for (const char *const *name = tables_variants; *name; name++)
    fill_algorithm(t, &t->variant[t->n_variants++], *name,
                   results_listed(*name)->plain);
  return HSR_OK;
}

enum hsr_status tables_new(struct tables **tables,
                           const struct results *results,
                           const struct hsr_prices *prices,
                           struct hsr_error *err) {
  *tables = NULL;
  struct tables *t = calloc(1, sizeof *t);
  if (!t)
    return hsr_fail_nomem(err);
  t->results = results;
  t->prices = *prices;
  enum hsr_status status = find_scenes(t, err);
  if (!status)
    status = fill(t, err);
  if (status)
    tables_delete(t);
  else
    *tables = t;
  return status;
}

struct tables *tables_of_standard(const struct tables *t) {
  struct tables *standard = NULL;
  if (!prices_are_standard(&t->prices))
    tables_new(&standard, t->results, &hsr_prices_standard, NULL);
  return standard;
}

void tables_delete(struct tables *tables) {
  if (tables) {
    free(tables->algorithm);
    free(tables->variant);
  }
  free(tables);
}

/* --- Looking things up ---------------------------------------------------- */

const struct table_algorithm *tables_algorithm(const struct tables *t,
                                               const char *name) {
  for (int a = 0; a < t->n_algorithms; a++)
    if (!strcmp(t->algorithm[a].name, name))
      return &t->algorithm[a];
  for (int a = 0; a < t->n_variants; a++)
    if (!strcmp(t->variant[a].name, name))
      return &t->variant[a];
  return NULL;
}

const struct series *tables_cost(const struct tables *t, const char *algorithm,
                                 const char *step) {
  const struct table_algorithm *a = tables_algorithm(t, algorithm);
  if (a && !step)
    return &a->total;
  for (int k = 0; a && k < a->n_steps; k++)
    if (!strcmp(a->step[k].step->label, step))
      return &a->step[k].cost;
  return NULL;
}

double tables_count(const struct tables *t, const char *algorithm,
                    const char *key, int scene) {
  const struct table_algorithm *a = tables_algorithm(t, algorithm);
  const json_t *cell = a ? a->cell[scene] : NULL;
  return strcmp(results_text(cell, "status"), "ok") ? NAN
                                                    : results_count(cell, key);
}

const char *tables_missing(const struct table_algorithm *a, int scene) {
  const json_t *cell = a->cell[scene];
  const char *status = json_string_value(json_object_get(cell, "status"));
  if (!status)
    return "not measured";
  if (strcmp(status, "ok"))
    return status;
  return json_is_object(json_object_get(cell, "counts")) ? NULL : "not counted";
}
