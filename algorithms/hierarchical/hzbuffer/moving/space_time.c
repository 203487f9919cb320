/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/hierarchical/hzbuffer/moving/space_time.h"
#include "algorithms/hierarchical/hzbuffer/moving/movers.h"
#include "common/scene/motion.h"

#include <math.h>
#include <string.h>

static double side(const struct hsr_box *box, int axis) {
  return box->hi[axis] - box->lo[axis];
}

static int longest_axis(const struct hsr_box *box) {
  int axis = side(box, 1) > side(box, 0);
  return side(box, 2) > side(box, axis) ? 2 : axis;
}

static double middle(const struct hsr_box *box, int axis) {
  return 0.5 * (box->lo[axis] + box->hi[axis]);
}

/* An empty cluster. */
static bool new_cluster(struct hsr_space_time *t, long from, long to,
                        uint32_t *made) {
  if (!hsr_arena_grow(t->arena, &t->cluster, sizeof(struct hsr_cluster)))
    return false;
  *made = (uint32_t)t->cluster.n - 1;
  *hsr_cluster_at(t, *made) =
      (struct hsr_cluster){.first = (uint32_t)t->member.n,
                           .from = from,
                           .to = to,
                           .box = {{INFINITY, INFINITY, INFINITY},
                                   {-INFINITY, -INFINITY, -INFINITY}},
                           .child = {HSR_NO_NODE, HSR_NO_NODE}};
  return true;
}

/* Adds a member to the newest cluster. */
static bool add_member(struct hsr_space_time *t, const struct hsr_member *m) {
  struct hsr_member copy = *m;
  if (!hsr_arena_grow(t->arena, &t->member, sizeof copy))
    return false;
  ((struct hsr_member *)t->member.items)[t->member.n - 1] = copy;
  struct hsr_cluster *c = hsr_cluster_at(t, (uint32_t)t->cluster.n - 1);
  c->n++;
  c->longest += side(&copy.box, longest_axis(&copy.box));
  for (int a = 0; a < 3; a++) {
    c->box.lo[a] = fmin(c->box.lo[a], copy.box.lo[a]);
    c->box.hi[a] = fmax(c->box.hi[a], copy.box.hi[a]);
  }
  return true;
}

/* Bounds an instance in the interval of the newest cluster, and adds it to
 * that. *known becomes false if its way is not known. False: out of memory. */
static bool bound(struct hsr_space_time *t, uint32_t instance, bool *known) {
  uint32_t k = (uint32_t)t->cluster.n - 1;
  const struct hsr_cluster *c = hsr_cluster_at(t, k);
  struct hsr_member m = {.instance = instance};
  *known = hsr_scene_way(t->scene, instance, (double)c->from, (double)c->to,
                         m.box.lo, m.box.hi);
  HSR_STEP(t->tally, HSR_MOVERS_BOUNDED, HSR_VOLUME(instance),
           HSR_MOVERS_CUBE(k), HSR_NOWHERE, *known);
  return !*known || add_member(t, &m);
}

enum hsr_status hsr_space_time_begin(struct hsr_space_time *t,
                                     const struct hsr_cubes *cubes, long frames,
                                     struct hsr_tally *tally,
                                     struct hsr_arena *arena) {
  long frame = hsr_scene_frame(cubes->scene), part = frame % frames;
  long from = frame - (part < 0 ? part + frames : part);
  uint32_t root;
  t->tally = tally;
  if (t->arena && hsr_cluster_at(t, 0)->from == from)
    return HSR_OK;
  hsr_arena_reset(arena);
  *t = (struct hsr_space_time){
      .scene = cubes->scene, .tally = tally, .arena = arena};
  t->loose = HSR_NEW(arena, uint32_t, cubes->n_movers);
  if (!t->loose || !new_cluster(t, from, from + frames - 1, &root))
    return HSR_E_NOMEM;
  for (uint32_t k = 0; k < cubes->n_movers; k++) {
    bool known;
    if (!bound(t, cubes->mover[k], &known))
      return HSR_E_NOMEM;
    if (!known)
      t->loose[t->n_loose++] = cubes->mover[k];
  }
  return HSR_OK;
}

