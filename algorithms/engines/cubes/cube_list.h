/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists of cubes by instances: the temporal coherence list of Greene, Kass and
 * Miller, "Hierarchical Z-Buffer Visibility", SIGGRAPH 1993, 3.3. Its size is
 * that of the cubes listed, of which there are few, and not of all. */
#ifndef HSR_ALGORITHMS_CUBE_LIST_H
#define HSR_ALGORITHMS_CUBE_LIST_H

#include "algorithms/algorithm.h"
#include "algorithms/engines/cubes/cubes.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The listed cubes of one instance: cube[first] to cube[first + n - 1]. */
struct hsr_listed_instance {
  uint32_t instance, first, n;
};

/* Empty if all zero, and freed with hsr_arena_free(&list->arena). */
struct hsr_cube_list {
  struct hsr_growing group; /* struct hsr_listed_instance; no instance twice */
  struct hsr_growing cube;  /* uint32_t */
  struct hsr_arena arena;
};

void hsr_cube_list_clear(struct hsr_cube_list *list);

/* Adds a cube; those of one instance follow one another. False for lack of
 * memory. */
bool hsr_cube_list_add(struct hsr_cube_list *list, uint32_t instance,
                       uint32_t cube);

static inline const struct hsr_listed_instance *
hsr_cube_list_group(const struct hsr_cube_list *list, size_t k) {
  return (const struct hsr_listed_instance *)list->group.items + k;
}

static inline const uint32_t *
hsr_cube_list_cubes(const struct hsr_cube_list *list,
                    const struct hsr_listed_instance *group) {
  return (const uint32_t *)list->cube.items + group->first;
}

/* Which cubes a list holds, to be asked quickly. */
struct hsr_cube_marks {
  const struct hsr_cube_list *list;
  uint32_t *group; /* an instance: 1 + its group; 0: it has none */
  uint32_t *start; /* a group: its bits begin here, and end where the next's
                      begin */
  uint32_t *bits;
};

/* The arrays are the arena's. HSR_E_NOMEM. */
enum hsr_status hsr_cube_marks_init(struct hsr_cube_marks *marks,
                                    const struct hsr_cube_list *list,
                                    const struct hsr_cubes *cubes,
                                    struct hsr_arena *arena);

/* The group of an instance, or NULL. */
static inline const struct hsr_listed_instance *
hsr_cube_marks_group(const struct hsr_cube_marks *marks, uint32_t instance) {
  uint32_t g = marks->group[instance];
  return g ? hsr_cube_list_group(marks->list, g - 1) : NULL;
}

static inline bool hsr_cube_is_marked(const struct hsr_cube_marks *marks,
                                      uint32_t instance, uint32_t cube) {
  uint32_t g = marks->group[instance];
  if (!g || cube / 32 >= marks->start[g] - marks->start[g - 1])
    return false; /* a cube that was made since */
  return marks->bits[marks->start[g - 1] + cube / 32] >> cube % 32 & 1;
}

#ifdef __cplusplus
}
#endif
#endif
