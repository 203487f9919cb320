/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The octrees from front to back, and what moves beside them. See walk.h. */
#include "algorithms/hierarchical/hzbuffer/walk.h"

#include <math.h>
#include <string.h>

/* --- The octrees, from front to back -------------------------------------- */

/* Lists a cube of the object at hand as visible. */
static void list_cube(struct hsr_hz_walk *w, uint32_t k) {
  if (!hsr_cube_list_add(w->next, w->frame.instance, k))
    w->out_of_memory = true;
}

/* Divides a cube of the object at hand, if that has been left until now. */
static void divide_cube(struct hsr_hz_walk *w, uint32_t k) {
  struct hsr_hz_prepared *prepared = w->frame.job->prepared;
  const struct hsr_cubes_object *object = w->frame.object;
  uint32_t i = w->frame.instance,
           o = w->frame.cubes->scene->instances[i].object;
  enum hsr_status status = HSR_OK;
  if (!hsr_cubes_divide(&prepared->cubes, o, k, &status))
    return;
  w->out_of_memory |= prepared->half_divided = status;
  HSR_STEP(w->tally, DIVIDED, hsr_cube_subject(i, k), HSR_NOTHING, HSR_NOWHERE,
           0);
  uint32_t first = w->frame.job->world->outline.first[i];
  for (int c = 0; HSR_COUNTING && c < 8; c++) {
    uint32_t child = object->octree.node[k].child[c];
    for (uint32_t n = 0;
         child != HSR_NO_NODE && n < object->octree.node[child].n; n++) {
      uint32_t item = object->octree.item[object->octree.node[child].first + n];
      HSR_STEP(w->tally, FACES_DOWN, HSR_FACE(first + object->number[item]),
               hsr_cube_subject(i, child), HSR_NOWHERE, 0);
    }
  }
}

/* The same of a cube of instances. */
static void divide_instances(struct hsr_hz_walk *w, uint32_t k) {
  struct hsr_hz_prepared *prepared = w->frame.job->prepared;
  const struct hsr_cubes *cubes = &prepared->cubes;
  enum hsr_status status = HSR_OK;
  if (!hsr_cubes_divide_instances(&prepared->cubes, k, &status))
    return;
  w->out_of_memory |= prepared->half_divided = status;
  HSR_STEP(w->tally, DIVIDED, hsr_cube_subject(HSR_NO_ID, k), HSR_NOTHING,
           HSR_NOWHERE, 0);
  for (int c = 0; HSR_COUNTING && c < 8; c++) {
    uint32_t child = cubes->octree.node[k].child[c];
    for (uint32_t n = 0;
         child != HSR_NO_NODE && n < cubes->octree.node[child].n; n++) {
      uint32_t item = cubes->octree.item[cubes->octree.node[child].first + n];
      HSR_STEP(w->tally, STILL_DOWN, HSR_VOLUME(cubes->still[item]),
               hsr_cube_subject(HSR_NO_ID, child), HSR_NOWHERE, 0);
    }
  }
}

static void render_octants(struct hsr_hz_walk *w,
                           const struct hsr_octree_node *node, bool inside);

/* A cube of the object at hand. One on the list of 1993 is not tested before
 * the list is pruned. It may be octant o of those that are projected. */
static void render_cube(struct hsr_hz_walk *w, uint32_t k, bool inside,
                        const struct hsr_octants *octants, int o) {
  const struct hsr_octree *octree = &w->frame.object->octree;
  const struct hsr_octree_node *node = &octree->node[k];
  bool rendered =
      w->last && hsr_cube_is_marked(&w->rendered, w->frame.instance, k);
  struct hsr_subject subject = hsr_cube_subject(w->frame.instance, k);
  if (!(rendered && w->option[COHERENCE] == LIST) &&
      !(octants
            ? hsr_hz_is_octant_visible(w, octants, o, node, subject, &inside)
            : hsr_hz_is_cube_visible(w, &w->frame.placing, node, subject,
                                     &inside)))
    return;
  HSR_STEP(w->tally, CUBES_VISIBLE, subject, HSR_NOTHING, HSR_NOWHERE, 0);
  if (w->next)
    list_cube(w, k);
  divide_cube(w, k);
  if (w->out_of_memory)
    return;
  if (!rendered)
    hsr_hz_tile_cell(w, k);
  node = &octree->node[k]; /* dividing may have moved it */
  if (!hsr_octree_is_leaf(node))
    render_octants(w, node, inside);
}

