/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The layer of a grid, and the preimages of pixels on it. */
#include "algorithms/volume/textures/textures.h"
#include "common/answers/kinds/composited.h"

#include <math.h>
#include <string.h>

enum { CHANNELS = HSR_TEXTURE_CHANNELS };

/* --- The layer ------------------------------------------------------------ */

/* The first axis along which the grid has one sample; -1. */
static int layer_of(const struct hsr_grid *g) {
  for (int a = 0; a < 3; a++)
    if (g->n[a] == 1)
      return a;
  return -1;
}

enum hsr_status hsr_textures_prepare(const struct hsr_world *world,
                                     const long *option, void **prepared,
                                     struct hsr_error *err) {
  const struct hsr_grid *g = world->roster.scene->grid;
  (void)option;
  *prepared = NULL;
  return layer_of(g) >= 0 ? HSR_OK
                          : hsr_fail(err, HSR_E_REFUSED,
                                     "a texture is a grid of one layer: this "
                                     "one has %u x %u x %u samples",
                                     g->n[0], g->n[1], g->n[2]);
}

void hsr_textures_release(void *prepared) {
  (void)prepared;
}

/* Texels whose samples are not kept stay 0. */
static void fill_texels(struct hsr_texture *x) {
  const struct hsr_grid *g = x->grid;
  uint32_t at[3], cell = 0;
  for (at[2] = 0; at[2] < g->n[2]; at[2]++)
    for (at[1] = 0; at[1] < g->n[1]; at[1]++)
      for (uint32_t end = g->row[at[2] * (size_t)g->n[1] + at[1] + 1];
           cell < end; cell++) {
        at[0] = g->x[cell];
        size_t p = at[x->axis[0]], q = at[x->axis[1]];
        hsr_splats_colour(&x->splats, cell,
                          hsr_splats_opacity(&x->splats, cell),
                          x->texel[q * (size_t)x->n[0] + p]);
      }
}

enum hsr_status hsr_textures_begin(struct hsr_texture *x,
                                   const struct hsr_job *job) {
  const struct hsr_grid *g = job->world->roster.scene->grid;
  int a = layer_of(g);
  *x = (struct hsr_texture){.view = job->view,
                            .grid = g,
                            .tally = job->tally,
                            .arena = job->scratch,
                            .across = a,
                            .axis = {a == 0 ? 1 : 0, a == 2 ? 1 : 2},
                            .place = g->at[a][0]};
  for (int k = 0; k < 2; k++)
    x->n[k] = (int)g->n[x->axis[k]];
  size_t n = (size_t)x->n[0] * (size_t)x->n[1];
  x->texel = hsr_arena_zeroed(x->arena, n, sizeof *x->texel);
  if (!x->texel || hsr_splats_begin(&x->splats, job))
    return HSR_E_NOMEM;
  fill_texels(x);
  return HSR_OK;
}

/* --- Preimages ------------------------------------------------------------ */

/* The ray of a pixel: in perspective from E along D, in parallel from P along
 * F. */
static void find_ray(const struct hsr_view *v, struct hsr_preimage *pre) {
  double x = hsr_sample_x(v, pre->i), y = hsr_sample_y(v, pre->j);
  for (int c = 0; c < 3; c++) {
    double sum = v->ray[0][c] + x * v->ray[1][c] + y * v->ray[2][c];
    pre->from[c] = v->parallel ? v->E[c] + sum : v->E[c];
    pre->way[c] = v->parallel ? v->F[c] : sum;
  }
}

/* How coordinate c of the point changes with ray[k]: to the right or down. */
static double slope(const struct hsr_texture *x, const struct hsr_preimage *pre,
                    int k, int c) {
  const struct hsr_view *v = x->view;
  double along = pre->way[c] / pre->way[x->across];
  double slope = v->ray[k][c] - along * v->ray[k][x->across];
  return v->parallel ? slope : pre->t * slope;
}

