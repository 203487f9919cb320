/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What N. Greene, PhD thesis, UC Santa Cruz, 1995, 2.1.6, says of Naylor's
 * algorithm: subtrees behind a face of the visibility map are culled; those that
 * several faces hide together are not.
 *
 * One         A wall of one face before a block of cubes: its subtrees are
 *             culled.
 * Several     The same wall, cut into two faces: most subtrees of the block are
 *             not culled, since the cut runs across their boxes. If several
 *             regions of the map may hide a box together, as many are as
 *             before. */
#include "scenes/scenes.h"
#include "tests/properties/hierarchical/claims.h"
#include "tests/tap.h"

#include <stdlib.h>

enum { M = 96, N = 72, SIDE = 5 };

static void add_face(struct hsr_object *object, const double corner[4][3]) {
  uint32_t v[4];
  for (int k = 0; k < 4; k++)
    if (hsr_object_vertex(object, corner[k][0], corner[k][1], corner[k][2],
                          &v[k]))
      abort();
  if (hsr_object_face(object, v, 4, NULL))
    abort();
}

/* The wall at z = 4, from x = lo to x = hi, in `n` faces with cuts that are not
 * upright, so that no line of the map parts them from all else at once. */
static void add_wall(struct hsr_scene *scene, int n) {
  struct hsr_object *wall = hsr_scene_object(scene, "wall");
  for (int k = 0; k < n; k++) {
    double a = -8 + 16.0 * k / n, b = -8 + 16.0 * (k + 1) / n;
    double lean_a = k ? 0.5 : 0, lean_b = k + 1 < n ? 0.5 : 0;
    const double corner[4][3] = {{a - lean_a, -8, 4},
                                 {b - lean_b, -8, 4},
                                 {b + lean_b, 8, 4},
                                 {a + lean_a, 8, 4}};
    add_face(wall, corner);
  }
}

/* Small squares, all over a block behind the wall. */
static void add_block(struct hsr_scene *scene) {
  struct hsr_object *block = hsr_scene_object(scene, "block");
  for (int i = 0; i < SIDE * SIDE * SIDE; i++) {
    double x = i % SIDE - 2.2, y = i / SIDE % SIDE - 2.1,
           z = i / (SIDE * SIDE) - 3.3;
    const double corner[4][3] = {{x - 0.4, y - 0.4, z},
                                 {x + 0.4, y - 0.4, z + 0.1},
                                 {x + 0.4, y + 0.4, z + 0.1},
                                 {x - 0.4, y + 0.4, z}};
    add_face(block, corner);
  }
}

struct result {
  uint64_t culled, visited, pieces;
  bool right;
};

static struct result draw_wall(int n, const char *algorithm) {
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_camera camera = {
      .eye = {0, 0, 20}, .at = {0, 0, 0}, .up = {0, 1, 0}, .fov = 40};
  struct claim_scene scene;
  struct claim_counts counts, right;
  scene.worlds.scene = hsr_scene_new("wall");
  add_wall(scene.worlds.scene, n);
  add_block(scene.worlds.scene);
  if (hsr_scene_view(scene.worlds.scene, &camera))
    bail("%s", err.text);
  must_finish(scene.worlds.scene);
  must_world(&scene.worlds.world, scene.worlds.scene);
  must_roster(&scene.worlds.roster, scene.worlds.scene);
  must_view(&scene.view, &camera, M, N);
  claim_draw(&counts, &scene, algorithm, NULL, NULL);
  claim_draw(&right, &scene, "oracle", NULL, NULL);
  struct result result = {
      claim_value(&counts, "nodes culled"),
      claim_value(&counts, "nodes visited"), claim_value(&counts, "pieces"),
      count_differences(&scene.view, counts.ids, right.ids) == 0};
  free(counts.ids);
  free(right.ids);
  claim_close(&scene);
  return result;
}

int main(void) {
  struct tap tap = plan(5);
  struct result one = draw_wall(1, "naylor");
  struct result cut = draw_wall(2, "naylor");
  struct result together = draw_wall(2, "naylor:cull=several");
  struct result none = draw_wall(1, "naylor:cull=nothing");
  ok(&tap, one.right && cut.right && together.right && none.right,
     "the oracle's pictures");
  ok(&tap, one.culled > 0 && 4 * one.pieces < none.pieces,
     "behind one face: %llu nodes visited, %llu of them culled, %llu pieces of "
     "%llu inserted",
     (unsigned long long)one.visited, (unsigned long long)one.culled,
     (unsigned long long)one.pieces, (unsigned long long)none.pieces);
  ok(&tap, 2 * one.visited < cut.visited && 3 * one.pieces < cut.pieces,
     "behind two faces: %llu nodes visited, %llu pieces inserted",
     (unsigned long long)cut.visited, (unsigned long long)cut.pieces);
  ok(&tap, together.pieces == one.pieces + 1 && together.visited == one.visited,
     "behind two faces together: %llu nodes visited, %llu pieces inserted",
     (unsigned long long)together.visited, (unsigned long long)together.pieces);
  ok(&tap, none.culled == 0 && none.visited > one.visited,
     "if nothing is culled: %llu nodes visited",
     (unsigned long long)none.visited);
  return finish(&tap);
}
