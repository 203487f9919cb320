/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/densities.h"

#include "common/files/json/json.h"

#include <stdio.h>

enum { ROWS = 16, BINS = HSR_DENSITY_BINS / ROWS, BAR = 40 };

static double share_of(const struct hsr_densities *d, int row) {
  double sum = 0;
  for (int k = 0; k < BINS; k++)
    sum += (double)d->bin[row * BINS + k];
  return sum / (double)d->n;
}

/* Bars are as long as shares of the fullest row. */
static void print_histogram(const struct hsr_densities *d) {
  double most = 0, step = (d->high - d->low) / ROWS;
  for (int row = 0; row < ROWS; row++)
    most = share_of(d, row) > most ? share_of(d, row) : most;
  printf("\n%13s %13s %8s\n", "from", "to", "share");
  for (int row = 0; row < ROWS; row++) {
    double share = share_of(d, row);
    double from = row ? d->low + row * step : d->least,
           to = row + 1 < ROWS ? d->low + (row + 1) * step : d->most;
    printf("%13.6g %13.6g %6.2f %%  ", from, to, 100 * share);
    for (int k = 0; k < (int)(BAR * share / most + 0.5); k++)
      putchar('#');
    putchar('\n');
  }
}

void print_densities(const struct hsr_densities *d) {
  printf("%llu densities", (unsigned long long)d->n);
  if (d->n_other)
    printf(", and %llu that are no finite number",
           (unsigned long long)d->n_other);
  printf(": from %g to %g\n", d->least, d->most);
  printf("standard threshold (Otsu's): %g\n", d->threshold);
  printf("window of palettes: %g to %g\n", d->low, d->high);
  printf("\n%9s  %s\n", "percent", "at most");
  for (int k = 0; k < HSR_N_QUANTILES; k++)
    printf("%9.4g  %g\n", hsr_density_percent[k], d->quantile[k]);
  if (d->low < d->high)
    print_histogram(d);
  putchar('\n');
}

json_t *densities_json(const struct hsr_densities *d) {
  json_t *percentiles = json_array(), *bins = json_array();
  for (int k = 0; k < HSR_N_QUANTILES; k++)
    hsr_json_append(&percentiles,
                    json_pack("{sf sf}", "percent", hsr_density_percent[k],
                              "density", d->quantile[k]));
  for (int k = 0; k < HSR_DENSITY_BINS; k++)
    hsr_json_append(&bins, json_integer((json_int_t)d->bin[k]));
  return json_pack("{sI sI sf sf sf s{sf sf} so so}", "samples",
                   (json_int_t)d->n, "not_finite", (json_int_t)d->n_other,
                   "least", d->least, "most", d->most, "threshold",
                   d->threshold, "window", "low", d->low, "high", d->high,
                   "percentiles", percentiles, "histogram", bins);
}
