/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Several standard views on one sheet, to one scale.
 *
 * Every view is drawn as a picture of the same height in the scene, so that a
 * unit has one length in all of them. The front is in the middle of its picture,
 * and so are the others: so views in one row, or one column, are aligned. Their
 * plots are made twice: first to find how large they are, and then to scale. */
#include "config.h"

#include "bench/library/library.h"
#include "bench/ranks/ranks.h"
#include "bench/render/render.h"
#include "bench/terminal/terminal.h"
#include "common/base/clock.h"
#include "common/paper/sheet.h"
#include "common/view/standard.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double GAP = 15; /* between views, millimetres */

struct sheet {
  struct render *r;
  const char *name[HSR_STANDARD_VIEWS]; /* of the views */
  int cell[HSR_STANDARD_VIEWS][2];
  size_t n;
  struct hsr_view view[HSR_STANDARD_VIEWS];
  struct hsr_answer answer[HSR_STANDARD_VIEWS], fill[HSR_STANDARD_VIEWS];
  struct hsr_plot plot[HSR_STANDARD_VIEWS];
  double offset[HSR_STANDARD_VIEWS][2];
  double width, height; /* pixels of the page */
};

/* --- Views ---------------------------------------------------------------- */

/* Takes the list of views apart. `text` is changed. */
static enum hsr_status parse_views(struct sheet *s, char *text,
                                   struct hsr_error *err) {
  const bool first_angle = s->r->options->first_angle;
  for (char *word; (word = strsep(&text, ","));) {
    for (size_t k = 0; k < s->n; k++)
      if (!strcmp(s->name[k], word))
        return hsr_fail(err, HSR_E_USAGE, "--sheet: %s is there twice", word);
    if (s->n == HSR_STANDARD_VIEWS ||
        !hsr_sheet_cell(word, first_angle, s->cell[s->n]))
      return hsr_fail(err, HSR_E_USAGE,
                      "--sheet: '%.40s' is none of front, back, left, right, "
                      "top, bottom, iso and dimetric",
                      word);
    s->name[s->n++] = word;
  }
  return HSR_OK;
}

/* The cameras of all views: each in the middle of the scene, and as high as the
 * highest needs. */
static enum hsr_status aim(struct sheet *s, struct hsr_error *err) {
  const struct render *r = s->r;
  const int m = r->view.m, n = r->view.n;
  struct hsr_camera camera[HSR_STANDARD_VIEWS];
  double height = 0;
  enum hsr_status status = HSR_OK;
  for (size_t k = 0; k < s->n && !status; k++) {
    camera[k] = r->view.camera;
    status = hsr_standard_view(r->scene, s->name[k], -1, &camera[k], err);
    if (!status)
      status = hsr_camera_fit(r->scene, m, n, &camera[k], err);
    height = fmax(height, camera[k].parallel);
  }
  for (size_t k = 0; k < s->n && !status; k++) {
    camera[k].parallel = height;
    status = hsr_view_init(&s->view[k], &camera[k], m, n, err);
  }
  return status;
}

/* Draws all views. The answers are kept. */
static enum hsr_status draw(struct sheet *s, struct hsr_error *err) {
  struct render *r = s->r;
  struct progress progress = progress_begin(stderr);
  enum hsr_status status = HSR_OK;
  for (size_t k = 0; k < s->n && !status; k++) {
    progress_tell(&progress, k, s->n, "views", s->name[k]);
    r->view = s->view[k];
    status = draw_picture(r, err);
    if (!status && r->options->fill)
      status = draw_fill(r, err);
    s->answer[k] = r->answer;
    s->fill[k] = r->fill;
    r->answer = r->fill = (struct hsr_answer){.body = NULL};
  }
  progress_end(&progress);
  return status;
}

/* --- Places --------------------------------------------------------------- */

