// SPDX-License-Identifier: GPL-3.0-or-later
// The grammar of .stl files that are texts; mesh_stl.cc has the binary ones.
//
// Source      3D Systems, "StereoLithography Interface Specification"
// Departures  keywords in any case; several solids in a file.
#include "common/files/mesh/mesh_text.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <utility>

namespace hsr {
namespace {

/* Whether a word is a keyword in any case; if so, it is put in lower case. */
bool is_keyword(Word word, const char *keyword) {
  if (word.size() != std::strlen(keyword))
    return false;
  for (size_t i = 0; i < word.size(); i++)
    if (std::tolower(static_cast<unsigned char>(word[i])) != keyword[i])
      return false;
  std::memcpy(const_cast<char *>(word.data()), keyword, word.size());
  return true;
}

class Text_stl_scan {
public:
  explicit Text_stl_scan(Mesh_file &file) : lines_(file, {0, false}) {}
  Mesh_extent scan();

private:
  Word next();
  void expect(const char *keyword);
  void solid();
  void facet();
  void normal();

  Lines lines_;
  Mesh_extent extent_;
};

Word Text_stl_scan::next() {
  const Word word = lines_.word_of_any_line();
  if (word.empty())
    lines_.refuse("the file ends in facet %zu", extent_.n_faces);
  return word;
}

void Text_stl_scan::expect(const char *keyword) {
  const Word word = next();
  if (!is_keyword(word, keyword))
    lines_.refuse("facet %zu: '%s' where '%s' should be", extent_.n_faces,
                  shown_word(word).c_str(), keyword);
}

/* A normal is not used, and may be anything: some programs write "nan". */
void Text_stl_scan::normal() {
  for (int k = 0; k < 3; k++) {
    const Word word = next();
    if (Word("+-.0123456789nNiI").find(word[0]) == Word::npos)
      lines_.refuse("facet %zu: '%s' is not a number", extent_.n_faces,
                    shown_word(word).c_str());
    Lines::blank(word);
  }
}

void Text_stl_scan::facet() {
  expect("normal");
  normal();
  expect("outer");
  expect("loop");
  for (int k = 0; k < 3; k++) {
    expect("vertex");
    for (int d = 0; d < 3; d++)
      lines_.real(next(), "facet", extent_.n_faces);
  }
  expect("endloop");
  expect("endfacet");
  extent_.n_faces++;
}

/* After the word "solid". Names are blanked, since they may hold keywords. */
void Text_stl_scan::solid() {
  lines_.blank_rest();
  for (;;) {
    const Word word = lines_.word_of_any_line();
    if (word.empty())
      lines_.refuse("the file ends before 'endsolid', after %zu facets",
                    extent_.n_faces);
    if (is_keyword(word, "endsolid"))
      break;
    if (!is_keyword(word, "facet"))
      lines_.refuse("'%s' where 'facet' or 'endsolid' should be",
                    shown_word(word).c_str());
    facet();
  }
  lines_.blank_rest();
}

Mesh_extent Text_stl_scan::scan() {
  for (Word word = lines_.word_of_any_line(); !word.empty();
       word = lines_.word_of_any_line()) {
    if (!is_keyword(word, "solid"))
      lines_.refuse("'%s' where 'solid' should be", shown_word(word).c_str());
    solid();
  }
  extent_.n_corners = 3 * extent_.n_faces;
  return std::move(extent_);
}

bool starts_as_text(const Mesh_file &file) {
  const Word solid("solid");
  const char *at = std::find_if_not(
      file.begin, file.end, [](unsigned char c) { return std::isspace(c); });
  return static_cast<size_t>(file.end - at) >= solid.size() &&
         std::equal(solid.begin(), solid.end(), at, [](char a, char b) {
           return a == std::tolower(static_cast<unsigned char>(b));
         });
}

} // namespace

Mesh_extent scan_stl(Mesh_file &file) {
  skip_byte_order_mark(file);
  if (!starts_as_text(file))
    refuse_stl(file);
  Mesh_extent extent = Text_stl_scan(file).scan();
  if (extent.n_faces > static_cast<size_t>(MOST_ELEMENTS))
    file.refuse(0, "%zu facets are more than can be read", extent.n_faces);
  return extent;
}

} // namespace hsr
