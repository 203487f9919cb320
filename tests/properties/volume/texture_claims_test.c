/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is claimed of forward texture mapping, beside inverse maps.
 *
 * Source      J. E. Swan II, PhD thesis, Ohio State University, 1998, 3.5: a
 *             forward map, which splats every texel, is as good as direct
 *             convolution, better than a mip-map or a summed-area table, and
 *             reads each texel once. It was proposed there, and not built.
 * Measure     the checkered planes of splat_claims_test: the mean square error
 *             beyond k against the plane filtered by the forward map's kernel, and
 *             against means over pixels. */
#include "bench/modules/variant.h"
#include "tests/properties/volume/boards.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- Maps ----------------------------------------------------------------- */

enum { FORWARD, FOOTPRINT, PREIMAGE, TABLE, MIPMAP, POINT, MAPS };
static const char *const maps[MAPS] = {
    [FORWARD] = "splat-xray:model=xray:normalise=on:antialias=on",
    [FOOTPRINT] = "texture-convolve:model=xray",
    [PREIMAGE] = "texture-convolve:model=xray:shape=preimage",
    [TABLE] = "texture-table:model=xray",
    [MIPMAP] = "texture-mipmap:model=xray",
    [POINT] = "texture-point:model=xray"};

/* A plane, and what is right of it: by the forward map's kernel; and as a mean
 * over each pixel's square. */
struct trial {
  const struct board *board;
  struct stage stage;
  struct hsr_view view;
  struct filtered right, mean;
};

/* The mean over a pixel's square, by 16 x 16 rays. */
static void average_board(struct filtered *f, const struct board *b,
                          const struct hsr_view *view) {
  enum { PARTS = 16 };
  memset(f, 0, sizeof *f);
  for (int part = 0; part < PARTS * PARTS; part++) {
    struct hsr_view v = *view;
    v.offset_x = (part % PARTS + 0.5) / PARTS - 0.5;
    v.offset_y = (floor((double)part / PARTS) + 0.5) / PARTS - 0.5;
    for (int k = 0; k < BOARD; k++) {
      double D[3], t;
      if (!meets_board(&v, b, k % BOARD_M, k / BOARD_M, 0, &t))
        continue;
      direction_at(&v, k % BOARD_M, k / BOARD_M, D);
      f->colour[k] += is_white_at(b, v.E[0] + t * D[0], t);
      f->weight[k]++;
    }
  }
}

/* What is measured of a map. */
struct measured {
  struct picture picture;
  double error;   /* from what is right */
  double area;    /* from the mean over each pixel's square */
  double reads;   /* texels */
  double weights; /* of texels in pixels */
  double built;   /* texels of levels, entries of a table */
};

static struct measured measure(const struct trial *t, const char *map,
                               double width) {
  struct hsr_variant made = splat_variant("%s:width=%g", map, width);
  struct measured m = {.picture = take(&t->stage, &t->view, &made)};
  const struct hsr_tally *tally = &m.picture.tally;
  bool is_forward = map == maps[FORWARD];
  m.error = board_error(&m.picture, t->board, &t->view, &t->right, true);
  m.area = board_error(&m.picture, t->board, &t->view, &t->mean, true);
  m.reads = (double)count_of(&made, tally, is_forward ? "samples" : "texels");
  m.weights = is_forward ? (double)count_of(&made, tally, "updates") : m.reads;
  if (map == maps[TABLE] || map == maps[MIPMAP])
    m.built = (double)count_of(&made, tally, "built");
  return m;
}

static void print_measured(const char *map, const struct measured *m) {
  printf("# %-47s error %.2e, from means over pixels %.2e, %.0f texels read, "
         "%.0f weights, %.0f built\n",
         map, m->error, m->area, m->reads, m->weights, m->built);
}

/* The least error of a map by any of these widths of its filter: a box of one
 * pixel is narrower than the kernel. */
static double best_error(const struct trial *t, const char *map,
                         double *best_width) {
  static const double widths[] = {1, 1.25, 1.5, 1.75, 2, 2.5, 3};
  double least = INFINITY;
  *best_width = 0;
  for (size_t k = 0; k < sizeof widths / sizeof *widths; k++) {
    struct measured m = measure(t, map, widths[k]);
    if (m.error < least)
      *best_width = widths[k];
    least = fmin(least, m.error);
    drop(&m.picture);
  }
  return least;
}

/* --- Claims --------------------------------------------------------------- */

