/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where two visible polygons touch.
 *
 * Programs that show vector files draw each polygon with soft edges. Where two
 * touch, the paper shows through both. So a hairline of one's colour is drawn
 * beneath them, there and only there: at the outline of the scene it would make
 * the scene larger. Merging polygons of one colour would leave the seams between
 * others. */
#ifndef HSR_COMMON_PAPER_SHARED_SIDES_H
#define HSR_COMMON_PAPER_SHARED_SIDES_H

#include "common/lines/polygons.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Half of a hairline lies on either side. In pixels of the page. */
#define HSR_HAIRLINE 1

struct hsr_shared_side {
  size_t region;         /* the first of the two, of the polygons */
  double from[2], to[2]; /* pixels of the picture, rounded */
};

struct hsr_shared_sides {
  struct hsr_shared_side *side; /* by region */
  size_t n;
};

/* Finds the sides that two regions share, or parts of sides. Sides are of one
 * line if they are images of one edge; edges are one if their ends are at the
 * same places. *shared is written in full, and is freed with
 * hsr_shared_sides_free also after a failure. HSR_E_NOMEM. */
enum hsr_status hsr_shared_sides_find(struct hsr_shared_sides *shared,
                                      const struct hsr_polygons *polygons,
                                      struct hsr_error *err);
void hsr_shared_sides_free(struct hsr_shared_sides *shared);

#ifdef __cplusplus
}
#endif
#endif
