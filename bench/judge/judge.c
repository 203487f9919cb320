/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How hsr check judges: first the oracle draws, then each algorithm of like
 * output, in a process of its own, so that one that crashes or takes too long
 * harms nothing. Both builds of an algorithm are judged, the counting one too. */
#include "bench/judge/judge.h"
#include "bench/modules/variant.h"
#include "bench/judge/differences.h"
#include "bench/judge/wanted.h"
#include "bench/run/crew.h"
#include "bench/run/terminate.h"
#include "common/scene/motion.h"

#include <errno.h>
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

/* Who is judged: one of the two builds of an algorithm of the group. */
struct player {
  int number;
  const struct hsr_algorithm *algorithm;
  bool counts;
  long threads;
};

static bool is_wrong(const struct cell *cell) {
  return cell->mismatches || cell->counting_mismatches;
}

/* --- Comparing ------------------------------------------------------------ */

/* Compares a picture of view k, and notes what differs. */
static enum hsr_status compare(const struct group *g,
                               const struct player *player, int k,
                               const struct hsr_answer *got,
                               const struct wanted *wanted, struct cell *cell,
                               struct hsr_error *err) {
  struct hsr_comparison comparison = {
      .view = &g->view[k],
      .got = got,
      .wanted = &wanted->answer,
      .place = wanted->sample,
      .n = wanted->n,
      .coarse =
          hsr_makes_how(player->algorithm, g->form.type) & HSR_VISIBLE_ONLY};
  struct hsr_difference difference = {.first = ""};
  g->form.type->compare(&comparison, &difference);
  if (!is_wrong(cell))
    memcpy(cell->first, difference.first, sizeof cell->first);
  cell->compared = difference.compared;
  *(player->counts ? &cell->counting_mismatches : &cell->mismatches) =
      difference.differing;
  if (!difference.differing || !g->differences)
    return HSR_OK;
  struct compared_files files = {.folder = g->differences,
                                 .world = g->world,
                                 .view = g->number[k] + 1,
                                 .algorithm = g->algorithm[player->number].name,
                                 .counts = player->counts};
  return write_difference(&files, &comparison, err);
}

/* --- Judging one algorithm ------------------------------------------------ */

static struct cell *cell_of(const struct group *g, int view, int number) {
  return &g->cells[view * g->n_algorithms + number];
}

/* The picture of one view, by an algorithm made ready. */
static enum hsr_status judge_view(const struct group *g,
                                  const struct player *player,
                                  const struct hsr_setup *setup, int k,
                                  const struct wanted *wanted,
                                  struct cell *cell, struct hsr_error *err) {
  struct hsr_tally tally = {.out_of_memory = false};
  struct hsr_answer got;
  enum hsr_status status = clean_answer(&got, setup, &g->view[k], err);
  if (!status)
    status = render_view(setup, &g->view[k], player->threads, &got, &tally,
                         NULL, err);
  if (!status && !(player->algorithm->flags & HSR_NO_PICTURE))
    status = compare(g, player, k, &got, wanted, cell, err);
  memcpy(cell->count, tally.count, sizeof cell->count);
  memcpy(cell->culled, tally.culled, sizeof cell->culled);
  if (g->form.type->by_places) { /* at samples; told by the counting build */
    cell->depths_compared = tally.depths_compared;
    cell->depths_exact = tally.exact[HSR_ASK_DEPTH];
  }
  cell->builds += !status;
  hsr_answer_free(&got);
  return status;
}

static void note_refusal(const struct group *g, int number, const char *why) {
  for (int k = 0; k < g->n_views; k++) {
    struct cell *cell = cell_of(g, k, number);
    snprintf(cell->refusal, sizeof cell->refusal, "refused by %s: %s",
             g->algorithm[number].listed->plain->name, why);
  }
}

/* What an algorithm says of its failure, which ends it. */
static void note_failure(const struct group *g, int number,
                         enum hsr_status status, const struct hsr_error *err) {
  if (status == HSR_E_REFUSED) {
    note_refusal(g, number, err->text);
    return;
  }
  for (int k = 0; status && k < g->n_views; k++) {
    struct cell *cell = cell_of(g, k, number);
    snprintf(cell->why, sizeof cell->why, "%s", err->text);
  }
}

