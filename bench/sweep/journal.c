/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/sweep/journal.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* At the beginning of the file. */
struct head {
  char code[17]; /* of the build whose structs these are */
};

/* Whether the notes in the file are this build's. If so, cuts off the last one
 * if its writer was killed before it was whole. */
static bool has_notes(int file, const char *code) {
  struct head head;
  if (pread(file, &head, sizeof head, 0) != (ssize_t)sizeof head ||
      memcmp(head.code, code, sizeof head.code))
    return false;
  off_t end = lseek(file, 0, SEEK_END);
  off_t part = (end - (off_t)sizeof head) % (off_t)sizeof(struct note);
  return !ftruncate(file, end - part) && lseek(file, 0, SEEK_END) >= 0;
}

enum hsr_status journal_open(struct journal *j, const char *output,
                             const char *code, bool resume,
                             struct hsr_error *err) {
  size_t length = strlen(output) + sizeof ".part";
  *j = (struct journal){.file = -1, .path = malloc(length)};
  if (!j->path)
    return hsr_fail_nomem(err);
  snprintf(j->path, length, "%s.part", output);
  j->file = open(j->path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (j->file < 0)
    return hsr_fail(err, HSR_E_INPUT, "%s: %s", j->path, strerror(errno));
  if (resume && has_notes(j->file, code))
    return HSR_OK;
  struct head head;
  memcpy(head.code, code, sizeof head.code);
  if (ftruncate(j->file, 0) || lseek(j->file, 0, SEEK_SET) ||
      write(j->file, &head, sizeof head) != (ssize_t)sizeof head)
    return hsr_fail(err, HSR_E_INPUT, "%s: %s", j->path, strerror(errno));
  return HSR_OK;
}

void journal_clear(struct journal *j) {
  if (j->file < 0)
    return;
  if (!ftruncate(j->file, sizeof(struct head)))
    lseek(j->file, 0, SEEK_END);
}

void journal_close(struct journal *j, bool end) {
  if (j->file >= 0) {
    bool has_notes = lseek(j->file, 0, SEEK_END) > (off_t)sizeof(struct head);
    close(j->file);
    if (end || !has_notes)
      unlink(j->path);
  }
  free(j->path);
}

/* --- Notes ---------------------------------------------------------------- */

static bool append(struct journal *j, const struct note *note) {
  return j->file < 0 ||
         write(j->file, note, sizeof *note) == (ssize_t)sizeof *note;
}

/* A note about a cell; all of its bytes are set, since all are written. */
static struct note note_of(const char *key, const char *scene_hash, int start) {
  struct note note;
  memset(&note, 0, sizeof note);
  note.start = start;
  snprintf(note.key, sizeof note.key, "%s", key);
  snprintf(note.scene_hash, sizeof note.scene_hash, "%s", scene_hash);
  return note;
}

bool journal_judged(struct journal *j, const char *key, const char *scene_hash,
                    const struct cell *cell) {
  struct note note = note_of(key, scene_hash, -1);
  note.cell = *cell;
  return append(j, &note);
}

bool journal_timed(struct journal *j, const char *key, const char *scene_hash,
                   int start, const struct start *times) {
  struct note note = note_of(key, scene_hash, start);
  note.times = *times;
  return append(j, &note);
}

void journal_rewind(struct journal *j) {
  j->at = sizeof(struct head);
}

bool journal_next(struct journal *j, struct note *note) {
  if (j->file < 0 ||
      pread(j->file, note, sizeof *note, j->at) != (ssize_t)sizeof *note)
    return false;
  j->at += (off_t)sizeof *note;
  return true;
}
