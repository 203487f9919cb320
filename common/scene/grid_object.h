/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cells of a grid as an object, so that every algorithm can draw them. */
#ifndef HSR_COMMON_SCENE_GRID_OBJECT_H
#define HSR_COMMON_SCENE_GRID_OBJECT_H

#include "common/grids/grid.h"
#include "common/scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Fills an empty object with the sides of the grid's cells that are faces: face
 * f of the object is face f of the grid (hsr_grid_face). A corner that several
 * cells share is one vertex. The object becomes one-sided, since the back of a
 * face is inside a cell. HSR_E_NOMEM; the object is then partly filled. */
enum hsr_status hsr_grid_make_object(const struct hsr_grid *grid,
                                     struct hsr_object *object);

#ifdef __cplusplus
}
#endif
#endif
