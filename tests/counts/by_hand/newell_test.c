/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Newell's counts, derived by hand from Sutherland et al. 1974, "List-Priority
 * Algorithms". Each scene has two faces, and another of the six tests decides
 * it.
 *
 * For all scenes: the Z sort puts each face into a bucket twice, once for each
 * of two digits. A span is written for each bead of a row, and for each gap
 * between beads and beside them. */
#include "tests/counts/by_hand/objects.h"

/* F at depth 8, columns 2-10, rows 2-5; N at depth 4, columns 4-6, rows 1-6. If
 * P = F, N is wholly in front of it, and ends {Q}. If P = N, no face is left.
 * Segments: 4 and 6. X merge: N lies within F's bead, so no bead is passed or
 * covered. Spans: row 0: 1; rows 1 and 6: 3; rows 2 to 5: gap, F, N, F, gap;
 * row 7: 1. */
static const struct hand_object ahead[] = {HAND_RECTANGLE(2, 2, 10, 6, 8),
                                           HAND_RECTANGLE(4, 1, 6, 7, 4)};
static const struct hand_count of_ahead[] = {
    {"Z sort", 4},
    {"Z sort", 2, "put into a bucket by the high digit"},
    {"Newell special", 1},
    {"Newell special", 1, "end of {Q}"},
    {"segments", 10},
    {"spans written", 28},
    {NULL}};

/* A, from depth 16 to 4, on columns 1-5, rows 1-3; B, from 15 to 4, on columns
 * 5-9, rows 1-3. They overlap in Z: test 2 finds them apart in X.
 * X merge: B passes A's bead, which ends where B begins, on 3 rows. Spans: gap,
 * A, B, gap on 3 rows, 1 on 5. */
static const struct hand_object apart_in_x[] = {HAND_SLANT(1, 1, 5, 4, 16, 4),
                                                HAND_SLANT(5, 1, 9, 4, 15, 4)};
static const struct hand_count of_apart_in_x[] = {
    {"Z sort", 4},
    {"Newell special", 1},
    {"Newell special", 1, "test 2: apart in X"},
    {"minimax tests", 1},
    {"minimax tests", 1, "test 2: apart in X"},
    {"segments", 6},
    {"X merge", 3},
    {"X merge", 3, "passed"},
    {"spans written", 17},
    {NULL}};

/* C is below A, on rows 5 and 6: test 3. Spans: 3 on 5 rows, 1 on 3. */
static const struct hand_object apart_in_y[] = {HAND_SLANT(1, 1, 5, 4, 16, 4),
                                                HAND_SLANT(1, 5, 5, 7, 14, 4)};
static const struct hand_count of_apart_in_y[] = {
    {"Z sort", 4},
    {"Newell special", 1},
    {"Newell special", 1, "test 3: apart in Y"},
    {"minimax tests", 2},
    {"minimax tests", 1, "test 2: overlap in X"},
    {"minimax tests", 1, "test 3: apart in Y"},
    {"segments", 5},
    {"spans written", 18},
    {NULL}};

/* E is where A is, at half its depth everywhere: A is beyond E's plane, test 4.
 * X merge: E covers A's beads on 3 rows. Spans: 3 on 3 rows, 1 on 5. */
static const struct hand_object beyond[] = {HAND_SLANT(1, 1, 5, 4, 16, 4),
                                            HAND_SLANT(1, 1, 5, 4, 8, 2)};
static const struct hand_count of_beyond[] = {
    {"Z sort", 4},
    {"Newell special", 1},
    {"Newell special", 1, "test 4: P beyond Q's plane"},
    {"minimax tests", 2},
    {"minimax tests", 1, "test 3: overlap in Y"},
    {"plane tests", 1},
    {"plane tests", 1, "test 4: P beyond Q's plane"},
    {"segments", 6},
    {"X merge", 3},
    {"X merge", 3, "covered"},
    {"spans written", 14},
    {NULL}};

/* D at depth 4.5 on columns 2-4 of row 2. A's right edge, at depth 4, is in
 * front of D's plane, so test 4 fails. But up to x = 4 A is at depth 64 / 13 or
 * more: D is in front of A's plane, test 5.
 * Spans: 3 on rows 1 and 3; gap, A, D, A, gap on row 2; 1 on 5 rows. */
static const struct hand_object before[] = {HAND_SLANT(1, 1, 5, 4, 16, 4),
                                            HAND_RECTANGLE(2, 2, 4, 3, 4.5)};
static const struct hand_count of_before[] = {
    {"Z sort", 4},
    {"Newell special", 1},
    {"Newell special", 1, "test 5: Q before P's plane"},
    {"minimax tests", 2},
    {"plane tests", 1},
    {"plane tests", 1, "test 5: Q before P's plane"},
    {"segments", 4},
    {"spans written", 16},
    {NULL}};

/* Two triangles side by side: their boxes overlap, and their planes cross near
 * x = 3. So tests 4 and 5 fail; test 6 finds that they do not overlap.
 * Columns, rows 1 to 4:  P 1-4 | P 1-3, Q 4-5 | P 1-2, Q 3-5 | Q 2-5
 * X merge: Q passes P on rows 2 and 3. Spans: 3, 5, 5, 3; 1 on 4 rows. */
