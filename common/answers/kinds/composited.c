/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The splats of a grid, composited: docs/composited-picture.md. Two answers are
 * equal if all channels of all pixels are. */
#include "common/answers/kinds/composited.h"
#include "common/answers/coded.h"
#include "common/files/colour_tiles.h"
#include "common/files/npy.h"
#include "common/files/srgb.h"
#include "common/files/suffix.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CHANNELS = 4 };

/* The options of a form. */
enum {
  MODEL,
  KERNEL,
  WIDTH,
  ANTIALIAS,
  ATTENUATE,
  NORMALISE,
  EXPOSURE,
  BUCKETS,
  BLUR,
  THRESHOLD,
  OPACITY,
  FRAMES
};

static const struct hsr_word models[] = {
    [HSR_OVER] = {"over", "splat over splat, from back to front", 0},
    [HSR_UNDER] = {"under", "splat under splat, from front to back", 0},
    [HSR_SHEET] = {"sheet", "the splats of a slice are added, slices go over",
                   0},
    [HSR_VOLUME] = {"volume", "what splats give to a range of depths is added",
                    0},
    [HSR_XRAY] = {"xray", "all splats are added", 0},
    [HSR_SLAB] = {"slab",
                  "densities and light are added in a range of depth, and what "
                  "their means show goes over",
                  0},
    {NULL}};
static const struct hsr_word kernels[] = {
    [HSR_CRAWFIS_MAX] = {"crawfis-max", "the cubic spline of 1993", 0},
    [HSR_GAUSSIAN] = {"gaussian", "of deviation .6, to radius 2", 0},
    {NULL}};
static const struct hsr_word blurs[] = {
    [HSR_SHARP] = {"off", "splats are as they are", 0},
    [HSR_BLUR_BY_AREA] = {"area", "as long as they moved, paler by their area",
                          0},
    [HSR_BLUR_EXACTLY] = {"exact", "as long as they moved, of the same energy",
                          0},
    [HSR_BLUR_ACCUMULATE] = {"accumulate",
                             "the mean of frames along the way of the camera",
                             0},
    {NULL}};
static const struct hsr_word opacities[] = {
    {"weight", "a splat gives its opacity times the weight", 0},
    {"length",
     "what is let through falls with the length of the way: a wall of opaque "
     "samples is opaque; not with normalise, nor of xray",
     0},
    {NULL}};
static const struct hsr_word off_on[] = {
    {"off", "not so", 0}, {"on", "so", 0}, {NULL}};

static const struct hsr_option options[] = {
    [MODEL] = {"model", "how splats come together", models, 0, HSR_SLAB, 0},
    [KERNEL] = {"kernel", "what a sample looks like", kernels, 0, 1, 0},
    [WIDTH] = {"width", "splats are so many times as wide", .real = true,
               .real_least = 1, .real_most = 100, .real_standard = 1},
    [ANTIALIAS] = {"antialias", "splats closer than pixels are as far apart",
                   off_on, 0, 1, 0},
    [ATTENUATE] = {"attenuate", "a factor of all opacities", .real = true,
                   .real_least = 0, .real_most = 1, .real_standard = 1},
    [NORMALISE] = {"normalise", "colours are divided by the splats' weights",
                   off_on, 0, 1, 0},
    [EXPOSURE] = {"exposure", "a factor of the sums of xray", .real = true,
                  .real_least = 0, .real_most = 1000, .real_standard = 1},
    [BUCKETS] = {"buckets", "ranges of depth, of volume and slab", NULL, 1,
                 1024, 64},
    [BLUR] = {"blur", "motion since the view before", blurs, 0,
              HSR_BLUR_ACCUMULATE, 0},
    [THRESHOLD] = {"threshold", "cells that a splat moves without blur",
                   .real = true, .real_least = 0, .real_most = 1000,
                   .real_standard = 0},
    [OPACITY] = {"opacity", "what the opacity of a sample means", opacities, 0,
                 1, 0},
    [FRAMES] = {"frames", "that blur=accumulate takes the mean of", NULL, 2,
                1024, 5},
    {NULL}};

struct hsr_splatting hsr_form_splatting(const struct hsr_form *form) {
  const long *option = form->values.option;
  const double *real = form->values.real;
  const bool is_slab = option[MODEL] == HSR_SLAB,
             has_opacity = option[MODEL] != HSR_XRAY && !option[NORMALISE];
  return (struct hsr_splatting){
      .model = (enum hsr_model)option[MODEL],
      .kernel = (enum hsr_splat_kernel)option[KERNEL],
      .width = real[WIDTH],
      .antialias = option[ANTIALIAS],
      .attenuate = (uint32_t)lrint(65536 * real[ATTENUATE]),
      .normalise = option[NORMALISE] && !is_slab,
      .per_length = is_slab || (has_opacity && option[OPACITY]),
      .exposure = (uint64_t)lrint(65536 * real[EXPOSURE]),
      .buckets = (int)option[BUCKETS],
      .blur = (enum hsr_splat_blur)option[BLUR],
      .threshold = real[THRESHOLD],
      .frames = (int)option[FRAMES]};
}