static void render_octants(struct hsr_hz_walk *w,
                           const struct hsr_octree_node *node, bool inside) {
  const struct hsr_octree *octree = &w->frame.object->octree;
  struct hsr_octants octants;
  bool together = hsr_hz_tests_together(w);
  if (together)
    hsr_octants_project(&w->frame, &w->frame.placing, octree, node,
                        w->option[VOLUMES] == TIGHT, &octants);
  int nearest = hsr_cube_nearest(&w->frame.placing, node);
  uint32_t child[8];
  memcpy(child, node->child, sizeof child); /* dividing may move the node */
  for (int k = 0; k < 8; k++) {
    int o = nearest ^ hsr_octant_order[k];
    if (child[o] != HSR_NO_NODE)
      render_cube(w, child[o], inside, together ? &octants : NULL, o);
  }
}

/* Its faces that have been rendered in this frame count as met. */
void hsr_hz_take_in_hand(struct hsr_hz_walk *w, uint32_t instance) {
  hsr_cube_instance(&w->frame, instance);
  w->visit++;
  const struct hsr_listed_instance *group =
      w->rendered.list ? hsr_cube_marks_group(&w->rendered, instance) : NULL;
  for (uint32_t k = 0; group && k < group->n; k++) {
    const struct hsr_cubes_object *object = w->frame.object;
    const struct hsr_cell *cell =
        &object->cell[hsr_cube_list_cubes(w->last, group)[k]];
    for (uint32_t f = 0; f < cell->n_faces; f++)
      w->tiled[object->face[cell->first_face + f]] = w->visit;
  }
}

/* Once a frame. The instance may reach out of the cube in which it is met. */
static void render_instance(struct hsr_hz_walk *w, uint32_t i) {
  if (!hsr_cube_is_new(&w->frame, i))
    return;
  hsr_hz_take_in_hand(w, i);
  render_cube(w, 0, false, NULL, 0);
}

static void render_mover(struct hsr_hz_walk *w, uint32_t i) {
  HSR_STEP(w->tally, MOVERS_MET, HSR_VOLUME(i), HSR_NOTHING, HSR_NOWHERE, 0);
  render_instance(w, i);
}

/* The movers of a cube. Those that fit into octants are moved there first, if
 * that has not been done yet. */
static bool render_movers(struct hsr_hz_walk *w, uint32_t node,
                          const struct hsr_octree_node *cube) {
  if (!hsr_movers_divide(&w->movers, node, cube)) {
    w->out_of_memory = true;
    return false;
  }
  for (uint32_t k = hsr_mover_node(&w->movers, node)->first; k != HSR_NO_MOVER;
       k = w->movers.mover[k].next)
    render_mover(w, w->movers.mover[k].instance);
  return true;
}

/* Whether the octree of what moves is kept from frame to frame. */
static bool keeps_movers(const struct hsr_hz_walk *w) {
  long how = w->option[MOVERS];
  return how == KEPT || how == BY_SPEED || how == BY_VOLUME;
}

/* A cube of instances, both octrees at once: node `still` of those that do not
 * move, node `moving` of those that do, or HSR_NO_NODE. */
