/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The modules that splat, against the splat oracle, to the last bit. Random
 * grids, palettes and options; eyes of all 27 classes of views, on planes of
 * cells and samples, and within kept cells; near planes, offsets, windows;
 * motion since the view before, small and large; in perspective and in parallel. The picture drawn in windows is the same. Then
 * views that are as bad as can be.
 *
 * splats_test [SEED [VIEWS]]: other views, and so many in either projection. */
#include "bench/modules/variant.h"
#include "tests/properties/volume/splatting.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
  MOST = 5,
  MOST_X = 20,
  MOST_SAMPLES = MOST_X * MOST * MOST,
  MOST_M = 48,
  MOST_N = 24,
  MOST_PIXELS = 1 << 14,
  CLASSES = 27,
  MOST_SHOWN = 12 /* differences that are described */
};

static uint64_t state = 11;

static int whole(int lo, int hi) {
  return (int)draw_integer(&state, lo, hi);
}

static bool once_in(int n) {
  return whole(1, n) == 1;
}

/* --- Modules -------------------------------------------------------------- */

struct player {
  const char *name, *model;
};
static const struct player players[] = {
    {"splat", "over"},        {"splat", "under"},
    {"splat-sheet", "sheet"}, {"splat-volume", "volume"},
    {"splat-volume", "slab"}, {"splat-xray", "xray"}};
enum { PLAYERS = sizeof players / sizeof *players };
static const char *const kernels[] = {"crawfis-max", "gaussian"};

/* Of each module and kernel. */
struct found {
  long views, pixels, seen, differing, in_windows, exact;
};

static void add_found(struct found *sum, const struct found *f) {
  sum->views += f->views;
  sum->pixels += f->pixels;
  sum->seen += f->seen;
  sum->differing += f->differing;
  sum->in_windows += f->in_windows;
  sum->exact += f->exact;
}

/* --- Comparing ------------------------------------------------------------ */

static int shown;

static void describe(const struct hsr_view *v, const struct hsr_variant *made,
                     const uint16_t *got, const uint16_t *wanted, size_t k) {
  const uint16_t *g = got + 4 * k, *w = wanted + 4 * k;
  if (shown++ >= MOST_SHOWN)
    return;
  printf("# %s: pixel (%d, %d): %d %d %d %d, not %d %d %d %d\n", made->name,
         (int)k % v->m, (int)k / v->m, g[0], g[1], g[2], g[3], w[0], w[1], w[2],
         w[3]);
  printf("#   %d x %d, offset %g %g, window %d %d %d %d, near %g, E %.17g "
         "%.17g %.17g, F %.17g %.17g %.17g, parallel %.17g, fov %g\n",
         v->m, v->n, v->offset_x, v->offset_y, v->window.x0, v->window.y0,
         v->window.x1, v->window.y1, v->near, v->E[0], v->E[1], v->E[2],
         v->F[0], v->F[1], v->F[2], v->camera.parallel, v->camera.fov);
}

static long differences(const struct hsr_view *v,
                        const struct hsr_variant *made, const uint16_t *got,
                        const uint16_t *wanted) {
  long n = 0;
  for (size_t k = 0; k < (size_t)v->m * (size_t)v->n; k++)
    if (memcmp(got + 4 * k, wanted + 4 * k, 4 * sizeof *got)) {
      if (!n++)
        describe(v, made, got, wanted, k);
    }
  return n;
}

/* Divides the window of a view into four, none of which is empty. */
static int divide(const struct hsr_view *v, struct hsr_window parts[4]) {
  const struct hsr_window *w = &v->window;
  int x = whole(w->x0, w->x1), y = whole(w->y0, w->y1), n = 0;
  const struct hsr_window all[4] = {{w->x0, w->y0, x, y},
                                    {x, w->y0, w->x1, y},
                                    {w->x0, y, x, w->y1},
                                    {x, y, w->x1, w->y1}};
  for (int k = 0; k < 4; k++)
    if (all[k].x0 < all[k].x1 && all[k].y0 < all[k].y1)
      parts[n++] = all[k];
  return n;
}

