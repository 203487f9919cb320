/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Failure cases of the eye's place, and of faces hard to compute with. */
#include "scenes/builders.h"
#include "scenes/parts/shapes.h"

static void triangle(struct hsr_pen *pen, const double a[3], const double b[3],
                     const double c[3]) {
  double p[3][3];
  for (int k = 0; k < 3; k++) {
    p[0][k] = a[k];
    p[1][k] = b[k];
    p[2][k] = c[k];
  }
  hsr_pen_polygon(pen, 3, (const double(*)[3])p);
}
#define P(x, y, z) ((const double[3]){x, y, z})

/* A corridor, and triangles with one, two and three corners behind the eye of
 * most views, near it and across it. */
enum hsr_status hsr_build_behind_eye(struct hsr_scene *scene,
                                     const long long *parameter) {
  static const double view[][8] = {{0, 0, 0, 0, 0, -1, 90},
                                   {0, 0, 0, 0, 0, 1, 90},
                                   {0, 0, 0, 1, 0, 0, 90},
                                   {0, 0, 0, 0, 1, 0, 90},
                                   {1, -1, 20, -2, 0.5, 0, 75},
                                   {2.5, 1.5, -3, -4, -1, -9, 110},
                                   {-3, 2, 6, 4, -2, -20, 140},
                                   {0, 0, 0, 0, 0, -1, 90, 2},
                                   {0.5, 0.25, 3, 0.25, 0.5, -5, 60},
                                   {60, 50, 140, 0, 0, 0, 50}};
  (void)parameter;
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  hsr_pen_object(&pen, "corridor", false);
  static const double wall[4][3][3] = {{{-4, -3, -60}, {8, 0, 0}, {0, 0, 120}},
                                       {{-4, 3, -60}, {0, 0, 120}, {8, 0, 0}},
                                       {{-4, -3, -60}, {0, 0, 120}, {0, 6, 0}},
                                       {{4, -3, -60}, {0, 6, 0}, {0, 0, 120}}};
  for (uint32_t i = 0; i < 4; i++) {
    hsr_pen_palette(&pen, i + 8);
    hsr_pen_parallelogram(&pen, wall[i][0], wall[i][1], wall[i][2]);
  }
  hsr_pen_place(&pen, NULL);
  hsr_pen_object(&pen, "triangles", false);
  hsr_pen_palette(&pen, 0);
  triangle(&pen, P(-3, -2, -10), P(3, -2, -12), P(1, 2, 20));
  hsr_pen_palette(&pen, 1);
  triangle(&pen, P(-3, 2, -20), P(-2, 1, 8), P(-3, -1, 12));
  hsr_pen_palette(&pen, 2);
  triangle(&pen, P(2, -2, 6), P(3, 1, 9), P(-1, 2, 30));
  hsr_pen_palette(&pen, 3);
  triangle(&pen, P(-40, 1, 30), P(50, 2, 40), P(3, -1, -50));
  hsr_pen_palette(&pen, 4);
  hsr_pen_parallelogram(&pen, P(2, -3, -30), P(0.5, 0, 60), P(0, 4, -1));
  hsr_pen_place(&pen, NULL);
  HSR_VIEWS(&pen, view, 1);
  return pen.status;
}

/* For an eye at the origin that looks to -z with near = 4: plates before, on
 * and behind the near plane, and one unit in the last place from it. */
static void plates_at_near(struct hsr_pen *pen) {
  static const double plate[7][4] = {/* x, y, size, depth */
                                     {-4, 1, 3, 4},
                                     {-4, -4, 2, 2},
                                     {-1, -4, 2, 4.000000000000001},
                                     {1, -4, 2, 3.9999999999999996},
                                     {3, -4, 1, 4},
                                     {-1, 1, 2, 6},
                                     {2, 1, 3, 8}};
  hsr_pen_object(pen, "plates", false);
  for (uint32_t i = 0; i < 7; i++) {
    const double *q = plate[i];
    hsr_pen_palette(pen, i);
    hsr_pen_parallelogram(pen, P(q[0], q[1], -q[3]), P(q[2], 0, 0),
                          P(0, q[2], 0));
  }
  hsr_pen_place(pen, NULL);
}

/* Faces that cross it, and that stand on it with an edge and with a corner. */
static void slants_at_near(struct hsr_pen *pen) {
  hsr_pen_object(pen, "slants", false);
  hsr_pen_palette(pen, 7);
  hsr_pen_parallelogram(pen, P(-3, -2, -1), P(6, 0, 0), P(0, 1, -8));
  hsr_pen_palette(pen, 8);
  triangle(pen, P(-2, 0, -4), P(2, 0, -4), P(0, 3, -7));
  hsr_pen_palette(pen, 9);
  triangle(pen, P(3, 0, -4), P(5, -2, -6), P(5, 2, -8));
  hsr_pen_palette(pen, 10);
  triangle(pen, P(-3, 3, -2), P(-3, 4, -9), P(3, 3, -9));
  hsr_pen_place(pen, NULL);
}