static const struct hand_object aside[] = {
    {3, 1, {{1, 1, 16}, {5, 1, 4}, {1, 4, 16}}, {{3, {0, 1, 2}}}},
    {3, 1, {{5, 2, 15}, {5, 5, 15}, {1, 5, 4}}, {{3, {0, 1, 2}}}}};
static const struct hand_count of_aside[] = {
    {"Z sort", 4},
    {"Newell special", 1},
    {"Newell special", 1, "test 6: no overlap"},
    {"minimax tests", 2},
    {"plane tests", 1},
    {"plane tests", 1, "tests 4 and 5: neither"},
    {"overlap tests", 1},
    {"overlap tests", 1, "test 6: an edge is between them"},
    {"segments", 6},
    {"X merge", 2},
    {"spans written", 20},
    {NULL}};

/* Figure 22: P, from depth 16 to 2 on columns 1-5, has the farther vertex. But
 * where they overlap, it is in front of Q, at depth 8 on columns 4-7.
 *   P, Q: all tests fail; Q bears no marker: interchange
 *   Q, P: Q is beyond P's plane: test 4
 * Q is painted, then P. Spans: gap, P, Q, gap on 3 rows; 1 on 5. */
static const struct hand_object in_front[] = {HAND_SLANT(1, 1, 5, 4, 16, 2),
                                              HAND_RECTANGLE(4, 1, 7, 4, 8)};
static const struct hand_count of_in_front[] = {
    {"Z sort", 4},
    {"Newell special", 2},
    {"Newell special", 1, "P may obscure Q"},
    {"Newell special", 1, "test 4: P beyond Q's plane"},
    {"minimax tests", 4},
    {"plane tests", 2},
    {"plane tests", 1, "tests 4 and 5: neither"},
    {"overlap tests", 1},
    {"overlap tests", 1, "test 6: overlap"},
    {"overlap rows", 1},
    {"overlap rows", 1, "meet"},
    {"interchanges", 1},
    {"segments", 6},
    {"spans written", 17},
    {NULL}};

/* P, from depth 16 to 4, and Q, from 4 to 15, in one place, columns 1-5 and
 * rows 1-3. They penetrate at x = 3.02. These are the steps; Z, X and Y overlap
 * unless the step says otherwise:
 *   P, Q     may obscure; Q bears no marker: interchange
 *   Q, P     may obscure; P bears none: interchange
 *   P, Q     may obscure; Q bears one: does P's plane pass through Q? It does,
 *            so Q is divided. P's vertices run clockwise, so the eye is behind
 *            its plane: the first half is the nearer one, columns 1-3. It is
 *            put behind P, which bears a marker: P is passed. The second half,
 *            n, on columns 3-5, is at 15 at most and is put before the first
 *            half: P is passed.
 *   P, n     may obscure: interchange. The new attempt is one of n.
 *   n, P     n is beyond P's plane, by its cut: test 4
 *   n, first half: the box of a divided piece may be a sample wider than the
 *            piece, since its outline is approximate: no test before 4 decides.
 *            Pieces of one plane do not obscure one another: test 4. n is
 *            painted.
 *   P, first half: the half is in front of P's plane, by its cut: test 5. P is
 *            painted, and then the first half.
 * Overlap rows: where no edge tells, the first row that both have is enough to
 *            see that they meet: one row for each of the 4 overlap tests.
 * Segments: 3 each. X merge: P covers n's bead on 3 rows. Spans: gap, first
 * half, P, gap on 3 rows; 1 on 5. */
static const struct hand_object penetrate[] = {HAND_SLANT(1, 1, 5, 4, 16, 4),
                                               HAND_SLANT(1, 1, 5, 4, 4, 15)};
static const struct hand_count of_penetrate[] = {
    {"Z sort", 4},
    {"Newell special", 7},
    {"Newell special", 4, "P may obscure Q"},
    {"Newell special", 2, "test 4: P beyond Q's plane"},
    {"Newell special", 1, "test 5: Q before P's plane"},
    {"minimax tests", 7 * 2},
    {"plane tests", 7},
    {"plane tests", 4, "tests 4 and 5: neither"},
    {"overlap tests", 4},
    {"overlap tests", 4, "test 6: overlap"},
    {"overlap rows", 4},
    {"overlap rows", 4, "meet"},
    {"interchanges", 3},
    {"divisions", 1},
    {"insertions", 2},
    {"circle search", 1},
    {"circle search", 1, "passes through"},
    {"segments", 9},
    {"X merge", 3},
    {"spans written", 17},
    {NULL}};

int main(void) {
  static const struct {
    const char *what;
    const struct hand_object *objects;
    const struct hand_count *derived;
  } checks[] = {{"a face wholly before another", ahead, of_ahead},
                {"test 2", apart_in_x, of_apart_in_x},
                {"test 3", apart_in_y, of_apart_in_y},
                {"test 4", beyond, of_beyond},
                {"test 5", before, of_before},
                {"test 6", aside, of_aside},
                {"an interchange", in_front, of_in_front},
                {"a division", penetrate, of_penetrate}};
  enum { N = sizeof checks / sizeof *checks };
  struct tap tap = plan(N);
  for (int k = 0; k < N; k++)
    ok(&tap, hand_check("newell", checks[k].objects, 2, checks[k].derived),
       "%s", checks[k].what);
  return finish(&tap);
}
