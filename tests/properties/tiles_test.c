/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tiles of pictures. Every algorithm that draws samples or splats draws the
 * tiles of a picture, of sizes that do not divide it; put together, they are
 * the picture. In tiles of pictures with up to 2^20 samples a side, where no whole
 * picture can be drawn, all algorithms agree with the oracle. And the files of
 * tiles are joined to one file, which is the same each time. */
#include "bench/modules/modules.h"
#include "algorithms/setup.h"
#include "common/answers/kinds/composited.h"
#include "common/answers/kinds/shadowed.h"
#include "common/answers/kinds/transparent.h"
#include "common/exact/footprint.h"
#include "common/files/image.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { M = 45, N = 38, MOST_SIDE = 32, BIG = 24 };
static const int sides[] = {13, MOST_SIDE};
enum { N_SIDES = sizeof sides / sizeof *sides };

static const char *const names[] = {"house", "soup:60:3", "lattice:40:1",
                                    "penetration", "grid:4:1"};
enum { N_SCENES = sizeof names / sizeof *names };

struct stand {
  const char *name;
  struct both_worlds worlds;
  struct hsr_setup oracle;
};

static struct tap tap;

/* Draws one view into ids of its size. */
static enum hsr_status draw_view(const struct hsr_setup *setup,
                                 const struct hsr_view *view, uint32_t *ids) {
  struct hsr_answer answer = hsr_answer_of_ids(ids, view->m, view->n);
  struct hsr_arena scratch = HSR_ARENA_EMPTY;
  struct hsr_tally tally = {.work = NULL};
  struct hsr_job job = {
      .view = view, .scratch = &scratch, .tally = &tally, .answer = &answer};
  memset(ids, 0xfe, (size_t)view->m * (size_t)view->n * sizeof *ids);
  enum hsr_status status = hsr_setup_render(setup, &job, NULL);
  hsr_arena_free(&scratch);
  return status;
}

/* How many samples of all tiles differ from the whole picture; -1 if the
 * algorithm fails. */
static long compare_tiles(const struct hsr_setup *setup,
                          const struct hsr_camera *camera, int side) {
  uint32_t whole[M * N], part[MOST_SIDE * MOST_SIDE];
  const struct hsr_tile_grid tiling = {M, N, side};
  struct hsr_view view;
  long wrong = 0;
  if (hsr_view_init(&view, camera, M, N, NULL) ||
      draw_view(setup, &view, whole))
    return -1;
  for (long k = 0; k < hsr_tile_count(&tiling); k++) {
    struct hsr_window tile = hsr_tile_window(&tiling, k);
    if (hsr_view_init_tile(&view, camera, M, N, &tile, NULL) ||
        draw_view(setup, &view, part))
      return -1;
    for (int j = 0; j < view.n; j++)
      for (int i = 0; i < view.m; i++)
        wrong += part[j * view.m + i] != whole[(tile.y0 + j) * M + tile.x0 + i];
  }
  return wrong;
}

/* A tile of a large picture, in the middle half, where there is more to see. */
static struct hsr_window choose_tile(uint64_t *seed, int m, int n) {
  int x = (int)draw_integer(seed, m / 4, 3 * m / 4 - BIG);
  int y = (int)draw_integer(seed, n / 4, 3 * n / 4 - BIG);
  return (struct hsr_window){x, y, x + BIG, y + BIG};
}

static long compare_with_oracle(const struct hsr_setup *setup,
                                const struct hsr_setup *oracle,
                                const struct hsr_camera *camera,
                                uint64_t seed) {
  uint32_t got[BIG * BIG], wanted[BIG * BIG];
  long wrong = 0;
  for (int k = 0; k < 6; k++) {
    int m = (int)draw_integer(&seed, 1000, HSR_MAX_WHOLE);
    int n =
        k % 2 ? HSR_MAX_WHOLE : (int)draw_integer(&seed, 1000, HSR_MAX_WHOLE);
    if (k < 2)
      m = n = 200; /* where a tile sees several faces */
    struct hsr_window tile = choose_tile(&seed, m, n);
    struct hsr_view view;
    if (hsr_view_init_tile(&view, camera, m, n, &tile, NULL) ||
        draw_view(setup, &view, got) || draw_view(oracle, &view, wanted))
      return -1;
    for (int s = 0; s < BIG * BIG; s++)
      wrong += got[s] != wanted[s];
  }
  return wrong;
}

