/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Of an algorithm that puts edges to convex volumes: the fragment of the edge
 * that is at hand, and the part of it that the volume hides. The steps say what
 * was left, and the scene says where; as data/fragments.js of the page finds
 * it. */
#include "bench/lesson/frames.h"

#include <math.h>
#include <string.h>

/* --- What a convex volume hides of an edge -------------------------------- */

/* With a point of the edge at share t, and a point of the line of sight to it
 * at share l from the eye, E + l (A - E) + l t (B - A): all that is within a
 * volume is linear in l and u = l t. So the triangle 0 <= u <= l <= 1 is cut by
 * the volume's planes. */

enum { MOST_POINTS = 64 };

struct cut {
  int n;
  double at[MOST_POINTS][2]; /* l, u */
};

/* Keeps what of the cut lies where p + q l + r u <= 0. False: it has too many
 * corners. */
static bool cut_by(struct cut *cut, double p, double q, double r) {
  struct cut out = {0};
  for (int k = 0; k < cut->n; k++) {
    const double *a = cut->at[k], *b = cut->at[(k + 1) % cut->n];
    double s = p + q * a[0] + r * a[1], t = p + q * b[0] + r * b[1];
    if (out.n + 2 > MOST_POINTS)
      return false;
    if (s <= 0)
      memcpy(out.at[out.n++], a, sizeof out.at[0]);
    if ((s < 0 && t > 0) || (s > 0 && t < 0)) {
      for (int c = 0; c < 2; c++)
        out.at[out.n][c] = a[c] + (b[c] - a[c]) * s / (s - t);
      out.n++;
    }
  }
  *cut = out;
  return true;
}

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Cuts by the plane of a face; the volume is on that side of it. */
static bool cut_by_face(const struct frames *f, size_t face, int side,
                        const double a[3], const double b[3], struct cut *cut) {
  const struct hsr_mesh *mesh = &f->run->laid_out.mesh;
  double normal[3] = {mesh->nx[face], mesh->ny[face], mesh->nz[face]};
  const double on[3] = {mesh->px[face], mesh->py[face], mesh->pz[face]};
  if (side > 0)
    for (int c = 0; c < 3; c++)
      normal[c] = -normal[c];
  double length = sqrt(dot(normal, normal));
  for (int c = 0; c < 3; c++)
    normal[c] /= length > 0 ? length : 1;
  double eye = dot(normal, f->run->view.E);
  return cut_by(cut, eye - dot(normal, on), dot(normal, a) - eye,
                dot(normal, b) - dot(normal, a));
}

/* The shares between which the volume hides the edge. False: nowhere, or not
 * known. */
static bool hidden_by(const struct frames *f, const struct hsr_event *event,
                      double hidden[2]) {
  const struct hsr_mesh *mesh = &f->run->laid_out.mesh;
  const json_t *faces =
      json_array_get(json_object_get(f->structure, "volumes"), event->b.id[0]);
  const json_t *sides =
      json_array_get(json_object_get(f->structure, "sides"), event->b.id[0]);
  double end[2][3];
  struct cut cut = {3, {{0, 0}, {1, 0}, {1, 1}}};
  size_t k;
  const json_t *face;
  if (json_array_size(faces) < 4 ||
      json_array_size(sides) != json_array_size(faces) || f->run->view.parallel)
    return false;
  for (int e = 0; e < 2; e++) {
    uint32_t v = event->a.id[e];
    if (v >= mesh->n_vertices)
      return false;
    end[e][0] = mesh->x[v];
    end[e][1] = mesh->y[v];
    end[e][2] = mesh->z[v];
  }
  json_array_foreach(faces, k, face) {
    int side = (int)json_integer_value(json_array_get(sides, k));
    if (!cut_by_face(f, (size_t)json_integer_value(face), side, end[0], end[1],
                     &cut) ||
        cut.n < 3)
      return false;
  }
  hidden[0] = INFINITY;
  hidden[1] = -INFINITY;
  for (int c = 0; c < cut.n; c++)
    if (cut.at[c][0] > 1e-9) {
      double t = cut.at[c][1] / cut.at[c][0];
      hidden[0] = fmin(hidden[0], t);
      hidden[1] = fmax(hidden[1], t);
    }
  return hidden[0] <= hidden[1];
}

/* --- The steps of an edge ------------------------------------------------- */

/* How little a part may be. */
#define NEAR 1e-6

static bool is_of(const struct frame_fragments *all,
                  const struct hsr_event *event) {
  return event->a.kind == HSR_OF_EDGE && all->edge[0] == event->a.id[0] &&
         all->edge[1] == event->a.id[1];
}

