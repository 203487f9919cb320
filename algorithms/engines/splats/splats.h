/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Splatting: every kept sample of a grid is a kernel, whose footprint on the
 * screen is composited into the picture. One frame.
 *
 * Source      J. E. Swan II, "Object-Order Rendering of Discrete Objects", PhD
 *             thesis, Ohio State University, 1998, chapters 1 and 3; L.
 *             Westover, "Footprint Evaluation for Volume Rendering", 1990. What
 *             is right: docs/composited-picture.md.
 * Notation    that of docs/composited-picture.md. kappa is the square of a
 *             pixel's distance from the middle of a splat, in units in which it
 *             is 1024 at the splat's rim; the weight depends on its whole part.
 * Invariant   the channels of each pixel are those of all splats so far
 * Ties        none: all is decided as the definition says
 * Exact       kappa is computed in floats, with a bound of its error. If a
 *             whole number lies within the bound, kappa is computed in doubles,
 *             with a narrower bound. If one lies within that too, kappa is
 *             found exactly (common/exact/footprint.h). All that follows is in
 *             integers.
 * DDA         a point on the screen is a sum of three terms, one for each axis.
 *             Along a row of samples only one of them changes (thesis, 1.2.1).
 * Departures  A footprint is not drawn as a polygon with a texture: the weight
 *             of each pixel is looked up for the pixel's own ray.
 * Cost        splats, and pixels of their footprints
 *
 * Tiles       the window is drawn in tiles, each with pixels of its own. Splats
 *             are placed and shaded once, in sequence, and those of a tile are
 *             put into it in that sequence. So the picture does not depend on
 *             the tiles, nor on the threads that draw them.
 *
 * Files: splat_frame.c visits the samples of the grid in order; splat_tiles.c
 * hands splats out to the tiles; splat_light.c gives them colours;
 * splat_kernel.c makes the kernels' tables; splat_length.c makes those of opacity per
 * length; splat_place.c finds where splats
 * are; splat_weigh.c finds the weights in their pixels, splat_blur.c those of
 * blurred splats; splat_put.c composites them into pixels; splat_picture.c keeps
 * the pixels; splat_accumulate.c takes the mean of frames. */
#ifndef HSR_ALGORITHMS_SPLATS_H
#define HSR_ALGORITHMS_SPLATS_H

#include "algorithms/algorithm.h"
#include "common/base/numbers.h"
#include "common/base/vector.h"
#include "common/exact/footprint.h"
#include "common/grids/order.h"
#include "common/grids/splatting.h"

#include <stdalign.h>

/* --- What the modules have in common -------------------------------------- */

/* The part that all the modules have, and that of those that sum slices and
 * fold the sums; with their counters. */
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
  HSR_SPLAT_BATCH = 64, /* splats that are placed together */
  HSR_SPLAT_KNOTS = 64, /* a kernel's table has one knot more than this */
  HSR_SPLAT_LANES = 8,  /* pixels of a row that are weighed together */
  HSR_SPLAT_SPARE = 3   /* rows below the last one that a twin may write to */
};

/* Quantities of a sample that are sums of three terms, one for each axis:
 * homogeneous screen coordinates; the depth; and products of vectors, each
 * coordinate of which has been divided by the cell's size along its axis. V is
 * the vector from E to the sample, in parallel projection F. A and B are the
 * changes of D from a pixel to the next, to the right and down. */
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

/* Samples that are about to be placed together, in sequence. */
struct hsr_splat_samples {
  int n;

  /* Of each: its cell of the grid, the cell's indices, its opacity. */
  uint32_t cell[HSR_SPLAT_BATCH], at[3][HSR_SPLAT_BATCH],
      opacity[HSR_SPLAT_BATCH];
};

/* Where the splats of samples are. */
struct hsr_splat_batch {
  const struct hsr_splat_samples *of; /* borrowed */

  /* Where the splat's middle is on the screen, in pixels; and kappa of the pixel
   * (dx, dy) from there: (xx dx^2 + 2 xy dx dy + yy dy^2) / (1 + p dx + q
   * dy)^2. */
  double x[HSR_SPLAT_BATCH], y[HSR_SPLAT_BATCH];
  float xx[HSR_SPLAT_BATCH], xy[HSR_SPLAT_BATCH], yy[HSR_SPLAT_BATCH],
      p[HSR_SPLAT_BATCH], q[HSR_SPLAT_BATCH];

