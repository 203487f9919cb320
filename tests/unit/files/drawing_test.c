/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Line drawings: how intervals are added, ordered and compared; and what has no
 * length or lies on a border. */
#include "bench/modules/modules.h"
#include "common/lines/drawing.h"
#include "common/lines/edges.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <stdlib.h>

static struct hsr_segment interval(uint32_t a, uint32_t b, double t0, double t1,
                                   uint32_t invisibility) {
  return (struct hsr_segment){.edge = {.a = a, .b = b},
                              .invisibility = invisibility,
                              .t0 = t0,
                              .t1 = t1,
                              .from = {t0, a, b},
                              .to = {t1, a, b}};
}

static void add(struct hsr_drawing *drawing, struct hsr_segment segment) {
  if (hsr_drawing_add(drawing, &segment))
    bail("out of memory");
}

/* ---- Adding ---- */

static void try_add(struct tap *t) {
  struct hsr_drawing d = {.n = 0};
  add(&d, interval(1, 2, 0, 0.25, 1));
  add(&d, interval(1, 2, 0.25, 0.5, 1));
  ok(t, d.n == 1 && d.segment[0].t1 == 0.5 && d.segment[0].to[0] == 0.5,
     "an interval that goes on like the last one lengthens it");
  ok(t, d.segment[0].t0 == 0 && d.segment[0].from[0] == 0,
     "and leaves its begin");
  add(&d, interval(1, 2, 0.5, 0.75, 2));
  ok(t, d.n == 2, "another invisibility is another interval");
  add(&d, interval(1, 2, 0.875, 1, 2));
  ok(t, d.n == 3, "so is one after a gap");
  add(&d, interval(1, 3, 1, 1, 2));
  ok(t, d.n == 4, "so is one of another edge");
  struct hsr_segment implied = interval(1, 3, 1, 1, 2);
  implied.edge.implied = true;
  add(&d, implied);
  ok(t, d.n == 5, "so is one of an implied edge of the same numbers");
  implied.edge.part = 1;
  add(&d, implied);
  ok(t, d.n == 6, "so is one of its next part");
  hsr_drawing_clear(&d);
  ok(t, d.n == 0 && d.room > 0, "a cleared drawing keeps its memory");
  for (int k = 0; k < 1000; k++)
    add(&d, interval(0, (uint32_t)k + 1, 0, 1, 0));
  ok(t, d.n == 1000 && d.segment[999].edge.b == 1000, "it grows");
  hsr_drawing_free(&d);
  ok(t, d.n == 0 && !d.segment, "a freed drawing is empty");
}

/* ---- Order ---- */

static void try_order(struct tap *t) {
  const struct hsr_edge_name ascending[] = {
      {false, 1, 2, 0}, {false, 1, 3, 0}, {false, 2, 3, 0}, {true, 0, 1, 0},
      {true, 0, 1, 1},  {true, 0, 2, 0},  {true, 4, 5, 0}};
  enum { N = sizeof ascending / sizeof *ascending };
  bool good = true;
  for (int i = 0; i < N; i++)
    for (int j = 0; j < N; j++) {
      int order = hsr_edge_name_compare(&ascending[i], &ascending[j]);
      good = good && (order > 0) - (order < 0) == (i > j) - (i < j);
    }
  ok(t, good, "edges of faces by their vertices, then implied ones");

  struct hsr_drawing d = {.n = 0};
  for (int k = N - 1; k >= 0; k--)
    for (int part = 0; part < 4; part++) {
      struct hsr_segment s =
          interval(0, 0, 0.25 * part, 0.25 * part + 0.25, part % 2 != 0);
      s.edge = ascending[k];
      add(&d, s);
    }
  good = !hsr_drawing_sort(&d) && d.n == 4 * N;
  for (size_t k = 0; k < d.n; k++)
    good = good &&
           !hsr_edge_name_compare(&d.segment[k].edge, &ascending[k / 4]) &&
           d.segment[k].t0 == 0.25 * (double)(k % 4);
  ok(t, good, "the edges are sorted, and stay as they are along each");
  hsr_drawing_free(&d);
}

/* ---- Comparison ---- */

/* Compares drawings of up to four intervals. Returns the number of edges that
 * differ, or -1 if the number of edges compared is not `edges`. */
static int differing(struct hsr_segment *got, size_t n_got,
                     struct hsr_segment *wanted, size_t n_wanted,
                     bool visible_only, uint64_t edges) {
  struct hsr_drawing a = {got, n_got, n_got}, b = {wanted, n_wanted, n_wanted};
  struct hsr_drawing_difference difference;
  hsr_drawing_compare(&a, &b, visible_only, &difference);
  return difference.edges == edges ? (int)difference.differing : -1;
}

