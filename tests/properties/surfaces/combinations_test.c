/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What Sutherland et al. 1974 expect of combinations of whole algorithms,
 * "Other Combinations of Sorting", checked by their counts.
 *
 * Depths      Priority numbers save the depth computations of Watkins' last
 *             step: newell-watkins makes none if faces are flat.
 * Few faces   If a picture has fewer than 100 faces, Warnock's part of a
 *             combination divides no window, and leaves one.
 * Areas       Warnock's algorithm considers too many areas: in the harbor the
 *             combinations examine less than a hundredth of its windows.
 * Clusters    Schumacker's order of clusters looks once at each separating
 *             plane: the combinations compare no faces of two clusters, and
 *             schumacker-newell no depths. Within a cluster priorities need not
 *             be fixed: a ring of faces is divided.
 * Thickness   Faces that touch and are flat except for rounding are drawn
 *             right, by asking at their samples. */
#include "bench/modules/modules.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { M = 97, N = 61, LARGEST = 512, AROUND = 36, ACROSS = 18 };

static uint32_t ids[LARGEST * LARGEST];

/* What an algorithm counts as it draws a picture. */
struct count {
  const struct hsr_algorithm *algorithm;
  struct hsr_tally tally;
};

static uint64_t of(const struct count *count, const char *counter) {
  return counted(count->algorithm, &count->tally, counter);
}

static struct count draw(const char *algorithm, struct hsr_scene *scene, int m,
                         int n) {
  struct hsr_world world;
  struct hsr_view view;
  struct count count = {hsr_algorithm_find(algorithm)->counting,
                        {.out_of_memory = false}};
  must_world(&world, scene);
  must_view(&view, &scene->views[0], m, n);
  draw_ids(count.algorithm, &world, &view, ids, &count.tally);
  hsr_world_free(&world);
  return count;
}

static void check_depths(struct tap *tap, const char *name) {
  struct hsr_scene *scene = must_open(name);
  struct count both = draw("newell-watkins", scene, M, N);
  struct count watkins = draw("watkins", scene, M, N);
  uint64_t numbers = of(&both, "priority search");
  uint64_t depths = of(&watkins, "depth search");
  ok(tap, numbers > 0 && both.tally.depths_compared == 0,
     "%s: %llu comparisons of priority numbers, none of depths (Watkins' are "
     "%llu)",
     name, (unsigned long long)numbers, (unsigned long long)depths);
  hsr_scene_delete(scene);
}

static void check_few(struct tap *tap, const char *algorithm) {
  struct hsr_scene *scene = must_open("penetration");
  struct count count = draw(algorithm, scene, M, N);
  ok(tap,
     of(&count, "finished windows") == 1 && of(&count, "subdivisions") == 0,
     "%s: few faces are left to the other algorithm at once", algorithm);
  hsr_scene_delete(scene);
}

static void check_areas(struct tap *tap) {
  struct hsr_scene *scene = must_open("harbor");
  struct count warnock = draw("warnock", scene, LARGEST, LARGEST);
  struct count watkins = draw("warnock-watkins", scene, LARGEST, LARGEST);
  struct count newell = draw("warnock-newell", scene, LARGEST, LARGEST);
  uint64_t alone = of(&warnock, "windows");
  uint64_t together = of(&watkins, "windows");
  ok(tap, together == of(&newell, "windows"),
     "the same windows are left to Watkins and to Newell");
  ok(tap, together < alone / 100, "%llu windows in the harbor, instead of %llu",
     (unsigned long long)together, (unsigned long long)alone);
  hsr_scene_delete(scene);
}

/* Pairs of faces that an algorithm compares or divides, of one cluster or of
 * two. */
struct pairs {
  const struct hsr_algorithm *algorithm;
  uint32_t *cluster; /* of each face */
  long compared, divided, of_two;
};

static bool is_of_face(const struct hsr_subject *subject) {
  return subject->kind == HSR_OF_FACE || subject->kind == HSR_OF_PIECE;
}

