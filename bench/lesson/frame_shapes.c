/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The boxes that a step compares, and the planes that it asks about, over the
 * picture: as looks/boxes.js and looks/solids.js of the page draw them. */
#include "bench/lesson/frames.h"

#include <math.h>
#include <string.h>

/* --- Boxes ---------------------------------------------------------------- */

struct box {
  double x0, y0, x1, y1;
};

static const struct box empty = {INFINITY, INFINITY, -INFINITY, -INFINITY};

static void widen(struct box *box, const json_t *point) {
  if (!json_is_array(point))
    return;
  double x = json_number_value(json_array_get(point, 0)),
         y = json_number_value(json_array_get(point, 1));
  box->x0 = fmin(box->x0, x);
  box->y0 = fmin(box->y0, y);
  box->x1 = fmax(box->x1, x);
  box->y1 = fmax(box->y1, y);
}

static void widen_by_all(struct box *box, const json_t *polygon) {
  size_t k;
  const json_t *point;
  json_array_foreach(polygon, k, point) widen(box, point);
}

/* Around the image of a subject; empty if it is not known. */
static struct box box_of(const struct frames *f, const struct hsr_event *event,
                         const struct hsr_subject *s) {
  const json_t *vertices = json_object_get(f->header, "vertices");
  struct box box = empty;
  size_t k;
  const json_t *face;
  if (s->kind == HSR_OF_EDGE) {
    widen(&box, json_array_get(vertices, s->id[0]));
    widen(&box, json_array_get(vertices, s->id[1]));
  } else if (s->kind == HSR_OF_FACE || s->kind == HSR_OF_PIECE) {
    const json_t *left = frames_outline(f, event, s);
    widen_by_all(&box, left ? left : frames_image(f, s->id[0]));
  } else if (s->kind == HSR_OF_VOLUME) {
    json_array_foreach(frames_faces_of_volume(f, event, s), k, face)
        widen_by_all(&box, frames_image(f, (uint32_t)json_integer_value(face)));
  }
  return box;
}

/* Whether the step compares boxes. */
static bool compares_boxes(const struct hsr_counter *c, int outcome) {
  char word[96];
  frames_say_outcome(c, outcome, word, sizeof word);
  return strstr(c->name, "minimax") || strstr(c->name, "boxes") ||
         strstr(word, "boxes apart") || strstr(word, "apart in X") ||
         strstr(word, "apart in Y");
}

void frames_mark_boxes(struct frames *f, const struct hsr_event *event) {
  const struct hsr_subject *both[] = {&event->a, &event->b};
  if (!compares_boxes(&f->run->setup.algorithm->counters[event->counter],
                      event->outcome))
    return;
  for (int k = 0; k < 2; k++) {
    struct box box = box_of(f, event, both[k]);
    if (box.x0 > box.x1)
      continue;
    cairo_rectangle(f->cairo, box.x0, box.y0, box.x1 - box.x0, box.y1 - box.y0);
    frames_stroke(f, FRAME_INK, 1.2, k ? FRAME_DASHED : FRAME_SOLID);
  }
}

/* --- Planes --------------------------------------------------------------- */

struct plane {
  double normal[3], offset; /* normal . x = offset */
};

static struct plane plane_of_face(const struct hsr_mesh *mesh, uint32_t face) {
  struct plane p = {{mesh->nx[face], mesh->ny[face], mesh->nz[face]}, 0};
  p.offset = p.normal[0] * mesh->px[face] + p.normal[1] * mesh->py[face] +
             p.normal[2] * mesh->pz[face];
  return p;
}

/* Around all points of the scene, a little wider. */
static void scene_box(const struct hsr_mesh *mesh, double lo[3], double hi[3]) {
  const double *at[3] = {mesh->x, mesh->y, mesh->z};
  for (int k = 0; k < 3; k++) {
    lo[k] = INFINITY;
    hi[k] = -INFINITY;
    for (uint32_t p = 0; p < mesh->n_vertices; p++) {
      lo[k] = fmin(lo[k], at[k][p]);
      hi[k] = fmax(hi[k], at[k][p]);
    }
    double more = .04 * (hi[k] - lo[k]) + 1e-6;
    lo[k] -= more;
    hi[k] += more;
  }
}

/* Corners of a plane's part in a box, at most. Rounding aside there are six; a
 * plane through corners of the box finds each of these three times. */
enum { MOST_CORNERS = 12 };

