// SPDX-License-Identifier: GPL-3.0-or-later
// Words, lines and numbers of mesh files, for mesh_off.cc and the scans in
// mesh_scan_*.
#ifndef HSR_COMMON_MESH_TEXT_H
#define HSR_COMMON_MESH_TEXT_H

#include "common/files/mesh/mesh_file.h"

#include <charconv>
#include <climits>
#include <cmath>
#include <ios>
#include <locale>
#include <string_view>
#include <vector>

namespace hsr {

using Word = std::string_view;

/* CGAL counts in int. */
constexpr long long MOST_ELEMENTS = INT_MAX / 4;

/* White space within a line. */
inline bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/* The first byte from `at` that is no such space. */
inline const char *past_spaces(const char *at, const char *end) {
  while (at < end && is_space(*at))
    at++;
  return at;
}

bool read_integer(Word word, long long &number);

/* Past a line that holds nothing but n numbers, each plain and finite, between
 * spaces; NULL: it holds something else, or less. For the many lines of a large
 * file that are so. */
const char *past_plain_line(const char *at, const char *end, double *number,
                            size_t n);
/* The same of a line of n numbers, at most `most`. */
const char *past_plain_numbers(const char *at, const char *end, double *number,
                               size_t &n, size_t most);
/* The same of a number n of at most `most`, and n numbers. */
const char *past_plain_list(const char *at, const char *end, uint32_t *number,
                            size_t &n, size_t most);

/* A text may start with a byte order mark: moves file.begin past it. */
void skip_byte_order_mark(Mesh_file &file);

/* Reads numbers as an istream does, to the last bit: no "nan", "inf",
 * hexadecimal or overflow. Nearly all are read by from_chars, which rounds
 * alike and is faster; whatever it does not take whole is put to an istream's
 * own reader. */
class Number_reader {
public:
  template <class Number> bool operator()(Word word, Number &number) {
    const char *end = word.data() + word.size();
    const auto quick = std::from_chars(word.data(), end, number);
    if (quick.ec == std::errc() && quick.ptr == end && std::isfinite(number))
      return true;
    std::ios_base::iostate state = std::ios_base::goodbit;
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

/* A type of numbers, as binary files hold them. */
struct Number_type {
  size_t size; /* bytes, at most 8 */
  bool is_real;
  double least, most; /* of an integer */

  double of_bytes(const void *bytes, bool big_endian) const;
};

/* The lines of a text that hold a word, and their words. White space other
 * than line ends is turned into spaces as it is met, and so are comments. */
class Lines {
public:
  struct Style {
    char comment;   /* starts one; 0: there are none */
    bool continued; /* a line that ends in '\' goes on in the next */
  };
  Lines(const Mesh_file &file, Style style);

  /* Goes to the next line that holds a word; false at the end of the file. */
  bool next_line();
  /* Goes to the next line if it is plain; else stays where it is. */
  bool next_plain_line(double *number, size_t n) {
    return go_on_at(past_plain_line(next_, file_.end, number, n));
  }
  bool next_plain_list(uint32_t *number, size_t &n, size_t most) {
    return go_on_at(past_plain_list(next_, file_.end, number, n, most));
  }
  /* Takes the next word of the line, empty at its end. */
  Word word();
  /* Takes the next word of the file, empty at its end. */
  Word word_of_any_line();

  /* The rest of the line, without spaces at its ends; the line is not taken. */
  std::string rest() const;

  /* The bytes of a word, or of the rest of the line, become spaces. */
  static void blank(Word word);
  void blank_rest();

  size_t number() const { return number_; }
  char *rest_of_file() const { return next_; }

  [[noreturn]] void refuse(const char *format, ...) const
      __attribute__((format(printf, 2, 3)));
  /* A finite number, or refuses: "vertex 3: 'x' is not a finite number". */
  template <class Number = double>
  Number real(Word word, const char *kind, size_t element) {
    Number value;
    if (!read_(word, value))
      refuse("%s %zu: '%s' is not a finite number", kind, element,
             shown_word(word).c_str());
    return value;
  }

private:
  bool is_continued(char *start) const;
  void tidy();
  bool go_on_at(const char *next);

  const Mesh_file &file_;
  Style style_;
  char *next_;      /* the line after the current one */
  char *at_, *end_; /* what is left of the current line */
  size_t number_ = 0, n_joined_ = 0;
  Number_reader read_;
};

/* Reads what follows the header of an .off file, if every line of it is a plain
 * vertex or a face that needs no word about it. If not, returns false, and
 * nothing is given. std::bad_alloc. */
bool off_read_plain(const char *begin, const char *end, size_t n_vertices,
                    size_t n_faces, Mesh_builder &builder);

/* Judges a face by its vertex numbers alone. */
class Face_checker {
public:
  explicit Face_checker(bool drop) : drop_(drop) {}
  void start() { numbers_.clear(); }
  void add(size_t vertex) { numbers_.push_back(vertex); }
  /* What is wrong with the face; NULL if nothing is, or it will be dropped. */
  const char *fault();

private:
  bool drop_;
  std::vector<size_t> numbers_;
};

} // namespace hsr

#endif
