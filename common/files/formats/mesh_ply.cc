// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the .ply files, text and binary, that mesh_ply_plain.cc does not read.
//
// Source      see mesh_ply_header.h
// Colours     red, green, blue and alpha, or r, g, b and a. Bytes and 16 bits
//             mean 0 to 1; other integers are 0..255, and real numbers 0..1.
// Strips      each vertex after the second makes a triangle with the two before
//             it, the second and every other one turned. A negative number ends
//             the strip. A triangle with a vertex twice only joins two strips.
// Departures  a text has one element a line
// Cost        each value is read once
#include "common/files/mesh/mesh_colours.h"
#include "common/files/formats/mesh_ply_header.h"

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

constexpr size_t NONE = ply::Header::NONE;

/* Where an element has a property that is one number; NONE: nowhere. */
size_t find_number(const Element &element, Word name) {
  const Property *found = find_property(element, name);
  return found && !found->count_type
             ? static_cast<size_t>(found - &element.properties[0])
             : NONE;
}

/* The properties of an element that are a colour, and perhaps an opacity. */
class Colours {
public:
  explicit Colours(const Element &element) {
    for (const auto &names :
         {std::array<Word, 4>{"red", "green", "blue", "alpha"},
          std::array<Word, 4>{"diffuse_red", "diffuse_green", "diffuse_blue",
                              "diffuse_alpha"},
          std::array<Word, 4>{"r", "g", "b", "a"}}) {
      for (size_t k = 0; k < 4; k++)
        at_[k] = find_number(element, names[k]);
      there = at_[0] != NONE && at_[1] != NONE && at_[2] != NONE;
      if (there)
        break;
    }
    for (size_t k = 0; k < 4 && there; k++)
      if (at_[k] != NONE)
        most_[k] = most_of(*element.properties[at_[k]].type);
  }

  /* As the file encodes it, 0..1. */
  Rgba encoded(const std::vector<double> &values) const {
    Rgba rgba{0, 0, 0, NO_OPACITY};
    for (size_t k = 0; k < 4; k++)
      if (at_[k] != NONE)
        rgba[k] = static_cast<float>(std::max(values[at_[k]], 0.0) / most_[k]);
    return rgba;
  }

  bool there = false;

private:
  static double most_of(const Type &type) {
    return type.is_real ? 1 : type.size == 2 ? type.most : 255;
  }

  std::array<size_t, 4> at_{};
  std::array<double, 4> most_{1, 1, 1, 1};
};

template <class Source> class Reader {
public:
  Reader(const ply::Header &header, Source source, Mesh_builder &builder)
      : header_(header), source_(source), builder_(builder) {}
  void read();

private:
  void values(const Element &element, size_t number, const Property *list);
  void indices(const Property &property, size_t number);
  void add_face(size_t number);
  void add_strip(size_t number);
  void end_face(const Rgba *look);
  void vertices(const Element &element);
  void faces(const Element &element);
  void strips(const Element &element);
  void others(const Element &element);
  void give();

  const ply::Header &header_;
  Source source_;
  Mesh_builder &builder_;
  std::vector<double> value_;     /* of the current element, by property */
  std::vector<double> list_;      /* its list of vertex numbers */
  std::vector<uint32_t> corners_; /* of faces that are not given yet */
  std::vector<size_t> ends_;      /* where each of these ends in corners_ */
  std::vector<Rgba> of_faces_;    /* of each of these; or empty */
  std::vector<Rgba> of_vertices_; /* of all vertices; or empty */
  bool has_vertices_ = false;     /* they are given */
  bool has_one_sided_ = false, has_two_sided_ = false; /* faces */
};

template <class Source>
void Reader<Source>::indices(const Property &property, size_t number) {
  const double n = source_.value(*property.count_type);
  if (n < 0)
    source_.refuse("element %zu has a list of length %.0f", number, n);
  list_.clear();
  for (double k = 0; k < n; k++)
    list_.push_back(source_.value(*property.type));
}

/* The values of an element, and one of its lists; the others are passed over. */
template <class Source>
void Reader<Source>::values(const Element &element, size_t number,
                            const Property *list) {
  source_.start(element, number);
  for (size_t p = 0; p < element.properties.size(); p++) {
    const Property &property = element.properties[p];
    if (!property.count_type) {
      value_[p] = source_.value(*property.type);
    } else if (&property == list) {
      indices(property, number);
    } else {
      const double n = source_.value(*property.count_type);
      if (n < 0)
        source_.refuse("element %zu has a list of length %.0f", number, n);
      source_.skip(*property.type, static_cast<size_t>(n));
    }
  }
  source_.finish();
}

