/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks of volume files before VTK reads them.
 *
 * Safety      VTK believes headers: it takes the memory that they ask for. So
 *             each is parsed here first. What a file claims must be there, and
 *             a word that is not known is refused. */
#ifndef _POSIX_C_SOURCE
#define _POSIX_C_SOURCE 200809L
#endif
#include "common/files/volume/volume_data.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <zlib.h>

static enum hsr_status refuse(const struct hsr_volume_file *file,
                              const char *why, struct hsr_error *err) {
  return hsr_fail(err, HSR_E_INPUT, "%.200s: %s", file->path, why);
}

static enum hsr_status size_of(const char *path, uint64_t *size,
                               struct hsr_error *err) {
  struct stat about;
  if (stat(path, &about))
    return hsr_fail(err, HSR_E_INPUT, "%.200s: %s", path, strerror(errno));
  if (!S_ISREG(about.st_mode))
    return hsr_fail(err, HSR_E_INPUT, "%.200s: is no file", path);
  *size = (uint64_t)about.st_size;
  return HSR_OK;
}

/* Whether the sizes can be those of a grid. */
static bool set_sizes(struct hsr_volume_file *file, const long long n[3]) {
  for (int a = 0; a < 3; a++) {
    if (n[a] < 1 || n[a] > HSR_VOLUME_MOST)
      return false;
    file->n[a] = (uint32_t)n[a];
  }
  return true;
}

static double n_samples(const struct hsr_volume_file *file) {
  return (double)file->n[0] * file->n[1] * file->n[2];
}

/* Whether `size` bytes hold the samples, of `bytes` each, behind `before`
 * bytes. */
static bool can_hold(const struct hsr_volume_file *file, uint64_t size,
                     double before, double bytes) {
  return before >= 0 && before + n_samples(file) * bytes <= (double)size;
}

/* --- NIfTI ---------------------------------------------------------------- */

/* The numbers of a header, of either byte order. */
struct nifti {
  unsigned char bytes[352];
  bool swapped;
};

static long nifti_short(const struct nifti *h, int at) {
  unsigned lo = h->bytes[at + h->swapped], hi = h->bytes[at + !h->swapped];
  long value = (long)(hi << 8 | lo);
  return value < 0x8000 ? value : value - 0x10000;
}

static double nifti_real(const struct nifti *h, int at) {
  uint32_t bits = 0;
  for (int k = 0; k < 4; k++)
    bits |= (uint32_t)h->bytes[at + (h->swapped ? 3 - k : k)] << 8 * k;
  float value;
  memcpy(&value, &bits, sizeof value);
  return (double)value;
}

/* Reads the header, and counts all bytes; of a file that is packed, those that
 * it holds. False if the header is not there. */
static bool read_nifti(struct nifti *h, const char *path, uint64_t *size) {
  gzFile in = gzopen(path, "rb");
  if (!in)
    return false;
  unsigned char rest[1 << 14];
  int n = gzread(in, h->bytes, sizeof h->bytes), more = n;
  for (*size = n > 0 ? (uint64_t)n : 0; more > 0;) {
    more = gzread(in, rest, sizeof rest);
    *size += more > 0 ? (uint64_t)more : 0;
  }
  if (gzclose(in) != Z_OK || more < 0)
    *size = 0;
  static const unsigned char little[] = {0x5c, 1, 0, 0},
                             big[] = {0, 0, 1, 0x5c};
  h->swapped = !memcmp(h->bytes, big, 4);
  return n == sizeof h->bytes && (h->swapped || !memcmp(h->bytes, little, 4)) &&
         !memcmp(h->bytes + 344, "n+1", 4);
}

/* Bytes of a sample, by the code of its type; 0: it is no number. */
static int nifti_bytes(long type) {
  switch (type) {
  case 2:
  case 256:
    return 1;
  case 4:
  case 512:
    return 2;
  case 8:
  case 16:
  case 768:
    return 4;
  case 64:
  case 1024:
  case 1280:
    return 8;
  default:
    return 0;
  }
}

