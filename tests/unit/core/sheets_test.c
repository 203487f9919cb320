/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sheets: outlines have the squares and the free sides that are asked for; pairs
 * that penetrate are counted as the exact count has them. */
#include "common/scene/world.h"
#include "common/statistics/statistics.h"
#include "scenes/sheets/outline.h"
#include "scenes/sheets/sheets.h"
#include "tests/tap.h"

#include <stdlib.h>
#include <string.h>

enum { MOST = 60, SIDE = 4 * MOST };

/* Whether the squares are different ones, and how many sides are free. */
static bool count_sides(const uint32_t (*ij)[2], uint32_t n, uint32_t *sides) {
  static bool is_square[SIDE + 2][SIDE + 2];
  memset(is_square, 0, sizeof is_square);
  for (uint32_t k = 0; k < n; k++) {
    bool *square = &is_square[ij[k][1] + 1][ij[k][0] + 1];
    if (*square)
      return false;
    *square = true;
  }
  *sides = 0;
  for (uint32_t k = 0; k < n; k++) {
    const uint32_t j = ij[k][1] + 1, i = ij[k][0] + 1;
    const int here = !is_square[j - 1][i] + !is_square[j + 1][i] +
                     !is_square[j][i - 1] + !is_square[j][i + 1];
    *sides += (uint32_t)here;
  }
  return true;
}

static void test_outlines(struct tap *tap) {
  int asked = 0, right = 0;
  for (uint32_t n = 1; n <= MOST; n++)
    for (uint32_t sides = hsr_outline_least(n); sides <= 4 * n; sides += 2) {
      uint32_t ij[MOST][2], found;
      hsr_outline(n, sides, ij);
      asked++;
      right +=
          count_sides((const uint32_t(*)[2])ij, n, &found) && found == sides;
    }
  ok(tap, asked > 1000 && right == asked,
     "%d of %d outlines have the squares and sides asked for", right, asked);
}

/* The number of pairs that penetrate by doubles, and exactly. */
static bool counts_agree(const struct hsr_sheets *sheets, uint64_t *crossings) {
  struct hsr_scene *scene = hsr_scene_new("sheets");
  struct hsr_world world;
  struct hsr_error err;
  uint64_t exact = 0;
  bool agree = scene && !hsr_sheets_build(scene, sheets, crossings, &err) &&
               !hsr_scene_finish(scene, &err);
  if (agree && (agree = !hsr_world_init(&world, scene, &err))) {
    uint32_t *all = malloc(world.n_faces * sizeof *all);
    for (uint32_t f = 0; all && f < world.n_faces; f++)
      all[f] = f;
    agree = all && world.n_faces == sheets->n_faces &&
            !hsr_count_penetrations(&world, all, world.n_faces, &exact, &err) &&
            exact == *crossings;
    free(all);
    hsr_world_free(&world);
  }
  hsr_scene_delete(scene);
  return agree;
}

static void test_crossings(struct tap *tap) {
  int agree = 0, hit = 0;
  enum { SCENES = 60 };
  for (uint64_t k = 0; k < SCENES; k++) {
    struct hsr_sheets sheets = {.n_faces = 200,
                                .n_clusters = 20 + (uint32_t)k,
                                .n_contour = 400,
                                .n_crossings = 10 * (k % 8),
                                .width = 1,
                                .side = 0.08,
                                .stretch = 1 + 0.1 * (double)k,
                                .depth = 0.5,
                                .seed = k};
    uint64_t crossings;
    agree += counts_agree(&sheets, &crossings);
    hit += crossings == sheets.n_crossings;
  }
  ok(tap, agree == SCENES,
     "in %d of %d rooms the exact count finds as many pairs that penetrate",
     agree, SCENES);
  ok(tap, hit > SCENES * 9 / 10, "%d have as many as asked for", hit);
}

int main(void) {
  struct tap tap = plan(3);
  test_outlines(&tap);
  test_crossings(&tap);
  return finish(&tap);
}
