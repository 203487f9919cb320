/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/peers/lines/lines.h"
#include "bench/modules/modules.h"

#include "algorithms/setup.h"
#include "common/answers/kinds/segments.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LINES_EQUAL 1e-11 /* relative; only to find what is disputed */
#define LINES_MOVED 1e-4  /* pixels */

bool lines_face_exists(const struct hsr_world *world,
                       const struct hsr_view *view, uint32_t f) {
  const double n[3] = {world->mesh.nx[f], world->mesh.ny[f], world->mesh.nz[f]};
  const double p[3] = {world->mesh.px[f], world->mesh.py[f], world->mesh.pz[f]};
  return hsr_view_height(view, n, p) < 0 || !world->mesh.one_sided[f];
}

enum hsr_status lines_draw_right(const struct hsr_world *world,
                                 const struct hsr_view *view,
                                 struct hsr_drawing *drawing,
                                 struct hsr_error *err) {
  struct hsr_setup setup;
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  struct hsr_tally tally = {.out_of_memory = false};
  struct hsr_answer answer = hsr_answer_of_drawing(drawing, view->m, view->n);
  struct hsr_job job = {
      .view = view, .scratch = &scratch, .tally = &tally, .answer = &answer};
  enum hsr_status status = hsr_setup_init(
      &setup, hsr_algorithm_find("line-oracle")->plain, NULL, world, err);
  if (!status)
    status = hsr_setup_render(&setup, &job, err);
  hsr_setup_free(&setup);
  hsr_arena_free(&scratch);
  return status;
}

/* The image of a point, in pixels. */
static void find_image(const struct hsr_view *view, const double point[3],
                       double at[2]) {
  double a[3];
  hsr_view_project(view, point, a);
  const double w = hsr_view_w(view, a);
  at[0] = a[0] / w;
  at[1] = a[1] / w;
}

double lines_length(const struct hsr_view *view, const double from[3],
                    const double to[3]) {
  double a[2], b[2];
  find_image(view, from, a);
  find_image(view, to, b);
  return hypot(b[0] - a[0], b[1] - a[1]);
}

static int compare_names(const void *a, const void *b) {
  return hsr_edge_name_compare(a, b);
}

uint32_t lines_find(const struct hsr_edges *edges,
                    const struct hsr_edge_name *name) {
  const struct hsr_edge_name *found =
      bsearch(name, edges->name, edges->n_real, sizeof *name, compare_names);
  return found ? (uint32_t)(found - edges->name) : UINT32_MAX;
}

/* --- Disputed stretches --------------------------------------------------- */

/* A point on the screen, and a point of an edge that is seen there. */
struct sight {
  double origin[3], direction[3], w;
};

static struct sight look(const struct hsr_view *view, double sx, double sy,
                         double w) {
  struct sight sight = {.w = w};
  for (int k = 0; k < 3; k++) {
    double across =
        view->ray[0][k] + sx * view->ray[1][k] + sy * view->ray[2][k];
    sight.origin[k] = view->E[k] + (view->parallel ? across : 0);
    sight.direction[k] = view->parallel ? view->F[k] : across;
  }
  return sight;
}

/* By parity, in the two coordinates other than `axis`. */
static bool is_inside(const struct hsr_world *world, uint32_t f, int axis,
                      const double at[3]) {
  const double *x = axis == 0 ? world->mesh.y : world->mesh.x;
  const double *y = axis == 2 ? world->mesh.y : world->mesh.z;
  double px = at[axis == 0 ? 1 : 0], py = at[axis == 2 ? 1 : 2];
  uint32_t first = world->mesh.start[f], end = world->mesh.start[f + 1];
  bool inside = false;
  for (uint32_t k = first; k < end; k++) {
    uint32_t a = world->mesh.vertex[k];
    uint32_t b = world->mesh.vertex[k + 1 < end ? k + 1 : first];
    if ((y[a] > py) != (y[b] > py) &&
        px < x[a] + (py - y[a]) / (y[b] - y[a]) * (x[b] - x[a]))
      inside = !inside;
  }
  return inside;
}

/* Whether the face hides the point, all in doubles. */
static bool hides(const struct hsr_world *world, const struct hsr_view *view,
                  uint32_t f, const struct sight *sight) {
  const double n[3] = {world->mesh.nx[f], world->mesh.ny[f], world->mesh.nz[f]};
  const double p[3] = {world->mesh.px[f], world->mesh.py[f], world->mesh.pz[f]};
  double at[3], above = 0, along = 0;
  int axis = 0;
  for (int k = 0; k < 3; k++) {
    above += n[k] * (p[k] - sight->origin[k]);
    along += n[k] * sight->direction[k];
    axis = fabs(n[k]) > fabs(n[axis]) ? k : axis;
  }
  double t = above / along;
  if (!(t > view->near && t < sight->w - LINES_EQUAL * fabs(sight->w)))
    return false;
  for (int k = 0; k < 3; k++)
    at[k] = sight->origin[k] + t * sight->direction[k];
  return is_inside(world, f, axis, at);
}

