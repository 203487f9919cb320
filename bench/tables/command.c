/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr tables: the tables of Sutherland et al. 1974, measured; and Greene's. */
#include "bench/modules/modules.h"
#include "bench/options/words.h"
#include "bench/tables/greene.h"
#include "bench/tables/map.h"
#include "bench/tables/prices.h"
#include "bench/tables/sorts.h"
#include "bench/tables/tables.h"
#include "bench/results/json.h"
#include "bench/sweep/sweep.h"

#include <stdlib.h>

enum { MOST_FILES = 64, GREENE = 0x200, SORTS, PRICES, MAP };

struct options {
  struct option_base base;
  const char *file[MOST_FILES];
  int n_files;
  const char *output; /* where the counts go, or NULL */
  const char *prices; /* file, or NULL */
  long timeout;
  bool json, greene, sorts, map;
};

/* --- Options -------------------------------------------------------------- */

static error_t parse(int key, char *arg, struct argp_state *state) {
  struct options *o = state->input;
  switch (key) {
  case 'j':
    o->json = true;
    return 0;
  case GREENE:
    o->greene = true;
    return 0;
  case MAP:
    o->map = true;
    return 0;
  case SORTS:
    o->sorts = true;
    return 0;
  case PRICES:
    o->prices = arg;
    return 0;
  case 'o':
    o->output = arg;
    return 0;
  case 't':
    if (!parse_count(arg, 1, 100000, &o->timeout))
      return option_fail(&o->base, "--timeout %s: must be 1 to 100000", arg);
    return 0;
  case ARGP_KEY_ARG:
    if (o->n_files == MOST_FILES)
      return option_fail(&o->base, "tables: at most %d files", (int)MOST_FILES);
    o->file[o->n_files++] = arg;
    return 0;
  case ARGP_KEY_END:
    if (o->greene && !o->n_files)
      return option_fail(&o->base, "tables: --greene: which results? "
                                   "(reports/greene/make)");
    if (o->map && (!o->n_files || o->greene || o->json))
      return option_fail(&o->base, "tables: --map is a text, of results of the "
                                   "survey's algorithms (reports/1974/map)");
    if (o->sorts && (o->greene || o->json || o->map || o->n_files ||
                     o->output || o->prices))
      return option_fail(&o->base, "tables: --sorts goes alone");
    if (o->greene && o->prices)
      return option_fail(&o->base, "tables: --prices is for the survey's "
                                   "tables, not for Greene's");
    if (o->n_files && (o->output || o->timeout))
      return option_fail(&o->base, "tables: -o and -t are for counting, which "
                                   "is done where no results are given");
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp argp = {
    (const struct argp_option[]){
        JSON_ARGP_OPTION,
        {"greene", GREENE, NULL, 0,
         "instead, print Greene's figures on hierarchical visibility beside "
         "ours, from results that reports/greene/make makes",
         0},
        {"sorts", SORTS, NULL, 0,
         "instead, count the comparisons of the sorts, searches and merges "
         "that "
         "the survey lists, as the records become more",
         0},
        {"map", MAP, NULL, 0,
         "instead, of results on any scenes (hsr generate): the cheapest "
         "algorithm "
         "by F_r and D_c, and how costs grow with each of the two",
         0},
        {"prices", PRICES, "FILE", 0,
         "compute all costs and verdicts by other prices of comparisons: an "
         "object of JSON, {\"box\": 100, \"span\": 10}. Kinds that it does not "
         "name keep their prices. The tables list the kinds, the prices and "
         "their sources, and the verdicts that change. Nothing is counted "
         "again: results of any age will do",
         0},
        {"output", 'o', "FILE", 0, "also write the counts, as hsr bench does",
         0},
        {"timeout", 't', "SECONDS", 0,
         "the most that a picture may take (standard: 60)", 0},
        {0}},
    parse,
    "[RESULTS.ndjson...]",
    "Prints Tables I to VII of Sutherland, Sproull and Schumacker as measured: "
    "each cost beside the survey's figure and beside its formula applied to "
    "the measured Table I; how each step grows; the taxonomy; and which of the "
    "survey's conclusions the counts bear out. It takes them from results of "
    "hsr bench. Without results it first counts on the nine scenes of the "
    "tables and on a walk, which takes half an hour.\v"
    "  hsr tables\n"
    "  hsr bench --counts house harbor big-harbor --size 500x500 -o c.ndjson\n"
    "  hsr tables c.ndjson\n"
    "  echo '{\"box\": 100}' > p.json; hsr tables c.ndjson --prices p.json",
    NULL,
    NULL,
    NULL};

/* --- Counting ------------------------------------------------------------- */

/* What the options of both hsr bench --counts share. */
static void ask(const struct options *o, struct sweep_options *ask, int size) {
  *ask = (struct sweep_options)SWEEP_OPTIONS_STANDARD;
  ask->m[0] = ask->n[0] = size;
  ask->n_sizes = 1;
  ask->threads[ask->n_threads++] = 1;
  ask->counts = true;
  ask->output = o->output;
  if (o->timeout)
    ask->timeout = o->timeout;
}

/* Of that on the nine scenes. */
static void ask_scenes(const struct options *o, struct sweep_options *asked) {
  ask(o, asked, TABLES_SIZE);
  for (const char *const *scene = tables_scenes; *scene; scene++)
    asked->scene[asked->n_scenes++] = *scene;
  for (const struct hsr_listed *l = hsr_algorithms(); l->plain; l++)
    if (l->plain->steps)
      asked->algorithm[asked->n_algorithms++] = l->plain->name;
  for (const char *const *name = tables_variants; *name; name++)
    asked->algorithm[asked->n_algorithms++] = *name;
}

/* And of that on the walk, which goes on where the first ends. */
static void ask_walk(const struct options *o, struct sweep_options *asked) {
  ask(o, asked, TABLES_WALK_SIZE);
  asked->scene[asked->n_scenes++] = TABLES_WALK_SCENE;
  for (const char *const *name = tables_walkers; *name; name++)
    asked->algorithm[asked->n_algorithms++] = *name;
  asked->walk = TABLES_WALK;
  asked->resume = o->output;
}

static enum hsr_status count(const struct options *o, bool walk, int argc,
                             char **argv, struct results *results,
                             struct hsr_error *err) {
  struct sweep_options *asked = calloc(1, sizeof *asked);
  struct plan *plan = calloc(1, sizeof *plan);
  enum hsr_status status = asked && plan ? HSR_OK : hsr_fail_nomem(err);
  if (!status) {
    (walk ? ask_walk : ask_scenes)(o, asked);
    status = plan_init(plan, asked, err);
    if (!status)
      status = sweep_run(plan, argc, argv, results, err);
    plan_free(plan);
  }
  free(plan);
  free(asked);
  return status;
}

static enum hsr_status print_greene(const struct options *o,
                                    const struct results *results,
                                    struct hsr_error *err) {
  if (!greene_is_measured(results))
    return hsr_fail(err, HSR_E_INPUT,
                    "tables: the results have none of what Greene measured");
  if (o->json)
    return json_print(json_pack("{ss so}", "schema", "hsr-greene/1", "greene",
                                greene_json(results)),
                      err);
  greene_print(results);
  return HSR_OK;
}

static enum hsr_status print(const struct options *o,
                             const struct results *results,
                             const struct hsr_prices *prices,
                             struct hsr_error *err) {
  if (o->greene)
    return print_greene(o, results, err);
  if (o->map)
    return map_print(results, prices, err);
  struct tables *tables;
  enum hsr_status status = tables_new(&tables, results, prices, err);
  if (status)
    return status;
  if (o->json)
    status = json_print(tables_json(tables), err);
  else
    tables_print(tables);
  tables_delete(tables);
  return status;
}

enum hsr_status command_tables(int argc, char **argv, struct hsr_error *err) {
  struct options options = {.json = false};
  enum hsr_status status = parse_options(&argp, argc, argv, &options, err);
  struct results results = {.headers = NULL};
  if (!status && options.sorts)
    return sorts_print() ? HSR_OK : hsr_fail_nomem(err);
  struct hsr_prices prices = hsr_prices_standard;
  if (!status && options.prices) /* before anything is counted */
    status = prices_read(&prices, options.prices, err);
  for (int k = 0; k < options.n_files && !status; k++)
    status = results_read(&results, options.file[k], err);
  for (int walk = 0; walk < 2 && !status && !options.n_files; walk++)
    status = count(&options, walk, argc, argv, &results, err);
  if (!status)
    status = print(&options, &results, &prices, err);
  results_free(&results);
  return status;
}
