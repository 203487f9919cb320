/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/paper/plot.h"
#include "common/files/suffix.h"
#include "common/paper/hatch.h"
#include "common/paper/lines/lines.h"
#include "common/paper/plot_files.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- Layers --------------------------------------------------------------- */

/* The layer and the pen of a line, by which they are drawn: greater keys on top
 * of others. */
static uint64_t key_of(const struct hsr_paper_line *line,
                       enum hsr_layers layers) {
  const uint64_t hidden = line->invisibility != 0;
  const uint64_t classes = HSR_N_LINE_CLASSES;
  uint64_t layer = line->object;
  if (layers == HSR_LAYERS_VISIBILITY)
    layer = !hidden;
  if (layers == HSR_LAYERS_CLASS)
    layer = !hidden * classes + classes - 1 - (uint64_t)line->line_class;
  return layer << 32 | line->pen;
}

static uint64_t layer_of(uint64_t key) {
  return key >> 32;
}

static void name_layer(struct hsr_plot_layer *layer, uint64_t number,
                       enum hsr_layers layers, const struct hsr_scene *scene) {
  if (layers == HSR_LAYERS_OBJECT) {
    snprintf(layer->id, sizeof layer->id, "object-%u", (unsigned)number);
    layer->title =
        number < scene->n_objects ? scene->objects[number].name : NULL;
  } else if (layers == HSR_LAYERS_CLASS) {
    const int k = (int)number % HSR_N_LINE_CLASSES;
    snprintf(
        layer->id, sizeof layer->id, "%s-%s",
        number >= HSR_N_LINE_CLASSES ? "visible" : "hidden",
        hsr_line_class_name((enum hsr_line_class)(HSR_N_LINE_CLASSES - 1 - k)));
  } else {
    snprintf(layer->id, sizeof layer->id, number ? "visible" : "hidden");
  }
}

static int by_key(const void *a, const void *b) {
  const uint64_t *s = a, *t = b;
  return (*s > *t) - (*s < *t);
}

/* The keys of all lines, each once, ascending. */
static size_t sort_keys(uint64_t *key, size_t n) {
  size_t kept = 0;
  qsort(key, n, sizeof *key, by_key);
  for (size_t k = 0; k < n; k++)
    if (!k || key[k] != key[k - 1])
      key[kept++] = key[k];
  return kept;
}

/* Makes the groups of n keys, and their layers. */
static enum hsr_status make_groups(struct hsr_plot *plot, const uint64_t *key,
                                   size_t n, enum hsr_layers layers,
                                   const struct hsr_scene *scene,
                                   struct hsr_error *err) {
  plot->group = malloc((n + 1) * sizeof *plot->group);
  plot->layer = malloc((n + 1) * sizeof *plot->layer);
  if (!plot->group || !plot->layer)
    return hsr_fail_nomem(err);
  plot->n_groups = n;
  for (size_t k = 0; k < n; k++) {
    plot->group[k] = (struct hsr_plot_group){.pen = (uint32_t)key[k]};
    if (!k || layer_of(key[k]) != layer_of(key[k - 1])) {
      plot->layer[plot->n_layers] = (struct hsr_plot_layer){.first = k};
      name_layer(&plot->layer[plot->n_layers++], layer_of(key[k]), layers,
                 scene);
    }
    plot->layer[plot->n_layers - 1].n++;
  }
  return HSR_OK;
}

/* --- Strokes -------------------------------------------------------------- */

static void widen_box(const double at[2], double low[2], double high[2]) {
  for (int c = 0; c < 2; c++) {
    low[c] = at[c] < low[c] ? at[c] : low[c];
    high[c] = at[c] > high[c] ? at[c] : high[c];
  }
}

/* The box of what is drawn, in pixels of the picture. */
static void find_box(const double (*at)[2], size_t n, double low[2],
                     double high[2]) {
  for (int c = 0; c < 2; c++) {
    low[c] = DBL_MAX;
    high[c] = -DBL_MAX;
  }
  for (size_t k = 0; k < n; k++)
    widen_box(at[k], low, high);
}

/* How far ink reaches beyond the middle of a line, millimetres. */
static double find_ink(const struct hsr_plot *plot) {
  double ink = 0;
  for (size_t k = 0; k < plot->n_groups; k++)
    ink = fmax(ink, plot->pens.pen[plot->group[k].pen].width / 2);
  return ink;
}

/* The lines' places are those of the picture before, and of the page after. */
static enum hsr_status lay_out(struct hsr_plot *plot,
                               const struct hsr_plot_subject *subject,
                               struct hsr_error *err) {
  const struct hsr_polygons *polygons = subject->polygons;
  double low[2], high[2];
  find_box((const double(*)[2])plot->strokes.at, plot->strokes.n_at, low, high);
  for (size_t k = 0; polygons && k < polygons->n_sides; k++)
    widen_box(polygons->side[k].at, low, high);
  struct hsr_page page = plot->page;
  if (page.crop)
    page.margin += find_ink(plot);
  enum hsr_status status =
      hsr_page_lay_out(&page, subject->view, low, high, &plot->layout, err);
  if (status)
    return status;
  const struct hsr_layout *l = &plot->layout;
  for (size_t k = 0; k < plot->strokes.n_at; k++) {
    plot->strokes.at[k][0] = l->left + l->scale * plot->strokes.at[k][0];
    plot->strokes.at[k][1] = l->top + l->scale * plot->strokes.at[k][1];
  }
  return HSR_OK;
}

