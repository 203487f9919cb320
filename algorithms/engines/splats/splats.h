/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Splatting: every kept sample of a grid is a kernel, whose footprint on the
 * screen is composited into the picture. One frame.
 *
 * Source      J. E. Swan II, "Object-Order Rendering of Discrete Objects", PhD
 *             thesis, Ohio State University, 1998, chapters 1 and 3; L.
 *             Westover, "Footprint Evaluation for Volume Rendering", 1990. What
 *             is right: docs/composited-picture.md.
 * Notation    as there. kappa is the square of a pixel's distance from the
 *             middle of a splat, 1024 at its rim.
 * Invariant   the channels of each pixel are those of all splats so far
 * Ties        there are none: all is decided as the definition says.
 * Exact       kappa is found in floats, with a bound of its error. If a whole
 *             number lies within the bound, kappa is found in doubles, with a
 *             narrower bound; if one lies within that too, exactly
 *             (common/exact/footprint.h). All that follows is in integers.
 * DDA         a point on the screen is a sum of three terms, one for each axis.
 *             Along a row of samples only one of them changes (thesis, 1.1).
 * Departures  a footprint is not a polygon with a texture: each pixel's weight
 *             is looked up for its own ray.
 * Cost        splats, and pixels of their footprints
 *
 * Files: splat_frame.c walks the grid; splat_light.c gives samples their
 * colours; splat_kernel.c makes the kernels' tables; splat_place.c finds where
 * splats are; splat_weigh.c the weights in their pixels; splat_blur.c those of
 * splats that moved; splat_put.c puts them over, under and into pixels; splat_picture.c keeps the pixels. */
#ifndef HSR_ALGORITHMS_SPLATS_H
#define HSR_ALGORITHMS_SPLATS_H

#include "algorithms/algorithm.h"
#include "common/base/numbers.h"
#include "common/base/vector.h"
#include "common/exact/footprint.h"
#include "common/grids/order.h"

#include <stdalign.h>

/* --- What the modules have in common -------------------------------------- */

/* What they count; and the folds of those models that sum. */
extern const struct hsr_part hsr_splats_part, hsr_folds_part;
enum {
  HSR_SPLAT_ROWS = HSR_FIRST_OF(HSR_PART_SPLATS),
  HSR_SPLAT_CELLS,
  HSR_SPLAT_SPLATS,
  HSR_SPLAT_UPDATES,
  HSR_SPLAT_WRITES
};
enum { HSR_SPLAT_FOLDS = HSR_FIRST_OF(HSR_PART_FOLDS) };

/* --- The frame ------------------------------------------------------------ */

enum {
  HSR_SPLAT_OPACITY = 3, /* channels 0 to 2 are red, green and blue */
  HSR_SPLAT_WEIGHT = 4,
  HSR_SPLAT_CHANNELS = 5,
  HSR_SPLAT_BATCH = 64, /* splats that are placed at once */
  HSR_SPLAT_KNOTS = 64, /* of a kernel's table, and one more */
  HSR_SPLAT_LANES = 8,  /* pixels of a row that are weighed at once */
  HSR_SPLAT_SPARE = 3   /* rows that a twin may put below the last one */
};

/* What is a sum of three terms, one for each axis: homogeneous screen coordinates,
 * the depth, and products of vectors that a prime has divided by the cell's size. V
 * is from E to the sample, and in parallel F; A and B are what D changes by a pixel
 * to the right and down. */
enum {
  HSR_TERM_X,
  HSR_TERM_Y,
  HSR_TERM_W, /* t; in parallel 1, to which no axis adds */
  HSR_TERM_DEPTH,
  HSR_TERM_VV,
  HSR_TERM_VA,
  HSR_TERM_VB,
  HSR_TERM_AA,
  HSR_TERM_AB,
  HSR_TERM_BB,
  HSR_TERM_APART, /* 2 (U'.U' / n^2 + R'.R' / m^2) */
  HSR_TERMS
};

