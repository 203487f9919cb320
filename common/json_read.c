/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/json_read.h"

#include <pthread.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* When its lexer cannot enlarge the buffer for a token, jansson loses a
 * character and goes on, or fails an assertion when it takes it back. So while
 * a text is parsed, memory that malloc does not give comes from a reserve; the
 * text then ends for the parser, and the result is dropped. The reserve does
 * for tokens of up to 4096 characters. */
struct reserve {
  bool touched;
  size_t used;
  _Alignas(max_align_t) char bytes[16384];
};

static _Thread_local struct reserve *reserve; /* NULL: nothing is parsed */
static json_malloc_t outer_malloc;
static json_free_t outer_free;

static void *reserve_malloc(size_t size) {
  void *p = outer_malloc(size);
  if (p || !reserve)
    return p;
  reserve->touched = true;
  if (size > sizeof reserve->bytes - reserve->used)
    return NULL;
  p = reserve->bytes + reserve->used;
  const size_t unit = _Alignof(max_align_t);
  reserve->used += (size + unit - 1) / unit * unit;
  return p;
}

static void reserve_free(void *p) {
  if (!reserve ||
      (uintptr_t)p - (uintptr_t)reserve->bytes >= sizeof reserve->bytes)
    outer_free(p);
}

static void install_reserve(void) {
  json_get_alloc_funcs(&outer_malloc, &outer_free);
  json_set_alloc_funcs(reserve_malloc, reserve_free);
}

struct source {
  json_load_callback_t read;
  void *data;
};

static size_t read_source(void *buffer, size_t size, void *data) {
  const struct source *source = data;
  return reserve->touched ? 0 : source->read(buffer, size, source->data);
}

json_t *hsr_json_read(json_load_callback_t read, void *data, size_t flags,
                      bool *out_of_memory, json_error_t *error) {
  static pthread_once_t installed = PTHREAD_ONCE_INIT;
  pthread_once(&installed, install_reserve);
  struct source source = {read, data};
  struct reserve fresh;
  fresh.touched = false;
  fresh.used = 0;
  reserve = &fresh;
  json_t *root = json_load_callback(read_source, &source, flags, error);
  if (fresh.touched) {
    json_decref(root);
    root = NULL;
  }
  reserve = NULL;
  *out_of_memory = fresh.touched || (!root && json_error_code(error) ==
                                                  json_error_out_of_memory);
  return root;
}

/* What is left of a text. */
struct rest {
  const char *text;
  size_t length;
};

static size_t read_rest(void *buffer, size_t size, void *data) {
  struct rest *rest = data;
  size_t n = rest->length < size ? rest->length : size;
  memcpy(buffer, rest->text, n);
  rest->text += n;
  rest->length -= n;
  return n;
}

json_t *hsr_json_read_text(const char *text, size_t length, size_t flags,
                           bool *out_of_memory, json_error_t *error) {
  return hsr_json_read(read_rest, &(struct rest){text, length}, flags,
                       out_of_memory, error);
}
