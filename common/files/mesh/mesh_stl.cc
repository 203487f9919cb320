// SPDX-License-Identifier: GPL-3.0-or-later
// Reads binary .stl files.
//
// Source      3D Systems, "StereoLithography Interface Specification"
// Vertices    a file has no vertex numbers: corners with the same coordinates
//             are one vertex. It gets its number where it is met first. 0 and -0
//             are the same. A hash table with open addressing finds them.
// Cost        a look into the table a corner, and one at the vertex that it names
#include "common/base/arena.h"
#include "common/files/mesh/mesh_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

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

uint64_t hash_of(const Place &place) {
  uint64_t sum = 0;
  for (float x : place) {
    const float no_sign_of_zero = x + 0.0f;
    uint32_t bits;
    std::memcpy(&bits, &no_sign_of_zero, sizeof bits);
    sum = (sum ^ bits) * 0x9e3779b97f4a7c15u;
    sum ^= sum >> 32;
  }
  return sum;
}

/* Gives the builder a vertex for each place, and numbers them. The builder's own
 * vertices are what places are compared with. */
class Places {
public:
  Places(size_t n, Mesh_builder &builder) : builder_(builder) {
    resize(least_size(n));
    make_room(n);
  }
  ~Places() { hsr_arena_free(&arena_); }
  Places(const Places &) = delete;
  Places &operator=(const Places &) = delete;

  /* The numbers of n places. What has not been met gets the next one. */
  void find(const Place *place, size_t n, uint32_t *number);

  size_t size() const { return n_; }

private:
  static constexpr size_t BLOCK = 64; /* looked for together */

  static size_t least_size(size_t n) {
    size_t size = 64;
    while (size < 2 * n)
      size *= 2;
    return size;
  }

  void resize(size_t size);
  void make_room(size_t n);
  void grow();
  uint32_t find_at(size_t slot, const Place &place);

  bool is_at(uint32_t number, const Place &place) const {
    const double *p = xyz_ + 3 * size_t{number};
    return p[0] == double{place[0]} && p[1] == double{place[1]} &&
           p[2] == double{place[2]};
  }
  Place place_of(size_t number) const {
    const double *p = xyz_ + 3 * number;
    return {float(p[0]), float(p[1]), float(p[2])};
  }

  Mesh_builder &builder_;
  hsr_arena arena_ = {}; /* of the slots: it has huge pages */
  uint32_t *slot_ =
      nullptr; /* a place's number + 1, or 0; at most half taken */
  size_t mask_ = 0;
  double *xyz_ = nullptr; /* the builder's */
  size_t n_ = 0, room_ = 0;
};

void Places::resize(size_t size) {
  hsr_arena_free(&arena_);
  slot_ = HSR_NEW_ZEROED(&arena_, uint32_t, size);
  if (!slot_)
    throw std::bad_alloc();
  mask_ = size - 1;
}

void Places::make_room(size_t n) {
  xyz_ = builder_.vertices(n);
  room_ = n;
}

/* A new table, twice as large. */
void Places::grow() {
  resize(2 * (mask_ + 1));
  for (size_t first = 0; first < n_; first += BLOCK) {
    size_t slot[BLOCK];
    const size_t n = std::min(BLOCK, n_ - first);
    for (size_t k = 0; k < n; k++) {
      slot[k] = hash_of(place_of(first + k)) & mask_;
      __builtin_prefetch(slot_ + slot[k], 1);
    }
    for (size_t k = 0; k < n; k++) {
      size_t s = slot[k];
      while (slot_[s])
        s = (s + 1) & mask_;
      slot_[s] = uint32_t(first + k + 1);
    }
  }
}

uint32_t Places::find_at(size_t s, const Place &place) {
  while (slot_[s] && !is_at(slot_[s] - 1, place))
    s = (s + 1) & mask_;
  if (!slot_[s]) {
    for (size_t k = 0; k < 3; k++)
      xyz_[3 * n_ + k] = double{place[k]};
    slot_[s] = uint32_t(++n_);
  }
  return slot_[s] - 1;
}

/* Slots and places are far apart in memory. They are asked for ahead of time. */
void Places::find(const Place *place, size_t n, uint32_t *number) {
  size_t slot[BLOCK];
  for (; n; n -= std::min(n, BLOCK), place += BLOCK, number += BLOCK) {
    const size_t some = std::min(n, BLOCK);
    while (2 * (n_ + some) > mask_ + 1)
      grow();
    if (n_ + some > room_)
      make_room(2 * (n_ + some));
    for (size_t k = 0; k < some; k++) {
      slot[k] = hash_of(place[k]) & mask_;
      __builtin_prefetch(slot_ + slot[k], 1);
    }
    for (size_t k = 0; k < some; k++)
      if (slot_[slot[k]])
        __builtin_prefetch(xyz_ + 3 * size_t{slot_[slot[k]] - 1});
    for (size_t k = 0; k < some; k++)
      number[k] = find_at(slot[k], place[k]);
  }
}

/* The facets of a file, some at a time. */
class Facets {
public:
  Facets(const Mesh_file &file, size_t n, Mesh_builder &builder)
      : file_(file), n_(n), builder_(builder), places_(n / 2 + 2, builder) {
  } /* as many as a closed surface has */
  void read();

private:
  static constexpr size_t SOME = 512;

  size_t look(size_t first, size_t n);
  void take(size_t n);
  bool are_different(const uint32_t *c) const {
    return c[0] != c[1] && c[1] != c[2] && c[2] != c[0];
  }

  const Mesh_file &file_;
  size_t n_;
  Mesh_builder &builder_;
  Places places_;
  Place place_[3 * SOME];
  uint32_t number_[3 * SOME];
};

/* How many of n facets are finite, up to the first that is not. */
size_t Facets::look(size_t first, size_t n) {
  const char *at = file_.begin + HEADER + COUNT + TRIANGLE * first + NORMAL;
  for (size_t f = 0; f < n; f++, at += TRIANGLE)
    for (size_t k = 0; k < 3; k++) {
      place_[3 * f + k] = place_at(at + sizeof(Place) * k);
      if (!is_finite(place_[3 * f + k]))
        return f;
    }
  return n;
}

/* Gives n facets to the builder. It looks at each only if some are to be dropped;
 * and at one that is bad, which it refuses. */
void Facets::take(size_t n) {
  places_.find(place_, 3 * n, number_);
  builder_.took_vertices(places_.size());
  size_t good = 0;
  while (good < n && !builder_.drops() && are_different(number_ + 3 * good))
    good++;
  if (good)
    std::memcpy(builder_.triangles(good), number_, 3 * good * sizeof *number_);
  for (size_t f = good; f < n; f++)
    builder_.face(number_ + 3 * f, 3, nullptr);
}

void Facets::read() {
  for (size_t first = 0; first < n_; first += SOME) {
    const size_t n = std::min(SOME, n_ - first), finite = look(first, n);
    take(finite);
    if (finite < n)
      file_.refuse(0, "facet %zu has a coordinate that is not finite",
                   first + finite);
  }
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
  builder.reserve(0, n);
  Facets(file, n, builder).read();
  return true;
}

} // namespace hsr
