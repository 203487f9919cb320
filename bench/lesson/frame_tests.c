/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the tests of a priority list ask about, over the picture: the plane of a piece,
 * the line that separates two images; and a flag at a piece that bears a marker. As
 * looks/tests.js of the page draws them. */
#include "bench/lesson/frames.h"

#include <math.h>

static void read_point(const json_t *outline, size_t k, double at[2]) {
  const json_t *p = json_array_get(outline, k % json_array_size(outline));
  for (size_t c = 0; c < 2; c++)
    at[c] = json_number_value(json_array_get(p, c));
}

/* Borrowed: all that is left of a piece. */
static const json_t *outline_of(const struct frames *f,
                                const struct hsr_event *event,
                                const struct hsr_subject *piece) {
  const json_t *left = frames_outline(f, event, piece);
  return left ? left : frames_image(f, piece->id[0]);
}

/* --- Test 6: a line between two images ------------------------------------ */

#define NEAR .06 /* samples: images are rounded */

struct line {
  double from[2], to[2];
};

/* The least and the greatest of the distances of the corners from the line. */
static void distances(const struct line *l, const json_t *outline,
                      double range[2]) {
  double d[2] = {l->to[0] - l->from[0], l->to[1] - l->from[1]},
         length = hypot(d[0], d[1]), at[2];
  range[0] = INFINITY;
  range[1] = -INFINITY;
  for (size_t k = 0; k < json_array_size(outline); k++) {
    read_point(outline, k, at);
    double side =
        (d[0] * (at[1] - l->from[1]) - d[1] * (at[0] - l->from[0])) / length;
    range[0] = fmin(range[0], side);
    range[1] = fmax(range[1], side);
  }
}

/* Finds the edge of p that has p on one side and q on the other. */
static bool find_between(const json_t *p, const json_t *q, struct line *l) {
  for (size_t k = 0; k < json_array_size(p); k++) {
    double own[2], other[2];
    read_point(p, k, l->from);
    read_point(p, k + 1, l->to);
    if (hypot(l->to[0] - l->from[0], l->to[1] - l->from[1]) < 1e-6)
      continue;
    distances(l, p, own);
    distances(l, q, other);
    if ((own[0] > -NEAR && other[1] < NEAR) ||
        (own[1] < NEAR && other[0] > -NEAR))
      return true;
  }
  return false;
}

/* Widens the shares of the line between which the corners lie. */
static void widen(const struct line *l, const json_t *outline,
                  double share[2]) {
  double d[2] = {l->to[0] - l->from[0], l->to[1] - l->from[1]}, at[2];
  for (size_t k = 0; k < json_array_size(outline); k++) {
    read_point(outline, k, at);
    double t = ((at[0] - l->from[0]) * d[0] + (at[1] - l->from[1]) * d[1]) /
               (d[0] * d[0] + d[1] * d[1]);
    share[0] = fmin(share[0], t);
    share[1] = fmax(share[1], t);
  }
}

/* The line, as far as both images go. */
static void mark_line(struct frames *f, const struct hsr_event *event) {
  const json_t *p = outline_of(f, event, &event->a),
               *q = outline_of(f, event, &event->b);
  struct line l;
  double share[2] = {INFINITY, -INFINITY};
  if (!find_between(p, q, &l) && !find_between(q, p, &l))
    return;
  widen(&l, p, share);
  widen(&l, q, share);
  for (int k = 0; k < 2; k++) {
    double x = l.from[0] + share[k] * (l.to[0] - l.from[0]),
           y = l.from[1] + share[k] * (l.to[1] - l.from[1]);
    if (k)
      cairo_line_to(f->cairo, x, y);
    else
      cairo_move_to(f->cairo, x, y);
  }
  frames_stroke(f, FRAME_INK, 2.5, FRAME_DOTTED);
}

/* Test 4 asks about the plane of Q, test 5 about that of P, test 6 about a line. */
void frames_mark_test(struct frames *f, const struct hsr_event *event) {
  const bool both = frames_has_outcome(f, event, "both-planes");
  if (both || frames_has_outcome(f, event, "plane-of-q") ||
      frames_has_outcome(f, event, "plane-of-divider"))
    frames_mark_plane_of(
        f, event->b.id[0],
        &(struct frame_look){FRAME_INK, .036, 1.2, FRAME_DASHED});
  if (both || frames_has_outcome(f, event, "plane-of-p"))
    frames_mark_plane_of(
        f, event->a.id[0],
        &(struct frame_look){FRAME_INK, .06, 1.2, FRAME_SOLID});
  if (frames_has_outcome(f, event, "edge-between"))
    mark_line(f, event);
}

/* --- Markers -------------------------------------------------------------- */

/* A flag at the middle of what is seen of the piece. */
static void mark_flag(struct frames *f, const json_t *outline) {
  const double flag[5][2] = {
      {0, 0}, {0, -1.6}, {1, -1.2}, {.15, -.8}, {.15, 0}};
  const double most[2] = {f->run->view.m, f->run->view.n};
  double at[2], middle[2] = {0, 0}, size = .045 * most[0];
  size_t n = json_array_size(outline);
  if (!n)
    return;
  for (size_t k = 0; k < n; k++) {
    read_point(outline, k, at);
    for (int c = 0; c < 2; c++)
      middle[c] += fmin(most[c], fmax(0, at[c])) / (double)n;
  }
  for (int k = 0; k < 5; k++) {
    double x = middle[0] + size * flag[k][0], y = middle[1] + size * flag[k][1];
    if (k)
      cairo_line_to(f->cairo, x, y);
    else
      cairo_move_to(f->cairo, x, y);
  }
  cairo_close_path(f->cairo);
  frames_set_colour(f->cairo, FRAME_INK, 1);
  cairo_fill_preserve(f->cairo);
  frames_stroke(f, FRAME_INK, 1, FRAME_SOLID);
}

void frames_mark_markers(struct frames *f, const struct hsr_event *event) {
  const struct hsr_subject *both[] = {&event->a, &event->b};
  for (int k = 0; k < 2; k++)
    if (frames_is_marked(f, both[k]) &&
        both[k]->id[0] < f->run->laid_out.n_faces)
      mark_flag(f, outline_of(f, event, both[k]));
}
