/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What shadows cost, in faces tested for blocking the light: of a ray to the
 * light, all faces until one blocks; of Bouknight and Kelley's pairs, those that
 * overlap about the light; of a view from the light, those of a cell. All three
 * find the same samples lit. */
#include "bench/modules/modules.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"
#include "common/answers/kinds/shadowed.h"

#include <stdlib.h>

enum { M = 64, N = 48 };

struct drawn {
  uint64_t tests, lit;
};

static struct drawn draw(const struct both_worlds *worlds, const char *name) {
  const struct hsr_algorithm *a = hsr_algorithm_find(name)->counting;
  struct hsr_choice choice = choose_also(a, HSR_SHADOWED);
  struct hsr_tally tally = {.trace = NULL};
  struct hsr_view view;
  struct hsr_answer answer;
  struct drawn drawn = {.lit = 0};
  must_view(&view, &worlds->scene->views[0], M, N);
  draw_chosen(a, &choice, &worlds->world, &view, &answer, &tally);
  drawn.tests = counted(a, &tally, "shadow tests");
  for (int k = 0; k < M * N; k++)
    drawn.lit += hsr_answer_shadowed_of(&answer)->lit[k];
  hsr_answer_free(&answer);
  return drawn;
}

static void check(struct tap *tap, const char *scene) {
  struct both_worlds worlds;
  open_worlds(&worlds, scene);
  struct drawn rays = draw(&worlds, "raycast"),
               pairs = draw(&worlds, "bouknight"),
               view = draw(&worlds, "zbuffer-fast");
  ok(tap, rays.lit > 100 && pairs.lit == rays.lit && view.lit == rays.lit,
     "%s: %d samples are lit by all", scene, (int)rays.lit);
  ok(tap, 10 * pairs.tests < rays.tests, "%s: %d tests by pairs, %d by rays",
     scene, (int)pairs.tests, (int)rays.tests);
  ok(tap, 10 * view.tests < rays.tests, "%s: %d tests by a view from the light",
     scene, (int)view.tests);
  close_worlds(&worlds);
}

int main(void) {
  struct tap tap = plan(6);
  check(&tap, "house");
  check(&tap, "harbor:600");
  return finish(&tap);
}