static void watch_pair(void *context, const struct hsr_event *event) {
  struct pairs *pairs = context;
  uint32_t a = event->a.id[0], b = event->b.id[0];
  if (!is_of_face(&event->a) || !is_of_face(&event->b))
    return; /* the event is of a plane, or of one face */
  enum hsr_step_kind kind = pairs->algorithm->counters[event->counter].kind;
  pairs->compared += kind == HSR_COMPARE;
  pairs->divided += kind == HSR_SPLIT;
  pairs->of_two += pairs->cluster[a] != pairs->cluster[b];
}

static void check_clusters(struct tap *tap, const char *algorithm,
                           const char *name, bool is_ring) {
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_scene *scene = must_open(name);
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  struct hsr_world world;
  struct hsr_view view;
  struct hsr_setup setup;
  struct count count = {hsr_algorithm_find(algorithm)->counting,
                        {.out_of_memory = false}};
  must_world(&world, scene);
  must_view(&view, &scene->views[0], M, N);
  must_setup(&setup, count.algorithm, NULL, &world);
  const struct hsr_clusters *c = setup.world->clusters;
  bool is_newell = !strcmp(algorithm, "schumacker-newell");
  struct pairs pairs = {.algorithm = count.algorithm,
                        .cluster =
                            HSR_NEW(&scratch, uint32_t, setup.world->n_faces)};
  if (!pairs.cluster)
    bail("%s: %s", name, err.text);
  for (uint32_t k = 0; k < c->n_clusters; k++)
    for (uint32_t o = c->start[k]; o < c->start[k + 1]; o++)
      pairs.cluster[c->order[o] / 2] = k;
  struct hsr_trace trace = {.listen = watch_pair, .context = &pairs};
  count.tally.trace = &trace;
  /* Not by hsr_setup_render, which names the scene's faces: clusters are of the
   * faces after the cuts. */
  struct hsr_answer answer = hsr_answer_of_ids(ids, M, N);
  struct hsr_job job = {.world = setup.world,
                        .view = &view,
                        .prepared = setup.prepared,
                        .option = setup.choice.values.option,
                        .scratch = &scratch,
                        .tally = &count.tally,
                        .answer = &answer};
  hsr_tally_begin(&count.tally, count.algorithm);
  if (count.algorithm->render(&job, &err))
    bail("%s: %s", name, err.text);
  ok(tap,
     c->n_clusters > 1 && c->n_separators == c->n_clusters - 1 &&
         of(&count, "inter-cluster priority") == c->n_separators,
     "%s: %u clusters, each plane between them looked at once", name,
     c->n_clusters);
  ok(tap,
     pairs.compared > 0 && !pairs.of_two &&
         (!is_newell || count.tally.depths_compared == 0),
     "%s: %ld comparisons of faces, %ld across clusters", name, pairs.compared,
     pairs.of_two);
  if (is_ring && is_newell)
    ok(tap, pairs.divided > 0, "%s: %ld divisions", name, pairs.divided);
  hsr_setup_free(&setup);
  hsr_world_free(&world);
  hsr_arena_free(&scratch);
  hsr_scene_delete(scene);
}

/* A torus of trapezoids: each is flat except for the rounding of its vertices.
 */
static struct hsr_scene *make_torus(void) {
  static const float grey[3] = {0.5f, 0.5f, 0.5f};
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_scene *scene = hsr_scene_new("torus");
  struct hsr_object *torus = hsr_scene_object(scene, "torus");
  double turn = 2 * acos(-1.0);
  for (int a = 0; a < AROUND; a++)
    for (int b = 0; b < ACROSS; b++) {
      double r = 2 + cos(turn * b / ACROSS);
      uint32_t v;
      hsr_object_vertex(torus, r * cos(turn * a / AROUND),
                        r * sin(turn * a / AROUND), sin(turn * b / ACROSS), &v);
    }
  for (int a = 0; a < AROUND; a++)
    for (int b = 0; b < ACROSS; b++) {
      uint32_t v[4];
      for (int k = 0; k < 4; k++)
        v[k] = (uint32_t)((a + (k == 1 || k == 2)) % AROUND * ACROSS +
                          (b + k / 2) % ACROSS);
      hsr_object_face(torus, v, 4, grey);
    }
  struct hsr_camera camera = {
      .eye = {5, 3, 2}, .at = {0, 0, 0}, .up = {0, 0, 1}, .fov = 40};
  if (hsr_scene_view(scene, &camera))
    bail("torus: %s", err.text);
  must_finish(scene);
  return scene;
}

