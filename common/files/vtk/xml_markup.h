// SPDX-License-Identifier: GPL-3.0-or-later
// The tags of an XML file, with as much of XML as VTK's formats use.
// Declarations (<!DOCTYPE, <![CDATA[) are refused.
#ifndef HSR_COMMON_XML_MARKUP_H
#define HSR_COMMON_XML_MARKUP_H

#include "common/files/mesh/mesh_text.h"

namespace hsr {

/* The bytes [begin, end). */
inline Word between(const char *begin, const char *end) {
  return Word(begin, static_cast<size_t>(end - begin));
}

/* Overwrite every byte of a text but its line ends, by `letter` or by spaces. A
 * Word views the bytes of the Mesh_file, which may be overwritten. */
void overwrite_lines(Word text, char letter);
inline void blank_lines(Word text) {
  overwrite_lines(text, ' ');
}

/* Whether c is white space in XML. */
bool is_xml_space(char c);
/* Returns a text without white space at its ends. */
Word trimmed(Word text);

struct Tag {
  enum Kind { START, EMPTY, END }; /* <a>, <a/>, </a> */
  struct Attribute {
    Word text, name, value; /* text: name="value" */
    bool is_kept;           /* blank_others() leaves it */
  };

  Kind kind;
  Word text; /* from '<' to '>' */
  Word name;
  std::vector<Attribute> attributes;
};

/* Moves through a file from tag to tag. Parts that VTK must not see are
 * blanked: they are overwritten by spaces, so that every other byte stays in
 * its line and place. Functions throw Refused if the file is not
 * well-formed. */
class Markup {
public:
  explicit Markup(const Mesh_file &file)
      : file_(file), top_(file.begin), at_(file.begin) {}

  /* Returns the next tag. White space, comments and instructions (<?xml ...?>)
   * may come before it. Comments and instructions are blanked. */
  Tag tag();
  /* Sets `tag` to the next tag within `parent`. False if it is the tag that
   * ends the parent. */
  bool child(const Tag &parent, Tag &tag);
  /* The same, but text may come before the tag. */
  bool child_or_text(const Tag &parent, Tag &tag);
  /* Blanks the element that a tag starts, and moves past it. */
  void skip(const Tag &start);

  /* Returns the value of an attribute of a tag; NULL: there is none. */
  const Word *find(const Tag &tag, Word name) const;
  /* The same, and marks the attribute as kept. */
  const Word *attribute(Tag &tag, Word name) const;
  /* Blanks the attributes of a tag that are not kept. */
  void blank_others(const Tag &tag) const;

  const char *at() const { return at_; }
  Word rest() const { return between(at_, file_.end); }
  void go_to(const char *place) { at_ += place - at_; }

  /* Throws Refused with the line of a place in the file. */
  [[noreturn]] void refuse(const char *place, const char *format, ...) const
      __attribute__((format(printf, 3, 4)));

private:
  Tag tag_after_text();
  bool is_within(const Tag &parent, const Tag &tag) const;
  char peek() const { return at_ < file_.end ? *at_ : '\0'; }
  void skip_space();
  bool pass_over(Word start, Word stop);
  Word name();
  Tag::Attribute read_attribute();

  const Mesh_file &file_;
  const char *top_; /* the start of line 1 */
  char *at_;
};

} // namespace hsr

#endif
