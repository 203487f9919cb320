/* SPDX-License-Identifier: GPL-3.0-or-later */
/* MetaImage: .mhd, and .mha with the samples in the same file.
 *
 * Source      "MetaIO", Kitware, www.itk.org/Wiki/MetaIO/Documentation: the
 *             keys. ITK's class MetaImageIO: row k of TransformMatrix is the
 *             direction of axis k of the file in the world; ITK's world is
 *             LPS. */
#include "common/files/volume/volume_fields.h"

#include <errno.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { MOST_UNUSED = 120 };

/* What a header says. */
struct meta {
  long long n[3], header_size, packed_size;
  int type, is_big_endian, is_packed, only; /* `only` has one value */
  double spacing[3], size[3], matrix[9], offset[3], centre[3];
  double slope, intercept;
  char orientation[HSR_FIELD_LINE], data[HSR_FIELD_LINE];
  char unused[MOST_UNUSED]; /* keys that say nothing to us */
};

/* --- Keys ----------------------------------------------------------------- */

static const struct hsr_field_word types[] = {{"MET_UCHAR", HSR_U8},
                                              {"MET_CHAR", HSR_I8},
                                              {"MET_USHORT", HSR_U16},
                                              {"MET_SHORT", HSR_I16},
                                              {"MET_UINT", HSR_U32},
                                              {"MET_INT", HSR_I32},
                                              {"MET_ULONG_LONG", HSR_U64},
                                              {"MET_LONG_LONG", HSR_I64},
                                              {"MET_FLOAT", HSR_F32},
                                              {"MET_DOUBLE", HSR_F64},
                                              {NULL, 0}};
static const struct hsr_field_word answers[] = {
    {"true", 1}, {"t", 1},  {"yes", 1}, {"1", 1}, {"false", 0},
    {"f", 0},    {"no", 0}, {"0", 0},   {NULL, 0}};

static const struct hsr_field_word only_3[] = {{"3", 3}, {NULL, 0}};
static const struct hsr_field_word only_1[] = {{"1", 1}, {NULL, 0}};
static const struct hsr_field_word only_true[] = {
    {"true", 1}, {"t", 1}, {"yes", 1}, {"1", 1}, {NULL, 0}};

enum { SPACING = 9, MATRIX = 11 };

#define AT(member) offsetof(struct meta, member)
static const struct hsr_field keys[] = {
    {"NDims", 0, HSR_FIELD_WORDS, 1, AT(only), only_3},
    {"DimSize", 1, HSR_FIELD_WHOLES, 3, AT(n), NULL},
    {"ElementType", 2, HSR_FIELD_WORDS, 1, AT(type), types},
    {"ElementNumberOfChannels", 3, HSR_FIELD_WORDS, 1, AT(only), only_1},
    {"BinaryData", 4, HSR_FIELD_WORDS, 1, AT(only), only_true},
    {"CompressedData", 5, HSR_FIELD_WORDS, 1, AT(is_packed), answers},
    {"CompressedDataSize", 6, HSR_FIELD_WHOLES, 1, AT(packed_size), NULL},
    {"HeaderSize", 7, HSR_FIELD_WHOLES, 1, AT(header_size), NULL},
    {"BinaryDataByteOrderMSB", 8, HSR_FIELD_WORDS, 1, AT(is_big_endian),
     answers},
    {"ElementByteOrderMSB", 8, HSR_FIELD_WORDS, 1, AT(is_big_endian), answers},
    {"ElementSpacing", SPACING, HSR_FIELD_REALS, 3, AT(spacing), NULL},
    {"ElementSize", 10, HSR_FIELD_REALS, 3, AT(size), NULL},
    {"TransformMatrix", MATRIX, HSR_FIELD_REALS, 9, AT(matrix), NULL},
    {"Rotation", MATRIX, HSR_FIELD_REALS, 9, AT(matrix), NULL},
    {"Orientation", MATRIX, HSR_FIELD_REALS, 9, AT(matrix), NULL},
    {"Offset", 12, HSR_FIELD_REALS, 3, AT(offset), NULL},
    {"Origin", 12, HSR_FIELD_REALS, 3, AT(offset), NULL},
    {"Position", 12, HSR_FIELD_REALS, 3, AT(offset), NULL},
    {"CenterOfRotation", 13, HSR_FIELD_REALS, 3, AT(centre), NULL},
    {"AnatomicalOrientation", 14, HSR_FIELD_TEXT, 1, AT(orientation), NULL},
    {"ElementToIntensityFunctionSlope", 15, HSR_FIELD_REALS, 1, AT(slope),
     NULL},
    {"ElementToIntensityFunctionOffset", 16, HSR_FIELD_REALS, 1, AT(intercept),
     NULL},
    {"ElementDataFile", 17, HSR_FIELD_TEXT, 1, AT(data), NULL},
    {"ObjectType", 18, HSR_FIELD_UNUSED, 0, 0, NULL},
    {"ElementMin", 19, HSR_FIELD_UNUSED, 0, 0, NULL},
    {"ElementMax", 20, HSR_FIELD_UNUSED, 0, 0, NULL},
    {"Modality", 21, HSR_FIELD_UNUSED, 0, 0, NULL},
    {"Comment", 22, HSR_FIELD_UNUSED, 0, 0, NULL},
    {"Name", 23, HSR_FIELD_UNUSED, 0, 0, NULL},
    {NULL, 0, HSR_FIELD_UNUSED, 0, 0, NULL}};
