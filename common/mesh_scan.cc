// SPDX-License-Identifier: GPL-3.0-or-later
// The grammars of .off, .obj, .ply and .stl, checked from first to last byte.
//
// Source      OFF   Geomview manual, "OFF: Object File Format"
//             OBJ   Wavefront Advanced Visualizer manual, appendix B1
//             PLY   G. Turk, "The PLY Polygon File Format", 1994
//             STL   3D Systems, "StereoLithography Interface Specification"
// Departures  Each is what CGAL's reader cannot do: OFF has one vertex or face
//             a line, a header, and no binary form; PLY coordinates are float
//             or double, and face lists int or uint; a text PLY has one element
//             a line.
#include "common/mesh_file.h"
#include "common/srgb.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <climits>
#include <cmath>
#include <cstring>
#include <ios>
#include <locale>

namespace hsr {
namespace {

using Word = std::string_view;

/* CGAL counts in int. */
constexpr long long MOST = INT_MAX / 4;

/* Reads numbers by the rules, and to the very bits, of an istream, which is
 * what CGAL reads with: no "nan", "inf", hexadecimal or overflow. */
class Number_reader {
public:
  template <class Number> bool operator()(Word word, Number &number) {
    std::ios_base::iostate state = std::ios_base::goodbit;
    const char *end = word.data() + word.size();
    const char *stop = facet_.get(word.data(), end, ios_, state, number);
    return stop == end && !(state & std::ios_base::failbit);
  }

private:
  struct Facet : std::num_get<char, const char *> {};
  struct Classic : std::ios {
    Classic() : std::ios(nullptr) { imbue(std::locale::classic()); }
  };
  Facet facet_;
  Classic ios_;
};

bool read_integer(Word word, long long &number) {
  const char *end = word.data() + word.size();
  const auto result = std::from_chars(word.data(), end, number);
  return result.ec == std::errc() && result.ptr == end;
}

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/* The lines of a text that hold a word, and their words. Other white space
 * than line ends is turned into spaces, comments too. */
class Lines {
public:
  struct Style {
    char comment;    /* starts one; 0: there are none */
    bool continued; /* a line that ends in '\' goes on in the next */
  };
  Lines(const Mesh_file &file, Style style)
      : file_(file), style_(style), next_(file.begin), at_(next_), end_(next_) {
    if (file.size() >= 3 && !std::memcmp(next_, "\xef\xbb\xbf", 3))
      next_ += 3; /* a byte order mark */
  }

  /* Goes to the next line that holds a word; false at the end of the file. */
  bool next_line();
  /* Takes the next word of the line, empty at its end. */
  Word word();
  /* Takes the next word of the file, empty at its end. */
  Word word_of_any_line();
  /* Blanks the rest of the line, or a word. */
  void blank_rest() { std::fill(at_, end_, ' '); }
  void blank(Word word) {
    std::memset(const_cast<char *>(word.data()), ' ', word.size());
  }
  size_t number() const { return number_; }
  char *rest_of_file() const { return next_; }

  [[noreturn]] void refuse(const char *format, ...) const
      __attribute__((format(printf, 2, 3)));
  /* A finite number, or refuses: "vertex 3: 'x' is not a finite number". */
  double real(Word word, const char *kind, size_t element);

private:
  void tidy_line();

