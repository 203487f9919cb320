/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How hsr check judges: first the oracle draws, then each algorithm of its
 * kind, in a process of its own, so that one that crashes or takes too long
 * harms nothing. Both builds of an algorithm are judged, the counting one too.
 */
#include "bench/judge.h"
#include "bench/terminate.h"

#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

const char *verdict_name(enum verdict verdict) {
  static const char *const name[] = {
      [PENDING] = "crash",   [RIGHT] = "ok",        [WRONG] = "wrong",
      [REFUSED] = "refused", [TIMEOUT] = "timeout", [CRASH] = "crash"};
  return name[verdict];
}

void *shared_memory(size_t size) {
  void *memory = mmap(NULL, size, PROT_READ | PROT_WRITE,
                      MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  return memory == MAP_FAILED ? NULL : memory;
}

const struct hsr_algorithm *oracle_of(enum hsr_kind kind) {
  for (const struct hsr_listed *a = hsr_algorithms; a->plain; a++)
    if (a->plain->kind == kind && a->plain->flags & HSR_JUDGE)
      return a->plain;
  return NULL;
}

static void compare_ids(const struct group *g, const uint32_t *got,
                        const uint32_t *wanted, struct cell *cell) {
  size_t m = (size_t)g->view.m, n = m * (size_t)g->view.n;
  cell->compared = n;
  for (size_t k = 0; k < n; k++)
    if (got[k] != wanted[k] && !cell->mismatches++) {
      cell->first.i = (int)(k % m);
      cell->first.j = (int)(k / m);
      cell->first.got = got[k];
      cell->first.wanted = wanted[k];
    }
}

static void compare_drawings(const struct hsr_drawing *got,
                             const struct hsr_drawing *wanted,
                             bool visible_only, struct cell *cell) {
  struct hsr_drawing_difference difference;
  hsr_drawing_compare(got, wanted, visible_only, &difference);
  if (!cell->mismatches)
    cell->first.edge = difference.first;
  cell->compared = difference.edges;
  cell->mismatches += difference.differing;
}

static void compare(const struct group *g, const struct hsr_algorithm *a,
                    const struct answer *got, const struct answer *wanted,
                    struct cell *cell) {
  if (g->kind == HSR_SEGMENTS)
    compare_drawings(&got->drawing, &wanted->drawing,
                     a->flags & HSR_VISIBLE_ONLY, cell);
  else
    compare_ids(g, got->ids, wanted->ids, cell);
}

/* Sets the algorithm up and draws. A value that no picture holds shows what was
 * not written. The answer is to be freed also after a failure. */
static enum hsr_status draw(const struct group *g,
                            const struct hsr_algorithm *a,
                            const struct hsr_choice *choice, long threads,
                            struct hsr_setup *setup, struct answer *answer,
                            struct hsr_tally *tally, struct hsr_error *err) {
  *tally = (struct hsr_tally){.out_of_memory = false};
  enum hsr_status status = answer_init(answer, a, &g->view, err);
  if (status)
    return status;
  if (answer->ids)
    memset(answer->ids, 0xfe,
           (size_t)g->view.m * (size_t)g->view.n * sizeof *answer->ids);
  status = hsr_setup_init(setup, a, choice, g->world, err);
  if (!status)
    status = render_view(setup, &g->view, threads, answer, tally, NULL, err);
  hsr_setup_free(setup);
  return status;
}

/* In a process of its own. */
static enum hsr_status judge(const struct group *g,
                             const struct hsr_algorithm *a,
                             const struct hsr_choice *choice, long threads,
                             const struct answer *wanted, struct cell *cell) {
  struct hsr_error err;
  struct hsr_setup setup = {.n_adaptations = 0};
  struct hsr_tally tally;
  struct answer got;
  enum hsr_status status =
      draw(g, a, choice, threads, &setup, &got, &tally, &err);
  cell->n_adaptations = setup.n_adaptations;
  for (int k = 0; k < setup.n_adaptations; k++)
    cell->adapted[k] = setup.adaptation[k].name; /* lasts: it is a constant */
  if (status == HSR_E_REFUSED)
    snprintf(cell->refusal, sizeof cell->refusal, "refused by %s: %s", a->name,
             err.text);
  if (!status && !(a->flags & HSR_NO_PICTURE))
    compare(g, a, &got, wanted, cell);
  memcpy(cell->count, tally.count, sizeof cell->count);
  if (g->kind == HSR_IDS) { /* at samples; told by the counting build */
    cell->depths_compared = tally.depths_compared;
    cell->depths_exact = tally.exact[HSR_ASK_DEPTH];
  }
  answer_free(&got);
  return status;
}

/* Is more to be done than the time that a picture may take lets one do? */
static bool is_too_much(const struct group *g, const struct hsr_algorithm *a) {
  return a->expense &&
         a->expense(g->world, &g->view) > 5e8 * (double)g->timeout;
}

/* Of this process. */
static void limit_process(const struct group *g) {
  if (!g->memory_mb)
    return;
  struct rlimit limit = {.rlim_cur = (rlim_t)g->memory_mb << 20,
                         .rlim_max = (rlim_t)g->memory_mb << 20};
  setrlimit(RLIMIT_DATA, &limit);
}

/* Runs the algorithm in a new process and waits for it. */
static void judge_apart(const struct group *g, int number,
                        const struct answer *wanted) {
  const struct hsr_listed *listed = g->algorithm[number].listed;
  const struct hsr_choice *choice = &g->algorithm[number].choice;
  struct cell *cell = &g->cells[number];
  if (is_too_much(g, listed->plain)) {
    cell->verdict = REFUSED;
    snprintf(cell->refusal, sizeof cell->refusal,
             "refused: %s would take more than %ld s", listed->plain->name,
             g->timeout);
    return;
  }
  fflush(NULL);
  pid_t parent = getpid(), child = fork();
  if (child == 0) {
    end_with_parent(parent);
    limit_process(g);
    alarm((unsigned)g->timeout);
    enum hsr_status status =
        judge(g, listed->plain, choice, g->threads ? g->threads[number] : 1,
              wanted, cell);
    alarm((unsigned)g->timeout);
    if (!status)
      status = judge(g, listed->counting, choice, 1, wanted, cell);
    alarm(0);
    end_process((int)status);
  }
  int end = 0;
  struct rusage usage = {.ru_maxrss = 0};
  pid_t ended = child < 0 ? -1 : wait4(child, &end, 0, &usage);
  cell->peak_kb = usage.ru_maxrss;
  if (ended < 0) {
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

/* The verdict of all cells of the group, for the oracle's sake. */
static void set_all(const struct group *g, enum verdict verdict,
                    const char *oracle) {
  for (int a = 0; a < g->n_algorithms; a++) {
    const struct hsr_algorithm *algorithm = g->algorithm[a].listed->plain;
    struct cell *cell = &g->cells[a];
    if (algorithm->kind != g->kind)
      continue;
    cell->verdict = verdict;
    cell->refusal[0] = '\0';
    if (verdict == REFUSED)
      snprintf(cell->refusal, sizeof cell->refusal,
               "refused, %s cannot be judged: %s takes more than %ld s",
               algorithm->name, oracle, g->timeout);
  }
}

enum hsr_status judge_group(const struct group *g) {
  const struct hsr_algorithm *oracle = oracle_of(g->kind);
  bool limited = g->kind == HSR_SEGMENTS;
  if (limited) {
    set_all(g, REFUSED, oracle->name);
    if (is_too_much(g, oracle))
      return HSR_OK;
    alarm((unsigned)g->timeout);
  }
  struct hsr_error err;
  struct hsr_setup setup;
  struct hsr_tally tally;
  struct answer wanted;
  enum hsr_status status =
      draw(g, oracle, NULL, 1, &setup, &wanted, &tally, &err);
  if (limited) {
    alarm(0);
    set_all(g, PENDING, oracle->name);
  }
  if (!status && g->picture && wanted.ids)
    memcpy(g->picture, wanted.ids,
           (size_t)g->view.m * (size_t)g->view.n * sizeof *wanted.ids);
  for (int a = 0; a < g->n_algorithms && !status; a++)
    if (g->algorithm[a].listed->plain->kind == g->kind)
      judge_apart(g, a, &wanted);
  answer_free(&wanted);
  return status;
}
