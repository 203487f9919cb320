/* SPDX-License-Identifier: GPL-3.0-or-later */
/* MetaImage: .mhd, and .mha with the samples in the same file.
 *
 * Source      "MetaIO", Kitware, www.itk.org/Wiki/MetaIO/Documentation: the
 *             keys. ITK's class MetaImageIO: row k of TransformMatrix is the
 *             direction of axis k of the file in the world; ITK's world is
 *             LPS. */
#include "common/files/volume/volume_check.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { MOST_LINE = 1024, MOST_KEY = 40, MOST_UNUSED = 120 };

/* What a header says. */
struct meta {
  long long n[3];
  enum hsr_volume_type type;
  long long header_size, packed_size;
  bool is_big_endian, is_packed, has_spacing, is_medical;
  double spacing[3], size[3], matrix[9], offset[3], centre[3];
  double slope, intercept;
  char orientation[16];
  char data[MOST_LINE];
  char unused[MOST_UNUSED]; /* keys that say nothing to us */
  unsigned seen;            /* bit k: that of keys[k] */
};

static bool is_yes(const char *value) {
  return !strcasecmp(value, "true") || !strcmp(value, "1") ||
         !strcasecmp(value, "yes");
}

static enum hsr_volume_type type_of(const char *name) {
  static const struct {
    const char *name;
    enum hsr_volume_type type;
  } types[] = {{"MET_UCHAR", HSR_U8},       {"MET_CHAR", HSR_I8},
               {"MET_USHORT", HSR_U16},     {"MET_SHORT", HSR_I16},
               {"MET_UINT", HSR_U32},       {"MET_INT", HSR_I32},
               {"MET_ULONG_LONG", HSR_U64}, {"MET_LONG_LONG", HSR_I64},
               {"MET_FLOAT", HSR_F32},      {"MET_DOUBLE", HSR_F64},
               {NULL, HSR_NO_TYPE}};
  int k = 0;
  while (types[k].name && strcmp(types[k].name, name))
    k++;
  return types[k].type;
}

/* n finite numbers, and nothing else. */
static bool read_reals(const char *text, int n, double *to) {
  for (int k = 0; k < n; k++) {
    char *end;
    to[k] = strtod(text, &end);
    if (end == text || !isfinite(to[k]))
      return false;
    text = end;
  }
  return !text[strspn(text, " \t\r")];
}

static bool read_whole(const char *text, long long *to) {
  char end;
  return sscanf(text, "%18lld %c", to, &end) == 1;
}

/* --- Keys ----------------------------------------------------------------- */

typedef bool take_value(struct meta *m, const char *value);

static bool take_axes(struct meta *m, const char *value) {
  (void)m;
  return !strcmp(value, "3");
}
static bool take_sizes(struct meta *m, const char *value) {
  char end;
  return sscanf(value, "%7lld %7lld %7lld %c", &m->n[0], &m->n[1], &m->n[2],
                &end) == 3;
}
static bool take_type(struct meta *m, const char *value) {
  return (m->type = type_of(value)) != HSR_NO_TYPE;
}
static bool take_channels(struct meta *m, const char *value) {
  (void)m;
  return !strcmp(value, "1");
}
static bool take_binary(struct meta *m, const char *value) {
  (void)m;
  return is_yes(value);
}
static bool take_packed(struct meta *m, const char *value) {
  m->is_packed = is_yes(value);
  return true;
}
static bool take_packed_size(struct meta *m, const char *value) {
  return read_whole(value, &m->packed_size) && m->packed_size >= 0;
}
static bool take_header_size(struct meta *m, const char *value) {
  return read_whole(value, &m->header_size) && m->header_size >= -1;
}
static bool take_order(struct meta *m, const char *value) {
  m->is_big_endian = is_yes(value);
  return true;
}
static bool take_spacing(struct meta *m, const char *value) {
  return m->has_spacing = read_reals(value, 3, m->spacing);
}
static bool take_element_size(struct meta *m, const char *value) {
  return read_reals(value, 3, m->size);
}
static bool take_matrix(struct meta *m, const char *value) {
  m->is_medical = true;
  return read_reals(value, 9, m->matrix);
}
static bool take_offset(struct meta *m, const char *value) {
  return read_reals(value, 3, m->offset);
}
static bool take_centre(struct meta *m, const char *value) {
  return read_reals(value, 3, m->centre);
}
static bool take_orientation(struct meta *m, const char *value) {
  snprintf(m->orientation, sizeof m->orientation, "%s", value);
  return true;
}
static bool take_slope(struct meta *m, const char *value) {
  return read_reals(value, 1, &m->slope);
}
static bool take_intercept(struct meta *m, const char *value) {
  return read_reals(value, 1, &m->intercept);
}
static bool take_data(struct meta *m, const char *value) {
  snprintf(m->data, sizeof m->data, "%s", value);
  return *value;
}
static bool take_nothing(struct meta *m, const char *value) {
  (void)m, (void)value;
  return true;
}

