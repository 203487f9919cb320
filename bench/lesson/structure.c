/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What an algorithm made before the frame, for the page: the tree of planes
 * between clusters, a BSP tree, octrees. Numbers of faces are the scene's own. */
#include "algorithms/engines/cubes/cubes.h"
#include "algorithms/image_space/area/tiling/grove.h"
#include "bench/lesson/lesson.h"
#include "common/answers/coded.h"
#include "common/files/json/json.h"
#include "common/scene/clusters.h"
#include "common/scene/pieces.h"
#include "common/trees/bsp.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What is larger is left out of the page. */
enum { MOST_NODES = 20000, MOST_CUBES = 4096 };

static void add(json_t **object, const char *name, json_t *value) {
  if (json_object_set_new(*object, name, value)) {
    json_decref(*object);
    *object = NULL;
  }
}

/* --- Clusters ------------------------------------------------------------- */

static json_int_t side_of(uint32_t encoded) {
  return encoded & HSR_IS_CLUSTER ? -1 - (json_int_t)(encoded & ~HSR_IS_CLUSTER)
                                  : (json_int_t)encoded;
}

static json_t *separators_json(const struct hsr_world *world) {
  const struct hsr_clusters *c = world->clusters;
  json_t *separators = json_array();
  for (uint32_t k = 0; k < c->n_separators; k++) {
    const struct hsr_separator *s = &c->separator[k];
    json_t *face =
        s->face == HSR_NO_FACE
            ? json_null()
            : json_integer((json_int_t)hsr_world_parent(world, s->face));
    hsr_json_append(&separators,
                    json_pack("[o i f I I]", face, s->axis, s->at,
                              side_of(s->front), side_of(s->behind)));
  }
  return separators;
}

/* An oriented face is in the list as often as it is in the cluster: once, if it
 * is seen from both sides. */
static json_t *clusters_json(const struct hsr_world *world) {
  const struct hsr_clusters *c = world->clusters;
  json_t *clusters = json_array();
  for (uint32_t k = 0; k < c->n_clusters; k++) {
    json_t *faces = json_array();
    for (uint32_t o = c->start[k]; o < c->start[k + 1]; o++)
      hsr_json_append(&faces, json_integer((json_int_t)hsr_world_parent(
                                  world, c->order[o] / 2)));
    hsr_json_append(&clusters, faces);
  }
  return clusters;
}

static void add_clusters(json_t **to, const struct hsr_world *world) {
  if (!world->clusters || world->clusters->n_separators > MOST_NODES)
    return;
  add(to, "separators", separators_json(world));
  add(to, "root", json_integer(side_of(world->clusters->root)));
  add(to, "clusters", clusters_json(world));
}

/* --- BSP trees ------------------------------------------------------------ */

/* What is known of BSP trees so far; the page numbers all nodes and all pieces
 * through. */
struct forest {
  const struct hsr_view *view;
  json_t *nodes, *roots, *pieces, *bases, *cubes;
};

/* A tree in its place. */
struct tree {
  const struct hsr_bsp *bsp;
  uint32_t first;      /* added to the number of a face: its id */
  json_int_t instance; /* whose tree it is; -1: of no single one */
  double shift[3];
};

static json_int_t face_id(const struct tree *tree, uint32_t face) {
  return tree->first + (json_int_t)hsr_world_parent(tree->bsp->world, face);
}

static void add_nodes(struct forest *f, const struct tree *tree) {
  const struct hsr_bsp *bsp = tree->bsp;
  json_int_t nodes = (json_int_t)json_array_size(f->nodes),
             pieces = (json_int_t)json_array_size(f->pieces);
  for (uint32_t k = 0; k < bsp->n_nodes; k++) {
    const struct hsr_bsp_node *n = &bsp->node[k];
    json_int_t side[2] = {n->front, n->behind};
    for (int s = 0; s < 2; s++)
      side[s] = side[s] == HSR_NO_BSP ? -1 : side[s] + nodes;
    hsr_json_append(
        &f->nodes,
        json_pack("[I I I I I]", face_id(tree, bsp->face_of[n->plane]), side[0],
                  side[1], n->first_piece + pieces, (json_int_t)n->n_pieces));
  }
  for (uint32_t c = 0; c < bsp->n_cubes; c++)
    if (bsp->cube[c].root != HSR_NO_BSP)
      hsr_json_append(&f->roots, json_integer(bsp->cube[c].root + nodes));
}

