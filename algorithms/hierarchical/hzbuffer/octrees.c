/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ProcessOctreeNode of the thesis: the octrees from front to back. See walk.h.
 *
 * There are two levels of octrees, as in the thesis, 3.5: each object has an
 * octree of its faces, and the scene has one of its instances. */
#include "algorithms/hierarchical/hzbuffer/walk.h"

#include <string.h>

/* --- octree=lazy ---------------------------------------------------------- */

/* Counts that an item of a cube was handed down to an octant. */
static void count_down(struct hsr_hz_walk *w, uint32_t instance, uint32_t item,
                       struct hsr_subject octant) {
  const struct hsr_cubes *cubes = w->frame.cubes;
  if (instance == HSR_NO_ID) {
    HSR_STEP(w->tally, HSR_HZ_INSTANCES_DOWN, HSR_VOLUME(cubes->still[item]),
             octant, HSR_NOWHERE, 0);
    return;
  }
  uint32_t face = w->frame.job->world->roster.first[instance] +
                  w->frame.object->number[item];
  HSR_STEP(w->tally, HSR_HZ_FACES_DOWN, HSR_FACE(face), octant, HSR_NOWHERE, 0);
}

/* Counts the division of node k of an instance's octree; HSR_NO_ID: of the
 * octree of instances. */
static void count_division(struct hsr_hz_walk *w,
                           const struct hsr_octree *octree, uint32_t instance,
                           uint32_t k) {
  HSR_STEP(w->tally, HSR_HZ_CUBES_DIVIDED, hsr_cube_subject(instance, k),
           HSR_NOTHING, HSR_NOWHERE, 0);
  for (int o = 0; HSR_COUNTING && o < 8; o++) {
    uint32_t child = octree->node[k].child[o];
    if (child == HSR_NO_NODE)
      continue;
    const struct hsr_octree_node *node = &octree->node[child];
    for (uint32_t n = 0; n < node->n; n++)
      count_down(w, instance, octree->item[node->first + n],
                 hsr_cube_subject(instance, child));
  }
}

/* A cube that is divided by half leaves the octree unfit for use. */
static void note_failure(struct hsr_hz_walk *w, enum hsr_status status) {
  if (!status)
    return;
  w->out_of_memory = true;
  w->prepared->half_divided = true;
}

/* octree=lazy: divides node k of the current instance's object. Without it
 * nothing is left to divide. */
static void divide_cube(struct hsr_hz_walk *w, uint32_t k) {
  uint32_t i = w->frame.instance,
           object = w->frame.cubes->scene->instances[i].object;
  enum hsr_status status = HSR_OK;
  if (hsr_cubes_divide(&w->prepared->cubes, object, k, &status))
    count_division(w, &w->frame.object->octree, i, k);
  note_failure(w, status);
}

void hsr_hz_divide_instances(struct hsr_hz_walk *w, uint32_t k) {
  enum hsr_status status = HSR_OK;
  if (hsr_cubes_divide_instances(&w->prepared->cubes, k, &status))
    count_division(w, &w->frame.cubes->octree, HSR_NO_ID, k);
  note_failure(w, status);
}

/* --- The octree of an instance -------------------------------------------- */

static bool process_octants(struct hsr_hz_walk *w, uint32_t k, bool inside);

/* With coherence=chc: an inner cube in which something was visible is not
 * tested. */
static bool is_trusted(const struct hsr_hz_walk *w, uint32_t instance,
                       const struct hsr_octree_node *node, uint32_t k) {
  return !hsr_octree_is_leaf(node) && hsr_hz_was_visible(w, instance, k);
}

/* With coherence=chc++: a leaf that was visible is tested in some frames only. */
static bool is_assumed(const struct hsr_hz_walk *w,
                       const struct hsr_octree_node *node, uint32_t k) {
  return w->choice.coherence == HSR_HZ_COHERENCE_CHC_PP &&
         hsr_octree_is_leaf(node) &&
         hsr_hz_was_visible(w, w->frame.instance, k) &&
         hsr_hz_is_assumed(w, w->frame.instance, k);
}

/* ProcessOctreeNode for node k. If `octants` is not NULL, the node is octant o
 * of those that were projected together. With coherence=list, a cube of the
 * last frame's list has been rendered and counts as visible: it is not tested
 * until the list is pruned, at the end of the frame. With coherence=chc, whether
 * something in the node is visible. */
static bool process_node(struct hsr_hz_walk *w, uint32_t k, bool inside,
                         const struct hsr_octants *octants, int o) {
  const struct hsr_octree *octree = &w->frame.object->octree;
  const struct hsr_octree_node *node = &octree->node[k];
  struct hsr_subject subject = hsr_cube_subject(w->frame.instance, k);
  bool rendered = w->rendered.list &&
                  hsr_cube_is_marked(&w->rendered, w->frame.instance, k);
  bool is_listed = rendered && w->choice.coherence == HSR_HZ_COHERENCE_LIST;
  const struct hsr_octree_box volume = hsr_hz_volume(w, node);
  bool visible = is_assumed(w, node, k);
  if (!is_listed &&
      !hsr_hz_is_in_frustum(w, &w->frame.placing, &volume, subject, &inside))
    return false;
  if (!is_listed && !visible && !is_trusted(w, w->frame.instance, node, k)) {
    visible =
        octants ? hsr_hz_octant_passes_pyramid(w, octants, o)
                : hsr_hz_passes_pyramid(w, &w->frame.placing, volume, subject);
    if (!visible && !hsr_hz_was_visible(w, w->frame.instance, k))
      return false;
  }
  HSR_STEP(w->tally, HSR_HZ_CUBES_VISIBLE, subject, HSR_NOTHING, HSR_NOWHERE,
           0);
  const bool by_chc = hsr_hz_is_chc(w);
  if (w->next && !by_chc && !hsr_cube_list_add(w->next, w->frame.instance, k))
    w->out_of_memory = true;
  divide_cube(w, k);
  if (w->out_of_memory)
    return false;
  if (!rendered)
    hsr_hz_tile_cell(w, k);
  if (!hsr_octree_is_leaf(&octree->node[k]))
    visible |= process_octants(w, k, inside);
  if (by_chc && visible)
    hsr_hz_note_visible(w, w->frame.instance, k);
  return visible;
}

