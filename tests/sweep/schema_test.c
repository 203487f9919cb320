/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What hsr bench writes is what docs/bench.schema.json says, and that says
 * enough: a record that is spoilt anywhere is none. */
#include "tests/sweep/sweeping.h"

#include <regex.h>
#include <stdlib.h>
#include <string.h>

/* --- A validator -------------------------------------------------------------
 * Of those keywords of JSON Schema, draft 2020-12, that the schema uses; one
 * that is not known here stops the test.
 */

static json_t *schema;

static bool is_valid(const json_t *rule, const json_t *value);

static const json_t *resolve(const char *reference) {
  static const char prefix[] = "#/$defs/";
  must(!strncmp(reference, prefix, sizeof prefix - 1));
  const json_t *rule = json_object_get(json_object_get(schema, "$defs"),
                                       reference + sizeof prefix - 1);
  must(rule != NULL);
  return rule;
}

static bool is_of_type(const char *type, const json_t *value) {
  return (!strcmp(type, "object") && json_is_object(value)) ||
         (!strcmp(type, "array") && json_is_array(value)) ||
         (!strcmp(type, "string") && json_is_string(value)) ||
         (!strcmp(type, "integer") && json_is_integer(value)) ||
         (!strcmp(type, "number") && json_is_number(value)) ||
         (!strcmp(type, "boolean") && json_is_boolean(value)) ||
         (!strcmp(type, "null") && json_is_null(value));
}

static bool is_of_types(const json_t *types, const json_t *value) {
  if (json_is_string(types))
    return is_of_type(json_string_value(types), value);
  size_t k;
  const json_t *type;
  json_array_foreach(types, k, type) if (is_of_type(json_string_value(type),
                                                    value)) return true;
  return false;
}

static size_t count_valid(const json_t *rules, const json_t *value) {
  size_t k, n = 0;
  const json_t *rule;
  json_array_foreach(rules, k, rule) n += is_valid(rule, value);
  return n;
}

static bool is_one_of(const json_t *values, const json_t *value) {
  size_t k;
  const json_t *one;
  json_array_foreach(values, k, one) if (json_equal(one, value)) return true;
  return false;
}

static bool has_all(const json_t *value, const json_t *names) {
  size_t k;
  const json_t *name;
  json_array_foreach(
      names, k,
      name) if (!json_object_get(value, json_string_value(name))) return false;
  return true;
}

static bool are_properties(const json_t *rule, const json_t *value) {
  const json_t *known = json_object_get(rule, "properties"),
               *others = json_object_get(rule, "additionalProperties");
  const char *name;
  json_t *property;
  json_object_foreach((json_t *)value, name, property) {
    const json_t *own = json_object_get(known, name);
    if (own ? !is_valid(own, property)
            : json_is_false(others) ||
                  (json_is_object(others) && !is_valid(others, property)))
      return false;
  }
  return true;
}

static bool are_items(const json_t *rule, const json_t *value) {
  size_t k;
  const json_t *item;
  json_array_foreach(value, k, item) if (!is_valid(rule, item)) return false;
  return true;
}

static bool matches(const char *pattern, const char *text) {
  regex_t regex;
  must(!regcomp(&regex, pattern, REG_EXTENDED | REG_NOSUB));
  bool found = !regexec(&regex, text, 0, NULL, 0);
  regfree(&regex);
  return found;
}

static bool meets(const char *keyword, const json_t *wanted, const json_t *rule,
                  const json_t *value) {
#define IS(word) (!strcmp(keyword, word))
  if (IS("$ref"))
    return is_valid(resolve(json_string_value(wanted)), value);
  if (IS("oneOf"))
    return count_valid(wanted, value) == 1;
  if (IS("anyOf"))
    return count_valid(wanted, value) > 0;
  if (IS("type"))
    return is_of_types(wanted, value);
  if (IS("const"))
    return json_equal(wanted, value);
  if (IS("enum"))
    return is_one_of(wanted, value);
  if (IS("required"))
    return !json_is_object(value) || has_all(value, wanted);
  if (IS("properties") || IS("additionalProperties"))
    return !json_is_object(value) || are_properties(rule, value);
  if (IS("items"))
    return !json_is_array(value) || are_items(wanted, value);
  if (IS("minItems") || IS("maxItems")) {
    json_int_t n = (json_int_t)json_array_size(value),
               limit = json_integer_value(wanted);
    return !json_is_array(value) || (IS("minItems") ? n >= limit : n <= limit);
  }
  if (IS("minLength") || IS("maxLength")) {
    json_int_t n = (json_int_t)json_string_length(value),
               limit = json_integer_value(wanted);
    return !json_is_string(value) ||
           (IS("minLength") ? n >= limit : n <= limit);
  }
  if (IS("minimum") || IS("exclusiveMinimum")) {
    double x = json_number_value(value), limit = json_number_value(wanted);
    return !json_is_number(value) || (IS("minimum") ? x >= limit : x > limit);
  }
  if (IS("pattern"))
    return !json_is_string(value) ||
           matches(json_string_value(wanted), json_string_value(value));
  printf("Bail out! The schema uses '%s', which is not known here\n", keyword);
  exit(99);
}

static bool is_valid(const json_t *rule, const json_t *value) {
  const char *keyword;
  json_t *wanted;
  json_object_foreach((json_t *)rule, keyword, wanted) {
    static const char *const comments[] = {"$schema", "title", "description",
                                           "$defs"};
    bool comment = false;
    for (int k = 0; k < 4; k++)
      comment |= !strcmp(keyword, comments[k]);
    if (!comment && !meets(keyword, wanted, rule, value))
      return false;
  }
  return true;
}

