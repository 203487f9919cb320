/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scenes/sheets/sheets.h"

#include "scenes/parts/shapes.h"
#include "scenes/sheets/crossings.h"
#include "scenes/sheets/outline.h"

#include <math.h>
#include <string.h>

/* All coordinates are multiples of 2^-30, so that sums of them are exact. */
static const double STEPS = 1 << 30;

/* To reach a number of crossings: at most so many sweeps over all sheets, of which
 * so many in turn may bring nothing, and a sheet is thrown again so often. */
enum { SWEEPS = 100, VAIN = 12, TRIES = 32 };

/* Part `k` of `of` of a whole number, so that the parts add up to it and differ
 * by 1 at most. */
static uint64_t part_of(uint64_t all, uint32_t k, uint32_t of) {
  return all / of + (k < all % of);
}

uint64_t hsr_sheets_least(uint32_t n_faces, uint32_t n_clusters) {
  const uint64_t larger = n_faces % n_clusters, each = n_faces / n_clusters;
  return (n_clusters - larger) * hsr_outline_least((uint32_t)each) +
         (larger ? larger * hsr_outline_least((uint32_t)each + 1) : 0);
}

struct making {
  const struct hsr_sheets *asked;
  struct hsr_random
      *random; /* of each sheet its own, so that a sheet is much the
                                same when the room or another sheet changes */
  struct hsr_sheet_face *face;
  uint32_t (*ij)[2]; /* of each face, its square of the lattice */
  uint32_t *first;   /* of each sheet */
  double (*low)[3], (*high)[3], (*origin)[3]; /* of each sheet */
  struct hsr_arena arena;
  struct hsr_room room;
};

/* --- One sheet ------------------------------------------------------------ */

/* The lattice of a sheet: its square (i, j) is from A(i) + B(j) to
 * A(i + 1) + B(j + 1). */
struct lattice {
  double (*a)[3], (*b)[3];
};

/* A random direction of the plane, of length 1. */
static void direction(struct hsr_random *random, double *c, double *s) {
  double square;
  do {
    *c = 2 * hsr_random_unit(random) - 1;
    *s = 2 * hsr_random_unit(random) - 1;
    square = *c * *c + *s * *s;
  } while (square > 1 || square < 0.01);
  *c /= sqrt(square);
  *s /= sqrt(square);
}

/* n + 1 points along (x, y), whose depths go up and down by turns. */
static double (*line_of(struct making *m, uint32_t sheet, uint32_t n, double x,
                        double y))[3] {
  double(*point)[3] = hsr_arena_array(&m->arena, (size_t)n + 1, sizeof *point);
  const double side = m->asked->side;
  for (uint32_t i = 0; point && i <= n; i++) {
    const double bend = side * (0.4 + 0.2 * hsr_random_unit(&m->random[sheet]));
    point[i][0] = hsr_grid(i * x, STEPS);
    point[i][1] = hsr_grid(i * y, STEPS);
    point[i][2] = i % 2 ? hsr_grid(bend, STEPS) : 0;
  }
  return point;
}

static enum hsr_status lattice_of(struct making *m, uint32_t sheet,
                                  uint32_t columns, uint32_t rows,
                                  struct lattice *lattice) {
  double c, s;
  direction(&m->random[sheet], &c, &s);
  const double wide = m->asked->side * sqrt(m->asked->stretch);
  const double high = m->asked->side / sqrt(m->asked->stretch);
  lattice->a = line_of(m, sheet, columns, wide * c, high * s);
  lattice->b = line_of(m, sheet, rows, -wide * s, high * c);
  return lattice->a && lattice->b ? HSR_OK : HSR_E_NOMEM;
}

static void grow(struct making *m, uint32_t sheet, const double p[3]) {
  for (int k = 0; k < 3; k++) {
    m->low[sheet][k] = fmin(m->low[sheet][k], p[k]);
    m->high[sheet][k] = fmax(m->high[sheet][k], p[k]);
  }
}