#undef AT

static void add_unused(struct meta *m, const char *key) {
  size_t used = strlen(m->unused);
  if (used + strlen(key) + 7 > sizeof m->unused) {
    if (!strstr(m->unused, " ..."))
      strcat(m->unused, " ...");
    return;
  }
  snprintf(m->unused + used, sizeof m->unused - used, "%s%s", used ? ", " : "",
           key);
}

/* Whether what the header says can be read. */
static enum hsr_status check_values(const struct hsr_volume_file *file,
                                    const struct meta *m,
                                    struct hsr_error *err) {
  if (!m->type || !m->n[0])
    return hsr_volume_refuse(file, err,
                             "its header has not all of DimSize, ElementType "
                             "and ElementDataFile");
  if (m->header_size < -1)
    return hsr_volume_refuse(file, err,
                             "its header has HeaderSize = %lld, which cannot "
                             "be",
                             m->header_size);
  return HSR_OK;
}

/* Reads up to the line that names the data. */
static enum hsr_status read_header(struct hsr_fields *fields, struct meta *m,
                                   FILE *in, struct hsr_error *err) {
  char line[HSR_FIELD_LINE], *key, *value;
  enum hsr_status status = HSR_OK;
  for (int k = 1; !*m->data && !status; k++) {
    bool known;
    if (!hsr_field_line(in, line) ||
        !hsr_field_split(fields, line, &key, &value))
      return hsr_volume_refuse(fields->file, err,
                               "line %d of its header is no KEY = VALUE", k);
    status = hsr_field_take(fields, key, value, &known, err);
    if (!known)
      add_unused(m, key);
  }
  return status ? status : check_values(fields->file, m, err);
}

/* --- Files ---------------------------------------------------------------- */

/* "name%03d.raw FIRST LAST STEP". A file of just that name comes first. */
static enum hsr_status read_pattern(struct hsr_volume_file *file,
                                    const char *data, struct hsr_error *err) {
  char format[HSR_FIELD_LINE];
  long long first = 0, last = 0, step = 1;
  enum hsr_status status = hsr_volume_add_part(file, data, err);
  uint64_t size;
  if (status || !hsr_volume_size_of(file->bytes.path[0], &size, NULL))
    return status;
  free(file->bytes.path[--file->bytes.n]);
  if (sscanf(data, "%1023s %18lld %18lld %18lld", format, &first, &last,
             &step) < 3)
    return hsr_volume_refuse(
        file, err, "its samples are in a file that cannot be read: %.99s",
        data);
  return hsr_volume_add_numbered(file, format, first, last, step, err);
}

