/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cells of grids, painted in the orders of common/grids/order.h, against the
 * oracle's pictures of their faces: no depth is compared. Eyes of all 27 classes
 * of views, on planes of cells and samples, and within kept cells.
 *
 * Right       pbtf in all nestings, ippbtf and octree-order, from back to front
 *             and from front to back, where only vacant samples are painted.
 * Wrong       btf, wbtf and vbuffer in some views. */
#include "algorithms/variant.h"
#include "common/exact/screen.h"
#include "common/grids/grid_object.h"
#include "common/grids/order.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 5, M = 41, N = 29, PICTURE = M * N, VIEWS = 27 * 40 };

static uint64_t state = 11;

static int whole(int lo, int hi) {
  state = state * 6364136223846793005u + 1442695040888963407u;
  return lo + (int)((state >> 33) % (uint64_t)(hi - lo + 1));
}

static void stop(const char *what) {
  printf("Bail out! %s\n", what);
  exit(99);
}

/* --- Grids ---------------------------------------------------------------- */

struct volume {
  uint32_t n[3];
  double at[3][MOST];
  struct hsr_grid grid;
  struct hsr_scene *scene;
  struct hsr_world world;
};

static enum hsr_status random_slice(void *data, uint32_t k, float *density,
                                    struct hsr_error *err) {
  (void)err;
  const struct volume *v = data;
  for (uint32_t c = 0; c < v->n[0] * v->n[1]; c++)
    *density++ = whole(0, 2) > 0 || (k == 0 && c == 0);
  return HSR_OK;
}

static void grey(void *data, const uint32_t at[3], float rgb[3]) {
  (void)data, (void)at;
  rgb[0] = rgb[1] = rgb[2] = 0.5f;
}

static void make_volume(struct volume *v) {
  struct hsr_error err;
  struct hsr_grid_samples samples = {.slice = random_slice, .data = v};
  const struct hsr_grid_keep keep = {
      .least = 1, .most = INFINITY, .all_sides = whole(0, 3) == 0};
  for (int a = 0; a < 3; a++) {
    double x = 0;
    v->n[a] = samples.n[a] = (uint32_t)whole(1, MOST);
    samples.position[a] = v->at[a];
    for (uint32_t k = 0; k < v->n[a]; k++) {
      v->at[a][k] = x;
      x += whole(1, 4);
    }
  }
  v->scene = hsr_scene_new("cells");
  struct hsr_object *object = hsr_scene_object(v->scene, "cells");
  if (hsr_grid_init(&v->grid, &samples, &keep, &err) ||
      hsr_grid_make_object(&v->grid, grey, NULL, object) ||
      hsr_scene_finish(v->scene, &err) ||
      hsr_world_init(&v->world, v->scene, &err))
    stop("no grid");
}

static void free_volume(struct volume *v) {
  hsr_world_free(&v->world);
  hsr_scene_delete(v->scene);
  hsr_grid_free(&v->grid);
}

/* --- Views ---------------------------------------------------------------- */

/* Below, within or above the bounds of an axis: by quarters, so often on planes
 * of cells and samples. */
static double place_eye(const struct volume *v, int axis, int place) {
  const double *bound = v->grid.bound[axis];
  double lo = bound[0], hi = bound[v->n[axis]];
  int quarters = (int)(4 * (hi - lo));
  return place == 0   ? lo - whole(0, 8) / 4.0
         : place == 1 ? lo + whole(0, quarters) / 4.0
                      : hi + whole(0, 8) / 4.0;
}

/* Towards a point of the grid, with any angle. */
static struct hsr_view make_view(const struct volume *v, int class) {
  static const double fovs[] = {40, 60, 90, 120, 150};
  struct hsr_camera camera = {.up = {0, 1, 0}, .fov = fovs[whole(0, 4)]};
  struct hsr_view view;
  do {
    for (int a = 0, part = class; a < 3; a++, part /= 3) {
      camera.eye[a] = place_eye(v, a, part % 3);
      camera.at[a] = place_eye(v, a, 1);
    }
  } while (hsr_camera_check(&camera, NULL));
  if (hsr_view_init(&view, &camera, M, N, NULL))
    stop("no view");
  return view;
}

static struct hsr_grid_seen see(const struct volume *v,
                                const struct hsr_view *view) {
  struct hsr_grid_seen seen = {.high_first = false};
  for (int a = 0; a < 3; a++) {
    seen.n[a] = v->n[a];
    seen.q[a] = hsr_grid_split(v->grid.bound[a], v->n[a], view->E[a]);
    seen.toward[a] = view->F[a];
  }
  return seen;
}

/* --- Painting ------------------------------------------------------------- */

