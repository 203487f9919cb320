/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes of one idea: a cube of cubes, a sphere, a twisted tower. */
#include "scenes/builders.h"
#include "scenes/parts/shapes.h"

#include <math.h>

/* Every small cube is an object of its own, since colours belong to objects:
 * convex, apart from all others, and full of edges that line up. */
enum hsr_status hsr_build_color_cube(struct hsr_scene *scene,
                                     const long long *parameter) {
  static const double view[][8] = {
      {1.5, 1.2, 2, 0, -0.05, 0, 36},    {-1.8, 0.9, 1.4, 0, 0, 0, 36},
      {0, 0, 1.5, 0, 0, 0, 90},          {0, 2, 0, 0, 0, 0, 90},
      {-0.25, 0.25, 0.5, 0, 0, -1, 90},  {0, 0, 0, 1, 0, 0, 90},
      {0.1, 0.05, 0.02, -1, -1, -1, 75}, {2, -1.5, -1, 0, 0, 0, 40}};
  int n = (int)parameter[0];
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  for (int i = 0; i < n * n * n && !pen.status; i++) {
    int x = i % n, y = i / n % n, z = i / n / n;
    double o = -0.5 * n, a = 0.1875, b = 0.8125;
    hsr_pen_object(&pen, "cube", true);
    hsr_pen_rgb(&pen, (x + 0.5) / n, (y + 0.5) / n, (z + 0.5) / n);
    hsr_pen_box(&pen, o + x + a, o + y + a, o + z + a, o + x + b, o + y + b,
                o + z + b);
    hsr_pen_place(&pen, NULL);
  }
  HSR_VIEWS(&pen, view, n);
  return pen.status;
}

/* After figure 5 of N. Greene, "Hierarchical Polygon Tiling with Coverage
 * Masks", SIGGRAPH 1996: of 8 x 8 squares a side three sides are seen, 192
 * squares. */
enum hsr_status hsr_build_color_sides(struct hsr_scene *scene,
                                      const long long *parameter) {
  static const double view[][8] = {
      {1.5, 1.2, 2, 0, -0.05, 0, 36}, {1.3, 1.5, 1.4, 0, 0, 0, 36},
      {0, 0, 1.5, 0, 0, 0, 60},       {-1.8, 0.9, 1.4, 0, 0, 0, 36},
      {2, -1.5, -1, 0, 0, 0, 40},     {0.7, 0.6, 0.65, 0, 0, 0, 75},
      {0, 2, 0.5, 0, 0, 0, 40},       {3, 0.25, -2, 0, 0.25, 0, 25}};
  int n = (int)parameter[0];
  double half = 0.5 * n;
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  hsr_pen_object(&pen, "cube", true);
  for (int k = 0; k < 6 * n * n && !pen.status; k++) {
    int side = k / (n * n), row = k / n % n, column = k % n;
    int a = side / 2, b = (a + 1) % 3, c = (a + 2) % 3;
    double p[3], u[3] = {0}, v[3] = {0}, colour[3];
    p[a] = side % 2 ? half : -half;
    p[b] = column - half;
    p[c] = row - half;
    u[side % 2 ? b : c] = 1;
    v[side % 2 ? c : b] = 1;
    colour[a] = side % 2;
    colour[b] = (column + 0.5) / n;
    colour[c] = (row + 0.5) / n;
    hsr_pen_rgb(&pen, colour[0], colour[1], colour[2]);
    hsr_pen_parallelogram(&pen, p, u, v);
  }
  hsr_pen_place(&pen, NULL);
  HSR_VIEWS(&pen, view, n);
  return pen.status;
}

/* Number of the vertices of the sphere above ring r: ring r of 2k + 1 has
 * 4 min(r, 2k - r) vertices, the poles one. */
static uint32_t ring_start(uint32_t r, uint32_t k) {
  if (r == 0)
    return 0;
  if (r <= k)
    return 1 + 2 * r * (r - 1);
  uint32_t left = 2 * k - r;
  return 4 * k * k + 1 - 2 * left * (left + 1);
}

static uint32_t ring_vertex(uint32_t r, uint32_t j, uint32_t k) {
  uint32_t size = r <= k ? 4 * r : 4 * (2 * k - r);
  return ring_start(r, k) + (size ? j % size : 0);
}

/* Ring r of the octahedron |x| + |y| + |z| = k, blown up to the unit sphere. */
static void sphere_ring(struct hsr_pen *pen, int r, int k) {
  static const int axis[5][2] = {{1, 0}, {0, -1}, {-1, 0}, {0, 1}, {1, 0}};
  int size = r <= k ? r : 2 * k - r, y = k - r;
  for (int j = 0; j < (size ? 4 * size : 1); j++) {
    int q = size ? j / size : 0, s = size ? j % size : 0;
    int x = (size - s) * axis[q][0] + s * axis[q + 1][0];
    int z = (size - s) * axis[q][1] + s * axis[q + 1][1];
    double length = sqrt((double)x * x + (double)y * y + (double)z * z);
    hsr_pen_vertex(pen, x / length, y / length, z / length);
  }
}

static void sphere_face(struct hsr_pen *pen, uint32_t a, uint32_t b,
                        uint32_t c) {
  if (pen->status)
    return;
  const double *xyz = pen->scene->objects[pen->object].xyz;
  double mean[3];
  for (size_t i = 0; i < 3; i++)
    mean[i] = (xyz[3 * (size_t)a + i] + xyz[3 * (size_t)b + i] +
               xyz[3 * (size_t)c + i]) /
              6;
  hsr_pen_rgb(pen, 0.5 + mean[0], 0.5 + mean[1], 0.5 + mean[2]);
  const uint32_t v[3] = {a, b, c};
  hsr_pen_face(pen, 3, v);
}

