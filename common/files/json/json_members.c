/* SPDX-License-Identifier: GPL-3.0-or-later */
#define _GNU_SOURCE /* memmem */
#include "common/files/json/json_members.h"

#include "common/base/names.h"
#include "common/files/json/json_file.h"
#include "common/files/whole_input.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

struct hsr_json_node hsr_json_member(const struct hsr_json_node *of,
                                     const char *key) {
  return (struct hsr_json_node){of->input, json_object_get(of->value, key), of,
                                key, 0};
}

struct hsr_json_node hsr_json_element(const struct hsr_json_node *of,
                                      size_t index) {
  return (struct hsr_json_node){of->input, json_array_get(of->value, index), of,
                                NULL, index};
}

/* ---- Messages ---- */

/* Appends to a text in a buffer of `size` bytes what of a key has room, as a
 * JSON pointer (RFC 6901) has it. */
static void append_key(char *text, size_t size, const char *key) {
  size_t n = strlen(text);
  for (; *key && n + 3 < size; key++) {
    if (*key == '~' || *key == '/')
      text[n++] = '~';
    text[n++] = (char)(*key == '~' ? '0' : *key == '/' ? '1' : *key);
  }
  text[n] = '\0';
}

static void append_pointer(char *text, size_t size,
                           const struct hsr_json_node *at) {
  if (!at->up)
    return;
  append_pointer(text, size, at->up);
  size_t n = strlen(text);
  if (at->key) {
    snprintf(text + n, size - n, "/");
    append_key(text, size, at->key);
  } else {
    snprintf(text + n, size - n, "/%zu", at->index);
  }
}

enum hsr_status hsr_json_refuse(const struct hsr_json_node *at,
                                const char *format, ...) {
  char pointer[128] = "", text[200];
  append_pointer(pointer, sizeof pointer, at);
  va_list args;
  va_start(args, format);
  vsnprintf(text, sizeof text, format, args);
  va_end(args);
  return hsr_fail(at->input->err, HSR_E_INPUT, "%s: %s%s%s",
                  hsr_path_shown(at->input->path), pointer, at->up ? ": " : "",
                  text);
}

enum hsr_status hsr_json_wrong_kind(const struct hsr_json_node *at,
                                    const char *expected) {
  return hsr_json_refuse(at, "must be %s, not %s", expected,
                         hsr_json_kind(at->value));
}

enum hsr_status hsr_json_nomem(const struct hsr_json_node *at) {
  return hsr_fail_nomem(at->input->err);
}

/* ---- Values ---- */

enum hsr_status hsr_json_bool(const struct hsr_json_node *at, void *to) {
  if (!json_is_boolean(at->value))
    return hsr_json_wrong_kind(at, "true or false");
  *(bool *)to = json_is_true(at->value);
  return HSR_OK;
}

enum hsr_status hsr_json_string(const struct hsr_json_node *at, void *to) {
  if (!json_is_string(at->value))
    return hsr_json_wrong_kind(at, "a string");
  *(const char **)to = json_string_value(at->value);
  return HSR_OK;
}

enum hsr_status hsr_json_number(const struct hsr_json_node *at, void *to) {
  if (!json_is_number(at->value))
    return hsr_json_wrong_kind(at, "a number");
  *(double *)to = json_number_value(at->value);
  return HSR_OK;
}

enum hsr_status hsr_json_share(const struct hsr_json_node *at, void *to) {
  double *share = to;
  enum hsr_status status = hsr_json_number(at, share);
  return status || (*share >= 0 && *share <= 1)
             ? status
             : hsr_json_refuse(at, "%.9g is not between 0 and 1", *share);
}

enum hsr_status hsr_json_array(const struct hsr_json_node *at, void *to) {
  (void)to;
  return json_is_array(at->value) ? HSR_OK
                                  : hsr_json_wrong_kind(at, "an array");
}

enum hsr_status hsr_json_numbers(const struct hsr_json_node *at, size_t n,
                                 hsr_json_take *take, double *to) {
  enum hsr_status status = hsr_json_array(at, NULL);
  size_t size = json_array_size(at->value);
  if (!status && size != n)
    return hsr_json_refuse(at, "must have %zu numbers, not %zu", n, size);
  for (size_t i = 0; i < n && !status; i++) {
    struct hsr_json_node number = hsr_json_element(at, i);
    status = take(&number, &to[i]);
  }
  return status;
}

enum hsr_status hsr_json_point(const struct hsr_json_node *at, void *to) {
  return hsr_json_numbers(at, 3, hsr_json_number, to);
}

enum hsr_status hsr_json_matrix(const struct hsr_json_node *at, void *to) {
  return hsr_json_numbers(at, 12, hsr_json_number, to);
}

enum hsr_status hsr_json_whole(const struct hsr_json_node *at, int least,
                               int most, int *to) {
  double number = 0;
  enum hsr_status status = hsr_json_number(at, &number);
  if (status)
    return status;
  if (!(number >= least && number <= most) || number != floor(number))
    return hsr_json_refuse(at, "%.9g is no whole number from %d to %d", number,
                           least, most);
  *to = (int)number;
  return HSR_OK;
}

/* ---- Members and elements ---- */

static enum hsr_status check_keys(const struct hsr_json_node *at,
                                  const struct hsr_json_rule *rules) {
  const char *key;
  json_t *value;
  json_object_foreach(at->value, key, value) {
    const struct hsr_json_rule *rule = rules;
    while (rule->key && strcmp(rule->key, key))
      rule++;
    if (rule->key)
      continue;
    char hint[100] = "";
    hsr_names_like_of(rules, sizeof *rules, key, hint, sizeof hint);
    struct hsr_json_node unknown = hsr_json_member(at, key);
    return hsr_json_refuse(&unknown, "unknown key%s", hint);
  }
  return HSR_OK;
}

