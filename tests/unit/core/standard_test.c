/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Standard views, and pictures that the image of a scene fits. */
#ifndef _POSIX_C_SOURCE
#define _POSIX_C_SOURCE 200809L
#endif

#include "common/view/standard.h"
#include "common/view/view.h"
#include "scenes/scenes.h"
#include "tests/tap.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

/* A box 4 wide, 2 high and 6 deep, with a corner at 1 2 3, and a vertex far away
 * that no face uses. */
static const char box[] =
    "v 1 2 3\nv 5 2 3\nv 5 4 3\nv 1 4 3\nv 1 2 9\nv 5 2 9\nv 5 4 9\nv 1 4 9\n"
    "v 90 90 90\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

/* An open scene, and a view of it. */
struct sight {
  struct hsr_scene *scene;
  struct hsr_view view;
};

static struct sight see(const char *name, int m, int n) {
  struct sight sight;
  struct hsr_error err;
  if (hsr_scene_open(name, NULL, &sight.scene, &err) ||
      hsr_view_init(&sight.view, &sight.scene->views[0], m, n, &err))
    bail("%s: %s", name, err.text);
  return sight;
}

/* Where a point of the world is in the picture, in parallel projection. */
static void find(const struct sight *sight, double x, double y, double z,
                 double at[2]) {
  double image[3];
  hsr_view_project(&sight->view, (double[]){x, y, z}, image);
  at[0] = image[0];
  at[1] = image[1];
}

static bool near(double a, double b) {
  return fabs(a - b) < 1e-9;
}

/* Whether the box reaches from x0, y0 to x1, y1 in the picture. */
static bool spans(const struct sight *sight, double x0, double y0, double x1,
                  double y1) {
  double lo[2] = {INFINITY, INFINITY}, hi[2] = {-INFINITY, -INFINITY}, at[2];
  for (int c = 0; c < 8; c++) {
    find(sight, c & 1 ? 5 : 1, c & 2 ? 4 : 2, c & 4 ? 9 : 3, at);
    for (int k = 0; k < 2; k++) {
      lo[k] = fmin(lo[k], at[k]);
      hi[k] = fmax(hi[k], at[k]);
    }
  }
  return near(lo[0], x0) && near(lo[1], y0) && near(hi[0], x1) &&
         near(hi[1], y1);
}

/* Whether the point a is left of b, or above it. */
static bool is_before(const struct sight *sight, int axis, const double a[3],
                      const double b[3]) {
  double p[2], q[2];
  find(sight, a[0], a[1], a[2], p);
  find(sight, b[0], b[1], b[2], q);
  return p[axis] < q[axis] - 1 && near(p[1 - axis], q[1 - axis]);
}

static const double o[3] = {1, 2, 3}, x[3] = {5, 2, 3}, y[3] = {1, 4, 3},
                    z[3] = {1, 2, 9};

/* In a picture of 100 x 100, the longer side reaches from 2 to 98. */
static void check_sides(struct tap *tap) {
  static const struct {
    const char *name;
    double high; /* of the box in the picture, if it is 96 wide */
    const double *left, *right, *above, *below;
  } side[] = {{"front", 48, o, x, y, o}, {"back", 48, x, o, y, o},
              {"left", 32, o, z, y, o},  {"right", 32, z, o, y, o},
              {"top", 144, o, x, o, z},  {"bottom", 144, o, x, z, o}};
  for (size_t k = 0; k < sizeof side / sizeof *side; k++) {
    char name[60];
    snprintf(name, sizeof name, "box.obj@look=%s:parallel=fit", side[k].name);
    struct sight s = see(name, 100, 100);
    const double high = fmin(side[k].high, 96),
                 wide = side[k].high > 96 ? 96 * 96 / side[k].high : 96;
    ok(tap,
       spans(&s, 50 - wide / 2, 50 - high / 2, 50 + wide / 2, 50 + high / 2) &&
           is_before(&s, 0, side[k].left, side[k].right) &&
           is_before(&s, 1, side[k].above, side[k].below),
       "%s", side[k].name);
    hsr_scene_delete(s.scene);
  }
}

/* The image of an axis: its length, and its angle above the horizontal. */
static void measure(const struct sight *s, const double end[3], double *length,
                    double *degrees) {
  double p[2], q[2], size = 0;
  find(s, o[0], o[1], o[2], p);
  find(s, end[0], end[1], end[2], q);
  for (int k = 0; k < 3; k++)
    size += end[k] - o[k];
  *length = hypot(q[0] - p[0], q[1] - p[1]) / size;
  *degrees = atan2(p[1] - q[1], q[0] - p[0]) * 180 / acos(-1);
}

