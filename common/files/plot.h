/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A line drawing on paper, as the strokes of a plotter's pens; or visible
 * polygons, filled.
 *
 * Paper       [0, m] x [0, n] pixels, with sx to the right and sy down, as in
 *             common/view/view.h. The paper of a line drawing is white.
 * Rounded     strokes are for the eye only. Their ends are those of the
 *             drawing's intervals, rounded and clamped to the picture. */
#ifndef HSR_COMMON_PLOT_H
#define HSR_COMMON_PLOT_H

#include "common/files/page.h"
#include "common/lines/drawing.h"
#include "common/lines/polygons.h"
#include "common/view/picture.h"
#include "common/view/view.h"
#include "common/scene/world.h"

#ifdef __cplusplus
extern "C" {
#endif

struct hsr_pen {
  const char *name; /* [a-z0-9-]+ */
  double width;     /* pixels */
  double grey;      /* 0 black ... 1 white, sRGB-encoded */
  double dash;      /* the length of a dash, and of a gap, pixels; 0: solid */
};

struct hsr_stroke {
  uint32_t pen, object;  /* indices into pen and the scene's objects */
  size_t number;         /* the number of its interval in the drawing */
  double from[2], to[2]; /* its ends, pixels */
};

/* The colour of a region, linear, 0..1. */
struct hsr_fill {
  float rgb[3];
};

struct hsr_plot {
  int m, n;                  /* of the picture, pixels */
  struct hsr_page page;      /* all zero; the caller may set it */
  const struct hsr_pen *pen; /* n_pens, static; pen 0 is for visible edges */
  uint32_t n_pens;
  struct hsr_stroke *stroke; /* n_strokes, in descending order of pens, so that
                                visible edges are on top; then by object, then
                                by number */
  size_t n_strokes;
  const struct hsr_polygons *polygons; /* drawn below the strokes; borrowed;
                                          NULL: none */
  struct hsr_fill *fill;               /* by region of the polygons */
  float paper[3];                      /* its colour, linear, 0..1 */
  const struct hsr_scene *scene;       /* for the names of objects; borrowed */
  const struct hsr_drawing *drawing;   /* an .svg file holds it as it is, too;
                                          borrowed; NULL: none */
  const char *title, *description; /* NULL; the caller may set them; borrowed */
};

/* Finds the place of a point of the world on the paper, in pixels, clamped to
 * the picture. False if the point is not before the eye. */
bool hsr_plot_point(const struct hsr_view *view, const double point[3],
                    double at[2]);

/* Lays out a drawing of the whole view. An edge gets the object that it belongs
 * to; an implied edge gets that of its first face. *plot is written in full,
 * and is freed with hsr_plot_free also after a failure. HSR_E_NOMEM. */
enum hsr_status hsr_plot_init(struct hsr_plot *plot,
                              const struct hsr_drawing *drawing,
                              const struct hsr_world *world,
                              const struct hsr_view *view,
                              enum hsr_hidden hidden, struct hsr_error *err);
/* Lays out visible polygons, which are borrowed, in the colours of `shading`;
 * the paper has that of the background. Freed in the same way. HSR_E_NOMEM. */
enum hsr_status hsr_plot_init_polygons(struct hsr_plot *plot,
                                       const struct hsr_polygons *polygons,
                                       const struct hsr_world *world,
                                       const struct hsr_view *view,
                                       enum hsr_shading shading,
                                       struct hsr_error *err);

/* Frees what the plot owns. */
void hsr_plot_free(struct hsr_plot *plot);

/* Returns how many pixels of 1/96 inch on the page a pixel of the picture
 * has. */
double hsr_plot_scale(const struct hsr_plot *plot);

/* Returns how many strokes, from stroke[k] on, have the pen and the object of
 * stroke[k]. */
size_t hsr_plot_run(const struct hsr_plot *plot, size_t k);

/* --- Paper ---------------------------------------------------------------- */

/* Write a file, completely or not at all. In .svg, each object has one <path>
 * for each pen, and each region of polygons has one <path> with the id
 * "face-F-R", where F is its face and R its number. HSR_E_INPUT if the file
 * cannot be written; HSR_E_NOMEM. */
enum hsr_status hsr_plot_write_svg(const struct hsr_plot *plot,
                                   const char *path, struct hsr_error *err);
enum hsr_status hsr_plot_write_pdf(const struct hsr_plot *plot,
                                   const char *path, struct hsr_error *err);

/* Draws the plot as m x n antialiased pixels. Pixel (i, j) is rgb[3 * (j * m +
 * i)] and the next two, linear, 0..1, in an array of the caller.
 * HSR_E_NOMEM. */
enum hsr_status hsr_plot_raster(const struct hsr_plot *plot, float *rgb,
                                struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
