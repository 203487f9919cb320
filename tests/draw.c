/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tests/draw.h"
#include "tests/tap.h"
#include "bench/modules/variant.h"
#include "common/answers/kinds/segments.h"
#include "scenes/scenes.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- What no test can do without ------------------------------------------ */

struct hsr_scene *must_open(const char *name) {
  struct hsr_scene *scene;
  struct hsr_error err;
  if (hsr_scene_open(name, NULL, &scene, &err))
    bail("%s: %s", name, err.text);
  return scene;
}

void must_finish(struct hsr_scene *scene) {
  struct hsr_error err;
  if (hsr_scene_finish(scene, &err))
    bail("%s: %s", scene->name, err.text);
}

void must_world(struct hsr_world *world, struct hsr_scene *scene) {
  struct hsr_error err;
  if (hsr_world_init(world, scene, &err))
    bail("%s: %s", scene->name, err.text);
}

void must_roster(struct hsr_world *world, struct hsr_scene *scene) {
  struct hsr_error err;
  if (hsr_world_roster(world, scene, &err))
    bail("%s: %s", scene->name, err.text);
}

void must_view(struct hsr_view *view, const struct hsr_camera *camera, int m,
               int n) {
  struct hsr_error err;
  if (hsr_view_init(view, camera, m, n, &err))
    bail("%d x %d: %s", m, n, err.text);
}

void must_setup(struct hsr_setup *setup, const struct hsr_algorithm *algorithm,
                const struct hsr_choice *choice,
                const struct hsr_world *world) {
  struct hsr_error err = {.text = "out of memory"};
  if (hsr_setup_init(setup, algorithm, choice, world, &err))
    bail("%s: %s", algorithm->name, err.text);
}

/* --- Drawing -------------------------------------------------------------- */

/* Runs an algorithm, so chosen; NULL: as is standard. The job lacks only the
 * scratch memory; its tally may be NULL. HSR_E_REFUSED; any other failure ends
 * the test program. */
static enum hsr_status try(const struct hsr_algorithm *algorithm,
                           const struct hsr_choice *choice,
                           const struct hsr_world *world, struct hsr_job job) {
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  struct hsr_tally own = {.out_of_memory = false};
  struct hsr_setup setup;
  enum hsr_status status =
      hsr_setup_init(&setup, algorithm, choice, world, &err);
  job.scratch = &scratch;
  if (!job.tally)
    job.tally = &own;
  if (!status)
    status = hsr_setup_render(&setup, &job, &err);
  if (status && status != HSR_E_REFUSED)
    bail("%s: %s", algorithm->name, err.text);
  hsr_setup_free(&setup);
  hsr_arena_free(&scratch);
  return status;
}

static void draw(const struct hsr_algorithm *algorithm,
                 const struct hsr_world *world, struct hsr_job job) {
  if (!try(algorithm, NULL, world, job))
    return;
  bail("%s refuses the scene", algorithm->name);
}

bool draw_chosen(const struct hsr_algorithm *algorithm,
                 const struct hsr_choice *choice, const struct hsr_world *world,
                 const struct hsr_view *view, struct hsr_answer *answer,
                 struct hsr_tally *tally) {
  struct hsr_form form =
      choice ? choice->form : hsr_choice_standard(algorithm).form;
  if (hsr_answer_make(answer, &form, view, false, NULL))
    bail("no memory for an answer");
  if (form.type->unset)
    form.type->unset(answer);
  return !try(algorithm, choice, world,
              (struct hsr_job){.view = view, .tally = tally, .answer = answer});
}

bool draw_answer(const struct hsr_algorithm *algorithm,
                 const struct hsr_world *world, const struct hsr_view *view,
                 struct hsr_answer *answer, struct hsr_tally *tally) {
  return draw_chosen(algorithm, NULL, world, view, answer, tally);
}

struct hsr_choice choose_also(const struct hsr_algorithm *algorithm,
                              const struct hsr_answer_type *type) {
  struct hsr_choice choice = hsr_choice_standard(algorithm);
  choice.form = hsr_form_standard(type);
  return choice;
}

void draw_ids(const struct hsr_algorithm *algorithm,
              const struct hsr_world *world, const struct hsr_view *view,
              uint32_t *ids, struct hsr_tally *tally) {
  memset(ids, 0xfe, (size_t)view->m * (size_t)view->n * sizeof *ids);
  struct hsr_answer answer = hsr_answer_of_ids(ids, view->m, view->n);
  draw(algorithm, world,
       (struct hsr_job){.view = view, .tally = tally, .answer = &answer});
}

void draw_plain(const char *name, const struct hsr_world *world,
                const struct hsr_view *view, uint32_t *ids) {
  draw_ids(hsr_algorithm_find(name)->plain, world, view, ids, NULL);
}

/* --- In windows, by several threads --------------------------------------- */

enum { MOST_THREADS = 8 };

/* Of the windows of a picture, every step-th from the first on. */
struct share {
  const struct hsr_setup *setup;
  const struct hsr_view *view;
  uint32_t *ids;
  int side, first, step;
  enum hsr_status status;
  struct hsr_error err;
};

