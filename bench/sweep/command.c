/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr bench: timings of the algorithms that are right, and the counts of their
 * work, as lines of JSON. */
#include "bench/options/words.h"
#include "bench/sweep/journal.h"
#include "bench/terminal/terminal.h"
#include "bench/times/rows.h"
#include "common/base/clock.h"

#include <errno.h>
#include <fcntl.h>
#include <fnmatch.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum {
  WALK = 0x200,
  STARTS,
  REPETITIONS,
  SAMPLES,
  SEED,
  SHARD,
  RESUME,
  LIST,
  COUNTS,
  ONLY,
  PEERS,
  REFERENCE,
  BASELINE,
  CLIFFS,
  BUDGET
};

/* --- Options -------------------------------------------------------------- */

static error_t add_names(struct sweep_options *o, char *arg, const char **name,
                         int *n, int most) {
  int before = *n;
  for (char *word = strtok(arg, ","); word; word = strtok(NULL, ",")) {
    if (*n == most)
      return option_fail(&o->base, "bench: at most %d names", most);
    name[(*n)++] = word;
  }
  return *n > before ? 0
                     : option_fail(&o->base, "bench: '%s' names nothing", arg);
}

static bool has_size(const struct sweep_options *o, int m, int n) {
  for (int k = 0; k < o->n_sizes; k++)
    if (o->m[k] == m && o->n[k] == n)
      return true;
  return false;
}

static error_t add_sizes(struct sweep_options *o, char *arg) {
  for (char *size = strtok(arg, ","); size; size = strtok(NULL, ",")) {
    if (o->n_sizes == SWEEP_MOST_SIZES)
      return option_fail(&o->base, "bench: at most %d sizes",
                         (int)SWEEP_MOST_SIZES);
    int m, n;
    if (!parse_size(size, &m, &n))
      return option_fail(&o->base, "--size %s: must be MxN or N, each 1 to %d",
                         size, HSR_MAX_SIZE);
    if (has_size(o, m, n))
      continue;
    o->m[o->n_sizes] = m;
    o->n[o->n_sizes++] = n;
  }
  return 0;
}

static error_t add_threads(struct sweep_options *o, char *arg) {
  for (char *word = strtok(arg, ","); word; word = strtok(NULL, ",")) {
    if (o->n_threads == SWEEP_MOST_THREADS)
      return option_fail(&o->base, "bench: at most %d numbers of threads",
                         (int)SWEEP_MOST_THREADS);
    if (!parse_count(word, 1, 64, &o->threads[o->n_threads++]))
      return option_fail(&o->base, "--threads %s: must be 1 to 64", word);
  }
  return 0;
}

static error_t set_shard(struct sweep_options *o, char *arg) {
  int length = 0;
  if (sscanf(arg, "%7ld/%7ld%n", &o->shard, &o->shards, &length) == 2 &&
      !arg[length] && o->shard >= 1 && o->shard <= o->shards)
    return 0;
  return option_fail(&o->base, "--shard %s: must be I/N, I from 1 to N", arg);
}

static error_t set_count(struct sweep_options *o, const char *name, char *arg,
                         long least, long most, long *count) {
  if (parse_count(arg, least, most, count))
    return 0;
  return option_fail(&o->base, "%s %s: must be %ld to %ld", name, arg, least,
                     most);
}

static error_t complete(struct sweep_options *o) {
  if (!o->n_scenes)
    return option_fail(&o->base, "bench: which scene? (see hsr bench --help)");
  if (o->resume && !o->output)
    return option_fail(&o->base, "--resume: which file? (-o FILE)");
  if (o->walk > 1 && o->n_peers)
    return option_fail(&o->base, "--walk: peers draw no walks, so not --peers");
  if (!o->n_sizes) {
    o->m[0] = o->n[0] = 512;
    o->n_sizes = 1;
  }
  if (!o->views_given &&
      count_views(&o->camera, 1, SWEEP_MOST_VIEWS, &o->views, o->base.err)) {
    o->base.failed = true;
    return EINVAL;
  }
  if (!o->n_threads)
    o->threads[o->n_threads++] = 1;
  return 0;
}

