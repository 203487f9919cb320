/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The objects of a scene in cubes (cubes.h): the octree and the cells of each. */
#ifndef HSR_CUBE_OBJECTS_H
#define HSR_CUBE_OBJECTS_H

#include "algorithms/engines/cubes/cubes.h"

/* Fills cubes->object[], and finds the largest cell of all, by the threads of the
 * scene. What comes out does not depend on how many there are. HSR_E_NOMEM. */
enum hsr_status hsr_cubes_make_objects(struct hsr_cubes *cubes,
                                       const struct hsr_octree_rule *rule);

/* The same, but no cube is divided, and cells are empty. */
enum hsr_status hsr_cubes_begin_objects(struct hsr_cubes *cubes,
                                        const struct hsr_octree_rule *rule);

#endif
