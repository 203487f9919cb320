/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Failure cases of edges and outlines.
 *
 * Several are made for the samples of pictures of 64 x 64, 512 x 512 and
 * 97 x 61, seen by a camera that looks along an axis with a right angle of
 * vision: a point at depth w and offset x from the axis lies on a column of
 * 64 samples if x/w is an odd number of 64ths, and on a row of 61 samples if
 * y/w is an even number of 61ths. */
#include "scenes/builders.h"
#include "scenes/parts/shapes.h"

#include <math.h>

static void flat(struct hsr_pen *pen, uint32_t n, const double (*xy)[2],
                 double z) {
  double p[32][3];
  for (uint32_t i = 0; i < n; i++) {
    p[i][0] = xy[i][0];
    p[i][1] = xy[i][1];
    p[i][2] = z;
  }
  hsr_pen_polygon(pen, n, (const double(*)[3])p);
}

static void rectangle(struct hsr_pen *pen, double x0, double y0, double x1,
                      double y1, double z) {
  const double xy[4][2] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  flat(pen, 4, xy, z);
}

/* One wide face beside several narrow ones, and a hypotenuse with corners of
 * others on it. */
static void exact_junctions(struct hsr_pen *pen) {
  static const double step[5] = {0, 4, 9, 12, 16};
  static const double big[3][2] = {{16, 0}, {28, 16}, {16, 16}};
  static const double small[3][4][2] = {{{16, 0}, {28, 0}, {28, 4}, {19, 4}},
                                        {{19, 4}, {28, 4}, {28, 8}, {22, 8}},
                                        {{22, 8}, {28, 8}, {28, 16}}};
  hsr_pen_object(pen, "exact", false);
  hsr_pen_palette(pen, 1);
  rectangle(pen, -12, 0, 0, 16, 0);
  for (uint32_t i = 0; i < 4; i++) {
    hsr_pen_palette(pen, i + 2);
    rectangle(pen, 0, step[i], 12, step[i + 1], 0);
  }
  hsr_pen_palette(pen, 7);
  flat(pen, 3, big, 0);
  for (uint32_t i = 0; i < 3; i++) {
    hsr_pen_palette(pen, 8 + i);
    flat(pen, i < 2 ? 4 : 3, small[i], 0);
  }
  hsr_pen_place(pen, NULL);
}

/* Corners at the thirds of an edge: rounded, they lie beside it. */
static void thirds(struct hsr_pen *pen) {
  static const double whole[3][3] = {{36, 0, 0}, {43, 5, 2}, {36, 5, 2}};
  hsr_pen_object(pen, "thirds", false);
  for (uint32_t i = 0; i < 3; i++) {
    double a = i / 3.0, b = (i + 1) / 3.0;
    const double p[4][3] = {{36 + 7 * a, 5 * a, 2 * a},
                            {44, 5 * a, 2 * a},
                            {44, 5 * b, 2 * b},
                            {36 + 7 * b, 5 * b, 2 * b}};
    hsr_pen_palette(pen, i);
    hsr_pen_polygon(pen, 4, p);
  }
  hsr_pen_palette(pen, 5);
  hsr_pen_polygon(pen, 3, whole);
  hsr_pen_place(pen, NULL);
}

enum hsr_status hsr_build_t_junction(struct hsr_scene *scene,
                                     const long long *parameter) {
  static const double view[][8] = {
      {10, 8, 40, 12, 8, 0, 55},  {12, 8, 16, 12, 8, 0, 90},
      {12, 8, -16, 12, 8, 0, 90}, {0, 6, 6, 0, 6, 0, 90},
      {22, 8, 9, 22, 8, 0, 90},   {40, 4, 5, 38, 3, 0, 90},
      {30, 9, 12, 36, 3, 0, 60},  {6, 2, 4, 16, 5, 0, 80}};
  (void)parameter;
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  exact_junctions(&pen);
  thirds(&pen);
  HSR_VIEWS(&pen, view, 1);
  hsr_pen_views_to(&pen, 9);
  return pen.status;
}

/* A plate of 10 x 10 cells that share their vertices, some of them divided
 * along one diagonal or the other. */
