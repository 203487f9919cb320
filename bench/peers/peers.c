/* SPDX-License-Identifier: GPL-3.0-or-later */
/* peers: one picture by zbuffer and by other people's renderers, timed in turn.
 *
 * Every round lets every renderer draw, in an order shuffled anew. A turn is
 * two frames: the first brings the caches back, the second is timed. Times are
 * of the processor, over all threads, so that neither other work on the machine
 * nor more than one thread can blur the comparison; the clock on the wall
 * stands beside them. */
#include "config.h"

#include "bench/peers/peers.h"

#include "algorithms/algorithm.h"
#include "scenes/scenes.h"

#include <argp.h>
#include <errno.h>
#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const struct peer *const peers[] = {
    &peer_zbuffer,          &peer_zbuffer_inexact,
#if HSR_HAVE_OSMESA
    &peer_llvmpipe_indexed, &peer_llvmpipe_arrays,
#endif
#if HSR_HAVE_EMBREE
    &peer_embree,
#endif
    &peer_memset,           &peer_null,
};

enum {
  N_PEERS = sizeof peers / sizeof *peers,
  ZBUFFER = 0,
  WARM_FRAMES = 3,
  JUDGED_SAMPLES = 512 * 512, /* the oracle is slow */
  MOST_ROUNDS = 100000
};

/* --- Options ---------------------------------------------------------------
 */

struct options {
  const char *scene;
  long view, m, n, rounds, seed;
  struct hsr_error *err;
};

static bool parse_number(const char *text, long least, long most,
                         const char **end, long *number) {
  char *after;
  errno = 0;
  *number = strtol(text, &after, 10);
  *end = after;
  return after != text && !errno && *number >= least && *number <= most;
}

static bool parse_whole(const char *text, long least, long most, long *number) {
  const char *end;
  return parse_number(text, least, most, &end, number) && !*end;
}

static bool parse_size(const char *text, struct options *o) {
  const char *end;
  return parse_number(text, 1, HSR_MAX_SIZE, &end, &o->m) && *end == 'x' &&
         parse_whole(end + 1, 1, HSR_MAX_SIZE, &o->n);
}

static error_t parse(int key, char *arg, struct argp_state *state) {
  struct options *o = state->input;
  bool good = true;
  switch (key) {
  case '?': /* argp's own --help is off together with its errors */
    argp_help(state->root_argp, stdout, ARGP_HELP_STD_HELP, state->name);
    exit(0);
  case 'v':
    good = parse_whole(arg, 1, 1000000, &o->view);
    break;
  case 's':
    good = parse_size(arg, o);
    break;
  case 'r':
    good = parse_whole(arg, 1, MOST_ROUNDS, &o->rounds);
    break;
  case 'S':
    good = parse_whole(arg, 0, INT32_MAX, &o->seed);
    break;
  case ARGP_KEY_ARG:
    good = !o->scene;
    o->scene = arg;
    break;
  case ARGP_KEY_END:
    if (o->scene)
      return 0;
    hsr_fail(o->err, HSR_E_USAGE, "which scene? (see peers --help)");
    return EINVAL;
  default:
    return ARGP_ERR_UNKNOWN;
  }
  if (good)
    return 0;
  hsr_fail(o->err, HSR_E_USAGE, "'%.100s' cannot be used (see peers --help)",
           arg);
  return EINVAL;
}

static const struct argp_option argp_options[] = {
    {"view", 'v', "K", 0, "look from the scene's view K (standard: 1)", 0},
    {"size", 's', "MxN", 0, "samples a row x rows (standard: 512x512)", 0},
    {"rounds", 'r', "N", 0, "timed frames a renderer (standard: 15)", 0},
    {"seed", 'S', "N", 0, "of the order of turns (standard: 1)", 0},
    {"help", '?', NULL, 0, "print this and end", 0},
    {0}};

static const struct argp argp = {
    argp_options,
    parse,
    "SCENE",
    "Draws SCENE, made of triangles, with zbuffer and with other renderers in "
    "turn, on one thread each, and prints their times.",
    NULL,
    NULL,
    NULL};

static enum hsr_status parse_options(int argc, char **argv, struct options *o) {
  int at = 1;
  hsr_fail(o->err, HSR_E_USAGE,
           "an option is unknown or lacks its value (see peers --help)");
  error_t failed =
      argp_parse(&argp, argc, argv, ARGP_NO_ERRS | ARGP_NO_HELP, &at, o);
  return failed ? HSR_E_USAGE : HSR_OK;
}

/* --- Timing ----------------------------------------------------------------
 */

struct times {
  double *cpu, *wall; /* ms, a round */
};

