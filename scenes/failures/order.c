/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Failure cases of depth and order: what lies before what. */
#include "scenes/builders.h"
#include "scenes/parts/shapes.h"

/* A flat bar from a to b, reaching from -h to +h to both sides. */
static void bar(struct hsr_pen *pen, const double a[3], const double b[3],
                const double h[3]) {
  double p[3], u[3], v[3];
  for (int k = 0; k < 3; k++) {
    p[k] = a[k] - h[k];
    u[k] = b[k] - a[k];
    v[k] = 2 * h[k];
  }
  hsr_pen_parallelogram(pen, p, u, v);
}

/* The same, as a closed bar of depth 1. */
static void thick_bar(struct hsr_pen *pen, const double a[3], const double b[3],
                      const double h[3]) {
  double ring[8][3];
  for (int i = 0; i < 8; i++)
    for (int k = 0; k < 3; k++) {
      double end = i % 4 == 0 || i % 4 == 3 ? a[k] : b[k];
      double side = i % 4 < 2 ? -h[k] : h[k];
      ring[i][k] = end + side + (k == 2 && i >= 4);
    }
  hsr_pen_loft(pen, 4, 2, (const double(*)[3])ring, false);
}

/* Bars along the sides of a triangle, each from far below to near above. */
static const double ring_of_three[3][3][3] = {
    {{-8, -4, -4}, {8, -4, 4}, {0, 1, 0}},
    {{7, -6, -4}, {-1, 10, 4}, {-1, 0, 0}},
    {{1, 10, -4}, {-7, -6, 4}, {1, 0, 0}}};
static const double ring_of_four[4][3][3] = {
    {{-5, -3, -2}, {5, -3, 2}, {0, 1, 0}},
    {{3, -5, -2}, {3, 5, 2}, {-1, 0, 0}},
    {{5, 3, -2}, {-5, 3, 2}, {0, -1, 0}},
    {{-3, 5, -2}, {-3, -5, 2}, {1, 0, 0}}};

/* A bar behind one arm of a fork and before the other: a ring of two. */
static void ring_of_two(struct hsr_pen *pen) {
  static const double fork[8][3] = {{-4, -4, 0}, {4, -4, 0}, {4, 4, 0},
                                    {2, 4, 0},   {2, -2, 0}, {-2, -2, 0},
                                    {-2, 4, 0},  {-4, 4, 0}};
  static const double a[3] = {-6, 1, -3}, b[3] = {6, 1, 3}, h[3] = {0, 1, 0};
  hsr_pen_object(pen, "ring of two", false);
  hsr_pen_frame(pen, 0, 16, 0, 0);
  hsr_pen_palette(pen, 7);
  hsr_pen_polygon(pen, 8, fork);
  hsr_pen_palette(pen, 8);
  bar(pen, a, b, h);
  hsr_pen_place(pen, NULL);
}

enum hsr_status hsr_build_cyclic_overlap(struct hsr_scene *scene,
                                         const long long *parameter) {
  static const double view[][8] = {
      {0, 5, 44, 0, 5, 0, 60},     {0, 2, 24, 0, 2, 0, 90},
      {-20, 2, 16, -20, 2, 0, 90}, {20, 0, 12, 20, 0, 0, 90},
      {6, 22, 20, 0, 14, 0, 60},   {-2, 1, 9, 0, 0, 0, 90}};
  (void)parameter;
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  hsr_pen_object(&pen, "ring of three", false);
  for (uint32_t i = 0; i < 3; i++) {
    hsr_pen_palette(&pen, i);
    bar(&pen, ring_of_three[i][0], ring_of_three[i][1], ring_of_three[i][2]);
  }
  hsr_pen_place(&pen, NULL);
  hsr_pen_object(&pen, "ring of four", false);
  hsr_pen_frame(&pen, 20, 0, 0, 0);
  for (uint32_t i = 0; i < 4; i++) {
    hsr_pen_palette(&pen, i + 3);
    bar(&pen, ring_of_four[i][0], ring_of_four[i][1], ring_of_four[i][2]);
  }
  hsr_pen_place(&pen, NULL);
  ring_of_two(&pen);
  for (uint32_t i = 0; i < 3; i++) {
    hsr_pen_object(&pen, "bar of a ring of solids", true);
    hsr_pen_frame(&pen, -20, 0, 0, 0);
    hsr_pen_palette(&pen, i);
    thick_bar(&pen, ring_of_three[i][0], ring_of_three[i][1],
              ring_of_three[i][2]);
    hsr_pen_place(&pen, NULL);
  }
  HSR_VIEWS(&pen, view, 1);
  hsr_pen_views_to(&pen, 9);
  return pen.status;
}