void hsr_form_expose(struct hsr_form *form, double exposure) {
  form->values.real[EXPOSURE] = exposure;
}

static size_t count(const struct hsr_answer *answer) {
  return CHANNELS * (size_t)answer->m * (size_t)answer->n;
}

struct body {
  uint64_t *sums; /* NULL: there are none */
  uint16_t rgba[];
};

static uint16_t *rgba_of(const struct hsr_answer *answer) {
  return ((struct body *)answer->body)->rgba;
}

uint16_t *hsr_answer_rgba_of(const struct hsr_answer *answer) {
  bool is_one = answer->form.type == &hsr_answer_composited && answer->body;
  return is_one ? rgba_of(answer) : NULL;
}

static enum hsr_status make(struct hsr_answer *answer, struct hsr_error *err) {
  answer->body =
      calloc(1, sizeof(struct body) + count(answer) * sizeof(uint16_t));
  return answer->body ? HSR_OK : hsr_fail_nomem(err);
}

/* Premultiplied red exceeds the opacity nowhere in a picture. */
static void unset(struct hsr_answer *answer) {
  uint16_t *rgba = rgba_of(answer);
  for (size_t k = 0; k < count(answer); k++)
    rgba[k] = k % CHANNELS ? 0 : UINT16_MAX;
}

static void free_body(struct hsr_answer *answer) {
  if (answer->body)
    free(((struct body *)answer->body)->sums);
  free(answer->body);
}

static int arrays(const struct hsr_answer *answer,
                  struct hsr_array array[HSR_MOST_ARRAYS]) {
  array[0] = (struct hsr_array){rgba_of(answer), CHANNELS * sizeof(uint16_t)};
  return 1;
}

/* --- Sums of parts -------------------------------------------------------- */

uint64_t *hsr_answer_splat_sums_of(const struct hsr_answer *answer) {
  return hsr_answer_rgba_of(answer) ? ((struct body *)answer->body)->sums
                                    : NULL;
}

/* The mean of frames is one of answers, not of sums. */
static bool is_summed(const struct hsr_form *form) {
  const struct hsr_splatting splatting = hsr_form_splatting(form);
  return splatting.model == HSR_XRAY && splatting.blur != HSR_BLUR_ACCUMULATE;
}

static size_t sums_of(const struct hsr_answer *answer, uint64_t **first) {
  *first = hsr_answer_splat_sums_of(answer);
  return HSR_SPLAT_SUMS * (size_t)answer->m * (size_t)answer->n;
}

static enum hsr_status begin_sums(struct hsr_answer *answer,
                                  struct hsr_error *err) {
  struct body *body = answer->body;
  uint64_t *none;
  body->sums = calloc(sums_of(answer, &none), sizeof *body->sums);
  return body->sums ? HSR_OK : hsr_fail_nomem(err);
}

static void finish_sums(struct hsr_answer *answer) {
  struct hsr_splatting splatting = hsr_form_splatting(&answer->form);
  const uint64_t *sum = hsr_answer_splat_sums_of(answer);
  uint16_t *rgba = rgba_of(answer);
  for (size_t k = 0; k < count(answer); k += CHANNELS, sum += HSR_SPLAT_SUMS)
    for (size_t c = 0; c < CHANNELS; c++) {
      uint64_t E = splatting.normalise
                       ? sum[c]
                       : hsr_splat_exposed(sum[c], splatting.exposure);
      rgba[k + c] = hsr_splat_channel(&splatting, E, sum[CHANNELS]);
    }
}

static const struct hsr_summing summing = {.fits = is_summed,
                                           .begin = begin_sums,
                                           .sums = sums_of,
                                           .finish = finish_sums};

/* --- Comparing ------------------------------------------------------------ */

/* The greatest difference of a channel. */
static int distance(const uint16_t got[CHANNELS],
                    const uint16_t wanted[CHANNELS]) {
  int most = 0;
  for (int c = 0; c < CHANNELS; c++)
    most = abs(got[c] - wanted[c]) > most ? abs(got[c] - wanted[c]) : most;
  return most;
}

static int by_size(const void *a, const void *b) {
  return *(const uint16_t *)a - *(const uint16_t *)b;
}