static void note_adaptations(const struct group *g, int k, int number,
                             const struct hsr_setup *setup) {
  struct cell *cell = cell_of(g, k, number);
  cell->n_adaptations = setup->n_adaptations;
  for (int i = 0; i < setup->n_adaptations; i++)
    snprintf(cell->adapted[i], HSR_ADAPTER_NAME, "%s",
             setup->adaptation[i].name);
}

/* --- Frames --------------------------------------------------------------- */

/* Draws frame k of a walk, by an algorithm made ready for it. `world` is the
 * frame's. */
static enum hsr_status
judge_frame(const struct group *g, const struct player *player,
            const struct hsr_setup *setup, int k, const struct hsr_world *world,
            const struct wanted *wanted, struct hsr_error *err) {
  struct group here = *g;
  here.world = world;
  note_adaptations(g, k, player->number, setup);
  enum hsr_status status = judge_view(&here, player, setup, k, &wanted[k],
                                      cell_of(g, k, player->number), err);
  alarm((unsigned)g->timeout);
  return status;
}

/* By one prepared object, which follows what moves. */
static enum hsr_status follow_walk(const struct group *g,
                                   const struct player *player,
                                   const struct hsr_world *world,
                                   const struct wanted *wanted,
                                   struct hsr_error *err) {
  const struct walk *walk = g->walk;
  struct hsr_setup setup;
  enum hsr_status status =
      hsr_scene_follow(walk->follower, walk->frame[0], err);
  if (status)
    return HSR_E_INTERNAL; /* it can */
  status = hsr_setup_init(&setup, player->algorithm,
                          &g->algorithm[player->number].choice, world, err);
  for (int k = 0; k < g->n_views && !status; k++) {
    if (hsr_scene_follow(walk->follower, walk->frame[k], err))
      status = HSR_E_INTERNAL;
    else
      status = judge_frame(g, player, &setup, k, world, wanted, err);
  }
  hsr_setup_free(&setup);
  return status;
}

/* A frame that is laid out, or of a scene of its own. */
struct still {
  struct hsr_world world;
  struct hsr_setup setup; /* .algorithm is NULL at first */
};

/* Whether a frame may be laid out in the place of the last one. */
static bool may_follow(const struct still *still, const struct hsr_scene *last,
                       const struct hsr_scene *now) {
  return !hsr_is_roster(&still->world) && still->setup.flags & HSR_FOLLOWS &&
         hsr_scene_has_objects(last, now);
}

/* Goes on to frame k: keeps all if nothing moves, and makes all anew if the
 * algorithm does not follow. */
static enum hsr_status go_on(const struct group *g, const struct player *player,
                             int k, struct still *still,
                             struct hsr_error *err) {
  struct hsr_scene *now = g->walk->frame[k];
  const struct hsr_scene *last = k > 0 ? g->walk->frame[k - 1] : NULL;
  if (last && hsr_scene_is_same(last, now))
    return HSR_OK;
  bool kept = last && may_follow(still, last, now);
  if (!kept && still->setup.algorithm)
    hsr_setup_free(&still->setup);
  hsr_world_free(&still->world);
  if (!kept)
    *still = (struct still){.setup = {.algorithm = NULL}};
  enum hsr_status status =
      hsr_setup_world(&still->world, player->algorithm,
                      &g->algorithm[player->number].choice, now, err);
  if (status)
    return status;
  return kept ? hsr_setup_follow(&still->setup, &still->world, &kept, err)
              : hsr_setup_init(&still->setup, player->algorithm,
                               &g->algorithm[player->number].choice,
                               &still->world, err);
}

