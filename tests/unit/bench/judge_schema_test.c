/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What hsr judge --json prints obeys docs/schemas/judge.schema.json, and a drawing that
 * hsr render writes docs/schemas/drawing.schema.json. Both schemas are strict. */
#include "bench/stranger/lines.h"
#include "bench/stranger/stranger.h"
#include "tests/schema.h"
#include "tests/tap.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* --- Files ---------------------------------------------------------------- */

static void enter_folder(void) {
  static char folder[] = "/tmp/hsr-test-XXXXXX";
  if (!mkdtemp(folder) || chdir(folder))
    bail("no folder");
}

/* Runs hsr with these words, and says nothing of its status. */
static void run(const char *words) {
  char text[4096];
  snprintf(text, sizeof text, "'%s' %s", getenv("HSR"), words);
  if (system(text) < 0)
    bail("%s", text);
}

/* What is printed for a picture of the house; a new reference. */
static json_t *judged(const char *words) {
  char text[1000];
  snprintf(text, sizeof text, "judge %s --json >judged 2>&1", words);
  run(text);
  json_t *value = json_load_file("judged", JSON_REJECT_DUPLICATES, NULL);
  if (!value)
    bail("hsr %s: no JSON", text);
  return value;
}

/* Writes the drawing a.json anew, with the numbers of all hidden intervals one
 * higher. */
static void spoil_drawing(void) {
  json_t *drawing = json_load_file("a.json", 0, NULL), *segment;
  size_t k;
  json_array_foreach(json_object_get(drawing, "segments"), k, segment) {
    json_int_t n = json_integer_value(json_object_get(segment, "invisibility"));
    json_object_set_new(segment, "invisibility", json_integer(n ? n + 1 : 0));
  }
  if (json_dump_file(drawing, "b.json", 0))
    bail("b.json");
  json_decref(drawing);
}

/* --- Schemas -------------------------------------------------------------- */

/* The words that a schema admits as the kind of a reason. */
static bool has_kind(const json_t *schema, const char *reason,
                     const char *key) {
  const json_t *rule = json_object_get(
      json_object_get(json_object_get(json_object_get(schema, "$defs"), reason),
                      "properties"),
      "kind");
  const json_t *word;
  size_t k;
  bool found = false;
  json_array_foreach(json_object_get(rule, "enum"), k, word) found |=
      !strcmp(json_string_value(word), key);
  return found;
}

static bool has_all_kinds(const json_t *schema) {
  bool good = true;
  for (int k = 0; k < STRANGER_KINDS; k++)
    good &= has_kind(schema, "reason", stranger_kinds[k].key);
  for (int k = 0; k < LINE_KINDS; k++)
    good &= has_kind(schema, "line_reason", line_key((enum line_kind)k));
  return good;
}

static long number(const json_t *of, const char *key) {
  return (long)json_integer_value(json_object_get(of, key));
}

/* Whether no reason may lack a field, or have one more. */
static bool is_strict_of_reasons(const json_t *schema, const json_t *judged) {
  json_t *spoilt = json_deep_copy(judged);
  json_t *reason = json_array_get(json_object_get(spoilt, "reasons"), 0);
  bool good = schema_admits(schema, spoilt);
  json_object_set_new(reason, "more", json_integer(1));
  good = good && !schema_admits(schema, spoilt);
  json_object_del(reason, "more");
  json_object_del(reason, "words");
  good = good && !schema_admits(schema, spoilt);
  json_decref(spoilt);
  return good;
}

static void test_pictures(struct tap *tap, const json_t *schema) {
  run("render house -s 40x30 -o a.npy >/dev/null 2>&1");
  json_t *right = judged("house a.npy");
  json_t *wrong = judged("house a.npy --view 3");
  ok(tap, schema_admits(schema, right) && !number(right, "wrong"),
     "a right picture");
  ok(tap, schema_admits(schema, wrong) && number(wrong, "wrong") > 0,
     "a wrong one");
  ok(tap, is_strict_of_reasons(schema, wrong), "its reasons have all fields");
  ok(tap, schema_needs_all(schema, right), "every field is needed");
  ok(tap, schema_needs_all(schema, wrong), "those of a wrong one, too");
}

static void test_drawings(struct tap *tap, const json_t *schema,
                          const json_t *of_drawing) {
  run("render penetration -s 40x30 -a appel -o a.json >/dev/null 2>&1");
  spoil_drawing();
  json_t *drawing = json_load_file("a.json", JSON_REJECT_DUPLICATES, NULL);
  json_t *right = judged("penetration a.json");
  json_t *wrong = judged("penetration b.json");
  ok(tap, drawing && schema_admits(of_drawing, drawing), "a drawing");
  json_object_set_new(drawing, "more", json_integer(1));
  ok(tap, !schema_admits(of_drawing, drawing), "no other field is known");
  ok(tap, schema_admits(schema, right) && !number(right, "wrong"),
     "a right one is judged");
  ok(tap,
     schema_admits(schema, wrong) && is_strict_of_reasons(schema, wrong) &&
         number(wrong, "wrong") > 0,
     "and a wrong one");
  json_decref(drawing);
  json_decref(right);
  json_decref(wrong);
}

int main(void) {
  struct tap tap = plan(10);
  if (!getenv("HSR"))
    bail("HSR is not set");
  json_t *schema = schema_open("judge.schema.json");
  json_t *of_drawing = schema_open("drawing.schema.json");
  enter_folder();
  ok(&tap, has_all_kinds(schema), "the schema has all kinds of faults");
  test_pictures(&tap, schema);
  test_drawings(&tap, schema, of_drawing);
  json_decref(schema);
  json_decref(of_drawing);
  return finish(&tap);
}