/* Puts the points in their order around the middle. */
static void put_around(double (*at)[3], int n, const double normal[3]) {
  double middle[3] = {0}, angle[MOST_CORNERS];
  int axis = 0;
  for (int c = 0; c < n; c++)
    for (int k = 0; k < 3; k++)
      middle[k] += at[c][k] / n;
  for (int k = 1; k < 3; k++)
    if (fabs(normal[k]) > fabs(normal[axis]))
      axis = k;
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  for (int c = 0; c < n; c++)
    angle[c] = atan2(at[c][v] - middle[v], at[c][u] - middle[u]);
  for (int c = 1; c < n; c++)
    for (int d = c; d > 0 && angle[d] < angle[d - 1]; d--) {
      double swap[4] = {angle[d], at[d][0], at[d][1], at[d][2]};
      angle[d] = angle[d - 1];
      memcpy(at[d], at[d - 1], sizeof at[d]);
      angle[d - 1] = swap[0];
      memcpy(at[d - 1], swap + 1, sizeof at[d]);
    }
}

/* The part of a plane in the box of the scene; returns how many corners. */
static int plane_in_box(const struct hsr_mesh *mesh, const struct plane *plane,
                        double (*at)[3]) {
  double lo[3], hi[3];
  int n = 0;
  scene_box(mesh, lo, hi);
  for (int c = 0; c < 8; c++)
    for (int axis = 0; axis < 3; axis++) {
      if (c >> axis & 1)
        continue;
      double p[3], s = -plane->offset;
      for (int k = 0; k < 3; k++) {
        p[k] = c >> k & 1 ? hi[k] : lo[k];
        s += plane->normal[k] * p[k];
      }
      double t = s + plane->normal[axis] * (hi[axis] - lo[axis]);
      if ((s < 0) == (t < 0) || n == MOST_CORNERS)
        continue;
      memcpy(at[n], p, sizeof p);
      at[n++][axis] += (hi[axis] - lo[axis]) * s / (s - t);
    }
  put_around(at, n, plane->normal);
  return n;
}

static void mark_plane(struct frames *f, const struct plane *plane,
                       const struct frame_look *look) {
  const struct hsr_mesh *mesh = &f->run->laid_out.mesh;
  double at[MOST_CORNERS][3], in[MOST_CORNERS][3],
      out[MOST_CORNERS + MOST_CORNERS / 2 + 1][3];
  int n = plane_in_box(mesh, plane, at);
  if (n < 3)
    return;
  for (int k = 0; k < n; k++)
    hsr_view_project(&f->run->view, at[k], in[k]);
  json_t *image =
      trace_polygon_json(&f->run->view, (const double(*)[3])in, n, out);
  frames_add_polygon(f, image);
  frames_set_colour(f->cairo, look->colour, look->fill);
  cairo_fill_preserve(f->cairo);
  frames_stroke(f, look->colour, look->width, look->dash);
  json_decref(image);
}

static void mark_plane_of(struct frames *f, json_int_t face,
                          const struct frame_look *look) {
  if (face < 0 || face >= f->run->laid_out.n_faces)
    return;
  struct plane plane = plane_of_face(&f->run->laid_out.mesh, (uint32_t)face);
  mark_plane(f, &plane, look);
}

/* The plane of a separator between clusters. */
static void mark_separator(struct frames *f, uint32_t node,
                           const struct frame_look *look) {
  const json_t *s =
      json_array_get(json_object_get(f->structure, "separators"), node);
  if (!s)
    return;
  if (json_is_integer(json_array_get(s, 0))) {
    mark_plane_of(f, json_integer_value(json_array_get(s, 0)), look);
    return;
  }
  struct plane plane = {{0}, json_number_value(json_array_get(s, 2))};
  plane.normal[json_integer_value(json_array_get(s, 1)) % 3] = 1;
  mark_plane(f, &plane, look);
}

/* The plane of the node that holds a piece of a BSP tree. */
static void mark_node_of(struct frames *f, const struct hsr_subject *piece) {
  static const struct frame_look look = {FRAME_INK, .08, 1.2, FRAME_DASHED};
  json_int_t at = frames_place_of_piece(f, piece);
  size_t k;
  const json_t *node;
  json_array_foreach(json_object_get(f->structure, "nodes"), k, node) {
    json_int_t first = json_integer_value(json_array_get(node, 3)),
               many = json_integer_value(json_array_get(node, 4));
    if (first <= at && at < first + many) {
      mark_plane_of(f, json_integer_value(json_array_get(node, 0)), &look);
      return;
    }
  }
}

void frames_mark_planes(struct frames *f, const struct hsr_event *event,
                        unsigned colour) {
  const struct hsr_counter *c =
      &f->run->setup.algorithm->counters[event->counter];
  const struct hsr_subject *both[] = {&event->b, &event->a};
  if (hsr_has_key(c, "inter-cluster"))
    for (int k = 0; k < 2; k++)
      if (both[k]->kind == HSR_OF_CELL)
        mark_separator(f, both[k]->id[0],
                       &(struct frame_look){colour, k ? .3 : .18, 2,
                                            k ? FRAME_SOLID : FRAME_DASHED});
  if (hsr_has_key(c, "piece") && event->a.kind == HSR_OF_PIECE)
    mark_node_of(f, &event->a);
}