static error_t parse(int key, char *arg, struct argp_state *state) {
  struct sweep_options *o = state->input;
  switch (key) {
  case 'a':
    return add_names(o, arg, o->algorithm, &o->n_algorithms,
                     SWEEP_MOST_ENTRANTS);
  case PEERS:
    return add_names(o, arg, o->peer, &o->n_peers, SWEEP_MOST_ENTRANTS);
  case 's':
    return add_sizes(o, arg);
  case 'T':
    return add_threads(o, arg);
  case 'n':
    o->views_given = true;
    return set_count(o, "--views", arg, 1, SWEEP_MOST_VIEWS, &o->views);
  case WALK:
    return set_count(o, "--walk", arg, 1, SWEEP_MOST_VIEWS, &o->walk);
  case 't':
    return set_count(o, "--timeout", arg, 1, 100000, &o->timeout);
  case 'M':
    return set_count(o, "--memory", arg, 1, 1 << 30, &o->memory_mb);
  case BUDGET:
    if (!o->starts_given)
      o->starts = SWEEP_MOST_STARTS;
    return set_count(o, "--budget", arg, 1, 10000000, &o->budget);
  case STARTS:
    o->starts_given = true;
    return set_count(o, "--starts", arg, 2, SWEEP_MOST_STARTS, &o->starts);
  case REPETITIONS:
    return set_count(o, "--repetitions", arg, 1, SWEEP_MOST_REPETITIONS,
                     &o->repetitions);
  case SAMPLES:
    return set_count(o, "--samples", arg, 1, MOST_SAMPLES, &o->samples);
  case SEED:
    return set_count(o, "--seed", arg, 0, 0x7fffffff, &o->seed);
  case SHARD:
    return set_shard(o, arg);
  case RESUME:
    o->resume = true;
    return 0;
  case LIST:
    o->list = true;
    return 0;
  case COUNTS:
    o->counts = true;
    return 0;
  case ONLY:
    o->only = arg;
    return 0;
  case REFERENCE:
    o->reference = arg;
    return 0;
  case BASELINE:
    o->baseline = arg;
    return 0;
  case CLIFFS:
    o->cliffs = 40;
    return arg ? set_count(o, "--cliffs", arg, 2, 1000000, &o->cliffs) : 0;
  case 'o':
    o->output = arg;
    return 0;
  case ARGP_KEY_ARG:
    if (o->n_scenes == SWEEP_MOST_NAMES)
      return option_fail(&o->base, "bench: at most %d scenes",
                         (int)SWEEP_MOST_NAMES);
    o->scene[o->n_scenes++] = arg;
    return 0;
  case ARGP_KEY_END:
    return complete(o);
  default:
    return parse_camera_option(&o->camera, key, arg, &o->base);
  }
}

