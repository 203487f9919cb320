/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Watkins' counts, derived by hand from Sutherland et al. 1974, "Scan-line
 * Algorithms", and from the module's own rules for sample spans. The Y sort, X
 * merge and X sort of the first scene are derived in scan_line_test.c. */
#include "tests/counts/by_hand/pixels.h"

/* --- Faces before one another --------------------------------------------- */

/* Span cull: when a span begins, each segment under the last span is tested for
 * its right end, and each segment that begins there is tested as it enters.
 * Then the segments not yet under the span are tested until one begins right of
 * it.
 * Depth search: each segment under the span but the first is compared with the
 * visible one, and so is each segment that begins within the span. All depths
 * are constant, so one comparison decides and nothing is divided.
 *
 *   span       shows  culls                                    comparisons
 *   row 1
 *    0-2       -      A begins within                     1
 *    2-12      A      A enters                            1
 *   12-16      -      A ends                              1    3 spans, 3 culls
 *   row 2
 *    0-2       -      A begins within, B is outside       2
 *    2-6       A      A enters, B begins within           2    B A
 *    6-9       B      A stays, B enters                   2    B A
 *    9-12      A      A stays, B ends                     2
 *   12-16      -      A ends                              1    5, 9, 2
 *   row 3
 *    0-2       -      A begins within, B is outside       2
 *    2-6       A      A enters, B begins within, C not    3    B A
 *    6-9       B      A stays, B enters, C is outside     3    B A
 *    9-10      A      A stays, B ends, C begins within    3    C A
 *   10-12      C      A stays, C enters                   2    C A
 *   12-14      C      A ends, C stays                     2
 *   14-16      -      C ends                              1    7, 16, 4
 *   row 4
 *    0-2       -      A begins within, C is outside       2
 *    2-10      A      A enters, C begins within           2    C A
 *   10-12      C      A stays, C enters                   2    C A
 *   12-14      C      A ends, C stays                     2
 *   14-16      -      C ends                              1    5, 9, 2
 *   row 5      as row 1                                        3, 3
 *   rows 0, 6 and 7: one span each                             3
 *
 * A segment that begins within the span, enters or stays, is inside:
 * 2 + 6 + 10 + 6 + 2 = 26 of 40. All comparisons find the later face nearer. */
static const struct hand_count of_deck[] = {{"Y sort", 6},
                                            {"X merge", 10},
                                            {"X sort", 13},
                                            {"span cull", 3 + 9 + 16 + 9 + 3},
                                            {"span cull", 26, "inside"},
                                            {"span cull", 14, "outside"},
                                            {"spans", 3 + 5 + 7 + 5 + 3 + 3},
                                            {"depth search", 2 + 4 + 2},
                                            {"depth search", 8, "nearer"},
                                            {NULL}};

/* --- Faces that penetrate ------------------------------------------------- */

/* Y sort: 4. X merge: the bucket is P right 12, P left 4, S right 12, S left 4.
 * P left with P right: 1. S right with P right: 1. S left with S right, P
 * right, P left: 3. That is 5. The list is P left, S left, P right, S right. X
 * sort: 3.
 *
 * Span cull:
 *    0-4    P begins within, S is outside     2
 *    4-9    both enter                        2
 *    9-12   both stay                         2
 *   12-16   both end                          2
 *
 * Depth search, S against P, in the span that begins at 4. Parts are given by
 * their ends in columns, beginning with 4-11 of both. (The first one is divided
 * if both are of one length.)
 *   samples  S                 P      decided
 *   4-12     4-11: 8.5 .. 15.5 4-11   no: the samples straddle 7.5: divide
 *                                     them at 8
 *   4-8      4-11              4-11   no: halve S
 *            4-7.5: 8.5 .. 12  4-11   farther
 *   8-12     4-11              4-11   no: halve S
 *            7.5-11: 12 .. 15.5 4-11  no: halve P
 *            7.5-11            7.5-11 no: the samples straddle 9.25: divide
 *                                     them at 10
 *   8-10     7.5-11            7.5-11 no: halve S
 *            7.5-9.25: 12 .. 13.75    no: halve P
 *            7.5-9.25        7.5-9.25 no: the samples straddle 8.375: divide
 *                                     them at 9
 *   8-9                               farther, by the exact comparison
 *   9-10                              nearer, by the exact comparison
 * These are 11 comparisons; 8 of them say no, and divide. P is visible up to 9.
 * In the span that begins at 9:
 *   9-12     4-11              4-11   no: halve S
 *            7.5-11            4-11   no: halve P
 *            7.5-11            7.5-11 no: the samples straddle 9.25: divide
 *                                     them at 10
 *   9-10                              nearer, by the exact comparison
 *   10-12    7.5-11            7.5-11 no: halve S
 *            9.25-11: 13.75 .. 15.5   nearer
 * These are 6 comparisons, and 4 divisions. S is visible up to 12.
 *
 * Both pairs are divided. The right part of divided samples is searched at 8 and at 9,
 * and in the second span at 10: 3 second halves. So 17 comparisons less 12 divisions
 * less 3 are 2 pairs. */
