/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Choices that an algorithm, or a kind of answer, leaves to its user. */
#ifndef HSR_COMMON_BASE_OPTION_H
#define HSR_COMMON_BASE_OPTION_H

#include "common/base/status.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A word that an option may be set to. */
struct hsr_word {
  const char *name;    /* [a-z0-9-]+, "faces"; NULL ends a list */
  const char *meaning; /* "scan-converted, as in 1993" */
  unsigned flags;      /* of an algorithm's option: what choosing it adds to the
                     algorithm's flags */
};

/* One choice: a word of a list, a whole number, or a real number. */
struct hsr_option {
  const char *name;             /* [a-z0-9-]+, "cubes" */
  const char *meaning;          /* "how the faces of a cube are tested" */
  const struct hsr_word *words; /* its words; NULL: it is a whole number */
  long least, most;             /* from least to most */
  long standard;                /* the whole number, or which word */
  bool real; /* instead, a real number from real_least to real_most */
  double real_least, real_most, real_standard;
};

/* What was chosen for each option: the index of its word, or its number. */
#define HSR_MAX_OPTIONS 24
struct hsr_values {
  long option[HSR_MAX_OPTIONS];
  double real[HSR_MAX_OPTIONS]; /* of options that are real */
};

/* The standard values of a list of options. The list is NULL, or ended by an
 * option whose name is NULL. */
struct hsr_values hsr_values_standard(const struct hsr_option *options);

/* A stretch of n characters of a user's text; borrowed. */
struct hsr_stretch {
  const char *text;
  size_t n;
};
bool hsr_is_word(struct hsr_stretch stretch, const char *word);

/* Reads a whole decimal number >= 0 that fills the stretch. False if there is
 * none. */
bool hsr_parse_whole(struct hsr_stretch stretch, long *number);

/* Sets option k of the list to the value that a user wrote. An error begins
 * with `text`. HSR_E_USAGE if the option cannot have this value. */
enum hsr_status hsr_values_choose(struct hsr_values *values,
                                  const struct hsr_option *options, int k,
                                  struct hsr_stretch value, const char *text,
                                  struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