static void mesh(struct hsr_pen *pen, const char *name, double x0, double y0,
                 double dx, double dy, double z) {
  hsr_pen_object(pen, name, false);
  uint32_t first = 0;
  for (uint32_t i = 0; i < 121; i++) {
    uint32_t v = hsr_pen_vertex(pen, x0 + dx * (i % 11), y0 + dy * (i / 11), z);
    first = i ? first : v;
  }
  for (uint32_t i = 0; i < 100; i++) {
    uint32_t a = first + i % 10 + 11 * (i / 10);
    const uint32_t v[6] = {a, a + 1, a + 12, a + 11, a, a + 1};
    uint32_t kind = i % 3, from = kind == 1;
    hsr_pen_palette(pen, i * 5 + i / 10);
    if (kind == 2) {
      hsr_pen_face(pen, 4, v);
      continue;
    }
    const uint32_t half[2][3] = {{v[from], v[from + 1], v[from + 2]},
                                 {v[from + 2], v[(from + 3) % 4], v[from]}};
    hsr_pen_face(pen, 3, half[0]);
    hsr_pen_palette(pen, i * 7 + 3);
    hsr_pen_face(pen, 3, half[1]);
  }
  hsr_pen_place(pen, NULL);
}

enum hsr_status hsr_build_shared_edges(struct hsr_scene *scene,
                                       const long long *parameter) {
  static const double view[][8] = {
      {0, 0, 0, 0, 0, -1, 90},          {2, -4, 0, 2, -4, -1, 90},
      {-6, 2, 0, -6, 2, -1, 90},        {0, 0, -128, 0, 0, 1, 90},
      {0, 0, -1024, 0, 0, 1, 90},       {0, 0, 448, 0, 0, -1, 90},
      {1, 1, -3, 1, 1, -4, 90},         {0, 0, 0, 0, 0, -1, 90, 61},
      {0, 0, 0, 0, 0, -1, 90, 10},      {2, 2, -122, 2, 2, 0, 90},
      {300, 200, 300, 60, 40, -200, 50}};
  (void)parameter;
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  mesh(&pen, "for 97 x 61", -90, -60, 18, 6, -61);
  mesh(&pen, "for 64 x 64", -61, 1, 6, 6, -64);
  mesh(&pen, "for 512 x 512", 1, 1, 48, 48, -512);
  HSR_VIEWS(&pen, view, 1);
  return pen.status;
}

/* Faces with straight angles, beginning at one and not. */
static void straight_angles(struct hsr_pen *pen) {
  static const double square[12][2] = {{-12, 0}, {-10, 0}, {-7, 0},  {-4, 0},
                                       {-4, 1},  {-4, 6},  {-4, 8},  {-5, 8},
                                       {-6, 8},  {-12, 8}, {-12, 4}, {-12, 2}};
  static const double triangle[6][2] = {{-8, 10}, {-6, 10}, {-4, 10},
                                        {-6, 13}, {-8, 16}, {-8, 13}};
  hsr_pen_object(pen, "straight angles", false);
  hsr_pen_palette(pen, 0);
  flat(pen, 12, square, 0);
  hsr_pen_palette(pen, 1);
  flat(pen, 6, triangle, 0);
  hsr_pen_place(pen, NULL);
}

/* Leaves that hang on one line, their edges over, in and beside one another. */
static void hinge(struct hsr_pen *pen) {
  static const double leaf[8][4] = {
      /* from x, to x, direction y, z */
      {0, 12, 4, 0},  {0, 12, 3, 2}, {2, 6, 2, 3},   {4, 9, 0, 4},
      {6, 12, -2, 3}, {0, 4, -3, 2}, {12, 16, 4, 0}, {9, 14, -4, 0}};
  hsr_pen_object(pen, "hinge", false);
  for (uint32_t i = 0; i < 8; i++) {
    const double p[3] = {leaf[i][0], 4, 0},
                 u[3] = {leaf[i][1] - leaf[i][0], 0, 0},
                 v[3] = {0, leaf[i][2], leaf[i][3]};
    hsr_pen_palette(pen, i + 2);
    hsr_pen_parallelogram(pen, p, u, v);
  }
  hsr_pen_place(pen, NULL);
}

/* Plates at several depths whose edges fall on the same lines of the picture
 * for an eye at (0, 0, 32): their corners are proportional to the depth. */
