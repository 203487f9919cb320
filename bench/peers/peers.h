/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Renderers that draw one and the same picture, to be timed in turn. */
#ifndef HSR_BENCH_PEERS_PEERS_H
#define HSR_BENCH_PEERS_PEERS_H

#include "common/view.h"
#include "common/world.h"

#include <stdbool.h>

/* One renderer, set up for one world and one buffer of m x n ids. */
struct peer {
  const char *name;
  bool draws;          /* makes a picture that can be judged */
  const void *flavour; /* where one set of functions serves several peers */

  /* All that does not depend on the view, untimed. Every draw leaves the id of
   * sample (i, j) at ids[j * m + i]. *state is freed by release, also after a
   * failure. HSR_E_NOMEM, HSR_E_INTERNAL. */
  enum hsr_status (*setup)(const struct peer *peer,
                           const struct hsr_world *world, int m, int n,
                           uint32_t *ids, void **state, struct hsr_error *err);

  /* One whole frame, timed: from the world's vertices to the ids. */
  enum hsr_status (*draw)(void *state, const struct hsr_view *view,
                          struct hsr_error *err);

  void (*release)(void *state); /* NULL is allowed */
};

extern const struct peer peer_zbuffer, peer_zbuffer_inexact, peer_null,
    peer_memset;                      /* own.c */
extern const struct peer peer_embree; /* embree.c */
extern const struct peer peer_llvmpipe_indexed,
    peer_llvmpipe_arrays; /* osmesa.c */

#endif
