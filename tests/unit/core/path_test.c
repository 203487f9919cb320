/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Views on the way from the view before: beside cameras that are placed there by
 * their own formulas; and beside one another. */
#include "common/view/path.h"
#include "tests/tap.h"

#include <math.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

enum { M = 40, N = 30 };

/* --- Views ---------------------------------------------------------------- */

static struct hsr_view look(const struct hsr_camera *camera) {
  struct hsr_view view;
  struct hsr_error err;
  if (hsr_view_init(&view, camera, M, N, &err))
    bail("a camera: %s", err.text);
  return view;
}

static struct hsr_view follow(const struct hsr_camera *from,
                              const struct hsr_camera *to) {
  struct hsr_view view = look(to), before = look(from);
  hsr_view_follow(&view, &before);
  return view;
}

static struct hsr_view between(const struct hsr_view *view, int part,
                               int parts) {
  struct hsr_view at;
  struct hsr_error err;
  if (hsr_view_between(view, part, parts, &at, &err))
    bail("a view between: %s", err.text);
  return at;
}

/* The greatest difference of two vectors' coordinates. */
static double apart(const double a[3], const double b[3]) {
  return fmax(fabs(a[0] - b[0]), fmax(fabs(a[1] - b[1]), fabs(a[2] - b[2])));
}

/* The same of two views: of E, F, R, U, near. */
static double far(const struct hsr_view *a, const struct hsr_view *b) {
  double worst = fmax(apart(a->E, b->E), apart(a->F, b->F));
  worst = fmax(worst, fmax(apart(a->R, b->R), apart(a->U, b->U)));
  return fmax(worst, fabs(a->near - b->near));
}

/* --- A circle ------------------------------------------------------------- */

/* An eye that goes around (5, 2, -3), at 30 from it and 12 above. */
static struct hsr_camera around(double degrees, double parallel) {
  double a = degrees * PI / 180;
  return (struct hsr_camera){.eye = {5 + 30 * sin(a), 14, -3 + 30 * cos(a)},
                             .at = {5, 2, -3},
                             .up = {0, 1, 0},
                             .fov = 50,
                             .near = 1,
                             .parallel = parallel};
}

static void try_circle(struct tap *tap, double degrees, double parallel) {
  enum { PARTS = 8 };
  struct hsr_camera from = around(17, parallel),
                    to = around(17 + degrees, parallel);
  struct hsr_view view = follow(&from, &to);
  double worst = 0, chord = 0;
  for (int k = 0; k <= PARTS; k++) {
    struct hsr_camera there = around(17 + degrees * k / PARTS, parallel);
    struct hsr_view wanted = look(&there), got = between(&view, k, PARTS);
    worst = fmax(worst, far(&got, &wanted));
    for (int a = 0; a < 3; a++)
      chord =
          fmax(chord, fabs(from.eye[a] + (to.eye[a] - from.eye[a]) * k / PARTS -
                           there.eye[a]));
  }
  ok(tap, worst < 1e-12 && chord > 10 * worst,
     "around a point by %g degrees%s: off by %.1g; the chord by %.1g", degrees,
     parallel > 0 ? ", in parallel" : "", worst, chord);
}

/* The eye stays, and looks around. */
static void try_spot(struct tap *tap) {
  struct hsr_camera from = around(0, 0), to = from;
  memcpy(from.at, (double[]){5, 14, -13}, sizeof from.at);
  memcpy(to.at, (double[]){5 + 20, 14, -3 + 30}, sizeof to.at);
  struct hsr_view view = follow(&from, &to);
  double moved = 0, turned = 0, angle = PI / 2;
  for (int k = 0; k <= 6; k++) {
    struct hsr_view got = between(&view, k, 6);
    moved = fmax(moved, apart(got.E, from.eye));
    double a = k * angle / 6, F[3] = {sin(a), 0, -cos(a)};
    turned = fmax(turned, apart(got.F, F));
  }
  ok(tap, moved == 0 && turned < 1e-15,
     "on the spot by 90 degrees: the eye moved by %g, F is off by %.1g", moved,
     turned);
}

/* --- A straight way ------------------------------------------------------- */

