/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The tables of the kernels. A kernel's integral along a line is one in closed
 * form: of a polynomial in x = sqrt(rho^2 + t^2), over t. */
#include "algorithms/engines/splats/splats.h"

#include <math.h>

/* --- The kernel of Crawfis and Max ---------------------------------------- */

#define KNEE 0.88
#define REACH 1.556228

/* h(x) = sum c[n] x^n: within the knee, and beyond it. */
static const double inner[4] = {0.557526, 0, -1.157744, 0.671033};
#define A 0.067599
#define B 0.282474
static const double outer[4] = {(A * REACH * REACH) + B * REACH * REACH * REACH,
                                -2 * A *REACH - 3 * B *REACH *REACH,
                                A + 3 * B *REACH, -B};
#undef A
#undef B

/* The integral of a polynomial in x over t from 0 to t. */
static double integral(const double c[4], double rho, double t) {
  double square = rho * rho, x = sqrt(square + t * t);
  double log = rho > 0 ? square * asinh(t / rho) : 0;
  double first = (t * x + log) / 2;                        /* of x */
  double third = (t * x * x * x + 3 * square * first) / 4; /* of x^3 */
  return c[0] * t + c[1] * first + c[2] * (square * t + t * t * t / 3) +
         c[3] * third;
}

/* The integral of the kernel from its middle as far as t >= 0. */
static double half_spline(double rho, double t) {
  double knee = rho < KNEE ? sqrt(KNEE * KNEE - rho * rho) : 0;
  double rim = sqrt(REACH * REACH - rho * rho);
  if (t > rim)
    t = rim;
  double sum = integral(inner, rho, t < knee ? t : knee);
  return t <= knee ? sum
                   : sum + integral(outer, rho, t) - integral(outer, rho, knee);
}

/* --- The Gaussian --------------------------------------------------------- */

#define SIGMA 0.6

static double half_gaussian(double rho, double t) {
  static const double pi = 3.14159265358979323846;
  double all = exp(-rho * rho / (2 * SIGMA * SIGMA)) / (2 * pi * SIGMA * SIGMA);
  return all / 2 * erf(t / (SIGMA * sqrt(2)));
}

/* --- Tables --------------------------------------------------------------- */

static double half(const struct hsr_splats *s, double rho, double t) {
  return s->splatting.kernel == HSR_GAUSSIAN ? half_gaussian(rho, t)
                                             : half_spline(rho, t);
}

static double distance_of(const struct hsr_splats *s, int knot) {
  return s->reach * sqrt((double)knot / HSR_SPLAT_KNOTS);
}

void hsr_splats_fill_weights(struct hsr_splats *s) {
  s->reach = 1e-6 * hsr_kernel_reach[s->splatting.kernel];
  for (int k = 0; k < HSR_SPLAT_KNOTS; k++)
    s->knot[k] =
        (uint16_t)lrint(65536 * 2 * half(s, distance_of(s, k), INFINITY));
  s->knot[HSR_SPLAT_KNOTS] = 0;
  for (int k = 0; k < HSR_SPLAT_KNOTS; k++)
    s->fall[k] = (uint16_t)(s->knot[k] - s->knot[k + 1]);
  for (int kappa = 0; kappa < HSR_FOOTPRINT; kappa++)
    s->weight[kappa] = hsr_splats_between(s->knot, kappa);
  s->weight[HSR_FOOTPRINT] = 0;
}

void hsr_splats_fill_parts(struct hsr_splats *s) {
  enum { PARTS = HSR_FOOTPRINT_PARTS };
  for (int part = 0; part <= 2 * PARTS; part++) {
    uint16_t *T = s->before[part];
    double t = s->reach * (part - PARTS) / PARTS;
    for (int k = 0; k < HSR_SPLAT_KNOTS; k++) {
      double rho = distance_of(s, k);
      double before =
          half(s, rho, INFINITY) + copysign(half(s, rho, fabs(t)), t);
      T[k] = (uint16_t)(part == 0           ? 0
                        : part == 2 * PARTS ? s->knot[k]
                                            : lrint(65536 * before));
    }
    T[HSR_SPLAT_KNOTS] = 0;
  }
}
