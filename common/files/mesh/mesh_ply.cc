// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the .ply files, text and binary, that mesh_ply_plain.cc does not read.
//
// Source      see mesh_ply_header.h
// Departures  a text has one element a line. Colours are bytes, red, green and
//             blue, or r, g and b; others are passed over.
// Cost        each value is read once
#include "common/files/mesh/mesh_ply_header.h"
#include "common/files/srgb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace hsr {
namespace {

using ply::Element;
using ply::Format;
using ply::Property;
using ply::Type;

/* ---- Values ---- */

/* Both sources of values have: start and finish of an element, the next value
 * of a type, passing over n values, the end of all, and refuse. */
class Text_source {
public:
  explicit Text_source(Text &text) : text_(text) {}

  void start(const Element &element, size_t number) {
    name_ = shown_word(element.name);
    number_ = number;
    if (!text_.next_line())
      text_.refuse("the file ends after %zu of %zu elements '%s'", number,
                   element.n, name_.c_str());
  }
  double value(const Type &type);
  void skip(const Type &type, size_t n) {
    for (size_t k = 0; k < n; k++)
      value(type);
  }
  void finish() {
    if (text_.more())
      text_.refuse("%s %zu has more values than its properties", name_.c_str(),
                   number_);
  }
  void end() {
    if (text_.next_line())
      text_.refuse("the file goes on after the last element");
  }
  template <class... Values>
  [[noreturn]] void refuse(const char *format, Values... values) const {
    text_.refuse(format, values...);
  }

private:
  Text &text_;
  std::string name_;
  size_t number_ = 0;
};

double Text_source::value(const Type &type) {
  if (!text_.more())
    text_.refuse("%s %zu has fewer values than its properties", name_.c_str(),
                 number_);
  if (type.is_real)
    return type.size == 4
               ? double{text_.any_real<float>(name_.c_str(), number_)}
               : text_.any_real<double>(name_.c_str(), number_);
  long long integer;
  Word word;
  if (!text_.integer(integer, word))
    text_.refuse("%s %zu: '%s' is not an integer", name_.c_str(), number_,
                 shown_word(word).c_str());
  const double number = static_cast<double>(integer);
  if (number < type.least || number > type.most)
    text_.refuse("%s %zu: %lld is out of the range of %s", name_.c_str(),
                 number_, integer, type.name.data());
  return number;
}

class Binary_source {
public:
  Binary_source(const Mesh_file &file, const char *at, bool big_endian)
      : file_(file), at_(at), big_endian_(big_endian) {}

  void start(const Element &element, size_t number) {
    element_ = &element;
    number_ = number;
  }
  double value(const Type &type);
  void skip(const Type &type, size_t n) {
    const size_t left = static_cast<size_t>(file_.end - at_);
    if (n > left / type.size)
      refuse_end();
    at_ += n * type.size;
  }
  void finish() {}
  void end() {
    if (!std::all_of(at_, static_cast<const char *>(file_.end),
                     [](char c) { return c == ' ' || c == '\n' || c == '\r'; }))
      file_.refuse(0, "%zu bytes follow the last element",
                   static_cast<size_t>(file_.end - at_));
  }
  template <class... Values>
  [[noreturn]] void refuse(const char *format, Values... values) const {
    file_.refuse(0, format, values...);
  }

private:
  [[noreturn]] void refuse_end() const {
    file_.refuse(0, "the file ends in %s %zu of %zu",
                 shown_word(element_->name).c_str(), number_, element_->n);
  }

  const Mesh_file &file_;
  const char *at_;
  bool big_endian_;
  const Element *element_ = nullptr;
  size_t number_ = 0;
};

double Binary_source::value(const Type &type) {
  const char *bytes = at_;
  skip(type, 1);
  return type.of_bytes(bytes, big_endian_);
}

/* ---- Elements ---- */

constexpr size_t NONE = SIZE_MAX;

/* Which properties of an element have three names; NONE if they are not all
 * there. */
struct Three {
  std::array<size_t, 3> at{NONE, NONE, NONE};
  bool there = false;

