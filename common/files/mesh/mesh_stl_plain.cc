// SPDX-License-Identifier: GPL-3.0-or-later
// Reads .stl files that are texts, by several threads, if each facet begins a line
// and nothing is wrong.
//
// Method      the text is cut into blocks, before facets. First, the facets of each
//             block are counted, so each knows the number of its first. Then all
//             blocks are read at once; each but the last has to end within a solid.
//             mesh_corners.cc finds which corners are one vertex.
// Same        whether a file is so does not depend on the blocks. One that is not
//             is read by mesh_scan_stl.cc, which can say what is wrong.
// Memory      72 bytes a facet, which takes more in the file
#include "common/base/arena.h"
#include "common/files/mesh/mesh_blocks.h"
#include "common/files/mesh/mesh_corners.h"
#include "common/files/mesh/mesh_text.h"

#include <cctype>

namespace hsr {
namespace {

constexpr size_t NUMBERS = 9; /* of a facet */

/* Whether a word is a keyword, which is in lower case. */
bool is_keyword(Word word, Word keyword) {
  return word.size() == keyword.size() &&
         std::equal(
             word.begin(), word.end(), keyword.begin(),
             [](unsigned char a, char b) { return std::tolower(a) == b; });
}

/* The words of a text; white space and ends of lines are between them. */
class Words {
public:
  Words(const char *begin, const char *end) : at_(begin), end_(end) {}

  /* The next word; empty: there is none. */
  Word next() {
    const auto is_between = [](char c) { return is_space(c) || c == '\n'; };
    const char *start = std::find_if_not(at_, end_, is_between);
    at_ = std::find_if(start, end_, is_between);
    return Word(start, static_cast<size_t>(at_ - start));
  }
  bool next_is(Word keyword) { return is_keyword(next(), keyword); }
  void pass_line() { at_ = std::find(at_, end_, '\n'); }

private:
  const char *at_, *end_;
};

bool begins_facet(const char *line, const char *end) {
  return is_keyword(Words(line, std::find(line, end, '\n')).next(), "facet");
}

struct Block {
  const char *begin, *end;
  bool is_first = false, is_last = false;
  size_t n_facets = 0, first_facet = 0;
};

bool count(Block &block) {
  for (const char *at = block.begin; at < block.end;) {
    block.n_facets += begins_facet(at, block.end);
    at = std::find(at, block.end, '\n');
    at += at < block.end;
  }
  return true;
}

/* A normal is not used, and may be anything (mesh_scan_stl.cc). */
bool pass_normal(Words &words) {
  for (int k = 0; k < 3; k++) {
    const Word word = words.next();
    if (word.empty() || Word("+-.0123456789nNiI").find(word[0]) == Word::npos)
      return false;
  }
  return true;
}

bool read_corner(Words &words, double *number) {
  if (!words.next_is("vertex"))
    return false;
  for (int k = 0; k < 3; k++) {
    const Word word = words.next();
    const char *const end = word.data() + word.size();
    const auto result = std::from_chars(word.data(), end, number[k]);
    if (result.ec != std::errc() || result.ptr != end ||
        !std::isfinite(number[k]))
      return false;
  }
  return true;
}

/* What follows the word "facet". */
bool read_facet(Words &words, double *number) {
  return words.next_is("normal") && pass_normal(words) &&
         words.next_is("outer") && words.next_is("loop") &&
         read_corner(words, number) && read_corner(words, number + 3) &&
         read_corner(words, number + 6) && words.next_is("endloop") &&
         words.next_is("endfacet");
}

bool read_block(const Block &block, double *number) {
  Words words(block.begin, block.end);
  bool in_solid = !block.is_first;
  size_t n = 0;
  for (Word word = words.next(); !word.empty(); word = words.next()) {
    if (in_solid && is_keyword(word, "facet")) {
      if (n == block.n_facets || !read_facet(words, number + NUMBERS * n++))
        return false;
    } else if (is_keyword(word, in_solid ? "endsolid" : "solid")) {
      in_solid = !in_solid;
      words.pass_line();
    } else {
      return false;
    }
  }
  return n == block.n_facets && in_solid == !block.is_last;
}

/* Numbers the facets of blocks in order; how many there are. */
size_t number_facets(std::vector<Block> &blocks) {
  size_t n = 0;
  for (Block &block : blocks) {
    block.first_facet = n;
    n += block.n_facets;
  }
  return n;
}

} // namespace

bool text_stl_read_plain(const Mesh_file &file, Mesh_builder &builder) {
  Mesh_file text{file.path, nullptr, file.begin, file.end};
  skip_byte_order_mark(text);
  std::vector<Block> blocks =
      cut_text<Block>(text.begin, text.end, begins_facet);
  if (blocks.empty())
    return false;
  blocks.front().is_first = blocks.back().is_last = true;
  share_blocks(builder.threads(), blocks, count);
  const size_t n = number_facets(blocks);
  if (!n || n > static_cast<size_t>(MOST_ELEMENTS))
    return false;
  const std::unique_ptr<double[]> number(new double[NUMBERS * n]);
  hsr_huge_pages(number.get(), NUMBERS * n * sizeof(double));
  if (!share_blocks(builder.threads(), blocks, [&number](Block &block) {
        return read_block(block, number.get() + NUMBERS * block.first_facet);
      }))
    return false;
  builder.reserve(0, n);
  give_loose_triangles<double>({reinterpret_cast<const char *>(number.get()),
                                NUMBERS * sizeof(double), n},
                               builder);
  return true;
}

} // namespace hsr