static enum hsr_status check_beside(const struct hsr_json_node *at,
                                    const struct hsr_json_rule *rule) {
  struct hsr_json_node here = hsr_json_member(at, rule->key);
  for (int k = 0; k < 2 && here.value && rule->beside[k]; k++)
    if (json_object_get(at->value, rule->beside[k]))
      return hsr_json_refuse(&here, "cannot stand beside '%s'",
                             rule->beside[k]);
  return HSR_OK;
}

static enum hsr_status check_present(const struct hsr_json_node *at,
                                     const struct hsr_json_rule *rule) {
  return !rule->required || json_object_get(at->value, rule->key)
             ? HSR_OK
             : hsr_json_refuse(at, "'%s' is missing", rule->key);
}

static enum hsr_status take_member(const struct hsr_json_node *at,
                                   const struct hsr_json_rule *rule) {
  struct hsr_json_node here = hsr_json_member(at, rule->key);
  return here.value && rule->take ? rule->take(&here, rule->to) : HSR_OK;
}

enum hsr_status hsr_json_object(const struct hsr_json_node *at,
                                const struct hsr_json_rule *rules) {
  if (!json_is_object(at->value))
    return hsr_json_wrong_kind(at, "an object");
  enum hsr_status status = check_keys(at, rules);
  for (const struct hsr_json_rule *r = rules; r->key && !status; r++)
    status = check_beside(at, r);
  for (const struct hsr_json_rule *r = rules; r->key && !status; r++)
    status = check_present(at, r);
  for (const struct hsr_json_rule *r = rules; r->key && !status; r++)
    status = take_member(at, r);
  return status;
}

enum hsr_status hsr_json_elements(const struct hsr_json_node *at,
                                  hsr_json_take *take, void *to) {
  enum hsr_status status = hsr_json_array(at, NULL);
  for (size_t k = 0; k < json_array_size(at->value) && !status; k++) {
    struct hsr_json_node element = hsr_json_element(at, k);
    status = take(&element, to);
  }
  return status;
}

/* ---- Files ---- */

static enum hsr_status parse(const struct hsr_json_input *input,
                             struct hsr_json_part part, size_t flags,
                             const hsr_json_levels *levels,
                             struct hsr_json_part *list, json_t **value) {
  bool out_of_memory;
  json_error_t error;
  flags |= JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL;
  *value =
      hsr_json_read_part(part, flags, levels, list, &out_of_memory, &error);
  if (out_of_memory)
    return hsr_fail_nomem(input->err);
  return *value ? HSR_OK
                : hsr_fail(input->err, HSR_E_INPUT, "%s:%d: %s",
                           hsr_path_shown(input->path), error.line, error.text);
}

/* Cuts the file to what stands between two marks. */
static enum hsr_status cut(const struct hsr_json_input *input,
                           struct hsr_json_part *file) {
  const size_t size = strlen(input->begin);
  const char *end = file->text + file->length;
  const char *begin = memmem(file->text, file->length, input->begin, size);
  const char *stop = begin ? memmem(begin + size, (size_t)(end - begin) - size,
                                    input->end, strlen(input->end))
                           : NULL;
  if (!stop)
    return hsr_fail(input->err, HSR_E_INPUT, "%s: has no %s...%s",
                    hsr_path_shown(input->path), input->begin, input->end);
  file->line += hsr_json_lines(file->text, begin);
  file->text = begin + size;
  file->length = (size_t)(stop - file->text);
  return HSR_OK;
}

enum hsr_status hsr_json_open(const struct hsr_json_input *input,
                              const hsr_json_levels *levels,
                              struct hsr_json_part *list, char **text,
                              json_t **root) {
  struct hsr_json_part file = {.line = 1};
  enum hsr_status status =
      hsr_json_load(input->path, text, &file.length, input->err);
  file.text = *text;
  if (!status && input->begin)
    status = cut(input, &file);
  return status ? status : parse(input, file, 0, levels, list, root);
}

enum hsr_status hsr_json_check_schema(const struct hsr_json_node *root,
                                      const char *known) {
  if (!json_is_object(root->value))
    return hsr_json_wrong_kind(root, "an object");
  struct hsr_json_node schema = hsr_json_member(root, "schema");
  const char *text = "";
  if (!schema.value)
    return hsr_json_refuse(root, "'schema' is missing: it must be '%s'", known);
  enum hsr_status status = hsr_json_string(&schema, &text);
  return status || !strcmp(text, known)
             ? status
             : hsr_json_refuse(&schema, "must be '%s', not '%.60s'", known,
                               text);
}

enum hsr_status hsr_json_next_value(const struct hsr_json_input *input,
                                    struct hsr_json_part *elements,
                                    const hsr_json_levels *levels,
                                    struct hsr_json_part *list,
                                    json_t **value) {
  struct hsr_json_part element;
  json_decref(*value);
  *value = NULL;
  return hsr_json_next(elements, &element)
             ? parse(input, element, JSON_DECODE_ANY, levels, list, value)
             : HSR_OK;
}

enum hsr_status hsr_json_list(const struct hsr_json_node *array,
                              struct hsr_json_part elements,
                              const hsr_json_levels *levels,
                              struct hsr_json_part *list, hsr_json_take *take,
                              void *to) {
  struct hsr_json_node at = {array->input, NULL, array, NULL, 0};
  enum hsr_status status = hsr_json_array(array, NULL);
  if (!status)
    status = hsr_json_next_value(at.input, &elements, levels, list, &at.value);
  for (; at.value && !status; at.index++) {
    status = take(&at, to);
    if (!status)
      status =
          hsr_json_next_value(at.input, &elements, levels, list, &at.value);
  }
  json_decref(at.value);
  return status;
}
