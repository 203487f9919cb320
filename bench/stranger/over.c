/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/stranger/over.h"
#include "common/exact/predicates.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A face that covers a sample of a row. */
struct met {
  int column;
  uint32_t face;
};

/* --- The world, seen from both sides -------------------------------------- */

/* A view whose samples are displaced the other way: x and y run backwards, so
 * sample point (sx, sy) is (m - sx, n - sy) there. */
static bool turn_round(struct hsr_view *view, bool *out_of_memory) {
  for (int k = 0; k < 3; k++) {
    view->R[k] = -view->R[k];
    view->U[k] = -view->U[k];
  }
  return hsr_exact_view_matrices(view, out_of_memory);
}

enum hsr_status overlook_open(struct overlook *o, const struct studio *studio,
                              const struct supposed *now,
                              struct hsr_error *err) {
  bool out_of_memory = false;
  *o = (struct overlook){.now = now, .world = studio->world};
  o->open = *studio->world;
  o->open.mesh.one_sided =
      HSR_NEW_ZEROED(&o->arena, bool, studio->world->n_faces);
  o->columns = HSR_NEW(&o->arena, int, hsr_most_corners(studio->world) + 4);
  o->view = now->view;
  o->view.near = o->view.camera.near = 0;
  o->turned = o->view;
  if (!o->open.mesh.one_sided || !o->columns ||
      !turn_round(&o->turned, &out_of_memory))
    return hsr_fail_nomem(err);
  return hsr_screen_make(&o->screen, &o->open, &o->view, &o->arena, &o->tally)
             ? hsr_fail_nomem(err)
             : HSR_OK;
}

void overlook_close(struct overlook *o) {
  hsr_arena_free(&o->arena);
  free(o->met.items);
  free(o->list.items);
}

/* One more item of an array that malloc made. NULL: memory ran out. */
static void *grow(struct hsr_growing *array, size_t size) {
  if (array->n == array->room) {
    size_t room = array->room ? 2 * array->room : 64;
    void *items = realloc(array->items, room * size);
    if (!items)
      return NULL;
    array->items = items;
    array->room = room;
  }
  return (char *)array->items + size * array->n++;
}

/* --- A row ---------------------------------------------------------------- */

bool is_looked_at(const struct supposed *now, size_t k) {
  return now->got[k] != now->wanted[k] ||
         (now->got[k] != HSR_NO_FACE &&
          k % (1 + now->all / RIGHT_LOOKED_AT) == 0);
}

static bool add_spans(struct overlook *o, uint32_t f, int j) {
  int n = hsr_face_spans(&o->screen, f, j, o->columns, &o->tally);
  for (int k = 0; k + 1 < n; k += 2)
    for (int i = o->columns[k]; i < o->columns[k + 1]; i++) {
      if (!is_looked_at(o->now, (size_t)j * (size_t)o->now->m + (size_t)i))
        continue;
      struct met *met = grow(&o->met, sizeof *met);
      if (!met)
        return false;
      *met = (struct met){i, f};
    }
  return true;
}

static int compare_columns(const void *a, const void *b) {
  const struct met *p = a, *q = b;
  return p->column != q->column
             ? (p->column > q->column) - (p->column < q->column)
             : (p->face > q->face) - (p->face < q->face);
}

enum hsr_status overlook_row(struct overlook *o, int j, struct hsr_error *err) {
  const struct hsr_screen *s = &o->screen;
  bool good = true;
  o->met.n = 0;
  for (uint32_t k = 0; k < s->n_relevant && good; k++) {
    const uint32_t f = s->relevant[k];
    if (s->bounds[f].y0 <= j && j < s->bounds[f].y1)
      good = add_spans(o, f, j);
  }
  if (!good || o->tally.out_of_memory)
    return hsr_fail_nomem(err);
  if (o->met.n)
    qsort(o->met.items, o->met.n, sizeof(struct met), compare_columns);
  return HSR_OK;
}

/* --- A sample ------------------------------------------------------------- */

/* The side of the face that the eye is on: +1 in front, -1 behind, 0 if its
 * plane holds the eye. */
static int side_of_eye(struct overlook *o, uint32_t f) {
  int side = o->screen.facing[f];
  return side ? side
              : hsr_exact_eye_side(&o->view, hsr_face_loop(&o->open, f),
                                   &o->tally.out_of_memory);
}

bool exists(struct overlook *o, uint32_t f) {
  int side = side_of_eye(o, f);
  return side > 0 || (side < 0 && !o->world->mesh.one_sided[f]);
}

static bool is_beyond_near(struct overlook *o, uint32_t f, int i, int j) {
  const struct hsr_view *view = &o->now->view;
  return view->near <= 0 ||
         hsr_loop_beyond_near(view, hsr_face_loop(&o->open, f),
                              hsr_sample_x(view, i), hsr_sample_y(view, j),
                              &o->tally);
}

