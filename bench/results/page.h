/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pages that are built from reports/, for all commands that write one. */
#ifndef HSR_BENCH_RESULTS_PAGE_H
#define HSR_BENCH_RESULTS_PAGE_H

#include "common/base/status.h"

#include <jansson.h>
#include <stddef.h>
#include <stdio.h>

enum { PAGE_FOLDER = 4400 };

/* The folder that holds the built page `file`: in the build tree beside this
 * program, or installed. */
void find_page(const char *file, char folder[PAGE_FOLDER]);

/* The text of the built page `file`, to be freed. HSR_E_INPUT if it cannot be
 * read; HSR_E_NOMEM. */
enum hsr_status read_built_page(const char *file, char **page,
                                struct hsr_error *err);

/* Writes a built page to the file `path`, whole or not at all. In place of its
 * `mark` stands what put(context, out, err) writes. HSR_E_INTERNAL if the page
 * has no such mark; HSR_E_INPUT if the file cannot be written; else as put(). */
enum hsr_status
write_built_page(const char *path, const char *page, const char *mark,
                 enum hsr_status (*put)(const void *context, FILE *out,
                                        struct hsr_error *err),
                 const void *context, struct hsr_error *err);

/* Writes a value as a script of that id, with all digits, and takes the reference.
 * HSR_E_NOMEM, also if the value is NULL. */
enum hsr_status put_page_json(const char *id, json_t *value, FILE *out,
                              struct hsr_error *err);

/* The bytes in base64 (RFC 4648), to be freed; NULL for lack of memory. */
char *base64_text(const void *bytes, size_t n);

#endif
