/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes made for error-bounded, in strict order and by cubes, against the area
 * oracle.
 *
 * Medians     Two walls, cut where the median planes of the octree meet. In the
 *             window the nearer piece of the farther wall and the farther piece
 *             of the nearer wall leave a gap between them, which a third piece
 *             fills that comes after both.
 * Bent        A quadrilateral that is far from flat, on whose plane the eye
 *             nearly lies. It is seen on that plane, much nearer than its
 *             corners, before a wall that is nearer than these.
 * Near        In parallel, a triangle whose plane all but runs along F, so that
 *             `near` cuts it at a place that doubles do not tell. */
#include "bench/modules/variant.h"
#include "tests/draw.h"
#include "tests/tap.h"
#include "common/answers/filter.h"
#include "common/answers/kinds/area.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void draw(const char *name, const struct hsr_world *world,
                 const struct hsr_view *view, struct hsr_answer *answer) {
  struct hsr_variant variant;
  struct hsr_error err;
  if (hsr_variant_parse(name, &variant, &err))
    bail("%s: %s", name, err.text);
  if (draw_chosen(variant.listed->plain, &variant.choice, world, view, answer,
                  NULL))
    return;
  bail("%s refuses the scene", name);
}

/* How many intervals do not hold the value or are too wide, and how many values
 * are not those of the background. */
struct found {
  long outside, wide, seen;
};

static void compare(const struct hsr_view *view, const struct hsr_answer *got,
                    const struct hsr_answer *wanted,
                    const uint16_t background[3], struct found *found) {
  const struct hsr_area_bounds *w = hsr_answer_areas_of(wanted),
                               *g = hsr_answer_areas_of(got);
  for (int j = view->window.y0; j < view->window.y1; j++)
    for (int i = view->window.x0; i < view->window.x1; i++)
      for (int c = 0; c < 3; c++) {
        size_t k = 3 * ((size_t)j * (size_t)view->m + (size_t)i) + (size_t)c;
        found->outside += !(g[k].lo <= w[k].lo && g[k].hi >= w[k].hi);
        found->wide += !(g[k].hi - g[k].lo <= hsr_form_area(&got->form).eps);
        found->seen += fabs(w[k].lo - background[c] / 65535.0) > 0.001;
      }
}

static void look(const struct hsr_world *world, const struct hsr_view *view,
                 struct found *found) {
  static const char *const variants[] = {
      "error-bounded:order=strict:eps=.03125", "error-bounded:eps=.03125"};
  struct hsr_answer wanted, got;
  uint16_t background[3];
  draw("area-oracle", world, view, &wanted);
  hsr_filter_colour(world, view, HSR_BACKGROUND, background);
  for (int v = 0; v < 2; v++) {
    draw(variants[v], world, view, &got);
    compare(view, &got, &wanted, background, found);
    hsr_answer_free(&got);
  }
  hsr_answer_free(&wanted);
}

static void add_face(struct hsr_scene *scene, const double corner[][3],
                     uint32_t n, const float rgb[3]) {
  struct hsr_object *object = hsr_scene_object(scene, "part");
  uint32_t v[4];
  for (uint32_t k = 0; k < n; k++)
    if (hsr_object_vertex(object, corner[k][0], corner[k][1], corner[k][2],
                          &v[k]))
      exit(99);
  if (hsr_object_face(object, v, n, rgb))
    exit(99);
}

static void tell(struct tap *tap, const struct found *found, const char *of) {
  ok(tap, !found->outside && !found->wide && found->seen,
     "%s: %ld intervals do not hold the value, %ld are too wide, %ld show a "
     "face",
     of, found->outside, found->wide, found->seen);
}

/* --- Medians -------------------------------------------------------------- */

/* The window's middle on a screen at a distance of 1, to the right and upward,
 * and half its side; and the middle of the picture's sides. */
#define RIGHT -1.057
#define UP -0.2157
#define HALF 0.636
enum { SIDE = 128, WHOLE = 352 };

static const double eye[3] = {14.4, 0.96, 10};

/* A point of that screen, moved away from the eye to a depth of z. The camera is
 * rolled by 45 degrees. */
static void place(double right, double up, double z, double point[3]) {
  double part = (eye[2] - z) / sqrt(2);
  point[0] = eye[0] + part * (up + right);
  point[1] = eye[1] + part * (up - right);
  point[2] = z;
}

/* All of the window, and two pixels more. */
static void add_wall(struct hsr_scene *scene, double z, const float rgb[3]) {
  double corner[4][3];
  for (int k = 0; k < 4; k++)
    place(RIGHT + (k == 1 || k == 2 ? 1 : -1) * (HALF + 0.02),
          UP + (k > 1 ? 1 : -1) * (HALF + 0.02), z, corner[k]);
  add_face(scene, corner, 4, rgb);
}

/* In front of the corner of the window where the gap is. Without it all that is
 * there has one colour, and nothing is asked. */