static struct found compare(const struct stage *s, const struct hsr_view *view,
                            const struct hsr_variant *made) {
  static uint16_t right[4 * MOST_PIXELS], got[4 * MOST_PIXELS];
  struct hsr_window parts[4];
  struct hsr_tally tally = {.out_of_memory = false};
  struct found f = {.views = 1, .pixels = (long)view->m * view->n};
  enum build build = once_in(2) ? PLAIN : COUNTING;
  judge_splats(s, view, made, right, NULL);
  for (long k = 0; k < f.pixels; k++)
    f.seen += right[4 * k + 3] > 0;
  draw_splats(s, view, made, build, NULL, 0, got, &tally);
  f.differing = differences(view, made, got, right);
  draw_splats(s, view, made, build, parts, divide(view, parts), got, NULL);
  f.in_windows = differences(view, made, got, right);
  f.exact = (long)tally.exact[HSR_ASK_FOOTPRINT];
  return f;
}

/* --- Grids ---------------------------------------------------------------- */

struct volume {
  uint32_t n[3];
  double at[3][MOST_X];
  float density[MOST_SAMPLES], rgb[MOST_SAMPLES][3];
  struct hsr_palette palette;
  struct stage stage;
};

static uint16_t random_part(void) {
  return (uint16_t)(once_in(4)   ? 0
                    : once_in(3) ? UINT16_MAX
                                 : whole(0, UINT16_MAX));
}

/* Anything; sometimes one of those that are built in. */
static void make_palette(struct hsr_palette *p) {
  static const char *const names[] = {"flat", "solid", "haze", "surfaces"};
  if (once_in(3) && hsr_palette_find(names[whole(0, 3)], p))
    return;
  *p = (struct hsr_palette){.own_colours = once_in(2),
                            .ambient = random_part(),
                            .diffuse = random_part(),
                            .specular = random_part(),
                            .exponent = once_in(2) ? whole(1, 128) : 1,
                            .eye_light = once_in(2)};
  int most = once_in(8) ? 0 : 1024;
  for (int a = 0; a < 3; a++)
    p->light[a] = (int16_t)whole(-most, most);
  for (int k = 0; k < HSR_LEVELS; k++) {
    p->opacity[k] = random_part();
    p->gradient[k] = random_part();
    for (int c = 0; c < 3; c++)
      p->rgb[k][c] = random_part();
  }
}

/* Quarters apart; at even distances; or at numbers that are no fractions of a
 * power of two. */
static void make_positions(struct volume *v, int a) {
  double x = 0, scale = once_in(5) ? 1 / 3.0 : 1;
  bool even = once_in(3);
  v->n[a] = (uint32_t)whole(1, a ? MOST : MOST_X);
  for (uint32_t k = 0; k < v->n[a]; k++) {
    v->at[a][k] = x * scale;
    x += even ? 1 : whole(1, 8) / 4.0;
  }
}

/* The first sample is kept in any case. */
static void make_samples(struct volume *v) {
  bool all = once_in(4);
  for (uint32_t c = 0; c < v->n[0] * v->n[1] * v->n[2]; c++) {
    v->density[c] = (float)whole(1, 256) / 256;
    if (!all && c > 0 && once_in(2))
      v->density[c] = once_in(8) ? NAN : 0;
    for (int k = 0; k < 3; k++)
      v->rgb[c][k] = (float)whole(0, 256) / 256;
  }
}

static void open_volume(struct volume *v) {
  struct field field = {.density = v->density,
                        .low = 0,
                        .high = 1,
                        .keep = {.least = 1 / 256.0, .most = INFINITY},
                        .palette = &v->palette};
  for (int a = 0; a < 3; a++) {
    field.n[a] = v->n[a];
    field.at[a] = v->at[a];
  }
  if (once_in(2))
    field.rgb = v->rgb;
  open_stage(&v->stage, &field);
}

