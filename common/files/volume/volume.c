/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef _POSIX_C_SOURCE
#define _POSIX_C_SOURCE 200809L
#endif
#include "common/files/image.h"
#include "common/files/volume/volume.h"
#include "common/files/volume/volume_words.h"
#include "common/grids/heights.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* --- Formats -------------------------------------------------------------- */

static const struct {
  const char *suffix;
  enum hsr_volume_format format;
} formats[] = {{".nii", HSR_NIFTI},      {".nii.gz", HSR_NIFTI},
               {".mhd", HSR_META_IMAGE}, {".mha", HSR_META_IMAGE},
               {".vtk", HSR_VTK_LEGACY}, {".vti", HSR_VTK_IMAGE},
               {".vtr", HSR_VTK_GRID}};
enum { N_FORMATS = sizeof formats / sizeof *formats };

static bool ends_in(const char *text, size_t n, const char *suffix) {
  size_t k = strlen(suffix);
  return n > k && !strncasecmp(text + n - k, suffix, k);
}

static int format_of(const char *path, size_t n) {
  for (int k = 0; k < N_FORMATS; k++)
    if (ends_in(path, n, formats[k].suffix))
      return k;
  return -1;
}

bool hsr_is_volume_name(const char *name) {
  return !strncmp(name, "heights-of:", 11) || strstr(name, ":size=") ||
         format_of(name, hsr_name_before_words(name)) >= 0;
}

/* --- Bytes without a header ----------------------------------------------- */

struct raw {
  FILE *in;
  const struct hsr_volume_words *words;
  size_t n; /* samples a slice */
  unsigned char *bytes;
};

static float sample_of(const unsigned char *at, const struct hsr_raw_type *t) {
  uint32_t bits = 0;
  for (int k = 0; k < t->bytes; k++)
    bits |= (uint32_t)at[t->is_big_endian ? t->bytes - 1 - k : k] << 8 * k;
  float value;
  if (t->is_real) {
    memcpy(&value, &bits, sizeof value);
    return value;
  }
  uint32_t sign = UINT32_C(1) << (8 * t->bytes - 1);
  return t->is_signed && bits & sign ? (float)bits - 2 * (float)sign
                                     : (float)bits;
}

static enum hsr_status raw_slice(void *data, uint32_t k, float *density,
                                 struct hsr_error *err) {
  struct raw *raw = data;
  const struct hsr_raw_type *type = &raw->words->type;
  size_t size = raw->n * (size_t)type->bytes;
  off_t at = (off_t)(raw->words->offset + (uint64_t)k * size);
  if (fseeko(raw->in, at, SEEK_SET) ||
      fread(raw->bytes, 1, size, raw->in) != size)
    return hsr_fail(err, HSR_E_INPUT, "the file ends within slice %u", k);
  for (size_t c = 0; c < raw->n; c++)
    density[c] = sample_of(raw->bytes + c * (size_t)type->bytes, type);
  return HSR_OK;
}

static void close_raw(void *data) {
  struct raw *raw = data;
  if (raw->in)
    fclose(raw->in);
  free(raw->bytes);
  free(raw);
}

/* Even positions along each axis. */
static bool set_positions(struct hsr_volume *volume, const double spacing[3]) {
  for (int a = 0; a < 3; a++) {
    double *at = malloc(volume->n[a] * sizeof *at);
    volume->position[a] = at;
    for (uint32_t k = 0; at && k < volume->n[a]; k++)
      at[k] = spacing[a] * k;
  }
  return volume->position[0] && volume->position[1] && volume->position[2];
}

/* Whether the file is as long as the words have it. */
static bool is_long_enough(const struct hsr_volume_words *w, FILE *in) {
  if (fseeko(in, 0, SEEK_END))
    return false;
  double need = (double)w->offset +
                (double)w->size[0] * w->size[1] * w->size[2] * w->type.bytes;
  return need <= (double)ftello(in);
}

static enum hsr_status open_raw(struct hsr_volume *volume, const char *path,
                                const struct hsr_volume_words *w,
                                struct hsr_error *err) {
  struct raw *raw = calloc(1, sizeof *raw);
  if (!raw)
    return hsr_fail_nomem(err);
  memcpy(volume->n, w->size, sizeof volume->n);
  volume->slice = raw_slice;
  volume->close = close_raw;
  volume->data = raw;
  raw->words = w;
  raw->n = (size_t)w->size[0] * w->size[1];
  raw->in = fopen(path, "rb");
  if (!raw->in)
    return hsr_fail(err, HSR_E_INPUT, "%.200s: %s", path, strerror(errno));
  if (!is_long_enough(w, raw->in))
    return hsr_fail(err, HSR_E_INPUT,
                    "%.200s: is too short for %u x %u x %u samples of %d "
                    "bytes behind %llu",
                    path, w->size[0], w->size[1], w->size[2], w->type.bytes,
                    (unsigned long long)w->offset);
  raw->bytes = malloc(raw->n * (size_t)w->type.bytes);
  return raw->bytes && set_positions(volume, w->spacing) ? HSR_OK
                                                         : hsr_fail_nomem(err);
}

/* --- From a volume to a grid ---------------------------------------------- */

static void free_volume(struct hsr_volume *volume) {
  for (int a = 0; a < 3; a++)
    free(volume->position[a]);
  if (volume->close)
    volume->close(volume->data);
}

/* A volume that is being kept. Its cells are as bright as they are dense. */
struct keeping {
  const struct hsr_volume *volume;
  double least, most; /* of all densities */
};

static enum hsr_status keep_slice(void *data, uint32_t k, float *density,
                                  struct hsr_error *err) {
  const struct keeping *keeping = data;
  return keeping->volume->slice(keeping->volume->data, k, density, err);
}

