/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Samples whose header says all that is needed to read them: plain numbers,
 * packed ones by zlib, or text.
 *
 * Choice      VTK's readers of MetaImage and NRRD are not used. That of 9.1 for
 *             MetaImage gives other numbers for packed samples that are broken,
 *             or whose size the header leaves out; that for NRRD, for text. */
#ifndef _POSIX_C_SOURCE
#define _POSIX_C_SOURCE 200809L
#endif
#include "common/files/volume/volume_check.h"

#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

/* All samples, in the order of the file. */
struct open {
  struct hsr_volume_way way;
  double slope, intercept;
  enum hsr_volume_type type;
  bool is_big_endian;
  size_t size; /* bytes */
  unsigned char *bytes;
};

/* --- Numbers -------------------------------------------------------------- */

static uint64_t bits_at(const unsigned char *at, int n, bool is_big_endian) {
  uint64_t bits = 0;
  for (int k = 0; k < n; k++)
    bits |= (uint64_t)at[is_big_endian ? n - 1 - k : k] << 8 * k;
  return bits;
}

static double number_of(uint64_t bits, enum hsr_volume_type type) {
  float real;
  double twice;
  uint32_t low = (uint32_t)bits;
  switch (type) {
  case HSR_I8:
    return (int8_t)bits;
  case HSR_I16:
    return (int16_t)bits;
  case HSR_I32:
    return (int32_t)bits;
  case HSR_I64:
    return (double)(int64_t)bits;
  case HSR_F32:
    memcpy(&real, &low, sizeof real);
    return (double)real;
  case HSR_F64:
    memcpy(&twice, &bits, sizeof twice);
    return twice;
  default:
    return (double)bits;
  }
}

/* One number of one byte is quick to read: most volumes have these. */
static double number_at(const struct open *o, ptrdiff_t at, int bytes) {
  if (o->type == HSR_U8)
    return o->bytes[at];
  return number_of(bits_at(o->bytes + at * bytes, bytes, o->is_big_endian),
                   o->type);
}

static enum hsr_status slice(void *data, uint32_t k, float *density,
                             struct hsr_error *err) {
  const struct open *o = data;
  const struct hsr_volume_way *way = &o->way;
  int bytes = hsr_volume_type_bytes(o->type);
  (void)err;
  for (uint32_t j = 0; j < way->n[1]; j++)
    for (uint32_t i = 0; i < way->n[0]; i++) {
      ptrdiff_t at = way->first + (ptrdiff_t)i * way->step[0] +
                     (ptrdiff_t)j * way->step[1] + (ptrdiff_t)k * way->step[2];
      *density++ = (float)(o->slope * number_at(o, at, bytes) + o->intercept);
    }
  return HSR_OK;
}

static void close_bytes(void *data) {
  struct open *o = data;
  free(o->bytes);
  free(o);
}

/* --- Files ---------------------------------------------------------------- */

static enum hsr_status read_plain(struct open *o,
                                  const struct hsr_volume_file *file, FILE *in,
                                  size_t part, struct hsr_error *err) {
  size_t size = o->size / file->bytes.n;
  return fread(o->bytes + part * size, 1, size, in) == size
             ? HSR_OK
             : hsr_volume_refuse(file, err, "%.200s cannot be read",
                                 file->bytes.path[part]);
}

/* Of zlib or gzip. The stream must end with the samples, and pass its check. */
static enum hsr_status unpack(struct open *o,
                              const struct hsr_volume_file *file, FILE *in,
                              struct hsr_error *err) {
  unsigned char packed[1 << 14];
  z_stream z = {.next_out = o->bytes};
  size_t left = o->size;
  int result = inflateInit2(&z, 15 + 32);
  if (result != Z_OK)
    return hsr_fail_nomem(err);
  while (result == Z_OK) {
    if (!z.avail_in) {
      z.next_in = packed;
      z.avail_in = (uInt)fread(packed, 1, sizeof packed, in);
      if (!z.avail_in)
        break;
    }
    uInt room = left < 1u << 30 ? (uInt)left : 1u << 30;
    z.avail_out = room;
    result = inflate(&z, Z_NO_FLUSH);
    left -= room - z.avail_out;
    if (result == Z_BUF_ERROR && !left)
      break;
  }
  inflateEnd(&z);
  if (result == Z_MEM_ERROR)
    return hsr_fail_nomem(err);
  return result == Z_STREAM_END && !left
             ? HSR_OK
             : hsr_volume_refuse(file, err,
                                 "its packed samples are broken, or not so "
                                 "many as its header claims");
}

/* Numbers with spaces or commas between them. They are kept as doubles. */
static enum hsr_status read_text(struct open *o,
                                 const struct hsr_volume_file *file, FILE *in,
                                 struct hsr_error *err) {
  size_t n = o->size / sizeof(double);
  char word[80];
  for (size_t k = 0; k < n; k++) {
    char *end = word;
    double number = 0;
    if (fscanf(in, "%79[^ \t\r\n,]", word) == 1)
      number = strtod(word, &end);
    if (end == word || *end)
      return hsr_volume_refuse(file, err, "its sample %zu is no number", k + 1);
    memcpy(o->bytes + k * sizeof number, &number, sizeof number);
    if (fscanf(in, "%*[ \t\r\n,]") == EOF && k + 1 < n)
      return hsr_volume_refuse(file, err, "has %zu samples and not %zu", k + 1,
                               n);
  }
  return fgetc(in) == EOF
             ? HSR_OK
             : hsr_volume_refuse(file, err, "has more than %zu samples", n);
}

static enum hsr_status read_part(struct open *o,
                                 const struct hsr_volume_file *file,
                                 size_t part, struct hsr_error *err) {
  const struct hsr_volume_bytes *bytes = &file->bytes;
  FILE *in = fopen(bytes->path[part], "rb");
  if (!in || fseeko(in, (off_t)bytes->offset, SEEK_SET)) {
    if (in)
      fclose(in);
    return hsr_volume_refuse(file, err, "%.200s: %s", bytes->path[part],
                             strerror(errno));
  }
  enum hsr_status status =
      bytes->encoding == HSR_PLAIN    ? read_plain(o, file, in, part, err)
      : bytes->encoding == HSR_PACKED ? unpack(o, file, in, err)
                                      : read_text(o, file, in, err);
  fclose(in);
  return status;
}

/* Whether this machine's numbers have the high byte first. */
static bool is_big_machine(void) {
  const uint16_t one = 1;
  return *(const unsigned char *)&one == 0;
}

enum hsr_status hsr_volume_open_bytes(struct hsr_volume *volume,
                                      const struct hsr_volume_file *file,
                                      struct hsr_error *err) {
  struct open *o = calloc(1, sizeof *o);
  if (!o)
    return hsr_fail_nomem(err);
  bool is_text = file->bytes.encoding == HSR_TEXT;
  *o = (struct open){.way = file->way,
                     .slope = file->slope,
                     .intercept = file->intercept,
                     .type = is_text ? HSR_F64 : file->bytes.type,
                     .is_big_endian = is_text ? is_big_machine()
                                              : file->bytes.is_big_endian};
  volume->data = o;
  volume->slice = slice;
  volume->close = close_bytes;
  memcpy(volume->n, file->way.n, sizeof volume->n);
  o->size = (size_t)file->n[0] * file->n[1] * file->n[2] *
            (size_t)hsr_volume_type_bytes(o->type);
  o->bytes = malloc(o->size);
  enum hsr_status status = o->bytes ? HSR_OK : hsr_fail_nomem(err);
  for (size_t k = 0; k < file->bytes.n && !status; k++)
    status = read_part(o, file, k, err);
  return status;
}
