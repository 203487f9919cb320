/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the twins of splat_put.c share: splat_put_avx2.c and splat_put_avx512.c.
 * Each defines ALL, how many pixels it weighs together; the types `floats` and
 * `ints` of so many lanes, with their operations; and TWIN, its machine's
 * attribute. Then it includes this file. */
#ifndef HSR_ALGORITHMS_SPLAT_TWIN_H
#define HSR_ALGORITHMS_SPLAT_TWIN_H

#include <string.h>

#define ALWAYS TWIN static inline __attribute__((always_inline))

/* What gives kappa in a splat's footprint, in all lanes. */
struct footprint {
  floats xx, xy, yy, p, q, constant, most, least; /* slope, and 2 - slope */
  floats column, row;                             /* of each lane */
  ints colour;
  floats way_x, way_y, s_x, s_y; /* of a blurred splat */
};

/* `columns`: pixels of each row that are weighed together, a power of two up to
 * ALL. */
TWIN static inline struct footprint footprint_of(const struct hsr_placed *p,
                                                 int columns, bool blurred) {
  const ints lane = i_numbers(), column = i_and(lane, i_all(columns - 1)),
             row = i_right(lane, __builtin_ctz((unsigned)columns));
  int64_t rgba;
  memcpy(&rgba, p->colour, sizeof rgba);
  return (struct footprint){.xx = f_all(p->xx),
                            .xy = f_all(2 * p->xy),
                            .yy = f_all(p->yy),
                            .p = f_all(p->p),
                            .q = f_all(p->q),
                            .constant =
                                f_all(blurred ? p->way_error : p->constant),
                            .most = f_all(blurred ? 1 : p->slope),
                            .least = f_all(blurred ? 1 : 2 - p->slope),
                            .column = f_of_ints(column),
                            .row = f_of_ints(row),
                            .colour = i_all64(rgba),
                            .way_x = f_all(p->way_x),
                            .way_y = f_all(p->way_y),
                            .s_x = f_all(p->s_x),
                            .s_y = f_all(p->s_y)};
}

TWIN __attribute__((noinline)) static ints settle(const struct hsr_splats *s,
                                                  const struct hsr_placed *p,
                                                  int x, int j, int columns,
                                                  unsigned doubt, ints index) {
  uint32_t indices[ALL];
  i_store(indices, index);
  hsr_splats_settle(s, p, x, j, columns, doubt, indices);
  return i_load(indices);
}

/* What is the same in all rows, for the columns from `past` right of the first
 * on. */
struct column {
  floats X, xx, xy, px;
};

TWIN static inline struct column column_of(const struct footprint *f, float dx,
                                           int past) {
  floats column = f_all((float)past) + f->column, X = f_all(dx) + column;
  return (struct column){X, f->xx * (X * X), f->xy * X,
                         f_fma(f->p, X, f_all(1))};
}

TWIN static inline floats kappa_of(const struct footprint *f,
                                   const struct column *c, floats Y) {
  floats w = f_fma(f->q, Y, c->px);
  floats square = f_fma(f_fma(f->yy, Y, c->xy), Y, c->xx);
  return f_ratio(square, w * w);
}

/* The same for a blurred splat: splat_blur.c. */
TWIN static inline floats blurred_kappa_of(const struct footprint *f,
                                           const struct column *c, floats Y) {
  floats per_w = f_inverse(f_fma(f->q, Y, c->px));
  floats x = c->X * per_w, y = Y * per_w;
  floats t = f_fma(f->s_x, x, f->s_y * y);
  t = f_min(f_max(t, f_all(0)), f_all(1));
  x = f_fma_less(t, f->way_x, x);
  y = f_fma_less(t, f->way_y, y);
  floats yy = f->yy * (y * y);
  return f_fma(f_fma(f->xx, x, f->xy * y), x, yy);
}

/* Composites the columns of the box from x0 + past on, as many as are weighed
 * together. Defined by each twin. */
ALWAYS void put_columns(struct hsr_splats *s, const struct hsr_placed *p,
                        struct hsr_splat_picture *picture,
                        const struct footprint *f, int past, int columns,
                        bool blurred, enum hsr_splat_way way);

/* All columns of the box. */
ALWAYS void put_box(struct hsr_splats *s, const struct hsr_placed *p,
                    struct hsr_splat_picture *picture, int columns,
                    bool blurred, enum hsr_splat_way way) {
  const struct footprint f = footprint_of(p, columns, blurred);
  const int width = p->box.x1 - p->box.x0;
  for (int past = 0; past < width; past += columns)
    put_columns(s, p, picture, &f, past, columns, blurred, way);
}

/* Calls put_box with a constant `way`: each has code of its own. */
ALWAYS void put_shape(struct hsr_splats *s, const struct hsr_placed *p,
                      struct hsr_splat_picture *picture, int columns,
                      bool blurred, enum hsr_splat_way way) {
  if (way == HSR_PUT_OVER)
    put_box(s, p, picture, columns, blurred, HSR_PUT_OVER);
  else if (way == HSR_PUT_UNDER)
    put_box(s, p, picture, columns, blurred, HSR_PUT_UNDER);
  else if (way == HSR_PUT_ADD)
    put_box(s, p, picture, columns, blurred, HSR_PUT_ADD);
  else
    put_box(s, p, picture, columns, blurred, HSR_PUT_SUM);
}

/* Each shape of footprint has code of its own, too: together they would need
 * more registers than there are. */
#define SHAPE(name, columns, blurred)                                          \
  TWIN static __attribute__((noinline)) void name(                             \
      struct hsr_splats *s, const struct hsr_placed *p,                        \
      struct hsr_splat_picture *picture, enum hsr_splat_way way) {             \
    put_shape(s, p, picture, columns, blurred, way);                           \
  }

#endif
