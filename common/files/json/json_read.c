/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/files/json/json_read.h"

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

/* --- Parts ---------------------------------------------------------------- */

static bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

static const char *skip_spaces(const char *at, const char *end) {
  while (at < end && is_space(*at))
    at++;
  return at;
}

/* From a quotation mark to beyond the one that ends the string, or the end. */
static const char *skip_string(const char *at, const char *end) {
  for (at++; at < end && *at != '"'; at++)
    at += *at == '\\' && at + 1 < end;
  return at < end ? at + 1 : end;
}

/* From an opening bracket to beyond its closing one; the end if there is none.
 * That the kinds of brackets match is left to the parser. */
static const char *skip_brackets(const char *at, const char *end) {
  size_t depth = 0;
  while (at < end) {
    if (*at == '"') {
      at = skip_string(at, end);
      continue;
    }
    depth += *at == '[' || *at == '{';
    depth -= *at == ']' || *at == '}';
    at++;
    if (!depth)
      break;
  }
  return at;
}

/* From a value, or what should be one, to the comma or bracket after it. */
static const char *skip_value(const char *at, const char *end) {
  while (at < end && *at != ',' && *at != ']' && *at != '}')
    if (*at == '"')
      at = skip_string(at, end);
    else if (*at == '[' || *at == '{')
      at = skip_brackets(at, end);
    else
      at++;
  return at;
}

int hsr_json_lines(const char *at, const char *end) {
  int lines = 0;
  while (at < end && (at = memchr(at, '\n', (size_t)(end - at)))) {
    lines++;
    at++;
  }
  return lines;
}

/* What the parser is given: of each list the newlines, and all between lists.
 */
struct omission {
  const char *from, *to;
};
struct outline {
  struct hsr_json_part endless; /* the list that has no end, if one has none */
  struct omission omitted[HSR_JSON_MOST_LISTS];
  int n, next;
  const char *at, *end;
  bool out_of_memory;
};

static size_t read_outline(void *buffer, size_t size, void *data) {
  struct outline *o = data;
  char *to = buffer;
  size_t n = 0;
  while (n < size && o->at < o->end) {
    const struct omission *omission = &o->omitted[o->next];
    bool more = o->next < o->n;
    if (more && o->at >= omission->from) {
      const char *newline = memchr(o->at, '\n', (size_t)(omission->to - o->at));
      o->at = newline ? newline + 1 : omission->to;
      if (newline)
        to[n++] = '\n';
      o->next += o->at == omission->to;
    } else {
      size_t rest = (size_t)((more ? omission->from : o->end) - o->at);
      size_t some = rest < size - n ? rest : size - n;
      memcpy(to + n, o->at, some);
      n += some;
      o->at += some;
    }
  }
  return n;
}

/* Whether a string, with its quotation marks, is `key`; however it is escaped.
 */
static bool is_key(struct outline *o, const char *at, const char *end,
                   const char *key) {
  size_t n = strlen(key), length = (size_t)(end - at);
  if (!memchr(at, '\\', length))
    return length == n + 2 && !memcmp(at + 1, key, n);
  bool out_of_memory;
  json_error_t error;
  json_t *text =
      hsr_json_read_text(at, length, JSON_DECODE_ANY, &out_of_memory, &error);
  bool is = json_is_string(text) && !strcmp(json_string_value(text), key);
  json_decref(text);
  o->out_of_memory |= out_of_memory;
  return is;
}

/* Without what may be the beginning of another element. */
static const char *last_end(const char *at, const char *end) {
  while (end > at && is_space(end[-1]))
    end--;
  return end > at && end[-1] == ',' ? end - 1 : end;
}

/* Leaves out the elements of the array that begins at `at`: a list, unless it
 * is empty, or has no end. */
static struct hsr_json_part omit(struct outline *o, struct hsr_json_part part,
                                 const char *at) {
  static const struct hsr_json_part none = {NULL, 0, 0};
  const char *from = at + 1, *to = skip_brackets(at, o->end);
  bool is_bracket = to > from && (to[-1] == ']' || to[-1] == '}');
  bool ends = is_bracket && to[-1] == ']';
  to -= is_bracket; /* a wrong one is for the parser to see */
  o->omitted[o->n++] = (struct omission){from, to};
  const char *end = ends ? to : last_end(from, to);
  struct hsr_json_part list = {from, (size_t)(end - from),
                               part.line + hsr_json_lines(part.text, at)};
  bool is_empty = skip_spaces(from, end) == end;
  if (ends)
    return is_empty ? none : list;
  o->endless = is_empty ? none : list;
  return none;
}

