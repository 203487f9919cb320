/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The objects of the harbor: each stands on one lot, is drawn about the origin
 * inside |x|, |z| < 32 metres, and has about n_faces faces.
 *
 * Solids touch at most, on planes parallel to the axes, so that lots turned by
 * quarters still touch exactly. All faces are convex, and exactly plane: where
 * one is not parallel to an axis its coordinates have few bits. */
#ifndef HSR_SCENES_LOTS_H
#define HSR_SCENES_LOTS_H

#include "scenes/parts/shapes.h"

#define HSR_LOT_SIZE 64.0 /* metres */
#define HSR_WATER (-2.0)  /* height of the water; quays are at 0 */

/* X(kind, number of variants) */
#define HSR_LOTS(X)                                                            \
  X(ship, 4)                                                                   \
  X(boats, 2)                                                                  \
  X(crane, 2)                                                                  \
  X(containers, 4)                                                             \
  X(warehouse, 3)                                                              \
  X(tank, 2)                                                                   \
  X(houses, 6)                                                                 \
  X(tower, 5)                                                                  \
  X(park, 2)                                                                   \
  X(church, 1)                                                                 \
  X(lighthouse, 1)                                                             \
  X(hill, 2)

enum hsr_lot_kind {
#define X(kind, variants) HSR_LOT_##kind,
  HSR_LOTS(X)
#undef X
      HSR_N_LOT_KINDS
};

struct hsr_lot_type {
  const char *name;
  int n_variants;
  /* Draws into the pen's object, which is empty. */
  void (*draw)(struct hsr_pen *pen, int variant, int n_faces);
};

extern const struct hsr_lot_type hsr_lot_types[HSR_N_LOT_KINDS];

#endif
