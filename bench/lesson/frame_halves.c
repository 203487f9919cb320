/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a step divides in two: a piece, by a plane; a segment of a row, at its
 * midpoint. As looks/all.js and data/stretches.js of the page find it. */
#include "bench/lesson/frames.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- A piece -------------------------------------------------------------- */

enum { FRAME_MOST_ENDS = 64 };

static bool are_near(const json_t *p, const json_t *q) {
  return hypot(json_number_value(json_array_get(p, 0)) -
                   json_number_value(json_array_get(q, 0)),
               json_number_value(json_array_get(p, 1)) -
                   json_number_value(json_array_get(q, 1))) < .1;
}

static bool has_corner(const json_t *outline, const json_t *corner) {
  size_t k;
  const json_t *p;
  json_array_foreach(outline, k, p) {
    if (are_near(p, corner))
      return true;
  }
  return false;
}

/* The line along which a piece was divided, beyond its ends: through the corners
 * that the halves have in common or, of a single half, that the piece did not
 * have. */
static void mark_cut(struct frames *f, const json_t *half, const json_t *other,
                     const json_t *whole) {
  const json_t *corner, *end[2] = {NULL, NULL};
  size_t k;
  json_array_foreach(half, k, corner) {
    if (has_corner(other ? other : whole, corner) == !!other)
      end[end[0] != NULL] = corner;
  }
  if (!end[1])
    return;
  double x[2], y[2];
  for (int e = 0; e < 2; e++) {
    x[e] = json_number_value(json_array_get(end[e], 0));
    y[e] = json_number_value(json_array_get(end[e], 1));
  }
  for (int e = 0; e < 2; e++) {
    double u = x[e] + .7 * (x[e] - x[!e]), v = y[e] + .7 * (y[e] - y[!e]);
    if (e)
      cairo_line_to(f->cairo, u, v);
    else
      cairo_move_to(f->cairo, u, v);
  }
  frames_stroke(f, FRAME_INK, 2.5, FRAME_DASHED);
}

void frames_mark_halves(struct frames *f, const struct hsr_event *event,
                        unsigned colour) {
  const json_t *piece, *half[2] = {NULL, NULL};
  size_t k;
  int n = 0;
  if (event->a.kind != HSR_OF_PIECE)
    return;
  json_array_foreach(frames_list_at(f, event), k, piece) {
    if (json_integer_value(json_array_get(piece, 1)) != event->a.id[1])
      continue;
    const json_t *outline = json_array_get(piece, 3);
    frames_add_polygon(f, outline);
    frames_set_colour(f->cairo, colour, n ? .15 : .5);
    cairo_fill_preserve(f->cairo);
    frames_stroke(f, colour, 2.5, FRAME_SOLID);
    if (n < 2 && json_array_size(outline))
      half[n++] = outline;
  }
  const json_t *whole = frames_outline(f, event, &event->a);
  mark_cut(f, half[0], half[1],
           whole ? whole : frames_image(f, event->a.id[0]));
}

/* --- A segment of a row --------------------------------------------------- */

static int in_order(const void *a, const void *b) {
  const double *p = a, *q = b;
  return (*p > *q) - (*p < *q);
}

/* The segment of a face on row j that has the samples [l, r), from its first
 * sample to its last. False: it is not known. */
static bool find_segment(const struct frames *f, uint32_t face, int l, int r,
                         int j, double segment[2]) {
  const json_t *image = frames_image(f, face);
  size_t n = json_array_size(image), n_ends = 0;
  double end[FRAME_MOST_ENDS], at = j + .5;
  for (size_t k = 0; k < n && n_ends < FRAME_MOST_ENDS; k++) {
    const json_t *p = json_array_get(image, k),
                 *q = json_array_get(image, (k + 1) % n);
    double px = json_number_value(json_array_get(p, 0)),
           py = json_number_value(json_array_get(p, 1)),
           qx = json_number_value(json_array_get(q, 0)),
           qy = json_number_value(json_array_get(q, 1));
    if ((py > at) != (qy > at))
      end[n_ends++] = px + (at - py) / (qy - py) * (qx - px);
  }
  qsort(end, n_ends, sizeof *end, in_order);
  for (size_t k = 0; k + 1 < n_ends; k += 2) {
    double from = ceil(end[k] - .5), to = ceil(end[k + 1] - .5);
    if (from >= r || to <= l)
      continue;
    segment[0] = fmax(0, from);
    segment[1] = fmin(f->run->view.m, to) - 1;
    return true;
  }
  return false;
}

static double length_of(const double stretch[2]) {
  return stretch[1] - stretch[0];
}

