/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What Sutherland et al. 1974 say about the algorithms that intersect edges,
 * checked by their counts: "Edge-Intersection Algorithms", "Edge Coherence",
 * "Other Combinations of Sorting".
 *
 * Promotion   If k solids that are apart lie wholly in the picture, there are k
 *             searches of all faces.
 * Natures     Vertex by vertex and interval by interval, the set of Galimberti
 *             and Montanari is as large as Appel's number. Their drawings
 *             agree.
 * Crossings   Loutrel's algorithm and Warnock's sorted edges confirm the same
 *             crossings with nearer contour edges as Appel's algorithm, and no
 *             others. Both find the same number of crossings in the plane.
 * Contours    With contour edges alone there are fewer pairs. The survey says
 *             that this saves about a fifth of the effort. Its own rules of
 *             thumb predict more: by these, E_c / E_s is 0.6, 0.4 and 0.2 on
 *             its three scenes.
 * Sorting     The comparisons that sort Warnock's edges grow less than with
 *             the square of the edges; Appel's pairs grow with the square.
 */
#include "bench/modules/modules.h"
#include "scenes/scenes.h"
#include "scenes/parts/shapes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { VIEWS = 2, M = 97, N = 61, MOST_SOLIDS = 12 };

/* What an algorithm counts as it draws. */
struct count {
  const struct hsr_algorithm *algorithm;
  struct hsr_tally tally;
};

static struct count draw_by(const struct hsr_algorithm *algorithm,
                            const struct hsr_world *world,
                            const struct hsr_view *view,
                            struct hsr_drawing *drawing) {
  struct count count = {algorithm, {.out_of_memory = false}};
  draw_lines(algorithm, world, view, drawing, &count.tally);
  return count;
}

static struct count draw(const char *algorithm, const struct hsr_world *world,
                         const struct hsr_view *view,
                         struct hsr_drawing *drawing) {
  return draw_by(hsr_algorithm_find(algorithm)->counting, world, view, drawing);
}

static uint64_t of(const struct count *count, const char *counter) {
  return counted(count->algorithm, &count->tally, counter);
}

/* --- Promotion ------------------------------------------------------------ */

/* Convex solids on a row of lots, some in front of others in the picture. */
static struct hsr_scene *solids_apart(int n, uint64_t *seed) {
  struct hsr_scene *scene = hsr_scene_new("solids apart");
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  for (int k = 0; k < n; k++) {
    hsr_pen_object(&pen, "solid", draw_integer(seed, 0, 1));
    double x = (double)draw_integer(seed, -3, 2);
    double y = (double)draw_integer(seed, -3, 2);
    double wide = (double)draw_integer(seed, 1, 3);
    if (draw_integer(seed, 0, 1))
      hsr_pen_box(&pen, x, y, -2 * k, x + wide, y + 1, 1 - 2 * k);
    else
      hsr_pen_extrusion(&pen, 3,
                        (const double[3][2]){{x, y}, {x + wide, y}, {x, y + 2}},
                        -2 * k, 1 - 2 * k);
    hsr_pen_place(&pen, NULL);
  }
  struct hsr_error err = {.text = "out of memory"};
  double eye[3] = {(double)draw_integer(seed, -2, 2),
                   (double)draw_integer(seed, -2, 2), 12};
  double at[3] = {eye[0], eye[1], 0};
  hsr_pen_view(&pen, eye, at, 90, 0);
  if (pen.status)
    bail("%s: %s", scene->name, err.text);
  must_finish(scene);
  return scene;
}

struct searches {
  const struct hsr_world *world;
  const struct hsr_view *view;
  struct hsr_drawing drawing;
  uint64_t wanted;
  bool agree;
};

static bool is_edge_intersection(const struct hsr_algorithm *a) {
  for (int k = 0; a->counters && a->counters[k].name; k++)
    if (!strcmp(a->counters[k].name, "searches"))
      return true;
  return false;
}

static void count_searches(const struct hsr_algorithm *algorithm,
                           struct searches *s) {
  struct count count = draw_by(algorithm, s->world, s->view, &s->drawing);
  s->agree &= of(&count, "searches") == s->wanted;
}

static void try_promotion(struct tap *tap) {
  uint64_t seed = 1;
  struct searches s = {.agree = true};
  for (int n = 1; n <= MOST_SOLIDS; n++) {
    struct hsr_scene *scene = solids_apart(n, &seed);
    struct hsr_world world;
    struct hsr_view view;
    must_world(&world, scene);
    must_view(&view, &scene->views[0], M, M);
    s.world = &world;
    s.view = &view;
    s.wanted = (uint64_t)n;
    for (const struct hsr_listed *a = all_listed(); a->plain; a++)
      if (is_edge_intersection(a->counting))
        count_searches(a->counting, &s);
    hsr_world_free(&world);
    hsr_scene_delete(scene);
  }
  hsr_drawing_free(&s.drawing);
  ok(tap, s.agree, "a search a solid, of 1 to %d solids", (int)MOST_SOLIDS);
}

/* --- Natures, crossings --------------------------------------------------- */

struct totals {
  uint64_t pairs, contour_pairs; /* of closed solids */
  double saved_least, saved_most;
};

static bool is_closed(const char *scene) {
  return !strcmp(scene, "house") || !strncmp(scene, "harbor", 6) ||
         !strcmp(scene, "color-cube") || !strcmp(scene, "sphere") ||
         !strncmp(scene, "twist", 5);
}

