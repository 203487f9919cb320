/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Temporal coherence: what was visible in the last frame. See walk.h. There are
 * four forms; two of them render the cubes that were visible first:
 *
 *   list     1993: these cubes are not tested in the frame. At its end all
 *            cubes found visible are tested by the finished pyramid, and those
 *            that it hides leave the list
 *   passes   the thesis, 3.3.3: the first pass renders these cubes; the second
 *            is the usual traversal, which tests all cubes and renders those
 *            that the first has not. The thesis marks a visible cube with the
 *            number of the frame; here a list takes the place of the marks
 *   chc      J. Bittner, M. Wimmer, H. Piringer and W. Purgathofer, "Coherent
 *            Hierarchical Culling: Hardware Occlusion Queries Made Useful",
 *            Computer Graphics Forum 23(3), 2004, 615-624. An inner cube in
 *            which something was visible is not tested, but traversed. A leaf
 *            that was visible is rendered. It is tested too, but for the next
 *            frame only. All other cubes are tested as usual.
 *            A cube counts as visible if a leaf in it does, or if it was tested
 *            and is. Departures: a test has its answer at once, so no queue is
 *            needed; inner cubes may have faces of their own, which are
 *            rendered when the cube is traversed; the cubes that
 *            hzbuffer_moving.c traverses itself are always tested
 *   chc++    O. Mattausch, J. Bittner and M. Wimmer, "CHC++: Coherent Hierarchical
 *            Culling Revisited", Computer Graphics Forum 27(2), 2008, 221-230. As
 *            chc, but a leaf that was visible is assumed to be visible, and
 *            tested once in `assumed` frames. In which of these is random, so
 *            that tests are spread over frames. Departures: the random number is
 *            a hash of the cube's; a test of several hidden cubes at once
 *            (multiqueries) is not built, since it reads the entries of each
 *            here; their tight volumes are volumes=tight */
#include "algorithms/hierarchical/hzbuffer/walk.h"

enum hsr_status hsr_hz_render_last(struct hsr_hz_walk *w) {
  const struct hsr_window *window = &w->frame.job->view->window;
  w->plain = true;
  for (size_t g = 0; g < w->last->group.n; g++) {
    const struct hsr_listed_instance *group = hsr_cube_list_group(w->last, g);
    const uint32_t *cube = hsr_cube_list_cubes(w->last, group);
    hsr_hz_set_instance(w, group->instance);
    for (uint32_t k = 0; k < group->n; k++) {
      HSR_STEP(w->tally, HSR_HZ_CUBES_AGAIN,
               hsr_cube_subject(group->instance, cube[k]), HSR_NOTHING,
               HSR_NOWHERE, 0);
      hsr_hz_tile_cell(w, cube[k]);
    }
  }
  w->plain = false;
  if (hsr_hz_has_pyramid(w))
    w->stale =
        (struct hsr_bounds){window->x0, window->y0, window->x1, window->y1};
  hsr_hz_refresh(w);
  return hsr_cube_marks_init(&w->rendered, w->last, w->frame.cubes,
                             w->frame.job->scratch);
}

/* 1993: of the cubes found visible in this frame, those that the finished
 * pyramid does not hide are the list for the next one. It is made in the place
 * of the last frame's list, which is not needed any more. */
static void prune(struct hsr_hz_walk *w) {
  struct hsr_cube_list *kept = w->last;
  const struct hsr_cube_list *all = w->next;
  w->rendered.list = NULL; /* its list is cleared next */
  hsr_cube_list_clear(kept);
  for (size_t g = 0; g < all->group.n; g++) {
    const struct hsr_listed_instance *group = hsr_cube_list_group(all, g);
    const uint32_t *cube = hsr_cube_list_cubes(all, group);
    hsr_hz_set_instance(w, group->instance);
    for (uint32_t k = 0; k < group->n; k++) {
      const struct hsr_octree_node *node =
          &w->frame.object->octree.node[cube[k]];
      bool inside = false;
      if (hsr_hz_is_cube_visible(w, &w->frame.placing, hsr_hz_volume(w, node),
                                 hsr_cube_subject(group->instance, cube[k]),
                                 &inside) &&
          !hsr_cube_list_add(kept, group->instance, cube[k]))
        w->out_of_memory = true;
    }
  }
}

/* --- coherence=chc and chc++ -------------------------------------------------------- */

enum hsr_status hsr_hz_begin_chc(struct hsr_hz_walk *w) {
  return hsr_cube_marks_init(&w->before, w->last, w->frame.cubes,
                             w->frame.job->scratch);
}

/* Steele and Vigna's mixing (OOPSLA 2014), of two numbers. */
static uint64_t mix(uint32_t a, uint32_t b) {
  uint64_t z = (uint64_t)a << 32 | b;
  z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
  z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
  return z ^ z >> 31;
}

bool hsr_hz_is_assumed(const struct hsr_hz_walk *w, uint32_t instance,
                       uint32_t k) {
  uint64_t turn = mix(instance, k) + w->prepared->frame;
  return turn % (uint64_t)w->choice.assumed != 0;
}

/* The octree of instances is traversed between those of the instances, and the
 * cubes of one octree are to be listed together. So its cubes wait. */
void hsr_hz_note_visible(struct hsr_hz_walk *w, uint32_t instance, uint32_t k) {
  if (instance != HSR_NO_ID) {
    if (!hsr_cube_list_add(w->next, instance, k))
      w->out_of_memory = true;
    return;
  }
  if (!hsr_arena_grow(w->frame.job->scratch, &w->instance_cubes, sizeof k)) {
    w->out_of_memory = true;
    return;
  }
  ((uint32_t *)w->instance_cubes.items)[w->instance_cubes.n - 1] = k;
}

static void list_instance_cubes(struct hsr_hz_walk *w) {
  const uint32_t *cube = w->instance_cubes.items;
  for (size_t k = 0; k < w->instance_cubes.n; k++)
    if (!hsr_cube_list_add(w->next, HSR_NO_ID, cube[k]))
      w->out_of_memory = true;
}

/* --- The end of a frame --------------------------------------------------- */

void hsr_hz_end_coherence(struct hsr_hz_walk *w) {
  struct hsr_hz_prepared *p = w->prepared;
  p->frame++;
  list_instance_cubes(w);
  if (w->choice.coherence == HSR_HZ_COHERENCE_LIST)
    prune(w);
  else
    p->last ^= 1;
  if (w->out_of_memory)
    hsr_cube_list_clear(&p->list[p->last]);
}
