/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/files/whole_file.h"

#include <errno.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static enum hsr_status fail(const char *path, struct hsr_error *err) {
  if (errno == ENOMEM)
    return hsr_fail_nomem(err);
  return hsr_fail(err, HSR_E_INPUT, "%s: cannot be written: %s", path,
                  strerror(errno));
}

/* The other name, to be freed. NULL: HSR_E_NOMEM. */
static char *part_of(const char *path) {
  static const char ending[] = ".part";
  size_t length = strlen(path);
  char *part = malloc(length + sizeof ending);
  if (!part)
    return NULL;
  memcpy(part, path, length);
  memcpy(part + length, ending, sizeof ending);
  return part;
}

enum hsr_status hsr_whole_file_open(struct hsr_whole_file *file,
                                    const char *path, struct hsr_error *err) {
  *file = (struct hsr_whole_file){.path = path, .part = part_of(path)};
  if (!file->part)
    return hsr_fail_nomem(err);
  file->stream = fopen(file->part, "wb");
  if (file->stream)
    return HSR_OK;
  enum hsr_status status = fail(path, err);
  free(file->part);
  return status;
}

enum hsr_status hsr_whole_file_close(struct hsr_whole_file *file,
                                     enum hsr_status status,
                                     struct hsr_error *err) {
  bool written = !fflush(file->stream) && !ferror(file->stream);
  int why = errno;
  if (fclose(file->stream) && written) {
    written = false;
    why = errno;
  }
  if (!status && written && rename(file->part, file->path)) {
    written = false;
    why = errno;
  }
  if (status || !written)
    remove(file->part);
  free(file->part);
  errno = why;
  return status || written ? status : fail(file->path, err);
}

void hsr_whole_file_forget(const char *path) {
  char *part = part_of(path);
  if (part)
    remove(part);
  free(part);
}
