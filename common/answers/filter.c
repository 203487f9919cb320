/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/answers/filter.h"
#include "common/view/picture.h"
#include "common/scene/pieces.h"

#include <math.h>

enum { BITS = HSR_SUB * HSR_SUB };

/* --- Weights -------------------------------------------------------------- */

/* The distance of a sub-sample's middle from the middle of the pixel `to`
 * pixels away, in sixteenths of a pixel: odd, so never 0. */
static int sixteenths(int place, int to) {
  return 2 * place + 1 - HSR_SUB - 2 * HSR_SUB * to;
}

/* The cosine hump, with r and its radius in sixteenths of a pixel. */
static double hump(int x, int y) {
  const double pi = 3.14159265358979323846, one = 2 * HSR_SUB;
  double square = (double)(x * x + y * y);
  return square < one * one ? (1 + cos(pi * sqrt(square) / one)) / 2 : 0;
}

static double hump_at(int dx, int dy, int bit) {
  return hump(sixteenths(bit % HSR_SUB, dx), sixteenths(bit / HSR_SUB, dy));
}

/* After scaling, the fraction of no weight is within 0.03 of a half. So every
 * machine rounds it alike, whatever the last places of its cosine are. x and y
 * are never 0, so the weights come in fours, (+-x, +-y). The sum of the rounded
 * weights is a multiple of 4, as is the whole weight. The four weights in the
 * middle share the rest evenly. */
static void init_cosine(struct hsr_kernel *kernel) {
  double sum = 0;
  uint32_t rounded = 0;
  for (int k = 0; k < 9 * BITS; k++)
    sum += hump_at(k / BITS % 3 - 1, k / BITS / 3 - 1, k % BITS);
  for (int k = 0; k < 9 * BITS; k++) {
    int dx = k / BITS % 3 - 1, dy = k / BITS / 3 - 1, bit = k % BITS;
    double part = hump_at(dx, dy, bit) / sum;
    uint32_t weight = (uint32_t)floor(part * HSR_WHOLE_WEIGHT + 0.5);
    kernel->weight[dy + 1][dx + 1][bit] = weight;
    rounded += weight;
  }
  for (int k = 0; k < 4; k++) {
    int a = HSR_SUB / 2 - 1 + k % 2, b = HSR_SUB / 2 - 1 + k / 2;
    kernel->weight[1][1][HSR_SUB * b + a] += (HSR_WHOLE_WEIGHT - rounded) / 4;
  }
}

/* The pixels are the lines of one field, at every other line of a frame, whose
 * lines are half as high. 1-4-6-4-1 are the weights of five lines of the frame;
 * each is the box of its 4 rows of sub-samples. */
static uint32_t tap(int y) {
  int line = ((y < 0 ? -y : y) + HSR_SUB / 2) / HSR_SUB;
  return line == 0 ? 6 : line == 1 ? 4 : line == 2 ? 1 : 0;
}

static void init_field(struct hsr_kernel *kernel) {
  uint32_t unit = HSR_WHOLE_WEIGHT / (16 * HSR_SUB * HSR_SUB / 2);
  for (int k = 0; k < 3 * BITS; k++) {
    int dy = k / BITS - 1, bit = k % BITS;
    kernel->weight[dy + 1][1][bit] = unit * tap(sixteenths(bit / HSR_SUB, dy));
  }
}

static void init_rows(struct hsr_kernel *kernel) {
  for (int k = 0; k < 9 * BITS; k++) {
    int b = k % BITS / HSR_SUB, a = k % HSR_SUB;
    uint32_t *row = kernel->row[k / BITS / 3][k / BITS % 3][b];
    uint32_t weight = kernel->weight[k / BITS / 3][k / BITS % 3][k % BITS];
    for (unsigned byte = 0; byte < 256; byte++)
      row[byte] += byte >> a & 1 ? weight : 0;
  }
}

void hsr_kernel_init(struct hsr_kernel *kernel, enum hsr_filter filter) {
  *kernel = (struct hsr_kernel){.reach = filter == HSR_FILTER_COSINE ||
                                         filter == HSR_FILTER_FIELD,
                                .cells = hsr_filter_cells(filter),
                                .columns = hsr_filter_columns(filter),
                                .rows = hsr_filter_rows(filter),
                                .all = hsr_filter_all(filter)};
  int n = kernel->cells * kernel->cells * kernel->rows * kernel->columns;
  uint32_t equal = HSR_WHOLE_WEIGHT / (uint32_t)n;
  if (filter == HSR_FILTER_COSINE)
    init_cosine(kernel);
  else if (filter == HSR_FILTER_FIELD)
    init_field(kernel);
  else
    for (int bit = 0; filter && bit < BITS; bit++)
      kernel->weight[1][1][bit] = kernel->all >> bit & 1 ? equal : 0;
  init_rows(kernel);
}

/* --- Jitter --------------------------------------------------------------- */

