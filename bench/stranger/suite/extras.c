/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Depths and segments that somebody has found beside the ids.
 *
 * Depths      a depth is right if its relative error is at most 1e-12, or 1e-6 in
 *             an array of floats; of no face it is infinite.
 * Segments    as docs/correct-drawing.md has it. */
#include "bench/stranger/suite/suite.h"
#include "common/files/npy.h"
#include "common/lines/drawing.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

enum { MOST_PATH = 4600, COLUMNS = 7 }; /* of an interval, without its ends */

static const char *const names[] = {"depths", "segments"};

const char *suite_extra_name(enum suite_extra_kind kind) {
  return names[kind];
}

const char *suite_extra_places(enum suite_extra_kind kind) {
  return kind == SUITE_DEPTHS ? "depths" : "edges";
}

static double number_at(const struct hsr_npy *a, size_t k) {
  return a->bytes == 4 ? (double)((const float *)a->data)[k]
                       : ((const double *)a->data)[k];
}

/* --- Depths --------------------------------------------------------------- */

static bool are_depths(const struct hsr_npy *a, const struct suite_result *r) {
  return a->kind == 'f' && a->n_dimensions == 2 &&
         a->size[0] == (uint64_t)r->n && a->size[1] == (uint64_t)r->m;
}

static void compare_depths(const struct hsr_npy *got,
                           const struct hsr_npy *right,
                           struct suite_extra *extra) {
  const double most = got->bytes == 4 ? 1e-6 : 1e-12;
  extra->compared = hsr_npy_count(right);
  for (size_t k = 0; k < extra->compared; k++) {
    const double a = number_at(got, k), b = number_at(right, k);
    const bool both = isfinite(a) && isfinite(b);
    const double error = both ? fabs(a - b) / fabs(b) : a == b ? 0 : INFINITY;
    extra->differing += error <= most ? 0 : 1;
    if (both && error > extra->largest)
      extra->largest = error;
  }
}

/* --- Segments ------------------------------------------------------------- */

static bool is_number(double x) {
  return x >= 0 && x < UINT32_MAX && x == floor(x);
}

/* One row. False if it is no interval. */
static bool take_row(const double row[COLUMNS], struct hsr_segment *s) {
  bool good = (row[0] == 0 || row[0] == 1) && row[5] >= 0 && row[5] <= row[6] &&
              row[6] <= 1;
  for (int k = 1; k <= 4; k++)
    good &= is_number(row[k]);
  if (!good)
    return false;
  *s = (struct hsr_segment){.edge = {row[0] == 1, (uint32_t)row[1],
                                     (uint32_t)row[2], (uint32_t)row[3]},
                            .invisibility = (uint32_t)row[4],
                            .t0 = row[5],
                            .t1 = row[6]};
  return s->edge.a < s->edge.b;
}

/* Reads the rows of an array of segments, and sorts them. */
static enum hsr_status take_segments(const struct hsr_npy *a, const char *path,
                                     struct hsr_drawing *drawing,
                                     struct hsr_error *err) {
  if (a->kind != 'f' || a->n_dimensions != 2 || a->size[1] < COLUMNS)
    return hsr_fail(err, HSR_E_INPUT,
                    "%.300s: must be floats, with %d columns or more", path,
                    (int)COLUMNS);
  enum hsr_status status = HSR_OK;
  for (size_t k = 0; k < a->size[0] && !status; k++) {
    double row[COLUMNS];
    struct hsr_segment segment;
    for (size_t c = 0; c < COLUMNS; c++)
      row[c] = number_at(a, k * (size_t)a->size[1] + c);
    if (!take_row(row, &segment))
      status =
          hsr_fail(err, HSR_E_INPUT, "%.300s: row %zu is no interval", path, k);
    else if (hsr_drawing_add(drawing, &segment))
      status = hsr_fail_nomem(err);
  }
  return status || !hsr_drawing_gather(drawing) ? status : hsr_fail_nomem(err);
}

static enum hsr_status
compare_drawings(const struct hsr_npy *got, const char *got_path,
                 const struct hsr_npy *right, const char *right_path,
                 struct suite_extra *extra, struct hsr_error *err) {
  struct hsr_drawing drawing = {.segment = NULL}, wanted = {.segment = NULL};
  struct hsr_drawing_difference found;
  enum hsr_status status = take_segments(right, right_path, &wanted, err);
  if (!status) {
    struct hsr_error why;
    status = take_segments(got, got_path, &drawing, &why);
    if (status == HSR_E_INPUT) {
      memcpy(extra->why, why.text, sizeof extra->why);
      status = HSR_OK;
    } else if (!status) {
      hsr_drawing_compare(&drawing, &wanted, false, &found);
      extra->compared = found.edges;
      extra->differing = found.differing;
    }
  }
  hsr_drawing_free(&drawing);
  hsr_drawing_free(&wanted);
  return status;
}

/* --- A file --------------------------------------------------------------- */

static enum hsr_status compare(enum suite_extra_kind kind,
                               struct suite_result *r,
                               const struct hsr_npy *got, const char *path,
                               const char *right_path, struct hsr_error *err) {
  struct suite_extra *extra = &r->extra[kind];
  struct hsr_npy right = {.data = NULL};
  enum hsr_status status = hsr_npy_read(right_path, &right, err);
  if (!status && kind == SUITE_SEGMENTS)
    status = compare_drawings(got, path, &right, right_path, extra, err);
  else if (!status && !are_depths(&right, r))
    status = hsr_fail(err, HSR_E_INPUT, "%.300s: are no %d x %d depths",
                      right_path, r->m, r->n);
  else if (!status && !are_depths(got, r))
    snprintf(extra->why, sizeof extra->why,
             "%.300s: must be floats, %d rows of %d", path, r->n, r->m);
  else if (!status)
    compare_depths(got, &right, extra);
  hsr_npy_free(&right);
  return status;
}

static enum hsr_status judge_extra(const struct suite_judgement *j,
                                   enum suite_extra_kind kind,
                                   struct suite_result *r,
                                   struct hsr_error *err) {
  char path[MOST_PATH], right[MOST_PATH];
  struct suite_extra *extra = &r->extra[kind];
  struct hsr_npy got = {.data = NULL};
  struct hsr_error why;
  snprintf(path, sizeof path, "%s/%s.%s.npy", j->results, r->name, names[kind]);
  snprintf(right, sizeof right, "%s/right/%s.%s.npy", j->suite, r->name,
           names[kind]);
  if (access(path, F_OK))
    return HSR_OK;
  extra->pictures = 1;
  if (access(right, F_OK)) {
    snprintf(extra->why, sizeof extra->why,
             "%.300s: the suite has no right %s of this picture", path,
             names[kind]);
    return HSR_OK;
  }
  enum hsr_status status = hsr_npy_read(path, &got, &why);
  if (status == HSR_E_INPUT)
    memcpy(extra->why, why.text, sizeof extra->why);
  else
    status = status ? hsr_fail(err, status, "%s", why.text)
                    : compare(kind, r, &got, path, right, err);
  hsr_npy_free(&got);
  if (extra->differing || *extra->why)
    extra->first = r->name;
  return status == HSR_E_INPUT && *extra->why ? HSR_OK : status;
}

enum hsr_status suite_judge_extras(const struct suite_judgement *judgement,
                                   struct suite_result *result,
                                   struct hsr_error *err) {
  enum hsr_status status = judge_extra(judgement, SUITE_DEPTHS, result, err);
  return status ? status : judge_extra(judgement, SUITE_SEGMENTS, result, err);
}
