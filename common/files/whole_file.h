/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An output file that exists completely or not at all. It is written under a
 * temporary name, "PATH.part", and renamed at the end. If PATH is a symbolic
 * link, PATH is what it leads to. If that is a device or a pipe, the file is
 * written elsewhere and copied to it at the end. */
#ifndef HSR_COMMON_WHOLE_FILE_H
#define HSR_COMMON_WHOLE_FILE_H

#include "common/base/status.h"

#include <stdbool.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_whole_file {
  const char *path; /* borrowed until the file is closed */
  char *place;      /* what `path` leads to; owned */
  char *part;       /* the temporary name; owned */
  FILE *stream;     /* for the caller to write to */
  bool special;     /* `path` is a device or a pipe */
};

/* Opens the file under its temporary name. HSR_E_INPUT if it cannot be written,
 * with *err naming it; HSR_E_NOMEM. After a failure the file must not be
 * closed. */
enum hsr_status hsr_whole_file_open(struct hsr_whole_file *file,
                                    const char *path, struct hsr_error *err);

/* Closes the file. `status` says whether the caller's writing was successful.
 * If it is HSR_OK and all bytes have been written, the file is renamed. Else it
 * is removed. Returns `status` if it is an error; HSR_E_INPUT, or HSR_E_NOMEM,
 * if the file could not be written or renamed. */
enum hsr_status hsr_whole_file_close(struct hsr_whole_file *file,
                                     enum hsr_status status,
                                     struct hsr_error *err);

/* Removes the temporary file that a killed process may have left. */
void hsr_whole_file_forget(const char *path);

#ifdef __cplusplus
}
#endif
#endif
