// SPDX-License-Identifier: GPL-3.0-or-later
// Words, lines and numbers of mesh files.
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

/* The most elements of a file. They are counted in 32 bits, with room to
 * spare. */
constexpr long long MOST_ELEMENTS = INT_MAX / 4;

/* Whether c is white space within a line. */
inline bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/* Returns the first byte of [at, end) that is not such a space, or `end`. */
inline const char *past_spaces(const char *at, const char *end) {
  while (at < end && is_space(*at))
    at++;
  return at;
}

/* Reads a word that is an integer as a whole. False if it is not. */
bool read_integer(Word word, long long &number);

/* Moves file.begin past a byte order mark, if the text starts with one. */
void skip_byte_order_mark(Mesh_file &file);

/* Makes lines that end in CR alone end in LF. */
void end_lines(char *begin, char *end);

/* Makes a text UTF-8 without a byte order mark, with lines that end in LF or CR
 * LF. A text in UTF-16 is known by its byte order mark. Throws Refused for one
 * that is broken; std::bad_alloc. */
void make_plain_text(Mesh_file &file);

/* Reads numbers as an istream does, to the last bit: "nan", "inf", hexadecimal
 * numbers and overflow are refused. from_chars, which rounds alike and is
 * faster, reads nearly all. A word that it does not accept as a whole is given
 * to an istream's own reader. Returns false if the word is not a number. */
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

/* A type of numbers in binary files. */
struct Number_type {
  size_t size; /* bytes, at most 8 */
  bool is_real;
  double least, most; /* the range of an integer type */

  /* Returns the number in `size` bytes. */
  double of_bytes(const void *bytes, bool big_endian) const;
};

/* The syntax of a text. */
struct Text_style {
  char comment;   /* the character that starts a comment; 0: none does */
  bool continued; /* a line that ends in '\' continues in the next line, unless
                     the '\' is in a comment */
};

/* A place in a text, which moves from line to line and from word to word. Lines
 * without a word are skipped. A line and its continuation are one line. */
class Text {
public:
  Text(const Mesh_file &file, Text_style style)
      : Text(file, style, file.begin, file.end) {}
  /* A part of the file, which begins with a line. */
  Text(const Mesh_file &file, Text_style style, const char *begin,
       const char *end)
      : file_(file), style_(style), at_(begin), start_(begin), end_(end) {}

  /* Goes to the first word of the next line that has one; false at the end. */
  bool next_line();
  /* Goes to the next word of the line; false at its end. */
  bool more() {
    while (at_ < end_ && is_space(*at_))
      at_++;
    return at_ < end_ && *at_ != '\n' && (is_plain(*at_) || more_after_mark());
  }
  /* Goes to the next word of the text; false at its end. */
  bool more_in_text() {
    while (!more())
      if (!next_line())
        return false;
    return true;
  }
  /* Returns the next word of the line and moves past it; empty at the line's
   * end. */
  Word word();
  /* Returns the rest of the line and moves past it. Spaces at its ends are left
   * out. Other white space, and marks of continuation, become spaces. */
  std::string rest();
  /* Goes to the start of the next line. */
  void pass_line();

  /* Read the next word of the line, which must exist, as a number. integer()
   * returns false if it is not an integer, and sets `word` to it. real()
   * refuses a word that is not a finite number: "vertex 3: 'x' is not a finite
   * number". real_of() does so with a word that was taken before. */
  bool integer(long long &number, Word &word);
  template <class Number = double>
  Number real(const char *kind, size_t element) {
    Number number;
    const auto quick = std::from_chars(at_, end_, number);
    if (quick.ec == std::errc() && is_end_of_word(quick.ptr) &&
        std::isfinite(number)) {
      at_ = quick.ptr;
      return number;
    }
    return real_of<Number>(word(), kind, element);
  }
  /* The same, but "nan" and "inf" are taken, too, with a sign and in upper case
   * or lower. */
  template <class Number = double>
  Number any_real(const char *kind, size_t element) {
    Number number;
    const auto quick = std::from_chars(at_, end_, number);
    if (quick.ec == std::errc() && is_end_of_word(quick.ptr)) {
      at_ = quick.ptr;
      return number;
    }
    return real_of<Number>(word(), kind, element);
  }
  template <class Number = double>
  Number real_of(Word word, const char *kind, size_t element) {
    Number number;
    if (!read_(word, number))
      refuse("%s %zu: '%s' is not a finite number", kind, element,
             shown_word(word).c_str());
    return number;
  }

  const char *at() const { return at_; }

  /* Throws Refused, with the number of the line. */
  [[noreturn]] void refuse(const char *format, ...) const
      __attribute__((format(printf, 2, 3)));

private:
  bool is_comment(char c) const { return c == style_.comment && c; }
  bool is_plain(char c) const { return c != '\\' && c != style_.comment; }
  bool is_end_of_word(const char *at) const {
    return at == end_ || is_space(*at) || *at == '\n';
  }
  const char *past_mark(const char *at) const;
  bool more_after_mark();
  bool is_continued(const char *end) const;

  const Mesh_file &file_;
  Text_style style_;
  const char *at_, *start_, *end_; /* start_: of the line */
  bool begun_ = false;
  Number_reader read_;
};

} // namespace hsr

#endif
