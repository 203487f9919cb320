/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Surfaces: which faces hang together, and which are apart. */
#include "common/adapt/surfaces.h"
#include "tests/tap.h"

#include <stdlib.h>

enum { MOST_FACES = 3, MOST_VERTICES = 9 };

/* Faces of three or four corners; faces 0 and 1 are asked about. */
struct example {
  const char *about;
  uint32_t n_vertices, n_faces;
  double xyz[MOST_VERTICES][3];
  uint32_t size[MOST_FACES], vertex[MOST_FACES][4];
  uint32_t surfaces, shared;
  bool apart, first_apart; /* 0 from 1; 0 from itself */
};

#define SQUARE                                                                 \
  {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {                                           \
    0, 1, 0                                                                    \
  }

static const struct example examples[] = {
    {"a fold",
     6,
     2,
     {SQUARE, {2, 0, 1}, {2, 1, 1}},
     {4, 4},
     {{0, 1, 2, 3}, {1, 4, 5, 2}},
     1,
     1,
     true,
     true},
    {"side by side in one plane",
     6,
     2,
     {SQUARE, {2, 0, 0}, {2, 1, 0}},
     {4, 4},
     {{0, 1, 2, 3}, {1, 4, 5, 2}},
     1,
     1,
     true,
     true},
    {"one above the other",
     8,
     2,
     {SQUARE, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
     {4, 4},
     {{0, 1, 2, 3}, {4, 5, 6, 7}},
     2,
     0,
     true,
     true},
    {"a vertex that touches a square",
     7,
     2,
     {SQUARE, {0.5, 0.5, 0}, {1, 0, 1}, {0, 1, 1}},
     {4, 3},
     {{0, 1, 2, 3}, {4, 5, 6}},
     2,
     0,
     false,
     true},
    {"one through the other",
     7,
     2,
     {SQUARE, {0.5, 0.5, -1}, {1, 0, 1}, {0, 1, 1}},
     {4, 3},
     {{0, 1, 2, 3}, {4, 5, 6}},
     2,
     0,
     false,
     true},
    {"an edge upon an edge, not shared",
     8,
     2,
     {SQUARE, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}},
     {4, 4},
     {{0, 1, 2, 3}, {4, 5, 6, 7}},
     2,
     0,
     false,
     true},
    {"a corner shared, in one plane",
     7,
     2,
     {SQUARE, {2, 1.5, 0}, {2, 2, 0}, {1.5, 2, 0}},
     {4, 4},
     {{0, 1, 2, 3}, {2, 4, 5, 6}},
     2,
     0,
     true,
     true},
    {"a corner shared in a grid: not told apart",
     7,
     2,
     {SQUARE, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}},
     {4, 4},
     {{0, 1, 2, 3}, {2, 4, 5, 6}},
     2,
     0,
     false,
     true},
    {"an edge along a diagonal, both corners shared",
     5,
     2,
     {SQUARE, {0, 1, 1}},
     {4, 3},
     {{0, 1, 2, 3}, {0, 2, 4}},
     2,
     0,
     false,
     true},
    {"folded flat",
     4,
     2,
     {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 2, 0}},
     {3, 3},
     {{0, 1, 2}, {1, 0, 3}},
     1,
     1,
     false,
     false},
    {"three at an edge",
     8,
     3,
     {SQUARE, {2, 0, 1}, {2, 1, 1}, {2, 0, -1}, {2, 1, -1}},
     {4, 4, 4},
     {{0, 1, 2, 3}, {1, 4, 5, 2}, {1, 6, 7, 2}},
     3,
     0,
     true,
     true},
    {"not flat",
     8,
     2,
     {{0, 0, 0},
      {1, 0, 0},
      {1, 1, 0.5},
      {0, 1, 0},
      {0, 0, 9},
      {1, 0, 9},
      {1, 1, 9},
      {0, 1, 9}},
     {4, 4},
     {{0, 1, 2, 3}, {4, 5, 6, 7}},
     2,
     0,
     false,
     false},
};
enum { N = sizeof examples / sizeof *examples };

static bool check(const struct example *x) {
  struct hsr_error err;
  struct hsr_world world;
  struct hsr_surfaces s;
  struct hsr_scene *scene = hsr_scene_new(x->about);
  struct hsr_object *object = hsr_scene_object(scene, "object");
  for (uint32_t v = 0; v < x->n_vertices; v++)
    hsr_object_vertex(object, x->xyz[v][0], x->xyz[v][1], x->xyz[v][2], NULL);
  for (uint32_t f = 0; f < x->n_faces; f++)
    hsr_object_face(object, x->vertex[f], x->size[f], NULL);
  if (hsr_scene_finish(scene, &err) || hsr_world_init(&world, scene, &err) ||
      hsr_surfaces_init(&s, &world, &err))
    bail("%s", err.text);
  bool apart = hsr_surfaces_apart(&s, 0, 1);
  bool first_apart = hsr_surfaces_apart(&s, 0, 0);
  bool good = s.n == x->surfaces && s.n_shared == x->shared &&
              apart == x->apart && first_apart == x->first_apart;
  if (!good)
    printf("# %u surfaces, %u shared edges, apart %d, from itself %d\n", s.n,
           s.n_shared, apart, first_apart);
  hsr_surfaces_free(&s);
  hsr_world_free(&world);
  hsr_scene_delete(scene);
  return good;
}

int main(void) {
  struct tap tap = plan(N);
  for (int k = 0; k < N; k++)
    ok(&tap, check(&examples[k]), "%s", examples[k].about);
  return finish(&tap);
}
