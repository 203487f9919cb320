/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/files/volume/volume_fields.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* --- Lines ---------------------------------------------------------------- */

static void trim_end(char *text) {
  size_t n = strlen(text);
  while (n && isspace((unsigned char)text[n - 1]))
    text[--n] = '\0';
}

static const char *pass_spaces(const char *text) {
  return text + strspn(text, " \t");
}

bool hsr_field_line(FILE *in, char line[HSR_FIELD_LINE]) {
  if (!fgets(line, HSR_FIELD_LINE, in) || strlen(line) + 1 == HSR_FIELD_LINE)
    return false;
  trim_end(line);
  return true;
}

bool hsr_field_split(const struct hsr_fields *fields, char *line, char **name,
                     char **value) {
  char *sign = strchr(line, fields->sign);
  if (!sign)
    return false;
  *sign = '\0';
  trim_end(line);
  *name = line + strspn(line, " \t");
  *value = sign + 1 + strspn(sign + 1, " \t");
  return **name;
}

/* --- Values --------------------------------------------------------------- */

/* Each reads a part of a value, and returns what follows it, or NULL. */

static const char *read_whole(const char *text, long long *to) {
  int n = 0;
  return sscanf(text, "%18lld%n", to, &n) == 1 &&
                 !isdigit((unsigned char)text[n])
             ? text + n
             : NULL;
}

static const char *read_real(const char *text, bool optional, double *to) {
  char *end;
  *to = strtod(text, &end);
  return end != text && (isfinite(*to) || (optional && isnan(*to))) ? end
                                                                    : NULL;
}

static const char *read_vector(const char *text, double to[3]) {
  text = pass_spaces(text);
  for (int a = 0; a < 3 && text; a++) {
    if (*text != (a ? ',' : '('))
      return NULL;
    text = read_real(text + 1, false, &to[a]);
    text = text ? pass_spaces(text) : NULL;
  }
  return text && *text == ')' ? text + 1 : NULL;
}

/* The word is all that is left, if it is the last. */
static const char *read_word(const char *text,
                             const struct hsr_field_word *words, bool is_last,
                             int *to) {
  text = pass_spaces(text);
  size_t n = is_last ? strlen(text) : strcspn(text, " \t");
  for (; words->word; words++)
    if (strlen(words->word) == n && !strncasecmp(words->word, text, n)) {
      *to = words->means;
      return text + n;
    }
  return NULL;
}

static const char *read_text(const char *text, char to[HSR_FIELD_LINE]) {
  snprintf(to, HSR_FIELD_LINE, "%s", text);
  return *text ? text + strlen(text) : NULL;
}

/* Part k of a value. */
static const char *read_part(const struct hsr_field *field, int k,
                             const char *text, void *values) {
  char *at = (char *)values + field->at;
  size_t part = (size_t)k;
  switch (field->form) {
  case HSR_FIELD_WHOLES:
    return read_whole(text, (long long *)(void *)at + part);
  case HSR_FIELD_REALS:
  case HSR_FIELD_OPTIONALS:
    return read_real(text, field->form == HSR_FIELD_OPTIONALS,
                     (double *)(void *)at + part);
  case HSR_FIELD_VECTORS:
    return read_vector(text, (double *)(void *)at + 3 * part);
  case HSR_FIELD_WORDS:
    return read_word(text, field->words, k + 1 == field->n,
                     (int *)(void *)at + part);
  case HSR_FIELD_TEXT:
    return read_text(text, at);
  case HSR_FIELD_UNUSED:
  case HSR_FIELD_NOTED:
    break;
  }
  return text;
}

/* All parts, and nothing else. */
static bool read_value(const struct hsr_field *field, const char *text,
                       void *values) {
  for (int k = 0; k < field->n && text; k++)
    text = read_part(field, k, text, values);
  return text && (!field->n || !*pass_spaces(text));
}

/* --- Fields --------------------------------------------------------------- */

bool hsr_field_is_given(const struct hsr_fields *fields, int number) {
  return fields->given >> number & 1;
}

enum hsr_status hsr_field_take(struct hsr_fields *fields, const char *name,
                               const char *value, bool *known,
                               struct hsr_error *err) {
  const struct hsr_field *field = fields->table;
  while (field->name && strcmp(field->name, name) != 0)
    field++;
  *known = field->name;
  if (!*known)
    return HSR_OK;
  if (hsr_field_is_given(fields, field->number))
    return hsr_volume_refuse(fields->file, err, "its header says %s twice",
                             name);
  fields->given |= UINT64_C(1) << field->number;
  if (field->form == HSR_FIELD_NOTED)
    hsr_volume_note(fields->file, "its %s, %.40s, is not used", name, value);
  return read_value(field, value, fields->values)
             ? HSR_OK
             : hsr_volume_refuse(fields->file, err,
                                 "its header's %.40s, %.60s, cannot be read",
                                 name, value);
}
