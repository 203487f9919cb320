/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr steps: Table III of Sutherland et al. 1974, measured: the cost of every
 * step of every algorithm beside what the survey's formula makes of the
 * measured Table I, and how both grow with the relevant faces. */
#include "bench/command.h"
#include "bench/json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
  MOST_SCENES = 16,
  MOST_ALGORITHMS = 64,
  MOST_STEPS = 16,
  GROWTH = 0x200
};

/* From Roberts' house to the big harbor, at one depth complexity. */
static const char *const growth_scenes[] = {"harbor:100",   "harbor:500",
                                            "harbor:2500",  "harbor:10000",
                                            "harbor:30000", "harbor:60000"};

struct options {
  struct option_base base;
  struct view_options view;
  const char *scene[MOST_SCENES];
  int n_scenes;
  const struct hsr_listed *algorithm[MOST_ALGORITHMS];
  int n_algorithms;
  long timeout;
  bool json, growth;
};

/* --- Options ---------------------------------------------------------------
 */

static bool has_steps(const struct hsr_algorithm *a) {
  return a->steps && a->steps[0].label;
}

static error_t add_algorithms(struct options *o, char *arg) {
  for (char *name = strtok(arg, ","); name; name = strtok(NULL, ",")) {
    const struct hsr_listed *listed;
    if (choose_algorithm(name, &listed, o->base.err)) {
      o->base.failed = true;
      return EINVAL;
    }
    if (!has_steps(listed->counting))
      return option_fail(&o->base, "steps: %s has no steps in Table III", name);
    if (o->n_algorithms == MOST_ALGORITHMS)
      return option_fail(&o->base, "steps: at most %d algorithms",
                         (int)MOST_ALGORITHMS);
    o->algorithm[o->n_algorithms++] = listed;
  }
  return 0;
}

static error_t add_scene(struct options *o, const char *name) {
  if (o->n_scenes == MOST_SCENES)
    return option_fail(&o->base, "steps: at most %d scenes", (int)MOST_SCENES);
  o->scene[o->n_scenes++] = name;
  return 0;
}

/* What was not said. */
static error_t complete(struct options *o) {
  if (o->growth && o->n_scenes)
    return option_fail(&o->base, "steps: --growth brings its own scenes");
  if (!o->growth && !o->n_scenes)
    return option_fail(&o->base, "steps: which scene? (see hsr steps --help)");
  for (size_t k = 0;
       o->growth && k < sizeof growth_scenes / sizeof *growth_scenes; k++)
    add_scene(o, growth_scenes[k]);
  if (!o->n_algorithms)
    for (const struct hsr_listed *a = hsr_algorithms; a->plain; a++)
      if (has_steps(a->counting))
        o->algorithm[o->n_algorithms++] = a;
  return 0;
}

static error_t parse(int key, char *arg, struct argp_state *state) {
  struct options *o = state->input;
  switch (key) {
  case 'a':
    return add_algorithms(o, arg);
  case 'j':
    o->json = true;
    return 0;
  case 't':
    if (!parse_count(arg, 1, 86400, &o->timeout))
      return option_fail(&o->base, "-t %s: must be seconds from 1 to 86400",
                         arg);
    return 0;
  case GROWTH:
    o->growth = true;
    return 0;
  case ARGP_KEY_ARG:
    return add_scene(o, arg);
  case ARGP_KEY_END:
    return complete(o);
  default:
    return parse_view_option(&o->view, key, arg, &o->base);
  }
}

static const struct argp argp = {
    (const struct argp_option[]){
        {"algorithms", 'a', "A,B,...", 0,
         "these algorithms (standard: all that have steps in Table III)", 0},
        {"growth", GROWTH, NULL, 0,
         "the harbor from 100 to 60,000 faces in the picture", 0},
        {"timeout", 't', "SECONDS", 0,
         "leave out what is known to take longer (standard: 60)", 0},
        {"json", 'j', NULL, 0, "print one JSON object", 0},
        VIEW_ARGP_OPTIONS,
        {0}},
    parse,
    "SCENE...",
    "Counts the steps of algorithms as in Table III of Sutherland, Sproull and "
    "Schumacker: the cost of each, a complexity factor times a count, beside "
    "what the survey's formula makes of the measured Table I. Of several "
    "scenes "
    "the growth exponent of each step is fitted over their relevant faces.\v"
    "  hsr steps house harbor big-harbor -a watkins --size 500x500\n"
    "  hsr steps --growth -a newell,warnock,watkins",
    NULL,
    NULL,
    NULL};

/* --- Measuring -------------------------------------------------------------
 */

