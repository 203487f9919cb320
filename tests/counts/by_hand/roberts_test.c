/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Roberts' counts, derived by hand from Sutherland et al. 1974, "L. G. Roberts
 * (1963)". */
#include "tests/counts/by_hand/lines.h"

/* Back-edge cull: 8 edges, each a side of one face. Clipping cull: all 8 are in
 * the picture.
 * Bodies apart: F and N are open, so each is a volume without thickness.
 * Collection pairs: F with F and N; N with F, which is farther, and with N.
 * Minimax tests of edges with the bodies that are left, which are a volume each:
 *   F's edges with F                   4    they lie in its front plane: own
 *   F upper and lower with N           2
 *   F left and right with N            2    out of the way: rejected
 *   N's edges with N                   4    own
 * Edge/volume tests: F upper and lower with N. Each leaves two pieces.
 * Fragments: 8 edges, and 2 pieces that wait.
 * Conditions: each test has the 4 edges of N and its plane; something is left
 *   after each of these.
 * Intervals: F upper and lower 3 each, the 6 others 1 each. */
static const struct hand_count of_bar[] = {
    {"back-edge cull", 8},
    {"back-edge cull", 8, "may be seen"},
    {"clipping cull", 8},
    {"clipping cull", 8, "inside"},
    {"collection pairs", 4},
    {"collection pairs", 1, "body out of the way"},
    {"minimax", 12},
    {"minimax", 4 + 2 + 4, "body in the way"},
    {"minimax", 2, "body out of the way"},
    {"collections rejected", 2},
    {"own volumes", 8},
    {"edge/volume test", 2},
    {"edge/volume test", 2, "two pieces left"},
    {"two pieces left", 2},
    {"fragments", 10},
    {"conditions", 10},
    {"conditions", 8, "contour: a part may be hidden"},
    {"conditions", 2, "plane: a part may be hidden"},
    {"bodies apart", 2},
    {"intervals drawn", 12},
    {NULL}};

/* As above, except that F left is also tested with N's volume; F right is not.
 * F upper and lower leave one piece each, F left is wholly hidden. */
static const struct hand_count of_corner[] = {
    {"back-edge cull", 8},       {"clipping cull", 8},
    {"collection pairs", 4},     {"minimax", 4 + 4 + 4},
    {"collections rejected", 1}, {"own volumes", 8},
    {"edge/volume test", 3},     {"hidden whole", 1},
    {"one piece left", 2},       {"fragments", 8},
    {"conditions", 15},          {"bodies apart", 2},
    {"intervals drawn", 10},     {NULL}};

/* A triangle, near, whose box overlaps the lower left corner of F: the corner
 * is above its long side. */
static const struct hand_object beside[] = {
    HAND_RECTANGLE(4, 1, 10, 4, 8),
    {3, 1, {{1, 3, 4}, {5, 7, 4}, {1, 7, 4}}, {{3, {0, 1, 2}}}}};

/* Minimax: F's edges with F 4 and with the triangle 4, of which upper and right
 *   are rejected; the triangle's edges with itself 3. F is farther than it: a
 *   collection pair rejects it.
 * Edge/volume tests: F left and lower: untouched.
 * Conditions: the first edge of a face is the one that ends at its first
 *   vertex. So the edge x = 1 comes first, which leaves all; then the long
 *   side, which leaves nothing. */
static const struct hand_count of_beside[] = {
    {"back-edge cull", 7},
    {"clipping cull", 7},
    {"collection pairs", 4},
    {"minimax", 4 + 4 + 3},
    {"collections rejected", 2},
    {"own volumes", 7},
    {"edge/volume test", 2},
    {"untouched", 2},
    {"fragments", 7},
    {"conditions", 4},
    {"conditions", 2, "contour: no part hidden"},
    {"conditions", 2, "contour: a part may be hidden"},
    {"bodies apart", 2},
    {"intervals drawn", 7},
    {NULL}};

/* One convex solid, 12 edges, each a side of two faces.
 * Minimax: 1 for each edge. The front is the only front plane, and its 4 edges
 *   lie in it. The 8 others are wholly hidden, after the 4 conditions of the
 *   contour, which is the front's rim, and the condition of the front plane. */
static const struct hand_count of_box[] = {{"back-edge cull", 24},
                                           {"clipping cull", 12},
                                           {"collection pairs", 1},
                                           {"minimax", 12},
                                           {"own volumes", 4},
                                           {"edge/volume test", 8},
                                           {"hidden whole", 8},
                                           {"fragments", 12},
                                           {"conditions", 40},
                                           {"intervals drawn", 12},
                                           {NULL}};

int main(void) {
  struct tap tap = plan(4);
  ok(&tap, hand_check("roberts", bar, 2, of_bar), "a bar before a rectangle");
  ok(&tap, hand_check("roberts", corner, 2, of_corner),
     "a rectangle before a corner");
  ok(&tap, hand_check("roberts", beside, 2, of_beside),
     "a triangle beside a corner");
  ok(&tap, hand_check("roberts", box, 1, of_box), "a box");
  return finish(&tap);
}