static enum hsr_status judge_frames(const struct group *g,
                                    const struct player *player,
                                    const struct wanted *wanted,
                                    struct hsr_error *err) {
  struct still still = {.setup = {.algorithm = NULL}};
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < g->n_views && !status; k++) {
    status = go_on(g, player, k, &still, err);
    if (!status)
      status =
          judge_frame(g, player, &still.setup, k, &still.world, wanted, err);
  }
  if (still.setup.algorithm)
    hsr_setup_free(&still.setup);
  hsr_world_free(&still.world);
  return status;
}

/* As hsr render draws frames: where the algorithm takes the scene as a roster,
 * from one prepared object. In a process of its own. */
static enum hsr_status judge_walk(const struct group *g,
                                  const struct player *player,
                                  const struct wanted *wanted) {
  struct hsr_error err = {.text = ""};
  struct hsr_world world = {.n_faces = 0};
  struct hsr_scene *follower = g->walk->follower;
  alarm((unsigned)g->timeout);
  enum hsr_status status =
      follower ? hsr_setup_world(&world, player->algorithm,
                                 &g->algorithm[player->number].choice, follower,
                                 &err)
               : HSR_OK;
  if (!status)
    status = follower && hsr_is_roster(&world)
                 ? follow_walk(g, player, &world, wanted, &err)
                 : judge_frames(g, player, wanted, &err);
  note_failure(g, player->number, status, &err);
  hsr_world_free(&world);
  alarm(0);
  return status;
}

/* --- Views ---------------------------------------------------------------- */

/* Makes the player ready. What the build before it had adapted is kept: both get
 * the same world. */
static enum hsr_status make_ready(const struct group *g,
                                  const struct player *player,
                                  struct hsr_setup *setup,
                                  struct hsr_error *err) {
  return setup->algorithm ? hsr_setup_rebuild(setup, player->algorithm, err)
                          : hsr_setup_init(setup, player->algorithm,
                                           &g->algorithm[player->number].choice,
                                           g->world, err);
}

/* All views, in order, by one prepared object. In a process of its own. *setup
 * is of the build before, or its algorithm is NULL. */
static enum hsr_status judge(const struct group *g, const struct player *player,
                             const struct wanted *wanted,
                             struct hsr_setup *setup) {
  int number = player->number;
  struct hsr_error err = {.text = ""};
  if (g->walk)
    return judge_walk(g, player, wanted);
  alarm((unsigned)g->timeout);
  enum hsr_status status = make_ready(g, player, setup, &err);
  for (int k = 0; k < g->n_views; k++)
    note_adaptations(g, k, number, setup);
  for (int k = 0; k < g->n_views && !status; k++) {
    status = judge_view(g, player, setup, k, &wanted[k], cell_of(g, k, number),
                        &err);
    alarm((unsigned)g->timeout);
  }
  note_failure(g, number, status, &err);
  alarm(0);
  return status;
}

/* Is more to be done than the time that a picture may take lets one do? What
 * takes no roster will refuse it. */
static bool is_too_much(const struct group *g, const struct hsr_algorithm *a) {
  if (!a->expense || (hsr_is_roster(g->world) && !(a->flags & HSR_INSTANCED)))
    return false;
  for (int k = 0; k < g->n_views; k++)
    if (hsr_form_pictures(&g->form, &g->view[k]) *
            a->expense(g->world, &g->view[k]) >
        5e8 * (double)g->timeout)
      return true;
  return false;
}

/* Of this process. */
static void limit_process(const struct group *g) {
  if (!g->memory_mb)
    return;
  struct rlimit limit = {.rlim_cur = (rlim_t)g->memory_mb << 20,
                         .rlim_max = (rlim_t)g->memory_mb << 20};
  setrlimit(RLIMIT_DATA, &limit);
}

/* The verdict of all views of an algorithm. */
static void set_verdict(const struct group *g, int number, enum verdict verdict,
                        const char *refusal) {
  for (int k = 0; k < g->n_views; k++) {
    struct cell *cell = cell_of(g, k, number);
    cell->verdict = verdict;
    snprintf(cell->refusal, sizeof cell->refusal, "%s", refusal);
  }
}

/* What the end of its process says of a picture that it did not complete. One
 * that has a limit of time of its own says itself that it was stopped. */
