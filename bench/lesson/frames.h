/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steps of a run as pictures for slides: what the files of this share.
 *
 * frames.c           the run, the picture, the files
 * frame_marks.c      what a step is about, over the picture
 * frame_boxes.c      boxes that are compared
 * frame_cells.c      cubes and other cells
 * frame_planes.c     planes
 * frame_tests.c      what the tests of a priority list ask about, and markers
 * frame_fragments.c  what a volume hides of an edge
 * frame_halves.c     what a step divides in two
 * frame_words.c      the outline, the step in words, the counters */
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

/* A line is drawn like this. */
enum frame_dash { FRAME_SOLID, FRAME_DASHED, FRAME_DOTTED };

enum { FRAME_INK = 0x1d1f22 };

struct frame_look {
  unsigned colour;
  double fill, width; /* a strength from 0 to 1; points */
  enum frame_dash dash;
};

enum { FRAME_MOST_FRAGMENTS = 64 };

/* The fragments of the edge that is at hand, as shares of it. All zero at the
 * start. */
struct frame_fragments {
  uint32_t edge[2];
  int n; /* waiting */
  double waiting[FRAME_MOST_FRAGMENTS][2];
  double at[2], hidden[2]; /* at this step */
  double next[2];          /* what is left after it */
  bool hides;              /* something of it */
  bool is_begun, is_known, is_shown, is_after_test;
};

enum { FRAME_MOST_PARTS = 32 };

/* Samples of a search that are divided: their right part begins at `middle`. */
struct frame_part {
  double at[2][2]; /* the stretches of both */
  int middle, r, outcome;
  bool is_second; /* the right part is searched, the left one had `outcome` */
};

