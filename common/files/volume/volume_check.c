/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks of volume files before they are read.
 *
 * Safety      VTK believes headers: it takes the memory that they ask for. So
 *             each is parsed here first. What a file claims must be there, and
 *             a word that is not known is refused, or not shown to VTK. */
#ifndef _POSIX_C_SOURCE
#define _POSIX_C_SOURCE 200809L
#endif
#include "common/files/volume/volume_check.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

enum hsr_status hsr_volume_refuse(const struct hsr_volume_file *file,
                                  struct hsr_error *err, const char *why, ...) {
  char text[300];
  va_list args;
  va_start(args, why);
  vsnprintf(text, sizeof text, why, args);
  va_end(args);
  return hsr_fail(err, HSR_E_INPUT, "%.200s: %s", file->path, text);
}

void hsr_volume_note(struct hsr_volume_file *file, const char *what, ...) {
  char text[300];
  va_list args;
  va_start(args, what);
  vsnprintf(text, sizeof text, what, args);
  va_end(args);
  size_t used = strlen(file->notes), room = sizeof file->notes - used;
  int n = snprintf(file->notes + used, room, "%.200s: %s\n", file->path, text);
  if (n < 0 || (size_t)n >= room)
    file->notes[used] = '\0';
}

enum hsr_status hsr_volume_size_of(const char *path, uint64_t *size,
                                   struct hsr_error *err) {
  struct stat about;
  if (stat(path, &about))
    return hsr_fail(err, HSR_E_INPUT, "%.200s: %s", path, strerror(errno));
  if (!S_ISREG(about.st_mode))
    return hsr_fail(err, HSR_E_INPUT, "%.200s: is no file", path);
  *size = (uint64_t)about.st_size;
  return HSR_OK;
}

bool hsr_volume_set_sizes(struct hsr_volume_file *file, const long long n[3]) {
  for (int a = 0; a < 3; a++) {
    if (n[a] < 1 || n[a] > HSR_VOLUME_MOST)
      return false;
    file->n[a] = (uint32_t)n[a];
  }
  return true;
}

double hsr_volume_samples(const struct hsr_volume_file *file) {
  return (double)file->n[0] * file->n[1] * file->n[2];
}

bool hsr_volume_can_hold(const struct hsr_volume_file *file, uint64_t size,
                         double before, double bytes) {
  return before >= 0 &&
         before + hsr_volume_samples(file) * bytes <= (double)size;
}

int hsr_volume_type_bytes(enum hsr_volume_type type) {
  static const int bytes[] = {
      [HSR_U8] = 1,  [HSR_I8] = 1,  [HSR_U16] = 2, [HSR_I16] = 2,
      [HSR_U32] = 4, [HSR_I32] = 4, [HSR_U64] = 8, [HSR_I64] = 8,
      [HSR_F32] = 4, [HSR_F64] = 8};
  return bytes[type];
}

/* --- Files of samples ----------------------------------------------------- */

enum hsr_status hsr_volume_add_part(struct hsr_volume_file *file,
                                    const char *name, struct hsr_error *err) {
  struct hsr_volume_bytes *bytes = &file->bytes;
  const char *slash = strrchr(file->path, '/');
  size_t folder = slash && *name != '/' ? (size_t)(slash + 1 - file->path) : 0;
  size_t size = folder + strlen(name) + 1;
  char **all = realloc(bytes->path, (bytes->n + 1) * sizeof *all);
  char *path = malloc(size);
  if (all)
    bytes->path = all;
  if (!all || !path) {
    free(path);
    return hsr_fail_nomem(err);
  }
  snprintf(path, size, "%.*s%s", (int)folder, file->path, name);
  bytes->path[bytes->n++] = path;
  return HSR_OK;
}

enum hsr_status hsr_volume_add_list(struct hsr_volume_file *file, FILE *in,
                                    struct hsr_error *err) {
  char line[1024];
  enum hsr_status status = HSR_OK;
  while (!status && file->bytes.n <= file->n[2] &&
         fgets(line, sizeof line, in)) {
    char *name = line + strspn(line, " \t"), *end = name + strlen(name);
    while (end > name && isspace((unsigned char)end[-1]))
      *--end = '\0';
    if (*name)
      status = hsr_volume_add_part(file, name, err);
  }
  return status;
}

