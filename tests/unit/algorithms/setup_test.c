/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Algorithms take the subjects of scenes that they name, and refuse others. */
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <stdlib.h>
#include <string.h>

static bool takes(const struct hsr_algorithm *a,
                  enum hsr_scene_subject subject) {
  return a->subjects & 1u << subject;
}

/* Whether a world is refused for these words. */
static bool is_refused(const struct hsr_algorithm *a,
                       const struct hsr_world *world, const char *words) {
  struct hsr_error err = {.text = ""};
  struct hsr_setup setup;
  enum hsr_status status = hsr_setup_init(&setup, a, NULL, world, &err);
  hsr_setup_free(&setup);
  return status == HSR_E_REFUSED && strstr(err.text, words);
}

static const char grid_only[] = "the scene is faces, which ";
static const char too_many[] = "faces are too many";
static const char not_taken[] = "does not take";

/* Faces are refused by what takes grids only. A grid is refused by nobody if
 * its faces are made; if not, by what takes faces only. */
static bool is_faithful(const struct hsr_algorithm *a,
                        const struct both_worlds *faces,
                        const struct both_worlds *cells,
                        const struct hsr_world *bare) {
  bool good = is_refused(a, &faces->world, grid_only) == !takes(a, HSR_FACES);
  good &= !is_refused(a, &cells->world, not_taken) &&
          !is_refused(a, &cells->world, too_many);
  return good && is_refused(a, bare, too_many) == !takes(a, HSR_GRID);
}

/* A world of a grid whose faces are not made. */
static void open_bare(struct hsr_scene **scene, struct hsr_world *world) {
  struct hsr_error err;
  if (hsr_scene_open("checker-cube:4", NULL, scene, &err) ||
      hsr_world_outline(world, *scene, &err) ||
      !hsr_scene_lacks_faces(*scene)) {
    printf("Bail out! no grid\n");
    exit(99);
  }
}

int main(void) {
  struct both_worlds faces, cells;
  struct hsr_scene *scene;
  struct hsr_world bare;
  open_worlds(&faces, "house");
  open_worlds(&cells, "checker-cube:4");
  open_bare(&scene, &bare);
  int n = 0;
  for (const struct hsr_listed *l = hsr_algorithms; l->plain; l++)
    n++;
  struct tap tap = plan(n);
  for (const struct hsr_listed *l = hsr_algorithms; l->plain; l++)
    ok(&tap, l->plain->subjects && is_faithful(l->plain, &faces, &cells, &bare),
       "%s says what it takes, and refuses what it does not take",
       l->plain->name);
  hsr_world_free(&bare);
  hsr_scene_delete(scene);
  close_worlds(&cells);
  close_worlds(&faces);
  return finish(&tap);
}
