/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The hierarchical z-buffer's walk through a frame, for hzbuffer.c and
 * hzbuffer_moving.c. The sources are named in hzbuffer.c. Its parts, as the
 * papers have them:
 *
 *   walk.c        how a frame begins and ends, and what is counted
 *   octrees.c     process_node: the octrees from front to back
 *   cube.c        cube_visible: is a cube visible?
 *   cell.c        the polygons of a cube
 *   coherence.c   what was visible in the frame before */
#ifndef HSR_ALGORITHMS_HZBUFFER_WALK_H
#define HSR_ALGORITHMS_HZBUFFER_WALK_H

#include "algorithms/engines/cubes/cube_frame.h"
#include "algorithms/engines/cubes/cube_list.h"
#include "algorithms/engines/cubes/cube_octants.h"
#include "algorithms/engines/pyramid/pyramid.h"

#ifdef __cplusplus
extern "C" {
#endif

/* --- What is counted ------------------------------------------------------ */

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
  HSR_HZ_INSTANCES_DOWN
};
/* Groups of its lines. */
enum { HSR_HZ_LAST_LINES, HSR_HZ_NODE_LINES, HSR_HZ_POLYGON_LINES };

/* --- Options -------------------------------------------------------------- */

/* The words of hzbuffer's options, and what is chosen of each. */
enum { HSR_HZ_OCTREE_OFF, HSR_HZ_OCTREE_ON, HSR_HZ_OCTREE_LAZY };
enum { HSR_HZ_PYRAMID_OFF, HSR_HZ_PYRAMID_ON, HSR_HZ_PYRAMID_DUAL };
enum { HSR_HZ_VOLUMES_CUBES, HSR_HZ_VOLUMES_TIGHT };
enum { HSR_HZ_CUBES_RECTANGLE, HSR_HZ_CUBES_SIDES, HSR_HZ_CUBES_WHOLE };
enum {
  HSR_HZ_POLYGONS_FAST,
  HSR_HZ_POLYGONS_BASIC,
  HSR_HZ_POLYGONS_DEFINITIVE,
  HSR_HZ_POLYGONS_NONE
};
enum { HSR_HZ_COHERENCE_OFF, HSR_HZ_COHERENCE_LIST, HSR_HZ_COHERENCE_PASSES };
struct hsr_hz_choice {
  long octree, pyramid, volumes, cubes, polygons, coherence;
};

/* The words of coherence=. */
extern const struct hsr_word hsr_hz_coherences[];

/* The standard octree of the thesis (3.5): a leaf has at least 20 faces, and a
 * face is small if its area is less than a tenth of a cube's side. */
#define HSR_HZ_LEAST 20
#define HSR_HZ_SMALL 0.1

/* --- Once ----------------------------------------------------------------- */

/* What lasts from frame to frame. All zero before it is prepared. */
struct hsr_hz_prepared {
  struct hsr_cubes cubes;
  struct hsr_cube_list list[2]; /* visible cubes: of the last frame, of this */
  int last;                     /* which one is the last frame's */
  bool half_divided; /* octree=lazy: memory ran out in the middle of it */
};

/* As of hsr_cubes_init; the cubes are divided later if `lazily`. To be released
 * also after a failure. */
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
  struct hsr_bounds
      stale;  /* the pyramid above this is not up to date; or empty */
  bool plain; /* faces are not tested, and the pyramid is left as it is */

  /* Faces of the instance at hand: met[f] == visit if it was met already. */
  uint32_t *met, visit;

  /* Cubes that were visible in the last frame, and those of this; NULL without
   * coherence. */
  struct hsr_cube_list *last, *next;
  struct hsr_cube_marks rendered; /* those of *last, when they are rendered */
};

/* Begins a frame: tiles loose faces, which are in no cube, and renders what was
 * visible in the last frame. HSR_E_NOMEM. */