static const struct argp argp = {
    (const struct argp_option[]){
        {NULL, 0, NULL, 0, "Which cells:", 1},
        {"algorithms", 'a', "A,B,...", 0,
         "these: names or patterns; a name with a slash is a program in any "
         "language (standard: all but the judges and those that draw grids "
         "alone)",
         1},
        {"peers", PEERS, "P,Q,...", 0,
         "also these renderers of others (built by configure --with-peers)", 1},
        {"size", 's', "MxN,...", 0, "samples (standard: 512x512)", 1},
        {"views", 'n', "N", 0, "the first N views of each scene (standard: 1)",
         1},
        {"walk", WALK, "N", 0,
         "instead of each of these views, draw a walk again and again: the "
         "view and the N - 1 views that follow. It measures what is kept from "
         "one frame to the next. Times are of a frame, counts of one walk",
         1},
        {"threads", 'T', "N,...", 0, "numbers of threads (standard: 1)", 1},
        {"only", ONLY, "PATTERN", 0,
         "cells whose line in --list matches, as '* watkins *'", 1},
        {"shard", SHARD, "I/N", 0,
         "only the Ith of N parts, to spread a sweep over machines; hsr bench "
         "merge FILE... -o FILE puts the files of all parts together",
         1},
        {"list", LIST, NULL, 0, "print the cells and end", 1},
        {NULL, 0, NULL, 0, "How:", 2},
        {"starts", STARTS, "N", 0, "processes a cell (standard: 5)", 2},
        {"budget", BUDGET, "SECONDS", 0,
         "end after about this time: at least two starts a cell, and after "
         "five no more than are needed to know all medians to 2 %",
         2},
        {"repetitions", REPETITIONS, "N", 0,
         "samples a process (standard: 9), one a round, in an order shuffled "
         "every round",
         2},
        {"seed", SEED, "N", 0, "seed of these orders (standard: 1)", 2},
        {"samples", SAMPLES, "N", 0,
         "judge by N random samples of each picture, the same in every run: "
         "those that Knuth's algorithm S selects by erand48() from the state "
         "{view, columns, rows} (standard: all samples, but 20000 of scenes of "
         "over 33 million faces)",
         2},
        {"counts", COUNTS, NULL, 0, "judge and count, but time nothing", 2},
        {"timeout", 't', "SECONDS", 0,
         "the most that a picture may take (standard: 60)", 2},
        {"memory", 'M', "MB", 0, "the most data that a process may hold", 2},
        {NULL, 0, NULL, 0, "Results:", 3},
        {"output", 'o', "FILE", 0,
         "write the records to FILE, a line of JSON each", 3},
        {"resume", RESUME, NULL, 0, "go on where FILE ends", 3},
        {"reference", REFERENCE, "A", 0,
         "print times as ratios to A's (standard: zbuffer-fast)", 3},
        {"baseline", BASELINE, "FILE", 0,
         "print what is slower or faster than in these earlier results", 3},
        {"cliffs", CLIFFS, "N", OPTION_ARG_OPTIONAL,
         "print each cell that takes over N times as long as the other cells "
         "of its module lead to expect, by the reference's times (without N: "
         "40)",
         3},
        CAMERA_ARGP_OPTIONS,
        {0}},
    parse,
    "SCENE...\nmerge FILE... -o FILE",
    "Times every algorithm on every scene (a name or a pattern, as 'mesh:*'), "
    "view and size. An algorithm is timed only if its picture equals the "
    "oracle's; one that is wrong, refuses, crashes, takes too long or too much "
    "memory is recorded as such. All cells of one scene, view and size take "
    "turns, each in its own process, so that whatever disturbs the machine "
    "disturbs all alike.\v"
    "Exit status 0: all are right, and none is slower than in the baseline. 1: "
    "one is not.\n\n"
    "  hsr bench house harbor -o results.ndjson\n"
    "  hsr bench house --eye 9,5,9 --fov 30\n"
    "  hsr bench 'mesh:*' -a 'zbuffer-fast,*watkins*' --size 512x512,4096x4096",
    NULL,
    NULL,
    NULL};

/* --- The file ------------------------------------------------------------- */

/* Removes a last line that is cut short because its process was killed: the
 * next line must not follow it. */
static enum hsr_status cut_last_line(int file, const char *path,
                                     struct hsr_error *err) {
  off_t end = lseek(file, 0, SEEK_END);
  char byte = '\0';
  while (end > 0 && pread(file, &byte, 1, end - 1) == 1 && byte != '\n')
    end--;
  return ftruncate(file, end)
             ? hsr_fail(err, HSR_E_INPUT, "%s: %s", path, strerror(errno))
             : HSR_OK;
}

/* Results of other code must not be mixed with these. */
static enum hsr_status check_code(const struct results *results,
                                  const char *code, const char *path,
                                  struct hsr_error *err) {
  size_t k;
  const json_t *header;
  json_array_foreach(results->headers, k, header) {
    const char *other = json_string_value(json_object_get(header, "code"));
    if (!other || strcmp(other, code))
      return hsr_fail(err, HSR_E_USAGE,
                      "--resume %s: its results are of another build of hsr",
                      path);
  }
  return HSR_OK;
}

/* Reads what is in the file already. A file that holds something else is left
 * as it is. */
static enum hsr_status read_file(struct sweep *sweep, const char *path,
                                 const struct stat *about,
                                 struct hsr_error *err) {
  if (!S_ISREG(about->st_mode))
    return hsr_fail(err, HSR_E_USAGE, "--resume: %s is not a file", path);
  enum hsr_status status = results_read(&sweep->results, path, err);
  if (!status && about->st_size && !json_array_size(sweep->results.headers))
    return hsr_fail(err, HSR_E_INPUT, "%s: holds no results to go on from",
                    path);
  return status ? status : check_code(&sweep->results, sweep->code, path, err);
}

