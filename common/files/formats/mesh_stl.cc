// SPDX-License-Identifier: GPL-3.0-or-later
// Reads .stl files, binary and text.
//
// Source      3D Systems, "StereoLithography Interface Specification"
// Colours     the last two bytes of a facet, in one of two ways. Magics writes
//             "COLOR=" into the header, and behind it the colour of all facets
//             in four bytes, red, green, blue and alpha. Facets whose highest
//             bit is 0 have their own: 5 bits each of blue, green, red, the
//             highest first. VisCAM and others write no such header. The highest
//             bit is 1 where a facet has a colour: red, green, blue.
// Departures  of a text, keywords in any case, and several solids. Bytes after
//             the last facet are passed over, with a note.
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

size_t binary_size(const Mesh_file &file) {
  return HEADER + COUNT + TRIANGLE * binary_facets(file);
}

/* Five bits of a colour, from bit `first` on, encoded as 0..1. */
float five_bits(unsigned bits, unsigned first) {
  return static_cast<float>(bits >> first & 31) / 31;
}

/* Where the header has the colour of all facets, in four bytes; NULL: nowhere. */
const char *find_common_colour(const Mesh_file &file) {
  constexpr Word COLOUR = "COLOR=";
  const size_t at = Word(file.begin, HEADER).find(COLOUR);
  return at <= HEADER - COLOUR.size() - 4 ? file.begin + at + COLOUR.size()
                                          : nullptr;
}

/* The last two bytes of a facet. */
unsigned bits_of(const Mesh_file &file, uint32_t facet) {
  const char *at = file.begin + HEADER + COUNT + TRIANGLE * facet + TRIANGLE;
  return little_endian(at - 4) >> 16;
}

/* The first facet from `from` with any of these bits, or `to`. */
uint32_t find_bits(void *context, uint32_t from, uint32_t to) {
  const Mesh_file &file = *static_cast<const Mesh_file *>(context);
  while (from < to && !bits_of(file, from))
    from++;
  return from;
}

/* The colours of n facets; none, if the file has none. */
std::vector<Rgba> colours_of(Mesh_file &file, uint32_t n, int threads) {
  const char *const common = find_common_colour(file);
  const unsigned red = common ? 0 : 10, blue = common ? 10 : 0;
  Rgba all{0, 0, 0, NO_OPACITY};
  for (size_t k = 0; k < 4 && common; k++)
    all[k] = static_cast<float>(static_cast<unsigned char>(common[k])) / 255;
  if (common)
    all = rgba_of_file(all);
  /* Where no facet has any bit, none has a colour of its own. */
  const bool have_own =
      hsr_share_search(threads, n, RANGE, find_bits, &file) < n;
  std::vector<Rgba> looks;
  for (uint32_t f = 0; f < n && (common || have_own); f++) {
    const unsigned bits = bits_of(file, f);
    const bool has_own = have_own && (bits >> 15) != (common ? 1u : 0u);
    looks.push_back(
        has_own ? rgba_of_file({five_bits(bits, red), five_bits(bits, 5),
                                five_bits(bits, blue), NO_OPACITY})
                : all);
  }
  const bool any = std::any_of(looks.begin(), looks.end(), [](const Rgba &c) {
    return c[3] != NO_OPACITY;
  });
  return any ? looks : std::vector<Rgba>();
}

void read_binary(Mesh_file &file, Mesh_builder &builder) {
  const size_t n = binary_facets(file);
  if (n > static_cast<size_t>(MOST_ELEMENTS))
    file.refuse(0, "%zu facets are more than can be read", n);
  char *const first = file.begin + HEADER + COUNT + NORMAL;
  const uint32_t finite = hsr_share_search(builder.threads(), uint32_t(n),
                                           RANGE, find_infinite, first);
  builder.reserve(0, finite);
  const std::vector<Rgba> looks = colours_of(file, finite, builder.threads());
  give_loose_triangles<float>({first, TRIANGLE, finite},
                              looks.empty() ? nullptr : &looks, builder);
  if (finite < n)
    file.refuse(0, "facet %u has a coordinate that is not finite", finite);
  if (!looks.empty())
    builder.note(find_common_colour(file)
                     ? "colours are read as Magics writes them"
                     : "colours are read as VisCAM writes them");
  const size_t left = file.size() - binary_size(file);
  if (left)
    builder.note(std::to_string(left) + (left > 1 ? " bytes" : " byte") +
                 " after the last facet passed over");
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
                               nullptr, builder);
}

bool starts_as_text(const Mesh_file &file) {
  constexpr Word SOLID = "solid";
  const char *at = std::find_if_not(
      file.begin, file.end, [](unsigned char c) { return std::isspace(c); });
  return static_cast<size_t>(file.end - at) >= SOLID.size() &&
         is_keyword(Word(at, SOLID.size()), SOLID);
}

bool has_zero(const Mesh_file &file) {
  const size_t n = std::min(file.size(), HEADER + COUNT + TRIANGLE);
  return std::memchr(file.begin, '\0', n);
}

/* Whether the text is UTF-16, whose bytes may be 0. */
bool is_wide(const Mesh_file &file) {
  return file.begin[0] == '\xff' || file.begin[0] == '\xfe';
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
              "is no STL: it is no text that starts with 'solid', and %zu "
              "binary facets take %zu bytes, not %zu",
              n, binary_size(file), file.size());
}

/* Whether it is binary: its size is right, or at least enough, and it is no text,
 * though its header may begin with "solid". */
bool is_binary(const Mesh_file &file) {
  return file.size() == binary_size(file) ||
         (binary_facets(file) && file.size() > binary_size(file) &&
          !is_wide(file) && has_zero(file));
}

} // namespace

void stl_read(Mesh_file &file, Mesh_builder &builder) {
  if (is_binary(file))
    return read_binary(file, builder);
  if (has_zero(file) && !is_wide(file))
    refuse_any(file);
  make_plain_text(file);
  if (!starts_as_text(file))
    refuse_any(file);
  read_text(file, builder);
}

} // namespace hsr
