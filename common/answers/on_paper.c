/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/answers/on_paper.h"
#include "common/files/image.h"
#include "common/files/suffix.h"
#include "common/paper/plot.h"

#include <stdlib.h>
#include <string.h>

static enum hsr_status write_image(const struct hsr_plot *plot,
                                   const char *path, const char *text,
                                   struct hsr_error *err) {
  struct hsr_picture image = {.m = plot->m, .n = plot->n};
  float *rgb = malloc(3 * (size_t)plot->m * (size_t)plot->n * sizeof *rgb);
  if (!rgb)
    return hsr_fail_nomem(err);
  image.rgb = rgb;
  enum hsr_status status = hsr_plot_raster(plot, rgb, err);
  if (!status)
    status = hsr_image_write(path, &image, text, err);
  free(rgb);
  return status;
}

static void count(const struct hsr_plot *plot, struct hsr_drawn *drawn) {
  const struct hsr_travel travel = hsr_strokes_travel(&plot->strokes);
  *drawn = (struct hsr_drawn){.strokes = plot->strokes.n,
                              .ink = travel.down / HSR_PIXELS_PER_MM,
                              .pen_up = travel.up / HSR_PIXELS_PER_MM};
}

/* Lays out what is to be shown, for paper files or as pixels. */
static enum hsr_status lay_out(struct hsr_plot *plot,
                               const struct hsr_showing *showing,
                               const struct hsr_drawing *drawing,
                               const struct hsr_polygons *polygons,
                               bool on_page, struct hsr_error *err) {
  struct hsr_line_style screen;
  hsr_line_style_plain(&screen, HSR_HIDDEN_NONE);
  const struct hsr_plot_subject subject = {drawing, polygons, showing->world,
                                           showing->view};
  struct hsr_plot_look look = {.style =
                                   showing->style ? showing->style : &screen,
                               .shading = showing->shading,
                               .hatch = showing->hatch};
  if (on_page)
    look.page = showing->page;
  enum hsr_status status = hsr_plot_init(plot, &subject, &look, err);
  const bool filled = !drawing && !showing->hatch;
  plot->has_paper = !on_page || filled || showing->background.given;
  if (showing->background.given)
    memcpy(plot->paper, showing->background.rgb, sizeof plot->paper);
  plot->title = showing->title;
  plot->description = showing->description;
  return status;
}

enum hsr_status hsr_write_on_paper(const struct hsr_showing *showing,
                                   const struct hsr_drawing *drawing,
                                   const struct hsr_polygons *polygons,
                                   const char *const *path, size_t n,
                                   struct hsr_error *err) {
  struct hsr_plot plot;
  enum hsr_status status =
      lay_out(&plot, showing, drawing, polygons, true, err);
  for (size_t k = 0; k < n && !status; k++)
    status = hsr_plot_write(&plot, path[k], err);
  if (!status && showing->drawn)
    count(&plot, showing->drawn);
  hsr_plot_free(&plot);
  return status;
}

enum hsr_status hsr_show_on_paper(const struct hsr_showing *showing,
                                  const struct hsr_drawing *drawing,
                                  const struct hsr_polygons *polygons,
                                  const char *path, struct hsr_error *err) {
  if (hsr_is_paper_file(path))
    return hsr_write_on_paper(showing, drawing, polygons, &path, 1, err);
  struct hsr_plot plot;
  enum hsr_status status =
      lay_out(&plot, showing, drawing, polygons, false, err);
  if (!status)
    status = write_image(&plot, path, showing->text, err);
  if (!status && showing->drawn)
    count(&plot, showing->drawn);
  hsr_plot_free(&plot);
  return status;
}
