/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Volumes after those of J. E. Swan II, "Object-Order Rendering of Discrete
 * Objects", 1998: made ones, and real ones of Debian's packages. */
#include "common/files/image.h"
#include "common/files/volume/volume.h"
#include "common/grids/heights.h"
#include "scenes/builders.h"
#include "scenes/parts/shapes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Gives the scene its grid, which is moved. */
static enum hsr_status take_grid(struct hsr_scene *scene,
                                 enum hsr_status status,
                                 struct hsr_grid *grid) {
  hsr_palette_find("flat", &grid->palette);
  if (!status)
    status = hsr_scene_set_grid(scene, grid);
  hsr_grid_free(grid);
  return status;
}

/* --- The checker plane ---------------------------------------------------- */

enum { PLANE_X = 498, PLANE_Z = 398 };

static enum hsr_status full_slice(void *data, uint32_t k, float *density,
                                  struct hsr_error *err) {
  (void)data, (void)k, (void)err;
  for (int i = 0; i < PLANE_X; i++)
    density[i] = 1;
  return HSR_OK;
}

static void squares(void *data, const uint32_t at[3], float density,
                    float rgb[3]) {
  (void)data, (void)density;
  bool is_white = (at[0] / 10 + at[2] / 10) % 2;
  rgb[0] = is_white ? 0.8f : 0.05f;
  rgb[1] = rgb[2] = is_white ? 0.8f : 0.1f;
}

enum hsr_status hsr_build_checker_plane(struct hsr_scene *scene,
                                        const long long *parameter) {
  (void)parameter;
  static const struct hsr_grid_keep positive = {.least = 1, .most = INFINITY};
  static const double view[][8] = {
      {249, 40, 440, 249, 0, 200, 60},  {249, 12, 410, 249, 0, 300, 60},
      {-50, 60, -50, 249, 0, 199, 60},  {249, 500, 199.25, 249, 0, 199, 50},
      {249, 0, 450, 249, 0, 199, 40},   {100, 5, 200, 400, 0, 200, 90},
      {249, -80, 199, 300, 0, 210, 90}, {498, 20, 398, 0, 0, 0, 60}};
  double at[PLANE_X];
  for (int k = 0; k < PLANE_X; k++)
    at[k] = k;
  const struct hsr_grid_samples samples = {{PLANE_X, 1, PLANE_Z},
                                           {at, at, at},
                                           full_slice,
                                           squares,
                                           NULL,
                                           0,
                                           0,
                                           NULL};
  struct hsr_grid grid;
  enum hsr_status status = hsr_grid_init(&grid, &samples, &positive, NULL);
  status = take_grid(scene, status, &grid);
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  if (!status)
    HSR_VIEWS(&pen, view, 1);
  return status ? status : pen.status;
}

/* --- Terrain -------------------------------------------------------------- */

/* Over it and in it: from the side, a corner, low above a slope, from above. In
 * sides of the map; heights are in `up`. */
static void add_terrain_views(struct hsr_pen *pen, uint32_t n, uint32_t up) {
  static const double view[][7] = {
      {0.5, 1.6, 1.3, 0.5, 0, 0.4, 60},   {-0.2, 1.8, -0.2, 0.5, 0.2, 0.5, 60},
      {0.1, 1.1, 0.5, 0.9, 0.3, 0.5, 90}, {0.5, 6, 0.51, 0.5, 0, 0.5, 45},
      {1.4, 1.2, 0.5, 0.4, 0.4, 0.5, 50}, {0.5, 0.5, -0.4, 0.5, 0.5, 0.5, 60},
      {0.3, 1.3, 0.3, 0.6, 0.3, 0.9, 75}, {1.1, 2.2, 1.1, 0.3, 0, 0.3, 55}};
  for (size_t v = 0; v < sizeof view / sizeof *view; v++) {
    double eye[3], to[3];
    for (int a = 0; a < 3; a++) {
      eye[a] = view[v][a] * (a == 1 ? up : n);
      to[a] = view[v][3 + a] * (a == 1 ? up : n);
    }
    hsr_pen_view(pen, eye, to, view[v][6], 0);
  }
}

/* Diamonds and squares on a lattice of `side` + 1, a power of two and one. */
struct diamonds {
  int side;
  double *height;
  struct hsr_random random;
};

static double *place(struct diamonds *d, int x, int z) {
  return &d->height[(size_t)z * (size_t)(d->side + 1) + (size_t)x];
}

/* Sets a point to the mean of four around it, at (dx, dz), (-dz, dx) and so on,
 * as far as they are on the lattice, and moves it by up to `amount`. */
