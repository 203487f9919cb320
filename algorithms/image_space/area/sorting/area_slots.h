/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists of areas, with their boxes side by side in memory. A clip polygon is near
 * few of many areas: these are found by their boxes, many at once, and no other
 * area is touched. */
#ifndef HSR_ALGORITHMS_AREA_SLOTS_H
#define HSR_ALGORITHMS_AREA_SLOTS_H

#include "algorithms/image_space/area/sorting/areas.h"

/* What is left of one area of a list: pieces of one face, in their order. */
struct hsr_area_slot {
  struct hsr_area_list list; /* perhaps empty */
  uint32_t face, n;          /* n pieces */
};

/* A stack of lists. Slot k is in the box from (lo[0][k], lo[1][k]) to (hi[0][k],
 * hi[1][k]), which is a little too large. All 0 at first; memory is the
 * arena's. */
struct hsr_area_slots {
  struct hsr_growing slot;         /* struct hsr_area_slot */
  struct hsr_growing lo[2], hi[2]; /* float */
};

static inline struct hsr_area_slot *
hsr_area_slot(const struct hsr_area_slots *slots, size_t k) {
  return (struct hsr_area_slot *)slots->slot.items + k;
}
static inline size_t hsr_area_slots_n(const struct hsr_area_slots *slots) {
  return slots->slot.n;
}

/* Appends the areas of a list, each in a slot of its own. False if memory ran
 * out. */
bool hsr_area_slots_add(struct hsr_area_slots *slots, struct hsr_arena *arena,
                        struct hsr_area_list *list);

/* Makes slot k's box anew, and counts its pieces. */
void hsr_area_slots_box(struct hsr_area_slots *slots, size_t k);

/* Takes the empty slots out, from slot k on. */
void hsr_area_slots_close(struct hsr_area_slots *slots, size_t k);

/* Keeps the first n slots. */
void hsr_area_slots_cut(struct hsr_area_slots *slots, size_t n);

/* Sets near[i] if the boxes of slot k + i and of an area may have a point in
 * common, else clears it, for n slots, at most HSR_SLOTS_AT_ONCE. Returns whether
 * any is set. An empty slot is near nothing. */
enum { HSR_SLOTS_AT_ONCE = 64 };
bool hsr_area_slots_near(const struct hsr_area_slots *slots, size_t k, size_t n,
                         const struct hsr_area *area,
                         uint8_t near[HSR_SLOTS_AT_ONCE]);

#endif
