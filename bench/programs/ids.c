/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The file of ids that a program writes: docs/programs.md. */
#include "bench/programs/program.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* What no face is called, and the background neither. */
#define UNSET 0xfefefefeu

/* Frees the ids. */
static enum hsr_status fill_file(struct program *program, uint32_t *ids,
                                 size_t n, struct hsr_error *err) {
  char path[PROGRAM_PATH], text[400];
  program_file(program, "ids", path);
  memset(ids, UNSET & 0xff, n * sizeof *ids);
  int file = open(path, O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  bool good = file >= 0 && pwrite(file, ids, n * sizeof *ids, 0) ==
                               (ssize_t)(n * sizeof *ids);
  int why = errno;
  if (file >= 0)
    close(file);
  free(ids);
  snprintf(text, sizeof text, "%s: %s", path, strerror(why));
  return good ? HSR_OK : program_fail(program, text, err);
}

enum hsr_status program_unset_ids(struct program *program,
                                  struct hsr_error *err) {
  struct program_picture picture = program_picture(program);
  size_t n = (size_t)picture.m * (size_t)picture.n;
  uint32_t *ids = malloc(n * sizeof *ids);
  if (ids)
    return fill_file(program, ids, n, err);
  program_fail(program, "out of memory", err);
  return hsr_fail_nomem(err);
}

/* Reads n numbers. There must be no more. */
static enum hsr_status read_file(struct program *program, uint32_t *ids,
                                 size_t n, struct hsr_error *err) {
  char path[PROGRAM_PATH], text[200];
  struct program_picture picture = program_picture(program);
  struct stat about = {.st_size = 0};
  size_t got = 0, wanted = n * sizeof *ids;
  program_file(program, "ids", path);
  FILE *file = fopen(path, "rbe");
  if (file) {
    got = fread(ids, 1, wanted, file);
    if (!fstat(fileno(file), &about) && got == wanted)
      got = (size_t)about.st_size;
    fclose(file);
  }
  if (got == wanted)
    return HSR_OK;
  snprintf(text, sizeof text,
           "its file ids holds %zu bytes, and the picture has %d x %d numbers "
           "of 4 bytes, which is %zu",
           got, picture.m, picture.n, wanted);
  return program_fail(program, text, err);
}

/* Whether a number names a face, or none. */
static bool is_id(const struct program_picture *picture, uint32_t id) {
  return id == UINT32_MAX || !picture->n_faces || id < picture->n_faces;
}

/* Tells of samples that were not written, or else of those that show no face of
 * the scene. */
static enum hsr_status check_ids(struct program *program, const uint32_t *ids,
                                 size_t n, struct hsr_error *err) {
  struct program_picture picture = program_picture(program);
  size_t m = (size_t)picture.m, unset = 0, first_unset = 0, strange = 0,
         first_strange = 0;
  char text[200];
  for (size_t k = n; k-- > 0;)
    if (ids[k] == UNSET) {
      unset++;
      first_unset = k;
    } else if (!is_id(&picture, ids[k])) {
      strange++;
      first_strange = k;
    }
  if (!unset && !strange)
    return HSR_OK;
  if (unset)
    snprintf(text, sizeof text,
             "it left %zu of %zu samples unwritten, the first at (%zu, %zu)",
             unset, n, first_unset % m, first_unset / m);
  else
    snprintf(text, sizeof text,
             "%zu of %zu samples show no face of the scene, which has %u: the "
             "first, at (%zu, %zu), shows %u",
             strange, n, picture.n_faces, first_strange % m, first_strange / m,
             ids[first_strange]);
  return program_fail(program, text, err);
}

enum hsr_status program_read_ids(struct program *program, uint32_t *ids,
                                 struct hsr_error *err) {
  struct program_picture picture = program_picture(program);
  size_t n = (size_t)picture.m * (size_t)picture.n;
  enum hsr_status status = read_file(program, ids, n, err);
  return status ? status : check_ids(program, ids, n, err);
}
