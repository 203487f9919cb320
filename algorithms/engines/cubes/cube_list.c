/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/engines/cubes/cube_list.h"

void hsr_cube_list_clear(struct hsr_cube_list *list) {
  hsr_arena_reset(&list->arena);
  list->group = list->cube = (struct hsr_growing){.items = NULL};
}

bool hsr_cube_list_add(struct hsr_cube_list *list, uint32_t instance,
                       uint32_t cube) {
  struct hsr_listed_instance *last = list->group.items;
  if (list->group.n)
    last += list->group.n - 1;
  if (!list->group.n || last->instance != instance) {
    if (!hsr_arena_grow(&list->arena, &list->group, sizeof *last))
      return false;
    last = (struct hsr_listed_instance *)list->group.items + list->group.n - 1;
    *last = (struct hsr_listed_instance){instance, (uint32_t)list->cube.n, 0};
  }
  if (!hsr_arena_grow(&list->arena, &list->cube, sizeof cube))
    return false;
  ((uint32_t *)list->cube.items)[list->cube.n - 1] = cube;
  last->n++;
  return true;
}

static size_t words_of(const struct hsr_cubes *cubes, uint32_t instance) {
  const struct hsr_octree *octree =
      instance == HSR_NO_ID
          ? &cubes->octree
          : &cubes->object[cubes->scene->instances[instance].object].octree;
  return octree->n_nodes / 32 + 1;
}

enum hsr_status hsr_cube_marks_init(struct hsr_cube_marks *marks,
                                    const struct hsr_cube_list *list,
                                    const struct hsr_cubes *cubes,
                                    struct hsr_arena *arena) {
  size_t n = list->group.n, words = 0;
  marks->list = list;
  marks->n_instances = cubes->scene->n_instances;
  marks->group =
      HSR_NEW_ZEROED(arena, uint32_t, (size_t)marks->n_instances + 1);
  marks->start = HSR_NEW(arena, uint32_t, n + 1);
  if (!marks->group || !marks->start)
    return HSR_E_NOMEM;
  for (size_t g = 0; g < n; g++) {
    uint32_t instance = hsr_cube_list_group(list, g)->instance;
    *hsr_cube_marks_place(marks, instance) = (uint32_t)g + 1;
    marks->start[g] = (uint32_t)words;
    words += words_of(cubes, instance);
  }
  marks->start[n] = (uint32_t)words;
  marks->bits = HSR_NEW_ZEROED(arena, uint32_t, words);
  if (!marks->bits)
    return HSR_E_NOMEM;
  for (size_t g = 0; g < n; g++) {
    const struct hsr_listed_instance *group = hsr_cube_list_group(list, g);
    const uint32_t *cube = hsr_cube_list_cubes(list, group);
    for (uint32_t k = 0; k < group->n; k++)
      marks->bits[marks->start[g] + cube[k] / 32] |= 1u << cube[k] % 32;
  }
  return HSR_OK;
}
