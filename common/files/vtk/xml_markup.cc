// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/files/vtk/xml_markup.h"

#include <algorithm>
#include <cstdio>

namespace hsr {
namespace {

/* Attributes included. Expat starts a tag anew with every 4096 bytes that it is
 * given of it, so that its time would grow with the square of the length. */
constexpr size_t LONGEST_TAG = 1 << 16;

bool is_name_char(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         (c >= '0' && c <= '9') || c == '_' || c == ':' || c == '.' ||
         c == '-' || static_cast<unsigned char>(c) >= 0x80;
}

} // namespace

bool is_xml_space(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

void overwrite_lines(Word text, char letter) {
  char *begin = const_cast<char *>(text.data());
  std::replace_if(
      begin, begin + text.size(), [](char c) { return c != '\n'; }, letter);
}

Word trimmed(Word text) {
  while (!text.empty() && is_xml_space(text.front()))
    text.remove_prefix(1);
  while (!text.empty() && is_xml_space(text.back()))
    text.remove_suffix(1);
  return text;
}

void Markup::refuse(const char *place, const char *format, ...) const {
  char what[200];
  va_list args;
  va_start(args, format);
  std::vsnprintf(what, sizeof what, format, args);
  va_end(args);
  const auto line = 1 + std::count(top_, place, '\n');
  file_.refuse(static_cast<size_t>(line), "%s", what);
}

void Markup::skip_space() {
  at_ = std::find_if_not(at_, file_.end, is_xml_space);
}

/* Blanks, if it comes next, what begins with `start` and ends with `stop`. */
bool Markup::pass_over(Word start, Word stop) {
  const Word text = rest();
  if (text.substr(0, start.size()) != start)
    return false;
  const size_t length = text.find(stop, start.size());
  if (length == Word::npos)
    refuse(at_, "'%s' without '%s'", start.data(), stop.data());
  blank_lines(text.substr(0, length + stop.size()));
  at_ += length + stop.size();
  return true;
}

Word Markup::name() {
  const char *start = at_;
  at_ = std::find_if_not(at_, file_.end, is_name_char);
  if (at_ == start)
    refuse(at_, "a tag is ill-formed");
  return between(start, at_);
}

Tag::Attribute Markup::read_attribute() {
  Tag::Attribute attribute{};
  const char *start = at_;
  attribute.name = name();
  skip_space();
  if (peek() != '=')
    refuse(start, "the attribute '%s' has no value",
           shown_word(attribute.name).c_str());
  at_++;
  skip_space();
  const char quote = peek();
  if (quote != '"' && quote != '\'')
    refuse(start, "the value of '%s' has no quotes",
           shown_word(attribute.name).c_str());
  const char *value = ++at_;
  at_ = std::find_if(at_, file_.end,
                     [quote](char c) { return c == quote || c == '<'; });
  if (peek() != quote)
    refuse(start, "the value of '%s' has no end",
           shown_word(attribute.name).c_str());
  attribute.value = between(value, at_++);
  attribute.text = between(start, at_);
  return attribute;
}

Tag Markup::tag_after_text() {
  do {
    const char *start = at_;
    at_ = std::find(at_, file_.end, '<');
    if (at_ == file_.end)
      refuse(start, "the file ends before its last tag");
  } while (pass_over("<!--", "-->") || pass_over("<?", "?>"));

  Tag tag{};
  const char *start = at_++;
  if (peek() == '!')
    refuse(start, "holds a declaration ('<!...'), which VTK's files have not");
  if (peek() == '/') {
    tag.kind = Tag::END;
    at_++;
  }
  tag.name = name();
  for (;;) {
    const char *before = at_;
    skip_space();
    if (static_cast<size_t>(at_ - start) > LONGEST_TAG)
      refuse(start, "the tag '%s' is longer than %zu bytes",
             shown_word(tag.name).c_str(), LONGEST_TAG);
    if (tag.kind == Tag::START && peek() == '/') {
      tag.kind = Tag::EMPTY;
      at_++;
    }
    if (peek() == '>')
      break;
    if (tag.kind != Tag::START || at_ == before)
      refuse(start, "the tag '%s' is ill-formed", shown_word(tag.name).c_str());
    tag.attributes.push_back(read_attribute());
  }
  tag.text = between(start, ++at_);
  return tag;
}

Tag Markup::tag() {
  const char *start = at_;
  Tag next = tag_after_text();
  const Word text = trimmed(between(start, next.text.data()));
  if (!text.empty())
    refuse(text.data(), "'%s' where a tag should be", shown_word(text).c_str());
  return next;
}

/* Whether a tag is not the one that ends `parent`. */
bool Markup::is_within(const Tag &parent, const Tag &tag) const {
  if (tag.kind == Tag::END && tag.name != parent.name)
    refuse(tag.text.data(), "'%s' ends where '%s' should",
           shown_word(tag.name).c_str(), shown_word(parent.name).c_str());
  return tag.kind != Tag::END;
}

bool Markup::child(const Tag &parent, Tag &next) {
  return parent.kind == Tag::START && is_within(parent, next = tag());
}

bool Markup::child_or_text(const Tag &parent, Tag &next) {
  return parent.kind == Tag::START &&
         is_within(parent, next = tag_after_text());
}

void Markup::skip(const Tag &start) {
  for (size_t depth = start.kind == Tag::START; depth;) {
    const Tag::Kind kind = tag_after_text().kind;
    depth += kind == Tag::START;
    depth -= kind == Tag::END;
  }
  blank_lines(between(start.text.data(), at_));
}

const Word *Markup::find(const Tag &tag, Word name) const {
  const Word *found = nullptr;
  for (const Tag::Attribute &attribute : tag.attributes)
    if (attribute.name == name) {
      if (found)
        refuse(attribute.text.data(), "'%s' has two attributes '%s'",
               shown_word(tag.name).c_str(), shown_word(name).c_str());
      found = &attribute.value;
    }
  return found;
}

const Word *Markup::attribute(Tag &tag, Word name) const {
  for (Tag::Attribute &attribute : tag.attributes)
    attribute.is_kept |= attribute.name == name;
  return find(tag, name);
}

void Markup::blank_others(const Tag &tag) const {
  for (const Tag::Attribute &attribute : tag.attributes)
    if (!attribute.is_kept)
      blank_lines(attribute.text);
}

} // namespace hsr
