/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the generators draw scenes with.
 *
 * World       y is up, x to the right and z towards the spectator of a front.
 * Exact       only + - * / and square roots are used, so that every machine
 *             computes the same doubles; points of the circle are rational.
 * Errors      a pen remembers the first failure and then does nothing more;
 *             the builder returns pen->status at its end. */
#ifndef HSR_SCENES_SHAPES_H
#define HSR_SCENES_SHAPES_H

#include "common/scene/scene.h"

struct hsr_pen {
  struct hsr_scene *scene; /* borrowed */
  uint32_t object;         /* number of the object being drawn */
  double m[12];            /* the frame: where in the object it is drawn */
  float rgb[3];            /* of the faces to come */
  bool triangles;          /* divide them, which are convex, into triangles */
  enum hsr_status status;  /* the first failure, HSR_OK so far */
};

void hsr_pen_init(struct hsr_pen *pen, struct hsr_scene *scene);

/* Begins a new, empty object; back to the frame of the object itself. */
void hsr_pen_object(struct hsr_pen *pen, const char *name, bool one_sided);

/* Colour 0xRRGGBB as on a screen, made linear by squaring. */
void hsr_pen_paint(struct hsr_pen *pen, unsigned colour);
void hsr_pen_palette(struct hsr_pen *pen, uint32_t i); /* any i: 12 colours */
void hsr_pen_rgb(struct hsr_pen *pen, double r, double g, double b);

/* How opaque the object being drawn is, 0 to 1. */
void hsr_pen_glass(struct hsr_pen *pen, double opacity);

/* The frame: origin (x, y, z), turned by quarters about the y axis, which take
 * the z axis to the x axis. Coordinates on one axis-parallel plane stay on
 * one. */
void hsr_pen_frame(struct hsr_pen *pen, double x, double y, double z,
                   int quarters);
void hsr_pen_matrix(double m[12], double x, double y, double z, int quarters);

uint32_t hsr_pen_vertex(struct hsr_pen *pen, double x, double y, double z);
void hsr_pen_face(struct hsr_pen *pen, uint32_t n, const uint32_t *vertices);

/* A face with n vertices of its own. */
void hsr_pen_polygon(struct hsr_pen *pen, uint32_t n, const double (*p)[3]);

/* The rectangle-like face p, p + u, p + u + v, p + v. */
void hsr_pen_parallelogram(struct hsr_pen *pen, const double p[3],
                           const double u[3], const double v[3]);

/* Closed solids, outward. Rings run counter-clockwise seen from above. */
void hsr_pen_box(struct hsr_pen *pen, double x0, double y0, double z0,
                 double x1, double y1, double z1);

/* A box given in 64ths. */
void hsr_pen_block(struct hsr_pen *pen, int x0, int y0, int z0, int x1, int y1,
                   int z1);

/* k rings of n points, ring after ring, the lowest first: a bottom, k - 1
 * bands of quadrilaterals, each in two triangles if `triangles`, and a top. */
void hsr_pen_loft(struct hsr_pen *pen, uint32_t n, uint32_t k,
                  const double (*p)[3], bool triangles);

/* A polygon of n points (x, z) between two heights. */
void hsr_pen_prism(struct hsr_pen *pen, uint32_t n, const double (*xz)[2],
                   double y0, double y1);

/* A polygon of n points (x, y), counter-clockwise seen from +z, between two
 * values of z. */
void hsr_pen_extrusion(struct hsr_pen *pen, uint32_t n, const double (*xy)[2],
                       double z0, double z1);

/* k points (radius, y), the lowest first, turned about the y axis in n steps.
 * The first and last radius may be 0. The circle's points are rounded to
 * 4096ths: with radii of few bits no product is rounded, so that the
 * quadrilaterals are exactly plane. */
void hsr_pen_lathe(struct hsr_pen *pen, uint32_t n, uint32_t k,
                   const double (*profile)[2]);

/* A plate on the plane z = 0 with a bevelled front, which has the pen's colour,
 * and a rim: 10 faces. */
void hsr_pen_panel(struct hsr_pen *pen, double x0, double y0, double x1,
                   double y1, double depth, double bevel, unsigned rim);

/* Places the object being drawn; m as in hsr_instance, NULL for the identity.
 */
void hsr_pen_place(struct hsr_pen *pen, const double m[12]);

/* Appends a view with y up. */
void hsr_pen_view(struct hsr_pen *pen, const double eye[3], const double at[3],
                  double fov, double near);

/* Appends n views given as eye, at, fov, near; lengths in units of `scale`. */
void hsr_pen_views(struct hsr_pen *pen, const double (*view)[8], size_t n,
                   double scale);
#define HSR_VIEWS(pen, table, scale)                                           \
  hsr_pen_views(pen, table, sizeof(table) / sizeof *(table), scale)

/* Appends views around what there is until the scene has n. */
void hsr_pen_views_to(struct hsr_pen *pen, uint32_t n);

/* (c, s): the k-th of n points that divide the unit circle very nearly evenly,
 * counter-clockwise from (1, 0). */
void hsr_unit(uint32_t k, uint32_t n, double *c, double *s);

/* x rounded to a multiple of 1 / steps, a power of 2. */
double hsr_grid(double x, double steps);

/* Splitmix64 (Steele, Lea and Flood 2014). */
struct hsr_random {
  uint64_t state;
};
uint64_t hsr_random_bits(struct hsr_random *random);
double hsr_random_unit(struct hsr_random *random); /* [0, 1), 53 bits */
int hsr_random_int(struct hsr_random *random, int least, int most);

/* As if n numbers had been drawn. */
void hsr_random_skip(struct hsr_random *random, uint64_t n);

#endif