static enum hsr_status check_nifti(struct hsr_volume_file *file,
                                   struct hsr_error *err) {
  struct nifti h = {.swapped = false};
  uint64_t size = 0;
  enum hsr_status status = size_of(file->path, &size, err);
  if (status)
    return status;
  if (!read_nifti(&h, file->path, &size))
    return refuse(file, "has no header of NIfTI-1", err);
  long n_axes = nifti_short(&h, 40);
  if (n_axes < 3 || n_axes > 7)
    return refuse(file, "has not three axes", err);
  for (int k = 4; k <= n_axes; k++)
    if (nifti_short(&h, 40 + 2 * k) != 1)
      return refuse(file, "has more than one number a sample", err);
  if (!set_sizes(file,
                 (const long long[3]){nifti_short(&h, 42), nifti_short(&h, 44),
                                      nifti_short(&h, 46)}))
    return refuse(file, "has a size that is not positive", err);
  int bytes = nifti_bytes(nifti_short(&h, 70));
  if (!bytes || nifti_short(&h, 72) != 8 * bytes)
    return refuse(file, "has samples of no known type", err);
  double before = nifti_real(&h, 108);
  if (!(before >= 352) || !can_hold(file, size, before, bytes))
    return refuse(file, "is too short for the samples that it claims", err);
  return HSR_OK;
}

/* --- MetaImage ------------------------------------------------------------ */

/* What a header says. */
struct meta {
  long long n[3];
  int bytes;
  long long header_size;
  char data[256];
};

static bool is_yes(const char *value) {
  return !strcasecmp(value, "true") || !strcmp(value, "1") ||
         !strcasecmp(value, "yes");
}

static int meta_bytes(const char *type) {
  static const struct {
    const char *name;
    int bytes;
  } types[] = {{"MET_UCHAR", 1}, {"MET_CHAR", 1},   {"MET_USHORT", 2},
               {"MET_SHORT", 2}, {"MET_UINT", 4},   {"MET_INT", 4},
               {"MET_FLOAT", 4}, {"MET_DOUBLE", 8}, {NULL, 0}};
  int k = 0;
  while (types[k].name && strcmp(types[k].name, type))
    k++;
  return types[k].bytes;
}

/* Keys that are of no concern here, and take no memory. */
static bool is_harmless(const char *key) {
  static const char *const keys[] = {"ObjectType",
                                     "BinaryDataByteOrderMSB",
                                     "ElementByteOrderMSB",
                                     "Offset",
                                     "TransformMatrix",
                                     "CenterOfRotation",
                                     "ElementSpacing",
                                     "AnatomicalOrientation",
                                     "ElementSize",
                                     "Origin",
                                     "Position",
                                     "Modality",
                                     "Comment",
                                     NULL};
  for (int k = 0; keys[k]; k++)
    if (!strcmp(keys[k], key))
      return true;
  return false;
}

/* One line, "key = value". False if it is not known or cannot be so. */
static bool read_key(struct meta *m, const char *key, const char *value) {
  char end;
  if (!strcmp(key, "NDims"))
    return !strcmp(value, "3");
  if (!strcmp(key, "DimSize"))
    return sscanf(value, "%7lld %7lld %7lld %c", &m->n[0], &m->n[1], &m->n[2],
                  &end) == 3;
  if (!strcmp(key, "ElementType"))
    return (m->bytes = meta_bytes(value)) > 0;
  if (!strcmp(key, "ElementNumberOfChannels"))
    return !strcmp(value, "1");
  if (!strcmp(key, "BinaryData"))
    return is_yes(value);
  if (!strcmp(key, "CompressedData"))
    return !is_yes(value);
  if (!strcmp(key, "HeaderSize"))
    return sscanf(value, "%18lld %c", &m->header_size, &end) == 1;
  else if (!strcmp(key, "ElementDataFile"))
    snprintf(m->data, sizeof m->data, "%s", value);
  else
    return is_harmless(key);
  return true;
}

