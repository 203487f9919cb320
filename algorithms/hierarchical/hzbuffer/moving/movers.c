/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/hierarchical/hzbuffer/moving/movers.h"
#include "common/scene/motion.h"

#include <math.h>
#include <string.h>

static bool new_node(struct hsr_movers *m, uint32_t *made) {
  if (!hsr_arena_grow(m->arena, &m->node, sizeof(struct hsr_mover_node)))
    return false;
  *made = (uint32_t)m->node.n - 1;
  struct hsr_mover_node *node = hsr_mover_node(m, *made);
  memset(node->child, 0xff, sizeof node->child);
  node->first = HSR_NO_MOVER;
  node->divided = false;
  return true;
}

/* Puts mover k at the head of a list. */
static void put(struct hsr_movers *m, uint32_t *first, uint32_t k) {
  m->mover[k].next = *first;
  *first = k;
}

enum hsr_status hsr_movers_init(struct hsr_movers *m,
                                const struct hsr_cubes *cubes,
                                struct hsr_tally *tally,
                                struct hsr_arena *arena) {
  uint32_t root;
  struct hsr_box box = hsr_cube_box(&cubes->octree.node[0]);
  *m = (struct hsr_movers){
      .mover = HSR_NEW(arena, struct hsr_mover, cubes->n_movers),
      .n = cubes->n_movers,
      .outside = HSR_NO_MOVER,
      .tally = tally,
      .arena = arena};
  if (!m->mover || !new_node(m, &root))
    return HSR_E_NOMEM;
  for (uint32_t k = 0; k < m->n; k++) {
    uint32_t i = cubes->mover[k];
    m->mover[k].instance = i;
    m->mover[k].bounds = hsr_cubes_bounds(cubes, i);
    put(m,
        hsr_box_holds(&box, &m->mover[k].bounds) ? &hsr_mover_node(m, 0)->first
                                                 : &m->outside,
        k);
  }
  return HSR_OK;
}

/* Only an octree that is kept may have empty octants. */
uint32_t hsr_mover_octant(const struct hsr_movers *m, uint32_t node, int o) {
  uint32_t child = hsr_mover_node(m, node)->child[o];
  return m->is_kept && child != HSR_NO_NODE &&
                 !hsr_mover_node(m, child)->n_below
             ? HSR_NO_NODE
             : child;
}

bool hsr_movers_divide(struct hsr_movers *m, uint32_t node,
                       const struct hsr_octree_node *cube) {
  if (hsr_mover_node(m, node)->divided)
    return true;
  uint32_t k = hsr_mover_node(m, node)->first;
  bool single = k == HSR_NO_MOVER || m->mover[k].next == HSR_NO_MOVER;
  hsr_mover_node(m, node)->divided = true;
  if (single)
    return true;
  HSR_STEP(m->tally, HSR_MOVERS_SPLITS, HSR_MOVERS_CUBE(node), HSR_NOTHING,
           HSR_NOWHERE, 0);
  hsr_mover_node(m, node)->first = HSR_NO_MOVER;
  for (uint32_t next; k != HSR_NO_MOVER; k = next) {
    next = m->mover[k].next;
    int o = hsr_octant_that_holds(cube, &m->mover[k].bounds);
    if (o < 0) {
      put(m, &hsr_mover_node(m, node)->first, k);
      continue;
    }
    uint32_t child = hsr_mover_node(m, node)->child[o];
    if (child == HSR_NO_NODE && !new_node(m, &child))
      return false;
    hsr_mover_node(m, node)->child[o] = child;
    put(m, &hsr_mover_node(m, child)->first, k);
    HSR_STEP(m->tally, HSR_MOVERS_DOWN, HSR_VOLUME(m->mover[k].instance),
             HSR_MOVERS_CUBE(child), HSR_NOWHERE, 0);
  }
  return true;
}

bool hsr_movers_divide_all(struct hsr_movers *m, uint32_t node,
                           const struct hsr_octree_node *cube) {
  if (!hsr_movers_divide(m, node, cube))
    return false;
  for (int o = 0; o < 8; o++) {
    uint32_t child = hsr_mover_node(m, node)->child[o];
    struct hsr_octree_node octant = hsr_octree_octant(cube, o);
    if (child != HSR_NO_NODE && !hsr_movers_divide_all(m, child, &octant))
      return false;
  }
  return true;
}