static void make_volume(struct volume *v) {
  for (int a = 0; a < 3; a++)
    make_positions(v, a);
  make_samples(v);
  make_palette(&v->palette);
  open_volume(v);
}

/* --- Views ---------------------------------------------------------------- */

/* Below, within or above the bounds of an axis: at a sample, at a bound, or by
 * quarters, which are often one of them. */
static double place_eye(const struct volume *v, int axis, int place) {
  const double *bound = v->stage.scene->grid->bound[axis];
  int n = (int)v->n[axis];
  double lo = bound[0], hi = bound[n];
  if (place == 1 && once_in(3))
    return once_in(2) ? v->at[axis][whole(0, n - 1)] : bound[whole(0, n)];
  return place == 0   ? lo - whole(0, 8) / 4.0
         : place == 1 ? lo + whole(0, (int)(4 * (hi - lo))) / 4.0
                      : hi + whole(0, 8) / 4.0;
}

static void set_up(struct hsr_camera *camera, const int d[3]) {
  for (int a = 0; a < 3; a++) {
    camera->at[a] = camera->eye[a] + d[a];
    camera->up[a] = a == (d[0] || d[2] ? 1 : 2);
  }
}

/* A whole direction, mostly not away from the grid. */
static void choose_direction(const struct volume *v,
                             const struct hsr_camera *camera, int d[3]) {
  double towards = 0;
  bool along_axis = once_in(3);
  do {
    int axis = whole(0, 2);
    for (int a = 0; a < 3; a++)
      d[a] = along_axis && a != axis ? 0
             : once_in(2)            ? whole(-1, 1)
                                     : whole(-3, 3);
  } while (!d[0] && !d[1] && !d[2]);
  for (int a = 0; a < 3; a++)
    towards += d[a] * (v->at[a][v->n[a] / 2] - camera->eye[a]);
  if (towards < 0 && !once_in(8))
    for (int a = 0; a < 3; a++)
      d[a] = -d[a];
}

static void choose_eye(const struct volume *v, int class,
                       struct hsr_camera *camera) {
  do {
    for (int a = 0, part = class; a < 3; a++, part /= 3) {
      camera->eye[a] = place_eye(v, a, part % 3);
      camera->at[a] = place_eye(v, a, 1);
    }
  } while (hsr_camera_check(camera, NULL));
}

/* Towards a point of the grid; or in a whole direction, which in parallel is
 * always so, at a height by which pixels lie on samples. */
static struct hsr_camera make_camera(const struct volume *v, int class,
                                     bool parallel, int n) {
  static const double fovs[] = {40, 60, 90, 120, 150};
  struct hsr_camera camera = {.up = {0, 1, 0}, .fov = fovs[whole(0, 4)]};
  int d[3];
  choose_eye(v, class, &camera);
  camera.near = once_in(3) ? whole(1, 8) / 4.0 : 0;
  if (parallel || once_in(3)) {
    choose_direction(v, &camera, d);
    set_up(&camera, d);
  }
  if (parallel)
    camera.parallel = n * ldexp(1, whole(-4, once_in(4) ? 2 : 0));
  return camera;
}

/* By some eighths, so that motion may be along a row of pixels, or none. */
static struct hsr_camera nearby(const struct hsr_camera *camera) {
  struct hsr_camera moved;
  do {
    moved = *camera;
    for (int a = 0; a < 3; a++) {
      moved.eye[a] += whole(-2, 2) / 8.0;
      moved.at[a] += once_in(2) ? moved.eye[a] - camera->eye[a] : 0;
    }
  } while (hsr_camera_check(&moved, NULL));
  return moved;
}

/* The view before this one was close to it, or anywhere. */
static void follow(const struct volume *v, struct hsr_view *view,
                   const struct hsr_camera *camera) {
  bool parallel = once_in(4) ? once_in(2) : view->parallel;
  struct hsr_camera was =
      once_in(3) ? make_camera(v, whole(0, CLASSES - 1), parallel, view->n)
                 : nearby(camera);
  struct hsr_view before = splat_view(&was, view->m, view->n);
  hsr_view_follow(view, &before);
}