/* Squares across one another in all three directions. */
static void crossed(struct hsr_pen *pen) {
  hsr_pen_object(pen, "crossed", false);
  for (int k = 0; k < 3; k++) {
    double p[3] = {0}, u[3] = {0}, v[3] = {0};
    p[(k + 1) % 3] = p[(k + 2) % 3] = -4;
    u[(k + 1) % 3] = v[(k + 2) % 3] = 8;
    hsr_pen_palette(pen, (uint32_t)k);
    hsr_pen_parallelogram(pen, p, u, v);
  }
  hsr_pen_place(pen, NULL);
}

/* Leaves through one axis: all their intersections are one line. */
static void pencil(struct hsr_pen *pen) {
  static const double direction[5][2] = {
      {4, 0}, {4, 2}, {3, 3}, {-1, 4}, {-4, 1}};
  hsr_pen_object(pen, "pencil", false);
  hsr_pen_frame(pen, 0, -12, 0, 0);
  for (uint32_t i = 0; i < 5; i++) {
    double x = direction[i][0], z = direction[i][1];
    const double p[3] = {-x, -4, -z}, u[3] = {2 * x, 0, 2 * z},
                 v[3] = {0, 8, 0};
    hsr_pen_palette(pen, i);
    hsr_pen_parallelogram(pen, p, u, v);
  }
  hsr_pen_place(pen, NULL);
}

/* Triangles through a square, and others that just reach it. */
static void poked(struct hsr_pen *pen) {
  static const double square[4][3] = {
      {8, -4, 0}, {16, -4, 0}, {16, 4, 0}, {8, 4, 0}};
  static const double triangle[4][3][3] = {
      {{9, -3, -5}, {14, 1, 5}, {11, 5, -3}},
      {{15, -6, 2}, {17, 3, -2}, {10, -2, 1}},
      {{10, -2, 0}, {10, 2, 0}, {6, 0, 6}},
      {{13, 3, 0}, {11, 6, 4}, {15, 6, 5}}};
  hsr_pen_object(pen, "poked", false);
  hsr_pen_palette(pen, 11);
  hsr_pen_polygon(pen, 4, square);
  for (uint32_t i = 0; i < 4; i++) {
    hsr_pen_palette(pen, i);
    hsr_pen_polygon(pen, 3, triangle[i]);
  }
  hsr_pen_place(pen, NULL);
}