static enum verdict verdict_of_end(pid_t ended, int end) {
  if (ended < 0)
    return CRASH;
  if (WIFSIGNALED(end))
    return WTERMSIG(end) == SIGALRM ? TIMEOUT : CRASH;
  return WEXITSTATUS(end) == HSR_E_REFUSED   ? REFUSED
         : WEXITSTATUS(end) == HSR_E_STOPPED ? TIMEOUT
                                             : CRASH;
}

/* The process may have failed when all pictures were complete. */
static void set_verdicts(const struct group *g, int number, pid_t ended,
                         int end, long peak_kb) {
  bool failed = ended < 0 || !WIFEXITED(end) || WEXITSTATUS(end);
  for (int k = 0; k < g->n_views; k++) {
    struct cell *cell = cell_of(g, k, number);
    bool complete = cell->builds == 2 && !(failed && k == g->n_views - 1);
    cell->peak_kb = peak_kb;
    cell->verdict = !complete        ? verdict_of_end(ended, end)
                    : is_wrong(cell) ? WRONG
                                     : RIGHT;
    if (cell->verdict != CRASH)
      continue;
    cell->signal = ended > 0 && WIFSIGNALED(end) ? WTERMSIG(end) : 0;
    cell->failure = ended < 0        ? HSR_E_NOMEM
                    : WIFEXITED(end) ? (enum hsr_status)WEXITSTATUS(end)
                                     : HSR_OK;
  }
}

/* Tells other processes that the algorithm's cells are complete. */
static void set_done(const struct group *g, int number) {
  for (int k = 0; k < g->n_views; k++)
    __atomic_store_n(&cell_of(g, k, number)->done, true, __ATOMIC_RELEASE);
}

/* --- Processes ------------------------------------------------------------ */

static void take_turn(const struct group *g) {
  while (g->turns && sem_wait(g->turns) && errno == EINTR)
    ;
}

static void give_turn(const struct group *g) {
  if (g->turns)
    sem_post(g->turns);
}

/* The process that runs an algorithm. */
struct runner {
  pid_t process;
  int number;
};

/* Takes a turn for one more process. If n > 0 processes of the group work and no
 * turn is free, returns false. If none works, waits for a turn. */
static bool has_turn(const struct group *g, int n) {
  if (n && (!g->turns || sem_trywait(g->turns)))
    return false;
  if (!n)
    take_turn(g);
  return true;
}

/* Runs the algorithm in a new process, and returns that; -1: it cannot be made.
 * The new process frees its own copy of what is wanted. */
static pid_t start(const struct group *g, int number, struct wanted *wanted) {
  fflush(NULL);
  pid_t parent = getpid(), child = fork();
  if (child == 0) {
    end_with_parent(parent);
    limit_process(g);
    const struct hsr_listed *listed = g->algorithm[number].listed;
    struct player timed = {number, listed->plain, false,
                           g->threads ? g->threads[number] : 1};
    struct player counting = {number, listed->counting, true, 1};
    struct hsr_setup setup = {.algorithm = NULL};
    enum hsr_status status = judge(g, &timed, wanted, &setup);
    if (!status)
      status = judge(g, &counting, wanted, &setup);
    if (setup.algorithm)
      hsr_setup_free(&setup);
    free_wanted(g, wanted);
    end_process((int)status);
  }
  return child;
}

/* Waits for one of n processes to end, and notes what it did. Returns n - 1. */
static int wait_for_one(const struct group *g, struct runner *runner, int n) {
  int end = 0, k = 0;
  struct rusage usage = {.ru_maxrss = 0};
  pid_t ended;
  do
    ended = wait4(-1, &end, 0, &usage);
  while (ended < 0 && errno == EINTR);
  while (ended > 0 && k < n - 1 && runner[k].process != ended)
    k++;
  set_verdicts(g, runner[k].number, ended, end, usage.ru_maxrss);
  set_done(g, runner[k].number);
  give_turn(g);
  runner[k] = runner[n - 1];
  return n - 1;
}

