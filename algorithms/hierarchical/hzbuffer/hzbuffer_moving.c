/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hierarchical z-buffer visibility of scenes in which objects move.
 *
 * Source      N. Greene, "Hierarchical Rendering of Complex Environments", PhD
 *             thesis, UC Santa Cruz, 1995, 3.4. He lists the ways, and measures
 *             none.
 * Ways        Few objects move: they come after all that stands still, as in
 *             `hzbuffer`. Many move: they are in an octree of their own, the
 *             dynamic octree, whose cubes are those of the static one. Both
 *             octrees are traversed together. The dynamic octree is made anew
 *             in each frame, wholly (movers=octree) or lazily (lazy). Or it is
 *             kept and brought up to date (update, bounded, fixed: movers.h).
 *             Or objects are in clusters in space-time (space-time:
 *             space_time.h), which come after all that stands still.
 * Notation    dynamic octree -> movers; static octree -> cubes->octree
 * Invariants  those of hzbuffer.c, with the standard choice of its options
 * Cost        that of hzbuffer, and putting the objects that move into cubes:
 *             in each frame all those that are not known to stay in theirs */
#include "algorithms/hierarchical/hzbuffer/moving/movers.h"
#include "algorithms/hierarchical/hzbuffer/moving/space_time.h"
#include "algorithms/hierarchical/hzbuffer/walk.h"

#include <math.h>
#include <stdlib.h>

/* --- Options -------------------------------------------------------------- */

enum { MOVERS, INTERVAL, OCTREE, COHERENCE };
enum {
  MOVERS_OCTREE,
  MOVERS_LAZY,
  MOVERS_UPDATE,
  MOVERS_BOUNDED,
  MOVERS_FIXED,
  MOVERS_SPACE_TIME
};
enum { OCTREE_ON, OCTREE_LAZY };

static const struct hsr_word movings[] = {
    {"octree", "an octree of them in every frame", 0},
    {"lazy", "the same, divided only where it is visible", 0},
    {"update", "an octree of them that is kept and brought up to date",
     HSR_FRAME_STATE},
    {"bounded",
     "the same; each is put again every `interval` frames only, in a box that "
     "holds it for so long, where its speed is known to be limited",
     HSR_FRAME_STATE},
    {"fixed",
     "the same; where it is known that something stays in a volume, it is put "
     "once, with that",
     HSR_FRAME_STATE},
    {"space-time",
     "clusters, in boxes that hold them for an interval, behind all that does "
     "not move; what is not hidden is divided in space or in time",
     HSR_FRAME_STATE},
    {NULL}};
static const struct hsr_word octrees[] = {
    {"on", "made once", 0},
    {"lazy", "its cubes are divided when they are first found to be visible",
     HSR_FRAME_STATE},
    {NULL}};

static const struct hsr_option options[] = {
    [MOVERS] = {"movers", "what is done with objects that move", movings, 0, 5,
                MOVERS_OCTREE},
    [INTERVAL] = {"interval", "movers=bounded or space-time: so many frames",
                  NULL, 1, 1024, 16},
    [OCTREE] = {"octree", "of what does not move", octrees, 0, 1, OCTREE_ON},
    [COHERENCE] = {"coherence", "what is kept from frame to frame",
                   hsr_hz_coherences, 0, HSR_HZ_COHERENCE_CHC_PP,
                   HSR_HZ_COHERENCE_OFF},
    {NULL}};

static struct hsr_hz_choice choice_of(const long *option) {
  return (struct hsr_hz_choice){.octree = option[OCTREE] == OCTREE_LAZY
                                              ? HSR_HZ_OCTREE_LAZY
                                              : HSR_HZ_OCTREE_ON,
                                .pyramid = HSR_HZ_PYRAMID_ON,
                                .coherence = option[COHERENCE],
                                .assumed = HSR_HZ_ASSUMED};
}

/* --- Once ----------------------------------------------------------------- */

struct prepared {
  struct hsr_hz_prepared still;
  struct hsr_movers movers;       /* the dynamic octree, if it is kept */
  struct hsr_space_time clusters; /* movers=space-time */
  struct hsr_arena arena;         /* of either */
};

static enum hsr_status prepare(const struct hsr_world *world,
                               const long *option, void **prepared,
                               struct hsr_error *err) {
  static const struct hsr_octree_rule rule = {
      .small = HSR_HZ_SMALL, .most = HSR_HZ_LEAST, .least = HSR_HZ_LEAST};
  struct prepared *p = calloc(1, sizeof *p);
  *prepared = p;
  if (!p)
    return hsr_fail_nomem(err);
  return hsr_hz_prepare(&p->still, world, &rule, option[OCTREE] == OCTREE_LAZY,
                        err);
}