/* Two runs in one file would cut each other's lines. */
static bool is_locked_by_another(int file) {
  struct flock all = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
  return fcntl(file, F_SETLK, &all) && (errno == EACCES || errno == EAGAIN);
}

static enum hsr_status open_file(struct sweep *sweep, struct hsr_error *err) {
  const struct sweep_options *o = sweep->plan->options;
  const char *path = o->output;
  sweep->file = -1;
  if (!path)
    return HSR_OK;
  struct stat about;
  bool there = !stat(path, &about), device = there && !S_ISREG(about.st_mode);
  if (there && !device && !o->resume)
    return hsr_fail(err, HSR_E_USAGE, "%s is there already (--resume goes on)",
                    path);
  enum hsr_status status = HSR_OK;
  if (there && o->resume)
    status = read_file(sweep, path, &about, err);
  if (status)
    return status;
  int how = device ? O_WRONLY : O_RDWR | O_CREAT | O_APPEND;
  sweep->file = open(path, how | O_CLOEXEC | (there ? 0 : O_EXCL), 0666);
  if (sweep->file < 0)
    return hsr_fail(err, HSR_E_INPUT, "%s: %s", path, strerror(errno));
  sweep->is_new = !there;
  if (device)
    return HSR_OK;
  if (is_locked_by_another(sweep->file))
    return hsr_fail(err, HSR_E_USAGE, "%s: another hsr bench writes to it",
                    path);
  status = cut_last_line(sweep->file, path, err);
  return status
             ? status
             : journal_open(&sweep->journal, path, sweep->code, o->resume, err);
}

/* --- The sweep ------------------------------------------------------------ */

static void print_list(const struct plan *plan) {
  for (size_t k = 0; k < plan_places(plan); k++) {
    struct place place = plan_place(plan, k);
    for (int e = 0; e < plan->n_entrants; e++) {
      char key[RESULTS_KEY];
      plan_key(&place, &plan->entrant[e], key);
      if (plan_wants(plan, k, &plan->entrant[e]))
        puts(key);
    }
  }
}

static enum hsr_status sweep_all(struct sweep *sweep, struct hsr_error *err) {
  sweep->begin = hsr_seconds_now();
  enum hsr_status status = HSR_OK;
  size_t all = plan_places(sweep->plan);
  for (size_t k = 0; k < all && !status; k++)
    status = sweep_place(sweep, k, err);
  return status;
}

/* Whether a cell is neither right, nor refused, nor known to be wrong. */
static bool has_failures(const struct results *results) {
  size_t k;
  const json_t *cell;
  json_array_foreach(results->cells, k, cell) {
    const char *status = json_string_value(json_object_get(cell, "status"));
    if (!status || (strcmp(status, "ok") && strcmp(status, "refused") &&
                    !json_is_true(json_object_get(cell, "known_wrong")) &&
                    !json_is_true(json_object_get(cell, "peer"))))
      return true;
  }
  return false;
}

static enum hsr_status tell(const struct sweep_options *o,
                            const struct results *results,
                            const struct results *baseline,
                            struct hsr_error *err) {
  struct rows rows;
  enum hsr_status status = rows_make(&rows, results, o->reference, err);
  if (!status)
    rows_print(&rows);
  rows_free(&rows);
  if (!status && o->baseline)
    status = print_changes(results, baseline, o->reference, err);
  if (!status && o->cliffs)
    status = print_cliffs(results, o->reference, o->cliffs, err);
  if (!status && has_failures(results))
    return HSR_E_DIFFERENCE;
  return status;
}

static void name_run(char run[17]) {
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  uint64_t x = (uint64_t)now.tv_sec * 1000000007u ^
               (uint64_t)now.tv_nsec << 20 ^ (uint64_t)getpid();
  snprintf(run, 17, "%016llx", (unsigned long long)x);
}

/* Whether the run has failed before its first record. Then it leaves no file
 * that would block the next. */
static bool is_left_empty(const struct sweep *sweep, enum hsr_status status) {
  return status && sweep->is_new && !json_array_size(sweep->results.cells);
}

