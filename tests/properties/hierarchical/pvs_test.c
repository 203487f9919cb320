/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Potentially visible sets by cells and portals.
 *
 * Holds       The set of a view holds every face that the oracle sees in it:
 *             from random eyes in every room of a generated building, and in
 *             the office.
 * Larger      It is larger than what is seen, and much smaller than all.
 * Doors       A door that is walled up hides what is behind it: the set of the
 *             room shrinks to the room.
 *
 * usage: pvs_test [EYES]      in each room; standard: 6 */
#include "bench/modules/modules.h"
#include "tests/properties/hierarchical/claims.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>

enum { M = 40, N = 30, ROOMS = 5, SIZE = 8 };

/* --- Sets ----------------------------------------------------------------- */

struct set {
  int drawn;            /* the counter */
  unsigned char *holds; /* a face */
  uint32_t n;
};

static void note_drawn(void *context, const struct hsr_event *event) {
  struct set *set = context;
  if (event->counter != set->drawn)
    return;
  set->holds[event->a.id[0]] = 1;
  set->n++;
}

struct sums {
  long eyes, lacking, wrong;
  double in_sets, seen;
};

/* Draws scene->view, also by the sets of cells. */
static void look(const struct claim_scene *scene, struct sums *sums) {
  struct claim_counts right, got, by_cells;
  uint32_t n = scene->worlds.world.n_faces;
  struct set set = {
      counter_of(hsr_algorithm_find("pvs")->counting, "faces drawn"),
      calloc(n, 1), 0};
  if (!set.holds)
    abort();
  claim_draw(&right, scene, "oracle", NULL, NULL);
  claim_draw(&got, scene, "pvs", note_drawn, &set);
  sums->wrong += count_differences(&scene->view, got.ids, right.ids);
  claim_draw(&by_cells, scene, "pvs:sets=cells", NULL, NULL);
  sums->wrong += count_differences(&scene->view, by_cells.ids, right.ids);
  free(by_cells.ids);
  for (int k = 0; k < M * N; k++) {
    uint32_t f = right.ids[k];
    if (f == HSR_BACKGROUND || set.holds[f] == 2)
      continue;
    sums->lacking += !set.holds[f];
    sums->seen++;
    set.holds[f] = 2;
  }
  sums->in_sets += set.n;
  sums->eyes++;
  free(set.holds);
  free(right.ids);
  free(got.ids);
}

static void look_from_rooms(const struct claim_scene *building, long eyes,
                            struct sums *sums) {
  struct claim_scene scene = *building;
  uint64_t seed = 3;
  for (int room = 0; room < ROOMS * ROOMS; room++)
    for (long k = 0; k < eyes; k++) {
      double x = room % ROOMS * SIZE, z = room / ROOMS * SIZE;
      struct hsr_camera camera = {.up = {0, 1, 0}, .fov = 80};
      for (int a = 0; a < 3; a++)
        camera.at[a] = (double)draw_integer(&seed, -9, 9) + 0.3;
      /* One eye of four is on a wall's plane, or at a corner of the room. */
      double step = draw_integer(&seed, 0, 3) ? SIZE / 1001.0 : SIZE;
      long most = lround(SIZE / step);
      camera.eye[0] = x + step * (double)draw_integer(&seed, 0, most);
      camera.eye[1] = 0.1 + 0.01 * (double)draw_integer(&seed, 0, 380);
      camera.eye[2] = z + step * (double)draw_integer(&seed, 0, most);
      camera.near = draw_integer(&seed, 0, 3) ? 0 : 1.5;
      for (int a = 0; a < 3; a++)
        camera.at[a] += camera.eye[a];
      if (!hsr_view_init(&scene.view, &camera, M, N, NULL))
        look(&scene, sums);
    }
}

static void check_rooms(struct tap *tap, long eyes) {
  struct claim_scene scene;
  struct sums sums = {0};
  claim_open(&scene, "rooms:5", 0, M, N);
  double all = scene.worlds.world.n_faces;
  look_from_rooms(&scene, eyes, &sums);
  ok(tap, sums.eyes > 20 * eyes && !sums.lacking && !sums.wrong,
     "rooms: %ld eyes see nothing that their sets lack (%ld), %ld samples "
     "wrong",
     sums.eyes, sums.lacking, sums.wrong);
  ok(tap,
     sums.in_sets < 0.12 * all * (double)sums.eyes && sums.in_sets > sums.seen,
     "a set has %.1f faces of %.0f, of which %.1f are seen",
     sums.in_sets / (double)sums.eyes, all, sums.seen / (double)sums.eyes);
  claim_close(&scene);

  struct sums closed = {0};
  claim_open(&scene, "rooms:5:0", 0, M, N);
  look_from_rooms(&scene, eyes, &closed);
  ok(tap, !closed.lacking && !closed.wrong && 2 * closed.in_sets < sums.in_sets,
     "without doors: %.1f faces", closed.in_sets / (double)closed.eyes);
  claim_close(&scene);
}

