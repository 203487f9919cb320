/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pages on which algorithms can be watched: the lessons through the survey,
 * and one of each of the first small scenes of the results. */
#include "bench/modules/variant.h"
#include "bench/lesson/lesson.h"
#include "bench/report/report.h"
#include "bench/run/terminate.h"
#include "common/base/clock.h"
#include "common/files/json/json.h"
#include "common/files/whole_file.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* Of a scene to watch; and of a run: more steps are not worth a page. */
enum { MOST_SCENES = 3, MOST_FACES = 500, MOST_SIDE = 128, MOST_RUNS = 16 };
static const double MOST_STEPS = 400000;

struct lesson_runs {
  const json_t *view; /* the record of the scene and view */
  struct scene_options scene;
  struct view_options options;
  int n;
  struct hsr_variant variant[MOST_RUNS];
  struct lesson_subject subject[MOST_RUNS];
};

/* How many steps a cell counted, were it as large as a lesson. */
static double steps_of(const json_t *cell, const struct view_options *view) {
  double sum = 0;
  const char *name;
  json_t *count;
  json_object_foreach(json_object_get(cell, "counts"), name, count) sum +=
      json_number_value(count);
  double samples = (double)results_number(cell, "width") *
                   (double)results_number(cell, "height");
  return samples > 0 && sum > 0 ? sum * view->m * view->n / samples : INFINITY;
}

static bool is_there(const struct lesson_runs *runs, const char *name) {
  for (int k = 0; k < runs->n; k++)
    if (!strcmp(runs->variant[k].name, name))
      return true;
  return false;
}

/* Adds the cell's algorithm, if its picture was right and its steps are
 * told. */
static void add_run(struct lesson_runs *runs, const json_t *cell) {
  struct hsr_error err;
  const char *name = results_text(cell, "algorithm");
  struct hsr_variant *variant = &runs->variant[runs->n];
  if (runs->n == MOST_RUNS || is_there(runs, name) ||
      strcmp(results_text(cell, "status"), "ok") != 0 ||
      strcmp(results_text(cell, "scene"), results_text(runs->view, "scene")) !=
          0 ||
      hsr_variant_parse(name, variant, &err) ||
      lib_check_trace(variant, &err) ||
      steps_of(cell, &runs->options) > MOST_STEPS)
    return;
  runs->subject[runs->n++] =
      (struct lesson_subject){&runs->scene, &runs->options, variant};
}

/* The view's size, shrunk to that of a lesson. */
static void fit(const json_t *view, struct view_options *options) {
  long m = results_number(view, "width"), n = results_number(view, "height");
  long most = m > n ? m : n;
  long wanted = most > MOST_SIDE ? MOST_SIDE : most;
  options->view = results_number(view, "view");
  options->m = most > 0 ? (int)((m * wanted + most - 1) / most) : 0;
  options->n = most > 0 ? (int)((n * wanted + most - 1) / most) : 0;
}

/* As far as the record says. */
static bool is_small(const json_t *view) {
  const json_t *faces = json_object_get(json_object_get(view, "table1"), "F_t");
  return json_is_number(faces) && json_number_value(faces) <= MOST_FACES &&
         results_number(view, "view") > 0 &&
         results_number(view, "width") > 0 &&
         results_number(view, "height") > 0;
}

static json_t *names_json(const struct lesson_runs *runs) {
  json_t *names = json_array();
  for (int k = 0; k < runs->n; k++)
    hsr_json_append(&names, json_string(runs->variant[k].name));
  return names;
}

/* Writes the page in another process, in so many seconds at most: what the
 * records say of the scene may be false, and to open it may take long. Whether
 * the page is there. */
static bool write_page(const struct lesson_page *page, double seconds) {
  fflush(NULL);
  pid_t parent = getpid(), child = fork();
  if (child == 0) {
    struct hsr_error err;
    end_with_parent(parent);
    alarm((unsigned)ceil(seconds));
    end_process((int)lesson_write(page, &err));
  }
  int end = 1;
  while (child > 0 && waitpid(child, &end, 0) < 0 && errno == EINTR) {
  }
  if (end)
    hsr_whole_file_forget(page->path);
  return !end;
}

/* Writes the page of one scene, and adds it to the list. A scene that cannot be
 * shown is left out. */
static void add_page(const struct report *report, const json_t *view,
                     const char *lab, double seconds, json_t **pages) {
  struct lesson_runs *runs = calloc(1, sizeof *runs);
  if (!runs)
    return;
  runs->view = view;
  runs->scene.name = results_text(view, "scene");
  runs->options = (struct view_options)VIEW_OPTIONS_STANDARD;
  fit(view, &runs->options);
  size_t k;
  const json_t *cell;
  json_array_foreach(report->results->cells, k, cell) add_run(runs, cell);
  char file[32], path[4200];
  snprintf(file, sizeof file, "lesson-%zu.html", json_array_size(*pages));
  snprintf(path, sizeof path, "%.4096s/%s", report->folder, file);
  struct lesson_page page = {.path = path,
                             .subject = runs->subject,
                             .n = runs->n,
                             .lab = scene_is_made_by_name(&runs->scene) ? lab
                                                                        : NULL,
                             .limits = {MOST_FACES, LESSON_STANDARD_EVENTS}};
  if (runs->n && write_page(&page, seconds))
    hsr_json_append(pages,
                    json_pack("{ss ss so}", "file", file, "scene",
                              runs->scene.name, "names", names_json(runs)));
  free(runs);
}

static bool is_in(const json_t *pages, const char *scene) {
  size_t k;
  const json_t *page;
  json_array_foreach(pages, k, page) if (!strcmp(results_text(page, "scene"),
                                                 scene)) return true;
  return false;
}

enum hsr_status report_lessons(const struct report *report, json_t *data,
                               struct hsr_error *err) {
  static const char survey[] = "lessons.html";
  char path[4200];
  snprintf(path, sizeof path, "%.4096s/%s", report->folder, survey);
  const char *lab =
      json_object_get(data, "laboratory") ? REPORT_LABORATORY : NULL;
  enum hsr_status status =
      lesson_survey(path, LESSON_STANDARD_EVENTS, lab, err);
  if (status)
    return status;
  json_t *pages = json_array();
  hsr_json_append(&pages, json_pack("{ss sn so}", "file", survey, "scene",
                                    "names", lesson_survey_names()));
  double end = hsr_seconds_now() + (double)report->budget;
  size_t k;
  const json_t *view;
  json_array_foreach(report->results->views, k, view) {
    double left = end - hsr_seconds_now();
    if (left > 0 && json_array_size(pages) <= MOST_SCENES && is_small(view) &&
        !is_in(pages, results_text(view, "scene")))
      add_page(report, view, lab, left / 2, &pages);
  }
  return json_object_set_new(data, "lessons", pages) ? hsr_fail_nomem(err)
                                                     : HSR_OK;
}
