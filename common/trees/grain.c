/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "common/trees/grain.h"

#include <math.h>

/* The exponent of the least bit of x, which is not 0. */
static int least_bit(double x) {
  int exponent;
  int64_t bits = (int64_t)ldexp(frexp(x, &exponent), 53);
  return exponent - 53 + __builtin_ctzll((unsigned long long)bits);
}

int hsr_grain(const double *x, size_t n) {
  int grain = HSR_GRAIN_ANY;
  for (size_t k = 0; k < n; k++)
    if (x[k] != 0 && least_bit(x[k]) < grain)
      grain = least_bit(x[k]);
  return grain;
}

double hsr_reach(const struct hsr_object *object) {
  double reach = 0;
  for (size_t k = 0; k < 3 * (size_t)object->n_vertices; k++)
    reach = fmax(reach, fabs(object->xyz[k]));
  return reach;
}

bool hsr_instance_is_exact(const struct hsr_instance *instance, int grain,
                           double reach) {
  const double *row = instance->m;
  double far = 0;
  for (int k = 0; k < 3; k++, row += 4) {
    int units = 0;
    for (int l = 0; l < 3; l++) {
      if (row[l] != 0 && fabs(row[l]) != 1)
        return false;
      units += row[l] != 0;
    }
    if (units != 1)
      return false;
    int of_shift = hsr_grain(&row[3], 1);
    grain = of_shift < grain ? of_shift : grain;
    far = fmax(far, fabs(row[3]));
  }
  return reach + far < ldexp(1, grain + 52);
}
