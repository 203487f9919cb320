/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The lines of docs/visible-polygons.md and the points where they cross, as
 * exact numbers, for algorithms that divide the picture plane into polygons.
 *
 * Lines       a line that has several names has one number. The function of a
 *             line is that of its first name; that of another name has the same
 *             sign everywhere, or the opposite one.
 * Points      a point in which many lines cross has one number. So points are
 *             equal if their numbers are, and lines too.
 * Method      the coefficients of a line are integers without a common divisor,
 *             and so are the homogeneous coordinates of a point. Each is also
 *             kept in doubles, with a proved relative error. A sign is found
 *             in doubles if the bound of the error allows it, else in integers.
 * Memory      what was asked for is kept until the table is freed. GMP ends the
 *             process if memory runs out; what else runs out sets the flag of
 *             hsr_named_lines_failed, and answers mean nothing from then on. */
#ifndef HSR_COMMON_NAMED_LINES_H
#define HSR_COMMON_NAMED_LINES_H

#include "common/scene/world.h"
#include "common/view/line_name.h"
#include "common/view/view.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_named_lines;

/* An empty table, or NULL for lack of memory. `world`, which is laid out, and
 * `view` are borrowed and must outlive it. */
struct hsr_named_lines *hsr_named_lines_new(const struct hsr_world *world,
                                            const struct hsr_view *view);
void hsr_named_lines_free(struct hsr_named_lines *lines); /* NULL is allowed */

bool hsr_named_lines_failed(const struct hsr_named_lines *lines);

/* How many signs were found in integers. */
uint64_t hsr_named_lines_exact(const struct hsr_named_lines *lines);

/* --- Lines ---------------------------------------------------------------- */

/* The number of a line. *sign is +1 if the function of this name has the sign of
 * the line's function, else -1. HSR_NO_LINE if the name's function is zero
 * everywhere: an edge whose ends and the eye are on one line, the meeting of a
 * plane with itself, the row of a corner at infinity; then *sign is 0. A line may lie at infinity: its function
 * has one sign everywhere. */
#define HSR_NO_LINE UINT32_MAX
uint32_t hsr_line_number(struct hsr_named_lines *lines,
                         struct hsr_line_name name, int *sign);

/* The first name of a line. */
struct hsr_line_name hsr_line_name_of(const struct hsr_named_lines *lines,
                                      uint32_t line);

/* Whether the plane of a face does not hold the eye, and the sign of c in
 * docs/correct-picture.md: 0 if it does. */
int hsr_plane_sign(struct hsr_named_lines *lines, uint32_t face);

/* For one who walks along a line with its positive side on the right, in the
 * picture: +1 if one turns right to walk along the other line likewise, -1 if
 * left, 0 if the lines are parallel. */
int hsr_line_turn(struct hsr_named_lines *lines, uint32_t from, uint32_t to);

/* The direction of that walk, rounded. The component of the greater size has a
 * relative error of at most 2^-51, and both have the right sign: a component
 * that is not 0 is not rounded to 0. */
void hsr_line_direction(const struct hsr_named_lines *lines, uint32_t line,
                        double direction[2]);

/* The sign of a line's function at a point of the picture plane. */
int hsr_line_sign_at(struct hsr_named_lines *lines, uint32_t line, double sx,
                     double sy);

/* --- Points --------------------------------------------------------------- */

/* The number of the point where two different lines cross. HSR_NO_POINT if they
 * are parallel. */
#define HSR_NO_POINT UINT32_MAX
uint32_t hsr_crossing(struct hsr_named_lines *lines, uint32_t k, uint32_t l);

/* The image of corner k of a face. *w is the sign of its depth w in
 * common/view/view.h. If that is 0, the image is infinitely far away, in the
 * direction whose components have the signs toward[]: HSR_NO_POINT. */
uint32_t hsr_corner_point(struct hsr_named_lines *lines, uint32_t face,
                          uint32_t k, int *w, int toward[2]);

/* Whether a face surrounds the point half way between p and q, displaced as
 * samples are: by the parity of edges that cross to the right, in
 * docs/correct-picture.md. */
bool hsr_parity_between(struct hsr_named_lines *lines, uint32_t face,
                        uint32_t p, uint32_t q);

/* The sign of a line's function at a point. */
int hsr_crossing_side(struct hsr_named_lines *lines, uint32_t point,
                      uint32_t line);

/* Compares the coordinates of two points along an axis, 0 or 1: -1, 0 or +1 as
 * that of p is less than that of q, equal, or greater. */
int hsr_crossing_compare(struct hsr_named_lines *lines, uint32_t p, uint32_t q,
                         int axis);

/* Likewise for the coordinate of p and a double. */
int hsr_crossing_compare_to(struct hsr_named_lines *lines, uint32_t p, int axis,
                            double at);

/* (sx, sy) of a point, each with a relative error of at most 2^-50; infinite if
 * no double comes near. */
void hsr_crossing_at(const struct hsr_named_lines *lines, uint32_t point,
                     double at[2]);

#ifdef __cplusplus
}
#endif
#endif
