/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parsing a command line with argp, and telling what is wrong with it. */
#ifndef HSR_BENCH_OPTIONS_PARSER_H
#define HSR_BENCH_OPTIONS_PARSER_H

#include "common/base/status.h"

#include <argp.h>
#include <stdbool.h>

/* Parses argv with an argp parser, which reports the faults that it finds by
 * option_fail. Any other fault of the command line becomes one line as well.
 * --help prints and ends the program. HSR_E_USAGE. */
enum hsr_status parse_options(const struct argp *argp, int argc, char **argv,
                              void *input, struct hsr_error *err);

/* Sets what parse_options does instead of parsing, before it ends the program; NULL:
 * nothing. hsr complete looks at the options of a command so. */
void parse_instead(void (*look)(const struct argp *argp, int argc,
                                char *const *argv));

/* For use in an argp parser: stores the message and makes parse_options return
 * HSR_E_USAGE. `input` of every parser starts with a struct option_base. */
struct option_base {
  struct hsr_error *err;
  bool failed;
};
error_t option_fail(struct option_base *base, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

#define JSON_ARGP_OPTION                                                       \
  { "json", 'j', NULL, 0, "print one JSON object", 0 }

#endif
