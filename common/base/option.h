/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Options of an algorithm or of a kind of answer. */
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
  unsigned flags;      /* of an algorithm's option: flags that the algorithm has
                          if this word is chosen */
};

/* One option. Its value is one of `words`, a whole number, or a real number. */
struct hsr_option {
  const char *name;             /* [a-z0-9-]+, "cubes" */
  const char *meaning;          /* "how the faces of a cube are tested" */
  const struct hsr_word *words; /* NULL: the value is a number */
  long least, most;             /* range of a whole number, both included */
  long standard;                /* the default: a whole number, or the index of
                                   a word */
  bool real; /* the value is a real number; of no effect if there are words */
  double real_least, real_most, real_standard; /* likewise */
};

/* The values of a list of options; value k belongs to option k. */
#define HSR_MAX_OPTIONS 24
struct hsr_values {
  long option[HSR_MAX_OPTIONS]; /* the index of a word, or a whole number */
  double real[HSR_MAX_OPTIONS]; /* of options that are real */
};

/* Returns the default values of a list of options. The list is NULL, or it ends
 * with an option whose name is NULL. */
struct hsr_values hsr_values_standard(const struct hsr_option *options);

/* n characters of a user's text, with no NUL at their end. Borrowed. */
struct hsr_stretch {
  const char *text;
  size_t n;
};

/* Whether the stretch is exactly `word`. */
bool hsr_is_word(struct hsr_stretch stretch, const char *word);

/* Reads the whole stretch as a decimal number >= 0 without a sign. False if it
 * is anything else or is above LONG_MAX; *number is then meaningless. */
bool hsr_parse_whole(struct hsr_stretch stretch, long *number);

/* Sets value k to what a user wrote as `value` of options[k]. HSR_E_USAGE if
 * the option cannot have this value; *values is then as it was, and the text of
 * *err is `text`, a colon and what is allowed. */
enum hsr_status hsr_values_choose(struct hsr_values *values,
                                  const struct hsr_option *options, int k,
                                  struct hsr_stretch value, const char *text,
                                  struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