struct painter {
  const struct volume *volume;
  struct hsr_screen *screen;
  struct hsr_tally *tally;
  const bool *is_relevant; /* by face */
  bool front;              /* only vacant samples are painted */
  uint32_t *ids;
};

static void paint_face(struct painter *p, uint32_t f) {
  const struct hsr_bounds *b = &p->screen->bounds[f];
  int columns[8];
  for (int j = b->y0; j < b->y1; j++) {
    int n = hsr_face_spans(p->screen, f, j, columns, p->tally);
    for (int k = 0; k < n; k += 2)
      for (int i = columns[k] > b->x0 ? columns[k] : b->x0;
           i < columns[k + 1] && i < b->x1; i++)
        if (!p->front || p->ids[j * M + i] == HSR_BACKGROUND)
          p->ids[j * M + i] = f;
  }
}

/* The sides of a cell that face the eye do not hide one another. */
static void paint_cell(struct painter *p, const uint32_t at[3]) {
  const struct hsr_grid *grid = &p->volume->grid;
  uint32_t cell = hsr_grid_cell(grid, at);
  if (cell == UINT32_MAX)
    return;
  uint32_t face = hsr_grid_first_face(grid, cell);
  for (int side = 0; side < 6; side++)
    if (grid->sides[cell] >> side & 1) {
      if (p->is_relevant[face])
        paint_face(p, face);
      face++;
    }
}

static void paint_run(void *data, const struct hsr_grid_run *run) {
  for (uint32_t k = 0; k < run->n; k++) {
    uint32_t at[3] = {run->at[0], run->at[1], run->at[2]};
    at[run->axis] += (uint32_t)((int)k * run->step);
    paint_cell(data, at);
  }
}

/* How many samples differ from the oracle's if the cells are painted so. */
static long differences(const struct volume *v, const struct hsr_view *view,
                        const uint32_t *right, enum hsr_grid_order order,
                        int nesting, bool front) {
  static uint32_t ids[PICTURE];
  struct hsr_arena arena = HSR_ARENA_EMPTY;
  struct hsr_tally tally = {0};
  struct hsr_screen screen;
  struct hsr_error err;
  struct hsr_grid_seen seen = see(v, view);
  if (hsr_screen_make(&screen, &v->world, view, &arena, &tally))
    stop("no memory");
  bool *is_relevant = HSR_NEW(&arena, bool, v->world.n_faces);
  if (!is_relevant)
    stop("no memory");
  memset(is_relevant, 0, v->world.n_faces * sizeof *is_relevant);
  for (uint32_t r = 0; r < screen.n_relevant; r++)
    is_relevant[screen.relevant[r]] = true;
  memset(ids, 0xff, sizeof ids);
  struct painter p = {v, &screen, &tally, is_relevant, front, ids};
  if (hsr_grid_visit(order, nesting, front, &seen, paint_run, &p, &err))
    stop(err.text);
  hsr_arena_free(&arena);
  return count_differences(view, ids, right);
}

struct found {
  long samples, covered, wrong[HSR_GRID_ORDERS];
  int wrong_views[HSR_GRID_ORDERS];
};

static void try_view(const struct volume *v, int class, struct found *found) {
  static uint32_t right[PICTURE];
  struct hsr_view view = make_view(v, class);
  draw_ids(hsr_algorithm_find("oracle")->plain, &v->world, &view, right, NULL);
  for (int k = 0; k < PICTURE; k++)
    found->covered += right[k] != HSR_BACKGROUND;
  found->samples += PICTURE;
  for (enum hsr_grid_order order = 0; order < HSR_GRID_ORDERS; order++) {
    long wrong = 0;
    for (int nesting = 0; nesting < 6; nesting++)
      for (int front = 0; front < 2; front++)
        wrong += differences(v, &view, right, order, nesting, front);
    found->wrong[order] += wrong;
    found->wrong_views[order] += wrong > 0;
  }
}

int main(void) {
  struct tap tap = plan(1 + HSR_GRID_ORDERS);
  struct found found = {0};
  for (int k = 0; k < VIEWS; k++) {
    struct volume v;
    make_volume(&v);
    try_view(&v, k % 27, &found);
    free_volume(&v);
  }
  ok(&tap, found.covered > found.samples / 4,
     "%d views, of 27 classes: of %ld samples %ld show a cell", VIEWS,
     found.samples, found.covered);
  for (enum hsr_grid_order order = 0; order < HSR_GRID_ORDERS; order++) {
    bool is_right = order >= HSR_PBTF;
    ok(&tap, is_right ? !found.wrong[order] : found.wrong[order] > 0,
       "%s%s: %ld samples differ, in %d views", hsr_grid_order_name[order],
       is_right ? "" : " knows no eye", found.wrong[order],
       found.wrong_views[order]);
  }
  return finish(&tap);
}
