/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The tables as one JSON object, of the schema hsr-tables/1. */
#include "bench/modules/modules.h"
#include "bench/tables/claims.h"
#include "bench/tables/greene.h"
#include "bench/tables/prices.h"
#include "bench/results/json.h"
#include "bench/results/descriptor.h"
#include "common/files/json/json.h"

#include <math.h>
#include <string.h>

/* --- Pieces --------------------------------------------------------------- */

/* The numbers of the three environments. */
static json_t *three(const double *x) {
  json_t *array = json_array();
  for (int e = 0; e < ENVIRONMENTS; e++)
    hsr_json_append(&array, number_or_null(x[e]));
  return array;
}

static json_t *three_or_null(const double *x) {
  return x && !isnan(x[0]) ? three(x) : json_null();
}

static json_t *ratios(const double *measured, const double *predicted) {
  double ratio[ENVIRONMENTS];
  for (int e = 0; e < ENVIRONMENTS; e++)
    ratio[e] =
        measured[e] > 0 && predicted[e] > 0 ? measured[e] / predicted[e] : NAN;
  return three(ratio);
}

static json_t *name_of(const struct paper_group *group) {
  return group ? json_string(group->name) : json_null();
}

/* --- Tables I to III ------------------------------------------------------ */

static json_t *environments_json(void) {
  json_t *array = json_array();
  for (int e = 0; e < ENVIRONMENTS; e++)
    hsr_json_append(&array,
                    json_pack("{ss ss si si si}", "scene",
                              paper_environments[e].scene, "title",
                              paper_environments[e].title, "view", TABLES_VIEW,
                              "width", TABLES_SIZE, "height", TABLES_SIZE));
  return array;
}

static json_t *ladder_json(const struct tables *t) {
  json_t *array = json_array();
  for (int s = ENVIRONMENTS; s < t->n_scenes; s++)
    hsr_json_append(&array,
                    json_pack("{ss so}", "scene", t->scene[s].name, "F_r",
                              number_or_null(t->scene[s].measured.F_r)));
  return array;
}

static json_t *table1_json(void) {
  json_t *array = json_array();
#define X(field, symbol, meaning)                                              \
  hsr_json_append(&array,                                                      \
                  json_pack("{ss ss}", "symbol", symbol, "meaning", meaning));
  HSR_TABLE1(X)
#undef X
  return array;
}

static json_t *statistic_json(const char *symbol, const double *rule,
                              const double *measured) {
  const struct paper_statistic *s = paper_statistic(symbol);
  return json_pack("{ss ss? so so so so}", "symbol", symbol, "rule",
                   s ? s->rule : NULL, "paper",
                   three_or_null(s ? s->figure : NULL), "rule_of_measured",
                   three(rule), "measured", three(measured), "ratio",
                   ratios(measured, rule));
}

static json_t *table2_json(const struct tables *t) {
  json_t *array = json_array();
  double rule[ENVIRONMENTS], measured[ENVIRONMENTS];
#define X(field, symbol, meaning)                                              \
  for (int e = 0; e < ENVIRONMENTS; e++) {                                     \
    rule[e] = t->scene[e].rules.field;                                         \
    measured[e] = t->scene[e].measured.field;                                  \
  }                                                                            \
  hsr_json_append(&array, statistic_json(symbol, rule, measured));
  HSR_TABLE1(X)
#undef X
  return array;
}

static json_t *growth_json(const struct series *s) {
  return json_pack(
      "{so so so so}", "measured", number_or_null(s->growth.exponent), "low",
      number_or_null(s->growth.low), "high", number_or_null(s->growth.high),
      "predicted", number_or_null(s->predicted_growth.exponent));
}

