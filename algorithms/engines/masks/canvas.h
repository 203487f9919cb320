/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The canvas: where tiled samples go. They become ids of a picture, or are
 * added to the sums of a filtered one.
 *
 * Source      N. Greene, "Hierarchical Polygon Tiling with Coverage Masks",
 *             SIGGRAPH 1996, 4.4 and 4.5; L. Carpenter, "The A-buffer",
 *             SIGGRAPH 1984. The filters are those of common/answers/filter.h.
 * Notation    A pixel of a filtered picture is one mask of the finest level;
 *             with box64x64 it is one of the level above (1996, 9: a level
 *             more).
 * Method      The box filters count the bits of a mask. Other filters look up
 *             what each byte of a mask adds to the 3 x 3 pixels about it. */
#ifndef HSR_ALGORITHMS_TILING_CANVAS_H
#define HSR_ALGORITHMS_TILING_CANVAS_H

#include "algorithms/engines/masks/masks.h"
#include "common/answers/filter.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_canvas {
  const struct hsr_job *job; /* borrowed */
  struct hsr_window window;  /* of samples */
  uint32_t id; /* of the face that is being tiled, in job->world; or the
                  background */
  int counter; /* a step for each sample that is written */

  /* Of a filtered picture; otherwise 0. */
  struct hsr_filtering filtering;
  uint32_t *sums;  /* of the answer */
  int side;        /* samples along a side of a pixel */
  bool has_colour; /* rgb is the colour of face `id` */
  uint16_t rgb[3];
  const struct hsr_kernel *kernel;
  uint32_t whole[3][3]; /* what a whole pixel adds to the 3 x 3 about it */
};

/* Begins the canvas of a job, for a window of samples. `wide` is the kernel of
 * the job's filter, if that is not a box; borrowed. `counter` is of kind
 * HSR_ACCEPT: each sample that is written is a step of it. */
void hsr_canvas_begin(struct hsr_canvas *canvas, const struct hsr_job *job,
                      struct hsr_window window, const struct hsr_kernel *wide,
                      int counter);

/* From now on what is tiled is of this face, or HSR_BACKGROUND. */
void hsr_canvas_face(struct hsr_canvas *canvas, uint32_t id);

/* In a filtered picture: gives the colour of that face, so that it need not be
 * found. */
void hsr_canvas_colour(struct hsr_canvas *canvas, const uint16_t rgb[3]);

/* The sink by which samples are written to the canvas, which it borrows. */
struct hsr_mask_sink hsr_canvas_sink(struct hsr_canvas *canvas);

#ifdef __cplusplus
}
#endif
#endif
