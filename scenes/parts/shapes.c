/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scenes/parts/shapes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void hsr_pen_init(struct hsr_pen *pen, struct hsr_scene *scene) {
  *pen = (struct hsr_pen){.scene = scene, .rgb = {0.5f, 0.5f, 0.5f}};
  hsr_pen_frame(pen, 0, 0, 0, 0);
}

/* Remembers the first failure. */
static void note(struct hsr_pen *pen, enum hsr_status status) {
  if (!pen->status)
    pen->status = status;
}

void hsr_pen_object(struct hsr_pen *pen, const char *name, bool one_sided) {
  hsr_pen_frame(pen, 0, 0, 0, 0);
  if (pen->status)
    return;
  struct hsr_object *object = hsr_scene_object(pen->scene, name);
  if (!object) {
    note(pen, HSR_E_NOMEM);
    return;
  }
  object->one_sided = one_sided;
  pen->object = pen->scene->n_objects - 1;
}

void hsr_pen_rgb(struct hsr_pen *pen, double r, double g, double b) {
  pen->rgb[0] = (float)r;
  pen->rgb[1] = (float)g;
  pen->rgb[2] = (float)b;
}

void hsr_pen_paint(struct hsr_pen *pen, unsigned colour) {
  double part[3];
  for (int i = 0; i < 3; i++) {
    part[i] = (double)(colour >> (16 - 8 * i) & 0xff) / 255;
    part[i] *= part[i];
  }
  hsr_pen_rgb(pen, part[0], part[1], part[2]);
}

void hsr_pen_palette(struct hsr_pen *pen, uint32_t i) {
  static const unsigned colour[12] = {0xd95f4b, 0x4f86c6, 0xe5b24a, 0x5fa35f,
                                      0x9b6bb3, 0x5bb5b0, 0xe08a5b, 0x7d8fd1,
                                      0xb9c257, 0xd47fa6, 0x8c7a64, 0xb9bcc0};
  hsr_pen_paint(pen, colour[i % 12]);
}

void hsr_pen_matrix(double m[12], double x, double y, double z, int quarters) {
  static const double cosine[4] = {1, 0, -1, 0}, sine[4] = {0, 1, 0, -1};
  double c = cosine[quarters & 3], s = sine[quarters & 3];
  const double rows[12] = {c, 0, s, x, 0, 1, 0, y, -s, 0, c, z};
  memcpy(m, rows, sizeof rows);
}

void hsr_pen_glass(struct hsr_pen *pen, double opacity) {
  if (!pen->status)
    pen->scene->objects[pen->object].opacity = (float)opacity;
}

void hsr_pen_frame(struct hsr_pen *pen, double x, double y, double z,
                   int quarters) {
  hsr_pen_matrix(pen->m, x, y, z, quarters);
}

uint32_t hsr_pen_vertex(struct hsr_pen *pen, double x, double y, double z) {
  uint32_t number = 0;
  if (pen->status)
    return number;
  const double p[3] = {x, y, z};
  double q[3];
  hsr_instance_vertex(pen->m, p, q);
  struct hsr_object *object = &pen->scene->objects[pen->object];
  note(pen, hsr_object_vertex(object, q[0], q[1], q[2], &number));
  return number;
}

static void face(struct hsr_pen *pen, uint32_t n, const uint32_t *vertices) {
  if (!pen->status)
    note(pen, hsr_object_face(&pen->scene->objects[pen->object], vertices, n,
                              pen->rgb));
}

void hsr_pen_face(struct hsr_pen *pen, uint32_t n, const uint32_t *vertices) {
  if (!pen->triangles)
    face(pen, n, vertices);
  for (uint32_t k = 2; pen->triangles && k < n; k++)
    face(pen, 3,
         (const uint32_t[3]){vertices[0], vertices[k - 1], vertices[k]});
}

/* The face first, first + 1, ..., first + n - 1, or that backwards. */
static void run(struct hsr_pen *pen, uint32_t first, uint32_t n,
                bool backwards) {
  uint32_t *v = malloc(n * sizeof *v);
  if (!v) {
    note(pen, HSR_E_NOMEM);
    return;
  }
  for (uint32_t i = 0; i < n; i++)
    v[i] = first + (backwards ? n - 1 - i : i);
  hsr_pen_face(pen, n, v);
  free(v);
}

/* n vertices; the number of the first. */
static uint32_t vertices(struct hsr_pen *pen, uint32_t n,
                         const double (*p)[3]) {
  uint32_t first = 0;
  for (uint32_t i = 0; i < n; i++) {
    uint32_t number = hsr_pen_vertex(pen, p[i][0], p[i][1], p[i][2]);
    first = i ? first : number;
  }
  return first;
}

void hsr_pen_polygon(struct hsr_pen *pen, uint32_t n, const double (*p)[3]) {
  run(pen, vertices(pen, n, p), n, false);
}

