/* SPDX-License-Identifier: GPL-3.0-or-later */
/* NRRD: .nrrd, and .nhdr with the samples in other files.
 *
 * Source      G. Kindlmann, "Definition of NRRD File Format",
 *             teem.sourceforge.net/nrrd/format.html. */
#include "common/files/volume/volume_check.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { MOST_LINE = 1024, MOST_FIELDS = 200 };

/* What a header says. */
struct nrrd {
  long long axes, n[3];
  enum hsr_volume_type type;
  enum hsr_volume_encoding encoding;
  bool has_encoding, has_order, is_big_endian;
  bool has_spacings, has_directions, has_least, has_most;
  bool is_cell[3]; /* samples are in the middle of cells */
  double spacing[3], direction[3][3], origin[3], least[3], most[3];
  int turned; /* the axis of the world that is turned round, since the space is
                 left-handed; -1: none */
  enum hsr_volume_space space;
  long long line_skip, byte_skip;
  char data[MOST_LINE]; /* the files of the samples; "": this one */
};

/* --- Values --------------------------------------------------------------- */

static enum hsr_volume_type type_of(const char *name) {
  static const struct {
    const char *name;
    enum hsr_volume_type type;
  } types[] = {{"signed char", HSR_I8},
               {"int8", HSR_I8},
               {"int8_t", HSR_I8},
               {"uchar", HSR_U8},
               {"unsigned char", HSR_U8},
               {"uint8", HSR_U8},
               {"uint8_t", HSR_U8},
               {"short", HSR_I16},
               {"short int", HSR_I16},
               {"signed short", HSR_I16},
               {"signed short int", HSR_I16},
               {"int16", HSR_I16},
               {"int16_t", HSR_I16},
               {"ushort", HSR_U16},
               {"unsigned short", HSR_U16},
               {"unsigned short int", HSR_U16},
               {"uint16", HSR_U16},
               {"uint16_t", HSR_U16},
               {"int", HSR_I32},
               {"signed int", HSR_I32},
               {"int32", HSR_I32},
               {"int32_t", HSR_I32},
               {"uint", HSR_U32},
               {"unsigned int", HSR_U32},
               {"uint32", HSR_U32},
               {"uint32_t", HSR_U32},
               {"longlong", HSR_I64},
               {"long long", HSR_I64},
               {"long long int", HSR_I64},
               {"signed long long", HSR_I64},
               {"signed long long int", HSR_I64},
               {"int64", HSR_I64},
               {"int64_t", HSR_I64},
               {"ulonglong", HSR_U64},
               {"unsigned long long", HSR_U64},
               {"unsigned long long int", HSR_U64},
               {"uint64", HSR_U64},
               {"uint64_t", HSR_U64},
               {"float", HSR_F32},
               {"double", HSR_F64},
               {NULL, HSR_NO_TYPE}};
  int k = 0;
  while (types[k].name && strcasecmp(types[k].name, name))
    k++;
  return types[k].type;
}

static bool read_whole(const char *text, long long *to) {
  char end;
  return sscanf(text, "%18lld %c", to, &end) == 1;
}

/* A number; nan only if `nan`. Returns what follows it, or NULL. */
static const char *read_real(const char *text, bool nan, double *to) {
  char *end;
  *to = strtod(text, &end);
  return end != text && (isfinite(*to) || (nan && isnan(*to))) ? end : NULL;
}

/* Three numbers, and nothing else; nan stands for none. */
static bool read_per_axis(const char *text, double to[3]) {
  for (int a = 0; a < 3 && text; a++)
    text = read_real(text, true, &to[a]);
  return text && !text[strspn(text, " \t")];
}

/* "(x,y,z)". Returns what follows it, or NULL. */
static const char *read_vector(const char *text, double to[3]) {
  text += strspn(text, " \t");
  for (int a = 0; a < 3 && text; a++) {
    if (*text != (a ? ',' : '('))
      return NULL;
    text = read_real(text + 1, false, &to[a]);
    text = text ? text + strspn(text, " \t") : NULL;
  }
  return text && *text == ')' ? text + 1 : NULL;
}

/* --- Fields --------------------------------------------------------------- */

typedef bool take_value(struct nrrd *h, const char *value);

