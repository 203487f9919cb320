// SPDX-License-Identifier: GPL-3.0-or-later
// The grammar of .ply files, text and binary.
//
// Source      G. Turk, "The PLY Polygon File Format", 1994
// Departures  as CGAL's reader has it, coordinates are float or double and
//             vertex numbers int or uint; a text has one element a line.
#include "common/files/mesh/mesh_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace hsr {
namespace {

struct Type : Number_type {
  Word name, other_name;
};

constexpr Type TYPES[] = {{{1, false, -128, 127}, "char", "int8"},
                          {{1, false, 0, 255}, "uchar", "uint8"},
                          {{2, false, -32768, 32767}, "short", "int16"},
                          {{2, false, 0, 65535}, "ushort", "uint16"},
                          {{4, false, INT32_MIN, INT32_MAX}, "int", "int32"},
                          {{4, false, 0, UINT32_MAX}, "uint", "uint32"},
                          {{4, true, 0, 0}, "float", "float32"},
                          {{8, true, 0, 0}, "double", "float64"}};

const Type *find_type(Word name) {
  for (const Type &type : TYPES)
    if (name == type.name || name == type.other_name)
      return &type;
  return nullptr;
}

struct Property {
  Word name;
  const Type *type;
  const Type *count_type; /* of a list; else NULL */
};

struct Element {
  Word name;
  size_t n;
  std::vector<Property> properties;
};

enum class Format { text, little_endian, big_endian };

/* ---- The header ---- */

class Ply_header {
public:
  explicit Ply_header(const Mesh_file &file)
      : file_(file), lines_(file, {0, false}) {}
  void read();

  Format format = Format::text;
  std::vector<Element> elements;
  size_t vertices = NONE, faces = NONE; /* which of elements[] */
  Word index_list;                      /* the property of a face */
  Lines &lines() { return lines_; }

private:
  static constexpr size_t NONE = SIZE_MAX;

  Word word(const char *what);
  const Type *type();
  void next_line();
  void signature();
  void element();
  void property();
  void note(size_t &which, const char *what);
  void check_vertices() const;
  void check_faces();
  void check_sizes() const;
  void check_colours(const Element &element) const;

