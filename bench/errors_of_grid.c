/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr errors of a grid: how far pictures of it are from the integral of emission
 * and absorption along the rays of pixels (docs/integral.md).
 *
 * The error of a channel is its distance from the interval that holds the
 * integral, 0 within it; that of a pixel is the greatest of its channels, red,
 * green, blue and opacity. */
#include "bench/errors.h"
#include "bench/modules/variant.h"
#include "bench/options/picture.h"
#include "bench/results/json.h"
#include "bench/terminal/terminal.h"
#include "common/answers/kinds/composited.h"
#include "common/files/image.h"
#include "common/files/json/json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CHANNELS = INTEGRAL_CHANNELS };
static const double usual_width = 0.001;

/* The integral of a field. */
struct truth {
  double (*bounds)[2]; /* of CHANNELS m n channels; NULL: not yet asked for */
  struct integral_reach reach;
  double shown; /* the share of pixels that are not black */
};

struct measures {
  const struct errors_options *options;
  struct lib_scene *scene;
  struct hsr_scene *own; /* of the judge */
  struct hsr_view view;
  struct truth truth[N_INTEGRAL_FIELDS];
  float *shown, *error; /* m n */
  double *value;        /* CHANNELS m n: of one picture */
};

/* What is told of a picture. */
struct measured {
  const char *name;
  enum integral_field field;
  double mean, most_of_them, largest, over, too_opaque;
  int x, y; /* of the largest */
  char where[MOST_FILE_NAME];
};

static size_t n_pixels(const struct measures *m) {
  return (size_t)m->view.m * (size_t)m->view.n;
}

/* --- The integral --------------------------------------------------------- */

static bool tell_rows(void *whom, size_t rows, size_t all) {
  progress_tell(whom, rows, all, "rows", "the integral");
  return true;
}

static double share_shown(const struct measures *m, const struct truth *t) {
  size_t n = 0;
  for (size_t k = 0; k < n_pixels(m); k++)
    n += t->bounds[CHANNELS * k + 3][1] > 0;
  return (double)n / (double)n_pixels(m);
}

static enum hsr_status find_truth(struct measures *m, enum integral_field field,
                                  struct hsr_error *err) {
  struct truth *t = &m->truth[field];
  if (t->bounds)
    return HSR_OK;
  struct progress progress = progress_begin(stderr);
  const struct integral_options options = {
      .field = field,
      .width = m->options->width > 0 ? m->options->width : usual_width,
      .threads = (int)m->options->threads,
      .tell = tell_rows,
      .whom = &progress};
  t->bounds = malloc(CHANNELS * n_pixels(m) * sizeof *t->bounds);
  enum hsr_status status = t->bounds
                               ? integral_find(m->own->grid, &m->view, &options,
                                               t->bounds, &t->reach, err)
                               : hsr_fail_nomem(err);
  progress_end(&progress);
  if (!status)
    t->shown = share_shown(m, t);
  return status;
}

/* --- Measuring ------------------------------------------------------------ */

/* How far a value is from an interval. What is brighter than 1 counts as 1. */
static double distance(double value, const double bounds[2]) {
  const double shown = fmin(value, 1);
  return fmax(0, fmax(fmin(bounds[0], 1) - shown, shown - fmin(bounds[1], 1)));
}

static double error_of(const double *value, const double (*bounds)[2]) {
  double worst = 0;
  for (int c = 0; c < CHANNELS; c++)
    worst = fmax(worst, distance(value[c], bounds[c]));
  return worst;
}

static int by_size(const void *a, const void *b) {
  float x = *(const float *)a, y = *(const float *)b;
  return (x > y) - (x < y);
}

static void measure(struct measures *m, struct measured *told) {
  const double(*bounds)[2] = (const double(*)[2])m->truth[told->field].bounds;
  size_t n = n_pixels(m), over = 0;
  double sum = 0, too_opaque = 0;
  for (size_t k = 0; k < n; k++) {
    const double(*here)[2] = bounds + CHANNELS * k;
    double error = error_of(m->value + CHANNELS * k, here);
    sum += error;
    over += error > errors_much;
    too_opaque += fmin(m->value[CHANNELS * k + 3], 1) -
                  (fmin(here[3][0], 1) + fmin(here[3][1], 1)) / 2;
    m->shown[k] = errors_shown(error);
    m->error[k] = (float)error;
    if (error > told->largest) {
      told->largest = error;
      told->x = (int)(k % (size_t)m->view.m);
      told->y = (int)(k / (size_t)m->view.m);
    }
  }
  told->mean = sum / (double)n;
  told->over = (double)over / (double)n;
  told->too_opaque = too_opaque / (double)n;
  qsort(m->error, n, sizeof *m->error, by_size);
  told->most_of_them = (double)m->error[(99 * n + 99) / 100 - 1];
}

/* --- Pictures ------------------------------------------------------------- */

