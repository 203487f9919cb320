// SPDX-License-Identifier: GPL-3.0-or-later
// Reads .stl files, binary and text.
//
// Source      3D Systems, "StereoLithography Interface Specification"
// Departures  of a text, keywords in any case, and several solids.
// Vertices    a file has no vertex numbers; mesh_corners.cc finds which corners
//             are one vertex
// Method      a text is cut into blocks before lines that begin a facet, which
//             can stand only in a solid. A block is read up to the first facet
//             of the next, and goes on if it is not in a solid, between facets:
//             so it finds what is wrong.
// Memory      of a text, 72 bytes a facet, which takes more in the file; twice,
//             if several threads read
#include "common/base/arena.h"
#include "common/base/share.h"
#include "common/files/mesh/mesh_blocks.h"
#include "common/files/mesh/mesh_corners.h"
#include "common/files/mesh/mesh_text.h"

#include <algorithm>
#include <cctype>
#include <cstring>

namespace hsr {
namespace {

/* ---- Binary ---- */

constexpr size_t HEADER = 80, COUNT = 4, TRIANGLE = 50, NORMAL = 12;
constexpr uint32_t RANGE = 16384; /* facets for a thread at a time */

uint32_t little_endian(const char *bytes) {
  unsigned char byte[4];
  std::memcpy(byte, bytes, sizeof byte);
  return uint32_t{byte[0]} | uint32_t{byte[1]} << 8 | uint32_t{byte[2]} << 16 |
         uint32_t{byte[3]} << 24;
}

/* The first facet from `from` that is not finite, or `to`. */
uint32_t find_infinite(void *context, uint32_t from, uint32_t to) {
  const char *const first = static_cast<const char *>(context);
  for (uint32_t f = from; f < to; f++)
    for (size_t k = 0; k < 9; k++) {
      constexpr uint32_t EXPONENT = 0x7f800000;
      const char *at = first + TRIANGLE * f + 4 * k;
      if ((little_endian(at) & EXPONENT) == EXPONENT)
        return f;
    }
  return to;
}

/* How many facets a binary file claims, by its header. */
size_t binary_facets(const Mesh_file &file) {
  return file.size() < HEADER + COUNT ? 0 : little_endian(file.begin + HEADER);
}

void read_binary(const Mesh_file &file, Mesh_builder &builder) {
  const size_t n = binary_facets(file);
  if (n > static_cast<size_t>(MOST_ELEMENTS))
    file.refuse(0, "%zu facets are more than can be read", n);
  char *const first = file.begin + HEADER + COUNT + NORMAL;
  const uint32_t finite = hsr_share_search(builder.threads(), uint32_t(n),
                                           RANGE, find_infinite, first);
  builder.reserve(0, finite);
  give_loose_triangles<float>({first, TRIANGLE, finite}, builder);
  if (finite < n)
    file.refuse(0, "facet %u has a coordinate that is not finite", finite);
}

/* ---- Text ---- */

constexpr Text_style STYLE = {0, false};
constexpr size_t NUMBERS = 9; /* of a facet */
constexpr Word SHORTEST = "facet normal 0 0 0 outer loop vertex 0 0 0 "
                          "vertex 0 0 0 vertex 0 0 0 endloop endfacet ";

/* Whether a word is a keyword, which is in lower case. */
bool is_keyword(Word word, Word keyword) {
  return word.size() == keyword.size() &&
         std::equal(
             word.begin(), word.end(), keyword.begin(),
             [](unsigned char a, char b) { return std::tolower(a) == b; });
}

/* Whether a line, which ends before `end`, begins with a facet. */
bool begins_facet(const char *line, const char *end) {
  constexpr Word FACET = "facet";
  const char *at = past_spaces(line, end), *stop = at + FACET.size();
  return static_cast<size_t>(end - at) >= FACET.size() &&
         is_keyword(Word(at, FACET.size()), FACET) &&
         (stop == end || is_space(*stop) || *stop == '\n');
}

struct Block {
  const char *begin, *end;
  std::vector<double> numbers; /* of its facets */
};

class Block_reader {
public:
  Block_reader(const Mesh_file &file, Block &block)
      : file_(file), text_(file, STYLE, block.begin, file.end), block_(block) {}
  void read();

private:
  size_t number() const { return block_.numbers.size() / NUMBERS; }
  void next();
  void expect(Word keyword);
  void facet();
  void normal();