/* Splats that are about to be drawn, in sequence. */
struct hsr_splat_batch {
  int n;
  uint32_t cell[HSR_SPLAT_BATCH], at[3][HSR_SPLAT_BATCH],
      opacity[HSR_SPLAT_BATCH];

  /* Of each, by hsr_splats_place: where its middle is on the screen; kappa of
   * the pixel (dx, dy) from there, which is (xx dx^2 + 2 xy dx dy + yy dy^2) /
   * (1 + p dx + q dy)^2. */
  double x[HSR_SPLAT_BATCH], y[HSR_SPLAT_BATCH];
  float xx[HSR_SPLAT_BATCH], xy[HSR_SPLAT_BATCH], yy[HSR_SPLAT_BATCH],
      p[HSR_SPLAT_BATCH], q[HSR_SPLAT_BATCH];
  /* How far kappa may be off, of any of the batch that is_small: by error; with
   * fused products by constant + (slope - 1) kappa. */
  float error, constant, slope;
  /* The pixels that it may touch, and whether they and floats can be told. */
  int32_t x0[HSR_SPLAT_BATCH], x1[HSR_SPLAT_BATCH], y0[HSR_SPLAT_BATCH],
      y1[HSR_SPLAT_BATCH], is_small[HSR_SPLAT_BATCH];
  double depth[HSR_SPLAT_BATCH]; /* t */
  double apart[HSR_SPLAT_BATCH]; /* pixels, in cells, squared: g^2 if over 1 */
  int32_t is_beyond[HSR_SPLAT_BATCH]; /* near; if not, it may be yet */
  int32_t energy[HSR_SPLAT_BATCH];    /* e; negative: to be found exactly */
  float dx[HSR_SPLAT_BATCH], dy[HSR_SPLAT_BATCH]; /* of pixel (x0, y0) */
  double scale[HSR_SPLAT_BATCH];                  /* 1024 / (g r)^2 */
  double rough[HSR_SPLAT_BATCH]; /* how far, relatively, these may be off */
};

/* One splat of a batch, as it is drawn. */
struct hsr_placed {
  uint32_t cell, at[3];
  uint16_t colour[HSR_SPLAT_OPACITY + 1]; /* that it gives by a weight of 1 */
  uint32_t opacity, energy;
  double x, y;
  float xx, xy, yy, p, q, error, constant, slope;
  float dx, dy; /* of the first pixel of the box */
  struct hsr_window box;
  double scale, rough;
  bool is_small; /* floats may tell kappa, of a blurred one by what is below */
  bool is_blurred;
  /* Of a blurred splat, if is_small: Q as dx and dy, each over 1 + p dx + q dy;
   * by which multiples of these of a pixel are s; and how far kappa may be off. */
  float way_x, way_y, s_x, s_y, way_error;
  double way[3], way_length, way_off; /* Q, l, and how far Q may be off */
};

/* The light on a normal. */
struct hsr_splat_light {
  uint32_t shade, gloss;
};

/* A kept sample, and its row j + n[1] k. */
struct hsr_splat_sample {
  uint32_t cell;
  uint32_t row;
};

/* The energy found last, and the cell for which it was. */
struct hsr_splats_energy {
  double size[3];
  uint32_t energy;
};

/* What a splat does to the pixels of its footprint. */
enum hsr_splat_way {
  HSR_PUT_OVER,
  HSR_PUT_UNDER,
  HSR_PUT_ADD, /* 65535 is the most */
  HSR_PUT_SUM  /* to `sum` */
};

struct hsr_splats;
struct hsr_splat_picture;

/* Puts a splat that is small into a picture without weights. */
typedef void hsr_splats_putter(struct hsr_splats *splats,
                               const struct hsr_placed *placed,
                               struct hsr_splat_picture *picture,
                               enum hsr_splat_way way);

