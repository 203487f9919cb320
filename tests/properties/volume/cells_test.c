/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The modules that draw the cells of a grid in an order, against the oracle's
 * pictures of the cells' faces. Eyes of all 27 classes of views, on planes of
 * cells and samples, and within kept cells; near planes; windows. Then the same
 * eyes in parallel, looking along axes, diagonals and other whole directions.
 *
 * Right       pbtf and ippbtf in all nestings, and octree-order, from back to
 *             front and from front to back; meagher. No depth is compared.
 * Wrong       btf, wbtf and vbuffer in some views in perspective; in parallel
 *             they are right. */
#include "bench/modules/variant.h"
#include "common/scene/grid_object.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
  MOST = 5,
  MOST_X = 20,
  M = 140,
  N = 29,
  PICTURE = M * N,
  VIEWS = 27 * 40
};

static uint64_t state = 11;

static int whole(int lo, int hi) {
  state = state * 6364136223846793005u + 1442695040888963407u;
  return lo + (int)((state >> 33) % (uint64_t)(hi - lo + 1));
}

/* --- Grids ---------------------------------------------------------------- */

struct volume {
  uint32_t n[3];
  double at[3][MOST_X];
  struct hsr_scene *scene;
  struct hsr_world world, outline;
};

static enum hsr_status random_slice(void *data, uint32_t k, float *density,
                                    struct hsr_error *err) {
  (void)err;
  const struct volume *v = data;
  for (uint32_t c = 0; c < v->n[0] * v->n[1]; c++)
    *density++ = whole(0, 2) > 0 || (k == 0 && c == 0);
  return HSR_OK;
}

static void make_volume(struct volume *v) {
  struct hsr_error err;
  struct hsr_grid_samples samples = {.slice = random_slice, .data = v};
  const struct hsr_grid_keep keep = {
      .least = 1, .most = INFINITY, .all_sides = whole(0, 3) == 0};
  for (int a = 0; a < 3; a++) {
    double x = 0;
    v->n[a] = samples.n[a] = (uint32_t)whole(1, a ? MOST : MOST_X);
    samples.position[a] = v->at[a];
    for (uint32_t k = 0; k < v->n[a]; k++) {
      v->at[a][k] = x;
      x += whole(1, 4);
    }
  }
  struct hsr_grid grid;
  v->scene = hsr_scene_new("cells");
  if (hsr_grid_init(&grid, &samples, &keep, &err) ||
      hsr_scene_set_grid(v->scene, &grid))
    bail("no grid");
  must_finish(v->scene);
  must_roster(&v->outline, v->scene);
  must_world(&v->world, v->scene);
}

static void free_volume(struct volume *v) {
  hsr_world_free(&v->world);
  hsr_world_free(&v->outline);
  hsr_scene_delete(v->scene);
}

/* --- Views ---------------------------------------------------------------- */

/* Below, within or above the bounds of an axis: by quarters, so often on planes
 * of cells and samples. */
static double place_eye(const struct volume *v, int axis, int place) {
  const double *bound = v->scene->grid->bound[axis];
  double lo = bound[0], hi = bound[v->n[axis]];
  int quarters = (int)(4 * (hi - lo));
  return place == 0   ? lo - whole(0, 8) / 4.0
         : place == 1 ? lo + whole(0, quarters) / 4.0
                      : hi + whole(0, 8) / 4.0;
}

/* Along a whole direction, mostly not away from the grid, at a height by which
 * samples lie on planes of cells. */
static void make_parallel(const struct volume *v, struct hsr_camera *camera) {
  int d[3];
  double towards = 0;
  do {
    for (int a = 0; a < 3; a++)
      d[a] = whole(0, 1) ? whole(-1, 1) : whole(-3, 3);
  } while (!d[0] && !d[1] && !d[2]);
  for (int a = 0; a < 3; a++)
    towards += d[a] * (v->at[a][v->n[a] / 2] - camera->eye[a]);
  if (towards < 0 && whole(0, 7))
    for (int a = 0; a < 3; a++)
      d[a] = -d[a];
  for (int a = 0; a < 3; a++) {
    camera->at[a] = camera->eye[a] + d[a];
    camera->up[a] = a == (d[0] || d[2] ? 1 : 2);
  }
  camera->parallel = N * ldexp(1, -whole(0, 3));
}

/* Towards a point of the grid, with any angle; sometimes a part of the picture.
 */
static struct hsr_view make_view(const struct volume *v, int class,
                                 bool parallel) {
  static const double fovs[] = {40, 60, 90, 120, 150};
  struct hsr_camera camera = {.up = {0, 1, 0}, .fov = fovs[whole(0, 4)]};
  struct hsr_view view;
  do {
    for (int a = 0, part = class; a < 3; a++, part /= 3) {
      camera.eye[a] = place_eye(v, a, part % 3);
      camera.at[a] = place_eye(v, a, 1);
    }
  } while (hsr_camera_check(&camera, NULL));
  camera.near = whole(0, 2) ? 0 : whole(1, 8) / 4.0;
  if (parallel)
    make_parallel(v, &camera);
  must_view(&view, &camera, M, N);
  if (whole(0, 3) == 0)
    view.window = (struct hsr_window){whole(0, M / 2), whole(0, N / 2),
                                      whole(M / 2 + 1, M), whole(N / 2 + 1, N)};
  return view;
}

