/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What N. Greene, "Hierarchical Polygon Tiling with Coverage Masks", SIGGRAPH
 * 1996, 2.1 and 6, claims about his baselines: from front to back no sample is
 * written twice; from back to front all samples of all faces are written. */
#include "bench/modules/modules.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <stdlib.h>

enum { M = 75, N = 50, VIEWS = 3, ALGORITHMS = 3 };

static const char *const names[ALGORITHMS] = {"bsp-painter", "bsp-front",
                                              "warnock-depth"};
enum { PAINTER, FRONT, WARNOCK };

static const struct hsr_algorithm *counting(int number) {
  return hsr_algorithm_find(names[number])->counting;
}

static uint64_t count_covered(const uint32_t *ids) {
  uint64_t n = 0;
  for (int k = 0; k < M * N; k++)
    n += ids[k] != HSR_BACKGROUND;
  return n;
}

/* --- Samples -------------------------------------------------------------- */

/* Whether the picture is the same in windows. */
static bool same_in_windows(const struct hsr_world *world,
                            const struct hsr_view *view, int number,
                            const uint32_t *whole) {
  static uint32_t ids[M * N];
  bool same = true;
  for (int y = 0; y < N; y += 21)
    for (int x = 0; x < M; x += 17) {
      struct hsr_view part = *view;
      part.window = (struct hsr_window){x, y, x + 17 < M ? x + 17 : M,
                                        y + 21 < N ? y + 21 : N};
      draw_ids(counting(number), world, &part, ids, NULL);
      same &= count_differences(&part, ids, whole) == 0;
      for (int k = 0; k < M * N; k++) {
        int i = k % M, j = k / M;
        bool within = i >= part.window.x0 && i < part.window.x1 &&
                      j >= part.window.y0 && j < part.window.y1;
        same &= within || ids[k] == UNWRITTEN;
      }
    }
  return same;
}

static void check_samples(struct tap *tap, const char *name) {
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_import import = {.strict = true};
  struct hsr_scene *scene;
  struct hsr_world world;
  if (hsr_scene_open(name, &import, &scene, &err) ||
      hsr_scene_add_orbit(scene, VIEWS))
    bail("%s", err.text);
  must_world(&world, scene);
  bool once = true, all = true, windows = true;
  uint64_t covered = 0, hidden = 0;
  for (uint32_t v = 0; v < scene->n_views && v < VIEWS; v++) {
    static uint32_t ids[ALGORITHMS][M * N];
    struct hsr_tally tally[ALGORITHMS] = {{.out_of_memory = false}};
    struct hsr_view view;
    must_view(&view, &scene->views[v], M, N);
    for (int a = 0; a < ALGORITHMS; a++) {
      draw_ids(counting(a), &world, &view, ids[a], &tally[a]);
      windows &= same_in_windows(&world, &view, a, ids[a]);
    }
    uint64_t n = count_covered(ids[FRONT]);
    uint64_t painted = counted(counting(PAINTER), &tally[PAINTER], "samples");
    uint64_t over = counted(counting(PAINTER), &tally[PAINTER], "overwrites");
    uint64_t taken = counted(counting(FRONT), &tally[FRONT], "samples taken");
    once &= counted(counting(FRONT), &tally[FRONT], "samples") == n;
    once &= counted(counting(WARNOCK), &tally[WARNOCK], "samples") == n;
    all &= painted - over == n && painted == n + taken;
    covered += n;
    hidden += over;
  }
  ok(tap, once && covered, "%s: from front to back, %llu samples once", name,
     (unsigned long long)covered);
  ok(tap, all && hidden, "%s: from back to front, %llu more", name,
     (unsigned long long)hidden);
  ok(tap, windows, "%s: the same picture in windows", name);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
}

/* --- Cells ---------------------------------------------------------------- */

/* A square on z = depth, turned a little, about the axis of sight. */
static void add_square(struct hsr_scene *scene, double depth, double half) {
  static const float grey[3] = {0.5f, 0.5f, 0.5f};
  struct hsr_object *object = hsr_scene_object(scene, "square");
  uint32_t v[4];
  hsr_object_vertex(object, -half, -0.9 * half, depth, &v[0]);
  hsr_object_vertex(object, 0.9 * half, -half, depth, &v[1]);
  hsr_object_vertex(object, half, 0.9 * half, depth, &v[2]);
  hsr_object_vertex(object, -0.9 * half, half, depth, &v[3]);
  hsr_object_face(object, v, 4, grey);
}

/* The number of cells that depth-priority Warnock visits for squares on planes
 * one behind the other. Half a side of the k-th is half[k]. */
static uint64_t cells_of(const double *half, int n) {
  static uint32_t ids[M * N];
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_camera camera = {
      .eye = {0, 0, 100}, .at = {0, 0, 0}, .up = {0, 1, 0}, .fov = 40};
  struct hsr_scene *scene = hsr_scene_new("squares");
  struct hsr_world world;
  struct hsr_view view;
  struct hsr_tally tally = {.out_of_memory = false};
  for (int k = 0; k < n; k++)
    add_square(scene, -k, half[k]);
  if (hsr_scene_view(scene, &camera))
    bail("%s", err.text);
  must_finish(scene);
  must_world(&world, scene);
  must_view(&view, &camera, M, N);
  draw_ids(counting(WARNOCK), &world, &view, ids, &tally);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
  return counted(counting(WARNOCK), &tally, "cells");
}

static void check_cells(struct tap *tap) {
  uint64_t all = cells_of((const double[]){200}, 1);
  uint64_t behind = cells_of((const double[]){200, 30, 20, 500}, 4);
  uint64_t one = cells_of((const double[]){20}, 1);
  uint64_t before = cells_of((const double[]){20, 15}, 2);
  ok(tap, behind == all,
     "what is behind a square that fills the picture costs no cell (%llu)",
     (unsigned long long)behind);
  ok(tap, before - one < one / 4,
     "what is hidden costs few cells (%llu, and %llu)", (unsigned long long)one,
     (unsigned long long)(before - one));
}

int main(void) {
  static const char *const scenes[] = {"house", "color-cube:4", "soup:150:3",
                                       "penetration", "behind-eye"};
  enum { SCENES = sizeof scenes / sizeof *scenes };
  struct tap tap = plan(3 * SCENES + 2);
  for (int s = 0; s < SCENES; s++)
    check_samples(&tap, scenes[s]);
  check_cells(&tap);
  return finish(&tap);
}
