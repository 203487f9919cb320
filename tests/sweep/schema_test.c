/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The records of hsr bench obey docs/schemas/bench.schema.json. The schema is strict: a
 * record that is spoilt anywhere does not obey it. */
#include "tests/schema.h"
#include "tests/sweep/sweeping.h"

#include <stdlib.h>
#include <string.h>

static json_t *schema;

/* --- Records -------------------------------------------------------------- */

/* How many valid records of this kind the file has; *others becomes the number
 * of lines that are not valid. */
static long count_records(const char *path, const char *kind, long *others) {
  FILE *file = fopen(path, "r");
  must(file != NULL);
  long good = 0;
  *others = 0;
  json_t *record;
  while ((record = json_loadf(file, JSON_DISABLE_EOF_CHECK, NULL))) {
    bool valid = schema_admits(schema, record);
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

/* Whether a cell of this status may have times. */
static bool may_have_times(const char *status, bool peer) {
  json_t *cell = find_record("f.ndjson", "cell", "zbuffer-fast");
  json_object_set_new(cell, "status", json_string(status));
  json_object_set_new(cell, "peer", json_boolean(peer));
  bool valid = schema_admits(schema, cell);
  json_decref(cell);
  return valid;
}

/* Both cells and views record a walk, of at least two views. */
static bool is_walk(const char *path, const char *kind) {
  json_t *record = find_record(path, kind, NULL);
  bool good = schema_admits(schema, record) &&
              json_integer_value(json_object_get(record, "walk")) == 2;
  json_object_set_new(record, "walk", json_integer(1));
  good = good && !schema_admits(schema, record);
  json_object_set_new(record, "walk", json_string("2"));
  good = good && !schema_admits(schema, record);
  json_decref(record);
  return good;
}

int main(void) {
  struct tap tap = plan(13);
  const char *hsr = getenv("HSR");
  must(hsr != NULL);
  schema = schema_open("bench.schema.json");
  enter_folder();

  bench("house --size 64x48 -a 'null,zbuffer-fast,broken,crasher,staller' -t 1 "
        "-T 1,2 --starts 2 --repetitions 2 -o f.ndjson");
  long others, n = count_records("f.ndjson", "cell", &others);
  ok(&tap, n == 10 && !others, "timed and failed cells: %ld", n);
  n = count_records("f.ndjson", "view", &others);
  ok(&tap, n == 1, "a view");
  n = count_records("f.ndjson", "header", &others);
  ok(&tap, n == 1, "a header");
  char text[8192];
  snprintf(text, sizeof text,
           "'%s' bench house soup:500 penetration --counts "
           "--size 20x14 "
           "-o all.ndjson >out",
           hsr);
  must(system(text) >= 0);
  n = count_records("all.ndjson", "cell", &others);
  ok(&tap, n > 60 && !others, "all algorithms counted: %ld", n);

  snprintf(
      text, sizeof text,
      "'%s' bench checker-cube:4 -a "
      "splat,splat-sheet,splat-volume,splat-xray,pbtf --counts --size 20x14 "
      "-o g.ndjson >out",
      hsr);
  must(system(text) >= 0);
  n = count_records("g.ndjson", "cell", &others);
  ok(&tap, n == 5 && !others, "those too that draw grids: %ld", n);

  ok(&tap, schema_needs_all(schema, find_record("f.ndjson", "header", NULL)),
     "every field of a header is needed");
  ok(&tap, schema_needs_all(schema, find_record("f.ndjson", "view", NULL)),
     "every field of a view");
  ok(&tap,
     schema_needs_all(schema, find_record("f.ndjson", "cell", "zbuffer-fast")),
     "every field of a cell");
  ok(&tap, may_have_times("ok", false), "what is right has times");
  ok(&tap, may_have_times("wrong", true), "a peer has, though it is wrong");
  ok(&tap, !may_have_times("wrong", false) && !may_have_times("crash", false),
     "nothing else has");

  bench("house --size 64x48 -a "
        "zbuffer-fast:window=20,zbuffer-fast:filter=box,broken "
        "--walk 2 --starts 2 --repetitions 1 -o w.ndjson");
  n = count_records("w.ndjson", "cell", &others);
  ok(&tap, n == 3 && !others, "cells of a walk, of an algorithm with options");
  ok(&tap, is_walk("w.ndjson", "cell") && is_walk("w.ndjson", "view"),
     "both kinds of record tell how long it is");
  json_decref(schema);
  return finish(&tap);
}
