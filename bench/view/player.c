/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/modules/variant.h"
#include "bench/run/crew.h"
#include "bench/view/view.h"

#include "common/base/clock.h"
#include "common/files/srgb.h"
#include "common/paper/plot.h"

#include <stdlib.h>
#include <string.h>

/* More faces are laid out only where they are visible. */
enum { MOST_COLOURED = 1000000 };

/* The scene laid out; NULL if it is not. */
static const struct hsr_world *laid_out(const struct player *p) {
  const struct hsr_world *own = &p->render.world;
  return !hsr_is_roster(own)        ? own
         : p->laid_out.roster.scene ? &p->laid_out
                                    : NULL;
}

void player_close(struct player *player) {
  render_close(&player->render);
  hsr_world_free(&player->laid_out);
  free(player->stamp);
  free(player->face_rgb);
  *player = (struct player){.is_ready = false};
}

static enum hsr_status check(const struct player *p, struct hsr_error *err) {
  const struct hsr_variant *variant = &p->variant;
  const struct hsr_answer_type *kind = variant->choice.form.type;
  if (!kind->shade && !kind->lines)
    return hsr_fail(err, HSR_E_USAGE, "%s draws %s, which are no picture",
                    variant->name, kind->draws);
  if (p->sort == PLAYER_WORKS &&
      (!kind->by_places ||
       hsr_choice_folds(variant->listed->plain, &variant->choice)))
    return hsr_fail(err, HSR_E_USAGE, "%s has no work picture", variant->name);
  return HSR_OK;
}

static enum hsr_status make_ready(struct player *p, struct hsr_scene *scene,
                                  struct hsr_error *err) {
  const struct hsr_algorithm *a = p->sort == PLAYER_PLAIN
                                      ? p->variant.listed->plain
                                      : p->variant.listed->counting;
  struct render *r = &p->render;
  *r = (struct render){.options = &p->options,
                       .scene = scene,
                       .kind = p->variant.choice.form.type,
                       .crew = crew_new(p->options.threads)};
  double begin = hsr_seconds_now();
  enum hsr_status status =
      r->crew ? hsr_setup_world(&r->world, a, &p->variant.choice, scene, err)
              : hsr_fail_nomem(err);
  r->build = hsr_seconds_now() - begin;
  if (!status)
    status = hsr_setup_init(&r->setup, a, &p->variant.choice, &r->world, err);
  if (!status && hsr_is_roster(&r->world) && !scene->grid &&
      r->world.n_faces <= MOST_COLOURED)
    status = hsr_world_open(&p->laid_out, scene, MOST_COLOURED, err);
  if (status)
    return status;
  p->stamp = calloc((size_t)r->world.n_faces + 1, sizeof *p->stamp);
  p->face_rgb = malloc(3 * ((size_t)r->world.n_faces + 1));
  return p->stamp && p->face_rgb ? HSR_OK : hsr_fail_nomem(err);
}

enum hsr_status player_open(struct player *p, const char *name,
                            enum player_sort sort, const struct viewer *v,
                            struct hsr_error *err) {
  player_close(p);
  p->options =
      (struct render_options){.style = v->style,
                              .threads = v->threads,
                              .supersamples = 1,
                              .n_outputs = 1,
                              .work = sort == PLAYER_WORKS ? "" : NULL};
  p->sort = sort;
  enum hsr_status status = hsr_variant_parse(name, &p->variant, err);
  if (!status)
    status = check(p, err);
  if (!status)
    status = make_ready(p, v->scene, err);
  if (status)
    player_close(p);
  p->is_ready = !status;
  return status;
}

const uint32_t *player_ids(const struct player *player) {
  return player->is_ready && player->render.answer.body
             ? hsr_answer_ids_of(&player->render.answer)
             : NULL;
}

/* --- Colours -------------------------------------------------------------- */

/* As in a file of 8 bits a channel (common/files/image_oiio.cc). */
static unsigned char byte_of(float linear) {
  float encoded = hsr_srgb_encode(linear) * 255 + 0.5f;
  return (unsigned char)(encoded < 0 ? 0 : encoded > 255 ? 255 : encoded);
}

static void bytes_of(const float rgb[3], unsigned char bytes[3]) {
  for (int k = 0; k < 3; k++)
    bytes[k] = byte_of(rgb[k]);
}

void player_colour(const struct hsr_world *world, const struct hsr_view *view,
                   uint32_t id, unsigned char rgb[3]) {
  float linear[3];
  hsr_picture_colour(world, view, id, HSR_SHADE_LAMBERT, linear);
  bytes_of(linear, rgb);
}

/* The colour of a face in this picture. It is made once. */
static const unsigned char *colour_of(struct player *p,
                                      const struct hsr_world *world,
                                      const struct hsr_view *view,
                                      uint32_t id) {
  unsigned char *rgb = p->face_rgb + 3 * (size_t)id;
  if (p->stamp[id] != p->n_pictures) {
    player_colour(world, view, id, rgb);
    p->stamp[id] = p->n_pictures;
  }
  return rgb;
}

