/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files of arrays, .npy: what numpy writes is read, in each type, byte order
 * and version; what is wrong is refused in one line, and a header that lies
 * costs no memory; what is written is read again, in bytes that never change.
 */
#include "common/files/npy.h"
#include "tests/tap.h"

#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#if defined __SANITIZE_ADDRESS__
enum { SANITIZED = 1 };
#elif defined __has_feature
enum { SANITIZED = __has_feature(address_sanitizer) };
#else
enum { SANITIZED = 0 };
#endif

#define COUNT(array) ((int)(sizeof(array) / sizeof *(array)))

static const char path[] = "npy_test.npy";

/* Writes a file of a version, with a header and n bytes of numbers. */
static void write_file(int version, const char *header, const void *data,
                       size_t n) {
  FILE *file = fopen(path, "wb");
  size_t length = strlen(header);
  if (!file)
    bail("no file can be written");
  fprintf(file, "\x93NUMPY%c%c", version, 0);
  for (int k = 0; k < (version == 1 ? 2 : 4); k++)
    putc((int)(length >> (8 * k) & 0xff), file);
  fwrite(header, 1, length, file);
  fwrite(data, 1, n, file);
  if (fclose(file))
    bail("the file is not written");
}

static double number(const struct hsr_npy *a, size_t k) {
  const void *d = a->data;
  switch (a->kind * 10 + a->bytes) {
  case 'u' * 10 + 1:
    return ((const uint8_t *)d)[k];
  case 'u' * 10 + 2:
    return ((const uint16_t *)d)[k];
  case 'u' * 10 + 4:
    return ((const uint32_t *)d)[k];
  case 'u' * 10 + 8:
    return (double)((const uint64_t *)d)[k];
  case 'i' * 10 + 1:
    return ((const int8_t *)d)[k];
  case 'i' * 10 + 2:
    return ((const int16_t *)d)[k];
  case 'i' * 10 + 4:
    return ((const int32_t *)d)[k];
  case 'i' * 10 + 8:
    return (double)((const int64_t *)d)[k];
  case 'f' * 10 + 4:
    return (double)((const float *)d)[k];
  case 'f' * 10 + 8:
    return ((const double *)d)[k];
  default:
    return -1e9;
  }
}

/* --- Right files ---------------------------------------------------------- */

/* Two numbers, and the bytes of them with the most significant one first. */
static const struct {
  const char *type;
  double number[2];
  unsigned char bytes[16];
} types[] = {
    {"u1", {1, 254}, {1, 254}},
    {"u2", {258, 65534}, {1, 2, 0xff, 0xfe}},
    {"u4", {16909060, 4294967295.0}, {1, 2, 3, 4, 255, 255, 255, 255}},
    {"u8",
     {1099511627776.0, 3},
     {0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3}},
    {"i1", {1, -2}, {1, 254}},
    {"i2", {258, -2}, {1, 2, 0xff, 0xfe}},
    {"i4", {16909060, -2}, {1, 2, 3, 4, 255, 255, 255, 254}},
    {"i8",
     {1099511627776.0, -3},
     {0, 0, 1, 0, 0, 0, 0, 0, 255, 255, 255, 255, 255, 255, 255, 253}},
    {"f4", {1.5, -2}, {0x3f, 0xc0, 0, 0, 0xc0, 0, 0, 0}},
    {"f8",
     {1.5, -2},
     {0x3f, 0xf8, 0, 0, 0, 0, 0, 0, 0xc0, 0, 0, 0, 0, 0, 0, 0}},
};

static void test_types(struct tap *t) {
  for (int k = 0; k < COUNT(types); k++)
    for (int big = 0; big < 2; big++) {
      int n = types[k].type[1] - '0';
      unsigned char data[16];
      char header[100];
      struct hsr_npy a;
      struct hsr_error err = {HSR_OK, ""};
      for (int b = 0; b < 2 * n; b++)
        data[b] = types[k].bytes[big ? b : b / n * n + n - 1 - b % n];
      snprintf(header, sizeof header,
               "{'descr': '%c%s', 'fortran_order': False, 'shape': (2,), }\n",
               big ? '>' : '<', types[k].type);
      write_file(1, header, data, (size_t)(2 * n));
      enum hsr_status status = hsr_npy_read(path, &a, &err);
      ok(t,
         !status && a.n_dimensions == 1 && a.size[0] == 2 &&
             number(&a, 0) == types[k].number[0] &&
             number(&a, 1) == types[k].number[1],
         "%c%s is read%s%s", big ? '>' : '<', types[k].type,
         *err.text ? ": " : "", err.text);
      hsr_npy_free(&a);
    }
}

