/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tests/conformance/hard_scene.h"
#include "common/exact/predicates.h"
#include "tests/draw.h"

#include <math.h>
#include <string.h>

enum { MOST_CORNERS = 8 };

const char *const hard_scale_name[N_SCALES] = {"small",   "power", "vertices",
                                               "mixed",   "large", "neighbours",
                                               "lattice", "real"};

/* --- Coordinates ---------------------------------------------------------- */

struct maker {
  uint64_t seed;
  enum hard_scale scale;
  int exponent; /* of POWER */
  double unit;  /* the size of the scene, for the camera */
  struct hsr_scene *scene;
};

static int whole(struct maker *m, int lo, int hi) {
  return (int)draw_integer(&m->seed, lo, hi);
}

static bool one_in(struct maker *m, int n) {
  return whole(m, 1, n) == 1;
}

static double coordinate(struct maker *m, int exponent) {
  static const double powers[] = {1e-320, 1e-300, 1e-160, 1e-20,
                                  1e-3,   1,      1e10,   1e20};
  double k = whole(m, -8, 8);
  switch (m->scale) {
  case POWER:
  case VERTICES:
    return ldexp(k, exponent);
  case MIXED:
    return k * (one_in(m, 2) ? 1 : powers[whole(m, 0, 7)]);
  case LARGE:
    return (one_in(m, 2) ? 0x1p52 : -0x1p51) + k / (one_in(m, 2) ? 1 : 2);
  case NEIGHBOURS:
    for (int steps = whole(m, 0, 2); steps; steps--)
      k = nextafter(k, one_in(m, 2) ? INFINITY : -INFINITY);
    return k;
  case LATTICE:
    return whole(m, -2, 2) / 2.0;
  case REAL:
    return (double)draw_integer(&m->seed, -(1LL << 50), 1LL << 50) * 0x1p-48;
  default:
    return k;
  }
}

static void point(struct maker *m, double p[3]) {
  int exponent = m->scale == VERTICES ? whole(m, -1070, 60) : m->exponent;
  for (int k = 0; k < 3; k++)
    p[k] = coordinate(m, exponent);
}

/* --- Objects -------------------------------------------------------------- */

static void add_face(struct hsr_object *object, const uint32_t *corner,
                     uint32_t n) {
  struct hsr_loop loop = {object->xyz, object->xyz + 1, object->xyz + 2,
                          3,           corner,          n};
  bool out_of_memory = false;
  if (hsr_exact_has_normal(loop, &out_of_memory))
    hsr_object_face(object, corner, n, NULL);
}

static uint32_t add_vertex(struct maker *m, struct hsr_object *object) {
  double p[3];
  uint32_t number = object->n_vertices;
  if (number && one_in(m, 6)) /* one that is there already */
    return (uint32_t)whole(m, 0, (int)number - 1);
  point(m, p);
  hsr_object_vertex(object, p[0], p[1], p[2], NULL);
  return number;
}

/* A star around a point of a plane, which is flat where nothing is rounded. */
static void add_star(struct maker *m, struct hsr_object *object) {
  static const int way[8][2] = {{2, 0},  {1, 1},   {0, 2},  {-1, 1},
                                {-2, 0}, {-1, -1}, {0, -2}, {1, -1}};
  double o[3], u[3], v[3];
  uint32_t corner[MOST_CORNERS], n = 0;
  point(m, o);
  point(m, u);
  point(m, v);
  for (int k = 0; k < 8; k++) {
    double far = whole(m, 0, 3);
    if (!(far > 0) || n == MOST_CORNERS)
      continue;
    double p[3];
    for (int c = 0; c < 3; c++)
      p[c] = o[c] + far * (way[k][0] * u[c] + way[k][1] * v[c]);
    corner[n++] = object->n_vertices;
    hsr_object_vertex(object, p[0], p[1], p[2], NULL);
  }
  if (n >= 3)
    add_face(object, corner, n);
}