/* Makes the plots, of which a pixel is `scale` pixels of the page. */
static enum hsr_status make_plots(struct sheet *s, double scale, bool hatch,
                                  struct hsr_error *err) {
  const struct render_options *o = s->r->options;
  enum hsr_status status = HSR_OK;
  for (size_t k = 0; k < s->n && !status; k++) {
    const struct hsr_view *view = &s->view[k];
    const struct hsr_plot_subject subject = {
        .drawing = hsr_answer_lines(&s->answer[k]),
        .polygons = hatch ? s->fill[k].body : NULL,
        .world = &s->r->world,
        .view = view};
    const struct hsr_plot_look look = {
        .style = &o->style,
        .hatch = hatch,
        .page = {.scale = scale * view->n / view->camera.parallel /
                          HSR_PIXELS_PER_MM}};
    hsr_plot_free(&s->plot[k]);
    status = hsr_plot_init(&s->plot[k], &subject, &look, err);
  }
  return status;
}

/* How far a plot reaches to either side of its middle, across or down. */
static void find_reach(const struct hsr_plot *plot, int c, double reach[2]) {
  const double middle = (c ? plot->layout.height : plot->layout.width) / 2;
  for (size_t k = 0; k < plot->strokes.n_at; k++) {
    const double far = plot->strokes.at[k][c] - middle;
    reach[0] = fmax(reach[0], -far);
    reach[1] = fmax(reach[1], far);
  }
}

/* Gives each column, or row, as much room as its views need. *size becomes that
 * of all of them, with margins and gaps, and *fixed that of margins and gaps
 * alone. */
static void place(struct sheet *s, int c, double margin, double *size,
                  double *fixed) {
  double reach[HSR_SHEET_COLUMNS][2] = {{0, 0}}, middle[HSR_SHEET_COLUMNS];
  bool used[HSR_SHEET_COLUMNS] = {false};
  for (size_t k = 0; k < s->n; k++) {
    used[s->cell[k][c]] = true;
    find_reach(&s->plot[k], c, reach[s->cell[k][c]]);
  }
  double at = margin, gap = 0;
  *fixed = 2 * margin;
  for (int i = 0; i < HSR_SHEET_COLUMNS; i++) {
    if (!used[i])
      continue;
    at += gap;
    *fixed += gap;
    middle[i] = at + reach[i][0];
    at += reach[i][0] + reach[i][1];
    gap = GAP * HSR_PIXELS_PER_MM;
  }
  *size = at + margin;
  for (size_t k = 0; k < s->n; k++) {
    const struct hsr_layout *l = &s->plot[k].layout;
    s->offset[k][c] = middle[s->cell[k][c]] - (c ? l->height : l->width) / 2;
  }
}

static void place_all(struct sheet *s, double margin, double fixed[2]) {
  place(s, 0, margin, &s->width, &fixed[0]);
  place(s, 1, margin, &s->height, &fixed[1]);
}

/* If a page is larger than its views, they are in its middle. */
static void centre(struct sheet *s) {
  const struct hsr_page *page = &s->r->options->page;
  double *const size[2] = {&s->width, &s->height};
  const double asked[2] = {page->width, page->height};
  for (int c = 0; c < 2; c++) {
    const double more = asked[c] * HSR_PIXELS_PER_MM - *size[c];
    if (!(asked[c] > 0))
      continue;
    for (size_t k = 0; k < s->n; k++)
      s->offset[k][c] += more / 2;
    *size[c] += more;
  }
}

/* The pixels of the page for one of a picture. */
static enum hsr_status choose_scale(struct sheet *s, double margin,
                                    double *scale, struct hsr_error *err) {
  const struct hsr_page *page = &s->r->options->page;
  const struct hsr_view *view = &s->view[0];
  *scale = 1;
  if (page->scale > 0) {
    *scale = page->scale * (page->unit > 0 ? page->unit : 1) *
             view->camera.parallel / view->n * HSR_PIXELS_PER_MM;
    return HSR_OK;
  }
  if (!(page->width > 0 || page->height > 0))
    return HSR_OK;
  enum hsr_status status = make_plots(s, 1, false, err);
  if (status)
    return status;
  double fixed[2];
  place_all(s, margin, fixed);
  /* Views grow with the scale; margins and gaps do not. */
  *scale = INFINITY;
  if (page->width > 0)
    *scale =
        (page->width * HSR_PIXELS_PER_MM - fixed[0]) / (s->width - fixed[0]);
  if (page->height > 0)
    *scale = fmin(*scale, (page->height * HSR_PIXELS_PER_MM - fixed[1]) /
                              (s->height - fixed[1]));
  return *scale > 0 ? HSR_OK
                    : hsr_fail(err, HSR_E_USAGE,
                               "--sheet: there is no room for the views "
                               "between gaps of %g mm and the margins",
                               GAP);
}

