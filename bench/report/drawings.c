/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One scene and view, drawn by the oracle and by every algorithm that has a
 * cell: the work, the line drawings, and where an answer differs from the
 * oracle's. Each algorithm draws in a process of its own, several at a time. */
#include "bench/modules/modules.h"
#include "bench/judge/judge.h"
#include "bench/report/pictures.h"
#include "bench/results/json.h"
#include "bench/run/crew.h"
#include "bench/run/terminate.h"

#include "common/answers/answer.h"
#include "common/base/clock.h"
#include "common/files/image.h"
#include "common/files/json/json.h"
#include "common/paper/lines/line_style.h"
#include "common/view/picture.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

/* In a drawing of over MANY_LINES nobody would see the hidden ones. */
enum { NAME = 160, PATH = 4400, MANY_LINES = 30000, MOST_DRAWERS = 16 };

/* Passes that are shown, the first ones. */
enum { MOST_PASSES = 12 };

/* An algorithm's drawing. */
struct drawing {
  const struct hsr_algorithm *algorithm; /* its counting build */
  const json_t *cell;
  char file[NAME]; /* of ids their work, else the answer; in the folder */
  char work[NAME]; /* of an answer that is a picture; empty: none */
  json_t *entry;   /* NULL: not made in time, or not at all */
};

/* A place for a process that draws. */
struct drawer {
  pid_t process; /* 0: none */
  struct drawing *drawing;
  uint32_t *ids; /* of its picture; shared with the process. If it does not make
                    ids: the number of its passes that are shown, then the
                    pixels that were too uncertain after each */
};

/* The scene and view. */
struct sheet {
  const struct report *report;
  const struct subject *subject;
  struct stage stage;
  size_t n;         /* samples */
  double end;       /* no drawing lasts longer */
  uint32_t *wanted; /* the oracle's ids */
  float *depth, *rgb;
  json_t *differences; /* for the probe, by algorithm */
  int n_drawers, n_drawings;
  struct drawer drawer[MOST_DRAWERS];
  struct drawing *drawing;
  FILE *out;
};

static void path_of(const struct sheet *s, const char *name, char path[PATH]) {
  snprintf(path, PATH, "%.4096s/%.200s", s->report->folder, name);
}

/* --- Drawing in another process ------------------------------------------- */

/* All reports have one scale, so that work can be compared: logarithmic, dark
 * for 0 touches and bright for 255 or more. The page's legend says so. */
static enum hsr_status write_work(const char *path, const struct hsr_view *view,
                                  float *work, struct hsr_error *err) {
  size_t n = (size_t)view->m * (size_t)view->n;
  for (size_t k = 0; k < n; k++)
    work[k] = fminf(log2f(1 + work[k]) / 8, 1);
  return hsr_image_write_ramp(path, view->m, view->n, work, err);
}

/* The answer itself, as a file of its own kind. It does not name the algorithm:
 * equal answers make equal files. */
static enum hsr_status write_answer(const struct sheet *s,
                                    const struct hsr_answer *answer,
                                    const char *path, struct hsr_error *err) {
  const struct hsr_drawing *lines = hsr_answer_lines(answer);
  bool many = lines && lines->n > MANY_LINES;
  struct hsr_line_style style;
  hsr_line_style_plain(&style, many ? HSR_HIDDEN_NONE : HSR_HIDDEN_THIN);
  struct hsr_showing showing = {
      .world = &s->stage.world,
      .view = &s->stage.view,
      .scene = s->stage.scene->name,
      .title = s->stage.scene->name,
      .description = answer->form.type->meaning,
      .supersamples = 1,
      .style = &style,
      .background = {.given = lines, .rgb = {1, 1, 1}}};
  struct hsr_shaded shaded = {.rgb = NULL};
  const struct hsr_answer_type *kind = answer->form.type;
  enum hsr_status status =
      kind->shade ? kind->shade(answer, &showing, &shaded, err) : HSR_OK;
  if (!status)
    status = kind->write(answer, &showing, &shaded, path, err);
  hsr_shaded_free(&shaded);
  return status;
}

/* --- Passes --------------------------------------------------------------- */