static json_t *step_json(const struct tables *t,
                         const struct table_algorithm *a,
                         const struct table_step *row) {
  return json_pack(
      "{ss so ss ss? so so so so so sb so}", "algorithm", a->algorithm->name,
      "group", name_of(a->paper), "step", row->step->label, "formula",
      row->step->formula, "terms",
      terms_json(a->algorithm, row->step, &t->prices), "paper",
      three_or_null(row->paper ? row->paper->figure : NULL), "predicted",
      three(row->cost.predicted), "measured", three(row->cost.measured),
      "ratio", ratios(row->cost.measured, row->cost.predicted), "once",
      row->paper && row->paper->once, "growth", growth_json(&row->cost));
}

static json_t *table3_json(const struct tables *t) {
  json_t *array = json_array();
  for (int a = 0; a < t->n_algorithms; a++)
    for (int k = 0; k < t->algorithm[a].n_steps; k++)
      hsr_json_append(&array,
                      step_json(t, &t->algorithm[a], &t->algorithm[a].step[k]));
  return array;
}

static json_t *prices_json(const struct tables *t) {
  json_t *array = json_array();
  for (int k = 0; k < HSR_N_KINDS; k++)
    hsr_json_append(
        &array,
        json_pack("{ss sf sf ss ss}", "kind", hsr_kinds[k].name, "price",
                  t->prices.of[k], "standard", hsr_kinds[k].price, "meaning",
                  hsr_kinds[k].meaning, "source", hsr_kinds[k].source));
  return array;
}

/* --- Tables IV to VII ----------------------------------------------------- */

static json_t *column_json(const struct table_algorithm *a, int e) {
  json_t *steps = json_array();
  for (int k = 0; k < a->n_steps; k++) {
    const struct table_step *row = &a->step[k];
    hsr_json_append(
        &steps,
        json_pack("{ss so so so sb}", "step", row->step->label, "paper",
                  number_or_null(row->paper ? row->paper->figure[e] : NAN),
                  "predicted", number_or_null(row->cost.predicted[e]),
                  "measured", number_or_null(row->cost.measured[e]), "once",
                  row->paper && row->paper->once));
  }
  return json_pack("{ss so so so so ss?}", "algorithm", a->algorithm->name,
                   "steps", steps, "predicted",
                   number_or_null(a->total.predicted[e]), "measured",
                   number_or_null(a->total.measured[e]), "paper",
                   number_or_null(a->paper ? a->paper->total[e] : NAN),
                   "missing", tables_missing(a, e));
}

static json_t *summary_json(const struct tables *t) {
  json_t *array = json_array();
  for (int e = 0; e < ENVIRONMENTS; e++) {
    json_t *columns = json_array();
    for (int a = 0; a < t->n_algorithms; a++)
      hsr_json_append(&columns, column_json(&t->algorithm[a], e));
    hsr_json_append(&array,
                    json_pack("{ss so}", "scene", paper_environments[e].scene,
                              "columns", columns));
  }
  return array;
}

static json_t *table7_json(const struct tables *t) {
  json_t *array = json_array();
  for (int k = 0; k < t->n_algorithms; k++) {
    const struct table_algorithm *a = &t->algorithm[k];
    hsr_json_append(
        &array,
        json_pack("{ss so so so so so}", "algorithm", a->algorithm->name,
                  "group", name_of(a->paper), "paper",
                  three_or_null(a->paper ? a->paper->total : NULL), "predicted",
                  three(a->total.predicted), "measured",
                  three(a->total.measured), "growth", growth_json(&a->total)));
  }
  return array;
}

/* --- The taxonomy --------------------------------------------------------- */

static json_t *figure13_json(void) {
  json_t *array = json_array();
  for (int b = 0; b < HSR_YARDSTICK; b++) {
    json_t *names = json_array();
    for (const struct hsr_listed *l = hsr_algorithms(); l->plain; l++)
      if (l->plain->taxonomy == (enum hsr_branch)b)
        hsr_json_append(&names, json_string(l->plain->name));
    struct taxonomy place = taxonomy((enum hsr_branch)b);
    hsr_json_append(&array,
                    json_pack("{ss ss? so}", "class", place.class, "branch",
                              place.branch, "algorithms", names));
  }
  return array;
}

