/* SPDX-License-Identifier: GPL-3.0-or-later */
/* NRRD: .nrrd, and .nhdr with the samples in other files.
 *
 * Source      G. Kindlmann, "Definition of NRRD File Format",
 *             teem.sourceforge.net/nrrd/format.html. */
#include "common/files/volume/volume_fields.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

/* What a header says. */
struct nrrd {
  long long n[3], line_skip, byte_skip;
  int type, encoding, is_big_endian, space, only; /* `only` has one value */
  int is_cell[3]; /* samples are in the middle of cells */
  double spacing[3], least[3], most[3], direction[3][3], origin[3];
  char data[HSR_FIELD_LINE]; /* the files of the samples; "": this one */
};

/* --- Fields --------------------------------------------------------------- */

static const struct hsr_field_word types[] = {
    {"signed char", HSR_I8},
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
    {NULL, 0}};
static const struct hsr_field_word encodings[] = {
    {"raw", HSR_PLAIN}, {"txt", HSR_TEXT},
    {"text", HSR_TEXT}, {"ascii", HSR_TEXT},
    {"gz", HSR_PACKED}, {"gzip", HSR_PACKED},
    {NULL, 0}};
static const struct hsr_field_word orders[] = {
    {"little", false}, {"big", true}, {NULL, 0}};
static const struct hsr_field_word centers[] = {{"cell", true},
                                                {"node", false},
                                                {"none", false},
                                                {"???", false},
                                                {NULL, 0}};

static const struct hsr_field_word only_3[] = {{"3", 3}, {NULL, 0}};

/* Spaces that a header may name. */
enum { RAS, LPS, LAS, RIGHT_HANDED, LEFT_HANDED };
static const struct hsr_field_word spaces[] = {
    {"right-anterior-superior", RAS}, {"RAS", RAS},
    {"left-posterior-superior", LPS}, {"LPS", LPS},
    {"left-anterior-superior", LAS},  {"LAS", LAS},
    {"scanner-xyz", RIGHT_HANDED},    {"3D-right-handed", RIGHT_HANDED},
    {"3D-left-handed", LEFT_HANDED},  {NULL, 0}};

enum { DIMENSION, ENCODING = 3, ENDIAN, SPACINGS, DIRECTIONS = 9 };

/* Spaces between a name's words may be left out. */
#define AT(member) offsetof(struct nrrd, member)
static const struct hsr_field fields[] = {
    {"dimension", DIMENSION, HSR_FIELD_WORDS, 1, AT(only), only_3},
    {"sizes", 1, HSR_FIELD_WHOLES, 3, AT(n), NULL},
    {"type", 2, HSR_FIELD_WORDS, 1, AT(type), types},
    {"encoding", ENCODING, HSR_FIELD_WORDS, 1, AT(encoding), encodings},
    {"endian", ENDIAN, HSR_FIELD_WORDS, 1, AT(is_big_endian), orders},
    {"spacings", SPACINGS, HSR_FIELD_OPTIONALS, 3, AT(spacing), NULL},
    {"axismins", 6, HSR_FIELD_OPTIONALS, 3, AT(least), NULL},
    {"axismaxs", 7, HSR_FIELD_OPTIONALS, 3, AT(most), NULL},
    {"centers", 8, HSR_FIELD_WORDS, 3, AT(is_cell), centers},
    {"centerings", 8, HSR_FIELD_WORDS, 3, AT(is_cell), centers},
    {"spacedirections", DIRECTIONS, HSR_FIELD_VECTORS, 3, AT(direction), NULL},
    {"spaceorigin", 10, HSR_FIELD_VECTORS, 1, AT(origin), NULL},
    {"space", 11, HSR_FIELD_WORDS, 1, AT(space), spaces},
    {"spacedimension", 12, HSR_FIELD_WORDS, 1, AT(only), only_3},
    {"lineskip", 13, HSR_FIELD_WHOLES, 1, AT(line_skip), NULL},
    {"byteskip", 14, HSR_FIELD_WHOLES, 1, AT(byte_skip), NULL},
    {"datafile", 15, HSR_FIELD_TEXT, 1, AT(data), NULL},
    {"content", 16, HSR_FIELD_UNUSED, 0, 0, NULL},
    {"number", 17, HSR_FIELD_UNUSED, 0, 0, NULL},
    {"min", 18, HSR_FIELD_UNUSED, 0, 0, NULL},
    {"max", 19, HSR_FIELD_UNUSED, 0, 0, NULL},
    {"labels", 20, HSR_FIELD_UNUSED, 0, 0, NULL},
    {"units", 21, HSR_FIELD_UNUSED, 0, 0, NULL},
    {"kinds", 22, HSR_FIELD_UNUSED, 0, 0, NULL},
    {"spaceunits", 23, HSR_FIELD_UNUSED, 0, 0, NULL},
    {"sampleunits", 24, HSR_FIELD_UNUSED, 0, 0, NULL},
    {"thicknesses", 25, HSR_FIELD_UNUSED, 0, 0, NULL},
    {"measurementframe", 26, HSR_FIELD_UNUSED, 0, 0, NULL},
    {"oldmin", 27, HSR_FIELD_NOTED, 0, 0, NULL},
    {"oldmax", 28, HSR_FIELD_NOTED, 0, 0, NULL},
    {NULL, 0, HSR_FIELD_UNUSED, 0, 0, NULL}};