/* An answer that becomes better, and what is told of it. */
struct series {
  const struct sheet *sheet;
  const struct drawing *drawing;
  uint32_t *told;         /* as in struct drawer */
  enum hsr_status status; /* what failed first */
};

static void name_pass(const struct sheet *s, const struct drawing *d,
                      const char *what, uint32_t pass, char name[NAME]) {
  snprintf(name, NAME, "pictures/p%d-%s-%s-%u.png", s->subject->number,
           d->algorithm->name, what, pass);
}

/* Writes how uncertain each pixel is. *n becomes how many are too uncertain. */
static enum hsr_status write_uncertainty(const struct hsr_answer *answer,
                                         const char *path, uint32_t *n) {
  size_t all = (size_t)answer->m * (size_t)answer->n;
  float *share = malloc(all * sizeof *share);
  if (!share)
    return HSR_E_NOMEM;
  answer->form.type->uncertainty(answer, share);
  *n = 0;
  for (size_t k = 0; k < all; k++) {
    *n += share[k] > 1;
    share[k] = fminf(share[k], 1);
  }
  enum hsr_status status =
      hsr_image_write_ramp(path, answer->m, answer->n, share, NULL);
  free(share);
  return status;
}

static void write_pass(void *whom, const struct hsr_answer *answer, int pass) {
  struct series *series = whom;
  const struct sheet *s = series->sheet;
  uint32_t k = (uint32_t)pass;
  char name[NAME], path[PATH];
  if (series->status || pass >= MOST_PASSES || (size_t)pass + 1 >= s->n)
    return;
  name_pass(s, series->drawing, "pass", k, name);
  path_of(s, name, path);
  series->status = write_answer(s, answer, path, NULL);
  name_pass(s, series->drawing, "uncertainty", k, name);
  path_of(s, name, path);
  if (!series->status)
    series->status = write_uncertainty(answer, path, &series->told[1 + k]);
  if (!series->status)
    series->told[0] = k + 1;
}

/* --- One drawing ---------------------------------------------------------- */

/* Draws with the counting build: only that knows the work. */
static enum hsr_status draw(const struct sheet *s,
                            const struct hsr_algorithm *a,
                            const struct hsr_passes *passes,
                            struct hsr_tally *tally, struct hsr_answer *answer,
                            struct hsr_error *err) {
  struct hsr_setup setup;
  enum hsr_status status =
      hsr_setup_init(&setup, a, NULL, &s->stage.world, err);
  setup.passes = passes;
  if (!status)
    status = answer_init(answer, &setup, &s->stage.view, err);
  if (!status)
    status = render_view(&setup, &s->stage.view, 1, answer, tally, NULL, err);
  hsr_setup_free(&setup);
  return status;
}

static bool has_work(const struct sheet *s, const struct hsr_tally *tally) {
  for (size_t k = 0; k < s->n; k++)
    if (tally->work[k] > 0)
      return true;
  return false;
}

/* Draws, and writes the files: of ids the work, else the answer, and the work
 * if there is any. */
static enum hsr_status draw_file(const struct sheet *s, const struct drawing *d,
                                 uint32_t *ids, struct hsr_error *err) {
  struct hsr_answer answer = {.body = NULL};
  struct hsr_tally tally = {.work = calloc(s->n, sizeof(float)),
                            .work_stride = (size_t)s->stage.view.m};
  struct series series = {.sheet = s, .drawing = d, .told = ids};
  const struct hsr_passes passes = {write_pass, &series};
  if (!tally.work)
    return hsr_fail_nomem(err);
  ids[0] = 0;
  enum hsr_status status = draw(
      s, d->algorithm, hsr_own_kind(d->algorithm)->uncertainty ? &passes : NULL,
      &tally, &answer, err);
  if (!status)
    status = series.status;
  const uint32_t *got = status ? NULL : hsr_answer_ids_of(&answer);
  if (got)
    memcpy(ids, got, s->n * sizeof *ids);
  char path[PATH];
  path_of(s, d->file, path);
  if (!status && *d->file)
    status = got ? write_work(path, &s->stage.view, tally.work, err)
                 : write_answer(s, &answer, path, err);
  path_of(s, d->work, path);
  if (!status && *d->work && has_work(s, &tally))
    status = write_work(path, &s->stage.view, tally.work, err);
  hsr_answer_free(&answer);
  free(tally.work);
  return status;
}

