/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Intervals that hold the exact area integrals of the picture:
 * docs/area-picture.md. An answer is right if its intervals hold those of the
 * tightest answer, and are no wider than was asked for. Under a shader the
 * judge knows the integrals within bounds only. Then an answer is wrong if an
 * interval has nothing in common with the judge's. */
#include "common/answers/kinds/area.h"
#include "common/answers/coded.h"
#include "common/files/image.h"
#include "common/files/srgb.h"
#include "common/files/suffix.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CHANNELS = 3 };

/* The options of a form. */
enum { FILTER, EPS, SHADER, SIDE };

const struct hsr_word hsr_area_filters[] = {
    [HSR_AREA_BOX] = {"box", "the pixel itself", 0},
    [HSR_AREA_TENT] = {"tent", "the B-spline of degree 1, 2 pixels wide", 0},
    [HSR_AREA_QUADRATIC] = {"quadratic", "that of degree 2, 3 pixels wide", 0},
    [HSR_AREA_CUBIC] = {"cubic", "that of degree 3, 4 pixels wide", 0},
    {NULL}};

static const struct hsr_word shaders[] = {
    [HSR_SHADER_FLAT] = {"flat", "a face has one colour", 0},
    [HSR_SHADER_GOURAUD] = {"gouraud", "between a triangle's corners", 0},
    [HSR_SHADER_CHECKER] = {"checker", "a board projected on the faces", 0},
    [HSR_SHADER_BUMPS] = {"bumps", "the board under bumps, which refract", 0},
    [HSR_SHADER_PHONG] = {"phong", "with Phong's highlights", 0},
    [HSR_SHADER_SKY] = {"sky", "faces reflect a ramp of elevation", 0},
    [HSR_SHADER_WATER] = {"water", "bumps, highlights and sky", 0},
    {NULL}};

static const struct hsr_option options[] = {
    [FILTER] = {"filter", "how a pixel's surroundings count", hsr_area_filters,
                0, HSR_AREA_CUBIC, HSR_AREA_BOX},
    [EPS] = {"eps", "the greatest width of an interval", .real = true,
             .real_least = 0, .real_most = 1, .real_standard = .03125},
    [SHADER] = {"shader", "how the colour varies on a face", shaders, 0,
                HSR_SHADER_WATER, HSR_SHADER_FLAT},
    [SIDE] = {"side", "of the shader's squares, in the world", .real = true,
              .real_least = 1e-6, .real_most = 1e6, .real_standard = 1},
    {NULL}};

struct hsr_area_form hsr_form_area(const struct hsr_form *form) {
  return (struct hsr_area_form){
      .filter = (enum hsr_area_filter)form->values.option[FILTER],
      .eps = form->values.real[EPS],
      .shader = (enum hsr_shader)form->values.option[SHADER],
      .side = form->values.real[SIDE]};
}

static size_t count(const struct hsr_answer *answer) {
  return CHANNELS * (size_t)answer->m * (size_t)answer->n;
}

struct hsr_area_bounds *hsr_answer_areas_of(const struct hsr_answer *answer) {
  return answer->form.type == &hsr_answer_area ? answer->body : NULL;
}

static void unset(struct hsr_answer *answer) {
  struct hsr_area_bounds *bounds = answer->body;
  for (size_t k = 0; k < count(answer); k++)
    bounds[k] = (struct hsr_area_bounds){1, 0};
}

static enum hsr_status make(struct hsr_answer *answer, struct hsr_error *err) {
  answer->body = malloc(count(answer) * sizeof(struct hsr_area_bounds));
  if (!answer->body)
    return hsr_fail_nomem(err);
  unset(answer);
  return HSR_OK;
}

static void free_body(struct hsr_answer *answer) {
  free(answer->body);
}

static int arrays(const struct hsr_answer *answer,
                  struct hsr_array array[HSR_MOST_ARRAYS]) {
  array[0] = (struct hsr_array){answer->body,
                                CHANNELS * sizeof(struct hsr_area_bounds)};
  return 1;
}

/* --- Comparing ------------------------------------------------------------ */

enum fault { NONE, UNWRITTEN, WRONG, WIDE };

