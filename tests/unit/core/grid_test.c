/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Grids: which samples are kept, which sides their cells have, and the numbers
 * of faces, against searches through the whole volume.
 *
 * usage: grid_test [SIDE]    also makes a grid of SIDE^3 samples, for its
 * memory */
#include "common/grids/grid.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

enum { MOST = 9, MOST_SAMPLES = MOST * MOST * MOST };

static uint64_t state = 5;

static int whole(int lo, int hi) {
  state = state * 6364136223846793005u + 1442695040888963407u;
  return lo + (int)((state >> 33) % (uint64_t)(hi - lo + 1));
}

/* --- Volumes -------------------------------------------------------------- */

struct volume {
  int n[3];
  double at[3][MOST];
  float density[MOST_SAMPLES];
  uint32_t next; /* the slice that must be asked for next */
  bool in_order;
};

static float density_of(const struct volume *v, int i, int j, int k) {
  return v->density[(k * v->n[1] + j) * v->n[0] + i];
}

static enum hsr_status give_slice(void *data, uint32_t k, float *density,
                                  struct hsr_error *err) {
  (void)err;
  struct volume *v = data;
  size_t size = (size_t)v->n[0] * (size_t)v->n[1];
  v->in_order &= k == v->next++;
  memcpy(density, v->density + k * size, size * sizeof *density);
  return HSR_OK;
}

static void make_volume(struct volume *v) {
  *v = (struct volume){.in_order = true};
  for (int a = 0; a < 3; a++) {
    v->n[a] = whole(1, MOST);
    double x = whole(-4, 4);
    for (int k = 0; k < v->n[a]; k++) {
      v->at[a][k] = x;
      x += whole(1, 8) / 4.0;
    }
  }
  for (int k = 0; k < v->n[0] * v->n[1] * v->n[2]; k++)
    v->density[k] = (float)whole(0, 9);
}

static enum hsr_status make_grid(struct volume *v,
                                 const struct hsr_grid_keep *keep,
                                 struct hsr_grid *grid, struct hsr_error *err) {
  struct hsr_grid_samples samples = {.slice = give_slice, .data = v};
  for (int a = 0; a < 3; a++) {
    samples.n[a] = (uint32_t)v->n[a];
    samples.position[a] = v->at[a];
  }
  v->next = 0;
  return hsr_grid_init(grid, &samples, keep, err);
}

/* --- What is kept --------------------------------------------------------- */

static bool is_within(const struct volume *v, const int at[3]) {
  for (int a = 0; a < 3; a++)
    if (at[a] < 0 || at[a] >= v->n[a])
      return false;
  return true;
}

static double slope(const struct volume *v, const int at[3], int axis) {
  int low[3] = {at[0], at[1], at[2]}, high[3] = {at[0], at[1], at[2]};
  low[axis]--;
  high[axis]++;
  if (!is_within(v, low))
    low[axis]++;
  if (!is_within(v, high))
    high[axis]--;
  double width = v->at[axis][high[axis]] - v->at[axis][low[axis]];
  double rise = density_of(v, high[0], high[1], high[2]) -
                density_of(v, low[0], low[1], low[2]);
  return width > 0 ? rise / width : 0;
}

static bool should_keep(const struct volume *v, const struct hsr_grid_keep *k,
                        const int at[3]) {
  if (!is_within(v, at))
    return false;
  double d = density_of(v, at[0], at[1], at[2]);
  double x = slope(v, at, 0), y = slope(v, at, 1), z = slope(v, at, 2);
  return d >= k->least && d <= k->most &&
         sqrt(x * x + y * y + z * z) >= k->gradient;
}

/* How many cells, sides or numbers of faces are not as they should be. */
static long faults_of(const struct volume *v, const struct hsr_grid_keep *keep,
                      const struct hsr_grid *grid) {
  long faults = 0;
  uint32_t cell = 0, face = 0;
  for (int k = 0; k < v->n[2]; k++)
    for (int j = 0; j < v->n[1]; j++)
      for (int i = 0; i < v->n[0]; i++) {
        int at[3] = {i, j, k};
        uint32_t here[3] = {(uint32_t)i, (uint32_t)j, (uint32_t)k}, found[3];
        if (!should_keep(v, keep, at)) {
          faults += hsr_grid_cell(grid, here) != UINT32_MAX;
          continue;
        }
        if (hsr_grid_cell(grid, here) != cell)
          return faults + 1;
        hsr_grid_place(grid, cell, found);
        faults += memcmp(found, here, sizeof here) != 0;
        faults += hsr_grid_first_face(grid, cell) != face;
        for (int side = 0; side < 6; side++) {
          int beyond[3] = {i, j, k};
          beyond[side / 2] += side % 2 ? 1 : -1;
          bool exists = keep->all_sides || !should_keep(v, keep, beyond);
          if (exists != (grid->sides[cell] >> side & 1))
            return faults + 1;
          uint32_t its;
          int which;
          if (!exists)
            continue;
          hsr_grid_face(grid, face, &its, &which);
          faults += its != cell || which != side;
          face++;
        }
        cell++;
      }
  return faults + (cell != grid->n_cells) + (face != grid->n_faces);
}

