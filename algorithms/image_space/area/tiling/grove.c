/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/image_space/area/tiling/grove.h"
#include "common/adapt/adapt.h"
#include "common/trees/grain.h"
#include "common/exact/predicates.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- Whether an instance may be in the grove ------------------------------ */

static bool is_moved_only(const struct hsr_instance *instance) {
  const double *m = instance->m;
  for (int k = 0; k < 3; k++)
    for (int l = 0; l < 3; l++)
      if (m[4 * k + l] != (k == l))
        return false;
  return true;
}

static struct hsr_box box_of(const struct hsr_object *object) {
  struct hsr_box box = {{INFINITY, INFINITY, INFINITY},
                        {-INFINITY, -INFINITY, -INFINITY}};
  for (size_t k = 0; k < 3 * (size_t)object->n_vertices; k++) {
    box.lo[k % 3] = fmin(box.lo[k % 3], object->xyz[k]);
    box.hi[k % 3] = fmax(box.hi[k % 3], object->xyz[k]);
  }
  return box;
}

/* Whether a face lies in the plane where coordinate k is `at`. */
static bool lies_in(const struct hsr_object *object, uint32_t f, int k,
                    double at) {
  for (uint32_t c = object->start[f]; c < object->start[f + 1]; c++)
    if (object->xyz[3 * (size_t)object->vertex[c] + (size_t)k] != at)
      return false;
  return true;
}

/* A number with the sign of component k of the normal of a convex face: twice
 * the areas of the triangles about its first corner, as seen along axis k. All
 * have one sign or are 0, so their sum has the right sign in spite of
 * rounding. */
static double normal_sign(const struct hsr_object *object, uint32_t f, int k) {
  int a = (k + 1) % 3, b = (k + 2) % 3;
  const double *xyz = object->xyz;
  const uint32_t *vertex = object->vertex + object->start[f];
  uint32_t n = object->start[f + 1] - object->start[f];
  double sum = 0;
  const double *o = xyz + 3 * (size_t)vertex[0];
  for (uint32_t c = 1; c + 1 < n; c++) {
    const double *p = xyz + 3 * (size_t)vertex[c];
    const double *q = xyz + 3 * (size_t)vertex[c + 1];
    sum += (p[a] - o[a]) * (q[b] - o[b]) - (p[b] - o[b]) * (q[a] - o[a]);
  }
  return sum;
}

/* Does each face that lies in a side of the object's box look outward? Then
 * none of them can be seen from within the box. */
static bool looks_outward(const struct hsr_object *object) {
  struct hsr_box box = box_of(object);
  for (uint32_t f = 0; f < object->n_faces; f++)
    for (int k = 0; k < 3; k++) {
      bool low = lies_in(object, f, k, box.lo[k]);
      bool high = lies_in(object, f, k, box.hi[k]);
      if (!low && !high)
        continue;
      double outward = normal_sign(object, f, k);
      if (!object->one_sided || (low && !(outward < 0)) ||
          (high && !(outward > 0)))
        return false;
    }
  return true;
}

/* --- The order of instances ----------------------------------------------- */

enum { MOST_DEPTH = 500 };

struct ordering {
  struct hsr_grove *grove;
  const struct hsr_box *box; /* an instance */
  bool may_touch;
};

struct key {
  double lo;
  uint32_t instance;
};

static int compare_keys(const void *a, const void *b) {
  const struct key *k = a, *l = b;
  if (k->lo != l->lo)
    return k->lo < l->lo ? -1 : 1;
  return (k->instance > l->instance) - (k->instance < l->instance);
}

/* Sorts n instances along an axis, and finds the plane across it that separates
 * them most evenly. Returns how many are below it; 0: no plane separates
 * them. */
static uint32_t divide(const struct ordering *o, uint32_t *instance, uint32_t n,
                       int axis, struct key *key, double *at) {
  for (uint32_t k = 0; k < n; k++)
    key[k] = (struct key){o->box[instance[k]].lo[axis], instance[k]};
  qsort(key, n, sizeof *key, compare_keys);
  uint32_t best = 0;
  double reach = -INFINITY;
  for (uint32_t k = 0; k + 1 < n; k++) {
    instance[k] = key[k].instance;
    reach = fmax(reach, o->box[key[k].instance].hi[axis]);
    bool apart = o->may_touch ? reach <= key[k + 1].lo : reach < key[k + 1].lo;
    uint32_t uneven = n > 2 * (k + 1) ? n - 2 * (k + 1) : 2 * (k + 1) - n;
    uint32_t before = n > 2 * best ? n - 2 * best : 2 * best - n;
    if (apart && (!best || uneven < before)) {
      best = k + 1;
      *at = key[k + 1].lo;
    }
  }
  instance[n - 1] = key[n - 1].instance;
  return best;
}

static void enclose(struct hsr_box *box, const struct hsr_box *more) {
  for (int k = 0; k < 3; k++) {
    box->lo[k] = fmin(box->lo[k], more->lo[k]);
    box->hi[k] = fmax(box->hi[k], more->hi[k]);
  }
}

