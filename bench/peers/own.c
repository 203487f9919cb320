/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The renderers that need no other library: algorithms of hsr, and memset. */
#include "bench/peers/peers.h"

#include "algorithms/setup.h"

#include <stdlib.h>
#include <string.h>

/* --- An algorithm of hsr ---------------------------------------------------
 */

struct own {
  struct hsr_setup setup;
  struct hsr_arena scratch; /* kept, so that a frame allocates nothing */
  uint32_t *ids;
};

static enum hsr_status own_setup(const struct peer *peer,
                                 const struct hsr_world *world, int m, int n,
                                 uint32_t *ids, void **state,
                                 struct hsr_error *err) {
  (void)m, (void)n;
  struct own *own = calloc(1, sizeof *own);
  *state = own;
  if (!own)
    return hsr_fail_nomem(err);
  own->ids = ids;
  return hsr_setup_init(&own->setup, peer->flavour, world, err);
}

static enum hsr_status own_draw(void *state, const struct hsr_view *view,
                                struct hsr_error *err) {
  struct own *own = state;
  struct hsr_tally tally = {.work = NULL};
  hsr_arena_reset(&own->scratch);
  struct hsr_job job = {.view = view,
                        .scratch = &own->scratch,
                        .tally = &tally,
                        .ids = own->ids,
                        .ids_stride = (size_t)view->m};
  return hsr_setup_render(&own->setup, &job, err);
}

static void own_release(void *state) {
  struct own *own = state;
  if (!own)
    return;
  hsr_setup_free(&own->setup);
  hsr_arena_free(&own->scratch);
  free(own);
}

extern const struct hsr_algorithm hsr_algorithm_zbuffer,
    hsr_algorithm_zbuffer_inexact, hsr_algorithm_null;

#define OWN(name_, draws_, algorithm)                                          \
  {                                                                            \
    .name = name_, .draws = draws_, .flavour = &algorithm, .setup = own_setup, \
    .draw = own_draw, .release = own_release                                   \
  }
const struct peer peer_zbuffer = OWN("zbuffer", true, hsr_algorithm_zbuffer);
const struct peer peer_zbuffer_inexact =
    OWN("zbuffer-inexact", true, hsr_algorithm_zbuffer_inexact);
const struct peer peer_null = OWN("null", false, hsr_algorithm_null);

/* --- memset: an id and a depth a sample ------------------------------------
 */

struct fill {
  uint32_t *ids;
  float *depth;
  size_t n;
};

static enum hsr_status fill_setup(const struct peer *peer,
                                  const struct hsr_world *world, int m, int n,
                                  uint32_t *ids, void **state,
                                  struct hsr_error *err) {
  (void)peer, (void)world;
  struct fill *fill = calloc(1, sizeof *fill);
  *state = fill;
  if (!fill)
    return hsr_fail_nomem(err);
  fill->ids = ids;
  fill->n = (size_t)m * (size_t)n;
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

const struct peer peer_memset = {.name = "memset",
                                 .setup = fill_setup,
                                 .draw = fill_draw,
                                 .release = fill_release};