/* --- Modules -------------------------------------------------------------- */

/* What is tried, and what was found, in perspective and in parallel. */
struct player {
  const char *name;
  bool is_nested, knows_no_eye, has_one_order;
  long differing[2], depths;
  int wrong_views[2];
};

static struct player players[] = {
    {.name = "pbtf", .is_nested = true},
    {.name = "ippbtf", .is_nested = true},
    {.name = "octree-order"},
    {.name = "meagher", .has_one_order = true},
    {.name = "btf", .is_nested = true, .knows_no_eye = true},
    {.name = "wbtf", .knows_no_eye = true},
    {.name = "vbuffer", .knows_no_eye = true}};
enum { PLAYERS = sizeof players / sizeof *players };

static struct hsr_variant variant(const struct player *p, int nesting,
                                  int front) {
  static const char *const nestings[] = {"zyx", "zxy", "yzx",
                                         "yxz", "xzy", "xyz"};
  char name[80];
  struct hsr_variant made;
  struct hsr_error err;
  int n = snprintf(name, sizeof name, "%s%s", p->name,
                   p->has_one_order ? ""
                   : front          ? ":front=on"
                                    : ":front=off");
  if (p->is_nested)
    snprintf(name + n, sizeof name - (size_t)n, ":nesting=%s",
             nestings[nesting]);
  if (hsr_variant_parse(name, &made, &err))
    bail("%s", err.text);
  return made;
}

/* How many samples differ from the oracle's. The module sees no face. */
static long differences(const struct volume *v, const struct hsr_view *view,
                        const uint32_t *right, struct player *p, int nesting,
                        int front) {
  static uint32_t ids[PICTURE];
  struct hsr_error err;
  struct hsr_setup setup;
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  struct hsr_tally tally = {0};
  struct hsr_variant made = variant(p, nesting, front);
  const struct hsr_algorithm *a =
      front ? made.listed->plain : made.listed->counting;
  memset(ids, 0xfe, sizeof ids);
  struct hsr_answer answer = hsr_answer_of_ids(ids, M, N);
  struct hsr_job job = {
      .view = view, .answer = &answer, .scratch = &scratch, .tally = &tally};
  must_setup(&setup, a, &made.choice, &v->outline);
  if (hsr_setup_render(&setup, &job, &err))
    bail("%s", err.text);
  p->depths += (long)tally.depths_compared + (long)tally.exact[HSR_ASK_DEPTH];
  hsr_setup_free(&setup);
  hsr_arena_free(&scratch);
  return count_differences(view, ids, right);
}

struct found {
  long samples, covered;
};

static void try_view(const struct volume *v, int class, bool parallel,
                     struct found *found) {
  static uint32_t right[PICTURE];
  struct hsr_view view = make_view(v, class, parallel);
  draw_plain("oracle", &v->world, &view, right);
  for (int k = 0; k < PICTURE; k++)
    found->covered += right[k] != HSR_BACKGROUND && right[k] != UNWRITTEN;
  found->samples += PICTURE;
  for (int k = 0; k < PLAYERS; k++) {
    struct player *p = &players[k];
    long wrong = 0;
    for (int nesting = 0; nesting < (p->is_nested ? 6 : 1); nesting++)
      for (int front = 0; front < 2; front++)
        wrong += differences(v, &view, right, p, nesting, front);
    p->differing[parallel] += wrong;
    p->wrong_views[parallel] += wrong > 0;
  }
}

int main(void) {
  struct tap tap = plan(2 + PLAYERS);
  for (int parallel = 0; parallel < 2; parallel++) {
    struct found found = {0};
    for (int k = 0; k < VIEWS; k++) {
      struct volume v;
      make_volume(&v);
      try_view(&v, k % 27, parallel, &found);
      free_volume(&v);
    }
    ok(&tap, found.covered > found.samples / 12,
       "%d views%s, of 27 classes: of %ld samples %ld show a cell", VIEWS,
       parallel ? " in parallel" : "", found.samples, found.covered);
  }
  for (const struct player *p = players; p < players + PLAYERS; p++)
    ok(&tap,
       p->knows_no_eye == (p->differing[0] > 0) && !p->differing[1] &&
           !p->depths,
       "%s%s: %ld samples differ, in %d views; in parallel %ld, in %d; %ld "
       "depths "
       "compared",
       p->name, p->knows_no_eye ? " knows no eye" : "", p->differing[0],
       p->wrong_views[0], p->differing[1], p->wrong_views[1], p->depths);
  return finish(&tap);
}
