/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr bench merge: the files of all shards of a sweep as one, if they fit
 * together.
 *
 * A file's headers hold the command lines that wrote it. Each is read again,
 * and so it is known which cells the whole sweep has. All headers must be of
 * one build of hsr and of one plan; every cell of the plan must be there, and
 * only once. The cells of a scene, view and size are in one shard, so that
 * ratios of their times are made within one machine. That is checked too, since
 * a run that goes on may have moved. */
#include "bench/sweep/sweep.h"
#include "bench/terminal/terminal.h"
#include "common/files/whole_file.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_FILES = 1000, CHUNK = 1 << 16 };

struct merge_options {
  struct option_base base;
  const char *file[MOST_FILES], *output;
  int n_files;
};

/* A sweep as one header tells it. */
struct told {
  char **word; /* of the command line; the options point into them */
  struct sweep_options options;
  struct plan plan; /* of all shards */
};

struct merge {
  const struct merge_options *options;
  struct results *part; /* of each file */
  struct told first;
};

/* --- Options -------------------------------------------------------------- */

static error_t parse(int key, char *arg, struct argp_state *state) {
  struct merge_options *o = state->input;
  switch (key) {
  case 'o':
    o->output = arg;
    return 0;
  case ARGP_KEY_ARG:
    if (o->n_files == MOST_FILES)
      return option_fail(&o->base, "bench merge: at most %d files",
                         (int)MOST_FILES);
    o->file[o->n_files++] = arg;
    return 0;
  case ARGP_KEY_END:
    return o->n_files ? 0 : option_fail(&o->base, "bench merge: which files?");
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp argp = {
    (const struct argp_option[]){
        {"output", 'o', "FILE", 0, "write all records to FILE", 0}, {0}},
    parse,
    "FILE...",
    "Puts the files of all shards of a sweep (hsr bench --shard) together, if "
    "they fit: they are of one build of hsr and of one sweep, no cell is in "
    "two of them, and none is missing. Prints which machine each comes from.",
    NULL,
    NULL,
    NULL};

/* --- The plan of a header ------------------------------------------------- */

static void forget(struct told *told) {
  plan_free(&told->plan);
  for (char **word = told->word; word && *word; word++)
    free(*word);
  free(told->word);
  *told = (struct told){.word = NULL};
}

/* Reads a header's command line: "hsr", "bench" and the rest. *told is to be
 * freed also after a failure. */
static enum hsr_status read_command(const json_t *header, struct told *told,
                                    struct hsr_error *err) {
  const json_t *command = json_object_get(header, "command");
  size_t n = json_array_size(command);
  *told = (struct told){.word = NULL};
  told->word = calloc(n + 1, sizeof *told->word);
  if (!told->word)
    return hsr_fail_nomem(err);
  for (size_t k = 1; k < n; k++) {
    const char *word = json_string_value(json_array_get(command, k));
    told->word[k - 1] = strdup(word ? word : "");
    if (!told->word[k - 1])
      return hsr_fail_nomem(err);
  }
  enum hsr_status status =
      sweep_parse((int)n - 1, told->word, &told->options, err);
  return status ? status : plan_init(&told->plan, &told->options, err);
}

/* Whether both sweeps have the same cells, made in the same way. */
static bool is_same_sweep(const struct told *a, const struct told *b) {
  const struct sweep_options *p = &a->options, *q = &b->options;
  const struct plan *x = &a->plan, *y = &b->plan;
  bool same = p->views == q->views && p->walk == q->walk &&
              p->starts == q->starts && p->repetitions == q->repetitions &&
              p->seed == q->seed && p->timeout == q->timeout &&
              p->memory_mb == q->memory_mb && p->samples == q->samples &&
              p->budget == q->budget && p->counts == q->counts &&
              p->shards == q->shards && p->n_sizes == q->n_sizes &&
              !strcmp(p->only ? p->only : "", q->only ? q->only : "") &&
              x->n_scenes == y->n_scenes && x->n_entrants == y->n_entrants;
  for (int k = 0; same && k < p->n_sizes; k++)
    same = p->m[k] == q->m[k] && p->n[k] == q->n[k];
  for (size_t k = 0; same && k < x->n_scenes; k++)
    same = !strcmp(x->scene[k], y->scene[k]);
  for (int k = 0; same && k < x->n_entrants; k++)
    same = x->entrant[k].threads == y->entrant[k].threads &&
           !strcmp(x->entrant[k].name, y->entrant[k].name);
  return same;
}

/* --- Whether the files fit ------------------------------------------------ */

/* Checks a header of file k against the first header of the first file. */
static enum hsr_status check_header(const struct merge *merge, int k,
                                    const json_t *header,
                                    struct hsr_error *err) {
  const char *name = merge->options->file[k], *first = merge->options->file[0];
  const json_t *wanted = json_array_get(merge->part[0].headers, 0);
  if (strcmp(results_text(header, "code"), results_text(wanted, "code")) ||
      strcmp(results_text(header, "commit"), results_text(wanted, "commit")))
    return hsr_fail(err, HSR_E_INPUT, "%s: is of another build of hsr than %s",
                    name, first);
  struct told told;
  enum hsr_status status = read_command(header, &told, err);
  if (!status && !is_same_sweep(&told, &merge->first))
    status = hsr_fail(err, HSR_E_INPUT,
                      "%s: is of another sweep, or of other parts, than %s",
                      name, first);
  forget(&told);
  return status;
}

/* The machine of a record, without its load; a new reference. */
static json_t *machine_of(const struct results *part, const json_t *record) {
  const char *run = results_text(record, "run");
  size_t k;
  const json_t *header;
  json_array_foreach(part->headers, k, header) {
    if (strcmp(results_text(header, "run"), run))
      continue;
    json_t *machine = json_copy(json_object_get(header, "machine"));
    json_object_del(machine, "load");
    return machine;
  }
  return NULL;
}

/* Checks that the cells of a view are of the machine of the one before. */
static enum hsr_status check_machines(const char *name,
                                      const struct results *part,
                                      struct hsr_error *err) {
  char view[RESULTS_KEY] = "", last[RESULTS_KEY] = "";
  json_t *before = NULL;
  enum hsr_status status = HSR_OK;
  size_t k;
  const json_t *cell;
  json_array_foreach(part->cells, k, cell) {
    results_picture_key(
        results_text(cell, "scene"), results_number(cell, "view"),
        results_number(cell, "walk"), results_number(cell, "width"),
        results_number(cell, "height"), view);
    json_t *machine = machine_of(part, cell);
    if (!strcmp(view, last) && !json_equal(machine, before) && !status)
      status = hsr_fail(err, HSR_E_INPUT,
                        "%s: %.200s is of two machines, so no ratios can be "
                        "made of it",
                        name, view);
    memcpy(last, view, sizeof last);
    json_decref(before);
    before = machine;
  }
  json_decref(before);
  return status;
}

/* Checks that no cell of file k is in an earlier one. */
static enum hsr_status check_twice(const struct merge *merge, int k,
                                   struct hsr_error *err) {
  size_t c;
  const json_t *cell;
  json_array_foreach(merge->part[k].cells, c, cell) {
    char key[RESULTS_KEY];
    results_key(cell, key);
    for (int l = 0; l < k; l++)
      if (results_cell(&merge->part[l], key))
        return hsr_fail(err, HSR_E_INPUT, "%s: %.200s is in %s, too",
                        merge->options->file[k], key, merge->options->file[l]);
  }
  return HSR_OK;
}

static bool is_anywhere(const struct merge *merge, const char *key) {
  for (int k = 0; k < merge->options->n_files; k++)
    if (results_cell(&merge->part[k], key))
      return true;
  return false;
}

/* Checks that no cell of the plan is missing. */
static enum hsr_status check_missing(struct merge *merge,
                                     struct hsr_error *err) {
  const struct plan *plan = &merge->first.plan;
  struct sweep_options *o = &merge->first.options;
  char key[RESULTS_KEY], first[RESULTS_KEY] = "";
  size_t all = 0, missing = 0;
  o->shard = o->shards = 1;
  for (size_t k = 0; k < plan_places(plan); k++)
    for (int e = 0; e < plan->n_entrants; e++) {
      struct place place = plan_place(plan, k);
      plan_key(&place, &plan->entrant[e], key);
      if (!plan_wants(plan, k, &plan->entrant[e]))
        continue;
      all++;
      if (!is_anywhere(merge, key) && !missing++)
        memcpy(first, key, sizeof first);
    }
  return missing ? hsr_fail(err, HSR_E_INPUT,
                            "%zu of %zu cells are missing; the first is %.200s",
                            missing, all, first)
                 : HSR_OK;
}

static enum hsr_status check(struct merge *merge, struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < merge->options->n_files && !status; k++) {
    const struct results *part = &merge->part[k];
    size_t h;
    const json_t *header;
    json_array_foreach(part->headers, h, header) {
      if (!status)
        status = check_header(merge, k, header, err);
    }
    if (!status)
      status = check_machines(merge->options->file[k], part, err);
    if (!status)
      status = check_twice(merge, k, err);
  }
  return status ? status : check_missing(merge, err);
}

/* --- The files ------------------------------------------------------------ */

static enum hsr_status read_parts(struct merge *merge, struct hsr_error *err) {
  for (int k = 0; k < merge->options->n_files; k++) {
    const char *name = merge->options->file[k];
    enum hsr_status status = results_read(&merge->part[k], name, err);
    if (status)
      return status;
    if (!json_array_size(merge->part[k].headers))
      return hsr_fail(err, HSR_E_INPUT, "%s: holds no results of hsr bench",
                      name);
  }
  return read_command(json_array_get(merge->part[0].headers, 0), &merge->first,
                      err);
}

static enum hsr_status write_records(FILE *out, const json_t *records,
                                     struct hsr_error *err) {
  size_t k;
  const json_t *record;
  json_array_foreach(records, k, record) {
    char *line = json_dumps(record, JSON_COMPACT);
    if (!line)
      return hsr_fail_nomem(err);
    fprintf(out, "%s\n", line);
    free(line);
  }
  return HSR_OK;
}

static enum hsr_status write_all(const struct merge *merge,
                                 struct hsr_error *err) {
  struct hsr_whole_file file;
  enum hsr_status status =
      hsr_whole_file_open(&file, merge->options->output, err);
  if (status)
    return status;
  for (int k = 0; k < merge->options->n_files && !status; k++) {
    const struct results *part = &merge->part[k];
    status = write_records(file.stream, part->headers, err);
    if (!status)
      status = write_records(file.stream, part->views, err);
    if (!status)
      status = write_records(file.stream, part->cells, err);
  }
  return hsr_whole_file_close(&file, status, err);
}

/* "a.ndjson: 12 cells; 4 cores, 8 threads, name of the processor". */
static void print_part(const char *name, const struct results *part) {
  const json_t *header = json_array_get(part->headers, 0),
               *machine = json_object_get(header, "machine");
  const char *cpu = json_string_value(json_object_get(machine, "cpu"));
  char plain[TERMINAL_NAME], cells[TERMINAL_NUMBER], text[400];
  snprintf(text, sizeof text, "%s: %s; %ld cores, %ld threads, %.100s",
           terminal_plain(name, plain, sizeof plain),
           terminal_number(json_array_size(part->cells), "cells", cells),
           results_number(machine, "cores"), results_number(machine, "threads"),
           cpu ? cpu : "a processor without a name");
  terminal_wrap(stdout, 0, 4, text);
}

enum hsr_status command_merge(int argc, char **argv, struct hsr_error *err) {
  struct merge_options *o = calloc(1, sizeof *o);
  struct results *part = calloc(MOST_FILES, sizeof *part);
  struct merge merge = {.options = o, .part = part};
  enum hsr_status status = o && part ? parse_options(&argp, argc, argv, o, err)
                                     : hsr_fail_nomem(err);
  if (!status)
    status = read_parts(&merge, err);
  if (!status)
    status = check(&merge, err);
  if (!status && o->output)
    status = write_all(&merge, err);
  for (int k = 0; !status && k < o->n_files; k++)
    print_part(o->file[k], &part[k]);
  for (int k = 0; part && k < MOST_FILES; k++)
    results_free(&part[k]);
  forget(&merge.first);
  free(part);
  free(o);
  return status;
}
