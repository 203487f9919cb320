/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/image_space/area/sorting/area_slots.h"
#include "common/base/vector.h"

#include <math.h>

struct box {
  float lo[2], hi[2];
};

static const struct box nowhere = {{INFINITY, INFINITY},
                                   {-INFINITY, -INFINITY}};

/* The next floats that are not inside of the area's box. */
static void enclose(struct box *box, const struct hsr_area *area) {
  for (int d = 0; d < 2; d++) {
    float lo = nextafterf((float)area->lo[d], -INFINITY),
          hi = nextafterf((float)area->hi[d], INFINITY);
    box->lo[d] = lo < box->lo[d] ? lo : box->lo[d];
    box->hi[d] = hi > box->hi[d] ? hi : box->hi[d];
  }
}

static float *numbers(const struct hsr_growing *array) {
  return array->items;
}

static void put_box(struct hsr_area_slots *slots, size_t k,
                    const struct box *box) {
  for (int d = 0; d < 2; d++) {
    numbers(&slots->lo[d])[k] = box->lo[d];
    numbers(&slots->hi[d])[k] = box->hi[d];
  }
}

void hsr_area_slots_box(struct hsr_area_slots *slots, size_t k) {
  struct box box = nowhere;
  for (struct hsr_area *a = hsr_area_slot(slots, k)->list.first; a; a = a->next)
    enclose(&box, a);
  put_box(slots, k, &box);
}

static bool add_slot(struct hsr_area_slots *slots, struct hsr_arena *arena) {
  for (int d = 0; d < 2; d++)
    if (!hsr_arena_grow(arena, &slots->lo[d], sizeof(float)) ||
        !hsr_arena_grow(arena, &slots->hi[d], sizeof(float)))
      return false;
  return hsr_arena_grow(arena, &slots->slot, sizeof(struct hsr_area_slot));
}

bool hsr_area_slots_add(struct hsr_area_slots *slots, struct hsr_arena *arena,
                        struct hsr_area_list *list) {
  struct hsr_area *area;
  while ((area = hsr_areas_pop(list))) {
    if (!add_slot(slots, arena))
      return false;
    size_t k = slots->slot.n - 1;
    struct hsr_area_slot *slot = hsr_area_slot(slots, k);
    *slot = (struct hsr_area_slot){{NULL, NULL}, area->face};
    hsr_areas_push(&slot->list, area);
    hsr_area_slots_box(slots, k);
  }
  return true;
}

void hsr_area_slots_cut(struct hsr_area_slots *slots, size_t n) {
  slots->slot.n = n;
  for (int d = 0; d < 2; d++)
    slots->lo[d].n = slots->hi[d].n = n;
}

void hsr_area_slots_close(struct hsr_area_slots *slots, size_t k) {
  size_t n = k;
  for (; k < slots->slot.n; k++) {
    if (!hsr_area_slot(slots, k)->list.first)
      continue;
    *hsr_area_slot(slots, n) = *hsr_area_slot(slots, k);
    for (int d = 0; d < 2; d++) {
      numbers(&slots->lo[d])[n] = numbers(&slots->lo[d])[k];
      numbers(&slots->hi[d])[n] = numbers(&slots->hi[d])[k];
    }
    n++;
  }
  hsr_area_slots_cut(slots, n);
}

HSR_VECTOR static bool find_near(const float *lo0, const float *lo1,
                                 const float *hi0, const float *hi1, size_t n,
                                 const struct box *box, uint8_t *near) {
  unsigned any = 0;
  float x0 = box->lo[0], y0 = box->lo[1], x1 = box->hi[0], y1 = box->hi[1];
  for (size_t i = 0; i < n; i++) {
    unsigned overlaps =
        (lo0[i] <= x1) & (hi0[i] >= x0) & (lo1[i] <= y1) & (hi1[i] >= y0);
    near[i] = (uint8_t)overlaps;
    any |= overlaps;
  }
  return any;
}

bool hsr_area_slots_near(const struct hsr_area_slots *slots, size_t k, size_t n,
                         const struct hsr_area *area,
                         uint8_t near[HSR_SLOTS_AT_ONCE]) {
  struct box box = nowhere;
  enclose(&box, area);
  return find_near(numbers(&slots->lo[0]) + k, numbers(&slots->lo[1]) + k,
                   numbers(&slots->hi[0]) + k, numbers(&slots->hi[1]) + k, n,
                   &box, near);
}