  Three(const Element &element, std::array<Word, 3> names, bool bytes) {
    for (size_t p = 0; p < element.properties.size(); p++)
      for (size_t k = 0; k < 3; k++) {
        const Property &property = element.properties[p];
        const Type &type = *property.type;
        if (property.name == names[k] && !property.count_type &&
            (!bytes || (type.size == 1 && type.most == 255)))
          at[k] = p;
      }
    there = at[0] != NONE && at[1] != NONE && at[2] != NONE;
  }
};

Three colours_of(const Element &element) {
  const Three whole(element, {"red", "green", "blue"}, true);
  return whole.there ? whole : Three(element, {"r", "g", "b"}, true);
}

template <class Source> class Reader {
public:
  Reader(const ply::Header &header, Source source, Mesh_builder &builder)
      : header_(header), source_(source), builder_(builder) {
    for (size_t byte = 0; byte < linear_.size(); byte++)
      linear_[byte] = hsr_srgb_decode(static_cast<float>(byte) / 255.0f);
  }
  void read();

private:
  void values(const Element &element, size_t number, bool is_face);
  void list(const Property &property, size_t number, bool is_face);
  void indices(const Type &type, size_t n, size_t face);
  void vertices(const Element &element);
  void faces(const Element &element);
  void others(const Element &element);
  void colour(const Three &colours, float rgb[3]) const;
  void give();

  const ply::Header &header_;
  Source source_;
  Mesh_builder &builder_;
  std::vector<double> value_;     /* of the current element, by property */
  std::vector<uint32_t> corners_; /* of faces that are not given yet */
  std::vector<size_t> ends_;      /* where each of these ends in corners_ */
  std::vector<float> face_rgb_;   /* of each of these; or empty */
  std::vector<float> vertex_rgb_; /* of all vertices; or empty */
  bool has_vertices_ = false;     /* they are given */
  bool has_one_sided_ = false, has_two_sided_ = false; /* faces */
  std::array<float, 256> linear_; /* of a byte of a colour */
};

template <class Source>
void Reader<Source>::indices(const Type &type, size_t n, size_t face) {
  const size_t n_vertices = header_.elements[header_.vertices].n;
  const size_t first = corners_.size();
  for (size_t k = 0; k < n; k++) {
    const double v = source_.value(type);
    if (v < 0 || v >= static_cast<double>(n_vertices))
      source_.refuse("face %zu names vertex %.0f of %zu", face, v, n_vertices);
    corners_.push_back(static_cast<uint32_t>(v));
  }
  const char *fault =
      builder_.strict() ? face_fault(corners_.data() + first, n) : nullptr;
  if (fault)
    source_.refuse("face %zu %s", face, fault);
}

template <class Source>
void Reader<Source>::list(const Property &property, size_t number,
                          bool is_face) {
  const double n = source_.value(*property.count_type);
  if (n < 0)
    source_.refuse("element %zu has a list of length %.0f", number, n);
  if (is_face && property.name == header_.index_list)
    indices(*property.type, static_cast<size_t>(n), number);
  else
    source_.skip(*property.type, static_cast<size_t>(n));
}

template <class Source>
void Reader<Source>::values(const Element &element, size_t number,
                            bool is_face) {
  source_.start(element, number);
  for (size_t p = 0; p < element.properties.size(); p++) {
    const Property &property = element.properties[p];
    if (property.count_type)
      list(property, number, is_face);
    else
      value_[p] = source_.value(*property.type);
  }
  source_.finish();
}

template <class Source>
void Reader<Source>::colour(const Three &colours, float rgb[3]) const {
  for (size_t k = 0; k < 3; k++)
    rgb[k] = linear_[static_cast<size_t>(value_[colours.at[k]])];
}

template <class Source> void Reader<Source>::vertices(const Element &element) {
  const Three place(element, {"x", "y", "z"}, false);
  const Three colours = colours_of(element);
  if (colours.there)
    vertex_rgb_.resize(3 * element.n);
  for (size_t v = 0; v < element.n; v++) {
    values(element, v, false);
    builder_.vertex(value_[place.at[0]], value_[place.at[1]],
                    value_[place.at[2]]);
    if (colours.there)
      colour(colours, &vertex_rgb_[3 * v]);
  }
  has_vertices_ = true;
  give();
}

/* Gives the builder the faces read so far. */
template <class Source> void Reader<Source>::give() {
  for (size_t f = 0, first = 0; f < ends_.size(); first = ends_[f++]) {
    const uint32_t *corners = corners_.data() + first; /* of none, too */
    const size_t n = ends_[f] - first;
    float rgb[3];
    builder_.face(corners, n,
                  face_rgb_.empty() ? mean_colour(vertex_rgb_, corners, n, rgb)
                                    : &face_rgb_[3 * f]);
  }
  corners_.clear();
  ends_.clear();
  face_rgb_.clear();
}

/* Faces that come before the vertices wait for them. */
template <class Source> void Reader<Source>::faces(const Element &element) {
  const Three colours = colours_of(element);
  const Property *sides = find_property(element, "one_sided");
  const size_t side = sides && !sides->count_type
                          ? static_cast<size_t>(sides - &element.properties[0])
                          : NONE;
  for (size_t f = 0; f < element.n; f++) {
    values(element, f, true);
    if (side != NONE)
      (value_[side] != 0 ? has_one_sided_ : has_two_sided_) = true;
    ends_.push_back(corners_.size());
    if (colours.there) {
      face_rgb_.resize(3 * ends_.size());
      colour(colours, &face_rgb_[3 * ends_.size() - 3]);
    }
    if (has_vertices_)
      give();
  }
  if (has_one_sided_ && has_two_sided_)
    builder_.note("'one_sided' is passed over: it differs between faces, and "
                  "hsr takes one value for a file");
  else if (side != NONE)
    builder_.set_one_sided(has_one_sided_);
}

template <class Source> void Reader<Source>::others(const Element &element) {
  for (size_t number = 0; number < element.n; number++)
    values(element, number, false);
}

template <class Source> void Reader<Source>::read() {
  const std::vector<Element> &elements = header_.elements;
  builder_.reserve(elements[header_.vertices].n, elements[header_.faces].n);
  for (size_t e = 0; e < elements.size(); e++) {
    value_.assign(elements[e].properties.size(), 0);
    if (e == header_.vertices)
      vertices(elements[e]);
    else if (e == header_.faces)
      faces(elements[e]);
    else
      others(elements[e]);
  }
  source_.end();
}

} // namespace