static enum hsr_status find_data(struct hsr_volume_file *file, struct meta *m,
                                 FILE *in, struct hsr_error *err) {
  if (!strcasecmp(m->data, "LOCAL")) {
    const char *slash = strrchr(file->path, '/');
    if (m->header_size == 0)
      file->bytes.offset = (uint64_t)ftell(in);
    return hsr_volume_add_part(file, slash ? slash + 1 : file->path, err);
  }
  if (!strncmp(m->data, "LIST", 4)) {
    if (strcmp(m->data, "LIST") != 0 && strcmp(m->data, "LIST 2") != 0 &&
        strcmp(m->data, "LIST 2D") != 0)
      return hsr_volume_refuse(file, err,
                               "its header's ElementDataFile = %.20s cannot be "
                               "read: each file must be a slice",
                               m->data);
    return hsr_volume_add_list(file, in, err);
  }
  return strchr(m->data, '%') ? read_pattern(file, m->data, err)
                              : hsr_volume_add_part(file, m->data, err);
}

static enum hsr_status check_data(struct hsr_volume_file *file,
                                  const struct meta *m, struct hsr_error *err) {
  bool at_end = m->header_size == -1;
  if (!m->is_packed)
    return hsr_volume_check_parts(file, at_end, err);
  file->bytes.encoding = HSR_PACKED;
  if (at_end)
    return hsr_volume_refuse(file, err,
                             "its header has packed samples at a file's end, "
                             "which are not read");
  return hsr_volume_check_coded(file, (double)m->packed_size, err);
}

/* --- Places --------------------------------------------------------------- */

static enum hsr_status take_frame(const struct hsr_fields *fields,
                                  const struct meta *m, struct hsr_error *err) {
  struct hsr_volume_file *file = fields->file;
  const bool is_medical = hsr_field_is_given(fields, MATRIX);
  const double *spacing =
      hsr_field_is_given(fields, SPACING) ? m->spacing : m->size;
  struct hsr_volume_frame frame;
  for (int f = 0; f < 3; f++) {
    if (!(spacing[f] > 0))
      return hsr_volume_refuse(file, err,
                               "its header has a spacing of %g, which is not "
                               "positive",
                               spacing[f]);
    frame.origin[f] = m->offset[f];
    for (int w = 0; w < 3; w++)
      frame.step[f][w] = spacing[f] * m->matrix[3 * f + w];
  }
  if (m->centre[0] != 0 || m->centre[1] != 0 || m->centre[2] != 0)
    hsr_volume_note(file, "its CenterOfRotation is not used");
  if (*m->orientation && !is_medical && strcmp(m->orientation, "???") != 0 &&
      strcmp(m->orientation, "RAI") != 0)
    hsr_volume_note(file,
                    "its AnatomicalOrientation = %s is not used: there is no "
                    "TransformMatrix",
                    m->orientation);
  file->space = is_medical ? HSR_LPS : HSR_NO_SPACE;
  return hsr_volume_settle(file, &frame, err);
}

/* --- The whole ------------------------------------------------------------ */

enum hsr_status hsr_volume_check_meta(struct hsr_volume_file *file,
                                      struct hsr_error *err) {
  struct meta m = {.spacing = {1, 1, 1},
                   .size = {1, 1, 1},
                   .matrix = {1, 0, 0, 0, 1, 0, 0, 0, 1},
                   .slope = 1};
  struct hsr_fields fields = {
      .file = file, .table = keys, .values = &m, .sign = '='};
  FILE *in = fopen(file->path, "rb");
  if (!in)
    return hsr_volume_refuse(file, err, "%s", strerror(errno));
  enum hsr_status status = read_header(&fields, &m, in, err);
  if (!status && !hsr_volume_set_sizes(file, m.n))
    status = hsr_volume_refuse(file, err,
                               "has a size that is not positive, or too large");
  file->bytes.type = (enum hsr_volume_type)m.type;
  file->bytes.is_big_endian = m.is_big_endian;
  file->bytes.offset = m.header_size > 0 ? (uint64_t)m.header_size : 0;
  if (!status)
    status = find_data(file, &m, in, err);
  fclose(in);
  if (!status)
    status = check_data(file, &m, err);
  if (status)
    return status;
  file->slope = m.slope;
  file->intercept = m.intercept;
  if (*m.unused)
    hsr_volume_note(file, "its header has more than is used: %s", m.unused);
  return take_frame(&fields, &m, err);
}
