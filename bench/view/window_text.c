/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/view/window_text.h"

#include <cairo.h>

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { USUAL = 15, LEAST = 10, INCH = 96, MARGIN = 6 };

static cairo_surface_t *surface_of(uint32_t *pixel, int m, int n) {
  return cairo_image_surface_create_for_data((unsigned char *)pixel,
                                             CAIRO_FORMAT_ARGB32, m, n, 4 * m);
}

static cairo_t *pen_of(cairo_surface_t *surface, double size) {
  cairo_t *cairo = cairo_create(surface);
  cairo_select_font_face(cairo, "monospace", CAIRO_FONT_SLANT_NORMAL,
                         CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo, size);
  return cairo;
}

/* Makes lines of a text, and ends each by a zero. Returns how many. */
static int cut_lines(char *text) {
  int n = 0;
  for (char *line; (line = strsep(&text, "\n")) && (*line || text);)
    n++;
  return n;
}

static const char *next_line(const char *line) {
  return line + strlen(line) + 1;
}

/* cairo refuses a line that is not UTF-8, and what is drawn after it. */
static void make_readable(cairo_surface_t *surface, char *line, int n) {
  for (; n--; line += strlen(line) + 1) {
    cairo_text_extents_t extents;
    cairo_t *cairo = pen_of(surface, USUAL);
    cairo_text_extents(cairo, line, &extents);
    for (char *c = line; cairo_status(cairo) && *c; c++)
      *c = (unsigned char)*c < 0x80 ? *c : '?';
    cairo_destroy(cairo);
  }
}

static double width_of(cairo_t *cairo, const char *line, int n) {
  double width = 0;
  for (; n--; line = next_line(line)) {
    cairo_text_extents_t extents;
    cairo_text_extents(cairo, line, &extents);
    width = fmax(width, extents.x_advance);
  }
  return width;
}

static double height_of(cairo_t *cairo) {
  cairo_font_extents_t font;
  cairo_font_extents(cairo, &font);
  return ceil(font.ascent + font.descent);
}

/* A size of letters in which the lines fit, if there is one. */
static double size_for(cairo_surface_t *surface, const char *lines, int n,
                       double usual, int most_m, int most_n) {
  double size = usual;
  for (; size > LEAST; size -= .5) {
    cairo_t *cairo = pen_of(surface, size);
    const bool fits = width_of(cairo, lines, n) + 2 * MARGIN <= most_m &&
                      n * height_of(cairo) + 2 * MARGIN <= most_n;
    cairo_destroy(cairo);
    if (fits)
      break;
  }
  return size;
}

static void draw_lines(cairo_t *cairo, const char *line, int n) {
  cairo_font_extents_t font;
  const double height = height_of(cairo);
  cairo_font_extents(cairo, &font);
  cairo_set_source_rgba(cairo, .05, .05, .1, .75);
  cairo_paint(cairo);
  cairo_set_source_rgb(cairo, 1, 1, 1);
  for (int k = 0; k < n; k++, line = next_line(line)) {
    cairo_move_to(cairo, MARGIN, round(MARGIN + k * height + font.ascent));
    cairo_show_text(cairo, line);
  }
}

static void draw(struct window_text *text, char *lines, int n, double dots,
                 int most_m, int most_n) {
  uint32_t one;
  cairo_surface_t *trial = surface_of(&one, 1, 1);
  make_readable(trial, lines, n);
  const double size =
      size_for(trial, lines, n, USUAL * fmax(dots / INCH, 1), most_m, most_n);
  cairo_t *cairo = pen_of(trial, size);
  text->m = (int)fmin(ceil(width_of(cairo, lines, n)) + 2 * MARGIN, most_m);
  text->n = (int)fmin(n * height_of(cairo) + 2 * MARGIN, most_n);
  cairo_destroy(cairo);
  cairo_surface_destroy(trial);
  text->pixel = calloc((size_t)text->m * (size_t)text->n, sizeof *text->pixel);
  if (!text->pixel)
    return;
  cairo_surface_t *surface = surface_of(text->pixel, text->m, text->n);
  cairo = pen_of(surface, size);
  draw_lines(cairo, lines, n);
  cairo_destroy(cairo);
  cairo_surface_destroy(surface);
}

void window_text_draw(struct window_text *text, const char *lines, double dots,
                      int most_m, int most_n) {
  window_text_free(text);
  char *copy = strdup(lines);
  const int n = copy ? cut_lines(copy) : 0;
  if (n && most_m > 0 && most_n > 0)
    draw(text, copy, n, dots, most_m, most_n);
  free(copy);
}

void window_text_free(struct window_text *text) {
  free(text->pixel);
  *text = (struct window_text){.m = 0};
}