/* The octants of node k, from front to back. */
static bool process_octants(struct hsr_hz_walk *w, uint32_t k, bool inside) {
  const struct hsr_octree *octree = &w->frame.object->octree;
  const struct hsr_octree_node *node = &octree->node[k];
  struct hsr_octants octants;
  bool together = hsr_hz_tests_together(w);
  if (together)
    hsr_octants_project(&w->frame, &w->frame.placing, octree, node,
                        w->choice.volumes == HSR_HZ_VOLUMES_TIGHT, &octants);
  int nearest = hsr_cube_nearest(&w->frame.placing, node);
  bool visible = false;
  uint32_t child[8];
  memcpy(child, node->child, sizeof child); /* dividing may move the node */
  for (int n = 0; n < 8; n++) {
    int o = nearest ^ hsr_octant_order[n];
    if (child[o] != HSR_NO_NODE)
      visible |=
          process_node(w, child[o], inside, together ? &octants : NULL, o);
  }
  return visible;
}

void hsr_hz_set_instance(struct hsr_hz_walk *w, uint32_t instance) {
  hsr_cube_instance(&w->frame, instance);
  w->visit++;
  const struct hsr_listed_instance *group =
      w->rendered.list ? hsr_cube_marks_group(&w->rendered, instance) : NULL;
  for (uint32_t k = 0; group && k < group->n; k++) {
    const struct hsr_cubes_object *object = w->frame.object;
    const struct hsr_cell *cell =
        &object->cell[hsr_cube_list_cubes(w->last, group)[k]];
    for (uint32_t f = 0; f < cell->n_faces; f++)
      w->met[object->face[cell->first_face + f]] = w->visit;
  }
}

/* The root is tested against the frustum anew, since the instance may reach out
 * of the cube in which it is met. */
bool hsr_hz_process_instance(struct hsr_hz_walk *w, uint32_t i) {
  if (!hsr_cube_is_new(&w->frame, i))
    return false;
  hsr_hz_set_instance(w, i);
  return process_node(w, 0, false, NULL, 0);
}

/* --- The octree of instances ---------------------------------------------- */

bool hsr_hz_process_instances_of(struct hsr_hz_walk *w, uint32_t k) {
  const struct hsr_cubes *cubes = w->frame.cubes;
  const struct hsr_octree_node *node = &cubes->octree.node[k];
  bool visible = false;
  for (uint32_t n = 0; n < node->n; n++) {
    uint32_t item = cubes->octree.item[node->first + n];
    visible |=
        hsr_hz_process_instance(w, cubes->still ? cubes->still[item] : item);
  }
  return visible;
}

/* A leaf with a single instance is not tested. The root of the instance's own
 * octree is tested instead. */
bool hsr_hz_process_instances(struct hsr_hz_walk *w, uint32_t k, bool inside) {
  const struct hsr_octree *octree = &w->frame.cubes->octree;
  const struct hsr_octree_node *node = &octree->node[k];
  struct hsr_subject subject = hsr_cube_subject(HSR_NO_ID, k);
  if (node->n == 1 && hsr_octree_is_leaf(node))
    return hsr_hz_process_instances_of(w, k);
  const struct hsr_octree_box volume = hsr_hz_volume(w, node);
  bool visible = false;
  if (!hsr_hz_is_in_frustum(w, &w->frame.as_it_is, &volume, subject, &inside))
    return false;
  if (!is_trusted(w, HSR_NO_ID, node, k)) {
    visible = hsr_hz_passes_pyramid(w, &w->frame.as_it_is, volume, subject);
    if (!visible && !hsr_hz_was_visible(w, HSR_NO_ID, k))
      return false;
  }
  HSR_STEP(w->tally, HSR_HZ_CUBES_VISIBLE, subject, HSR_NOTHING, HSR_NOWHERE,
           0);
  hsr_hz_divide_instances(w, k);
  if (w->out_of_memory)
    return false;
  visible |= hsr_hz_process_instances_of(w, k);
  int nearest = hsr_cube_nearest(&w->frame.as_it_is, &octree->node[k]);
  for (int n = 0; n < 8; n++) {
    uint32_t child = octree->node[k].child[nearest ^ hsr_octant_order[n]];
    if (child != HSR_NO_NODE)
      visible |= hsr_hz_process_instances(w, child, inside);
  }
  if (hsr_hz_is_chc(w) && visible)
    hsr_hz_note_visible(w, HSR_NO_ID, k);
  return visible;
}