/* A logarithmic search, of two segments of a row. All zero at the start. */
struct frame_search {
  uint32_t face[2];
  int row, l, r;   /* the samples that are searched now */
  double at[2][2]; /* the stretches that are compared, in samples */
  int n;
  struct frame_part part[FRAME_MOST_PARTS];
  double middle, kept[2]; /* of the last division */
  bool keeps, is_left,
      is_other; /* of it: a half, the left one, of the shorter */
  bool is_known, is_shown;
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
  json_t *header;             /* as of hsr trace: where the faces are */
  json_t *structure;          /* as of lesson_structure_json */
  bool has_list;              /* the algorithm makes lists of priority */
  json_t *lists;              /* as of lesson_lists_json */
  struct lesson_bytes notes;  /* of them */
  struct hsr_growing visited; /* cells, as frame_cells.c has them */
  struct hsr_growing read; /* texels read for the pixel at hand: uint32_t[3] */
  uint32_t segment;        /* the face of the last segment; HSR_NO_ID: none */
  json_t *clip;   /* the polygon that pieces are compared with; NULL: none */
  json_t *voxels; /* what the answer says of them; NULL: none */
  size_t list;    /* lists that have begun */
  struct hsr_growing
      marked;    /* pieces of the last one with a marker: uint32_t */
  uint32_t head; /* its P; HSR_NO_ID: not known */
  bool has_third[HSR_MAX_COUNTERS][2]; /* a counter's a, b: cells with a third
                                          number, which cubes have not */
  struct hsr_growing textures;         /* as frame_cells.c has them */
  struct frame_fragments fragments;
  struct frame_search search;
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

/* Whether the step's counter, or its outcome, has this key. */
bool frames_has_key(const struct frames *f, const struct hsr_event *event,
                    const char *key);
bool frames_has_outcome(const struct frames *f, const struct hsr_event *event,
                        const char *key);

/* Add to the path: the image of a face, a polygon, a line between two points;
 * what is no list of points is left out. */
void frames_add_face(struct frames *f, uint32_t face);
void frames_add_polygon(struct frames *f, const json_t *polygon);
void frames_add_line(struct frames *f, const json_t *from, const json_t *to);

/* Strokes the path, on a pale seam. */
void frames_stroke(struct frames *f, unsigned colour, double width,
                   enum frame_dash dash);

/* Borrowed: the image of a face; the outline of a piece at this event, NULL if it
 * is all of its face or not known; the faces of a volume, or of a body where the
 * step is about bodies. */
const json_t *frames_image(const struct frames *f, uint32_t face);
const json_t *frames_outline(const struct frames *f,
                             const struct hsr_event *event,
                             const struct hsr_subject *piece);
const json_t *frames_faces_of_volume(const struct frames *f,
                                     const struct hsr_event *event,
                                     const struct hsr_subject *volume);

/* Whether the step is about whole bodies, by its words: its volumes are numbers of
 * these. */
bool frames_is_of_body(const struct frames *f, const struct hsr_event *event);

/* Borrowed: the pieces of the priority list that is at hand; NULL: there is none. */
const json_t *frames_list_at(const struct frames *f,
                             const struct hsr_event *event);

/* The place of a piece of a BSP tree among those of all trees. */
json_int_t frames_place_of_piece(const struct frames *f,
                                 const struct hsr_subject *piece);

/* Mark the boxes that the step compares, and the planes that it asks about. */
void frames_mark_boxes(struct frames *f, const struct hsr_event *event);
void frames_mark_planes(struct frames *f, const struct hsr_event *event,
                        unsigned colour);
void frames_mark_plane_of(struct frames *f, json_int_t face,
                          const struct frame_look *look);

/* Marks a subject that is a cell. frames_note_cells and frames_note_texel are to be
 * called for each event, before any is drawn. False: memory ran out. */
void frames_mark_cell(struct frames *f, const struct hsr_event *event,
                      const struct hsr_subject *subject, unsigned colour,
                      enum frame_dash dash);
void frames_note_cells(struct frames *f, const struct hsr_event *event);
bool frames_note_texel(struct frames *f, const struct hsr_event *event);

/* Mark what a test of the list asks about; and the pieces of the step that bear a
 * marker. frames_follow_markers notes who bears one: to be called for each event in
 * order. False: memory ran out. */
void frames_mark_test(struct frames *f, const struct hsr_event *event);
void frames_mark_markers(struct frames *f, const struct hsr_event *event);
bool frames_follow_markers(struct frames *f, const struct hsr_event *event);

/* Notes the window through which a cell is looked at: to be called for each event in
 * order. False: memory ran out. */
bool frames_follow_visits(struct frames *f, const struct hsr_event *event);

/* Notes the texels that are read for a pixel: to be called for each event in order.
 * frames_mark_read marks those so far. False: memory ran out. */
bool frames_follow_texels(struct frames *f, const struct hsr_event *event);
void frames_mark_read(struct frames *f, const struct hsr_event *event,
                      unsigned colour);

/* Notes the polygon that later pieces are compared with, and the face of a segment: to
 * be called for each event in order. */
void frames_follow_shapes(struct frames *f, const struct hsr_event *event);

/* Notes a step of an edge and a volume: to be called for each event in order.
 * frames_mark_fragment marks the fragment of the last one, and what the volume
 * hides of it; false: the step has none. */
void frames_follow_fragments(struct frames *f, const struct hsr_event *event);
bool frames_mark_fragment(struct frames *f, const struct hsr_event *event,
                          unsigned colour);

/* Notes a step of a logarithmic search: to be called for each event in order.
 * frames_mark_midpoint marks where the last one divided a segment, and the half
 * that is kept, if it was a division. */
void frames_follow_search(struct frames *f, const struct hsr_event *event);
void frames_mark_midpoint(struct frames *f);

/* Marks the halves of a piece, and between them the line of the plane. */
void frames_mark_halves(struct frames *f, const struct hsr_event *event,
                        unsigned colour);

/* Whether a window is some of the picture, not all of it. */
bool frames_is_part(const struct frames *f, const struct hsr_window *w);

/* Marks what the step is about. */
void frames_mark(struct frames *f, const struct hsr_event *event,
                 enum hsr_step_kind kind);

/* The step as a sentence: at most `size` bytes. */
void frames_say(const struct frames *f, const struct hsr_event *event,
                char *text, size_t size);

/* The word of an outcome; empty if it has none. */
void frames_say_outcome(const struct hsr_counter *counter, int outcome,
                        char *text, size_t size);

/* Draws all words of a slide. */
void frames_draw_words(struct frames *f, const struct hsr_event *event);

#endif
