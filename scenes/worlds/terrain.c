/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A landscape, and plants on it.
 *
 * Source      the plants are after the outdoor scenes of N. Greene, Hierarchical
 *             Rendering of Complex Environments, Ph.D. thesis, UC Santa Cruz,
 *             1995: a height field with instances of a plant on it, 53 million
 *             polygons where a hill hides nearly all, 5 million seen from above
 * Frame       the landscape lies over the square from -1 to 1 in x and z
 * Plants      three models of 5,288 triangles: wood, of closed thin prisms,
 *             one-sided, and leaves, flat and two-sided */
#include "scenes/builders.h"
#include "scenes/parts/shapes.h"

#include <math.h>
#include <string.h>

/* --- The landscape -------------------------------------------------------- */

/* A value in [0, 1) for each point of a lattice. */
static double lattice_value(int x, int z, int octave) {
  struct hsr_random random = {(uint64_t)x * 0x100000001 +
                              (uint64_t)z * 0x10001 + (uint64_t)octave * 1409};
  hsr_random_bits(&random);
  return hsr_random_unit(&random);
}

static double smooth(double t) {
  return t * t * (3 - 2 * t);
}

static double noise(double u, double v, int octave) {
  int x = (int)u, z = (int)v;
  double s = smooth(u - x), t = smooth(v - z);
  double a = lattice_value(x, z, octave), b = lattice_value(x + 1, z, octave);
  double c = lattice_value(x, z + 1, octave),
         d = lattice_value(x + 1, z + 1, octave);
  return (1 - t) * ((1 - s) * a + s * b) + t * ((1 - s) * c + s * d);
}

/* Height over the unit square: seven octaves of noise, the valleys flattened.
 */
static double altitude(double u, double v) {
  double sum = 0, amplitude = 0.5, frequency = 3;
  for (int octave = 0; octave < 7; octave++) {
    sum += amplitude * noise(u * frequency, v * frequency, octave);
    amplitude *= 0.4375;
    frequency *= 2;
  }
  return sum * sum;
}

static void terrain_triangle(struct hsr_pen *pen, uint32_t a, uint32_t b,
                             uint32_t c) {
  static const unsigned colour[6] = {0x5f8fae, 0xd8c48f, 0x8fb266,
                                     0x6f9455, 0x94836b, 0xf2f2f0};
  static const double below[5] = {0.11, 0.14, 0.24, 0.36, 0.5};
  if (pen->status)
    return;
  const double *xyz = pen->scene->objects[pen->object].xyz;
  double y = (xyz[3 * (size_t)a + 1] + xyz[3 * (size_t)b + 1] +
              xyz[3 * (size_t)c + 1]) /
             3;
  int i = 0;
  while (i < 5 && y >= below[i])
    i++;
  hsr_pen_paint(pen, colour[i]);
  const uint32_t v[3] = {a, b, c};
  hsr_pen_face(pen, 3, v);
}

static void landscape(struct hsr_pen *pen, uint32_t n) {
  hsr_pen_object(pen, "terrain", false);
  for (uint32_t k = 0; k <= n; k++)
    for (uint32_t i = 0; i <= n; i++) {
      double u = (double)i / n, v = (double)k / n;
      hsr_pen_vertex(pen, 2 * u - 1, altitude(u, v), 2 * v - 1);
    }
  for (uint32_t k = 0; k < n; k++)
    for (uint32_t i = 0; i < n; i++) {
      uint32_t a = k * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      bool falling = (i + k) & 1;
      terrain_triangle(pen, a, c, falling ? b : d);
      terrain_triangle(pen, falling ? b : a, falling ? c : d, falling ? d : b);
    }
  hsr_pen_place(pen, NULL);
}

/* --- Plants -----------------------------------------------------------------
 *
 * A branch is a three-sided prism that narrows to its tip, where four more
 * begin; after four generations there are leaves instead. */

enum { N_MODELS = 3, N_GENERATIONS = 5, N_BRANCHES = 4, N_LEAVES = 5 };