static void push(struct frame_fragments *all, double from, double to) {
  if (all->n == FRAME_MOST_FRAGMENTS)
    all->is_known = false;
  else {
    all->waiting[all->n][0] = from;
    all->waiting[all->n++][1] = to;
  }
}

/* A test has this outcome: what is hidden, and what is left. */
static void put_to(struct frames *f, const struct hsr_event *event) {
  struct frame_fragments *all = &f->fragments;
  double *at = all->next, hidden[2];
  memcpy(all->at, at, sizeof all->at);
  all->hides = false;
  if (frames_has_outcome(f, event, "none-hidden"))
    return;
  bool found = hidden_by(f, event, hidden),
       whole = frames_has_outcome(f, event, "all-hidden");
  hidden[0] = whole ? at[0] : fmax(at[0], hidden[0]);
  hidden[1] = whole ? at[1] : fmin(at[1], hidden[1]);
  if ((!found && !whole) || hidden[1] - hidden[0] < -NEAR) {
    all->is_known = false;
    return;
  }
  all->hides = true;
  memcpy(all->hidden, hidden, sizeof hidden);
  double end = at[1];
  if (frames_has_outcome(f, event, "middle-hidden")) {
    push(all, hidden[1], end);
    at[1] = hidden[0];
  } else if (!whole && hidden[0] - at[0] > end - hidden[1]) {
    at[1] = hidden[0];
  } else if (!whole) {
    at[0] = hidden[1];
  }
}

void frames_follow_fragments(struct frames *f, const struct hsr_event *event) {
  struct frame_fragments *all = &f->fragments;
  bool is_fragment = frames_has_key(f, event, "fragment"),
       is_test = frames_has_key(f, event, "edge-volume"),
       was_test = all->is_after_test;
  all->is_after_test = is_test;
  if (!is_of(all, event))
    *all = (struct frame_fragments){
        .edge = {event->a.id[0], event->a.id[1]}, .n = 1, .waiting = {{0, 1}}};
  all->is_shown = false;
  if (event->a.kind != HSR_OF_EDGE)
    return;
  if (is_fragment) {
    all->is_known = all->n > 0 && (all->is_known || !all->is_begun);
    all->is_begun = true;
    all->hides = false;
    if (all->n)
      memcpy(all->next, all->waiting[--all->n], sizeof all->next);
    memcpy(all->at, all->next, sizeof all->at);
  } else if (is_test && all->is_known) {
    put_to(f, event);
  } else if (!was_test) {
    memcpy(all->at, all->next, sizeof all->at);
    all->hides = false;
  }
  all->is_shown =
      all->is_known && (is_fragment || is_test || was_test ||
                        frames_has_key(f, event, "fragment-condition"));
  all->is_after_test = is_test;
}

/* --- The drawing ---------------------------------------------------------- */

static void add_part(struct frames *f, const struct hsr_event *event,
                     double from, double to) {
  const struct hsr_mesh *mesh = &f->run->laid_out.mesh;
  uint32_t p = event->a.id[0], q = event->a.id[1];
  const double a[3] = {mesh->x[p], mesh->y[p], mesh->z[p]},
               b[3] = {mesh->x[q], mesh->y[q], mesh->z[q]};
  double at[2][3];
  if (to - from < NEAR)
    return;
  for (int k = 0; k < 2; k++)
    for (int c = 0; c < 3; c++)
      at[k][c] = a[c] + (k ? to : from) * (b[c] - a[c]);
  json_t *line = lesson_image_json(&f->run->view, (const double(*)[3])at, 2);
  frames_add_line(f, json_array_get(line, 0), json_array_get(line, 1));
  json_decref(line);
}

bool frames_mark_fragment(struct frames *f, const struct hsr_event *event,
                          unsigned colour) {
  const struct frame_fragments *all = &f->fragments;
  const struct hsr_mesh *mesh = &f->run->laid_out.mesh;
  if (!all->is_shown || event->a.id[0] >= mesh->n_vertices ||
      event->a.id[1] >= mesh->n_vertices)
    return false;
  add_part(f, event, 0, 1);
  frames_stroke(f, colour, 1, FRAME_SOLID);
  add_part(f, event, all->at[0], all->hides ? all->hidden[0] : all->at[1]);
  if (all->hides)
    add_part(f, event, all->hidden[1], all->at[1]);
  frames_stroke(f, colour, 4.5, FRAME_SOLID);
  if (all->hides) {
    add_part(f, event, all->hidden[0], all->hidden[1]);
    frames_stroke(f, FRAME_INK, 3, FRAME_DOTTED);
  }
  return true;
}
