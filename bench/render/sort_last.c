/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr render --sort-last: a scene larger than memory, part by part. Each rank
 * opens and draws one part after the other, and keeps only what is seen; at last
 * the ranks put their pictures together (bench/ranks/composite.h). A kind that is
 * folded from pictures of ids is folded at last, by rank 0, from whole pictures.
 * Of a kind that is summed, the parts of a grid are drawn into the same sums, and
 * those of all ranks are added. */
#include "bench/modules/variant.h"
#include "bench/render/render.h"
#include "bench/ranks/composite.h"
#include "bench/ranks/ranks.h"
#include "bench/ranks/sums.h"
#include "bench/run/crew.h"
#include "bench/terminal/terminal.h"
#include "common/base/clock.h"

#include <stdlib.h>

/* What the parts are drawn with. */
struct sorting {
  struct render *render;
  const struct hsr_algorithm *algorithm;
  const struct hsr_variant *variant;
  struct hsr_choice choice;    /* of pictures of ids, or of what is summed */
  const struct hsr_fold *fold; /* NULL: that picture is wanted itself */
  struct hsr_view view;        /* that is wanted */
  struct hsr_scene_part part;
  struct composite *composite; /* a picture */
  long n;
  const struct hsr_summing *summing; /* NULL: pictures of ids are wanted */
  struct hsr_answer sums;            /* .body is NULL at first */
  struct progress progress;
};

/* The view of picture k. */
static enum hsr_status choose_picture(struct sorting *s, long k,
                                      struct hsr_error *err) {
  struct hsr_view *view = &s->render->view;
  *view = s->view;
  return s->fold
             ? s->fold->view(&s->variant->choice.form, &s->view, k, view, err)
             : HSR_OK;
}

static enum hsr_status draw_and_add(struct sorting *s, long k,
                                    struct hsr_error *err) {
  struct render *r = s->render;
  enum hsr_status status = choose_picture(s, k, err);
  if (!status)
    status = draw_picture(r, err);
  double begin = hsr_seconds_now();
  if (!status)
    status = composite_add(&s->composite[k], &r->world, s->part.first,
                           hsr_answer_ids_of(&r->answer), err);
  r->compose += hsr_seconds_now() - begin;
  return status;
}

/* Adds the part to the sums. */
static enum hsr_status draw_and_sum(struct sorting *s, struct hsr_error *err) {
  struct render *r = s->render;
  double begin = hsr_seconds_now();
  enum hsr_status status =
      crew_render(r->crew, &r->setup, &s->view, &s->sums, &r->tally, err);
  r->draw += hsr_seconds_now() - begin;
  return status;
}

/* The part's world and its own pictures. */
static enum hsr_status draw_open_part(struct sorting *s,
                                      struct hsr_error *err) {
  struct render *r = s->render;
  double begin = hsr_seconds_now();
  enum hsr_status status =
      hsr_setup_world(&r->world, s->algorithm, &s->choice, r->scene, err);
  r->build += hsr_seconds_now() - begin;
  if (!status)
    status =
        hsr_setup_init(&r->setup, s->algorithm, &s->choice, &r->world, err);
  for (long k = 0; k < s->n && !status; k++)
    status = draw_and_add(s, k, err);
  if (!status && s->summing)
    status = draw_and_sum(s, err);
  return status;
}

static enum hsr_status begin_sums(struct sorting *s, struct hsr_error *err) {
  if (s->sums.body)
    return HSR_OK;
  enum hsr_status status =
      hsr_answer_make(&s->sums, &s->variant->choice.form, &s->view, false, err);
  return status ? status : s->summing->begin(&s->sums, err);
}

/* With the first part it is known what there is to draw. */
static enum hsr_status begin_pictures(struct sorting *s,
                                      struct hsr_error *err) {
  struct render *r = s->render;
  const struct render_options *o = r->options;
  enum hsr_status status =
      choose_view(&o->view, r->scene, (int)o->supersamples, &s->view, err);
  if (!status && s->summing)
    status = begin_sums(s, err);
  for (long k = 0; k < s->n && !status; k++) {
    status = choose_picture(s, k, err);
    if (!status && !s->composite[k].ids)
      status = composite_init(&s->composite[k], &r->view, err);
  }
  return status;
}

static enum hsr_status draw_part(struct sorting *s, uint32_t number,
                                 struct hsr_error *err) {
  struct render *r = s->render;
  struct render_options const *o = r->options;
  struct hsr_import import = o->scene.import;
  double begin = hsr_seconds_now();
  s->part.number = number;
  enum hsr_status status =
      hsr_scene_open_part(o->scene.name, &import, &s->part, &r->scene, err);
  r->import += hsr_seconds_now() - begin;
  if (!status)
    status = begin_pictures(s, err);
  if (!status && s->part.n_faces)
    status = draw_open_part(s, err);
  if (!status)
    render_forget_scene(r);
  r->n_drawn++;
  return status;
}

/* A rank draws the part of its own number, and then whichever is left. */
static enum hsr_status draw_parts(struct sorting *s, struct hsr_error *err) {
  long ranks = ranks_count(), all = s->part.of;
  enum hsr_status status = HSR_OK;
  struct queue queue;
  queue_open(&queue, all - ranks, true);
  for (long k = ranks_own(); k >= 0 && k < all && !status;) {
    progress_tell(&s->progress, (size_t)k, (size_t)all, "parts",
                  s->render->options->scene.name);
    status = draw_part(s, (uint32_t)k, err);
    k = queue_take(&queue);
    k += k < 0 ? 0 : ranks;
  }
  return status;
}

/* In rank 0: the faces that are seen in a picture become the scene. Its ids
 * become their numbers in *to. */
