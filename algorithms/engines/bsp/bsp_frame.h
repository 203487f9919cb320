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

#include "algorithms/engines/light/glass.h"
#include "algorithms/engines/bsp/bsp_walk.h"
#include "common/exact/order.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What all these algorithms count. */
extern const struct hsr_part hsr_bsp_part;
enum {
  HSR_BSP_PIECES = HSR_FIRST_OF(HSR_PART_BSP),
  HSR_BSP_SAMPLES,
  HSR_BSP_THICKNESS
};

/* `prepare` and `release` of these algorithms. */
enum hsr_status hsr_bsp_prepare(const struct hsr_world *world,
                                const long *option, void **prepared,
                                struct hsr_error *err);
void hsr_bsp_release(void *prepared);

/* The same, with a box for each node of the tree. */
enum hsr_status hsr_bsp_prepare_bounded(const struct hsr_world *world,
                                        const long *option, void **prepared,
                                        struct hsr_error *err);

struct hsr_bsp_frame {
  const struct hsr_job *job;
  const struct hsr_bsp *bsp;
  const struct hsr_box *box; /* a node: holds all that a ray sees of the pieces
                                in its subtree; NULL: not prepared */
  struct hsr_screen screen;
  struct hsr_bsp_waiting *waiting;
  bool *placed;             /* by face: in the picture, and not loose */
  uint32_t *loose, n_loose; /* in the picture */
  int *columns;             /* room for the columns of a face */
  uint32_t most_corners;    /* of a piece */
  struct hsr_glass *glass;  /* if the picture is transparent; else NULL */

  /* Whether to enter a node's subtree, with the walk's context. NULL, unless
   * the algorithm sets it after hsr_bsp_frame_begin: always. */
  bool (*enter_node)(void *context, uint32_t node);

  /* Of the piece at hand. */
  double (*outline)[3];
  struct hsr_cut *cut;
};

/* Makes a frame ready for a job, and clears the picture of ids. HSR_E_NOMEM. */
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

/* --- Sides ---------------------------------------------------------------- */

/* A side of a piece: the edge from vertex a to b, inside where hsr_edge_side is
 * `inside`; or, if b is HSR_NO_ID, the plane of face a. As the subject of a
 * step, the latter is the implied edge of both faces. */
struct hsr_bsp_side {
  uint32_t a, b;
  int inside;
};

static inline struct hsr_subject
hsr_bsp_side_subject(uint32_t face, const struct hsr_bsp_side *side) {
  return side->b == HSR_NO_ID ? HSR_IMPLIED(face, side->a, 0)
                              : HSR_EDGE(side->a, side->b, face);
}

/* Whether the sides of the face's pieces do not tell what they cover, because
 * the face is not flat, or near may cut it: each sample must be asked. */
bool hsr_bsp_frame_is_asked(const struct hsr_bsp_frame *frame, uint32_t face);

/* The sides of a flat piece, into side[], which has room for most_corners:
 * returns how many. They bound the cone from the eye that the piece fills, even
 * where part of the piece is behind the eye. `out` is what hsr_bsp_frame_piece
 * made of it, and `facing` what the walk told. */
uint32_t hsr_bsp_frame_sides(const struct hsr_bsp_frame *frame,
                             const struct hsr_bsp_piece *piece,
                             const struct hsr_piece *out, int facing,
                             struct hsr_bsp_side *side);

/* Whether sample (i, j) is on the inner side of a side of a piece of `face`. On
 * the screen a side is a line: along a row the answer changes at most once. */
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

/* Draws the loose faces, after all others. In a transparent picture, all their
 * samples are disputed. */
void hsr_bsp_frame_finish(struct hsr_bsp_frame *frame);

static inline uint32_t *hsr_bsp_frame_row(const struct hsr_bsp_frame *frame,
                                          int j) {
  return hsr_job_row(frame->job, j);
}

#ifdef __cplusplus
}
#endif
#endif
