/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/engines/masks/canvas.h"
#include "common/answers/kinds/filtered.h"
#include "common/base/bits.h"
#include "common/base/numbers.h"

/* Count the samples of the face that is being tiled, which are written: of the
 * 8 x 8 samples from (x, y) on those of a mask; or those of a square that are
 * in the window. A step is one sample. */
static void count_samples(const struct hsr_canvas *c, int x, int y,
                          uint64_t mask) {
  for (uint64_t rest = HSR_COUNTING ? mask : 0; rest; rest &= rest - 1) {
    int bit = hsr_first_bit(rest);
    HSR_STEP(c->job->tally, c->counter, HSR_FACE(c->id), HSR_THE_WINDOW,
             HSR_AT(x + bit % 8, y + bit / 8), 0);
  }
}

static void count_square(const struct hsr_canvas *c, int x, int y, int size) {
  int x1 = hsr_min_int(x + size, c->window.x1),
      y1 = hsr_min_int(y + size, c->window.y1);
  for (int j = y; HSR_COUNTING && j < y1; j++)
    for (int i = x; i < x1; i++)
      HSR_STEP(c->job->tally, c->counter, HSR_FACE(c->id), HSR_THE_WINDOW,
               HSR_AT(i, j), 0);
}

/* --- Ids ------------------------------------------------------------------ */

static void put_samples(void *context, int x, int y, uint64_t mask) {
  struct hsr_canvas *c = context;
  uint32_t *row = hsr_job_row(c->job, y) + x;
  count_samples(c, x, y, mask);
  for (; mask; mask >>= 8, row += (size_t)c->job->answer->m) {
    unsigned eight = mask & 0xff;
    if (eight == 0xff)
      for (int i = 0; i < 8; i++)
        row[i] = c->id;
    else
      for (; eight; eight &= eight - 1)
        row[hsr_first_bit(eight)] = c->id;
  }
}

static void put_square(void *context, int x, int y, int size) {
  struct hsr_canvas *c = context;
  int x1 = hsr_min_int(x + size, c->window.x1),
      y1 = hsr_min_int(y + size, c->window.y1);
  count_square(c, x, y, size);
  for (int j = y; j < y1; j++) {
    uint32_t *row = hsr_job_row(c->job, j);
    for (int i = x; i < x1; i++)
      row[i] = c->id;
  }
}

/* --- Sums ----------------------------------------------------------------- */

/* Shading is put off until something of the face is seen. */
static void shade(struct hsr_canvas *c) {
  const struct hsr_world *world = c->job->world;
  if (c->has_colour)
    return;
  hsr_filter_colour(
      world, c->job->view,
      c->id == HSR_BACKGROUND ? c->id : hsr_world_parent(world, c->id), c->rgb);
  c->has_colour = true;
}

static uint32_t *pixel(const struct hsr_canvas *c, int i, int j) {
  return c->sums + 3 * ((size_t)j * (size_t)c->job->view->m + (size_t)i);
}

static void add(const struct hsr_canvas *c, int i, int j, uint32_t weight) {
  uint32_t *sum = pixel(c, i, j);
  for (int k = 0; k < 3; k++)
    sum[k] += weight * c->rgb[k];
}

static void box_samples(void *context, int x, int y, uint64_t mask) {
  struct hsr_canvas *c = context;
  unsigned n = hsr_count_bits(mask), all = (unsigned)(c->side * c->side);
  shade(c);
  count_samples(c, x, y, mask);
  add(c, x / c->side, y / c->side, n * (HSR_WHOLE_WEIGHT / all));
}

/* A square within a pixel; or of whole pixels, to which nothing has been added
 * before. */