static double above_plane(const struct hsr_world *world, uint32_t f,
                          const double at[3]) {
  return world->mesh.nx[f] * (at[0] - world->mesh.px[f]) +
         world->mesh.ny[f] * (at[1] - world->mesh.py[f]) +
         world->mesh.nz[f] * (at[2] - world->mesh.pz[f]);
}

/* Whether a face may hide an edge: it is none of its own, and the edge does not
 * lie in its plane. */
static bool may_hide(const struct hsr_edges *edges, uint32_t e, uint32_t f) {
  for (uint32_t k = edges->side_start[e]; k < edges->side_start[e + 1]; k++)
    if (edges->side[k].face == f)
      return false;
  const struct hsr_mesh *mesh = &edges->world->mesh;
  double a[3], b[3];
  hsr_edge_point(edges, e, 0, a);
  hsr_edge_point(edges, e, 1, b);
  double size = (fabs(mesh->nx[f]) + fabs(mesh->ny[f]) + fabs(mesh->nz[f])) *
                (fabs(a[0]) + fabs(a[1]) + fabs(a[2]));
  return fabs(above_plane(edges->world, f, a)) > LINES_EQUAL * size ||
         fabs(above_plane(edges->world, f, b)) > LINES_EQUAL * size;
}

/* Whether the stretch from t0 to t1 of an edge, which lasts `length` pixels,
 * would be visible if it were moved to one side, and hidden if to the other. */
static bool is_disputed(const struct hsr_edges *edges,
                        const struct hsr_view *view, uint32_t e, double t0,
                        double t1) {
  double image[3][3], at[3], x[3], y[3];
  for (int k = 0; k < 3; k++) {
    hsr_edge_point(edges, e, t0 + k * (t1 - t0) / 2, at);
    hsr_view_project(view, at, image[k]);
    x[k] = image[k][0] / hsr_view_w(view, image[k]);
    y[k] = image[k][1] / hsr_view_w(view, image[k]);
  }
  double length = hypot(x[2] - x[0], y[2] - y[0]);
  bool hidden[2] = {false, false};
  for (int side = 0; side < 2; side++) {
    double move = (side ? LINES_MOVED : -LINES_MOVED) / length;
    struct sight sight = look(view, x[1] + move * (y[2] - y[0]),
                              y[1] - move * (x[2] - x[0]), image[1][2]);
    for (uint32_t f = 0; f < edges->world->n_faces && !hidden[side]; f++)
      hidden[side] = lines_face_exists(edges->world, view, f) &&
                     hides(edges->world, view, f, &sight) &&
                     may_hide(edges, e, f);
  }
  return hidden[0] != hidden[1];
}

/* --- One edge ------------------------------------------------------------- */

/* An edge of the right drawing, and what the peer has of it. */
struct judged {
  const struct hsr_edges *edges;
  const struct hsr_view *view;
  uint32_t edge;
  const struct drawn_part *part;
  size_t n_parts;
  double *cut; /* room for two a part, and two more */
  double length[N_LINE_ERRORS], visible;
  double disputed; /* length of what is wrong in any way, but disputed */
};

static int compare_numbers(const void *a, const void *b) {
  const double *x = a, *y = b;
  return (*x > *y) - (*x < *y);
}

/* Where within (t0, t1) what the peer draws may change, and both ends. */
static size_t find_cuts(struct judged *judged, double t0, double t1) {
  size_t n = 0;
  judged->cut[n++] = t0;
  for (size_t k = 0; k < judged->n_parts; k++)
    for (int end = 0; end < 2; end++) {
      double t = end ? judged->part[k].t1 : judged->part[k].t0;
      if (t > t0 && t < t1)
        judged->cut[n++] = t;
    }
  judged->cut[n++] = t1;
  qsort(judged->cut, n, sizeof *judged->cut, compare_numbers);
  return n;
}

/* What is wrong at t; -1: nothing. */
static int error_at(const struct judged *judged, double t, bool visible) {
  bool shown = false, hidden = false;
  for (size_t k = 0; k < judged->n_parts; k++)
    if (judged->part[k].t0 <= t && t <= judged->part[k].t1) {
      shown |= judged->part[k].visible;
      hidden |= !judged->part[k].visible;
    }
  if (shown)
    return visible ? -1 : WRONGLY_VISIBLE;
  if (hidden)
    return visible ? WRONGLY_HIDDEN : -1;
  return LINES_MISSING;
}

