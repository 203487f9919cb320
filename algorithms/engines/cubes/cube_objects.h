/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How the objects of a scene get their octrees and cells. For cubes.c only; see
 * cubes.h. */
#ifndef HSR_CUBE_OBJECTS_H
#define HSR_CUBE_OBJECTS_H

#include "algorithms/engines/cubes/cubes.h"

/* Fills cubes->object[], and the sizes of the largest cell, on the threads of
 * the scene. The result does not depend on their number. HSR_E_NOMEM. */
enum hsr_status hsr_cubes_make_objects(struct hsr_cubes *cubes,
                                       const struct hsr_octree_rule *rule);

/* The same for cubes that are divided lazily: each octree is a root, and its
 * cell is empty. */
enum hsr_status hsr_cubes_begin_objects(struct hsr_cubes *cubes,
                                        const struct hsr_octree_rule *rule);

#endif
