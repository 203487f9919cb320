/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Putting two faces in order by their planes, and dividing one face by the
 * plane of the other. List-priority algorithms ask these questions about a pair
 * of faces before they ask about its samples.
 *
 * Source      Sutherland et al. 1974, "Uses of Plane Equations", and the fourth
 *             and fifth of Newell's tests.
 * Polygon     points whose convex hull holds all of a face, or of a piece of
 *             one. They are the face's own vertices, which are exact, or an
 *             outline, which is approximate.
 * Beyond      a polygon is beyond a plane if no ray of the picture meets the
 *             polygon, on its face's own plane, before it meets that plane. It
 *             is before a plane if no ray meets it later. The two may touch.
 * Thickness   a face that is not exactly flat is drawn on its plane, but its
 *             vertices are a little off the plane. So a point that a ray sees
 *             may be off the hull of the vertices. Let h be the height of the
 *             eye over a plane: the point is off by at most the part
 *             dev_f / (|h_f| - dev_f) of its distance, so that its height over
 *             g changes by at most |h_g| times that part. In parallel h is
 *             N.F, and the point is off by at most F times dev_f / |h_f|, so
 *             its height changes by |h_g| times that as well. A comparison that
 *             is closer than this is not certain. */
#ifndef HSR_COMMON_ORDER_H
#define HSR_COMMON_ORDER_H

#include "common/exact/screen.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The polygon of a face, or of a piece of one. The outline is borrowed. */
struct hsr_polygon {
  uint32_t face;
  const double (*outline)[3]; /* NULL: the vertices of the face */
  uint32_t n;                 /* points of the outline; */
  double off;                 /* each of their coordinates is within this of the
                                 true one (world units) */
};

/* HSR_NEARLY: it may be so, but faces that are not flat are too thick to tell.
 * The samples of such a pair must be asked. */
enum hsr_certainty { HSR_NO, HSR_NEARLY, HSR_YES };

/* The side of the plane of g that the eye is on: +1 in front, -1 behind. g
 * exists. */
int hsr_eye_side(const struct hsr_screen *screen, uint32_t g,
                 struct hsr_tally *tally);

/* Whether the polygon is beyond the plane of g, or before it. Its face and g
 * are not on one plane; both exist. */
enum hsr_certainty hsr_beyond(const struct hsr_screen *screen,
                              struct hsr_polygon polygon, uint32_t g,
                              struct hsr_tally *tally);
enum hsr_certainty hsr_before(const struct hsr_screen *screen,
                              struct hsr_polygon polygon, uint32_t g,
                              struct hsr_tally *tally);

/* What a cut leaves of a polygon, as one whose outline is in points[]. If the
 * polygon has n points, the outline has at most n + n/2 + 1; `points` has room
 * for that many, and `scratch` for n. */
struct hsr_polygon hsr_divide_outline(const struct hsr_screen *screen,
                                      struct hsr_polygon polygon,
                                      struct hsr_cut cut, double (*points)[3],
                                      double (*scratch)[3]);

/* The bounds of the face, narrowed to the outline of the polygon, which must
 * have one. */
struct hsr_bounds hsr_outline_bounds(const struct hsr_screen *screen,
                                     struct hsr_polygon polygon);

/* The depths t, along F in world units, of all points where a ray meets the
 * polygon on its face's plane: they lie in [*nearest, *farthest]. Where that
 * cannot be told, these are 0 and +infinity. */
void hsr_depth_range(const struct hsr_screen *screen,
                     struct hsr_polygon polygon, double *nearest,
                     double *farthest);

/* Narrows a depth range of face f to the depths of its plane at the samples
 * within the bounds. */
void hsr_narrow_depth_range(const struct hsr_screen *screen, uint32_t f,
                            const struct hsr_bounds *bounds, double *nearest,
                            double *farthest);

/* Whether what is seen of face f may be farther than `reach` (world units,
 * finite) from the hull of its vertices, because the eye is near its plane. False
 * for a face that is flat. */
bool hsr_grazes(const struct hsr_screen *screen, uint32_t f, double reach);

#ifdef __cplusplus
}
#endif
#endif
