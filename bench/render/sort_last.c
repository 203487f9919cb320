/* SPDX-License-Identifier: GPL-3.0-or-later */
/* hsr render --sort-last: a scene larger than memory, part by part. Each rank
 * opens and draws one part after the other, and keeps only what is seen; at last
 * the ranks put their pictures together (bench/run/composite.h). */
#include "bench/render/render.h"
#include "bench/run/composite.h"
#include "bench/run/ranks.h"
#include "bench/terminal/terminal.h"

/* What the parts are drawn with. */
struct sorting {
  struct render *render;
  const struct hsr_algorithm *algorithm;
  const struct hsr_variant *variant;
  struct hsr_part part;
  struct composite composite;
  struct progress progress;
};

/* The part's world and its own picture. */
static enum hsr_status draw_open_part(struct sorting *s,
                                      struct hsr_error *err) {
  struct render *r = s->render;
  double begin = seconds_now();
  enum hsr_status status =
      hsr_setup_world(&r->world, s->algorithm, r->scene, err);
  r->build += seconds_now() - begin;
  if (!status)
    status = hsr_setup_init(&r->setup, s->algorithm, &s->variant->choice,
                            &r->world, err);
  if (!status)
    status = draw_picture(r, err);
  begin = seconds_now();
  if (!status)
    status = composite_add(&s->composite, &r->world, s->part.first,
                           hsr_answer_ids_of(&r->answer), err);
  r->compose += seconds_now() - begin;
  return status;
}

static enum hsr_status draw_part(struct sorting *s, uint32_t number,
                                 struct hsr_error *err) {
  struct render *r = s->render;
  struct render_options const *o = r->options;
  struct hsr_import import = o->scene.import;
  double begin = seconds_now();
  s->part.number = number;
  enum hsr_status status =
      hsr_scene_open_part(o->scene.name, &import, &s->part, &r->scene, err);
  r->import += seconds_now() - begin;
  if (!status)
    status =
        choose_view(&o->view, r->scene, (int)o->supersamples, &r->view, err);
  if (!status && !s->composite.ids)
    status = composite_init(&s->composite, &r->view, err);
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

/* In rank 0: the faces that are seen become the scene, and the answer has their
 * numbers; *ids becomes the picture in the scene's own. */
static enum hsr_status lay_out_seen(struct sorting *s, struct hsr_error *err) {
  struct render *r = s->render;
  size_t n = (size_t)r->view.m * (size_t)r->view.n;
  enum hsr_status status = loose_faces_lay_out(
      &s->composite.faces, r->options->scene.name, &r->scene, &r->world, err);
  if (!status)
    status = hsr_answer_make(&r->answer, &s->variant->choice.form, &r->view,
                             false, err);
  for (size_t k = 0; k < n && !status; k++) {
    uint32_t id = s->composite.ids[k];
    hsr_answer_ids_of(&r->answer)[k] =
        id == HSR_BACKGROUND ? id : loose_faces_find(&s->composite.faces, id);
  }
  return status;
}

/* Colours by the seen faces, and then the scene's ids. */
static enum hsr_status shade_and_write(struct sorting *s,
                                       struct hsr_error *err) {
  struct render *r = s->render;
  size_t n = (size_t)r->view.m * (size_t)r->view.n;
  enum hsr_status status = lay_out_seen(s, err);
  if (!status)
    status = shade_picture(r, err);
  if (status)
    return status;
  uint32_t *ids = hsr_answer_ids_of(&r->answer);
  for (size_t k = 0; k < n; k++)
    ids[k] = s->composite.ids[k];
  if (r->shaded.rgb && r->options->shading == HSR_SHADE_IDS)
    hsr_picture_shade(&r->world, &r->view, ids, HSR_SHADE_IDS, r->shaded.rgb);
  r->setup.algorithm = s->algorithm;
  return write_picture(r, err);
}

static enum hsr_status gather(struct sorting *s, struct hsr_error *err) {
  struct render *r = s->render;
  double begin = seconds_now();
  enum hsr_status status = composite_gather(&s->composite, err);
  r->compose += seconds_now() - begin;
  r->n_faces = s->part.all;
  r->sent_bytes = s->composite.bytes;
  r->sent_messages = s->composite.messages;
  r->compared = s->composite.compared;
  return status || ranks_own() ? status : shade_and_write(s, err);
}

enum hsr_status make_sort_last(struct render *r, const struct hsr_algorithm *a,
                               const struct hsr_variant *variant,
                               struct hsr_error *err) {
  long parts = r->options->parts ? r->options->parts : ranks_count();
  struct sorting s = {.render = r,
                      .algorithm = a,
                      .variant = variant,
                      .part.of = (uint32_t)parts,
                      .progress = progress_begin(stderr)};
  r->kind = variant->choice.form.type;
  r->view_number = r->options->view.view;
  enum hsr_status status = HSR_OK;
  if (parts < ranks_count())
    status = hsr_fail(err, HSR_E_USAGE,
                      "--sort-last=%ld: for %d ranks there must be as many "
                      "parts at least",
                      parts, ranks_count());
  if (!status)
    status = draw_parts(&s, err);
  progress_end(&s.progress);
  if (!status)
    status = gather(&s, err);
  composite_free(&s.composite);
  return status;
}