/* An algorithm on a scene: a cost a step; NAN where there is none. */
struct column {
  double measured[MOST_STEPS], predicted[MOST_STEPS];
  bool refused;
};

struct measurement {
  const struct options *options;
  double F_r[MOST_SCENES];
  struct column *columns; /* scene-major: n_scenes * n_algorithms */
};

static struct column *column_at(const struct measurement *m, int scene,
                                int algorithm) {
  return &m->columns[scene * m->options->n_algorithms + algorithm];
}

static enum hsr_status
run_algorithm(const struct hsr_algorithm *a, const struct hsr_world *world,
              const struct hsr_view *view, const struct hsr_table1 *table,
              struct column *column, struct hsr_error *err) {
  struct hsr_tally tally = {.out_of_memory = false};
  struct answer answer;
  struct hsr_setup setup;
  enum hsr_status status = hsr_setup_init(&setup, a, world, err);
  if (!status) {
    status = answer_init(&answer, a, view, err);
    if (!status)
      status = render_view(&setup, view, 1, &answer, &tally, NULL, err);
    answer_free(&answer);
  }
  hsr_setup_free(&setup);
  if (status == HSR_E_REFUSED) {
    column->refused = true;
    return HSR_OK;
  }
  for (int k = 0; k < MOST_STEPS && a->steps[k].label; k++) {
    const struct hsr_step *step = &a->steps[k];
    column->measured[k] = step->factor * (double)tally.count[step->counter];
    column->predicted[k] = step->predict ? step->predict(table) : NAN;
  }
  return status;
}

static enum hsr_status measure_world(struct measurement *m, int scene,
                                     const struct hsr_world *world,
                                     const struct hsr_view *view,
                                     struct hsr_error *err) {
  const struct options *o = m->options;
  struct hsr_table1 table;
  enum hsr_status status = measure_table1(world, view, &table, err);
  m->F_r[scene] = table.F_r;
  for (int a = 0; a < o->n_algorithms && !status; a++) {
    const struct hsr_algorithm *algorithm = o->algorithm[a]->counting;
    struct column *column = column_at(m, scene, a);
    column->refused = algorithm->expense && algorithm->expense(world, view) >
                                                5e8 * (double)o->timeout;
    if (!column->refused)
      status = run_algorithm(algorithm, world, view, &table, column, err);
  }
  return status;
}

static enum hsr_status measure_scene(struct measurement *m, int scene,
                                     struct hsr_error *err) {
  const struct options *o = m->options;
  struct hsr_import import = {.drop_degenerate = false};
  struct hsr_scene *opened;
  enum hsr_status status =
      hsr_scene_open(o->scene[scene], &import, &opened, err);
  if (status)
    return status;
  struct hsr_world world = {.scene = NULL};
  struct hsr_view view;
  struct hsr_camera camera;
  status = choose_camera(&o->view, opened, &camera, err);
  if (!status)
    status = hsr_view_init(&view, &camera, o->view.m, o->view.n, err);
  if (!status)
    status = hsr_world_init(&world, opened, err);
  if (!status)
    status = measure_world(m, scene, &world, &view, err);
  hsr_world_free(&world);
  hsr_scene_delete(opened);
  return status;
}

/* --- Growth ----------------------------------------------------------------
 */

/* The exponent e of cost ~ F_r^e, by least squares over the logarithms; NAN for
 * fewer than two points. */
static double growth(const struct measurement *m, int algorithm, int step,
                     bool predicted) {
  double n = 0, x1 = 0, y1 = 0, xx = 0, xy = 0;
  for (int s = 0; s < m->options->n_scenes; s++) {
    const struct column *c = column_at(m, s, algorithm);
    double cost = predicted ? c->predicted[step] : c->measured[step];
    if (c->refused || !(cost > 0) || !(m->F_r[s] > 0))
      continue;
    double x = log(m->F_r[s]), y = log(cost);
    n++;
    x1 += x;
    y1 += y;
    xx += x * x;
    xy += x * y;
  }
  double spread = n * xx - x1 * x1;
  return n >= 2 && spread > 0 ? (n * xy - x1 * y1) / spread : NAN;
}

/* --- The report ------------------------------------------------------------
 */

static void print_cost(double cost) {
  if (isnan(cost))
    printf(" %13s", "-");
  else if (cost < 1e6)
    printf(" %13.0f", cost);
  else
    printf(" %13.3g", cost);
}

static void print_growth(double exponent) {
  if (isnan(exponent))
    printf(" %8s", "-");
  else
    printf(" %8.2f", exponent);
}