static void lined_up(struct hsr_pen *pen) {
  static const double depth[5] = {16, 24, 32, 40, 48};
  hsr_pen_object(pen, "lined up", false);
  for (uint32_t i = 0; i < 5; i++) {
    double w = depth[i], a = w * (i & 1 ? -0.75 : -0.5), b = w * 0.5;
    hsr_pen_palette(pen, i + 6);
    rectangle(pen, i & 1 ? -b : a, i & 1 ? -b : a, w * (i + 1) / 8,
              i == 3 ? w / 8 : -w / 4, 32 - w);
  }
  hsr_pen_place(pen, NULL);
}

enum hsr_status hsr_build_collinear_edges(struct hsr_scene *scene,
                                          const long long *parameter) {
  static const double view[][8] = {
      {0, 0, 32, 0, 0, 0, 90},    {4, 10, 36, 2, 3, 0, 50},
      {0, 4, 20, 0, 4, 0, 90},    {30, 4, 0, 0, 4, 0, 60},
      {-8, 4, 8, -8, 4, 0, 90},   {6, 4, 4, 6, 4, 0, 90},
      {6, 20, 1, 6, 0, 1, 60},    {-20, -9, -30, 0, 2, 0, 50},
      {0, 0, 32, 0, 0, 0, 90, 24}};
  (void)parameter;
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  straight_angles(&pen);
  hinge(&pen);
  lined_up(&pen);
  HSR_VIEWS(&pen, view, 1);
  return pen.status;
}

/* Wedges along the odd lines of a 64 x 64 picture, from an eighth to one unit
 * in the last place of their ordinates wide, above and below the axis; and
 * needles in any direction whose third corner is the next double. */
static void wedges(struct hsr_pen *pen) {
  hsr_pen_object(pen, "wedges", false);
  for (int i = 0; i < 32; i++) {
    double y = 33 + 2 * (i / 2), width = 1;
    for (int halvings = 3 * (i / 2) + 2; halvings; halvings--)
      width /= 2;
    if (i & 1)
      y = -y;
    const double p[3][3] = {{-60, y, -64}, {60, y, -64}, {60, y + width, -64}};
    hsr_pen_palette(pen, (uint32_t)i);
    hsr_pen_polygon(pen, 3, p);
  }
  hsr_pen_place(pen, NULL);
}

static void needles(struct hsr_pen *pen) {
  struct hsr_random random = {7};
  hsr_pen_object(pen, "needles", false);
  for (uint32_t i = 0; i < 24; i++) {
    double p[3][3];
    for (int k = 0; k < 3; k++) {
      p[0][k] = 60 * hsr_random_unit(&random) - 30;
      p[1][k] = p[2][k] = 60 * hsr_random_unit(&random) - 30;
    }
    for (int c = 0; c < 3; c++)
      p[c][2] -= 70;
    p[2][i % 3] = nextafter(p[2][i % 3], 100);
    hsr_pen_palette(pen, i);
    hsr_pen_polygon(pen, 3, (const double(*)[3])p);
  }
  hsr_pen_place(pen, NULL);
}

enum hsr_status hsr_build_sliver(struct hsr_scene *scene,
                                 const long long *parameter) {
  static const double view[][8] = {
      {0, 0, 0, 0, 0, -1, 90},        {0, 0, -128, 0, 0, 0, 90},
      {1, 0, 0, 1, 0, -1, 90},        {0, 33, -32, 0, 33, -64, 90},
      {40, 20, 20, 0, 0, -64, 60},    {0, 63, 0, 0, 63, -64, 90},
      {-70, 35, -64, 0, 35, -64, 60}, {0, 80, -70, 0, 0, -70, 90},
      {59, 47, -60, 59, 47, -64, 90}};
  (void)parameter;
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  wedges(&pen);
  needles(&pen);
  hsr_pen_object(&pen, "wall", false);
  hsr_pen_palette(&pen, 11);
  rectangle(&pen, -120, -120, 120, 120, -120);
  hsr_pen_place(&pen, NULL);
  HSR_VIEWS(&pen, view, 1);
  return pen.status;
}

