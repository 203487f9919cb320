/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What samples look like: opacity by density and gradient, and light on their
 * normals. All in integers, as docs/composited-picture.md has them. */
#include "algorithms/volume/splats/splats.h"
#include "common/grids/normal.h"

#include <math.h>

enum { ONE = 65535, COSINE = 8192 };

/* The greatest integer whose square is at most x < 2^52. */
static int64_t root_of(int64_t x) {
  int64_t root = (int64_t)sqrt((double)x);
  while (root * root > x)
    root--;
  while ((root + 1) * (root + 1) <= x)
    root++;
  return root;
}

static int64_t dot(const int a[3], const int b[3]) {
  return (int64_t)a[0] * b[0] + (int64_t)a[1] * b[1] + (int64_t)a[2] * b[2];
}

/* A quotient of 8192 at most, and 0 if it is negative or there is none. */
static uint32_t cosine(int64_t over, int64_t under) {
  if (over <= 0 || under <= 0)
    return 0;
  int64_t quotient = COSINE * over / under;
  return (uint32_t)(quotient < COSINE ? quotient : COSINE);
}

static struct hsr_splat_light light_on(const struct hsr_palette *p,
                                       const int N[3], const int L[3],
                                       const int V[3]) {
  int64_t NN = dot(N, N), LL = dot(L, L), VV = dot(V, V);
  uint32_t c = cosine(dot(N, L), root_of(NN * LL));
  int64_t x = 2 * dot(N, L) * dot(N, V) - dot(L, V) * NN;
  uint32_t s = c ? cosine(x, NN * root_of(LL * VV)) : 0, power = s;
  for (int k = 1; k < p->exponent; k++)
    power = power * s / COSINE;
  return (struct hsr_splat_light){p->ambient + p->diffuse * c / COSINE,
                                  p->specular * power / COSINE};
}

void hsr_splats_fill_lights(struct hsr_splats *s) {
  const struct hsr_palette *p = &s->grid->palette;
  int L[3], V[3], N[3];
  for (int a = 0; a < 3; a++) {
    V[a] = -(int)lrint(1024 * s->view->F[a]);
    L[a] = p->eye_light ? V[a] : p->light[a];
  }
  for (uint16_t code = 0; code < HSR_NORMALS; code++) {
    hsr_normal_of(code, N);
    s->light[code] = light_on(p, N, L, V);
  }
  s->light[HSR_NO_NORMAL] =
      (struct hsr_splat_light){(uint32_t)p->ambient + p->diffuse, 0};
}

void hsr_splats_colour(const struct hsr_splats *s, uint32_t cell,
                       uint32_t opacity,
                       uint16_t colour[HSR_SPLAT_OPACITY + 1]) {
  const struct hsr_grid *g = s->grid;
  const struct hsr_palette *p = &g->palette;
  const struct hsr_splat_light *light = &s->light[g->normal[cell]];
  uint8_t level = g->level[cell];
  colour[HSR_SPLAT_OPACITY] = (uint16_t)opacity;
  bool own = g->rgb && p->own_colours;
  for (int c = 0; c < HSR_SPLAT_OPACITY; c++) {
    uint32_t base = p->rgb[level][c];
    if (own) {
      uint32_t byte = g->rgb[cell][c];
      base = ONE * byte * byte / (255 * 255);
    }
    uint64_t lit = (uint64_t)base * light->shade / ONE + light->gloss;
    lit = lit < ONE ? lit : ONE;
    colour[c] = (uint16_t)(lit * opacity / ONE);
  }
}
