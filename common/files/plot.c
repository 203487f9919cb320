/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/files/plot.h"

#include <math.h>
#include <stdlib.h>

static const struct hsr_pen solid[] = {{"visible", 1.25, 0, 0}};
static const struct hsr_pen dashed[] = {{"visible", 1.25, 0, 0},
                                        {"hidden", 0.75, 0.35, 3}};
static const struct hsr_pen thin[] = {{"visible", 1.25, 0, 0},
                                      {"hidden-1", 0.8, 0.5, 0},
                                      {"hidden-2", 0.6, 0.65, 0},
                                      {"hidden-3", 0.45, 0.78, 0}};
static const struct hsr_pen all[] = {{"edges", 1, 0, 0}};

#define PENS(array)                                                            \
  { array, sizeof array / sizeof *array }
static const struct {
  const struct hsr_pen *pen;
  uint32_t n;
} pens_of[] = {[HSR_HIDDEN_NONE] = PENS(solid),
               [HSR_HIDDEN_DASHED] = PENS(dashed),
               [HSR_HIDDEN_THIN] = PENS(thin),
               [HSR_HIDDEN_ALL] = PENS(all)};

bool hsr_plot_point(const struct hsr_view *view, const double point[3],
                    double at[2]) {
  double s[3];
  hsr_view_project(view, point, s);
  double w = hsr_view_w(view, s);
  if (!(w > 0))
    return false;
  at[0] = fmin(fmax(s[0] / w, 0), view->m);
  at[1] = fmin(fmax(s[1] / w, 0), view->n);
  return true;
}

/* The object of every vertex: that of the faces which have it. */
static uint32_t *find_objects(const struct hsr_world *world) {
  uint32_t *object = calloc((size_t)world->mesh.n_vertices + 1, sizeof *object);
  if (!object)
    return NULL;
  for (uint32_t f = 0; f < world->n_faces; f++)
    for (uint32_t k = world->mesh.start[f]; k < world->mesh.start[f + 1]; k++)
      object[world->mesh.vertex[k]] = world->mesh.object[f];
  return object;
}

/* Whether a stroke was made of the interval. */
static bool make_stroke(struct hsr_stroke *stroke, const struct hsr_plot *plot,
                        const struct hsr_segment *segment,
                        const struct hsr_view *view, enum hsr_hidden hidden) {
  uint32_t pen = hidden == HSR_HIDDEN_ALL ? 0 : segment->invisibility;
  if (pen && hidden == HSR_HIDDEN_NONE)
    return false;
  stroke->pen = pen < plot->n_pens ? pen : plot->n_pens - 1;
  return hsr_plot_point(view, segment->from, stroke->from) &&
         hsr_plot_point(view, segment->to, stroke->to);
}

static bool is_alike(const struct hsr_stroke *s, const struct hsr_stroke *t) {
  return s->pen == t->pen && s->object == t->object;
}

static int in_order(const void *a, const void *b) {
  const struct hsr_stroke *s = a, *t = b;
  if (!is_alike(s, t))
    return s->pen != t->pen ? (s->pen < t->pen) - (s->pen > t->pen)
                            : (s->object > t->object) - (s->object < t->object);
  return (s->number > t->number) - (s->number < t->number);
}

enum hsr_status hsr_plot_init(struct hsr_plot *plot,
                              const struct hsr_drawing *drawing,
                              const struct hsr_world *world,
                              const struct hsr_view *view,
                              enum hsr_hidden hidden, struct hsr_error *err) {
  *plot = (struct hsr_plot){.m = view->m,
                            .n = view->n,
                            .pen = pens_of[hidden].pen,
                            .n_pens = pens_of[hidden].n,
                            .stroke =
                                malloc((drawing->n + 1) * sizeof *plot->stroke),
                            .paper = {1, 1, 1},
                            .scene = world->roster.scene};
  uint32_t *object = find_objects(world);
  if (!plot->stroke || !object) {
    free(object);
    return hsr_fail_nomem(err);
  }
  for (size_t k = 0; k < drawing->n; k++) {
    const struct hsr_segment *segment = &drawing->segment[k];
    struct hsr_stroke *stroke = &plot->stroke[plot->n_strokes];
    stroke->object = segment->edge.implied ? world->mesh.object[segment->edge.a]
                                           : object[segment->edge.a];
    stroke->number = k;
    plot->n_strokes += make_stroke(stroke, plot, segment, view, hidden);
  }
  free(object);
  qsort(plot->stroke, plot->n_strokes, sizeof *plot->stroke, in_order);
  return HSR_OK;
}

enum hsr_status hsr_plot_init_polygons(struct hsr_plot *plot,
                                       const struct hsr_polygons *polygons,
                                       const struct hsr_world *world,
                                       const struct hsr_view *view,
                                       enum hsr_shading shading,
                                       struct hsr_error *err) {
  *plot = (struct hsr_plot){
      .m = view->m,
      .n = view->n,
      .polygons = polygons,
      .fill = malloc((polygons->n_regions + 1) * sizeof *plot->fill),
      .scene = world->roster.scene};
  if (!plot->fill)
    return hsr_fail_nomem(err);
  for (size_t r = 0; r < polygons->n_regions; r++)
    hsr_picture_colour(world, view, polygons->region[r].face, shading,
                       plot->fill[r].rgb);
  hsr_picture_colour(world, view, HSR_BACKGROUND, shading, plot->paper);
  return HSR_OK;
}

void hsr_plot_free(struct hsr_plot *plot) {
  free(plot->stroke);
  free(plot->fill);
  plot->stroke = NULL;
  plot->fill = NULL;
}

double hsr_plot_scale(const struct hsr_plot *plot) {
  const struct hsr_page *page = &plot->page;
  return page->width > 0 ? page->width * page->pixels / plot->m : 1;
}

size_t hsr_plot_run(const struct hsr_plot *plot, size_t k) {
  size_t n = 1;
  while (k + n < plot->n_strokes &&
         is_alike(&plot->stroke[k], &plot->stroke[k + n]))
    n++;
  return n;
}