/* Finds the size of part k. */
static enum hsr_status find_part(const struct hsr_volume_file *file, size_t k,
                                 uint64_t *size, struct hsr_error *err) {
  const char *path = file->bytes.path[k];
  return hsr_volume_size_of(path, size, NULL)
             ? hsr_volume_refuse(
                   file, err,
                   "its samples are in a file that cannot be read: %.200s",
                   path)
             : HSR_OK;
}

/* Whether the only directive is a %d, perhaps with a width. */
static bool is_numbered(const char *format) {
  const char *at = strchr(format, '%');
  if (!at)
    return false;
  at += 1 + strspn(at + 1, "0");
  at += *at >= '1' && *at <= '9';
  return (*at == 'd' || *at == 'i') && !strchr(at, '%');
}

enum hsr_status hsr_volume_add_numbered(struct hsr_volume_file *file,
                                        const char *format, long long first,
                                        long long last, long long step,
                                        struct hsr_error *err) {
  const long long most = HSR_VOLUME_MOST;
  char name[600];
  uint64_t size;
  if (!is_numbered(format) || first < 0 || first > most || last < 0 ||
      last > most || step == 0 || llabs(step) > most)
    return hsr_volume_refuse(
        file, err,
        "its header names files of samples by '%.99s' and three "
        "numbers, which must be a name with one %%d, the "
        "first, the last and the step",
        format);
  enum hsr_status status = HSR_OK;
  for (; !status && (step > 0 ? first <= last : first >= last); first += step) {
    const char *at = strchr(format, '%'), *end = at + strcspn(at, "di");
    int width = end > at + 1 ? atoi(at + 1) : 0;
    bool zeros = at[1] == '0';
    snprintf(name, sizeof name, zeros ? "%.*s%0*lld%s" : "%.*s%*lld%s",
             (int)(at - format), format, width, first, end + 1);
    status = hsr_volume_add_part(file, name, err);
    if (!status)
      status = find_part(file, file->bytes.n - 1, &size, err);
  }
  return status;
}

enum hsr_status hsr_volume_check_parts(struct hsr_volume_file *file,
                                       bool at_end, struct hsr_error *err) {
  struct hsr_volume_bytes *bytes = &file->bytes;
  if (bytes->n != 1 && (bytes->n != file->n[2] || at_end))
    return hsr_volume_refuse(file, err,
                             "has its samples in %zu files: there must be one, "
                             "or one for each of %u slices%s",
                             bytes->n, file->n[2],
                             at_end ? ", of a header of known size" : "");
  double need = hsr_volume_samples(file) / (double)bytes->n *
                hsr_volume_type_bytes(bytes->type);
  for (size_t k = 0; k < bytes->n; k++) {
    uint64_t size = 0;
    enum hsr_status status = find_part(file, k, &size, err);
    if (status)
      return status;
    if (at_end && need <= (double)size)
      bytes->offset = size - (uint64_t)need;
    if ((double)bytes->offset + need > (double)size)
      return hsr_volume_refuse(
          file, err, "%s%.99s is too short for the samples that it claims",
          bytes->n > 1 ? "slice " : "", bytes->path[k]);
  }
  return HSR_OK;
}

/* A packed byte holds at most 1,032, and a number in a text takes two. */
enum hsr_status hsr_volume_check_coded(struct hsr_volume_file *file,
                                       double least, struct hsr_error *err) {
  const struct hsr_volume_bytes *bytes = &file->bytes;
  uint64_t size = 0;
  if (bytes->n != 1)
    return hsr_volume_refuse(
        file, err,
        "has its samples in %zu files, which are read only "
        "if they are plain numbers",
        bytes->n);
  enum hsr_status status = find_part(file, 0, &size, err);
  if (status)
    return status;
  double left = (double)size - (double)bytes->offset,
         n = hsr_volume_samples(file);
  return left >= least &&
                 (bytes->encoding == HSR_PACKED
                      ? n * hsr_volume_type_bytes(bytes->type) <= 1032 * left
                      : 2 * n <= left + 1)
             ? HSR_OK
             : hsr_volume_refuse(file, err,
                                 "is too short for the samples that it claims");
}

