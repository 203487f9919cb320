/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A piece of an office building after Greene's, made to be hard on
 * hidden-surface methods.
 *
 * Source      N. Greene, Hierarchical Rendering of Complex Environments, Ph.D.
 *             thesis, UC Santa Cruz, 1995; Greene, Kass and Miller, SIGGRAPH
 *             1993: a module of some 15,000 polygons with thin columns, low
 *             walls about the cubicles, and large open stairwells, so that
 *             neither rooms nor storeys hide much for certain.
 * Module      a cube of 16 m, four storeys high; every storey is made of
 *             312 hexahedra, closed, outward and one-sided: 7,488
 *             quadrilaterals a module, or 14,976 triangles.
 * Exact       all coordinates are multiples of 1/64 m, and no solid reaches out
 *             of the cube: solids touch at most, on planes that they
 *             share exactly.
 * Plan        of a storey; x to the right, z down, in metres:
 *
 *                  0  2                        14 16
 *               0     +-----+-----+-----+-----+      a row of cubicles, back
 *                     |     |     |     |     |      to back with that of the
 *             2.75    +--   +--   +--   +--   +      module before
 *              4.5        o-----------------o        o  column
 *                         |   stairwell     |        stairs rise from left to
 *               8         |===============> |        right, 4 m in 5.6 m
 *             11.5        o-----------------o
 *            13.25    +   --+   --+   --+   --+      the other row, turned
 *              16     +-----+-----+-----+-----+      half round
 */
#ifndef HSR_SCENES_MODULE_H
#define HSR_SCENES_MODULE_H

#include "scenes/parts/shapes.h"

/* In 64ths of a metre: the module's side, a storey's height, and that of its
 * floor; above which the eye is at HSR_EYE. */
enum { HSR_MODULE = 1024, HSR_STOREY = 256, HSR_SLAB = 16, HSR_EYE = 106 };

/* Draws one from (0, 0, 0) to (16, 16, 16) into the pen's object, which is
 * empty. */
void hsr_draw_module(struct hsr_pen *pen);

#endif
