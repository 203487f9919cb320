/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/stranger/picture.h"
#include "bench/stranger/table.h"
#include "common/files/image.h"
#include "common/files/npy.h"
#include "common/files/suffix.h"
#include "common/files/whole_input.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A picture that is read. */
struct reading {
  const struct picture_format *format;
  uint32_t n_faces;
  struct hsr_npy array;
  struct table colours;
  struct table triangles;
  struct id_picture *picture;
  struct hsr_error *err;
};

static enum hsr_status fail(struct reading *r, const char *what) {
  return hsr_fail(r->err, HSR_E_INPUT, "%s: %s",
                  hsr_path_shown(r->format->path), what);
}

enum { PLACE = 64 };

/* --- Numbers -------------------------------------------------------------- */

/* The place of a number, for messages: "(3, 4)". */
static const char *say_place(const struct reading *r, size_t k,
                             char text[PLACE]) {
  size_t m = (size_t)r->picture->m;
  snprintf(text, PLACE, "(%zu, %zu)", k % m, k / m);
  return text;
}

/* A number of an array, and whether all its bits are set. */
static double number_at(const struct hsr_npy *a, size_t k, bool *all_set) {
  const void *d = a->data;
  const bool is_signed = a->kind == 'i';
  *all_set = false;
  if (a->kind == 'f')
    return a->bytes == 4 ? (double)((const float *)d)[k]
                         : ((const double *)d)[k];
  int64_t value = 0;
  switch (a->bytes) {
  case 1:
    value = is_signed ? ((const int8_t *)d)[k] : ((const uint8_t *)d)[k];
    *all_set = ((const uint8_t *)d)[k] == UINT8_MAX;
    break;
  case 2:
    value = is_signed ? ((const int16_t *)d)[k] : ((const uint16_t *)d)[k];
    *all_set = ((const uint16_t *)d)[k] == UINT16_MAX;
    break;
  case 4:
    value =
        is_signed ? ((const int32_t *)d)[k] : (int64_t)((const uint32_t *)d)[k];
    *all_set = ((const uint32_t *)d)[k] == UINT32_MAX;
    break;
  default:
    *all_set = ((const uint64_t *)d)[k] == UINT64_MAX;
    return is_signed ? (double)((const int64_t *)d)[k]
                     : (double)((const uint64_t *)d)[k];
  }
  return (double)value;
}

/* The id that a number stands for. */
static enum hsr_status take_id(struct reading *r, size_t k, uint32_t *id) {
  const struct picture_format *f = r->format;
  char place[PLACE];
  bool all_set;
  double v = number_at(&r->array, k, &all_set);
  *id = HSR_BACKGROUND;
  if (f->has_none && v == (double)f->none)
    return HSR_OK;
  if (v == -1 || v == UINT32_MAX || (all_set && v >= r->n_faces) ||
      (r->array.kind == 'f' && v == 0x1p32)) /* UINT32_MAX as a float */
    return HSR_OK;
  if (!(v == floor(v)) || isinf(v))
    return hsr_fail(r->err, HSR_E_INPUT, "%s: sample %s is %g, no whole number",
                    hsr_path_shown(f->path), say_place(r, k, place), v);
  if (v < 0)
    return hsr_fail(r->err, HSR_E_INPUT,
                    "%s: sample %s is %.0f; of what is negative, only -1 has a "
                    "meaning: no face",
                    hsr_path_shown(f->path), say_place(r, k, place), v);
  if (v > UINT32_MAX - 2 && r->n_faces == UINT32_MAX)
    return hsr_fail(
        r->err, HSR_E_INPUT,
        "%s: sample %s has face %.0f; a number of 32 bits is wanted",
        hsr_path_shown(f->path), say_place(r, k, place), v);
  if (v > UINT32_MAX - 2)
    return hsr_fail(r->err, HSR_E_INPUT,
                    "%s: sample %s has face %.0f, which does not exist: the "
                    "scene has faces 0 to %u",
                    hsr_path_shown(f->path), say_place(r, k, place), v,
                    r->n_faces - 1);
  *id = (uint32_t)v;
  return HSR_OK;
}

/* --- Colours -------------------------------------------------------------- */

static int compare_colours(const void *a, const void *b) {
  return memcmp(a, b, 3 * sizeof(uint32_t));
}

static enum hsr_status read_colours(struct reading *r) {
  struct table *t = &r->colours;
  enum hsr_status status = table_read(r->format->colours, 4, t, r->err);
  if (status)
    return status;
  qsort(t->number, t->rows, 4 * sizeof *t->number, compare_colours);
  for (size_t k = 0; k + 1 < t->rows; k++)
    if (!compare_colours(t->number + 4 * k, t->number + 4 * k + 4))
      return hsr_fail(r->err, HSR_E_INPUT, "%s: the colour %u %u %u twice",
                      hsr_path_shown(r->format->colours), t->number[4 * k],
                      t->number[4 * k + 1], t->number[4 * k + 2]);
  return HSR_OK;
}