/* Row 0: the gap about a sample; 1: beside it, to the right; 2: from it to the
 * right; 3: from the left up to it. The samples are at odd x. */
static void gap(int row, double width, double *left, double *right) {
  *left = row == 0 ? -width : row == 1 ? width : row == 2 ? 0 : -width;
  *right = row == 0 ? width : row == 1 ? 2 * width : row == 2 ? width : 0;
}

enum hsr_status hsr_build_sub_pixel_gap(struct hsr_scene *scene,
                                        const long long *parameter) {
  static const double view[][8] = {
      {0, 0, 0, 0, 0, -1, 90},           {2, 4, 0, 2, 4, -1, 90},
      {0, 0, 448, 0, 0, -1, 90},         {0, 0, -32, 0, 0, -64, 90},
      {0.5, 0.25, 0, 0.5, 0.25, -1, 90}, {40, 30, 20, 0, 0, -64, 60},
      {0, 0, 3, 0, 0, -64, 90},          {-9, 47, -63, -9, 47, -64, 90}};
  (void)parameter;
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  hsr_pen_object(&pen, "fence", false);
  for (int row = 0; row < 4; row++) {
    double x = -63, y = 64 - 32 * row;
    for (int i = 0; i < 32; i++) {
      /* Down to 2^-47, the last place of numbers about 50. */
      double width = 0.25, left, right;
      for (int k = 0; k < i * 3 / 2 && k < 45; k++)
        width /= 2;
      gap(row, width, &left, &right);
      double sample = -61 + 4 * i;
      hsr_pen_palette(&pen, (uint32_t)(i + 5 * row));
      rectangle(&pen, x, y - 31, sample + left, y - 1, -64);
      x = sample + right;
    }
  }
  hsr_pen_place(&pen, NULL);
  hsr_pen_object(&pen, "wall", false);
  hsr_pen_rgb(&pen, 0.02, 0.02, 0.02);
  rectangle(&pen, -160, -160, 160, 160, -128);
  hsr_pen_place(&pen, NULL);
  HSR_VIEWS(&pen, view, 1);
  hsr_pen_views_to(&pen, 9);
  return pen.status;
}

/* A pleated disc of n triangles about (1, 1, -64), which is a sample of the
 * standard view at 64 x 64, and a pencil of needles from one point. */
enum hsr_status hsr_build_needle_fan(struct hsr_scene *scene,
                                     const long long *parameter) {
  static const double view[][8] = {
      {0, 0, 0, 0, 0, -1, 90},      {0, 0, -128, 0, 0, 0, 90},
      {1, 1, 0, 1, 1, -1, 90},      {1, 1, -60, 1, 1, -64, 90},
      {60, 40, 0, 0, 0, -64, 60},   {90, 1, -64, 1, 1, -64, 60},
      {1, 1, -64, 0, -60, -50, 90}, {-59, -60, -40, -40, -60, -64, 90}};
  enum { N = 720 };
  (void)parameter;
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  hsr_pen_object(&pen, "pleats", false);
  uint32_t hub = hsr_pen_vertex(&pen, 1, 1, -64), rim = 0;
  for (uint32_t i = 0; i < N; i++) {
    double c, s;
    hsr_unit(i, N, &c, &s);
    uint32_t v =
        hsr_pen_vertex(&pen, 1 + 50 * c, 1 + 50 * s, i & 1 ? -62 : -68);
    rim = i ? rim : v;
  }
  for (uint32_t i = 0; i < N; i++) {
    const uint32_t v[3] = {hub, rim + i, rim + (i + 1) % N};
    hsr_pen_palette(&pen, i);
    hsr_pen_face(&pen, 3, v);
  }
  hsr_pen_place(&pen, NULL);
  hsr_pen_object(&pen, "needles", false);
  for (int i = 0; i < 200; i++) {
    double y = -60 + i / 1024.0;
    const double p[3][3] = {
        {-60, -60, -50}, {55, y, -50}, {55, y + 1 / 1024.0, -50}};
    hsr_pen_palette(&pen, (uint32_t)i);
    hsr_pen_polygon(&pen, 3, p);
  }
  hsr_pen_place(&pen, NULL);
  HSR_VIEWS(&pen, view, 1);
  return pen.status;
}