/* A permutation of the numbers of 32 bits that scatters them. */
static uint32_t scatter(uint32_t number) {
  number = (number ^ number >> 16) * 0x85ebca6bu;
  number = (number ^ number >> 13) * 0xc2b2ae35u;
  return number ^ number >> 16;
}

/* One of 16 places on a line. */
static double place(uint32_t random) {
  return (2 * (int)(random % 16) - 15) / 32.0;
}

void hsr_jitter_init(struct hsr_jitter *jitter, int pattern) {
  for (int bit = 0; bit < BITS; bit++) {
    uint32_t random = scatter((uint32_t)(BITS * pattern + bit + 1));
    jitter->x[bit] = place(random);
    jitter->y[bit] = place(random >> 16);
  }
}

int hsr_jitter_pattern(const struct hsr_filtering *filtering, int i, int j) {
  if (!filtering->patterns)
    return -1;
  uint64_t random = scatter((uint32_t)j * HSR_MAX_SIZE + (uint32_t)i + 1);
  return (int)(random * (uint64_t)filtering->patterns >> 32);
}

/* All sums and quotients are exact: multiples of 1/256 below 8. Of cells that
 * are not pixels, the view is of 8 m x 8 n of them. */
struct hsr_view hsr_subsample_view(const struct hsr_view *view,
                                   enum hsr_filter filter, int pattern,
                                   int bit) {
  int columns = hsr_filter_columns(filter), rows = hsr_filter_rows(filter);
  struct hsr_jitter jitter = {.x = {0}};
  if (pattern >= 0)
    hsr_jitter_init(&jitter, pattern);
  int cells = hsr_filter_cells(filter);
  struct hsr_view moved =
      cells > 1 ? hsr_view_finer(view, cells, cells) : *view;
  moved.offset_x = (bit % HSR_SUB + 0.5 + jitter.x[bit]) / columns - 0.5;
  moved.offset_y = (bit / HSR_SUB + 0.5 + jitter.y[bit]) / rows - 0.5;
  return moved;
}

/* --- Colours -------------------------------------------------------------- */

/* Rounds a value to 16 bits, after clamping it to 0..1. */
static uint16_t in_16_bits(float value) {
  double inside = fmin(fmax((double)value, 0), 1);
  return (uint16_t)floor(inside * 65535 + 0.5);
}

static bool is_face(const struct hsr_world *world, uint32_t id) {
  if (world->pieces)
    world = world->pieces->whole;
  return id < world->roster.first[world->roster.scene->n_instances];
}

/* Depends on the scene alone, so that every form of the world gives the same
 * colour. */
void hsr_filter_colour(const struct hsr_world *world,
                       const struct hsr_view *view, uint32_t id,
                       uint16_t rgb[3]) {
  float colour[3] = {0, 0, 0};
  if (id == HSR_BACKGROUND) {
    hsr_picture_colour(world, view, id, HSR_SHADE_LAMBERT, colour);
  } else if (is_face(world, id)) {
    double normal[3], anchor[3];
    struct hsr_place at = hsr_place_of(world, id);
    hsr_place_plane(world, at, normal, anchor);
    float light = hsr_picture_light(view, normal, anchor);
    const float *own = at.object->rgb ? at.object->rgb + 3 * (size_t)at.face
                                      : at.object->colour;
    for (int c = 0; c < 3; c++)
      colour[c] = own[c] * light;
  }
  for (int c = 0; c < 3; c++)
    rgb[c] = in_16_bits(colour[c]);
}

/* A cache of the colours of faces. */
enum { KEPT = 1024 };
struct colours {
  const struct hsr_world *world;
  const struct hsr_view *view;
  struct {
    uint32_t id;
    uint16_t rgb[3];
  } kept[KEPT]; /* face id is at id % KEPT */
};

/* Empties the cache: every place gets the id of a face that belongs to another
 * place. */
static void colours_init(struct colours *colours, const struct hsr_world *world,
                         const struct hsr_view *view) {
  colours->world = world;
  colours->view = view;
  for (uint32_t k = 0; k < KEPT; k++)
    colours->kept[k].id = k + 1;
}

static const uint16_t *colour_of(struct colours *colours, uint32_t id) {
  uint32_t k = id % KEPT;
  if (colours->kept[k].id != id) {
    colours->kept[k].id = id;
    hsr_filter_colour(colours->world, colours->view, id, colours->kept[k].rgb);
  }
  return colours->kept[k].rgb;
}

/* --- Sums ----------------------------------------------------------------- */

static uint32_t weight_of(const uint32_t row[HSR_SUB][256], uint64_t mask) {
  uint32_t weight = 0;
  for (int b = 0; b < HSR_SUB; b++)
    weight += row[b][mask >> (HSR_SUB * b) & 255];
  return weight;
}

static bool is_within(int m, int n, int i, int j) {
  return i >= 0 && i < m && j >= 0 && j < n;
}