static void render_instances(struct hsr_hz_walk *w,
                             const struct hsr_octree_node *cube, uint32_t still,
                             uint32_t moving, bool inside) {
  const struct hsr_octree *octree = &w->frame.cubes->octree;
  const struct hsr_octree_node *node =
      still != HSR_NO_NODE ? &octree->node[still] : NULL;
  bool single =
      moving == HSR_NO_NODE && node && node->n == 1 && hsr_octree_is_leaf(node);
  if (!single) {
    struct hsr_subject subject =
        node ? hsr_cube_subject(HSR_NO_ID, still) : HSR_MOVERS_CUBE(moving);
    if (!hsr_hz_is_cube_visible(w, &w->frame.as_it_is,
                                moving == HSR_NO_NODE ? node : cube, subject,
                                &inside))
      return;
    HSR_STEP(w->tally, CUBES_VISIBLE, subject, HSR_NOTHING, HSR_NOWHERE, 0);
  }
  if (node && !single) {
    divide_instances(w, still);
    if (w->out_of_memory)
      return;
    node = &octree->node[still]; /* dividing may have moved it */
  }
  const uint32_t *name = w->frame.cubes->still;
  for (uint32_t i = 0; node && i < node->n; i++) {
    uint32_t item = octree->item[node->first + i];
    render_instance(w, name ? name[item] : item);
  }
  if (moving != HSR_NO_NODE && !render_movers(w, moving, cube))
    return;
  int nearest = hsr_cube_nearest(&w->frame.as_it_is, cube);
  for (int k = 0; k < 8; k++) {
    int o = nearest ^ hsr_octant_order[k];
    uint32_t child = node ? node->child[o] : HSR_NO_NODE;
    uint32_t mover = moving != HSR_NO_NODE
                         ? hsr_mover_node(&w->movers, moving)->child[o]
                         : HSR_NO_NODE;
    if (mover != HSR_NO_NODE && keeps_movers(w) &&
        hsr_mover_is_empty(&w->movers, mover))
      mover = HSR_NO_NODE;
    if (child == HSR_NO_NODE && mover == HSR_NO_NODE)
      continue;
    struct hsr_octree_node octant = hsr_octree_octant(cube, o);
    render_instances(w, &octant, child, mover, inside);
  }
}

/* The movers' octree of the last frame, brought up to date; *w borrows it. */
static enum hsr_status keep_movers(struct hsr_hz_walk *w) {
  static const enum hsr_mover_knowledge knowledge[] = {
      [BY_SPEED] = HSR_MOVERS_KNOW_SPEED, [BY_VOLUME] = HSR_MOVERS_KNOW_VOLUME};
  struct hsr_hz_prepared *prepared = w->frame.job->prepared;
  prepared->movers.knowledge = knowledge[w->option[MOVERS]];
  prepared->movers.every = w->option[INTERVAL];
  enum hsr_status status =
      hsr_movers_update(&prepared->movers, w->frame.cubes, w->tally, MOVED,
                        LOOKED, &prepared->movers_arena);
  if (status) {
    hsr_arena_free(&prepared->movers_arena);
    prepared->movers = (struct hsr_movers){.n = 0};
  }
  w->movers = prepared->movers;
  return status;
}

/* --- Clusters in space-time ----------------------------------------------- */

/* What rounding may take off is added. */
static struct hsr_octree_box by_its_middle(const struct hsr_box *box) {
  struct hsr_octree_box made;
  for (int a = 0; a < 3; a++) {
    made.centre[a] = 0.5 * (box->lo[a] + box->hi[a]);
    made.half[a] = 0.5 * (box->hi[a] - box->lo[a]) +
                   0x1p-50 * (fabs(box->lo[a]) + fabs(box->hi[a]));
  }
  return made;
}

/* A box outside of the root's cube, where too little is known of rounding on
 * the screen, counts as visible. */
