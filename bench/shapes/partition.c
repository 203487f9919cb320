/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Trees of planes, and the convex cells that they divide a box into.
 *
 * A cell is bounded by the planes of its ancestors and the box: each of its
 * sides is one of these planes, cut by all others. A side is cut by Sutherland
 * and Hodgman's algorithm ("Reentrant Polygon Clipping", CACM 17(1), 1974), in
 * doubles. */
#include "bench/shapes/shapes.h"

#include "common/trees/bsp.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* normal . X <= at holds in the cell. */
struct half {
  double normal[3], at;
};

/* A tree in a form that all trees have: a node has a plane, two sides, or is a
 * leaf. `place` counts cells and planes in the order in which the eye meets
 * them. */
struct tree {
  const void *of;
  /* The plane of a node, which is in front where normal . X > at. */
  struct half (*plane)(const void *of, uint32_t node);
  /* What is on one side; false: nothing but space. */
  bool (*child)(const void *of, uint32_t node, bool front, uint32_t *child);
  bool (*is_leaf)(const void *of, uint32_t node);
  uint32_t (*name)(const void *of, uint32_t node); /* its plane, or cell */
};

enum { MOST_DEPTH = 500, MOST_CORNERS = MOST_DEPTH + 12, NO_CHILD = -1 };
enum { NODE, DEPTH, PLANE, PLACE };

struct walk {
  const struct tree *tree;
  const struct hsr_view *view;
  struct cell_list *list;
  struct half half[MOST_DEPTH + 6]; /* that bound the current cell */
  int n, deepest;
  double size; /* of the box */
  uint32_t place;
  bool too_deep;
};

struct corners {
  int n;
  double p[MOST_CORNERS][3];
};

static double beyond(const struct half *half, const double p[3]) {
  return half->normal[0] * p[0] + half->normal[1] * p[1] +
         half->normal[2] * p[2] - half->at;
}

/* Keeps what is on the inner side of a plane. */
static void cut(const struct corners *from, const struct half *half,
                struct corners *to) {
  to->n = 0;
  for (int k = 0; k < from->n; k++) {
    const double *a = from->p[k], *b = from->p[(k + 1) % from->n];
    double x = beyond(half, a), y = beyond(half, b);
    if (x <= 0 && to->n < MOST_CORNERS)
      memcpy(to->p[to->n++], a, sizeof to->p[0]);
    if ((x < 0 && y > 0) || (x > 0 && y < 0)) {
      if (to->n == MOST_CORNERS)
        return;
      for (int c = 0; c < 3; c++)
        to->p[to->n][c] = a[c] + (b[c] - a[c]) * (x / (x - y));
      to->n++;
    }
  }
}

/* A square of a plane that reaches beyond the box, counter-clockwise seen from
 * where the normal points to. */
static void begin_side(const struct half *plane, const double middle[3],
                       double size, struct corners *side) {
  const double *n = plane->normal;
  int least = fabs(n[0]) < fabs(n[1]) ? 0 : 1;
  if (fabs(n[2]) < fabs(n[least]))
    least = 2;
  double axis[3] = {0, 0, 0}, u[3], v[3], nn = 0, uu = 0;
  axis[least] = 1;
  for (int k = 0; k < 3; k++) {
    int l = (k + 1) % 3, m = (k + 2) % 3;
    u[k] = n[l] * axis[m] - n[m] * axis[l];
    nn += n[k] * n[k];
    uu += u[k] * u[k];
  }
  double off = beyond(plane, middle) / nn;
  for (int k = 0; k < 3; k++) {
    int l = (k + 1) % 3, m = (k + 2) % 3;
    v[k] = (n[l] * u[m] - n[m] * u[l]) / sqrt(nn * uu);
  }
  side->n = 4;
  for (int c = 0; c < 4; c++) {
    double a = c == 1 || c == 2 ? size : -size, b = c > 1 ? size : -size;
    for (int k = 0; k < 3; k++)
      side->p[c][k] = middle[k] - off * n[k] + a * u[k] / sqrt(uu) + b * v[k];
  }
}

/* The part of a plane within the current cell, but for bound `except`. */
static void find_side(const struct walk *w, const struct half *plane,
                      int except, struct corners *side) {
  struct corners other;
  double middle[3];
  for (int k = 0; k < 3; k++)
    middle[k] = (w->half[2 * k].at - w->half[2 * k + 1].at) / 2;
  begin_side(plane, middle, 2 * w->size, side);
  for (int k = 0; k < w->n && side->n > 2; k++) {
    if (k == except)
      continue;
    cut(side, &w->half[k], &other);
    *side = other;
  }
}

/* Side k of the current cell: less than three corners if it is none, or lies on
 * an earlier bound, since one plane may divide a tree twice. */
