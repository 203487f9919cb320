/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A plot of times: a panel for each scene, view and size, in it a line for each
 * algorithm, the fastest first, and one logarithmic axis for all panels. */
#include "bench/times/rows.h"
#include "common/files/suffix.h"
#include "common/files/whole_file.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Lengths are in points. */
enum { WIDTH = 640, LEFT = 190, RIGHT = 90, LINE = 15, HEAD = 26, MARGIN = 14 };

struct plot {
  const struct row **row; /* those that are timed; sorted in each panel */
  size_t n;
  int panels;
  double least, most; /* decades of the axis */
  cairo_t *cairo;
};

static int compare_rows(const void *a, const void *b) {
  const struct row *const *x = a, *const *y = b;
  double s = (*x)->median.value, t = (*y)->median.value;
  return (s > t) - (s < t);
}

/* Chooses the rows, and sorts those of each panel, which lie together. */
static void sort_panels(struct plot *plot, const struct rows *rows) {
  plot->least = INFINITY;
  plot->most = -INFINITY;
  for (size_t k = 0; k < rows->n; k++) {
    const struct row *row = &rows->row[k];
    if (!row->timed)
      continue;
    plot->row[plot->n++] = row;
    plot->least = fmin(plot->least, floor(log10(row->median.value)));
    plot->most = fmax(plot->most, ceil(log10(row->median.value)));
  }
  for (size_t k = 0, end; k < plot->n; k = end, plot->panels++) {
    for (end = k + 1;
         end < plot->n && rows_same_place(plot->row[k], plot->row[end]);)
      end++;
    qsort(plot->row + k, end - k, sizeof *plot->row, compare_rows);
  }
  if (plot->most <= plot->least)
    plot->most = plot->least + 1;
}

static double height_of(const struct plot *plot) {
  return 2 * MARGIN + HEAD * (plot->panels + 1) + LINE * (double)plot->n;
}

static double x_of(const struct plot *plot, double seconds) {
  double part = (log10(seconds) - plot->least) / (plot->most - plot->least);
  return LEFT + fmin(fmax(part, 0), 1) * (WIDTH - LEFT - RIGHT);
}

static void write_text(cairo_t *cairo, double x, double y, const char *text) {
  cairo_move_to(cairo, x, y);
  cairo_show_text(cairo, text);
}

/* Right-aligned at x. */
static void write_before(cairo_t *cairo, double x, double y, const char *text) {
  cairo_text_extents_t extents;
  cairo_text_extents(cairo, text, &extents);
  write_text(cairo, x - extents.x_advance, y, text);
}

static void draw_axis(const struct plot *plot, double height) {
  cairo_t *cairo = plot->cairo;
  for (double decade = plot->least; decade <= plot->most; decade++) {
    char text[ROWS_TIME];
    double x = x_of(plot, pow(10, decade));
    cairo_set_source_rgb(cairo, .85, .85, .85);
    cairo_set_line_width(cairo, .5);
    cairo_move_to(cairo, x, MARGIN);
    cairo_line_to(cairo, x, height - MARGIN - HEAD);
    cairo_stroke(cairo);
    cairo_set_source_rgb(cairo, .3, .3, .3);
    rows_time(pow(10, decade) * (1 + 1e-12), text);
    cairo_text_extents_t extents;
    cairo_text_extents(cairo, text, &extents);
    write_text(cairo, x - extents.x_advance / 2, height - MARGIN, text);
  }
}

static void draw_row(const struct plot *plot, const struct row *row, double y) {
  cairo_t *cairo = plot->cairo;
  char name[RESULTS_MOST_NAME + 24], text[ROWS_TIME];
  long threads = results_number(row->cell, "threads");
  snprintf(name, sizeof name, threads > 1 ? "%.*s, %ld threads" : "%.*s", 60,
           results_text(row->cell, "algorithm"), threads);
  cairo_set_source_rgb(cairo, 0, 0, 0);
  write_before(cairo, LEFT - 10, y + 4, name);
  double x = x_of(plot, row->median.value);
  cairo_set_source_rgb(cairo, .12, .35, .62);
  if (!isnan(row->median.low)) {
    cairo_set_line_width(cairo, 2);
    cairo_move_to(cairo, x_of(plot, row->median.low), y);
    cairo_line_to(cairo, x_of(plot, row->median.high), y);
    cairo_stroke(cairo);
  }
  cairo_arc(cairo, x, y, 3, 0, 2 * acos(-1));
  cairo_fill(cairo);
  cairo_set_source_rgb(cairo, .3, .3, .3);
  write_text(cairo, WIDTH - RIGHT + 12, y + 4,
             rows_time(row->median.value, text));
}

