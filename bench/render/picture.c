/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Drawing, showing and writing one picture of hsr render. */
#include "bench/library/library.h"
#include "bench/options/words.h"
#include "bench/render/render.h"
#include "bench/ranks/ranks.h"
#include "bench/run/crew.h"
#include "common/answers/on_paper.h"
#include "common/base/clock.h"
#include "common/files/image.h"
#include "common/files/suffix.h"

#include <stdlib.h>
#include <string.h>

/* Makes the memory of a picture, or clears it. */
static enum hsr_status clear(struct render *r, struct hsr_error *err) {
  size_t n = (size_t)r->view.m * (size_t)r->view.n;
  hsr_shaded_free(&r->shaded);
  enum hsr_status status =
      r->answer.body ? HSR_OK
                     : answer_init(&r->answer, &r->setup, &r->view, err);
  if (status || !r->options->work)
    return status;
  if (!r->work)
    r->work = malloc(n * sizeof *r->work);
  if (!r->work)
    return hsr_fail_nomem(err);
  memset(r->work, 0, n * sizeof *r->work);
  r->tally.work = r->work;
  r->tally.work_stride = (size_t)r->view.m;
  return HSR_OK;
}

enum hsr_status draw_picture(struct render *r, struct hsr_error *err) {
  enum hsr_status status = choose_exposure(r, err);
  if (!status)
    status = clear(r, err);
  if (status)
    return status;
  if (r->options->passes || r->options->uncertainty || r->options->certain) {
    r->passes = (struct hsr_passes){write_pass, r};
    r->setup.passes = &r->passes;
  }
  double begin = hsr_seconds_now();
  status =
      crew_render(r->crew, &r->setup, &r->view, &r->answer, &r->tally, err);
  r->draw += hsr_seconds_now() - begin;
  if (status || !r->pass_status)
    return status;
  *err = r->pass_err;
  return r->pass_status;
}

/* --- Showing and writing -------------------------------------------------- */

struct hsr_showing showing_of(const struct render *r) {
  const struct render_options *o = r->options;
  return (struct hsr_showing){
      .world = &r->world,
      .view = &r->view,
      .scene = o->scene.name,
      .shading = o->shading,
      .depth = true,
      .supersamples = (int)o->supersamples,
      .style = &o->style,
      .fill = r->fill.body,
      .hatch = o->hatch,
      .page = o->page,
      .background = {o->has_background,
                     o->no_background,
                     {o->background[0], o->background[1], o->background[2]}}};
}

/* Does what comes between drawing and writing. */
enum hsr_status shade_picture(struct render *r, struct hsr_error *err) {
  struct hsr_showing showing = showing_of(r);
  double begin = hsr_seconds_now();
  enum hsr_status status = HSR_OK;
  if (r->kind->shade && (r->options->n_outputs || r->options->work || r->shows))
    status = r->kind->shade(&r->answer, &showing, &r->shaded, err);
  r->shade += hsr_seconds_now() - begin;
  return status;
}

/* The file's name: of a series, with the view's number. */
static const char *file_name(const struct render *r, const char *given,
                             char name[MOST_FILE_NAME]) {
  return is_series(r->options) && series_name(given, r->view_number, name)
             ? name
             : given;
}

/* Drawings of lines on paper are written together. Those of a series have names
 * of their own. */
static bool goes_on_paper(const struct render *r, const char *file) {
  return hsr_answer_lines(&r->answer) && hsr_is_paper_file(file) &&
         !is_series(r->options);
}

static enum hsr_status write_papers(const struct render *r,
                                    const struct hsr_showing *showing,
                                    struct hsr_error *err) {
  const struct render_options *o = r->options;
  const char *file[MOST_OUTPUTS];
  size_t n = 0;
  for (int k = 0; k < o->n_outputs; k++)
    if (goes_on_paper(r, o->output[k]))
      file[n++] = o->output[k];
  return n ? hsr_write_on_paper(showing, hsr_answer_lines(&r->answer),
                                showing->fill, file, n, err)
           : HSR_OK;
}

enum hsr_status write_picture(struct render *r, struct hsr_error *err) {
  const struct hsr_algorithm *a = r->setup.algorithm;
  const struct render_options *o = r->options;
  char name[MOST_FILE_NAME];
  struct lib_texts texts;
  struct hsr_showing showing = showing_of(r);
  lib_set_texts(&showing, &texts, r->view_number, a);
  showing.drawn = &r->drawn;
  double begin = hsr_seconds_now();
  enum hsr_status status = write_papers(r, &showing, err);
  for (int k = 0; k < o->n_outputs && !status; k++)
    if (!goes_on_paper(r, o->output[k]))
      status = r->kind->write(&r->answer, &showing, &r->shaded,
                              file_name(r, o->output[k], name), err);
  if (o->work && !status)
    status = hsr_image_write_work(file_name(r, o->work, name), r->view.m,
                                  r->view.n, r->work, err);
  r->write += hsr_seconds_now() - begin;
  return status;
}

enum hsr_status make_picture(struct render *r, struct hsr_error *err) {
  enum hsr_status status = draw_picture(r, err);
  if (!status && r->options->fill)
    status = draw_fill(r, err);
  if (status || ranks_own())
    return status;
  status = shade_picture(r, err);
  if (!status)
    status = write_picture(r, err);
  if (!status)
    r->n_pictures++;
  return status;
}

void render_forget(struct render *r) {
  hsr_answer_free(&r->answer);
  hsr_shaded_free(&r->shaded);
  free(r->work);
  r->work = NULL;
}

void render_forget_scene(struct render *r) {
  forget_fill(r);
  if (r->setup.algorithm)
    hsr_setup_free(&r->setup);
  hsr_world_free(&r->world);
  render_forget(r);
  hsr_scene_delete(r->scene);
  r->setup = (struct hsr_setup){.algorithm = NULL};
  r->world = (struct hsr_world){.n_faces = 0};
  r->scene = NULL;
}

void render_close(struct render *r) {
  forget_fill(r);
  if (r->setup.algorithm)
    hsr_setup_free(&r->setup);
  hsr_world_free(&r->world);
  render_forget(r);
  crew_free(r->crew);
}
