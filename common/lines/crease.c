/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sides of faces are sorted here again. common/lines/edges.h has them too,
 * but making it looks for penetrations as well. */
#include "common/lines/crease.h"
#include "common/exact/predicates.h"
#include "common/scene/pieces.h"

#include <math.h>
#include <stdlib.h>

/* A side of an existing face: the edge from a to b, a < b, which the face runs
 * along (+1) or against (-1). */
struct side {
  uint32_t a, b, face;
  signed char along;
  signed char facing; /* +1 if the eye is in front of the face, else -1 */
};

struct sides {
  struct side *side; /* by a, b */
  size_t n;
};

static int order(uint32_t a, uint32_t b) {
  return (a > b) - (a < b);
}

static int by_edge(const void *a, const void *b) {
  const struct side *s = a, *t = b;
  return s->a != t->a   ? order(s->a, t->a)
         : s->b != t->b ? order(s->b, t->b)
                        : order(s->face, t->face);
}

static void add_sides(struct sides *sides, const struct hsr_world *world,
                      uint32_t f, int facing) {
  uint32_t size = hsr_face_size(world, f);
  const uint32_t *vertex = world->mesh.vertex + world->mesh.start[f];
  for (uint32_t k = 0; k < size; k++) {
    uint32_t a = vertex[k], b = vertex[k + 1 < size ? k + 1 : 0];
    sides->side[sides->n++] = (struct side){.a = a < b ? a : b,
                                            .b = a < b ? b : a,
                                            .face = f,
                                            .along = a < b ? 1 : -1,
                                            .facing = (signed char)facing};
  }
}

static enum hsr_status find_sides(struct sides *sides,
                                  const struct hsr_world *world,
                                  const struct hsr_view *view,
                                  struct hsr_error *err) {
  bool out_of_memory = false;
  *sides = (struct sides){.side = malloc(((size_t)world->mesh.n_corners + 1) *
                                         sizeof *sides->side)};
  if (!sides->side)
    return hsr_fail_nomem(err);
  for (uint32_t f = 0; f < world->n_faces; f++) {
    int facing =
        hsr_exact_eye_side(view, hsr_plane_loop(world, f), &out_of_memory);
    if (facing > 0 || (facing < 0 && !world->mesh.one_sided[f]))
      add_sides(sides, world, f, facing);
  }
  if (out_of_memory)
    return hsr_fail_nomem(err);
  qsort(sides->side, sides->n, sizeof *sides->side, by_edge);
  return HSR_OK;
}

/* The cosine of the angle between the normals of two faces. If they run along
 * their common edge in one direction, one normal is turned. */
static double cosine(const struct hsr_world *world, const struct side *s,
                     const struct side *t) {
  const double n[3] = {world->mesh.nx[s->face], world->mesh.ny[s->face],
                       world->mesh.nz[s->face]};
  const double m[3] = {world->mesh.nx[t->face], world->mesh.ny[t->face],
                       world->mesh.nz[t->face]};
  double nn = 0, mm = 0, nm = 0;
  for (int k = 0; k < 3; k++) {
    nn += n[k] * n[k];
    mm += m[k] * m[k];
    nm += n[k] * m[k];
  }
  return (s->along == t->along ? -nm : nm) / sqrt(nn) / sqrt(mm);
}

/* The n sides are those of one edge. */
static bool is_shown(const struct hsr_world *world, const struct side *side,
                     size_t n, double least_cosine) {
  if (n != 2)
    return true;
  bool contour =
      side[0].facing * side[0].along == side[1].facing * side[1].along;
  return contour || cosine(world, &side[0], &side[1]) < least_cosine;
}

static bool is_of(const struct side *side, struct hsr_edge_name edge) {
  return side->a == edge.a && side->b == edge.b;
}

static bool is_before(const struct side *side, struct hsr_edge_name edge) {
  return side->a < edge.a || (side->a == edge.a && side->b < edge.b);
}

/* The sides of the edges of a drawing, which is in the order of the
 * definition. */
struct walk {
  struct sides sides;
  size_t next; /* no side before it is of an edge that follows */
  double least_cosine;
};

static enum hsr_status walk_begin(struct walk *walk,
                                  const struct hsr_world *world,
                                  const struct hsr_view *view, double degrees,
                                  struct hsr_error *err) {
  const double pi = 3.14159265358979323846;
  *walk = (struct walk){.least_cosine = cos(degrees * (pi / 180))};
  return find_sides(&walk->sides, world, view, err);
}

/* The sides of an edge, which are n. */
static const struct side *sides_of(struct walk *walk, struct hsr_edge_name edge,
                                   size_t *n) {
  const struct sides *sides = &walk->sides;
  *n = 0;
  while (walk->next < sides->n && is_before(&sides->side[walk->next], edge))
    walk->next++;
  const struct side *side = sides->side + walk->next;
  while (walk->next + *n < sides->n && is_of(&side[*n], edge))
    ++*n;
  return side;
}

static bool is_seam(struct walk *walk, const struct hsr_world *world,
                    struct hsr_edge_name edge) {
  size_t n;
  if (edge.implied)
    return false;
  const struct side *side = sides_of(walk, edge, &n);
  return !is_shown(world, side, n, walk->least_cosine);
}

enum hsr_status hsr_drawing_crease(struct hsr_drawing *drawing,
                                   const struct hsr_world *world,
                                   const struct hsr_view *view, double degrees,
                                   struct hsr_error *err) {
  struct walk walk;
  enum hsr_status status = walk_begin(&walk, world, view, degrees, err);
  size_t kept = 0;
  for (size_t k = 0; k < drawing->n && !status; k++)
    if (!is_seam(&walk, world, drawing->segment[k].edge))
      drawing->segment[kept++] = drawing->segment[k];
  if (!status)
    drawing->n = kept;
  free(walk.sides.side);
  return status;
}

enum hsr_status hsr_drawing_count_edges(const struct hsr_drawing *drawing,
                                        const struct hsr_world *world,
                                        const struct hsr_view *view,
                                        double degrees,
                                        struct hsr_edge_counts *counts,
                                        struct hsr_error *err) {
  struct walk walk;
  enum hsr_status status = walk_begin(&walk, world, view, degrees, err);
  *counts = (struct hsr_edge_counts){.edges = 0};
  for (size_t k = 0; k < drawing->n && !status; k++) {
    const struct hsr_edge_name *edge = &drawing->segment[k].edge;
    size_t n;
    if (k && !hsr_edge_name_compare(edge, &drawing->segment[k - 1].edge))
      continue;
    counts->edges++;
    if (edge->implied)
      continue;
    const struct side *side = sides_of(&walk, *edge, &n);
    counts->seams += !is_shown(world, side, n, walk.least_cosine);
    counts->borders += n == 1;
  }
  free(walk.sides.side);
  return status;
}
