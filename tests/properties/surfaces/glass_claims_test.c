/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What transparent faces cost: a span's order in depth is the last one's, and
 * there is a pass for each layer. */
#include "bench/modules/modules.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"
#include "common/answers/kinds/transparent.h"

#include <stdlib.h>

enum { M = 64, N = 8, SHEETS = 12 };

/* A pyramid of sheets, each 2 samples narrower on either side than the one
 * behind it, and all taller than the picture. */
static void add_sheets(struct hsr_scene *scene, float opacity) {
  for (int s = 0; s < SHEETS; s++) {
    struct hsr_object *sheet = hsr_scene_object(scene, "sheet");
    double half = 2 * (SHEETS - s) + 4;
    uint32_t v[4];
    for (int k = 0; k < 4; k++)
      hsr_object_vertex(sheet, k == 1 || k == 2 ? half : -half, k > 1 ? 9 : -9,
                        s, &v[k]);
    hsr_object_face(sheet, v, 4, NULL);
    sheet->opacity = opacity;
  }
}

struct drawn {
  struct hsr_tally tally;
  const struct hsr_algorithm *by;
};

static struct drawn draw(struct hsr_scene *scene, int m, int n,
                         const char *name) {
  struct drawn drawn = {.by = hsr_algorithm_find(name)->counting};
  struct hsr_choice choice = choose_also(drawn.by, HSR_TRANSPARENT);
  struct hsr_world world;
  struct hsr_view view;
  struct hsr_answer answer;
  must_world(&world, scene);
  must_view(&view, &scene->views[0], m, n);
  draw_chosen(drawn.by, &choice, &world, &view, &answer, &drawn.tally);
  hsr_answer_free(&answer);
  hsr_world_free(&world);
  return drawn;
}

/* On each row all sheets begin, one before the other, and then all end. */
static void check_pyramid(struct tap *tap) {
  struct hsr_scene *scene = hsr_scene_new("sheets");
  struct hsr_camera camera = {
      .eye = {0, 0, 100}, .at = {0, 0, 0}, .up = {0, 1, 0}, .parallel = N};
  add_sheets(scene, 0.5f);
  if (hsr_scene_view(scene, &camera))
    exit(99);
  must_finish(scene);
  struct drawn by = draw(scene, M, N, "bouknight");
  uint64_t wanted = 0;
  for (uint64_t n = 2; n <= SHEETS; n++)
    wanted +=
        (n - 2) + (n - 1) + (n - 1); /* sort the new one in; right limit */
  for (uint64_t n = 1; n < SHEETS; n++)
    wanted += 2 * (n - 1); /* those left are in order, at both limits */
  ok(tap, counted(by.by, &by.tally, "depth search") == N * wanted,
     "bouknight keeps the order of the last span: %llu comparisons, as many as "
     "%llu",
     (unsigned long long)counted(by.by, &by.tally, "depth search"),
     (unsigned long long)(N * wanted));
  /* On the way in, and on the way out but for the nearest. */
  ok(tap,
     counted(by.by, &by.tally, "combined") == (uint64_t)N * SHEETS * SHEETS,
     "and combines all that are involved");
  ok(tap, counted(by.by, &by.tally, "span divisions") == 0,
     "where nothing penetrates, no span is divided");
  by = draw(scene, M, N, "zbuffer-fast");
  ok(tap, counted(by.by, &by.tally, "layers") == SHEETS + 1,
     "the z-buffer makes a pass for each layer, and one that finds none");
  struct drawn few = draw(scene, M, N, "yzx"),
               many = draw(scene, M, 8 * N, "yzx");
  ok(tap,
     counted(few.by, &few.tally, "Z minimax") &&
         counted(few.by, &few.tally, "Z minimax") ==
             counted(many.by, &many.tally, "Z minimax") &&
         counted(few.by, &few.tally, "combined") ==
             (uint64_t)N * SHEETS * SHEETS,
     "yzx compares depths no more often on eight times the lines");
  hsr_scene_delete(scene);
}

/* How often faces are combined is told by the picture alone. */
static void check_same_work(struct tap *tap, const char *name) {
  struct hsr_scene *scene = must_open(name);
  struct drawn layers = draw(scene, 97, 61, "zbuffer-fast"),
               list = draw(scene, 97, 61, "schumacker");
  uint64_t a = counted(layers.by, &layers.tally, "combined"),
           b = counted(list.by, &list.tally, "combined");
  ok(tap, a && a == b, "%s: %llu samples combined in layers, %llu by priority",
     name, (unsigned long long)a, (unsigned long long)b);
  hsr_scene_delete(scene);
}

int main(void) {
  struct tap tap = plan(7);
  check_pyramid(&tap);
  check_same_work(&tap, "greenhouse");
  check_same_work(&tap, "panes");
  return finish(&tap);
}