/* --- Records -------------------------------------------------------------- */

/* How many lines of the file are records; *others, those that are not. */
static long count_records(const char *path, const char *kind, long *others) {
  FILE *file = fopen(path, "r");
  must(file != NULL);
  long good = 0;
  *others = 0;
  json_t *record;
  while ((record = json_loadf(file, JSON_DISABLE_EOF_CHECK, NULL))) {
    bool valid = is_valid(schema, record);
    const char *is = json_string_value(json_object_get(record, "record"));
    good += valid && is && !strcmp(is, kind);
    *others += !valid;
    if (!valid) {
      char *text = json_dumps(record, JSON_COMPACT);
      printf("# not valid: %s\n", text);
      free(text);
    }
    json_decref(record);
  }
  fclose(file);
  return good;
}

static json_t *find_record(const char *path, const char *kind,
                           const char *algorithm) {
  struct results r = read_results(path);
  const json_t *records = !strcmp(kind, "header") ? r.headers
                          : !strcmp(kind, "view") ? r.views
                                                  : r.cells;
  size_t k;
  const json_t *record;
  json_t *copy = NULL;
  json_array_foreach(records, k, record) {
    const char *name = json_string_value(json_object_get(record, "algorithm"));
    if (!copy && (!algorithm || (name && !strcmp(name, algorithm))))
      copy = json_deep_copy(record);
  }
  results_free(&r);
  must(copy != NULL);
  return copy;
}

/* Whether the record is valid, and none without any one of its fields, with a
 * field of another type, or with one more. */
static bool is_spoilt_by_all(json_t *record) {
  bool good = is_valid(schema, record);
  const char *name;
  json_t *value;
  void *next;
  json_object_foreach_safe(record, next, name, value) {
    json_t *spoilt = json_copy(record);
    json_object_del(spoilt, name);
    if (is_valid(schema, spoilt)) {
      printf("# still valid without '%s'\n", name);
      good = false;
    }
    json_object_set_new(spoilt, name, json_pack("[[[]]]"));
    if (is_valid(schema, spoilt)) {
      printf("# still valid with a list of lists for '%s'\n", name);
      good = false;
    }
    json_decref(spoilt);
  }
  json_object_set_new(record, "more", json_true());
  good = good && !is_valid(schema, record);
  json_decref(record);
  return good;
}

/* A cell that shows a time. */
static bool may_have_times(const char *status, bool peer) {
  json_t *cell = find_record("f.ndjson", "cell", "zbuffer");
  json_object_set_new(cell, "status", json_string(status));
  json_object_set_new(cell, "peer", json_boolean(peer));
  bool valid = is_valid(schema, cell);
  json_decref(cell);
  return valid;
}

/* A walk is told of by cells and views alike: two views at least. */
static bool is_walk(const char *path, const char *kind) {
  json_t *record = find_record(path, kind, NULL);
  bool good = is_valid(schema, record) &&
              json_integer_value(json_object_get(record, "walk")) == 2;
  json_object_set_new(record, "walk", json_integer(1));
  good = good && !is_valid(schema, record);
  json_object_set_new(record, "walk", json_string("2"));
  good = good && !is_valid(schema, record);
  json_decref(record);
  return good;
}

int main(void) {
  struct tap tap = plan(12);
  const char *source = getenv("HSR_SOURCE"), *hsr = getenv("HSR");
  must(source && hsr);
  char text[8192];
  snprintf(text, sizeof text, "%s/docs/bench.schema.json", source);
  schema = json_load_file(text, JSON_REJECT_DUPLICATES, NULL);
  must(schema != NULL);
  enter_folder();

  bench("house --size 64x48 -a 'null,zbuffer,broken,crasher,staller' -t 1 "
        "-T 1,2 --starts 2 --repetitions 2 -o f.ndjson");
  long others, n = count_records("f.ndjson", "cell", &others);
  ok(&tap, n == 10 && !others, "timed and failed cells: %ld", n);
  n = count_records("f.ndjson", "view", &others);
  ok(&tap, n == 1, "a view");
  n = count_records("f.ndjson", "header", &others);
  ok(&tap, n == 1, "a header");
  snprintf(text, sizeof text,
           "'%s' bench house soup:500 penetration --counts --size 20x14 "
           "-o all.ndjson >out",
           hsr);
  must(system(text) >= 0);
  n = count_records("all.ndjson", "cell", &others);
  ok(&tap, n > 60 && !others, "all algorithms counted: %ld", n);

  ok(&tap, is_spoilt_by_all(find_record("f.ndjson", "header", NULL)),
     "every field of a header is needed");
  ok(&tap, is_spoilt_by_all(find_record("f.ndjson", "view", NULL)),
     "every field of a view");
  ok(&tap, is_spoilt_by_all(find_record("f.ndjson", "cell", "zbuffer")),
     "every field of a cell");
  ok(&tap, may_have_times("ok", false), "what is right has times");
  ok(&tap, may_have_times("wrong", true), "a peer has, though it is wrong");
  ok(&tap, !may_have_times("wrong", false) && !may_have_times("crash", false),
     "nothing else has");

  bench("house --size 64x48 -a zbuffer:window=20,zbuffer:filter=box,broken "
        "--walk 2 --starts 2 --repetitions 1 -o w.ndjson");
  n = count_records("w.ndjson", "cell", &others);
  ok(&tap, n == 3 && !others, "cells of a walk, of an algorithm with options");
  ok(&tap, is_walk("w.ndjson", "cell") && is_walk("w.ndjson", "view"),
     "both kinds of record tell how long it is");
  json_decref(schema);
  return finish(&tap);
}