static bool take_dimension(struct nrrd *h, const char *value) {
  return read_whole(value, &h->axes) && h->axes == 3;
}
static bool take_sizes(struct nrrd *h, const char *value) {
  char end;
  return sscanf(value, "%7lld %7lld %7lld %c", &h->n[0], &h->n[1], &h->n[2],
                &end) == 3;
}
static bool take_type(struct nrrd *h, const char *value) {
  return (h->type = type_of(value)) != HSR_NO_TYPE;
}
static bool take_encoding(struct nrrd *h, const char *value) {
  static const struct {
    const char *name;
    enum hsr_volume_encoding encoding;
  } encodings[] = {{"raw", HSR_PLAIN}, {"txt", HSR_TEXT},
                   {"text", HSR_TEXT}, {"ascii", HSR_TEXT},
                   {"gz", HSR_PACKED}, {"gzip", HSR_PACKED}};
  for (size_t k = 0; k < sizeof encodings / sizeof *encodings; k++)
    if (!strcasecmp(value, encodings[k].name)) {
      h->encoding = encodings[k].encoding;
      h->has_encoding = true;
    }
  return h->has_encoding;
}
static bool take_endian(struct nrrd *h, const char *value) {
  h->has_order = true;
  h->is_big_endian = !strcasecmp(value, "big");
  return h->is_big_endian || !strcasecmp(value, "little");
}
static bool take_spacings(struct nrrd *h, const char *value) {
  return h->has_spacings = read_per_axis(value, h->spacing);
}
static bool take_least(struct nrrd *h, const char *value) {
  return h->has_least = read_per_axis(value, h->least);
}
static bool take_most(struct nrrd *h, const char *value) {
  return h->has_most = read_per_axis(value, h->most);
}
static bool take_centers(struct nrrd *h, const char *value) {
  char word[3][8] = {"", "", ""};
  if (sscanf(value, "%7s %7s %7s", word[0], word[1], word[2]) != 3)
    return false;
  for (int a = 0; a < 3; a++)
    h->is_cell[a] = !strcasecmp(word[a], "cell");
  return true;
}
static bool take_directions(struct nrrd *h, const char *value) {
  for (int f = 0; f < 3 && value; f++)
    value = read_vector(value, h->direction[f]);
  return h->has_directions = value && !value[strspn(value, " \t")];
}
static bool take_origin(struct nrrd *h, const char *value) {
  value = read_vector(value, h->origin);
  return value && !value[strspn(value, " \t")];
}
static bool take_space(struct nrrd *h, const char *value) {
  static const struct {
    const char *name, *short_name;
    enum hsr_volume_space space;
    int turned;
  } spaces[] = {{"right-anterior-superior", "RAS", HSR_RAS, -1},
                {"left-posterior-superior", "LPS", HSR_LPS, -1},
                {"left-anterior-superior", "LAS", HSR_RAS, 0},
                {"scanner-xyz", "scanner-xyz", HSR_NO_SPACE, -1},
                {"3D-right-handed", "3D-right-handed", HSR_NO_SPACE, -1},
                {"3D-left-handed", "3D-left-handed", HSR_NO_SPACE, 2}};
  for (size_t k = 0; k < sizeof spaces / sizeof *spaces; k++)
    if (!strcasecmp(value, spaces[k].name) ||
        !strcasecmp(value, spaces[k].short_name)) {
      h->space = spaces[k].space;
      h->turned = spaces[k].turned;
      return true;
    }
  return false;
}
static bool take_space_dimension(struct nrrd *h, const char *value) {
  (void)h;
  return !strcmp(value, "3");
}
static bool take_line_skip(struct nrrd *h, const char *value) {
  return read_whole(value, &h->line_skip) && h->line_skip >= 0;
}
static bool take_byte_skip(struct nrrd *h, const char *value) {
  return read_whole(value, &h->byte_skip) && h->byte_skip >= -1;
}
static bool take_data(struct nrrd *h, const char *value) {
  snprintf(h->data, sizeof h->data, "%s", value);
  return *value;
}
static bool take_nothing(struct nrrd *h, const char *value) {
  (void)h, (void)value;
  return true;
}

/* Spaces between a name's words may be left out. NULL: the field is not used,
 * and it is said so. */
static const struct {
  const char *name;
  take_value *take;
} fields[] = {{"dimension", take_dimension},
              {"sizes", take_sizes},
              {"type", take_type},
              {"encoding", take_encoding},
              {"endian", take_endian},
              {"spacings", take_spacings},
              {"axismins", take_least},
              {"axismaxs", take_most},
              {"centers", take_centers},
              {"centerings", take_centers},
              {"spacedirections", take_directions},
              {"spaceorigin", take_origin},
              {"space", take_space},
              {"spacedimension", take_space_dimension},
              {"lineskip", take_line_skip},
              {"byteskip", take_byte_skip},
              {"datafile", take_data},
              {"content", take_nothing},
              {"number", take_nothing},
              {"min", take_nothing},
              {"max", take_nothing},
              {"labels", take_nothing},
              {"units", take_nothing},
              {"kinds", take_nothing},
              {"spaceunits", take_nothing},
              {"sampleunits", take_nothing},
              {"thicknesses", take_nothing},
              {"measurementframe", take_nothing},
              {"oldmin", NULL},
              {"oldmax", NULL},
              {NULL, NULL}};