static void find_side_of(const struct walk *w, int k, struct corners *side) {
  const double least = 1e-9 * w->size;
  find_side(w, &w->half[k], k, side);
  for (int j = 0; j < k; j++) {
    const struct half *other = &w->half[j];
    double along = 0, length = 0, farthest = 0;
    for (int c = 0; c < 3; c++) {
      along += other->normal[c] * w->half[k].normal[c];
      length += other->normal[c] * other->normal[c];
    }
    for (int c = 0; c < side->n; c++)
      farthest = fmax(farthest, fabs(beyond(other, side->p[c])));
    if (along > 0 && farthest <= least * sqrt(length))
      side->n = 0;
  }
}

static void list_points(struct cell_list *list, const struct corners *side) {
  for (int k = 0; k < side->n; k++)
    cell_list_number(list, cell_list_point(list, side->p[k]));
}

static void list_values(struct walk *w, uint32_t node, uint32_t name,
                        int depth) {
  cell_list_value(w->list, NODE, node);
  cell_list_value(w->list, DEPTH, (uint32_t)depth);
  cell_list_value(w->list, PLANE, name);
  cell_list_value(w->list, PLACE, w->place++);
}

/* A cell without volume, which rounding leaves, is left out. */
static void list_cell(struct walk *w, uint32_t node, uint32_t name) {
  struct corners side;
  int n = 0;
  for (int k = 0; k < w->n; k++) {
    find_side_of(w, k, &side);
    n += side.n > 2;
  }
  if (n < 4)
    return;
  cell_list_number(w->list, (uint32_t)n);
  for (int k = 0; k < w->n; k++) {
    find_side_of(w, k, &side);
    if (side.n < 3)
      continue;
    cell_list_number(w->list, (uint32_t)side.n);
    list_points(w->list, &side);
  }
  cell_list_end(w->list);
  list_values(w, node, name, w->n - 6);
}

static void list_plane(struct walk *w, uint32_t node,
                       const struct half *plane) {
  struct corners side;
  find_side(w, plane, -1, &side);
  if (side.n < 3)
    return;
  list_points(w->list, &side);
  cell_list_end(w->list);
  list_values(w, node, w->tree->name(w->tree->of, node), w->n - 6);
}

/* --- The traversal for one eye -------------------------------------------- */

static bool is_eye_in_front(const struct walk *w, const struct half *plane) {
  const struct hsr_view *view = w->view;
  double sum = view->parallel ? 0 : -plane->at;
  for (int k = 0; k < 3; k++)
    sum += plane->normal[k] * (view->parallel ? -view->F[k] : view->E[k]);
  return sum > 0;
}

static void visit(struct walk *w, uint32_t node);

static void visit_side(struct walk *w, uint32_t node, const struct half *plane,
                       bool front) {
  double sign = front ? -1 : 1;
  w->half[w->n++] =
      (struct half){{sign * plane->normal[0], sign * plane->normal[1],
                     sign * plane->normal[2]},
                    sign * plane->at};
  uint32_t child;
  if (w->tree->child(w->tree->of, node, front, &child))
    visit(w, child);
  else if (w->list->kind == HSR_CELL_POLYHEDRON)
    list_cell(w, node, HSR_NO_ID);
  w->n--;
}

static void visit(struct walk *w, uint32_t node) {
  if (w->tree->is_leaf(w->tree->of, node)) {
    if (w->list->kind == HSR_CELL_POLYHEDRON)
      list_cell(w, node, w->tree->name(w->tree->of, node));
    return;
  }
  if (w->n == MOST_DEPTH + 6) {
    w->too_deep = true;
    return;
  }
  struct half plane = w->tree->plane(w->tree->of, node);
  bool front = is_eye_in_front(w, &plane);
  visit_side(w, node, &plane, front);
  if (w->list->kind == HSR_CELL_POLYGON)
    list_plane(w, node, &plane);
  visit_side(w, node, &plane, !front);
}

/* The box of all vertices, a little larger: a plane may hold one of its
 * sides. */
static void begin_box(struct walk *w, const struct hsr_world *world) {
  const double *const x[3] = {world->mesh.x, world->mesh.y, world->mesh.z};
  double lo[3], hi[3];
  w->size = 0;
  for (int k = 0; k < 3; k++) {
    lo[k] = INFINITY;
    hi[k] = -INFINITY;
    for (uint32_t v = 0; v < world->mesh.n_vertices; v++) {
      lo[k] = fmin(lo[k], x[k][v]);
      hi[k] = fmax(hi[k], x[k][v]);
    }
    w->size = fmax(w->size, hi[k] - lo[k]);
  }
  for (int k = 0; k < 3; k++) {
    w->half[2 * k] = (struct half){.at = hi[k] + w->size / 64};
    w->half[2 * k].normal[k] = 1;
    w->half[2 * k + 1] = (struct half){.at = w->size / 64 - lo[k]};
    w->half[2 * k + 1].normal[k] = -1;
  }
  w->n = 6;
}

