/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tests/properties/volume/boards.h"
#include "tests/tap.h"
#include "bench/modules/variant.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void *room(size_t n, size_t size) {
  void *memory = calloc(n, size);
  if (!memory)
    bail("out of memory");
  return memory;
}

/* --- Grids ---------------------------------------------------------------- */

void open_lattice(struct stage *s, const struct lattice *l) {
  struct hsr_palette palette = plain_palette(l->opacity, WHITE);
  palette.own_colours = true;
  struct field field = {.density = l->density,
                        .rgb = l->rgb,
                        .keep = {.least = 1, .most = INFINITY},
                        .palette = &palette};
  double *at[3];
  for (int a = 0; a < 3; a++) {
    at[a] = room((size_t)l->n[a], sizeof *at[a]);
    for (int k = 0; k < l->n[a]; k++)
      at[a][k] = l->from[a] + k * l->apart[a];
    field.n[a] = (uint32_t)l->n[a];
    field.at[a] = at[a];
  }
  open_stage(s, &field);
  for (int a = 0; a < 3; a++)
    free(at[a]);
}

/* --- Pictures ------------------------------------------------------------- */

struct picture take(const struct stage *s, const struct hsr_view *v,
                    const struct hsr_variant *made) {
  size_t n = (size_t)v->m * (size_t)v->n;
  struct picture p = {v->m,
                      v->n,
                      room(4 * n, sizeof(uint16_t)),
                      room(n, sizeof(float)),
                      {.out_of_memory = false}};
  p.tally.work = p.work;
  p.tally.work_stride = (size_t)v->m;
  draw_splats(s, v, made, COUNTING, NULL, 0, p.rgba, &p.tally);
  return p;
}

void drop(struct picture *p) {
  free(p->rgba);
  free(p->work);
}

double grey_at(const struct picture *p, size_t k, bool normalised) {
  double grey = p->rgba[4 * k], opacity = p->rgba[4 * k + 3];
  return normalised ? grey / WHITE : opacity > 0 ? grey / opacity : 0;
}

/* --- The checker plane ---------------------------------------------------- */

static bool is_white(int i, int k) {
  return (i / BLOCK + k / BLOCK) % 2;
}

/* Where sample i, k of the plane is. */
static double place_x(int i) {
  return i - (PLANE_X - 1) / 2.0;
}

bool is_white_at(const struct board *b, double x, double z) {
  return is_white((int)floor(x - place_x(0) + 0.5),
                  (int)floor(z - b->near_z + 0.5));
}

void open_board(struct stage *s, const struct board *b, int opacity) {
  float(*rgb)[3] = room((size_t)PLANE_X * PLANE_Z, sizeof *rgb);
  for (int k = 0; k < PLANE_Z; k++)
    for (int i = 0; i < PLANE_X; i++)
      for (int c = 0; c < 3; c++)
        rgb[k * PLANE_X + i][c] = is_white(i, k);
  open_lattice(s, &(struct lattice){.n = {PLANE_X, 1, PLANE_Z},
                                    .from = {place_x(0), 0, b->near_z},
                                    .apart = {1, 1, 1},
                                    .opacity = opacity,
                                    .rgb = (const float(*)[3])rgb});
  free(rgb);
}

struct hsr_view board_view(const struct board *b, double x) {
  const double up = tan(b->half_angle * PI / 180) * BOARD_N / BOARD_M;
  const struct hsr_camera camera = {.eye = {x, b->height, 0},
                                    .at = {x, b->height, 1},
                                    .up = {0, 1, 0},
                                    .fov = 360 / PI * atan(up)};
  return splat_view(&camera, BOARD_M, BOARD_N);
}

double depth_of_k(const struct hsr_view *v) {
  return v->n / (2 * fabs(v->U[1]));
}

void direction_at(const struct hsr_view *v, int i, int j, double D[3]) {
  for (int a = 0; a < 3; a++)
    D[a] = v->ray[0][a] + hsr_sample_x(v, i) * v->ray[1][a] +
           hsr_sample_y(v, j) * v->ray[2][a];
}

bool meets_board(const struct hsr_view *v, const struct board *b, int i, int j,
                 double margin, double *depth) {
  double D[3];
  direction_at(v, i, j, D);
  *depth = -b->height / D[1]; /* as D . F = 1 */
  return D[1] < 0 && *depth > b->near_z + margin &&
         *depth < b->near_z + PLANE_Z - 1 - margin &&
         fabs(v->E[0] + *depth * D[0]) < place_x(PLANE_X - 1) - margin;
}