struct model {
  const char *wood, *leaves;
  unsigned bark, green, light;
  double trunk;  /* its length; a plant is about 1 high */
  double shrink; /* a branch's length to that of the one that it grows from */
  double spread; /* how far it turns aside */
  double leaf;   /* length of a leaf */
};
static const struct model models[N_MODELS] = {
    {"oak wood", "oak leaves", 0x6b4f3a, 0x4c7a35, 0x7fa648, 0.34, 0.64, 0.95,
     0.05},
    {"poplar wood", "poplar leaves", 0x857361, 0x3f6b3d, 0x5f9150, 0.42, 0.62,
     0.42, 0.045},
    {"bush wood", "bush leaves", 0x5d4a38, 0x7d8f3e, 0xb0a548, 0.16, 0.78, 1.2,
     0.06}};

struct branch {
  double foot[3], tip[3];
  double thick; /* at its foot; half of it at its tip */
};

static void cross(const double a[3], const double b[3], double c[3]) {
  for (int i = 0, j = 1, k = 2; i < 3; i++, j = (j + 1) % 3, k = (k + 1) % 3)
    c[i] = a[j] * b[k] - a[k] * b[j];
}

static void scale_to(double a[3], double length) {
  double factor = length / sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
  for (int i = 0; i < 3; i++)
    a[i] *= factor;
}

static void any_direction(struct hsr_random *random, double d[3]) {
  for (int i = 0; i < 3; i++)
    d[i] = 2 * hsr_random_unit(random) - 1;
}

/* The ring of three points about `centre`, seen counter-clockwise against the
 * axis of which u and v span the plane. */
static void ring(const double centre[3], const double u[3], const double v[3],
                 double radius, double (*p)[3]) {
  static const double corner[3][2] = {{1, 0}, {-0.5, 0.875}, {-0.5, -0.875}};
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++)
      p[i][k] =
          centre[k] + radius * (corner[i][0] * u[k] + corner[i][1] * v[k]);
}

static void draw_branch(struct hsr_pen *pen, const struct branch *b) {
  double axis[3], u[3], v[3], p[6][3];
  for (int k = 0; k < 3; k++)
    axis[k] = b->tip[k] - b->foot[k];
  const double aside[3] = {axis[1], axis[2], -axis[0]};
  cross(axis, aside, u);
  scale_to(u, 1);
  cross(axis, u, v);
  scale_to(v, 1);
  ring(b->foot, u, v, b->thick, p);
  ring(b->tip, u, v, b->thick / 2, p + 3);
  hsr_pen_loft(pen, 3, 2, (const double(*)[3])p, true);
}

/* Branch number i of those that grow from the tip of b. */
static struct branch grow(const struct model *model, const struct branch *b,
                          int i, struct hsr_random *random) {
  struct branch next = {.thick = b->thick * 0.5625};
  double axis[3], aside[3], c, s;
  for (int k = 0; k < 3; k++)
    axis[k] = b->tip[k] - b->foot[k];
  double length =
      sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
  hsr_unit((uint32_t)(64 * i + hsr_random_int(random, 0, 40)), 64 * N_BRANCHES,
           &c, &s);
  any_direction(random, aside);
  aside[0] = c + 0.25 * aside[0];
  aside[1] = 0.25 * aside[1];
  aside[2] = s + 0.25 * aside[2];
  scale_to(aside, length * model->spread);
  for (int k = 0; k < 3; k++)
    axis[k] += aside[k];
  axis[1] += 0.125 * length;
  scale_to(axis,
           length * model->shrink * (0.75 + 0.5 * hsr_random_unit(random)));
  for (int k = 0; k < 3; k++) {
    next.foot[k] = b->tip[k];
    next.tip[k] = b->tip[k] + axis[k];
  }
  return next;
}

/* b and what grows from it; the tips of the last generation go to *tips. */
static void draw_wood(struct hsr_pen *pen, const struct model *model,
                      const struct branch *b, int generation,
                      struct hsr_random *random, double (**tips)[3]) {
  draw_branch(pen, b);
  if (generation == N_GENERATIONS) {
    memcpy((*tips)++, b->tip, sizeof b->tip);
    return;
  }
  for (int i = 0; i < N_BRANCHES; i++) {
    struct branch next = grow(model, b, i, random);
    draw_wood(pen, model, &next, generation + 1, random, tips);
  }
}