static enum hsr_status lay_out_seen(struct sorting *s,
                                    const struct composite *composite,
                                    struct hsr_answer *to,
                                    struct hsr_error *err) {
  struct render *r = s->render;
  hsr_world_free(&r->world);
  hsr_scene_delete(r->scene);
  r->scene = NULL;
  return composite_lay_out(composite, r->options->scene.name, &r->scene,
                           &r->world, hsr_answer_ids_of(to), err);
}

/* Colours by the seen faces, and then the scene's ids. */
static enum hsr_status shade_ids(struct sorting *s, struct hsr_error *err) {
  struct render *r = s->render;
  size_t n = (size_t)r->view.m * (size_t)r->view.n;
  enum hsr_status status = lay_out_seen(s, s->composite, &r->answer, err);
  if (!status)
    status = shade_picture(r, err);
  if (status)
    return status;
  uint32_t *ids = hsr_answer_ids_of(&r->answer);
  for (size_t k = 0; k < n; k++)
    ids[k] = s->composite->ids[k];
  if (r->shaded.rgb && r->options->shading == HSR_SHADE_IDS)
    hsr_picture_shade(&r->world, &r->view, ids, HSR_SHADE_IDS, r->shaded.rgb);
  return HSR_OK;
}

static enum hsr_status fold(struct sorting *s, struct hsr_error *err) {
  struct render *r = s->render;
  enum hsr_status status = HSR_OK;
  for (long k = 0; k < s->n && !status; k++) {
    status = lay_out_seen(s, &s->composite[k], r->answer.picture, err);
    if (!status)
      s->fold->add(&r->answer, &r->world, &r->view, k);
  }
  return status ? status : shade_picture(r, err);
}

static enum hsr_status shade_and_write(struct sorting *s,
                                       struct hsr_error *err) {
  struct render *r = s->render;
  r->view = s->view;
  enum hsr_status status = hsr_answer_make(&r->answer, &s->variant->choice.form,
                                           &r->view, s->fold != NULL, err);
  if (!status)
    status = s->fold ? fold(s, err) : shade_ids(s, err);
  r->setup.algorithm = s->algorithm;
  return status ? status : write_picture(r, err);
}

/* What was summed becomes the picture of rank 0. */
static enum hsr_status finish_sums(struct sorting *s, struct hsr_error *err) {
  struct render *r = s->render;
  expose_sums(s->render, &s->sums);
  s->summing->finish(&s->sums);
  r->view = s->view;
  r->answer = s->sums;
  s->sums = (struct hsr_answer){.body = NULL};
  r->setup.algorithm = s->algorithm;
  r->scene = hsr_scene_new(r->options->scene.name);
  enum hsr_status status = r->scene ? shade_picture(r, err) : HSR_E_NOMEM;
  if (!r->scene)
    hsr_fail_nomem(err);
  return status ? status : write_picture(r, err);
}

static enum hsr_status gather_sums(struct sorting *s, struct hsr_error *err) {
  struct render *r = s->render;
  struct sums_sent sent;
  uint64_t *sums;
  size_t n = s->summing->sums(&s->sums, &sums);
  double begin = hsr_seconds_now();
  enum hsr_status status = sums_gather(sums, n, &sent, err);
  r->compose += hsr_seconds_now() - begin;
  r->sent_bytes += sent.bytes;
  r->sent_messages += sent.messages;
  r->n_faces = s->part.all;
  return status || ranks_own() ? status : finish_sums(s, err);
}

static enum hsr_status gather(struct sorting *s, struct hsr_error *err) {
  struct render *r = s->render;
  enum hsr_status status = HSR_OK;
  for (long k = 0; k < s->n && !status; k++) {
    struct composite *composite = &s->composite[k];
    double begin = hsr_seconds_now();
    status = composite_gather(composite, err);
    r->compose += hsr_seconds_now() - begin;
    r->sent_bytes += composite->bytes;
    r->sent_messages += composite->messages;
    r->compared += composite->compared;
  }
  r->n_faces = s->part.all;
  return status || ranks_own() ? status : shade_and_write(s, err);
}

enum hsr_status make_sort_last(struct render *r, const struct hsr_algorithm *a,
                               const struct hsr_variant *variant,
                               struct hsr_error *err) {
  long parts = r->options->parts ? r->options->parts : ranks_count();
  struct sorting s = {.render = r,
                      .algorithm = a,
                      .variant = variant,
                      .choice = variant->choice,
                      .fold = variant->choice.form.type->fold,
                      .part.of = (uint32_t)parts,
                      .progress = progress_begin(stderr)};
  r->kind = variant->choice.form.type;
  r->view_number = r->options->view.view;
  s.summing = r->kind->summing;
  s.part.keeps_grid = s.summing;
  if (!s.summing)
    s.choice.form = hsr_form_standard(HSR_IDS);
  s.n = s.fold ? s.fold->n(&variant->choice.form) : !s.summing;
  s.composite = calloc((size_t)s.n + 1, sizeof *s.composite);
  enum hsr_status status = s.composite ? HSR_OK : hsr_fail_nomem(err);
  if (!status && parts < ranks_count())
    status = hsr_fail(err, HSR_E_USAGE,
                      "--sort-last=%ld: for %d ranks there must be as many "
                      "parts at least",
                      parts, ranks_count());
  if (!status)
    status = draw_parts(&s, err);
  progress_end(&s.progress);
  if (!status)
    status = s.summing ? gather_sums(&s, err) : gather(&s, err);
  for (long k = 0; s.composite && k < s.n; k++)
    composite_free(&s.composite[k]);
  free(s.composite);
  if (s.sums.body)
    hsr_answer_free(&s.sums);
  return status;
}
