/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "algorithms/volume/solid_triage.h"
#include "common/base/vector.h"

#include <math.h>

#if defined __x86_64__ && HSR_HAVE_TARGET_CLONES
#include <immintrin.h>
#define HAVE_AVX512_TWIN 1
#define AVX512 __attribute__((target("avx512f")))
#endif

/* f in the middle of the first cell, and how much more it is in the middle of
 * the next one along x, y and z; from its middle f changes by less than
 * `margin` over a cell, its error included. */
struct lattice {
  double f, step[3], margin;
};

static struct lattice lattice_of(const struct hsr_triage_plane *p,
                                 const int corner[3], int size) {
  double cell = size / 4, half = 0.5 * cell;
  double span = fabs(p->a) + fabs(p->b) + fabs(p->c);
  struct lattice l = {p->a * (corner[0] + half) + p->b * (corner[1] + half) +
                          p->c * (corner[2] + half) + p->d,
                      {p->a * cell, p->b * cell, p->c * cell},
                      span * (half - 0.5) + p->error};
  return l;
}

/* Written twice, for every machine and for AVX-512, and rounded alike: eight
 * cells of two rows at once, then the two rows next to them, then on along z.
 */
static struct hsr_triage split_portable(const struct lattice *l) {
  struct hsr_triage mask = {0, 0};
  for (int k = 0; k < 8; k++) {
    double first = l->f + (k % 4 * l->step[0] + k / 4 * l->step[1]);
    double at[2] = {first, first + 2 * l->step[1]};
    for (int bit = k; bit < 64; bit += 8) {
      double *f = &at[bit >> 3 & 1];
      mask.c |= (uint64_t)(*f > l->margin) << bit;
      mask.v |= (uint64_t)(*f < -l->margin) << bit;
      *f += l->step[2];
    }
  }
  return mask;
}

#ifdef HAVE_AVX512_TWIN
AVX512 static struct hsr_triage split_avx512(const struct lattice *l) {
  double x = l->step[0], y = l->step[1];
  __m512d margin = _mm512_set1_pd(l->margin);
  __m512d minus = _mm512_set1_pd(-l->margin);
  __m512d z = _mm512_set1_pd(l->step[2]), at[2];
  struct hsr_triage mask = {0, 0};
  at[0] = _mm512_add_pd(
      _mm512_set1_pd(l->f),
      _mm512_set_pd(3 * x + y, 2 * x + y, x + y, y, 3 * x, 2 * x, x, 0));
  at[1] = _mm512_add_pd(at[0], _mm512_set1_pd(2 * y));
  for (int bit = 0; bit < 64; bit += 8) {
    __m512d *f = &at[bit >> 3 & 1];
    mask.c |= (uint64_t)_mm512_cmp_pd_mask(*f, margin, _CMP_GT_OQ) << bit;
    mask.v |= (uint64_t)_mm512_cmp_pd_mask(*f, minus, _CMP_LT_OQ) << bit;
    *f = _mm512_add_pd(*f, z);
  }
  return mask;
}
#endif

struct hsr_triage hsr_solid_triage(const struct hsr_triage_plane *plane,
                                   const int corner[3], int size) {
  struct lattice lattice = lattice_of(plane, corner, size);
#ifdef HAVE_AVX512_TWIN
  if (__builtin_cpu_supports("avx512f"))
    return split_avx512(&lattice);
#endif
  return split_portable(&lattice);
}
