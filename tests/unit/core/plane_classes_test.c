/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which faces lie on one plane: residues of planes, and plane classes where many
 * planes differ by rounding alone, against the exact predicate. */
#include "common/polygon/polygon.h"
#include "common/scene/world.h"
#include "tests/draw.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CORNERS = 4 };

struct polygon {
  double xyz[3 * CORNERS];
  uint32_t vertex[CORNERS], n;
};

static struct hsr_loop loop_of(const struct polygon *p) {
  return (struct hsr_loop){.x = p->xyz,
                           .y = p->xyz + 1,
                           .z = p->xyz + 2,
                           .stride = 3,
                           .vertex = p->vertex,
                           .n = p->n};
}

static uint64_t residue_of(const struct polygon *p) {
  return hsr_plane_residue(loop_of(p));
}

/* --- Residues ------------------------------------------------------------- */

/* A triangle, or a convex or crossing quadrilateral, in the plane of `at`, `u` and
 * `v`, which are whole numbers; all is then multiplied by `scale`. */
static struct polygon draw_polygon(uint64_t *seed, const double at[3],
                                   const double u[3], const double v[3],
                                   double scale) {
  struct polygon p = {.n = (uint32_t)draw_integer(seed, 3, CORNERS)};
  bool out_of_memory = false;
  do
    for (uint32_t k = 0; k < p.n; k++) {
      double a = (double)draw_integer(seed, -9, 9),
             b = (double)draw_integer(seed, -9, 9);
      p.vertex[k] = k;
      for (int c = 0; c < 3; c++)
        p.xyz[3 * k + (uint32_t)c] = scale * (at[c] + a * u[c] + b * v[c]);
    }
  while (!hsr_exact_has_normal(loop_of(&p), &out_of_memory));
  return p;
}

static void draw_vector(uint64_t *seed, double v[3]) {
  for (int c = 0; c < 3; c++)
    v[c] = (double)draw_integer(seed, -99, 99);
}

static bool are_equal(const struct polygon *p, const struct polygon *q) {
  bool out_of_memory = false;
  return hsr_exact_same_plane(loop_of(p), loop_of(q), &out_of_memory);
}

static void test_residues(struct tap *tap, uint64_t *seed) {
  enum { PAIRS = 20000 };
  static const double scales[] = {1, 0x1p-1070, 0x1p61, 0x1p-61, 0x1.8p900};
  int equal = 0, different = 0, wrong = 0;
  for (int k = 0; k < PAIRS; k++) {
    double at[3], u[3], v[3], scale = scales[k % 5];
    draw_vector(seed, at);
    draw_vector(seed, u);
    draw_vector(seed, v);
    if (u[0] * v[1] == u[1] * v[0])
      continue;
    struct polygon p = draw_polygon(seed, at, u, v, scale),
                   q = draw_polygon(seed, at, u, v, scale);
    equal += are_equal(&p, &q);
    wrong += residue_of(&p) != residue_of(&q) || !residue_of(&p);

    /* One corner moves by the least that it can. */
    q.xyz[2] = nextafter(q.xyz[2], INFINITY);
    bool still = are_equal(&p, &q);
    different += !still;
    wrong += still != (residue_of(&p) == residue_of(&q));

    /* All corners move, to a parallel plane. */
    q = p;
    for (uint32_t c = 0; c < q.n; c++)
      q.xyz[3 * c + 2] += scale;
    wrong += residue_of(&p) == residue_of(&q);
  }
  ok(tap, !wrong && equal > PAIRS * 9 / 10 && different > PAIRS * 9 / 10,
     "%d pairs of faces on one plane share its residue, %d on others do not: "
     "%d wrong",
     equal, different, wrong);
}

/* A side as long as the prime. */
static struct polygon long_triangle(double z) {
  return (struct polygon){
      .xyz = {1, 0, z, 0x1p61, 0, z, 1, 1, z}, .vertex = {0, 1, 2}, .n = 3};
}

static void test_unknown(struct tap *tap) {
  struct polygon p = long_triangle(0.25), q = p;
  q.xyz[3] = 0x1p60;
  ok(tap, !residue_of(&p) && residue_of(&q) && are_equal(&p, &q),
     "of a normal that the prime divides, nothing is known");
}

/* --- Classes -------------------------------------------------------------- */

