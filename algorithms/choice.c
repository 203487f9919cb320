/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/algorithm.h"
#include "common/base/bits.h"

unsigned hsr_choice_flags(const struct hsr_algorithm *a,
                          const struct hsr_choice *choice) {
  unsigned flags = a->flags;
  for (int k = 0; a->options && a->options[k].name; k++)
    if (a->options[k].words)
      flags |= a->options[k].words[choice->values.option[k]].flags;
  return flags;
}

const struct hsr_made *hsr_makes(const struct hsr_algorithm *a,
                                 const struct hsr_answer_type *type) {
  for (const struct hsr_made *made = a->makes; made->kind; made++)
    if (made->kind == type)
      return made;
  return NULL;
}

unsigned hsr_makes_how(const struct hsr_algorithm *a,
                       const struct hsr_answer_type *type) {
  const struct hsr_made *made = hsr_makes(a, type);
  return made ? made->how : 0;
}

const struct hsr_answer_type *hsr_makes_besides(const struct hsr_algorithm *a,
                                                int k) {
  for (const struct hsr_made *made = a->makes; made->kind; made++)
    if (made != a->makes && !made->kind->fold && k-- == 0)
      return made->kind;
  return NULL;
}

bool hsr_makes_also(const struct hsr_algorithm *a,
                    const struct hsr_answer_type *type) {
  const struct hsr_made *made = hsr_makes(a, type);
  return made && made != a->makes && !type->fold;
}

bool hsr_choice_takes_roster(const struct hsr_algorithm *a,
                             const struct hsr_choice *choice) {
  unsigned flags = hsr_choice_flags(a, choice);
  bool own_only = flags & HSR_LAID_OUT_UNLESS_LARGE;
  return flags & HSR_INSTANCED && !(flags & HSR_NEEDS_LAID_OUT) &&
         !(own_only && hsr_makes_also(a, choice->form.type));
}

uint32_t hsr_most_laid_out(const struct hsr_algorithm *a,
                           const struct hsr_choice *choice) {
  struct hsr_choice standard = hsr_choice_standard(a);
  return !hsr_choice_takes_roster(a, choice ? choice : &standard)
             ? HSR_MOST_LAID_OUT
         : a->flags & HSR_RATHER_LAID_OUT       ? HSR_RATHER_MOST
         : a->flags & HSR_LAID_OUT_UNLESS_LARGE ? HSR_LARGE
                                                : 0;
}

bool hsr_can_draw(const struct hsr_algorithm *a,
                  const struct hsr_answer_type *type) {
  return hsr_makes(a, type) || hsr_is_asked_of(type, hsr_own_kind(a));
}

bool hsr_makes_form(const struct hsr_algorithm *a,
                    const struct hsr_form *form) {
  const struct hsr_made *made = hsr_makes(a, form->type);
  return made && (!made->words || made->words >> form->values.option[0] & 1);
}

bool hsr_choice_folds(const struct hsr_algorithm *a,
                      const struct hsr_choice *choice) {
  return !hsr_makes_form(a, &choice->form);
}

bool hsr_choice_composes(const struct hsr_algorithm *a,
                         const struct hsr_choice *choice) {
  const struct hsr_answer_type *kind = hsr_own_kind(a);
  return kind->by_faces && hsr_is_asked_of(choice->form.type, kind);
}

struct hsr_choice hsr_choice_standard(const struct hsr_algorithm *a) {
  struct hsr_choice choice = {.values = hsr_values_standard(a->options),
                              .form = hsr_form_standard(hsr_own_kind(a))};
  if (a->makes[0].words)
    choice.form.values.option[0] = hsr_first_bit(a->makes[0].words);
  return choice;
}
