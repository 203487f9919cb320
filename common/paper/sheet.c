/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/paper/sheet.h"

#include <stdlib.h>
#include <string.h>

bool hsr_sheet_cell(const char *view, bool first_angle, int cell[2]) {
  static const struct {
    const char *name;
    int third[2], first[2];
  } cells[] = {{"front", {1, 1}, {1, 1}},  {"top", {1, 0}, {1, 2}},
               {"bottom", {1, 2}, {1, 0}}, {"left", {0, 1}, {2, 1}},
               {"right", {2, 1}, {0, 1}},  {"back", {3, 1}, {3, 1}},
               {"iso", {2, 0}, {2, 2}},    {"dimetric", {3, 0}, {3, 2}}};
  for (size_t k = 0; k < sizeof cells / sizeof *cells; k++)
    if (!strcmp(cells[k].name, view)) {
      memcpy(cell, first_angle ? cells[k].first : cells[k].third,
             sizeof cells[k].first);
      return true;
    }
  return false;
}

/* --- Putting together ----------------------------------------------------- */

/* A group of a part, and where it goes. */
struct source {
  size_t part, group;
  const struct hsr_plot_layer *layer;
  uint32_t pen;  /* of the sheet */
  size_t number; /* of the sheet's groups */
};

static bool is_same_pen(const struct hsr_line_pen *a,
                        const struct hsr_line_pen *b) {
  return a->width == b->width && !memcmp(a->rgb, b->rgb, sizeof a->rgb) &&
         a->dash == b->dash && a->gap == b->gap;
}

static uint32_t add_pen(struct hsr_plot *sheet,
                        const struct hsr_line_pen *pen) {
  uint32_t k = 0;
  while (k < sheet->pens.n && !is_same_pen(&sheet->pens.pen[k], pen))
    k++;
  if (k == sheet->pens.n)
    sheet->pens.pen[sheet->pens.n++] = *pen;
  return k;
}

/* The number of the sheet's layer of that id, which is appended if it is new. */
static size_t add_layer(struct hsr_plot *sheet,
                        const struct hsr_plot_layer *layer) {
  size_t k = 0;
  while (k < sheet->n_layers && strcmp(sheet->layer[k].id, layer->id) != 0)
    k++;
  if (k == sheet->n_layers) {
    sheet->layer[sheet->n_layers] = *layer;
    sheet->layer[sheet->n_layers++].n = 0;
  }
  return k;
}

static size_t list_groups(struct hsr_plot *sheet, const struct hsr_plot *part,
                          size_t n, struct source *source) {
  size_t n_sources = 0;
  for (size_t k = 0; k < n; k++)
    for (size_t l = 0; l < part[k].n_layers; l++) {
      const struct hsr_plot_layer *layer = &part[k].layer[l];
      add_layer(sheet, layer);
      for (size_t g = layer->first; g < layer->first + layer->n; g++)
        source[n_sources++] = (struct source){
            .part = k,
            .group = g,
            .layer = layer,
            .pen = add_pen(sheet, hsr_plot_pen(&part[k], &part[k].group[g]))};
    }
  return n_sources;
}

/* Makes the sheet's groups, layer by layer. */
static void make_groups(struct hsr_plot *sheet, struct source *source,
                        size_t n) {
  for (size_t l = 0; l < sheet->n_layers; l++) {
    struct hsr_plot_layer *layer = &sheet->layer[l];
    layer->first = sheet->n_groups;
    for (size_t k = 0; k < n; k++) {
      if (strcmp(source[k].layer->id, layer->id) != 0)
        continue;
      size_t g = layer->first;
      while (g < sheet->n_groups && sheet->group[g].pen != source[k].pen)
        g++;
      if (g == sheet->n_groups)
        sheet->group[sheet->n_groups++] =
            (struct hsr_plot_group){.pen = source[k].pen};
      source[k].number = g;
    }
    layer->n = sheet->n_groups - layer->first;
  }
}

/* Appends the strokes of a part's group. */
static void add_strokes(struct hsr_plot *sheet, const struct hsr_plot *part,
                        const struct hsr_plot_group *group, size_t number,
                        const double offset[2]) {
  struct hsr_strokes *all = &sheet->strokes;
  for (size_t k = group->first; k < group->first + group->n; k++) {
    struct hsr_stroke stroke = part->strokes.stroke[k];
    const double(*at)[2] = (const double(*)[2])part->strokes.at + stroke.first;
    stroke.group = (uint32_t)number;
    stroke.first = all->n_at;
    all->stroke[all->n++] = stroke;
    for (size_t i = 0; i < stroke.n; i++, all->n_at++)
      for (int c = 0; c < 2; c++)
        all->at[all->n_at][c] = at[i][c] + offset[c];
  }
}

static bool make_room(struct hsr_plot *sheet, const struct hsr_plot *part,
                      size_t n, struct source **source) {
  size_t groups = 0, strokes = 0, places = 0, pens = 0;
  for (size_t k = 0; k < n; k++) {
    groups += part[k].n_groups;
    strokes += part[k].strokes.n;
    places += part[k].strokes.n_at;
    pens += part[k].pens.n;
  }
  *source = malloc((groups + 1) * sizeof **source);
  sheet->group = malloc((groups + 1) * sizeof *sheet->group);
  sheet->layer = malloc((groups + 1) * sizeof *sheet->layer);
  sheet->pens.pen = malloc((pens + 1) * sizeof *sheet->pens.pen);
  sheet->strokes.stroke = malloc((strokes + 1) * sizeof *sheet->strokes.stroke);
  sheet->strokes.at = malloc((places + 1) * sizeof *sheet->strokes.at);
  return *source && sheet->group && sheet->layer && sheet->pens.pen &&
         sheet->strokes.stroke && sheet->strokes.at;
}

enum hsr_status hsr_plot_sheet(struct hsr_plot *sheet,
                               const struct hsr_plot *part, size_t n,
                               const double (*offset)[2], double width,
                               double height, struct hsr_error *err) {
  struct source *source;
  *sheet = (struct hsr_plot){.page = part->page,
                             .layout = {1, 0, 0, width, height},
                             .m = part->m,
                             .n = part->n,
                             .cuts_dashes = part->cuts_dashes,
                             .paper = {1, 1, 1}};
  if (!make_room(sheet, part, n, &source)) {
    free(source);
    return hsr_fail_nomem(err);
  }
  const size_t n_sources = list_groups(sheet, part, n, source);
  make_groups(sheet, source, n_sources);
  for (size_t g = 0; g < sheet->n_groups; g++) {
    sheet->group[g].first = sheet->strokes.n;
    for (size_t k = 0; k < n_sources; k++)
      if (source[k].number == g)
        add_strokes(sheet, &part[source[k].part],
                    &part[source[k].part].group[source[k].group], g,
                    offset[source[k].part]);
    sheet->group[g].n = sheet->strokes.n - sheet->group[g].first;
  }
  free(source);
  return HSR_OK;
}
