/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Formulas  docs/correct-picture.md: N = sum Vi x Vi+1, S = sum Vi, t = N.(S -
 *           kE) / (k N.D), and in parallel projection N.(S - kP) / (k N.F).
 *           With x = X/m and y = Y/n, X and Y whole, t is a quotient of
 *           numbers that are linear in X and Y; their coefficients are of the
 *           face. */
#include "bench/suite/exact.h"
#include "common/base/nearest.h"

#include <stdlib.h>

typedef mpq_t point[3];

static void begin_point(point p) {
  mpq_inits(p[0], p[1], p[2], NULL);
}

static void end_point(point p) {
  mpq_clears(p[0], p[1], p[2], NULL);
}

static void set_point(point p, const double x[3]) {
  for (int k = 0; k < 3; k++)
    mpq_set_d(p[k], x[k]);
}

static void dot(mpq_t result, point a, point b) {
  mpq_t product;
  mpq_init(product);
  mpq_set_ui(result, 0, 1);
  for (int k = 0; k < 3; k++) {
    mpq_mul(product, a[k], b[k]);
    mpq_add(result, result, product);
  }
  mpq_clear(product);
}

static void add_cross(point sum, point a, point b) {
  mpq_t product;
  mpq_init(product);
  for (int k = 0; k < 3; k++) {
    mpq_mul(product, a[(k + 1) % 3], b[(k + 2) % 3]);
    mpq_add(sum[k], sum[k], product);
    mpq_mul(product, a[(k + 2) % 3], b[(k + 1) % 3]);
    mpq_sub(sum[k], sum[k], product);
  }
  mpq_clear(product);
}

bool exact_has_area(const double corner[3][3]) {
  point v[3], normal;
  begin_point(normal);
  for (int k = 0; k < 3; k++) {
    begin_point(v[k]);
    set_point(v[k], corner[k]);
  }
  for (int k = 0; k < 3; k++)
    add_cross(normal, v[k], v[(k + 1) % 3]);
  const bool has =
      mpq_sgn(normal[0]) || mpq_sgn(normal[1]) || mpq_sgn(normal[2]);
  for (int k = 0; k < 3; k++)
    end_point(v[k]);
  end_point(normal);
  return has;
}

/* t = (over[0] + X over[1] + Y over[2]) / (under[0] + X under[1] + Y under[2]),
 * all whole. */
struct face {
  mpz_t over[3], under[3];
};

static void corner_of(const struct hsr_world *world, uint32_t f, uint32_t k,
                      point p) {
  const struct hsr_mesh *mesh = &world->mesh;
  const uint32_t v = mesh->vertex[mesh->start[f] + k];
  const double x[3] = {mesh->x[v], mesh->y[v], mesh->z[v]};
  set_point(p, x);
}

/* N and S of a face. */
static void find_plane(const struct hsr_world *world, uint32_t f, point normal,
                       point sum) {
  const uint32_t n = hsr_face_size(world, f);
  point a, b;
  begin_point(a);
  begin_point(b);
  for (uint32_t k = 0; k < n; k++) {
    corner_of(world, f, k, a);
    corner_of(world, f, (k + 1) % n, b);
    add_cross(normal, a, b);
    for (int c = 0; c < 3; c++)
      mpq_add(sum[c], sum[c], a[c]);
  }
  end_point(a);
  end_point(b);
}

/* The coefficients: `over` is N.(S - kE) first, `under` kN.F; of X and Y they are
 * kN.R/m and kN.U/n. */
