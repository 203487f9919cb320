/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/files/npy.h"

#include "common/files/whole_file.h"
#include "common/files/whole_input.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const unsigned char MAGIC[6] = {0x93, 'N', 'U', 'M', 'P', 'Y'};

size_t hsr_npy_count(const struct hsr_npy *array) {
  size_t n = 1;
  for (int d = 0; d < array->n_dimensions; d++)
    n *= (size_t)array->size[d];
  return n;
}

void hsr_npy_free(struct hsr_npy *array) {
  free(array->data);
  array->data = NULL;
}

static bool is_little(void) {
  const uint16_t one = 1;
  return *(const unsigned char *)&one == 1;
}

/* Turns the bytes of n numbers round. */
static void swap_bytes(unsigned char *data, size_t n, int bytes) {
  for (; n > 0; n--, data += bytes)
    for (int a = 0, b = bytes - 1; a < b; a++, b--) {
      unsigned char kept = data[a];
      data[a] = data[b];
      data[b] = kept;
    }
}

/* --- The header ----------------------------------------------------------- */

/* The text of a Python dict, as it is read. */
struct header {
  const char *path;
  const char *at, *end;
  bool has_type, has_order, has_shape;
  bool big, by_columns;
  struct hsr_npy *array;
  struct hsr_error *err;
};

static enum hsr_status fail(const struct header *h, const char *what) {
  return hsr_fail(h->err, HSR_E_INPUT, "%s: %s", hsr_path_shown(h->path), what);
}

static void skip_space(struct header *h) {
  while (h->at < h->end && strchr(" \t\r\n", *h->at) && *h->at)
    h->at++;
}

/* Takes a character, if it comes next. */
static bool take(struct header *h, char c) {
  skip_space(h);
  if (h->at == h->end || *h->at != c)
    return false;
  h->at++;
  return true;
}

static bool take_word(struct header *h, const char *word) {
  size_t length = strlen(word);
  skip_space(h);
  if ((size_t)(h->end - h->at) < length || memcmp(h->at, word, length) != 0)
    return false;
  h->at += length;
  return true;
}

/* Takes a string in quotation marks of either kind, of less than `size`
 * characters. */
static bool take_string(struct header *h, char *text, size_t size) {
  char mark = take(h, '\'') ? '\'' : take(h, '"') ? '"' : 0;
  size_t n = 0;
  if (!mark)
    return false;
  for (; h->at < h->end && *h->at != mark; h->at++) {
    if (n + 1 >= size || *h->at == '\\')
      return false;
    text[n++] = *h->at;
  }
  text[n] = 0;
  return take(h, mark);
}

static enum hsr_status take_type(struct header *h) {
  char type[64];
  struct hsr_npy *a = h->array;
  skip_space(h);
  if (h->at < h->end && *h->at == '[')
    return fail(h, "a structured array; one of plain numbers is needed");
  if (!take_string(h, type, sizeof type))
    return fail(h, "the header's 'descr' is not the name of a type");
  bool known = strlen(type) == 3 && strchr("<>=|", type[0]) &&
               strchr("uif", type[1]) && strchr("1248", type[2]);
  if (!known || (type[1] == 'f' && type[2] < '4') ||
      (type[0] == '|' && type[2] != '1'))
    return hsr_fail(h->err, HSR_E_INPUT,
                    "%s: numbers of the type '%s'; u1 to u8, i1 to i8, f4 and "
                    "f8 can be read",
                    hsr_path_shown(h->path), type);
  a->kind = type[1];
  a->bytes = type[2] - '0';
  h->big = type[0] == '>' || (type[0] == '=' && !is_little());
  h->has_type = true;
  return HSR_OK;
}

static enum hsr_status take_order(struct header *h) {
  h->by_columns = take_word(h, "True");
  if (!h->by_columns && !take_word(h, "False"))
    return fail(h, "the header's 'fortran_order' is neither True nor False");
  h->has_order = true;
  return HSR_OK;
}

/* A whole number; old files have an L behind it. */
static bool take_size(struct header *h, uint64_t *size) {
  const char *begin = h->at;
  *size = 0;
  for (; h->at < h->end && *h->at >= '0' && *h->at <= '9'; h->at++) {
    uint64_t digit = (uint64_t)(*h->at - '0');
    if (*size > (UINT64_MAX - digit) / 10)
      return false;
    *size = 10 * *size + digit;
  }
  bool some = h->at > begin;
  if (some && h->at < h->end && *h->at == 'L')
    h->at++;
  return some;
}

