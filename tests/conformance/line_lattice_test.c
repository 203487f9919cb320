/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every algorithm that draws lines against the line oracle, interval for
 * interval, on solids of small integer coordinates. The cameras are aligned
 * with them, so images of vertices and edges coincide everywhere. Half of them
 * are parallel: along an axis, isometric, dimetric.
 *
 * usage: line_lattice_test [SCENES [SEED]]      standard: 500 scenes, seed 1 */
#include "bench/modules/modules.h"
#include "common/answers/kinds/segments.h"
#include "scenes/scenes.h"
#include "scenes/parts/shapes.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <stdlib.h>

enum { REACH = 4 };

/* --- Scenes --------------------------------------------------------------- */

/* In lattice steps, counter-clockwise: a wedge, a step, a cross, a U. */
struct section {
  uint32_t n;
  double xy[12][2];
};
static const struct section sections[] = {
    {3, {{0, 0}, {2, 0}, {0, 2}}},
    {4, {{0, 0}, {3, 0}, {2, 1}, {0, 1}}},
    {6, {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}},
    {8, {{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}},
    {12,
     {{1, 0},
      {2, 0},
      {2, 1},
      {3, 1},
      {3, 2},
      {2, 2},
      {2, 3},
      {1, 3},
      {1, 2},
      {0, 2},
      {0, 1},
      {1, 1}}}};
enum { N_SECTIONS = sizeof sections / sizeof *sections };

static void draw_pyramid(struct hsr_pen *pen, uint64_t *seed) {
  double x = (double)draw_integer(seed, 1, 3);
  double z = (double)draw_integer(seed, 1, 3);
  uint32_t base[4] = {
      hsr_pen_vertex(pen, 0, 0, 0), hsr_pen_vertex(pen, x, 0, 0),
      hsr_pen_vertex(pen, x, 0, z), hsr_pen_vertex(pen, 0, 0, z)};
  uint32_t apex = hsr_pen_vertex(pen, (double)draw_integer(seed, -1, 3),
                                 (double)draw_integer(seed, 1, 3),
                                 (double)draw_integer(seed, -1, 3));
  hsr_pen_face(pen, 4, base);
  for (int k = 0; k < 4; k++) {
    uint32_t side[3] = {base[(k + 1) % 4], base[k], apex};
    hsr_pen_face(pen, 3, side);
  }
}

static void draw_solid(struct hsr_pen *pen, uint64_t *seed) {
  double at[3];
  for (int k = 0; k < 3; k++)
    at[k] = (double)draw_integer(seed, -REACH, REACH - 1);
  hsr_pen_frame(pen, at[0], at[1], at[2], (int)draw_integer(seed, 0, 3));
  switch (draw_integer(seed, 0, 2)) {
  case 0:
    hsr_pen_box(pen, 0, 0, 0, (double)draw_integer(seed, 1, 3),
                (double)draw_integer(seed, 1, 3),
                (double)draw_integer(seed, 1, 3));
    break;
  case 1:
    draw_pyramid(pen, seed);
    break;
  default: {
    const struct section *s = &sections[draw_integer(seed, 0, N_SECTIONS - 1)];
    hsr_pen_extrusion(pen, s->n, s->xy, 0, (double)draw_integer(seed, 1, 2));
  }
  }
}

/* Objects of one or two solids, which penetrate, touch, or are the same. */
static struct hsr_scene *solids(uint64_t *seed) {
  struct hsr_scene *scene = hsr_scene_new("solids");
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  for (int64_t n = draw_integer(seed, 2, 4); n > 0; n--) {
    hsr_pen_object(&pen, "solids", draw_integer(seed, 0, 1));
    for (int64_t k = draw_integer(seed, 1, 2); k > 0; k--)
      draw_solid(&pen, seed);
    hsr_pen_place(&pen, NULL);
  }
  static const double view[][7] = {
      /* eye, direction, near */
      {0, 0, 9, 0, 0, -1, 0},  {9, 1, 0, -1, 0, 0, 0}, {0, 9, 0, 0, -1, 0, 0},
      {0, 0, 0, 0, 0, -1, 0},  {1, 0, -2, 1, 0, 0, 0}, {8, 8, 8, -1, -1, -1, 0},
      {0, 8, 8, 0, -1, -1, 0}, {0, 0, 6, 0, 0, -1, 3}, {-5, 0, 0, 1, 0, 0, 5},
      {64, 0, 0, -1, 0, 0, 0}, {8, 6, 0, -4, -3, 0, 0}};
  enum { N_VIEWS = sizeof view / sizeof *view };
  const double *v = view[draw_integer(seed, 0, N_VIEWS - 1)];
  double at[3] = {v[0] + v[3], v[1] + v[4], v[2] + v[5]};
  hsr_pen_view(&pen, v, at, draw_integer(seed, 0, 1) ? 90 : 60, v[6]);
  if (pen.status)
    bail("out of memory");
  must_finish(scene);
  return scene;
}

/* Three scenes of four have solids, the fourth has polygons of all kinds. */
static struct hsr_scene *draw_scene(uint64_t *seed, uint32_t *view) {
  *view = 0;
  if (draw_integer(seed, 0, 3))
    return solids(seed);
  char name[64];
  snprintf(name, sizeof name, "lattice:%d:%d", (int)draw_integer(seed, 3, 12),
           (int)draw_integer(seed, 1, 1000000000));
  struct hsr_scene *scene = must_open(name);
  *view = (uint32_t)draw_integer(seed, 0, scene->n_views - 1);
  return scene;
}

/* --- Comparison ----------------------------------------------------------- */

struct comparison {
  long scene;
  const struct hsr_world *world;
  const struct hsr_view *view;
  struct hsr_drawing wanted, got;
  uint64_t edges, differing;
};

static void compare(const struct hsr_algorithm *algorithm, void *context) {
  struct comparison *c = context;
  struct hsr_drawing_difference difference;
  draw_lines(algorithm, c->world, c->view, &c->got, NULL);
  hsr_drawing_compare(&c->got, &c->wanted,
                      hsr_makes_how(algorithm, HSR_SEGMENTS) & HSR_VISIBLE_ONLY,
                      &difference);
  c->edges += difference.edges;
  c->differing += difference.differing;
  if (difference.differing)
    printf("# scene %ld, eye %g,%g,%g, parallel %g: %s differs on %llu edges, "
           "the first %s %u %u %u\n",
           c->scene, c->view->E[0], c->view->E[1], c->view->E[2],
           c->view->camera.parallel, algorithm->name,
           (unsigned long long)difference.differing,
           difference.first.implied ? "implied" : "of faces",
           difference.first.a, difference.first.b, difference.first.part);
}

static void check_scene(struct comparison *c, uint64_t *seed) {
  struct hsr_world world;
  struct hsr_view view;
  uint32_t v;
  struct hsr_scene *scene = draw_scene(seed, &v);
  struct hsr_camera camera = scene->views[v];
  int m = (int)draw_integer(seed, 16, 64), n = (int)draw_integer(seed, 16, 64);
  draw_parallel(seed, &camera, n);
  must_world(&world, scene);
  must_view(&view, &camera, m, n);
  c->world = &world;
  c->view = &view;
  draw_lines(hsr_algorithm_find("line-oracle")->plain, &world, &view,
             &c->wanted, NULL);
  for_each_line_algorithm(compare, c);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
}

int main(int argc, char **argv) {
  long n = argc > 1 ? atol(argv[1]) : 500;
  uint64_t seed = argc > 2 ? strtoull(argv[2], NULL, 10) : 1, edges = 0;
  enum { PARTS = 20 };
  struct tap tap = plan(PARTS);
  struct comparison c = {.scene = 0};
  for (long part = 0; part < PARTS; part++) {
    long first = c.scene + 1;
    c.edges = c.differing = 0;
    for (; c.scene < n * (part + 1) / PARTS; c.scene++)
      check_scene(&c, &seed);
    ok(&tap, c.differing == 0, "scenes %ld to %ld: %llu of %llu edges differ",
       first, c.scene, (unsigned long long)c.differing,
       (unsigned long long)c.edges);
    edges += c.edges;
  }
  hsr_drawing_free(&c.wanted);
  hsr_drawing_free(&c.got);
  printf("# %llu edges compared in %ld scenes\n", (unsigned long long)edges, n);
  return finish(&tap);
}