static void displace(struct diamonds *d, int x, int z, int dx, int dz,
                     double amount) {
  double sum = 0;
  int n = 0;
  for (int k = 0; k < 4; k++) {
    int turned = -dz;
    dz = dx;
    dx = turned;
    if (x + dx < 0 || x + dx > d->side || z + dz < 0 || z + dz > d->side)
      continue;
    sum += *place(d, x + dx, z + dz);
    n++;
  }
  *place(d, x, z) = sum / n + amount * (2 * hsr_random_unit(&d->random) - 1);
}

static void raise_terrain(struct diamonds *d, double roughness) {
  double amount = 1;
  for (int step = d->side; step > 1; step /= 2, amount *= roughness) {
    int half = step / 2;
    for (int z = half; z < d->side; z += step)
      for (int x = half; x < d->side; x += step)
        displace(d, x, z, half, half, amount);
    for (int z = 0; z <= d->side; z += half)
      for (int x = z / half % 2 ? 0 : half; x <= d->side; x += step)
        displace(d, x, z, half, 0, amount);
  }
}

/* Heights of the first n x n points, spread over `levels`. */
static void take_levels(struct diamonds *d, uint32_t n, uint32_t levels,
                        uint32_t *level) {
  double least = INFINITY, most = -INFINITY;
  for (uint32_t k = 0; k < n * n; k++) {
    double h = *place(d, (int)(k % n), (int)(k / n));
    least = fmin(least, h);
    most = fmax(most, h);
  }
  for (uint32_t k = 0; k < n * n; k++) {
    double h = *place(d, (int)(k % n), (int)(k / n));
    double share = most > least ? (h - least) / (most - least) : 0;
    level[k] = (uint32_t)(share * (levels - 1));
  }
}

enum hsr_status hsr_build_heights(struct hsr_scene *scene,
                                  const long long *parameter) {
  uint32_t n = (uint32_t)parameter[0], levels = n / 5 + 1;
  struct diamonds d = {.side = 1, .random = {(uint64_t)parameter[1]}};
  while ((uint32_t)d.side + 1 < n)
    d.side *= 2;
  d.height =
      calloc((size_t)(d.side + 1) * (size_t)(d.side + 1), sizeof *d.height);
  uint32_t *level = malloc((size_t)n * n * sizeof *level);
  struct hsr_grid grid = {.n_cells = 0};
  enum hsr_status status = d.height && level ? HSR_OK : HSR_E_NOMEM;
  if (!status) {
    raise_terrain(&d, 0.66);
    take_levels(&d, n, levels, level);
    const struct hsr_heights heights = {
        .n = {n, n}, .levels = levels, .level = level};
    status = hsr_heights_grid(&grid, &heights, NULL);
  }
  status = take_grid(scene, status, &grid);
  free(d.height);
  free(level);
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  if (!status)
    add_terrain_views(&pen, n, levels);
  return status ? status : pen.status;
}

/* --- Colorado ------------------------------------------------------------- */

/* The heights are bytes behind a header of 268; the photograph has their size.
 */
enum { MAP = 400, MAP_HEADER = 268 };

static enum hsr_status read_levels(const char *path, uint32_t *level) {
  FILE *in = fopen(path, "rb");
  if (!in)
    return HSR_E_INPUT;
  bool good = !fseek(in, MAP_HEADER, SEEK_SET);
  for (int k = 0; k < MAP * MAP && good; k++) {
    int byte = fgetc(in);
    good = byte != EOF;
    level[k] = (uint32_t)byte & 255;
  }
  fclose(in);
  return good ? HSR_OK : HSR_E_INPUT;
}

enum hsr_status hsr_build_colorado(struct hsr_scene *scene,
                                   const long long *parameter) {
  static const char folder[] = "/usr/share/dx/samples/data/";
  (void)parameter;
  char map[80], photograph[80];
  snprintf(map, sizeof map, "%scolorado_elev.vit", folder);
  snprintf(photograph, sizeof photograph, "%scolorado.tiff", folder);
  uint32_t *level = malloc(MAP * MAP * sizeof *level), size[2] = {0, 0};
  float *rgb = NULL;
  struct hsr_grid grid = {.n_cells = 0};
  enum hsr_status status = level ? read_levels(map, level) : HSR_E_NOMEM;
  if (!status)
    status = hsr_image_read(photograph, true, size, &rgb, NULL);
  if (!status && (size[0] != MAP || size[1] != MAP))
    status = HSR_E_INPUT;
  if (!status) {
    const struct hsr_heights heights = {
        .n = {MAP, MAP}, .levels = 256, .level = level, .rgb = rgb};
    status = hsr_heights_grid(&grid, &heights, NULL);
  }
  status = take_grid(scene, status, &grid);
  free(level);
  free(rgb);
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  if (!status)
    add_terrain_views(&pen, MAP, 256);
  return status ? status : pen.status;
}

/* --- Microtubules --------------------------------------------------------- */