static const struct hand_count of_crossing[] = {
    {"Y sort", 4},
    {"X merge", 5},
    {"X sort", 3},
    {"span cull", 8},
    {"spans", 4 + 7},
    {"depth search", 11 + 6},
    {"depth search", 8 + 4, "undecided"},
    {"depth search", 2, "farther"},
    {"depth search", 1 + 2, "nearer"},
    {"depth divisions", 8 + 4},
    {"pairs divided", 1 + 1},
    {"second halves", 2 + 1},
    {NULL}};

/* --- Regions that are carried --------------------------------------------- */

/* columns. X merge and X sort: bouknight_test.c.
 *   row 0   one span: decided. Nothing is in it.
 *   row 1   The span of row 0 was bounded by no edge. The first edge is in its
 *           way: 1 test. All are decided:
 *    0-2    -      A begins within, B is outside         2
 *    2-4    A      A enters, B begins within             2    B A
 *    4-8    B      A stays, B enters                     2    B A
 *    8-12   A      A stays, B ends                       2
 *   12-16   -      A ends                                1
 *           Endings: those of the edges that bound each, 1 + 2 + 2 + 2 + 1.
 *           Forecasts: of A and B in 4-8, along both edges.
 *   rows 2 to 6  5 spans each are carried; each of 4 edges is tested once
 *   row 7   no edge is there: one span, decided */
static const struct hand_count of_columns[] = {
    {"Y sort", 4},
    {"X merge", 5},
    {"X sort", 18},
    {"span cull", 9},
    {"span cull", 6, "inside"},
    {"spans", 6 * 5 + 2},
    {"depth search", 2},
    {"depth search", 2, "nearer"},
    {"order tests", 1 + 5 * 4},
    {"order tests", 5 * 4, "the same edge"},
    {"endings", 8},
    {"endings", 8, "goes on"},
    {"forecasts", 2},
    {"forecasts", 2, "later"},
    {"spans decided", 1 + 5 + 1},
    {"spans carried", 5 * 5},
    {NULL}};

/* --- What was seen above -------------------------------------------------- */

/* hidden-end. X merge: F left with F right: 1; H right with F right and F left:
 * 2; H left with three: 3.
 *   row 1
 *    0-1    -      H begins within, F is outside         2
 *    1-3    H      H enters, F begins within             2    F H
 *    3-6    F      H stays, F enters                     2    F H
 *                  H is searched first, so its end is the span's. Above was the
 *                  background: 1 span passed
 *    6-10   F      H ends, F stays                       2
 *   10-16   -      F ends                                1
 *   row 2
 *    0-1    as above                                     2
 *    1-3    as above                                     2    F H
 *    3-10   F      H stays, F enters                     2    H F
 *                  Above it ended the spans 0-1 and 1-3, and 3-6 was of F: 3
 *                  passed. H is another, F the same: 2 guesses. F is searched
 *                  first, and H is farther
 *   10-16   -      both end                              2
 * On the other 6 rows one span each. */
static const struct hand_count of_hidden_end[] = {
    {"Y sort", 4},
    {"X merge", 6},
    {"X sort", 6},
    {"span cull", 9 + 8},
    {"spans", 5 + 4 + 6},
    {"depth search", 2 + 2},
    {"depth search", 3, "nearer"},
    {"depth search", 1, "farther"},
    {"spans passed", 1 + 3},
    {"spans passed", 2, "above"},
    {"guesses", 2},
    {"guesses", 1, "the same"},
    {NULL}};

int main(void) {
  struct tap tap = plan(4);
  ok(&tap, pixel_check("watkins", deck, 3, of_deck),
     "faces before one another");
  ok(&tap, pixel_check("watkins", crossing, 2, of_crossing),
     "faces that penetrate");
  ok(&tap, pixel_check("watkins:regions=carried", columns, 2, of_columns),
     "regions that are carried");
  ok(&tap, pixel_check("watkins:spans=seen", hidden_end, 2, of_hidden_end),
     "the end of a hidden segment, below what was seen");
  return finish(&tap);
}
