/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One frame of the hierarchical z-buffer: its state, struct hsr_hz_walk, and
 * its steps. Shared by hzbuffer.c and hzbuffer_moving.c. The sources are named
 * in hzbuffer.c ("the thesis", "1993").
 *
 * The name `walk` stands for the traversal of the octrees from front to back in
 * one frame. It has nothing to do with a camera's walk through a scene, nor
 * with the traversal of BSP trees (algorithms/engines/bsp/bsp_walk.h).
 *
 * Files, as the papers have the steps:
 *
 *   walk.c        how a frame begins and ends, and what is counted
 *   octrees.c     ProcessOctreeNode: the octrees from front to back
 *   cube.c        IsCubeVisible: is a cube visible?
 *   cell.c        the polygons of a cube: tested, then tiled
 *   coherence.c   temporal coherence: what was visible in the frame before
 *
 * Functions borrow what they are given, for the call. Pointers are not NULL. */
#ifndef HSR_ALGORITHMS_HZBUFFER_WALK_H
#define HSR_ALGORITHMS_HZBUFFER_WALK_H

#include "algorithms/engines/cubes/cube_frame.h"
#include "algorithms/engines/cubes/cube_list.h"
#include "algorithms/engines/cubes/cube_octants.h"
#include "algorithms/engines/pyramid/maps.h"
#include "algorithms/engines/pyramid/masked.h"
#include "algorithms/engines/pyramid/pyramid.h"

