// SPDX-License-Identifier: GPL-3.0-or-later
// The grammar of .off files.
//
// Source      Geomview manual, "OFF: Object File Format"
// Departures  as CGAL's reader has it, one vertex or face a line, a header
//             word, and neither the binary form nor other dimensions than 3.
#include "common/files/mesh/mesh_text.h"
#include "common/files/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <utility>

namespace hsr {
namespace {

class Off_scan {
public:
  Off_scan(Mesh_file &file, bool drop)
      : file_(file), lines_(file, {'#', false}), checker_(drop) {}
  Mesh_extent scan();

private:
  void keyword();
  void header();
  size_t count(Word word, const char *what) const;
  void vertex(size_t v);
  void face(size_t f);
  void colour(size_t f);
  void replace_header(char *data);

  Mesh_file &file_;
  Lines lines_;
  Face_checker checker_;
  Mesh_extent extent_;
  bool has_texture_ = false, has_colour_ = false, has_normal_ = false;
  bool homogeneous_ = false;
  bool all_coloured_ = true;
};

/* [ST][C][N][4]OFF */
void Off_scan::keyword() {
  const Word word = lines_.word();
  Word rest = word;
  const auto take = [&rest](Word prefix) {
    const bool there = rest.substr(0, prefix.size()) == prefix;
    if (there)
      rest.remove_prefix(prefix.size());
    return there;
  };
  has_texture_ = take("ST");
  has_colour_ = take("C");
  has_normal_ = take("N");
  homogeneous_ = take("4");
  if (rest == "nOFF")
    lines_.refuse("nOFF, of any number of dimensions, is not read");
  if (rest != "OFF")
    lines_.refuse("the file starts with '%s', not with OFF",
                  shown_word(word).c_str());
}

size_t Off_scan::count(Word word, const char *what) const {
  long long n;
  if (!read_integer(word, n) || n < 0)
    lines_.refuse("'%s' is not a number of %s", shown_word(word).c_str(), what);
  if (n > MOST_ELEMENTS)
    lines_.refuse("%lld %s are more than can be read", n, what);
  return static_cast<size_t>(n);
}

void Off_scan::header() {
  if (!lines_.next_line())
    file_.refuse(0, "holds nothing but white space and comments");
  keyword();
  const Word first = lines_.word_of_any_line();
  if (first.empty())
    lines_.refuse("the file ends before the number of vertices");
  if (first == "BINARY")
    lines_.refuse("binary OFF is not read");
  extent_.n_vertices = count(first, "vertices");
  extent_.n_faces = count(lines_.word(), "faces");
  const Word edges = lines_.word();
  if (!edges.empty())
    count(edges, "edges");
  if (!lines_.word().empty())
    lines_.refuse("the header has more than three numbers");
  /* The shortest vertex is "0 0 0", the shortest face "0". */
  const size_t left = static_cast<size_t>(file_.end - lines_.rest_of_file());
  if (6 * extent_.n_vertices + 2 * extent_.n_faces > left + 1)
    lines_.refuse("%zu vertices and %zu faces are claimed, more than the %zu "
                  "bytes that follow can hold",
                  extent_.n_vertices, extent_.n_faces, left);
}

void Off_scan::vertex(size_t v) {
  if (!lines_.next_line())
    lines_.refuse("the file ends after %zu of %zu vertices", v,
                  extent_.n_vertices);
  const size_t h = homogeneous_, dimension = 3 + h;
  std::array<double, 4> coordinate{0, 0, 0, 1};
  size_t n = 0;
  for (Word word = lines_.word(); !word.empty(); word = lines_.word(), n++) {
    const double value = lines_.real(word, "vertex", v);
    if (n < dimension)
      coordinate[n] = value;
  }
  const size_t least =
      dimension + (has_normal_ ? 3 + h : 0) + (has_texture_ ? 2 + h : 0);
  if (n != least && !(has_colour_ && n > least && n <= least + 4))
    lines_.refuse("vertex %zu has %zu numbers, not %zu", v, n, least);
  for (size_t k = 0; k < 3; k++)
    if (!std::isfinite(coordinate[k] / coordinate[3]))
      lines_.refuse("vertex %zu divided by its w is not finite", v);
}

void Off_scan::face(size_t f) {
  if (!lines_.next_line())
    lines_.refuse("the file ends after %zu of %zu faces", f, extent_.n_faces);
  const Word first = lines_.word();
  long long n;
  if (!read_integer(first, n) || n < 0)
    lines_.refuse("face %zu: '%s' is not a number of vertices", f,
                  shown_word(first).c_str());
  checker_.start();
  for (long long k = 0; k < n; k++) {
    const Word word = lines_.word();
    if (word.empty())
      lines_.refuse("face %zu has %lld vertices, not %lld", f, k, n);
    long long v;
    if (!read_integer(word, v))
      lines_.refuse("face %zu: '%s' is not a vertex number", f,
                    shown_word(word).c_str());
    if (v < 0 || v >= static_cast<long long>(extent_.n_vertices))
      lines_.refuse("face %zu names vertex %lld of %zu", f, v,
                    extent_.n_vertices);
    checker_.add(static_cast<size_t>(v));
  }
  if (const char *fault = checker_.fault())
    lines_.refuse("face %zu %s", f, fault);
  extent_.n_corners += static_cast<size_t>(n);
  colour(f);
}

/* Three or four numbers, 0..255 if all are integers, else 0..1; one number is
 * an index into a map that is not part of the file. Colours are kept if all
 * faces have one. */
void Off_scan::colour(size_t f) {
  std::array<double, 4> value{};
  size_t n = 0;
  bool integers = true;
  for (Word word = lines_.word(); !word.empty(); word = lines_.word(), n++) {
    const double number = lines_.real(word, "face", f);
    if (n < value.size())
      value[n] = number;
    long long integer;
    integers = integers && read_integer(word, integer);
  }
  if (n == 2 || n > value.size())
    lines_.refuse("face %zu has %zu numbers after its vertices, which are no "
                  "colour",
                  f, n);
  all_coloured_ = all_coloured_ && n >= 3;
  for (size_t k = 0; k < 3 && all_coloured_; k++) {
    const double encoded = value[k] / (integers ? 255 : 1);
    extent_.rgb.push_back(hsr_srgb_decode(
        static_cast<float>(std::min(std::max(encoded, 0.0), 1.0))));
  }
}

/* If the header says plain OFF, CGAL ignores what follows the coordinates of a
 * vertex and the vertices of a face. */
void Off_scan::replace_header(char *data) {
  char header[Mesh_file::SPARE];
  const int length = std::snprintf(header, sizeof header, "%sOFF\n%zu %zu 0\n",
                                   homogeneous_ ? "4" : "", extent_.n_vertices,
                                   extent_.n_faces);
  file_.begin = data - length;
  std::memcpy(file_.begin, header, static_cast<size_t>(length));
}

Mesh_extent Off_scan::scan() {
  header();
  char *data = lines_.rest_of_file();
  for (size_t v = 0; v < extent_.n_vertices; v++)
    vertex(v);
  for (size_t f = 0; f < extent_.n_faces; f++)
    face(f);
  if (lines_.next_line())
    lines_.refuse("the file goes on after the last of %zu faces",
                  extent_.n_faces);
  if (!all_coloured_)
    extent_.rgb.clear();
  replace_header(data);
  return std::move(extent_);
}

} // namespace

Mesh_extent scan_off(Mesh_file &file, bool drop) {
  skip_byte_order_mark(file);
  return Off_scan(file, drop).scan();
}

} // namespace hsr