static void add_tetrahedron(struct maker *m, struct hsr_object *object) {
  static const int side[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  uint32_t first = object->n_vertices;
  for (int k = 0; k < 4; k++) {
    double p[3];
    point(m, p);
    hsr_object_vertex(object, p[0], p[1], p[2], NULL);
  }
  for (int k = 0; k < 4; k++) {
    uint32_t corner[3];
    for (int c = 0; c < 3; c++)
      corner[c] = first + (uint32_t)side[k][c];
    add_face(object, corner, 3);
  }
}

static void add_object(struct maker *m) {
  struct hsr_object *object = hsr_scene_object(m->scene, "o");
  object->one_sided = one_in(m, 4);
  for (int n = whole(m, 1, 10); n; n--) {
    uint32_t corner[4];
    int kind = whole(m, 0, 9);
    if (kind == 0) {
      add_tetrahedron(m, object);
    } else if (kind <= 2) {
      add_star(m, object);
    } else {
      uint32_t size = kind <= 5 ? 4 : 3;
      bool differ = true;
      for (uint32_t k = 0; k < size; k++) {
        corner[k] = add_vertex(m, object);
        for (uint32_t l = 0; l < k; l++)
          differ &= corner[l] != corner[k];
      }
      if (differ)
        add_face(object, corner, size);
    }
  }
}

/* Moved, mirrored, sheared or scaled by small numbers. */
static void add_instance(struct maker *m, uint32_t object) {
  double t[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  if (one_in(m, 3))
    t[5 * whole(m, 0, 2)] = one_in(m, 2) ? -1 : 0.5;
  if (one_in(m, 3))
    t[4 * whole(m, 0, 2) + whole(m, 0, 2)] += whole(m, 1, 3);
  if (one_in(m, 2))
    for (int k = 0; k < 3; k++)
      t[4 * k + 3] = coordinate(m, m->exponent);
  hsr_scene_instance(m->scene, object, t);
}

/* --- Cameras -------------------------------------------------------------- */

static void any_vertex(struct maker *m, double p[3]) {
  const struct hsr_scene *scene = m->scene;
  const struct hsr_object *o =
      &scene->objects[whole(m, 0, (int)scene->n_objects - 1)];
  if (!o->n_vertices) {
    point(m, p);
    return;
  }
  int v = whole(m, 0, (int)o->n_vertices - 1);
  memcpy(p, o->xyz + 3 * v, 3 * sizeof *p);
}

/* On a vertex, between two, or elsewhere. */
static void place(struct maker *m, double p[3]) {
  double q[3];
  any_vertex(m, p);
  switch (whole(m, 0, 5)) {
  case 0:
    return;
  case 1:
    any_vertex(m, q);
    for (int k = 0; k < 3; k++)
      p[k] = p[k] / 2 + q[k] / 2;
    return;
  case 2:
    point(m, p);
    return;
  default:
    for (int k = 0; k < 3; k++)
      p[k] = m->unit * whole(m, -16, 16);
  }
}

static bool camera(struct maker *m, struct hsr_camera *camera) {
  static const double fovs[] = {90,  90,  90,         60,   45,   53.13010235,
                                120, 160, 179.999999, 1e-3, 1e-9, 1e-90};
  for (int tries = 0; tries < 50; tries++) {
    *camera = (struct hsr_camera){.fov = fovs[whole(m, 0, 11)]};
    place(m, camera->eye);
    if (one_in(m, 2))
      any_vertex(m, camera->at);
    else
      place(m, camera->at);
    for (int k = 0; k < 3; k++)
      camera->up[k] = one_in(m, 2) ? k == 1 : whole(m, -2, 2);
    if (hsr_camera_check(camera, NULL))
      continue;
    double v[3], length = 0, depth = 0;
    any_vertex(m, v);
    for (int k = 0; k < 3; k++)
      length = hypot(length, camera->at[k] - camera->eye[k]);
    for (int k = 0; k < 3; k++)
      depth +=
          (camera->at[k] - camera->eye[k]) / length * (v[k] - camera->eye[k]);
    double near[4] = {0, 0, fabs(depth), m->unit * whole(m, 0, 4)};
    camera->near = near[whole(m, 0, 3)];
    if (one_in(m, 3))
      camera->parallel = m->unit * (one_in(m, 3) ? ldexp(1, whole(m, -60, 60))
                                                 : whole(m, 1, 9));
    if (!hsr_camera_check(camera, NULL))
      return true;
  }
  return false;
}

struct hsr_scene *hard_scene(uint64_t seed, struct hsr_camera *c,
                             enum hard_scale *scale) {
  struct maker m = {.seed = seed * 7919};
  struct hsr_error err;
  m.scale = (enum hard_scale)whole(&m, 0, N_SCALES - 1);
  *scale = m.scale;
  m.exponent = one_in(&m, 3) ? whole(&m, -1074, -1020) : whole(&m, -1070, 90);
  m.unit = m.scale == POWER                    ? ldexp(1, m.exponent)
           : m.scale == LARGE                  ? 0x1p50
           : m.scale == LATTICE                ? 0.25
           : m.scale == VERTICES               ? ldexp(1, whole(&m, -1070, 60))
           : m.scale == MIXED && one_in(&m, 3) ? 1e20
                                               : 1;
  m.scene = hsr_scene_new("hard");
  for (int n = whole(&m, 1, 3); n; n--)
    add_object(&m);
  bool placed = one_in(&m, 2);
  for (uint32_t o = 0; o < m.scene->n_objects && placed; o++)
    for (int n = whole(&m, 1, 2); n; n--)
      add_instance(&m, o);
  if (!camera(&m, c) || hsr_scene_view(m.scene, c) ||
      hsr_scene_finish(m.scene, &err)) {
    hsr_scene_delete(m.scene);
    return NULL;
  }
  hsr_scene_enlarge(m.scene);
  *c = m.scene->views[0];
  return m.scene;
}
