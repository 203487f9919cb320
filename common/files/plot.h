/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A line drawing on paper, as the strokes of a plotter's pens; or visible
 * polygons, filled.
 *
 * Paper       in pixels, sx to the right and sy down, [0, m] x [0, n], as in
 *             common/view/view.h; white.
 * Rounded     strokes are only looked at. Their ends are those of the drawing's
 *             intervals, rounded and kept inside the picture. */
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
  double dash;      /* and gap, pixels; 0: none */
};

struct hsr_stroke {
  uint32_t pen, object; /* indices into pen and the scene's objects */
  size_t number;        /* of its interval in the drawing */
  double from[2], to[2];
};

/* The colour of a region, linear, 0..1. */
struct hsr_fill {
  float rgb[3];
};

struct hsr_plot {
  int m, n;
  struct hsr_page page;
  const struct hsr_pen *pen; /* n_pens, the visible one first */
  uint32_t n_pens;
  struct hsr_stroke *stroke; /* n_strokes; the last pen's first, so that what
                                is visible is on top; by object, by number */
  size_t n_strokes;
  const struct hsr_polygons
      *polygons;                   /* below the strokes; borrowed; or NULL */
  struct hsr_fill *fill;           /* a region of theirs */
  float paper[3];                  /* linear */
  const struct hsr_scene *scene;   /* borrowed: the names of its objects */
  const char *title, *description; /* borrowed; NULL: none */
};

/* Finds where a point of the world is on the paper, in pixels. False if it is
 * not before the eye. */
bool hsr_plot_point(const struct hsr_view *view, const double point[3],
                    double at[2]);

/* Lays out a drawing of the whole view. An implied edge belongs to the object
 * of its first face. Freed with hsr_plot_free, also after a failure.
 * HSR_E_NOMEM. */
enum hsr_status hsr_plot_init(struct hsr_plot *plot,
                              const struct hsr_drawing *drawing,
                              const struct hsr_world *world,
                              const struct hsr_view *view,
                              enum hsr_hidden hidden, struct hsr_error *err);
/* Lays out visible polygons, which are borrowed, in the colours of `shading`; the
 * paper has that of the background. Freed in the same way. HSR_E_NOMEM. */
enum hsr_status hsr_plot_init_polygons(struct hsr_plot *plot,
                                       const struct hsr_polygons *polygons,
                                       const struct hsr_world *world,
                                       const struct hsr_view *view,
                                       enum hsr_shading shading,
                                       struct hsr_error *err);
void hsr_plot_free(struct hsr_plot *plot);

/* Pixels of the page, at 96 an inch, for each of the picture. */
double hsr_plot_scale(const struct hsr_plot *plot);

/* How many strokes, from number k on, share the pen and object of stroke k. */
size_t hsr_plot_run(const struct hsr_plot *plot, size_t k);

/* --- Paper ---------------------------------------------------------------- */

/* Write a file, whole or not at all. HSR_E_INPUT: it cannot be written;
 * HSR_E_NOMEM. In .svg each object has a <path> of its own for each pen, and so
 * has each region of polygons, its id "face-F-R" with the face F and the number
 * R of the region. */
enum hsr_status hsr_plot_write_svg(const struct hsr_plot *plot,
                                   const char *path, struct hsr_error *err);
enum hsr_status hsr_plot_write_pdf(const struct hsr_plot *plot,
                                   const char *path, struct hsr_error *err);

/* Antialiased pixels: rgb[3 * (j * m + i) ...], linear, m * n of them.
 * HSR_E_NOMEM. */
enum hsr_status hsr_plot_raster(const struct hsr_plot *plot, float *rgb,
                                struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