static enum hsr_status take_shape(struct header *h) {
  struct hsr_npy *a = h->array;
  a->n_dimensions = 0;
  if (!take(h, '('))
    return fail(h, "the header's 'shape' is not a list in brackets");
  while (!take(h, ')')) {
    if (a->n_dimensions == HSR_NPY_MOST_DIMENSIONS)
      return fail(h, "the array has more than 8 dimensions");
    skip_space(h);
    if (!take_size(h, &a->size[a->n_dimensions]))
      return fail(h, "the header's 'shape' has what is no size");
    a->n_dimensions++;
    skip_space(h);
    if (!take(h, ',') && (h->at == h->end || *h->at != ')'))
      return fail(h, "the header's 'shape' does not end");
  }
  h->has_shape = true;
  return HSR_OK;
}

static enum hsr_status take_member(struct header *h) {
  char key[64];
  if (!take_string(h, key, sizeof key) || !take(h, ':'))
    return fail(h, "the header is no dict of names and values");
  if (!strcmp(key, "descr"))
    return take_type(h);
  if (!strcmp(key, "fortran_order"))
    return take_order(h);
  if (!strcmp(key, "shape"))
    return take_shape(h);
  return hsr_fail(h->err, HSR_E_INPUT, "%s: the header has an unknown '%s'",
                  hsr_path_shown(h->path), key);
}

static enum hsr_status take_dict(struct header *h) {
  if (!take(h, '{'))
    return fail(h, "the header is no dict");
  while (!take(h, '}')) {
    enum hsr_status status = take_member(h);
    if (status)
      return status;
    skip_space(h);
    if (!take(h, ',') && (h->at == h->end || *h->at != '}'))
      return fail(h, "the header does not end");
  }
  skip_space(h);
  if (h->at != h->end)
    return fail(h, "the header goes on after its end");
  return h->has_type && h->has_order && h->has_shape
             ? HSR_OK
             : fail(h, "the header has not all of 'descr', 'fortran_order' and "
                       "'shape'");
}

/* --- Reading -------------------------------------------------------------- */

/* Finds the header in the bytes of a file. *begin becomes the number of the
 * first byte after it. */
static enum hsr_status find_header(struct header *h, const unsigned char *bytes,
                                   size_t size, size_t *begin) {
  if (size < 8 || memcmp(bytes, MAGIC, sizeof MAGIC) != 0)
    return fail(h, "is no .npy file");
  if (bytes[6] < 1 || bytes[6] > 3 || bytes[7] != 0)
    return hsr_fail(h->err, HSR_E_INPUT,
                    "%s: version %d.%d of the format; 1.0, 2.0 and 3.0 can be "
                    "read",
                    hsr_path_shown(h->path), bytes[6], bytes[7]);
  const size_t digits = bytes[6] == 1 ? 2 : 4, first = 8 + digits;
  size_t length = 0;
  if (size < first)
    return fail(h, "ends in its header");
  for (size_t k = digits; k > 0; k--)
    length = length << 8 | bytes[8 + k - 1];
  if (length > size - first)
    return fail(h, "ends in its header");
  h->at = (const char *)bytes + first;
  h->end = h->at + length;
  *begin = first + length;
  return HSR_OK;
}

/* Whether so many bytes hold just what the header promises. */
static enum hsr_status check_size(const struct header *h, size_t size) {
  const struct hsr_npy *a = h->array;
  size_t n = (size_t)a->bytes;
  bool too_large = false, none = false;
  for (int d = 0; d < a->n_dimensions; d++) {
    none |= a->size[d] == 0;
    too_large |= a->size[d] > SIZE_MAX / n;
    n = too_large || none ? 1 : n * (size_t)a->size[d];
  }
  if (none)
    n = 0;
  if ((too_large && !none) || n > size)
    return hsr_fail(h->err, HSR_E_INPUT,
                    "%s: the file ends early: %zu bytes of numbers are there",
                    hsr_path_shown(h->path), size);
  return n == size ? HSR_OK
                   : hsr_fail(h->err, HSR_E_INPUT,
                              "%s: %zu bytes too many after the last number",
                              hsr_path_shown(h->path), size - n);
}