/* The id that a colour stands for. */
static enum hsr_status take_colour(struct reading *r, size_t k, uint32_t *id) {
  const struct hsr_npy *a = &r->array;
  const size_t n = (size_t)a->size[2];
  uint32_t colour[3];
  char place[PLACE];
  for (size_t c = 0; c < 3; c++)
    colour[c] = a->bytes == 1
                    ? ((const uint8_t *)a->data)[k * n + (n < 3 ? 0 : c)]
                    : ((const uint16_t *)a->data)[k * n + (n < 3 ? 0 : c)];
  const uint32_t *row = bsearch(colour, r->colours.number, r->colours.rows,
                                4 * sizeof *r->colours.number, compare_colours);
  if (!row)
    return hsr_fail(r->err, HSR_E_INPUT,
                    "%s: sample %s has the colour %u %u %u, which is not in %s",
                    hsr_path_shown(r->format->path), say_place(r, k, place),
                    colour[0], colour[1], colour[2],
                    hsr_path_shown(r->format->colours));
  *id = row[3];
  return HSR_OK;
}

/* --- Triangles ------------------------------------------------------------ */

/* A table of triangles in an array. */
static enum hsr_status take_array(struct reading *r, const char *path) {
  struct hsr_npy a;
  struct table *t = &r->triangles;
  enum hsr_status status = hsr_npy_read(path, &a, r->err);
  if (status)
    return status;
  t->rows = hsr_npy_count(&a);
  t->number = malloc((t->rows + 1) * sizeof *t->number);
  if (!t->number)
    status = hsr_fail_nomem(r->err);
  else if (a.n_dimensions != 1 || !t->rows)
    status = hsr_fail(r->err, HSR_E_INPUT,
                      "%s: must have one dimension: the face of each triangle",
                      hsr_path_shown(path));
  for (size_t k = 0; k < t->rows && !status; k++) {
    bool all_set;
    double v = number_at(&a, k, &all_set);
    if (v >= 0 && v < UINT32_MAX && v == floor(v))
      t->number[k] = (uint32_t)v;
    else
      status = hsr_fail(r->err, HSR_E_INPUT, "%s: number %zu is no face",
                        hsr_path_shown(path), k);
  }
  hsr_npy_free(&a);
  return status;
}

static enum hsr_status read_triangles(struct reading *r) {
  const char *path = r->format->triangles;
  enum hsr_status status = hsr_is_array_file(path)
                               ? take_array(r, path)
                               : table_read(path, 1, &r->triangles, r->err);
  for (size_t k = 0; k < r->triangles.rows && !status; k++)
    if (r->triangles.number[k] >= r->n_faces)
      status = hsr_fail(r->err, HSR_E_INPUT,
                        "%s: triangle %zu has face %u, which does not exist: "
                        "the scene has faces 0 to %u",
                        hsr_path_shown(path), k, r->triangles.number[k],
                        r->n_faces - 1);
  return status;
}

/* Puts the face in the place of its triangle. */
static enum hsr_status take_triangle(struct reading *r, size_t k) {
  uint32_t *id = &r->picture->ids[k];
  char place[PLACE];
  if (*id == HSR_BACKGROUND)
    return HSR_OK;
  if (*id >= r->triangles.rows)
    return hsr_fail(r->err, HSR_E_INPUT,
                    "%s: sample %s has triangle %u; %s has triangles 0 to %zu",
                    hsr_path_shown(r->format->path), say_place(r, k, place),
                    *id, hsr_path_shown(r->format->triangles),
                    r->triangles.rows - 1);
  *id = r->triangles.number[*id];
  return HSR_OK;
}

/* --- Files ---------------------------------------------------------------- */

static bool is_raw(const char *path) {
  return hsr_ends_in(path, ".raw") || hsr_ends_in(path, ".u32") ||
         hsr_ends_in(path, ".bin");
}

/* A file of nothing but ids: 32 bits, the least significant byte first. */
static enum hsr_status read_raw(struct reading *r) {
  const struct picture_format *f = r->format;
  unsigned char *bytes;
  size_t size, n = (size_t)f->m * (size_t)f->n;
  enum hsr_status status = hsr_whole_input(f->path, &bytes, &size, r->err);
  if (status)
    return status;
  if (size != 4 * n)
    status =
        hsr_fail(r->err, HSR_E_INPUT, "%s: has %zu bytes; %d x %d ids are %zu",
                 hsr_path_shown(f->path), size, f->m, f->n, 4 * n);
  for (size_t k = 0; k < n && !status; k++) {
    const unsigned char *b = bytes + 4 * k;
    uint32_t id = b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 |
                  (uint32_t)b[3] << 24;
    memcpy(bytes + 4 * k, &id, sizeof id);
  }
  r->array = (struct hsr_npy){.kind = 'u',
                              .bytes = 4,
                              .n_dimensions = 2,
                              .size = {(uint64_t)f->n, (uint64_t)f->m},
                              .data = bytes};
  return status;
}

