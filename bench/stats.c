/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr stats: Table I of Sutherland et al. 1974, measured. */
#include "bench/command.h"
#include "bench/results/json.h"
#include "bench/terminal/terminal.h"
#include "common/statistics/statistics.h"

#include <math.h>

struct options {
  struct option_base base;
  struct view_options view;
  struct scene_options scene;
  bool json;
};

static error_t parse(int key, char *arg, struct argp_state *state) {
  struct options *o = state->input;
  error_t unknown;
  switch (key) {
  case 'j':
    o->json = true;
    return 0;
  default:
    unknown = parse_scene_option(&o->scene, key, arg, "stats", &o->base);
    return unknown == ARGP_ERR_UNKNOWN
               ? parse_view_option(&o->view, key, arg, &o->base)
               : unknown;
  }
}

static const struct argp argp = {
    (const struct argp_option[]){
        {"json", 'j', NULL, 0, "print one JSON object", 0},
        SCENE_ARGP_OPTIONS,
        VIEW_ARGP_OPTIONS,
        {0}},
    parse,
    "SCENE",
    "Measures Table I of Sutherland, Sproull and Schumacker for a scene and a "
    "view, and prints Table II's rules of thumb beside it, computed from the "
    "measured n, m, F_r, F_c and D_c.\v"
    "  hsr stats harbor --size 500x500",
    NULL,
    NULL,
    NULL};

/* X(field, symbol, meaning) */
static const struct {
  const char *symbol, *meaning;
  size_t offset;
} rows[] = {
#define X(field, symbol, meaning)                                              \
  {symbol, meaning, offsetof(struct hsr_table1, field)},
    HSR_TABLE1(X)
#undef X
};
enum { N_ROWS = sizeof rows / sizeof rows[0] };

static double cell(const struct hsr_table1 *table, int row) {
  return *(const double *)((const char *)table + rows[row].offset);
}

static enum hsr_status print_json(const struct options *o,
                                  const struct hsr_table1 *measured,
                                  const struct hsr_table1 *rules,
                                  struct hsr_error *err) {
  json_t *table = json_array();
  for (int k = 0; k < N_ROWS; k++)
    hsr_json_append(&table, json_pack("{ss ss so so}", "symbol", rows[k].symbol,
                                      "meaning", rows[k].meaning, "measured",
                                      number_or_null(cell(measured, k)), "rule",
                                      number_or_null(cell(rules, k))));
  return json_print(json_pack("{ss ss si si si so}", "schema", "hsr-stats/1",
                              "scene", o->scene.name, "view", (int)o->view.view,
                              "width", o->view.m, "height", o->view.n, "table",
                              table),
                    err);
}

static void print_number(double x) {
  if (isnan(x))
    printf(" %12s", "-");
  else if (fabs(x - nearbyint(x)) < 1e-9 && fabs(x) < 1e9)
    printf(" %12.0f", x);
  else
    printf(" %12.4g", x);
}

static void print_text(const struct options *o,
                       const struct hsr_table1 *measured,
                       const struct hsr_table1 *rules) {
  char name[TERMINAL_NAME];
  printf("%s, view %ld, %d x %d\n\n",
         terminal_plain(o->scene.name, name, sizeof name), o->view.view,
         o->view.m, o->view.n);
  printf("%-4s %12s %12s %8s  %s\n", "", "measured", "rule", "ratio",
         "Table I of the 1974 survey");
  for (int k = 0; k < N_ROWS; k++) {
    double a = cell(measured, k), b = cell(rules, k);
    printf("%-4s", rows[k].symbol);
    print_number(a);
    print_number(b);
    if (a > 0 && b > 0)
      printf(" %8.3g", a / b);
    else
      printf(" %8s", "-");
    fputs("  ", stdout);
    terminal_wrap(stdout, 41, 41, rows[k].meaning);
  }
}

enum hsr_status measure_table1(const struct hsr_world *world,
                               const struct hsr_view *view,
                               struct hsr_table1 *table,
                               struct hsr_error *err) {
  struct hsr_answer answer = {.body = NULL};
  struct hsr_tally tally = {.out_of_memory = false};
  struct hsr_setup setup = {.algorithm = NULL};
  const struct hsr_listed *zbuffer = hsr_algorithm_find("zbuffer");
  enum hsr_status status =
      hsr_setup_init(&setup, zbuffer->plain, NULL, world, err);
  if (!status)
    status = answer_init(&answer, &setup, view, err);
  if (!status)
    status = render_view(&setup, view, 1, &answer, &tally, NULL, err);
  if (setup.algorithm)
    hsr_setup_free(&setup);
  if (!status)
    status = hsr_statistics_measure(world, view, hsr_answer_ids_of(&answer),
                                    table, err);
  hsr_answer_free(&answer);
  return status;
}

static enum hsr_status measure(const struct options *o,
                               const struct hsr_world *world,
                               const struct hsr_view *view,
                               struct hsr_error *err) {
  struct hsr_table1 measured, rules;
  enum hsr_status status = measure_table1(world, view, &measured, err);
  if (status)
    return status;
  hsr_statistics_rules(&measured, &rules);
  if (o->json)
    return print_json(o, &measured, &rules, err);
  print_text(o, &measured, &rules);
  return HSR_OK;
}

enum hsr_status command_stats(int argc, char **argv, struct hsr_error *err) {
  struct options options = {.view = VIEW_OPTIONS_STANDARD};
  enum hsr_status status = parse_options(&argp, argc, argv, &options, err);
  if (!status)
    status = aim_scene(&options.scene, &options.view, err);
  if (status)
    return status;
  struct hsr_scene *scene;
  status = open_scene(options.scene.name, options.scene.import, &scene, err);
  if (status)
    return status;
  struct hsr_world world = {.outline.scene = scene};
  struct hsr_view view;
  status = choose_view(&options.view, scene, 1, &view, err);
  if (!status)
    status = hsr_world_open(&world, scene, HSR_MOST_LAID_OUT, err);
  if (!status && hsr_is_outline(&world))
    status = hsr_fail(err, HSR_E_NOMEM,
                      "stats: %u faces are too many to be laid out, as Table I "
                      "needs them",
                      world.n_faces);
  if (!status)
    status = measure(&options, &world, &view, err);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
  return status;
}
