/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/paper/hatch.h"
#include "common/paper/sheet.h"

#include <math.h>
#include <stdlib.h>

/* The lines of one direction: those with a . p = k * apart, for whole k. */
struct grid {
  double across[2], along[2]; /* of length 1, at right angles */
  double apart;               /* pixels of the page */
};

struct hatcher {
  const struct hsr_line_pen *pen;
  struct hsr_strokes strokes; /* of the hatches */
  size_t room;
  double *crossing; /* of the line at hand, by place along it */
  size_t n_crossings;
};

static double dot(const double a[2], const double b[2]) {
  return a[0] * b[0] + a[1] * b[1];
}

/* How light a face is, 0 to 1, by the picture's own shading. */
static double light_of(const struct hsr_plot_subject *s, uint32_t face) {
  float lit[3], flat[3];
  double sum = 0, all = 0;
  hsr_picture_colour(s->world, s->view, face, HSR_SHADE_LAMBERT, lit);
  hsr_picture_colour(s->world, s->view, face, HSR_SHADE_FLAT, flat);
  for (int c = 0; c < 3; c++) {
    sum += (double)lit[c];
    all += (double)flat[c];
  }
  return all > 0 ? fmin(sum / all, 1) : 0;
}

/* --- Clipping ------------------------------------------------------------- */

static void find_places(const struct hsr_plot *plot,
                        const struct hsr_polygons *p,
                        const struct hsr_polygon_cycle *cycle, size_t k,
                        double at[2]) {
  const struct hsr_layout *l = &plot->layout;
  const double *from = p->side[cycle->first + k % cycle->n].at;
  at[0] = l->left + l->scale * from[0];
  at[1] = l->top + l->scale * from[1];
}

static int by_number(const void *a, const void *b) {
  const double *s = a, *t = b;
  return (*s > *t) - (*s < *t);
}

/* Where line k of the grid crosses the sides of a region. A side holds its lower
 * end and not its upper one. */
static void cross(struct hatcher *h, const struct hsr_plot *plot,
                  const struct hsr_polygons *p,
                  const struct hsr_polygon_region *region,
                  const struct grid *grid, double k) {
  const double level = k * grid->apart;
  h->n_crossings = 0;
  for (size_t c = region->first; c < region->first + region->n; c++)
    for (size_t i = 0; i < p->cycle[c].n; i++) {
      double a[2], b[2];
      find_places(plot, p, &p->cycle[c], i, a);
      find_places(plot, p, &p->cycle[c], i + 1, b);
      const double u = dot(grid->across, a), v = dot(grid->across, b);
      if ((u <= level) == (v <= level))
        continue;
      const double t = (level - u) / (v - u);
      h->crossing[h->n_crossings++] =
          (1 - t) * dot(grid->along, a) + t * dot(grid->along, b);
    }
  qsort(h->crossing, h->n_crossings, sizeof *h->crossing, by_number);
}

static bool make_room(struct hatcher *h) {
  if (h->strokes.n < h->room)
    return true;
  const size_t room = 2 * h->room + 256;
  struct hsr_stroke *stroke = realloc(h->strokes.stroke, room * sizeof *stroke);
  if (stroke)
    h->strokes.stroke = stroke;
  double(*at)[2] = realloc(h->strokes.at, 2 * room * sizeof *at);
  if (at)
    h->strokes.at = at;
  if (!stroke || !at)
    return false;
  h->room = room;
  return true;
}

/* Adds a hatch between two places along line k, every other one backwards. */
static bool add_hatch(struct hatcher *h, const struct grid *grid, double k,
                      double from, double to) {
  if (!make_room(h))
    return false;
  const bool back = fmod(fabs(k), 2) > .5;
  const double end[2] = {back ? to : from, back ? from : to};
  h->strokes.stroke[h->strokes.n++] =
      (struct hsr_stroke){.first = h->strokes.n_at, .n = 2};
  for (int i = 0; i < 2; i++, h->strokes.n_at++)
    for (int c = 0; c < 2; c++)
      h->strokes.at[h->strokes.n_at][c] =
          k * grid->apart * grid->across[c] + end[i] * grid->along[c];
  return true;
}

