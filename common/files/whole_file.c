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

enum hsr_status hsr_whole_file_open(struct hsr_whole_file *file,
                                    const char *path, struct hsr_error *err) {
  static const char ending[] = ".part";
  size_t length = strlen(path);
  *file = (struct hsr_whole_file){.path = path,
                                  .part = malloc(length + sizeof ending)};
  if (!file->part)
    return hsr_fail_nomem(err);
  memcpy(file->part, path, length);
  memcpy(file->part + length, ending, sizeof ending);
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
