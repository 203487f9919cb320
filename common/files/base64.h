// SPDX-License-Identifier: GPL-3.0-or-later
// Base64, a group of four digits at a time.
//
// Source      RFC 4648, section 4
#ifndef HSR_COMMON_FILES_BASE64_H
#define HSR_COMMON_FILES_BASE64_H

#include <array>
#include <cstddef>
#include <cstdint>

namespace hsr {

constexpr unsigned char BASE64_NO_DIGIT = 64;

constexpr std::array<unsigned char, 256> base64_values() {
  const char digits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<unsigned char, 256> values{};
  for (unsigned char &value : values)
    value = BASE64_NO_DIGIT;
  for (unsigned char k = 0; k < BASE64_NO_DIGIT; k++)
    values[static_cast<unsigned char>(digits[k])] = k;
  return values;
}

/* Decodes four digits into three bytes or, where '=' takes the place of the
 * last digits, into two or one. Returns how many there are; 0 if a digit is
 * none. All of bytes[] is written unless it is 0. */
inline size_t base64_decode(const char digits[4], unsigned char bytes[3]) {
  static constexpr std::array<unsigned char, 256> VALUES = base64_values();
  const size_t n = digits[3] != '=' ? 4 : digits[2] != '=' ? 3 : 2;
  uint32_t bits = 0;
  for (size_t k = 0; k < n; k++) {
    const unsigned char value = VALUES[static_cast<unsigned char>(digits[k])];
    if (value == BASE64_NO_DIGIT)
      return 0;
    bits |= uint32_t{value} << (18 - 6 * k);
  }
  for (size_t k = 0; k < 3; k++)
    bytes[k] = static_cast<unsigned char>(bits >> (16 - 8 * k));
  return n - 1;
}

} // namespace hsr

#endif
