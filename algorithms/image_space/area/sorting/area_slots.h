/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists of areas whose boxes are in arrays of their own. A clip polygon meets
 * few of many areas. These are found by comparing many boxes at once, without
 * touching the other areas. */
#ifndef HSR_ALGORITHMS_AREA_SLOTS_H
#define HSR_ALGORITHMS_AREA_SLOTS_H

#include "algorithms/image_space/area/sorting/areas.h"

/* What is left of one area of a list: the pieces into which it has been
 * clipped, all of one face, in their order. */
struct hsr_area_slot {
  struct hsr_area_list list; /* the pieces; may be empty */
  uint32_t face, n;          /* their face, and how many they are */
};

/* A stack of lists, one upon the other. Slot k lies in the box from (lo[0][k],
 * lo[1][k]) to (hi[0][k], hi[1][k]), in pixels, which is a little too large.
 * All zero at first. */
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

/* Appends the areas of a list, each in a slot of its own; *list becomes empty.
 * Memory is the arena's. False: out of memory. */
bool hsr_area_slots_add(struct hsr_area_slots *slots, struct hsr_arena *arena,
                        struct hsr_area_list *list);

/* Computes the box of slot k anew, and the number of its pieces. */
void hsr_area_slots_box(struct hsr_area_slots *slots, size_t k);

/* Removes the empty slots among those from slot k on. */
void hsr_area_slots_close(struct hsr_area_slots *slots, size_t k);

/* Keeps the first n slots. */
void hsr_area_slots_cut(struct hsr_area_slots *slots, size_t n);

/* For n slots from slot k on, n being at most HSR_SLOTS_AT_ONCE: sets near[i]
 * to 1 if the box of slot k + i and that of an area may have a point in common,
 * else to 0. Returns whether any is 1. An empty slot has a point in common with
 * nothing. */
enum { HSR_SLOTS_AT_ONCE = 64 };
bool hsr_area_slots_near(const struct hsr_area_slots *slots, size_t k, size_t n,
                         const struct hsr_area *area,
                         uint8_t near[HSR_SLOTS_AT_ONCE]);

#endif