static int smaller(int a, int b) {
  return a < b ? a : b;
}

static void *draw_share(void *context) {
  struct share *s = context;
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  struct hsr_tally tally = {.out_of_memory = false};
  struct hsr_view view = *s->view;
  int columns = (view.m + s->side - 1) / s->side,
      rows = (view.n + s->side - 1) / s->side;
  for (int k = s->first; k < columns * rows && !s->status; k += s->step) {
    int x = k % columns * s->side, y = k / columns * s->side;
    view.window = (struct hsr_window){x, y, smaller(x + s->side, view.m),
                                      smaller(y + s->side, view.n)};
    struct hsr_answer answer = hsr_answer_of_ids(s->ids, view.m, view.n);
    struct hsr_job job = {
        .view = &view, .scratch = &scratch, .tally = &tally, .answer = &answer};
    hsr_arena_reset(&scratch);
    s->status = hsr_setup_render(s->setup, &job, &s->err);
  }
  hsr_arena_free(&scratch);
  return NULL;
}

void draw_in_windows(const struct hsr_setup *setup, const struct hsr_view *view,
                     int side, int threads, uint32_t *ids) {
  struct share share[MOST_THREADS];
  pthread_t thread[MOST_THREADS];
  memset(ids, 0xfe, (size_t)view->m * (size_t)view->n * sizeof *ids);
  for (int k = 0; k < threads; k++) {
    share[k] = (struct share){.setup = setup,
                              .view = view,
                              .ids = ids,
                              .side = side,
                              .first = k,
                              .step = threads,
                              .err = {.text = "out of memory"}};
    if (pthread_create(&thread[k], NULL, draw_share, &share[k]))
      bail("no thread");
  }
  for (int k = 0; k < threads; k++) {
    pthread_join(thread[k], NULL);
    if (share[k].status)
      bail("a window was not drawn: %s", share[k].err.text);
  }
}

/* --- Lines and answers ---------------------------------------------------- */

void draw_lines(const struct hsr_algorithm *algorithm,
                const struct hsr_world *world, const struct hsr_view *view,
                struct hsr_drawing *drawing, struct hsr_tally *tally) {
  hsr_drawing_clear(drawing);
  struct hsr_answer answer = hsr_answer_of_drawing(drawing, view->m, view->n);
  draw(algorithm, world,
       (struct hsr_job){.view = view, .tally = tally, .answer = &answer});
}

long compare_answers(const struct hsr_view *view, const struct hsr_answer *got,
                     const struct hsr_answer *wanted, char *text, size_t size) {
  const struct hsr_window *w = &view->window;
  size_t n = 0, most = (size_t)view->m * (size_t)view->n;
  uint32_t *place = malloc(most * sizeof *place);
  if (!place)
    bail("no memory for a comparison");
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++)
      place[n++] = (uint32_t)(j * view->m + i);
  const struct hsr_comparison c = {
      .view = view, .got = got, .wanted = wanted, .place = place, .n = n};
  struct hsr_difference found = {.differing = 0};
  got->form.type->compare(&c, &found);
  snprintf(text, size, "%s", found.first);
  free(place);
  return (long)found.differing;
}

long count_differences(const struct hsr_view *view, const uint32_t *a,
                       const uint32_t *b) {
  const struct hsr_window *w = &view->window;
  long n = 0;
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++) {
      size_t k = (size_t)j * (size_t)view->m + (size_t)i;
      n += a[k] != b[k];
    }
  return n;
}

void open_worlds(struct both_worlds *w, const char *name) {
  w->scene = must_open(name);
  must_world(&w->world, w->scene);
  must_roster(&w->roster, w->scene);
}

void close_worlds(struct both_worlds *w) {
  hsr_world_free(&w->world);
  hsr_world_free(&w->roster);
  hsr_scene_delete(w->scene);
}

int64_t draw_integer(uint64_t *seed, int64_t lo, int64_t hi) {
  /* splitmix64 */
  uint64_t z = *seed += 0x9e3779b97f4a7c15u;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  z ^= z >> 31;
  return lo + (int64_t)(z % (uint64_t)(hi - lo + 1));
}

void draw_parallel(uint64_t *seed, struct hsr_camera *camera, int n) {
  static const double forward[][3] = {
      {0, 0, -1},  {1, 0, 0},  {0, -1, 0},   {-1, -1, -1}, {1, -1, 1},
      {0, -1, -1}, {-1, 0, 1}, {-1, -2, -2}, {2, -1, 0},   {3, -4, 0}};
  enum { FORWARDS = sizeof forward / sizeof *forward };
  if (draw_integer(seed, 0, 1))
    return;
  const double *f = forward[draw_integer(seed, 0, FORWARDS - 1)];
  double back = (double)draw_integer(seed, 0, 12);
  for (int k = 0; k < 3; k++) {
    camera->at[k] = (double)draw_integer(seed, -4, 4);
    camera->eye[k] = camera->at[k] - back * f[k];
    camera->at[k] = camera->eye[k] + f[k];
    camera->up[k] = k == (f[0] == 0 && f[2] == 0 ? 2 : 1);
  }
  camera->near = (double)draw_integer(seed, 0, 3) / 2;
  camera->parallel = n * ldexp(1, (int)-draw_integer(seed, 0, 3));
}

