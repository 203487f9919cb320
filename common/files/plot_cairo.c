/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A plot drawn by cairo: on a page of PDF, and as pixels. */
#include "common/files/plot.h"
#include "common/files/srgb.h"
#include "common/files/whole_file.h"
#include "common/lines/polygons.h"

#include <cairo-pdf.h>

/* What cairo says, in our words; `path` is NULL where there is no file. */
static enum hsr_status judge(cairo_status_t said, const char *path,
                             struct hsr_error *err) {
  if (said == CAIRO_STATUS_SUCCESS)
    return HSR_OK;
  if (said == CAIRO_STATUS_NO_MEMORY)
    return hsr_fail_nomem(err);
  return hsr_fail(err, path ? HSR_E_INPUT : HSR_E_INTERNAL, "%s: %s",
                  path ? path : "cairo", cairo_status_to_string(said));
}

/* A unit of the page is `wide` units of the drawing. */
static void set_pen(cairo_t *cairo, const struct hsr_pen *pen, double wide) {
  const double dash = wide * pen->dash;
  cairo_set_line_width(cairo, wide * pen->width);
  cairo_set_source_rgb(cairo, pen->grey, pen->grey, pen->grey);
  cairo_set_dash(cairo, &dash, dash > 0, 0);
}

/* Strokes of one pen and object; a path of too many is slow to fill. */
static void draw_run(cairo_t *cairo, const struct hsr_stroke *stroke,
                     size_t n) {
  enum { MOST = 256 };
  for (size_t k = 0; k < n; k++) {
    cairo_move_to(cairo, stroke[k].from[0], stroke[k].from[1]);
    cairo_line_to(cairo, stroke[k].to[0], stroke[k].to[1]);
    if (k % MOST == MOST - 1 || k == n - 1)
      cairo_stroke(cairo);
  }
}

static void set_colour(cairo_t *cairo, const float rgb[3]) {
  cairo_set_source_rgb(cairo, (double)hsr_srgb_encode(rgb[0]),
                       (double)hsr_srgb_encode(rgb[1]),
                       (double)hsr_srgb_encode(rgb[2]));
}

/* Holes and the outer cycle, by parity. */
static void fill_region(cairo_t *cairo, const struct hsr_polygons *p,
                        const struct hsr_polygon_region *region) {
  for (size_t c = region->first; c < region->first + region->n; c++) {
    const struct hsr_polygon_cycle *cycle = &p->cycle[c];
    for (size_t k = 0; k < cycle->n; k++)
      cairo_line_to(cairo, p->side[cycle->first + k].at[0],
                    p->side[cycle->first + k].at[1]);
    cairo_close_path(cairo);
    cairo_new_sub_path(cairo);
  }
  cairo_fill(cairo);
}

static void fill_regions(cairo_t *cairo, const struct hsr_plot *plot) {
  cairo_set_fill_rule(cairo, CAIRO_FILL_RULE_EVEN_ODD);
  for (size_t r = 0; r < plot->polygons->n_regions; r++) {
    set_colour(cairo, plot->fill[r].rgb);
    fill_region(cairo, plot->polygons, &plot->polygons->region[r]);
  }
}

/* Draws on a surface, of which a pixel of the page is `unit`, and finishes it.
 */
static cairo_status_t draw(const struct hsr_plot *plot,
                           cairo_surface_t *surface, double unit,
                           double scale) {
  cairo_t *cairo = cairo_create(surface);
  cairo_scale(cairo, unit * scale, unit * scale);
  set_colour(cairo, plot->paper);
  cairo_paint(cairo);
  if (plot->polygons)
    fill_regions(cairo, plot);
  cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
  for (size_t k = 0, n; k < plot->n_strokes; k += n) {
    n = hsr_plot_run(plot, k);
    set_pen(cairo, &plot->pen[plot->stroke[k].pen], 1 / scale);
    draw_run(cairo, plot->stroke + k, n);
  }
  cairo_status_t said = cairo_status(cairo);
  cairo_destroy(cairo);
  return said;
}

static cairo_status_t append(void *stream, const unsigned char *data,
                             unsigned length) {
  return fwrite(data, 1, length, stream) == length ? CAIRO_STATUS_SUCCESS
                                                   : CAIRO_STATUS_WRITE_ERROR;
}

enum hsr_status hsr_plot_write_pdf(const struct hsr_plot *plot,
                                   const char *path, struct hsr_error *err) {
  const double points = 0.75; /* a pixel, at 96 pixels an inch */
  const double scale = hsr_plot_scale(plot);
  struct hsr_whole_file file;
  enum hsr_status status = hsr_whole_file_open(&file, path, err);
  if (status)
    return status;
  cairo_surface_t *surface = cairo_pdf_surface_create_for_stream(
      append, file.stream, points * scale * plot->m, points * scale * plot->n);
  /* No time of making: the same drawing is the same file. */
  cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "");
  if (plot->title)
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE,
                                   plot->title);
  if (plot->description)
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_SUBJECT,
                                   plot->description);
  cairo_status_t said = draw(plot, surface, points, scale);
  cairo_surface_finish(surface);
  if (said == CAIRO_STATUS_SUCCESS)
    said = cairo_surface_status(surface);
  cairo_surface_destroy(surface);
  return hsr_whole_file_close(&file, judge(said, path, err), err);
}

/* The pixels of a finished surface, whose grey is sRGB-encoded. */
static void read_pixels(cairo_surface_t *surface, const struct hsr_plot *plot,
                        float *rgb) {
  const unsigned char *data = cairo_image_surface_get_data(surface);
  size_t stride = (size_t)cairo_image_surface_get_stride(surface);
  for (int j = 0; j < plot->n; j++)
    for (int i = 0; i < plot->m; i++) {
      uint32_t pixel =
          ((const uint32_t *)(const void *)(data + (size_t)j * stride))[i];
      float grey = hsr_srgb_decode((float)(pixel & 255) / 255);
      for (int c = 0; c < 3; c++)
        *rgb++ = grey;
    }
}

enum hsr_status hsr_plot_raster(const struct hsr_plot *plot, float *rgb,
                                struct hsr_error *err) {
  cairo_surface_t *surface =
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, plot->m, plot->n);
  cairo_status_t said = draw(plot, surface, 1, 1);
  cairo_surface_flush(surface);
  if (said == CAIRO_STATUS_SUCCESS)
    said = cairo_surface_status(surface);
  if (said == CAIRO_STATUS_SUCCESS)
    read_pixels(surface, plot, rgb);
  cairo_surface_destroy(surface);
  return judge(said, NULL, err);
}