/* Puts the last item in its place among those before it. */
static void insert(struct overlook *o, int i, int j) {
  struct over *list = o->list.items, last = list[o->list.n - 1];
  size_t low = 0, high = o->list.n - 1;
  while (low < high) {
    size_t middle = low + (high - low) / 2;
    if (hsr_nearer(&o->screen, last.face, list[middle].face, i, j, &o->tally))
      high = middle;
    else
      low = middle + 1;
  }
  memmove(list + low + 1, list + low, (o->list.n - 1 - low) * sizeof *list);
  list[low] = last;
}

/* The first of the faces that are met in column i, or later. */
static size_t first_met(const struct overlook *o, int i) {
  const struct met *met = o->met.items;
  size_t low = 0, high = o->met.n;
  while (low < high) {
    size_t middle = low + (high - low) / 2;
    if (met[middle].column < i)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

const struct over *overlook_sample(struct overlook *o, int i, int j,
                                   size_t *n) {
  static const struct over none;
  const struct met *met = o->met.items;
  o->list.n = 0;
  for (size_t k = first_met(o, i); k < o->met.n && met[k].column == i; k++) {
    const uint32_t f = met[k].face;
    if (!is_beyond_near(o, f, i, j))
      continue;
    struct over *over = grow(&o->list, sizeof *over);
    if (!over)
      return NULL;
    *over = (struct over){f, exists(o, f), side_of_eye(o, f) < 0};
    insert(o, i, j);
  }
  *n = o->list.n;
  if (o->tally.out_of_memory)
    return NULL;
  return *n ? o->list.items : &none;
}

/* --- Ties ----------------------------------------------------------------- */

/* The planes meet on the ray if their order is another where the sample is
 * displaced the other way. */
bool is_tie(struct overlook *o, uint32_t f, uint32_t g, int i, int j) {
  const struct hsr_mesh *mesh = &o->open.mesh;
  const struct hsr_depth_plane *p = &o->screen.plane[f],
                               *q = &o->screen.plane[g];
  if (mesh->plane[f] == mesh->plane[g])
    return true;
  double by = hsr_depth(&o->screen, f, i, j) - hsr_depth(&o->screen, g, i, j);
  if (fabs(by) > p->error + q->error)
    return false;
  double sx = hsr_sample_x(&o->view, i), sy = hsr_sample_y(&o->view, j);
  struct hsr_loop one = hsr_face_loop(&o->open, f),
                  other = hsr_face_loop(&o->open, g);
  bool *oom = &o->tally.out_of_memory;
  return hsr_exact_nearer(&o->view, one, other, sx, sy, oom) !=
         hsr_exact_nearer(&o->turned, one, other, o->view.m - sx,
                          o->view.n - sy, oom);
}

/* --- Edges ---------------------------------------------------------------- */

/* Cuts the part t0 to t1 of a line to where from + t by <= most. */
static void cut(double from, double by, double most, double *t0, double *t1) {
  if (by == 0) {
    if (from > most)
      *t1 = -1;
    return;
  }
  double t = (most - from) / by;
  if (by > 0)
    *t1 = t < *t1 ? t : *t1;
  else
    *t0 = t > *t0 ? t : *t0;
}

/* Whether the line from (x, y) by (dx, dy) meets the square |x|, |y| <= half.
 * Corners are known within HSR_DELTA, which is allowed for. */
static bool meets_square(double x, double y, double dx, double dy,
                         double half) {
  double t0 = 0, t1 = 1;
  half += 2 * HSR_DELTA;
  cut(x, dx, half, &t0, &t1);
  cut(-x, -dx, half, &t0, &t1);
  cut(y, dy, half, &t0, &t1);
  cut(-y, -dy, half, &t0, &t1);
  return t0 <= t1;
}

/* Of a face that reaches behind the eye: whether the sample's surroundings are
 * partly within it. */
static bool is_partly_within(struct overlook *o, uint32_t f, int i, int j) {
  const struct hsr_loop loop = hsr_face_loop(&o->open, f);
  int within = 0;
  for (int k = 0; k < 9; k++)
    within += hsr_loop_surrounds(
        &o->view, loop, hsr_sample_x(&o->view, i) + (k % 3 - 1) / 2.0,
        hsr_sample_y(&o->view, j) + (k / 3 - 1) / 2.0, &o->tally);
  return within > 0 && within < 9;
}

bool has_edge_near(struct overlook *o, uint32_t f, int i, int j) {
  const struct hsr_mesh *mesh = &o->open.mesh;
  const double sx = hsr_sample_x(&o->view, i), sy = hsr_sample_y(&o->view, j);
  const uint32_t n = hsr_face_size(&o->open, f);
  bool unsafe = false;
  for (uint32_t k = 0; k < n; k++) {
    uint32_t a = mesh->vertex[mesh->start[f] + k];
    uint32_t b = mesh->vertex[mesh->start[f] + (k + 1) % n];
    double ax = o->screen.sx[a], ay = o->screen.sy[a];
    double bx = o->screen.sx[b], by = o->screen.sy[b];
    if (isnan(ax) || isnan(bx))
      unsafe = true;
    else if (meets_square(ax - sx, ay - sy, bx - ax, by - ay, .5))
      return true;
  }
  return unsafe && is_partly_within(o, f, i, j);
}
