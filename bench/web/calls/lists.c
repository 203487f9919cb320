/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What there is: scenes, kinds of answers, algorithms. */
#include "bench/web/check.h"
#include "bench/web/web.h"
#include "common/files/json/json.h"

#include <string.h>

/* The first call. HSR_E_INTERNAL if arithmetic is not what it should be. */
WEB_CALL enum hsr_status web_version(void) {
  struct hsr_error *err = web_begin();
  const char *wrong = check_numbers();
  return wrong ? web_end(hsr_fail(err, HSR_E_INTERNAL, "%s", wrong), NULL)
               : web_end(HSR_OK, json_string(hsr_version()));
}

/* --- Scenes and kinds ----------------------------------------------------- */

WEB_CALL enum hsr_status web_builtins(void) {
  struct hsr_builtin_info b = {.size = sizeof b};
  json_t *all = json_array();
  web_begin();
  for (size_t k = 0; !hsr_get_builtin(k, &b, NULL); k++)
    hsr_json_append(&all,
                    json_pack("{ss ss ss sb}", "name", b.name, "usage", b.usage,
                              "about", b.about, "isThere", b.is_there));
  return web_end(HSR_OK, all);
}

WEB_CALL enum hsr_status web_kinds(void) {
  struct hsr_kind_info kind = {.size = sizeof kind};
  json_t *all = json_array();
  web_begin();
  for (size_t k = 0; !hsr_get_kind(k, &kind, NULL); k++)
    hsr_json_append(&all,
                    json_pack("{ss ss ss sb}", "name", kind.name, "meaning",
                              kind.meaning, "places", kind.places, "hasWindows",
                              kind.has_windows));
  return web_end(HSR_OK, all);
}

/* --- Options -------------------------------------------------------------- */

static json_t *words_json(size_t algorithm, size_t option) {
  struct hsr_word_info word = {.size = sizeof word};
  json_t *words = json_array();
  for (size_t k = 0; !hsr_get_word(algorithm, option, k, &word, NULL); k++)
    hsr_json_append(&words, json_pack("{ss ss?}", "name", word.name, "meaning",
                                      word.meaning));
  return words;
}

static json_t *options_json(size_t algorithm) {
  struct hsr_option_info o = {.size = sizeof o};
  json_t *options = json_array();
  for (size_t k = 0; !hsr_get_option(algorithm, k, &o, NULL); k++)
    hsr_json_append(&options,
                    json_pack("{ss ss? ss? sf sf sf sb so}", "name", o.name,
                              "meaning", o.meaning, "kind", o.kind, "least",
                              o.least, "most", o.most, "standard", o.standard,
                              "isReal", o.is_real, "words",
                              words_json(algorithm, k)));
  return options;
}

/* --- Counters ------------------------------------------------------------- */

/* The words that '|' separates. */
static json_t *outcomes_json(const char *text) {
  json_t *outcomes = json_array();
  while (text) {
    const char *end = strchr(text, '|');
    const size_t n = end ? (size_t)(end - text) : strlen(text);
    hsr_json_append(&outcomes, json_stringn(text, n));
    text = end ? end + 1 : NULL;
  }
  return outcomes;
}

static json_t *counters_json(size_t algorithm) {
  struct hsr_counter_info c = {.size = sizeof c};
  json_t *counters = json_array();
  for (size_t k = 0; !hsr_get_counter(algorithm, k, &c, NULL); k++)
    hsr_json_append(
        &counters,
        json_pack("{ss ss? ss? ss ss ss so sb si ss?}", "name", c.name, "key",
                  c.key, "meaning", c.meaning, "step", c.step, "a", c.a, "b",
                  c.b, "outcomes", outcomes_json(c.outcomes), "isComputed",
                  c.is_computed, "line", c.line, "lineText", c.line_text));
  return counters;
}

/* --- Algorithms ----------------------------------------------------------- */

static json_t *kinds_json(uint64_t kinds) {
  struct hsr_kind_info kind = {.size = sizeof kind};
  json_t *names = json_array();
  for (size_t k = 0; !hsr_get_kind(k, &kind, NULL); k++)
    if (kinds >> k & 1)
      hsr_json_append(&names, json_string(kind.name));
  return names;
}

static json_t *outline_json(const struct hsr_algorithm *a) {
  json_t *outline = json_array();
  for (const struct hsr_line *l = a->outline; l && l->text; l++)
    hsr_json_append(&outline, json_string(l->text));
  return outline;
}

static json_t *algorithm_json(size_t k, const struct hsr_algorithm_info *a) {
  const struct hsr_listed *listed = &hsr_algorithms()[k];
  const struct hsr_variant standard = hsr_variant_standard(listed);
  struct hsr_kind_info kind = {.size = sizeof kind};
  hsr_get_kind(a->kind, &kind, NULL);
  return json_pack(
      "{ss ss ss ss si ss ss? ss? ss? ss so ss so so so sb sb sb sb}", "name",
      a->name, "title", a->title, "authors", a->authors, "source", a->source,
      "year", a->year, "className", a->class_name, "branch", a->branch,
      "sortOrder", a->sort_order, "coherence", a->coherence, "restrictions",
      a->restrictions, "kinds", kinds_json(a->kinds), "kind", kind.name,
      "options", options_json(k), "counters", counters_json(k), "outline",
      outline_json(listed->counting), "isOracle", a->is_oracle, "drawsNothing",
      a->draws_nothing, "isKnownWrong", a->is_known_wrong, "canTrace",
      !lib_check_trace(&standard, NULL));
}

WEB_CALL enum hsr_status web_algorithms(void) {
  struct hsr_algorithm_info a = {.size = sizeof a};
  json_t *all = json_array();
  web_begin();
  for (size_t k = 0; !hsr_get_algorithm(k, &a, NULL); k++)
    hsr_json_append(&all, algorithm_json(k, &a));
  return web_end(HSR_OK, all);
}
