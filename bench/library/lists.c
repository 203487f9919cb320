/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What there is: scenes, kinds of answers, algorithms, options, counters. */
#include "bench/library/library.h"
#include "bench/results/descriptor.h"
#include "scenes/scenes.h"

#include <stdio.h>

static enum hsr_status no_item(const char *what, size_t k,
                               struct hsr_error *err) {
  return hsr_fail(err, HSR_E_USAGE, "there is no %s %zu", what, k);
}

/* --- Scenes and kinds of answers ------------------------------------------ */

enum hsr_status hsr_get_builtin(size_t k, struct hsr_builtin_info *info,
                                struct hsr_error *err) {
  size_t n = 0;
  while (n < k && hsr_builtins[n].name)
    n++;
  const struct hsr_builtin *b = &hsr_builtins[n];
  if (!b->name)
    return no_item("scene", k, err);
  struct hsr_builtin_info found = {.name = b->name,
                                   .usage = b->usage,
                                   .about = b->about,
                                   .package = b->package,
                                   .is_there = hsr_builtin_is_there(b)};
  return lib_give("info", info, sizeof found, &found, err);
}

enum hsr_status hsr_get_kind(size_t k, struct hsr_kind_info *info,
                             struct hsr_error *err) {
  size_t n = 0;
  while (n < k && hsr_answer_types[n])
    n++;
  const struct hsr_answer_type *type = hsr_answer_types[n];
  if (!type)
    return no_item("kind of answer", k, err);
  struct hsr_kind_info found = {.name = type->name,
                                .meaning = type->meaning,
                                .places = type->places,
                                .has_windows = type->by_windows};
  return lib_give("info", info, sizeof found, &found, err);
}

/* --- Algorithms ----------------------------------------------------------- */

/* NULL: there is none. */
static const struct hsr_algorithm *algorithm_at(size_t k) {
  const struct hsr_listed *all = hsr_algorithms();
  size_t n = 0;
  while (n < k && all[n].plain)
    n++;
  return all[n].plain;
}

static size_t count_counters(const struct hsr_algorithm *a) {
  size_t n = 0;
  while (a->counters && a->counters[n].name)
    n++;
  return n;
}

static void say_restrictions(const struct hsr_algorithm *a, char *text,
                             size_t size) {
  size_t n = 0;
  for (int k = 0; k < HSR_N_RESTRICTIONS && n < size; k++)
    if (a->restrictions & 1u << k)
      n += (size_t)snprintf(text + n, size - n, "%s%s", n ? " " : "",
                            hsr_restriction_code(1u << k));
}

static uint64_t kinds_of(const struct hsr_algorithm *a) {
  uint64_t kinds = 0;
  for (int k = 0; hsr_answer_types[k]; k++)
    if (hsr_can_draw(a, hsr_answer_types[k]))
      kinds |= UINT64_C(1) << k;
  return kinds;
}

/* An option that may be chosen of an algorithm. */
struct choosable {
  struct hsr_option option;
  const struct hsr_answer_type *kind; /* whose it is; NULL: none's */
  bool is_asking; /* the kind is asked for by one of its words */
  unsigned words; /* those that may be chosen, a bit each; 0: all */
};

static size_t count_options(const struct hsr_option *options) {
  size_t n = 0;
  while (options && options[n].name)
    n++;
  return n;
}

/* Option k of a kind, as it may be chosen of an algorithm that makes the kind
 * or what it is folded from. */
static struct choosable option_of_kind(const struct hsr_algorithm *a,
                                       const struct hsr_answer_type *type,
                                       size_t k) {
  const struct hsr_made *made = hsr_makes(a, type);
  bool folds = type->fold && type->fold->of == hsr_own_kind(a);
  return (struct choosable){.option = type->options[k],
                            .kind = type,
                            .is_asking = !k && type != hsr_own_kind(a),
                            .words = !k && made && !folds ? made->words : 0};
}

/* Sets *found to option k, from 0, in the order of hsr.h. */
static bool find_option(const struct hsr_algorithm *a, size_t k,
                        struct choosable *found) {
  size_t n = count_options(a->options);
  if (k < n) {
    *found = (struct choosable){.option = a->options[k]};
    return true;
  }
  k -= n;
  if (hsr_own_kind(a)->by_windows && !k--) {
    *found = (struct choosable){
        .option = {.name = "window",
                   .meaning = "samples a side of the squares in which the "
                              "picture is drawn; 0: as it suits",
                   .least = 0,
                   .most = HSR_MAX_SIZE}};
    return true;
  }
  for (int t = 0; hsr_answer_types[t]; t++) {
    const struct hsr_answer_type *type = hsr_answer_types[t];
    n = hsr_can_draw(a, type) ? count_options(type->options) : 0;
    if (k < n) {
      *found = option_of_kind(a, type, k);
      return true;
    }
    k -= n;
  }
  return false;
}

static size_t count_choosable(const struct hsr_algorithm *a) {
  struct choosable option;
  size_t n = 0;
  while (find_option(a, n, &option))
    n++;
  return n;
}