void draw_part(uint64_t *seed, struct hsr_view *view) {
  if (draw_integer(seed, 0, 3) == 0) { /* jittered */
    view->offset_x = (double)draw_integer(seed, -7, 7) / 16;
    view->offset_y = (double)draw_integer(seed, -7, 7) / 16;
  }
  if (draw_integer(seed, 0, 3) == 0) { /* a part of the picture */
    view->window.x0 = (int)draw_integer(seed, 0, view->m - 1);
    view->window.x1 = (int)draw_integer(seed, view->window.x0 + 1, view->m);
    view->window.y0 = (int)draw_integer(seed, 0, view->n - 1);
    view->window.y1 = (int)draw_integer(seed, view->window.y0 + 1, view->n);
  }
}

/* --- Algorithms and variants ---------------------------------------------- */

/* What the survey proposes, options that leave work out, and what Greene proposes
 * or compares with. */
static const char *const proposals[] = {
#define HSR_PROPOSED(variant) variant,
#include "algorithms/proposals.def"
#undef HSR_PROPOSED
    "zbuffer-fast:groups=cones", "hzbuffer:octree=lazy",
    "hzbuffer:pyramid=off:cubes=sides", "tiling:counts=on", "pvs:sets=cells"};
enum { N_PROPOSALS = sizeof proposals / sizeof *proposals, MOST_LISTED = 200 };

/* A variant as an algorithm of its own, in one build. */
struct own {
  struct hsr_algorithm algorithm;
  struct hsr_option options[HSR_MAX_OPTIONS + 1];
};

static const struct hsr_algorithm *make_own(struct own *own,
                                            const struct hsr_algorithm *a,
                                            const char *name,
                                            const struct hsr_choice *choice) {
  own->algorithm = *a;
  own->algorithm.name = name;
  own->algorithm.options = own->options;
  for (int k = 0; a->options[k].name; k++) {
    own->options[k] = a->options[k];
    own->options[k].standard = choice->values.option[k];
    own->options[k].real_standard = choice->values.real[k];
  }
  return &own->algorithm;
}

const struct hsr_listed *all_listed(void) {
  static struct hsr_listed listed[MOST_LISTED];
  static struct own plain[N_PROPOSALS], counting[N_PROPOSALS];
  int n = 0;
  if (listed[0].plain)
    return listed;
  for (const struct hsr_listed *a = hsr_algorithms(); a->plain; a++)
    listed[n++] = *a;
  for (int k = 0; k < N_PROPOSALS; k++) {
    struct hsr_variant variant;
    struct hsr_error err;
    if (hsr_variant_parse(proposals[k], &variant, &err))
      bail("%s", err.text);
    const struct hsr_listed *of = variant.listed;
    listed[n].plain =
        make_own(&plain[k], of->plain, proposals[k], &variant.choice);
    listed[n++].counting =
        make_own(&counting[k], of->counting, proposals[k], &variant.choice);
  }
  return listed;
}

const struct hsr_algorithm *find_counting(const char *name) {
  for (const struct hsr_listed *l = all_listed(); l->plain; l++)
    if (!strcmp(l->plain->name, name))
      return l->counting;
  bail("no %s", name);
}

bool is_asked(const struct hsr_algorithm *algorithm, int n, char **names) {
  bool asked = n == 0;
  for (int k = 0; k < n; k++) {
    size_t length = strlen(names[k]);
    asked |= !strncmp(algorithm->name, names[k], length) &&
             strchr(":", algorithm->name[length]);
  }
  return asked;
}

int counter_of(const struct hsr_algorithm *algorithm, const char *name) {
  for (int k = 0; algorithm->counters[k].name; k++)
    if (!strcmp(algorithm->counters[k].name, name))
      return k;
  bail("%s has no counter \"%s\"", algorithm->name, name);
}

uint64_t counted(const struct hsr_algorithm *algorithm,
                 const struct hsr_tally *tally, const char *name) {
  return tally->count[counter_of(algorithm, name)];
}

static void for_each_of_kind(const struct hsr_answer_type *kind,
                             void (*check)(const struct hsr_algorithm *,
                                           void *),
                             void *context) {
  for (const struct hsr_listed *a = all_listed(); a->plain; a++)
    if (hsr_own_kind(a->plain) == kind && a->plain->subjects & 1 << HSR_FACES &&
        !(a->plain->flags & (HSR_JUDGE | HSR_NO_PICTURE | HSR_KNOWN_WRONG))) {
      check(a->plain, context);
      check(a->counting, context);
    }
}

void for_each_judged(void (*check)(const struct hsr_algorithm *, void *),
                     void *context) {
  for_each_of_kind(HSR_IDS, check, context);
}

void for_each_line_algorithm(void (*check)(const struct hsr_algorithm *,
                                           void *),
                             void *context) {
  for_each_of_kind(HSR_SEGMENTS, check, context);
}
