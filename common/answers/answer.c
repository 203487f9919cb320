/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/answers/answer.h"

#include <stdlib.h>
#include <string.h>

int hsr_answer_number(const struct hsr_answer_type *type) {
  int k = 0;
  while (hsr_answer_types[k] && hsr_answer_types[k] != type)
    k++;
  return k;
}

bool hsr_is_asked_of(const struct hsr_answer_type *type,
                     const struct hsr_answer_type *made) {
  return type == made || (type->fold && type->fold->of == made);
}

/* --- Forms ---------------------------------------------------------------- */

struct hsr_form hsr_form_standard(const struct hsr_answer_type *type) {
  return (struct hsr_form){type, hsr_values_standard(type->options)};
}

bool hsr_same_form(const struct hsr_form *a, const struct hsr_form *b) {
  if (a->type != b->type)
    return false;
  const struct hsr_option *options = a->type->options;
  for (int k = 0; options && options[k].name; k++)
    if (options[k].real ? a->values.real[k] != b->values.real[k]
                        : a->values.option[k] != b->values.option[k])
      return false;
  return true;
}

double hsr_form_pictures(const struct hsr_form *form,
                         const struct hsr_view *view) {
  const struct hsr_fold *fold = form->type->fold;
  struct hsr_view first;
  if (!fold || fold->view(form, view, 0, &first, NULL))
    return 1;
  double size = (double)first.m * first.n / ((double)view->m * view->n);
  return size * (double)fold->n(form);
}

/* --- Answers -------------------------------------------------------------- */

/* Makes room for one of the pictures that an answer is folded from. */
static enum hsr_status make_picture(struct hsr_answer *answer,
                                    const struct hsr_view *view,
                                    struct hsr_error *err) {
  const struct hsr_fold *fold = answer->form.type->fold;
  struct hsr_form of = hsr_form_standard(fold->of);
  struct hsr_view first;
  enum hsr_status status = fold->view(&answer->form, view, 0, &first, err);
  if (status)
    return status;
  answer->picture = calloc(1, sizeof *answer->picture);
  return answer->picture
             ? hsr_answer_make(answer->picture, &of, &first, false, err)
             : hsr_fail_nomem(err);
}

enum hsr_status hsr_answer_make(struct hsr_answer *answer,
                                const struct hsr_form *form,
                                const struct hsr_view *view, bool by_pictures,
                                struct hsr_error *err) {
  *answer = (struct hsr_answer){.form = *form, .m = view->m, .n = view->n};
  enum hsr_status status =
      by_pictures ? make_picture(answer, view, err) : HSR_OK;
  return status ? status : form->type->make(answer, err);
}

void hsr_answer_free(struct hsr_answer *answer) {
  if (answer->picture)
    hsr_answer_free(answer->picture);
  free(answer->picture);
  if (answer->body)
    answer->form.type->free(answer);
  answer->body = answer->picture = NULL;
}

void hsr_shaded_free(struct hsr_shaded *shaded) {
  free(shaded->rgb);
  free(shaded->depth);
  *shaded = (struct hsr_shaded){.rgb = NULL};
}