static struct hsr_view make_view(const struct volume *v, int class,
                                 bool parallel) {
  int m = once_in(3) ? 16 << whole(0, 1) : whole(1, MOST_M);
  int n = once_in(3) ? 4 << whole(0, 2) : whole(1, MOST_N);
  struct hsr_camera camera = make_camera(v, class, parallel, n);
  struct hsr_view view = splat_view(&camera, m, n);
  if (once_in(2)) {
    view.offset_x = whole(-3, 3) / 8.0;
    view.offset_y = whole(-3, 3) / 8.0;
  }
  if (once_in(2))
    follow(v, &view, &camera);
  if (once_in(4))
    view.window =
        (struct hsr_window){whole(0, (m - 1) / 2), whole(0, (n - 1) / 2),
                            whole(m / 2 + 1, m), whole(n / 2 + 1, n)};
  return view;
}

/* --- Random views --------------------------------------------------------- */

static struct hsr_variant make_variant(const struct player *p,
                                       const char *kernel) {
  static const double widths[] = {1, 1, 1, 1.25, 1.5, 2, 3.7},
                      attenuates[] = {1, 1, 1, 0.5, 0.3, 0.01, 0},
                      exposures[] = {1, 1, 1, 0.25, 3.7, 1000, 0};
  static const int buckets[] = {64, 64, 64, 1, 2, 7, 200}, frames[] = {2, 3, 5};
  static const char *const blurs[] = {"off", "area", "exact", "accumulate"};
  static const double thresholds[] = {0, 0, 0, 0.125, 1, 3};
  return splat_variant(
      "%s:model=%s:kernel=%s:width=%.17g:antialias=%s:attenuate=%.17g:"
      "normalise=%s:opacity=%s:exposure=%.17g:buckets=%d:blur=%s:"
      "threshold=%.17g:frames=%d",
      p->name, p->model, kernel, widths[whole(0, 6)], once_in(2) ? "on" : "off",
      attenuates[whole(0, 6)], once_in(3) ? "on" : "off",
      once_in(2) ? "length" : "weight", exposures[whole(0, 6)],
      buckets[whole(0, 6)], blurs[whole(0, 3)], thresholds[whole(0, 5)],
      frames[whole(0, 2)]);
}

static void try_random(struct tap *tap, bool parallel, int views) {
  struct found found[PLAYERS][2] = {{{0}}}, all = {0};
  long exact = 0;
  for (int k = 0; k < views; k++) {
    static struct volume v;
    int player = k % PLAYERS, kernel = whole(0, 1);
    if (k % 3 == 0) {
      if (k)
        close_stage(&v.stage);
      make_volume(&v);
    }
    struct hsr_view view = make_view(&v, k / PLAYERS % CLASSES, parallel);
    struct hsr_variant made = make_variant(&players[player], kernels[kernel]);
    struct found f = compare(&v.stage, &view, &made);
    add_found(&found[player][kernel], &f);
    if (k == views - 1)
      close_stage(&v.stage);
  }
  for (int p = 0; p < PLAYERS; p++)
    for (int kernel = 0; kernel < 2; kernel++) {
      const struct found *f = &found[p][kernel];
      add_found(&all, f);
      exact += kernel ? f->exact : 0;
      ok(tap, !f->differing && !f->in_windows,
         "%s, %s%s: of %ld pixels in %ld views, %ld differ from the oracle's, "
         "in windows %ld; %ld took the exact path",
         players[p].model, kernels[kernel], parallel ? ", in parallel" : "",
         f->pixels, f->views, f->differing, f->in_windows, f->exact);
    }
  ok(tap, exact > 0, "the gaussian took the exact path %ld times", exact);
  ok(tap, all.seen > all.pixels / 8, "%ld of %ld pixels are not empty",
     all.seen, all.pixels);
}

