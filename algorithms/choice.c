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

bool hsr_makes_also(const struct hsr_algorithm *a,
                    const struct hsr_answer_type *type) {
  for (int k = 0; a->also[k]; k++)
    if (a->also[k] == type)
      return true;
  return false;
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
  return hsr_makes_also(a, type) || hsr_is_asked_of(type, a->kind);
}

bool hsr_choice_folds(const struct hsr_algorithm *a,
                      const struct hsr_choice *choice) {
  enum hsr_filter filter = hsr_form_filtering(&choice->form).filter;
  bool fine = a->flags & HSR_FILTERS_FINELY && filter == HSR_FILTER_BOX_64X64;
  bool filters =
      fine || (a->flags & HSR_FILTERS && hsr_filter_is_of_64(filter));
  return choice->form.type != a->kind &&
         !hsr_makes_also(a, choice->form.type) && !filters;
}

struct hsr_choice hsr_choice_standard(const struct hsr_algorithm *a) {
  struct hsr_choice choice = {.values = hsr_values_standard(a->options),
                              .form = hsr_form_standard(a->kind)};
  if (a->makes)
    choice.form.values.option[0] = hsr_first_bit(a->makes);
  return choice;
}