/* --- An octree that is kept ----------------------------------------------- */

enum { DEEPEST = 16 };

static bool new_octant(struct hsr_movers *m, uint32_t parent, int octant,
                       uint32_t *made) {
  if (!new_node(m, made))
    return false;
  struct hsr_mover_node *node = hsr_mover_node(m, *made);
  node->divided = true;
  node->parent = parent;
  node->n_below = 0;
  node->cube = hsr_octree_octant(&hsr_mover_node(m, parent)->cube, octant);
  hsr_mover_node(m, parent)->child[octant] = *made;
  return true;
}

static uint32_t *list_of(struct hsr_movers *m, uint32_t node) {
  return node == HSR_NO_NODE ? &m->outside : &hsr_mover_node(m, node)->first;
}

static void take_out(struct hsr_movers *m, uint32_t k) {
  uint32_t *link = list_of(m, m->mover[k].node);
  while (*link != k)
    link = &m->mover[*link].next;
  *link = m->mover[k].next;
}

/* Goes up from a node to the first whose cube holds the bounds; HSR_NO_NODE:
 * not even the root's does. The nodes that are left have one mover less
 * below. */
static uint32_t go_up(struct hsr_movers *m, uint32_t from,
                      const struct hsr_box *bounds) {
  while (from != HSR_NO_NODE) {
    struct hsr_mover_node *node = hsr_mover_node(m, from);
    struct hsr_box cube = hsr_cube_box(&node->cube);
    if (hsr_box_holds(&cube, bounds))
      return from;
    node->n_below--;
    from = node->parent;
  }
  return HSR_NO_NODE;
}

/* Goes down from *at to the smallest octant that holds the bounds of mover k,
 * and makes octants on the way. False: out of memory. */
static bool go_down(struct hsr_movers *m, uint32_t k, uint32_t *at) {
  for (int depth = 0; depth < DEEPEST; depth++) {
    struct hsr_mover_node *node = hsr_mover_node(m, *at);
    int o = hsr_octant_that_holds(&node->cube, &m->mover[k].bounds);
    if (o < 0)
      return true;
    uint32_t child = node->child[o];
    if (child == HSR_NO_NODE && !new_octant(m, *at, o, &child))
      return false;
    hsr_mover_node(m, child)->n_below++;
    *at = child;
    HSR_STEP(m->tally, HSR_MOVERS_DOWN, HSR_VOLUME(m->mover[k].instance),
             HSR_MOVERS_CUBE(child), HSR_NOWHERE, 0);
  }
  return true;
}

/* Whether enough is known of an instance not to look at it in every frame. */
static bool is_known(const struct hsr_movers *m, const struct hsr_scene *scene,
                     uint32_t i) {
  struct hsr_motion motion = hsr_scene_motion(scene, i);
  bool held = true;
  for (int a = 0; a < 3; a++)
    held &= isfinite(motion.lo[a]) && isfinite(motion.hi[a]);
  return m->knowledge == HSR_MOVERS_KNOW_SPEED    ? isfinite(motion.speed)
         : m->knowledge == HSR_MOVERS_KNOW_VOLUME ? held
                                                  : false;
}

/* Lists all movers, as outside of the root's cube for now. Those of which
 * enough is known come first. */
static void list_movers(struct hsr_movers *m, const struct hsr_cubes *cubes) {
  uint32_t k = 0;
  for (int known = 1; known >= 0; known--) {
    for (uint32_t j = 0; j < m->n; j++)
      if (is_known(m, cubes->scene, cubes->mover[j]) == known) {
        m->mover[k].instance = cubes->mover[j];
        m->mover[k].node = HSR_NO_NODE;
        put(m, &m->outside, k++);
      }
    m->n_known = known ? k : m->n_known;
  }
}

static enum hsr_status begin_kept(struct hsr_movers *m,
                                  const struct hsr_cubes *cubes) {
  uint32_t root;
  m->mover = HSR_NEW(m->arena, struct hsr_mover, cubes->n_movers);
  m->n = cubes->n_movers;
  m->is_kept = true;
  m->outside = HSR_NO_MOVER;
  if (!m->mover || !new_node(m, &root))
    return HSR_E_NOMEM;
  struct hsr_mover_node *node = hsr_mover_node(m, root);
  node->divided = true;
  node->parent = HSR_NO_NODE;
  node->n_below = 0;
  node->cube = cubes->octree.node[0];
  list_movers(m, cubes);
  return HSR_OK;
}

