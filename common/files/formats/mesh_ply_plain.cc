// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the .ply files that most programs write for large meshes: binary, of
// two elements, vertices whose properties are all real numbers, with no colours
// among them, and triangles with nothing but their vertex numbers. All records of an element have one
// size, so threads share them.
#include "common/base/share.h"
#include "common/files/formats/mesh_ply_header.h"

#include <cmath>
#include <cstring>

namespace hsr::ply {
namespace {

constexpr uint32_t RANGE = 16384; /* records for a thread at a time */
constexpr size_t TRIANGLE = 13;   /* bytes: 3, and three numbers */

/* As the file has them; it and the machine begin with the lowest byte. */
template <class Number> Number number_at(const char *bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return number;
}

double real_at(const char *bytes, size_t size) {
  return size == 4 ? double{number_at<float>(bytes)} : number_at<double>(bytes);
}

class Plain_reader {
public:
  Plain_reader(const Header &header, const char *at, Mesh_builder &builder)
      : vertex_(header.elements[0]), n_(header.elements[0].n),
        n_faces_(header.elements[1].n), at_(at), builder_(builder) {}
  bool read();

private:
  static uint32_t take_vertices(void *context, uint32_t from, uint32_t to);
  static uint32_t take_triangles(void *context, uint32_t from, uint32_t to);
  void take_vertex(const char *at, double *p) const;

  const Element &vertex_;
  size_t n_, n_faces_, size_ = 0; /* of a vertex, in bytes */
  const char *at_;
  size_t where_[3] = {0, 0, 0}; /* x, y, z, among the properties */
  Mesh_builder &builder_;
  double *xyz_ = nullptr;
  uint32_t *corners_ = nullptr;
};

void Plain_reader::take_vertex(const char *at, double *p) const {
  for (size_t k = 0; k < vertex_.properties.size(); k++) {
    const size_t size = vertex_.properties[k].type->size;
    const double value = real_at(at, size);
    for (size_t a = 0; a < 3; a++)
      if (where_[a] == k)
        p[a] = value;
    at += size;
  }
}

uint32_t Plain_reader::take_vertices(void *context, uint32_t from,
                                     uint32_t to) {
  const Plain_reader &r = *static_cast<const Plain_reader *>(context);
  for (uint32_t v = from; v < to; v++)
    r.take_vertex(r.at_ + r.size_ * v, r.xyz_ + 3 * size_t{v});
  return to;
}

uint32_t Plain_reader::take_triangles(void *context, uint32_t from,
                                      uint32_t to) {
  const Plain_reader &r = *static_cast<const Plain_reader *>(context);
  const char *at = r.at_ + r.size_ * r.n_ + TRIANGLE * from;
  for (uint32_t f = from; f < to; f++, at += TRIANGLE) {
    uint32_t *c = r.corners_ + 3 * size_t{f};
    std::memcpy(c, at + 1, 3 * sizeof *c);
    if (*at != 3 || c[0] >= r.n_ || c[1] >= r.n_ || c[2] >= r.n_ ||
        c[0] == c[1] || c[1] == c[2] || c[2] == c[0])
      return f;
  }
  return to;
}

bool Plain_reader::read() {
  const int threads = builder_.threads();
  const uint32_t n = uint32_t(n_), n_faces = uint32_t(n_faces_);
  for (size_t k = 0; k < vertex_.properties.size(); k++) {
    size_ += vertex_.properties[k].type->size;
    for (size_t a = 0; a < 3; a++)
      if (vertex_.properties[k].name == Word(&"xyz"[a], 1))
        where_[a] = k;
  }
  xyz_ = builder_.vertices(n_);
  hsr_share_search(threads, n, RANGE, take_vertices, this);
  builder_.took_vertices(n_);
  corners_ = builder_.triangles(n_faces_);
  if (hsr_share_search(threads, n_faces, RANGE, take_triangles, this) < n_faces)
    builder_.forget();
  return builder_.n_given() == n_faces_;
}

/* The bytes of the records; 0: the file is of another kind. */
size_t plain_size(const Header &header) {
  constexpr size_t MOST = UINT32_MAX / 3 - 1;
  const std::vector<Element> &elements = header.elements;
  if (header.format != Format::little_endian || elements.size() != 2 ||
      header.vertices != 0 || header.faces != 1 || elements[0].n > MOST ||
      elements[1].n > MOST || elements[1].properties.size() != 1 ||
      find_property(elements[0], "red") ||
      find_property(elements[0], "diffuse_red") ||
      find_property(elements[0], "r"))
    return 0;
  const Property &list = elements[1].properties[0];
  size_t size = 0;
  for (const Property &property : elements[0].properties) {
    if (property.count_type || !property.type->is_real)
      return 0;
    size += property.type->size;
  }
  return list.count_type->size == 1 && list.type->size == 4 &&
                 !list.type->is_real
             ? size * elements[0].n + TRIANGLE * elements[1].n
             : 0;
}

} // namespace

bool read_plain(const Header &header, const char *begin, const char *end,
                Mesh_builder &builder) {
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
  const size_t size = plain_size(header);
  return size && size == static_cast<size_t>(end - begin) &&
         header.elements[1].n && Plain_reader(header, begin, builder).read();
#else
  return false;
#endif
}

} // namespace hsr::ply
