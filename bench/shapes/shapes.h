/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What algorithms work with, as shapes in world space: the cubes of octrees, the
 * cells of BSP trees, separating planes, frusta, and spans. For hsr export and
 * hsr view. The shapes are for looking at: their corners are rounded. */
#ifndef HSR_BENCH_SHAPES_H
#define HSR_BENCH_SHAPES_H

#include "algorithms/setup.h"
#include "common/files/cells/cells.h"

/* --- Lists of cells ------------------------------------------------------- */

/* Cells in the making. All zero, but for the kind, is an empty list. */
struct cell_list {
  enum hsr_cell_kind kind;
  struct hsr_arena arena; /* holds the arrays */
  struct hsr_growing xyz, point, start;
  struct {
    const char *name;
    enum hsr_cell_type type;
    struct hsr_growing value;
  } data[HSR_MOST_CELL_DATA];
  int n_data;
  bool out_of_memory; /* some was lost */
};

void cell_list_free(struct cell_list *list);

/* Adds a kind of data, borrowing its name; its number. */
int cell_list_data(struct cell_list *list, const char *name,
                   enum hsr_cell_type type);

/* Adds a point; its number. Adds a number to the current cell, a point's or, of
 * polyhedra, a count. Ends that cell. */
uint32_t cell_list_point(struct cell_list *list, const double point[3]);
void cell_list_number(struct cell_list *list, uint32_t number);
void cell_list_end(struct cell_list *list);

/* Adds the value of data number k of the cell that has ended. */
void cell_list_value(struct cell_list *list, int k, uint32_t value);
void cell_list_real(struct cell_list *list, int k, double value);

/* Adds a box, or in a list of polygons its six sides; corner k is on the greater
 * side of axis a if bit a of k is set. Returns how many cells that are. */
int cell_list_box(struct cell_list *list, const double corner[8][3]);

/* The list, for as long as it is not changed. HSR_E_NOMEM. */
enum hsr_status cell_list_cells(const struct cell_list *list,
                                struct hsr_cells *cells, struct hsr_error *err);

/* --- Shapes --------------------------------------------------------------- */

/* What is known about one view: how it is seen, by which algorithm. The setup is
 * of the counting build. All borrowed. */
struct shape_source {
  const struct hsr_setup *setup;
  const struct hsr_view *view;
  const struct hsr_world *world; /* the scene, laid out */
};

/* Most cells of a shape: more are refused. */
enum { MOST_SHAPE_CELLS = 4000000 };

/* These fail with HSR_E_USAGE if the algorithm has nothing of the kind. */

/* The cubes of the algorithm's octrees, as boxes, or polygons. Data: instance
 * (HSR_NO_ID: the octree of instances), node, level, items, and state: what a run
 * of the view did to the cube. */
enum cube_state { CUBE_NOT_REACHED, CUBE_VISITED, CUBE_OUT, CUBE_HIDDEN };
enum hsr_status shape_octree(const struct shape_source *source,
                             struct cell_list *list, struct hsr_error *err);

/* The cells of the algorithm's BSP tree of all faces: polyhedra, or of polygons the parts of its planes that divide them. Data: node,
 * depth, plane, and place: the order in which the view's eye comes to it. */
enum hsr_status shape_bsp(const struct shape_source *source,
                          struct cell_list *list, struct hsr_error *err);

/* The same of the planes that separate clusters (schumacker). `plane` is the
 * separator's number; of polyhedra, the cluster's. */
enum hsr_status shape_separators(const struct shape_source *source,
                                 struct cell_list *list, struct hsr_error *err);

/* The view's frustum from near, or the eye, to the farthest vertex, as one
 * polyhedron or its faces. */
enum hsr_status shape_frustum(const struct shape_source *source,
                              struct cell_list *list, struct hsr_error *err);

/* The spans of a run of the algorithm: what its events of a row or a part of one
 * tell, as polygons on the picture's plane, half way from the eye to the point
 * looked at. Data: event, counter, outcome, face (HSR_NO_ID: none), row, first,
 * last. */
enum hsr_status shape_spans(const struct shape_source *source,
                            struct cell_list *list, struct hsr_error *err);

/* Runs the algorithm on one thread, and hears its events. HSR_E_NOMEM, and what
 * the algorithm fails with. */
enum hsr_status hear_run(const struct shape_source *source,
                         struct hsr_answer *answer, struct hsr_tally *tally,
                         void (*listen)(void *, const struct hsr_event *),
                         void *context, struct hsr_error *err);

#endif
