/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Appel's counts, derived by hand from Sutherland et al. 1974, "Edge-
 * Intersection Algorithms". */
#include "tests/counts/by_hand/lines.h"

/* Edge cull: 8 edges, each a side of one face.
 * All 8 are contour edges, since they have a face on one side only.
 * Searches: F and N share no vertex, so each has one. Initial visibility: 2
 *   faces for each of the 2 vertices (2, 2) and (4, 1), which are not hidden.
 * Faces in line: (2, 2) is in F's box alone, (4, 1) in N's alone.
 * Edge intersection: each of 8 edges with 8 contour edges.
 *   Within a rectangle: an edge shares vertices with itself and its 2
 *   neighbours, and its box is apart from that of the opposite edge:
 *                                      24 share a vertex, 8 apart
 *   F upper and lower, N left and right cross: 4 pairs. N is nearer: F's edges
 *   find nearer contour edges, N's edges farther ones:  4 nearer, 4 farther
 *   the 12 other pairs of F and N are apart, both ways: 24 apart
 * Boxes overlap: the 32 pairs that are not apart.
 * Vorticities: the 8 that cross. Those that share a vertex are not asked.
 * Crossings: the 4 nearer ones.
 * No edge touches another's face; no vertex belongs to two faces: no pierced
 *   faces, no correction, no faces apart.
 * Promoted: from one vertex of a rectangle to the 3 others. None is hidden.
 * Sort along edge: F upper and F lower have two crossings: 1 comparison each.
 * Sorts to save: no edge is hidden from end to end.
 * Intervals: F upper and F lower 3 each, the 6 others 1 each. */
static const struct hand_count of_bar[] = {
    {"edge cull", 8},
    {"edge cull", 8, "may be seen"},
    {"searches", 2},
    {"initial visibility", 4},
    {"initial visibility", 0, "hides"},
    {"faces in line", 2},
    {"boxes overlap", 32},
    {"vorticities", 8},
    {"vorticities", 4, "inside"},
    {"edge intersection", 64},
    {"edge intersection", 32, "boxes apart"},
    {"edge intersection", 24, "share a vertex"},
    {"edge intersection", 0, "do not cross"},
    {"edge intersection", 4, "farther"},
    {"edge intersection", 4, "nearer"},
    {"crossings", 4},
    {"promoted", 6},
    {"sort along edge", 2},
    {"intervals drawn", 3 + 3 + 6},
    {NULL}};

/* As above, with these differences. Only N's right edge crosses F's upper and
 *   lower edges: 2 pairs; the 14 others are apart, both ways.
 * Initial visibility: N hides F's first vertex (2, 2): 1 of 4. It is in the boxes
 *   of both, and N's first vertex (1, 1) in N's alone.
 * Promoted from it: to (10, 2), past the crossing: hidden by 0; to (2, 6):
 *   hidden by 1; from there to (10, 6): hidden by 0. No vertex of N is hidden:
 *   1 in all.
 * No edge has two crossings: no comparison.
 * Sorts to save: F's left edge.
 * Intervals: F upper and F lower 2 each, the 6 others 1 each. */
static const struct hand_count of_corner[] = {
    {"edge cull", 8},
    {"searches", 2},
    {"initial visibility", 4},
    {"initial visibility", 1, "hides"},
    {"faces in line", 2 + 1},
    {"boxes overlap", 28},
    {"vorticities", 4},
    {"vorticities", 2, "inside"},
    {"edge intersection", 64},
    {"edge intersection", 8 + 28, "boxes apart"},
    {"edge intersection", 24, "share a vertex"},
    {"edge intersection", 0, "do not cross"},
    {"edge intersection", 2, "farther"},
    {"edge intersection", 2, "nearer"},
    {"crossings", 2},
    {"promoted", 6},
    {"hiding", 1},
    {"sorts to save", 1},
    {"intervals drawn", 2 + 2 + 6},
    {NULL}};

/* Edge cull: 12 edges, each a side of two faces: 24.
 * Contour edges: the two faces of a front edge, the front and a side face, lie
 *   on the same side of it in the picture. So the 4 front edges are contours.
 *   The two faces of each of the 8 other edges lie on opposite sides.
 * One search, of 6 faces, for vertex 0: each face has a corner there, or does
 *   not cover it. It is in the boxes of those 3 that have a corner there.
 * Edge intersection: 12 edges with 4 contour edges:
 *   4 front edges: 3 share a vertex, 1 apart              12, 4
 *   4 edges from front to back: 2 share, 2 apart           8, 8
 *   4 back edges: all apart                                0, 16
 * Promotion, where the vertex that has waited least is taken first:
 *   from 0 along 0-1, 0-3, 0-4 to 1, 3, 4;
 *   from 4 along 4-5, 4-7 to 5, 7;
 *   from 7 along 3-7, 6-7 to 6; from 6 along 2-6, 5-6 to 2;
 *   from 2 along 1-2, 2-3; from 5 along 1-5: 7 vertices in all.
 * Hiding: 4, 5, 6, 7 are hidden by the front: 1 each. At 1, 2, 3: 0.
 * Correction: at a vertex of three faces, one face is not the edge's own. This
 *   face is tested for each edge at the end from which the edge is followed,
 *   and at its other end if visibility is promoted there: 12 + 7. It hides an
 *   edge that begins there and runs to the back, behind the front: 0-4 at 0,
 *   and 2-6 at 2. It is not tested for 3-7 at 3 and 1-5 at 1, which are known
 *   already.
 * Sorts to save: all edges but the front's, 8, are hidden from end to end.
 * Intervals: 1 for each edge. */
static const struct hand_count of_box[] = {
    {"edge cull", 24},
    {"searches", 1},
    {"initial visibility", 6},
    {"initial visibility", 0, "hides"},
    {"faces in line", 3},
    {"boxes overlap", 12 + 8},
    {"edge intersection", 48},
    {"edge intersection", 4 + 8 + 16, "boxes apart"},
    {"edge intersection", 12 + 8, "share a vertex"},
    {"correction", 12 + 7},
    {"correction", 2, "hides"},
    {"promoted", 7},
    {"hiding", 4},
    {"sorts to save", 8},
    {"intervals drawn", 12},
    {NULL}};

int main(void) {
  struct tap tap = plan(4);
  ok(&tap, hand_check("appel", bar, 2, of_bar), "a bar before a rectangle");
  ok(&tap, hand_check("appel", corner, 2, of_corner),
     "a rectangle before a corner");
  ok(&tap, hand_check("appel", box, 1, of_box), "a box");
  ok(&tap, hand_check("appel-visible", box, 1, of_box),
     "a box: an edge that is hidden throughout is one interval either way");
  return finish(&tap);
}