static void solids_in_one(struct hsr_pen *pen) {
  static const double spike[3][3] = {{-18, -2, -2}, {-10, 3, 7}, {-7, -5, 2}};
  hsr_pen_object(pen, "cube", true);
  hsr_pen_palette(pen, 4);
  hsr_pen_box(pen, -15, -3, -3, -9, 3, 3);
  hsr_pen_place(pen, NULL);
  hsr_pen_object(pen, "tetrahedron", true);
  hsr_pen_palette(pen, 2);
  static const int face[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  uint32_t first = 0;
  for (int i = 0; i < 4; i++) {
    uint32_t v =
        i < 3 ? hsr_pen_vertex(pen, spike[i][0], spike[i][1], spike[i][2])
              : hsr_pen_vertex(pen, -12, -4, -6);
    first = i ? first : v;
  }
  for (int i = 0; i < 4; i++) {
    const uint32_t v[3] = {first + (uint32_t)face[i][0],
                           first + (uint32_t)face[i][1],
                           first + (uint32_t)face[i][2]};
    hsr_pen_face(pen, 3, v);
  }
  hsr_pen_place(pen, NULL);
}

enum hsr_status hsr_build_penetration(struct hsr_scene *scene,
                                      const long long *parameter) {
  static const double view[][8] = {
      {10, 9, 38, 1, -3, 0, 48},   {0, 0, 16, 0, 0, 0, 90},
      {12, 0, 8, 12, 0, 0, 90},    {-12, 0, 10, -12, 0, 0, 90},
      {0, -12, 8, 0, -12, 0, 90},  {0, 12, 0, 0, 0, 0, 90},
      {-3, -2, 2, 10, -1, -1, 80}, {1, 1, 1, -10, 0, 0, 90}};
  (void)parameter;
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  crossed(&pen);
  pencil(&pen);
  poked(&pen);
  solids_in_one(&pen);
  HSR_VIEWS(&pen, view, 1);
  hsr_pen_views_to(&pen, 10);
  return pen.status;
}

/* Overlapping faces in lattice steps (s, t) of one plane: a square; the same,
 * again, reversed, and begun elsewhere; part of it, across it, about it; an
 * arrow, a pentagon with a straight angle; one that shares half an edge. */
static const signed char overlay[][7][2] = {
    {{4}, {0, 0}, {4, 0}, {4, 4}, {0, 4}},
    {{4}, {0, 0}, {4, 0}, {4, 4}, {0, 4}},
    {{4}, {0, 4}, {4, 4}, {4, 0}, {0, 0}},
    {{4}, {4, 4}, {0, 4}, {0, 0}, {4, 0}},
    {{3}, {1, 1}, {3, 1}, {2, 3}},
    {{3}, {-2, 2}, {2, -2}, {6, 6}},
    {{4}, {-1, 1}, {2, -2}, {6, 3}, {3, 6}},
    {{4}, {2, 6}, {3, 3}, {6, 2}, {2, 2}},
    {{5}, {0, -3}, {2, -3}, {4, -3}, {4, 1}, {0, 1}},
    {{4}, {4, 2}, {8, 2}, {8, 6}, {4, 6}},
    {{6}, {-4, -4}, {8, -4}, {8, -3}, {-3, -3}, {-3, 8}, {-4, 8}}};

static void overlays(struct hsr_pen *pen, const double o[3], const double u[3],
                     const double v[3], bool backwards) {
  int n = sizeof overlay / sizeof *overlay;
  for (int i = 0; i < n; i++) {
    const signed char(*st)[2] = overlay[backwards ? n - 1 - i : i];
    double p[6][3];
    for (int c = 0; c < st[0][0]; c++)
      for (int k = 0; k < 3; k++)
        p[c][k] = o[k] + st[c + 1][0] * u[k] + st[c + 1][1] * v[k];
    hsr_pen_palette(pen, (uint32_t)i);
    hsr_pen_polygon(pen, (uint32_t)st[0][0], (const double(*)[3])p);
  }
}

/* A closed box, and plates that lie in its sides without thickness. */
static void decals(struct hsr_pen *pen) {
  static const double plate[5][4][3] = {
      {{14, 2, 0}, {18, 2, 0}, {18, 6, 0}, {14, 6, 0}},
      {{14, 6, 0}, {22, 6, 0}, {22, 2, 0}, {16, 2, 0}},
      {{13, 8, -1}, {19, 8, -1}, {19, 8, -7}, {13, 8, -7}},
      {{12, 1, -7}, {12, 1, -1}, {12, 7, -1}, {12, 7, -7}},
      {{20, 8, 0}, {20, 0, 0}, {20, 0, -8}, {20, 8, -8}}};
  hsr_pen_object(pen, "box", true);
  hsr_pen_palette(pen, 11);
  hsr_pen_box(pen, 12, 0, -8, 20, 8, 0);
  hsr_pen_place(pen, NULL);
  hsr_pen_object(pen, "decals", false);
  for (uint32_t i = 0; i < 5; i++) {
    hsr_pen_palette(pen, i);
    hsr_pen_polygon(pen, 4, plate[i]);
  }
  hsr_pen_place(pen, NULL);
}

enum hsr_status hsr_build_coplanar(struct hsr_scene *scene,
                                   const long long *parameter) {
  static const double view[][8] = {
      {6, 8, 32, 4, 1, 0, 60},      {2, 2, 9, 2, 2, 0, 90},
      {2, 2, -9, 2, 2, 0, 90},      {-12, 0, 20, -12, 0, 0, 90},
      {16, 4, 8, 16, 4, 0, 90},     {16, 20, -4, 16, 0, -4, 90},
      {-20, -9, -30, -8, 0, 0, 60}, {4, 0, 12, -12, 2, -3, 75}};
  static const double zero[3] = {0}, x[3] = {1, 0, 0}, y[3] = {0, 1, 0};
  static const double o[3] = {-14, 2, 1}, u[3] = {3, -2, 0}, v[3] = {0, 2, -1};
  (void)parameter;
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  hsr_pen_object(&pen, "wall", false); /* z = 0 */
  overlays(&pen, zero, x, y, false);
  hsr_pen_place(&pen, NULL);
  hsr_pen_object(&pen, "slant", false); /* 2x + 3y + 6z = -16 */
  overlays(&pen, o, u, v, true);
  hsr_pen_place(&pen, NULL);
  decals(&pen);
  HSR_VIEWS(&pen, view, 1);
  hsr_pen_views_to(&pen, 9);
  return pen.status;
}

static void cube_at(struct hsr_pen *pen, double x, double size, uint32_t colour,
                    bool one_sided) {
  hsr_pen_object(pen, "cube", one_sided);
  hsr_pen_palette(pen, colour);
  hsr_pen_box(pen, x, 0, 0, x + size, size, size);
  hsr_pen_place(pen, NULL);
}

/* From small to large, from large to small, thrice the same, and two-sided;
 * all cubes of a row have a corner, and so three planes, in common. */
enum hsr_status hsr_build_nested_solids(struct hsr_scene *scene,
                                        const long long *parameter) {
  static const double view[][8] = {
      {50, 34, 56, 28, 1, 0, 52}, {-14, 9, -18, 22, 4, 4, 60},
      {8, 8, 32, 8, 8, 0, 90},    {1, 1, 1, 16, 1, 1, 90},
      {7, 1, 3, 0, 0, 0, 90},     {52, 3, 3, 60, 2, 1, 90},
      {28, 40, 4, 28, 0, 4, 90},  {24, 8, 24, 24, 0, 0, 90}};
  (void)parameter;
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  uint32_t colour = 0;
  for (int size = 1; size <= 8; size *= 2)
    cube_at(&pen, 0, size, colour++, true);
  for (int size = 8; size; size /= 2)
    cube_at(&pen, 16, size, colour++, true);
  for (int i = 0; i < 3; i++)
    cube_at(&pen, 32, 8, colour++, true);
  for (int size = 8; size; size /= 2)
    cube_at(&pen, 48, size, colour++, false);
  HSR_VIEWS(&pen, view, 1);
  hsr_pen_views_to(&pen, 9);
  return pen.status;
}

/* A box without its front: from above and behind one looks into it. */
static void open_box(struct hsr_pen *pen, double x, bool inverted) {
  hsr_pen_object(pen, inverted ? "inverted box" : "open box", true);
  hsr_pen_palette(pen, inverted ? 1 : 0);
  uint32_t v[8];
  for (int i = 0; i < 8; i++)
    v[i] =
        hsr_pen_vertex(pen, x + (i & 1 ? 6 : 0), i & 2 ? 6 : 0, i & 4 ? 6 : 0);
  static const int side[5][4] = {
      {0, 2, 3, 1}, {0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}};
  for (int i = 0; i < 5; i++) {
    uint32_t face[4];
    for (int c = 0; c < 4; c++)
      face[c] = v[side[i][inverted ? 3 - c : c]];
    hsr_pen_face(pen, 4, face);
  }
  hsr_pen_place(pen, NULL);
}

/* Two plates back to back on one plane: each is seen from one side only. */
static void back_to_back(struct hsr_pen *pen) {
  hsr_pen_object(pen, "back to back", true);
  for (int i = 0; i < 2; i++) {
    const double p[3] = {i ? 22 : 16, 0, 3}, u[3] = {i ? -6 : 6, 0, 0},
                 v[3] = {0, 6, 0};
    hsr_pen_palette(pen, 2 + (uint32_t)i);
    hsr_pen_parallelogram(pen, p, u, v);
  }
  hsr_pen_place(pen, NULL);
}

enum hsr_status hsr_build_one_sided(struct hsr_scene *scene,
                                    const long long *parameter) {
  static const double view[][8] = {
      {14, 16, 28, 7, 3, 3, 50}, {14, 10, -24, 8, 3, 3, 50},
      {11, 3, 16, 11, 3, 0, 90}, {11, 3, -12, 11, 3, 0, 90},
      {3, 3, 3, 12, 3, 3, 90},   {11, 3, 3, 0, 3, 3, 90},
      {8, 24, 3, 8, 0, 3, 60},   {-12, 3, 3, 0, 3, 3, 90}};
  static const double p[3] = {-2, 1, 2}, u[3] = {26, 0, 1}, v[3] = {0, 2, 1};
  (void)parameter;
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  open_box(&pen, 0, false);
  open_box(&pen, 8, true);
  back_to_back(&pen);
  hsr_pen_object(&pen, "two-sided ribbon", false);
  hsr_pen_palette(&pen, 4);
  hsr_pen_parallelogram(&pen, p, u, v);
  hsr_pen_place(&pen, NULL);
  HSR_VIEWS(&pen, view, 1);
  hsr_pen_views_to(&pen, 10);
  return pen.status;
}

/* Equal plates in a row: from the front each hides the next, which looks a
 * little smaller, so that edges have an invisibility of 0 to 299. A triangle
 * at the end is behind them all. */
enum hsr_status hsr_build_deep_stack(struct hsr_scene *scene,
                                     const long long *parameter) {
  static const double view[][8] = {
      {9, 13, 24, -2, -4, -40, 60},    {0, 0, 10, 0, 0, 0, 90},
      {0, 0, -330, 0, 0, 0, 20},       {30, 20, 60, 0, 0, -100, 40},
      {0, 0, 2, 0, 0, -10, 90},        {0, 0, -149.5, 0, 0, -300, 60},
      {200, 60, -150, 0, 0, -150, 60}, {-40, 15, -340, 0, 0, -200, 40}};
  (void)parameter;
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  hsr_pen_object(&pen, "stack", false);
  for (int i = 0; i < 300; i++) {
    const double p[3] = {-10, -10, -i}, u[3] = {20, 0, 0}, v[3] = {0, 20, 0};
    hsr_pen_rgb(&pen, 0.9 - i / 400.0, 0.4 + 0.3 * (i % 2), 0.2 + i / 500.0);
    hsr_pen_parallelogram(&pen, p, u, v);
  }
  hsr_pen_place(&pen, NULL);
  static const double last[3][3] = {
      {-6, -5, -302}, {7, -4, -301}, {1, 8, -305}};
  hsr_pen_object(&pen, "last", false);
  hsr_pen_palette(&pen, 1);
  hsr_pen_polygon(&pen, 3, last);
  hsr_pen_place(&pen, NULL);
  HSR_VIEWS(&pen, view, 1);
  return pen.status;
}
