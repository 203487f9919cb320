/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where tiled samples go: ids of a picture, or sums of a filtered one.
 *
 * Source      N. Greene, "Hierarchical Polygon Tiling with Coverage Masks",
 *             SIGGRAPH 1996, 4.4 and 4.5; L. Carpenter, "The A-buffer",
 *             SIGGRAPH 1984. The filters are those of common/answers/filter.h.
 * Notation    a pixel of a filtered picture is one mask of the finest level; of
 *             box64x64, one of the level above (1996, 9: a level more).
 *             The box filters count the bits of a mask. Other filters look
 *             up what each byte of a mask adds to the 3 x 3 pixels about it. */
#ifndef HSR_ALGORITHMS_TILING_CANVAS_H
#define HSR_ALGORITHMS_TILING_CANVAS_H

#include "algorithms/engines/masks/masks.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_canvas {
  const struct hsr_job *job;
  struct hsr_window window; /* of samples */
  uint32_t id;              /* of the face in hand: of job->world */
  int counter;              /* raised for each sample that is written */

  /* Of a filtered picture; or all 0. */
  struct hsr_filtering filtering;
  uint32_t *sums;  /* of the answer */
  int side;        /* samples along a side of a pixel */
  bool has_colour; /* rgb is that of the face in hand */
  uint16_t rgb[3];
  const struct hsr_kernel *kernel;
  uint32_t whole[3][3]; /* what a whole pixel adds to those about it */
};

/* `wide` is the kernel of a filter that is not the box; borrowed. `counter` is of
 * kind HSR_ACCEPT: each sample that is written raises it. */
void hsr_canvas_begin(struct hsr_canvas *canvas, const struct hsr_job *job,
                      struct hsr_window window, const struct hsr_kernel *wide,
                      int counter);

/* What is tiled next is of this face. */
void hsr_canvas_face(struct hsr_canvas *canvas, uint32_t id);

/* The same of a filtered picture, whose colour is known. */
void hsr_canvas_colour(struct hsr_canvas *canvas, const uint16_t rgb[3]);

struct hsr_mask_sink hsr_canvas_sink(struct hsr_canvas *canvas);

#ifdef __cplusplus
}
#endif
#endif