/* The whole seconds that a drawing which begins now may take; 0: none. */
static unsigned time_left(const struct sheet *s) {
  double left = fmin(s->end - hsr_seconds_now(), (double)s->report->timeout);
  return left > 0 ? (unsigned)ceil(left) : 0;
}

/* Starts a process that draws; false: there is no time left, or no process. */
static bool start(struct sheet *s, struct drawer *drawer, struct drawing *d) {
  unsigned seconds = time_left(s);
  if (!seconds)
    return false;
  fflush(NULL);
  pid_t parent = getpid(), child = fork();
  if (child == 0) {
    end_with_parent(parent);
    alarm(seconds);
    end_process((int)draw_file(s, d, drawer->ids, NULL));
  }
  drawer->drawing = d;
  drawer->process = child > 0 ? child : 0;
  return child > 0;
}

/* Waits until one of the processes ends. Whether its drawing is there; *drawer,
 * NULL if there was no process, is the one that ended. */
static bool wait_for_one(struct sheet *s, struct drawer **drawer) {
  int end = 1;
  pid_t child;
  do
    child = waitpid(-1, &end, 0);
  while (child < 0 && errno == EINTR);
  *drawer = NULL;
  for (int k = 0; k < s->n_drawers && child > 0; k++)
    if (s->drawer[k].process == child)
      *drawer = &s->drawer[k];
  if (!*drawer)
    return false;
  (*drawer)->process = 0;
  fputc('\n', s->out);
  fflush(s->out);
  return WIFEXITED(end) && !WEXITSTATUS(end);
}

/* Has the kind a picture of its own, as pixels, unlike ids and lines? */
static bool is_picture(const struct hsr_answer_type *kind) {
  return !kind->by_faces && kind->show_difference;
}

/* --- What the page is told of a drawing ----------------------------------- */

/* [sample, id, depth] of every sample that differs. */
static json_t *differences_json(struct sheet *s, const uint32_t *got, long *n) {
  json_t *list = json_array();
  *n = 0;
  if (!memcmp(got, s->wanted, s->n * sizeof *got))
    return list;
  float *depth = s->rgb; /* scratch */
  hsr_picture_depth(&s->stage.world, &s->stage.view, got, depth);
  for (size_t k = 0; k < s->n; k++)
    if (got[k] != s->wanted[k]) {
      ++*n;
      hsr_json_append(&list,
                      json_pack("[IIo]", (json_int_t)k,
                                got[k] == HSR_BACKGROUND ? (json_int_t)-1
                                                         : (json_int_t)got[k],
                                number_or_null((double)depth[k])));
    }
  return list;
}

/* Where the picture differs from the oracle's. */
static enum hsr_status write_difference(struct sheet *s, uint32_t *ids,
                                        const char *name,
                                        struct hsr_error *err) {
  int m = s->stage.view.m, n = s->stage.view.n;
  struct hsr_answer got = hsr_answer_of_ids(ids, m, n);
  struct hsr_answer wanted = hsr_answer_of_ids(s->wanted, m, n);
  struct hsr_comparison comparison = {
      .view = &s->stage.view, .got = &got, .wanted = &wanted, .n = s->n};
  struct hsr_showing showing = {.world = &s->stage.world,
                                .view = &s->stage.view};
  enum hsr_status status =
      got.form.type->show_difference(&comparison, &showing, s->rgb, err);
  char path[PATH];
  path_of(s, name, path);
  struct hsr_picture picture = {.m = m, .n = n, .ids = ids, .rgb = s->rgb};
  return status ? status : hsr_image_write(path, &picture, NULL, err);
}

static enum hsr_status tell_faces(struct sheet *s, struct drawing *d,
                                  uint32_t *ids, struct hsr_error *err) {
  const struct hsr_algorithm *a = d->algorithm;
  char difference[NAME];
  snprintf(difference, sizeof difference, "difference/p%d-%s.png",
           s->subject->number, a->name);
  long n = 0;
  json_object_set_new(s->differences, a->name, differences_json(s, ids, &n));
  d->entry = json_pack("{ss ss ss sI ss sn ss?}", "algorithm", a->name, "kind",
                       hsr_own_kind(a)->name, "status", n ? "wrong" : "ok",
                       "mismatches", (json_int_t)n, "work", d->file, "drawing",
                       "difference", n ? difference : NULL);
  return n ? write_difference(s, ids, difference, err) : HSR_OK;
}