static void test_algorithm(const struct hsr_algorithm *a, void *context) {
  const struct stand *stand = context;
  struct hsr_camera cameras[2] = {stand->worlds.scene->views[0],
                                  stand->worlds.scene->views[0]};
  cameras[1].parallel = 3;
  struct hsr_setup setup;
  enum hsr_status status =
      hsr_setup_init(&setup, a, NULL, &stand->worlds.world, NULL);
  for (int c = 0; c < 2; c++) {
    long tiles = status && status != HSR_E_REFUSED, large = 0;
    for (int k = 0; k < N_SIDES && !status; k++)
      tiles += compare_tiles(&setup, &cameras[c], sides[k]) != 0;
    if (!status)
      large = compare_with_oracle(&setup, &stand->oracle, &cameras[c],
                                  7 + (uint64_t)c);
    ok(&tap, !tiles && !large,
       "%s, %s%s%s: tiles of %ld sizes differ, %ld samples of large pictures",
       a->name, stand->name, c ? ", parallel" : "", status ? ", refused" : "",
       tiles, large);
  }
  hsr_setup_free(&setup);
}

static void test_scene(const char *name) {
  struct stand stand = {.name = name};
  open_worlds(&stand.worlds, name);
  if (hsr_setup_init(&stand.oracle, hsr_algorithm_find("oracle")->plain, NULL,
                     &stand.worlds.world, NULL))
    ok(&tap, false, "the oracle is ready for %s", name);
  for_each_judged(test_algorithm, &stand);
  hsr_setup_free(&stand.oracle);
  close_worlds(&stand.worlds);
}

/* --- Other kinds of answers ----------------------------------------------- */

/* Whether place k of one answer is place l of another. */
static bool is_same(const struct hsr_answer *a, size_t k,
                    const struct hsr_answer *b, size_t l) {
  const struct hsr_shadowed *p = hsr_answer_shadowed_of(a),
                            *q = hsr_answer_shadowed_of(b);
  if (p && q)
    return p->ids[k] == q->ids[l] && p->lit[k] == q->lit[l];
  bool splats = a->form.type == HSR_COMPOSITED;
  size_t channels = splats ? 4 : 3;
  const uint16_t *x = splats ? hsr_answer_rgba_of(a) : hsr_answer_colours_of(a),
                 *y = splats ? hsr_answer_rgba_of(b) : hsr_answer_colours_of(b);
  return !memcmp(x + channels * k, y + channels * l, channels * sizeof *x);
}

/* How many places of all tiles differ from the whole picture. *refused: the
 * algorithm does not take the scene. */
static long compare_parts(const struct hsr_algorithm *a,
                          const struct hsr_choice *choice,
                          const struct hsr_world *world,
                          const struct hsr_camera *camera, bool *refused) {
  struct hsr_answer whole, part;
  struct hsr_view view;
  long wrong = hsr_view_init(&view, camera, M, N, NULL) != HSR_OK;
  *refused = wrong || !draw_chosen(a, choice, world, &view, &whole, NULL);
  for (int s = 0; s < N_SIDES && !*refused; s++) {
    const struct hsr_tile_grid tiling = {M, N, sides[s]};
    for (long k = 0; k < hsr_tile_count(&tiling); k++) {
      struct hsr_window tile = hsr_tile_window(&tiling, k);
      wrong += hsr_view_init_tile(&view, camera, M, N, &tile, NULL) ||
               !draw_chosen(a, choice, world, &view, &part, NULL);
      for (int j = 0; j < view.n; j++)
        for (int i = 0; i < view.m; i++)
          wrong += !is_same(&part, (size_t)(j * view.m + i), &whole,
                            (size_t)((tile.y0 + j) * M + tile.x0 + i));
      hsr_answer_free(&part);
    }
  }
  hsr_answer_free(&whole);
  return wrong;
}

static bool makes(const struct hsr_algorithm *a,
                  const struct hsr_answer_type *kind) {
  return !(a->flags & HSR_JUDGE) &&
         (hsr_own_kind(a) == kind || hsr_makes_also(a, kind));
}

/* The standard choice, but that splats are as far apart as pixels, of which each
 * tile has fewer than the picture. */
static struct hsr_choice choose(const struct hsr_algorithm *a,
                                const struct hsr_answer_type *kind) {
  struct hsr_choice choice =
      hsr_own_kind(a) == kind ? hsr_choice_standard(a) : choose_also(a, kind);
  for (int k = 0; kind->options[k].name; k++)
    if (!strcmp(kind->options[k].name, "antialias"))
      choice.form.values.option[k] = true;
  return choice;
}

