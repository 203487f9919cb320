/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Opacity per length: how much of the light a splat, or a sum of splats, stops.
 * docs/composited-picture.md, "Opacity per length", defines it. No number is near
 * a half, so that the nearest integers are found in doubles. */
#include "algorithms/engines/splats/splats.h"

#include <math.h>

enum { OPACITIES = 65536 };

static void fill(struct hsr_splats *s) {
  for (int A = 0; A < OPACITIES; A++)
    s->length[A] = (uint32_t)lrint(-65536 * log2(1 - A / 65536.0));
  for (int i = 0; i < HSR_SPLAT_HALVED; i++)
    s->halved[i] = (uint32_t)lrint(65536 * exp2(-i / 256.0));
  for (int j = 0; j < HSR_SPLAT_LESSENED; j++)
    s->lessened[j] = (uint32_t)lrint(65536 * (1 - exp2(-j / 65536.0)));
}

enum hsr_status hsr_splats_open_lengths(struct hsr_splats *s) {
  struct hsr_arena *arena = s->job->scratch;
  const enum hsr_model model = s->splatting.model;
  s->veils = false;
  s->length = s->halved = s->lessened = NULL;
  if (!s->splatting.per_length)
    return HSR_OK;
  s->veils = model == HSR_OVER || model == HSR_UNDER;
  s->length = HSR_NEW(arena, uint32_t, OPACITIES);
  s->halved = HSR_NEW(arena, uint32_t, HSR_SPLAT_HALVED);
  s->lessened = HSR_NEW(arena, uint32_t, HSR_SPLAT_LESSENED);
  if (!s->length || !s->halved || !s->lessened)
    return HSR_E_NOMEM;
  fill(s);
  return HSR_OK;
}
