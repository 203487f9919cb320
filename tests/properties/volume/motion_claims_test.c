/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far motion blur is from what a shutter sees that is open from one view to
 * the next: pictures of a cube and of terrain that turn, as numbers.
 *
 * Source      J. E. Swan II, "Object-Order Rendering of Discrete Objects", PhD
 *             thesis, Ohio State University, 1998, chapter 4: figures 4.5 and
 *             5.4 to 5.6, which have no numbers
 * Shutter     the integral over the time, by trapezoids between FRAMES views. The
 *             mean of all frames gives both ends a whole weight. So half of the
 *             ends is taken away from it again.
 * Measure     of each pixel its worst channel, in thousandths of the brightest of
 *             what the shutter sees: the mean of all pixels, what 99 % of them do
 *             not exceed, the greatest
 * Chord       frames whose splats are on straight lines on the screen. In parallel
 *             projection they are seen by a camera between the two whose screen
 *             coordinates are a mean of theirs.
 * Kernel      what a Gaussian splat gives to a pixel while it goes straight, at a
 *             constant speed, is a closed form: a difference of two error
 *             functions along the way, times a Gaussian across it. Sums of splats
 *             have no order, so their picture is the sum of these.
 *
 * usage: motion_claims_test [table]    table: prints that of reports/swan */
#include "common/view/path.h"
#include "tests/properties/volume/splatting.h"
#include "tests/tap.h"

#include <math.h>
#include <string.h>

enum { SIDE = 160, FRAMES = 257, CHANNELS = 4 };
enum { NUMBERS = CHANNELS * SIDE * SIDE };

static const double PI = 3.14159265358979323846;

/* --- Scenes --------------------------------------------------------------- */

/* What is looked at, and from where: `far` from a point, `up` above it. */
struct sight {
  const char *scene, *model; /* a module and its model */
  double at[3], far, up, height, fov;
};

static const struct sight sights[] = {
    {"checker-cube:60",
     "splat:model=over",
     {29.5, 29.5, 29.5},
     150,
     50,
     110,
     0},
    {"checker-cube:60",
     "splat-sheet:model=sheet",
     {29.5, 29.5, 29.5},
     150,
     50,
     110,
     0},
    {"checker-cube:60", "splat:model=over", {29.5, 29.5, 29.5}, 150, 50, 0, 40},
    {"checker-cube:60",
     "splat-xray:model=xray:kernel=gaussian:exposure=0.01",
     {29.5, 29.5, 29.5},
     150,
     50,
     110,
     0},
    {"heights:256", "splat:model=over", {128, 10, 128}, 200, 120, 200, 0}};
enum { SUMS = 3 }; /* of sums in parallel */
enum { SIGHTS = sizeof sights / sizeof *sights };

static const double angles[] = {6, 20, 40};
enum { ANGLES = sizeof angles / sizeof *angles };

/* Turned about the vertical axis through the point that is looked at. */
static struct hsr_view look(const struct sight *s, double degrees) {
  double a = degrees * PI / 180;
  struct hsr_camera camera = {.eye = {s->at[0] + s->far * sin(a),
                                      s->at[1] + s->up,
                                      s->at[2] + s->far * cos(a)},
                              .at = {s->at[0], s->at[1], s->at[2]},
                              .up = {0, 1, 0},
                              .fov = s->fov,
                              .parallel = s->height};
  return splat_view(&camera, SIDE, SIDE);
}

static struct hsr_view turned(const struct sight *s, double degrees) {
  struct hsr_view view = look(s, 30), before = look(s, 30 - degrees);
  hsr_view_follow(&view, &before);
  return view;
}

/* --- Pictures ------------------------------------------------------------- */

struct picture {
  double of[NUMBERS];
};

static void draw(const struct stage *stage, const struct hsr_view *view,
                 const char *model, const char *options, struct picture *p) {
  static uint16_t rgba[NUMBERS];
  struct hsr_variant made = splat_variant("%s%s", model, options);
  draw_splats(stage, view, &made, PLAIN, NULL, 0, rgba, NULL);
  for (int k = 0; k < NUMBERS; k++)
    p->of[k] = rgba[k];
}

