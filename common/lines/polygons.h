/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Visible polygons: for each visible face, the regions of the picture where it
 * is visible. docs/visible-polygons.md has the definition.
 *
 * Plane       the picture is [0, m] x [0, n], in pixels, with sx to the right
 *             and sy down.
 * Exact       a vertex is the crossing of the lines of two sides that follow
 *             one another. Only their names are kept. The doubles beside them
 *             are rounded, and are for drawing. */
#ifndef HSR_COMMON_POLYGONS_H
#define HSR_COMMON_POLYGONS_H

#include "common/base/status.h"
#include "common/scene/world.h"
#include "common/view/line_name.h"
#include "common/view/view.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A side of a cycle. It begins where its line crosses the line of the previous
 * side, and ends where its line crosses the line of the next side. */
struct hsr_polygon_side {
  struct hsr_line_name line; /* its faces are face numbers of `world` */
  double at[2]; /* sx, sy of its beginning, rounded, with a relative error of at
                   most 2^-50 */
};

/* A closed polygon with the sides side[first .. first + n - 1], n >= 3. The
 * region is to the right of each side. */
struct hsr_polygon_cycle {
  size_t first, n;
};

/* A region of a face with the cycles cycle[first .. first + n - 1]. The first
 * one is its outer boundary, the others are holes. */
struct hsr_polygon_region {
  uint32_t face; /* the scene's id */
  size_t first, n;
};

/* Regions, by ascending face. The answer is empty if it is all zero. It owns
 * its arrays, which hsr_polygons_free frees. */
struct hsr_polygons {
  const struct hsr_world *world; /* the world whose faces are named, borrowed;
                                    NULL if there are no regions */
  struct hsr_polygon_region *region;
  struct hsr_polygon_cycle *cycle;
  struct hsr_polygon_side *side;
  size_t n_regions, n_cycles, n_sides;
  size_t region_room, cycle_room, side_room; /* how many there is room for */
};

/* Empties the answer and keeps its memory. */
void hsr_polygons_clear(struct hsr_polygons *polygons);

/* Frees the arrays. The answer is empty afterwards. */
void hsr_polygons_free(struct hsr_polygons *polygons);

/* Build an answer: append an empty region; append an empty cycle to the last
 * region, the outer one first; append a copy of a side to the last cycle. The
 * caller sets polygons->world. HSR_E_NOMEM. */
enum hsr_status hsr_polygons_add_region(struct hsr_polygons *polygons,
                                        uint32_t face);
enum hsr_status hsr_polygons_add_cycle(struct hsr_polygons *polygons);
enum hsr_status hsr_polygons_add_side(struct hsr_polygons *polygons,
                                      const struct hsr_polygon_side *side);

/* Appends copies of the regions of another answer, of the same world.
 * HSR_E_NOMEM. */
enum hsr_status hsr_polygons_append(struct hsr_polygons *polygons,
                                    const struct hsr_polygons *more);

/* Sorts the regions by face; those of one face keep their order. */
void hsr_polygons_sort(struct hsr_polygons *polygons);

/* The result of hsr_polygons_compare. */
struct hsr_polygons_difference {
  uint64_t faces;     /* faces in either answer */
  uint64_t differing; /* those of them on which the answers do not agree */
  uint32_t first;     /* the id of the first that differs, if any does */
};

/* Compares two answers of one view by their exact boundaries. HSR_E_NOMEM;
 * HSR_E_INTERNAL if an answer names lines of successive sides that do not
 * cross. */
enum hsr_status hsr_polygons_compare(const struct hsr_polygons *got,
                                     const struct hsr_polygons *wanted,
                                     const struct hsr_view *view,
                                     struct hsr_polygons_difference *difference,
                                     struct hsr_error *err);

/* Sets ids[j * m + i] to the scene's id of the face whose region holds sample
 * (i, j) of the view, exactly; HSR_BACKGROUND if none does. `ids` has m * n
 * elements. HSR_E_NOMEM; HSR_E_INTERNAL as above. */
enum hsr_status hsr_polygons_ids(const struct hsr_polygons *polygons,
                                 const struct hsr_view *view, uint32_t *ids,
                                 struct hsr_error *err);

/* Computes the points in the world where the sides begin, on the planes of
 * their faces, in world units, rounded. The point of side s is points[3s ..
 * 3s+2], in an array of the caller for n_sides points. */
void hsr_polygon_points(const struct hsr_polygons *polygons,
                        const struct hsr_view *view, double *points);

/* Returns the area of a region, in square pixels, from its rounded vertices. */
double hsr_polygon_area(const struct hsr_polygons *polygons,
                        const struct hsr_polygon_region *region);

#ifdef __cplusplus
}
#endif
#endif
