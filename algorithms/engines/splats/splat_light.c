/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What samples look like: opacity by density and gradient, and light on their
 * normals. All in integers, as docs/composited-picture.md has them. */
#include "algorithms/engines/splats/splats.h"
#include "common/base/numbers.h"
#include "common/base/vector.h"
#include "common/grids/normal.h"

#include <math.h>
#include <string.h>

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

/* --- Colours -------------------------------------------------------------- */

void hsr_splats_base(const struct hsr_splats *s, uint32_t cell,
                     uint32_t base[HSR_SPLAT_OPACITY]) {
  const struct hsr_grid *g = s->grid;
  const struct hsr_palette *p = &g->palette;
  for (int c = 0; c < HSR_SPLAT_OPACITY; c++)
    if (g->rgb && p->own_colours) {
      uint32_t byte = g->rgb[cell][c];
      base[c] = ONE * byte * byte / (255 * 255);
    } else
      base[c] = p->rgb[g->level[cell]][c];
}

void hsr_splats_colour(const struct hsr_splats *s, uint32_t cell,
                       uint32_t opacity,
                       uint16_t colour[HSR_SPLAT_OPACITY + 1]) {
  const struct hsr_splat_light *light = &s->light[s->grid->normal[cell]];
  uint32_t base[HSR_SPLAT_OPACITY];
  hsr_splats_base(s, cell, base);
  for (int c = 0; c < HSR_SPLAT_OPACITY; c++) {
    uint64_t lit = (uint64_t)base[c] * light->shade / ONE + light->gloss;
    lit = lit < ONE ? lit : ONE;
    colour[c] = (uint16_t)(lit * opacity / ONE);
  }
  colour[HSR_SPLAT_OPACITY] = (uint16_t)opacity;
}

/* --- Many at once --------------------------------------------------------- */

/* What colours are computed from: integers below 2^18. */
struct lanes {
  double base[HSR_SPLAT_OPACITY][HSR_SPLAT_BATCH];
  double shade[HSR_SPLAT_BATCH], gloss[HSR_SPLAT_BATCH];
  double opacity[HSR_SPLAT_BATCH], energy[HSR_SPLAT_BATCH];
};

static void gather(const struct hsr_splats *s, const struct hsr_placed *p,
                   int n, struct lanes *l) {
  for (int k = 0; k < n; k++) {
    const struct hsr_splat_light *light = &s->light[s->grid->normal[p[k].cell]];
    uint32_t base[HSR_SPLAT_OPACITY];
    hsr_splats_base(s, p[k].cell, base);
    for (int c = 0; c < HSR_SPLAT_OPACITY; c++)
      l->base[c][k] = base[c];
    l->shade[k] = light->shade;
    l->gloss[k] = light->gloss;
    l->opacity[k] = p[k].opacity;
    l->energy[k] = p[k].energy;
  }
}

/* floor(x / 65535), x being an integer below 2^35. With 0.5 added, the quotient is
 * farther from whole numbers than doubles err. */
static inline double by_one(double x) {
  return (double)(int32_t)((x + 0.5) * (1.0 / ONE));
}

/* As hsr_splats_colour does it, but in doubles, which hold all products; and times
 * the energy. `veils`: the lit colour itself, since opacity and energy are in V
 * already. */
HSR_VECTOR
static void
shade(const struct lanes *restrict l, int n, bool veils,
      uint16_t colour[restrict HSR_SPLAT_BATCH][HSR_SPLAT_OPACITY + 1]) {
  for (int k = 0; k < n; k++) {
    for (int c = 0; c < HSR_SPLAT_OPACITY; c++) {
      double lit = by_one(l->base[c][k] * l->shade[k]) + l->gloss[k];
      lit = hsr_min(lit, ONE);
      double given = by_one(lit * l->opacity[k]) * l->energy[k] * 0x1p-16;
      colour[k][c] = (uint16_t)(int32_t)(veils ? lit : given);
    }
    double given = l->opacity[k] * l->energy[k] * 0x1p-16;
    colour[k][HSR_SPLAT_OPACITY] = (uint16_t)(int32_t)(veils ? ONE : given);
  }
}

void hsr_splats_shade(const struct hsr_splats *s, struct hsr_placed *p, int n) {
  struct lanes lanes;
  uint16_t colour[HSR_SPLAT_BATCH][HSR_SPLAT_OPACITY + 1];
  if (n < 1)
    return;
  gather(s, p, n, &lanes);
  shade(&lanes, n, s->veils, colour);
  for (int k = 0; k < n; k++)
    memcpy(p[k].colour, colour[k], sizeof p[k].colour);
  for (int k = 0; k < n && s->length; k++)
    p[k].length =
        (uint32_t)((uint64_t)s->length[p[k].opacity] * p[k].energy >> 16);
}
