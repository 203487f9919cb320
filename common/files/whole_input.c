/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/files/whole_input.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

const char *hsr_path_shown(const char *path) {
  const size_t most = 180;
  size_t length = strlen(path);
  return length > most ? path + (length - most) : path;
}

enum hsr_status hsr_path_fail(const char *path, const char *what,
                              struct hsr_error *err) {
  int reason = errno;
  if (reason == ENOMEM)
    return hsr_fail_nomem(err);
  return hsr_fail(err, HSR_E_INPUT, "%s: %s: %s", hsr_path_shown(path), what,
                  strerror(reason));
}

/* Reads to the end. What is allocated follows what has been read. */
static enum hsr_status read_all(int fd, const char *path, unsigned char **bytes,
                                size_t *size, struct hsr_error *err) {
  size_t room = 1 << 16;
  ssize_t n = 1;
  while (n > 0) {
    if (!*bytes || room - *size < room / 4) {
      room *= *bytes ? 2 : 1;
      unsigned char *larger = realloc(*bytes, room);
      if (!larger)
        return hsr_fail_nomem(err);
      *bytes = larger;
    }
    do
      n = read(fd, *bytes + *size, room - *size);
    while (n < 0 && errno == EINTR);
    if (n < 0)
      return hsr_path_fail(path, "cannot be read", err);
    *size += (size_t)n;
  }
  return HSR_OK;
}

enum hsr_status hsr_whole_input(const char *path, unsigned char **bytes,
                                size_t *size, struct hsr_error *err) {
  *bytes = NULL;
  *size = 0;
  /* Opening a pipe must not wait for its other end. */
  int fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (fd < 0)
    return hsr_path_fail(path, "cannot be read", err);
  struct stat about;
  enum hsr_status status;
  if (fstat(fd, &about))
    status = hsr_path_fail(path, "cannot be read", err);
  else if (!S_ISREG(about.st_mode))
    status = hsr_fail(err, HSR_E_INPUT, "%s: %s", hsr_path_shown(path),
                      S_ISDIR(about.st_mode) ? "is a directory"
                                             : "is not a regular file");
  else
    status = read_all(fd, path, bytes, size, err);
  close(fd);
  if (status) {
    free(*bytes);
    *bytes = NULL;
  }
  return status;
}
