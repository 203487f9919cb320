/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cells of a grid as an object, so that every algorithm can draw them. */
#ifndef HSR_COMMON_SCENE_GRID_OBJECT_H
#define HSR_COMMON_SCENE_GRID_OBJECT_H

#include "common/grids/grid.h"
#include "common/scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Fills an empty object with the grid's faces, under their numbers. Cells share
 * the vertices of the corners that they share. The backs of faces do not exist:
 * they are inside of cells. HSR_E_NOMEM. */
enum hsr_status hsr_grid_make_object(const struct hsr_grid *grid,
                                     struct hsr_object *object);

#ifdef __cplusplus
}
#endif
#endif