/* What the mean of `frames` frames is without half of the two ends. */
static void without_ends(struct picture *mean, const struct picture end[2],
                         int frames) {
  for (int k = 0; k < NUMBERS; k++)
    mean->of[k] = (frames * mean->of[k] - (end[0].of[k] + end[1].of[k]) / 2) /
                  (frames - 1);
}

static void draw_ends(const struct stage *stage, const struct hsr_view *view,
                      const char *model, struct picture end[2]) {
  struct hsr_view first;
  if (hsr_view_between(view, 0, 1, &first, NULL))
    bail("no view between");
  draw(stage, &first, model, "", &end[0]);
  draw(stage, view, model, "", &end[1]);
}

static void see_shutter(const struct stage *stage, const struct hsr_view *view,
                        const char *model, int frames, struct picture *p) {
  static struct picture end[2];
  char options[64];
  snprintf(options, sizeof options, ":blur=accumulate:frames=%d", frames);
  draw(stage, view, model, options, p);
  draw_ends(stage, view, model, end);
  without_ends(p, end, frames);
}

/* --- The chord ------------------------------------------------------------ */

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double out[3]) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

/* In parallel projection: the vector whose product with P - at is a screen
 * coordinate. */
static void along(const double axis[3], double out[3]) {
  for (int k = 0; k < 3; k++)
    out[k] = axis[k] / dot(axis, axis);
}

static void unit(const double v[3], double out[3]) {
  for (int k = 0; k < 3; k++)
    out[k] = v[k] / sqrt(dot(v, v));
}

/* Both cameras look at one point, `at`. */
static struct hsr_view chord_between(const struct hsr_view *view,
                                     const double at[3], double share) {
  struct hsr_view v = *view;
  const struct hsr_view_before *b = &view->before;
  double from[2][3], to[2][3], mean[2][3], F[3], by[2][3], right[3], up[3];
  along(b->R, from[0]);
  along(b->U, from[1]);
  along(view->R, to[0]);
  along(view->U, to[1]);
  for (int c = 0; c < 2; c++)
    for (int k = 0; k < 3; k++)
      mean[c][k] = from[c][k] + share * (to[c][k] - from[c][k]);
  cross(mean[1], mean[0], F);
  unit(F, v.F);
  cross(v.F, mean[1], by[0]);
  cross(v.F, mean[0], by[1]);
  double per[2] = {dot(by[0], mean[0]), dot(by[1], mean[1])};
  for (int k = 0; k < 3; k++) {
    v.R[k] = by[0][k] / per[0];
    v.U[k] = by[1][k] / per[1];
    v.E[k] = at[k] - 200 * v.F[k];
  }
  v.before.exists = false;
  unit(v.R, right);
  unit(v.U, up);
  if (hsr_view_complete(&v, right, up, NULL))
    bail("no view on the chord");
  return v;
}

static void see_chord(const struct stage *stage, const struct hsr_view *view,
                      const struct sight *s, int frames, struct picture *p) {
  static struct picture one;
  memset(p, 0, sizeof *p);
  for (int f = 0; f < frames; f++) {
    struct hsr_view v = chord_between(view, s->at, (double)f / (frames - 1));
    double weight = (f == 0 || f == frames - 1 ? 0.5 : 1) / (frames - 1);
    draw(stage, &v, s->model, "", &one);
    for (int k = 0; k < NUMBERS; k++)
      p->of[k] += weight * one.of[k];
  }
}

/* --- Distances ------------------------------------------------------------ */

struct distance {
  double mean, most, worst; /* most: of 99 % */
};

