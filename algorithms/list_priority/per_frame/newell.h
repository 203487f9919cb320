/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Newell's algorithm as other algorithms use it: on the faces of a window, or
 * of one layer of a picture after another. See newell.c. */
#ifndef HSR_ALGORITHMS_NEWELL_H
#define HSR_ALGORITHMS_NEWELL_H

#include "algorithms/engines/light/glass.h"
#include "algorithms/list_priority/per_frame/priority_list.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_newell {
  const struct hsr_job *job;
  struct hsr_tally *tally;
  const struct hsr_window *window;
  struct hsr_priority_list list;
  struct hsr_glass *glass; /* if the picture is transparent; else NULL */
  uint32_t *ids;           /* the last faces painted, by rows of view->m */
  size_t ids_stride;
  bool frame_buffer; /* paint on the picture, without beads */
  bool ask_all;      /* all faces are thick */

  struct hsr_growing beads;
  uint32_t free_bead;
  uint32_t *row; /* a row of the window: its first bead */
};

/* Memory from job->scratch for lists of no more than most_faces faces. The
 * rest is as hsr_list_reserve has it. HSR_E_NOMEM. */
enum hsr_status hsr_newell_reserve(struct hsr_newell *newell,
                                   const struct hsr_job *job,
                                   const struct hsr_screen *screen,
                                   struct hsr_previous *previous,
                                   size_t most_faces);

/* Solves a window, which lies within the view's. No face covers any of its
 * samples but these n. If memory runs out, list.out_of_memory is set. */
void hsr_newell_solve(struct hsr_newell *newell,
                      const struct hsr_window *window, const uint32_t *faces,
                      uint32_t n);

/* The same in parts. hsr_newell_open: a window without beads.
 * hsr_newell_paint: paints n faces over what is there.
 * hsr_newell_paint_unordered: paints one face where it is nearer than what is
 * there, sample by sample; the window is the view's. hsr_newell_show: brings
 * the beads into the picture. */
void hsr_newell_open(struct hsr_newell *newell,
                     const struct hsr_window *window);
void hsr_newell_paint(struct hsr_newell *newell, const uint32_t *faces,
                      uint32_t n);
void hsr_newell_paint_unordered(struct hsr_newell *newell, uint32_t f);
void hsr_newell_show(struct hsr_newell *newell);

/* What these count: painting, and the beads. The groups of painting's lines: the
 * segments of a piece P; and the frame buffer, which has no beads. Those of the
 * beads: a segment; and the end, where the beads are written. */
extern const struct hsr_part hsr_painting_part, hsr_beads_part;
enum {
  HSR_NEWELL_SEGMENTS = HSR_FIRST_OF(HSR_PART_PAINTING),
  HSR_NEWELL_THICKNESS,
  HSR_NEWELL_WRITTEN
};
enum { HSR_SEGMENT_LINES, HSR_FRAME_BUFFER_LINES };
enum { HSR_BEAD_MERGE = HSR_FIRST_OF(HSR_PART_BEADS) };
enum { HSR_BEAD_LINES };

#ifdef __cplusplus
}
#endif
#endif