/* A picture in colours. */
static enum hsr_status read_painted(struct reading *r) {
  enum hsr_status status =
      hsr_image_read_numbers(r->format->path, NULL, &r->array, r->err);
  if (!status)
    status = read_colours(r);
  if (!status && (r->array.kind != 'u' || r->array.bytes > 2))
    status = fail(r, "colours of 8 or 16 bits are needed");
  return status;
}

/* Checks what was asked for against the kind of file. */
static enum hsr_status check_format(struct reading *r) {
  const struct picture_format *f = r->format;
  const char *path = hsr_path_shown(f->path);
  const bool exr = hsr_ends_in(f->path, ".exr"), raw = is_raw(f->path),
             npy = hsr_is_array_file(f->path);
  if (!hsr_is_colour_file(f->path) && !npy)
    return hsr_fail(r->err, HSR_E_USAGE,
                    "%s: a picture is .npy, .exr, .raw, or colours with "
                    "--colours",
                    path);
  if (f->channel && !exr)
    return hsr_fail(r->err, HSR_E_USAGE, "%s: --channel is for .exr files",
                    path);
  if (f->colours && (exr || raw || npy))
    return hsr_fail(r->err, HSR_E_USAGE,
                    "%s: --colours is for .png files and others of colours",
                    path);
  if (!f->colours && !exr && !raw && !npy)
    return hsr_fail(
        r->err, HSR_E_USAGE,
        "%s: a picture is .npy, .exr or .raw; of colours, --colours "
        "FILE says which is which face",
        path);
  if (raw && !f->m)
    return hsr_fail(r->err, HSR_E_USAGE,
                    "%s: --size says how many columns and rows it has", path);
  return HSR_OK;
}

static enum hsr_status read_file(struct reading *r) {
  const struct picture_format *f = r->format;
  enum hsr_status status = check_format(r);
  if (status)
    return status;
  if (hsr_is_array_file(f->path))
    return hsr_npy_read(f->path, &r->array, r->err);
  if (is_raw(f->path))
    return read_raw(r);
  if (f->colours)
    return read_painted(r);
  return hsr_image_read_numbers(f->path, f->channel ? f->channel : "id",
                                &r->array, r->err);
}

static enum hsr_status check_shape(struct reading *r) {
  const struct picture_format *f = r->format;
  const struct hsr_npy *a = &r->array;
  const char *path = hsr_path_shown(f->path);
  if (a->n_dimensions != (f->colours ? 3 : 2))
    return hsr_fail(r->err, HSR_E_INPUT,
                    "%s: an array of %d dimensions; 2 are needed, rows and "
                    "columns",
                    path, a->n_dimensions);
  const unsigned long long m = a->size[1], n = a->size[0];
  if (m < 1 || n < 1 || m > HSR_MAX_SIZE || n > HSR_MAX_SIZE)
    return hsr_fail(r->err, HSR_E_INPUT,
                    "%s: %llu x %llu samples; each side must be 1 to %d", path,
                    m, n, HSR_MAX_SIZE);
  r->picture->m = (int)m;
  r->picture->n = (int)n;
  r->picture->is_exchanged =
      f->m != f->n && r->picture->m == f->n && r->picture->n == f->m;
  if (f->m && !r->picture->is_exchanged &&
      (r->picture->m != f->m || r->picture->n != f->n))
    return hsr_fail(r->err, HSR_E_INPUT,
                    "%s: has %llu x %llu samples (columns x rows), not %d x %d",
                    path, m, n, f->m, f->n);
  return HSR_OK;
}

static enum hsr_status take_ids(struct reading *r) {
  const size_t n = (size_t)r->picture->m * (size_t)r->picture->n;
  uint32_t *ids = r->picture->ids = malloc(n * sizeof *ids);
  enum hsr_status status = ids ? HSR_OK : hsr_fail_nomem(r->err);
  for (size_t k = 0; k < n && !status; k++) {
    status = r->format->colours ? take_colour(r, k, &ids[k])
                                : take_id(r, k, &ids[k]);
    if (!status && r->format->triangles)
      status = take_triangle(r, k);
  }
  return status;
}

enum hsr_status picture_read(const struct picture_format *format,
                             uint32_t n_faces, struct id_picture *picture,
                             struct hsr_error *err) {
  struct reading r = {
      .format = format, .n_faces = n_faces, .picture = picture, .err = err};
  *picture = (struct id_picture){.ids = NULL};
  enum hsr_status status = read_file(&r);
  if (!status)
    status = check_shape(&r);
  if (!status && format->triangles)
    status = read_triangles(&r);
  if (!status)
    status = take_ids(&r);
  hsr_npy_free(&r.array);
  free(r.colours.number);
  free(r.triangles.number);
  return status;
}