  const Mesh_file &file_;
  Lines lines_;
};

/* CGAL wants no empty lines. */
void Ply_header::next_line() {
  const size_t before = lines_.number();
  if (!lines_.next_line())
    lines_.refuse("the file ends in its header");
  if (lines_.number() != before + 1)
    lines_.refuse("there is an empty line before this one, in the header");
}

Word Ply_header::word(const char *what) {
  const Word taken = lines_.word();
  if (taken.empty())
    lines_.refuse("%s is missing", what);
  return taken;
}

void Ply_header::signature() {
  next_line();
  const Word first = lines_.word();
  if (first != "ply")
    lines_.refuse("the file starts with '%s', not with ply",
                  shown_word(first).c_str());
  next_line();
  if (lines_.word() != "format")
    lines_.refuse("the second line does not start with 'format'");
  const Word name = word("the name of the format");
  if (name == "binary_little_endian")
    format = Format::little_endian;
  else if (name == "binary_big_endian")
    format = Format::big_endian;
  else if (name != "ascii")
    lines_.refuse("'%s' is not a format", shown_word(name).c_str());
  word("the version of the format");
}

void Ply_header::note(size_t &which, const char *what) {
  if (which != NONE)
    lines_.refuse("there are two elements of %s", what);
  which = elements.size();
}

void Ply_header::element() {
  const Word name = word("the name of an element");
  const Word number = word("the number of elements");
  long long n;
  if (!read_integer(number, n) || n < 0)
    lines_.refuse("'%s' is not a number of elements",
                  shown_word(number).c_str());
  if (name == "vertex" || name == "vertices")
    note(vertices, "vertices");
  else if (name == "face" || name == "faces")
    note(faces, "faces");
  else
    /* CGAL trips over half-edges whose properties are not what it expects. */
    *const_cast<char *>(name.data()) = '_';
  elements.push_back({name, static_cast<size_t>(n), {}});
}

const Type *Ply_header::type() {
  const Word name = word("a type");
  const Type *found = find_type(name);
  if (!found)
    lines_.refuse("'%s' is not a type", shown_word(name).c_str());
  return found;
}

void Ply_header::property() {
  if (elements.empty())
    lines_.refuse("a property comes before the first element");
  Property property{};
  const Word first = word("a type");
  if (first == "list") {
    property.count_type = type();
    if (property.count_type->is_real)
      lines_.refuse("the length of a list is not an integer");
    property.type = type();
  } else if (!(property.type = find_type(first))) {
    lines_.refuse("'%s' is not a type", shown_word(first).c_str());
  }
  property.name = word("the name of a property");
  for (const Property &other : elements.back().properties)
    if (other.name == property.name)
      lines_.refuse("there are two properties '%s'",
                    shown_word(property.name).c_str());
  elements.back().properties.push_back(property);
}

const Property *find_property(const Element &element, Word name) {
  for (const Property &property : element.properties)
    if (property.name == name)
      return &property;
  return nullptr;
}

void Ply_header::check_vertices() const {
  if (vertices == NONE)
    lines_.refuse("there is no element 'vertex'");
  for (Word name : {"x", "y", "z"}) {
    const Property *found = find_property(elements[vertices], name);
    if (!found)
      lines_.refuse("vertices have no property '%s'", name.data());
    if (found->count_type || !found->type->is_real)
      lines_.refuse("the property '%s' of vertices is not float or double",
                    name.data());
  }
}

void Ply_header::check_faces() {
  if (faces == NONE)
    lines_.refuse("there is no element 'face'");
  for (Word name : {"vertex_indices", "vertex_index"}) {
    const Property *found = find_property(elements[faces], name);
    if (!found)
      continue;
    if (!index_list.empty())
      lines_.refuse("faces have two lists of vertices");
    if (!found->count_type || found->type->size != 4 || found->type->is_real)
      lines_.refuse("the property '%s' of faces is not a list of int or uint",
                    name.data());
    index_list = found->name;
  }
  if (index_list.empty())
    lines_.refuse("faces have no property 'vertex_indices'");
}

/* CGAL looks for one of two names and then reads the other. */
void Ply_header::check_colours(const Element &element) const {
  for (auto [name, letter] :
       {std::pair<Word, Word>{"red", "r"}, {"green", "g"}, {"blue", "b"}})
    if (find_property(element, name) && find_property(element, letter))
      lines_.refuse("there are properties '%s' and '%s'", name.data(),
                    letter.data());
}

/* A header claims no more than the file can hold. */
void Ply_header::check_sizes() const {
  const size_t left = static_cast<size_t>(file_.end - lines_.rest_of_file());
  for (const Element &element : elements) {
    const std::string name = shown_word(element.name);
    if (element.properties.empty())
      lines_.refuse("the element '%s' has no properties", name.c_str());
    size_t least = 0;
    for (const Property &property : element.properties)
      least += format == Format::text ? 2
               : property.count_type  ? property.count_type->size
                                      : property.type->size;
    if (element.n > (left + 1) / least)
      lines_.refuse("%zu elements '%s' are claimed, more than the %zu bytes "
                    "that follow can hold",
                    element.n, name.c_str(), left);
    if (element.n > static_cast<size_t>(MOST_ELEMENTS))
      lines_.refuse("%zu elements '%s' are more than can be read", element.n,
                    name.c_str());
    check_colours(element);
  }
}

void Ply_header::read() {
  signature();
  for (;;) {
    next_line();
    const Word keyword = lines_.word();
    if (keyword == "end_header")
      break;
    if (keyword == "element")
      element();
    else if (keyword == "property")
      property();
    else if (keyword != "comment" && keyword != "obj_info")
      lines_.refuse("'%s' has no place in a header",
                    shown_word(keyword).c_str());
  }
  check_sizes();
  check_vertices();
  check_faces();
}

/* ---- The data ---- */

/* Both sources of values have: start and finish of an element, the next value
 * of a type, passing over n values, the end of all, and refuse. */
class Text_source {
public:
  explicit Text_source(Lines &lines) : lines_(lines) {}

