/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/judge/differences.h"
#include "common/files/image.h"
#include "common/paper/lines/line_style.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

enum { PATH = 1024 };

/* Writes what differs as a picture, where the kind can be shown so. */
static enum hsr_status write_picture(const struct compared_files *files,
                                     const struct hsr_comparison *comparison,
                                     const char *path, struct hsr_error *err) {
  struct hsr_showing showing = {
      .world = files->world, .view = comparison->view, .supersamples = 1};
  struct hsr_picture picture = {.m = comparison->got->m,
                                .n = comparison->got->n};
  float *rgb = malloc(3 * (size_t)picture.m * (size_t)picture.n * sizeof *rgb);
  if (!rgb)
    return hsr_fail_nomem(err);
  picture.rgb = rgb;
  enum hsr_status status = comparison->got->form.type->show_difference(
      comparison, &showing, rgb, err);
  if (!status)
    status = hsr_image_write(path, &picture, NULL, err);
  free(rgb);
  return status;
}

/* Writes one of the two answers, in the first kind of file that can hold it. */
static enum hsr_status write_answer(const struct compared_files *files,
                                    const struct hsr_answer *answer,
                                    const struct hsr_view *view,
                                    const char *path, struct hsr_error *err) {
  static const char *const suffix[] = {".svg", ".vti", ".png"};
  const struct hsr_answer_type *type = answer->form.type;
  struct hsr_line_style style;
  hsr_line_style_plain(&style, HSR_HIDDEN_DASHED);
  struct hsr_showing showing = {.world = files->world,
                                .view = view,
                                .scene = files->world->roster.scene->name,
                                .title = path,
                                .description = "What hsr check compared.",
                                .supersamples = 1,
                                .style = &style};
  char name[PATH];
  for (int k = 0; k < 3; k++) {
    snprintf(name, sizeof name, "%.*s%s", PATH - 20, path, suffix[k]);
    if (!type->fits(name))
      continue;
    struct hsr_shaded shaded = {.rgb = NULL};
    enum hsr_status status =
        type->shade ? type->shade(answer, &showing, &shaded, err) : HSR_OK;
    if (!status)
      status = type->write(answer, &showing, &shaded, name, err);
    hsr_shaded_free(&shaded);
    return status;
  }
  return HSR_OK;
}

/* The path without its suffix. A letter that may mean something to a shell or a
 * file system becomes '_'. */
static void name_files(const struct compared_files *files,
                       const struct hsr_answer *got, char path[PATH]) {
  char name[PATH / 2];
  snprintf(name, sizeof name, "%.80s-%d-%dx%d-%.200s%s",
           files->world->roster.scene->name, files->view, got->m, got->n,
           files->algorithm, files->counts ? "-counting" : "");
  for (char *c = name; *c; c++)
    if (!isalnum((unsigned char)*c) && !strchr("-.=", *c))
      *c = '_';
  snprintf(path, PATH, "%.*s/%s", PATH / 2 - 40, files->folder, name);
}

enum hsr_status write_difference(const struct compared_files *files,
                                 const struct hsr_comparison *comparison,
                                 struct hsr_error *err) {
  char path[PATH], one[PATH];
  name_files(files, comparison->got, path);
  if (comparison->got->form.type->show_difference) {
    snprintf(one, sizeof one, "%.*s.png", PATH - 20, path);
    return write_picture(files, comparison, one, err);
  }
  snprintf(one, sizeof one, "%.*s-got", PATH - 20, path);
  enum hsr_status status =
      write_answer(files, comparison->got, comparison->view, one, err);
  if (status)
    return status;
  snprintf(one, sizeof one, "%.*s-wanted", PATH - 20, path);
  return write_answer(files, comparison->wanted, comparison->view, one, err);
}
