/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What an algorithm made before the frame, for the page: the tree of planes
 * between clusters, a BSP tree, octrees. Trees that a module keeps to itself are
 * made again here by the same rule; that is deterministic. Numbers of faces are
 * the scene's own. */
#include "algorithms/hierarchical/cubes.h"
#include "bench/lesson/lesson.h"
#include "common/answers/coded.h"
#include "common/scene/clusters.h"
#include "common/scene/pieces.h"
#include "common/trees/bsp.h"

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

static bool counts(const struct hsr_algorithm *a, const char *name) {
  for (int k = 0; k < trace_n_counters(a); k++)
    if (!strcmp(a->counters[k].name, name))
      return true;
  return false;
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

static json_int_t node_or_none(uint32_t node) {
  return node == HSR_NO_BSP ? -1 : (json_int_t)node;
}

static json_t *nodes_json(const struct hsr_bsp *bsp) {
  json_t *nodes = json_array();
  for (uint32_t k = 0; k < bsp->n_nodes; k++) {
    const struct hsr_bsp_node *n = &bsp->node[k];
    uint32_t face = hsr_world_parent(bsp->world, bsp->face_of[n->plane]);
    hsr_json_append(
        &nodes, json_pack("[I I I I I]", (json_int_t)face,
                          node_or_none(n->front), node_or_none(n->behind),
                          (json_int_t)n->first_piece, (json_int_t)n->n_pieces));
  }
  return nodes;
}

static json_t *bsp_pieces_json(const struct hsr_bsp *bsp,
                               const struct hsr_view *view) {
  uint32_t most = 1;
  for (uint32_t k = 0; k < bsp->n_pieces; k++)
    if (bsp->piece[k].n_corners > most)
      most = bsp->piece[k].n_corners;
  double(*in)[3] = malloc(most * sizeof *in);
  double(*out)[3] = malloc((most + most / 2 + 1) * sizeof *out);
  json_t *pieces = in && out ? json_array() : NULL;
  for (uint32_t k = 0; pieces && k < bsp->n_pieces; k++) {
    const struct hsr_bsp_piece *p = &bsp->piece[k];
    for (uint32_t c = 0; c < p->n_corners; c++) {
      uint32_t at = bsp->corner[p->first_corner + c].point;
      hsr_view_project(
          view, (const double[3]){bsp->x[at], bsp->y[at], bsp->z[at]}, in[c]);
    }
    hsr_json_append(&pieces,
                    json_pack("[I o]",
                              (json_int_t)hsr_world_parent(bsp->world, p->face),
                              trace_polygon_json(view, (const double(*)[3])in,
                                                 (int)p->n_corners, out)));
  }
  free(in);
  free(out);
  return pieces;
}

/* One tree of all faces, as of algorithms/list_priority/fixed/bsp_frame.c. */
static bool add_bsp(json_t **to, const struct trace_run *run) {
  static const struct hsr_bsp_rule one_tree = {.most = 0};
  struct hsr_bsp bsp;
  struct hsr_error err;
  bool good = !hsr_bsp_init(&bsp, run->setup.world, &one_tree, &err);
  if (good && bsp.n_nodes && bsp.n_nodes <= MOST_NODES) {
    add(to, "nodes", nodes_json(&bsp));
    add(to, "pieces", bsp_pieces_json(&bsp, &run->view));
  }
  hsr_bsp_free(&bsp);
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

static long option_of(const struct hsr_setup *setup, const char *name,
                      long otherwise) {
  const struct hsr_option *o = setup->algorithm->options;
  for (int k = 0; o && o[k].name; k++)
    if (!strcmp(o[k].name, name))
      return setup->choice.values.option[k];
  return otherwise;
}

/* As of algorithms/hierarchical/: those that test cubes have the rule of
 * hzbuffer.c, by its options or its standard; clark.c has another. */
static struct hsr_octree_rule cube_rule(const struct hsr_setup *setup) {
  if (!counts(setup->algorithm, "cubes tested"))
    return (struct hsr_octree_rule){.small = 0, .most = 32, .least = 1};
  bool pushed = !option_of(setup, "placement", 0);
  uint32_t least = (uint32_t)option_of(setup, "least", 20);
  return (struct hsr_octree_rule){
      .small = pushed ? 1. / (double)option_of(setup, "small", 10) : 0,
      .most = least,
      .least = least};
}

static bool add_cubes(json_t **to, const struct trace_run *run) {
  static const double still[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  struct hsr_octree_rule rule = cube_rule(&run->setup);
  struct hsr_cubes cubes;
  struct hsr_error err;
  bool good = !hsr_cubes_init(&cubes, run->setup.world, &rule, &err);
  json_t *all = json_array();
  if (good)
    add_octree(&all, &run->view, &cubes.octree, -1, still);
  for (uint32_t k = 0; good && k < run->scene->n_instances; k++) {
    const struct hsr_instance *instance = &run->scene->instances[k];
    add_octree(&all, &run->view, &cubes.object[instance->object].octree, k,
               instance->m);
  }
  hsr_cubes_free(&cubes);
  add(to, "cubes", all);
  return good;
}

json_t *lesson_structure_json(const struct trace_run *run) {
  const struct hsr_algorithm *a = run->setup.algorithm;
  json_t *structure = json_object();
  bool good = true;
  if (counts(a, "inter-cluster priority"))
    add_clusters(&structure, run->setup.world);
  if (counts(a, "pieces") && counts(a, "thickness checks") &&
      !option_of(&run->setup, "leaf", 0))
    good = add_bsp(&structure, run);
  if (counts(a, "nodes visited"))
    good = add_cubes(&structure, run);
  if (!good)
    json_decref(structure);
  return good ? structure : NULL;
}
