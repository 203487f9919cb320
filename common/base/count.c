/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/base/count.h"

#include <string.h>

#define X(id, name) name,
const char *const hsr_step_kind_name[HSR_N_STEP_KINDS] = {HSR_STEP_KINDS(X)};
const char *const hsr_subject_kind_name[HSR_N_SUBJECT_KINDS] = {
    HSR_SUBJECT_KINDS(X)};
const char *const hsr_question_name[HSR_N_QUESTIONS] = {HSR_QUESTIONS(X)};
const char *const hsr_cull_name[HSR_N_CULLS] = {HSR_CULLS(X)};
#undef X

bool hsr_has_key(const struct hsr_counter *counter, const char *key) {
  return counter->key && !strcmp(counter->key, key);
}

bool hsr_outcome_has_key(const struct hsr_counter *counter, int outcome,
                         const char *key) {
  const char *at = counter->outcome_keys;
  for (int k = 0; at && k < outcome; k++) {
    at = strchr(at, '|');
    at = at ? at + 1 : NULL;
  }
  size_t length = strlen(key);
  while (at && *at && *at != '|') {
    size_t n = strcspn(at, " |");
    if (n == length && !strncmp(at, key, n))
      return true;
    at += n + (at[n] == ' ');
  }
  return false;
}

void hsr_tally_add(struct hsr_tally *to, const struct hsr_tally *from) {
  for (int k = 0; k < HSR_MAX_COUNTERS; k++)
    to->count[k] += from->count[k];
  for (int q = 0; q < HSR_N_QUESTIONS; q++)
    to->exact[q] += from->exact[q];
  for (int c = 0; c < HSR_N_CULLS; c++)
    to->culled[c] += from->culled[c];
  to->depths_compared += from->depths_compared;
  to->out_of_memory |= from->out_of_memory;
}

void hsr_tally_tell(struct hsr_tally *tally, int counter, struct hsr_subject a,
                    struct hsr_subject b, struct hsr_window window, int outcome,
                    const void *part) {
  struct hsr_trace *trace = tally->trace;
  int place = hsr_tally_place(tally, counter);
  if (place >= HSR_MAX_COUNTERS) /* its part is not listed */
    return;
  struct hsr_event event = {.number = trace->n++,
                            .counter = place,
                            .a = a,
                            .b = b,
                            .own = {a.id[0], b.id[0]},
                            .window = window,
                            .outcome = outcome,
                            .part = part};
  if (trace->name)
    trace->name(trace->names, &event);
  trace->listen(trace->context, &event);
}
