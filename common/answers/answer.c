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

/* --- Windows -------------------------------------------------------------- */

size_t hsr_answer_window_size(const struct hsr_answer *answer,
                              const struct hsr_window *w) {
  struct hsr_array array[HSR_MOST_ARRAYS];
  int n = answer->form.type->arrays(answer, array);
  size_t bytes = 0;
  for (int k = 0; k < n; k++)
    bytes += array[k].place;
  return (size_t)(w->x1 - w->x0) * (size_t)(w->y1 - w->y0) * bytes;
}

/* Calls copy(row, size, data) for the rows of each array in turn. */
static void visit_rows(const struct hsr_answer *answer,
                       const struct hsr_window *w,
                       void (*copy)(void *row, size_t size, void *data),
                       void *data) {
  struct hsr_array array[HSR_MOST_ARRAYS];
  int n = answer->form.type->arrays(answer, array);
  for (int k = 0; k < n; k++)
    for (int j = w->y0; j < w->y1; j++) {
      size_t at = (size_t)j * (size_t)answer->m + (size_t)w->x0;
      copy((char *)array[k].begin + at * array[k].place,
           (size_t)(w->x1 - w->x0) * array[k].place, data);
    }
}

static void copy_out(void *row, size_t size, void *data) {
  char **bytes = data;
  memcpy(*bytes, row, size);
  *bytes += size;
}

static void copy_in(void *row, size_t size, void *data) {
  const char **bytes = data;
  memcpy(row, *bytes, size);
  *bytes += size;
}

void hsr_answer_pack(const struct hsr_answer *answer,
                     const struct hsr_window *w, void *bytes) {
  char *to = bytes;
  visit_rows(answer, w, copy_out, &to);
}

void hsr_answer_unpack(struct hsr_answer *answer, const struct hsr_window *w,
                       const void *bytes) {
  const char *from = bytes;
  visit_rows(answer, w, copy_in, &from);
}

void hsr_show_background(const struct hsr_showing *showing, const uint32_t *ids,
                         size_t n, float *rgb) {
  for (size_t k = 0; k < n && showing->background.given; k++)
    if (ids[k] == HSR_BACKGROUND)
      memcpy(rgb + 3 * k, showing->background.rgb,
             sizeof showing->background.rgb);
}

void hsr_shaded_free(struct hsr_shaded *shaded) {
  free(shaded->rgb);
  free(shaded->depth);
  *shaded = (struct hsr_shaded){.rgb = NULL};
}
