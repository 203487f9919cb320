/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What Sutherland et al. 1974 claim about the scan-line algorithms, checked by
 * their counts: "Scan-line Algorithms" for Bouknight and Watkins, "An Untried
 * Sorting Order" for yzx.
 *
 * Spans       Watkins has more sample spans than Bouknight in no view of any
 *             built-in scene. He has fewer, over the views of a scene, in each
 *             scene where a segment hides an end of another. If no end is
 *             hidden (the sphere), both have the same number. The sample spans
 *             of yzx are the visible segments, the fewest possible.
 * Divisions   Watkins' logarithmic search seldom computes a depth that was not
 *             given: over all these pictures less than a third of its
 *             comparisons are followed by a division.
 * Lines       Take a scene whose faces are many lines tall, with four times as
 *             many lines of four times as many samples. Then yzx makes about as
 *             many comparisons in depth to sort faces, and seeks a place for
 *             less than twice as many segments. Watkins' depth search grows at
 *             least threefold.
 * Coherence   If no ends cross, yzx compares nothing in depth after the first line,
 *             and keeps all places: it compares no priorities there either.
 * Z before X  yzx compares faces in depth as they enter, so each that enters is
 *             compared with all that are active: as many as enter times those
 *             that are there.
 */
#include "bench/modules/modules.h"
#include "scenes/scenes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { VIEWS = 3, M = 97, N = 61, LARGEST = 512 };

static uint32_t ids[LARGEST * LARGEST];

struct picture {
  struct hsr_scene *scene;
  struct hsr_world world;
  struct hsr_view view;
};

static void open_picture(struct picture *p, const char *name) {
  p->scene = must_open(name);
  must_world(&p->world, p->scene);
}

static void set_view(struct picture *p, uint32_t view, int m, int n) {
  must_view(&p->view, &p->scene->views[view], m, n);
}

static void close_picture(struct picture *p) {
  hsr_world_free(&p->world);
  hsr_scene_delete(p->scene);
}

/* What an algorithm counts as it draws a picture. */
struct count {
  const struct hsr_algorithm *algorithm;
  struct hsr_tally tally;
};

static struct count draw(const char *algorithm, const struct picture *p) {
  struct count count = {hsr_algorithm_find(algorithm)->counting,
                        {.out_of_memory = false}};
  draw_ids(count.algorithm, &p->world, &p->view, ids, &count.tally);
  return count;
}

static uint64_t of(const struct count *count, const char *counter) {
  return counted(count->algorithm, &count->tally, counter);
}

/* --- Sample spans --------------------------------------------------------- */

/* The number of runs of one id in the rows of the picture drawn last. */
static uint64_t count_runs(const struct hsr_view *view) {
  uint64_t runs = 0;
  for (int j = 0; j < view->n; j++)
    for (int i = 0; i < view->m; i++) {
      const uint32_t *id = &ids[j * view->m + i];
      runs += !i || id[0] != id[-1];
    }
  return runs;
}

/* Whether no end is hidden in the views of a scene. */
static bool shows_all(const char *scene) {
  return !strcmp(scene, "sphere") || !strcmp(scene, "t-junction") ||
         !strcmp(scene, "sub-pixel-gap") || !strcmp(scene, "color-sides") ||
         !strcmp(scene, "checker-plane");
}

struct searches {
  uint64_t comparisons, divisions;
};

static void try_spans(struct tap *tap, const struct hsr_builtin *builtin,
                      struct searches *searches) {
  struct picture p;
  uint64_t watkins = 0, bouknight = 0;
  bool never_more = true, fewest = true;
  open_picture(&p, builtin->name);
  for (uint32_t v = 0; v < VIEWS && v < p.scene->n_views; v++) {
    set_view(&p, v, M, N);
    struct count b = draw("bouknight", &p), w = draw("watkins", &p),
                 y = draw("yzx", &p);
    watkins += of(&w, "spans");
    bouknight += of(&b, "spans");
    never_more &= of(&w, "spans") <= of(&b, "spans");
    fewest &= of(&y, "spans") == count_runs(&p.view);
    searches->comparisons += of(&w, "depth search");
    searches->divisions += of(&w, "depth divisions");
  }
  ok(tap,
     never_more && fewest && (watkins < bouknight || shows_all(builtin->name)),
     "%s: %llu spans by Watkins, %llu by Bouknight", builtin->name,
     (unsigned long long)watkins, (unsigned long long)bouknight);
  close_picture(&p);
}

/* Not big-harbor, which is the harbor and takes long; nor the towers, which are
 * too large to be laid out; nor what a package brings, which may not be there.
 */
static bool is_tried(const struct hsr_builtin *builtin) {
  return !builtin->package && strcmp(builtin->name, "big-harbor") != 0 &&
         strncmp(builtin->name, "tower", 5) != 0;
}

static int count_tried(void) {
  int n = 0;
  for (const struct hsr_builtin *b = hsr_builtins; b->name; b++)
    n += is_tried(b);
  return n;
}

static void try_all_scenes(struct tap *tap) {
  struct searches searches = {0, 0};
  for (const struct hsr_builtin *b = hsr_builtins; b->name; b++)
    if (is_tried(b))
      try_spans(tap, b, &searches);
  ok(tap,
     searches.comparisons > 10000 &&
         3 * searches.divisions < searches.comparisons,
     "%llu divisions in %llu comparisons of Watkins' depth search",
     (unsigned long long)searches.divisions,
     (unsigned long long)searches.comparisons);
}