  /* The error of kappa in floats, of any splat of the batch that is_small: at
   * most `error`; with fused products at most constant + (slope - 1) kappa. */
  float error, constant, slope;

  /* The pixels that the splat may touch: [x0, x1) by [y0, y1). is_small: these
   * are known, and floats may be used. */
  int32_t x0[HSR_SPLAT_BATCH], x1[HSR_SPLAT_BATCH], y0[HSR_SPLAT_BATCH],
      y1[HSR_SPLAT_BATCH], is_small[HSR_SPLAT_BATCH];
  double depth[HSR_SPLAT_BATCH]; /* t */
  /* The squared distance of pixels, in cells; g^2 if it is more than 1. */
  double apart[HSR_SPLAT_BATCH];
  /* It is certainly beyond the near plane. */
  int32_t is_beyond[HSR_SPLAT_BATCH];
  int32_t energy[HSR_SPLAT_BATCH]; /* e; negative: it must be found exactly */
  float dx[HSR_SPLAT_BATCH], dy[HSR_SPLAT_BATCH]; /* of pixel (x0, y0) */
  double scale[HSR_SPLAT_BATCH];                  /* 1024 / (g r)^2 */
  /* The relative error of scale, and of what it is made of. */
  double rough[HSR_SPLAT_BATCH];
};

/* One splat of a batch, ready to be drawn. Members that have the name of one of
 * the batch mean the same. */
struct hsr_placed {
  uint32_t cell, at[3];
  /* What a weight of 1 adds to a pixel. */
  uint16_t colour[HSR_SPLAT_OPACITY + 1];
  uint32_t opacity, energy;
  uint32_t length; /* with opacity=length: floor(Lambda e / 65536) */
  double x, y;
  float xx, xy, yy, p, q, error, constant, slope;
  float dx, dy; /* of the first pixel of the box */
  struct hsr_window box;
  double scale, rough;
  bool is_small; /* kappa may be computed in floats */
  bool is_blurred;

  /* If is_small and is_blurred: Q on the screen, as dx and dy over 1 + p dx + q
   * dy; the factors by which these of a pixel make s; and the error of
   * kappa. */
  float way_x, way_y, s_x, s_y, way_error;

  double way[3], way_length, way_off; /* if is_blurred: Q, l, the error of Q */
};

/* The light on a normal: the factor of a sample's own colour, and what is added
 * to that. */
struct hsr_splat_light {
  uint32_t shade, gloss;
};

/* A kept sample: its cell, and its row of the grid, j + n[1] k. */
struct hsr_splat_sample {
  uint32_t cell;
  uint32_t row;
};

/* The energy found last, and the size of the cell for which it was found. */
struct hsr_splats_energy {
  double size[3];
  uint32_t energy;
};

/* What a splat does to the pixels of its footprint. */
enum hsr_splat_way {
  HSR_PUT_OVER,
  HSR_PUT_UNDER,
  HSR_PUT_ADD, /* added to rgba; 65535 is the most */
  HSR_PUT_SUM  /* added to `sum`, without a limit */
};

struct hsr_splats;
struct hsr_splat_picture;
struct hsr_splat_round;

/* A part of the window that one thread draws at a time, and what the module
 * keeps of it. */
struct hsr_splat_tile {
  struct hsr_window window;
  void *model;
};

/* How a module composites. All is called for one tile; for different tiles on
 * several threads at once. */
struct hsr_splats_module {
  size_t size; /* of a tile's model, which is all 0 before `open` */

  /* Opens a tile's model, with memory from job->scratch. HSR_E_NOMEM. */
  enum hsr_status (*open)(struct hsr_splats *, struct hsr_splat_tile *);

  /* Draws a splat whose box is in the tile and not empty. */
  void (*draw)(struct hsr_splats *, struct hsr_splat_tile *,
               const struct hsr_placed *);

  /* After the last splat of a slice; NULL unless slices are visited. */
  void (*fold)(struct hsr_splats *, struct hsr_splat_tile *);

  /* Do splats of at most this opacity and energy add nothing to any pixel of
   * the box, which is in the tile? NULL: no splat is left out. Otherwise rows
   * of samples are tested in pieces. */
  bool (*is_hidden)(const struct hsr_splats *, const struct hsr_splat_tile *,
                    uint32_t opacity, uint32_t energy,
                    const struct hsr_window *);
};

