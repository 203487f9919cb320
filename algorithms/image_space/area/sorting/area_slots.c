/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/image_space/area/sorting/area_slots.h"
#include "algorithms/engines/boxes/box_rows.h"

/* Widens a box by that of an area. */
static void enclose(struct hsr_float_box *box, const struct hsr_area *area) {
  box->x0 = fminf(box->x0, hsr_float_below(area->lo[0]));
  box->y0 = fminf(box->y0, hsr_float_below(area->lo[1]));
  box->x1 = fmaxf(box->x1, hsr_float_above(area->hi[0]));
  box->y1 = fmaxf(box->y1, hsr_float_above(area->hi[1]));
}

static float *numbers(const struct hsr_growing *array) {
  return array->items;
}

static void put_box(struct hsr_area_slots *slots, size_t k,
                    const struct hsr_float_box *box) {
  numbers(&slots->lo[0])[k] = box->x0;
  numbers(&slots->lo[1])[k] = box->y0;
  numbers(&slots->hi[0])[k] = box->x1;
  numbers(&slots->hi[1])[k] = box->y1;
}

void hsr_area_slots_box(struct hsr_area_slots *slots, size_t k) {
  struct hsr_area_slot *slot = hsr_area_slot(slots, k);
  struct hsr_float_box box = hsr_no_float_box();
  slot->n = 0;
  for (struct hsr_area *a = slot->list.first; a; a = a->next, slot->n++)
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
    *slot = (struct hsr_area_slot){{NULL, NULL}, area->face, 0};
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

bool hsr_area_slots_near(const struct hsr_area_slots *slots, size_t k, size_t n,
                         const struct hsr_area *area,
                         uint8_t near[HSR_SLOTS_AT_ONCE]) {
  struct hsr_float_box box = hsr_no_float_box();
  enclose(&box, area);
  const struct hsr_box_rows rows = {
      numbers(&slots->lo[0]), numbers(&slots->lo[1]), numbers(&slots->hi[0]),
      numbers(&slots->hi[1])};
  return hsr_box_rows_near(&rows, k, n, &box, near);
}
