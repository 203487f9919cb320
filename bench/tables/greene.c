/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/tables/greene.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const struct greene_figure greene_figures[] = {
#include "bench/tables/greene.def"
    {.what = NULL}};

/* --- Ours ----------------------------------------------------------------- */

/* The least time of a frame: other work of the machine can only add to it. */
static double least_seconds(const json_t *cell) {
  double least = NAN;
  size_t s, k;
  const json_t *start, *seconds;
  json_array_foreach(json_object_get(cell, "starts"), s, start)
      json_array_foreach(json_object_get(start, "seconds"), k, seconds) least =
          fmin(least, json_number_value(seconds));
  return least;
}

static double samples_of(const json_t *cell) {
  double frames = fmax(1, (double)results_number(cell, "walk"));
  return frames * (double)results_number(cell, "width") *
         (double)results_number(cell, "height");
}

/* The sum of the counters in a list that '+' joins. */
static double sum_of_counts(const json_t *cell, const char *list) {
  double sum = 0;
  for (const char *at = list; *at;) {
    size_t length = strcspn(at, "+");
    char key[80];
    snprintf(key, sizeof key, "%.*s", (int)length, at);
    sum += results_count(cell, key);
    at += length + (at[length] == '+');
  }
  return sum;
}

static double value(const struct greene_term *term,
                    const struct results *results) {
  const json_t *cell = results_cell(results, term->cell);
  if (strcmp(results_text(cell, "status"), "ok"))
    return NAN;
  if (!strcmp(term->of, "seconds"))
    return least_seconds(cell);
  return strcmp(term->of, "samples") ? sum_of_counts(cell, term->of)
                                     : samples_of(cell);
}

double greene_measured(const struct greene_figure *f,
                       const struct results *results) {
  if (!f->source)
    return NAN;
  double over = value(&f->over, results);
  double under = f->under.cell ? value(&f->under, results) : 1;
  return (f->factor != 0 ? f->factor : 1) * over / under;
}

const char *greene_reason(const struct greene_figure *f, double ours) {
  double ratio = ours / f->printed;
  const char *why = ratio < 0.5 ? f->less : f->more;
  if (isnan(ratio) || (ratio >= 0.5 && ratio <= 2))
    return NULL;
  return why ? why : "not explained";
}

bool greene_is_measured(const struct results *results) {
  for (const struct greene_figure *f = greene_figures; f->what; f++)
    if (!isnan(greene_measured(f, results)))
      return true;
  return false;
}
