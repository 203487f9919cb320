/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A plot drawn by cairo: on a page of PDF or EPS, and as pixels. */
#include "common/files/srgb.h"
#include "common/files/whole_file.h"
#include "common/paper/dashes.h"
#include "common/paper/plot_files.h"

#include <cairo-pdf.h>
#include <cairo-ps.h>
#include <stdlib.h>
#include <string.h>

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

static void set_pen(cairo_t *cairo, const struct hsr_line_pen *pen) {
  cairo_set_line_width(cairo, pen->width * HSR_PIXELS_PER_MM);
  cairo_set_source_rgb(cairo, pen->rgb[0] / 255.0, pen->rgb[1] / 255.0,
                       pen->rgb[2] / 255.0);
  cairo_set_line_cap(cairo, pen->dash > 0 ? CAIRO_LINE_CAP_BUTT
                                          : CAIRO_LINE_CAP_ROUND);
}

static void move(void *on, const double place[2]) {
  cairo_move_to(on, place[0], place[1]);
}

static void line(void *on, const double place[2]) {
  cairo_line_to(on, place[0], place[1]);
}

/* Dashes are lines of their own: not every reader of PDF takes long lists of
 * dashes. */
static enum hsr_status draw_stroke(cairo_t *cairo, const double (*at)[2],
                                   const struct hsr_stroke *stroke,
                                   const struct hsr_line_pen *pen,
                                   struct hsr_dashes *dashes,
                                   struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  if (pen->dash > 0) {
    status = hsr_dashes_find(dashes, at, stroke->n, stroke->closed,
                             pen->dash * HSR_PIXELS_PER_MM,
                             pen->gap * HSR_PIXELS_PER_MM, err);
    if (!status)
      hsr_dashes_cut(dashes, at, stroke->n, stroke->closed, cairo, move, line);
  } else {
    move(cairo, at[0]);
    for (size_t k = 1; k < stroke->n; k++)
      line(cairo, at[k]);
    if (stroke->closed)
      cairo_close_path(cairo);
  }
  cairo_stroke(cairo);
  return status;
}

static enum hsr_status draw_strokes(cairo_t *cairo, const struct hsr_plot *plot,
                                    struct hsr_error *err) {
  struct hsr_dashes dashes = {.n = 0};
  enum hsr_status status = HSR_OK;
  cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
  for (size_t g = 0; g < plot->n_groups; g++) {
    const struct hsr_plot_group *group = &plot->group[g];
    const struct hsr_line_pen *pen = hsr_plot_pen(plot, group);
    set_pen(cairo, pen);
    for (size_t k = group->first; k < group->first + group->n && !status; k++) {
      const struct hsr_stroke *stroke = &plot->strokes.stroke[k];
      status = draw_stroke(cairo,
                           (const double(*)[2])plot->strokes.at + stroke->first,
                           stroke, pen, &dashes, err);
    }
  }
  hsr_dashes_free(&dashes);
  return status;
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

/* Beneath the regions. A pixel of the page is `hair` of the picture's. */
static void draw_shared(cairo_t *cairo, const struct hsr_plot *plot,
                        double hair) {
  const struct hsr_shared_sides *shared = &plot->shared;
  cairo_set_line_width(cairo, hair * HSR_HAIRLINE);
  cairo_set_line_cap(cairo, CAIRO_LINE_CAP_BUTT);
  for (size_t k = 0; k < shared->n; k++) {
    const struct hsr_shared_side *side = &shared->side[k];
    if (!k || side->region != side[-1].region)
      set_colour(cairo, plot->fill[side->region].rgb);
    cairo_move_to(cairo, side->from[0], side->from[1]);
    cairo_line_to(cairo, side->to[0], side->to[1]);
    if (k + 1 == shared->n || side[1].region != side->region)
      cairo_stroke(cairo);
  }
}

static void fill_regions(cairo_t *cairo, const struct hsr_plot *plot) {
  cairo_set_fill_rule(cairo, CAIRO_FILL_RULE_EVEN_ODD);
  for (size_t r = 0; r < plot->polygons->n_regions; r++) {
    set_colour(cairo, plot->fill[r].rgb);
    fill_region(cairo, plot->polygons, &plot->polygons->region[r]);
  }
}

/* Draws on a surface, of which a pixel of the page is `unit`. */
static enum hsr_status draw(const struct hsr_plot *plot,
                            cairo_surface_t *surface, double unit,
                            const char *path, struct hsr_error *err) {
  const struct hsr_layout *l = &plot->layout;
  cairo_t *cairo = cairo_create(surface);
  cairo_scale(cairo, unit, unit);
  if (plot->has_paper) {
    set_colour(cairo, plot->paper);
    cairo_paint(cairo);
  }
  if (plot->polygons) {
    cairo_save(cairo);
    cairo_translate(cairo, l->left, l->top);
    cairo_scale(cairo, l->scale, l->scale);
    draw_shared(cairo, plot, 1 / l->scale);
    fill_regions(cairo, plot);
    cairo_restore(cairo);
  }
  enum hsr_status status = draw_strokes(cairo, plot, err);
  if (!status)
    status = judge(cairo_status(cairo), path, err);
  cairo_destroy(cairo);
  return status;
}

/* --- Pages ---------------------------------------------------------------- */

/* To a stream that is memory. */
static cairo_status_t append(void *stream, const unsigned char *data,
                             unsigned length) {
  return fwrite(data, 1, length, stream) == length ? CAIRO_STATUS_SUCCESS
                                                   : CAIRO_STATUS_NO_MEMORY;
}

/* A pixel of the page, in points, which are the units of PDF and EPS. */
#define POINTS .75

static cairo_surface_t *begin_pdf(const struct hsr_plot *plot, FILE *stream) {
  cairo_surface_t *surface = cairo_pdf_surface_create_for_stream(
      append, stream, POINTS * plot->layout.width,
      POINTS * plot->layout.height);
  cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "");
  if (plot->title)
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE,
                                   plot->title);
  if (plot->description)
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_SUBJECT,
                                   plot->description);
  return surface;
}

