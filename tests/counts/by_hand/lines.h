/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The scenes from which the counts of the line algorithms are derived by hand.
 *
 * bar: a tall rectangle N, near, in front of a wide one F, far. N covers F from
 * x = 4 to 6: the upper and the lower edge of F have a hidden part in the
 * middle.
 *
 * corner: N covers the left part of F up to x = 5: the left edge of F is
 * hidden, and the beginning of the upper and of the lower one.
 *
 * box: a box, seen from the front. Vertices 0 to 3 are its front, 4 to 7 its
 * back, clockwise from the upper left. Only the front is seen: in the picture
 * the back lies within it. */
#ifndef HSR_TESTS_COUNTS_LINES_H
#define HSR_TESTS_COUNTS_LINES_H

#include "tests/counts/by_hand/objects.h"

static const struct hand_object bar[] = {HAND_RECTANGLE(2, 2, 10, 6, 8),
                                         HAND_RECTANGLE(4, 1, 6, 7, 4)};

static const struct hand_object corner[] = {HAND_RECTANGLE(2, 2, 10, 6, 8),
                                            HAND_RECTANGLE(1, 1, 5, 7, 4)};

/* Every face runs counter-clockwise as seen from outside. */
static const struct hand_object box[] = {{8,
                                          6,
                                          {{4, 2, 4},
                                           {12, 2, 4},
                                           {12, 6, 4},
                                           {4, 6, 4},
                                           {6, 3, 8},
                                           {10, 3, 8},
                                           {10, 5, 8},
                                           {6, 5, 8}},
                                          {{4, {0, 3, 2, 1}},
                                           {4, {4, 5, 6, 7}},
                                           {4, {0, 4, 7, 3}},
                                           {4, {1, 2, 6, 5}},
                                           {4, {0, 1, 5, 4}},
                                           {4, {3, 7, 6, 2}}}}};

#endif
