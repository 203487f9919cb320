/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is known of how instances move, and how frames are held to it. */
#include "common/scene/motion.h"
#include "scenes/scenes.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static struct hsr_scene *new_scene(double x, long frame) {
  struct hsr_scene *scene = hsr_scene_new("one");
  struct hsr_object *object = hsr_scene_object(scene, "triangle");
  struct hsr_error err;
  object->moves = true;
  for (int k = 0; k < 3; k++)
    hsr_object_vertex(object, k == 1, k == 2, 0, NULL);
  hsr_object_face(object, (const uint32_t[]){0, 1, 2}, 3, NULL);
  const double m[12] = {1, 0, 0, x, 0, 1, 0, 0, 0, 0, 1, 0};
  const struct hsr_motion motion = {
      .speed = 1, .lo = {-10, -1, -1}, .hi = {20, 1, 1}};
  const struct hsr_key key[] = {{0, {0, 0, -.25}, {1, 1, .25}},
                                {8, {4, 0, -.25}, {5, 1, .25}},
                                {10, {5, 0, -.25}, {6, 1, .25}},
                                {12, {3, 0, -.25}, {4, 1, .25}}};
  hsr_scene_instance(scene, 0, m);
  if (hsr_scene_set_motion(scene, &motion, key, 4) ||
      hsr_scene_set_frame(scene, frame) || hsr_scene_finish(scene, &err))
    abort();
  return scene;
}

static bool way_is(const struct hsr_scene *scene, double from, double to,
                   double x0, double x1) {
  double lo[3], hi[3];
  return hsr_scene_way(scene, 0, from, to, lo, hi) && lo[0] == x0 &&
         hi[0] == x1 && lo[1] == 0 && hi[1] == 1 && lo[2] == -.25 &&
         hi[2] == .25;
}

static void test_way(struct tap *tap) {
  struct hsr_scene *scene = new_scene(0, 0);
  double lo[3], hi[3];
  ok(tap, way_is(scene, 0, 0, 0, 1) && way_is(scene, 8, 8, 4, 5),
     "a way is at its keys");
  ok(tap, way_is(scene, 4, 4, 2, 3) && way_is(scene, 2, 4, 1, 3),
     "between them it goes straight");
  ok(tap,
     way_is(scene, 6, 11, 3, 6) && way_is(scene, 9, 9.5, 4.5, 5.75) &&
         way_is(scene, 11, 12, 3, 5) && way_is(scene, 0, 12, 0, 6),
     "over some keys it holds them");
  ok(tap,
     !hsr_scene_way(scene, 0, -1, 3, lo, hi) &&
         !hsr_scene_way(scene, 0, 3, 13, lo, hi),
     "beyond the first or the last it is not known");
  hsr_scene_delete(scene);
}

/* Follows from frame 0 to one in which the triangle is at x. */
static enum hsr_status follow(double x, long frame, const char *words) {
  struct hsr_scene *scene = new_scene(0, 0), *then = new_scene(x, frame);
  struct hsr_error err = {.text = ""};
  enum hsr_status status = hsr_scene_follow(scene, then, &err);
  bool moved = scene->instances[0].m[3] == x && hsr_scene_frame(scene) == frame;
  bool stayed = scene->instances[0].m[3] == 0 && hsr_scene_frame(scene) == 0;
  if (status ? !stayed || !strstr(err.text, words) : !moved)
    status = HSR_E_INTERNAL;
  hsr_scene_delete(scene);
  hsr_scene_delete(then);
  return status;
}

static void test_promises(struct tap *tap) {
  ok(tap, !follow(2, 4, "") && !follow(4.5, 9, "") && !follow(-9, -9, ""),
     "a frame that keeps what was promised is taken");
  ok(tap, follow(3, 2, "too fast") == HSR_E_INPUT, "one too fast is not");
  ok(tap, follow(-10.5, 40, "its volume") == HSR_E_INPUT,
     "one beyond its volume is not");
  ok(tap, follow(2.5, 4, "its way") == HSR_E_INPUT, "one off its way is not");
  ok(tap, follow(1, 0, "too fast") == HSR_E_INPUT,
     "nor one that moves in no time");
}

static void test_refused(struct tap *tap) {
  struct hsr_scene *scene = new_scene(0, 0), *other;
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_motion unknown = hsr_motion_unknown();
  const struct hsr_key back[] = {{.frame = 3}, {.frame = 3}};
  ok(tap, hsr_scene_set_motion(scene, &unknown, back, 2) == HSR_E_INPUT,
     "keys have to be in order");
  scene->objects[0].moves = false;
  ok(tap, hsr_scene_set_motion(scene, &unknown, back, 1) == HSR_E_INPUT,
     "what does not move has no motion");
  struct hsr_scene *then = new_scene(1, 3);
  ok(tap,
     hsr_scene_follow(scene, then, &err) == HSR_E_INPUT &&
         strstr(err.text, "does not move"),
     "what does not move stays where it is");
  if (hsr_scene_open("house", NULL, &other, &err))
    abort();
  ok(tap, hsr_scene_follow(scene, other, &err) == HSR_E_INPUT,
     "another scene is no frame of this one");
  ok(tap,
     hsr_scene_motion(other, 0).speed == INFINITY && !hsr_scene_frame(other) &&
         !hsr_scene_way(other, 0, 0, 0, unknown.lo, unknown.hi),
     "of most scenes nothing is known");
  hsr_scene_delete(scene);
  hsr_scene_delete(then);
  hsr_scene_delete(other);
}

