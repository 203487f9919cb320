// SPDX-License-Identifier: GPL-3.0-or-later
/* The plane of a polygon modulo a prime.
 *
 * Residues    a double is a whole number times a power of two, and the prime p
 *             = 2^61 - 1 is odd. So each double has a residue modulo p, and
 *             sums and products of doubles have the sums and products of
 *             residues. Evaluated in residues, newell_plane gives those of the
 *             plane's equation, whose coefficients are k N and N . S.
 * Equal       the equations of equal planes differ by a factor u / v, u and v
 *             being whole numbers without a common divisor. Let neither
 *             equation be 0 modulo p. Then p divides neither u nor v: v times
 *             the one equation is u times the other, so if p divided u, it
 *             would divide v, too. Hence the residues of the equations differ
 *             by a factor, and quotients of coefficients are equal.
 * Different   planes may have equal quotients by chance. That happens to about
 *             one pair in 2^61. So equal residues must be confirmed by
 *             hsr_exact_same_plane. */
#include "common/polygon/exact_numbers.h"
#include "common/polygon/polygon.h"

#include <cmath>

using namespace hsr;

namespace {

__extension__ typedef unsigned __int128 wide;

class Residue {
  static constexpr uint64_t P = (UINT64_C(1) << 61) - 1;
  uint64_t r; // below P

  static Residue of(uint64_t below_2p) {
    Residue a(0);
    a.r = below_2p >= P ? below_2p - P : below_2p;
    return a;
  }

public:
  // 2^61 is 1, so a factor of 2 turns the 61 bits.
  explicit Residue(double x) {
    int exponent;
    uint64_t bits =
        uint64_t(std::ldexp(std::frexp(std::fabs(x), &exponent), 53));
    unsigned turn = unsigned((exponent - 53) % 61 + 61) % 61;
    r = (bits << turn | bits >> (61 - turn)) & P;
    if (x < 0)
      r = P - r;
    r = r == P ? 0 : r;
  }

  friend Residue operator+(Residue a, Residue b) { return of(a.r + b.r); }
  friend Residue operator-(Residue a, Residue b) { return of(a.r + (P - b.r)); }
  friend Residue operator*(Residue a, Residue b) {
    wide product = wide(a.r) * b.r;
    return of(uint64_t(product & P) + uint64_t(product >> 61));
  }

  bool is_zero() const { return r == 0; }
  uint64_t value() const { return r; }

  // a^(p - 2), by Fermat.
  Residue inverse() const {
    Residue power = *this, inverse(1);
    for (uint64_t exponent = P - 2; exponent; exponent >>= 1) {
      if (exponent & 1)
        inverse = inverse * power;
      power = power * power;
    }
    return inverse;
  }
};

} // namespace

uint64_t hsr_plane_residue(struct hsr_loop face) {
  Plane<Residue> plane = newell_plane<Residue>(face);
  const Vector<Residue> &n = plane.normal;
  Residue pivot = !n.x.is_zero() ? n.x : !n.y.is_zero() ? n.y : n.z;
  if (pivot.is_zero())
    return 0;

  /* All coefficients are divided by k times the pivot. A polynomial of the
   * quotients, at a fixed point, makes one number of them. */
  const Residue at(0x1.3c6ef372fe94fp60), per = (plane.k * pivot).inverse();
  const Residue per_pivot = per * plane.k;
  Residue all = n.x * per_pivot;
  all = all * at + n.y * per_pivot;
  all = all * at + n.z * per_pivot;
  all = all * at + plane.offset * per;
  return all.is_zero() ? 1 : all.value();
}