struct run {
  const struct options *options;
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_view view;
  uint32_t *ids;
  void *state[N_PEERS];
  struct times times[N_PEERS];
  long wrong[N_PEERS]; /* samples; -1: not judged */
};

static double ms_now(clockid_t clock) {
  struct timespec t;
  clock_gettime(clock, &t);
  return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static enum hsr_status draw(struct run *run, int k, struct hsr_error *err) {
  return peers[k]->draw(run->state[k], &run->view, err);
}

static enum hsr_status take_turn(struct run *run, int k, long round,
                                 struct hsr_error *err) {
  enum hsr_status status = draw(run, k, err);
  if (status)
    return status;
  double wall = ms_now(CLOCK_MONOTONIC);
  double cpu = ms_now(CLOCK_PROCESS_CPUTIME_ID);
  status = draw(run, k, err);
  run->times[k].cpu[round] = ms_now(CLOCK_PROCESS_CPUTIME_ID) - cpu;
  run->times[k].wall[round] = ms_now(CLOCK_MONOTONIC) - wall;
  return status;
}

/* SplitMix64: G. L. Steele Jr., D. Lea and C. H. Flood, "Fast Splittable
 * Pseudorandom Number Generators", OOPSLA 2014. */
static uint64_t next_random(uint64_t *state) {
  uint64_t z = *state += 0x9e3779b97f4a7c15u;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  return z ^ z >> 31;
}

static void shuffle(int *order, uint64_t *random) {
  for (int k = N_PEERS - 1; k > 0; k--) {
    int other = (int)(next_random(random) % (uint64_t)(k + 1));
    int held = order[k];
    order[k] = order[other];
    order[other] = held;
  }
}

static enum hsr_status time_all(struct run *run, struct hsr_error *err) {
  int order[N_PEERS];
  for (int k = 0; k < N_PEERS; k++)
    order[k] = k;
  uint64_t random = (uint64_t)run->options->seed;
  enum hsr_status status = HSR_OK;
  for (long round = 0; round < run->options->rounds; round++) {
    shuffle(order, &random);
    for (int k = 0; k < N_PEERS && !status; k++)
      status = take_turn(run, order[k], round, err);
  }
  return status;
}

/* --- Judging ---------------------------------------------------------------
 */

static enum hsr_status ask_oracle(struct run *run, uint32_t *right,
                                  struct hsr_error *err) {
  const struct hsr_algorithm *oracle = hsr_algorithm_find("oracle")->plain;
  void *prepared = NULL;
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  struct hsr_tally tally = {.work = NULL};
  struct hsr_job job = {.world = &run->world,
                        .view = &run->view,
                        .scratch = &scratch,
                        .tally = &tally,
                        .ids = right,
                        .ids_stride = (size_t)run->view.m};
  enum hsr_status status =
      oracle->prepare ? oracle->prepare(&run->world, &prepared, err) : HSR_OK;
  job.prepared = prepared;
  if (!status)
    status = oracle->render(&job, err);
  if (!status && tally.out_of_memory)
    status = hsr_fail_nomem(err);
  if (oracle->release)
    oracle->release(prepared);
  hsr_arena_free(&scratch);
  return status;
}

/* The first frames of every renderer, and how many samples are wrong. */
static enum hsr_status warm_up(struct run *run, const uint32_t *right,
                               struct hsr_error *err) {
  size_t n = (size_t)run->view.m * (size_t)run->view.n;
  for (int k = 0; k < N_PEERS; k++) {
    /* What is not drawn shall not look like the last one's picture. */
    memset(run->ids, 0xee, n * sizeof *run->ids);
    for (int frame = 0; frame < WARM_FRAMES; frame++) {
      enum hsr_status status = draw(run, k, err);
      if (status)
        return status;
    }
    run->wrong[k] = -1;
    if (!right || !peers[k]->draws)
      continue;
    run->wrong[k] = 0;
    for (size_t s = 0; s < n; s++)
      run->wrong[k] += run->ids[s] != right[s];
  }
  return HSR_OK;
}

static enum hsr_status judge(struct run *run, struct hsr_error *err) {
  size_t n = (size_t)run->view.m * (size_t)run->view.n;
  if (n > JUDGED_SAMPLES)
    return warm_up(run, NULL, err);
  uint32_t *right = malloc(n * sizeof *right);
  if (!right)
    return hsr_fail_nomem(err);
  enum hsr_status status = ask_oracle(run, right, err);
  if (!status)
    status = warm_up(run, right, err);
  free(right);
  return status;
}

/* --- The table -------------------------------------------------------------
 */

static int compare(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static double median(const double *sorted, long n) {
  return (sorted[(n - 1) / 2] + sorted[n / 2]) / 2;
}

static void print_table(struct run *run) {
  const struct options *o = run->options;
  printf("%s, view %ld, %ld x %ld samples, %u triangles, %ld rounds, seed "
         "%ld\n\n",
         o->scene, o->view, o->m, o->n, run->world.n_faces, o->rounds, o->seed);
  printf("%-16s %10s %10s %10s %10s %8s\n", "renderer", "min ms", "median ms",
         "wall ms", "zbuffer's", "wrong");
  for (int k = 0; k < N_PEERS; k++) {
    qsort(run->times[k].cpu, (size_t)o->rounds, sizeof(double), compare);
    qsort(run->times[k].wall, (size_t)o->rounds, sizeof(double), compare);
  }
  double ours = median(run->times[ZBUFFER].cpu, o->rounds);
  for (int k = 0; k < N_PEERS; k++) {
    double typical = median(run->times[k].cpu, o->rounds);
    printf("%-16s %10.3f %10.3f %10.3f %10.3f ", peers[k]->name,
           run->times[k].cpu[0], typical, median(run->times[k].wall, o->rounds),
           ours / typical);
    if (run->wrong[k] < 0)
      printf("%8s\n", "-");
    else
      printf("%8ld\n", run->wrong[k]);
  }
  puts("\nmin, median: of processor time; wall: median of the time passed; "
       "zbuffer's: its\nmedian / this one's; wrong: samples that differ from "
       "the oracle's");
}

/* --- The run ---------------------------------------------------------------
 */

static enum hsr_status open_world(struct run *run, struct hsr_error *err) {
  const struct options *o = run->options;
  struct hsr_import import = {.drop_degenerate = false};
  enum hsr_status status = hsr_scene_open(o->scene, &import, &run->scene, err);
  if (status)
    return status;
  if (o->view > (long)run->scene->n_views)
    return hsr_fail(err, HSR_E_USAGE, "%s has %u views; there is no view %ld",
                    o->scene, run->scene->n_views, o->view);
  status = hsr_view_init(&run->view, &run->scene->views[o->view - 1], (int)o->m,
                         (int)o->n, err);
  if (!status)
    status = hsr_world_init(&run->world, run->scene, err);
  if (!status && !run->world.all_triangles)
    status = hsr_fail(err, HSR_E_INPUT,
                      "%s has faces of more than three corners, which the "
                      "other renderers do not draw",
                      o->scene);
  return status;
}

static enum hsr_status set_up(struct run *run, struct hsr_error *err) {
  size_t n = (size_t)run->view.m * (size_t)run->view.n;
  run->ids = malloc(n * sizeof *run->ids);
  if (!run->ids)
    return hsr_fail_nomem(err);
  for (int k = 0; k < N_PEERS; k++) {
    run->times[k].cpu = calloc((size_t)run->options->rounds, sizeof(double));
    run->times[k].wall = calloc((size_t)run->options->rounds, sizeof(double));
    if (!run->times[k].cpu || !run->times[k].wall)
      return hsr_fail_nomem(err);
    enum hsr_status status =
        peers[k]->setup(peers[k], &run->world, run->view.m, run->view.n,
                        run->ids, &run->state[k], err);
    if (status)
      return status;
  }
  return HSR_OK;
}

static void clean_up(struct run *run) {
  for (int k = 0; k < N_PEERS; k++) {
    peers[k]->release(run->state[k]);
    free(run->times[k].cpu);
    free(run->times[k].wall);
  }
  free(run->ids);
  hsr_world_free(&run->world);
  hsr_scene_delete(run->scene);
}

static enum hsr_status run_all(const struct options *options,
                               struct hsr_error *err) {
  struct run run = {.options = options};
  enum hsr_status status = open_world(&run, err);
  if (!status)
    status = set_up(&run, err);
  if (!status)
    status = judge(&run, err);
  if (!status)
    status = time_all(&run, err);
  if (!status)
    print_table(&run);
  clean_up(&run);
  return status;
}

/* Memory once taken stays with the process: else page faults are nearly half of
 * the time of llvmpipe, which allocates in every frame. */
static void keep_memory(void) {
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, INT32_MAX);
}

int main(int argc, char **argv) {
  keep_memory();
  struct hsr_error err = {.text = "unexplained failure"};
  struct options options = {
      .view = 1, .m = 512, .n = 512, .rounds = 15, .seed = 1, .err = &err};
  enum hsr_status status = parse_options(argc, argv, &options);
  if (!status)
    status = run_all(&options, &err);
  if (status)
    fprintf(stderr, "peers: %s\n", err.text);
  return (int)status;
}
