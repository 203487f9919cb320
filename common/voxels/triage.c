/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/voxels/triage.h"

#include <stdlib.h>

const struct hsr_triage_pair hsr_triage_pairs[16] = {
    {-1, 0, 0}, {2, 0, 3}, {0, 0, 1}, {4, 1, 3}, {3, 1, 2},  {-1, 0, 0},
    {1, 0, 2},  {5, 2, 3}, {5, 2, 3}, {1, 0, 2}, {-1, 0, 0}, {3, 1, 2},
    {4, 1, 3},  {0, 0, 1}, {2, 0, 3}, {-1, 0, 0}};

/* The sides of each pair. */
static const int SIDES[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

struct point {
  double x, y;
};

/* The point of side k at t, from 0 at corner k to 1 at the next. */
static struct point on_side(int k, double t) {
  switch (k) {
  case 0:
    return (struct point){t, 0};
  case 1:
    return (struct point){1, t};
  case 2:
    return (struct point){1 - t, 1};
  default:
    return (struct point){0, 1 - t};
  }
}

/* Twice the area to the left of the way from p to q, of x. */
static double turn(struct point p, struct point q, struct point x) {
  return (q.x - p.x) * (x.y - p.y) - (q.y - p.y) * (x.x - p.x);
}

/* The part of one side that lines go through, a little widened. */
struct interval {
  struct point end[2];
};

static struct interval interval_of(int side, int i, int intervals) {
  struct interval all = {
      {on_side(side, (double)i / intervals - HSR_TRIAGE_SLACK),
       on_side(side, (double)(i + 1) / intervals + HSR_TRIAGE_SLACK)}};
  return all;
}

/* On which side of all lines through both intervals are the corners of the
 * cells: +1 to the left of the way from the first to the second, -1 to the
 * right, 0 on neither. For a point x the turn is linear in the place on each of
 * the intervals, so that its extremes are at their ends. */
static void find_sides(const struct interval *first,
                       const struct interval *second, int side[9][9]) {
  for (int row = 0; row < 9; row++)
    for (int column = 0; column < 9; column++) {
      struct point corner = {column / 8.0, row / 8.0};
      int left = 0, right = 0;
      for (int k = 0; k < 4; k++) {
        double at = turn(first->end[k & 1], second->end[k >> 1], corner);
        left += at > 0;
        right += at < 0;
      }
      side[row][column] = left == 4 ? 1 : right == 4 ? -1 : 0;
    }
}

/* And a cell, whose extremes are at its corners. */
static int side_of_cell(int side[9][9], int row, int column) {
  int sum = side[row][column] + side[row][column + 1] + side[row + 1][column] +
            side[row + 1][column + 1];
  return sum == 4 ? 1 : sum == -4 ? -1 : 0;
}

/* The side of corner 0, which no line of the pair goes through but at ends. */
static int side_of_corner_0(int pair) {
  struct point corner = {0, 0};
  return turn(on_side(SIDES[pair][0], 0.5), on_side(SIDES[pair][1], 0.5),
              corner) > 0
             ? 1
             : -1;
}

static struct hsr_triage find_mask(int intervals, int pair, int i, int j) {
  struct interval first = interval_of(SIDES[pair][0], i, intervals);
  struct interval second = interval_of(SIDES[pair][1], j, intervals);
  int inside = side_of_corner_0(pair);
  struct hsr_triage mask = {0, 0};
  int sides[9][9];
  find_sides(&first, &second, sides);
  for (int bit = 0; bit < 64; bit++) {
    int side = side_of_cell(sides, bit / 8, bit % 8);
    if (side == inside)
      mask.c |= (uint64_t)1 << bit;
    else if (side == -inside)
      mask.v |= (uint64_t)1 << bit;
  }
  return mask;
}

enum hsr_status hsr_triage_init(struct hsr_triage_tables *tables, int intervals,
                                struct hsr_error *err) {
  size_t k = (size_t)intervals;
  tables->intervals = intervals;
  tables->mask = malloc(6 * k * k * sizeof *tables->mask);
  if (!tables->mask)
    return hsr_fail_nomem(err);
  struct hsr_triage *mask = tables->mask;
  for (int pair = 0; pair < 6; pair++)
    for (int i = 0; i < intervals; i++)
      for (int j = 0; j < intervals; j++)
        *mask++ = find_mask(intervals, pair, i, j);
  return HSR_OK;
}

void hsr_triage_free(struct hsr_triage_tables *tables) {
  free(tables->mask);
  tables->mask = NULL;
}

void hsr_sample_masks(int intervals, const double x[64], const double y[64],
                      uint64_t *mask) {
  for (int pair = 0; pair < 6; pair++)
    for (int i = 0; i < intervals; i++)
      for (int j = 0; j < intervals; j++) {
        struct point p = on_side(SIDES[pair][0], (i + 0.5) / intervals);
        struct point q = on_side(SIDES[pair][1], (j + 0.5) / intervals);
        int inside = side_of_corner_0(pair);
        *mask = 0;
        for (int bit = 0; bit < 64; bit++) {
          struct point sample = {x[bit], y[bit]};
          if (turn(p, q, sample) * inside > 0)
            *mask |= (uint64_t)1 << bit;
        }
        mask++;
      }
}