static json_t *passes_json(const struct sheet *s, const struct drawing *d,
                           const uint32_t *told) {
  json_t *passes = json_array();
  for (uint32_t k = 0; k < told[0]; k++) {
    char picture[NAME], uncertainty[NAME];
    name_pass(s, d, "pass", k, picture);
    name_pass(s, d, "uncertainty", k, uncertainty);
    hsr_json_append(&passes, json_pack("{ss ss sI}", "picture", picture,
                                       "uncertainty", uncertainty, "uncertain",
                                       (json_int_t)told[1 + k]));
  }
  return passes;
}

/* Another picture than that of ids. It was judged when it was counted. */
static void tell_picture(const struct sheet *s, struct drawing *d,
                         const uint32_t *told) {
  const struct hsr_algorithm *a = d->algorithm;
  char path[PATH];
  path_of(s, d->work, path);
  bool work = !access(path, F_OK);
  d->entry = json_pack("{ss ss ss sI ss? sn sn ss so}", "algorithm", a->name,
                       "kind", hsr_own_kind(a)->name, "status",
                       results_text(d->cell, "status"), "mismatches",
                       (json_int_t)results_number(d->cell, "mismatches"),
                       "work", work ? d->work : NULL, "drawing", "difference",
                       "picture", d->file, "passes", passes_json(s, d, told));
}

/* A line drawing was judged when it was counted. */
static void tell_lines(struct drawing *d) {
  const struct hsr_algorithm *a = d->algorithm;
  d->entry = json_pack("{ss ss ss sI sn ss sn}", "algorithm", a->name, "kind",
                       hsr_own_kind(a)->name, "status",
                       results_text(d->cell, "status"), "mismatches",
                       (json_int_t)results_number(d->cell, "mismatches"),
                       "work", "drawing", d->file, "difference");
}

static enum hsr_status tell(struct sheet *s, struct drawing *d, uint32_t *ids,
                            struct hsr_error *err) {
  if (hsr_own_kind(d->algorithm)->by_faces)
    return tell_faces(s, d, ids, err);
  if (is_picture(hsr_own_kind(d->algorithm)))
    tell_picture(s, d, ids);
  else
    tell_lines(d);
  return HSR_OK;
}

/* --- All drawings --------------------------------------------------------- */

/* The oracle's drawing comes first; it is among the others if it has a cell. */
static enum hsr_status draw_oracle(struct sheet *s, struct hsr_error *err) {
  struct drawing alone = {.algorithm = oracle_of(HSR_IDS)};
  struct drawing *oracle = &alone;
  for (int k = 0; k < s->n_drawings; k++)
    if (!strcmp(s->drawing[k].algorithm->name, alone.algorithm->name))
      oracle = &s->drawing[k];
  struct drawer *drawer = &s->drawer[0];
  if (!start(s, drawer, oracle) || !wait_for_one(s, &drawer))
    return hsr_fail(err, HSR_E_REFUSED, "the oracle did not draw it in time");
  memcpy(s->wanted, drawer->ids, s->n * sizeof *s->wanted);
  return oracle == &alone ? HSR_OK : tell(s, oracle, drawer->ids, err);
}

static struct drawer *free_drawer(struct sheet *s) {
  for (int k = 0; k < s->n_drawers; k++)
    if (!s->drawer[k].process)
      return &s->drawer[k];
  return NULL;
}

static enum hsr_status draw_others(struct sheet *s, struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  for (int k = 0; !status;) {
    struct drawer *drawer = free_drawer(s);
    while (drawer && k < s->n_drawings && s->drawing[k].entry)
      k++;
    if (drawer && k < s->n_drawings && start(s, drawer, &s->drawing[k])) {
      k++;
      continue;
    }
    bool made = wait_for_one(s, &drawer);
    if (!drawer)
      break;
    if (made)
      status = tell(s, drawer->drawing, drawer->ids, err);
  }
  return status;
}