static void judge_interval(struct judged *judged,
                           const struct hsr_segment *right) {
  size_t n = find_cuts(judged, right->t0, right->t1);
  for (size_t k = 0; k + 1 < n; k++) {
    double t0 = judged->cut[k], t1 = judged->cut[k + 1], from[3], to[3];
    hsr_edge_point(judged->edges, judged->edge, t0, from);
    hsr_edge_point(judged->edges, judged->edge, t1, to);
    double length = lines_length(judged->view, from, to);
    int error = error_at(judged, (t0 + t1) / 2, !right->invisibility);
    if (error >= 0)
      judged->length[error] += length;
    if (error >= 0 && length > LINES_MOVED &&
        is_disputed(judged->edges, judged->view, judged->edge, t0, t1))
      judged->disputed += length;
    if (!right->invisibility)
      judged->visible += length;
  }
}

/* --- All edges ------------------------------------------------------------ */

static int compare_parts(const void *a, const void *b) {
  const struct drawn_part *x = a, *y = b;
  return (x->edge > y->edge) - (x->edge < y->edge);
}

/* The parts of an edge, which are sorted. */
static void find_parts(struct judged *judged, const struct drawn_part *part,
                       size_t n) {
  size_t first = 0, above = n;
  while (first < above) {
    size_t middle = first + (above - first) / 2;
    if (part[middle].edge < judged->edge)
      first = middle + 1;
    else
      above = middle;
  }
  judged->part = part + first;
  judged->n_parts = 0;
  while (first + judged->n_parts < n &&
         judged->part[judged->n_parts].edge == judged->edge)
    judged->n_parts++;
}

static void add_edge(struct lines_verdict *verdict,
                     const struct judged *judged) {
  bool wrong = false;
  double undisputed = -judged->disputed;
  for (int e = 0; e < N_LINE_ERRORS; e++) {
    bool counts = judged->length[e] > LINES_LEAST_WRONG;
    verdict->count[e] += counts;
    verdict->length[e] += judged->length[e];
    wrong |= counts;
    undisputed += judged->length[e];
  }
  verdict->edges++;
  verdict->wrong += wrong;
  verdict->disputed += wrong && undisputed <= LINES_LEAST_WRONG;
  verdict->visible += judged->visible;
}

enum hsr_status lines_compare(const struct hsr_edges *edges,
                              const struct hsr_view *view,
                              struct drawn_part *part, size_t n_parts,
                              const struct hsr_drawing *right,
                              struct lines_verdict *verdict,
                              struct hsr_error *err) {
  *verdict = (struct lines_verdict){.edges = 0};
  double *cut = malloc((2 * n_parts + 2) * sizeof *cut);
  if (!cut)
    return hsr_fail_nomem(err);
  if (n_parts)
    qsort(part, n_parts, sizeof *part, compare_parts);
  for (size_t k = 0; k < right->n;) {
    const struct hsr_edge_name *name = &right->segment[k].edge;
    struct judged judged = {.edges = edges,
                            .view = view,
                            .edge = lines_find(edges, name),
                            .cut = cut};
    bool implied = name->implied, visible = false;
    find_parts(&judged, part, n_parts);
    for (;
         k < right->n && !hsr_edge_name_compare(&right->segment[k].edge, name);
         k++) {
      visible |= !right->segment[k].invisibility;
      if (!implied)
        judge_interval(&judged, &right->segment[k]);
    }
    if (implied)
      verdict->implied += visible;
    else
      add_edge(verdict, &judged);
  }
  free(cut);
  return HSR_OK;
}

json_t *lines_verdict_json(const struct lines_verdict *v) {
  return json_pack("{sI sI sI sI sI sI sf sf sf sf sI}", "compared",
                   (json_int_t)v->edges, "mismatches", (json_int_t)v->wrong,
                   "only_disputed", (json_int_t)v->disputed, "wrongly_visible",
                   (json_int_t)v->count[WRONGLY_VISIBLE], "wrongly_hidden",
                   (json_int_t)v->count[WRONGLY_HIDDEN], "missing",
                   (json_int_t)v->count[LINES_MISSING], "wrongly_visible_px",
                   v->length[WRONGLY_VISIBLE], "wrongly_hidden_px",
                   v->length[WRONGLY_HIDDEN], "missing_px",
                   v->length[LINES_MISSING], "visible_px", v->visible,
                   "implied_not_judged", (json_int_t)v->implied);
}

/* --- Plain files ---------------------------------------------------------- */

void lines_plain_add(struct lines_plain *plain, const struct hsr_view *view,
                     const double from[3], const double to[3]) {
  double a[2], b[2];
  find_image(view, from, a);
  find_image(view, to, b);
  plain->pen_up += hypot(a[0] - plain->at[0], a[1] - plain->at[1]);
  memcpy(plain->at, b, sizeof b);
  plain->strokes++;
  plain->bytes += (size_t)snprintf(
      NULL, 0, "<path d=\"M%.3f %.3fL%.3f %.3f\"/>\n", a[0], a[1], b[0], b[1]);
}

json_t *lines_plain_json(const struct lines_plain *plain) {
  return json_pack("{sI sI sf}", "strokes", (json_int_t)plain->strokes, "bytes",
                   (json_int_t)plain->bytes, "pen_up_px", plain->pen_up);
}