/* --- VTK's older format --------------------------------------------------- */

/* A place in a text; the text ends with a 0. */
struct reader {
  struct hsr_volume_file *file;
  char *at, *end;
  bool is_ascii;
};

/* The next word, at most 63 letters. False at the end. */
static bool next_word(struct reader *r, char word[64]) {
  while (r->at < r->end && isspace((unsigned char)*r->at))
    r->at++;
  size_t n = 0;
  while (r->at < r->end && !isspace((unsigned char)*r->at) && n < 63)
    word[n++] = *r->at++;
  word[n] = '\0';
  return n > 0 && (r->at == r->end || isspace((unsigned char)*r->at));
}

static bool next_number(struct reader *r, long long *number) {
  char word[64], end;
  return next_word(r, word) && sscanf(word, "%18lld%c", number, &end) == 1;
}

static bool next_real(struct reader *r) {
  char word[64], *end;
  return next_word(r, word) && isfinite(strtod(word, &end)) && !*end;
}

static bool next_line(struct reader *r) {
  char *line = memchr(r->at, '\n', (size_t)(r->end - r->at));
  if (line)
    r->at = line + 1;
  return line;
}

static int legacy_bytes(const char *type) {
  static const struct {
    const char *name;
    int bytes;
  } types[] = {{"unsigned_char", 1}, {"char", 1},         {"unsigned_short", 2},
               {"short", 2},         {"unsigned_int", 4}, {"int", 4},
               {"float", 4},         {"double", 8},       {NULL, 0}};
  int k = 0;
  while (types[k].name && strcmp(types[k].name, type))
    k++;
  return types[k].bytes;
}

/* Passes n numbers of a type: text, or bytes behind the line's end. */
static bool pass_numbers(struct reader *r, double n, const char *type) {
  int bytes = legacy_bytes(type);
  if (!bytes)
    return false;
  if (!r->is_ascii) {
    if (!next_line(r) || n * bytes > (double)(r->end - r->at))
      return false;
    r->at += (size_t)n * (size_t)bytes;
    return true;
  }
  if (2 * n > (double)(r->end - r->at) + 1)
    return false;
  for (; n > 0; n--)
    if (!next_real(r))
      return false;
  return true;
}

static bool pass_coordinates(struct reader *r, int axis) {
  char type[64];
  long long n;
  return next_number(r, &n) && n == r->file->n[axis] && next_word(r, type) &&
         pass_numbers(r, (double)n, type);
}

static bool pass_scalars(struct reader *r) {
  char name[64], type[64], word[64];
  if (!next_word(r, name) || !next_word(r, type) || !next_word(r, word))
    return false;
  if (!strcmp(word, "1") && !next_word(r, word))
    return false;
  return !strcasecmp(word, "LOOKUP_TABLE") && next_word(r, word) &&
         pass_numbers(r, hsr_volume_samples(r->file), type);
}

static bool pass_sizes(struct reader *r) {
  long long n[3];
  return next_number(r, &n[0]) && next_number(r, &n[1]) &&
         next_number(r, &n[2]) && hsr_volume_set_sizes(r->file, n);
}

/* The statements, up to the scalars of the points. VTK sees no more. */
static bool pass_statements(struct reader *r) {
  char word[64];
  long long n;
  bool has_points = false;
  while (next_word(r, word)) {
    bool good = false;
    if (!strcasecmp(word, "DIMENSIONS") && !r->file->n[0])
      good = pass_sizes(r);
    else if (!strcasecmp(word, "SPACING") || !strcasecmp(word, "ORIGIN") ||
             !strcasecmp(word, "ASPECT_RATIO"))
      good = next_real(r) && next_real(r) && next_real(r);
    else if (!strcasecmp(word + 1, "_COORDINATES") && r->file->n[0] &&
             r->file->is_rectilinear)
      good = word[0] >= 'X' && word[0] <= 'Z' &&
             pass_coordinates(r, word[0] - 'X');
    else if (!strcasecmp(word, "POINT_DATA") && r->file->n[0])
      good = has_points =
          next_number(r, &n) && (double)n == hsr_volume_samples(r->file);
    else if (!strcasecmp(word, "SCALARS") && has_points)
      return pass_scalars(r);
    if (!good)
      return false;
  }
  return false;
}

