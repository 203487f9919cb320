/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Small textures across every axis, in both projections, with cells of one size
 * and of many: what all maps must agree on. */
#include "bench/modules/variant.h"
#include "tests/properties/volume/boards.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>

enum { TEXELS_U = 16, TEXELS_V = 8, TEXELS = TEXELS_U * TEXELS_V };
enum { M = 48, N = 36 };
#define FORWARD "splat-xray:model=xray:normalise=on:antialias=on"

/* How a texture is made. */
struct layer {
  int across;
  bool even; /* cells of one size */
  bool parallel;
  double far; /* of the eye */
  bool grey;  /* of one colour */
  bool ramp;  /* rising along its first axis */
};

/* --- Textures ------------------------------------------------------------- */

/* Random bytes, of which the squares are the colours. */
static void fill_colours(float (*rgb)[3], const struct layer *l) {
  uint64_t seed = 5;
  for (int k = 0; k < TEXELS; k++)
    for (int c = 0; c < 3; c++) {
      float byte = (float)draw_integer(&seed, 0, 255) / 255;
      rgb[k][c] = l->grey   ? 0.25f
                  : l->ramp ? (float)(1 + k % TEXELS_U) / 20
                            : byte * byte;
    }
}

static void fill_places(double *at, int n, bool even) {
  for (int k = 0; k < n; k++)
    at[k] = even ? 1.25 * k : k + 0.05 * k * k;
}

static void open_layer(struct stage *s, const struct layer *l) {
  static float rgb[TEXELS][3];
  static double at[3][TEXELS_U];
  struct hsr_palette palette = plain_palette(WHITE, WHITE);
  palette.own_colours = true;
  struct field field = {.rgb = (const float(*)[3])rgb,
                        .keep = {.least = 0.5, .most = 2},
                        .palette = &palette};
  int u = l->across == 0 ? 1 : 0;
  for (int a = 0; a < 3; a++) {
    int n = a == l->across ? 1 : a == u ? TEXELS_U : TEXELS_V;
    fill_places(at[a], n, l->even);
    field.n[a] = (uint32_t)n;
    field.at[a] = at[a];
  }
  fill_colours(rgb, l);
  open_stage(s, &field);
}

/* From aside, at the middle of the layer. */
static struct hsr_view see_layer(const struct stage *s, const struct layer *l) {
  const struct hsr_grid *g = s->scene->grid;
  static const double aside[3] = {0.5, 0.4, 0.3};
  struct hsr_camera camera = {.fov = 40, .parallel = l->parallel ? l->far : 0};
  for (int a = 0; a < 3; a++) {
    camera.at[a] = (g->at[a][0] + g->at[a][g->n[a] - 1]) / 2;
    camera.eye[a] = camera.at[a] + l->far * (a == l->across ? 1 : aside[a]);
  }
  camera.up[(l->across + 1) % 3] = 1;
  return splat_view(&camera, M, N);
}

/* --- What is tried -------------------------------------------------------- */

static struct picture draw_layer(const struct stage *s,
                                 const struct hsr_view *v, const char *map) {
  struct hsr_variant made = splat_variant("%s", map);
  return take(s, v, &made);
}

/* How far the channels of two pictures are apart at most, in the pixels that
 * are seen in p. */
static int most_apart(const struct picture *p, const struct picture *q,
                      int *pixels) {
  int most = *pixels = 0;
  for (int k = 0; k < M * N; k++) {
    if (!p->rgba[4 * k + 3])
      continue;
    ++*pixels;
    for (int c = 0; c < 3; c++) {
      int apart = abs(p->rgba[4 * k + c] - q->rgba[4 * k + c]);
      most = apart > most ? apart : most;
    }
  }
  return most;
}

/* The forward map rounds what each of up to 13 splats gives down twice, to
 * 65536ths, and the weights, too; their sum is about 1. */
static void try_convolution(struct tap *tap, const struct layer *l) {
  struct stage s;
  open_layer(&s, l);
  struct hsr_view v = see_layer(&s, l);
  struct picture p = draw_layer(&s, &v, "texture-convolve:model=xray"),
                 q = draw_layer(&s, &v, FORWARD);
  int pixels, most = most_apart(&p, &q, &pixels);
  ok(tap, pixels > 100 && most < 4 * 13,
     "across axis %d, %s, cells of %s: by direct convolution %d pixels differ "
     "from the forward map by %d at most",
     l->across, l->parallel ? "in parallel" : "in perspective",
     l->even ? "one size" : "many sizes", pixels, most);
  drop(&p);
  drop(&q);
  close_stage(&s);
}