  const Mesh_file &file_;
  Style style_;
  char *next_;      /* of the line after the current one */
  char *at_, *end_; /* what is left of the current line */
  size_t number_ = 0, n_next_ = 0;
  Number_reader read_;
};

void Lines::refuse(const char *format, ...) const {
  char what[200];
  va_list args;
  va_start(args, format);
  std::vsnprintf(what, sizeof what, format, args);
  va_end(args);
  file_.refuse(number_, "%s", what);
}

void Lines::tidy_line() {
  for (char *c = at_; c < end_; c++) {
    if (style_.comment && *c == style_.comment) {
      std::fill(c, end_, ' ');
      return;
    }
    if (is_space(*c))
      *c = ' ';
  }
}

bool Lines::next_line() {
  do {
    if (next_ == file_.end)
      return false;
    at_ = next_;
    number_ += 1 + n_next_;
    n_next_ = 0;
    for (;;) {
      end_ = std::find(next_, file_.end, '\n');
      next_ = end_ == file_.end ? end_ : end_ + 1;
      char *last = end_;
      while (last > at_ && is_space(last[-1]))
        last--;
      if (!style_.continued || last == at_ || last[-1] != '\\')
        break;
      last[-1] = ' ';
      if (end_ == file_.end)
        break;
      *end_ = ' ';
      n_next_++;
    }
    tidy_line();
    at_ = std::find_if(at_, end_, [](char c) { return c != ' '; });
  } while (at_ == end_);
  return true;
}

Word Lines::word() {
  at_ = std::find_if(at_, end_, [](char c) { return c != ' '; });
  const char *start = at_;
  at_ = std::find(at_, end_, ' ');
  return Word(start, static_cast<size_t>(at_ - start));
}

Word Lines::word_of_any_line() {
  Word taken = word();
  while (taken.empty() && next_line())
    taken = word();
  return taken;
}

double Lines::real(Word word, const char *kind, size_t element) {
  double value;
  if (!read_(word, value))
    refuse("%s %zu: '%s' is not a finite number", kind, element,
           shown_word(word).c_str());
  return value;
}

/* Checks the vertex numbers of one face, in whatever format they stand. */
class Face_checker {
public:
  explicit Face_checker(bool drop) : drop_(drop) {}
  void start() { numbers_.clear(); }
  void add(size_t vertex) { numbers_.push_back(vertex); }
  /* What is wrong with the face, NULL if nothing is. */
  const char *fault() {
    if (drop_)
      return nullptr;
    if (numbers_.size() < 3)
      return "has fewer than 3 vertices";
    std::sort(numbers_.begin(), numbers_.end());
    return std::adjacent_find(numbers_.begin(), numbers_.end()) ==
                   numbers_.end()
               ? nullptr
               : "has the same vertex twice";
  }

private:
  bool drop_;
  std::vector<size_t> numbers_;
};

/* ---- OFF ---- */

class Off_scan {
public:
  Off_scan(Mesh_file &file, bool drop)
      : file_(file), lines_(file, {'#', false}), checker_(drop) {}
  Mesh_extent scan();

private:
  void header();
  void keyword();
  size_t count(Word word, const char *what);
  void vertex(size_t v);
  void face(size_t f);
  void colour(const std::vector<Word> &words, size_t f);
  void replace_header();