static cairo_surface_t *begin_eps(const struct hsr_plot *plot, FILE *stream) {
  cairo_surface_t *surface = cairo_ps_surface_create_for_stream(
      append, stream, POINTS * plot->layout.width,
      POINTS * plot->layout.height);
  cairo_ps_surface_set_eps(surface, 1);
  return surface;
}

/* Writes n bytes of a file, which a 0 follows, without the line that tells when
 * it was made: the same drawing is the same file. cairo has no way to leave it
 * out of .eps. */
static void put_without_date(FILE *out, const char *text, size_t n) {
  const char *line = strstr(text, "%%CreationDate:"),
             *end = line ? strchr(line, '\n') : NULL;
  if (end) {
    fwrite(text, 1, (size_t)(line - text), out);
    n -= (size_t)(end + 1 - text);
    text = end + 1;
  }
  fwrite(text, 1, n, out);
}

enum hsr_status hsr_plot_write_page(const struct hsr_plot *plot,
                                    const char *path, bool is_eps,
                                    struct hsr_error *err) {
  struct hsr_whole_file file;
  char *text = NULL;
  size_t n = 0;
  FILE *memory = open_memstream(&text, &n);
  if (!memory)
    return hsr_fail_nomem(err);
  cairo_surface_t *surface = (is_eps ? begin_eps : begin_pdf)(plot, memory);
  enum hsr_status status = draw(plot, surface, POINTS, path, err);
  cairo_surface_finish(surface);
  if (!status)
    status = judge(cairo_surface_status(surface), path, err);
  cairo_surface_destroy(surface);
  if (fclose(memory) != 0 && !status)
    status = hsr_fail_nomem(err);
  if (!status)
    status = hsr_whole_file_open(&file, path, err);
  if (!status) {
    put_without_date(file.stream, text, n);
    status = hsr_whole_file_close(&file, status, err);
  }
  free(text);
  return status;
}

/* --- Pixels --------------------------------------------------------------- */

/* The pixels of a finished surface, whose colours are sRGB-encoded. */
static void read_pixels(cairo_surface_t *surface, const struct hsr_plot *plot,
                        float *rgb) {
  const unsigned char *data = cairo_image_surface_get_data(surface);
  size_t stride = (size_t)cairo_image_surface_get_stride(surface);
  for (int j = 0; j < plot->n; j++)
    for (int i = 0; i < plot->m; i++) {
      uint32_t pixel =
          ((const uint32_t *)(const void *)(data + (size_t)j * stride))[i];
      for (int shift = 16; shift >= 0; shift -= 8)
        *rgb++ = hsr_srgb_decode((float)(pixel >> shift & 255) / 255);
    }
}

enum hsr_status hsr_plot_raster(const struct hsr_plot *plot, float *rgb,
                                struct hsr_error *err) {
  cairo_surface_t *surface =
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, plot->m, plot->n);
  enum hsr_status status = draw(plot, surface, 1, NULL, err);
  cairo_surface_flush(surface);
  if (!status)
    status = judge(cairo_surface_status(surface), NULL, err);
  if (!status)
    read_pixels(surface, plot, rgb);
  cairo_surface_destroy(surface);
  return status;
}