/* The array [[1 2 3] [4 5 6]] in all ways that a header can say it. */
static const struct {
  int version;
  bool by_columns;
  const char *header;
} ways[] = {
    {1, false, "{'descr': '|u1', 'fortran_order': False, 'shape': (2, 3), }"},
    {2, false, "{'descr': '|u1', 'fortran_order': False, 'shape': (2, 3), } "},
    {3, false, "{'descr': '|u1', 'fortran_order': False, 'shape': (2, 3), }\n"},
    {1, true, "{'descr': '|u1', 'fortran_order': True, 'shape': (2, 3), }"},
    {1, false, "{\"shape\":(2L,3L),\"fortran_order\":False,\"descr\":\"|u1\"}"},
    {1, false,
     " { 'shape' : ( 2 , 3 ) , 'descr' : '<u1' , 'fortran_order' : "
     "False } "},
};

static void test_ways(struct tap *t) {
  static const unsigned char rows[] = {1, 2, 3, 4, 5, 6},
                             columns[] = {1, 4, 2, 5, 3, 6};
  for (int k = 0; k < COUNT(ways); k++) {
    struct hsr_npy a;
    struct hsr_error err = {HSR_OK, ""};
    write_file(ways[k].version, ways[k].header,
               ways[k].by_columns ? columns : rows, 6);
    enum hsr_status status = hsr_npy_read(path, &a, &err);
    ok(t,
       !status && a.n_dimensions == 2 && a.size[0] == 2 && a.size[1] == 3 &&
           !memcmp(a.data, rows, 6),
       "version %d, %s%s%s", ways[k].version, ways[k].header,
       *err.text ? ": " : "", err.text);
    hsr_npy_free(&a);
  }
}

/* 2 x 3 x 4 numbers by columns. */
static void test_columns(struct tap *t) {
  unsigned char data[24];
  struct hsr_npy a;
  bool good;
  for (int x = 0; x < 2; x++)
    for (int y = 0; y < 3; y++)
      for (int z = 0; z < 4; z++)
        data[x + 2 * (y + 3 * z)] = (unsigned char)(4 * (3 * x + y) + z);
  write_file(1, "{'descr': '|u1', 'fortran_order': True, 'shape': (2, 3, 4)}",
             data, 24);
  good = !hsr_npy_read(path, &a, NULL);
  for (int k = 0; good && k < 24; k++)
    good = ((unsigned char *)a.data)[k] == k;
  ok(t, good, "three dimensions by columns become rows");
  hsr_npy_free(&a);
}

static void test_few(struct tap *t) {
  struct hsr_npy a;
  const float seven = 7;
  write_file(1, "{'descr': '=f4', 'fortran_order': False, 'shape': ()}", &seven,
             4);
  bool good = !hsr_npy_read(path, &a, NULL) && a.n_dimensions == 0 &&
              hsr_npy_count(&a) == 1 && number(&a, 0) == 7;
  ok(t, good, "one number has no dimensions");
  hsr_npy_free(&a);
  write_file(1, "{'descr': '<f8', 'fortran_order': False, 'shape': (0, 5)}", "",
             0);
  good = !hsr_npy_read(path, &a, NULL) && a.size[0] == 0 && a.size[1] == 5 &&
         hsr_npy_count(&a) == 0;
  ok(t, good, "an array may be empty");
  hsr_npy_free(&a);
}

/* --- Wrong files ---------------------------------------------------------- */

#define DICT(type, order, shape)                                               \
  "{'descr': " type ", 'fortran_order': " order ", 'shape': " shape "}"