static bool hatch_region(struct hatcher *h, const struct hsr_plot *plot,
                         const struct hsr_polygons *p,
                         const struct hsr_polygon_region *region,
                         const struct grid *grid) {
  double low = INFINITY, high = -INFINITY;
  const struct hsr_polygon_cycle *outer = &p->cycle[region->first];
  for (size_t i = 0; i < outer->n; i++) {
    double at[2];
    find_places(plot, p, outer, i, at);
    low = fmin(low, dot(grid->across, at));
    high = fmax(high, dot(grid->across, at));
  }
  for (double k = ceil(low / grid->apart); k * grid->apart < high; k++) {
    cross(h, plot, p, region, grid, k);
    for (size_t i = 0; i + 1 < h->n_crossings; i += 2)
      if (h->crossing[i] < h->crossing[i + 1] &&
          !add_hatch(h, grid, k, h->crossing[i], h->crossing[i + 1]))
        return false;
  }
  return true;
}

/* --- Directions ----------------------------------------------------------- */

static struct grid grid_of(double degrees, double width, double share) {
  const double turn = degrees * (3.14159265358979323846 / 180);
  return (struct grid){{-sin(turn), cos(turn)},
                       {cos(turn), sin(turn)},
                       width * HSR_PIXELS_PER_MM / share};
}

/* Black is a share of the paper; in eight steps, so that faces of nearly one
 * light have one grid. More than 3/8 is hatched in two directions. */
static bool hatch_face(struct hatcher *h, const struct hsr_plot *plot,
                       const struct hsr_plot_subject *s,
                       const struct hsr_polygon_region *region) {
  const double black = floor(8 * .8 * (1 - light_of(s, region->face)) + .5) / 8;
  if (black <= 0)
    return true;
  const bool both = black > 3. / 8;
  const double width = h->pen->width;
  const struct grid first = grid_of(-45, width, both ? black / 2 : black),
                    second = grid_of(45, width, black / 2);
  return hatch_region(h, plot, s->polygons, region, &first) &&
         (!both || hatch_region(h, plot, s->polygons, region, &second));
}

static size_t count_sides(const struct hsr_polygons *p) {
  size_t most = 0;
  for (size_t r = 0; r < p->n_regions; r++) {
    size_t n = 0;
    for (size_t c = p->region[r].first; c < p->region[r].first + p->region[r].n;
         c++)
      n += p->cycle[c].n;
    most = n > most ? n : most;
  }
  return most;
}

/* --- The plot ------------------------------------------------------------- */

/* Puts the hatches below all other strokes, as a layer of one pen. */
static enum hsr_status put_below(struct hsr_plot *plot, const struct hatcher *h,
                                 struct hsr_error *err) {
  struct hsr_line_pen pen = *h->pen;
  struct hsr_plot_group group = {.pen = 0, .n = h->strokes.n};
  struct hsr_plot_layer layer = {.id = "hatch", .n = 1};
  const struct hsr_plot part[2] = {{.pens = {.pen = &pen, .n = 1},
                                    .layer = &layer,
                                    .n_layers = 1,
                                    .group = &group,
                                    .n_groups = 1,
                                    .strokes = h->strokes},
                                   *plot};
  static const double offset[2][2] = {{0, 0}, {0, 0}};
  struct hsr_plot both;
  enum hsr_status status = hsr_plot_sheet(
      &both, part, 2, offset, plot->layout.width, plot->layout.height, err);
  if (!status) {
    both.page = plot->page;
    both.layout = plot->layout;
    both.m = plot->m;
    both.n = plot->n;
    both.cuts_dashes = plot->cuts_dashes;
    both.drawing = plot->drawing;
    hsr_plot_free(plot);
    *plot = both;
  } else {
    hsr_plot_free(&both);
  }
  return status;
}

enum hsr_status hsr_plot_hatch(struct hsr_plot *plot,
                               const struct hsr_plot_subject *subject,
                               const struct hsr_line_pen *pen,
                               struct hsr_error *err) {
  const struct hsr_polygons *p = subject->polygons;
  struct hatcher h = {.pen = pen,
                      .crossing =
                          malloc((count_sides(p) + 1) * sizeof *h.crossing)};
  bool good = h.crossing;
  for (size_t r = 0; r < p->n_regions && good; r++)
    good = hatch_face(&h, plot, subject, &p->region[r]);
  enum hsr_status status =
      good ? put_below(plot, &h, err) : hsr_fail_nomem(err);
  hsr_strokes_free(&h.strokes);
  free(h.crossing);
  return status;
}