/* Makes the nodes of n instances, *number being the topmost. False if no plane
 * separates some of them, or if the nodes are nested too deep. */
static bool put_in_order(struct ordering *o, uint32_t *instance, uint32_t n,
                         int depth, struct key *key, uint32_t *number) {
  struct hsr_grove *g = o->grove;
  if (depth > MOST_DEPTH)
    return false;
  *number = g->n_nodes++;
  struct hsr_grove_node node = {
      .box = o->box[instance[0]], .axis = -1, .instance = instance[0]};
  for (uint32_t k = 1; k < n; k++)
    enclose(&node.box, &o->box[instance[k]]);
  if (n > 1) {
    uint32_t most = 0;
    for (int axis = 0; axis < 3; axis++) {
      double at = 0;
      uint32_t below = divide(o, instance, n, axis, key, &at);
      below = below > n / 2 ? n - below : below;
      if (below > most) {
        most = below;
        node.axis = axis;
      }
    }
    if (!most)
      return false;
    uint32_t below = divide(o, instance, n, node.axis, key, &node.at);
    if (!put_in_order(o, instance, below, depth + 1, key, &node.below) ||
        !put_in_order(o, instance + below, n - below, depth + 1, key,
                      &node.above))
      return false;
  }
  g->node[*number] = node;
  return true;
}

/* Finds the boxes of all instances. *fit becomes false if an instance is not
 * its object moved exactly, or may move from frame to frame. */
static enum hsr_status place(struct hsr_grove *g, struct hsr_box *box,
                             bool *fit) {
  const struct hsr_scene *scene = g->world->roster.scene;
  struct hsr_box *object = malloc((scene->n_objects + 1) * sizeof *object);
  int *grain = malloc((scene->n_objects + 1) * sizeof *grain);
  *fit = true;
  if (!object || !grain) {
    free(object);
    free(grain);
    return HSR_E_NOMEM;
  }
  for (uint32_t k = 0; k < scene->n_objects; k++) {
    const struct hsr_object *of = &scene->objects[k];
    object[k] = box_of(of);
    grain[k] = hsr_grain(of->xyz, 3 * (size_t)of->n_vertices);
  }
  for (uint32_t i = 0; i < scene->n_instances && *fit; i++) {
    const struct hsr_instance *instance = &scene->instances[i];
    const struct hsr_box *local = &object[instance->object];
    double reach = 0;
    for (int k = 0; k < 3; k++) {
      reach = fmax(reach, fmax(fabs(local->lo[k]), fabs(local->hi[k])));
      box[i].lo[k] = local->lo[k] + instance->m[4 * k + 3];
      box[i].hi[k] = local->hi[k] + instance->m[4 * k + 3];
    }
    *fit = is_moved_only(instance) && !scene->objects[instance->object].moves &&
           hsr_instance_is_exact(instance, grain[instance->object], reach);
  }
  free(object);
  free(grain);
  return HSR_OK;
}

/* Makes the nodes of all instances. *fit becomes false if they cannot be put in
 * order. */
static enum hsr_status order_instances(struct hsr_grove *g, bool *fit) {
  const struct hsr_scene *scene = g->world->roster.scene;
  size_t n = scene->n_instances;
  struct hsr_box *box = malloc((n + 1) * sizeof *box);
  uint32_t *instance = malloc((n + 1) * sizeof *instance);
  struct key *key = malloc((n + 1) * sizeof *key);
  g->node = HSR_NEW(&g->arena, struct hsr_grove_node, 2 * n);
  enum hsr_status status =
      box && instance && key && g->node ? place(g, box, fit) : HSR_E_NOMEM;
  if (!status && *fit) {
    struct ordering ordering = {.grove = g, .box = box, .may_touch = true};
    for (uint32_t k = 0; k < scene->n_objects; k++)
      ordering.may_touch &= looks_outward(&scene->objects[k]);
    for (uint32_t k = 0; k < n; k++)
      instance[k] = k;
    uint32_t root;
    *fit = put_in_order(&ordering, instance, (uint32_t)n, 0, key, &root);
  }
  free(box);
  free(instance);
  free(key);
  return status;
}

/* --- Trees ---------------------------------------------------------------- */

static void note_sizes(struct hsr_grove *g, const struct hsr_bsp *bsp) {
  for (uint32_t k = 0; k < bsp->n_cubes; k++) {
    const struct hsr_bsp_cube *cube = &bsp->cube[k];
    if (cube->n_points > g->most_points)
      g->most_points = cube->n_points;
    if (cube->most_corners > g->most_corners)
      g->most_corners = cube->most_corners;
  }
  if (bsp->most_depth > g->most_depth)
    g->most_depth = bsp->most_depth;
  for (uint32_t f = 0; f < bsp->world->n_faces; f++) {
    uint32_t of_plane = hsr_plane_loop(bsp->world, f).n;
    uint32_t own = hsr_face_size(bsp->world, f);
    own = of_plane > own ? of_plane : own;
    g->most_face = own > g->most_face ? own : g->most_face;
  }
}

