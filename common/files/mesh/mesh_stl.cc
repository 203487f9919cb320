// SPDX-License-Identifier: GPL-3.0-or-later
// Reads binary .stl files.
//
// Source      3D Systems, "StereoLithography Interface Specification"
// Vertices    a file has no vertex numbers: corners with the same coordinates
//             are one vertex. It gets its number where it is met first. 0 and -0
//             are the same. A hash table with open addressing finds them.
// Cost        a look into the table a corner
#include "common/files/mesh/mesh_text.h"

#include <array>
#include <cmath>
#include <cstring>
#include <vector>

namespace hsr {
namespace {

constexpr size_t HEADER = 80, COUNT = 4, TRIANGLE = 50, NORMAL = 12;

uint32_t little_endian(const char *bytes) {
  unsigned char byte[4];
  std::memcpy(byte, bytes, sizeof byte);
  return uint32_t{byte[0]} | uint32_t{byte[1]} << 8 | uint32_t{byte[2]} << 16 |
         uint32_t{byte[3]} << 24;
}

using Place = std::array<float, 3>;

/* The number of each place. */
class Places {
public:
  explicit Places(size_t n) : slot_(least_size(n), NONE) { place_.reserve(n); }

  /* The number of a place; `is_new` if it has not been met. */
  uint32_t find(const Place &place, bool &is_new) {
    if (2 * place_.size() >= slot_.size())
      grow();
    size_t s = slot_of(place);
    is_new = slot_[s] == NONE;
    if (is_new) {
      slot_[s] = static_cast<uint32_t>(place_.size());
      place_.push_back(place);
    }
    return slot_[s];
  }

private:
  static constexpr uint32_t NONE = UINT32_MAX;

  static size_t least_size(size_t n) {
    size_t size = 64;
    while (size < 2 * n)
      size *= 2;
    return size;
  }

  static size_t hash(const Place &place) {
    uint64_t sum = 0;
    for (float x : place) {
      const float no_sign_of_zero = x + 0.0f;
      uint32_t bits;
      std::memcpy(&bits, &no_sign_of_zero, sizeof bits);
      sum = (sum ^ bits) * 0x9e3779b97f4a7c15u;
      sum ^= sum >> 32;
    }
    return static_cast<size_t>(sum);
  }

  /* Where a place is, or else a free slot. */
  size_t slot_of(const Place &place) const {
    const size_t mask = slot_.size() - 1;
    size_t s = hash(place) & mask;
    while (slot_[s] != NONE && place_[slot_[s]] != place)
      s = (s + 1) & mask;
    return s;
  }

  void grow() {
    slot_.assign(2 * slot_.size(), NONE);
    for (size_t k = 0; k < place_.size(); k++)
      slot_[slot_of(place_[k])] = static_cast<uint32_t>(k);
  }

  std::vector<uint32_t> slot_; /* at most half of them are taken */
  std::vector<Place> place_;
};

Place place_at(const char *bytes) {
  Place place;
  for (size_t k = 0; k < 3; k++) {
    const uint32_t bits = little_endian(bytes + 4 * k);
    std::memcpy(&place[k], &bits, sizeof place[k]);
  }
  return place;
}

bool is_finite(const Place &place) {
  return std::isfinite(place[0]) && std::isfinite(place[1]) &&
         std::isfinite(place[2]);
}

} // namespace

void refuse_stl(const Mesh_file &file) {
  if (file.size() < HEADER + COUNT)
    file.refuse(0,
                "is no STL: it neither starts with 'solid' nor has the %zu "
                "bytes of a binary header",
                HEADER + COUNT);
  const size_t n = little_endian(file.begin + HEADER);
  file.refuse(0,
              "is no STL: it does not start with 'solid', and %zu binary "
              "facets take %zu bytes, not %zu",
              n, HEADER + COUNT + TRIANGLE * n, file.size());
}

bool binary_stl_read(Mesh_file &file, Mesh_builder &builder) {
  if (file.size() < HEADER + COUNT)
    return false;
  const size_t n = little_endian(file.begin + HEADER);
  if (file.size() != HEADER + COUNT + TRIANGLE * n)
    return false;
  if (n > static_cast<size_t>(MOST_ELEMENTS))
    file.refuse(0, "%zu facets are more than can be read", n);
  Places places(n / 2 + 2); /* as many as a closed surface has */
  builder.reserve(n / 2 + 2, n);
  const char *at = file.begin + HEADER + COUNT;
  for (size_t f = 0; f < n; f++, at += TRIANGLE) {
    uint32_t corner[3];
    for (size_t k = 0; k < 3; k++) {
      const Place place = place_at(at + NORMAL + sizeof place * k);
      if (!is_finite(place))
        file.refuse(0, "facet %zu has a coordinate that is not finite", f);
      bool is_new;
      corner[k] = places.find(place, is_new);
      if (is_new)
        builder.vertex(place[0], place[1], place[2]);
    }
    builder.face(corner, 3, nullptr);
  }
  return true;
}

} // namespace hsr
