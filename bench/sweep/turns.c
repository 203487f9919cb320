/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Timing in turn: every entrant is a process that draws when it is told to, and
 * only one draws at a time. So whatever disturbs the machine for a while
 * disturbs all alike. */
#include "config.h"

#include "bench/sweep/programs.h"
#include "bench/sweep/sweep.h"
#include "bench/results/figures.h"
#include "bench/run/terminate.h"
#include "bench/terminal/terminal.h"
#include "common/base/clock.h"
#include "common/files/json/json_read.h"

#include <errno.h>
#include <fcntl.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <jansson.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum { LINE = 1024 };

/* A process at the other end of two pipes. */
struct process {
  struct turn_taker *taker;
  pid_t id; /* 0: none */
  int in, out;
  bool starved; /* this program had no memory to parse its answer */
};

static bool is_alive(const struct process *process) {
  return process->id > 0 || process->taker->program;
}

/* --- One process ---------------------------------------------------------- */

/* Runs in the new process. */
static void become_worker(const struct plan *plan, const struct place *place,
                          const struct turn_taker *taker, int in, int out) {
  const struct entrant *entrant = taker->entrant;
  char view[RESULTS_VIEW], size[32], threads[24];
  results_view_name(place->view, place->walk, view);
  snprintf(size, sizeof size, "%dx%d", place->m, place->n);
  snprintf(threads, sizeof threads, "%ld", entrant->threads);
  if (plan->options->memory_mb) {
    rlim_t most = (rlim_t)plan->options->memory_mb << 20;
    setrlimit(RLIMIT_DATA, &(struct rlimit){most, most});
  }
  bool good = dup2(in, STDIN_FILENO) >= 0 && dup2(out, STDOUT_FILENO) >= 0;
  close(in); /* frees its number: there may be none left for another file */
  int nowhere = good ? open("/dev/null", O_WRONLY) : -1;
  if (nowhere < 0 || dup2(nowhere, STDERR_FILENO) < 0)
    _exit(HSR_E_INTERNAL);
  close(nowhere);
  execl("/proc/self/exe", "hsr", "worker", entrant->name, place->scene, view,
        size, threads, (char *)NULL);
  _exit(HSR_E_INTERNAL);
}

static bool open_process(struct process *process, const struct plan *plan,
                         const struct place *place) {
  int in[2] = {-1, -1}, out[2] = {-1, -1};
  if (pipe2(in, O_CLOEXEC) || pipe2(out, O_CLOEXEC)) {
    int why = errno;
    if (in[0] >= 0)
      close(in[0]), close(in[1]);
    errno = why;
    return false;
  }
  fflush(NULL);
  pid_t parent = getpid();
  process->id = fork();
  if (process->id == 0) {
    end_with_parent(parent);
    become_worker(plan, place, process->taker, in[0], out[1]);
  }
  int why = errno;
  close(in[0]);
  close(out[1]);
  process->in = in[1];
  process->out = out[0];
  if (process->id > 0)
    return true;
  close(process->in);
  close(process->out);
  errno = why;
  return false;
}

/* Waits until there is more of its output to read, or its output has ended.
 * False if neither happens before hsr_seconds_now() reaches `end`, or before an
 * interrupt. */
static bool is_ready(const struct process *process, double end) {
  for (;;) {
    double left = interrupt_came() ? 0 : end - hsr_seconds_now();
    struct pollfd ready = {.fd = process->out, .events = POLLIN};
    int n = left > 0 ? poll(&ready, 1, (int)(left * 1e3) + 1) : 0;
    if (n >= 0 || errno != EINTR)
      return n > 0;
  }
}

/* Waits until the process has closed its output: it does so when it ends. */
static bool ends_in_time(const struct process *process, double seconds) {
  char rest[LINE];
  double end = hsr_seconds_now() + seconds;
  while (is_ready(process, end))
    if (read(process->out, rest, sizeof rest) <= 0)
      return true;
  return false;
}

/* Ends the process by ending its input. Kills it if that takes longer than
 * `seconds`. */
static void close_process(struct process *process, double seconds) {
  struct turn_taker *taker = process->taker;
  close(process->in);
  if (!ends_in_time(process, seconds)) {
    taker->verdict = TIMEOUT;
    kill(process->id, SIGKILL);
  }
  close(process->out);
  int end = 0;
  while (waitpid(process->id, &end, 0) < 0 && errno == EINTR) {
  }
  process->id = 0;
  if (taker->verdict == RIGHT && end)
    taker->verdict = CRASH;
  if (WIFEXITED(end))
    taker->failure = (enum hsr_status)WEXITSTATUS(end);
}

/* The process has failed. It is killed if it does not end soon. */
static void give_up(struct process *process, enum verdict verdict) {
  process->taker->verdict = verdict;
  close_process(process, verdict == TIMEOUT ? 0 : 10);
}

/* The next line of its output, as JSON. If none comes in time, the process is
 * given up, and the answer is NULL. */