/* Composites a splat that is_small into a picture without weights. */
typedef void hsr_splats_putter(struct hsr_splats *splats,
                               const struct hsr_placed *placed,
                               struct hsr_splat_picture *picture,
                               enum hsr_splat_way way);

/* One frame. */
struct hsr_splats {
  const struct hsr_job *job; /* borrowed */
  const struct hsr_view *view;
  const struct hsr_grid *grid;
  struct hsr_tally *tally;
  struct hsr_splatting splatting;
  struct hsr_window window;

  /* Of sample k along axis a: its distance from E along the axis, far[a][k];
   * its terms, term[a][t][k]; and 1 / the size of its cell. */
  double *far[3], *term[3][HSR_TERMS], *per_size[3];
  /* The greatest sum of the sizes of three terms, for the first four
   * quantities. */
  double most[4];
  double largest[3]; /* the largest cell along each axis */
  /* The most that homogeneous coordinate c changes over the largest cell along
   * each axis. */
  double spread[3];
  /* The greatest g^2 / (width t)^2; in parallel projection g^2 / width^2. */
  double apart;
  uint32_t plain_energy; /* e of a splat that is not widened or blurred */
  double reach;          /* r */
  struct hsr_splat_light *light;                  /* by the normal's code */
  alignas(64) uint16_t knot[HSR_SPLAT_KNOTS + 1]; /* T: the kernel's table */
  alignas(64) uint16_t fall[HSR_SPLAT_KNOTS];     /* T_i - T_(i + 1) */
  uint32_t weight[HSR_FOOTPRINT + 1];             /* W by kappa; last 0 */
  uint16_t *before[2 * HSR_FOOTPRINT_PARTS + 1];  /* hsr_splats_fill_parts */

  /* If lists are open: the samples of slice k are sample[start[k]] to
   * sample[start[k + 1] - 1]. */
  uint32_t *start;
  struct hsr_splat_sample *sample;

  /* With opacity=length; else NULL. Lambda by A; H and L. `veils`: a splat is
   * composited by itself, so that its opacity in a pixel is V. Otherwise sums
   * are. */
  uint32_t *length, *halved, *lessened;
  bool veils;

  uint32_t most_opacity;   /* that any sample has, by the palette */
  hsr_splats_putter *twin; /* of hsr_splats_twin */

  const struct hsr_splats_module *how; /* hsr_splats_divide sets it */
  const void *common;          /* the module's own, which all tiles share */
  struct hsr_splat_tile *tile; /* row after row */
  int width, height, across;   /* of a tile, in pixels; tiles a row */
  uint32_t n_tiles;
  struct hsr_splat_round *round; /* what is being handed out to the tiles */

  /* A thread's own. */
  struct hsr_splats_energy last;
  struct hsr_splat_batch *batch;

  /* How often the grid will be visited, how often it was, and samples of it that
   * were visited this time: for who watches the job. */
  int visits, visit;
  uint32_t visited;
  bool stopped; /* who watches wants no more */
};

/* Makes the picture of a job by frames that `frame` draws. Without
 * blur=accumulate there is one. With it there are several along the way of the
 * camera (common/view/path.h), and the picture is their mean: an accumulation
 * buffer (P. Haeberli, K. Akeley, SIGGRAPH 1990; thesis, 4.1). The job that
 * `frame` gets is a copy, of one view, with the same answer. Memory from
 * job->scratch. HSR_E_NOMEM, or what `frame` returns. */
typedef enum hsr_status hsr_splats_frame(const struct hsr_job *job,
                                         struct hsr_error *err);
enum hsr_status hsr_splats_accumulate(const struct hsr_job *job,
                                      hsr_splats_frame *frame,
                                      struct hsr_error *err);

/* Begins a frame of a job, which is borrowed. With blur=accumulate it is one
 * without blur. Memory from job->scratch. HSR_E_NOMEM. */
enum hsr_status hsr_splats_begin(struct hsr_splats *splats,
                                 const struct hsr_job *job);

/* Divides splats->window into tiles, of which how->open is called for each.
 * *how is static. HSR_E_NOMEM. */
enum hsr_status hsr_splats_divide(struct hsr_splats *splats,
                                  const struct hsr_splats_module *how);

/* After a change of splats->window to one that is not larger: the tiles lie in
 * it from now on. Their models stay. */