/* The band between ring r and the next, of a northern or southern half. */
static void sphere_band(struct hsr_pen *pen, uint32_t r, uint32_t k) {
  bool north = r < k;
  uint32_t size = north ? r : 2 * k - r - 1; /* of a quarter, nearer the pole */
  uint32_t inner = north ? r : r + 1, outer = north ? r + 1 : r;
  for (uint32_t q = 0; q < 4; q++)
    for (uint32_t s = 0; s <= size; s++) {
      uint32_t a = ring_vertex(inner, q * size + s, k);
      uint32_t b = ring_vertex(outer, q * (size + 1) + s, k);
      uint32_t c = ring_vertex(outer, q * (size + 1) + s + 1, k);
      sphere_face(pen, a, north ? b : c, north ? c : b);
      if (s == size)
        continue;
      uint32_t d = ring_vertex(inner, q * size + s + 1, k);
      sphere_face(pen, a, north ? c : d, north ? d : c);
    }
}

enum hsr_status hsr_build_sphere(struct hsr_scene *scene,
                                 const long long *parameter) {
  static const double view[][8] = {
      {0.8, 0.9, 2.4, 0, 0, 0, 50}, {0, 0, 3, 0, 0, 0, 90},
      {3, 0, 0, 0, 0, 0, 45},       {0, -3, 0, 0, 0, 0, 45},
      {-2, 2, 2, 0, 0, 0, 40},      {1, -1.5, -3, 0, 0, 0, 40},
      {0.5, 1.25, 0, 0, 0, 0, 60},  {0, 1, 1, 0, 0.7, 0.7, 90}};
  int k = (int)(sqrt((double)parameter[0] / 8) + 0.5);
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  hsr_pen_object(&pen, "sphere", true);
  for (int r = 0; r <= 2 * k; r++)
    sphere_ring(&pen, r, k);
  for (int r = 0; r < 2 * k; r++)
    sphere_band(&pen, (uint32_t)r, (uint32_t)k);
  hsr_pen_place(&pen, NULL);
  HSR_VIEWS(&pen, view, 1);
  return pen.status;
}

static void columns(struct hsr_pen *pen) {
  static const double shaft[2][2] = {{0.375, 0.75}, {0.375, 4}};
  for (int side = 0; side < 4; side++)
    for (int i = 0; i < 3; i++) {
      static const double sine[4] = {0, 1, 0, -1}, cosine[4] = {1, 0, -1, 0};
      double x = 6.0 * i - 6, z = 7.5;
      hsr_pen_frame(pen, cosine[side] * x + sine[side] * z, 0,
                    cosine[side] * z - sine[side] * x, side);
      hsr_pen_lathe(pen, 6, 2, shaft);
    }
}

/* One storey, 4 high: slab, columns, glass behind them, a rail before. */
static void storey(struct hsr_pen *pen) {
  hsr_pen_object(pen, "storey", true);
  hsr_pen_paint(pen, 0xe4ded2);
  hsr_pen_box(pen, -9, 0, -9, 9, 0.75, 9);
  hsr_pen_paint(pen, 0xc9bfae);
  columns(pen);
  hsr_pen_frame(pen, 0, 0, 0, 0);
  hsr_pen_paint(pen, 0x6b9bb8);
  hsr_pen_box(pen, -6, 0.75, -6, 6, 4, 6);
  hsr_pen_paint(pen, 0x4b5560);
  for (int side = 0; side < 4; side++) {
    hsr_pen_frame(pen, 0, 0, 0, side);
    hsr_pen_box(pen, -8.75, 1.5, 8.625, 8.5, 1.75, 8.875);
    hsr_pen_box(pen, -8.75, 0.75, 8.625, -8.5, 1.5, 8.875);
  }
}

static void twist_ends(struct hsr_pen *pen, int n) {
  static const double roof[4][2] = {{9, 0}, {9, 0.75}, {3, 3}, {0, 14}};
  double m[12];
  hsr_pen_object(pen, "plaza", true);
  hsr_pen_paint(pen, 0xb4ab9a);
  hsr_pen_box(pen, -24, -1, -24, 24, 0, 24);
  hsr_pen_place(pen, NULL);
  hsr_pen_object(pen, "roof", true);
  hsr_pen_paint(pen, 0xa4523f);
  hsr_pen_lathe(pen, 16, 4, roof);
  hsr_pen_matrix(m, 0, 4.0 * n, 0, 0);
  hsr_pen_place(pen, m);
}

/* Each storey is turned by a 160th of a circle against the one below. */
enum hsr_status hsr_build_twist(struct hsr_scene *scene,
                                const long long *parameter) {
  static const double view[][8] = {
      {0.5, 0.35, 0.8, 0, 0.47, 0, 58}, {-1, 0.9, 0.9, 0, 0.45, 0, 50},
      {0.3, 0.05, 0.35, 0, 0.7, 0, 80}, {0, 1.7, 0, 0, 0, 0, 60},
      {0.3, 0.6, -0.3, 0, 0.5, 0, 70},  {-0.25, 0.3, -0.2, 0, 0.3, 0, 75},
      {0, 0.512, 0.5, 0, 0.512, 0, 90}, {1.5, 0.2, -1, 0, 0.5, 0, 40}};
  int n = (int)parameter[0];
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  twist_ends(&pen, n);
  storey(&pen);
  for (int i = 0; i < n; i++) {
    double c, s;
    hsr_unit((uint32_t)i, 160, &c, &s);
    const double m[12] = {c, 0, s, 0, 0, 1, 0, 4.0 * i, -s, 0, c, 0};
    hsr_pen_place(&pen, m);
  }
  HSR_VIEWS(&pen, view, 4.0 * n + 14);
  return pen.status;
}