static bool same_bytes(const char *a, const char *b) {
  FILE *one = fopen(a, "rb"), *other = fopen(b, "rb");
  char x[1 << 14], y[1 << 14];
  bool same = one && other;
  for (size_t n = 1; same && n;) {
    n = fread(x, 1, sizeof x, one);
    same = n == fread(y, 1, sizeof y, other) && !memcmp(x, y, n);
  }
  if (one)
    fclose(one);
  if (other)
    fclose(other);
  return same;
}

/* Line drawings that are equal are kept once. */
static void keep_once(struct sheet *s, int k) {
  char own[PATH], earlier[PATH];
  path_of(s, s->drawing[k].file, own);
  for (int i = 0; i < k; i++) {
    if (!s->drawing[i].entry || hsr_own_kind(s->drawing[i].algorithm) !=
                                    hsr_own_kind(s->drawing[k].algorithm))
      continue;
    path_of(s, s->drawing[i].file, earlier);
    if (!same_bytes(own, earlier))
      continue;
    remove(own);
    strcpy(s->drawing[k].file, s->drawing[i].file);
    json_object_set_new(s->drawing[k].entry, "drawing",
                        json_string(s->drawing[i].file));
    return;
  }
}

/* --- The sheet ------------------------------------------------------------ */

bool is_shown(const struct hsr_algorithm *a) {
  return !(a->flags & HSR_NO_PICTURE) && (hsr_own_kind(a)->show_difference ||
                                          hsr_own_kind(a)->fits("drawing.svg"));
}

/* Lists the algorithms that have a cell, of faces or of others. */
static void list_drawings_of(struct sheet *s, bool faces) {
  for (const struct hsr_listed *a = hsr_algorithms(); a->plain; a++) {
    const json_t *cell = json_object_get(s->subject->cells, a->plain->name);
    if (!cell || (hsr_own_kind(a->plain)->show_difference != NULL) != faces)
      continue;
    struct drawing *d = &s->drawing[s->n_drawings++];
    *d = (struct drawing){.algorithm = a->counting, .cell = cell};
    const char *name = a->plain->name;
    int number = s->subject->number;
    bool picture = is_picture(hsr_own_kind(a->plain));
    snprintf(d->file, sizeof d->file, "%s/p%d-%s.%s",
             picture ? "pictures"
             : faces ? "work"
                     : "drawings",
             number, name, faces ? "png" : "svg");
    if (picture)
      snprintf(d->work, sizeof d->work, "work/p%d-%s.png", number, name);
  }
}

/* Line drawings come last: they take by far the longest. */
static bool list_drawings(struct sheet *s) {
  s->drawing =
      calloc(json_object_size(s->subject->cells) + 1, sizeof *s->drawing);
  if (s->drawing) {
    list_drawings_of(s, true);
    list_drawings_of(s, false);
  }
  return s->drawing;
}

/* The size of a picture: the shape of the results, but at most report->most
 * samples a row or column. */
static void size_of(const struct sheet *s, int *m, int *n) {
  long width = results_number(s->subject->view, "width"),
       height = results_number(s->subject->view, "height");
  double scale = fmin(1, (double)s->report->most /
                             fmax(1, fmax((double)width, (double)height)));
  *m = (int)fmax(1, nearbyint(scale * (double)width));
  *n = (int)fmax(1, nearbyint(scale * (double)height));
}

static enum hsr_status open_sheet(struct sheet *s, struct hsr_error *err) {
  int m, n;
  size_of(s, &m, &n);
  enum hsr_status status = stage_open(
      &s->stage, results_text(s->subject->view, "scene"), HSR_MOST_LAID_OUT,
      results_number(s->subject->view, "view"), m, n, 1, err);
  if (!status && hsr_is_roster(&s->stage.world))
    status = hsr_fail(err, HSR_E_REFUSED, "too many faces");
  if (status)
    return status;
  s->n = (size_t)m * (size_t)n;
  s->wanted = malloc(s->n * sizeof *s->wanted);
  s->depth = malloc(s->n * sizeof *s->depth);
  s->rgb = malloc(3 * s->n * sizeof *s->rgb);
  s->differences = json_object();
  bool good = s->wanted && s->depth && s->rgb && s->differences;
  s->n_drawers = (int)fmin(MOST_DRAWERS, (double)processors());
  for (int k = 0; k < s->n_drawers && good; k++)
    good = (s->drawer[k].ids = shared_memory(s->n * sizeof *s->wanted));
  return good && list_drawings(s) ? HSR_OK : hsr_fail_nomem(err);
}