/* Adds a weighted colour to pixel (i, j), if there is such a pixel. */
static void add(int m, int n, int i, int j, uint32_t weight,
                const uint16_t rgb[3], uint32_t *sums) {
  if (!weight || !is_within(m, n, i, j))
    return;
  uint32_t *sum = sums + 3 * ((size_t)j * (size_t)m + (size_t)i);
  for (int c = 0; c < 3; c++)
    sum[c] += weight * rgb[c];
}

void hsr_filter_add(const struct hsr_kernel *kernel, int m, int n, int i, int j,
                    uint64_t mask, const uint16_t rgb[3], uint32_t *sums) {
  for (int dy = -kernel->reach; dy <= kernel->reach; dy++)
    for (int dx = -kernel->reach; dx <= kernel->reach; dx++)
      add(m, n, i + dx, j + dy, weight_of(kernel->row[dy + 1][dx + 1], mask),
          rgb, sums);
}

/* Copies the ids of the pixel whose first sub-sample is at `corner`, to the
 * places of their bits. Whether they are all one face, as in most pixels. */
static bool gather(const uint32_t *corner, size_t stride,
                   const struct hsr_kernel *kernel, uint32_t id[BITS]) {
  uint32_t differ = 0;
  for (int b = 0; b < kernel->rows; b++)
    for (int a = 0; a < kernel->columns; a++) {
      uint32_t face = corner[(size_t)b * stride + (size_t)a];
      id[HSR_SUB * b + a] = face;
      differ |= face ^ *corner;
    }
  return !differ;
}

/* The mask of the sub-samples that show a face. */
static uint64_t mask_of(const uint32_t id[BITS], uint32_t face) {
  uint64_t mask = 0;
  for (int bit = 0; bit < BITS; bit++)
    mask |= (uint64_t)(id[bit] == face) << bit;
  return mask;
}

void hsr_filter_add_picture(const struct hsr_kernel *kernel,
                            const struct hsr_world *world,
                            const struct hsr_view *view, const uint32_t *ids,
                            uint32_t *sums) {
  int cells = kernel->cells, columns = kernel->columns;
  int m = view->m * cells, n = view->n * cells;
  size_t stride = (size_t)m * (size_t)columns;
  struct colours colours;
  colours_init(&colours, world, view);
  for (int j = 0; j < n; j++)
    for (int i = 0; i < m; i++) {
      uint32_t id[BITS] = {0};
      bool alike = gather(ids + (size_t)j * (size_t)kernel->rows * stride +
                              (size_t)(i * columns),
                          stride, kernel, id);
      uint64_t done = ~kernel->all;
      for (int bit = 0; bit < BITS; bit++) {
        if (done >> bit & 1)
          continue;
        uint64_t mask =
            kernel->all & (alike ? UINT64_MAX : mask_of(id, id[bit]));
        hsr_filter_add(kernel, view->m, view->n, i / cells, j / cells, mask,
                       colour_of(&colours, id[bit]), sums);
        done |= mask;
      }
    }
}

void hsr_filter_add_subsample(const struct hsr_kernel *kernel,
                              const struct hsr_filtering *filtering,
                              const struct hsr_world *world,
                              const struct hsr_view *view, int pattern, int bit,
                              const uint32_t *ids, uint32_t *sums) {
  int cells = kernel->cells, reach = kernel->reach;
  int m = view->m * cells, n = view->n * cells;
  struct colours colours;
  colours_init(&colours, world, view);
  for (int j = 0; j < n; j++)
    for (int i = 0; i < m; i++) {
      if (hsr_jitter_pattern(filtering, i, j) != pattern)
        continue;
      const uint16_t *rgb =
          colour_of(&colours, ids[(size_t)j * (size_t)m + (size_t)i]);
      for (int dy = -reach; dy <= reach; dy++)
        for (int dx = -reach; dx <= reach; dx++)
          add(view->m, view->n, i / cells + dx, j / cells + dy,
              kernel->weight[dy + 1][dx + 1][bit], rgb, sums);
    }
}

/* The sum of the weights of all sub-samples of a picture that reach its pixel
 * (i, j). All cells of a pixel weigh the same. */
static uint32_t weight_within(const struct hsr_kernel *kernel, int m, int n,
                              int i, int j) {
  uint32_t weight = 0;
  for (int dy = -1; dy <= 1; dy++)
    for (int dx = -1; dx <= 1; dx++)
      if (is_within(m, n, i - dx, j - dy))
        weight += weight_of(kernel->row[dy + 1][dx + 1], UINT64_MAX);
  return weight * (uint32_t)(kernel->cells * kernel->cells);
}

void hsr_filter_finish(const struct hsr_filtering *filtering, int m, int n,
                       const uint32_t *sums, float *rgb) {
  struct hsr_kernel kernel;
  hsr_kernel_init(&kernel, filtering->filter);
  for (int j = 0; j < n; j++)
    for (int i = 0; i < m; i++) {
      double whole = 65535.0 * weight_within(&kernel, m, n, i, j);
      size_t k = 3 * ((size_t)j * (size_t)m + (size_t)i);
      for (size_t c = 0; c < 3; c++)
        rgb[k + c] = (float)(sums[k + c] / whole);
    }
}
