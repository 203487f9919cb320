/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Somebody's picture of face ids, in a file. */
#ifndef HSR_BENCH_STRANGER_PICTURE_H
#define HSR_BENCH_STRANGER_PICTURE_H

#include "common/base/status.h"

#include <stdbool.h>
#include <stdint.h>

/* How a file is to be read. All borrowed. */
struct picture_format {
  const char *path;
  const char *channel;   /* of an .exr file; NULL: "id" */
  const char *colours;   /* a file "r g b face"; NULL: none */
  const char *triangles; /* a file: the face of each triangle; NULL: none */
  bool has_none;
  long none; /* this number, too, is no face */
  int m, n;  /* the size that is expected; 0: that of the file */
};

struct id_picture {
  int m, n;
  bool is_exchanged; /* m and n are what is expected of the other */
  uint32_t *ids;     /* by rows from the top; HSR_BACKGROUND: no face */
};

/* Reads the picture of a scene with so many faces. picture->ids is the caller's
 * to free, also after a failure. A picture of another size than expected is
 * refused, unless its sides are exchanged. An id that is no face of the scene is kept.
 * HSR_E_USAGE if the format does not fit the file's kind; HSR_E_INPUT if a file
 * is wrong; HSR_E_NOMEM. */
enum hsr_status picture_read(const struct picture_format *format,
                             uint32_t n_faces, struct id_picture *picture,
                             struct hsr_error *err);

#endif
