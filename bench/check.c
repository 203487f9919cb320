/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr check: every algorithm's picture against the oracle's.
 *
 * A group is one scene, view and size. It is judged in a process of its own,
 * several at a time: there the oracle draws, and then each algorithm, again in
 * a process of its own, so that one that crashes or takes too long harms
 * nothing. Both builds of an algorithm are judged, the counting one too. */
#include "bench/command.h"
#include "bench/json.h"
#include "bench/terminate.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

enum {
  MOST_SCENES = 4096,
  MOST_SIZES = 16,
  MOST_ALGORITHMS = 64,
  DROP = 0x200
};

struct options {
  struct option_base base;
  const char *scene[MOST_SCENES];
  int n_scenes;
  int m[MOST_SIZES], n[MOST_SIZES], n_sizes;
  const struct hsr_listed *algorithm[MOST_ALGORITHMS];
  int n_algorithms;
  const struct hsr_listed *oracle;
  long views, jobs, timeout;
  bool json, failures_only;
  struct hsr_import import;
};

/* --- Options ---------------------------------------------------------------
 */

static error_t add_sizes(struct options *o, char *arg) {
  for (char *size = strtok(arg, ","); size; size = strtok(NULL, ",")) {
    if (o->n_sizes == MOST_SIZES)
      return option_fail(&o->base, "check: at most %d sizes", (int)MOST_SIZES);
    if (!parse_size(size, &o->m[o->n_sizes], &o->n[o->n_sizes]))
      return option_fail(&o->base, "--size %s: must be MxN, each 1 to %d", size,
                         HSR_MAX_SIZE);
    o->n_sizes++;
  }
  return 0;
}

static error_t add_algorithms(struct options *o, char *arg) {
  for (char *name = strtok(arg, ","); name; name = strtok(NULL, ",")) {
    const struct hsr_listed *listed;
    if (choose_algorithm(name, &listed, o->base.err)) {
      o->base.failed = true;
      return EINVAL;
    }
    if (listed->plain->flags & HSR_NO_PICTURE)
      return option_fail(&o->base, "check: %s draws nothing to compare", name);
    if (o->n_algorithms == MOST_ALGORITHMS)
      return option_fail(&o->base, "check: at most %d algorithms",
                         (int)MOST_ALGORITHMS);
    o->algorithm[o->n_algorithms++] = listed;
  }
  return 0;
}

static error_t parse(int key, char *arg, struct argp_state *state) {
  struct options *o = state->input;
  switch (key) {
  case 'a':
    return add_algorithms(o, arg);
  case 's':
    return add_sizes(o, arg);
  case 'n':
    if (!parse_count(arg, 1, 1000, &o->views))
      return option_fail(&o->base, "--views %s: must be 1 to 1000", arg);
    return 0;
  case 'J':
    if (!parse_count(arg, 1, 256, &o->jobs))
      return option_fail(&o->base, "--jobs %s: must be 1 to 256", arg);
    return 0;
  case 't':
    if (!parse_count(arg, 1, 100000, &o->timeout))
      return option_fail(&o->base, "--timeout %s: must be 1 to 100000", arg);
    return 0;
  case 'j':
    o->json = true;
    return 0;
  case 'f':
    o->failures_only = true;
    return 0;
  case DROP:
    o->import.drop_degenerate = true;
    return 0;
  case ARGP_KEY_ARG:
    if (o->n_scenes == MOST_SCENES)
      return option_fail(&o->base, "check: at most %d scenes",
                         (int)MOST_SCENES);
    o->scene[o->n_scenes++] = arg;
    return 0;
  default:
    return ARGP_ERR_UNKNOWN;
  }
}

static const struct argp argp = {
    (const struct argp_option[]){
        {"algorithms", 'a', "A,B,...", 0,
         "judge these (standard: all that draw)", 0},
        {"size", 's', "MxN,...", 0, "samples (standard: 97x61)", 0},
        {"views", 'n', "N", 0,
         "the first N views of each scene; more are made up if it has fewer "
         "(standard: 8)",
         0},
        {"failure-cases", 'f', NULL, 0,
         "where no scene is named: only the failure cases", 0},
        {"jobs", 'J', "N", 0, "views at a time (standard: one a processor)", 0},
        {"timeout", 't', "SECONDS", 0,
         "the most that one picture may take (standard: 60); an algorithm "
         "whose "
         "work for a view is known to be more is refused",
         0},
        {"drop-degenerate", DROP, NULL, 0,
         "leave out faces of mesh files that cannot be used", 0},
        {"json", 'j', NULL, 0, "print one JSON object", 0},
        {0}},
    parse,
    "[SCENE...]",
    "Compares every algorithm's picture with the oracle's, sample for sample. "
    "Without SCENE, all built-in scenes with their standard parameters.\v"
    "Exit status 0: no sample differs. 1: one does, or an algorithm crashed or "
    "took too long.\n\n"
    "  hsr check\n"
    "  hsr check house mesh:elephant -a watkins --size 97x61,512x512",
    NULL,
    NULL,
    NULL};