static void release(void *prepared) {
  struct prepared *p = prepared;
  hsr_hz_release(&p->still);
  hsr_arena_free(&p->arena);
  free(p);
}

static void show(const void *prepared, struct hsr_shown *shown) {
  shown->cubes = &((const struct prepared *)prepared)->still.cubes;
}

/* --- The dynamic octree --------------------------------------------------- */

struct frame {
  struct hsr_hz_walk walk;
  struct prepared *prepared;
  struct hsr_movers anew;    /* the dynamic octree, if it is made anew */
  struct hsr_movers *movers; /* this one, or the one that is kept */
};

static void process_mover(struct frame *f, uint32_t i) {
  HSR_STEP(f->walk.tally, HSR_MOVERS_MET, HSR_VOLUME(i), HSR_NOTHING,
           HSR_NOWHERE, 0);
  hsr_hz_process_instance(&f->walk, i);
}

/* The movers of a list, which begins with `first`. */
static void process_list(struct frame *f, uint32_t first) {
  for (uint32_t k = first; k != HSR_NO_MOVER; k = f->movers->mover[k].next)
    process_mover(f, f->movers->mover[k].instance);
}

/* Makes the dynamic octree of this frame: of one cube if movers=lazy, else
 * whole. */
static enum hsr_status make_anew(struct frame *f) {
  const struct hsr_job *job = f->walk.frame.job;
  const struct hsr_cubes *cubes = f->walk.frame.cubes;
  f->movers = &f->anew;
  if (hsr_movers_init(&f->anew, cubes, job->tally, job->scratch))
    return HSR_E_NOMEM;
  return job->option[MOVERS] == MOVERS_LAZY ||
                 hsr_movers_divide_all(&f->anew, 0, &cubes->octree.node[0])
             ? HSR_OK
             : HSR_E_NOMEM;
}

/* Brings the dynamic octree that is kept to this frame. If memory runs out, it
 * is thrown away, and the next frame begins with a new one. */
static enum hsr_status bring_up_to_date(struct frame *f) {
  static const enum hsr_mover_knowledge knowledge[] = {
      [MOVERS_UPDATE] = HSR_MOVERS_KNOW_NOTHING,
      [MOVERS_BOUNDED] = HSR_MOVERS_KNOW_SPEED,
      [MOVERS_FIXED] = HSR_MOVERS_KNOW_VOLUME};
  const struct hsr_job *job = f->walk.frame.job;
  struct prepared *p = f->prepared;
  f->movers = &p->movers;
  p->movers.knowledge = knowledge[job->option[MOVERS]];
  p->movers.every = job->option[INTERVAL];
  if (!hsr_movers_update(&p->movers, f->walk.frame.cubes, job->tally,
                         &p->arena))
    return HSR_OK;
  hsr_arena_free(&p->arena);
  p->movers = (struct hsr_movers){.n = 0};
  return HSR_E_NOMEM;
}

/* --- Both octrees at once ------------------------------------------------- */

static void process_octants(struct frame *f, const struct hsr_octree_node *cube,
                            uint32_t still, uint32_t moving, bool inside);

/* ProcessOctreeNode for a cube of both octrees: `still` is its node in the
 * static one, or HSR_NO_NODE; `moving` is its node in the dynamic one. */
static void process_both(struct frame *f, const struct hsr_octree_node *cube,
                         uint32_t still, uint32_t moving, bool inside) {
  struct hsr_hz_walk *w = &f->walk;
  struct hsr_subject subject = still != HSR_NO_NODE
                                   ? hsr_cube_subject(HSR_NO_ID, still)
                                   : HSR_MOVERS_CUBE(moving);
  if (!hsr_hz_is_cube_visible(w, &w->frame.as_it_is, hsr_octree_cube(cube),
                              subject, &inside))
    return;
  HSR_STEP(w->tally, HSR_HZ_CUBES_VISIBLE, subject, HSR_NOTHING, HSR_NOWHERE,
           0);
  if (still != HSR_NO_NODE) {
    hsr_hz_divide_instances(w, still);
    if (w->out_of_memory)
      return;
    hsr_hz_process_instances_of(w, still);
  }
  if (!hsr_movers_divide(f->movers, moving, cube)) {
    w->out_of_memory = true;
    return;
  }
  process_list(f, hsr_mover_node(f->movers, moving)->first);
  process_octants(f, cube, still, moving, inside);
}