static enum fault fault_of(struct hsr_area_bounds got,
                           struct hsr_area_bounds wanted,
                           const struct hsr_area_form *form) {
  if (!(got.lo <= got.hi))
    return UNWRITTEN;
  if (got.lo == wanted.lo && got.hi == wanted.hi)
    return NONE;
  if (form->shader == HSR_SHADER_FLAT
          ? !(got.lo <= wanted.lo && got.hi >= wanted.hi)
          : !(got.lo <= wanted.hi && got.hi >= wanted.lo))
    return WRONG;
  return got.hi - got.lo > form->eps ? WIDE : NONE;
}

static void say_fault(enum fault fault, struct hsr_area_bounds got,
                      struct hsr_area_bounds wanted, double eps, size_t i,
                      size_t j, size_t channel, char *text, size_t size) {
  static const char *const name[CHANNELS] = {"red", "green", "blue"};
  int n = snprintf(text, size, "(%zu, %zu), %s: ", i, j, name[channel]);
  text += n, size -= (size_t)n;
  if (fault == UNWRITTEN)
    snprintf(text, size, "nothing is written");
  else if (fault == WRONG)
    snprintf(text, size, "[%.17g, %.17g] does not hold %.17g", got.lo, got.hi,
             wanted.lo);
  else
    snprintf(text, size, "[%.9g, %.9g] is wider than %g", got.lo, got.hi, eps);
}

/* The worst fault of a pixel, and in which channel. */
static enum fault fault_of_pixel(const struct hsr_area_bounds *got,
                                 const struct hsr_area_bounds *wanted,
                                 const struct hsr_area_form *form,
                                 size_t *channel) {
  enum fault worst = NONE;
  for (size_t c = 0; c < CHANNELS; c++) {
    enum fault fault = fault_of(got[c], wanted[c], form);
    if (fault && (!worst || fault < worst)) {
      worst = fault;
      *channel = c;
    }
  }
  return worst;
}

static void compare(const struct hsr_comparison *c,
                    struct hsr_difference *difference) {
  const struct hsr_area_bounds *got = c->got->body, *wanted = c->wanted->body;
  const struct hsr_area_form form = hsr_form_area(&c->got->form);
  difference->compared = c->n;
  for (size_t k = 0; k < c->n; k++) {
    size_t s = c->place ? c->place[k] : k, m = (size_t)c->got->m, channel = 0;
    const struct hsr_area_bounds *g = got + CHANNELS * s,
                                 *w = wanted + CHANNELS * s;
    enum fault fault = fault_of_pixel(g, w, &form, &channel);
    if (fault && !difference->differing++)
      say_fault(fault, g[channel], w[channel], form.eps, s % m, s / m, channel,
                difference->first, sizeof difference->first);
  }
}

/* --- Showing -------------------------------------------------------------- */

static double middle(struct hsr_area_bounds b) {
  return b.lo <= b.hi ? b.lo + (b.hi - b.lo) / 2 : 0;
}

/* The wanted picture, dimmed; what is wrong in orange, what is too wide in
 * blue. */
static enum hsr_status show_difference(const struct hsr_comparison *c,
                                       const struct hsr_showing *showing,
                                       float *rgb, struct hsr_error *err) {
  static const float wrong[3] = {1.0f, .35f, 0.0f}, wide[3] = {.2f, .4f, 1.0f};
  const struct hsr_area_bounds *got = c->got->body, *wanted = c->wanted->body;
  const struct hsr_area_form form = hsr_form_area(&c->got->form);
  (void)showing, (void)err;
  for (size_t k = 0; k < count(c->got); k += CHANNELS) {
    size_t channel;
    enum fault fault = fault_of_pixel(got + k, wanted + k, &form, &channel);
    for (size_t i = 0; i < CHANNELS; i++)
      rgb[k + i] = fault == NONE   ? 0.25f * (float)middle(wanted[k + i])
                   : fault == WIDE ? wide[i]
                                   : wrong[i];
  }
  return HSR_OK;
}

static enum hsr_status shade(const struct hsr_answer *answer,
                             const struct hsr_showing *showing,
                             struct hsr_shaded *shaded, struct hsr_error *err) {
  const struct hsr_area_bounds *bounds = answer->body;
  (void)showing;
  shaded->rgb = malloc(count(answer) * sizeof *shaded->rgb);
  if (!shaded->rgb)
    return hsr_fail_nomem(err);
  for (size_t k = 0; k < count(answer); k++)
    shaded->rgb[k] = (float)middle(bounds[k]);
  return HSR_OK;
}