/* Replaces a stretch by the half that has the samples [l, r). False: neither
 * has. */
static bool narrow(double stretch[2], int l, int r) {
  double middle = (stretch[0] + stretch[1]) / 2;
  if (r - 1 <= middle && middle < stretch[1])
    stretch[1] = middle;
  else if (l >= middle && middle > stretch[0])
    stretch[0] = middle;
  else
    return false;
  return true;
}

/* A search of samples has ended with this outcome, which holds up to `end`: what
 * comes of those that it is a part of. */
static void end_part(struct frame_search *s, int outcome, int end) {
  while (s->n) {
    struct frame_part *part = &s->part[s->n - 1];
    if (!part->is_second && end >= part->middle) {
      part->is_second = true;
      part->outcome = outcome;
      memcpy(s->at, part->at, sizeof s->at);
      s->l = part->middle;
      s->r = part->r;
      return;
    }
    if (part->is_second) {
      end = outcome == part->outcome ? end : part->middle;
      outcome = part->outcome;
    }
    s->n--;
  }
  s->is_known = false;
}

/* The samples are divided, where the longer stretch is. */
static void divide_samples(struct frame_search *s) {
  const double *longer =
      s->at[length_of(s->at[0]) >= length_of(s->at[1]) ? 0 : 1];
  int middle = (int)floor((longer[0] + longer[1]) / 2) + 1;
  if (s->n == FRAME_MOST_PARTS) {
    s->is_known = false;
    return;
  }
  struct frame_part *part = &s->part[s->n++];
  *part = (struct frame_part){.middle = middle, .r = s->r};
  memcpy(part->at, s->at, sizeof part->at);
  s->r = middle;
}

static void compare(struct frames *f, const struct hsr_event *event) {
  struct frame_search *s = &f->search;
  const struct hsr_window *w = &event->window;
  bool goes_on = s->is_known && s->face[0] == event->a.id[0] &&
                 s->face[1] == event->b.id[0] && s->l == w->x0 &&
                 s->r == w->x1 && s->row == w->y0;
  if (!goes_on) {
    *s = (struct frame_search){.face = {event->a.id[0], event->b.id[0]},
                               .row = w->y0,
                               .l = w->x0,
                               .r = w->x1};
    s->is_known = find_segment(f, s->face[0], s->l, s->r, s->row, s->at[0]) &&
                  find_segment(f, s->face[1], s->l, s->r, s->row, s->at[1]);
  }
  if (s->is_known && !frames_has_outcome(f, event, "undecided"))
    end_part(s, event->outcome, w->x1);
}

static void divide(struct frame_search *s) {
  int longer = length_of(s->at[0]) >= length_of(s->at[1]) ? 0 : 1;
  s->is_shown = true;
  for (int k = 0; k < 2; k++) {
    double *stretch = s->at[k ? !longer : longer];
    double middle = (stretch[0] + stretch[1] + 1) / 2, end = stretch[1];
    s->keeps = narrow(stretch, s->l, s->r);
    s->is_left = stretch[1] < end;
    s->is_other = k;
    if (!k || s->keeps)
      s->middle = middle;
    if (s->keeps) {
      memcpy(s->kept, stretch, sizeof s->kept);
      return;
    }
  }
  divide_samples(s);
}

void frames_follow_search(struct frames *f, const struct hsr_event *event) {
  const struct hsr_counter *c =
      &f->run->setup.algorithm->counters[event->counter];
  struct frame_search *s = &f->search;
  s->is_shown = false;
  if (event->a.kind != HSR_OF_FACE || event->b.kind != HSR_OF_FACE ||
      event->window.y1 - event->window.y0 != 1)
    return;
  if (hsr_has_key(c, "depth-search"))
    compare(f, event);
  else if (hsr_has_key(c, "depth-division") && s->is_known)
    divide(s);
}

void frames_mark_midpoint(struct frames *f) {
  const struct frame_search *s = &f->search;
  double reach = .05 * f->run->view.n;
  if (!s->is_shown)
    return;
  if (s->keeps) {
    cairo_rectangle(f->cairo, s->kept[0], s->row, length_of(s->kept) + 1, 1);
    frames_set_colour(f->cairo, FRAME_INK, .9);
    cairo_fill_preserve(f->cairo);
    frames_stroke(f, FRAME_INK, 1, FRAME_SOLID);
  }
  cairo_move_to(f->cairo, s->middle, s->row - reach);
  cairo_line_to(f->cairo, s->middle, s->row + 1 + reach);
  frames_stroke(f, FRAME_INK, 2.5, FRAME_DASHED);
}