/* --- As bad as can be ----------------------------------------------------- */

/* A view of a solid grid, and what else is special about it. */
struct trial {
  const char *what;
  int n[3];
  double apart; /* samples */
  struct hsr_camera camera;
  int m, rows;
  const char *options;
  int opacity;
  bool empty; /* nothing is seen, by any module */
};

/* A camera whose up is y: eye, at, angle, near, height. */
#define SEEN(ex, ey, ez, ax, ay, az, fov, near, height)                        \
  { {ex, ey, ez}, {ax, ay, az}, {0, 1, 0}, fov, near, height }
/* So many samples along each axis. */
#define GRID(x, y, z)                                                          \
  { x, y, z }
static const struct trial trials[] = {
    {"all samples are kept", GRID(4, 4, 4), 1,
     SEEN(-3, 5, 9, 1.5, 1.5, 1.5, 50, 0, 0), 32, 24, "", 40000, false},
    {"one sample", GRID(1, 1, 1), 1, SEEN(3, 1, 2, 0, 0, 0, 60, 0, 0), 32, 24,
     "", 65535, false},
    {"one sample, in parallel", GRID(1, 1, 1), 1,
     SEEN(0, 0, 2, 0, 0, 0, 0, 0, 6), 32, 24, "", 65535, false},
    {"the eye is at a sample's place", GRID(3, 3, 3), 1,
     SEEN(1, 1, 1, 1, 1, 2, 90, 0, 0), 32, 16, "", 30000, false},
    {"the eye is at the place of the only sample", GRID(1, 1, 1), 1,
     SEEN(0, 0, 0, 1, 2, 3, 90, 0, 0), 32, 16, "", 65535, true},
    {"the same, in parallel", GRID(1, 1, 1), 1, SEEN(0, 0, 0, 0, 0, 1, 0, 0, 4),
     32, 16, "", 65535, true},
    {"the eye is in a voxel", GRID(3, 3, 3), 1,
     SEEN(1.25, 0.875, 1.125, 0, 0, 0, 120, 0, 0), 32, 16, "", 30000, false},
    {"the eye is a hair from a sample", GRID(3, 3, 3), 1,
     SEEN(1, 1, 1 - 0x1p-40, 1, 1, 2, 90, 0, 0), 12, 6, "", 30000, false},
    {"samples lie on the near plane", GRID(3, 3, 3), 1,
     SEEN(1, 1, -3, 1, 1, 0, 90, 4, 0), 32, 16, "", 30000, false},
    {"all lies before the near plane", GRID(3, 3, 3), 1,
     SEEN(1, 1, -3, 1, 1, 0, 90, 5, 0), 32, 16, "", 30000, true},
    {"a picture of 1 x 1", GRID(3, 3, 3), 1, SEEN(4, 5, 6, 1, 1, 1, 30, 0, 0),
     1, 1, "", 30000, false},
    {"1 x 1, in parallel", GRID(3, 3, 3), 1, SEEN(4, 1, 1, 0, 1, 1, 0, 0, 1), 1,
     1, "", 30000, false},
    {"a kernel wider than the picture", GRID(3, 3, 3), 1,
     SEEN(2, 3, 8, 1, 1, 1, 40, 0, 0), 32, 16, ":width=100", 65535, false},
    {"the same, in parallel", GRID(3, 3, 3), 1, SEEN(1, 1, 8, 1, 1, 0, 0, 0, 4),
     32, 16, ":width=100", 65535, false},
    {"a plane edge on", GRID(7, 1, 7), 1, SEEN(3, 0, -2, 3, 0, 0, 90, 0, 0), 32,
     16, "", 20000, false},
    {"a plane edge on, the eye among its samples", GRID(7, 1, 7), 1,
     SEEN(3.5, 0, 2.5, 4.5, 0, 3.5, 90, 0, 0), 32, 16, "", 20000, false},
    {"a plane edge on, in parallel", GRID(7, 1, 7), 1,
     SEEN(3, 0, -2, 3, 0, 0, 0, 0, 8), 12, 6, "", 20000, false},
    {"samples 2^-300 apart", GRID(3, 3, 3), 0x1p-300,
     SEEN(0x1p-299, 0x1p-299, -0x1p-298, 0x1p-300, 0x1p-300, 0, 60, 0, 0), 32,
     16, "", 30000, false},
    {"samples 2^-300 apart, in parallel", GRID(3, 3, 3), 0x1p-300,
     SEEN(0, 0, -0x1p-298, 0, 0, 0, 0, 0, 0x1p-298), 12, 6, "", 30000, false},
    {"samples 2^-300 apart, from afar", GRID(3, 3, 3), 0x1p-300,
     SEEN(0, 0, -4, 0, 0, 0, 90, 0, 0), 12, 6, "", 65535, true},
    {"samples 2^90 apart", GRID(3, 3, 3), 0x1p90,
     SEEN(0x1p91, 0x1p91, -0x1p92, 0x1p90, 0x1p90, 0, 60, 0, 0), 32, 16, "",
     30000, false},
    {"samples 2^90 apart, in parallel", GRID(3, 3, 3), 0x1p90,
     SEEN(0, 0, -0x1p92, 0, 0, 0, 0, 0, 0x1p92), 12, 6, "", 30000, false},
    {"samples 2^90 apart, 1 from the eye", GRID(3, 3, 3), 0x1p90,
     SEEN(0, 0, -1, 0, 0, 0, 90, 0, 0), 12, 6, "", 30000, false},
    {"opacity 0 everywhere", GRID(3, 3, 3), 1, SEEN(4, 5, 6, 1, 1, 1, 30, 0, 0),
     32, 16, "", 0, true},
    {"an angle of nearly 180 degrees", GRID(3, 3, 3), 1,
     SEEN(1.5, 1, -1, 1, 1, 1, 179.9, 0, 0), 32, 16, "", 30000, false},
    {"an angle of almost 0 degrees", GRID(3, 3, 3), 1,
     SEEN(1, 1, -1e6, 1, 1, 1, 0.0001, 0, 0), 12, 6, "", 30000, false},
    {"a millionth of a voxel fills the picture", GRID(3, 3, 3), 1,
     SEEN(1, 1, -4, 1, 1, 1, 0, 0, 1e-6), 8, 3, "", 30000, false},
    {"far from the origin of a row", GRID(18, 1, 1), 1,
     SEEN(-1e9, 0.25, 0.5, 0, 0, 0, 0, 0, 8), 32, 16, "", 30000, false}};
