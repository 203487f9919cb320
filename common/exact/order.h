/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Deciding by their planes which of two faces may hide the other, and dividing
 * one face by the plane of the other. List-priority algorithms ask these
 * questions about a pair of faces before they compare the faces at samples.
 *
 * Source      Sutherland et al. 1974, "Uses of Plane Equations", and the fourth
 *             and fifth of Newell's tests.
 * Polygon     points whose convex hull holds all of a face, or of a piece of
 *             one. They are the face's own vertices, which are exact, or an
 *             outline, which is approximate.
 * Beyond      a polygon is beyond a plane if no ray of the picture meets the
 *             polygon, on its face's own plane, before it meets the other
 *             plane. It is before a plane if no ray meets the polygon after the
 *             plane. The two may touch.
 * Thickness   a face that is not exactly flat is drawn on its plane, but its
 *             vertices are a little off the plane. So a point that a ray meets
 *             may be off the hull of the vertices. Let h be the height of the
 *             eye over a plane. The point is off by at most the part
 *             dev_f / (|h_f| - dev_f) of its distance from the eye. So its
 *             height over g changes by at most |h_g| times that part. In
 *             parallel projection h is N.F, and the point is off by at most F
 *             times dev_f / |h_f|. Its height over g changes by |h_g| times
 *             that. A comparison of smaller heights is not certain. */
#ifndef HSR_COMMON_ORDER_H
#define HSR_COMMON_ORDER_H

#include "common/exact/screen.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The polygon of a face, or of a piece of one. The outline is borrowed. */
struct hsr_polygon {
  uint32_t face;
  const double (*outline)[3]; /* points, x, y, z each; NULL: the polygon has the
                                 vertices of the face */
  uint32_t n; /* points of the outline; of no meaning if it is NULL */
  double off; /* the error of each coordinate of the outline, world units */
};

/* An answer. HSR_NEARLY: a face is not flat, and it is too thick to tell. The
 * faces must then be compared at their samples. */
enum hsr_certainty { HSR_NO, HSR_NEARLY, HSR_YES };

/* Returns the side of the plane of g that the eye is on: +1 in front, -1
 * behind. g exists (hsr_face_exists). */
int hsr_eye_side(const struct hsr_screen *screen, uint32_t g,
                 struct hsr_tally *tally);

/* Whether the polygon is beyond the plane of g, or before it. Both faces exist,
 * and they are not in one plane class. */
enum hsr_certainty hsr_beyond(const struct hsr_screen *screen,
                              struct hsr_polygon polygon, uint32_t g,
                              struct hsr_tally *tally);
enum hsr_certainty hsr_before(const struct hsr_screen *screen,
                              struct hsr_polygon polygon, uint32_t g,
                              struct hsr_tally *tally);

/* Returns the part of a polygon that a cut keeps, with an outline. Its points
 * are written to `points`, which the result borrows. If the polygon has n
 * points, `points` has room for n + n/2 + 1, and `scratch` for n. Neither may
 * overlap the polygon's outline. */
struct hsr_polygon hsr_divide_outline(const struct hsr_screen *screen,
                                      struct hsr_polygon polygon,
                                      struct hsr_cut cut, double (*points)[3],
                                      double (*scratch)[3]);

/* Returns the bounds of the polygon's face, which must be relevant, narrowed to
 * the outline of the polygon. The polygon must have an outline. */
struct hsr_bounds hsr_outline_bounds(const struct hsr_screen *screen,
                                     struct hsr_polygon polygon);

/* Finds a range [*nearest, *farthest] of depths t, in world units along F. It
 * holds the depths of all points where a ray meets the polygon on its face's
 * plane. If no such range is known, it is [0, +infinity]. */
void hsr_depth_range(const struct hsr_screen *screen,
                     struct hsr_polygon polygon, double *nearest,
                     double *farthest);

/* Narrows a depth range of face f to the depths of its plane at the samples in
 * *bounds. */
void hsr_narrow_depth_range(const struct hsr_screen *screen, uint32_t f,
                            const struct hsr_bounds *bounds, double *nearest,
                            double *farthest);

/* Whether a point at which a ray meets face f may be farther than `reach` from
 * the hull of the face's vertices, because the eye is near its plane. `reach`
 * is finite, in world units. False for a face that is flat. */
bool hsr_grazes(const struct hsr_screen *screen, uint32_t f, double reach);

#ifdef __cplusplus
}
#endif
#endif