/* Splits a line at its '='; both parts trimmed. */
static bool split(char *line, char **key, char **value) {
  char *equals = strchr(line, '=');
  if (!equals)
    return false;
  char *end = equals;
  while (end > line && isspace((unsigned char)end[-1]))
    end--;
  *end = '\0';
  *key = line + strspn(line, " \t");
  *value = equals + 1 + strspn(equals + 1, " \t");
  end = *value + strlen(*value);
  while (end > *value && isspace((unsigned char)end[-1]))
    *--end = '\0';
  return true;
}

/* Reads up to the line that names the data; `header`: the bytes until there. */
static bool read_meta(struct meta *m, FILE *in, long *header) {
  char line[1024], *key, *value;
  for (int k = 0; k < 100 && !m->data[0]; k++)
    if (!fgets(line, sizeof line, in) || !strchr(line, '\n') ||
        strlen(line) > 250 || !split(line, &key, &value) ||
        !read_key(m, key, value))
      return false;
  *header = ftell(in);
  return m->data[0] && m->bytes && *header > 0;
}

/* The bytes of the samples' file, behind the header if they follow it. */
static enum hsr_status meta_size(const struct hsr_volume_file *file,
                                 const struct meta *m, uint64_t header,
                                 uint64_t *size, struct hsr_error *err) {
  if (!strcmp(m->data, "LOCAL")) {
    enum hsr_status status = size_of(file->path, size, err);
    *size -= status ? 0 : header;
    return status;
  }
  char path[4096];
  const char *slash = strrchr(file->path, '/');
  int folder = slash && m->data[0] != '/' ? (int)(slash + 1 - file->path) : 0;
  snprintf(path, sizeof path, "%.*s%s", folder, file->path, m->data);
  return size_of(path, size, NULL)
             ? refuse(file, "its samples are in a file that cannot be read",
                      err)
             : HSR_OK;
}

static enum hsr_status check_meta(struct hsr_volume_file *file,
                                  struct hsr_error *err) {
  struct meta m = {.bytes = 0};
  long header = 0;
  uint64_t size = 0;
  FILE *in = fopen(file->path, "rb");
  if (!in)
    return refuse(file, strerror(errno), err);
  bool is_read = read_meta(&m, in, &header);
  fclose(in);
  if (!is_read)
    return refuse(file,
                  "has a header that is not read: of three axes, one "
                  "number a sample, binary and not packed, its words known",
                  err);
  if (strpbrk(m.data, "%") || !strcmp(m.data, "LIST") || strchr(m.data, ' '))
    return refuse(file, "has its samples in several files", err);
  if (!set_sizes(file, m.n))
    return refuse(file, "has a size that is not positive, or too large", err);
  enum hsr_status status = meta_size(file, &m, (uint64_t)header, &size, err);
  if (status)
    return status;
  double before = m.header_size > 0 ? (double)m.header_size : 0;
  if (m.header_size < -1 || !can_hold(file, size, before, m.bytes))
    return refuse(file, "is too short for the samples that it claims", err);
  return HSR_OK;
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
         pass_numbers(r, n_samples(r->file), type);
}

static bool pass_sizes(struct reader *r) {
  long long n[3];
  return next_number(r, &n[0]) && next_number(r, &n[1]) &&
         next_number(r, &n[2]) && set_sizes(r->file, n);
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
      good = has_points = next_number(r, &n) && (double)n == n_samples(r->file);
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
  enum hsr_status status = size_of(file->path, &size, err);
  if (status)
    return status;
  FILE *in = fopen(file->path, "rb");
  if (!in)
    return refuse(file, strerror(errno), err);
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
    return refuse(
        file, "is no VTK file of structured points or a rectilinear grid", err);
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

enum hsr_status hsr_volume_check(struct hsr_volume_file *file,
                                 struct hsr_error *err) {
  switch (file->format) {
  case HSR_NIFTI:
    return check_nifti(file, err);
  case HSR_META_IMAGE:
    return check_meta(file, err);
  case HSR_VTK_LEGACY:
    return check_legacy(file, err);
  case HSR_VTK_IMAGE:
  case HSR_VTK_GRID:
    return check_xml(file, err);
  }
  return hsr_fail(err, HSR_E_INTERNAL, "no such format");
}
