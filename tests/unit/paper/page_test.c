/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How a drawing lies on its page, and the pens of styles. */
#include "common/paper/lines/line_style.h"
#include "common/paper/page.h"
#include "tests/tap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool is(double got, double wanted) {
  return fabs(got - wanted) < 1e-9 * (1 + fabs(wanted));
}

/* ---- Pages ---- */

/* A picture of 200 x 100 pixels, 10 units of the scene high, in parallel. */
static struct hsr_view view_of(double parallel) {
  const struct hsr_camera camera = {
      .eye = {0, 0, 5}, .up = {0, 1, 0}, .fov = 60, .parallel = parallel};
  struct hsr_view view;
  if (hsr_view_init(&view, &camera, 200, 100, NULL))
    bail("a view");
  return view;
}

static void try_pages(struct tap *t) {
  const struct hsr_view view = view_of(10), deep = view_of(0);
  static const double low[2] = {50, 20}, high[2] = {150, 70};
  struct hsr_layout l;
  struct hsr_page page = {.width = 0};
  ok(t,
     !hsr_page_lay_out(&page, &view, low, high, &l, NULL) && is(l.scale, 1) &&
         is(l.left, 0) && is(l.width, 200) && is(l.height, 100),
     "as it is: a pixel is a pixel");
  page.width = 50;
  ok(t,
     !hsr_page_lay_out(&page, &view, low, high, &l, NULL) &&
         is(l.width, 50 * HSR_PIXELS_PER_MM) &&
         is(l.height, 25 * HSR_PIXELS_PER_MM) && is(l.scale * 200, l.width),
     "50 mm wide");
  page = (struct hsr_page){.width = 50, .crop = true, .margin = 5};
  ok(t,
     !hsr_page_lay_out(&page, &view, low, high, &l, NULL) &&
         is(l.scale * 100, 40 * HSR_PIXELS_PER_MM) &&
         is(l.left + 50 * l.scale, 5 * HSR_PIXELS_PER_MM) &&
         is(l.top + 20 * l.scale, 5 * HSR_PIXELS_PER_MM) &&
         is(l.height, 30 * HSR_PIXELS_PER_MM),
     "cropped, with margins");
  page = (struct hsr_page){.width = 100, .height = 100};
  ok(t,
     !hsr_page_lay_out(&page, &view, low, high, &l, NULL) &&
         is(l.height, 100 * HSR_PIXELS_PER_MM) &&
         is(l.top, 25 * HSR_PIXELS_PER_MM) && is(l.left, 0),
     "a page of another shape has it in the middle");
  page = (struct hsr_page){.scale = 1. / 20, .unit = 1000};
  ok(t,
     !hsr_page_lay_out(&page, &view, low, high, &l, NULL) &&
         is(l.height, 10 * 1000 / 20. * HSR_PIXELS_PER_MM),
     "1:20, of metres");
  struct hsr_error err;
  ok(t,
     hsr_page_lay_out(&page, &deep, low, high, &l, &err) == HSR_E_USAGE &&
         strstr(err.text, "parallel"),
     "no scale in perspective");
  page = (struct hsr_page){.scale = 1, .width = 5};
  ok(t, hsr_page_lay_out(&page, &view, low, high, &l, &err) == HSR_E_USAGE,
     "no scale and width at once");
  page = (struct hsr_page){.width = 10, .margin = 5};
  ok(t, hsr_page_lay_out(&page, &view, low, high, &l, &err) == HSR_E_USAGE,
     "margins leave room");
  page = (struct hsr_page){.scale = 1, .unit = 1e4};
  ok(t, hsr_page_lay_out(&page, &view, low, high, &l, &err) == HSR_E_USAGE,
     "no page of a hundred metres");
}

/* ---- Styles ---- */

static struct hsr_line_style
read_style(const char *text, enum hsr_status *status, struct hsr_error *err) {
  char path[] = "/tmp/hsr-style-XXXXXX.json";
  struct hsr_line_style style = {.n_rules = 0};
  const int file = mkstemps(path, 5);
  if (file < 0 || write(file, text, strlen(text)) < 0)
    bail("a file");
  close(file);
  *status = hsr_line_style_read(path, &style, err);
  unlink(path);
  return style;
}

static struct hsr_line_pen pen_of(const struct hsr_line_style *style,
                                  const char *object,
                                  enum hsr_line_class line_class,
                                  uint32_t invisibility) {
  struct hsr_scene *scene = hsr_scene_new("s");
  struct hsr_line_pens pens;
  if (!scene || !hsr_scene_object(scene, object) ||
      hsr_line_pens_init(&pens, style, scene, NULL))
    bail("pens");
  const uint32_t number = hsr_line_pen_of(&pens, 0, line_class, invisibility);
  struct hsr_line_pen pen = {.draws = false};
  if (number != HSR_NO_PEN)
    pen = pens.pen[number];
  hsr_line_pens_free(&pens);
  hsr_scene_delete(scene);
  return pen;
}

