/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/run/crew.h"
#include "bench/trace/trace.h"

#include <stdio.h>

enum hsr_status trace_answer_init(struct trace_answer *answer,
                                  const struct hsr_setup *setup,
                                  const struct hsr_view *view,
                                  struct hsr_error *err) {
  *answer = (struct trace_answer){.view = view};
  enum hsr_status status = answer_init(&answer->drawn, setup, view, err);
  return status ? status : answer_init(&answer->painted, setup, view, err);
}

void trace_answer_free(struct trace_answer *answer) {
  hsr_answer_free(&answer->drawn);
  hsr_answer_free(&answer->painted);
}

enum hsr_status trace_answer_draw(struct trace_answer *answer,
                                  const struct hsr_setup *setup,
                                  struct hsr_tally *tally,
                                  struct hsr_error *err) {
  return render_view(setup, answer->view, 1, &answer->drawn, tally, NULL, err);
}

void trace_answer_paint(struct trace_answer *answer,
                        const struct hsr_event *event) {
  if (answer->painted.form.type->paint(&answer->painted, event))
    answer->out_of_memory = true;
}

enum hsr_status trace_answer_compare(struct trace_answer *answer, char *text,
                                     size_t size) {
  const struct hsr_answer_type *type = answer->drawn.form.type;
  if (answer->out_of_memory || (type->settle && type->settle(&answer->painted)))
    return HSR_E_NOMEM;
  const struct hsr_view *view = answer->view;
  struct hsr_comparison comparison = {.view = view,
                                      .got = &answer->painted,
                                      .wanted = &answer->drawn,
                                      .n = (size_t)view->m * (size_t)view->n};
  struct hsr_difference found = {.differing = 0};
  type->compare(&comparison, &found);
  snprintf(text, size, "%llu of %llu %s, the first %s",
           (unsigned long long)found.differing,
           (unsigned long long)found.compared, type->places, found.first);
  return found.differing ? HSR_E_DIFFERENCE : HSR_OK;
}
