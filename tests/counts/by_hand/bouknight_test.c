/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bouknight's counts, derived by hand from Sutherland et al. 1974, "Scan-line
 * Algorithms". The Y sort, X merge and X sort are derived in scan_line_test.c
 * and watkins_test.c, for the same scenes. */
#include "tests/counts/by_hand/pixels.h"

enum { M = 16, N = 8 };

/* A is far, B and C are near. Rows 1 to 5, columns:
 *  1   A 2-12
 *  2   A 2-12, B 6-9
 *  3   A 2-12, B 6-9, C 10-14
 *  4   A 2-12,        C 10-14
 *  5                  C 10-14 */
static const struct pixel_face deck[] = {PIXEL_RECTANGLE(2, 1, 12, 5, 8),
                                         PIXEL_RECTANGLE(6, 2, 9, 4, 4),
                                         PIXEL_RECTANGLE(10, 3, 14, 6, 4)};

/* Span cull: each edge on the list of a row changes a bit: 2 + 4 + 6 + 4 + 2.
 * Spans lie between the edges, and to both sides of them, so each row has one
 * more than edges: 3 + 5 + 7 + 5 + 3; and rows 0, 6 and 7 have one each.
 * Depth search: in a span with two faces, one comparison at each of its limits:
 *   row 2: 6-9                    2
 *   row 3: 6-9, 10-12             4
 *   row 4: 10-12                  2
 * The same face is nearest at both: no divisions. Of the two comparisons the
 * first finds the near face nearer. The second begins with that face and finds
 * the far one farther. */
static const struct hand_count of_deck[] = {
    {"Y sort", 6},
    {"X merge", 9},
    {"X sort", 13},
    {"X interchanges", 0},
    {"span cull", 18},
    {"span cull", 9, "turned on"},
    {"span cull", 9, "turned off"},
    {"depth search", 8},
    {"depth search", 4, "nearer"},
    {"span divisions", 0},
    {"spans", 26},
    /* No face is transparent. */ {"combined", 0},
    /* No shadows are asked for. */ {"light facings", 0},
    {"shadow tests", 0},
    {"lit", 0},
    {"shadow pairs", 0},
    {"segment tests", 0},
    {NULL}};

/* On row 3 both have the columns 4-12; S comes in front of P at x = 9. */
static const struct pixel_face crossing[] = {
    {4, {{4, 3, 16}, {12, 3, 8}, {12, 4, 8}, {4, 4, 16}}},
    PIXEL_RECTANGLE(4, 3, 12, 4, 128.0 / 13)};

/* Span cull: 4 edges. Depth search:
 *   the limits of 4-12: P is nearest at 4, S at 11           2
 *   the crossing of P and S is computed as column 9:
 *     9 is after it, 8 before it                             2
 *   the part 4-9: is P still nearest at 8?                   1
 *   the part 9-12: is S nearest at 9?                        1
 * S is nearer than P at 11, and P is nearer than S at 8.
 * One division. Spans: 0-4, 4-9, 9-12, 12-16, and one on each other row. */
static const struct hand_count of_crossing[] = {
    {"Y sort", 4},
    {"X merge", 5},
    {"X sort", 3},
    {"X interchanges", 0},
    {"span cull", 4},
    {"depth search", 6},
    {"depth search", 2, "nearer"},
    {"span divisions", 1},
    {"spans", 4 + 7},
    /* No face is transparent. */ {"combined", 0},
    /* No shadows are asked for. */ {"light facings", 0},
    {"shadow tests", 0},
    {"lit", 0},
    {"shadow pairs", 0},
    {"segment tests", 0},
    {NULL}};

int main(void) {
  struct tap tap = plan(2);
  struct hand_picture p;
  pixel_open(&p, deck, 3, M, N);
  ok(&tap, hand_compare(&p, "bouknight", of_deck, true),
     "faces before one another");
  hand_close(&p);
  pixel_open(&p, crossing, 2, M, N);
  ok(&tap, hand_compare(&p, "bouknight", of_crossing, true),
     "faces that penetrate");
  hand_close(&p);
  return finish(&tap);
}
