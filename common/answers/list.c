/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/answers/answer.h"

const struct hsr_answer_type *const hsr_answer_types[] = {
#define HSR_ANSWER(id) &hsr_answer_##id,
#include "common/answers/list.def"
#undef HSR_ANSWER
    NULL};