enum hsr_status hsr_build_near_plane(struct hsr_scene *scene,
                                     const long long *parameter) {
  static const double view[][8] = {
      {0, 0, 0, 0, 0, -1, 90, 4},  {0, 0, 0, 0, 0, -1, 90, 0},
      {0, 0, 0, 0, 0, -1, 90, 2},  {0, 0, 0, 0, 0, -1, 90, 6},
      {0, 0, -8, 0, 0, 0, 90, 4},  {4, 0, -4, 0, 0, -4, 90, 4},
      {0, 8, -4, 0, 0, -4, 90, 8}, {1, 2, 6, 0, 0, -4, 60, 7.5},
      {6, 5, 4, 0, 0, -5, 50, 0}};
  (void)parameter;
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  plates_at_near(&pen);
  slants_at_near(&pen);
  hsr_pen_object(&pen, "box", true);
  hsr_pen_palette(&pen, 11);
  hsr_pen_box(&pen, -1, -1, -6, 1, 1, -4);
  hsr_pen_place(&pen, NULL);
  hsr_pen_object(&pen, "wall", false);
  hsr_pen_palette(&pen, 4);
  hsr_pen_parallelogram(&pen, P(-20, -20, -20), P(40, 0, 0), P(0, 40, 0));
  hsr_pen_place(&pen, NULL);
  HSR_VIEWS(&pen, view, 1);
  return pen.status;
}

/* All integers. The triangle's mean is (0, -1, 1), on 9x + 24y + 16z = -8. */
static void corner(struct hsr_pen *pen) {
  hsr_pen_object(pen, "corner", false);
  hsr_pen_palette(pen, 8);
  hsr_pen_parallelogram(pen, P(-8, -4, -8), P(0, 0, 16), P(16, 0, 0));
  hsr_pen_palette(pen, 9);
  hsr_pen_parallelogram(pen, P(-8, -4, -8), P(0, 12, 0), P(0, 0, 16));
  hsr_pen_palette(pen, 10);
  hsr_pen_parallelogram(pen, P(-8, -4, -8), P(16, 0, 0), P(0, 12, 0));
  hsr_pen_palette(pen, 0);
  triangle(pen, P(-8, 0, 4), P(8, -4, 1), P(0, 1, -2));
  hsr_pen_palette(pen, 1);
  hsr_pen_parallelogram(pen, P(-6, -2, 0), P(4, 0, 0), P(0, 4, 0));
  hsr_pen_place(pen, NULL);
}

enum hsr_status hsr_build_eye_in_plane(struct hsr_scene *scene,
                                       const long long *parameter) {
  static const double view[][8] = {
      {0, 0, 12, 0, 0, 0, 90},    /* in no plane */
      {6, 0, 0, 0, 0, 0, 90},     /* in two faces' planes, z = 0 */
      {0, -4, 12, 0, -4, 0, 90},  /* in the floor's plane, beside it */
      {4, 7, 0, 4, 0, 0, 90},     /* on the line of an edge, along it */
      {2, 2, 0, -1, 2, 0, 90},    /* on a vertex of the pillar */
      {3, 2, 0, 3, 2, -1, 90},    /* on an edge of it */
      {1, -4, 3, 0, -4, 3, 90},   /* on the floor */
      {-8, -4, -8, 0, 0, 0, 90},  /* where three faces meet */
      {0, -1, 1, 0, -1, 0, 90},   /* on the triangle */
      {-8, -4, 20, -8, -4, 0, 90} /* on the line where two faces meet */
  };
  (void)parameter;
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  corner(&pen);
  hsr_pen_object(&pen, "pillar", true);
  hsr_pen_palette(&pen, 2);
  hsr_pen_box(&pen, 2, -4, -2, 4, 2, 0);
  hsr_pen_place(&pen, NULL);
  HSR_VIEWS(&pen, view, 1);
  return pen.status;
}

/* Squares with one corner lifted by 2^-50 to 4; then a saddle of cells that
 * share their vertices; a twisted column; a crown that goes up and down. */
static void lifted(struct hsr_pen *pen) {
  static const double lift[8] = {0x1p-50, 0x1p-40, 0x1p-20, 0x1p-10,
                                 0.125,   0.5,     1,       4};
  hsr_pen_object(pen, "lifted", false);
  for (uint32_t i = 0; i < 8; i++) {
    double x = 3 * (i % 4), y = 3 * (i / 4);
    const double p[4][3] = {
        {x, y, 0}, {x + 2, y, 0}, {x + 2, y + 2, lift[i]}, {x, y + 2, 0}};
    hsr_pen_palette(pen, i);
    hsr_pen_polygon(pen, 4, p);
  }
  hsr_pen_place(pen, NULL);
}

