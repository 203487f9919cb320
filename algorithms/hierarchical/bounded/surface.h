/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Interval shaders: bounds on the colour of a polygon from bounds on what a
 * shader takes. The thesis, 5.4.4; the shaders are those of
 * docs/area-picture.md.
 *
 * Source      N. Greene, PhD thesis, UC Santa Cruz, 1995, 2.2.3 and 5.4.4.
 * Rounding    CGAL's intervals, rounded outward. A colour is certain to lie in
 *             what is said of it, and what is said shrinks to it with the
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
  double corner[3][3];      /* of a triangle, if face.by_corners */
  bool is_flat;             /* all corners are in its plane, */
  double least[3], most[3]; /* and so the polygon is in this box */
};

/* Fills *surface for a shape. False if memory ran out. */
bool hsr_surface_make(struct hsr_surface *surface, struct hsr_shades *shades,
                      const struct hsr_shape *shape, bool is_flat);

/* The interval shader: all colours of the face, a channel each, at points
 * between the bounds of `point`, seen from directions `to_eye`, of any
 * length. */
void hsr_interval_shade(const struct hsr_shades *shades,
                        const struct hsr_surface *surface,
                        const struct hsr_interval point[3],
                        const struct hsr_interval to_eye[3],
                        struct hsr_interval rgb[3]);

/* The slope of the bumps between two places, the length of a bump being 1. */
struct hsr_interval hsr_bump_slope(struct hsr_interval at);

/* All colours that the polygon of a shape shows in a square of the screen. */
void hsr_surface_colours(const struct hsr_shades *shades,
                         const struct hsr_surface *surface,
                         const struct hsr_shape *shape,
                         const struct hsr_square *square, double low[3],
                         double high[3]);

#ifdef __cplusplus
}
#endif
#endif
