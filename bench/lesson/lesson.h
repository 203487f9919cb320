/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr lesson: what the parts of this folder share. The page itself is under
 * reports/lesson; its data/trace.js reads what is written here.
 *
 * bytes.c      bytes that grow, numbers in them, and their compression
 * recorder.c   the listener: the events of a run, in columns
 * lists.c      the pieces of a priority list, from the events
 * structure.c  trees of planes, and cubes, as the algorithm has them
 * grids.c      the cells of a grid
 * volumes.c    the bodies and volumes of Roberts
 * planes.c     planes, as far as the scene goes
 * describe.c   what the columns mean: header, answer, predictions
 * draw.c       a run of one algorithm, as a text for the page
 * page.c       the file
 * survey.c     the lessons through the survey
 * survivors.c  what the ten have left after each cull and sort
 * tree.c       the ten in the survey's tree, as a drawing
 * frames.h     steps as pictures
 * command.c    the options
 *
 * One algorithm is one text in base64. It is a zlib stream of
 *
 *   the length of a JSON text, 4 bytes, least first; the JSON text;
 *   the counter of each event, a byte each;
 *   for each counter and each field of enum lesson_field: its values in the
 *   counter's events, each as the difference to the one before (from 0).
 *
 * A number x takes 2x, or -2x - 1 if it is negative, in groups of seven bits,
 * least first; all bytes but its last have bit 7 set. */
#ifndef HSR_BENCH_LESSON_H
#define HSR_BENCH_LESSON_H

#include "bench/modules/variant.h"
#include "bench/trace/trace.h"

#include <jansson.h>

/* --- Bytes ---------------------------------------------------------------- */

/* All zero at the start. */
struct lesson_bytes {
  unsigned char *at;
  size_t n, room;
  bool failed; /* memory ran out; nothing more is added */
};

void lesson_add(struct lesson_bytes *bytes, const void *from, size_t n);
void lesson_add_number(struct lesson_bytes *bytes, int64_t number);
void lesson_bytes_free(struct lesson_bytes *bytes);

/* Compressed by zlib, as base64; to be freed. NULL: HSR_E_NOMEM. */
char *lesson_squeeze(const struct lesson_bytes *bytes);

/* --- The listener --------------------------------------------------------- */

/* What is recorded of an event, beside its counter. Where there is no number,
 * -1. The part is its place in the list of parts, or of shapes if the step is not of
 * kind HSR_ACCEPT, from 1; 0: none. */
enum lesson_field {
  LESSON_A_KIND,
  LESSON_A0,
  LESSON_A1,
  LESSON_A2,
  LESSON_B_KIND,
  LESSON_B0,
  LESSON_B1,
  LESSON_B2,
  LESSON_X,
  LESSON_Y,
  LESSON_WIDTH,
  LESSON_HEIGHT,
  LESSON_OUTCOME,
  LESSON_PART,
  LESSON_N_FIELDS
};

/* The events of one counter. */
struct lesson_column {
  int64_t last[LESSON_N_FIELDS];
  struct lesson_bytes field[LESSON_N_FIELDS];
};

struct lesson_recorder {
  struct trace_run *run; /* borrowed */
  uint64_t most;         /* events beyond these are only counted and painted */
  uint64_t events, kept;
  uint64_t count[HSR_MAX_COUNTERS];
  struct lesson_bytes counters; /* of the events kept */
  struct lesson_column column[HSR_MAX_COUNTERS];
  json_t *parts;
  json_t *shapes; /* what steps are about that add nothing to the answer */
  json_t *places; /* of each shape, by its text, in the list, from 1 */
  bool has_list;
  struct lesson_bytes notes; /* of its list */
};

/* Hears one event: the `listen` of a struct hsr_trace. */
void lesson_listen(void *recorder, const struct hsr_event *event);
void lesson_recorder_free(struct lesson_recorder *recorder);

/* --- Beside the scene ----------------------------------------------------- */

/* Whether the algorithm has a counter of that key. */
bool lesson_has_counter(const struct hsr_algorithm *algorithm, const char *key);

/* Whether the algorithm makes lists of priority in every frame. */
bool lesson_has_list(const struct hsr_setup *setup);

/* Notes an event of counter `c` of such an algorithm. */
void lesson_note_list(struct lesson_bytes *notes, const struct hsr_counter *c,
                      const struct hsr_event *event);

/* The lists, in order: [{from: the number of the first event, pieces: [[face,
 * the number of the piece that was divided or -1, bucket, outline or
 * null], ...]}, ...]. A new reference, NULL for lack of memory. */
