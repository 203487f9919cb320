/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The scenes of hsr check, one after another. While the last groups of a scene
 * are judged, the next scenes begin, so that no processor waits. Results come in
 * the scenes' order. */
#include "bench/modules/variant.h"
#include "bench/check/check.h"
#include "bench/options/scene.h"
#include "bench/ranks/ranks.h"
#include "bench/run/terminate.h"
#include "bench/terminal/terminal.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* As many scenes are open at most, and none is opened while those that are have
 * so many faces. */
enum { MOST_OPEN = 8, MANY_FACES = 1 << 20 };

/* A scene whose groups are judged. */
struct open_scene {
  struct scene_run run;
  struct group *group;
  int n_groups,
      running; /* groups: of all ranks; of this one, that are judged */
  enum hsr_status failure; /* the first of a group */
};

/* A process that judges a group. */
struct judging {
  pid_t process;
  struct open_scene *scene;
  const struct group *group;
};

struct scenes {
  const struct check_options *options;
  struct totals *totals;
  struct progress progress;
  struct open_scene *open[MOST_OPEN]; /* in their order */
  int n_open;
  struct judging *judging; /* room for as many as jobs */
  int n_judging, n_done;
};

/* --- All groups of a scene ------------------------------------------------ */

/* Whether algorithm k is the first of those that are judged together. These
 * have one form, and either all of them keep a state or none does. */
static bool is_first(const struct check_options *o, int k) {
  const struct hsr_variant *v = &o->algorithm[k];
  for (const struct hsr_variant *w = o->algorithm; w < v; w++)
    if (keeps_state(w) == keeps_state(v) &&
        hsr_same_form(&w->choice.form, &v->choice.form))
      return false;
  return true;
}

/* The group of one view; or of all views, if `first` keeps a state from one to
 * the next, or if they are frames. */
static struct group group_of(const struct scene_run *run,
                             const struct hsr_variant *first, int size,
                             int view) {
  const struct check_options *o = run->options;
  bool sequence = keeps_state(first);
  return (struct group){.algorithm = o->algorithm,
                        .n_algorithms = o->n_algorithms,
                        .timeout = o->timeout,
                        .samples = samples_to_compare(
                            &run->world, &first->choice.form, o->samples),
                        .world = &run->world,
                        .form = first->choice.form,
                        .walk = o->frames ? &run->walk : NULL,
                        .mask = HSR_FRAME_STATE,
                        .flags = sequence ? HSR_FRAME_STATE : 0,
                        .view = &run->view[size * o->n_views + view],
                        .number = &o->view[view],
                        .n_views = sequence || o->frames ? o->n_views : 1,
                        .cells = cell_at(run, size, view, 0),
                        .turns = o->turns,
                        .differences = o->differences};
}

/* Counts the groups of all forms, sizes and views, and writes them into group[]
 * unless that is NULL. The longest come first. */
static int list_groups(const struct scene_run *run, struct group *group) {
  const struct check_options *o = run->options;
  int n = 0;
  for (int sequence = 1; sequence >= 0; sequence--)
    for (int k = 0; k < o->n_algorithms; k++) {
      const struct hsr_variant *first = &o->algorithm[k];
      if (keeps_state(first) != sequence || !is_first(o, k))
        continue;
      for (int size = 0; size < o->n_sizes; size++)
        for (int view = 0; view < (sequence || o->frames ? 1 : o->n_views);
             view++, n++)
          if (group)
            group[n] = group_of(run, first, size, view);
    }
  return n;
}

uint32_t most_laid_out(const struct check_options *o) {
  uint32_t most = 0;
  for (int a = 0; a < o->n_algorithms; a++) {
    uint32_t own =
        most_to_judge(o->algorithm[a].listed, &o->algorithm[a].choice);
    most = own > most ? own : most;
  }
  return most;
}

uint32_t last_view(const struct check_options *o) {
  uint32_t last = 0;
  for (int k = 0; k < o->n_views; k++)
    last = (uint32_t)o->view[k] > last ? (uint32_t)o->view[k] : last;
  return last;
}

enum hsr_status init_views(struct scene_run *run, const struct hsr_scene *scene,
                           struct hsr_error *err) {
  const struct check_options *o = run->options;
  int n = o->n_sizes * o->n_views;
  run->view = calloc((size_t)n, sizeof *run->view);
  enum hsr_status status = run->view ? HSR_OK : hsr_fail_nomem(err);
  for (int k = 0; k < n && !status; k++)
    status = hsr_view_init_of(&run->view[k], scene,
                              (uint32_t)o->view[k % o->n_views],
                              o->m[k / o->n_views], o->n[k / o->n_views], err);
  return status;
}

/* Makes the views in all sizes. A scene that has too few views gets more. */
static enum hsr_status make_views(struct scene_run *run,
                                  struct hsr_error *err) {
  uint32_t last = last_view(run->options);
  if (run->scene->n_views <= last &&
      hsr_scene_add_orbit(run->scene, last + 1 - run->scene->n_views))
    return hsr_fail_nomem(err);
  return init_views(run, run->scene, err);
}

