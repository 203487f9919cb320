/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/modules/variant.h"
#include "common/base/names.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

struct hsr_variant hsr_variant_standard(const struct hsr_listed *listed) {
  struct hsr_variant variant = {.listed = listed,
                                .choice = hsr_choice_standard(listed->plain)};
  snprintf(variant.name, sizeof variant.name, "%s", listed->plain->name);
  return variant;
}

struct hsr_variant hsr_variant_also(const struct hsr_listed *listed, int k) {
  struct hsr_variant variant = hsr_variant_standard(listed);
  struct hsr_form *form = &variant.choice.form;
  *form = hsr_form_standard(hsr_makes_besides(listed->plain, k));
  const struct hsr_option *first = form->type->options;
  snprintf(variant.name, sizeof variant.name, "%s:%s=%s", listed->plain->name,
           first->name, first->words[form->values.option[0]].name);
  return variant;
}

/* --- A user's text -------------------------------------------------------- */

/* A text that is being read. */
struct reading {
  const char *text;
  const struct hsr_algorithm *algorithm;
  struct hsr_choice *choice;
  unsigned chosen;      /* the algorithm's own options, by their bits */
  unsigned form_chosen; /* those of the form */
  bool window_chosen;
};

/* Notes that an option, by its bit, is chosen. */
static enum hsr_status note(unsigned bit, struct hsr_stretch name,
                            const char *text, unsigned *chosen,
                            struct hsr_error *err) {
  if (*chosen & bit)
    return hsr_fail(err, HSR_E_USAGE, "%s: %.*s is given twice", text,
                    (int)name.n, name.text);
  *chosen |= bit;
  return HSR_OK;
}

/* The number of the option of that name, or -1. */
static int find_option(const struct hsr_option *options,
                       struct hsr_stretch name) {
  for (int k = 0; options && options[k].name; k++)
    if (hsr_is_word(name, options[k].name))
      return k;
  return -1;
}

static enum hsr_status choose_window(struct reading *r, struct hsr_stretch name,
                                     struct hsr_stretch value,
                                     struct hsr_error *err) {
  long *window = &r->choice->window;
  unsigned chosen = r->window_chosen;
  enum hsr_status status = note(1, name, r->text, &chosen, err);
  r->window_chosen = true;
  if (status)
    return status;
  if (!hsr_own_kind(r->algorithm)->by_windows)
    return hsr_fail(err, HSR_E_USAGE, "%s: %s does not draw in windows",
                    r->text, r->algorithm->name);
  if (!hsr_parse_whole(value, window) || *window < 1 || *window > HSR_MAX_SIZE)
    return hsr_fail(err, HSR_E_USAGE, "%s: window must be 1 to %d", r->text,
                    HSR_MAX_SIZE);
  return HSR_OK;
}

/* The kind of answer that has an option of that name, and that the algorithm
 * makes or that is folded from what it makes; else any kind that has it; NULL
 * if there is none. */
static const struct hsr_answer_type *find_kind(const struct hsr_algorithm *a,
                                               struct hsr_stretch name) {
  const struct hsr_answer_type *found = NULL;
  for (int k = 0; hsr_answer_types[k]; k++) {
    const struct hsr_answer_type *type = hsr_answer_types[k];
    if (find_option(type->options, name) < 0)
      continue;
    if (hsr_can_draw(a, type))
      return type;
    if (!found)
      found = type;
  }
  return found;
}

static enum hsr_status choose_form(struct reading *r,
                                   const struct hsr_answer_type *type,
                                   struct hsr_stretch name,
                                   struct hsr_stretch value,
                                   struct hsr_error *err) {
  struct hsr_form *form = &r->choice->form;
  if (form->type == hsr_own_kind(r->algorithm) && type != form->type)
    *form = hsr_form_standard(type);
  if (form->type != type)
    return hsr_fail(err, HSR_E_USAGE, "%s: %s and %s cannot both be", r->text,
                    form->type->name, type->name);
  int k = find_option(type->options, name);
  enum hsr_status status = note(1u << k, name, r->text, &r->form_chosen, err);
  return status ? status
                : hsr_values_choose(&form->values, type->options, k, value,
                                    r->text, err);
}

/* That the algorithm has no option of that name, and which one it may be. */
static enum hsr_status no_option(const struct reading *r,
                                 struct hsr_stretch name,
                                 struct hsr_error *err) {
  const struct hsr_option *options = r->algorithm->options;
  char word[64], hint[256] = "";
  snprintf(word, sizeof word, "%.*s", (int)name.n, name.text);
  if (options)
    hsr_names_like_of(options, sizeof *options, word, hint, sizeof hint);
  return hsr_fail(err, HSR_E_USAGE, "%s: %s has no option '%.*s'%s", r->text,
                  r->algorithm->name, (int)name.n, name.text,
                  *hint ? hint : " (see hsr list)");
}

