/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What masks.c does with the samples of a cell of the finest level, for
 * machines with AVX2 and fused products, but without AVX-512: four samples at a
 * time. It does what its portable twin in masks.c does, but rounds less.
 * Included in masks.c only. */
#ifndef HSR_ALGORITHMS_TILING_MASKS_AVX2_H
#define HSR_ALGORITHMS_TILING_MASKS_AVX2_H

#define AVX2 __attribute__((target("avx2,fma")))

AVX2 static inline void split_avx2(const struct hsr_mask_line *line, double f,
                                   const struct hsr_mask_places *places,
                                   uint64_t *inside, uint64_t *outside) {
  const __m256d a = _mm256_set1_pd(line->a), b = _mm256_set1_pd(line->b),
                from = _mm256_set1_pd(f), error = _mm256_set1_pd(line->error),
                minus = _mm256_set1_pd(-line->error);
  uint64_t in = 0, out = 0;
  for (int k = 0; k < 64; k += 4) {
    __m256d x = _mm256_loadu_pd(places->x + k),
            y = _mm256_loadu_pd(places->y + k);
    __m256d at = _mm256_fmadd_pd(a, x, _mm256_fmadd_pd(b, y, from));
    unsigned more =
        (unsigned)_mm256_movemask_pd(_mm256_cmp_pd(at, error, _CMP_GT_OQ));
    unsigned less =
        (unsigned)_mm256_movemask_pd(_mm256_cmp_pd(at, minus, _CMP_LT_OQ));
    in |= (uint64_t)more << k;
    out |= (uint64_t)less << k;
  }
  *inside = in;
  *outside = out;
}

MASK_TWIN(avx2, AVX2, split_avx2, compose);

#endif
