/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The hierarchical z-buffer's walk through a frame, in parts: whether a cube is
 * visible (cube.c), what is in it (cell.c), the octrees from front to back
 * (octrees.c), and what was visible in the frame before (coherence.c).
 * hzbuffer.c has the frame, and the sources. */
#ifndef HSR_ALGORITHMS_HZBUFFER_WALK_H
#define HSR_ALGORITHMS_HZBUFFER_WALK_H

#include "algorithms/engines/cubes/cube_frame.h"
#include "algorithms/engines/cubes/cube_list.h"
#include "algorithms/engines/cubes/cube_octants.h"
#include "algorithms/hierarchical/hzbuffer/movers.h"
#include "algorithms/engines/pyramid/pyramid.h"
#include "algorithms/hierarchical/hzbuffer/space_time.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Counters. */
enum {
  NODES,
  OUT,
  CUBES_TESTED,
  CUBES_CULLED,
  CUBES_VISIBLE,
  CUBE_READS,
  SIDES_SCANNED,
  SIDE_SAMPLES,
  FACES,
  REPEATED,
  FACES_TESTED,
  FACES_CULLED,
  FACES_TILED,
  FACE_READS,
  FACES_BEFORE,
  CUBES_AGAIN,
  MOVED,
  SPLITS,
  LOOKED,
  DIVIDED,
  FACES_DOWN,
  STILL_DOWN,
  MOVERS_MET,
  BOUNDED,
  IN_TIME
};

/* Options, and the words of each. */
enum {
  OCTREE,
  PLACEMENT,
  LEAST,
  PYRAMID,
  VOLUMES,
  CUBES,
  POLYGONS,
  COHERENCE,
  MOVERS,
  INTERVAL
};
enum { OFF, ON, DUAL };
enum { LAZILY = 2 };
enum { PUSHED, ENCLOSING };
enum { CUBE, TIGHT };
enum { RECTANGLE, SIDES, WHOLE };
enum { FAST, BASIC, DEFINITIVE, NONE };
enum { NO_COHERENCE, LIST, PASSES };
enum { FRESH, LAZY, BEHIND, KEPT, BY_SPEED, BY_VOLUME, SPACE_TIME };

/* What lasts from frame to frame. */
struct hsr_hz_prepared {
  struct hsr_cubes cubes;
  struct hsr_cube_list
      list[2]; /* visible cubes, of the last frame and of this */
  int last;    /* which one is the last frame's */

  bool half_divided; /* octree=lazy: memory ran out in the middle of it */

  struct hsr_movers movers;       /* movers=update, bounded, fixed: kept */
  struct hsr_space_time clusters; /* movers=space-time */
  struct hsr_arena movers_arena;  /* of either */
};

struct hsr_hz_walk {
  struct hsr_cube_frame frame;
  struct hsr_cube_list *last, *next; /* NULL without coherence */
  struct hsr_cube_marks rendered;    /* what of the last frame's was */
  struct hsr_movers movers;
  bool out_of_memory;
  struct hsr_pyramid pyramid;
  struct hsr_bounds
      stale;  /* the pyramid above it is not up to date; or empty */
  bool plain; /* no tests, and the pyramid is left as it is */
  const long *option;
  struct hsr_tally *tally;
  uint32_t *tiled; /* a face of the object at hand: the visit when it was met */
  uint32_t visit;
};

/* What the pyramid is read for from now on. */
static inline void hsr_hz_read_for(struct hsr_hz_walk *w, int counter,
                                   struct hsr_subject whom) {
  if (!HSR_COUNTING)
    return;
  w->pyramid.count.reads = counter;
  w->pyramid.count.whom = whom;
}

/* --- Is a cube visible? --------------------------------------------------- */

/* cube_visible of the thesis: false if the box is outside of the frustum, or
 * found to be hidden. *inside: the box is known to be all inside of the
 * frustum; it is brought up to date. */
bool hsr_hz_is_box_visible(struct hsr_hz_walk *walk,
                           const struct hsr_placing *placing,
                           struct hsr_octree_box cube,
                           struct hsr_subject subject, bool *inside);

/* The same of a node's cube, or of its tight box. */
bool hsr_hz_is_cube_visible(struct hsr_hz_walk *walk,
                            const struct hsr_placing *placing,
                            const struct hsr_octree_node *node,
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

/* --- What is in a cube ---------------------------------------------------- */

/* Brings the pyramid up to date, before anything is tested. */
void hsr_hz_refresh(struct hsr_hz_walk *walk);

/* Tiles a face that is placed on the tiler's screen. */
void hsr_hz_tile_face(struct hsr_hz_walk *walk, struct hsr_tiler *tiler,
                      uint32_t f);

/* Tests and tiles the faces of a cell of the object at hand. */
void hsr_hz_tile_cell(struct hsr_hz_walk *walk, uint32_t place);

/* --- The octrees ---------------------------------------------------------- */

/* Makes an instance's object the one at hand. Its faces that have been rendered
 * in this frame count as met. */
void hsr_hz_take_in_hand(struct hsr_hz_walk *walk, uint32_t instance);

/* Renders all octrees from front to back; what moves is among them, or behind
 * them, as the option says. HSR_E_NOMEM. */
enum hsr_status hsr_hz_render_octrees(struct hsr_hz_walk *walk);

/* Renders without cubes: cell after cell, as they come. */
void hsr_hz_render_all(struct hsr_hz_walk *walk);

/* --- Temporal coherence --------------------------------------------------- */

/* Renders the cubes that were visible in the last frame into the plain z-buffer;
 * then builds the pyramid. HSR_E_NOMEM. */
enum hsr_status hsr_hz_render_last(struct hsr_hz_walk *walk);

/* Makes the list for the next frame; none, if memory ran out. */
void hsr_hz_end_coherence(struct hsr_hz_walk *walk);

#ifdef __cplusplus
}
#endif
#endif
