/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef _POSIX_C_SOURCE
#define _POSIX_C_SOURCE 200809L
#endif
#include "common/files/volume/volume.h"
#include "common/files/volume/volume_words.h"
#include "common/grids/densities.h"

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
} formats[] = {
    {".nii", HSR_NIFTI},      {".nii.gz", HSR_NIFTI},  {".mhd", HSR_META_IMAGE},
    {".mha", HSR_META_IMAGE}, {".nrrd", HSR_NRRD},     {".nhdr", HSR_NRRD},
    {".vtk", HSR_VTK_LEGACY}, {".vti", HSR_VTK_IMAGE}, {".vtr", HSR_VTK_GRID}};
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

/* Positions ascend along each axis of the world. False for lack of memory. */
static bool place_samples(struct hsr_volume *volume,
                          const struct hsr_volume_place *place) {
  for (int a = 0; a < 3; a++) {
    double *at = malloc(volume->n[a] * sizeof *at);
    volume->position[a] = at;
    for (uint32_t k = 0; at && k < volume->n[a]; k++)
      at[k] = place->first[a] +
              place->step[a] * (place->step[a] < 0 ? volume->n[a] - 1 - k : k);
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
  struct hsr_volume_place place = {.first = {0, 0, 0}};
  memcpy(place.step, w->spacing, sizeof place.step);
  return raw->bytes && place_samples(volume, &place) ? HSR_OK
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
  double low, high; /* of the window */
};

static enum hsr_status keep_slice(void *data, uint32_t k, float *density,
                                  struct hsr_error *err) {
  const struct keeping *keeping = data;
  return keeping->volume->slice(keeping->volume->data, k, density, err);
}

static void by_density(void *data, const uint32_t at[3], float density,
                       float rgb[3]) {
  const struct keeping *k = data;
  double width = k->high - k->low;
  float grey = width > 0 ? (float)((density - k->low) / width) : 1;
  grey = grey > 0 ? grey < 1 ? grey : 1 : 0;
  (void)at;
  rgb[0] = rgb[1] = rgb[2] = 0.2f + 0.8f * grey * grey;
}

static enum hsr_status make_grid(struct hsr_grid *grid, const char *path,
                                 struct keeping *keeping,
                                 const struct hsr_densities *d,
                                 const struct hsr_volume_words *w,
                                 struct hsr_error *err) {
  const struct hsr_volume *v = keeping->volume;
  const struct hsr_grid_keep rule = {.least = isnan(w->least) ? d->threshold
                                                              : w->least,
                                     .most = w->most,
                                     .gradient = w->gradient,
                                     .all_sides = w->all_sides};
  const struct hsr_grid_samples samples = {
      .n = {v->n[0], v->n[1], v->n[2]},
      .position = {v->position[0], v->position[1], v->position[2]},
      .slice = keep_slice,
      .colour = by_density,
      .data = keeping,
      .low = keeping->low,
      .high = keeping->high};
  struct hsr_error why = {.text = ""};
  enum hsr_status status = hsr_grid_init(grid, &samples, &rule, &why);
  if (status == HSR_E_INPUT || status == HSR_E_REFUSED)
    return hsr_fail(err, status, "%.200s: %.200s (densities are from %g to %g)",
                    path, why.text, d->least, d->most);
  return status ? hsr_fail_nomem(err) : HSR_OK;
}

static enum hsr_status keep(struct hsr_scene *scene, const char *path,
                            const struct hsr_volume *volume,
                            const struct hsr_volume_words *w,
                            struct hsr_error *err) {
  struct hsr_densities *d = malloc(sizeof *d);
  struct keeping keeping = {.volume = volume};
  struct hsr_grid grid = {.n_cells = 0};
  enum hsr_status status = d ? HSR_OK : hsr_fail_nomem(err);
  if (!status)
    status = hsr_densities_measure(d, volume->n[2],
                                   (size_t)volume->n[0] * volume->n[1],
                                   keep_slice, &keeping, err);
  if (!status && !d->n)
    status = hsr_fail(err, HSR_E_INPUT,
                      "%.200s: no sample has a density that is a finite number",
                      path);
  if (!status) {
    bool is_given = scene->window[0] < scene->window[1];
    keeping.low = is_given ? scene->window[0] : d->low;
    keeping.high = is_given ? scene->window[1] : d->high;
    status = make_grid(&grid, path, &keeping, d, w, err);
  }
  if (!status) {
    grid.densities = d;
    d = NULL;
    status = hsr_scene_set_grid(scene, &grid) ? hsr_fail_nomem(err) : HSR_OK;
  }
  hsr_grid_free(&grid);
  free(d);
  return status;
}

/* Lines that do not fit are left out. */
static void take_notes(struct hsr_import *import, const char *notes) {
  size_t used = import ? strlen(import->notes) : 0, n = strlen(notes);
  if (import && used + n < sizeof import->notes)
    memcpy(import->notes + used, notes, n + 1);
}

static enum hsr_status open_volume(struct hsr_volume *volume, const char *path,
                                   const struct hsr_volume_words *w,
                                   struct hsr_import *import,
                                   enum hsr_volume_space *space,
                                   struct hsr_error *err) {
  if (w->size[0])
    return open_raw(volume, path, w, err);
  int format = format_of(path, strlen(path));
  if (format < 0)
    return hsr_fail(
        err, HSR_E_INPUT,
        "%.200s: a volume ends in .nii, .nii.gz, .mhd, .mha, "
        ".nrrd, .nhdr, .vtk, .vti or .vtr, or has the word size=NXxNYxNZ",
        path);
  struct hsr_volume_file file = {.format = formats[format].format,
                                 .path = path};
  enum hsr_status status = hsr_volume_check(&file, err);
  if (!status)
    status = file.bytes.n ? hsr_volume_open_bytes(volume, &file, err)
                          : hsr_volume_open_vtk(volume, &file, err);
  if (!status && file.has_place && !place_samples(volume, &file.place))
    status = hsr_fail_nomem(err);
  *space = file.space;
  take_notes(import, file.notes);
  hsr_volume_file_free(&file);
  return status;
}

/* --- Which way is up ------------------------------------------------------ */

/* A patient stands upright, and faces the viewer. */
static void stand_up(struct hsr_scene *scene, enum hsr_volume_space space) {
  static const double ras[3][3] = {{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                      lps[3][3] = {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
  if (space != HSR_NO_SPACE)
    memcpy(scene->stand, space == HSR_RAS ? ras : lps, sizeof scene->stand);
}

/* --- Names ---------------------------------------------------------------- */

enum hsr_status hsr_volume_read(struct hsr_scene *scene, const char *name,
                                struct hsr_import *import,
                                struct hsr_error *err) {
  bool is_heights = !strncmp(name, "heights-of:", 11);
  const char *file = is_heights ? name + 11 : name;
  char *path = strndup(file, hsr_name_before_words(file));
  if (!path)
    return hsr_fail_nomem(err);
  struct hsr_volume_words words;
  struct hsr_volume volume = {.data = NULL};
  enum hsr_volume_space space = HSR_NO_SPACE;
  enum hsr_status status = hsr_volume_words_read(&words, file, err);
  if (!status && is_heights)
    status = hsr_heights_read(scene, path, &words, err);
  else if (!status) {
    status = open_volume(&volume, path, &words, import, &space, err);
    stand_up(scene, space);
    if (!status)
      status = keep(scene, path, &volume, &words, err);
    free_volume(&volume);
  }
  free(path);
  return status;
}
