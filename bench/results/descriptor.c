/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/results/descriptor.h"
#include "bench/modules/modules.h"
#include "common/files/json/json.h"

struct taxonomy taxonomy(enum hsr_branch branch) {
  static const struct taxonomy place[] = {
      [HSR_OBJECT_SPACE_VOLUMES] = {"object space", "edges against volumes"},
      [HSR_OBJECT_SPACE_EDGES] = {"object space", "edges against edges"},
      [HSR_LIST_PRIORITY_FIXED] = {"list priority", "a priori"},
      [HSR_LIST_PRIORITY_PER_FRAME] = {"list priority", "per frame"},
      [HSR_IMAGE_SPACE_AREA] = {"image space", "area sampling"},
      [HSR_IMAGE_SPACE_POINT] = {"image space", "point sampling"},
      [HSR_BRUTE_FORCE] = {"brute force", NULL},
      [HSR_HIERARCHICAL] = {"hierarchical", NULL},
      [HSR_VOLUME_SPACE] = {"volume", NULL},
      [HSR_YARDSTICK] = {"yardstick", NULL}};
  return place[branch];
}

static json_t *codes_json(unsigned restrictions) {
  json_t *codes = json_array();
  for (int k = 0; k < HSR_N_RESTRICTIONS; k++)
    if (restrictions & 1u << k)
      hsr_json_append(&codes, json_string(hsr_restriction_code(1u << k)));
  return codes;
}

json_t *restrictions_json(const struct hsr_algorithm *a) {
  return codes_json(a->restrictions);
}

json_t *lifted_json(const struct hsr_algorithm *a) {
  return codes_json(a->lifted);
}

json_t *sorts_json(const struct hsr_algorithm *a) {
  json_t *sorts = json_array();
  for (const struct hsr_sort *s = a->sorts; s && s->what; s++)
    hsr_json_append(&sorts,
                    json_pack("{ss ss ss ss}", "what", s->what, "key", s->key,
                              "method", s->method, "often", s->often));
  return sorts;
}

static json_t *subjects_json(const struct hsr_algorithm *a) {
  json_t *subjects = json_array();
  for (int k = 0; k < HSR_N_SCENE_SUBJECTS; k++)
    if (a->subjects & 1u << k)
      hsr_json_append(&subjects, json_string(hsr_scene_subject_name[k]));
  return subjects;
}

static json_t *counters_json(const struct hsr_algorithm *a) {
  json_t *counters = json_array();
  for (const struct hsr_counter *c = a->counters; c && c->name; c++) {
    json_t *outcome_keys =
        c->outcome_keys ? hsr_json_words(c->outcome_keys, '|') : NULL;
    hsr_json_append(&counters, json_pack("{ss ss* so* ss}", "name", c->name,
                                         "key", c->key, "outcome_keys",
                                         outcome_keys, "meaning", c->meaning));
  }
  return counters;
}

json_t *terms_json(const struct hsr_algorithm *a, const struct hsr_step *step,
                   const struct hsr_prices *prices) {
  json_t *terms = json_array();
  struct hsr_term term;
  for (int k = 0; hsr_step_term(step, k, &term); k++)
    hsr_json_append(&terms,
                    json_pack("{ss ss sf}", "counter",
                              a->counters[term.counter].name, "kind",
                              hsr_kinds[term.kind - HSR_FIRST_KIND].name,
                              "price", hsr_term_price(&term, prices)));
  return terms;
}

static json_t *steps_json(const struct hsr_algorithm *a) {
  json_t *steps = json_array();
  for (const struct hsr_step *s = a->steps; s && s->label; s++)
    hsr_json_append(&steps, json_pack("{ss so ss?}", "label", s->label, "terms",
                                      terms_json(a, s, &hsr_prices_standard),
                                      "formula", s->formula));
  return steps;
}

static json_t *option_json(const struct hsr_option *o) {
  if (o->real)
    return json_pack("{ss ss sf sf sf}", "name", o->name, "meaning", o->meaning,
                     "least", o->real_least, "most", o->real_most, "standard",
                     o->real_standard);
  if (!o->words)
    return json_pack("{ss ss sI sI sI}", "name", o->name, "meaning", o->meaning,
                     "least", (json_int_t)o->least, "most", (json_int_t)o->most,
                     "standard", (json_int_t)o->standard);
  json_t *words = json_array();
  for (const struct hsr_word *w = o->words; w->name; w++)
    hsr_json_append(
        &words, json_pack("{ss ss}", "name", w->name, "meaning", w->meaning));
  return json_pack("{ss ss so ss}", "name", o->name, "meaning", o->meaning,
                   "words", words, "standard", o->words[o->standard].name);
}

static json_t *options_json(const struct hsr_algorithm *a) {
  json_t *options = json_array();
  for (const struct hsr_option *o = a->options; o && o->name; o++)
    hsr_json_append(&options, option_json(o));
  return options;
}

static json_t *year_json(const struct hsr_algorithm *a) {
  return a->year ? json_integer(a->year) : json_null();
}

static json_t *algorithm_json(const struct hsr_algorithm *a) {
  return json_pack(
      "{ss ss ss so ss ss ss* ss* ss* ss sb so sb sb so so so so so}", "name",
      a->name, "title", a->title, "authors", a->authors, "year", year_json(a),
      "source", a->source, "taxonomy", taxonomy(a->taxonomy).class, "branch",
      taxonomy(a->taxonomy).branch, "sort_order", a->sort_order, "coherence",
      a->coherence, "kind", hsr_own_kind(a)->name, "draws",
      !(a->flags & HSR_NO_PICTURE), "subjects", subjects_json(a), "known_wrong",
      (a->flags & HSR_KNOWN_WRONG) != 0, "visible_only",
      (a->makes[0].how & HSR_VISIBLE_ONLY) != 0, "restrictions",
      restrictions_json(a), "sorts", sorts_json(a), "counters",
      counters_json(a), "steps", steps_json(a), "options", options_json(a));
}

json_t *algorithms_json(void) {
  json_t *all = json_array();
  for (const struct hsr_listed *a = hsr_algorithms(); a->plain; a++)
    hsr_json_append(&all, algorithm_json(a->plain));
  return all;
}