static void draw(const struct plot *plot, double height) {
  cairo_t *cairo = plot->cairo;
  cairo_set_source_rgb(cairo, 1, 1, 1);
  cairo_paint(cairo);
  cairo_select_font_face(cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo, 11);
  draw_axis(plot, height);
  double y = MARGIN;
  for (size_t k = 0; k < plot->n; k++) {
    const json_t *cell = plot->row[k]->cell;
    if (!k || !rows_same_place(plot->row[k - 1], plot->row[k])) {
      char key[RESULTS_KEY];
      results_picture_key(
          results_text(cell, "scene"), results_number(cell, "view"),
          results_number(cell, "walk"), results_number(cell, "width"),
          results_number(cell, "height"), key);
      cairo_set_source_rgb(cairo, 0, 0, 0);
      write_text(cairo, MARGIN, y + HEAD - 8, key);
      y += HEAD;
    }
    draw_row(plot, plot->row[k], y + LINE / 2.);
    y += LINE;
  }
}

/* --- Files ---------------------------------------------------------------- */

static cairo_status_t append(void *stream, const unsigned char *data,
                             unsigned length) {
  return fwrite(data, 1, length, stream) == length ? CAIRO_STATUS_SUCCESS
                                                   : CAIRO_STATUS_WRITE_ERROR;
}

bool rows_plot_fits(const char *path) {
  return hsr_ends_in(path, ".svg") || hsr_ends_in(path, ".pdf") ||
         hsr_ends_in(path, ".png");
}

static cairo_surface_t *make_surface(const char *path, double height,
                                     FILE *stream) {
  if (hsr_ends_in(path, ".svg"))
    return cairo_svg_surface_create_for_stream(append, stream, WIDTH, height);
  if (hsr_ends_in(path, ".pdf")) {
    cairo_surface_t *pdf =
        cairo_pdf_surface_create_for_stream(append, stream, WIDTH, height);
    /* No time of making: the same figures are the same file. */
    cairo_pdf_surface_set_metadata(pdf, CAIRO_PDF_METADATA_CREATE_DATE, "");
    return pdf;
  }
  return cairo_image_surface_create(CAIRO_FORMAT_RGB24, WIDTH, (int)height);
}

static enum hsr_status write_plot(struct plot *plot, const char *path,
                                  struct hsr_error *err) {
  struct hsr_whole_file file;
  enum hsr_status status = hsr_whole_file_open(&file, path, err);
  if (status)
    return status;
  double height = height_of(plot);
  cairo_surface_t *surface = make_surface(path, height, file.stream);
  plot->cairo = cairo_create(surface);
  draw(plot, height);
  cairo_status_t said = cairo_status(plot->cairo);
  cairo_destroy(plot->cairo);
  if (!said && hsr_ends_in(path, ".png"))
    said = cairo_surface_write_to_png_stream(surface, append, file.stream);
  cairo_surface_finish(surface);
  if (!said)
    said = cairo_surface_status(surface);
  cairo_surface_destroy(surface);
  if (said == CAIRO_STATUS_NO_MEMORY)
    status = hsr_fail_nomem(err);
  else if (said)
    status = hsr_fail(err, HSR_E_INPUT, "%s: %s", path,
                      cairo_status_to_string(said));
  return hsr_whole_file_close(&file, status, err);
}

enum hsr_status rows_plot(const struct rows *rows, const char *path,
                          struct hsr_error *err) {
  struct plot plot = {.row = calloc(rows->n + 1, sizeof *plot.row)};
  if (!plot.row)
    return hsr_fail_nomem(err);
  sort_panels(&plot, rows);
  enum hsr_status status =
      plot.n
          ? write_plot(&plot, path, err)
          : hsr_fail(err, HSR_E_INPUT, "%s: there are no times to plot", path);
  free(plot.row);
  return status;
}