/* Adds the mean of the differences, the least that 99 % of them do not exceed,
 * and the greatest. */
static void say_distances(uint16_t *all, size_t n,
                          struct hsr_difference *difference) {
  size_t length = strlen(difference->first);
  double sum = 0;
  for (size_t k = 0; k < n; k++)
    sum += all[k];
  qsort(all, n, sizeof *all, by_size);
  snprintf(
      difference->first + length, sizeof difference->first - length,
      "; of 65535, pixels differ by %.1f in the mean, 99 %% by at most %u, "
      "all by at most %u",
      sum / (double)n, all[(n * 99 + 99) / 100 - 1], all[n - 1]);
}

static void compare(const struct hsr_comparison *c,
                    struct hsr_difference *difference) {
  const uint16_t *got = rgba_of(c->got), *wanted = rgba_of(c->wanted);
  uint16_t *distances = malloc((c->n + 1) * sizeof *distances);
  difference->compared = c->n;
  for (size_t k = 0; k < c->n; k++) {
    size_t s = c->place ? c->place[k] : k, m = (size_t)c->got->m;
    const uint16_t *g = got + CHANNELS * s, *w = wanted + CHANNELS * s;
    int by = distance(g, w);
    if (distances)
      distances[k] = (uint16_t)by;
    if (by && !difference->differing++)
      snprintf(difference->first, sizeof difference->first,
               "(%zu, %zu): %u %u %u %u, not %u %u %u %u", s % m, s / m, g[0],
               g[1], g[2], g[3], w[0], w[1], w[2], w[3]);
  }
  if (distances && difference->differing)
    say_distances(distances, c->n, difference);
  free(distances);
}

/* The wanted picture, dimmed, and the difference in orange, 16 times as large.
 */
static enum hsr_status show_difference(const struct hsr_comparison *c,
                                       const struct hsr_showing *showing,
                                       float *rgb, struct hsr_error *err) {
  static const float mark[3] = {1.0f, .35f, 0.0f};
  const uint16_t *got = rgba_of(c->got), *wanted = rgba_of(c->wanted);
  (void)showing, (void)err;
  size_t n = count(c->got) / CHANNELS;
  for (size_t k = 0; k < n; k++, got += CHANNELS, wanted += CHANNELS) {
    int most = distance(got, wanted);
    float share = most ? 0.25f + (float)most / 4096 : 0;
    share = share > 1 ? 1 : share;
    for (int i = 0; i < 3; i++)
      rgb[3 * k + (size_t)i] =
          share * mark[i] + (1 - share) * 0.25f * (float)wanted[i] / 65535;
  }
  return HSR_OK;
}

/* --- Showing -------------------------------------------------------------- */

/* In front of the background, or of black. */
static enum hsr_status shade(const struct hsr_answer *answer,
                             const struct hsr_showing *showing,
                             struct hsr_shaded *shaded, struct hsr_error *err) {
  const uint16_t *rgba = rgba_of(answer);
  size_t n = count(answer) / CHANNELS;
  shaded->rgb = malloc(3 * n * sizeof *shaded->rgb);
  if (!shaded->rgb)
    return hsr_fail_nomem(err);
  for (size_t k = 0; k < n; k++)
    for (size_t c = 0; c < 3; c++) {
      shaded->rgb[3 * k + c] = (float)rgba[CHANNELS * k + c] / 65535;
      if (showing->background.given)
        shaded->rgb[3 * k + c] += showing->background.rgb[c] *
                                  (1 - (float)rgba[CHANNELS * k + 3] / 65535);
    }
  return HSR_OK;
}

/* The answer itself: four integers a pixel. */
static enum hsr_status write_array(const struct hsr_answer *answer,
                                   const char *path, struct hsr_error *err) {
  const struct hsr_npy array = {
      .kind = 'u',
      .bytes = sizeof(uint16_t),
      .n_dimensions = 3,
      .size = {(uint64_t)answer->n, (uint64_t)answer->m, CHANNELS},
      .data = rgba_of(answer)};
  return hsr_npy_write(path, &array, err);
}

/* Whether a file of colours has an alpha: where nothing is behind the splats,
 * and where a program expects one, unless a background is given. */
static bool has_alpha(const struct hsr_showing *showing, const char *path) {
  return showing->background.none ||
         (!showing->background.given && !hsr_ends_in(path, ".png") &&
          hsr_can_be_clear(path));
}

