/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A drawing on paper: strokes of pens, and visible polygons, filled. From it all
 * files are written.
 *
 * Page        x to the right and y down, in pixels of 1/96 inch.
 * Rounded     places are for the eye and the pen only. They are the nodes of
 *             common/paper/lines/lines.h, rounded.
 * Layers      groups of strokes that people want to show, hide or cut apart.
 *             Each has groups of one pen. */
#ifndef HSR_COMMON_PAPER_PLOT_H
#define HSR_COMMON_PAPER_PLOT_H

#include "common/lines/drawing.h"
#include "common/lines/polygons.h"
#include "common/paper/lines/line_style.h"
#include "common/paper/page.h"
#include "common/paper/shared_sides.h"
#include "common/paper/strokes.h"
#include "common/scene/world.h"
#include "common/view/picture.h"
#include "common/view/view.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_plot_layer {
  char id[40];       /* [a-z0-9-]+ : "visible", "hidden-crease", "object-3" */
  const char *title; /* of the object; borrowed from the scene; NULL: none */
  size_t first, n;   /* its groups */
};

/* Strokes of one layer and one pen. */
struct hsr_plot_group {
  uint32_t pen;    /* of the plot's pens */
  size_t first, n; /* its strokes */
};

/* The colour of a region, linear, 0..1. */
struct hsr_fill {
  float rgb[3];
};

struct hsr_plot {
  struct hsr_page page;
  struct hsr_layout layout;
  int m, n; /* of the picture, pixels */

  struct hsr_line_pens pens;
  struct hsr_plot_layer *layer; /* n_layers, in the order of drawing: what is
                                   visible is on top */
  size_t n_layers;
  struct hsr_plot_group *group;
  size_t n_groups;
  struct hsr_strokes strokes; /* on the page */
  bool cuts_dashes;

  const struct hsr_polygons *polygons; /* filled below the strokes; borrowed;
                                          NULL: none */
  struct hsr_fill *fill;               /* by region of the polygons */
  struct hsr_shared_sides shared;      /* of the polygons: drawn beneath them */
  bool has_paper;                      /* a sheet is drawn */
  float paper[3];                      /* its colour, linear, 0..1 */

  const struct hsr_drawing *drawing; /* the subject's, if nothing of it is left
                                        out: an .svg file holds it as it is, too;
                                        borrowed; NULL: none */
  const char *title, *description; /* NULL; the caller may set them; borrowed */
};

/* What is laid out: lines, faces, or lines over faces. All borrowed. */
struct hsr_plot_subject {
  const struct hsr_drawing *drawing;   /* of the whole view; NULL: no lines */
  const struct hsr_polygons *polygons; /* NULL: no faces */
  const struct hsr_world *world;
  const struct hsr_view *view;
};

/* How. */
struct hsr_plot_look {
  const struct hsr_line_style *style; /* not NULL */
  struct hsr_page page;
  enum hsr_shading shading; /* of faces */
  bool hatch;               /* faces are hatched, not filled: hatch.h */
};

/* Lays out a subject, each line once. Without lines the paper has the colour of
 * the background; else it is white. *plot is written in full, and is freed with
 * hsr_plot_free also after a failure. HSR_E_USAGE as hsr_page_lay_out;
 * HSR_E_NOMEM. */
enum hsr_status hsr_plot_init(struct hsr_plot *plot,
                              const struct hsr_plot_subject *subject,
                              const struct hsr_plot_look *look,
                              struct hsr_error *err);

/* Frees what the plot owns. */
void hsr_plot_free(struct hsr_plot *plot);

/* The pen of a group. */
static inline const struct hsr_line_pen *
hsr_plot_pen(const struct hsr_plot *plot, const struct hsr_plot_group *group) {
  return &plot->pens.pen[group->pen];
}

/* --- Files ---------------------------------------------------------------- */

/* Writes a file, completely or not at all, of the format that its suffix names.
 * HSR_E_INPUT if the file cannot be written; HSR_E_NOMEM.
 *
 * .svg        a <g> for each layer, in it a <g> for each pen, in it a <path> for
 *             each stroke; layers are those of Inkscape. Each region of polygons
 *             has one <path> with the id "face-F-R", where F is its face and R
 *             its number.
 * .pdf .eps   by cairo. Each dash is a line of its own.
 * .dxf        by dxflib, in millimetres, y upwards: layers, colours, line types
 *             and widths; strokes are polylines. It holds no polygons. */
enum hsr_status hsr_plot_write(const struct hsr_plot *plot, const char *path,
                               struct hsr_error *err);

/* Draws the plot as m x n antialiased pixels. Its layout must be that of a page
 * which is all zero. Pixel (i, j) is rgb[3 * (j * m + i)] and the next two,
 * linear, 0..1, in an array of the caller. HSR_E_NOMEM. */
enum hsr_status hsr_plot_raster(const struct hsr_plot *plot, float *rgb,
                                struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
