/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Schumacker's counts, derived by hand from Sutherland et al. 1974, "List-
 * Priority Algorithms". */
#include "tests/counts/by_hand/objects.h"

/* F at depth 8, columns 2-10, rows 2-5, and G at depth 9, columns 12-15, rows
 * 2-5, are one object; N at depth 4, columns 4-6, rows 1-6, is another. */
static const struct hand_object deck[] = {
    {8,
     2,
     {{2, 2, 8},
      {10, 2, 8},
      {10, 6, 8},
      {2, 6, 8},
      {12, 2, 9},
      {15, 2, 9},
      {15, 6, 9},
      {12, 6, 9}},
     {{4, {0, 1, 2, 3}}, {4, {4, 5, 6, 7}}}},
    HAND_RECTANGLE(4, 1, 6, 7, 4)};

/* Clusters: one for each object; between them a plane z = constant. Intra-
 *   cluster priority: one pair, F and G. Inter-cluster priority: one plane; the
 *   eye, at z = 0, is in front of it.
 * Back-face cull: 3 faces, each as seen from both sides: 3 are front faces.
 * Y cull: 12 edges on 8 scan lines. F's and G's upright edges meet 4 scan lines
 *   each, N's meet 6.
 * Counter pairs: F 4, G 4, N 6.
 * Priority search: 14 pairs on 16 raster elements. F is there on 8 x 4 of them,
 *   G on 3 x 4, N on 2 x 6; N has priority over F on 2 x 4.
 * Shown: all that have the highest priority. */
static const struct hand_count of_deck[] = {
    {"intra-cluster priority", 1},
    {"inter-cluster priority", 1},
    {"inter-cluster priority", 1, "in front"},
    {"back-face cull", 6},
    {"back-face cull", 3, "front"},
    {"Y cull", 12 * 8},
    {"Y cull", 4 * 4 + 2 * 6, "meets it"},
    {"counter pairs", 14},
    {"priority search", 14 * 16},
    {"priority search", 8, "there"},
    {"priority search", 32 + 12 + 12 - 8, "there, with the highest priority"},
    {"samples shown", 48},
    {NULL}};

/* A triangle. On each of the rows 1 to 3 it has two intercepts:
 *   left edge from (8, 1) to (2, 4): x = 8 - 2 (y - 1) = 7, 5, 3
 *   right edge from (8, 1) to (14, 4): x = 9, 11, 13
 * at y = 1.5, 2.5, 3.5: columns 7-9, 5-11, 3-13. The third edge is level. */
static const struct hand_object triangle[] = {
    {3, 1, {{8, 1, 4}, {14, 4, 4}, {2, 4, 4}}, {{3, {0, 1, 2}}}}};
static const struct hand_count of_triangle[] = {
    {"back-face cull", 2},
    {"back-face cull", 1, "front"},
    {"Y cull", 3 * 8},
    {"Y cull", 2 * 3, "meets it"},
    {"counter pairs", 3},
    {"priority search", 3 * 16},
    {"priority search", 0, "there"},
    {"priority search", 2 + 6 + 10, "there, with the highest priority"},
    {"samples shown", 18},
    {NULL}};

int main(void) {
  struct tap tap = plan(2);
  ok(&tap, hand_check("schumacker", deck, 2, of_deck), "two clusters");
  ok(&tap, hand_check("schumacker", triangle, 1, of_triangle), "a triangle");
  return finish(&tap);
}