static void try_styles(struct tap *t) {
  struct hsr_line_style s;
  ok(t, !hsr_line_style_named("none", &s), "a style that there is not");
  hsr_line_style_named("iso", &s);
  ok(t,
     is(pen_of(&s, "a", HSR_LINE_CREASE, 0).width, .5) &&
         is(pen_of(&s, "a", HSR_LINE_COLOUR, 0).width, .25) &&
         !pen_of(&s, "a", HSR_LINE_SMOOTH, 0).draws &&
         !pen_of(&s, "a", HSR_LINE_CREASE, 1).draws,
     "iso: visible lines .5 mm, between colours .25 mm");
  hsr_line_style_hide(&s, HSR_HIDDEN_DASHED, NULL);
  const struct hsr_line_pen hidden = pen_of(&s, "a", HSR_LINE_CREASE, 5);
  ok(t,
     hidden.draws && is(hidden.width, .25) && is(hidden.dash, 3) &&
         is(hidden.gap, .75) && !pen_of(&s, "a", HSR_LINE_SMOOTH, 1).draws,
     "hidden lines dashed: 12 and 3 widths; lines of one plane stay left out");
  hsr_line_style_plain(&s, HSR_HIDDEN_THIN);
  ok(t,
     pen_of(&s, "a", HSR_LINE_SEAM, 1).width >
             pen_of(&s, "a", HSR_LINE_SEAM, 2).width &&
         pen_of(&s, "a", HSR_LINE_SEAM, 2).width >
             pen_of(&s, "a", HSR_LINE_SEAM, 9).width,
     "thin: the more faces hide them, the thinner");

  enum hsr_status status;
  struct hsr_error err = {.text = ""};
  s = read_style("{\"schema\": \"hsr-style/1\", \"base\": \"iso\", \"crease\": "
                 "30, \"layers\": \"class\", \"rules\": [{\"class\": "
                 "[\"crease\", \"boundary\"], \"visibility\": \"visible\", "
                 "\"object\": \"wheel*\", \"width\": 0.7, \"colour\": "
                 "\"#0080ff\", \"dash\": [2, 1]}, {\"visibility\": "
                 "\"hidden-2\", \"draw\": true, \"dash\": \"solid\"}]}",
                 &status, &err);
  const struct hsr_line_pen wheel = pen_of(&s, "wheel 2", HSR_LINE_CREASE, 0);
  ok(t,
     !status && s.crease == 30 && s.layers == HSR_LAYERS_CLASS &&
         is(wheel.width, .7) && wheel.rgb[1] == 0x80 && is(wheel.dash, 2),
     "a file: %s", err.text);
  ok(t,
     is(pen_of(&s, "frame", HSR_LINE_CREASE, 0).width, .5) &&
         is(pen_of(&s, "wheel", HSR_LINE_SILHOUETTE, 0).width, .5) &&
         pen_of(&s, "frame", HSR_LINE_CREASE, 2).draws &&
         pen_of(&s, "frame", HSR_LINE_CREASE, 2).dash == 0 &&
         !pen_of(&s, "frame", HSR_LINE_CREASE, 1).draws,
     "rules are about what they name, and nothing else");

  static const char *const bad[][2] = {
      {"{}", "schema"},
      {"{\"schema\": \"hsr-style/1\", \"base\": \"x\"}", "screen, iso or"},
      {"{\"schema\": \"hsr-style/1\", \"crease\": 181}", "0 to 180"},
      {"{\"schema\": \"hsr-style/1\", \"rules\": [{\"class\": \"edge\"}]}",
       "silhouette"},
      {"{\"schema\": \"hsr-style/1\", \"rules\": [{\"width\": 0}]}", "above 0"},
      {"{\"schema\": \"hsr-style/1\", \"rules\": [{\"colour\": \"red\"}]}",
       "#rrggbb"},
      {"{\"schema\": \"hsr-style/1\", \"rules\": [{\"dash\": [1]}]}", ""},
      {"{\"schema\": \"hsr-style/1\", \"rules\": [{\"colr\": 1}]}", "colr"}};
  for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
    read_style(bad[k][0], &status, &err);
    ok(t, status == HSR_E_INPUT && strstr(err.text, bad[k][1]), "refused: %s",
       err.text);
  }
}

int main(void) {
  struct tap t = plan(9 + 6 + 8);
  try_pages(&t);
  try_styles(&t);
  return finish(&t);
}