/* Notes a list if a member whose value is at `at` is one. */
static void find_list(struct outline *o, struct hsr_json_part part,
                      const char *const *keys, struct hsr_json_part *list,
                      const char *key, const char *key_end, const char *at) {
  for (int k = 0; keys[k] && at < o->end && *at == '['; k++)
    if (o->n < HSR_JSON_MOST_LISTS && is_key(o, key, key_end, keys[k]))
      list[k] = omit(o, part, at);
}

/* The lists of an object that begins at `at`. */
static void find_lists(struct outline *o, struct hsr_json_part part,
                       const char *const *keys, struct hsr_json_part *list,
                       const char *at) {
  while (at < o->end && *at != '}') {
    const char *key = skip_spaces(at + 1, o->end), *key_end = key;
    if (key < o->end && *key == '"')
      key_end = skip_string(key, o->end);
    at = skip_spaces(key_end, o->end);
    if (key_end > key && at < o->end && *at == ':') {
      at = skip_spaces(at + 1, o->end);
      find_list(o, part, keys, list, key, key_end, at);
    }
    at = skip_value(at, o->end);
    if (at < o->end && *at == ']')
      return;
  }
}

/* The outline of a value; and its lists. */
static struct outline find_outline(struct hsr_json_part part,
                                   const char *const *keys,
                                   struct hsr_json_part *list) {
  struct outline o = {.at = part.text, .end = part.text + part.length};
  const char *first = skip_spaces(o.at, o.end);
  for (int k = 0; keys && keys[k]; k++)
    list[k] = (struct hsr_json_part){NULL, 0, 0};
  if (keys && first < o.end && *first == '{')
    find_lists(&o, part, keys, list, first);
  if (keys && first < o.end && *first == '[')
    omit(&o, part, first);
  return o;
}

/* The first fault in a list, if there is one. */
static bool find_fault(struct hsr_json_part list, size_t flags,
                       const hsr_json_levels *levels, bool *out_of_memory,
                       json_error_t *error) {
  struct hsr_json_part element, inner[HSR_JSON_MOST_LISTS];
  bool found = false;
  while (!found && !*out_of_memory && hsr_json_next(&list, &element)) {
    json_t *value = hsr_json_read_part(element, flags | JSON_DECODE_ANY, levels,
                                       inner, out_of_memory, error);
    found = !value;
    for (int k = 0; *levels && (*levels)[k] && !found; k++)
      found = find_fault(inner[k], flags, levels + 1, out_of_memory, error);
    json_decref(value);
  }
  return found;
}

json_t *hsr_json_read_part(struct hsr_json_part part, size_t flags,
                           const hsr_json_levels *levels,
                           struct hsr_json_part *list, bool *out_of_memory,
                           json_error_t *error) {
  struct outline outline = find_outline(part, *levels, list);
  struct hsr_json_part endless = outline.endless;
  *out_of_memory = outline.out_of_memory;
  if (*out_of_memory)
    return NULL;
  json_t *root =
      hsr_json_read(read_outline, &outline, flags, out_of_memory, error);
  error->line += part.line - 1;
  if (!root && !*out_of_memory && endless.text) {
    json_error_t inner;
    if (find_fault(endless, flags, levels + 1, out_of_memory, &inner))
      *error = inner;
  }
  return root;
}

size_t hsr_json_count(struct hsr_json_part list) {
  struct hsr_json_part element;
  size_t n = 0;
  while (hsr_json_next(&list, &element))
    n++;
  return n;
}

bool hsr_json_next(struct hsr_json_part *list, struct hsr_json_part *element) {
  if (!list->text)
    return false;
  const char *end = list->text + list->length;
  const char *to = list->text;
  while (to < end && *to != ',')
    to = *to == ']' || *to == '}' ? to + 1 : skip_value(to, end);
  /* Where there is nothing, what is there instead. */
  bool is_blank = skip_spaces(list->text, to) == to;
  *element = (struct hsr_json_part){
      list->text, (size_t)(to - list->text) + is_blank, list->line};
  list->line += hsr_json_lines(list->text, to);
  list->text = to < end ? to + 1 : NULL;
  list->length = to < end ? (size_t)(end - to - 1) : 0;
  return true;
}