static enum hsr_status draw(struct measures *m, const char *algorithm,
                            struct hsr_error *err) {
  struct hsr_request request = client_request(&m->options->view, algorithm, 1);
  struct lib_answer *answer = NULL;
  const uint16_t *rgba;
  int channels;
  request.threads = (int)m->options->threads;
  enum hsr_status status = hsr_draw(m->scene, &request, &answer, err);
  if (!status)
    status = hsr_get_rgba(answer, &rgba, &channels, err);
  for (size_t k = 0; !status && k < CHANNELS * n_pixels(m); k++)
    m->value[k] = rgba[k] / 65535.;
  hsr_free(answer);
  return status;
}

/* Splats that are added are measured by sums, if nothing else is asked for. */
static enum hsr_status choose_field(const struct measures *m,
                                    const char *algorithm,
                                    enum integral_field *field,
                                    struct hsr_error *err) {
  struct hsr_variant variant;
  enum hsr_status status = hsr_variant_parse(algorithm, &variant, err);
  if (status)
    return status;
  const struct hsr_form *form = &variant.choice.form;
  if (form->type != HSR_COMPOSITED)
    return hsr_fail(err, HSR_E_USAGE,
                    "errors: %s draws %s; of a grid the pictures of splats are "
                    "measured",
                    algorithm, form->type->draws);
  *field = !m->options->has_field && hsr_form_splatting(form).model == HSR_XRAY
               ? INTEGRAL_SUMS
               : m->options->field;
  return HSR_OK;
}

static double number_of(const struct hsr_npy *array, size_t k) {
  if (array->kind == 'f')
    return array->bytes == 4 ? (double)((const float *)array->data)[k]
                             : ((const double *)array->data)[k];
  switch (array->bytes) {
  case 1:
    return ((const uint8_t *)array->data)[k] / 255.;
  case 2:
    return ((const uint16_t *)array->data)[k] / 65535.;
  default:
    return ((const uint32_t *)array->data)[k] / 4294967295.;
  }
}

static bool is_picture(const struct measures *m, const struct hsr_npy *array) {
  return array->n_dimensions == 3 && array->size[0] == (uint64_t)m->view.n &&
         array->size[1] == (uint64_t)m->view.m && array->size[2] == CHANNELS &&
         array->kind != 'i' && (array->kind == 'f' || array->bytes < 8);
}

static enum hsr_status read_picture(struct measures *m, const char *path,
                                    struct hsr_error *err) {
  const char *suffix = strrchr(path, '.');
  struct hsr_npy array = {.data = NULL};
  enum hsr_status status =
      suffix && !strcmp(suffix, ".npy")
          ? hsr_npy_read(path, &array, err)
          : hsr_image_read_numbers(path, NULL, &array, err);
  if (!status && !is_picture(m, &array))
    status = hsr_fail(err, HSR_E_INPUT,
                      "%.200s: not red, green, blue and opacity of %d x %d "
                      "pixels",
                      path, m->view.m, m->view.n);
  for (size_t k = 0; !status && k < CHANNELS * n_pixels(m); k++) {
    m->value[k] = number_of(&array, k);
    if (!isfinite(m->value[k]))
      status =
          hsr_fail(err, HSR_E_INPUT, "%.200s: holds what is no number", path);
  }
  hsr_npy_free(&array);
  return status;
}

/* --- Output --------------------------------------------------------------- */

static void print_head(const struct measures *m) {
  char name[TERMINAL_NAME];
  printf(
      "%s, view %ld, %d x %d pixels, against the integral along their rays\n",
      terminal_plain(m->options->scene.name, name, sizeof name),
      m->options->view.view, m->view.m, m->view.n);
}

static void print_truth(const struct measures *m, enum integral_field field) {
  const struct truth *t = &m->truth[field];
  printf("\n%s: %s\nintervals are up to %.2g wide", integral_fields[field].name,
         integral_fields[field].meaning, t->reach.widest);
  if (t->reach.n_wide)
    printf(", wider than asked in %zu pixels", t->reach.n_wide);
  printf("; %.1f %% of the pixels show something\n\n"
         "    mean      99 %%    largest  at           over 1/256   opacity  "
         "picture\n",
         100 * t->shown);
}

static void print_measured(const struct measured *told) {
  char at[30];
  snprintf(at, sizeof at, "(%d, %d)", told->x, told->y);
  printf("%8.6f %9.6f %10.6f  %-13s %8.2f %% %+9.6f  %s\n", told->mean,
         told->most_of_them, told->largest, at, 100 * told->over,
         told->too_opaque, told->name);
}

static json_t *measured_json(const struct measured *told) {
  return json_pack("{ss ss sf sf sf si si sf sf so}", "picture", told->name,
                   "field", integral_fields[told->field].name, "mean",
                   told->mean, "percentile_99", told->most_of_them, "largest",
                   told->largest, "x", told->x, "y", told->y, "over",
                   told->over, "opacity", told->too_opaque, "where",
                   *told->where ? json_string(told->where) : json_null());
}