static void project(const struct forest *f, const struct tree *tree,
                    const double point[3], double image[3]) {
  const double moved[3] = {point[0] + tree->shift[0], point[1] + tree->shift[1],
                           point[2] + tree->shift[2]};
  hsr_view_project(f->view, moved, image);
}

static bool add_pieces(struct forest *f, const struct tree *tree) {
  const struct hsr_bsp *bsp = tree->bsp;
  uint32_t most = 1;
  for (uint32_t k = 0; k < bsp->n_pieces; k++)
    if (bsp->piece[k].n_corners > most)
      most = bsp->piece[k].n_corners;
  double(*in)[3] = malloc(most * sizeof *in);
  double(*out)[3] = malloc((most + most / 2 + 1) * sizeof *out);
  bool good = in && out;
  hsr_json_append(&f->bases, json_pack("[I I]", (json_int_t)tree->first,
                                       (json_int_t)json_array_size(f->pieces)));
  for (uint32_t k = 0; good && k < bsp->n_pieces; k++) {
    const struct hsr_bsp_piece *p = &bsp->piece[k];
    for (uint32_t c = 0; c < p->n_corners; c++) {
      uint32_t at = bsp->corner[p->first_corner + c].point;
      project(f, tree, (const double[3]){bsp->x[at], bsp->y[at], bsp->z[at]},
              in[c]);
    }
    hsr_json_append(&f->pieces, json_pack("[I o]", face_id(tree, p->face),
                                          trace_polygon_json(
                                              f->view, (const double(*)[3])in,
                                              (int)p->n_corners, out)));
  }
  free(in);
  free(out);
  return good;
}

/* The corners of a box; null for all if it holds nothing. */
static json_t *box_json(const struct forest *f, const struct tree *tree,
                        const struct hsr_box *box) {
  json_t *corners = json_array();
  for (int c = 0; c < 8; c++) {
    double point[3];
    for (int k = 0; k < 3; k++)
      point[k] = tree->shift[k] + (c >> k & 1 ? box->hi[k] : box->lo[k]);
    hsr_json_append(&corners, box->lo[0] <= box->hi[0]
                                  ? hsr_point_json(f->view, point)
                                  : json_null());
  }
  return corners;
}

/* What such an algorithm asks about is the tight box in each cube. */
static void add_boxes(struct forest *f, const struct tree *tree) {
  const struct hsr_bsp *bsp = tree->bsp;
  for (uint32_t k = 0;
       k < bsp->n_cubes && json_array_size(f->cubes) < MOST_CUBES; k++)
    hsr_json_append(&f->cubes,
                    json_pack("[I I o]", (json_int_t)k, tree->instance,
                              box_json(f, tree, &bsp->cube[k].tight)));
}

static bool add_tree(struct forest *f, const struct tree *tree) {
  add_nodes(f, tree);
  add_boxes(f, tree);
  return add_pieces(f, tree);
}

/* Takes what is in the forest. */
static void add_forest(json_t **to, struct forest *f, bool boxes) {
  bool is_large = json_array_size(f->nodes) > MOST_NODES;
  const struct {
    const char *name;
    json_t *value;
    bool wanted;
  } member[] = {{"nodes", f->nodes, !is_large && json_array_size(f->nodes)},
                {"roots", f->roots, !is_large},
                {"pieces", f->pieces, !is_large},
                {"bases", f->bases, !is_large},
                {"cubes", f->cubes, boxes}};
  for (size_t k = 0; k < sizeof member / sizeof *member; k++)
    if (member[k].wanted)
      add(to, member[k].name, member[k].value);
    else
      json_decref(member[k].value);
}

static struct forest forest_new(const struct hsr_view *view) {
  return (struct forest){view,         json_array(), json_array(),
                         json_array(), json_array(), json_array()};
}

