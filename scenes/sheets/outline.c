/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A sheet is a block, a band that starts at the block, and single squares.
 *
 * Block       k squares, row by row, in ceil(sqrt(k)) columns: 2 ceil(2 sqrt(k))
 *             free sides, the least that there can be
 * Band        each of its squares touches the one before it and the one after it,
 *             and adds two free sides
 * Singles     touch nothing, and add four each */
#include "scenes/sheets/outline.h"

#include <math.h>

/* The least whole number whose square is at least n. */
static uint32_t root_above(uint32_t n) {
  uint32_t root = (uint32_t)sqrt((double)n);
  while ((uint64_t)root * root < n)
    root++;
  while (root && (uint64_t)(root - 1) * (root - 1) >= n)
    root--;
  return root;
}

uint32_t hsr_outline_least(uint32_t n) {
  const uint32_t columns = root_above(n);
  return 2 * (columns + (n + columns - 1) / columns);
}

/* Square k of a band that winds through rows from `row` on: every second row is
 * full, and one square leads from it to the next. */
static void band_square(uint32_t k, uint32_t columns, uint32_t row,
                        uint32_t ij[2]) {
  const uint32_t turn = k / (columns + 1), at = k % (columns + 1);
  const uint32_t along = at < columns ? at : columns - 1;
  ij[0] = turn % 2 ? columns - 1 - along : along;
  ij[1] = row + 2 * turn + (at == columns);
}

void hsr_outline(uint32_t n, uint32_t sides, uint32_t (*ij)[2]) {
  /* As many singles as the band cannot have free sides for. */
  const uint32_t singles = sides > 2 * n + 2 ? (sides - 2 * n - 2) / 2 : 0;
  const uint32_t connected = n - singles;
  sides -= 4 * singles;

  /* The smallest block with which there are not too many free sides. */
  uint32_t block = 1;
  while (block < connected &&
         hsr_outline_least(block) + 2 * (connected - block) > sides)
    block++;

  const uint32_t columns = root_above(block);
  const uint32_t rows = (block + columns - 1) / columns;
  uint32_t k = 0;
  for (; k < block; k++) {
    ij[k][0] = k % columns;
    ij[k][1] = k / columns;
  }

  /* The band's first square leads away from the block's last row. */
  const uint32_t band = connected - block;
  const uint32_t width =
      columns > root_above(2 * band) ? columns : root_above(2 * band);
  uint32_t row = rows;
  for (uint32_t b = 0; b < band; b++, k++) {
    if (b)
      band_square(b - 1, width, rows + 1, ij[k]);
    else
      ij[k][0] = 0, ij[k][1] = rows;
    row = ij[k][1] + 1;
  }

  const uint32_t across = root_above(singles);
  for (uint32_t s = 0; s < singles; s++, k++) {
    ij[k][0] = 2 * (s % across);
    ij[k][1] = row + 1 + 2 * (s / across);
  }
}
