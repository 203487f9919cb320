/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steps of a run as pictures for slides: what the files of this share.
 *
 * frames.c       the run, the picture, the files
 * frame_marks.c  what a step is about, over the picture
 * frame_words.c  the outline, the step in words, the counters */
#ifndef HSR_BENCH_LESSON_FRAMES_H
#define HSR_BENCH_LESSON_FRAMES_H

#include "bench/lesson/lesson.h"
#include "common/files/json/json.h"

#include <cairo.h>

/* A slide, in points: the picture's square at the left, the outline at the
 * right, the step in words beneath. */
enum {
  FRAME_WIDTH = 960,
  FRAME_HEIGHT = 540,
  FRAME_MARGIN = 20,
  FRAME_SIDE = 448,
  FRAME_LEFT = 495,
  FRAME_LINE = 15
};

struct frames {
  struct trace_run *run;
  const char *folder; /* or the PDF */
  bool png;
  cairo_surface_t *pdf; /* NULL: each is a file of its own */
  long n, done;         /* frames, and how many are drawn */
  const uint64_t *step; /* the steps that they show, from 1; NULL: evenly */
  uint64_t steps;       /* of the whole run */
  uint64_t total[HSR_MAX_COUNTERS]; /* in the whole run */
  uint64_t count[HSR_MAX_COUNTERS];
  json_t *header;    /* as of hsr trace: where the faces are */
  json_t *structure; /* as of lesson_structure_json */
  uint32_t *colour;  /* of the samples, as cairo has them; 0: not painted yet */
  uint32_t *touches; /* of the samples: how often a step looked at them */
  struct hsr_arena arena;
  struct hsr_growing lines;   /* so far: double[4], from and to */
  struct hsr_growing squares; /* so far: voxels */
  cairo_t *cairo;
  double scale; /* of the picture */
  enum hsr_status status;
  struct hsr_error *err;
};

/* The colour of each kind of step, as on the page; as RRGGBB. */
extern const unsigned frames_colour[HSR_N_STEP_KINDS];
void frames_set_colour(cairo_t *cairo, unsigned rgb, double alpha);

/* Adds the image of a face to the path. */
void frames_add_face(struct frames *f, uint32_t face);

/* Whether a window is some of the picture, not all of it. */
bool frames_is_part(const struct frames *f, const struct hsr_window *w);

/* Marks what the step is about. */
void frames_mark(struct frames *f, const struct hsr_event *event,
                 enum hsr_step_kind kind);

/* The step as a sentence: at most `size` bytes. */
void frames_say(const struct frames *f, const struct hsr_event *event,
                char *text, size_t size);

/* Draws all words of a slide. */
void frames_draw_words(struct frames *f, const struct hsr_event *event);

#endif
