/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists of cubes, grouped by instances.
 *
 * Source      N. Greene, M. Kass and G. Miller, "Hierarchical Z-Buffer
 *             Visibility", SIGGRAPH 1993, 3.3: the temporal coherence list.
 * Cost        memory for the cubes that are listed, which are few, not for
 *             all */
#ifndef HSR_ALGORITHMS_CUBE_LIST_H
#define HSR_ALGORITHMS_CUBE_LIST_H

#include "algorithms/algorithm.h"
#include "algorithms/engines/cubes/cubes.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The listed cubes of one instance: cube[first] to cube[first + n - 1]. Those of
 * the octree of instances have HSR_NO_ID in place of an instance. */
struct hsr_listed_instance {
  uint32_t instance, first, n;
};

/* An empty list is all zero. Freed with hsr_arena_free(&list->arena). */
struct hsr_cube_list {
  struct hsr_growing group; /* struct hsr_listed_instance; no instance twice */
  struct hsr_growing cube;  /* uint32_t */
  struct hsr_arena arena;
};

void hsr_cube_list_clear(struct hsr_cube_list *list);

/* Adds a cube. Cubes of one instance are added one after another. False: out of
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

/* Marks for the cubes of a list, to tell quickly whether it holds a cube. */
struct hsr_cube_marks {
  const struct hsr_cube_list *list; /* borrowed */
  uint32_t n_instances;
  /* By instance, and n_instances for HSR_NO_ID: 1 + its group; 0: it has none. */
  uint32_t *group;
  /* By group: bits[start[g]] to bits[start[g + 1] - 1] are its. */
  uint32_t *start;
  uint32_t *bits; /* of a group: a bit for each of the object's cubes */
};

/* Makes the marks of a list, whose cubes are those of *cubes. The arrays are
 * the arena's. HSR_E_NOMEM. */
enum hsr_status hsr_cube_marks_init(struct hsr_cube_marks *marks,
                                    const struct hsr_cube_list *list,
                                    const struct hsr_cubes *cubes,
                                    struct hsr_arena *arena);

/* The place of an instance, or of HSR_NO_ID, in group[]. */
static inline uint32_t *hsr_cube_marks_place(const struct hsr_cube_marks *marks,
                                             uint32_t instance) {
  return &marks->group[instance == HSR_NO_ID ? marks->n_instances : instance];
}

/* The group of an instance, or NULL. */
static inline const struct hsr_listed_instance *
hsr_cube_marks_group(const struct hsr_cube_marks *marks, uint32_t instance) {
  uint32_t g = *hsr_cube_marks_place(marks, instance);
  return g ? hsr_cube_list_group(marks->list, g - 1) : NULL;
}

/* Does the list hold a cube of an instance? */
static inline bool hsr_cube_is_marked(const struct hsr_cube_marks *marks,
                                      uint32_t instance, uint32_t cube) {
  uint32_t g = *hsr_cube_marks_place(marks, instance);
  if (!g || cube / 32 >= marks->start[g] - marks->start[g - 1])
    return false; /* a cube that was made since */
  return marks->bits[marks->start[g - 1] + cube / 32] >> cube % 32 & 1;
}

#ifdef __cplusplus
}
#endif
#endif
