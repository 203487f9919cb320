/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Steps of a run as pictures for slides: what the files of this share.
 *
 * frames.c           the run, the picture, the files
 * frame_marks.c      what a step is about, over the picture
 * frame_shapes.c     pieces that clip polygons have cut
 * frame_boxes.c      boxes that are compared
 * frame_cells.c      cubes and other cells
 * frame_planes.c     planes
 * frame_tests.c      what the tests of a priority list ask about, and markers
 * frame_fragments.c  what a volume hides of an edge
 * frame_halves.c     what a step divides in two
 * frame_rows.c       rows, slices and octants of a grid
 * frame_list.c       the list of priority, beneath the picture
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

/* A piece of the list of priority, or a face of a list of faces. */
struct frame_item {
  uint32_t face, piece; /* HSR_NO_ID: it is a face */
  bool is_marked;
};

/* The list. All zero at the start; its parts are of frame_list.c. */
struct frame_list {
  struct hsr_growing notes, ops;
  size_t done; /* of ops */
  struct hsr_growing painted,
      order; /* struct frame_item: done; to come, the next one first */
  const json_t
      *pieces; /* of the list at hand, as of lesson_lists_json; borrowed */
  bool is_there, is_sorting;
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
  json_t *later;  /* as frame_shapes.c has them; NULL: none */
  json_t *voxels; /* what the answer says of them; NULL: none */
  struct hsr_growing rows;    /* as frame_rows.c has them */
  struct hsr_growing regions; /* as frame_cells.c has them */
  struct frame_list list;
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

/* The colour of a face, or of HSR_BACKGROUND, as RRGGBB. */
unsigned frames_face_colour(const struct frames *f, uint32_t face);

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

/* Marks a subject that is a cell. frames_note_cells, frames_note_texel and
 * frames_note_region are to be called for each event, before any is drawn. False:
 * memory ran out. */
void frames_mark_cell(struct frames *f, const struct hsr_event *event,
                      const struct hsr_subject *subject, unsigned colour,
                      enum frame_dash dash);
void frames_note_cells(struct frames *f, const struct hsr_event *event);
bool frames_note_texel(struct frames *f, const struct hsr_event *event);
bool frames_note_region(struct frames *f, const struct hsr_event *event);

/* Mark what a test of the list asks about; and the pieces of the step that bear a
 * marker. */
void frames_mark_test(struct frames *f, const struct hsr_event *event);
void frames_mark_markers(struct frames *f, const struct hsr_event *event);

/* The list. frames_note_list is to be called for each event, before any is drawn, and
 * frames_make_list after them all; frames_follow_list then for each event in order.
 * False: memory ran out. Whether a subject is a piece with a marker; draw the pieces
 * that are kept in rows, and the strip beneath the picture. */
bool frames_note_list(struct frames *f, const struct hsr_event *event);
bool frames_make_list(struct frames *f);
bool frames_follow_list(struct frames *f, const struct hsr_event *event);
bool frames_is_marked(const struct frames *f, const struct hsr_subject *s);
void frames_draw_kept(struct frames *f, const struct hsr_event *event);
void frames_draw_list(struct frames *f, const struct hsr_event *event);

/* Rows of cells of a grid. frames_note_rows is to be called for each event, before any
 * is drawn. False: memory ran out. frames_mark_rows marks the row that a step begins,
 * and the part of the grid that it is in. */
bool frames_note_rows(struct frames *f, const struct hsr_event *event);
void frames_mark_rows(struct frames *f, const struct hsr_event *event,
                      unsigned colour);

/* Notes the window through which a cell is looked at: to be called for each event in
 * order. False: memory ran out. */
bool frames_follow_visits(struct frames *f, const struct hsr_event *event);

/* Notes the texels that are read for a pixel: to be called for each event in order.
 * frames_mark_read marks those so far. False: memory ran out. */
bool frames_follow_texels(struct frames *f, const struct hsr_event *event);
void frames_mark_read(struct frames *f, const struct hsr_event *event,
                      unsigned colour);

/* Notes the face of a segment: to be called for each event in order. */
void frames_follow_segments(struct frames *f, const struct hsr_event *event);

/* Pieces that steps tell. frames_note_shapes is to be called for each event, before any
 * is drawn. False: memory ran out. frames_follow_clip notes the polygon that later
 * pieces are compared with: to be called for each event in order. frames_mark_shapes
 * marks the piece of a step, and what it is compared with; false: the step tells
 * none. */
bool frames_note_shapes(struct frames *f, const struct hsr_event *event);
void frames_follow_clip(struct frames *f, const struct hsr_event *event);
bool frames_mark_shapes(struct frames *f, const struct hsr_event *event,
                        unsigned colour);

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
