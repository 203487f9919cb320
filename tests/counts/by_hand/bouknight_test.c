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

int main(void) {
  struct tap tap = plan(2);
  ok(&tap, pixel_check("bouknight", deck, 3, of_deck),
     "faces before one another");
  ok(&tap, pixel_check("bouknight", crossing, 2, of_crossing),
     "faces that penetrate");
  return finish(&tap);
}
