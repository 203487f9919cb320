/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Algorithms take the subjects of scenes that they name, and refuse others. */
#include "tests/draw.h"
#include "tests/tap.h"

#include <string.h>

/* A scene of faces is not refused for its subject. A grid is refused, with
 * these words, unless the algorithm takes grids. */
static bool is_faithful(const struct hsr_algorithm *a,
                        struct both_worlds *worlds) {
  struct hsr_error err = {.text = ""};
  struct hsr_setup setup;
  enum hsr_status of_faces =
      hsr_setup_init(&setup, a, NULL, &worlds->world, &err);
  bool good = !of_faces || !strstr(err.text, "does not take");
  hsr_setup_free(&setup);
  worlds->scene->subject = HSR_GRID;
  enum hsr_status of_grid =
      hsr_setup_init(&setup, a, NULL, &worlds->world, &err);
  if (!(a->subjects & 1u << HSR_GRID))
    good &= of_grid == HSR_E_REFUSED &&
            !strcmp(err.text, "the scene is a grid, which it does not take");
  hsr_setup_free(&setup);
  worlds->scene->subject = HSR_FACES;
  return good;
}

int main(void) {
  struct both_worlds worlds;
  open_worlds(&worlds, "house");
  int n = 0;
  for (const struct hsr_listed *l = hsr_algorithms; l->plain; l++)
    n++;
  struct tap tap = plan(n);
  for (const struct hsr_listed *l = hsr_algorithms; l->plain; l++)
    ok(&tap, l->plain->subjects && is_faithful(l->plain, &worlds),
       "%s says what it takes, and refuses what it does not take",
       l->plain->name);
  close_worlds(&worlds);
  return finish(&tap);
}