  const Mesh_file &file_;
  Text text_;
  Block &block_;
};

/* Goes to the next word, of a facet. */
void Block_reader::next() {
  if (!text_.more_in_text())
    text_.refuse("the file ends in facet %zu", number());
}

void Block_reader::expect(Word keyword) {
  next();
  const Word word = text_.word();
  if (!is_keyword(word, keyword))
    text_.refuse("facet %zu: '%s' where '%s' should be", number(),
                 shown_word(word).c_str(), keyword.data());
}

/* A normal is not used, and may be anything: some programs write "nan". */
void Block_reader::normal() {
  for (int k = 0; k < 3; k++) {
    next();
    const Word word = text_.word();
    if (Word("+-.0123456789nNiI").find(word[0]) == Word::npos)
      text_.refuse("facet %zu: '%s' is not a number", number(),
                   shown_word(word).c_str());
  }
}

void Block_reader::facet() {
  double value[NUMBERS];
  expect("normal");
  normal();
  expect("outer");
  expect("loop");
  for (size_t k = 0; k < NUMBERS; k++) {
    if (k % 3 == 0)
      expect("vertex");
    next();
    value[k] = text_.real("facet", number());
  }
  expect("endloop");
  expect("endfacet");
  block_.numbers.insert(block_.numbers.end(), value, value + NUMBERS);
}

/* What follows "solid" and "endsolid" is a name, which may be any words. */
void Block_reader::read() {
  bool in_solid = block_.begin != file_.begin;
  const size_t size = static_cast<size_t>(block_.end - block_.begin);
  block_.numbers.reserve(NUMBERS * (size / SHORTEST.size() + 1));
  while (text_.more_in_text()) {
    if (in_solid && text_.at() >= block_.end)
      return;
    const Word word = text_.word();
    if (in_solid && is_keyword(word, "facet")) {
      facet();
    } else if (is_keyword(word, in_solid ? "endsolid" : "solid")) {
      in_solid = !in_solid;
      text_.rest();
    } else {
      text_.refuse("'%s' where %s should be", shown_word(word).c_str(),
                   in_solid ? "'facet' or 'endsolid'" : "'solid'");
    }
  }
  if (in_solid)
    text_.refuse("the file ends before 'endsolid', after %zu facets", number());
}

void read_text(const Mesh_file &file, Mesh_builder &builder) {
  std::vector<Block> blocks = read_blocks<Block>(
      builder.threads(), file.begin, file.end, begins_facet,
      [](std::vector<Block> &) { return true; },
      [&file](Block &block) { Block_reader(file, block).read(); });
  size_t size = 0;
  for (const Block &block : blocks)
    size += block.numbers.size();
  std::vector<double> &numbers = blocks[0].numbers;
  numbers.reserve(size);
  for (size_t k = 1; k < blocks.size(); k++) {
    numbers.insert(numbers.end(), blocks[k].numbers.begin(),
                   blocks[k].numbers.end());
    blocks[k].numbers = {};
  }
  const size_t n = numbers.size() / NUMBERS;
  if (n > static_cast<size_t>(MOST_ELEMENTS))
    file.refuse(0, "%zu facets are more than can be read", n);
  builder.reserve(0, n);
  give_loose_triangles<double>({reinterpret_cast<const char *>(numbers.data()),
                                NUMBERS * sizeof(double), n},
                               builder);
}

bool starts_as_text(const Mesh_file &file) {
  constexpr Word SOLID = "solid";
  const char *at = std::find_if_not(
      file.begin, file.end, [](unsigned char c) { return std::isspace(c); });
  return static_cast<size_t>(file.end - at) >= SOLID.size() &&
         is_keyword(Word(at, SOLID.size()), SOLID);
}

/* Throws what is wrong with a file that is neither binary nor a text. */
[[noreturn]] void refuse_any(const Mesh_file &file) {
  if (file.size() < HEADER + COUNT)
    file.refuse(0,
                "is no STL: it neither starts with 'solid' nor has the %zu "
                "bytes of a binary header",
                HEADER + COUNT);
  const size_t n = binary_facets(file);
  file.refuse(0,
              "is no STL: it does not start with 'solid', and %zu binary "
              "facets take %zu bytes, not %zu",
              n, HEADER + COUNT + TRIANGLE * n, file.size());
}

} // namespace

void stl_read(Mesh_file &file, Mesh_builder &builder) {
  if (file.size() == HEADER + COUNT + TRIANGLE * binary_facets(file))
    return read_binary(file, builder);
  make_plain_text(file);
  if (!starts_as_text(file))
    refuse_any(file);
  read_text(file, builder);
}

} // namespace hsr
