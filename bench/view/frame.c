/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/view/view.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A part of the window: columns [x, x + width), all rows. */
struct part {
  int x, width, coarse;
};

static int divided(int length, int by) {
  return length / by > 1 ? length / by : 1;
}

enum hsr_status viewer_view(const struct viewer *v, int width, int coarse,
                            struct hsr_view *view, struct hsr_error *err) {
  return hsr_view_init(view, &v->camera, divided(width, coarse),
                       divided(v->n, coarse), err);
}

/* Each sample becomes a square of pixels. */
static void enlarge(const struct viewer *v, const struct part *part, int m,
                    int n, const unsigned char *from, unsigned char *to) {
  const size_t row = 3 * (size_t)v->m, width = 3 * (size_t)part->width;
  int before = -1;
  to += 3 * (size_t)part->x;
  for (int y = 0; y < v->n; y++, to += row) {
    int j = y / part->coarse < n ? y / part->coarse : n - 1;
    const unsigned char *samples = from + 3 * (size_t)j * (size_t)m;
    if (part->coarse == 1)
      memcpy(to, samples, width);
    else if (j == before)
      memcpy(to, to - row, width);
    else
      for (int x = 0; x < part->width; x++) {
        int i = x / part->coarse < m ? x / part->coarse : m - 1;
        memcpy(to + 3 * (size_t)x, samples + 3 * (size_t)i, 3);
      }
    before = j;
  }
}

/* --- Overlays ------------------------------------------------------------- */

/* From black over red and yellow to white, each sample by the logarithm of its
 * number. */
static void paint_numbers(const float *number, size_t n, unsigned char *rgb) {
  float most = 0;
  for (size_t k = 0; k < n; k++)
    most = fmaxf(most, number[k]);
  for (size_t k = 0; k < n; k++) {
    float x = most > 0 ? 3 * log1pf(number[k]) / log1pf(most) : 0;
    for (int c = 0; c < 3; c++)
      rgb[3 * k + (size_t)c] =
          (unsigned char)(255 * fminf(fmaxf(x - (float)c, 0), 1));
  }
}

/* Draws how often each sample was touched: by the algorithm; or for the depth
 * complexity once by each face that covers it, as zbuffer-fast does. */
static enum hsr_status draw_numbers(struct viewer *v,
                                    const struct hsr_view *view,
                                    struct hsr_error *err) {
  const char *name =
      v->overlay == OVERLAY_DEPTH ? "zbuffer-fast" : v->player[0]->variant.name;
  struct player *counter = &v->counter;
  enum hsr_status status = HSR_OK;
  if (!counter->is_ready || counter->sort != PLAYER_WORKS ||
      strcmp(counter->variant.name, name) != 0)
    status = player_open(counter, name, PLAYER_WORKS, v, err);
  if (!status)
    status = player_draw(counter, view, v->other, err);
  if (!status)
    paint_numbers(counter->render.work, (size_t)view->m * (size_t)view->n,
                  v->other);
  return status;
}

/* Darkens samples whose right or lower neighbour sees another face. */
static void mark_edges(const uint32_t *ids, int m, int n, unsigned char *rgb) {
  for (int j = 0; j < n; j++)
    for (int i = 0; i < m; i++) {
      size_t k = (size_t)j * (size_t)m + (size_t)i;
      bool edge = (i + 1 < m && ids[k] != ids[k + 1]) ||
                  (j + 1 < n && ids[k] != ids[k + (size_t)m]);
      for (size_t c = 0; c < 3 && edge; c++)
        rgb[3 * k + c] = c ? 0 : 255;
    }
}

/* --- Lines ---------------------------------------------------------------- */

static enum hsr_status draw_lines(struct viewer *v, const struct hsr_view *view,
                                  unsigned char *rgb, struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  if (!v->lines.is_ready)
    status = player_open(&v->lines, LINES_BY, PLAYER_PLAIN, v, err);
  return status ? status : player_draw_over(&v->lines, view, rgb, err);
}

/* --- Parts ---------------------------------------------------------------- */

/* Draws a player's picture in a part of `to`, which is as large as the window.
 * What is over it is drawn only at rest. */
static enum hsr_status draw_part(struct viewer *v, struct player *player,
                                 const struct part *part, unsigned char *to,
                                 struct hsr_error *err) {
  struct hsr_view view;
  const bool rests = !v->moving;
  enum hsr_status status =
      viewer_view(v, part->width, part->coarse, &view, err);
  if (!status)
    status = player_draw(player, &view, v->other, err);
  if (!status && rests && v->overlay == OVERLAY_EDGES && player_ids(player))
    mark_edges(player_ids(player), view.m, view.n, v->other);
  if (!status && rests &&
      (v->overlay == OVERLAY_WORK || v->overlay == OVERLAY_DEPTH))
    status = draw_numbers(v, &view, err);
  if (!status && rests && v->has_lines)
    status = draw_lines(v, &view, v->other, err);
  if (!status)
    enlarge(v, part, view.m, view.n, v->other, to);
  return status;
}

/* Makes the second player ready, if two are compared. */
static enum hsr_status open_second(struct viewer *v, struct hsr_error *err) {
  struct player *second = v->player[1];
  if (v->comparison == COMPARE_NONE ||
      (second->is_ready && !strcmp(second->variant.name, v->second)))
    return HSR_OK;
  return player_open(second, v->second, PLAYER_PLAIN, v, err);
}

/* What is equal is dimmed; the rest is red. */
static enum hsr_status draw_difference(struct viewer *v,
                                       const struct part *part,
                                       struct hsr_error *err) {
  const size_t n = (size_t)v->m * (size_t)v->n;
  unsigned char *first = malloc(3 * n);
  enum hsr_status status = first ? HSR_OK : hsr_fail_nomem(err);
  if (!status)
    status = draw_part(v, v->player[0], part, first, err);
  if (!status)
    status = draw_part(v, v->player[1], part, v->rgb, err);
  size_t differing = 0;
  for (size_t k = 0; k < n && !status; k++) {
    unsigned char *rgb = v->rgb + 3 * k;
    bool same = !memcmp(first + 3 * k, rgb, 3);
    differing += !same;
    for (size_t c = 0; c < 3; c++)
      rgb[c] = same ? rgb[c] / 3 : c ? 0 : 255;
  }
  free(first);
  snprintf(v->message, sizeof v->message, "%zu of %zu pixels differ", differing,
           n);
  return status;
}

enum hsr_status frame_draw(struct viewer *v, struct hsr_error *err) {
  const int coarse = v->moving ? v->moving : v->coarse;
  struct part whole = {0, v->m, coarse};
  enum hsr_status status = open_second(v, err);
  if (status)
    return status;
  if (v->comparison == COMPARE_DIFFERENCE)
    return draw_difference(v, &whole, err);
  if (v->comparison != COMPARE_SIDES)
    return draw_part(v, v->player[v->comparison == COMPARE_BLINK && v->blink],
                     &whole, v->rgb, err);
  struct part left = {0, v->m / 2, coarse},
              right = {v->m / 2, v->m - v->m / 2, coarse};
  status = draw_part(v, v->player[0], &left, v->rgb, err);
  return status ? status : draw_part(v, v->player[1], &right, v->rgb, err);
}
