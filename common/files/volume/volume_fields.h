/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The fields of a header that is text, a line each: "NAME = VALUE" of MetaImage,
 * "NAME: VALUE" of NRRD. A table says which there are and where their values
 * go. */
#ifndef HSR_COMMON_FILES_VOLUME_FIELDS_H
#define HSR_COMMON_FILES_VOLUME_FIELDS_H

#include "common/files/volume/volume_check.h"

enum { HSR_FIELD_LINE = 1024 }; /* bytes of a line, with its end */

enum hsr_field_form {
  HSR_FIELD_UNUSED,
  HSR_FIELD_NOTED,     /* it is not used, which a note says */
  HSR_FIELD_WHOLES,    /* n long long's of at most 18 digits */
  HSR_FIELD_REALS,     /* n finite doubles */
  HSR_FIELD_OPTIONALS, /* the same; NaN stands for none */
  HSR_FIELD_VECTORS,   /* n times "(x,y,z)": 3 n finite doubles */
  HSR_FIELD_WORDS,     /* n int's, of words; of one, the word may have spaces */
  HSR_FIELD_TEXT       /* char[HSR_FIELD_LINE], not empty */
};

/* A word of a value, in letters of any case, and what it means. */
struct hsr_field_word {
  const char *word; /* NULL after the last */
  int means;
};

struct hsr_field {
  const char *name; /* NULL after the last */
  int number;       /* 0 to 63; names of one meaning have the same */
  enum hsr_field_form form;
  int n;
  size_t at; /* where the value is in *values, in bytes */
  const struct hsr_field_word *words;
};

/* A header that is being read. The caller sets all but `given`. */
struct hsr_fields {
  struct hsr_volume_file *file;
  const struct hsr_field *table;
  void *values;
  char sign;      /* between a name and its value */
  uint64_t given; /* bit k: a field with number k was there */
};

/* Whether a field with this number was there. */
bool hsr_field_is_given(const struct hsr_fields *fields, int number);

/* Reads the next line, without its end and white space before that. False: there
 * is none, or it is too long. */
bool hsr_field_line(FILE *in, char line[HSR_FIELD_LINE]);

/* Divides a line at its first sign, without white space around the parts. False:
 * there is no sign, or no name before it. */
bool hsr_field_split(const struct hsr_fields *fields, char *line, char **name,
                     char **value);

/* Takes a value to its place. *known becomes whether the table has the name.
 * HSR_E_INPUT: the field was there before, or the value cannot be read. */
enum hsr_status hsr_field_take(struct hsr_fields *fields, const char *name,
                               const char *value, bool *known,
                               struct hsr_error *err);

#endif
