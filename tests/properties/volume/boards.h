/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checkered planes, as in figure 3.6 of Swan's thesis, what is right of them, and
 * how far pictures are from it. Any failure ends the test program. */
#ifndef HSR_TESTS_BOARDS_H
#define HSR_TESTS_BOARDS_H

#include "bench/modules/variant.h"
#include "tests/properties/volume/splatting.h"

#define PI 3.14159265358979323846
enum { ONE = 65536, WHITE = 65535 };
#define REACH 1.556228 /* of Crawfis and Max's kernel */

/* As calloc. */
void *room(size_t n, size_t size);

/* --- Grids ---------------------------------------------------------------- */

/* Samples at equal distances along each axis. */
struct lattice {
  int n[3];
  double from[3], apart[3];
  int opacity;
  const float *density;
  const float (*rgb)[3];
};
void open_lattice(struct stage *stage, const struct lattice *lattice);

/* --- Pictures ------------------------------------------------------------- */

struct picture {
  int m, n;
  uint16_t *rgba;
  float *work; /* splats in each pixel */
  struct hsr_tally tally;
};
struct picture take(const struct stage *stage, const struct hsr_view *view,
                    const struct hsr_variant *made);
void drop(struct picture *picture);

/* The grey of a pixel by its opacity, which with normalise is that of the
 * splats' weights. */
double grey_at(const struct picture *picture, size_t k, bool normalised);

/* --- The checker plane ---------------------------------------------------- */

enum {
  PLANE_X = 498,
  PLANE_Z = 398,
  BLOCK = 10,
  BOARD_M = 260,
  BOARD_N = 150,
  BOARD = BOARD_M * BOARD_N
};

/* A camera above the plane y = 0 looks along z, level. */
struct board {
  double half_angle, height, near_z; /* of the first row */
};
void open_board(struct stage *stage, const struct board *board, int opacity);

/* Whether the plane is white at a place within its rim. */
bool is_white_at(const struct board *board, double x, double z);

struct hsr_view board_view(const struct board *board, double x);

/* k: where cells are as large as pixels. */
double depth_of_k(const struct hsr_view *view);

/* D of a pixel. */
void direction_at(const struct hsr_view *view, int i, int j, double D[3]);

/* Whether the ray of a pixel meets the plane farther than `margin` from its
 * rim, and at which depth. */
bool meets_board(const struct hsr_view *view, const struct board *board, int i,
                 int j, double margin, double *depth);

/* --- What is right -------------------------------------------------------- */

/* The plane as a continuous function, filtered: colour times kernel over
 * kernel, both integrated over the plane. */
struct filtered {
  double colour[BOARD], weight[BOARD];
};

/* Before the first plane is filtered. */
void fill_footprint(void);
void filter_board(struct filtered *filtered, const struct board *board,
                  const struct hsr_view *view);

/* The mean square error beyond k. */
double board_error(const struct picture *picture, const struct board *board,
                   const struct hsr_view *view, const struct filtered *right,
                   bool normalised);

#endif
