/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pictures of a report. Scenes of few faces come first; what comes when the
 * time is over is left out, and the page says so.
 *
 * Each scene and view is drawn by another process. A scene is a name out of a
 * file of results: opening it may take long, or never end. */
#include "config.h"

#include "bench/report/pictures.h"
#include "bench/modules/modules.h"
#include "bench/run/terminate.h"
#include "bench/terminal/terminal.h"
#include "common/base/clock.h"
#include "common/files/json/json.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { KEY = RESULTS_MOST_SCENE + 32, TELL_MS = 500 };

/* All scenes and views, and how far the work is. */
struct gallery {
  const struct report *report;
  json_t *cells; /* key of a scene and view -> algorithm -> its cell */
  struct subject *subject;
  size_t n, drawings; /* subjects; drawings of all */
  size_t done;        /* drawings made, or left out with their subject */
  double end;
  struct progress progress;
  json_t *slow; /* algorithms that took too long; of larger scenes they make
                   no drawing */
  json_t *pictures, *left_out;
};

/* --- What there is to draw ------------------------------------------------ */

static void key_of(const json_t *record, char key[KEY]) {
  snprintf(key, KEY, "%ld %.*s", results_number(record, "view"),
           (int)RESULTS_MOST_SCENE, results_text(record, "scene"));
}

static bool has_picture(const json_t *cell) {
  const char *status = results_text(cell, "status");
  const struct hsr_listed *listed =
      hsr_algorithm_find(results_text(cell, "algorithm"));
  return listed && is_shown(listed->plain) &&
         (!strcmp(status, "ok") || !strcmp(status, "wrong"));
}

/* Of every scene, view and algorithm the first cell that has a picture. Of a
 * view without any, an empty object. */
static bool find_cells(struct gallery *g) {
  char key[KEY];
  size_t k;
  json_t *record;
  g->cells = json_object();
  json_array_foreach(g->report->results->views, k, record) {
    key_of(record, key);
    if (!json_object_get(g->cells, key))
      json_object_set_new(g->cells, key, json_object());
  }
  json_array_foreach(g->report->results->cells, k, record) {
    if (!has_picture(record))
      continue;
    key_of(record, key);
    json_t *own = json_object_get(g->cells, key);
    const char *algorithm = results_text(record, "algorithm");
    if (own && !json_object_get(own, algorithm))
      json_object_set(own, algorithm, record);
  }
  return g->cells;
}

static int by_faces(const void *a, const void *b) {
  const struct subject *one = a, *other = b;
  if (one->faces != other->faces)
    return one->faces < other->faces ? -1 : 1;
  return one->number - other->number;
}

static double faces_of(const json_t *view) {
  const json_t *faces = json_object_get(json_object_get(view, "table1"), "F_t");
  return json_is_number(faces) ? json_number_value(faces) : INFINITY;
}

/* A scene that another name has made already is not drawn again. */
static void add_subject(struct gallery *g, json_t *numbers,
                        const json_t *view) {
  char own[KEY], key[KEY];
  key_of(view, own);
  json_t *cells = json_object_get(g->cells, own);
  if (json_object_get(numbers, own))
    return; /* the same in another size */
  snprintf(key, KEY, "%.64s %ld %ldx%ld", results_text(view, "scene_hash"),
           results_number(view, "view"), results_number(view, "width"),
           results_number(view, "height"));
  const json_t *number = json_object_get(numbers, key);
  size_t k = number ? (size_t)json_integer_value(number) : g->n;
  json_object_set_new(numbers, own, json_integer((json_int_t)k));
  json_object_set_new(numbers, key, json_integer((json_int_t)k));
  if (number) {
    json_array_append(g->subject[k].twins, json_object_get(view, "scene"));
    json_object_update_missing(g->subject[k].cells, cells);
    return;
  }
  g->subject[g->n++] = (struct subject){.view = view,
                                        .cells = cells,
                                        .twins = json_array(),
                                        .faces = faces_of(view),
                                        .number = (int)k};
}

static bool find_subjects(struct gallery *g) {
  const json_t *views = g->report->results->views;
  json_t *numbers = json_object();
  g->subject = calloc(json_array_size(views) + 1, sizeof *g->subject);
  size_t k;
  json_t *view;
  if (g->subject)
    json_array_foreach(views, k, view) add_subject(g, numbers, view);
  for (k = 0; k < g->n; k++)
    g->drawings += json_object_size(g->subject[k].cells);
  json_decref(numbers);
  if (g->subject)
    qsort(g->subject, g->n, sizeof *g->subject, by_faces);
  return g->subject;
}

/* --- One scene and view --------------------------------------------------- */

static void leave_out(struct gallery *g, const struct subject *s, size_t n,
                      const char *why) {
  hsr_json_append(&g->left_out,
                  json_pack("{ss si sI ss}", "scene",
                            results_text(s->view, "scene"), "view",
                            (int)results_number(s->view, "view"), "drawings",
                            (json_int_t)n, "why", why));
}

/* A scene gets half of the time that is left, so that all get some; the last
 * one gets all. */
static double share_of(const struct gallery *g, const struct subject *s) {
  double left = fmax(0, g->end - hsr_seconds_now());
  return s == &g->subject[g->n - 1] ? left : left / 2;
}

/* In the other process. Writes the page's entry; or, if there is none, why. */
static void draw_and_end(const struct gallery *g, const struct subject *s,
                         pid_t parent, int out) {
  end_with_parent(parent);
  struct hsr_error err = {.text = ""};
  FILE *file = fdopen(out, "w");
  enum hsr_status status =
      file ? subject_draw(g->report, s, share_of(g, s), file, &err)
           : hsr_fail_nomem(&err);
  if (file && status)
    fputs(err.text, file);
  end_process((int)status);
}