static enum hsr_status write(const struct hsr_answer *answer,
                             const struct hsr_showing *showing,
                             struct hsr_shaded *shaded, const char *path,
                             struct hsr_error *err) {
  if (hsr_is_array_file(path) && !hsr_is_colour_array(path))
    return write_array(answer, path, err);
  const uint16_t *rgba = rgba_of(answer);
  size_t n = count(answer) / CHANNELS;
  float *alpha = has_alpha(showing, path) ? malloc(n * sizeof *alpha) : NULL;
  if (has_alpha(showing, path) && !alpha)
    return hsr_fail_nomem(err);
  for (size_t k = 0; alpha && k < n; k++)
    alpha[k] = (float)rgba[CHANNELS * k + 3] / 65535;
  struct hsr_picture picture = {
      .m = answer->m, .n = answer->n, .rgb = shaded->rgb, .alpha = alpha};
  enum hsr_status status = hsr_image_write(path, &picture, showing->text, err);
  free(alpha);
  return status;
}

static enum hsr_status write_tile(const struct hsr_answer *tile,
                                  const struct hsr_tile_grid *tiling,
                                  long number, const char *text,
                                  const char *path, struct hsr_error *err) {
  const uint16_t *rgba = rgba_of(tile);
  float *pixels = malloc(count(tile) * sizeof *pixels);
  if (!pixels)
    return hsr_fail_nomem(err);
  for (size_t k = 0; k < count(tile); k++)
    pixels[k] = (float)rgba[k] / 65535;
  enum hsr_status status = hsr_image_write_colour_tile(
      path, tiling, number, CHANNELS, pixels, text, err);
  free(pixels);
  return status;
}

static enum hsr_status join_tiles(const char *path,
                                  const struct hsr_tile_grid *tiling,
                                  const char *(*name)(void *whom, long k),
                                  void *whom, const char *text,
                                  struct hsr_error *err) {
  return hsr_image_join_colour_tiles(path, tiling, CHANNELS, name, whom, text,
                                     err);
}

static bool fits(const char *path) {
  return hsr_is_colour_file(path) ||
         (hsr_is_array_file(path) && !hsr_is_depth_file(path));
}

static void print(const struct hsr_answer *answer,
                  const struct hsr_showing *showing, FILE *out) {
  const uint16_t *rgba = rgba_of(answer);
  size_t n = count(answer) / CHANNELS, covered = 0;
  (void)showing;
  for (size_t k = 0; k < n; k++)
    covered += rgba[CHANNELS * k + 3] > 0;
  fprintf(out, "%.1f %% covered\n", 100.0 * (double)covered / (double)n);
}

/* --- Tracing -------------------------------------------------------------- */

/* The part of an accepted event is the four channels that its pixel has from
 * then on. */
static enum hsr_status paint(struct hsr_answer *answer,
                             const struct hsr_event *event) {
  uint16_t *rgba = rgba_of(answer);
  const struct hsr_window *w = &event->window;
  memcpy(rgba + CHANNELS * ((size_t)w->y0 * (size_t)answer->m + (size_t)w->x0),
         event->part, CHANNELS * sizeof *rgba);
  return HSR_OK;
}

static json_t *part_json(const void *part, const struct hsr_view *view) {
  const uint16_t *c = part;
  (void)view;
  return json_pack("[iiii]", c[0], c[1], c[2], c[3]);
}

/* All channels, pixel after pixel. */
static json_t *rgba_json(const struct hsr_answer *answer,
                         const struct hsr_view *view) {
  const uint16_t *rgba = rgba_of(answer);
  (void)view;
  return hsr_channels_json(rgba, count(answer));
}

static void sketch(const struct hsr_answer *painted,
                   const struct hsr_event *event, enum hsr_step_kind step,
                   const struct hsr_view *view, uint32_t face,
                   const struct hsr_slide *slide) {
  (void)painted, (void)view;
  if (step == HSR_ACCEPT)
    slide->fill(slide->on, &event->window,
                event->part ? hsr_srgb_of(event->part) : face);
  else if (step == HSR_SAMPLE)
    slide->touch(slide->on, &event->window);
}

const struct hsr_answer_type hsr_answer_composited = {
    .name = "composited",
    .meaning = "the splats of a grid, composited, in 16 bits a channel",
    .draws = "splats",
    .places = "pixels",
    .grains = "pixels",
    .options = options,
    .summing = &summing,
    .by_windows = true,
    .by_places = true,
    .takes = 1 << HSR_PALETTE | 1 << HSR_BACKDROP | 1 << HSR_NO_BACKDROP,
    .make = make,
    .unset = unset,
    .free = free_body,
    .arrays = arrays,
    .compare = compare,
    .show_difference = show_difference,
    .shade = shade,
    .fits = fits,
    .write = write,
    .write_tile = write_tile,
    .join_tiles = join_tiles,
    .print = print,
    .paint = paint,
    .sketch = sketch,
    .json = rgba_json,
    .part_json = part_json};
