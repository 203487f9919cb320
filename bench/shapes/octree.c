/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/shapes/shapes.h"

#include "algorithms/engines/cubes/cubes.h"

#include <stdlib.h>
#include <string.h>

/* --- What a run does to cubes --------------------------------------------- */

/* The states of the cubes of all octrees, one after the other: that of the
 * instances first, then those of each instance's faces. */
struct states {
  const struct hsr_algorithm *algorithm;
  const struct hsr_cubes *cubes;
  size_t *first; /* an instance: where the states of its cubes begin */
  size_t n;
  unsigned char *state;
};

/* What an event says about its cube, by the key of its counter. */
static enum cube_state state_of(const struct hsr_counter *counter) {
  return hsr_has_key(counter, "cube-visited")  ? CUBE_VISITED
         : hsr_has_key(counter, "cube-out")    ? CUBE_OUT
         : hsr_has_key(counter, "cube-culled") ? CUBE_HIDDEN
                                               : CUBE_NOT_REACHED;
}

static void hear(void *context, const struct hsr_event *event) {
  const struct states *s = context;
  enum cube_state state = state_of(&s->algorithm->counters[event->counter]);
  if (event->a.kind != HSR_OF_CELL || !state)
    return;
  const uint32_t node = event->a.id[0], instance = event->a.id[1];
  size_t k = node + (instance == HSR_NO_ID ? 0 : s->first[instance]);
  if (k < s->n && s->state[k] < state)
    s->state[k] = (unsigned char)state;
}

static void ignore(void *context, const struct hsr_event *event) {
  (void)context, (void)event;
}

static enum hsr_status states_init(struct states *s,
                                   const struct shape_source *source,
                                   const struct hsr_cubes *cubes,
                                   struct hsr_error *err) {
  const struct hsr_scene *scene = cubes->scene;
  *s = (struct states){.algorithm = source->setup->algorithm, .cubes = cubes};
  s->n = cubes->octree.n_nodes;
  s->first = malloc((scene->n_instances + 1) * sizeof *s->first);
  if (!s->first)
    return hsr_fail_nomem(err);
  for (uint32_t i = 0; i < scene->n_instances; i++) {
    s->first[i] = s->n;
    s->n += cubes->object[scene->instances[i].object].octree.n_nodes;
  }
  if (s->n > MOST_SHAPE_CELLS)
    return hsr_fail(err, HSR_E_NOMEM, "%zu cubes are more than %d", s->n,
                    (int)MOST_SHAPE_CELLS);
  s->state = calloc(s->n + 1, 1);
  return s->state ? HSR_OK : hsr_fail_nomem(err);
}

static void states_free(struct states *s) {
  free(s->first);
  free(s->state);
}

/* --- The cubes ------------------------------------------------------------ */

enum { INSTANCE, NODE, LEVEL, ITEMS, STATE };

static void list_node(struct cell_list *list, const double m[12],
                      const struct hsr_octree_node *node,
                      const uint32_t value[5]) {
  double corner[8][3];
  for (int k = 0; k < 8; k++) {
    for (int c = 0; c < 3; c++)
      corner[k][c] = node->centre[c] + (k >> c & 1 ? 1 : -1) * node->half;
    hsr_instance_vertex(m, corner[k], corner[k]);
  }
  for (int n = cell_list_box(list, corner); n > 0; n--)
    for (int k = 0; k < 5; k++)
      cell_list_value(list, k, value[k]);
}

static enum hsr_status list_octree(struct cell_list *list,
                                   const struct hsr_octree *octree,
                                   const double m[12], uint32_t instance,
                                   const unsigned char *state,
                                   struct hsr_error *err) {
  uint32_t *level = calloc(octree->n_nodes + 1, sizeof *level);
  if (!level)
    return hsr_fail_nomem(err);
  for (uint32_t k = 0; k < octree->n_nodes; k++) {
    const struct hsr_octree_node *node = &octree->node[k];
    for (int c = 0; c < 8; c++)
      if (node->child[c] != HSR_NO_NODE)
        level[node->child[c]] = level[k] + 1;
    const uint32_t value[5] = {instance, k, level[k], node->n, state[k]};
    list_node(list, m, node, value);
  }
  free(level);
  return HSR_OK;
}

/* --- All of them ----------------------------------------------------------- */

enum hsr_status shape_octree(const struct shape_source *source,
                             struct cell_list *list, struct hsr_error *err) {
  static const double here[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  static const char *const names[] = {"instance", "node", "level", "items",
                                      "state"};
  const struct hsr_cubes *cubes = hsr_setup_show(source->setup).cubes;
  struct states states = {.first = NULL};
  struct hsr_tally tally = {.out_of_memory = false};
  struct hsr_answer answer = {.body = NULL};
  if (!cubes)
    return hsr_fail(err, HSR_E_USAGE,
                    "%s has no octree of cubes: -a hzbuffer has",
                    source->setup->algorithm->name);
  for (int k = 0; k < 5; k++)
    cell_list_data(list, names[k], HSR_CELL_NUMBERS);
  /* A lazy octree is divided while a frame is drawn. So the first frame divides
   * it, and the second is heard. */
  enum hsr_status status = hear_run(source, &answer, &tally, ignore, NULL, err);
  hsr_answer_free(&answer);
  if (!status)
    status = states_init(&states, source, cubes, err);
  if (!status)
    status = hear_run(source, &answer, &tally, hear, &states, err);
  if (!status)
    status =
        list_octree(list, &cubes->octree, here, HSR_NO_ID, states.state, err);
  for (uint32_t i = 0; !status && i < cubes->scene->n_instances; i++) {
    const struct hsr_instance *instance = &cubes->scene->instances[i];
    status = list_octree(list, &cubes->object[instance->object].octree,
                         instance->m, i, states.state + states.first[i], err);
  }
  hsr_answer_free(&answer);
  states_free(&states);
  return status;
}