static void try_straight(struct tap *tap) {
  struct hsr_camera from = around(33, 0), to = from;
  static const double shift[3] = {0.5, -3, 20};
  for (int a = 0; a < 3; a++) {
    to.eye[a] += shift[a];
    to.at[a] += shift[a];
  }
  struct hsr_view view = follow(&from, &to), before = look(&from);
  double worst = 0, turned = 0;
  for (int k = 0; k <= 7; k++) {
    struct hsr_view got = between(&view, k, 7);
    double E[3];
    for (int a = 0; a < 3; a++)
      E[a] = from.eye[a] + shift[a] * k / 7;
    worst = fmax(worst, apart(got.E, E));
    turned = fmax(turned, apart(got.F, before.F));
  }
  ok(tap, worst < 2e-14 && turned < 1e-15,
     "straight: the eye is off by %.1g, F by %.1g", worst, turned);
}

/* A larger angle of view, and a larger picture in parallel. */
static void try_zoom(struct tap *tap, double parallel) {
  struct hsr_camera from = around(33, parallel), to = from;
  to.fov = 90;
  to.parallel *= 3;
  to.near = 4;
  struct hsr_view view = follow(&from, &to), before = look(&from),
                  got = between(&view, 1, 4);
  double worst = fabs(got.near - 1.75);
  for (int a = 0; a < 3; a++) {
    worst = fmax(worst, fabs(got.R[a] - (3 * before.R[a] + view.R[a]) / 4));
    worst = fmax(worst, fabs(got.U[a] - (3 * before.U[a] + view.U[a]) / 4));
  }
  ok(tap,
     worst<1e-13, "a zoom%s is even: off by %.1g", parallel> 0 ? " in parallel"
                                                               : "",
     worst);
}

/* --- Any way -------------------------------------------------------------- */

/* Numbers that repeat, from -1 to 1. */
static double random_number(void) {
  static uint64_t state = 20;
  state = state * 6364136223846793005u + 1442695040888963407u;
  return (double)(state >> 11) * 0x1p-52 - 1;
}

static struct hsr_camera random_camera(void) {
  struct hsr_camera camera = {.fov = 60 + 50 * random_number(), .near = 1};
  for (int a = 0; a < 3; a++) {
    camera.eye[a] = 20 * random_number();
    camera.at[a] = 20 * random_number();
    camera.up[a] = random_number();
  }
  return camera;
}

/* Half of the way to the middle is a quarter of the way. */
static double halves_apart(const struct hsr_view *view) {
  struct hsr_view middle = between(view, 1, 2), start = between(view, 0, 2),
                  quarter = between(view, 1, 4);
  hsr_view_follow(&middle, &start);
  struct hsr_view half = between(&middle, 1, 2);
  return far(&half, &quarter);
}

/* A step takes each view to the next, wherever on the way: seen from a view, the
 * next one is always at the same place. */
static double steps_apart(const struct hsr_view *view) {
  double first[3] = {0}, worst = 0;
  for (int k = 0; k < 5; k++) {
    struct hsr_view a = between(view, k, 5), b = between(view, k + 1, 5);
    double shift[3], seen[3] = {0};
    for (int c = 0; c < 3; c++)
      shift[c] = b.E[c] - a.E[c];
    for (int c = 0; c < 3; c++) {
      seen[0] += shift[c] * a.F[c];
      seen[1] += shift[c] * a.U[c] / hypot(hypot(a.U[0], a.U[1]), a.U[2]);
      seen[2] += shift[c] * a.R[c] / hypot(hypot(a.R[0], a.R[1]), a.R[2]);
    }
    if (!k)
      memcpy(first, seen, sizeof first);
    worst = fmax(worst, apart(first, seen));
  }
  return worst;
}

/* Of F, R, U: how far they are from right angles. */
static double skew_of(const struct hsr_view *v) {
  double FR = 0, FU = 0, RU = 0, FF = 0;
  for (int a = 0; a < 3; a++) {
    FR += v->F[a] * v->R[a];
    FU += v->F[a] * v->U[a];
    RU += v->R[a] * v->U[a];
    FF += v->F[a] * v->F[a];
  }
  return fmax(fmax(fabs(FR), fabs(FU)), fmax(fabs(RU), fabs(FF - 1)));
}

/* The pixel of a point at (x, y) on the screen and at the depth 3. */
static double image_apart(const struct hsr_view *v) {
  double P[3], image[3];
  for (int a = 0; a < 3; a++)
    P[a] = v->E[a] + 3 * (v->F[a] + 0.5 * v->R[a] - 0.25 * v->U[a]);
  hsr_view_project(v, P, image);
  return fmax(fabs(image[0] / image[2] - 0.75 * M),
              fabs(image[1] / image[2] - 0.625 * N));
}