  Mesh_file &file_;
  Lines lines_;
  Face_checker checker_;
  Mesh_extent extent_;
  bool has_texture_ = false, has_colour_ = false, has_normal_ = false;
  bool homogeneous_ = false, coloured_ = true;
  std::vector<Word> words_;
};

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
  if (take("n"))
    lines_.refuse("vertices of other than 3 dimensions (nOFF) are not read");
  if (rest != "OFF")
    lines_.refuse("the file does not start with OFF, but with '%s'",
                  shown_word(word).c_str());
}

size_t Off_scan::count(Word word, const char *what) {
  long long n;
  if (!read_integer(word, n) || n < 0)
    lines_.refuse("'%s' is not a number of %s", shown_word(word).c_str(), what);
  if (n > MOST)
    lines_.refuse("%lld %s are more than can be read", n, what);
  return static_cast<size_t>(n);
}

void Off_scan::header() {
  if (!lines_.next_line())
    file_.refuse(0, "holds nothing but white space and comments");
  keyword();
  const Word first = lines_.word_of_any_line();
  if (first == "BINARY")
    lines_.refuse("binary OFF is not read");
  if (first.empty())
    lines_.refuse("the file ends before the number of vertices");
  extent_.n_vertices = count(first, "vertices");
  extent_.n_faces = count(lines_.word(), "faces");
  const Word edges = lines_.word();
  if (!edges.empty())
    count(edges, "edges");
  if (!lines_.word().empty())
    lines_.refuse("there are more than three numbers in the header");
  /* Not even "0 0 0" for each vertex and "0" for each face? */
  const size_t left = static_cast<size_t>(file_.end - lines_.rest_of_file());
  if (6 * extent_.n_vertices + 2 * extent_.n_faces > left + 1)
    lines_.refuse("the header claims %zu vertices and %zu faces, more than "
                  "the %zu bytes after it can hold",
                  extent_.n_vertices, extent_.n_faces, left);
}

void Off_scan::vertex(size_t v) {
  if (!lines_.next_line())
    lines_.refuse("the file ends after %zu of %zu vertices", v,
                  extent_.n_vertices);
  std::array<double, 4> coordinate{0, 0, 0, 1};
  const size_t h = homogeneous_, dimension = 3 + h;
  size_t n = 0;
  for (Word word = lines_.word(); !word.empty(); word = lines_.word(), n++) {
    const double value = lines_.real(word, "vertex", v);
    if (n < dimension)
      coordinate[n] = value;
  }
  const size_t least = dimension + (has_normal_ ? 3 + h : 0) +
                       (has_texture_ ? 2 + h : 0);
  if (n != least && !(has_colour_ && n >= least + 1 && n <= least + 4))
    lines_.refuse("vertex %zu has %zu numbers, not %zu", v, n, least);
  for (size_t k = 0; k < 3; k++)
    if (!std::isfinite(coordinate[k] / coordinate[3]))
      lines_.refuse("vertex %zu is not finite when divided by its w", v);
}

/* Face colours are taken if all faces have them: 3 or 4 numbers, 0..255 if
 * all are integers, else 0..1. One number is an index into a map that is not
 * part of the file. */
void Off_scan::colour(const std::vector<Word> &words, size_t f) {
  if (words.size() == 2 || words.size() > 4)
    lines_.refuse("face %zu has %zu numbers after its vertices, not a colour",
                  f, words.size());
  bool integers = true;
  std::array<double, 4> value{};
  for (size_t k = 0; k < words.size(); k++) {
    value[k] = lines_.real(words[k], "face", f);
    long long integer;
    integers = integers && read_integer(words[k], integer);
  }
  if (words.size() < 3 || !coloured_) {
    coloured_ = false;
    return;
  }
  for (size_t k = 0; k < 3; k++) {
    const double encoded = value[k] / (integers ? 255 : 1);
    extent_.rgb.push_back(hsr_srgb_decode(
        static_cast<float>(std::min(std::max(encoded, 0.0), 1.0))));
  }
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
  words_.clear();
  for (Word word = lines_.word(); !word.empty(); word = lines_.word())
    words_.push_back(word);
  colour(words_, f);
}

/* CGAL ignores whatever follows the coordinates of a vertex or the numbers of
 * a face if the header says plain OFF. */
void Off_scan::replace_header() {
  char header[Mesh_file::SPARE];
  const int length = std::snprintf(header, sizeof header, "%sOFF\n%zu %zu 0\n",
                                   homogeneous_ ? "4" : "", extent_.n_vertices,
                                   extent_.n_faces);
  file_.begin = lines_.rest_of_file() - length;
  std::memcpy(file_.begin, header, static_cast<size_t>(length));
}

Mesh_extent Off_scan::scan() {
  header();
  const Lines at_data = lines_;
  for (size_t v = 0; v < extent_.n_vertices; v++)
    vertex(v);
  for (size_t f = 0; f < extent_.n_faces; f++)
    face(f);
  if (lines_.next_line())
    lines_.refuse("there is more after the last of %zu faces",
                  extent_.n_faces);
  if (!coloured_)
    extent_.rgb.clear();
  return std::move(extent_);
}

} // namespace
} // namespace hsr