/* `begin` begins the names of those that are tested. */
static void test_kind(const struct hsr_answer_type *kind, const char *begin,
                      const char *name) {
  struct both_worlds worlds;
  open_worlds(&worlds, name);
  struct hsr_camera camera = worlds.scene->views[0];
  double far =
      hypot(hypot(camera.eye[0] - camera.at[0], camera.eye[1] - camera.at[1]),
            camera.eye[2] - camera.at[2]);
  for (const struct hsr_listed *l = hsr_algorithms(); l->plain; l++)
    for (int c = 0; c < 2; c++) {
      const struct hsr_algorithm *a = l->counting;
      if (!makes(a, kind) || strncmp(a->name, begin, strlen(begin)))
        continue;
      struct hsr_choice choice = choose(a, kind);
      bool refused;
      camera.parallel = c ? far / 2 : 0;
      long wrong = compare_parts(a, &choice, &worlds.world, &camera, &refused);
      ok(&tap, !wrong && !refused, "%s, %s, %s%s: %ld places of tiles differ",
         a->name, kind->name, name, c ? ", parallel" : "", wrong);
    }
  close_worlds(&worlds);
}

/* The exact footprints of splats, at the pixels of a tile and of its picture. */
static void test_footprints(bool parallel) {
  struct hsr_camera camera = {.eye = {3, 4, 9},
                              .up = {0, 1, 0},
                              .fov = 40,
                              .parallel = parallel ? 6 : 0};
  const struct hsr_window tile = {13, 7, 29, 26};
  struct hsr_view whole, part;
  bool out_of_memory = hsr_view_init(&whole, &camera, M, N, NULL) ||
                       hsr_view_init_tile(&part, &camera, M, N, &tile, NULL);
  uint64_t seed = 3;
  long wrong = 0, covered = 0;
  for (int k = 0; k < 4000 && !out_of_memory; k++) {
    struct hsr_splat splat = {.view = &whole, .width = 1, .antialias = k % 2};
    for (int a = 0; a < 3; a++) {
      splat.at[a] = (double)draw_integer(&seed, -64, 64) / 32;
      splat.size[a] = (double)draw_integer(&seed, 1, 16) / 16;
    }
    int i = (int)draw_integer(&seed, 0, part.m - 1),
        j = (int)draw_integer(&seed, 0, part.n - 1);
    uint32_t energy = hsr_exact_energy(&splat, &out_of_memory);
    int index =
        hsr_exact_footprint(&splat, tile.x0 + i, tile.y0 + j, &out_of_memory);
    splat.view = &part;
    wrong += energy != hsr_exact_energy(&splat, &out_of_memory) ||
             index != hsr_exact_footprint(&splat, i, j, &out_of_memory);
    covered += index < HSR_FOOTPRINT;
  }
  ok(&tap, !wrong && covered > 20 && !out_of_memory,
     "of %ld exact footprints%s, %ld differ", covered,
     parallel ? ", parallel" : "", wrong);
}

/* --- Files ---------------------------------------------------------------- */

enum { WIDE = 700, HIGH = 530 };

static const char *name_tile(void *whom, long k) {
  static char name[100];
  snprintf(name, sizeof name, "%s.%ld.exr", (const char *)whom, k);
  return name;
}

/* Joins `ids` to WHOM.exr by tiles of a size. */
static enum hsr_status join_by(int side, char *whom, const uint32_t *ids) {
  const struct hsr_tile_grid tiling = {WIDE, HIGH, side};
  static uint32_t part[WIDE * HIGH];
  static char path[100];
  enum hsr_status status = HSR_OK;
  for (long k = 0; k < hsr_tile_count(&tiling) && !status; k++) {
    struct hsr_window w = hsr_tile_window(&tiling, k);
    for (int j = w.y0; j < w.y1; j++)
      memcpy(part + (j - w.y0) * (w.x1 - w.x0), ids + j * WIDE + w.x0,
             (size_t)(w.x1 - w.x0) * sizeof *ids);
    status =
        hsr_image_write_tile(name_tile(whom, k), &tiling, k, part, NULL, NULL);
  }
  snprintf(path, sizeof path, "%s.exr", whom);
  if (!status)
    status =
        hsr_image_join_tiles(path, &tiling, name_tile, whom, "Scene=s", NULL);
  for (long k = 0; k < hsr_tile_count(&tiling); k++)
    remove(name_tile(whom, k));
  return status;
}

static bool are_equal_files(const char *a, const char *b) {
  FILE *p = fopen(a, "rb"), *q = fopen(b, "rb");
  int c = 0, d = 0;
  while (p && q && c == d && c != EOF) {
    c = fgetc(p);
    d = fgetc(q);
  }
  if (p)
    fclose(p);
  if (q)
    fclose(q);
  return p && q && c == d;
}