/* Keys of one meaning have one number. */
static const struct {
  const char *name;
  take_value *take;
  int number;
} keys[] = {{"NDims", take_axes, 0},
            {"DimSize", take_sizes, 1},
            {"ElementType", take_type, 2},
            {"ElementNumberOfChannels", take_channels, 3},
            {"BinaryData", take_binary, 4},
            {"CompressedData", take_packed, 5},
            {"CompressedDataSize", take_packed_size, 6},
            {"HeaderSize", take_header_size, 7},
            {"BinaryDataByteOrderMSB", take_order, 8},
            {"ElementByteOrderMSB", take_order, 8},
            {"ElementSpacing", take_spacing, 9},
            {"ElementSize", take_element_size, 10},
            {"TransformMatrix", take_matrix, 11},
            {"Rotation", take_matrix, 11},
            {"Orientation", take_matrix, 11},
            {"Offset", take_offset, 12},
            {"Origin", take_offset, 12},
            {"Position", take_offset, 12},
            {"CenterOfRotation", take_centre, 13},
            {"AnatomicalOrientation", take_orientation, 14},
            {"ElementToIntensityFunctionSlope", take_slope, 15},
            {"ElementToIntensityFunctionOffset", take_intercept, 16},
            {"ElementDataFile", take_data, 17},
            {"ObjectType", take_nothing, 18},
            {"ElementMin", take_nothing, 19},
            {"ElementMax", take_nothing, 20},
            {"Modality", take_nothing, 21},
            {"Comment", take_nothing, 22},
            {"Name", take_nothing, 23},
            {NULL, NULL, 0}};

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

/* One line, "key = value". */
static enum hsr_status read_key(const struct hsr_volume_file *file,
                                struct meta *m, const char *key,
                                const char *value, struct hsr_error *err) {
  int k = 0;
  while (keys[k].name && strcmp(keys[k].name, key))
    k++;
  if (!keys[k].name) {
    add_unused(m, key);
    return HSR_OK;
  }
  if (m->seen >> keys[k].number & 1)
    return hsr_volume_refuse(file, err, "its header says %s twice", key);
  m->seen |= 1u << keys[k].number;
  return keys[k].take(m, value)
             ? HSR_OK
             : hsr_volume_refuse(file, err,
                                 "its header's %s = %.60s cannot be read", key,
                                 value);
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
  return **key && strlen(*key) < MOST_KEY;
}

