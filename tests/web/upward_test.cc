/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rounding upwards of bench/web/stand_in/CGAL/FPU.h beside that of the processor:
 * on numbers of every size, on sums and products that are exact or nearly so, and on
 * all pairs of odd ones.
 *
 * usage: upward_test [N [SEED]]    N random pairs (standard: 2,000,000) */
#define CGAL_ALWAYS_ROUND_TO_NEAREST
#define CGAL_DISABLE_ROUNDING_MATH_CHECK
#include "bench/web/stand_in/CGAL/FPU.h"
#include "tests/tap.h"

#include <cfenv>
#include <cstdlib>

namespace {

namespace up = CGAL::upward;

/* What the processor says, rounding that way. */
template <class Does> double by_processor(int mode, Does does) {
  std::fesetround(mode);
  volatile double result = does();
  std::fesetround(FE_TONEAREST);
  return result;
}

bool is_same(double x, double y) {
  return (x != x && y != y) || (x == y && std::signbit(x) == std::signbit(y));
}

struct Tried {
  unsigned long pairs = 0, differ = 0;
  double a = 0, b = 0;
  const char *operation = "";
};

void compare(const char *operation, double got, double wanted, double a,
             double b, Tried *tried) {
  if (is_same(got, wanted))
    return;
  if (!tried->differ++) {
    tried->a = a;
    tried->b = b;
    tried->operation = operation;
  }
}

void try_pair(double a, double b, Tried *tried) {
  volatile double x = a, y = b;
  const double root = std::fabs(a);
  volatile double r = root;
  tried->pairs++;
  compare("sum", up::sum(a, b), by_processor(FE_UPWARD, [&] { return x + y; }),
          a, b, tried);
  compare("product", up::product(a, b),
          by_processor(FE_UPWARD, [&] { return x * y; }), a, b, tried);
  compare("quotient", up::quotient(a, b),
          by_processor(FE_UPWARD, [&] { return x / y; }), a, b, tried);
  compare("root", up::root(root),
          by_processor(FE_UPWARD, [&] { return std::sqrt(r); }), root, 0,
          tried);
  compare("root below", up::root_below(root),
          root > 0 ? by_processor(FE_DOWNWARD, [&] { return std::sqrt(r); })
                   : 0,
          root, 0, tried);
}

uint64_t state;

uint64_t next() {
  state ^= state << 13;
  state ^= state >> 7;
  state ^= state << 17;
  return state;
}

/* Any bits at all; of few bits; or of a usual size. */
double any() {
  uint64_t bits = next();
  double x;
  switch (next() % 3) {
  case 0:
    std::memcpy(&x, &bits, sizeof x);
    return x;
  case 1:
    return std::ldexp(double(int64_t(bits) >> (24 + bits % 40)),
                      int(next() % 2200) - 1150);
  default:
    return double(int64_t(bits)) * 0x1p-60;
  }
}

/* b itself, or a number of which the sum, the quotient or the product with a is
 * nearly a double. */
double near(double a, double b) {
  switch (next() % 6) {
  case 0:
    return -a * (1 + double(next() % 5) * 0x1p-52);
  case 1:
    return a * double(next() % 64);
  case 2:
    return b != 0 ? a / b : 1;
  default:
    return b;
  }
}

void say(struct tap *tap, const char *which, const Tried &tried) {
  ok(tap, tried.pairs && !tried.differ,
     "%s: %lu pairs, %lu results differ from the processor's", which,
     tried.pairs, tried.differ);
  if (tried.differ)
    printf("# first: %s of %a and %a\n", tried.operation, tried.a, tried.b);
}

} // namespace

int main(int argc, char **argv) {
  struct tap tap = plan(2);
  const long n = argc > 1 ? std::atol(argv[1]) : 2000000;
  state = 0x9e3779b97f4a7c15u +
          (argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1);
  Tried random, odd;
  for (long k = 0; k < n; k++) {
    const double a = any();
    try_pair(a, near(a, any()), &random);
  }
  say(&tap, "random numbers", random);
  const double parts[] = {0,
                          1,
                          1 + 0x1p-52,
                          1 - 0x1p-53,
                          3,
                          0x1p-1074,
                          0x1p-1022,
                          0x1p-1000,
                          0x1p-900,
                          0x1p990,
                          0x1p1023,
                          0x1.fffffffffffffp1023,
                          0x1.fffffffffffffp-1023,
                          INFINITY,
                          NAN,
                          0x1.23456789abcdfp-540};
  for (const double a : parts)
    for (const double b : parts)
      for (int signs = 0; signs < 4; signs++)
        try_pair(signs & 1 ? -a : a, signs & 2 ? -b : b, &odd);
  say(&tap, "odd numbers", odd);
  return finish(&tap);
}
