/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Changes of a file that keep most of its form, since a plain reader takes none
 * that is out of shape. */
#ifndef HSR_TESTS_FUZZ_MUTATE_TEXT_H
#define HSR_TESTS_FUZZ_MUTATE_TEXT_H

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>

extern "C" size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t most);

struct Text_part {
  size_t from, to;
};

/* A part of a text between two of the separators, or its ends. */
inline Text_part fuzz_part(const std::string &text, const char *separators,
                           std::minstd_rand &random) {
  const size_t at = random() % text.size();
  const size_t before = text.find_last_of(separators, at);
  const size_t from = before == std::string::npos ? 0 : before + 1;
  const size_t to = std::min(text.find_first_of(separators, from), text.size());
  return {from, std::max(from, to)};
}

/* A number takes the place of another, if one is found soon. */
inline void fuzz_replace_number(std::string &text, std::minstd_rand &random) {
  static const char *const words[] = {"0",   "1",     "-1",   "2",  "3",
                                      "-0",  "+1",    ".5",   "4/", "1//2",
                                      "1e0", "1e400", "1e-9", "-2", "5/1/1"};
  for (int tries = 0; tries < 9; tries++) {
    const Text_part part = fuzz_part(text, " \n", random);
    if (!std::strchr("0123456789+-.", text[part.from]))
      continue;
    text.replace(part.from, part.to - part.from,
                 words[random() % (sizeof words / sizeof *words)]);
    return;
  }
}

/* Seven lines, as a facet has, are copied before others. */
inline void fuzz_copy_lines(std::string &text, std::minstd_rand &random) {
  const size_t from = fuzz_part(text, "\n", random).from;
  const size_t place = fuzz_part(text, "\n", random).from;
  size_t to = from;
  for (int k = 0; k < 7 && to < text.size(); k++)
    to = std::min(text.find('\n', to), text.size() - 1) + 1;
  text.insert(place, text.substr(from, to - from));
}

/* A word, or line, is copied to the place of another, or before it; or it goes. */
inline void fuzz_move_part(std::string &text, const char *separators,
                           std::minstd_rand &random) {
  const Text_part from = fuzz_part(text, separators, random);
  const Text_part to = fuzz_part(text, separators, random);
  const std::string word = text.substr(from.from, from.to - from.from);
  switch (random() % 3) {
  case 0:
    text.replace(to.from, to.to - to.from, word);
    break;
  case 1:
    text.insert(to.from, word + separators[0]);
    break;
  default:
    text.erase(to.from, to.to + 1 - to.from);
  }
}

/* Some bytes change; how many there are does not. Most are in the last third, where
 * a binary file has no header. */
inline void fuzz_replace_bytes(std::string &text, std::minstd_rand &random) {
  const size_t n_last = random() % 4 ? text.size() / 3 + 1 : text.size();
  const size_t from = text.size() - 1 - random() % n_last;
  std::string bytes = text.substr(from, 1 + random() % 12);
  const size_t n = bytes.size();
  bytes.resize(LLVMFuzzerMutate(reinterpret_cast<uint8_t *>(&bytes[0]), n, n));
  bytes.resize(n, '\0');
  text.replace(from, n, bytes);
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size,
                                          size_t most, unsigned seed) {
  std::minstd_rand random(seed);
  std::string text(reinterpret_cast<const char *>(data), size);
  if (!size || random() % 8 == 0)
    return LLVMFuzzerMutate(data, size, most);
  switch (random() % 8) {
  case 0:
    fuzz_copy_lines(text, random);
    break;
  case 1:
    fuzz_move_part(text, " \n", random);
    break;
  case 2:
    fuzz_move_part(text, "\n", random);
    break;
  case 3:
  case 4:
    fuzz_replace_bytes(text, random);
    break;
  default:
    fuzz_replace_number(text, random);
  }
  size = std::min(text.size(), most);
  std::memcpy(data, text.data(), size);
  return size;
}

#endif