json_t *lesson_lists_json(const struct trace_run *run,
                          const struct lesson_bytes *notes);

/* What the algorithm made before the frame: a new reference to an object, whose
 * members are there if the algorithm has such.
 *
 *   separators  [[face or null, axis, at, in front, behind], ...]; a side is a
 *               separator, or -1 - c, where c is a cluster
 *   root        of these, as a side
 *   clusters    the faces of each, of the highest priority first
 *   nodes       of BSP trees: [face, in front, behind, first piece, pieces];
 *               -1: nothing
 *   roots       the roots among these nodes
 *   pieces      of these trees: [face, outline]
 *   bases       [face, b], ..., by faces: from that face on, the algorithm's
 *   own
 *               number of a piece, added to b, is its place in pieces
 *   cubes       of octrees, or boxes in them: [node, instance or -1, the images
 *   of its corners, or
 *               null for those that have none]; isBoxes: boxes of the algorithm's
 *               own, [a, b, corners, image] for its subject HSR_CELL(a, b, 0); the
 *               image of one that is a rectangle, else null
 *
 *   bodies      of an algorithm that puts edges to volumes: the faces of each
 *   volumes     likewise: the faces in whose planes each one is
 *   sides       of these, on which side of each plane the volume is: 1 before it
 *   parts       [volume, images of its sides], ..., of volumes that are parts of a
 *               concave solid; a side need not be a face
 *
 *   numbered    what the cells of the steps are: "texels" of a texture, "entries" of
 *               a table, "squares" of the picture (enum hsr_numbered)
 *
 * NULL: HSR_E_NOMEM. */
json_t *lesson_structure_json(const struct trace_run *run);

/* Whether the cells of the steps are texels of a texture, or entries of a table of it. */
bool lesson_has_texels(const struct hsr_setup *setup);

/* Whether the scene is a grid whose cells the steps name by number, and these as
 * cubes of instance 0. Then there are also the members
 *
 *   isGrid   true
 *   places   where each cell is in the grid, along the three axes
 *   bounds   along each axis, the planes between its cells
 *   eyeCell  along each axis, the cell that holds the eye: hsr_grid_split
 *   gridParts  the parts that the algorithm goes by (enum hsr_grid_parts): "slices",
 *            "octants", "turns", "children", or "whole" for none
 *
 * Not where the algorithm shows boxes, cubes or a tree of its own: its cells are nodes
 * of these. False: HSR_E_NOMEM. */
bool lesson_has_cells(const struct trace_run *run);
bool lesson_add_cells(json_t *structure, const struct trace_run *run);

/* Where a kept cell is in a grid, along the three axes. False: there is no such cell. */
bool lesson_place_of_cell(const struct hsr_grid *grid, uint32_t cell,
                          uint32_t at[3]);

/* Along each axis, the cell that holds the eye, as in eyeCell. */
void lesson_eye_cell(const struct trace_run *run, int32_t at[3]);

/* Whether the algorithm puts edges to volumes, and these. False: HSR_E_NOMEM. */
bool lesson_has_volumes(const struct hsr_setup *setup);
bool lesson_add_volumes(json_t *structure, const struct trace_run *run);

/* --- Planes --------------------------------------------------------------- */

struct lesson_plane {
  double normal[3], offset; /* normal . x = offset */
};

struct lesson_plane lesson_plane_of_face(const struct hsr_mesh *mesh,
                                         uint32_t face);

/* Corners of a plane's part in the box of a scene, at most: rounding aside there
 * are six, and a plane through corners of the box finds each of these three times.
 * And corners of any polygon below. */
enum { LESSON_MOST_CORNERS = 12, LESSON_MOST_POINTS = 64 };

/* The part of a plane in the box of the scene, in order around its middle. Returns how
 * many corners it has. */
int lesson_plane_in_box(const struct hsr_mesh *mesh,
                        const struct lesson_plane *plane, double (*at)[3]);

/* The image of a polygon, or of a line, of n <= LESSON_MOST_POINTS points of the
 * world, as trace_polygon_json. */
json_t *lesson_image_json(const struct hsr_view *view, const double (*at)[3],
                          int n);

/* --- What it means -------------------------------------------------------- */

/* The JSON text at the head: a new reference, NULL for lack of memory. The
 * tally is that of the run. `table` is NULL where nothing is predicted. */
json_t *lesson_describe(const struct lesson_recorder *recorder,
                        const struct hsr_tally *tally,
                        const struct hsr_table1 *table);

/* Parts of it: how often each counter was raised; the steps of Table III,
 * a list of {label, terms: [[counter, factor], ...], formula, predicted}; the
 * letters of the formulas, a list of [symbol, meaning, measured]. What is not
 * predicted or measured is null. New references, NULL for lack of memory. */