void hsr_pen_parallelogram(struct hsr_pen *pen, const double p[3],
                           const double u[3], const double v[3]) {
  double corner[4][3];
  for (int i = 0; i < 3; i++) {
    corner[0][i] = p[i];
    corner[1][i] = p[i] + u[i];
    corner[2][i] = p[i] + u[i] + v[i];
    corner[3][i] = p[i] + v[i];
  }
  hsr_pen_polygon(pen, 4, (const double(*)[3])corner);
}

/* One side of a loft, between a-b below and d-c above. */
static void side(struct hsr_pen *pen, uint32_t a, uint32_t b, uint32_t c,
                 uint32_t d, bool triangles) {
  const uint32_t quad[4] = {a, b, c, d}, rest[3] = {a, c, d};
  hsr_pen_face(pen, triangles ? 3 : 4, quad);
  if (triangles)
    hsr_pen_face(pen, 3, rest);
}

/* A loft but for its top, whose first vertex is returned. */
static uint32_t open_loft(struct hsr_pen *pen, uint32_t n, uint32_t k,
                          const double (*p)[3], bool triangles) {
  uint32_t first = vertices(pen, n * k, p);
  run(pen, first, n, true);
  for (uint32_t ring = first; ring < first + n * (k - 1); ring += n)
    for (uint32_t i = 0; i < n; i++) {
      uint32_t next = (i + 1) % n;
      side(pen, ring + i, ring + next, ring + n + next, ring + n + i,
           triangles);
    }
  return first + n * (k - 1);
}

void hsr_pen_loft(struct hsr_pen *pen, uint32_t n, uint32_t k,
                  const double (*p)[3], bool triangles) {
  run(pen, open_loft(pen, n, k, p, triangles), n, false);
}

void hsr_pen_box(struct hsr_pen *pen, double x0, double y0, double z0,
                 double x1, double y1, double z1) {
  const double p[8][3] = {{x0, y0, z1}, {x1, y0, z1}, {x1, y0, z0},
                          {x0, y0, z0}, {x0, y1, z1}, {x1, y1, z1},
                          {x1, y1, z0}, {x0, y1, z0}};
  hsr_pen_loft(pen, 4, 2, p, false);
}

void hsr_pen_block(struct hsr_pen *pen, int x0, int y0, int z0, int x1, int y1,
                   int z1) {
  hsr_pen_box(pen, x0 / 64.0, y0 / 64.0, z0 / 64.0, x1 / 64.0, y1 / 64.0,
              z1 / 64.0);
}

/* The prism over n points of a plane, between two values of the third
 * coordinate; `up` is its number, and the plane's are `first` and `second`. */
static void extrude(struct hsr_pen *pen, uint32_t n, const double (*p)[2],
                    int first, int second, int up, const double level[2]) {
  double(*q)[3] = malloc(2 * n * sizeof *q);
  if (!q) {
    note(pen, HSR_E_NOMEM);
    return;
  }
  for (uint32_t i = 0; i < 2 * n; i++) {
    q[i][first] = p[i % n][0];
    q[i][second] = p[i % n][1];
    q[i][up] = level[i / n];
  }
  hsr_pen_loft(pen, n, 2, (const double(*)[3])q, false);
  free(q);
}

void hsr_pen_prism(struct hsr_pen *pen, uint32_t n, const double (*xz)[2],
                   double y0, double y1) {
  const double level[2] = {y0, y1};
  extrude(pen, n, xz, 0, 2, 1, level);
}

void hsr_pen_extrusion(struct hsr_pen *pen, uint32_t n, const double (*xy)[2],
                       double z0, double z1) {
  const double level[2] = {z0, z1};
  extrude(pen, n, xy, 0, 1, 2, level);
}

/* The vertices of one ring of a lathe: n, or 1 on the axis. The number of the
 * first. */
static uint32_t lathe_ring(struct hsr_pen *pen, uint32_t n,
                           const double profile[2]) {
  if (profile[0] == 0)
    return hsr_pen_vertex(pen, 0, profile[1], 0);
  uint32_t first = 0;
  for (uint32_t i = 0; i < n; i++) {
    double c, s;
    hsr_unit(i, n, &c, &s);
    uint32_t number =
        hsr_pen_vertex(pen, profile[0] * hsr_grid(c, 4096), profile[1],
                       -profile[0] * hsr_grid(s, 4096));
    first = i ? first : number;
  }
  return first;
}

static void lathe_band(struct hsr_pen *pen, uint32_t n, uint32_t below,
                       bool point_below, uint32_t above, bool point_above) {
  for (uint32_t i = 0; i < n; i++) {
    uint32_t next = (i + 1) % n;
    const uint32_t quad[4] = {below + i, below + next, above + next, above + i};
    const uint32_t tip[3] = {below + i, below + next, above};
    const uint32_t foot[3] = {below, above + next, above + i};
    if (point_below)
      hsr_pen_face(pen, 3, foot);
    else if (point_above)
      hsr_pen_face(pen, 3, tip);
    else
      hsr_pen_face(pen, 4, quad);
  }
}