/* --- Lines ---------------------------------------------------------------- */

static const char *const tall[] = {
    "house",      "cyclic-overlap",  "penetration",   "coplanar",
    "one-sided",  "collinear-edges", "huge-and-tiny", "behind-eye",
    "near-plane", "eye-in-plane"};
enum { N_TALL = sizeof tall / sizeof tall[0] };

struct effort {
  uint64_t search, sort, sought, segments;
};

static struct effort effort_at(struct picture *p, int size) {
  set_view(p, 0, size, size);
  struct count w = draw("watkins", p), y = draw("yzx", p);
  return (struct effort){
      of(&w, "depth search"), of(&y, "Z minimax") + of(&y, "Z sort"),
      of(&y, "segments") - of(&y, "places kept"), of(&y, "segments")};
}

static void try_lines(struct tap *tap, const char *name) {
  struct picture p;
  open_picture(&p, name);
  struct effort few = effort_at(&p, LARGEST / 4), many = effort_at(&p, LARGEST);
  ok(tap,
     many.segments > 3 * few.segments && many.search > 3 * few.search &&
         4 * many.sort < 5 * few.sort && many.sought < 2 * few.sought,
     "%s: %llu -> %llu comparisons to sort, %llu -> %llu places sought; "
     "Watkins %llu -> %llu",
     name, (unsigned long long)few.sort, (unsigned long long)many.sort,
     (unsigned long long)few.sought, (unsigned long long)many.sought,
     (unsigned long long)few.search, (unsigned long long)many.search);
  close_picture(&p);
}

/* --- Coherence ------------------------------------------------------------ */

/* Upright rectangles behind one another, of the same height on the screen, so
 * that all begin and end on the same lines and no ends cross:
 *
 *      +------+----+------+
 *      |  +---|-+  |      |
 *      |  |   | |  |      |      */
static struct hsr_scene *deck(int n_cards) {
  struct hsr_scene *scene = hsr_scene_new("deck");
  struct hsr_object *object = hsr_scene_object(scene, "cards");
  struct hsr_error err = {.text = "out of memory"};
  for (int k = 0; k < n_cards; k++) {
    double depth = 4 + k;
    double x0 = (k * 7 % 10 - 11) * depth / 16,
           x1 = (k * 3 % 10 + 2) * depth / 16, y = 0.7 * depth;
    const double corner[4][2] = {{x0, -y}, {x1, -y}, {x1, y}, {x0, y}};
    uint32_t vertex[4];
    for (int c = 0; c < 4; c++)
      hsr_object_vertex(object, corner[c][0], corner[c][1], -depth, &vertex[c]);
    hsr_object_face(object, vertex, 4, NULL);
  }
  const struct hsr_camera camera = {
      .at = {0, 0, -1}, .up = {0, 1, 0}, .fov = 90};
  if (hsr_scene_view(scene, &camera))
    bail("deck: %s", err.text);
  must_finish(scene);
  return scene;
}

static void try_deck(struct tap *tap) {
  enum { CARDS = 10 };
  struct picture p = {.scene = deck(CARDS)};
  must_world(&p.world, p.scene);
  set_view(&p, 0, M, N);
  struct count y = draw("yzx", &p);
  uint64_t lines = of(&y, "segments") / CARDS;
  ok(tap,
     lines > N / 2 && of(&y, "segments") == lines * CARDS &&
         of(&y, "places kept") == (lines - 1) * CARDS &&
         of(&y, "priority tests") <= CARDS * (CARDS - 1) / 2 &&
         of(&y, "Z sort") == 0 &&
         of(&y, "minimax tests") == CARDS * (CARDS - 1) &&
         of(&y, "Z minimax") == CARDS * (CARDS - 1) / 2,
     "a deck of %d: %llu comparisons in %llu lines", (int)CARDS,
     (unsigned long long)of(&y, "Z minimax"), (unsigned long long)lines);
  close_picture(&p);
}

/* No two faces of a convex solid that are seen from their fronts overlap. So
 * none is divided, and no two are involved at once. Two whose boxes overlap are told
 * apart by a plane, in one of two orders that both hold; so a few may be moved. */
static void try_sphere(struct tap *tap) {
  struct picture p;
  open_picture(&p, "sphere");
  set_view(&p, 0, M, N);
  struct count y = draw("yzx", &p);
  ok(tap,
     of(&y, "segments") > 500 && of(&y, "divisions") == 0 &&
         100 * of(&y, "interchanges") < of(&y, "Y order") &&
         of(&y, "implied edges") == 0 && of(&y, "priority tests") == 0,
     "a sphere: no priority is compared in %llu segments",
     (unsigned long long)of(&y, "segments"));
  close_picture(&p);
}

int main(void) {
  struct tap tap = plan(count_tried() + 1 + N_TALL + 2);
  try_all_scenes(&tap);
  for (int k = 0; k < N_TALL; k++)
    try_lines(&tap, tall[k]);
  try_deck(&tap);
  try_sphere(&tap);
  return finish(&tap);
}
