/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes from a seed: triangles anywhere, and polygons on a small lattice. */
#include "scenes/builders.h"
#include "scenes/parts/shapes.h"

#include <math.h>

/* Uniform in (-1, 1), by 53 bits. */
static double centred(struct hsr_random *random) {
  return 2 * hsr_random_unit(random) - 1;
}

/* The more triangles, the smaller they are, so that about four lie over one
 * another at any number. */
struct soup {
  long long n;
  uint64_t seed;
  double size;
};
enum { NUMBERS_OF_TRIANGLE = 13 }; /* random ones, with its colour's */

/* Triangle f begins where those before it have ended. */
static struct hsr_random random_at(const struct soup *soup, uint64_t f) {
  struct hsr_random random = {soup->seed};
  hsr_random_skip(&random, f * NUMBERS_OF_TRIANGLE);
  return random;
}

/* The next triangle. Returns its colour. */
static uint32_t throw_triangle(const struct soup *soup,
                               struct hsr_random *random, double p[3][3]) {
  double centre[3];
  for (int k = 0; k < 3; k++)
    centre[k] = centred(random);
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 3; k++)
      p[i][k] = centre[k] + soup->size * centred(random);
  return (uint32_t)hsr_random_int(random, 0, 11);
}

/* The extent of all triangles, without keeping them. */
static void measure_soup(const struct soup *soup,
                         struct hsr_scene_extent *extent) {
  hsr_scene_extent_begin(extent);
  for (int pass = 0; pass < 2; pass++) {
    struct hsr_random random = random_at(soup, 0);
    double p[3][3];
    for (long long f = 0; f < soup->n; f++) {
      throw_triangle(soup, &random, p);
      for (int i = 0; i < 3; i++)
        (pass ? hsr_scene_extent_reach : hsr_scene_extent_add)(extent, p[i]);
    }
    if (!pass)
      hsr_scene_extent_centre(extent);
  }
}

static void soup_faces(struct hsr_pen *pen, const struct soup *soup,
                       const struct hsr_scene_part *part) {
  struct hsr_random random = random_at(soup, part->first);
  hsr_pen_object(pen, "soup", false);
  for (uint32_t f = 0; f < part->n_faces && !pen->status; f++) {
    double p[3][3];
    hsr_pen_palette(pen, throw_triangle(soup, &random, p));
    hsr_pen_polygon(pen, 3, (const double(*)[3])p);
  }
  hsr_pen_place(pen, NULL);
}

enum { SOUP_VIEWS = 9 };

/* Four views, and others around the whole soup. */
static void soup_views(struct hsr_pen *pen, const struct hsr_scene_part *part) {
  static const double eye[4][3] = {
      {0.5, 0.25, 4}, {0, 0, 0}, {-0.3, 0.2, 1}, {2.5, 2.25, 2}};
  static const double at[4][3] = {{0, 0, 0}, {1, 0.25, -0.5}, {0, 0, -1}};
  const struct hsr_scene_extent *extent = &part->extent;
  for (int i = 0; i < 4; i++)
    hsr_pen_view(pen, eye[i], at[i], i ? 75 : 45, i == 2 ? 0.5 : 0);
  if (!pen->status)
    pen->status =
        hsr_scene_add_orbit_around(pen->scene, extent->centre, extent->radius,
                                   SOUP_VIEWS - pen->scene->n_views);
}

enum hsr_status hsr_build_soup_part(struct hsr_scene *scene,
                                    const long long *parameter,
                                    struct hsr_scene_part *part) {
  struct soup soup = {.n = parameter[0],
                      .seed = (uint64_t)parameter[1],
                      .size = fmin(1, 7 / sqrt((double)parameter[0]))};
  struct hsr_pen pen;
  hsr_scene_part_set(part, (uint32_t)soup.n);
  if (!part->is_measured)
    measure_soup(&soup, &part->extent);
  part->is_measured = true;
  hsr_pen_init(&pen, scene);
  soup_faces(&pen, &soup, part);
  soup_views(&pen, part);
  return pen.status;
}

enum hsr_status hsr_build_soup(struct hsr_scene *scene,
                               const long long *parameter) {
  struct hsr_scene_part whole = {.of = 1};
  return hsr_build_soup_part(scene, parameter, &whole);
}

/* Polygons in lattice steps (s, t) of a plane. */
struct pattern {
  uint32_t n;
  signed char st[8][2];
};
static const struct pattern patterns[] = {
    {3, {{0, 0}, {1, 0}, {0, 1}}},
    {3, {{0, 0}, {2, 0}, {0, 2}}},
    {3, {{0, 0}, {3, 1}, {1, 2}}},
    {3, {{0, 0}, {4, 0}, {1, 3}}},
    {4, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}},
    {4, {{0, 0}, {2, 0}, {2, 2}, {0, 2}}},
    {4, {{0, 0}, {3, 0}, {2, 1}, {0, 1}}},
    {4, {{1, 0}, {2, 1}, {1, 3}, {0, 1}}},
    {5, {{0, 0}, {2, 0}, {3, 1}, {2, 3}, {0, 2}}},
    {5, {{0, 0}, {1, 0}, {2, 1}, {1, 2}, {0, 1}}},
    /* A straight angle, then reflex ones. */
    {5, {{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}},
    {4, {{0, 0}, {2, 1}, {0, 2}, {1, 1}}},
    {6, {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}},
    {8, {{0, 0}, {3, 0}, {3, 2}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}},
    {7, {{0, 0}, {2, 1}, {4, 0}, {3, 2}, {4, 4}, {2, 3}, {0, 4}}}};

enum { REACH = 4 };