static enum hsr_status list_tree(const struct shape_source *source,
                                 const struct tree *tree, uint32_t root,
                                 struct cell_list *list,
                                 struct hsr_error *err) {
  static const char *const names[] = {"node", "depth", "plane", "place"};
  for (int k = 0; k < 4; k++)
    cell_list_data(list, names[k], HSR_CELL_NUMBERS);
  struct walk *w = malloc(sizeof *w);
  if (!w)
    return hsr_fail_nomem(err);
  *w = (struct walk){.tree = tree, .view = source->view, .list = list};
  begin_box(w, source->setup->world);
  visit(w, root);
  bool too_deep = w->too_deep;
  free(w);
  return too_deep
             ? hsr_fail(err, HSR_E_NOMEM,
                        "the tree of planes is deeper than %d", (int)MOST_DEPTH)
             : HSR_OK;
}

/* The plane of a face, whose front is where its normal points to. */
static struct half plane_of_face(const struct hsr_world *world, uint32_t f) {
  const struct hsr_mesh *mesh = &world->mesh;
  struct half plane = {{mesh->nx[f], mesh->ny[f], mesh->nz[f]}, 0};
  plane.at = mesh->nx[f] * mesh->px[f] + mesh->ny[f] * mesh->py[f] +
             mesh->nz[f] * mesh->pz[f];
  return plane;
}

/* --- BSP trees ------------------------------------------------------------ */

static struct half bsp_plane(const void *of, uint32_t node) {
  const struct hsr_bsp *bsp = of;
  return plane_of_face(bsp->world, bsp->face_of[bsp->node[node].plane]);
}

static bool bsp_child(const void *of, uint32_t node, bool front,
                      uint32_t *child) {
  const struct hsr_bsp *bsp = of;
  *child = front ? bsp->node[node].front : bsp->node[node].behind;
  return *child != HSR_NO_BSP;
}

static bool bsp_is_leaf(const void *of, uint32_t node) {
  (void)of;
  (void)node;
  return false;
}

static uint32_t bsp_name(const void *of, uint32_t node) {
  const struct hsr_bsp *bsp = of;
  return bsp->node[node].plane;
}

enum hsr_status shape_bsp(const struct shape_source *source,
                          struct cell_list *list, struct hsr_error *err) {
  const struct hsr_bsp *bsp = hsr_setup_show(source->setup).bsp;
  if (!bsp || bsp->n_cubes != 1)
    return hsr_fail(err, HSR_E_USAGE,
                    "%s has no BSP tree of all faces: -a bsp-painter has",
                    source->setup->algorithm->name);
  const struct tree tree = {bsp, bsp_plane, bsp_child, bsp_is_leaf, bsp_name};
  return bsp->cube[0].root == HSR_NO_BSP
             ? hsr_fail(err, HSR_E_INPUT, "no face is in the BSP tree")
             : list_tree(source, &tree, bsp->cube[0].root, list, err);
}

/* --- Separators ----------------------------------------------------------- */

static struct half separator_plane(const void *of, uint32_t node) {
  const struct hsr_world *world = of;
  const struct hsr_separator *s = &world->clusters->separator[node];
  struct half plane = {{0, 0, 0}, s->at};
  if (s->face != HSR_NO_FACE)
    return plane_of_face(world, s->face);
  plane.normal[s->axis] = 1;
  return plane;
}

static bool separator_child(const void *of, uint32_t node, bool front,
                            uint32_t *child) {
  const struct hsr_world *world = of;
  const struct hsr_separator *s = &world->clusters->separator[node];
  *child = front ? s->front : s->behind;
  return true;
}

static bool is_cluster(const void *of, uint32_t node) {
  (void)of;
  return node & HSR_IS_CLUSTER;
}

static uint32_t separator_name(const void *of, uint32_t node) {
  (void)of;
  return node & ~HSR_IS_CLUSTER;
}

enum hsr_status shape_separators(const struct shape_source *source,
                                 struct cell_list *list,
                                 struct hsr_error *err) {
  const struct hsr_world *world = source->setup->world;
  if (!world->clusters)
    return hsr_fail(err, HSR_E_USAGE,
                    "%s separates no clusters: -a schumacker does",
                    source->setup->algorithm->name);
  const struct tree tree = {world, separator_plane, separator_child, is_cluster,
                            separator_name};
  return list_tree(source, &tree, world->clusters->root, list, err);
}
