/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The densities of all samples of a volume, in the data's own units: their
 * range, and where they part into what is there and what is not.
 *
 * Source      N. Otsu, "A Threshold Selection Method from Gray-Level
 *             Histograms", IEEE Transactions on Systems, Man, and Cybernetics
 *             9(1), 1979: the threshold whose two classes differ most, by their
 *             variance.
 * Outliers    spoil neither. The window, which the levels of palettes and the
 *             histogram span, is the range of densities, but reaches beyond the
 *             middle 99.8 % of them by at most as much as these span. What is
 *             beyond counts as its end. */
#ifndef HSR_COMMON_GRIDS_DENSITIES_H
#define HSR_COMMON_GRIDS_DENSITIES_H

#include "common/base/status.h"

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { HSR_DENSITY_BINS = 256, HSR_N_QUANTILES = 9 };

/* The shares of samples that are at most a quantile, in percent. */
extern const double hsr_density_percent[HSR_N_QUANTILES];

struct hsr_densities {
  uint64_t n;       /* samples whose density is a finite number */
  uint64_t n_other; /* other samples */
  double least, most;
  double quantile[HSR_N_QUANTILES]; /* each is the density of a sample */
  double low, high;                 /* the window */
  uint64_t bin[HSR_DENSITY_BINS];   /* samples in equal parts of the window; a
                                       density beyond it is in the first or the
                                       last */
  double threshold;                 /* Otsu's, of the bins */
};

/* Gives the samples: fills density[] with slice k. */
typedef enum hsr_status hsr_density_slice(void *data, uint32_t k,
                                          float *density,
                                          struct hsr_error *err);

/* Measures n slices of `size` samples each; `slice` is called for each of them
 * three times. If no density is a finite number, all of *densities is 0.
 * HSR_E_NOMEM; or the status of `slice`. */
enum hsr_status hsr_densities_measure(struct hsr_densities *densities,
                                      uint32_t n, size_t size,
                                      hsr_density_slice *slice, void *data,
                                      struct hsr_error *err);

#ifdef __cplusplus
}
#endif
#endif
