/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/shapes/shapes.h"

#include <string.h>

void cell_list_free(struct cell_list *list) {
  hsr_arena_free(&list->arena);
}

int cell_list_data(struct cell_list *list, const char *name,
                   enum hsr_cell_type type) {
  list->data[list->n_data].name = name;
  list->data[list->n_data].type = type;
  return list->n_data++;
}

static void append(struct cell_list *list, struct hsr_growing *array,
                   const void *item, size_t size) {
  if (list->out_of_memory || !hsr_arena_grow(&list->arena, array, size))
    list->out_of_memory = true;
  else
    memcpy((char *)array->items + (array->n - 1) * size, item, size);
}

uint32_t cell_list_point(struct cell_list *list, const double point[3]) {
  append(list, &list->xyz, point, 3 * sizeof *point);
  return (uint32_t)list->xyz.n - 1;
}

void cell_list_number(struct cell_list *list, uint32_t number) {
  append(list, &list->point, &number, sizeof number);
}

void cell_list_end(struct cell_list *list) {
  uint32_t end = (uint32_t)list->point.n, zero = 0;
  if (!list->start.n)
    append(list, &list->start, &zero, sizeof zero);
  append(list, &list->start, &end, sizeof end);
}

void cell_list_value(struct cell_list *list, int k, uint32_t value) {
  append(list, &list->data[k].value, &value, sizeof value);
}

void cell_list_real(struct cell_list *list, int k, double value) {
  append(list, &list->data[k].value, &value, sizeof value);
}

int cell_list_box(struct cell_list *list, const double corner[8][3]) {
  static const unsigned char side[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5},
                                           {0, 1, 5, 4}, {2, 6, 7, 3},
                                           {0, 2, 3, 1}, {4, 5, 7, 6}};
  uint32_t first = 0;
  for (int k = 0; k < 8; k++)
    first = cell_list_point(list, corner[k]) - (uint32_t)k;
  if (list->kind == HSR_CELL_BOX) {
    for (uint32_t k = 0; k < 8; k++)
      cell_list_number(list, first + k);
    cell_list_end(list);
    return 1;
  }
  for (int s = 0; s < 6; s++) {
    for (int k = 0; k < 4; k++)
      cell_list_number(list, first + side[s][k]);
    cell_list_end(list);
  }
  return 6;
}

enum hsr_status cell_list_cells(const struct cell_list *list,
                                struct hsr_cells *cells,
                                struct hsr_error *err) {
  static const uint32_t none = 0;
  if (list->out_of_memory)
    return hsr_fail_nomem(err);
  *cells =
      (struct hsr_cells){.kind = list->kind,
                         .n_points = (uint32_t)list->xyz.n,
                         .n = list->start.n ? (uint32_t)list->start.n - 1 : 0,
                         .xyz = list->xyz.items,
                         .start = list->start.n ? list->start.items : &none,
                         .point = list->point.items,
                         .n_data = list->n_data};
  for (int k = 0; k < list->n_data; k++)
    cells->data[k] = (struct hsr_cell_data){
        list->data[k].name, list->data[k].type, list->data[k].value.items};
  return HSR_OK;
}