/* Two triangles. */
static void draw_leaf(struct hsr_pen *pen, const struct model *model,
                      const double tip[3], struct hsr_random *random) {
  double d[3], e[3], u[3], corner[4][3];
  any_direction(random, d);
  any_direction(random, e);
  cross(d, e, u);
  scale_to(d, model->leaf);
  scale_to(u, model->leaf * 0.375);
  for (int k = 0; k < 3; k++) {
    corner[0][k] = tip[k];
    corner[1][k] = tip[k] + 0.5 * d[k] + u[k];
    corner[2][k] = tip[k] + d[k];
    corner[3][k] = tip[k] + 0.5 * d[k] - u[k];
  }
  hsr_pen_paint(pen,
                hsr_random_int(random, 0, 2) ? model->green : model->light);
  hsr_pen_polygon(pen, 4, (const double(*)[3])corner);
}

/* Where plant (i, k) of n x n stands, and which model it is of: bushes by the
 * water and on the heights, oaks and poplars between. */
static int plant_at(uint32_t i, uint32_t k, uint32_t n, double m[12]) {
  struct hsr_random random = {(uint64_t)k * n + i};
  double c, s, u = (i + 0.9 * hsr_random_unit(&random)) / n;
  double v = (k + 0.9 * hsr_random_unit(&random)) / n, y = altitude(u, v);
  double size = 0.03 + 0.02 * hsr_random_unit(&random);
  hsr_unit((uint32_t)hsr_random_int(&random, 0, 255), 256, &c, &s);
  double zone = y + 0.08 * hsr_random_unit(&random);
  int model = zone < 0.14 || zone > 0.42 ? 2 : zone < 0.26;
  if (model == 2)
    size *= 0.5;
  /* The foot is sunk, since the ground is flat between its own points. */
  const double place[12] = {size * c,  0,    size * s, 2 * u - 1,
                            0,         size, 0,        y - 0.125 * size,
                            -size * s, 0,    size * c, 2 * v - 1};
  memcpy(m, place, sizeof place);
  return model;
}

static void place_plants(struct hsr_pen *pen, int model, uint32_t n) {
  for (uint32_t k = 0; k < n; k++)
    for (uint32_t i = 0; i < n && !pen->status; i++) {
      double m[12];
      if (plant_at(i, k, n, m) == model)
        hsr_pen_place(pen, m);
    }
}

/* n x n plants. */
static void plants(struct hsr_pen *pen, uint32_t n) {
  for (int i = 0; i < N_MODELS; i++) {
    const struct model *model = &models[i];
    struct hsr_random random = {(uint64_t)i};
    struct branch trunk = {{0, 0, 0}, {0, model->trunk, 0}, 0.03125};
    double tip[256][3], (*end)[3] = tip;
    hsr_pen_object(pen, model->wood, true);
    hsr_pen_paint(pen, model->bark);
    draw_wood(pen, model, &trunk, 1, &random, &end);
    place_plants(pen, i, n);
    hsr_pen_object(pen, model->leaves, false);
    for (const double(*t)[3] = (const double(*)[3])tip; t < end; t++)
      for (int k = 0; k < N_LEAVES; k++)
        draw_leaf(pen, model, *t, &random);
    place_plants(pen, i, n);
  }
}

enum hsr_status hsr_build_terrain(struct hsr_scene *scene,
                                  const long long *parameter) {
  static const double among[][8] = {{0.2, 0.4, 0.9, 0, 0.2, 0, 60},
                                    {0.3, 0.9, 1.3, 0, 0.1, 0.2, 52}};
  static const double view[][8] = {{0.3, 1.15, 1.6, 0, 0.1, 0.2, 52},
                                   {-1.6, 0.7, 1.2, 0, 0.1, 0, 50},
                                   {0, 0.5, 0.9, 0, 0.2, 0, 70},
                                   {1.2, 0.6, -1.2, 0, 0.1, 0, 60},
                                   {0, 3, 0, 0, 0, 0, 45},
                                   {-0.3, 0.45, -0.2, 1, 0.2, 0.6, 80},
                                   {2.4, 0.3, 0.3, 0, 0.25, 0, 40},
                                   {0.2, -1, 1.5, 0, 0.1, 0, 60}};
  uint32_t n_plants = (uint32_t)(sqrt((double)parameter[1]) + 0.5);
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  landscape(&pen, (uint32_t)parameter[0]);
  if (n_plants) {
    pen.triangles = true;
    plants(&pen, n_plants);
    HSR_VIEWS(&pen, among, 1);
  }
  HSR_VIEWS(&pen, view, 1);
  return pen.status;
}
