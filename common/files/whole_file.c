/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/files/whole_file.h"

#include <errno.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static enum hsr_status fail(const char *path, struct hsr_error *err) {
  if (errno == ENOMEM)
    return hsr_fail_nomem(err);
  const char *slash = strrchr(path, '/');
  if (errno == ENOENT && slash)
    return hsr_fail(err, HSR_E_INPUT,
                    "%s: cannot be written: there is no folder '%.*s'", path,
                    (int)(slash - path), path);
  return hsr_fail(err, HSR_E_INPUT, "%s: cannot be written: %s", path,
                  strerror(errno));
}

/* The name beside `path`, which is a link, that it leads to; to be freed. */
static char *follow_link(const char *path) {
  enum { MOST = 4096 };
  const char *slash = strrchr(path, '/');
  size_t folder = slash ? (size_t)(slash + 1 - path) : 0;
  char *name = malloc(folder + MOST + 1);
  ssize_t n = name ? readlink(path, name + folder, MOST) : -1;
  if (n < 0) {
    free(name);
    return strdup(path);
  }
  name[folder + (size_t)n] = '\0';
  if (name[folder] == '/')
    memmove(name, name + folder, (size_t)n + 1);
  else
    memcpy(name, path, folder);
  return name;
}

/* What a path leads to, over any links, to be freed; the file need not be there.
 * NULL: out of memory. */
static char *place_of(const char *path) {
  enum { MOST_LINKS = 40 };
  char *place = strdup(path);
  struct stat is;
  for (int k = 0;
       place && k < MOST_LINKS && !lstat(place, &is) && S_ISLNK(is.st_mode);
       k++) {
    char *next = follow_link(place);
    free(place);
    place = next;
  }
  return place;
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

/* A device or a pipe, such as /dev/null: a file must not take its place. */
static bool is_special(const char *path) {
  struct stat is;
  return !stat(path, &is) && !S_ISREG(is.st_mode) && !S_ISDIR(is.st_mode);
}

/* A new file elsewhere, whose name replaces the X's of `name`. */
static FILE *open_elsewhere(char *name) {
  int file = mkstemp(name);
  FILE *stream = file < 0 ? NULL : fdopen(file, "wb");
  if (file >= 0 && !stream)
    close(file);
  return stream;
}

enum hsr_status hsr_whole_file_open(struct hsr_whole_file *file,
                                    const char *path, struct hsr_error *err) {
  bool special = is_special(path);
  *file = (struct hsr_whole_file){
      .path = path, .place = place_of(path), .special = special};
  if (file->place)
    file->part = special ? strdup("/tmp/hsr-XXXXXX") : part_of(file->place);
  if (file->part)
    file->stream =
        special ? open_elsewhere(file->part) : fopen(file->part, "wb");
  if (file->stream)
    return HSR_OK;
  enum hsr_status status = file->part ? fail(path, err) : hsr_fail_nomem(err);
  free(file->place);
  free(file->part);
  return status;
}

/* Writes what is in one file to another that is there. */
static bool copy(const char *from, const char *to) {
  FILE *in = fopen(from, "rb"), *out = in ? fopen(to, "wb") : NULL;
  char bytes[4096];
  bool good = out;
  for (size_t n; good && (n = fread(bytes, 1, sizeof bytes, in)) > 0;)
    good = fwrite(bytes, 1, n, out) == n;
  good &= in && !ferror(in);
  int why = errno;
  if (out && fclose(out) && good) {
    good = false;
    why = errno;
  }
  if (in)
    fclose(in);
  errno = why;
  return good;
}

static bool put_in_place(const struct hsr_whole_file *file) {
  return file->special ? copy(file->part, file->path)
                       : !rename(file->part, file->place);
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
  if (!status && written && !put_in_place(file)) {
    written = false;
    why = errno;
  }
  if (status || !written || file->special)
    remove(file->part);
  free(file->place);
  free(file->part);
  errno = why;
  return status || written ? status : fail(file->path, err);
}

void hsr_whole_file_forget(const char *path) {
  char *place = place_of(path), *part = place ? part_of(place) : NULL;
  if (part)
    remove(part);
  free(place);
  free(part);
}