static void render_cluster(struct hsr_hz_walk *w, uint32_t k) {
  struct hsr_space_time *clusters =
      &((struct hsr_hz_prepared *)w->frame.job->prepared)->clusters;
  const struct hsr_cluster *c = hsr_cluster_at(clusters, k);
  struct hsr_box root = hsr_cube_box(&w->frame.cubes->octree.node[0]);
  bool inside = false;
  uint32_t part[2];
  if (!c->n ||
      (hsr_box_holds(&root, &c->box) &&
       !hsr_hz_is_box_visible(w, &w->frame.as_it_is, by_its_middle(&c->box),
                              HSR_MOVERS_CUBE(k), &inside)))
    return;
  if (c->n == 1) {
    render_mover(w, hsr_member_at(clusters, c->first)->instance);
    return;
  }
  int n = hsr_space_time_divide(clusters, k, part);
  w->out_of_memory |= !n;
  for (int p = 0; p < n; p++)
    render_cluster(w, part[p]);
}

static enum hsr_status render_clusters(struct hsr_hz_walk *w) {
  struct hsr_hz_prepared *prepared = w->frame.job->prepared;
  struct hsr_space_time *clusters = &prepared->clusters;
  const struct hsr_space_time_count count = {.tally = w->tally,
                                             .bounded = BOUNDED,
                                             .in_space = SPLITS,
                                             .in_time = IN_TIME,
                                             .moved = MOVED};
  if (hsr_space_time_begin(clusters, w->frame.cubes, w->option[INTERVAL],
                           &count, &prepared->movers_arena))
    w->out_of_memory = true;
  else
    render_cluster(w, 0);
  for (uint32_t k = 0; k < clusters->n_loose && !w->out_of_memory; k++)
    render_mover(w, clusters->loose[k]);
  if (w->out_of_memory) {
    hsr_arena_free(&prepared->movers_arena);
    *clusters = (struct hsr_space_time){.n_loose = 0};
    return HSR_E_NOMEM;
  }
  return HSR_OK;
}

/* --- All octrees ---------------------------------------------------------- */

/* What moves is in w->movers, but for clusters. */
static enum hsr_status make_movers(struct hsr_hz_walk *w,
                                   const struct hsr_octree_node *root) {
  long how = w->option[MOVERS];
  w->movers = (struct hsr_movers){.outside = HSR_NO_MOVER};
  if (how == SPACE_TIME)
    return HSR_OK;
  if (keeps_movers(w))
    return keep_movers(w);
  if (hsr_movers_init(&w->movers, w->frame.cubes, w->tally, MOVED, SPLITS,
                      w->frame.job->scratch) ||
      (how == FRESH && !hsr_movers_divide_all(&w->movers, 0, root)))
    return HSR_E_NOMEM;
  return HSR_OK;
}

/* The octrees from front to back; what moves is among them, or behind them, as
 * the option says. */
enum hsr_status hsr_hz_render_octrees(struct hsr_hz_walk *w) {
  struct hsr_octree_node root = w->frame.cubes->octree.node[0];
  struct hsr_movers *movers = &w->movers;
  long how = w->option[MOVERS];
  root.tight = hsr_octree_cube(&root); /* what moves may be all over it */
  if (make_movers(w, &root))
    return HSR_E_NOMEM;
  bool together = movers->n && how != BEHIND;
  render_instances(w, &root, 0, together ? 0 : HSR_NO_NODE, false);
  if (how == SPACE_TIME && render_clusters(w))
    return HSR_E_NOMEM;
  for (uint32_t k = 0; k < movers->n && how == BEHIND; k++)
    render_mover(w, movers->mover[k].instance);
  for (uint32_t k = movers->outside; k != HSR_NO_MOVER;
       k = movers->mover[k].next)
    render_mover(w, movers->mover[k].instance);
  return HSR_OK;
}

/* Without cubes: cell after cell, as they come. */
void hsr_hz_render_all(struct hsr_hz_walk *w) {
  for (uint32_t i = 0; i < w->frame.cubes->scene->n_instances; i++) {
    hsr_hz_take_in_hand(w, i);
    for (uint32_t k = 0; k < w->frame.object->octree.n_nodes; k++)
      hsr_hz_tile_cell(w, k);
  }
}
