/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The lines of docs/visible-polygons.md and the points where they cross, as
 * exact numbers, for algorithms that divide the picture plane into polygons.
 *
 * Lines       a table numbers the lines that it is asked about. A line that has
 *             several names has one number. The function of a line is that of
 *             the name by which it was first asked for. The function of another
 *             name has the same sign everywhere, or the opposite sign
 *             everywhere.
 * Points      a point where many lines cross has one number. So two points, or
 *             two lines, are equal if and only if their numbers are.
 * Method      the coefficients of a line are integers without a common divisor.
 *             They are kept in doubles, too, with a proved relative error; the
 *             coordinates of a point are the nearest doubles, and integers only
 *             if they are needed. A sign is found in doubles if the error bound
 *             allows it, else in integers.
 * Memory      lines and points are kept until the table is freed. If memory runs
 *             out, hsr_named_lines_failed returns true, and results are
 *             meaningless from then on. */
#ifndef HSR_COMMON_NAMED_LINES_H
#define HSR_COMMON_NAMED_LINES_H

#include "common/scene/world.h"
#include "common/view/line_name.h"
#include "common/view/view.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_named_lines;

/* Returns an empty table, which the caller frees with hsr_named_lines_free.
 * NULL: out of memory. `world`, which is laid out, and `view` are borrowed and
 * must outlive the table. */
struct hsr_named_lines *hsr_named_lines_new(const struct hsr_world *world,
                                            const struct hsr_view *view);

/* Frees a table. NULL is allowed. */
void hsr_named_lines_free(struct hsr_named_lines *lines);

/* Whether memory has run out in a call of this table. */
bool hsr_named_lines_failed(const struct hsr_named_lines *lines);

/* Returns how many signs were found in integers. */
uint64_t hsr_named_lines_exact(const struct hsr_named_lines *lines);

/* --- Lines ---------------------------------------------------------------- */

/* Returns the number of the line with this name. *sign is +1 if the function of
 * the name has the sign of the line's function, and -1 if it has the opposite
 * sign. HSR_NO_LINE, with *sign 0, if the function of the name is zero
 * everywhere: for an edge whose ends and the eye are on one line, the meeting
 * of a plane with itself, or the row of a corner whose image is at infinity.
 * The line may lie at infinity; its function then has one sign everywhere. */
#define HSR_NO_LINE UINT32_MAX
uint32_t hsr_line_number(struct hsr_named_lines *lines,
                         struct hsr_line_name name, int *sign);

/* Returns the name by which a line was first asked for. */
struct hsr_line_name hsr_line_name_of(const struct hsr_named_lines *lines,
                                      uint32_t line);

/* Returns the sign of c in docs/correct-picture.md, for the plane of a face. It
 * is 0 if and only if the plane holds the eye. */
int hsr_plane_sign(struct hsr_named_lines *lines, uint32_t face);

/* Compares the directions of two lines. A line is directed so that its positive
 * side is on the right, as seen in the picture. Returns +1 if the direction of
 * `to` is to the right of that of `from`, -1 if it is to the left, 0 if the
 * lines are parallel. */
int hsr_line_turn(struct hsr_named_lines *lines, uint32_t from, uint32_t to);

/* Writes the direction of a line, in (sx, sy), rounded and not normalised. The
 * greater component has a relative error of at most 2^-51. Both have the right
 * sign, and a component that is not 0 is not rounded to 0. */
void hsr_line_direction(const struct hsr_named_lines *lines, uint32_t line,
                        double direction[2]);

/* Returns the sign of a line's function at the screen point (sx, sy), in
 * pixels. */
int hsr_line_sign_at(struct hsr_named_lines *lines, uint32_t line, double sx,
                     double sy);

/* --- Points --------------------------------------------------------------- */

/* Returns the number of the point where two different lines cross. HSR_NO_POINT
 * if they are parallel. */
#define HSR_NO_POINT UINT32_MAX
uint32_t hsr_crossing(struct hsr_named_lines *lines, uint32_t k, uint32_t l);

/* Returns the number of the point that is the image of corner k of a face. *w
 * is the sign of the corner's w (common/view/view.h). If it is 0, the image is
 * at infinity, and HSR_NO_POINT is returned. The signs of the components of its
 * direction are written to toward[]. */
uint32_t hsr_corner_point(struct hsr_named_lines *lines, uint32_t face,
                          uint32_t k, int *w, int toward[2]);

/* Whether a face surrounds the point half-way between p and q, by the parity of
 * the edges that cross to the right (docs/correct-picture.md). The point is
 * displaced as samples are. */
bool hsr_parity_between(struct hsr_named_lines *lines, uint32_t face,
                        uint32_t p, uint32_t q);

/* Returns the sign of a line's function at a point. */
int hsr_crossing_side(struct hsr_named_lines *lines, uint32_t point,
                      uint32_t line);

/* Compares the depths of the planes of two faces at a point: +1 if that of f is
 * certainly nearer to the eye, -1 if that of g is, 0 if doubles cannot tell.
 * Then the side of the line HSR_LINE_MEETING decides. */
int hsr_nearer_at(struct hsr_named_lines *lines, uint32_t f, uint32_t g,
                  uint32_t point);

/* Compares the coordinates of two points along an axis, 0 for sx or 1 for sy.
 * Returns -1, 0 or +1 if that of p is less than that of q, equal, or
 * greater. */
int hsr_crossing_compare(struct hsr_named_lines *lines, uint32_t p, uint32_t q,
                         int axis);

/* The same for the coordinate of p and the double `at`. */
int hsr_crossing_compare_to(struct hsr_named_lines *lines, uint32_t p, int axis,
                            double at);

/* Writes sx, sy of a point, in pixels: the nearest doubles. A coordinate above
 * all doubles becomes infinite. */
void hsr_crossing_at(const struct hsr_named_lines *lines, uint32_t point,
                     double at[2]);

#ifdef __cplusplus
}
#endif
#endif
