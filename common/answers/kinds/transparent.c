/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The faces over each sample, folded: docs/transparent-picture.md. Two answers
 * are equal if all channels of all samples are. */
#include "common/answers/filter.h"
#include "common/answers/kinds/transparent.h"
#include "common/answers/coded.h"
#include "common/files/image.h"
#include "common/files/srgb.h"
#include "common/files/suffix.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CHANNELS = 3 };

/* The options of a form. */
enum { MIX };

static const struct hsr_word mixes[] = {
    [HSR_MIX_LINEAR] = {"linear",
                        "transparent faces are combined with what they cover",
                        0},
    [HSR_MIX_NEWELL] = {"newell", "where they are brighter, they replace it",
                        0},
    {NULL}};

static const struct hsr_option options[] = {
    [MIX] = {"mix", "the picture of transparent faces", mixes, 0,
             HSR_MIX_NEWELL, HSR_MIX_LINEAR},
    {NULL}};

enum hsr_mix hsr_form_mix(const struct hsr_form *form) {
  return (enum hsr_mix)form->values.option[MIX];
}

struct hsr_tint hsr_tint_of(const struct hsr_world *world,
                            const struct hsr_view *view, uint32_t id) {
  struct hsr_tint tint = {.opacity = HSR_OPAQUE};
  hsr_filter_colour(world, view, id, tint.rgb);
  if (id != HSR_BACKGROUND) {
    struct hsr_place at = hsr_place_of(world, id);
    double opacity = (double)hsr_face_opacity(at.object, at.face);
    tint.opacity = (uint16_t)floor(HSR_OPAQUE * opacity + 0.5);
  }
  return tint;
}

static size_t count(const struct hsr_answer *answer) {
  return CHANNELS * (size_t)answer->m * (size_t)answer->n;
}

uint16_t *hsr_answer_colours_of(const struct hsr_answer *answer) {
  return answer->form.type == &hsr_answer_transparent ? answer->body : NULL;
}

/* To colours which no picture has at many samples. */
static void unset(struct hsr_answer *answer) {
  uint16_t *rgb = answer->body;
  for (size_t k = 0; k < count(answer); k++)
    rgb[k] = (uint16_t)(40503 * k + 1);
}

/* The background everywhere. */
static enum hsr_status make(struct hsr_answer *answer, struct hsr_error *err) {
  uint16_t *rgb = malloc(count(answer) * sizeof *rgb);
  uint16_t background[CHANNELS];
  hsr_filter_colour(NULL, NULL, HSR_BACKGROUND, background);
  for (size_t k = 0; rgb && k < count(answer); k += CHANNELS)
    memcpy(rgb + k, background, sizeof background);
  answer->body = rgb;
  return rgb ? HSR_OK : hsr_fail_nomem(err);
}

static void free_body(struct hsr_answer *answer) {
  free(answer->body);
}

static int arrays(const struct hsr_answer *answer,
                  struct hsr_array array[HSR_MOST_ARRAYS]) {
  array[0] = (struct hsr_array){answer->body, CHANNELS * sizeof(uint16_t)};
  return 1;
}

/* --- Comparing ------------------------------------------------------------ */

static void compare(const struct hsr_comparison *c,
                    struct hsr_difference *difference) {
  const uint16_t *got = c->got->body, *wanted = c->wanted->body;
  difference->compared = c->n;
  for (size_t k = 0; k < c->n; k++) {
    size_t s = c->place ? c->place[k] : k, m = (size_t)c->got->m;
    const uint16_t *g = got + CHANNELS * s, *w = wanted + CHANNELS * s;
    if (memcmp(g, w, CHANNELS * sizeof *g) && !difference->differing++)
      snprintf(difference->first, sizeof difference->first,
               "(%zu, %zu): colour %u %u %u, not %u %u %u", s % m, s / m, g[0],
               g[1], g[2], w[0], w[1], w[2]);
  }
}

/* The wanted picture, dimmed, with the samples that differ in orange. */
static enum hsr_status show_difference(const struct hsr_comparison *c,
                                       const struct hsr_showing *showing,
                                       float *rgb, struct hsr_error *err) {
  static const float mark[CHANNELS] = {1.0f, .35f, 0.0f};
  const uint16_t *got = c->got->body, *wanted = c->wanted->body;
  (void)showing, (void)err;
  for (size_t k = 0; k < count(c->got); k += CHANNELS)
    for (size_t i = 0; i < CHANNELS; i++)
      rgb[k + i] = memcmp(got + k, wanted + k, CHANNELS * sizeof *got)
                       ? mark[i]
                       : 0.25f * (float)wanted[k + i] / 65535;
  return HSR_OK;
}

/* --- Showing -------------------------------------------------------------- */

static enum hsr_status shade(const struct hsr_answer *answer,
                             const struct hsr_showing *showing,
                             struct hsr_shaded *shaded, struct hsr_error *err) {
  const uint16_t *rgb = answer->body;
  (void)showing;
  shaded->rgb = malloc(count(answer) * sizeof *shaded->rgb);
  if (!shaded->rgb)
    return hsr_fail_nomem(err);
  for (size_t k = 0; k < count(answer); k++)
    shaded->rgb[k] = (float)rgb[k] / 65535;
  return HSR_OK;
}

static enum hsr_status write(const struct hsr_answer *answer,
                             const struct hsr_showing *showing,
                             struct hsr_shaded *shaded, const char *path,
                             struct hsr_error *err) {
  struct hsr_picture picture = {
      .m = answer->m, .n = answer->n, .rgb = shaded->rgb};
  return hsr_image_write(path, &picture, showing->text, err);
}

static bool fits(const char *path) {
  return hsr_is_colour_file(path);
}

static void print(const struct hsr_answer *answer,
                  const struct hsr_showing *showing, FILE *out) {
  (void)showing;
  fprintf(out, "transparent faces, mix=%s\n",
          mixes[hsr_form_mix(&answer->form)].name);
}

/* --- Tracing -------------------------------------------------------------- */

/* The part of an accepted event is the colour that the samples of its window
 * have from then on. */
static enum hsr_status paint(struct hsr_answer *answer,
                             const struct hsr_event *event) {
  uint16_t *rgb = answer->body;
  const struct hsr_window *w = &event->window;
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++)
      memcpy(rgb + CHANNELS * ((size_t)j * (size_t)answer->m + (size_t)i),
             event->part, CHANNELS * sizeof *rgb);
  return HSR_OK;
}

static json_t *part_json(const void *part, const struct hsr_view *view) {
  const uint16_t *c = part;
  (void)view;
  return json_pack("[iii]", c[0], c[1], c[2]);
}

/* All channels, sample after sample. */
static json_t *colours_json(const struct hsr_answer *answer,
                            const struct hsr_view *view) {
  const uint16_t *rgb = answer->body;
  (void)view;
  return hsr_channels_json(rgb, count(answer));
}

static void sketch(const struct hsr_answer *painted,
                   const struct hsr_event *event, enum hsr_step_kind step,
                   const struct hsr_view *view, uint32_t face,
                   const struct hsr_slide *slide) {
  (void)painted, (void)view;
  if (step == HSR_ACCEPT)
    slide->fill(slide->on, &event->window,
                event->part ? hsr_srgb_of(event->part) : face);
}

const struct hsr_answer_type hsr_answer_transparent = {
    .name = "transparent",
    .meaning = "the faces over a sample folded from back to front, in integers",
    .draws = "transparent faces",
    .places = "samples",
    .grains = "samples",
    .options = options,
    .sees_through = true,
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
    .json = colours_json,
    .part_json = part_json};