static void set_standards(struct options *o) {
  if (!o->n_scenes)
    for (const struct hsr_builtin *b = hsr_builtins;
         b->name && o->n_scenes < MOST_SCENES; b++)
      if (b->failure_case || !o->failures_only)
        o->scene[o->n_scenes++] = b->name;
  if (!o->n_sizes) {
    o->m[0] = 97;
    o->n[0] = 61;
    o->n_sizes = 1;
  }
  o->oracle = hsr_algorithm_find("oracle");
  if (!o->n_algorithms)
    for (const struct hsr_listed *a = hsr_algorithms; a->plain; a++)
      if (a->plain->kind == HSR_IDS &&
          !(a->plain->flags & (HSR_JUDGE | HSR_NO_PICTURE)))
        o->algorithm[o->n_algorithms++] = a;
}

/* --- One cell: an algorithm on a scene, view and size ------------------------
 */

enum verdict { PENDING, RIGHT, WRONG, REFUSED, TIMEOUT, CRASH };

static const char *const verdict_name[] = {
    [PENDING] = "crash",   [RIGHT] = "ok",        [WRONG] = "wrong",
    [REFUSED] = "refused", [TIMEOUT] = "timeout", [CRASH] = "crash"};

/* In memory shared between the processes. */
struct cell {
  enum verdict verdict;
  enum hsr_status failure; /* why the process stopped, if not HSR_OK */
  uint64_t mismatches;     /* in both builds */
  int i, j;                /* the first of them */
  uint32_t got, wanted;
  uint64_t depths_compared, depths_exact;
  const char
      *adapted[HSR_MAX_ADAPTATIONS]; /* adapters that changed the scene */
  int n_adaptations;
  char refusal[480]; /* why, if an adapter refused */
};

/* What a group's processes work on. */
struct group {
  const struct options *options;
  const struct hsr_scene *scene;
  const struct hsr_world *world;
  const struct hsr_setup *oracle;
  struct hsr_view view;
  uint32_t *wanted, *got; /* m * n each; got is shared */
  struct cell *cells;     /* an algorithm */
};