static enum hsr_status make_cells(struct scene_run *run,
                                  struct hsr_error *err) {
  const struct check_options *o = run->options;
  run->cells_size =
      (size_t)(o->n_sizes * o->n_views * o->n_algorithms) * sizeof *run->cells;
  run->cells = shared_memory(run->cells_size);
  return run->cells ? HSR_OK : hsr_fail_nomem(err);
}

static enum hsr_status open_run(struct scene_run *run, struct hsr_error *err) {
  const struct check_options *o = run->options;
  enum hsr_status status =
      o->frames ? open_walk(run, err)
                : open_scene(run->name, o->import, &run->scene, err);
  if (!status && !o->frames)
    status = make_views(run, err);
  if (!status)
    status = hsr_world_open(&run->world, run->scene, most_laid_out(o), err);
  return status ? status : make_cells(run, err);
}

static void close_run(struct scene_run *run) {
  if (run->cells)
    munmap(run->cells, run->cells_size);
  free(run->view);
  hsr_world_free(&run->world);
  close_walk(run);
  hsr_scene_delete(run->scene);
}

static enum hsr_status make_groups(struct open_scene *scene,
                                   struct hsr_error *err) {
  enum hsr_status status = open_run(&scene->run, err);
  if (status)
    return status;
  scene->n_groups = list_groups(&scene->run, NULL);
  scene->group = calloc((size_t)scene->n_groups, sizeof *scene->group);
  if (!scene->group)
    return hsr_fail_nomem(err);
  list_groups(&scene->run, scene->group);
  return HSR_OK;
}

/* --- Processes ------------------------------------------------------------ */

/* Adds the algorithms of a group that are not judged yet. */
static void name_waited(const struct group *g, char text[PROGRESS_TEXT]) {
  for (int k = 0; k < g->n_algorithms; k++) {
    const struct hsr_variant *v = &g->algorithm[k];
    if (hsr_same_form(&v->choice.form, &g->form) &&
        keeps_state(v) == (g->flags == HSR_FRAME_STATE) &&
        !__atomic_load_n(&g->cells[k].done, __ATOMIC_ACQUIRE))
      progress_add(text, v->name);
  }
}

/* Tells how many groups are done, of all scenes, which have alike many; and which
 * algorithms are at work. */
static void show_progress(struct scenes *s, const struct open_scene *scene) {
  char text[PROGRESS_TEXT];
  if (!s->progress.told)
    return;
  snprintf(text, sizeof text, "%.100s", scene->run.name);
  for (int k = 0; k < s->n_judging; k++)
    if (s->judging[k].scene == scene)
      name_waited(s->judging[k].group, text);
  progress_close(text);
  progress_tell(&s->progress, (size_t)s->n_done,
                (size_t)(s->options->n_scenes * scene->n_groups),
                "groups of pictures", text);
}

static enum hsr_status start_group(struct scenes *s, struct open_scene *scene,
                                   const struct group *g,
                                   struct hsr_error *err) {
  fflush(NULL);
  pid_t parent = getpid(), child = fork();
  if (child == 0) {
    end_with_parent(parent);
    end_process((int)judge_group(g));
  }
  if (child < 0)
    return hsr_fail_nomem(err);
  s->judging[s->n_judging++] = (struct judging){child, scene, g};
  scene->running++;
  return HSR_OK;
}

/* What the end of a group's process says. One that ran out of time has recorded
 * that in its cells. */
static enum hsr_status failure_of(int end) {
  if (WIFEXITED(end))
    return (enum hsr_status)WEXITSTATUS(end);
  return WTERMSIG(end) == SIGALRM ? HSR_OK : HSR_E_INTERNAL;
}

/* Waits for one of the groups to end. */
static void wait_for_group(struct scenes *s) {
  int end = 0, k = 0;
  pid_t child;
  do {
    child = waitpid(-1, &end, s->progress.told ? WNOHANG : 0);
    if (!child) { /* it goes on, and is named */
      show_progress(s, s->judging[0].scene);
      nanosleep(&(struct timespec){0, 20000000}, NULL);
    }
  } while (!child || (child < 0 && errno == EINTR));
  while (child > 0 && k < s->n_judging - 1 && s->judging[k].process != child)
    k++;
  if (child > 0 && WIFSIGNALED(end))
    sem_post(s->options->turns); /* that the group had */
  struct open_scene *scene = s->judging[k].scene;
  if (child > 0 && !scene->failure)
    scene->failure = failure_of(end);
  scene->running--;
  s->judging[k] = s->judging[--s->n_judging];
  s->n_done++;
  show_progress(s, scene);
}

/* Starts all groups of a scene that this rank takes. */
static enum hsr_status start_groups(struct scenes *s, struct open_scene *scene,
                                    struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  struct queue queue;
  queue_open(&queue, scene->n_groups, true);
  show_progress(s, scene);
  for (int k;
       !status && !scene->failure && (k = (int)queue_take(&queue)) >= 0;) {
    if (s->n_judging == s->options->jobs)
      wait_for_group(s);
    status = start_group(s, scene, &scene->group[k], err);
  }
  return status;
}