/* What the other process writes, while its progress is told; NULL for lack of
 * memory. */
static char *listen_to(struct gallery *g, const struct subject *s, int from) {
  char *text = NULL;
  size_t size = 0;
  FILE *all = open_memstream(&text, &size);
  ssize_t n = 1;
  while (all && n > 0) {
    struct pollfd ready = {.fd = from, .events = POLLIN};
    char block[1 << 12];
    progress_tell(&g->progress, g->done, g->drawings, "drawings",
                  results_text(s->view, "scene"));
    if (poll(&ready, 1, TELL_MS) <= 0)
      continue;
    n = read(from, block, sizeof block);
    for (ssize_t k = 0; k < n; k++)
      g->done += block[k] == '\n';
    if (n > 0)
      fwrite(block, 1, (size_t)n, all);
  }
  if (!all || fclose(all)) {
    free(text);
    return NULL;
  }
  return text;
}

static void note_slow(struct gallery *g, const struct subject *s,
                      const json_t *entries) {
  const char *name;
  json_t *value;
  json_object_foreach(s->cells, name, value)
      json_object_set_new(g->slow, name, json_true());
  size_t k;
  json_array_foreach(entries, k, value)
      json_object_del(g->slow, results_text(value, "algorithm"));
}

static void leave_out_slow(struct gallery *g, const struct subject *s) {
  const char *name;
  json_t *slow;
  json_object_foreach(g->slow, name, slow) json_object_del(s->cells, name);
}

/* Adds the entry that the other process wrote. */
static enum hsr_status add_entry(struct gallery *g, const struct subject *s,
                                 size_t wanted, const char *text) {
  json_t *entry = json_loads(text, 0, NULL);
  if (!entry)
    return HSR_E_INTERNAL;
  const json_t *entries = json_object_get(entry, "entries");
  if (json_array_size(entries) < wanted)
    leave_out(g, s, wanted - json_array_size(entries), "not drawn in time");
  note_slow(g, s, entries);
  hsr_json_append(&g->pictures, entry);
  return HSR_OK;
}

static enum hsr_status end_of(pid_t child) {
  int end = 1;
  while (waitpid(child, &end, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(end) ? (enum hsr_status)WEXITSTATUS(end) : HSR_E_REFUSED;
}

/* A scene that cannot be drawn is left out. Only a lack of memory ends the
 * report. */
static enum hsr_status draw_subject(struct gallery *g, const struct subject *s,
                                    struct hsr_error *err) {
  int pipe[2];
  if (pipe2(pipe, O_CLOEXEC))
    return hsr_fail(err, HSR_E_INTERNAL, "pictures: %s", strerror(errno));
  size_t before = g->done, wanted = json_object_size(s->cells);
  leave_out_slow(g, s);
  fflush(NULL);
  pid_t parent = getpid(), child = fork();
  if (child == 0)
    draw_and_end(g, s, parent, pipe[1]);
  close(pipe[1]);
  char *text = listen_to(g, s, pipe[0]);
  close(pipe[0]);
  enum hsr_status status = child > 0 ? end_of(child) : HSR_E_NOMEM;
  g->done = before + wanted;
  if (!status)
    status = text ? add_entry(g, s, wanted, text) : HSR_E_NOMEM;
  const char *why = text ? text + strspn(text, "\n") : "";
  if (status && status != HSR_E_NOMEM)
    leave_out(g, s, wanted, *why ? why : "it could not be opened in time");
  free(text);
  return status == HSR_E_NOMEM ? hsr_fail_nomem(err) : HSR_OK;
}

/* --- All ------------------------------------------------------------------ */

static enum hsr_status draw_subjects(struct gallery *g, struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  g->progress = progress_begin(stderr);
  for (size_t k = 0; k < g->n && !status; k++) {
    const struct subject *s = &g->subject[k];
    if (hsr_seconds_now() < g->end) {
      status = draw_subject(g, s, err);
    } else {
      g->done += json_object_size(s->cells);
      leave_out(g, s, json_object_size(s->cells), "no time was left");
    }
  }
  progress_end(&g->progress);
  return status;
}

/* What is missing, and how to get it. */
static void say_what_is_missing(const struct gallery *g) {
  size_t n = 0, k;
  const json_t *one;
  json_array_foreach(g->left_out, k, one) n +=
      (size_t)results_number(one, "drawings");
  if (json_array_size(g->left_out))
    printf("%zu of %zu drawings are left out (index.html says which); more "
           "time for them: --budget SECONDS, --timeout SECONDS\n",
           n, g->drawings);
}

enum hsr_status report_pictures(const struct report *report, json_t *data,
                                struct hsr_error *err) {
  struct gallery g = {.report = report,
                      .end = hsr_seconds_now() + (double)report->budget,
                      .slow = json_object(),
                      .pictures = json_array(),
                      .left_out = json_array()};
  enum hsr_status status = HSR_OK;
  if (report->budget && find_cells(&g) && find_subjects(&g))
    status = draw_subjects(&g, err);
  if (!status && report->budget && !g.subject)
    status = hsr_fail_nomem(err);
  if (!status)
    say_what_is_missing(&g);
  if (json_object_set(data, "pictures", g.pictures) ||
      json_object_set(data, "left_out", g.left_out))
    status = status ? status : hsr_fail_nomem(err);
  for (size_t k = 0; k < g.n; k++)
    json_decref(g.subject[k].twins);
  json_decref(g.left_out);
  json_decref(g.pictures);
  json_decref(g.slow);
  json_decref(g.cells);
  free(g.subject);
  return status;
}