/* --- Division ------------------------------------------------------------- */

/* The half of the interval that holds the scene's frame: 0 or 1. */
static int half_of(const struct hsr_space_time *t,
                   const struct hsr_cluster *c) {
  return hsr_scene_frame(t->scene) > c->from + (c->to - c->from) / 2;
}

/* Makes a half in time of cluster k: its members, bounded anew. */
static bool make_half(struct hsr_space_time *t, uint32_t k, int half) {
  struct hsr_cluster c = *hsr_cluster_at(t, k);
  long last = c.from + (c.to - c.from) / 2;
  uint32_t made;
  if (!new_cluster(t, half ? last + 1 : c.from, half ? c.to : last, &made))
    return false;
  hsr_cluster_at(t, k)->child[half] = made;
  bool good = true, known;
  for (uint32_t j = 0; j < c.n && good; j++)
    good = bound(t, hsr_member_at(t, c.first + j)->instance, &known);
  return good;
}

/* Does member j go into the upper part? It does if its middle is above the mean
 * of all middles along the axis. If none is, or all are (`alike`), the second
 * half of the members does. */
static bool is_above(const struct hsr_space_time *t,
                     const struct hsr_cluster *c, int axis, double mean,
                     bool alike, uint32_t j) {
  return alike ? j >= c->n / 2
               : middle(&hsr_member_at(t, c->first + j)->box, axis) > mean;
}

/* Makes the two parts in space of cluster k. */
static bool divide_in_space(struct hsr_space_time *t, uint32_t k) {
  struct hsr_cluster c = *hsr_cluster_at(t, k);
  int axis = longest_axis(&c.box);
  double mean = 0;
  uint32_t above = 0;
  for (uint32_t j = 0; j < c.n; j++)
    mean += middle(&hsr_member_at(t, c.first + j)->box, axis) / c.n;
  for (uint32_t j = 0; j < c.n; j++)
    above += is_above(t, &c, axis, mean, false, j);
  bool good = true;
  for (int part = 0; part < 2 && good; part++) {
    uint32_t made;
    good = new_cluster(t, c.from, c.to, &made);
    for (uint32_t j = 0; j < c.n && good; j++) {
      if (is_above(t, &c, axis, mean, !above || above == c.n, j) != part)
        continue;
      good = add_member(t, hsr_member_at(t, c.first + j));
      HSR_STEP(t->tally, HSR_MOVERS_DOWN,
               HSR_VOLUME(hsr_member_at(t, c.first + j)->instance),
               HSR_MOVERS_CUBE(made), HSR_NOWHERE, 0);
    }
    if (good)
      hsr_cluster_at(t, k)->child[part] = made;
  }
  return good;
}

/* Is a cluster to be divided in time? If not, it is in space. */
static bool is_long(const struct hsr_cluster *c) {
  return c->to > c->from &&
         c->longest / c->n > 0.5 * side(&c->box, longest_axis(&c->box));
}

int hsr_space_time_divide(struct hsr_space_time *t, uint32_t k,
                          uint32_t part[2]) {
  struct hsr_cluster *c = hsr_cluster_at(t, k);
  bool good = true;
  if (c->divided == HSR_UNDIVIDED) {
    bool in_time = is_long(c);
    c->divided = in_time ? HSR_IN_TIME : HSR_IN_SPACE;
    HSR_STEP(t->tally, in_time ? HSR_MOVERS_SPLITS_IN_TIME : HSR_MOVERS_SPLITS,
             HSR_MOVERS_CUBE(k), HSR_NOTHING, HSR_NOWHERE, 0);
    good = in_time || divide_in_space(t, k);
  }
  c = hsr_cluster_at(t, k);
  int half = half_of(t, c);
  if (c->divided == HSR_IN_TIME && c->child[half] == HSR_NO_NODE)
    good = make_half(t, k, half);
  if (!good)
    return 0;
  memcpy(part, hsr_cluster_at(t, k)->child, 2 * sizeof *part);
  if (c->divided == HSR_IN_SPACE)
    return 2;
  part[0] = hsr_cluster_at(t, k)->child[half];
  return 1;
}
