/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pictures of a report. For every scene, view and algorithm they show the
 * work, and where the answer differs from the oracle's. Also the data that the
 * page's probe shows at a pixel. */
#include "bench/results/json.h"
#include "bench/judge/judge.h"
#include "bench/report/report.h"
#include "bench/run/stage.h"
#include "bench/run/terminate.h"

#include "common/answers/answer.h"
#include "common/files/image.h"
#include "common/view/picture.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

/* In a drawing of over MANY_LINES nobody would see the hidden ones. */
enum { NAME = 160, PATH = 4400, MANY_LINES = 30000 };

/* One scene and view. */
struct view_picture {
  const struct report *report;
  int number; /* from 0; names its files */
  struct stage stage;
  uint32_t *wanted, *got; /* ids of the oracle, of an algorithm; shared */
  float *depth, *rgb;     /* of `wanted`; a colour picture */
  size_t n;               /* samples */
  json_t *differences;    /* for the probe, by algorithm */
};

static void path_of(const struct view_picture *p, const char *name,
                    char path[PATH]) {
  snprintf(path, PATH, "%.4096s/%.200s", p->report->folder, name);
}

/* --- Drawing in another process ------------------------------------------- */

static enum hsr_status write_work(const struct view_picture *p,
                                  const char *name, const float *work,
                                  struct hsr_error *err) {
  char path[PATH];
  path_of(p, name, path);
  return hsr_image_write_work(path, p->stage.view.m, p->stage.view.n, work,
                              err);
}

/* The answer itself, as a file of its own kind. */
static enum hsr_status write_answer(const struct view_picture *p,
                                    const struct hsr_algorithm *a,
                                    const struct hsr_answer *answer,
                                    const char *name, struct hsr_error *err) {
  char path[PATH], description[200];
  const struct hsr_drawing *drawing = hsr_answer_drawing_of(answer);
  bool many = drawing && drawing->n > MANY_LINES;
  path_of(p, name, path);
  snprintf(description, sizeof description, "A line drawing by %.150s",
           a->title);
  struct hsr_showing showing = {.world = &p->stage.world,
                                .view = &p->stage.view,
                                .scene = p->stage.scene->name,
                                .title = p->stage.scene->name,
                                .description = description,
                                .supersamples = 1,
                                .hidden =
                                    many ? HSR_HIDDEN_NONE : HSR_HIDDEN_THIN,
                                .crease = -1};
  struct hsr_shaded shaded = {.rgb = NULL};
  const struct hsr_answer_type *kind = answer->form.type;
  enum hsr_status status =
      kind->shade ? kind->shade(answer, &showing, &shaded, err) : HSR_OK;
  if (!status)
    status = kind->write(answer, &showing, &shaded, path, err);
  hsr_shaded_free(&shaded);
  return status;
}

/* Draws with the counting build: only that writes the work picture. */
static enum hsr_status draw(struct view_picture *p,
                            const struct hsr_algorithm *a, const char *work,
                            const char *drawing, struct hsr_error *err) {
  struct hsr_setup setup;
  struct hsr_answer answer = {.body = NULL};
  struct hsr_tally tally = {.work = calloc(p->n, sizeof(float)),
                            .work_stride = (size_t)p->stage.view.m};
  enum hsr_status status = tally.work ? HSR_OK : hsr_fail_nomem(err);
  if (!status) {
    status = hsr_setup_init(&setup, a, NULL, &p->stage.world, err);
    if (!status)
      status = answer_init(&answer, &setup, &p->stage.view, err);
    if (!status)
      status =
          render_view(&setup, &p->stage.view, 1, &answer, &tally, NULL, err);
    hsr_setup_free(&setup);
  }
  const uint32_t *ids = status ? NULL : hsr_answer_ids_of(&answer);
  if (ids)
    memcpy(p->got, ids, p->n * sizeof *p->got);
  if (!status && work)
    status = write_work(p, work, tally.work, err);
  if (!status && drawing)
    status = write_answer(p, a, &answer, drawing, err);
  hsr_answer_free(&answer);
  free(tally.work);
  return status;
}

/* Draws in another process. Whether it finished in the time that a picture may
 * take. */