static void add_mark(struct hsr_scene *scene, const float rgb[3]) {
  double corner[3][3];
  for (int k = 0; k < 3; k++)
    place(RIGHT + HALF - (k == 1 ? 0.1 : 0.04),
          UP - HALF + (k == 2 ? 0.1 : 0.04), 5, corner[k]);
  add_face(scene, corner, 3, rgb);
}

/* Triangles behind the eye, so many that the scene's cube is divided; and two
 * that are out of the picture, so that its middle is (0, 0, 0). */
static void add_rest(struct hsr_scene *scene) {
  static const float grey[3] = {0.5f, 0.5f, 0.5f};
  for (int k = 0; k < 42; k++) {
    double x = k & 1 ? 10 + k : -10 - k, y = k & 2 ? 10 + k : -10 - k,
           z = 12 + k;
    if (k == 40)
      x = y = -56, z = -56;
    if (k == 41)
      x = y = 55, z = 56;
    const double corner[3][3] = {{x, y, z}, {x + 1, y, z}, {x, y + 1, z}};
    add_face(scene, corner, 3, grey);
  }
}

static void check_medians(struct tap *tap) {
  static const float red[3] = {1, 0, 0}, green[3] = {0, 1, 0},
                     blue[3] = {0, 0, 1};
  struct hsr_scene *scene = hsr_scene_new("medians");
  struct hsr_camera camera = {.up = {1, 1, 0}, .fov = 120.5};
  struct hsr_world world;
  struct hsr_view view;
  struct hsr_error err = {.text = "out of memory"};
  struct found found = {0};
  memcpy(camera.eye, eye, sizeof eye);
  memcpy(camera.at, eye, sizeof eye);
  camera.at[2] = 0;
  add_wall(scene, -2, red);
  add_wall(scene, -14, green);
  add_mark(scene, blue);
  add_rest(scene);
  if (hsr_scene_view(scene, &camera))
    bail("medians: %s", err.text);
  must_finish(scene);
  must_world(&world, scene);
  must_view(&view, &camera, WHOLE, WHOLE);
  view.window = hsr_window_make(6, 134, 6 + SIDE, 134 + SIDE);
  look(&world, &view, &found);
  tell(tap, &found, "walls cut at medians");
  hsr_world_free(&world);
  hsr_scene_delete(scene);
}

/* --- Bent ----------------------------------------------------------------- */

static void check_bent(struct tap *tap) {
  static const float red[3] = {1, 0, 0}, green[3] = {0, 1, 0};
  static const double bent[4][3] = {
      {-3, 1, -8}, {3, -1, -8}, {3, 1, -14}, {-3, -1, -14}};
  static const double wall[4][3] = {
      {-2, -2, -3}, {2, -2, -3}, {2, 2, -3}, {-2, 2, -3}};
  struct hsr_scene *scene = hsr_scene_new("bent");
  struct hsr_camera camera = {
      .eye = {0, 0, 0}, .at = {0, 0, -1}, .up = {0, 1, 0}, .fov = 60};
  struct hsr_world world;
  struct hsr_error err = {.text = "out of memory"};
  struct found found = {0};
  add_face(scene, bent, 4, red);
  add_face(scene, wall, 4, green);
  if (hsr_scene_view(scene, &camera))
    bail("bent: %s", err.text);
  must_finish(scene);
  must_world(&world, scene);
  for (int k = 1; k <= 8; k++) {
    struct hsr_view view;
    camera.eye[1] = camera.at[1] = k / 16.0;
    must_view(&view, &camera, 64, 64);
    look(&world, &view, &found);
  }
  tell(tap, &found, "a bent face seen edge-on");
  hsr_world_free(&world);
  hsr_scene_delete(scene);
}

/* --- Near ----------------------------------------------------------------- */

/* Of the height of two it covers .0005 behind `near`, and .0015 before it. */
static void check_near(struct tap *tap) {
  static const float red[3] = {1, 0, 0};
  static const double corner[3][3] = {
      {-1e9, -1e-3, 1e9}, {1e9, -1e-3, 1e9}, {0, 1e-3, -1e9}};
  struct hsr_scene *scene = hsr_scene_new("near");
  struct hsr_camera camera = {.eye = {0, 0, 0},
                              .at = {0, 0, -1},
                              .up = {0, 1, 0},
                              .parallel = 2,
                              .near = 5e8};
  struct hsr_world world;
  struct hsr_view view;
  struct hsr_error err = {.text = "out of memory"};
  struct found found = {0};
  add_face(scene, corner, 3, red);
  if (hsr_scene_view(scene, &camera))
    bail("near: %s", err.text);
  must_finish(scene);
  must_world(&world, scene);
  must_view(&view, &camera, 64, 64);
  look(&world, &view, &found);
  tell(tap, &found, "a plane along F, cut by near");
  hsr_world_free(&world);
  hsr_scene_delete(scene);
}

int main(void) {
  struct tap tap = plan(3);
  check_medians(&tap);
  check_bent(&tap);
  check_near(&tap);
  return finish(&tap);
}
