/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A kind of answer that hsr does not have: how many faces cover each sample. It
 * takes only this file and a line in lists.c. The file has the kind, an oracle,
 * and two algorithms that make it, one of them wrong. */
#include "algorithms/algorithm.h"
#include "common/exact/screen.h"
#include "common/files/image.h"
#include "common/files/suffix.h"

#include <stdlib.h>
#include <string.h>

/* --- The kind ------------------------------------------------------------- */

static size_t count_samples(const struct hsr_answer *answer) {
  return (size_t)answer->m * (size_t)answer->n;
}

static enum hsr_status make(struct hsr_answer *answer, struct hsr_error *err) {
  answer->body = calloc(count_samples(answer), sizeof(uint16_t));
  return answer->body ? HSR_OK : hsr_fail_nomem(err);
}

static void unset(struct hsr_answer *answer) {
  memset(answer->body, 0xfe, count_samples(answer) * sizeof(uint16_t));
}

static void free_body(struct hsr_answer *answer) {
  free(answer->body);
}

static int arrays(const struct hsr_answer *answer,
                  struct hsr_array array[HSR_MOST_ARRAYS]) {
  array[0] = (struct hsr_array){answer->body, sizeof(uint16_t)};
  return 1;
}

static void compare(const struct hsr_comparison *c,
                    struct hsr_difference *difference) {
  const uint16_t *got = c->got->body, *wanted = c->wanted->body;
  difference->compared = c->n;
  for (size_t k = 0; k < c->n; k++) {
    size_t s = c->place ? c->place[k] : k, m = (size_t)c->got->m;
    if (got[s] != wanted[s] && !difference->differing++)
      snprintf(difference->first, sizeof difference->first,
               "(%zu, %zu): %u, not %u", s % m, s / m, got[s], wanted[s]);
  }
}

static enum hsr_status shade(const struct hsr_answer *answer,
                             const struct hsr_showing *showing,
                             struct hsr_shaded *shaded, struct hsr_error *err) {
  const uint16_t *layers = answer->body;
  size_t n = count_samples(answer);
  (void)showing;
  shaded->rgb = malloc(3 * n * sizeof *shaded->rgb);
  if (!shaded->rgb)
    return hsr_fail_nomem(err);
  for (size_t k = 0; k < 3 * n; k++)
    shaded->rgb[k] = (float)layers[k / 3] / 8;
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
  return hsr_ends_in(path, ".png");
}

static void print(const struct hsr_answer *answer,
                  const struct hsr_showing *showing, FILE *out) {
  const uint16_t *layers = answer->body;
  unsigned most = 0;
  (void)showing;
  for (size_t k = 0; k < count_samples(answer); k++)
    most = layers[k] > most ? layers[k] : most;
  fprintf(out, "at most %u layers\n", most);
}

const struct hsr_answer_type hsr_answer_layers = {
    .name = "layers",
    .meaning = "how many faces lie over each sample",
    .draws = "layers",
    .places = "layers",
    .grains = "samples",
    .by_windows = true,
    .by_places = true,
    .make = make,
    .unset = unset,
    .free = free_body,
    .arrays = arrays,
    .compare = compare,
    .shade = shade,
    .fits = fits,
    .write = write,
    .print = print};

/* --- Who makes it --------------------------------------------------------- */

/* Asks each relevant face at each sample, except the last `without` faces. */
static enum hsr_status count(const struct hsr_job *job, uint32_t without,
                             struct hsr_error *err) {
  struct hsr_screen screen;
  const struct hsr_window *w = &job->view->window;
  uint16_t *layers = job->answer->body;
  if (hsr_screen_make(&screen, job->world, job->view, job->scratch, job->tally))
    return hsr_fail_nomem(err);
  for (int j = w->y0; j < w->y1; j++)
    for (int i = w->x0; i < w->x1; i++) {
      uint16_t n = 0;
      for (uint32_t r = 0; r < screen.n_relevant; r++)
        if (screen.relevant[r] + without < job->world->n_faces)
          n = (uint16_t)(n + hsr_covers(&screen, screen.relevant[r], i, j,
                                        job->tally));
      layers[j * job->view->m + i] = n;
    }
  return HSR_OK;
}

static enum hsr_status count_all(const struct hsr_job *job,
                                 struct hsr_error *err) {
  return count(job, 0, err);
}

static enum hsr_status count_some(const struct hsr_job *job,
                                  struct hsr_error *err) {
  return count(job, job->world->n_faces / 2, err);
}

#define LAYERS(id, name_, render_, flags_)                                     \
  const struct hsr_algorithm hsr_algorithm_##id = {                            \
      .name = name_,                                                           \
      .title = name_,                                                          \
      .authors = "hsr",                                                        \
      .source = "tests",                                                       \
      .taxonomy = HSR_YARDSTICK,                                               \
      .subjects = 1 << HSR_FACES,                                              \
      .makes = {{&hsr_answer_layers}},                                         \
      .flags = flags_,                                                         \
      .render = render_};
LAYERS(layer_oracle, "layer-oracle", count_all, HSR_JUDGE)
LAYERS(layer_count, "layer-count", count_all, 0)
LAYERS(layer_half, "layer-half", count_some, 0)
