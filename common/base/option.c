/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/base/option.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct hsr_values hsr_values_standard(const struct hsr_option *options) {
  struct hsr_values values = {.option = {0}};
  for (int k = 0; options && options[k].name; k++) {
    values.option[k] = options[k].standard;
    values.real[k] = options[k].real_standard;
  }
  return values;
}

bool hsr_is_word(struct hsr_stretch stretch, const char *word) {
  return strlen(word) == stretch.n && !memcmp(stretch.text, word, stretch.n);
}

bool hsr_parse_whole(struct hsr_stretch stretch, long *number) {
  char digits[20], *end;
  if (!stretch.n || stretch.n >= sizeof digits || stretch.text[0] < '0' ||
      stretch.text[0] > '9')
    return false;
  memcpy(digits, stretch.text, stretch.n);
  digits[stretch.n] = '\0';
  errno = 0;
  *number = strtol(digits, &end, 10);
  return !errno && !*end;
}

/* Reads a finite decimal number that fills the stretch. False if there is none.
 */
static bool parse_real(struct hsr_stretch stretch, double *number) {
  char digits[40], *end;
  if (!stretch.n || stretch.n >= sizeof digits ||
      strspn(stretch.text, "0123456789.eE+-") < stretch.n)
    return false;
  memcpy(digits, stretch.text, stretch.n);
  digits[stretch.n] = '\0';
  *number = strtod(digits, &end);
  return !*end && isfinite(*number);
}

static enum hsr_status choose_word(const struct hsr_option *option,
                                   struct hsr_stretch value, const char *text,
                                   long *chosen, struct hsr_error *err) {
  char words[200] = "";
  size_t n = 0;
  for (long k = 0; option->words[k].name; k++) {
    if (hsr_is_word(value, option->words[k].name)) {
      *chosen = k;
      return HSR_OK;
    }
    if (n < sizeof words)
      n += (size_t)snprintf(words + n, sizeof words - n, "%s%s", k ? ", " : "",
                            option->words[k].name);
  }
  return hsr_fail(err, HSR_E_USAGE, "%s: %s must be one of: %s", text,
                  option->name, words);
}

enum hsr_status hsr_values_choose(struct hsr_values *values,
                                  const struct hsr_option *options, int k,
                                  struct hsr_stretch value, const char *text,
                                  struct hsr_error *err) {
  const struct hsr_option *option = &options[k];
  if (option->words)
    return choose_word(option, value, text, &values->option[k], err);
  long whole;
  double real;
  if (option->real) {
    if (!parse_real(value, &real) || !(real >= option->real_least) ||
        !(real <= option->real_most))
      return hsr_fail(err, HSR_E_USAGE, "%s: %s must be %g to %g", text,
                      option->name, option->real_least, option->real_most);
    values->real[k] = real;
    return HSR_OK;
  }
  if (!hsr_parse_whole(value, &whole) || whole < option->least ||
      whole > option->most)
    return hsr_fail(err, HSR_E_USAGE, "%s: %s must be %ld to %ld", text,
                    option->name, option->least, option->most);
  values->option[k] = whole;
  return HSR_OK;
}
