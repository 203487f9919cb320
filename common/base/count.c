/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/base/count.h"

const char *const hsr_question_name[HSR_N_QUESTIONS] = {
#define X(id, name) [HSR_ASK_##id] = name,
    HSR_QUESTIONS(X)
#undef X
};

void hsr_tally_add(struct hsr_tally *to, const struct hsr_tally *from) {
  for (int k = 0; k < HSR_MAX_COUNTERS; k++)
    to->count[k] += from->count[k];
  for (int q = 0; q < HSR_N_QUESTIONS; q++)
    to->exact[q] += from->exact[q];
  to->depths_compared += from->depths_compared;
  to->out_of_memory |= from->out_of_memory;
}
