/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Galimberti and Montanari's counts, derived by hand from Sutherland et al.
 * 1974, "Edge-Intersection Algorithms". What is not explained here is derived
 * in appel_test.c. */
#include "tests/counts/by_hand/lines.h"

/* All 8 edges are contour edges: there are as many pairs with them as with all.
 * Nature changes: F upper is followed from (2, 2), its beginning, and passes
 *   its 2 crossings forwards. F lower runs from (10, 6) to (2, 6), and is
 *   followed from (2, 6). It passes its 2 crossings backwards, which gives the
 *   nature of (10, 6), and then forwards as it is drawn. */
static const struct hand_count of_bar[] = {
    {"edge cull", 8},
    {"searches", 2},
    {"initial visibility", 4},
    {"initial visibility", 0, "hides"},
    {"faces in line", 2},
    {"boxes overlap", 32},
    {"edge intersection", 64},
    {"edge intersection", 32, "boxes apart"},
    {"edge intersection", 24, "share a vertex"},
    {"edge intersection", 4, "farther"},
    {"edge intersection", 4, "nearer"},
    {"contour pairs", 64},
    {"crossings", 4},
    {"promoted", 6},
    {"nature changes", 6},
    {"nature changes", 4, "forwards"},
    {"nature changes", 2, "backwards"},
    {"sort along edge", 2},
    {"intervals drawn", 12},
    {NULL}};

/* The nature of (2, 2), which is N, remains that of (2, 6). */
static const struct hand_count of_corner[] = {
    {"edge cull", 8},
    {"searches", 2},
    {"initial visibility", 4},
    {"initial visibility", 1, "hides"},
    {"faces in line", 3},
    {"boxes overlap", 28},
    {"edge intersection", 64},
    {"edge intersection", 36, "boxes apart"},
    {"contour pairs", 64},
    {"crossings", 2},
    {"promoted", 6},
    {"hiding", 1},
    {"nature changes", 3},
    {"nature changes", 2, "forwards"},
    {"nature changes", 1, "backwards"},
    {"intervals drawn", 10},
    {NULL}};

/* Edge intersection: 12 edges with all 12.
 *   front with front, back with back: 12 share a vertex, 4 apart, each
 *   front with back, both ways: 32 apart
 *   from front to back, with one another: 4 share (itself), 12 apart
 *   these with front or back, both ways: 2 of 4 share, 2 are apart: 32, 32
 * Contour pairs: 12 edges with 4.
 * Correction: only at the end from which an edge is followed: 12. The front
 *   hides 0-4 at 0; the other three edges to the back are followed from there.
 * No nature changes along an edge, and no sort can be saved. */
static const struct hand_count of_box[] = {
    {"edge cull", 24},
    {"searches", 1},
    {"initial visibility", 6},
    {"initial visibility", 0, "hides"},
    {"faces in line", 3},
    {"boxes overlap", 12 + 12 + 4 + 32},
    {"edge intersection", 144},
    {"edge intersection", 4 + 4 + 32 + 12 + 32, "boxes apart"},
    {"edge intersection", 12 + 12 + 4 + 32, "share a vertex"},
    {"contour pairs", 48},
    {"correction", 12},
    {"correction", 1, "hides"},
    {"promoted", 7},
    {"hiding", 4},
    {"intervals drawn", 12},
    {NULL}};

int main(void) {
  struct tap tap = plan(3);
  ok(&tap, hand_check("galimberti", bar, 2, of_bar),
     "a bar before a rectangle");
  ok(&tap, hand_check("galimberti", corner, 2, of_corner),
     "a rectangle before a corner");
  ok(&tap, hand_check("galimberti", box, 1, of_box), "a box");
  return finish(&tap);
}