static json_t *read_answer(struct process *process, double seconds) {
  char line[LINE];
  size_t length = 0;
  double end = hsr_seconds_now() + seconds;
  while (length < sizeof line) {
    if (!is_ready(process, end)) {
      give_up(process, TIMEOUT);
      return NULL;
    }
    ssize_t got = read(process->out, line + length, sizeof line - length);
    if (got <= 0)
      break;
    length += (size_t)got;
    if (line[length - 1] == '\n')
      break;
  }
  json_error_t error;
  json_t *answer =
      hsr_json_read_text(line, length, 0, &process->starved, &error);
  if (!answer)
    give_up(process, CRASH);
  return answer;
}

static double real_of(const json_t *answer, const char *name) {
  const json_t *value = json_object_get(answer, name);
  return json_is_number(value) ? json_number_value(value) : -1;
}

/* Sends a byte and returns the answer, or NULL. */
static json_t *ask(struct process *process, char byte, double seconds) {
  if (write(process->in, &byte, 1) == 1)
    return read_answer(process, seconds);
  give_up(process, CRASH);
  return NULL;
}

/* --- One start of all ----------------------------------------------------- */

/* Seconds that a round may take. */
static double patience(const struct plan *plan) {
  return (double)plan->options->timeout * (double)plan->options->walk;
}

/* Starts a process. False if there can be no more processes, which is no
 * failure of the taker. */
static bool begin(struct process *process, const struct plan *plan,
                  const struct place *place, int start) {
  if (process->taker->job)
    return program_turn_begin(plan, process->taker, start);
  if (!open_process(process, plan, place))
    return false;
  /* Import, adapt, prepare and a few rounds: each may take a full timeout. */
  json_t *ready = read_answer(process, 6 * patience(plan));
  if (!ready)
    return true;
  struct start *into = &process->taker->starts[start];
  into->import_seconds = real_of(ready, "import");
  into->adapt_seconds = real_of(ready, "adapt");
  into->prepare_seconds = real_of(ready, "prepare");
  into->before_kb = (long)real_of(ready, "before_kb");
  into->inner = (long)real_of(ready, "inner");
  into->shade_seconds = into->write_seconds = -1;
  into->repetitions = plan->options->repetitions;
  json_decref(ready);
  return true;
}

static void draw(struct process *process, const struct plan *plan, int start,
                 int round, const struct turn_listener *listener) {
  if (process->taker->job) {
    program_turn_draw(plan, process->taker, listener, start, round);
    return;
  }
  json_t *answer = ask(process, 'r', 2 * patience(plan) + 10);
  if (answer)
    process->taker->starts[start].seconds[round] = real_of(answer, "seconds");
  json_decref(answer);
}

/* Asks what remains to be asked after the rounds. */
static void finish(struct process *process, const struct plan *plan,
                   int start) {
  if (process->taker->job) {
    program_turn_finish(plan, process->taker, start);
    return;
  }
  struct start *into = &process->taker->starts[start];
  json_t *memory = ask(process, 'm', 10);
  if (memory)
    into->peak_kb = (long)real_of(memory, "peak_kb");
  json_decref(memory);
  if (start == 0 && process->id > 0) {
    json_t *picture = ask(process, 'w', 6 * (double)plan->options->timeout);
    into->shade_seconds = real_of(picture, "shade");
    into->write_seconds = real_of(picture, "write");
    json_decref(picture);
  }
  if (process->id > 0)
    close_process(process, 2 * (double)plan->options->timeout + 10);
}

static void end_all(struct process *process, int n) {
  for (int k = 0; k < n; k++)
    if (process[k].taker->program)
      program_turn_kill(process[k].taker);
    else if (process[k].id > 0)
      close_process(&process[k], 0);
}

/* Asks the rest of a lot whose rounds are over. */
static enum hsr_status finish_lot(const struct plan *plan,
                                  struct process *process, int n, int start,
                                  const struct turn_listener *listener,
                                  struct hsr_error *err) {
  for (int k = 0; k < n; k++)
    if (is_alive(&process[k]))
      finish(&process[k], plan, start);
  for (int k = 0; k < n; k++)
    if (process[k].starved)
      return hsr_fail_nomem(err);
  for (int k = 0; k < n; k++) {
    struct turn_taker *taker = process[k].taker;
    taker->has[start] = taker->verdict == RIGHT;
    if (taker->has[start] && !listener->timed(listener->data, taker, start))
      return hsr_fail(err, HSR_E_INPUT, "the journal cannot be written: %s",
                      strerror(errno));
  }
  return HSR_OK;
}

static void tell(struct progress *progress, const struct plan *plan,
                 const struct turn_listener *listener,
                 const struct turn_taker *taker, int start) {
  char text[PROGRESS_TEXT];
  snprintf(text, sizeof text, "%.150s", listener->name);
  if (taker)
    progress_add(text, taker->entrant->name);
  progress_close(text);
  progress_tell(progress, (size_t)start,
                isfinite(listener->end) ? 0 : (size_t)plan->options->starts,
                "starts timed", text);
}