static void by_density(void *data, const uint32_t at[3], float density,
                       float rgb[3]) {
  const struct keeping *k = data;
  double width = k->most - k->least;
  float grey = width > 0 ? (float)((density - k->least) / width) : 1;
  (void)at;
  rgb[0] = rgb[1] = rgb[2] = 0.2f + 0.8f * grey * grey;
}

/* The least and the greatest density that are numbers. */
static enum hsr_status find_range(struct keeping *keeping,
                                  struct hsr_error *err) {
  const struct hsr_volume *v = keeping->volume;
  size_t n = (size_t)v->n[0] * v->n[1];
  float *density = malloc(n * sizeof *density);
  enum hsr_status status = density ? HSR_OK : hsr_fail_nomem(err);
  keeping->least = INFINITY;
  keeping->most = -INFINITY;
  for (uint32_t k = 0; k < v->n[2] && !status; k++) {
    status = v->slice(v->data, k, density, err);
    for (size_t c = 0; c < n && !status; c++)
      if (isfinite(density[c])) {
        keeping->least = fmin(keeping->least, (double)density[c]);
        keeping->most = fmax(keeping->most, (double)density[c]);
      }
  }
  free(density);
  return status;
}

static enum hsr_status keep(struct hsr_scene *scene, const char *path,
                            const struct hsr_volume *volume,
                            const struct hsr_volume_words *w,
                            struct hsr_error *err) {
  struct keeping keeping = {.volume = volume};
  struct hsr_error why = {.text = ""};
  enum hsr_status status = find_range(&keeping, err);
  if (status)
    return status;
  struct hsr_grid_keep rule = {.least = w->least,
                               .most = w->most,
                               .gradient = w->gradient,
                               .all_sides = w->all_sides};
  if (isnan(w->least))
    rule.least = keeping.least / 2 + keeping.most / 2;
  const struct hsr_grid_samples samples = {
      {volume->n[0], volume->n[1], volume->n[2]},
      {volume->position[0], volume->position[1], volume->position[2]},
      keep_slice,
      by_density,
      &keeping,
      keeping.least,
      keeping.most};
  struct hsr_grid grid;
  status = hsr_grid_init(&grid, &samples, &rule, &why);
  if (status == HSR_E_INPUT || status == HSR_E_REFUSED)
    hsr_fail(err, status, "%.200s: %.200s (densities are from %g to %g)", path,
             why.text, keeping.least, keeping.most);
  else if (status)
    status = hsr_fail_nomem(err);
  else if (hsr_scene_set_grid(scene, &grid))
    status = hsr_fail_nomem(err);
  hsr_grid_free(&grid);
  return status;
}

static enum hsr_status open_volume(struct hsr_volume *volume, const char *path,
                                   const struct hsr_volume_words *w,
                                   struct hsr_error *err) {
  if (w->size[0])
    return open_raw(volume, path, w, err);
  int format = format_of(path, strlen(path));
  if (format < 0)
    return hsr_fail(err, HSR_E_INPUT,
                    "%.200s: a volume ends in .nii, .nii.gz, .mhd, .mha, "
                    ".vtk, .vti or .vtr, or has the word size=NXxNYxNZ",
                    path);
  struct hsr_volume_file file = {.format = formats[format].format,
                                 .path = path};
  enum hsr_status status = hsr_volume_check(&file, err);
  if (!status)
    status = hsr_volume_open_vtk(volume, &file, err);
  free(file.text);
  return status;
}

/* --- Height maps ---------------------------------------------------------- */

/* Levels from 0 to w->levels - 1, by their share of the greatest height. */
static enum hsr_status read_heights(struct hsr_scene *scene, const char *path,
                                    const struct hsr_volume_words *w,
                                    struct hsr_error *err) {
  uint32_t size[2];
  float *value;
  enum hsr_status status = hsr_image_read(path, false, size, &value, err);
  if (status)
    return status;
  size_t n = (size_t)size[0] * size[1];
  uint32_t *level = malloc(n * sizeof *level);
  float least = INFINITY, most = -INFINITY;
  for (size_t k = 0; k < n; k++) {
    least = fminf(least, value[k]);
    most = fmaxf(most, value[k]);
  }
  float width = most > least ? most - least : 1;
  for (size_t k = 0; level && k < n; k++)
    level[k] =
        isfinite(value[k])
            ? (uint32_t)((value[k] - least) / width * (float)(w->levels - 1))
            : 0;
  const struct hsr_heights heights = {
      .n = {size[0], size[1]}, .levels = w->levels, .level = level};
  struct hsr_grid grid = {.n_cells = 0};
  status = level ? hsr_heights_grid(&grid, &heights, err) : HSR_E_NOMEM;
  if (!status)
    status = hsr_scene_set_grid(scene, &grid);
  hsr_grid_free(&grid);
  free(level);
  free(value);
  return status == HSR_E_NOMEM ? hsr_fail_nomem(err) : status;
}

/* --- Names ---------------------------------------------------------------- */

enum hsr_status hsr_volume_read(struct hsr_scene *scene, const char *name,
                                struct hsr_error *err) {
  bool is_heights = !strncmp(name, "heights-of:", 11);
  const char *file = is_heights ? name + 11 : name;
  char *path = strndup(file, hsr_name_before_words(file));
  if (!path)
    return hsr_fail_nomem(err);
  struct hsr_volume_words words;
  struct hsr_volume volume = {.data = NULL};
  enum hsr_status status = hsr_volume_words_read(&words, file, err);
  if (!status && is_heights)
    status = read_heights(scene, path, &words, err);
  else if (!status) {
    status = open_volume(&volume, path, &words, err);
    if (!status)
      status = keep(scene, path, &volume, &words, err);
    free_volume(&volume);
  }
  free(path);
  return status;
}