/* By the widest interval of a pixel; 2 if it is wider than eps. */
static void uncertainty(const struct hsr_answer *answer, float *share) {
  const struct hsr_area_bounds *bounds = answer->body;
  double eps = hsr_form_area(&answer->form).eps;
  for (size_t k = 0; k < count(answer); k += CHANNELS) {
    double width = 0;
    for (size_t c = k; c < k + CHANNELS; c++)
      width =
          fmax(width, bounds[c].lo <= bounds[c].hi ? bounds[c].hi - bounds[c].lo
                                                   : INFINITY);
    share[k / CHANNELS] = width > eps ? 2
                          : width > 0 ? (float)(width / eps)
                                      : 0;
  }
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
  const struct hsr_area_bounds *bounds = answer->body;
  double eps = hsr_form_area(&answer->form).eps, widest = 0;
  size_t n = count(answer) / CHANNELS, within = 0;
  (void)showing;
  for (size_t k = 0; k < n; k++) {
    double width = 0;
    for (size_t c = 0; c < CHANNELS; c++) {
      const struct hsr_area_bounds *b = &bounds[CHANNELS * k + c];
      width = fmax(width, b->lo <= b->hi ? b->hi - b->lo : INFINITY);
    }
    within += width <= eps;
    widest = fmax(widest, width);
  }
  fprintf(out, "%.2f %% of the pixels within %g; the widest interval: %.3g\n",
          100.0 * (double)within / (double)n, eps, widest);
}

/* --- Tracing -------------------------------------------------------------- */

/* The part of an accepted event is the three intervals that its pixel has from
 * then on. */
static enum hsr_status paint(struct hsr_answer *answer,
                             const struct hsr_event *event) {
  struct hsr_area_bounds *bounds = answer->body;
  const struct hsr_window *w = &event->window;
  memcpy(bounds +
             CHANNELS * ((size_t)w->y0 * (size_t)answer->m + (size_t)w->x0),
         event->part, CHANNELS * sizeof *bounds);
  return HSR_OK;
}

/* lo, hi of red, of green and of blue. */
static json_t *part_json(const void *part, const struct hsr_view *view) {
  const struct hsr_area_bounds *b = part;
  (void)view;
  return json_pack("[ffffff]", b[0].lo, b[0].hi, b[1].lo, b[1].hi, b[2].lo,
                   b[2].hi);
}

/* The same of all pixels, one after the other. */
static json_t *bounds_json(const struct hsr_answer *answer,
                           const struct hsr_view *view) {
  const struct hsr_area_bounds *bounds = answer->body;
  json_t *all = json_array();
  (void)view;
  for (size_t k = 0; k < count(answer); k++) {
    hsr_json_append(&all, json_real(bounds[k].lo));
    hsr_json_append(&all, json_real(bounds[k].hi));
  }
  return all;
}

/* The middles of a pixel's intervals. */
static void sketch(const struct hsr_answer *painted,
                   const struct hsr_event *event, enum hsr_step_kind step,
                   const struct hsr_view *view, uint32_t face,
                   const struct hsr_slide *slide) {
  const struct hsr_area_bounds *channel = event->part;
  uint16_t middle[CHANNELS];
  (void)painted, (void)view;
  if (step != HSR_ACCEPT)
    return;
  for (int c = 0; channel && c < CHANNELS; c++)
    middle[c] = (uint16_t)lrint(
        65535 * fmin(1, fmax(0, (channel[c].lo + channel[c].hi) / 2)));
  slide->fill(slide->on, &event->window, channel ? hsr_srgb_of(middle) : face);
}

const struct hsr_answer_type hsr_answer_area = {
    .name = "area",
    .meaning = "intervals that hold the exact area integrals",
    .draws = "areas",
    .places = "pixels",
    .grains = "pixels",
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
    .uncertainty = uncertainty,
    .fits = fits,
    .write = write,
    .print = print,
    .paint = paint,
    .sketch = sketch,
    .json = bounds_json,
    .part_json = part_json};
