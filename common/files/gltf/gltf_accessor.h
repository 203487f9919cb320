// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers in the buffers of a glTF file. Only for common/files/gltf.
//
// Source      "glTF 2.0 Specification", 3.6
// Safety      where an accessor ends is checked when it is opened, so that
//             reading needs no check but that of the element's number.
#ifndef HSR_COMMON_GLTF_ACCESSOR_H
#define HSR_COMMON_GLTF_ACCESSOR_H

#include "common/files/gltf/gltf_file.h"

#include <map>

namespace hsr {

/* Elements that follow one another in a buffer, or are all zero. */
struct Gltf_array {
  const char *first = nullptr; /* NULL: all are zero */
  size_t stride = 0, n = 0;
  unsigned type = 0;    /* of the numbers: 5120 and so on */
  size_t n_numbers = 1; /* in an element */
  bool is_normalized = false;

  bool is_float() const;
  /* Reads element i < n: n_numbers numbers. Normalized ones are divided. */
  void read(size_t i, double *to) const;
};

class Gltf_accessor {
public:
  /* Throws Refused and std::bad_alloc. */
  Gltf_accessor(Gltf_file &file, const Gltf_value &reference);

  size_t n() const { return array_.n; }
  size_t n_numbers() const { return array_.n_numbers; }
  bool is_float() const { return array_.is_float(); }
  bool is_normalized() const { return array_.is_normalized; }
  bool is_unsigned() const {
    return array_.type == 5121 || array_.type == 5123 || array_.type == 5125;
  }
  const std::string &place() const { return place_; }
  void read(size_t i, double *to) const;

private:
  size_t find_replaced(size_t i) const;

  Gltf_array array_;
  Gltf_array replaced_, values_; /* the numbers of some elements, ascending; and
                                    what takes their place */
  std::string place_;
};

/* The accessors of a file, each of which is opened once. */
class Gltf_accessors {
public:
  explicit Gltf_accessors(Gltf_file &file) : file_(file) {}
  const Gltf_accessor &operator[](const Gltf_value &reference);

private:
  Gltf_file &file_;
  std::map<size_t, Gltf_accessor> opened_;
};

} // namespace hsr

#endif
