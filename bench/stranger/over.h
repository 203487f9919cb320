/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The faces over one sample, from the nearest on, whether they exist or not. */
#ifndef HSR_BENCH_STRANGER_OVER_H
#define HSR_BENCH_STRANGER_OVER_H

#include "bench/stranger/parts.h"
#include "common/exact/screen.h"

/* A face over a sample. */
struct over {
  uint32_t face;
  bool exists; /* false: it is one-sided and seen from behind */
  bool turned; /* it turns its back to the eye */
};

/* Who finds them, in the view of what is supposed. */
struct overlook {
  const struct supposed *now;
  const struct hsr_world *world; /* the scene's */
  struct hsr_world open;         /* the same, all of it seen from both sides */
  struct hsr_view view;          /* without a near plane */
  struct hsr_view turned;        /* its samples are displaced the other way */
  struct hsr_screen screen;      /* of `open` and `view` */
  struct hsr_arena arena;
  struct hsr_tally tally;
  int *columns;           /* room for the spans of a face */
  struct hsr_growing met; /* faces over the samples of a row */
  struct hsr_growing list;
};

/* To be closed also after a failure. HSR_E_NOMEM. */
enum hsr_status overlook_open(struct overlook *o, const struct studio *studio,
                              const struct supposed *now,
                              struct hsr_error *err);
void overlook_close(struct overlook *o);

/* About how many of a picture's right samples are looked at. */
enum { RIGHT_LOOKED_AT = 65536 };

/* Whether sample k is looked at: it differs, or it is one of those that are
 * right. */
bool is_looked_at(const struct supposed *now, size_t k);

/* Finds what is over the samples of row j that are looked at. HSR_E_NOMEM. */
enum hsr_status overlook_row(struct overlook *o, int j, struct hsr_error *err);

/* Returns the faces over sample (i, j) of that row, *n of them, in order. They
 * last until the next call. NULL: memory ran out. */
const struct over *overlook_sample(struct overlook *o, int i, int j, size_t *n);

/* Whether the face exists in the view at all. */
bool exists(struct overlook *o, uint32_t f);

/* Whether two faces are of equal depth at the sample, without displacement. */
bool is_tie(struct overlook *o, uint32_t f, uint32_t g, int i, int j);

/* Whether an edge of the face is within half a sample in x and in y. */
bool has_edge_near(struct overlook *o, uint32_t f, int i, int j);

#endif
