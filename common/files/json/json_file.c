/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/files/json/json_file.h"

#include "common/files/json/json_read.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

const char *hsr_json_shown(const char *path) {
  const size_t most = 180;
  size_t length = strlen(path);
  return length > most ? path + (length - most) : path;
}

enum hsr_status hsr_json_fail_errno(const char *path, const char *what,
                                    struct hsr_error *err) {
  int reason = errno;
  if (reason == ENOMEM)
    return hsr_fail_nomem(err);
  return hsr_fail(err, HSR_E_INPUT, "%s: %s: %s", hsr_json_shown(path), what,
                  strerror(reason));
}

const char *hsr_json_kind(const json_t *value) {
  switch (json_typeof(value)) {
  case JSON_OBJECT:
    return "an object";
  case JSON_ARRAY:
    return "an array";
  case JSON_STRING:
    return "a string";
  case JSON_TRUE:
  case JSON_FALSE:
    return "a truth value";
  case JSON_NULL:
    return "null";
  default:
    return "a number";
  }
}

/* Reads a file. HSR_E_INPUT also for a NUL in it, which would end it for the
 * parser, or be overlooked. */
static enum hsr_status read_text(int fd, const char *path, char **text,
                                 size_t *length, struct hsr_error *err) {
  size_t size = 1 << 16;
  ssize_t n = 1;
  *length = 0;
  while (n > 0) {
    if (!*text || size - *length < size / 4) {
      size *= *text ? 2 : 1;
      char *larger = realloc(*text, size);
      if (!larger)
        return hsr_fail_nomem(err);
      *text = larger;
    }
    char *to = *text + *length;
    do
      n = read(fd, to, size - *length);
    while (n < 0 && errno == EINTR);
    if (n < 0)
      return hsr_json_fail_errno(path, "cannot be read", err);
    const char *nul = memchr(to, 0, (size_t)n);
    if (nul)
      return hsr_fail(err, HSR_E_INPUT, "%s:%d: a NUL byte",
                      hsr_json_shown(path), 1 + hsr_json_lines(*text, nul));
    *length += (size_t)n;
  }
  return HSR_OK;
}

enum hsr_status hsr_json_load(const char *path, char **text, size_t *length,
                              struct hsr_error *err) {
  /* Opening a pipe must not wait for its other end. */
  int fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (fd < 0)
    return hsr_json_fail_errno(path, "cannot be read", err);
  struct stat about;
  enum hsr_status status;
  if (fstat(fd, &about))
    status = hsr_json_fail_errno(path, "cannot be read", err);
  else if (!S_ISREG(about.st_mode))
    status = hsr_fail(err, HSR_E_INPUT, "%s: %s", hsr_json_shown(path),
                      S_ISDIR(about.st_mode) ? "is a directory"
                                             : "is not a regular file");
  else
    status = read_text(fd, path, text, length, err);
  close(fd);
  return status;
}
