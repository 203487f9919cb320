/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/grids/densities.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const double hsr_density_percent[HSR_N_QUANTILES] = {0.1, 1,  5,  25,  50,
                                                     75,  95, 99, 99.9};
enum { HALF = 1 << 16 };

/* What walks through all samples. */
struct walk {
  uint32_t n;
  size_t size;
  hsr_density_slice *slice;
  void *data;
  float *density; /* a slice */
};

/* Calls see(whom, density) for each density that is a finite number. */
static enum hsr_status walk_through(const struct walk *w,
                                    void (*see)(void *whom, float density),
                                    void *whom, struct hsr_error *err) {
  enum hsr_status status = HSR_OK;
  for (uint32_t k = 0; k < w->n && !status; k++) {
    status = w->slice(w->data, k, w->density, err);
    for (size_t c = 0; c < w->size && !status; c++)
      if (isfinite(w->density[c]))
        see(whom, w->density[c]);
  }
  return status;
}

/* --- Quantiles ------------------------------------------------------------ */

/* Finite floats as whole numbers of the same order, and back. */
static uint32_t key_of(float density) {
  uint32_t bits;
  memcpy(&bits, &density, sizeof bits);
  return bits >> 31 ? ~bits : bits | UINT32_C(1) << 31;
}

static double density_of(uint32_t key) {
  uint32_t bits = key >> 31 ? key & ~(UINT32_C(1) << 31) : ~key;
  float density;
  memcpy(&density, &bits, sizeof density);
  return (double)density;
}

/* Two rounds of a radix sort that only counts, for the samples of some ranks:
 * the first, the quantiles, the last. */
enum { RANKS = HSR_N_QUANTILES + 2 };
struct counts {
  uint64_t n;
  uint64_t upper[HALF];        /* samples by the upper half of their key */
  uint64_t lower[RANKS][HALF]; /* by the lower one, of an upper one */
  int8_t row[HALF];            /* of an upper one: its row; -1: none */
};

static void count_upper(void *whom, float density) {
  struct counts *c = whom;
  c->n++;
  c->upper[key_of(density) >> 16]++;
}

static void count_lower(void *whom, float density) {
  struct counts *c = whom;
  uint32_t key = key_of(density);
  int row = c->row[key >> 16];
  if (row >= 0)
    c->lower[row][key & (HALF - 1)]++;
}

/* Returns the item of an array that holds a rank. *rank becomes its rank in
 * that. */
static uint32_t find_rank(const uint64_t *count, uint64_t *rank) {
  uint32_t k = 0;
  for (; *rank >= count[k]; k++)
    *rank -= count[k];
  return k;
}

/* Of the samples that are at most the quantile, the last one's. */
static uint64_t rank_of(const struct counts *c, int k) {
  if (k == 0)
    return 0;
  if (k == RANKS - 1)
    return c->n - 1;
  double rank = ceil(hsr_density_percent[k - 1] / 100 * (double)c->n) - 1;
  return rank > 0 ? (uint64_t)rank : 0;
}

static enum hsr_status measure_ranks(const struct walk *w, struct counts *c,
                                     struct hsr_densities *d,
                                     struct hsr_error *err) {
  uint32_t upper[RANKS];
  uint64_t left[RANKS];
  enum hsr_status status = walk_through(w, count_upper, c, err);
  if (status || !c->n)
    return status;
  memset(c->row, -1, sizeof c->row);
  for (int k = 0; k < RANKS; k++) {
    left[k] = rank_of(c, k);
    upper[k] = find_rank(c->upper, &left[k]);
    c->row[upper[k]] = (int8_t)k; /* of several ranks, the last */
  }
  status = walk_through(w, count_lower, c, err);
  double found[RANKS];
  for (int k = 0; k < RANKS && !status; k++)
    found[k] = density_of(upper[k] << 16 |
                          find_rank(c->lower[c->row[upper[k]]], &left[k]));
  if (status)
    return status;
  d->n = c->n;
  d->least = found[0];
  d->most = found[RANKS - 1];
  memcpy(d->quantile, found + 1, sizeof d->quantile);
  return HSR_OK;
}

/* --- The window and the threshold ----------------------------------------- */

static void set_window(struct hsr_densities *d) {
  double from = d->quantile[0], to = d->quantile[HSR_N_QUANTILES - 1];
  d->low = d->least;
  d->high = d->most;
  if (!(from < to))
    return;
  d->low = fmax(d->least, from - (to - from));
  d->high = fmin(d->most, to + (to - from));
}

static void count_bin(void *whom, float density) {
  struct hsr_densities *d = whom;
  double width = d->high - d->low,
         share = width > 0 ? ((double)density - d->low) / width : 0;
  int k = share >= 1  ? HSR_DENSITY_BINS - 1
          : share > 0 ? (int)(share * HSR_DENSITY_BINS)
                      : 0;
  d->bin[k < HSR_DENSITY_BINS ? k : HSR_DENSITY_BINS - 1]++;
}

/* Between bins k - 1 and k. Where several are equally good, since bins are
 * empty, the one in the middle. */
static double otsu(const struct hsr_densities *d) {
  double n = (double)d->n, all = 0, below = 0, sum = 0, most = 0;
  int first = 0, last = 0;
  for (int k = 0; k < HSR_DENSITY_BINS; k++)
    all += k * (double)d->bin[k];
  for (int k = 1; k < HSR_DENSITY_BINS; k++) {
    below += (double)d->bin[k - 1];
    sum += (k - 1) * (double)d->bin[k - 1];
    if (!(below > 0) || !(below < n))
      continue;
    double by = sum / below - (all - sum) / (n - below),
           variance = below * (n - below) * by * by;
    if (variance > most) {
      most = variance;
      first = k;
    }
    if (variance >= most)
      last = k;
  }
  return d->low + (d->high - d->low) * (first + last) / 2 / HSR_DENSITY_BINS;
}

enum hsr_status hsr_densities_measure(struct hsr_densities *densities,
                                      uint32_t n, size_t size,
                                      hsr_density_slice *slice, void *data,
                                      struct hsr_error *err) {
  *densities = (struct hsr_densities){.n = 0};
  struct walk w = {n, size, slice, data, malloc(size * sizeof(float))};
  struct counts *counts = calloc(1, sizeof *counts);
  enum hsr_status status = w.density && counts ? HSR_OK : hsr_fail_nomem(err);
  if (!status)
    status = measure_ranks(&w, counts, densities, err);
  if (!status && densities->n) {
    set_window(densities);
    status = walk_through(&w, count_bin, densities, err);
    densities->threshold = otsu(densities);
    densities->n_other = (uint64_t)n * size - densities->n;
  }
  free(counts);
  free(w.density);
  return status;
}
