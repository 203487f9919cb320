/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Newell's algorithm as other modules use it: on the faces of one window, or of
 * one layer of a picture after another. See newell.c for the algorithm and its
 * source.
 *
 * A bead is a visible segment of a row; it is kept until a later face covers
 * it. */
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
  uint32_t *ids; /* the faces painted last, by rows ids_stride apart */
  size_t ids_stride;
  bool frame_buffer; /* paint into the picture itself, without beads */
  bool ask_all;      /* take all faces as thick (priority_list.h) */

  struct hsr_growing beads;
  uint32_t free_bead; /* the first of a list of beads to be reused */
  uint32_t *row;      /* by row of the window: its first bead */
};

/* Begins a frame whose lists have no more than most_faces faces. The arguments
 * are as of hsr_list_reserve. Memory from job->scratch. HSR_E_NOMEM. */
enum hsr_status hsr_newell_reserve(struct hsr_newell *newell,
                                   const struct hsr_job *job,
                                   const struct hsr_screen *screen,
                                   struct hsr_keeper *keeper,
                                   size_t most_faces);

/* Solves a window, which lies within the view's: writes the visible face of all
 * its samples. These n faces are all that cover a sample of it. Sets
 * list.out_of_memory if memory runs out. */
void hsr_newell_solve(struct hsr_newell *newell,
                      const struct hsr_window *window, const uint32_t *faces,
                      uint32_t n);

/* The same in steps. hsr_newell_open: begins a window, without beads.
 * hsr_newell_paint: puts n faces in order and paints them over what is there.
 * hsr_newell_paint_unordered: paints one face where it is nearer than what is
 * there, sample by sample; the window is the view's. hsr_newell_show: writes
 * the beads to the picture. */
void hsr_newell_open(struct hsr_newell *newell,
                     const struct hsr_window *window);
void hsr_newell_paint(struct hsr_newell *newell, const uint32_t *faces,
                      uint32_t n);
void hsr_newell_paint_unordered(struct hsr_newell *newell, uint32_t f);
void hsr_newell_show(struct hsr_newell *newell);

/* The parts of painting and of the beads, with their counters. Groups of lines
 * of painting's outline: the segments of a piece P; and the frame buffer, which
 * needs no beads. Of the beads' outline: a segment; and the end, where beads
 * are written. */
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
