// SPDX-License-Identifier: GPL-3.0-or-later
// Reads .off files.
//
// Source      Geomview manual, "OFF: Object File Format"
// Departures  one vertex or face a line, a header word, and neither the binary
//             form nor other dimensions than 3, as in CGAL's reader.
// Cost        most lines of a large file are plain and are read at once
#include "common/files/mesh/mesh_text.h"
#include "common/files/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace hsr {
namespace {

class Off_reader {
public:
  Off_reader(Mesh_file &file, bool drop, Mesh_builder &builder)
      : file_(file), lines_(file, {'#', false}), checker_(drop),
        builder_(builder) {}
  void read();

private:
  void keyword();
  void header();
  size_t count(Word word, const char *what) const;
  void vertex(size_t v);
  bool plain_vertex();
  void face(size_t f);
  bool plain_face(size_t f);
  void corner(size_t f, long long v);
  void add_face(size_t f, const float *rgb);
  bool colour(size_t f, float rgb[3]);

  Mesh_file &file_;
  Lines lines_;
  Face_checker checker_;
  Mesh_builder &builder_;
  size_t n_vertices_ = 0, n_faces_ = 0;
  std::vector<uint32_t> corners_; /* of the face at hand */
  bool has_texture_ = false, has_colour_ = false, has_normal_ = false;
  bool homogeneous_ = false;
  bool all_coloured_ = true;
};

/* [ST][C][N][4]OFF */
void Off_reader::keyword() {
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

size_t Off_reader::count(Word word, const char *what) const {
  long long n;
  if (!read_integer(word, n) || n < 0)
    lines_.refuse("'%s' is not a number of %s", shown_word(word).c_str(), what);
  if (n > MOST_ELEMENTS)
    lines_.refuse("%lld %s are more than can be read", n, what);
  return static_cast<size_t>(n);
}

void Off_reader::header() {
  if (!lines_.next_line())
    file_.refuse(0, "holds nothing but white space and comments");
  keyword();
  const Word first = lines_.word_of_any_line();
  if (first.empty())
    lines_.refuse("the file ends before the number of vertices");
  if (first == "BINARY")
    lines_.refuse("binary OFF is not read");
  n_vertices_ = count(first, "vertices");
  n_faces_ = count(lines_.word(), "faces");
  const Word edges = lines_.word();
  if (!edges.empty())
    count(edges, "edges");
  if (!lines_.word().empty())
    lines_.refuse("the header has more than three numbers");
  /* The shortest vertex is "0 0 0", the shortest face "0". */
  const size_t left = static_cast<size_t>(file_.end - lines_.rest_of_file());
  if (6 * n_vertices_ + 2 * n_faces_ > left + 1)
    lines_.refuse("%zu vertices and %zu faces are claimed, more than the %zu "
                  "bytes that follow can hold",
                  n_vertices_, n_faces_, left);
}

/* Three coordinates and nothing else. */
bool Off_reader::plain_vertex() {
  double at[3];
  if (homogeneous_ || has_normal_ || has_texture_ ||
      !lines_.next_plain_line(at, 3))
    return false;
  builder_.vertex(at[0], at[1], at[2]);
  return true;
}

void Off_reader::vertex(size_t v) {
  if (plain_vertex())
    return;
  if (!lines_.next_line())
    lines_.refuse("the file ends after %zu of %zu vertices", v, n_vertices_);
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
  for (size_t k = 0; k < 3; k++) {
    coordinate[k] /= coordinate[3];
    if (!std::isfinite(coordinate[k]))
      lines_.refuse("vertex %zu divided by its w is not finite", v);
  }
  builder_.vertex(coordinate[0], coordinate[1], coordinate[2]);
}

void Off_reader::corner(size_t f, long long v) {
  if (v < 0 || v >= static_cast<long long>(n_vertices_))
    lines_.refuse("face %zu names vertex %lld of %zu", f, v, n_vertices_);
  checker_.add(static_cast<size_t>(v));
  corners_.push_back(static_cast<uint32_t>(v));
}

void Off_reader::add_face(size_t f, const float *rgb) {
  if (const char *fault = checker_.fault())
    lines_.refuse("face %zu %s", f, fault);
  builder_.face(corners_.data(), corners_.size(), rgb);
}

/* Vertex numbers and nothing else: so it has no colour. */
bool Off_reader::plain_face(size_t f) {
  enum { MOST = 8 };
  uint32_t vertex[MOST];
  size_t n;
  if (!lines_.next_plain_list(vertex, n, MOST))
    return false;
  for (size_t k = 0; k < n; k++)
    corner(f, vertex[k]);
  add_face(f, nullptr);
  return true;
}

void Off_reader::face(size_t f) {
  checker_.start();
  corners_.clear();
  if (!all_coloured_ && plain_face(f))
    return;
  if (!lines_.next_line())
    lines_.refuse("the file ends after %zu of %zu faces", f, n_faces_);
  const Word first = lines_.word();
  long long n;
  if (!read_integer(first, n) || n < 0)
    lines_.refuse("face %zu: '%s' is not a number of vertices", f,
                  shown_word(first).c_str());
  for (long long k = 0; k < n; k++) {
    const Word word = lines_.word();
    if (word.empty())
      lines_.refuse("face %zu has %lld vertices, not %lld", f, k, n);
    long long v;
    if (!read_integer(word, v))
      lines_.refuse("face %zu: '%s' is not a vertex number", f,
                    shown_word(word).c_str());
    corner(f, v);
  }
  float rgb[3];
  const bool coloured = colour(f, rgb);
  if (all_coloured_ && !coloured)
    builder_.forget_colours();
  all_coloured_ = all_coloured_ && coloured;
  add_face(f, all_coloured_ ? rgb : nullptr);
}

/* Three or four numbers, 0..255 if all are integers, else 0..1; one number is
 * an index into a map that is not part of the file. Colours are kept if all
 * faces have one. */
bool Off_reader::colour(size_t f, float rgb[3]) {
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
  for (size_t k = 0; k < 3; k++) {
    const double encoded = value[k] / (integers ? 255 : 1);
    rgb[k] = hsr_srgb_decode(
        static_cast<float>(std::min(std::max(encoded, 0.0), 1.0)));
  }
  return n >= 3;
}

void Off_reader::read() {
  header();
  builder_.reserve(n_vertices_, n_faces_);
  if (builder_.threads() > 1 && !homogeneous_ && !has_normal_ &&
      !has_texture_ &&
      off_read_plain(lines_.rest_of_file(), file_.end, n_vertices_, n_faces_,
                     builder_))
    return;
  for (size_t v = 0; v < n_vertices_; v++)
    vertex(v);
  for (size_t f = 0; f < n_faces_; f++)
    face(f);
  if (lines_.next_line())
    lines_.refuse("the file goes on after the last of %zu faces", n_faces_);
}

} // namespace

void off_read(Mesh_file &file, bool drop, Mesh_builder &builder) {
  skip_byte_order_mark(file);
  Off_reader(file, drop, builder).read();
}

} // namespace hsr