/* One tree of the whole world, or of each of its cubes. */
static bool add_bsp(json_t **to, const struct trace_run *run,
                    const struct hsr_bsp *bsp) {
  struct forest f = forest_new(&run->view);
  bool good = add_tree(&f, &(struct tree){.bsp = bsp, .instance = -1});
  add_forest(to, &f, bsp->is_octree);
  return good;
}

/* A tree of all, or one for each object, wherever an instance of it is; and boxes
 * of several instances. */
static bool add_grove(json_t **to, const struct trace_run *run,
                      const struct hsr_grove *grove) {
  struct forest f = forest_new(&run->view);
  const struct tree still = {.instance = -1};
  const struct hsr_world *world = run->setup.world;
  bool good =
      !grove->is_whole ||
      add_tree(&f, &(struct tree){.bsp = &grove->whole, .instance = -1});
  for (uint32_t k = 0; good && !grove->is_whole && k < run->scene->n_instances;
       k++) {
    const struct hsr_instance *i = &run->scene->instances[k];
    good = add_tree(&f, &(struct tree){&grove->tree[i->object].bsp,
                                       world->roster.first[k],
                                       k,
                                       {i->m[3], i->m[7], i->m[11]}});
  }
  for (uint32_t k = 0; good && !grove->is_whole && k < grove->n_nodes; k++)
    hsr_json_append(&f.cubes,
                    json_pack("[I I o]", (json_int_t)k, (json_int_t)-1,
                              box_json(&f, &still, &grove->node[k].box)));
  add_forest(to, &f, true);
  return good;
}

/* --- Octrees -------------------------------------------------------------- */

static json_t *cube_json(const struct hsr_view *view, uint32_t node,
                         json_int_t instance,
                         const struct hsr_octree_node *cube, const double *m) {
  json_t *corners = json_array();
  for (int c = 0; c < 8; c++) {
    double own[3], point[3];
    for (int k = 0; k < 3; k++)
      own[k] = cube->centre[k] + (c >> k & 1 ? cube->half : -cube->half);
    for (int k = 0; k < 3; k++)
      point[k] = m[4 * k] * own[0] + m[4 * k + 1] * own[1] +
                 m[4 * k + 2] * own[2] + m[4 * k + 3];
    hsr_json_append(&corners, hsr_point_json(view, point));
  }
  return json_pack("[I I o]", (json_int_t)node, instance, corners);
}

static void add_octree(json_t **cubes, const struct hsr_view *view,
                       const struct hsr_octree *octree, json_int_t instance,
                       const double *m) {
  for (uint32_t k = 0;
       k < octree->n_nodes && json_array_size(*cubes) < MOST_CUBES; k++)
    hsr_json_append(cubes, cube_json(view, k, instance, &octree->node[k], m));
}