static const struct {
  const char *header, *said;
} wrong[] = {
    {DICT("'<u4'", "False", "(1, 2)"), "ends early: 4 bytes"},
    {DICT("'|u1'", "False", "(3,)"), "1 bytes too many"},
    {DICT("'|u1'", "False", "(0, 3)"), "4 bytes too many"},
    {DICT("'<u4'", "False", "(4294967296, 4294967296)"), "ends early"},
    {DICT("'<f8'", "False", "(2305843009213693952,)"), "ends early"},
    {DICT("'<u4'", "False", "(99999999999999999999,)"), "no size"},
    {DICT("'<u4'", "False", "(-1,)"), "no size"},
    {DICT("'<u4'", "False", "(1 2)"), "does not end"},
    {DICT("'<u4'", "False", "(1,"), "no size"},
    {DICT("'<u4'", "False", "[1]"), "not a list in brackets"},
    {DICT("'<u4'", "False", "(1,1,1,1,1,1,1,1,1)"), "more than 8"},
    {DICT("'<u4'", "0", "(1,)"), "neither True nor False"},
    {DICT("'<c8'", "False", "(1,)"), "type '<c8'"},
    {DICT("'|b1'", "False", "(4,)"), "type '|b1'"},
    {DICT("'|O'", "False", "(4,)"), "type '|O'"},
    {DICT("'<f2'", "False", "(2,)"), "type '<f2'"},
    {DICT("'|u4'", "False", "(1,)"), "type '|u4'"},
    {DICT("'u4'", "False", "(1,)"), "type 'u4'"},
    {DICT("'<U12'", "False", "(1,)"), "type '<U12'"},
    {DICT("[('x', '<u4')]", "False", "(1,)"), "a structured array"},
    {DICT("4", "False", "(1,)"), "not the name of a type"},
    {DICT("'<u4", "False", "(1,)"), "type '<u4, '"},
    {"{'descr': '<u4', 'shape': (1,)}", "not all of"},
    {"{'descr': '<u4', 'fortran_order': False, 'shape': (1,), 'x': 1}",
     "unknown 'x'"},
    {"{'descr': '<u4', 'fortran_order': False, 'shape': (1,)} x",
     "goes on after its end"},
    {"{'descr': '<u4', 'fortran_order': False, 'shape': (1,)", "does not end"},
    {"{'descr': '<u4' 'fortran_order': False, 'shape': (1,)}", "does not end"},
    {"[]", "no dict"},
    {"", "no dict"},
    {"{3: 4}", "names and values"},
    {"{'descr", "names and values"},
};

static bool is_refused(const char *said, const char *what, struct tap *t) {
  struct hsr_npy a;
  struct hsr_error err = {HSR_OK, ""};
  enum hsr_status status = hsr_npy_read(path, &a, &err);
  bool good = status == HSR_E_INPUT && strstr(err.text, said) &&
              !strncmp(err.text, path, strlen(path)) && !a.data;
  ok(t, good, "%s: %s", what, *err.text ? err.text : "is not refused");
  hsr_npy_free(&a);
  return good;
}

static void test_wrong(struct tap *t) {
  for (int k = 0; k < COUNT(wrong); k++) {
    write_file(1, wrong[k].header, "abcd", 4);
    is_refused(wrong[k].said, wrong[k].header, t);
  }
}

/* Each beginning of a right file is refused. */
static void test_cut(struct tap *t) {
  struct hsr_npy a = {'u', 4, 1, {2}, (uint32_t[]){1, 2}};
  struct stat about;
  int refused = 0;
  if (hsr_npy_write(path, &a, NULL) || stat(path, &about))
    bail("the file is not written");
  for (off_t k = about.st_size - 1; k >= 0; k--)
    if (!truncate(path, k))
      refused += hsr_npy_read(path, &a, NULL) == HSR_E_INPUT;
  ok(t, refused == (int)about.st_size && refused > 80,
     "a file that is cut off anywhere is refused (%d places)", refused);
}

static void test_whole(struct tap *t) {
  struct hsr_npy a;
  struct hsr_error err = {HSR_OK, ""};
  write_file(4, DICT("'|u1'", "False", "(4,)"), "abcd", 4);
  is_refused("version 4.0", "a version that is not known", t);
  remove(path);
  is_refused("cannot be read", "no file", t);
  ok(t,
     hsr_npy_read(".", &a, &err) == HSR_E_INPUT &&
         strstr(err.text, "directory"),
     "a folder: %s", err.text);
}