static double camera_apart(const struct hsr_view *v) {
  struct hsr_view again = look(&v->camera);
  return far(v, &again);
}

static void try_random(struct tap *tap) {
  double halves = 0, steps = 0, skew = 0, image = 0, camera = 0;
  for (int k = 0; k < 2000; k++) {
    struct hsr_camera from = random_camera(), to = random_camera();
    struct hsr_view view = follow(&from, &to), got = between(&view, 3, 7);
    halves = fmax(halves, halves_apart(&view));
    steps = fmax(steps, steps_apart(&view));
    skew = fmax(skew, skew_of(&got));
    image = fmax(image, image_apart(&got));
    camera = fmax(camera, camera_apart(&got));
  }
  ok(tap, halves < 1e-9, "half of a half is a quarter: off by %.1g", halves);
  ok(tap, steps < 1e-9, "all steps are alike: off by %.1g", steps);
  ok(tap, skew < 1e-12, "F, R and U are upright to %.1g", skew);
  ok(tap, image < 1e-9, "matrices fit: a point's pixel is off by %.1g", image);
  ok(tap, camera < 1e-9, "its camera gives the view, to %.1g", camera);
}

/* Two thousandths of a degree, where much could be lost. */
static void try_little(struct tap *tap) {
  struct hsr_camera from = around(0, 0), to = around(0.002, 0),
                    half = around(0.001, 0);
  struct hsr_view view = follow(&from, &to), wanted = look(&half),
                  got = between(&view, 1, 2);
  double worst = far(&got, &wanted);
  ok(tap, worst < 1e-13, "by .002 degrees: off by %.1g", worst);
}

/* --- The ends, and no way ------------------------------------------------- */

static bool is_same(const struct hsr_view *a, const struct hsr_view *b) {
  return far(a, b) == 0 && !memcmp(a->screen, b->screen, sizeof a->screen) &&
         !memcmp(a->ray, b->ray, sizeof a->ray);
}

static void try_ends(struct tap *tap) {
  struct hsr_camera from = random_camera(), to = random_camera();
  struct hsr_view view = follow(&from, &to), first = look(&from),
                  last = look(&to), start = between(&view, 0, 3),
                  end = between(&view, 3, 3);
  ok(tap, is_same(&start, &first) && is_same(&end, &last),
     "the ends are the two views, to the last bit");
  ok(tap, !start.before.exists && !end.before.exists,
     "a view on the way has none before it");
}

static void try_tile(struct tap *tap) {
  struct hsr_camera from = random_camera(), to = random_camera();
  const struct hsr_window tile = {7, 5, 30, 21}, window = {2, 3, 9, 8};
  struct hsr_view whole = follow(&from, &to), view, before = look(&from);
  struct hsr_error err;
  if (hsr_view_init_tile(&view, &to, M, N, &tile, &err))
    bail("a tile: %s", err.text);
  view.offset_x = 0.25;
  view.window = window;
  hsr_view_follow(&view, &before);
  struct hsr_view got = between(&view, 2, 5), wanted = between(&whole, 2, 5);
  ok(tap,
     far(&got, &wanted) == 0 && got.left == 7 && got.top == 5 &&
         got.offset_x == 0.25 && !memcmp(&got.window, &window, sizeof window),
     "a tile keeps its place, its offset and its window");
}

static void try_none(struct tap *tap) {
  struct hsr_camera eye = around(0, 0), flat = around(0, 20);
  struct hsr_view alone = look(&eye), mixed = follow(&flat, &eye),
                  both = follow(&eye, &eye);
  ok(tap,
     !hsr_view_has_path(&alone) && !hsr_view_has_path(&mixed) &&
         hsr_view_has_path(&both),
     "there is no way without a view before, nor from another projection");
}

int main(void) {
  static const double angles[] = {6, 20, 40, 90, 150, 179.5, -40};
  enum { ANGLES = sizeof angles / sizeof *angles };
  struct tap tap = plan(2 * ANGLES + 2 + 2 + 5 + 1 + 4);
  for (int k = 0; k < ANGLES; k++) {
    try_circle(&tap, angles[k], 0);
    try_circle(&tap, angles[k], 25);
  }
  try_spot(&tap);
  try_straight(&tap);
  try_zoom(&tap, 0);
  try_zoom(&tap, 25);
  try_random(&tap);
  try_little(&tap);
  try_ends(&tap);
  try_tile(&tap);
  try_none(&tap);
  return finish(&tap);
}