/* A closed box with a partition of two triangles, and a board behind it. If
 * they are halves of one rectangle, the board is hidden. If they overlap, it is
 * seen through the gap that they leave. */
static void check_partition(struct tap *tap, bool halves) {
  static const double corner[8][3] = {{0, 0, 0}, {8, 0, 0}, {8, 8, 0},
                                      {0, 8, 0}, {0, 0, 8}, {8, 0, 8},
                                      {8, 8, 8}, {0, 8, 8}};
  static const uint32_t side[6][4] = {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                      {3, 2, 6, 7}, {0, 3, 7, 4}, {1, 2, 6, 5}};
  static const double middle[4][3] = {
      {0, 0, 4}, {8, 0, 4}, {8, 8, 4}, {0, 8, 4}};
  static const double board[3][3] = {{2, 2, 1}, {7.5, 2, 1.5}, {7.5, 6, 1}};
  struct hsr_camera camera = {
      .eye = {4, 4, 7.5}, .at = {4, 4, 0}, .up = {0, 1, 0}, .fov = 90};
  struct hsr_scene *scene = hsr_scene_new("partition");
  struct hsr_object *o = hsr_scene_object(scene, "box");
  struct claim_scene drawn;
  struct claim_counts right;
  struct sums sums = {0};
  uint32_t v[15];
  for (int k = 0; k < 15; k++) {
    const double *at = k < 8    ? corner[k]
                       : k < 12 ? middle[k - 8]
                                : board[k - 12];
    if (hsr_object_vertex(o, at[0], at[1], at[2], &v[k]))
      abort();
  }
  for (int k = 0; k < 6; k++)
    if (hsr_object_face(o, side[k], 4, NULL))
      abort();
  const uint32_t first[3] = {v[8], v[9], v[11]};
  const uint32_t other[3] = {v[8], v[10], v[11]};
  const uint32_t half[3] = {v[9], v[10], v[11]};
  const uint32_t behind[3] = {v[12], v[13], v[14]};
  if (hsr_object_face(o, first, 3, NULL) ||
      hsr_object_face(o, halves ? half : other, 3, NULL) ||
      hsr_object_face(o, behind, 3, NULL) || hsr_scene_view(scene, &camera))
    abort();
  must_finish(scene);
  drawn.worlds.scene = scene;
  must_world(&drawn.worlds.world, scene);
  must_roster(&drawn.worlds.roster, scene);
  must_view(&drawn.view, &camera, M, N);
  claim_draw(&right, &drawn, "oracle", NULL, NULL);
  bool shows = false;
  for (int k = 0; k < M * N; k++)
    shows |= right.ids[k] == 8;
  free(right.ids);
  look(&drawn, &sums);
  ok(tap,
     shows == !halves && !sums.wrong && !sums.lacking &&
         (!halves || sums.in_sets < 9),
     "a partition of two triangles, %s: the board behind is %s, %.0f faces in "
     "the set",
     halves ? "halves" : "overlapping", shows ? "seen" : "hidden",
     sums.in_sets);
  claim_close(&drawn);
}

static void check_office(struct tap *tap) {
  struct sums sums = {0};
  double all = 0;
  for (uint32_t v = 0; v < 150; v += 15) {
    struct claim_scene scene;
    claim_open(&scene, "office:1", v, M, N);
    all = scene.worlds.world.n_faces;
    look(&scene, &sums);
    claim_close(&scene);
  }
  ok(tap, !sums.lacking && !sums.wrong && sums.in_sets > sums.seen,
     "office: a set has %.0f faces of %.0f, of which %.0f are seen",
     sums.in_sets / (double)sums.eyes, all, sums.seen / (double)sums.eyes);
}

int main(int argc, char **argv) {
  struct tap tap = plan(6);
  check_rooms(&tap, argc > 1 ? atol(argv[1]) : 6);
  check_partition(&tap, true);
  check_partition(&tap, false);
  check_office(&tap);
  return finish(&tap);
}
