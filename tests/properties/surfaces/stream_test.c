/* SPDX-License-Identifier: GPL-3.0-or-later */
/* zbuffer-fast draws a scene from a roster as it draws it laid out: the same
 * ids, and as many faces in floats, the general way and in doubt. Other counts
 * depend on the order of faces: those that take the general way come at the end
 * of a batch, and here batches end with instances.
 *
 * Pictures    of triangles and of polygons, of one object and of many
 *             instances, before the eye and behind it, past near; in
 *             perspective and in parallel; in windows; with samples on the
 *             tiler's grid and beside it.
 * Choices     what needs the scene laid out takes no roster: glass, shadows,
 *             and groups. Which scenes come as a roster. */
#include "algorithms/engines/tiler/tiler.h"
#include "bench/modules/variant.h"
#include "tests/draw.h"
#include "tests/tap.h"
#include "common/answers/kinds/shadowed.h"
#include "common/answers/kinds/transparent.h"

#include <stdlib.h>
#include <string.h>

enum { M = 97, N = 62 };

struct drawn {
  uint32_t ids[M * N];
  struct hsr_tally tally;
};

static void draw_from(const struct hsr_algorithm *a,
                      const struct hsr_world *world,
                      const struct hsr_view *view, struct drawn *drawn) {
  memset(drawn, 0, sizeof *drawn);
  draw_ids(a, world, view, drawn->ids, &drawn->tally);
}

/* How many samples and counters differ. */
static long compare(const struct hsr_algorithm *a,
                    const struct both_worlds *worlds,
                    const struct hsr_view *view) {
  static const int same[] = {HSR_FAST, HSR_GENERAL, HSR_UNSURE_COVER};
  static struct drawn laid_out, streamed;
  draw_from(a, &worlds->world, view, &laid_out);
  draw_from(a, &worlds->roster, view, &streamed);
  long differ = count_differences(view, laid_out.ids, streamed.ids);
  for (size_t k = 0; k < sizeof same / sizeof *same; k++)
    differ += hsr_tally_count(&laid_out.tally, same[k]) !=
              hsr_tally_count(&streamed.tally, same[k]);
  return differ;
}

/* The whole picture, a window of it, and with samples beside the grid. */
static long compare_views(const struct both_worlds *worlds,
                          const struct hsr_camera *camera) {
  const struct hsr_listed *zbuffer = hsr_algorithm_find("zbuffer-fast");
  struct hsr_view view;
  struct hsr_error err;
  long differ = 0;
  if (hsr_view_init(&view, camera, M, N, &err))
    return 1;
  differ += compare(zbuffer->plain, worlds, &view);
  differ += compare(zbuffer->counting, worlds, &view);
  view.window = (struct hsr_window){M / 3, N / 4, M - 7, N - 5};
  differ += compare(zbuffer->plain, worlds, &view);
  view.offset_x = 0x1p-20;
  differ += compare(zbuffer->plain, worlds, &view);
  return differ + compare(zbuffer->counting, worlds, &view);
}

static void test_scene(struct tap *tap, const char *name) {
  struct both_worlds worlds;
  uint64_t seed = 3;
  long differ = 0;
  open_worlds(&worlds, name);
  for (uint32_t v = 0; v < worlds.scene->n_views && v < 8; v++) {
    struct hsr_camera camera = worlds.scene->views[v];
    differ += compare_views(&worlds, &camera);
    camera.near = v % 2 ? 0.7 : 0;
    draw_parallel(&seed, &camera, N);
    differ += compare_views(&worlds, &camera);
  }
  ok(tap, !differ, "%s: from its outline, %ld samples and counts differ", name,
     differ);
  close_worlds(&worlds);
}

static bool is_refused(const struct hsr_choice *choice,
                       const struct hsr_world *world) {
  struct hsr_setup setup;
  struct hsr_error err;
  enum hsr_status status = hsr_setup_init(
      &setup, hsr_algorithm_find("zbuffer-fast")->plain, choice, world, &err);
  hsr_setup_free(&setup);
  return status == HSR_E_REFUSED;
}

static void test_choice(struct tap *tap, const struct both_worlds *worlds,
                        const struct hsr_choice *choice, const char *what) {
  const struct hsr_algorithm *a = hsr_algorithm_find("zbuffer-fast")->plain;
  ok(tap,
     is_refused(choice, &worlds->roster) &&
         !is_refused(choice, &worlds->world) &&
         hsr_most_laid_out(a, choice) == HSR_MOST_LAID_OUT,
     "%s: the scene is laid out", what);
}

static void test_choices(struct tap *tap) {
  const struct hsr_algorithm *a = hsr_algorithm_find("zbuffer-fast")->plain;
  struct hsr_choice glass = choose_also(a, HSR_TRANSPARENT),
                    shadows = choose_also(a, HSR_SHADOWED),
                    groups = hsr_choice_standard(a);
  struct both_worlds worlds;
  open_worlds(&worlds, "soup:100");
  groups.values.option[0] = 1;
  test_choice(tap, &worlds, &glass, "glass");
  test_choice(tap, &worlds, &shadows, "shadows");
  test_choice(tap, &worlds, &groups, "groups");
  ok(tap,
     !is_refused(NULL, &worlds.roster) &&
         hsr_most_laid_out(a, NULL) == HSR_LARGE,
     "many faces come as an outline");
  struct hsr_world larger = worlds.roster;
  larger.n_faces = HSR_MOST_LAID_OUT + 1;
  ok(tap, is_refused(NULL, &larger), "and too many are refused");
  close_worlds(&worlds);
}

int main(void) {
  static const char *const scenes[] = {
      "house",         "cyclic-overlap", "coplanar",  "penetration",
      "near-plane",    "behind-eye",     "sliver",    "needle-fan",
      "lattice:40:3",  "soup:3000",      "soup:60:5", "sphere:2000",
      "huge-and-tiny", "harbor:400",     "office:1",  "terrain:8:2",
      "tower:4",       "color-cube:3"};
  enum { SCENES = sizeof scenes / sizeof *scenes };
  struct tap tap = plan(SCENES + 5);
  for (size_t k = 0; k < SCENES; k++)
    test_scene(&tap, scenes[k]);
  test_choices(&tap);
  return finish(&tap);
}