/* The grey of .25 is kept as the byte 127 or 128, and is opaque. */
static void try_one_colour(struct tap *tap, const struct layer *l,
                           const char *map) {
  struct stage s;
  open_layer(&s, l);
  struct hsr_view v = see_layer(&s, l);
  struct picture p = draw_layer(&s, &v, map);
  int pixels = 0, wrong = 0, first = 0;
  for (int k = 0; k < M * N; k++) {
    const uint16_t *rgba = p.rgba + 4 * k;
    if (!rgba[3])
      continue;
    first = pixels++ ? first : rgba[0];
    wrong += rgba[3] < WHITE - 1 || abs(rgba[0] - first) > 1 ||
             abs(first - WHITE / 4) > 400;
  }
  ok(tap, pixels > 0 && !wrong,
     "%s: one colour stays so in %d pixels, %d wrong", map, pixels, wrong);
  drop(&p);
  close_stage(&s);
}

/* So far away that the texture is less than a pixel: all of it is averaged. Its
 * sides are powers of 2, so the last level of a mip-map is its mean. */
static void try_mean(struct tap *tap, const struct layer *l) {
  struct stage s;
  open_layer(&s, l);
  struct hsr_view v = see_layer(&s, l);
  v.offset_x = v.offset_y = 0.49951171875; /* a ray near the middle */
  struct picture p = draw_layer(&s, &v, "texture-mipmap:model=xray"),
                 q = draw_layer(&s, &v, "texture-table:model=xray");
  int pixels, most = most_apart(&p, &q, &pixels);
  ok(tap, pixels == 1 && most <= 1,
     "from afar, a mip-map and a table give the same mean to %d pixel, to %d",
     pixels, most);
  drop(&p);
  drop(&q);
  close_stage(&s);
}

/* A ramp is a ramp at each level. Away from the rim, a pixel's value is that of
 * the ramp where its ray meets the layer. A colour is kept to half a byte of its
 * root: to 2 . 65535 / 510. The steps of its texels leave a box of a texel and
 * more off by up to an 8th of a texel; the ellipse is no narrower. */
static void try_ramp(struct tap *tap, const char *map, double steps) {
  const struct layer layer = {
      .across = 2, .even = true, .far = 72, .ramp = true};
  struct stage s;
  open_layer(&s, &layer);
  struct hsr_view v = see_layer(&s, &layer);
  struct picture p = draw_layer(&s, &v, map);
  int pixels = 0;
  double most = 0, D[3];
  for (int k = 0; k < M * N; k++) {
    direction_at(&v, k % M, k / M, D);
    double at = (v.E[0] - v.E[2] / D[2] * D[0]) / 1.25;
    if (!p.rgba[4 * k + 3] || at < 4 || at > TEXELS_U - 5)
      continue;
    pixels++;
    most = fmax(most, fabs(p.rgba[4 * k] - WHITE * (at + 1) / 20));
  }
  ok(tap, pixels > 20 && most < 258 + steps * WHITE / 20,
     "%s: a ramp stays so in %d pixels, to %.0f; a texel is %d", map, pixels,
     most, WHITE / 20);
  drop(&p);
  close_stage(&s);
}

int main(void) {
  static const char *const maps[] = {
      "texture-point:model=xray", "texture-mipmap:model=xray",
      "texture-table:model=xray", "texture-convolve:model=xray",
      "texture-convolve:model=xray:shape=preimage"};
  struct tap tap = plan(3 * 2 * 2 + 5 * 2 + 2 + 3);
  for (int k = 0; k < 12; k++)
    try_convolution(&tap, &(struct layer){.across = k / 4,
                                          .even = k % 2,
                                          .parallel = k / 2 % 2,
                                          .far = 24});
  for (int k = 0; k < 10; k++)
    try_one_colour(&tap,
                   &(struct layer){.across = k % 3,
                                   .even = k % 2,
                                   .parallel = k / 5,
                                   .far = 30,
                                   .grey = true},
                   maps[k % 5]);
  for (int k = 0; k < 2; k++)
    try_mean(&tap, &(struct layer){
                       .across = 2, .even = true, .parallel = k, .far = 4096});
  try_ramp(&tap, maps[1], 0);
  try_ramp(&tap, maps[2], 0.125);
  try_ramp(&tap, maps[4], 0.125);
  return finish(&tap);
}
