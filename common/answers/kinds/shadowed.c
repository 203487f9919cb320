/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The visible face of every sample, and whether light reaches it:
 * docs/shadow-picture.md. Two answers are equal if both agree in every sample.
 */
#include "common/answers/kinds/shadowed.h"
#include "common/answers/coded.h"
#include "common/files/image.h"
#include "common/files/suffix.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct hsr_word casts[] = {
    {"cast", "a sample is lit unless its face is turned away or another blocks",
     0},
    {NULL}};

static const struct hsr_option options[] = {
    {"shadows", "the picture of what light reaches", casts, 0, 0, 0}, {NULL}};

static size_t count_samples(const struct hsr_answer *answer) {
  return (size_t)answer->m * (size_t)answer->n;
}

struct hsr_shadowed *hsr_answer_shadowed_of(const struct hsr_answer *answer) {
  return answer->form.type == &hsr_answer_shadowed ? answer->body : NULL;
}

bool *hsr_answer_lit_of(const struct hsr_answer *answer) {
  struct hsr_shadowed *body = hsr_answer_shadowed_of(answer);
  return body ? body->lit : NULL;
}

static void free_body(struct hsr_answer *answer) {
  struct hsr_shadowed *body = answer->body;
  free(body->ids);
  free(body->lit);
  free(body);
}

static enum hsr_status make(struct hsr_answer *answer, struct hsr_error *err) {
  size_t n = count_samples(answer);
  struct hsr_shadowed *body = calloc(1, sizeof *body);
  answer->body = body;
  if (!body)
    return hsr_fail_nomem(err);
  body->ids = malloc(n * sizeof *body->ids);
  body->lit = calloc(n, sizeof *body->lit);
  if (!body->ids || !body->lit)
    return hsr_fail_nomem(err);
  answer->ids = body->ids;
  for (size_t k = 0; k < n; k++)
    body->ids[k] = HSR_BACKGROUND;
  return HSR_OK;
}

static void unset(struct hsr_answer *answer) {
  struct hsr_shadowed *body = answer->body;
  for (size_t k = 0; k < count_samples(answer); k++)
    body->ids[k] = HSR_NOT_WRITTEN;
}

static int arrays(const struct hsr_answer *answer,
                  struct hsr_array array[HSR_MOST_ARRAYS]) {
  struct hsr_shadowed *body = answer->body;
  array[0] = (struct hsr_array){body->ids, sizeof *body->ids};
  array[1] = (struct hsr_array){body->lit, sizeof *body->lit};
  return 2;
}

/* --- Comparing ------------------------------------------------------------ */

static bool differ(const struct hsr_shadowed *a, const struct hsr_shadowed *b,
                   size_t k) {
  return a->ids[k] != b->ids[k] || a->lit[k] != b->lit[k];
}

/* "face 5, lit". Returns `text`. */
static const char *say(const struct hsr_shadowed *body, size_t k,
                       char text[40]) {
  if (body->ids[k] == HSR_BACKGROUND)
    return body->lit[k] ? "background, lit" : "background";
  if (body->ids[k] == HSR_NOT_WRITTEN)
    return "nothing written";
  snprintf(text, 40, "face %u, %s", body->ids[k],
           body->lit[k] ? "lit" : "not lit");
  return text;
}

static void compare(const struct hsr_comparison *c,
                    struct hsr_difference *difference) {
  const struct hsr_shadowed *got = c->got->body, *wanted = c->wanted->body;
  char one[40], other[40];
  difference->compared = c->n;
  for (size_t k = 0; k < c->n; k++) {
    size_t s = c->place ? c->place[k] : k, m = (size_t)c->got->m;
    if (differ(got, wanted, s) && !difference->differing++)
      snprintf(difference->first, sizeof difference->first,
               "(%zu, %zu): %s; right is %s", s % m, s / m, say(got, s, one),
               say(wanted, s, other));
  }
}

/* --- Showing -------------------------------------------------------------- */

/* How brightly the visible point of a lit sample at depth t is lit. */
static float light_on(const struct hsr_showing *showing, uint32_t id, double sx,
                      double sy, double t) {
  const struct hsr_view *view = showing->view;
  double normal[3], anchor[3], dot = 0, n2 = 0, l2 = 0;
  hsr_place_plane(showing->world, hsr_place_of(showing->world, id), normal,
                  anchor);
  for (int k = 0; k < 3; k++) {
    double ray = view->ray[0][k] + sx * view->ray[1][k] + sy * view->ray[2][k];
    double p = view->E[k] + (view->parallel ? ray + t * view->F[k] : t * ray);
    double l = view->light[k] - (view->light[3] > 0 ? p : 0);
    dot += normal[k] * l;
    n2 += normal[k] * normal[k];
    l2 += l * l;
  }
  return (float)(0.25 + 0.75 * fmin(1, fabs(dot) / sqrt(n2 * l2)));
}

/* Makes flat colours those of faces in light and shadow. */
static void darken(const struct hsr_shadowed *body,
                   const struct hsr_showing *showing, const float *depth,
                   float *rgb) {
  const struct hsr_view *view = showing->view;
  for (int j = 0; j < view->n; j++)
    for (int i = 0; i < view->m; i++) {
      size_t k = (size_t)j * (size_t)view->m + (size_t)i;
      if (body->ids[k] == HSR_BACKGROUND)
        continue;
      float light = 0.25f;
      if (body->lit[k])
        light = light_on(showing, body->ids[k], hsr_sample_x(view, i),
                         hsr_sample_y(view, j), (double)depth[k]);
      for (size_t c = 0; c < 3; c++)
        rgb[3 * k + c] *= light;
    }
}