/* Makes the faces of a sheet, around an origin of its own. */
static enum hsr_status shape_sheet(struct making *m, uint32_t sheet) {
  const struct hsr_sheets *asked = m->asked;
  const uint32_t begin = m->first[sheet], n = m->first[sheet + 1] - begin;
  uint32_t(*ij)[2] = m->ij + begin, columns = 0, rows = 0;
  const uint32_t sides =
      2 * (uint32_t)part_of(asked->n_contour / 2, sheet, asked->n_clusters);
  const uint32_t least = hsr_outline_least(n);
  hsr_outline(n, sides < least ? least : sides > 4 * n ? 4 * n : sides, ij);
  for (uint32_t k = 0; k < n; k++) {
    columns = ij[k][0] >= columns ? ij[k][0] + 1 : columns;
    rows = ij[k][1] >= rows ? ij[k][1] + 1 : rows;
  }
  struct lattice lattice;
  if (lattice_of(m, sheet, columns, rows, &lattice))
    return HSR_E_NOMEM;
  for (int k = 0; k < 3; k++) {
    m->low[sheet][k] = INFINITY;
    m->high[sheet][k] = -INFINITY;
  }
  for (uint32_t f = 0; f < n; f++) {
    struct hsr_sheet_face *face = &m->face[begin + f];
    const double(*a)[3] = &lattice.a[ij[f][0]], (*b)[3] = &lattice.b[ij[f][1]];
    face->sheet = sheet;
    for (int k = 0; k < 3; k++) {
      face->p[k] = a[0][k] + b[0][k];
      face->u[k] = a[1][k] - a[0][k];
      face->v[k] = b[1][k] - b[0][k];
    }
    for (int corner = 0; corner < 4; corner++) {
      double p[3];
      for (int k = 0; k < 3; k++)
        p[k] =
            face->p[k] + (corner % 2) * face->u[k] + (corner / 2) * face->v[k];
      grow(m, sheet, p);
    }
  }
  return HSR_OK;
}

/* --- Where sheets lie ----------------------------------------------------- */

/* Anywhere in the room. */
static void throw_sheet(struct making *m, uint32_t sheet) {
  const double from[3] = {-m->asked->width / 2, -0.5, -m->asked->depth};
  const double size[3] = {m->asked->width, 1, m->asked->depth};
  for (int k = 0; k < 3; k++) {
    const double extent = m->high[sheet][k] - m->low[sheet][k];
    m->origin[sheet][k] =
        hsr_grid(from[k] - m->low[sheet][k] +
                     (size[k] - extent) * hsr_random_unit(&m->random[sheet]),
                 STEPS);
  }
}

static enum hsr_status check_size(const struct making *m, uint32_t sheet,
                                  struct hsr_error *err) {
  const double size[3] = {m->asked->width, 1, m->asked->depth};
  for (int k = 0; k < 3; k++)
    if (m->high[sheet][k] - m->low[sheet][k] > size[k])
      return hsr_fail(
          err, HSR_E_INPUT,
          "a cluster of %u faces is larger than the picture%s; F_c or "
          "D_c must be smaller",
          m->first[sheet + 1] - m->first[sheet], k == 2 ? " is deep" : "");
  return HSR_OK;
}

static uint64_t apart(uint64_t a, uint64_t b) {
  return a > b ? a - b : b - a;
}

/* Throws a sheet again, up to TRIES times. It stays where the number of crossings
 * comes nearer to the one asked for. */
static enum hsr_status move_sheet(struct making *m, uint32_t sheet,
                                  uint64_t *n) {
  const uint64_t wanted = m->asked->n_crossings;
  const uint64_t own = hsr_room_crossings(&m->room, sheet);
  if (*n > wanted && !own)
    return HSR_OK;
  double old[3];
  memcpy(old, m->origin[sheet], sizeof old);
  hsr_room_take(&m->room, sheet);
  uint64_t best = *n;
  for (int k = 0; k < TRIES && best == *n; k++) {
    throw_sheet(m, sheet);
    const uint64_t all = *n - own + hsr_room_crossings(&m->room, sheet);
    if (apart(all, wanted) < apart(*n, wanted))
      best = all;
  }
  if (best == *n)
    memcpy(m->origin[sheet], old, sizeof old);
  *n = best;
  return hsr_room_put(&m->room, sheet);
}

/* Moves sheet after sheet until as many pairs penetrate as asked for, within a
 * part in 100; or until several sweeps bring nothing. */
static enum hsr_status settle(struct making *m, uint64_t *n) {
  const uint64_t wanted = m->asked->n_crossings;
  for (int sweep = 0, since = 0; sweep < SWEEPS && since < VAIN; sweep++) {
    const uint64_t before = *n;
    for (uint32_t k = 0; k < m->asked->n_clusters; k++) {
      if (apart(*n, wanted) <= wanted / 100)
        return HSR_OK;
      if (move_sheet(m, k, n))
        return HSR_E_NOMEM;
    }
    since = *n == before ? since + 1 : 0;
  }
  return HSR_OK;
}

/* --- The scene ------------------------------------------------------------ */

