/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An output file that exists whole or not at all: it is written under another
 * name beside its own, and renamed in the end. */
#ifndef HSR_COMMON_WHOLE_FILE_H
#define HSR_COMMON_WHOLE_FILE_H

#include "common/base/status.h"

#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_whole_file {
  const char *path; /* borrowed */
  char *part;       /* the other name */
  FILE *stream;     /* to be written to */
};

/* Opens the file under its other name. HSR_E_NOMEM; HSR_E_INPUT if it cannot be
 * written, with *err naming it. */
enum hsr_status hsr_whole_file_open(struct hsr_whole_file *file,
                                    const char *path, struct hsr_error *err);

/* Closes the file. `status` is the outcome of the writing: if it is HSR_OK and
 * all bytes have reached the file, renames it; else removes it. Returns
 * `status`, or HSR_E_INPUT if closing or renaming failed. */
enum hsr_status hsr_whole_file_close(struct hsr_whole_file *file,
                                     enum hsr_status status,
                                     struct hsr_error *err);

/* Removes what a process that was killed left of the file. */
void hsr_whole_file_forget(const char *path);

#ifdef __cplusplus
}
#endif
#endif