void hsr_pen_lathe(struct hsr_pen *pen, uint32_t n, uint32_t k,
                   const double (*profile)[2]) {
  uint32_t below = lathe_ring(pen, n, profile[0]);
  if (profile[0][0] > 0)
    run(pen, below, n, true);
  for (uint32_t i = 1; i < k; i++) {
    uint32_t above = lathe_ring(pen, n, profile[i]);
    lathe_band(pen, n, below, profile[i - 1][0] == 0, above,
               profile[i][0] == 0);
    below = above;
  }
  if (profile[k - 1][0] > 0)
    run(pen, below, n, false);
}

void hsr_pen_panel(struct hsr_pen *pen, double x0, double y0, double x1,
                   double y1, double depth, double bevel, unsigned rim) {
  double b = bevel, middle = depth - bevel;
  const double p[12][3] = {{x0, y0, 0},
                           {x1, y0, 0},
                           {x1, y1, 0},
                           {x0, y1, 0},
                           {x0, y0, middle},
                           {x1, y0, middle},
                           {x1, y1, middle},
                           {x0, y1, middle},
                           {x0 + b, y0 + b, depth},
                           {x1 - b, y0 + b, depth},
                           {x1 - b, y1 - b, depth},
                           {x0 + b, y1 - b, depth}};
  float front[3];
  memcpy(front, pen->rgb, sizeof front);
  hsr_pen_paint(pen, rim);
  uint32_t top = open_loft(pen, 4, 3, p, false);
  memcpy(pen->rgb, front, sizeof front);
  run(pen, top, 4, false);
}

void hsr_pen_place(struct hsr_pen *pen, const double m[12]) {
  if (!pen->status)
    note(pen, hsr_scene_instance(pen->scene, pen->object, m));
}

void hsr_pen_view(struct hsr_pen *pen, const double eye[3], const double at[3],
                  double fov, double near) {
  if (pen->status)
    return;
  struct hsr_camera camera = {.up = {0, 1, 0}, .fov = fov, .near = near};
  memcpy(camera.eye, eye, sizeof camera.eye);
  memcpy(camera.at, at, sizeof camera.at);
  /* Straight up or down, the north is up. */
  if (eye[0] == at[0] && eye[2] == at[2]) {
    camera.up[1] = 0;
    camera.up[2] = -1;
  }
  note(pen, hsr_scene_view(pen->scene, &camera));
}

void hsr_pen_views(struct hsr_pen *pen, const double (*view)[8], size_t n,
                   double scale) {
  for (size_t i = 0; i < n; i++) {
    double p[6];
    for (int k = 0; k < 6; k++)
      p[k] = view[i][k] * scale;
    hsr_pen_view(pen, p, p + 3, view[i][6], view[i][7] * scale);
  }
}

void hsr_pen_views_to(struct hsr_pen *pen, uint32_t n) {
  if (!pen->status && pen->scene->n_views < n)
    note(pen, hsr_scene_add_orbit(pen->scene, n - pen->scene->n_views));
}

/* tan(x), 0 <= x <= pi/8, to 3e-7. The point's place along the circle need not
 * be exact; the parametrisation puts it on the circle. */
static double tangent(double x) {
  double q = x * x;
  return x * (1 + q * (1.0 / 3 +
                       q * (2.0 / 15 + q * (17.0 / 315 + q * (62.0 / 2835)))));
}

/* The point at f eighths of a turn, 0 <= f <= 1, in the first octant. */
static void octant_point(double f, double *c, double *s) {
  const double pi_eighths = 0.39269908169872414;
  double t = tangent(f * pi_eighths);
  *c = (1 - t * t) / (1 + t * t);
  *s = 2 * t / (1 + t * t);
  if (f == 1)
    *c = *s = sqrt(0.5);
}

void hsr_unit(uint32_t k, uint32_t n, double *c, double *s) {
  uint64_t eighths = 8 * (uint64_t)(k % n);
  uint32_t octant = (uint32_t)(eighths / n), rest = (uint32_t)(eighths % n);
  double x, y;
  /* Odd octants mirror even ones, so that the circle is symmetric exactly. */
  octant_point((double)(octant & 1 ? n - rest : rest) / n, &x, &y);
  if (octant & 1) {
    double other = x;
    x = y;
    y = other;
  }
  for (uint32_t quarter = octant / 2; quarter; quarter--) {
    double other = -y;
    y = x;
    x = other;
  }
  *c = x;
  *s = y;
}

double hsr_grid(double x, double steps) {
  return floor(x * steps + 0.5) / steps;
}

uint64_t hsr_random_bits(struct hsr_random *random) {
  uint64_t z = random->state += UINT64_C(0x9e3779b97f4a7c15);
  z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
  z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
  return z ^ z >> 31;
}

double hsr_random_unit(struct hsr_random *random) {
  return (double)(hsr_random_bits(random) >> 11) / 9007199254740992.0;
}

int hsr_random_int(struct hsr_random *random, int least, int most) {
  uint64_t range = (uint64_t)(most - least) + 1;
  return least + (int)(hsr_random_bits(random) % range);
}

void hsr_random_skip(struct hsr_random *random, uint64_t n) {
  random->state += n * UINT64_C(0x9e3779b97f4a7c15);
}
