/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr trace: every step of one algorithm on one view, as lines of JSON. */
#include "bench/modules/variant.h"
#include "bench/options/command.h"
#include "bench/options/words.h"
#include "bench/trace/trace.h"
#include "bench/terminal/terminal.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* --- Options -------------------------------------------------------------- */

#define STANDARD_SIZE "64x48"
enum { ROWS = 0x200, WINDOW, EVERY, COUNTERS, KEYFRAME };

struct options {
  struct option_base base;
  struct view_options view;
  struct scene_options scene;
  const char *algorithm, *output;
  const char *counters; /* names with commas between; NULL: all */
  bool has_rows;
  long row, last_row;
  struct trace_filter filter; /* its window is that of --window only */
};

static bool parse_rows(const char *text, long *first, long *last) {
  char copy[32];
  if (strlen(text) >= sizeof copy)
    return false;
  strcpy(copy, text);
  char *dash = strchr(copy, '-');
  if (dash)
    *dash = '\0';
  return parse_count(copy, 0, HSR_MAX_SIZE - 1, first) &&
         parse_count(dash ? dash + 1 : copy, *first, HSR_MAX_SIZE - 1, last);
}

static bool parse_window(const char *text, struct hsr_window *w) {
  int end = 0;
  return sscanf(text, "%6d,%6d,%6d,%6d%n", &w->x0, &w->y0, &w->x1, &w->y1,
                &end) == 4 &&
         !text[end] && w->x0 >= 0 && w->y0 >= 0 && w->x1 > w->x0 &&
         w->y1 > w->y0;
}