static void find_groups(struct hsr_plot *plot) {
  const struct hsr_strokes *s = &plot->strokes;
  for (size_t k = 0, n; k < s->n; k += n) {
    for (n = 1; k + n < s->n && s->stroke[k + n].group == s->stroke[k].group;)
      n++;
    plot->group[s->stroke[k].group].first = k;
    plot->group[s->stroke[k].group].n = n;
  }
}

/* The lines' groups are the places of their keys. */
static enum hsr_status join_lines(struct hsr_plot *plot,
                                  const struct hsr_paper_lines *lines,
                                  const struct hsr_line_style *style,
                                  const struct hsr_scene *scene,
                                  struct hsr_error *err) {
  uint64_t *key = malloc((lines->n + 1) * sizeof *key);
  struct hsr_pen_line *pen_line = malloc((lines->n + 1) * sizeof *pen_line);
  if (!key || !pen_line) {
    free(key);
    free(pen_line);
    return hsr_fail_nomem(err);
  }
  for (size_t k = 0; k < lines->n; k++)
    key[k] = key_of(&lines->line[k], style->layers);
  const size_t n = sort_keys(key, lines->n);
  for (size_t k = 0; k < lines->n; k++) {
    const struct hsr_paper_line *line = &lines->line[k];
    const uint64_t own = key_of(line, style->layers);
    const uint64_t *found = bsearch(&own, key, n, sizeof *key, by_key);
    pen_line[k] = (struct hsr_pen_line){.group = (uint32_t)(found - key),
                                        .from = line->from,
                                        .to = line->to,
                                        .straight = line->straight};
  }
  enum hsr_status status = make_groups(plot, key, n, style->layers, scene, err);
  if (!status)
    status = hsr_strokes_join(&plot->strokes, pen_line, lines->n,
                              (const double(*)[2])lines->node, err);
  free(key);
  free(pen_line);
  return status;
}

static enum hsr_status add_lines(struct hsr_plot *plot,
                                 const struct hsr_plot_subject *subject,
                                 const struct hsr_line_style *style,
                                 struct hsr_error *err) {
  const struct hsr_scene *scene = subject->world->roster.scene;
  struct hsr_paper_lines lines = {.n = 0};
  enum hsr_status status = hsr_line_pens_init(&plot->pens, style, scene, err);
  if (!status && hsr_line_pens_draw_all(&plot->pens, scene))
    plot->drawing = subject->drawing;
  if (!status)
    status = hsr_lines_find(&lines, subject->drawing, subject->world,
                            subject->view, style->crease, &plot->pens, err);
  if (!status)
    status = join_lines(plot, &lines, style, scene, err);
  hsr_lines_free(&lines);
  return status;
}

/* The colours of regions. */
static enum hsr_status add_faces(struct hsr_plot *plot,
                                 const struct hsr_plot_subject *subject,
                                 enum hsr_shading shading,
                                 struct hsr_error *err) {
  const struct hsr_polygons *polygons = subject->polygons;
  plot->polygons = polygons;
  plot->fill = malloc((polygons->n_regions + 1) * sizeof *plot->fill);
  if (!plot->fill)
    return hsr_fail_nomem(err);
  for (size_t r = 0; r < polygons->n_regions; r++)
    hsr_picture_colour(subject->world, subject->view, polygons->region[r].face,
                       shading, plot->fill[r].rgb);
  return hsr_shared_sides_find(&plot->shared, polygons, err);
}

enum hsr_status hsr_plot_init(struct hsr_plot *plot,
                              const struct hsr_plot_subject *subject,
                              const struct hsr_plot_look *look,
                              struct hsr_error *err) {
  const struct hsr_view *view = subject->view;
  *plot = (struct hsr_plot){.page = look->page,
                            .m = view->m,
                            .n = view->n,
                            .cuts_dashes = look->style->cuts_dashes,
                            .paper = {1, 1, 1}};
  enum hsr_status status = HSR_OK;
  if (subject->drawing)
    status = add_lines(plot, subject, look->style, err);
  if (!status && subject->polygons && !look->hatch)
    status = add_faces(plot, subject, look->shading, err);
  if (!status && plot->polygons && !subject->drawing)
    hsr_picture_colour(subject->world, view, HSR_BACKGROUND, look->shading,
                       plot->paper);
  if (!status)
    status = lay_out(plot, subject, err);
  if (!status)
    find_groups(plot);
  if (!status && subject->polygons && look->hatch)
    status = hsr_plot_hatch(plot, subject, &look->style->hatch, err);
  if (!status && look->style->by_pen_travel)
    status = hsr_strokes_order(&plot->strokes, err);
  return status;
}

void hsr_plot_free(struct hsr_plot *plot) {
  hsr_line_pens_free(&plot->pens);
  hsr_strokes_free(&plot->strokes);
  free(plot->layer);
  free(plot->group);
  free(plot->fill);
  hsr_shared_sides_free(&plot->shared);
  *plot = (struct hsr_plot){.n_layers = 0};
}

enum hsr_status hsr_plot_write(const struct hsr_plot *plot, const char *path,
                               struct hsr_error *err) {
  if (hsr_ends_in(path, ".svg"))
    return hsr_plot_write_svg(plot, path, err);
  if (hsr_ends_in(path, ".dxf"))
    return hsr_plot_write_dxf(plot, path, err);
  return hsr_plot_write_page(plot, path, hsr_ends_in(path, ".eps"), err);
}