static void close_sheet(struct sheet *s) {
  for (int k = 0; k < s->n_drawings; k++)
    json_decref(s->drawing[k].entry);
  free(s->drawing);
  for (int k = 0; k < s->n_drawers; k++)
    if (s->drawer[k].ids)
      munmap(s->drawer[k].ids, s->n * sizeof *s->wanted);
  json_decref(s->differences);
  free(s->rgb);
  free(s->depth);
  free(s->wanted);
  stage_close(&s->stage);
}

/* --- Its files ------------------------------------------------------------ */

static void name_picture(const struct sheet *s, char name[NAME]) {
  snprintf(name, NAME, "pictures/p%d.png", s->subject->number);
}

static enum hsr_status write_picture(struct sheet *s, struct hsr_error *err) {
  const struct hsr_view *view = &s->stage.view;
  hsr_picture_depth(&s->stage.world, view, s->wanted, s->depth);
  hsr_picture_shade(&s->stage.world, view, s->wanted, HSR_SHADE_LAMBERT,
                    s->rgb);
  char name[NAME], path[PATH];
  name_picture(s, name);
  path_of(s, name, path);
  struct hsr_picture picture = {
      .m = view->m, .n = view->n, .ids = s->wanted, .rgb = s->rgb};
  return hsr_image_write(path, &picture, NULL, err);
}

static json_t *entries_json(struct sheet *s) {
  json_t *entries = json_array();
  for (int k = 0; k < s->n_drawings; k++) {
    if (!s->drawing[k].entry)
      continue;
    if (!hsr_own_kind(s->drawing[k].algorithm)->show_difference)
      keep_once(s, k);
    hsr_json_append(&entries, json_incref(s->drawing[k].entry));
  }
  return entries;
}

static enum hsr_status write_entry(struct sheet *s, const char *key,
                                   const char *picture, const char *probe,
                                   struct hsr_error *err) {
  const json_t *view = s->subject->view;
  json_t *entry =
      json_pack("{ss ss sO si si si ss ss so}", "key", key, "scene",
                results_text(view, "scene"), "also", s->subject->twins, "view",
                (int)results_number(view, "view"), "width", s->stage.view.m,
                "height", s->stage.view.n, "picture", picture, "probe", probe,
                "entries", entries_json(s));
  if (!entry)
    return hsr_fail_nomem(err);
  bool good = !json_dumpf(entry, s->out, JSON_COMPACT);
  json_decref(entry);
  return good ? HSR_OK : hsr_fail(err, HSR_E_INTERNAL, "a pipe is broken");
}

static enum hsr_status write_data(struct sheet *s, struct hsr_error *err) {
  char key[NAME], picture[NAME], probe[NAME];
  snprintf(key, sizeof key, "p%d", s->subject->number);
  snprintf(probe, sizeof probe, "probe/p%d.js", s->subject->number);
  name_picture(s, picture);
  const struct pixels pixels = {.stage = &s->stage,
                                .ids = s->wanted,
                                .depth = s->depth,
                                .differences = s->differences};
  enum hsr_status status = probe_write(s->report, &pixels, key, probe, err);
  return status ? status : write_entry(s, key, picture, probe, err);
}

enum hsr_status subject_draw(const struct report *report,
                             const struct subject *subject, double seconds,
                             FILE *out, struct hsr_error *err) {
  struct sheet sheet = {.report = report,
                        .subject = subject,
                        .end = hsr_seconds_now() + seconds,
                        .out = out};
  alarm((unsigned)ceil(seconds)); /* a name may open what never ends */
  enum hsr_status status = open_sheet(&sheet, err);
  alarm(0);
  if (!status)
    status = draw_oracle(&sheet, err);
  /* This loads the library for images, which all drawers then have. */
  if (!status)
    status = write_picture(&sheet, err);
  if (!status)
    status = draw_others(&sheet, err);
  if (!status)
    status = write_data(&sheet, err);
  close_sheet(&sheet);
  return status;
}
