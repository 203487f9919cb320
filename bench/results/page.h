/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pages that are built from reports/, for all commands that write one. */
#ifndef HSR_BENCH_RESULTS_PAGE_H
#define HSR_BENCH_RESULTS_PAGE_H

#include "common/base/status.h"

#include <stddef.h>

enum { PAGE_FOLDER = 4400 };

/* The folder that holds the built page `file`: in the build tree beside this
 * program, or installed. */
void find_page(const char *file, char folder[PAGE_FOLDER]);

/* The text of the built page `file`, to be freed. HSR_E_INPUT if it cannot be
 * read. */
enum hsr_status read_built_page(const char *file, char **page,
                                struct hsr_error *err);

/* The bytes in base64 (RFC 4648), to be freed; NULL for lack of memory. */
char *base64_text(const void *bytes, size_t n);

#endif