static void print_row(const struct measurement *m, int algorithm, int step,
                      bool predicted) {
  const struct options *o = m->options;
  for (int s = 0; s < o->n_scenes; s++) {
    const struct column *c = column_at(m, s, algorithm);
    if (c->refused)
      printf(" %13s", "refused");
    else
      print_cost(predicted ? c->predicted[step] : c->measured[step]);
  }
  if (o->n_scenes > 1)
    print_growth(growth(m, algorithm, step, predicted));
}

static void print_algorithm(const struct measurement *m, int algorithm) {
  const struct hsr_algorithm *a = m->options->algorithm[algorithm]->counting;
  printf("\n%s\n", a->name);
  for (int k = 0; k < MOST_STEPS && a->steps[k].label; k++) {
    printf("  %-26s measured ", a->steps[k].label);
    print_row(m, algorithm, k, false);
    printf("\n  %-26s predicted", "");
    print_row(m, algorithm, k, true);
    printf("  %s\n", a->steps[k].formula ? a->steps[k].formula : "");
  }
}

static void print_text(const struct measurement *m) {
  const struct options *o = m->options;
  printf("Table III of Sutherland, Sproull and Schumacker 1974, view %ld, %d x "
         "%d\n\n%-38s",
         o->view.view, o->view.m, o->view.n, "");
  for (int s = 0; s < o->n_scenes; s++)
    printf(" %13s", o->scene[s]);
  printf("%s\n%-38s", o->n_scenes > 1 ? "   growth" : "",
         "  relevant faces F_r");
  for (int s = 0; s < o->n_scenes; s++)
    print_cost(m->F_r[s]);
  putchar('\n');
  for (int a = 0; a < o->n_algorithms; a++)
    print_algorithm(m, a);
}

static json_t *step_json(const struct measurement *m, int algorithm, int step) {
  const struct options *o = m->options;
  const struct hsr_step *s = &o->algorithm[algorithm]->counting->steps[step];
  json_t *measured = json_array(), *predicted = json_array();
  for (int scene = 0; scene < o->n_scenes; scene++) {
    const struct column *c = column_at(m, scene, algorithm);
    json_append(&measured,
                c->refused ? json_null() : number_or_null(c->measured[step]));
    json_append(&predicted,
                c->refused ? json_null() : number_or_null(c->predicted[step]));
  }
  return json_pack(
      "{ss sf ss? so so so so}", "step", s->label, "factor", s->factor,
      "formula", s->formula, "measured", measured, "predicted", predicted,
      "growth", number_or_null(growth(m, algorithm, step, false)),
      "predicted_growth", number_or_null(growth(m, algorithm, step, true)));
}

static enum hsr_status print_json(const struct measurement *m,
                                  struct hsr_error *err) {
  const struct options *o = m->options;
  json_t *scenes = json_array(), *algorithms = json_array();
  for (int s = 0; s < o->n_scenes; s++)
    json_append(&scenes, json_pack("{ss so}", "scene", o->scene[s], "F_r",
                                   number_or_null(m->F_r[s])));
  for (int a = 0; a < o->n_algorithms; a++) {
    const struct hsr_algorithm *algorithm = o->algorithm[a]->counting;
    json_t *steps = json_array();
    for (int k = 0; k < MOST_STEPS && algorithm->steps[k].label; k++)
      json_append(&steps, step_json(m, a, k));
    json_append(&algorithms, json_pack("{ss so}", "algorithm", algorithm->name,
                                       "steps", steps));
  }
  return json_print(json_pack("{ss si si si so so}", "schema", "hsr-steps/1",
                              "view", (int)o->view.view, "width", o->view.m,
                              "height", o->view.n, "scenes", scenes,
                              "algorithms", algorithms),
                    err);
}

enum hsr_status command_steps(int argc, char **argv, struct hsr_error *err) {
  struct options *o = calloc(1, sizeof *o);
  if (!o)
    return hsr_fail_nomem(err);
  o->view = (struct view_options)VIEW_OPTIONS_STANDARD;
  o->view.m = o->view.n = 500; /* Table II's */
  o->timeout = 60;
  struct measurement m = {.options = o};
  enum hsr_status status = parse_options(&argp, argc, argv, o, err);
  if (!status) {
    m.columns =
        calloc((size_t)(o->n_scenes * o->n_algorithms), sizeof *m.columns);
    if (!m.columns)
      status = hsr_fail_nomem(err);
  }
  for (int s = 0; s < o->n_scenes && !status; s++)
    status = measure_scene(&m, s, err);
  if (!status && o->json)
    status = print_json(&m, err);
  else if (!status)
    print_text(&m);
  free(m.columns);
  free(o);
  return status;
}