static void check_random(struct tap *tap) {
  long faults = 0, cells = 0, faces = 0, empty = 0;
  bool in_order = true;
  for (int k = 0; k < 400; k++) {
    struct volume v;
    struct hsr_grid grid;
    struct hsr_error err;
    make_volume(&v);
    struct hsr_grid_keep keep = {.least = whole(0, 9),
                                 .most = whole(0, 1) ? INFINITY : 7,
                                 .gradient = whole(0, 2),
                                 .all_sides = whole(0, 4) == 0};
    enum hsr_status status = make_grid(&v, &keep, &grid, &err);
    if (status == HSR_E_INPUT && strstr(err.text, "no sample"))
      empty++;
    else
      faults += status ? 1 : faults_of(&v, &keep, &grid);
    in_order &= v.in_order;
    cells += grid.n_cells;
    faces += grid.n_faces;
    hsr_grid_free(&grid);
  }
  ok(tap, !faults && cells > 10000 && empty > 0,
     "400 grids, %ld of them empty: of %ld cells and %ld faces %ld are wrong",
     empty, cells, faces, faults);
  ok(tap, in_order, "each slice is read once, in order");
}

/* --- Boxes ---------------------------------------------------------------- */

/* The corners of all sides lie on the cell's box, in a square that turns about
 * the axis outwards. */
static void check_corners(struct tap *tap) {
  struct volume v;
  struct hsr_grid grid;
  struct hsr_error err;
  struct hsr_grid_keep all = {.least = 0, .most = INFINITY};
  long wrong = 0;
  make_volume(&v);
  if (make_grid(&v, &all, &grid, &err))
    exit(99);
  for (uint32_t cell = 0; cell < grid.n_cells; cell++) {
    uint32_t at[3];
    hsr_grid_place(&grid, cell, at);
    for (int side = 0; side < 6; side++) {
      double p[4][3], out[3] = {0}, size[3];
      hsr_grid_corners(&grid, at, side, p);
      for (int k = 0; k < 4; k++) {
        const double *a = p[k], *b = p[(k + 1) % 4];
        for (int c = 0; c < 3; c++) {
          int d = (c + 1) % 3, e = (c + 2) % 3;
          out[c] += (a[d] * b[e] - a[e] * b[d]) / 2;
        }
      }
      for (int c = 0; c < 3; c++)
        size[c] = grid.bound[c][at[c] + 1] - grid.bound[c][at[c]];
      int axis = side / 2;
      double area = size[(axis + 1) % 3] * size[(axis + 2) % 3];
      for (int c = 0; c < 3; c++)
        wrong += fabs(out[c] - (c != axis  ? 0
                                : side % 2 ? area
                                           : -area)) > 1e-12 * area;
      wrong += p[0][axis] != grid.bound[axis][at[axis] + (uint32_t)side % 2];
    }
  }
  ok(tap, !wrong, "%u cells: all sides turn outwards", grid.n_cells);
  hsr_grid_free(&grid);
}

static void check_bounds(struct tap *tap) {
  struct volume v = {.n = {3, 1, 2}, .at = {{0, 1, 3}, {5}, {-1, 1}}};
  struct hsr_grid grid;
  struct hsr_error err;
  struct hsr_grid_keep all = {.least = 0, .most = INFINITY};
  if (make_grid(&v, &all, &grid, &err))
    exit(99);
  const double *x = grid.bound[0], *y = grid.bound[1], *z = grid.bound[2];
  ok(tap,
     x[0] == -0.5 && x[1] == 0.5 && x[2] == 2 && x[3] == 4 && y[0] == 4.5 &&
         y[1] == 5.5 && z[0] == -2 && z[1] == 0 && z[2] == 2,
     "cells reach half way to their neighbours");
  ok(tap, grid.n_cells == 6 && grid.n_faces == 22,
     "6 cells in a block have %u sides outside", grid.n_faces);
  hsr_grid_free(&grid);
  v.at[0][2] = 1;
  ok(tap,
     make_grid(&v, &all, &grid, &err) == HSR_E_INPUT &&
         strstr(err.text, "along x"),
     "%s", err.text);
  hsr_grid_free(&grid);
}

/* --- A large one, by hand ------------------------------------------------- */

struct shell {
  uint32_t n;
};

/* A sphere of density 1 - r/R, of which a thin shell is kept. */
static enum hsr_status shell_slice(void *data, uint32_t k, float *density,
                                   struct hsr_error *err) {
  (void)err;
  const struct shell *s = data;
  double middle = (s->n - 1) / 2.0, z = k - middle;
  for (uint32_t j = 0; j < s->n; j++)
    for (uint32_t i = 0; i < s->n; i++) {
      double x = i - middle, y = j - middle;
      *density++ = (float)(1 - (x * x + y * y + z * z) / (middle * middle));
    }
  return HSR_OK;
}

static int make_large(uint32_t n) {
  struct shell shell = {n};
  struct hsr_grid grid;
  struct hsr_error err;
  double *at = malloc(n * sizeof *at);
  for (uint32_t k = 0; at && k < n; k++)
    at[k] = k;
  struct hsr_grid_samples samples = {
      {n, n, n}, {at, at, at}, shell_slice, NULL, &shell};
  struct hsr_grid_keep keep = {.least = 0.2, .most = 0.2 + 12.0 / n};
  if (hsr_grid_init(&grid, &samples, &keep, &err)) {
    puts(err.text);
    return 1;
  }
  struct rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  printf("%u^3 samples, %u cells, %u faces: %ld MB\n", n, grid.n_cells,
         grid.n_faces, usage.ru_maxrss / 1024);
  hsr_grid_free(&grid);
  free(at);
  return 0;
}

int main(int argc, char **argv) {
  if (argc > 1)
    return make_large((uint32_t)strtoul(argv[1], NULL, 10));
  struct tap tap = plan(6);
  check_random(&tap);
  check_corners(&tap);
  check_bounds(&tap);
  return finish(&tap);
}
