/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/peers/lines/line_pixels.h"

#include "bench/peers/lines/lines.h"

#include <math.h>
#include <stdlib.h>

/* A visible interval on the screen. */
struct stroke {
  double from[2], to[2];
};

struct pixels {
  const struct hsr_edges *edges;
  const struct hsr_view *view;
  const uint32_t *pixel;
  const struct hsr_drawing *right;
  struct stroke *stroke; /* of each interval of the drawing */
  size_t *first;         /* n_real + 1: the intervals of each edge; those of an
                            edge that is not in the picture are none */
  bool *shown, *hidden;  /* n_real: edges that are wrongly so */
  struct pixels_verdict *verdict;
};

/* --- The right drawing on the screen -------------------------------------- */

static void place(const struct hsr_view *view, const double point[3],
                  double at[2]) {
  double h[3];
  hsr_view_project(view, point, h);
  at[0] = h[0] / hsr_view_w(view, h);
  at[1] = h[1] / hsr_view_w(view, h);
}

/* The intervals of edges of faces come first, in the order of edges. */
static void place_strokes(struct pixels *p) {
  const struct hsr_drawing *right = p->right;
  size_t k = 0;
  for (uint32_t e = 0; e < p->edges->n_real; e++) {
    p->first[e] = k;
    for (; k < right->n &&
           !hsr_edge_name_compare(&right->segment[k].edge, &p->edges->name[e]);
         k++) {
      place(p->view, right->segment[k].from, p->stroke[k].from);
      place(p->view, right->segment[k].to, p->stroke[k].to);
    }
    p->verdict->edges += k > p->first[e];
  }
  p->first[p->edges->n_real] = k;
  while (k < right->n) {
    const struct hsr_edge_name *name = &right->segment[k].edge;
    bool visible = false;
    for (;
         k < right->n && !hsr_edge_name_compare(&right->segment[k].edge, name);
         k++)
      visible |= !right->segment[k].invisibility;
    p->verdict->implied += visible;
  }
}

static double distance(const struct stroke *s, const double at[2]) {
  double dx = s->to[0] - s->from[0], dy = s->to[1] - s->from[1];
  double ax = at[0] - s->from[0], ay = at[1] - s->from[1];
  double square = dx * dx + dy * dy;
  double u = square > 0 ? (ax * dx + ay * dy) / square : 0;
  u = fmin(1, fmax(0, u));
  return hypot(ax - u * dx, ay - u * dy);
}

/* --- Pixels that show lines ----------------------------------------------- */

/* An edge's distance from a place, of its visible or of all its parts. */
static double edge_distance(const struct pixels *p, uint32_t e,
                            const double at[2], bool visible_only) {
  double least = INFINITY;
  for (size_t k = p->first[e]; k < p->first[e + 1]; k++)
    if (!visible_only || !p->right->segment[k].invisibility)
      least = fmin(least, distance(&p->stroke[k], at));
  return least;
}

static void judge_pixel(struct pixels *p, int i, int j, uint32_t f) {
  const struct hsr_mesh *mesh = &p->edges->world->mesh;
  const double at[2] = {i + .5, j + .5};
  uint32_t first = mesh->start[f], end = mesh->start[f + 1];
  uint32_t nearest = UINT32_MAX;
  double least = INFINITY;
  for (uint32_t k = first; k < end; k++) {
    uint32_t a = mesh->vertex[k];
    uint32_t b = mesh->vertex[k + 1 < end ? k + 1 : first];
    struct hsr_edge_name name = {.a = a < b ? a : b, .b = a < b ? b : a};
    uint32_t e = lines_find(p->edges, &name);
    if (e == UINT32_MAX)
      continue;
    if (edge_distance(p, e, at, true) <= LINE_PIXELS_NEAR)
      return;
    double far = edge_distance(p, e, at, false);
    if (far < least) {
      least = far;
      nearest = e;
    }
  }
  p->verdict->visible_px++;
  if (nearest != UINT32_MAX)
    p->shown[nearest] = true;
}

static void judge_pixels(struct pixels *p) {
  for (int j = 0; j < p->view->n; j++)
    for (int i = 0; i < p->view->m; i++) {
      uint32_t f = p->pixel[(size_t)j * (size_t)p->view->m + (size_t)i];
      if (f == HSR_BACKGROUND)
        continue;
      p->verdict->shown_px++;
      judge_pixel(p, i, j, f);
    }
}

/* --- Lines that ought to show --------------------------------------------- */

static bool is_line_near(const struct pixels *p, double x, double y) {
  int m = p->view->m, n = p->view->n;
  int left = (int)floor(x) - 1, top = (int)floor(y) - 1;
  for (int j = top; j <= top + 2; j++)
    for (int i = left; i <= left + 2; i++)
      if (i >= 0 && i < m && j >= 0 && j < n &&
          p->pixel[(size_t)j * (size_t)m + (size_t)i] != HSR_BACKGROUND)
        return true;
  return false;
}

static void walk(struct pixels *p, uint32_t e, const struct stroke *s) {
  double dx = s->to[0] - s->from[0], dy = s->to[1] - s->from[1];
  double length = hypot(dx, dy);
  for (double at = LINE_PIXELS_NEAR; at <= length - LINE_PIXELS_NEAR; at++) {
    p->verdict->walked_px++;
    if (is_line_near(p, s->from[0] + at / length * dx,
                     s->from[1] + at / length * dy))
      continue;
    p->verdict->hidden_px++;
    p->hidden[e] = true;
  }
}

enum hsr_status
line_pixels_compare(const struct hsr_edges *edges, const struct hsr_view *view,
                    const uint32_t *pixel, const struct hsr_drawing *right,
                    struct pixels_verdict *verdict, struct hsr_error *err) {
  *verdict = (struct pixels_verdict){.edges = 0};
  size_t n = edges->n_real;
  struct pixels p = {.edges = edges,
                     .view = view,
                     .pixel = pixel,
                     .right = right,
                     .stroke = malloc((right->n + 1) * sizeof *p.stroke),
                     .first = malloc((n + 1) * sizeof *p.first),
                     .shown = calloc(n + 1, sizeof *p.shown),
                     .hidden = calloc(n + 1, sizeof *p.hidden),
                     .verdict = verdict};
  bool good = p.stroke && p.first && p.shown && p.hidden;
  if (good) {
    place_strokes(&p);
    judge_pixels(&p);
    for (uint32_t e = 0; e < n; e++)
      for (size_t k = p.first[e]; k < p.first[e + 1]; k++)
        if (!right->segment[k].invisibility)
          walk(&p, e, &p.stroke[k]);
    for (uint32_t e = 0; e < n; e++) {
      verdict->visible += p.shown[e];
      verdict->hidden += p.hidden[e];
      verdict->wrong += p.shown[e] || p.hidden[e];
    }
  }
  free(p.stroke);
  free(p.first);
  free(p.shown);
  free(p.hidden);
  return good ? HSR_OK : hsr_fail_nomem(err);
}

json_t *line_pixels_json(const struct pixels_verdict *v) {
  return json_pack(
      "{sI sI sI sI sI sI sI sI sI}", "compared", (json_int_t)v->edges,
      "mismatches", (json_int_t)v->wrong, "wrongly_visible",
      (json_int_t)v->visible, "wrongly_hidden", (json_int_t)v->hidden,
      "wrongly_visible_px", (json_int_t)v->visible_px, "wrongly_hidden_px",
      (json_int_t)v->hidden_px, "shown_px", (json_int_t)v->shown_px,
      "visible_px", (json_int_t)v->walked_px, "implied_not_judged",
      (json_int_t)v->implied);
}