static json_t *truth_json(const struct truth *t, int field) {
  return json_pack("{ss sf sI sf sI}", "field", integral_fields[field].name,
                   "widest", t->reach.widest, "wide",
                   (json_int_t)t->reach.n_wide, "shown", t->shown, "pieces",
                   (json_int_t)t->reach.pieces);
}

static json_t *all_json(const struct measures *m, json_t *pictures) {
  const struct errors_options *o = m->options;
  json_t *integrals = json_array();
  for (int k = 0; k < N_INTEGRAL_FIELDS; k++)
    if (m->truth[k].bounds)
      hsr_json_append(&integrals, truth_json(&m->truth[k], k));
  return json_pack("{ss ss si si si sf so so}", "schema", "hsr-volume-errors/1",
                   "scene", o->scene.name, "view", (int)o->view.view, "width",
                   m->view.m, "height", m->view.n, "interval",
                   o->width > 0 ? o->width : usual_width, "integrals",
                   integrals, "pictures", pictures);
}

/* --- The work ------------------------------------------------------------- */

struct told {
  json_t *pictures; /* with --json */
  long number;
  int field; /* of the heading that is written; -1: none yet */
};

/* Measures what is in m->value. */
static enum hsr_status tell(struct measures *m, const char *name,
                            enum integral_field field, struct told *told,
                            struct hsr_error *err) {
  struct measured measured = {.name = name, .field = field};
  enum hsr_status status = find_truth(m, field, err);
  if (status)
    return status;
  measure(m, &measured);
  status = errors_write_where(m->options, ++told->number, m->shown,
                              measured.where, err);
  if (told->pictures) {
    hsr_json_append(&told->pictures, measured_json(&measured));
    return status;
  }
  if (told->field != (int)field)
    print_truth(m, field);
  told->field = (int)field;
  print_measured(&measured);
  fflush(stdout);
  return status;
}

static enum hsr_status tell_all(struct measures *m, struct told *told,
                                struct hsr_error *err) {
  static const char *const usual[] = {"splat",
                                      "splat:model=under",
                                      "splat-sheet",
                                      "splat-volume",
                                      "splat:kernel=gaussian",
                                      "splat-sheet:kernel=gaussian",
                                      "splat-volume:kernel=gaussian",
                                      "splat-xray"};
  const struct errors_options *o = m->options;
  const bool is_usual = !o->n_algorithms && !o->n_pictures;
  const char *const *algorithm = is_usual ? usual : o->algorithm;
  const int n =
      is_usual ? (int)(sizeof usual / sizeof *usual) : o->n_algorithms;
  enum hsr_status status = HSR_OK;
  for (int k = 0; k < o->n_pictures && !status; k++) {
    status = read_picture(m, o->picture[k], err);
    if (!status)
      status = tell(m, o->picture[k], o->field, told, err);
  }
  for (int k = 0; k < n && !status; k++) {
    enum integral_field field = m->options->field;
    status = choose_field(m, algorithm[k], &field, err);
    if (!status)
      status = draw(m, algorithm[k], err);
    if (!status)
      status = tell(m, algorithm[k], field, told, err);
  }
  return status;
}

static enum hsr_status make_room(struct measures *m, struct hsr_error *err) {
  m->shown = malloc(n_pixels(m) * sizeof *m->shown);
  m->error = malloc(n_pixels(m) * sizeof *m->error);
  m->value = malloc(CHANNELS * n_pixels(m) * sizeof *m->value);
  return m->shown && m->error && m->value ? HSR_OK : hsr_fail_nomem(err);
}

static enum hsr_status find(struct measures *m, struct hsr_error *err) {
  const struct errors_options *o = m->options;
  struct told told = {.pictures = o->json ? json_array() : NULL, .field = -1};
  enum hsr_status status = make_room(m, err);
  if (!status && o->json && !told.pictures)
    status = hsr_fail_nomem(err);
  if (!status && !o->json)
    print_head(m);
  if (!status)
    status = tell_all(m, &told, err);
  if (!status && o->json)
    return json_print(all_json(m, told.pictures), err);
  json_decref(told.pictures);
  return status;
}

/* The judge opens the scene itself. */
enum hsr_status errors_of_grid(const struct errors_options *o,
                               struct lib_scene *scene, struct hsr_error *err) {
  struct measures m = {.options = o, .scene = scene};
  struct hsr_import import = o->scene.import;
  enum hsr_status status = hsr_scene_open(o->scene.name, &import, &m.own, err);
  if (!status)
    status = choose_view(&o->view, m.own, 1, &m.view, err);
  if (!status)
    status = find(&m, err);
  for (int k = 0; k < N_INTEGRAL_FIELDS; k++)
    free(m.truth[k].bounds);
  free(m.shown);
  free(m.error);
  free(m.value);
  hsr_scene_delete(m.own);
  return status;
}