#undef AT

/* A field's name without spaces, in small letters. */
static void squeeze(char *name) {
  char *to = name;
  for (; *name; name++)
    if (!isspace((unsigned char)*name))
      *to++ = (char)tolower((unsigned char)*name);
  *to = '\0';
}

static enum hsr_status take_line(struct hsr_fields *taken, int number,
                                 char *line, struct hsr_error *err) {
  char *name, *value;
  bool known;
  if (!hsr_field_split(taken, line, &name, &value))
    return hsr_volume_refuse(
        taken->file, err, "line %d of its header is no FIELD: VALUE", number);
  squeeze(name);
  enum hsr_status status = hsr_field_take(taken, name, value, &known, err);
  return known ? status
               : hsr_volume_refuse(taken->file, err,
                                   "its header's %.40s is not known", name);
}

/* Whether what the header says can be read. */
static enum hsr_status check_values(const struct hsr_fields *taken,
                                    const struct nrrd *h,
                                    struct hsr_error *err) {
  const struct hsr_volume_file *file = taken->file;
  if (!hsr_field_is_given(taken, DIMENSION) || !h->type || !h->n[0] ||
      !hsr_field_is_given(taken, ENCODING))
    return hsr_volume_refuse(file, err,
                             "its header has not all of dimension, sizes, type "
                             "and encoding");
  if (h->line_skip < 0 || h->byte_skip < -1)
    return hsr_volume_refuse(
        file, err,
        "its header has a skip that cannot be: %lld lines, "
        "%lld bytes",
        h->line_skip, h->byte_skip);
  if (!hsr_field_is_given(taken, ENDIAN) && h->encoding != HSR_TEXT &&
      hsr_volume_type_bytes((enum hsr_volume_type)h->type) > 1)
    return hsr_volume_refuse(file, err,
                             "its header has no endian, which numbers "
                             "of several bytes need");
  return HSR_OK;
}

/* Reads the fields, up to an empty line, the end, or a list of files. */
static enum hsr_status read_header(struct hsr_fields *taken,
                                   const struct nrrd *h, FILE *in,
                                   struct hsr_error *err) {
  char line[HSR_FIELD_LINE];
  if (!hsr_field_line(in, line) || strncmp(line, "NRRD000", 7) != 0 ||
      line[7] < '1' || line[7] > '5')
    return hsr_volume_refuse(taken->file, err, "has no header of NRRD 1 to 5");
  enum hsr_status status = HSR_OK;
  for (int k = 2; !status && strncmp(h->data, "LIST", 4) != 0; k++) {
    bool is_line = hsr_field_line(in, line);
    if (!is_line && !feof(in))
      return hsr_volume_refuse(taken->file, err,
                               "line %d of its header is too long", k);
    if (!is_line || !*line)
      break;
    if (*line != '#' && !strstr(line, ":="))
      status = take_line(taken, k, line, err);
  }
  return status ? status : check_values(taken, h, err);
}

/* --- Files ---------------------------------------------------------------- */