/* Which events are written. */
static error_t parse_filter_option(struct options *o, int key, char *arg) {
  struct trace_filter *filter = &o->filter;
  switch (key) {
  case ROWS:
    o->has_rows = true;
    if (!parse_rows(arg, &o->row, &o->last_row))
      return option_fail(&o->base, "--rows %s: must be J0-J1, from 0", arg);
    return 0;
  case WINDOW:
    filter->has_window = true;
    if (!parse_window(arg, &filter->window))
      return option_fail(&o->base,
                         "--window %s: must be X0,Y0,X1,Y1, X0 < X1, "
                         "Y0 < Y1",
                         arg);
    return 0;
  case EVERY:
    if (!parse_count(arg, 1, 1000000000, &filter->every))
      return option_fail(&o->base, "--every %s: must be 1 or more", arg);
    return 0;
  case COUNTERS:
    o->counters = arg;
    return 0;
  case KEYFRAME:
    if (!parse_count(arg, 1, 1000000000, &filter->keyframe))
      return option_fail(&o->base, "--keyframe %s: must be 1 or more", arg);
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static error_t parse(int key, char *arg, struct argp_state *state) {
  struct options *o = state->input;
  long threads;
  error_t error;
  switch (key) {
  case 'a':
    o->algorithm = arg;
    return 0;
  case 'o':
    if (o->output)
      return option_fail(&o->base, "trace: one -o, not also '%s'", arg);
    o->output = arg;
    return 0;
  case 'J':
    if (!parse_count(arg, 1, 1, &threads))
      return option_fail(&o->base,
                         "--jobs %s: the events of a trace are in "
                         "order, and so on one thread",
                         arg);
    return 0;
  case ARGP_KEY_END:
    error = parse_scene_option(&o->scene, key, arg, "trace", &o->base);
    if (error && error != ARGP_ERR_UNKNOWN)
      return error;
    if (!o->algorithm)
      return option_fail(&o->base, "trace: which algorithm? (-a NAME)");
    if (!o->output)
      return option_fail(&o->base, "trace: which file? (-o FILE)");
    return 0;
  default:
    error = parse_filter_option(o, key, arg);
    return error == ARGP_ERR_UNKNOWN
               ? parse_place_option(&o->scene, &o->view, key, arg, "trace",
                                    &o->base)
               : error;
  }
}

static const struct argp argp = {
    (const struct argp_option[]){
        {"algorithm", 'a', "NAME", 0, "the algorithm", 0},
        {"output", 'o', "FILE", 0,
         "write the trace here, compressed if the name ends in .gz; - is "
         "standard output",
         0},
        {"keyframe", KEYFRAME, "N", 0,
         "a keyframe every N written events, or later if these take less room "
         "than a keyframe (standard: 2000)",
         0},
        {"jobs", 'J', "1", 0, "threads: only 1", 0},
        SCENE_ARGP_OPTIONS,
        {NULL, 0, NULL, 0,
         "Which events (accepted ones are left out only if they are outside "
         "the window):",
         2},
        {"rows", ROWS, "J0-J1", 0,
         "those that meet rows J0 to J1, from 0, or have no window", 2},
        {"window", WINDOW, "X0,Y0,X1,Y1", 0,
         "those that meet columns X0 to X1 - 1 of rows Y0 to Y1 - 1", 2},
        {"counters", COUNTERS, "NAME,...", 0, "those of these counters", 2},
        {"every", EVERY, "N", 0, "of those, every N-th", 2},
        VIEW_ARGP_OPTIONS_OF(STANDARD_SIZE),
        {0}},
    parse,
    "SCENE",
    "Runs the counting build of one algorithm on one view and writes each of "
    "its steps, in order, as a line of JSON: what was done to which faces, "
    "where, and what was decided. From time to time a keyframe gives the "
    "counts and the picture so far. The format is that of "
    "docs/schemas/trace.schema.json.\v"
    "  hsr trace house -a raycast -o house.ndjson.gz\n"
    "  hsr trace house -a raycast --rows 20 --every 10 -o - | less",
    NULL,
    NULL,
    NULL};

/* --- Which events --------------------------------------------------------- */

/* The number of the counter of that name; -1: there is none. */
static int find_counter(const struct hsr_algorithm *a, const char *name,
                        size_t length) {
  for (int k = 0; k < trace_n_counters(a); k++)
    if (strlen(a->counters[k].name) == length &&
        !memcmp(a->counters[k].name, name, length))
      return k;
  return -1;
}

static enum hsr_status choose_counters(struct options *o,
                                       const struct hsr_algorithm *a,
                                       struct hsr_error *err) {
  const char *at = o->counters;
  o->filter.has_counters = at != NULL;
  while (at) {
    size_t length = strcspn(at, ",");
    int k = find_counter(a, at, length);
    if (k < 0)
      return hsr_fail(err, HSR_E_USAGE,
                      "--counters: %s has no counter '%.*s' (see hsr list "
                      "--json)",
                      a->name, (int)length, at);
    o->filter.counters |= UINT64_C(1) << k;
    at = at[length] ? at + length + 1 : NULL;
  }
  return HSR_OK;
}

/* Combines --rows and --window into one window inside the picture. */
static enum hsr_status choose_window(struct options *o, struct hsr_error *err) {
  struct trace_filter *filter = &o->filter;
  struct hsr_window *w = &filter->window;
  if (!filter->has_window)
    *w = (struct hsr_window){0, 0, o->view.m, o->view.n};
  if (w->x1 > o->view.m)
    w->x1 = o->view.m;
  if (w->y1 > o->view.n)
    w->y1 = o->view.n;
  if (o->has_rows && w->y0 < o->row)
    w->y0 = (int)o->row;
  if (o->has_rows && w->y1 > o->last_row + 1)
    w->y1 = (int)o->last_row + 1;
  filter->has_window |= o->has_rows;
  return w->x0 < w->x1 && w->y0 < w->y1
             ? HSR_OK
             : hsr_fail(err, HSR_E_USAGE, "%s: no sample of %d x %d is in it",
                        o->has_rows ? "--rows" : "--window", o->view.m,
                        o->view.n);
}

/* --- The run -------------------------------------------------------------- */

struct run {
  const struct options *options;
  struct trace_run traced;
  struct trace_output output;
  struct tracer tracer;
};

static void write_header(struct run *r) {
  struct trace_header header = {.run = &r->traced,
                                .filter = &r->options->filter};
  trace_output_line(&r->output, trace_header_json(&header));
}

/* Whether progress is shown: on a terminal, unless the trace goes there. */
static bool shows_progress(const struct options *o) {
  return isatty(STDERR_FILENO) &&
         (strcmp(o->output, "-") || !isatty(STDOUT_FILENO));
}

static enum hsr_status write_trace(struct run *r, struct hsr_error *err) {
  r->tracer = (struct tracer){.algorithm = r->traced.setup.algorithm,
                              .filter = &r->options->filter,
                              .output = &r->output,
                              .answer = &r->traced.answer,
                              .shows_progress = shows_progress(r->options)};
  struct hsr_trace trace = {.listen = tracer_listen, .context = &r->tracer};
  struct hsr_tally tally = {.trace = &trace};
  write_header(r);
  tracer_keyframe(&r->tracer, 0);
  enum hsr_status status =
      trace_answer_draw(&r->traced.answer, &r->traced.setup, &tally, err);
  return status ? status : tracer_end(&r->tracer, &tally, err);
}

static void print_report(const struct run *r) {
  const struct tracer *t = &r->tracer;
  char name[TERMINAL_NAME], text[2 * TERMINAL_NAME], part[60] = "";
  if (t->written < t->events)
    snprintf(part, sizeof part, ", %llu of them written",
             (unsigned long long)t->written);
  snprintf(text, sizeof text,
           "%s, view %ld, %d x %d samples, %u faces, by %.500s: %llu events%s, "
           "%llu keyframe%s, %.1f MB",
           terminal_plain(r->options->scene.name, name, sizeof name),
           r->options->view.view, r->traced.view.m, r->traced.view.n,
           r->traced.laid_out.n_faces, r->traced.variant->name,
           (unsigned long long)t->events, part,
           (unsigned long long)t->keyframes, t->keyframes == 1 ? "" : "s",
           1e-6 * (double)r->output.bytes);
  terminal_wrap(stdout, 0, 2, text);
}

static enum hsr_status run(const struct options *o,
                           const struct hsr_variant *variant,
                           struct hsr_error *err) {
  struct run r = {.options = o,
                  .traced = {.command = "trace",
                             .scene_options = &o->scene,
                             .view_options = &o->view,
                             .variant = variant,
                             .most_faces = TRACE_MOST_FACES}};
  enum hsr_status status = trace_run_open(&r.traced, err);
  if (!status)
    status = trace_output_open(&r.output, o->output, err);
  if (!status) {
    status = write_trace(&r, err);
    status = trace_output_close(&r.output, status, err);
  }
  if (!status && strcmp(o->output, "-"))
    print_report(&r);
  trace_run_close(&r.traced);
  return status;
}

enum hsr_status command_trace(int argc, char **argv, struct hsr_error *err) {
  struct options options = {.view = VIEW_OPTIONS_STANDARD,
                            .filter = {.every = 1, .keyframe = 2000}};
  parse_size(STANDARD_SIZE, &options.view.m, &options.view.n);
  struct hsr_variant variant;
  enum hsr_status status = parse_options(&argp, argc, argv, &options, err);
  if (!status)
    status = aim_scene(&options.scene, &options.view, err);
  if (!status)
    status = hsr_variant_parse(options.algorithm, &variant, err);
  if (!status)
    status = lib_check_trace(&variant, err);
  if (!status)
    status = choose_counters(&options, variant.listed->counting, err);
  if (!status)
    status = choose_window(&options, err);
  return status ? status : run(&options, &variant, err);
}