void hsr_splats_lay(struct hsr_splats *splats);

/* Draws every splat that may be seen in the window, in an order of the grid.
 * order, nesting and front are those of hsr_grid_visit. HSR_E_NOMEM;
 * HSR_E_STOPPED if who watches the job stops it. */
enum hsr_status hsr_splats_visit(struct hsr_splats *splats,
                                 enum hsr_grid_order order, int nesting,
                                 bool front, struct hsr_error *err);

/* hsr_splats_open_slices makes ready for slices of the grid across an axis, and
 * hsr_splats_open_lists for n slices of which slice_of tells the number of a
 * sample by its indices; axis is 0 then. HSR_E_NOMEM. hsr_splats_visit_slices draws n of them from `first` on, each of
 * which is followed by how->fold: up or down. HSR_E_STOPPED, as before. */
enum hsr_status hsr_splats_open_slices(struct hsr_splats *splats, int axis);
typedef uint32_t hsr_splats_slice_of(const struct hsr_splats *splats,
                                     const uint32_t at[3]);
enum hsr_status hsr_splats_open_lists(struct hsr_splats *splats, uint32_t n,
                                      hsr_splats_slice_of *slice_of);
enum hsr_status hsr_splats_visit_slices(struct hsr_splats *splats, int axis,
                                        uint32_t first, uint32_t n, int step,
                                        struct hsr_error *err);

/* Calls part(context, tile) for each tile, on the threads of the job. */
void hsr_splats_each(struct hsr_splats *splats,
                     void (*part)(struct hsr_splats *,
                                  struct hsr_splat_tile *));

/* --- For splat_frame.c ---------------------------------------------------- */

/* Samples to be drawn next, in sequence, are added to what this returns. When
 * it is full, or the visit ends, hsr_splats_close_batch draws them, at once or
 * later. `folds`: a slice ends. hsr_splats_flush draws what is left. */
struct hsr_splat_samples *hsr_splats_samples(const struct hsr_splats *splats);
void hsr_splats_close_batch(struct hsr_splats *splats, bool folds);
void hsr_splats_flush(struct hsr_splats *splats);

/* Whether how->is_hidden holds in all tiles that the box meets. False if there
 * is no such function. */
bool hsr_splats_is_hidden(const struct hsr_splats *splats, uint32_t opacity,
                          uint32_t energy, const struct hsr_window *box);

/* The last cell along an axis whose lower bound is not above the eye; -1:
 * none. */
int32_t hsr_splats_split(const struct hsr_splats *splats, int axis);

/* --- Tables --------------------------------------------------------------- */

/* W of kappa, which is from 0 to HSR_FOOTPRINT - 1: between the knots T of a
 * table that nowhere rises. */
static inline uint32_t hsr_splats_between(const uint16_t *knot, int kappa) {
  enum { EACH = HSR_FOOTPRINT / HSR_SPLAT_KNOTS };
  const uint16_t *T = knot + kappa / EACH;
  uint32_t twice = 2 * ((uint32_t)kappa % EACH) + 1;
  return T[0] - twice * (uint32_t)(T[0] - T[1]) / (2 * EACH);
}

/* Fills knot[], fall[] and weight[]. */
void hsr_splats_fill_weights(struct hsr_splats *splats);

/* Fills before[], the tables of the parts of a kernel (model volume). Each has
 * room for HSR_SPLAT_KNOTS + 1 numbers. */
void hsr_splats_fill_parts(struct hsr_splats *splats);

/* With opacity=length: makes length[], halved[] and lessened[]. HSR_E_NOMEM. */
enum hsr_status hsr_splats_open_lengths(struct hsr_splats *splats);

/* V of M, which may be greater than 2^20. */
enum { HSR_SPLAT_HALVED = 4096, HSR_SPLAT_LESSENED = 256 };
static inline uint32_t hsr_splats_veil(const struct hsr_splats *splats,
                                       uint64_t M) {
  const uint64_t most = HSR_SPLAT_HALVED * HSR_SPLAT_LESSENED - 1,
                 m = M < most ? M : most;
  const uint32_t H = splats->halved[m / HSR_SPLAT_LESSENED],
                 L = splats->lessened[m % HSR_SPLAT_LESSENED];
  return 65536 - H + (uint32_t)((uint64_t)H * L >> 16);
}

/* Fills light[]. */
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

