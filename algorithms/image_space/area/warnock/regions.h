/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which faces interact with the principal regions of the picture, kept from one
 * frame to the next.
 *
 * Source      Sutherland et al. 1974, "Frame and Object Coherence": Warnock
 *             might save "a partially sorted list of window/face interactions",
 *             of "the 64 or 256 principal regions of the screen", and change it
 *             from frame to frame.
 * Notation    Region: a window of level 3 or 4 of Warnock's subdivision, in
 *             which each window is divided at its centre; so there are 64 or
 *             256. Interaction: the face's bounds reach the region. Partially
 *             sorted: in the Z order of the last frame.
 * Invariants  After an update, the list of a region has each relevant face
 *             whose bounds reach the region, once, in Z order.
 * Departures  It is not kept whether a face surrounds a region: a camera that
 *             moves may change that, and only the test can tell.
 * Cost        For each face a comparison of its range of regions with that of
 *             the last frame. The Z sort takes one comparison for each face of
 *             a list that has kept its order.
 */
#ifndef HSR_ALGORITHMS_WARNOCK_REGIONS_H
#define HSR_ALGORITHMS_WARNOCK_REGIONS_H

#include "algorithms/algorithm.h"
#include "common/base/arena.h"
#include "common/exact/screen.h"

/* There are 1 << level regions along a side of the picture. */
enum { HSR_MOST_REGION_LEVEL = 4, HSR_MOST_REGIONS_ASIDE = 16 };

/* The regions that a face's bounds reach: columns [c0, c1) and rows [r0, r1) of
 * regions. Empty if the face is not relevant. */
struct hsr_region_range {
  uint8_t c0, r0, c1, r1;
};

struct hsr_regions {
  int level;
  struct hsr_region_range *range; /* by face: in the last frame */
  /* By region, that of column c and row r being number (r << level) + c: its
   * faces, uint32_t. */
  struct hsr_growing list[HSR_MOST_REGIONS_ASIDE * HSR_MOST_REGIONS_ASIDE];
  struct hsr_arena arena; /* of the lists */

  /* Regions of column c have the samples of columns [column[c], column[c + 1]);
   * likewise for rows. */
  int column[HSR_MOST_REGIONS_ASIDE + 1];
  int row[HSR_MOST_REGIONS_ASIDE + 1];
};

/* New regions, with empty lists, for n_faces faces. Freed by the caller with
 * hsr_regions_free. NULL: out of memory. */
struct hsr_regions *hsr_regions_new(int level, uint32_t n_faces);
void hsr_regions_free(struct hsr_regions *regions);

/* The counters of an update. */
struct hsr_region_counters {
  int ranges; /* faces whose range is compared with that of the last frame */
  int enter;  /* faces that enter a region */
  int leave;  /* faces that leave a region */
  int sort;   /* comparisons of the Z sort */
};

/* Brings the lists to the frame of a job. key[f] is the Z of relevant face f;
 * faces with greater keys come first. HSR_E_NOMEM: the lists are empty then. */
enum hsr_status hsr_regions_update(struct hsr_regions *regions,
                                   const struct hsr_job *job,
                                   const struct hsr_screen *screen,
                                   const uint32_t *key,
                                   const struct hsr_region_counters *counters);

/* The samples of region (c, r). There may be none if the picture is small. */
static inline struct hsr_window
hsr_region_window(const struct hsr_regions *regions, int c, int r) {
  return hsr_window_make(regions->column[c], regions->row[r],
                         regions->column[c + 1], regions->row[r + 1]);
}

/* The faces of region (c, r), *n of them, in Z order. Valid until the next
 * update. */
static inline const uint32_t *
hsr_region_faces(const struct hsr_regions *regions, int c, int r, size_t *n) {
  const struct hsr_growing *list = &regions->list[(r << regions->level) + c];
  *n = list->n;
  return list->items;
}

#endif
