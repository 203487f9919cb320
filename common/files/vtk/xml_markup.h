// SPDX-License-Identifier: GPL-3.0-or-later
// Tags of an XML file: as much of XML as VTK's formats use. Declarations
// (<!DOCTYPE, <![CDATA[) are refused.
#ifndef HSR_COMMON_XML_MARKUP_H
#define HSR_COMMON_XML_MARKUP_H

#include "common/files/mesh/mesh_text.h"

namespace hsr {

inline Word between(const char *begin, const char *end) {
  return Word(begin, static_cast<size_t>(end - begin));
}

/* Makes every byte of a text a letter, or a space, but for its line ends. Words
 * are views of the file's bytes, which are ours to write. */
void overwrite_lines(Word text, char letter);
inline void blank_lines(Word text) {
  overwrite_lines(text, ' ');
}

/* The white space of XML. */
bool is_xml_space(char c);
/* Without white space at its ends. */
Word trimmed(Word text);

struct Tag {
  enum Kind { START, EMPTY, END }; /* <a>, <a/>, </a> */
  struct Attribute {
    Word text, name, value; /* text: name="value" */
    bool is_kept;
  };

  Kind kind;
  Word text; /* from '<' to '>' */
  Word name;
  std::vector<Attribute> attributes;
};

/* Goes from tag to tag. What the file's reader is not to see becomes spaces, so
 * that every other byte stays in its line and its place. */
class Markup {
public:
  explicit Markup(const Mesh_file &file)
      : file_(file), top_(file.begin), at_(file.begin) {}

  /* The next tag; only white space, comments and instructions (<?xml ...?>) may
   * come before it, and the latter two are blanked. */
  Tag tag();
  /* The next tag within `parent`; false if it is the one that ends it. */
  bool child(const Tag &parent, Tag &tag);
  /* The same, where text may come before it. */
  bool child_or_text(const Tag &parent, Tag &tag);
  /* Blanks the element that a tag starts. */
  void skip(const Tag &start);

  /* An attribute of a tag, or NULL. */
  const Word *find(const Tag &tag, Word name) const;
  /* The same, which blank_others then leaves there. */
  const Word *attribute(Tag &tag, Word name) const;
  void blank_others(const Tag &tag) const;

  const char *at() const { return at_; }
  Word rest() const { return between(at_, file_.end); }
  void go_to(const char *place) { at_ += place - at_; }

  /* Throws Refused, with the line of a place in the file. */
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