struct hsr_splats {
  const struct hsr_job *job;
  const struct hsr_view *view;
  const struct hsr_grid *grid;
  struct hsr_tally *tally;
  struct hsr_splatting splatting;
  struct hsr_window window;
  /* Sample k of axis a: its distance from E along the axis; its terms; 1 / the
   * size of its cell. */
  double *far[3], *term[3][HSR_TERMS], *per_size[3];
  double
      most[4]; /* the greatest sum of the sizes of three terms, to the depth */
  double largest[3];     /* cell of each axis */
  double spread[3];      /* the most that homogeneous coordinate c changes, on
                            a way of the largest cell along each axis */
  double apart;          /* the greatest g^2 / (width t)^2; in parallel g^2 /
                            width^2 */
  uint32_t plain_energy; /* e of a splat that is not widened or blurred */
  double reach;          /* r */
  struct hsr_splat_light *light;                  /* by code of normal */
  alignas(64) uint16_t knot[HSR_SPLAT_KNOTS + 1]; /* T: the kernel's table */
  alignas(64) uint16_t fall[HSR_SPLAT_KNOTS];     /* T_i - T_(i + 1) */
  uint32_t weight[HSR_FOOTPRINT + 1];             /* W of kappa; 0 at the end */
  uint16_t *before[2 * HSR_FOOTPRINT_PARTS + 1];  /* of model volume */

  /* Of slices across x: the samples at x are those from start[x] on. */
  uint32_t *start;
  struct hsr_splat_sample *sample;

  /* The part of its way over which a splat is stretched: all of it, from 0 to 1.
   * One point of it, in a frame of an accumulation buffer: it is drawn there as
   * it is. */
  double way_from, way_to;

  struct hsr_splats_energy last;
  struct hsr_splat_batch batch;
  struct hsr_placed placed[HSR_SPLAT_BATCH]; /* what is drawn of it */
  void (*draw)(struct hsr_splats *, const struct hsr_placed *);
  /* Whether splats of at most this opacity and energy add nothing to any pixel
   * of the box. NULL in models that leave out no splat; otherwise rows are tested
   * in pieces. */
  bool (*is_hidden)(const struct hsr_splats *, uint32_t opacity,
                    uint32_t energy, const struct hsr_window *);
  uint32_t most_opacity; /* of any sample, by the palette */
  void *model;           /* of the module */
  hsr_splats_putter *twin;
};

/* Begins a frame. HSR_E_NOMEM. */
enum hsr_status hsr_splats_begin(struct hsr_splats *splats,
                                 const struct hsr_job *job);

/* Calls splats->draw for every splat that may be seen in the window, in an
 * order of the grid, nested as hsr_grid_visit has it. HSR_E_NOMEM. */
enum hsr_status hsr_splats_visit(struct hsr_splats *splats,
                                 enum hsr_grid_order order, int nesting,
                                 bool front, struct hsr_error *err);

/* For the slices of the grid across an axis, in any sequence: calls splats->draw
 * for the splats of slice k. HSR_E_NOMEM of the first. */
enum hsr_status hsr_splats_open_slices(struct hsr_splats *splats, int axis);
void hsr_splats_visit_slice(struct hsr_splats *splats, int axis, uint32_t k);

/* The last cell along an axis whose lower bound is not above the eye; -1. */
int32_t hsr_splats_split(const struct hsr_splats *splats, int axis);

/* --- Tables --------------------------------------------------------------- */

/* W of kappa, by the knots T of a table that does not rise. kappa is below
 * HSR_FOOTPRINT. */
static inline uint32_t hsr_splats_between(const uint16_t *knot, int kappa) {
  enum { EACH = HSR_FOOTPRINT / HSR_SPLAT_KNOTS };
  const uint16_t *T = knot + kappa / EACH;
  uint32_t twice = 2 * ((uint32_t)kappa % EACH) + 1;
  return T[0] - twice * (uint32_t)(T[0] - T[1]) / (2 * EACH);
}

