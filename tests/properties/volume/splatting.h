/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Grids and pictures for the tests of splatting. Any failure that is not
 * spoken of ends the test program. */
#ifndef HSR_TESTS_SPLATTING_H
#define HSR_TESTS_SPLATTING_H

#include "bench/modules/variant.h"
#include "tests/draw.h"

/* A grid before it is one. All borrowed. */
struct field {
  uint32_t n[3];
  const double *at[3];
  const float *density;  /* by z, y, x; NULL: 1 everywhere */
  const float (*rgb)[3]; /* the same; NULL: no sample has a colour */
  double low, high;      /* as in struct hsr_grid_samples */
  struct hsr_grid_keep keep;
  const struct hsr_palette *palette;
};

/* A scene of a grid. */
struct stage {
  struct hsr_scene *scene;
  struct hsr_world world;
};
void open_stage(struct stage *stage, const struct field *field);
void open_named_stage(struct stage *stage, const char *name);
void close_stage(struct stage *stage);

/* All of the same opacity and colour, without light; 65535 is 1. */
struct hsr_palette plain_palette(int opacity, int grey);

/* As hsr_variant_parse: "splat-xray:model=xray:normalise=on". */
struct hsr_variant splat_variant(const char *format, ...);

struct hsr_view splat_view(const struct hsr_camera *camera, int m, int n);

/* The picture, 4 m n numbers, drawn in these windows one after the other, or in
 * that of the view if there are none. What is not drawn stays as it was before
 * any drawing: red over no opacity. Adds its counts to *tally unless NULL. */
enum build { PLAIN, COUNTING };
void draw_splats(const struct stage *stage, const struct hsr_view *view,
                 const struct hsr_variant *variant, enum build build,
                 const struct hsr_window *windows, int n_windows,
                 uint16_t *rgba, struct hsr_tally *tally);

/* The same picture, by the oracle. */
void judge_splats(const struct stage *stage, const struct hsr_view *view,
                  const struct hsr_variant *variant, uint16_t *rgba,
                  struct hsr_tally *tally);

/* What the counter of that name counted. */
uint64_t count_of(const struct hsr_variant *variant,
                  const struct hsr_tally *tally, const char *counter);

#endif