static void check_thickness(struct tap *tap, const char *algorithm,
                            const char *counter) {
  static uint32_t wanted[M * N];
  struct hsr_scene *scene = make_torus();
  draw("oracle", scene, M, N);
  memcpy(wanted, ids, sizeof wanted);
  struct count count = draw(algorithm, scene, M, N);
  long wrong = 0;
  for (int k = 0; k < M * N; k++)
    wrong += ids[k] != wanted[k];
  ok(tap, of(&count, counter) > 0 && !wrong,
     "%s: faces that are not quite flat (%ld wrong, %llu samples asked)",
     algorithm, wrong, (unsigned long long)of(&count, counter));
  hsr_scene_delete(scene);
}

/* Schumacker, Newell and Watkins: one view twice, from one prepared object. */
static void check_three(struct tap *tap, const char *name) {
  static uint32_t wanted[M * N];
  struct hsr_error err = {.text = "out of memory"};
  struct hsr_scene *scene = must_open(name);
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  struct hsr_world world;
  struct hsr_view view;
  struct hsr_setup setup;
  struct count frame[2];
  must_world(&world, scene);
  must_view(&view, &scene->views[0], M, N);
  draw("oracle", scene, M, N);
  memcpy(wanted, ids, sizeof wanted);
  long wrong = 0;
  const struct hsr_algorithm *a =
      hsr_algorithm_find("schumacker-newell-watkins")->counting;
  must_setup(&setup, a, NULL, &world);
  for (int k = 0; k < 2; k++) {
    struct hsr_answer answer = hsr_answer_of_ids(ids, M, N);
    frame[k] = (struct count){a, {.out_of_memory = false}};
    struct hsr_job job = {.view = &view,
                          .scratch = &scratch,
                          .tally = &frame[k].tally,
                          .answer = &answer};
    hsr_arena_reset(&scratch);
    if (hsr_setup_render(&setup, &job, &err))
      bail("%s: %s", name, err.text);
    for (int i = 0; i < M * N; i++)
      wrong += ids[i] != wanted[i];
  }
  ok(tap,
     !wrong && of(&frame[0], "priority search") > 0 &&
         of(&frame[0], "thickness checks") == 0 &&
         frame[0].tally.depths_compared == 0,
     "%s: priority numbers are compared, no depths (%ld wrong)", name, wrong);
  ok(tap,
     5 * of(&frame[1], "plane tests") < of(&frame[0], "plane tests") &&
         of(&frame[1], "relations held") > 0 && !of(&frame[1], "divisions"),
     "%s: the order within clusters is kept: %llu plane tests, then %llu", name,
     (unsigned long long)of(&frame[0], "plane tests"),
     (unsigned long long)of(&frame[1], "plane tests"));
  hsr_setup_free(&setup);
  hsr_world_free(&world);
  hsr_arena_free(&scratch);
  hsr_scene_delete(scene);
}

int main(void) {
  struct tap tap = plan(25);
  check_depths(&tap, "house");
  check_depths(&tap, "harbor");
  check_depths(&tap, "cyclic-overlap");
  check_few(&tap, "warnock-watkins");
  check_few(&tap, "warnock-newell");
  check_areas(&tap);
  check_clusters(&tap, "schumacker-newell", "harbor", false);
  check_clusters(&tap, "schumacker-newell", "cyclic-overlap", true);
  check_clusters(&tap, "schumacker-watkins", "harbor", false);
  check_clusters(&tap, "schumacker-watkins", "cyclic-overlap", true);
  check_three(&tap, "house");
  check_three(&tap, "harbor");
  check_thickness(&tap, "schumacker-newell-watkins", "thickness checks");
  check_thickness(&tap, "newell", "thickness checks");
  check_thickness(&tap, "newell-watkins", "thickness checks");
  check_thickness(&tap, "warnock-newell", "Newell: thickness checks");
  check_thickness(&tap, "schumacker-newell", "thickness checks");
  return finish(&tap);
}
