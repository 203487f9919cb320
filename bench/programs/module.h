/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A program as an algorithm like any other. */
#ifndef HSR_BENCH_PROGRAMS_MODULE_H
#define HSR_BENCH_PROGRAMS_MODULE_H

#include "bench/modules/variant.h"

#ifdef __cplusplus
extern "C" {
#endif

/* As hsr_variant_parse, for commands that take programs: a text with a slash,
 * PATH or PATH:answer=KIND, is one. It becomes an algorithm that lasts as long as
 * this process; each render starts it anew. The choice says which program it is.
 * HSR_E_USAGE, also if there is no such program or kind; HSR_E_NOMEM. */
enum hsr_status program_variant_parse(const char *text,
                                      struct hsr_variant *variant,
                                      struct hsr_error *err);

/* Calls take(data, text, err) for the text itself, or, if it has a slash and one of
 * *?[, for each program whose path matches it as a shell has it. HSR_E_USAGE if
 * none does; or what take() fails with. */
enum hsr_status program_each(const char *text,
                             enum hsr_status (*take)(void *data,
                                                     const char *text,
                                                     struct hsr_error *err),
                             void *data, struct hsr_error *err);

/* Whether an algorithm is a program; and the path of its file. */
bool program_is(const struct hsr_algorithm *algorithm);
const char *program_path(const struct hsr_algorithm *algorithm);

/* Demands triangles, as programs do. */
extern const struct hsr_algorithm program_demands;

/* The seconds that a program may take to be ready, and for a frame (standard:
 * 60). */
void program_set_limit(double seconds);

#ifdef __cplusplus
}
#endif
#endif