enum hsr_status hsr_hz_begin(struct hsr_hz_walk *walk,
                             const struct hsr_job *job,
                             struct hsr_hz_prepared *prepared,
                             const struct hsr_hz_choice *choice);

/* Ends it. HSR_E_NOMEM if memory ran out in it. */
enum hsr_status hsr_hz_end(struct hsr_hz_walk *walk);

/* What the pyramid is read for from now on. */
static inline void hsr_hz_read_for(struct hsr_hz_walk *w, int counter,
                                   struct hsr_subject whom) {
  if (!HSR_COUNTING)
    return;
  w->pyramid.count.reads = counter;
  w->pyramid.count.whom = whom;
}

/* --- The octrees, from front to back -------------------------------------- */

/* process_node of the thesis, for node k of the octree of instances. `inside`:
 * its cube is known to be all inside of the frustum. */
void hsr_hz_process_instances(struct hsr_hz_walk *walk, uint32_t k,
                              bool inside);

/* octree=lazy: divides node k of the octree of instances, if it is not divided
 * yet. */
void hsr_hz_divide_instances(struct hsr_hz_walk *walk, uint32_t k);

/* The instances in node k, but for those in its octants. */
void hsr_hz_process_instances_of(struct hsr_hz_walk *walk, uint32_t k);

/* process_node for the octree of one instance: the first time in a frame. */
void hsr_hz_process_instance(struct hsr_hz_walk *walk, uint32_t instance);

/* Makes an instance the one at hand, whose faces are met. Those that were
 * rendered with the last frame's cubes count as met. */
void hsr_hz_set_instance(struct hsr_hz_walk *walk, uint32_t instance);

/* --- Is a cube visible? --------------------------------------------------- */

/* The volume that is tested for a node. */
static inline struct hsr_octree_box
hsr_hz_volume(const struct hsr_hz_walk *w, const struct hsr_octree_node *node) {
  return w->choice.volumes == HSR_HZ_VOLUMES_TIGHT ? node->tight
                                                   : hsr_octree_cube(node);
}

/* cube_visible of the thesis: false if the box is outside of the frustum, or
 * found to be hidden. *inside: the box is known to be all inside of the
 * frustum; it is brought up to date. */
bool hsr_hz_is_cube_visible(struct hsr_hz_walk *walk,
                            const struct hsr_placing *placing,
                            struct hsr_octree_box cube,
                            struct hsr_subject subject, bool *inside);

/* Are octants projected and tested together? Not in the counting build, which
 * counts what the paper's steps read; nor where a test needs more than an
 * octant's rectangles. */
bool hsr_hz_tests_together(const struct hsr_hz_walk *walk);

/* hsr_hz_is_cube_visible of octant o, with the same answer. */
bool hsr_hz_is_octant_visible(struct hsr_hz_walk *walk,
                              const struct hsr_octants *octants, int o,
                              const struct hsr_octree_node *node,
                              struct hsr_subject subject, bool *inside);

/* --- The polygons of a cube ----------------------------------------------- */

/* Tests and tiles the faces of node k of the instance at hand. */
void hsr_hz_tile_cell(struct hsr_hz_walk *walk, uint32_t k);

/* Tiles a face that is placed on the tiler's screen. */
void hsr_hz_tile_face(struct hsr_hz_walk *walk, struct hsr_tiler *tiler,
                      uint32_t f);

/* Brings the pyramid up to date, before anything is tested. */
void hsr_hz_refresh(struct hsr_hz_walk *walk);

/* --- Temporal coherence --------------------------------------------------- */

/* Renders the cubes that were visible in the last frame into the plain
 * z-buffer; then builds the pyramid. HSR_E_NOMEM. */
enum hsr_status hsr_hz_render_last(struct hsr_hz_walk *walk);

/* Makes the list for the next frame; an empty one, if memory ran out. */
void hsr_hz_end_coherence(struct hsr_hz_walk *walk);

#ifdef __cplusplus
}
#endif
#endif