/* A box that holds mover k until it is looked at again, enlarged by what
 * rounding may take off. */
static struct hsr_box volume_of(const struct hsr_movers *m,
                                const struct hsr_cubes *cubes, uint32_t k) {
  uint32_t i = m->mover[k].instance;
  struct hsr_motion motion = hsr_scene_motion(cubes->scene, i);
  struct hsr_box box = hsr_cubes_bounds(cubes, i);
  if (k >= m->n_known)
    return box;
  double most = motion.speed * (double)(m->every - 1);
  for (int a = 0; a < 3; a++)
    if (m->knowledge == HSR_MOVERS_KNOW_VOLUME) {
      box.lo[a] = motion.lo[a];
      box.hi[a] = motion.hi[a];
    } else {
      box.lo[a] -= most + 0x1p-50 * (most + fabs(box.lo[a]));
      box.hi[a] += most + 0x1p-50 * (most + fabs(box.hi[a]));
    }
  return box;
}

/* Looks at mover k, and puts it into another cube if its own does not hold its
 * bounds any more. A mover outside moves in as soon as the root's cube holds
 * it. False: out of memory. */
static bool put_again(struct hsr_movers *m, const struct hsr_cubes *cubes,
                      uint32_t k) {
  struct hsr_box root = hsr_cube_box(&hsr_mover_node(m, 0)->cube);
  struct hsr_mover *mover = &m->mover[k];
  uint32_t was = mover->node;
  mover->bounds = volume_of(m, cubes, k);
  uint32_t at = go_up(m, was, &mover->bounds);
  bool stays = at == was &&
               (was != HSR_NO_NODE || !hsr_box_holds(&root, &mover->bounds));
  HSR_STEP(m->tally, HSR_MOVERS_LOOKED_AT, HSR_VOLUME(mover->instance),
           was == HSR_NO_NODE ? HSR_NOTHING : HSR_MOVERS_CUBE(was), HSR_NOWHERE,
           stays);
  if (stays)
    return true;
  take_out(m, k);
  if (at == HSR_NO_NODE && hsr_box_holds(&root, &mover->bounds)) {
    at = 0;
    hsr_mover_node(m, 0)->n_below++;
  }
  if (at != HSR_NO_NODE && !go_down(m, k, &at))
    return false;
  mover->node = at;
  put(m, list_of(m, at), k);
  return true;
}

/* put_again for movers first, first + step and so on, below `end`. */
static bool put_some(struct hsr_movers *m, const struct hsr_cubes *cubes,
                     uint32_t first, uint32_t end, uint32_t step) {
  bool good = true;
  for (uint64_t k = first; k < end && good; k += step)
    good = put_again(m, cubes, (uint32_t)k);
  return good;
}

/* Looks at the movers of which enough is known, if it is their turn. If their
 * speed is known, the movers k with k = frame modulo ->every have their turn,
 * so each has one in ->every frames; the turns of frames that were left out are
 * made up for. In the first frame all have their turn; by speed also if ->every
 * frames or more were left out, or if time goes back. */
static bool put_known(struct hsr_movers *m, const struct hsr_cubes *cubes,
                      bool begins) {
  long frame = hsr_scene_frame(cubes->scene), last = m->frame;
  bool speed = m->knowledge == HSR_MOVERS_KNOW_SPEED;
  bool good = true;
  m->frame = frame;
  if (begins || (speed && (frame < last || frame - last >= m->every)))
    return put_some(m, cubes, 0, m->n_known, 1);
  for (long f = last + 1; speed && f <= frame && good; f++) {
    long part = (f % m->every + m->every) % m->every;
    good = put_some(m, cubes, (uint32_t)part, m->n_known, (uint32_t)m->every);
  }
  return good;
}

enum hsr_status hsr_movers_update(struct hsr_movers *m,
                                  const struct hsr_cubes *cubes,
                                  struct hsr_tally *tally,
                                  struct hsr_arena *arena) {
  bool begins = !m->mover;
  m->tally = tally;
  m->arena = arena;
  if (begins && begin_kept(m, cubes))
    return HSR_E_NOMEM;
  return put_known(m, cubes, begins) && put_some(m, cubes, m->n_known, m->n, 1)
             ? HSR_OK
             : HSR_E_NOMEM;
}
