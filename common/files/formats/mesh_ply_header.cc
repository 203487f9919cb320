// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/files/formats/mesh_ply_header.h"

#include <cstdint>

namespace hsr::ply {
namespace {

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

} // namespace

void Header::next_line() {
  if (!text_.next_line())
    text_.refuse("the file ends in its header");
}

Word Header::word(const char *what) {
  const Word taken = text_.word();
  if (taken.empty())
    text_.refuse("%s is missing", what);
  return taken;
}

void Header::signature() {
  next_line();
  const Word first = text_.word();
  if (first != "ply")
    text_.refuse("the file starts with '%s', not with ply",
                 shown_word(first).c_str());
  next_line();
  if (text_.word() != "format")
    text_.refuse("the second line does not start with 'format'");
  const Word name = word("the name of the format");
  if (name == "binary_little_endian")
    format = Format::little_endian;
  else if (name == "binary_big_endian")
    format = Format::big_endian;
  else if (name != "ascii")
    text_.refuse("'%s' is not a format", shown_word(name).c_str());
  word("the version of the format");
}

void Header::note(size_t &which, const char *what) {
  if (which != NONE)
    text_.refuse("there are two elements of %s", what);
  which = elements.size();
}

void Header::element() {
  const Word name = word("the name of an element");
  const Word number = word("the number of elements");
  long long n;
  if (!read_integer(number, n) || n < 0)
    text_.refuse("'%s' is not a number of elements",
                 shown_word(number).c_str());
  if (name == "vertex" || name == "vertices")
    note(vertices, "vertices");
  else if (name == "face" || name == "faces")
    note(faces, "faces");
  else if (name == "tristrips")
    note(strips, "strips");
  elements.push_back({name, static_cast<size_t>(n), {}});
}

const Type *Header::type() {
  const Word name = word("a type");
  const Type *found = find_type(name);
  if (!found)
    text_.refuse("'%s' is not a type", shown_word(name).c_str());
  return found;
}

void Header::property() {
  if (elements.empty())
    text_.refuse("a property comes before the first element");
  Property property{};
  const Word first = word("a type");
  if (first == "list") {
    property.count_type = type();
    if (property.count_type->is_real)
      text_.refuse("the length of a list is not an integer");
    property.type = type();
  } else if (!(property.type = find_type(first))) {
    text_.refuse("'%s' is not a type", shown_word(first).c_str());
  }
  property.name = word("the name of a property");
  for (const Property &other : elements.back().properties)
    if (other.name == property.name)
      text_.refuse("there are two properties '%s'",
                   shown_word(property.name).c_str());
  elements.back().properties.push_back(property);
}

const Property *find_property(const Element &element, Word name) {
  for (const Property &property : element.properties)
    if (property.name == name)
      return &property;
  return nullptr;
}

void Header::check_vertices() const {
  if (vertices == NONE)
    text_.refuse("there is no element 'vertex'");
  for (Word name : {"x", "y", "z"}) {
    const Property *found = find_property(elements[vertices], name);
    if (!found)
      text_.refuse("vertices have no property '%s'", name.data());
    if (found->count_type)
      text_.refuse("the property '%s' of vertices is a list", name.data());
  }
}

/* The list of vertex numbers of an element of faces or strips. */
const Property *Header::find_list(size_t which, const char *what) const {
  const Property *list = nullptr;
  if (which == NONE)
    return nullptr;
  for (Word name : {"vertex_indices", "vertex_index"}) {
    const Property *found = find_property(elements[which], name);
    if (!found)
      continue;
    if (list)
      text_.refuse("%s have two lists of vertices", what);
    if (!found->count_type || found->type->is_real)
      text_.refuse("the property '%s' of %s is not a list of integers",
                   name.data(), what);
    list = found;
  }
  if (!list)
    text_.refuse("%s have no property 'vertex_indices'", what);
  return list;
}

/* A header claims no more than the file can hold. */
void Header::check_sizes() const {
  const size_t left = static_cast<size_t>(file_.end - text_.at());
  for (const Element &element : elements) {
    const std::string name = shown_word(element.name);
    if (element.properties.empty())
      text_.refuse("the element '%s' has no properties", name.c_str());
    size_t least = 0;
    for (const Property &property : element.properties)
      least += format == Format::text ? 2
               : property.count_type  ? property.count_type->size
                                      : property.type->size;
    if (element.n > (left + 1) / least)
      text_.refuse("%zu elements '%s' are claimed, more than the %zu bytes "
                   "that follow can hold",
                   element.n, name.c_str(), left);
    if (element.n > static_cast<size_t>(MOST_ELEMENTS))
      text_.refuse("%zu elements '%s' are more than can be read", element.n,
                   name.c_str());
  }
}

void Header::read() {
  signature();
  for (;;) {
    next_line();
    const Word keyword = text_.word();
    if (keyword == "end_header")
      break;
    if (keyword == "element")
      element();
    else if (keyword == "property")
      property();
    else if (keyword != "comment" && keyword != "obj_info") {
      n_odd++;
      odd = keyword;
    }
  }
  text_.pass_line();
  check_sizes();
  check_vertices();
  of_face = find_list(faces, "faces");
  of_strip = find_list(strips, "strips");
  if (!of_face && !of_strip)
    text_.refuse("there is no element 'face' or 'tristrips'");
}

} // namespace hsr::ply
