// SPDX-License-Identifier: GPL-3.0-or-later
// The header of .ply files: elements and the types of their properties.
//
// Source      G. Turk, "The PLY Polygon File Format", 1994
// Departures  coordinates are float or double and vertex numbers int or uint.
#ifndef HSR_COMMON_MESH_PLY_HEADER_H
#define HSR_COMMON_MESH_PLY_HEADER_H

#include "common/files/mesh/mesh_text.h"

namespace hsr::ply {

struct Type : Number_type {
  Word name, other_name;
};

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

/* Returns the property of an element with this name; NULL: there is none. */
const Property *find_property(const Element &element, Word name);

/* Reads and checks the header of a file. A good header claims no more than the
 * file can hold, has vertices with coordinates, and has faces, strips of
 * triangles (element "tristrips"), or both, with one list of vertex numbers each.
 * Any other is refused: read() throws Refused. */
class Header {
public:
  explicit Header(const Mesh_file &file)
      : file_(file), text_(file, {0, false}) {}
  void read();

  Format format = Format::text;
  std::vector<Element> elements;
  static constexpr size_t NONE = SIZE_MAX;
  /* Their indices in elements[], or NONE. */
  size_t vertices = NONE, faces = NONE, strips = NONE;
  /* The lists of vertex numbers, of a face and of a strip, or NULL. */
  const Property *of_face = nullptr, *of_strip = nullptr;
  /* Lines that have no place in a header, and the first word of the last. */
  size_t n_odd = 0;
  Word odd;
  /* The text, which is behind the header once that is read. */
  Text &text() { return text_; }

private:
  Word word(const char *what);
  const Type *type();
  void next_line();
  void signature();
  void element();
  void property();
  void note(size_t &which, const char *what);
  void check_vertices() const;
  const Property *find_list(size_t which, const char *what) const;
  void check_sizes() const;

  const Mesh_file &file_;
  Text text_;
};

/* Reads the bytes [begin, end) behind the header of a binary file, if they are
 * plain (mesh_ply_plain.cc) and no face has to be refused or dropped. Otherwise
 * returns false, and the builder is given nothing. Throws std::bad_alloc. */
bool read_plain(const Header &header, const char *begin, const char *end,
                Mesh_builder &builder);

} // namespace hsr::ply

#endif