/* Neighbours often show one face, which is looked up once. */
static void shade_ids(struct player *p, const struct hsr_view *view,
                      unsigned char *rgb) {
  const struct hsr_world *world = laid_out(p);
  const uint32_t *ids = player_ids(p);
  const size_t n = (size_t)view->m * (size_t)view->n;
  unsigned char background[3];
  player_colour(world, view, HSR_BACKGROUND, background);
  const unsigned char *from = background;
  for (size_t k = 0; k < n; k++, rgb += 3) {
    if (!k || ids[k] != ids[k - 1])
      from = ids[k] == HSR_BACKGROUND ? background
                                      : colour_of(p, world, view, ids[k]);
    memcpy(rgb, from, 3);
  }
}

/* Neighbours often have one colour, which is encoded once. */
static void encode(const float *linear, size_t n, unsigned char *rgb) {
  for (size_t k = 0; k < n; k++)
    if (k && !memcmp(linear + 3 * k, linear + 3 * (k - 1), 3 * sizeof *linear))
      memcpy(rgb + 3 * k, rgb + 3 * (k - 1), 3);
    else
      bytes_of(linear + 3 * k, rgb + 3 * k);
}

/* A line drawing on paper, which is as grey as is said: 0 is black, 1 white. */
static enum hsr_status shade_lines(struct player *p,
                                   const struct hsr_view *view, float paper,
                                   unsigned char *rgb, struct hsr_error *err) {
  const size_t n = (size_t)view->m * (size_t)view->n;
  float *linear = malloc(3 * n * sizeof *linear);
  const struct hsr_plot_subject subject = {
      .drawing = hsr_answer_lines(&p->render.answer),
      .world = &p->render.world,
      .view = view};
  const struct hsr_plot_look look = {.style = &p->options.style};
  struct hsr_plot plot = {.n_layers = 0};
  enum hsr_status status = linear ? HSR_OK : hsr_fail_nomem(err);
  if (!status)
    status = hsr_plot_init(&plot, &subject, &look, err);
  plot.has_paper = true;
  for (int k = 0; k < 3; k++)
    plot.paper[k] = paper;
  if (!status)
    status = hsr_plot_raster(&plot, linear, err);
  if (!status)
    encode(linear, n, rgb);
  hsr_plot_free(&plot);
  free(linear);
  return status;
}

static enum hsr_status shade(struct player *p, const struct hsr_view *view,
                             unsigned char *rgb, struct hsr_error *err) {
  struct render *r = &p->render;
  const size_t n = (size_t)view->m * (size_t)view->n;
  if (r->kind->lines)
    return shade_lines(p, view, 1, rgb, err);
  if (player_ids(p) && laid_out(p)) {
    shade_ids(p, view, rgb);
    return HSR_OK;
  }
  enum hsr_status status = shade_picture(r, err);
  if (!status)
    encode(r->shaded.rgb, n, rgb);
  return status;
}

/* What an algorithm keeps from frame to frame is of pictures of one size. */
static enum hsr_status change_size(struct player *p, struct hsr_error *err) {
  struct render *r = &p->render;
  render_forget(r);
  if (!p->n_pictures || !(r->setup.flags & HSR_FRAME_STATE))
    return HSR_OK;
  const struct hsr_algorithm *a = r->setup.algorithm;
  hsr_setup_free(&r->setup);
  return hsr_setup_init(&r->setup, a, &p->variant.choice, &r->world, err);
}

enum hsr_status player_draw(struct player *p, const struct hsr_view *view,
                            unsigned char *rgb, struct hsr_error *err) {
  struct render *r = &p->render;
  if (r->view.m != view->m || r->view.n != view->n) {
    enum hsr_status status = change_size(p, err);
    if (status)
      return status;
  }
  r->view = *view;
  r->tally = (struct hsr_tally){.out_of_memory = false};
  p->n_pictures++;
  double begin = hsr_seconds_now();
  enum hsr_status status = draw_picture(r, err);
  double end = hsr_seconds_now();
  p->draw_ms = 1e3 * (end - begin);
  if (!status)
    status = shade(p, view, rgb, err);
  p->shade_ms = 1e3 * (hsr_seconds_now() - end);
  return status;
}

/* On black paper is what the pens add, and on white paper is also what they
 * leave of the paper. */
enum hsr_status player_draw_over(struct player *p, const struct hsr_view *view,
                                 unsigned char *rgb, struct hsr_error *err) {
  const size_t n = 3 * (size_t)view->m * (size_t)view->n;
  unsigned char *white = malloc(n), *black = malloc(n);
  enum hsr_status status = white && black ? HSR_OK : hsr_fail_nomem(err);
  if (!status)
    status = player_draw(p, view, white, err);
  if (!status)
    status = shade_lines(p, view, 0, black, err);
  for (size_t k = 0; k < n && !status; k++)
    rgb[k] = (unsigned char)(black[k] + rgb[k] * (white[k] - black[k]) / 255);
  free(white);
  free(black);
  return status;
}
