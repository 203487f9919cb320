/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/variant.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

unsigned hsr_choice_flags(const struct hsr_algorithm *a,
                          const struct hsr_choice *choice) {
  unsigned flags = a->flags;
  for (int k = 0; a->options && a->options[k].name; k++)
    if (a->options[k].words)
      flags |= a->options[k].words[choice->option[k]].flags;
  return flags;
}

enum hsr_kind hsr_choice_kind(const struct hsr_algorithm *a,
                              const struct hsr_choice *choice) {
  return choice->filtering.filter ? HSR_FILTERED : a->kind;
}

struct hsr_choice hsr_choice_standard(const struct hsr_algorithm *a) {
  struct hsr_choice choice = {.window = 0};
  for (int k = 0; a->options && a->options[k].name; k++)
    choice.option[k] = a->options[k].standard;
  return choice;
}

struct hsr_variant hsr_variant_standard(const struct hsr_listed *listed) {
  struct hsr_variant variant = {.listed = listed,
                                .choice = hsr_choice_standard(listed->plain)};
  snprintf(variant.name, sizeof variant.name, "%s", listed->plain->name);
  return variant;
}

/* A stretch of the user's text. */
struct part {
  const char *text;
  size_t n;
};

static bool is(struct part part, const char *word) {
  return strlen(word) == part.n && !memcmp(part.text, word, part.n);
}

/* A decimal number that fills the part. */
static bool parse_number(struct part part, long *number) {
  char digits[20], *end;
  if (!part.n || part.n >= sizeof digits || part.text[0] < '0' ||
      part.text[0] > '9')
    return false;
  memcpy(digits, part.text, part.n);
  digits[part.n] = '\0';
  errno = 0;
  *number = strtol(digits, &end, 10);
  return !errno && !*end;
}

