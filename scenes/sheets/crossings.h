/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sheets as they lie in the room: which of their faces penetrate. Doubles decide,
 * so that faces which all but touch may be taken for crossing ones, or not. */
#ifndef HSR_SCENES_CROSSINGS_H
#define HSR_SCENES_CROSSINGS_H

#include "common/base/arena.h"
#include "common/base/status.h"

#include <stdint.h>

/* A parallelogram p, p + u, p + u + v, p + v; p is from its sheet's origin. */
struct hsr_sheet_face {
  double p[3], u[3], v[3];
  uint32_t sheet;
};

/* The room is divided into bins by x and y. A bin lists the faces whose bounds
 * reach into it. */
struct hsr_bin {
  uint32_t *face, n, cap; /* of the arena */
};

struct hsr_room {
  const struct hsr_sheet_face *face; /* those of a sheet follow one another */
  const uint32_t *first;             /* n_sheets + 1: the faces of each */
  double (*origin)[3];               /* of each sheet */
  double low[2], high[2];            /* of the room, in x and y */
  int n_bins[2];
  struct hsr_bin *bin;
  struct hsr_arena *arena; /* borrowed */
};

/* Divides the room into bins about as large as a face, of which the room has
 * `n_faces`. All else of *room is set. HSR_E_NOMEM. */
enum hsr_status hsr_room_divide(struct hsr_room *room, uint32_t n_faces);

/* Puts a sheet into the bins, where its origin says, and takes it out of them.
 * HSR_E_NOMEM: it is in some of them. */
enum hsr_status hsr_room_put(struct hsr_room *room, uint32_t sheet);
void hsr_room_take(struct hsr_room *room, uint32_t sheet);

/* Counts the pairs of a face of this sheet and a face of another one in the bins
 * that penetrate. The sheet itself need not be in them. */
uint64_t hsr_room_crossings(const struct hsr_room *room, uint32_t sheet);

#endif
