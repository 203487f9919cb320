/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The visible face of every sample: docs/correct-picture.md. Two answers are
 * equal if they agree in every sample. */
#include "common/answers/kinds/ids.h"
#include "common/answers/coded.h"
#include "common/files/image.h"
#include "common/files/npy.h"
#include "common/files/suffix.h"
#include "common/view/depths.h"

#include <stdlib.h>
#include <string.h>

static size_t count_samples(const struct hsr_answer *answer) {
  return (size_t)answer->m * (size_t)answer->n;
}

uint32_t *hsr_answer_ids_of(const struct hsr_answer *answer) {
  return answer->form.type == &hsr_answer_ids ? answer->body : NULL;
}

struct hsr_answer hsr_answer_of_ids(uint32_t *ids, int m, int n) {
  return (struct hsr_answer){.form = hsr_form_standard(&hsr_answer_ids),
                             .m = m,
                             .n = n,
                             .body = ids,
                             .ids = ids};
}

static enum hsr_status make(struct hsr_answer *answer, struct hsr_error *err) {
  size_t n = count_samples(answer);
  uint32_t *ids = malloc(n * sizeof *ids);
  for (size_t k = 0; ids && k < n; k++)
    ids[k] = HSR_BACKGROUND;
  answer->body = answer->ids = ids;
  return ids ? HSR_OK : hsr_fail_nomem(err);
}

static void unset(struct hsr_answer *answer) {
  uint32_t *ids = answer->body;
  for (size_t k = 0; k < count_samples(answer); k++)
    ids[k] = HSR_NOT_WRITTEN;
}

static void free_body(struct hsr_answer *answer) {
  free(answer->body);
}

static int arrays(const struct hsr_answer *answer,
                  struct hsr_array array[HSR_MOST_ARRAYS]) {
  array[0] = (struct hsr_array){answer->body, sizeof(uint32_t)};
  return 1;
}

/* --- Comparing ------------------------------------------------------------ */

/* "face 5". Returns `text`. */
static const char *say_id(uint32_t id, char text[24]) {
  if (id == HSR_BACKGROUND)
    return "background";
  if (id == HSR_NOT_WRITTEN)
    return "nothing written";
  snprintf(text, 24, "face %u", id);
  return text;
}

static void compare(const struct hsr_comparison *c,
                    struct hsr_difference *difference) {
  const uint32_t *got = c->got->body, *wanted = c->wanted->body;
  char one[24], other[24];
  difference->compared = c->n;
  for (size_t k = 0; k < c->n; k++) {
    size_t s = c->place ? c->place[k] : k, m = (size_t)c->got->m;
    if (got[s] != wanted[s] && !difference->differing++)
      snprintf(difference->first, sizeof difference->first,
               "(%zu, %zu): %s, not %s", s % m, s / m, say_id(got[s], one),
               say_id(wanted[s], other));
  }
}

/* The wanted picture, dimmed, with the differences in bright orange. */
static enum hsr_status show_difference(const struct hsr_comparison *c,
                                       const struct hsr_showing *showing,
                                       float *rgb, struct hsr_error *err) {
  static const float mark[3] = {1.0f, .35f, 0.0f};
  const uint32_t *got = c->got->body, *wanted = c->wanted->body;
  (void)err;
  hsr_picture_shade(showing->world, showing->view, wanted, HSR_SHADE_LAMBERT,
                    rgb);
  for (size_t k = 0; k < count_samples(c->got); k++)
    for (size_t channel = 0; channel < 3; channel++)
      rgb[3 * k + channel] =
          got[k] != wanted[k] ? mark[channel] : .25f * rgb[3 * k + channel];
  return HSR_OK;
}

/* --- Showing -------------------------------------------------------------- */

static enum hsr_status shade(const struct hsr_answer *answer,
                             const struct hsr_showing *showing,
                             struct hsr_shaded *shaded, struct hsr_error *err) {
  size_t n = count_samples(answer);
  if (showing->depth)
    shaded->depth = malloc(n * sizeof *shaded->depth);
  shaded->rgb = malloc(3 * n * sizeof *shaded->rgb);
  if ((showing->depth && !shaded->depth) || !shaded->rgb)
    return hsr_fail_nomem(err);
  enum hsr_status status =
      hsr_picture_finish(showing->world, showing->view, answer->body,
                         showing->shading, shaded->depth, shaded->rgb, err);
  if (!status)
    hsr_show_background(showing, answer->body, n, shaded->rgb);
  return status;
}

/* The colours of s x s samples, averaged. */
static void average(const struct hsr_answer *answer, int s, const float *rgb,
                    float *averaged) {
  int m = answer->m / s, n = answer->n / s;
  for (int j = 0; j < n; j++)
    for (int i = 0; i < m; i++)
      for (int c = 0; c < 3; c++) {
        double sum = 0;
        for (int k = 0; k < s * s; k++)
          sum += (double)rgb[3 * ((size_t)(j * s + k / s) * (size_t)answer->m +
                                  (size_t)(i * s + k % s)) +
                             (size_t)c];
        averaged[3 * ((size_t)j * (size_t)m + (size_t)i) + (size_t)c] =
            (float)(sum / (s * s));
      }
}

/* Which share of each pixel's s x s samples shows a face. */
static void find_cover(const struct hsr_answer *answer, int s, float *alpha) {
  const uint32_t *ids = answer->body;
  int m = answer->m / s, n = answer->n / s;
  for (int j = 0; j < n; j++)
    for (int i = 0; i < m; i++) {
      int covered = 0;
      for (int k = 0; k < s * s; k++)
        covered += ids[(size_t)(j * s + k / s) * (size_t)answer->m +
                       (size_t)(i * s + k % s)] != HSR_BACKGROUND;
      alpha[(size_t)j * (size_t)m + (size_t)i] =
          (float)covered / (float)(s * s);
    }
}