static json_t *figure29a_json(void) {
  json_t *array = json_array();
  for (const struct hsr_listed *l = hsr_algorithms(); l->plain; l++)
    if (l->plain->taxonomy != HSR_YARDSTICK)
      hsr_json_append(&array,
                      json_pack("{ss so so}", "algorithm", l->plain->name,
                                "restrictions", restrictions_json(l->plain),
                                "lifted", lifted_json(l->plain)));
  return array;
}

static json_t *figure29b_json(void) {
  json_t *array = json_array();
  for (const struct hsr_listed *l = hsr_algorithms(); l->plain; l++)
    if (l->plain->taxonomy != HSR_YARDSTICK)
      hsr_json_append(&array,
                      json_pack("{ss ss? ss? so}", "algorithm", l->plain->name,
                                "sort_order", l->plain->sort_order, "coherence",
                                l->plain->coherence, "sorts",
                                sorts_json(l->plain)));
  return array;
}

/* The element of the array for this sorting order, or NULL. */
static json_t *of_order(const json_t *array, const char *order) {
  size_t k;
  json_t *row;
  json_array_foreach(
      array, k,
      row) if (!strcmp(json_string_value(json_object_get(row, "order")),
                       order)) return row;
  return NULL;
}

static json_t *orders_json(void) {
  json_t *array = json_array();
  for (const struct hsr_listed *l = hsr_algorithms(); l->plain && array; l++) {
    const char *order = l->plain->sort_order;
    if (!order)
      continue;
    json_t *row = of_order(array, order);
    if (!row) {
      hsr_json_append(&array,
                      json_pack("{ss s[]}", "order", order, "algorithms"));
      row = of_order(array, order);
    }
    json_t *names = json_object_get(row, "algorithms");
    if (json_array_append_new(names, json_string(l->plain->name))) {
      json_decref(array);
      array = NULL;
    }
  }
  return array;
}

/* --- Greene --------------------------------------------------------------- */

static json_t *figure_json(const struct greene_figure *f, const char *table,
                           double ours) {
  return json_pack("{ss ss ss so so so ss?}", "table", table, "what", f->what,
                   "source", f->source, "paper", number_or_null(f->printed),
                   "ours", number_or_null(ours), "ratio",
                   number_or_null(ours / f->printed), "reason",
                   greene_reason(f, ours));
}

json_t *greene_json(const struct results *results) {
  json_t *array = json_array();
  const char *table = "";
  for (const struct greene_figure *f = greene_figures; f->what; f++)
    if (f->source)
      hsr_json_append(&array,
                      figure_json(f, table, greene_measured(f, results)));
    else
      table = f->what;
  return array;
}

/* --- Conclusions ---------------------------------------------------------- */

static json_t *conclusions_json(const struct tables *t) {
  json_t *array = json_array();
  struct tables *standard = tables_of_standard(t);
  for (int k = 0; k < claims_count(); k++) {
    struct conclusion c = claims_judge(t, k);
    json_t *row = json_pack("{ss ss ss ss? ss ss ss}", "section", c.section,
                            "sentence", c.sentence, "claim", c.claim, "erratum",
                            c.erratum, "criterion", c.criterion, "verdict",
                            finding_name(c.finding), "evidence", c.evidence);
    if (standard)
      json_object_set_new(
          row, "at_standard_prices",
          json_string(finding_name(claims_judge(standard, k).finding)));
    hsr_json_append(&array, row);
  }
  tables_delete(standard);
  return array;
}

json_t *tables_json(const struct tables *t) {
  return json_pack("{ss so so so so so so so so so so so so so so}", "schema",
                   "hsr-tables/1", "environments", environments_json(),
                   "ladder", ladder_json(t), "table1", table1_json(), "table2",
                   table2_json(t), "prices", prices_json(t), "table3",
                   table3_json(t), "summary", summary_json(t), "table7",
                   table7_json(t), "figure13", figure13_json(),
                   "sorting_orders", orders_json(), "figure29a",
                   figure29a_json(), "figure29b", figure29b_json(), "greene",
                   greene_json(t->results), "conclusions", conclusions_json(t));
}