static void try_compare(struct tap *t) {
  struct hsr_segment w[] = {interval(1, 2, 0, 0.5, 0),
                            interval(1, 2, 0.5, 1, 2),
                            interval(1, 3, 0.25, 1, 1)};
  struct hsr_segment g[4];
#define RESET() (g[0] = w[0], g[1] = w[1], g[2] = w[2])
  RESET();
  ok(t, differing(g, 3, w, 3, false, 2) == 0, "a drawing agrees with itself");
  ok(t, differing(g, 0, w, 0, false, 0) == 0, "and nothing with nothing");
  ok(t, differing(g, 2, w, 3, false, 2) == 1, "a missing edge differs");
  ok(t, differing(g, 3, w, 2, false, 2) == 1, "and one that should not be");
  ok(t, differing(g, 0, w, 3, false, 2) == 2, "nothing differs in every edge");
  ok(t, differing(g, 1, w, 2, false, 1) == 1, "a missing interval differs");
  ok(t, differing(g, 2, w, 1, false, 1) == 1, "or one too many");
  g[1].invisibility = 1;
  ok(t, differing(g, 3, w, 3, false, 2) == 1, "so does another invisibility");
  RESET();
  g[0].t1 = g[1].t0 = 0.5 * (1 + 0.5e-12);
  ok(t, differing(g, 3, w, 3, false, 2) == 0, "ends agree within 1e-12");
  g[0].t1 = g[1].t0 = 0.5 * (1 + 2e-12);
  ok(t, differing(g, 3, w, 3, false, 2) == 1, "and not beyond it");
  RESET();
  g[0].t0 = 1e-300;
  ok(t, differing(g, 3, w, 3, false, 2) == 1, "relatively: 0 is only 0");
  RESET();
  g[0] = w[1];
  g[1] = w[0];
  ok(t, differing(g, 3, w, 3, false, 2) == 1, "the order along an edge counts");

  RESET();
  g[1].edge.b = g[0].edge.b = 4;
  struct hsr_drawing a = {g, 2, 2}, b = {w, 3, 3};
  struct hsr_drawing_difference difference;
  hsr_drawing_compare(&a, &b, false, &difference);
  ok(t,
     difference.edges == 3 && difference.differing == 3 &&
         difference.first.a == 1 && difference.first.b == 2,
     "the first differing edge is told");
}

static void try_visible_only(struct tap *t) {
  struct hsr_segment w[] = {
      interval(1, 2, 0, 0.25, 3), interval(1, 2, 0.25, 0.5, 1),
      interval(1, 2, 0.5, 0.75, 0), interval(1, 2, 0.75, 1, 2)};
  struct hsr_segment g[] = {interval(1, 2, 0, 0.5, 1),
                            interval(1, 2, 0.5, 0.75, 0),
                            interval(1, 2, 0.75, 1, 1)};
  ok(t, differing(g, 3, w, 4, true, 1) == 0,
     "visible only: hidden intervals are taken together");
  ok(t, differing(g, 3, w, 4, false, 1) == 1, "else they are not");
  ok(t, differing(w, 4, w, 4, true, 1) == 1,
     "visible only: numbers over 1 are wrong");
  g[0].t1 = 0.25;
  ok(t, differing(g, 3, w, 4, true, 1) == 1,
     "visible only: a hidden part that ends early differs");
  struct hsr_segment gap[] = {interval(1, 2, 0, 0.25, 1),
                              interval(1, 2, 0.75, 1, 2)};
  ok(t, differing(g, 1, gap, 2, true, 1) == 1,
     "visible only: a missing hidden part after a gap differs");
}

/* ---- Edges ---- */

/* One face, seen by an eye at the origin that looks along -z. */
static struct hsr_scene *one_face(const double xyz[][3], uint32_t n) {
  struct hsr_scene *scene = hsr_scene_new("face");
  struct hsr_object *object = hsr_scene_object(scene, "face");
  uint32_t vertex[5];
  for (uint32_t k = 0; k < n; k++)
    hsr_object_vertex(object, xyz[k][0], xyz[k][1], xyz[k][2], &vertex[k]);
  hsr_object_face(object, vertex, n, NULL);
  must_finish(scene);
  return scene;
}

static void try_no_length(struct tap *t) {
  static const double xyz[4][3] = {
      {0, 0, -2}, {1, 0, -2}, {1, 0, -2}, {0, 1, -2}};
  struct hsr_scene *scene = one_face(xyz, 4);
  struct hsr_world world;
  struct hsr_edges edges;
  must_world(&world, scene);
  if (hsr_edges_init(&edges, &world, NULL))
    abort();
  ok(t, edges.n == 3, "between two vertices at one place there is no edge");
  hsr_edges_free(&edges);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
}

/* Edges that lie on a border of the picture, of 90 degrees: those on the left
 * and on the upper one are in it, as samples there would be. */
static void try_borders(struct tap *t) {
  static const double at[4][3][3] = {{{-4, 1, -4}, {-2, -1, -2}, {-9, 0, -4}},
                                     {{4, 1, -4}, {2, -1, -2}, {9, 0, -4}},
                                     {{1, 4, -4}, {-1, 2, -2}, {0, 9, -4}},
                                     {{1, -4, -4}, {-1, -2, -2}, {0, -9, -4}}};
  static const size_t wanted[4] = {1, 0, 1, 0};
  struct hsr_camera camera = {.at = {0, 0, -1}, .up = {0, 1, 0}, .fov = 90};
  size_t got[4], oracles[4];
  bool good = true;
  for (int k = 0; k < 4; k++) {
    struct hsr_scene *scene = one_face(at[k], 3);
    struct hsr_world world;
    struct hsr_view view;
    struct hsr_drawing drawing = {.n = 0};
    must_world(&world, scene);
    must_view(&view, &camera, 16, 16);
    draw_lines(hsr_algorithm_find("appel")->plain, &world, &view, &drawing,
               NULL);
    got[k] = drawing.n;
    draw_lines(hsr_algorithm_find("line-oracle")->plain, &world, &view,
               &drawing, NULL);
    oracles[k] = drawing.n;
    good &= got[k] == wanted[k] && oracles[k] == wanted[k];
    hsr_drawing_free(&drawing);
    hsr_world_free(&world);
    hsr_scene_delete(scene);
  }
  ok(t, good, "on the left and the upper border: %zu %zu %zu %zu edges", got[0],
     got[1], got[2], got[3]);
}

int main(void) {
  struct tap t = plan(32);
  try_add(&t);
  try_order(&t);
  try_compare(&t);
  try_visible_only(&t);
  try_no_length(&t);
  try_borders(&t);
  return finish(&t);
}