/* The carts keep their promises, wherever they turn. */
static void test_traffic(struct tap *tap) {
  static const int frame[] = {3, 4, 40, 41, 43, 399, 1024, 1025, 7, 100000};
  struct hsr_error err = {.text = "out of memory"};
  int kept = 0, tried = 0;
  for (int way = 0; way <= 48; way = 3 * way + 1) {
    struct hsr_scene *scene = NULL, *then;
    for (size_t k = 0; k < sizeof frame / sizeof *frame; k++, tried++) {
      char name[60];
      snprintf(name, sizeof name, "traffic:3:%d:%d", frame[k], way);
      if (hsr_scene_open(name, NULL, &then, &err))
        abort();
      if (scene)
        kept += !hsr_scene_follow(scene, then, &err);
      else
        kept++;
      if (scene)
        hsr_scene_delete(then);
      else
        scene = then;
    }
    hsr_scene_delete(scene);
  }
  ok(tap, kept == tried, "carts keep their promises in %d frames of %d: %s",
     kept, tried, kept == tried ? "" : err.text);
}

/* A tiny scene is enlarged with all that is known of it. */
static void test_tiny(struct tap *tap) {
  struct hsr_scene *scene = new_scene(0, 0);
  double tiny = 0x1p-200, lo[3], hi[3];
  struct hsr_motions *m = scene->motions;
  for (int k = 0; k < 9; k++)
    scene->objects[0].xyz[k] *= tiny;
  for (uint32_t v = 0; v < scene->n_views; v++)
    for (int a = 0; a < 3; a++) {
      scene->views[v].eye[a] *= tiny;
      scene->views[v].at[a] *= tiny;
    }
  m->of[0].speed = tiny;
  for (uint32_t k = 0; k < m->n_keys; k++)
    for (int a = 0; a < 3; a++) {
      m->key[k].lo[a] *= tiny;
      m->key[k].hi[a] *= tiny;
    }
  hsr_scene_enlarge(scene);
  double size = ldexp(tiny, scene->enlarged);
  ok(tap,
     scene->enlarged && hsr_scene_motion(scene, 0).speed == size &&
         hsr_scene_way(scene, 0, 4, 4, lo, hi) && lo[0] == 2 * size &&
         scene->objects[0].xyz[3] == size,
     "a tiny scene is enlarged with its motion");
  hsr_scene_delete(scene);
}

static bool is_same(struct hsr_scene *then) {
  struct hsr_scene *scene = new_scene(0, 0);
  bool same = hsr_scene_is_same(scene, then);
  hsr_scene_delete(scene);
  hsr_scene_delete(then);
  return same;
}

static void test_same(struct tap *tap) {
  struct hsr_scene *then = new_scene(0, 3);
  then->views[0].eye[0]++;
  ok(tap, is_same(then), "from elsewhere, and later, a scene is the same");
  struct hsr_scene *scene = new_scene(0, 0), *moved = new_scene(0.5, 0);
  ok(tap,
     !hsr_scene_is_same(scene, moved) && hsr_scene_has_objects(scene, moved),
     "if something has moved, its objects are");
  hsr_scene_delete(scene);
  hsr_scene_delete(moved);
  then = new_scene(0, 0);
  then->objects[0].xyz[3] += 0.5;
  ok(tap, !is_same(then), "nor if a vertex is elsewhere");
  then = new_scene(0, 0);
  then->objects[0].vertex[0] = 2;
  then->objects[0].vertex[2] = 0;
  ok(tap, !is_same(then), "nor if a face is turned");
  then = new_scene(0, 0);
  then->objects[0].colour[1] /= 2;
  ok(tap, !is_same(then), "nor if it has another colour");
  then = new_scene(0, 0);
  then->objects[0].opacity = 0.5f;
  ok(tap, !is_same(then), "nor if it is transparent");
  then = new_scene(0, 0);
  then->objects[0].one_sided = true;
  ok(tap, !is_same(then), "nor if it has one side");
}

int main(void) {
  struct tap tap = plan(4 + 5 + 5 + 1 + 1 + 7);
  test_way(&tap);
  test_promises(&tap);
  test_refused(&tap);
  test_traffic(&tap);
  test_tiny(&tap);
  test_same(&tap);
  return finish(&tap);
}