static bool parallel(const int u[3], const int v[3]) {
  return u[1] * v[2] == u[2] * v[1] && u[2] * v[0] == u[0] * v[2] &&
         u[0] * v[1] == u[1] * v[0];
}

/* Throws a polygon; false if it does not lie within the lattice. */
static bool throw_polygon(struct hsr_random *random, double (*p)[3],
                          uint32_t *n) {
  const struct pattern *pattern = &patterns[hsr_random_int(
      random, 0, sizeof patterns / sizeof *patterns - 1)];
  int o[3], u[3], v[3];
  for (int k = 0; k < 3; k++) {
    o[k] = hsr_random_int(random, -REACH, REACH);
    u[k] = hsr_random_int(random, -2, 2);
    v[k] = hsr_random_int(random, -2, 2);
  }
  if (parallel(u, v))
    return false;
  *n = pattern->n;
  for (uint32_t i = 0; i < pattern->n; i++)
    for (int k = 0; k < 3; k++) {
      int x = o[k] + pattern->st[i][0] * u[k] + pattern->st[i][1] * v[k];
      if (x < -REACH || x > REACH)
        return false;
      p[i][k] = x;
    }
  return true;
}

static void lattice_faces(struct hsr_pen *pen, struct hsr_random *random,
                          long long n) {
  for (long long f = 0; f < n && !pen->status; f++) {
    double p[8][3];
    uint32_t corners;
    while (!throw_polygon(random, p, &corners))
      continue;
    hsr_pen_palette(pen, (uint32_t)hsr_random_int(random, 0, 11));
    hsr_pen_polygon(pen, corners, (const double(*)[3])p);
  }
}

/* Eyes on the lattice, looking along an axis at a right angle of vision: rows
 * and columns of samples run through vertices where the number of samples a
 * side is an odd multiple of a depth. The last two meet them at 64 and 512. */
static void lattice_views(struct hsr_pen *pen) {
  static const double view[][7] = {
      /* eye, direction, near */
      {0, 0, 9, 0, 0, -1, 0},         {9, 1, 0, -1, 0, 0, 0},
      {0, 7, 0, 0, -1, 0, 0},         {0, 0, 0, 0, 0, -1, 0},
      {1, 0, -2, 1, 0, 0, 0},         {0, 0, 6, 0, 0, -1, 3},
      {-5, 0, 0, 1, 0, 0, 5},         {2, -1, 3, 0, 1, 0, 1},
      {0, 0, 64, 0, 0, -1, 0},        {-1, -4, -1, 0, 1, 0, 0},
      {0.125, 0.125, 8, 0, 0, -1, 0}, {0.015625, 0.015625, 8, 0, 0, -1, 4}};
  for (size_t i = 0; i < sizeof view / sizeof *view; i++) {
    double at[3];
    for (int k = 0; k < 3; k++)
      at[k] = view[i][k] + view[i][3 + k];
    hsr_pen_view(pen, view[i], at, 90, view[i][6]);
  }
}

/* From the first vertex of all, and from a point of the first face's plane. */
static void views_from_face(struct hsr_pen *pen) {
  if (pen->status)
    return;
  const double *xyz = pen->scene->objects[0].xyz;
  double eye[3], at[3], in_plane[3];
  for (int k = 0; k < 3; k++) {
    eye[k] = at[k] = xyz[k];
    in_plane[k] = xyz[k] + (xyz[k] - xyz[3 + k]) + (xyz[k] - xyz[6 + k]);
  }
  at[0] += at[0] > 0 ? -1 : 1;
  hsr_pen_view(pen, eye, at, 90, 0);
  for (int k = 0; k < 3; k++)
    at[k] = in_plane[k];
  at[2] += in_plane[2] > 0 ? -1 : 1;
  hsr_pen_view(pen, in_plane, at, 90, 0);
}

/* A quarter of the faces, the last, do not exist from behind. */
enum hsr_status hsr_build_lattice(struct hsr_scene *scene,
                                  const long long *parameter) {
  long long n = parameter[0], n_one_sided = n / 4;
  struct hsr_random random = {(uint64_t)parameter[1] + 0x6c617474};
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  hsr_pen_object(&pen, "two-sided", false);
  lattice_faces(&pen, &random, n - n_one_sided);
  hsr_pen_place(&pen, NULL);
  if (n_one_sided) {
    hsr_pen_object(&pen, "one-sided", true);
    lattice_faces(&pen, &random, n_one_sided);
    hsr_pen_place(&pen, NULL);
  }
  lattice_views(&pen);
  views_from_face(&pen);
  return pen.status;
}

/* The faces of a lattice in objects of different opacities. They are drawn from
 * one sequence, so that what is transparent lies before, behind and in the
 * planes of what is opaque. */
enum hsr_status hsr_build_panes(struct hsr_scene *scene,
                                const long long *parameter) {
  static const double opacity[] = {1, 0.5, 0.25, 0.75, 0, 0.9, 0.5};
  enum { OBJECTS = sizeof opacity / sizeof *opacity };
  long long n = parameter[0];
  struct hsr_random random = {(uint64_t)parameter[1] + 0x70616e65};
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  for (int k = 0; k < OBJECTS; k++) {
    long long first = n * k / OBJECTS, end = n * (k + 1) / OBJECTS;
    if (first == end)
      continue;
    hsr_pen_object(&pen, "panes", k == OBJECTS - 1);
    hsr_pen_glass(&pen, opacity[k]);
    lattice_faces(&pen, &random, end - first);
    hsr_pen_place(&pen, NULL);
  }
  lattice_views(&pen);
  views_from_face(&pen);
  return pen.status;
}