/* --- What is right -------------------------------------------------------- */

/* The footprint of the spline by the square of the distance, from 0 to r^2:
 * integrated along the line by the rule of Simpson. */
enum { ENTRIES = 4096 };
static double footprint[ENTRIES + 2];

static double spline(double x) {
  double y = REACH - x;
  return x <= 0.88 ? 0.557526 - 1.157744 * x * x + 0.671033 * x * x * x
         : y > 0   ? 0.067599 * y * y + 0.282474 * y * y * y
                   : 0;
}

void fill_footprint(void) {
  enum { STEPS = 400 };
  for (int k = 0; k <= ENTRIES; k++) {
    double rho2 = REACH * REACH * k / ENTRIES,
           t = sqrt(fmax(0, REACH * REACH - rho2)), sum = 0;
    for (int s = 0; s <= STEPS; s++) {
      double x = t * s / STEPS, h = spline(sqrt(rho2 + x * x));
      sum += h * (s == 0 || s == STEPS ? 1 : s % 2 ? 4 : 2);
    }
    footprint[k] = 2 * sum * t / STEPS / 3;
  }
}

static double footprint_at(double rho2) {
  double at = rho2 * (ENTRIES / (REACH * REACH));
  int k = (int)at;
  return at >= ENTRIES
             ? 0
             : footprint[k] + (at - k) * (footprint[k + 1] - footprint[k]);
}

/* Adds a point of the plane to all pixels that its kernel reaches. The kernel
 * is as wide as that of an anti-aliased splat there. On the screen it reaches
 * less far than r g |V| / t^2 times k, twice over for its slant. */
static void add_point(struct filtered *f, const struct hsr_view *v, double k,
                      const double V[3], double colour) {
  double t = V[2], VV = V[0] * V[0] + V[1] * V[1] + V[2] * V[2];
  double g2 = fmax(1, t * t / (k * k)), slant = VV / (t * t);
  double x = BOARD_M / 2.0 + V[0] / t * v->m / (2 * v->R[0]),
         y = BOARD_N / 2.0 - V[1] / t * v->n / (2 * v->U[1]),
         reach = 1 + REACH * sqrt(g2) * k / t * slant;
  int i0 = (int)fmax(0, floor(x - reach)),
      i1 = (int)fmin(BOARD_M, ceil(x + reach)),
      j0 = (int)fmax(0, floor(y - reach)),
      j1 = (int)fmin(BOARD_N, ceil(y + reach));
  for (int j = j0; j < j1; j++)
    for (int i = i0; i < i1; i++) {
      double D[3];
      direction_at(v, i, j, D);
      double VD = V[0] * D[0] + V[1] * D[1] + V[2] * D[2],
             DD = D[0] * D[0] + D[1] * D[1] + D[2] * D[2],
             rho2 = VV * (VV * DD - VD * VD) / (VD * VD),
             weight = footprint_at(rho2 / g2) / g2;
      f->colour[j * BOARD_M + i] += weight * colour;
      f->weight[j * BOARD_M + i] += weight;
    }
}

/* 3 x 3 points a cell, none on the edge of a square, and none so near that it
 * would not count beyond k. */
void filter_board(struct filtered *f, const struct board *b,
                  const struct hsr_view *v) {
  enum { PARTS = 3 };
  double k = depth_of_k(v);
  memset(f, 0, sizeof *f);
  for (int row = 0; row < PARTS * PLANE_Z; row++) {
    double z = b->near_z + (row + 0.5) / PARTS - 0.5;
    if (z < k - 30)
      continue;
    for (int column = 0; column < PARTS * PLANE_X; column++) {
      double V[3] = {place_x(0) + (column + 0.5) / PARTS - 0.5 - v->E[0],
                     -b->height, z};
      add_point(f, v, k, V, is_white(column / PARTS, row / PARTS));
    }
  }
}

double board_error(const struct picture *p, const struct board *b,
                   const struct hsr_view *v, const struct filtered *right,
                   bool normalised) {
  double sum = 0, depth;
  long n = 0;
  for (int j = 0; j < BOARD_N; j++)
    for (int i = 0; i < BOARD_M; i++) {
      size_t k = (size_t)(j * BOARD_M + i);
      if (!meets_board(v, b, i, j, 0, &depth) || depth <= depth_of_k(v))
        continue;
      double off =
          grey_at(p, k, normalised) - right->colour[k] / right->weight[k];
      sum += off * off;
      n++;
    }
  return sum / (double)n;
}
