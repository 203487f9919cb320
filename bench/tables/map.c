/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/tables/map.h"

#include "bench/tables/tables.h"
#include "common/base/arena.h"

#include <gsl/gsl_multifit.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Two values of a dial are the same if they are no farther apart. */
static const double SAME = 1.1;

/* A view, and what each algorithm costs there; NAN: not counted, or wrong. */
struct place {
  const json_t *view;
  struct hsr_table1 table;
  double *cost, *predicted; /* by algorithm */
};

struct priced {
  const char *name;
  const struct hsr_algorithm *algorithm;
};

struct map {
  const struct results *results;
  const struct hsr_prices *prices;
  struct priced *algorithm; /* those that have steps, and variants of them */
  int n_algorithms;
  struct place *place;
  size_t n_places;
  double *faces, *depth; /* the values of the dials, in order */
  int n_faces, n_depths;
  struct hsr_arena arena;
};

/* --- Costs ---------------------------------------------------------------- */

/* Which of them a map shows. The survey prices z-buffers, too. */
enum who { SURVEY, ORDERS, ALL };
static bool is_shown(const struct priced *a, enum who who) {
  return who == ALL      ? true
         : who == ORDERS ? !strcmp(a->algorithm->name, "sort-stages")
                         : paper_group(a->name) != NULL;
}

static double cost_at(const struct map *map, const struct place *place,
                      const struct priced *a) {
  char key[RESULTS_KEY];
  int length = results_picture_key(results_text(place->view, "scene"),
                                   results_number(place->view, "view"), 0,
                                   results_number(place->view, "width"),
                                   results_number(place->view, "height"), key);
  snprintf(key + length, (size_t)(RESULTS_KEY - length), " %.100s 1", a->name);
  const json_t *cell = results_cell(map->results, key);
  return cell ? tables_frame_cost(cell, map->prices) : NAN;
}

/* By the formulas of Table III, with what is measured in Table I. NAN if a step
 * has none. */
static double predicted_at(const struct place *place, const struct priced *a) {
  const struct paper_group *group = paper_group(a->name);
  double sum = 0;
  for (const struct hsr_step *s = a->algorithm->steps; group && s->label; s++) {
    const struct paper_step *paper = paper_step(group, s->label);
    if (paper && !paper->once)
      sum += s->predict ? s->predict(&place->table) : NAN;
  }
  return group ? sum : NAN;
}

static enum hsr_status find_algorithms(struct map *map) {
  size_t n = 0;
  for (const struct hsr_listed *l = hsr_algorithms(); l->plain; l++)
    n++;
  for (const char *const *variant = tables_variants; *variant; variant++)
    n++;
  map->algorithm = HSR_NEW(&map->arena, struct priced, n);
  if (!map->algorithm)
    return HSR_E_NOMEM;
  for (const struct hsr_listed *l = hsr_algorithms(); l->plain; l++)
    if (l->plain->steps)
      map->algorithm[map->n_algorithms++] =
          (struct priced){l->plain->name, l->plain};
  for (const char *const *variant = tables_variants; *variant; variant++)
    map->algorithm[map->n_algorithms++] =
        (struct priced){*variant, results_listed(*variant)->plain};
  return HSR_OK;
}

static enum hsr_status find_places(struct map *map) {
  const json_t *views = map->results->views;
  const size_t n = json_array_size(views);
  map->place = HSR_NEW(&map->arena, struct place, n);
  if (!map->place)
    return HSR_E_NOMEM;
  for (size_t k = 0; k < n; k++) {
    struct place *place = &map->place[map->n_places];
    const json_t *view = json_array_get(views, k);
    const size_t each = (size_t)map->n_algorithms;
    *place = (struct place){view, tables_table1(view),
                            HSR_NEW(&map->arena, double, each),
                            HSR_NEW(&map->arena, double, each)};
    if (!place->cost || !place->predicted)
      return HSR_E_NOMEM;
    if (!(place->table.F_r > 0) || !(place->table.D_c > 0))
      continue;
    map->n_places++;
    for (int a = 0; a < map->n_algorithms; a++) {
      place->cost[a] = cost_at(map, place, &map->algorithm[a]);
      place->predicted[a] = predicted_at(place, &map->algorithm[a]);
    }
  }
  return HSR_OK;
}

/* --- The dials ------------------------------------------------------------ */