static bool pass_beginning(struct reader *r) {
  char word[64];
  if (r->end - r->at < 20 || memcmp(r->at, "# vtk DataFile", 14))
    return false;
  if (!next_line(r) || !next_line(r) || !next_word(r, word))
    return false;
  r->is_ascii = !strcasecmp(word, "ASCII");
  if (!r->is_ascii && strcasecmp(word, "BINARY"))
    return false;
  if (!next_word(r, word) || strcasecmp(word, "DATASET") || !next_word(r, word))
    return false;
  r->file->is_rectilinear = !strcasecmp(word, "RECTILINEAR_GRID");
  return r->file->is_rectilinear || !strcasecmp(word, "STRUCTURED_POINTS");
}

static enum hsr_status load(struct hsr_volume_file *file,
                            struct hsr_error *err) {
  uint64_t size = 0;
  enum hsr_status status = hsr_volume_size_of(file->path, &size, err);
  if (status)
    return status;
  FILE *in = fopen(file->path, "rb");
  if (!in)
    return hsr_volume_refuse(file, err, "%s", strerror(errno));
  file->text = malloc(size + 1);
  file->size = file->text ? fread(file->text, 1, size, in) : 0;
  fclose(in);
  if (!file->text)
    return hsr_fail_nomem(err);
  file->text[file->size] = '\0';
  return HSR_OK;
}

static enum hsr_status check_legacy(struct hsr_volume_file *file,
                                    struct hsr_error *err) {
  enum hsr_status status = load(file, err);
  if (status)
    return status;
  struct reader r = {file, file->text, file->text + file->size, false};
  if (!pass_beginning(&r))
    return hsr_volume_refuse(
        file, err, "is no VTK file of structured points or a rectilinear grid");
  if (!pass_statements(&r))
    return hsr_fail(err, HSR_E_INPUT,
                    "%.200s: something is wrong, or not known, before byte %td "
                    "of %zu",
                    file->path, r.at - file->text, file->size);
  file->size = (size_t)(r.at - file->text);
  return HSR_OK;
}

/* --- VTK's XML formats ---------------------------------------------------- */

static enum hsr_status check_xml(struct hsr_volume_file *file,
                                 struct hsr_error *err) {
  file->is_rectilinear = file->format == HSR_VTK_GRID;
  enum hsr_status status = load(file, err);
  return status ? status : hsr_volume_scan_xml(file, err);
}

static enum hsr_status check_format(struct hsr_volume_file *file,
                                    struct hsr_error *err) {
  switch (file->format) {
  case HSR_NIFTI:
    return hsr_volume_check_nifti(file, err);
  case HSR_META_IMAGE:
    return hsr_volume_check_meta(file, err);
  case HSR_NRRD:
    return hsr_volume_check_nrrd(file, err);
  case HSR_VTK_LEGACY:
    return check_legacy(file, err);
  case HSR_VTK_IMAGE:
  case HSR_VTK_GRID:
    return check_xml(file, err);
  }
  return hsr_fail(err, HSR_E_INTERNAL, "no such format");
}

enum hsr_status hsr_volume_check(struct hsr_volume_file *file,
                                 struct hsr_error *err) {
  file->slope = 1;
  enum hsr_status status = check_format(file, err);
  if (!status)
    hsr_volume_find_way(file);
  return status;
}

void hsr_volume_file_free(struct hsr_volume_file *file) {
  for (size_t k = 0; k < file->bytes.n; k++)
    free(file->bytes.path[k]);
  free(file->bytes.path);
  free(file->text);
}
