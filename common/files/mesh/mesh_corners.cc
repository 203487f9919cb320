// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers the corners of loose triangles.
//
// Method      corners are named by their places in the file, from 0. First,
//             each corner looks for an equal one among those just before it.
//             Those that find none are sorted into parts by their hash. A
//             part's table is small enough for the cache; it tells the first of
//             equal corners. At last, first corners are numbered in order, and
//             the others take the number of theirs.
// Threads     share ranges of triangles, and parts. The result depends on the
//             corners alone: a vertex's number is the number of first corners
//             before it.
// Memory      8 bytes a corner that finds none before it, beside the object
#include "common/files/mesh/mesh_corners.h"
#include "common/base/arena.h"
#include "common/base/share.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <utility>

namespace hsr {
namespace {

constexpr uint32_t RANGE = 1 << 16;  /* triangles for a thread at a time */
constexpr uint32_t RECENT = 1 << 15; /* corners that are looked at again */
constexpr size_t PART = 1 << 14;     /* corners of a part, about */
constexpr uint32_t MOST_BITS = 12;   /* of a part's number */
constexpr uint32_t NONE = UINT32_MAX;
constexpr uint32_t LATER = uint32_t{1} << 31; /* equal to the corner that the
                                                 other bits name */

template <class Real> Real real_at(const char *bytes) {
  Real real;
  std::memcpy(&real, bytes, sizeof real);
  return real;
}

#if __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
template <> float real_at<float>(const char *bytes) {
  char turned[sizeof(float)];
  float real;
  std::reverse_copy(bytes, bytes + sizeof real, turned);
  std::memcpy(&real, turned, sizeof real);
  return real;
}
#endif

/* A hash of a number: its bits, mixed so that the low ones differ. -0 has the
 * hash of 0. */
uint64_t mixed_bits(float x) {
  const float no_sign_of_zero = x + 0.0f;
  uint32_t bits;
  std::memcpy(&bits, &no_sign_of_zero, sizeof bits);
  return bits;
}
uint64_t mixed_bits(double x) {
  const double no_sign_of_zero = x + 0.0;
  uint64_t bits;
  std::memcpy(&bits, &no_sign_of_zero, sizeof bits);
  return bits ^ bits >> 32;
}

/* A corner in a table. */
struct Entry {
  uint32_t tag; /* of its hash */
  uint32_t corner;
};

void clear(Entry *table, size_t n) {
  std::fill_n(table, n, Entry{0, NONE});
}

template <class Real> class Numbering {
public:
  Numbering(const Loose_triangles &triangles, Mesh_builder &builder);
  ~Numbering() { hsr_arena_free(&arena_); }
  Numbering(const Numbering &) = delete;
  Numbering &operator=(const Numbering &) = delete;

  /* Gives all; false if a triangle has a corner twice. */
  bool give();

private:
  using Place = std::array<Real, 3>;
  using Step = void (Numbering::*)(uint32_t range, int thread);

  Place place(uint32_t corner) const {
    const char *at = triangles_.first + triangles_.stride * (corner / 3) +
                     sizeof(Place) * (corner % 3);
    return {real_at<Real>(at), real_at<Real>(at + sizeof(Real)),
            real_at<Real>(at + 2 * sizeof(Real))};
  }
  static uint64_t hash_of(const Place &place);
  size_t part_of(uint64_t hash) const { return hash >> (64 - bits_); }
  template <class Item> Item *room(size_t n);
  template <Step step> void share(uint32_t n);
  template <class Work> void for_corners(uint32_t range, const Work &work);

  void look_back(uint32_t range, int thread);
  void make_parts();
  void sort_in(uint32_t range, int thread);
  void look_in_part(uint32_t part, int thread);
  void count_first(uint32_t range, int thread);
  void make_vertices();
  void number_first(uint32_t range, int thread);
  static uint32_t number_later(void *context, uint32_t from, uint32_t to);

  const Loose_triangles triangles_;
  Mesh_builder &builder_;
  const int threads_;
  const uint32_t n_, n_ranges_;
  uint32_t bits_ = 1;
  hsr_arena arena_ = {};
  uint32_t *vertex_;     /* the builder's. Of a corner: what is known so far */
  size_t *at_ = nullptr; /* of each range, for each part: how many corners, then
                            where the next is put */
  size_t *end_ = nullptr;       /* of each part */
  Entry *sorted_ = nullptr;     /* by part, then by corner */
  Entry *table_ = nullptr;      /* room for each thread */
  size_t table_size_ = RECENT;  /* of it */
  uint32_t *n_first_ = nullptr; /* corners in each range, then before it */
  double *xyz_ = nullptr;
};

template <class Real>
Numbering<Real>::Numbering(const Loose_triangles &triangles,
                           Mesh_builder &builder)
    : triangles_(triangles), builder_(builder),
      threads_(hsr_threads(builder.threads())), n_(uint32_t(triangles.n)),
      n_ranges_(hsr_n_ranges(n_, RANGE)), vertex_(builder.triangles(n_)) {
  while (bits_ < MOST_BITS && PART << bits_ < 3 * triangles.n)
    bits_++;
}

template <class Real> uint64_t Numbering<Real>::hash_of(const Place &place) {
  uint64_t sum = mixed_bits(place[0]) * 0x9e3779b97f4a7c15u +
                 mixed_bits(place[1]) * 0xc2b2ae3d27d4eb4fu +
                 mixed_bits(place[2]) * 0x165667b19e3779f9u;
  sum = (sum ^ sum >> 32) * 0xd6e8feb86659fd93u;
  return sum ^ sum >> 32;
}

template <class Real>
template <class Item>
Item *Numbering<Real>::room(size_t n) {
  Item *items = HSR_NEW(&arena_, Item, n);
  if (!items)
    throw std::bad_alloc();
  return items;
}

/* A step for all of n ranges, or parts. */
template <class Real>
template <void (Numbering<Real>::*step)(uint32_t, int)>
void Numbering<Real>::share(uint32_t n) {
  const auto part = [](void *context, uint32_t k, int thread) {
    (static_cast<Numbering *>(context)->*step)(k, thread);
  };
  hsr_share(threads_, n, part, this);
}

template <class Real>
template <class Work>
void Numbering<Real>::for_corners(uint32_t k, const Work &work) {
  const struct hsr_range range = hsr_range_of(n_, RANGE, k);
  for (uint32_t c = 3 * range.from; c < 3 * range.to; c++)
    work(c);
}

/* Finds equal corners that are near one another in the file. In most files
 * these are most of them, since triangles that meet are close together. Counts
 * the other corners. */
template <class Real>
void Numbering<Real>::look_back(uint32_t range, int thread) {
  Entry *recent = table_ + table_size_ * size_t(thread);
  size_t *n = at_ + (size_t{range} << bits_);
  clear(recent, RECENT);
  std::fill_n(n, size_t{1} << bits_, 0);
  for_corners(range, [&](uint32_t c) {
    const Place here = place(c);
    const uint64_t hash = hash_of(here);
    const uint32_t tag = uint32_t(hash);
    Entry &entry = recent[tag % RECENT];
    if (entry.tag == tag && entry.corner != NONE &&
        place(entry.corner) == here) {
      vertex_[c] = LATER | entry.corner;
      return;
    }
    entry = {tag, c};
    vertex_[c] = c;
    n[part_of(hash)]++;
  });
}

/* Allocates room for the corners of each part, in the order of their ranges;
 * and for tables, which are at most half full. */
template <class Real> void Numbering<Real>::make_parts() {
  const size_t n_parts = size_t{1} << bits_;
  size_t sum = 0, most = 0;
  end_ = room<size_t>(n_parts);
  for (size_t part = 0; part < n_parts; part++) {
    const size_t before = sum;
    for (size_t range = 0; range < n_ranges_; range++)
      sum += std::exchange(at_[(range << bits_) + part], sum);
    end_[part] = sum;
    most = std::max(most, sum - before);
  }
  sorted_ = room<Entry>(sum);
  while (table_size_ < 2 * most)
    table_size_ *= 2;
  table_ = room<Entry>(table_size_ * size_t(threads_));
}

template <class Real> void Numbering<Real>::sort_in(uint32_t range, int) {
  size_t *at = at_ + (size_t{range} << bits_);
  for_corners(range, [&](uint32_t c) {
    if (vertex_[c] & LATER)
      return;
    const uint64_t hash = hash_of(place(c));
    sorted_[at[part_of(hash)]++] = {uint32_t(hash), c};
  });
}

/* The corners of a part come in order, so what the table holds is the first. */
template <class Real>
void Numbering<Real>::look_in_part(uint32_t part, int thread) {
  Entry *table = table_ + table_size_ * size_t(thread);
  const size_t from = part ? end_[part - 1] : 0, to = end_[part];
  size_t size = 16;
  while (size < 2 * (to - from))
    size *= 2;
  clear(table, size);
  for (size_t k = from; k < to; k++) {
    const Entry entry = sorted_[k];
    size_t slot = entry.tag & (size - 1);
    while (table[slot].corner != NONE &&
           (table[slot].tag != entry.tag ||
            place(table[slot].corner) != place(entry.corner)))
      slot = (slot + 1) & (size - 1);
    if (table[slot].corner == NONE)
      table[slot] = entry;
    else
      vertex_[entry.corner] = LATER | table[slot].corner;
  }
}

template <class Real> void Numbering<Real>::count_first(uint32_t range, int) {
  uint32_t n = 0;
  for_corners(range, [&](uint32_t c) { n += !(vertex_[c] & LATER); });
  n_first_[range] = n;
}

template <class Real> void Numbering<Real>::make_vertices() {
  uint32_t sum = 0;
  for (uint32_t range = 0; range < n_ranges_; range++)
    sum += std::exchange(n_first_[range], sum);
  xyz_ = builder_.vertices(sum);
  builder_.took_vertices(sum);
}

template <class Real> void Numbering<Real>::number_first(uint32_t range, int) {
  uint32_t number = n_first_[range];
  for_corners(range, [&](uint32_t c) {
    if (vertex_[c] & LATER)
      return;
    const Place here = place(c);
    std::copy(here.begin(), here.end(), xyz_ + 3 * size_t{number});
    vertex_[c] = number++;
  });
}

/* A corner names a first one, or one of its range before it. The first triangle
 * that has a number twice. */
template <class Real>
uint32_t Numbering<Real>::number_later(void *context, uint32_t from,
                                       uint32_t to) {
  uint32_t *const vertex = static_cast<Numbering *>(context)->vertex_;
  uint32_t first = to;
  for (uint32_t f = from; f < to; f++) {
    uint32_t *const number = vertex + 3 * size_t{f};
    for (size_t k = 0; k < 3; k++)
      if (number[k] & LATER)
        number[k] = vertex[number[k] & ~LATER];
    if (first == to && (number[0] == number[1] || number[1] == number[2] ||
                        number[2] == number[0]))
      first = f;
  }
  return first;
}

template <class Real> bool Numbering<Real>::give() {
  at_ = room<size_t>(size_t{n_ranges_} << bits_);
  table_ = room<Entry>(table_size_ * size_t(threads_));
  share<&Numbering::look_back>(n_ranges_);
  make_parts();
  share<&Numbering::sort_in>(n_ranges_);
  share<&Numbering::look_in_part>(uint32_t{1} << bits_);
  hsr_arena_free(&arena_);
  n_first_ = room<uint32_t>(n_ranges_);
  share<&Numbering::count_first>(n_ranges_);
  make_vertices();
  share<&Numbering::number_first>(n_ranges_);
  return hsr_share_search(threads_, n_, RANGE, number_later, this) == n_;
}

} // namespace

template <class Real>
void give_loose_triangles(const Loose_triangles &triangles,
                          const std::vector<Rgba> *looks,
                          Mesh_builder &builder) {
  if (!triangles.n)
    return;
  if (!Numbering<Real>(triangles, builder).give() || looks)
    builder.give_faces_again(looks);
}

template void give_loose_triangles<float>(const Loose_triangles &,
                                          const std::vector<Rgba> *,
                                          Mesh_builder &);
template void give_loose_triangles<double>(const Loose_triangles &,
                                           const std::vector<Rgba> *,
                                           Mesh_builder &);

} // namespace hsr