static void add(struct hsr_object *object, const struct polygon *p) {
  uint32_t vertex[CORNERS];
  bool reversed = object->n_faces % 2;
  for (uint32_t k = 0; k < p->n; k++) {
    uint32_t c = reversed ? p->n - 1 - k : k;
    vertex[k] = object->n_vertices;
    if (hsr_object_vertex(object, p->xyz[3 * c], p->xyz[3 * c + 1],
                          p->xyz[3 * c + 2], NULL))
      bail("a vertex: refused");
  }
  if (hsr_object_face(object, vertex, p->n, NULL))
    bail("a face: refused");
}

/* Faces whose class is another one than that of the first face on their plane; and
 * how many planes there are. */
static uint32_t count_wrong(const struct hsr_world *world, uint32_t *n_planes) {
  uint32_t *first = malloc(world->n_faces * sizeof *first), wrong = 0;
  bool out_of_memory = false;
  *n_planes = 0;
  if (!first)
    bail("planes: out of memory");
  for (uint32_t f = 0; f < world->n_faces; f++) {
    uint32_t k = 0;
    while (k < *n_planes && !hsr_exact_same_plane(
                                hsr_face_loop(world, f),
                                hsr_face_loop(world, first[k]), &out_of_memory))
      k++;
    if (k == *n_planes)
      first[(*n_planes)++] = f;
    wrong += world->mesh.plane[f] != world->mesh.plane[first[k]];
  }
  free(first);
  return wrong;
}

static void check(struct tap *tap, struct hsr_scene *scene, uint32_t least,
                  const char *what) {
  struct hsr_world world;
  uint32_t n_planes, n_classes = 0, wrong = 0;
  must_finish(scene);
  for (int threads = 1; threads <= 3; threads += 2) {
    scene->threads = threads;
    must_world(&world, scene);
    wrong += count_wrong(&world, &n_planes);
    n_classes = world.mesh.n_planes;
    wrong += n_classes != n_planes;
    hsr_world_free(&world);
  }
  ok(tap, !wrong && n_classes >= least, "%s: %u classes, %u faces wrong", what,
     n_classes, wrong);
  hsr_scene_delete(scene);
}

/* Parallel planes that are closer to one another than keys can tell. On each
 * there are faces that say what plane it is, and one that does not. */
static void test_layers(struct tap *tap, uint64_t *seed) {
  enum { LAYERS = 100, OF_EACH = 6 };
  struct hsr_scene *scene = hsr_scene_new("layers");
  struct hsr_object *object = hsr_scene_object(scene, "layers");
  uint32_t order[LAYERS * OF_EACH];
  for (uint32_t k = 0; k < LAYERS * OF_EACH; k++) {
    uint32_t other = (uint32_t)draw_integer(seed, 0, k);
    order[k] = order[other];
    order[other] = k;
  }
  for (uint32_t k = 0; k < LAYERS * OF_EACH; k++) {
    double z = order[k] / OF_EACH * 0x1p-60;
    struct polygon p = long_triangle(z);
    if (order[k] % OF_EACH)
      p = (struct polygon){.xyz = {0, 0, z, order[k], 0, z, 1, 1, z},
                           .vertex = {0, 1, 2},
                           .n = 3};
    add(object, &p);
  }
  check(tap, scene, LAYERS, "layers of 2^-60");
}

/* A flat sheet that is turned by rounded numbers: its quadrilaterals are on planes
 * of their own, or on one, by chance. */
static void test_sheet(struct tap *tap) {
  enum { SIDE = 36 };
  struct hsr_scene *scene = hsr_scene_new("sheet");
  struct hsr_object *object = hsr_scene_object(scene, "sheet");
  for (int j = 0; j < SIDE; j++)
    for (int i = 0; i < SIDE; i++) {
      struct polygon p = {.vertex = {0, 1, 2, 3}, .n = i % 2 ? 3 : 4};
      for (int k = 0; k < CORNERS; k++) {
        double x = (i + (k == 1 || k == 2)) / 3.0, z = (j + (k > 1)) * 0.1;
        p.xyz[3 * k] = x;
        p.xyz[3 * k + 1] = x / 3 - z / 7;
        p.xyz[3 * k + 2] = z;
      }
      add(object, &p);
    }
  check(tap, scene, SIDE, "a sheet that is turned");
}

int main(void) {
  struct tap tap = plan(4);
  uint64_t seed = 61;
  test_residues(&tap, &seed);
  test_unknown(&tap);
  test_layers(&tap, &seed);
  test_sheet(&tap);
  return finish(&tap);
}
