/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ladders: cells of one algorithm that differ in one thing only. They are of
 * one picture in several sizes, or of one view of a family of scenes, as
 * harbor:N is. */
#include "bench/report/data.h"
#include "bench/results/json.h"
#include "bench/tables/growth.h"
#include "bench/tables/tables.h"
#include "common/files/json/json.h"

#include <math.h>
#include <string.h>

enum { MOST_POINTS = 64, LEAST_POINTS = 3, KEY = RESULTS_KEY + 64 };

struct ladder {
  const char *measure, *over;
  int n;
  const json_t *cell[MOST_POINTS];
  double x[MOST_POINTS], y[MOST_POINTS];
};

/* What is measured of a cell; NAN: it was not. */
static double seconds_of(const json_t *cell, const struct cell_figures *f) {
  (void)cell;
  return f->starts ? f->median.value : NAN;
}

static double comparisons_of(const json_t *cell, const struct cell_figures *f) {
  (void)f;
  return tables_frame_cost(cell, &hsr_prices_standard);
}

static const struct measure {
  const char *name;
  double (*of)(const json_t *cell, const struct cell_figures *f);
} measures[] = {{"seconds", seconds_of}, {"comparisons", comparisons_of}};

/* --- Which cells are on one ladder ---------------------------------------- */

/* The name of a scene without its parameters: "harbor" of "harbor:500". All
 * meshes are scenes of their own. */
static int family_length(const char *scene) {
  bool mesh = !strcmp(scene, "mesh") || !strncmp(scene, "mesh:", 5);
  return (int)(mesh ? strlen(scene) : strcspn(scene, ":"));
}

/* What all cells of a ladder share. */
static void key_of(const json_t *cell, bool of_sizes, char key[KEY]) {
  const char *scene = results_text(cell, "scene");
  char view[RESULTS_VIEW], size[48] = "";
  results_view_name(results_number(cell, "view"), results_number(cell, "walk"),
                    view);
  if (!of_sizes)
    snprintf(size, sizeof size, "%ldx%ld", results_number(cell, "width"),
             results_number(cell, "height"));
  snprintf(key, KEY, "%.*s %ld %s %s %.*s", (int)RESULTS_MOST_NAME,
           results_text(cell, "algorithm"), results_number(cell, "threads"),
           view, size,
           of_sizes ? (int)RESULTS_MOST_SCENE : family_length(scene), scene);
}

/* key -> the numbers of its cells, in their order. */
static json_t *group(const struct report *report,
                     const struct cell_figures *figures,
                     const struct measure *measure, bool of_sizes) {
  json_t *groups = json_object();
  size_t k;
  const json_t *cell;
  json_array_foreach(report->results->cells, k, cell) {
    char key[KEY];
    if (!(measure->of(cell, &figures[k]) > 0))
      continue;
    key_of(cell, of_sizes, key);
    json_t *own = json_object_get(groups, key);
    if (!own) {
      own = json_array();
      json_object_set_new(groups, key, own);
    }
    json_array_append_new(own, json_integer((json_int_t)k));
  }
  return groups;
}

/* --- What it grows over --------------------------------------------------- */

static double table1_of(const struct report *report, const json_t *cell,
                        const char *symbol) {
  char key[RESULTS_KEY];
  results_picture_key(results_text(cell, "scene"), results_number(cell, "view"),
                      results_number(cell, "walk"),
                      results_number(cell, "width"),
                      results_number(cell, "height"), key);
  const json_t *view = results_view(report->results, key);
  const json_t *x = json_object_get(json_object_get(view, "table1"), symbol);
  return json_is_number(x) ? json_number_value(x) : NAN;
}

static double spread(const double *x, int n) {
  double low = INFINITY, high = -INFINITY;
  for (int k = 0; k < n; k++) {
    low = fmin(low, x[k]);
    high = fmax(high, x[k]);
  }
  return high / low;
}

static void climb_sizes(struct ladder *ladder) {
  ladder->over = "samples";
  for (int k = 0; k < ladder->n; k++)
    ladder->x[k] = (double)results_number(ladder->cell[k], "width") *
                   (double)results_number(ladder->cell[k], "height");
}