static enum hsr_status shade(const struct hsr_answer *answer,
                             const struct hsr_showing *showing,
                             struct hsr_shaded *shaded, struct hsr_error *err) {
  const struct hsr_shadowed *body = answer->body;
  size_t n = count_samples(answer);
  shaded->depth = malloc(n * sizeof *shaded->depth);
  shaded->rgb = malloc(3 * n * sizeof *shaded->rgb);
  if (!shaded->depth || !shaded->rgb)
    return hsr_fail_nomem(err);
  enum hsr_status status =
      hsr_picture_finish(showing->world, showing->view, body->ids,
                         HSR_SHADE_FLAT, shaded->depth, shaded->rgb, err);
  if (!status)
    darken(body, showing, shaded->depth, shaded->rgb);
  return status;
}

/* The wanted picture, dimmed, with the samples that differ in orange. */
static enum hsr_status show_difference(const struct hsr_comparison *c,
                                       const struct hsr_showing *showing,
                                       float *rgb, struct hsr_error *err) {
  static const float mark[3] = {1.0f, .35f, 0.0f};
  struct hsr_shaded shaded = {.rgb = NULL};
  enum hsr_status status = shade(c->wanted, showing, &shaded, err);
  for (size_t k = 0; !status && k < count_samples(c->got); k++)
    for (size_t i = 0; i < 3; i++)
      rgb[3 * k + i] = differ(c->got->body, c->wanted->body, k)
                           ? mark[i]
                           : 0.25f * shaded.rgb[3 * k + i];
  hsr_shaded_free(&shaded);
  return status;
}

static enum hsr_status write(const struct hsr_answer *answer,
                             const struct hsr_showing *showing,
                             struct hsr_shaded *shaded, const char *path,
                             struct hsr_error *err) {
  const struct hsr_shadowed *body = answer->body;
  struct hsr_picture picture = {.m = answer->m,
                                .n = answer->n,
                                .ids = body->ids,
                                .depth = showing->depth ? shaded->depth : NULL,
                                .rgb = shaded->rgb};
  return hsr_image_write(path, &picture, showing->text, err);
}

static bool fits(const char *path) {
  return hsr_is_colour_file(path);
}

static void print(const struct hsr_answer *answer,
                  const struct hsr_showing *showing, FILE *out) {
  const struct hsr_shadowed *body = answer->body;
  size_t n = count_samples(answer), covered = 0, lit = 0;
  (void)showing;
  for (size_t k = 0; k < n; k++) {
    covered += body->ids[k] != HSR_BACKGROUND;
    lit += body->lit[k];
  }
  fprintf(out, "%.1f %% covered, %.1f %% lit\n",
          100.0 * (double)covered / (double)n, 100.0 * (double)lit / (double)n);
}

/* --- Tracing -------------------------------------------------------------- */

/* The face of an accepted event is seen all over its window. It is not lit
 * there, unless the event has a part, a bool. */
static enum hsr_status paint(struct hsr_answer *answer,
                             const struct hsr_event *event) {
  struct hsr_shadowed *body = answer->body;
  const struct hsr_window *w = &event->window;
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++) {
      size_t k = (size_t)j * (size_t)answer->m + (size_t)i;
      body->ids[k] = event->a.id[0];
      body->lit[k] = event->part && *(const bool *)event->part;
    }
  return HSR_OK;
}

/* A face that is not lit is half as bright. */
static void sketch(const struct hsr_answer *painted,
                   const struct hsr_event *event, enum hsr_step_kind step,
                   const struct hsr_view *view, uint32_t face,
                   const struct hsr_slide *slide) {
  bool as_it_is = event->a.id[0] == HSR_BACKGROUND ||
                  (event->part && *(const bool *)event->part);
  (void)painted, (void)view;
  if (step == HSR_ACCEPT)
    slide->fill(slide->on, &event->window,
                as_it_is ? face : face >> 1 & 0x7f7f7f);
}

static json_t *part_json(const void *part, const struct hsr_view *view) {
  (void)view;
  return json_boolean(*(const bool *)part);
}

/* Runs of one id and one lit bit, row after row: {"ids": [id, length, ...],
 * "lit": [0 or 1, length, ...]}. */
static json_t *shadowed_json(const struct hsr_answer *answer,
                             const struct hsr_view *view) {
  const struct hsr_shadowed *body = answer->body;
  size_t n = count_samples(answer);
  uint32_t *bits = malloc(n * sizeof *bits);
  (void)view;
  for (size_t k = 0; bits && k < n; k++)
    bits[k] = body->lit[k];
  json_t *json = bits ? json_pack("{so* so*}", "ids",
                                  hsr_runs_json(body->ids, n, HSR_BACKGROUND),
                                  "lit", hsr_runs_json(bits, n, HSR_BACKGROUND))
                      : NULL;
  free(bits);
  return json;
}

const struct hsr_answer_type hsr_answer_shadowed = {
    .name = "shadowed",
    .meaning = "the visible face of every sample, and whether light reaches it",
    .draws = "shadows",
    .places = "samples",
    .grains = "samples",
    .takes = 1 << HSR_LIGHTING,
    .options = options,
    .by_windows = true,
    .by_places = true,
    .make = make,
    .unset = unset,
    .free = free_body,
    .arrays = arrays,
    .compare = compare,
    .show_difference = show_difference,
    .shade = shade,
    .fits = fits,
    .write = write,
    .print = print,
    .paint = paint,
    .sketch = sketch,
    .json = shadowed_json,
    .part_json = part_json};
