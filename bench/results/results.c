/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/results/results.h"
#include "common/files/json/json_read.h"

#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void results_free(struct results *results) {
  json_decref(results->headers);
  json_decref(results->views);
  json_decref(results->cells);
  json_decref(results->places);
  *results = (struct results){.headers = NULL};
}

const char *results_text(const json_t *record, const char *field) {
  const char *text = json_string_value(json_object_get(record, field));
  return text ? text : "";
}

long results_number(const json_t *record, const char *field) {
  return (long)json_integer_value(json_object_get(record, field));
}

void results_view_name(long view, long walk, char name[RESULTS_VIEW]) {
  if (walk > 1)
    snprintf(name, RESULTS_VIEW, "%ld-%ld", view, view + walk - 1);
  else
    snprintf(name, RESULTS_VIEW, "%ld", view);
}

int results_picture_key(const char *scene, long view, long walk, long m, long n,
                        char key[RESULTS_KEY]) {
  char name[RESULTS_VIEW];
  results_view_name(view, walk, name);
  return snprintf(key, RESULTS_KEY, "%.*s %s %ldx%ld", (int)RESULTS_MOST_SCENE,
                  scene, name, m, n);
}

void results_key(const json_t *record, char key[RESULTS_KEY]) {
  int length = results_picture_key(
      results_text(record, "scene"), results_number(record, "view"),
      results_number(record, "walk"), results_number(record, "width"),
      results_number(record, "height"), key);
  if (json_object_get(record, "algorithm"))
    snprintf(key + length, (size_t)(RESULTS_KEY - length), " %.*s %ld",
             (int)RESULTS_MOST_NAME, results_text(record, "algorithm"),
             results_number(record, "threads"));
}

static const json_t *find(const struct results *results, const json_t *array,
                          const char *key) {
  const json_t *place = json_object_get(results->places, key);
  return place ? json_array_get(array, (size_t)json_integer_value(place))
               : NULL;
}

const json_t *results_view(const struct results *results, const char *key) {
  return find(results, results->views, key);
}

const json_t *results_cell(const struct results *results, const char *key) {
  return find(results, results->cells, key);
}

const struct hsr_listed *results_listed(const char *variant) {
  char name[RESULTS_MOST_NAME + 1];
  snprintf(name, sizeof name, "%.*s", (int)strcspn(variant, ":"), variant);
  return hsr_algorithm_find(name);
}

double results_count(const json_t *cell, const char *key) {
  const struct hsr_listed *listed =
      results_listed(results_text(cell, "algorithm"));
  const struct hsr_counter *c = listed ? listed->plain->counters : NULL;
  while (c && c->name && !hsr_has_key(c, key))
    c++;
  const json_t *count =
      c && c->name ? json_object_get(json_object_get(cell, "counts"), c->name)
                   : NULL;
  return json_is_integer(count) ? (double)json_integer_value(count) : NAN;
}

/* --- Reading -------------------------------------------------------------- */

/* Adds a record, or replaces an earlier one of the same key. Takes a new
 * reference. False for lack of memory. */
static bool keep(struct results *results, json_t *array, json_t *record) {
  char key[RESULTS_KEY];
  results_key(record, key);
  const json_t *place = json_object_get(results->places, key);
  if (place)
    return !json_array_set(array, (size_t)json_integer_value(place), record);
  return !json_object_set_new(
             results->places, key,
             json_integer((json_int_t)json_array_size(array))) &&
         !json_array_append(array, record);
}

/* Whether the name is there and fits whole into a key. */
static bool has_name(const json_t *record, const char *field, size_t most) {
  size_t length = json_string_length(json_object_get(record, field));
  return length > 0 && length <= most;
}

static bool make_room(struct results *results) {
  if (!results->headers) {
    results->headers = json_array();
    results->views = json_array();
    results->cells = json_array();
    results->places = json_object();
  }
  return results->headers && results->views && results->cells &&
         results->places;
}

enum hsr_status results_add(struct results *results, json_t *record,
                            struct hsr_error *err) {
  if (!make_room(results))
    return hsr_fail_nomem(err);
  const char *what = results_text(record, "record");
  bool kept;
  if (!strcmp(what, "header") &&
      !strcmp(results_text(record, "schema"), "hsr-bench/1"))
    kept = !json_array_append(results->headers, record);
  else if (!strcmp(what, "view") &&
           has_name(record, "scene", RESULTS_MOST_SCENE) &&
           !json_object_get(record, "algorithm"))
    kept = keep(results, results->views, record);
  else if (!strcmp(what, "cell") &&
           has_name(record, "scene", RESULTS_MOST_SCENE) &&
           has_name(record, "algorithm", RESULTS_MOST_NAME))
    kept = keep(results, results->cells, record);
  else
    return hsr_fail(err, HSR_E_INPUT, "not a record of the schema hsr-bench/1");
  return kept ? HSR_OK : hsr_fail_nomem(err);
}

static enum hsr_status add_line(struct results *results, const char *line,
                                size_t length, const char *path, long number,
                                struct hsr_error *err) {
  json_error_t error;
  bool out_of_memory;
  json_t *record = hsr_json_read_text(line, length, JSON_REJECT_DUPLICATES,
                                      &out_of_memory, &error);
  if (out_of_memory)
    return hsr_fail_nomem(err);
  struct hsr_error why = {.text = "not a line of JSON"};
  enum hsr_status status =
      record ? results_add(results, record, &why) : HSR_E_INPUT;
  json_decref(record);
  if (!status)
    return HSR_OK;
  return status == HSR_E_NOMEM
             ? hsr_fail_nomem(err)
             : hsr_fail(err, status, "%.200s:%ld: %s", path, number, why.text);
}

static enum hsr_status read_lines(struct results *results, FILE *file,
                                  const char *path, struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  char *line = NULL;
  size_t size = 0;
  errno = 0;
  for (long number = 1; !status; number++) {
    ssize_t length = getline(&line, &size, file);
    if (length < 0 || line[length - 1] != '\n')
      break;
    status = add_line(results, line, (size_t)length, path, number, err);
  }
  if (!status && errno == ENOMEM)
    status = hsr_fail_nomem(err);
  if (!status && ferror(file))
    status = hsr_fail(err, HSR_E_INPUT, "%s: %s", path, strerror(errno));
  free(line);
  return status;
}

enum hsr_status results_read(struct results *results, const char *path,
                             struct hsr_error *err) {
  if (!make_room(results))
    return hsr_fail_nomem(err);
  FILE *file = fopen(path, "r");
  if (!file)
    return hsr_fail(err, HSR_E_INPUT, "%s: %s", path, strerror(errno));
  enum hsr_status status = read_lines(results, file, path, err);
  fclose(file);
  return status;
}
