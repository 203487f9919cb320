/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Romney's counts, derived by hand from Sutherland et al. 1974, "Scan-line
 * Algorithms" and "Existing Uses of Coherence". */
#include "tests/counts/by_hand/pixels.h"

/* Two triangles, A behind B, each with an upright edge on the left:
 *  row   A       B
 *  1     2-13
 *  2     2-11    4-9
 *  3     2-9     4-7
 *  4     2-7     4-5
 *  5     2-5
 *  6     2-3 */
static const struct pixel_face triangles[] = {
    {3, {{2, 1, 8}, {14, 1, 8}, {2, 7, 8}}},
    {3, {{4, 2, 4}, {10, 2, 4}, {4, 5, 4}}}};

/* Y sort: 2 faces. X sort: the faces of each row: 1 + 2 + 2 + 2 + 1 + 1 = 9.
 * X priority search: every X bucket of every row: 16 * 8 = 128; each face on a
 * row has intercepts in two: 18.
 *
 * A search of a span looks at each face of the X occupied table.
 *   row  spans                        searched            reused
 *   0    1
 *   1    3: -, A, -                   A: 1 face
 *   2    5: -, A, B, A, -             B: 2; A behind: 1   A before B enters
 *   3    5                                                A, B, A: the line
 *   4    5                                                A, B, A: the line
 *   5    3: -, A, -                                       A: no span is left
 *                                                         to be searched
 *   6    3                                                A: the line
 *   7    1
 * Spans: 26. Depth search: 1 + 3 = 4. Spans reused: 1 + 3 + 3 + 1 + 1 = 9.
 * A is in the table before B, so each look finds a face nearer than all before.
 * Lines with faces but without a search: rows 3 to 6. Both faces are flat.
 *
 * Order tests: intercepts, up to the first that is another than on the last line.
 * Row 2: the left one of A, then that of B for the right one of A: 2, 1 the same.
 * Rows 3 and 4: 4 each. Row 5: that of A, then its right one for B's left: 2, 1
 * the same. Row 6: 2. */
static const struct hand_count derived[] = {
    {"Y sort", 2},
    {"X sort", 9},
    {"X priority search", 128},
    {"X priority search", 18, "holds intercepts"},
    {"X priority search", 110, "empty"},
    {"depth search", 4},
    {"depth search", 4, "nearer"},
    {"spans", 26},
    {"spans reused", 9},
    {"lines reused", 4},
    {"order tests", 14},
    {"order tests", 12, "the same intercept"},
    {NULL}};

int main(void) {
  struct tap tap = plan(1);
  ok(&tap, pixel_check("romney", triangles, 2, derived), "two triangles");
  return finish(&tap);
}