/* Objects are not adapted, so their faces must be convex; and they must be
 * flat, so that nothing of them is seen outside of the object's box. */
static enum hsr_status check_faces(const struct hsr_world *world,
                                   const struct hsr_object *object,
                                   struct hsr_error *err) {
  char what[sizeof err->text];
  snprintf(what, sizeof what, "object %.80s", object->name);
  return hsr_check_unadapted(world, what, err);
}

/* The median planes of an object's octree must be moved exactly, too. */
static enum hsr_status check_medians(const struct hsr_grove *g, uint32_t object,
                                     const struct hsr_bsp *bsp,
                                     struct hsr_error *err) {
  const struct hsr_scene *scene = g->world->roster.scene;
  const struct hsr_object *of = &scene->objects[object];
  int grain = hsr_grain(of->xyz, 3 * (size_t)of->n_vertices);
  for (uint32_t k = 0; k < bsp->n_medians; k++) {
    int own = hsr_grain(&bsp->median[k].at, 1);
    grain = own < grain ? own : grain;
  }
  double reach = 8 * hsr_reach(of); /* holds the root cube */
  for (uint32_t i = 0; i < scene->n_instances; i++)
    if (scene->instances[i].object == object &&
        !hsr_instance_is_exact(&scene->instances[i], grain, reach))
      return hsr_fail(err, HSR_E_REFUSED,
                      "object %s has instances too far out for planes that "
                      "divide it to be moved exactly",
                      of->name);
  return HSR_OK;
}

/* Makes the tree of one object. */
static enum hsr_status make_tree(struct hsr_grove *g, uint32_t object,
                                 const struct hsr_bsp_rule *rule,
                                 struct hsr_error *err) {
  struct hsr_grove_tree *tree = &g->tree[object];
  tree->scene = *g->world->roster.scene;
  tree->scene.objects = &g->world->roster.scene->objects[object];
  tree->scene.instances = &tree->instance;
  tree->scene.n_objects = tree->scene.n_instances = 1;
  tree->instance =
      (struct hsr_instance){0, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}};
  g->n_trees = object + 1;
  enum hsr_status status = hsr_world_init(&tree->world, &tree->scene, err);
  if (!status)
    status = check_faces(&tree->world, tree->scene.objects, err);
  if (!status)
    status = hsr_bsp_init(&tree->bsp, &tree->world, rule, err);
  if (!status)
    status = check_medians(g, object, &tree->bsp, err);
  if (!status)
    note_sizes(g, &tree->bsp);
  return status;
}

static void free_trees(struct hsr_grove *g) {
  for (uint32_t k = 0; k < g->n_trees; k++) {
    hsr_bsp_free(&g->tree[k].bsp);
    hsr_world_free(&g->tree[k].world);
  }
  g->n_trees = 0;
}

/* Makes a tree for each object. */
static enum hsr_status make_trees(struct hsr_grove *g,
                                  const struct hsr_bsp_rule *rule,
                                  struct hsr_error *err) {
  const struct hsr_scene *scene = g->world->roster.scene;
  enum hsr_status status = HSR_OK;
  g->tree = HSR_NEW_ZEROED(&g->arena, struct hsr_grove_tree, scene->n_objects);
  if (!g->tree)
    return hsr_fail_nomem(err);
  for (uint32_t k = 0; k < scene->n_objects && !status; k++)
    status = make_tree(g, k, rule, err);
  return status;
}

/* Makes one tree of all faces. */
static enum hsr_status make_whole(struct hsr_grove *g,
                                  const struct hsr_bsp_rule *rule,
                                  struct hsr_error *err) {
  free_trees(g);
  g->is_whole = true;
  enum hsr_status status = hsr_bsp_init(&g->whole, g->world, rule, err);
  if (!status)
    note_sizes(g, &g->whole);
  return status;
}

enum hsr_status hsr_grove_init(struct hsr_grove *g,
                               const struct hsr_world *world,
                               const struct hsr_bsp_rule *rule,
                               struct hsr_error *err) {
  *g = (struct hsr_grove){.world = world};
  bool roster = hsr_is_roster(world);
  bool fit = roster || (!world->pieces && world->roster.scene->n_instances > 1);
  if (fit && order_instances(g, &fit))
    return hsr_fail_nomem(err);
  if (!fit && roster)
    return hsr_fail(err, HSR_E_REFUSED,
                    "its instances cannot be put in order: they are not all "
                    "moved only, and separated by planes across the axes");
  if (!fit)
    return make_whole(g, rule, err);
  enum hsr_status status = make_trees(g, rule, err);
  return status == HSR_E_REFUSED && !roster ? make_whole(g, rule, err) : status;
}

void hsr_grove_free(struct hsr_grove *g) {
  free_trees(g);
  if (g->is_whole)
    hsr_bsp_free(&g->whole);
  hsr_arena_free(&g->arena);
}