/* A field's name without spaces, in small letters. */
static void squeeze(char *name) {
  char *to = name;
  for (; *name; name++)
    if (!isspace((unsigned char)*name))
      *to++ = (char)tolower((unsigned char)*name);
  *to = '\0';
}

static enum hsr_status take_field(struct hsr_volume_file *file, struct nrrd *h,
                                  unsigned *seen, char *name, const char *value,
                                  struct hsr_error *err) {
  int k = 0;
  squeeze(name);
  while (fields[k].name && strcmp(fields[k].name, name))
    k++;
  if (!fields[k].name || *seen >> k & 1)
    return hsr_volume_refuse(file, err, "its header's %.40s is %s", name,
                             fields[k].name ? "there twice" : "not known");
  *seen |= 1u << k;
  if (!fields[k].take)
    hsr_volume_note(file, "its %s, %.40s, is not used", name, value);
  return !fields[k].take || fields[k].take(h, value)
             ? HSR_OK
             : hsr_volume_refuse(file, err,
                                 "its header's %s: %.60s cannot be read", name,
                                 value);
}

/* Reads the fields, up to an empty line, the end, or a list of files. */
static enum hsr_status read_header(struct hsr_volume_file *file, struct nrrd *h,
                                   FILE *in, struct hsr_error *err) {
  char line[MOST_LINE];
  unsigned seen = 0;
  enum hsr_status status = HSR_OK;
  if (!fgets(line, sizeof line, in) || strncmp(line, "NRRD000", 7) != 0 ||
      line[7] < '1' || line[7] > '5')
    return hsr_volume_refuse(file, err, "has no header of NRRD 1 to 5");
  for (int k = 0; k < MOST_FIELDS && !status; k++) {
    if (!fgets(line, sizeof line, in))
      break;
    size_t n = strlen(line);
    if (n + 1 == sizeof line)
      return hsr_volume_refuse(file, err, "a line of its header is too long");
    while (n && isspace((unsigned char)line[n - 1]))
      line[--n] = '\0';
    if (!n)
      break;
    char *colon = strstr(line, ": ");
    if (line[0] == '#' || strstr(line, ":="))
      continue;
    if (!colon && line[n - 1] != ':')
      return hsr_volume_refuse(
          file, err, "line %d of its header is no FIELD: VALUE", k + 2);
    colon = colon ? colon : line + n - 1;
    *colon = '\0';
    status = take_field(file, h, &seen, line,
                        colon + 1 + strspn(colon + 1, " \t"), err);
    if (!strncmp(h->data, "LIST", 4))
      break;
  }
  if (!status && (!h->axes || !h->type || !h->n[0] || !h->has_encoding))
    return hsr_volume_refuse(file, err,
                             "its header has not all of dimension, sizes, type "
                             "and encoding");
  if (!status && !h->has_order && h->encoding != HSR_TEXT &&
      hsr_volume_type_bytes(h->type) > 1)
    return hsr_volume_refuse(file, err,
                             "its header has no endian, which numbers "
                             "of several bytes need");
  return status;
}

/* --- Files ---------------------------------------------------------------- */

static enum hsr_status find_data(struct hsr_volume_file *file,
                                 const struct nrrd *h, FILE *in,
                                 struct hsr_error *err) {
  char format[MOST_LINE];
  long long first, last, step;
  const char *slash = strrchr(file->path, '/');
  if (!*h->data) {
    file->bytes.offset = (uint64_t)ftell(in);
    return hsr_volume_add_part(file, slash ? slash + 1 : file->path, err);
  }
  if (!strcmp(h->data, "LIST") || !strcmp(h->data, "LIST 2"))
    return hsr_volume_add_list(file, in, err);
  if (sscanf(h->data, "%1023s %18lld %18lld %18lld", format, &first, &last,
             &step) == 4 &&
      strchr(format, '%'))
    return hsr_volume_add_numbered(file, format, first, last, step, err);
  return hsr_volume_add_part(file, h->data, err);
}

/* Passes over lines in the one file of the samples. */
static enum hsr_status skip_lines(struct hsr_volume_file *file, long long n,
                                  struct hsr_error *err) {
  if (!n)
    return HSR_OK;
  FILE *in = file->bytes.n == 1 ? fopen(file->bytes.path[0], "rb") : NULL;
  bool good = in && !fseek(in, (long)file->bytes.offset, SEEK_SET);
  for (int c = 0; good && n; n -= c == '\n')
    good = (c = fgetc(in)) != EOF;
  if (good)
    file->bytes.offset = (uint64_t)ftell(in);
  if (in)
    fclose(in);
  return good ? HSR_OK
              : hsr_volume_refuse(file, err,
                                  "its header's line skip cannot be done");
}