/* Without a background, which is black then, there is an alpha. */
static enum hsr_status write_colours(const struct hsr_answer *answer,
                                     const struct hsr_showing *showing,
                                     const struct hsr_shaded *shaded,
                                     const char *path, struct hsr_error *err) {
  int s = showing->supersamples, m = answer->m / s, n = answer->n / s;
  size_t size = (size_t)m * (size_t)n;
  struct hsr_picture picture = {.m = m,
                                .n = n,
                                .ids = s == 1 ? answer->body : NULL,
                                .depth = s == 1 ? shaded->depth : NULL,
                                .rgb = shaded->rgb};
  float *rgb = s > 1 ? malloc(3 * size * sizeof *rgb) : NULL;
  float *alpha = showing->background.none ? malloc(size * sizeof *alpha) : NULL;
  bool lacks = (s > 1 && !rgb) || (showing->background.none && !alpha);
  if (rgb && !lacks) {
    average(answer, s, shaded->rgb, rgb);
    picture.rgb = rgb;
  }
  if (alpha && !lacks) {
    find_cover(answer, s, alpha);
    picture.alpha = alpha;
  }
  enum hsr_status status =
      lacks ? hsr_fail_nomem(err)
            : hsr_image_write(path, &picture, showing->text, err);
  free(rgb);
  free(alpha);
  return status;
}

static enum hsr_status write_depths(const struct hsr_answer *answer,
                                    const struct hsr_showing *showing,
                                    const char *path, struct hsr_error *err) {
  double *depth = malloc(count_samples(answer) * sizeof *depth);
  if (!depth)
    return hsr_fail_nomem(err);
  hsr_picture_depths(showing->world, showing->view, answer->body, depth);
  enum hsr_status status = hsr_image_write_depths(path, answer->m, answer->n,
                                                  depth, showing->text, err);
  free(depth);
  return status;
}

enum hsr_status hsr_answer_write_ids(const struct hsr_answer *answer,
                                     const char *path, struct hsr_error *err) {
  const struct hsr_npy array = {
      .kind = 'u',
      .bytes = 4,
      .n_dimensions = 2,
      .size = {(uint64_t)answer->n, (uint64_t)answer->m},
      .data = hsr_answer_ids_of(answer)};
  return hsr_npy_write(path, &array, err);
}

static enum hsr_status write(const struct hsr_answer *answer,
                             const struct hsr_showing *showing,
                             struct hsr_shaded *shaded, const char *path,
                             struct hsr_error *err) {
  if (hsr_is_depth_file(path))
    return write_depths(answer, showing, path, err);
  if (hsr_is_array_file(path) && !hsr_is_colour_array(path))
    return hsr_answer_write_ids(answer, path, err);
  return write_colours(answer, showing, shaded, path, err);
}

static enum hsr_status write_tile(const struct hsr_answer *tile,
                                  const struct hsr_tile_grid *tiling,
                                  long number, const char *text,
                                  const char *path, struct hsr_error *err) {
  return hsr_image_write_tile(path, tiling, number, tile->body, text, err);
}

static bool fits(const char *path) {
  return !hsr_is_line_file(path);
}

static void print(const struct hsr_answer *answer,
                  const struct hsr_showing *showing, FILE *out) {
  const uint32_t *ids = answer->body;
  size_t n = count_samples(answer), covered = 0;
  (void)showing;
  for (size_t k = 0; k < n; k++)
    covered += ids[k] != HSR_BACKGROUND;
  fprintf(out, "%.1f %% covered\n", 100.0 * (double)covered / (double)n);
}

/* --- Tracing -------------------------------------------------------------- */

/* The face of an accepted event is seen all over its window. */
static enum hsr_status paint(struct hsr_answer *answer,
                             const struct hsr_event *event) {
  const struct hsr_window *w = &event->window;
  uint32_t *ids = answer->body;
  int x0 = w->x0 > 0 ? w->x0 : 0, x1 = w->x1 < answer->m ? w->x1 : answer->m;
  int y0 = w->y0 > 0 ? w->y0 : 0, y1 = w->y1 < answer->n ? w->y1 : answer->n;
  for (int j = y0; j < y1; j++)
    for (int i = x0; i < x1; i++)
      ids[(size_t)j * (size_t)answer->m + (size_t)i] = event->a.id[0];
  return HSR_OK;
}

/* Runs of one id, row after row: id, length, id, length ... */
static json_t *ids_json(const struct hsr_answer *answer,
                        const struct hsr_view *view) {
  (void)view;
  return hsr_runs_json(answer->body, count_samples(answer), HSR_BACKGROUND);
}

#pragma GCC visibility push(protected) /* for modules: hsr-module.h */
const struct hsr_answer_type hsr_answer_ids = {
    .name = "ids",
    .meaning = "the visible face of every sample",
    .draws = "faces",
    .places = "samples",
    .grains = "samples",
    .by_faces = true,
    .by_windows = true,
    .by_places = true,
    .takes = 1 << HSR_SHADING | 1 << HSR_SUPERSAMPLES | 1 << HSR_BACKDROP |
             1 << HSR_NO_BACKDROP,
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
    .join_tiles = hsr_image_join_tiles,
    .print = print,
    .paint = paint,
    .json = ids_json};
#pragma GCC visibility pop
