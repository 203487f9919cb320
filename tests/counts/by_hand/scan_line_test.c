/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The Y sort, X merge and X sort of the scan-line algorithms, derived by hand.
 *
 * If the merge misplaces an edge, the bubble sort repairs the order and the
 * picture stays right. But then the sort makes interchanges. In the first scene
 * no two edges change places from line to line, so any interchange is a fault
 * of the merge. */
#include "tests/counts/by_hand/pixels.h"

enum { M = 16, N = 8 };

/* --- Edges that enter between others -------------------------------------- */

/* deck, rows 1 to 5:      list after the row's merge
 *  1   2.........12        2 12
 *  2   2..6==9...12        2 6 9 12
 *  3   2..6==9.10====14    2 6 9 10 12 14
 *  4   2......10====14     2 10 12 14
 *  5          10====14     10 14
 *
 * Y sort: two edges of each rectangle are not horizontal: 6.
 *
 * X merge: each edge of the bucket, last in first out, so the right one first,
 * is compared with those of the list from the right:
 *   row 1: 12 with none; 2 with 12                                  1
 *   row 2: 9 with 12, 2; 6 with 12, 9, 2                            5
 *   row 3: 14 with 12; 10 with 14, 12, 9                            4
 * That is 10.
 *
 * X sort: every edge but the first is compared with the one before it:
 * 1 + 3 + 5 + 3 + 1 = 13. No two are out of order: 0 interchanges. */
static const struct hand_count of_deck[] = {{"Y sort", 6},
                                            {"X merge", 10},
                                            {"X sort", 13},
                                            {"X interchanges", 0},
                                            {NULL}};

/* --- Edges that cross ----------------------------------------------------- */

/* A, upright, and B, two columns further to the right on each row:
 *  row       1     2     3     4
 *  A        4-8   4-8   4-8   4-8
 *  B        2-4   4-6   6-8   8-10 */
static const struct pixel_face slant[] = {
    PIXEL_RECTANGLE(4, 1, 8, 5, 8),
    {4, {{1, 1, 4}, {3, 1, 4}, {11, 5, 4}, {9, 5, 4}}}};

/* Y sort: 4. All edges enter on row 1.
 *
 * X merge: the bucket, last in first out, is B right 4, B left 2, A right 8,
 * A left 4. B left with B right: 1. A right with B right: 1. A left with A
 * right, then with B right, which is at the same column and stays: 2. That is
 * 4.
 *
 * X sort: comparisons, and interchanges:
 *   row 1: Bl 2, Br 4, Al 4, Ar 8: in order                   3
 *   row 2: Bl 4, Br 6, Al 4, Ar 8: Al passes Br, not Bl       4, 1
 *   row 3: Bl 6, Al 4, Br 8, Ar 8: Al passes Bl               3, 1
 *   row 4: Al 4, Bl 8, Br 10, Ar 8: Ar passes Br, not Bl      4, 1 */
static const struct hand_count of_slant[] = {
    {"Y sort", 4},         {"X merge", 4},
    {"X sort", 14},        {"X sort", 3, "to the left"},
    {"X interchanges", 3}, {NULL}};

/* --- Many edges ----------------------------------------------------------- */

/* Two combs of K teeth in row 1: tooth k of the first is column 4 k, of the
 * second column 4 k + 2. The first one's faces come last. */
enum { K = 150, COMB_M = 4 * K };

static void make_combs(struct pixel_face comb[2 * K]) {
  for (int k = 0; k < K; k++) {
    comb[k] = (struct pixel_face)PIXEL_RECTANGLE(4 * k + 2, 1, 4 * k + 3, 2, 4);
    comb[K + k] = (struct pixel_face)PIXEL_RECTANGLE(4 * k, 1, 4 * k + 1, 2, 4);
  }
}

/* Y sort: 4 K.
 *
 * X merge: last in first out, the first comb is taken from the right to the
 * left. Each of its edges is compared with all before it: K (2 K - 1). The
 * second comb, too, is taken from the right. Where t of its teeth are there, 2 t
 * edges of each comb are to the right. The next right edge is compared with
 * these and with the one to its left, 4 t + 1; the left edge with one more. That
 * is 8 t + 3 for a tooth, in all 4 K (K - 1) + 3 K.
 *
 * X sort: on one row, 4 K - 1. No two are out of order. */
static const struct hand_count of_combs[] = {
    {"Y sort", 4 * K},
    {"X merge", K *(2 * K - 1) + 4 * K *(K - 1) + 3 * K},
    {"X sort", 4 * K - 1},
    {"X interchanges", 0},
    {NULL}};

int main(void) {
  static const char *const names[] = {"watkins", "bouknight", "yzx"};
  struct pixel_face combs[2 * K];
  struct tap tap = plan(9);
  struct hand_picture p, q, r;
  make_combs(combs);
  pixel_open(&p, deck, 3, M, N);
  pixel_open(&q, slant, 2, M, N);
  pixel_open(&r, combs, 2 * K, COMB_M, COMB_M);
  for (int k = 0; k < 3; k++) {
    ok(&tap, hand_compare(&p, names[k], of_deck, false),
       "%s: edges that enter between others", names[k]);
    ok(&tap, hand_compare(&q, names[k], of_slant, false),
       "%s: edges that cross", names[k]);
    ok(&tap, hand_compare(&r, names[k], of_combs, false), "%s: many edges",
       names[k]);
  }
  hand_close(&p);
  hand_close(&q);
  hand_close(&r);
  return finish(&tap);
}