/* The cell of an axis that holds a coordinate; -1. */
static int cell_at(const double *bound, int n, double at) {
  return at < bound[n] ? hsr_grid_split(bound, (uint32_t)n, at) : -1;
}

/* Where the ray of a pixel meets the layer. False if it does not, or not beyond
 * near. */
static bool meet(const struct hsr_texture *x, struct hsr_preimage *pre) {
  find_ray(x->view, pre);
  pre->t = (x->place - pre->from[x->across]) / pre->way[x->across];
  if (!(pre->t > x->view->near && pre->t < INFINITY))
    return false;
  for (int k = 0; k < 2; k++) {
    int a = x->axis[k];
    const double *bound = x->grid->bound[a];
    double at = pre->from[a] + pre->t * pre->way[a];
    int cell = cell_at(bound, x->n[k], at);
    if (cell < 0)
      return false;
    double size = bound[cell + 1] - bound[cell];
    pre->at[k] = cell + (at - bound[cell]) / size;
    pre->dx[k] = slope(x, pre, 1, a) / size;
    pre->dy[k] = slope(x, pre, 2, a) / size;
  }
  return true;
}

void hsr_preimage_sides(const struct hsr_texture *x,
                        const struct hsr_preimage *pre, double side[2]) {
  for (int a = 0; a < 2; a++)
    side[a] = x->splats.splatting.width * (fabs(pre->dx[a]) + fabs(pre->dy[a]));
}

/* --- Pixels --------------------------------------------------------------- */

static void write(struct hsr_texture *x, int i, int j, uint16_t *rgba,
                  const double mean[CHANNELS]) {
  bool any = false;
  for (int c = 0; c < CHANNELS; c++) {
    rgba[c] = (uint16_t)lrint(fmin(fmax(mean[c], 0), UINT16_MAX));
    any |= rgba[c] > 0;
  }
  if (any)
    HSR_ACCEPTED(x->tally, HSR_TEXTURE_WRITES, HSR_NOTHING, HSR_THE_WINDOW,
                 HSR_AT(i, j), rgba);
}

void hsr_textures_draw(struct hsr_texture *x, const struct hsr_job *job) {
  const struct hsr_window *w = &x->view->window;
  uint16_t *rgba = hsr_answer_rgba_of(job->answer);
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++) {
      double mean[CHANNELS] = {0};
      struct hsr_preimage pre = {.i = i, .j = j};
      bool meets = meet(x, &pre);
      HSR_STEP(x->tally, HSR_TEXTURE_RAYS, HSR_NOTHING, HSR_THE_WINDOW,
               HSR_AT(i, j), meets);
      if (meets)
        x->filter(x, &pre, mean);
      write(x, i, j,
            rgba + CHANNELS * ((size_t)j * (size_t)x->view->m + (size_t)i),
            mean);
    }
}

/* --- What it counts ------------------------------------------------------- */

static const struct hsr_counter counters[] = {
    {"rays", "rays that are met with the layer", HSR_COMPARE, HSR_OF_NOTHING,
     HSR_OF_WINDOW, "misses|meets", .key = "texture-ray"},
    {"texels", "texels read, or entries of a table", HSR_SAMPLE, HSR_OF_CELL,
     HSR_OF_WINDOW, .key = "texel-read"},
    {"writes", "pixels that are not empty", HSR_ACCEPT, HSR_OF_NOTHING,
     HSR_OF_WINDOW},
    {NULL}};

static const struct hsr_counter built[] = {
    {"built", "texels of levels, or entries, that are made", HSR_ACTIVATE,
     HSR_OF_CELL, HSR_OF_NOTHING},
    {NULL}};

const struct hsr_part hsr_textures_part = {
    HSR_PART_TEXTURES, counters, NULL, NULL, {NULL}};
const struct hsr_part hsr_built_part = {
    HSR_PART_BUILT, built, NULL, NULL, {NULL}};