#ifdef __cplusplus
extern "C" {
#endif

/* --- What is counted ------------------------------------------------------ */

/* The part, and its counters; walk.c has their meanings, in this order. */
extern const struct hsr_part hsr_hz_part;
enum {
  HSR_HZ_NODES = HSR_FIRST_OF(HSR_PART_HZ),
  HSR_HZ_NODES_OUT,
  HSR_HZ_CUBES_TESTED,
  HSR_HZ_CUBES_CULLED,
  HSR_HZ_CUBES_VISIBLE,
  HSR_HZ_CUBE_READS,
  HSR_HZ_SIDES_SCANNED,
  HSR_HZ_SIDE_SAMPLES,
  HSR_HZ_FACES_MET,
  HSR_HZ_FACES_REPEATED,
  HSR_HZ_FACES_TESTED,
  HSR_HZ_FACES_CULLED,
  HSR_HZ_FACES_TILED,
  HSR_HZ_FACE_READS,
  HSR_HZ_FACES_BEFORE,
  HSR_HZ_CUBES_AGAIN,
  HSR_HZ_CUBES_DIVIDED,
  HSR_HZ_FACES_DOWN,
  HSR_HZ_INSTANCES_DOWN,
  HSR_HZ_TILES_MASKED,
  HSR_HZ_OCCLUDERS
};
/* Groups of lines of its outline: the cubes of the last frame; a node up to its
 * visibility test; its polygons and octants. */
enum { HSR_HZ_LAST_LINES, HSR_HZ_NODE_LINES, HSR_HZ_POLYGON_LINES };

/* --- Options -------------------------------------------------------------- */

/* The words of hzbuffer's options, in the order of the option's words in
 * hzbuffer.c; and one choice of each. */
enum { HSR_HZ_OCTREE_OFF, HSR_HZ_OCTREE_ON, HSR_HZ_OCTREE_LAZY };
enum {
  HSR_HZ_PYRAMID_OFF,
  HSR_HZ_PYRAMID_ON,
  HSR_HZ_PYRAMID_DUAL,
  HSR_HZ_PYRAMID_MASKED,
  HSR_HZ_PYRAMID_MAPS
};
enum { HSR_HZ_VOLUMES_CUBES, HSR_HZ_VOLUMES_TIGHT };
enum {
  HSR_HZ_CUBES_RECTANGLE,
  HSR_HZ_CUBES_SIDES,
  HSR_HZ_CUBES_WHOLE,
  HSR_HZ_CUBES_ENTRY
};
enum {
  HSR_HZ_POLYGONS_FAST,
  HSR_HZ_POLYGONS_BASIC,
  HSR_HZ_POLYGONS_DEFINITIVE,
  HSR_HZ_POLYGONS_NONE
};
enum {
  HSR_HZ_COHERENCE_OFF,
  HSR_HZ_COHERENCE_LIST,
  HSR_HZ_COHERENCE_PASSES,
  HSR_HZ_COHERENCE_CHC,
  HSR_HZ_COHERENCE_CHC_PP
};
struct hsr_hz_choice {
  long octree, pyramid, volumes, cubes, polygons, coherence;
  long occluders; /* pyramid=maps: so many faces, or a few more */
  long assumed;   /* coherence=chc++: frames */
};

/* The words of the option coherence=, which both modules have. */
extern const struct hsr_word hsr_hz_coherences[];

/* coherence=chc++: for how many frames a visible cube is assumed to be visible, if
 * nothing else is said. The paper has 5 to 10. */
#define HSR_HZ_ASSUMED 8

/* The standard octree of the thesis (3.5): a leaf has at least 20 faces, and a
 * face is small if its area is less than a tenth of a cube's side. */
#define HSR_HZ_LEAST 20
#define HSR_HZ_SMALL 0.1

/* --- Once for all frames -------------------------------------------------- */

/* What lasts from frame to frame. All zero before hsr_hz_prepare. */
struct hsr_hz_prepared {
  struct hsr_cubes cubes;
  struct hsr_cube_list list[2]; /* coherence: visible cubes of the last frame,
                                   and of this one */
  int last;                     /* list[last] is the last frame's */
  uint32_t frame;               /* coherence=chc++: its number, from 0 */
  bool half_divided; /* octree=lazy: memory ran out while a cube was divided.
                        No further frame can be drawn */
};

/* Makes the cubes of a world, as hsr_cubes_init. If `lazily`, it makes the root
 * cubes only; the others are divided when they are first visible. `world` is
 * borrowed as long as *prepared. Fails as hsr_cubes_init; to be released also
 * after a failure. */
enum hsr_status hsr_hz_prepare(struct hsr_hz_prepared *prepared,
                               const struct hsr_world *world,
                               const struct hsr_octree_rule *rule, bool lazily,
                               struct hsr_error *err);
void hsr_hz_release(struct hsr_hz_prepared *prepared);

/* --- A frame -------------------------------------------------------------- */

struct hsr_hz_walk {
  struct hsr_hz_choice choice;
  struct hsr_hz_prepared *prepared;
  struct hsr_cube_frame frame;
  struct hsr_tally *tally;
  bool out_of_memory;

  struct hsr_pyramid pyramid;
  struct hsr_entry_count count; /* of what is read of it, or of these: */

  /* pyramid=masked or maps: these are asked instead of the pyramid, of which only
   * level 0, the z-buffer, is kept. */
  struct hsr_masked masked;
  struct hsr_maps maps;
  long occluders; /* faces that have been tiled, until the maps are made */
  struct hsr_bounds stale; /* samples that have been written since the pyramid
                              above them was brought up to date; or empty */
  bool plain; /* the first pass of coherence: faces are not tested, and the
                 pyramid is not kept up to date */

  /* Face f of the current instance has been met already if met[f] == visit.
   * Each instance gets another `visit`, so met[] is never cleared. */
  uint32_t *met, visit;

  /* The cubes that were visible in the last frame, and those found visible in
   * this one; NULL without coherence. */
  struct hsr_cube_list *last, *next;
  struct hsr_cube_marks rendered; /* the cubes of *last, to look them up, once
                                     they have been rendered */

  /* coherence=chc: the cubes of *last, in which something was visible; and the
   * cubes of the octree of instances that are so in this frame, uint32_t. */
  struct hsr_cube_marks before;
  struct hsr_growing instance_cubes;
};

/* Begins a frame of `job`: clears the depths and the pyramid, tiles the loose
 * faces, which are in no cube, and renders the cubes that were visible in the
 * last frame. `job`, `prepared` and `choice` are borrowed until hsr_hz_end;
 * memory is taken from job->scratch. HSR_E_NOMEM. */
enum hsr_status hsr_hz_begin(struct hsr_hz_walk *walk,
                             const struct hsr_job *job,
                             struct hsr_hz_prepared *prepared,
                             const struct hsr_hz_choice *choice);

/* Ends the frame. HSR_E_NOMEM if memory ran out in it. */
enum hsr_status hsr_hz_end(struct hsr_hz_walk *walk);

/* From now on each entry that is read of the pyramid or the maps, or tile of the
 * masked buffer, is a step of `counter`, on behalf of the cube or the face
 * `whom`. */
static inline void hsr_hz_read_for(struct hsr_hz_walk *w, int counter,
                                   struct hsr_subject whom) {
  if (!HSR_COUNTING)
    return;
  w->count.reads = counter;
  w->count.whom = whom;
}

/* Is there a pyramid? */
static inline bool hsr_hz_has_pyramid(const struct hsr_hz_walk *w) {
  return w->choice.pyramid == HSR_HZ_PYRAMID_ON ||
         w->choice.pyramid == HSR_HZ_PYRAMID_DUAL;
}

/* Can something be found hidden? Not without a pyramid, nor before the maps are
 * made. */
static inline bool hsr_hz_can_hide(const struct hsr_hz_walk *w) {
  return w->choice.pyramid != HSR_HZ_PYRAMID_OFF &&
         (w->choice.pyramid != HSR_HZ_PYRAMID_MAPS || w->maps.made);
}

/* Is what is within a box of samples, and nowhere nearer than depth q, certainly
 * hidden? By the pyramid's fast test, the masked buffer or the maps. There must
 * be one of them. */
static inline bool hsr_hz_hides(struct hsr_hz_walk *w, struct hsr_bounds box,
                                float q) {
  if (w->choice.pyramid == HSR_HZ_PYRAMID_MASKED)
    return hsr_masked_hides(&w->masked, box, q);
  if (w->choice.pyramid == HSR_HZ_PYRAMID_MAPS)
    return hsr_maps_hides(&w->maps, box, q);
  return hsr_pyramid_hides(&w->pyramid, box, q);
}

/* --- The octrees, from front to back -------------------------------------- */

/* ProcessOctreeNode for node k of the octree of instances. `inside`: its cube
 * is known to lie wholly in the frustum. With coherence=chc, here and below:
 * whether something in the cube was found visible; else of no meaning. */
bool hsr_hz_process_instances(struct hsr_hz_walk *walk, uint32_t k,
                              bool inside);

/* octree=lazy: divides node k of the octree of instances, if it is not divided
 * yet. Sets walk->out_of_memory if memory runs out. */
void hsr_hz_divide_instances(struct hsr_hz_walk *walk, uint32_t k);

/* Processes the instances that node k of that octree itself holds, not those of
 * its octants. */
bool hsr_hz_process_instances_of(struct hsr_hz_walk *walk, uint32_t k);

/* ProcessOctreeNode from the root of an instance's own octree. An instance that
 * has been processed in this frame already is left out: it may be in several
 * cubes. */
bool hsr_hz_process_instance(struct hsr_hz_walk *walk, uint32_t instance);

/* Makes an instance the current one, to which all cells and faces below belong.
 * None of its faces has been met, but those of the last frame's cubes that have
 * been rendered. */
void hsr_hz_set_instance(struct hsr_hz_walk *walk, uint32_t instance);

/* Are sides of cubes scan-converted, if the pyramid leaves them open? */
static inline bool hsr_hz_scans_sides(const struct hsr_hz_walk *w) {
  return w->choice.cubes == HSR_HZ_CUBES_SIDES ||
         w->choice.cubes == HSR_HZ_CUBES_ENTRY;
}

/* --- Is a cube visible? --------------------------------------------------- */

/* The volume that is tested for a node: its cube, or the tight box in it. */
static inline struct hsr_octree_box
hsr_hz_volume(const struct hsr_hz_walk *w, const struct hsr_octree_node *node) {
  return w->choice.volumes == HSR_HZ_VOLUMES_TIGHT ? node->tight
                                                   : hsr_octree_cube(node);
}

/* IsCubeVisible: false if the box `cube`, placed by `placing`, is outside of
 * the frustum or found to be hidden. True may be wrong, as the thesis allows.
 * Steps are counted for `subject`. *inside says on entry whether the box is
 * known to lie wholly in the frustum, and is set to true if that is found
 * here. */
bool hsr_hz_is_cube_visible(struct hsr_hz_walk *walk,
                            const struct hsr_placing *placing,
                            struct hsr_octree_box cube,
                            struct hsr_subject subject, bool *inside);

/* The two parts of IsCubeVisible: false if the box is outside of the frustum; and
 * false if it is found to be hidden. */
bool hsr_hz_is_in_frustum(struct hsr_hz_walk *walk,
                          const struct hsr_placing *placing,
                          const struct hsr_octree_box *cube,
                          struct hsr_subject subject, bool *inside);
bool hsr_hz_passes_pyramid(struct hsr_hz_walk *walk,
                           const struct hsr_placing *placing,
                           struct hsr_octree_box cube,
                           struct hsr_subject subject);

/* Are the eight octants of a cube projected together? Not in the counting
 * build, which counts what the paper's own steps read; and not where a test
 * needs more of an octant than its rectangles: with pyramid=off or dual,
 * cubes=sides, or in parallel projection. */
bool hsr_hz_tests_together(const struct hsr_hz_walk *walk);

/* hsr_hz_passes_pyramid for octant o of those projected together, with the same
 * answer. */
bool hsr_hz_octant_passes_pyramid(struct hsr_hz_walk *walk,
                                  const struct hsr_octants *octants, int o);

/* --- The polygons of a cube ----------------------------------------------- */

/* Tests and tiles the faces of node k of the current instance's octree: those
 * that the node itself holds. */
void hsr_hz_tile_cell(struct hsr_hz_walk *walk, uint32_t k);

/* Tiles face f of the tiler's world, untested, the general way. It has been
 * placed on the tiler's screen (hsr_tiler_place, or a relevant face). */
void hsr_hz_tile_face(struct hsr_hz_walk *walk, struct hsr_tiler *tiler,
                      uint32_t f);

/* Makes the occlusion maps, if there are enough occluders.
 * Brings the pyramid up to date above walk->stale. To be called before anything is
 * tested. The masked buffer always is up to date. */
void hsr_hz_refresh(struct hsr_hz_walk *walk);

/* --- Temporal coherence --------------------------------------------------- */

/* The first pass: renders the cubes of walk->last into the z-buffer alone; then
 * builds the pyramid of it. HSR_E_NOMEM. */
enum hsr_status hsr_hz_render_last(struct hsr_hz_walk *walk);

/* coherence=chc or chc++ */
static inline bool hsr_hz_is_chc(const struct hsr_hz_walk *w) {
  return w->choice.coherence >= HSR_HZ_COHERENCE_CHC;
}

/* coherence=chc: was something in node k visible in the last frame? Of an
 * instance's octree, or of that of instances: HSR_NO_ID. */
static inline bool hsr_hz_was_visible(const struct hsr_hz_walk *w,
                                      uint32_t instance, uint32_t k) {
  return w->before.list && hsr_cube_is_marked(&w->before, instance, k);
}

/* coherence=chc++: is leaf k of an instance's octree, which was visible in the last
 * frame, assumed to be visible, and not tested in this frame? */
bool hsr_hz_is_assumed(const struct hsr_hz_walk *walk, uint32_t instance,
                       uint32_t k);

/* coherence=chc: notes that something in node k is visible. */
void hsr_hz_note_visible(struct hsr_hz_walk *walk, uint32_t instance,
                         uint32_t k);

/* coherence=chc: looks up what was visible in the last frame. HSR_E_NOMEM. */
enum hsr_status hsr_hz_begin_chc(struct hsr_hz_walk *walk);

/* Makes the list for the next frame, prepared->list[prepared->last]; an empty
 * one if memory ran out. */
void hsr_hz_end_coherence(struct hsr_hz_walk *walk);

#ifdef __cplusplus
}
#endif
#endif