/* Headers that promise 1 GB of numbers, and of header. */
static void test_lies(struct tap *t) {
  struct rlimit all, little;
  FILE *file;
  getrlimit(RLIMIT_DATA, &all);
  little = all;
  little.rlim_cur = 64 << 20;
  if (SANITIZED)
    little = all; /* its own memory does not fit */
  setrlimit(RLIMIT_DATA, &little);
  write_file(1, DICT("'<u4'", "True", "(16384, 16384)"), "abcd", 4);
  is_refused("ends early", "numbers of 1 GB are promised", t);
  file = fopen(path, "wb");
  if (!file || fwrite("\x93NUMPY\2\0\0\0\0\x40{", 1, 13, file) != 13 ||
      fclose(file))
    bail("the file is not written");
  is_refused("ends in its header", "a header of 1 GB is promised", t);
  setrlimit(RLIMIT_DATA, &all);
}

/* --- Writing -------------------------------------------------------------- */

/* What numpy 1.26 writes for array([[1, 2], [3, 4294967295]], dtype='<u4'). */
static const char ids[] =
    "\x93NUMPY\1\0v\0{'descr': '<u4', 'fortran_order': False, 'shape': (2, 2), "
    "}                                                          \n"
    "\1\0\0\0\2\0\0\0\3\0\0\0\xff\xff\xff\xff";

static void test_written(struct tap *t) {
  const uint32_t data[] = {1, 2, 3, 4294967295u};
  struct hsr_npy a = {'u', 4, 2, {2, 2}, (void *)data}, b;
  char bytes[200];
  FILE *file = hsr_npy_write(path, &a, NULL) ? NULL : fopen(path, "rb");
  size_t n = file ? fread(bytes, 1, sizeof bytes, file) : 0;
  if (file)
    fclose(file);
  ok(t, n == sizeof ids - 1 && !memcmp(bytes, ids, n),
     "ids are written as numpy does (%zu bytes)", n);
  ok(t,
     !hsr_npy_read(path, &b, NULL) && b.kind == 'u' && b.bytes == 4 &&
         b.n_dimensions == 2 && b.size[0] == 2 && b.size[1] == 2 &&
         !memcmp(b.data, data, sizeof data),
     "and read again");
  hsr_npy_free(&b);
}

/* More numbers than are written at once, of each number of dimensions. */
static void test_large(struct tap *t) {
  double *data = malloc(4096 * sizeof *data);
  bool good = data;
  for (int k = 0; good && k < 4096; k++)
    data[k] = k / 3.0;
  for (int d = 0; good && d <= HSR_NPY_MOST_DIMENSIONS; d++) {
    struct hsr_npy a = {'f', 8, d, {0}, data}, b = {.data = NULL};
    for (int k = 0; k < d; k++)
      a.size[k] = d <= 6 && k < 6 ? (uint64_t)(d == 1 ? 4095 : 4) : 2;
    good = !hsr_npy_write(path, &a, NULL) && !hsr_npy_read(path, &b, NULL) &&
           b.n_dimensions == d && !memcmp(a.size, b.size, sizeof a.size) &&
           !memcmp(b.data, data, hsr_npy_count(&a) * sizeof *data);
    hsr_npy_free(&b);
  }
  ok(t, good, "0 to 8 dimensions are written, and read again");
  free(data);
}

static void test_unwritable(struct tap *t) {
  char byte = 7;
  struct hsr_npy a = {'u', 1, 1, {1}, &byte};
  struct hsr_error err = {HSR_OK, ""};
  ok(t, hsr_npy_write("/nowhere/x.npy", &a, &err) == HSR_E_INPUT && *err.text,
     "a folder that is not there: %s", err.text);
}

int main(void) {
  struct tap t = plan(2 * COUNT(types) + COUNT(ways) + 3 + COUNT(wrong) + 4 +
                      2 + 2 + 1 + 1);
  test_types(&t);
  test_ways(&t);
  test_columns(&t);
  test_few(&t);
  test_wrong(&t);
  test_cut(&t);
  test_whole(&t);
  test_lies(&t);
  test_written(&t);
  test_large(&t);
  test_unwritable(&t);
  remove(path);
  return finish(&t);
}