enum { TRIALS = sizeof trials / sizeof *trials };

static void open_solid(struct volume *v, const int n[3], double apart,
                       int opacity) {
  *v = (struct volume){.palette = plain_palette(opacity, 50000)};
  struct field field = {.keep = {.least = 1, .most = INFINITY},
                        .palette = &v->palette};
  for (int a = 0; a < 3; a++) {
    field.n[a] = (uint32_t)n[a];
    field.at[a] = v->at[a];
    for (int k = 0; k < n[a]; k++)
      v->at[a][k] = k * apart;
  }
  open_stage(&v->stage, &field);
}

/* By all modules and kernels, with and without anti-aliasing. */
static struct found try_all(const struct stage *s, const struct hsr_view *view,
                            const char *options) {
  struct found all = {0};
  for (int k = 0; k < 4 * PLAYERS; k++) {
    const struct player *p = &players[k / 4];
    struct hsr_variant made =
        splat_variant("%s:model=%s:kernel=%s:antialias=%s%s", p->name, p->model,
                      kernels[k & 1], k & 2 ? "on" : "off", options);
    struct found f = compare(s, view, &made);
    add_found(&all, &f);
  }
  return all;
}

static void say(struct tap *tap, const char *what, const struct found *f,
                bool empty) {
  ok(tap, !f->differing && !f->in_windows && empty == (f->seen == 0),
     "%s: in %ld pictures %ld pixels are seen, %ld differ, in windows %ld; %ld "
     "took the exact path",
     what, f->views, f->seen, f->differing, f->in_windows, f->exact);
}