static void saddle(struct hsr_pen *pen) {
  hsr_pen_object(pen, "saddle", false);
  hsr_pen_frame(pen, -8, 2, 0, 0);
  uint32_t first = 0;
  for (int i = 0; i < 49; i++) {
    double x = i % 7 - 3, y = i / 7 - 3;
    uint32_t v = hsr_pen_vertex(pen, 1.5 * x, 1.5 * y, 0.5 * x * y);
    first = i ? first : v;
  }
  for (uint32_t i = 0; i < 36; i++) {
    uint32_t a = first + i % 6 + 7 * (i / 6);
    const uint32_t v[4] = {a, a + 1, a + 8, a + 7};
    hsr_pen_palette(pen, i + i / 6);
    hsr_pen_face(pen, 4, v);
  }
  hsr_pen_place(pen, NULL);
}

static void twisted(struct hsr_pen *pen) {
  static const double column[8][3] = {{-2, -12, 2},  {2, -12, 2}, {2, -12, -2},
                                      {-2, -12, -2}, {0, -4, 3},  {3, -4, 0},
                                      {0, -4, -3},   {-3, -4, 0}};
  static const double crown[8][3] = {{11, -6, 1}, {10, -4, -1}, {8, -3, 2},
                                     {6, -4, -2}, {5, -6, 1},   {6, -8, -1},
                                     {8, -9, 3},  {10, -8, -3}};
  hsr_pen_object(pen, "twisted", true);
  hsr_pen_palette(pen, 3);
  hsr_pen_loft(pen, 4, 2, column, false);
  hsr_pen_place(pen, NULL);
  hsr_pen_object(pen, "crown", false);
  hsr_pen_palette(pen, 2);
  hsr_pen_polygon(pen, 8, crown);
  hsr_pen_place(pen, NULL);
}

enum hsr_status hsr_build_non_planar(struct hsr_scene *scene,
                                     const long long *parameter) {
  static const double view[][8] = {
      {2, 4, 32, 0, -2, 0, 50}, {5, 2, 9, 5, 2, 0, 90},
      {5, 2, -9, 5, 2, 0, 90},  {-8, 2, 8, -8, 2, 0, 90},
      {5, 20, 1, 5, 0, 1, 60},  {0, -8, 9, 0, -8, 0, 90},
      {8, -6, 8, 8, -6, 0, 90}, {24, -2, 2, 0, -2, 0, 60}};
  (void)parameter;
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  lifted(&pen);
  saddle(&pen);
  twisted(&pen);
  HSR_VIEWS(&pen, view, 1);
  hsr_pen_views_to(&pen, 9);
  return pen.status;
}

/* Boxes of five sizes, which all look alike from the origin; a needle from
 * beside the eye to the horizon; and a ground that reaches it. */
enum hsr_status hsr_build_huge_and_tiny(struct hsr_scene *scene,
                                        const long long *parameter) {
  static const double view[][8] = {
      {0, 0, 0, 0, 0, -1, 90},          {0, 0, 0, 1, 0.25, -2, 60},
      {0, 1e-6, 5e-6, 0, 0, -1e-6, 60}, {1e-3, 2e-3, 4e-3, 0, 0, -1e-3, 60},
      {2, 1, 3, 0, 0, -2, 60},          {2e3, 1e3, 4e3, 0, 0, 0, 60},
      {3e6, 4e6, 5e6, 0, 0, -2e6, 50},  {0, 3e6, 0, 0, 0, -1e6, 70},
      {0, 0, 0, 0, 0, -1, 90, 0.5},     {0, 0, 2e6, 0, 0, 0, 1}};
  static const double size[5] = {1e-6, 1e-3, 1, 1e3, 1e6};
  (void)parameter;
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  for (uint32_t i = 0; i < 5; i++) {
    double s = size[i], x = 0.75 * i - 1.75;
    hsr_pen_object(&pen, "box", true);
    hsr_pen_palette(&pen, i);
    hsr_pen_box(&pen, s * x, s * (0.25 * i - 0.75), -3 * s, s * (x + 0.875),
                s * (0.25 * i), -2 * s);
    hsr_pen_place(&pen, NULL);
  }
  hsr_pen_object(&pen, "needle and ground", false);
  hsr_pen_palette(&pen, 7);
  triangle(&pen, P(-1e-6, -1e-6, -1e-6), P(1e-6, -1e-6, -1e-6),
           P(3e5, 4e5, -1e6));
  hsr_pen_palette(&pen, 5);
  hsr_pen_parallelogram(&pen, P(-1e6, -1, 1e6), P(2e6, 0, 0), P(0, 0, -4e6));
  hsr_pen_palette(&pen, 6);
  triangle(&pen, P(-1e6, 1e6, -4e6), P(1e6, 1e6, -4e6), P(0, 1e-6, -1e-6));
  hsr_pen_place(&pen, NULL);
  HSR_VIEWS(&pen, view, 1);
  return pen.status;
}