static enum hsr_status choose_word(const struct hsr_option *option,
                                   struct part value, const char *text,
                                   long *chosen, struct hsr_error *err) {
  char words[200] = "";
  size_t n = 0;
  for (long k = 0; option->words[k].name; k++) {
    if (is(value, option->words[k].name)) {
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

static enum hsr_status choose_number(const struct hsr_option *option,
                                     struct part value, const char *text,
                                     long *chosen, struct hsr_error *err) {
  if (parse_number(value, chosen) && *chosen >= option->least &&
      *chosen <= option->most)
    return HSR_OK;
  return hsr_fail(err, HSR_E_USAGE, "%s: %s must be %ld to %ld", text,
                  option->name, option->least, option->most);
}

static enum hsr_status choose_window(const struct hsr_algorithm *a,
                                     struct part value, const char *text,
                                     struct hsr_choice *choice,
                                     struct hsr_error *err) {
  if (a->kind != HSR_IDS)
    return hsr_fail(err, HSR_E_USAGE, "%s: %s does not draw in windows", text,
                    a->name);
  if (!parse_number(value, &choice->window) || choice->window < 1 ||
      choice->window > HSR_MAX_SIZE)
    return hsr_fail(err, HSR_E_USAGE, "%s: window must be 1 to %d", text,
                    HSR_MAX_SIZE);
  return HSR_OK;
}

static enum hsr_status choose_filter(const struct hsr_algorithm *a,
                                     struct part value, const char *text,
                                     struct hsr_choice *choice,
                                     struct hsr_error *err) {
  if (a->kind != HSR_IDS)
    return hsr_fail(err, HSR_E_USAGE, "%s: %s draws nothing to filter", text,
                    a->name);
  if (is(value, "box"))
    choice->filtering.filter = HSR_FILTER_BOX;
  else if (is(value, "cosine"))
    choice->filtering.filter = HSR_FILTER_COSINE;
  else
    return hsr_fail(err, HSR_E_USAGE, "%s: filter must be one of: box, cosine",
                    text);
  return HSR_OK;
}

static enum hsr_status choose_jitter(const struct hsr_algorithm *a,
                                     struct part value, const char *text,
                                     struct hsr_choice *choice,
                                     struct hsr_error *err) {
  long patterns;
  (void)a;
  if (!parse_number(value, &patterns) || patterns > HSR_MOST_PATTERNS)
    return hsr_fail(err, HSR_E_USAGE, "%s: jitter must be 0 to %d", text,
                    HSR_MOST_PATTERNS);
  choice->filtering.patterns = (int)patterns;
  return HSR_OK;
}

/* The options that all have, whose bits follow those of an algorithm's own. */
enum { WINDOW, FILTER, JITTER, N_COMMON };
static const struct {
  const char *name;
  enum hsr_status (*choose)(const struct hsr_algorithm *a, struct part value,
                            const char *text, struct hsr_choice *choice,
                            struct hsr_error *err);
} common[] = {[WINDOW] = {"window", choose_window},
              [FILTER] = {"filter", choose_filter},
              [JITTER] = {"jitter", choose_jitter}};

/* Notes that an option, by its bit, is chosen. */
static enum hsr_status note(unsigned bit, struct part name, const char *text,
                            unsigned *chosen, struct hsr_error *err) {
  if (*chosen & bit)
    return hsr_fail(err, HSR_E_USAGE, "%s: %.*s is given twice", text,
                    (int)name.n, name.text);
  *chosen |= bit;
  return HSR_OK;
}

/* One OPTION=VALUE. */
static enum hsr_status choose(const struct hsr_algorithm *a, struct part name,
                              struct part value, const char *text,
                              unsigned *chosen, struct hsr_choice *choice,
                              struct hsr_error *err) {
  for (int k = 0; k < N_COMMON; k++) {
    if (!is(name, common[k].name))
      continue;
    enum hsr_status status =
        note(1u << (HSR_MAX_OPTIONS + k), name, text, chosen, err);
    return status ? status : common[k].choose(a, value, text, choice, err);
  }
  for (int k = 0; a->options && a->options[k].name; k++) {
    const struct hsr_option *option = &a->options[k];
    if (!is(name, option->name))
      continue;
    enum hsr_status status = note(1u << k, name, text, chosen, err);
    if (status)
      return status;
    return option->words
               ? choose_word(option, value, text, &choice->option[k], err)
               : choose_number(option, value, text, &choice->option[k], err);
  }
  return hsr_fail(err, HSR_E_USAGE,
                  "%s: %s has no option '%.*s' (see hsr list)", text, a->name,
                  (int)name.n, name.text);
}

/* What does not go together. */
static enum hsr_status check(const struct hsr_algorithm *a,
                             const struct hsr_choice *choice, unsigned chosen,
                             const char *text, struct hsr_error *err) {
  bool filtered = hsr_choice_kind(a, choice) == HSR_FILTERED;
  if (choice->window && filtered)
    return hsr_fail(err, HSR_E_USAGE,
                    "%s: a filtered picture is drawn as a whole; no windows",
                    text);
  if (choice->window && hsr_choice_flags(a, choice) & HSR_FRAME_STATE)
    return hsr_fail(err, HSR_E_USAGE,
                    "%s: what is kept from frame to frame is of the whole "
                    "picture; no windows",
                    text);
  if (chosen >> HSR_MAX_OPTIONS & 1u << JITTER && !filtered)
    return hsr_fail(err, HSR_E_USAGE, "%s: jitter needs a filter", text);
  return HSR_OK;
}

enum hsr_status hsr_variant_parse(const char *text, struct hsr_variant *variant,
                                  struct hsr_error *err) {
  char name[HSR_MOST_VARIANT + 1];
  size_t n = strcspn(text, ":");
  if (strlen(text) > HSR_MOST_VARIANT)
    return hsr_fail(err, HSR_E_USAGE, "no algorithm '%.40s...' (see hsr list)",
                    text);
  memcpy(name, text, n);
  name[n] = '\0';
  const struct hsr_listed *listed = hsr_algorithm_find(name);
  if (!listed)
    return hsr_fail(err, HSR_E_USAGE, "no algorithm '%s' (see hsr list)", name);
  *variant = hsr_variant_standard(listed);
  memcpy(variant->name, text, strlen(text) + 1);
  unsigned chosen = 0;
  for (const char *at = text + n; *at; at += n) {
    n = 1 + strcspn(at + 1, ":");
    struct part option = {at + 1, strcspn(at + 1, "=:")};
    struct part value = {at + 1 + option.n, 0};
    if (*value.text == '=')
      value = (struct part){value.text + 1, n - 2 - option.n};
    enum hsr_status status = choose(listed->plain, option, value, text, &chosen,
                                    &variant->choice, err);
    if (status)
      return status;
  }
  return check(listed->plain, &variant->choice, chosen, text, err);
}