json_t *lesson_counts_json(const struct hsr_algorithm *algorithm,
                           const uint64_t *count);
json_t *lesson_costs_json(const struct hsr_algorithm *algorithm,
                          const struct hsr_table1 *table);
json_t *lesson_letters_json(const struct hsr_table1 *table);

/* Whether the survey predicts any of these steps. */
bool lesson_predicts(const struct hsr_algorithm *algorithm);

/* --- One algorithm -------------------------------------------------------- */

/* What a run told, before it is compressed. All zero at the start. */
struct lesson_record {
  struct lesson_bytes bytes; /* the caller's to free */
  uint64_t events, kept;
};

/* Draws a run that was begun, and records at most `most` of its events.
 * record->bytes is to be freed also after a failure. Fails as hsr trace does. */
enum hsr_status lesson_record(struct trace_run *run, long most,
                              struct lesson_record *record,
                              struct hsr_error *err);

/* The most faces that a scene may have. */
enum { LESSON_MOST_FACES = 20000 };

/* What is drawn, and by which algorithm. All borrowed. */
struct lesson_subject {
  const struct scene_options *scene;
  const struct view_options *view;
  const struct hsr_variant *variant;
};

/* How much is shown of a run. */
struct lesson_limits {
  uint32_t faces; /* a scene of more is refused */
  long events;    /* those beyond are only counted and painted */
};

/* Runs the algorithm and gives the text of its run, to be freed. Says on stderr
 * if there are more events than may be kept. Fails as hsr trace does. */
enum hsr_status lesson_draw(const struct lesson_subject *subject,
                            const struct lesson_limits *limits, char **text,
                            struct hsr_error *err);

/* Which steps of a run are drawn, and how. */
struct lesson_slides {
  const char *folder;   /* which exists; or a file of PDF; borrowed */
  long n;               /* steps */
  const uint64_t *step; /* their numbers, from 1, ascending; borrowed. NULL: n
                           steps evenly over the run, the last one too */
  bool png;             /* as .png files, not .svg */
};

/* Draws steps of a run as files. Fails as hsr trace does; HSR_E_INPUT if a file
 * cannot be written; HSR_E_USAGE if the run has not so many steps. */
enum hsr_status lesson_frames(const struct lesson_subject *subject,
                              const struct lesson_slides *slides,
                              struct hsr_error *err);

/* Draws them of n subjects as pages of one file of PDF. Fails likewise; then
 * there is no file. */
enum hsr_status lesson_pdf(const struct lesson_subject *subject, int n,
                           const struct lesson_slides *slides,
                           struct hsr_error *err);

/* --- The page ------------------------------------------------------------- */

struct lesson_page {
  const char *path; /* all borrowed */
  const struct lesson_subject *subject;
  int n;
  struct lesson_limits limits; /* of each run */
  bool is_survey;              /* the subjects are the lessons of survey.def */
  const char *lab; /* the address of the laboratory: each lesson leads to its
                      scene there. A scene that is not made by its name is the one
                      that hsr lab has put into it. NULL: none leads there */
};

/* Writes the whole file, or none. HSR_E_INPUT if it cannot be written. */
enum hsr_status lesson_write(const struct lesson_page *page,
                             struct hsr_error *err);

/* The survey's ten algorithms, by name, in the order of its figure 13. */
enum { LESSON_TEN = 10 };
extern const char *const lesson_ten[LESSON_TEN];

/* Draws the tree of that figure with those of the ten that the program has, as SVG.
 * HSR_E_INPUT if the file cannot be written. */
enum hsr_status lesson_tree(const char *path, struct hsr_error *err);

/* What the survey's ten algorithms have left after each cull and sort, of one
 * scene: {"scene": name, "letters": ..., "algorithms": [{"name", "title",
 * "costs", "counts"}, ...]}, the last two as in the text of a run. *survivors is
 * a new reference. Fails as hsr trace does. */
enum hsr_status lesson_survivors(json_t **survivors, struct hsr_error *err);

/* The most events of an algorithm, unless the user says otherwise. */
enum { LESSON_STANDARD_EVENTS = 2000000 };

/* Writes the lessons of survey.def, of those algorithms that the program has, with
 * `lab` as in struct lesson_page; and the names of these, as a new reference, NULL for lack of memory. Fails as
 * lesson_write. */
enum hsr_status lesson_survey(const char *path, long events, const char *lab,
                              struct hsr_error *err);
json_t *lesson_survey_names(void);

#endif
