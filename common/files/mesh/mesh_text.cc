// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/files/mesh/mesh_text.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstring>

namespace hsr {

bool read_integer(Word word, long long &number) {
  const char *end = word.data() + word.size();
  const auto result = std::from_chars(word.data(), end, number);
  return result.ec == std::errc() && result.ptr == end;
}

void skip_byte_order_mark(Mesh_file &file) {
  if (file.size() >= 3 && !std::memcmp(file.begin, "\xef\xbb\xbf", 3))
    file.begin += 3;
}

double Number_type::of_bytes(const void *bytes, bool big_endian) const {
  const auto *byte = static_cast<const unsigned char *>(bytes);
  uint64_t bits = 0;
  for (size_t k = 0; k < size; k++)
    bits = bits << 8 | byte[big_endian ? k : size - 1 - k];
  if (is_real && size == 8) {
    double number;
    std::memcpy(&number, &bits, sizeof number);
    return number;
  }
  if (is_real) {
    float number;
    const uint32_t word = static_cast<uint32_t>(bits);
    std::memcpy(&number, &word, sizeof number);
    return double{number};
  }
  const size_t unused = 64 - 8 * size;
  return least < 0 ? static_cast<double>(static_cast<int64_t>(bits << unused) >>
                                         unused)
                   : static_cast<double>(bits);
}

namespace {

bool is_not_blank(char c) {
  return c != ' ';
}

} // namespace

Lines::Lines(const Mesh_file &file, Style style)
    : file_(file), style_(style), next_(file.begin), at_(next_), end_(next_) {}

void Lines::refuse(const char *format, ...) const {
  char what[200];
  va_list args;
  va_start(args, format);
  std::vsnprintf(what, sizeof what, format, args);
  va_end(args);
  file_.refuse(number_, "%s", what);
}

/* Whether the line from `start` to end_ goes on in the next; its mark is
 * blanked. A comment does not: a path in it may end in '\'. */
bool Lines::is_continued(char *start) const {
  char *last = end_;
  while (last > start && is_space(last[-1]))
    last--;
  if (!style_.continued || last == start || last[-1] != '\\' ||
      std::find(start, last, style_.comment) != last)
    return false;
  last[-1] = ' ';
  return true;
}

void Lines::tidy() {
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
    number_ += 1 + n_joined_;
    n_joined_ = 0;
    for (char *start = at_;; start = next_) {
      end_ = std::find(next_, file_.end, '\n');
      next_ = end_ == file_.end ? end_ : end_ + 1;
      if (!is_continued(start) || end_ == file_.end)
        break;
      *end_ = ' ';
      n_joined_++;
    }
    tidy();
    at_ = std::find_if(at_, end_, is_not_blank);
  } while (at_ == end_);
  return true;
}

namespace {

/* Takes a number, which ends at white space or with the file; NULL if there is
 * none. */
template <class Number>
const char *take_number(const char *at, const char *end, Number &number) {
  const auto result = std::from_chars(past_spaces(at, end), end, number);
  const char *stop = result.ptr;
  return result.ec == std::errc() &&
                 (stop == end || is_space(*stop) || *stop == '\n')
             ? stop
             : nullptr;
}

/* Past a line that has nothing more; NULL: it has. */
const char *past_end_of_line(const char *at, const char *end) {
  at = past_spaces(at, end);
  return at == end ? end : *at == '\n' ? at + 1 : nullptr;
}

} // namespace

const char *past_plain_line(const char *at, const char *end, double *number,
                            size_t n) {
  for (size_t k = 0; k < n; k++) {
    at = take_number(at, end, number[k]);
    if (!at || !std::isfinite(number[k]))
      return nullptr;
  }
  return past_end_of_line(at, end);
}

const char *past_plain_numbers(const char *at, const char *end, double *number,
                               size_t &n, size_t most) {
  for (n = 0; (at = past_spaces(at, end)) < end && *at != '\n'; n++) {
    if (n == most)
      return nullptr;
    at = take_number(at, end, number[n]);
    if (!at || !std::isfinite(number[n]))
      return nullptr;
  }
  return past_end_of_line(at, end);
}

const char *past_plain_list(const char *at, const char *end, uint32_t *number,
                            size_t &n, size_t most) {
  at = take_number(at, end, n);
  if (!at || n > most)
    return nullptr;
  for (size_t k = 0; k < n; k++) {
    at = take_number(at, end, number[k]);
    if (!at)
      return nullptr;
  }
  return past_end_of_line(at, end);
}

/* Goes on after a line that is read; NULL: it is not. */
bool Lines::go_on_at(const char *next) {
  if (!next)
    return false;
  next_ += next - next_;
  at_ = end_ = next_;
  number_ += 1 + n_joined_;
  n_joined_ = 0;
  return true;
}

Word Lines::word() {
  at_ = std::find_if(at_, end_, is_not_blank);
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

std::string Lines::rest() const {
  const char *start = std::find_if(at_, end_, is_not_blank), *end = end_;
  while (end > start && end[-1] == ' ')
    end--;
  return std::string(start, end);
}

void Lines::blank(Word word) {
  /* Words are views of the file's bytes, which are ours to write. */
  std::fill_n(const_cast<char *>(word.data()), word.size(), ' ');
}

void Lines::blank_rest() {
  std::fill(at_, end_, ' ');
  at_ = end_;
}

const char *Face_checker::fault() {
  if (drop_)
    return nullptr;
  if (numbers_.size() < 3)
    return "has fewer than 3 vertices";
  const size_t *v = numbers_.data();
  bool twice = v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
  if (numbers_.size() > 3) {
    std::sort(numbers_.begin(), numbers_.end());
    twice =
        std::adjacent_find(numbers_.begin(), numbers_.end()) != numbers_.end();
  }
  return twice ? TWICE : nullptr;
}

} // namespace hsr