/* --- Scenes in their order ------------------------------------------------ */

static void close_scene(struct open_scene *scene) {
  free(scene->group);
  close_run(&scene->run);
  free(scene);
}

/* Reports a scene all of whose groups are done. */
static enum hsr_status report_done(struct scenes *s,
                                   const struct open_scene *scene,
                                   struct hsr_error *err) {
  if (scene->failure == HSR_E_NOMEM)
    return hsr_fail_nomem(err);
  if (scene->failure)
    return hsr_fail(err, HSR_E_INTERNAL, "%s: the oracle failed",
                    scene->run.name);
  /* A cell is filled by one rank, and 0 in the others. */
  ranks_unite(scene->run.cells, scene->run.cells_size);
  progress_end(&s->progress);
  return report_scene(&scene->run, s->totals, err);
}

/* Waits until the first scene is done, reports and closes it. */
static enum hsr_status finish_first(struct scenes *s, struct hsr_error *err) {
  struct open_scene *first = s->open[0];
  while (first->running)
    wait_for_group(s);
  enum hsr_status status = report_done(s, first, err);
  for (int k = 1; k < s->n_open; k++)
    s->open[k - 1] = s->open[k];
  s->n_open--;
  close_scene(first);
  return status;
}

/* Whether one more scene may be opened. Ranks go through one scene together. */
static bool is_room(const struct scenes *s) {
  uint64_t faces = 0;
  for (int k = 0; k < s->n_open; k++)
    faces += s->open[k]->run.world.n_faces;
  return !s->n_open ||
         (s->n_open < MOST_OPEN && faces < MANY_FACES && ranks_count() == 1);
}

/* Makes room for one more scene, and reports the first ones that are done. */
static enum hsr_status make_room(struct scenes *s, struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  while (!status && s->n_open && (!s->open[0]->running || !is_room(s)))
    status = finish_first(s, err);
  return status;
}

/* Begins a scene, all groups of which are started in the end. */
static enum hsr_status begin_scene(struct scenes *s, int number,
                                   struct hsr_error *err) {
  const struct check_options *o = s->options;
  struct open_scene *scene = calloc(1, sizeof *scene);
  if (!scene)
    return hsr_fail_nomem(err);
  scene->run.options = o;
  enum hsr_status status = aim_name(&o->camera, 1, o->m[0], o->n[0],
                                    o->scene[number], scene->run.name, err);
  if (!status)
    status = make_groups(scene, err);
  if (status) {
    close_scene(scene);
    return status;
  }
  s->open[s->n_open++] = scene;
  return start_groups(s, scene, err);
}

/* After a failure: reports the first n scenes that are open, which come before
 * it, and waits for the others. */
static void abandon(struct scenes *s, int n) {
  struct hsr_error ignored;
  while (n-- > 0 && !finish_first(s, &ignored))
    ;
  while (s->n_judging)
    wait_for_group(s);
  for (int k = 0; k < s->n_open; k++)
    close_scene(s->open[k]);
}

static enum hsr_status check_whole(struct scenes *s, struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  int n_before = 0; /* what fails */
  s->judging = calloc((size_t)s->options->jobs, sizeof *s->judging);
  if (!s->judging)
    return hsr_fail_nomem(err);
  for (int k = 0; k < s->options->n_scenes && !status; k++) {
    status = make_room(s, err);
    n_before = status ? 0 : s->n_open;
    if (!status)
      status = begin_scene(s, k, err);
  }
  while (s->n_open && !status) {
    n_before = 0;
    status = finish_first(s, err);
  }
  if (status)
    abandon(s, n_before);
  free(s->judging);
  return status;
}

/* --- Scenes in parts ------------------------------------------------------ */

/* One after another; ranks hold the parts. */
static enum hsr_status check_parts(struct scenes *s, int number,
                                   struct hsr_error *err) {
  const struct check_options *o = s->options;
  struct scene_run run = {
      .options = o, .number = number, .progress = &s->progress};
  enum hsr_status status = aim_name(&o->camera, 1, o->m[0], o->n[0],
                                    o->scene[number], run.name, err);
  if (!status)
    status = make_cells(&run, err);
  if (!status)
    status = judge_parts(&run, err);
  progress_end(&s->progress);
  if (!status && !ranks_own())
    status = report_scene(&run, s->totals, err);
  close_run(&run);
  return status;
}

enum hsr_status check_scenes(const struct check_options *options,
                             struct totals *totals, struct hsr_error *err) {
  struct scenes s = {
      .options = options, .totals = totals, .progress = progress_begin(stderr)};
  enum hsr_status status = HSR_OK;
  if (!options->sort_last)
    status = check_whole(&s, err);
  for (int k = 0; k < options->n_scenes && !status && options->sort_last; k++)
    status = check_parts(&s, k, err);
  progress_end(&s.progress);
  return status;
}