static void add_saving(struct totals *totals, uint64_t contour_pairs,
                       uint64_t pairs) {
  double saved = 1 - (double)contour_pairs / (double)pairs;
  totals->contour_pairs += contour_pairs;
  totals->pairs += pairs;
  totals->saved_least = fmin(totals->saved_least, saved);
  totals->saved_most = fmax(totals->saved_most, saved);
}

static void try_scene(struct tap *tap, const char *name,
                      struct totals *totals) {
  struct hsr_world world;
  struct hsr_drawing numbers = {.n = 0}, sets = {.n = 0}, other = {.n = 0};
  struct hsr_scene *scene = must_open(name);
  must_world(&world, scene);
  bool same_sizes = true, same_crossings = true;
  uint64_t crossings = 0, vertices = 0, hiding = 0;
  for (uint32_t v = 0; v < VIEWS && v < scene->n_views; v++) {
    struct hsr_view view;
    struct hsr_drawing_difference difference;
    must_view(&view, &scene->views[v], M, N);
    struct count a = draw("appel", &world, &view, &numbers);
    struct count g = draw("galimberti", &world, &view, &sets);
    struct count l = draw("loutrel", &world, &view, &other);
    struct count w = draw("warnock-edges", &world, &view, &other);
    hsr_drawing_compare(&sets, &numbers, false, &difference);
    same_sizes &= !difference.differing &&
                  of(&a, "promoted") == of(&g, "promoted") &&
                  of(&a, "hiding") == of(&g, "hiding");
    same_crossings &=
        of(&l, "crossings") == of(&a, "crossings") &&
        of(&w, "crossings") == of(&a, "crossings") &&
        of(&w, "crossings confirmed") == of(&l, "plane intersections") &&
        of(&w, "edge intersection") <= of(&a, "edge intersection");
    crossings += of(&a, "crossings");
    vertices += of(&g, "promoted");
    hiding += of(&g, "hiding");
    if (is_closed(name))
      add_saving(totals, of(&g, "contour pairs"), of(&g, "edge intersection"));
  }
  ok(tap, same_sizes, "%s: %.2f faces in a nature, of %llu vertices", name,
     vertices ? (double)hiding / (double)vertices : 0,
     (unsigned long long)vertices);
  ok(tap, same_crossings, "%s: %llu crossings", name,
     (unsigned long long)crossings);
  hsr_drawing_free(&numbers);
  hsr_drawing_free(&sets);
  hsr_drawing_free(&other);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
}

/* The form in which a scene is tried: those that take long are smaller or left
 * out, as is big-harbor, which is the harbor. */
static const char *tried(const struct hsr_builtin *builtin) {
  static const char *const smaller[][2] = {{"harbor", "harbor:1500"},
                                           {"twist", "twist:4"},
                                           {"terrain", "terrain:32"},
                                           {"soup", "soup:80:1"},
                                           {"lattice", "lattice:60:1"},
                                           {"big-harbor", NULL},
                                           {"office", NULL}};
  for (size_t k = 0; k < sizeof smaller / sizeof *smaller; k++)
    if (!strcmp(builtin->name, smaller[k][0]))
      return smaller[k][1];
  return builtin->only_by_name ? NULL : builtin->name;
}

static int count_tried(void) {
  int n = 0;
  for (const struct hsr_builtin *b = hsr_builtins; b->name; b++)
    n += tried(b) != NULL;
  return n;
}

static void try_all_scenes(struct tap *tap) {
  struct totals totals = {.saved_least = 1, .saved_most = 0};
  for (const struct hsr_builtin *b = hsr_builtins; b->name; b++)
    if (tried(b))
      try_scene(tap, tried(b), &totals);
  double saved = 1 - (double)totals.contour_pairs / (double)totals.pairs;
  ok(tap, totals.saved_least >= 0 && saved > 0.05 && saved < 0.95,
     "contour edges alone save %.0f %% of the pairs, from %.0f %% to %.0f %%",
     100 * saved, 100 * totals.saved_least, 100 * totals.saved_most);
}

/* --- Sorting -------------------------------------------------------------- */

struct effort {
  double edges, appel, sorted;
};

static struct effort effort_at(const char *name) {
  struct hsr_world world;
  struct hsr_view view;
  struct hsr_drawing drawing = {.n = 0};
  struct hsr_scene *scene = must_open(name);
  must_world(&world, scene);
  must_view(&view, &scene->views[0], M, N);
  struct count a = draw("appel", &world, &view, &drawing);
  struct count w = draw("warnock-edges", &world, &view, &drawing);
  struct effort effort = {.edges = (double)of(&w, "bucket sort") / 2,
                          .appel = (double)of(&a, "edge intersection"),
                          .sorted = (double)(of(&w, "X merge") +
                                             of(&w, "bubble sort") +
                                             of(&w, "uncertain order"))};
  hsr_drawing_free(&drawing);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
  return effort;
}

static void try_sorting(struct tap *tap) {
  struct effort few = effort_at("harbor:500"), many = effort_at("harbor:5000");
  double more = log(many.edges / few.edges);
  double appel = log(many.appel / few.appel) / more;
  double sorted = log(many.sorted / few.sorted) / more;
  ok(tap, sorted < 1.75 && sorted < appel,
     "harbor:500 to harbor:5000: Appel's pairs grow as edges^%.2f, comparisons "
     "of sorted edges as edges^%.2f",
     appel, sorted);
}

int main(void) {
  struct tap tap = plan(2 * count_tried() + 3);
  try_promotion(&tap);
  try_all_scenes(&tap);
  try_sorting(&tap);
  return finish(&tap);
}