/* A kept sample's own colour, without light. */
void hsr_splats_base(const struct hsr_splats *splats, uint32_t cell,
                     uint32_t base[HSR_SPLAT_OPACITY]);

/* The premultiplied colour of a kept sample of this opacity, and the
 * opacity. */
void hsr_splats_colour(const struct hsr_splats *splats, uint32_t cell,
                       uint32_t opacity,
                       uint16_t colour[HSR_SPLAT_OPACITY + 1]);

/* Sets `colour` of n splats, at most HSR_SPLAT_BATCH. */
void hsr_splats_shade(const struct hsr_splats *splats,
                      struct hsr_placed *placed, int n);

/* --- Places and weights --------------------------------------------------- */

/* hsr_splats_first_pixel: the first pixel in [from, to] whose middle is not
 * left of z. hsr_splats_end_pixel: the one after the last pixel whose middle is
 * not right of z. z is in pixels from the middle of pixel 0. */
static inline int32_t hsr_splats_first_pixel(double z, int32_t from,
                                             int32_t to) {
  double in = hsr_min(hsr_max(z, from), to);
  int32_t whole = (int32_t)in;
  return whole + (whole < in);
}
static inline int32_t hsr_splats_end_pixel(double z, int32_t from, int32_t to) {
  return (int32_t)hsr_min(hsr_max(z + 1, from), to);
}

/* Places and shades the splats of samples, at most HSR_SPLAT_BATCH. Returns how
 * many of them are in the window and not hidden: placed[]. */
int hsr_splats_place(struct hsr_splats *splats,
                     const struct hsr_splat_samples *samples,
                     struct hsr_placed placed[HSR_SPLAT_BATCH]);

/* Makes *clipped the part of a splat in a window. False if there is none. */
bool hsr_splats_clip(const struct hsr_splats *splats,
                     const struct hsr_placed *placed,
                     const struct hsr_window *window,
                     struct hsr_placed *clipped);

/* kappa rounded down, the index of weight[], for HSR_SPLAT_LANES pixels from x
 * on in row j; HSR_FOOTPRINT where the splat does not cover a pixel. */
void hsr_splats_find(const struct hsr_splats *splats,
                     const struct hsr_placed *placed, int x, int j,
                     int32_t index[HSR_SPLAT_LANES]);

/* The index of one pixel, in doubles or exactly. */
int hsr_splats_index(const struct hsr_splats *splats,
                     const struct hsr_placed *placed, int i, int j);

/* V' and D' of a pixel: V and D, divided by the cell's size, rounded. v and d
 * are the sums of the sizes of the terms: each component bounds 2^50 times the
 * error. */
struct hsr_splat_ray {
  double V[3], D[3], v[3], d[3];
};
struct hsr_splat_ray hsr_splats_ray(const struct hsr_splats *splats,
                                    const struct hsr_placed *placed, int i,
                                    int j);

/* If a splat is blurred: stretches it over the way that it went since the view
 * before. Finds Q, the energy and the box; g^2 is width^2 max(1, apart). */
void hsr_splats_stretch(struct hsr_splats *splats, struct hsr_placed *placed,
                        double apart);

/* hsr_splats_find, for a blurred splat. */
void hsr_splats_find_blurred(const struct hsr_splats *splats,
                             const struct hsr_placed *placed, int x, int j,
                             int32_t index[HSR_SPLAT_LANES]);

/* Adds s Q of a blurred splat in pixel (i, j) to V. Returns the bound of its
 * error. */
double hsr_splats_move(const struct hsr_splats *splats,
                       const struct hsr_placed *placed, int i, int j,
                       double V[3]);

/* The splat of the cell at these indices, as the exact services take it
 * (common/exact/footprint.h). */
struct hsr_splat hsr_splats_exact(const struct hsr_splats *splats,
                                  const uint32_t at[3]);

/* --- The picture ---------------------------------------------------------- */

/* The channels of the pixels of a tile, row after row: E of a picture, or sums
 * of D. To the right of each row there is room for the lanes, and below
 * the last one there are HSR_SPLAT_SPARE rows to spare.
 *
 * In E opacities stay below 65536. So do colours, which are not more than the
 * opacity. Of sums 65535 is the most that counts. With opacity=length sums have no
 * such limit. They have 32 bits then, which hold what 65,536 cells give, one behind
 * another in one sheet or bucket. Weights may be larger. */
