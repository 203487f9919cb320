// SPDX-License-Identifier: GPL-3.0-or-later
// Random numbers for tests in C++: splitmix64, begun anew by setting `state`.
#ifndef HSR_TESTS_PROPERTIES_SPLITMIX64_H
#define HSR_TESTS_PROPERTIES_SPLITMIX64_H

#include <cstdint>

inline uint64_t state = 1;

inline uint64_t bits() {
  uint64_t z = state += 0x9e3779b97f4a7c15u;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
  z = (z ^ z >> 27) * 0x94d049bb133111ebu;
  return z ^ z >> 31;
}
inline int integer(int lo, int hi) {
  return lo + int(bits() % uint64_t(hi - lo + 1));
}
inline double real(double lo, double hi) {
  return lo + (hi - lo) * (double(bits() >> 11) * 0x1p-53);
}

#endif
