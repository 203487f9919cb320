/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Keys of counters and of their outcomes. */
#include "common/base/count.h"
#include "tests/tap.h"

static const struct hsr_counter some = {.name = "tests",
                                        .outcomes = "in|out|neither|both",
                                        .key = "box-test",
                                        .outcome_keys =
                                            "boxes body||boxes-apart|body"};
static const struct hsr_counter plain = {.name = "faces"};
static const struct hsr_counter each = {.name = "pairs",
                                        .outcome_keys = "boxes"};

int main(void) {
  struct tap tap = plan(6);
  ok(&tap, hsr_has_key(&some, "box-test") && !hsr_has_key(&plain, "box-test"),
     "a counter has its key, or none");
  ok(&tap,
     hsr_outcome_has_key(&some, 0, "boxes") &&
         hsr_outcome_has_key(&some, 0, "body"),
     "an outcome has each of its keys");
  ok(&tap,
     !hsr_outcome_has_key(&some, 1, "boxes") &&
         !hsr_outcome_has_key(&some, 1, "") &&
         !hsr_outcome_has_key(&some, 3, "boxes") &&
         hsr_outcome_has_key(&some, 3, "body"),
     "it has none of another one's");
  ok(&tap,
     !hsr_outcome_has_key(&some, 2, "boxes") &&
         !hsr_outcome_has_key(&some, 0, "box"),
     "part of a key is none");
  ok(&tap,
     !hsr_outcome_has_key(&some, 4, "body") &&
         !hsr_outcome_has_key(&plain, 0, "boxes"),
     "what is not there has none");
  ok(&tap, hsr_outcome_has_key(&each, 0, "boxes"),
     "a counter without outcomes has those of its steps");
  return finish(&tap);
}
