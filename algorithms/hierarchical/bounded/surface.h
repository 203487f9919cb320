/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Interval shaders: bounds on the colour of a polygon, from bounds on what its
 * shader takes. The shaders are those of docs/area-picture.md.
 *
 * Source      N. Greene, PhD thesis, UC Santa Cruz, 1995, 2.2.3 and 5.4.4.
 * Rounding    by CGAL's intervals, which are rounded outward. A colour
 *             certainly lies within its bounds, and these shrink to it with the
 *             square.
 */
#ifndef HSR_ALGORITHMS_BOUNDED_SURFACE_H
#define HSR_ALGORITHMS_BOUNDED_SURFACE_H

#include "algorithms/hierarchical/bounded/shape.h"
#include "common/answers/shader.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_interval {
  double lo, hi;
};

/* A face with all that its shader needs. */
struct hsr_surface {
  struct hsr_shaded_face face;
  double corner[3][3];      /* if face.by_corners: those of a triangle */
  bool is_flat;             /* all corners are in its plane */
  double least[3], most[3]; /* if flat: a box in the world that holds it */
};

/* Fills *surface for a shape. False: out of memory. */
bool hsr_surface_make(struct hsr_surface *surface, struct hsr_shades *shades,
                      const struct hsr_shape *shape, bool is_flat);

/* The interval shader: bounds, by channel, of the face's colours at all points
 * within `point`, seen from all directions within `to_eye`, of any length. */
void hsr_interval_shade(const struct hsr_shades *shades,
                        const struct hsr_surface *surface,
                        const struct hsr_interval point[3],
                        const struct hsr_interval to_eye[3],
                        struct hsr_interval rgb[3]);

/* Bounds of the slope of the bumps at places within `at`, a bump having the
 * length 1. */
struct hsr_interval hsr_bump_slope(struct hsr_interval at);

/* Bounds, by channel, of the colours that the polygon of a shape shows in a
 * square of the screen. */
void hsr_surface_colours(const struct hsr_shades *shades,
                         const struct hsr_surface *surface,
                         const struct hsr_shape *shape,
                         const struct hsr_square *square, double low[3],
                         double high[3]);

#ifdef __cplusplus
}
#endif
#endif