static enum hsr_status
run_lot(const struct plan *plan, const struct place *place,
        struct process *process, int n, int start, const gsl_rng *random,
        const struct turn_listener *listener, struct progress *progress,
        struct hsr_error *err) {
  for (int k = 0; k < n; k++)
    if (!begin(&process[k], plan, place, start)) {
      hsr_fail(err, HSR_E_NOMEM, "bench: %d processes at a time: %s", n,
               strerror(errno));
      end_all(process, k);
      return HSR_E_NOMEM;
    }
  for (int round = 0; round < plan->options->repetitions && !interrupt_came();
       round++) {
    int order[SWEEP_MOST_ENTRANTS];
    for (int k = 0; k < n; k++)
      order[k] = k;
    gsl_ran_shuffle(random, order, (size_t)n, sizeof *order);
    for (int k = 0; k < n; k++)
      if (is_alive(&process[order[k]])) {
        tell(progress, plan, listener, process[order[k]].taker, start);
        draw(&process[order[k]], plan, start, round, listener);
      }
  }
  if (interrupt_came()) {
    end_all(process, n);
    return interrupt_fail(err);
  }
  return finish_lot(plan, process, n, start, listener, err);
}

/* --- All starts ----------------------------------------------------------- */

/* Takes as many takers that have not failed, from *next on, as fit into memory
 * together; at least one, if any is left. */
static int fill_lot(struct turn_taker *taker, const int *order, int n,
                    int start, int *next, struct process *lot) {
  double room = .6 * (double)sysconf(_SC_PHYS_PAGES) *
                (double)sysconf(_SC_PAGESIZE) / 1024;
  int size = 0;
  for (; *next < n; ++*next) {
    struct turn_taker *t = &taker[order[*next]];
    if (t->verdict != RIGHT || t->has[start])
      continue;
    if (size && (double)t->need_kb > room)
      break;
    room -= (double)t->need_kb;
    lot[size++] = (struct process){.taker = t};
  }
  return size;
}

static enum hsr_status
run_start(const struct plan *plan, const struct place *place,
          struct turn_taker *taker, int n, int start, const gsl_rng *random,
          const struct turn_listener *listener, struct progress *progress,
          struct hsr_error *err) {
  struct process lot[SWEEP_MOST_ENTRANTS];
  int order[SWEEP_MOST_ENTRANTS], next = 0, size;
  for (int k = 0; k < n; k++)
    order[k] = k;
  gsl_ran_shuffle(random, order, (size_t)n, sizeof *order);
  enum hsr_status status = HSR_OK;
  while (!status && (size = fill_lot(taker, order, n, start, &next, lot)) > 0)
    status =
        run_lot(plan, place, lot, size, start, random, listener, progress, err);
  return status;
}

/* Whether the median of a taker's first n starts is known to 2 %. *good becomes
 * false for lack of memory. */
static bool is_well_known(const struct turn_taker *taker, int n, bool *good) {
  int each = (int)taker->starts[0].repetitions;
  double *seconds = malloc((size_t)(n * each) * sizeof *seconds);
  struct samples samples = {seconds, n, each};
  struct figure median = {0};
  for (int s = 0; s < n && seconds; s++)
    memcpy(seconds + s * each, taker->starts[s].seconds,
           (size_t)each * sizeof *seconds);
  *good = seconds && figure_median(&samples, &median);
  free(seconds);
  return *good && median.high - median.low <= 2 * .02 * median.value;
}

/* Whether the first n starts are enough. */
static bool is_enough(const struct turn_taker *taker, int n_takers, int n,
                      bool *good) {
  for (int k = 0; k < n_takers; k++)
    if (taker[k].verdict == RIGHT && !is_well_known(&taker[k], n, good))
      return false;
  return true;
}

enum hsr_status take_turns(const struct plan *plan, const struct place *place,
                           struct turn_taker *taker, int n, uint64_t seed,
                           const struct turn_listener *listener,
                           struct hsr_error *err) {
  gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
  if (!random)
    return hsr_fail_nomem(err);
  gsl_rng_set(random, (unsigned long)seed);
  struct sigaction ignore = {.sa_handler = SIG_IGN}, before;
  sigaction(SIGPIPE, &ignore, &before); /* a write to an ended process fails */
  enum hsr_status status = HSR_OK;
  struct progress progress = progress_begin(stderr);
  int start = 0, all = (int)plan->options->starts;
  for (bool enough = false; start < all && !enough && !status; start++) {
    tell(&progress, plan, listener, NULL, start);
    status = run_start(plan, place, taker, n, start, random, listener,
                       &progress, err);
    bool good = true;
    if (!status && start > 0 && isfinite(listener->end))
      enough = hsr_seconds_now() > listener->end ||
               (start + 1 >= SWEEP_BUDGET_STARTS &&
                is_enough(taker, n, start + 1, &good));
    if (!good)
      status = hsr_fail_nomem(err);
  }
  for (int k = 0; k < n; k++)
    taker[k].n_starts = start;
  progress_end(&progress);
  sigaction(SIGPIPE, &before, NULL);
  gsl_rng_free(random);
  return status;
}
