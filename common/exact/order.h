/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Putting two faces in order by their planes, and dividing one by the other's:
 * what list-priority algorithms ask of a pair before they ask the samples.
 *
 * Source      Sutherland et al. 1974, "Uses of Plane Equations", and the fourth
 *             and fifth of Newell's tests.
 * Polygon     the convex hull of its points holds all of a face, or of a piece
 *             of one: the face's own vertices, exact; or an outline, which is
 *             approximate.
 * Beyond      a polygon is beyond a plane if no ray of the picture meets the
 *             face's own plane, within the polygon, before it meets that plane;
 *             before a plane, if no ray meets it later. The two may touch.
 * Thickness   a face that is not exactly flat is drawn on its plane, its
 *             vertices a little off it: by how much the ray's point is off what
 *             the vertices span depends on the eye. With h the height of the
 *             eye over a plane, it is in proportion dev_f / (|h_f| - dev_f) of
 *             the distance at most, so that heights over g change by no more
 *             than |h_g| times that. Within it, nothing is certain. */
#ifndef HSR_COMMON_ORDER_H
#define HSR_COMMON_ORDER_H

#include "common/exact/screen.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Of a face or a piece of one. */
struct hsr_polygon {
  uint32_t face;
  const double (*outline)[3]; /* NULL: the vertices of the face */
  uint32_t n;                 /* points of the outline */
};

/* HSR_NEARLY: as far as can be told, within the thickness of faces that are not
 * flat; the samples of such a pair must be asked. */
enum hsr_certainty { HSR_NO, HSR_NEARLY, HSR_YES };

/* On which side of the plane of g the eye is: +1 in front, -1 behind; g exists.
 */
int hsr_eye_side(const struct hsr_screen *screen, uint32_t g,
                 struct hsr_tally *tally);

/* Whether the polygon is beyond the plane of g, or before it. They are not on
 * one plane; both exist. */
enum hsr_certainty hsr_beyond(const struct hsr_screen *screen,
                              struct hsr_polygon polygon, uint32_t g,
                              struct hsr_tally *tally);
enum hsr_certainty hsr_before(const struct hsr_screen *screen,
                              struct hsr_polygon polygon, uint32_t g,
                              struct hsr_tally *tally);

/* An outline of what the cut at (g, side) leaves of a polygon: at most n + n/2
 * + 1 points for n of the polygon's, which `points` has room for, as scratch
 * has. Returns how many. */
uint32_t hsr_divide_outline(const struct hsr_screen *screen,
                            struct hsr_polygon polygon, struct hsr_cut cut,
                            double (*points)[3], double (*scratch)[3]);

/* Bounds of a piece by its outline: those of the face, narrowed. */
struct hsr_bounds hsr_outline_bounds(const struct hsr_screen *screen,
                                     struct hsr_polygon polygon);

/* The depths w, along F, of all points where a ray meets the polygon's face
 * within it: in [*nearest, *farthest]; infinite if it cannot be told. */
void hsr_depth_range(const struct hsr_screen *screen,
                     struct hsr_polygon polygon, double *nearest,
                     double *farthest);

/* Narrows a depth range of face f to that of the samples within the bounds. */
void hsr_narrow_depth_range(const struct hsr_screen *screen, uint32_t f,
                            const struct hsr_bounds *bounds, double *nearest,
                            double *farthest);

/* Whether what is seen of face f may be farther than `reach` from the hull of
 * its vertices: the eye is near its plane. Never, of a face that is flat. */
bool hsr_grazes(const struct hsr_screen *screen, uint32_t f, double reach);

#ifdef __cplusplus
}
#endif
#endif