static int compare(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static bool is_same(double a, double b) {
  return a < b * SAME && b < a * SAME;
}

/* Sorts n values, and keeps one of those that are the same. Returns how many. */
static int distinct(double *value, size_t n) {
  int kept = 0;
  qsort(value, n, sizeof *value, compare);
  for (size_t k = 0; k < n; k++)
    if (!kept || !is_same(value[k], value[kept - 1]))
      value[kept++] = value[k];
  return kept;
}

static enum hsr_status find_dials(struct map *map) {
  map->faces = HSR_NEW(&map->arena, double, map->n_places);
  map->depth = HSR_NEW(&map->arena, double, map->n_places);
  if (!map->faces || !map->depth)
    return HSR_E_NOMEM;
  for (size_t k = 0; k < map->n_places; k++) {
    map->faces[k] = map->place[k].table.F_r;
    map->depth[k] = map->place[k].table.D_c;
  }
  map->n_faces = distinct(map->faces, map->n_places);
  map->n_depths = distinct(map->depth, map->n_places);
  return HSR_OK;
}

static const struct place *place_at(const struct map *map, double faces,
                                    double depth) {
  for (size_t k = 0; k < map->n_places; k++)
    if (is_same(map->place[k].table.F_r, faces) &&
        is_same(map->place[k].table.D_c, depth))
      return &map->place[k];
  return NULL;
}

/* --- Printing ------------------------------------------------------------- */

enum { CELL = 18 };

/* Of a variant, what is chosen last. */
static const char *short_name(const char *name) {
  const char *choice = strrchr(name, '=');
  return choice ? choice + 1 : name;
}

/* "warnock 1.23M", the cheapest at a place. With `predicted`, by formulas. */
static void print_cheapest(const struct map *map, const struct place *place,
                           enum who who, bool predicted) {
  char text[CELL + 40] = "-";
  double least = INFINITY;
  for (int a = 0; place && a < map->n_algorithms; a++) {
    const double cost = predicted ? place->predicted[a] : place->cost[a];
    if (!is_shown(&map->algorithm[a], who) || !(cost < least))
      continue;
    least = cost;
    snprintf(text, sizeof text, "%.11s %s", short_name(map->algorithm[a].name),
             short_number(cost).text);
  }
  printf(" %*s", CELL - 1, text);
}

static void print_map(const struct map *map, const char *title, enum who who,
                      bool predicted) {
  printf("\n%s\n\n%7s", title, "F_r");
  for (int d = 0; d < map->n_depths; d++)
    printf("%*sD_c %-5.3g", CELL - 9, "", map->depth[d]);
  putchar('\n');
  for (int f = 0; f < map->n_faces; f++) {
    printf("%7.0f", map->faces[f]);
    for (int d = 0; d < map->n_depths; d++)
      print_cheapest(map, place_at(map, map->faces[f], map->depth[d]), who,
                     predicted);
    putchar('\n');
  }
}

/* cost ~ F_r^p D_c^q by least squares over the logarithms. */
struct exponents {
  double p, q;
  size_t n; /* places in the fit */
};

/* Fills the equations with the places where a cost is known. Without a vector it
 * counts them. */
static size_t equations(const struct map *map, int a, bool predicted,
                        gsl_matrix *x, gsl_vector *y) {
  size_t n = 0;
  for (size_t k = 0; k < map->n_places; k++) {
    const struct place *place = &map->place[k];
    const double cost = predicted ? place->predicted[a] : place->cost[a];
    if (!(cost > 0) || !isfinite(cost))
      continue;
    if (y) {
      gsl_matrix_set(x, n, 0, 1);
      gsl_matrix_set(x, n, 1, log(place->table.F_r));
      gsl_matrix_set(x, n, 2, log(place->table.D_c));
      gsl_vector_set(y, n, log(cost));
    }
    n++;
  }
  return n;
}

enum { UNKNOWNS = 3 };

static struct exponents fit(const struct map *map, int a, bool predicted) {
  struct exponents e = {NAN, NAN, equations(map, a, predicted, NULL, NULL)};
  if (e.n <= UNKNOWNS || map->n_faces < 2 || map->n_depths < 2)
    return e;
  gsl_matrix *x = gsl_matrix_alloc(e.n, UNKNOWNS);
  gsl_vector *y = gsl_vector_alloc(e.n), *c = gsl_vector_alloc(UNKNOWNS);
  gsl_matrix *covariance = gsl_matrix_alloc(UNKNOWNS, UNKNOWNS);
  gsl_multifit_linear_workspace *work =
      gsl_multifit_linear_alloc(e.n, UNKNOWNS);
  double left_over;
  if (x && y && c && covariance && work) {
    equations(map, a, predicted, x, y);
    if (!gsl_multifit_linear(x, y, c, covariance, &left_over, work)) {
      e.p = gsl_vector_get(c, 1);
      e.q = gsl_vector_get(c, 2);
    }
  }
  gsl_matrix_free(x);
  gsl_matrix_free(covariance);
  gsl_vector_free(y);
  gsl_vector_free(c);
  gsl_multifit_linear_free(work);
  return e;
}

static void print_exponent(double x) {
  if (isnan(x))
    printf(" %8s", "-");
  else
    printf(" %8.2f", x);
}

static void print_growth(const struct map *map) {
  printf("\nHow costs grow: as F_r^p D_c^q, fitted to all places\n\n"
         "%-26s %17s %17s %8s\n%-26s %8s %8s %8s %8s %8s\n",
         "", "measured", "by formula", "", "algorithm", "p", "q", "p", "q",
         "places");
  for (int a = 0; a < map->n_algorithms; a++) {
    const struct exponents measured = fit(map, a, false);
    const struct exponents formula = fit(map, a, true);
    if (!measured.n)
      continue;
    printf("%-26s", map->algorithm[a].name);
    print_exponent(measured.p);
    print_exponent(measured.q);
    print_exponent(formula.p);
    print_exponent(formula.q);
    printf(" %8zu\n", measured.n);
  }
}

enum hsr_status map_print(const struct results *results,
                          const struct hsr_prices *prices,
                          struct hsr_error *err) {
  struct map map = {.results = results, .prices = prices};
  enum hsr_status status = find_algorithms(&map);
  if (!status)
    status = find_places(&map);
  if (!status)
    status = find_dials(&map);
  if (status)
    status = hsr_fail_nomem(err);
  else if (!map.n_places)
    status = hsr_fail(err, HSR_E_INPUT,
                      "tables: no view of the results has Table I");
  else {
    print_map(&map, "The cheapest of the survey's", SURVEY, false);
    print_map(&map, "The same by the survey's formulas", SURVEY, true);
    print_map(&map, "The cheapest of all that have prices", ALL, false);
    print_map(&map, "The cheapest order of sorts (sort-stages)", ORDERS, false);
    print_growth(&map);
  }
  hsr_arena_free(&map.arena);
  return status;
}
