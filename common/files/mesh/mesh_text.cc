// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/files/mesh/mesh_text.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <utility>

#include <iconv.h>

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

void end_lines(char *begin, char *end) {
  for (char *at = begin; at < end; at++) {
    at = static_cast<char *>(
        std::memchr(at, '\r', static_cast<size_t>(end - at)));
    if (!at)
      return;
    if (at + 1 == end || at[1] != '\n')
      *at = '\n';
  }
}

namespace {

/* From UTF-16 of the system's that iconv knows by `name`. */
void make_utf8(Mesh_file &file, const char *name) {
  const iconv_t conversion = iconv_open("UTF-8", name);
  if (conversion == reinterpret_cast<iconv_t>(-1))
    file.refuse(0, "is in UTF-16, which is not known here");
  char *from = file.begin + 2;
  size_t left = file.size() - 2, room = 3 * (left / 2) + 4;
  std::unique_ptr<char[]> text(new char[room]);
  char *to = text.get();
  const bool bad =
      iconv(conversion, &from, &left, &to, &room) == static_cast<size_t>(-1);
  iconv_close(conversion);
  if (bad || left)
    file.refuse(0, "is in UTF-16, and broken at byte %zu",
                static_cast<size_t>(from - file.begin));
  file.begin = text.get();
  file.end = to;
  file.memory = std::move(text);
}

} // namespace

void make_plain_text(Mesh_file &file) {
  if (file.size() >= 2 && !std::memcmp(file.begin, "\xff\xfe", 2))
    make_utf8(file, "UTF-16LE");
  else if (file.size() >= 2 && !std::memcmp(file.begin, "\xfe\xff", 2))
    make_utf8(file, "UTF-16BE");
  skip_byte_order_mark(file);
  end_lines(file.begin, file.end);
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

/* The number of a line is looked for only here. */
void Text::refuse(const char *format, ...) const {
  char what[200];
  va_list args;
  va_start(args, format);
  std::vsnprintf(what, sizeof what, format, args);
  va_end(args);
  const char *first = file_.begin;
  file_.refuse(static_cast<size_t>(1 + std::count(first, start_, '\n')), "%s",
               what);
}

/* Past the '\' at `at` and the line end behind it; NULL: it is another one. */
const char *Text::past_mark(const char *at) const {
  if (!style_.continued || *at != '\\')
    return nullptr;
  at = past_spaces(at + 1, end_);
  return at == end_ ? end_ : *at == '\n' ? at + 1 : nullptr;
}

/* Of a place that is a '\' or a comment. */
bool Text::more_after_mark() {
  if (is_comment(*at_)) {
    at_ = std::find(at_, end_, '\n');
    return false;
  }
  const char *past = past_mark(at_);
  if (!past)
    return true;
  at_ = past;
  return more();
}

Word Text::word() {
  if (!more())
    return Word();
  const char *start = at_++;
  while (!is_end_of_word(at_) && !is_comment(*at_) && !past_mark(at_))
    at_++;
  return Word(start, static_cast<size_t>(at_ - start));
}

bool Text::integer(long long &number, Word &taken) {
  const auto quick = std::from_chars(at_, end_, number);
  if (quick.ec == std::errc() && is_end_of_word(quick.ptr)) {
    at_ = quick.ptr;
    return true;
  }
  taken = word();
  return read_integer(taken, number);
}

std::string Text::rest() {
  std::string text;
  for (bool is_there = more();
       is_there && at_ < end_ && *at_ != '\n' && !is_comment(*at_);) {
    const char *past = past_mark(at_);
    if (past)
      text.append(static_cast<size_t>(past - at_), ' ');
    else
      text += is_space(*at_) ? ' ' : *at_;
    at_ = past ? past : at_ + 1;
  }
  text.resize(text.find_last_not_of(' ') + 1);
  return text;
}

/* Whether the line whose rest ends at `end` goes on. */
bool Text::is_continued(const char *end) const {
  const char *last = end;
  while (last > at_ && is_space(last[-1]))
    last--;
  return last > at_ && last[-1] == '\\' &&
         (!style_.comment || std::find(at_, last, style_.comment) == last);
}

void Text::pass_line() {
  for (bool goes_on = true; goes_on && at_ < end_;) {
    const void *stop = std::memchr(at_, '\n', static_cast<size_t>(end_ - at_));
    const char *end = stop ? static_cast<const char *>(stop) : end_;
    goes_on = style_.continued && is_continued(end);
    at_ = end + (end < end_);
  }
  begun_ = false;
}

bool Text::next_line() {
  if (begun_)
    pass_line();
  for (; at_ < end_; pass_line()) {
    start_ = at_;
    begun_ = true;
    if (more())
      return true;
  }
  if (start_ < end_)
    start_ = end_ - 1;
  return false;
}

} // namespace hsr
