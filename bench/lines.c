/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/lines.h"
#include "common/files/mesh/exchange.h"
#include "common/files/image.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool ends_in(const char *path, const char *suffix) {
  const char *dot = strrchr(path, '.');
  return dot && !strcasecmp(dot, suffix);
}

bool is_line_file(const char *path) {
  return ends_in(path, ".svg") || ends_in(path, ".pdf") ||
         ends_in(path, ".vtp");
}

static enum hsr_status write_image(const struct hsr_plot *plot,
                                   const char *path, const char *text,
                                   struct hsr_error *err) {
  struct hsr_picture image = {plot->m, plot->n, NULL, NULL, NULL};
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

static enum hsr_status write_file(const struct line_picture *picture,
                                  const struct hsr_plot *plot, const char *path,
                                  struct hsr_error *err) {
  if (ends_in(path, ".svg"))
    return hsr_plot_write_svg(plot, path, err);
  if (ends_in(path, ".pdf"))
    return hsr_plot_write_pdf(plot, path, err);
  if (ends_in(path, ".vtp"))
    return hsr_drawing_write_vtp(picture->drawing, path, err);
  return write_image(plot, path, picture->text, err);
}

enum hsr_status write_lines(const struct line_picture *p,
                            const char *const *file, int n_files,
                            struct hsr_error *err) {
  struct hsr_plot plot;
  enum hsr_status status =
      hsr_plot_init(&plot, p->drawing, p->world, p->view, p->hidden, err);
  plot.title = p->title;
  plot.description = p->description;
  for (int k = 0; k < n_files && !status; k++)
    status = write_file(p, &plot, file[k], err);
  hsr_plot_free(&plot);
  return status;
}

/* On the paper, pixels. */
static double length(const struct hsr_segment *segment,
                     const struct hsr_view *view) {
  double from[2], to[2];
  return hsr_plot_point(view, segment->from, from) &&
                 hsr_plot_point(view, segment->to, to)
             ? hypot(to[0] - from[0], to[1] - from[1])
             : 0;
}

void print_lines(const struct hsr_drawing *drawing,
                 const struct hsr_view *view) {
  size_t edges = 0;
  double visible = 0, all = 0;
  for (size_t k = 0; k < drawing->n; k++) {
    const struct hsr_segment *segment = &drawing->segment[k];
    double part = length(segment, view);
    all += part;
    visible += segment->invisibility ? 0 : part;
    edges += !k || hsr_edge_name_compare(&segment->edge, &segment[-1].edge);
  }
  printf("%zu edges, %zu intervals, %.1f %% of their length visible\n", edges,
         drawing->n, all > 0 ? 100 * visible / all : 0);
}
