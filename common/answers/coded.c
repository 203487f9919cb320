/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/answers/coded.h"

#include <math.h>

const char
    *const hsr_subject_ids[HSR_N_SUBJECT_KINDS][HSR_MOST_SUBJECT_IDS + 1] = {
        [HSR_OF_NOTHING] = {NULL},
        [HSR_OF_FACE] = {"face"},
        [HSR_OF_PIECE] = {"face", "piece"},
        [HSR_OF_EDGE] = {"vertex", "vertex", "face"},
        [HSR_OF_IMPLIED] = {"face", "face", "part"},
        [HSR_OF_VERTEX] = {"vertex"},
        [HSR_OF_VOLUME] = {"volume"},
        [HSR_OF_CELL] = {"level", "x", "y"},
        [HSR_OF_WINDOW] = {NULL}};

json_t *hsr_runs_json(const uint32_t *value, size_t n, uint32_t none) {
  json_t *runs = json_array();
  for (size_t k = 0, next; k < n; k = next) {
    for (next = k + 1; next < n && value[next] == value[k];)
      next++;
    hsr_json_append(&runs,
                    value[k] == none ? json_null() : json_integer(value[k]));
    hsr_json_append(&runs, json_integer((json_int_t)(next - k)));
  }
  return runs;
}

json_t *hsr_channels_json(const uint16_t *channel, size_t n) {
  json_t *all = json_array();
  for (size_t k = 0; all && k < n; k++)
    if (json_array_append_new(all, json_integer(channel[k]))) {
      json_decref(all);
      return NULL;
    }
  return all;
}

json_t *hsr_subject_json(struct hsr_subject subject) {
  if (subject.kind == HSR_OF_NOTHING)
    return json_null();
  json_t *coded = json_array();
  hsr_json_append(&coded, json_integer(subject.kind));
  for (int k = 0; hsr_subject_ids[subject.kind][k]; k++)
    hsr_json_append(&coded, subject.id[k] == HSR_NO_ID
                                ? json_null()
                                : json_integer(subject.id[k]));
  return coded;
}

/* Multiples of 1/64 are exact and short in decimals. + 0 makes a 0 of -0. */
json_t *hsr_image_json(const struct hsr_view *view, const double image[3]) {
  double w = hsr_view_w(view, image);
  double x = rint(64 * image[0] / w) / 64 + 0,
         y = rint(64 * image[1] / w) / 64 + 0;
  return isfinite(x) && isfinite(y) ? json_pack("[ff]", x, y) : json_null();
}

json_t *hsr_point_json(const struct hsr_view *view, const double point[3]) {
  double image[3];
  hsr_view_project(view, point, image);
  return image[2] > view->near ? hsr_image_json(view, image) : json_null();
}
