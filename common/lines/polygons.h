/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Visible polygons: for each visible face, the regions of the picture in which
 * it is seen. docs/visible-polygons.md has the definition.
 *
 * Plane       the picture, [0, m] x [0, n], in pixels, sx to the right and sy
 *             down.
 * Exact       a vertex is the crossing of the lines of two sides that follow one
 *             another. Only their names are kept. The doubles beside them are
 *             rounded, and are for drawing. */
#ifndef HSR_COMMON_POLYGONS_H
#define HSR_COMMON_POLYGONS_H

#include "common/base/status.h"
#include "common/scene/world.h"
#include "common/view/line_name.h"
#include "common/view/view.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A side of a cycle. It begins at the crossing of its line with the line of the
 * side before, and ends at that with the line of the side after. */
struct hsr_polygon_side {
  struct hsr_line_name line; /* faces and corners are those of `world` */
  double at[2]; /* (sx, sy) of its beginning, rounded, with a relative error of
                   at most 2^-50 */
};

/* Sides [first, first + n), n >= 3. The region is to the right of each. */
struct hsr_polygon_cycle {
  size_t first, n;
};

/* Cycles [first, first + n): the outer one, then its holes. */
struct hsr_polygon_region {
  uint32_t face; /* the scene's id */
  size_t first, n;
};

/* Regions, by ascending face. All zero is an empty answer. It owns its arrays,
 * which are kept from frame to frame; hsr_polygons_free frees them. */
struct hsr_polygons {
  const struct hsr_world *world; /* whose faces are named; borrowed; NULL if
                                    there are no regions */
  struct hsr_polygon_region *region;
  struct hsr_polygon_cycle *cycle;
  struct hsr_polygon_side *side;
  size_t n_regions, n_cycles, n_sides;
  size_t region_room, cycle_room, side_room;
};

/* Empties the answer and keeps its memory. */
void hsr_polygons_clear(struct hsr_polygons *polygons);
void hsr_polygons_free(struct hsr_polygons *polygons);

/* Append: an empty region; an empty cycle to the last region, the outer one
 * first; a side to the last cycle. HSR_E_NOMEM. */
enum hsr_status hsr_polygons_add_region(struct hsr_polygons *polygons,
                                        uint32_t face);
enum hsr_status hsr_polygons_add_cycle(struct hsr_polygons *polygons);
enum hsr_status hsr_polygons_add_side(struct hsr_polygons *polygons,
                                      const struct hsr_polygon_side *side);

/* Appends the regions of another answer of the same world. HSR_E_NOMEM. */
enum hsr_status hsr_polygons_append(struct hsr_polygons *polygons,
                                    const struct hsr_polygons *more);

/* Sorts the regions by face; those of one face keep their order. */
void hsr_polygons_sort(struct hsr_polygons *polygons);

/* Compares two answers to one view, by their exact boundaries. */
struct hsr_polygons_difference {
  uint64_t faces;     /* in either answer */
  uint64_t differing; /* of them, those on which the answers do not agree */
  uint32_t first;     /* the first of those */
};
/* HSR_E_NOMEM; HSR_E_INTERNAL if an answer names lines that do not cross. */
enum hsr_status hsr_polygons_compare(const struct hsr_polygons *got,
                                     const struct hsr_polygons *wanted,
                                     const struct hsr_view *view,
                                     struct hsr_polygons_difference *difference,
                                     struct hsr_error *err);

/* The face at every sample of the view, as the regions have it, exactly:
 * ids[j * m + i], HSR_BACKGROUND where there is none. HSR_E_NOMEM;
 * HSR_E_INTERNAL as above. */
enum hsr_status hsr_polygons_ids(const struct hsr_polygons *polygons,
                                 const struct hsr_view *view, uint32_t *ids,
                                 struct hsr_error *err);

/* Where the sides begin in world space, on the planes of their faces, rounded:
 * three coordinates a side. */
void hsr_polygon_points(const struct hsr_polygons *polygons,
                        const struct hsr_view *view, double *points);

/* The area of a region, from its rounded vertices, in pixels. */
double hsr_polygon_area(const struct hsr_polygons *polygons,
                        const struct hsr_polygon_region *region);

#ifdef __cplusplus
}
#endif
#endif