/* Where the world is. */
static const double still[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

static void add_cubes(json_t **to, const struct trace_run *run,
                      const struct hsr_cubes *cubes) {
  json_t *all = json_array();
  add_octree(&all, &run->view, &cubes->octree, -1, still);
  for (uint32_t k = 0; k < run->scene->n_instances; k++) {
    const struct hsr_instance *instance = &run->scene->instances[k];
    add_octree(&all, &run->view, &cubes->object[instance->object].octree, k,
               instance->m);
  }
  add(to, "cubes", all);
}

static void add_own_octree(json_t **to, const struct trace_run *run,
                           const struct hsr_octree *octree) {
  json_t *all = json_array();
  add_octree(&all, &run->view, octree, -1, still);
  add(to, "cubes", all);
}

/* --- Boxes ---------------------------------------------------------------- */

/* What takes boxes, clipped to one around the scene. */
struct boxes {
  const struct hsr_view *view;
  struct hsr_box around;
  json_t *all;
};

/* The image of a box that is flat across an axis: a rectangle. null: it is not flat. */
static json_t *rectangle_json(const struct hsr_view *view,
                              const struct hsr_box *box) {
  for (int axis = 0; axis < 3; axis++) {
    if (box->lo[axis] < box->hi[axis])
      continue;
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    double at[4][3];
    for (int c = 0; c < 4; c++) {
      at[c][axis] = box->lo[axis];
      at[c][u] = c == 1 || c == 2 ? box->hi[u] : box->lo[u];
      at[c][v] = c >= 2 ? box->hi[v] : box->lo[v];
    }
    return lesson_image_json(view, (const double(*)[3])at, 4);
  }
  return json_null();
}

static void add_box(void *to, uint32_t a, uint32_t b,
                    const struct hsr_box *box) {
  struct boxes *boxes = to;
  if (json_array_size(boxes->all) >= MOST_CUBES)
    return;
  json_t *corners = json_array();
  for (int c = 0; c < 8; c++) {
    double point[3];
    for (int k = 0; k < 3; k++)
      point[k] =
          fmin(fmax(c >> k & 1 ? box->hi[k] : box->lo[k], boxes->around.lo[k]),
               boxes->around.hi[k]);
    hsr_json_append(&corners, hsr_point_json(boxes->view, point));
  }
  hsr_json_append(&boxes->all,
                  json_pack("[I I o o]", (json_int_t)a,
                            b == HSR_NO_ID ? (json_int_t)-1 : (json_int_t)b,
                            corners, rectangle_json(boxes->view, box)));
}

/* Around all points of the world, a little wider. */
static struct hsr_box around(const struct hsr_world *world) {
  const struct hsr_mesh *mesh = &world->mesh;
  const double *at[3] = {mesh->x, mesh->y, mesh->z};
  struct hsr_box box;
  for (int k = 0; k < 3; k++) {
    double low = INFINITY, high = -INFINITY;
    for (uint32_t p = 0; p < mesh->n_vertices; p++) {
      low = fmin(low, at[k][p]);
      high = fmax(high, at[k][p]);
    }
    double more = .02 * (high - low);
    box.lo[k] = low - more;
    box.hi[k] = high + more;
  }
  return box;
}

static void add_own_boxes(json_t **to, const struct trace_run *run,
                          const struct hsr_shown *shown) {
  struct boxes boxes = {.view = &run->view,
                        .around = {{-INFINITY, -INFINITY, -INFINITY},
                                   {INFINITY, INFINITY, INFINITY}},
                        .all = json_array()};
  if (!run->scene->grid)
    boxes.around = around(run->setup.world);
  shown->boxes(run->setup.prepared, run->scene, add_box, &boxes);
  add(to, "isBoxes", json_true());
  add(to, "cubes", boxes.all);
}

/* Of cells; NULL: the page needs none. */
static const char *const numbered_word[] = {[HSR_NUMBERED_TEXELS] = "texels",
                                            [HSR_NUMBERED_ENTRIES] = "entries",
                                            [HSR_NUMBERED_SQUARES] = "squares"};

bool lesson_has_texels(const struct hsr_setup *setup) {
  return setup->algorithm->numbered == HSR_NUMBERED_TEXELS ||
         setup->algorithm->numbered == HSR_NUMBERED_ENTRIES;
}

json_t *lesson_structure_json(const struct trace_run *run) {
  const struct hsr_shown shown = hsr_setup_show(&run->setup);
  json_t *structure = json_object();
  bool good = true;
  add_clusters(&structure, run->setup.world);
  if (shown.grove)
    good = add_grove(&structure, run, shown.grove);
  if (shown.bsp)
    good &= add_bsp(&structure, run, shown.bsp);
  if (shown.octree)
    add_own_octree(&structure, run, shown.octree);
  if (shown.cubes)
    add_cubes(&structure, run, shown.cubes);
  if (shown.boxes)
    add_own_boxes(&structure, run, &shown);
  if (lesson_has_cells(run))
    good &= lesson_add_cells(structure, run);
  if (lesson_has_volumes(&run->setup))
    good &= lesson_add_volumes(structure, run);
  if (numbered_word[run->setup.algorithm->numbered])
    add(&structure, "numbered",
        json_string(numbered_word[run->setup.algorithm->numbered]));
  if (!good)
    json_decref(structure);
  return good ? structure : NULL;
}
