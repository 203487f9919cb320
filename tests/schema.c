/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tests/schema.h"
#include "tests/tap.h"

#include <regex.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Stops the test if something that it needs, but does not test, fails. */
static void need(bool done, const char *what) {
  if (!done)
    bail("docs: %s", what);
}

json_t *schema_open(const char *name) {
  const char *source = getenv("HSR_SOURCE");
  need(source != NULL, "HSR_SOURCE is not set");
  char path[4096];
  snprintf(path, sizeof path, "%s/docs/schemas/%s", source, name);
  json_t *schema = json_load_file(path, JSON_REJECT_DUPLICATES, NULL);
  need(schema != NULL, path);
  return schema;
}

/* --- Keywords ------------------------------------------------------------- */

static const json_t *schema; /* the one whose rules are applied */

static bool is_valid(const json_t *rule, const json_t *value);

static const json_t *resolve(const char *reference) {
  static const char prefix[] = "#/$defs/";
  need(!strncmp(reference, prefix, sizeof prefix - 1), reference);
  const json_t *rule = json_object_get(json_object_get(schema, "$defs"),
                                       reference + sizeof prefix - 1);
  need(rule != NULL, reference);
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

/* The first items have their own rules, in order. */
static bool are_first_items(const json_t *rules, const json_t *value) {
  size_t k;
  const json_t *item;
  json_array_foreach(value, k, item) {
    const json_t *rule = json_array_get(rules, k);
    if (rule && !is_valid(rule, item))
      return false;
  }
  return true;
}

/* The items after them all have one rule. */
static bool are_items(const json_t *rule, size_t first, const json_t *value) {
  size_t k;
  const json_t *item;
  json_array_foreach(value, k, item) {
    if (k >= first && !is_valid(rule, item))
      return false;
  }
  return true;
}

static bool matches(const char *pattern, const char *text) {
  regex_t regex;
  need(!regcomp(&regex, pattern, REG_EXTENDED | REG_NOSUB), pattern);
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
  if (IS("prefixItems"))
    return !json_is_array(value) || are_first_items(wanted, value);
  if (IS("items"))
    return !json_is_array(value) ||
           are_items(wanted,
                     json_array_size(json_object_get(rule, "prefixItems")),
                     value);
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
  if (IS("maximum") || IS("exclusiveMaximum")) {
    double x = json_number_value(value), limit = json_number_value(wanted);
    return !json_is_number(value) || (IS("maximum") ? x <= limit : x < limit);
  }
  if (IS("pattern"))
    return !json_is_string(value) ||
           matches(json_string_value(wanted), json_string_value(value));
  bail("The schema uses '%s', which is not known here", keyword);
}

static bool is_valid(const json_t *rule, const json_t *value) {
  if (json_is_boolean(rule))
    return json_is_true(rule);
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

bool schema_admits(const json_t *of, const json_t *value) {
  schema = of;
  return is_valid(of, value);
}

/* --- Spoiling ------------------------------------------------------------- */

bool schema_needs_all(const json_t *of, json_t *record) {
  bool good = schema_admits(of, record);
  const char *name;
  json_t *value;
  void *next;
  json_object_foreach_safe(record, next, name, value) {
    json_t *spoilt = json_copy(record);
    json_object_del(spoilt, name);
    if (schema_admits(of, spoilt)) {
      printf("# still valid without '%s'\n", name);
      good = false;
    }
    json_object_set_new(spoilt, name, json_pack("[[[]]]"));
    if (schema_admits(of, spoilt)) {
      printf("# still valid with a list of lists for '%s'\n", name);
      good = false;
    }
    json_decref(spoilt);
  }
  json_object_set_new(record, "more", json_true());
  good = good && !schema_admits(of, record);
  json_decref(record);
  return good;
}
