/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/web/web.h"

#include <stdlib.h>

/* What lasts until the next call. */
enum { MOST_KEPT = 16 };
static struct {
  struct hsr_error err;
  char *text;
  void *memory[MOST_KEPT];
  int n;
  struct lib_answer *answer;
} last;

struct hsr_error *web_begin(void) {
  free(last.text);
  last.text = NULL;
  while (last.n)
    free(last.memory[--last.n]);
  hsr_free(last.answer);
  last.answer = NULL;
  last.err = (struct hsr_error){.status = HSR_OK};
  return &last.err;
}

void *web_keep(void *memory) {
  if (memory)
    last.memory[last.n++] = memory;
  return memory;
}

void web_keep_answer(struct lib_answer *answer) {
  last.answer = answer;
}

enum hsr_status web_end(enum hsr_status status, json_t *reply) {
  enum { FLAGS = JSON_COMPACT | JSON_ENCODE_ANY };
  if (!status)
    last.text = reply ? json_dumps(reply, FLAGS) : NULL;
  json_decref(reply);
  if (!status && !last.text)
    status = hsr_fail_nomem(&last.err);
  return status;
}

WEB_CALL const char *web_reply(void) {
  return last.text ? last.text : last.err.text;
}

json_t *web_address(const void *array) {
  return array ? json_integer((json_int_t)(uintptr_t)array) : json_null();
}

json_t *web_text_or_null(const char *text) {
  return text ? json_string(text) : json_null();
}

/* Memory that the page fills with arguments. */
WEB_CALL void *web_allocate(size_t size) {
  return malloc(size ? size : 1);
}
WEB_CALL void web_free(void *memory) {
  free(memory);
}