/* One OPTION=VALUE. */
static enum hsr_status choose(struct reading *r, struct hsr_stretch name,
                              struct hsr_stretch value, struct hsr_error *err) {
  const struct hsr_algorithm *a = r->algorithm;
  if (hsr_is_word(name, "window"))
    return choose_window(r, name, value, err);
  int k = find_option(a->options, name);
  if (k >= 0) {
    enum hsr_status status = note(1u << k, name, r->text, &r->chosen, err);
    return status ? status
                  : hsr_values_choose(&r->choice->values, a->options, k, value,
                                      r->text, err);
  }
  const struct hsr_answer_type *type = find_kind(a, name);
  if (type && hsr_can_draw(a, type))
    return choose_form(r, type, name, value, err);
  if (type)
    return hsr_fail(err, HSR_E_USAGE,
                    "%s: %.*s is an option of %s, and %s makes %s", r->text,
                    (int)name.n, name.text, type->name, a->name,
                    hsr_own_kind(a)->name);
  return no_option(r, name, err);
}

/* That the algorithm does not make the word chosen of its kind's first option.
 */
static enum hsr_status does_not_make(const struct reading *r,
                                     struct hsr_error *err) {
  const struct hsr_option *option = r->choice->form.type->options;
  return hsr_fail(err, HSR_E_USAGE, "%s: %s does not make %s=%s", r->text,
                  r->algorithm->name, option->name,
                  option->words[r->choice->form.values.option[0]].name);
}

/* What does not go together. */
static enum hsr_status check(const struct reading *r, struct hsr_error *err) {
  const struct hsr_choice *choice = r->choice;
  const struct hsr_answer_type *kind = hsr_own_kind(r->algorithm);
  const struct hsr_fold *folded = choice->form.type->fold;
  if (!hsr_makes_form(r->algorithm, &choice->form) &&
      !(folded && folded->of == kind))
    return does_not_make(r, err);
  if (choice->window && folded)
    return hsr_fail(err, HSR_E_USAGE,
                    "%s: a %s picture is drawn as a whole; no windows", r->text,
                    choice->form.type->name);
  if (choice->window &&
      hsr_choice_flags(r->algorithm, choice) & HSR_FRAME_STATE)
    return hsr_fail(err, HSR_E_USAGE,
                    "%s: what is kept from frame to frame is of the whole "
                    "picture; no windows",
                    r->text);
  if (!folded || choice->form.type == kind || r->form_chosen & 1)
    return HSR_OK;
  const struct hsr_option *options = choice->form.type->options;
  int k = 1;
  while (!(r->form_chosen & 1u << k))
    k++;
  return hsr_fail(err, HSR_E_USAGE, "%s: %s needs a %s", r->text,
                  options[k].name, options[0].name);
}

static enum hsr_status no_algorithm(const char *name, struct hsr_error *err) {
  if (strchr(name, '/'))
    return hsr_fail(err, HSR_E_USAGE,
                    "%.200s: a program, which is for hsr check, hsr bench and "
                    "hsr render",
                    name);
  if (!access(name, X_OK))
    return hsr_fail(err, HSR_E_USAGE,
                    "no algorithm '%.100s'; a program has a slash in its name, "
                    "./%.100s, and a module is loaded by hsr -m",
                    name, name);
  struct hsr_names list = {0};
  char hint[256] = "";
  for (const struct hsr_listed *a = hsr_algorithms(); a->plain; a++)
    if (hsr_names_add(&list, a->plain->name, strlen(a->plain->name)))
      break; /* there is no hint without memory */
  hsr_names_like(&list, name, hint, sizeof hint);
  hsr_names_free(&list);
  return hsr_fail(err, HSR_E_USAGE, "no algorithm '%.100s'%s", name,
                  *hint ? hint : " (see hsr list)");
}

enum hsr_status hsr_variant_parse(const char *text, struct hsr_variant *variant,
                                  struct hsr_error *err) {
  char name[HSR_MOST_VARIANT + 1];
  size_t n = strcspn(text, ":");
  if (strlen(text) > HSR_MOST_VARIANT)
    return hsr_fail(err, HSR_E_USAGE,
                    "%.40s...: an algorithm with options has at most %d "
                    "characters",
                    text, HSR_MOST_VARIANT);
  memcpy(name, text, n);
  name[n] = '\0';
  const struct hsr_listed *listed = hsr_algorithm_find(name);
  if (!listed)
    return no_algorithm(name, err);
  *variant = hsr_variant_standard(listed);
  memcpy(variant->name, text, strlen(text) + 1);
  struct reading reading = {
      .text = text, .algorithm = listed->plain, .choice = &variant->choice};
  for (const char *at = text + n; *at; at += n) {
    n = 1 + strcspn(at + 1, ":");
    struct hsr_stretch option = {at + 1, strcspn(at + 1, "=:")};
    struct hsr_stretch value = {at + 1 + option.n, 0};
    if (*value.text == '=')
      value = (struct hsr_stretch){value.text + 1, n - 2 - option.n};
    enum hsr_status status = choose(&reading, option, value, err);
    if (status)
      return status;
  }
  return check(&reading, err);
}