/* Scenes of a family grow in faces, in depth complexity, or in both. The ladder
 * is over the one that grows most. */
static void climb_scenes(const struct report *report, struct ladder *ladder) {
  double faces[MOST_POINTS], depth[MOST_POINTS];
  for (int k = 0; k < ladder->n; k++) {
    faces[k] = table1_of(report, ladder->cell[k], "F_r");
    depth[k] = table1_of(report, ladder->cell[k], "D_c");
  }
  bool deeper = spread(depth, ladder->n) >= spread(faces, ladder->n);
  ladder->over = deeper ? "depth" : "faces";
  memcpy(ladder->x, deeper ? depth : faces,
         (size_t)ladder->n * sizeof *ladder->x);
}

/* --- As JSON -------------------------------------------------------------- */

static json_t *points_json(const struct ladder *ladder) {
  json_t *points = json_array();
  for (int k = 0; k < ladder->n; k++) {
    const json_t *cell = ladder->cell[k];
    hsr_json_append(&points,
                    json_pack("{ss si si si so sf}", "scene",
                              results_text(cell, "scene"), "view",
                              (int)results_number(cell, "view"), "width",
                              (int)results_number(cell, "width"), "height",
                              (int)results_number(cell, "height"), "x",
                              number_or_null(ladder->x[k]), "y", ladder->y[k]));
  }
  return points;
}

/* A name for what all its rungs share: "house", or "harbor:N, 500x500". */
static void name_ladder(const struct ladder *ladder, char *name, size_t size) {
  const json_t *cell = ladder->cell[0];
  const char *scene = results_text(cell, "scene");
  if (!strcmp(ladder->over, "samples"))
    snprintf(name, size, "%.*s", (int)RESULTS_MOST_SCENE, scene);
  else
    snprintf(name, size, "%.*s:N, %ldx%ld", family_length(scene), scene,
             results_number(cell, "width"), results_number(cell, "height"));
}

/* NULL if it does not grow. */
static json_t *ladder_json(const struct ladder *ladder) {
  char name[RESULTS_MOST_SCENE + 64];
  name_ladder(ladder, name, sizeof name);
  struct growth growth = growth_fit(ladder->x, ladder->y, ladder->n);
  if (isnan(growth.exponent))
    return NULL;
  const json_t *cell = ladder->cell[0];
  return json_pack("{ss ss ss si ss so so so so}", "algorithm",
                   results_text(cell, "algorithm"), "measure", ladder->measure,
                   "of", name, "threads", (int)results_number(cell, "threads"),
                   "over", ladder->over, "exponent",
                   number_or_null(growth.exponent), "low",
                   number_or_null(growth.low), "high",
                   number_or_null(growth.high), "points", points_json(ladder));
}

static void add_ladders(json_t **all, const struct report *report,
                        const struct cell_figures *figures,
                        const struct measure *measure, bool of_sizes) {
  json_t *groups = group(report, figures, measure, of_sizes), *numbers;
  const char *key;
  json_object_foreach(groups, key, numbers) {
    struct ladder ladder = {.measure = measure->name};
    size_t i;
    const json_t *number;
    json_array_foreach(numbers, i, number) {
      if (ladder.n == MOST_POINTS)
        break;
      size_t k = (size_t)json_integer_value(number);
      ladder.cell[ladder.n] = json_array_get(report->results->cells, k);
      ladder.y[ladder.n] = measure->of(ladder.cell[ladder.n], &figures[k]);
      ladder.n++;
    }
    if (ladder.n < LEAST_POINTS)
      continue;
    if (of_sizes)
      climb_sizes(&ladder);
    else
      climb_scenes(report, &ladder);
    json_t *one = ladder_json(&ladder);
    if (one)
      hsr_json_append(all, one);
  }
  json_decref(groups);
}

json_t *ladders_json(const struct report *report,
                     const struct cell_figures *figures) {
  json_t *all = json_array();
  for (size_t k = 0; k < sizeof measures / sizeof *measures; k++) {
    add_ladders(&all, report, figures, &measures[k], false);
    add_ladders(&all, report, figures, &measures[k], true);
  }
  return all;
}