static void try_trial(struct tap *tap, const struct trial *t) {
  static struct volume v;
  open_solid(&v, t->n, t->apart, t->opacity);
  struct hsr_view view = splat_view(&t->camera, t->m, t->rows);
  struct found f = try_all(&v.stage, &view, t->options);
  say(tap, t->what, &f, t->empty);
  close_stage(&v.stage);
}

static const struct hsr_camera from_aside = {
    {-3, 5, 9}, {1.5, 1.5, 1.5}, {0, 1, 0}, 50, 0, 0};

/* Densities that are no numbers, or infinite. */
static void try_no_numbers(struct tap *tap) {
  static struct volume v;
  static const float densities[4] = {NAN, 1, -INFINITY, INFINITY};
  v = (struct volume){.palette = plain_palette(30000, 50000)};
  for (int a = 0; a < 3; a++) {
    v.n[a] = 4;
    for (int k = 0; k < 4; k++)
      v.at[a][k] = k;
  }
  for (int c = 0; c < 64; c++)
    v.density[c] = densities[c % 4];
  open_volume(&v);
  ok(tap, v.stage.scene->grid->n_cells == 32,
     "of 64 samples with densities NaN, 1, -inf, inf, %u are kept",
     v.stage.scene->grid->n_cells);
  struct hsr_view view = splat_view(&from_aside, 32, 24);
  struct found f = try_all(&v.stage, &view, "");
  say(tap, "densities that are no numbers", &f, false);
  close_stage(&v.stage);
}

/* --- Many splats ---------------------------------------------------------- */

/* n^3 opaque samples. */
static void open_cube(struct stage *stage, int n) {
  double at[64];
  struct hsr_palette palette = plain_palette(UINT16_MAX, 50000);
  struct field field = {.keep = {.least = 1, .most = INFINITY},
                        .palette = &palette};
  for (int k = 0; k < n; k++)
    at[k] = k;
  for (int a = 0; a < 3; a++) {
    field.n[a] = (uint32_t)n;
    field.at[a] = at;
  }
  open_stage(stage, &field);
}

/* Its middle, as seen from a corner. */
static struct hsr_view corner_view(int n, double fov, int m, int rows) {
  const struct hsr_camera camera = {{-n / 2.0, 1.5 * n, -n / 2.0},
                                    {n / 2.0, n / 2.0, n / 2.0},
                                    {0, 1, 0},
                                    fov,
                                    0,
                                    0};
  return splat_view(&camera, m, rows);
}

static void try_many(struct tap *tap, const char *what, const char *variant,
                     int n, int m, int rows) {
  struct stage stage;
  open_cube(&stage, n);
  struct hsr_view view = corner_view(n, 60, m, rows);
  struct hsr_variant made = splat_variant("%s", variant);
  struct found f = compare(&stage, &view, &made);
  say(tap, what, &f, false);
  close_stage(&stage);
}

static uint64_t updates_of(const struct stage *s, const struct hsr_view *view,
                           const char *model) {
  static uint16_t rgba[4 * MOST_PIXELS];
  struct hsr_tally tally = {.out_of_memory = false};
  struct hsr_variant made = splat_variant("splat:model=%s", model);
  draw_splats(s, view, &made, COUNTING, NULL, 0, rgba, &tally);
  return count_of(&made, &tally, "updates");
}