static void box_square(void *context, int x, int y, int size) {
  struct hsr_canvas *c = context;
  shade(c);
  if (size < c->side) {
    uint32_t parts = (uint32_t)(c->side / size);
    count_square(c, x, y, size);
    add(c, x / c->side, y / c->side, HSR_WHOLE_WEIGHT / (parts * parts));
    return;
  }
  uint32_t whole[3];
  for (int k = 0; k < 3; k++)
    whole[k] = HSR_WHOLE_WEIGHT * c->rgb[k];
  int i1 = hsr_min_int(x + size, c->window.x1) / c->side;
  int j1 = hsr_min_int(y + size, c->window.y1) / c->side;
  count_square(c, x, y, size);
  for (int j = y / c->side; j < j1; j++) {
    uint32_t *sum = pixel(c, x / c->side, j);
    for (int i = x / c->side; i < i1; i++, sum += 3)
      for (int k = 0; k < 3; k++)
        sum[k] = whole[k];
  }
}

/* Adds to the 3 x 3 pixels about (i, j) that are in the picture. */
static void spread(const struct hsr_canvas *c, int i, int j,
                   uint32_t weight[3][3]) {
  const struct hsr_view *view = c->job->view;
  for (int dy = -1; dy <= 1; dy++)
    for (int dx = -1; dx <= 1; dx++)
      if (i + dx >= 0 && i + dx < view->m && j + dy >= 0 && j + dy < view->n)
        add(c, i + dx, j + dy, weight[dy + 1][dx + 1]);
}

static void wide_samples(void *context, int x, int y, uint64_t mask) {
  struct hsr_canvas *c = context;
  uint32_t weight[3][3] = {{0}};
  shade(c);
  count_samples(c, x, y, mask);
  for (int byte = 0; mask; byte++, mask >>= 8)
    for (int k = 0; mask & 255 && k < 9; k++)
      weight[k / 3][k % 3] += c->kernel->row[k / 3][k % 3][byte][mask & 255];
  spread(c, x / HSR_SUB, y / HSR_SUB, weight);
}

static void wide_square(void *context, int x, int y, int size) {
  struct hsr_canvas *c = context;
  shade(c);
  int i1 = hsr_min_int(x + size, c->window.x1) / HSR_SUB;
  int j1 = hsr_min_int(y + size, c->window.y1) / HSR_SUB;
  count_square(c, x, y, size);
  for (int j = y / HSR_SUB; j < j1; j++)
    for (int i = x / HSR_SUB; i < i1; i++)
      spread(c, i, j, c->whole);
}

/* --- The sink ------------------------------------------------------------- */

void hsr_canvas_begin(struct hsr_canvas *c, const struct hsr_job *job,
                      struct hsr_window window, const struct hsr_kernel *wide,
                      int counter) {
  *c = (struct hsr_canvas){
      .job = job, .window = window, .kernel = wide, .counter = counter};
  c->filtering = hsr_form_filtering(&job->answer->form);
  c->sums = hsr_answer_sums_of(job->answer);
  if (c->sums)
    c->side = HSR_SUB * hsr_filter_cells(c->filtering.filter);
  for (int k = 0; k < 9; k++)
    for (int byte = 0; byte < 8; byte++)
      c->whole[k / 3][k % 3] += wide->row[k / 3][k % 3][byte][255];
}

void hsr_canvas_face(struct hsr_canvas *c, uint32_t id) {
  c->id = id;
  c->has_colour = false;
}

void hsr_canvas_colour(struct hsr_canvas *c, const uint16_t rgb[3]) {
  for (int k = 0; k < 3; k++)
    c->rgb[k] = rgb[k];
  c->has_colour = true;
}

static bool is_box(enum hsr_filter filter) {
  return filter == HSR_FILTER_BOX || filter == HSR_FILTER_BOX_64X64;
}

struct hsr_mask_sink hsr_canvas_sink(struct hsr_canvas *c) {
  struct hsr_mask_sink ids = {put_samples, put_square, c};
  struct hsr_mask_sink box = {box_samples, box_square, c};
  struct hsr_mask_sink wide = {wide_samples, wide_square, c};
  return !c->sums ? ids : is_box(c->filtering.filter) ? box : wide;
}
