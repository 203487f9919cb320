/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr report: the results of hsr bench as a folder of pages, to be opened from
 * disk. */
#include "config.h"

#include "bench/options/command.h"
#include "bench/options/parser.h"
#include "bench/options/words.h"
#include "bench/results/page.h"
#include "bench/report/report.h"

#include <errno.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* DIGITS of a number are enough for a page, and half as long as all. */
enum { MOST_FILES = 4096, MOST_ERRORS = 64, PATH = 4400, DIGITS = 9 };

struct options {
  struct option_base base;
  const char *file[MOST_FILES], *errors[MOST_ERRORS], *folder, *reference;
  int n_files, n_errors;
  long most, timeout, budget;
};

/* --- Options -------------------------------------------------------------- */

static error_t parse(int key, char *arg, struct argp_state *state) {
  struct options *o = state->input;
  switch (key) {
  case 'o':
    o->folder = arg;
    return 0;
  case 'r':
    o->reference = arg;
    return 0;
  case 'p':
    if (!parse_count(arg, 16, 4096, &o->most))
      return option_fail(&o->base, "--pictures %s: must be 16 to 4096", arg);
    return 0;
  case 't':
    if (!parse_count(arg, 1, 100000, &o->timeout))
      return option_fail(&o->base, "--timeout %s: must be 1 to 100000", arg);
    return 0;
  case 'b':
    if (!parse_count(arg, 1, 1000000, &o->budget))
      return option_fail(&o->base, "--budget %s: must be 1 to 1000000", arg);
    return 0;
  case 'n':
    o->budget = 0;
    return 0;
  case 'e':
    if (o->n_errors == MOST_ERRORS)
      return option_fail(&o->base, "report: at most %d files of errors",
                         (int)MOST_ERRORS);
    o->errors[o->n_errors++] = arg;
    return 0;
  case ARGP_KEY_ARG:
    if (o->n_files == MOST_FILES)
      return option_fail(&o->base, "report: at most %d files", (int)MOST_FILES);
    o->file[o->n_files++] = arg;
    return 0;
  case ARGP_KEY_END:
    if (!o->n_files)
      return option_fail(&o->base,
                         "report: which results? (see hsr report --help)");
    if (!o->folder)
      return option_fail(&o->base, "report: which folder? (-o DIR)");
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp argp = {
    (const struct argp_option[]){
        {"output", 'o', "DIR", 0, "the folder; it is made if need be", 0},
        {"reference", 'r', "A", 0,
         "show times as ratios to A's (standard: zbuffer-fast)", 0},
        {"pictures", 'p', "N", 0,
         "samples a row or column of a picture, at most (standard: 256)", 0},
        {"no-pictures", 'n', NULL, 0, "make no pictures", 0},
        {"budget", 'b', "SECONDS", 0,
         "the most that all pictures may take, scenes of few faces first "
         "(standard: 20)",
         0},
        {"errors", 'e', "FILE", 0,
         "what hsr errors --json printed, for a page on filters; the pictures "
         "of its --where are looked for beside it. May be given again",
         0},
        {"timeout", 't', "SECONDS", 0,
         "the most that one picture may take (standard: 5)", 0},
        {0}},
    parse,
    "RESULTS.ndjson...",
    "Makes a folder of pages out of what hsr bench recorded: open its "
    "index.html. It needs no server and no network. The pictures are drawn "
    "anew, by every algorithm.\v"
    "  hsr bench house harbor -o results.ndjson\n"
    "  hsr report results.ndjson -o report\n"
    "  hsr report results.ndjson -o report --budget 3600 --timeout 600",
    NULL,
    NULL,
    NULL};

/* --- The folder ----------------------------------------------------------- */

static enum hsr_status cannot_write(const char *path, struct hsr_error *err) {
  return hsr_fail(err, HSR_E_INPUT, "%s: %s", path, strerror(errno));
}

static enum hsr_status make_folders(const char *folder, struct hsr_error *err) {
  static const char *const inside[] = {"",          "/pictures", "/work",
                                       "/drawings", "/probe",    "/difference",
                                       "/errors"};
  for (size_t k = 0; k < sizeof inside / sizeof *inside; k++) {
    char path[PATH];
    snprintf(path, sizeof path, "%.4096s%s", folder, inside[k]);
    struct stat there;
    if (mkdir(path, 0777) && (errno != EEXIST || stat(path, &there)))
      return cannot_write(path, err);
    if (!stat(path, &there) && !S_ISDIR(there.st_mode))
      return hsr_fail(err, HSR_E_INPUT, "%s: not a folder", path);
  }
  return HSR_OK;
}

/* Writes a part of a JSON text into a string of JavaScript in single quotes. */
static int write_quoted(const char *text, size_t n, void *file) {
  bool good = true;
  for (size_t k = 0; k < n; k++) {
    if (text[k] == '\'' || text[k] == '\\')
      good = good && putc_unlocked('\\', file) != EOF;
    good = good && putc_unlocked(text[k], file) != EOF;
  }
  return good ? 0 : -1;
}

enum hsr_status report_write(const struct report *report, const char *name,
                             const char *before, json_t *value,
                             const char *after, struct hsr_error *err) {
  static const size_t flags =
      JSON_COMPACT | JSON_ENSURE_ASCII | JSON_REAL_PRECISION(DIGITS);
  if (!value)
    return hsr_fail_nomem(err);
  char path[PATH];
  snprintf(path, sizeof path, "%.4096s/%.200s", report->folder, name);
  FILE *file = fopen(path, "w");
  bool good = file && fprintf(file, "%sJSON.parse('", before) > 0 &&
              !json_dump_callback(value, write_quoted, file, flags) &&
              fprintf(file, "')%s", after) > 0;
  if (file && fclose(file))
    good = false;
  json_decref(value);
  return good ? HSR_OK : cannot_write(path, err);
}

static enum hsr_status append_file(FILE *out, const char *from,
                                   struct hsr_error *err) {
  FILE *in = fopen(from, "rb");
  if (!in)
    return cannot_write(from, err);
  char block[1 << 14];
  size_t n;
  bool good = true;
  while (good && (n = fread(block, 1, sizeof block, in)) > 0)
    good = fwrite(block, 1, n, out) == n;
  good = good && !ferror(in);
  enum hsr_status status = good ? HSR_OK : cannot_write(from, err);
  fclose(in);
  return status;
}

enum hsr_status report_join(const char *const *from, int n, const char *folder,
                            const char *name, struct hsr_error *err) {
  char path[PATH];
  snprintf(path, sizeof path, "%.4096s/%.200s", folder, name);
  FILE *out = fopen(path, "wb");
  if (!out)
    return cannot_write(path, err);
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < n && !status; k++)
    status = append_file(out, from[k], err);
  if (fclose(out) && !status)
    status = cannot_write(path, err);
  return status;
}

/* --- The page ------------------------------------------------------------- */

static enum hsr_status copy_page(const char *folder, struct hsr_error *err) {
  static const char *const name[] = {"index.html", "report.css", "report.js"};
  char page[PAGE_FOLDER];
  find_page("report.js", page);
  enum hsr_status status = HSR_OK;
  for (size_t k = 0; k < sizeof name / sizeof *name && !status; k++) {
    char from[PATH + 16];
    snprintf(from, sizeof from, "%s/%s", page, name[k]);
    const char *file = from;
    status = report_join(&file, 1, folder, name[k], err);
  }
  return status;
}

/* --- The report ----------------------------------------------------------- */

static enum hsr_status write_report(const struct report *report,
                                    struct hsr_error *err) {
  json_t *data = report_data(report, err);
  if (!data)
    return HSR_E_NOMEM;
  enum hsr_status status = report_errors(report, data, err);
  if (!status)
    status = report_laboratory(report, data, err);
  if (!status)
    status = report_lessons(report, data, err);
  if (!status)
    status = report_pictures(report, data, err);
  if (status) {
    json_decref(data);
    return status;
  }
  return report_write(report, "data.js", "window.hsr = ", data, ";\n", err);
}

static enum hsr_status make_report(const struct options *o,
                                   struct results *results,
                                   struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < o->n_files && !status; k++)
    status = results_read(results, o->file[k], err);
  if (!status && !json_array_size(results->views))
    status = hsr_fail(err, HSR_E_INPUT, "%s: no results in it", o->file[0]);
  if (!status)
    status = make_folders(o->folder, err);
  if (!status)
    status = copy_page(o->folder, err);
  if (!status)
    status = report_join(o->file, o->n_files, o->folder, "results.ndjson", err);
  struct report report = {.results = results,
                          .errors = o->errors,
                          .n_errors = o->n_errors,
                          .folder = o->folder,
                          .reference = o->reference,
                          .most = o->most,
                          .timeout = o->timeout,
                          .budget = o->budget};
  if (!status)
    status = write_report(&report, err);
  if (!status)
    printf("open %s/index.html\n", o->folder);
  return status;
}

enum hsr_status command_report(int argc, char **argv, struct hsr_error *err) {
  struct options *o = calloc(1, sizeof *o);
  if (!o)
    return hsr_fail_nomem(err);
  *o = (struct options){
      .reference = "zbuffer-fast", .most = 256, .timeout = 5, .budget = 20};
  enum hsr_status status = parse_options(&argp, argc, argv, o, err);
  if (!status && !HSR_HAVE_REPORT)
    status = hsr_fail(err, HSR_E_USAGE,
                      "report: built without its pages (configure needs node "
                      "and npm)");
  struct results results = {.headers = NULL};
  if (!status)
    status = make_report(o, &results, err);
  results_free(&results);
  free(o);
  return status;
}
