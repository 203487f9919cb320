/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/suite/right.h"
#include "bench/library/within.h"
#include "bench/terminal/interrupt.h"

#include <stdlib.h>
#include <string.h>

struct right {
  struct lib_scene *scene;
};

enum hsr_status right_open(const char *path, struct right **right,
                           struct hsr_error *err) {
  *right = calloc(1, sizeof **right);
  if (!*right)
    return hsr_fail_nomem(err);
  enum hsr_status status = hsr_open(path, NULL, &(*right)->scene, err);
  if (status) {
    free(*right);
    *right = NULL;
  }
  return status;
}

void right_close(struct right *right) {
  if (right)
    hsr_close(right->scene);
  free(right);
}

static int go_on(void *context, double share) {
  (void)context;
  (void)share;
  return !interrupt_came();
}

static enum hsr_status draw(const struct right *right, const char *algorithm,
                            uint32_t view, int m, int n,
                            struct lib_answer **answer, struct hsr_error *err) {
  const struct hsr_request request = {.size = sizeof request,
                                      .algorithm = algorithm,
                                      .view = view,
                                      .m = m,
                                      .n = n,
                                      .threads = 2,
                                      .progress = go_on};
  return hsr_draw(right->scene, &request, answer, err);
}

enum hsr_status right_ids(const struct right *right, uint32_t view, int m,
                          int n, uint32_t *ids, struct hsr_error *err) {
  struct lib_answer *answer;
  const uint32_t *found;
  enum hsr_status status = draw(right, "oracle", view, m, n, &answer, err);
  if (!status)
    status = hsr_get_ids(answer, &found, err);
  if (!status)
    memcpy(ids, found, (size_t)m * (size_t)n * sizeof *ids);
  hsr_free(answer);
  return status;
}

static void put_segment(const struct lib_segment *s, double *row) {
  const double column[SEGMENT_COLUMNS] = {
      s->is_implied, s->a,     s->b,       s->part,    s->invisibility,
      s->t0,         s->t1,    s->from[0], s->from[1], s->from[2],
      s->to[0],      s->to[1], s->to[2]};
  memcpy(row, column, sizeof column);
}

enum hsr_status right_segments(const struct right *right, uint32_t view, int m,
                               int n, double **row, size_t *n_rows,
                               struct hsr_error *err) {
  struct lib_answer *answer;
  const struct lib_segment *segment;
  *row = NULL;
  enum hsr_status status = draw(right, "line-oracle", view, m, n, &answer, err);
  if (!status)
    status = hsr_get_segments(answer, &segment, n_rows, err);
  if (!status) {
    *row = malloc((*n_rows + 1) * SEGMENT_COLUMNS * sizeof **row);
    if (!*row)
      status = hsr_fail_nomem(err);
  }
  for (size_t k = 0; k < *n_rows && !status; k++)
    put_segment(&segment[k], *row + k * SEGMENT_COLUMNS);
  hsr_free(answer);
  return status;
}
