/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Volumes: the cells of a grid as opaque boxes. Cells share planes, edges and
 * corners with many others, and the views look along them and from them. */
#include "scenes/builders.h"
#include "scenes/parts/shapes.h"

#include <math.h>
#include <stdlib.h>

/* --- From samples to a scene ---------------------------------------------- */

/* Evenly spaced positions, or none for lack of memory. */
static double *even_positions(uint32_t n) {
  double *at = malloc(n * sizeof *at);
  for (uint32_t k = 0; at && k < n; k++)
    at[k] = k;
  return at;
}

static enum hsr_status add_grid(struct hsr_scene *scene,
                                const struct hsr_grid_samples *samples) {
  static const struct hsr_grid_keep positive = {.least = 1, .most = INFINITY};
  struct hsr_grid grid;
  enum hsr_status status = hsr_grid_init(&grid, samples, &positive, NULL);
  hsr_palette_find("flat", &grid.palette);
  if (!status)
    status = hsr_scene_set_grid(scene, &grid);
  hsr_grid_free(&grid);
  return status;
}

/* --- A hollow cube -------------------------------------------------------- */

/* After J. E. Swan II, "Object-Order Rendering of Discrete Objects", 1998,
 * figure 2.25: a hollow cube, one cell thick, of red and white blocks of 10 x
 * 10 x 10 cells; of 2 x 2 x 2 in a small one. */
static bool is_shell(uint32_t n, const uint32_t at[3]) {
  bool is_outside = false;
  for (int a = 0; a < 3; a++)
    is_outside |= at[a] == 0 || at[a] == n - 1;
  return is_outside;
}

static enum hsr_status shell_slice(void *data, uint32_t k, float *density,
                                   struct hsr_error *err) {
  (void)err;
  const uint32_t *n = data;
  for (uint32_t j = 0; j < *n; j++)
    for (uint32_t i = 0; i < *n; i++)
      *density++ = is_shell(*n, (const uint32_t[3]){i, j, k});
  return HSR_OK;
}

static void checkered(void *data, const uint32_t at[3], float density,
                      float rgb[3]) {
  (void)density;
  const uint32_t *n = data;
  uint32_t block = *n >= 20 ? 10 : 2;
  bool is_red = (at[0] / block + at[1] / block + at[2] / block) % 2;
  rgb[0] = is_red ? 0.6f : 0.8f;
  rgb[1] = rgb[2] = is_red ? 0.05f : 0.8f;
}

enum hsr_status hsr_build_checker_cube(struct hsr_scene *scene,
                                       const long long *parameter) {
  /* In sides of the cube, from its corner: the camera of figures 2.25 to 2.27,
   * across a corner, on an edge's line, inside, in planes of cells. */
  static const double view[][8] = {{0.25, 0.5, -0.25, 1.3, 0.6, 0.75, 100},
                                   {-0.8, 1.7, -1, 0.5, 0.5, 0.5, 60},
                                   {-1, 0.5, 0.5, 0.5, 0.5, 0.5, 60},
                                   {0.34, 0.5, 0.67, 0.44, 0.7, 1.67, 90},
                                   {0, 0, -0.5, 0.5, 0.5, 0.5, 80},
                                   {2, 0.5, 0.25, 0.5, 0.5, 0.25, 45},
                                   {0.5, 0.5, 0.5, 0.5, 0.5, 1.5, 120},
                                   {1.5, 1.5, 1.5, 0.5, 0.5, 0.5, 50}};
  uint32_t n = (uint32_t)parameter[0];
  double *at = even_positions(n);
  if (!at)
    return HSR_E_NOMEM;
  const struct hsr_grid_samples samples = {
      {n, n, n}, {at, at, at}, shell_slice, checkered, &n, 0, 0, NULL};
  enum hsr_status status = add_grid(scene, &samples);
  free(at);
  if (status)
    return status;
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  HSR_VIEWS(&pen, view, n);
  return pen.status;
}

/* --- A random grid -------------------------------------------------------- */

struct random_grid {
  uint32_t n;
  struct hsr_random random;
};

/* Two of five samples are kept, and the first in any case. */
static enum hsr_status random_slice(void *data, uint32_t k, float *density,
                                    struct hsr_error *err) {
  (void)err;
  struct random_grid *g = data;
  for (uint32_t c = 0; c < g->n * g->n; c++)
    *density++ = hsr_random_int(&g->random, 0, 4) < 2 || (k == 0 && c == 0);
  return HSR_OK;
}

static void by_place(void *data, const uint32_t at[3], float density,
                     float rgb[3]) {
  (void)density;
  const struct random_grid *g = data;
  for (int a = 0; a < 3; a++)
    rgb[a] = ((float)at[a] + 0.5f) / (float)g->n;
}

/* Positions a quarter to two apart, so that half ways are multiples of 1/8. */
static double *random_positions(struct random_grid *g, double *extent) {
  double *at = malloc(g->n * sizeof *at), x = 0;
  for (uint32_t k = 0; at && k < g->n; k++) {
    at[k] = x;
    x += hsr_random_int(&g->random, 1, 8) / 4.0;
  }
  if (at)
    *extent = at[g->n - 1];
  return at;
}

/* From each class of views: outside along no axis, one, two and three of them,
 * on planes of samples, and with the eye in a cell or in an empty one. */
static void add_views(struct hsr_pen *pen, const double extent[3],
                      double *const at[3], uint32_t n) {
  static const double eye[][3] = {{-1, 1.7, -1.2}, {0.5, 0.45, -1},
                                  {2, 0.3, 2},     {0.4, 0.6, 0.5},
                                  {-0.6, 0.5, 2},  {1.5, 1.5, 1.5}};
  double half[3];
  for (int a = 0; a < 3; a++)
    half[a] = extent[a] / 2;
  for (size_t v = 0; v < sizeof eye / sizeof *eye; v++) {
    double e[3], to[3];
    for (int a = 0; a < 3; a++) {
      e[a] = eye[v][a] * extent[a];
      to[a] = half[a] + (v == 3 ? (a + 1) * extent[a] / 4 : 0);
    }
    hsr_pen_view(pen, e, to, v == 3 ? 100 : 60, 0);
  }
  double e[3] = {at[0][n / 2], at[1][n / 3], -extent[2] - 1};
  hsr_pen_view(pen, e, (const double[3]){e[0], e[1], 0}, 60, 0);
  e[2] = at[2][n / 2];
  hsr_pen_view(pen, e, (const double[3]){e[0] + 1, e[1], e[2] + 1}, 90, 0.125);
}

enum hsr_status hsr_build_grid(struct hsr_scene *scene,
                               const long long *parameter) {
  struct random_grid g = {(uint32_t)parameter[0], {(uint64_t)parameter[1]}};
  double *at[3], extent[3] = {0};
  for (int a = 0; a < 3; a++)
    at[a] = random_positions(&g, &extent[a]);
  enum hsr_status status = HSR_E_NOMEM;
  if (at[0] && at[1] && at[2]) {
    const struct hsr_grid_samples samples = {{g.n, g.n, g.n},
                                             {at[0], at[1], at[2]},
                                             random_slice,
                                             by_place,
                                             &g,
                                             0,
                                             0};
    status = add_grid(scene, &samples);
  }
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  if (!status)
    add_views(&pen, extent, at, g.n);
  for (int a = 0; a < 3; a++)
    free(at[a]);
  return status ? status : pen.status;
}