static void find_quotient(const struct hsr_world *world,
                          const struct hsr_view *view, uint32_t f, point over,
                          point under) {
  const double *const axis[4] = {view->E, view->F, view->R, view->U};
  const unsigned long size[4] = {1, 1, (unsigned long)view->m,
                                 (unsigned long)view->n};
  point normal, sum, direction;
  mpq_t along[4], factor;
  begin_point(normal);
  begin_point(sum);
  begin_point(direction);
  mpq_init(factor);
  find_plane(world, f, normal, sum);
  for (int c = 0; c < 4; c++) {
    mpq_init(along[c]);
    set_point(direction, axis[c]);
    dot(along[c], normal, direction);
    mpq_set_ui(factor, hsr_face_size(world, f), size[c]);
    mpq_canonicalize(factor);
    mpq_mul(along[c], along[c], factor);
  }
  dot(over[0], normal, sum);
  mpq_sub(over[0], over[0], along[0]);
  mpq_set(under[0], along[1]);
  for (int c = 1; c < 3; c++)
    if (view->parallel)
      mpq_neg(over[c], along[c + 1]);
    else
      mpq_set(under[c], along[c + 1]);
  for (int c = 0; c < 4; c++)
    mpq_clear(along[c]);
  mpq_clear(factor);
  end_point(normal);
  end_point(sum);
  end_point(direction);
}

static void scale(mpz_t result, const mpq_t q, const mpz_t factor) {
  mpz_divexact(result, factor, mpq_denref(q));
  mpz_mul(result, result, mpq_numref(q));
}

static struct face *new_face(const struct hsr_world *world,
                             const struct hsr_view *view, uint32_t f) {
  struct face *face = malloc(sizeof *face);
  if (!face)
    return NULL;
  point over, under;
  mpz_t common;
  begin_point(over);
  begin_point(under);
  mpz_init_set_ui(common, 1);
  find_quotient(world, view, f, over, under);
  for (int c = 0; c < 3; c++) {
    mpz_lcm(common, common, mpq_denref(over[c]));
    mpz_lcm(common, common, mpq_denref(under[c]));
  }
  for (int c = 0; c < 3; c++) {
    mpz_inits(face->over[c], face->under[c], NULL);
    scale(face->over[c], over[c], common);
    scale(face->under[c], under[c], common);
  }
  mpz_clear(common);
  end_point(over);
  end_point(under);
  return face;
}

static void free_face(struct face *face) {
  for (int c = 0; c < 3; c++)
    mpz_clears(face->over[c], face->under[c], NULL);
  free(face);
}

static void linear(mpz_t result, mpz_t coefficient[3], long x, long y) {
  mpz_t part;
  mpz_init(part);
  mpz_mul_si(result, coefficient[1], x);
  mpz_mul_si(part, coefficient[2], y);
  mpz_add(result, result, part);
  mpz_add(result, result, coefficient[0]);
  mpz_clear(part);
}

/* At the sample in column i and row j. A plane along the ray, which only the
 * displacement of samples lets it meet, is met infinitely far. The quotient is
 * not reduced: it is only rounded. */
static double depth_at(struct face *face, const struct hsr_view *view, int i,
                       int j) {
  const long x = 2L * i + 1 - view->m, y = (long)view->n - 2L * j - 1;
  double depth = (double)INFINITY;
  mpq_t t;
  mpq_init(t);
  linear(mpq_numref(t), face->over, x, y);
  linear(mpq_denref(t), face->under, x, y);
  if (mpz_sgn(mpq_denref(t)) < 0) {
    mpz_neg(mpq_numref(t), mpq_numref(t));
    mpz_neg(mpq_denref(t), mpq_denref(t));
  }
  if (mpz_sgn(mpq_denref(t)))
    depth = hsr_nearest_double(t);
  mpq_clear(t);
  return depth;
}

enum hsr_status exact_depths(const struct hsr_world *world,
                             const struct hsr_view *view, const uint32_t *ids,
                             double *depth, struct hsr_error *err) {
  struct face **face = calloc(world->n_faces, sizeof *face);
  bool enough = face;
  for (int j = 0; j < view->n && enough; j++)
    for (int i = 0; i < view->m && enough; i++, depth++) {
      const uint32_t f = *ids++;
      *depth = (double)INFINITY;
      if (f == HSR_BACKGROUND)
        continue;
      if (!face[f])
        face[f] = new_face(world, view, f);
      if (face[f])
        *depth = depth_at(face[f], view, i, j);
      else
        enough = false;
    }
  for (uint32_t f = 0; f < world->n_faces && face; f++)
    if (face[f])
      free_face(face[f]);
  free(face);
  return enough ? HSR_OK : hsr_fail_nomem(err);
}