static enum hsr_status check_raw(struct hsr_volume_file *file,
                                 const struct nrrd *h, struct hsr_error *err) {
  enum hsr_status status = skip_lines(file, h->line_skip, err);
  if (status)
    return status;
  if (h->byte_skip > 0)
    file->bytes.offset += (uint64_t)h->byte_skip;
  return hsr_volume_check_parts(file, h->byte_skip == -1, err);
}

/* A packed byte holds at most 1,032, and a number in a text takes two. */
static enum hsr_status check_coded(struct hsr_volume_file *file,
                                   const struct nrrd *h,
                                   struct hsr_error *err) {
  uint64_t size = 0;
  if (h->line_skip || h->byte_skip || file->bytes.n != 1)
    return hsr_volume_refuse(file, err,
                             "its header has skips or several files of samples "
                             "that are not raw, which are not read");
  if (hsr_volume_size_of(file->bytes.path[0], &size, NULL))
    return hsr_volume_refuse(
        file, err, "its samples are in a file that cannot be read: %.200s",
        file->bytes.path[0]);
  double left = (double)size - (double)file->bytes.offset,
         bytes = hsr_volume_type_bytes(h->type), n = hsr_volume_samples(file);
  if (h->encoding == HSR_PACKED ? n * bytes > 1032 * left : 2 * n > left + 1)
    return hsr_volume_refuse(file, err,
                             "is too short for the samples that it claims");
  return HSR_OK;
}

/* --- Places --------------------------------------------------------------- */

/* Along an axis without a direction in a space. Without centerings, samples are
 * at nodes. */
static void place_axis(struct hsr_volume_file *file, const struct nrrd *h,
                       int a, struct hsr_volume_frame *frame) {
  double step = h->has_spacings ? h->spacing[a] : NAN, n = (double)h->n[a];
  bool has_least = h->has_least && !isnan(h->least[a]);
  if (isnan(step) && has_least && h->has_most && !isnan(h->most[a]))
    step = (h->most[a] - h->least[a]) / (h->is_cell[a] ? n : n > 1 ? n - 1 : 1);
  if (isnan(step)) {
    step = 1;
    hsr_volume_note(file, "its header has no spacing along axis %d; 1 is taken",
                    a + 1);
  }
  frame->step[a][a] = step;
  if (has_least)
    frame->origin[a] = h->least[a] + (h->is_cell[a] ? step / 2 : 0);
}

static enum hsr_status take_frame(struct hsr_volume_file *file,
                                  const struct nrrd *h, struct hsr_error *err) {
  struct hsr_volume_frame frame = {.origin = {0, 0, 0}};
  if (!h->has_directions)
    for (int a = 0; a < 3; a++)
      place_axis(file, h, a, &frame);
  else {
    memcpy(frame.step, h->direction, sizeof frame.step);
    memcpy(frame.origin, h->origin, sizeof frame.origin);
    file->space = h->space;
    if (h->has_spacings)
      hsr_volume_note(file, "its spacings are not used: its space directions "
                            "are");
  }
  if (h->has_directions && h->turned >= 0) {
    hsr_volume_note(file,
                    "its space is left-handed; %c is turned round, so that the "
                    "world is right-handed",
                    "xyz"[h->turned]);
    for (int f = 0; f < 3; f++)
      frame.step[f][h->turned] = -frame.step[f][h->turned];
    frame.origin[h->turned] = -frame.origin[h->turned];
  }
  return hsr_volume_settle(file, &frame, err);
}

/* --- The whole ------------------------------------------------------------ */

enum hsr_status hsr_volume_check_nrrd(struct hsr_volume_file *file,
                                      struct hsr_error *err) {
  struct nrrd h = {.turned = -1};
  FILE *in = fopen(file->path, "rb");
  if (!in)
    return hsr_volume_refuse(file, err, "%s", strerror(errno));
  enum hsr_status status = read_header(file, &h, in, err);
  if (!status && !hsr_volume_set_sizes(file, h.n))
    status = hsr_volume_refuse(file, err,
                               "has a size that is not positive, or too large");
  file->bytes.type = h.type;
  file->bytes.is_big_endian = h.is_big_endian;
  file->bytes.encoding = h.encoding;
  if (!status)
    status = find_data(file, &h, in, err);
  fclose(in);
  if (!status)
    status = h.encoding == HSR_PLAIN ? check_raw(file, &h, err)
                                     : check_coded(file, &h, err);
  return status ? status : take_frame(file, &h, err);
}