void hsr_splats_fill_weights(struct hsr_splats *splats);

/* Fills `before`, each of which has room for HSR_SPLAT_KNOTS + 1. */
void hsr_splats_fill_parts(struct hsr_splats *splats);

void hsr_splats_fill_lights(struct hsr_splats *splats);

/* The opacity A of a kept sample. */
static inline uint32_t hsr_splats_opacity(const struct hsr_splats *splats,
                                          uint32_t cell) {
  const struct hsr_grid *g = splats->grid;
  uint32_t by_density = g->palette.opacity[g->level[cell]],
           by_gradient = g->palette.gradient[g->steep[cell]];
  uint64_t opacity = by_density * by_gradient / 65535;
  return (uint32_t)(opacity * splats->splatting.attenuate >> 16);
}

/* The premultiplied colour of a kept sample of this opacity, and the opacity. */
void hsr_splats_colour(const struct hsr_splats *splats, uint32_t cell,
                       uint32_t opacity,
                       uint16_t colour[HSR_SPLAT_OPACITY + 1]);

/* Finds the colours of n splats, at most HSR_SPLAT_BATCH. */
void hsr_splats_shade(const struct hsr_splats *splats,
                      struct hsr_placed *placed, int n);

/* --- Places and weights --------------------------------------------------- */

/* The first pixel of [from, to] whose middle is not left of z, and the one after
 * the last whose middle is not right of it; z is in pixels from the middle of
 * pixel 0. */
static inline int32_t hsr_splats_first_pixel(double z, int32_t from,
                                             int32_t to) {
  double in = hsr_min(hsr_max(z, from), to);
  int32_t whole = (int32_t)in;
  return whole + (whole < in);
}
static inline int32_t hsr_splats_end_pixel(double z, int32_t from, int32_t to) {
  return (int32_t)hsr_min(hsr_max(z + 1, from), to);
}

void hsr_splats_place(struct hsr_splats *splats);

/* Splat k of the batch, without its colour. False if the definition gives it no
 * splat, or it is not in the window, or hidden. */
bool hsr_splats_take(struct hsr_splats *splats, int k,
                     struct hsr_placed *placed);

/* The indices of the table for the pixels from x on in row j, kappa rounded
 * down; HSR_FOOTPRINT where the splat does not cover a pixel. */
void hsr_splats_find(const struct hsr_splats *splats,
                     const struct hsr_placed *placed, int x, int j,
                     int32_t index[HSR_SPLAT_LANES]);

/* The index of one pixel, in doubles or exactly. */
int hsr_splats_index(const struct hsr_splats *splats,
                     const struct hsr_placed *placed, int i, int j);

/* V' and D' of a pixel, rounded, and the sums of the sizes of what they were
 * summed from, each component of which bounds 2^50 times the error. */
struct hsr_splat_ray {
  double V[3], D[3], v[3], d[3];
};
struct hsr_splat_ray hsr_splats_ray(const struct hsr_splats *splats,
                                    const struct hsr_placed *placed, int i,
                                    int j);

/* Stretches a splat over the way that it went since the view before, if it is
 * blurred: finds Q, the energy and the box; g^2 is width^2 max(1, apart). */
void hsr_splats_stretch(struct hsr_splats *splats, struct hsr_placed *placed,
                        double apart);

/* hsr_splats_find of a blurred splat. */
void hsr_splats_find_blurred(const struct hsr_splats *splats,
                             const struct hsr_placed *placed, int x, int j,
                             int32_t index[HSR_SPLAT_LANES]);

/* Adds sQ of a blurred splat in pixel (i, j) to V; returns how far that may be
 * off. */
double hsr_splats_move(const struct hsr_splats *splats,
                       const struct hsr_placed *placed, int i, int j,
                       double V[3]);

/* What the exact services are asked about. */
struct hsr_splat hsr_splats_exact(const struct hsr_splats *splats,
                                  const uint32_t at[3]);