/* By how much two pictures differ at most where rays meet the plane. */
static int apart_on_board(const struct trial *t, const struct picture *p,
                          const struct picture *q) {
  int most = 0;
  double depth;
  for (int j = 0; j < BOARD_N; j++)
    for (int i = 0; i < BOARD_M; i++) {
      size_t k = 4 * (size_t)(j * BOARD_M + i);
      if (!meets_board(&t->view, t->board, i, j, 0, &depth))
        continue;
      int apart = abs(p->rgba[k] - q->rgba[k]);
      most = apart > most ? apart : most;
    }
  return most;
}

/* The same kernel, read from both sides. The forward map rounds each texel's
 * share down to a whole number, which is at most one of 65536 by each splat,
 * before it divides by the weights. */
static void try_convolution(struct tap *tap, const struct trial *t,
                            const struct measured m[MAPS]) {
  int apart = apart_on_board(t, &m[FORWARD].picture, &m[FOOTPRINT].picture);
  ok(tap, m[FORWARD].error < 1.1 * m[FOOTPRINT].error && apart < WHITE / 1000,
     "the forward map is as good as direct convolution by the same kernel: "
     "%.3e, %.3e; they differ by %d of %d at most",
     m[FORWARD].error, m[FOOTPRINT].error, apart, WHITE);
  ok(tap, m[FORWARD].error < m[PREIMAGE].error,
     "and as by an ellipse of the pixel: %.2e", m[PREIMAGE].error);
}

/* By the best of the widths tried. The mip-map is best by the least of them, 1;
 * narrower ones are not tried. */
static void try_prefilters(struct tap *tap, const struct trial *t,
                           const struct measured *forward) {
  for (int k = TABLE; k <= MIPMAP; k++) {
    double width, best = best_error(t, maps[k], &width);
    ok(tap, 10 * forward->error < best,
       "it is better than %s, whose least error, with filters %g times as "
       "wide, is %.2e: %.0f times as large",
       maps[k], width, best, best / forward->error);
  }
}

/* From means over pixels the claim does not hold of the table in two of three
 * views: its box is such a mean where the preimage is along the axes, and the
 * forward map's kernel is wider than a pixel. `ratio` is the table's error by
 * that of the forward map. */
static void try_means(struct tap *tap, const struct measured m[MAPS],
                      double ratio) {
  double forward = m[FORWARD].area, table = m[TABLE].area / forward;
  ok(tap, 2 * forward < m[MIPMAP].area && 5 * forward < m[POINT].area,
     "from means over pixels, the errors of a mip-map and of points are %.1f "
     "and %.1f times as large as the forward map's",
     m[MIPMAP].area / forward, m[POINT].area / forward);
  ok(tap, fabs(table - ratio) < 0.02,
     "but that of a table %.2f times, should be %.2f", table, ratio);
}

static void try_reads(struct tap *tap, const struct measured m[MAPS]) {
  double texels = (double)PLANE_X * PLANE_Z;
  ok(tap, m[FORWARD].reads <= texels && m[FOOTPRINT].reads > 3 * texels,
     "the forward map reads %.2f times as many texels as there are, direct "
     "convolution %.2f and %.2f times as many",
     m[FORWARD].reads / texels, m[FOOTPRINT].reads / texels,
     m[PREIMAGE].reads / texels);
  ok(tap, m[FORWARD].weights >= m[FOOTPRINT].weights,
     "but it weighs no fewer: %.0f weights, direct convolution %.0f",
     m[FORWARD].weights, m[FOOTPRINT].weights);
}

static void try_maps(struct tap *tap, const struct board *b, double ratio) {
  static struct trial t;
  struct measured m[MAPS];
  t.board = b;
  open_board(&t.stage, b, WHITE);
  t.view = board_view(b, 0);
  filter_board(&t.right, b, &t.view);
  average_board(&t.mean, b, &t.view);
  printf("# checkers, half angle %g, height %g, near %g:\n", b->half_angle,
         b->height, b->near_z);
  for (int k = 0; k < MAPS; k++) {
    m[k] = measure(&t, maps[k], 1);
    print_measured(maps[k], &m[k]);
  }
  try_convolution(tap, &t, m);
  try_prefilters(tap, &t, &m[FORWARD]);
  try_means(tap, m, ratio);
  try_reads(tap, m);
  for (int k = 0; k < MAPS; k++)
    drop(&m[k].picture);
  close_stage(&t.stage);
}

int main(void) {
  static const struct board boards[] = {
      {30, 40, 30}, {45, 100, 60}, {60, 200, 100}};
  static const double ratios[] = {1.54, 0.87, 0.48};
  struct tap tap = plan(3 * (2 + 2 + 2 + 2));
  fill_footprint();
  for (int k = 0; k < 3; k++)
    try_maps(&tap, &boards[k], ratios[k]);
  return finish(&tap);
}