/* From front to back, splats are left out where pixels are full. */
static void try_full(struct tap *tap) {
  static const char *const given[] = {"normalise=off", "normalise=on",
                                      "opacity=length"};
  struct stage stage;
  open_cube(&stage, 30);
  struct hsr_view view = corner_view(30, 20, 40, 24);
  for (int k = 0; k < 3; k++) {
    struct hsr_variant made = splat_variant("splat:model=under:%s", given[k]);
    struct found f = compare(&stage, &view, &made);
    say(tap, given[k], &f, false);
  }
  uint64_t over = updates_of(&stage, &view, "over"),
           under = updates_of(&stage, &view, "under");
  ok(tap, under < over, "full pixels: under updates %llu, over updates %llu",
     (unsigned long long)under, (unsigned long long)over);
  close_stage(&stage);
}

/* One splat beside the view's axis, whose rim is near the eye on one side, and so
 * far out on the screen. Each column of pixels is a window, so the splat is left
 * out of those that its box misses. */
static void try_columns(struct tap *tap, double aside, const char *kernel) {
  enum { M = 48, ROWS = 24 };
  static const int one[3] = {1, 1, 1};
  static uint16_t right[4 * M * ROWS], got[4 * M * ROWS];
  static struct volume v;
  const struct hsr_camera camera = {
      {aside, 0, -2.1}, {aside, 0, 0}, {0, 1, 0}, 120, 0, 0};
  struct hsr_view view = splat_view(&camera, M, ROWS);
  struct hsr_variant made = splat_variant("splat:kernel=%s", kernel);
  struct hsr_window columns[M];
  struct found f = {.views = 1};
  open_solid(&v, one, 1, 60000);
  judge_splats(&v.stage, &view, &made, right, NULL);
  for (long p = 0; p < (long)M * ROWS; p++)
    f.seen += right[4 * p + 3] > 0;
  for (int x = 0; x < M; x++)
    columns[x] = (struct hsr_window){x, 0, x + 1, ROWS};
  draw_splats(&v.stage, &view, &made, PLAIN, columns, M, got, NULL);
  f.in_windows = differences(&view, &made, got, right);
  say(tap, aside < 0 ? "columns of one side" : "columns of the other side", &f,
      false);
  close_stage(&v.stage);
}

/* Rows that are longer than the pieces in which they are tested, from their high
 * ends. */
static void try_pieces(struct tap *tap) {
  enum { N = 36 };
  const struct hsr_camera camera = {{1.5 * N, 1.5 * N, 1.5 * N},
                                    {N / 2.0, N / 2.0, N / 2.0},
                                    {0, 1, 0},
                                    60,
                                    0,
                                    0};
  struct stage stage;
  open_cube(&stage, N);
  struct hsr_view view = splat_view(&camera, 8, 6);
  struct hsr_variant made = splat_variant("splat:model=under");
  struct found f = compare(&stage, &view, &made);
  say(tap, "pieces of rows from the high end", &f, false);
  close_stage(&stage);
}

int main(int argc, char **argv) {
  int views = argc > 2 ? atoi(argv[2]) : 500;
  state = argc > 1 ? (uint64_t)atoll(argv[1]) : 11;
  struct tap tap = plan(2 * (2 * PLAYERS + 2) + TRIALS + 2 + 11);
  for (int parallel = 0; parallel < 2; parallel++)
    try_random(&tap, parallel, views);
  for (int k = 0; k < TRIALS; k++)
    try_trial(&tap, &trials[k]);
  try_no_numbers(&tap);
  /* under looks for full pixels after 16384 splats; xray moves its sums after
   * 65536; a volumetric buffer of over 2^25 bytes is divided into strips. */
  try_full(&tap);
  for (int k = 0; k < 2; k++) {
    try_columns(&tap, -2, kernels[k]);
    try_columns(&tap, 2, kernels[k]);
  }
  try_pieces(&tap);
  try_many(&tap, "over 65536 splats",
           "splat-xray:model=xray:antialias=on:exposure=0.01", 41, 12, 8);
  try_many(&tap, "a volumetric buffer in strips",
           "splat-volume:model=volume:buckets=1024:attenuate=0.3", 6, 200, 60);
  return finish(&tap);
}
