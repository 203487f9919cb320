/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How entries are counted: those of a z-pyramid, of occlusion maps, and tiles of
 * a masked buffer. An entry of a level stands for 2^level x 2^level samples of a
 * window, from its first one on. */
#ifndef HSR_ALGORITHMS_ENTRIES_H
#define HSR_ALGORITHMS_ENTRIES_H

#include "common/base/count.h"
#include "common/exact/screen.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Inclusive columns and rows of entries of one level. */
struct hsr_entries {
  int x0, y0, x1, y1;
};

/* The entries of a level that a box of samples meets. The box is within the
 * window and not empty. */
static inline struct hsr_entries hsr_entries_of(const struct hsr_window *window,
                                                struct hsr_bounds box,
                                                int level) {
  return (struct hsr_entries){
      (box.x0 - window->x0) >> level, (box.y0 - window->y0) >> level,
      (box.x1 - 1 - window->x0) >> level, (box.y1 - 1 - window->y0) >> level};
}

/* What tests count, in the counting build: each entry that is read is a step of
 * `reads`, with the entry and `whom` as its subjects. */
struct hsr_entry_count {
  struct hsr_tally *tally;
  int reads;
  struct hsr_subject whom; /* the face or the cube that is tested */
};

/* The outcomes of a read. It decides if the test need not look at the entries
 * below this one. The event has the entry as HSR_CELL(level, column, row),
 * `whom`, and the samples that the entry stands for. */
#define HSR_ENTRY_READ_OUTCOMES "leaves it open|decides"

/* A step of a counter about an entry of a window and about `whom`. In the work
 * picture each sample of the window that it stands for gets its share. */
static inline void hsr_entry_step(struct hsr_tally *tally, int counter,
                                  const struct hsr_window *window, int level,
                                  int x, int y, struct hsr_subject whom,
                                  int outcome) {
  int x0 = window->x0 + (x << level), x1 = x0 + (1 << level);
  int y0 = window->y0 + (y << level), y1 = y0 + (1 << level);
  x1 = x1 < window->x1 ? x1 : window->x1;
  y1 = y1 < window->y1 ? y1 : window->y1;
  HSR_STEP(tally, counter, HSR_CELL(level, x, y), whom,
           hsr_window_make(x0, y0, x1, y1), outcome);
  float share = 1.0f / (float)(1 << level) / (float)(1 << level);
  for (int j = y0; HSR_COUNTING && tally->work && j < y1; j++)
    for (int i = x0; i < x1; i++)
      tally->work[(size_t)j * tally->work_stride + (size_t)i] += share;
}

#ifdef __cplusplus
}
#endif
#endif