enum hsr_status sweep_run(const struct plan *plan, int argc, char **argv,
                          struct results *results, struct hsr_error *err) {
  char run[17];
  name_run(run);
  struct sweep sweep = {
      .plan = plan, .run = run, .file = -1, .journal.file = -1};
  hash_program(sweep.code);
  enum hsr_status status = open_file(&sweep, err);
  if (!status)
    status = sweep_record(
        &sweep, sweep_header(plan->options, run, sweep.code, argc, argv), err);
  if (!status)
    status = sweep_all(&sweep, err);
  if (is_left_empty(&sweep, status))
    unlink(plan->options->output);
  journal_close(&sweep.journal, !status);
  if (sweep.file >= 0 && close(sweep.file) && !status)
    status = hsr_fail(err, HSR_E_INPUT, "%s: %s", plan->options->output,
                      strerror(errno));
  *results = sweep.results;
  return status;
}

/* After Ctrl-C what is recorded stays, and the rest is in the journal. */
static void tell_of_interrupt(const struct results *results) {
  size_t n = json_array_size(results->cells);
  if (isatty(STDERR_FILENO))
    putc('\n', stderr); /* the terminal shows ^C */
  if (n)
    fprintf(stderr,
            "hsr: interrupted; %zu cells are recorded; --resume goes on\n", n);
  else
    fputs("hsr: interrupted before a cell was judged\n", stderr);
}

/* Judging, two starts of every cell, and the start that is under way are
 * brought to their end whatever the budget. */
static void tell_of_budget(const struct sweep_options *o, double seconds) {
  char text[200];
  if (!o->budget || seconds <= 1.1 * (double)o->budget)
    return;
  snprintf(
      text, sizeof text,
      "budget: %ld s were asked for, the run took %.0f s. Judging, and two "
      "starts of every cell, are never cut short",
      o->budget, seconds);
  terminal_wrap(stdout, 0, 2, text);
}

static enum hsr_status run_and_tell(const struct plan *plan, int argc,
                                    char **argv, struct hsr_error *err) {
  struct results results = {.headers = NULL}, baseline = {.headers = NULL};
  enum hsr_status status = HSR_OK;
  if (plan->options->baseline)
    status = results_read(&baseline, plan->options->baseline, err);
  double begin = hsr_seconds_now();
  if (!status)
    status = sweep_run(plan, argc, argv, &results, err);
  if (status == HSR_E_STOPPED)
    tell_of_interrupt(&results);
  if (!status)
    status = tell(plan->options, &results, &baseline, err);
  if (!status || status == HSR_E_DIFFERENCE)
    tell_of_budget(plan->options, hsr_seconds_now() - begin);
  results_free(&results);
  results_free(&baseline);
  return status;
}

enum hsr_status sweep_parse(int argc, char **argv, struct sweep_options *o,
                            struct hsr_error *err) {
  *o = (struct sweep_options)SWEEP_OPTIONS_STANDARD;
  return parse_options(&argp, argc, argv, o, err);
}

/* Copies the command line as given, before the options are cut into words. */
static char **copy_words(int argc, char **argv) {
  char **copy = calloc((size_t)argc + 1, sizeof *copy);
  for (int k = 0; copy && k < argc; k++)
    if (!(copy[k] = strdup(argv[k]))) {
      while (k--)
        free(copy[k]);
      free(copy);
      return NULL;
    }
  return copy;
}

static void free_words(char **words) {
  for (char **word = words; word && *word; word++)
    free(*word);
  free(words);
}

enum hsr_status command_bench(int argc, char **argv, struct hsr_error *err) {
  if (argc > 1 && !strcmp(argv[1], "merge"))
    return command_merge(argc - 1, argv + 1, err);
  struct sweep_options *o = calloc(1, sizeof *o);
  struct plan *plan = calloc(1, sizeof *plan);
  char **words = copy_words(argc, argv);
  enum hsr_status status = o && plan && words ? HSR_OK : hsr_fail_nomem(err);
  if (!status)
    status = sweep_parse(argc, argv, o, err);
  if (!status)
    status = plan_init(plan, o, err);
  if (!status && o->list)
    print_list(plan);
  else if (!status) {
    if (o->output)
      interrupt_listen();
    status = run_and_tell(plan, argc, words, err);
  }
  if (plan)
    plan_free(plan);
  free_words(words);
  free(plan);
  free(o);
  if (status == HSR_E_STOPPED)
    interrupt_end();
  return status;
}
