/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pixels of one scene and view, for the page's probe. */
#include "bench/results/page.h"
#include "bench/report/pictures.h"
#include "common/files/json/json.h"

#include <stdlib.h>

static json_t *base64_json(const void *bytes, size_t n) {
  char *text = base64_text(bytes, n);
  json_t *json = text ? json_string(text) : NULL;
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
    hsr_json_append(
        &objects,
        json_pack(
            "[sII]", name ? name : "", (json_int_t)world->roster.first[k],
            (json_int_t)(world->roster.first[k + 1] - world->roster.first[k])));
  }
  return objects;
}

enum hsr_status probe_write(const struct report *report,
                            const struct pixels *pixels, const char *key,
                            const char *name, struct hsr_error *err) {
  const struct hsr_view *view = &pixels->stage->view;
  size_t n = (size_t)view->m * (size_t)view->n;
  char before[64];
  snprintf(before, sizeof before, "hsrProbe(\"%.40s\", ", key);
  return report_write(
      report, name, before,
      json_pack("{si si so so so sO}", "width", view->m, "height", view->n,
                "ids", run_lengths_json(pixels->ids, n), "depth",
                base64_json(pixels->depth, n * sizeof *pixels->depth),
                "objects", objects_json(pixels->stage), "differences",
                pixels->differences),
      ");\n", err);
}