/* Reads up to the line that names the data. */
static enum hsr_status read_header(const struct hsr_volume_file *file,
                                   struct meta *m, FILE *in,
                                   struct hsr_error *err) {
  char line[MOST_LINE], *key, *value;
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < 1000 && !m->data[0] && !status; k++) {
    if (!fgets(line, sizeof line, in) || !strchr(line, '\n') ||
        !split(line, &key, &value))
      return hsr_volume_refuse(
          file, err, "line %d of its header is no KEY = VALUE", k + 1);
    status = read_key(file, m, key, value, err);
  }
  if (!status && (!m->data[0] || !m->type || !m->n[0]))
    return hsr_volume_refuse(file, err,
                             "its header has not all of DimSize, ElementType "
                             "and ElementDataFile");
  return status;
}

/* --- Files ---------------------------------------------------------------- */

/* "name%03d.raw FIRST LAST STEP". A file of just that name comes first. */
static enum hsr_status read_pattern(struct hsr_volume_file *file,
                                    const char *data, struct hsr_error *err) {
  char format[MOST_LINE];
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

/* Samples that zlib has packed. A packed byte holds at most 1,032. */
static enum hsr_status check_packed(struct hsr_volume_file *file,
                                    const struct meta *m,
                                    struct hsr_error *err) {
  uint64_t size = 0;
  file->bytes.encoding = HSR_PACKED;
  if (file->bytes.n != 1 || m->header_size == -1)
    return hsr_volume_refuse(file, err,
                             "its header has packed samples in several files, "
                             "or at a file's end, which are not read");
  enum hsr_status status = hsr_volume_size_of(file->bytes.path[0], &size, NULL);
  if (status)
    return hsr_volume_refuse(
        file, err, "its samples are in a file that cannot be read: %.200s",
        file->bytes.path[0]);
  double packed = (double)size - (double)file->bytes.offset;
  if ((double)m->packed_size > packed ||
      hsr_volume_samples(file) * hsr_volume_type_bytes(m->type) > 1032 * packed)
    return hsr_volume_refuse(file, err,
                             "is too short for the samples that it claims");
  return HSR_OK;
}

/* --- Places --------------------------------------------------------------- */

static enum hsr_status take_frame(struct hsr_volume_file *file,
                                  const struct meta *m, struct hsr_error *err) {
  const double *spacing = m->has_spacing ? m->spacing : m->size;
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
  if (*m->orientation && !m->is_medical && strcmp(m->orientation, "???") != 0 &&
      strcmp(m->orientation, "RAI") != 0)
    hsr_volume_note(file,
                    "its AnatomicalOrientation = %s is not used: there is no "
                    "TransformMatrix",
                    m->orientation);
  file->space = m->is_medical ? HSR_LPS : HSR_NO_SPACE;
  return hsr_volume_settle(file, &frame, err);
}

/* --- The whole ------------------------------------------------------------ */

enum hsr_status hsr_volume_check_meta(struct hsr_volume_file *file,
                                      struct hsr_error *err) {
  struct meta m = {.spacing = {1, 1, 1},
                   .size = {1, 1, 1},
                   .matrix = {1, 0, 0, 0, 1, 0, 0, 0, 1},
                   .slope = 1};
  FILE *in = fopen(file->path, "rb");
  if (!in)
    return hsr_volume_refuse(file, err, "%s", strerror(errno));
  enum hsr_status status = read_header(file, &m, in, err);
  if (!status && !hsr_volume_set_sizes(file, m.n))
    status = hsr_volume_refuse(file, err,
                               "has a size that is not positive, or too large");
  file->bytes.type = m.type;
  file->bytes.is_big_endian = m.is_big_endian;
  file->bytes.offset = m.header_size > 0 ? (uint64_t)m.header_size : 0;
  if (!status)
    status = find_data(file, &m, in, err);
  fclose(in);
  if (!status)
    status = m.is_packed
                 ? check_packed(file, &m, err)
                 : hsr_volume_check_parts(file, m.header_size == -1, err);
  if (status)
    return status;
  file->slope = m.slope;
  file->intercept = m.intercept;
  if (*m.unused)
    hsr_volume_note(file, "its header has more than is used: %s", m.unused);
  return take_frame(file, &m, err);
}