/* --- The picture ---------------------------------------------------------- */

/* The channels of the pixels of the window, row after row: E of a picture, or
 * sums of D. Behind each row there is room for the lanes, and below the last one
 * there are rows to spare.
 *
 * In E opacities stay below 65536, and so do colours, which they exceed. Of
 * sums 65535 is the most that counts. Weights are not bounded so. */
struct hsr_splat_picture {
  uint16_t (*rgba)[4]; /* NULL if there is `sum` */
  uint32_t (*sum)[4];  /* of xray; NULL of others */
  uint64_t *weight;    /* NULL without normalise */
  size_t stride, count;
};

/* All 0. HSR_E_NOMEM. */
enum hsr_status hsr_splats_open(struct hsr_splats *splats,
                                struct hsr_splat_picture *picture);

/* All 0 again. */
void hsr_splats_clear(struct hsr_splat_picture *picture);

/* Widens a part of the window by another one. */
static inline void hsr_splats_widen(struct hsr_window *w,
                                    const struct hsr_window *by) {
  w->x0 = by->x0 < w->x0 ? by->x0 : w->x0;
  w->y0 = by->y0 < w->y0 ? by->y0 : w->y0;
  w->x1 = by->x1 > w->x1 ? by->x1 : w->x1;
  w->y1 = by->y1 > w->y1 ? by->y1 : w->y1;
}

/* The part of the window that is widened first: none. */
static inline struct hsr_window hsr_splats_none(const struct hsr_splats *s) {
  const struct hsr_window *w = &s->window;
  return (struct hsr_window){w->x1, w->y1, w->x0, w->y0};
}

/* Where pixel (i, j) is in a picture. */
static inline size_t hsr_splats_at(const struct hsr_splats *splats,
                                   const struct hsr_splat_picture *picture,
                                   int i, int j) {
  return (size_t)(j - splats->window.y0) * picture->stride +
         (size_t)(i - splats->window.x0);
}

/* The fastest that this machine has; NULL if it has none but the portable one. */
hsr_splats_putter *hsr_splats_twin(void);

void hsr_splats_put(struct hsr_splats *splats, const struct hsr_placed *placed,
                    struct hsr_splat_picture *picture, enum hsr_splat_way way);

/* Its twins for machines with AVX-512, and with AVX2 and fused products. */
#if defined __x86_64__ && HSR_HAVE_TARGET_CLONES && !HSR_COUNTING
#define HSR_SPLATS_HAVE_TWINS 1
hsr_splats_putter hsr_splats_put_avx512, hsr_splats_put_avx2;
/* For a twin that weighs several pixels at once, `columns` of a row, from pixel
 * (x, j) on: decides those whose bits are set in `doubt`. index[] has what floats
 * say of each, and gets the index; HSR_FOOTPRINT beyond the box. */
void hsr_splats_settle(const struct hsr_splats *splats,
                       const struct hsr_placed *placed, int x, int j,
                       int columns, unsigned doubt, uint32_t *index);
#else
#define HSR_SPLATS_HAVE_TWINS 0
#endif

/* Adds what a splat gives to one pixel by this weight. */
void hsr_splats_add(const struct hsr_splats *splats,
                    const struct hsr_placed *placed,
                    struct hsr_splat_picture *picture, int i, int j,
                    uint32_t weight);

/* Puts sums over a picture, in a part of the window, and makes them 0. */
void hsr_splats_fold(struct hsr_splats *splats, struct hsr_splat_picture *sums,
                     const struct hsr_window *where,
                     struct hsr_splat_picture *picture);

/* The answer of pixel (i, j), from its channels E. */
void hsr_splats_write(struct hsr_splats *splats, int i, int j,
                      const uint64_t E[HSR_SPLAT_CHANNELS]);

/* The answers of the whole window. */
void hsr_splats_finish(struct hsr_splats *splats,
                       const struct hsr_splat_picture *picture);

#endif