/* The octants of a cube of both octrees, from front to back. In an octant where
 * nothing moves, the static octree is traversed alone, as hzbuffer does. */
static void process_octants(struct frame *f, const struct hsr_octree_node *cube,
                            uint32_t still, uint32_t moving, bool inside) {
  struct hsr_hz_walk *w = &f->walk;
  const struct hsr_octree *octree = &w->frame.cubes->octree;
  int nearest = hsr_cube_nearest(&w->frame.as_it_is, cube);
  for (int n = 0; n < 8; n++) {
    int o = nearest ^ hsr_octant_order[n];
    uint32_t child =
        still != HSR_NO_NODE ? octree->node[still].child[o] : HSR_NO_NODE;
    uint32_t mover = hsr_mover_octant(f->movers, moving, o);
    if (mover != HSR_NO_NODE) {
      struct hsr_octree_node octant = hsr_octree_octant(cube, o);
      process_both(f, &octant, child, mover, inside);
    } else if (child != HSR_NO_NODE) {
      hsr_hz_process_instances(w, child, inside);
    }
  }
}

/* Both octrees; then the objects outside of the root's cube. */
static void process_octrees(struct frame *f) {
  struct hsr_hz_walk *w = &f->walk;
  const struct hsr_octree_node root = w->frame.cubes->octree.node[0];
  long how = w->frame.job->option[MOVERS];
  bool anew = how == MOVERS_OCTREE || how == MOVERS_LAZY;
  if (anew ? make_anew(f) : bring_up_to_date(f)) {
    w->out_of_memory = true;
    return;
  }
  if (f->movers->n)
    process_both(f, &root, 0, 0, false);
  else
    hsr_hz_process_instances(w, 0, false);
  process_list(f, f->movers->outside);
}

/* --- Clusters in space-time ----------------------------------------------- */

/* A box by its middle and half its sides, enlarged by what rounding may take
 * off. */
static struct hsr_octree_box middle_and_half(const struct hsr_box *box) {
  struct hsr_octree_box made;
  for (int a = 0; a < 3; a++) {
    made.centre[a] = 0.5 * (box->lo[a] + box->hi[a]);
    made.half[a] = 0.5 * (box->hi[a] - box->lo[a]) +
                   0x1p-50 * (fabs(box->lo[a]) + fabs(box->hi[a]));
  }
  return made;
}

/* May a cluster be visible? A box that is not within the root's cube counts as
 * visible: there too little is known of rounding on the screen. */
static bool is_visible(struct frame *f, const struct hsr_cluster *c,
                       uint32_t k) {
  struct hsr_hz_walk *w = &f->walk;
  struct hsr_box root = hsr_cube_box(&w->frame.cubes->octree.node[0]);
  bool inside = false;
  return !hsr_box_holds(&root, &c->box) ||
         hsr_hz_is_cube_visible(w, &w->frame.as_it_is, middle_and_half(&c->box),
                                HSR_MOVERS_CUBE(k), &inside);
}

/* If cluster k may be visible: its only member, or else the parts into which it
 * is divided. */
static void process_cluster(struct frame *f, uint32_t k) {
  struct hsr_space_time *clusters = &f->prepared->clusters;
  const struct hsr_cluster *c = hsr_cluster_at(clusters, k);
  uint32_t part[2];
  if (!c->n || !is_visible(f, c, k))
    return;
  if (c->n == 1) {
    process_mover(f, hsr_member_at(clusters, c->first)->instance);
    return;
  }
  int n = hsr_space_time_divide(clusters, k, part);
  f->walk.out_of_memory |= !n;
  for (int p = 0; p < n; p++)
    process_cluster(f, part[p]);
}

/* All that stands still; then the clusters; then the objects of which too
 * little is known to be in one. If memory runs out, the clusters are thrown
 * away. */
static void process_clusters(struct frame *f) {
  struct hsr_hz_walk *w = &f->walk;
  struct prepared *p = f->prepared;
  hsr_hz_process_instances(w, 0, false);
  if (hsr_space_time_begin(&p->clusters, w->frame.cubes,
                           w->frame.job->option[INTERVAL], w->tally, &p->arena))
    w->out_of_memory = true;
  else
    process_cluster(f, 0);
  for (uint32_t k = 0; k < p->clusters.n_loose && !w->out_of_memory; k++)
    process_mover(f, p->clusters.loose[k]);
  if (w->out_of_memory) {
    hsr_arena_free(&p->arena);
    p->clusters = (struct hsr_space_time){.n_loose = 0};
  }
}