static bool draw_apart(struct view_picture *p, const struct hsr_algorithm *a,
                       const char *work, const char *drawing) {
  fflush(NULL);
  pid_t parent = getpid(), child = fork();
  if (child == 0) {
    end_with_parent(parent);
    alarm((unsigned)p->report->timeout);
    end_process((int)draw(p, a, work, drawing, NULL));
  }
  int end = 1;
  while (child > 0 && waitpid(child, &end, 0) < 0 && errno == EINTR) {
  }
  return child > 0 && WIFEXITED(end) && !WEXITSTATUS(end);
}

/* --- Differences ---------------------------------------------------------- */

/* [sample, id, depth] of every sample that differs. p->rgb is scratch for the
 * depths. */
static json_t *differences_json(struct view_picture *p, long *n) {
  json_t *list = json_array();
  *n = 0;
  hsr_picture_depth(&p->stage.world, &p->stage.view, p->got, p->rgb);
  for (size_t k = 0; k < p->n; k++)
    if (p->got[k] != p->wanted[k]) {
      ++*n;
      hsr_json_append(&list, json_pack("[IIo]", (json_int_t)k,
                                       p->got[k] == HSR_BACKGROUND
                                           ? (json_int_t)-1
                                           : (json_int_t)p->got[k],
                                       number_or_null((double)p->rgb[k])));
    }
  return list;
}

/* Where the picture differs from the oracle's. */
static enum hsr_status write_difference(struct view_picture *p,
                                        const char *name,
                                        struct hsr_error *err) {
  int m = p->stage.view.m, n = p->stage.view.n;
  struct hsr_answer got = hsr_answer_of_ids(p->got, m, n);
  struct hsr_answer wanted = hsr_answer_of_ids(p->wanted, m, n);
  struct hsr_comparison comparison = {
      .view = &p->stage.view, .got = &got, .wanted = &wanted, .n = p->n};
  struct hsr_showing showing = {.world = &p->stage.world,
                                .view = &p->stage.view};
  enum hsr_status status =
      got.form.type->show_difference(&comparison, &showing, p->rgb, err);
  char path[PATH];
  path_of(p, name, path);
  struct hsr_picture picture = {m, n, p->got, NULL, p->rgb};
  return status ? status : hsr_image_write(path, &picture, NULL, err);
}

/* --- One algorithm -------------------------------------------------------- */

/* The cell of this scene and view, of any size, that has a picture; or NULL. */
static const json_t *cell_with_picture(const struct view_picture *p,
                                       const json_t *view,
                                       const char *algorithm) {
  size_t k;
  const json_t *cell;
  json_array_foreach(p->report->results->cells, k, cell) {
    const char *status = results_text(cell, "status");
    if (!strcmp(results_text(cell, "algorithm"), algorithm) &&
        !strcmp(results_text(cell, "scene"), results_text(view, "scene")) &&
        results_number(cell, "view") == results_number(view, "view") &&
        (!strcmp(status, "ok") || !strcmp(status, "wrong")))
      return cell;
  }
  return NULL;
}

static enum hsr_status add_faces(struct view_picture *p,
                                 const struct hsr_algorithm *a, json_t *entries,
                                 struct hsr_error *err) {
  char work[NAME], difference[NAME];
  snprintf(work, sizeof work, "work/p%d-%s.png", p->number, a->name);
  snprintf(difference, sizeof difference, "difference/p%d-%s.png", p->number,
           a->name);
  if (!draw_apart(p, a, work, NULL))
    return HSR_OK;
  long n = 0;
  json_object_set_new(p->differences, a->name, differences_json(p, &n));
  enum hsr_status status = n ? write_difference(p, difference, err) : HSR_OK;
  if (!status)
    json_array_append_new(
        entries, json_pack("{ss ss ss sI ss sn ss?}", "algorithm", a->name,
                           "kind", a->kind->name, "status", n ? "wrong" : "ok",
                           "mismatches", (json_int_t)n, "work", work, "drawing",
                           "difference", n ? difference : NULL));
  return status;
}

static void add_drawing(struct view_picture *p, const struct hsr_algorithm *a,
                        const json_t *cell, json_t *entries) {
  char drawing[NAME];
  snprintf(drawing, sizeof drawing, "drawings/p%d-%s.svg", p->number, a->name);
  if (draw_apart(p, a, NULL, drawing))
    json_array_append_new(
        entries,
        json_pack("{ss ss ss sI sn ss sn}", "algorithm", a->name, "kind",
                  a->kind->name, "status", results_text(cell, "status"),
                  "mismatches", (json_int_t)results_number(cell, "mismatches"),
                  "work", "drawing", drawing, "difference"));
}