/* Copies numbers that stand by columns, by rows. */
static void copy_by_rows(const struct hsr_npy *a, const unsigned char *from,
                         unsigned char *to) {
  const size_t n = hsr_npy_count(a), bytes = (size_t)a->bytes;
  size_t step[HSR_NPY_MOST_DIMENSIONS], at = 0;
  uint64_t index[HSR_NPY_MOST_DIMENSIONS] = {0};
  for (int d = 0; d < a->n_dimensions; d++)
    step[d] = d ? step[d - 1] * (size_t)a->size[d - 1] : 1;
  for (size_t k = 0; k < n; k++) {
    memcpy(to + k * bytes, from + at * bytes, bytes);
    for (int d = a->n_dimensions - 1; d >= 0; d--) {
      at += step[d];
      if (++index[d] < a->size[d])
        break;
      at -= step[d] * (size_t)a->size[d];
      index[d] = 0;
    }
  }
}

static enum hsr_status take_numbers(struct header *h,
                                    const unsigned char *bytes, size_t size) {
  struct hsr_npy *a = h->array;
  enum hsr_status status = check_size(h, size);
  if (status)
    return status;
  unsigned char *data = a->data = malloc(size + 1);
  if (!data)
    return hsr_fail_nomem(h->err);
  if (h->by_columns && a->n_dimensions > 1)
    copy_by_rows(a, bytes, data);
  else
    memcpy(data, bytes, size);
  if (h->big == is_little())
    swap_bytes(data, hsr_npy_count(a), a->bytes);
  return HSR_OK;
}

enum hsr_status hsr_npy_read(const char *path, struct hsr_npy *array,
                             struct hsr_error *err) {
  unsigned char *bytes;
  size_t size, begin = 0;
  *array = (struct hsr_npy){.data = NULL};
  struct header h = {.path = path, .array = array, .err = err};
  enum hsr_status status = hsr_whole_input(path, &bytes, &size, err);
  if (status)
    return status;
  status = find_header(&h, bytes, size, &begin);
  if (!status)
    status = take_dict(&h);
  if (!status)
    status = take_numbers(&h, bytes + begin, size - begin);
  free(bytes);
  return status;
}

/* --- Writing -------------------------------------------------------------- */

enum { MOST_HEADER = 384, GRAIN = 64 };

/* The header, padded so that the numbers begin at a multiple of 64 bytes.
 * Returns its length. */
static size_t make_header(const struct hsr_npy *a, unsigned char *text) {
  char *to = (char *)text + 10;
  size_t room = MOST_HEADER - 10;
  size_t n = (size_t)snprintf(
      to, room, "{'descr': '%c%c%d', 'fortran_order': False, 'shape': (",
      a->bytes == 1 ? '|' : '<', a->kind, a->bytes);
  for (int d = 0; d < a->n_dimensions; d++)
    n += (size_t)snprintf(to + n, room - n, "%s%llu%s", d ? " " : "",
                          (unsigned long long)a->size[d],
                          d + 1 < a->n_dimensions || a->n_dimensions == 1 ? ","
                                                                          : "");
  n += (size_t)snprintf(to + n, room - n, "), }");
  while ((10 + n + 1) % GRAIN)
    to[n++] = ' ';
  to[n++] = '\n';
  memcpy(text, MAGIC, sizeof MAGIC);
  text[6] = 1;
  text[7] = 0;
  text[8] = (unsigned char)(n & 0xff);
  text[9] = (unsigned char)(n >> 8);
  return 10 + n;
}

/* Writes the numbers, the least significant byte first. */
static void put_numbers(const struct hsr_npy *a, FILE *out) {
  unsigned char some[4096];
  const size_t bytes = (size_t)a->bytes, most = sizeof some / bytes;
  const unsigned char *from = a->data;
  for (size_t n = hsr_npy_count(a), k; n > 0; n -= k, from += k * bytes) {
    k = n < most ? n : most;
    memcpy(some, from, k * bytes);
    if (!is_little())
      swap_bytes(some, k, a->bytes);
    if (fwrite(some, bytes, k, out) != k)
      return; /* closing finds that out */
  }
}

enum hsr_status hsr_npy_write(const char *path, const struct hsr_npy *array,
                              struct hsr_error *err) {
  unsigned char header[MOST_HEADER];
  struct hsr_whole_file file;
  enum hsr_status status = hsr_whole_file_open(&file, path, err);
  if (status)
    return status;
  size_t n = make_header(array, header);
  if (fwrite(header, 1, n, file.stream) == n)
    put_numbers(array, file.stream);
  return hsr_whole_file_close(&file, HSR_OK, err);
}
