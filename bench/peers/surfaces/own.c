/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The yardsticks, which need no other library: zbuffer-fast without its exact
 * decisions, and memset. */
#include "config.h"

#include "bench/peers/shared/peers.h"
#include "bench/run/crew.h"

#include <stdlib.h>
#include <string.h>

static void own_version(char *text) {
  strcpy(text, PACKAGE_VERSION);
}

/* --- zbuffer-fast, inexact ------------------------------------------------ */

struct inexact {
  const struct hsr_setup *setup;
  struct crew *crew;
  struct hsr_answer answer; /* its ids are the canvas' */
};

static enum hsr_status inexact_setup(const struct peer *peer,
                                     const struct peer_canvas *canvas,
                                     void **state, struct hsr_error *err) {
  (void)peer;
  struct inexact *inexact = calloc(1, sizeof *inexact);
  *state = inexact;
  if (!inexact)
    return hsr_fail_nomem(err);
  inexact->setup = canvas->setup;
  inexact->answer = hsr_answer_of_ids(canvas->ids, canvas->m, canvas->n);
  inexact->crew = crew_new(canvas->threads);
  return inexact->crew ? HSR_OK : hsr_fail_nomem(err);
}

static enum hsr_status inexact_draw(void *state, const struct hsr_view *view,
                                    struct hsr_error *err) {
  struct inexact *inexact = state;
  struct hsr_tally tally = {.work = NULL};
  return crew_render(inexact->crew, inexact->setup, view, &inexact->answer,
                     &tally, err);
}

static void inexact_release(void *state) {
  struct inexact *inexact = state;
  if (inexact)
    crew_free(inexact->crew);
  free(inexact);
}

extern const struct hsr_algorithm hsr_algorithm_zbuffer_fast_inexact;

const struct peer peer_zbuffer_inexact = {
    .name = "zbuffer-inexact",
    .title = "zbuffer-fast without its exact fallback",
    .source = "hsr, algorithms/brute_force/zbuffer_fast/zbuffer_fast.c",
    .what = "What exactness costs: our own zbuffer-fast, but within the error "
            "bounds it decides by the rounded numbers. Frame and set-up are "
            "those of zbuffer-fast.",
    .kind = "ids",
    .many_threads = true,
    .demands = &hsr_algorithm_zbuffer_fast_inexact,
    .version = own_version,
    .setup = inexact_setup,
    .draw = inexact_draw,
    .release = inexact_release};

/* --- memset: an id and a depth a sample ----------------------------------- */

struct fill {
  uint32_t *ids;
  float *depth;
  size_t n;
};

static enum hsr_status fill_setup(const struct peer *peer,
                                  const struct peer_canvas *canvas,
                                  void **state, struct hsr_error *err) {
  (void)peer;
  struct fill *fill = calloc(1, sizeof *fill);
  *state = fill;
  if (!fill)
    return hsr_fail_nomem(err);
  fill->ids = canvas->ids;
  fill->n = (size_t)canvas->m * (size_t)canvas->n;
  fill->depth = malloc(fill->n * sizeof *fill->depth);
  return fill->depth ? HSR_OK : hsr_fail_nomem(err);
}

static enum hsr_status fill_draw(void *state, const struct hsr_view *view,
                                 struct hsr_error *err) {
  (void)view, (void)err;
  struct fill *fill = state;
  memset(fill->ids, 0xff, fill->n * sizeof *fill->ids);
  memset(fill->depth, 0, fill->n * sizeof *fill->depth);
  return HSR_OK;
}

static void fill_release(void *state) {
  struct fill *fill = state;
  if (fill)
    free(fill->depth);
  free(fill);
}

static const struct hsr_algorithm takes_all = {.name = "any",
                                               .subjects = 1 << HSR_FACES,
                                               .makes = {{HSR_IDS}},
                                               .flags = HSR_INSTANCED};

const struct peer peer_memset = {
    .name = "memset",
    .title = "memset, the floor of every z-buffer",
    .source = "ISO C11, 7.24.6.1",
    .what = "What memory costs: a frame fills one id and one float of depth a "
            "sample, and draws nothing.",
    .kind = "none",
    .demands = &takes_all,
    .version = own_version,
    .setup = fill_setup,
    .draw = fill_draw,
    .release = fill_release};