/* OpenImageIO's numbers are shares of the greatest. */
static bool holds(const char *path, const uint32_t *ids) {
  uint32_t size[2] = {0, 0};
  float *read = NULL;
  bool good = !hsr_image_read(path, false, size, &read, NULL) &&
              size[0] == WIDE && size[1] == HIGH;
  for (int k = 0; good && k < WIDE * HIGH; k++)
    good = lround(read[k] * (double)UINT32_MAX) == (long)ids[k];
  free(read);
  return good;
}

static void test_files(void) {
  static uint32_t ids[WIDE * HIGH];
  char dir[] = "/tmp/tiles.XXXXXX", one[100], other[100], file[2][110];
  uint64_t seed = 5;
  for (int k = 0; k < WIDE * HIGH; k++)
    ids[k] = k % 97 ? ids[k - 1] : (uint32_t)draw_integer(&seed, 0, 1 << 23);
  if (!ok(&tap, mkdtemp(dir), "a folder"))
    return;
  snprintf(one, sizeof one, "%s/a", dir);
  snprintf(other, sizeof other, "%s/b", dir);
  snprintf(file[0], sizeof file[0], "%s.exr", one);
  snprintf(file[1], sizeof file[1], "%s.exr", other);
  ok(&tap, !join_by(HSR_TILE_GRAIN, one, ids), "tiles are joined");
  ok(&tap, !join_by(HSR_TILE_GRAIN, other, ids), "they are joined again");
  ok(&tap, are_equal_files(file[0], file[1]), "both files are the same");
  ok(&tap, holds(file[0], ids), "the file holds the ids");
  ok(&tap, !join_by(2 * HSR_TILE_GRAIN, other, ids), "larger tiles are joined");
  ok(&tap, holds(file[1], ids), "their file holds the ids");
  remove(file[0]);
  remove(file[1]);
  rmdir(dir);
}

static void test_ranges(void) {
  struct hsr_camera camera = {
      .eye = {0, 0, 5}, .at = {0, 0, 0}, .up = {0, 1, 0}, .fov = 40};
  struct hsr_view view;
  int most = HSR_MAX_WHOLE;
  struct hsr_window last = {most - 4, most - 4, most, most},
                    beyond = {most - 4, most - 4, most + 1, most},
                    none = {4, 4, 4, 8}, wide = {0, 0, HSR_MAX_SIZE + 1, 1};
  ok(&tap, !hsr_view_init_tile(&view, &camera, most, most, &last, NULL),
     "the last tile of the largest picture");
  ok(&tap,
     hsr_view_init_tile(&view, &camera, most, most, &beyond, NULL) ==
         HSR_E_USAGE,
     "no tile reaches beyond the picture");
  ok(&tap,
     hsr_view_init_tile(&view, &camera, most + 1, most, &last, NULL) ==
         HSR_E_USAGE,
     "no picture is larger");
  ok(&tap,
     hsr_view_init_tile(&view, &camera, most, most, &none, NULL) == HSR_E_USAGE,
     "no tile is empty");
  ok(&tap,
     hsr_view_init_tile(&view, &camera, most, most, &wide, NULL) == HSR_E_USAGE,
     "no tile is wider than what is drawn at once");
}

static void count_one(const struct hsr_algorithm *a, void *n) {
  (void)a;
  ++*(int *)n;
}

static int count_makers(const struct hsr_answer_type *kind) {
  int n = 0;
  for (const struct hsr_listed *l = hsr_algorithms(); l->plain; l++)
    n += makes(l->counting, kind);
  return n;
}

int main(void) {
  int builds = 0;
  for_each_judged(count_one, &builds);
  int others = count_makers(HSR_TRANSPARENT) + count_makers(HSR_SHADOWED) +
               count_makers(HSR_COMPOSITED);
  tap = plan(14 + 2 * (N_SCENES * builds + others)); /* of 2 cameras */
  test_ranges();
  test_footprints(false);
  test_footprints(true);
  test_files();
  for (int k = 0; k < N_SCENES; k++)
    test_scene(names[k]);
  test_kind(HSR_TRANSPARENT, "", "greenhouse");
  test_kind(HSR_SHADOWED, "", "house");
  test_kind(HSR_COMPOSITED, "splat", "checker-cube:40");
  test_kind(HSR_COMPOSITED, "texture", "checker-plane");
  return finish(&tap);
}
