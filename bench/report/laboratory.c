/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The laboratory beside the pages, and which scenes of the results it can make. */
#include "bench/report/report.h"
#include "bench/results/page.h"
#include "common/files/json/json.h"
#include "scenes/scenes.h"

#include <stdio.h>
#include <unistd.h>

static bool is_in(const json_t *names, const char *name) {
  size_t k;
  const json_t *one;
  json_array_foreach(
      names, k, one) if (json_string_value(one) &&
                         !strcmp(json_string_value(one), name)) return true;
  return false;
}

static json_t *scenes_json(const struct results *results) {
  json_t *names = json_array();
  size_t k;
  const json_t *view;
  json_array_foreach(results->views, k, view) {
    const char *name = results_text(view, "scene");
    if (hsr_is_made_by_name(name) && !is_in(names, name))
      hsr_json_append(&names, json_string(name));
  }
  return names;
}

enum hsr_status report_laboratory(const struct report *report, json_t *data,
                                  struct hsr_error *err) {
  char folder[PAGE_FOLDER], path[PAGE_FOLDER + 16];
  const char *from = path;
  find_page(REPORT_LABORATORY, folder);
  snprintf(path, sizeof path, "%s/%s", folder, REPORT_LABORATORY);
  if (access(path, R_OK))
    return HSR_OK;
  enum hsr_status status =
      report_join(&from, 1, report->folder, REPORT_LABORATORY, err);
  if (status)
    return status;
  return json_object_set_new(data, "laboratory",
                             json_pack("{ss so}", "file", REPORT_LABORATORY,
                                       "scenes", scenes_json(report->results)))
             ? hsr_fail_nomem(err)
             : HSR_OK;
}