struct hsr_splat_picture {
  const struct hsr_window *window; /* of the tile; borrowed */
  uint16_t (*rgba)[4];             /* NULL if there is `sum` */
  uint32_t (*sum)[4];              /* of all that was added; else NULL */
  uint64_t *weight;                /* the fifth channel, or NULL */
  size_t stride;                   /* pixels from a row to the next */
  size_t count;                    /* pixels in all */
};

/* Allocates a picture of a tile, all 0, from the job's scratch: one of E, with
 * weights if the option normalise is given; or one of sums of D, over which no
 * limit is, with M as the fifth channel if opacity=length is given. HSR_E_NOMEM. */
enum hsr_status hsr_splats_open(struct hsr_splats *splats,
                                const struct hsr_splat_tile *tile,
                                struct hsr_splat_picture *picture);
enum hsr_status hsr_splats_open_sums(struct hsr_splats *splats,
                                     const struct hsr_splat_tile *tile,
                                     struct hsr_splat_picture *picture);

/* Makes all of a picture 0. */
void hsr_splats_clear(struct hsr_splat_picture *picture);

/* Widens a part of the window by another one. */
static inline void hsr_splats_widen(struct hsr_window *w,
                                    const struct hsr_window *by) {
  w->x0 = by->x0 < w->x0 ? by->x0 : w->x0;
  w->y0 = by->y0 < w->y0 ? by->y0 : w->y0;
  w->x1 = by->x1 > w->x1 ? by->x1 : w->x1;
  w->y1 = by->y1 > w->y1 ? by->y1 : w->y1;
}

/* The part of a window that is widened first: none. */
static inline struct hsr_window hsr_splats_none(const struct hsr_window *w) {
  return (struct hsr_window){w->x1, w->y1, w->x0, w->y0};
}

/* The index of pixel (i, j) in a picture. */
static inline size_t hsr_splats_at(const struct hsr_splat_picture *picture,
                                   int i, int j) {
  return (size_t)(j - picture->window->y0) * picture->stride +
         (size_t)(i - picture->window->x0);
}

/* The fastest twin of hsr_splats_put for this machine; NULL: there is none. */
hsr_splats_putter *hsr_splats_twin(void);

/* Composites a splat into a picture. */
void hsr_splats_put(struct hsr_splats *splats, const struct hsr_placed *placed,
                    struct hsr_splat_picture *picture, enum hsr_splat_way way);

/* Its twins, for machines with AVX-512, and with AVX2 and fused products. */
#if defined __x86_64__ && HSR_HAVE_TARGET_CLONES && !HSR_COUNTING
#define HSR_SPLATS_HAVE_TWINS 1
hsr_splats_putter hsr_splats_put_avx512, hsr_splats_put_avx2;
/* For a twin that weighs several pixels together, `columns` of a row, from
 * pixel (x, j) on. Finds index[] in doubles or exactly for those whose bits are
 * set in `doubt`; the others keep what floats gave. HSR_FOOTPRINT beyond the
 * box. */
void hsr_splats_settle(const struct hsr_splats *splats,
                       const struct hsr_placed *placed, int x, int j,
                       int columns, unsigned doubt, uint32_t *index);
#else
#define HSR_SPLATS_HAVE_TWINS 0
#endif

/* Adds to pixel (i, j) of sums what a splat gives by this weight. */
void hsr_splats_add(struct hsr_splats *splats, const struct hsr_placed *placed,
                    struct hsr_splat_picture *picture, int i, int j,
                    uint32_t weight);

/* Composites sums over a picture of the same tile, in a part of it, and makes
 * the sums 0. */
void hsr_splats_fold(struct hsr_splats *splats, struct hsr_splat_picture *sums,
                     const struct hsr_window *where,
                     struct hsr_splat_picture *picture);

/* Puts a colour and its opacity over pixel `at` of E. */
void hsr_splats_put_over(struct hsr_splat_picture *picture, size_t at,
                         const uint16_t S[HSR_SPLAT_OPACITY + 1]);

/* Writes the answer of pixel (i, j), made of its channels E. */
void hsr_splats_write(struct hsr_splats *splats, int i, int j,
                      const uint64_t E[HSR_SPLAT_CHANNELS]);

/* Writes the answers of a tile. */
void hsr_splats_finish(struct hsr_splats *splats,
                       const struct hsr_splat_picture *picture);

#endif