static void note_expense(const struct group *g, int number) {
  char refusal[200];
  snprintf(refusal, sizeof refusal, "refused: %s would take more than %ld s",
           g->algorithm[number].listed->plain->name, g->timeout);
  set_verdict(g, number, REFUSED, refusal);
  set_done(g, number);
}

/* --- Judging a group ------------------------------------------------------ */

static bool is_judged(const struct group *g, int number) {
  const struct hsr_variant *v = &g->algorithm[number];
  const struct hsr_algorithm *a = v->listed->plain;
  return !(g->left_out && g->left_out[number]) &&
         hsr_same_form(&v->choice.form, &g->form) &&
         (hsr_choice_flags(a, &v->choice) & g->mask) == g->flags;
}

/* That no picture can be judged, for the oracle's sake; "": they can. */
static void set_all(const struct group *g, enum verdict verdict,
                    const char *why) {
  for (int a = 0; a < g->n_algorithms; a++) {
    char refusal[500] = "";
    if (*why)
      snprintf(refusal, sizeof refusal, "refused, %s cannot be judged: %.300s",
               g->algorithm[a].listed->plain->name, why);
    if (is_judged(g, a))
      set_verdict(g, a, verdict, refusal);
  }
}

/* With its time limited, if it answers as a whole. */
static enum hsr_status ask_in_time(const struct group *g,
                                   const struct hsr_algorithm *oracle,
                                   struct wanted *wanted,
                                   struct hsr_error *err) {
  if (g->form.type->by_places)
    return ask_oracle(g, oracle, wanted, err);
  char why[100];
  snprintf(why, sizeof why, "%s takes more than %ld s", oracle->name,
           g->timeout);
  set_all(g, REFUSED, why);
  if (is_too_much(g, oracle))
    return hsr_fail(err, HSR_E_REFUSED, "%s", why);
  alarm((unsigned)g->timeout * (unsigned)g->n_views);
  enum hsr_status status = ask_oracle(g, oracle, wanted, err);
  alarm(0);
  set_all(g, PENDING, "");
  return status;
}

/* Runs each algorithm in a process of its own. */
static enum hsr_status judge_all(const struct group *g, struct wanted *wanted) {
  struct runner *runner = calloc((size_t)g->n_algorithms, sizeof *runner);
  int n = 0;
  if (!runner)
    return HSR_E_NOMEM;
  for (int a = 0; a < g->n_algorithms; a++) {
    if (!is_judged(g, a))
      continue;
    if (is_too_much(g, g->algorithm[a].listed->plain)) {
      note_expense(g, a);
      continue;
    }
    while (!has_turn(g, n))
      n = wait_for_one(g, runner, n);
    runner[n++] = (struct runner){start(g, a, wanted), a};
    if (runner[n - 1].process < 0) {
      set_verdicts(g, a, -1, 0, 0);
      set_done(g, a);
      give_turn(g);
      n--;
    }
  }
  while (n)
    n = wait_for_one(g, runner, n);
  free(runner);
  return HSR_OK;
}

static void leave_pictures(const struct group *g, const struct wanted *wanted) {
  size_t n = (size_t)g->view->m * (size_t)g->view->n;
  for (int k = 0; k < g->n_views; k++) {
    const uint32_t *ids = hsr_answer_ids_of(&wanted[k].answer);
    if (ids)
      memcpy(g->picture + (size_t)k * n, ids, n * sizeof *ids);
  }
}

enum hsr_status judge_group(const struct group *g) {
  const struct hsr_algorithm *oracle = oracle_of(g->form.type);
  struct hsr_error err;
  struct wanted *wanted = calloc((size_t)g->n_views, sizeof *wanted);
  take_turn(g);
  enum hsr_status status =
      wanted ? ask_in_time(g, oracle, wanted, &err) : HSR_E_NOMEM;
  give_turn(g);
  if (g->picture && !status)
    leave_pictures(g, wanted);
  if (!status)
    status = judge_all(g, wanted);
  free_wanted(g, wanted);
  if (status == HSR_E_REFUSED) { /* it does not take the scene */
    set_all(g, REFUSED, err.text);
    return HSR_OK;
  }
  return status;
}
