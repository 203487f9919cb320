/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Algorithms take the subjects of scenes that they name, and refuse others. Those
 * that follow keep what they have prepared in another frame. */
#include "bench/modules/variant.h"
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
  *scene = must_open("checker-cube:4");
  must_roster(world, *scene);
  if (!hsr_scene_lacks_faces(*scene))
    bail("no grid");
}

enum { M = 40, N = 30 };

/* Whether the picture of a world is right. */
static bool is_right(const struct hsr_setup *setup,
                     const struct both_worlds *at) {
  static uint32_t ids[M * N], wanted[M * N];
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  struct hsr_error err;
  struct hsr_view view;
  struct hsr_tally tally = {.out_of_memory = false};
  if (hsr_view_init(&view, &at->scene->views[0], M, N, &err))
    return false;
  struct hsr_answer answer = hsr_answer_of_ids(ids, M, N);
  struct hsr_job job = {
      .view = &view, .scratch = &scratch, .tally = &tally, .answer = &answer};
  enum hsr_status status = hsr_setup_render(setup, &job, &err);
  draw_plain("oracle", &at->world, &view, wanted);
  hsr_arena_free(&scratch);
  return !status && !memcmp(ids, wanted, sizeof ids);
}

/* Goes from the first world to one of as many faces, and to one of more. */
static void test_follow(struct tap *tap, const char *text, bool follows) {
  struct both_worlds at[3];
  struct hsr_error err = {.text = ""};
  struct hsr_variant variant;
  struct hsr_setup setup;
  bool kept[2] = {false, true}, right[3];
  open_worlds(&at[0], "soup:60:1");
  open_worlds(&at[1], "soup:60:2");
  open_worlds(&at[2], "soup:90:2");
  if (hsr_variant_parse(text, &variant, &err))
    bail("%s: %s", text, err.text);
  must_setup(&setup, variant.listed->plain, &variant.choice, &at[0].world);
  const void *prepared = setup.prepared;
  right[0] = is_right(&setup, &at[0]);
  for (int k = 0; k < 2; k++)
    right[k + 1] =
        !hsr_setup_follow(&setup, &at[k + 1].world, &kept[k], &err) &&
        (k || !follows || setup.prepared == prepared) &&
        is_right(&setup, &at[k + 1]);
  ok(tap, right[0] && right[1] && right[2], "%s: three frames are right", text);
  ok(tap, kept[0] == follows && !kept[1],
     "%s: what is prepared %s in a frame of as many faces, and not in another",
     text, follows ? "is kept" : "is made anew");
  hsr_setup_free(&setup);
  for (int k = 0; k < 3; k++)
    close_worlds(&at[k]);
}

int main(void) {
  struct both_worlds faces, cells;
  struct hsr_scene *scene;
  struct hsr_world bare;
  open_worlds(&faces, "house");
  open_worlds(&cells, "checker-cube:4");
  open_bare(&scene, &bare);
  int n = 0;
  for (const struct hsr_listed *l = hsr_algorithms(); l->plain; l++)
    n++;
  struct tap tap = plan(n + 8);
  for (const struct hsr_listed *l = hsr_algorithms(); l->plain; l++)
    ok(&tap, l->plain->subjects && is_faithful(l->plain, &faces, &cells, &bare),
       "%s says what it takes, and refuses what it does not take",
       l->plain->name);
  test_follow(&tap, "newell-previous", true);
  test_follow(&tap, "warnock:regions=64", true);
  test_follow(&tap, "hzbuffer", false);
  test_follow(&tap, "schumacker", false);
  hsr_world_free(&bare);
  hsr_scene_delete(scene);
  close_worlds(&cells);
  close_worlds(&faces);
  return finish(&tap);
}