static enum hsr_status make_room(struct making *m) {
  const uint32_t n = m->asked->n_faces, n_sheets = m->asked->n_clusters;
  m->face = HSR_NEW(&m->arena, struct hsr_sheet_face, n);
  m->ij = hsr_arena_array(&m->arena, n, sizeof *m->ij);
  m->first = HSR_NEW(&m->arena, uint32_t, (size_t)n_sheets + 1);
  m->low = hsr_arena_array(&m->arena, n_sheets, sizeof *m->low);
  m->high = hsr_arena_array(&m->arena, n_sheets, sizeof *m->high);
  m->random = HSR_NEW(&m->arena, struct hsr_random, n_sheets);
  m->origin = hsr_arena_array(&m->arena, n_sheets, sizeof *m->origin);
  if (!m->face || !m->ij || !m->first || !m->low || !m->high || !m->random ||
      !m->origin)
    return HSR_E_NOMEM;
  m->first[0] = 0;
  for (uint32_t k = 0; k < n_sheets; k++)
    m->random[k].state = (m->asked->seed << 32) + k;
  for (uint32_t k = 0; k < n_sheets; k++)
    m->first[k + 1] = m->first[k] + (uint32_t)part_of(n, k, n_sheets);
  m->room = (struct hsr_room){.face = m->face,
                              .first = m->first,
                              .origin = m->origin,
                              .low = {-m->asked->width / 2, -0.5},
                              .high = {m->asked->width / 2, 0.5},
                              .arena = &m->arena};
  return HSR_OK;
}

/* Throws all sheets, and counts the pairs that penetrate. */
static enum hsr_status throw_all(struct making *m, uint64_t *n_crossings,
                                 struct hsr_error *err) {
  const uint32_t n_sheets = m->asked->n_clusters;
  enum hsr_status status = HSR_OK;
  for (uint32_t k = 0; k < n_sheets && !status; k++) {
    status = shape_sheet(m, k);
    if (!status)
      status = check_size(m, k, err);
    if (!status)
      throw_sheet(m, k);
  }
  if (!status)
    status = hsr_room_divide(&m->room, m->asked->n_faces);
  *n_crossings = 0;
  for (uint32_t k = 0; k < n_sheets && !status; k++) {
    *n_crossings += hsr_room_crossings(&m->room, k);
    status = hsr_room_put(&m->room, k);
  }
  return status;
}

/* The corners of a sheet's faces as vertices of its object. Two faces that meet
 * share them. */
static void draw_sheet(struct hsr_pen *pen, const struct making *m,
                       uint32_t sheet, uint32_t *number, uint32_t columns) {
  hsr_pen_object(pen, "sheet", false);
  hsr_pen_palette(pen, sheet);
  for (uint32_t f = m->first[sheet]; f < m->first[sheet + 1]; f++) {
    const struct hsr_sheet_face *face = &m->face[f];
    uint32_t vertex[4];
    for (int k = 0; k < 4; k++) {
      const uint32_t right = k == 1 || k == 2, up = k > 1;
      uint32_t *at =
          &number[(m->ij[f][1] + up) * columns + m->ij[f][0] + right];
      if (*at == UINT32_MAX) {
        double p[3];
        for (int c = 0; c < 3; c++)
          p[c] = m->origin[sheet][c] + face->p[c] + right * face->u[c] +
                 up * face->v[c];
        *at = hsr_pen_vertex(pen, p[0], p[1], p[2]);
      }
      vertex[k] = *at;
    }
    hsr_pen_face(pen, 4, vertex);
  }
  hsr_pen_place(pen, NULL);
}

static enum hsr_status draw_all(struct hsr_pen *pen, struct making *m) {
  for (uint32_t k = 0; k < m->asked->n_clusters && !pen->status; k++) {
    uint32_t columns = 2, rows = 2;
    for (uint32_t f = m->first[k]; f < m->first[k + 1]; f++) {
      columns = m->ij[f][0] + 2 > columns ? m->ij[f][0] + 2 : columns;
      rows = m->ij[f][1] + 2 > rows ? m->ij[f][1] + 2 : rows;
    }
    const size_t n = (size_t)columns * rows;
    uint32_t *number = HSR_NEW(&m->arena, uint32_t, n);
    if (!number)
      return HSR_E_NOMEM;
    memset(number, 0xff, n * sizeof *number);
    draw_sheet(pen, m, k, number, columns);
  }
  return pen->status;
}

static enum hsr_status look(struct hsr_scene *scene) {
  const struct hsr_camera camera = {.eye = {0, 0, 1},
                                    .at = {0, 0, 0},
                                    .up = {0, 1, 0},
                                    .fov = 45,
                                    .parallel = 1};
  return hsr_scene_view(scene, &camera);
}

enum hsr_status hsr_sheets_build(struct hsr_scene *scene,
                                 const struct hsr_sheets *sheets,
                                 uint64_t *n_crossings, struct hsr_error *err) {
  struct making m = {.asked = sheets};
  enum hsr_status status = make_room(&m);
  if (!status)
    status = throw_all(&m, n_crossings, err);
  if (!status)
    status = settle(&m, n_crossings);
  struct hsr_pen pen;
  hsr_pen_init(&pen, scene);
  if (!status)
    status = draw_all(&pen, &m);
  if (!status)
    status = look(scene);
  hsr_arena_free(&m.arena);
  return status == HSR_E_NOMEM ? hsr_fail_nomem(err) : status;
}