/* --- The file ------------------------------------------------------------- */

static enum hsr_status write(struct sheet *s, struct hsr_plot *all,
                             struct hsr_error *err) {
  struct render *r = s->r;
  const struct render_options *o = r->options;
  struct hsr_showing showing = showing_of(r);
  struct lib_texts texts;
  lib_set_texts(&showing, &texts, 0, r->setup.algorithm);
  snprintf(texts.description, sizeof texts.description,
           "A drawing by hsr " PACKAGE_VERSION ", %s; --sheet %s",
           r->setup.algorithm->title, o->sheet);
  all->page = o->page;
  all->title = showing.title;
  all->description = showing.description;
  all->has_paper = o->has_background;
  memcpy(all->paper, o->background, sizeof all->paper);
  enum hsr_status status = HSR_OK;
  if (o->style.by_pen_travel)
    status = hsr_strokes_order(&all->strokes, err);
  for (int k = 0; k < o->n_outputs && !status; k++)
    status = hsr_plot_write(all, o->output[k], err);
  const struct hsr_travel travel = hsr_strokes_travel(&all->strokes);
  r->drawn = (struct hsr_drawn){.strokes = all->strokes.n,
                                .ink = travel.down / HSR_PIXELS_PER_MM,
                                .pen_up = travel.up / HSR_PIXELS_PER_MM};
  r->n_on_sheet = s->n;
  r->sheet_mm[0] = s->width / HSR_PIXELS_PER_MM;
  r->sheet_mm[1] = s->height / HSR_PIXELS_PER_MM;
  return status;
}

static enum hsr_status lay_out(struct sheet *s, struct hsr_error *err) {
  const double margin = fmax(s->r->options->page.margin, 1) * HSR_PIXELS_PER_MM;
  struct hsr_plot all = {.n_layers = 0};
  double scale, fixed[2];
  const double begin = hsr_seconds_now();
  enum hsr_status status = choose_scale(s, margin, &scale, err);
  if (!status)
    status = make_plots(s, scale, s->r->options->hatch, err);
  if (!status) {
    place_all(s, margin, fixed);
    centre(s);
    status = hsr_plot_sheet(&all, s->plot, s->n, (const double(*)[2])s->offset,
                            s->width, s->height, err);
  }
  if (!status)
    status = write(s, &all, err);
  hsr_plot_free(&all);
  s->r->write += hsr_seconds_now() - begin;
  return status;
}

enum hsr_status make_sheet(struct render *r, struct hsr_error *err) {
  struct sheet *s = calloc(1, sizeof *s);
  char *list = strdup(r->options->sheet);
  enum hsr_status status = s && list ? HSR_OK : hsr_fail_nomem(err);
  if (!status) {
    s->r = r;
    status = parse_views(s, list, err);
  }
  if (!status)
    status = aim(s, err);
  if (!status)
    status = draw(s, err);
  if (!status && !ranks_own())
    status = lay_out(s, err);
  for (size_t k = 0; s && k < s->n; k++) {
    hsr_plot_free(&s->plot[k]);
    hsr_answer_free(&s->fill[k]);
    if (k)
      hsr_answer_free(&s->answer[k]);
    else
      r->answer = s->answer[0]; /* for the report, of the first view */
  }
  if (s && s->n)
    r->view = s->view[0];
  free(s);
  free(list);
  return status;
}
