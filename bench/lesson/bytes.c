/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/lesson/lesson.h"
#include "bench/results/page.h"

#include <stdlib.h>
#include <string.h>

static bool make_room(struct lesson_bytes *bytes, size_t n) {
  if (bytes->room - bytes->n >= n)
    return true;
  size_t room = 2 * bytes->room + n + 64;
  unsigned char *at = realloc(bytes->at, room);
  if (!at)
    return false;
  bytes->at = at;
  bytes->room = room;
  return true;
}

void lesson_add(struct lesson_bytes *bytes, const void *from, size_t n) {
  bytes->failed = bytes->failed || !make_room(bytes, n);
  if (bytes->failed || !n)
    return;
  memcpy(bytes->at + bytes->n, from, n);
  bytes->n += n;
}

void lesson_add_number(struct lesson_bytes *bytes, int64_t number) {
  uint64_t left =
      number < 0 ? 2 * (uint64_t)(-number) - 1 : 2 * (uint64_t)number;
  unsigned char group[10];
  size_t n = 0;
  do {
    group[n++] = (unsigned char)((left & 127) | (left > 127 ? 128 : 0));
    left >>= 7;
  } while (left);
  lesson_add(bytes, group, n);
}

void lesson_bytes_free(struct lesson_bytes *bytes) {
  free(bytes->at);
  *bytes = (struct lesson_bytes){.at = NULL};
}

char *lesson_squeeze(const struct lesson_bytes *bytes) {
  uLongf n = compressBound((uLong)bytes->n);
  unsigned char *squeezed = bytes->failed ? NULL : malloc(n);
  char *text = NULL;
  if (squeezed && compress2(squeezed, &n, bytes->at, (uLong)bytes->n,
                            Z_BEST_COMPRESSION) == Z_OK)
    text = base64_text(squeezed, n);
  free(squeezed);
  return text;
}
