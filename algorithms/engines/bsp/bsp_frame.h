/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One view of a world whose faces are in one BSP tree, without an octree: the
 * common part of the algorithms that take polygons in the tree's order.
 *
 * Source      H. Fuchs, Z. Kedem and B. Naylor, "On Visible Surface Generation
 *             by A Priori Tree Structures", SIGGRAPH 1980; N. Greene,
 *             "Hierarchical Polygon Tiling with Coverage Masks", SIGGRAPH 1996,
 *             2.1.
 * Loose       A face is loose if the tree cannot order it, or not for this eye
 *             (common/trees/bsp.h, Not flat). Loose faces come last, and are
 *             compared in depth at each sample with what is there; these
 *             comparisons are counted apart. */
#ifndef HSR_ALGORITHMS_BSP_FRAME_H
#define HSR_ALGORITHMS_BSP_FRAME_H

#include "algorithms/engines/light/glass.h"
#include "algorithms/engines/bsp/bsp_walk.h"
#include "common/exact/order.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The part that all these algorithms have, and its counters. */
extern const struct hsr_part hsr_bsp_part;
enum {
  HSR_BSP_PIECES = HSR_FIRST_OF(HSR_PART_BSP),
  HSR_BSP_SAMPLES,
  HSR_BSP_THICKNESS
};

/* `prepare` and `release` of these algorithms (algorithms/algorithm.h): make
 * and free the tree. HSR_E_NOMEM; HSR_E_REFUSED as hsr_bsp_init. */
enum hsr_status hsr_bsp_prepare(const struct hsr_world *world,
                                const long *option, void **prepared,
                                struct hsr_error *err);
void hsr_bsp_release(void *prepared);

/* `show` of a descriptor whose prepared object is of hsr_bsp_prepare. */
void hsr_bsp_show(const void *prepared, struct hsr_shown *shown);

/* The same, with a box for each node of the tree. */
enum hsr_status hsr_bsp_prepare_bounded(const struct hsr_world *world,
                                        const long *option, void **prepared,
                                        struct hsr_error *err);

struct hsr_bsp_frame {
  const struct hsr_job *job;
  const struct hsr_bsp *bsp;
  /* By node: holds all that any ray sees of the pieces in its subtree; NULL
   * without hsr_bsp_prepare_bounded. */
  const struct hsr_box *box;
  struct hsr_screen screen;
  struct hsr_bsp_waiting *waiting;
  bool *placed;             /* by face: it is in the picture, and not loose */
  uint32_t *loose, n_loose; /* the loose faces in the picture */
  int *columns;             /* room for the columns of a face */
  uint32_t most_corners;    /* of a piece */
  struct hsr_glass *glass;  /* if the picture is transparent; else NULL */

  /* As struct hsr_bsp_walk has it, with the traversal's context. An algorithm
   * may set it after hsr_bsp_frame_begin; NULL otherwise. */
  bool (*enter_node)(void *context, uint32_t node);

  /* Of the piece of hsr_bsp_frame_piece. */
  double (*outline)[3];
  struct hsr_cut *cut;
};

/* Makes a frame ready for a job, and clears the window's ids to the background.
 * The job is borrowed as long as *frame; memory is taken from job->scratch.
 * HSR_E_NOMEM. */
enum hsr_status hsr_bsp_frame_begin(struct hsr_bsp_frame *frame,
                                    const struct hsr_job *job);

/* Gives all pieces to `piece` in their order: from front to back, or if
 * `backwards` from back to front. facing: +1 if the eye is in front of the
 * piece's face, -1 if it is behind. */
void hsr_bsp_frame_walk(const struct hsr_bsp_frame *frame, bool backwards,
                        void *context,
                        void (*piece)(void *context,
                                      const struct hsr_bsp_piece *piece,
                                      int facing));

/* Makes *out: the piece in the form that the services of common/exact/screen.h
 * take. It is valid until the next call. False if the piece has no sample in
 * the window, or its face is loose. */
bool hsr_bsp_frame_piece(struct hsr_bsp_frame *frame,
                         const struct hsr_bsp_piece *piece,
                         struct hsr_piece *out);

/* --- Sides ---------------------------------------------------------------- */

/* A side of a piece. Either it lies on the edge from vertex a to b; the piece
 * is where hsr_edge_side is `inside`. Or, if b is HSR_NO_ID, a plane made it,
 * that of face a; the piece is where hsr_cut_side is `inside`. As the subject
 * of a step the latter is an implied edge, of the piece's face and face a. */
struct hsr_bsp_side {
  uint32_t a, b;
  int inside;
};

static inline struct hsr_subject
hsr_bsp_side_subject(uint32_t face, const struct hsr_bsp_side *side) {
  return side->b == HSR_NO_ID ? HSR_IMPLIED(face, side->a, 0)
                              : HSR_EDGE(side->a, side->b, face);
}

/* Must each sample of the face's pieces be asked whether it is covered? So it
 * is if the face is not flat, or the near plane may cut it: then the sides of
 * its pieces do not tell. */
bool hsr_bsp_frame_is_asked(const struct hsr_bsp_frame *frame, uint32_t face);

/* Fills side[], which has room for most_corners, with the sides of a flat
 * piece, and returns how many they are. They bound the cone from the eye that
 * the piece fills, even if part of the piece is behind the eye. `out` is what
 * hsr_bsp_frame_piece made of it, and `facing` what hsr_bsp_frame_walk gave. */
uint32_t hsr_bsp_frame_sides(const struct hsr_bsp_frame *frame,
                             const struct hsr_bsp_piece *piece,
                             const struct hsr_piece *out, int facing,
                             struct hsr_bsp_side *side);

/* Is sample (i, j) inside, as to one side of a piece of `face`? On the screen a
 * side is a line, so along a row the answer changes at most once. */
static inline bool hsr_bsp_frame_inside(const struct hsr_bsp_frame *frame,
                                        uint32_t face,
                                        const struct hsr_bsp_side *side, int i,
                                        int j) {
  struct hsr_tally *tally = frame->job->tally;
  const struct hsr_screen *screen = &frame->screen;
  return side->inside ==
         (side->b == HSR_NO_ID
              ? hsr_cut_side(screen, face, side->a, i, j, tally)
              : hsr_edge_side(screen, side->a, side->b, i, j, tally));
}

/* Draws the loose faces, after all others have been drawn. In a transparent
 * picture their samples become disputed (algorithms/engines/light/glass.h). */
void hsr_bsp_frame_finish(struct hsr_bsp_frame *frame);

/* Row j of the job's ids. */
static inline uint32_t *hsr_bsp_frame_row(const struct hsr_bsp_frame *frame,
                                          int j) {
  return hsr_job_row(frame->job, j);
}

#ifdef __cplusplus
}
#endif
#endif