static void *shared_memory(size_t size) {
  void *memory = mmap(NULL, size, PROT_READ | PROT_WRITE,
                      MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  return memory == MAP_FAILED ? NULL : memory;
}

static void compare(const struct group *g, struct cell *cell) {
  size_t m = (size_t)g->view.m, n = m * (size_t)g->view.n;
  for (size_t k = 0; k < n; k++)
    if (g->got[k] != g->wanted[k] && !cell->mismatches++) {
      cell->i = (int)(k % m);
      cell->j = (int)(k / m);
      cell->got = g->got[k];
      cell->wanted = g->wanted[k];
    }
}

/* In a process of its own. */
static enum hsr_status judge(const struct group *g,
                             const struct hsr_algorithm *a, struct cell *cell,
                             bool counting) {
  struct hsr_error err;
  struct hsr_tally tally = {.out_of_memory = false};
  struct hsr_setup setup;
  /* A value that no picture holds shows what was not written. */
  memset(g->got, 0xfe, (size_t)g->view.m * (size_t)g->view.n * sizeof *g->got);
  enum hsr_status status = hsr_setup_init(&setup, a, g->world, &err);
  if (!status)
    status = render_view(&setup, &g->view, 1, g->got, &tally, NULL, &err);
  cell->n_adaptations = setup.n_adaptations;
  for (int k = 0; k < setup.n_adaptations; k++)
    cell->adapted[k] = setup.adaptation[k].name; /* lasts: it is a constant */
  hsr_setup_free(&setup);
  if (status == HSR_E_REFUSED)
    snprintf(cell->refusal, sizeof cell->refusal, "%s", err.text);
  if (status)
    return status;
  compare(g, cell);
  if (counting) {
    cell->depths_compared = tally.depths_compared;
    cell->depths_exact = tally.exact[HSR_ASK_DEPTH];
  }
  return HSR_OK;
}

/* Runs the algorithm in a new process and waits for it. */
static void judge_apart(const struct group *g, const struct hsr_listed *listed,
                        struct cell *cell) {
  const struct hsr_algorithm *a = listed->plain;
  double limit = 5e8 * (double)g->options->timeout;
  if (a->expense && a->expense(g->world, &g->view) > limit) {
    cell->verdict = REFUSED;
    return;
  }
  fflush(NULL);
  pid_t child = fork();
  if (child == 0) {
    alarm((unsigned)g->options->timeout);
    enum hsr_status status = judge(g, listed->plain, cell, false);
    alarm((unsigned)g->options->timeout);
    if (!status)
      status = judge(g, listed->counting, cell, true);
    alarm(0);
    end_process((int)status);
  }
  int end = 0;
  if (child < 0 || waitpid(child, &end, 0) < 0) {
    cell->failure = HSR_E_NOMEM;
    cell->verdict = CRASH;
  } else if (WIFSIGNALED(end)) {
    cell->verdict = WTERMSIG(end) == SIGALRM ? TIMEOUT : CRASH;
  } else if (WEXITSTATUS(end) == HSR_E_REFUSED) {
    cell->verdict = REFUSED;
  } else if (WEXITSTATUS(end)) {
    cell->failure = (enum hsr_status)WEXITSTATUS(end);
    cell->verdict = CRASH;
  } else {
    cell->verdict = cell->mismatches ? WRONG : RIGHT;
  }
}

/* In a process of its own: the oracle's picture, then everybody's. */
static enum hsr_status judge_group(struct group *g) {
  size_t size = (size_t)g->view.m * (size_t)g->view.n * sizeof *g->wanted;
  struct hsr_error err;
  struct hsr_tally tally = {.out_of_memory = false};
  g->wanted = malloc(size);
  g->got = shared_memory(size);
  enum hsr_status status = g->wanted && g->got ? HSR_OK : HSR_E_NOMEM;
  if (!status)
    status = render_view(g->oracle, &g->view, 1, g->wanted, &tally, NULL, &err);
  for (int a = 0; a < g->options->n_algorithms && !status; a++)
    judge_apart(g, g->options->algorithm[a], &g->cells[a]);
  if (g->got)
    munmap(g->got, size);
  free(g->wanted);
  return status;
}

/* --- All groups of a scene
 * ---------------------------------------------------- */

struct scene_run {
  const struct options *options;
  const char *name;
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_setup oracle;
  int n_groups;
  struct cell *cells; /* n_groups * n_algorithms, shared */
  size_t cells_size;
};

static struct cell *cell_at(const struct scene_run *run, int size, int view,
                            int algorithm) {
  int n_algorithms = run->options->n_algorithms;
  int group = size * (int)run->options->views + view;
  return &run->cells[group * n_algorithms + algorithm];
}

/* Groups done, to be seen on a terminal. */
static void show_progress(const struct scene_run *run, int done) {
  if (!isatty(STDERR_FILENO))
    return;
  if (done == run->n_groups)
    fprintf(stderr, "\r\033[K");
  else
    fprintf(stderr, "\r\033[K%s: %d of %d", run->name, done, run->n_groups);
  fflush(stderr);
}

/* Waits for a group to end; *failure keeps the first failure. */
static void wait_for_group(enum hsr_status *failure) {
  int end;
  pid_t child;
  do
    child = waitpid(-1, &end, 0);
  while (child < 0 && errno == EINTR);
  if (child < 0 || *failure)
    return;
  if (WIFSIGNALED(end))
    *failure = HSR_E_INTERNAL;
  else
    *failure = (enum hsr_status)WEXITSTATUS(end);
}

static enum hsr_status start_group(const struct scene_run *run, int size,
                                   int view, struct hsr_error *err) {
  struct group g = {.options = run->options,
                    .scene = run->scene,
                    .world = &run->world,
                    .oracle = &run->oracle,
                    .cells = cell_at(run, size, view, 0)};
  enum hsr_status status =
      hsr_view_init(&g.view, &run->scene->views[view], run->options->m[size],
                    run->options->n[size], err);
  if (status)
    return status;
  fflush(NULL);
  pid_t child = fork();
  if (child == 0)
    end_process((int)judge_group(&g));
  return child < 0 ? hsr_fail_nomem(err) : HSR_OK;
}

static enum hsr_status run_groups(const struct scene_run *run,
                                  struct hsr_error *err) {
  const struct options *o = run->options;
  enum hsr_status status = HSR_OK, failure = HSR_OK;
  int running = 0, done = 0;
  show_progress(run, 0);
  for (int k = 0; k < run->n_groups && !status && !failure; k++) {
    if (running == o->jobs) {
      wait_for_group(&failure);
      running--;
      show_progress(run, ++done);
    }
    status = start_group(run, k / (int)o->views, k % (int)o->views, err);
    running += !status;
  }
  for (; running; running--) {
    wait_for_group(&failure);
    show_progress(run, ++done);
  }
  if (!status && failure == HSR_E_NOMEM)
    return hsr_fail_nomem(err);
  if (!status && failure)
    return hsr_fail(err, HSR_E_INTERNAL, "%s: the oracle failed", run->name);
  return status;
}

static enum hsr_status open_run(struct scene_run *run, struct hsr_error *err) {
  const struct options *o = run->options;
  struct hsr_import import = o->import;
  enum hsr_status status = hsr_scene_open(run->name, &import, &run->scene, err);
  if (status)
    return status;
  if (run->scene->n_views < o->views)
    status = hsr_scene_add_orbit(run->scene,
                                 (unsigned)o->views - run->scene->n_views);
  if (status)
    return hsr_fail_nomem(err);
  status = hsr_world_init(&run->world, run->scene, err);
  if (status)
    return status;
  run->n_groups = o->n_sizes * (int)o->views;
  run->cells_size =
      (size_t)(run->n_groups * o->n_algorithms) * sizeof *run->cells;
  run->cells = shared_memory(run->cells_size);
  if (!run->cells)
    return hsr_fail_nomem(err);
  return hsr_setup_init(&run->oracle, o->oracle->plain, &run->world, err);
}

static void close_run(struct scene_run *run) {
  if (run->oracle.algorithm)
    hsr_setup_free(&run->oracle);
  if (run->cells)
    munmap(run->cells, run->cells_size);
  hsr_world_free(&run->world);
  hsr_scene_delete(run->scene);
}

/* --- The report
 * ---------------------------------------------------------------- */

struct totals {
  uint64_t samples, mismatches, depths, depths_exact;
  uint64_t expected; /* mismatches of algorithms that are known to be wrong */
  int failures;      /* cells that are neither ok nor refused */
  json_t *cells;
};

static void print_header(const struct options *o) {
  printf("%-22s %8s %9s %5s ", "scene", "faces", "samples", "views");
  for (int a = 0; a < o->n_algorithms; a++)
    printf(" %9s", o->algorithm[a]->plain->name);
  puts("   mismatches");
}

/* One line a size: mismatches over all views, or the worst verdict. */
static void print_scene(const struct scene_run *run) {
  const struct options *o = run->options;
  for (int size = 0; size < o->n_sizes; size++) {
    char samples[24];
    snprintf(samples, sizeof samples, "%dx%d", o->m[size], o->n[size]);
    printf("%-22s %8u %9s %5ld ", run->name, run->world.n_faces, samples,
           o->views);
    for (int a = 0; a < o->n_algorithms; a++) {
      uint64_t mismatches = 0;
      enum verdict worst = RIGHT;
      for (int view = 0; view < o->views; view++) {
        const struct cell *cell = cell_at(run, size, view, a);
        mismatches += cell->mismatches;
        if (cell->verdict > worst || cell->verdict == PENDING)
          worst = cell->verdict;
      }
      int width = (int)strlen(o->algorithm[a]->plain->name);
      width = width > 9 ? width : 9;
      bool known = o->algorithm[a]->plain->flags & HSR_KNOWN_WRONG;
      char cell[32];
      snprintf(cell, sizeof cell, known && mismatches ? "(%llu)" : "%llu",
               (unsigned long long)mismatches);
      if (worst == RIGHT || worst == WRONG)
        printf(" %*s", width, cell);
      else
        printf(" %*s", width, verdict_name[worst]);
    }
    putchar('\n');
  }
}

static void print_difference(const struct scene_run *run, int size, int view,
                             int a) {
  const struct options *o = run->options;
  const struct cell *c = cell_at(run, size, view, a);
  const struct hsr_algorithm *algorithm = o->algorithm[a]->plain;
  if (c->verdict == WRONG && !(algorithm->flags & HSR_KNOWN_WRONG))
    printf("  wrong: %s, view %d, %dx%d, %s: %llu samples, the first (%d, %d): "
           "face %u, not %u\n",
           run->name, view + 1, o->m[size], o->n[size], algorithm->name,
           (unsigned long long)c->mismatches, c->i, c->j, c->got, c->wanted);
  if (c->refusal[0] && !size && !view)
    printf("  refused by %s: %s\n", algorithm->name, c->refusal);
}

static void print_differences(const struct scene_run *run) {
  const struct options *o = run->options;
  for (int size = 0; size < o->n_sizes; size++)
    for (int view = 0; view < o->views; view++)
      for (int a = 0; a < o->n_algorithms; a++)
        print_difference(run, size, view, a);
}

static json_t *adapted_json(const struct cell *c) {
  json_t *names = json_array();
  for (int k = 0; k < c->n_adaptations; k++)
    json_append(&names, json_string(c->adapted[k]));
  return names;
}

static json_t *cell_json(const struct scene_run *run, int size, int view,
                         int a) {
  const struct options *o = run->options;
  const struct cell *c = cell_at(run, size, view, a);
  const struct hsr_algorithm *algorithm = o->algorithm[a]->plain;
  return json_pack(
      "{ss si si si ss ss ss sI sb so}", "scene", run->name, "view", view + 1,
      "width", o->m[size], "height", o->n[size], "algorithm", algorithm->name,
      "kind", "ids", "status", verdict_name[c->verdict], "mismatches",
      (json_int_t)c->mismatches, "known_wrong",
      (algorithm->flags & HSR_KNOWN_WRONG) != 0, "adapted", adapted_json(c));
}

static enum hsr_status add_up(const struct scene_run *run,
                              struct totals *totals) {
  const struct options *o = run->options;
  for (int size = 0; size < o->n_sizes; size++)
    for (int view = 0; view < o->views; view++)
      for (int a = 0; a < o->n_algorithms; a++) {
        const struct cell *c = cell_at(run, size, view, a);
        if (c->failure == HSR_E_NOMEM)
          return HSR_E_NOMEM;
        if (c->verdict == RIGHT || c->verdict == WRONG)
          totals->samples += (uint64_t)o->m[size] * (uint64_t)o->n[size];
        totals->depths += c->depths_compared;
        totals->depths_exact += c->depths_exact;
        if (o->algorithm[a]->plain->flags & HSR_KNOWN_WRONG &&
            c->verdict == WRONG) {
          totals->expected += c->mismatches;
        } else {
          totals->mismatches += c->mismatches;
          totals->failures += c->verdict != RIGHT && c->verdict != REFUSED;
        }
        if (o->json)
          json_append(&totals->cells, cell_json(run, size, view, a));
      }
  return HSR_OK;
}

static enum hsr_status print_totals(const struct options *o,
                                    struct totals *totals,
                                    struct hsr_error *err) {
  if (o->json)
    return json_print(
        json_pack("{ss sI sI sI sI so}", "schema", "hsr-check/1", "samples",
                  (json_int_t)totals->samples, "mismatches",
                  (json_int_t)totals->mismatches, "depths_compared",
                  (json_int_t)totals->depths, "depths_exact",
                  (json_int_t)totals->depths_exact, "cells", totals->cells),
        err);
  printf("\n%llu samples compared, %llu mismatches\n",
         (unsigned long long)totals->samples,
         (unsigned long long)totals->mismatches);
  if (totals->expected)
    printf("%llu more of algorithms that are known to be wrong\n",
           (unsigned long long)totals->expected);
  printf("%llu depth comparisons, %llu by the exact path",
         (unsigned long long)totals->depths,
         (unsigned long long)totals->depths_exact);
  if (totals->depths_exact)
    printf(" (1 in %.0f)",
           (double)totals->depths / (double)totals->depths_exact);
  putchar('\n');
  return HSR_OK;
}

static enum hsr_status check_scene(const struct options *o, const char *name,
                                   struct totals *totals,
                                   struct hsr_error *err) {
  struct scene_run run = {.options = o, .name = name};
  enum hsr_status status = open_run(&run, err);
  if (!status)
    status = run_groups(&run, err);
  if (!status && !o->json) {
    print_scene(&run);
    print_differences(&run);
    fflush(stdout);
  }
  if (!status && add_up(&run, totals))
    status = hsr_fail_nomem(err);
  close_run(&run);
  return status;
}

enum hsr_status command_check(int argc, char **argv, struct hsr_error *err) {
  struct options *o = calloc(1, sizeof *o);
  if (!o)
    return hsr_fail_nomem(err);
  o->views = 8;
  o->jobs = processors();
  o->timeout = 60;
  struct totals totals = {.samples = 0};
  enum hsr_status status = parse_options(&argp, argc, argv, o, err);
  if (!status) {
    set_standards(o);
    if (o->json)
      totals.cells = json_array();
    else
      print_header(o);
  }
  for (int k = 0; k < o->n_scenes && !status; k++)
    status = check_scene(o, o->scene[k], &totals, err);
  if (!status)
    status = print_totals(o, &totals, err);
  else
    json_decref(totals.cells);
  if (!status && (totals.mismatches || totals.failures))
    status = HSR_E_DIFFERENCE;
  free(o);
  return status;
}