enum hsr_status hsr_get_algorithm(size_t k, struct hsr_algorithm_info *info,
                                  struct hsr_error *err) {
  const struct hsr_algorithm *a = algorithm_at(k);
  if (!a)
    return no_item("algorithm", k, err);
  struct taxonomy place = taxonomy(a->taxonomy);
  struct hsr_algorithm_info found = {
      .name = a->name,
      .title = a->title,
      .authors = a->authors,
      .year = a->year,
      .source = a->source,
      .class_name = place.class,
      .branch = place.branch,
      .sort_order = a->sort_order,
      .coherence = a->coherence,
      .kinds = kinds_of(a),
      .kind = (size_t)hsr_answer_number(hsr_own_kind(a)),
      .n_options = count_choosable(a),
      .n_counters = count_counters(a),
      .is_oracle = !!(a->flags & HSR_JUDGE),
      .draws_nothing = !!(a->flags & HSR_NO_PICTURE),
      .is_known_wrong = !!(a->flags & HSR_KNOWN_WRONG)};
  say_restrictions(a, found.restrictions, sizeof found.restrictions);
  return lib_give("info", info, sizeof found, &found, err);
}

enum hsr_status hsr_find_algorithm(const char *name, size_t *k,
                                   struct hsr_error *err) {
  if (!name || !k)
    return lib_null(name ? "k" : "name", err);
  const struct hsr_listed *all = hsr_algorithms(),
                          *listed = hsr_algorithm_find(name);
  struct hsr_variant variant;
  if (listed)
    *k = (size_t)(listed - all);
  else if (!hsr_variant_parse(name, &variant, err)) /* says what is like it */
    return hsr_fail(err, HSR_E_USAGE, "%.100s: a name has no options", name);
  return listed ? HSR_OK : HSR_E_USAGE;
}

/* --- Options -------------------------------------------------------------- */

static bool is_allowed(const struct choosable *o, size_t word) {
  return !o->words || o->words >> word & 1;
}

static size_t count_words(const struct choosable *o) {
  size_t n = 0;
  for (size_t k = 0; o->option.words && o->option.words[k].name; k++)
    n += is_allowed(o, k);
  return n;
}

static double standard_of(const struct choosable *o) {
  if (o->is_asking)
    return -1;
  if (o->words)
    return 0; /* the first of those that are allowed */
  return o->option.real && !o->option.words ? o->option.real_standard
                                            : (double)o->option.standard;
}

/* Sets *found to an option of an algorithm. HSR_E_USAGE. */
static enum hsr_status option_at(size_t algorithm, size_t k,
                                 struct choosable *found,
                                 struct hsr_error *err) {
  const struct hsr_algorithm *a = algorithm_at(algorithm);
  if (!a)
    return no_item("algorithm", algorithm, err);
  return find_option(a, k, found) ? HSR_OK : no_item("option", k, err);
}

enum hsr_status hsr_get_option(size_t algorithm, size_t k,
                               struct hsr_option_info *info,
                               struct hsr_error *err) {
  struct choosable o;
  enum hsr_status status = option_at(algorithm, k, &o, err);
  if (status)
    return status;
  bool real = o.option.real;
  struct hsr_option_info found = {
      .name = o.option.name,
      .meaning = o.option.meaning,
      .kind = o.kind ? o.kind->name : NULL,
      .n_words = count_words(&o),
      .is_real = real && !o.option.words,
      .least = real ? o.option.real_least : (double)o.option.least,
      .most = real ? o.option.real_most : (double)o.option.most,
      .standard = standard_of(&o)};
  return lib_give("info", info, sizeof found, &found, err);
}

enum hsr_status hsr_get_word(size_t algorithm, size_t option, size_t k,
                             struct hsr_word_info *info,
                             struct hsr_error *err) {
  struct choosable o;
  enum hsr_status status = option_at(algorithm, option, &o, err);
  if (status)
    return status;
  if (k >= count_words(&o))
    return no_item("word", k, err);
  size_t word = 0;
  for (size_t n = 0;; word++)
    if (is_allowed(&o, word) && n++ == k)
      break;
  struct hsr_word_info found = {.name = o.option.words[word].name,
                                .meaning = o.option.words[word].meaning};
  return lib_give("info", info, sizeof found, &found, err);
}

/* --- Counters ------------------------------------------------------------- */

enum hsr_status hsr_get_counter(size_t algorithm, size_t k,
                                struct hsr_counter_info *info,
                                struct hsr_error *err) {
  const struct hsr_algorithm *a = algorithm_at(algorithm);
  if (!a)
    return no_item("algorithm", algorithm, err);
  if (k >= count_counters(a))
    return no_item("counter", k, err);
  const struct hsr_counter *c = &a->counters[k];
  int line = hsr_line_of(a, (int)k);
  struct hsr_counter_info found = {.name = c->name,
                                   .key = c->key,
                                   .meaning = c->meaning,
                                   .step = hsr_step_kind_name[c->kind],
                                   .a = hsr_subject_kind_name[c->a],
                                   .b = hsr_subject_kind_name[c->b],
                                   .outcomes = c->outcomes,
                                   .is_computed = c->computed,
                                   .line = line,
                                   .line_text =
                                       line ? a->outline[line - 1].text : NULL};
  return lib_give("info", info, sizeof found, &found, err);
}