template <class Source> void Reader<Source>::vertices(const Element &element) {
  const size_t at[3] = {find_number(element, "x"), find_number(element, "y"),
                        find_number(element, "z")};
  const Colours colours(element);
  if (colours.there)
    of_vertices_.reserve(element.n);
  for (size_t v = 0; v < element.n; v++) {
    values(element, v, nullptr);
    builder_.vertex(value_[at[0]], value_[at[1]], value_[at[2]]);
    if (colours.there)
      of_vertices_.push_back(rgba_of_file(colours.encoded(value_)));
  }
  has_vertices_ = true;
  give();
}

/* Gives the builder the faces read so far. */
template <class Source> void Reader<Source>::give() {
  for (size_t f = 0, first = 0; f < ends_.size(); first = ends_[f++]) {
    const uint32_t *corners = corners_.data() + first; /* of none, too */
    const size_t n = ends_[f] - first;
    Rgba mean;
    builder_.face(corners, n,
                  of_faces_.empty()
                      ? mean_colour(of_vertices_, corners, n, &mean)
                      : &of_faces_[f]);
  }
  corners_.clear();
  ends_.clear();
  of_faces_.clear();
}

/* Faces that come before the vertices wait for them. */
template <class Source> void Reader<Source>::end_face(const Rgba *look) {
  ends_.push_back(corners_.size());
  if (look)
    of_faces_.push_back(*look);
  if (has_vertices_)
    give();
}

/* The face in list_. */
template <class Source> void Reader<Source>::add_face(size_t number) {
  const size_t n_vertices = header_.elements[header_.vertices].n;
  const size_t first = corners_.size();
  for (const double v : list_) {
    if (v < 0 || v >= static_cast<double>(n_vertices))
      source_.refuse("face %zu names vertex %.0f of %zu", number, v,
                     n_vertices);
    corners_.push_back(static_cast<uint32_t>(v));
  }
  const char *fault = builder_.strict()
                          ? face_fault(corners_.data() + first, list_.size())
                          : nullptr;
  if (fault)
    source_.refuse("face %zu %s", number, fault);
}

template <class Source> void Reader<Source>::faces(const Element &element) {
  const Colours colours(element);
  const size_t side = find_number(element, "one_sided");
  for (size_t f = 0; f < element.n; f++) {
    values(element, f, header_.of_face);
    if (side != NONE)
      (value_[side] != 0 ? has_one_sided_ : has_two_sided_) = true;
    add_face(f);
    const Rgba look =
        colours.there ? rgba_of_file(colours.encoded(value_)) : Rgba{};
    end_face(colours.there ? &look : nullptr);
  }
  if (has_one_sided_ && has_two_sided_)
    builder_.note("'one_sided' is passed over: it differs between faces, and "
                  "hsr takes one value for a file");
  else if (side != NONE)
    builder_.set_one_sided(has_one_sided_);
}

/* The strip in list_, or several. */
template <class Source> void Reader<Source>::add_strip(size_t number) {
  const size_t n_vertices = header_.elements[header_.vertices].n;
  size_t n = 0; /* vertices of the strip so far */
  for (size_t k = 0; k < list_.size(); k++) {
    n = list_[k] < 0 ? 0 : n + 1;
    if (list_[k] >= static_cast<double>(n_vertices))
      source_.refuse("strip %zu names vertex %.0f of %zu", number, list_[k],
                     n_vertices);
    if (n < 3)
      continue;
    uint32_t corner[3];
    for (size_t c = 0; c < 3; c++)
      corner[c] = static_cast<uint32_t>(list_[k - 2 + c]);
    if (n % 2 == 0)
      std::swap(corner[0], corner[1]);
    if (corner[0] == corner[1] || corner[1] == corner[2] ||
        corner[2] == corner[0])
      continue;
    corners_.insert(corners_.end(), corner, corner + 3);
    end_face(nullptr);
  }
}

template <class Source> void Reader<Source>::strips(const Element &element) {
  for (size_t s = 0; s < element.n; s++) {
    values(element, s, header_.of_strip);
    add_strip(s);
  }
}

template <class Source> void Reader<Source>::others(const Element &element) {
  for (size_t number = 0; number < element.n; number++)
    values(element, number, nullptr);
  if (element.n)
    builder_.note(std::to_string(element.n) + " element" +
                  (element.n > 1 ? "s '" : " '") + shown_word(element.name) +
                  "' passed over");
}

template <class Source> void Reader<Source>::read() {
  const std::vector<Element> &elements = header_.elements;
  builder_.reserve(elements[header_.vertices].n,
                   header_.of_face ? elements[header_.faces].n : 0);
  for (size_t e = 0; e < elements.size(); e++) {
    value_.assign(elements[e].properties.size(), 0);
    if (e == header_.vertices)
      vertices(elements[e]);
    else if (e == header_.faces)
      faces(elements[e]);
    else if (e == header_.strips)
      strips(elements[e]);
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
  if (header.n_odd)
    builder.note(std::to_string(header.n_odd) +
                 (header.n_odd > 1 ? " lines" : " line") +
                 " of the header passed over: '" + shown_word(header.odd) +
                 "' has no place there");
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