/* Makes the lines of a file end in LF or CR LF, of a binary file those of its
 * header. */
static void make_plain(Mesh_file &file) {
  constexpr Word END = "end_header", BINARY = "format binary";
  const bool wide =
      file.size() > 1 && (file.begin[1] == '\0' || file.begin[0] == '\xff' ||
                          file.begin[0] == '\xfe');
  if (wide)
    return make_plain_text(file);
  skip_byte_order_mark(file);
  const Word all(file.begin, file.size());
  const size_t end = all.find(END), binary = all.substr(0, end).find(BINARY);
  if (end == Word::npos || binary == Word::npos)
    return make_plain_text(file);
  /* A CR at the header's end is a line end if others are: a byte LF behind it is
   * of the first record then. */
  char *past = file.begin + end + END.size();
  const size_t first = all.find('\r');
  const bool alone = first < end && all[first + 1] != '\n';
  end_lines(file.begin, past);
  if (alone && past < file.end && *past == '\r')
    *past = '\n';
}

void ply_read(Mesh_file &file, Mesh_builder &builder) {
  make_plain(file);
  ply::Header header(file);
  header.read();
  Text &text = header.text();
  if (ply::read_plain(header, text.at(), file.end, builder))
    return;
  if (header.format == Format::text)
    Reader<Text_source>(header, Text_source(text), builder).read();
  else
    Reader<Binary_source>(
        header,
        Binary_source(file, text.at(), header.format == Format::big_endian),
        builder)
        .read();
}

} // namespace hsr