static void check_axonometric(struct tap *tap) {
  double lx, ly, lz, ax, ay, az;
  struct sight s = see("box.obj@look=iso", 100, 100);
  measure(&s, x, &lx, &ax);
  measure(&s, y, &ly, &ay);
  measure(&s, z, &lz, &az);
  ok(tap,
     near(lx, ly) && near(ly, lz) && near(ax, -30) && near(ay, 90) &&
         near(az, -150),
     "isometric: equal lengths at 30 degrees");
  hsr_scene_delete(s.scene);
  s = see("box.obj@look=dimetric", 100, 100);
  measure(&s, x, &lx, &ax);
  measure(&s, y, &ly, &ay);
  measure(&s, z, &lz, &az);
  ok(tap,
     near(lx, ly) && near(ly, 2 * lz) && fabs(ax + 7.18) < .01 &&
         near(ay, 90) && fabs(az + 180 - 41.41) < .01,
     "dimetric: depth is halved, at 7 and 42 degrees");
  hsr_scene_delete(s.scene);
}

static void check_up(struct tap *tap) {
  struct sight s = see("box.obj@look=front:up-axis=z:parallel=fit", 100, 100);
  ok(tap, is_before(&s, 0, o, x) && is_before(&s, 1, z, o),
     "z is up: the front is seen from -y");
  hsr_scene_delete(s.scene);
  s = see("box.obj@look=top:up-axis=z:parallel=fit", 100, 100);
  ok(tap, is_before(&s, 0, o, x) && is_before(&s, 1, y, o),
     "and the top has y upwards");
  hsr_scene_delete(s.scene);
  s = see("box.obj@look=front:up-axis=x:parallel=fit", 100, 100);
  ok(tap, is_before(&s, 0, y, o) && is_before(&s, 1, x, o), "x is up");
  hsr_scene_delete(s.scene);
}

static void check_fit(struct tap *tap) {
  struct sight s = see("box.obj@look=front:parallel=fit-3x1", 300, 100);
  ok(tap, spans(&s, 54, 2, 246, 98), "a wide picture: the height is tighter");
  hsr_scene_delete(s.scene);
  s = see("box.obj@look=front:parallel=fit-1x2", 100, 200);
  ok(tap, spans(&s, 2, 76, 98, 124), "a high one");
  hsr_scene_delete(s.scene);
  s = see("box.obj@eye=40,2,6:at=0,2,6:parallel=fit", 100, 100);
  ok(tap, spans(&s, 2, 34, 98, 66), "a given direction: the eye is moved");
  hsr_scene_delete(s.scene);
  s = see("box.obj@eye=3,3,6:at=3,3,0:parallel=fit", 100, 100);
  ok(tap, spans(&s, 2, 26, 98, 74), "an eye within: what is in front of it");
  hsr_scene_delete(s.scene);
  s = see("box.obj@look=front:parallel=10", 100, 100);
  ok(tap, spans(&s, 30, 40, 70, 60), "a height of its own");
  hsr_scene_delete(s.scene);
  s = see("grid:6:1@look=top:parallel=fit", 100, 100);
  ok(tap,
     s.scene->n_views == 1 && s.scene->views[0].parallel > 0 &&
         hsr_scene_lacks_faces(s.scene),
     "a grid, without its faces");
  hsr_scene_delete(s.scene);
}

/* The axes are seen alike to the last bit, wherever the scene is. */
static void check_exact(struct tap *tap) {
  static const char *const names[] = {
      "box.obj@look=iso", "box.obj@look=iso:parallel=fit-3x2", "house@look=iso",
      "sphere:200@look=iso:parallel=fit-16x9"};
  bool good = true;
  for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
    struct sight sight = see(names[k], 60, 40);
    const double *F = sight.view.F;
    good = good && F[0] == F[1] && F[1] == F[2];
    hsr_scene_delete(sight.scene);
  }
  ok(tap, good, "isometric views are exact");
}

static bool refuses(const char *name, const char *why) {
  struct hsr_scene *scene;
  struct hsr_error err = {.text = ""};
  const enum hsr_status status = hsr_scene_open(name, NULL, &scene, &err);
  if (status == HSR_E_USAGE && strstr(err.text, why))
    return true;
  printf("# %s: %s\n", name, err.text);
  return false;
}

static void check_refusals(struct tap *tap) {
  ok(tap,
     refuses("box.obj@look=above", "must be front, back") &&
         refuses("box.obj@parallel=fitting", "must be fit") &&
         refuses("box.obj@parallel=fit-", "must be fit") &&
         refuses("box.obj@parallel=fit-3x0", "must be fit") &&
         refuses("box.obj@parallel=fit-3x2x", "must be fit"),
     "words that are none");
  ok(tap,
     refuses("box.obj@eye=0,0,0:at=0,0,-1:parallel=fit", "in front of the eye"),
     "nothing to fit");
}

int main(void) {
  struct tap tap = plan(20);
  char folder[] = "/tmp/hsr-standard-XXXXXX";
  FILE *file = NULL;
  if (!mkdtemp(folder) || chdir(folder) || !(file = fopen("box.obj", "w")) ||
      fputs(box, file) < 0 || fclose(file))
    bail("%s: cannot be written", folder);
  check_sides(&tap);
  check_axonometric(&tap);
  check_exact(&tap);
  check_up(&tap);
  check_fit(&tap);
  check_refusals(&tap);
  if (remove("box.obj") || chdir("/") || rmdir(folder))
    bail("%s: cannot be removed", folder);
  return finish(&tap);
}
