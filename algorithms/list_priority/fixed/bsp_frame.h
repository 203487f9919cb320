/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One view of a world whose faces are in one BSP tree, without an octree: the
 * common part of the algorithms that take polygons in the tree's order.
 *
 * Source      H. Fuchs, Z. Kedem and B. Naylor, "On Visible Surface Generation
 *             by A Priori Tree Structures", SIGGRAPH 1980; N. Greene,
 *             "Hierarchical Polygon Tiling with Coverage Masks", SIGGRAPH 1996,
 *             2.1.
 * Loose       Faces are loose if the tree has no place for them, or none from
 *             this eye (common/trees/bsp.h). They come last, and are compared
 *             in depth at each sample with what is there; these comparisons are
 *             counted apart. Only faces that are not flat are loose. */
#ifndef HSR_ALGORITHMS_BSP_FRAME_H
#define HSR_ALGORITHMS_BSP_FRAME_H

#include "algorithms/list_priority/fixed/bsp_walk.h"
#include "common/exact/order.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Compiled twice, as the algorithms are. */
#define hsr_bsp_frame_begin HSR_OF_BUILD(hsr_bsp_frame_begin)
#define hsr_bsp_frame_finish HSR_OF_BUILD(hsr_bsp_frame_finish)
#define hsr_bsp_frame_piece HSR_OF_BUILD(hsr_bsp_frame_piece)
#define hsr_bsp_frame_walk HSR_OF_BUILD(hsr_bsp_frame_walk)
#define hsr_bsp_prepare HSR_OF_BUILD(hsr_bsp_prepare)
#define hsr_bsp_release HSR_OF_BUILD(hsr_bsp_release)

/* The counters that all have, before their own. */
enum { HSR_BSP_PIECES, HSR_BSP_SAMPLES, HSR_BSP_THICKNESS, HSR_BSP_N_COUNTERS };
#define HSR_BSP_COUNTERS                                                       \
  [HSR_BSP_PIECES] = {"pieces",                                                \
                      "pieces of faces in the order of the tree, with a "      \
                      "sample in their box",                                   \
                      HSR_ACTIVATE, HSR_OF_PIECE, HSR_OF_WINDOW},              \
  [HSR_BSP_SAMPLES] = {"samples", "samples written", HSR_ACCEPT, HSR_OF_FACE,  \
                       HSR_OF_WINDOW},                                         \
  [HSR_BSP_THICKNESS] = {                                                      \
      "thickness checks",                                                      \
      "comparisons in depth with faces that are not flat and have no place "   \
      "in the tree",                                                           \
      HSR_COMPARE,                                                             \
      HSR_OF_FACE,                                                             \
      HSR_OF_FACE,                                                             \
      "farther|nearer"}

/* `prepare` and `release` of these algorithms. */
enum hsr_status hsr_bsp_prepare(const struct hsr_world *world,
                                const long *option, void **prepared,
                                struct hsr_error *err);
void hsr_bsp_release(void *prepared);

struct hsr_bsp_frame {
  const struct hsr_job *job;
  const struct hsr_bsp *bsp;
  struct hsr_screen screen;
  struct hsr_bsp_waiting *waiting;
  bool *placed;             /* by face: in the picture, and not loose */
  uint32_t *loose, n_loose; /* in the picture */
  int *columns;             /* room for the columns of a face */
  uint32_t most_corners;    /* of a piece */

  /* Of the piece at hand. */
  double (*outline)[3];
  struct hsr_cut *cut;
};

/* Makes a frame ready for a job, and clears the picture. HSR_E_NOMEM. */
enum hsr_status hsr_bsp_frame_begin(struct hsr_bsp_frame *frame,
                                    const struct hsr_job *job);

/* Goes through all pieces in order, from back to front if `backwards`. */
void hsr_bsp_frame_walk(const struct hsr_bsp_frame *frame, bool backwards,
                        void *context,
                        void (*piece)(void *context,
                                      const struct hsr_bsp_piece *piece,
                                      int facing));

/* The piece as the services of common/exact/screen.h take it; valid until the
 * next call. False if it has no sample, or its face is loose. */
bool hsr_bsp_frame_piece(struct hsr_bsp_frame *frame,
                         const struct hsr_bsp_piece *piece,
                         struct hsr_piece *out);

/* Draws the loose faces, after all others. */
void hsr_bsp_frame_finish(struct hsr_bsp_frame *frame);

static inline uint32_t *hsr_bsp_frame_row(const struct hsr_bsp_frame *frame,
                                          int j) {
  return frame->job->ids + (size_t)j * frame->job->ids_stride;
}

#ifdef __cplusplus
}
#endif
#endif
