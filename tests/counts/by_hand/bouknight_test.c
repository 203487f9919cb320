/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bouknight's counts, derived by hand from Sutherland et al. 1974, "Scan-line
 * Algorithms". The Y sort, X merge and X sort are derived in scan_line_test.c
 * and watkins_test.c, for the same scenes. */
#include "tests/counts/by_hand/pixels.h"

/* deck. Span cull: each edge on the list of a row changes a bit:
 * 2 + 4 + 6 + 4 + 2. Spans lie between the edges, and to both sides of them, so
 * each row has one more than edges: 3 + 5 + 7 + 5 + 3; and rows 0, 6 and 7 have
 * one each.
 * Depth search: in a span with two faces, one comparison at each of its limits:
 *   row 2: 6-9                    2
 *   row 3: 6-9, 10-12             4
 *   row 4: 10-12                  2
 * The same face is nearest at both: no divisions. Of the two comparisons the
 * first finds the near face nearer. The second begins with that face and finds
 * the far one farther. */
static const struct hand_count of_deck[] = {{"Y sort", 6},
                                            {"X merge", 10},
                                            {"X sort", 13},
                                            {"span cull", 18},
                                            {"span cull", 9, "turned on"},
                                            {"span cull", 9, "turned off"},
                                            {"depth search", 8},
                                            {"depth search", 4, "nearer"},
                                            {"spans", 26},
                                            {NULL}};

/* crossing. Span cull: 4 edges. Depth search:
 *   the limits of 4-12: P is nearest at 4, S at 11           2
 *   the crossing of P and S is computed as column 9:
 *     9 is after it, 8 before it                             2
 *   the part 4-9: is P still nearest at 8?                   1
 *   the part 9-12: is S nearest at 9?                        1
 * S is nearer than P at 11, and P is nearer than S at 8.
 * One division. Spans: 0-4, 4-9, 9-12, 12-16, and one on each other row. */
static const struct hand_count of_crossing[] = {
    {"Y sort", 4},         {"X merge", 5},      {"X sort", 3},
    {"span cull", 4},      {"depth search", 6}, {"depth search", 2, "nearer"},
    {"span divisions", 1}, {"spans", 4 + 7},    {NULL}};

/* --- Regions that are carried --------------------------------------------- */

/* deck. Spans of two faces: the others are not searched, and not carried.
 *   row 2  6-9 A B    decided: 2 comparisons. Its edges, B's, go on: 2 endings.
 *                     2 forecasts, along both.
 *   row 3  6-9 A B    On the row before the list was A left, B left, B right, A
 *                     right. The first three are where they were: 3 tests. It is
 *                     carried.
 *          10-12 A C  C's left edge is new. Decided: 2 comparisons, 2 endings, 2
 *                     forecasts.
 *   row 4  10-12 A C  The list was A left, B left, B right, C left, A right, C
 *                     right, and is A left, C left, A right, C right. A left is
 *                     where it was. C left is not; B left, B right and C left of
 *                     the old list are passed. So the same faces are involved.
 *                     Then comes A right in both: 6 tests, of which 2 say so.
 *                     It is carried. */
static const struct hand_count of_deck_regions[] = {
    {"Y sort", 6},
    {"X merge", 10},
    {"X sort", 13},
    {"span cull", 18},
    {"depth search", 4},
    {"depth search", 2, "nearer"},
    {"spans", 26},
    {"order tests", 3 + 6},
    {"order tests", 3 + 2, "the same edge"},
    {"endings", 4},
    {"endings", 4, "goes on"},
    {"forecasts", 4},
    {"forecasts", 4, "later"},
    {"spans decided", 2},
    {"spans carried", 2},
    {NULL}};

/* columns. X merge: B right, then B left with it: 1; A right with B right: 1; A
 * left with three: 3. X sort: 3 on each of 6 rows. Each of these rows has 4
 * edges and 5 spans. On row 1 the span 4-8 is decided: 2 comparisons, 2 endings,
 * 2 forecasts. On the other 5 rows it is carried, by 3 tests: A left, B left, and
 * B right. */
static const struct hand_count of_columns[] = {
    {"Y sort", 4},
    {"X merge", 5},
    {"X sort", 18},
    {"span cull", 24},
    {"depth search", 2},
    {"depth search", 1, "nearer"},
    {"spans", 32},
    {"order tests", 15},
    {"order tests", 15, "the same edge"},
    {"endings", 2},
    {"forecasts", 2},
    {"forecasts", 2, "later"},
    {"spans decided", 1},
    {"spans carried", 5},
    {NULL}};

/* --- Implied edges that are carried --------------------------------------- */

/* ridge. Rows 1 and 2 are as in `crossing`; the point is calculated on each. On
 * rows 3 to 6 it is extrapolated, to x = 9, and so to column 9. P is compared
 * with S at 8, and S with P at 9; the other one is farther. No further faces are
 * there. X merge and X sort: as in `crossing`, the latter on 6 rows. */
static const struct hand_count of_ridge[] = {{"Y sort", 4},
                                             {"X merge", 5},
                                             {"X sort", 18},
                                             {"span cull", 24},
                                             {"depth search", 6 + 6 + 4 * 2},
                                             {"depth search", 2 + 2, "nearer"},
                                             {"span divisions", 6},
                                             {"spans", 6 * 4 + 2},
                                             {"penetrations", 2},
                                             {"extrapolations", 4},
                                             {"extrapolations", 4, "inside"},
                                             {"verifications", 4},
                                             {NULL}};

/* --- A list by depth ------------------------------------------------------ */

/* deck. B enters, at 6 of rows 2 and 3, in front of A: one comparison says so,
 * and another, at 8, that it stays there. Likewise C, at 10 and 11 of rows 3 and
 * 4. When one of two leaves no pair is left. No face moves. */
static const struct hand_count of_deck_list[] = {{"Y sort", 6},
                                                 {"X merge", 10},
                                                 {"X sort", 13},
                                                 {"span cull", 18},
                                                 {"span cull", 9, "turned on"},
                                                 {"depth search", 8},
                                                 {"depth search", 8, "nearer"},
                                                 {"spans", 26},
                                                 {NULL}};

/* crossing. S enters at the front, where a face that is new does. At 4 it is
 * farther than P, and they change places. At 11 P is farther. So they are to
 * change places once more, and this is searched at 9 and at 8, where P is
 * nearer. */
static const struct hand_count of_crossing_list[] = {
    {"Y sort", 4},         {"X merge", 5},
    {"X sort", 3},         {"span cull", 4},
    {"depth search", 4},   {"depth search", 1, "nearer"},
    {"span divisions", 1}, {"spans", 4 + 7},
    {"moves", 2},          {NULL}};

int main(void) {
  struct tap tap = plan(7);
  ok(&tap, pixel_check("bouknight", deck, 3, of_deck),
     "faces before one another");
  ok(&tap, pixel_check("bouknight", crossing, 2, of_crossing),
     "faces that penetrate");
  ok(&tap, pixel_check("bouknight:regions=carried", deck, 3, of_deck_regions),
     "regions that are carried, as faces begin and end");
  ok(&tap, pixel_check("bouknight:regions=carried", columns, 2, of_columns),
     "a region that is carried to five rows");
  ok(&tap, pixel_check("bouknight:implied=carried", ridge, 2, of_ridge),
     "an implied edge that is carried");
  ok(&tap, pixel_check("bouknight:depth=list", deck, 3, of_deck_list),
     "a list by depth of faces before one another");
  ok(&tap, pixel_check("bouknight:depth=list", crossing, 2, of_crossing_list),
     "a list by depth of faces that penetrate");
  return finish(&tap);
}
