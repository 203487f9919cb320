/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr times: the table of a results file again, or its figures for other
 * programs. */
#include "bench/options/command.h"
#include "bench/options/parser.h"
#include "bench/options/scene.h"
#include "bench/options/streams.h"
#include "bench/times/rows.h"

#include <errno.h>
#include <string.h>

enum { MOST_FILES = 64, CSV = 0x200, LATEX, PLOT, REFERENCE };

struct options {
  struct option_base base;
  const char *file[MOST_FILES];
  int n_files;
  const char *reference, *plot;
  bool csv, json, latex;
};

static error_t parse(int key, char *arg, struct argp_state *state) {
  struct options *o = state->input;
  switch (key) {
  case CSV:
    o->csv = true;
    return 0;
  case LATEX:
    o->latex = true;
    return 0;
  case 'j':
    o->json = true;
    return 0;
  case PLOT:
    if (parse_output(arg, ".svg", "times", &o->base, &o->plot))
      return EINVAL;
    return rows_plot_fits(o->plot)
               ? 0
               : option_fail(&o->base,
                             "--plot %s: must end in .svg, .pdf or "
                             ".png",
                             arg);
  case REFERENCE:
    o->reference = arg;
    return 0;
  case ARGP_KEY_ARG:
    if (o->n_files == MOST_FILES)
      return option_fail(&o->base, "times: at most %d files", (int)MOST_FILES);
    o->file[o->n_files++] = arg;
    return is_stream(arg) ? parse_input("ndjson", "times", &o->base,
                                        &o->file[o->n_files - 1])
                          : 0;
  case ARGP_KEY_END:
    if (o->csv + o->json + o->latex > 1)
      return option_fail(&o->base,
                         "times: one of --csv, --json and --latex, not two");
    return o->n_files ? 0
                      : option_fail(&o->base, "times: which file of results? "
                                              "(see hsr help times)");
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp argp = {
    (const struct argp_option[]){
        {"csv", CSV, NULL, 0, "print the figures as CSV, times in seconds", 0},
        {"json", 'j', NULL, 0, "print the figures as one JSON object", 0},
        {"latex", LATEX, NULL, 0, "print the table for LaTeX with booktabs", 0},
        {"plot", PLOT, "FILE", 0,
         "write a plot of the times: .svg, .pdf or .png", 0},
        {"reference", REFERENCE, "A", 0,
         "give times as ratios to A's (standard: zbuffer-fast)", 0},
        {0}},
    parse,
    "FILE...",
    "Prints the times of what hsr bench recorded: medians with their 95 % "
    "intervals, and ratios to a reference with their 99 % intervals.\v"
    "  hsr times results.ndjson\n"
    "  hsr times results.ndjson --csv >times.csv\n"
    "  hsr times results.ndjson --latex >times.tex\n"
    "  hsr times results.ndjson --plot times.svg",
    NULL,
    NULL,
    NULL};

static enum hsr_status tell(const struct options *o, const struct rows *rows,
                            struct hsr_error *err) {
  if (o->plot) {
    enum hsr_status status = rows_plot(rows, o->plot, err);
    if (status || !(o->csv || o->json || o->latex))
      return status;
  }
  if (o->json)
    return rows_print_json(rows, err);
  if (o->csv)
    rows_print_csv(rows);
  else if (o->latex)
    rows_print_latex(rows);
  else
    rows_print(rows);
  return HSR_OK;
}

/* There is something to tell, and to compare it with if the user says what. */
static enum hsr_status check_results(const struct options *o,
                                     const struct results *results,
                                     struct hsr_error *err) {
  size_t k;
  const json_t *cell;
  bool found = !o->reference;
  if (!json_array_size(results->cells))
    return hsr_fail(err, HSR_E_INPUT, "%s: no results in it", o->file[0]);
  json_array_foreach(results->cells, k, cell) found =
      found || !strcmp(results_text(cell, "algorithm"), o->reference);
  return found ? HSR_OK
               : hsr_fail(err, HSR_E_INPUT,
                          "--reference %s: no result is of it", o->reference);
}

enum hsr_status command_times(int argc, char **argv, struct hsr_error *err) {
  struct options options = {.reference = NULL};
  struct results results = {.headers = NULL};
  struct rows rows = {.row = NULL};
  enum hsr_status status = parse_options(&argp, argc, argv, &options, err);
  for (int k = 0; k < options.n_files && !status; k++)
    status = results_read(&results, options.file[k], err);
  if (!status)
    status = check_results(&options, &results, err);
  if (!status)
    status =
        rows_make(&rows, &results,
                  options.reference ? options.reference : "zbuffer-fast", err);
  if (!status)
    status = tell(&options, &rows, err);
  rows_free(&rows);
  results_free(&results);
  return status;
}