enum { TUBE_X = 420, TUBE_Y = 468, TUBE_Z = 62, TUBES = 50 };

static enum hsr_status tube_slice(void *data, uint32_t k, float *density,
                                  struct hsr_error *err) {
  const unsigned char *inside = data;
  (void)err;
  size_t n = (size_t)TUBE_X * TUBE_Y;
  for (size_t c = 0; c < n; c++)
    density[c] = inside[k * n + c];
  return HSR_OK;
}

static void by_depth(void *data, const uint32_t at[3], float density,
                     float rgb[3]) {
  (void)data, (void)density;
  float share = (float)at[2] / TUBE_Z;
  rgb[0] = 0.1f + 0.6f * share;
  rgb[1] = 0.7f;
  rgb[2] = 0.5f - 0.4f * share;
}

/* All samples within `radius` of a point. */
static void fill_ball(unsigned char *inside, const double at[3],
                      double radius) {
  static const int n[3] = {TUBE_X, TUBE_Y, TUBE_Z};
  int lo[3], hi[3];
  for (int a = 0; a < 3; a++) {
    lo[a] = (int)fmax(0, ceil(at[a] - radius));
    hi[a] = (int)fmin(n[a] - 1, floor(at[a] + radius));
  }
  for (int z = lo[2]; z <= hi[2]; z++)
    for (int y = lo[1]; y <= hi[1]; y++)
      for (int x = lo[0]; x <= hi[0]; x++) {
        double dx = x - at[0], dy = y - at[1], dz = z - at[2];
        if (dx * dx + dy * dy + dz * dz <= radius * radius)
          inside[((size_t)z * TUBE_Y + (size_t)y) * TUBE_X + (size_t)x] = 1;
      }
}

/* A tube that wanders through the volume, mostly across z. */
static void fill_tube(unsigned char *inside, struct hsr_random *random) {
  static const int n[3] = {TUBE_X, TUBE_Y, TUBE_Z};
  double at[3], along[3], radius = 1.6 + 1.4 * hsr_random_unit(random);
  for (int a = 0; a < 3; a++) {
    at[a] = n[a] * hsr_random_unit(random);
    along[a] = (2 * hsr_random_unit(random) - 1) * (a == 2 ? 0.1 : 1);
  }
  for (int step = 0; step < 420; step++) {
    double length =
        sqrt(along[0] * along[0] + along[1] * along[1] + along[2] * along[2]);
    for (int a = 0; a < 3; a++) {
      at[a] += along[a] / length;
      if ((at[a] < 0 && along[a] < 0) || (at[a] > n[a] && along[a] > 0))
        along[a] = -along[a];
      along[a] = along[a] / length +
                 (a == 2 ? 0.01 : 0.06) * (2 * hsr_random_unit(random) - 1);
    }
    fill_ball(inside, at, radius);
  }
}

enum hsr_status hsr_build_tubules(struct hsr_scene *scene,
                                  const long long *parameter) {
  static const struct hsr_grid_keep positive = {.least = 1, .most = INFINITY};
  (void)parameter;
  struct hsr_random random = {1998};
  unsigned char *inside = calloc((size_t)TUBE_X * TUBE_Y * TUBE_Z, 1);
  double at[TUBE_Y];
  for (int k = 0; k < TUBE_Y; k++)
    at[k] = k;
  struct hsr_grid grid = {.n_cells = 0};
  enum hsr_status status = inside ? HSR_OK : HSR_E_NOMEM;
  if (!status) {
    for (int k = 0; k < TUBES; k++)
      fill_tube(inside, &random);
    const struct hsr_grid_samples samples = {{TUBE_X, TUBE_Y, TUBE_Z},
                                             {at, at, at},
                                             tube_slice,
                                             by_depth,
                                             inside,
                                             0,
                                             0,
                                             NULL};
    status = hsr_grid_init(&grid, &samples, &positive, NULL);
  }
  free(inside);
  return take_grid(scene, status, &grid);
}

/* --- Volumes of packages -------------------------------------------------- */

enum hsr_status hsr_build_brain(struct hsr_scene *scene,
                                const long long *parameter) {
  static const double stand[3][3] = {{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
  char name[200];
  memcpy(scene->stand, stand, sizeof stand); /* y runs from the crown down */
  snprintf(name, sizeof name,
           HSR_BRAIN_FILE ":size=128x128x84:offset=62:least=%lld",
           parameter[0]);
  return hsr_volume_read(scene, name, NULL, NULL);
}

enum hsr_status hsr_build_colin27(struct hsr_scene *scene,
                                  const long long *parameter) {
  char name[200];
  snprintf(name, sizeof name, HSR_COLIN27_FILE ":least=%lld", parameter[0]);
  return hsr_volume_read(scene, name, NULL, NULL);
}
