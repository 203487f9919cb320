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

/* Counters and steps as those of priority_list.h: those of painting, and those
 * of beads. */
enum {
  HSR_NEWELL_SEGMENTS = HSR_N_LIST_COUNTERS,
  HSR_NEWELL_THICKNESS,
  HSR_NEWELL_WRITTEN,
  HSR_BEAD_MERGE,
  HSR_N_NEWELL_COUNTERS
};
#define HSR_PAINTING_COUNTERS(of)                                              \
  HSR_LIST_COUNTERS(of),                                                       \
      {of "segments", "segments generated", HSR_SPAN, HSR_OF_FACE,             \
       HSR_OF_WINDOW},                                                         \
      {of "thickness checks",                                                  \
       "comparisons in depth where faces that are not flat touch",             \
       HSR_COMPARE,                                                            \
       HSR_OF_FACE,                                                            \
       HSR_OF_FACE,                                                            \
       "farther|nearer"},                                                      \
  {                                                                            \
    of "spans written", "runs of samples of one face written to the picture",  \
        HSR_ACCEPT, HSR_OF_FACE, HSR_OF_WINDOW                                 \
  }
#define HSR_NEWELL_COUNTERS(of)                                                \
  HSR_PAINTING_COUNTERS(of), {                                                 \
    of "X merge",                                                              \
        "beads passed to find the place of a segment, or covered "             \
        "by it",                                                               \
        HSR_COMPARE, HSR_OF_FACE, HSR_OF_WINDOW, "passed|covered"              \
  }

/* Outlines as in priority_list.h. With beads, the segments are written last. */
#define HSR_SEGMENTS_OUTLINE(first, in)                                        \
  HSR_LIST_OUTLINE(first, in),                                                 \
      {in "  generate the segments of P",                                      \
       HSR_RAISES((first) + HSR_NEWELL_SEGMENTS)},                             \
  {                                                                            \
    in "    of thick faces: is P nearer than what is there?",                  \
        HSR_RAISES((first) + HSR_NEWELL_THICKNESS)                             \
  }
#define HSR_PAINTING_OUTLINE(first, in)                                        \
  HSR_SEGMENTS_OUTLINE(first, in), {                                           \
    in "    paint the segment on the frame buffer",                            \
        HSR_RAISES((first) + HSR_NEWELL_WRITTEN)                               \
  }
#define HSR_NEWELL_OUTLINE(first, in)                                          \
  HSR_SEGMENTS_OUTLINE(first, in),                                             \
      {in "    merge it among the beads of its scan line: it overwrites them", \
       HSR_RAISES((first) + HSR_BEAD_MERGE)},                                  \
  {                                                                            \
    in "show the beads of every scan line",                                    \
        HSR_RAISES((first) + HSR_NEWELL_WRITTEN)                               \
  }

#define HSR_PAINTING_STEPS(first, of) HSR_PAINTING_STEPS_WITH(first, of, {0, 0})
#define HSR_PAINTING_STEPS_WITH(first, of, ...)                                \
  HSR_LIST_STEPS_WITH(first, of, __VA_ARGS__), {                               \
    of "segment generator, Y sort", first + HSR_NEWELL_SEGMENTS, 10,           \
        "10 F_r H_f", hsr_predict_segments                                     \
  }
#define HSR_NEWELL_STEPS(first, of) HSR_NEWELL_STEPS_WITH(first, of, {0, 0})
/* The same; the special sort takes these terms more. */
#define HSR_NEWELL_STEPS_WITH(first, of, ...)                                  \
  HSR_PAINTING_STEPS_WITH(first, of, __VA_ARGS__), {                           \
    of "X merge", first + HSR_BEAD_MERGE, 1, "F_r H_f S_v / 4",                \
        hsr_predict_bead_merge                                                 \
  }
#define HSR_BEAD_SORTS                                                         \
  {"segments", "Y", "bucket sort", "once a frame"}, {                          \
    "beads", "X", "merge", "once a segment"                                    \
  }

static inline double hsr_predict_segments(const struct hsr_table1 *t) {
  return 10 * t->F_r * t->H_f;
}
static inline double hsr_predict_bead_merge(const struct hsr_table1 *t) {
  return t->F_r * t->H_f * t->S_v / 4;
}

#ifdef __cplusplus
}
#endif
#endif