static enum hsr_status add_entries(struct view_picture *p, const json_t *view,
                                   json_t *entries, struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  for (const struct hsr_listed *a = hsr_algorithms; a->plain && !status; a++) {
    const json_t *cell = cell_with_picture(p, view, a->plain->name);
    if (!cell || a->plain->flags & HSR_NO_PICTURE)
      continue;
    if (a->counting->kind->show_difference)
      status = add_faces(p, a->counting, entries, err);
    else
      add_drawing(p, a->counting, cell, entries);
  }
  return status;
}

/* --- The probe ------------------------------------------------------------ */

/* Base64 as in RFC 4648. */
static json_t *base64_json(const void *bytes, size_t n) {
  static const char digit[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const unsigned char *byte = bytes;
  char *text = malloc((n + 2) / 3 * 4 + 1), *at = text;
  if (!text)
    return NULL;
  for (size_t k = 0; k < n; k += 3) {
    size_t left = n - k;
    unsigned group = (unsigned)byte[k] << 16 |
                     (left > 1 ? (unsigned)byte[k + 1] << 8 : 0) |
                     (left > 2 ? (unsigned)byte[k + 2] : 0);
    *at++ = digit[group >> 18];
    *at++ = digit[group >> 12 & 63];
    *at++ = left > 1 ? digit[group >> 6 & 63] : '=';
    *at++ = left > 2 ? digit[group & 63] : '=';
  }
  *at = '\0';
  json_t *json = json_string(text);
  free(text);
  return json;
}

/* id, how often, id, how often, ... row by row. */
static json_t *run_lengths_json(const uint32_t *ids, size_t n) {
  json_t *runs = json_array();
  for (size_t k = 0, end; k < n; k = end) {
    for (end = k + 1; end < n && ids[end] == ids[k];)
      end++;
    hsr_json_append(&runs, json_integer(ids[k] == HSR_BACKGROUND
                                            ? (json_int_t)-1
                                            : (json_int_t)ids[k]));
    hsr_json_append(&runs, json_integer((json_int_t)(end - k)));
  }
  return runs;
}

/* name, first face, number of faces, of every instance. */
static json_t *objects_json(const struct stage *stage) {
  const struct hsr_world *world = &stage->world;
  const struct hsr_scene *scene = stage->scene;
  json_t *objects = json_array();
  for (uint32_t k = 0; k < scene->n_instances; k++) {
    const char *name = scene->objects[scene->instances[k].object].name;
    hsr_json_append(&objects,
                    json_pack("[sII]", name ? name : "",
                              (json_int_t)world->outline.first[k],
                              (json_int_t)(world->outline.first[k + 1] -
                                           world->outline.first[k])));
  }
  return objects;
}

static enum hsr_status write_probe(struct view_picture *p, const char *name,
                                   struct hsr_error *err) {
  char before[64];
  snprintf(before, sizeof before, "hsrProbe(\"p%d\", ", p->number);
  hsr_picture_depth(&p->stage.world, &p->stage.view, p->wanted, p->depth);
  return report_write(p->report, name, before,
                      json_pack("{si si so so so sO}", "width", p->stage.view.m,
                                "height", p->stage.view.n, "ids",
                                run_lengths_json(p->wanted, p->n), "depth",
                                base64_json(p->depth, p->n * sizeof *p->depth),
                                "objects", objects_json(&p->stage),
                                "differences", p->differences),
                      ");\n", err);
}

/* --- One scene and view --------------------------------------------------- */

static enum hsr_status write_oracle(struct view_picture *p, const char *name,
                                    struct hsr_error *err) {
  if (!draw_apart(p, oracle_of(&hsr_answer_ids), NULL, NULL))
    return hsr_fail(err, HSR_E_INTERNAL, "%s: the oracle failed",
                    p->stage.scene->name);
  memcpy(p->wanted, p->got, p->n * sizeof *p->wanted);
  hsr_picture_shade(&p->stage.world, &p->stage.view, p->wanted,
                    HSR_SHADE_LAMBERT, p->rgb);
  char path[PATH];
  path_of(p, name, path);
  struct hsr_picture picture = {.m = p->stage.view.m,
                                .n = p->stage.view.n,
                                .ids = p->wanted,
                                .rgb = p->rgb};
  return hsr_image_write(path, &picture, NULL, err);
}

static enum hsr_status add_view(struct view_picture *p, const json_t *view,
                                json_t *pictures, struct hsr_error *err) {
  char key[NAME], picture[NAME], probe[NAME];
  snprintf(key, sizeof key, "p%d", p->number);
  snprintf(picture, sizeof picture, "pictures/p%d.png", p->number);
  snprintf(probe, sizeof probe, "probe/p%d.js", p->number);
  json_t *entries = json_array();
  enum hsr_status status =
      entries ? write_oracle(p, picture, err) : hsr_fail_nomem(err);
  if (!status)
    status = add_entries(p, view, entries, err);
  if (!status)
    status = write_probe(p, probe, err);
  if (!status &&
      json_array_append_new(pictures,
                            json_pack("{ss ss si si si ss ss sO}", "key", key,
                                      "scene", results_text(view, "scene"),
                                      "view", (int)results_number(view, "view"),
                                      "width", p->stage.view.m, "height",
                                      p->stage.view.n, "picture", picture,
                                      "probe", probe, "entries", entries)))
    status = hsr_fail_nomem(err);
  json_decref(entries);
  return status;
}

/* The size of a picture: the shape of the results, but at most report->most
 * samples a row or column. */
static void size_of(const struct report *report, const json_t *view, int *m,
                    int *n) {
  long width = results_number(view, "width"),
       height = results_number(view, "height");
  double scale =
      fmin(1, (double)report->most / fmax((double)width, (double)height));
  *m = (int)fmax(1, nearbyint(scale * (double)width));
  *n = (int)fmax(1, nearbyint(scale * (double)height));
}

static enum hsr_status open_view(struct view_picture *p, const json_t *view,
                                 struct hsr_error *err) {
  int m, n;
  size_of(p->report, view, &m, &n);
  enum hsr_status status =
      stage_open(&p->stage, results_text(view, "scene"), HSR_MOST_LAID_OUT,
                 results_number(view, "view"), m, n, err);
  if (status)
    return status;
  p->n = (size_t)m * (size_t)n;
  p->wanted = malloc(p->n * sizeof *p->wanted);
  p->got = shared_memory(p->n * sizeof *p->got);
  p->depth = malloc(p->n * sizeof *p->depth);
  p->rgb = malloc(3 * p->n * sizeof *p->rgb);
  p->differences = json_object();
  return p->wanted && p->got && p->depth && p->rgb && p->differences
             ? HSR_OK
             : hsr_fail_nomem(err);
}

static void close_view(struct view_picture *p) {
  json_decref(p->differences);
  free(p->rgb);
  free(p->depth);
  if (p->got)
    munmap(p->got, p->n * sizeof *p->got);
  free(p->wanted);
  stage_close(&p->stage);
}

/* --- All ------------------------------------------------------------------ */

/* Whether no earlier record is of the same scene and view. */
static bool is_first(const json_t *views, size_t k) {
  const json_t *view = json_array_get(views, k);
  for (size_t i = 0; i < k; i++) {
    const json_t *other = json_array_get(views, i);
    if (!strcmp(results_text(view, "scene"), results_text(other, "scene")) &&
        results_number(view, "view") == results_number(other, "view"))
      return false;
  }
  return true;
}

static void show_progress(size_t k, size_t all, const json_t *view) {
  if (!isatty(STDERR_FILENO))
    return;
  fprintf(stderr, "\r\033[K");
  if (view)
    fprintf(stderr, "pictures, %zu of %zu: %s", k + 1, all,
            results_text(view, "scene"));
  fflush(stderr);
}

json_t *report_pictures(const struct report *report, struct hsr_error *err) {
  const json_t *views = report->results->views;
  json_t *pictures = json_array();
  enum hsr_status status = pictures ? HSR_OK : hsr_fail_nomem(err);
  int number = 0;
  for (size_t k = 0; k < json_array_size(views) && !status; k++) {
    const json_t *view = json_array_get(views, k);
    if (!is_first(views, k))
      continue;
    show_progress(k, json_array_size(views), view);
    struct view_picture p = {.report = report, .number = number++};
    status = open_view(&p, view, err);
    if (!status && !hsr_is_outline(&p.stage.world)) /* else no picture */
      status = add_view(&p, view, pictures, err);
    close_view(&p);
  }
  show_progress(0, 0, NULL);
  if (!status)
    return pictures;
  json_decref(pictures);
  return NULL;
}