/* --- A frame -------------------------------------------------------------- */

static enum hsr_status render(const struct hsr_job *job,
                              struct hsr_error *err) {
  struct frame f = {.prepared = job->prepared};
  const struct hsr_hz_choice choice = choice_of(job->option);
  if (hsr_hz_begin(&f.walk, job, &f.prepared->still, &choice))
    return hsr_fail_nomem(err);
  if (job->option[MOVERS] == MOVERS_SPACE_TIME)
    process_clusters(&f);
  else
    process_octrees(&f);
  return hsr_hz_end(&f.walk) ? hsr_fail_nomem(err) : HSR_OK;
}

/* --- What it is and counts ------------------------------------------------ */

static const struct hsr_use uses[] = {
    {&hsr_tiler_part}, {&hsr_inequalities_part}, {&hsr_hz_part}, {NULL}};

static const struct hsr_counter counters[] = {
    [HSR_MOVERS_DOWN] = {"moved down",
                         "instances that move, from a cube to an octant",
                         HSR_SORT, HSR_OF_VOLUME, HSR_OF_CELL},
    [HSR_MOVERS_SPLITS] = {"splits", "cubes of instances that move, divided",
                           HSR_SUBDIVIDE, HSR_OF_CELL, HSR_OF_NOTHING,
                           .key = "cube-split"},
    [HSR_MOVERS_LOOKED_AT] = {"movers looked at",
                              "in their cubes of the last frame, which may "
                              "hold them still",
                              HSR_COMPARE, HSR_OF_VOLUME, HSR_OF_CELL,
                              "left|kept"},
    [HSR_MOVERS_MET] = {"movers met", "instances that move, in no hidden cube",
                        HSR_ACTIVATE, HSR_OF_VOLUME, HSR_OF_NOTHING},
    [HSR_MOVERS_BOUNDED] = {"ways bounded",
                            "the way of an instance for the frames of a "
                            "cluster",
                            HSR_COMPARE, HSR_OF_VOLUME, HSR_OF_CELL,
                            "unknown|known"},
    [HSR_MOVERS_SPLITS_IN_TIME] = {"splits in time",
                                   "of a cluster's frames in halves",
                                   HSR_SUBDIVIDE, HSR_OF_CELL, HSR_OF_NOTHING},
    {NULL}};

static const struct hsr_line outline[] = {
    {"", .part = &hsr_hz_part, .group = HSR_HZ_LAST_LINES},
    {"make an octree of what moves: divide a cube",
     HSR_RAISES(HSR_MOVERS_SPLITS)},
    {"or keep it: does its cube still hold an instance?",
     HSR_RAISES(HSR_MOVERS_LOOKED_AT)},
    {"  move an instance down to an octant", HSR_RAISES(HSR_MOVERS_DOWN)},
    {"or clusters of it, in boxes for several frames: bound its ways",
     HSR_RAISES(HSR_MOVERS_BOUNDED)},
    {"  divide a visible one in time, instead of in space",
     HSR_RAISES(HSR_MOVERS_SPLITS_IN_TIME)},
    {"", .part = &hsr_hz_part, .group = HSR_HZ_NODE_LINES},
    {"  for each instance that moves, in the node", HSR_RAISES(HSR_MOVERS_MET)},
    {"", .part = &hsr_hz_part, .group = HSR_HZ_POLYGON_LINES},
    {NULL}};

const struct hsr_algorithm HSR_ALGORITHM(hzbuffer_moving) = {
    .name = "hzbuffer-moving",
    .title = "Hierarchical z-buffer visibility of objects that move",
    .authors = "N. Greene",
    .year = 1995,
    .source = "N. Greene, PhD thesis, UC Santa Cruz, 1995, 3.4",
    .taxonomy = HSR_HIERARCHICAL,
    .sort_order = "Z(XY)",
    .coherence = "of hidden regions, in space, on the screen and in time",
    .subjects = 1 << HSR_FACES,
    .makes = {{HSR_IDS}},
    .flags = HSR_INSTANCED,
    .parts = uses,
    .counters = counters,
    .outline = outline,
    .options = options,
    .prepare = prepare,
    .render = render,
    .show = show,
    .release = release};