static int by_size(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* Of a picture from the shutter's. */
static struct distance distance_of(const struct picture *a,
                                   const struct picture *b) {
  static double all[SIDE * SIDE];
  struct distance d = {0};
  double brightest = 0;
  for (int k = 0; k < NUMBERS; k++)
    brightest = fmax(brightest, b->of[k]);
  for (int p = 0; p < SIDE * SIDE; p++) {
    all[p] = 0;
    for (int c = 0; c < CHANNELS; c++)
      all[p] =
          fmax(all[p], fabs(a->of[CHANNELS * p + c] - b->of[CHANNELS * p + c]) /
                           (brightest / 1000));
    d.mean += all[p] / (SIDE * SIDE);
  }
  qsort(all, SIDE * SIDE, sizeof *all, by_size);
  d.most = all[SIDE * SIDE * 99 / 100];
  d.worst = all[SIDE * SIDE - 1];
  return d;
}

/* --- The exact kernel ----------------------------------------------------- */

/* The table of the Gaussian ends at 2 cells, with so much of its energy. */
static const double DEVIATION = 0.6, KEPT = 0.996592, EXPOSURE = 0.01;

/* By its distances along and across a way of this length, from its beginning; all
 * in cells. */
static double kernel_at(double along_way, double across, double length) {
  const double a = DEVIATION * sqrt(2);
  double side = exp(-across * across / (a * a)) / (a * sqrt(PI));
  if (length < 1e-6)
    return side * exp(-along_way * along_way / (a * a)) / (a * sqrt(PI));
  return side * (erf(along_way / a) - erf((along_way - length) / a)) /
         (2 * length);
}

/* A way on the screen, in pixels of which so many are a cell. */
struct way {
  double from[3], to[3], length, dx, dy, per_cell;
};

static struct way way_of(const struct hsr_view *first,
                         const struct hsr_view *last, const double P[3],
                         double per_cell) {
  struct way w = {.per_cell = per_cell, .dx = 1};
  hsr_view_project(first, P, w.from);
  hsr_view_project(last, P, w.to);
  double x = w.to[0] - w.from[0], y = w.to[1] - w.from[1];
  w.length = hypot(x, y);
  if (w.length > 0) {
    w.dx = x / w.length;
    w.dy = y / w.length;
  }
  return w;
}

/* Adds this share of what a splat gives that goes this way. */
static void add_splat(const struct way *w, double share, struct picture *p) {
  double reach = 5 * DEVIATION * w->per_cell;
  int x0 = (int)fmax(0, fmin(w->from[0], w->to[0]) - reach),
      x1 = (int)fmin(SIDE, fmax(w->from[0], w->to[0]) + reach),
      y0 = (int)fmax(0, fmin(w->from[1], w->to[1]) - reach),
      y1 = (int)fmin(SIDE, fmax(w->from[1], w->to[1]) + reach);
  for (int j = y0; j < y1; j++)
    for (int i = x0; i < x1; i++) {
      double x = (i + 0.5 - w->from[0]) / w->per_cell,
             y = (j + 0.5 - w->from[1]) / w->per_cell;
      p->of[CHANNELS * (j * SIDE + i) + 3] +=
          share * kernel_at(x * w->dx + y * w->dy, y * w->dx - x * w->dy,
                            w->length / w->per_cell);
    }
}

/* Adds this share of the splats of all samples. */
static void add_splats(const struct hsr_grid *g, const struct hsr_view *first,
                       const struct hsr_view *last, double per_cell,
                       double share, struct picture *p) {
  for (uint32_t row = 0; row < g->n[1] * g->n[2]; row++)
    for (uint32_t c = g->row[row]; c < g->row[row + 1]; c++) {
      const double P[3] = {g->at[0][g->x[c]], g->at[1][row % g->n[1]],
                           g->at[2][row / g->n[1]]};
      const struct way way = way_of(first, last, P, per_cell);
      add_splat(&way, share, p);
    }
}

/* The opacity of the picture, the way of each splat being made of so many chords.
 * All samples are opaque. */
static void see_kernel(const struct stage *stage, const struct hsr_view *view,
                       const struct sight *s, int chords, struct picture *p) {
  memset(p, 0, sizeof *p);
  for (int k = 0; k < chords; k++) {
    struct hsr_view first, last;
    if (hsr_view_between(view, k, chords, &first, NULL) ||
        hsr_view_between(view, k + 1, chords, &last, NULL))
      bail("no view between");
    add_splats(stage->scene->grid, &first, &last, SIDE / s->height,
               65535 * EXPOSURE * KEPT / chords, p);
  }
}

/* Makes all but the opacity 0. */
static void keep_opacity(struct picture *p) {
  for (int k = 0; k < NUMBERS; k++)
    if (k % CHANNELS != 3)
      p->of[k] = 0;
}

/* By capsules; by the kernel on 1, 2, 4 and 8 chords; and that without motion. */
enum { CHORDS = 4 };
struct summed {
  struct distance capsule, kernel[CHORDS], still;
};

/* `s`: sums in parallel. */
static struct summed measure_kernel(const struct sight *s, double degrees) {
  static struct picture shutter, p;
  struct stage stage;
  struct summed m;
  struct hsr_view view = turned(s, degrees), at_rest = turned(s, 0);
  open_named_stage(&stage, s->scene);
  see_shutter(&stage, &view, s->model, FRAMES, &shutter);
  keep_opacity(&shutter);
  draw(&stage, &view, s->model, ":blur=exact", &p);
  keep_opacity(&p);
  m.capsule = distance_of(&p, &shutter);
  for (int k = 0; k < CHORDS; k++) {
    see_kernel(&stage, &view, s, 1 << k, &p);
    m.kernel[k] = distance_of(&p, &shutter);
  }
  draw(&stage, &at_rest, s->model, "", &shutter);
  keep_opacity(&shutter);
  see_kernel(&stage, &at_rest, s, 1, &p);
  m.still = distance_of(&p, &shutter);
  close_stage(&stage);
  return m;
}

/* --- What is measured ----------------------------------------------------- */

enum { OFF, AREA, EXACT, FIVE, NINE, SEVENTEEN, THIRTY_THREE, HOWS };
static const char *const hows[] = {"",
                                   ":blur=area",
                                   ":blur=exact",
                                   ":blur=accumulate:frames=5",
                                   ":blur=accumulate:frames=9",
                                   ":blur=accumulate:frames=17",
                                   ":blur=accumulate:frames=33"};

struct measured {
  struct distance how[HOWS], chord, half; /* half: of half as many frames */
};

static struct measured measure(const struct sight *s, double degrees) {
  static struct picture shutter, p;
  struct stage stage;
  struct measured m = {.how = {{0}}};
  struct hsr_view view = turned(s, degrees);
  open_named_stage(&stage, s->scene);
  see_shutter(&stage, &view, s->model, FRAMES, &shutter);
  for (int k = 0; k < HOWS; k++) {
    draw(&stage, &view, s->model, hows[k], &p);
    m.how[k] = distance_of(&p, &shutter);
  }
  see_shutter(&stage, &view, s->model, FRAMES / 2 + 1, &p);
  m.half = distance_of(&p, &shutter);
  if (view.parallel) {
    see_chord(&stage, &view, s, FRAMES / 4 + 1, &p);
    m.chord = distance_of(&p, &shutter);
  }
  close_stage(&stage);
  return m;
}

/* Of what was measured at each angle, `size` bytes each, the distance at `at`. */
static void print_row(const char *name, const void *measured, size_t size,
                      size_t at) {
  printf("%-28s", name);
  for (int a = 0; a < ANGLES; a++) {
    const struct distance *d =
        (const struct distance *)((const char *)measured + (size_t)a * size +
                                  at);
    printf("  %6.1f %6.0f %6.0f", d->mean, d->most, d->worst);
  }
  printf("\n");
}

static void print_angles(void) {
  printf("%-28s", "");
  for (int a = 0; a < ANGLES; a++)
    printf("  %16.0f deg", angles[a]);
  printf("\n");
}

static void print_pictures(void) {
  for (int k = 0; k < SIGHTS; k++) {
    const struct sight *s = &sights[k];
    struct measured m[ANGLES];
    for (int a = 0; a < ANGLES; a++)
      m[a] = measure(s, angles[a]);
    printf("%s, %s%s\n", s->scene, s->model,
           s->height > 0 ? ", in parallel" : "");
    print_angles();
    for (int h = 0; h < HOWS; h++)
      print_row(*hows[h] ? hows[h] + 1 : "blur=off", m, sizeof *m,
                offsetof(struct measured, how[h]));
    if (s->height > 0)
      print_row("frames on the chord", m, sizeof *m,
                offsetof(struct measured, chord));
    print_row("half as many frames", m, sizeof *m,
              offsetof(struct measured, half));
  }
}

static void print_kernels(void) {
  struct summed m[ANGLES];
  for (int a = 0; a < ANGLES; a++)
    m[a] = measure_kernel(&sights[SUMS], angles[a]);
  printf("%s, opacity of sums, in parallel\n", sights[SUMS].scene);
  print_angles();
  print_row("blur=exact", m, sizeof *m, offsetof(struct summed, capsule));
  for (int k = 0; k < CHORDS; k++) {
    char name[32];
    snprintf(name, sizeof name, "exact kernel, chords: %d", 1 << k);
    print_row(name, m, sizeof *m, offsetof(struct summed, kernel[k]));
  }
  print_row("exact kernel, no motion", m, sizeof *m,
            offsetof(struct summed, still));
}

/* --- What is claimed ------------------------------------------------------ */

/* The means that were measured first. */
static const struct {
  double off, area, exact, five, chord;
} wanted[SIGHTS][ANGLES] = {{{56.7, 30.8, 20.1, 5.8, 1.5},
                             {147.4, 68.0, 40.7, 19.5, 13.0},
                             {176.6, 91.9, 54.4, 30.9, 34.4}},
                            {{68.8, 70.7, 18.6, 6.8, 1.6},
                             {175.2, 127.9, 39.1, 23.9, 14.2},
                             {203.0, 165.8, 52.5, 35.3, 36.3}},
                            {{58.2, 34.5, 23.7, 6.3, 0},
                             {135.3, 63.1, 41.3, 18.7, 0},
                             {151.4, 83.9, 51.5, 29.7, 0}},
                            {{36.0, 135.1, 7.0, 2.9, 0.9},
                             {78.3, 193.1, 11.8, 11.0, 7.8},
                             {62.4, 130.1, 25.3, 13.9, 24.6}},
                            {{83.8, 79.8, 24.8, 17.7, 3.2},
                             {121.3, 105.2, 37.7, 30.3, 20.7},
                             {146.8, 118.8, 54.2, 38.7, 46.9}}};

static bool is_near(double got, double should_be) {
  return fabs(got - should_be) < 0.1 + 0.01 * should_be;
}

/* Twice as many frames are about half as far away. */
static bool halves(const struct measured *m) {
  for (int k = FIVE; k < THIRTY_THREE; k++) {
    double ratio = m->how[k].mean / m->how[k + 1].mean;
    if (!(ratio > 1.5 && ratio < 3.2))
      return false;
  }
  return true;
}

static void try_sight(struct tap *tap, int sight, int angle) {
  const struct sight *s = &sights[sight];
  const struct measured m = measure(s, angles[angle]);
  ok(tap,
     m.half.mean < 0.2 && m.half.worst<5,
                                       "%s, %s%s, %g degrees: half as many "
                                       "frames change the shutter's picture by "
                                       "%.2f, %.1f at most",
                                       s->scene, s->model, s->height> 0
         ? ", in parallel"
         : "",
     angles[angle], m.half.mean, m.half.worst);
  ok(tap, halves(&m), "%.1f, %.1f, %.1f, %.1f by 5, 9, 17, 33 frames",
     m.how[FIVE].mean, m.how[NINE].mean, m.how[SEVENTEEN].mean,
     m.how[THIRTY_THREE].mean);
  ok(tap,
     is_near(m.how[OFF].mean, wanted[sight][angle].off) &&
         is_near(m.how[AREA].mean, wanted[sight][angle].area) &&
         is_near(m.how[EXACT].mean, wanted[sight][angle].exact) &&
         is_near(m.how[FIVE].mean, wanted[sight][angle].five) &&
         is_near(m.chord.mean, wanted[sight][angle].chord),
     "%.1f sharp, %.1f by area, %.1f exactly, %.1f on the chord",
     m.how[OFF].mean, m.how[AREA].mean, m.how[EXACT].mean, m.chord.mean);
}

/* The kernel errs by its table at rest, and on the way by its chords: a quarter as
 * much with twice as many of them. */
static void try_kernel(struct tap *tap, int angle) {
  static const double on_one[ANGLES] = {0.93, 7.02, 26.97};
  const struct summed m = measure_kernel(&sights[SUMS], angles[angle]);
  ok(tap, is_near(m.kernel[0].mean, on_one[angle]) && m.still.mean < 0.4,
     "sums, %g degrees: %.2f by the exact kernel on a chord, %.2f by capsules; "
     "%.2f at rest",
     angles[angle], m.kernel[0].mean, m.capsule.mean, m.still.mean);
  ok(tap,
     m.kernel[3].mean < 1.2 && m.kernel[3].mean < m.capsule.mean / 2 &&
         m.kernel[3].worst < 20,
     "on 2, 4 and 8 chords %.2f, %.2f, %.2f", m.kernel[1].mean,
     m.kernel[2].mean, m.kernel[3].mean);
}

/* Cameras that are placed around the cube differ from those on the way in the last
 * bits, and so may a floor here and there. */
static void try_cameras(struct tap *tap, double degrees) {
  enum { CAMERAS = 5 };
  static struct picture got, mean, one;
  const struct sight *s = &sights[0];
  struct stage stage;
  struct hsr_view view = turned(s, degrees);
  long differing = 0;
  open_named_stage(&stage, s->scene);
  draw(&stage, &view, s->model, hows[FIVE], &got);
  memset(&mean, 0, sizeof mean);
  for (int f = 0; f < CAMERAS; f++) {
    struct hsr_view v = look(s, 30 - degrees + degrees * f / (CAMERAS - 1));
    draw(&stage, &v, s->model, "", &one);
    for (int k = 0; k < NUMBERS; k++)
      mean.of[k] += one.of[k];
  }
  for (int k = 0; k < NUMBERS; k++)
    differing += got.of[k] != floor(mean.of[k] / CAMERAS);
  ok(tap, differing < NUMBERS / 10000,
     "%g degrees: %ld of %d channels are not the mean of five cameras'",
     degrees, differing, NUMBERS);
  close_stage(&stage);
}

static void try_oracle(struct tap *tap, const char *model, double height) {
  enum { M = 24 };
  static uint16_t got[CHANNELS * M * M], right[CHANNELS * M * M];
  struct sight s = {"checker-cube:8", model, {3.5, 3.5, 3.5}, 20, 7,
                    height,           40};
  struct stage stage;
  struct hsr_view view = turned(&s, 40);
  struct hsr_view small = splat_view(&view.camera, M, M),
                  first = look(&s, 30 - 40),
                  before = splat_view(&first.camera, M, M);
  struct hsr_variant made =
      splat_variant("%s:blur=accumulate:frames=64", s.model);
  hsr_view_follow(&small, &before);
  open_named_stage(&stage, s.scene);
  draw_splats(&stage, &small, &made, PLAIN, NULL, 0, got, NULL);
  judge_splats(&stage, &small, &made, right, NULL);
  long seen = 0;
  for (int k = 0; k < CHANNELS * M * M; k++)
    seen += right[k] > 0;
  ok(tap, !memcmp(got, right, sizeof got) && seen > CHANNELS * M * M / 4,
     "%s%s: 64 frames are the oracle's, of whose %d channels %ld are not 0",
     model, height > 0 ? ", in parallel" : "", CHANNELS * M * M, seen);
  close_stage(&stage);
}

int main(int argc, char **argv) {
  if (argc > 1 && !strcmp(argv[1], "table")) {
    print_pictures();
    print_kernels();
    return 0;
  }
  struct tap tap = plan(3 * SIGHTS * ANGLES + 3 * ANGLES + 4);
  for (int s = 0; s < SIGHTS; s++)
    for (int a = 0; a < ANGLES; a++)
      try_sight(&tap, s, a);
  for (int a = 0; a < ANGLES; a++) {
    try_kernel(&tap, a);
    try_cameras(&tap, angles[a]);
  }
  try_oracle(&tap, "splat:model=over", 12);
  try_oracle(&tap, "splat:model=over", 0);
  try_oracle(&tap, "splat-sheet:model=sheet", 12);
  try_oracle(&tap, "splat-xray:model=xray:exposure=0.2", 0);
  return finish(&tap);
}