  void start(const Element &element, size_t number) {
    name_ = shown_word(element.name);
    number_ = number;
    if (!lines_.next_line())
      lines_.refuse("the file ends after %zu of %zu elements '%s'", number,
                    element.n, name_.c_str());
  }
  double value(const Type &type);
  void skip(const Type &type, size_t n) {
    for (size_t k = 0; k < n; k++)
      value(type);
  }
  void finish() {
    if (!lines_.word().empty())
      lines_.refuse("%s %zu has more values than its properties", name_.c_str(),
                    number_);
  }
  void end() {
    if (lines_.next_line())
      lines_.refuse("the file goes on after the last element");
  }
  template <class... Values>
  [[noreturn]] void refuse(const char *format, Values... values) const {
    lines_.refuse(format, values...);
  }

private:
  Lines &lines_;
  std::string name_;
  size_t number_ = 0;
};

double Text_source::value(const Type &type) {
  const Word word = lines_.word();
  if (word.empty())
    lines_.refuse("%s %zu has fewer values than its properties", name_.c_str(),
                  number_);
  if (type.is_real)
    return type.size == 4
               ? double{lines_.real<float>(word, name_.c_str(), number_)}
               : lines_.real<double>(word, name_.c_str(), number_);
  long long integer;
  if (!read_integer(word, integer))
    lines_.refuse("%s %zu: '%s' is not an integer", name_.c_str(), number_,
                  shown_word(word).c_str());
  const double number = static_cast<double>(integer);
  if (number < type.least || number > type.most)
    lines_.refuse("%s %zu: %s is out of the range of %s", name_.c_str(),
                  number_, shown_word(word).c_str(), type.name.data());
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

template <class Source> class Ply_walk {
public:
  Ply_walk(const Ply_header &header, Source source, bool drop)
      : header_(header), source_(source), checker_(drop) {}
  void walk(Mesh_extent &extent);

private:
  void list(const Property &property, size_t number, bool is_face);
  void indices(const Type &type, size_t n, size_t face);

  const Ply_header &header_;
  Source source_;
  Face_checker checker_;
  size_t n_corners_ = 0;
};

template <class Source>
void Ply_walk<Source>::indices(const Type &type, size_t n, size_t face) {
  const size_t n_vertices = header_.elements[header_.vertices].n;
  checker_.start();
  for (size_t k = 0; k < n; k++) {
    const double v = source_.value(type);
    if (v < 0 || v >= static_cast<double>(n_vertices))
      source_.refuse("face %zu names vertex %.0f of %zu", face, v, n_vertices);
    checker_.add(static_cast<size_t>(v));
  }
  if (const char *fault = checker_.fault())
    source_.refuse("face %zu %s", face, fault);
  n_corners_ += n;
}

template <class Source>
void Ply_walk<Source>::list(const Property &property, size_t number,
                            bool is_face) {
  const double n = source_.value(*property.count_type);
  if (n < 0)
    source_.refuse("element %zu has a list of length %.0f", number, n);
  if (is_face && property.name == header_.index_list)
    indices(*property.type, static_cast<size_t>(n), number);
  else
    source_.skip(*property.type, static_cast<size_t>(n));
}

template <class Source> void Ply_walk<Source>::walk(Mesh_extent &extent) {
  for (size_t e = 0; e < header_.elements.size(); e++) {
    const Element &element = header_.elements[e];
    for (size_t number = 0; number < element.n; number++) {
      source_.start(element, number);
      for (const Property &property : element.properties) {
        if (property.count_type) {
          list(property, number, e == header_.faces);
          continue;
        }
        const double value = source_.value(*property.type);
        if (e == header_.vertices && !std::isfinite(value))
          source_.refuse("vertex %zu has a value that is not finite", number);
      }
      source_.finish();
    }
  }
  source_.end();
  extent.n_corners = n_corners_;
}

} // namespace

Mesh_extent scan_ply(Mesh_file &file, bool drop) {
  skip_byte_order_mark(file);
  Ply_header header(file);
  header.read();
  Mesh_extent extent;
  extent.n_vertices = header.elements[header.vertices].n;
  extent.n_faces = header.elements[header.faces].n;
  if (header.format == Format::text)
    Ply_walk<Text_source>(header, Text_source(header.lines()), drop)
        .walk(extent);
  else
    Ply_walk<Binary_source>(header,
                            Binary_source(file, header.lines().rest_of_file(),
                                          header.format == Format::big_endian),
                            drop)
        .walk(extent);
  return extent;
}

} // namespace hsr