/* Teeth upwards from (0, 0), 2 apart: 4 n vertices. */
static uint32_t comb(double (*xy)[2], int teeth) {
  uint32_t n = 0;
  xy[n][0] = 0;
  xy[n++][1] = 0;
  xy[n][0] = 2 * teeth - 1;
  xy[n++][1] = 0;
  for (int i = teeth - 1; i >= 0; i--) {
    const double tooth[4][2] = {
        {2 * i + 1, 8}, {2 * i, 8}, {2 * i, 2}, {2 * i - 1, 2}};
    for (int k = 0; k < (i ? 4 : 2); k++) {
      xy[n][0] = tooth[k][0];
      xy[n++][1] = tooth[k][1];
    }
  }
  return n;
}

static uint32_t star(double (*xy)[2], uint32_t n, double inner, double outer) {
  for (uint32_t i = 0; i < n; i++) {
    double c, s, r = i & 1 ? inner : outer;
    hsr_unit(i, n, &c, &s);
    xy[i][0] = r * c;
    xy[i][1] = r * s;
  }
  return n;
}

/* A corridor of width 1 that winds inwards, and back. */
static const double spiral[22][2] = {
    {0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 2}, {8, 2}, {8, 8}, {2, 8},
    {2, 4}, {6, 4},  {6, 6},   {5, 6},  {5, 5}, {3, 5}, {3, 7}, {7, 7},
    {7, 3}, {1, 3},  {1, 9},   {9, 9},  {9, 1}, {0, 1}};

static void cut_outs(struct hsr_pen *pen) {
  static const double arrow[4][2] = {{0, -14}, {8, -10}, {0, -6}, {3, -10}};
  double xy[32][2];
  hsr_pen_object(pen, "flat", false);
  hsr_pen_palette(pen, 0);
  flat(pen, comb(xy, 6), (const double(*)[2])xy, 0);
  hsr_pen_palette(pen, 1);
  hsr_pen_frame(pen, 14, 0, -2, 0);
  flat(pen, 22, spiral, 0);
  hsr_pen_palette(pen, 2);
  hsr_pen_frame(pen, -8, 6, -1, 0);
  flat(pen, star(xy, 10, 3, 8), (const double(*)[2])xy, 0);
  hsr_pen_palette(pen, 3);
  hsr_pen_frame(pen, 18, -10, 2, 0);
  flat(pen, star(xy, 32, 2, 8), (const double(*)[2])xy, 0);
  hsr_pen_palette(pen, 5);
  hsr_pen_frame(pen, 0, 0, 3, 0);
  flat(pen, 4, arrow, 0);
  hsr_pen_place(pen, NULL);
}

/* Faces that run through a comb's teeth and a spiral's walls. */
static void solid_cut_outs(struct hsr_pen *pen) {
  double xy[32][2];
  uint32_t n = comb(xy, 6);
  hsr_pen_object(pen, "comb", true);
  hsr_pen_palette(pen, 6);
  hsr_pen_frame(pen, 0, 2, -8, 0);
  hsr_pen_extrusion(pen, n, (const double(*)[2])xy, -4, 0);
  hsr_pen_place(pen, NULL);
  hsr_pen_object(pen, "spiral", true);
  hsr_pen_palette(pen, 7);
  hsr_pen_frame(pen, -22, -10, -12, 0);
  hsr_pen_extrusion(pen, 22, spiral, 0, 8);
  hsr_pen_place(pen, NULL);
}

enum hsr_status hsr_build_non_convex(struct hsr_scene *scene,
                                     const long long *parameter) {
  static const double view[][8] = {
      {6, 8, 44, 2, -1, -2, 55}, {5, 4, 9, 5, 4, 0, 90},
      {19, 5, 9, 19, 5, 0, 90},  {19, 5, -12, 19, 5, 0, 90},
      {-8, 6, 8, -8, 6, 0, 90},  {-17, -5, 6, -17, -5, 0, 90},
      {3, 6, -20, 6, 5, -8, 70}, {-17, 14, -8, -17, 0, -8, 60}};
  (void)parameter;
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  cut_outs(&pen);
  solid_cut_outs(&pen);
  HSR_VIEWS(&pen, view, 1);
  hsr_pen_views_to(&pen, 9);
  return pen.status;
}
