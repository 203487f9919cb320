/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Puts a splat into the pixels of its footprint: for every machine, and the
 * choice of a twin for this one. */
#include "algorithms/engines/splats/splats.h"

enum { LANES = HSR_SPLAT_LANES, OPACITY = HSR_SPLAT_OPACITY };

/* --- A pixel -------------------------------------------------------------- */

/* a + floor(b (65536 - by) / 65536). */
static inline uint16_t joined(uint32_t a, uint32_t b, uint32_t by) {
  return (uint16_t)(a + (b * (65536 - by) >> 16));
}

static inline uint16_t most_of(uint32_t sum) {
  return (uint16_t)(sum < UINT16_MAX ? sum : UINT16_MAX);
}

/* D is what the splat gives. */
static inline void put_channels(struct hsr_splat_picture *picture, size_t at,
                                const uint16_t D[4], enum hsr_splat_way way) {
  if (way == HSR_PUT_SUM) {
    for (int c = 0; c <= OPACITY; c++)
      picture->sum[at][c] += D[c];
    return;
  }
  uint16_t *E = picture->rgba[at];
  uint32_t by = way == HSR_PUT_OVER ? D[OPACITY] : E[OPACITY];
  for (int c = 0; c <= OPACITY; c++)
    E[c] = way == HSR_PUT_OVER    ? joined(D[c], E[c], by)
           : way == HSR_PUT_UNDER ? joined(E[c], D[c], by)
                                  : most_of((uint32_t)E[c] + D[c]);
}

static inline void put_weight(uint64_t *weight, uint64_t D, uint32_t by,
                              enum hsr_splat_way way) {
  *weight = way == HSR_PUT_OVER    ? D + (*weight * (65536 - by) >> 16)
            : way == HSR_PUT_UNDER ? *weight + (D * (65536 - by) >> 16)
                                   : *weight + D;
}

/* What is added to the fifth channel: M, or the weight. */
static inline uint64_t fifth(const struct hsr_splats *s,
                             const struct hsr_placed *p, uint32_t weight) {
  return (uint64_t)weight * (s->length ? p->length : p->energy) >> 16;
}

static inline void put_pixel(const struct hsr_splats *s,
                             const struct hsr_placed *p,
                             struct hsr_splat_picture *picture, size_t at,
                             uint32_t weight, enum hsr_splat_way way) {
  uint16_t D[4];
  uint32_t share = s->veils ? hsr_splats_veil(s, fifth(s, p, weight)) : weight;
  for (int c = 0; c <= OPACITY; c++)
    D[c] = (uint16_t)(share * p->colour[c] >> 16);
  if (picture->weight) {
    uint32_t by =
        way == HSR_PUT_UNDER ? picture->rgba[at][OPACITY] : D[OPACITY];
    put_weight(&picture->weight[at], fifth(s, p, weight), by, way);
  }
  put_channels(picture, at, D, way);
}

void hsr_splats_add(struct hsr_splats *s, const struct hsr_placed *p,
                    struct hsr_splat_picture *picture, int i, int j,
                    uint32_t weight) {
  put_pixel(s, p, picture, hsr_splats_at(picture, i, j), weight,
            picture->sum ? HSR_PUT_SUM : HSR_PUT_ADD);
}

/* --- For every machine ---------------------------------------------------- */

static void put_portable(struct hsr_splats *s, const struct hsr_placed *p,
                         struct hsr_splat_picture *picture,
                         enum hsr_splat_way way) {
  int32_t index[LANES];
  for (int j = p->box.y0; j < p->box.y1; j++)
    for (int x = p->box.x0; x < p->box.x1; x += LANES) {
      hsr_splats_find(s, p, x, j, index);
      for (int l = 0; l < LANES; l++) {
        if (index[l] == HSR_FOOTPRINT)
          continue;
        HSR_STEP(s->tally, HSR_SPLAT_UPDATES, HSR_CELL(p->cell, 0, 0),
                 HSR_THE_WINDOW, HSR_AT(x + l, j), 0);
        HSR_TOUCH(s->tally, x + l, j);
        put_pixel(s, p, picture, hsr_splats_at(picture, x + l, j),
                  s->weight[index[l]], way);
      }
    }
}

/* --- For its twins -------------------------------------------------------- */

#if HSR_SPLATS_HAVE_TWINS
/* What is beyond the footprint for certain stays. */
void hsr_splats_settle(const struct hsr_splats *s, const struct hsr_placed *p,
                       int x, int j, int columns, unsigned doubt,
                       uint32_t *index) {
  for (; doubt; doubt &= doubt - 1) {
    int l = __builtin_ctz(doubt), i = x + l % columns, row = j + l / columns;
    if (i >= p->box.x1 || row >= p->box.y1)
      index[l] = HSR_FOOTPRINT;
    else if (index[l] <= HSR_FOOTPRINT)
      index[l] = (uint32_t)hsr_splats_index(s, p, i, row);
  }
}
#endif

/* --- The choice ----------------------------------------------------------- */

hsr_splats_putter *hsr_splats_twin(void) {
#if HSR_SPLATS_HAVE_TWINS
  if (__builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
    return hsr_splats_put_avx512;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    return hsr_splats_put_avx2;
#endif
  return NULL;
}

void hsr_splats_put(struct hsr_splats *s, const struct hsr_placed *p,
                    struct hsr_splat_picture *picture, enum hsr_splat_way way) {
  HSR_STEP(s->tally, HSR_SPLAT_SPLATS, HSR_CELL(p->cell, 0, 0), HSR_THE_WINDOW,
           p->box, 2);
  if (s->twin && p->is_small && !picture->weight)
    s->twin(s, p, picture, way);
  else
    put_portable(s, p, picture, way);
}
