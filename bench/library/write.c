/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How answers are shown, and written to files. */
#include "config.h"

#include "bench/library/library.h"
#include "common/answers/kinds/segments.h"
#include "common/paper/lines/line_style.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct hsr_showing lib_showing(const struct lib_answer *answer,
                               enum hsr_shading_choice shading) {
  return (struct hsr_showing){.world = answer->world,
                              .view = &answer->view,
                              .scene = answer->scene->scene->name,
                              .shading = (enum hsr_shading)shading,
                              .depth = true,
                              .supersamples = 1};
}

enum hsr_status lib_takes(const struct lib_answer *answer, int setting,
                          const char *what, struct hsr_error *err) {
  const struct hsr_answer_type *type = answer->answer.form.type;
  return type->takes & 1u << setting
             ? HSR_OK
             : hsr_fail(err, HSR_E_USAGE,
                        "an answer of the kind %s takes no account of %s",
                        type->name, what);
}

/* --- The style ------------------------------------------------------------ */

/* Whether the style has only values that there are. */
static enum hsr_status check_values(const struct hsr_style *s,
                                    struct hsr_error *err) {
  if ((int)s->shading < 0 || (int)s->shading > HSR_COLOUR_GOURAUD)
    return hsr_fail(err, HSR_E_USAGE, "style: there is no shading %d",
                    (int)s->shading);
  if ((int)s->hidden < 0 || (int)s->hidden > HSR_LINES_ALL)
    return hsr_fail(err, HSR_E_USAGE, "style: hidden cannot be %d",
                    (int)s->hidden);
  if (!(s->crease >= 0 && s->crease <= 180))
    return hsr_fail(err, HSR_E_USAGE, "style: crease must be 0 to 180");
  for (int c = 0; s->background && c < 3; c++)
    if (!(s->background[c] >= 0 && s->background[c] <= 1))
      return hsr_fail(err, HSR_E_USAGE,
                      "style: background must be from 0 to 1");
  return HSR_OK;
}

/* Whether the answer takes account of the style. */
static enum hsr_status check_style(const struct lib_answer *answer,
                                   const struct hsr_style *s,
                                   struct hsr_error *err) {
  enum hsr_status status = check_values(s, err);
  if (!status && s->shading)
    status = lib_takes(answer, HSR_SHADING, "shading", err);
  if (!status && (s->hidden || s->crease > 0 || s->style))
    status = lib_takes(answer, HSR_LINES, "hidden, crease and style", err);
  if (!status && s->background)
    status = lib_takes(answer, HSR_BACKDROP, "background", err);
  return status;
}

/* How lines are drawn, as by the options of the command. */
static enum hsr_status find_lines(const struct hsr_style *s,
                                  struct hsr_line_style *lines,
                                  struct hsr_error *err) {
  enum hsr_status status =
      hsr_line_style_find(s->style ? s->style : "screen", lines, err);
  if (!status && s->crease > 0)
    status = hsr_line_style_crease(lines, s->crease, err);
  if (!status && s->hidden)
    status = hsr_line_style_hide(lines, (enum hsr_hidden)s->hidden, err);
  return status;
}

/* --- Writing -------------------------------------------------------------- */

/* Shades and writes an answer, which is as it is to be shown. */
static enum hsr_status write_shown(const struct hsr_answer *answer,
                                   const struct hsr_showing *showing,
                                   const char *path, struct hsr_error *err) {
  const struct hsr_answer_type *type = answer->form.type;
  struct hsr_shaded shaded = {.rgb = NULL};
  enum hsr_status status =
      type->shade ? type->shade(answer, showing, &shaded, err) : HSR_OK;
  if (!status)
    status = type->write(answer, showing, &shaded, path, err);
  hsr_shaded_free(&shaded);
  return status;
}

/* Appends a number with as many digits as it needs. */
static void add_number(char *text, size_t size, const char *before, double x) {
  const size_t n = strlen(text);
  for (int digits = 6; digits <= 17; digits++) {
    snprintf(text + n, size - n, "%s%.*g", before, digits, x);
    if (strtod(text + n + strlen(before), NULL) == x)
      break;
  }
}

static void add_place(char *text, size_t size, const char *name,
                      const double place[3]) {
  add_number(text, size, name, place[0]);
  add_number(text, size, ",", place[1]);
  add_number(text, size, ",", place[2]);
}

/* As the options of a command that looks from there. */
static void add_camera(char *text, size_t size, const struct hsr_camera *c) {
  add_place(text, size, "; --eye ", c->eye);
  add_place(text, size, " --at ", c->at);
  add_place(text, size, " --up ", c->up);
  if (c->parallel > 0)
    add_number(text, size, " --parallel ", c->parallel);
  else
    add_number(text, size, " --fov ", c->fov);
  if (c->near > 0)
    add_number(text, size, " --near ", c->near);
}

void lib_set_texts(struct hsr_showing *showing, struct lib_texts *t, long view,
                   const struct hsr_algorithm *a) {
  snprintf(t->text, sizeof t->text,
           "Software=hsr\nScene=%.200s\nAlgorithm=%s\n", showing->scene,
           a->name);
  if (view)
    snprintf(t->title, sizeof t->title, "%.150s, view %ld", showing->scene,
             view);
  else
    snprintf(t->title, sizeof t->title, "%.150s", showing->scene);
  snprintf(t->description, sizeof t->description,
           "A drawing by hsr " PACKAGE_VERSION ", %s", a->title);
  add_camera(t->description, sizeof t->description, &showing->view->camera);
  showing->text = t->text;
  showing->title = t->title;
  showing->description = t->description;
}

/* The scene is held for reading. */
static enum hsr_status write_file(const struct lib_answer *answer,
                                  struct hsr_showing *showing, const char *path,
                                  struct hsr_error *err) {
  struct lib_texts texts;
  lib_set_texts(showing, &texts,
                answer->is_own_view ? (long)answer->number + 1 : 0,
                answer->variant.listed->plain);
  return write_shown(&answer->answer, showing, path, err);
}

enum hsr_status hsr_write(const struct lib_answer *answer, const char *path,
                          const struct hsr_style *style,
                          struct hsr_error *err) {
  struct hsr_style s;
  if (!answer || !path)
    return lib_null(answer ? "path" : "answer", err);
  const struct hsr_answer_type *type = answer->answer.form.type;
  enum hsr_status status = lib_take("style", &s, sizeof s, style, err);
  struct hsr_line_style lines;
  if (!status)
    status = check_style(answer, &s, err);
  if (!status)
    status = find_lines(&s, &lines, err);
  if (status)
    return status;
  if (!type->fits(path))
    return hsr_fail(err, HSR_E_USAGE,
                    "%.200s: cannot hold an answer of the kind %s", path,
                    type->name);
  struct hsr_showing showing = lib_showing(answer, s.shading);
  showing.style = &lines;
  showing.background.given = s.background;
  if (s.background)
    memcpy(showing.background.rgb, s.background, sizeof showing.background.rgb);
  lib_scene_read(answer->scene);
  status = write_file(answer, &showing, path, err);
  lib_scene_leave(answer->scene);
  return status;
}