static enum hsr_status find_data(struct hsr_volume_file *file,
                                 const struct nrrd *h, FILE *in,
                                 struct hsr_error *err) {
  char format[HSR_FIELD_LINE];
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

static enum hsr_status check_data(struct hsr_volume_file *file,
                                  const struct nrrd *h, struct hsr_error *err) {
  if (h->encoding == HSR_PLAIN)
    return check_raw(file, h, err);
  if (h->line_skip || h->byte_skip)
    return hsr_volume_refuse(file, err,
                             "its header has a skip before samples that are "
                             "not raw, which is not read");
  return hsr_volume_check_coded(file, 0, err);
}

/* --- Places --------------------------------------------------------------- */

/* Along an axis without a direction in a space. Without centerings, samples are
 * at nodes. */
static void place_axis(const struct hsr_fields *taken, const struct nrrd *h,
                       int a, struct hsr_volume_frame *frame) {
  double step = h->spacing[a], n = (double)h->n[a];
  if (isnan(step))
    step = (h->most[a] - h->least[a]) / (h->is_cell[a] ? n : n > 1 ? n - 1 : 1);
  if (isnan(step)) {
    step = 1;
    hsr_volume_note(taken->file,
                    "its header has no spacing along axis %d; 1 is taken",
                    a + 1);
  }
  frame->step[a][a] = step;
  if (!isnan(h->least[a]))
    frame->origin[a] = h->least[a] + (h->is_cell[a] ? step / 2 : 0);
}

/* By its directions in a space. One that is left-handed is turned round. */
static void place_in_space(const struct hsr_fields *taken, const struct nrrd *h,
                           struct hsr_volume_frame *frame) {
  struct hsr_volume_file *file = taken->file;
  const int turned = h->space == LAS ? 0 : h->space == LEFT_HANDED ? 2 : -1;
  memcpy(frame->step, h->direction, sizeof frame->step);
  memcpy(frame->origin, h->origin, sizeof frame->origin);
  file->space = h->space == LPS                      ? HSR_LPS
                : h->space == RAS || h->space == LAS ? HSR_RAS
                                                     : HSR_NO_SPACE;
  if (hsr_field_is_given(taken, SPACINGS))
    hsr_volume_note(file, "its spacings are not used: its space directions "
                          "are");
  if (turned < 0)
    return;
  hsr_volume_note(file,
                  "its space is left-handed; %c is turned round, so that the "
                  "world is right-handed",
                  "xyz"[turned]);
  for (int f = 0; f < 3; f++)
    frame->step[f][turned] = -frame->step[f][turned];
  frame->origin[turned] = -frame->origin[turned];
}

static enum hsr_status take_frame(const struct hsr_fields *taken,
                                  const struct nrrd *h, struct hsr_error *err) {
  struct hsr_volume_frame frame = {.origin = {0, 0, 0}};
  if (hsr_field_is_given(taken, DIRECTIONS))
    place_in_space(taken, h, &frame);
  else
    for (int a = 0; a < 3; a++)
      place_axis(taken, h, a, &frame);
  return hsr_volume_settle(taken->file, &frame, err);
}

/* --- The whole ------------------------------------------------------------ */

enum hsr_status hsr_volume_check_nrrd(struct hsr_volume_file *file,
                                      struct hsr_error *err) {
  struct nrrd h = {.space = RIGHT_HANDED,
                   .spacing = {NAN, NAN, NAN},
                   .least = {NAN, NAN, NAN},
                   .most = {NAN, NAN, NAN}};
  struct hsr_fields taken = {
      .file = file, .table = fields, .values = &h, .sign = ':'};
  FILE *in = fopen(file->path, "rb");
  if (!in)
    return hsr_volume_refuse(file, err, "%s", strerror(errno));
  enum hsr_status status = read_header(&taken, &h, in, err);
  if (!status && !hsr_volume_set_sizes(file, h.n))
    status = hsr_volume_refuse(file, err,
                               "has a size that is not positive, or too large");
  file->bytes.type = (enum hsr_volume_type)h.type;
  file->bytes.is_big_endian = h.is_big_endian;
  file->bytes.encoding = (enum hsr_volume_encoding)h.encoding;
  if (!status)
    status = find_data(file, &h, in, err);
  fclose(in);
  if (!status)
    status = check_data(file, &h, err);
  return status ? status : take_frame(&taken, &h, err);
}
